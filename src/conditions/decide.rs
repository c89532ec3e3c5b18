//! Applies the theorem on four joints to a loop with its own symbols, or with numbers.

use super::closure_identity::{Member, closes};
use super::component::{Coefficients, Component};
use super::four_bar::{Bennett, FourBar, LENGTHS, conditions};
use super::null_space::null_space;
use super::quotient::Quotient;
use super::step::quotient_text;
use super::twist_family::{Ratio, with_tangents};
use crate::algebra::factors::remove_factors;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Field, Ring};
use crate::algebra::sort;
use crate::algebra::text::Names;
use crate::algebra::univariate::Univariate;
use crate::catalogue::ansatz::{Ansatz, Link};
use crate::derivation::transference::Variables;
use crate::error::{Error, Result};

type Poly = Polynomial<Int>;

/// A kind of loop that moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Bennett's loop.
    Bennett,
    /// All axes through one point.
    Spherical,
    /// All axes parallel.
    Planar,
    /// Two axes coincide, and only the joints on them move.
    Coincident,
}

/// A family of loops that move.
#[derive(Clone, Debug)]
pub struct Family {
    /// Its kind.
    pub class: Class,
    /// A short name.
    pub name: String,
    /// The polynomials that vanish; empty if every loop of the ansatz is of the family.
    pub conditions: Vec<Poly>,
    /// A remark on what the conditions leave out.
    pub note: Option<String>,
}

/// All families of an ansatz.
#[derive(Clone, Debug)]
pub struct Decision {
    /// The names of the variables of all conditions.
    pub names: Names,
    /// The families, those whose joints all move first.
    pub families: Vec<Family>,
    /// The links whose twist is assumed to be no multiple of pi, counted from 1; the twist of the others always is one.
    pub oblique: Vec<usize>,
    /// Whether the loop has numbers only.
    pub is_numeric: bool,
    /// Whether the linear conditions at the numbers themselves have the same solutions; `None` if they were not set up.
    pub confirmed: Option<bool>,
    /// The degree of the number field, if the numbers of the loop were not rounded but taken as elements of it.
    pub field: Option<usize>,
}

/// The ansatz as one mechanism over the rational functions of its free symbols.
struct Setting {
    names: Names,
    links: Vec<Link<Quotient>>,
    residuals: Vec<Poly>,
    /// Factors that are not zero for real loops with the intended twists.
    harmless: Vec<Poly>,
    is_numeric: bool,
}

impl Setting {
    fn of(ansatz: &Ansatz) -> Result<Self> {
        let (angles, lengths) = (ansatz.free_angles(), ansatz.free_lengths());
        let tangents = angles.iter().map(|&k| match ansatz.symbols.angles[k].strip_prefix("alpha") {
            Some(number) => format!("t{number}"),
            None => format!("tan_half_{}", ansatz.symbols.angles[k]),
        });
        let named = tangents.chain(lengths.iter().map(|&k| ansatz.symbols.lengths[k].clone()));
        let names = Names::given(named)?;
        let symbols: Vec<Quotient> = (0..names.list().len()).map(Quotient::variable).collect();
        let (tangents, values) = symbols.split_at(angles.len());
        let found = ansatz.over::<Quotient>().and_then(|members| members.with_residuals(tangents, values));
        let Some((links, residuals)) = found else {
            return Err(Error::Unsupported("the relations cannot be solved for the lengths in general".to_owned()));
        };
        let circles = tangents.iter().map(|t| t.mul(t).add(&Quotient::one()).numerator().clone());
        let sines = links.iter().map(|link| link.sin.numerator().clone());
        let harmless = circles.chain(sines).filter(|p| p.to_constant().is_none()).collect();
        let residuals = residuals.iter().filter(|q| !q.is_zero()).map(|q| q.numerator().clone()).collect();
        Ok(Self { is_numeric: names.list().is_empty(), names, links, residuals, harmless })
    }

    /// Returns a condition without factors that do not vanish; `None` if no real numbers satisfy it.
    fn condition(&self, value: &Quotient) -> Option<Poly> {
        let rest = remove_factors(value.numerator(), &self.harmless).rest.primitive_part();
        if rest.is_zero() {
            return Some(rest);
        }
        let rest = rest.square_free_part();
        let used: Vec<usize> = (0..rest.variables()).filter(|&k| rest.degree(k) > 0).collect();
        match used.as_slice() {
            [] => None,
            [variable] => {
                let integers = rest.to_univariate(*variable)?.coefficients().iter().map(Int::to_integer).collect();
                (Univariate::new(integers).distinct_real_roots() > 0).then_some(rest)
            }
            _ => Some(rest),
        }
    }

    /// Returns the conditions as polynomials in the symbols, each once; `None` if they contradict the relations of the
    /// ansatz.
    fn conditions(&self, values: impl IntoIterator<Item = Quotient>) -> Option<Vec<Poly>> {
        let own = self.residuals.iter().cloned().map(Quotient::from);
        let mut found: Vec<Poly> = Vec::new();
        for value in values.into_iter().chain(own) {
            let condition = self.condition(&value)?;
            if !condition.is_zero() && !found.contains(&condition) {
                found.push(condition);
            }
        }
        // If two polynomials vanish, so do their sum and difference.
        for (k, p) in found.iter().enumerate() {
            for q in &found[..k] {
                self.condition(&Quotient::from(p.add(q)))?;
                self.condition(&Quotient::from(p.sub(q)))?;
            }
        }
        // Conditions that are single symbols simplify the others.
        loop {
            let zeros: Vec<(usize, Poly)> = found
                .iter()
                .filter_map(|p| (0..p.variables()).find(|&k| *p == Poly::variable(k)))
                .map(|k| (k, Poly::zero()))
                .collect();
            let mut next: Vec<Poly> = zeros.iter().map(|(k, _)| Poly::variable(*k)).collect();
            for p in &found {
                let value = self.condition(&Quotient::from(p.substitute_all(&zeros)))?;
                if !value.is_zero() && !next.contains(&value) {
                    next.push(value);
                }
            }
            if next.len() == found.len() && next.iter().all(|p| found.contains(p)) {
                return Some(found);
            }
            found = next;
        }
    }
}

/// Returns all families of a loop of four joints with these symbols.
///
/// # Errors
/// If the relations cannot be solved in general.
pub fn decide(theorem: &FourBar, ansatz: &Ansatz) -> Result<Decision> {
    let setting = Setting::of(ansatz)?;
    let parallel: Vec<usize> = (0..4).filter(|&k| setting.links[k].sin.is_zero()).collect();
    let oblique: Vec<usize> = (1..=4).filter(|k| !parallel.contains(&(k - 1))).collect();
    let mut families = Vec::new();
    let mut confirmed = None;
    if parallel.is_empty() {
        confirmed = oblique_families(theorem, &setting, &mut families);
    }
    planar(&setting, &mut families);
    neighbours(&setting, &mut families);
    if let [a, b] = parallel.as_slice() {
        match b - a {
            1 => parallel_folds(&setting, *a, &mut families),
            3 => parallel_folds(&setting, *b, &mut families),
            _ => {}
        }
    }
    let Setting { names, is_numeric, .. } = setting;
    Ok(Decision { names, families, oblique, is_numeric, confirmed, field: None })
}

/// Returns the values of the twelve parameters of the theorem, by its variables; `None` if a twist is a multiple of pi.
fn values(links: &[Link<Quotient>]) -> Option<Vec<Quotient>> {
    let mut values = vec![Quotient::zero(); Variables::X];
    for (k, link) in links.iter().enumerate() {
        values[Variables::twist(k)] = link.sin.mul(&Quotient::one().add(&link.cos).inverse()?);
        values[Variables::length(k)] = link.a.clone();
        values[Variables::offset(k)] = link.d.clone();
    }
    Some(values)
}

/// Returns the value of a polynomial at rational functions.
fn at(p: &Poly, values: &[Quotient]) -> Quotient {
    let image = p.map(|c| Some(Quotient::from(Poly::constant(c.clone()))));
    image.map_or_else(Quotient::zero, |image| image.evaluate(values))
}

/// Adds Bennett, spherical and folded loops.
fn oblique_families(theorem: &FourBar, setting: &Setting, families: &mut Vec<Family>) -> Option<bool> {
    let values = values(&setting.links)?;
    let mut bennett: Vec<Family> = Vec::new();
    for variant in &theorem.bennett {
        // If K is 0 or infinite, both joints are folded.
        let at_one = |p: &Poly| at(&p.substitute(Variables::X, &Poly::one()), &values);
        if at_one(&variant.fourth.0).is_zero() || at_one(&variant.fourth.1).is_zero() {
            continue;
        }
        let own = conditions(variant);
        let Some(found) = setting.conditions(own.iter().map(|p| at(p, &values))) else { continue };
        // If all lengths are zero, it is a spherical loop.
        let lengths = setting.links.iter().all(|link| {
            setting.conditions([link.a.clone()]).is_some_and(|zero| zero.iter().all(|p| found.contains(p)))
        });
        if lengths || bennett.iter().any(|known| known.conditions == found) {
            continue;
        }
        let note = Some(constants(variant, &values, &setting.names));
        bennett.push(Family { class: Class::Bennett, name: sign(variant), conditions: found, note });
    }
    // A family contained in another one is redundant.
    let implied = |a: &Family, b: &Family| b.conditions.iter().all(|p| a.conditions.contains(p));
    let kept = |k: &usize| (0..bennett.len()).all(|other| other == *k || !implied(&bennett[*k], &bennett[other]));
    let mut kept: Vec<Family> = (0..bennett.len()).filter(kept).map(|k| bennett[k].clone()).collect();
    sort::by(&mut kept, |a, b| a.name.cmp(&b.name));
    families.extend(kept);
    let centre = setting.links.iter().flat_map(|link| [link.a.clone(), link.d.clone()]);
    if let Some(conditions) = setting.conditions(centre) {
        let name = "spherical: all axes through one point".to_owned();
        families.push(Family { class: Class::Spherical, name, conditions, note: None });
    }
    for axes in 0..2 {
        for variant in folds(axes) {
            let Some(conditions) = setting.conditions(variant.iter().map(|p| at(p, &values))) else { continue };
            if families.iter().any(|known| known.conditions == conditions) {
                continue;
            }
            let name = format!("axes {} and {} coincide, the other two joints locked", axes + 1, axes + 3);
            families.push(Family { class: Class::Coincident, name, conditions, note: None });
        }
    }
    let numbers: [Ratio; 4] = std::array::from_fn(|k| split(&values[Variables::twist(k)]));
    let constant = numbers.iter().all(|(n, d)| n.to_constant().is_some() && d.to_constant().is_some());
    let comparable = constant && setting.residuals.is_empty();
    comparable.then(|| confirmed(theorem, &numbers, &values, families))?
}

fn split(q: &Quotient) -> Ratio {
    (q.numerator().clone(), q.denominator().clone())
}

/// Returns the dependence of the other angles on that of joint 1.
fn constants(variant: &Bennett, values: &[Quotient], names: &Names) -> String {
    let one = |k: usize| {
        let (numerator, denominator) = &variant.angles[k];
        let inverse = denominator.degree(Variables::X) > numerator.degree(Variables::X);
        let at_one = |p: &Poly| at(&p.substitute(Variables::X, &Poly::one()), values);
        let constant = at_one(denominator).inverse().map_or_else(Quotient::zero, |d| at_one(numerator).mul(&d));
        let shown = quotient_text(&constant, names);
        if inverse {
            format!("tan(theta1/2) tan(theta{}/2) = {shown}", k + 1)
        } else {
            format!("tan(theta{}/2) = {shown} tan(theta1/2)", k + 1)
        }
    };
    [1, 2, 3].map(one).join(", ")
}

/// Returns which of the two families it is, by the sign of `a1 sin(alpha2) / (a2 sin(alpha1))`.
pub(super) fn sign(variant: &Bennett) -> String {
    let sum_of_degrees = |p: &Poly| p.coefficients().first().is_some_and(|c| c.to_i64().is_some_and(|c| c > 0));
    let same = sum_of_degrees(&variant.lengths[0]) == sum_of_degrees(&variant.lengths[1]);
    format!("Bennett ({})", if same { "+" } else { "-" })
}

/// Returns the conditions under which the axes of two opposite joints coincide while the other two are locked, for every
/// orientation; each has been proved by the closure identity.
pub(super) fn folds(axes: usize) -> Vec<Vec<Poly>> {
    let v = Poly::variable;
    let mut found = Vec::new();
    for odd in [false, true] {
        for (first, second) in [(false, false), (false, true), (true, false), (true, true)] {
            // At the joint locked at pi the link behind has the twist and length of the one before, at 0 the opposite ones.
            let relation = |i: usize, j: usize, straight: bool| -> [Poly; 2] {
                let sign = Int::from_integer(if straight { -1 } else { 1 });
                let (ti, tj) = (v(Variables::twist(i)), v(Variables::twist(j)));
                let twist = if odd { ti.mul(&tj).add(&Poly::constant(sign.clone())) } else { tj.sub(&ti.scale(&sign)) };
                [twist, v(Variables::length(j)).sub(&v(Variables::length(i)).scale(&sign))]
            };
            let link = |k: usize| (axes + k) % 4;
            let [t2, a2] = relation(link(0), link(1), first);
            let [t4, a4] = relation(link(2), link(3), second);
            let d = |k: usize| v(Variables::offset(link(k)));
            // The other joint rotates in the same sense about an axis of the opposite direction.
            let along = if odd { d(2).sub(&d(0)) } else { d(2).add(&d(0)) };
            if folded(odd, first, second) {
                found.push(vec![t2, t4, a2, a4, d(1), d(3), along]);
            }
        }
    }
    found
}

/// Returns whether a loop with coincident axes 1 and 3 closes for all angles of joint 1.
fn folded(odd: bool, first: bool, second: bool) -> bool {
    let v = Poly::variable;
    let x = v(Variables::X);
    let d = v(Variables::offset(0));
    turns_back(&x).into_iter().any(|third| {
        closes(&[
            member((x.clone(), Poly::one()), d.clone(), link(0)),
            member(locked(first), Poly::zero(), behind(0, odd, first)),
            member(third, if odd { d.clone() } else { d.neg() }, link(2)),
            member(locked(second), Poly::zero(), behind(2, odd, second)),
        ])
    })
}

fn member(theta: Ratio, d: Poly, (alpha, a): (Ratio, Poly)) -> Member {
    Member { theta, d, alpha, a }
}

/// The twist and the length of a link as symbols.
fn link(k: usize) -> (Ratio, Poly) {
    ((Poly::variable(Variables::twist(k)), Poly::one()), Poly::variable(Variables::length(k)))
}

/// The sign of the link behind a joint that is locked: opposite where this is straight.
fn fold_sign(straight: bool) -> Int {
    Int::from_integer(if straight { -1 } else { 1 })
}

/// The link that leads back along a link, behind a joint that is straight or at pi; `odd` where it leaves the axis reversed.
fn behind(k: usize, odd: bool, straight: bool) -> (Ratio, Poly) {
    let ((t, _), a) = link(k);
    let sign = fold_sign(straight);
    let tangent = if odd { (Poly::constant(sign.neg()), t) } else { (t.scale(&sign), Poly::one()) };
    (tangent, a.scale(&sign))
}

/// The angle 0, or pi.
fn locked(straight: bool) -> Ratio {
    if straight { (Poly::zero(), Poly::one()) } else { (Poly::one(), Poly::zero()) }
}

/// The angles with which joint 3 rotates back, about an axis that may have the opposite direction, possibly with an offset of pi.
fn turns_back(x: &Poly) -> [Ratio; 4] {
    [(x.neg(), Poly::one()), (x.clone(), Poly::one()), (Poly::one(), x.clone()), (Poly::one(), x.neg())]
}

/// Returns whether a loop closes for all angles of joint 1 whose links 1 and 2 are parallel, with twists of pi where `turned`, and lead to
/// the axis of joint 1 and back, as links 3 and 4 do; `straight` says so of the two joints between. The offsets of the three parallel axes
/// have the sum 0.
fn parallel_fold_closes(turned: [bool; 2], straight: [bool; 2]) -> bool {
    let v = Poly::variable;
    let x = v(Variables::X);
    let a = v(Variables::length(0));
    let odd = turned[0] != turned[1];
    let sign = |is_turned: bool| Int::from_integer(if is_turned { -1 } else { 1 });
    let [d1, d2] = [0, 1].map(|k| v(Variables::offset(k)));
    // d1 + s1 d2 + s1 s2 d3 = 0, with the cosines s1 and s2 of both twists.
    let d3 = d1.scale(&sign(!odd)).sub(&d2.scale(&sign(turned[1])));
    turns_back(&x).into_iter().any(|third| {
        closes(&[
            member((x.clone(), Poly::one()), d1.clone(), (locked(!turned[0]), a.clone())),
            member(locked(straight[0]), d2.clone(), (locked(!turned[1]), a.scale(&fold_sign(straight[0])))),
            member(third, d3.clone(), link(2)),
            member(locked(straight[1]), Poly::zero(), behind(2, odd, straight[1])),
        ])
    })
}

/// Adds loops with two neighbouring parallel links, the first of this number, whose outer axes coincide: the joint between them is locked,
/// and so is the opposite one.
fn parallel_folds(setting: &Setting, first: usize, families: &mut Vec<Family>) {
    let own = |k: usize| &setting.links[(first + k) % 4];
    let cosines = [own(0).cos.clone(), own(1).cos.clone()];
    let turned = cosines.each_ref().map(|cos| *cos != Quotient::one());
    let odd = turned[0] != turned[1];
    let tangent = |link: &Link<Quotient>| Some(link.sin.mul(&Quotient::one().add(&link.cos).inverse()?));
    let (Some(t), Some(u)) = (tangent(own(2)), tangent(own(3))) else { return };
    let along = own(0).d.add(&cosines[0].mul(&own(1).d)).add(&cosines[0].mul(&cosines[1]).mul(&own(2).d));
    for straight in [[false, false], [false, true], [true, false], [true, true]] {
        if !parallel_fold_closes(turned, straight) {
            continue;
        }
        let [near, far] = straight.map(|is| Quotient::from(Poly::constant(fold_sign(is))));
        let twist = if odd { t.mul(&u).add(&far) } else { u.sub(&far.mul(&t)) };
        let wanted = [
            twist,
            own(1).a.sub(&near.mul(&own(0).a)),
            own(3).a.sub(&far.mul(&own(2).a)),
            own(3).d.clone(),
            along.clone(),
        ];
        let Some(conditions) = setting.conditions(wanted) else { continue };
        if families.iter().any(|known| known.class == Class::Coincident && known.conditions == conditions) {
            continue;
        }
        let (one, two) = (first.min((first + 2) % 4), first.max((first + 2) % 4));
        let name = format!("axes {} and {} coincide, the other two joints locked", one + 1, two + 1);
        families.push(Family { class: Class::Coincident, name, conditions, note: None });
    }
}

/// Adds loops with all axes parallel.
fn planar(setting: &Setting, families: &mut Vec<Family>) {
    let mut direction = Quotient::one();
    let mut along = Quotient::zero();
    let mut sines = Vec::new();
    for link in &setting.links {
        along = along.add(&direction.mul(&link.d));
        if !link.sin.is_zero() {
            sines.push(link.sin.clone());
            continue;
        }
        direction = direction.mul(&link.cos);
    }
    let name = "planar: all axes parallel".to_owned();
    if sines.is_empty() {
        // If the directions do not return to themselves, the loop never closes.
        if direction == Quotient::one()
            && let Some(conditions) = setting.conditions([along])
        {
            let note =
                "moves where the four lengths reach round: the longest less than the sum of the others".to_owned();
            families.push(Family { class: Class::Planar, name, conditions, note: Some(note) });
        }
        return;
    }
    // The sines were set aside as nonvanishing factors and are inserted as they are.
    let possible = sines.iter().all(|sine| sine.numerator().to_constant().is_none());
    if possible {
        let mut conditions: Vec<Poly> =
            sines.iter().map(|sine| sine.numerator().primitive_part().square_free_part()).collect();
        // A tangent 0 is an angle of 0, which reverses no axis.
        let zeros: Vec<(usize, Poly)> = conditions
            .iter()
            .filter_map(|p| (0..p.variables()).find(|&k| *p == Poly::variable(k)))
            .map(|k| (k, Poly::zero()))
            .collect();
        if zeros.len() == conditions.len() {
            let sum = along.numerator().substitute_all(&zeros).primitive_part();
            conditions.extend(Some(sum).filter(|sum| !sum.is_zero()));
        }
        let note = "twists 0 (or pi), and the sum of the offsets, each in the direction of its axis, is 0".to_owned();
        families.push(Family { class: Class::Planar, name, conditions, note: Some(note) });
    }
}

/// Adds loops with two coincident neighbouring axes.
fn neighbours(setting: &Setting, families: &mut Vec<Family>) {
    for (k, link) in setting.links.iter().enumerate() {
        let sine = &link.sin;
        if !sine.is_zero() && sine.numerator().to_constant().is_some() {
            continue;
        }
        let Some(mut conditions) = setting.conditions([link.a.clone()]) else { continue };
        if !sine.is_zero() {
            conditions.insert(0, sine.numerator().primitive_part().square_free_part());
        }
        let name = format!("axes {} and {} coincide, the other two joints locked", k + 1, (k + 1) % 4 + 1);
        let note = "the other links must close as a rigid triangle; twist 0 or pi".to_owned();
        families.push(Family { class: Class::Coincident, name, conditions, note: Some(note) });
    }
}

/// Solves the linear conditions at numeric twists: returns the lengths, columns as in [`LENGTHS`], with which the loop moves
/// on a component of its curve on which both joints move. `None` if the curve is reducible, but not over the rationals.
#[must_use]
pub fn lengths_at(theorem: &FourBar, tangents: &[Ratio; 4]) -> Option<Vec<Vec<Vec<Poly>>>> {
    let f = with_tangents(&theorem.pair.f, tangents);
    let g = with_tangents(&theorem.pair.g, tangents);
    let coefficients = Coefficients::of(&f)?;
    if let Some(components) = coefficients.components() {
        let moving = components.iter().filter(|component| component.moves());
        return Some(moving.map(|component| null_space(&component.equations(&g, &LENGTHS), LENGTHS.len())).collect());
    }
    let [a, b, c, _, e] = coefficients.list().map(Poly::is_zero);
    if ((a || b) && (c || e)) || (c && e) || (a && b) {
        return None;
    }
    // Irreducible: g = lambda f, one more column; lambda alone is impossible, since f is not zero.
    let zero_fold = Component::Fold { variable: Variables::X, infinite: false };
    let mut rows = Vec::new();
    let columns: Vec<Poly> = LENGTHS.iter().map(|&v| g.derivative(v)).chain([f]).collect();
    for power in 0..3 {
        let part = |p: &Poly| p.coefficients_in(Variables::X).get(power).cloned().unwrap_or_else(Poly::zero);
        let parts: Vec<Vec<Poly>> = columns.iter().map(|p| zero_fold.restricted(&part(p))).collect();
        for k in 0..3 {
            rows.push(parts.iter().map(|list| list.get(k).cloned().unwrap_or_else(Poly::zero)).collect::<Vec<_>>());
        }
    }
    Some(vec![null_space(&rows, columns.len())])
}

/// Returns whether the linear conditions at the numbers agree with the families.
fn confirmed(theorem: &FourBar, tangents: &[Ratio; 4], values: &[Quotient], families: &[Family]) -> Option<bool> {
    let spaces = lengths_at(theorem, tangents)?;
    let bennett = families.iter().any(|family| family.class == Class::Bennett);
    let numbers: Option<Vec<Poly>> = LENGTHS
        .iter()
        .map(|&k| {
            let (n, d) = split(&values[k]);
            (n.to_constant().is_some() && d.to_constant().is_some()).then_some(n.mul(&d))
        })
        .collect();
    let Some(_) = numbers else {
        // For unknown lengths, there are Bennett loops among them only if some null space is not zero.
        return Some(!bennett || spaces.iter().any(|space| !space.is_empty()));
    };
    let ratio = |k: usize| &values[LENGTHS[k]];
    let moves = spaces.iter().flatten().any(|vector| {
        (0..LENGTHS.len()).all(|i| {
            (0..LENGTHS.len()).all(|j| {
                let side = |i: usize, j: usize| ratio(i).mul(&Quotient::from(vector[j].clone()));
                side(i, j) == side(j, i)
            })
        })
    });
    let offsets = [1, 2].iter().all(|&k| values[Variables::offset(k)].is_zero());
    let spherical = families.iter().any(|family| family.class == Class::Spherical);
    let is_zero = (0..LENGTHS.len()).all(|k| ratio(k).is_zero());
    Some((moves && offsets && !is_zero) == (bennett && !spherical))
}
