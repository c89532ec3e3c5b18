//! One conversion of a rotation in f64, either way: `cargo bench -p looproot-calculus`. None should take 100 ns.
#![allow(clippy::unwrap_used)]

use divan::{Bencher, black_box};
use looproot_calculus::motion::Vector;
use looproot_calculus::quaternion::Quaternion;
use looproot_calculus::rotation::cayley_klein::CayleyKlein;
use looproot_calculus::rotation::euler::{Angles, Order};
use looproot_calculus::rotation::matrix::{Matrix, from_matrix, matrix};
use looproot_calculus::rotation::turn::Turn;
use looproot_calculus::rotation::vectors::{
    axis_angle, euler_vectors, from_axis_angle, from_euler_vector, from_rodrigues, from_wiener, rodrigues, unit, wiener,
};

fn main() {
    // A single conversion is shorter than the grain of the timer.
    divan::Divan::from_args().sample_count(1000).sample_size(100).main();
}

fn rotation() -> Quaternion<f64> {
    unit(&Quaternion { scalar: 0.3, vector: [-0.5, 0.7, 0.2] }).unwrap()
}

fn rows() -> Matrix<f64> {
    matrix(&rotation()).unwrap()
}

/// Returns the angles of the first branch, in radians.
fn angles(order: Order, rows: &Matrix<f64>) -> Option<[f64; 3]> {
    match order.angles(rows)? {
        Angles::Two([first, _]) => {
            let [a, b, c] = first;
            Some([a.angle()?, b.angle()?, c.angle()?])
        }
        Angles::Family { middle, outer, .. } => Some([outer.angle()?, middle.angle()?, 0.0]),
    }
}

#[divan::bench]
fn matrix_of_quaternion(bencher: Bencher) {
    let q = rotation();
    bencher.bench(|| matrix(black_box(&q)));
}

#[divan::bench]
fn quaternion_of_matrix(bencher: Bencher) {
    let rows = rows();
    bencher.bench(|| unit(&from_matrix(black_box(&rows))));
}

#[divan::bench(args = ["zxz", "xyz"])]
fn angles_of_matrix(bencher: Bencher, order: &str) {
    let (order, rows) = (Order::parse(order).unwrap(), rows());
    bencher.bench(|| angles(order, black_box(&rows)));
}

#[divan::bench(args = ["zxz", "xyz"])]
fn matrix_of_angles(bencher: Bencher, order: &str) {
    let order = Order::parse(order).unwrap();
    let given = angles(order, &rows()).unwrap();
    bencher.bench(|| order.matrix(&black_box(&given).each_ref().map(Turn::of_angle)));
}

#[divan::bench]
fn euler_rodrigues_parameters_of_quaternion(bencher: Bencher) {
    let q = Quaternion { scalar: 0.3, vector: [-0.5, 0.7, 0.2] };
    bencher.bench(|| unit(black_box(&q)));
}

#[divan::bench]
fn axis_and_angle_of_quaternion(bencher: Bencher) {
    let q = rotation();
    bencher.bench(|| axis_angle(black_box(&q)));
}

#[divan::bench]
fn quaternion_of_axis_and_angle(bencher: Bencher) {
    let (axis, angle) = axis_angle(&rotation()).unwrap();
    bencher.bench(|| from_axis_angle(black_box(&axis), black_box(&angle)));
}

#[divan::bench]
fn euler_vector_of_quaternion(bencher: Bencher) {
    let q = rotation();
    bencher.bench(|| euler_vectors(black_box(&q)));
}

#[divan::bench]
fn quaternion_of_euler_vector(bencher: Bencher) {
    let vector: Vector<f64> = euler_vectors(&rotation())[0];
    bencher.bench(|| from_euler_vector(black_box(&vector)));
}

#[divan::bench]
fn rodrigues_vector_of_quaternion(bencher: Bencher) {
    let q = rotation();
    bencher.bench(|| rodrigues(black_box(&q)));
}

#[divan::bench]
fn quaternion_of_rodrigues_vector(bencher: Bencher) {
    let vector: Vector<f64> = rodrigues(&rotation()).unwrap();
    bencher.bench(|| from_rodrigues(black_box(&vector)));
}

#[divan::bench]
fn wiener_vectors_of_quaternion(bencher: Bencher) {
    let q = rotation();
    bencher.bench(|| wiener(black_box(&q)));
}

#[divan::bench]
fn quaternion_of_wiener_vector(bencher: Bencher) {
    let vector: Vector<f64> = wiener(&rotation())[0];
    bencher.bench(|| from_wiener(black_box(&vector)));
}

#[divan::bench]
fn cayley_klein_parameters_of_quaternion(bencher: Bencher) {
    let q = rotation();
    bencher.bench(|| CayleyKlein::of(black_box(&q)));
}

#[divan::bench]
fn quaternion_of_cayley_klein_parameters(bencher: Bencher) {
    let given = CayleyKlein::of(&rotation());
    bencher.bench(|| black_box(&given).quaternion());
}
