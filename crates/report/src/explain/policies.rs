//! The policies that decide in a block: those whose row says so, or names one of the block's codes.

use dialect::{Origin, PolicyRow};

use super::here::Here;

/// A policy that bears on a block.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct PolicyLine {
    /// Its name.
    pub name: String,
    /// The value it has.
    pub value: String,
    /// What is open and what each value does.
    pub text: String,
    /// What the default rests on.
    pub origin: Origin,
}

/// The policies that bear on the block, in the table's order.
pub fn policy_lines(here: &Here) -> Vec<PolicyLine> {
    let bearing = |(_, row): &(usize, &PolicyRow)| match &row.bears_on {
        Some(entries) => entries.iter().any(|entry| entry.split_whitespace().all(|word| holds(here, word))),
        None => codes_in(&row.text).iter().any(|code| is_written(here, code)),
    };
    let rows = here.control.policies.iter().enumerate().filter(bearing);
    rows.map(|(index, row)| PolicyLine {
        name: row.name.clone(),
        value: here.fitting.policy_value(here.control, index).to_owned(),
        text: row.text.clone(),
        origin: row.origin.clone(),
    })
    .collect()
}

/// Whether a word of `bears_on` holds in the block.
fn holds(here: &Here, word: &str) -> bool {
    match word {
        "*" => here.one_shot().is_some(),
        "G+" => here.block.words.iter().filter(|word| word.letter == b'G').count() > 1,
        "axis" => here.block.words.iter().any(|word| here.axis(word.letter).is_some()),
        "cycle" => here.cycle().is_some(),
        "cycle-code" => here.rows().any(|(_, code)| code.meaning.is_cycle()),
        "motion-code" => here.rows().any(|(_, code)| code.meaning.is_motion()),
        "displaced" => here.watched.before.displacement.iter().any(|&counts| counts != 0.0),
        _ => match word.strip_prefix("in:") {
            Some(code) => (0..here.control.groups.len()).any(|group| here.name_in(group) == code),
            None => is_written(here, word),
        },
    }
}

/// True for a code or letter that stands in the block, and for the condition for which the block is refused.
fn is_written(here: &Here, word: &str) -> bool {
    let (letter, number) = word.split_at(word.len().min(1));
    match (letter, number.parse::<u32>()) {
        ("G", Ok(number)) => here.rows().any(|(_, code)| u32::from(code.code) == number),
        ("M", Ok(number)) => here.watched.words.m_codes.contains(&number),
        _ if number.is_empty() => word.bytes().all(|letter| here.has(letter)),
        _ => here.alarm().is_some_and(|alarm| alarm.condition.id() == word),
    }
}

/// The G and M codes that a text names.
fn codes_in(text: &str) -> Vec<String> {
    let words = text.split(|letter: char| !letter.is_ascii_alphanumeric());
    let is_code = |word: &&str| {
        let number = word.strip_prefix(['G', 'M']).unwrap_or_default();
        !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit())
    };
    words.filter(is_code).map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_codes_that_a_text_names_are_found() {
        assert_eq!(codes_in("with M01 off, G45 to G48 and (G92); MX1 is none"), ["M01", "G45", "G48", "G92"]);
    }
}
