//! `diff`: what changes at the machine from one program to another, or from one control to another.

use report::{Limits, compare, comparison_json, comparison_text};
use station::{Configuration, Session};

use super::open;
use crate::arguments::{DiffArguments, DiffFormat, SettingArguments};
use crate::failure::Failure;
use crate::output::{Output, paint_out};
use crate::texts::Texts;

/// Nanometres and microdegrees in the units of events.
const COUNTS: f64 = 1e-6;

pub fn diff(arguments: &DiffArguments) -> Result<bool, Failure> {
    if arguments.is_one_thing() {
        return Err(Failure::call(
            "nothing to compare: name a second program, or what one side has of its own, as in --control-b NAME",
        ));
    }
    let files = [&arguments.first, arguments.second.as_ref().unwrap_or(&arguments.first)];
    if files.iter().all(|file| *file == "-") {
        return Err(Failure::call("standard input can be read once: name a file for one of the two"));
    }
    let [a, b] = arguments.settings();
    let (mut first, mut second) = (open_side("A", files[0], &a)?, open_side("B", files[1], &b)?);
    let sides = [first.configuration().clone(), second.configuration().clone()];
    let limits = Limits {
        tolerance: arguments.tolerance.unwrap_or_else(|| least_increment(&sides)),
        window: usize::try_from(arguments.window).unwrap_or(usize::MAX),
        shown: arguments.show,
        pieces: arguments.setting.repeat,
    };
    let comparison = compare(&mut first, &mut second, &limits, |texts, source, at, len| texts.excerpt(source, at, len))
        .map_err(Failure::call)?;
    let named = [(files[0].as_str(), &sides[0]), (files[1].as_str(), &sides[1])];
    let mut output = Output::new();
    output.buffer = match arguments.format {
        DiffFormat::Text => comparison_text(&comparison, named, paint_out()),
        DiffFormat::Json => comparison_json(&comparison, named) + "\n",
    }
    .into_bytes();
    output.flush()?;
    Ok(comparison.is_same())
}

/// The set-up of one side; what is wrong with it says whose it is.
fn open_side(letter: &str, file: &str, setting: &SettingArguments) -> Result<Session<Texts>, Failure> {
    open(file, setting).map_err(|failure| match failure {
        Failure::Call(message) => {
            Failure::call(format!("of {letter}: {}", message.strip_prefix("error: ").unwrap_or(&message)))
        }
        other => other,
    })
}

/// What counts as one place: the coarser of the two controls' least increments, metric.
fn least_increment(sides: &[Configuration; 2]) -> f64 {
    sides.iter().map(|side| side.control.increments[0] as f64 * COUNTS).fold(0.0, f64::max)
}
