//! What holds a block and what would help, in the words of the shop: with numbers, and the word or the key to change.

use meaning::{CodeLine, CodeOut};

use super::Losses;
use super::cause::{Cause, Detail};
use super::top::Block;
use crate::summary::{period, short};

/// A cause that costs less than this part of a block's loss is not told.
const TOLD: f64 = 0.05;

impl Losses {
    /// What holds it.
    pub(super) fn held(&self, block: &Block, causes: &[(Cause, f64)]) -> String {
        let all = block.all();
        let told = causes.iter().filter(|(_, seconds)| *seconds >= TOLD * all);
        let one = causes.iter().filter(|(_, seconds)| *seconds >= TOLD * all).count() == 1;
        let said: Vec<_> = told
            .map(|(cause, seconds)| {
                let what = self.what(*cause, &block.details[*cause as usize]);
                if one { what } else { format!("{what} ({})", period(*seconds)) }
            })
            .collect();
        said.join("; ")
    }

    fn what(&self, cause: Cause, detail: &Detail) -> String {
        let code = detail.code.map_or_else(|| "a code".to_owned(), |code| code.line.word(code.code));
        match cause {
            Cause::ExactStop => format!("exact stop {}", self.exact(detail)),
            Cause::Code => format!("the axes stand for {code}"),
            Cause::BesideRapid => "the axes stand where cutting meets a rapid move".to_owned(),
            Cause::Corner if detail.passed <= 0.0 => format!("stop in a corner of {}", angle(detail.turn)),
            Cause::Corner => {
                format!("corner of {} passed at {} of F{}", angle(detail.turn), feed(detail.passed), feed(detail.asked))
            }
            Cause::Reversal => format!("the way turns back by {}: the axes stand there", angle(detail.turn)),
            Cause::AxisLimit => {
                let axis = self.letter(detail.axis);
                format!("the highest feed of {axis} leaves {} of F{}", feed(detail.allowed), feed(detail.asked))
            }
            Cause::Centripetal => {
                let radius = short(detail.radius);
                format!("an arc of radius {radius} can be run at {} of F{}", feed(detail.allowed), feed(detail.asked))
            }
            Cause::Change if detail.reached >= detail.asked * 0.99 => {
                format!("speed changes between F{} and something slower beside it", feed(detail.asked))
            }
            Cause::Change => {
                let (length, asked) = (short(detail.length), feed(detail.asked));
                format!("{length} mm is too short to reach F{asked} on: {} is reached", feed(detail.reached))
            }
            Cause::Positioning => {
                format!("rapid moves begin and end at rest, {} is the last to arrive", self.letter(detail.axis))
            }
            Cause::Dwell => "dwell".to_owned(),
            Cause::Waiting => format!("waiting for the machine to answer {code}"),
            Cause::Standing => "the axes stand before or behind it: dwell, stop, beginning or end".to_owned(),
            Cause::Asked => "the axes stand until a macro has been told of the machine".to_owned(),
            Cause::Control => format!(
                "the control lags, or has no block ready: F{} asked for, {} reached",
                feed(detail.asked),
                feed(detail.reached)
            ),
        }
    }

    /// What would help.
    pub(super) fn help(&self, cause: Cause, block: &Block) -> String {
        let detail = &block.details[cause as usize];
        let tolerance = short(self.limits.corner_tolerance);
        match cause {
            Cause::ExactStop => {
                let instead = match (detail.axis, &self.exact[2]) {
                    (0, _) | (_, None) => format!("leave out {}", self.exact(detail)),
                    (_, Some(cutting)) => format!("write {cutting} in front of it"),
                };
                format!(
                    "{instead} where the corner need not be sharp: it is then rounded by at most {tolerance} mm ([path] corner_tolerance)"
                )
            }
            Cause::Code => {
                let code = detail.code.map_or_else(|| "the code".to_owned(), |code| code.line.word(code.code));
                format!(
                    "move {code} to a block where the axes stand in any case: beside a rapid move or the tool change"
                )
            }
            Cause::BesideRapid => format!(
                "every lift costs this again: fewer retracts, or longer cuts between them; from rest to F{} takes {} mm",
                feed(detail.allowed),
                self.run_up(detail.allowed)
            ),
            Cause::Corner if self.limits.corner_tolerance <= 0.0 => {
                "a [path] corner_tolerance above 0 in the machine's file lets corners pass without a stop".to_owned()
            }
            Cause::Corner => {
                let acceleration = self.acceleration();
                let radius = detail.allowed * detail.allowed / acceleration;
                format!(
                    "a larger [path] corner_tolerance than {tolerance} mm, a lower F in corners, or an arc of radius {} or more in place of the corner, which F{} can run",
                    short((radius * 100.0).ceil() / 100.0),
                    feed(detail.allowed)
                )
            }
            Cause::Reversal => {
                "go round in one direction in place of to and fro: where the way turns back the axes must stand".to_owned()
            }
            Cause::AxisLimit => {
                let axis = self.letter(detail.axis);
                let most = self.limits.axes.get(usize::from(detail.axis)).map_or(0.0, |axis| axis.max_feed);
                format!(
                    "nothing in the program: [axes.{axis}] max_feed = {} is the machine's; with it F{} is as fast and says what runs",
                    short(most * 60.0),
                    feed(detail.allowed)
                )
            }
            Cause::Centripetal => {
                let axis = self.letter(detail.axis);
                format!(
                    "a larger radius (F{} needs {} mm at [axes.{axis}] acceleration = {}), or F{} here, which costs nothing and keeps the chip even",
                    feed(detail.asked),
                    short((detail.asked * detail.asked / self.acceleration_of(detail.axis) * 100.0).ceil() / 100.0),
                    short(self.acceleration_of(detail.axis)),
                    feed(detail.allowed)
                )
            }
            Cause::Change if detail.reached >= detail.asked * 0.99 => {
                "nothing here: look at the slower blocks before and behind it".to_owned()
            }
            Cause::Change => {
                "longer blocks (a wider chord tolerance in the CAM system, G02/G03 in place of chords): where corners follow closely there is no way to gain speed on".to_owned()
            }
            Cause::Positioning => {
                let axis = usize::from(detail.axis);
                let axis = self.limits.axes.get(axis).map(|limits| (self.letter(detail.axis), limits));
                let Some((letter, limits)) = axis else { return String::new() };
                format!(
                    "fewer or shorter rapid moves (a lower R or retract height, a nearer next hole): at [axes.{letter}] acceleration = {} {letter} needs {} to its rate",
                    short(limits.acceleration),
                    period(limits.rapid / limits.acceleration)
                )
            }
            Cause::Dwell => "a smaller P or X: one turn of the spindle is enough to clean a bottom".to_owned(),
            Cause::Waiting => {
                let Some(code) = detail.code else { return String::new() };
                let file = format!(
                    "by the machine's file {} takes {} ([functions] time, key {}; fin_time where that has none): measure it at the machine",
                    code.line.word(code.code),
                    period(self.times.of(code.line, code.code).0),
                    code_key(code)
                );
                let earlier = "; what need not wait for the motion can go out in a block that moves";
                if code.after_motion { file } else { file + earlier }
            }
            Cause::Standing => "only fewer dwells and stops: the axes must stand there".to_owned(),
            Cause::Control => {
                "longer blocks: each takes [path] block_time to make ready; the rest is time_constant and in-position at stops".to_owned()
            }
            Cause::Asked => "read positions and the clock (#5001…, #3001…) once, in front of the cut".to_owned(),
        }
    }

    fn exact(&self, detail: &Detail) -> &str {
        let name = self.exact.get(usize::from(detail.axis)).and_then(Option::as_deref);
        name.unwrap_or("exact stop")
    }

    fn letter(&self, axis: u8) -> char {
        self.letters.get(usize::from(axis)).copied().unwrap_or('?')
    }

    fn acceleration_of(&self, axis: u8) -> f64 {
        self.limits.axes.get(usize::from(axis)).map_or(f64::INFINITY, |axis| axis.acceleration)
    }

    /// That of the laziest axis, mm/s².
    fn acceleration(&self) -> f64 {
        let axes = self.limits.axes.iter().take(self.limits.count);
        axes.map(|axis| axis.acceleration).fold(f64::INFINITY, f64::min)
    }

    /// The way from rest to a speed, mm.
    fn run_up(&self, speed: f64) -> String {
        short(speed * speed / 2.0 / self.acceleration())
    }
}

/// mm/s as an F.
fn feed(speed: f64) -> String {
    format!("{:.0}", speed * 60.0)
}

/// By how much a way turns.
fn angle(cosine: f64) -> String {
    let degrees = libm::acos(cosine.clamp(-1.0, 1.0)).to_degrees();
    if degrees < 9.95 { format!("{degrees:.1}°") } else { format!("{degrees:.0}°") }
}

/// The key of its time in the machine's file.
fn code_key(code: CodeOut) -> String {
    match code.line {
        CodeLine::S | CodeLine::T => code.line.letter().to_ascii_lowercase().to_string(),
        CodeLine::M | CodeLine::B => format!("{}{}", code.line.letter().to_ascii_lowercase(), code.code),
    }
}
