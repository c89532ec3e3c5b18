//! Proofs by linear slices: a linear space of realisations in which the lengths are fewer conditions than they look.
//!
//! Let L be a linear space of realisations that contains the given one, p. On L every squared length is a quadratic form. If
//! the forms of all bars span a space of dimension e, and e is also the rank of their derivatives at p along L, then the
//! realisations in L with the lengths of p are a smooth manifold of dimension `dim L - e` near p. Those congruent to p and
//! near it are in it, a set of dimension at most t, the dimension of the rigid motions of p along L. If `dim L - e > t`,
//! the framework moves: proved, with real motions, over the rationals. L is the space of realisations with a symmetry of p, or of affine images
//! of p (then the directions of all bars are on a conic at infinity).

use super::Framework;
use crate::algebra::echelon::Echelon;
use crate::kinematics::motion::{Vector, dot};
use rug::Rational;

/// The common property of the realisations of a slice.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Nothing: all realisations.
    All,
    /// A half-turn.
    HalfTurn,
    /// A reflection.
    Reflection,
    /// A point reflection.
    Inversion,
    /// Another isometry of finite order.
    Isometry,
    /// All isometries of the given realisation.
    Group(usize),
    /// They are affine images of the given one.
    Affine,
}

/// A slice in which the framework moves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Slice {
    /// The common property of its realisations.
    pub kind: Kind,
    /// Its dimension.
    pub dimension: usize,
    /// The number of conditions: of independent squared lengths on it.
    pub conditions: usize,
    /// The dimension of the rigid motions along it.
    pub rigid: usize,
}

impl Slice {
    /// The dimension of the motions in the slice.
    #[must_use]
    pub fn mobility(&self) -> usize {
        self.dimension - self.conditions - self.rigid
    }
}

type Matrix = [[Rational; 3]; 3];

/// The slices that prove that the framework moves: the one of greatest dimension, and among these the simplest.
pub fn moving_slice(framework: &Framework<Rational>) -> Option<Slice> {
    let centred = centred(framework);
    let columns = centred.coordinates();
    let mut found: Vec<Slice> = Vec::new();
    // All realisations: only where no bar is too many.
    let rank = Echelon::of(centred.rigidity_matrix(), columns).rank();
    if rank == centred.bars.len() {
        let unit = |k: usize| (0..columns).map(|j| Rational::from(u8::from(j == k))).collect();
        found.extend(judge(&centred, Kind::All, (0..columns).map(unit).collect()));
    }
    found.extend(judge(&centred, Kind::Affine, affine_images(&centred)));
    let group = isometries(&centred);
    let mut common = Vec::new();
    for (permutation, matrix) in &group {
        let rows = symmetry_conditions(&centred, permutation, matrix);
        let space = Echelon::of(rows.clone(), columns).null_space();
        found.extend(judge(&centred, kind_of(matrix), space));
        common.extend(rows);
    }
    if group.len() > 1 {
        found.extend(judge(&centred, Kind::Group(group.len() + 1), Echelon::of(common, columns).null_space()));
    }
    // The first of the greatest mobility: `max_by_key` would take the last.
    found.into_iter().rev().max_by_key(Slice::mobility)
}

/// The framework with the centroid of its vertices at the origin, which every isometry leaves where it is.
fn centred(framework: &Framework<Rational>) -> Framework<Rational> {
    let count = Rational::from(framework.vertices.len().max(1));
    let centroid: Vector<Rational> =
        std::array::from_fn(|k| framework.vertices.iter().map(|v| v[k].clone()).sum::<Rational>() / &count);
    let vertices =
        framework.vertices.iter().map(|v| std::array::from_fn(|k| Rational::from(&v[k] - &centroid[k]))).collect();
    Framework { vertices, ..framework.clone() }
}

fn affine_images(framework: &Framework<Rational>) -> Vec<Vec<Rational>> {
    let image = |row: usize, column: usize| {
        let entry = |vertex: &usize| -> Vector<Rational> {
            std::array::from_fn(|k| match (k == row, column) {
                (false, _) => Rational::new(),
                (true, 3) => Rational::from(1),
                (true, _) => framework.vertices[*vertex][column].clone(),
            })
        };
        framework.free.iter().flat_map(entry).collect::<Vec<_>>()
    };
    let images = (0..12).map(|k| image(k / 4, k % 4)).collect();
    Echelon::of(images, framework.coordinates()).rows().to_vec()
}

/// `x_(g v) - A x_v = 0` for every vertex, in the coordinates of the free vertices.
fn symmetry_conditions(framework: &Framework<Rational>, permutation: &[usize], matrix: &Matrix) -> Vec<Vec<Rational>> {
    let mut rows = Vec::new();
    for (vertex, &image) in permutation.iter().enumerate() {
        for axis in 0..3 {
            let mut row = vec![Rational::new(); framework.coordinates()];
            for (k, c) in &framework.weights[image] {
                row[3 * k + axis] += c;
            }
            for (k, c) in &framework.weights[vertex] {
                for (j, entry) in matrix[axis].iter().enumerate() {
                    row[3 * k + j] -= Rational::from(c * entry);
                }
            }
            rows.push(row);
        }
    }
    rows
}

/// The slice with this basis, if it proves a motion.
fn judge(framework: &Framework<Rational>, kind: Kind, basis: Vec<Vec<Rational>>) -> Option<Slice> {
    let dimension = basis.len();
    if dimension == 0 {
        return None;
    }
    let (mut forms, mut derivatives) = (Vec::new(), Vec::new());
    for &bar in &framework.bars {
        let weights = framework.difference(bar);
        // The difference of the ends as a linear function on the slice.
        let column = |b: &Vec<Rational>| -> Vector<Rational> {
            std::array::from_fn(|axis| {
                weights
                    .iter()
                    .enumerate()
                    .filter(|(_, w)| **w != 0)
                    .map(|(k, w)| Rational::from(w * &b[3 * k + axis]))
                    .sum()
            })
        };
        let columns: Vec<Vector<Rational>> = basis.iter().map(column).collect();
        let here = framework.between(bar);
        derivatives.push(columns.iter().map(|c| dot(c, &here)).collect::<Vec<_>>());
        if kind != Kind::All {
            let mut form = Vec::with_capacity(dimension * (dimension + 1) / 2);
            for i in 0..dimension {
                for j in i..dimension {
                    let product = dot(&columns[i], &columns[j]);
                    form.push(if i == j { product } else { product * 2 });
                }
            }
            forms.push(form);
        }
    }
    let rank = Echelon::of(derivatives, dimension).rank();
    let conditions = match kind {
        // Without dependent bars the forms are as independent as their derivatives.
        Kind::All => framework.bars.len(),
        _ => Echelon::of(forms, dimension * (dimension + 1) / 2).rank(),
    };
    if rank != conditions {
        return None;
    }
    // Rigid motions along the slice: dim(T) + dim(L) - dim(T + L).
    let rigid = framework.rigid_motions();
    let own = Echelon::of(rigid.clone(), framework.coordinates()).rank();
    let joined = Echelon::of(rigid.into_iter().chain(basis).collect(), framework.coordinates()).rank();
    let rigid = own + dimension - joined;
    (dimension > conditions + rigid).then_some(Slice { kind, dimension, conditions, rigid })
}

/// The isometries of the set of vertices but the identity, as permutations with their matrices; none for vertices in a plane.
/// A finite group of rational matrices has at most 48 elements in space.
fn isometries(framework: &Framework<Rational>) -> Vec<(Vec<usize>, Matrix)> {
    let points = &framework.vertices;
    let count = points.len();
    let frame = Echelon::of(points.iter().map(|p| p.to_vec()).collect(), 3);
    let &[a, b, c] = frame.independent_rows() else { return Vec::new() };
    let squares: Vec<Rational> = points.iter().map(|p| dot(p, p)).collect();
    let product = |i: usize, j: usize| dot(&points[i], &points[j]);
    let mut found = Vec::new();
    // The images of three independent vertices decide.
    for i in (0..count).filter(|&i| squares[i] == squares[a]) {
        for j in (0..count).filter(|&j| squares[j] == squares[b] && product(i, j) == product(a, b)) {
            for k in 0..count {
                if squares[k] != squares[c] || product(i, k) != product(a, c) || product(j, k) != product(b, c) {
                    continue;
                }
                let Some(matrix) = matrix_of([a, b, c].map(|v| &points[v]), [i, j, k].map(|v| &points[v])) else {
                    continue;
                };
                let image = |p: &Vector<Rational>| -> Vector<Rational> { matrix.each_ref().map(|row| dot(row, p)) };
                let permutation: Option<Vec<usize>> = points
                    .iter()
                    .map(|p| {
                        let image = image(p);
                        points.iter().position(|q| *q == image)
                    })
                    .collect();
                if let Some(permutation) = permutation
                    && permutation.iter().enumerate().any(|(v, image)| v != *image)
                {
                    found.push((permutation, matrix));
                }
            }
        }
    }
    found
}

/// The matrix that takes three independent vectors to three others.
fn matrix_of(from: [&Vector<Rational>; 3], to: [&Vector<Rational>; 3]) -> Option<Matrix> {
    // Rows `from | to`: reduced, the right half is the transposed matrix.
    let rows = (0..3).map(|k| from[k].iter().chain(to[k]).cloned().collect::<Vec<_>>()).collect();
    let echelon = Echelon::of(rows, 6);
    let mut matrix: Matrix = std::array::from_fn(|_| std::array::from_fn(|_| Rational::new()));
    for (row, &pivot) in echelon.rows().iter().zip(echelon.pivots()) {
        for axis in 0..3 {
            matrix.get_mut(axis)?.get_mut(pivot)?.clone_from(&row[3 + axis]);
        }
    }
    Some(matrix)
}

fn kind_of(matrix: &Matrix) -> Kind {
    let trace = Rational::from(&matrix[0][0] + &matrix[1][1]) + &matrix[2][2];
    let symmetric = (0..3).all(|i| (0..i).all(|j| matrix[i][j] == matrix[j][i]));
    // A symmetric orthogonal matrix is an involution, with eigenvalues 1 and -1 only.
    match (symmetric, trace.to_f64()) {
        (true, -1.0) => Kind::HalfTurn,
        (true, 1.0) => Kind::Reflection,
        (true, -3.0) => Kind::Inversion,
        _ => Kind::Isometry,
    }
}
