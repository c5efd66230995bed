//! What a code can mean, on any control: the names under which tables ask for a behaviour.
//!
//! A new meaning is one line here, one file in `meaning/src/` and one arm where that crate chooses by meaning.

macro_rules! meanings {
    ($(#[$doc:meta])* $kind:ident { $($name:ident = $id:literal,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, Debug, Hash)]
        #[allow(missing_docs)] // the name is the field's own term; its row in the table says what it does
        pub enum $kind { $($name,)* }

        impl $kind {
            /// Every meaning with its name in the tables.
            pub const TABLE: &'static [(&'static str, $kind)] = &[$(($id, $kind::$name),)*];
        }
    };
}

meanings! {
    /// What a G code means.
    Meaning {
        Rapid = "rapid",
        RapidWithoutCheck = "rapid-without-check",
        OneSidedPositioning = "one-sided-positioning",
        Linear = "linear",
        ArcClockwise = "arc-clockwise",
        ArcCounterClockwise = "arc-counter-clockwise",
        Dwell = "dwell",
        ExactStop = "exact-stop",
        ExactStopMode = "exact-stop-mode",
        CuttingMode = "cutting-mode",
        TappingMode = "tapping-mode",
        Thread = "thread",
        WriteData = "write-data",
        CircleCutClockwise = "circle-cut-clockwise",
        CircleCutCounterClockwise = "circle-cut-counter-clockwise",
        PlaneXy = "plane-xy",
        PlaneZx = "plane-zx",
        PlaneYz = "plane-yz",
        Inch = "inch",
        Metric = "metric",
        StrokeCheckOn = "stroke-check-on",
        StrokeCheckOff = "stroke-check-off",
        ReferenceCheck = "reference-check",
        ReferenceReturn = "reference-return",
        ReturnFromReference = "return-from-reference",
        OtherReferenceReturn = "other-reference-return",
        Skip = "skip",
        CentringXy = "centring-xy",
        CentringX = "centring-x",
        CentringY = "centring-y",
        CompensationOff = "compensation-off",
        CompensationLeft = "compensation-left",
        CompensationRight = "compensation-right",
        LengthPlus = "length-plus",
        LengthMinus = "length-minus",
        LengthOff = "length-off",
        PositionExtend = "position-extend",
        PositionReduce = "position-reduce",
        PositionDoubleExtend = "position-double-extend",
        PositionDoubleReduce = "position-double-reduce",
        PolarOff = "polar-off",
        PolarOn = "polar-on",
        ScalingOff = "scaling-off",
        ScalingOn = "scaling-on",
        BaseSystem = "base-system",
        WorkSystem = "work-system",
        MachineCoordinates = "machine-coordinates",
        SetCoordinates = "set-coordinates",
        LocalCoordinates = "local-coordinates",
        MacroCall = "macro-call",
        ModalMacroCall = "modal-macro-call",
        ModalMacroOff = "modal-macro-off",
        RotationOn = "rotation-on",
        RotationOff = "rotation-off",
        BoltCircle = "bolt-circle",
        ArcPattern = "arc-pattern",
        LinePattern = "line-pattern",
        CycleOff = "cycle-off",
        HighSpeedPeck = "high-speed-peck",
        LeftTap = "left-tap",
        FineBore = "fine-bore",
        BackBore = "back-bore",
        Drill = "drill",
        Spot = "spot",
        Peck = "peck",
        Tap = "tap",
        BoreFeedOut = "bore-feed-out",
        BoreStopRapidOut = "bore-stop-rapid-out",
        BoreManualOut = "bore-manual-out",
        BoreDwellManualOut = "bore-dwell-manual-out",
        BoreDwellFeedOut = "bore-dwell-feed-out",
        Absolute = "absolute",
        Incremental = "incremental",
        FeedPerMinute = "feed-per-minute",
        FeedPerRevolution = "feed-per-revolution",
        SurfaceSpeedOn = "surface-speed-on",
        SurfaceSpeedOff = "surface-speed-off",
        ReturnInitial = "return-initial",
        ReturnR = "return-r",
        CornerOverride = "corner-override",
        CornerFeed = "corner-feed",
        FormStart = "form-start",
        FormEnd = "form-end",
    }
}

meanings! {
    /// What an M code means to the control itself.
    MMeaning {
        ProgramStop = "program-stop",
        OptionalStop = "optional-stop",
        ProgramEnd = "program-end",
        TapeEnd = "tape-end",
        InterruptOff = "interrupt-off",
        InterruptOn = "interrupt-on",
        BufferingOff = "buffering-off",
        BufferingOn = "buffering-on",
        MirrorOff = "mirror-off",
        MirrorOn = "mirror-on",
        CornerArc = "corner-arc",
        CornerIntersection = "corner-intersection",
        InternalCall = "internal-call",
        SubprogramCall = "subprogram-call",
        SubprogramEnd = "subprogram-end",
    }
}

meanings! {
    /// What stands behind the number of a macro variable.
    VariableMeaning {
        Null = "null",
        Local = "local",
        CommonVolatile = "common-volatile",
        CommonPermanent = "common-permanent",
        InputBit = "input-bit",
        InputWord = "input-word",
        OutputBit = "output-bit",
        OutputWord = "output-word",
        Offset = "offset",
        WorkOriginOfAxis = "work-origin-of-axis",
        WorkOriginOfSystem = "work-origin-of-system",
        UserAlarm = "user-alarm",
        Clock = "clock",
        RunHours = "run-hours",
        BlockControl = "block-control",
        FeedControl = "feed-control",
        GroupCode = "group-code",
        ModalWord = "modal-word",
        BlockEnd = "block-end",
        MachinePosition = "machine-position",
        WorkPosition = "work-position",
        SkipPosition = "skip-position",
        ToolOffset = "tool-offset",
        ServoDeviation = "servo-deviation",
    }
}

meanings! {
    /// What a function of a macro expression does.
    Function {
        Sine = "sine",
        Cosine = "cosine",
        Tangent = "tangent",
        ArcTangent = "arc-tangent",
        ArcSine = "arc-sine",
        ArcCosine = "arc-cosine",
        SquareRoot = "square-root",
        Absolute = "absolute",
        FromBcd = "from-bcd",
        ToBcd = "to-bcd",
        Round = "round",
        Fix = "fix",
        Fup = "fup",
        Logarithm = "logarithm",
        Exponential = "exponential",
    }
}

impl Meaning {
    /// True for movements that stay in force from block to block: positioning, lines, arcs.
    pub const fn is_motion(self) -> bool {
        use Meaning::{ArcClockwise, ArcCounterClockwise, Linear, OneSidedPositioning, Rapid, Thread};
        matches!(self, Rapid | Linear | ArcClockwise | ArcCounterClockwise | OneSidedPositioning | Thread)
    }

    /// True for arcs.
    pub const fn is_arc(self) -> bool {
        matches!(self, Meaning::ArcClockwise | Meaning::ArcCounterClockwise)
    }

    /// True for every canned cycle; its cancellation is none.
    pub const fn is_cycle(self) -> bool {
        use Meaning::{
            BackBore, BoreDwellFeedOut, BoreDwellManualOut, BoreFeedOut, BoreManualOut, BoreStopRapidOut, Drill,
            FineBore, HighSpeedPeck, LeftTap, Peck, Spot, Tap,
        };
        matches!(
            self,
            HighSpeedPeck
                | LeftTap
                | FineBore
                | BackBore
                | Drill
                | Spot
                | Peck
                | Tap
                | BoreFeedOut
                | BoreStopRapidOut
                | BoreManualOut
                | BoreDwellManualOut
                | BoreDwellFeedOut
        )
    }

    /// The multiple of the offset by which a move is lengthened (tool position offset), if that is what it means.
    pub const fn position_offset(self) -> Option<f64> {
        match self {
            Meaning::PositionExtend => Some(1.0),
            Meaning::PositionReduce => Some(-1.0),
            Meaning::PositionDoubleExtend => Some(2.0),
            Meaning::PositionDoubleReduce => Some(-2.0),
            _ => None,
        }
    }

    /// The factor with which the length offset counts, if that is what it means.
    pub const fn length_offset(self) -> Option<f64> {
        match self {
            Meaning::LengthPlus => Some(1.0),
            Meaning::LengthMinus => Some(-1.0),
            Meaning::LengthOff => Some(0.0),
            _ => None,
        }
    }
}
