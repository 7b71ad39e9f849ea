//! Overlaps among rectangles, found in one sweep from left to right.

use std::collections::BTreeMap;

/// Two of the rectangles (x, y, width, height, each side at least 1) that have a point in common, if there are any.
/// The time grows as n log n.
pub(crate) fn overlap(rectangles: &[[u32; 4]]) -> Option<[usize; 2]> {
    // Left and right edges from left to right; at one place, the right edges first.
    let edges = |index: usize| {
        let [x, _, width, _] = rectangles[index];
        let x = u64::from(x);
        [(x + u64::from(width), false, index), (x, true, index)]
    };
    let mut edges: Vec<_> = (0..rectangles.len()).flat_map(edges).collect();
    edges.sort_unstable();

    // Rectangles that the sweep crosses do not overlap, so a new one can only meet its neighbours in y.
    let mut crossed: BTreeMap<u64, (u64, usize)> = BTreeMap::new();
    for (_, begins, index) in edges {
        let [_, y, _, height] = rectangles[index];
        let (from, to) = (u64::from(y), u64::from(y) + u64::from(height));
        if !begins {
            crossed.remove(&from);
            continue;
        }
        let above = crossed.range(..=from).next_back().filter(|(_, (end, _))| *end > from);
        let below = crossed.range(from..to).next();
        if let Some((_, (_, other))) = above.or(below) {
            return Some([*other, index]);
        }
        crossed.insert(from, (to, index));
    }
    None
}

#[cfg(test)]
mod tests {
    //! Law: the sweep finds an overlap exactly where a comparison of all pairs does. A wrong program would draw two
    //! channels on the same pixels, or refuse two that only touch.

    use super::*;
    use rand::{RngExt, SeedableRng};

    fn by_pairs(rectangles: &[[u32; 4]]) -> bool {
        let apart = |a: &[u32; 4], b: &[u32; 4], i: usize| a[i] + a[i + 2] <= b[i] || b[i] + b[i + 2] <= a[i];
        (0..rectangles.len()).any(|j| {
            (0..j).any(|i| !apart(&rectangles[i], &rectangles[j], 0) && !apart(&rectangles[i], &rectangles[j], 1))
        })
    }

    #[test]
    fn the_sweep_agrees_with_all_pairs() {
        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(5);
        let mut counts = [0, 0];
        for round in 0..4000 {
            let count = 2 + round % 7;
            let rectangles: Vec<[u32; 4]> = (0..count)
                .map(|_| {
                    let mut side = |least: u32, most: u32| random.random_range(least..=most);
                    [side(0, 12), side(0, 12), side(1, 4), side(1, 4)]
                })
                .collect();
            let found = overlap(&rectangles);
            assert_eq!(found.is_some(), by_pairs(&rectangles), "{rectangles:?}");
            if let Some([a, b]) = found {
                assert!(a != b && by_pairs(&[rectangles[a], rectangles[b]]), "{rectangles:?} {a} {b}");
            }
            counts[usize::from(found.is_some())] += 1;
        }
        assert!(counts.iter().all(|count| *count > 500), "{counts:?}");
    }
}
