//! A rational motion factored: exactly where the quadratic factors of its norm are rational, and the loops it makes.

use crate::algebra::number::nearest_f64;
use crate::algebra::ring::Field;
use crate::algebra::univariate::Univariate;
use crate::catalogue::MotionFile;
use crate::error::{Error, Result};
use crate::kinematics::dual_quaternion::DualQuaternion;
use crate::kinematics::motion_polynomial::{
    Factorisations, LinkParameters, Linkage, bennett_ratio, factorisations, from_parts, numeric_quadratics, parts,
    quadratic_factors,
};
use crate::kinematics::screw_system::{Screw, ScrewSystem};
use rug::Rational;

/// Real numbers t at which the screws of a loop are looked at: rank and words are those of the most general of them.
const SAMPLES: [(i32, i32); 4] = [(1, 3), (-2, 5), (7, 2), (-5, 1)];

/// The result of factoring a motion polynomial.
#[derive(Clone, Debug)]
pub enum Factored {
    /// All factorisations, over the rationals.
    Exact(Factorisations<Rational>),
    /// The quadratic factors of the norm are not rational: factorisations in f64.
    Float(Factorisations<f64>),
    /// No factorisation is known, for this reason.
    None(String),
}

/// The closed loop of two factorisations.
#[derive(Clone, Debug)]
pub struct Loop {
    /// Indices of the two factorisations, counted from 0.
    pub pair: (usize, usize),
    /// Its joints in short: `6R`.
    pub letters: String,
    /// The axes of the joints at t = infinity, and whether they are prismatic.
    pub axes: Vec<(Screw<Rational>, bool)>,
    /// The order of the screw system of the joints.
    pub order: usize,
    /// The common property of the axes.
    pub system: String,
    /// Bennett's ratio `(a / sin alpha)^2` if it is his.
    pub bennett: Option<Rational>,
    /// Denavit-Hartenberg parameters; `None` with prismatic joints.
    pub parameters: Option<Vec<LinkParameters>>,
}

impl Loop {
    /// Returns the least and greatest dimension of the motions. The loop moves, and to first order its freedom is the number of
    /// joints minus the order of their screw system. For order 6, or where that is 1, both are equal.
    #[must_use]
    pub fn mobility(&self) -> (usize, usize) {
        let most = self.axes.len() - self.order;
        (if self.order == 6 { most } else { 1 }, most)
    }
}

/// Factors the polynomial of a file.
#[must_use]
pub fn factor(file: &MotionFile) -> Factored {
    let norm = file.polynomial.norm().value;
    let flat = |found: &Factorisations<Rational>| found.list.is_empty();
    if let Some(quadratics) = quadratic_factors(&norm) {
        return match factorisations(&file.polynomial, &quadratics) {
            Ok(found) if flat(&found) => {
                Factored::None("in every order some remainder has no inverse, the polynomial is not generic".to_owned())
            }
            Ok(found) => Factored::Exact(found),
            Err(_) => Factored::None("it is no motion".to_owned()),
        };
    }
    let Some(quadratics) = numeric_quadratics(&norm) else {
        return Factored::None("the norm has irrational real roots".to_owned());
    };
    let float = from_parts(
        &parts(&file.polynomial).map(|part| Univariate::new(part.coefficients().iter().map(nearest_f64).collect())),
    );
    match factorisations(&float, &quadratics) {
        Ok(found) if !found.list.is_empty() => Factored::Float(found),
        _ => Factored::None("no factorisation found in f64".to_owned()),
    }
}

/// A factorisation for printing: the order of the norms, and the eight parts of each factor.
type Row = (Vec<usize>, Vec<[String; 8]>);

impl Factored {
    /// The number of factorisations.
    #[must_use]
    pub fn factorisations(&self) -> usize {
        match self {
            Self::Exact(found) => found.list.len(),
            Self::Float(found) => found.list.len(),
            Self::None(_) => 0,
        }
    }

    /// The factorisations, their numbers as text.
    #[must_use]
    pub fn rows(&self) -> Vec<Row> {
        match self {
            Self::Exact(found) => rows(found, &|x| x.to_string()),
            Self::Float(found) => rows(found, &|x| format!("{x:.12}")),
            Self::None(_) => Vec::new(),
        }
    }

    /// The quadratic factors of the norm as text.
    #[must_use]
    pub fn quadratics(&self) -> Vec<String> {
        match self {
            Self::Exact(found) => quadratics(found, &|x| x.to_string()),
            Self::Float(found) => quadratics(found, &|x| format!("{x:.15}")),
            Self::None(_) => Vec::new(),
        }
    }

    /// Returns the loop of two factorisations counted from 0, or of the first pair with the most joints; `None` if that has fewer
    /// than three joints, or the factorisations are not exact.
    ///
    /// # Errors
    /// When a number exceeds the number of factorisations.
    pub fn closed_loop(&self, wanted: Option<(usize, usize)>) -> Result<Option<Loop>> {
        let count = self.factorisations();
        if let Some((i, j)) = wanted
            && (i >= count || j >= count || i == j)
        {
            let (i, j) = (i + 1, j + 1);
            return Err(Error::Invalid(format!(
                "found the pair {i},{j}, expected two different numbers from 1 to {count}"
            )));
        }
        let Self::Exact(found) = self else { return Ok(None) };
        let linkage = |(i, j): (usize, usize)| Linkage::of(&found.list[i].1, &found.list[j].1);
        let pair = wanted.or_else(|| {
            // The first of those with most joints: `max_by_key` would take the last.
            (1..count).rev().map(|j| (0, j)).max_by_key(|&pair| linkage(pair).joints.len())
        });
        Ok(pair.and_then(|pair| closed(pair, &linkage(pair))))
    }
}

fn rows<F: Field>(found: &Factorisations<F>, text: &dyn Fn(&F) -> String) -> Vec<Row> {
    let factor = |h: &DualQuaternion<F>| parts(h).each_ref().map(text);
    found.list.iter().map(|(order, factors)| (order.clone(), factors.iter().map(factor).collect())).collect()
}

fn quadratics<F: Field>(found: &Factorisations<F>, text: &dyn Fn(&F) -> String) -> Vec<String> {
    let one = |quadratic: &Univariate<F>| {
        let term = |k: usize, power: &str| match quadratic.coefficients().get(k) {
            Some(c) if !c.is_zero() => {
                let text = text(c);
                match text.strip_prefix('-') {
                    Some(rest) => format!(" - {rest}{power}"),
                    None => format!(" + {text}{power}"),
                }
            }
            _ => String::new(),
        };
        format!("t^2{}{}", term(1, " t"), term(0, ""))
    };
    found.quadratics.iter().map(one).collect()
}

/// Describes a loop that closes for every t.
fn closed(pair: (usize, usize), linkage: &Linkage<Rational>) -> Option<Loop> {
    if linkage.joints.len() < 3 || !linkage.closes() {
        return None;
    }
    let systems = SAMPLES.map(|t| ScrewSystem::of(&linkage.screws(&Rational::from(t))));
    let general = systems.iter().max_by_key(|system| system.order())?;
    Some(Loop {
        pair,
        letters: linkage.letters(),
        axes: linkage.joints.iter().map(|joint| (joint.axis.clone(), joint.prismatic)).collect(),
        order: general.order(),
        system: general.description(),
        bennett: bennett_ratio(linkage),
        parameters: linkage.parameters(nearest_f64),
    })
}
