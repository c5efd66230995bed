//! Texts that must not overlap: what stands on the sheet takes its place, and a text that finds none is left out.

use crate::rect::Rect;
use crate::text::width;

/// Which point of a text lies at its place.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// A text at a place on the sheet.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Label {
    pub text: String,
    /// The anchor's place on the base line.
    pub at: [f64; 2],
    pub size: f64,
    pub anchor: Anchor,
}

/// The height of capitals and digits in DejaVu Sans, in parts of the size.
pub(crate) const CAPITAL: f64 = 0.73;

/// How far a text reaches below its base line, in parts of the size.
const DESCENT: f64 = 0.24;

impl Label {
    /// A label.
    pub fn new(text: impl Into<String>, at: [f64; 2], size: f64, anchor: Anchor) -> Label {
        Label { text: text.into(), at, size, anchor }
    }

    /// The same label with its capitals centred on the height that was given as its base line.
    pub fn centred(mut self) -> Label {
        self.at[1] += 0.5 * CAPITAL * self.size;
        self
    }

    /// The room that the text takes.
    pub fn room(&self) -> Rect {
        let width = width(&self.text, self.size);
        let x = match self.anchor {
            Anchor::Start => self.at[0],
            Anchor::Middle => self.at[0] - 0.5 * width,
            Anchor::End => self.at[0] - width,
        };
        let top = CAPITAL * self.size;
        Rect { x, y: self.at[1] - top, width, height: top + DESCENT * self.size }
    }
}

/// The places on the sheet that are taken.
#[derive(Clone, Debug, Default)]
pub(crate) struct Places {
    taken: Vec<Rect>,
}

/// Texts stay so far apart.
const GAP: f64 = 3.0;

impl Places {
    /// Takes a place whatever is there.
    pub fn take(&mut self, rect: Rect) {
        self.taken.push(rect);
    }

    /// True if nothing stands in the label's place.
    pub fn is_free(&self, label: &Label) -> bool {
        let room = label.room().grown(GAP);
        !self.taken.iter().any(|taken| taken.overlaps(&room))
    }

    /// Takes the label's place if it is free; true if it was.
    pub fn try_take(&mut self, label: &Label) -> bool {
        let free = self.is_free(label);
        if free {
            self.taken.push(label.room());
        }
        free
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_label_on_the_same_place_is_refused() {
        let mut places = Places::default();
        let label = |x| Label::new("120", [x, 50.0], 13.0, Anchor::Middle);
        assert!(places.try_take(&label(100.0)));
        assert!(!places.try_take(&label(110.0)));
        assert!(places.try_take(&label(140.0)));
    }
}
