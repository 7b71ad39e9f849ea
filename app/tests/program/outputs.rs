//! Law: what the program says of its files is true, a file is whole or not there, and work matters more than the
//! notices about it.

use crate::runner::{rapidity, told};
use std::fs::{self, File};
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Stdio;

const SMALL: [&str; 6] = ["--scene", "lattice", "--size", "64x36", "--samples", "1"];

fn render<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&["render"], &SMALL[..], more].concat()
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// Folder with a program `ffmpeg`, for the PATH.
fn with_ffmpeg(script: &str, mode: u32) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ffmpeg");
    fs::write(&path, script).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(mode)).unwrap();
    folder
}

/// A full log disk and a closed pipe must not keep a picture from being drawn.
#[test]
fn notices_that_cannot_be_written_stop_no_work() {
    let folder = tempfile::tempdir().unwrap();
    let full = || Stdio::from(File::options().write(true).open("/dev/full").unwrap());
    let closed = || {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        Stdio::from(writer)
    };
    for (name, stderr) in [("full.png", full()), ("closed.png", closed())] {
        let status = rapidity(folder.path(), &render(&["--out", name])).stderr(stderr).status().unwrap();
        assert!(status.success(), "{name}: {status}");
        assert!(image::open(folder.path().join(name)).is_ok());
    }
    // Errors keep their status.
    for (arguments, status) in
        [(&["render", "--scene", "nowhere.glb", "--out", "a.png"][..], 1), (&["ride", "--verify"], 2)]
    {
        let output = rapidity(folder.path(), arguments).stderr(full()).status().unwrap();
        assert_eq!(output.code(), Some(status), "{arguments:?}");
    }
}

#[test]
fn an_encoder_that_cannot_be_started_is_told_with_the_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let path = with_ffmpeg("", 0o644);
    let film = render(&["--seconds", "0.2", "--out", "a.mp4"]);
    let output = rapidity(folder.path(), &film).env("PATH", path.path()).output().unwrap();
    let told = told(&output);
    assert_eq!(output.status.code(), Some(1), "{told}");
    assert!(told.contains("ffmpeg cannot be started") && told.contains("take it off the PATH"), "{told}");
    assert_eq!(names(folder.path()), Vec::<String>::new());
}

#[test]
fn an_encoder_that_is_killed_leaves_the_old_film_and_is_told() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.mp4"), "old").unwrap();
    let path = with_ffmpeg("#!/bin/sh\nfor last; do :; done\necho half > \"$last\"\nkill -9 $$\n", 0o755);
    let film = render(&["--seconds", "1", "--out", "a.mp4"]);
    let output = rapidity(folder.path(), &film).env("PATH", path.path()).output().unwrap();
    let told = told(&output);
    assert_eq!(output.status.code(), Some(1), "{told}");
    assert!(told.contains("ffmpeg was ended by signal 9 before a.mp4 was whole") && !told.contains("wrote"), "{told}");
    assert_eq!(
        (fs::read_to_string(folder.path().join("a.mp4")).unwrap(), names(folder.path()).len()),
        ("old".to_owned(), 1)
    );
}

#[test]
fn a_folder_that_goes_while_filming_is_told() {
    // Whoever removes the folder is the encoder itself, after the last frame.
    for (script, words) in [
        ("#!/bin/sh\n/bin/cat > /dev/null\n/bin/rm -r \"$PWD/out\"\n", "out/a.mp4: could not be written"),
        ("#!/bin/sh\n/bin/cat > /dev/null\n", "out/a.mp4: could not be written"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("out")).unwrap();
        let path = with_ffmpeg(script, 0o755);
        let film = render(&["--seconds", "0.2", "--out", "out/a.mp4"]);
        let output = rapidity(folder.path(), &film).env("PATH", path.path()).output().unwrap();
        let told = told(&output);
        assert_eq!(output.status.code(), Some(1), "{told}");
        assert!(told.contains(words) && !told.contains("wrote"), "{told}");
    }
}

#[test]
fn numbered_pictures_are_those_of_the_last_film() {
    let folder = tempfile::tempdir().unwrap();
    let no_ffmpeg = tempfile::tempdir().unwrap();
    let film = |seconds| {
        let film = render(&["--seconds", seconds, "--fps", "10", "--out", "a.mp4"]);
        rapidity(folder.path(), &film).env("PATH", no_ffmpeg.path()).output().unwrap()
    };
    let pictures = folder.path().join("a.frames");
    assert!(film("0.5").status.success());
    assert_eq!(names(&pictures).len(), 5);
    fs::write(pictures.join("notes.png"), "mine").unwrap();
    assert!(film("0.2").status.success());
    assert_eq!(names(&pictures), ["000000.png", "000001.png", "notes.png"]);
}

#[test]
fn a_picture_that_cannot_be_written_leaves_the_old_one() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.png"), "old").unwrap();
    // A file may hold no more than one block.
    let mut shell = std::process::Command::new("sh");
    shell.args(["-c", "ulimit -f 1; exec \"$0\" \"$@\"", env!("CARGO_BIN_EXE_rapidity")]);
    shell.args(["render", "--scene", "lattice", "--size", "640x360", "--samples", "1", "--out", "a.png"]);
    let output = shell.current_dir(folder.path()).env_remove("DISPLAY").output().unwrap();
    let told = told(&output);
    assert_eq!(output.status.code(), Some(1), "{told}");
    assert!(told.contains("a.png: could not be written"), "{told}");
    assert_eq!(
        (fs::read_to_string(folder.path().join("a.png")).unwrap(), names(folder.path()).len()),
        ("old".to_owned(), 1)
    );
}
