//! The remarks in a piece of a program's text.

use syntax::{Block, Cursor, Grammar, Outcome, read_block};
use tape::{Reader, Text};

use crate::explain::printable;

/// Every remark, without its parentheses.
pub fn remarks(text: &[u8], grammar: &Grammar) -> Vec<String> {
    let mut found = Vec::new();
    walk(text, grammar, |block, own| {
        found.extend(of_block(block, own));
        true
    });
    found
}

/// The remarks that stand over what follows the text: those of its last lines, up to a blank one.
pub fn remarks_above(text: &[u8], grammar: &Grammar) -> Vec<String> {
    let mut found = Vec::new();
    let mut line = 0;
    walk(text, grammar, |block, own| {
        let blank = block.is_empty() && block.comments.is_empty();
        // The rest of the line of the block before is no blank line.
        if blank && block.start.line > 1 && block.start.line != line {
            found.clear();
        }
        line = block.start.line;
        found.extend(of_block(block, own));
        true
    });
    found
}

/// The remarks at a program's head: those of its first block that says anything and of the lines around it, up to the
/// first blank line or the next block.
pub fn header(text: &[u8], grammar: &Grammar) -> Vec<String> {
    let mut found = Vec::new();
    let mut said = 0;
    walk(text, grammar, |block, own| {
        let names = block.begins_program(grammar);
        said += usize::from(!block.is_empty());
        if said > 1 || (said == 1 && !block.is_empty() && !names) {
            return false;
        }
        found.extend(of_block(block, own));
        // A blank line ends the head; what is before it stays.
        !block.is_empty() || !block.comments.is_empty() || block.rewind || found.is_empty()
    });
    found
}

fn of_block(block: &Block, own: &[u8]) -> Vec<String> {
    let part = |at: u16, len: u16| own.get(usize::from(at)..usize::from(at) + usize::from(len)).unwrap_or_default();
    let texts = block.comments.iter().map(|comment| printable(part(comment.at, comment.len)));
    let bare = texts.map(|text| text.trim_matches(['(', ')', ';']).trim().to_owned());
    bare.filter(|text| !text.is_empty()).collect()
}

fn walk(text: &[u8], grammar: &Grammar, mut see: impl FnMut(&Block, &[u8]) -> bool) {
    let mut characters = text.to_vec();
    Text.translate(&mut characters, 0, true);
    let (mut block, mut cursor) = (Block::default(), Cursor::HEAD);
    loop {
        let window = characters.get(cursor.offset as usize..).unwrap_or_default();
        if read_block(window, true, cursor, grammar, &mut block) != Outcome::Block {
            return;
        }
        let from = block.start.offset as usize;
        let own = characters.get(from..from + block.len as usize).unwrap_or_default();
        if !see(&block, own) {
            return;
        }
        cursor = block.next;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_head_ends_with_the_first_block_that_moves() {
        let text = b"%\nO1000 (PLATE)\n(T1 MILL)\nN1 G90\n(LATER)\n";
        assert_eq!(header(text, &Grammar::default()), ["PLATE", "T1 MILL"]);
        assert_eq!(header(b"(A)\n(B)\n\n(C)\nG90\n", &Grammar::default()), ["A", "B"]);
    }

    #[test]
    fn what_stands_above_a_blank_line_belongs_to_something_else() {
        let above = |text: &[u8]| remarks_above(text, &Grammar::default());
        assert_eq!(above(b"(OLD)\n(HEAD)\n\n(NEW)\n(TWO)\n"), ["NEW", "TWO"]);
        assert_eq!(above(b" \n(ONE)\n"), ["ONE"]);
    }

    #[test]
    fn remarks_lose_their_parentheses() {
        assert_eq!(remarks(b"\n(ONE) N1 T1 (  TWO )\n", &Grammar::default()), ["ONE", "TWO"]);
    }
}
