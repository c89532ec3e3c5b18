//! Applies the theorem on four joints to a loop whose numbers lie in one number field.

use super::decide::{Class, Decision, Family, folds, sign};
use super::four_bar::{FourBar, conditions};
use crate::algebra::int::Int;
use crate::algebra::number_field::Algebraic;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::real_field::RealField;
use crate::algebra::ring::{Field, Ring};
use crate::algebra::surd::Closed;
use crate::algebra::text::Names;
use crate::catalogue::ansatz::Link;
use crate::derivation::transference::Variables;
use crate::kinematics::chain::{Chain, Geometry, JointKind};

type Poly = Polynomial<Int>;

/// Returns the links of a loop of four revolute joints over the field of its numbers, and the degree of the field.
fn links(chain: &Chain) -> Option<(usize, Vec<Link<Algebraic>>)> {
    // The link behind joint k is stored with it, or with the next one.
    let (joints, shift) = match &chain.geometry {
        Geometry::Dh(joints) => (joints, 0),
        Geometry::ModifiedDh(joints) => (joints, 1),
        Geometry::Screws { .. } => return None,
    };
    if joints.len() != 4 || joints.iter().any(|joint| joint.kind != JointKind::Revolute) {
        return None;
    }
    let mut closed = Vec::new();
    for k in 0..4 {
        let link = &joints[(k + shift) % 4];
        let (cos, sin) = link.alpha.phase()?;
        closed.push([cos, sin, link.a.closed()?, joints[k].d.closed()?]);
    }
    let field = RealField::containing(closed.iter().flatten())?;
    let element = |number: &Closed| field.element(number);
    let link = |[cos, sin, a, d]: &[Closed; 4]| {
        Some(Link { cos: element(cos)?, sin: element(sin)?, a: element(a)?, d: element(d)? })
    };
    let links: Option<Vec<Link<Algebraic>>> = closed.iter().map(link).collect();
    Some((field.degree(), links?))
}

/// Returns all families of a loop of four joints with numbers of one field; `None` for other loops.
#[must_use]
pub fn decide_over_field(theorem: &FourBar, chain: &Chain) -> Option<Decision> {
    let (degree, links) = links(chain)?;
    let mut families = Vec::new();
    let mut note = |class: Class, name: String, note: Option<&str>| {
        families.push(Family { class, name, conditions: Vec::new(), note: note.map(str::to_owned) });
    };
    let is_zero = |values: &[&Algebraic]| values.iter().all(|x| x.is_zero());
    let parallel = links.iter().filter(|link| link.sin.is_zero()).count();
    if parallel == 0 {
        let values = values(&links)?;
        let vanish = |list: &[Poly]| list.iter().all(|p| at(p, &values).is_zero());
        let without_lengths = links.iter().all(|link| link.a.is_zero());
        for variant in &theorem.bennett {
            let at_one = |p: &Poly| at(&p.substitute(Variables::X, &Poly::one()), &values);
            // If the ratio is 0 or infinite, both joints are folded; without lengths the loop is spherical.
            let is_folded = at_one(&variant.fourth.0).is_zero() || at_one(&variant.fourth.1).is_zero();
            if !is_folded && !without_lengths && vanish(&conditions(variant)) {
                note(Class::Bennett, sign(variant), None);
            }
        }
        if links.iter().all(|link| is_zero(&[&link.a, &link.d])) {
            note(Class::Spherical, "spherical: all axes through one point".to_owned(), None);
        }
        for axes in 0..2 {
            if folds(axes).iter().any(|variant| vanish(variant)) {
                let name = format!("axes {} and {} coincide, the other two joints locked", axes + 1, axes + 3);
                note(Class::Coincident, name, None);
            }
        }
    }
    if parallel == 4 {
        let start = (Algebraic::one(), Algebraic::zero());
        let (direction, along) = links
            .iter()
            .fold(start, |(direction, along), link| (direction.mul(&link.cos), along.add(&direction.mul(&link.d))));
        if direction == Algebraic::one() && along.is_zero() {
            let condition = "moves where the four lengths reach round: the longest less than the sum of the others";
            note(Class::Planar, "planar: all axes parallel".to_owned(), Some(condition));
        }
    }
    for (k, link) in links.iter().enumerate().filter(|(_, link)| is_zero(&[&link.sin, &link.a])) {
        let name = format!("axes {} and {} coincide, the other two joints locked", k + 1, (k + 1) % 4 + 1);
        let twist = if link.cos == Algebraic::one() { "0" } else { "pi" };
        note(Class::Coincident, name, Some(&format!("the other links must close as a rigid triangle; twist {twist}")));
    }
    families.dedup_by(|a, b| a.name == b.name);
    Some(Decision {
        names: Names::given(std::iter::empty::<String>()).ok()?,
        families,
        oblique: Vec::new(),
        is_numeric: true,
        confirmed: None,
        field: Some(degree),
    })
}

/// Returns the values of the twelve parameters of the theorem, by its variables; `None` if a twist is a multiple of pi.
fn values(links: &[Link<Algebraic>]) -> Option<Vec<Algebraic>> {
    let mut values = vec![Algebraic::zero(); Variables::X];
    for (k, link) in links.iter().enumerate() {
        values[Variables::twist(k)] = link.sin.mul(&Algebraic::one().add(&link.cos).inverse()?);
        values[Variables::length(k)] = link.a.clone();
        values[Variables::offset(k)] = link.d.clone();
    }
    Some(values)
}

/// Returns the value of a polynomial at elements of the field.
fn at(p: &Poly, values: &[Algebraic]) -> Algebraic {
    let image = p.map(|c| Algebraic::from_rational(&c.to_integer().into()));
    image.map_or_else(Algebraic::zero, |image| image.evaluate(values))
}
