//! `operate --realtime`: the script performed by the clock, a servo period at a time.
//!
//! Lines on standard input are the operator's hands: they act when they come, and time passes between them. Output is
//! written by a thread of its own, so that whoever reads it slowly does not hold up the control.

use std::collections::VecDeque;
use std::io::{self, BufRead, Read, Write};
use std::sync::mpsc::{Receiver, SyncSender, TryRecvError, TrySendError, sync_channel};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use base::Seconds;
use memory::{Change, Store};
use station::{Action, Operator, Said, Show, read_action, without_comment};

use super::keeping::Keeping;
use super::{Performance, perform};
use crate::failure::Failure;
use crate::output::say;
use crate::texts::Texts;

mod pace;

use pace::Pace;

/// What front ends draw all the time.
const DISPLAYS: [Show; 4] = [Show::Position, Show::State, Show::Feed, Show::Modal];
/// Lines that wait to be performed.
const LINES: usize = 1024;
/// A line of standard input, bytes.
const LONGEST: u64 = 64 * 1024;
/// Pieces of output that wait to be written.
const PIECES: usize = 64;
/// Output that may wait for whoever reads it, bytes; beyond it the control waits too.
const MOST_WAITING: usize = 16 << 20;

/// A line of the operator's.
struct Line {
    number: usize,
    written: String,
    action: Action,
}

/// Where the operator's lines come from.
pub(super) enum Hands {
    /// A script that is there as a whole.
    Script(Vec<station::ScriptLine>),
    /// Standard input, as it comes.
    Live,
}

/// The lines that wait, and those that will come.
struct Queue {
    waiting: VecDeque<Line>,
    coming: Option<Receiver<(usize, String)>>,
}

impl Queue {
    fn new(hands: Hands) -> Queue {
        match hands {
            Hands::Script(lines) => {
                let lines = lines.into_iter();
                let waiting = lines.map(|line| Line { number: line.line, written: line.written, action: line.action });
                Queue { waiting: waiting.collect(), coming: None }
            }
            Hands::Live => {
                let (sender, coming) = sync_channel(LINES);
                // It ends with the input, or with the process.
                thread::spawn(move || {
                    let mut input = io::stdin().lock();
                    let mut number = 0;
                    while let Ok(Some(line)) = next_line(&mut input) {
                        number += 1;
                        if sender.send((number, line)).is_err() {
                            break;
                        }
                    }
                });
                Queue { waiting: VecDeque::new(), coming: Some(coming) }
            }
        }
    }

    /// Takes what has come; a line that is no action is told and left.
    fn take(&mut self, mut refuse: impl FnMut(String, String)) {
        while let Some(coming) = &self.coming
            && self.waiting.len() < LINES
        {
            match coming.try_recv() {
                Ok((number, line)) => {
                    let written = without_comment(&line).trim().to_owned();
                    match read_action(&written) {
                        _ if written.is_empty() => {}
                        Ok(action) => self.waiting.push_back(Line { number, written, action }),
                        Err(why) => refuse(written, why),
                    }
                }
                Err(TryRecvError::Empty) => return,
                Err(TryRecvError::Disconnected) => self.coming = None,
            }
        }
    }

    /// The emergency stop does not wait: the lines before it are given back.
    fn emergency(&mut self) -> Option<Vec<Line>> {
        let at = self.waiting.iter().position(|line| line.action == Action::EmergencyStop)?;
        Some(self.waiting.drain(..at).collect())
    }

    fn is_over(&self) -> bool {
        self.waiting.is_empty() && self.coming.is_none()
    }
}

/// The next line; what is longer than any action is cut short, and so no action.
fn next_line(input: &mut impl BufRead) -> io::Result<Option<String>> {
    let mut line = Vec::new();
    if input.by_ref().take(LONGEST).read_until(b'\n', &mut line)? == 0 {
        return Ok(None);
    }
    while line.last() != Some(&b'\n') {
        let mut more = Vec::new();
        if input.by_ref().take(LONGEST).read_until(b'\n', &mut more)? == 0 {
            break;
        }
        // Too long: a byte that no text has makes sure that the part is not taken for the whole.
        line = vec![0xFF];
        line.extend(more.last().filter(|&&byte| byte == b'\n'));
    }
    Ok(Some(String::from_utf8_lossy(&line).into_owned()))
}

/// What is written together: changes of the memory, and behind them what may then be said.
type Piece = (Vec<Change>, Vec<u8>);

/// The memory and standard output, written by a thread of its own.
struct Writer {
    pieces: SyncSender<Piece>,
    thread: JoinHandle<Result<(), Failure>>,
}

impl Writer {
    fn new(mut store: Option<Store>) -> Writer {
        let (pieces, coming) = sync_channel::<Piece>(PIECES);
        let thread = thread::spawn(move || {
            for (changes, piece) in coming {
                if let Some(store) = &mut store {
                    store.commit(&changes).map_err(Failure::call)?;
                }
                let mut out = io::stdout().lock();
                out.write_all(&piece)?;
                out.flush()?;
            }
            Ok(())
        });
        Writer { pieces, thread }
    }

    /// Hands over what has been gathered; false if nobody takes it any more.
    fn pass(&self, changes: &mut Vec<Change>, buffer: &mut Vec<u8>) -> bool {
        if buffer.is_empty() && changes.is_empty() {
            return true;
        }
        let piece = (std::mem::take(changes), std::mem::take(buffer));
        if piece.1.len() >= MOST_WAITING {
            return self.pieces.send(piece).is_ok();
        }
        match self.pieces.try_send(piece) {
            Ok(()) => true,
            Err(TrySendError::Full(piece)) => {
                (*changes, *buffer) = piece;
                true
            }
            Err(TrySendError::Disconnected(_)) => false,
        }
    }

    fn finish(self, changes: Vec<Change>, buffer: Vec<u8>) -> Result<(), Failure> {
        let sent = self.pieces.send((changes, buffer));
        drop(self.pieces);
        match self.thread.join() {
            Ok(written) => written,
            Err(_) => Err(Failure::call("standard output is gone".to_owned())),
        }
        .and(sent.or(Ok(())))
    }
}

/// Performs the operator's lines by the clock. The displays are told so many times a second.
pub(super) fn run(
    operator: &mut Operator<Texts>,
    hands: Hands,
    performance: &mut Performance<'_>,
    displays_hz: Option<f64>,
) -> Result<(), Failure> {
    let live = matches!(hands, Hands::Live);
    let store = performance.keeping.as_mut().and_then(Keeping::take_store);
    let (mut queue, writer, mut changes) = (Queue::new(hands), Writer::new(store), Vec::new());
    let period = operator.session.servo_period();
    operator.run_by_the_clock();
    let mut pace = Pace::new(operator.session.time(), Duration::from_secs_f64(period));
    let mut next_display = operator.session.time().0;
    loop {
        queue.take(|action, why| performance.write(&Said::Refused { action, why }, &mut operator.session));
        while !operator.is_busy()
            && let Some(line) = queue.waiting.pop_front()
        {
            let begun = perform(operator, performance, |operator, tell| {
                operator.begin(&line.action, Some(&line.written), tell)
            });
            match begun {
                Ok(()) => {}
                // What cannot be read has no effect; the hands go on.
                Err(why) if live => {
                    performance.write(&Said::Refused { action: line.written, why }, &mut operator.session);
                }
                Err(why) => return Err(Failure::call(format!("{}:{}: {why}", performance.name, line.number))),
            }
        }
        if operator.is_busy()
            && let Some(dropped) = queue.emergency()
        {
            operator.give_up();
            for line in dropped {
                let why = "EMERGENCY STOP was pressed before it was its turn".to_owned();
                performance.write(&Said::Refused { action: line.written, why }, &mut operator.session);
            }
            continue;
        }
        if queue.is_over() && !operator.is_busy() {
            break;
        }
        let next = Seconds(((operator.session.time().0 / period + 1e-6).floor() + 1.0) * period);
        match perform(operator, performance, |operator, tell| operator.go_on(Some(next), tell)) {
            Ok(true) => continue,
            Ok(false) => {}
            Err(why) if live => say(&format!("{why}\n")),
            Err(why) => return Err(Failure::call(format!("{}: {why}", performance.name))),
        }
        if let Some(hz) = displays_hz
            && operator.session.time().0 >= next_display
        {
            next_display = (next_display + 1.0 / hz).max(operator.session.time().0);
            for show in &DISPLAYS {
                if let Ok(value) = operator.display(show) {
                    let said = Said::Shown { what: show.to_string(), value };
                    performance.write(&said, &mut operator.session);
                }
            }
        }
        if let Some(keeping) = &mut performance.keeping {
            changes.extend(keeping.changes(operator)?);
        }
        if !writer.pass(&mut changes, &mut performance.output.buffer) {
            break;
        }
        pace.wait_until(operator.session.time());
    }
    if let Some(keeping) = &mut performance.keeping {
        keeping.switch_off(operator);
        changes.extend(keeping.changes(operator)?);
    }
    writer.finish(changes, std::mem::take(&mut performance.output.buffer))?;
    say(&pace.tells());
    Ok(())
}
