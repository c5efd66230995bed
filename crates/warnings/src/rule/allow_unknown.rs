//! `allow-unknown`: a comment allows something that no warning is called.
//!
//! What: a name in `(allow: NAME)` is mistyped.
//! Why: the comment has no effect, and its reader takes the block for looked at.
//! Do: write the name as `check` prints it.
//!
//! Silent for a remark that only begins like one, as `(ALLOW: 0.2 FOR FINISHING)`: a name stands alone between commas
//! or has a hyphen. Silent in subprograms of other files, and in a
//! text of more than 256 KiB with nothing behind its end.

use base::Place;
use data::nearest;

use crate::finding::{At, Finding};
use crate::rules::Rule;
use crate::show::names_allowed;

/// `comment` as it stands in the block of `place`.
pub(crate) fn look(comment: &str, place: Place) -> Option<Finding> {
    let name = names_allowed(comment)?.split(',').find_map(unknown)?;
    let near = nearest(name, Rule::ALL.iter().map(|rule| rule.name()));
    let hint =
        near.map_or_else(|| "no warning is called like it".to_owned(), |near| format!("perhaps {near} is meant"));
    let finding = Finding::at(Rule::AllowUnknown, "", u64::MAX, place, At::Block);
    Some(finding.with("name", name).with("hint", hint))
}

/// The first word of a part between commas that wants to be a name and is none.
fn unknown(part: &str) -> Option<&str> {
    let alone = part.split_whitespace().count() == 1;
    part.split_whitespace().find(|word| {
        let letters = word.bytes().all(|byte| byte.is_ascii_alphabetic() || byte == b'-');
        letters && (alone || word.contains('-')) && word.len() > 1 && Rule::from_name(word).is_none()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_remark_is_no_name() {
        let is_said = |comment: &str| look(comment, Place::default()).is_some();
        assert!(is_said("(ALLOW: INTEGER-CORDINATE)"));
        assert!(is_said("(allow: endless, memmory-size)"));
        assert!(is_said("(allow: endles)"));
        assert!(!is_said("(allow: endless, memory-size)"));
        assert!(!is_said("(ALLOW: 0.2 FOR FINISHING)"));
        assert!(!is_said("(ALLOW: ONE HOUR)"));
        assert!(!is_said("(allow: endless because the pallet changer brings the next piece)"));
    }
}
