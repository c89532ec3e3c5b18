//! Unknowns without an eliminant from the others: at most three rotations or translations, with the rest of a loop known.

use super::values::Pair;
use crate::algebra::ball::Ball;
use crate::algebra::ring::Ring;
use crate::closure::woernle_lee::{FIXED, MarkedLine, act, split, z_axis};
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::motion::Motion;

/// The unknowns of a loop in which nothing else is unknown.
#[derive(Clone, Debug)]
pub enum Rest<const BITS: u32> {
    /// The loop does not close.
    Open,
    /// It closes with these values at most: no others do, and balls do not refute these.
    Unique(Vec<Pair<BITS>>),
    /// Balls leave open how many values close it.
    Undetermined,
}

/// The unknowns in `V1 M1 V2 M2 ... = I`, of which there are at most three, all of one kind.
#[must_use]
pub fn rest<const BITS: u32>(kind: Variable, constants: &[Motion<Ball<BITS>>]) -> Rest<BITS> {
    match kind {
        Variable::Rotation => rotations(constants),
        Variable::Translation => distances(constants),
    }
}

/// Translations: three linear equations.
fn distances<const BITS: u32>(constants: &[Motion<Ball<BITS>>]) -> Rest<BITS> {
    let mut whole: Motion<Ball<BITS>> = Motion::identity();
    let mut directions = Vec::new();
    for constant in constants {
        directions.push([0, 1, 2].map(|i| whole.rotation[i][2].clone()));
        whole = whole.then_after(constant);
    }
    if !overlap(&Motion::translation(whole.translation.clone()), &whole) {
        return Rest::Open;
    }
    let n = directions.len();
    // Rows: the directions' coordinates, and the displacement they have to make up for.
    let mut rows: Vec<Vec<Ball<BITS>>> =
        (0..3).map(|i| directions.iter().map(|u| u[i].clone()).chain([whole.translation[i].neg()]).collect()).collect();
    for k in 0..n {
        let Some(pivot) = (k..3).max_by(|&a, &b| rows[a][k].lower().total_cmp(&rows[b][k].lower())) else {
            return Rest::Undetermined;
        };
        rows.swap(k, pivot);
        let Some(inverse) = rows[k][k].inverse() else { return Rest::Undetermined };
        let own: Vec<Ball<BITS>> = rows[k].iter().map(|x| x.mul(&inverse)).collect();
        for (_, row) in rows.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = row[k].clone();
            for (x, p) in row.iter_mut().zip(&own) {
                *x = x.sub(&factor.mul(p));
            }
        }
        rows[k] = own;
    }
    if rows[n..].iter().any(|row| !row[n].contains_zero()) {
        return Rest::Open;
    }
    Rest::Unique(rows[..n].iter().map(|row| (row[n].clone(), Ball::zero())).collect())
}

fn rotations<const BITS: u32>(constants: &[Motion<Ball<BITS>>]) -> Rest<BITS> {
    match constants {
        [one] => last(one, Vec::new()),
        [one, two] => first_of_two(one, &two.inverse(), Vec::new()),
        [one, two, three] => middle_of_three(one, two, &three.inverse()),
        _ => Rest::Undetermined,
    }
}

/// `V M = I`
fn last<const BITS: u32>(constant: &Motion<Ball<BITS>>, mut before: Vec<Pair<BITS>>) -> Rest<BITS> {
    let back = constant.inverse();
    let pair = (back.rotation[0][0].clone(), back.rotation[1][0].clone());
    if !overlap(&Motion::rotation_z(pair.0.clone(), pair.1.clone()), &back) {
        return Rest::Open;
    }
    before.push(pair);
    Rest::Unique(before)
}

/// `V1 M V2 = K`: the axis of the second rotation determines the first one.
fn first_of_two<const BITS: u32>(
    between: &Motion<Ball<BITS>>,
    whole: &Motion<Ball<BITS>>,
    mut before: Vec<Pair<BITS>>,
) -> Rest<BITS> {
    let across = |motion: &Motion<Ball<BITS>>| {
        let axis = [0, 1].map(|i| motion.rotation[i][2].clone());
        [axis, [motion.translation[0].clone(), motion.translation[1].clone()]]
    };
    let turned = across(between).into_iter().zip(across(whole));
    let found = turned.map(|([x, y], [u, v])| (x.mul(&x).add(&y.mul(&y)), x, y, u, v));
    let Some((square, x, y, u, v)) = found.max_by(|a, b| a.0.lower().total_cmp(&b.0.lower())) else {
        return Rest::Undetermined;
    };
    let Some(inverse) = square.inverse() else { return Rest::Undetermined };
    let pair = (x.mul(&u).add(&y.mul(&v)).mul(&inverse), x.mul(&v).sub(&y.mul(&u)).mul(&inverse));
    if !on_circle(&pair) {
        return Rest::Open;
    }
    let rotated = Motion::rotation_z(pair.0.clone(), pair.1.clone()).then_after(between);
    before.push(pair);
    last(&whole.inverse().then_after(&rotated), before)
}

/// `V1 M1 V2 M2 V3 = K`: the coordinates of the third axis that the first rotation keeps are linear in cosine and sine of the
/// second rotation.
fn middle_of_three<const BITS: u32>(
    first: &Motion<Ball<BITS>>,
    second: &Motion<Ball<BITS>>,
    whole: &Motion<Ball<BITS>>,
) -> Rest<BITS> {
    let parts = split(Variable::Rotation, &act(second, &z_axis())).map(|part| act(first, &part));
    let target: MarkedLine<Ball<BITS>> = act(whole, &z_axis());
    let rows = FIXED[1..].iter().map(|&i| [parts[1][i].clone(), parts[2][i].clone(), target[i].sub(&parts[0][i])]);
    let rows: Vec<[Ball<BITS>; 3]> = rows.collect();
    let minor = |a: &[Ball<BITS>; 3], b: &[Ball<BITS>; 3], i: usize, j: usize| a[i].mul(&b[j]).sub(&a[j].mul(&b[i]));
    let pairs = (0..rows.len()).flat_map(|k| (0..k).map(move |j| (j, k)));
    let best = pairs.map(|(j, k)| (minor(&rows[j], &rows[k], 0, 1), j, k));
    let Some((determinant, j, k)) = best.max_by(|a, b| a.0.lower().total_cmp(&b.0.lower())) else {
        return Rest::Undetermined;
    };
    let Some(inverse) = determinant.inverse() else { return Rest::Undetermined };
    let (one, two) = (&rows[j], &rows[k]);
    let pair = (minor(one, two, 2, 1).mul(&inverse), minor(one, two, 0, 2).mul(&inverse));
    let holds = |row: &[Ball<BITS>; 3]| row[0].mul(&pair.0).add(&row[1].mul(&pair.1)).overlaps(&row[2]);
    if !(on_circle(&pair) && rows.iter().all(holds)) {
        return Rest::Open;
    }
    let turn = Motion::rotation_z(pair.0.clone(), pair.1.clone());
    let between = first.then_after(&turn).then_after(second);
    match first_of_two(&between, whole, Vec::new()) {
        Rest::Unique(found) => {
            let [one, three] = [0, 1].map(|k| found[k].clone());
            Rest::Unique(vec![one, pair, three])
        }
        other => other,
    }
}

/// Returns whether balls allow a cosine and a sine to belong to one angle.
fn on_circle<const BITS: u32>((cos, sin): &Pair<BITS>) -> bool {
    cos.mul(cos).add(&sin.mul(sin)).overlaps(&Ball::one())
}

/// Returns whether balls allow two motions to be equal.
fn overlap<const BITS: u32>(one: &Motion<Ball<BITS>>, other: &Motion<Ball<BITS>>) -> bool {
    let entries =
        |m: &Motion<Ball<BITS>>| m.rotation.iter().flatten().chain(&m.translation).cloned().collect::<Vec<_>>();
    entries(one).iter().zip(&entries(other)).all(|(a, b)| a.overlaps(b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::values::meet;
    use rug::Rational;

    type Short = Ball<128>;

    fn ball(p: i32, q: i32) -> Short {
        Ball::from_rational(&Rational::from((p, q))).expect("rationals have balls")
    }

    fn pair(p: i32, q: i32) -> Pair<128> {
        let t = ball(p, q);
        let inverse = Ball::one().add(&t.mul(&t)).inverse().expect("1 + t^2 is not 0");
        (Ball::one().sub(&t.mul(&t)).mul(&inverse), t.add(&t).mul(&inverse))
    }

    fn link(p: i32, q: i32, shift: i32) -> Motion<Short> {
        let (cos, sin) = pair(p, q);
        Motion { translation: [ball(shift, 3), ball(1, 2), ball(2, 7)], ..Motion::rotation_x(cos, sin) }
    }

    #[test]
    fn rotations_are_found_from_the_rest_of_a_loop() {
        let angles = [pair(1, 3), pair(-5, 2), pair(7, 4)];
        for count in 1..=3 {
            let links: Vec<Motion<Short>> = (0..count).map(|k| link(k + 1, 3, k + 2)).collect();
            let mut open = Motion::identity();
            let count = links.len();
            for (k, (cos, sin)) in angles[..count].iter().enumerate() {
                open = open.then_after(&Motion::rotation_z(cos.clone(), sin.clone()));
                if k + 1 < count {
                    open = open.then_after(&links[k]);
                }
            }
            let mut constants = links;
            constants[count - 1] = open.inverse();
            let Rest::Unique(found) = rest(Variable::Rotation, &constants) else {
                panic!("{count} rotations are determined")
            };
            assert!(found.iter().zip(&angles).all(|(a, b)| meet(a, b)), "{count}");
            constants[count - 1].translation[2] = ball(99, 7);
            assert!(matches!(rest(Variable::Rotation, &constants), Rest::Open), "{count}");
        }
    }

    #[test]
    fn two_rotations_about_one_axis_are_not_determined() {
        let along = Motion::translation_z(ball(2, 1));
        assert!(matches!(rest(Variable::Rotation, &[along.clone(), along.inverse()]), Rest::Undetermined));
    }

    #[test]
    fn translations_are_found_from_the_rest_of_a_loop() {
        for count in 1..=3 {
            // Links that turn about x alone would leave all directions in one plane.
            let out_of_plane = |k: i32| {
                let (cos, sin) = pair(1, k + 2);
                Motion::rotation_z(cos, sin).then_after(&link(k + 1, 3, k + 2))
            };
            let mut constants: Vec<Motion<Short>> = (0..count).map(out_of_plane).collect();
            let distances = [ball(5, 3), ball(-2, 1), ball(1, 7)];
            let count = constants.len();
            let mut open: Motion<Short> = Motion::identity();
            for (k, distance) in distances[..count].iter().enumerate() {
                open = open.then_after(&Motion::translation_z(distance.clone()));
                if k + 1 < count {
                    open = open.then_after(&constants[k]);
                }
            }
            constants[count - 1] = open.inverse();
            let Rest::Unique(found) = rest(Variable::Translation, &constants) else { panic!("{count} are determined") };
            assert!(found.iter().zip(&distances).all(|((a, _), b)| a.overlaps(b)), "{count}");
            constants[count - 1] = constants[count - 1].then_after(&link(1, 5, 1));
            assert!(matches!(rest(Variable::Translation, &constants), Rest::Open), "{count}");
        }
        let along = Motion::translation_z(ball(2, 1));
        let parallel = [along.clone(), along.inverse()];
        assert!(matches!(rest::<128>(Variable::Translation, &parallel), Rest::Undetermined));
    }
}
