//! Linkages in the plane: their data in the one form of certificates, and the sums of vectors round their loops, which are 0.

use super::chain::are_far;
use super::data::primitive;
use super::enclosing::Enclosing;
use super::fault::{Fault, refused, unreadable};
use super::isolation::{Closure, Point, all};
use super::mode::Ball;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::ring::Ring;
use crate::catalogue::{LinkageCase, LinkageFile, root};
use crate::kinematics::linkage::{Accuracy, Gaussian, Given, Linkage, Pair};
use rug::{Integer, Rational};
use serde_json::{Map, Value, json};

/// Number of unknowns for which equations are written: those that a linkage lacks are held at 0. Linkages of four loops have more
/// monomials than a checker takes.
pub(super) const UNKNOWNS: usize = 6;

/// The closure equations of a linkage in the plane.
pub struct LinkageClosure {
    /// For every loop the coefficient of each column: the ground, the other classes of bodies that keep their directions against each
    /// other, the slides.
    pub(super) loops: Vec<Vec<Gaussian>>,
    /// Number of classes, that of the ground among them.
    pub(super) classes: usize,
    /// The class in which the line of each slide is fixed.
    pub(super) slides: Vec<usize>,
    /// The coefficients of [`Self::loops`], real and imaginary part.
    enclosed: Vec<Vec<[Enclosure; 2]>>,
    /// The first body of each class.
    bodies: Vec<usize>,
    /// The joints of the slides, and the length in which distances are counted.
    joints: Vec<(usize, f64)>,
}

pub(super) fn mirrored(z: &Gaussian) -> Gaussian {
    Gaussian { re: z.re.clone(), im: Rational::from(-&z.im) }
}

pub(super) fn scaled(z: &Gaussian, factor: &Rational) -> Gaussian {
    Gaussian { re: Rational::from(&z.re * factor), im: Rational::from(&z.im * factor) }
}

/// Returns the whole numbers without a common factor in the ratio of the coordinates.
fn whole(direction: &Gaussian) -> Gaussian {
    let [re, im, _] = primitive(&[direction.re.clone(), direction.im.clone(), Rational::new()]).map(Rational::from);
    Gaussian { re, im }
}

pub(super) fn square(z: &Gaussian) -> Rational {
    Rational::from(z.re.square_ref()) + Rational::from(z.im.square_ref())
}

/// Returns a ball with the unknowns that a linkage lacks.
fn padded(ball: &Ball) -> Ball {
    let mut ball = ball.clone();
    ball.centre.resize(UNKNOWNS, (Rational::new(), Rational::new()));
    ball
}

/// Returns the bodies in the order in which the joints name them, the ground first.
fn numbered(linkage: &Linkage) -> Vec<usize> {
    let mut order = vec![linkage.ground];
    for body in linkage.joints.iter().flat_map(|joint| joint.of) {
        if !order.contains(&body) {
            order.push(body);
        }
    }
    order
}

/// Returns the data of a case of a linkage.
///
/// # Errors
/// A clause that says why there is no certificate.
pub fn data_of_linkage(file: &LinkageFile, case: &LinkageCase) -> Result<Value, String> {
    if file.accuracy(case) != Accuracy::Exact {
        return Err("linkages with irrational numbers are not covered".to_owned());
    }
    let linkage = &file.linkage;
    let order = numbered(linkage);
    let name = |body: usize| order.iter().position(|own| *own == body).unwrap_or_default().to_string();
    let texts = |z: &Gaussian| json!([z.re.to_string(), z.im.to_string()]);
    let mut origins: Vec<Option<&Gaussian>> = vec![None; linkage.bodies.len()];
    let mut bodies: Vec<Map<String, Value>> = vec![Map::new(); order.len()];
    let mut joints = Vec::new();
    for (index, joint) in linkage.joints.iter().enumerate() {
        let own = (index + 1).to_string();
        for (body, at) in joint.of.iter().zip(&joint.at) {
            let point = at.sub(origins[*body].get_or_insert(at));
            let place = order.iter().position(|one| one == body).unwrap_or_default();
            bodies[place].insert(own.clone(), texts(&point));
        }
        let of = joint.of.map(name);
        joints.push(match &joint.pair {
            Pair::Revolute => json!({ "name": own, "type": "R", "of": of }),
            Pair::Prismatic { turn, along, .. } => {
                let lines = [whole(along), whole(&along.mul(&mirrored(turn)))];
                json!({ "name": own, "type": "P", "of": of, "along": lines.each_ref().map(texts) })
            }
            Pair::Gear { .. } => return Err("linkages with gears are not covered".to_owned()),
        });
    }
    let mut given = Map::new();
    let mut values: Vec<&Given> = case.given.iter().collect();
    values.sort_by_key(|one| one.joint());
    for one in values {
        let (joint, value) = match one {
            Given::Turn { joint, turn, .. } if turn.re == -1 => (joint, json!({ "tan_half": "inf" })),
            Given::Turn { joint, turn, .. } => {
                let half = turn.im.clone() / Rational::from(&turn.re + 1);
                (joint, json!({ "tan_half": half.to_string() }))
            }
            Given::Shift { joint, shift, .. } => {
                let Pair::Prismatic { along, .. } = &linkage.joints[*joint].pair else {
                    return Err("a distance of a joint that turns is given".to_owned());
                };
                let distance = Rational::from(shift * &root(&square(along)).0);
                (joint, json!({ "distance": distance.to_string() }))
            }
            Given::Place { .. } => return Err("places of bodies as inputs are not covered".to_owned()),
        };
        given.insert((joint + 1).to_string(), value);
    }
    let bodies: Map<String, Value> =
        bodies.into_iter().enumerate().map(|(place, points)| (place.to_string(), Value::Object(points))).collect();
    let mechanism = json!({ "kind": "linkage", "space": "plane", "ground": "0", "joints": joints, "bodies": bodies });
    Ok(if given.is_empty() {
        json!({ "mechanism": mechanism })
    } else {
        json!({ "mechanism": mechanism, "input": [{ "given": given }] })
    })
}

/// The vector from the origin of one body to that of another, by columns; a slide stands with its index behind the classes.
struct Step {
    of: [usize; 2],
    vector: Vec<Gaussian>,
}

/// Bodies that keep their directions against each other: the rotation of the second is that of the first times a number.
type Kept = ([usize; 2], Gaussian);

/// The class of each body with its rotation against that of the class, and the first body of each class.
type Classes = (Vec<(usize, Gaussian)>, Vec<usize>);

/// Returns the classes of bodies that keep their directions against each other.
fn classes(order: &[usize], kept: &[Kept]) -> Result<Classes, Fault> {
    let mut own: Vec<Option<(usize, Gaussian)>> = vec![None; order.len()];
    let mut first = Vec::new();
    for &body in order {
        if own[body].is_some() {
            continue;
        }
        own[body] = Some((first.len(), Gaussian::one()));
        first.push(body);
        for _ in kept {
            for ([a, b], turn) in kept {
                for (one, other, by) in [(*a, *b, turn.clone()), (*b, *a, mirrored(turn))] {
                    if let (Some((class, at)), None) = (&own[one], &own[other]) {
                        own[other] = Some((*class, at.mul(&by)));
                    }
                }
            }
        }
    }
    let own: Vec<(usize, Gaussian)> = own.into_iter().flatten().collect();
    if kept.iter().any(|([a, b], turn)| own[*a].1.mul(turn) != own[*b].1) {
        return refused("data: joints that keep directions contradict each other");
    }
    Ok((own, first))
}

/// Returns whether the bodies hang together without a joint.
fn is_connected(linkage: &Linkage, but: usize) -> bool {
    let mut seen = vec![false; linkage.bodies.len()];
    seen[linkage.ground] = true;
    for _ in &linkage.bodies {
        for (_, joint) in linkage.joints.iter().enumerate().filter(|(index, _)| *index != but) {
            let [a, b] = joint.of;
            (seen[a], seen[b]) = (seen[a] || seen[b], seen[a] || seen[b]);
        }
    }
    seen.into_iter().all(|one| one)
}

impl LinkageClosure {
    /// Returns the equations of a case.
    ///
    /// # Errors
    /// [`Fault`] for linkages that are not covered.
    pub fn of(linkage: &Linkage, given: &[Given]) -> Result<Self, Fault> {
        if linkage.bodies.len() > MOST_BODIES || linkage.joints.len() > MOST_JOINTS {
            return refused(format!("data: more than {MOST_BODIES} bodies or {MOST_JOINTS} joints"));
        }
        if !(0..linkage.joints.len()).all(|but| is_connected(linkage, but)) {
            return refused("data: a joint is in no loop");
        }
        let (mut kept, mut joints): (Vec<Kept>, Vec<(usize, f64)>) = (Vec::new(), Vec::new());
        let mut points: Vec<[Gaussian; 2]> = linkage.joints.iter().map(|joint| joint.at.clone()).collect();
        for (index, joint) in linkage.joints.iter().enumerate() {
            let value = given.iter().find(|one| one.joint() == Some(index));
            match (&joint.pair, value) {
                (Pair::Revolute, None) => {}
                (Pair::Revolute, Some(Given::Turn { turn, .. })) => kept.push((joint.of, turn.clone())),
                (Pair::Prismatic { turn, along, .. }, None) => {
                    kept.push((joint.of, turn.clone()));
                    joints.push((index, square(&whole(along)).to_f64().sqrt()));
                }
                (Pair::Prismatic { turn, along, .. }, Some(Given::Shift { shift, .. })) => {
                    kept.push((joint.of, turn.clone()));
                    points[index][0] = points[index][0].add(&scaled(along, shift));
                }
                _ => return refused("data: gears, or a value of another kind than that of its joint"),
            }
        }
        let order = numbered(linkage);
        if order.len() != linkage.bodies.len() {
            return refused("data: a body has no joint");
        }
        let (own, bodies) = classes(&order, &kept)?;
        let count = bodies.len() + joints.len();
        let mut steps: Vec<Step> = Vec::new();
        let mut slides = Vec::new();
        for (index, joint) in linkage.joints.iter().enumerate() {
            let mut vector = vec![Gaussian::zero(); count];
            let [(c, turn), (d, other)] = joint.of.map(|body| &own[body]);
            vector[*c] = vector[*c].add(&turn.mul(&points[index][0]));
            vector[*d] = vector[*d].sub(&other.mul(&points[index][1]));
            if let (Pair::Prismatic { along, .. }, true) = (&joint.pair, joints.iter().any(|(one, _)| *one == index)) {
                vector[bodies.len() + slides.len()] = turn.mul(&whole(along));
                slides.push(*c);
            }
            steps.push(Step { of: joint.of, vector });
        }
        let loops = loops(linkage, steps, count)?;
        if count - 1 != 2 * loops.len() || count > UNKNOWNS + 1 {
            let (unknowns, equations) = (count - 1, 2 * loops.len());
            return refused(format!(
                "closure: {unknowns} unknowns in {equations} equations, where at most {UNKNOWNS} and as many are covered"
            ));
        }
        let part = |z: &Gaussian| [Enclosure::of(&z.re), Enclosure::of(&z.im)];
        let enclosed = loops.iter().map(|own| own.iter().map(part).collect()).collect();
        Ok(Self { loops, classes: bodies.len(), slides, enclosed, bodies, joints })
    }

    /// Returns the number of unknowns.
    pub(super) fn size(&self) -> usize {
        2 * self.loops.len()
    }

    /// Returns the unknowns among the angles of all bodies and the values of all joints.
    pub fn unknowns<T: Copy + std::ops::Div<f64, Output = T>>(
        &self,
        angles: &dyn Fn(usize) -> T,
        joints: &dyn Fn(usize) -> Option<T>,
    ) -> Option<Vec<T>> {
        let turns = self.bodies[1..].iter().map(|body| Some(angles(*body)));
        turns.chain(self.joints.iter().map(|(joint, length)| Some(joints(*joint)? / *length))).collect()
    }

    /// Proves that balls hold one solution each, and that these are different.
    pub(super) fn proved(&self, balls: &[Ball]) -> Result<(), Fault> {
        let size = self.size();
        if let Some(at) = balls.iter().position(|ball| ball.centre.len() != size) {
            let found = balls[at].centre.len();
            return unreadable(format!("mode {}: found {found} unknowns, expected {size}", at + 1));
        }
        all(self, &balls.iter().map(padded).collect::<Vec<_>>())
    }

    /// Returns the factors of all columns: cosine and sine of a class, those of a slide times its distance. Where an unknown is named, they
    /// are the derivatives by it.
    fn factors<S: Enclosing>(&self, point: &Point<S>, by: Option<usize>) -> Vec<[S; 2]> {
        let zero = || [S::zero(), S::zero()];
        let turn = |class: usize, is_derivative: bool| match class.checked_sub(1) {
            None if is_derivative => zero(),
            None => [S::one(), S::zero()],
            Some(k) => match &point.turns[k] {
                Some((cos, sin)) if is_derivative => [sin.neg(), cos.clone()],
                Some((cos, sin)) => [cos.clone(), sin.clone()],
                None => zero(),
            },
        };
        let is_by = |class: usize| by.is_none_or(|k| class == k + 1);
        let classes = (0..self.classes).map(|class| if is_by(class) { turn(class, by.is_some()) } else { zero() });
        let slides = self.slides.iter().enumerate().map(|(k, class)| {
            let at = self.classes - 1 + k;
            if by == Some(at) {
                return turn(*class, false);
            }
            if !is_by(*class) {
                return zero();
            }
            turn(*class, by.is_some()).map(|part| part.mul(&point.x[at]))
        });
        classes.chain(slides).collect()
    }
}

/// Returns the sums round all loops, coordinates x and y in turn.
fn sums<S: Enclosing>(loops: &[Vec<[S; 2]>], factors: &[[S; 2]]) -> Vec<S> {
    let sum = |own: &Vec<[S; 2]>| {
        own.iter().zip(factors).fold([S::zero(), S::zero()], |[x, y], ([a, b], [cos, sin])| {
            [x.add(&a.mul(cos)).sub(&b.mul(sin)), y.add(&a.mul(sin)).add(&b.mul(cos))]
        })
    };
    loops.iter().flat_map(sum).collect()
}

/// Maximum number of bodies: with six unknowns the others are held by inputs.
const MOST_BODIES: usize = 50;
/// Maximum number of joints: those of so many bodies and three loops are fewer.
const MOST_JOINTS: usize = 100;

/// Returns the sums round the loops that joints outside a tree of bodies close.
fn loops(linkage: &Linkage, mut steps: Vec<Step>, count: usize) -> Result<Vec<Vec<Gaussian>>, Fault> {
    let mut origins: Vec<Option<Vec<Gaussian>>> = vec![None; linkage.bodies.len()];
    origins[linkage.ground] = Some(vec![Gaussian::zero(); count]);
    let each = |one: &[Gaussian], other: &[Gaussian], with: fn(&Gaussian, &Gaussian) -> Gaussian| {
        one.iter().zip(other).map(|(x, y)| with(x, y)).collect::<Vec<_>>()
    };
    for _ in 0..linkage.bodies.len() {
        steps.retain(|Step { of: [a, b], vector }| match (&origins[*a], &origins[*b]) {
            (Some(from), None) => {
                origins[*b] = Some(each(from, vector, Ring::add));
                false
            }
            (None, Some(from)) => {
                origins[*a] = Some(each(from, vector, Ring::sub));
                false
            }
            _ => true,
        });
    }
    let closed = steps.iter().map(|Step { of: [a, b], vector }| {
        let (Some(a), Some(b)) = (&origins[*a], &origins[*b]) else { return refused("data: a body has no joint") };
        Ok(each(&each(a, vector, Ring::add), b, Ring::sub))
    });
    closed.collect()
}

impl Closure<UNKNOWNS> for LinkageClosure {
    type Constants<S: Enclosing> = Vec<Vec<[S; 2]>>;

    fn constants<S: Enclosing>(&self) -> Vec<Vec<[S; 2]>> {
        self.enclosed.iter().map(|own| own.iter().map(|pair| pair.each_ref().map(S::of)).collect()).collect()
    }

    fn angles(&self) -> [bool; UNKNOWNS] {
        std::array::from_fn(|k| k + 1 < self.classes)
    }

    fn values<S: Enclosing>(&self, loops: &Vec<Vec<[S; 2]>>, point: &Point<S>) -> [S; UNKNOWNS] {
        let sums = sums(loops, &self.factors(point, None));
        std::array::from_fn(|k| sums.get(k).unwrap_or(&point.x[k]).clone())
    }

    /// Every zero of the equations closes all loops.
    fn slope<S: Enclosing>(&self, loops: &Vec<Vec<[S; 2]>>, point: &Point<S>) -> ([[S; UNKNOWNS]; UNKNOWNS], bool) {
        let columns: Vec<Vec<S>> = (0..self.size()).map(|k| sums(loops, &self.factors(point, Some(k)))).collect();
        let slope = std::array::from_fn(|row| {
            std::array::from_fn(|k| match columns.get(k).and_then(|column| column.get(row)) {
                Some(slope) => slope.clone(),
                None if row == k => S::one(),
                None => S::zero(),
            })
        });
        (slope, true)
    }

    fn are_apart(&self, one: &Ball, other: &Ball) -> bool {
        let radius = Rational::from(&one.radius + &other.radius);
        (0..UNKNOWNS).any(|k| {
            let ((x, y), (u, v)) = (&one.centre[k], &other.centre[k]);
            are_far((Rational::from(x - u), Rational::from(y - v)), (k + 1 < self.classes).then_some(0), &radius)
        })
    }
}

/// Returns the exponents of the unknowns in a column: theta of a class, or a distance times theta of its class.
pub(super) fn exponents(closure: &LinkageClosure, column: usize) -> [i8; UNKNOWNS] {
    let class = if column < closure.classes { column } else { closure.slides[column - closure.classes] };
    std::array::from_fn(|k| i8::from(k + 1 == class || (k + 1 == column && column >= closure.classes)))
}

/// Returns the elimination of rows in this order of columns, and the places of the pivots in it.
pub(super) fn eliminated(loops: &[Vec<Gaussian>], order: &[usize]) -> (Vec<Vec<Gaussian>>, Vec<usize>) {
    let (mut rows, mut pivots) = (loops.to_vec(), Vec::new());
    for (place, &column) in order.iter().enumerate() {
        let next = pivots.len();
        let Some(found) = (next..rows.len()).find(|row| !rows[*row][column].is_zero()) else { continue };
        rows.swap(next, found);
        let norm = square(&rows[next][column]);
        let scale = scaled(&mirrored(&rows[next][column]), &norm.recip());
        let pivot: Vec<Gaussian> = rows[next].iter().map(|x| x.mul(&scale)).collect();
        for (at, row) in rows.iter_mut().enumerate() {
            if at == next {
                row.clone_from(&pivot);
            } else if !row[column].is_zero() {
                let factor = row[column].clone();
                *row = row.iter().zip(&pivot).map(|(x, y)| x.sub(&factor.mul(y))).collect();
            }
        }
        pivots.push(place);
    }
    (rows, pivots)
}

/// Returns the remainder of a rational number modulo a prime; `None` if its denominator is divisible by it.
pub(super) fn modulo(x: &Rational, prime: u32) -> Option<u64> {
    let modulus = Integer::from(prime);
    let below = x.denom().clone().invert(&modulus).ok()?;
    Some(u64::from((below * x.numer()).mod_u(prime)))
}
