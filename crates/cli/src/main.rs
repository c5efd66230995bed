//! The `cyclestart` program: reads the command line, opens files, prints. One file a command, no logic of the control.

#![allow(clippy::disallowed_methods, clippy::disallowed_types)] // the edge of the house: files, terminal, exit codes

mod arguments;
mod command;
mod failure;
mod named_programs;
mod output;
mod progress;
mod replace;
mod setting;
mod show_alarm;
mod texts;

use std::panic::{self, AssertUnwindSafe};
use std::process::ExitCode;

use clap::Parser;

use crate::arguments::{Command, CommandLine};
use crate::failure::Failure;
use crate::output::say;

fn main() -> ExitCode {
    panic::set_hook(Box::new(|info| {
        say(&format!(
            "internal error: {info}\nThis is a bug in cyclestart, not in your program. Please report it with the command and its input.\n"
        ));
    }));
    let command_line = CommandLine::parse();
    let outcome = panic::catch_unwind(AssertUnwindSafe(|| run(command_line.command)));
    match outcome {
        Ok(Ok(true)) => ExitCode::SUCCESS,
        Ok(Ok(false)) => ExitCode::from(1),
        Ok(Err(Failure::PipeClosed)) => ExitCode::SUCCESS,
        Ok(Err(Failure::Call(message))) => {
            say(&format!("{message}\n"));
            ExitCode::from(2)
        }
        Err(_) => ExitCode::from(3),
    }
}

/// Runs a command; `false` says that the control raised an alarm.
fn run(command: Command) -> Result<bool, Failure> {
    match command {
        Command::Run(arguments) => command::run::run(&arguments),
        Command::Time(arguments) => command::time::time(&arguments),
        Command::Check(arguments) => command::check::check(&arguments),
        Command::Trace(arguments) => command::trace::trace(&arguments),
        Command::Operate(arguments) => command::operate::operate(&arguments),
        Command::Memory(command) => command::memory::memory(&command),
        Command::Tape(arguments) => command::tape::tape(&arguments),
        Command::Plot(arguments) => command::plot::plot(&arguments),
        Command::Explain(arguments) => command::explain::explain(&arguments),
        Command::Sheet(arguments) => command::sheet::sheet(&arguments),
        Command::Fmt(arguments) => command::fmt::fmt(&arguments),
        Command::Diff(arguments) => command::diff::diff(&arguments),
        Command::Controls(arguments) => command::controls::controls(&arguments),
    }
}
