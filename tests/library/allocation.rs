//! Solving a prepared arm at one pose after another asks for no memory.
#![allow(unsafe_code, reason = "counting allocations takes an allocator, and its trait is unsafe")]
#![allow(clippy::unwrap_used)]

use looproot::internal::assembly::platform::{PlatformAssembly, PlatformSolver, PlatformWorkspace};
use looproot::internal::assembly::{Assembly, Margin, Roots, Solver, Workspace};
use looproot::internal::benchmark::sample::{CHAINS, Set, motions, sample};
use looproot::internal::catalogue::entry::Kind;
use looproot::internal::catalogue::{Options, builtin, robot_names};
use looproot::internal::kinematics::closed_loop::{Layout, OpenLoop};
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::kinematics::platform::Platform;
use looproot_algebra::double_double::DoubleDouble;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::alloc::{GlobalAlloc, Layout as Block, System};
use std::cell::Cell;
use std::f64::consts::PI;

struct Counting;

thread_local! {
    /// The number of allocations of this thread: other threads of the test harness do not count.
    static REQUESTS: Cell<usize> = const { Cell::new(0) };
}

fn count() {
    // A thread that is ending has no counter any more.
    let _ = REQUESTS.try_with(|requests| requests.set(requests.get() + 1));
}

// SAFETY: everything is passed on to the system's allocator; the counter neither allocates nor unwinds.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, block: Block) -> *mut u8 {
        count();
        unsafe { System.alloc(block) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, block: Block) {
        unsafe { System.dealloc(pointer, block) }
    }
    unsafe fn alloc_zeroed(&self, block: Block) -> *mut u8 {
        count();
        unsafe { System.alloc_zeroed(block) }
    }
    unsafe fn realloc(&self, pointer: *mut u8, block: Block, size: usize) -> *mut u8 {
        count();
        unsafe { System.realloc(pointer, block, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn requests() -> usize {
    REQUESTS.with(Cell::get)
}

/// Returns a prepared general arm, and the closing transformations of random poses.
fn arm(index: u64, poses: usize) -> (Solver, Vec<Motion<f64>>) {
    let chain = sample(Set::General, 5, index).unwrap().chain;
    let open: OpenLoop<f64> = chain.open_loop(&Layout::of(&chain, None).unwrap()).unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(index);
    let mut closing = || {
        let turns: [Motion<f64>; 6] = std::array::from_fn(|_| {
            let (sin, cos) = random.random_range(-PI..PI).sin_cos();
            Motion::rotation_z(cos, sin)
        });
        chain.forward::<f64>(&turns).unwrap().inverse()
    };
    let closings = (0..poses).map(|_| closing()).collect();
    (Solver::prepare(&open), closings)
}

#[test]
fn the_counter_counts() {
    let before = requests();
    let list = std::hint::black_box(vec![1_u8; 100]);
    assert!(requests() > before, "{}", list.len());
}

#[test]
fn solving_pose_after_pose_allocates_nothing() {
    for roots in [Roots::Real, Roots::All] {
        let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
        let (mut solutions, mut without_pencils) = (0, 0);
        for index in 0..10 {
            let (solver, closings) = arm(index, 21);
            // The list of modes grows to its size once.
            solver.solve(&closings[0], Roots::All, &mut workspace, &mut assembly);
            for (k, closing) in closings[1..].iter().enumerate() {
                let before = requests();
                solver.solve(closing, roots, &mut workspace, &mut assembly);
                assert_eq!(requests() - before, 0, "{roots:?}, arm {index}, pose {k}");
                solutions += assembly.modes.len();
                without_pencils += usize::from(assembly.tries == 0);
            }
        }
        assert!(solutions >= 200, "{roots:?}: {solutions}");
        // All solutions come from the zeros of a determinant, side by side.
        assert!(roots == Roots::Real || without_pencils >= 190, "{without_pencils} of 200");
    }
}

#[test]
fn proved_real_lists_allocate_nothing() {
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    assembly.modes.reserve(16);
    let mut proved = 0;
    for index in 0..10 {
        let chain = sample(Set::General, 5, index).unwrap().chain;
        let open: OpenLoop<DoubleDouble> = chain.open_loop(&Layout::of(&chain, None).unwrap()).unwrap();
        let (solver, closings) = arm(index, 21);
        for (k, closing) in closings.iter().enumerate() {
            let gap = solver.gap(closing);
            let exact = || Some(open.close(&Motion::identity()));
            let before = requests();
            let is_proved = solver.solve_real_quickly(&gap, &exact, Margin::Blur(0.0), &mut workspace, &mut assembly);
            // The first pose prepares the proof.
            assert!(k == 0 || requests() == before, "arm {index}, pose {k}");
            proved += usize::from(is_proved);
        }
    }
    assert!(proved >= 200, "{proved}");
}

#[test]
fn no_robot_of_six_joints_allocates() {
    let mut robots = 0;
    for name in robot_names() {
        let entry = builtin(&name, &Options::default()).unwrap();
        let chain = entry.chain().filter(|chain| entry.kind() == Kind::Arm && chain.variables().len() == 6);
        let Some(chain) = chain else { continue };
        let open: OpenLoop<f64> = chain.open_loop(&Layout::of(chain, None).unwrap()).unwrap();
        let solver = Solver::prepare(&open);
        let most = if solver.is_decoupled() { 8 } else { 16 };
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
        assembly.modes.reserve(16);
        for pose in 0..10 {
            let turns: [Motion<f64>; 6] = std::array::from_fn(|_| {
                let (sin, cos) = random.random_range(-PI..PI).sin_cos();
                Motion::rotation_z(cos, sin)
            });
            let gap = solver.gap(&chain.forward::<f64>(&turns).unwrap().inverse());
            let before = requests();
            solver.solve_up_to(&gap, Roots::All, &|_| most, &mut workspace, &mut assembly);
            // The first pose finds the way to all solutions.
            assert!(pose == 0 || requests() == before, "{name}, pose {pose}");
            // A closed form needs no pencil.
            assert!(assembly.tries == 0 || !solver.is_decoupled(), "{name}, pose {pose}: {} pencils", assembly.tries);
        }
        robots += 1;
    }
    assert!(robots >= 110, "{robots}");
}

#[test]
fn solving_a_platform_for_leg_after_leg_allocates_nothing() {
    let mut random = ChaCha8Rng::seed_from_u64(4);
    let (mut workspace, mut assembly) = (PlatformWorkspace::default(), PlatformAssembly::default());
    for (trial, flat) in [false, false, false, true].into_iter().enumerate() {
        let mut points = || -> [[f64; 3]; 6] {
            std::array::from_fn(|_| {
                std::array::from_fn(|k| if flat && k == 2 { 0.0 } else { random.random_range(-1.0..1.0) })
            })
        };
        let solver = PlatformSolver::prepare(&Platform { base: points(), plate: points() });
        for round in 0..10 {
            let legs = std::array::from_fn(|_| random.random_range(1.0..4.0));
            let before = requests();
            solver.solve(&legs, if round % 3 == 2 { Roots::Real } else { Roots::All }, &mut workspace, &mut assembly);
            // The list of modes grows to its size once.
            assert!(requests() == before || (trial, round) == (0, 0), "platform {trial}, legs {round}");
        }
    }
}

#[test]
fn special_platforms_allocate_no_more() {
    let mut random = ChaCha8Rng::seed_from_u64(9);
    let (mut workspace, mut assembly) = (PlatformWorkspace::default(), PlatformAssembly::default());
    let base: [[f64; 3]; 6] = std::array::from_fn(|_| std::array::from_fn(|_| random.random_range(-1.0..1.0)));
    // The plate similar to the base: a homotopy; plate points that coincide in pairs: two resultants.
    let paired: [[f64; 3]; 6] = std::array::from_fn(|k| base[k / 2]);
    for (trial, plate) in [base.map(|p| p.map(|x| 0.75 * x)), paired].into_iter().enumerate() {
        let solver = PlatformSolver::prepare(&Platform { base, plate });
        for round in 0..3 {
            let legs = std::array::from_fn(|_| random.random_range(1.0..4.0));
            let before = requests();
            solver.solve(&legs, if round == 2 { Roots::Real } else { Roots::All }, &mut workspace, &mut assembly);
            assert!(requests() == before || (trial, round) == (0, 0), "platform {trial}, legs {round}");
        }
    }
}

#[test]
fn no_chain_allocates_once_the_list_of_modes_has_its_size() {
    for (index, (name, count)) in CHAINS.into_iter().enumerate() {
        // A draw whose complex solutions f64 can prove: of others the rounding of the constants leaves some open.
        let drawn = sample(Set::Chain(index), 6, 0).unwrap();
        let layout = Layout::of(&drawn.chain, None).unwrap();
        let open: OpenLoop<f64> = drawn.chain.open_loop(&layout).unwrap();
        let solver = match layout.spherical_unknown() {
            Some(spherical) => Solver::with_spherical_joint(&open, spherical),
            None => Solver::prepare(&open),
        };
        let closing = drawn.chain.forward::<f64>(&motions(&drawn.variables, &drawn.planted)).unwrap().inverse();
        for roots in [Roots::Real, Roots::All] {
            let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
            solver.solve(&closing, Roots::All, &mut workspace, &mut assembly);
            assert_eq!(assembly.total(), count, "{name}");
            let before = requests();
            solver.solve(&closing, roots, &mut workspace, &mut assembly);
            assert_eq!(requests() - before, 0, "{name}, {roots:?}");
        }
    }
}
