//! A program in execution: the stages chained, their questions answered, their events handed out one by one.

mod alarm_history;
mod approach;
mod awaiting;
mod barriers;
mod block_begins;
mod by_hand;
mod dwelling;
mod execution;
mod lines;
mod live;
mod locks;
mod pointer;
mod rehearsal;
mod searching;
mod starting;
mod states;
mod tape_reader;
mod telling;
mod trial;
mod trips;
mod typed;

use std::collections::VecDeque;

use base::{AXES, Alarm, AxisSet, Place, Point, Seconds};
use machine::{Event, EventKind, Machine, VirtualMachine};
use meaning::Interpreter;
use motion::Motion;
use path::{Path, RunBeside, Shape, Shaped};

use crate::configuration::{Configuration, Inputs};
use crate::library::{Library, LibraryError};
use crate::lock::AxisLock;
use crate::switches::SessionSwitches;

pub use alarm_history::PastAlarm;
pub use approach::RestartPlan;
pub use by_hand::HandMove;
pub use locks::Percents;
pub use trial::{Asked, ProgramHead, Way};
pub use typed::TYPED;
use typed::Typed;

/// What follows an alarm.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum AfterAlarm {
    /// The control stands until RESET.
    #[default]
    Stand,
    /// It goes on, to find later ones: only for checking.
    GoOn,
}

/// What a session has next.
#[derive(Clone, PartialEq, Debug)]
pub enum Step {
    /// Something happened.
    Event(Event),
    /// The control waits for CYCLE START.
    Stopped,
    /// Nothing more happens by itself: the program has ended, an alarm stands, or the feed override is at zero.
    Idle,
    /// A text could not be read.
    Failed(LibraryError),
}

/// Rounds of a program that never ends by itself which one action of the operator lasts.
const MOST_ROUNDS: u32 = 10_000;

/// A session: one control with its machine and memory.
pub struct Session<L> {
    motion: Motion,
    machine: VirtualMachine,
    library: L,
    /// What follows, where moves are planned together.
    rehearsal: Option<Box<Session<rehearsal::Lent>>>,
    met: rehearsal::Met,
    /// Moves take their time.
    live: bool,
    /// Somebody works the control.
    attended: bool,
    under_way: Option<live::UnderWay>,
    by_hand: Option<by_hand::ByHand>,
    /// A dwell is under way: since when, s, stops on the way not counted in.
    dwelling: Option<f64>,
    /// The axes go here before the program is taken up in its middle; how high it has led the tool before.
    approach: Option<(Point, f64)>,
    /// What reads the program that runs, if it is a tape.
    reader: Option<tape_reader::TapeReader>,
    /// In a trial: what the program has asked.
    asked: Option<trial::Asked>,
    /// Axes whose dog was on when that was told last.
    on_dog: AxisSet,
    /// How long G28 has searched; the move is executed as one that took as long.
    searched: Option<Seconds>,
    /// Axes that the block in execution is to return, and has not yet.
    unfound: AxisSet,
    /// From one setpoint to the next, s.
    servo_period: f64,
    /// No more time passes than to this one.
    deadline: Option<Seconds>,
    /// FEED HOLD has been pressed in tapping.
    hold_waits: bool,
    tapping: bool,
    configuration: Configuration,
    /// The switches, as the operator has set them.
    switches: SessionSwitches,
    /// Those that act from block to block, as they were when the block in execution began.
    in_force: SessionSwitches,
    /// A switch has been turned since.
    switched: bool,
    percents: Percents,
    /// The program fixes the feed override at 100 %.
    fixes_override: bool,
    lock: AxisLock,
    /// By how much the displays have stood still while the axes moved, mm and degrees.
    unseen: Point,
    inputs: Inputs,
    after_alarm: AfterAlarm,
    repeats_main: bool,
    /// Rounds of a program that goes round for ever, since the operator last let it run.
    pub(super) rounds: u32,
    events: Vec<Event>,
    /// So many of them have been handed out.
    handed_out: usize,
    /// Codes that begin a block, held until it is sure that the block is not refused.
    codes: Vec<Shaped>,
    bytes: Vec<u8>,
    typed: Typed,
    /// The next shape has been pulled and not yet executed.
    pulled: bool,
    /// The block before is done, and nothing of the next one has been executed.
    between_blocks: bool,
    /// The block at whose beginning the operator asked to be told.
    told: Option<(u64, Place)>,
    /// The block of which something has been executed last.
    begun: Option<u64>,
    /// Codes have gone out in the block in execution.
    codes_out: bool,
    /// A block that has closed but for its codes.
    closing: awaiting::Closing,
    /// What comes next waits for codes.
    awaited: bool,
    /// The overtravel switch onto which an axis has run.
    tripped: Option<machine::LimitSwitch>,
    /// The power failed while this block was being executed.
    interrupted: Option<Place>,
    stopped: bool,
    /// By FEED HOLD.
    feed_held: bool,
    powered: bool,
    /// The next reading of a tape begins behind an end of block.
    label_skip: bool,
    /// The emergency stop button is pressed.
    emergency: bool,
    alarm: Option<Alarm>,
    /// Those that somebody who works the control has been told.
    past_alarms: VecDeque<PastAlarm>,
    ended: bool,
    rewound: bool,
    failed: Option<LibraryError>,
    unknown: AxisSet,
}

impl<L: Library> Session<L> {
    /// A control at power-on.
    pub fn new(configuration: Configuration, library: L) -> Session<L> {
        let Configuration {
            control,
            fitting,
            machine,
            memory,
            base_origin,
            start,
            not_returned,
            contact,
            switches,
            inputs,
            lines,
        } = configuration.clone();
        let mut interpreter = Interpreter::new(control, fitting.clone(), machine.facts(), memory, &start, base_origin);
        interpreter.lose_reference_points(not_returned);
        let mut virtual_machine = VirtualMachine::new(&machine, start, fitting.policies.stroke_check);
        virtual_machine.set_contact(contact);
        virtual_machine.set_skip(inputs.skip);
        virtual_machine.wire(awaiting::decoded_lines(&configuration, &inputs));
        for (line, on) in lines {
            virtual_machine.hold_line(line, on, Seconds(0.0), &mut Vec::new());
        }
        let motion = Motion::new(Path::new(interpreter, start), machine.limits());
        let mut session = Session {
            motion,
            machine: virtual_machine,
            library,
            rehearsal: None,
            met: None,
            live: false,
            attended: false,
            under_way: None,
            by_hand: None,
            dwelling: None,
            approach: None,
            reader: None,
            asked: None,
            searched: None,
            on_dog: AxisSet::NONE,
            unfound: AxisSet::NONE,
            servo_period: machine.limits().servo_period,
            deadline: None,
            hold_waits: false,
            tapping: false,
            configuration,
            switches,
            in_force: SessionSwitches::default(),
            switched: switches != SessionSwitches::default(),
            percents: Percents::default(),
            fixes_override: false,
            lock: AxisLock::default(),
            unseen: [0.0; AXES],
            inputs,
            after_alarm: AfterAlarm::Stand,
            repeats_main: false,
            rounds: 0,
            events: Vec::with_capacity(32),
            handed_out: 0,
            codes: Vec::with_capacity(16),
            bytes: Vec::new(),
            typed: Typed::default(),
            pulled: false,
            between_blocks: true,
            told: None,
            begun: None,
            codes_out: false,
            closing: None,
            awaited: false,
            tripped: None,
            interrupted: None,
            stopped: false,
            feed_held: false,
            powered: true,
            label_skip: true,
            emergency: false,
            alarm: None,
            past_alarms: VecDeque::new(),
            ended: true,
            rewound: true,
            failed: None,
            unknown: AxisSet::NONE,
        };
        session.pass_switches();
        session
    }

    /// What follows an alarm.
    pub fn set_after_alarm(&mut self, after: AfterAlarm) {
        self.after_alarm = after;
        if after == AfterAlarm::GoOn {
            self.interpreter_mut().go_on_after_alarms();
        }
    }

    /// The operator lets the program run: its rounds are counted anew.
    pub fn begin_rounds(&mut self) {
        self.rounds = 0;
    }

    /// True if the program has come round so often that it never ends by itself: it waits for the operator.
    pub fn goes_round(&self) -> bool {
        self.rounds > MOST_ROUNDS
    }

    /// M99 in the main program runs it again, and a loop without end goes on (as the control does), or the run ends.
    pub fn set_repeats_main(&mut self, repeats: bool) {
        self.repeats_main = repeats;
    }

    /// The interpreter, to look at.
    pub fn interpreter(&self) -> &Interpreter {
        &self.motion.upstream.upstream
    }

    /// The interpreter.
    pub fn interpreter_mut(&mut self) -> &mut Interpreter {
        &mut self.motion.upstream.upstream
    }

    /// The texts.
    pub fn library_mut(&mut self) -> &mut L {
        &mut self.library
    }

    /// The texts.
    pub fn library(&self) -> &L {
        &self.library
    }

    /// What the session started from.
    pub fn configuration(&self) -> &Configuration {
        &self.configuration
    }

    /// Where the axes are, mm and degrees in machine coordinates.
    pub fn position(&self) -> Point {
        match &self.by_hand {
            Some(by_hand) => by_hand.setpoint().position,
            None => self.setpoint().map_or(*self.machine.position(), |setpoint| setpoint.position),
        }
    }

    /// Virtual time since power-on.
    pub fn time(&self) -> Seconds {
        self.machine.time() + Seconds(self.elapsed())
    }

    /// The alarm that stands.
    pub fn alarm(&self) -> Option<&Alarm> {
        self.alarm.as_ref()
    }

    /// True if a program is being executed, stopped or not.
    pub fn is_running(&self) -> bool {
        !self.ended && self.alarm.is_none()
    }

    /// True while a program has begun and not ended, an alarm in its middle or not.
    pub fn is_in_program(&self) -> bool {
        !self.ended
    }

    /// True if it waits for CYCLE START.
    pub fn is_stopped(&self) -> bool {
        self.stopped
    }

    /// How the move handed out last follows from the programmed path, if it runs beside that; with an alarm, the way that
    /// the tool does not fit beside.
    pub fn beside(&self) -> Option<&RunBeside> {
        self.motion.upstream.current().beside.as_ref()
    }

    /// True if the move handed out last ends with an exact stop that the program asks for.
    pub fn stops_exactly(&self) -> bool {
        match &self.motion.upstream.current().shape {
            Shape::Line { feed, .. } | Shape::Arc { feed, .. } => feed.exact_stop,
            _ => false,
        }
    }

    /// True if it waits for an override to leave zero.
    pub fn waits_for_override(&self) -> bool {
        let waits = self.pulled || self.under_way.is_some();
        waits && self.is_running() && !self.stopped && self.is_still(self.motion.upstream.current())
    }

    /// True if that is the rapid override.
    pub fn waits_for_rapid(&self) -> bool {
        let is_rapid = match &self.motion.upstream.current().shape {
            Shape::Rapid { .. } => true,
            Shape::Line { feed, .. } | Shape::Arc { feed, .. } => self.motion.overrides().at_rapid(feed),
            _ => false,
        };
        is_rapid && self.waits_for_override()
    }

    /// The block being executed.
    pub fn place(&self) -> Place {
        self.interpreter().executing().map_or_else(Place::default, |command| command.place)
    }

    fn tell(&mut self, place: Place, kind: EventKind) {
        let time = self.time();
        self.events.push(Event { time, place, kind });
    }
}
