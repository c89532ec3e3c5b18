//! Gradings of polynomials: integer weights of the variables for which one polynomial has a single term of the highest grade.

use super::recurrence::Random;
use super::sparse_gcd::Terms;
use crate::int::Int;
use crate::ring::Ring;

/// How many gradings with several weights are tried where none with a single one will do.
const TRIES: usize = 24;
/// The largest absolute value of these weights.
const LARGEST_WEIGHT: i32 = 2;
/// Grades beyond this number are too many for dense polynomials in t.
const MOST_GRADES: i64 = 1 << 14;

/// Weights of variables.
pub(super) struct Grading {
    pub(super) weights: Vec<i32>,
    /// A variable of weight other than 0, whose exponent the grade determines.
    pub(super) pivot: usize,
    /// Whether it is the second polynomial that has a single term of the highest grade.
    pub(super) exchanged: bool,
    /// What one image of the divisor costs, in products of residues.
    pub(super) image_cost: f64,
    /// What all images that are expected cost.
    cost: f64,
}

/// The grades of one polynomial.
struct Grades {
    lowest: i64,
    highest: i64,
    /// The number of terms of the highest grade.
    top: usize,
}

impl Grading {
    /// Returns the grading for which images are expected to cost least; `None` if none was found.
    pub(super) fn choose(a: &Terms, b: &Terms) -> Option<Self> {
        let variables = a.degrees.len();
        let single = (0..variables).flat_map(|variable| {
            [1, -1].map(|weight| (0..variables).map(|v| if v == variable { weight } else { 0 }).collect())
        });
        let least = |gradings: &mut dyn Iterator<Item = Vec<i32>>| {
            let found = gradings.filter_map(|weights| Self::of(weights, a, b));
            found.min_by(|x, y| x.cost.total_cmp(&y.cost))
        };
        least(&mut single.into_iter()).or_else(|| {
            let mut random = Random(0x2545_f491_4f6c_dd1d);
            let range = 2 * LARGEST_WEIGHT.unsigned_abs() + 1;
            let mut weight = |_| ((random.next() >> 33) as u32 % range).cast_signed() - LARGEST_WEIGHT;
            least(&mut (0..TRIES).map(|_| (0..variables).map(&mut weight).collect()))
        })
    }

    fn of(weights: Vec<i32>, a: &Terms, b: &Terms) -> Option<Self> {
        let (grades_a, grades_b) = (Grades::of(&weights, a), Grades::of(&weights, b));
        let exchanged = match (grades_a.top, grades_b.top) {
            (1, _) => false,
            (_, 1) => true,
            _ => return None,
        };
        // The variable that spares the most exponents.
        let reach = |&v: &usize| a.degrees[v].min(b.degrees[v]);
        let pivot = (0..weights.len()).filter(|&v| weights[v] != 0).max_by_key(reach)?;
        let spreads = [grades_a.highest - grades_a.lowest, grades_b.highest - grades_b.lowest];
        if spreads.iter().any(|&spread| spread > MOST_GRADES) {
            return None;
        }
        let [spread_a, spread_b] = spreads.map(|spread| spread as f64);
        let terms = a.len().min(b.len()) as f64;
        let image_cost = 2.0 * (a.len() + b.len()) as f64 + spread_a * spread_b;
        // The divisor of random factors has the root of the number of terms, and half the grades.
        let expected = 2.0 + 4.0 * terms.sqrt() / (0.5 * spread_a.min(spread_b) + 1.0);
        Some(Self { weights, pivot, exchanged, image_cost, cost: expected * image_cost })
    }

    fn grade(&self, exponents: &[u32]) -> i64 {
        grade(&self.weights, exponents)
    }

    /// Returns the terms from the lowest grade on, and where each grade ends.
    pub(super) fn sorted(&self, terms: &Terms) -> (Vec<u32>, Vec<usize>) {
        let grades: Vec<i64> = terms.exponents.chunks_exact(self.weights.len()).map(|e| self.grade(e)).collect();
        let (lowest, highest) = grades.iter().fold((i64::MAX, i64::MIN), |(l, h), &g| (l.min(g), h.max(g)));
        let place = |grade: i64| usize::try_from(grade - lowest).unwrap_or(0);
        let mut ends = vec![0; place(highest) + 1];
        for &grade in &grades {
            ends[place(grade)] += 1;
        }
        let mut sum = 0;
        for end in &mut ends {
            (*end, sum) = (sum, sum + *end);
        }
        let mut order = vec![0; grades.len()];
        for (term, &grade) in (0..).zip(&grades) {
            let next = &mut ends[place(grade)];
            order[*next] = term;
            *next += 1;
        }
        (order, ends)
    }

    /// Returns the term of the highest grade.
    pub(super) fn top_term(&self, terms: &Terms) -> usize {
        let grades = terms.exponents.chunks_exact(self.weights.len()).map(|e| self.grade(e));
        grades.enumerate().max_by_key(|&(_, grade)| grade).map_or(0, |(term, _)| term)
    }

    /// Returns the greatest common divisor of the coefficients of the highest grade.
    pub(super) fn top_content(&self, terms: &Terms) -> Int {
        let (order, ends) = self.sorted(terms);
        let start = ends.len().checked_sub(2).map_or(0, |before| ends[before]);
        order[start..].iter().fold(Int::zero(), |content, &term| content.gcd(&terms.coefficients[term as usize]))
    }
}

fn grade(weights: &[i32], exponents: &[u32]) -> i64 {
    weights.iter().zip(exponents).map(|(&w, &e)| i64::from(w) * i64::from(e)).sum()
}

impl Grades {
    fn of(weights: &[i32], terms: &Terms) -> Self {
        let mut grades = Self { lowest: i64::MAX, highest: i64::MIN, top: 0 };
        for exponents in terms.exponents.chunks_exact(weights.len()) {
            let grade = grade(weights, exponents);
            grades.lowest = grades.lowest.min(grade);
            if grade > grades.highest {
                (grades.highest, grades.top) = (grade, 0);
            }
            grades.top += usize::from(grade == grades.highest);
        }
        grades
    }
}
