//! Thresholds. Lengths are scaled, so all of them are relative.

/// Cuts with a lower score lose equations.
pub const SCORE: f64 = 1e-5;
/// Leading matrices below this are singular.
pub const LEADING: f64 = 1e-9;
/// Leading matrices above this need no other offset.
pub const GOOD_LEADING: f64 = 1e-2;
/// |Im x| / (1 + |x|^2) below which a root may be real: double roots split by 1e-8 and more.
pub const NEAR_REAL: f64 = 1e-4;
/// Closure error before polishing above which a candidate is rejected: Newton's method might wander to another solution.
pub const RAW: f64 = 1e-3;
/// Growth of rounding errors round the loop above which complex candidates are polished in double-double arithmetic.
pub const FAR: f64 = 1e9;
/// Translations up to this length may close with an error in proportion to it; longer ones may not.
pub const LONGEST: f64 = 1e3;
/// Closure error after polishing above which a candidate is no solution.
pub const CLOSED: f64 = 1e-12;
/// |1 + x^2| / (1 + |x|^2) below which a root belongs to no finite angle.
pub const INFINITE: f64 = 1e-2;
/// Roots of a pencil nearer than this, over 1 + |x|^2, are one root that several solutions share.
pub const REPEATED: f64 = 1e-9;
/// Solutions nearer than this are one unless both are proved and apart.
pub const SAME: f64 = 1e-5;
/// Imaginary parts below this are rounding errors at a real solution.
pub const REAL_PART: f64 = 1e-8;
/// Solutions farther apart than this are polished to different points and are listed separately.
pub const MERGED: f64 = 1e-4;
/// A certificate radius above which a solution without a known partner may be one of a cluster.
pub const LONE_RADIUS: f64 = 1e-7;
/// Radius of the cluster around a solution of multiplicity m, in units of eps^(1/m).
pub const CLOUD: f64 = 32.0;
/// Closure errors up to this, if they make two solutions coincide, are rounding of the input: the solution counts as
/// double.
pub const TOLD_APART: f64 = 1e-13;
/// Number of random starts of a search that no pencil leads.
pub const CASTS: usize = 40;
/// Closure error above which such a start has led nowhere.
pub const NEAR: f64 = 1e-2;
/// Norm of the inverse Jacobian above which a solution may be one of a pair that has to be proved together.
pub const SINGULAR: f64 = 1e5;
/// Imaginary parts below this are rounding errors at a real double solution.
pub const NEAR_DOUBLE: f64 = 1e-6;
/// Separation of the kernel below which a root that does not close may belong to a family.
pub const SHARED: f64 = 1e-7;
/// Squared sines of twists, and amplitudes of one angle's equation, below which axes are parallel.
pub const PARALLEL: f64 = 1e-12;
/// Determinants of the equations of a spherical joint's centre below this, in scaled lengths, are zero.
pub const REACH_DEPENDENT: f64 = 1e-9;
/// Below this sine of its second angle, the other two angles of a spherical joint cannot be distinguished.
pub const LOCKED: f64 = 0.05;
/// Translations nearer than this to dependent ones need not close a loop.
pub const DEPENDENT: f64 = 1e-6;
/// The two equations of a spherical four-bar nearer than this to dependent ones may have two solutions at one angle.
pub const SHARED_ANGLE: f64 = 1e-6;
/// Sines below which a translation runs along an axis.
pub const ALONG: f64 = 1e-12;
/// Below this sine two axes of a spherical joint coincide.
pub const ONE_AXIS: f64 = 1e-9;
