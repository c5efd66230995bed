//! `integer-feed`: F without a decimal point where its unit is doubtful.
//!
//! What: in feed per revolution `F2` is two least increments (0.002 mm), in inch input a tenth of an inch per minute
//! each or a whole inch, by the control's make and setting.
//! Why: the tool rubs at a thousandth of the feed that was meant, or is driven at ten times it.
//! Do: write the point: `F0.2`, `F10.`
//!
//! Where a parameter makes an integer the value itself, F2 is 2 mm a turn, and 0.002 mm wherever integers count.
//!
//! Silent per revolution where the other reading is out of the question: nobody feeds more than 10 mm a turn, so F200
//! is 0.2 mm. Silent for a one-digit F that calls a stored feed. Said once a program for each of the two units: who writes one F so writes them all so.

use dialect::{InchFeedInteger, Meaning};
use meaning::letter_bit;

use crate::finding::{At, Finding, Found};
use crate::look::{Look, number};
use crate::rules::Rule;

/// A feed above this many mm a revolution is not meant.
const MOST_MM_A_TURN: f64 = 10.0;
const MM_AN_INCH: f64 = 25.4;

/// What has been said.
#[derive(Default)]
pub(crate) struct IntegerFeed {
    said: [bool; 2],
}

impl IntegerFeed {
    pub fn look(&mut self, look: &Look, found: &mut Found) {
        if look.command.wording.plain & letter_bit(b'F') == 0 {
            return;
        }
        let roles = look.control.roles;
        let inch = look.in_force(roles.units) == Some(Meaning::Inch);
        let feed = look.after().feed;
        let [metric, inch_increment, _] = look.control.increments;
        let coarse = if look.fitting.options.input_x10 && !look.command.is_called() { 10 } else { 1 };
        let increment = (if inch { inch_increment } else { metric } * coarse) as f64;
        if feed.per_revolution {
            if look.fitting.parameter_if_any(look.control.whole_units) != 0.0 {
                return self.whole(look, (feed.nanometres, increment), inch, found);
            }
            // The number as written counts increments here; with a point it would count mm or inches.
            let written = feed.nanometres / increment;
            let pointed_mm = if inch { written * MM_AN_INCH } else { written };
            if self.said[0] || pointed_mm > MOST_MM_A_TURN {
                return;
            }
            let unit = if inch { "in/rev" } else { "mm/rev" };
            let here = if inch { feed.nanometres / 1e6 / MM_AN_INCH } else { feed.nanometres / 1e6 };
            self.said[0] = true;
            found.say(Rule::IntegerFeed, &look.command.place, || {
                finding(look, "revolution", format!("{here} {unit}"), format!("{} {unit}", number(written)))
            });
        } else if feed.inch && !self.said[1] {
            self.said[1] = true;
            let here = feed.nanometres / 1e6 / MM_AN_INCH;
            let tenth = look.fitting.policies.inch_feed_integer == InchFeedInteger::Tenth;
            let other = if tenth { here * 10.0 } else { here / 10.0 };
            found.say(Rule::IntegerFeed, &look.command.place, || {
                finding(look, "inch", format!("{} in/min", number(here)), format!("{} in/min", number(other)))
            });
        }
    }

    /// The number as written counts mm or inches here; elsewhere it counts increments, in nanometres.
    fn whole(&mut self, look: &Look, (nanometres, increment): (f64, f64), inch: bool, found: &mut Found) {
        if self.said[0] {
            return;
        }
        self.said[0] = true;
        let (unit, per_unit) = if inch { ("in/rev", 1e6 * MM_AN_INCH) } else { ("mm/rev", 1e6) };
        let here = nanometres / per_unit;
        found.say(Rule::IntegerFeed, &look.command.place, || {
            let other = (here * increment / per_unit * 1e6).round() / 1e6;
            finding(look, "whole", format!("{} {unit}", number(here)), format!("{other} {unit}"))
        });
    }
}

fn finding(look: &Look, shade: &'static str, here: String, other: String) -> Finding {
    Finding::new(Rule::IntegerFeed, shade, look.command, At::Letter(b'F'))
        .labelled(format!("{here} here, not {other}"))
        .with("here", here)
        .with("other", other)
}
