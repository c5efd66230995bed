//! What tool radius compensation makes of a move, in words.

use machine::{Event, EventKind, MachineAxis};
use path::{Corner, Part, RunBeside};

use super::quantity::{coordinate, plain};

/// A move of a block that runs beside its programmed path: its place among the block's events, and how it does.
pub type Beside = (usize, RunBeside);

/// How the move of this number follows from the programmed path, a line each; none if it does not run beside that.
pub fn beside_lines(events: &[Event], beside: &[Beside], index: usize, axes: &[MachineAxis]) -> Vec<String> {
    let Some((_, run)) = beside.iter().find(|(at, _)| *at == index) else { return Vec::new() };
    let from = format!("{} mm {} of", plain(run.radius.abs(), 3), side(run));
    let mut lines = Vec::new();
    lines.push(match run.part {
        Part::Start => format!("start-up: to {from} the programmed path"),
        Part::Along => format!("{from} the programmed path"),
        Part::Round => format!("round the corner, {from} the path"),
        Part::Cancel => format!("cancel: from {from} the path back to its programmed end"),
    });
    if matches!(run.part, Part::Start | Part::Along) {
        lines.extend(programmed_end(run, axes));
    }
    lines.extend(corner(events, beside, index, run));
    lines
}

/// The side of the path on which the tool runs.
pub fn side(run: &RunBeside) -> &'static str {
    if run.radius < 0.0 { "right" } else { "left" }
}

fn programmed_end(run: &RunBeside, axes: &[MachineAxis]) -> Option<String> {
    let way = run.way?;
    let ends = run.axes.iter().zip(way.to).map(|(&axis, counts)| {
        let letter = axes.get(usize::from(axis)).map_or('?', |axis| char::from(axis.letter));
        format!("{letter} {}", coordinate(counts / 1e6))
    });
    Some(format!("programmed end {}", ends.collect::<Vec<_>>().join("  ")))
}

/// The corner at the end of a block, by the moves that follow in it.
fn corner(events: &[Event], beside: &[Beside], index: usize, run: &RunBeside) -> Option<String> {
    if run.part != Part::Along {
        return None;
    }
    let mut behind = beside.iter().filter(|(at, run)| *at > index && run.part == Part::Round);
    let round = behind.next().and_then(|(at, _)| events.get(*at));
    let text = match (run.corner, round.map(|event| &event.kind)) {
        (Corner::None, _) => "ends square to its programmed end",
        (Corner::Inside, _) => "inside corner: ends where it meets the next block's path",
        (Corner::Outside, None) => "outside corner: ends where it meets the next block's path",
        (Corner::Outside, Some(EventKind::Arc { .. })) => "outside corner: then round it on an arc",
        (Corner::Outside, Some(_)) => "outside corner: then round it by straight pieces",
    };
    Some(text.to_owned())
}
