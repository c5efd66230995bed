//! The drawing as the caller sees it: strokes and marks go in, a picture comes out.

use crate::kept::KeptPath;
use crate::mark::Mark;
use crate::piece::Piece;
use crate::png::{PngError, png};
use crate::sheet::{Content, sheet};
use crate::stroke::{Kind, Stroke, is_drawable};
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
}

impl Drawing {
    /// An empty drawing with a title.
    pub fn new(title: Title) -> Drawing {
        Drawing { title, survey: Survey::new(), path: KeptPath::new(), marks: Vec::new() }
    }

    /// Draws one move. A stroke with a coordinate that is not a number, or is beyond 1000 km, is ignored.
    /// A move without length draws nothing.
    pub fn stroke(&mut self, stroke: &Stroke) {
        if !stroke.is_drawable() || (stroke.from == stroke.to && stroke.arc.is_none()) {
            return;
        }
        let cuts = stroke.kind == Kind::Feed && stroke.feed.is_finite();
        let feed = if cuts { stroke.feed.max(0.0) } else { 0.0 };
        let arc = stroke.arc.filter(|arc| arc.sweep_deg != 0.0);
        let piece = Piece { kind: stroke.kind, from: stroke.from, to: stroke.to, arc, feed };
        self.survey.note(&piece, stroke.tool);
        self.path.push(&piece, &self.survey);
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
        sheet(&Content { title: &self.title, survey: &self.survey, drawn: &drawn, marks: &self.marks })
    }

    /// The sheet as PNG, so many pixels wide (1 to [`WIDEST_PX`](crate::WIDEST_PX)); the height follows.
    pub fn png(&self, width_px: u32) -> Result<Vec<u8>, PngError> {
        png(&self.svg(), width_px)
    }
}
