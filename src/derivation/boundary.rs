//! The surface that bounds the work space of a point of an open chain with three variables, or of two cylindrical joints.
//!
//! A point of a chain of three variables fills a space. At its boundary, and at other singular positions, the map from the
//! second and third variable to the two invariants of the first joint has no inverse. The second variable is eliminated from the
//! invariants; what remains has a double root in the third variable, or an extreme value of the second one. \[Wittenburg2016, 7.1\]

use super::surface::{Space, Surface, scaled};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::resultant::resultant;
use crate::algebra::ring::{Domain, Ring};
use crate::error::{Error, Result};
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::motion::{Motion, Vector, cross, dot};
use rug::Rational;

/// Places of the two invariants and of the third variable among the variables of polynomials: the half-angle tangent of a rotation,
/// or the displacement.
const INVARIANTS: [usize; 2] = [0, 1];
const THIRD: usize = 2;

fn constant(q: &Rational) -> Space {
    Polynomial::constant(q.clone())
}

/// The position in front of the third variable: `point/denominator`, and its square `square/denominator`.
struct Reached {
    denominator: Space,
    point: Vector<Space>,
    square: Space,
}

impl Reached {
    /// The point `p` behind the third variable, seen in front of the constant before it.
    fn of(variable: Variable, link: &Motion<Rational>, p: &Vector<Rational>) -> Self {
        let t = Space::variable(THIRD);
        let one: Space = Ring::one();
        let square = t.mul(&t);
        let [x, y, z] = p.each_ref().map(constant);
        let (denominator, own) = match variable {
            // (1 + t^2) Rot p
            Variable::Rotation => {
                let (cos, sin) = (one.sub(&square), t.add(&t));
                let full = one.add(&square);
                let own = [cos.mul(&x).sub(&sin.mul(&y)), sin.mul(&x).add(&cos.mul(&y)), full.mul(&z)];
                (full, own)
            }
            Variable::Translation => (one, [x, y, z.add(&t)]),
        };
        let shift = link.translation.each_ref().map(|c| denominator.mul(&constant(c)));
        let point = std::array::from_fn(|i| {
            let row = link.rotation[i].each_ref().map(constant);
            dot(&row, &own).add(&shift[i])
        });
        // |o + R p|^2 = o.o + p.p + 2 (R^T o).p, where p.p is constant in a rotation.
        let back = link.inverse().rotate(&link.translation).each_ref().map(constant);
        let length = match variable {
            Variable::Rotation => scaled(&denominator, &dot(p, p)),
            Variable::Translation => dot(&own, &own),
        };
        let twice = scaled(&dot(&back, &own), &Rational::from(2));
        let square = scaled(&denominator, &dot(&link.translation, &link.translation)).add(&length).add(&twice);
        Self { denominator, point, square }
    }

    /// `a.point` for a vector of numbers.
    fn along(&self, a: &Vector<Rational>) -> Space {
        dot(&a.each_ref().map(constant), &self.point)
    }
}

/// Returns the bounding surface of a point on a chain of three variables; `tool` is applied to the point already.
///
/// # Errors
/// For chains whose points move on surfaces or reach everything.
pub(super) fn of_three(
    variables: &[Variable],
    [base, first, second]: [&Motion<Rational>; 3],
    p: &Vector<Rational>,
) -> Result<Surface> {
    let reached = Reached::of(variables[2], second, p);
    let d = &reached.denominator;
    let rows = &first.rotation;
    let o = &first.translation;
    let column = |j: usize| -> Vector<Rational> { std::array::from_fn(|i| rows[i][j].clone()) };
    // The offset of the second joint in its own axes.
    let own = first.inverse().rotate(o);
    let invariants = INVARIANTS.map(Space::variable);
    let mut steps = vec![match variables[0] {
        Variable::Rotation => "the first joint keeps the height along its axis and the distance from a point of it",
        Variable::Translation => "the first joint keeps the two coordinates across its direction",
    }];
    let two = Rational::from(2);
    // Each invariant without the part of the second variable, times the denominator.
    let height = |i: usize| reached.along(&rows[i]).add(&scaled(d, &o[i]));
    let distance = || reached.square.add(&scaled(&reached.along(&own), &two)).add(&scaled(d, &dot(o, o)));
    // Of a rotation the part along its axis only, with the square, belongs to what the second variable leaves alone.
    let axis: Vector<Rational> = [Rational::new(), Rational::new(), Rational::from(1)];
    let along_axis = reached.along(&axis);
    let found = match variables[1] {
        Variable::Rotation => {
            let kept = |i: usize| scaled(&along_axis, &rows[i][2]).add(&scaled(d, &o[i]));
            let (parts, matrix) = match variables[0] {
                Variable::Rotation => {
                    let square = reached.square.add(&scaled(d, &dot(o, o)));
                    let square = square.add(&scaled(&along_axis, &Rational::from(&own[2] * &two)));
                    let double = |c: &Rational| Rational::from(c * &two);
                    ([kept(2), square], [[rows[2][0].clone(), rows[2][1].clone()], [double(&own[0]), double(&own[1])]])
                }
                Variable::Translation => (
                    [kept(0), kept(1)],
                    [[rows[0][0].clone(), rows[0][1].clone()], [rows[1][0].clone(), rows[1][1].clone()]],
                ),
            };
            // (x^2 + y^2) d^2 of the vector that the second joint turns.
            let turned = reached.square.mul(d).sub(&along_axis.mul(&along_axis));
            of_turn(d, &invariants, &parts, &matrix, &turned, &mut steps)
        }
        Variable::Translation => {
            let direction = column(2);
            match variables[0] {
                Variable::Rotation => {
                    let parts = [height(2), distance()];
                    let slope = scaled(d, &own[2]).add(&along_axis);
                    of_slide(d, &invariants, &parts, &direction[2], &slope, &mut steps)
                }
                Variable::Translation => {
                    let parts = [height(0), height(1)];
                    let [a, b] = [direction[1].clone(), Rational::from(-&direction[0])];
                    if a == 0 && b == 0 {
                        return Err(none());
                    }
                    let free = combination(d, &invariants, &parts, &[a, b]);
                    steps.push("a combination of the two invariants is free of the second variable and has a double root in the third");
                    discriminant(&free)
                }
            }
        }
    };
    let found = found.filter(|p| p.total_degree() > Some(0)).ok_or_else(none)?;
    let found = found.primitive().0.square_free_part();
    let exact = found.map(|c| Some(Rational::from(c.to_integer()))).unwrap_or_else(Space::zero);
    let world: Vector<Space> = std::array::from_fn(Polynomial::variable);
    let lifted = base.inverse().map(|q| Some(constant(q)));
    let place = lifted.map(|motion| motion.apply(&world)).unwrap_or(world);
    let [u, v, w] = &place;
    let images = match variables[0] {
        Variable::Rotation => [w.clone(), dot(&place, &place)],
        Variable::Translation => [u.clone(), v.clone()],
    };
    let [first, second] = images;
    let polynomial = exact.substitute_all(&[(0, first), (1, second)]).primitive().0;
    Ok(Surface { polynomial, variables: variables.to_vec(), steps, is_boundary: true })
}

fn none() -> Error {
    let message =
        "found a point that moves on a surface or reaches every position, expected one whose work space has a boundary";
    Error::Invalid(message.to_owned())
}

/// `factors . (d I - parts)`
fn combination(d: &Space, invariants: &[Space; 2], parts: &[Space; 2], factors: &[Rational; 2]) -> Space {
    let term = |k: usize| scaled(&d.mul(&invariants[k]).sub(&parts[k]), &factors[k]);
    term(0).add(&term(1))
}

/// The second variable turns a vector w of length `turned`: `d I = parts + matrix w`.
fn of_turn(
    d: &Space,
    invariants: &[Space; 2],
    parts: &[Space; 2],
    matrix: &[[Rational; 2]; 2],
    turned: &Space,
    steps: &mut Vec<&'static str>,
) -> Option<Space> {
    let [[a, b], [c, e]] = matrix;
    let determinant = Rational::from(a * e) - Rational::from(b * c);
    if determinant != 0 {
        steps.push("the two invariants give the vector that the second joint turns, whose length is known: an equation in the third variable");
        steps.push("at the boundary it has a double root: its discriminant is 0");
        let x = combination(d, invariants, parts, &[e.clone(), Rational::from(-b)]);
        let y = combination(d, invariants, parts, &[Rational::from(-c), a.clone()]);
        let square = Rational::from(determinant.square_ref());
        return discriminant(&x.mul(&x).add(&y.mul(&y)).sub(&scaled(turned, &square)));
    }
    // A combination of the rows that is 0, and a row that is not.
    let row = matrix.iter().position(|row| row.iter().any(|x| *x != 0))?;
    let [p, q] = &matrix[row];
    let other = &matrix[1 - row];
    let k = usize::from(*p == 0);
    let mut factors = [Rational::new(), Rational::new()];
    factors[1 - row] = matrix[row][k].clone();
    factors[row] = Rational::from(-&other[k]);
    let free = combination(d, invariants, parts, &factors);
    let length = Rational::from(p.square_ref()) + Rational::from(q.square_ref());
    let rest = d.mul(&invariants[row]).sub(&parts[row]);
    let extreme = rest.mul(&rest).sub(&scaled(turned, &length));
    of_free(&free, &extreme, steps)
}

/// The second variable s displaces: `d I_1 = parts_1 + d s slope`, `d I_2 = parts_2 + 2 s (slope of the square) + d s^2`.
fn of_slide(
    d: &Space,
    invariants: &[Space; 2],
    parts: &[Space; 2],
    rise: &Rational,
    slope: &Space,
    steps: &mut Vec<&'static str>,
) -> Option<Space> {
    let second = d.mul(&invariants[1]).sub(&parts[1]).mul(d);
    if *rise != 0 {
        steps.push("the first invariant gives the second variable, which is put into the other: an equation in the third variable");
        steps.push("at the boundary it has a double root: its discriminant is 0");
        let s = scaled(&d.mul(&invariants[0]).sub(&parts[0]), &Rational::from(rise.recip_ref()));
        let twice = scaled(&s.mul(slope), &Rational::from(2));
        return discriminant(&s.mul(&s).add(&twice).sub(&second));
    }
    // Without a rise the second invariant is least where s = -slope.
    let free = d.mul(&invariants[0]).sub(&parts[0]);
    let extreme = second.add(&slope.mul(slope));
    of_free(&free, &extreme, steps)
}

/// A combination of the invariants is free of the second variable: the boundary is where it is extreme in the third variable, and
/// where the other invariant is extreme in the second one.
fn of_free(free: &Space, extreme: &Space, steps: &mut Vec<&'static str>) -> Option<Space> {
    steps.push(
        "a combination of the two invariants is free of the second variable: the boundary is where it is extreme",
    );
    steps.push("and where the other invariant is extreme in the second variable");
    let (free, extreme) = (reduced(free), reduced(extreme));
    if free.degree(THIRD) == 0 {
        return None;
    }
    let [free_int, extreme] = [&free, &extreme].map(|p| p.primitive().0);
    let found = resultant(&free_int, &extreme, THIRD);
    let found = found.map(|c| Some(Rational::from(c.to_integer())))?;
    match discriminant(&free) {
        Some(own) if !own.is_zero() => Some(own.mul(&found)),
        _ => Some(found),
    }
}

/// Without the factors `1 + t^2`.
fn reduced(p: &Space) -> Space {
    let t = Space::variable(THIRD);
    let circle = t.mul(&t).add(&Ring::one()).primitive().0;
    let mut own = p.primitive().0;
    while let Some(quotient) = own.checked_div_exact(&circle) {
        own = quotient;
    }
    own.map(|c| Some(Rational::from(c.to_integer()))).unwrap_or_else(Space::zero)
}

/// Returns the discriminant in the third variable of a polynomial of degree 2 to 4; `None` of others. A leading coefficient of 0 is a
/// root at infinity.
fn discriminant(p: &Space) -> Option<Space> {
    let p = reduced(p);
    let coefficients = p.coefficients_in(THIRD);
    let times = |k: i32, factors: &[&Space]| {
        factors.iter().fold(Space::constant(Rational::from(k)), |product, factor| product.mul(factor))
    };
    match coefficients.as_slice() {
        [c, b, a] => Some(times(1, &[b, b]).sub(&times(4, &[a, c]))),
        [d, c, b, a] => {
            let sum = times(18, &[a, b, c, d]).sub(&times(4, &[b, b, b, d])).add(&times(1, &[b, b, c, c]));
            Some(sum.sub(&times(4, &[a, c, c, c])).sub(&times(27, &[a, a, d, d])))
        }
        [e, d, c, b, a] => {
            // 27 times the discriminant is 4 I^3 - J^2.
            let i = times(12, &[a, e]).sub(&times(3, &[b, d])).add(&times(1, &[c, c]));
            let j = times(72, &[a, c, e]).add(&times(9, &[b, c, d])).sub(&times(27, &[a, d, d]));
            let j = j.sub(&times(27, &[e, b, b])).sub(&times(2, &[c, c, c]));
            Some(times(4, &[&i, &i, &i]).sub(&times(1, &[&j, &j])))
        }
        _ => None,
    }
}

/// Returns the bounding surface of a point on a chain of two cylindrical joints: cylinders about the first axis, whose radii are the
/// sum and the difference of the distance of the axes and that of the point from the second one.
pub(super) fn of_cylinders(
    [base, link]: [&Motion<Rational>; 2],
    p: &Vector<Rational>,
    variables: &[Variable],
) -> Result<Surface> {
    let one = Rational::from(1);
    let axis: Vector<Rational> = [Rational::new(), Rational::new(), one];
    let normal = cross(&axis, &link.rotate(&axis));
    let length = dot(&normal, &normal);
    let o = &link.translation;
    let across = if length == 0 {
        Rational::from(o[0].square_ref()) + Rational::from(o[1].square_ref())
    } else {
        let along = dot(&normal, o);
        Rational::from(along.square_ref()) / &length
    };
    let radius = Rational::from(p[0].square_ref()) + Rational::from(p[1].square_ref());
    if across == 0 && radius == 0 {
        return Err(none());
    }
    let world: Vector<Space> = std::array::from_fn(Polynomial::variable);
    let lifted = base.inverse().map(|q| Some(constant(q)));
    let place = lifted.map(|motion| motion.apply(&world)).unwrap_or(world);
    let square = place[0].mul(&place[0]).add(&place[1].mul(&place[1]));
    let rest = square.sub(&constant(&Rational::from(&across + &radius)));
    let found = rest.mul(&rest).sub(&constant(&(Rational::from(4) * across * radius)));
    let steps = vec![
        "the first joint keeps the distance from its axis, and the displacement of the second one makes it that along the common perpendicular",
        "there it is extreme where the point lies on the common perpendicular",
    ];
    let polynomial = found.primitive().0.square_free_part();
    Ok(Surface { polynomial, variables: variables.to_vec(), steps, is_boundary: true })
}

#[cfg(test)]
mod tests {
    use crate::catalogue::entry::Design;
    use crate::catalogue::{Any, Chains, Options, load_any};
    use crate::derivation::surface;
    use crate::kinematics::chain::Chain;
    use crate::kinematics::forward::Forward;
    use crate::kinematics::motion::{cross, dot};
    use rug::Rational;

    fn arm(name: &str) -> Chain {
        let options = Options { chains: Chains::Swept, ..Options::default() };
        let Any::Entry(entry) = load_any(name, &options).unwrap() else { panic!("an arm") };
        let Design::Arm(chain) = entry.design else { panic!("an arm") };
        chain
    }

    /// The determinant of the velocities of the tool, and its position.
    fn at(forward: &Forward, q: &[f64]) -> (f64, [f64; 3]) {
        let (tool, twists) = forward.jacobian(q);
        let [a, b, c] = [0, 1, 2].map(|k| twists[k].linear);
        (dot(&a, &cross(&b, &c)), tool.translation)
    }

    #[test]
    fn singular_positions_lie_on_the_surface_and_others_do_not() {
        for name in ["arm/chain_rrr", "arm/chain_rrr_elbow", "arm/chain_rpr", "arm/chain_rrp", "arm/chain_prr"] {
            let chain = arm(name);
            let found = surface(&chain, &std::array::from_fn(|_| Rational::new())).unwrap();
            assert!(found.is_boundary);
            let forward = Forward::of(&chain).unwrap();
            // The value of the polynomial beside the sum of its terms and its largest coefficient: both axes may lie on the surface.
            let largest = found.polynomial.terms().map(|(_, c)| c.to_integer().to_f64().abs()).fold(0.0, f64::max);
            let share = |p: [f64; 3]| {
                let terms = found.polynomial.terms().map(|(exponents, c)| {
                    let powers =
                        exponents.iter().zip(p).map(|(e, x)| x.powi(i32::try_from(*e).unwrap())).product::<f64>();
                    c.to_integer().to_f64() * powers
                });
                let (sum, size) = terms.fold((0.0, 0.0), |(sum, size), term: f64| (sum + term, size + term.abs()));
                (sum / (size + largest)).abs()
            };
            let (mut seen, mut off) = (0, 0);
            for k in 0..60 {
                let second = -2.9 + 0.1 * f64::from(k);
                let value = |third: f64| at(&forward, &[0.4, second, third]);
                // Bisection between values of opposite signs.
                for j in 0..40 {
                    let (mut low, mut high) = (-3.1 + 0.155 * f64::from(j), -3.1 + 0.155 * f64::from(j + 1));
                    if value(low).0 * value(high).0 >= 0.0 {
                        continue;
                    }
                    for _ in 0..80 {
                        let middle = f64::midpoint(low, high);
                        if value(low).0 * value(middle).0 <= 0.0 { high = middle } else { low = middle }
                    }
                    let here = value(low);
                    assert!(share(here.1) < 1e-9, "{name}: {} at {:?}", share(here.1), here.1);
                    seen += 1;
                }
                // Another configuration at the same place may be singular by chance, but not often.
                off += usize::from(share(value(0.321 + second).1) > 1e-9);
            }
            assert!(seen > 20 && off > 40, "{name}: {seen} singular, {off} others");
        }
    }
}
