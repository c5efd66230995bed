//! A run watched block by block and event by event, for everything that a set-up sheet says.

mod moves;

use std::collections::BTreeSet;

use base::{AXES, AxisSet, Place, Point, ProgramId, SourceId};
use dialect::{Control, Division, Meaning};
use machine::{Event, EventKind, MachineAxis};
use meaning::{CodeLine, Dwell, SetValue, State, StopKind, WordsRead};
use station::{Configuration, Library, Session};

use super::shop_floor::{ShopFloor, TOOL_CHANGE};
use super::tool::ToolSheet;
use super::{CalledProgram, CodeUse, OffsetUse, Sheet, Spot, StartUse, StopUse};
use crate::remarks::{remarks, remarks_above};

/// Characters before a block that are looked at for remarks.
const BEFORE: u64 = 2000;

/// The block being executed.
struct Now {
    place: Place,
    spot: Spot,
    state: State,
    zero: Point,
    words: WordsRead,
    remarks: Vec<String>,
    one_shot: Option<Meaning>,
    /// The row of the canned cycle in force.
    cycle: Option<u8>,
    /// No cut of this block has been counted yet.
    fresh: bool,
}

pub struct Watcher {
    configuration: Configuration,
    sheet: Sheet,
    floor: ShopFloor,
    now: Option<Now>,
    /// Axes of which the program itself knows where they are.
    anchored: AxisSet,
    main: Option<ProgramId>,
    /// Where each subprogram was entered first.
    entries: Vec<(ProgramId, SourceId, u64)>,
    options: BTreeSet<usize>,
    option_names: BTreeSet<&'static str>,
    systems: BTreeSet<u8>,
    low: Point,
    high: Point,
    last_time: f64,
}

impl Watcher {
    pub fn new<L: Library>(session: &Session<L>) -> Watcher {
        let configuration = session.configuration().clone();
        let sheet = Sheet {
            control: configuration.control.title.clone(),
            machine: configuration.machine.name.clone(),
            ..Sheet::default()
        };
        Watcher {
            sheet,
            floor: ShopFloor::new(),
            now: None,
            anchored: AxisSet::NONE,
            main: None,
            entries: Vec::new(),
            options: BTreeSet::new(),
            option_names: BTreeSet::new(),
            systems: BTreeSet::new(),
            low: *session.position(),
            high: *session.position(),
            last_time: 0.0,
            configuration,
        }
    }

    fn control(&self) -> &Control {
        &self.configuration.control
    }

    fn axes(&self) -> &[MachineAxis] {
        &self.configuration.machine.axes
    }

    /// A block begins.
    pub fn begin<L: Library>(
        &mut self,
        session: &mut Session<L>,
        place: Place,
        text: &mut impl FnMut(&mut L, SourceId, u64, usize) -> Vec<u8>,
    ) {
        if session.place().block != place.block || place.block.len == 0 {
            return;
        }
        let interpreter = session.interpreter();
        let state = *interpreter.executing_state();
        let words = interpreter.words_read().cloned().unwrap_or_default();
        let zero = interpreter.program_zero(&state);
        let spot = Spot { program: interpreter.program_name(place.program).to_owned(), line: place.line };
        let control = self.configuration.control.clone();
        let codes = words.g_rows.iter().filter_map(|&(_, row)| control.g_codes.get(usize::from(row)));
        for code in codes.clone() {
            if let Division::Option(index) = code.division {
                self.options.insert(usize::from(index));
            }
        }
        let one_shot = codes.clone().find(|code| code.is_one_shot()).map(|code| code.meaning);
        let roles = control.roles;
        let cycle = control.in_force(&state.groups, roles.cycle).filter(|code| code.is_cycle());
        let cycle = cycle.map(|_| state.groups.0[roles.cycle]);
        self.codes_of(&words, &spot, &control);
        if words.m_codes.len() > 1 {
            self.option_names.insert("several-m-codes");
        }
        self.subprogram(&place, &spot);
        let to_machine = matches!(
            one_shot,
            Some(Meaning::ReferenceReturn | Meaning::OtherReferenceReturn | Meaning::MachineCoordinates)
        );
        for (axis, facts) in self.configuration.machine.axes.iter().enumerate().take(AXES) {
            if to_machine && words.word(facts.letter).is_some() {
                self.anchored.add(axis);
            }
        }
        if self.now.is_none() {
            self.sheet.program.clone_from(&spot.program);
            let head = text(session.library_mut(), place.source, 0, (place.block.end() + BEFORE) as usize);
            self.sheet.header = crate::remarks::header(&head, &control.grammar);
        }
        // Remarks are asked for only where the sheet shows them.
        let stops = words.m_codes.iter().any(|&code| is_told(&control, code));
        let remarks = if stops || words.word(b'T').is_some() {
            let from = match &self.now {
                Some(now) if now.place.source == place.source && now.place.block.end() <= place.block.start => {
                    now.place.block.end().max(place.block.start.saturating_sub(BEFORE))
                }
                _ => place.block.start,
            };
            let library = session.library_mut();
            let mut found = Vec::new();
            if words.word(b'T').is_some() {
                let before = text(library, place.source, from, (place.block.start - from) as usize);
                found.extend(remarks_above(&before, &control.grammar));
                found.retain(|remark| !self.sheet.header.contains(remark));
            }
            let own = text(library, place.source, place.block.start, place.block.len as usize);
            found.extend(remarks(&own, &control.grammar));
            found
        } else {
            Vec::new()
        };
        self.optional_stop(&words, &spot, &remarks);
        self.now = Some(Now { place, spot, state, zero, words, remarks, one_shot, cycle, fresh: true });
    }

    fn codes_of(&mut self, words: &WordsRead, spot: &Spot, control: &Control) {
        for &code in &words.m_codes {
            let row = control.m_code(code);
            self.code(format!("M{code:02}"), spot, row.map(|row| row.text.clone()));
            if code > 99 {
                self.option_names.insert("m-three-digits");
            }
        }
    }

    fn code(&mut self, name: String, spot: &Spot, text: Option<String>) {
        match self.sheet.codes.iter_mut().find(|code| code.name == name) {
            Some(code) => code.count += 1,
            None => self.sheet.codes.push(CodeUse { name, count: 1, first: spot.clone(), text }),
        }
    }

    /// M01 with its switch off is no event, and must be known all the same.
    fn optional_stop(&mut self, words: &WordsRead, spot: &Spot, remarks: &[String]) {
        let is = |wanted| {
            words.m_codes.iter().any(|&code| self.control().m_code(code).is_some_and(|row| row.meaning == wanted))
        };
        let name = match (is(dialect::MMeaning::ProgramStop), is(dialect::MMeaning::OptionalStop)) {
            (true, _) => "M00",
            (_, true) => "M01",
            _ => return,
        };
        match self.sheet.stops.iter_mut().find(|stop| stop.spot == *spot && stop.name == name) {
            Some(stop) => stop.count += 1,
            None => {
                let remark = remarks.join(" · ");
                self.sheet.stops.push(StopUse { name, spot: spot.clone(), remark, count: 1 });
            }
        }
    }

    fn subprogram(&mut self, place: &Place, spot: &Spot) {
        let main = *self.main.get_or_insert(place.program);
        if place.program == main {
            return;
        }
        let start = place.block.start;
        match self.entries.iter().position(|(program, ..)| *program == place.program) {
            None => {
                let first = self.now.as_ref().map(|now| now.spot.clone()).unwrap_or_default();
                self.entries.push((place.program, place.source, start));
                let called = CalledProgram { name: spot.program.clone(), source: place.source, first, runs: 1 };
                self.sheet.called.push(called);
            }
            Some(index) if self.entries.get(index).is_some_and(|(.., entry)| *entry == start) => {
                if let Some(called) = self.sheet.called.get_mut(index) {
                    called.runs += 1;
                }
            }
            Some(_) => {}
        }
    }

    /// Something happened.
    pub fn see<L: Library>(&mut self, session: &Session<L>, event: &Event) {
        let passed = event.time.0 - self.last_time;
        self.last_time = event.time.0;
        for tool in self.floor.tools() {
            tool.total += passed;
        }
        match &event.kind {
            EventKind::Rapid { from, to, duration, .. } => {
                self.sheet.times.rapid += duration.0;
                self.reach([from, to]);
                self.moved(from, to);
            }
            EventKind::Feed { from, to, feed, duration, length, .. } => {
                self.reach([from, to]);
                self.cut(*feed, duration.0, *length, [from, to], to);
                self.moved(from, to);
            }
            EventKind::Arc { arc, feed, duration, length, .. } => {
                let (low, high) = arc.extent();
                self.reach([&low, &high]);
                self.cut(*feed, duration.0, *length, [&low, &high], &arc.to);
                self.moved(&arc.from, &arc.to);
                let beside = (0..self.axes().len().min(AXES)).filter(|axis| !arc.axes.contains(&(*axis as u8)));
                if beside.into_iter().any(|axis| arc.from[axis] != arc.to[axis]) {
                    self.option_names.insert("helical");
                }
            }
            EventKind::Dwell(Dwell::Seconds(seconds)) => self.sheet.times.dwell += seconds,
            EventKind::Waited(seconds) => self.sheet.times.waiting += seconds.0,
            EventKind::Code(code) => self.code_out(code.line, code.code),
            EventKind::Set(value) => self.set(session, value, &event.place),
            EventKind::End { kind, .. } => self.sheet.end = Some(*kind),
            EventKind::Alarm(alarm) => self.sheet.alarm = Some(*alarm),
            EventKind::Stop(machine::StopCause::Program(StopKind::Cycle)) => {
                let spot = self.now.as_ref().map(|now| now.spot.clone()).unwrap_or_default();
                let remark = "the tool is taken out by hand".to_owned();
                self.sheet.stops.push(StopUse { name: "cycle", spot, remark, count: 1 });
            }
            _ => {}
        }
    }

    fn code_out(&mut self, line: CodeLine, code: u32) {
        let Some(now) = &self.now else { return };
        let (spot, remarks) = (now.spot.clone(), now.remarks.clone());
        match line {
            CodeLine::T => {
                self.floor.call(ToolSheet { tool: Some(code), first: spot, remarks, ..ToolSheet::default() })
            }
            CodeLine::M => self.floor.machine_code(code, &remarks),
            CodeLine::B => {
                self.option_names.insert("b-function");
                self.code(format!("B{code}"), &spot, None);
            }
            CodeLine::S => {}
        }
    }

    fn reach(&mut self, points: [&Point; 2]) {
        for point in points {
            for axis in 0..AXES {
                self.low[axis] = self.low[axis].min(point[axis]);
                self.high[axis] = self.high[axis].max(point[axis]);
            }
        }
    }

    fn set<L: Library>(&mut self, session: &Session<L>, value: &SetValue, place: &Place) {
        let Some(now) = &self.now else { return };
        let line = place.line;
        match value {
            SetValue::Variable { .. } => {
                self.option_names.insert("user-macro");
            }
            SetValue::WorkOrigin { axes, .. } | SetValue::Shift { axes, .. }
                if now.one_shot == Some(Meaning::SetCoordinates) =>
            {
                let position = *session.position();
                let facts = self.configuration.machine.axes.iter().enumerate().take(AXES);
                let named = facts.filter(|(index, _)| axes.has(*index));
                let axes =
                    named.map(|(index, axis)| (char::from(axis.letter), position[index], !self.anchored.has(index)));
                let start = StartUse { spot: now.spot.clone(), axes: axes.collect() };
                if !self.sheet.starts.iter().any(|known| known.spot == start.spot) {
                    self.sheet.starts.push(start);
                }
            }
            SetValue::Universal { .. } => {}
            value => {
                let control = &self.configuration.control;
                let text = crate::explain::set_text(control, &self.configuration.machine.axes, *value);
                let text = format!("line {line}: {text}");
                if !self.sheet.writes.contains(&text) {
                    self.sheet.writes.push(text);
                }
            }
        }
    }

    /// The sheet, once the program has run.
    pub fn finish<L: Library>(mut self, session: &Session<L>) -> Sheet {
        if session.interpreter().statements_read().next().is_some() {
            self.option_names.insert("user-macro");
        }
        let control = self.configuration.control.clone();
        let times = &mut self.sheet.times;
        times.total = times.cutting + times.rapid + times.dwell + times.waiting;
        for (index, row) in control.options.iter().enumerate() {
            if self.options.contains(&index) || self.option_names.contains(row.name.as_str()) {
                self.sheet.options.push((row.name.clone(), row.text.clone()));
            }
        }
        self.sheet.codes.sort_by_key(|code| code_key(&code.name));
        for (index, axis) in self.configuration.machine.axes.iter().enumerate().take(AXES) {
            let used = [self.low[index], self.high[index]];
            self.sheet.travel.push((char::from(axis.letter), used, axis.travel));
        }
        self.sheet.tools = self.floor.finish();
        let memory = &self.configuration.memory;
        for tool in &self.sheet.tools {
            let used = tool.h.iter().map(|&h| ('H', h)).chain(tool.d.iter().map(|&d| ('D', d)));
            for (letter, number) in used {
                let known = |offset: &&mut OffsetUse| offset.letter == letter && offset.number == number;
                match self.sheet.offsets.iter_mut().find(known) {
                    Some(offset) => offset.tools.push(tool.tool),
                    None => {
                        let value = if letter == 'H' { memory.length(number) } else { memory.radius(number) };
                        let value = value.unwrap_or(0.0) / 1e6;
                        self.sheet.offsets.push(OffsetUse { letter, number, value, tools: vec![tool.tool] });
                    }
                }
            }
        }
        self.sheet.offsets.sort_by_key(|offset| (offset.letter == 'D', offset.number));
        self.sheet
    }
}

/// M codes whose remarks stand on the sheet: stops and tool changes.
fn is_told(control: &Control, code: u32) -> bool {
    use dialect::MMeaning::{OptionalStop, ProgramStop};
    let meaning = control.m_code(code).map(|row| row.meaning);
    code == TOOL_CHANGE || matches!(meaning, Some(ProgramStop | OptionalStop))
}

/// M codes first, each letter by its numbers.
fn code_key(name: &str) -> (bool, u32) {
    (name.starts_with('B'), name.get(1..).and_then(|digits| digits.parse().ok()).unwrap_or(0))
}
