//! The control, its machine and what is set on both: options that most commands have.

use std::path::{Path, PathBuf};

use clap::Args;

/// The control, its machine, and what is set on both.
#[derive(Args, Debug, Clone)]
pub struct SettingArguments {
    /// The control
    #[arg(long, value_name = "NAME", default_value = "yasnac-mx1")]
    pub control: String,
    /// Take the controls' tables from this folder instead of the built-in ones
    #[arg(long, value_name = "DIR")]
    pub controls: Option<PathBuf>,
    /// The machine builder's file, or the name of a built-in machine [default: the control's stock machine]
    #[arg(long, value_name = "NAME|FILE.toml")]
    pub machine: Option<String>,
    /// Offsets, work coordinates, parameters, switches, start position
    #[arg(long, value_name = "FILE.toml")]
    pub setup: Option<PathBuf>,
    /// One offset in mm, such as 31=10.0
    #[arg(long, value_name = "N=MM", allow_hyphen_values = true)]
    pub offset: Vec<String>,
    /// One work coordinate system in machine mm, such as G54=X100,Y50,Z-20
    #[arg(long, value_name = "Gnn=X…,Y…")]
    pub work: Vec<String>,
    /// One parameter or one bit of it, such as 6005=0b100 or 6005.2=1
    #[arg(long, value_name = "NAME=VALUE")]
    pub parameter: Vec<String>,
    /// A switch that is on: optional-stop, block-delete[=n], single-block, dry-run, machine-lock, display-lock, aux-lock, z-cancel, manual-absolute
    #[arg(long, value_name = "NAME")]
    pub switch: Vec<String>,
    /// Where subprograms are looked up after the file itself and its own folder
    #[arg(long, value_name = "DIR")]
    pub library: Option<PathBuf>,
    /// An option of the control, fitted or not
    #[arg(long, value_name = "NAME=on|off")]
    pub option: Vec<String>,
    /// A behaviour on which the maker's text is silent
    #[arg(long, value_name = "NAME=VALUE")]
    pub policy: Vec<String>,
    /// Run the program this many times in a row, as for so many pieces
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..))]
    pub repeat: u64,
    /// Jumps and macro statements allowed without motion, dwell or stop before the alarm ENDLESS_LOOP
    #[arg(long, value_name = "N", default_value_t = 1_000_000)]
    pub loop_limit: u64,
}

impl SettingArguments {
    /// The files that a command with this program and set-up reads.
    pub fn files<'a>(&'a self, program: &'a str) -> Vec<&'a Path> {
        [Some(Path::new(program)), self.setup.as_deref(), self.machine.as_deref().map(Path::new)]
            .into_iter()
            .flatten()
            .collect()
    }
}
