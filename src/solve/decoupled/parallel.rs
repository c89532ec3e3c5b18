//! Three parallel axes: the other three turn their direction to where it has to be and lift the last link to its height,
//! then the three move it in their plane.
//!
//! With k the direction as C sees it and n where it has to be, `A a B b C k = n` and a height along n: two equations, each
//! a sum of a row in the angle of A and one in that of C. Where neither angle can be taken out of both, one is found from a
//! quartic and the other is linear in it.

use super::{
    Base, Candidates, DEPENDENT, Over, Pair, Rotated, alignments, angle_between, axes, between, complex, dot,
    each_angle, phases, rotated, rotated_back, turned, vector,
};
use crate::kinematics::motion::Motion;

/// A row over (cos, sin).
type Planar<R> = [R; 2];
/// The rows of an equation over the angles of A and of C, and its constant, which add up to 0.
type Equation<R> = ([Planar<R>; 2], R);
/// The equation of directions, of the two.
const DIRECTIONS: usize = 1;

/// A loop with three parallel axes at one pose.
pub(super) struct Parallel<'a, R> {
    own: Rotated<'a, R>,
    /// The direction as C sees it.
    direction: [R; 3],
    /// The place that it has to reach.
    target: [R; 3],
    /// The equation of heights, then the equation of directions.
    equations: [Equation<R>; 2],
    /// The constant behind F.
    last: Motion<R>,
}

impl<'a, R: Base> Parallel<'a, R> {
    pub(super) fn of(own: Rotated<'a, R>) -> Self {
        let [a, b, c, d, e, f] = [0, 1, 2, 3, 4, 5].map(|k| own.constant(k));
        // An axis may point the other way.
        let along = |link: &Motion<R>, x: R| if link.rotation[2][2].re() < 0.0 { x.neg() } else { x };
        let [_, direction] = axes(&c.rotation);
        let target = f.rotation[2].map(|x| along(d, along(e, x)));
        let height = d.translation[2].add(&along(d, e.translation[2]));
        let equation = |of_a: &[R; 3], of_c: &[R; 3], rest: R| {
            let (x, y) = (between(of_a, &target), between(of_c, &direction));
            // A turns the direction back: its sine counts the other way.
            ([[x[1], x[2].neg()], [y[1], y[2]]], x[0].add(&y[0]).add(&rest))
        };
        let [_, normal] = axes(&a.rotation);
        let there = f.inverse().translation;
        let rest = dot(&direction, &c.translation).sub(&dot(&target, &there)).add(&height);
        let equations = [
            equation(&a.translation, &rotated_back(b, &b.translation), rest),
            equation(&normal, &b.rotation[2].map(|x| x.neg()), R::zero()),
        ];
        let last = f.clone();
        Self { own, direction, target, equations, last }
    }

    pub(super) fn candidates(&self, found: &mut Candidates<R>) {
        let size = |row: &Planar<R>| row[0].size().hypot(row[1].size());
        let sizes = [0, 1].map(|side| self.equations.each_ref().map(|(rows, _)| size(&rows[side])));
        // The angle of which one equation is free, or a combination of them.
        for side in [1, 0] {
            let [one, two] = self.equations.each_ref().map(|(rows, _)| &rows[side]);
            let cross = one[0].mul(&two[1]).sub(&one[1].mul(&two[0]));
            let size = sizes[side];
            if cross.size() > DEPENDENT * size[0] * size[1] && size.iter().all(|size| *size > DEPENDENT) {
                continue;
            }
            let strong = usize::from(size[1] > size[0]);
            if !(size[strong] > DEPENDENT) {
                return;
            }
            let (kept, dropped) = (&self.equations[strong], &self.equations[1 - strong]);
            let (k, d) = (&kept.0[side], &dropped.0[side]);
            let product = |x: &Planar<R>, y: &Planar<R>| x[0].mul(&y[0]).add(&x[1].mul(&y[1]));
            let factor = product(d, k).over(product(k, k));
            let other = |i: usize| dropped.0[1 - side][i].sub(&factor.mul(&kept.0[1 - side][i]));
            let known = phases(&[dropped.1.sub(&factor.mul(&kept.1)), other(0), other(1)]);
            for pair in &known.own[..known.count] {
                self.other(side, strong, *pair, found);
            }
            if let Some(pair) = known.lifted {
                self.other(side, strong, pair, found);
            }
            return;
        }
        self.by_quartic(found);
    }

    /// Both angles of one side from one equation, where that of the other side is known.
    fn other<S: Over<R>>(&self, side: usize, equation: usize, known: Pair<S>, found: &mut Candidates<R>) {
        let (rows, constant) = &self.equations[equation];
        let ([x, y], own) = (rows[1 - side], rows[side]);
        let [a, b] = [0, 1].map(|k| &self.own.constant(k).rotation);
        let angles = match (equation, side) {
            (DIRECTIONS, 0) => alignments(&vector(self.target), &vector(axes(a)[1]), &self.behind(&known)),
            (DIRECTIONS, _) => alignments(&vector(b[2]), &vector(self.direction), &self.ahead(&known)),
            _ => {
                let rest = S::from_real(*constant).add(&known.0.times(x)).add(&known.1.times(y));
                phases(&[rest, S::from_real(own[0]), S::from_real(own[1])])
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
    fn by_quartic(&self, found: &mut Candidates<R>) {
        let [(one, p), (two, q)] = self.equations;
        let cross = one[1][0].mul(&two[1][1]).sub(&one[1][1].mul(&two[1][0]));
        let row = |rows: &[Planar<R>; 2], constant: R| [constant, rows[0][0], rows[0][1]];
        let (x, y) = (row(&one, p), row(&two, q));
        // Cosine and sine of C over the angle of A.
        let side = |u: R, v: R, k: usize| u.mul(&y[k]).sub(&v.mul(&x[k])).over(cross);
        let cos: [R; 3] = std::array::from_fn(|k| side(one[1][1], two[1][1], k));
        let sin: [R; 3] = std::array::from_fn(|k| side(one[1][0], two[1][0], k).neg());
        let mut conic: [[R; 3]; 3] =
            std::array::from_fn(|i| std::array::from_fn(|j| cos[i].mul(&cos[j]).add(&sin[i].mul(&sin[j]))));
        conic[0][0] = conic[0][0].sub(&R::one());
        let rows = [cos, sin];
        each_angle(
            &conic,
            found,
            |pair, found| self.linear(&rows, pair, found),
            |pair, found| self.linear(&rows, pair, found),
        );
    }

    fn linear<S: Over<R>>(&self, rows: &[[R; 3]; 2], known: Pair<S>, found: &mut Candidates<R>) {
        let [cos, sin] = rows.map(|row| S::from_real(row[0]).add(&known.0.times(row[1])).add(&known.1.times(row[2])));
        self.second([known, (cos, sin)], found);
    }

    /// The direction as B sees it, turned by C.
    fn behind<S: Over<R>>(&self, third: &Pair<S>) -> [S; 3] {
        rotated(self.own.constant(1), &turned(third, &vector(self.direction)))
    }

    /// The place that the direction has to reach as B sees it, turned back by A.
    fn ahead<S: Over<R>>(&self, first: &Pair<S>) -> [S; 3] {
        let there = turned(&(first.0, first.1.neg()), &vector(self.target));
        rotated_back(self.own.constant(0), &there)
    }

    /// B, where A and C are known, then the plane.
    fn second<S: Over<R>>(&self, [first, third]: [Pair<S>; 2], found: &mut Candidates<R>) {
        let (from, to) = (self.behind(&third), self.ahead(&first));
        let Some(second) = angle_between((&from[0], &from[1]), (&to[0], &to[1])) else { return };
        self.plane(&[first, second, third], found);
    }

    /// The three angles of the plane from their product M: `D d E e F = (f A a B b C c)^-1`.
    fn plane<S: Over<R>>(&self, arm: &[Pair<S>; 3], found: &mut Candidates<R>) {
        let inverse = super::before(&self.last, &self.own.arm(arm));
        let [x, y] = [0, 1]
            .map(|j| (0..3).fold(S::zero(), |sum, i| sum.sub(&inverse.rotation[i][j].mul(&inverse.translation[i]))));
        let turned = [inverse.rotation[0][0], inverse.rotation[0][1]];
        let [d, e] = [3, 4].map(|k| self.own.constant(k).translation);
        let none = R::zero();
        let back = rotated_back(self.own.constant(3), &[d[0], d[1], none]);
        let twice = [back[0].add(&back[0]), back[1].add(&back[1]), none];
        let mut equation = between::<S>(&vector(twice), &vector([e[0], e[1], none]));
        let [[first, second, _], [third, fourth, _]] = [d, e].map(|v| v.map(|x| x.mul(&x)));
        let constant = first.add(&second).add(&third).add(&fourth);
        equation[0] = S::from_real(constant).sub(&x.mul(&x).add(&y.mul(&y)));
        let middle = phases(&equation);
        for pair in &middle.own[..middle.count] {
            self.outer(arm, ([x, y], turned), pair, found);
        }
        if let Some(pair) = middle.lifted {
            let all = [[x, y], turned].map(|v| v.map(S::lifted));
            self.outer(&arm.each_ref().map(complex), (all[0], all[1]), &pair, found);
        }
    }

    /// D and F, where E is known, from the translation of M and the first column of its rotation.
    fn outer<S: Over<R>>(
        &self,
        arm: &[Pair<S>; 3],
        ([x, y], column): ([S; 2], [S; 2]),
        middle: &Pair<S>,
        found: &mut Candidates<R>,
    ) {
        let [d, e] = [3, 4].map(|k| self.own.constant(k));
        let reached = rotated(d, &turned(middle, &vector([e.translation[0], e.translation[1], R::zero()])));
        let [u, v] = [0, 1].map(|k| reached[k].add(&S::from_real(d.translation[k])));
        let Some(first) = angle_between((&u, &v), (&x, &y)) else { return };
        // The first two columns of D d E e, in the plane: F turns the first one to that of M.
        let columns = [0, 1].map(|j| {
            let link = e.rotation.map(|row| row[j]);
            turned(&first, &rotated(d, &turned(middle, &vector(link))))
        });
        let part = |k: usize| columns[k][0].mul(&column[0]).add(&columns[k][1].mul(&column[1]));
        self.own.push(arm, &[first, *middle, (part(0), part(1))], found);
    }
}
