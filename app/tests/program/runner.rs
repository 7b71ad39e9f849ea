//! The program as a process: started here and nowhere else.

use std::path::Path;
use std::process::{Command, Output};

/// Command that runs the program in a folder, without a graphical session.
pub fn rapidity(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rapidity"));
    command.args(arguments).current_dir(folder).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    command
}

/// Result of running the program in a folder to its end, without a graphical session.
pub fn run(folder: &Path, arguments: &[&str]) -> Output {
    rapidity(folder, arguments).output().expect("the program starts")
}

/// Text that the program wrote to standard output.
pub fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Text that the program wrote to standard error.
pub fn told(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}
