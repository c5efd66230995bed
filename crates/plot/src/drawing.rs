//! The drawing as the caller sees it: strokes and marks go in, a picture comes out.

use crate::kept::KeptPath;
use crate::layers::{Layer, Layers};
use crate::look::Look;
use crate::mark::Mark;
use crate::piece::Piece;
use crate::png::{PngError, png};
use crate::sheet::{Content, sheet};
use crate::stroke::{Kind, Plane, Stroke, is_drawable};
use crate::survey::Survey;

/// More marks than this are not drawn.
const MOST_MARKS: usize = 5_000;

/// What the header of the sheet says. Any part may be empty.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Title {
    /// The program's name.
    pub program: String,
    /// The control that runs it.
    pub control: String,
    /// The machine that it moves.
    pub machine: String,
}

/// A tool path being drawn. It takes any number of strokes in bounded memory.
#[derive(Clone, Debug)]
pub struct Drawing {
    title: Title,
    survey: Survey,
    path: KeptPath,
    marks: Vec<Mark>,
    layers: Layers,
    look: Look,
}

impl Drawing {
    /// An empty drawing with a title.
    pub fn new(title: Title) -> Drawing {
        Drawing {
            title,
            survey: Survey::new(),
            path: KeptPath::new(),
            marks: Vec::new(),
            layers: Layers::new(),
            look: Look::Both,
        }
    }

    /// Draws one move. A stroke with a coordinate that is not a number, or is beyond 1000 km, is ignored.
    /// A move without length draws nothing.
    pub fn stroke(&mut self, stroke: &Stroke) {
        if let Some(piece) = piece_of(stroke) {
            self.survey.note(&piece, stroke.tool);
            self.path.push(&piece, &self.survey);
        }
    }

    /// Only these layers are drawn; the path that runs if nothing is said. Call it before anything comes in.
    pub fn show(&mut self, layers: &[Layer]) {
        self.layers.show(layers);
    }

    /// From where the path is seen: both views if nothing is said.
    pub fn look(&mut self, look: Look) {
        self.look = look;
    }

    /// The driven path's deviation is drawn so many times as large. Call it before anything comes in.
    pub fn exaggerate(&mut self, times: f64) {
        self.layers.exaggerate(times);
    }

    /// A way that the axes are to drive next, for layer [`Layer::Actual`].
    pub fn ordered(&mut self, way: &Stroke) {
        if let Some(piece) = piece_of(way) {
            self.layers.ordered(&piece);
        }
    }

    /// The axes drive through these places, for layer [`Layer::Actual`].
    pub fn driven(&mut self, kind: Kind, points: &[[f64; 3]]) {
        if points.iter().all(|point| is_drawable(point)) {
            self.layers.driven(kind, points);
        }
    }

    /// The axes cut through these places, for layer [`Layer::Actual`], with nothing that they could be compared with.
    pub fn driven_alone(&mut self, points: &[[f64; 3]]) {
        if points.iter().all(|point| is_drawable(point)) {
            self.layers.driven_alone(Kind::Feed, points);
        }
    }

    /// A way that the axes are to drive, which is drawn beside the one that they drive.
    pub fn commanded(&mut self, way: &Stroke) {
        if let Some(piece) = piece_of(way) {
            self.layers.commanded(&piece);
        }
    }

    /// A programmed way, beside which the tool runs.
    pub fn programmed(&mut self, way: &Stroke) {
        if let Some(piece) = piece_of(way) {
            self.layers.programmed(&piece);
        }
    }

    /// A programmed way before or behind a refused one.
    pub fn refused_among(&mut self, way: &Stroke) {
        if let Some(piece) = piece_of(way) {
            self.layers.refused_among(&piece);
        }
    }

    /// The tool runs along a stroke, beside a contour of this plane.
    pub fn swept(&mut self, stroke: &Stroke, plane: Plane, radius_mm: f64) {
        if let Some(piece) = piece_of(stroke).filter(|_| is_drawable(&[radius_mm])) {
            self.layers.swept(&piece, plane, radius_mm);
        }
    }

    /// The tool does not fit beside a programmed way, as is seen where its middle stands at `tool`. It is drawn whatever
    /// layers are.
    pub fn refused(&mut self, way: &Stroke, plane: Plane, tool: [f64; 3], radius_mm: f64) {
        if let Some(piece) = piece_of(way).filter(|_| is_drawable(&[radius_mm]) && is_drawable(&tool)) {
            self.layers.refused(&piece, plane, tool, radius_mm);
        }
    }

    /// Adds a mark. One whose place is not a number is ignored.
    pub fn mark(&mut self, mark: Mark) {
        if is_drawable(&mark.at) && self.marks.len() < MOST_MARKS {
            self.marks.push(mark.cut());
        }
    }

    /// The sheet as SVG: well-formed, the same bytes for the same strokes and marks.
    pub fn svg(&self) -> String {
        let drawn = self.path.drawn(&self.survey);
        let mut layers = self.layers.clone();
        layers.finish();
        sheet(&Content {
            title: &self.title,
            survey: &self.survey,
            drawn: &drawn,
            marks: &self.marks,
            layers: layers.drawn(),
            look: self.look,
        })
    }

    /// The sheet as PNG, so many pixels wide (1 to [`WIDEST_PX`](crate::WIDEST_PX)); the height follows.
    pub fn png(&self, width_px: u32) -> Result<Vec<u8>, PngError> {
        png(&self.svg(), width_px)
    }
}

/// A stroke as it is kept; `None` if it draws nothing.
fn piece_of(stroke: &Stroke) -> Option<Piece> {
    if !stroke.is_drawable() || (stroke.from == stroke.to && stroke.arc.is_none()) {
        return None;
    }
    let cuts = stroke.kind == Kind::Feed && stroke.feed.is_finite();
    let feed = if cuts { stroke.feed.max(0.0) } else { 0.0 };
    let arc = stroke.arc.filter(|arc| arc.sweep_deg != 0.0);
    Some(Piece { kind: stroke.kind, from: stroke.from, to: stroke.to, arc, feed })
}
