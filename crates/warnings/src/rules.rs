//! Every warning under one stable name each.
//!
//! Adding one is a line here, a file in `rule/` and a row in `controls/warnings.toml`; a test holds the three together.

macro_rules! rules {
    ($($(#[$doc:meta])* $name:ident = $id:literal,)*) => {
        /// What is legal and dangerous.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
        pub enum Rule { $($(#[$doc])* $name,)* }

        impl Rule {
            /// Every rule, in the order of its declaration.
            pub const ALL: &'static [Rule] = &[$(Rule::$name,)*];

            /// The stable name, as `--deny`, `--allow` and comments spell it.
            pub const fn name(self) -> &'static str {
                match self { $(Rule::$name => $id,)* }
            }
        }
    };
}

rules! {
    /// A coordinate without a decimal point in a program that mostly writes points.
    IntegerCoordinate = "integer-coordinate",
    /// F without a decimal point where its unit is doubtful.
    IntegerFeed = "integer-feed",
    /// A move rests on something that the program never set.
    InheritedState = "inherited-state",
    /// The program run once more does not do the same.
    SecondPiece = "second-piece",
    /// Cancelling the length offset moves the axis.
    LengthCancelMoves = "length-cancel-moves",
    /// The way to the reference point leads down first.
    ReferenceViaBelow = "reference-via-below",
    /// An offset or origin that is named and not set.
    OffsetUnset = "offset-unset",
    /// Rapid downwards and across in one block.
    RapidDownAndAcross = "rapid-down-and-across",
    /// A tool change in a block with motion.
    ToolChangeMoving = "tool-change-moving",
    /// The R level lies above the tool.
    RAboveApproach = "r-above-approach",
    /// The bottom of a hole lies above its R level.
    ZAboveR = "z-above-r",
    /// A boring cycle that means another thing on other controls.
    BoringCodeDiffers = "boring-code-differs",
    /// Mirror image or scale that ends where it makes a difference.
    MirrorOffElsewhere = "mirror-off-elsewhere",
    /// G92, and what the program relies on with it.
    G92MovesMeaning = "g92-moves-meaning",
    /// A displacement of G45 to G48 that is left when an absolute block comes.
    PositionOffsetAbsolute = "position-offset-absolute",
    /// A one-shot code in company that the letter of the manual forbids.
    OneShotCompany = "one-shot-company",
    /// An outside corner, and how to go round it is programmed nowhere.
    CornerModeUnset = "corner-mode-unset",
    /// Reading stops while the tool runs beside its path.
    BarrierInCompensation = "barrier-in-compensation",
    /// The tool beside one element of a contour cuts another one.
    GougeAhead = "gouge-ahead",
    /// The program ends with an offset in force.
    EndsWithOffset = "ends-with-offset",
    /// Blocks that no run can come to.
    Unreachable = "unreachable",
    /// A subprogram that nothing calls.
    UnusedSubprogram = "unused-subprogram",
    /// A program that starts itself again and never stops.
    Endless = "endless",
    /// A comment allows something that no warning is called.
    AllowUnknown = "allow-unknown",
    /// A called program's file ends without M99.
    MissingReturn = "missing-return",
    /// The program is larger than the control's memory.
    MemorySize = "memory-size",
}

impl Rule {
    /// The rule of this name, in any case of letters, as comments on an old control's tape have capitals only.
    pub fn from_name(name: &str) -> Option<Rule> {
        Rule::ALL.iter().copied().find(|rule| rule.name().eq_ignore_ascii_case(name))
    }
}
