//! Lists of strokes by their ids, of bounded length.

use crate::sketch::{StrokeId, limits};
use serde::Deserialize;
use serde::de::{Deserializer, Error, SeqAccess, Visitor};
use std::fmt;

/// Names of strokes, no more of them than all corrections, or all shapes of petals, may have together.
pub(super) struct Names(pub(super) Vec<StrokeId>);

impl<'de> Deserialize<'de> for Names {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(NamesVisitor)
    }
}

struct NamesVisitor;

impl<'de> Visitor<'de> for NamesVisitor {
    type Value = Names;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of ids of strokes")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let mut names = Vec::new();
        while let Some(name) = seq.next_element()? {
            if names.len() == limits::MAX_CORRECTED_STROKES {
                let most = limits::MAX_CORRECTED_STROKES;
                return Err(A::Error::custom(format!("a list names at most {most} strokes; leave some out")));
            }
            names.push(name);
        }
        Ok(Names(names))
    }
}
