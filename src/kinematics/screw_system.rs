//! Screws and the systems they span: what the joints of a mechanism let through, and what they hold, at one configuration.
//!
//! \[Wittenburg2016, ch. 4 and 12\]; a screw is a twist `(direction, moment)` with the angular velocity first.

use super::motion::{Vector, cross, dot};
use crate::algebra::echelon::Echelon;
use crate::algebra::ring::{Field, Ring};
use crate::algebra::sort;
use looproot_calculus::finite::finite;
use nalgebra::DMatrix;

/// Squared directions below this share of the largest belong to translations.
const TRANSLATION: f64 = 1e-14;

/// Returns the size below which a number counts as zero beside 1; 0 in an exact field.
fn negligible<F: Field>() -> f64 {
    F::PIVOT_ZERO * 1e4
}

/// A screw: a line with a pitch and a magnitude, or a direction alone (infinite pitch).
///
/// # Units
/// `moment` in those of `direction` times a length.
#[derive(Clone, Debug, PartialEq)]
pub struct Screw<R> {
    /// The angular velocity of the twist; zero for a translation.
    pub direction: Vector<R>,
    /// The velocity of the point at the origin: `p x direction + pitch direction` for an axis through p.
    pub moment: Vector<R>,
}

impl<R: Ring> Screw<R> {
    /// The screw of a revolute joint: the line through a point, pitch 0.
    #[must_use]
    pub fn rotation(point: &Vector<R>, axis: &Vector<R>) -> Self {
        Self { direction: axis.clone(), moment: cross(point, axis) }
    }

    /// The screw of a prismatic joint.
    #[must_use]
    pub fn translation(axis: &Vector<R>) -> Self {
        Self { direction: std::array::from_fn(|_| R::zero()), moment: axis.clone() }
    }

    /// The Klein form `direction . other.moment + moment . other.direction`: zero when a wrench on the one does no work on
    /// the other.
    #[must_use]
    pub fn reciprocal_product(&self, other: &Self) -> R {
        dot(&self.direction, &other.moment).add(&dot(&self.moment, &other.direction))
    }

    /// The six coordinates, direction first.
    #[must_use]
    pub fn coordinates(&self) -> [R; 6] {
        std::array::from_fn(|k| if k < 3 { self.direction[k].clone() } else { self.moment[k - 3].clone() })
    }

    fn from_coordinates(c: &[R]) -> Self {
        Self { direction: std::array::from_fn(|k| c[k].clone()), moment: std::array::from_fn(|k| c[k + 3].clone()) }
    }
}

impl<F: Field> Screw<F> {
    /// Whether the screw is a translation: no direction, or one that is rounding beside the moment.
    #[must_use]
    pub fn is_translation(&self) -> bool {
        let size = |v: &Vector<F>| v.iter().map(Field::pivot_size).fold(0.0, f64::max);
        size(&self.direction) <= negligible::<F>() * size(&self.moment)
    }

    /// The pitch `direction . moment / direction^2`, a length; `None` for a translation.
    #[must_use]
    pub fn pitch(&self) -> Option<F> {
        let square = (!self.is_translation()).then(|| dot(&self.direction, &self.direction))?;
        Some(dot(&self.direction, &self.moment).mul(&square.inverse()?))
    }

    /// The point of the axis nearest to the origin, `direction x moment / direction^2`; `None` for a translation.
    #[must_use]
    pub fn foot(&self) -> Option<Vector<F>> {
        let square = (!self.is_translation()).then(|| dot(&self.direction, &self.direction))?;
        let inverse = square.inverse()?;
        Some(cross(&self.direction, &self.moment).map(|x| x.mul(&inverse)))
    }
}

/// The linear space that the screws of some joints span.
///
/// # Example
/// Three axes through one point span the rotations about it; what is reciprocal to them are the forces through it.
/// ```
/// use looproot_engine::kinematics::screw_system::{Screw, ScrewSystem};
/// use rug::Rational;
///
/// let vector = |v: [i32; 3]| v.map(Rational::from);
/// let axes = [[1, 0, 0], [1, 1, 0], [2, 3, 4]].map(|axis| Screw::rotation(&vector([5, 6, 7]), &vector(axis)));
/// let system = ScrewSystem::of(&axes);
/// assert_eq!((system.order(), system.reciprocal().order()), (3, 3));
/// assert_eq!(system.description(), "all axes meet in one point, rotations about it (spherical)");
/// ```
#[derive(Clone, Debug)]
pub struct ScrewSystem<F> {
    screws: Vec<Screw<F>>,
    echelon: Echelon<F>,
}

/// The linear complex of a system of order 5: every screw of the system is reciprocal to it.
#[derive(Clone, Debug, PartialEq)]
pub enum LinearComplex<F> {
    /// The lines of the system are perpendicular to the paths of their points under this screw motion; of pitch 0, they meet
    /// its axis.
    General {
        /// The screw to which all others are reciprocal.
        screw: Screw<F>,
        /// Its pitch.
        pitch: F,
        /// The point of its axis nearest to the origin.
        foot: Vector<F>,
    },
    /// All rotations of the system have axes perpendicular to one direction.
    Perpendicular(Vector<F>),
}

/// The number of freedoms of a single closed loop at a configuration, and its redundant closure conditions.
#[derive(Clone, Debug)]
pub struct LoopFreedom<F> {
    /// Freedoms of all joints together.
    pub joints: usize,
    /// Order of the screw system of the joints.
    pub order: usize,
    /// Instantaneous degree of freedom, `joints - order`.
    pub freedom: usize,
    /// A basis of the joint rates that keep the loop closed to first order.
    pub rates: Vec<Vec<F>>,
    /// Joints, counted from 0, that stand still in all of them.
    pub locked: Vec<usize>,
    /// The redundant constraints: screws of the wrenches that the loop may hold in itself without a load, `6 - order` many.
    pub redundant: ScrewSystem<F>,
}

impl<F: Field> ScrewSystem<F> {
    /// Returns the system that these screws span. For inexact coordinates, the rank is most reliable with directions of length 1
    /// and moments in a unit of the size of the mechanism.
    #[must_use]
    pub fn of(screws: &[Screw<F>]) -> Self {
        let rows = screws.iter().map(|screw| screw.coordinates().to_vec()).collect();
        Self { screws: screws.to_vec(), echelon: Echelon::of(rows, 6) }
    }

    /// The number of independent screws, 0 to 6.
    #[must_use]
    pub fn order(&self) -> usize {
        self.echelon.rank()
    }

    /// Independent screws that span the system.
    #[must_use]
    pub fn basis(&self) -> Vec<Screw<F>> {
        self.echelon.rows().iter().map(|row| Screw::from_coordinates(row)).collect()
    }

    /// The screws reciprocal to all of the system, a system of order `6 - order`.
    #[must_use]
    pub fn reciprocal(&self) -> Self {
        // The null space is in the dual coordinates, in which the Klein form is the plain product.
        let swapped = |v: &Vec<F>| Screw {
            direction: std::array::from_fn(|k| v[k + 3].clone()),
            moment: std::array::from_fn(|k| v[k].clone()),
        };
        Self::of(&self.echelon.null_space().iter().map(swapped).collect::<Vec<_>>())
    }

    /// The linear complex of a system of order 5; `None` for other orders.
    #[must_use]
    pub fn linear_complex(&self) -> Option<LinearComplex<F>> {
        let screw = match self.reciprocal().basis().as_slice() {
            [screw] => screw.clone(),
            _ => return None,
        };
        Some(match (screw.pitch(), screw.foot()) {
            (Some(pitch), Some(foot)) => LinearComplex::General { screw, pitch, foot },
            _ => LinearComplex::Perpendicular(screw.moment),
        })
    }

    /// Whether all screws of the joints are rotations, to rounding.
    fn are_lines(&self) -> bool {
        self.screws.iter().all(|screw| {
            !screw.is_translation() && screw.pitch().is_some_and(|pitch| pitch.pivot_size() <= negligible::<F>())
        })
    }

    /// The rank of the directions of the joints.
    fn directions(&self) -> usize {
        Echelon::of(self.screws.iter().map(|screw| screw.direction.to_vec()).collect(), 3).rank()
    }

    /// The rank of a system of equations without and with its right sides.
    fn ranks(rows: Vec<Vec<F>>) -> (usize, usize) {
        let columns = rows.first().map_or(1, Vec::len);
        let plain = rows.iter().map(|row| row[..columns - 1].to_vec()).collect();
        (Echelon::of(plain, columns - 1).rank(), Echelon::of(rows, columns).rank())
    }

    /// Whether the lines of the joints pass through one point: `p x direction = moment` can be solved.
    fn meet_in_a_point(&self) -> bool {
        let zero = F::zero;
        let rows = self.screws.iter().flat_map(|screw| {
            let ([x, y, z], [u, v, w]) = (screw.direction.clone(), screw.moment.clone());
            [vec![zero(), z.clone(), y.neg(), u], vec![z.neg(), zero(), x.clone(), v], vec![y, x.neg(), zero(), w]]
        });
        let (plain, with) = Self::ranks(rows.collect());
        plain == with
    }

    /// Whether the lines of the joints lie in one plane `n . x = c`: `n x moment = -c direction` and `n . direction = 0`.
    fn lie_in_a_plane(&self) -> bool {
        let rows = self.screws.iter().flat_map(|screw| {
            let ([x, y, z], [u, v, w]) = (screw.direction.clone(), screw.moment.clone());
            let zero = F::zero;
            [
                vec![zero(), w.clone(), v.neg(), x.clone()],
                vec![w.neg(), zero(), u.clone(), y.clone()],
                vec![v, u.neg(), zero(), z.clone()],
                vec![x, y, z, zero()],
            ]
        });
        Echelon::of(rows.collect(), 4).rank() < 4
    }

    /// Describes in words the common property of the joints.
    #[must_use]
    pub fn description(&self) -> String {
        let order = self.order();
        let directions = self.directions();
        let plural = if order == 1 { "" } else { "s" };
        if self.screws.is_empty() {
            return "no joints".to_owned();
        }
        if directions == 0 {
            return format!("translations only, {order} independent direction{plural}");
        }
        let lines = self.are_lines();
        if lines && order == 1 {
            return "all axes coincide".to_owned();
        }
        if lines && directions == 1 {
            return if self.lie_in_a_plane() {
                "all axes are parallel and in one plane".to_owned()
            } else {
                "all axes are parallel, motions in a plane perpendicular to them (planar)".to_owned()
            };
        }
        if lines && self.meet_in_a_point() {
            return if directions == 2 {
                "all axes meet in one point and lie in one plane".to_owned()
            } else {
                "all axes meet in one point, rotations about it (spherical)".to_owned()
            };
        }
        if lines && self.lie_in_a_plane() {
            return "all axes lie in one plane".to_owned();
        }
        if directions == 1 {
            return if order <= 3 && self.is_planar() {
                "rotations about parallel axes and translations perpendicular to them (planar)".to_owned()
            } else {
                format!("rotations about parallel axes and translations, order {order} (of the Schoenflies motions)")
            };
        }
        match (order, self.linear_complex()) {
            (6, _) => "no screw is reciprocal to all joints".to_owned(),
            (5, Some(LinearComplex::Perpendicular(_))) => {
                "all axes are perpendicular to one direction: a constant force would bind none".to_owned()
            }
            (5, Some(LinearComplex::General { pitch, .. })) => {
                if pitch.pivot_size() <= negligible::<F>() {
                    "all axes meet one line (special linear complex)".to_owned()
                } else {
                    "all axes belong to one linear complex".to_owned()
                }
            }
            (4, _) if lines && self.klein_rank() == 4 => "all axes belong to one linear congruence".to_owned(),
            (3, _) if lines && self.klein_rank() == 3 => "all axes belong to one regulus (of a hyperboloid)".to_owned(),
            (3, _) if lines => "all axes belong to two pencils with a line in common".to_owned(),
            (2, _) if lines => "the axes are two skew lines".to_owned(),
            _ => format!("a general system of order {order}"),
        }
    }

    /// Parallel rotations, and translations across them only.
    fn is_planar(&self) -> bool {
        let Some(axis) = self.screws.iter().find(|screw| !screw.is_translation()) else { return false };
        self.screws.iter().all(|screw| dot(&screw.moment, &axis.direction).pivot_size() <= negligible::<F>())
    }

    /// The rank of the Klein form on the system: what kind of set its lines (screws of pitch 0) are.
    fn klein_rank(&self) -> usize {
        let basis = self.basis();
        let row = |a: &Screw<F>| basis.iter().map(|b| a.reciprocal_product(b)).collect();
        Echelon::of(basis.iter().map(row).collect(), basis.len()).rank()
    }

    /// The freedom of the single closed loop of the joints, each with one screw (a C joint with two, an S joint with three).
    ///
    /// `freedom = joints - order`, \[Wittenburg2016, ch. 4\]: Gruebler's count `joints - 6` and the redundant constraints.
    #[must_use]
    pub fn loop_freedom(&self) -> LoopFreedom<F> {
        let joints = self.screws.len();
        let coordinates: Vec<[F; 6]> = self.screws.iter().map(Screw::coordinates).collect();
        let rows = (0..6).map(|k| coordinates.iter().map(|c| c[k].clone()).collect()).collect();
        let rates = Echelon::of(rows, joints).null_space();
        let still = |joint: &usize| rates.iter().all(|rate| rate[*joint].pivot_size() <= negligible::<F>());
        let locked = (0..joints).filter(still).collect();
        let order = self.order();
        LoopFreedom { joints, order, freedom: joints - order, rates, locked, redundant: self.reciprocal() }
    }
}

/// A principal screw of a system: of all screws of the system about, its pitch is stationary.
#[derive(Clone, Debug, PartialEq)]
pub struct PrincipalScrew {
    /// The screw, its direction of length 1.
    pub screw: Screw<f64>,
    /// Its pitch.
    pub pitch: f64,
}

impl ScrewSystem<f64> {
    /// The principal screws by rising pitch, and the number of independent translations in the system (infinite pitch).
    ///
    /// For a system of order 2 they are the two perpendicular, intersecting generators of the cylindroid with its greatest and
    /// least pitch; of order 3 three perpendicular, concurrent screws. The pitches are the roots of
    /// `det(K - p G) = 0` with half the Klein form K and the inner products G of the directions of a basis.
    ///
    /// Translations are divided out first: what is left is the part of the system whose moments are perpendicular to them.
    ///
    /// # Source
    /// \[Ball1900\]; \[Wittenburg2016, ch. 12\].
    #[must_use]
    pub fn principal_screws(&self) -> (Vec<PrincipalScrew>, usize) {
        let basis = self.basis();
        let size = basis.len();
        if size == 0 {
            return (Vec::new(), 0);
        }
        let direction = DMatrix::from_fn(3, size, |k, j| basis[j].direction[k]);
        let moment = DMatrix::from_fn(3, size, |k, j| basis[j].moment[k]);
        // Directions are orthogonal along the eigenvectors of G.
        let gram = finite(direction.transpose() * &direction).symmetric_eigen();
        let largest = gram.eigenvalues.amax();
        let scale = moment.amax().max(direction.amax());
        let is_translation = |k: usize| gram.eigenvalues[k] <= TRANSLATION * largest.max(TRANSLATION * scale * scale);
        let (still, turning): (Vec<usize>, Vec<usize>) = (0..size).partition(|&k| is_translation(k));
        if turning.is_empty() {
            // Translations alone have no principal screws, and matrices without columns no eigenvalues.
            return (Vec::new(), still.len());
        }
        let translations = &moment * gram.eigenvectors.select_columns(&still);
        let unit = DMatrix::from_fn(size, turning.len(), |i, j| {
            gram.eigenvectors[(i, turning[j])] / gram.eigenvalues[turning[j]].sqrt()
        });
        let mut moments = &moment * &unit;
        if !still.is_empty() {
            // A basis of the span of the translations, to take its part out of the moments.
            let span = finite(translations).svd(true, false);
            if let Some(u) = span.u {
                moments -= &u * (u.transpose() * &moments);
            }
        }
        let directions = &direction * &unit;
        let form = directions.transpose() * &moments;
        let pitches = finite((&form + form.transpose()) * 0.5).symmetric_eigen();
        let (directions, moments) = (directions * &pitches.eigenvectors, moments * &pitches.eigenvectors);
        let column = |m: &DMatrix<f64>, j: usize| std::array::from_fn(|k| m[(k, j)]);
        let mut found: Vec<PrincipalScrew> = (0..turning.len())
            .map(|j| PrincipalScrew {
                screw: Screw { direction: column(&directions, j), moment: column(&moments, j) },
                pitch: pitches.eigenvalues[j],
            })
            .collect();
        sort::by(&mut found, |a, b| a.pitch.total_cmp(&b.pitch));
        (found, still.len())
    }
}
