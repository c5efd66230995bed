//! A finding in words: its word found in the block's text, its sentences filled, what the text allows passed over.

use base::{Diagnostic, Label, Severity, Span, UnitSystem};
use dialect::Control;
use syntax::{Block, Cursor, Outcome, Value, Word, read_block};
use tape::Reader;

use crate::finding::{At, Finding, Readings};
use crate::look::{number, plain};
use crate::rules::Rule;

/// Shown if a row is missing, which the tests do not let happen.
const NO_SENTENCE: &str = "";

impl Finding {
    /// The finding for people. `bytes` are the block's own, `widest` the machine's longest travel in mm or degrees.
    ///
    /// `None` if a comment of the block allows it, as `(allow: integer-coordinate)`, or if a number without a point
    /// has one reading only.
    pub fn show(&self, control: &Control, bytes: &[u8], widest: f64, severity: Severity) -> Option<Diagnostic> {
        let block = read(self, control, bytes);
        if let Some(block) = &block
            && allows(block, bytes, self.rule)
        {
            return None;
        }
        let word = block.as_ref().and_then(|block| find(block, self.at));
        let span = word.map_or(self.place.block, |word| word.extent.span(self.place.block.start));
        let mut values = self.values.clone();
        if let Some(readings) = self.readings {
            values.extend(two_readings(control, word?, readings, (self.coarse, self.whole_units), widest)?);
        }
        let written = text_of(bytes, Span { start: span.start - self.place.block.start, len: span.len });
        values.push(("word", written));
        let sentences = control.warning(self.rule.name(), self.shade).unwrap_or([NO_SENTENCE; 3]);
        let fill = |text: &str| fill(text, &values);
        let labels = self.beside.iter().map(|beside| Label {
            place: beside.place,
            span: beside.place.block,
            text: beside.text.to_owned(),
        });
        let label = match self.readings {
            Some(_) => fill("{here}, not {other}"),
            None => self.label.clone(),
        };
        Some(Diagnostic {
            code: self.rule.name(),
            severity,
            message: fill(sentences[0]),
            why: fill(sentences[1]),
            help: fill(sentences[2]),
            alarm: None,
            place: self.place,
            span,
            label,
            fix: None,
            labels: labels.collect(),
        })
    }
}

/// The block of a finding, read once more from its own bytes.
fn read(finding: &Finding, control: &Control, bytes: &[u8]) -> Option<Block> {
    let place = &finding.place;
    let mut characters = bytes.get(..place.block.len as usize)?.to_vec();
    let settled = tape::Text.translate(&mut characters, place.block.start, true);
    let cursor = Cursor { offset: place.block.start, line: place.line, line_start: place.line_start, skipping: false };
    let mut block = Block::default();
    match read_block(characters.get(..settled)?, true, cursor, &control.grammar, &mut block) {
        Outcome::Block => Some(block),
        _ => None,
    }
}

/// The word that is meant.
fn find(block: &Block, at: At) -> Option<&Word> {
    let is = |word: &&Word, letter: u8, code: i64| {
        word.letter == letter && matches!(word.value, Value::Number(number) if number.integer() == Some(code))
    };
    match at {
        At::Block => None,
        At::Letter(letter) => block.words.iter().rfind(|word| word.letter == letter),
        At::G(code) => block.words.iter().find(|word| is(word, b'G', i64::from(code))),
        At::M(code) => block.words.iter().find(|word| is(word, b'M', i64::from(code))),
    }
}

fn text_of(bytes: &[u8], span: Span) -> String {
    let start = usize::try_from(span.start).unwrap_or(usize::MAX);
    let end = start.saturating_add(span.len as usize).min(bytes.len());
    String::from_utf8_lossy(bytes.get(start..end).unwrap_or_default()).into_owned()
}

/// True if a comment of the block allows what the rule warns of.
fn allows(block: &Block, bytes: &[u8], rule: Rule) -> bool {
    block.comments.iter().any(|comment| {
        let text = text_of(bytes, Span { start: u64::from(comment.at), len: u32::from(comment.len) });
        names_allowed(&text)
            .is_some_and(|names| names.split([',', ' ']).any(|name| Rule::from_name(name.trim()) == Some(rule)))
    })
}

/// What a comment allows, as it writes it, if it is one that does.
pub(crate) fn names_allowed(comment: &str) -> Option<&str> {
    let inner = comment.trim_matches(|c: char| c.is_whitespace() || "(;)".contains(c));
    let (key, names) = inner.split_once(':')?;
    key.trim().eq_ignore_ascii_case("allow").then_some(names)
}

/// Both readings of a number without a point, unless only one can be meant.
fn two_readings(
    control: &Control,
    word: &Word,
    readings: Readings,
    (coarse, whole_units): (i64, bool),
    widest: f64,
) -> Option<[(&'static str, String); 2]> {
    let (Value::Number(written), Some(address)) = (word.value, control.address(word.letter)) else { return None };
    let whole = written.integer()? as f64;
    let (counted, unit, per_unit, limit) = match readings {
        Readings::Millimetres => {
            (control.length(address, written, UnitSystem::Metric, coarse).ok()? as f64 / 1e6, "mm", 1.0, widest)
        }
        Readings::Inches => {
            (control.length(address, written, UnitSystem::Inch, coarse).ok()? as f64 / 25.4e6, "in", 25.4, widest)
        }
        Readings::Degrees => (control.angle(address, written).ok()? as f64 / 1e6, "deg", 1.0, 360.0),
    };
    if !whole_units && whole.abs() * per_unit > limit {
        return None;
    }
    let counted = if unit == "in" { plain_inches(counted) } else { number(counted) };
    let (here, other) = (format!("{counted} {unit}"), format!("{} {unit}", plain(whole * 1e6)));
    Some(if whole_units { [("here", other), ("other", here)] } else { [("here", here), ("other", other)] })
}

/// Inches have a fourth decimal.
fn plain_inches(value: f64) -> String {
    let text = format!("{value:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Puts values into a sentence.
fn fill(text: &str, values: &[(&'static str, String)]) -> String {
    let mut out = String::with_capacity(text.len() + 32);
    let mut rest = text;
    while let Some(open) = rest.find('{') {
        out.push_str(&rest[..open]);
        let Some(close) = rest[open..].find('}') else { break };
        let name = &rest[open + 1..open + close];
        match values.iter().find(|(known, _)| *known == name) {
            Some((_, value)) => out.push_str(value),
            None => out.push('?'),
        }
        rest = &rest[open + close + 1..];
    }
    out.push_str(rest);
    out
}
