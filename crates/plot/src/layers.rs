//! What is drawn beside the path that runs: the programmed contour, the tool, what the tool does not fit beside.
//!
//! As the path itself, each is kept in bounded memory however much comes in.

use crate::deviation::{Deviation, Farthest};
use crate::extent::Extent;
use crate::kept::{Drawn, KeptPath};
use crate::piece::Piece;
use crate::stroke::{Kind, Plane};
use crate::survey::Survey;
use crate::tool::ToolPlaces;

/// A layer of the picture.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Layer {
    /// The programmed contour of what runs beside it.
    Programmed,
    /// The path that runs.
    Compensated,
    /// The tool, and the area that it sweeps.
    Tool,
    /// The path that runs, coloured by its real speed.
    Speed,
    /// The path that the axes drive, beside the programmed one.
    Actual,
}

/// More refused ways than this are not drawn.
const MOST_REFUSED: usize = 100;

/// A way that the tool does not fit beside.
#[derive(Clone, Debug)]
pub(crate) struct Refused {
    pub way: Piece,
    /// The middle of the tool and its radius, in mm, if it is seen round in plan.
    pub tool: Option<([f64; 3], f64)>,
}

/// A path with what is known of the whole of it.
#[derive(Clone, Debug)]
struct Whole {
    path: KeptPath,
    survey: Survey,
}

impl Whole {
    fn new() -> Whole {
        Whole { path: KeptPath::new(), survey: Survey::new() }
    }

    fn push(&mut self, piece: &Piece) {
        self.survey.note(piece, 0);
        self.path.push(piece, &self.survey);
    }

    fn drawn(&self) -> Drawn {
        self.path.drawn(&self.survey)
    }
}

/// The layers as they grow.
#[derive(Clone, Debug)]
pub(crate) struct Layers {
    shown: Vec<Layer>,
    programmed: Whole,
    /// A contour is among what is programmed, beside which the tool runs.
    has_contour: bool,
    driven: Whole,
    deviation: Deviation,
    /// What the tool sweeps; its radius in mm stands where a path has its feed.
    swept: Whole,
    places: ToolPlaces,
    refused: Vec<Refused>,
    unseen: bool,
}

/// The layers as they are drawn.
pub(crate) struct DrawnLayers<'l> {
    /// The path that runs is drawn.
    pub path: bool,
    /// A layer beside it is drawn too: the path needs its name.
    pub is_named: bool,
    /// The path is coloured by real speed.
    pub by_speed: bool,
    pub programmed: Vec<Piece>,
    pub has_contour: bool,
    pub driven: Vec<Piece>,
    /// How many times the driven path's deviation is drawn, and where it is largest.
    pub exaggeration: f64,
    pub farthest: Option<Farthest>,
    /// How far from their place the programmed and the driven path may be drawn, mm.
    pub error_mm: f64,
    pub swept: Vec<Piece>,
    /// The radii of the tool, if there are few.
    pub radii: Vec<f64>,
    pub places: &'l ToolPlaces,
    pub refused: &'l [Refused],
    /// The tool runs beside a contour of another plane than that of the plan.
    pub unseen: bool,
}

impl Layers {
    /// The path that runs, and nothing beside it.
    pub fn new() -> Layers {
        Layers {
            shown: vec![Layer::Compensated],
            programmed: Whole::new(),
            has_contour: false,
            driven: Whole::new(),
            deviation: Deviation::new(1.0),
            swept: Whole::new(),
            places: ToolPlaces::default(),
            refused: Vec::new(),
            unseen: false,
        }
    }

    /// Only these are drawn.
    pub fn show(&mut self, layers: &[Layer]) {
        self.shown = layers.to_vec();
    }

    /// Deviations of the driven path are drawn so many times as large.
    pub fn exaggerate(&mut self, times: f64) {
        self.deviation = Deviation::new(times);
    }

    /// The way that the axes are to drive next.
    pub fn ordered(&mut self, piece: &Piece) {
        if self.shows(Layer::Actual) && piece.kind == Kind::Feed {
            self.deviation.order(piece);
        }
    }

    /// The axes have driven to a place; from one that was left alone if it does not go on from where they were.
    pub fn driven(&mut self, kind: Kind, points: &[[f64; 3]]) {
        if !self.shows(Layer::Actual) {
            return;
        }
        if kind == Kind::Rapid {
            return self.driven_alone(kind, points);
        }
        let Layers { driven, deviation, .. } = self;
        deviation.drive(points, |from, to| driven.push(&straight(kind, from, to)));
    }

    /// The axes have driven to a place, and what was ordered before that has ended.
    pub fn driven_alone(&mut self, kind: Kind, points: &[[f64; 3]]) {
        if self.shows(Layer::Actual) {
            self.finish();
            points.windows(2).for_each(|pair| self.driven.push(&straight(kind, pair[0], pair[1])));
        }
    }

    /// Nothing more is driven.
    pub fn finish(&mut self) {
        let Layers { driven, deviation, .. } = self;
        deviation.leave(|from, to| driven.push(&straight(Kind::Feed, from, to)));
    }

    /// A programmed way.
    pub fn programmed(&mut self, piece: &Piece) {
        if self.shows(Layer::Programmed) {
            self.refused_among(piece);
        }
    }

    /// A way that the axes are to drive.
    pub fn commanded(&mut self, piece: &Piece) {
        if self.shows(Layer::Programmed) && self.shows(Layer::Actual) {
            self.programmed.push(&Piece { feed: 0.0, ..*piece });
        }
    }

    /// A programmed way near a refused one: it is drawn whatever layers are.
    pub fn refused_among(&mut self, piece: &Piece) {
        self.has_contour = true;
        self.programmed.push(&Piece { feed: 0.0, ..*piece });
    }

    /// The tool moves, beside a contour of this plane.
    pub fn swept(&mut self, piece: &Piece, plane: Plane, radius_mm: f64) {
        if !self.shows(Layer::Tool) || radius_mm <= 0.0 {
            return;
        }
        if plane != Plane::Xy {
            self.unseen = true;
            return;
        }
        self.swept.push(&Piece { feed: radius_mm, ..*piece });
        for end in [piece.from, piece.to] {
            self.places.add(end, radius_mm);
        }
    }

    /// The tool does not fit beside a way: this is where it would stand.
    pub fn refused(&mut self, piece: &Piece, plane: Plane, tool: [f64; 3], radius_mm: f64) {
        if self.refused.len() < MOST_REFUSED {
            let tool = (plane == Plane::Xy && radius_mm > 0.0).then_some((tool, radius_mm));
            self.refused.push(Refused { way: *piece, tool });
        }
    }

    /// What is to be drawn.
    pub fn drawn(&self) -> DrawnLayers<'_> {
        let (programmed, driven) = (self.programmed.drawn(), self.driven.drawn());
        let error_mm = programmed.error_mm.max(driven.error_mm);
        let programmed = programmed.pieces;
        DrawnLayers {
            path: self.shows(Layer::Compensated) || self.shows(Layer::Speed),
            is_named: self.shown != [Layer::Compensated] && !self.shows(Layer::Speed) || !programmed.is_empty(),
            by_speed: self.shows(Layer::Speed),
            programmed,
            has_contour: self.has_contour,
            driven: driven.pieces,
            exaggeration: self.deviation.times,
            farthest: self.deviation.farthest,
            error_mm,
            swept: self.swept.drawn().pieces,
            radii: self.swept.survey.feeds.named().to_vec(),
            places: &self.places,
            refused: &self.refused,
            unseen: self.unseen,
        }
    }

    pub fn shows(&self, layer: Layer) -> bool {
        self.shown.contains(&layer)
    }
}

fn straight(kind: Kind, from: [f64; 3], to: [f64; 3]) -> Piece {
    Piece { kind, from, to, arc: None, feed: 0.0 }
}

impl DrawnLayers<'_> {
    /// Makes room in the frame for what lies beside the path: all that cuts, and positioning that ends near.
    pub fn widen(&self, frame: &mut Extent, near: &Extent) {
        let mut include = |point: [f64; 3], radius: f64| {
            for side in [-radius, radius] {
                frame.include([point[0] + side, point[1] + side, point[2]]);
            }
        };
        let ways = self.programmed.iter().chain(&self.driven).chain(self.refused.iter().map(|refused| &refused.way));
        for (piece, radius) in ways.map(|piece| (piece, 0.0)).chain(self.swept.iter().map(|piece| (piece, piece.feed)))
        {
            if piece.kind == Kind::Feed {
                let extent = piece.extent();
                include(extent.min, radius);
                include(extent.max, radius);
            } else {
                [piece.from, piece.to]
                    .into_iter()
                    .filter(|end| near.contains(*end))
                    .for_each(|end| include(end, radius));
            }
        }
        for (at, radius) in self.refused.iter().filter_map(|refused| refused.tool) {
            include(at, radius);
        }
    }
}
