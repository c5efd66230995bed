//! What a word is for in the block at hand, by the function that asked for it. `None` leaves it to the table's own words.

use dialect::Meaning;
use meaning::ReadAs;

use super::count::count;
use super::here::Here;
use super::quantity::{coordinate, quantity};

/// What the word of this letter does here, of which this was read.
pub fn role(here: &Here, letter: u8, read: ReadAs, value: f64) -> Option<String> {
    if matches!(read, ReadAs::Seconds | ReadAs::Turns) {
        return Some(match here.one_shot() {
            Some(Meaning::Dwell) => "how long the axes wait".to_owned(),
            _ => "how long the tool waits at the bottom of the hole".to_owned(),
        });
    }
    if let Some(says) = direction(here, letter) {
        return Some(says);
    }
    if let Some((_, facts)) = here.axis(letter) {
        return match polar(here, letter, read == ReadAs::Angle && !facts.rotary) {
            Some(says) => Some(says),
            None => axis(here, letter, value),
        };
    }
    if read == ReadAs::Ratio {
        return Some(ratio(letter, value));
    }
    if letter == b'R' && here.has_code(Meaning::RotationOn) {
        return Some("angle of the rotation, + counter-clockwise".to_owned());
    }
    if let Some(says) = count(here, letter, value) {
        return Some(says);
    }
    match letter {
        b'N' => Some("sequence number: a target of jumps and searches; nothing happens".to_owned()),
        b'O' => Some("program number: the program of this name begins".to_owned()),
        b'F' => Some(feed(here)),
        b'H' => Some(offset(here, 0, Meaning::length_offset, "length compensation")),
        b'D' => Some(offset(here, 1, Meaning::position_offset, "tool radius or position")),
        b'S' if here.keeps_surface_speed() => {
            Some("surface speed: the spindle follows the distance from zero".to_owned())
        }
        b'S' => Some("spindle speed, rev/min: goes out as the block begins".to_owned()),
        b'T' => Some("tool number: goes out as the block begins; what the machine does is its builder's".to_owned()),
        b'B' => Some("code of the B function, usually an index position: goes out to the machine".to_owned()),
        b'I' | b'J' | b'K' | b'R' => geometry(here, letter, value),
        _ => None,
    }
}

/// A word of the tool's direction, where X, Y and Z of straight movements are its tip.
fn direction(here: &Here, letter: u8) -> Option<String> {
    let straight = matches!(here.motion(), Some(Meaning::Rapid | Meaning::Linear)) && here.cycle().is_none();
    let free = here.one_shot().is_none_or(|code| code == Meaning::ExactStop);
    if !(here.fitting.options.tool_tip && straight && free) {
        return None;
    }
    Some(match letter {
        b'A' => "the tool tilts by this about X".to_owned(),
        b'B' => "the tool tilts by this about Y".to_owned(),
        b'C' => "the tilted tool is turned by this about Z".to_owned(),
        b'I' => "direction of the tool, from its tip to the holder: along X".to_owned(),
        b'J' => "direction of the tool, from its tip to the holder: along Y".to_owned(),
        b'K' => "direction of the tool, from its tip to the holder: along Z".to_owned(),
        b'X' | b'Y' | b'Z' => return Some(format!("tip of the tool: {}", tip(here, letter)?)),
        _ => return None,
    })
}

fn tip(here: &Here, letter: u8) -> Option<String> {
    let (_, value) = here.read(letter)?;
    Some(place(here, letter, value))
}

/// A word of the plane in polar coordinates.
fn polar(here: &Here, letter: u8, is_angle: bool) -> Option<String> {
    let after = &here.watched.after;
    if !after.polar.on {
        return None;
    }
    let how = if here.is_absolute() { "absolute" } else { "added to the angle so far" };
    if is_angle {
        return Some(format!("angle about the pole, + counter-clockwise, {how}"));
    }
    let plane = match here.in_force(here.control.roles.plane) {
        Some(Meaning::PlaneZx) => b'Z',
        Some(Meaning::PlaneYz) => b'Y',
        _ => b'X',
    };
    let pole = if here.is_absolute() { "program zero" } else { "the present place" };
    let taken = here.has_code(Meaning::ScalingOn) || here.has_code(Meaning::RotationOn) || here.one_shot().is_some();
    (letter == plane && !taken).then(|| format!("radius from the pole, which is {pole}"))
}

/// A ratio of scaling.
fn ratio(letter: u8, value: f64) -> String {
    let along = match letter {
        b'I' => "X",
        b'J' => "Y",
        b'K' => "Z",
        _ => return "ratio of the axes that have none of their own".to_owned(),
    };
    let mirrors = if value < 0.0 { ", which it mirrors" } else { "" };
    format!("ratio of {along}{mirrors}")
}

fn axis(here: &Here, letter: u8, value: f64) -> Option<String> {
    let name = char::from(letter);
    let unit = if here.axis(letter).is_some_and(|(_, axis)| axis.rotary) { "deg" } else { "mm" };
    let at = format!("{} {unit}", coordinate(value));
    match here.one_shot() {
        Some(Meaning::SetCoordinates) => return Some(format!("the present place is called {name} {at} from here on")),
        Some(Meaning::MachineCoordinates) => {
            return Some(format!("to machine {name} {at}; offsets and work system are left out"));
        }
        Some(Meaning::ReferenceReturn | Meaning::OtherReferenceReturn) => {
            return Some(format!("by way of {}, then {name} goes to its reference point", place(here, letter, value)));
        }
        Some(Meaning::BoltCircle | Meaning::ArcPattern) => return Some(format!("{name} of the circle's centre")),
        Some(Meaning::LinePattern) => return Some(format!("{name} of the first hole")),
        Some(Meaning::LocalCoordinates) => {
            return Some(format!("local zero: {at} along {name} from the zero of every work system"));
        }
        Some(Meaning::WriteData) => {
            let how = if here.is_absolute() { "becomes" } else { "grows by" };
            return Some(format!("the origin along {name} {how} {at}"));
        }
        Some(code) if !keeps_places(code) => return None,
        _ => {}
    }
    if here.has_code(Meaning::ScalingOn) {
        return Some(format!("{name} of the centre of scaling"));
    }
    if here.has_code(Meaning::RotationOn) {
        return Some(format!("{name} of the centre of rotation"));
    }
    if here.has_code(Meaning::StrokeCheckOn) {
        return Some(face(here, "upper", &name.to_string()));
    }
    if here.cycle().is_some() {
        if letter == meaning::LENGTH_AXIS {
            let whence = if here.is_absolute() { "absolute" } else { "counted from the R level" };
            return Some(format!("bottom of the hole, {whence}"));
        }
        return Some(format!("{name} of the hole: {}", place(here, letter, value)));
    }
    Some(place(here, letter, value))
}

/// A face of the stroke box.
fn face(here: &Here, which: &str, along: &str) -> String {
    match here.control.functions.any_corners {
        true => format!("face of the box along {along}, machine coordinate"),
        false => format!("{which} face of the box along {along}, machine coordinate"),
    }
}

/// True for one-shot codes under which an axis word is where the axis goes.
fn keeps_places(code: Meaning) -> bool {
    code.position_offset().is_some()
        || matches!(
            code,
            Meaning::ExactStop
                | Meaning::RapidWithoutCheck
                | Meaning::ReferenceCheck
                | Meaning::Skip
                | Meaning::ReturnFromReference
        )
}

/// Where an axis word leads.
fn place(here: &Here, letter: u8, value: f64) -> String {
    let name = char::from(letter);
    let unit = if here.axis(letter).is_some_and(|(_, axis)| axis.rotary) { "deg" } else { "mm" };
    if !here.is_absolute() {
        let sign = if value < 0.0 { "" } else { "+" };
        return format!("{name} by {sign}{} {unit}", coordinate(value));
    }
    let system = here.name_in(here.control.roles.work);
    let mut text = format!("{name} to {} {unit} in {system}", coordinate(value));
    let length = here.watched.after.length / 1e6;
    if letter == meaning::LENGTH_AXIS && length != 0.0 {
        text.push_str(&format!(", length offset {} mm added", coordinate(length)));
    }
    text
}

fn feed(here: &Here) -> String {
    if here.motion() == Some(Meaning::Thread) && here.cycle().is_none() {
        return "lead: the way along the cut for one turn of the spindle".to_owned();
    }
    let cuts = here
        .watched
        .events
        .iter()
        .any(|event| matches!(event.kind, machine::EventKind::Feed { .. } | machine::EventKind::Arc { .. }));
    if cuts { "feed of the cut along its path".to_owned() } else { "feed of the cuts from here on".to_owned() }
}

/// H and D: the memory cell, what it holds, whether anything uses it now.
fn offset(here: &Here, which: usize, uses: fn(Meaning) -> Option<f64>, what: &str) -> String {
    let held = here.watched.offsets[which];
    let cell = held.map_or_else(
        || "an offset".to_owned(),
        |mm| format!("offset of {}", quantity(ReadAs::Length, mm, here.units())),
    );
    let roles = here.control.roles;
    let acts = if which == 0 {
        here.in_force(roles.length).and_then(uses).is_some_and(|factor| factor != 0.0)
    } else {
        let side =
            matches!(here.in_force(roles.compensation), Some(Meaning::CompensationLeft | Meaning::CompensationRight));
        side || cuts_circle(here.one_shot()) || here.one_shot().and_then(uses).is_some()
    };
    let how = if acts { "it acts here" } else { "chosen, and not in use here" };
    format!("chooses the {cell} for {what}; {how}")
}

pub(super) fn shifts(here: &Here) -> bool {
    here.cycle().is_some_and(|cycle| here.control.functions.cycle.shifts(cycle))
}

fn cuts_circle(code: Option<Meaning>) -> bool {
    matches!(code, Some(Meaning::CircleCutClockwise | Meaning::CircleCutCounterClockwise))
}

pub(super) fn is_pattern(code: Option<Meaning>) -> bool {
    matches!(code, Some(Meaning::BoltCircle | Meaning::ArcPattern | Meaning::LinePattern))
}

fn geometry(here: &Here, letter: u8, value: f64) -> Option<String> {
    let shot = here.one_shot();
    if is_pattern(shot) {
        let line = shot == Some(Meaning::LinePattern);
        return Some(match letter {
            b'I' if line => "pitch from hole to hole".to_owned(),
            b'I' => "radius of the circle of holes".to_owned(),
            b'J' if line => "direction of the line, from +X counter-clockwise".to_owned(),
            b'J' => "direction of the first hole, from +X counter-clockwise".to_owned(),
            b'K' => "angle from hole to hole, counter-clockwise".to_owned(),
            _ => "R level of the hole".to_owned(),
        });
    }
    if cuts_circle(shot) {
        return (letter == b'I').then(|| "radius of the hole".to_owned());
    }
    if shot == Some(Meaning::WriteData) {
        let how = if here.is_absolute() { "takes the place of what the cell holds" } else { "is added to the cell" };
        return (letter == b'R').then(|| format!("value of the offset: it {how}"));
    }
    let along = match letter {
        b'I' => Some('X'),
        b'J' => Some('Y'),
        b'K' => Some('Z'),
        _ => None,
    };
    if let Some(along) = along {
        if here.has_code(Meaning::ScalingOn) {
            return Some(format!("{along} of the centre of scaling"));
        }
        if here.has_code(Meaning::StrokeCheckOn) {
            return Some(face(here, "lower", &along.to_string()));
        }
    }
    if here.cycle().is_some() {
        let whence = if here.is_absolute() { "absolute" } else { "counted from the initial level" };
        return match letter {
            b'R' => Some(format!("R level, to which the tool comes at rapid: {whence}")),
            b'I' if shifts(here) => Some("shift away from the wall along X, spindle oriented".to_owned()),
            b'J' if shifts(here) => Some("shift away from the wall along Y, spindle oriented".to_owned()),
            _ => None,
        };
    }
    let keeps = shot.is_none_or(|code| code.position_offset().is_some() || code == Meaning::ExactStop);
    if !keeps || !here.motion().is_some_and(Meaning::is_arc) {
        return None;
    }
    Some(match letter {
        b'R' if value < 0.0 => "radius of the arc, minus for the arc of more than 180 deg".to_owned(),
        b'R' => "radius of the arc of up to 180 deg".to_owned(),
        _ if here.has(b'R') => "without effect: R gives the arc".to_owned(),
        _ => format!("centre of the arc, counted from its start along {}", along.unwrap_or('Z')),
    })
}
