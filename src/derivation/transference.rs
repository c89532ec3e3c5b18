//! The principle of transference: the closure equation of a spherical loop, over dual numbers, is that of the spatial one.
//!
//! One equation is generic over the ring: `z2 . z3 = cos alpha2` of the spherical four-bar `R1 R2 R3 R4 = 1`, `R_k =
//! Rz(theta_k) Rx(alpha_k)`. Every angle `phi` becomes `phi + eps l`, a twist with the length of its link, a joint angle with
//! the offset of its joint. The part without eps is again the spherical equation f, the part with eps a second equation g. For
//! the loop `prod Rz(theta_k) Tz(d_k) Rx(alpha_k) Tx(a_k) = 1`, both hold if and only if axes 2 and 3 have the relative position
//! that link 2 gives them: the same angle and the same mutual moment.

use crate::algebra::dual::Dual;
use crate::algebra::int::Int;
use crate::algebra::number::Angle;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Ring, exact_cos_sin};
use crate::algebra::text::Names;
use crate::algebra::trigonometric::{Pair, Trigonometric, half_tangents};
use crate::elimination::spherical_four_bar::four_bar;
use crate::error::{Error, Result};
use crate::kinematics::chain::{Chain, Geometry, Joint, JointKind};
use crate::kinematics::motion::{Motion, dot};
use rug::Rational;

/// Cosine and sine of an angle.
pub type CosSin<R> = (R, R);

/// Returns `z2 . z3 - cos alpha2`, the closure equation of a spherical four-bar in the angles of joints 1 and 4, over any ring.
///
/// # Shape
/// `twists` holds the twists of links 1 to 4; link k lies between joints k and k + 1.
///
/// # Source
/// \[Wittenburg2016\]
///
/// # Example
/// ```
/// use looproot::internal::derivation::transference::spherical_four_bar;
///
/// // Hooke's joint: right twists but the last; tan theta1 tan theta4 = cos beta.
/// let angle = |phi: f64| (phi.cos(), phi.sin());
/// let right = angle(std::f64::consts::FRAC_PI_2);
/// let (beta, first) = (0.3_f64, 0.7_f64);
/// let fourth = (beta.cos() / first.tan()).atan();
/// let f = spherical_four_bar(&[right, right, right, angle(beta)], &angle(first), &angle(fourth));
/// assert!(f.abs() < 1e-15);
/// ```
pub fn spherical_four_bar<R: Ring>(twists: &[CosSin<R>; 4], first: &CosSin<R>, fourth: &CosSin<R>) -> R {
    let [first_link, opposite, before, base] = twists.each_ref().map(|(c, s)| Motion::rotation_x(c.clone(), s.clone()));
    let form = four_bar([&before, &base, &first_link, &opposite].map(|link| &link.rotation));
    // In the frame of link 4: bilinear in (1, cos, sin) of the joints at its ends.
    let monomials = |(cos, sin): &CosSin<R>| [R::one(), cos.clone(), sin.clone()];
    dot(&monomials(fourth), &form.map(|row| dot(&row, &monomials(first))))
}

/// The lines of a loop of four joints as dual angles.
#[derive(Clone, Debug)]
pub struct SpatialFourBar<R> {
    /// The twists of the four links.
    pub twists: [CosSin<R>; 4],
    /// The lengths of the four links.
    pub lengths: [R; 4],
    /// The angle of joint 1.
    pub first: CosSin<R>,
    /// The offset of joint 1.
    pub first_offset: R,
    /// The angle of joint 4.
    pub fourth: CosSin<R>,
    /// The offset of joint 4.
    pub fourth_offset: R,
}

/// The closure equations of a spatial loop of four joints in the variables of joints 1 and 4.
#[derive(Clone, Debug, PartialEq)]
pub struct SpatialPair<R> {
    /// The spherical equation, in the angles only.
    pub f: R,
    /// The second equation, linear in lengths and offsets: `sum a_k df/dalpha_k + d1 df/dtheta1 + d4 df/dtheta4`.
    pub g: R,
}

impl<R: Ring> SpatialFourBar<R> {
    /// Evaluates the spherical closure equation over the dual numbers.
    pub fn pair(&self) -> SpatialPair<R> {
        let dual = |angle: &CosSin<R>, d: &R| Dual::angle(angle.0.clone(), angle.1.clone(), d);
        let twists = std::array::from_fn(|k| dual(&self.twists[k], &self.lengths[k]));
        let first = dual(&self.first, &self.first_offset);
        let fourth = dual(&self.fourth, &self.fourth_offset);
        let Dual { value, epsilon } = spherical_four_bar(&twists, &first, &fourth);
        SpatialPair { f: value, g: epsilon }
    }
}

/// The variables of the general loop of four joints.
///
/// A polynomial in half-angle tangents has the tangent in the place of the cosine.
pub struct Variables;

impl Variables {
    /// The names in cosines and sines, by variable.
    pub const TRIGONOMETRIC: [&'static str; 20] = [
        "c_alpha1", "c_alpha2", "c_alpha3", "c_alpha4", "a1", "a2", "a3", "a4", "d1", "d2", "d3", "d4", "c_theta1",
        "c_theta4", "s_alpha1", "s_alpha2", "s_alpha3", "s_alpha4", "s_theta1", "s_theta4",
    ];

    /// The names in half-angle tangents: `t_k = tan(alpha_k/2)`, `x = tan(theta1/2)`, `y = tan(theta4/2)`.
    pub const TANGENTS: [&'static str; 14] =
        ["t1", "t2", "t3", "t4", "a1", "a2", "a3", "a4", "d1", "d2", "d3", "d4", "x", "y"];

    /// The tangent of half the angle of joint 1.
    pub const X: usize = 12;

    /// The tangent of half the angle of joint 4.
    pub const Y: usize = 13;

    /// Returns the tangent of half the twist of link k, counted from 0.
    #[must_use]
    pub const fn twist(k: usize) -> usize {
        k
    }

    /// Returns the length of link k, counted from 0.
    #[must_use]
    pub const fn length(k: usize) -> usize {
        4 + k
    }

    /// Returns the offset of joint k, counted from 0.
    #[must_use]
    pub const fn offset(k: usize) -> usize {
        8 + k
    }

    /// Returns the six angles: the twists, then the angles of joints 1 and 4.
    #[must_use]
    pub const fn angle(k: usize) -> Pair {
        Pair { cos: if k < 4 { k } else { 8 + k }, sin: 14 + k }
    }
}

/// Returns the closure equations of the general loop of four joints: f and g with every twist, length, offset and angle a symbol.
#[must_use]
pub fn general_pair() -> SpatialPair<Trigonometric<Int>> {
    type Symbol = Trigonometric<Int>;
    let angle = |k: usize| (Symbol::cos(Variables::angle(k)), Symbol::sin(Variables::angle(k)));
    let symbol = |variable: usize| Symbol::new(&Polynomial::variable(variable), &[]);
    let loop_of_four = SpatialFourBar {
        twists: std::array::from_fn(angle),
        lengths: std::array::from_fn(|k| symbol(Variables::length(k))),
        first: angle(4),
        first_offset: symbol(Variables::offset(0)),
        fourth: angle(5),
        fourth_offset: symbol(Variables::offset(3)),
    };
    loop_of_four.pair()
}

/// Returns both equations in half-angle tangents, times `1 + t^2` of all six angles, so that they are of degree 2 in every tangent.
///
/// # Panics
/// Never: f and g are linear in cosine and sine of every angle.
#[must_use]
pub fn half_angle_pair(pair: &SpatialPair<Trigonometric<Int>>) -> SpatialPair<Polynomial<Int>> {
    let angles: Vec<(Pair, usize)> = (0..6).map(|k| (Variables::angle(k), Variables::angle(k).cos)).collect();
    let form = |equation: &Trigonometric<Int>| {
        let form = half_tangents(equation.polynomial(), &angles);
        assert!(form.powers.iter().all(|&power| power == 1), "f and g are linear in cosine and sine of every angle");
        form.polynomial
    };
    SpatialPair { f: form(&pair.f), g: form(&pair.g) }
}

/// A loop of four joints before and after the step from the sphere into space.
#[derive(Clone, Debug)]
pub struct Transfer {
    /// The name of the loop.
    pub title: String,
    /// The names of all variables.
    pub names: Names,
    /// The spherical equation.
    pub f: Polynomial<Rational>,
    /// The coefficient of eps.
    pub g: Polynomial<Rational>,
    /// The offsets that g gives, each as a name, numerator and denominator.
    pub offsets: Vec<(String, Polynomial<Rational>, Polynomial<Rational>)>,
    /// The meaning of these equations, a sentence each.
    pub steps: Vec<String>,
}

/// The names of loops on a command line.
pub const NAMED: [&str; 4] = ["rccc", "ccrr", "4r", "hooke"];

impl Transfer {
    fn new(title: &str, names: Names, f: Polynomial<Rational>, g: Polynomial<Rational>, free: &[usize]) -> Self {
        let given = |&variable: &usize| {
            let slope = g.derivative(variable);
            let rest = g.substitute(variable, &Polynomial::zero());
            (!slope.is_zero()).then(|| (names.list()[variable].clone(), rest.neg(), slope))
        };
        let offsets = free.iter().filter_map(given).collect();
        let steps = vec![
            "The axes of joints 2 and 3 include the twist of link 2: z2.z3 = cos(alpha2), with z2 seen along link 1 and z3 along links 4 \
             and 3, is the closure equation f of the spherical loop."
                .to_owned(),
            "The same equation over dual numbers, every twist alpha_k + eps a_k and every joint angle theta_k + eps d_k, is f + eps g: the \
             spatial loop closes where f = 0 and g = 0."
                .to_owned(),
        ];
        Self { title: title.to_owned(), names, f, g, offsets, steps }
    }

    /// Returns a loop by its name, with every parameter a symbol; `None` for another name.
    ///
    /// # Errors
    /// Never for the names in `NAMED`.
    pub fn named(name: &str) -> Result<Option<Self>> {
        let general = general_pair();
        let rational = |p: &Trigonometric<Int>| {
            p.polynomial().map(|c| Some(Rational::from(c.to_integer()))).unwrap_or_else(Polynomial::zero)
        };
        let (f, g) = (rational(&general.f), rational(&general.g));
        let names = Names::given(Variables::TRIGONOMETRIC)?;
        let fourth = Variables::offset(3);
        let (title, free, last): (&str, &[usize], &str) = match name {
            "rccc" => (
                "RCCC: the spherical four-bar in space",
                &[fourth],
                "With theta1 and d1 given, f is a quadratic equation in tan(theta4/2), and g, linear in d4, gives that offset.",
            ),
            "ccrr" => (
                "CCRR with both offsets given",
                &[],
                "With d1 and d4 given, f and g are two equations of degree 2 in each of tan(theta1/2), tan(theta4/2): eliminating one of \
                 these leaves degree 8.",
            ),
            "4r" => (
                "4R",
                &[],
                "With all offsets constant, f and g are two equations in two angles: in general no motion. `looproot conditions 4R` derives \
                 when g vanishes on a component of f.",
            ),
            "hooke" => {
                let mut right = Vec::new();
                for k in 0..3 {
                    right.push((Variables::angle(k).cos, Polynomial::zero()));
                    right.push((Variables::angle(k).sin, Polynomial::one()));
                }
                let (f, g) = (f.substitute_all(&right), g.substitute_all(&right));
                let mut transfer = Self::new("Hooke's joint, and the joint of skew axes", names, f, g, &[fourth]);
                transfer.steps.push(
                    "With right twists of links 1, 2 and 3 and the angle alpha4 between the shafts, f = 0 is tan(theta1) tan(theta4) = \
                     cos(alpha4): Hooke's joint. With alpha4 + eps a4 the shafts are skew at the distance a4, and g gives the offset of \
                     joint 4."
                        .to_owned(),
                );
                return Ok(Some(transfer));
            }
            _ => return Ok(None),
        };
        let mut transfer = Self::new(title, names, f, g, free);
        transfer.steps.push(last.to_owned());
        Ok(Some(transfer))
    }

    /// Returns the loop of a file: four joints of type R or C.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for other loops.
    pub fn of(title: &str, chain: &Chain) -> Result<Self> {
        type Symbol = Trigonometric<Rational>;
        let unsupported = || {
            let what = "transference of a loop other than four R or C joints in the convention \"dh\"";
            Error::Unsupported(what.to_owned())
        };
        let Geometry::Dh(joints) = &chain.geometry else { return Err(unsupported()) };
        let [first, second, third, fourth] = joints.as_slice() else { return Err(unsupported()) };
        if !joints.iter().all(|joint| matches!(joint.kind, JointKind::Revolute | JointKind::Cylindrical)) {
            return Err(unsupported());
        }
        let number = |q: Rational| Symbol::new(&Polynomial::constant(q), &[]);
        let constant = |angle: &Angle| {
            let (cos, sin) = exact_cos_sin(angle);
            (number(cos), number(sin))
        };
        // Joint variables: cosine, sine and offset of joint 1, then of joint 4.
        let angle = |at: usize, joint: &Joint| {
            let pair = Pair { cos: at, sin: at + 1 };
            let ((cos, sin), (c0, s0)) = ((Symbol::cos(pair), Symbol::sin(pair)), constant(&joint.theta0));
            (cos.mul(&c0).sub(&sin.mul(&s0)), sin.mul(&c0).add(&cos.mul(&s0)))
        };
        let offset = |at: usize, joint: &Joint| {
            let fixed = number(joint.d.rational().clone());
            let is_free = joint.kind == JointKind::Cylindrical;
            if is_free { fixed.add(&Symbol::new(&Polynomial::variable(at + 2), &[])) } else { fixed }
        };
        let links = [first, second, third, fourth];
        let loop_of_four = SpatialFourBar {
            twists: links.map(|joint| constant(&joint.alpha)),
            lengths: links.map(|joint| number(joint.a.rational().clone())),
            first: angle(0, first),
            first_offset: offset(0, first),
            fourth: angle(3, fourth),
            fourth_offset: offset(3, fourth),
        };
        let SpatialPair { f, g } = loop_of_four.pair();
        let names = Names::given(["c1", "s1", "d1", "c4", "s4", "d4"])?;
        Ok(Self::new(title, names, f.polynomial().clone(), g.polynomial().clone(), &[2, 5]))
    }
}
