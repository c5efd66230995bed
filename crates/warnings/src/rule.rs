//! The rules, one file each: what is suspect, why the machine cares, what to do, and when the rule keeps silent.
//!
//! A rule that looks at one block alone is a function and a line in [`BLOCK_RULES`]; one that remembers is a value.

pub(crate) mod allow_unknown;
pub(crate) mod barrier_in_compensation;
pub(crate) mod boring_code_differs;
pub(crate) mod corner_mode_unset;
pub(crate) mod endless;
pub(crate) mod ends_with_offset;
pub(crate) mod g92_moves_meaning;
pub(crate) mod gouge_ahead;
pub(crate) mod inherited_state;
pub(crate) mod integer_coordinate;
pub(crate) mod integer_feed;
pub(crate) mod length_cancel_moves;
pub(crate) mod memory_size;
pub(crate) mod mirror_off_elsewhere;
pub(crate) mod missing_return;
pub(crate) mod offset_unset;
pub(crate) mod one_shot_company;
pub(crate) mod position_offset_absolute;
pub(crate) mod r_above_approach;
pub(crate) mod rapid_down_and_across;
pub(crate) mod reference_via_below;
pub(crate) mod tool_change_moving;
pub(crate) mod unreachable;
pub(crate) mod unused_subprogram;
pub(crate) mod z_above_r;

use crate::finding::Found;
use crate::look::Look;
use crate::rules::Rule;

/// A rule that looks at one block alone.
pub(crate) type BlockRule = fn(&Look, &mut Found);

/// The rules that look at one block alone.
pub(crate) const BLOCK_RULES: &[(Rule, BlockRule)] = &[
    (Rule::LengthCancelMoves, length_cancel_moves::look),
    (Rule::ReferenceViaBelow, reference_via_below::look),
    (Rule::ToolChangeMoving, tool_change_moving::look),
    (Rule::RAboveApproach, r_above_approach::look),
    (Rule::ZAboveR, z_above_r::look),
    (Rule::MirrorOffElsewhere, mirror_off_elsewhere::look),
    (Rule::PositionOffsetAbsolute, position_offset_absolute::look),
];
