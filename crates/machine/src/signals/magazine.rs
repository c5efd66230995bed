//! The tool magazine: it turns to a pocket by T, the tool change puts that tool into the spindle.
//!
//! Each tool has its own pocket, of the same number: what the spindle carried goes back where it came from.

use base::Seconds;
use data::Table;
use meaning::{CodeLine, CodeOut};

use crate::path_table::not_negative;

/// What the builder says of the magazine.
#[derive(Clone, PartialEq, Debug)]
pub struct MagazineFacts {
    /// Its pockets, from 1.
    pub pockets: u32,
    /// From one pocket to the next, s, beside the time of T itself.
    pub pocket_time: f64,
    /// M codes that change the tool.
    pub change: Vec<u32>,
}

impl Default for MagazineFacts {
    /// A file without `[magazine]`.
    fn default() -> MagazineFacts {
        MagazineFacts { pockets: 20, pocket_time: 0.0, change: vec![6] }
    }
}

/// Reads `[magazine]`.
pub(crate) fn magazine(table: &mut Table) -> MagazineFacts {
    let missing = MagazineFacts::default();
    let place = table.place_of("pockets").unwrap_or_default();
    let pockets = match table.integer("pockets").map(u32::try_from) {
        None => missing.pockets,
        Some(Ok(pockets @ 1..=9999)) => pockets,
        Some(_) => {
            table.error(place, "pockets is a number from 1 to 9999");
            missing.pockets
        }
    };
    let codes = |list: Vec<i64>| list.into_iter().filter_map(|code| u32::try_from(code).ok()).collect();
    MagazineFacts {
        pockets,
        pocket_time: not_negative(table, "pocket_time", missing.pocket_time),
        change: table.integers("tool_change").map_or(missing.change, codes),
    }
}

/// A magazine in virtual time.
#[derive(Clone, PartialEq, Debug)]
pub struct Magazine {
    facts: MagazineFacts,
    /// The pocket at the place of change.
    pocket: u32,
    /// The tool in the spindle, 0 for none.
    tool: u32,
}

impl Magazine {
    /// Pocket 1 is at the place of change, the spindle is empty.
    pub fn new(facts: MagazineFacts) -> Magazine {
        Magazine { facts, pocket: 1, tool: 0 }
    }

    /// The tool in the spindle, 0 for none.
    pub const fn tool(&self) -> u32 {
        self.tool
    }

    /// The pocket at the place of change.
    pub const fn pocket(&self) -> u32 {
        self.pocket
    }

    /// The machine takes a code, if it is about tools: how much longer than its own time that lasts.
    pub fn take(&mut self, code: CodeOut) -> Seconds {
        let steps = match code.line {
            // A pocket that the magazine does not have is not looked for.
            CodeLine::T if (1..=self.facts.pockets).contains(&code.code) => {
                let way = self.pocket.abs_diff(code.code);
                self.pocket = code.code;
                way.min(self.facts.pockets - way)
            }
            CodeLine::M if self.facts.change.contains(&code.code) => {
                self.tool = self.pocket;
                0
            }
            _ => 0,
        };
        Seconds(f64::from(steps) * self.facts.pocket_time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_turns_the_shorter_way_and_changes_the_tool() {
        let mut magazine = Magazine::new(MagazineFacts { pocket_time: 0.5, ..MagazineFacts::default() });
        let code = |line, code| CodeOut { line, code, digits: 2, after_motion: false };
        assert_eq!(magazine.take(code(CodeLine::T, 5)), Seconds(2.0));
        assert_eq!(magazine.tool(), 0);
        assert_eq!(magazine.take(code(CodeLine::M, 6)), Seconds(0.0));
        assert_eq!(magazine.tool(), 5);
        // Backward over pocket 1 and 20: 5, 4, 3, 2, 1, 20, 19.
        assert_eq!(magazine.take(code(CodeLine::T, 19)), Seconds(3.0));
        assert_eq!(magazine.take(code(CodeLine::T, 99)), Seconds(0.0));
        assert_eq!((magazine.tool(), magazine.pocket()), (5, 19));
    }
}
