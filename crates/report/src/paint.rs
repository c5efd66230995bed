//! Colour for a terminal, and lines no longer than it is wide.

/// Colour, or none.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Paint {
    /// With colour.
    pub colour: bool,
    /// Characters in a line.
    pub width: usize,
}

impl Paint {
    fn with(self, code: &str, text: &str) -> String {
        if self.colour && !text.is_empty() { format!("\x1b[{code}m{text}\x1b[0m") } else { text.to_owned() }
    }

    /// What is most important.
    pub fn strong(self, text: &str) -> String {
        self.with("1", text)
    }

    /// What stands in the background.
    pub fn dim(self, text: &str) -> String {
        self.with("2", text)
    }

    /// A heading.
    pub fn heading(self, text: &str) -> String {
        self.with("1;36", text)
    }

    /// What has changed.
    pub fn changed(self, text: &str) -> String {
        self.with("1;32", text)
    }

    /// What has no effect.
    pub fn idle(self, text: &str) -> String {
        self.with("33", text)
    }

    /// What is refused.
    pub fn alarm(self, text: &str) -> String {
        self.with("1;31", text)
    }

    /// A line across the page.
    pub fn rule(self) -> String {
        self.dim(&"─".repeat(self.width))
    }
}

/// A text in lines of at most so many characters, broken between words.
pub fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let Some(line) = lines.last_mut() else { break };
        let (have, more) = (line.chars().count(), word.chars().count());
        if have > 0 && have + 1 + more > width {
            lines.push(word.to_owned());
        } else {
            if have > 0 {
                line.push(' ');
            }
            line.push_str(word);
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_broken_between_words() {
        assert_eq!(wrap("one two three", 7), ["one two", "three"]);
        assert_eq!(wrap("unbreakable", 3), ["unbreakable"]);
        assert_eq!(wrap("", 3), [""]);
    }

    #[test]
    fn without_colour_a_text_stays_as_it_is() {
        let paint = Paint { colour: false, width: 80 };
        assert_eq!(paint.alarm("x"), "x");
        assert_eq!(Paint { colour: true, ..paint }.alarm("x"), "\x1b[1;31mx\x1b[0m");
    }
}
