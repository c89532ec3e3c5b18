//! `looproot motion`

use super::arguments::MotionOptions;
use super::exit::{Exit, Fault};
use super::output::Output;
use looproot::internal::error::{Error, Result};
use looproot::internal::kinematics::dual_quaternion::Quaternion;
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::report::calculus::document;
use looproot::internal::report::rotation::{Asked, json, text};
use looproot_algebra::number::{Angle, Number, Quantity, Reading};
use looproot_calculus::rotation::cayley_klein::CayleyKlein;
use looproot_calculus::rotation::euler::Order;
use looproot_calculus::rotation::matrix::{Matrix, matrix, nearest};
use looproot_calculus::rotation::turn::Turn;
use looproot_calculus::rotation::vectors::{from_axis_angle, from_euler_vector, from_rodrigues, from_wiener};

/// A matrix farther from a rotation than this is refused.
const REFUSED: f64 = 1e-4;
/// A matrix farther from a rotation than this, beyond rounding, causes a warning.
const NOTED: f64 = 1e-12;

/// The values of `--from`.
const KINDS: [&str; 10] =
    ["matrix", "quaternion", "euler", "bryan", "axis", "euler-vector", "rodrigues", "wiener", "cayley-klein", "motion"];

/// Prints every parametrisation.
pub fn run(options: &MotionOptions) -> std::result::Result<Exit, Fault> {
    let asked = read(options)?;
    let written = if options.json { document(&json(&asked)) } else { text(&asked) };
    Output::write(&options.output, "", &written)?;
    Ok(Exit::Complete)
}

/// Reads the motion that was typed.
fn read(options: &MotionOptions) -> Result<Asked> {
    let order = Order::parse(&options.axes).ok_or_else(|| {
        let found = options.axes.chars().take(40).collect::<String>();
        Error::Invalid(format!(
            "found the axes `{found}`, expected three of x, y, z, neighbours different, such as zxz"
        ))
    })?;
    let typed =
        Typed { parts: options.numbers.split(';').map(|part| part.split(',').map(str::trim).collect()).collect() };
    let mut warnings = Vec::new();
    let still = [0.0; 3];
    let (rotation, translation) = match options.from.as_str() {
        "matrix" => (rotation_of(&rows(&typed.numbers::<9>("nine numbers")?), &mut warnings)?, still),
        "quaternion" => (of_quaternion(typed.numbers::<4>("four numbers w, x, y, z")?)?, still),
        "euler" => (order.matrix(&typed.angles()?), still),
        "bryan" => (Order::BRYAN.matrix(&typed.angles()?), still),
        "axis" => (typed.axis()?, still),
        "euler-vector" => (of_hub(from_euler_vector(&typed.numbers::<3>("three numbers")?))?, still),
        "rodrigues" => (of_hub(Some(from_rodrigues(&typed.numbers::<3>("three numbers")?)))?, still),
        "wiener" => (of_hub(Some(from_wiener(&typed.numbers::<3>("three numbers")?)))?, still),
        "cayley-klein" => {
            let [a, b, c, d] = typed.numbers::<4>("four numbers: alpha and beta, each by real and imaginary part")?;
            (of_hub(Some(CayleyKlein { alpha: [a, b], beta: [c, d] }.quaternion()))?, still)
        }
        "motion" => typed.motion(&mut warnings)?,
        other => {
            let found: String = other.chars().take(40).collect();
            return Err(Error::Invalid(format!("found `--from {found}`, expected one of {}", KINDS.join(", "))));
        }
    };
    let parameters =
        (options.from == "quaternion").then(|| typed.numbers::<4>("four numbers w, x, y, z")).transpose()?;
    let rates = options.rates.as_deref().map(|rates| {
        let typed = Typed { parts: vec![rates.split(',').map(str::trim).collect()] };
        typed.numbers::<3>("three numbers for --rates")
    });
    Ok(Asked {
        from: options.from.clone(),
        motion: Motion { rotation, translation },
        is_motion: options.from == "motion",
        order,
        dual: options.dual,
        typed: parameters.map(|[scalar, x, y, z]| Quaternion { scalar, vector: [x, y, z] }),
        rates: rates.transpose()?,
        warnings,
    })
}

/// The numbers of the command line, in parts.
struct Typed<'a> {
    parts: Vec<Vec<&'a str>>,
}

impl Typed<'_> {
    fn wrong(&self, expected: &str) -> Error {
        let counts: Vec<String> = self.parts.iter().map(|part| part.len().to_string()).collect();
        let what = if self.parts.len() == 1 { "numbers" } else { "numbers in the parts" };
        Error::Invalid(format!("found {} {what}, expected {expected}", counts.join(" and ")))
    }

    /// Returns exactly `N` numbers, of any parts.
    fn numbers<const N: usize>(&self, expected: &str) -> Result<[f64; N]> {
        let all: Vec<&str> = self.parts.iter().flatten().copied().collect();
        let all: [&str; N] = all.try_into().map_err(|_| self.wrong(expected))?;
        let mut numbers = [0.0; N];
        for (number, text) in numbers.iter_mut().zip(all) {
            *number = self::number(text)?;
        }
        Ok(numbers)
    }

    fn angles(&self) -> Result<[Turn<f64>; 3]> {
        let expected = "three angles a, b, c";
        let all: Vec<&str> = self.parts.iter().flatten().copied().collect();
        let [a, b, c]: [&str; 3] = all.try_into().map_err(|_| self.wrong(expected))?;
        Ok([turn(a)?, turn(b)?, turn(c)?])
    }

    /// Reads an axis of any length and an angle.
    fn axis(&self) -> Result<Matrix<f64>> {
        let expected = "x, y, z; angle";
        let [axis, angle] = self.parts.as_slice() else { return Err(self.wrong(expected)) };
        let ([x, y, z], [angle]) = (axis.as_slice(), angle.as_slice()) else { return Err(self.wrong(expected)) };
        let axis = [number(x)?, number(y)?, number(z)?];
        let half = Angle::parse(angle, &Reading::default())?.radians();
        let q = from_axis_angle(&axis, &half)
            .ok_or_else(|| Error::Invalid("found the zero vector as an axis, expected a direction".to_owned()))?;
        of_hub(Some(q))
    }

    /// Reads sixteen numbers by rows, or a position and a quaternion.
    fn motion(&self, warnings: &mut Vec<String>) -> Result<(Matrix<f64>, [f64; 3])> {
        let expected = "sixteen by rows, or x, y, z; w, x, y, z";
        if let [position, quaternion] = self.parts.as_slice()
            && let ([x, y, z], [a, b, c, d]) = (position.as_slice(), quaternion.as_slice())
        {
            let rotation = of_quaternion([number(a)?, number(b)?, number(c)?, number(d)?])?;
            return Ok((rotation, [length(x)?, length(y)?, length(z)?]));
        }
        let all = self.numbers::<16>(expected)?;
        if all[12..] != [0.0, 0.0, 0.0, 1.0] {
            let [.., a, b, c, d] = all;
            return Err(Error::Invalid(format!("found the last row [{a}, {b}, {c}, {d}], expected [0, 0, 0, 1]")));
        }
        let given = std::array::from_fn(|i| std::array::from_fn(|j| all[4 * i + j]));
        Ok((rotation_of(&given, warnings)?, [all[3], all[7], all[11]]))
    }
}

fn number(text: &str) -> Result<f64> {
    Ok(Number::parse(text, Quantity::Ratio, &Reading::default())?.to_f64())
}

fn length(text: &str) -> Result<f64> {
    Ok(Number::parse(text, Quantity::Length, &Reading::default())?.to_f64())
}

fn turn(text: &str) -> Result<Turn<f64>> {
    let (cos, sin) = Angle::parse(text, &Reading::default())?.cos_sin_f64();
    Ok(Turn { cos, sin })
}

fn rows(all: &[f64; 9]) -> Matrix<f64> {
    std::array::from_fn(|i| std::array::from_fn(|j| all[3 * i + j]))
}

fn of_quaternion([scalar, x, y, z]: [f64; 4]) -> Result<Matrix<f64>> {
    of_hub(Some(Quaternion { scalar, vector: [x, y, z] }))
}

/// Returns the matrix of a quaternion of nonzero norm.
fn of_hub(q: Option<Quaternion<f64>>) -> Result<Matrix<f64>> {
    let found = q.and_then(|q| matrix(&q)).filter(|rows| rows.iter().flatten().all(|x| x.is_finite()));
    found.ok_or_else(|| Error::Invalid("found numbers of norm 0, expected those of a rotation".to_owned()))
}

/// Returns the rotation nearest to a matrix, which is refused if it is far from one.
fn rotation_of(given: &Matrix<f64>, warnings: &mut Vec<String>) -> Result<Matrix<f64>> {
    let Some((rotation, defect)) = nearest(given) else {
        return Err(Error::Invalid("found a matrix that is not finite, expected a rotation".to_owned()));
    };
    if !(defect <= REFUSED) {
        let message = format!("found a matrix that is {defect:.1e} off a rotation, expected one within {REFUSED:e}");
        return Err(Error::Invalid(message));
    }
    if defect > NOTED {
        warnings.push(format!("the matrix is {defect:.1e} off a rotation: the nearest one is taken"));
        return Ok(rotation);
    }
    Ok(*given)
}
