//! Loops of at most two unknown rotations: solved exactly, by what is linear.
//!
//! Rotations close by themselves. None or one of them leaves nothing to choose; of two, neither parallel nor crossing at
//! the same angle in every position, the third column and the third row of `Rz(q1) A1 Rz(q2) A2 = I` give one cosine and
//! sine each, rational in the data. Translations then have to bridge what is left, along known directions.

use super::{Answer, OverconstrainedLoop, outcome};
use crate::algebra::number::nearest_f64;
use crate::catalogue::entry::Case;
use crate::error::Result;
use crate::kinematics::closed_loop::{ClosedLoop, Layout, Variable};
use crate::kinematics::link_form::product;
use crate::kinematics::motion::Motion;
use crate::mechanism::FullMode;
use crate::mechanism::single_loop::{closing_transformation, locked_value, within_limits};
use crate::solve::dense;
use crate::solve::newton::closure;
use crate::verdict::{Status, Verdict};
use num_complex::Complex;
use rug::Rational;

type Rotation = [[Rational; 3]; 3];

/// The solution set of a loop of few revolute joints.
#[derive(Debug, PartialEq)]
enum Closing {
    /// Nothing does: this far off is what has to vanish, in cosines, or lengths over the mean link.
    Open(f64),
    /// A family of this dimension.
    Moving(usize),
    /// One choice of cosines and sines of the rotations and, alone, of distances; none of virtual joints.
    Closed(Box<[Option<(Rational, Rational)>; 6]>),
}

/// Gaps below this may be the rounding of data that had to be rounded.
const CLEAR: f64 = 1e-9;
/// Distances over the mean link beyond which rounded data may have made dependent directions independent.
const FAR: f64 = 1e6;

impl OverconstrainedLoop {
    /// The solution of a loop of at most two unknown rotations, exactly; `None` for others, and where rounded data may hide
    /// that the loop closes.
    pub(super) fn with_few_revolutes(&self, layout: &Layout, case: &Case) -> Result<Option<Answer>> {
        let filled = layout.with_idle(layout.missing(), 0);
        let joints = filled.joint_variables();
        let turns = |k: &usize| joints[*k].is_some() && filled.loop_kinds()[*k] == Variable::Rotation;
        if (0..6).filter(turns).count() > 2 {
            return Ok(None);
        }
        let exact: ClosedLoop<Rational> = self.chain.open_loop(&filled)?.close(&closing_transformation(case)?);
        let unit = self.chain.unit();
        let Some(closing) = close(&exact, joints.map(|joint| joint.is_none()), &unit) else { return Ok(None) };
        let values = match closing {
            Closing::Open(gap) if self.is_rounded && gap < CLEAR => return Ok(None),
            Closing::Open(_) => {
                let reason = "no solution: the closure equations, linear once the rotations are known, contradict one another, \
                              exactly";
                return Ok(Some((outcome(Status::Unreachable, 0, reason.to_owned()), Vec::new())));
            }
            Closing::Moving(dimension) => {
                let reason = format!(
                    "solutions form a self-motion of dimension {dimension}: the rotations are fixed and the translations dependent, exactly"
                );
                return Ok(Some((outcome(Status::SelfMotion, dimension, reason), Vec::new())));
            }
            Closing::Closed(values) => values,
        };
        let unknowns: [f64; 6] = std::array::from_fn(|k| match (&values[k], exact.variables[k]) {
            (None, _) => 0.0,
            (Some((cos, sin)), Variable::Rotation) => nearest_f64(sin).atan2(nearest_f64(cos)),
            (Some((distance, _)), Variable::Translation) => nearest_f64(distance),
        });
        let unit = unit.to_f64();
        let locked = Complex::from(locked_value(case));
        let q = filled.assemble(&unknowns.map(Complex::from), locked);
        let within = (!self.limits.is_empty()).then(|| within_limits(&q, &layout.variables, &self.limits));
        let closing: Motion<f64> = closing_transformation(case)?;
        let here = self.chain.open_loop(&filled)?.over(unit).close(&closing.over(unit));
        let over_unit = std::array::from_fn(|k| match here.variables[k] {
            Variable::Rotation => Complex::from(unknowns[k]),
            Variable::Translation => Complex::from(unknowns[k] / unit),
        });
        let largest = over_unit.iter().map(|x| x.norm()).fold(1.0, f64::max);
        // Far out for the rounding of the data only, as it were.
        if self.is_rounded && largest > FAR {
            return Ok(None);
        }
        let there = closure(&here, &over_unit);
        let jacobian = &there.jacobian;
        let mode = FullMode {
            q,
            real: true,
            multiplicity: 1,
            residual: there.relative_defect(&here, &over_unit, true),
            condition: dense::inverse(jacobian)
                .map_or(f64::INFINITY, |inverse| dense::norm(jacobian) * dense::norm(&inverse)),
            certified: true,
            // A bound on the rounding of cosine, sine and arctangent, or of one rounding.
            radius: 4.0 * f64::EPSILON * largest,
            within_limits: within,
            near: false,
            error: None,
            platform: None,
        };
        let reason = "1 of 1: the only solution of the closure equations, linear once the rotations are known, exactly";
        let verdict = Verdict { complex: 1, real: 1, certified: 1, ..outcome(Status::Complete, 0, reason.to_owned()) };
        Ok(Some((verdict, vec![mode])))
    }
}

/// Returns the solution set of a loop of at most two rotations; `None` for more, and for two parallel ones.
fn close(closed: &ClosedLoop<Rational>, is_idle: [bool; 6], unit: &Rational) -> Option<Closing> {
    let turns = |j: &usize| !is_idle[*j] && closed.variables[*j] == Variable::Rotation;
    let turning: Vec<usize> = (0..6).filter(turns).collect();
    // All constants from one unknown to before another one, round the loop.
    let between = |from: usize, to: usize| {
        let identity: Motion<Rational> = Motion::identity();
        (from..to).fold(identity.rotation, |frame, j| product(&frame, &closed.constants[j % 6].rotation))
    };
    let mut values: [Option<(Rational, Rational)>; 6] = Default::default();
    match turning[..] {
        [] => {
            let off = off_identity(&between(0, 6));
            if off > 0.0 {
                return Some(Closing::Open(off));
            }
        }
        [one] => {
            let link = between(one, one + 6);
            let off = Rational::from(1 - &link[2][2]);
            if off != 0 {
                return Some(Closing::Open(off.to_f64().abs()));
            }
            values[one] = Some((link[0][0].clone(), link[0][1].clone()));
        }
        [one, two] => {
            let (first, second) = (between(one, two), between(two, one + 6));
            let off = Rational::from(&first[2][2] - &second[2][2]);
            if off != 0 {
                return Some(Closing::Open(off.to_f64().abs()));
            }
            let column = |m: &Rotation| [m[0][2].clone(), m[1][2].clone()];
            let row = |m: &Rotation| [m[2][0].clone(), m[2][1].clone()];
            values[one] = Some(turn(&column(&first), &row(&second))?);
            let (cos, sin) = turn(&column(&second), &row(&first))?;
            values[two] = Some((cos, sin));
        }
        _ => return None,
    }
    let mut frame: Motion<Rational> = Motion::identity();
    let mut slides = Vec::new();
    for j in 0..6 {
        match (&values[j], closed.variables[j]) {
            (Some((cos, sin)), Variable::Rotation) => {
                frame = frame.then_after(&Motion::rotation_z(cos.clone(), sin.clone()));
            }
            (None, Variable::Translation) if !is_idle[j] => {
                slides.push((j, std::array::from_fn::<_, 3, _>(|i| frame.rotation[i][2].clone())));
            }
            _ => {}
        }
        frame = frame.then_after(&closed.constants[j]);
    }
    let gap = frame.translation.map(|x| -x / unit);
    Some(match bridged(slides.iter().map(|(_, direction)| direction), gap) {
        Err(closing) => closing,
        Ok(distances) => {
            for ((j, _), distance) in slides.iter().zip(distances) {
                values[*j] = Some((distance * unit, Rational::new()));
            }
            Closing::Closed(Box::new(values))
        }
    })
}

/// Cosine and sine of the turn from one vector of the plane to another one of the same length; `None` for zero.
fn turn(from: &[Rational; 2], to: &[Rational; 2]) -> Option<(Rational, Rational)> {
    let square = Rational::from(&from[0] * &from[0]) + Rational::from(&from[1] * &from[1]);
    if square == 0 {
        return None;
    }
    let cos = Rational::from(&from[0] * &to[0]) + Rational::from(&from[1] * &to[1]);
    let sin = Rational::from(&from[0] * &to[1]) - Rational::from(&from[1] * &to[0]);
    Some((cos / &square, sin / &square))
}

/// The distances along these directions that add up to a vector, or why there is not one choice of them.
fn bridged<'a>(
    directions: impl Iterator<Item = &'a [Rational; 3]>,
    gap: [Rational; 3],
) -> std::result::Result<Vec<Rational>, Closing> {
    let mut columns: Vec<[Rational; 3]> = directions.cloned().collect();
    columns.push(gap);
    let width = columns.len() - 1;
    let mut used: Vec<usize> = Vec::new();
    for column in 0..width {
        let free = (0..3).filter(|row| !used.contains(row));
        let largest = free.max_by(|&a, &b| columns[column][a].clone().abs().cmp(&columns[column][b].clone().abs()));
        let Some(pivot) = largest.filter(|&row| columns[column][row] != 0) else {
            // This column depends on those before it and adds nothing.
            used.push(usize::MAX);
            continue;
        };
        used.push(pivot);
        for row in (0..3).filter(|&row| row != pivot) {
            let factor = Rational::from(&columns[column][row] / &columns[column][pivot]);
            for column in &mut columns {
                let part = Rational::from(&factor * &column[pivot]);
                column[row] -= part;
            }
        }
    }
    let gap = &columns[width];
    let left = (0..3).filter(|row| !used.contains(row)).map(|row| gap[row].to_f64().abs()).fold(0.0, f64::max);
    if left > 0.0 {
        return Err(Closing::Open(left));
    }
    match used.iter().filter(|row| **row == usize::MAX).count() {
        0 => Ok(used.iter().enumerate().map(|(k, &row)| Rational::from(&gap[row] / &columns[k][row])).collect()),
        dimension => Err(Closing::Moving(dimension)),
    }
}

/// The largest entry by which a rotation differs from the identity.
fn off_identity(rotation: &Rotation) -> f64 {
    let entries =
        rotation.iter().enumerate().flat_map(|(i, row)| row.iter().enumerate().map(move |(j, x)| (i == j, x)));
    entries.map(|(one, x)| Rational::from(x - i32::from(one)).to_f64().abs()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cosine and sine of the angle of this half-angle tangent.
    fn turned(n: i32, d: i32) -> (Rational, Rational) {
        let t = Rational::from((n, d));
        let square = Rational::from(&t * &t);
        let over = Rational::from(1 + &square).recip();
        (Rational::from(1 - &square) * &over, 2 * t * over)
    }

    fn link(k: i32) -> Motion<Rational> {
        let (cos, sin) = turned(2 * k - 5, 3 + k);
        let mut link = Motion::rotation_x(cos, sin);
        let (cos, sin) = turned(k + 1, 7 - k);
        link = link.then_after(&Motion::rotation_z(cos, sin));
        link.translation = [Rational::from((k, 3)), Rational::from((1, k + 1)), Rational::from(2 - k)];
        link
    }

    /// A loop that closes at angles and distances of 0, its last constant made for that.
    fn closing(variables: [Variable; 6]) -> ClosedLoop<Rational> {
        let mut constants: [Motion<Rational>; 6] = std::array::from_fn(|k| link(i32::try_from(k).unwrap()));
        let open = constants[..5].iter().fold(Motion::identity(), |frame, link| frame.then_after(link));
        constants[5] = open.inverse();
        ClosedLoop { variables, constants }
    }

    fn is_idle(own: usize) -> [bool; 6] {
        std::array::from_fn(|k| k >= own)
    }

    const R: Variable = Variable::Rotation;
    const P: Variable = Variable::Translation;

    #[test]
    fn planted_positions_are_the_only_ones() {
        let unit = Rational::from((1, 7));
        for (variables, own) in
            [([P, P, P, R, R, R], 3), ([R, P, P, P, R, P], 4), ([R, P, R, P, P, R], 5), ([R, R, P, P, P, P], 3)]
        {
            let found = close(&closing(variables), is_idle(own), &unit);
            let zero = |k: usize| {
                let cos = i32::from(variables[k] == R);
                (k < own).then(|| (Rational::from(cos), Rational::new()))
            };
            assert_eq!(found, Some(Closing::Closed(Box::new(std::array::from_fn(zero)))), "{variables:?}");
        }
    }

    #[test]
    fn a_small_error_opens_them() {
        let unit = Rational::from(1);
        for (variables, own) in
            [([P, P, R, R, R, R], 2), ([P, P, P, R, R, R], 3), ([R, P, P, P, R, P], 4), ([R, P, R, P, P, R], 5)]
        {
            let mut closed = closing(variables);
            let (cos, sin) = turned(1, 1_000_000);
            let wrong = Motion::rotation_x(cos, sin);
            closed.constants[2] = closed.constants[2].then_after(&wrong);
            let found = close(&closed, is_idle(own), &unit);
            assert!(matches!(found, Some(Closing::Open(gap)) if gap > 1e-13), "{variables:?}: {found:?}");
        }
        let mut closed = closing([P, P, R, R, R, R]);
        closed.constants[5].translation[1] += Rational::from((1, 1000));
        let found = close(&closed, is_idle(2), &unit);
        assert!(matches!(found, Some(Closing::Open(gap)) if gap > 1e-5), "{found:?}");
    }

    #[test]
    fn more_translations_than_directions_move() {
        let unit = Rational::from(1);
        assert_eq!(close(&closing([P; 6]), is_idle(4), &unit), Some(Closing::Moving(1)));
        assert_eq!(close(&closing([R, P, P, P, P, P]), is_idle(6), &unit), Some(Closing::Moving(2)));
        assert_eq!(close(&closing([R, R, R, P, P, P]), is_idle(5), &unit), None);
    }
}
