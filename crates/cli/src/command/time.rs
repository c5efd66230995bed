//! `time`: where the cycle time goes, and which blocks lose most of it.

use std::io::Write;

use report::{time_text, why_text};

use super::run::run_timed;
use crate::arguments::TimeArguments;
use crate::failure::Failure;
use crate::output::paint_out;

/// Blocks that are told.
const BLOCKS: usize = 5;

pub fn time(arguments: &TimeArguments) -> Result<bool, Failure> {
    let mut ran = run_timed(&arguments.file, &arguments.setting, arguments.why)?;
    let why = ran.losses.take().map(|losses| {
        let worst = losses.worst(&mut ran.session, BLOCKS, |texts, source, at, len| texts.excerpt(source, at, len));
        (worst, losses.by_cause())
    });
    let summary = &ran.summary;
    let text = match (arguments.json, &why) {
        (true, Some((worst, by_cause))) => summary.json_with_losses(worst, by_cause) + "\n",
        (true, None) => summary.json() + "\n",
        (false, Some((worst, by_cause))) => time_text(summary, paint_out()) + &why_text(worst, by_cause, paint_out()),
        (false, None) => time_text(summary, paint_out()),
    };
    std::io::stdout().lock().write_all(text.as_bytes())?;
    Ok(!ran.alarmed)
}
