//! Six points of space or of the plane of which base and plate are affine images.

use crate::algebra::echelon::Echelon;
use crate::kinematics::motion::Vector;
use crate::kinematics::platform::Platform;
use rug::Rational;

/// Points u_i with `a_i = o + E u_i` on the base and `b_i = c + M u_i` on the plate. One of them is 0, and one per dimension is a
/// unit vector.
#[derive(Clone, Debug, PartialEq)]
pub struct AffineRelation {
    /// The point o of the base and the point c of the plate.
    pub origins: [Vector<Rational>; 2],
    /// The columns of E and of M.
    pub columns: [Vec<Vector<Rational>>; 2],
    /// The points u_i.
    pub points: [Vec<Rational>; 6],
    /// Indices of the points that are the unit vectors.
    pub units: Vec<usize>,
}

/// `p - q`
fn difference(p: &Vector<Rational>, q: &Vector<Rational>) -> Vector<Rational> {
    std::array::from_fn(|k| Rational::from(&p[k] - &q[k]))
}

impl AffineRelation {
    /// Returns the relation of a platform; `None` where the points u_i would need more than three dimensions, or fewer than two.
    #[must_use]
    pub fn of(platform: &Platform<Rational>) -> Option<Self> {
        let bodies = [&platform.base, &platform.plate];
        // Column of each leg but the first: the differences of its ends from the ends of the first leg.
        let differences: Vec<[Vector<Rational>; 2]> =
            (1..6).map(|i| bodies.map(|points| difference(&points[i], &points[0]))).collect();
        let rows = (0..6).map(|k| differences.iter().map(|d| d[k / 3][k % 3].clone()).collect()).collect();
        let echelon = Echelon::of(rows, 5);
        if !(2..=3).contains(&echelon.rank()) {
            return None;
        }
        let units: Vec<usize> = echelon.pivots().iter().map(|column| column + 1).collect();
        let columns = [0, 1].map(|body| units.iter().map(|i| differences[i - 1][body].clone()).collect());
        let zero = vec![Rational::new(); units.len()];
        let point = |i: usize| match i.checked_sub(1) {
            None => zero.clone(),
            Some(column) => echelon.rows().iter().map(|row| row[column].clone()).collect(),
        };
        let origins = bodies.map(|points| points[0].clone());
        Some(Self { origins, columns, points: std::array::from_fn(point), units })
    }

    /// The dimension of the space of the points u_i: 2 or 3.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.units.len()
    }

    /// The platform about the points o and c.
    #[must_use]
    pub fn centred(&self, platform: &Platform<Rational>) -> Platform<Rational> {
        let centred = |points: &[Vector<Rational>; 6], origin: &Vector<Rational>| {
            points.each_ref().map(|p| difference(p, origin))
        };
        Platform { base: centred(&platform.base, &self.origins[0]), plate: centred(&platform.plate, &self.origins[1]) }
    }
}
