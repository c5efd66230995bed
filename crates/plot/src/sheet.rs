//! The whole sheet: header, both views, legend, notes.

use crate::beside::{draw_contour, draw_driven, draw_refused, draw_swept, draw_tool};
use crate::canvas::Canvas;
use crate::colour::{GRID, INK, PAPER, SOFT_INK};
use crate::detail::Detail;
use crate::drawing::Title;
use crate::extent::Extent;
use crate::frame::frame;
use crate::hole::{DownCut, down_cuts};
use crate::ink::Ink;
use crate::isometric_axes::{draw_isometric_axes, draw_isometric_floor};
use crate::kept::Drawn;
use crate::label::{Anchor, Label, Places};
use crate::layers::DrawnLayers;
use crate::layout::{ISOMETRIC_INSET, Layout, MARGIN, PLAN_INSET, layout, plan_layout};
use crate::legend::{Entry, Legend};
use crate::look::Look;
use crate::mark::Mark;
use crate::notes::notes;
use crate::palette::Palette;
use crate::plan_axes::{draw_plan_axes, draw_plan_grid};
use crate::rect::Rect;
use crate::scale::{written, written_length, written_range};
use crate::sign::draw_marks;
use crate::stroke::Kind;
use crate::strokes::{draw_down_cuts, draw_strokes};
use crate::survey::Survey;
use crate::text::{shortened, width};
use crate::view::{Projection, View};

const TITLE_SIZE: f64 = 26.0;
const SUBTITLE_SIZE: f64 = 16.0;
const FACTS_SIZE: f64 = 15.0;
const HEADING_SIZE: f64 = 15.0;
const NOTE_SIZE: f64 = 14.0;
const NOTE_ROW: f64 = 22.0;

/// More tools than this are counted, not named.
const MOST_NAMED_TOOLS: usize = 12;

/// Everything that a sheet shows.
pub(crate) struct Content<'a> {
    pub title: &'a Title,
    pub survey: &'a Survey,
    pub drawn: &'a Drawn,
    pub marks: &'a [Mark],
    pub layers: DrawnLayers<'a>,
    pub look: Look,
}

/// The sheet as SVG.
pub(crate) fn sheet(content: &Content) -> String {
    let feeds = &content.survey.feeds;
    let palette = if content.layers.by_speed { Palette::of_speed(feeds) } else { Palette::new(feeds) };
    let frame = content.look.frame(frame(content.survey, &content.drawn.pieces, &content.layers));
    let cuts = down_cuts(&content.drawn.pieces);
    let size = |projection: Projection| {
        let flat = projection.flat_extent(&frame);
        [flat.width, flat.height]
    };
    let inset = content.look.inset(PLAN_INSET);
    let layout = match content.look {
        Look::Both => layout(size(Projection::Plan), size(Projection::Isometric)),
        Look::Plan | Look::Around(..) => plan_layout(size(Projection::Plan), inset),
    };
    let plan = View::fit(Projection::Plan, &frame, layout.plan, inset);
    let detail =
        (content.look == Look::Both).then(|| Detail::of(&content.layers, plan.scale, size(Projection::Plan))).flatten();
    let (layout, detail) = detail.map_or((layout, None), |(layout, detail)| (layout, Some(detail)));
    let views = Views {
        plan: View::fit(Projection::Plan, &frame, layout.plan, inset),
        isometric: layout.isometric.map(|panel| View::fit(Projection::Isometric, &frame, panel, ISOMETRIC_INSET)),
        detail,
    };
    let legend = Legend::new(entries(content, &views, &palette, &cuts), layout.width);
    let notes = notes(content, &views);
    let legend_top = layout.views_bottom + 22.0;
    let notes_top = legend_top + legend.height() + 8.0;
    let height = (notes_top + NOTE_ROW * notes.len() as f64 + MARGIN - 14.0).ceil();

    let mut canvas = Canvas::new(layout.width, height);
    canvas.title(&content.title.program);
    canvas.rect(&Rect { x: 0.0, y: 0.0, width: layout.width, height }, &format!("fill=\"{PAPER}\""));
    draw_header(&mut canvas, content.title, &facts(content.survey), layout.width);
    draw_headings(&mut canvas, &layout, views.detail.as_ref());
    // A whole frame holds all that cuts; a window does not.
    let is_window = matches!(content.look, Look::Around(..));
    draw_plan(&mut canvas, &views.plan, content, (&palette, &cuts), is_window);
    if let Some(view) = &views.isometric {
        draw_isometric(&mut canvas, view, content, &palette, &frame);
    }
    if let Some(detail) = &views.detail {
        detail.circle(&mut canvas, &views.plan);
        match detail.view.projection {
            Projection::Plan => draw_plan(&mut canvas, &detail.view, content, (&palette, &cuts), true),
            Projection::Isometric => draw_isometric(&mut canvas, &detail.view, content, &palette, &detail.frame),
        }
    }
    legend.draw(&mut canvas, legend_top, &palette);
    for (row, note) in notes.iter().enumerate() {
        let text = shortened(note, NOTE_SIZE, layout.width - 2.0 * MARGIN);
        let at = [MARGIN, notes_top + NOTE_ROW * (row as f64 + 0.5)];
        canvas.text(&Label::new(text, at, NOTE_SIZE, Anchor::Start).centred(), SOFT_INK);
    }
    canvas.finish()
}

/// The two views of a sheet.
pub(crate) struct Views {
    pub plan: View,
    pub isometric: Option<View>,
    /// Where the driven path is farthest off, instead of the isometric view.
    pub detail: Option<Detail>,
}

impl Views {
    /// True if every view shows the point.
    pub fn show(&self, point: [f64; 3]) -> bool {
        self.plan.shows(point) && self.isometric.as_ref().is_none_or(|view| view.shows(point))
    }

    /// True if a view shows the point.
    pub fn any_shows(&self, point: [f64; 3]) -> bool {
        self.plan.shows(point) || self.isometric.as_ref().is_some_and(|view| view.shows(point))
    }
}

/// The program, what runs it, and a line of facts.
pub(crate) fn draw_header(canvas: &mut Canvas, title: &Title, facts: &str, sheet_width: f64) {
    let room = sheet_width - 2.0 * MARGIN;
    let machine = [&title.control, &title.machine].map(|part| part.trim());
    let machine = machine.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("  \u{b7}  ");
    let machine = shortened(&machine, SUBTITLE_SIZE, room * 0.5);
    let program = shortened(&title.program, TITLE_SIZE, room - width(&machine, SUBTITLE_SIZE) - 40.0);
    canvas.text(&Label::new(program, [MARGIN, 60.0], TITLE_SIZE, Anchor::Start), INK);
    canvas.text(&Label::new(machine, [sheet_width - MARGIN, 60.0], SUBTITLE_SIZE, Anchor::End), SOFT_INK);
    let facts = shortened(facts, FACTS_SIZE, room);
    canvas.text(&Label::new(facts, [MARGIN, 91.0], FACTS_SIZE, Anchor::Start), SOFT_INK);
    canvas.open(&format!("stroke=\"{GRID}\" stroke-width=\"1.5\""));
    canvas.line([MARGIN, 108.0], [sheet_width - MARGIN, 108.0]);
    canvas.close();
}

/// Extents, lengths and tools in one line.
fn facts(survey: &Survey) -> String {
    let subject = survey.subject();
    if subject.is_empty() {
        return "nothing moves".to_owned();
    }
    let axes: Vec<String> = ["X", "Y", "Z"]
        .iter()
        .enumerate()
        .map(|(axis, name)| format!("{name} {}", written_range(subject.min[axis], subject.max[axis])))
        .collect();
    let what = if survey.cutting.is_empty() { "rapids" } else { "cutting" };
    let mut parts = vec![format!("{what}  {} mm", axes.join("   "))];
    for (name, length_mm) in [("cutting path", survey.cutting_mm), ("rapid path", survey.rapid_mm)] {
        if length_mm > 0.0 {
            parts.push(format!("{name} {}", written_length(length_mm)));
        }
    }
    let tools = survey.tools.len();
    if tools > MOST_NAMED_TOOLS {
        parts.push(format!("{tools} tools"));
    } else if tools > 0 {
        parts.push(survey.tools.iter().map(|tool| format!("T{tool}")).collect::<Vec<_>>().join(" "));
    }
    parts.join("   \u{b7}   ")
}

fn draw_headings(canvas: &mut Canvas, layout: &Layout, detail: Option<&Detail>) {
    let detail = detail.map(|detail| detail.view.panel);
    for (panel, text) in [(Some(layout.plan), "Plan"), (layout.isometric, "Isometric"), (detail, "In the circle")] {
        let Some(panel) = panel else { continue };
        canvas.text(&Label::new(text, [panel.middle()[0], panel.y - 13.0], HEADING_SIZE, Anchor::Middle), INK);
    }
}

fn draw_plan(
    canvas: &mut Canvas,
    view: &View,
    content: &Content,
    (palette, cuts): (&Palette, &[DownCut]),
    is_window: bool,
) {
    let mut places = Places::default();
    draw_swept(canvas, view, &content.layers);
    draw_plan_grid(canvas, view);
    let ink = Ink::measure(view, &content.drawn.pieces);
    draw_tool(canvas, view, &content.layers);
    if content.layers.path {
        if is_window {
            canvas.open_clipped(&view.panel, "");
        }
        draw_strokes(canvas, view, &content.drawn.pieces, palette, &ink);
        draw_down_cuts(canvas, view, cuts, palette, &mut places);
        if is_window {
            canvas.close();
        }
    }
    draw_driven(canvas, view, &content.layers);
    draw_contour(canvas, view, &content.layers, &ink);
    draw_refused(canvas, view, &content.layers, true);
    draw_plan_axes(canvas, view, &mut places);
    draw_marks(canvas, view, content.marks, &ink, &mut places);
}

fn draw_isometric(canvas: &mut Canvas, view: &View, content: &Content, palette: &Palette, frame: &Extent) {
    let mut places = Places::default();
    canvas.rect(&view.panel, &format!("stroke=\"{GRID}\" stroke-width=\"1\""));
    draw_isometric_floor(canvas, view, frame);
    let ink = Ink::measure(view, &content.drawn.pieces);
    if content.layers.path {
        draw_strokes(canvas, view, &content.drawn.pieces, palette, &ink);
    }
    draw_driven(canvas, view, &content.layers);
    draw_contour(canvas, view, &content.layers, &ink);
    draw_refused(canvas, view, &content.layers, false);
    draw_isometric_axes(canvas, view, frame, &mut places);
    draw_marks(canvas, view, content.marks, &ink, &mut places);
}

fn entries(content: &Content, views: &Views, palette: &Palette, cuts: &[DownCut]) -> Vec<Entry> {
    let mut entries = Vec::new();
    let layers = &content.layers;
    if !layers.programmed.is_empty() {
        entries.push(match (layers.driven.is_empty(), layers.has_contour) {
            (true, _) => Entry::Contour,
            (false, true) => Entry::ContourAndPath,
            (false, false) => Entry::Programmed,
        });
    }
    if !layers.driven.is_empty() {
        entries.push(Entry::Driven(layers.exaggeration));
    }
    if let (Some(detail), Some(farthest)) = (&views.detail, layers.farthest) {
        entries.push(Entry::Circled(farthest.by, detail.times(&views.plan)));
    }
    if !layers.swept.is_empty() {
        entries.push(Entry::Tool(layers.radii.clone()));
        entries.push(Entry::Swept);
    }
    if !layers.refused.is_empty() {
        entries.push(Entry::Refused);
    }
    if layers.path {
        if layers.is_named {
            entries.push(Entry::Path);
        }
        path_entries(&mut entries, content, palette, cuts);
    }
    let seen = |mark: &&Mark| views.any_shows(mark.at);
    let mut kinds: Vec<_> = content.marks.iter().filter(seen).map(|mark| mark.kind.without_number()).collect();
    kinds.sort_unstable();
    kinds.dedup();
    entries.extend(kinds.into_iter().map(Entry::Sign));
    entries
}

/// The lines of the path.
fn path_entries(entries: &mut Vec<Entry>, content: &Content, palette: &Palette, cuts: &[DownCut]) {
    if content.drawn.pieces.iter().any(|piece| piece.kind == Kind::Rapid) {
        entries.push(Entry::Rapid);
    }
    match palette {
        Palette::Few(feeds) => {
            entries.extend(feeds.iter().enumerate().map(|(shade, feed)| Entry::Feed(shade, *feed)));
        }
        Palette::Speed { fastest } if *fastest > 0.0 => entries.push(Entry::Speed(*fastest)),
        Palette::Speed { .. } => {}
        Palette::Scale { slowest, fastest } => entries.push(Entry::Scale(*slowest, *fastest)),
    }
    if cuts.iter().any(|cut| cut.is_hole) {
        entries.push(Entry::Hole);
    }
}

/// X, Y, Z of a point, for reading.
pub(crate) fn written_point(point: [f64; 3]) -> String {
    format!("X {} Y {} Z {}", written(point[0]), written(point[1]), written(point[2]))
}
