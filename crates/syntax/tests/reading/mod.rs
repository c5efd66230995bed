//! Reads whole texts in windows of any size and asserts what every reading keeps. The fuzz target `read` uses it too.

use base::Condition;
use syntax::{
    Block, Cursor, Extent, Fault, Grammar, Outcome, Skip, StatementKind, Value, Word, print_block, read_block,
};
use tape::{Reader, Text};

/// A text's characters, translated in one piece.
pub fn characters(text: &[u8]) -> Vec<u8> {
    let mut characters = text.to_vec();
    assert_eq!(Text.translate(&mut characters, 0, true), text.len(), "the last chunk is settled to its end");
    characters
}

/// Every block of a text that is offered in windows of these sizes in turn; a window too short for a block grows.
///
/// Asserts that reading advances, that the windows' characters are those of the whole text, and what
/// [`check_block`] says of each block.
pub fn read_all(text: &[u8], grammar: &Grammar, sizes: &[usize]) -> Vec<Block> {
    let whole = characters(text);
    let (mut blocks, mut block, mut window) = (Vec::new(), Block::default(), Vec::new());
    let (mut cursor, mut turn, mut longer) = (Cursor::HEAD, 0, 0);
    let mut lines = Lines::default();
    loop {
        let from = cursor.offset as usize;
        let to = (from + sizes[turn % sizes.len()].max(1) + longer).min(text.len());
        window.clear();
        window.extend_from_slice(&text[from..to]);
        let settled = Text.translate(&mut window, cursor.offset, to == text.len());
        window.truncate(settled);
        assert_eq!(window, whole[from..from + settled], "a window has the characters of the whole text");
        let last = from + settled == text.len();
        match read_block(&window, last, cursor, grammar, &mut block) {
            Outcome::More => {
                assert!(!last, "the text has ended, there is no more");
                // Doubling keeps texts without line ends from being read over and over.
                longer = (longer * 2).max(1);
                continue;
            }
            Outcome::End => {
                assert!(last, "the text ends with its last window");
                return blocks;
            }
            Outcome::Block => {}
        }
        check_block(&block, cursor, &whole);
        lines.check(&block.start, &whole);
        cursor = block.next;
        (turn, longer) = (turn + 1, 0);
        blocks.push(block.clone());
    }
}

/// Line numbers counted by another way than the reader's.
#[derive(Default)]
struct Lines {
    at: usize,
    ends: u64,
    start: u64,
}

impl Lines {
    fn check(&mut self, cursor: &Cursor, whole: &[u8]) {
        let to = cursor.offset as usize;
        for (index, _) in whole[self.at..to].iter().enumerate().filter(|(_, b)| **b == b'\n') {
            self.ends += 1;
            self.start = (self.at + index + 1) as u64;
        }
        self.at = to;
        assert_eq!((cursor.line, cursor.line_start), (self.ends + 1, self.start), "line of the block at {to}");
    }
}

/// Asserts that a block lies in its text behind `before`, and everything in the block inside it.
pub fn check_block(block: &Block, before: Cursor, whole: &[u8]) {
    let (start, end, next) = (block.start.offset, block.start.offset + u64::from(block.len), block.next.offset);
    assert!(next > before.offset, "reading advances: {block:?}");
    assert!(
        before.offset <= start && end <= next && next <= whole.len() as u64,
        "the block lies in the text: {block:?}"
    );
    let inside = |what: &str, extent: &Extent| {
        let end = u32::from(extent.at) + u32::from(extent.len);
        assert!(extent.len > 0 && end <= block.len, "{what} {extent:?} lies in the block: {block:?}");
    };
    block.words.iter().for_each(|word| inside("word", &word.extent));
    block.comments.iter().for_each(|comment| inside("comment", comment));
    block.skips.iter().for_each(|skip| inside("skip", &skip.extent));
    for fault in &block.faults {
        if fault.condition == Condition::BlockTooLong {
            // The control counts the end-of-block too: it may be the one character too many.
            let end = start + u64::from(fault.extent.at) + u64::from(fault.extent.len);
            assert!(end <= next, "fault {fault:?} lies in the block or its end: {block:?}");
        } else {
            inside("fault", &fault.extent);
        }
    }
    block.call_name.iter().for_each(|name| inside("name", name));
    block.statement.iter().for_each(|statement| inside("statement", &statement.extent));
    assert!(block.words.is_sorted_by_key(|word| word.extent.at), "words in their order");
    assert!(block.words.iter().all(|word| word.letter.is_ascii_uppercase()), "letters are capitals");
    assert!(block.skips.iter().all(|skip| (1..=9).contains(&skip.switch)), "switches 1 to 9");
}

/// What a block says, apart from where the next one begins (over-long lines are passed over window by window).
pub type Said =
    (Cursor, u32, bool, Vec<Word>, Vec<Skip>, [Vec<Extent>; 2], Option<(StatementKind, Extent)>, Vec<Fault>);

/// The blocks that hold any character, as what they say.
pub fn said(blocks: &[Block]) -> Vec<Said> {
    let full = blocks.iter().filter(|block| block.len > 0);
    full.map(|block| {
        let Block { start, len, rewind, words, skips, comments, call_name, statement, faults, .. } = block.clone();
        let texts = [comments, call_name.into_iter().collect()];
        (start, len, rewind, words, skips, texts, statement.map(|s| (s.kind, s.extent)), faults)
    })
    .collect()
}

/// A block's words and statement by value, without places.
type Values = (bool, Vec<(u8, Value, Vec<u8>)>, Vec<(u8, u16)>, Option<Vec<u8>>, Option<(StatementKind, Vec<u8>)>);

fn values(block: &Block, own: &[u8]) -> Values {
    let text = |extent: Extent| -> Vec<u8> {
        let from = usize::from(extent.at);
        own[from..from + usize::from(extent.len)].iter().copied().filter(|&b| b != 0).collect()
    };
    let word = |word: &Word| {
        let expression = if word.value == Value::Expression { text(word.extent)[1..].to_vec() } else { Vec::new() };
        (word.letter, word.value, expression)
    };
    let words = block.words.iter().map(word).collect();
    let skips = block.skips.iter().map(|skip| (skip.switch, skip.first_word)).collect();
    (
        block.rewind,
        words,
        skips,
        block.call_name.map(text),
        block.statement.map(|statement| (statement.kind, text(statement.extent))),
    )
}

/// Asserts that a block without faults is printed to a text that says the same, and is printed the same again.
pub fn check_print(block: &Block, whole: &[u8], grammar: &Grammar) {
    let own = &whole[block.start.offset as usize..][..block.len as usize];
    let mut printed = Vec::new();
    print_block(block, own, &mut printed);
    // A blank or a sign inside the code of a call, `M9 8 P5`, leaves words behind it; printed it is followed by a name.
    let is_call = |word: &Word| match word.value {
        Value::Number(number) => word.letter == b'M' && number.integer() == grammar.named_call.map(i64::from),
        _ => false,
    };
    let bare_call = block.call_name.is_none() && grammar.named_call.is_some() && block.words.iter().any(is_call);
    if !block.faults.is_empty() || printed.is_empty() || bare_call {
        return;
    }
    let mut again = Block::default();
    // Printing the name of a call between blanks makes a block longer.
    let grammar = Grammar { block_length: u32::MAX, ..*grammar };
    let outcome = read_block(&printed, true, Cursor::HEAD, &grammar, &mut again);
    let shown = String::from_utf8_lossy(&printed);
    assert_eq!(outcome, Outcome::Block, "{shown}");
    assert_eq!(again.next.offset as usize, printed.len(), "one block is printed as one: {shown}");
    assert_eq!(again.faults, [], "{shown}");
    assert_eq!(values(&again, &printed), values(block, own), "{shown}");
    let mut twice = Vec::new();
    print_block(&again, &printed, &mut twice);
    assert_eq!(twice, printed, "{shown}");
}
