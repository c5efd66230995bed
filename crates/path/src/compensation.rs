//! Tool radius compensation: the tool's centre runs beside the programmed path, exact lines and arcs beside exact lines
//! and arcs.
//!
//! Comes in: the element of the block being executed and what the control's buffer holds behind it. Goes out: a
//! [`Plan`], the places beside the programmed points by way of which the block runs. It keeps the vector by which the
//! tool stands beside its programmed place, nothing of the path behind it.
//! Rules: MX1 operator's manual TOE-C843-7.30, 2.9.1 and table 2.19 (the codes); all geometry after the practice of
//! Fanuc controls of the time, what is open as policies.

mod corner;
mod edge;
mod gouge;
mod interference;
mod intersection;

use std::f64::consts::TAU;

use dialect::{CompensationCut, CompensationRestart, CompensationRules, CompensationStart};
use meaning::Offset;

pub use corner::{Corner, TANGENT_MM};
pub(crate) use corner::{Join, sweep_round};
pub(crate) use edge::Edge;
use gouge::{Cut, Neighbours, cut};
pub use interference::BACKWARDS_MM;
pub(crate) use interference::Fault;
use interference::{judge, judge_room};

use crate::plane::{NONE, Vector};

/// An element with the offset of its block.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(crate) struct Beside {
    pub edge: Edge,
    pub offset: Offset,
}

/// What the buffer shows behind an element. Its parts stay in their places: copies of them in motion cost more than the
/// geometry.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(crate) struct Next {
    pub kind: NextKind,
    /// The next element, if there is one.
    pub beside: Beside,
}

/// What stands behind an element.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) enum NextKind {
    /// Nothing with a way in the plane: it is not read yet, or too many blocks without one stand between.
    #[default]
    Unseen,
    /// A block that runs without the offset.
    Ends,
    /// The next element.
    Element,
}

impl Next {
    /// The next element.
    pub fn element(&self) -> Option<&Beside> {
        (self.kind == NextKind::Element).then_some(&self.beside)
    }
}

/// What a control lays down.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Rules {
    pub start: CompensationStart,
    pub restart: CompensationRestart,
    pub cut: CompensationCut,
    pub table: CompensationRules,
}

/// Which element a fault is found in.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Which {
    This,
    Next,
    After,
}

/// How an element is run, beside the way from its end to the next element's path: that its end is, whose first place ends
/// its own path. All places are vectors from its programmed start or end.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(crate) struct Plan {
    /// Round the corner at its start, where the block before stopped short of it: the first place is where it stands.
    pub before: Option<Join>,
    /// The angle of its own path, radians; 0 for a line.
    pub sweep: f64,
    /// The block begins compensation.
    pub starts: bool,
}

/// The state of compensation along the path.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Compensation {
    /// From the programmed place to where the tool stands, along the plane's axes, mm.
    vector: Vector,
    /// The plane's axes.
    axes: [u8; 2],
    /// Elements are run beside the path; the first one after that is not so leads to it.
    on: bool,
    /// The radius beside the element run last.
    radius: f64,
    /// The element run last.
    last: Edge,
    /// The tool stopped square to its end, not where the next one begins.
    stopped: bool,
    /// It led from the programmed path, or from there to the contour.
    leads: bool,
    /// It led from the programmed path.
    starts: bool,
    /// Checking on: the element before was refused.
    doubtful: bool,
}

impl Compensation {
    /// True if the tool may stand beside its programmed place.
    pub(crate) fn is_on(&self) -> bool {
        self.on || self.vector != NONE
    }

    /// From the programmed place to where the tool stands.
    pub(crate) fn vector(&self) -> Vector {
        self.vector
    }

    /// The plane's axes.
    pub(crate) fn axes(&self) -> [u8; 2] {
        self.axes
    }

    /// True if where the tool stands is uncertain.
    pub(crate) fn is_doubtful(&self) -> bool {
        self.doubtful
    }

    /// The block goes to places of its own on some axes of the plane: there the tool leaves its offset, and the next
    /// element takes it up anew.
    pub(crate) fn drop_on(&mut self, dropped: [bool; 2]) {
        for (way, dropped) in self.vector.iter_mut().zip(dropped) {
            if dropped {
                *way = 0.0;
            }
        }
        self.leave();
    }

    /// The tool comes back to its programmed path.
    pub(crate) fn cancel(&mut self) {
        self.vector = NONE;
        self.leave();
    }

    fn leave(&mut self) {
        self.on = false;
        self.stopped = false;
        self.doubtful = false;
    }

    /// How the element is run, with what follows it, and its end, which [`Compensation::look_past`] may have made already.
    ///
    /// # Errors
    /// The block is not run: which element is at fault. Checking on, [`Compensation::pass`] goes past it.
    #[inline]
    pub(crate) fn plan(
        &self,
        now: &Beside,
        next: &Next,
        (is_ended, end): (bool, &mut Join),
        rules: &Rules,
        plan: &mut Plan,
    ) -> Result<(), (Which, Fault)> {
        let radius = now.offset.radius;
        (plan.starts, plan.before, plan.sweep) = (!self.on, None, 0.0);
        if plan.starts {
            if now.edge.is_arc() {
                return Err((Which::This, Fault::StartsByArc));
            }
            *end = begin(now, next, rules.start);
            return Ok(());
        }
        if !is_ended && !end_of(now, next, end) {
            if !self.doubtful {
                // Nothing meets beside an arc that is too small: that is what is wrong with it.
                let room =
                    next.element().map(|next| judge_room(&next.edge, [radius, next.offset.radius], &rules.table));
                return Err((Which::Next, room.and_then(Result::err).unwrap_or(Fault::Apart)));
            }
            *end = Join::at(now.edge.normal(1, radius));
        }
        if self.stopped {
            plan.before = self.way_round(now, rules.restart);
        }
        // A known end has been judged when it was made.
        if is_ended && !now.edge.is_arc() {
            return Ok(());
        }
        let vectors = [plan.before.map_or(self.vector, |before| before.last()), end.first()];
        if !self.doubtful && !is_ended {
            judge_room(&now.edge, [self.radius, radius], &rules.table)
                .and_then(|()| judge(&now.edge, vectors, radius, &rules.table))
                .map_err(|fault| (Which::This, fault))?;
        }
        if now.edge.is_arc() {
            // More than a turn is judged, but for what rounding adds and where nothing is judged.
            plan.sweep = now.edge.sweep_beside(vectors).clamp(-TAU, TAU);
        }
        Ok(())
    }

    /// The end of the element behind a planned one, which must be fit to run before the planned one moves. False if its
    /// end cannot be made: that is its own trouble, the planned one can still be run.
    ///
    /// # Errors
    /// The tool does not fit beside it.
    #[inline]
    pub(crate) fn look_past(
        now: &Beside,
        end: &Join,
        next: &Beside,
        after: &Next,
        rules: &Rules,
        end_of_next: &mut Join,
    ) -> Result<bool, Fault> {
        judge_room(&next.edge, [now.offset.radius, next.offset.radius], &rules.table)?;
        if !end_of(next, after, end_of_next) {
            return Ok(false);
        }
        judge(&next.edge, [end.last(), end_of_next.first()], next.offset.radius, &rules.table)?;
        Ok(true)
    }

    /// Whether the path beside a planned element cuts into one near it that the buffer shows, or into the one before.
    ///
    /// A path that does not run beside its element all the way is not looked at: what it cuts is the control's doing.
    ///
    /// # Errors
    /// The element that would be cut; the planned one stands for the one before it.
    #[inline]
    pub(crate) fn look_about(
        &self,
        now: &Beside,
        plan: &Plan,
        end: &Join,
        (next, after): (&Next, &Next),
        rules: &Rules,
    ) -> Result<(), (Which, Fault)> {
        let radius = now.offset.radius;
        if rules.cut == CompensationCut::Run || plan.starts || self.stopped || self.doubtful || self.radius != radius {
            return Ok(());
        }
        let edge_of = |next: &'_ Next| next.element().filter(|next| next.offset.radius == radius).map(|next| next.edge);
        // An element that leads away from the contour may be cut, as one that leads to it.
        let leads_away = after.kind == NextKind::Ends;
        let (next, after) = (edge_of(next).filter(|_| !leads_away), edge_of(after));
        let before = Some(&self.last).filter(|_| !self.leads);
        let near = Neighbours { before, now: &now.edge, next: next.as_ref(), after: after.as_ref() };
        let Some((which, depth)) = cut(&near, self.vector, end, radius) else { return Ok(()) };
        let which = match which {
            Cut::Before | Cut::Now => Which::This,
            Cut::Next => Which::Next,
            Cut::After => Which::After,
        };
        Err((which, Fault::Cut(depth)))
    }

    /// The planned element is run.
    #[inline]
    pub(crate) fn take(&mut self, now: &Beside, plan: &Plan, end: &Join, next: &Next) {
        self.vector = end.last();
        self.axes = now.offset.axes;
        self.on = true;
        self.radius = now.offset.radius;
        self.doubtful = false;
        self.last = now.edge;
        self.stopped = next.kind == NextKind::Unseen;
        self.leads = plan.starts || self.starts;
        self.starts = plan.starts;
    }

    /// Checking on past an element that was refused: what follows begins square to its end.
    pub(crate) fn pass(&mut self, refused: &Beside) {
        *self = Compensation {
            vector: refused.edge.normal(1, refused.offset.radius),
            axes: refused.offset.axes,
            on: true,
            radius: refused.offset.radius,
            last: refused.edge,
            stopped: true,
            leads: false,
            starts: false,
            doubtful: true,
        };
    }

    /// Round the outside corner at which the block before stopped, by the policy that wants it.
    fn way_round(&self, now: &Beside, restart: CompensationRestart) -> Option<Join> {
        if restart != CompensationRestart::Corner {
            return None;
        }
        let mut join = Join::default();
        let meet = corner::join(&self.last, &now.edge, self.radius, now.offset.round_corners, &mut join);
        if !meet || self.radius * now.offset.radius <= 0.0 || join.corner != Corner::Outside {
            return None;
        }
        if join.first() == self.vector {
            return Some(join);
        }
        // Where the tool stands comes first.
        let mut places = [self.vector; 4];
        let rest = places.iter_mut().skip(1).zip(join.places());
        let count = rest.map(|(slot, place)| *slot = *place).count() + 1;
        Some(Join::through(Corner::Outside, places.get(..count)?))
    }
}

/// The end of an element: where the next one begins, or square to its own end. False if there is none.
fn end_of(now: &Beside, next: &Next, join: &mut Join) -> bool {
    let Beside { edge, offset } = now;
    let Some(next) = next.element() else {
        *join = Join::at(edge.normal(1, offset.radius));
        return true;
    };
    if offset.radius * next.offset.radius >= 0.0 {
        return corner::join(edge, &next.edge, offset.radius, offset.round_corners, join);
    }
    // Over to the other side: along the next line, or to the arc's foot at once.
    let foot = edge.normal(1, offset.radius);
    let other = next.edge.normal(0, next.offset.radius);
    let arcs = edge.is_arc() || next.edge.is_arc();
    *join = if arcs { Join::through(Corner::None, &[foot, other]) } else { Join::at(foot) };
    true
}

/// The end of the block that begins compensation.
fn begin(now: &Beside, next: &Next, start: CompensationStart) -> Join {
    let Beside { edge, offset } = now;
    let Some(next) = next.element() else { return Join::at(edge.normal(1, offset.radius)) };
    let square = Join::at(next.edge.normal(0, offset.radius));
    if start == CompensationStart::Square {
        return square;
    }
    let bend = corner::bend(edge, &next.edge);
    if corner::side_of(&bend, offset.radius) != Corner::Outside {
        return square;
    }
    // Up to a right angle the intersection, whatever the corners are; beyond it as a corner, from its own foot on.
    let join = corner::outside(edge, &next.edge, &bend, offset.radius, offset.round_corners && bend.cos < 0.0);
    if join.round || bend.cos >= 0.0 {
        return join;
    }
    let mut places = [edge.normal(1, offset.radius); 4];
    let rest = places.iter_mut().skip(1).zip(join.places());
    let count = rest.map(|(slot, place)| *slot = *place).count() + 1;
    Join::through(Corner::Outside, places.get(..count).unwrap_or_default())
}
