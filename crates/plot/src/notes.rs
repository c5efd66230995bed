//! What the picture cannot show, said in words below it.

use crate::detail::{SEEN, SEEN_WELL, WINDOW};
use crate::extent::Extent;
use crate::scale::{Step, written, written_deviation, written_range};
use crate::sheet::{Content, Views, written_point};
use crate::stroke::Kind;

/// So many places outside the picture are named one by one.
const MOST_PLACES: usize = 3;

/// So many marks outside the picture are named one by one.
const MOST_MARKS: usize = 8;

/// The notes, one a line.
pub(crate) fn notes(content: &Content, views: &Views) -> Vec<String> {
    let mut notes = Vec::new();
    if content.layers.path {
        notes.extend(rapids_outside(content, views));
    }
    notes.extend(marks_outside(content, views));
    notes.extend(content.drawn.visible_error_mm.map(|error| {
        format!("The program is long: lines are drawn to within {} mm of their place.", written(error.max(0.001)))
    }));
    notes.extend(deviation(content, views));
    if content.layers.unseen {
        notes.push("The tool is drawn in the plan only, and only where it is compensated in the XY plane.".to_owned());
    }
    notes
}

/// How far the driven path is from the programmed one, and whether that is seen.
fn deviation(content: &Content, views: &Views) -> Vec<String> {
    let layers = &content.layers;
    if layers.driven.iter().all(|piece| piece.kind == Kind::Rapid) {
        return Vec::new();
    }
    let Some(farthest) = layers.farthest else {
        return vec!["The axes drive the commanded path itself.".to_owned()];
    };
    let by = written_deviation(farthest.by);
    let mut note =
        format!("The driven path is at most {by} mm from the commanded one, at {}.", written_point(farthest.at));
    let mut hint = None;
    let seen = farthest.by * views.plan.scale * layers.exaggeration;
    if seen < SEEN && views.detail.is_none() {
        let times = Step::at_least(SEEN_WELL / (farthest.by * views.plan.scale)).times(1.0);
        let window = Step::at_least(farthest.by * WINDOW).times(1.0);
        let [x, y] = [farthest.at[0], farthest.at[1]].map(|at| format!("{at:.3}"));
        note.push_str(" Too little to be seen here.");
        hint = Some(format!(
            "It is seen with --around {x},{y},{window} or, drawn larger everywhere, with --exaggerate {times}."
        ));
    }
    [note].into_iter().chain(hint).collect()
}

/// Where rapids go that leave a view.
fn rapids_outside(content: &Content, views: &Views) -> Option<String> {
    let mut places: Vec<[f64; 3]> = Vec::new();
    let mut around = Extent::EMPTY;
    for piece in content.drawn.pieces.iter().filter(|piece| piece.kind == Kind::Rapid) {
        for end in [piece.from, piece.to] {
            if !views.show(end) {
                around.include(end);
                if places.len() <= MOST_PLACES && !places.contains(&end) {
                    places.push(end);
                }
            }
        }
    }
    if around.is_empty() {
        return None;
    }
    let to = if places.len() <= MOST_PLACES {
        places.into_iter().map(written_point).collect::<Vec<_>>().join("; ")
    } else {
        let range = |axis: usize| written_range(around.min[axis], around.max[axis]);
        format!("X {}  Y {}  Z {}", range(0), range(1), range(2))
    };
    Some(format!("Rapids leave the picture: to {to} (mm)."))
}

/// Which marks neither view shows, and where they are.
fn marks_outside(content: &Content, views: &Views) -> Option<String> {
    let outside: Vec<_> = content.marks.iter().filter(|mark| !views.any_shows(mark.at)).collect();
    let mut places: Vec<([f64; 3], Vec<String>)> = Vec::new();
    for mark in outside.iter().take(MOST_MARKS) {
        match places.iter_mut().find(|(at, _)| *at == mark.at) {
            Some((_, labels)) => labels.push(mark.label()),
            None => places.push((mark.at, vec![mark.label()])),
        }
    }
    if places.is_empty() {
        return None;
    }
    let named = places.into_iter().map(|(at, labels)| format!("{} at {}", labels.join(", "), written_point(at)));
    let more = match outside.len().saturating_sub(MOST_MARKS) {
        0 => String::new(),
        more => format!("; {} more", written(more as f64)),
    };
    Some(format!("Outside the picture: {}{more}.", named.collect::<Vec<_>>().join("; ")))
}
