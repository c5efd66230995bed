//! The operator at work: actions on a session, refused with a reason where the control would refuse them.

mod by_hand;
mod editing;
mod kept;
mod keys;
mod lasting;
mod loading;
mod restart;
mod search;
mod table;
mod tape;
mod typing;
mod write;

use std::collections::{BTreeMap, VecDeque};

use base::SourceId;
use dialect::{FileNames, ModeRow, VariableMeaning};
use machine::Event;
use syntax::Cursor;

use crate::action::Action;
use crate::display::Value;
use crate::fault::Fault;
use crate::library::{Library, LibraryError, Shelf};
use crate::memory;
use crate::session::Session;
pub use kept::{Interrupted, Panel};
use table::Begins;

/// What an action brings to light.
#[derive(Clone, PartialEq, Debug)]
pub enum Said {
    /// Something happened at the machine.
    Event(Event),
    /// The action was refused and changed nothing.
    Refused {
        /// The action as written, or in the words of the vocabulary.
        action: String,
        /// Why.
        why: String,
    },
    /// A display.
    Shown {
        /// Which, in the words of the vocabulary.
        what: String,
        /// What it shows.
        value: Value,
    },
}

/// A program in the control's memory.
#[derive(Clone, PartialEq, Debug)]
struct Loaded {
    /// Its name as it is shown.
    name: String,
    /// The text it stands in.
    source: SourceId,
    /// Where it begins in that text.
    head: Cursor,
    /// The name by which others call it, where a program is a file.
    called: Option<String>,
}

/// An operator at a session's panel.
pub struct Operator<L> {
    /// The session.
    pub session: Session<L>,
    /// The position of the mode switch, as an index of the control's modes.
    mode: usize,
    /// The programs in memory by their names.
    programs: BTreeMap<String, Loaded>,
    /// The name under which a program was selected.
    selected: Option<String>,
    /// Actions taken while the axes moved, which act when they stand at the end of a move.
    waiting: VecDeque<Action>,
    /// The action that has begun and not ended.
    lasting: Option<lasting::Lasting>,
    by_the_clock: bool,
    /// A restart in mid-program that has been asked for.
    restart: Option<restart::Asked>,
    /// The cursor of the edit display, a place in the selected program's text.
    edit_at: usize,
    /// The tape in the reader: its name as a program, and its text.
    tape: Option<(String, SourceId)>,
}

impl<L: Library> Operator<L> {
    /// The mode in which the station stands.
    pub fn mode(&self) -> &ModeRow {
        // The loader refuses a control without modes, and the index is always one of them.
        &self.session.configuration().control.station.modes[self.mode]
    }

    /// The names of the programs in memory.
    pub fn programs(&self) -> impl Iterator<Item = &str> {
        self.programs.keys().map(String::as_str)
    }
}

impl<L: Shelf> Operator<L> {
    /// An operator at a control that has been powered on.
    pub fn new(mut session: Session<L>) -> Operator<L> {
        session.set_repeats_main(true);
        session.run_live();
        Operator {
            session,
            mode: 0,
            programs: BTreeMap::new(),
            selected: None,
            waiting: VecDeque::new(),
            lasting: None,
            by_the_clock: false,
            restart: None,
            edit_at: 0,
            tape: None,
        }
    }

    /// Performs an action. What happens is handed to `tell`.
    ///
    /// # Errors
    /// A text could not be read.
    pub fn perform(
        &mut self,
        action: &Action,
        tell: &mut dyn FnMut(&mut Session<L>, Said),
    ) -> Result<(), LibraryError> {
        self.perform_written(action, None, tell)
    }

    /// Performs an action; a refusal repeats it as it was written.
    ///
    /// # Errors
    /// A text could not be read.
    pub fn perform_written(
        &mut self,
        action: &Action,
        written: Option<&str>,
        tell: &mut dyn FnMut(&mut Session<L>, Said),
    ) -> Result<(), LibraryError> {
        self.begin(action, written, tell)?;
        if self.is_busy() {
            self.go_on(None, tell)?;
        }
        Ok(())
    }

    /// Begins an action; one that lasts goes on with [`Operator::go_on`].
    ///
    /// # Errors
    /// A text could not be read.
    pub fn begin(
        &mut self,
        action: &Action,
        written: Option<&str>,
        tell: &mut dyn FnMut(&mut Session<L>, Said),
    ) -> Result<(), LibraryError> {
        let outcome = match table::refusal(action, table::situation(&self.session, self.mode())) {
            Some(why) => Err(why.to_owned()),
            None if self.stops_first(action) => Ok(()),
            None => self.act(action, tell)?,
        };
        if let Err(why) = outcome {
            let action = written.map_or_else(|| action.to_string(), str::to_owned);
            tell(&mut self.session, Said::Refused { action, why });
        } else if restart::is_dropped_by(action) {
            self.restart = None;
        }
        if self.is_busy() { Ok(()) } else { self.settle(tell) }
    }

    /// What an action has brought about is told, and what waited for it acts.
    fn settle(&mut self, tell: &mut dyn FnMut(&mut Session<L>, Said)) -> Result<(), LibraryError> {
        if !self.session.is_running() && table::begins(self.mode()) != Ok(Begins::Typed) {
            self.session.come_back();
        }
        self.take_waiting(tell)?;
        self.drain_told(tell)
    }

    /// Carries out an action that the table takes; the inner error is why it is refused all the same.
    fn act(
        &mut self,
        action: &Action,
        tell: &mut dyn FnMut(&mut Session<L>, Said),
    ) -> Result<Result<(), String>, LibraryError> {
        let touches = table::changes_what_follows(action);
        if touches && self.session.is_moving() {
            self.session.stand_soon();
            if !table::acts_at_block_ends(action) && !table::acts_at_once(action) {
                self.waiting.push_back(action.clone());
                return Ok(Ok(()));
            }
            return self.carry_out(action, tell);
        }
        let outcome = self.carry_out(action, tell)?;
        // What is refused leaves what follows as it was planned.
        if touches && outcome.is_ok() {
            self.session.forget_rehearsal();
        }
        Ok(outcome)
    }

    fn carry_out(
        &mut self,
        action: &Action,
        tell: &mut dyn FnMut(&mut Session<L>, Said),
    ) -> Result<Result<(), String>, LibraryError> {
        let session = &mut self.session;
        match action {
            Action::PowerOn => session.power_on(),
            Action::PowerOff => session.power_off(),
            Action::FeedHold if session.interpreter().executing_state().feed_control & 1 != 0 => {
                let variables = &session.interpreter().control().user_macro;
                let number = variables.range_of(VariableMeaning::FeedControl).map_or(0, |(from, _)| from);
                return Ok(Err(format!("the program does not let FEED HOLD act (#{number} bit 0)")));
            }
            Action::FeedHold => session.feed_hold(),
            Action::Reset => session.reset(),
            Action::EmergencyStop => session.press_emergency_stop(),
            Action::Release => session.release_emergency_stop(),
            Action::Load(..) if session.is_edit_locked() => return Ok(Err(editing::LOCKED.to_owned())),
            Action::Load(file, name) => self.load(file, name.as_deref())?,
            Action::Run(until) => {
                self.session.begin_rounds();
                self.last(until, false);
            }
            Action::Fault(fault) => return Ok(self.break_down(fault.clone())),
            Action::Key(name) => return Ok(self.press_key(name)),
            Action::Select(name) => return Ok(self.select(name)),
            Action::Mode(name) => return Ok(self.turn_mode(name)),
            Action::Mdi(blocks) => return Ok(self.type_blocks(blocks)),
            Action::CycleStart => return Ok(self.cycle_start()),
            Action::Search(wanted) => return self.search(wanted, tell),
            Action::Tape(file) => return self.put_in_tape(file).map(Ok),
            Action::Verify(name) => return self.verify(name.as_deref(), tell),
            Action::Edit(edit) => return self.edit(edit),
            Action::Restart(target) => return Ok(self.ask_restart(target, tell)),
            Action::ConfirmRestart => return Ok(self.confirm_restart()),
            Action::Jog(..) | Action::Step(..) | Action::Home(_) => return Ok(self.move_by_hand(action)),
            Action::Show(show) => match self.display(show) {
                Ok(value) => tell(&mut self.session, Said::Shown { what: show.to_string(), value }),
                Err(why) => return Ok(Err(why)),
            },
            action => return Ok(self.write(action)),
        }
        Ok(Ok(()))
    }

    /// Something breaks on purpose.
    fn break_down(&mut self, fault: Fault) -> Result<(), String> {
        if let Fault::Limit(letter, ..) | Fault::Servo(letter) = fault {
            memory::axis_of(&self.session.configuration().machine, letter).map_err(|error| error.0)?;
        }
        if let Fault::Input(name) = &fault {
            let logic = &self.session.configuration().machine.logic;
            if logic.input(name).is_none() {
                let known: Vec<_> =
                    logic.lines.iter().filter(|line| !line.output).map(|line| line.name.as_str()).collect();
                return Err(match known[..] {
                    [] => "the machine's file names no inputs".to_owned(),
                    _ => format!("the machine has no input `{name}`; it has {}", known.join(", ")),
                });
            }
        }
        self.session.break_down(fault);
        Ok(())
    }

    fn turn_mode(&mut self, name: &str) -> Result<(), String> {
        let modes = &self.session.configuration().control.station.modes;
        let Some(mode) = modes.iter().position(|mode| mode.name == name) else {
            let known: Vec<_> = modes.iter().map(|mode| mode.name.as_str()).collect();
            return Err(format!("there is no mode {name}; the modes are {}", known.join(", ")));
        };
        self.mode = mode;
        Ok(())
    }

    fn type_blocks(&mut self, blocks: &str) -> Result<(), String> {
        if table::begins(self.mode()) != Ok(Begins::Typed) {
            return Err(format!("blocks are typed in MDI mode, not in mode {}", self.mode().name));
        }
        let interpreter = self.session.interpreter();
        typing::check(interpreter.control(), &interpreter.fitting().policies, blocks)?;
        self.session.type_blocks(blocks);
        Ok(())
    }

    fn select(&mut self, name: &str) -> Result<(), String> {
        let key = memory_key(name, self.files());
        let Some(Loaded { name, source, head, .. }) = self.programs.get(&key) else {
            return Err(format!("there is no program {} in memory", normal_name(name)));
        };
        self.session.interpreter_mut().forget_texts();
        self.session.select(*source, name, *head);
        self.selected = Some(key);
        self.edit_at = 0;
        Ok(())
    }

    fn cycle_start(&mut self) -> Result<(), String> {
        let begins = table::begins(self.mode())?;
        if self.session.switches().start_lock {
            return Err("START LOCK is on".to_owned());
        }
        let typed = begins == Begins::Typed;
        if self.session.is_stopped() {
            if typed != self.session.is_typed_selected() {
                return Err("a program of another mode is stopped; go back to its mode or press RESET".to_owned());
            }
            self.session.start();
        } else if typed {
            if self.session.typed_blocks().is_empty() {
                return Err("nothing has been typed".to_owned());
            }
            self.session.start_typed();
        } else {
            if self.selected.is_none() && (begins != Begins::Tape || self.tape.is_none()) {
                return Err("no program is selected".to_owned());
            }
            if let Some(begun) = self.begin_restart() {
                return begun;
            }
            self.session.come_back();
            self.take_its_text(begins)?;
            match begins {
                Begins::Tape => self.session.start_tape(),
                _ => self.session.start(),
            }
        }
        Ok(())
    }

    /// The endings of files, where a program is a file.
    fn files(&self) -> Option<&FileNames> {
        self.session.configuration().control.files.as_ref()
    }

    /// Hands out what an action has brought about at once, without letting time pass.
    fn drain_told(&mut self, tell: &mut dyn FnMut(&mut Session<L>, Said)) -> Result<(), LibraryError> {
        while let Some(event) = self.session.next_told() {
            tell(&mut self.session, Said::Event(event));
        }
        Ok(())
    }

    /// Actions that waited for the axes to stand act now, if they do.
    fn take_waiting(&mut self, tell: &mut dyn FnMut(&mut Session<L>, Said)) -> Result<(), LibraryError> {
        while !self.waiting.is_empty() && !self.session.is_moving() {
            let Some(action) = self.waiting.pop_front() else { break };
            if let Err(why) = self.act(&action, tell)? {
                tell(&mut self.session, Said::Refused { action: action.to_string(), why });
            }
        }
        Ok(())
    }
}

/// Under which name a program is kept in memory.
fn memory_key(name: &str, files: Option<&FileNames>) -> String {
    match files {
        Some(files) => without_ending(name, files).to_ascii_uppercase(),
        None => normal_name(name),
    }
}

fn ends_with(name: &str, ending: &str) -> bool {
    name.rsplit_once('.').is_some_and(|(_, own)| own.eq_ignore_ascii_case(ending))
}

/// A program's name without the ending of its file.
fn without_ending<'n>(name: &'n str, files: &FileNames) -> &'n str {
    let known = ends_with(name, &files.ending) || files.large.as_ref().is_some_and(|large| ends_with(name, large));
    name.rsplit_once('.').filter(|_| known).map_or(name, |(stem, _)| stem)
}

/// `o0012` and `O12` are one program; other names stay as they are.
fn normal_name(name: &str) -> String {
    let digits = name.strip_prefix(['O', 'o']).unwrap_or_default();
    match digits.parse::<u32>() {
        Ok(number) if digits.bytes().all(|b| b.is_ascii_digit()) => format!("O{number}"),
        _ => name.to_owned(),
    }
}
