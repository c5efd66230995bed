//! `explain`: what every word of a block does, by running the program up to it.

use std::collections::BTreeMap;

use base::{Place, SourceId};
use report::{Explanation, Wanted, Watch, explanation_json, explanation_text};
use station::{AfterAlarm, Configuration, Session, blocks_of};
use syntax::Cursor;

use super::open;
use crate::arguments::{ExplainArguments, ExplainFormat};
use crate::failure::Failure;
use crate::output::{Output, paint_out};
use crate::show_alarm::show_alarm;
use crate::texts::Texts;

/// The program's own text.
const OWN: SourceId = SourceId(0);

pub fn explain(arguments: &ExplainArguments) -> Result<bool, Failure> {
    let mut output = Output::new();
    let explanations = if arguments.place == "-" {
        let mut session = open("-", &arguments.setting)?;
        session.set_after_alarm(AfterAlarm::GoOn);
        explain_found(&mut session, "<stdin>", Wanted::All, None)?
    } else {
        explain_line(arguments)?
    };
    let session = open_control(arguments)?;
    let (control, axes) = (&session.control, &session.machine.axes);
    for (index, explanation) in explanations.iter().enumerate() {
        let text = match arguments.format {
            ExplainFormat::Text => explanation_text(explanation, control, axes, paint_out()),
            ExplainFormat::Json => explanation_json(explanation, control, axes),
        };
        let gap = match arguments.format {
            ExplainFormat::Text if index == 0 => "",
            ExplainFormat::Text => "\n\n",
            ExplainFormat::Json if index == 0 => "[",
            ExplainFormat::Json => ",\n",
        };
        output.buffer.extend_from_slice(gap.as_bytes());
        output.buffer.extend_from_slice(text.as_bytes());
        output.pass()?;
    }
    if arguments.format == ExplainFormat::Json {
        let close: &[u8] = if explanations.is_empty() { b"[]\n" } else { b"]\n" };
        output.buffer.extend_from_slice(close);
    }
    output.flush()?;
    Ok(explanations.iter().all(|explanation| explanation.alarm.is_none()))
}

fn open_control(arguments: &ExplainArguments) -> Result<station::Configuration, Failure> {
    crate::setting::configuration(&arguments.setting)
}

/// `part.nc:64` as a file and a line.
fn file_and_line(place: &str) -> Result<(&str, u64), Failure> {
    let wrong = || Failure::call(format!("explain {place}: write FILE:LINE, as in part.nc:12, or - for typed blocks"));
    let (file, line) = place.rsplit_once(':').ok_or_else(wrong)?;
    match line.parse() {
        Ok(line @ 1..) => Ok((file, line)),
        _ => Err(wrong()),
    }
}

fn explain_line(arguments: &ExplainArguments) -> Result<Vec<Explanation>, Failure> {
    let (file, line) = file_and_line(&arguments.place)?;
    let mut session = open(file, &arguments.setting)?;
    let blocks = blocks_on(&mut session, file, line)?;
    let wanted = Wanted::Line(line, arguments.pass);
    let mut found = explain_found(&mut session, file, wanted, None)?;
    let reached = |found: &[Explanation]| blocks.len() <= found.len();
    if !reached(&found)
        && let Some(alarm) = session.alarm().copied()
        && alarm.place.source == OWN
    {
        let (diagnostic, excerpt) = {
            let configuration = session.configuration().clone();
            show_alarm(&alarm, &configuration.control, &configuration.machine, session.library_mut())
        };
        let name = diagnostic.alarm.map_or_else(String::new, |alarm| alarm.name);
        let note = format!(
            "The control stops before this block: alarm {name} at line {}, {}. Explained as if it went on; what the refused block names is unknown.",
            excerpt.line, diagnostic.message
        );
        let mut on = open(file, &arguments.setting)?;
        on.set_after_alarm(AfterAlarm::GoOn);
        found = explain_found(&mut on, file, wanted, Some(note))?;
        found.iter_mut().for_each(|explanation| explanation.pass = None);
    }
    if !reached(&found) {
        let said: Vec<u64> = found.iter().map(|explanation| explanation.offset).collect();
        for &cursor in blocks.iter().filter(|cursor| !said.contains(&cursor.offset)) {
            found.extend(explain_alone(file, cursor, arguments)?);
        }
        found.sort_by_key(|explanation| explanation.offset);
    }
    Ok(found)
}

/// The block by itself, from the state at power-on: the program does not come to it.
fn explain_alone(file: &str, cursor: Cursor, arguments: &ExplainArguments) -> Result<Option<Explanation>, Failure> {
    let passes = {
        let mut session = open(file, &arguments.setting)?;
        Watch::run(&mut session, Wanted::Line(cursor.line, 1)).map_err(Failure::call)?.passes
    };
    let executions = passes.get(&(OWN, cursor.offset)).copied().unwrap_or(0);
    let note = match executions {
        0 => "The program never comes to this block. Explained by itself, from the state at power-on.".to_owned(),
        1 => format!(
            "The block is executed once, there is no execution {}. Explained by itself, from the state at power-on.",
            arguments.pass
        ),
        count => format!(
            "The block is executed {count} times, there is no execution {}. Explained by itself, from the state at power-on.",
            arguments.pass
        ),
    };
    let mut session = open(file, &arguments.setting)?;
    session.set_after_alarm(AfterAlarm::GoOn);
    session.select(OWN, &Texts::program_name(file), cursor);
    let mut found = explain_found(&mut session, file, Wanted::Line(cursor.line, 1), Some(note))?;
    found.retain(|explanation| explanation.offset == cursor.offset);
    let mut alone = found.into_iter().next();
    if let Some(alone) = &mut alone {
        alone.pass = None;
    }
    Ok(alone)
}

/// Runs the program and explains what was found.
fn explain_found(
    session: &mut Session<Texts>,
    file: &str,
    wanted: Wanted,
    note: Option<String>,
) -> Result<Vec<Explanation>, Failure> {
    let watch = Watch::run(session, wanted).map_err(Failure::call)?;
    let configuration = session.configuration().clone();
    let passes: BTreeMap<_, _> = watch.passes;
    let mut explanations = Vec::new();
    for watched in &watch.found {
        let Place { source, block, .. } = watched.place;
        let texts = session.library_mut();
        let text = texts.excerpt(source, block.start, block.len as usize);
        let alarm = watched.alarm.as_ref();
        let alarm = alarm.map(|alarm| show_alarm(alarm, &configuration.control, &configuration.machine, texts));
        let mut explanation = report::explain(session, watched, file, &text, alarm);
        let key = (watched.place.source, watched.place.block.start);
        explanation.pass = passes.get(&key).map(|&of| (watched.pass, of));
        explanation.note.clone_from(&note);
        explanations.push(explanation);
    }
    Ok(explanations)
}

/// Where the blocks of a line begin.
fn blocks_on(session: &mut Session<Texts>, file: &str, line: u64) -> Result<Vec<Cursor>, Failure> {
    let Configuration { control, fitting, .. } = session.configuration();
    let (grammar, codes) = (control.grammar, fitting.tape_codes(control));
    let (mut blocks, mut lines, mut comment) = (Vec::new(), 0, false);
    blocks_of(session.library_mut(), OWN, &grammar, codes, |block, _| {
        lines = block.start.line;
        if lines == line {
            comment |= !block.comments.is_empty() || block.rewind;
            if !block.is_empty() {
                blocks.push(block.start);
            }
        }
        lines <= line
    })
    .map_err(Failure::call)?;
    if blocks.is_empty() {
        let what = match (lines < line, comment) {
            (true, _) => format!("{file} has {lines} lines, there is no line {line}"),
            (_, true) => {
                format!("{file}:{line} holds no block to explain, only a comment or the sign % of a tape's ends")
            }
            _ => format!("{file}:{line} is blank: there is no block to explain"),
        };
        return Err(Failure::call(what));
    }
    Ok(blocks)
}
