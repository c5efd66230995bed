//! The tool path as a picture: a sheet with a plan and an isometric view, as SVG or PNG.
//!
//! Comes in: strokes (straight or arc) in mm, machine coordinates, with kind, feed and tool; what they run
//! beside; marks; a title.
//! Goes out: one SVG text or one PNG, the same bytes for the same input.
//! Memory is bounded however long the program is: a long path is coarsened to what the sheet can show.
//! Must never know: a program, a control, a file, a clock.

mod arc;
mod beside;
mod canvas;
mod chart;
mod chart_sheet;
mod clip;
mod colour;
mod cover;
mod dash;
mod detail;
mod deviation;
mod drawing;
mod extent;
mod feeds;
mod frame;
mod hole;
mod ink;
mod isometric_axes;
mod kept;
mod label;
mod layers;
mod layout;
mod legend;
mod look;
mod mark;
mod notes;
mod palette;
mod path_data;
mod piece;
mod plan_axes;
mod png;
mod rect;
mod scale;
mod sheet;
mod sign;
mod simplify;
mod stroke;
mod strokes;
mod survey;
mod text;
mod timing;
mod tool;
mod trace;
mod view;

pub use chart::{Chart, ChartAxis};
pub use drawing::{Drawing, Title};
pub use layers::Layer;
pub use look::Look;
pub use mark::{Mark, MarkKind};
pub use png::{PngError, WIDEST_PX, png};
pub use stroke::{Arc, Kind, Plane, Stroke};
pub use timing::Timing;
