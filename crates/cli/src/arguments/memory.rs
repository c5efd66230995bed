//! The arguments of `memory`.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};

use super::SettingArguments;

/// `memory`
#[derive(Subcommand, Debug)]
pub enum MemoryCommand {
    /// Write all that a memory holds as text
    #[command(
        after_help = "Examples:\n  cyclestart memory export DIR -o backup.toml\n  cyclestart memory export DIR --form tape -o backup.nc"
    )]
    Export(ExportArguments),
    /// Read a text that was exported: what it names takes the place of what the memory holds
    #[command(
        after_help = "Of an export (TOML) the memory holds afterwards exactly what it says. Of a tape its programs are loaded and its data blocks carried out; what it does not name stays.\n\nExample:\n  cyclestart memory import DIR backup.toml"
    )]
    Import(ImportArguments),
    /// Print the histories: alarms, and which program ran when
    #[command(after_help = "Example:\n  cyclestart memory history DIR")]
    History(HistoryArguments),
}

/// The forms of an export.
#[derive(ValueEnum, Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExportForm {
    /// Everything, as TOML.
    Text,
    /// As the control punches it: programs under their O numbers, offsets and origins as G10, variables as macro
    /// statements, between % signs; parameters and histories are left out.
    Tape,
}

/// `memory export`
#[derive(Args, Debug)]
pub struct ExportArguments {
    /// The memory's folder
    pub folder: PathBuf,
    /// The text to write [default: standard output]
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
    /// The form of the text
    #[arg(long, value_enum, default_value = "text")]
    pub form: ExportForm,
    /// Take the controls' tables from this folder instead of the built-in ones
    #[arg(long, value_name = "DIR")]
    pub controls: Option<PathBuf>,
}

/// `memory import`
#[derive(Args, Debug)]
pub struct ImportArguments {
    /// The memory's folder
    pub folder: PathBuf,
    /// The text to read, - for standard input
    pub file: String,
    /// Of a tape: the control that reads it.
    #[command(flatten)]
    pub setting: SettingArguments,
}

/// `memory history`
#[derive(Args, Debug)]
pub struct HistoryArguments {
    /// The memory's folder
    pub folder: PathBuf,
}
