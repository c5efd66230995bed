//! Which action the control takes in which situation: one table, and the mode switch.

use dialect::{ModeKind, ModeRow};

use crate::action::Action;
use crate::library::Library;
use crate::session::Session;

/// What the control is doing, as far as it decides which action it takes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Situation {
    /// Without power.
    Off,
    /// The emergency stop button is pressed.
    Emergency,
    /// An alarm stands.
    Alarm,
    /// Nothing runs, in a mode in which CYCLE START begins something or programs are edited.
    Ready,
    /// Nothing runs, in a manual mode.
    Manual,
    /// An axis is moved by hand.
    Moving,
    /// A program runs.
    Running,
    /// A program waits for the machine: FIN, the spindle, the builder's logic.
    Waiting,
    /// A program is held by FEED HOLD and can go on.
    Held,
    /// A program is stopped between blocks (M00, M01, SINGLE BLOCK) and can go on.
    Stopped,
}

/// The situation of a session.
pub(super) fn situation<L: Library>(session: &Session<L>, mode: &ModeRow) -> Situation {
    if !session.is_powered() {
        Situation::Off
    } else if session.emergency_stop() {
        Situation::Emergency
    } else if session.alarm().is_some() {
        Situation::Alarm
    } else if session.is_moved_by_hand() {
        Situation::Moving
    } else if !session.is_running() {
        if is_manual(mode) { Situation::Manual } else { Situation::Ready }
    } else if session.is_held() {
        Situation::Held
    } else if session.is_stopped() {
        Situation::Stopped
    } else if session.waiting().is_some() {
        Situation::Waiting
    } else {
        Situation::Running
    }
}

/// The switch that stops at block ends.
const SINGLE_BLOCK: &str = "single-block";
/// Switches that change no move: they act at once.
const OVERRIDE_CANCEL: &str = "override-cancel";
const START_LOCK: &str = "start-lock";

/// Actions that are taken or refused alike.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Kind {
    PowerOn,
    PowerOff,
    Load,
    Select,
    Mode,
    Type,
    CycleStart,
    FeedHold,
    Reset,
    Key,
    EmergencyStop,
    Release,
    /// Switches, overrides and inputs.
    Turn,
    Offset,
    /// Tool length by touching off.
    Touch,
    /// What the UNIVERSAL display shows.
    Origin,
    Parameter,
    Variable,
    /// Faults made on purpose.
    Fault,
    Show,
    Run,
    Jog,
    Step,
    Home,
    /// Restart in mid-program.
    Restart,
    /// Sequence-number and program search.
    Search,
    Edit,
    /// The tape reader.
    Tape,
}

fn kind(action: &Action) -> Kind {
    match action {
        Action::PowerOn => Kind::PowerOn,
        Action::PowerOff => Kind::PowerOff,
        Action::Load(..) => Kind::Load,
        Action::Select(_) => Kind::Select,
        Action::Mode(_) => Kind::Mode,
        Action::Mdi(_) => Kind::Type,
        Action::CycleStart => Kind::CycleStart,
        Action::FeedHold => Kind::FeedHold,
        Action::Reset => Kind::Reset,
        // What the key does decides whether it is taken.
        Action::Key(_) => Kind::Key,
        Action::EmergencyStop => Kind::EmergencyStop,
        Action::Release => Kind::Release,
        Action::Switch(..) | Action::Override(..) | Action::Input(..) => Kind::Turn,
        Action::Offset(..) | Action::Work(..) => Kind::Offset,
        Action::Touch(..) => Kind::Touch,
        Action::Origin(..) => Kind::Origin,
        Action::Parameter(_) => Kind::Parameter,
        Action::Variable(..) => Kind::Variable,
        Action::Fault(_) => Kind::Fault,
        Action::Show(_) => Kind::Show,
        Action::Run(_) => Kind::Run,
        Action::Jog(..) => Kind::Jog,
        Action::Step(..) => Kind::Step,
        Action::Home(_) => Kind::Home,
        Action::Restart(_) | Action::ConfirmRestart => Kind::Restart,
        Action::Search(_) => Kind::Search,
        Action::Edit(_) => Kind::Edit,
        Action::Tape(_) | Action::Verify(_) => Kind::Tape,
    }
}

/// True for an action that may change the moves that follow: taken while the axes move, it acts when they stand at the
/// end of one.
pub(super) fn changes_what_follows(action: &Action) -> bool {
    match kind(action) {
        Kind::Turn => match action {
            Action::Override(..) => false,
            Action::Input(name, _) => is_read(name),
            Action::Switch(name, ..) => name != OVERRIDE_CANCEL && name != START_LOCK,
            _ => true,
        },
        Kind::Offset | Kind::Touch | Kind::Parameter | Kind::Variable | Kind::Load | Kind::Select | Kind::Type => true,
        _ => false,
    }
}

/// Inputs that programs read; any other is one by which the machine answers codes, and changes no move.
fn is_read(name: &str) -> bool {
    let number = name.strip_prefix("UI").unwrap_or_default();
    matches!(name, "skip" | "interrupt") || number.starts_with(|first: char| first.is_ascii_digit())
}

/// Inputs that act in the moment in which they turn on, also in the middle of a move.
pub(super) fn acts_at_once(action: &Action) -> bool {
    matches!(action, Action::Input(name, _) if name == "skip" || name == "interrupt")
}

/// True for SINGLE BLOCK, which is looked at as a block ends and need not wait for that.
pub(super) fn acts_at_block_ends(action: &Action) -> bool {
    matches!(action, Action::Switch(name, ..) if name == SINGLE_BLOCK)
}

/// Taken, or refused for this reason.
type Answer = Option<&'static str>;

const GO: Answer = None;
const OFF: Answer = Some("the power is off");
const ON: Answer = Some("the power is on");
const PRESSED: Answer = Some("the emergency stop button is pressed; release it, then RESET");
const NOT_PRESSED: Answer = Some("the emergency stop button is not pressed");
const ALARM: Answer = Some("an alarm stands; RESET clears it");
const RUNS: Answer = Some("a program is running");
const STOPPED: Answer = Some("a program is stopped in the middle; let it run to its end or press RESET");
const NOTHING: Answer = Some("no program is running");
const STANDS: Answer = Some("the program has stopped already");
const MOVES: Answer = Some("an axis is moved by hand; let it come to stand first");
const NO_START: Answer = Some("CYCLE START does nothing in a manual mode");
const BY_HAND: Answer = Some("the axes are moved by hand in a manual mode only");

/// How many situations there are.
const SITUATIONS: usize = Situation::Stopped as usize + 1;

/// Every kind of action in every situation.
#[rustfmt::skip]
const TABLE: &[(Kind, [Answer; SITUATIONS])] = &[
    //                     without   emergency  alarm        automatic    manual       axis moved   a program    waits for    held         stopped
    //                     power     stop       stands       idle         idle         by hand      runs         the machine  (FEED HOLD)  (M00 …)
    (Kind::PowerOn,       [GO,        ON,         ON,           ON,           ON,           ON,           ON,           ON,           ON,           ON]),
    (Kind::PowerOff,      [OFF,       GO,         GO,           GO,           GO,           GO,           GO,           GO,           GO,           GO]),
    (Kind::Load,          [OFF,       GO,         GO,           GO,           GO,           MOVES,        RUNS,         RUNS,         STOPPED,      STOPPED]),
    (Kind::Select,        [OFF,       GO,         GO,           GO,           GO,           MOVES,        RUNS,         RUNS,         STOPPED,      STOPPED]),
    (Kind::Mode,          [GO,        GO,         GO,           GO,           GO,           MOVES,        RUNS,         RUNS,         GO,           GO]),
    (Kind::Type,          [OFF,       GO,         GO,           GO,           GO,           MOVES,        RUNS,         RUNS,         STOPPED,      STOPPED]),
    (Kind::CycleStart,    [OFF,       PRESSED,    ALARM,        GO,           NO_START,     MOVES,        RUNS,         RUNS,         GO,           GO]),
    (Kind::FeedHold,      [OFF,       PRESSED,    NOTHING,      NOTHING,      NOTHING,      GO,           GO,           GO,           STANDS,       STANDS]),
    (Kind::Reset,         [OFF,       PRESSED,    GO,           GO,           GO,           GO,           GO,           GO,           GO,           GO]),
    (Kind::Key,           [OFF,       GO,         GO,           GO,           GO,           GO,           GO,           GO,           GO,           GO]),
    (Kind::EmergencyStop, [OFF,       PRESSED,    GO,           GO,           GO,           GO,           GO,           GO,           GO,           GO]),
    (Kind::Release,       [OFF,       GO,         NOT_PRESSED,  NOT_PRESSED,  NOT_PRESSED,  NOT_PRESSED,  NOT_PRESSED,  NOT_PRESSED,  NOT_PRESSED,  NOT_PRESSED]),
    (Kind::Turn,          [GO,        GO,         GO,           GO,           GO,           GO,           GO,           GO,           GO,           GO]),
    (Kind::Offset,        [OFF,       GO,         GO,           GO,           GO,           GO,           GO,           GO,           GO,           GO]),
    (Kind::Touch,         [OFF,       GO,         GO,           GO,           GO,           MOVES,        RUNS,         RUNS,         GO,           GO]),
    (Kind::Origin,        [OFF,       GO,         GO,           GO,           GO,           GO,           GO,           GO,           GO,           GO]),
    (Kind::Parameter,     [OFF,       GO,         GO,           GO,           GO,           MOVES,        RUNS,         RUNS,         STOPPED,      STOPPED]),
    (Kind::Variable,      [OFF,       GO,         GO,           GO,           GO,           GO,           GO,           GO,           GO,           GO]),
    (Kind::Fault,         [OFF,       GO,         GO,           GO,           GO,           GO,           GO,           GO,           GO,           GO]),
    (Kind::Show,          [OFF,       GO,         GO,           GO,           GO,           GO,           GO,           GO,           GO,           GO]),
    (Kind::Run,           [GO,        GO,         GO,           GO,           GO,           GO,           GO,           GO,           GO,           GO]),
    (Kind::Jog,           [OFF,       PRESSED,    ALARM,        BY_HAND,      GO,           MOVES,        RUNS,         RUNS,         GO,           GO]),
    (Kind::Step,          [OFF,       PRESSED,    ALARM,        BY_HAND,      GO,           MOVES,        RUNS,         RUNS,         GO,           GO]),
    (Kind::Home,          [OFF,       PRESSED,    ALARM,        BY_HAND,      GO,           MOVES,        RUNS,         RUNS,         STOPPED,      STOPPED]),
    (Kind::Restart,       [OFF,       PRESSED,    ALARM,        GO,           NO_START,     MOVES,        RUNS,         RUNS,         STOPPED,      STOPPED]),
    (Kind::Search,        [OFF,       GO,         GO,           GO,           GO,           MOVES,        RUNS,         RUNS,         STOPPED,      STOPPED]),
    (Kind::Edit,          [OFF,       GO,         GO,           GO,           GO,           MOVES,        RUNS,         RUNS,         STOPPED,      STOPPED]),
    (Kind::Tape,          [OFF,       GO,         GO,           GO,           GO,           MOVES,        RUNS,         RUNS,         STOPPED,      STOPPED]),
];

/// True for a mode in which the axes are moved by hand.
pub(super) fn is_manual(mode: &ModeRow) -> bool {
    match mode.kind {
        ModeKind::Memory | ModeKind::Tape | ModeKind::Mdi | ModeKind::Edit => false,
        ModeKind::Jog | ModeKind::Step | ModeKind::Handle | ModeKind::Rapid | ModeKind::Return => true,
    }
}

/// Why the control does not take the action now, if it does not.
pub(super) fn refusal(action: &Action, situation: Situation) -> Answer {
    let kind = kind(action);
    TABLE.iter().find(|(row, _)| *row == kind).and_then(|(_, answers)| answers[situation as usize])
}

/// What CYCLE START would begin in a mode.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Begins {
    /// The selected program.
    Memory,
    /// The tape of the selected program.
    Tape,
    /// What has been typed.
    Typed,
}

/// What CYCLE START begins in a mode, or why it does nothing there.
pub(super) fn begins(mode: &ModeRow) -> Result<Begins, String> {
    match mode.kind {
        ModeKind::Memory => Ok(Begins::Memory),
        ModeKind::Mdi => Ok(Begins::Typed),
        ModeKind::Tape => Ok(Begins::Tape),
        _ => Err(format!("CYCLE START does nothing in mode {}", mode.name)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_has_one_row() {
        for (index, (kind, _)) in TABLE.iter().enumerate() {
            assert_eq!(TABLE.iter().position(|(other, _)| other == kind), Some(index), "{kind:?}");
        }
        assert_eq!(TABLE.len(), Kind::Tape as usize + 1);
    }
}
