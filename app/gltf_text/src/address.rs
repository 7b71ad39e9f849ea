//! Addresses of buffers and pictures: data in the address itself, or a file in the scene's folder.
//!
//! An address in a file that came from anywhere must not open what its author could not know to be there: it leads
//! into the scene's own folder, or nowhere, unless the user trusts the file.

use std::borrow::Cow;
use std::path::{Component, Path, PathBuf};

/// Address as it stands in a file, understood.
#[derive(Debug, PartialEq, Eq)]
pub enum Address {
    /// Bytes that stand in the address.
    Data(Vec<u8>),
    /// Names of a file, relative to the scene's folder; the first that exists is meant.
    File(Vec<PathBuf>),
}

/// Understands an address. With `trust`, a file may lie anywhere.
///
/// # Errors
/// Fault of the address, in words.
pub fn address(uri: &str, trust: bool) -> Result<Address, String> {
    let trimmed = uri.trim_start();
    if let Some(scheme) = trimmed.get(..5)
        && scheme.eq_ignore_ascii_case("data:")
    {
        return data(&trimmed[5..]).map(Address::Data);
    }
    if let Some((scheme, _)) = uri.split_once("://") {
        return Err(format!("an address that begins with {scheme}: is not fetched; put the file beside the scene"));
    }
    // A name may be written raw or percent-encoded, and with the backslashes of another system.
    let decoded = urlencoding::decode(uri).unwrap_or(Cow::Borrowed(uri)).into_owned();
    let mut names: Vec<PathBuf> = Vec::new();
    let mut add = |name: &str| {
        let name = without_detours(Path::new(name));
        if !names.contains(&name) {
            names.push(name);
        }
    };
    for name in [&*decoded, uri, &decoded.replace('\\', "/"), &uri.replace('\\', "/")] {
        add(name);
    }
    // What a server would be asked, or a place within the file.
    if let Some(end) = uri.find(['?', '#']).filter(|&end| end > 0) {
        add(&urlencoding::decode(&uri[..end]).unwrap_or(Cow::Borrowed(&uri[..end])));
    }
    if !trust && !names.iter().all(|name| stays_below(name)) {
        return Err(format!("{uri} is not in the scene's folder; allow it with --trust"));
    }
    Ok(Address::File(names))
}

/// Bytes of a data address, behind its scheme (RFC 2397): base64 of either alphabet, padded or not, with or without
/// line breaks; else percent-encoded. A place within the data (#) is no part of them.
fn data(rest: &str) -> Result<Vec<u8>, String> {
    let (kind, text) = rest.split_once(',').ok_or("its data: address has no comma before the data")?;
    let text = text.split_once('#').map_or(text, |(text, _)| text);
    let encoded = kind.rsplit(';').next().is_some_and(|last| last.trim().eq_ignore_ascii_case("base64"));
    let bytes = urlencoding::decode_binary(text.as_bytes());
    if !encoded {
        return Ok(bytes.into_owned());
    }
    let mut plain = Vec::with_capacity(bytes.len());
    plain.extend(bytes.iter().filter(|byte| !byte.is_ascii_whitespace() && **byte != b'=').map(|byte| match byte {
        b'-' => b'+',
        b'_' => b'/',
        other => *other,
    }));
    let config = base64::STANDARD_NO_PAD.decode_allow_trailing_bits(true);
    base64::decode_config(&plain, config).map_err(|error| format!("its base64 is wrong: {error}"))
}

/// Path without steps into a folder and out again (RFC 3986, 5.2.4).
fn without_detours(path: &Path) -> PathBuf {
    let mut straight = PathBuf::new();
    for part in path.components() {
        let steps_back = matches!(straight.components().next_back(), Some(Component::Normal(_)));
        match part {
            Component::ParentDir if steps_back => drop(straight.pop()),
            Component::CurDir => {}
            part => straight.push(part),
        }
    }
    straight
}

/// True if a relative path stays in the folder that it starts from.
fn stays_below(path: &Path) -> bool {
    path.components().all(|component| matches!(component, Component::Normal(_) | Component::CurDir))
}

#[cfg(test)]
mod tests {
    //! Law: every form of an address gives the same bytes or the file that it names, and none leads out of the folder.
    #![allow(clippy::unwrap_used, reason = "a failed construction is a failed test")]

    use super::*;

    #[test]
    fn every_form_of_data_gives_its_bytes() {
        for uri in [
            "data:application/octet-stream;base64,AP+/fw==",
            "DATA:;BASE64,AP+/fw==",
            "data:;base64,AP+/fw",
            "data:;base64,AP-_fw",
            "data:;base64,AP+/\r\n f w==",
            "data:a/b;charset=x;base64,AP%2B%2Ffw%3D%3D",
            "data:application/gltf-buffer,%00%FF%BF%7F",
            " data:;base64,AP+/fw==#part",
        ] {
            assert_eq!(address(uri, false).unwrap(), Address::Data(vec![0, 255, 191, 127]), "{uri}");
        }
        assert!(address("data:;base64", false).unwrap_err().contains("comma"));
        assert!(address("data:;base64,%%%", false).unwrap_err().contains("base64 is wrong"));
    }

    #[test]
    fn a_file_lies_in_the_folder_or_is_trusted() {
        for outside in ["../a.png", "/etc/passwd", "a/../../b", "%2e%2e/a", "..\\a"] {
            assert!(address(outside, false).unwrap_err().contains("--trust"), "{outside}");
            assert!(address(outside, true).is_ok(), "{outside}");
        }
        let Address::File(names) = address("sub%20a\\b.png", false).unwrap() else { unreachable!("it is a file") };
        assert!(names.contains(&"sub a/b.png".into()) && names.contains(&"sub%20a\\b.png".into()), "{names:?}");
        for (uri, name) in [("./sub/../a.png", "a.png"), ("sub//..\\a.png", "a.png"), ("b.png?v=1#x", "b.png")] {
            let Ok(Address::File(names)) = address(uri, false) else { unreachable!("{uri} is a file in the folder") };
            assert!(names.contains(&name.into()), "{names:?}");
        }
        assert!(address("https://a.b/c", true).unwrap_err().contains("https"));
    }
}
