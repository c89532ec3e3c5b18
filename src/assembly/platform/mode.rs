//! A pose of a platform, and the list of them for one set of leg lengths.

use crate::certify::Certificate;
use num_complex::Complex;
use std::fmt;

/// One pose of the moving platform.
#[derive(Clone, Debug, PartialEq)]
pub struct PlatformMode {
    /// The rotation as a quaternion (w, x, y, z) of hermitian norm 1. For a real pose it is real with its first nonzero part
    /// positive; for a complex one its largest part is real and positive.
    pub quaternion: [Complex<f64>; 4],
    /// Study's parameters as the certificate bounds them: x as above, with lengths about the centre of the platform and over
    /// its scale.
    pub study: [Complex<f64>; 8],
    /// The translation p, in the unit of the mechanism: point b of the moving platform is at `p + R b`.
    pub position: [Complex<f64>; 3],
    /// Whether the pose is real.
    pub real: bool,
    /// The number of solutions that coincide here; 0 if it is not known.
    pub multiplicity: usize,
    /// Largest `|l^2 - L^2|` of a leg, relative to `|l|^2 + L^2`: twice the relative error of its length.
    pub residual: f64,
    /// Row-sum condition number of the derivative of the leg quadrics and the Study condition, each row scaled to 1 and
    /// lengths over the scale of the mechanism.
    pub condition: f64,
    /// The certificate, if there is one. Its radii hold for Study's parameters (x, y), with the hermitian norm of x equal to
    /// 1 and lengths over the scale of the mechanism.
    pub certificate: Option<Certificate>,
    /// `|x.x|` of the quaternion: 1 for real poses; complex solutions where it is tiny are nearly at infinity.
    pub norm: f64,
    /// Index of the pose mirrored in the base plane, if base and moving platform are plane; a pose that is its own mirror
    /// image (both in one plane) has its own index.
    pub mirror: Option<usize>,
}

/// The route by which the list was found, and the reason for it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Route {
    /// Nothing was solved yet.
    #[default]
    None,
    /// The border basis of the 40-dimensional quotient algebra, with this many unknowns beside the rotation.
    BorderBasis {
        /// Number of weak directions of the legs' matrix K, plus 1.
        directions: usize,
    },
    /// The two resultants of a triangle hung on six legs that meet in pairs.
    Triangle {
        /// Whether the legs meet at the base, not at the moving platform.
        at_base: bool,
    },
    /// The algebra of rotations of a platform whose base and moving platform are affine images of the same points.
    Affine,
    /// A parameter homotopy from general platforms: the border basis of the platform itself lost rank, or did not lead to
    /// poses that are known to exist.
    Homotopy {
        /// Number of general platforms that served as starts.
        runs: usize,
    },
    /// A further leg in the place of each leg that depends on others: poses are on families only.
    Dependent,
}

impl fmt::Display for Route {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::None => write!(f, "nothing was solved"),
            Self::BorderBasis { directions: 1 } => {
                write!(f, "border basis of dimension 40 (the legs' matrix K has full rank)")
            }
            Self::BorderBasis { directions } => write!(
                f,
                "border basis of dimension 40; unknowns are the weak directions of the legs' matrix K, {} in number",
                directions - 1
            ),
            Self::Triangle { at_base } => write!(
                f,
                "two resultants of degree 16 (the legs meet in pairs at the {}: a triangle whose corners move on circles)",
                if *at_base { "base" } else { "plate" }
            ),
            Self::Affine => {
                write!(f, "algebra of the rotations (base and plate are affine images of the same six points)")
            }
            Self::Dependent => write!(f, "a further leg in the place of each that depends on the others"),
            Self::Homotopy { runs } => write!(
                f,
                "parameter homotopy, 40 paths from a general platform to this one, {runs} {} (special geometry: the border \
                 basis of the platform itself does not do)",
                if *runs == 1 { "time" } else { "times" }
            ),
        }
    }
}

/// The poses and self-motion found for six legs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlatformAssembly {
    /// Isolated poses, real ones first.
    pub modes: Vec<PlatformMode>,
    /// The route by which they were found.
    pub route: Route,
    /// Degree in which the border basis of the platform itself lost rank, if it did.
    pub lost_rank: Option<usize>,
    /// Rank of the legs' matrix K: 6 in general; 5 if base and moving platform are plane, 4 if they are affinely related, 3
    /// if they are also plane.
    pub rank: usize,
    /// Number of solutions found with `N = x.x = 0`, which are no poses, with multiplicity.
    pub null: usize,
    /// Number of solutions that are not proved regular and may be no poses: points of families, or singular solutions.
    pub unresolved: usize,
    /// Dimension of the self-motion found, 0 if none was.
    pub self_motion: usize,
    /// Poses of the self-motion, as quaternion and position; those of a curve are in their order along it.
    pub motion: Vec<[f64; 7]>,
    /// Number of poses found or proved in multiprecision arithmetic only.
    pub by_high_precision: usize,
    /// Largest number of bits used for these.
    pub high_precision_bits: usize,
}

impl PlatformAssembly {
    /// Number of isolated poses, with multiplicity.
    #[must_use]
    pub fn total(&self) -> usize {
        self.modes.iter().map(|m| m.multiplicity.max(1)).sum()
    }

    /// Number of isolated real poses, with multiplicity.
    #[must_use]
    pub fn real(&self) -> usize {
        self.modes.iter().filter(|m| m.real).map(|m| m.multiplicity.max(1)).sum()
    }
}
