//! The quotient algebra of a platform in numbers of 384 bits, for poses that f64 does not reach.

use super::border::{BorderBasis, DIMENSION, LongReals, MOST_DIRECTIONS, Setting, exact_directions};
use super::platform_degree::{turned, turns};
use crate::algebra::long_float::LongFloat;
use crate::algebra::ring::{Field, Ring};
use crate::closure::study::{Form, linear_legs};
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::platform::Platform;
use rug::Rational;

/// The algebra of a platform whose base and plate are turned.
#[derive(Clone, Debug)]
pub struct LongAlgebra {
    /// What it was made from.
    pub setting: Setting<LongFloat>,
    /// `z_i b` for i = 1..3 and every basis element b.
    pub products: [Vec<[LongFloat; DIMENSION]>; 3],
    /// The quaternions by which base and plate are turned: rotations are `before^* z behind`.
    pub turns: [Quaternion<LongFloat>; 2],
}

/// The algebra of a platform with legs of these squared lengths; `None` where the border basis of the general platform
/// does not exist.
#[must_use]
pub fn long_algebra(platform: &Platform<Rational>, squares: &[Rational; 6], choice: usize) -> Option<LongAlgebra> {
    let legs = linear_legs(&turned(platform, choice));
    let image = |q: &Rational| LongFloat::from_rational(q);
    let zero = LongFloat::zero();
    let mut matrix = [[zero; 7]; 6];
    let mut forms: [Form<LongFloat>; 6] = [[[zero; 4]; 4]; 6];
    for i in 0..6 {
        for k in 0..7 {
            matrix[i][k] = image(&legs.matrix[i][k])?;
        }
        for j in 0..4 {
            for k in 0..4 {
                let square = if j == k { squares[i].clone() } else { Rational::new() };
                forms[i][j][k] = image(&(square + &legs.forms[i][j][k]))?;
            }
        }
    }
    let directions = exact_directions(&LongReals, |x: LongFloat| x.inverse(), &matrix)?;
    let setting = Setting::new(&LongReals, &directions, &forms);
    if setting.count > MOST_DIRECTIONS {
        return None;
    }
    let mut basis = BorderBasis::new(&LongReals);
    basis.build(&LongReals, &setting).ok()?;
    Some(LongAlgebra { setting, products: basis.products, turns: turns(choice) })
}
