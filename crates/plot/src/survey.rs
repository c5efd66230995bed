//! What is known of the whole path without keeping it: extents, lengths, feeds, tools.

use std::collections::BTreeSet;

use crate::extent::Extent;
use crate::feeds::Feeds;
use crate::piece::Piece;
use crate::stroke::Kind;

/// More tools than this are not listed.
const MOST_TOOLS: usize = 200;

/// The sums over every stroke that came in.
#[derive(Clone, Debug)]
pub(crate) struct Survey {
    /// The box around every cutting move, in mm.
    pub cutting: Extent,
    /// The box around every move, in mm.
    pub all: Extent,
    /// The length of the cutting path in mm.
    pub cutting_mm: f64,
    /// The length of the rapid moves in mm.
    pub rapid_mm: f64,
    /// The feeds of the cutting moves.
    pub feeds: Feeds,
    /// The tools that moved.
    pub tools: BTreeSet<u32>,
    last_tool: u32,
}

impl Survey {
    /// Nothing has come in.
    pub fn new() -> Survey {
        Survey {
            cutting: Extent::EMPTY,
            all: Extent::EMPTY,
            cutting_mm: 0.0,
            rapid_mm: 0.0,
            feeds: Feeds::new(),
            tools: BTreeSet::new(),
            last_tool: 0,
        }
    }

    /// Takes note of a piece.
    pub fn note(&mut self, piece: &Piece, tool: u32) {
        let length = piece.length_mm();
        let extent = piece.extent();
        self.all.include_extent(&extent);
        match piece.kind {
            Kind::Rapid => self.rapid_mm += length,
            Kind::Feed => {
                self.cutting_mm += length;
                self.cutting.include_extent(&extent);
                self.feeds.note(piece.feed);
            }
        }
        if tool != self.last_tool && tool != 0 && self.tools.len() < MOST_TOOLS {
            self.tools.insert(tool);
        }
        self.last_tool = tool;
    }

    /// The box that the picture is about: the cutting moves, or every move if nothing cuts.
    pub fn subject(&self) -> &Extent {
        if self.cutting.is_empty() { &self.all } else { &self.cutting }
    }
}
