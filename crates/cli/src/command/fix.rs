//! Refused blocks as they can be written: offered by `check`, and written by `check --fix` once they are proved.

use std::collections::BTreeSet;
use std::ops::Range;

use base::{Alarm, Correction, SourceId};
use dialect::{Meaning, Refused, Rewritten};
use machine::EventKind;
use station::{AfterAlarm, Session};
use syntax::{Block, Cursor, Outcome, read_block};

use super::fmt::read;
use super::{begin_session, run_through};
use crate::arguments::SettingArguments;
use crate::failure::Failure;
use crate::replace::write_at_one_stroke;
use crate::setting;
use crate::texts::Texts;

/// The text in question, in a session's texts.
const OWN: SourceId = SourceId(0);
/// A block that is carried out now can bring to light what is wrong with later ones: so often the text is gone through.
const MOST_PASSES: usize = 16;

/// A block of the text and what takes its place.
struct Edit {
    at: Range<usize>,
    text: Vec<u8>,
}

/// How the block of an alarm just raised can be written instead.
pub fn correction(alarm: &Alarm, session: &mut Session<Texts>) -> Option<Correction> {
    let Rewritten { text, safe } = rewritten(alarm, session)?;
    Some(Correction { span: alarm.place.block, text: String::from_utf8_lossy(&text).into_owned(), safe })
}

fn rewritten(alarm: &Alarm, session: &mut Session<Texts>) -> Option<Rewritten> {
    let control = session.configuration().control.clone();
    let after = session.interpreter().done()[0].after;
    let (roles, groups) = (&control.roles, &after.groups);
    let known = ![roles.motion, roles.cycle].iter().any(|&group| after.unknown.group(group));
    let in_cycle = control.in_force(groups, roles.cycle).is_some_and(Meaning::is_cycle);
    let motion = groups.0.get(roles.motion).copied().filter(|_| known && !in_cycle);
    let (source, span) = (alarm.place.source, alarm.place.block);
    let texts = session.library_mut();
    if texts.is_tape(source) {
        return None;
    }
    let text = texts.excerpt(source, span.start, span.len as usize);
    let mut block = Block::default();
    let outcome = read_block(&text, true, Cursor::HEAD, &control.grammar, &mut block);
    let whole = outcome == Outcome::Block && block.start.offset == 0 && block.len == span.len;
    if !whole {
        return None;
    }
    control.rewrite(alarm.condition, &Refused { block: &block, text: &text, motion })
}

/// Writes the refused blocks of a file as the control takes them, where that is safe and the run then proves the control
/// to take them. Returns how many were written.
pub fn fix_file(file: &str, arguments: &SettingArguments) -> Result<u64, Failure> {
    if file == "-" {
        return Err(Failure::call("--fix writes files; standard input is none"));
    }
    let mut bytes = read(file, &setting::configuration(arguments)?)?;
    let ending: &[u8] = if bytes.windows(2).any(|pair| pair == b"\r\n") { b"\r\n" } else { b"\n" };
    let (mut given_up, mut written) = (BTreeSet::new(), 0);
    for _ in 0..MOST_PASSES {
        let (_, mut edits) = refused_blocks(file, &bytes, arguments)?;
        edits.retain(|edit| !given_up.contains(&edit.at.start));
        let accepted = loop {
            let (text, places) = apply(&bytes, &edits, ending);
            let (refused, _) = refused_blocks(file, &text, arguments)?;
            let fails = |place: &Range<usize>| refused.range(place.clone()).next().is_some();
            if !places.iter().any(fails) {
                break text;
            }
            let failed = edits.iter().zip(&places).filter(|(_, place)| fails(place));
            given_up.extend(failed.map(|(edit, _)| edit.at.start).collect::<Vec<_>>());
            edits.retain(|edit| !given_up.contains(&edit.at.start));
        };
        if edits.is_empty() {
            break;
        }
        written += edits.len() as u64;
        given_up = given_up.into_iter().map(|at| moved(at, &edits, ending)).collect();
        bytes = accepted;
    }
    if written > 0 {
        write_at_one_stroke(file, &bytes)?;
    }
    Ok(written)
}

/// Runs a text: where the blocks begin that the control refuses, and how those can be written that are safe.
fn refused_blocks(
    file: &str,
    bytes: &[u8],
    arguments: &SettingArguments,
) -> Result<(BTreeSet<usize>, Vec<Edit>), Failure> {
    let mut texts = setting::texts(file, arguments)?;
    let source = texts.hold(file, bytes.to_vec())?;
    let mut session = begin_session(setting::configuration(arguments)?, texts, source, file, arguments);
    session.set_after_alarm(AfterAlarm::GoOn);
    let (mut refused, mut edits) = (BTreeSet::new(), Vec::new());
    run_through(&mut session, 1, |session, event| {
        if let EventKind::Alarm(alarm) = &event.kind
            && alarm.place.source == OWN
        {
            let block = alarm.place.block;
            let start = usize::try_from(block.start).unwrap_or(usize::MAX);
            if refused.insert(start)
                && let Some(Rewritten { text, safe: true }) = rewritten(alarm, session)
            {
                edits.push(Edit { at: start..start + block.len as usize, text });
            }
        }
        Ok(())
    })?;
    edits.sort_by_key(|edit| edit.at.start);
    Ok((refused, edits))
}

/// The text with its edits, and where each stands in it.
fn apply(bytes: &[u8], edits: &[Edit], ending: &[u8]) -> (Vec<u8>, Vec<Range<usize>>) {
    let (mut out, mut places, mut from) = (Vec::with_capacity(bytes.len() + 64), Vec::new(), 0);
    for edit in edits {
        out.extend_from_slice(bytes.get(from..edit.at.start).unwrap_or_default());
        let start = out.len();
        out.extend_from_slice(&with_ending(&edit.text, ending));
        places.push(start..out.len());
        from = edit.at.end;
    }
    out.extend_from_slice(bytes.get(from..).unwrap_or_default());
    (out, places)
}

fn with_ending(text: &[u8], ending: &[u8]) -> Vec<u8> {
    text.split(|&byte| byte == b'\n').collect::<Vec<_>>().join(ending)
}

/// Where a place of the old text stands in the new one.
fn moved(at: usize, edits: &[Edit], ending: &[u8]) -> usize {
    let before = edits.iter().take_while(|edit| edit.at.end <= at);
    before.fold(at, |at, edit| at + with_ending(&edit.text, ending).len() - edit.at.len())
}
