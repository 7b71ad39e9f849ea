//! Law: the old town looks the same to the byte whether its pictures are painted, or come from the cache. A wrong
//! program would show torn pictures after a crash, fail where nothing can be written, or paint anew at every start.

use crate::runner::{rapidity, told};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Command that draws a small picture of the town, with its cache in `cache`.
fn draws(folder: &Path, cache: &Path, name: &str, more: &[&str]) -> Command {
    let arguments = [&["render", "--size", "48x32", "--out", name], more].concat();
    let mut command = rapidity(folder, &arguments);
    command.env("XDG_CACHE_HOME", cache);
    command
}

/// Bytes of the picture that a finished program has drawn.
fn drawn(folder: &Path, name: &str, output: &Output) -> Vec<u8> {
    assert!(output.status.success(), "{}", told(output));
    fs::read(folder.join(name)).unwrap()
}

/// Files of the cache.
fn kept(cache: &Path) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(cache.join("rapidity")) else { return Vec::new() };
    entries.map(|entry| entry.unwrap().path()).collect()
}

#[test]
fn a_town_from_the_cache_is_the_painted_one_whatever_became_of_the_cache() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let cache = folder.join("cache");
    let picture = |name: &str, more: &[&str]| drawn(folder, name, &draws(folder, &cache, name, more).output().unwrap());
    let painted = picture("no-cache.png", &["--no-cache"]);
    assert!(kept(&cache).is_empty(), "--no-cache keeps nothing");

    // Several programs that start at once, without a cache.
    let names = ["a.png", "b.png", "c.png"];
    let started = names.map(|name| draws(folder, &cache, name, &[]).stderr(std::process::Stdio::piped()).spawn());
    for (name, child) in names.iter().zip(started) {
        let output = child.unwrap().wait_with_output().unwrap();
        assert!(drawn(folder, name, &output) == painted, "{name} is another picture");
    }
    let files = kept(&cache);
    assert_eq!(files.len(), 1, "{files:?}");
    let whole = fs::read(&files[0]).unwrap();
    assert!(picture("again.png", &[]) == painted);

    // A file that was cut, then one with a flipped bit: painted anew, and kept whole again.
    let mut flipped = whole.clone();
    flipped[whole.len() / 2] ^= 1;
    for damaged in [&whole[..whole.len() / 3], &flipped] {
        fs::write(&files[0], damaged).unwrap();
        assert!(picture("damaged.png", &[]) == painted);
        assert!(fs::read(&files[0]).unwrap() == whole, "the cache is mended");
    }
}

#[test]
fn a_cache_that_cannot_be_written_is_no_fault() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let cache = folder.join("cache");
    let file = cache.join("rapidity");
    fs::create_dir(&cache).unwrap();
    fs::write(&file, "in the way").unwrap();
    let output = draws(folder, &cache, "a.png", &[]).output().unwrap();
    drawn(folder, "a.png", &output);
    assert!(!told(&output).contains("cache"), "{}", told(&output));
    assert_eq!(fs::read_to_string(&file).unwrap(), "in the way");
}
