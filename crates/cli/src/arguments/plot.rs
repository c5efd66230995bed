//! The arguments of `plot`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::SettingArguments;

/// A layer of a picture.
#[derive(ValueEnum, Debug, Clone, Copy, PartialEq, Eq)]
pub enum LayerArgument {
    /// The programmed contour of blocks under tool radius compensation
    Programmed,
    /// The path that runs, that of the tool's centre under compensation
    Compensated,
    /// Under compensation the tool at the ends of its moves, and the area that it sweeps
    Tool,
}

/// `plot`
#[derive(Args, Debug)]
pub struct PlotArguments {
    /// The program, - for standard input
    pub file: String,
    /// The picture to write: its ending, .svg or .png, says which kind
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// What is drawn, as in programmed,compensated,tool; what the tool does not fit beside is always marked
    #[arg(long, value_enum, value_name = "LIST", value_delimiter = ',', default_value = "compensated")]
    pub layers: Vec<LayerArgument>,
    /// Width of a PNG in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 1600, value_parser = clap::value_parser!(u32).range(200..=8000))]
    pub width: u32,
    /// The control and its set-up.
    #[command(flatten)]
    pub setting: SettingArguments,
}
