//! A loop followed through its input: velocities, accelerations and the points of its curve.

use super::FullMode;
use super::overconstrained_loop::filled_up;
use super::single_loop::{closing_transformation, locked_variable};
use super::spherical_angles::idle_spin;
use super::spherical_angles::{Jet, TurnedJoint, ss_dyad_angles};
use crate::algebra::number::{Angle, HalfTangent, Number};
use crate::algebra::series::Series;
use crate::catalogue::entry::{Case, Design, Entry, Input, InputValue};
use crate::elimination::spherical_pair;
use crate::error::{Error, Result};
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::{Layout, Numbers, OpenLoop, OpenSsDyad, Variable};
use crate::kinematics::idle::Idle;
use crate::kinematics::motion::Motion;
use crate::solve::curve::{ALONG_INPUT, Curve, INPUT, Point};
use crate::solve::plane_curve::{PlaneCurve, UNKNOWN};
use crate::solve::walk::Followed;

/// Condition numbers beyond this leave no digit of a derivative.
const SINGULAR: f64 = 1e13;

/// The derivatives of a loop's joints with respect to its input at one mode, in joint order.
#[derive(Clone, Debug, PartialEq)]
pub struct Derivatives {
    /// `dq/dx`: the rates of all joint variables at input rate 1; not a number where the angles of a spherical joint have none.
    pub velocity: Vec<f64>,
    /// `d2q/dx2`: their accelerations at input rate 1 and input acceleration 0. In general `q'' = d2q/dx2 w^2 + dq/dx a`.
    pub acceleration: Vec<f64>,
}

/// The curve of a loop, and its place among the joints.
pub struct InputCurve {
    layout: Layout,
    way: Way,
}

/// The space in which the curve lies.
enum Way {
    /// Six unknowns and the input.
    Loop { curve: Box<Curve>, spherical: Option<TurnedJoint> },
    /// The unknown between two spherical joints and the input.
    Pair(Box<Pair>),
}

/// Two spherical joints: their distance couples one unknown to the input.
struct Pair {
    curve: PlaneCurve,
    open: OpenSsDyad<Jet>,
    /// Indices of the first variables of the two spherical joints, and of the unknown, in joint order.
    indices: [usize; 3],
    note: String,
}

impl InputCurve {
    /// Returns a note on the angles of spherical joints: the position of the idle degree of freedom to which they belong.
    #[must_use]
    pub fn note(&self) -> Option<&str> {
        match &self.way {
            Way::Loop { .. } => None,
            Way::Pair(pair) => Some(&pair.note),
        }
    }

    /// The curve of the loop of an entry, moved by the input of a case.
    ///
    /// # Errors
    /// [`Error::Invalid`] for arms and platforms, which have no input, and for joints without such a variable;
    /// [`Error::Unsupported`] for loops that are not solved.
    pub fn of(entry: &Entry, case: &Case) -> Result<Self> {
        let Design::Loop(chain) = &entry.design else {
            let what = if matches!(entry.design, Design::Arm(_)) { "an arm" } else { "a platform" };
            let message = format!("found {what}, which has no input to move by, expected a loop");
            return Err(Error::Invalid(message));
        };
        let locked = locked_variable(chain, case)?
            .ok_or_else(|| Error::Invalid("found no input, expected an input of a loop".to_owned()))?;
        let layout = filled_up(chain, Layout::of(chain, Some(locked))?)?;
        let input = layout.variables[locked];
        if layout.second_spherical.is_some() {
            let pair = Pair::of(chain, &layout, input)?;
            return Ok(Self { layout, way: Way::Pair(Box::new(pair)) });
        }
        let idle = layout.joint_variables().map(|joint| joint.is_none());
        let mut open = chain.open_loop(&layout)?;
        let spherical = layout.spherical.map(|joint| turned(chain, &layout, joint, &mut open));
        let curve = Box::new(Curve::new(&open, idle, input));
        Ok(Self { layout, way: Way::Loop { curve, spherical } })
    }

    /// Returns the kind of each joint variable, in joint order.
    #[must_use]
    pub fn variables(&self) -> &[Variable] {
        &self.layout.variables
    }

    /// Index of the input among the joint variables.
    #[must_use]
    pub fn input(&self) -> usize {
        self.layout.locked.unwrap_or(0)
    }

    /// Returns the kind of each variable of a point.
    #[must_use]
    pub fn kinds(&self) -> &[Variable; 7] {
        match &self.way {
            Way::Loop { curve, .. } => curve.variables(),
            Way::Pair(pair) => pair.curve.variables(),
        }
    }

    /// The unit of a variable of a point: 1 for angles, the scale of the loop for lengths.
    #[must_use]
    pub fn unit(&self, index: usize) -> f64 {
        match &self.way {
            Way::Loop { curve, .. } => curve.unit(index),
            Way::Pair(pair) => pair.curve.unit(index),
        }
    }

    /// Returns the index of the variable of a point that is the first of the three of a spherical joint, if there is one.
    #[must_use]
    pub fn spherical(&self) -> Option<usize> {
        match &self.way {
            Way::Loop { spherical, .. } => spherical.as_ref().map(|spherical| spherical.unknown),
            Way::Pair(_) => None,
        }
    }

    /// A point of the curve from the joint variables in joint order.
    ///
    /// # Panics
    /// When `q` is not as long as there are joint variables.
    #[must_use]
    pub fn point(&self, q: &[f64]) -> Point {
        let mut point = self.without_spherical_joints(q);
        if let Way::Loop { spherical: Some(spherical), .. } = &self.way {
            let inside = spherical.inside([0, 1, 2].map(|k| q[spherical.joint + k]));
            point[spherical.unknown..spherical.unknown + 3].copy_from_slice(&inside);
        }
        point
    }

    /// As [`InputCurve::point`], with the angles of spherical joints at 0: a linear function of the others, which tell modes apart.
    ///
    /// # Panics
    /// When `q` is not as long as there are joint variables.
    #[must_use]
    pub fn without_spherical_joints(&self, q: &[f64]) -> Point {
        let given = q[self.input()] / self.unit(INPUT);
        match &self.way {
            Way::Pair(pair) => {
                let mut point = [0.0; 7];
                (point[UNKNOWN], point[INPUT]) = (q[pair.indices[2]] / self.unit(UNKNOWN), given);
                point
            }
            Way::Loop { spherical, .. } => {
                let unknowns = self.layout.unknowns(q).expect("one value for every joint variable");
                let is_spherical = |k: usize| {
                    spherical.as_ref().is_some_and(|spherical| (spherical.unknown..spherical.unknown + 3).contains(&k))
                };
                std::array::from_fn(|k| match k {
                    INPUT => given,
                    _ if is_spherical(k) => 0.0,
                    _ => unknowns[k] / self.unit(k),
                })
            }
        }
    }

    /// The joint variables in joint order at a point of the curve, angles as they are.
    #[must_use]
    pub fn joints(&self, point: &Point) -> Vec<f64> {
        let jets = std::array::from_fn(|k| Series::constant(point[k] * self.unit(k)));
        self.moving(&jets).iter().map(|jet| jet.coefficients[0]).collect()
    }

    /// The joint variables in joint order, with those of a point, in the units of the mechanism, as series.
    fn moving(&self, values: &[Jet; 7]) -> Vec<Jet> {
        match &self.way {
            Way::Loop { spherical, .. } => {
                let mut q = self.layout.assemble(&std::array::from_fn(|k| values[k]), values[INPUT]);
                if let Some(spherical) = spherical {
                    let own = spherical.outside(&[0, 1, 2].map(|k| values[spherical.unknown + k]));
                    q[spherical.joint..spherical.joint + 3].copy_from_slice(&own);
                }
                q
            }
            Way::Pair(pair) => {
                let mut q = vec![values[INPUT]; self.layout.variables.len()];
                let [unknown, given] = [&values[UNKNOWN], &values[INPUT]];
                let spherical_joints = ss_dyad_angles(&pair.open, self.layout.variables[self.input()], unknown, given);
                for (at, angles) in pair.indices.into_iter().zip(spherical_joints) {
                    q[at..at + 3].copy_from_slice(&angles);
                }
                q[pair.indices[2]] = *unknown;
                q
            }
        }
    }

    /// Whether no curve leads away from a point, see [`Curve::is_rigid`].
    #[must_use]
    pub fn is_rigid(&self, at: &Point) -> bool {
        match &self.way {
            Way::Loop { curve, .. } => curve.is_rigid(at),
            Way::Pair(_) => false,
        }
    }

    /// The Taylor coefficients of the curve at a point of it, see [`Curve::taylor`].
    #[must_use]
    pub fn taylor<const N: usize>(&self, at: &Point, border: &Point) -> Option<[Point; N]> {
        match &self.way {
            Way::Loop { curve, .. } => curve.taylor(at, border),
            Way::Pair(pair) => pair.curve.taylor(at, border),
        }
    }

    /// The direction of the curve at a point of it, see [`Curve::tangent`].
    #[must_use]
    pub fn tangent(&self, at: &Point, towards: &Point) -> Option<Point> {
        match &self.way {
            Way::Loop { curve, .. } => curve.tangent(at, towards),
            Way::Pair(pair) => pair.curve.tangent(at, towards),
        }
    }

    /// The point of the curve with the same `border . q` as `start`, see [`Curve::corrected`].
    #[must_use]
    pub fn corrected(&self, start: &Point, border: &Point) -> Option<(Point, f64)> {
        match &self.way {
            Way::Loop { curve, .. } => curve.corrected(start, border),
            Way::Pair(pair) => pair.curve.corrected(start, border),
        }
    }

    /// Velocities and accelerations of all joints at a mode; `None` for complex and for singular ones.
    #[must_use]
    pub fn derivatives(&self, mode: &FullMode) -> Option<Derivatives> {
        let regular = mode.real && mode.multiplicity == 1 && mode.condition < SINGULAR;
        let q: Vec<f64> = mode.q.iter().map(|z| z.re).collect();
        regular.then(|| self.derivatives_at(&self.point(&q)))?
    }

    /// Velocities and accelerations of all joints at a point of the curve; `None` where the input is no coordinate of it.
    #[must_use]
    pub fn derivatives_at(&self, at: &Point) -> Option<Derivatives> {
        let [_, first, second] = self.taylor::<3>(at, &ALONG_INPUT)?;
        // From the input in the unit of the curve to the input as it is given.
        let unit = self.unit(INPUT);
        let series = |k: usize| {
            let coefficients = [at[k], first[k] / unit, second[k] / (unit * unit)];
            Series { coefficients: coefficients.map(|c| c * self.unit(k)) }
        };
        let moving = self.moving(&std::array::from_fn(series));
        Some(Derivatives {
            velocity: moving.iter().map(|jet| jet.coefficients[1]).collect(),
            acceleration: moving.iter().map(|jet| 2.0 * jet.coefficients[2]).collect(),
        })
    }
}

impl Followed for InputCurve {
    fn taylor(&self, at: &Point, border: &Point) -> Option<[Point; 3]> {
        Self::taylor(self, at, border)
    }
    fn tangent(&self, at: &Point, towards: &Point) -> Option<Point> {
        Self::tangent(self, at, towards)
    }
    fn corrected(&self, start: &Point, border: &Point) -> Option<(Point, f64)> {
        Self::corrected(self, start, border)
    }
}

/// Turns the spherical joint of a loop, whose first joint variable is `joint`, by rotations in general position.
fn turned(chain: &Chain, layout: &Layout, joint: usize, open: &mut OpenLoop<f64>) -> TurnedJoint {
    let unknown = layout.joint_variables().iter().position(|own| *own == Some(joint)).unwrap_or(0);
    let [before, behind] = [7, 11].map(|choice| {
        let frame = Idle { behind: 0, variable: Variable::Rotation, choice }.frame(&chain.unit());
        frame.rotation.map(|row| row.map(|x| x.to_f64()))
    });
    let motion = |rotation| Motion { rotation, translation: [0.0; 3] };
    // V behind V1 V2 V3 of the spherical joint, and what stands before them: `X' = A^-1 X B^-1`.
    let first = match unknown.checked_sub(1) {
        None => &mut open.after_gap,
        Some(k) => &mut open.constants[k],
    };
    *first = first.then_after(&motion(before));
    let last = if unknown + 2 == 5 { &mut open.before_gap } else { &mut open.constants[unknown + 2] };
    *last = motion(behind).then_after(last);
    TurnedJoint { unknown, joint, before, behind }
}

impl Pair {
    /// Two spherical joints of a chain, coupled to the locked variable of a layout.
    fn of(chain: &Chain, layout: &Layout, input: Variable) -> Result<Self> {
        let open: OpenSsDyad<f64> = chain.open_ss_dyad(layout, &Numbers)?;
        let unit = chain.unit();
        let given = |value: InputValue| {
            let case = Case::given(Input { joint: 1, value }, 0);
            closing_transformation::<f64>(&case).map(|motion| open.close(&motion))
        };
        // The equation at three inputs determines its coefficients, which are linear in the monomials of the input.
        let at = |k: i32| match input {
            Variable::Rotation if k == 2 => InputValue::Angle(Angle::from_half_tangent(HalfTangent::Infinite)),
            Variable::Rotation => InputValue::Angle(Angle::from_half_tangent(HalfTangent::Finite(k.into()))),
            Variable::Translation => InputValue::Distance(Number::exact(unit.clone() * (k - 1))),
        };
        let [one, two, three] = [given(at(0))?, given(at(1))?, given(at(2))?];
        let indices = one.indices;
        let rows = [one, two, three].map(|ss_dyad| spherical_pair::equation(&ss_dyad));
        let [low, middle, high] = rows;
        let length = unit.to_f64();
        let coefficients = std::array::from_fn(|i| {
            let (even, odd) = (f64::midpoint(low[i], high[i]), f64::midpoint(low[i], -high[i]));
            match input {
                // At 0, a quarter turn and a half turn.
                Variable::Rotation => [even, odd, middle[i] - even],
                // At -1, 0 and 1 units.
                Variable::Translation => [middle[i], -odd / length, (even - middle[i]) / (length * length)],
            }
        });
        let curve = PlaneCurve::new(layout.variables[indices[2]], input, &coefficients, length);
        let note = idle_spin(chain, layout, indices[1]);
        Ok(Self { curve, open: chain.open_ss_dyad(layout, &Numbers)?, indices, note })
    }
}
