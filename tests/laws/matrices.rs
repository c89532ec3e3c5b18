//! Laws of matrices: determinants by every road, linear systems, null spaces.

use crate::strategies::{matrix, rational};
use looproot::algebra::{
    determinant, matrix,
    modp::{ModP, PRIME_61},
    ring::{Field, Ring},
    univariate::Univariate,
};
use proptest::prelude::*;
use rug::Rational;

type Poly = Univariate<Rational>;

proptest! {
    #[test]
    fn have_multiplicative_determinants(a in matrix::<4, 4>(), b in matrix::<4, 4>()) {
        let product = determinant::determinant(&a) * determinant::determinant(&b);
        prop_assert_eq!(determinant::determinant(&matrix::multiply(&a, &b)), product);
        prop_assert_eq!(determinant::bareiss(&a), determinant::determinant(&a));
        prop_assert_eq!(matrix::lu(&a).determinant(), determinant::determinant(&a));
    }

    #[test]
    fn are_solved(a in matrix::<4, 4>(), b in matrix::<4, 2>()) {
        let regular = !determinant::determinant(&a).is_zero();
        prop_assert_eq!(matrix::inverse(&a).is_some(), regular);
        if let (Some(inverse), Some(x)) = (matrix::inverse(&a), matrix::solve(&a, &b)) {
            prop_assert_eq!(matrix::multiply(&a, &inverse), matrix::identity::<Rational, 4>());
            prop_assert_eq!(matrix::multiply(&inverse, &b), x.clone());
            prop_assert_eq!(matrix::multiply(&a, &x), b);
        }
    }

    #[test]
    fn have_null_spaces_of_the_right_dimension(b in matrix::<6, 2>(), c in matrix::<2, 4>()) {
        let a = matrix::multiply(&b, &c);
        let left = matrix::left_null_space(&a);
        prop_assert!(left.rank <= 2);
        prop_assert_eq!(left.rank, matrix::lu(&matrix::transpose(&a)).rank());
        for row in left.rows() {
            prop_assert_eq!(matrix::apply(&matrix::transpose(&a), row), <[Rational; 4]>::default());
        }
        let right = matrix::right_null_space(&a);
        prop_assert_eq!(right.rows().len(), 4 - left.rank);
        for row in right.rows() {
            prop_assert_eq!(matrix::apply(&a, row), <[Rational; 6]>::default());
        }
        let stacked: [[Rational; 6]; 6] =
            std::array::from_fn(|i| left.rows().get(i).cloned().unwrap_or_default());
        prop_assert_eq!(matrix::lu(&stacked).rank(), 6 - left.rank);
    }

    #[test]
    fn have_orthonormal_null_spaces_in_floats(b in matrix::<6, 2>(), c in matrix::<2, 4>()) {
        let a = matrix::multiply(&b, &c);
        let float = matrix::map(&a, f64::from_rational).unwrap();
        let (exact, null) = (matrix::left_null_space(&a), matrix::left_null_space(&float));
        prop_assert!(null.rank >= exact.rank);
        let scale = float.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
        for (i, row) in null.rows().iter().enumerate() {
            for (j, other) in null.rows().iter().enumerate() {
                let dot: f64 = row.iter().zip(other).map(|(x, y)| x * y).sum();
                prop_assert!((dot - f64::from(u8::from(i == j))).abs() < 1e-14);
            }
            for x in matrix::apply(&matrix::transpose(&float), row) {
                prop_assert!(x.abs() <= 1e-12 * scale);
            }
        }
        if null.rank < 4 {
            prop_assert!(null.pivots[null.rank] <= f64::PIVOT_ZERO * null.pivots[0]);
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

        let at_q = matrix::map(&rows, |p| Some(p.eval(&q))).unwrap();
        prop_assert_eq!(determinant::determinant(&at_q), expected.eval(&q));

        let image = |m| matrix::map(m, ModP::<PRIME_61>::from_rational).unwrap();
        let modulo = determinant::by_interpolation(&pencil.each_ref().map(image));
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
