//! A second way to all solutions, independent of the border basis: the rotations alone satisfy six quartics; their
//! multiples of degree 8 leave a space of dimension 40, on which the quotient of two coordinates is a matrix.

use super::cases::{Draw, case};
use looproot::internal::assembly::Roots;
use looproot::internal::assembly::platform::{PlatformAssembly, PlatformSolver, PlatformWorkspace};
use looproot::internal::closure::study::{Form, left, linear_legs, right};
use looproot::internal::kinematics::dual_quaternion::Quaternion;
use looproot::internal::kinematics::platform::Platform;
use looproot_algebra::number::nearest_f64;
use nalgebra::{DMatrix, Matrix6, SMatrix};
use num_complex::Complex;

type Exponents = [usize; 4];
/// Coefficients of a form of one degree, in the order of `monomials`.
type Coefficients = Vec<f64>;

/// All monomials of a degree in four unknowns.
fn monomials(degree: usize) -> Vec<Exponents> {
    let mut all = Vec::new();
    for a in (0..=degree).rev() {
        for b in (0..=degree - a).rev() {
            for c in (0..=degree - a - b).rev() {
                all.push([a, b, c, degree - a - b - c]);
            }
        }
    }
    all
}

fn place(monomial: &Exponents) -> usize {
    let [_, b, c, d] = *monomial;
    let (rest, tail) = (b + c + d, c + d);
    rest * (rest + 1) * (rest + 2) / 6 + tail * (tail + 1) / 2 + d
}

fn product(m: &Exponents, n: &Exponents) -> Exponents {
    std::array::from_fn(|k| m[k] + n[k])
}

fn times(f: &Coefficients, f_degree: usize, g: &Coefficients, g_degree: usize) -> Coefficients {
    let mut sum = vec![0.0; monomials(f_degree + g_degree).len()];
    for (m, x) in monomials(f_degree).iter().zip(f) {
        for (n, y) in monomials(g_degree).iter().zip(g) {
            sum[place(&product(m, n))] += x * y;
        }
    }
    sum
}

fn quadratic(form: &Form<f64>) -> Coefficients {
    let mut sum = vec![0.0; 10];
    for i in 0..4 {
        for j in 0..4 {
            let monomial = std::array::from_fn(|k| usize::from(k == i) + usize::from(k == j));
            sum[place(&monomial)] += form[i][j];
        }
    }
    sum
}

fn linear(row: &[f64; 4]) -> Coefficients {
    let mut sum = vec![0.0; 4];
    for (i, &c) in row.iter().enumerate() {
        let monomial = std::array::from_fn(|k| usize::from(k == i));
        sum[place(&monomial)] += c;
    }
    sum
}

fn add(target: &mut Coefficients, factor: f64, other: &Coefficients) {
    target.iter_mut().zip(other).for_each(|(t, o)| *t += factor * o);
}

/// The six quartics of a platform whose K has full rank. With `u = u0 + T n` the equations are `T l_i = k_i` (four, with
/// `sum x_i (T l_i - k_i) = 0`) and two quadratic ones in T; T, T^2 and T x_i x_j are eliminated in degree 4.
fn quartics(platform: &Platform<f64>, squares: &[f64; 6]) -> Vec<Coefficients> {
    let legs = linear_legs(platform);
    let matrix = SMatrix::<f64, 6, 7>::from_fn(|i, j| legs.matrix[i][j]);
    let gram: Matrix6<f64> = matrix * matrix.transpose();
    let inverse = matrix.transpose() * gram.try_inverse().unwrap();
    let whole = (matrix.transpose() * matrix).symmetric_eigen();
    let least = whole.eigenvalues.imin();
    let null: Vec<f64> = whole.eigenvectors.column(least).iter().copied().collect();
    let u0: Vec<Coefficients> = (0..7)
        .map(|k| {
            let mut form = [[0.0; 4]; 4];
            for i in 0..6 {
                for a in 0..4 {
                    for b in 0..4 {
                        form[a][b] += inverse[(k, i)] * (legs.forms[i][a][b] + if a == b { squares[i] } else { 0.0 });
                    }
                }
            }
            quadratic(&form)
        })
        .collect();
    let (p, q) = ([null[1], null[2], null[3]], [null[4], null[5], null[6]]);
    let (before, behind) = (left(&p), right(&q));
    // Rows over [T^2 | T x^2 (10) | x^4 (35)].
    let mut rows: Vec<Vec<f64>> = Vec::new();
    let unit = |k: usize| std::array::from_fn(|i| if i == k { 1.0 } else { 0.0 });
    for i in 0..4 {
        let slope = linear(&std::array::from_fn(|j| before[i][j] - behind[i][j]));
        let mut constant = vec![0.0; 20];
        for k in 0..3 {
            let (l, r) = (left::<f64>(&unit(k)), right::<f64>(&unit(k)));
            add(&mut constant, 1.0, &times(&linear(&r[i]), 1, &u0[4 + k], 2));
            add(&mut constant, -1.0, &times(&linear(&l[i]), 1, &u0[1 + k], 2));
        }
        for j in 0..4 {
            let x = linear(&std::array::from_fn(|k| if k == j { 1.0 } else { 0.0 }));
            let mut row = vec![0.0];
            row.extend(times(&x, 1, &slope, 1));
            row.extend(times(&x, 1, &constant, 3).iter().map(|c| -c));
            rows.push(row);
        }
    }
    let norm = quadratic(&std::array::from_fn(|i| std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 })));
    for part in [1..4, 4..7] {
        let mut row = vec![part.clone().map(|k| null[k] * null[k]).sum::<f64>()];
        let mut middle: Coefficients = norm.iter().map(|n| -n * null[0]).collect();
        let mut last: Coefficients = times(&norm, 2, &u0[0], 2).iter().map(|c| -c).collect();
        for k in part {
            add(&mut middle, 2.0 * null[k], &u0[k]);
            add(&mut last, 1.0, &times(&u0[k], 2, &u0[k], 2));
        }
        row.extend(middle);
        row.extend(last);
        rows.push(row);
    }
    // The combinations without T: the left kernel of the first eleven columns.
    let first = DMatrix::from_fn(18, 11, |i, j| rows[i][j]);
    let svd = (&first * first.transpose()).symmetric_eigen();
    let mut order: Vec<usize> = (0..18).collect();
    order.sort_by(|&a, &b| svd.eigenvalues[a].total_cmp(&svd.eigenvalues[b]));
    order[..7]
        .iter()
        .map(|&k| {
            let mut sum = vec![0.0; 35];
            for (i, row) in rows.iter().enumerate() {
                add(&mut sum, svd.eigenvectors[(i, k)], &row[11..].to_vec());
            }
            sum
        })
        .collect()
}

/// The quotients x1/x0 of all solutions, by the quartics' multiples of degree 8.
fn quotients(quartics: &[Coefficients]) -> Vec<Complex<f64>> {
    let weight = |m: &Exponents, degree: usize| {
        let factorial = |n: usize| (1..=n).map(|k| k as f64).product::<f64>();
        (factorial(degree) / m.iter().map(|&k| factorial(k)).product::<f64>()).sqrt()
    };
    let (four, seven) = (monomials(4), monomials(7));
    let mut multiples = DMatrix::<f64>::zeros(165, quartics.len() * 35);
    for (k, quartic) in quartics.iter().enumerate() {
        for (j, factor) in four.iter().enumerate() {
            for (m, c) in four.iter().zip(quartic) {
                let target = product(m, factor);
                multiples[(place(&target), k * 35 + j)] += c / weight(&target, 8);
            }
        }
    }
    let gram = (&multiples * multiples.transpose()).symmetric_eigen();
    let mut order: Vec<usize> = (0..165).collect();
    order.sort_by(|&a, &b| gram.eigenvalues[a].total_cmp(&gram.eigenvalues[b]));
    assert!(gram.eigenvalues[order[39]] < 1e-9 * gram.eigenvalues[order[41]], "the space has dimension 40");
    let shifted = |index: usize| {
        DMatrix::from_fn(120, 40, |i, j| {
            let mut m = seven[i];
            m[index] += 1;
            gram.eigenvectors[(place(&m), order[j])] * weight(&seven[i], 7) / weight(&m, 8)
        })
    };
    let (a, b) = (shifted(0), shifted(1));
    let matrix = a.clone().svd(true, true).solve(&b, 1e-14).unwrap();
    matrix.complex_eigenvalues().iter().copied().collect::<Vec<_>>()
}

/// A platform with base and plate turned and scaled, so that no solution lies near a chart's end.
fn turned(platform: &Platform<f64>, squares: &[f64; 6]) -> (Platform<f64>, [f64; 6]) {
    let size = platform.base.iter().chain(&platform.plate).flatten().map(|x| x * x).sum::<f64>().sqrt() / 3.4;
    let turn = |points: &[[f64; 3]; 6], q: [f64; 4]| {
        let q = Quaternion { scalar: q[0], vector: [q[1], q[2], q[3]] };
        let (norm, rotation) = (q.norm(), q.scaled_rotation());
        points.map(|p| std::array::from_fn(|i| (0..3).map(|k| rotation[i][k] * p[k]).sum::<f64>() / norm / size))
    };
    let turned = Platform {
        base: turn(&platform.base, [0.5, -0.3, 0.7, 0.4]),
        plate: turn(&platform.plate, [0.4, 0.6, -0.3, 0.5]),
    };
    (turned, squares.map(|s| s / (size * size)))
}

#[test]
fn the_quartics_of_the_rotation_have_the_same_solutions() {
    let planted = |seed: u64| {
        let mut draw = Draw::new(seed);
        let platform = draw.platform();
        let legs = platform.legs_squared(&draw.pose().1);
        (platform, legs)
    };
    let published = case("gen66_4");
    let random = (1..=4).map(planted);
    for (platform, legs) in random.chain([(published.platform, published.legs)]) {
        let platform = platform.map(|x| Some(nearest_f64(x))).unwrap();
        let (platform, squares) = turned(&platform, &legs.each_ref().map(nearest_f64));
        let mut assembly = PlatformAssembly::default();
        PlatformSolver::prepare(&platform).solve(
            &squares,
            Roots::All,
            &mut PlatformWorkspace::default(),
            &mut assembly,
        );
        let mut left_over = quotients(&quartics(&platform, &squares));
        assert_eq!((left_over.len(), assembly.total()), (40, 40));
        for mode in &assembly.modes {
            let quotient = mode.quaternion[1] / mode.quaternion[0];
            let distance = |z: &Complex<f64>| (z - quotient).norm() / (1.0 + quotient.norm_sqr());
            let nearest =
                (0..left_over.len()).min_by(|&i, &j| distance(&left_over[i]).total_cmp(&distance(&left_over[j])));
            let found = left_over.swap_remove(nearest.unwrap());
            assert!(distance(&found) < 1e-5, "{quotient}: {found}");
        }
    }
}
