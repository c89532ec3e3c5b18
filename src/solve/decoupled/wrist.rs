//! Three axes through a point: the other three move it to where it has to be, then the three turn about it.
//!
//! With p the point as C sees it and t where it has to be, `A a B b C p = t`. The square of the distance and the height of
//! both sides are free of A: two equations `u . B g + w = 0` in `g = b C p`, u two vectors of the link a. Where these
//! are independent across the axis, B is found from both of them and C from a quartic, else a combination is free of B.
//! \[Pieper1968\]

use super::{
    Base, Candidates, DEPENDENT, Over, Pair, Rotated, alignments, angle_between, axes, between, complex, dot,
    each_angle, height, phases, rotated, rotated_back, turned, vector,
};
use crate::kinematics::motion::Motion;

/// A row over (1, cos, sin).
type Row<R> = [R; 3];

/// A loop with a wrist at one pose.
pub(super) struct Wrist<'a, R> {
    own: Rotated<'a, R>,
    /// The point as C sees it.
    point: [R; 3],
    /// The place that it has to reach.
    target: [R; 3],
    /// The vectors u of the two equations.
    across: [[R; 3]; 2],
    /// The part free of B in the two equations, as rows over the angle of C.
    free: [Row<R>; 2],
    /// The square of the distance of g from the axis of B, from its parts: |g|^2 and the height.
    square: Row<R>,
    height: Row<R>,
    /// The rotation behind F, inverted.
    last: Motion<R>,
}

fn combined<R: Base>(x: &Row<R>, factor: R, y: &Row<R>) -> Row<R> {
    std::array::from_fn(|k| x[k].add(&factor.mul(&y[k])))
}

impl<'a, R: Base> Wrist<'a, R> {
    pub(super) fn of(own: Rotated<'a, R>) -> Option<Self> {
        let [a, b, c, d, e] = [0, 1, 2, 3, 4].map(|k| own.constant(k));
        let (on_first, on_last) = (height(d)?, height(&e.inverse())?);
        let last = own.constant(5).inverse();
        let point = c.apply(&[R::zero(), R::zero(), on_first]);
        let target = last.apply(&[R::zero(), R::zero(), on_last]);
        let double = |v: [R; 3]| v.map(|x| x.add(&x));
        let across = [double(rotated_back(a, &a.translation)), a.rotation[2]];
        let twice = double(rotated_back(b, &b.translation));
        let mut square = between(&twice, &point);
        square[0] = square[0].add(&dot(&point, &point)).add(&dot(&b.translation, &b.translation));
        let mut height = between(&b.rotation[2], &point);
        height[0] = height[0].add(&b.translation[2]);
        let mut free = [combined(&square, across[0][2], &height), height.map(|x| across[1][2].mul(&x))];
        free[0][0] = free[0][0].add(&dot(&a.translation, &a.translation)).sub(&dot(&target, &target));
        free[1][0] = free[1][0].add(&a.translation[2]).sub(&target[2]);
        Some(Self { own, point, target, across, free, square, height, last })
    }

    pub(super) fn candidates(&self, found: &mut Candidates<R>) {
        let [u, v] = &self.across;
        let sizes = [u, v].map(|w| w[0].size().hypot(w[1].size()));
        let cross = u[0].mul(&v[1]).sub(&u[1].mul(&v[0]));
        if cross.size() > DEPENDENT * sizes[0] * sizes[1] && sizes.iter().all(|size| *size > DEPENDENT) {
            return self.by_quartic(cross, found);
        }
        let strong = usize::from(sizes[1] > sizes[0]);
        let weak = 1 - strong;
        if !(sizes[strong] > DEPENDENT) {
            return;
        }
        // The rest of the weaker equation is free of B.
        let (w, s) = (&self.across[weak], &self.across[strong]);
        let factor = planar(w, s).over(planar(s, s));
        let equation = combined(&self.free[weak], factor.neg(), &self.free[strong]);
        let third = phases(&equation);
        for pair in &third.own[..third.count] {
            self.second(strong, *pair, found);
        }
        if let Some(pair) = third.lifted {
            self.second(strong, pair, found);
        }
    }

    /// Both angles of B, where C is known.
    fn second<S: Over<R>>(&self, equation: usize, third: Pair<S>, found: &mut Candidates<R>) {
        let g = self.seen(&third);
        let mut row = between(&vector(self.across[equation]), &g);
        row[0] = value(&self.free[equation], &third);
        let second = phases(&row);
        for pair in &second.own[..second.count] {
            self.first([*pair, third], found);
        }
        if let Some(pair) = second.lifted {
            self.first([pair, complex(&third)], found);
        }
    }

    /// C by a quartic, then B.
    fn by_quartic(&self, cross: R, found: &mut Candidates<R>) {
        let [u, v] = &self.across;
        let (uu, uv, vv) = (planar(u, u), planar(u, v), planar(v, v));
        let [p, q] = &self.free;
        let cross_square = cross.mul(&cross);
        // |p v - q u|^2 = (u x v)^2 (|g|^2 - height^2)
        let mut conic = [[R::zero(); 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                let mixed = p[i].mul(&q[j]).add(&q[i].mul(&p[j]));
                let squares = vv.mul(&p[i]).mul(&p[j]).sub(&uv.mul(&mixed)).add(&uu.mul(&q[i]).mul(&q[j]));
                conic[i][j] = squares.add(&cross_square.mul(&self.height[i]).mul(&self.height[j]));
            }
            conic[0][i] = conic[0][i].sub(&cross_square.mul(&self.square[i]));
        }
        each_angle(
            &conic,
            found,
            |pair, found| self.by_both(cross, pair, found),
            |pair, found| self.by_both(cross, pair, found),
        );
    }

    /// B from both equations.
    fn by_both<S: Over<R>>(&self, cross: R, third: Pair<S>, found: &mut Candidates<R>) {
        let g = self.seen(&third);
        let [p, q] = [0, 1].map(|k| value(&self.free[k], &third));
        let square = g[0].mul(&g[0]).add(&g[1].mul(&g[1])).times(cross);
        let Some(inverse) = square.inverse() else { return };
        // u . B g = -p and v . B g = -q in the plane: B g by the inverse of (u, v).
        let [u, v] = self.across;
        let x = q.times(u[1]).sub(&p.times(v[1]));
        let y = p.times(v[0]).sub(&q.times(u[0]));
        let cos = g[0].mul(&x).add(&g[1].mul(&y)).mul(&inverse);
        let sin = g[0].mul(&y).sub(&g[1].mul(&x)).mul(&inverse);
        self.first([(cos, sin), third], found);
    }

    /// g, the point as B sees it.
    fn seen<S: Over<R>>(&self, third: &Pair<S>) -> [S; 3] {
        let b = self.own.constant(1);
        let g = rotated(b, &turned(third, &vector(self.point)));
        std::array::from_fn(|k| g[k].add(&S::from_real(b.translation[k])))
    }

    /// A, where B and C are known, then the wrist.
    fn first<S: Over<R>>(&self, [second, third]: [Pair<S>; 2], found: &mut Candidates<R>) {
        let a = self.own.constant(0);
        let moved = rotated(a, &turned(&second, &self.seen(&third)));
        let [x, y] = [0, 1].map(|k| moved[k].add(&S::from_real(a.translation[k])));
        let to = [0, 1].map(|k| S::from_real(self.target[k]));
        let Some(first) = angle_between((&x, &y), (&to[0], &to[1])) else { return };
        self.wrist(&[first, second, third], found);
    }

    /// The three angles of the wrist from their product Q: `D d E e F = (A a B b C c)^-1 f^-1`.
    fn wrist<S: Over<R>>(&self, arm: &[Pair<S>; 3], found: &mut Candidates<R>) {
        let frame = self.own.arm(arm).rotation;
        let last = &self.last.rotation;
        let turn: [[S; 3]; 3] = std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..3).fold(S::zero(), |sum, k| sum.add(&frame[k][i].times(last[k][j]))))
        });
        let [d, e] = [3, 4].map(|k| self.own.constant(k));
        let ([row, _], [_, column]) = (axes(&d.rotation), axes(&e.rotation));
        let [_, seen] = axes(&turn);
        let middle = alignments(&vector(row), &vector(column), &seen);
        for pair in &middle.own[..middle.count] {
            self.outer(arm, &turn, pair, found);
        }
        if let Some(pair) = middle.lifted {
            let turn = turn.map(|row| row.map(S::lifted));
            self.outer(&arm.each_ref().map(complex), &turn, &pair, found);
        }
    }

    /// D, where E is known, then F from both: near a singular position their sum is exact where neither of them is.
    fn outer<S: Over<R>>(&self, arm: &[Pair<S>; 3], turn: &[[S; 3]; 3], middle: &Pair<S>, found: &mut Candidates<R>) {
        let [d, e] = [3, 4].map(|k| self.own.constant(k));
        let [_, column] = axes(&e.rotation);
        let there = rotated(d, &turned(middle, &vector(column)));
        let Some(first) = angle_between((&there[0], &there[1]), (&turn[0][2], &turn[1][2])) else { return };
        // The first two columns of D d E e: F turns the first one to that of Q.
        let [cos, sin] = [0, 1].map(|j| {
            let link = vector(e.rotation.map(|row| row[j]));
            let column = turned(&first, &rotated(d, &turned(middle, &link)));
            (0..3).fold(S::zero(), |sum, i| sum.add(&column[i].mul(&turn[i][0])))
        });
        self.own.push(arm, &[first, *middle, (cos, sin)], found);
    }
}

/// A row at an angle.
fn value<R: Base, S: Over<R>>(row: &Row<R>, (cos, sin): &Pair<S>) -> S {
    S::from_real(row[0]).add(&cos.times(row[1])).add(&sin.times(row[2]))
}

/// The scalar product of the parts across the axis.
fn planar<R: Base>(x: &[R; 3], y: &[R; 3]) -> R {
    x[0].mul(&y[0]).add(&x[1].mul(&y[1]))
}
