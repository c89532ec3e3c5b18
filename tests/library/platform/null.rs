//! Solutions with `N = 0`, and with `x = 0`, at legs of all lengths, beside the count of the poses modulo a prime at some legs.

use looproot::internal::benchmark::platform::sample::{PlatformSet, sample};
use looproot::internal::elimination::platform_degree::{PlatformDegree, platform_degree};
use looproot::internal::elimination::platform_far::far_solutions;
use looproot::internal::elimination::platform_incidence::most_poses;
use looproot::internal::elimination::platform_null::null_solutions;
use looproot::internal::kinematics::platform::Platform;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::Rational;

type Exact = Platform<Rational>;

/// The number of poses at legs of general lengths.
fn poses(platform: &Exact, random: &mut ChaCha8Rng) -> PlatformDegree {
    platform_degree(platform, &std::array::from_fn(|_| Rational::from(random.random_range(100..9000)))).unwrap()
}

fn points(points: [[i32; 3]; 6]) -> [[Rational; 3]; 6] {
    points.map(|p| p.map(Rational::from))
}

/// A body whose points 1 and 2, 3 and 6, 4 and 5 mirror each other, moved and turned.
fn mirrored(height: i32, random: &mut ChaCha8Rng) -> [[Rational; 3]; 6] {
    let mut half = || [random.random_range(-40..40), random.random_range(1..40), height * random.random_range(-9..9)];
    let [p, q, r] = [half(), half(), half()];
    let image = |[x, y, z]: [i32; 3]| [x, -y, z];
    // A rotation by the quaternion (1, 2, 2, 4)/5.
    let turn = [[-15, 0, 20], [16, -15, 12], [12, 20, 9]];
    let turned =
        |p: [i32; 3]| turn.map(|row| Rational::from((row.iter().zip(p).map(|(a, x)| a * x).sum::<i32>() + 7, 25)));
    [p, image(p), q, r, image(r), image(q)].map(turned)
}

#[test]
fn lines_through_the_points_of_both_bodies_leave_as_few_poses_as_there_are() {
    let mut random = ChaCha8Rng::seed_from_u64(22);
    for (set, null) in [
        (PlatformSet::General, 0),
        (PlatformSet::PlanarBoth, 0),
        (PlatformSet::Shared(&[], &[(0, 1)]), 0),
        (PlatformSet::Hexapod, 12),
        (PlatformSet::Shared(&[], &[(0, 1), (2, 3)]), 8),
        (PlatformSet::Shared(&[(0, 1)], &[(2, 3)]), 16),
        (PlatformSet::Shared(&[(0, 1)], &[(1, 2), (3, 4)]), 16),
        (PlatformSet::Shared(&[(0, 1), (3, 4)], &[(1, 2), (4, 5)]), 24),
        (PlatformSet::Shared(&[], &[(0, 1), (2, 3), (4, 5)]), 24),
    ] {
        let drawn = sample(set, 22, 3).unwrap();
        let platform = drawn.platform.map(|x| Rational::from_f64(*x)).unwrap();
        assert_eq!(null_solutions(&platform), null, "{set:?}");
        let count = poses(&platform, &mut random);
        assert!(matches!(count, PlatformDegree::Finite { poses, .. } if poses == 40 - null), "{set:?}: {count:?}");
    }
    // One plane of symmetry, plane points and points of space.
    for height in [0, 1] {
        let platform = Exact { base: mirrored(height, &mut random), plate: mirrored(height, &mut random) };
        assert_eq!(most_poses(&platform).map(|most| most.0), Some(36));
        let count = poses(&platform, &mut random);
        assert!(matches!(count, PlatformDegree::Finite { poses: 36, .. }), "{count:?}");
    }
}

#[test]
fn the_bound_holds_where_points_and_directions_coincide_in_all_ways() {
    let mut random = ChaCha8Rng::seed_from_u64(40);
    let mut met = 0;
    for trial in 0..300 {
        // Few values of coordinates: points coincide, lines are parallel, and bodies are related.
        let width = 1 + trial % 3;
        let mut body = || points(std::array::from_fn(|_| std::array::from_fn(|_| random.random_range(-width..=width))));
        let platform = Exact { base: body(), plate: body() };
        let null = null_solutions(&platform) + far_solutions(&platform);
        if let Some(PlatformDegree::Finite { poses: count, .. }) =
            platform_degree(&platform, &std::array::from_fn(|_| Rational::from(random.random_range(10..900))))
        {
            assert!(count + null <= 40, "{platform:?}: {count} poses and {null}");
            met += usize::from(null > 0 && count + null == 40);
        }
    }
    assert!(met > 10, "{met}: the draw does not test what it should");
}

#[test]
fn nothing_is_taken_for_granted_where_solutions_form_curves() {
    // Related bodies, whose three classes an affine map takes to each other.
    let base = points([[6, 1, 0], [1, 6, 0], [0, 6, 1], [0, 1, 6], [1, 0, 6], [6, 0, 1]]);
    let twice = base.each_ref().map(|p| p.each_ref().map(|x| Rational::from(x * 2)));
    assert_eq!(null_solutions(&Exact { base: base.clone(), plate: twice }), 0);
    // Solutions with N = 0 form curves here.
    let drawn = sample(PlatformSet::Shared(&[(0, 1)], &[(2, 3), (4, 5)]), 22, 3).unwrap();
    assert_eq!(null_solutions(&drawn.platform.map(|x| Rational::from_f64(*x)).unwrap()), 0);
    // Points that all but lie on the lines count for nothing.
    let mut near = mirrored(0, &mut ChaCha8Rng::seed_from_u64(1));
    let other = mirrored(0, &mut ChaCha8Rng::seed_from_u64(2));
    assert_eq!(null_solutions(&Exact { base: near.clone(), plate: other.clone() }), 4);
    near[0][0] += Rational::from((1, 1_000_000_000_000_000_000_i64));
    assert_eq!(null_solutions(&Exact { base: near, plate: other }), 0);
}

/// A random point.
fn point(random: &mut ChaCha8Rng) -> [Rational; 3] {
    std::array::from_fn(|_| Rational::from((random.random_range(-40..=40), random.random_range(1..=3))))
}

#[test]
fn five_related_points_leave_as_few_poses_as_there_are() {
    let mut random = ChaCha8Rng::seed_from_u64(6);
    // A rotation by the quaternion (1, 2, 2, 4)/5, times a ratio.
    let turn = |ratio: i32| [[-15, 0, 20], [16, -15, 12], [12, 20, 9]].map(|row| row.map(|x| x * ratio));
    for ratio in [1, -1, 2, -3] {
        let map = turn(ratio);
        let base: [[Rational; 3]; 6] = std::array::from_fn(|_| point(&mut random));
        let image = |p: &[Rational; 3]| -> [Rational; 3] {
            map.map(|row| row.iter().zip(p).map(|(a, x)| x * Rational::from((*a, 25))).sum())
        };
        let mut plate = base.each_ref().map(image);
        plate[3] = point(&mut random);
        let mut platform = Exact { base, plate };
        assert_eq!(far_solutions(&platform), 4, "{ratio}");
        // Congruent ones have as many, by another program; here their count grows with the degree.
        if ratio.abs() > 1 {
            let count = poses(&platform, &mut random);
            assert!(matches!(count, PlatformDegree::Finite { poses: 36, .. }), "{ratio}: {count:?}");
        }
        // One more point off by a little, and nothing is left of that.
        platform.base[1][0] += Rational::from((1, 1_000_000_000_000_000_000_i64));
        assert_eq!(far_solutions(&platform), 0, "{ratio}");
    }
}
