//! Import of displays described by other programs: MPCDI and ParaView's `.pvx`.

mod mpcdi;
mod pvx;
mod xml;

use super::{Display, DisplayError, file, read};
use std::path::Path;

/// Reads a `.pvx`, `.mpcdi` or `.mpcdi.xml` file.
///
/// # Errors
/// [`DisplayError`].
pub(super) fn load(path: &Path) -> Result<Display, DisplayError> {
    let bytes = read::bytes(path).map_err(|reason| DisplayError::Read { path: path.to_owned(), reason })?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy().trim_end_matches(".mpcdi").to_owned();
    let read =
        if is_pvx(path) { pvx::read(&bytes) } else { mpcdi::read(bytes, path.parent().unwrap_or(Path::new(""))) };
    let mut display = read.map_err(|reason| DisplayError::Import { path: path.to_owned(), reason })?;
    display.name = name;
    file::check_imported(&path.display().to_string(), &display)?;
    Ok(display)
}

/// True for a file that is imported here, judged by its ending.
pub(super) fn is_imported(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    name.ends_with(".mpcdi") || name.ends_with(".mpcdi.xml") || is_pvx(path)
}

fn is_pvx(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("pvx"))
}

/// Name without characters that no file name may have, and different from all in `taken`, to which it is added.
fn file_name(name: &str, taken: &mut Vec<String>) -> String {
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
