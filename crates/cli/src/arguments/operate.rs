//! The arguments of `operate`.

use std::path::PathBuf;

use clap::Args;

use super::SettingArguments;

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

/// So many times a second.
fn frequency(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(hz) if hz > 0.0 && hz <= 1000.0 => Ok(hz),
        _ => Err("a number above 0, at most 1000".to_owned()),
    }
}
