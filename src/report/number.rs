//! Numbers as a reader wants them: few digits, never more certain than they are.

/// An upper bound of one digit: `3e-16` for 2.2e-16, `0` for 0.
#[must_use]
pub fn at_most(x: f64) -> String {
    if x <= 0.0 {
        return "0".to_owned();
    }
    if !x.is_finite() {
        return "unknown".to_owned();
    }
    let shown = format!("{x:.0e}");
    // Printing rounds to nearest; a bound is rounded up.
    if shown.parse::<f64>().is_ok_and(|y| y >= x) {
        return shown;
    }
    let exponent = x.log10().floor();
    let digit = (x / 10_f64.powf(exponent)).floor() + 1.0;
    format!("{:.0e}", digit * 10_f64.powf(exponent))
}

/// A size of which only the order of magnitude matters: `21`, `3e5`.
#[must_use]
pub fn magnitude(x: f64) -> String {
    match x {
        _ if !x.is_finite() => "inf".to_owned(),
        _ if x.abs() < 1e4 => format!("{x:.0}"),
        _ => format!("{x:.0e}"),
    }
}

/// A duration given in microseconds, with two digits: `0.05 ms`, `1.2 s`.
#[must_use]
pub fn duration(microseconds: f64) -> String {
    let two = |x: f64| match x {
        _ if x < 0.095 => format!("{x:.3}"),
        _ if x < 0.95 => format!("{x:.2}"),
        _ if x < 9.5 => format!("{x:.1}"),
        _ => format!("{x:.0}"),
    };
    if microseconds < 1e6 {
        format!("{} ms", two(microseconds / 1e3))
    } else {
        format!("{} s", two(microseconds / 1e6))
    }
}

/// A number with at most this many decimals and no trailing zeros: `0.4318`, `90`.
#[must_use]
pub fn short(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// A number in three digits: `4.12`, `0.00316`, `1e-7`.
#[must_use]
pub fn three_digits(x: f64) -> String {
    digits(format!("{x:.2e}").parse::<f64>().unwrap_or(x))
}

/// A number in at most 15 digits: `0.1`, `-1.25e-7`.
#[must_use]
pub fn digits(x: f64) -> String {
    let shortened = format!("{x:.14e}").parse::<f64>().unwrap_or(x);
    let text = format!("{shortened:?}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

/// `1 pose`, `2 poses`, `2 assemblies`: no noun that is counted ends in a vowel and y.
#[must_use]
pub fn counted(count: usize, noun: &str) -> String {
    let plural = noun.strip_suffix('y').map_or_else(|| format!("{noun}s"), |stem| format!("{stem}ies"));
    format!("{count} {}", if count == 1 { noun } else { &plural })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_rounded_up() {
        assert_eq!(at_most(2.2e-16), "3e-16");
        assert_eq!(at_most(2.9e-16), "3e-16");
        assert_eq!(at_most(9.2e-16), "1e-15");
        assert_eq!(at_most(3e-16), "3e-16");
        assert_eq!(at_most(0.0), "0");
        assert_eq!(at_most(f64::INFINITY), "unknown");
    }

    #[test]
    fn durations_have_two_digits() {
        assert_eq!(duration(46.0), "0.046 ms");
        assert_eq!(duration(460.0), "0.46 ms");
        assert_eq!(duration(1_234_567.0), "1.2 s");
    }

    #[test]
    fn fifteen_digits_are_enough() {
        assert_eq!(digits(0.1 + 0.2), "0.3");
        assert_eq!(digits(-2.0), "-2");
        assert_eq!(digits(1.0 / 3.0), "0.333333333333333");
        assert_eq!(digits(1.25e-7), "1.25e-7");
        assert_eq!([4.1234, 0.003_162_3, 0.0].map(three_digits), ["4.12", "0.00316", "0"]);
    }

    #[test]
    fn short_numbers_have_no_tail() {
        assert_eq!(short(0.4318, 6), "0.4318");
        assert_eq!(short(-1e-9, 6), "0");
        assert_eq!(short(100.0, 0), "100");
    }
}
