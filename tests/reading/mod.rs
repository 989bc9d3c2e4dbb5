//! Reading and writing drawings: every bad input ends in a message, every good one in the same sketch again.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking, as tests do")]

mod faults;
mod json;
mod svg;

use penstemon::sketch::{Sketch, SketchError, Warning, from_bytes};

/// Reads text under the file name `drawing`.
fn read(text: &str) -> Result<(Sketch, Vec<Warning>), SketchError> {
    let result = from_bytes(text.as_bytes(), "drawing");
    if let Ok((sketch, _)) = &result {
        sketch.check_invariants().unwrap();
    }
    result
}

/// A sketch file with these strokes.
fn with_strokes(strokes: &str) -> String {
    format!(r#"{{"format": "penstemon-sketch", "version": 1, "strokes": [{strokes}]}}"#)
}

/// A sketch file with this one list of points.
fn with_points(points: &str) -> String {
    with_strokes(&format!(r#"{{"points": {points}}}"#))
}
