//! The operator's script: one action a line, `#` begins a comment.

/// What to show.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Show {
    /// The codes in force.
    Modal,
    /// Where the axes are.
    Position,
    /// What the station is doing.
    State,
    /// Something whose display is not built yet.
    Other(String),
}

/// How long to run.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Until {
    /// Until automatic operation stops.
    Stop,
    /// Until the program ends.
    End,
    /// Until an alarm.
    Alarm,
    /// Until nothing more happens by itself.
    Idle,
    /// Until the control begins to execute this source line.
    Line(u64),
}

/// An action of the operator.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Action {
    /// `load FILE [as NAME]`
    Load(String, Option<String>),
    /// `select NAME`
    Select(String),
    /// `cycle-start`
    CycleStart,
    /// `reset`
    Reset,
    /// `input NAME on|off`
    Input(String, bool),
    /// `switch NAME on|off`
    Switch(String, Option<u8>, bool),
    /// `show …`
    Show(Show),
    /// `run until …`
    Run(Until),
    /// An action of the vocabulary that is not built yet, as it was written.
    NotBuilt(String),
}

/// A line that is no action.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ScriptError {
    /// 1-based line.
    pub line: usize,
    /// What is wrong.
    pub message: String,
}

/// Actions of the vocabulary that wait for their time.
const NOT_BUILT: &[&str] = &[
    "power-on",
    "power-off",
    "mode",
    "mdi",
    "feed-hold",
    "emergency-stop",
    "release",
    "key",
    "override",
    "offset",
    "work",
    "parameter",
    "variable",
    "jog",
    "step",
    "home",
];

/// Reads a script: each action with its line.
///
/// # Errors
/// The first line that is no action.
pub fn read_script(text: &str) -> Result<Vec<(usize, Action)>, ScriptError> {
    let mut actions = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default().trim();
        if !line.is_empty() {
            let action = read_action(line).map_err(|message| ScriptError { line: index + 1, message })?;
            actions.push((index + 1, action));
        }
    }
    Ok(actions)
}

fn on_or_off(word: &str) -> Result<bool, String> {
    match word {
        "on" => Ok(true),
        "off" => Ok(false),
        _ => Err(format!("`{word}` is neither on nor off")),
    }
}

fn read_action(line: &str) -> Result<Action, String> {
    let words: Vec<&str> = line.split_whitespace().collect();
    Ok(match words[..] {
        ["load", file] => Action::Load(file.to_owned(), None),
        ["load", file, "as", name] => Action::Load(file.to_owned(), Some(name.to_owned())),
        ["select", name] => Action::Select(name.to_owned()),
        ["cycle-start"] => Action::CycleStart,
        ["reset"] => Action::Reset,
        ["input", name, state] => Action::Input(name.to_owned(), on_or_off(state)?),
        ["switch", name, state] => {
            let (name, number) = split_switch(name)?;
            Action::Switch(name, number, on_or_off(state)?)
        }
        ["show", what] => Action::Show(match what {
            "modal" => Show::Modal,
            "position" => Show::Position,
            "state" => Show::State,
            other => Show::Other(other.to_owned()),
        }),
        ["show", what, _] => Action::Show(Show::Other(what.to_owned())),
        ["run", "until", "stop"] => Action::Run(Until::Stop),
        ["run", "until", "end"] => Action::Run(Until::End),
        ["run", "until", "alarm"] => Action::Run(Until::Alarm),
        ["run", "until", "idle"] => Action::Run(Until::Idle),
        ["run", "until", "line", number] => {
            Action::Run(Until::Line(number.parse().map_err(|_| format!("`{number}` is no line number"))?))
        }
        ["run", "for", _] => Action::NotBuilt(line.to_owned()),
        [first, ..] if NOT_BUILT.contains(&first) => Action::NotBuilt(line.to_owned()),
        _ => return Err(format!("`{line}` is no action of the operator")),
    })
}

/// A switch as users write it: `optional-stop`, `block-delete=2`.
///
/// # Errors
/// A number where none may be, or one that no switch has.
pub fn split_switch(text: &str) -> Result<(String, Option<u8>), String> {
    match text.split_once('=') {
        None => Ok((text.to_owned(), None)),
        Some(("block-delete", number)) => match number.parse() {
            Ok(number @ 1..=9) => Ok(("block-delete".to_owned(), Some(number))),
            _ => Err(format!("block delete switches are numbered 1 to 9, not `{number}`")),
        },
        Some((name, _)) => Err(format!("the switch `{name}` takes no number")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_is_an_action_a_comment_or_an_error() {
        let script =
            "load a.nc as O1  # the part\n\n# nothing\nswitch block-delete=2 on\nrun until line 7\njog X + for 2\n";
        assert_eq!(
            read_script(script),
            Ok(vec![
                (1, Action::Load("a.nc".into(), Some("O1".into()))),
                (4, Action::Switch("block-delete".into(), Some(2), true)),
                (5, Action::Run(Until::Line(7))),
                (6, Action::NotBuilt("jog X + for 2".into())),
            ])
        );
        let error = read_script("reset\nswich single-block on").expect_err("no such action");
        assert_eq!(error.line, 2);
    }
}
