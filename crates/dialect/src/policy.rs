//! Policies and options that the stages ask for, resolved once from the control's tables.
//!
//! A policy names a behaviour on which a maker's text is silent. The tables list every policy with its values,
//! default, certainty and source; this file gives those that code reads a type. A control whose tables lack a
//! policy or an option behaves as the first value here says, or has the function without any option.

macro_rules! policies {
    ($($(#[$doc:meta])* $field:ident: $kind:ident = $name:literal {
        $(#[$fdoc:meta])* $first:ident = $fword:literal, $($(#[$vdoc:meta])* $value:ident = $word:literal,)*
    })*) => {
        $($(#[$doc])* #[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
        pub enum $kind { #[default] $(#[$fdoc])* $first, $($(#[$vdoc])* $value,)* })*

        /// Every policy that code reads, as set for one machine.
        #[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
        pub struct Policies { $($(#[$doc])* pub $field: $kind,)* }

        impl Policies {
            /// Sets a policy by its names in the tables; names that no code reads yet change nothing.
            pub(crate) fn set(&mut self, policy: &str, value: &str) {
                match (policy, value) {
                    $(($name, $fword) => self.$field = $kind::$first,
                    $(($name, $word) => self.$field = $kind::$value,)*)*
                    _ => {}
                }
            }
        }

        /// Every policy that code reads, with its values.
        pub(crate) const KNOWN: &[(&str, &[&str])] = &[$(($name, &[$fword, $($word,)*]),)*];
    };
}

policies! {
    /// Which G codes may stand beside a one-shot code.
    one_shot_company: OneShotCompany = "one-shot-company" {
        /// Modal codes of every group but the movements.
        Practical = "practical",
        /// None, by the letter of the manual.
        Literal = "literal",
        /// Any modal code.
        Lenient = "lenient",
    }
    /// What a movement code and a canned cycle in one block are.
    cycle_with_motion: CycleWithMotion = "cycle-with-group-01" {
        /// Refused.
        Refuse = "refuse",
        /// The later of the two counts.
        LaterWins = "later-wins",
    }
    /// Whether a cycle block with L0 positions.
    cycle_l0_moves: CycleL0Moves = "cycle-l0-moves" {
        /// It only stores data.
        No = "no",
        /// It goes to X Y without a hole.
        Yes = "yes",
    }
    /// How the tool leaves the hole in G87.
    g87_return: G87Return = "g87-return" {
        /// At rapid, by itself.
        Rapid = "rapid",
        /// The control stops for the operator's hand and goes on at CYCLE START.
        Manual = "manual",
    }
    /// Which way a boring cycle starts the spindle again if the program never started it.
    cycle_spindle_unknown: CycleSpindleUnknown = "cycle-spindle-unknown" {
        /// Forward.
        Forward = "forward",
        /// Not at all.
        None = "none",
    }
    /// What a canned cycle or hole pattern under G41 or G42 is.
    cycle_in_compensation: CycleInCompensation = "cycle-in-compensation" {
        /// Refused.
        Refuse = "refuse",
        /// Made at the programmed places, without compensation.
        Ignore = "ignore",
    }
    /// How the block that begins tool radius compensation ends.
    compensation_start: CompensationStart = "compensation-start" {
        /// Square to the next path at its start.
        Square = "a",
        /// At an outside corner as the corner itself would be gone round.
        Corner = "b",
    }
    /// How outside corners are gone round before a program has said it by M96 or M97.
    corner_mode: CornerMode = "corner-mode" {
        /// Through the intersection, as M97.
        Intersection = "intersection",
        /// On an arc, as M96.
        Arc = "arc",
    }
    /// What becomes of a path that cuts into an element near its own, where no element is run backwards.
    compensation_cut: CompensationCut = "compensation-cut" {
        /// It is run.
        Run = "run",
        /// It is refused before it moves.
        Refuse = "refuse",
    }
    /// How a path is taken up again where the tool has stopped square to the path before.
    compensation_restart: CompensationRestart = "compensation-restart" {
        /// Straight from where the tool stands to the end of the block.
        Direct = "direct",
        /// First round an outside corner, as without the stop.
        Corner = "corner",
    }
    /// What becomes of a displacement by G45 to G48 in the next absolute block.
    position_offset_absolute: PositionOffsetAbsolute = "position-offset-absolute" {
        /// The block goes to its programmed point.
        Dropped = "dropped",
        /// The displacement is added until the opposite code takes it back.
        Kept = "kept",
    }
    /// Which letter selects the value for G45 to G48.
    position_offset_letter: PositionOffsetLetter = "position-offset-letter" {
        /// D alone.
        D = "d",
        /// D, or H where no D stands in the block.
        DOrH = "d-or-h",
    }
    /// What G45 to G48 do to an arc given by its radius.
    position_offset_arc_radius: PositionOffsetArcRadius = "position-offset-arc-radius" {
        /// Refused: the text speaks of I, J, K only.
        Refuse = "refuse",
        /// The radius stays as written.
        Unchanged = "unchanged",
    }
    /// Whether M01 with its switch off is sent to the machine.
    m01_off_output: M01OffOutput = "m01-off-output" {
        /// No.
        None = "none",
        /// The code goes out, the control does not stop.
        Code = "code",
    }
    /// What a plain F counts in inch input.
    inch_feed_integer: InchFeedInteger = "inch-feed-integer" {
        /// 0.1 in/min.
        Tenth = "0.1",
        /// 1 in/min.
        One = "1",
    }
    /// What G92 sets.
    g92_system: G92System = "g92-system" {
        /// The base system, which it selects.
        Base = "base",
        /// All systems shift together.
        All = "all",
    }
    /// What an arc with neither centre nor radius is.
    arc_without_centre: ArcWithoutCentre = "arc-without-centre" {
        /// An alarm.
        Alarm = "alarm",
        /// A straight cut.
        StraightLine = "straight-line",
    }
    /// What an M code above 99 is on a two-digit interface.
    m_over_99: MOver99 = "m-over-99" {
        /// An alarm.
        Alarm = "alarm",
        /// The hundreds are dropped.
        DropHundreds = "drop-hundreds",
    }
    /// When a changed length offset moves its axis, if no word of that axis stands in the block.
    length_without_z: LengthWithoutZ = "length-offset-without-z" {
        /// In the block that changes it.
        AtOnce = "at-once",
        /// With the next movement of the axis.
        NextZ = "next-z",
    }
    /// What a skip move is that ends without the signal.
    skip_without_signal: SkipWithoutSignal = "skip-without-signal" {
        /// It goes to its end point.
        EndPoint = "end-point",
        /// It goes there and alarms.
        Alarm = "alarm",
    }
    /// What may stand beside G50 and G51.
    scaling_company: ScalingCompany = "scaling-company" {
        /// No other G code, and no way to go beside G50.
        Alone = "alone",
        /// Anything.
        Any = "any",
    }
    /// Whether scaling changes the Z levels of boring cycles with a shift.
    scaling_bore_levels: ScalingBoreLevels = "scaling-bore-levels" {
        /// No.
        Unscaled = "unscaled",
        /// As those of every other cycle.
        Scaled = "scaled",
    }
    /// What a negative ratio of one axis says of its size.
    scaling_negative_ratio: ScalingNegativeRatio = "scaling-negative-ratio" {
        /// Its own amount is the ratio.
        Amount = "amount",
        /// The ratio is that of the parameter for ratios left out.
        Parameter = "parameter",
    }
    /// A direction of the tool that leaves the angle of an axis undecided.
    tip_singularity: TipSingularity = "tip-singularity" {
        /// The axis stays where it is.
        Keep = "keep",
        /// The block is refused.
        Refuse = "refuse",
    }
    /// From where distances count, and a turned axis without a word, when scale or rotation has just changed.
    programmed_position: ProgrammedPosition = "programmed-position" {
        /// From the program's name, under the new transform, of the place where the axes stand.
        FromMachine = "from-machine",
        /// From the coordinates programmed last.
        Kept = "kept",
    }
    /// Whether scale, mirror and rotation change the intermediate point of a return to a reference point.
    reference_via: ReferenceVia = "reference-via" {
        /// As every point.
        Transformed = "transformed",
        /// No.
        AsWritten = "as-written",
    }
    /// When a move out of the travel is found.
    stroke_check: StrokeCheck = "stroke-check" {
        /// Before the move begins.
        BeforeBlock = "before-block",
        /// At the border.
        AtBorder = "at-border",
    }
    /// What G20 and G21 do with stored offsets.
    unit_change_offsets: UnitChangeOffsets = "unit-change-offsets" {
        /// They keep their length.
        Convert = "convert",
        /// They keep their digits: a count of least increments.
        Keep = "keep",
    }
    /// What P of a dwell counts when a variable gives it.
    dwell_variable: DwellVariable = "dwell-variable" {
        /// Seconds, as if it were written with a point.
        Seconds = "seconds",
        /// Milliseconds, as if it were written without one.
        Milliseconds = "milliseconds",
    }
    /// Where RESET leaves the program.
    reset_pointer: ResetPointer = "reset-pointer" {
        /// At the block after the one being executed.
        Stays = "stays",
        /// At the head of the main program.
        Head = "head",
    }
    /// What wants every axis returned to its reference point, on a control without a parameter for it.
    reference_first: ReferenceFirst = "reference-first" {
        /// A move of the axis, but by G28.
        Moves = "moves",
        /// Any block of a program.
        Start = "start",
    }
    /// Where the rest of a move leads before which axes have been moved by hand and counted.
    intervention: Intervention = "intervention" {
        /// Beside its end by as much: the way that was left is made.
        Beside = "beside",
        /// To its programmed end; of an arc beside it.
        ToTheEnd = "to-the-end",
    }
    /// What touching off writes as the length of a tool.
    touch_off: TouchOff = "touch-off" {
        /// The UNIVERSAL (relative) display.
        Relative = "relative",
        /// The place in the work system in force, no length offset taken off.
        Work = "work",
        /// The place on the machine.
        Machine = "machine",
    }
    /// How the axes go to where a program is taken up in its middle.
    restart_approach: RestartApproach = "restart-approach" {
        /// The tool goes off the work first, and down last.
        Retract = "retract",
        /// Axis after axis from where they stand, the tool's axis last.
        Direct = "direct",
    }
    /// Whether calls and macros may be typed in MDI.
    mdi_calls: MdiCalls = "mdi-calls" {
        /// They are refused.
        Refuse = "refuse",
        /// They are taken.
        Allow = "allow",
    }
    /// What a call with L0 does.
    call_l0: CallL0 = "call-l0" {
        /// It is refused.
        Refuse = "refuse",
        /// Nothing: the program is not run.
        NotRun = "not-run",
    }
    /// What the end of a subprogram's text before its M99 is.
    subprogram_text_end: SubprogramTextEnd = "subprogram-text-end" {
        /// The end of the run.
        End = "end",
        /// The way back, as M99.
        Return = "return",
    }
    /// What a call out of a large program is.
    call_from_large: CallFromLarge = "call-from-large" {
        /// Refused.
        Refuse = "refuse",
        /// Taken, as out of any other.
        Allow = "allow",
    }
    /// Whether F survives a change between feed per minute and per revolution.
    feed_mode_change: FeedModeChange = "feed-mode-change" {
        /// A new F must be programmed.
        NeedsF = "needs-f",
        /// The number stays and takes the new unit.
        KeepsNumber = "keeps-number",
    }
}

/// Options that change what ordinary words mean: a control that does not list them does without.
const NEW_MEANINGS: &[&str] = &["one-digit-feed", "input-x10", "tool-tip"];

macro_rules! options {
    ($($(#[$doc:meta])* $field:ident = $name:literal,)*) => {
        /// Every option that code asks for, fitted or not. An option that a control does not list is part of it.
        #[derive(Clone, Copy, PartialEq, Eq, Debug)]
        pub struct Options { $($(#[$doc])* pub $field: bool,)* }

        impl Default for Options {
            fn default() -> Self {
                let mut options = Options { $($field: true,)* };
                for name in NEW_MEANINGS {
                    options.set(name, false);
                }
                options
            }
        }

        impl Options {
            pub(crate) fn set(&mut self, name: &str, fitted: bool) {
                match name { $($name => self.$field = fitted,)* _ => {} }
            }
        }

        /// Every option that code asks for by its name.
        pub(crate) const ASKED: &[&str] = &[$($name,)*];
    };
}

options! {
    /// The third axis in an arc block.
    helical = "helical",
    /// X as the time of a dwell.
    dwell_x = "dwell-x",
    /// More than one M code in a block.
    several_m_codes = "several-m-codes",
    /// M codes of three digits on the lines.
    m_three_digits = "m-three-digits",
    /// Block-delete switches 2 to 9.
    block_delete_2_9 = "block-delete-2-9",
    /// B is the code of an index table.
    b_function = "b-function",
    /// M90 and M91.
    program_interrupt = "program-interrupt",
    /// M98 with P and the number of a program, where programs are called by name.
    number_form_call = "number-form-call",
    /// Calls of a part of the same program.
    internal_call = "internal-call",
    /// User macros.
    user_macro = "user-macro",
    /// F0 is rapid, F1 to F9 call stored feeds.
    one_digit_feed = "one-digit-feed",
    /// Least increments of program words ten times as large.
    input_x10 = "input-x10",
    /// X, Y and Z of straight movements are the tip of the tool.
    tool_tip = "tool-tip",
    /// S is the spindle speed in rev/min, not a two-digit code.
    spindle_rpm = "spindle-rpm",
}
