//! The command line: every command, every option, its help and an example.

mod diff;
mod memory;
mod operate;
mod plot;
mod setting;
mod tape;

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

pub use diff::{DiffArguments, DiffFormat};
pub use memory::{ExportArguments, ExportForm, HistoryArguments, ImportArguments, MemoryCommand};
pub use operate::OperateArguments;
pub use plot::{LayerArgument, PlotArguments, ViewArgument};
pub use setting::SettingArguments;
pub use tape::{
    CodeArgument, OnOff, PunchCodeArgument, TapeArguments, TapeCommand, TapePunchArguments, TapeReadArguments,
};

/// Executes part programs exactly as the machining-centre controls they were written for would.
#[derive(Parser, Debug)]
#[command(
    name = "cyclestart",
    version,
    max_term_width = 100,
    after_help = "Exit codes: 0 done; 1 the control raised an alarm; 2 the call is wrong; 3 internal error.\n\n\
                  Example:\n  cyclestart run examples/plate.nc --offset 1=120 --offset 31=8"
)]
pub struct CommandLine {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The commands.
#[derive(Subcommand, Debug)]
pub enum Command {
    /// Run a program on the virtual machine to its end, with progress and a summary
    #[command(
        after_help = "The time left on the terminal is that of the run itself: a run that is not over after half a second is first run through once without times, to count its work (that takes a fifth to a third of the run). Of standard input only the blocks done are known.\n\nExample:\n  cyclestart run part.nc --setup part.setup.toml --switch optional-stop"
    )]
    Run(RunArguments),
    /// Say where the cycle time goes: by kind of move, tool and operation; which blocks lose most, and why
    #[command(
        after_help = "An operation begins with a tool change or with a remark on a line of its own, which names it; where none does, a subprogram is one, or a canned cycle. Lost is what of cutting and rapid is more than at F, or at the rapid rate, throughout.\n\nExamples:\n  cyclestart time part.nc --setup part.setup.toml\n  cyclestart time part.nc --setup part.setup.toml --why"
    )]
    Time(TimeArguments),
    /// Find every alarm the control would raise and what is legal and dangerous, without motion
    #[command(
        after_help = "Warnings alone end with exit code 0; see --deny and --allow.\n\nExample:\n  cyclestart check programs/ --format github --deny integer-coordinate"
    )]
    Check(CheckArguments),
    /// Print every executed event as JSON Lines
    #[command(after_help = "Example:\n  cyclestart trace part.nc --time | head")]
    Trace(TraceArguments),
    /// Perform an operator's script and print the events as JSON Lines
    #[command(
        after_help = "Example:\n  printf 'load part.nc as O1\\nselect O1\\ncycle-start\\nrun until stop\\nshow modal\\n' | cyclestart operate -"
    )]
    Operate(OperateArguments),
    /// Export and import what `operate --memory` keeps, as text; print its histories
    #[command(subcommand)]
    #[command(after_help = "Example:\n  cyclestart memory export DIR -o backup.toml")]
    Memory(MemoryCommand),
    /// Draw the tool path as SVG or PNG
    #[command(
        after_help = "Examples:\n  cyclestart plot part.nc -o part.svg\n  cyclestart plot part.nc --layers programmed,compensated,tool -o part.svg\n  cyclestart plot part.nc --layers speed --view plan -o speed.svg\n  cyclestart plot part.nc --layers programmed,actual --around 20,0,1 -o corner.svg\n  cyclestart plot part.nc --chart -o chart.svg"
    )]
    Plot(PlotArguments),
    /// Read images of punched tape (EIA RS-244, ISO 840) to text, and punch text
    #[command(subcommand)]
    #[command(after_help = "Example:\n  cyclestart tape punch part.nc --code eia -o part.eia --draw")]
    Tape(TapeCommand),
    /// Say what every word of a block does under this control, and what the block changes
    #[command(
        after_help = "Examples:\n  cyclestart explain part.nc:64 --setup part.setup.toml\n  echo 'G91 G28 Z0' | cyclestart explain -"
    )]
    Explain(ExplainArguments),
    /// Print the set-up sheet: tools, offsets, work systems, codes, stops, times
    #[command(
        after_help = "Examples:\n  cyclestart sheet part.nc --setup part.setup.toml\n  cyclestart sheet part.nc --setup part.setup.toml -o part.html"
    )]
    Sheet(SheetArguments),
    /// Rewrite programs in house style, proved to run as before
    #[command(
        after_help = "Examples:\n  cyclestart fmt programs/ --check\n  cyclestart fmt part.nc --number 10,10 -o part-numbered.nc"
    )]
    Fmt(FmtArguments),
    /// Say what changes at the machine between two programs, or between two controls
    #[command(
        after_help = "Axes, codes, dwells, stops and alarms are compared, not times. Exit codes: 0 the same at the machine; 1 different; 2 the call is wrong.\n\nExamples:\n  cyclestart diff old.nc new.nc --setup part.setup.toml\n  cyclestart diff part.nc --control-a yasnac-mx1 --control-b incon-m84 --setup-b m84.setup.toml"
    )]
    Diff(DiffArguments),
    /// List the controls, or print one control's tables
    #[command(after_help = "Example:\n  cyclestart controls yasnac-mx1")]
    Controls(ControlsArguments),
}

/// `run`
#[derive(Args, Debug)]
pub struct RunArguments {
    /// The program, - for standard input
    pub file: String,
    /// Print the summary as JSON
    #[arg(long)]
    pub json: bool,
    /// The control and its set-up.
    #[command(flatten)]
    pub setting: SettingArguments,
}

/// `time`
#[derive(Args, Debug)]
pub struct TimeArguments {
    /// The program, - for standard input
    pub file: String,
    /// Also the five blocks that lose most time, what holds them, and what would help
    #[arg(long)]
    pub why: bool,
    /// Print the object of `run --json`, with --why also the blocks
    #[arg(long)]
    pub json: bool,
    /// The control and its set-up.
    #[command(flatten)]
    pub setting: SettingArguments,
}

/// How diagnostics are printed.
#[derive(ValueEnum, Debug, Clone, Copy, PartialEq, Eq)]
pub enum FormatArgument {
    /// For people.
    Text,
    /// A JSON array.
    Json,
    /// SARIF 2.1.0.
    Sarif,
    /// Annotations for a forge.
    Github,
}

/// `check`
#[derive(Args, Debug)]
pub struct CheckArguments {
    /// Programs, folders or patterns, - for standard input
    #[arg(required = true)]
    pub files: Vec<String>,
    /// How findings are printed
    #[arg(long, value_enum, default_value = "text")]
    pub format: FormatArgument,
    /// A warning that counts as an error, or all; a single name is stronger than all
    #[arg(long, value_name = "NAME")]
    pub deny: Vec<String>,
    /// A warning that is not given, or all; in a program (allow: NAME) says so for its block
    #[arg(long, value_name = "NAME")]
    pub allow: Vec<String>,
    /// Write refused blocks as the control takes them, where it is evident what is meant; what is left is then told
    #[arg(long)]
    pub fix: bool,
    /// Run under every combination of the parameters for power-on and reset, and say what differs at the machine
    #[arg(long)]
    pub all_power_on: bool,
    /// Elements of a contour before and behind each that gouge-ahead holds against the tool's way beside it; 0 for none
    #[arg(long, value_name = "ELEMENTS", default_value_t = 64, value_parser = clap::value_parser!(u32).range(0..=4096))]
    pub look_ahead: u32,
    /// The control and its set-up.
    #[command(flatten)]
    pub setting: SettingArguments,
}

/// `trace`
#[derive(Args, Debug)]
pub struct TraceArguments {
    /// The program, - for standard input
    pub file: String,
    /// Every event carries its virtual time
    #[arg(long)]
    pub time: bool,
    /// The machine's answers to codes are events too
    #[arg(long)]
    pub io: bool,
    /// The control and its set-up.
    #[command(flatten)]
    pub setting: SettingArguments,
}

/// How an explanation is printed.
#[derive(ValueEnum, Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExplainFormat {
    /// For people.
    Text,
    /// A JSON array, one object a block.
    Json,
}

/// `explain`
#[derive(Args, Debug)]
pub struct ExplainArguments {
    /// The line of a program, - for blocks typed on standard input
    #[arg(value_name = "FILE:LINE")]
    pub place: String,
    /// Which execution of the block is meant
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..))]
    pub pass: u64,
    /// How the explanation is printed
    #[arg(long, value_enum, default_value = "text")]
    pub format: ExplainFormat,
    /// The control and its set-up.
    #[command(flatten)]
    pub setting: SettingArguments,
}

/// How a set-up sheet is printed.
#[derive(ValueEnum, Debug, Clone, Copy, PartialEq, Eq)]
pub enum SheetFormat {
    /// For the terminal.
    Text,
    /// A JSON object.
    Json,
    /// A page for the printer, A4.
    Html,
}

/// `sheet`
#[derive(Args, Debug)]
pub struct SheetArguments {
    /// The program, - for standard input
    pub file: String,
    /// How the sheet is printed [default: by the ending of OUT, text without one]
    #[arg(long, value_enum)]
    pub format: Option<SheetFormat>,
    /// The file to write instead of standard output, - for that
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
    /// The control and its set-up.
    #[command(flatten)]
    pub setting: SettingArguments,
}

/// `fmt`
#[derive(Args, Debug)]
pub struct FmtArguments {
    /// Programs, folders or patterns, - for standard input (the result goes to standard output)
    #[arg(required = true)]
    pub files: Vec<String>,
    /// Write nothing: print what would change, and fail if anything would
    #[arg(long)]
    pub check: bool,
    /// New sequence numbers for every block, as 10,10: the first, and the step; jumps are led to them
    #[arg(long, value_name = "START,STEP")]
    pub number: Option<String>,
    /// Write the one program here instead of over itself, - for standard output
    #[arg(short, long, value_name = "OUT", conflicts_with = "check")]
    pub output: Option<String>,
    /// The control and its set-up.
    #[command(flatten)]
    pub setting: SettingArguments,
}

/// `controls`
#[derive(Args, Debug)]
pub struct ControlsArguments {
    /// The control whose tables are printed
    pub name: Option<String>,
    /// Which rows of its tables are guarded by a case of the corpus, which wait, which have none (exit code 1)
    #[arg(long, requires = "name")]
    pub coverage: bool,
    /// The folder of the corpus, for --coverage
    #[arg(long, value_name = "DIR", default_value = "cases")]
    pub cases: PathBuf,
    /// Take the controls' tables from this folder instead of the built-in ones
    #[arg(long, value_name = "DIR")]
    pub controls: Option<PathBuf>,
}
