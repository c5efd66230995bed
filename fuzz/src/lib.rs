//! What the fuzz targets have in common with the property tests: the same assertions on the same stages.

#[path = "../../crates/syntax/tests/reading/mod.rs"]
pub mod reading;
#[path = "../../crates/tape/tests/tapes/mod.rs"]
pub mod tapes;
#[path = "../../crates/station/tests/watch/mod.rs"]
pub mod watch;
