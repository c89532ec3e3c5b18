//! A platform prepared once and solved for one set of leg lengths after the other.

use super::mode::{PlatformAssembly, PlatformMode, Route};
use super::prepared::{Chart, Frame};
use super::search::{Found, Search};
use crate::assembly::Roots;
use crate::certify::pose::Curvature;
use crate::elimination::border::{BorderBasis, DIMENSION, Reals};
use crate::elimination::pencil::Square;
use crate::kinematics::platform::Platform;
use crate::solve::eigen::Method;
use crate::solve::spectrum::Spectrum;
use num_complex::Complex;

/// The geometry of a platform, prepared for every set of leg lengths. Shared between threads.
#[derive(Clone, Debug)]
pub struct PlatformSolver {
    platform: Platform<f64>,
    frame: Frame,
    charts: [Chart; 2],
}

/// Scratch memory, reused from call to call: one for every thread.
pub struct PlatformWorkspace {
    basis: BorderBasis<f64>,
    spectrum: Spectrum<DIMENSION>,
    found: Vec<Found>,
}

impl Default for PlatformWorkspace {
    fn default() -> Self {
        Self {
            basis: BorderBasis::new(&Reals),
            spectrum: Spectrum::default(),
            found: Vec::with_capacity(2 * DIMENSION),
        }
    }
}

impl PlatformSolver {
    /// Prepares a geometry. Any finite coordinates will do; degenerate ones show in the answers.
    #[must_use]
    pub fn prepare(platform: &Platform<f64>) -> Self {
        let frame = Frame::new(platform);
        let charts = std::array::from_fn(|choice| Chart::new(&frame.platform, choice));
        Self { platform: platform.clone(), frame, charts }
    }

    /// The geometry as given.
    #[must_use]
    pub fn platform(&self) -> &Platform<f64> {
        &self.platform
    }

    /// The 40 x 40 matrix whose eigenvalues are asked for with these legs; `None` where the geometry is special.
    #[must_use]
    pub fn matrix(&self, legs_squared: &[f64; 6], workspace: &mut PlatformWorkspace) -> Option<Square<f64, DIMENSION>> {
        let unit = self.frame.scale * self.frame.scale;
        let setting = self.charts[0].with_legs(&legs_squared.map(|square| square / unit));
        workspace.basis.build(&Reals, &setting).ok()?;
        workspace.basis.products[0].as_slice().try_into().ok()
    }

    /// Study's parameters of a mode as its certificate bounds them, where it has one: about the centre of the platform,
    /// lengths over the scale.
    #[must_use]
    pub fn study(&self, mode: &PlatformMode) -> [Complex<f64>; 8] {
        self.frame.study(&mode.quaternion, &mode.position)
    }

    /// All poses with legs of these squared lengths (negative ones are meant as written: no pose is real then). With
    /// [`Roots::Real`] only real ones.
    pub fn solve(
        &self,
        legs_squared: &[f64; 6],
        roots: Roots,
        workspace: &mut PlatformWorkspace,
        assembly: &mut PlatformAssembly,
    ) {
        assembly.modes.clear();
        assembly.lost_rank = None;
        assembly.rank = self.charts[0].directions.rank;
        assembly.self_motion = 0;
        let unit = self.frame.scale * self.frame.scale;
        let squares = legs_squared.map(|s| s / unit);
        let mut legs = self.frame.legs.clone();
        for (leg, square) in legs.iter_mut().zip(squares) {
            leg.square = square;
        }
        let curvature = Curvature::new(&legs);
        workspace.found.clear();
        let mut search =
            Search { legs: &legs, curvature: &curvature, roots, found: &mut workspace.found, null: 0, lost: 0 };
        'charts: for chart in &self.charts {
            let setting = chart.with_legs(&squares);
            if let Err(lost) = workspace.basis.build(&Reals, &setting) {
                assembly.lost_rank = Some(lost.degree);
                continue;
            }
            assembly.route = Route::BorderBasis { directions: setting.count };
            for method in [Method::Francis, Method::Faer] {
                if !workspace.spectrum.decompose(method, &workspace.basis.products[0]) {
                    continue;
                }
                search.all_eigenvalues(chart, &setting, &workspace.basis, &mut workspace.spectrum);
                let done = match roots {
                    Roots::Real => search.lost == 0,
                    Roots::All => search.poses() + search.null >= DIMENSION,
                };
                if done {
                    break 'charts;
                }
            }
        }
        assembly.null = search.null;
        assembly.unresolved = match roots {
            Roots::Real => search.lost,
            Roots::All => DIMENSION.saturating_sub(search.poses() + search.null),
        };
        search.tell(&self.frame, assembly);
    }
}
