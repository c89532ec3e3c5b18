//! Verdicts by the roots of the exact eliminants, where f64 does not prove a list.

use super::{ExactSolution, Question};
use crate::algebra::sort;
use crate::assembly::{Assembly, Mode, Roots, are_apart};
use crate::exact::{Known, OverRationals, Resolution, resolve};
use crate::kinematics::closed_loop::Variable;
use crate::mechanism::data::{Data, Modular};
use crate::mechanism::exact_modes::exact_mode;
use crate::mechanism::unproved::{cap, probable};
use crate::verdict::{Code, Proof, Status, Verdict};

impl Question<'_> {
    /// The verdict by the roots of the exact eliminants, where the one at hand is not proved, and whether that is the last
    /// word. The list becomes that of the eliminants where these tell all solutions.
    pub(super) fn by_exact_roots(&self, verdict: Verdict, assembly: &mut Assembly) -> (Verdict, bool) {
        // A pose out of reach has complex solutions all the same.
        let is_final = verdict.proof.is_proved() || verdict.proof == Proof::RoundedData;
        if is_final && verdict.complex_complete {
            return (verdict, true);
        }
        let is_asked = !self.only_lists
            && self.roots == Roots::All
            && self.prepared.layout.spherical_unknown().is_none()
            && self.rank() == 6;
        if !is_asked {
            return (verdict, false);
        }
        let places = distinct(&assembly.modes, &self.prepared.layout.loop_kinds());
        let known: Vec<Known> = places.iter().map(|&k| known(&assembly.modes[k])).collect();
        let Some(resolution) = self.resolution(&known) else { return (verdict, false) };
        match resolution {
            Resolution::AllKnown => {
                assembly.modes = places.iter().map(|&k| assembly.modes[k].clone()).collect();
                assembly.self_motion = 0;
                (self.resolved(assembly), true)
            }
            Resolution::All(solutions) => {
                let Some((closed, unit)) = self.in_f64() else { return (verdict, false) };
                let mode = |solution: &ExactSolution| match solution {
                    ExactSolution::Known(k) => assembly.modes[places[*k]].clone(),
                    ExactSolution::Found { pairs, is_real, multiplicity } => {
                        exact_mode((&closed, unit), pairs, *is_real, *multiplicity)
                    }
                };
                let modes: Vec<Mode> = solutions.iter().map(mode).collect();
                assembly.modes = modes;
                assembly.self_motion = 0;
                in_order(&mut assembly.modes);
                (self.resolved(assembly), true)
            }
            Resolution::Finite { most } if verdict.status == Status::SelfMotion => {
                let reason =
                    format!("not proved: finitely many solutions, at most {most}, of which some are multiple or crowd");
                let verdict = Verdict {
                    status: Status::Incomplete,
                    proof: Proof::None,
                    code: Code::UnknownMultiplicity,
                    complex_complete: false,
                    self_motion: 0,
                    reason,
                    ..verdict
                };
                (verdict, false)
            }
            Resolution::Vanishing(free) => {
                let verdict = if cap(assembly, free.len()) { self.judge(self.roots, assembly) } else { verdict };
                (probable(verdict, assembly), false)
            }
            Resolution::Finite { .. } => (probable(verdict, assembly), false),
        }
    }

    /// Returns the resolution by the eliminants, computed again where more solutions are known than before.
    pub(super) fn resolution(&self, known: &[Known]) -> Option<Resolution> {
        let mut last = self.resolved.borrow_mut();
        if let Some((count, resolution)) = &*last
            && *count == known.len()
        {
            return Some(resolution.clone());
        }
        let resolution = self.asked(known)?;
        *last = Some((known.len(), resolution.clone()));
        Some(resolution)
    }

    /// The verdict on a list that holds a solution for every root of an exact eliminant.
    pub(super) fn resolved(&self, assembly: &Assembly) -> Verdict {
        let (complex, real) = (assembly.total(), assembly.real());
        let multiple = assembly.modes.iter().filter(|mode| mode.multiplicity > 1).count();
        let also = match multiple {
            0 => String::new(),
            several => format!(", {several} of them multiple"),
        };
        let number = assembly.modes.len();
        let reason = format!(
            "{number} distinct certified solutions{also}: the exact eliminants of this case have no other root that closes \
             the loop"
        );
        Verdict {
            status: if real == 0 { Status::Unreachable } else { Status::Complete },
            proof: Proof::Proved.of_rounded(self.is_rounded()),
            code: Code::ExactRootsMatched,
            complex_complete: true,
            complex,
            real,
            at_infinity: self.prepared.general().saturating_sub(complex),
            self_motion: 0,
            certified: number,
            reason,
        }
    }

    /// Resolves all solutions by the exact equations, where some are known.
    pub(super) fn asked(&self, known: &[Known]) -> Option<Resolution> {
        if let Data::Field(own) = self.data() {
            if self.leaves_fields {
                return None;
            }
            let enclosed = self.prepared.enclosed(&self.of.chain, self.case).ok().flatten()?;
            return Some(resolve(&own.exact(&self.of.chain, self.case, &enclosed)?, known));
        }
        let Modular::Drawn(modular) = self.modular()? else { return None };
        Some(resolve(&OverRationals { closed: &self.exact()?, modular: &modular }, known))
    }
}

/// The places of modes with certificate of which no two can be the same solution.
fn distinct(modes: &[Mode], variables: &[Variable; 6]) -> Vec<usize> {
    let mut places: Vec<usize> = Vec::new();
    for (k, mode) in modes.iter().enumerate() {
        let is_simple = mode.certificate.is_some() && mode.multiplicity == 1;
        if is_simple && places.iter().all(|&j| are_apart(variables, &modes[j], mode)) {
            places.push(k);
        }
    }
    places
}

/// A certified mode as an enclosure of its solution.
fn known(mode: &Mode) -> Known {
    let size = mode.unknowns.iter().map(|z| z.norm()).fold(1.0, f64::max);
    let radius = mode.certificate.map_or(f64::INFINITY, |c| c.proved) + 4.0 * f64::EPSILON * size;
    Known { unknowns: mode.unknowns, radius }
}

/// Real modes first, then by their unknowns.
fn in_order(modes: &mut [Mode]) {
    sort::by(modes, |a, b| {
        let key = |m: &Mode| m.unknowns.map(|z| (z.re, z.im));
        b.real.cmp(&a.real).then_with(|| key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal))
    });
}
