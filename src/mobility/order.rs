//! Does a closed chain move from one of its positions: the closure equations as power series.

use super::multiplicity::multiplicity;
use crate::algebra::echelon::Echelon;
use crate::algebra::ring::Field;
use crate::exact::linkage::{Position, Study, equations, is_unit, one, times, times_axis};
use crate::kinematics::screw_system::{Screw, ScrewSystem};

/// Most solutions that a generic closed chain of six joint variables has, and so the highest multiplicity that an isolated
/// position of any chain of up to six can have.
pub const MOST_SOLUTIONS: usize = 16;

/// Joints of the longest loop in which joints on common axes are looked for: all comparisons are short up to it.
const MOST_FOLDED: usize = 16;

/// The set of positions near one position of a chain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Local {
    /// The chain does not close here.
    Open,
    /// The screws of the joint variables that can move span the Lie algebra of a group of motions, or the algebras of two groups
    /// in two arcs of the loop, or stand in pairs on common axes: the positions near this one form a smooth manifold of this dimension, the number of joint
    /// variables minus the rank.
    Manifold {
        /// Its dimension.
        dimension: usize,
    },
    /// The positions near this one form a smooth curve: all reduced equations vanish to an order above the highest
    /// multiplicity that an isolated position can have.
    Curve,
    /// Isolated, of multiplicity `order`: the reduced equations begin with this power. From 2 on the position is shaky,
    /// infinitesimally movable and no more.
    Isolated {
        /// The multiplicity.
        order: usize,
    },
    /// Two or more independent infinitesimal motions, no group, and nothing that stops them in low orders: not decided by
    /// this test.
    Deficient,
}

/// A position of a chain and the positions near it.
#[derive(Clone, Debug, PartialEq)]
pub struct Germ<F> {
    /// The set that the positions near this one form.
    pub local: Local,
    /// The rank of the joint screws.
    pub rank: usize,
    /// The joint screws, up to factors: direction and moment of each axis (of a translation 0 and its direction)
    /// in the frame of the first joint.
    pub screws: Vec<[F; 6]>,
    /// Where a curve or a multiple position was found: the power series of each joint variable along it, coefficient 0
    /// first, as the tangent of half the angle (half the distance) by which it has moved on, over the length of its axis.
    pub series: Vec<Vec<F>>,
}

impl<F: Field> Germ<F> {
    /// Decides what the positions near this one form, if the field is exact. Over an inexact field it is a measurement.
    ///
    /// The closure equations of the position, all joints at 0, are solved order by order for a set of joint variables with
    /// independent screws, as power series of the remaining one; the equations left over are the reduced ones.
    /// Over a prime field an order found is an upper bound of the order over the rationals.
    ///
    /// # Source
    /// docs/mobility.md, theorems 1, 2 and 7.
    #[must_use]
    pub fn of(position: &Position<F>) -> Self {
        Self::of_conjugates(position, 1)
    }

    /// As [`Self::of`] for a position that has at least `conjugates` conjugates, itself included: they are isolated of the same
    /// multiplicity and so share the highest multiplicity possible.
    ///
    /// # Panics
    /// When there are no conjugates.
    #[must_use]
    pub fn of_conjugates(position: &Position<F>, conjugates: usize) -> Self {
        let n = position.variables.len();
        let mut expansion = Expansion::of(position);
        if !position.closes() && F::PIVOT_ZERO == 0.0 {
            return Self { local: Local::Open, rank: 0, screws: Vec::new(), series: Vec::new() };
        }
        let screws = expansion.screws();
        // Rows: the six equations, and behind them the row operations made.
        let rows = (0..6).map(|i| {
            let unit = (0..6).map(|j| if i == j { F::one() } else { F::zero() });
            screws.iter().map(|s| s[i].clone()).chain(unit).collect()
        });
        let solved = Echelon::among(rows.collect(), n + 6, n);
        let left_over = Echelon::of(screws.iter().map(|s| s.to_vec()).collect(), 6).null_space();
        let rank = solved.rank();
        let free: Vec<usize> = (0..n).filter(|k| !solved.pivots().contains(k)).collect();
        let mut germ = Self { local: Local::Deficient, rank, screws, series: Vec::new() };
        if free.is_empty() {
            germ.local = Local::Isolated { order: 1 };
        } else if germ.is_group() {
            germ.local = Local::Manifold { dimension: n - rank };
        } else if let [free] = free[..] {
            germ.local = expansion.solve(&solved, &left_over, free, MOST_SOLUTIONS / conjugates);
            germ.series = expansion.series;
        } else if germ.is_product_of_groups() || (F::PIVOT_ZERO == 0.0 && germ.folds() == n - rank) {
            germ.local = Local::Manifold { dimension: n - rank };
        } else if F::PIVOT_ZERO == 0.0
            && let Some(order) = multiplicity(position)
        {
            germ.local = Local::Isolated { order };
        }
        germ
    }

    /// The screws of the joint variables at a position that nearly closes, and the closure equations there, both over the scalar of
    /// the product.
    pub(super) fn first_order(position: &Position<F>) -> (Vec<[F; 6]>, [F; 6]) {
        let expansion = Expansion::of(position);
        let product = &expansion.products[position.links.len()][0];
        let scalar = product[0].inverse().unwrap_or_else(F::one);
        let scaled = |v: [F; 6]| v.map(|x| x.mul(&scalar));
        (expansion.screws().into_iter().map(scaled).collect(), scaled(equations(product)))
    }

    /// The screws of the joint variables.
    #[must_use]
    pub fn system(&self) -> ScrewSystem<F> {
        let screw = |[a, b, c, d, e, f]: [F; 6]| Screw { direction: [a, b, c], moment: [d, e, f] };
        ScrewSystem::of(&self.screws.iter().cloned().map(screw).collect::<Vec<_>>())
    }

    /// Whether the links move in a group: see [`Self::moves_in_groups`], with one arc.
    fn is_group(&self) -> bool {
        self.rank == 6 || self.moves_in_groups(|_| false)
    }

    /// The most arcs that can be drawn inside the loop between joints of one axis, or translations of one direction, without crossings: in
    /// each the joint at one end undoes what that at the other end does. 0 for long loops.
    fn folds(&self) -> usize {
        let n = self.screws.len();
        if n > MOST_FOLDED {
            return 0;
        }
        let are_one = |a: usize, b: usize| {
            let (a, b) = (&self.screws[a], &self.screws[b]);
            (0..6).all(|i| (0..i).all(|j| a[i].mul(&b[j]).sub(&a[j].mul(&b[i])).is_zero()))
        };
        // Of the joints from one to before another.
        let mut most = vec![vec![0; n + 1]; n + 1];
        for first in (0..n).rev() {
            for end in first + 2..=n {
                let arcs =
                    (first + 1..end).filter(|k| are_one(first, *k)).map(|k| most[first + 1][k] + 1 + most[k][end]);
                most[first][end] = arcs.chain([most[first + 1][end]]).max().unwrap_or(0);
            }
        }
        most[0][n]
    }

    /// Whether the loop has two arcs whose links each move in a group of their own.
    fn is_product_of_groups(&self) -> bool {
        let n = self.screws.len();
        (0..n).any(|first| (first + 1..n).any(|behind| self.moves_in_groups(|k| (first..behind).contains(&k))))
    }

    /// Whether the joint variables that move to first order, and all others whose screws lie in the algebra that those of
    /// their arc generate, span the sum of the two algebras and have all first-order motions among them.
    fn moves_in_groups(&self, is_second: impl Fn(usize) -> bool) -> bool {
        let columns = self.screws.len();
        let transposed = (0..6).map(|i| self.screws.iter().map(|s| s[i].clone()).collect()).collect();
        let rates = Echelon::of(transposed, columns).null_space();
        let moving: Vec<usize> = (0..columns).filter(|k| rates.iter().any(|rate| is_unit(&rate[*k]))).collect();
        let algebras = [false, true].map(|second| {
            let own = moving.iter().filter(|k| is_second(**k) == second);
            generated(own.map(|k| self.screws[*k].to_vec()).collect())
        });
        let sum = Echelon::of(algebras.iter().flat_map(Echelon::rows).cloned().collect(), 6).rank();
        let inside = (0..columns).filter(|k| {
            let algebra = &algebras[usize::from(is_second(*k))];
            let rows = algebra.rows().iter().cloned().chain([self.screws[*k].to_vec()]).collect();
            Echelon::of(rows, 6).rank() == algebra.rank()
        });
        let inside: Vec<Vec<F>> = inside.map(|k| self.screws[k].to_vec()).collect();
        let count = inside.len();
        Echelon::of(inside, 6).rank() == sum && count - sum == columns - self.rank
    }
}

/// The Lie algebra that screws generate, by a basis.
fn generated<F: Field>(screws: Vec<Vec<F>>) -> Echelon<F> {
    let mut span = Echelon::of(screws, 6);
    loop {
        let basis = span.rows();
        let commutators = (0..basis.len()).flat_map(|i| (0..i).map(move |j| commutator(&basis[i], &basis[j])));
        let next = Echelon::of(basis.iter().cloned().chain(commutators).collect(), 6);
        if next.rank() == span.rank() {
            return span;
        }
        span = next;
    }
}

/// The commutator of two screws, each direction and moment.
fn commutator<F: Field>(a: &[F], b: &[F]) -> Vec<F> {
    let cross = |u: usize, v: usize, i: usize| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[u + j].mul(&b[v + k]).sub(&a[u + k].mul(&b[v + j]))
    };
    let direction = (0..3).map(|i| cross(0, 0, i));
    direction.chain((0..3).map(|i| cross(0, 3, i).add(&cross(3, 0, i)))).collect()
}

/// The partial products of the chain as power series, order by order.
struct Expansion<'a, F> {
    position: &'a Position<F>,
    /// Coefficient `o` of `V_1 L_1 ... V_k L_k` at `[k][o]`.
    products: Vec<Vec<Study<F>>>,
    /// Coefficient `o` of joint variable k at `[k][o]`; the constant one is 0.
    series: Vec<Vec<F>>,
}

impl<'a, F: Field> Expansion<'a, F> {
    fn of(position: &'a Position<F>) -> Self {
        let mut products = vec![vec![one()]];
        for link in &position.links {
            let product = times(&products[products.len() - 1][0], link);
            products.push(vec![product]);
        }
        Self { position, products, series: vec![vec![F::zero()]; position.links.len()] }
    }

    /// The product up to joint variable k, times its axis.
    fn along(&self, k: usize) -> Study<F> {
        times_axis(&self.products[k][0], self.position.variables[k], &self.position.axes[k])
    }

    /// Returns the derivatives of the product of the closed chain by each joint variable alone.
    fn screws(&self) -> Vec<[F; 6]> {
        let n = self.position.links.len();
        let mut behind = vec![one()];
        for link in self.position.links.iter().rev() {
            behind.push(times(link, &behind[behind.len() - 1]));
        }
        let screw = |k: usize| {
            let product = times(&self.along(k), &behind[n - k]);
            equations(&product)
        };
        (0..n).map(screw).collect()
    }

    /// Adds the next coefficient of all partial products, with the last coefficients of the joint variables as they are.
    fn extend(&mut self) {
        let order = self.products[0].len();
        let zero = || std::array::from_fn(|_| F::zero());
        self.products[0].push(zero());
        for (k, link) in self.position.links.iter().enumerate() {
            let (done, rest) = self.products.split_at_mut(k + 1);
            let previous = &done[k];
            let mut sum: Study<F> = zero();
            for j in 1..=order {
                let x = &self.series[k][j];
                if x.is_zero() {
                    continue;
                }
                for (total, term) in sum.iter_mut().zip(&previous[order - j]) {
                    total.add_product(x, term);
                }
            }
            let mut factor = times_axis(&sum, self.position.variables[k], &self.position.axes[k]);
            for (total, term) in factor.iter_mut().zip(&previous[order]) {
                *total = total.add(term);
            }
            rest[0].push(times(&factor, link));
        }
    }

    /// Adds what the last coefficients of the joint variables contribute by themselves to the last coefficients of the
    /// partial products.
    fn correct(&mut self) {
        let mut change: Study<F> = std::array::from_fn(|_| F::zero());
        for (k, link) in self.position.links.iter().enumerate() {
            let Some(x) = self.series[k].last() else { continue };
            if !x.is_zero() {
                let along = self.along(k);
                for (total, term) in change.iter_mut().zip(&along) {
                    total.add_product(x, term);
                }
            }
            change = times(&change, link);
            if let Some(last) = self.products[k + 1].last_mut() {
                for (total, term) in last.iter_mut().zip(&change) {
                    *total = total.add(term);
                }
            }
        }
    }

    /// Solves for the pivot variables along the free one, up to the order that decides.
    fn solve(&mut self, solved: &Echelon<F>, left_over: &[Vec<F>], free: usize, most: usize) -> Local {
        let n = self.series.len();
        for order in 1..=most {
            for series in &mut self.series {
                series.push(F::zero());
            }
            if order == 1 {
                self.series[free][1] = F::one();
            }
            self.extend();
            let rest = equations(&self.products[n][order]);
            let along = |row: &[F]| {
                let mut sum = F::zero();
                for (x, y) in row.iter().zip(&rest) {
                    sum.add_product(x, y);
                }
                sum
            };
            // In an inexact field, zero is judged relative to the terms that cancel.
            let level = F::PIVOT_ZERO.sqrt() * rest.iter().map(F::pivot_size).fold(1.0, f64::max);
            let is_there = |x: F| if level > 0.0 { x.pivot_size() > level } else { is_unit(&x) };
            if left_over.iter().any(|row| is_there(along(row))) {
                return Local::Isolated { order };
            }
            for (pivot, row) in solved.pivots().iter().zip(solved.rows()) {
                self.series[*pivot][order] = along(&row[n..]).neg();
            }
            // The free variable has been there from the start.
            let kept = std::mem::replace(&mut self.series[free][order], F::zero());
            self.correct();
            self.series[free][order] = kept;
        }
        Local::Curve
    }
}
