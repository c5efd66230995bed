//! A place on the path that is worth a sign: start, end, tool change, stop, alarm.

/// What happens at a mark. The order is that of importance, the least first: the most important sign lies on top.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum MarkKind {
    /// Where the program starts.
    Start,
    /// Where the program ends.
    End,
    /// A tool change, with the number of the new tool.
    ToolChange(u32),
    /// A program stop.
    Stop,
    /// An alarm.
    Alarm,
}

impl MarkKind {
    /// The name in the legend.
    pub(crate) fn name(self) -> &'static str {
        match self {
            MarkKind::Start => "start",
            MarkKind::End => "end",
            MarkKind::ToolChange(_) => "tool change",
            MarkKind::Stop => "stop",
            MarkKind::Alarm => "alarm",
        }
    }

    /// The kind without its number: what the legend tells apart.
    pub(crate) fn without_number(self) -> MarkKind {
        if matches!(self, MarkKind::ToolChange(_)) { MarkKind::ToolChange(0) } else { self }
    }
}

/// A mark in the picture.
#[derive(Clone, PartialEq, Debug)]
pub struct Mark {
    /// Where: X, Y, Z in mm, machine coordinates.
    pub at: [f64; 3],
    /// What happens there.
    pub kind: MarkKind,
    /// What is written beside the sign; if it is empty, the kind's own word: `start`, `end`, `T3`, `stop`, `alarm`.
    pub text: String,
}

/// The longest text of a mark that is kept, in characters.
const MOST_CHARACTERS: usize = 48;

impl Mark {
    /// What is written beside the sign.
    pub(crate) fn label(&self) -> String {
        match self.kind {
            _ if !self.text.is_empty() => self.text.clone(),
            MarkKind::ToolChange(tool) => format!("T{tool}"),
            kind => kind.name().to_owned(),
        }
    }

    /// The mark with its text cut to a length that fits beside a sign.
    pub(crate) fn cut(mut self) -> Mark {
        if let Some((end, _)) = self.text.char_indices().nth(MOST_CHARACTERS) {
            self.text.truncate(end);
            self.text.push('\u{2026}');
        }
        self
    }
}
