//! Sequence-number and program search: the pointer goes there, and nothing is executed.

use syntax::Cursor;

use super::{Begins, Loaded, Operator, Said, table};
use crate::block_target::At;
use crate::catalogue::blocks_of;
use crate::display::Value;
use crate::library::{LibraryError, Shelf};
use crate::session::Session;

impl<L: Shelf> Operator<L> {
    /// Searches a program, or a block of the selected one; the inner error is why not.
    pub(super) fn search(
        &mut self,
        wanted: &str,
        tell: &mut dyn FnMut(&mut Session<L>, Said),
    ) -> Result<Result<(), String>, LibraryError> {
        let is_edit = self.mode().kind == dialect::ModeKind::Edit;
        if !is_edit && table::begins(self.mode()) != Ok(Begins::Memory) {
            return Ok(Err(format!(
                "programs and blocks are searched in modes memory and edit, not in mode {}",
                self.mode().name
            )));
        }
        let Ok(At::Sequence(number)) = crate::block_target::sequence(wanted) else {
            return Ok(self.select(wanted));
        };
        let Some(Loaded { name, source, head, .. }) =
            self.selected.as_ref().and_then(|key| self.programs.get(key)).cloned()
        else {
            return Ok(Err("no program is selected".to_owned()));
        };
        let interpreter = self.session.interpreter();
        let (grammar, codes) = (interpreter.control().grammar, interpreter.fitting().tape_codes(interpreter.control()));
        // From the pointer on to the program's end, then from its head.
        let from =
            if self.session.stands_at_head() { 0 } else { interpreter.pointer().map_or(0, |pointer| pointer.offset()) };
        let (mut first, mut behind, mut begun): (Option<Cursor>, Option<Cursor>, bool) = (None, None, false);
        blocks_of(self.session.library_mut(), source, &grammar, codes, |block, _| {
            if block.start.offset < head.offset {
                return true;
            }
            if begun && (block.rewind || block.begins_program(&grammar)) {
                return false;
            }
            begun |= !block.rewind && !block.is_empty();
            if block.whole_number(b'N') == Some(i64::from(number)) {
                first.get_or_insert(block.start);
                if block.start.offset > from {
                    behind = Some(block.start);
                }
            }
            behind.is_none()
        })?;
        let Some(found) = behind.or(first) else {
            return Ok(Err(format!("there is no N{number} in {name}")));
        };
        self.session.point_at(found);
        let value = Value::object([
            ("program", Value::Text(name)),
            ("line", Value::Number(found.line as f64)),
            ("n", Value::Number(f64::from(number))),
            ("warning", Value::Text(WARNING.to_owned())),
        ]);
        tell(&mut self.session, Said::Shown { what: "search".to_owned(), value });
        Ok(Ok(()))
    }
}

/// What is said with every block that was found.
const WARNING: &str = "nothing before this block has been executed: codes, offsets and places are as they stand";
