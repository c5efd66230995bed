//! The lexer by examples.

use super::*;
use crate::block::StatementKind;
use crate::print_block;

/// Every block of a text as `line:column words|comments!faults`.
fn blocks(text: &str) -> Vec<String> {
    let mut out = Vec::new();
    let mut block = Block::default();
    let mut cursor = Cursor::HEAD;
    loop {
        let window = &text.as_bytes()[cursor.offset as usize..];
        match read_block(window, true, cursor, &Grammar { block_length: 40, ..Grammar::default() }, &mut block) {
            Outcome::Block => {}
            Outcome::End => return out,
            Outcome::More => unreachable!("the window is the whole text"),
        }
        let own = &text.as_bytes()[block.start.offset as usize..][..block.len as usize];
        let mut printed = Vec::new();
        print_block(&block, own, &mut printed);
        let mut line = format!("{}:{} ", block.start.line, block.start.offset - block.start.line_start + 1);
        line += &String::from_utf8_lossy(&printed);
        for fault in &block.faults {
            line += &format!(" !{}@{}", fault.condition.id(), fault.extent.at);
        }
        out.push(line);
        cursor = block.next;
    }
}

#[test]
fn words_need_no_blanks_and_blanks_mean_nothing() {
    assert_eq!(blocks("N1G01X1.5Y-2\n  G 0 X 1 0\n"), ["1:1 N1G01X1.5Y-2", "2:3 G0X10"]);
}

#[test]
fn semicolons_end_blocks_but_not_inside_comments() {
    assert_eq!(blocks("G90;G00X1.(A;B);M30"), ["1:1 G90", "1:5 G00X1.", "1:17 M30"]);
}

#[test]
fn the_tape_sign_is_a_block_of_its_own() {
    assert_eq!(blocks("%\nO1\nM30%"), ["1:1 %", "2:1 O1", "3:1 M30", "3:4 %"]);
}

#[test]
fn block_delete_stands_anywhere() {
    assert_eq!(blocks("/G1X1.\nG0/3X2.\n"), ["1:1 /G1X1.", "2:1 G0/3X2."]);
}

#[test]
fn macro_statements_are_recognised_with_their_words_before() {
    assert_eq!(blocks("#1=2\nN5IF[#1EQ2]GOTO9\nX#1Y-[#2+1]"), ["1:1 #1=2", "2:1 N5IF[#1EQ2]GOTO9", "3:1 X#1Y-[#2+1]"]);
    let mut block = Block::default();
    read_block(b"WHILE[#1LT3]DO1", true, Cursor::HEAD, &Grammar::default(), &mut block);
    assert_eq!(block.statement.map(|s| s.kind), Some(StatementKind::While));
}

#[test]
fn faults_stand_where_they_are_and_reading_goes_on() {
    assert_eq!(
        blocks("X\nG1 5 X1..2\n&G1\n(A\nB)\nx1\n"),
        [
            "1:1 X !number-missing@0",
            "2:1 G15X1.2 !sign-or-point@5",
            "3:1 G1 !character-unknown@0",
            "4:1  !comment-open@0",
            "5:1 B !number-missing@0 !comment-close@1",
            "6:1 X1 !lower-case@0",
        ]
    );
    assert_eq!(blocks(&"X1".repeat(25)).len(), 1);
    assert!(blocks(&"X1".repeat(25))[0].ends_with("!block-too-long@40"));
}

#[test]
fn a_line_without_end_is_refused_once_and_passed_over() {
    let text = format!("{}\nM30", "X1".repeat(20_000));
    let found = blocks(&text);
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found[0].ends_with("!block-too-long@40") && found[1].ends_with("M30"));
    let leader = format!("{}G0", "\0".repeat(30_000));
    assert!(blocks(&leader).last().is_some_and(|last| last.ends_with(" G0")));
}

#[test]
fn every_window_gives_the_same_blocks() {
    let text = b"%\nO1(A)\nN1G01X1.5/Y-2.;G0X#1\n#1=[2]\nIF[#1]GOTO 1\n%";
    let whole = read_all(text, text.len());
    for size in 1..text.len() {
        assert_eq!(read_all(text, size), whole, "windows of {size}");
    }
}

fn read_all(text: &[u8], size: usize) -> Vec<Block> {
    let (mut out, mut cursor, mut size_now) = (Vec::new(), Cursor::HEAD, size);
    let mut block = Block::default();
    loop {
        let rest = &text[cursor.offset as usize..];
        let window = &rest[..size_now.min(rest.len())];
        match read_block(window, window.len() == rest.len(), cursor, &Grammar::default(), &mut block) {
            Outcome::Block => {
                out.push(block.clone());
                cursor = block.next;
                size_now = size;
            }
            Outcome::More => size_now += 1,
            Outcome::End => return out,
        }
    }
}
