//! Names of imported windows and channels, made fit for files.

/// Name without characters that no file name may have, and different from all in `taken`, to which it is added.
pub(super) fn file_name(name: &str, taken: &mut Vec<String>) -> String {
    let fit = |letter: char| if letter.is_control() || "/\\<>:\"|?*".contains(letter) { '-' } else { letter };
    let fitted: String = name.trim().trim_start_matches('.').chars().map(fit).take(100).collect();
    let fitted = if fitted.is_empty() { "screen".to_owned() } else { fitted };
    let mut unique = fitted.clone();
    let mut number = 2;
    while taken.contains(&unique) {
        unique = format!("{fitted}-{number}");
        number += 1;
    }
    taken.push(unique.clone());
    unique
}
