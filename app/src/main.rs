//! The program: reads the command line, carries out the command, reports once.

use rapidity::command::{self, Command};
use rapidity::error::Error;
use rapidity::render;
use std::process::ExitCode;

fn main() -> ExitCode {
    match command::parse() {
        Ok(command) => match run(&command) {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => {
                eprintln!("rapidity: {error}");
                ExitCode::FAILURE
            }
        },
        Err(status) => status,
    }
}

fn run(command: &Command) -> Result<(), Error> {
    match command {
        Command::Render(options) => render::render(options),
        _ => Ok(()),
    }
}
