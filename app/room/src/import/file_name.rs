//! Names of imported windows and channels, made fit for files.

use std::collections::{HashMap, HashSet};

/// Names that are taken.
#[derive(Default)]
pub(super) struct TakenNames {
    taken: HashSet<String>,
    /// Number that the next name of the same letters gets.
    next: HashMap<String, u64>,
}

impl TakenNames {
    /// Name without characters that no file name may have, and different from all names given before.
    pub fn file_name(&mut self, name: &str) -> String {
        let fit = |letter: char| if letter.is_control() || "/\\<>:\"|?*".contains(letter) { '-' } else { letter };
        // At most 50 letters: a name of 200 bytes, so that a number and an ending still fit.
        let fitted: String = name.trim().trim_start_matches('.').chars().map(fit).take(50).collect();
        let fitted = if fitted.is_empty() { "screen".to_owned() } else { fitted };
        if self.taken.insert(fitted.clone()) {
            return fitted;
        }
        let number = self.next.entry(fitted.clone()).or_insert(2);
        loop {
            let unique = format!("{fitted}-{number}");
            *number += 1;
            if self.taken.insert(unique.clone()) {
                return unique;
            }
        }
    }
}
