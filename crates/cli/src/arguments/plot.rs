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
    /// The path as it is driven, coloured by its real speed, with a legend in mm/min
    Speed,
    /// The path as it is driven: corners rounded within the tolerance, or by the lag of an old control's axes; programmed
    /// is then the path of every block. Where it is farthest off is drawn enlarged beside the plan if it is too little to
    /// be seen there
    Actual,
}

/// From where the path is seen.
#[derive(ValueEnum, Debug, Clone, Copy, PartialEq, Eq)]
pub enum ViewArgument {
    /// Plan and isometric, or the plan and its largest deviation enlarged
    Both,
    /// From above only, on a smaller sheet
    Plan,
}

/// A window: X, Y and width in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window(pub [f64; 2], pub f64);

impl std::str::FromStr for Window {
    type Err = String;

    fn from_str(text: &str) -> Result<Window, String> {
        let numbers: Vec<f64> = text.split(',').filter_map(|part| part.trim().parse().ok()).collect();
        match numbers[..] {
            [x, y, width] if text.split(',').count() == 3 && width >= 1e-3 && x.abs().max(y.abs()).max(width) < 1e6 => {
                Ok(Window([x, y], width))
            }
            _ => Err("X, Y and a width of at least 0.001, in mm, such as 20,0,1".to_owned()),
        }
    }
}

/// A part of the time, s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct During(pub [f64; 2]);

impl std::str::FromStr for During {
    type Err = String;

    fn from_str(text: &str) -> Result<During, String> {
        let times =
            text.split_once(',').and_then(|(from, to)| Some([from.trim().parse().ok()?, to.trim().parse().ok()?]));
        match times {
            Some([from, to]) if 0.0 <= from && from < to && to < 1e9 => Ok(During([from, to])),
            _ => Err("two times in s, the earlier first, such as 2.5,4".to_owned()),
        }
    }
}

/// How many times a deviation is drawn.
fn times(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|number| (1.0..=1e6).contains(number));
    number.ok_or_else(|| "a number from 1 to 1000000".to_owned())
}

/// `plot`
#[derive(Args, Debug)]
pub struct PlotArguments {
    /// The program, - for standard input
    pub file: String,
    /// The picture to write: its ending, .svg or .png, says which kind
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// What is drawn, as in programmed,compensated,tool or programmed,actual; what the tool does not fit beside is always
    /// marked
    #[arg(long, value_enum, value_name = "LIST", value_delimiter = ',', default_value = "compensated")]
    pub layers: Vec<LayerArgument>,
    /// From where the path is seen
    #[arg(long, value_enum, value_name = "VIEW", default_value = "both")]
    pub view: ViewArgument,
    /// Only what is around a place, from above: X, Y and width in mm as on the picture's axes, such as 20,0,1
    #[arg(long, value_name = "X,Y,WIDTH", allow_hyphen_values = true, conflicts_with = "view")]
    pub around: Option<Window>,
    /// Draw the deviation of layer actual so many times as large, everywhere
    #[arg(long, value_name = "TIMES", default_value = "1", value_parser = times)]
    pub exaggerate: f64,
    /// Instead of the path, speed and the velocity of every axis over time
    #[arg(long, conflicts_with_all = ["layers", "view", "around", "exaggerate"])]
    pub chart: bool,
    /// Instead of the path, the signals between control and machine over time: codes, strobes, FIN, DEN, inputs
    #[arg(long, conflicts_with_all = ["chart", "layers", "view", "around", "exaggerate"])]
    pub timing: bool,
    /// Only this part of the time, in s, such as 2.5,4
    #[arg(long, value_name = "FROM,TO", requires = "timing")]
    pub during: Option<During>,
    /// Width of a PNG in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 1600, value_parser = clap::value_parser!(u32).range(200..=8000))]
    pub width: u32,
    /// The control and its set-up.
    #[command(flatten)]
    pub setting: SettingArguments,
}
