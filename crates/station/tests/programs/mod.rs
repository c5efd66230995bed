//! Random programs made of what the control's tables hold: each shrinks to its smallest failing part.

use dialect::Control;
use proptest::prelude::*;
use proptest::sample::select;

/// A number as programs write it: with and without a point, signed, zero with a sign, out of range.
fn number() -> impl Strategy<Value = String> {
    prop_oneof![
        6 => (-60_000i32..60_000).prop_map(|n| format!("{}{}.{:03}", if n < 0 { "-" } else { "" }, n.abs() / 1000, n.abs() % 1000)),
        3 => (-20i32..20).prop_map(|n| format!("{n}.")),
        2 => (-30_000i32..30_000).prop_map(|n| n.to_string()),
        1 => select(vec!["0", "-0", "+1.5", ".5", "-.001", "99999.999", "-99999.999", "123456789", "#1", "[#2+1]", "", "1.2.3", "-"])
            .prop_map(str::to_owned),
    ]
}

fn word(letters: &'static [u8], number: impl Strategy<Value = String>) -> impl Strategy<Value = String> {
    (select(letters), number).prop_map(|(letter, number)| format!("{}{number}", char::from(letter)))
}

fn small(range: std::ops::Range<u32>) -> impl Strategy<Value = String> {
    range.prop_map(|n| n.to_string())
}

/// Words of a block, the likely ones often.
fn words(control: &Control) -> impl Strategy<Value = String> + use<> {
    let g_codes: Vec<u16> = control.g_codes.iter().map(|code| code.code).collect();
    let m_codes: Vec<u16> = control.m_codes.iter().map(|code| code.code).collect();
    prop_oneof![
        6 => select(g_codes).prop_map(|code| format!("G{code:02}")),
        3 => select(vec![0u32, 1, 2, 3, 17, 18, 19, 43, 49, 80, 81, 83, 90, 91]).prop_map(|code| format!("G{code}")),
        10 => word(b"XYZ", number()),
        3 => word(b"IJKRQ", number()),
        2 => word(b"F", select(vec!["100", "250.5", "1", "24000", "0", "99999"]).prop_map(str::to_owned)),
        2 => word(b"HD", select(vec!["1", "2", "31", "0", "99", "100"]).prop_map(str::to_owned)),
        1 => word(b"STB", small(0..10_000)),
        1 => word(b"PL", small(0..12)),
        1 => word(b"ABCUVWE", number()),
        2 => select(m_codes).prop_map(|code| format!("M{code:02}")),
        1 => select(vec![3u32, 5, 6, 8, 100, 999]).prop_map(|code| format!("M{code}")),
        1 => select(vec!["/", "/2", "/9", "(COMMENT)", "()", " ", "%", "(OPEN", ")", "g0", "#1=2"]).prop_map(str::to_owned),
    ]
}

/// A block of random words, or one of the shapes that real programs have.
fn block(control: &Control) -> impl Strategy<Value = String> + use<> {
    let xyz = || prop::collection::vec(word(b"XYZ", number()), 0..4).prop_map(|words| words.concat());
    let loose = prop::collection::vec(words(control), 0..6).prop_map(|words| words.concat());
    prop_oneof![
        6 => loose,
        3 => (select(vec!["G00", "G01", "G02", "G03", "G60", "G06", "G28", "G53", "G92"]), xyz()).prop_map(|(g, xyz)| format!("{g}{xyz}F200")),
        3 => xyz(),
        2 => (select(vec!["G02", "G03"]), xyz(), word(b"IJKR", number())).prop_map(|(g, xyz, c)| format!("{g}{xyz}{c}F300.")),
        2 => (select(vec!["G73", "G74", "G76", "G77", "G81", "G82", "G83", "G84", "G85", "G86", "G87", "G88", "G89"]), xyz(), small(0..4))
            .prop_map(|(g, xyz, l)| format!("{g}{xyz}Z-5.R1.Q1.5P100F100L{l}")),
        1 => (select(vec!["G12", "G13"]), number(), small(0..40)).prop_map(|(g, i, d)| format!("{g}I{i}D{d}F200")),
        1 => (select(vec!["", "Q2", "L2"]), small(0..101), xyz(), number())
            .prop_map(|(kind, p, xyz, r)| format!("G10{kind}P{p}{xyz}R{r}")),
        1 => (select(vec!["G70", "G72"]), xyz(), -5i32..9).prop_map(|(g, xyz, l)| format!("{g}{xyz}I20.J30.L{l}")),
        1 => (select(vec!["G45", "G46", "G47", "G48"]), xyz()).prop_map(|(g, xyz)| format!("{g}{xyz}D31")),
        1 => (select(vec!["G43", "G44", "G49"]), xyz()).prop_map(|(g, xyz)| format!("{g}{xyz}H1")),
        1 => (1u32..5, 0u32..4).prop_map(|(p, l)| format!("M98P{p}L{l}")),
        1 => (1u32..6).prop_map(|n| format!("M99P{n}")),
        1 => select(vec!["M99", "M30", "M02", "M00", "M01", "G04P500", "G04X1.5", "G41D31", "G40", "G20", "G21"]).prop_map(str::to_owned),
    ]
}

/// Lines of a program, some numbered, some skipped, some spoilt.
fn lines(control: &Control, most: usize) -> impl Strategy<Value = String> + use<> {
    let head =
        prop_oneof![8 => Just(String::new()), 2 => (1u32..6).prop_map(|n| format!("N{n}")), 1 => Just("/".to_owned())];
    let line = (head, block(control), prop_oneof![9 => Just("\n"), 1 => Just(";"), 1 => Just("\r\n")])
        .prop_map(|(head, block, end)| format!("{head}{block}{end}"));
    prop::collection::vec(line, 0..most).prop_map(|lines| lines.concat())
}

/// A text with a main program and up to three subprograms O2 to O4.
pub fn program(control: &Control) -> impl Strategy<Value = String> + use<> {
    let subprogram = (lines(control, 6), select(vec!["M99\n", "M99P3\n", ""]));
    let subprograms = prop::collection::vec(subprogram, 0..4);
    let head = select(vec!["O1\n", "%\nO0001(MAIN)\n", "", "\u{FEFF}O1;"]);
    (head, lines(control, 20), select(vec!["M30\n", "M02\n", "M99\n", ""]), subprograms, select(vec!["%", ""]))
        .prop_map(|(head, main, end, subprograms, tail)| {
            let called =
                subprograms.iter().enumerate().map(|(index, (lines, end))| format!("O{}\n{lines}{end}", index + 2));
            format!("{head}{main}{end}{}{tail}", called.collect::<String>())
        })
}
