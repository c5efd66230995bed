//! Events and diagnostics as text: the trace, the summary, the faces of a diagnostic, a control's table.
//!
//! Comes in: events and diagnostics as values. Goes out: text in a buffer. Must never know: where it is printed.

mod control_table;
mod coverage;
mod cycle_time;
mod excerpt;
mod explain;
mod face;
mod house_style;
mod json;
mod losses;
mod paint;
mod remarks;
mod sheet;
mod side_by_side;
mod summary;
mod trace;

pub use control_table::{control_list, control_table};
pub use coverage::{CoveredRow, CoveringCase, coverage, rows_of};
pub use cycle_time::{Naming, Split, time_text};
pub use excerpt::Excerpt;
pub use explain::{Explanation, Wanted, Watch, Watched, explain, explanation_json, explanation_text};
pub use face::{Format, Rules, begin, end, render, render_with_labels, separator};
pub use house_style::{Formatted, HouseStyle, Numbering, house_style};
pub use json::{JsonLine, push_number};
pub use losses::{Cause, Loss, Losses, why_text};
pub use paint::Paint;
pub use sheet::{Sheet, ToolSheet, sheet_html, sheet_json, sheet_text};
pub use side_by_side::{
    Comparison, Deviation, Difference, Limits, compare, comparison_json, comparison_text, same_run,
};
pub use summary::Summary;
pub use trace::Tracer;
