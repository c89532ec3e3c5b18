//! What is found: poses, and the list of them.

use crate::certify::Certificate;
use num_complex::Complex;
use std::fmt;

/// One pose of the plate.
#[derive(Clone, Debug, PartialEq)]
pub struct PlatformMode {
    /// The rotation as a quaternion (w, x, y, z) of hermitian norm 1; of a real pose real with its first nonzero part
    /// positive, of a complex one with its largest part real and positive.
    pub quaternion: [Complex<f64>; 4],
    /// Study's parameters as the certificate bounds them: x as above, lengths about the centre of the platform and over its
    /// scale.
    pub study: [Complex<f64>; 8],
    /// The translation p, in the unit of the mechanism: point b of the plate is at `p + R b`.
    pub position: [Complex<f64>; 3],
    /// Whether the pose is real.
    pub real: bool,
    /// How many solutions coincide here; 0 where that is not known.
    pub multiplicity: usize,
    /// Largest `|l^2 - L^2|` of a leg, relative to `|l|^2 + L^2`: twice the relative error of its length.
    pub residual: f64,
    /// Row-sum condition number of the derivative of the leg quadrics and the Study condition, each row scaled to 1 and
    /// lengths over the scale of the mechanism.
    pub condition: f64,
    /// The proof, if there is one. Radii are those of Study's parameters (x, y) with the hermitian norm of x equal to 1
    /// and lengths over the scale of the mechanism.
    pub certificate: Option<Certificate>,
    /// `|x.x|` of the quaternion: 1 for real poses; complex solutions where it is tiny are nearly at infinity.
    pub norm: f64,
    /// Index of the pose mirrored in the base plane, where base and plate are both plane; of a pose that is its own
    /// mirror image (plates in one plane) its own index.
    pub mirror: Option<usize>,
}

/// Which way the list was found, and why that one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Route {
    /// Nothing was solved yet.
    #[default]
    None,
    /// The border basis of the 40-dimensional quotient algebra, with this many unknowns beside the rotation.
    BorderBasis {
        /// 1, and one more for every weak direction of the legs' matrix K.
        directions: usize,
    },
    /// The two resultants of a triangle hung on six legs that meet in pairs.
    Triangle {
        /// Whether they meet at the base, not at the plate.
        at_base: bool,
    },
    /// The algebra of rotations of a platform whose base and plate are affine images of the same points.
    Affine,
    /// A parameter homotopy from general platforms: the border basis of the platform itself lost rank, or poses that are
    /// known to exist were not found with it.
    Homotopy {
        /// How many general platforms were started from.
        runs: usize,
    },
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
                "border basis of dimension 40 with {} weak directions of the legs' matrix K as unknowns",
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
            Self::Homotopy { runs } => write!(
                f,
                "parameter homotopy, 40 paths from a general platform to this one, {runs} {} (special geometry: the border \
                 basis of the platform itself does not do)",
                if *runs == 1 { "time" } else { "times" }
            ),
        }
    }
}

/// What was found for six legs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlatformAssembly {
    /// Isolated poses, real ones first.
    pub modes: Vec<PlatformMode>,
    /// How they were found.
    pub route: Route,
    /// Degree in which the border basis of the platform itself lost rank, where it did.
    pub lost_rank: Option<usize>,
    /// Rank of the legs' matrix K, 6 in general; 5 if base and plate are plane, 4 if they are affinely related, 3 if they
    /// are also plane.
    pub rank: usize,
    /// Solutions of the equations with `N = x.x = 0`, which are no poses, among those looked at; with multiplicity.
    pub null: usize,
    /// Solutions that are no pose beyond doubt and none the less not proved regular: points of families, or singular.
    pub unresolved: usize,
    /// Dimension of the self-motion found, 0 if none was.
    pub self_motion: usize,
    /// Poses of it, quaternion and position; of a curve in their order along it.
    pub motion: Vec<[f64; 7]>,
    /// How many poses were found or proved in multiprecision arithmetic only.
    pub by_high_precision: usize,
    /// Bits of the longest of these.
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
