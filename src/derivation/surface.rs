//! The surface on which a point of an open chain of two variables moves, as a polynomial in its coordinates.
//!
//! The invariants of the first joint are functions of the second variable alone: for a rotation the height along its axis and
//! the distance from a point of the axis, for a translation the two coordinates perpendicular to it. Both are linear in the
//! cosine and sine of the second variable, or in the displacement, which are eliminated. \[Wittenburg2016, 7.1\]

use super::boundary;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::error::{Error, Result};
use crate::kinematics::chain::{Chain, JointKind};
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::motion::{Vector, dot};
use rug::Rational;

/// A polynomial in the coordinates x, y, z of the point.
pub(super) type Space = Polynomial<Rational>;

/// The surface of a point.
#[derive(Clone, Debug)]
pub struct Surface {
    /// The polynomial that vanishes at every position of the point: primitive, in x, y, z, metres.
    pub polynomial: Polynomial<Int>,
    /// The kinds of the joints, R or P, from the base on.
    pub variables: Vec<Variable>,
    /// The steps of the derivation, a sentence each.
    pub steps: Vec<&'static str>,
    /// Whether the point reaches more than the surface, which bounds its work space.
    pub is_boundary: bool,
}

impl Surface {
    /// Returns the degree of the surface.
    #[must_use]
    pub fn degree(&self) -> u64 {
        self.polynomial.total_degree().unwrap_or(0)
    }
}

/// A function of the second variable: `constant + first c + second s` for a rotation, or `constant + first s + second s^2` for
/// a translation.
struct Function {
    constant: Rational,
    first: Rational,
    second: Rational,
}

/// Returns the surface of a point with these coordinates in the tool: that on which it moves with two variables, or that which
/// bounds its work space with three and with two cylindrical joints.
///
/// # Errors
/// For chains of more than three variables other than CC, for data that are not rational, and if the point moves on a curve only.
pub fn surface(chain: &Chain, point: &Vector<Rational>) -> Result<Surface> {
    let unknown = chain.unknowns_and_constants::<Rational>();
    let (variables, constants) = unknown
        .ok_or_else(|| Error::Unsupported("the surface of a chain with data that are not rational".to_owned()))?;
    if let (3, [base, one, two, tool]) = (variables.len(), constants.as_slice()) {
        return boundary::of_three(&variables, [base, one, two], &tool.apply(point));
    }
    if let ([JointKind::Cylindrical, JointKind::Cylindrical], [base, _, link, _, tool]) =
        (chain.joint_kinds().as_slice(), constants.as_slice())
    {
        return boundary::of_cylinders([base, link], &tool.apply(point), &variables);
    }
    let (&[first, second], [base, link, tool]) = (variables.as_slice(), constants.as_slice()) else {
        let message = format!(
            "found a chain of {} joint variables, expected two, whose points move on surfaces, three, or two C joints, whose points are \
             bounded by surfaces",
            variables.len()
        );
        return Err(Error::Invalid(message));
    };
    let p = tool.apply(point);
    // The position before the first joint moves, as a function of the second joint's cosine, sine or displacement.
    let [x, y, z] = &p;
    let zero = Rational::new;
    let parts: [Vector<Rational>; 3] = match second {
        Variable::Rotation => [
            link.apply(&[zero(), zero(), z.clone()]),
            link.rotate(&[x.clone(), y.clone(), zero()]),
            link.rotate(&[Rational::from(-y), x.clone(), zero()]),
        ],
        Variable::Translation => {
            [link.apply(&p), link.rotate(&[zero(), zero(), Rational::from(1)]), [zero(), zero(), zero()]]
        }
    };
    let along =
        |k: usize| Function { constant: parts[0][k].clone(), first: parts[1][k].clone(), second: parts[2][k].clone() };
    // For a rotation the cosine and the sine belong to perpendicular vectors of equal length, whose squares add up to one.
    let square = || {
        let [a, b, c] = &parts;
        let own = dot(a, a);
        let twice = |v: &Vector<Rational>| dot(a, v) * Rational::from(2);
        match second {
            Variable::Rotation => Function { constant: own + dot(b, b), first: twice(b), second: twice(c) },
            Variable::Translation => Function { constant: own, first: twice(b), second: dot(b, b) },
        }
    };
    let world: Vector<Space> = std::array::from_fn(Polynomial::variable);
    let back = base.inverse();
    let lifted = back.map(|q| Some(Space::constant(q.clone())));
    let place = lifted.map(|motion| motion.apply(&world)).unwrap_or(world);
    let [u, v, w] = &place;
    let (left, right) = match first {
        Variable::Rotation => ([w.clone(), dot(&place, &place)], [along(2), square()]),
        Variable::Translation => ([u.clone(), v.clone()], [along(0), along(1)]),
    };
    let mut steps = vec![match first {
        Variable::Rotation => "the first joint keeps the height along its axis and the distance from a point of it",
        Variable::Translation => "the first joint keeps the two coordinates across its direction",
    }];
    // Each equation without its constant.
    let rest: [Space; 2] = [0, 1].map(|k| left[k].sub(&Space::constant(right[k].constant.clone())));
    let found = match second {
        Variable::Rotation => of_turn(&rest, &right, &mut steps),
        Variable::Translation => of_slide(&rest, &right, &mut steps),
    };
    let found = found.filter(|p| p.total_degree() > Some(0)).ok_or_else(|| {
        Error::Invalid("found a point that moves on a curve, because the axes coincide or it lies on one; expected one that moves on a surface".to_owned())
    })?;
    Ok(Surface { polynomial: found.primitive().0.square_free_part(), variables, steps, is_boundary: false })
}

pub(super) fn scaled(p: &Space, q: &Rational) -> Space {
    p.mul(&Space::constant(q.clone()))
}

/// Solves `rest = first c + second s` twice, with `c^2 + s^2 = 1`.
fn of_turn(rest: &[Space; 2], right: &[Function; 2], steps: &mut Vec<&'static str>) -> Option<Space> {
    let [f, g] = right;
    let minor = |a: &Rational, b: &Rational, c: &Rational, d: &Rational| Rational::from(a * d) - Rational::from(b * c);
    let determinant = minor(&f.first, &f.second, &g.first, &g.second);
    if determinant != 0 {
        steps.push("the two equations give cosine and sine of the second angle, whose squares add up to 1");
        let cosine = scaled(&rest[0], &g.second).sub(&scaled(&rest[1], &f.second));
        let sine = scaled(&rest[1], &f.first).sub(&scaled(&rest[0], &g.first));
        let square = Rational::from(determinant.square_ref());
        return Some(cosine.mul(&cosine).add(&sine.mul(&sine)).sub(&Space::constant(square)));
    }
    dependent(rest, right, steps)
}

/// Solves `rest = first s + second s^2` twice, one of which has no square.
fn of_slide(rest: &[Space; 2], right: &[Function; 2], steps: &mut Vec<&'static str>) -> Option<Space> {
    let [f, g] = right;
    // Only the distance has a square, and it comes second.
    if f.first == 0 || g.second == 0 {
        return dependent(rest, right, steps);
    }
    steps.push("the first equation gives the displacement, which is put into the second");
    let s = scaled(&rest[0], &Rational::from(f.first.recip_ref()));
    Some(scaled(&s, &g.first).add(&scaled(&s.mul(&s), &g.second)).sub(&rest[1]))
}

/// If the right sides are dependent, a combination of the equations is free of the second variable.
fn dependent(rest: &[Space; 2], right: &[Function; 2], steps: &mut Vec<&'static str>) -> Option<Space> {
    steps.push("a combination of the two equations is free of the second variable");
    let is_free = |f: &Function| f.first == 0 && f.second == 0;
    let [f, g] = right;
    match (is_free(f), is_free(g)) {
        (true, true) => None,
        (true, false) => Some(rest[0].clone()),
        (false, true) => Some(rest[1].clone()),
        (false, false) => {
            let (one, two) = if f.first == 0 { (&f.second, &g.second) } else { (&f.first, &g.first) };
            Some(scaled(&rest[0], two).sub(&scaled(&rest[1], one)))
        }
    }
}
