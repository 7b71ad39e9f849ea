//! Law: a ray-traced scene can be filmed, and Ctrl-C keeps the finished part. A wrong program writes a black picture
//! when nothing was traced, is killed while the scene is prepared, or leaves no film.

use crate::runner::{rapidity, told};
use std::path::Path;
use std::process::{Command, Stdio};

fn traced(arguments: &str, folder: &Path) -> Command {
    rapidity(folder, &arguments.split_whitespace().collect::<Vec<_>>())
}

#[test]
fn a_short_film_is_traced() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = "render --scene lattice --renderer raytrace --size 32x16 --samples 1 --seconds 0.1 --fps 30 \
                     --shutter 1/60 --beta 0,0,-0.5 --out film.mp4";
    let output = traced(arguments, folder.path()).output().unwrap();
    assert!(output.status.success(), "{}", told(&output));
    let pictures = folder.path().join("film.frames");
    let film = folder.path().join("film.mp4");
    // If ffmpeg is missing, there is a folder of pictures instead.
    let there = if pictures.is_dir() { pictures.join("000002.png") } else { film };
    assert!(there.metadata().unwrap().len() > 0, "{}", told(&output));
}

#[test]
fn a_picture_that_is_interrupted_keeps_what_is_done_or_is_not_written() {
    let folder = tempfile::tempdir().unwrap();
    // The picture is so large that it would take hours.
    let arguments = "render --scene lattice --renderer raytrace --size 4096x4096 --samples 64 --out a.png";
    let child = traced(arguments, folder.path()).stderr(Stdio::piped()).spawn().unwrap();
    let mut output = None;
    std::thread::scope(|scope| {
        let id = child.id().to_string();
        let waiter = scope.spawn(move || child.wait_with_output().unwrap());
        // The program handles the signal once it runs; before that the signal ends it, like any program.
        std::thread::sleep(std::time::Duration::from_secs(3));
        assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
        output = Some(waiter.join().unwrap());
    });
    let output = output.unwrap();
    let (said, written) = (told(&output), folder.path().join("a.png").exists());
    if output.status.success() {
        assert!(said.contains("tiles are done, the others are black") && written, "{said}");
    } else {
        assert!(said.contains("interrupted before anything was traced, so nothing was written"), "{said}");
        assert!(!written, "{said}");
    }
}
