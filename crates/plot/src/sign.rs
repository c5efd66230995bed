//! The signs of marks, holes and plunges, and the marks' labels where they find room.

use std::collections::BTreeMap;

use crate::canvas::{Canvas, short};
use crate::colour::{ALARM, INK, PAPER, SOFT_INK};
use crate::ink::Ink;
use crate::label::{Anchor, Label, Places};
use crate::mark::{Mark, MarkKind};
use crate::rect::Rect;
use crate::view::View;

/// Half the size of a sign in sheet units.
pub(crate) const SIGN: f64 = 7.0;

/// The size of a mark's label.
const LABEL_SIZE: f64 = 14.0;

/// Marks closer than this on the sheet share one sign.
const TOGETHER: f64 = 4.0;

/// A label has so many places around its sign; farther ones come after them, and are chosen only to keep much free.
const AROUND: usize = 8;

/// A shared sign names so many of its marks.
const MOST_NAMES: usize = 4;

/// Draws the sign of a mark.
pub(crate) fn draw_sign(canvas: &mut Canvas, kind: MarkKind, at: [f64; 2]) {
    let polygon = |points: &[[f64; 2]]| {
        let mut d = String::new();
        for (index, [x, y]) in points.iter().enumerate() {
            d.push(if index == 0 { 'M' } else { 'L' });
            d.push_str(&format!("{} {}", short(at[0] + x * SIGN), short(at[1] + y * SIGN)));
        }
        d + "z"
    };
    let filled = format!("fill=\"{INK}\" stroke=\"{PAPER}\" stroke-width=\"1.5\"");
    let open = format!("fill=\"{PAPER}\" stroke=\"{INK}\" stroke-width=\"1.8\" stroke-linejoin=\"round\"");
    match kind {
        MarkKind::Start => canvas.path(&polygon(&[[-0.8, -1.0], [1.1, 0.0], [-0.8, 1.0]]), &filled),
        MarkKind::End => canvas.path(&polygon(&[[-0.85, -0.85], [0.85, -0.85], [0.85, 0.85], [-0.85, 0.85]]), &filled),
        MarkKind::ToolChange(_) => canvas.path(&polygon(&[[0.0, -1.1], [1.1, 0.0], [0.0, 1.1], [-1.1, 0.0]]), &open),
        MarkKind::Stop => {
            let corners = [
                [-0.42, -1.0],
                [0.42, -1.0],
                [1.0, -0.42],
                [1.0, 0.42],
                [0.42, 1.0],
                [-0.42, 1.0],
                [-1.0, 0.42],
                [-1.0, -0.42],
            ];
            canvas.path(&polygon(&corners), &open);
            let bars = polygon(&[[-0.3, -0.4], [-0.3, 0.4]]) + &polygon(&[[0.3, -0.4], [0.3, 0.4]]);
            canvas.path(&bars, &format!("stroke=\"{INK}\" stroke-width=\"1.8\""));
        }
        MarkKind::Alarm => {
            let cross = polygon(&[[-0.85, -0.85], [0.85, 0.85]]) + &polygon(&[[-0.85, 0.85], [0.85, -0.85]]);
            canvas.path(&cross, &format!("stroke=\"{PAPER}\" stroke-width=\"6.5\" stroke-linecap=\"round\""));
            canvas.path(&cross, &format!("stroke=\"{ALARM}\" stroke-width=\"3.4\" stroke-linecap=\"round\""));
        }
    }
}

/// The path of a drilled hole's sign: a circle with its centre lines.
pub(crate) fn hole_path([x, y]: [f64; 2], radius: f64) -> String {
    let reach = radius * 1.7;
    let [left, top, x, y, start] = [x - reach, y - reach, x, y, x - radius].map(short);
    let [radius, across, reach] = [radius, 2.0 * radius, 2.0 * reach].map(short);
    let half = format!("a{radius} {radius} 0 1 1");
    format!("M{start} {y}{half} {across} 0{half}-{across} 0zM{left} {y}h{reach}M{x} {top}v{reach}")
}

/// Draws the marks that a view shows, first every sign, then the labels that find room.
pub(crate) fn draw_marks(canvas: &mut Canvas, view: &View, marks: &[Mark], ink: &Ink, places: &mut Places) {
    let mut groups: BTreeMap<[i64; 2], Vec<&Mark>> = BTreeMap::new();
    for mark in marks.iter().filter(|mark| view.shows(mark.at)) {
        groups.entry(view.place(mark.at).map(|at| (at / TOGETHER).round() as i64)).or_default().push(mark);
    }
    let mut groups: Vec<_> = groups.into_values().collect();
    // What is more important lies on top, and is the first to be given a label.
    let importance = |group: &Vec<&Mark>| group.iter().map(|mark| mark.kind.without_number()).max();
    groups.sort_by_key(importance);
    for group in &groups {
        if let (Some(kind), Some(first)) = (importance(group), group.first()) {
            let at = view.place(first.at);
            draw_sign(canvas, kind, at);
            places.take(Rect { x: at[0], y: at[1], width: 0.0, height: 0.0 }.grown(SIGN));
        }
    }
    for group in groups.iter().rev() {
        if let (Some(kind), Some(first)) = (importance(group), group.first()) {
            let sign = view.place(first.at);
            let around = labels_around(sign, &names(group));
            if let Some(label) = best_place(around, view, ink, places, kind == MarkKind::Alarm) {
                places.take(label.room());
                draw_leader(canvas, sign, &label.room());
                canvas.text_over_lines(&label, if kind == MarkKind::Alarm { ALARM } else { INK });
            }
        }
    }
}

/// Draws a thin line from a sign to its label, if that stands away from it.
fn draw_leader(canvas: &mut Canvas, sign: [f64; 2], label: &Rect) {
    let end = [sign[0].clamp(label.x, label.right()), sign[1].clamp(label.y, label.bottom())];
    let [dx, dy] = [end[0] - sign[0], end[1] - sign[1]];
    let length = libm::hypot(dx, dy);
    if length > SIGN + 10.0 {
        let start = [sign[0] + dx * SIGN / length, sign[1] + dy * SIGN / length];
        canvas.open(&format!("stroke=\"{SOFT_INK}\" stroke-width=\"0.7\""));
        canvas.line(start, end);
        canvas.close();
    }
}

/// The place where a label hides the least of the path. One that must be seen is placed even over other signs.
fn best_place(around: Vec<Label>, view: &View, ink: &Ink, places: &Places, must_be_seen: bool) -> Option<Label> {
    let inside: Vec<Label> = around.into_iter().filter(|label| view.panel.grown(-4.0).holds(&label.room())).collect();
    let hidden = |(rank, label): &(usize, &Label)| ink.under(&label.room()) + rank + 8 * (rank / AROUND) * AROUND;
    let free = inside.iter().enumerate().filter(|(_, label)| places.is_free(label)).min_by_key(hidden);
    let any = || inside.iter().enumerate().min_by_key(hidden).filter(|_| must_be_seen);
    free.or_else(any).map(|(_, label)| label.clone())
}

/// The distinct labels of marks that share a sign.
fn names(group: &[&Mark]) -> String {
    let mut names: Vec<String> = Vec::new();
    for mark in group {
        let name = mark.label();
        if !names.contains(&name) {
            names.push(name);
        }
        if names.len() > MOST_NAMES {
            names.truncate(MOST_NAMES);
            return names.join(", ") + " \u{2026}";
        }
    }
    names.join(", ")
}

/// The places where a label may stand, the best first.
fn labels_around([x, y]: [f64; 2], text: &str) -> Vec<Label> {
    let side = SIGN + 6.0;
    let mut labels = Vec::new();
    for away in [0.0, 12.0, 26.0] {
        let (beside, up) = (side + away, SIGN + 5.0 + away);
        let label = |dx: f64, dy: f64, anchor| Label::new(text, [x + dx, y + dy], LABEL_SIZE, anchor);
        labels.extend([
            label(beside, 0.0, Anchor::Start).centred(),
            label(-beside, 0.0, Anchor::End).centred(),
            label(beside * 0.6, -up, Anchor::Start),
            label(beside * 0.6, up + 10.0, Anchor::Start),
            label(-beside * 0.6, -up, Anchor::End),
            label(-beside * 0.6, up + 10.0, Anchor::End),
            label(0.0, -up, Anchor::Middle),
            label(0.0, up + 10.0, Anchor::Middle),
        ]);
    }
    labels
}
