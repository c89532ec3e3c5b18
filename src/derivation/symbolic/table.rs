//! The parameters of a loop as symbols.

use crate::algebra::number::{Angle, HalfTangent, Number};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Ring, exact_cos_sin};
use crate::algebra::trigonometric::{Pair, Trigonometric};
use crate::catalogue::entry::{Case, Input, InputValue};
use crate::error::{Error, Result};
use crate::kinematics::chain::{Chain, Geometry, Joint};
use crate::kinematics::closed_loop::{Parameter, Parameters};
use crate::kinematics::joint::DhConstant;
use crate::kinematics::motion::Motion;
use rug::Rational;

/// The ring of derivations with symbols: polynomials in lengths, cosines and sines.
pub(super) type Symbol = Trigonometric<Rational>;

/// The value of a parameter in the file.
#[derive(Clone, Debug)]
pub(super) enum Value {
    Angle(Angle),
    Length(Number),
}

/// A symbolic parameter; an angle has two variables, cosine and sine.
#[derive(Clone, Debug)]
pub(super) struct Kept {
    /// Joint, counted from 0, and parameter; `None` for the input.
    pub place: Option<(usize, Parameter)>,
    pub name: String,
    pub variable: usize,
    pub value: Value,
}

/// All parameters of a case.
pub(super) struct Table<'c> {
    case: &'c Case,
    pub symbols: Vec<Kept>,
    /// The other parameters, as `alpha3 = pi/2`, except offsets of variables that are 0.
    pub numbers: Vec<String>,
    /// The names of the variables; the first one belongs to `first`.
    pub names: Vec<String>,
}

/// Returns whether an angle is a multiple of a right angle: cosine and sine are 0, 1 or -1.
fn is_right(angle: &Angle) -> bool {
    match angle.half_tangent() {
        HalfTangent::Infinite => true,
        HalfTangent::Finite(t) => t.is_zero() || *t == 1 || *t == -1,
    }
}

/// Returns a parameter's value for a reader.
pub(super) fn shown(value: &Value) -> String {
    match value {
        Value::Length(length) => length.rational().to_string(),
        Value::Angle(angle) => match angle.half_tangent() {
            HalfTangent::Infinite => "pi".to_owned(),
            HalfTangent::Finite(t) if t.is_zero() => "0".to_owned(),
            HalfTangent::Finite(t) if *t == 1 => "pi/2".to_owned(),
            HalfTangent::Finite(t) if *t == -1 => "-pi/2".to_owned(),
            HalfTangent::Finite(t) => format!("2 atan({t})"),
        },
    }
}

impl<'c> Table<'c> {
    /// Returns the parameters of a chain given by DH parameters: those `wanted`, else all but zeros and right angles, and the
    /// input. Their variables are numbered from `first`.
    pub fn of(chain: &Chain, case: &'c Case, wanted: &[String], first: usize, with_input: bool) -> Result<Self> {
        let (Geometry::Dh(joints) | Geometry::ModifiedDh(joints)) = &chain.geometry else {
            let message = "symbols for all parameters of screw axes: the coordinates of a unit vector are not independent; name up to three \
                           coordinates of points of the axes (--symbolic=point2.x), or give the loop by DH parameters (convention = \
                           \"dh\"), whose twists, lengths and offsets can be kept";
            return Err(Error::Unsupported(message.to_owned()));
        };
        let mut table = Self { case, symbols: Vec::new(), numbers: Vec::new(), names: Vec::new() };
        let mut known = Vec::new();
        let mut next = first;
        for (place, name, letters, value) in all(joints, case.input.first().filter(|_| with_input)) {
            let special = match &value {
                Value::Angle(angle) => place.is_some() && is_right(angle),
                Value::Length(length) => place.is_some() && length.rational().is_zero(),
            };
            let zero = shown(&value) == "0";
            let symbol = if wanted.is_empty() { !special } else { wanted.contains(&name) };
            known.push(name.clone());
            if symbol {
                let count = letters.len();
                table.names.extend(letters);
                table.symbols.push(Kept { place, name, variable: next, value });
                next += count;
            } else if !(zero && (matches!(place, Some((_, Parameter::Angle))) || name.starts_with("d0"))) {
                table.numbers.push(format!("{name} = {}", shown(&value)));
            }
        }
        if let Some(unknown) = wanted.iter().find(|name| !known.contains(name)) {
            let message = format!("found the symbol {unknown}, expected some of {}", known.join(", "));
            return Err(Error::Invalid(message));
        }
        Ok(table)
    }

    fn find(&self, place: Option<(usize, Parameter)>) -> Option<&Kept> {
        self.symbols.iter().find(|symbol| symbol.place == place)
    }

    fn angle_at(&self, place: Option<(usize, Parameter)>, value: &Angle) -> Option<(Symbol, Symbol)> {
        match self.find(place) {
            Some(symbol) => {
                let pair = Pair { cos: symbol.variable, sin: symbol.variable + 1 };
                Some((Trigonometric::cos(pair), Trigonometric::sin(pair)))
            }
            None => Symbol::cos_sin(value),
        }
    }

    fn length_at(&self, place: Option<(usize, Parameter)>, value: &Number) -> Option<Symbol> {
        match self.find(place) {
            Some(symbol) => Some(Trigonometric::new(&Polynomial::variable(symbol.variable), &[])),
            None => Symbol::from_number(value),
        }
    }

    /// Returns the closing transformation: the input, or the inverse of a pose; the identity if neither is given.
    pub fn closing(&self) -> Result<Motion<Symbol>> {
        if let Some(pose) = &self.case.pose {
            let image = pose.exact.inverse().map(Symbol::from_rational);
            return image.ok_or_else(|| Error::Invalid("the pose has no image".to_owned()));
        }
        let Some(input) = self.case.input.first() else { return Ok(Motion::identity()) };
        let motion = match &input.value {
            InputValue::Angle(angle) => self.angle_at(None, angle).map(|(cos, sin)| Motion::rotation_z(cos, sin)),
            InputValue::Distance(distance) => self.length_at(None, distance).map(Motion::translation_z),
        };
        motion.ok_or_else(|| Error::Invalid("the input has no image".to_owned()))
    }

    /// Returns every variable with its value in the file.
    pub fn values(&self) -> Vec<(usize, Rational)> {
        let value = |symbol: &Kept| match &symbol.value {
            Value::Length(length) => vec![(symbol.variable, length.rational().clone())],
            Value::Angle(angle) => {
                let (cos, sin) = exact_cos_sin(angle);
                vec![(symbol.variable, cos), (symbol.variable + 1, sin)]
            }
        };
        self.symbols.iter().flat_map(value).collect()
    }
}

/// A parameter in order: its position, its name, the names of its variables, its value.
pub(super) type Entry = (Option<(usize, Parameter)>, String, Vec<String>, Value);

/// Returns every parameter of a loop: link by link, then the input.
pub(super) fn all(joints: &[Joint], input: Option<&Input>) -> Vec<Entry> {
    let mut list: Vec<Entry> = Vec::new();
    for (at, joint) in joints.iter().enumerate() {
        let n = at + 1;
        let mut angle = |parameter, name: String, letters: [String; 2], value: &Angle| {
            list.push((Some((at, parameter)), name, letters.to_vec(), Value::Angle(value.clone())));
        };
        angle(Parameter::Twist, format!("alpha{n}"), [format!("ca{n}"), format!("sa{n}")], &joint.alpha);
        let offset = |constant| if constant == DhConstant::Offset { "0_" } else { "" };
        if joint.kind.row().theta != DhConstant::Absent {
            let n = format!("{}{n}", offset(joint.kind.row().theta));
            angle(Parameter::Angle, format!("theta{n}"), [format!("c{n}"), format!("s{n}")], &joint.theta0);
        }
        let mut length = |parameter, name: String, value: &Number| {
            list.push((Some((at, parameter)), name.clone(), vec![name], Value::Length(value.clone())));
        };
        length(Parameter::Length, format!("a{n}"), &joint.a);
        length(Parameter::Offset, format!("d{}{n}", offset(joint.kind.row().d)), &joint.d);
    }
    if let Some(input) = input {
        let n = input.joint;
        match &input.value {
            InputValue::Angle(angle) => {
                let letters = vec![format!("c{n}"), format!("s{n}")];
                list.push((None, format!("theta{n}"), letters, Value::Angle(angle.clone())));
            }
            InputValue::Distance(distance) => {
                let name = format!("d{n}");
                list.push((None, name.clone(), vec![name], Value::Length(distance.clone())));
            }
        }
    }
    list
}

impl Parameters<Symbol> for Table<'_> {
    fn angle(&self, joint: usize, parameter: Parameter, value: &Angle) -> Option<(Symbol, Symbol)> {
        self.angle_at(Some((joint, parameter)), value)
    }
    fn length(&self, joint: usize, parameter: Parameter, value: &Number) -> Option<Symbol> {
        self.length_at(Some((joint, parameter)), value)
    }
}
