//! Programs made of macro tokens through the whole interpreter: every byte is a token, so that statements get deep.
//!
//! Never a panic, never a step that does not end; the same with the text in one piece or in many. The first byte chooses
//! the control too, the last one the mode.

#![no_main]

use std::sync::LazyLock;

use fuzz::watch::{Expect, Texts, run, select};
use fuzz::{Fleet, texts};
use libfuzzer_sys::fuzz_target;
use station::{AfterAlarm, Session, Setup};

/// Events after which a run is given up.
const MOST_EVENTS: usize = 200;
/// Statements without motion after which a loop is endless.
const MOST_STATEMENTS: u64 = 60;
/// The longest program that is made of an input.
const MOST_BYTES: usize = 4096;

/// What a byte stands for.
const TOKENS: &[&str] = &[
    "\n",
    "\n",
    "\n",
    "#1",
    "#2",
    "#100",
    "#500",
    "#0",
    "#[",
    "[",
    "]",
    "=",
    "+",
    "-",
    "*",
    "/",
    " OR ",
    " AND ",
    " XOR ",
    "1",
    "2",
    "3.",
    ".5",
    "0",
    "10",
    "SIN[",
    "COS[",
    "ATAN[",
    "]/[",
    "SQRT[",
    "BIN[",
    "BCD[",
    "FIX[",
    "LN[",
    "EXP[",
    "IF[",
    "]GOTO",
    "GOTO",
    "WHILE[",
    "]DO1",
    "]DO2",
    "]DO3",
    "DO1",
    "END1",
    "END2",
    "END3",
    " EQ ",
    " NE ",
    " LT ",
    " GE ",
    "N1",
    "N2",
    "N10",
    "G0X",
    "G91",
    "X#1",
    "Y#[#1]",
    "Z[#1*2]",
    "G65P2",
    "G66P2",
    "G67",
    "M98P2",
    "M99",
    "M30",
    "O2",
    "A1.",
    "I1.",
    "L2",
    "#3000=",
    "#2001",
    "#4001",
    "#5001",
    "#5021",
    "#1000",
    "#3001",
    "#3003=1",
    "#1=#1+1",
    "(A)",
    "/",
    "G04P#1",
    "%",
    "M00",
    "#2500",
    "THEN",
    "P#1",
    "H#1",
    "G#1",
    "1E",
    "99999999999999999999",
    "#1=#[#1]\n",
    "M98 SUB\n",
    "M98 MAIN\n",
    "M98 BIG.NC\n",
    "M97P1",
    "G16",
    "G15",
    "G68R30.",
    "G69",
    "G51P2.",
    "G51I-1.J2.",
    "G50",
    "G81R1.Z-1.",
    "K2",
    "F99.",
];

static FLEET: LazyLock<Fleet> = LazyLock::new(|| Fleet::new(9e6, |_| Setup::default(), false));

fuzz_target!(|input: &[u8]| {
    let Some((&mode, tokens)) = input.split_last() else { return };
    let (configuration, tokens) = FLEET.choose(tokens);
    let mut text = Vec::new();
    for &byte in tokens {
        text.extend_from_slice(TOKENS[usize::from(byte) % TOKENS.len()].as_bytes());
        if text.len() > MOST_BYTES {
            break;
        }
    }
    let events = |texts: Texts| {
        let mut session = Session::new(configuration.clone(), texts);
        session.set_after_alarm(if mode & 1 != 0 { AfterAlarm::GoOn } else { AfterAlarm::Stand });
        session.interpreter_mut().set_loop_limit(MOST_STATEMENTS);
        session.interpreter_mut().tell_variables(mode & 2 != 0);
        select(&mut session, 0);
        run(&mut session, Expect { most_events: MOST_EVENTS, stays_inside: mode & 1 == 0 })
    };
    let whole = events(texts(&text));
    if mode & 4 != 0 {
        let pieces = events(texts(&text).in_pieces(&[3, 50]));
        assert_eq!(format!("{whole:?}"), format!("{pieces:?}"));
    }
});
