//! The decision whether the loop of an entry moves.

use super::answer::{Configuration, JointVariable, Mobility};
use super::branches::branches;
use super::ground::Grounded;
use super::nearby::{Nearby, nearby};
use super::open::{of_arm, of_platform};
use super::order::{Germ, Local, MOST_SOLUTIONS};
use super::rounded::{Closing, closing, has_long_decimals, is_exact};
use super::search::{Outcome, Search, at, decide, is_open_everywhere, search, search_over};
use super::stillness::{all_stand_still, all_stand_still_modulo};
use crate::algebra::number::Number;
use crate::algebra::number_field::Algebraic;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::assembly::{Assembly, Roots, Workspace};
use crate::catalogue::entry::{Case, Design, Entry};
use crate::error::{Error, Result};
use crate::exact::linkage::{Axis, JointValue, Linkage};
use crate::exact::positions::Conjugates;
use crate::kinematics::chain::{Chain, Placement};
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::screw_system::ScrewSystem;
use crate::mechanism::{FullMode, Mechanism, Solution};
use crate::verdict::{Code, Proof, Status, Verdict};
use rug::{Float, Rational};

/// Theorem 4 in words.
const NO_CURVE: &str = "no curve of configurations: held at some value of any one of its joints, the loop has no configuration, \
                        nor a limit of any";
/// Theorems 5 and 6 in words.
const STILL: &str =
    "no curve of configurations: the conditions of its cuts leave every joint variable finitely many values";
/// Degree of the fields in which configurations of loops are looked for: beyond it a loop other than Bennett's takes too long.
const MOST: usize = 16;
/// Decimal digits in which a singular solution known in floating point is compared with simple rationals.
const SIMPLE: u32 = 6;

/// Decides whether the mechanism of an entry moves: a loop, whatever inputs its file gives; an arm, whose base is the only
/// thing held; a platform with its legs locked.
///
/// # Errors
/// [`crate::error::Error::Unsupported`] for H joints.
///
/// # Example
/// ```
/// use looproot::internal::{catalogue, mobility};
/// let entry = catalogue::builtin("bennett_a", &Default::default())?;
/// let answer = mobility::mobility(&entry)?;
/// assert_eq!((answer.mobility, answer.gruebler(), answer.screw_rank()), (Some(1), -2, Some(3)));
/// # Ok::<(), looproot::internal::error::Error>(())
/// ```
pub fn mobility(entry: &Entry) -> Result<Mobility> {
    let chain = match &entry.design {
        Design::Loop(chain) => chain,
        Design::Arm(chain) => return Ok(of_arm(chain, variables(chain))),
        Design::Platform(_) => return of_platform(entry),
    };
    let subject = Subject { entry, chain, linkage: Linkage::of(chain)?, variables: variables(chain) };
    let mut answer = if subject.variables.len() > 6 {
        match subject.over_its_field()? {
            Some(answer) => answer,
            None => subject.free(),
        }
    } else {
        subject.overconstrained()?
    };
    let found = branches(&subject.linkage, &answer.configurations);
    for (configuration, branch) in answer.configurations.iter_mut().zip(found) {
        configuration.branch = branch;
    }
    Ok(answer)
}

/// The joint variables of a chain in joint order.
fn variables(chain: &Chain) -> Vec<JointVariable> {
    chain.variables().into_iter().map(|own| JointVariable { joint: own.joint, variable: own.variable }).collect()
}

/// A loop in question.
pub(super) struct Subject<'a> {
    pub(super) entry: &'a Entry,
    pub(super) chain: &'a Chain,
    pub(super) linkage: Linkage<Rational>,
    pub(super) variables: Vec<JointVariable>,
}

impl Subject<'_> {
    /// An answer without configurations.
    pub(super) fn answer(&self, mobility: Option<usize>, (proof, code): (Proof, Code), reason: String) -> Mobility {
        Mobility {
            variables: self.variables.clone(),
            equations: 6,
            general_rank: None,
            mobility,
            proof,
            code,
            shaky: None,
            held: Vec::new(),
            configurations: Vec::new(),
            complex: 0,
            is_listed: true,
            reason,
        }
    }

    /// Limits an answer to the rounded numbers where the file has numbers that were rounded.
    pub(super) fn rounded(&self, answer: Mobility) -> Mobility {
        let proof = answer.proof.of_rounded(!is_exact(self.chain));
        if proof == answer.proof {
            return answer;
        }
        let reason =
            format!("{}; this holds for the loop with its irrational numbers rounded (--digits)", answer.reason);
        Mobility { proof, reason, ..answer }
    }

    /// Loops of up to six variables, which in general do not move.
    fn overconstrained(&self) -> Result<Mobility> {
        let answer = self.as_given()?;
        if answer.mobility > Some(0) {
            return Ok(answer);
        }
        // Angles of a spherical joint move without a motion where two of their axes coincide.
        if !self.spherical_joints().is_empty() {
            return Ok(answer);
        }
        let Some(Nearby { held, values, turn, shift }) = nearby(&self.linkage) else { return Ok(answer) };
        let joint = self.variables[held].joint;
        let immobile = if answer.mobility == Some(0) {
            "the loop as given is immobile, but near a mobile one"
        } else {
            "it is near a mobile one"
        };
        let reason = format!(
            "{}; {immobile}: with its links turned by at most {turn:.1e} rad and shifted by at most {shift:.1e} m it closes at {values} \
             values of joint {joint}, one behind the other (in floating point, no proof)",
            answer.reason
        );
        Ok(Mobility { reason, ..answer })
    }

    /// Decides the loop as given, without rounding it to a special one.
    fn as_given(&self) -> Result<Mobility> {
        if let Some(answer) = self.over_its_field()? {
            return Ok(answer);
        }
        let answer = self.exactly()?;
        let moves = answer.mobility > Some(0);
        let is_rounded = !is_exact(self.chain);
        if !is_rounded && (moves || !has_long_decimals(self.chain)) {
            return Ok(answer);
        }
        let closing = if moves { None } else { closing(self.entry, &self.variables)? };
        let remark = match closing {
            Some(closing) => return Ok(self.swept(&closing, is_rounded)),
            None if moves => "this holds for the loop with its irrational numbers rounded (--digits)",
            None if is_rounded => {
                "numbers of the file were rounded, which may have stopped a motion; to rounding the loop does not close \
                 through any range, either"
            }
            None => return Ok(answer),
        };
        let proof = answer.proof.of_rounded(is_rounded);
        Ok(Mobility { reason: format!("{}; {remark}", answer.reason), proof, ..answer })
    }

    /// Loops with irrational numbers of one field, decided in that; `None` for other loops, and where nothing is proved.
    fn over_its_field(&self) -> Result<Option<Mobility>> {
        if is_exact(self.chain) {
            return Ok(None);
        }
        let Some(ground) = Grounded::of(self.chain, self.spherical_joints()) else { return Ok(None) };
        let degree = ground.field.degree();
        let field = format!("in the number field of degree {degree} of the file");
        if self.variables.len() <= 6 && ground.residue().is_some_and(|image| all_stand_still_modulo(&image)) {
            // Where the joints are known to stand still, the rounded loop gives the configurations.
            let rounded =
                if self.variables.len() < 6 { self.immobile(Some(STILL)) } else { self.structure(Some(STILL))? };
            let reason = format!("{STILL} ({field}); the loop with its numbers rounded: {}", rounded.reason);
            return Ok(Some(Mobility { shaky: None, is_listed: false, reason, ..rounded }));
        }
        if let Some(values) = ground.bennett(self.chain) {
            return Ok(Some(self.of_family(&values, &ground, &field)));
        }
        if degree > MOST {
            return Ok(None);
        }
        Ok(match search_over(&ground, &self.linkage.unit()) {
            Outcome::Mobile(found) => {
                let answer = self.mobile(found);
                let reason = format!("{} ({field})", answer.reason);
                Some(Mobility { reason, ..answer })
            }
            _ => None,
        })
    }

    /// A loop that closes at these joint values for every x, with a configuration at x = 1.
    fn of_family(&self, values: &[JointValue<Univariate<Algebraic>>], ground: &Grounded, field: &str) -> Mobility {
        let root = &ground.field.conjugates()[0];
        let one = Algebraic::one();
        let angle = |[c, s]: &JointValue<Univariate<Algebraic>>| {
            let [c, s] = [c, s].map(|p| p.eval(&one).at(root).to_f64());
            2.0 * if c < 0.0 { (-s).atan2(-c) } else { s.atan2(c) }
        };
        let q: Vec<f64> = values.iter().map(angle).collect();
        let held = vec![(0, q[0])];
        let reason = format!(
            "a Bennett loop: with half-angle tangents that are multiples of that of joint 1, or of its inverse, the product round the \
             loop is a number, an identity of polynomials {field}"
        );
        let configurations = vec![self.placed(q, Local::Curve)];
        let rests_on = (Proof::Proved, Code::FamilyOfMobileLoops);
        Mobility { held, configurations, complex: 1, ..self.answer(Some(1), rests_on, reason) }
    }

    /// A loop that closes to rounding.
    fn swept(&self, closing: &Closing, is_rounded: bool) -> Mobility {
        let configurations: Vec<Configuration> =
            closing.modes.iter().map(|mode| Configuration { local: Local::Curve, ..self.measured(mode) }).collect();
        let what = if is_rounded {
            "numbers of the file were rounded, and exactly rounded numbers do not move"
        } else {
            "decimals of the file are so long that they are taken for rounded ones; as exact numbers they do not move"
        };
        let reason = format!(
            "{what}; as given, the loop closes with residuals up to {:.1e} at {} of {} inputs of joint {} round the \
             circle, one behind the other",
            closing.residual, closing.inputs.0, closing.inputs.1, self.variables[closing.held.0].joint
        );
        let complex = configurations.len();
        Mobility {
            held: vec![closing.held],
            configurations,
            complex,
            ..self.answer(Some(1), (Proof::None, Code::CertifiedSweep), reason)
        }
    }

    /// Decides by exact arithmetic alone.
    fn exactly(&self) -> Result<Mobility> {
        let is_short = self.variables.len() < 6;
        // Angles at which two axes of a spherical joint coincide would hide that it stands still.
        let turned = self.linkage.with_turned_spherical_joints(&self.spherical_joints());
        if all_stand_still(&turned) {
            return if is_short { Ok(self.immobile(Some(STILL))) } else { self.structure(Some(STILL)) };
        }
        match search(&self.linkage, &self.spherical_joints()) {
            Outcome::Mobile(found) => Ok(self.mobile(found)),
            Outcome::Complex(found) => {
                if let Some(reason) = self.too_wide() {
                    return Ok(self.answer(Some(0), (Proof::Proved, Code::LinkTooLong), reason));
                }
                let reason = format!(
                    "complex mobility; no real configuration found: with {} held there are {} complex solutions on \
                     curves, none of them real at the values tried",
                    self.held(&found),
                    found.complex
                );
                Ok(Mobility {
                    held: found.held,
                    complex: found.complex,
                    ..self.answer(None, (Proof::None, Code::ComplexMotion), reason)
                })
            }
            Outcome::Nothing => {
                let why = is_open_everywhere(&turned).then_some(NO_CURVE);
                if !is_short {
                    return self.structure(why);
                }
                // The centre of a spherical joint may decide what the three angles do not.
                let by_centre = if why.is_none() && self.spherical_joints().len() == 1 {
                    Some(self.structure(None)?).filter(|answer| answer.proof.is_proved())
                } else {
                    None
                };
                Ok(by_centre.unwrap_or_else(|| self.immobile(why)))
            }
        }
    }

    /// The names of the joint variables held.
    pub(super) fn held(&self, found: &Search) -> String {
        let name = |(k, value): &(usize, f64)| {
            let JointVariable { joint, variable } = self.variables[*k];
            match variable {
                Variable::Rotation => format!("joint {joint} at {:.6} deg", value.to_degrees()),
                Variable::Translation => format!("joint {joint} at distance {value:.6}"),
            }
        };
        found.held.iter().map(name).collect::<Vec<_>>().join(", ")
    }

    pub(super) fn mobile(&self, found: Search) -> Mobility {
        let moving: Vec<&Configuration> = found.configurations.iter().filter(|c| c.dimension() > Some(0)).collect();
        let dimension = moving.iter().filter_map(|c| c.dimension()).max().unwrap_or(0);
        let first = moving.first();
        let still = first.map_or(0, |c| c.moving.iter().filter(|moves| !**moves).count());
        let degree = first.map_or(1, |c| c.degree);
        let rank = first.map_or(0, |c| c.rank);
        let place = if degree == 1 {
            "a rational configuration".to_owned()
        } else {
            format!("a configuration over a number field of degree {degree}")
        };
        let (code, why) = if let Some(Local::Manifold { .. }) = first.map(|c| &c.local) {
            let why = format!(
                "at {place} the screws of the joints that can move span the Lie algebra of a group of motions, or joints of one axis undo \
                     each other, so that {} variables less screw rank {rank} move (theorem 1)",
                self.variables.len()
            );
            (Code::GroupOfMotions, why)
        } else {
            let why = format!(
                "at {place} the joint screws have rank {rank} and the reduced closure equations vanish beyond the order \
                     that an isolated solution can have (theorem 2)"
            );
            (Code::OrderExceedsBound, why)
        };
        let idle = if still > 0 { format!("; {still} joint variables stand still") } else { String::new() };
        let held = if found.held.is_empty() {
            "all joint variables at 0, where the file gives them".to_owned()
        } else {
            format!("{} held", self.held(&found))
        };
        let reason = format!("{why}; {held}{idle}");
        Mobility {
            held: found.held,
            configurations: found.configurations,
            complex: found.complex,
            ..self.answer(Some(dimension), (Proof::Proved, code), reason)
        }
    }

    /// Answers for loops of up to five variables in which no curve was found, with all their configurations. `why` is the reason
    /// why there is no curve, if it is known.
    fn immobile(&self, why: Option<&str>) -> Mobility {
        let mobility = why.map(|_| 0);
        let nothing = why.unwrap_or("no motion was found through any value of a joint");
        let Some(found) = at(&self.linkage, &[]) else {
            let reason = format!("{nothing}; the configurations could not be separated");
            return Mobility { is_listed: false, ..self.answer(mobility, rests_on(why.is_some()), reason) };
        };
        let complex: usize = found.iter().map(Conjugates::count).sum();
        let Search { configurations, .. } = decide(&self.linkage, &self.spherical_joints(), &[], &found);
        let real = configurations.len();
        let shaky = configurations.iter().filter_map(order).max().filter(|order| *order > 1);
        let reason = match (complex, real) {
            (0, _) => "no configuration: the closure equations have no solution, real or complex".to_owned(),
            (_, 0) => format!("no real configuration: {complex} complex ones, all of them isolated"),
            _ => {
                // A list that is finite leaves none for a curve, whatever is known of each.
                let unknown = configurations.iter().any(|c| c.dimension() != Some(0));
                let unknown = if unknown { "; the multiplicity of one is not known" } else { "" };
                let clause = order_clause(shaky);
                format!("{real} real of {complex} complex configurations, all of them isolated{clause}{unknown}")
            }
        };
        Mobility { shaky, configurations, complex, ..self.answer(Some(0), rests_on(true), reason) }
    }

    /// Loops of six variables in which no curve was found; `why` as above.
    fn structure(&self, why: Option<&str>) -> Result<Mobility> {
        let is_complete = |verdict: &Verdict| matches!(verdict.status, Status::Complete | Status::Unreachable);
        // Modes that a small error has left of a motion are crowded: as a loop it is solved in multiprecision arithmetic at once.
        // Where it is known that no curve is among them, the configurations themselves need no proof that takes seconds.
        let is_still = why.is_some();
        let solution = match solve(self.entry, Case::free(0), is_still) {
            Ok(solution) if is_complete(&solution.verdict) => solution,
            Ok(solution) => {
                // A loop is an arm that holds its own base.
                let mut arm = self.entry.clone();
                arm.design = Design::Arm(self.chain.clone());
                let other = solve(&arm, Case::at(Placement::identity(), 0), is_still).ok();
                other.filter(|other| is_complete(&other.verdict)).unwrap_or(solution)
            }
            Err(Error::Unsupported(_) | Error::UnsupportedMobility(_)) => {
                let nothing = why.unwrap_or(
                    "no motion was found through any value of a joint, but that there is none is not proved",
                );
                let reason = format!("{nothing}; the configurations of loops of such joints are not listed");
                return Ok(Mobility {
                    is_listed: false,
                    ..self.answer(why.map(|_| 0), rests_on(why.is_some()), reason)
                });
            }
            Err(error) => return Err(error),
        };
        let verdict = &solution.verdict;
        let is_complete = is_complete(verdict);
        // If there are as many isolated configurations as loops of this kind can have, there is no curve. The configurations are
        // those of unit axes, which are rounded where an axis has irrational length.
        let meets_bound = verdict.certified == MOST_SOLUTIONS
            || verdict.proof.is_proved()
                && verdict.code == Code::GeneralBoundMet
                && verdict.certified == verdict.complex
                && verdict.complex > 0;
        let is_full = is_complete && meets_bound && self.linkage.axes.iter().all(|axis| *axis == Axis::Z);
        // A finite list of all complex solutions, multiple ones included, has no curve beside it. What spins between two spherical
        // joints is no part of such a list.
        let is_counted = is_complete
            && verdict.proof.is_proved()
            && verdict.complex_complete
            && matches!(verdict.code, Code::ExactRootsMatched | Code::NoSolution)
            && self.spherical_joints().len() < 2;
        let is_proved = is_full || is_counted || why.is_some();
        let mut configurations = Vec::new();
        for mode in solution.modes.iter().filter(|mode| mode.real) {
            configurations.push(self.singular(mode).unwrap_or_else(|| self.measured(mode)));
        }
        if !is_complete {
            let (mobility, reason) = if is_proved {
                (Some(0), why.unwrap_or(NO_CURVE))
            } else {
                (None, "no motion was found through any value of a joint")
            };
            let reason = format!("{reason}; the isolated configurations: {}", verdict.reason);
            let (complex, is_listed) = (verdict.complex, false);
            return Ok(Mobility {
                configurations,
                complex,
                is_listed,
                ..self.answer(mobility, rests_on(is_proved), reason)
            });
        }
        let shaky = configurations.iter().filter_map(order).max().filter(|order| *order > 1);
        let (complex, real) = (verdict.complex, configurations.len());
        let what = match (complex, real) {
            (0, _) => "no configuration".to_owned(),
            (_, 0) => format!("no real configuration, {complex} complex ones"),
            _ => format!("{real} isolated real configurations{}", order_clause(shaky)),
        };
        let curves = if is_full {
            "as many as there can be"
        } else if is_counted {
            "these are all, complex ones included, so that none of them moves"
        } else {
            why.unwrap_or("no motion was found through any value of a joint, but that there is none is not proved")
        };
        let reason = format!("{what}: {}; {curves}", verdict.reason);
        // The list of configurations has a proof of its own, apart from the proof that none of them moves.
        let is_listed = verdict.proof.is_proved();
        Ok(Mobility { shaky, configurations, complex, is_listed, ..self.answer(Some(0), rests_on(is_proved), reason) })
    }

    /// The exact configuration near a multiple solution, if one of its joints stands at a simple value.
    fn singular(&self, mode: &FullMode) -> Option<Configuration> {
        if mode.certified && mode.multiplicity == 1 {
            return None;
        }
        let unit = self.linkage.unit();
        for (k, z) in mode.q.iter().enumerate() {
            let half = z.re / 2.0;
            let length = self.linkage.axes[k].length(53).to_f64();
            let value = match self.variables[k].variable {
                Variable::Rotation => half.tan() / length,
                Variable::Translation => half / length,
            };
            let tangent = if value.abs() < 1e-6 * unit.to_f64() {
                Rational::new()
            } else {
                Number::near(&Float::with_val(53, value), SIMPLE)
            };
            let held = [(k, tangent)];
            let Some(found) = at(&self.linkage, &held) else { continue };
            let close = |c: &Configuration| c.q.iter().zip(&mode.q).all(|(a, b)| ((a - b.re) / 2.0).sin().abs() < 1e-4);
            if let Some(found) =
                decide(&self.linkage, &self.spherical_joints(), &held, &found).configurations.into_iter().find(close)
            {
                return Some(found);
            }
        }
        None
    }

    /// A configuration as it is in floating point.
    pub(super) fn measured(&self, mode: &FullMode) -> Configuration {
        let n = self.variables.len();
        // Certified simple solutions of six equations in six unknowns are regular: rank 6.
        let local = match (mode.certified, n) {
            (true, 6) if mode.multiplicity < 2 => Local::Isolated { order: 1 },
            (true, 7..) if mode.multiplicity < 2 => Local::Manifold { dimension: n - 6 },
            _ if mode.multiplicity > 0 => Local::Isolated { order: mode.multiplicity },
            _ => Local::Deficient,
        };
        let is_regular = n >= 6 && mode.certified && mode.multiplicity < 2;
        let placed = self.placed(mode.q.iter().map(|z| z.re).collect(), local);
        // Lengths that differ by many powers of ten hide the rank from a measurement.
        if is_regular && placed.rank < 6 {
            return Configuration { rank: 6, system: SCREWS_OF_RANK_SIX.to_owned(), redundant: Vec::new(), ..placed };
        }
        placed
    }

    /// The configuration of these joint values, near which the configurations form what `local` says.
    pub(super) fn placed(&self, q: Vec<f64>, local: Local) -> Configuration {
        let value = |(k, q): (usize, &f64)| -> JointValue<f64> {
            let length = self.linkage.axes[k].length(53).to_f64();
            match self.variables[k].variable {
                Variable::Rotation => [(q / 2.0).cos(), (q / 2.0).sin() / length],
                Variable::Translation => [1.0, q / 2.0 / length],
            }
        };
        let values: Vec<JointValue<f64>> = q.iter().enumerate().map(value).collect();
        let linkage: Option<Linkage<f64>> = self.linkage.map();
        let germ = linkage
            .map(|linkage| Germ::of(&linkage.at(&values).with_regular_spherical_joints(&self.spherical_joints())));
        let system = germ.as_ref().map(Germ::system);
        let freedom = system.as_ref().map(ScrewSystem::loop_freedom);
        let rank = freedom.as_ref().map_or(0, |freedom| freedom.order);
        let moves = |k: usize| freedom.as_ref().is_some_and(|freedom| !freedom.locked.contains(&k));
        Configuration {
            degree: 0,
            rank,
            local,
            moving: (0..q.len()).map(moves).collect(),
            q,
            branch: None,
            system: system.as_ref().map(ScrewSystem::description).unwrap_or_default(),
            redundant: freedom.map(|freedom| freedom.redundant.basis()).unwrap_or_default(),
        }
    }
}

/// How a screw system of rank 6 is described: see [`ScrewSystem::description`].
const SCREWS_OF_RANK_SIX: &str = "no screw is reciprocal to all joints";

/// Returns the proof and the code for the absence of a curve of configurations.
fn rests_on(is_proved: bool) -> (Proof, Code) {
    if is_proved { (Proof::Proved, Code::NoCurve) } else { (Proof::None, Code::NotDecided) }
}

/// The multiplicity of an isolated configuration.
fn order(configuration: &Configuration) -> Option<usize> {
    match configuration.local {
        Local::Isolated { order } => Some(order),
        _ => None,
    }
}

fn order_clause(shaky: Option<usize>) -> String {
    shaky.map_or_else(String::new, |order| format!("; shaky of order {order}: infinitesimally mobile only"))
}

/// Solves one case of a mechanism; `leaves_fields` as in [`Workspace::leaves_fields`].
pub(super) fn solve(entry: &Entry, case: Case, leaves_fields: bool) -> Result<Solution> {
    let entry = Entry { cases: vec![case], ..entry.clone() };
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    workspace.leaves_fields = leaves_fields;
    Mechanism::prepare(&entry)?.solve(&entry.cases[0], Roots::All, &mut workspace, &mut assembly)
}
