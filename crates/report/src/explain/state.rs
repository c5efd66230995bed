//! What a block leaves to the next one, value by value, and what it changed.
//!
//! The state is taken apart field by field, so that the compiler asks for a line here when it gets a new one.

use base::{AXES, AxisSet, Point};
use dialect::{Control, VariableMeaning};
use machine::MachineAxis;
use meaning::{Corner, Interrupt, Polar, Spindle, State, StrokeBox, Transform};

use super::quantity::{coordinate, plain};

/// One value of the state.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Value {
    /// What it is.
    pub name: String,
    /// What it was before the block.
    pub before: String,
    /// What it is after it.
    pub after: String,
}

/// A state with what stands beside it.
#[derive(Clone, Copy)]
pub struct Moment<'m> {
    pub state: &'m State,
    /// Where the axes are, mm and degrees, machine coordinates.
    pub at: &'m Point,
    /// The same in program coordinates.
    pub program: &'m Point,
}

/// Every value that differs between two moments.
pub fn changes(control: &Control, axes: &[MachineAxis], before: Moment, after: Moment) -> Vec<Value> {
    let (before, after) = (values(control, axes, before), values(control, axes, after));
    let mut changed: Vec<Value> = Vec::new();
    for (name, now) in &after {
        let was = before.iter().find(|(known, _)| known == name).map_or("-", |(_, value)| value.as_str());
        if was != now {
            changed.push(Value { name: name.clone(), before: was.to_owned(), after: now.clone() });
        }
    }
    changed
}

/// The codes in force, in the order of their groups.
pub fn codes_in_force(control: &Control, state: &State) -> Vec<(u8, String)> {
    control.shown_groups().map(|(index, group)| (group.number, control.g_name(state.groups.0[index]))).collect()
}

/// The values so far, and what is needed to name and show one more.
struct List<'l> {
    axes: &'l [MachineAxis],
    values: Vec<(String, String)>,
}

fn values(control: &Control, axes: &[MachineAxis], moment: Moment) -> Vec<(String, String)> {
    let Moment { state, at, program } = moment;
    let State { groups, spindle, tool, index, h, d, unknown, .. } = state;
    let mut list = List { axes, values: Vec::new() };
    for (index, group) in control.shown_groups() {
        let code = if unknown.group(index) { "unknown".to_owned() } else { control.g_name(groups.0[index]) };
        list.add(format!("group {:02} {}", group.number, group.name), code);
    }
    let word = |letter: u8, value: String| if unknown.word(letter) { "unknown".to_owned() } else { value };
    list.add("F", word(b'F', feed(state)));
    for (letter, value) in [(b'S', spindle), (b'T', tool), (b'B', index), (b'H', h), (b'D', d)] {
        list.add(char::from(letter), word(letter, value.to_string()));
    }
    list.add("length offset", coordinate(state.length / 1e6));
    list.add("length offset still to be moved", coordinate(state.length_due / 1e6));
    list.places("machine", at, unknown.axes);
    list.places("program", program, unknown.axes);
    list.rest(control, state);
    list.values
}

impl List<'_> {
    fn add(&mut self, name: impl ToString, value: String) {
        self.values.push((name.to_string(), value));
    }

    /// A point in mm and degrees, axis by axis.
    fn places(&mut self, name: &str, point: &Point, unknown: AxisSet) {
        for (index, axis) in self.axes.iter().enumerate().take(AXES) {
            let value = if unknown.has(index) { "unknown".to_owned() } else { coordinate(point[index]) };
            self.add(format!("{name} {}", char::from(axis.letter)), value);
        }
    }

    /// A point in counts.
    fn counts(&mut self, name: &str, point: &Point, unknown: AxisSet) {
        self.places(name, &point.map(|value| value / 1e6), unknown);
    }

    fn set(&mut self, name: &str, set: AxisSet) {
        let axes = self.axes.iter().enumerate().filter(|(axis, _)| set.has(*axis));
        let letters: String = axes.map(|(_, axis)| char::from(axis.letter)).collect();
        self.add(name, or_none((!letters.is_empty()).then_some(letters)));
    }

    fn switch(&mut self, name: &str, on: bool) {
        self.add(name, if on { "on" } else { "off" }.to_owned());
    }

    /// What stands beside the codes, the words and the present place.
    fn rest(&mut self, control: &Control, state: &State) {
        #[rustfmt::skip]
        let State {
            // Shown already, or nothing that a block says of itself.
            groups: _, feed: _, radius: _, spindle: _, tool: _, index: _, h: _, d: _, machine: _, length: _, length_due: _,
            sequence: _, memory_mark: _, spindle_stopped: _,
            base_origin, common_shift, universal_zero, displacement, cycle, miscellaneous, skip, block_control,
            feed_control, reference, interrupt, buffering, corner, stroke, transform, polar,
            spindle_direction, unknown, local, surface_speed,
        } = state;
        self.counts("base origin", base_origin, unknown.origins);
        self.counts("shift of all systems", common_shift, AxisSet::NONE);
        self.counts("local origin", local, AxisSet::NONE);
        self.add("surface speed", format!("{} m/min", plain(surface_speed / 1e9, 3)));
        self.counts("zero of the UNIVERSAL display", universal_zero, AxisSet::NONE);
        self.counts("displacement", displacement, AxisSet::NONE);
        let level = |counts: Option<f64>| or_none(counts.map(|counts| coordinate(counts / 1e6)));
        // Without a cycle there is no such level.
        let initial = (*cycle != Default::default()).then_some(cycle.initial);
        self.add("cycle: initial level (machine, without length offset)", level(initial));
        self.add("cycle: R level", level(cycle.r));
        self.add("cycle: bottom", level(cycle.bottom));
        self.add("cycle: Q", coordinate(cycle.peck / 1e6));
        self.add("cycle: shift I", level(cycle.shift.map(|[i, _]| i)));
        self.add("cycle: shift J", level(cycle.shift.map(|[_, j]| j)));
        self.add("cycle: dwell", format!("{} s", plain(cycle.dwell, 3)));
        self.add("M last commanded", miscellaneous.to_string());
        let controls = [(VariableMeaning::BlockControl, block_control), (VariableMeaning::FeedControl, feed_control)];
        for (meaning, bits) in controls {
            if let Some((number, _)) = control.user_macro.range_of(meaning) {
                self.add(format!("#{number}"), bits.to_string());
            }
        }
        self.counts("end of the last skip move", skip, AxisSet::NONE);
        self.set("reference points established", reference.established);
        self.set("intermediate points remembered", reference.remembered);
        self.counts("intermediate point", &reference.via, AxisSet::NONE);
        self.add(
            "an interrupt goes on at",
            or_none(interrupt.as_ref().map(Interrupt::line).map(|n| format!("line {n}"))),
        );
        self.switch("buffering", *buffering);
        let corner = match corner {
            Corner::NotProgrammed => None,
            Corner::Arc => Some("on an arc"),
            Corner::Intersection => Some("through the intersection"),
        };
        self.add("outside corners", or_none(corner.map(str::to_owned)));
        self.stroke(stroke);
        self.transform(transform);
        self.polar(polar);
        let direction = spindle_direction.map(|direction| match direction {
            Spindle::Forward => "forward".to_owned(),
            Spindle::Reverse => "reverse".to_owned(),
            Spindle::Stop | Spindle::Orient => "none".to_owned(),
        });
        self.add("direction of the spindle", or_none(direction));
    }

    fn stroke(&mut self, stroke: &StrokeBox) {
        self.set("stroke box: axes", stroke.axes);
        for (name, faces) in [("low", stroke.low), ("high", stroke.high)] {
            for (letter, counts) in ['X', 'Y', 'Z'].into_iter().zip(faces) {
                self.add(format!("stroke box: {name} {letter}"), coordinate(counts / 1e6));
            }
        }
    }

    fn transform(&mut self, transform: &Transform) {
        self.set("scaling: axes", transform.scaled);
        self.factors(transform);
        let mut center = [0.0; AXES];
        for (place, counts) in center.iter_mut().zip(transform.center) {
            *place = counts;
        }
        self.counts("scaling: centre", &center, AxisSet::NONE);
        let rotation = &transform.rotation;
        if rotation.on {
            self.add("rotation: angle", format!("{} deg", coordinate(rotation.degrees)));
            for (&axis, counts) in rotation.axes.iter().zip(rotation.center) {
                let letter = self.axes.get(usize::from(axis)).map_or('?', |axis| char::from(axis.letter));
                self.add(format!("rotation: centre {letter}"), coordinate(counts / 1e6));
            }
        }
        self.switch("mirror", transform.mirror);
        self.set("mirror: axes", transform.mirrored);
        let axes = self.axes.iter().enumerate().filter(|(axis, _)| transform.mirrored.has(*axis));
        for (index, axis) in axes {
            self.add(format!("mirror: about {}", char::from(axis.letter)), coordinate(transform.line[index] / 1e6));
        }
    }
}

impl List<'_> {
    /// One factor, or that of each axis where they differ; 1 where nothing is scaled.
    fn factors(&mut self, transform: &Transform) {
        let scaled =
            || self.axes.iter().zip(transform.factor).enumerate().filter(|(axis, _)| transform.scaled.has(*axis));
        let first = scaled().next().map_or(1.0, |(_, (_, factor))| factor);
        let value = if scaled().all(|(_, (_, factor))| factor == first) {
            plain(first, 3)
        } else {
            let each: Vec<String> = scaled()
                .map(|(_, (axis, factor))| format!("{} {}", char::from(axis.letter), plain(factor, 4)))
                .collect();
            each.join(", ")
        };
        self.add("scaling: factor", value);
    }

    fn polar(&mut self, polar: &Polar) {
        if polar.on {
            self.add("polar: radius", coordinate(polar.radius / 1e6));
            self.add("polar: angle", format!("{} deg", coordinate(polar.degrees)));
            for (name, counts) in ["first", "second"].into_iter().zip(polar.pole) {
                self.add(format!("polar: pole, {name} axis"), coordinate(counts / 1e6));
            }
        }
    }
}

fn or_none(value: Option<String>) -> String {
    value.unwrap_or_else(|| "-".to_owned())
}

fn feed(state: &State) -> String {
    let unit = if state.feed.per_revolution { "mm/rev" } else { "mm/min" };
    match state.feed.nanometres {
        0.0 => "-".to_owned(),
        nanometres => format!("{} {unit}", plain(nanometres / 1e6, 4)),
    }
}
