//! The program: reads the command line, carries out the command, reports once.

use command::{Command, Stop};
use rapidity::commands::{check, devices, measure, probe, render, ride, town};
use rapidity::error::Error;
use rapidity::tell;
use std::process::ExitCode;

fn main() -> ExitCode {
    outlive_full_files();
    quieten_mesa();
    quieten_openxr();
    match command::parse_from(std::env::args_os()).map(|command| run(&command)) {
        Ok(Ok(status)) => status,
        Ok(Err(error)) => {
            tell(format_args!("rapidity: {error}"));
            ExitCode::FAILURE
        }
        Err(stop) => report(&stop),
    }
}

/// Prints why there is no command to run. Returns the exit status: 0 for help that was asked for, 2 for a mistake.
fn report(stop: &Stop) -> ExitCode {
    const USAGE: u8 = 2;
    match stop {
        Stop::Help(text) => match text.print() {
            Ok(()) if !text.use_stderr() => ExitCode::SUCCESS,
            _ => ExitCode::from(USAGE),
        },
        Stop::Usage(sentence) => {
            tell(format_args!("rapidity: {sentence}"));
            ExitCode::from(USAGE)
        }
    }
}

fn run(command: &Command) -> Result<ExitCode, Error> {
    match command {
        Command::Ride(options) => {
            limit_threads(options.picture.threads);
            ride::ride(options)?;
        }
        Command::Render(options) => {
            limit_threads(options.picture.threads);
            render::render(options)?;
        }
        Command::Measure(options) => {
            limit_threads(None);
            measure::measure(options)?;
        }
        Command::Town(options) => town::town(options)?,
        Command::Probe => return probe::probe(),
        Command::Devices(options) => devices::devices(options)?,
        Command::Check(options) => check::check(options)?,
    }
    Ok(ExitCode::SUCCESS)
}

/// Sets the number of threads that transform the scene.
fn limit_threads(threads: Option<u32>) {
    /// Largest number of threads that is of use.
    const MOST: usize = 1024;
    let asked = std::env::var("RAYON_NUM_THREADS").ok().and_then(|text| text.parse::<usize>().ok());
    let excessive = asked.is_some_and(|asked| asked > MOST);
    if excessive && threads.is_none() {
        tell(format_args!("RAYON_NUM_THREADS is above {MOST}: {MOST} threads are used"));
    }
    if let Some(threads) = threads.or(excessive.then_some(MOST as u32)) {
        // An error means that the pool is already running, which cannot be before the first command.
        let _ = rayon::ThreadPoolBuilder::new().num_threads(threads as usize).build_global();
    }
}

/// Makes a write beyond the largest size allowed for a file (`ulimit -f`) an error, as on a full disk, instead of the
/// end of the program.
fn outlive_full_files() {
    #[cfg(unix)]
    // SAFETY: to ignore a signal is always sound, and no other thread runs yet.
    unsafe {
        libc::signal(libc::SIGXFSZ, libc::SIG_IGN);
    }
}

/// Keeps the OpenXR loader from complaints of its own where no runtime answers: the program says so in a sentence.
fn quieten_openxr() {
    if std::env::var_os("XR_LOADER_DEBUG").is_none() {
        // SAFETY: no other thread runs yet that could read the environment.
        unsafe { std::env::set_var("XR_LOADER_DEBUG", "none") };
    }
}

/// Sets `XDG_RUNTIME_DIR` if no session has set it. Mesa does not need that directory, but complains on standard
/// error without it.
fn quieten_mesa() {
    if cfg!(target_os = "linux") && std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        // SAFETY: no other thread runs yet that could read the environment.
        unsafe { std::env::set_var("XDG_RUNTIME_DIR", std::env::temp_dir()) };
    }
}
