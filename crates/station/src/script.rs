//! The operator's script: one action a line, `#` begins a comment.

use dialect::ParameterSetting;

use crate::action::{Action, OverrideSwitch, Show, Until};
use crate::block_target::read_block_target;
use crate::edit::read_edit;
use crate::fault::read_fault;
use crate::setup::OffsetColumn;
use crate::switches::split_switch;

/// A line that is no action.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ScriptError {
    /// 1-based line.
    pub line: usize,
    /// What is wrong.
    pub message: String,
}

/// One action of a script.
#[derive(Clone, PartialEq, Debug)]
pub struct ScriptLine {
    /// 1-based line.
    pub line: usize,
    /// As it is written, without its comment.
    pub written: String,
    /// What it says.
    pub action: Action,
}

/// Reads a script: each action with its line.
///
/// # Errors
/// The first line that is no action.
pub fn read_script(text: &str) -> Result<Vec<ScriptLine>, ScriptError> {
    let mut actions = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let (written, line) = (without_comment(line).trim(), index + 1);
        if !written.is_empty() {
            let action = read_action(written).map_err(|message| ScriptError { line, message })?;
            actions.push(ScriptLine { line, written: written.to_owned(), action });
        }
    }
    Ok(actions)
}

/// The line up to its comment. In a typed block `#` and a digit, `[` or another `#` is a macro variable.
pub fn without_comment(line: &str) -> &str {
    let typed = ["mdi ", "edit "].iter().any(|verb| line.trim_start().starts_with(verb));
    let comment = line.char_indices().find(|&(at, character)| {
        let variable =
            typed && line[at + 1..].starts_with(|next: char| next.is_ascii_digit() || matches!(next, '[' | '#'));
        character == '#' && !variable
    });
    comment.map_or(line, |(at, _)| &line[..at])
}

fn on_or_off(word: &str) -> Result<bool, String> {
    match word {
        "on" => Ok(true),
        "off" => Ok(false),
        _ => Err(format!("`{word}` is neither on nor off")),
    }
}

fn finite(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(format!("`{text}` is no number")),
    }
}

fn whole<T: std::str::FromStr>(text: &str, what: &str) -> Result<T, String> {
    text.parse().map_err(|_| format!("`{text}` is no {what}"))
}

/// Reads one action.
///
/// # Errors
/// What is wrong with the line.
pub fn read_action(line: &str) -> Result<Action, String> {
    let line = line.trim();
    let (verb, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
    let rest = rest.trim();
    let words: Vec<&str> = rest.split_whitespace().collect();
    let no_action = || format!("`{line}` is no action of the operator");
    Ok(match (verb, &words[..]) {
        ("power-on", []) => Action::PowerOn,
        ("power-off", []) => Action::PowerOff,
        ("load", [file]) => Action::Load((*file).to_owned(), None),
        ("load", [file, "as", name]) => Action::Load((*file).to_owned(), Some((*name).to_owned())),
        ("select", [name]) => Action::Select((*name).to_owned()),
        ("mode", [name]) => Action::Mode((*name).to_owned()),
        ("mdi", [_, ..]) => Action::Mdi(rest.to_owned()),
        ("cycle-start", []) => Action::CycleStart,
        ("feed-hold", []) => Action::FeedHold,
        ("reset", []) => Action::Reset,
        ("key", [name]) => Action::Key((*name).to_owned()),
        ("emergency-stop", []) => Action::EmergencyStop,
        ("release", []) => Action::Release,
        ("input", [name, state]) => Action::Input((*name).to_owned(), on_or_off(state)?),
        ("switch", [name, state]) => {
            let (name, which) = split_switch(name)?;
            Action::Switch(name, which, on_or_off(state)?)
        }
        ("override", [switch, percent]) => Action::Override(override_switch(switch)?, whole(percent, "percentage")?),
        ("origin", ["all"]) => Action::Origin(None, 0.0),
        ("origin", [axis]) if !axis.contains('=') => Action::Origin(Some(axis_letter(axis)?), 0.0),
        ("offset" | "work" | "origin" | "parameter" | "variable", _) => write(verb, rest, line)?,
        ("touch", [cell, of @ ..]) => {
            let (column, number) = split_offset(cell)?;
            let height = match of {
                [] => 0.0,
                ["at", height] => finite(height)?,
                _ => return Err(no_action()),
            };
            Action::Touch(column, number, height)
        }
        ("fault", words) => Action::Fault(read_fault(words)?),
        ("show", [what, of @ ..]) => Action::Show(show(what, &of.join(" ")).ok_or_else(no_action)??),
        ("run", ["until", until @ ..]) => Action::Run(self::until(until).ok_or_else(no_action)??),
        ("run", ["for", seconds]) => Action::Run(Until::Seconds(finite(seconds)?.max(0.0))),
        ("jog", [axis, sign]) => Action::Jog(axis_letter(axis)?, is_up(sign)?, None),
        ("jog", [axis, sign, "for", seconds]) => {
            Action::Jog(axis_letter(axis)?, is_up(sign)?, Some(finite(seconds)?.max(0.0)))
        }
        ("step", [axis, sign, way]) => {
            let (up, way) = (is_up(sign)?, finite(way)?.abs());
            Action::Step(axis_letter(axis)?, if up { way } else { -way })
        }
        ("home", [axis]) => Action::Home(axis_letter(axis)?),
        ("search", [wanted]) => Action::Search((*wanted).to_owned()),
        ("edit", words) => Action::Edit(read_edit(words, rest).ok_or_else(no_action)?),
        ("tape", [file]) => Action::Tape((*file).to_owned()),
        ("verify", []) => Action::Verify(None),
        ("verify", [name]) => Action::Verify(Some((*name).to_owned())),
        ("restart", ["confirm"]) => Action::ConfirmRestart,
        ("restart", [_, ..]) => Action::Restart(read_block_target(&words)?),
        _ => return Err(no_action()),
    })
}

fn axis_letter(text: &str) -> Result<u8, String> {
    match text.as_bytes() {
        [letter @ b'A'..=b'Z'] => Ok(*letter),
        _ => Err(format!("`{text}` is no axis letter")),
    }
}

fn is_up(sign: &str) -> Result<bool, String> {
    match sign {
        "+" => Ok(true),
        "-" => Ok(false),
        _ => Err(format!("`{sign}` is neither + nor -")),
    }
}

fn override_switch(name: &str) -> Result<OverrideSwitch, String> {
    [OverrideSwitch::Feed, OverrideSwitch::Rapid, OverrideSwitch::Spindle]
        .into_iter()
        .find(|switch| switch.name() == name)
        .ok_or_else(|| format!("there is no override `{name}`; there are feed, rapid and spindle"))
}

/// An action that writes a value.
fn write(verb: &str, rest: &str, line: &str) -> Result<Action, String> {
    let (name, value) = rest.split_once('=').ok_or_else(|| format!("`{line}` writes no value: {verb} … = …"))?;
    let (name, value) = (name.trim(), value.trim());
    Ok(match verb {
        "offset" => {
            let (column, number) = split_offset(name)?;
            Action::Offset(column, number, finite(value)?)
        }
        "work" => match name.split_whitespace().collect::<Vec<_>>()[..] {
            [system, axis] => match axis.as_bytes() {
                [letter @ b'A'..=b'Z'] => Action::Work(system.to_owned(), *letter, finite(value)?),
                _ => return Err(format!("`{axis}` is no axis letter")),
            },
            _ => return Err(format!("`{line}`: write work G54 X = 100.0")),
        },
        "origin" => Action::Origin(Some(axis_letter(name)?), finite(value)?),
        "parameter" => {
            let (name, bit) = split_parameter(name)?;
            Action::Parameter(ParameterSetting { name, bit, value: value.to_owned() })
        }
        _ => {
            let value = if value == "blank" { None } else { Some(finite(value)?) };
            Action::Variable(variable(name)?, value)
        }
    })
}

/// A variable's number, with or without its sign.
fn variable(name: &str) -> Result<u32, String> {
    whole(name.strip_prefix('#').unwrap_or(name), "variable")
}

fn show(what: &str, of: &str) -> Option<Result<Show, String>> {
    Some(Ok(match (what, of) {
        ("modal", "") => Show::Modal,
        ("position", "") => Show::Position,
        ("machine", "") => Show::Machine,
        ("alarm", "") => Show::Alarm,
        ("feed", "") => Show::Feed,
        ("alarms", "") => Show::Alarms,
        ("offsets", "") => Show::Offsets,
        ("works", "") => Show::Works,
        ("parameters", "") => Show::Parameters,
        ("variables", "") => Show::Variables,
        ("directory", "") => Show::Directory,
        ("command", "") => Show::Command,
        ("diagnosis", "") => Show::Diagnosis,
        ("displays", "") => Show::Displays,
        ("program", "") => Show::Program,
        ("state", "") => Show::State,
        (_, "") => return None,
        ("offset", cell) => return Some(split_offset(cell).map(|(column, number)| Show::Offset(column, number))),
        ("work", system) => Show::Work(system.to_owned()),
        ("parameter", name) => return Some(split_parameter(name).map(|(name, bit)| Show::Parameter(name, bit))),
        ("variable", number) => return Some(variable(number).map(Show::Variable)),
        _ => return None,
    }))
}

fn until(words: &[&str]) -> Option<Result<Until, String>> {
    Some(Ok(match words {
        ["stop"] => Until::Stop,
        ["end"] => Until::End,
        ["alarm"] => Until::Alarm,
        ["idle"] => Until::Idle,
        ["line", number] => return Some(whole(number, "line number").map(Until::Line)),
        _ => return None,
    }))
}

/// A cell of the offset memory as users write it: `31`, `H1`, `D1`.
///
/// # Errors
/// It is no number.
pub fn split_offset(text: &str) -> Result<(OffsetColumn, u32), String> {
    let (column, digits) = match text.as_bytes().first() {
        Some(b'H') => (OffsetColumn::Length, &text[1..]),
        Some(b'D') => (OffsetColumn::Radius, &text[1..]),
        _ => (OffsetColumn::Common, text),
    };
    digits.parse().map(|number| (column, number)).map_err(|_| format!("`{text}` is no offset number"))
}

/// A parameter as users write it: `6005`, `6005.2` for one bit, a name.
///
/// # Errors
/// What stands behind the point is no bit.
pub fn split_parameter(text: &str) -> Result<(String, Option<u8>), String> {
    match text.split_once('.') {
        Some((number, bit)) if !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()) => {
            Ok((number.to_owned(), Some(bit.parse().map_err(|_| format!("`{bit}` is no bit"))?)))
        }
        _ => Ok((text.to_owned(), None)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::switches::Which;

    #[test]
    fn every_line_is_an_action_a_comment_or_an_error() {
        let script =
            "load a.nc as O1  # the part\n\n# nothing\nswitch block-delete=2 on\nrun until line 7\njog X + for 2\n";
        let read = read_script(script).expect("all are actions");
        let actions: Vec<_> = read.into_iter().map(|line| (line.line, line.action)).collect();
        assert_eq!(
            actions,
            vec![
                (1, Action::Load("a.nc".into(), Some("O1".into()))),
                (4, Action::Switch("block-delete".into(), Which::Number(2), true)),
                (5, Action::Run(Until::Line(7))),
                (6, Action::Jog(b'X', true, Some(2.0))),
            ]
        );
        let error = read_script("reset\nswich single-block on").expect_err("no such action");
        assert_eq!(error.line, 2);
    }

    #[test]
    fn an_action_in_words_is_read_as_itself() {
        for line in [
            "power-on",
            "mode mdi",
            "mdi G00 X#1 Y[#2]",
            "switch mirror-image=X on",
            "override feed 50",
            "offset 31 = -10.5",
            "offset H1 = 2",
            "touch 31",
            "touch H1 at 50",
            "work G54 X = 100",
            "origin X",
            "origin Z = -100.5",
            "origin all",
            "show alarms",
            "show offsets",
            "show works",
            "show parameters",
            "show variables",
            "show directory",
            "show command",
            "show diagnosis",
            "show displays",
            "parameter 6005.2 = 1",
            "parameter cycle clearance = 2",
            "variable 500 = 1.5",
            "variable 500 = blank",
            "show parameter cycle clearance",
            "show offset 31",
            "show work G52",
            "run until line 3",
            "emergency-stop",
            "key F10",
            "fault fin never",
            "fault spindle-speed",
            "fault limit X + at 12.5",
            "fault servo X",
            "fault power",
            "fault input clamped stuck",
            "jog X +",
            "jog Z - for 2.5",
            "step Y - 0.01",
            "home X",
            "restart line 12",
            "restart O1234 N50 pass 3",
            "restart confirm",
            "search N50",
            "tape part.tap",
            "verify",
            "verify O1234",
            "edit find X10.",
            "edit line 12",
            "edit insert G04 P500 ; X#1",
            "edit delete",
            "edit delete block",
            "edit delete program O1",
            "edit new O1",
        ] {
            assert_eq!(read_action(line).expect(line).to_string(), line);
        }
        for line in [
            "offset 31",
            "offset x = 1",
            "touch",
            "touch x",
            "touch 31 at",
            "touch 31 on 5",
            "work G54 = 1",
            "origin",
            "origin all = 5",
            "origin X 5",
            "show alarms 3",
            "override feed fast",
            "show",
            "run until",
            "mdi",
            "variable 1 = nan",
            "fault fin late",
            "fault input clamped",
            "fault limit X at 3",
            "jog X",
            "jog X up",
            "step X + far",
            "home",
            "restart",
            "edit",
            "edit find",
            "edit line x",
            "search",
            "restart line",
            "restart N0",
            "restart O1 O2 N5",
        ] {
            assert!(read_action(line).is_err(), "{line}");
        }
    }

    #[test]
    fn a_variable_in_a_typed_block_is_no_comment() {
        assert_eq!(without_comment("mdi G00 X#1 # go"), "mdi G00 X#1 ");
        assert_eq!(without_comment("switch single-block on #1"), "switch single-block on ");
    }

    #[test]
    fn what_is_wrong_with_a_line_is_said() {
        for (line, why) in [
            ("switch single-block no", "`no` is neither on nor off"),
            ("switch single-block=2 on", "the switch `single-block` takes no number"),
            ("switch mirror-image=1 on", "`1` is no axis letter"),
            ("switch block-delete=0 on", "block delete switches are numbered 1 to 9, not `0`"),
            ("jog 1 +", "`1` is no axis letter"),
            ("jog X up", "`up` is neither + nor -"),
            ("work G54 XY = 1", "`XY` is no axis letter"),
            ("work G54 X 1", "writes no value"),
            ("work G54 = 1", "write work G54 X = 100.0"),
            ("offset H-1 = 1", "`H-1` is no offset number"),
            ("variable 500 = inf", "`inf` is no number"),
            ("fault fin late", "FIN is never, early or stuck, not `late`"),
            ("fault servo 1", "`1` is no axis letter"),
            ("fault limit X + at far", "`far` is no number"),
            ("fault fire", "there is no fault `fire`; the faults are fin never"),
            ("restart N", "`N` is no sequence number"),
            ("restart line 0", "`0` is no line number"),
            ("restart N5 N6 N7", "a block is named by its line or its sequence number"),
        ] {
            let error = read_action(line).expect_err(line);
            assert!(error.contains(why), "{line}: {error}");
        }
    }
}
