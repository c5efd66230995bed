//! Command data: the block being executed and the next ones, as far as the control has read ahead. Nothing is read
//! because somebody looks.

use base::SourceId;
use meaning::{Command, WINDOW};
use tape::{Codes, Format, IGNORED, UNREADABLE, recognise};

use super::{Value, axes, modal};
use crate::library::Library;
use crate::session::{Session, TYPED};

/// What the control's buffer holds: the present block, if there is one, and the next ones.
pub(super) fn command<L: Library>(session: &mut Session<L>) -> Value {
    // What begins a program is no block of it.
    let held: Vec<Command> = session.interpreter().held().filter(|command| command.place.line > 0).copied().collect();
    let present = session.place();
    let mut blocks: Vec<Value> = held.iter().map(|command| block(session, command)).collect();
    let is_present = held.first().is_some_and(|command| command.place == present);
    let next = if is_present { blocks.split_off(1) } else { std::mem::take(&mut blocks) };
    let present = blocks.pop().map(|block| ("present", block));
    Value::fields(present.into_iter().chain([("next", Value::List(next))]).collect())
}

fn block<L: Library>(session: &mut Session<L>, command: &Command) -> Value {
    let text = text_of_block(session, command);
    let interpreter = session.interpreter();
    let mut shown = vec![
        ("program", Value::text(interpreter.program_name(command.place.program))),
        ("line", Value::Number(command.place.line as f64)),
    ];
    if command.place.sequence > 0 {
        shown.push(("n", Value::Number(f64::from(command.place.sequence))));
    }
    shown.push(("text", Value::Text(text)));
    if command.is_refused() {
        shown.push(("refused", Value::Truth(true)));
        return Value::fields(shown);
    }
    let after = &command.after;
    let whole = |number: u32| Value::Number(f64::from(number));
    shown.extend([
        ("modal", modal(session, &after.groups)),
        ("f", Value::Number(after.feed.nanometres / 1e6)),
        ("s", whole(after.spindle)),
        ("t", whole(after.tool)),
        ("b", whole(after.index)),
        ("h", whole(after.h)),
        ("d", whole(after.d)),
    ]);
    if !command.sent().is_empty() {
        let code = |code: &meaning::CodeOut| Value::Text(code.line.word(code.code));
        shown.push(("codes", Value::List(command.sent().iter().map(code).collect())));
    }
    if command.moves() {
        let end = after.machine.map(|counts| counts / 1e6);
        shown.push(("target", axes(session, &interpreter.work_position_in(after, &end))));
    }
    Value::fields(shown)
}

/// The block as it is written; a text that can no longer be read is left out.
fn text_of_block<L: Library>(session: &mut Session<L>, command: &Command) -> String {
    let (source, span) = (command.place.source, command.place.block);
    let mut bytes = Vec::new();
    if source == TYPED {
        let text = session.typed_text();
        let from = usize::try_from(span.start).unwrap_or(usize::MAX).min(text.len());
        bytes.extend(text[from..].iter().take(span.len as usize));
    } else {
        let format = format_of(session, source);
        let _ = session.library_mut().read(source, span.start, span.len as usize, &mut bytes);
        if let Some((format @ Format::Tape(_), codes)) = format {
            format.translate(&codes, &mut bytes, span.start, true);
            bytes.retain(|&byte| byte != IGNORED);
            bytes.iter_mut().filter(|byte| **byte == UNREADABLE).for_each(|byte| *byte = b'?');
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// How a text is read, and in which codes, on a control that reads tapes.
fn format_of<L: Library>(session: &mut Session<L>, source: SourceId) -> Option<(Format, Codes)> {
    let interpreter = session.interpreter();
    let codes = interpreter.fitting().tape_codes(interpreter.control())?;
    let format = interpreter.format_of(source).unwrap_or_else(|| {
        let mut head = Vec::new();
        let _ = session.library_mut().read(source, 0, WINDOW, &mut head);
        recognise(&head, &codes)
    });
    Some((format, codes))
}
