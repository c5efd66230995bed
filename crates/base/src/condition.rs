//! Every condition under which a control refuses a block, under one stable name each.
//!
//! A condition says what is wrong, finer than a control's alarm does: many conditions share one alarm.
//! Which alarm a control shows for a condition is data (`controls/NAME/alarms.toml`); the three sentences
//! shown to people are data too (`controls/conditions.toml`). Adding a condition is one line here and one
//! row there; a test holds the two together.

macro_rules! conditions {
    ($($(#[$doc:meta])* $name:ident = $id:literal,)*) => {
        /// What is wrong with a block, independent of the control that found it.
        #[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
        pub enum Condition { $($(#[$doc])* $name,)* }

        impl Condition {
            /// Every condition, in the order of its declaration.
            pub const ALL: &'static [Condition] = &[$(Condition::$name,)*];

            /// The stable name, as `controls/` spells it.
            pub const fn id(self) -> &'static str {
                match self { $(Condition::$name => $id,)* }
            }

            /// The condition of this name, if there is one.
            pub fn from_id(id: &str) -> Option<Condition> {
                match id { $($id => Some(Condition::$name),)* _ => None }
            }
        }
    };
}

conditions! {
    // What cannot be read at all (syntax).
    /// An address letter is followed by no number.
    NumberMissing = "number-missing",
    /// A number stands without an address letter before it.
    AddressMissing = "address-missing",
    /// A sign or a second decimal point stands where none may.
    SignOrPoint = "sign-or-point",
    /// More digits than any number of a program can have (18).
    NumberTooLong = "number-too-long",
    /// A character that no program word contains.
    CharacterUnknown = "character-unknown",
    /// A small letter on a control whose tapes have one case only.
    LowerCase = "lower-case",
    /// A comment is opened but not closed in its block.
    CommentOpen = "comment-open",
    /// A comment is closed that was never opened.
    CommentClose = "comment-close",
    /// A block-delete sign behind words, where it may stand at the head of a block only.
    BlockDeletePlace = "block-delete-place",
    /// An O word behind other words, where it is a label.
    LabelPlace = "label-place",
    /// The block is longer than the control reads. Values: characters allowed.
    BlockTooLong = "block-too-long",
    /// A row of tape whose number of holes is wrong. Values: row, the characters it may have been.
    CharacterParity = "character-parity",
    /// Blank tape inside a program whose code has no blank row.
    TapeBlank = "tape-blank",
    /// A row of tape that is no character of its code. Values: row.
    TapeCodeUnknown = "tape-code-unknown",
    /// A block with an odd number of rows on tape. Values: rows, the end counted.
    BlockParity = "block-parity",
    /// A macro statement that cannot be read.
    MacroStatement = "macro-statement",
    /// A name in an expression that is no function, or ATAN without its second bracket.
    MacroFunction = "macro-function",
    /// Brackets nested deeper than the control follows. Values: brackets allowed.
    MacroBrackets = "macro-brackets",
    /// IF … THEN, which later controls have.
    MacroThen = "macro-then",
    /// A statement beside other words of a block.
    MacroInBlock = "macro-in-block",
    /// Macros are not fitted.
    MacroNotFitted = "macro-not-fitted",
    /// An O or N given by a variable.
    MacroVariableNotHere = "macro-variable-not-here",
    /// No such variable. Values: number.
    MacroVariableUnknown = "macro-variable-unknown",
    /// A write to a variable that can only be read. Values: number.
    MacroReadOnly = "macro-read-only",
    /// A read of a variable that can only be written. Values: number.
    MacroWriteOnly = "macro-write-only",
    /// A division by zero.
    MacroDivisionByZero = "macro-division-by-zero",
    /// A function has no value there. Values: argument.
    MacroArgumentRange = "macro-argument-range",
    /// A result too large for a variable.
    MacroOverflow = "macro-overflow",
    /// A loop's number is not one of the control's. Values: number, highest.
    MacroLoopNumber = "macro-loop-number",
    /// Loops nested too deep. Values: loops allowed.
    MacroLoopDepth = "macro-loop-depth",
    /// DO and END do not pair. Values: number.
    MacroLoopPair = "macro-loop-pair",
    /// GOTO into a loop. Values: block number, line.
    MacroIntoLoop = "macro-into-loop",
    /// A letter that is no argument of a call, or an I J K group too many.
    MacroArgument = "macro-argument",
    /// Macro calls nested too deep. Values: levels allowed.
    MacroNestingTooDeep = "macro-nesting-too-deep",
    /// The program raised an alarm itself (#3000). Values: number.
    MacroUser = "macro-user",

    // Words that the control does not have, or not so.
    /// The address letter means nothing on this control or this machine.
    AddressUnavailable = "address-unavailable",
    /// A decimal point in a word that takes none.
    PointNotAllowed = "point-not-allowed",
    /// The value lies outside the address's range. Values: written, lowest, highest.
    ValueOutOfRange = "value-out-of-range",
    /// More digits than the address takes. Values: digits written, digits allowed.
    DigitsTooMany = "digits-too-many",
    /// A code is too large for the lines that carry it to the machine. Values: code, digits on the lines.
    CodeTooLargeForLines = "code-too-large-for-lines",
    /// The same address twice on a control that refuses it.
    WordRepeated = "word-repeated",

    // Codes.
    /// The control has no such G code. Values: code.
    GUnknown = "g-unknown",
    /// The G code belongs to an option that is not fitted. Values: code.
    GNotFitted = "g-not-fitted",
    /// The control has no such M code. Values: code.
    MUnknown = "m-unknown",
    /// The M code belongs to an option that is not fitted. Values: code.
    MNotFitted = "m-not-fitted",
    /// More than one M code in a block without the option for it.
    MSeveral = "m-several",
    /// Two one-shot G codes in one block.
    OneShotTwice = "one-shot-twice",
    /// A one-shot G code beside (or under) a movement code it may not accompany.
    OneShotWithMotion = "one-shot-with-motion",
    /// A one-shot G code beside any other G code, read by the letter of the manual.
    OneShotCompany = "one-shot-company",
    /// Tool length compensation switched together with, or under, an arc.
    LengthOffsetWithArc = "length-offset-with-arc",
    /// G45 to G48 while a canned cycle is active.
    PositionOffsetInCycle = "position-offset-in-cycle",
    /// G45 to G48 while tool radius compensation is active.
    PositionOffsetInCompensation = "position-offset-in-compensation",
    /// G45 to G48 on an arc given by its radius.
    PositionOffsetArcRadius = "position-offset-arc-radius",
    /// A movement code and a canned cycle in one block.
    CycleWithMotion = "cycle-with-motion",
    /// Two codes of one group in a block.
    GSameGroup = "g-same-group",
    /// More G codes than a block may have.
    GTooMany = "g-too-many",
    /// A state-change code behind the movement code.
    GOrder = "g-order",
    /// Two movement codes in a block.
    GTwoMoves = "g-two-moves",
    /// A code that must be its block's only G code has company.
    GNotAlone = "g-not-alone",
    /// Exact stop without a movement code beside it.
    ExactStopWithoutMovement = "exact-stop-without-movement",
    /// Two codes claim the block's axis words.
    AxisWordsClaimedTwice = "axis-words-claimed-twice",
    /// A code that needs an axis word has none.
    AxisWordMissing = "axis-word-missing",
    /// What the program is in forbids the code: {1} is the G code that says so.
    StateForbids = "state-forbids",
    /// I, J or K beside a straight movement on a control that takes them for the tool's direction, without the option.
    DirectionWithoutOption = "direction-without-option",
    /// The tool's direction is given in two ways.
    DirectionTwice = "direction-twice",
    /// The vector of the tool's direction has no length.
    DirectionZero = "direction-zero",
    /// The vector leaves an angle undecided: the tool stands along the axis about which it turns.
    DirectionUndecided = "direction-undecided",
    /// The code wants the tool upright.
    ToolTilted = "tool-tilted",
    /// The code is known and correct, but this program does not execute it yet.
    NotYetBuilt = "not-yet-built",

    /// A third axis moves in an arc block without the option for helices.
    HelixNotFitted = "helix-not-fitted",

    // Feed, arcs, offsets.
    /// A cutting move and no feed.
    FeedMissing = "feed-missing",
    /// Feed per revolution and spindle speed zero: the axes would wait for ever.
    SpindleSpeedMissing = "spindle-speed-missing",
    /// Feed or dwell per revolution where S is a two-digit code, so that no speed is known.
    SpindleSpeedCoded = "spindle-speed-coded",
    /// A one-digit F under which no feed is stored. Values: digit.
    StoredFeedMissing = "stored-feed-missing",
    /// An arc with neither centre nor radius.
    ArcWithoutCentre = "arc-without-centre",
    /// An arc that starts on its own centre.
    ArcRadiusZero = "arc-radius-zero",
    /// The radius cannot span start and end. Values: radius mm, distance mm.
    ArcRadiusTooSmall = "arc-radius-too-small",
    /// The end is further off the circle than the control allows. Values: off by mm, limit mm.
    ArcEndOff = "arc-end-off",
    /// No such offset number. Values: number, highest number.
    OffsetNumber = "offset-number",
    /// Data written by a program name no such number. Values: number (0 if missing), highest.
    DataNumber = "data-number",
    /// Data of a kind that a program cannot write. Values: kind.
    DataKindUnknown = "data-kind-unknown",
    /// Data to be written lack their value.
    DataValueMissing = "data-value-missing",
    /// An offset or origin would become larger than memory holds. Values: it mm, limit mm.
    OffsetRange = "offset-range",
    /// Circle cutting without the number of a cutter offset.
    CircleOffsetMissing = "circle-offset-missing",
    /// The hole is not larger than the cutter. Values: radius of the hole mm, cutter offset mm.
    CircleTooSmall = "circle-too-small",
    /// Circle cutting while tool radius compensation is active.
    CircleInCompensation = "circle-in-compensation",
    /// A canned cycle or hole pattern while tool radius compensation is active.
    CycleInCompensation = "cycle-in-compensation",
    /// A canned cycle lacks its R or Z level.
    CycleLevelMissing = "cycle-level-missing",
    /// A pecking cycle lacks its depth of cut Q.
    CyclePeckMissing = "cycle-peck-missing",
    /// A boring cycle lacks the shift off the wall.
    CycleShiftMissing = "cycle-shift-missing",
    /// A hole pattern has no holes (L 0, missing, or negative where no direction belongs to it).
    PatternCount = "pattern-count",
    /// A bolt circle's radius I is zero, negative or missing.
    PatternRadius = "pattern-radius",

    // Programs that call one another.
    /// A call or a return names no program or block where it must.
    CallTargetMissing = "call-target-missing",
    /// The called program is nowhere to be found. Values: program number.
    ProgramNotFound = "program-not-found",
    /// There is no file of the called program's name.
    FileNotFound = "file-not-found",
    /// A program's name has a character that no name has.
    ProgramName = "program-name",
    /// A call writes the ending of a program's file where none may be written.
    ProgramEnding = "program-ending",
    /// A call by name shares its block with another word.
    CallNotAlone = "call-not-alone",
    /// A program called by its full file name calls another.
    CallFromLarge = "call-from-large",
    /// The sequence number to go to does not stand in the program. Values: number.
    SequenceNotFound = "sequence-not-found",
    /// Subprograms call one another too deep. Values: levels allowed.
    NestingTooDeep = "nesting-too-deep",
    /// A loop runs on without motion, dwell or stop. Values: jumps or statements counted, first line, last line.
    EndlessLoop = "endless-loop",

    // Reference points.
    /// An axis that has not been returned to its reference point since power-on.
    ReferenceNotDone = "reference-not-done",
    /// G27 does not end on the reference point. Values: where it ends, the reference point.
    ReferenceNotReached = "reference-not-reached",
    /// G27 while an offset is in force.
    ReferenceCheckWithOffset = "reference-check-with-offset",
    /// G29 on an axis without an intermediate point.
    IntermediatePointMissing = "intermediate-point-missing",

    // The skip signal.
    /// A move under tool radius compensation that goes a way of its own: from one side, or with the tool tilting.
    WayInCompensation = "way-in-compensation",
    /// An arc would begin tool radius compensation.
    ArcStartsCompensation = "arc-starts-compensation",
    /// An arc would end tool radius compensation.
    ArcEndsCompensation = "arc-ends-compensation",
    /// Another plane while tool radius compensation is active.
    PlaneInCompensation = "plane-in-compensation",
    /// G28, G30 or G53 while tool radius compensation is active, on a control that refuses it. Values: the code.
    MachinePlaceInCompensation = "machine-place-in-compensation",
    /// An arc whose inside the tool does not fit into. Values: the arc's radius, the tool's radius.
    InnerArcTooSmall = "inner-arc-too-small",
    /// The tool's centre would run an element backwards. Values: by how much, the tool's radius.
    CompensatedPathReversed = "compensated-path-reversed",
    /// The tool's centre would not close a full circle. Values: the gap.
    CompensatedCircleOpen = "compensated-circle-open",
    /// The tool's centre would go more than once round. Values: by how much, the tool's radius.
    CompensatedCircleOverlaps = "compensated-circle-overlaps",
    /// The tool's paths along two elements do not meet inside their corner. Values: the tool's radius.
    CompensatedPathsApart = "compensated-paths-apart",
    /// Beside an element near this one the tool would cut into it. Values: by how much, the tool's radius.
    ElementCut = "element-cut",
    /// G31, or centring, while tool radius compensation is active.
    SkipInCompensation = "skip-in-compensation",
    /// A skip move went to its end without the signal.
    SkipSignalMissing = "skip-signal-missing",
    /// Centring found no wall within its distance.
    CentringSignalMissing = "centring-signal-missing",
    /// Centring without the distance within which the walls are.
    CentringLimitMissing = "centring-limit-missing",

    // Scaling.
    /// G51 without its factor P.
    ScalingFactorMissing = "scaling-factor-missing",
    /// G50 or G51 beside another G code, or G50 beside a way to go.
    ScalingNotAlone = "scaling-not-alone",
    /// G50 or G51 while tool radius compensation is on.
    ScalingInCompensation = "scaling-in-compensation",

    // The operator's buttons.
    /// The emergency stop button is pressed.
    EmergencyStop = "emergency-stop",
    /// No more programs can be registered. Values: programs allowed.
    MemoryFull = "memory-full",
    /// A program that is protected is to be loaded. Values: its number.
    ProgramProtected = "program-protected",

    // The machine.
    /// The machine has not answered a code. Values: its letter and number, the time waited.
    FinMissing = "fin-missing",
    /// The machine has answered a code before its strobe. Values: its letter and number.
    FinEarly = "fin-early",
    /// The machine does not take its answer back. Values: the code's letter and number, the time waited.
    FinStuck = "fin-stuck",
    /// A step of the builder's logic has waited too long. Values: the code's letter and number, what for.
    LogicTimeOut = "logic-time-out",
    /// A code names no position of what it is to turn. Values: its letter and number.
    LogicPositionMissing = "logic-position-missing",
    /// An axis has run onto its overtravel switch. Values: where that is.
    LimitSwitchReached = "limit-switch-reached",
    /// The drive of an axis has failed.
    ServoFault = "servo-fault",
    /// The spindle has not reached its speed in time. Values: the speed asked for, the one it has.
    SpindleTooSlow = "spindle-too-slow",
    /// The power has failed while a program ran. Values: its line.
    PowerFailed = "power-failed",
    /// The move leaves the axis' travel. Values: where it would go, lower limit, upper limit.
    TravelExceeded = "travel-exceeded",
    /// The move enters the forbidden box of the second stored stroke. Values: where, along X, Y, Z.
    StrokeAreaEntered = "stroke-area-entered",
    /// The move leaves the box to which the second stored stroke keeps the axes. Values: where it would go, the box.
    StrokeAreaLeft = "stroke-area-left",
    /// An upper face of the stroke box is not above the lower one. Values: upper, lower.
    StrokeBoxOrder = "stroke-box-order",
    /// The first box of a program lacks a face.
    StrokeBoxIncomplete = "stroke-box-incomplete",
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_id_leads_back_to_its_condition() {
        for &condition in Condition::ALL {
            assert_eq!(Condition::from_id(condition.id()), Some(condition));
        }
        assert_eq!(Condition::from_id("no such thing"), None);
    }
}
