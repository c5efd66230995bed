//! An event in the words of the trade, for the list of what a block does.

use base::{AXES, Point};
use dialect::{Control, GroupCodes};
use machine::{Event, EventKind, MachineAxis};
use meaning::{CodeLine, CodeOut, Dwell, SetValue};

use super::quantity::{coordinate, plain};
use crate::trace::{Tracer, cause_name, end_name, stop_name};

/// One line of the list.
#[derive(Clone, PartialEq, Debug)]
pub struct Happening {
    /// What happens, in a word.
    pub what: String,
    /// Where to, how fast.
    pub details: String,
    /// How long it takes, if it takes time.
    pub seconds: Option<f64>,
    /// The codes in force after a reset.
    pub resets: Option<GroupCodes>,
    /// It is a move.
    pub moves: bool,
    /// Where the tool goes in the plane, for counting holes; `None` if it stays there.
    pub goes_over: bool,
}

/// An event as a line; `None` for what is not worth one.
pub fn happening(control: &Control, axes: &[MachineAxis], event: &Event) -> Option<Happening> {
    let line = |what: &str, details: String| Happening {
        what: what.to_owned(),
        details,
        seconds: None,
        resets: None,
        moves: false,
        goes_over: false,
    };
    Some(match &event.kind {
        EventKind::Rapid { from, to, duration, .. } => Happening {
            seconds: Some(duration.0),
            moves: true,
            goes_over: moves_over(axes, from, to),
            ..line("rapid", ends(axes, from, to))
        },
        EventKind::Feed { from, to, feed, duration, .. } => Happening {
            seconds: Some(duration.0),
            moves: true,
            goes_over: moves_over(axes, from, to),
            ..line("cut", format!("{}  F{}", ends(axes, from, to), plain(*feed, 3)))
        },
        EventKind::Arc { arc, feed, duration, .. } => {
            let turn = arc.sweep.to_degrees();
            let what = if turn < 0.0 { "arc cw" } else { "arc ccw" };
            let letter = |axis: u8| axes.get(usize::from(axis)).map_or('?', |axis| char::from(axis.letter));
            let centre = arc.axes.iter().zip(arc.center);
            let centre: Vec<_> = centre.map(|(&axis, at)| format!("{} {}", letter(axis), coordinate(at))).collect();
            let details = format!(
                "{}  F{}\ncentre {}, radius {}, {} deg",
                ends_of_arc(axes, &arc.from, &arc.to, arc.axes),
                plain(*feed, 3),
                centre.join("  "),
                coordinate(arc.radius[0]),
                plain(turn.abs(), 3)
            );
            Happening { seconds: Some(duration.0), moves: true, goes_over: true, ..line(what, details) }
        }
        EventKind::Dwell(Dwell::Seconds(seconds)) => {
            Happening { seconds: Some(*seconds), ..line("wait", format!("{} s", plain(*seconds, 3))) }
        }
        EventKind::Dwell(Dwell::Revolutions { turns, .. }) => {
            line("wait", format!("{} turns of the spindle", plain(*turns, 3)))
        }
        EventKind::Code(code) => line("send", code_text(control, *code)),
        EventKind::Waited(seconds) => {
            Happening { seconds: Some(seconds.0), ..line("wait", "for the machine's answer".to_owned()) }
        }
        EventKind::Stop(cause) => line("stop", format!("{}: waits for CYCLE START", stop_name(*cause))),
        EventKind::Reset { cause, groups } => {
            Happening { resets: Some(*groups), ..line("reset", format!("by {}", cause_name(*cause))) }
        }
        EventKind::End { kind, rewind, reset, .. } => {
            let reset = if *reset { "the control resets" } else { "no reset" };
            let rewind = if *rewind { "the program is back at its head" } else { "no rewind" };
            line("end", format!("{}: {reset}, {rewind}", end_name(*kind)))
        }
        EventKind::Finished(_)
        | EventKind::Signal(..)
        | EventKind::BlockDone
        | EventKind::Start(_)
        | EventKind::Alarm(_) => return None,
        // Whatever else there is speaks in the words of the trace.
        _ => line(Tracer::event_word(&event.kind), trace_fields(control, axes, event)),
    })
}

/// The letters by which axes of the plane are known: the others lead to and from the work.
fn moves_over(axes: &[MachineAxis], from: &Point, to: &Point) -> bool {
    axes.iter()
        .enumerate()
        .take(AXES)
        .any(|(index, axis)| axis.letter != meaning::LENGTH_AXIS && from[index] != to[index])
}

/// The ends of a move on the axes that it moves.
fn ends(axes: &[MachineAxis], from: &Point, to: &Point) -> String {
    let moving = axes.iter().enumerate().take(AXES).filter(|(index, _)| from[*index] != to[*index]);
    let ends: Vec<_> = moving.map(|(index, axis)| end(axis, to[index])).collect();
    ends.join("  ")
}

/// The ends of an arc on its plane's axes and on those that move beside it.
fn ends_of_arc(axes: &[MachineAxis], from: &Point, to: &Point, plane: [u8; 2]) -> String {
    let moves = |index: usize| from[index] != to[index] || plane.iter().any(|&axis| usize::from(axis) == index);
    let moving = axes.iter().enumerate().take(AXES).filter(|(index, _)| moves(*index));
    let ends: Vec<_> = moving.map(|(index, axis)| end(axis, to[index])).collect();
    ends.join("  ")
}

fn end(axis: &MachineAxis, at: f64) -> String {
    format!("{} {:>9}", char::from(axis.letter), coordinate(at))
}

/// A code as it goes out.
pub fn code_text(control: &Control, code: CodeOut) -> String {
    let digits = usize::from(code.digits);
    let row = control.m_code(code.code).filter(|_| code.line == CodeLine::M);
    let decoded = row.and_then(|row| row.decoded.as_ref()).map_or(String::new(), |line| format!(" and line {line}"));
    format!("{}  (digits {:0digits$}{decoded})", code.line.word(code.code), code.code)
}

/// A value that was written, as the trace has it.
pub fn set_text(control: &Control, axes: &[MachineAxis], value: SetValue) -> String {
    let kind = EventKind::Set(value);
    trace_fields(control, axes, &Event { time: base::Seconds(0.0), place: base::Place::default(), kind })
}

fn trace_fields(control: &Control, axes: &[MachineAxis], event: &Event) -> String {
    let mut out = Vec::new();
    let mut tracer = Tracer::new(control, "", axes.iter().map(|axis| axis.letter));
    tracer.set_main(event.place.program);
    tracer.write(event, |_| "", None, &mut out);
    let text = String::from_utf8_lossy(&out).into_owned();
    // What the list says already is left out: the event's name and its place.
    let from = text.find("\"what\"").unwrap_or(1);
    let fields = text.get(from..).unwrap_or_default().trim_end().trim_end_matches('}');
    fields
        .replace('"', "")
        .replace("what:", "")
        .replace(",value:", ": ")
        .replace(":{", " ")
        .replace(['{', '}'], "")
        .replace(',', "  ")
}
