//! All families of loops of four rotations that move: theorem 12 of docs/certificate.md.
//!
//! The variables of all polynomials are the half-angle tangents of the twists, the lengths, the offsets, and the half-angle tangents
//! of the joints, four each.

use super::fault::{Fault, refused, shortened, unreadable};
use super::record::{count, fields, list, text};
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Domain, Ring};
use crate::algebra::text::{Expression, Format, Names};
use crate::kinematics::dual_quaternion::DualQuaternion;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;

type Poly = Polynomial<Int>;
/// A half-angle tangent as sine and cosine, up to a common factor.
type Ratio = (Poly, Poly);

/// The kind of the item.
pub const KIND: &str = "families";
/// The names of the variables.
pub const NAMES: [&str; 16] =
    ["t1", "t2", "t3", "t4", "a1", "a2", "a3", "a4", "d1", "d2", "d3", "d4", "x1", "x2", "x3", "x4"];
/// The first variable of the lengths, of the offsets, and of the joints.
const LENGTHS: usize = 4;
const OFFSETS: usize = 8;
const JOINTS: usize = 12;
/// The variables of joints 1 and 4, in which the loop closes on a curve.
const ENDS: [usize; 2] = [JOINTS, JOINTS + 3];
/// The lengths and offsets in the second closure equation.
const COLUMNS: [usize; 6] = [4, 5, 6, 7, OFFSETS, OFFSETS + 3];
/// The exponents of x1 and x4 in the first closure equation, and those of its coefficients A, B, C, E and M.
const EVEN: [[u32; 2]; 5] = [[2, 2], [2, 0], [0, 2], [0, 0], [1, 1]];
/// The exponents of x1 and x4 with offsets in the second one.
const ODD: [[u32; 2]; 4] = [[1, 0], [1, 2], [0, 1], [2, 1]];
/// The coefficients A, B, C, E by their places in `EVEN`, two of which belong to no joint that stands still if they vanish together.
const OPPOSITE: [[usize; 2]; 2] = [[0, 3], [1, 2]];
/// Maximum number of characters of a polynomial.
const LONGEST: usize = 5000;
/// Number of Bennett's families: two for each of eight relations of opposite twists.
const BENNETT: usize = 16;

/// A family as claimed.
struct Family {
    class: String,
    conditions: Vec<Poly>,
    motion: Vec<Poly>,
}

/// The claim about all families.
pub(super) struct Claim {
    families: Vec<Family>,
    oblique_links: Vec<usize>,
    moving_joints: Vec<usize>,
}

impl Claim {
    pub(super) fn read(families: &Value, oblique_links: &Value, moving_joints: &Value) -> Result<Self, Fault> {
        let polynomials = |value: &Value| list(value)?.iter().map(polynomial).collect::<Result<Vec<_>, Fault>>();
        let family = |value: &Value| {
            let [class, conditions, motion] = fields(value, ["class", "conditions", "motion"], &[])?;
            Ok(Family {
                class: text(class)?.to_owned(),
                conditions: polynomials(conditions)?,
                motion: polynomials(motion)?,
            })
        };
        let numbers = |value: &Value| list(value)?.iter().map(count).collect::<Result<Vec<_>, Fault>>();
        let families = list(families)?;
        if families.len() != BENNETT + 1 {
            return refused(format!("claim: found {} families, expected {}", families.len(), BENNETT + 1));
        }
        Ok(Self {
            families: families.iter().map(family).collect::<Result<_, Fault>>()?,
            oblique_links: numbers(oblique_links)?,
            moving_joints: numbers(moving_joints)?,
        })
    }
}

/// Reads a polynomial that is written as this program writes it.
fn polynomial(value: &Value) -> Result<Poly, Fault> {
    let written = text(value)?;
    let no = || unreadable(format!("found `{}`, expected a polynomial", shortened(&written)));
    let is_plain = |b: u8| b.is_ascii_lowercase() || b.is_ascii_digit() || b" *^+-".contains(&b);
    if written.len() > LONGEST || !written.bytes().all(is_plain) {
        return no();
    }
    let Ok(mut names) = Names::given(NAMES) else { return no() };
    let Some(read) = Expression::parse(written, &mut names).ok().and_then(|read| read.expand().ok()) else {
        return no();
    };
    let is_low = read.numerator.degrees().iter().all(|degree| *degree < 10);
    if is_low && read.denominator == Int::one() && text_of(&read.numerator, &names) == written {
        Ok(read.numerator)
    } else {
        no()
    }
}

fn text_of(p: &Poly, names: &Names) -> String {
    let rational = p.map(|c| Some(c.to_integer().into())).unwrap_or_else(Polynomial::zero);
    Format::Text.polynomial(&rational, names)
}

/// A family for a certificate: its conditions, and how the other joints follow from joint 1.
pub struct Listed {
    /// `bennett` or `spherical`.
    pub class: &'static str,
    /// The polynomials that vanish.
    pub conditions: Vec<Poly>,
    /// Of Bennett's loops the relations of joint 1 with joints 2, 3 and 4; of a spherical loop that of joints 1 and 4.
    pub motion: Vec<Poly>,
}

/// Returns the claim of a certificate about these families.
///
/// # Panics
/// Never: the names of the variables are distinct.
#[must_use]
pub fn claim_of_families(families: &[Listed]) -> Value {
    let names = Names::given(NAMES).expect("the names are distinct");
    let texts = |list: &[Poly]| list.iter().map(|p| text_of(&p.primitive_part(), &names)).collect::<Vec<_>>();
    let families = families.iter().map(|family| {
        json!({ "class": family.class, "conditions": texts(&family.conditions), "motion": texts(&family.motion) })
    });
    json!({
        "verb": "conditions",
        "status": "complete",
        "proof": "proved",
        "oblique_links": [1, 2, 3, 4],
        "moving_joints": [1, 4],
        "families": families.collect::<Vec<_>>(),
    })
}

/// Checks that the families are all those of loops of four rotations of which no twist is a multiple of pi, and joints 1 and 4 move.
/// Returns their number.
pub(super) fn check_families(
    data: &Map<String, Value>,
    status: &str,
    claim: &Claim,
    modes: usize,
    proof: &[Value],
) -> Result<usize, Fault> {
    require(Value::Object(data.clone()) == json!({ "joints": 4 }), "the data are those of no loop of four joints")?;
    require(modes == 0, "modes are not asked for")?;
    let [item] = proof else { return refused(format!("proof: found {} items, expected one", proof.len())) };
    let [kind] = fields(item, ["kind"], &[])?;
    require(kind == KIND, "the item is another one")?;
    if status != "complete" || claim.oblique_links != [1, 2, 3, 4] || claim.moving_joints != [1, 4] {
        return refused("claim: complete is the list for oblique links 1 to 4 and moving joints 1 and 4");
    }
    let Some((spherical, bennett)) = claim.families.split_last() else { return refused("claim: no family") };
    let offsets: Vec<Poly> = (OFFSETS..JOINTS).map(Poly::variable).collect();
    for family in bennett {
        let has_shape = family.class == "bennett" && family.conditions.len() == 9 && family.motion.len() == 3;
        require(has_shape && family.conditions[5..] == offsets, "a family of Bennett's has another form")?;
    }
    let pair = Closure::derive();
    let centre: Vec<Poly> = (LENGTHS..JOINTS).map(Poly::variable).collect();
    let is_spherical = spherical.class == "spherical" && spherical.conditions == centre;
    require(
        is_spherical && spherical.motion == [pair.f.clone()],
        "the last family is not that of axes through one point",
    )?;
    let coefficients = pair.in_general()?;
    sines(&coefficients)?;
    pair.on_deltoids()?;
    pair.on_isograms(bennett)?;
    Ok(claim.families.len())
}

fn require(holds: bool, what: &str) -> Result<(), Fault> {
    if holds { Ok(()) } else { refused(format!("proof: families: {what}")) }
}

fn t(k: usize) -> Poly {
    Poly::variable(k)
}

fn whole(n: i32) -> Poly {
    Poly::constant(Int::from(n))
}

/// Returns the product of `t_k (1 + t_k^2)`, which is not 0 where no twist is a multiple of pi.
fn oblique() -> Poly {
    (0..4).map(|k| t(k).add(&t(k).pow(3))).fold(Poly::one(), |product, p| product.mul(&p))
}

/// Returns whether a polynomial is not 0 where no twist is a multiple of pi and `allowed` is not 0: it has no factor besides theirs.
fn is_never_zero(p: &Poly, allowed: &Poly) -> bool {
    let allowed = allowed.mul(&oblique());
    let mut rest = p.clone();
    while !rest.is_zero() {
        let common = rest.gcd(&allowed);
        if common == Poly::one() {
            return rest.to_constant().is_some();
        }
        let Some(quotient) = rest.checked_div_exact(&common) else { return false };
        rest = quotient;
    }
    false
}

/// Returns the coefficients of the powers of some variables, by the exponents.
fn parts<const N: usize>(p: &Poly, places: [usize; N]) -> BTreeMap<[u32; N], Poly> {
    let mut found: BTreeMap<[u32; N], Vec<(Vec<u32>, Int)>> = BTreeMap::new();
    for (mut powers, c) in p.terms() {
        powers.resize(NAMES.len(), 0);
        let key = places.map(|k| std::mem::take(&mut powers[k]));
        found.entry(key).or_default().push((powers, c.clone()));
    }
    found.into_iter().map(|(key, terms)| (key, Poly::from_terms(terms))).collect()
}

fn at<const N: usize>(parts: &BTreeMap<[u32; N], Poly>, powers: [u32; N]) -> Poly {
    parts.get(&powers).cloned().unwrap_or_else(Poly::zero)
}

/// Returns a polynomial, of degree 2 at most in some variables, with quotients in their places, times the squares of the denominators.
/// No quotient has a variable that is replaced.
fn insert(p: &Poly, quotients: &[(usize, Ratio)]) -> Result<Poly, Fault> {
    quotients.iter().try_fold(p.clone(), |p, (variable, (above, below))| {
        let parts = p.coefficients_in(*variable);
        require(parts.len() <= 3, "a closure equation has a higher degree")?;
        let powers = [below.mul(below), above.mul(below), above.mul(above)];
        Ok(parts.iter().zip(&powers).fold(Poly::zero(), |sum, (part, power)| sum.add(&part.mul(power))))
    })
}

/// Returns the minors of n - 1 rows of n entries, with signs; where one of them is not 0, they solve the linear equations of the rows.
fn minors(rows: &[Vec<Poly>]) -> Vec<Poly> {
    let without = |k: usize| {
        let row = |row: &Vec<Poly>| row[..k].iter().chain(&row[k + 1..]).cloned().collect();
        let minor = Poly::determinant(&rows.iter().map(row).collect::<Vec<_>>());
        if k.is_multiple_of(2) { minor } else { minor.neg() }
    };
    (0..=rows.len()).map(without).collect()
}

fn combined(row: &[Poly], factors: &[Poly]) -> Poly {
    row.iter().zip(factors).fold(Poly::zero(), |sum, (x, y)| sum.add(&x.mul(y)))
}

fn is_only_in(p: &Poly, variables: &[usize]) -> bool {
    (0..p.variables()).all(|k| p.degree(k) == 0 || variables.contains(&k))
}

fn screw_x((sin, cos): &Ratio, length: Poly) -> DualQuaternion<Poly> {
    let shift = DualQuaternion::translation(&[length, Poly::zero(), Poly::zero()]);
    DualQuaternion::rotation_x(cos.clone(), sin.clone()).mul(&shift)
}

fn screw_z((sin, cos): &Ratio, offset: Poly) -> DualQuaternion<Poly> {
    let shift = DualQuaternion::translation(&[Poly::zero(), Poly::zero(), offset]);
    DualQuaternion::rotation_z(cos.clone(), sin.clone()).mul(&shift)
}

/// Twists of the second links of two pairs by those of the first ones, and the relations.
struct Twists {
    inserted: [(usize, Ratio); 2],
    relations: [Poly; 2],
}

/// Returns all twists with `t_j = +-t_i` for both pairs of links, or `+-1/t_i` for both.
fn related(pairs: [[usize; 2]; 2]) -> impl Iterator<Item = Twists> {
    let choices = [(1, 1), (1, -1), (-1, 1), (-1, -1)].into_iter().flat_map(|signs| [(signs, false), (signs, true)]);
    choices.map(move |((one, other), is_inverse)| {
        let both = [(one, pairs[0]), (other, pairs[1])];
        let inserted = both.map(|(sign, [i, j])| {
            (j, if is_inverse { (whole(sign), t(i)) } else { (t(i).mul(&whole(sign)), Poly::one()) })
        });
        let relations =
            both.map(
                |(sign, [i, j])| {
                    if is_inverse { t(i).mul(&t(j)).sub(&whole(sign)) } else { t(i).sub(&t(j).mul(&whole(sign))) }
                },
            );
        Twists { inserted, relations }
    })
}

/// The closure equations: all but link 2 leave the axes of joints 2 and 3 its twist and its length.
struct Closure {
    f: Poly,
    g: Poly,
    /// The coefficients of g by `COLUMNS`.
    slopes: [Poly; 6],
}

impl Closure {
    fn derive() -> Self {
        let v = Poly::variable;
        let link = |k: usize| screw_x(&(t(k), Poly::one()), v(LENGTHS + k));
        let joint = |k: usize| screw_z(&(v(JOINTS + k), Poly::one()), v(OFFSETS + k));
        let around = link(2).mul(&joint(3)).mul(&link(3)).mul(&joint(0)).mul(&link(0));
        let ([p, q, r, s], [u, v, w, z]) = around.study();
        // The square of the tangent of half the angle of both axes: that of link 2 is t^2, over dual numbers with the length a.
        let (square, length) = (t(1).pow(2), t(1).mul(&Poly::variable(LENGTHS + 1)));
        let (along, across) = (p.mul(&p).add(&s.mul(&s)), q.mul(&q).add(&r.mul(&r)));
        let f = square.mul(&along).sub(&across);
        let moments = square.mul(&p.mul(&u).add(&s.mul(&z))).sub(&q.mul(&v).add(&r.mul(&w)));
        let g = moments.add(&moments).add(&length.mul(&along.add(&across)));
        let slopes = COLUMNS.map(|k| g.derivative(k));
        Self { f: f.primitive_part(), g, slopes }
    }

    /// Points 1 and 2 of the proof: what f and g are, and f without factors. Returns the coefficients A, B, C and E.
    fn in_general(&self) -> Result<[Poly; 4], Fault> {
        let variables = COLUMNS.map(Poly::variable);
        require(combined(&self.slopes, &variables) == self.g, "g is not linear in lengths and offsets")?;
        let curve = parts(&self.f, ENDS);
        let columns = self.slopes.each_ref().map(|slope| parts(slope, ENDS));
        let (lengths, offsets) = columns.split_at(4);
        let are_even = lengths.iter().chain([&curve]).all(|own| own.keys().all(|powers| EVEN.contains(powers)));
        let are_odd = offsets.iter().all(|own| own.keys().all(|powers| ODD.contains(powers)));
        require(are_even && are_odd, "f or g have other terms")?;
        let [a, b, c, e, m] = EVEN.map(|powers| at(&curve, powers));
        let four = whole(4);
        let beta = m.mul(&m).sub(&four.mul(&a.mul(&e).add(&b.mul(&c))));
        let square = beta.mul(&beta).sub(&whole(64).mul(&a).mul(&b).mul(&c).mul(&e));
        let one = Poly::one();
        require(is_never_zero(&m, &one) && is_never_zero(&square, &one), "f may have factors of another kind")?;
        let row = |powers: [u32; 2]| lengths.iter().chain([&curve]).map(|own| at(own, powers)).collect::<Vec<_>>();
        require(is_never_zero(&Poly::determinant(&EVEN.map(row)), &one), "f may have multiples with lengths")?;
        let row = |own: &BTreeMap<[u32; 2], Poly>| {
            vec![at(own, [1, 0]).sub(&at(own, [1, 2])), at(own, [0, 1]).sub(&at(own, [2, 1]))]
        };
        let rows = offsets.iter().map(row).collect::<Vec<_>>();
        require(is_never_zero(&Poly::determinant(&rows), &one), "f may have multiples with offsets")?;
        Ok([a, b, c, e])
    }

    /// Point 4: behind a factor for a joint that stands still the rest of f has two multiples that may be g: f itself, which has no
    /// lengths, and one that is odd and has no offsets.
    fn on_deltoids(&self) -> Result<(), Fault> {
        for twists in related([[0, 1], [2, 3]]).chain(related([[0, 3], [1, 2]])) {
            let inserted = |p: &Poly| Ok(parts(&insert(p, &twists.inserted)?, ENDS));
            let curve = inserted(&self.f)?;
            let (d1, d4) = (inserted(&self.slopes[4])?, inserted(&self.slopes[5])?);
            let zeros = EVEN.map(|powers| !curve.contains_key(&powers));
            // The exponents by which f is moved, whether that of x4, and whether up.
            let (is_fourth, is_up) = match zeros {
                [true, false, true, false, false] => (true, true),
                [false, true, false, true, false] => (true, false),
                [true, true, false, false, false] => (false, true),
                [false, false, true, true, false] => (false, false),
                _ => return refused("proof: families: f has other factors"),
            };
            let turned = |[i, j]: [u32; 2]| if is_fourth { [i, j] } else { [j, i] };
            let row = |own: &dyn Fn([u32; 2]) -> Poly| {
                vec![own(turned([1, 0])), own(turned([1, 2])), own(turned([0, 1])).sub(&own(turned([2, 1])))]
            };
            let before = |powers: [u32; 2]| {
                let [i, j] = turned(powers);
                // f is of degree 1 in the variable if it is moved up, and divisible by it if it is moved down.
                let j = if is_up { j.checked_sub(1) } else { Some(j + 1) };
                j.map_or_else(Poly::zero, |j| at(&curve, turned([i, j])))
            };
            let rows = [row(&|powers| at(&d1, powers)), row(&|powers| at(&d4, powers)), row(&before)];
            require(is_never_zero(&Poly::determinant(&rows), &Poly::one()), "a deltoid may have offsets")?;
        }
        Ok(())
    }

    /// Point 5: f is the product of the curves of two families, and on each of them g is 0 for their lengths only.
    fn on_isograms(&self, families: &[Family]) -> Result<(), Fault> {
        for twists in related([[0, 2], [1, 3]]) {
            let mut rest = insert(&self.f, &twists.inserted)?;
            let mut curves = 0;
            for family in families.iter().filter(|family| family.conditions[..2] == twists.relations) {
                let quotient = rest.checked_div_exact(&family.motion[2]);
                let Some(quotient) = quotient else { return refused("proof: families: a curve is no factor of f") };
                rest = quotient;
                curves += 1;
                self.on_curve(&twists, family)?;
            }
            require(curves == 2 && is_never_zero(&rest, &Poly::one()), "an isogram has other than two curves")?;
        }
        Ok(())
    }

    fn on_curve(&self, twists: &Twists, family: &Family) -> Result<(), Fault> {
        let one = Poly::one();
        let table: Vec<Vec<Poly>> = family.conditions[2..5]
            .iter()
            .map(|p| (LENGTHS..OFFSETS).map(|k| p.derivative(k)).collect::<Vec<_>>())
            .collect();
        let variables: Vec<Poly> = (LENGTHS..OFFSETS).map(Poly::variable).collect();
        let are_linear = table
            .iter()
            .zip(&family.conditions[2..5])
            .all(|(row, p)| combined(row, &variables) == *p && row.iter().all(|x| is_only_in(x, &[0, 1])));
        require(are_linear, "the conditions of lengths are not linear")?;
        let lengths = minors(&table);
        require(lengths.iter().any(|p| is_never_zero(p, &one)), "the lengths are not determined")?;
        let mut angles: Vec<Ratio> = vec![(Poly::variable(JOINTS), Poly::one())];
        for (x, p) in (JOINTS + 1..).zip(&family.motion) {
            let cos = p.derivative(x);
            let sin = cos.mul(&Poly::variable(x)).sub(p);
            let follows = [&sin, &cos].into_iter().all(|part| is_only_in(part, &[0, 1, JOINTS]));
            // Where both were 0 the relation would say nothing.
            require(follows && sin.gcd(&cos) == one, "an angle does not follow from the first one")?;
            angles.push((sin, cos));
        }
        let powers: Vec<[u32; 2]> = parts(&family.motion[2], ENDS).into_keys().collect();
        require(powers == [[0, 0], [1, 1]] || powers == [[0, 1], [1, 0]], "a curve may have factors")?;
        let fourth = angles[3].clone();
        let allowed = fourth.0.mul(&fourth.1);
        let quotients: Vec<(usize, Ratio)> = twists.inserted.iter().cloned().chain([(ENDS[1], fourth)]).collect();
        let restricted = |slope: &Poly| Ok(parts(&insert(slope, &quotients)?, [JOINTS]));
        let columns = self.slopes.iter().map(restricted).collect::<Result<Vec<_>, Fault>>()?;
        let (rows, others) = (rows(&columns[..4]), rows(&columns[4..]));
        require(rows.iter().all(|row| combined(row, &lengths).is_zero()), "the lengths are others")?;
        let is_alone = rows.len() == 3 && minors(&rows).iter().any(|p| is_never_zero(p, &allowed));
        require(is_alone, "there may be other lengths")?;
        let is_flat = others.len() == 2 && is_never_zero(&Poly::determinant(&others), &allowed);
        require(is_flat, "there may be offsets")?;
        let scale = Poly::variable(LENGTHS);
        let around = (0..4).fold(DualQuaternion::identity(), |product, k| {
            let given = twists.inserted.iter().find(|(link, _)| *link == k);
            let tangent = given.map_or_else(|| (t(k), Poly::one()), |(_, ratio)| ratio.clone());
            product.mul(&screw_z(&angles[k], Poly::zero())).mul(&screw_x(&tangent, lengths[k].mul(&scale)))
        });
        let ([_, x, y, z], dual) = around.study();
        require([x, y, z].iter().chain(&dual).all(Poly::is_zero), "the loop opens")
    }
}

/// Returns the linear equations that hold for every power of x1, of which these are the columns.
fn rows(columns: &[BTreeMap<[u32; 1], Poly>]) -> Vec<Vec<Poly>> {
    let powers: std::collections::BTreeSet<[u32; 1]> = columns.iter().flat_map(BTreeMap::keys).copied().collect();
    powers.into_iter().map(|power| columns.iter().map(|column| at(column, power)).collect()).collect()
}

/// Point 3: A, B, C and E are products of two sines of half a sum of the twists, other ones each.
fn sines(coefficients: &[Poly; 4]) -> Result<(), Fault> {
    let mut found: [Vec<[i32; 4]>; 4] = Default::default();
    let mut products: [Poly; 4] = std::array::from_fn(|_| Poly::one());
    for choice in 0..8 {
        let signs: [i32; 4] = std::array::from_fn(|k| if k > 0 && choice >> (k - 1) & 1 == 1 { -1 } else { 1 });
        let (mut sin, mut cos) = (Poly::zero(), Poly::one());
        for (k, &sign) in signs.iter().enumerate() {
            let own = t(k).mul(&whole(sign));
            (sin, cos) = (sin.add(&own.mul(&cos)), cos.sub(&own.mul(&sin)));
        }
        for (k, p) in coefficients.iter().enumerate() {
            if p.checked_div_exact(&sin).is_some() {
                found[k].push(signs);
                products[k] = products[k].mul(&sin);
            }
        }
    }
    let are_products = coefficients.iter().zip(&products).all(|(p, product)| is_never_zero(p, product));
    require(are_products, "f has other coefficients")?;
    for (k, own) in found.iter().enumerate() {
        for (l, others) in found.iter().enumerate().skip(k + 1) {
            for (one, other) in own.iter().flat_map(|one| others.iter().map(move |other| (one, other))) {
                let unlike: Vec<usize> = (0..4).filter(|&i| one[i] != other[i]).collect();
                let is_isogram = unlike.len() % 2 == 1 || unlike == [0, 2] || unlike == [1, 3];
                let may_be = !unlike.is_empty() && (is_isogram || !OPPOSITE.contains(&[k, l]));
                require(may_be, "coefficients vanish together elsewhere")?;
            }
        }
    }
    Ok(())
}
