//! How a refused block can be written legally: one way a condition, which `conditions.toml` names.
//!
//! Codes move, words stay as they are written. What comes out is held against the control's own rules before it is
//! offered. `safe` says that the programmer evidently meant this and nothing else.

use base::Condition;
use syntax::{Block, Extent, Value};

use crate::combination::Combination;
use crate::control::Control;
use crate::meaning::Meaning;
use crate::row::{Class, GCode, Takes};

/// The ways in which a refused block is written anew.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Fix {
    /// States before the movement; those that are too many in blocks before it.
    StatesFirst,
    /// One code of each group.
    OneOfGroup,
    /// One movement; a mode that another movement only leaves behind gets a block of its own.
    OneMovement,
    /// States in a block before the code that stands alone.
    StatesApart,
    /// The movement in force is written out.
    MovementWritten,
    /// States in a block before the call.
    CallApart,
    /// A word that is there already goes.
    OneWord,
    /// A block for each M code.
    OneMCode,
}

/// The names of the ways in `conditions.toml`.
pub(crate) const FIXES: &[(&str, Fix)] = &[
    ("states-first", Fix::StatesFirst),
    ("one-of-group", Fix::OneOfGroup),
    ("one-movement", Fix::OneMovement),
    ("states-apart", Fix::StatesApart),
    ("movement-written", Fix::MovementWritten),
    ("call-apart", Fix::CallApart),
    ("one-word", Fix::OneWord),
    ("one-m-code", Fix::OneMCode),
];

/// A block that the control has refused.
#[derive(Clone, Copy, Debug)]
pub struct Refused<'b> {
    /// The block.
    pub block: &'b Block,
    /// Its own characters.
    pub text: &'b [u8],
    /// The row of the movement code in force, where axis words would follow it.
    pub motion: Option<u8>,
}

/// A block written anew.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Rewritten {
    /// The blocks that take its place, one a line.
    pub text: Vec<u8>,
    /// The programmer evidently meant this.
    pub safe: bool,
}

/// A word on its way to another block.
#[derive(Clone)]
struct Word<'c> {
    letter: u8,
    text: Vec<u8>,
    row: Option<&'c GCode>,
}

impl Word<'_> {
    fn is(&self, class: Class) -> bool {
        self.row.is_some_and(|row| row.class == class)
    }

    fn takes(&self) -> Takes {
        self.row.map_or(Takes::Nothing, |row| row.takes)
    }

    fn group(&self) -> Option<u8> {
        self.row.and_then(|row| row.group)
    }

    fn means(&self, meaning: Meaning) -> bool {
        self.row.is_some_and(|row| row.meaning == meaning)
    }
}

type Blocks<'c> = Vec<Vec<Word<'c>>>;

impl Control {
    /// A block that was refused for this condition, as it can be written; `None` where nothing is evident.
    pub fn rewrite(&self, condition: Condition, refused: &Refused) -> Option<Rewritten> {
        let fix = self.fix_of(condition)?;
        let Refused { block, text, motion } = *refused;
        if block.statement.is_some() || block.call_name.is_some() || !block.faults.is_empty() || block.rewind {
            return None;
        }
        let words = self.words_of(block, text)?;
        let (head, words): (Vec<_>, Vec<_>) = words.into_iter().partition(|word| matches!(word.letter, b'N' | b'O'));
        let rewriter = Rewriter { control: self, combination: self.combination?, motion };
        let (blocks, safe) = match fix {
            Fix::StatesFirst => (rewriter.arrange(words), true),
            Fix::OneOfGroup => rewriter.one_of_group(words),
            Fix::OneMovement => rewriter.one_movement(words),
            Fix::StatesApart => rewriter.states_apart(words)?,
            Fix::MovementWritten => rewriter.movement_written(words)?,
            Fix::CallApart => (rewriter.call_apart(words)?, true),
            Fix::OneWord => (vec![one_word(words)?], true),
            Fix::OneMCode => (rewriter.one_m_code(words)?, true),
        };
        let legal = blocks.iter().all(|block| rewriter.is_legal(block));
        let text = print(&blocks, &head, block, text)?;
        legal.then_some(Rewritten { text, safe })
    }

    /// The words of a block with their rows; `None` if a code is a variable or unknown.
    fn words_of<'c>(&'c self, block: &Block, text: &[u8]) -> Option<Vec<Word<'c>>> {
        let read = |word: &syntax::Word| {
            let from = usize::from(word.extent.at);
            let own = text.get(from..from + usize::from(word.extent.len))?.to_vec();
            let mut row = None;
            if word.letter == b'G' {
                let Value::Number(number) = word.value else { return None };
                row = Some(self.g_codes.get(usize::from(self.g_row(number.integer()?)?))?);
            }
            Some(Word { letter: word.letter, text: own, row })
        };
        block.words.iter().map(read).collect()
    }
}

struct Rewriter<'c> {
    control: &'c Control,
    combination: Combination,
    motion: Option<u8>,
}

impl<'c> Rewriter<'c> {
    fn is_legal(&self, words: &[Word]) -> bool {
        let rows = words.iter().filter_map(|word| self.control.g_row(i64::from(word.row?.code)));
        self.combination.check(self.control, &rows.collect::<Vec<_>>()).is_ok()
    }

    fn is_axis(&self, word: &Word) -> bool {
        use crate::address::AddressKind::{LinearAxis, RotaryAxis};
        self.control.address(word.letter).is_some_and(|address| matches!(address.kind, LinearAxis | RotaryAxis))
    }

    /// The letters that belong to a state beside the axis words.
    fn letters_of(&self, word: &Word) -> &'static [u8] {
        let roles = &self.control.roles;
        match word.group().map(usize::from) {
            Some(group) if group == roles.compensation => b"D",
            Some(group) if group == roles.length => b"H",
            Some(group) if group == roles.feed_mode => b"F",
            group if group.is_some() && group == roles.surface_speed => b"S",
            _ => b"",
        }
    }

    /// True for a state that acts alike from a block before: it takes no word and does not begin with the movement.
    fn acts_apart(&self, word: &Word) -> bool {
        let letters = self.letters_of(word);
        word.is(Class::State) && word.takes() == Takes::Nothing && matches!(letters, b"" | b"F")
    }

    /// States before the movement, in as few blocks as the control allows.
    fn arrange(&self, words: Vec<Word<'c>>) -> Blocks<'c> {
        let words = states_before_movement(words);
        if self.is_legal(&words) {
            return vec![words];
        }
        let bare = words.iter().all(|word| word.is(Class::State));
        let (front, last): (Vec<_>, Vec<_>) = words.into_iter().partition(|word| bare || self.acts_apart(word));
        let mut blocks: Blocks = front.chunks(self.combination.most_states.max(1)).map(<[_]>::to_vec).collect();
        if !last.is_empty() {
            blocks.push(last);
        }
        blocks
    }

    fn one_of_group(&self, words: Vec<Word<'c>>) -> (Blocks<'c>, bool) {
        let once = without_repeats(words);
        let blocks = self.arrange(once.clone());
        if blocks.iter().all(|block| self.is_legal(block)) {
            return (blocks, true);
        }
        // Other controls obey the last.
        let is_last = |index: usize| {
            let later = once.get(index + 1..).unwrap_or_default();
            !once[index].is(Class::State) || !later.iter().any(|word| word.group() == once[index].group())
        };
        let last = (0..once.len()).filter(|&index| is_last(index)).map(|index| once[index].clone()).collect();
        (self.arrange(last), false)
    }

    fn one_movement(&self, words: Vec<Word<'c>>) -> (Blocks<'c>, bool) {
        let once = without_repeats(words);
        let movements = || once.iter().filter(|word| word.is(Class::Movement));
        if movements().count() < 2 {
            return (self.arrange(once), true);
        }
        let leaves_a_mode = |word: &&Word| word.means(Meaning::Rapid) || word.means(Meaning::Linear);
        let one_shot = movements().any(|word| word.group().is_none());
        if let (Some(mode), true, 2) = (movements().find(leaves_a_mode).cloned(), one_shot, movements().count()) {
            // G00 G28 Z0: G28 takes the words and goes at rapid, G00 is what holds afterwards.
            let safe = mode.means(Meaning::Rapid);
            let rest = once.iter().filter(|word| word.text != mode.text).cloned().collect();
            let mut blocks = vec![vec![mode]];
            blocks.extend(self.arrange(rest));
            return (blocks, safe);
        }
        let last = movements().next_back().map(|word| word.text.clone());
        let keep = |word: &Word| !word.is(Class::Movement) || Some(&word.text) == last.as_ref();
        (self.arrange(once.iter().filter(|word| keep(word)).cloned().collect()), false)
    }

    fn states_apart(&self, words: Vec<Word<'c>>) -> Option<(Blocks<'c>, bool)> {
        let once = without_repeats(words);
        let solos = once.iter().filter(|word| word.is(Class::Solo)).count();
        let ambiguous = |word: &Word| word.is(Class::Movement) || word.takes() != Takes::Nothing;
        if solos != 1 || once.iter().any(ambiguous) {
            return None;
        }
        let safe = !once.iter().any(|word| word.is(Class::Modifier));
        let own: Vec<u8> = once.iter().flat_map(|word| self.letters_of(word)).copied().collect();
        let goes_before = |word: &Word| word.is(Class::State) || own.contains(&word.letter);
        let kept = once.into_iter().filter(|word| !word.is(Class::Modifier));
        let (front, last): (Vec<_>, Vec<_>) = kept.partition(goes_before);
        let blocks = if front.is_empty() { vec![last] } else { vec![front, last] };
        Some((blocks, safe))
    }

    fn movement_written(&self, mut words: Vec<Word<'c>>) -> Option<(Blocks<'c>, bool)> {
        if !words.iter().any(|word| self.is_axis(word)) {
            // Nothing moves: the code has no effect here, but it was meant for something.
            words.retain(|word| !word.means(Meaning::ExactStop));
            return Some((self.arrange(words), false));
        }
        let row = self.control.g_codes.get(usize::from(self.motion?))?;
        let place = words.iter().rposition(|word| word.row.is_some())?;
        let text = format!("G{:02}", row.code).into_bytes();
        words.insert(place + 1, Word { letter: b'G', text, row: Some(row) });
        Some((self.arrange(words), true))
    }

    fn call_apart(&self, words: Vec<Word<'c>>) -> Option<Blocks<'c>> {
        let call = words.iter().position(|word| word.takes() == Takes::AllWords)?;
        let codes = |words: &[Word]| words.iter().filter(|word| word.row.is_some()).count();
        let behind = words.get(call + 1..).unwrap_or_default();
        let before = words.get(..call).unwrap_or_default();
        let plain = |word: &Word| word.row.is_none() || (word.is(Class::State) && word.takes() == Takes::Nothing);
        if codes(behind) > 0 || codes(before) == 0 || !before.iter().all(plain) {
            return None;
        }
        let (front, last): (Vec<_>, Vec<_>) = words.into_iter().partition(|word| word.is(Class::State) && plain(word));
        let mut blocks = self.arrange(front);
        blocks.push(last);
        Some(blocks)
    }

    /// Only codes of the machine builder, in a block without movement: how the others act together is not ours to say.
    fn one_m_code(&self, words: Vec<Word<'c>>) -> Option<Blocks<'c>> {
        let own = |word: &Word| {
            let digits = word.text.get(1..).and_then(|digits| std::str::from_utf8(digits).ok());
            word.letter == b'M'
                && digits
                    .and_then(|digits| digits.trim().parse().ok())
                    .is_none_or(|code| self.control.m_code(code).is_some())
        };
        if words.iter().any(|word| word.row.is_some() || self.is_axis(word) || own(word)) {
            return None;
        }
        let mut blocks: Blocks = vec![Vec::new()];
        for word in words {
            let is_first = word.letter != b'M' || !blocks[0].iter().any(|other| other.letter == b'M');
            if is_first { blocks[0].push(word) } else { blocks.push(vec![word]) }
        }
        Some(blocks)
    }
}

/// The states in the places of the block's first codes, its other codes behind them.
fn states_before_movement(mut words: Vec<Word>) -> Vec<Word> {
    let places: Vec<usize> = (0..words.len()).filter(|&index| words[index].row.is_some()).collect();
    let mut codes: Vec<Word> = places.iter().map(|&place| words[place].clone()).collect();
    codes.sort_by_key(|word| !word.is(Class::State));
    for (place, code) in places.into_iter().zip(codes) {
        words[place] = code;
    }
    words
}

/// Each code once.
fn without_repeats(words: Vec<Word>) -> Vec<Word> {
    let mut once: Vec<Word> = Vec::with_capacity(words.len());
    for word in words {
        let code = |word: &Word| word.row.map(|row| row.code);
        if word.row.is_none() || !once.iter().any(|other| code(other) == code(&word)) {
            once.push(word);
        }
    }
    once
}

/// Words written twice, once; `None` if two of one letter differ.
fn one_word(words: Vec<Word>) -> Option<Vec<Word>> {
    let mut once: Vec<Word> = Vec::with_capacity(words.len());
    for word in words {
        match once.iter().find(|other| other.letter == word.letter && !matches!(word.letter, b'G' | b'M')) {
            Some(other) if other.text.eq_ignore_ascii_case(&word.text) => {}
            Some(_) => return None,
            None => once.push(word),
        }
    }
    Some(once)
}

/// The blocks as lines: number and label on the first, the block-delete sign on each, comments where they were.
fn print(blocks: &Blocks, head: &[Word], block: &Block, text: &[u8]) -> Option<Vec<u8>> {
    let first = block.words.first()?.extent.at;
    if block.skips.len() > 1 || block.skips.iter().any(|skip| usize::from(skip.first_word) > head.len()) {
        return None;
    }
    let part = |at: u16, len: u16| text.get(usize::from(at)..usize::from(at) + usize::from(len)).unwrap_or_default();
    // As the last two words stand, so do all.
    let apart = match block.words.as_slice() {
        [.., one, other] => {
            let end = one.extent.at + one.extent.len;
            part(end, other.extent.at.saturating_sub(end)).iter().any(|byte| matches!(byte, b' ' | b'\t'))
        }
        _ => true,
    };
    let blank: &[u8] = if apart { b" " } else { b"" };
    let (leading, trailing): (Vec<Extent>, Vec<Extent>) = block.comments.iter().partition(|comment| comment.at < first);
    let mut lines = Vec::with_capacity(blocks.len());
    for (index, words) in blocks.iter().enumerate() {
        let is_last = index + 1 == blocks.len();
        let (mut parts, mut words_behind): (Vec<&[u8]>, Vec<&[u8]>) = (Vec::new(), Vec::new());
        if index == 0 {
            parts.extend(leading.iter().map(|comment| part(comment.at, comment.len)));
        }
        let behind_number = block.skips.iter().any(|skip| skip.first_word > 0);
        let numbers = head.iter().filter(|_| index == 0).map(|word| word.text.as_slice());
        let sign = block.skips.first().map(|skip| part(skip.extent.at, skip.extent.len));
        if behind_number {
            parts.extend(numbers);
        } else {
            words_behind.extend(numbers);
        }
        words_behind.extend(words.iter().map(|word| word.text.as_slice()));
        let behind_sign = [sign.unwrap_or_default(), &words_behind.join(blank)].concat();
        parts.push(&behind_sign);
        let mut line = parts.join(blank);
        if is_last {
            for comment in &trailing {
                line.extend_from_slice(if line.is_empty() { b"" } else { b" " });
                line.extend_from_slice(part(comment.at, comment.len));
            }
        }
        lines.push(line);
    }
    Some(lines.join(&b'\n'))
}
