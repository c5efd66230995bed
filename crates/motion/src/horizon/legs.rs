//! The legs in which one cell is driven: stretches of constant acceleration.

use super::drive::Leg;
use crate::cell::Cell;

/// The legs of one cell.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(super) struct Legs {
    pub legs: [Leg; 4],
    pub count: usize,
    /// The move ends behind this one.
    pub border: Option<usize>,
    /// The squared speed at the end of the cell, as its way counts; `None` if the axes come to stand in it.
    pub end: Option<f64>,
}

impl Legs {
    fn push(&mut self, leg: Leg) {
        if leg.seconds > 0.0 && self.count < self.legs.len() {
            self.legs[self.count] = leg;
            self.count += 1;
        }
    }
}

/// The legs of a bent cell: as hard as the axes can towards what is allowed in it, or towards the line of speeds that
/// falls to what may be driven at its end; along that to there.
pub(super) fn speed_up_bent(cell: &Cell, x: f64, end: f64) -> Legs {
    let (start, length) = (cell.part[0], cell.length());
    let (allowed, peak, leads_to) = (cell.allowed(), cell.peak, cell.leads_to);
    let end = end.min(allowed);
    let mut legs = Legs::default();
    // From a fraction of the cell to another one, at these squared speeds.
    let per_length = 0.5 / length;
    let mut leg = |[from, to]: [f64; 2], [x, y]: [f64; 2], change: f64| {
        if to > from {
            let [speed, last] = [x, y].map(|x| x.max(0.0).sqrt());
            let seconds = 2.0 * (to - from) * length / (speed + last);
            let (s, acceleration) = (start + from * length, change * per_length);
            legs.push(Leg { s, speed, acceleration, seconds, ..Leg::default() });
        }
    };
    // On the falling line already.
    if x == peak && leads_to == end && peak <= allowed {
        leg([0.0, 1.0], [x, end], end - x);
        legs.end = Some(end);
        return legs;
    }
    let [low, high] = cell.reach(x);
    let is_over = x > peak.min(allowed);
    let met = if is_over { meets_falling(cell, x, low) } else { meets_rising(cell, x, high, end) };
    let Some((met, hard)) = met else {
        // Where the axes are to stand they do, be it that a rounding has made them a little too fast for it.
        let reached = if cell.stops {
            0.0
        } else if is_over {
            low.max(0.0)
        } else {
            high.min(end).max(0.0)
        };
        leg([0.0, 1.0], [x, reached], reached - x);
        legs.end = Some(reached);
        return legs;
    };
    let falls = |at: f64| peak + (leads_to - peak) * at;
    // So far what is allowed is lower than the falling line.
    let level = if peak > allowed { (peak - allowed) / (peak - leads_to) } else { 0.0 }.clamp(met, 1.0);
    let top = if level > met { allowed } else { falls(met) };
    leg([0.0, met], [x, top], hard - x);
    leg([met, level], [top, top], 0.0);
    leg([level, 1.0], [top, leads_to], leads_to - peak);
    legs.end = Some(leads_to);
    legs
}

/// Where in a cell, as a fraction of it, speed has risen to what may be driven, and the line along which it rises.
fn meets_rising(cell: &Cell, x: f64, high: f64, end: f64) -> Option<(f64, f64)> {
    if high <= end || cell.leads_to < end {
        return None;
    }
    let [to_peak, above] = [cell.peak - x, high - cell.leads_to];
    let falling = to_peak / (to_peak + above);
    let level = if high > cell.allowed() { (cell.allowed() - x) / (high - x) } else { 1.0 };
    Some((falling.min(level).clamp(0.0, 1.0), high))
}

/// The same where speed is to fall.
fn meets_falling(cell: &Cell, x: f64, low: f64) -> Option<(f64, f64)> {
    let (over, above) = (x - cell.allowed(), x - cell.peak);
    if low >= cell.leads_to || low >= cell.allowed() {
        return None;
    }
    let level = if over > 0.0 { over / (x - low) } else { 0.0 };
    let falling = if above > 0.0 { above / (above + cell.leads_to - low) } else { 0.0 };
    Some((level.max(falling).clamp(0.0, 1.0), low))
}

/// The legs of a straight cell from one squared speed to at most another.
pub(super) fn speed_up(cell: &Cell, acceleration: f64, x: f64, end: f64) -> Legs {
    let (start, length) = (cell.part[0], cell.length());
    let mut legs = Legs::default();
    let allowed = cell.allowed();
    let double = 2.0 * acceleration;
    let end = end.min(allowed).min(x + double * length).max(x - double * length);
    let peak = if x > allowed { allowed } else { allowed.min((x + end) / 2.0 + acceleration * length).max(x) };
    let [first, top, last] = [x, peak.max(end), end].map(f64::sqrt);
    let rising = (top * top - x) / double;
    let (rise, fall) = (rising.abs(), (top * top - last * last) / double);
    let cruise = length - rise - fall;
    legs.push(Leg {
        s: start,
        speed: first,
        acceleration: acceleration.copysign(rising),
        seconds: (top - first).abs() / acceleration,
        ..Leg::default()
    });
    if cruise > 0.0 {
        legs.push(Leg { s: start + rise, speed: top, seconds: cruise / top, ..Leg::default() });
    }
    legs.push(Leg {
        s: start + length - fall,
        speed: top,
        acceleration: -acceleration,
        seconds: (top - last) / acceleration,
        ..Leg::default()
    });
    legs.end = Some(end);
    legs
}

/// The legs of a cell in which the axes are to stand as soon as they can.
pub(super) fn slow_down(cell: &Cell, x: f64) -> Legs {
    let (start, length) = (cell.part[0], cell.length());
    let mut legs = Legs::default();
    let speed = x.sqrt();
    if let Some(u) = cell.braking(x) {
        legs.push(Leg {
            s: start,
            speed,
            acceleration: u,
            seconds: if x > 0.0 { speed / -u } else { 0.0 },
            ..Leg::default()
        });
        return legs;
    }
    let reached = cell.slowest_after(x);
    let seconds = 2.0 * length / (speed + reached.sqrt());
    legs.push(Leg { s: start, speed, acceleration: (reached - x) / (2.0 * length), seconds, ..Leg::default() });
    legs.end = Some(reached);
    legs
}

/// Parts the leg in which a border lies.
pub(super) fn split(legs: &mut Legs, border: f64) {
    let whole = *legs;
    (legs.count, legs.border) = (0, None);
    for leg in &whole.legs[..whole.count] {
        let (end, _) = leg.at(leg.seconds);
        if legs.border.is_some() || end < border {
            legs.push(*leg);
            continue;
        }
        let way = (border - leg.s).max(0.0);
        let there = (leg.speed * leg.speed + 2.0 * leg.acceleration * way).max(0.0).sqrt();
        let seconds = if way > 0.0 { (2.0 * way / (leg.speed + there)).min(leg.seconds) } else { 0.0 };
        legs.legs[legs.count] = Leg { seconds, ..*leg };
        legs.count += 1;
        legs.border = Some(legs.count);
        legs.push(Leg { s: leg.s + way, speed: there, seconds: leg.seconds - seconds, ..*leg });
    }
    if legs.border.is_none() && whole.end.is_some() {
        legs.border = Some(legs.count);
    }
}
