//! `control.toml`'s `[grammar]`: how a program's text is read.

use data::Table;
use syntax::{BlockDelete, Colon, Grammar, Grouping, LowerCase, Percent, Semicolon};

/// The grammar, and whether the last of several words of one address counts.
pub(super) fn grammar(root: &mut Table) -> (Grammar, bool) {
    let read = |t: &mut Table| {
        t.require("block_length");
        let grammar = Grammar {
            semicolon: t
                .choice("semicolon", &[("end-of-block", Semicolon::EndOfBlock), ("comment", Semicolon::Comment)])
                .unwrap_or_default(),
            lower_case: t
                .choice("lower_case", &[("refuse", LowerCase::Refuse), ("fold", LowerCase::Fold)])
                .unwrap_or_default(),
            colon: t
                .choice("colon", &[("program-number", Colon::ProgramNumber), ("refuse", Colon::Refuse)])
                .unwrap_or_default(),
            grouping: t
                .choice("programs", &[("o-words", Grouping::OWords), ("files", Grouping::Files)])
                .unwrap_or_default(),
            percent: t
                .choice("percent", &[("end-of-tape", Percent::EndOfTape), ("ignore", Percent::Ignore)])
                .unwrap_or_default(),
            block_delete: t
                .choice("block_delete", &[("anywhere", BlockDelete::Anywhere), ("head", BlockDelete::Head)])
                .unwrap_or_default(),
            named_call: t.integer("named_call").and_then(|n| u32::try_from(n).ok()),
            block_length: t.integer("block_length").and_then(|n| u32::try_from(n).ok()).unwrap_or(u32::MAX),
        };
        let last = t.choice("repeated_word", &[("last-wins", true), ("refuse", false)]).unwrap_or(true);
        (grammar, last)
    };
    root.require("grammar");
    root.table("grammar", read).unwrap_or((Grammar::default(), true))
}
