//! What is wrong with the rows of a block, and what a damaged row probably was.
//!
//! A damaged row has one hole too many or one too few, so it was one of the characters of its code that differ from
//! it in one channel; which of them is judged by the characters that stand beside it.

use crate::code::{DELETE, System, Table, character_name};
use crate::{END_OF_BLOCK, IGNORED, UNREADABLE};

/// What is wrong with a row.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Fault {
    /// Its number of holes is wrong: what it may have been.
    Parity(Guesses),
    /// Blank tape inside an EIA program; the first row of it.
    Blank,
    /// The number of holes is right, but the code has no such row.
    Unknown,
}

/// The most characters that a row is guessed to have been.
const MOST_GUESSES: usize = 4;

/// The characters that a damaged row may have been, the likeliest first.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Guesses([u8; MOST_GUESSES]);

impl Guesses {
    /// The characters; a row that is passed over stands as delete.
    pub fn characters(&self) -> impl Iterator<Item = u8> {
        self.0.into_iter().filter(|&character| character != 0)
    }

    /// The same as one number, for an alarm's values.
    pub fn number(self) -> f64 {
        f64::from(u32::from_be_bytes(self.0))
    }

    /// In words: `3, 6 or 2`.
    pub fn text(number: f64) -> String {
        let all = Guesses((number as u32).to_be_bytes());
        let names: Vec<_> = all.characters().map(character_name).collect();
        match &names[..] {
            [] => "a character that cannot be told".to_owned(),
            [only] => only.clone(),
            [others @ .., last] => format!("{} or {last}", others.join(", ")),
        }
    }
}

/// True if a block of so many rows, its end-of-block counted, fails the check of the block's parity.
pub const fn is_odd(rows: u64) -> bool {
    rows % 2 == 1
}

/// Finds the faults of the rows of a block, in their order.
///
/// The rows begin behind an end-of-block, or at the block's first character. Blank tape that nothing follows is the
/// tape's end and no fault.
pub fn faults<'r>(rows: &'r [u8], table: &'r Table) -> Faults<'r> {
    Faults { rows, table, at: 0, in_comment: false }
}

/// The faults of a block's rows, each with its index.
pub struct Faults<'r> {
    rows: &'r [u8],
    table: &'r Table,
    at: usize,
    in_comment: bool,
}

impl Iterator for Faults<'_> {
    type Item = (usize, Fault);

    fn next(&mut self) -> Option<(usize, Fault)> {
        let system = self.table.system;
        while let Some(&row) = self.rows.get(self.at) {
            let at = self.at;
            self.at += 1;
            if row == 0 {
                let blank = self.rows[at..].iter().take_while(|&&row| row == 0).count();
                self.at = at + blank;
                if system == System::Eia && self.at < self.rows.len() {
                    return Some((at, Fault::Blank));
                }
                continue;
            }
            match self.table.character(row) {
                b'(' => self.in_comment = true,
                b')' | END_OF_BLOCK => self.in_comment = false,
                UNREADABLE if !system.is_parity_right(row) => {
                    return Some((at, Fault::Parity(guess(self.table, self.rows, at, self.in_comment))));
                }
                // A comment may hold anything.
                UNREADABLE if !self.in_comment => return Some((at, Fault::Unknown)),
                _ => {}
            }
        }
        None
    }
}

/// What a character is for those that stand beside it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Letter,
    Digit,
    Point,
    Sign,
    Skip,
    Open,
    Close,
    End,
    Other,
}

fn kind(character: u8) -> Kind {
    match character {
        b'A'..=b'Z' | b':' => Kind::Letter,
        b'0'..=b'9' => Kind::Digit,
        b'.' => Kind::Point,
        b'+' | b'-' => Kind::Sign,
        b'/' => Kind::Skip,
        b'(' => Kind::Open,
        b')' => Kind::Close,
        END_OF_BLOCK | b'%' => Kind::End,
        _ => Kind::Other,
    }
}

/// How well two characters stand beside each other in a program; 0 to 30.
fn fits(before: Kind, after: Kind) -> i32 {
    use Kind::{Close, Digit, End, Letter, Open, Other, Point, Sign, Skip};
    match (before, after) {
        (Letter, Digit) | (Digit | Point, Letter | End | Digit) | (Sign, Digit) | (End, Letter) => 30,
        (Digit, Point) | (Close, End) | (Letter | Sign, Point) | (Letter, Sign) => 25,
        (End, Skip | Open | End) | (Skip, Letter | Digit) | (Close, Letter) | (Digit | Point, Open) => 15,
        (Other, _) | (_, Other) => 8,
        _ => 0,
    }
}

/// Everything that the judgement of one row looks at.
struct Around<'r> {
    table: &'r Table,
    rows: &'r [u8],
    at: usize,
    before: u8,
    after: u8,
    in_comment: bool,
}

fn guess(table: &Table, rows: &[u8], at: usize, in_comment: bool) -> Guesses {
    let near = at.saturating_sub(NEAR);
    let (rows, at) = (&rows[near..rows.len().min(at + NEAR)], at - near);
    let readable = |row: &&u8| !matches!(table.character(**row), IGNORED | b' ' | b'\t');
    let before = rows[..at].iter().rev().find(readable).map_or(END_OF_BLOCK, |&row| table.character(row));
    let after = rows[at + 1..].iter().find(readable).map_or(END_OF_BLOCK, |&row| table.character(row));
    let around = Around { table, rows, at, before, after, in_comment };
    let mut found = [(i32::MIN, 0u8); 8];
    for (channel, slot) in found.iter_mut().enumerate() {
        let row = rows[at] ^ (1 << channel);
        let character = table.character(row);
        if row == 0 || character == UNREADABLE {
            continue;
        }
        // Dirt in a hole is more common than a hole too many.
        let filled = i32::from(row.count_ones() > rows[at].count_ones());
        *slot = (around.worth(character) * 2 + filled, if character == IGNORED { DELETE } else { character });
    }
    // Equals stay in the order of their channels.
    found.sort_by_key(|(worth, _)| -i64::from(*worth));
    let least = found[0].0.saturating_sub(MARGIN);
    let mut guesses = Guesses::default();
    let likely = found.iter().filter(|(worth, character)| *character != 0 && *worth >= least);
    for (slot, (_, character)) in guesses.0.iter_mut().zip(likely) {
        *slot = *character;
    }
    guesses
}

/// Rows on either side that a guess looks at.
const NEAR: usize = 64;

/// A character so much less likely than the likeliest is not named.
const MARGIN: i32 = 6;

impl Around<'_> {
    /// How likely a character is here.
    fn worth(&self, character: u8) -> i32 {
        if self.in_comment {
            return self.worth_in_comment(character);
        }
        let (before, after) = (kind(self.before), kind(self.after));
        let own = match character {
            IGNORED | b' ' | b'\t' => return fits(before, after) * 2 - 12,
            _ => kind(character),
        };
        let mut worth = fits(before, own) + fits(own, after);
        match own {
            Kind::Digit => {
                // Two points cannot stand in one number: here a word ends.
                if self.point_before() && self.point_after() {
                    worth -= 40;
                }
                worth += 6;
            }
            Kind::Point if self.point_before() || self.point_after() => worth -= 40,
            Kind::Letter => worth += self.worth_of_letter(character),
            _ => {}
        }
        worth
    }

    fn worth_in_comment(&self, character: u8) -> i32 {
        match kind(character) {
            Kind::End | Kind::Open => -20,
            // The comment is closed where nothing else closes it.
            Kind::Close => {
                let rest = self.rows[self.at + 1..].iter().map(|&row| self.table.character(row));
                let closed = rest.take_while(|&c| c != END_OF_BLOCK).any(|c| c == b')');
                if closed { -20 } else { 40 }
            }
            own if own == kind(self.before) || own == kind(self.after) => 20,
            Kind::Letter | Kind::Digit => 15,
            _ if character == b' ' => 14,
            _ => 0,
        }
    }

    /// Some addresses are common, and none but G and M stands twice in a block.
    fn worth_of_letter(&self, letter: u8) -> i32 {
        let common = if b"GXYZMNF".contains(&letter) { 4 } else { 0 };
        let twice = !matches!(letter, b'G' | b'M')
            && self.rows.iter().enumerate().any(|(at, &row)| at != self.at && self.table.character(row) == letter);
        common - if twice { 12 } else { 0 }
    }

    fn point_before(&self) -> bool {
        self.has_point(&mut self.rows[..self.at].iter().rev())
    }

    fn point_after(&self) -> bool {
        self.has_point(&mut self.rows[self.at + 1..].iter())
    }

    /// True if the digits that come next lead to a point.
    fn has_point(&self, rows: &mut dyn Iterator<Item = &u8>) -> bool {
        rows.map(|&row| self.table.character(row)).find(|c| !c.is_ascii_digit() && *c != IGNORED) == Some(b'.')
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Codes;

    fn rows(text: &str, table: &Table) -> Vec<u8> {
        text.bytes().map(|character| table.row(character).expect("the code has it")).collect()
    }

    fn tables() -> [Table; 2] {
        [System::Iso, System::Eia].map(|system| Codes::default().table(system))
    }

    #[test]
    fn every_single_wrong_hole_is_found_where_it_is() {
        let text = "N10G01X-12.5Y48.(PLATE 3/4)F200\n";
        for table in tables() {
            let whole = rows(text, &table);
            assert_eq!(faults(&whole, &table).next(), None);
            for at in 0..whole.len() {
                for channel in 0..8 {
                    let mut damaged = whole.clone();
                    damaged[at] ^= 1 << channel;
                    if damaged[at] == 0 && at + 1 == whole.len() {
                        // An end-of-block without its hole is blank tape, found when something follows.
                        damaged.push(table.row(b'G').expect("the code has it"));
                    }
                    let found: Vec<_> = faults(&damaged, &table).collect();
                    assert_eq!(found.len(), 1, "{at} {channel}");
                    assert_eq!(found[0].0, at);
                }
            }
        }
    }

    /// How many of 100 wrong holes are guessed right at once, and how many are named at all.
    fn share(text: &str) -> [usize; 2] {
        let (mut right, mut all) = ([0, 0], 0);
        for table in tables() {
            let whole = rows(text, &table);
            for at in 0..whole.len() {
                for channel in 0..8 {
                    let mut damaged = whole.clone();
                    damaged[at] ^= 1 << channel;
                    if damaged[at] == 0 {
                        continue;
                    }
                    let Some((_, Fault::Parity(guesses))) = faults(&damaged, &table).next() else { panic!("{at}") };
                    all += 1;
                    let place = guesses.characters().position(|guess| guess == text.as_bytes()[at]);
                    right[0] += usize::from(place == Some(0));
                    right[1] += usize::from(place.is_some());
                }
            }
        }
        right.map(|count| count * 100 / all)
    }

    #[test]
    fn most_guesses_are_right() {
        let [first, named] = share("N120G02X-12.5Y48.035R7.25F200\n");
        assert!(first >= 50 && named >= 85, "{first} % at once, {named} % named");
    }

    #[test]
    fn a_digit_inside_a_number_is_a_digit() {
        let [iso, eia] = tables();
        // X1?5.: 32 in ISO, 03 in EIA.
        for (rows, table) in [(b"\xD8\xB1\x32\x35\x2E\x0A", iso), (b"\x37\x01\x03\x15\x6B\x80", eia)] {
            let Some((2, Fault::Parity(guesses))) = faults(rows, &table).next() else { panic!("found elsewhere") };
            assert!(guesses.characters().all(|guess| guess.is_ascii_digit()), "{guesses:?}");
        }
    }

    #[test]
    fn a_number_with_two_points_ends_at_a_letter() {
        let [_, eia] = tables();
        // X1.?2.: 28 is as near to 0 and 8 as to Y and Z.
        let Some((3, Fault::Parity(guesses))) = faults(b"\x37\x01\x6B\x28\x02\x6B\x80", &eia).next() else {
            panic!("found elsewhere")
        };
        assert_eq!(Guesses::text(guesses.number()), "Z or Y");
        // A hole torn open in a 1 is no reason to see a letter where the block has none.
        let Some((1, Fault::Parity(guesses))) = faults(b"\x37\x81\x02\x6B\x80", &eia).next() else {
            panic!("found elsewhere")
        };
        assert_eq!(Guesses::text(guesses.number()), "1");
    }

    #[test]
    fn blank_tape_is_a_fault_in_eia_where_something_follows() {
        let [iso, eia] = tables();
        assert_eq!(faults(b"\0\0\x67\0\x01\x80", &eia).collect::<Vec<_>>(), [(0, Fault::Blank), (3, Fault::Blank)]);
        assert_eq!(faults(b"\0\0\0", &eia).next(), None);
        assert_eq!(faults(b"\0\x47\0\xB1\x0A\0", &iso).next(), None);
    }

    #[test]
    fn rows_that_the_code_does_not_have_are_faults_outside_comments_only() {
        let [iso, eia] = tables();
        assert_eq!(faults(b"\x67\x0D\x80", &eia).collect::<Vec<_>>(), [(1, Fault::Unknown)]);
        assert_eq!(faults(b"\x1A\x0D\x4A\x80", &eia).next(), None);
        assert_eq!(faults(b"\x47\x9A\x0A", &iso).collect::<Vec<_>>(), [(1, Fault::Unknown)]);
    }
}
