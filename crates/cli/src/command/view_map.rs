//! The map of `looproot view --map`: real solutions counted over a plane.

use super::arguments::ViewOptions;
use super::exit::Fault;
use super::output::pool;
use super::wanted::wanted;
use looproot::internal::assembly::{Assembly, Roots, Workspace};
use looproot::internal::catalogue::entry::{Case, Entry, Kind};
use looproot::internal::catalogue::{Options, load};
use looproot::internal::error::Error;
use looproot::internal::kinematics::chain::Placement;
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::mechanism::Mechanism;
use looproot::internal::scene::Stage;
use looproot::internal::view::map::{Map, Plane};
use rayon::prelude::*;
use rug::Rational;

/// Number of grid points in a row and in a column.
const SIDE: usize = 72;
/// The same number for a first pass that finds the reach of the arm.
const COARSE: usize = 20;

/// Returns the picture of the map.
pub fn map(options: &ViewOptions, plane: &str) -> Result<String, Fault> {
    let plane = Plane::parse(plane).ok_or_else(|| {
        Error::Invalid(format!("found --map {plane}, expected two of the letters x, y and z, such as xz"))
    })?;
    let solve = &options.solve;
    let read = Options { chains: solve.asked.chains(), ..solve.read.options() };
    let mut entry = load(&solve.mechanism, &read)?;
    let first = wanted(&solve.asked, &solve.mechanism, &mut entry)?.start;
    let pose = entry.cases.get(first).and_then(|case| case.pose.clone());
    let (Kind::Arm, Some(pose)) = (entry.kind(), pose) else {
        return Err(Error::Invalid("found --map of something else, expected an arm at a pose".to_owned()).into());
    };
    let surveyor = Surveyor { mechanism: Mechanism::prepare(&entry)?, pose, plane };
    let pool = pool(solve.threads)?;
    let wide = whole(&entry, plane);
    let range = pool.install(|| surveyor.reached(wide)).unwrap_or(wide);
    let counts = pool.install(|| surveyor.counts(range, SIDE));
    let at = plane.axes.map(|axis| surveyor.pose.float.translation[axis]);
    Ok(Map { plane, range, side: SIDE, counts, at }.svg(&entry.title))
}

/// Returns the range of everything that the links can reach.
fn whole(entry: &Entry, plane: Plane) -> [[f64; 2]; 2] {
    let (centre, size) = Stage::of(entry).map_or(([0.0; 3], 1.0), |stage| (stage.scene.centre, stage.scene.size));
    plane.axes.map(|axis| [centre[axis] - size, centre[axis] + size])
}

/// Counts solutions at points of a plane, with the orientation of a pose.
struct Surveyor {
    mechanism: Mechanism,
    pose: Placement,
    plane: Plane,
}

impl Surveyor {
    /// Returns the counts on a grid.
    fn counts(&self, range: [[f64; 2]; 2], side: usize) -> Vec<Option<usize>> {
        let memory = || (Workspace::default(), Assembly::default());
        let one = |(workspace, assembly): &mut (Workspace, Assembly), index: usize| {
            self.count(Map::point(range, side, index), workspace, assembly)
        };
        (0..side * side).into_par_iter().map_init(memory, one).collect()
    }

    fn count(&self, [x, y]: [f64; 2], workspace: &mut Workspace, assembly: &mut Assembly) -> Option<usize> {
        let mut translation = self.pose.exact.translation.clone();
        translation[self.plane.axes[0]] = Rational::from_f64(x)?;
        translation[self.plane.axes[1]] = Rational::from_f64(y)?;
        let rotation = self.pose.exact.rotation.clone();
        let case = Case::at(Placement::from_motion_exact(Motion { rotation, translation }), 0);
        let solution = self.mechanism.solve(&case, Roots::Real, workspace, assembly).ok()?;
        Some(solution.modes.iter().filter(|mode| mode.real).count())
    }

    /// Returns the part of a range that contains solutions, with a margin.
    fn reached(&self, wide: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
        let counts = self.counts(wide, COARSE);
        let found = || (0..counts.len()).filter(|index| counts[*index].is_some_and(|count| count > 0));
        found().next()?;
        let cell = [0, 1].map(|axis: usize| (wide[axis][1] - wide[axis][0]) / COARSE as f64);
        let mut range = [0, 1].map(|axis: usize| {
            let values = || found().map(|index| Map::point(wide, COARSE, index)[axis]);
            [
                values().fold(f64::INFINITY, f64::min) - 1.5 * cell[axis],
                values().fold(f64::NEG_INFINITY, f64::max) + 1.5 * cell[axis],
            ]
        });
        // One scale for both coordinates.
        let span = range.iter().map(|[low, high]| high - low).fold(0.0, f64::max);
        for [low, high] in &mut range {
            let middle = f64::midpoint(*low, *high);
            (*low, *high) = (middle - span / 2.0, middle + span / 2.0);
        }
        Some(range)
    }
}
