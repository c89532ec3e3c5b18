//! The closure equations of a planar linkage about an assembly, in rational numbers.

use crate::algebra::ring::Ring;
use crate::catalogue::LinkageConfiguration;
use crate::error::{Error, Result};
use crate::kinematics::linkage::{Gaussian, Linkage, Pair};
use crate::linkage::equations::{Closure, Equations};
use crate::linkage::groups::Group;
use crate::linkage::isotropic::Isotropic;
use crate::linkage::state::State;
use rug::Rational;

/// A configuration that is open by more than this part of the size of the linkage is none.
const OPEN: f64 = 1e-6;

/// A slide in a cycle: its variable, the class in which its line stands, its coefficient there.
#[derive(Clone, Debug)]
pub(super) struct Slid {
    pub(super) slide: usize,
    /// The variable of the class, `None` of the one at rest.
    pub(super) class: Option<usize>,
    pub(super) coefficient: Gaussian,
}

/// `sum_j a_j R_j + sum_q b_q R_(class of q) (s_q + x_q) + constant = 0`, with R_j = 1 at the assembly.
#[derive(Clone, Debug)]
pub(super) struct Cycle {
    /// Classes that turn, with their coefficients.
    pub(super) turning: Vec<(usize, Gaussian)>,
    pub(super) sliding: Vec<Slid>,
}

/// The equations about an assembly.
#[derive(Clone, Debug)]
pub(super) struct System {
    pub(super) cycles: Vec<Cycle>,
    /// Number of classes that turn: the first variables, half-angle tangents of their turns from the assembly.
    pub(super) turns: usize,
    /// The variable of the turn of every body; `None` of those at rest.
    bodies: Vec<Option<usize>>,
    /// The displacements at the assembly: the other variables are their changes.
    pub(super) slides: Vec<Rational>,
    /// What is left of every cycle at the assembly.
    gaps: Vec<Gaussian>,
}

fn i() -> Gaussian {
    Gaussian { re: Rational::new(), im: Rational::from(1) }
}

pub(super) fn zero() -> Gaussian {
    Gaussian { re: Rational::new(), im: Rational::new() }
}

/// Returns `i a`.
pub(super) fn turned(a: &Gaussian) -> Gaussian {
    i().mul(a)
}

pub(super) fn times(a: &Gaussian, q: &Rational) -> Gaussian {
    Gaussian { re: Rational::from(&a.re * q), im: Rational::from(&a.im * q) }
}

impl System {
    /// Writes the system at a configuration.
    ///
    /// # Errors
    /// Where the configuration does not close, or leaves slides open.
    pub(super) fn at(linkage: &Linkage, configuration: &LinkageConfiguration) -> Result<Self> {
        let group = Group {
            clusters: (0..linkage.bodies.len()).collect(),
            joints: (0..linkage.joints.len()).filter(|joint| !linkage.joints[*joint].is_gear()).collect(),
            gears: Vec::new(),
            count: 0,
        };
        let state = State::new(linkage.bodies.len(), 1);
        let undecided = || Error::Unsupported("the closure equations of the linkage are not rational".to_owned());
        let closure = Closure::new(linkage, &group, &state).ok_or_else(undecided)?;
        let equations = closure.equations.exact().ok_or_else(undecided)?;
        // The rotation of every class at the configuration.
        let mut turns: Vec<Option<Gaussian>> = vec![None; equations.classes];
        let mut rest = 0;
        let mut classes = Vec::with_capacity(linkage.bodies.len());
        for body in 0..linkage.bodies.len() {
            let (class, own) = closure.class_of(&state, body).ok_or_else(undecided)?;
            let own = own.z.exact.as_ref().and_then(crate::linkage::tower::Surd::to_gaussian).ok_or_else(undecided)?;
            let turn = configuration.turns[body].mul(&conjugate(&own));
            classes.push(class);
            if body == linkage.ground {
                rest = class;
            }
            match &turns[class] {
                None => turns[class] = Some(turn),
                Some(known) => {
                    let off = size(&known.sub(&turn));
                    if off > OPEN {
                        let name = &linkage.bodies[body].name;
                        let message = format!(
                            "found a configuration in which {name} is turned by {off:.3e} rad against what its slides allow, expected one \
                             that closes"
                        );
                        return Err(Error::Invalid(message));
                    }
                }
            }
        }
        let turns: Vec<Gaussian> = turns.into_iter().collect::<Option<_>>().ok_or_else(undecided)?;
        let slides = displacements(linkage, configuration, &equations, &turns)?;
        let bodies = classes.into_iter().map(|class| variable(class, rest)).collect();
        let system = Self { bodies, ..Self::of(&equations, &turns, rest, slides) };
        let size =
            linkage.bodies.iter().flat_map(|body| &body.points).map(|(_, at)| self::size(at)).fold(1e-9, f64::max);
        if system.gap() > OPEN * size {
            let message = format!(
                "found a configuration whose worst loop is open by {:.6} m, expected one that closes",
                system.gap()
            );
            return Err(Error::Invalid(message));
        }
        Ok(system)
    }

    fn of(equations: &Equations<Isotropic<Gaussian>>, turns: &[Gaussian], rest: usize, slides: Vec<Rational>) -> Self {
        let variable = |class: usize| variable(class, rest);
        let mut cycles = Vec::new();
        let mut gaps = Vec::new();
        for (number, cycle) in equations.cycles.iter().enumerate() {
            let mut gap = zero();
            let mut turning = Vec::new();
            for (class, coefficient) in cycle.iter().enumerate() {
                let a = coefficient.z.mul(&turns[class]);
                gap = gap.add(&a);
                if let Some(variable) = variable(class).filter(|_| !a.is_zero()) {
                    turning.push((variable, a));
                }
            }
            let mut sliding = Vec::new();
            for (slide, own) in equations.slides.iter().enumerate() {
                let coefficient = own.coefficients[number].z.mul(&turns[own.class]);
                if coefficient.is_zero() {
                    continue;
                }
                gap = gap.add(&times(&coefficient, &slides[slide]));
                sliding.push(Slid { slide, class: variable(own.class), coefficient });
            }
            cycles.push(Cycle { turning, sliding });
            gaps.push(gap);
        }
        Self { cycles, turns: equations.classes - 1, bodies: Vec::new(), slides, gaps }
    }

    /// Returns the number of loops.
    pub(super) fn loops(&self) -> usize {
        self.cycles.len()
    }

    /// Returns the number of variables.
    pub(super) fn variables(&self) -> usize {
        self.turns + self.slides.len()
    }

    /// Returns the variable of the turn of a body; `None` where it is at rest.
    pub(super) fn variable_of(&self, body: usize) -> Option<usize> {
        self.bodies[body]
    }

    /// Returns whether the assembly closes exactly.
    pub(super) fn is_closed(&self) -> bool {
        self.gaps.iter().all(Ring::is_zero)
    }

    /// Returns the worst gap, metres.
    pub(super) fn gap(&self) -> f64 {
        self.gaps.iter().map(size).fold(0.0, f64::max)
    }

    /// Returns the derivatives at the assembly: two real rows for every cycle.
    pub(super) fn jacobian(&self) -> Vec<Vec<Rational>> {
        let mut rows = Vec::with_capacity(2 * self.loops());
        for cycle in &self.cycles {
            let mut row = vec![zero(); self.variables()];
            // R = (1 + i y)/(1 - i y) has the derivative 2 i.
            let two = Rational::from(2);
            for (variable, a) in &cycle.turning {
                row[*variable] = row[*variable].add(&times(&turned(a), &two));
            }
            for Slid { slide, class, coefficient } in &cycle.sliding {
                let place = self.turns + slide;
                row[place] = row[place].add(coefficient);
                if let Some(class) = class {
                    let turned = times(&times(&turned(coefficient), &self.slides[*slide]), &two);
                    row[*class] = row[*class].add(&turned);
                }
            }
            rows.push(row.iter().map(|z| z.re.clone()).collect());
            rows.push(row.into_iter().map(|z| z.im).collect());
        }
        rows
    }
}

/// The variable of the turn of a class; `None` of the one at rest.
fn variable(class: usize, rest: usize) -> Option<usize> {
    (class != rest).then(|| if class > rest { class - 1 } else { class })
}

fn conjugate(z: &Gaussian) -> Gaussian {
    Gaussian { re: z.re.clone(), im: Rational::from(-&z.im) }
}

fn size(z: &Gaussian) -> f64 {
    z.re.to_f64().hypot(z.im.to_f64())
}

/// Finds the displacement of every slide: from the places of its bodies where they are given, else from the closure equations.
fn displacements(
    linkage: &Linkage,
    configuration: &LinkageConfiguration,
    equations: &Equations<Isotropic<Gaussian>>,
    turns: &[Gaussian],
) -> Result<Vec<Rational>> {
    let place = |body: usize, at: &Gaussian| {
        let origin = if body == linkage.ground { Some(zero()) } else { configuration.origins[body].clone() };
        origin.map(|origin| origin.add(&configuration.turns[body].mul(at)))
    };
    let mut known: Vec<Option<Rational>> = Vec::new();
    for slide in &equations.slides {
        let joint = &linkage.joints[slide.joint];
        let Pair::Prismatic { along, .. } = &joint.pair else { return Ok(Vec::new()) };
        let ends = [0, 1].map(|side| place(joint.of[side], &joint.at[side]));
        known.push(match ends {
            [Some(first), Some(second)] => {
                let direction = configuration.turns[joint.of[0]].mul(along);
                let across = second.sub(&first).mul(&conjugate(&direction));
                let square = direction.mul(&conjugate(&direction)).re;
                Some(across.re / square)
            }
            _ => None,
        });
    }
    let open: Vec<usize> = (0..known.len()).filter(|slide| known[*slide].is_none()).collect();
    if open.is_empty() {
        return Ok(known.into_iter().flatten().collect());
    }
    // sum over the open slides of coefficient times displacement = -(everything else), real and imaginary parts.
    let mut rows: Vec<Vec<Rational>> = Vec::new();
    for (number, cycle) in equations.cycles.iter().enumerate() {
        let mut rest = zero();
        for (class, coefficient) in cycle.iter().enumerate() {
            rest = rest.add(&coefficient.z.mul(&turns[class]));
        }
        let of =
            |slide: usize| equations.slides[slide].coefficients[number].z.mul(&turns[equations.slides[slide].class]);
        for (slide, value) in known.iter().enumerate() {
            if let Some(value) = value {
                rest = rest.add(&times(&of(slide), value));
            }
        }
        let columns: Vec<Gaussian> = open.iter().map(|slide| of(*slide)).collect();
        for part in [|z: &Gaussian| z.re.clone(), |z: &Gaussian| z.im.clone()] {
            rows.push(columns.iter().map(part).chain([-part(&rest)]).collect());
        }
    }
    let reduced = super::series::Reduced::of(&rows, open.len());
    if reduced.pivots.len() < open.len() {
        let name = &linkage.joints[equations.slides[open[0]].joint].name;
        let message = format!(
            "found a configuration that leaves slides such as {name} open, expected the `position` of their bodies beside the angles"
        );
        return Err(Error::Invalid(message));
    }
    for (row, slide) in open.iter().enumerate() {
        known[*slide] = reduced.rows[row].last().cloned();
    }
    Ok(known.into_iter().flatten().collect())
}
