//! What follows: a second session that runs ahead of this one on the same texts and shows the planner the moves to come.
//!
//! It is the same control with the same memory, so what it meets is what this session will meet, as long as nobody
//! touches anything; who does calls [`Session::forget_rehearsal`]. Nothing of it is ever executed or told.

use std::collections::VecDeque;

use base::{AxisSet, Seconds, SourceId};
use machine::Machine;
use meaning::Quantity;
use motion::Ahead;

use super::{Percents, Session, Step};
use crate::library::{Library, LibraryError, Wanted};

/// What a rehearsal has met and not shown yet; `None` in a session that is no rehearsal.
pub(super) type Met = Option<VecDeque<Ahead>>;

/// A text that the rehearsal asks for.
#[derive(Clone, PartialEq, Eq, Debug)]
enum Request {
    Bytes(SourceId, u64, usize),
    Number(u32, String),
    File(String),
}

/// The texts of a rehearsal: those of its session, handed over when it asks for them.
#[derive(Debug, Default)]
pub(super) struct Lent {
    wanted: Option<Request>,
    /// The answer to a request: bytes, and whether the source ends with them.
    bytes: Option<(Request, Vec<u8>, bool)>,
    /// The answer to a request: the source that holds a program, and its name if it is a file.
    program: Option<(Request, Option<SourceId>)>,
    name: Option<(SourceId, Option<String>)>,
}

impl Library for Lent {
    fn read(&mut self, source: SourceId, offset: u64, len: usize, bytes: &mut Vec<u8>) -> Result<bool, LibraryError> {
        let request = Request::Bytes(source, offset, len);
        match &self.bytes {
            Some((answered, answer, last)) if *answered == request => {
                bytes.clone_from(answer);
                Ok(*last)
            }
            _ => Err(self.ask(request)),
        }
    }

    fn find_program(&mut self, wanted: Wanted) -> Result<Option<SourceId>, LibraryError> {
        let request = match wanted {
            Wanted::Number(number, ending) => Request::Number(number, ending.to_owned()),
            Wanted::File(name) => Request::File(name.to_owned()),
        };
        match &self.program {
            Some((answered, answer)) if *answered == request => Ok(*answer),
            _ => Err(self.ask(request)),
        }
    }

    fn file_name(&self, source: SourceId) -> Option<String> {
        self.name.as_ref().filter(|(known, _)| *known == source).and_then(|(_, name)| name.clone())
    }
}

impl Lent {
    fn ask(&mut self, request: Request) -> LibraryError {
        self.wanted = Some(request);
        LibraryError(String::new())
    }

    /// Answers what was asked for; false if nothing was, or it cannot be had.
    pub fn answer(&mut self, library: &mut impl Library) -> bool {
        let Some(request) = self.wanted.take() else { return false };
        let found = match &request {
            Request::Bytes(source, offset, len) => {
                let (_, mut bytes, _) = self.bytes.take().unwrap_or_else(|| (request.clone(), Vec::new(), false));
                let Ok(last) = library.read(*source, *offset, *len, &mut bytes) else { return false };
                self.bytes = Some((request, bytes, last));
                return true;
            }
            Request::Number(number, ending) => library.find_program(Wanted::Number(*number, ending)),
            Request::File(name) => library.find_program(Wanted::File(name)),
        };
        let Ok(found) = found else { return false };
        self.name = found.map(|source| (source, library.file_name(source)));
        self.program = Some((request, found));
        true
    }
}

impl<L: Library> Session<L> {
    /// Moves are planned together with those that follow them: cutting moves run into each other as fast as the axes
    /// allow, and times are what they would be on the machine. Without it every move begins and ends at rest.
    ///
    /// Where the machine has overtravel switches, moves take their time too: one may end in its middle.
    pub fn plan_ahead(&mut self) {
        self.motion.plan_ahead();
        self.live |= !self.machine.switches().is_empty();
    }

    /// As [`Session::plan_ahead`]; how each cutting move is driven is kept for [`Session::stretches`].
    pub fn plan_ahead_in_detail(&mut self) {
        self.motion.plan_ahead();
        self.motion.keep_stretches();
    }

    /// Where the axes were on the move handed out last, in order of time, if they ran beside it (model `classic`).
    pub fn samples(&self) -> &[motion::Sample] {
        self.motion.samples()
    }

    /// How the move handed out last is driven, stretch by stretch; empty for what is no cutting move.
    pub fn stretches(&self) -> &[motion::Stretch] {
        self.motion.stretches()
    }

    /// Shows where the axes are on the move handed out last, and how fast, with the time since its beginning: straight
    /// between these places it is left by no more than `tolerance_mm`.
    pub fn sample(&self, tolerance_mm: f64, see: impl FnMut(f64, &motion::Setpoint)) {
        self.motion.sample(tolerance_mm, see);
    }

    /// Something has been touched: what follows is no longer what was rehearsed.
    ///
    /// A move that FEED HOLD keeps in its middle is still to be made to its end.
    pub fn forget_rehearsal(&mut self) {
        if self.under_way.is_some() {
            return self.stand_soon();
        }
        self.rehearsal = None;
        self.motion.forget_ahead();
    }

    /// Plans the move that is to be executed now.
    pub(super) fn plan(&mut self) {
        if self.met.is_some() {
            self.count_time_ahead();
        }
        if let Some(met) = &mut self.met {
            let current = self.motion.current();
            let ahead = if self.machine.cannot_end(&current) { Ahead::Rest } else { Ahead::Move(current.shaped.shape) };
            met.push_back(ahead);
            return;
        }
        if !self.motion.plans() {
            return;
        }
        if !self.motion.is_joined() {
            return;
        }
        if self.motion.is_surprised() {
            self.forget_rehearsal();
        }
        while self.motion.wants_more() {
            let ahead = self.rehearse();
            self.motion.show(&ahead.unwrap_or(Ahead::Rest));
            if ahead.is_none() && !self.motion.knows_next() {
                // Nothing more comes of the rehearsal, and yet there is a move: it is driven by itself.
                return self.forget_rehearsal();
            }
        }
        if !self.live {
            self.motion.plan();
        }
    }

    /// In a rehearsal: a block begins.
    pub(super) fn tell_block(&mut self) {
        if let Some(met) = &mut self.met {
            met.push_back(Ahead::Block);
        }
    }

    /// In a rehearsal: the control has read nothing ahead of this.
    pub(super) fn tell_nothing_read(&mut self) {
        if let Some(met) = &mut self.met {
            met.push_back(Ahead::NothingRead);
        }
    }

    /// The axes have stood since then; where blocks are not ready in time they stand longer.
    pub(super) fn pass_since(&mut self, since: Seconds) {
        let passed = self.machine.time() - since;
        if self.motion.plans() && passed.0 > 0.0 {
            let longer = self.motion.pass(passed.0);
            self.machine.stand_until(self.machine.time() + Seconds(longer), &mut self.events);
        }
    }

    /// In a rehearsal: the axes stand here.
    pub(super) fn rest(&mut self) {
        if let Some(met) = &mut self.met {
            met.push_back(Ahead::Rest);
        }
    }

    /// In a rehearsal: what the program asks of the machine is answered when it stands.
    pub(super) fn rest_to_answer(&mut self, quantity: Quantity) {
        if !matches!(quantity, Quantity::Inputs) {
            self.rest();
        }
    }

    /// The next that follows; `None` if the rehearsal has come to its end.
    fn rehearse(&mut self) -> Option<Ahead> {
        if self.rehearsal.is_none() {
            self.rehearsal = Some(Box::new(self.begin_rehearsal()));
        }
        let rehearsal = self.rehearsal.as_mut()?;
        loop {
            if let Some(ahead) = rehearsal.met.as_mut().and_then(VecDeque::pop_front) {
                return Some(ahead);
            }
            match rehearsal.next() {
                Step::Event(_) => {}
                Step::Failed(_) => {
                    if !rehearsal.library.answer(&mut self.library) {
                        return None;
                    }
                    rehearsal.ended = false;
                }
                Step::Stopped | Step::Idle => return rehearsal.met.as_mut().and_then(VecDeque::pop_front),
            }
        }
    }

    /// CYCLE START has been pressed: the rehearsal goes on as well, or another one is begun when it is needed.
    pub(super) fn restart_rehearsal(&mut self) {
        match &mut self.rehearsal {
            Some(rehearsal) if rehearsal.stopped && self.stopped && !self.feed_held => rehearsal.start(),
            // It goes on where it was held: what follows is the same.
            _ if self.feed_held && self.under_way.is_some() => {}
            _ => self.forget_rehearsal(),
        }
    }

    /// A session that stands where this one stands, before the move that is to be executed now.
    pub(super) fn begin_rehearsal(&self) -> Session<Lent> {
        Session {
            motion: self.motion.unplanned(),
            machine: self.machine.clone(),
            library: Lent::default(),
            rehearsal: None,
            met: Some(VecDeque::new()),
            live: false,
            attended: false,
            under_way: None,
            by_hand: None,
            dwelling: None,
            approach: None,
            reader: self.reader.clone(),
            asked: None,
            searched: None,
            on_dog: AxisSet::NONE,
            unfound: AxisSet::NONE,
            servo_period: self.servo_period,
            deadline: None,
            hold_waits: false,
            tapping: false,
            configuration: self.configuration.clone(),
            switches: self.switches,
            in_force: self.in_force,
            switched: self.switched,
            // The overrides change speeds, not ways.
            percents: Percents::default(),
            fixes_override: self.fixes_override,
            lock: self.lock,
            unseen: self.unseen,
            inputs: self.inputs,
            after_alarm: self.after_alarm,
            repeats_main: self.repeats_main,
            rounds: self.rounds,
            events: Vec::new(),
            handed_out: 0,
            codes: self.codes.clone(),
            bytes: Vec::new(),
            typed: self.typed.clone(),
            pulled: true,
            between_blocks: false,
            told: None,
            begun: self.begun,
            closing: None,
            awaited: false,
            tripped: None,
            interrupted: None,
            codes_out: self.codes_out,
            stopped: false,
            feed_held: false,
            powered: self.powered,
            label_skip: self.label_skip,
            emergency: self.emergency,
            alarm: None,
            past_alarms: VecDeque::new(),
            ended: false,
            rewound: self.rewound,
            failed: None,
            unknown: self.unknown,
        }
    }
}
