//! `barrier-in-compensation`: a block that stops reading ahead while the tool runs beside its path.
//!
//! What: M00, M01, M02 or M30 under G41 or G42 with the tool beside the path. M01 counts with its switch off too.
//! Why: the control reads nothing behind such a block before it is done, so it cannot see the next element: the block
//! before ends square to its own end. At an inside corner the tool then stands in the next element; at an outside one it
//! leads on from there on a straight way, which may cut the corner off.
//! Do: write G40 with a move away from the work first, and G41 or G42 with the way back.
//!
//! Said at the block that stops, with the depth of the cut where the next element shows it. Silent before the first
//! move with G41 or G42 and behind the one with G40: the tool is not beside anything there.

use meaning::{Command, EndKind, Finish, Side};
use path::Curve;

use super::gouge_ahead::LEAST_MM;
use crate::finding::{At, Finding, Found};
use crate::look::{Look, number};
use crate::rules::Rule;
use crate::way::{Turns, Way};

/// The stop that waits for what comes behind it.
#[derive(Default)]
pub(crate) struct BarrierInCompensation {
    /// The tool stands beside the path.
    stands: bool,
    open: Option<Finding>,
}

impl BarrierInCompensation {
    /// A move; true if it is the first one behind a stop.
    #[inline]
    pub fn step(&mut self, (way, turns): (&Way, &Turns), found: &mut Found) -> bool {
        self.stands = true;
        self.open.is_some() && self.lead_on((way, turns), found)
    }

    fn lead_on(&mut self, (way, turns): (&Way, &Turns), found: &mut Found) -> bool {
        let Some(element) = way.element(turns) else { return false };
        let Some(finding) = self.open.take() else { return false };
        let leading = way.centre(turns);
        let standing = Curve::line(leading.from, leading.from);
        let depths =
            [standing, leading].map(|tool| way.radius - tool.approach(&element).0 - tool.slack() - element.slack());
        found.list.push(cut(finding, depths).beside(way.place, "the next element"));
        true
    }

    /// A block is done.
    pub fn look(&mut self, look: &Look, found: &mut Found) {
        let command = look.command;
        let (Some(number), true) = (barrier(command), self.stands && command.side() != Side::Off) else {
            return;
        };
        if !found.is_new(Rule::BarrierInCompensation, &command.place) {
            return;
        }
        self.flush(found);
        let code = look.code_name(look.control.roles.compensation);
        let ends = matches!(command.finish, Finish::End(_));
        let shade = if ends { "end" } else { "" };
        let finding = Finding::new(Rule::BarrierInCompensation, shade, command, At::M(number))
            .with("code", code)
            .labelled(if ends { "the way to here ends square" } else { "nothing behind it is read yet" });
        if ends {
            found.list.push(finding);
        } else {
            self.open = Some(finding);
        }
    }

    /// Nothing more comes that would show a depth.
    pub fn flush(&mut self, found: &mut Found) {
        found.list.extend(self.open.take());
    }

    /// Compensation runs no more.
    pub fn end(&mut self, found: &mut Found) {
        self.flush(found);
        self.stands = false;
    }
}

/// The number of the M code that stops reading.
fn barrier(command: &Command) -> Option<u32> {
    match command.finish {
        Finish::ProgramStop => Some(0),
        Finish::OptionalStop => Some(1),
        Finish::End(EndKind::M02) => Some(2),
        Finish::End(EndKind::M30) => Some(30),
        _ => None,
    }
}

/// Says how deep the tool cuts, standing and on its way from there.
fn cut(mut finding: Finding, [standing, leading]: [f64; 2]) -> Finding {
    let (shade, depth) = if standing > LEAST_MM { ("inside", standing) } else { ("outside", leading) };
    if depth > LEAST_MM {
        finding.shade = shade;
        finding.label = format!("{} mm of the next element are cut", number(depth));
        finding = finding.with("depth", number(depth));
    }
    finding
}
