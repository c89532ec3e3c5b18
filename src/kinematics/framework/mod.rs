//! Frameworks: bars between spherical joints, rods and bodies with several joints, and whether they move.

pub mod cycle;
pub mod flex;
mod mobility;
pub mod octahedron;
mod order;
mod parts;
mod planes;
mod slice;

pub use mobility::{Mobility, Proof, Verdict, mobility, mobility_with_lengths};
pub use slice::{Kind as SliceKind, Slice};

use super::motion::{Vector, cross, dot};
use crate::algebra::echelon::Echelon;
use crate::algebra::ring::{Field, Ring};
use rug::Rational;

/// A framework at one realisation: vertices in space, joined by bars of constant length.
///
/// The points of a rigid body with more than four vertices, of a plane one with more than three and of a straight rod with more
/// than two are fixed affine combinations of some of them, without any bars: then all first-order motions of a rod are those
/// of its ends. Every vertex is such a combination of *free* vertices.
#[derive(Clone, Debug)]
pub struct Framework<R> {
    /// The positions of the vertices.
    pub vertices: Vec<Vector<R>>,
    /// The bars, by their ends, those that hold the bodies together included.
    pub bars: Vec<[usize; 2]>,
    /// The number of bars that were given as such.
    pub given_bars: usize,
    /// The number of bodies.
    pub bodies: usize,
    /// The free vertices.
    pub free: Vec<usize>,
    /// Each vertex as a combination of free vertices: place in `free`, and coefficient.
    pub weights: Vec<Vec<(usize, R)>>,
}

impl Framework<Rational> {
    /// The framework with these vertices, bars, and rigid bodies (rods among them), given by their vertices.
    ///
    /// # Panics
    /// When a vertex does not exist.
    #[must_use]
    pub fn new(vertices: Vec<Vector<Rational>>, bars: &[[usize; 2]], bodies: &[Vec<usize>]) -> Self {
        let count = vertices.len();
        let mut bars: Vec<[usize; 2]> = bars.iter().map(|[a, b]| [*a.min(b), *a.max(b)]).collect();
        let given_bars = bars.len();
        let mut relations = Vec::new();
        for body in bodies {
            let (base, dependent) = split(&vertices, body);
            for (k, &a) in base.iter().enumerate() {
                for &b in &base[k + 1..] {
                    let bar = [a.min(b), a.max(b)];
                    if !bars.contains(&bar) {
                        bars.push(bar);
                    }
                }
            }
            for (vertex, coefficients) in dependent {
                let mut row = vec![Rational::new(); count];
                row[vertex] = Rational::from(1);
                for (&b, c) in base.iter().zip(coefficients) {
                    row[b] = -c;
                }
                relations.push(row);
            }
        }
        let echelon = Echelon::of(relations, count);
        let free = echelon.free_columns();
        let place = |vertex: usize| free.iter().position(|&f| f == vertex);
        let mut weights: Vec<Vec<(usize, Rational)>> =
            (0..count).map(|vertex| place(vertex).map(|k| (k, Rational::from(1))).into_iter().collect()).collect();
        for (row, &pivot) in echelon.rows().iter().zip(echelon.pivots()) {
            weights[pivot] = free
                .iter()
                .enumerate()
                .filter(|(_, vertex)| row[**vertex] != 0)
                .map(|(k, &vertex)| (k, Rational::from(-&row[vertex])))
                .collect();
        }
        Self { vertices, bars, given_bars, bodies: bodies.len(), free, weights }
    }
}

/// Vertices of a body that are affinely independent, at most four, and the others as combinations of them.
fn split(vertices: &[Vector<Rational>], body: &[usize]) -> (Vec<usize>, Vec<(usize, Vec<Rational>)>) {
    let (mut base, mut dependent): (Vec<usize>, Vec<(usize, Vec<Rational>)>) = (Vec::new(), Vec::new());
    for &vertex in body {
        // Columns: the base and this vertex, in homogeneous coordinates.
        let columns: Vec<usize> = base.iter().copied().chain([vertex]).collect();
        let coordinate = |row: usize, v: usize| if row < 3 { vertices[v][row].clone() } else { Rational::from(1) };
        let rows = (0..4).map(|row| columns.iter().map(|&v| coordinate(row, v)).collect()).collect();
        let null_space = Echelon::of(rows, columns.len()).null_space();
        match null_space.first() {
            None => base.push(vertex),
            Some(relation) => {
                let own = relation.last().cloned().unwrap_or_else(|| Rational::from(1));
                let combination = relation[..base.len()].iter().map(|c| -Rational::from(c / &own)).collect();
                dependent.push((vertex, combination));
            }
        }
    }
    (base, dependent)
}

impl<R: Ring> Framework<R> {
    /// Maps the framework to another ring; `None` as soon as one number has no image.
    pub fn map<S: Ring>(&self, image: impl Fn(&R) -> Option<S>) -> Option<Framework<S>> {
        let vector = |v: &Vector<R>| -> Option<Vector<S>> { Some([image(&v[0])?, image(&v[1])?, image(&v[2])?]) };
        let combination = |w: &Vec<(usize, R)>| w.iter().map(|(k, c)| Some((*k, image(c)?))).collect::<Option<_>>();
        Some(Framework {
            vertices: self.vertices.iter().map(vector).collect::<Option<_>>()?,
            bars: self.bars.clone(),
            given_bars: self.given_bars,
            bodies: self.bodies,
            free: self.free.clone(),
            weights: self.weights.iter().map(combination).collect::<Option<_>>()?,
        })
    }

    /// The number of coordinates of the free vertices.
    #[must_use]
    pub fn coordinates(&self) -> usize {
        3 * self.free.len()
    }

    /// The square of the length of each bar.
    #[must_use]
    pub fn squares(&self) -> Vec<R> {
        self.bars.iter().map(|bar| self.square(*bar)).collect()
    }

    /// The square of the distance of two vertices.
    #[must_use]
    pub fn square(&self, [a, b]: [usize; 2]) -> R {
        let between = self.between([a, b]);
        dot(&between, &between)
    }

    /// Returns the vector from the second vertex to the first.
    fn between(&self, [a, b]: [usize; 2]) -> Vector<R> {
        std::array::from_fn(|k| self.vertices[a][k].sub(&self.vertices[b][k]))
    }

    /// The difference of two vertices as a combination of free vertices.
    fn difference(&self, [a, b]: [usize; 2]) -> Vec<R> {
        let mut row = vec![R::zero(); self.free.len()];
        for (k, c) in &self.weights[a] {
            row[*k] = row[*k].add(c);
        }
        for (k, c) in &self.weights[b] {
            row[*k] = row[*k].sub(c);
        }
        row
    }

    /// The rigidity matrix: half the derivatives of the squared lengths by the coordinates of the free vertices.
    ///
    /// # Shape
    /// A row for each bar; columns x, y, z of the first free vertex, of the second, ...
    #[must_use]
    pub fn rigidity_matrix(&self) -> Vec<Vec<R>> {
        let row = |bar: &[usize; 2]| {
            let between = self.between(*bar);
            self.difference(*bar).iter().flat_map(|c| between.each_ref().map(|x| x.mul(c))).collect()
        };
        self.bars.iter().map(row).collect()
    }

    /// The velocities of the free vertices in three translations and three rotations of the whole.
    #[must_use]
    pub fn rigid_motions(&self) -> Vec<Vec<R>> {
        let unit = |k: usize| -> Vector<R> { std::array::from_fn(|j| if j == k { R::one() } else { R::zero() }) };
        let field = |velocity: &dyn Fn(&Vector<R>) -> Vector<R>| -> Vec<R> {
            self.free.iter().flat_map(|&vertex| velocity(&self.vertices[vertex])).collect()
        };
        let translations = (0..3).map(|k| field(&|_| unit(k)));
        let rotations = (0..3).map(|k| field(&|x| cross(&unit(k), x)));
        translations.chain(rotations).collect()
    }

    /// The framework with its free vertices elsewhere.
    fn at(&self, coordinates: &[R]) -> Self {
        let position = |weights: &Vec<(usize, R)>| -> Vector<R> {
            std::array::from_fn(|axis| {
                weights.iter().fold(R::zero(), |sum, (k, c)| sum.add(&c.mul(&coordinates[3 * k + axis])))
            })
        };
        Self { vertices: self.weights.iter().map(position).collect(), ..self.clone() }
    }

    /// The coordinates of the free vertices.
    fn state(&self) -> Vec<R> {
        self.free.iter().flat_map(|&vertex| self.vertices[vertex].clone()).collect()
    }
}

impl<F: Field> Framework<F> {
    /// Rank of the rigidity matrix, and the dimension of the rigid motions: 6, of collinear vertices 5.
    #[must_use]
    pub fn ranks(&self) -> (usize, usize) {
        let columns = self.coordinates();
        let rank = Echelon::of(self.rigidity_matrix(), columns).rank();
        (rank, Echelon::of(self.rigid_motions(), columns).rank())
    }

    /// The number of independent first-order motions that keep all lengths, without those of the whole.
    #[must_use]
    pub fn infinitesimal_freedom(&self) -> usize {
        let (rank, rigid) = self.ranks();
        self.coordinates() - rank - rigid
    }
}
