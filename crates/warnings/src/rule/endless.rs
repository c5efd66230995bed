//! `endless`: the program starts itself again and never stops.
//!
//! What: M99 in the main program leads back into it, and no M00 or M01 stands on the way.
//! Why: the machine goes on to the next piece at once, whether or not one is in the vice.
//! Do: write M00 where the piece is changed, M30 at the end of a program that is to run once; where a bar feeder or
//! pallet changer brings the next piece, say `(allow: endless)` in the block.
//!
//! Silent where the run has called no tool and started no spindle: a subprogram, looked at alone, ends with M99 too.

use meaning::{CodeLine, EndKind, Finish};

use crate::finding::{At, Finding, Found};
use crate::look::Look;
use crate::rules::Rule;

/// What has been met on the way.
#[derive(Default)]
pub(crate) struct Endless {
    stops: bool,
    works: bool,
}

impl Endless {
    pub fn look(&mut self, look: &Look) {
        self.stops |= matches!(look.command.finish, Finish::ProgramStop | Finish::OptionalStop);
        self.works |= look.command.sent().iter().any(|code| matches!(code.line, CodeLine::S | CodeLine::T));
    }

    pub fn end(&self, look: &Look, kind: EndKind, found: &mut Found) {
        if kind == EndKind::M99 && self.works && !self.stops {
            let code = look.control.m_of(dialect::MMeaning::SubprogramEnd).map_or(0, |row| u32::from(row.code));
            found.say(Rule::Endless, &look.command.place, || {
                Finding::new(Rule::Endless, "", look.command, At::M(code)).labelled("runs on from here for ever")
            });
        }
    }
}
