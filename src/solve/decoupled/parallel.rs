//! Three parallel axes: the other three turn their direction to where it has to be and lift the last link to its height,
//! then the three move it in their plane.
//!
//! With k the direction as C sees it and n where it has to be, `A a B b C k = n` and a height along n: two equations, each
//! a sum of a row in the angle of A and one in that of C. Where neither angle can be taken out of both, one is found from a
//! quartic and the other is linear in it.

use super::{
    C64, Candidates, DEPENDENT, Pair, Rotated, alignments, angle_between, axes, between, complex, phases, rotated,
    rotated_back, turned, vector,
};
use crate::kinematics::motion::Motion;
use crate::solve::scalar::Scalar;
use crate::solve::separated::{Angle, angles_of};

/// A row over (cos, sin).
type Planar = [f64; 2];
/// The equation of directions, of the two.
const DIRECTIONS: usize = 1;

/// A loop with three parallel axes at one pose.
pub(super) struct Parallel<'a> {
    own: Rotated<'a>,
    /// The direction as C sees it.
    direction: [f64; 3],
    /// The place that it has to reach.
    target: [f64; 3],
    /// The two equations: a row over the angle of A, one over that of C, and a constant, which add up to 0.
    equations: [([Planar; 2], f64); 2],
    /// The constant behind F.
    last: Motion<f64>,
}

fn dot(x: &[f64; 3], y: &[f64; 3]) -> f64 {
    x[0] * y[0] + x[1] * y[1] + x[2] * y[2]
}

impl<'a> Parallel<'a> {
    pub(super) fn of(own: Rotated<'a>) -> Self {
        let [a, b, c, d, e, f] = [0, 1, 2, 3, 4, 5].map(|k| own.constant(k));
        // An axis may point the other way.
        let sense = [d, e].map(|link| 1_f64.copysign(link.rotation[2][2]));
        let [_, direction] = axes(&c.rotation);
        let target = f.rotation[2].map(|x| sense[0] * sense[1] * x);
        let height = d.translation[2] + sense[0] * e.translation[2];
        let equation = |of_a: &[f64; 3], of_c: &[f64; 3], rest: f64| {
            let (x, y) = (between(of_a, &target), between(of_c, &direction));
            // A turns the direction back: its sine counts the other way.
            ([[x[1], -x[2]], [y[1], y[2]]], x[0] + y[0] + rest)
        };
        let [_, normal] = axes(&a.rotation);
        let there = f.inverse().translation;
        let rest = dot(&direction, &c.translation) - dot(&target, &there) + height;
        let equations = [
            equation(&a.translation, &rotated_back(b, &b.translation), rest),
            equation(&normal, &b.rotation[2].map(|x| -x), 0.0),
        ];
        Self { own, direction, target, equations, last: f.clone() }
    }

    pub(super) fn candidates(&self, found: &mut Candidates) {
        let sizes = [0, 1].map(|side| self.equations.map(|(rows, _)| rows[side][0].hypot(rows[side][1])));
        // The angle of which one equation is free, or a combination of them.
        for side in [1, 0] {
            let [one, two] = self.equations.map(|(rows, _)| rows[side]);
            let cross = one[0] * two[1] - one[1] * two[0];
            let size = sizes[side];
            if cross.abs() > DEPENDENT * size[0] * size[1] && size.iter().all(|size| *size > DEPENDENT) {
                continue;
            }
            let strong = usize::from(size[1] > size[0]);
            if !(size[strong] > DEPENDENT) {
                return;
            }
            let (kept, dropped) = (self.equations[strong], self.equations[1 - strong]);
            let (k, d) = (kept.0[side], dropped.0[side]);
            let factor = (d[0] * k[0] + d[1] * k[1]) / (size[strong] * size[strong]);
            let other = |i: usize| dropped.0[1 - side][i] - factor * kept.0[1 - side][i];
            let known = phases(&[dropped.1 - factor * kept.1, other(0), other(1)]);
            for pair in &known.own[..known.count] {
                self.other::<f64>(side, strong, *pair, found);
            }
            if let Some(pair) = known.lifted {
                self.other::<C64>(side, strong, pair, found);
            }
            return;
        }
        self.by_quartic(found);
    }

    /// Both angles of one side from one equation, where that of the other side is known.
    fn other<S: Scalar>(&self, side: usize, equation: usize, known: Pair<S>, found: &mut Candidates) {
        let (rows, constant) = &self.equations[equation];
        let ([x, y], own) = (rows[1 - side], rows[side]);
        let [a, b] = [0, 1].map(|k| &self.own.constant(k).rotation);
        let angles = match (equation, side) {
            (DIRECTIONS, 0) => alignments(&vector(self.target), &vector(axes(a)[1]), &self.behind(&known)),
            (DIRECTIONS, _) => alignments(&vector(b[2]), &vector(self.direction), &self.ahead(&known)),
            _ => {
                let rest = S::from_f64(*constant).add(&known.0.times(x)).add(&known.1.times(y));
                phases(&[rest, S::from_f64(own[0]), S::from_f64(own[1])])
            }
        };
        for pair in &angles.own[..angles.count] {
            self.second(if side == 1 { [known, *pair] } else { [*pair, known] }, found);
        }
        if let Some(pair) = angles.lifted {
            let known = complex(&known);
            self.second(if side == 1 { [known, pair] } else { [pair, known] }, found);
        }
    }

    /// A by a quartic, C linear in it.
    fn by_quartic(&self, found: &mut Candidates) {
        let [(one, p), (two, q)] = self.equations;
        let cross = one[1][0] * two[1][1] - one[1][1] * two[1][0];
        let row = |rows: &[Planar; 2], constant: f64| [constant, rows[0][0], rows[0][1]];
        let (x, y) = (row(&one, p), row(&two, q));
        // Cosine and sine of C over the angle of A.
        let cos: [f64; 3] = std::array::from_fn(|k| (one[1][1] * y[k] - two[1][1] * x[k]) / cross);
        let sin: [f64; 3] = std::array::from_fn(|k| (two[1][0] * x[k] - one[1][0] * y[k]) / cross);
        let mut conic: [[f64; 3]; 3] =
            std::array::from_fn(|i| std::array::from_fn(|j| cos[i] * cos[j] + sin[i] * sin[j]));
        conic[0][0] -= 1.0;
        let rows = [cos, sin];
        for angle in angles_of(&conic).into_iter().flatten() {
            match angle {
                Angle::Real(pair) => self.linear(&rows, pair, found),
                Angle::Complex(pair) => self.linear(&rows, pair, found),
            }
        }
    }

    fn linear<S: Scalar>(&self, rows: &[[f64; 3]; 2], known: Pair<S>, found: &mut Candidates) {
        let [cos, sin] = rows.map(|row| S::from_f64(row[0]).add(&known.0.times(row[1])).add(&known.1.times(row[2])));
        self.second([known, (cos, sin)], found);
    }

    /// The direction as B sees it, turned by C.
    fn behind<S: Scalar>(&self, third: &Pair<S>) -> [S; 3] {
        rotated(self.own.constant(1), &turned(third, &vector(self.direction)))
    }

    /// The place that the direction has to reach as B sees it, turned back by A.
    fn ahead<S: Scalar>(&self, first: &Pair<S>) -> [S; 3] {
        let there = turned(&(first.0, first.1.neg()), &vector(self.target));
        let a = self.own.constant(0);
        std::array::from_fn(|j| (0..3).fold(S::zero(), |sum, i| sum.add(&there[i].times(a.rotation[i][j]))))
    }

    /// B, where A and C are known, then the plane.
    fn second<S: Scalar>(&self, [first, third]: [Pair<S>; 2], found: &mut Candidates) {
        let (from, to) = (self.behind(&third), self.ahead(&first));
        let Some(second) = angle_between((&from[0], &from[1]), (&to[0], &to[1])) else { return };
        self.plane(&[first, second, third], found);
    }

    /// The three angles of the plane from their product M: `D d E e F = (f A a B b C c)^-1`.
    fn plane<S: Scalar>(&self, arm: &[Pair<S>; 3], found: &mut Candidates) {
        let inverse = super::before(&self.last, &self.own.arm(arm));
        let [x, y] = [0, 1]
            .map(|j| (0..3).fold(S::zero(), |sum, i| sum.sub(&inverse.rotation[i][j].mul(&inverse.translation[i]))));
        let turned = [inverse.rotation[0][0], inverse.rotation[0][1]];
        let [d, e] = [3, 4].map(|k| self.own.constant(k).translation);
        let back = rotated_back(self.own.constant(3), &[d[0], d[1], 0.0]);
        let twice = [2.0 * back[0], 2.0 * back[1], 0.0];
        let mut equation = between::<S>(&vector(twice), &vector([e[0], e[1], 0.0]));
        let constant = d[0] * d[0] + d[1] * d[1] + e[0] * e[0] + e[1] * e[1];
        equation[0] = S::from_f64(constant).sub(&x.mul(&x).add(&y.mul(&y)));
        let middle = phases(&equation);
        for pair in &middle.own[..middle.count] {
            self.outer(arm, ([x, y], turned), pair, found);
        }
        if let Some(pair) = middle.lifted {
            let all = [[x, y], turned].map(|v| v.map(Scalar::to_complex));
            self.outer(&arm.each_ref().map(complex), (all[0], all[1]), &pair, found);
        }
    }

    /// D and F, where E is known, from the translation of M and the first column of its rotation.
    fn outer<S: Scalar>(
        &self,
        arm: &[Pair<S>; 3],
        ([x, y], column): ([S; 2], [S; 2]),
        middle: &Pair<S>,
        found: &mut Candidates,
    ) {
        let [d, e] = [3, 4].map(|k| self.own.constant(k));
        let reached = rotated(d, &turned(middle, &vector([e.translation[0], e.translation[1], 0.0])));
        let [u, v] = [0, 1].map(|k| reached[k].add(&S::from_f64(d.translation[k])));
        let Some(first) = angle_between((&u, &v), (&x, &y)) else { return };
        // The first two columns of D d E e, in the plane: F turns the first one to that of M.
        let columns = [0, 1].map(|j| {
            let link: [f64; 3] = std::array::from_fn(|i| e.rotation[i][j]);
            turned(&first, &rotated(d, &turned(middle, &vector(link))))
        });
        let part = |k: usize| columns[k][0].mul(&column[0]).add(&columns[k][1].mul(&column[1]));
        self.own.push(arm, &[first, *middle, (part(0), part(1))], found);
    }
}
