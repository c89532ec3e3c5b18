//! The rates of the shafts of a train of gears.

use crate::algebra::echelon::Echelon;
use crate::catalogue::gearing::Train;
use crate::displacement::Answer;
use crate::displacement::answer::Named;
use rug::Rational;

/// The rates that satisfy all relations and are what is given.
pub fn answer(train: &Train) -> Answer {
    let count = train.shafts.len();
    // Each row: factors of the rates, and what they add up to.
    let mut rows: Vec<Vec<Rational>> =
        train.relations.iter().map(|relation| [relation.clone(), vec![Rational::new()]].concat()).collect();
    for (shaft, rate) in &train.given {
        let mut row = vec![Rational::new(); count + 1];
        row[*shaft] = Rational::from(1);
        row[count].clone_from(rate);
        rows.push(row);
    }
    let solved = Echelon::of(rows, count + 1);
    if solved.pivots().contains(&count) {
        return Answer::none("the relations and the given rates contradict one another");
    }
    if solved.rank() < count {
        let free = count - solved.rank();
        return Answer::family(free, None, format!("the train has {free} more freedoms than rates that are given"));
    }
    let mut rates = Named::default();
    let mut named = Named::default();
    // In reduced form every row names one rate, which is the last entry.
    for (row, pivot) in solved.rows().iter().zip(solved.pivots()) {
        let rate = Rational::from(&row[count] / &row[*pivot]);
        rates.number(&train.shafts[*pivot], &rate);
    }
    named.under("rates", rates);
    named.answer("the relations between the rates are linear, and of full rank with what is given")
}
