//! How a control reads the words of the codes that scale, mirror and rotate.

/// Which axes scaling changes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ScaledAxes {
    /// Every axis that does not turn.
    Linear,
    /// X, Y and Z.
    Xyz,
}

/// What 1 in a ratio without a point is worth.
#[derive(Clone, PartialEq, Debug)]
pub enum RatioUnit {
    /// Always this; a point may not be written.
    Fixed(f64),
    /// One of these, by a parameter; a ratio with a point is the value itself.
    Parameter(usize, Vec<f64>),
}

/// The words of the code that turns scaling on.
#[derive(Clone, PartialEq, Debug)]
pub struct ScalingRule {
    /// Letter of the ratio of all axes.
    pub ratio: u8,
    /// Letters of the ratios of X, Y and Z alone, where there are any.
    pub ratios: Option<[u8; 3]>,
    /// The worth of 1.
    pub unit: RatioUnit,
    /// Index of the parameter that holds the ratio where none is written; `None` refuses the block.
    pub left_out: Option<usize>,
    /// A negative ratio of one axis mirrors it.
    pub negative_mirrors: bool,
    /// Scaling is neither turned on nor off in tool radius compensation.
    pub not_in_compensation: bool,
    /// The axes.
    pub axes: ScaledAxes,
    /// Letters that may stand for the centre in place of X, Y and Z.
    pub older_centre: Option<[u8; 3]>,
    /// In incremental mode the centre counts from the present position.
    pub centre_by_distance: bool,
}

/// The words of the code that turns rotation on. The centre counts from the present position in incremental mode.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct RotationRule {
    /// Letter of the angle.
    pub angle: u8,
    /// Largest angle, degrees, plus or minus.
    pub most_deg: f64,
    /// Index of the parameter with which an angle in incremental mode is added to the one before, if it is 1.
    pub adds_up: Option<usize>,
}
