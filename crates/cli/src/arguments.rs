//! The command line: every command, every option, its help and an example.

mod diff;
mod memory;
mod plot;

use std::path::{Path, PathBuf};

use clap::{Args, Parser, Subcommand, ValueEnum};

pub use diff::{DiffArguments, DiffFormat};
pub use memory::{ExportArguments, ExportForm, HistoryArguments, ImportArguments, MemoryCommand};
pub use plot::{LayerArgument, PlotArguments, ViewArgument};

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

/// `operate`
#[derive(Args, Debug)]
pub struct OperateArguments {
    /// The operator's script, - for standard input
    pub script: String,
    /// The machine's answers to codes are events too
    #[arg(long)]
    pub io: bool,
    /// Keep the control's memory in this folder from one call to the next, without DIR in the user's data folder; without
    /// the option memory begins empty and is forgotten
    #[arg(long, value_name = "DIR")]
    pub memory: Option<Option<PathBuf>>,
    /// Time passes by the clock; lines on standard input act as they come
    #[arg(long)]
    pub realtime: bool,
    /// With --realtime: print the displays (position, state, feed, modal) so many times a second
    #[arg(long, value_name = "HZ", requires = "realtime", value_parser = frequency)]
    pub displays: Option<f64>,
    /// The control and its set-up.
    #[command(flatten)]
    pub setting: SettingArguments,
}

/// `tape`
#[derive(Subcommand, Debug)]
pub enum TapeCommand {
    /// Read the image of a tape to text; name every damaged character
    #[command(
        after_help = "Exit codes: 0 done; 1 the tape is damaged (the text is written all the same); 2 the call is wrong.\n\n\
                            Example:\n  cyclestart tape read part.eia -o part.nc"
    )]
    Read(TapeReadArguments),
    /// Punch a text: write the image of its tape, one byte a row
    #[command(after_help = "Example:\n  cyclestart tape punch part.nc --code eia -o part.eia --draw")]
    Punch(TapePunchArguments),
}

/// The codes of a tape that is read.
#[derive(ValueEnum, Debug, Clone, Copy, PartialEq, Eq)]
pub enum CodeArgument {
    /// By the first end of block.
    Auto,
    /// ISO 840.
    Iso,
    /// EIA RS-244.
    Eia,
}

/// The codes in which tapes are punched.
#[derive(ValueEnum, Debug, Clone, Copy, PartialEq, Eq)]
pub enum PunchCodeArgument {
    /// ISO 840.
    Iso,
    /// EIA RS-244.
    Eia,
}

/// On or off.
#[derive(ValueEnum, Debug, Clone, Copy, PartialEq, Eq)]
pub enum OnOff {
    On,
    Off,
}

/// Whose tapes, and how they are shown.
#[derive(Args, Debug)]
pub struct TapeArguments {
    /// Draw the tape in characters: a line a row, holes, character, what is wrong
    #[arg(long)]
    pub draw: bool,
    /// Draw the tape true to scale
    #[arg(long, value_name = "OUT.svg")]
    pub svg: Option<PathBuf>,
    /// The control whose tape it is
    #[arg(long, value_name = "NAME", default_value = "yasnac-mx1")]
    pub control: String,
    /// Take the controls' tables from this folder instead of the built-in ones
    #[arg(long, value_name = "DIR")]
    pub controls: Option<PathBuf>,
    /// One parameter, such as "eia code of equals sign=0b00001101"
    #[arg(long, value_name = "NAME=VALUE")]
    pub parameter: Vec<String>,
}

/// `tape read`
#[derive(Args, Debug)]
pub struct TapeReadArguments {
    /// The image of the tape, one byte a row, - for standard input
    pub file: String,
    /// The text to write [default: standard output, unless the tape is drawn]
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
    /// The code of the tape
    #[arg(long, value_enum, default_value = "auto")]
    pub code: CodeArgument,
    /// The check of block parity [default: as the control's parameter says]
    #[arg(long, value_enum)]
    pub tv: Option<OnOff>,
    /// Whose tape, and how it is shown.
    #[command(flatten)]
    pub tape: TapeArguments,
}

/// `tape punch`
#[derive(Args, Debug)]
pub struct TapePunchArguments {
    /// The text, - for standard input
    pub file: String,
    /// The image to write
    #[arg(short, long, value_name = "OUT")]
    pub output: Option<PathBuf>,
    /// The code to punch
    #[arg(long, value_enum)]
    pub code: PunchCodeArgument,
    /// A blank makes blocks with an odd number of characters even, for the check of block parity
    #[arg(long, value_enum, default_value = "off")]
    pub tv: OnOff,
    /// Rows of blank tape before and behind the program; ten are an inch
    #[arg(long, value_name = "ROWS", default_value_t = 100, value_parser = clap::value_parser!(u32).range(..=100_000))]
    pub leader: u32,
    /// Whose tape, and how it is shown.
    #[command(flatten)]
    pub tape: TapeArguments,
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

/// So many times a second.
fn frequency(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(hz) if hz > 0.0 && hz <= 1000.0 => Ok(hz),
        _ => Err("a number above 0, at most 1000".to_owned()),
    }
}
