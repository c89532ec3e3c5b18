//! The conditions that the positions impose on a dyad, as polynomials over any ring.

use super::cells::{Place, Shape};
use crate::algebra::dual::Dual;
use crate::algebra::ring::Ring;
use crate::catalogue::{DyadKind, Space};
use crate::kinematics::motion::{Motion, Vector, cross, dot};
use looproot_calculus::rotation::matrix::from_matrix;
use rug::Rational;

/// A dyad and the positions that its body shall take.
#[derive(Clone, Debug)]
pub(super) struct Wanted {
    pub kind: DyadKind,
    pub space: Space,
    pub positions: Vec<Motion<Rational>>,
    /// Motions of the body at some positions, with dual parts that are rates. RR dyads in the plane only.
    pub rates: Vec<Motion<Dual<Rational>>>,
    /// The number of solutions of the equations that are always there and are no dyads.
    pub trivial: usize,
}

/// A line by its direction and its moment, both to the same scale.
#[derive(Clone, Debug)]
pub(super) struct Line<R> {
    pub direction: Vector<R>,
    pub moment: Vector<R>,
}

fn lifted<R: Ring>(motion: &Motion<Rational>) -> Motion<R> {
    let image = |q: &Rational| R::from_rational(q).unwrap_or_else(R::zero);
    Motion {
        rotation: motion.rotation.each_ref().map(|row| row.each_ref().map(image)),
        translation: motion.translation.each_ref().map(image),
    }
}

fn turned<R: Ring>(motion: &Motion<R>, v: &Vector<R>) -> Vector<R> {
    motion.rotation.each_ref().map(|row| dot(row, v))
}

fn moved<R: Ring>(motion: &Motion<R>, point: &Vector<R>) -> Vector<R> {
    let turned = turned(motion, point);
    std::array::from_fn(|k| turned[k].add(&motion.translation[k]))
}

impl Line<Rational> {
    /// The unknowns of two lines: two directions, two moments.
    fn shape() -> Shape {
        Shape { directions: vec![3, 3], numbers: 6 }
    }
}

impl<R: Ring> Line<R> {
    fn of(direction: &[R], moment: &[R]) -> Self {
        Self { direction: vector(direction), moment: vector(moment) }
    }

    /// The line where a motion takes it.
    pub fn moved(&self, motion: &Motion<R>) -> Self {
        let (direction, moment) = (turned(motion, &self.direction), turned(motion, &self.moment));
        let shift = cross(&motion.translation, &direction);
        Self { direction, moment: std::array::from_fn(|k| moment[k].add(&shift[k])) }
    }

    /// The dual part of the product of two lines.
    pub fn reciprocal(&self, other: &Self) -> R {
        dot(&self.moment, &other.direction).add(&dot(&self.direction, &other.moment))
    }
}

/// Three numbers of a slice, 0 for those that are missing.
pub(super) fn vector<R: Ring>(numbers: &[R]) -> Vector<R> {
    std::array::from_fn(|k| numbers.get(k).cloned().unwrap_or_else(R::zero))
}

/// Numbers of an RR dyad in space beside the direction of its fixed axis: see [`Skew`].
const SKEW: usize = 7;

/// Two skew axes: g of the fixed one, and of the moving one w and the foot Q of the common perpendicular, both in the body. The
/// length of w is such that at every position `P = R Q + t + g x R w` is the foot on the fixed axis, always the same.
///
/// Every pair of skew axes has this form. It is without its twist angle and distance, whose signs belong together.
pub(super) struct Skew<R> {
    pub fixed: Vector<R>,
    pub moving: Vector<R>,
    pub foot: Vector<R>,
    /// The inverse of `(g.g)(w.w)`: complex vectors of length 0 are no axes.
    inverse: R,
}

impl<R: Ring> Skew<R> {
    /// The axes of the unknowns of a place.
    pub fn of(place: &Place<R>) -> Self {
        let (moving, rest) = place.numbers.split_at(3);
        let inverse = rest.get(3).cloned().unwrap_or_else(R::zero);
        Self { fixed: vector(&place.directions[0]), moving: vector(moving), foot: vector(&rest[..3]), inverse }
    }

    /// The foot on the fixed axis at a position.
    pub fn fixed_foot(&self, motion: &Motion<R>) -> Vector<R> {
        let across = cross(&self.fixed, &turned(motion, &self.moving));
        let foot = moved(motion, &self.foot);
        std::array::from_fn(|k| foot[k].add(&across[k]))
    }

    /// Feet and twist angle are the same at all positions.
    fn equations(&self, motions: &[Motion<R>]) -> Vec<R> {
        let mut all = constant(motions.iter().map(|motion| dot(&self.fixed, &turned(motion, &self.moving))));
        for k in 0..3 {
            all.extend(constant(motions.iter().map(|motion| self.fixed_foot(motion)[k].clone())));
        }
        let lengths = dot(&self.fixed, &self.fixed).mul(&dot(&self.moving, &self.moving));
        all.push(lengths.mul(&self.inverse).sub(&R::one()));
        all
    }
}

impl Wanted {
    /// The number of coordinates of a point.
    pub fn width(&self) -> usize {
        if self.space == Space::Plane { 2 } else { 3 }
    }

    /// Returns the shape of the unknowns: for RR and SS the fixed and the moving point, for PR and PPS the normal of the line or
    /// plane and the moving point, for RP the normal of the moving line and the fixed point, on the sphere both axes, for CC both
    /// lines; for RR in space see [`Skew`].
    pub fn shape(&self) -> Shape {
        let width = self.width();
        match (self.kind, self.space) {
            (DyadKind::RR, Space::Sphere) => Shape { directions: vec![3, 3], numbers: 0 },
            (DyadKind::RR, Space::Space) => Shape { directions: vec![3], numbers: SKEW },
            (DyadKind::RR | DyadKind::SS, _) => Shape { directions: Vec::new(), numbers: 2 * width },
            (DyadKind::PR | DyadKind::RP | DyadKind::PPS, _) => Shape { directions: vec![width], numbers: width },
            (DyadKind::CC, _) => Line::shape(),
        }
    }

    /// The dimension of the family of dyads in general, negative where the positions are too many.
    pub fn freedom(&self) -> i64 {
        let shape = self.shape();
        let unknowns = shape.directions.iter().map(|size| size - 1).sum::<usize>() + shape.numbers;
        // Conditions of every further position, and of the unknowns among themselves.
        let (each, own) = match (self.kind, self.space) {
            (DyadKind::RR, Space::Space) => (4, 1),
            (DyadKind::CC, _) => (2, 2),
            _ => (1, 0),
        };
        let conditions = each * (self.positions.len() - 1) + self.rates.len() + own;
        i64::try_from(unknowns).unwrap_or(i64::MAX) - i64::try_from(conditions).unwrap_or(i64::MAX)
    }

    /// The number of dyads through general positions, where they are finitely many.
    ///
    /// # Source
    /// McCarthy and Soh 2011, Geometric design of linkages, chapters 5, 7 and 12.
    pub fn general_count(&self) -> Option<usize> {
        if self.freedom() != 0 {
            return None;
        }
        let count: usize = match (self.kind, self.space) {
            (DyadKind::RR, Space::Sphere | Space::Space) | (DyadKind::CC, _) => 6,
            (DyadKind::RR, _) => 4,
            (DyadKind::PR | DyadKind::RP, _) => 1,
            (DyadKind::SS, _) => 20,
            (DyadKind::PPS, _) => 10,
        };
        Some(count - self.trivial)
    }

    /// Returns the polynomials that vanish for a dyad that takes all positions.
    pub fn equations<R: Ring>(&self, place: &Place<R>) -> Vec<R> {
        let motions: Vec<Motion<R>> = self.positions.iter().map(lifted).collect();
        let width = self.width();
        match (self.kind, self.space) {
            (DyadKind::RR, Space::Sphere) => {
                let (fixed, moving) = (vector(&place.directions[0]), vector(&place.directions[1]));
                constant(motions.iter().map(|motion| dot(&fixed, &turned(motion, &moving))))
            }
            (DyadKind::RR, Space::Space) => Skew::of(place).equations(&motions),
            (DyadKind::RR | DyadKind::SS, _) => {
                let (fixed, moving) = (vector(&place.numbers[..width]), vector(&place.numbers[width..]));
                let mut all = constant(motions.iter().map(|motion| square_of_link(motion, &fixed, &moving)));
                all.extend(self.rates.iter().map(|motion| rate_of_link(motion, &fixed, &moving)));
                all
            }
            (DyadKind::PR | DyadKind::PPS, _) => {
                let (normal, moving) = (vector(&place.directions[0]), vector(&place.numbers));
                constant(motions.iter().map(|motion| dot(&normal, &moved(motion, &moving))))
            }
            (DyadKind::RP, _) => {
                // The same with the roles of the bodies exchanged: `m . R^T (a - t)`.
                let (normal, fixed) = (vector(&place.directions[0]), vector(&place.numbers));
                constant(motions.iter().map(|motion| {
                    let from: Vector<R> = std::array::from_fn(|k| fixed[k].sub(&motion.translation[k]));
                    dot(&turned(motion, &normal), &from)
                }))
            }
            (DyadKind::CC, _) => {
                let fixed = Line::of(&place.directions[0], &place.numbers[..3]);
                let moving = Line::of(&place.directions[1], &place.numbers[3..]);
                let lines: Vec<Line<R>> = motions.iter().map(|motion| moving.moved(motion)).collect();
                let mut all = constant(lines.iter().map(|line| dot(&fixed.direction, &line.direction)));
                all.extend(constant(lines.iter().map(|line| fixed.reciprocal(line))));
                all.extend([&fixed, &moving].map(|line| dot(&line.direction, &line.moment)));
                all
            }
        }
    }

    /// For CC dyads, returns the conditions on the directions only: those of a spherical RR dyad.
    pub fn directions(&self) -> Self {
        Self { kind: DyadKind::RR, space: Space::Sphere, ..self.clone() }
    }

    /// Whether some two positions differ by a screw with an angle and a translation: axes that meet or are parallel do not take a body
    /// through such positions.
    pub fn needs_skew_axes(&self) -> bool {
        self.positions.iter().enumerate().any(|(k, one)| {
            let back = one.inverse();
            self.positions[..k].iter().any(|other| {
                let relative = other.then_after(&back);
                dot(&from_matrix(&relative.rotation).vector, &relative.translation) != 0
            })
        })
    }

    /// The first position over another ring.
    pub fn first<R: Ring>(&self) -> Motion<R> {
        lifted(&self.positions[0])
    }

    /// A point of the body in its first position.
    pub fn start<R: Ring>(&self, point: &Vector<R>) -> Vector<R> {
        moved(&self.first(), point)
    }

    /// A direction of the body in its first position.
    pub fn start_direction<R: Ring>(&self, direction: &Vector<R>) -> Vector<R> {
        turned(&self.first(), direction)
    }
}

/// `|R b + t - a|^2 - a.a - b.b`, which is linear in a and in b.
fn square_of_link<R: Ring>(motion: &Motion<R>, fixed: &Vector<R>, moving: &Vector<R>) -> R {
    let turned = turned(motion, moving);
    let t = &motion.translation;
    let linear = dot(t, &turned).sub(&dot(fixed, t)).sub(&dot(fixed, &turned));
    dot(t, t).add(&linear).add(&linear)
}

/// The rate of the same, half the square of a distance, as the body leaves a position.
fn rate_of_link<R: Ring>(motion: &Motion<Dual<Rational>>, fixed: &Vector<R>, moving: &Vector<R>) -> R {
    let image = |q: &Rational| R::from_rational(q).unwrap_or_else(R::zero);
    let both = |q: &Dual<Rational>| Dual { value: image(&q.value), epsilon: image(&q.epsilon) };
    let motion = Motion {
        rotation: motion.rotation.each_ref().map(|row| row.each_ref().map(both)),
        translation: motion.translation.each_ref().map(both),
    };
    let still = |v: &Vector<R>| v.each_ref().map(|c| Dual::constant(c.clone()));
    square_of_link(&motion, &still(fixed), &still(moving)).epsilon
}

/// Returns the differences that vanish if all values are equal.
fn constant<R: Ring>(values: impl Iterator<Item = R>) -> Vec<R> {
    let values: Vec<R> = values.collect();
    values.iter().skip(1).map(|value| value.sub(&values[0])).collect()
}
