//! The multiplicities of candidates, from upper bounds at every value of every unknown and the number of all solutions.

use super::tuples::Tuple;

/// The solutions and candidates before their multiplicities are known.
pub struct Balance<'a> {
    /// `[unknown][value]`: upper bound on the number of solutions with this value, with multiplicity.
    pub orders: &'a [Vec<usize>; 6],
    /// Simple solutions.
    pub simple: &'a [Tuple],
    /// The other combinations that may be solutions; no further ones exist.
    pub open: &'a [Tuple],
}

impl Balance<'_> {
    /// Returns the number of solutions for which the open combinations can account at a value of an unknown.
    fn room(&self, unknown: usize, value: usize) -> usize {
        let taken = self.simple.iter().filter(|tuple| tuple[unknown] == value).count();
        self.orders[unknown][value].saturating_sub(taken)
    }

    /// The values of an unknown in open combinations.
    fn occupied(&self, unknown: usize) -> Vec<usize> {
        let mut values: Vec<usize> = self.open.iter().map(|tuple| tuple[unknown]).collect();
        values.sort_unstable();
        values.dedup();
        values
    }

    /// Returns the upper bound, from one unknown, on the number of solutions for which the open combinations account.
    fn most_by(&self, unknown: usize) -> usize {
        self.occupied(unknown).into_iter().map(|value| self.room(unknown, value)).sum()
    }

    /// Returns an upper bound on the number of solutions, with multiplicity.
    pub fn most(&self) -> usize {
        self.simple.len() + (0..6).map(|unknown| self.most_by(unknown)).min().unwrap_or(0)
    }

    /// Returns the multiplicities of the open combinations, 0 for those that are no solutions, where there are at least `least`
    /// solutions with multiplicity; `None` where these bounds leave them open.
    ///
    /// If the values of an unknown allow for no more than `least`, each of them is attained.
    pub fn multiplicities(&self, least: usize) -> Option<Vec<usize>> {
        let left = least.checked_sub(self.simple.len())?;
        let tight: Vec<usize> = (0..6).filter(|&unknown| self.most_by(unknown) == left).collect();
        let groups = tight.iter().flat_map(|&unknown| {
            self.occupied(unknown).into_iter().map(move |value| (unknown, value, self.room(unknown, value)))
        });
        let groups: Vec<(usize, usize, usize)> = groups.collect();
        let cap = |tuple: &Tuple| (0..6).map(|unknown| self.room(unknown, tuple[unknown])).min().unwrap_or(0);
        let mut known: Vec<Option<usize>> = self.open.iter().map(|t| (cap(t) == 0).then_some(0)).collect();
        loop {
            let before = known.iter().flatten().count();
            for (unknown, value, total) in &groups {
                let members = (0..known.len()).filter(|&k| self.open[k][*unknown] == *value);
                let (done, open): (Vec<usize>, Vec<usize>) = members.partition(|&k| known[k].is_some());
                let rest = total.checked_sub(done.iter().filter_map(|&k| known[k]).sum())?;
                let most: usize = open.iter().map(|&k| cap(&self.open[k])).sum();
                match open.as_slice() {
                    [] if rest > 0 => return None,
                    [only] => known[*only] = Some(rest),
                    several if rest == 0 => several.iter().for_each(|&k| known[k] = Some(0)),
                    several if most == rest => several.iter().for_each(|&k| known[k] = Some(cap(&self.open[k]))),
                    _ => {}
                }
            }
            if known.iter().all(Option::is_some) {
                break;
            }
            if known.iter().flatten().count() == before {
                return None;
            }
        }
        let all: Vec<usize> = known.into_iter().flatten().collect();
        (all.iter().sum::<usize>() == left).then_some(all)
    }

    /// Returns the multiplicities of the open combinations, where `exponents` lists the multiplicities of all solutions in some
    /// order, if there are as many solutions as combinations; `None` where that leaves them open.
    pub fn by_exponents(&self, exponents: &[usize]) -> Option<Vec<usize>> {
        if exponents.len() != self.simple.len() + self.open.len() {
            return None;
        }
        let mut left = exponents.to_vec();
        for _ in self.simple {
            left.swap_remove(left.iter().position(|&exponent| exponent == 1)?);
        }
        left.sort_unstable();
        let mut found = Vec::new();
        self.assign(&mut Vec::new(), &mut left, &mut found);
        if found.len() == 1 { found.pop() } else { None }
    }

    /// Gives the next open combination each of the exponents that are left, as far as the orders allow; stops at two ways to
    /// do so.
    fn assign(&self, given: &mut Vec<usize>, left: &mut Vec<usize>, found: &mut Vec<Vec<usize>>) {
        let Some(tuple) = self.open.get(given.len()) else { return found.push(given.clone()) };
        let taken = |unknown: usize| {
            let same = self.open.iter().zip(&*given).filter(|(other, _)| other[unknown] == tuple[unknown]);
            same.map(|(_, exponent)| exponent).sum::<usize>()
        };
        let room = (0..6).map(|j| self.room(j, tuple[j]).saturating_sub(taken(j))).min().unwrap_or(0);
        for k in 0..left.len() {
            // Equal exponents stand together: the first one of each kind is enough.
            if left[k] > room || found.len() > 1 || (k > 0 && left[k - 1] == left[k]) {
                continue;
            }
            let exponent = left.remove(k);
            given.push(exponent);
            self.assign(given, left, found);
            given.pop();
            left.insert(k, exponent);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_double_solution_takes_up_what_the_simple_ones_leave() {
        let orders = std::array::from_fn(|_| vec![1, 2, 1]);
        let (simple, open) = ([[0; 6], [2; 6]], [[1; 6]]);
        let balance = Balance { orders: &orders, simple: &simple, open: &open };
        assert_eq!(balance.most(), 4);
        assert_eq!(balance.multiplicities(4), Some(vec![2]));
        // Nothing follows unless the lower bound is attained.
        assert_eq!(balance.multiplicities(3), None);
    }

    #[test]
    fn shared_values_are_told_apart_by_another_unknown() {
        let mut orders: [Vec<usize>; 6] = std::array::from_fn(|_| vec![4]);
        orders[5] = vec![3, 1];
        let open = [[0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 1]];
        let balance = Balance { orders: &orders, simple: &[], open: &open };
        assert_eq!(balance.multiplicities(4), Some(vec![3, 1]));
    }

    #[test]
    fn exponents_settle_what_shared_values_leave_open() {
        // Two unknowns of two values each, all four combinations: the orders alone allow 3, 1, 1, 3.
        let orders: [Vec<usize>; 6] = std::array::from_fn(|_| vec![4, 4]);
        let open = [[0, 0, 0, 0, 0, 0], [0, 1, 0, 1, 0, 1], [1, 0, 1, 0, 1, 0], [1, 1, 1, 1, 1, 1]];
        let balance = Balance { orders: &orders, simple: &[], open: &open };
        assert_eq!(balance.multiplicities(8), None);
        assert_eq!(balance.by_exponents(&[2, 2, 2, 2]), Some(vec![2, 2, 2, 2]));
        // It is open which ones are triple, and three roots do not show which combination is no solution.
        assert_eq!(balance.by_exponents(&[3, 1, 1, 3]), None);
        assert_eq!(balance.by_exponents(&[4, 2, 2]), None);
    }
}
