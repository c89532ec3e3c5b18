//! Configurations of a loop with some joints held, and what they prove.

use super::answer::{Configuration, Held};
use super::ground::{Grounded, in_terms_of};
use super::order::{Germ, Local};
use super::stillness::all_stand_still;
use crate::algebra::number_field::Algebraic;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::exact::linkage::{JointValue, Linkage, is_unit};
use crate::exact::positions::{Conjugates, Positions, is_properly_open, positions};
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::screw_system::{Screw, ScrewSystem};
use rug::{Float, Rational};

/// Tangents of half the angles at which joints are held, one after the other: no special ones, with few digits, and all
/// round the circle.
const TANGENTS: [(i32, i32); 24] = [
    (1, 2),
    (-1, 3),
    (4, 3),
    (-7, 3),
    (-5, 7),
    (8, 3),
    (2, 9),
    (-6, 1),
    (3, 4),
    (-1, 9),
    (11, 2),
    (-10, 7),
    (5, 14),
    (-1, 2),
    (17, 16),
    (-19, 5),
    (1, 16),
    (-2, 9),
    (13, 1),
    (-13, 14),
    (5, 8),
    (-20, 1),
    (12, 7),
    (-3, 5),
];
/// Bits in which real configurations are evaluated before they are rounded.
const BITS: u32 = 256;

/// Over a number field the number of values at which joints are held is this, over the degree and the number of joint variables:
/// arithmetic is slower there, and an ordinary loop that moves is recognised at the first values.
const WORK: usize = 400;

/// The result of holding joints.
pub(super) struct Search {
    /// The joint variables held, and their values.
    pub held: Held,
    /// Real configurations that move.
    pub configurations: Vec<Configuration>,
    /// The number of configurations, complex ones included.
    pub complex: usize,
}

/// The outcome of a search.
pub(super) enum Outcome {
    /// Real configurations with a motion through each of them.
    Mobile(Search),
    /// Configurations that move, none of them real where it was looked.
    Complex(Search),
    /// No motion was found.
    Nothing,
}

/// Decides by proof whether a chain of up to six joint variables moves: `None` where neither a real motion was found nor its
/// absence proved.
///
/// # Source
/// docs/mobility.md, theorems 1, 2, 4, 5 and 6.
#[must_use]
pub fn moves(linkage: &Linkage<Rational>) -> Option<bool> {
    // The cheaper test comes first.
    if all_stand_still(linkage) {
        return Some(false);
    }
    if matches!(search(linkage, &[]), Outcome::Mobile(_)) {
        return Some(true);
    }
    is_open_everywhere(linkage).then_some(false)
}

/// Looks for a motion: holds as few joints as leave finitely many configurations, and decides what passes through those.
pub(super) fn search(linkage: &Linkage<Rational>, spherical_joints: &[usize]) -> Outcome {
    let setting = Setting::of(linkage, spherical_joints);
    let found = searched(&setting, usize::MAX, |held| at(linkage, held));
    if matches!(found, Outcome::Mobile(_)) {
        return found;
    }
    // The configuration that a file of screws gives, where holding joints separates none.
    let home = Conjugates::home(linkage).map(|home| setting.decide(&[], &[home]));
    match home.filter(|search| search.configurations.iter().any(|c| c.dimension() > Some(0))) {
        Some(search) => Outcome::Mobile(search),
        None => found,
    }
}

/// Searches a loop over a number field as well; its home configuration is looked at first.
pub(super) fn search_over(ground: &Grounded, unit: &Rational) -> Outcome {
    let setting = Setting::over(ground, unit);
    if let Some(home) = ground.home() {
        let search = setting.decide(&[], &[home]);
        if search.configurations.iter().any(|c| c.dimension() > Some(0)) {
            return Outcome::Mobile(search);
        }
    }
    let n = ground.linkage.variables.len();
    let attempts = if n > 6 { 0 } else { WORK / (ground.field.degree() * n) };
    if attempts == 0 { Outcome::Nothing } else { searched(&setting, attempts, |held| ground.at(held)) }
}

/// Looks for a motion with this way to find the configurations with joints held.
fn searched(
    setting: &Setting,
    attempts: usize,
    at: impl Fn(&[(usize, Rational)]) -> Option<Vec<Conjugates>>,
) -> Outcome {
    let n = setting.variables.len();
    let (mut complex, mut tried) = (None, 0);
    for count in n.saturating_sub(5).max(1)..n {
        let mut is_free = false;
        for start in 0..n {
            for shift in 0..TANGENTS.len() {
                let held: Vec<(usize, Rational)> =
                    (0..count).map(|k| ((start + k) % n, setting.tangent((start + k) % n, shift + k))).collect();
                if tried == attempts {
                    return Outcome::Nothing;
                }
                tried += 1;
                let Some(found) = at(&held) else {
                    is_free = true;
                    break;
                };
                if found.is_empty() {
                    break;
                }
                let search = setting.decide(&held, &found);
                if search.configurations.iter().any(|c| c.dimension() > Some(0)) {
                    return Outcome::Mobile(search);
                }
                if search.configurations.is_empty() && complex.is_none() && setting.some_move(&held, &found) {
                    complex = Some(search);
                }
            }
        }
        if !is_free {
            break;
        }
    }
    complex.map_or(Outcome::Nothing, Outcome::Complex)
}

/// Half the angle's tangent, or half the distance, at which a joint variable is held, over the length of its axis.
fn tangent(variable: Variable, unit: &Rational, shift: usize) -> Rational {
    let tangent = Rational::from(TANGENTS[shift % TANGENTS.len()]);
    match variable {
        Variable::Rotation => tangent,
        Variable::Translation => tangent * unit,
    }
}

/// The linkage over the field of a configuration, if it has an image there.
type Image<'a> = Box<dyn Fn(&Conjugates) -> Option<Linkage<Algebraic>> + 'a>;

/// A loop whose configurations are looked at: over the rationals or a number field.
struct Setting<'a> {
    variables: &'a [Variable],
    /// Lengths of the axes.
    lengths: Vec<Float>,
    unit: Rational,
    /// Indices at which the three variables of spherical joints begin.
    spherical_joints: &'a [usize],
    /// The loop in the field of some configurations.
    image: Image<'a>,
}

impl<'a> Setting<'a> {
    fn of(linkage: &'a Linkage<Rational>, spherical_joints: &'a [usize]) -> Self {
        let lengths = linkage.axes.iter().map(|axis| axis.length(BITS)).collect();
        let image = Box::new(|_: &Conjugates| linkage.map());
        Self { variables: &linkage.variables, lengths, unit: linkage.unit(), spherical_joints, image }
    }

    fn over(ground: &'a Grounded, unit: &Rational) -> Self {
        let image = |conjugates: &Conjugates| {
            let element = &conjugates.ground.as_ref()?.element;
            ground.linkage.over(|x| Some(in_terms_of(x, element)))
        };
        let lengths = ground.lengths(BITS);
        Self {
            variables: &ground.linkage.variables,
            lengths,
            unit: unit.clone(),
            spherical_joints: &ground.spherical_joints,
            image: Box::new(image),
        }
    }

    fn tangent(&self, k: usize, shift: usize) -> Rational {
        tangent(self.variables[k], &self.unit, shift)
    }
}

/// All configurations with joints held; `None` where they are not finitely many, or were not found.
pub(super) fn at(linkage: &Linkage<Rational>, held: &[(usize, Rational)]) -> Option<Vec<Conjugates>> {
    let pairs: Vec<(usize, JointValue<Rational>)> =
        held.iter().map(|(k, tangent)| (*k, [Rational::from(1), tangent.clone()])).collect();
    match positions(&linkage.locked(&pairs)) {
        Positions::Finite { found, .. } => Some(found),
        Positions::Unknown => None,
    }
}

/// Whether it is proved that no joint variable moves along any curve of configurations: each one is held at a value at
/// which the closure equations have no solution at all, not even a limit of configurations.
pub(super) fn is_open_everywhere(linkage: &Linkage<Rational>) -> bool {
    let (n, unit) = (linkage.variables.len(), linkage.unit());
    let stands_still = |k: usize| {
        let value = [Rational::from(1), tangent(linkage.variables[k], &unit, k)];
        is_properly_open(&linkage.locked(&[(k, value)]))
    };
    (2..=6).contains(&n) && (0..n).all(stands_still)
}

/// The values of all joint variables, with those held among them.
fn with_held(held: &[(usize, Rational)], conjugates: &Conjugates) -> Option<Vec<JointValue<Algebraic>>> {
    let n = held.len() + conjugates.values.len();
    let mut rest = conjugates.values.iter();
    (0..n)
        .map(|k| match held.iter().find(|(at, _)| *at == k) {
            Some((_, tangent)) => Some([Algebraic::one(), Algebraic::from_rational(tangent)?]),
            None => rest.next().cloned(),
        })
        .collect()
}

/// The exact properties of conjugate configurations.
struct Known {
    values: Vec<JointValue<Algebraic>>,
    germ: Germ<Algebraic>,
    moving: Vec<bool>,
    system: String,
    redundant: Vec<Screw<Algebraic>>,
}

impl Known {
    fn of(setting: &Setting, held: &[(usize, Rational)], conjugates: &Conjugates) -> Option<Self> {
        let values = with_held(held, conjugates)?;
        let linkage = (setting.image)(conjugates)?;
        let position = linkage.at(&values).with_regular_spherical_joints(setting.spherical_joints);
        let mut germ = Germ::of_conjugates(&position, conjugates.fewest_conjugates());
        // Two first-order motions or more: with another joint held there may be a curve all the same. It is all there is, since
        // with the one joint held the configurations are finitely many.
        let n = position.joints();
        if germ.local == Local::Deficient && held.len() == 1 && n > 2 && setting.spherical_joints.is_empty() {
            let curve = |k: &usize| matches!(Germ::of(&position.without(*k)).local, Local::Curve);
            if let Some(k) = (0..n).filter(|k| *k != held[0].0).find(curve) {
                let rest = Germ::of(&position.without(k));
                germ.local = Local::Curve;
                germ.series = rest.series;
                germ.series.insert(k, Vec::new());
            }
        }
        let system: ScrewSystem<Algebraic> = germ.system();
        let freedom = system.loop_freedom();
        let mut moving: Vec<bool> = match germ.local {
            Local::Curve => germ.series.iter().map(|series| series.iter().any(is_unit)).collect(),
            _ => (0..values.len()).map(|k| freedom.rates.iter().any(|rate| is_unit(&rate[k]))).collect(),
        };
        // The three variables of a spherical joint are those of one motion.
        for k in setting.spherical_joints.iter().copied() {
            let moves = moving[k..k + 3].contains(&true);
            moving[k..k + 3].fill(moves);
        }
        let (description, redundant) = (system.description(), freedom.redundant.basis());
        // The inverse is taken here, so that a pitch that vanishes only at some roots separates them.
        for screw in &redundant {
            let _ = screw.pitch().map(|pitch| is_unit(&pitch));
        }
        Some(Self { values, germ, moving, system: description, redundant })
    }

    /// Returns the configuration in floating point, at one value of the root.
    fn configuration(&self, setting: &Setting, degree: usize, root: &Float) -> Configuration {
        let value = |x: &Algebraic| x.at(root).to_f64();
        let joint = |(k, [c, s]): (usize, &JointValue<Algebraic>)| {
            let (c, s) = (c.at(root), s.at(root) * &setting.lengths[k]);
            match setting.variables[k] {
                Variable::Rotation => {
                    // Of (c : s) and (-c : -s) the one within half a turn is taken.
                    let angle = if c < 0 { Float::with_val(BITS, -s).atan2(&-c) } else { s.atan2(&c) };
                    2.0 * angle.to_f64()
                }
                Variable::Translation => 2.0 * Float::with_val(BITS, s / c).to_f64(),
            }
        };
        let screw = |screw: &Screw<Algebraic>| Screw {
            direction: screw.direction.each_ref().map(value),
            moment: screw.moment.each_ref().map(value),
        };
        Configuration {
            q: self.values.iter().enumerate().map(joint).collect(),
            degree,
            rank: self.germ.rank,
            local: self.germ.local.clone(),
            moving: self.moving.clone(),
            branch: None,
            system: self.system.clone(),
            redundant: self.redundant.iter().map(screw).collect(),
        }
    }
}

/// Decides the real ones of these configurations.
pub(super) fn decide(
    linkage: &Linkage<Rational>,
    spherical_joints: &[usize],
    held: &[(usize, Rational)],
    found: &[Conjugates],
) -> Search {
    Setting::of(linkage, spherical_joints).decide(held, found)
}

impl Setting<'_> {
    /// Decides the real ones of these configurations.
    fn decide(&self, held: &[(usize, Rational)], found: &[Conjugates]) -> Search {
        let mut configurations = Vec::new();
        for conjugates in found.iter().filter(|conjugates| conjugates.real() > 0) {
            for (part, known) in conjugates.each(|part| Known::of(self, held, part)) {
                let Some(known) = known else { continue };
                let degree = part.polynomial.as_ref().and_then(Univariate::degree).unwrap_or(1);
                let here = |root: &Float| known.configuration(self, degree, root);
                if part.polynomial.is_none() {
                    configurations.push(here(&Float::new(BITS)));
                }
                for mut root in part.roots {
                    root.refine(&Rational::from((1, rug::Integer::from(1) << BITS)));
                    let (low, high) = root.bounds();
                    configurations.push(here(&Float::with_val(BITS, (low + high) / 2)));
                }
            }
        }
        configurations
            .sort_by(|a, b| a.q.iter().map(|x| x.abs()).sum::<f64>().total_cmp(&b.q.iter().map(|x| x.abs()).sum()));
        let value = |(k, tangent): &(usize, Rational)| {
            let t = Float::with_val(BITS, &self.lengths[*k] * tangent);
            (*k, 2.0 * if self.variables[*k] == Variable::Rotation { t.atan().to_f64() } else { t.to_f64() })
        };
        let complex = found.iter().map(Conjugates::count).sum();
        Search { held: held.iter().map(value).collect(), configurations, complex }
    }

    /// Whether some complex configuration moves.
    fn some_move(&self, held: &[(usize, Rational)], found: &[Conjugates]) -> bool {
        found.iter().flat_map(|conjugates| conjugates.each(|part| Known::of(self, held, part))).any(|(_, known)| {
            known.is_some_and(|known| matches!(known.germ.local, Local::Curve | Local::Manifold { .. }))
        })
    }
}
