//! `inherited-state`: a move rests on something that the program never set.
//!
//! What: a move uses a modal code, H, D or S that no block before it has written: G90 or G91, the plane, the work system,
//! the length offset. With `--all-power-on` also: what the machine does differs with the power-on parameters.
//! Why: such a state comes from a parameter, or from whatever ran before; RESET keeps most of them. After another
//! program, or on another machine, the same block goes somewhere else.
//! Do: write the states in the program's first lines, as in `G17 G40 G49 G80 G90 G54`.
//!
//! A state counts only for a move that it changes: an incremental distance needs no work system, G28 no G00, a line no
//! plane. Groups that power-on and reset bring to one fixed code (G40, G80, G64 …) cannot be inherited. Inch or metric
//! and feed per minute or per revolution are not spoken of one by one: a shop's machines have them all alike, and every
//! program would be accused; `--all-power-on` and `--repeat` speak of them where they make a difference. F needs no
//! warning: without any the control raises an alarm. Each state is named once. Nothing is said of a text that ends
//! with M99 (a subprogram looked at alone): its caller sets the states.

use dialect::{Control, Group, Meaning};
use meaning::{CodeLine, EndKind, Side, letter_bit};

use crate::finding::{At, Finding, Found};
use crate::look::Look;
use crate::rules::Rule;

/// States that a program can set or inherit, one bit each.
pub(crate) mod state {
    pub const MOTION: u32 = 1;
    pub const DISTANCE: u32 = 1 << 1;
    pub const PLANE: u32 = 1 << 2;
    pub const LENGTH: u32 = 1 << 3;
    pub const RETURN: u32 = 1 << 4;
    pub const WORK: u32 = 1 << 5;
    pub const UNITS: u32 = 1 << 6;
    pub const FEED_MODE: u32 = 1 << 7;
    pub const S: u32 = 1 << 8;
    pub const H: u32 = 1 << 9;
    pub const D: u32 = 1 << 10;
    pub const F: u32 = 1 << 11;
    /// Spoken of one by one.
    pub const SAID: u32 = MOTION | DISTANCE | PLANE | LENGTH | RETURN | WORK | S | H | D;
    /// Only special blocks use these.
    pub const RARE: u32 = PLANE | RETURN | S | H | D;
}

use state::{D, DISTANCE, F, FEED_MODE, H, LENGTH, MOTION, PLANE, RARE, RETURN, S, SAID, UNITS, WORK};

const LETTERS: [(u8, u32); 4] = [(b'S', S), (b'H', H), (b'D', D), (b'F', F)];

/// The groups that programs can inherit, by their index, each with its bit.
pub(crate) fn groups(control: &Control) -> [(usize, u32); 8] {
    let roles = control.roles;
    [
        (roles.motion, MOTION),
        (roles.distance, DISTANCE),
        (roles.plane, PLANE),
        (roles.length, LENGTH),
        (roles.return_level, RETURN),
        (roles.work, WORK),
        (roles.units, UNITS),
        (roles.feed_mode, FEED_MODE),
    ]
}

/// True if a program can find this group in more than one state.
fn can_differ(group: &Group) -> bool {
    let kept = group.reset.row.is_none() || group.program_end.row.is_none();
    group.power_on.parameter.is_some() || kept
}

/// What the program has set and used.
pub(crate) struct InheritedState {
    /// Neither set nor used yet.
    open: u32,
    /// Used before it was set.
    used: u32,
    held: Vec<Finding>,
}

impl InheritedState {
    pub fn new(control: &Control) -> InheritedState {
        let mut open = S | H | D | F;
        for (index, bit) in groups(control) {
            if control.groups.get(index).is_some_and(can_differ) {
                open |= bit;
            }
        }
        InheritedState { open, used: 0, held: Vec::new() }
    }

    /// The states that the program used before it set them.
    pub fn used(&self) -> u32 {
        self.used
    }

    /// True if a plain move can still use something that was never set.
    pub fn is_open(&self) -> bool {
        self.open & !RARE != 0
    }

    /// A block that is refused, or that rests on what a refused one left unknown: what it sets and uses is not judged.
    pub fn pass_over(&mut self, look: &Look) {
        self.open &= !(set_by(look) | uses(look));
        let unknown = look.after().unknown;
        for (index, bit) in groups(look.control) {
            if unknown.group(index) {
                self.open &= !bit;
            }
        }
        for (letter, bit) in LETTERS {
            if unknown.word(letter) {
                self.open &= !bit;
            }
        }
    }

    pub fn look(&mut self, look: &Look, found: &mut Found) {
        if self.open == 0 {
            return;
        }
        self.open &= !set_by(look);
        let used = uses(look) & self.open;
        if used == 0 {
            return;
        }
        self.open &= !used;
        self.used |= used;
        let said = used & SAID;
        if said == 0 || !found.is_new(Rule::InheritedState, &look.command.place) {
            return;
        }
        let states = names(look, said);
        let finding = Finding::new(Rule::InheritedState, "", look.command, At::Block);
        self.held.push(finding.labelled(format!("never set: {states}")).with("states", states));
    }

    /// The program has ended.
    pub fn end(&mut self, kind: EndKind, found: &mut Found) {
        if kind == EndKind::M99 {
            self.held.clear();
        }
        found.list.append(&mut self.held);
    }
}

/// The states that a block writes.
fn set_by(look: &Look) -> u32 {
    let wording = &look.command.wording;
    let mut set = 0;
    if wording.groups != 0 {
        for (index, bit) in groups(look.control) {
            if wording.writes(index) {
                set |= bit;
            }
        }
    }
    for (letter, bit) in LETTERS {
        if wording.has(letter) {
            set |= bit;
        }
    }
    if wording.one_shot == Some(Meaning::SetCoordinates) {
        set |= WORK;
    }
    set
}

/// The states on which the block rests, whoever set them.
fn uses(look: &Look) -> u32 {
    let (command, wording) = (look.command, &look.command.wording);
    let mut used = 0;
    let spindle = &look.control.cycle_codes[..2];
    if command.sent().iter().any(|code| code.line == CodeLine::M && spindle.contains(&code.code)) {
        used |= S;
    }
    if !command.moves() {
        return used;
    }
    let cycle = command.levels();
    let positions = matches!(wording.one_shot, None | Some(Meaning::ExactStop))
        || wording.one_shot.is_some_and(|code| code.position_offset().is_some());
    let names_axes = look.named().next().is_some();
    if positions && cycle.is_none() && names_axes {
        used |= MOTION;
    }
    let numbers = wording.plain | wording.pointed;
    if numbers & b"XYZUVWIJKRQ".iter().fold(0, |set, &letter| set | letter_bit(letter)) != 0 {
        used |= UNITS;
    }
    if names_axes {
        used |= DISTANCE;
    }
    let in_machine = wording.one_shot == Some(Meaning::MachineCoordinates);
    let absolute = !command.absolute.is_empty() && !in_machine;
    if absolute {
        used |= WORK;
    }
    let length_axis = look.length_axis();
    let levels = cycle.is_some() && (wording.has(b'R') || wording.has(b'Z'));
    if absolute && (levels || length_axis.is_some_and(|axis| command.absolute.has(axis))) {
        used |= LENGTH;
    }
    if command.cuts() {
        used |= FEED_MODE | F;
    }
    let turned = look.before.polar.on || look.before.transform.rotation.on;
    if command.is_arc() || command.side() != Side::Off || turned && names_axes {
        used |= PLANE;
    }
    if cycle.is_some_and(|levels| levels.from != levels.r) {
        used |= RETURN;
    }
    if cycle.is_some_and(|levels| matches!(levels.cycle, Meaning::Tap | Meaning::LeftTap)) {
        used |= S;
    }
    let roles = look.control.roles;
    if wording.writes(roles.length)
        && matches!(look.in_force(roles.length), Some(Meaning::LengthPlus | Meaning::LengthMinus))
    {
        used |= H;
    }
    let takes_radius = |code: Meaning| {
        code.position_offset().is_some()
            || matches!(code, Meaning::CircleCutClockwise | Meaning::CircleCutCounterClockwise)
    };
    if command.side() != Side::Off || wording.one_shot.is_some_and(takes_radius) {
        used |= D;
    }
    used
}

/// The states by their names, as they are in force.
fn names(look: &Look, states: u32) -> String {
    let mut names = Vec::new();
    for (index, bit) in groups(look.control) {
        if states & bit != 0 {
            let group = look.control.groups.get(index).map_or("", |group| group.name.as_str());
            names.push(format!("{} ({})", look.code_name(index), group.replace('-', " ")));
        }
    }
    let after = look.after();
    for (letter, bit, value) in [('S', S, after.spindle), ('H', H, after.h), ('D', D, after.d)] {
        if states & bit != 0 {
            names.push(if letter == 'S' { format!("S{value}") } else { format!("{letter}{value:02}") });
        }
    }
    names.join(", ")
}
