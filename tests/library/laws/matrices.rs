//! Laws of matrices: determinants by every road, linear systems, null spaces.

use crate::strategies::{matrix, rational};
use looproot_algebra::{
    determinant,
    modp::{ModP, PRIME_61},
    reduction::{Reduction, reduce},
    ring::{Field, Ring},
    univariate::Univariate,
};
use proptest::prelude::*;
use rug::Rational;

fn multiply<const A: usize, const B: usize, const C: usize>(
    a: &[[Rational; B]; A],
    b: &[[Rational; C]; B],
) -> [[Rational; C]; A] {
    let entry = |i: usize, j: usize| (0..B).fold(Rational::new(), |sum, k| sum + Rational::from(&a[i][k] * &b[k][j]));
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

fn image<R, const A: usize, const B: usize>(
    a: &[[Rational; B]; A],
    map: impl Fn(&Rational) -> Option<R>,
) -> [[R; B]; A] {
    a.each_ref().map(|row| row.each_ref().map(|x| map(x).unwrap()))
}

type Poly = Univariate<Rational>;

proptest! {
    #[test]
    fn have_multiplicative_determinants(a in matrix::<4, 4>(), b in matrix::<4, 4>()) {
        let product = determinant::determinant(&a) * determinant::determinant(&b);
        prop_assert_eq!(determinant::determinant(&multiply(&a, &b)), product);
        prop_assert_eq!(determinant::bareiss(&a), determinant::determinant(&a));
    }

    #[test]
    fn are_reduced_to_unit_rows_and_null_rows(b in matrix::<6, 3>(), c in matrix::<3, 4>()) {
        // The rank is at most 3, and the transform is regular whatever the rank.
        let a = multiply(&b, &c);
        let reduced: Reduction<Rational, 6, 4> = reduce(a.clone());
        prop_assert!(reduced.rank <= 3 && reduced.independence == 0.0);
        prop_assert!(!determinant::determinant(&reduced.transform).is_zero());
        let product = multiply(&reduced.transform, &a);
        for (i, row) in product.iter().enumerate() {
            for (k, pivot) in reduced.columns[..reduced.rank].iter().enumerate() {
                prop_assert_eq!(&row[*pivot], &Rational::from(u32::from(i == k)));
            }
            prop_assert!(i < reduced.rank || row.iter().all(Ring::is_zero));
        }
    }

    #[test]
    fn are_solved_by_their_reduction(a in matrix::<4, 4>()) {
        let reduced: Reduction<Rational, 4, 4> = reduce(a.clone());
        prop_assert_eq!(reduced.rank == 4, !determinant::determinant(&a).is_zero());
        if reduced.rank == 4 {
            let product = multiply(&reduced.transform, &a);
            for (i, row) in product.iter().enumerate() {
                for (j, x) in row.iter().enumerate() {
                    prop_assert_eq!(x, &Rational::from(u32::from(j == reduced.columns[i])));
                }
            }
            let float = reduce::<f64, 4, 4>(image(&a, f64::from_rational));
            prop_assert_eq!(float.rank, 4);
            prop_assert!(float.independence > 0.0 && float.independence <= 1.0);
        }
    }

    #[test]
    fn have_orthonormal_null_rows_in_floats(b in matrix::<6, 2>(), c in matrix::<2, 4>()) {
        let a = image(&multiply(&b, &c), f64::from_rational);
        let scale = a.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
        let reduced: Reduction<f64, 6, 4> = reduce(a);
        let mut rows = reduced.transform[reduced.rank..].to_vec();
        f64::orthonormalise(&mut rows);
        for (i, row) in rows.iter().enumerate() {
            for (j, other) in rows.iter().enumerate() {
                let dot: f64 = row.iter().zip(other).map(|(x, y)| x * y).sum();
                prop_assert!((dot - f64::from(u8::from(i == j))).abs() < 1e-14);
            }
            for column in 0..4 {
                let sum: f64 = (0..6).map(|k| row[k] * a[k][column]).sum();
                prop_assert!(sum.abs() <= 1e-12 * scale);
            }
        }
    }

    #[test]
    fn of_polynomials_have_one_determinant(
        a in matrix::<3, 3>(), b in matrix::<3, 3>(), c in matrix::<3, 3>(), q in rational(),
    ) {
        let pencil = [a, b, c];
        let entry = |i: usize, j: usize| Poly::new(pencil.iter().map(|m| m[i][j].clone()).collect());
        let rows: [[Poly; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
        let expected = determinant::bareiss(&rows);
        prop_assert_eq!(&determinant::by_interpolation(&pencil), &expected);
        prop_assert_eq!(&determinant::modular(&pencil), &expected);

        let at_q = rows.each_ref().map(|row| row.each_ref().map(|p| p.eval(&q)));
        prop_assert_eq!(determinant::determinant(&at_q), expected.eval(&q));

        let modular = |m| image(m, ModP::<PRIME_61>::from_rational);
        let modulo = determinant::by_interpolation(&pencil.each_ref().map(modular));
        prop_assert_eq!(Some(modulo), expected.map(ModP::from_rational));
    }
}

#[test]
fn of_no_size_have_determinant_one() {
    let none: [[[Rational; 0]; 0]; 1] = [[]];
    assert_eq!(determinant::modular(&none), Poly::one());
    assert_eq!(determinant::by_interpolation(&none), Poly::one());
}

#[test]
fn of_polynomials_may_be_stored_on_the_heap() {
    let heap: Vec<Vec<Vec<Rational>>> = vec![vec![vec![Rational::from(2)]], vec![vec![Rational::from((1, 3))]]];
    assert_eq!(determinant::modular(&heap), crate::strategies::integers(&[6, 1]).scale(&Rational::from((1, 3))));
}
