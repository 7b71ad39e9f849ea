//! Places where spacenavd's socket may be, in the order of the daemon's own library.

use std::ffi::OsString;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Variable that names the socket.
const VARIABLE: &str = "SPNAV_SOCKET";
/// Settings of the daemon.
const SETTINGS: &str = "/etc/spnavrc";
/// Places of the socket without any setting.
const USUAL: [&str; 2] = ["/run/spnav.sock", "/var/run/spnav.sock"];
/// Most bytes that are read of the settings.
const MOST_BYTES: u64 = 64 * 1024;

/// Places where the socket may be, the likeliest first.
pub(super) fn usual_places() -> Vec<PathBuf> {
    places(std::env::var_os(VARIABLE), Path::new(SETTINGS))
}

fn places(variable: Option<OsString>, settings: &Path) -> Vec<PathBuf> {
    let named = variable.filter(|path| !path.is_empty()).map(PathBuf::from);
    let set = text(settings).and_then(|text| socket(&text)).map(PathBuf::from);
    let mut places: Vec<PathBuf> = Vec::new();
    for place in named.into_iter().chain(set).chain(USUAL.map(PathBuf::from)) {
        if !places.contains(&place) {
            places.push(place);
        }
    }
    places
}

/// Beginning of a regular file; a pipe in its place would be waited for without end.
fn text(path: &Path) -> Option<String> {
    std::fs::metadata(path).ok().filter(std::fs::Metadata::is_file)?;
    let mut bytes = Vec::new();
    File::open(path).ok()?.take(MOST_BYTES).read_to_end(&mut bytes).ok()?;
    Some(String::from_utf8_lossy(&bytes).into_owned())
}

/// Socket in the settings: `socket = PATH` on a line of its own.
fn socket(text: &str) -> Option<String> {
    let lines = text.lines().map(str::trim).filter(|line| !line.starts_with('#'));
    let paths = lines.filter_map(|line| line.strip_prefix("socket")?.trim_start().strip_prefix('='));
    paths.map(str::trim).find(|path| !path.is_empty()).map(str::to_owned)
}

#[cfg(test)]
mod tests {
    //! Law: the variable comes before the settings, and these before the usual places.
    use super::*;

    #[test]
    fn places_come_in_the_order_of_the_daemons_own_library() {
        let directory = tempfile::tempdir().unwrap();
        let settings = directory.path().join("spnavrc");
        let usual = USUAL.map(PathBuf::from).to_vec();
        assert_eq!(places(None, &settings), usual);
        assert_eq!(places(Some(OsString::new()), directory.path()), usual);
        std::fs::write(
            &settings,
            "# socket = /no\nsensitivity = 1.0\n\tsocket =\n socket\t= /tmp/a b.sock \r\nsocket = /no\n",
        )
        .unwrap();
        let [first, second] = ["/x/named.sock", "/tmp/a b.sock"].map(PathBuf::from);
        assert_eq!(places(None, &settings), [std::slice::from_ref(&second), &usual[..]].concat());
        assert_eq!(places(Some(first.clone().into()), &settings), [&[first, second], &usual[..]].concat());
        assert_eq!(places(Some(USUAL[1].into()), directory.path()), [USUAL[1], USUAL[0]].map(PathBuf::from));
        std::fs::write(&settings, [&b"socket = /"[..], &[b'x'; 100_000]].concat()).unwrap();
        assert!(places(None, &settings)[0].as_os_str().len() < 70_000);
    }
}
