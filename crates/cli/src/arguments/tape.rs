//! The arguments of `tape`.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};

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
