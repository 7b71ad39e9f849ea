//! The program as a process: started here and nowhere else.

use std::path::Path;
use std::process::{Command, Output};

/// Setting that makes glibc take the processor for one without fused multiplication; other systems ignore it.
pub const WITHOUT_FMA: (&str, &str) = ("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F");

/// Command that runs the program in a folder, without a graphical session.
pub fn rapidity(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rapidity"));
    command.args(arguments).current_dir(folder).env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    // Never the folders of whoever runs the tests; one cache for all of them, since the town is always the same.
    command.env("XDG_CACHE_HOME", Path::new(env!("CARGO_TARGET_TMPDIR")).join("cache"));
    command.env("XDG_STATE_HOME", folder.join("state"));
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
