//! Stable sorting by one routine for all types of elements: a sort of the standard library is 8 kB of machine code for each closure
//! that it is called with. Lists that are sorted once in a question need no more; those that are sorted for every pose do.

use std::cmp::Ordering;

/// Sorts a list as `slice::sort_by` does.
pub fn by<T>(list: &mut [T], mut compare: impl FnMut(&T, &T) -> Ordering) {
    let mut order = order(list.len(), &mut |i, j| compare(&list[i], &list[j]));
    // Each cycle of the permutation is walked once: element order[i] belongs in place i.
    for start in 0..list.len() {
        let mut place = start;
        while order[place] != start {
            let from = order[place];
            list.swap(place, from);
            order[place] = place;
            place = from;
        }
        order[place] = place;
    }
}

/// Sorts a list as `slice::sort_by_key` does.
pub fn by_key<T, K: Ord>(list: &mut [T], mut key: impl FnMut(&T) -> K) {
    by(list, |a, b| key(a).cmp(&key(b)));
}

/// Returns the places of `count` elements in their order.
fn order(count: usize, compare: &mut dyn FnMut(usize, usize) -> Ordering) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|&i, &j| compare(i, j));
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_sorted_as_by_the_standard_library() {
        let mut state = 7_u64;
        for length in 0..200 {
            let mut list: Vec<(u64, usize)> = (0..length)
                .map(|place| {
                    state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                    (state >> 60, place)
                })
                .collect();
            let mut expected = list.clone();
            expected.sort_by_key(|(key, _)| *key);
            by_key(&mut list, |(key, _)| *key);
            assert_eq!(list, expected);
            expected.sort_by_key(|pair| std::cmp::Reverse(pair.0));
            by(&mut list, |a, b| b.0.cmp(&a.0));
            assert_eq!(list, expected);
        }
    }
}
