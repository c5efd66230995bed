//! What is wrong with a data file, and where.

use std::fmt;

/// One error in a data file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct DataError {
    /// The file's name as the user gave it.
    pub file: String,
    /// 1-based line.
    pub line: usize,
    /// 1-based column, in bytes.
    pub column: usize,
    /// The text of that line.
    pub source: String,
    /// How many characters are meant.
    pub width: usize,
    /// What is wrong and what would be right.
    pub message: String,
}

impl DataError {
    /// An error at a byte range of a text.
    pub fn at(file: &str, text: &str, range: std::ops::Range<usize>, message: String) -> DataError {
        let start = range.start.min(text.len());
        let before = &text.as_bytes()[..start];
        let line_start = before.iter().rposition(|&b| b == b'\n').map_or(0, |at| at + 1);
        let line_end = text.as_bytes()[start..].iter().position(|&b| b == b'\n').map_or(text.len(), |at| start + at);
        DataError {
            file: file.to_owned(),
            line: before.iter().filter(|&&b| b == b'\n').count() + 1,
            column: start - line_start + 1,
            source: String::from_utf8_lossy(&text.as_bytes()[line_start..line_end]).trim_end().to_owned(),
            width: range.end.min(line_end).saturating_sub(start).max(1),
            message,
        }
    }
}

impl DataError {
    /// What is wrong and where, without the word `error`.
    pub fn statement(&self) -> String {
        let DataError { file, line, column, source, width, message } = self;
        let gutter = line.to_string().len();
        let underline = format!("{:>column$}{:^<more$}", "^", "", more = width - 1);
        let edge = format!("{:gutter$}", "");
        format!("{message}\n{edge}--> {file}:{line}:{column}\n{edge} |\n{line} | {source}\n{edge} | {underline}")
    }
}

impl fmt::Display for DataError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "error: {}", self.statement())
    }
}

impl std::error::Error for DataError {}
