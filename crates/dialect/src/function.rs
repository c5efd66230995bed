//! How functions are carried out whose form differs from control to control: canned cycles, work origins, reference
//! points, data that a program writes. Each is a table of `control.toml`.

use crate::meaning::Meaning;

/// The most steps of a cycle.
pub const MOST_STEPS: usize = 14;

macro_rules! steps {
    ($($(#[$doc:meta])* $name:ident = $word:literal,)*) => {
        /// A step of a canned cycle.
        #[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
        pub enum CycleStep {
            /// The hole is done.
            #[default]
            Done,
            $($(#[$doc])* $name,)*
        }

        impl CycleStep {
            /// Every step by its name in the tables.
            pub const TABLE: &'static [(&'static str, CycleStep)] = &[$(($word, CycleStep::$name),)*];
        }
    };
}

steps! {
    /// Feed to the bottom.
    FeedBottom = "feed bottom",
    /// Feed to the R level.
    FeedR = "feed r",
    /// Feed to the bottom, the tap cutting.
    TapBottom = "tap bottom",
    /// Feed to the R level, the tap in the hole.
    TapR = "tap r",
    /// Rapid to the R level.
    RapidR = "rapid r",
    /// Rapid to the initial or the R level, as the return code says.
    RapidEnd = "rapid end",
    /// Cuts of Q to the bottom; between two of them out to R and back to the clearance above the last depth.
    DeepPecks = "deep pecks",
    /// Cuts of Q to the bottom; between two of them back by the clearance.
    ChipPecks = "chip pecks",
    /// Wait for the time P.
    Dwell = "dwell",
    /// The spindle turns clockwise, if it does not already.
    StartForward = "start forward",
    /// The spindle turns counter-clockwise, if it does not already.
    StartReverse = "start reverse",
    /// The spindle is sent clockwise.
    Forward = "forward",
    /// The spindle is sent counter-clockwise.
    Reverse = "reverse",
    /// The spindle stops.
    Stop = "stop",
    /// The spindle stops at its fixed angle.
    Orient = "orient",
    /// The spindle turns as it turned before.
    Restart = "restart",
    /// Rapid aside, off the wall of the hole.
    Aside = "aside",
    /// Rapid back over the hole.
    Back = "back",
    /// A stop where the tool leaves by the operator's hand.
    ByHand = "by hand",
}

/// The steps of one cycle behind its first approach, in their order; the rest is done.
pub type CycleSteps = [CycleStep; MOST_STEPS];

/// How a control carries out its canned cycles.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct CycleTable {
    /// The steps of each cycle.
    pub steps: Vec<(Meaning, CycleSteps)>,
    /// The letters that repeat a hole; the first that stands in the block counts.
    pub repeats: Vec<u8>,
    /// I and J shift the tool off the wall, where Q alone does not.
    pub shifts_by_ij: bool,
}

impl CycleTable {
    /// The steps of a cycle.
    pub fn steps_of(&self, cycle: Meaning) -> CycleSteps {
        self.steps.iter().find(|(meaning, _)| *meaning == cycle).map_or_else(Default::default, |(_, steps)| *steps)
    }

    /// True if the cycle cuts in pecks of Q.
    pub fn pecks(&self, cycle: Meaning) -> bool {
        let pecks = |step: &CycleStep| matches!(step, CycleStep::DeepPecks | CycleStep::ChipPecks);
        self.steps_of(cycle).iter().any(pecks)
    }

    /// True if the cycle shifts the tool off the wall.
    pub fn shifts(&self, cycle: Meaning) -> bool {
        self.steps_of(cycle).contains(&CycleStep::Aside)
    }
}

/// How work coordinates come about.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct WorkRules {
    /// G92 shifts every system alike by a shift of its own, which it takes back without words.
    pub shifts_all: bool,
    /// An origin is stored that counts in every system.
    pub external: bool,
}

/// The conditions of the reference points.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct ReferenceRules {
    /// Going there, checking and coming back want an axis word.
    pub wants_axis: bool,
    /// Going there drops the length offset until the next movement of its axis.
    pub drops_length: bool,
    /// The check compares places, whatever offset is in force.
    pub checks_places: bool,
    /// Index of the parameter by which (0) every axis must have been returned before a program does anything; without
    /// one an axis must have been before it moves.
    pub before_start: Option<usize>,
}

/// What a program can write into memory (G10).
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct DataKinds {
    /// The letters that say which kind.
    pub letters: Vec<u8>,
    /// Work origins.
    pub work: i64,
    /// Tool lengths, the kind that is also meant without a letter.
    pub length: Option<i64>,
    /// Tool radii.
    pub radius: Option<i64>,
}

/// What a control makes of tool radius compensation where others do otherwise.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct CompensationRules {
    /// G28 to G30 and G53 are refused; otherwise they drop the offset until the next movement in the plane.
    pub refuses_machine_places: bool,
    /// An arc whose inside is as large as the tool is refused too, not only a smaller one.
    pub refuses_equal_arc: bool,
    /// A full circle must close on the tool's path too.
    pub circles_close: bool,
}

/// The functions whose form is a control's own.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Functions {
    /// Canned cycles.
    pub cycle: CycleTable,
    /// Work coordinates.
    pub work: WorkRules,
    /// Reference points.
    pub reference: ReferenceRules,
    /// Data that a program writes.
    pub data: DataKinds,
    /// Tool radius compensation.
    pub compensation: CompensationRules,
    /// The corners of the stroke box stand in any order.
    pub any_corners: bool,
}
