//! What each fuzz target checks of the bytes that it is given, a module each.
//!
//! Nothing here needs a fuzzer, so that `tests/seeds.rs` replays the seeds of every target through the same code.

pub mod grammar;
pub mod journal;
pub mod model_reader;
pub mod pen_descriptor;
pub mod pen_families;
pub mod pen_recording;
pub mod sketch;
pub mod species;
