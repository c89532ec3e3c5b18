//! The quotient algebra of a platform in multiprecision, for poses that f64 does not reach.

use super::border::{BorderBasis, DIMENSION, LongReals, MOST_DIRECTIONS, Setting, exact_directions};
use super::platform_degree::{turned, turns};
use crate::algebra::long_float::LongNumber;
use crate::algebra::ring::{Field, Ring};
use crate::closure::study::{Form, linear_legs};
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::platform::Platform;
use rug::Rational;

/// The algebra of a platform whose base and plate are turned.
#[derive(Clone, Debug)]
pub struct LongAlgebra<const LIMBS: usize> {
    /// The input that it was computed from.
    pub setting: Setting<LongNumber<LIMBS>>,
    /// `z_i b` for i = 1..3 and every basis element b.
    pub products: [Vec<[LongNumber<LIMBS>; DIMENSION]>; 3],
    /// The quaternions by which base and plate are turned: rotations are `before^* z behind`.
    pub turns: [Quaternion<LongNumber<LIMBS>>; 2],
}

/// The algebra of a platform with legs of these squared lengths; `None` where the border basis of the general platform
/// does not exist.
#[must_use]
pub fn long_algebra<const LIMBS: usize>(
    platform: &Platform<Rational>,
    squares: &[Rational; 6],
    choice: usize,
) -> Option<LongAlgebra<LIMBS>> {
    let legs = linear_legs(&turned(platform, choice));
    let image = |q: &Rational| LongNumber::<LIMBS>::from_rational(q);
    let zero = LongNumber::<LIMBS>::zero();
    let mut matrix = [[zero; 7]; 6];
    let mut forms: [Form<LongNumber<LIMBS>>; 6] = [[[zero; 4]; 4]; 6];
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
    let directions = exact_directions(&LongReals::<LIMBS>, |x: LongNumber<LIMBS>| x.inverse(), &matrix)?;
    let setting = Setting::new(&LongReals::<LIMBS>, &directions, &forms);
    if setting.count > MOST_DIRECTIONS {
        return None;
    }
    let mut basis = BorderBasis::new(&LongReals::<LIMBS>);
    basis.build(&LongReals::<LIMBS>, &setting).ok()?;
    Some(LongAlgebra { setting, products: basis.products, turns: turns(choice) })
}
