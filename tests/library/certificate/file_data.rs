//! Certified radii against the data of files: arms and loops with rational, decimal and irrational numbers, tiny twists,
//! lengths of 1e-6 to 1e6, and axes up to 1e10 away, read from their text, and judged by Newton's method in 700 bits from
//! the same data.

use super::wide::{BITS, Matrix, Step, Wide, about, along, distance, float, identity, inverse, real, solution};
use looproot::internal::assembly::{Assembly, Roots, Workspace};
use looproot::internal::catalogue::{Format, Options, load_text};
use looproot::internal::mechanism::Mechanism;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::{Float, float::Constant};

/// A number of a file: its text and its value.
#[derive(Clone)]
struct Datum {
    text: String,
    value: Float,
}

impl Datum {
    fn integer(n: i64) -> Self {
        Self { text: n.to_string(), value: Float::with_val(BITS, n) }
    }
    /// `self + other 10^power`
    fn plus(&self, other: i64, power: i32) -> Self {
        let scale = Float::with_val(BITS, 10).pow_signed(power);
        let value = Float::with_val(BITS, &self.value + Float::with_val(BITS, scale * other));
        Self { text: format!("({}) + ({other})*1e{power}", self.text), value }
    }
    fn quoted(&self) -> String {
        format!("\"{}\"", self.text)
    }
}

trait SignedPower {
    fn pow_signed(self, power: i32) -> Float;
}

impl SignedPower for Float {
    fn pow_signed(self, power: i32) -> Float {
        let size = Float::with_val(BITS, rug::ops::Pow::pow(&self, power.unsigned_abs()));
        if power < 0 { 1 / size } else { size }
    }
}

/// The source of random mechanisms.
struct Draw {
    random: ChaCha8Rng,
    /// Lengths are multiples of this power of ten.
    scale: i32,
    /// The distance of the axes from the origin, in parts of that.
    shift: [i64; 3],
}

impl Draw {
    fn ratio(&mut self) -> (i64, i64) {
        let n = self.random.random_range(1..=9);
        (if self.random.random_bool(0.5) { n } else { -n }, self.random.random_range(1..=7))
    }

    /// A number of the size of 1: rational, decimal, or the root of one.
    fn number(&mut self) -> Datum {
        let (n, d) = self.ratio();
        match self.random.random_range(0..4) {
            0 => Datum { text: format!("{n}/{d}"), value: Float::with_val(BITS, n) / d },
            1 => {
                let digits: i64 = self.random.random_range(-3_000_000..3_000_000);
                let value = Float::with_val(BITS, digits) / 1_000_000;
                Datum { text: format!("{digits}/1000000"), value }
            }
            2 => Datum { text: "0".to_owned(), value: float(0.0) },
            _ => {
                let m = [2, 3, 5, 7][self.random.random_range(0..4)];
                Datum { text: format!("{n}*sqrt({m})/{d}"), value: Float::with_val(BITS, m).sqrt() * n / d }
            }
        }
    }

    fn length(&mut self) -> Datum {
        let scale = Float::with_val(BITS, 10).pow_signed(self.scale);
        let Datum { text, value } = self.number();
        Datum { text: format!("({text})*1e{}", self.scale), value: value * scale }
    }

    fn shifted(&mut self, axis: usize) -> Datum {
        self.length().plus(self.shift[axis], self.scale)
    }

    /// An angle in radians, as a file writes it.
    fn angle(&mut self) -> Datum {
        let pi = Float::with_val(BITS, Constant::Pi);
        match self.random.random_range(0..6) {
            0 => {
                let degrees = self.random.random_range(-17..=17) * 10;
                Datum { text: format!("{degrees} deg"), value: pi * degrees / 180 }
            }
            1 => Datum { text: "pi/2".to_owned(), value: pi / 2 },
            2 => {
                let power = self.random.random_range(-17..=-6);
                Datum { text: format!("1e{power}"), value: Float::with_val(BITS, 10).pow_signed(power) }
            }
            3 => {
                let (n, d) = self.ratio();
                Datum { text: format!("2*atan({n}/{d})"), value: (Float::with_val(BITS, n) / d).atan() * 2 }
            }
            _ => {
                let digits: i64 = self.random.random_range(-3_000_000..3_000_000);
                Datum { text: format!("{digits}/1000000"), value: Float::with_val(BITS, digits) / 1_000_000 }
            }
        }
    }

    /// A rotation: of a quaternion of integers, of an irrational angle about a coordinate axis, or of that quaternion in 12
    /// decimals, for which the nearest rotation is meant.
    fn rotation(&mut self) -> ([[String; 3]; 3], Matrix) {
        let mut text: [[String; 3]; 3] = std::array::from_fn(|_| std::array::from_fn(|_| String::new()));
        let mut m = identity();
        let way = self.random.random_range(0..3);
        if way == 0 {
            let degrees = self.random.random_range(1..180);
            let axis = self.random.random_range(0..3);
            let angle = Float::with_val(BITS, Constant::Pi) * degrees / 180;
            m = about(axis, real(&angle).cos_sin());
            for (i, row) in text.iter_mut().enumerate() {
                for (j, entry) in row.iter_mut().enumerate() {
                    *entry = if i == axis || j == axis {
                        u8::from(i == j).to_string()
                    } else if i == j {
                        format!("cos({degrees} deg)")
                    } else {
                        format!("{}sin({degrees} deg)", if j == (axis + 1) % 3 { "" } else { "-" })
                    };
                }
            }
            return (text, m);
        }
        let q: [i64; 4] = std::array::from_fn(|_| self.random.random_range(1..=6));
        let [w, x, y, z] = q;
        let norm = w * w + x * x + y * y + z * z;
        let rows = [
            [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
        ];
        for i in 0..3 {
            for j in 0..3 {
                if way == 1 {
                    text[i][j] = format!("{}/{norm}", rows[i][j]);
                    m[i][j] = real(&(Float::with_val(BITS, rows[i][j]) / norm));
                } else {
                    #[expect(clippy::cast_possible_truncation, reason = "12 decimals")]
                    let digits = (rows[i][j] as f64 / norm as f64 * 1e12).round() as i64;
                    text[i][j] = format!("{digits}/1000000000000");
                    m[i][j] = real(&(Float::with_val(BITS, digits) / 1_000_000_000_000_i64));
                }
            }
        }
        if way == 2 {
            m = polar(m);
        }
        (text, m)
    }

    /// A motion and its text.
    fn motion(&mut self) -> (String, Matrix) {
        let (text, mut m) = self.rotation();
        let places: [Datum; 3] = std::array::from_fn(|axis| self.shifted(axis));
        for i in 0..3 {
            m[i][3] = real(&places[i].value);
        }
        let row = |i: usize| {
            let [a, b, c] = &text[i];
            format!("[\"{a}\", \"{b}\", \"{c}\", {}]", places[i].quoted())
        };
        (format!("[{}, {}, {}, [0, 0, 0, 1]]", row(0), row(1), row(2)), m)
    }
}

/// The nearest rotation, by the mean of a matrix and its inverse transpose.
fn polar(mut m: Matrix) -> Matrix {
    for _ in 0..12 {
        let minor = |i: usize, j: usize| {
            let (a, b, c, d) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
            m[a][c].times(&m[b][d]).minus(&m[a][d].times(&m[b][c]))
        };
        let determinant = (0..3).fold(Wide::of(0.0, 0.0), |sum, j| sum.plus(&m[0][j].times(&minor(0, j))));
        let mut next = identity();
        for i in 0..3 {
            for j in 0..3 {
                next[i][j] = m[i][j].plus(&minor(i, j).over(&determinant)).times(&Wide::of(0.5, 0.0));
            }
        }
        m = next;
    }
    m
}

/// A mechanism file, the chain it describes, closed, and which of its variables is given.
struct Drawn {
    text: String,
    steps: Vec<Step>,
    is_angle: Vec<bool>,
    given: Option<(usize, Float)>,
}

/// The frame whose z axis is this one, its origin this point.
fn frame(axis: &[Datum; 3], point: &[Datum; 3]) -> Matrix {
    let v = axis.each_ref().map(|x| x.value.clone());
    let dot =
        |a: &[Float; 3], b: &[Float; 3]| (0..3).fold(float(0.0), |sum, k| sum + Float::with_val(BITS, &a[k] * &b[k]));
    let unit = |v: [Float; 3]| {
        let length = dot(&v, &v).sqrt();
        v.map(|x| x / &length)
    };
    let z = unit(v);
    // Any direction across it: no angle is counted from there.
    let least = (0..3).min_by(|&a, &b| z[a].clone().abs().total_cmp(&z[b].clone().abs())).unwrap();
    let x = unit(std::array::from_fn(|i| {
        Float::with_val(BITS, f64::from(u8::from(i == least))) - Float::with_val(BITS, &z[least] * &z[i])
    }));
    let cross = |i: usize, j: usize| Float::with_val(BITS, &z[i] * &x[j]) - Float::with_val(BITS, &z[j] * &x[i]);
    let y = [cross(1, 2), cross(2, 0), cross(0, 1)];
    let mut m = identity();
    for i in 0..3 {
        m[i] = [real(&x[i]), real(&y[i]), real(&z[i]), real(&point[i].value)];
    }
    m
}

fn drawn(draw: &mut Draw, is_loop: bool) -> Drawn {
    let count = if is_loop { 7 } else { 6 };
    let (mut steps, mut is_angle, mut joints) = (Vec::new(), Vec::new(), Vec::new());
    let is_screws = draw.random.random_bool(0.5);
    let sliders = draw.random.random_range(0..4_usize).saturating_sub(1);
    let slides: Vec<bool> = (0..count).map(|k| k >= 2 && k < 2 + sliders).collect();
    let variable = |slides: bool| if slides { Step::Distance } else { Step::Angle };
    for &slide in &slides {
        let kind = if slide { "P" } else { "R" };
        is_angle.push(!slide);
        if is_screws {
            let mut axis: [Datum; 3] = std::array::from_fn(|_| draw.number());
            match draw.random.random_range(0..4) {
                0 => axis = [Datum::integer(0), Datum::integer(0), Datum::integer(1)],
                1 => {
                    let tiny = draw.random.random_range(-17..=-6);
                    axis = [Datum::integer(0).plus(1, tiny), Datum::integer(0), Datum::integer(-1)];
                }
                _ => axis[2] = Datum::integer(2),
            }
            let point: [Datum; 3] = std::array::from_fn(|k| draw.shifted(k));
            let list = |v: &[Datum; 3]| v.each_ref().map(Datum::quoted).join(", ");
            joints.push(format!("{{\"type\":\"{kind}\",\"axis\":[{}],\"point\":[{}]}}", list(&axis), list(&point)));
            let frame = frame(&axis, &point);
            let back = inverse(&frame);
            steps.extend([Step::constant(frame), variable(slide), Step::constant(back)]);
        } else {
            let (a, d, alpha, theta0) = (draw.length(), draw.length(), draw.angle(), draw.angle());
            let offsets = if slide { ["d0", "theta"] } else { ["d", "theta0"] };
            let constants = [("a", &a), ("alpha", &alpha), (offsets[0], &d), (offsets[1], &theta0)];
            let constants = constants.map(|(key, datum)| format!("\"{key}\":{}", datum.quoted())).join(",");
            joints.push(format!("{{\"type\":\"{kind}\",{constants}}}"));
            steps.extend([
                variable(slide),
                Step::constant(about(2, real(&theta0.value).cos_sin())),
                Step::constant(along(2, &real(&d.value))),
                Step::constant(along(0, &real(&a.value))),
                Step::constant(about(0, real(&alpha.value).cos_sin())),
            ]);
        }
    }
    let convention = if is_screws { "screws" } else { "dh" };
    let mut parts = vec![format!("\"convention\":\"{convention}\",\"joints\":[{}]", joints.join(","))];
    if is_screws {
        let (text, home) = draw.motion();
        parts.push(format!("\"home\":{text}"));
        steps.push(Step::constant(home));
    }
    let kind = if is_loop { "loop" } else { "arm" };
    let (tail, given) = if is_loop {
        // A loop of screws closes where its last link is in the frame of the base again.
        let angle = draw.angle();
        (format!("\"input\":[{{\"joint\":1,\"angle\":{}}}]", angle.quoted()), Some((0, angle.value)))
    } else {
        let (base, m) = draw.motion();
        parts.push(format!("\"base\":{base}"));
        steps.insert(0, Step::constant(m));
        let (pose, m) = draw.motion();
        steps.push(Step::constant(inverse(&m)));
        (format!("\"pose\":[{{\"matrix\":{pose}}}]"), None)
    };
    let text = format!("{{\"title\":\"drawn\",\"mechanism\":{{\"kind\":\"{kind}\",{}}},{tail}}}", parts.join(","));
    Drawn { text, steps, is_angle, given }
}

/// The results for many mechanisms.
#[derive(Debug, Default)]
struct Tally {
    mechanisms: usize,
    certified: usize,
    unsettled: usize,
    worst: f64,
}

fn judge(drawn: &Drawn, tally: &mut Tally) {
    let entry = load_text(&drawn.text, "drawn", Format::Json, &Options::default())
        .unwrap_or_else(|e| panic!("{e}: {}", drawn.text));
    // Special ones may be of a kind that is not solved.
    let Ok(mechanism) = Mechanism::prepare(&entry) else { return };
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    let Ok(solution_of) = mechanism.solve(&entry.cases[0], Roots::All, &mut workspace, &mut assembly) else { return };
    tally.mechanisms += 1;
    for mode in &solution_of.modes {
        if !mode.certified {
            tally.unsettled += 1;
            continue;
        }
        tally.certified += 1;
        let mut start: Vec<Wide> = mode.q.iter().map(|z| Wide::of(z.re, z.im)).collect();
        if let Some((at, value)) = &drawn.given {
            start[*at] = real(value);
        }
        let given = drawn.given.as_ref().map(|(at, _)| *at);
        let found = solution(&drawn.steps, &start, given);
        let found = found.unwrap_or_else(|| panic!("no solution at {:?} of {}", mode.q, drawn.text));
        for (k, value) in found.iter().enumerate().filter(|(k, _)| Some(*k) != given) {
            let away = distance(value, &start[k], drawn.is_angle[k]);
            let part = away / mode.radius;
            assert!(part <= 1.0, "{k}: {away:e} off, radius {:e}: {:?} of {}", mode.radius, mode.q, drawn.text);
            tally.worst = tally.worst.max(part);
            if mode.real {
                assert!(value.im.clone().abs() < 1e-60, "{k}: complex: {:?} of {}", mode.q, drawn.text);
            }
        }
    }
}

/// Returns the number of mechanisms drawn, each with at most sixteen modes.
fn count() -> u64 {
    std::env::var("LOOPROOT_RADII").ok().and_then(|text| text.parse().ok()).unwrap_or(8)
}

#[test]
fn no_certified_radius_misses_the_solution_of_the_file() {
    let mut tally = Tally::default();
    for seed in 0..count() {
        let mut random = ChaCha8Rng::seed_from_u64(900 + seed);
        let scale = [0, 0, -6, 6, 3, -3][random.random_range(0..6)];
        let far: i64 = [0, 0, 1_000, 1_000_000, 10_000_000_000][random.random_range(0..5)];
        let shift = std::array::from_fn(|_| if far == 0 { 0 } else { random.random_range(-far..=far) });
        let mut draw = Draw { random, scale, shift };
        let drawn = drawn(&mut draw, seed % 4 == 3);
        judge(&drawn, &mut tally);
    }
    println!("{tally:?}");
    assert!(tally.certified as u64 > 4 * count() && tally.unsettled * 4 < tally.certified, "{tally:?}");
}
