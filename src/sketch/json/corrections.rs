//! The `corrections` of a drawing: what the artist says of how strokes are read together, each on one line.
//!
//! ```json
//! {"strokes": [3, 4], "not": "tree"}, {"strokes": [3, 4], "as": "bush"}, {"strokes": [5, 6], "as": "separate"}
//! ```

use super::names::Names;
use super::progress::Progress;
use crate::quote;
use crate::sketch::corrections::{Correction, Corrections, Verdict, check};
use crate::sketch::error::Fault;
use crate::sketch::{Reading, StrokeId, limits};
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, SeqAccess, Visitor};
use serde_json::json;
use std::fmt;

/// What files say of strokes that are parts by themselves.
const SEPARATE: &str = "separate";

/// Appends a correction as JSON.
pub(super) fn push(out: &mut String, correction: &Correction) {
    let (word, name) = match correction.verdict {
        Verdict::Not(reading) => ("not", reading.name()),
        Verdict::As(reading) => ("as", reading.name()),
        Verdict::Separate => ("as", SEPARATE),
    };
    let strokes: Vec<String> = correction.strokes.iter().map(StrokeId::to_string).collect();
    out.push_str(&format!("{{\"strokes\": [{}], \"{word}\": {}}}", strokes.join(", "), json!(name)));
}

/// Reads the list.
pub(super) struct CorrectionsSeed<'p>(pub(super) &'p Progress);

impl<'de> DeserializeSeed<'de> for CorrectionsSeed<'_> {
    type Value = Corrections;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for CorrectionsSeed<'_> {
    type Value = Corrections;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of corrections")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let progress = self.0;
        let too_many = |what, limit| progress.refuse(Fault::TooMany { what, limit });
        let (mut corrections, mut names) = (Vec::new(), 0);
        while let Some(text) = seq.next_element::<CorrectionText>()? {
            names += text.strokes.0.len();
            if corrections.len() == limits::MAX_CORRECTIONS {
                return Err(too_many("corrections", limits::MAX_CORRECTIONS));
            }
            if names > limits::MAX_CORRECTED_STROKES {
                return Err(too_many("strokes in its corrections", limits::MAX_CORRECTED_STROKES));
            }
            let place = corrections.len() + 1;
            let of_place = |what: String| progress.malformed(format!("correction {place}: {what}"));
            corrections.push(text.correction().map_err(of_place)?);
        }
        check(&corrections).map_err(|what| progress.malformed(what))?;
        Ok(corrections.into())
    }
}

/// The corrections of a step in the journal.
pub(super) struct CorrectionList(pub(super) Corrections);

impl<'de> Deserialize<'de> for CorrectionList {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        CorrectionsSeed(&Progress::default()).deserialize(deserializer).map(Self)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CorrectionText {
    strokes: Names,
    not: Option<String>,
    #[serde(rename = "as")]
    is: Option<String>,
}

impl CorrectionText {
    fn correction(self) -> Result<Correction, String> {
        let Self { strokes, not, is } = self;
        let verdict = match (not.as_deref(), is.as_deref()) {
            (None, Some(SEPARATE)) => Verdict::Separate,
            (None, Some(name)) => Verdict::As(named(name)?),
            (Some(name), None) => Verdict::Not(named(name)?),
            _ => return Err("write either `not` or `as`".to_owned()),
        };
        if strokes.0.is_empty() {
            return Err("it names no strokes".to_owned());
        }
        Ok(Correction::new(strokes.0, verdict))
    }
}

/// The reading of a name.
fn named(name: &str) -> Result<Reading, String> {
    let known = Reading::ALL.into_iter().find(|reading| reading.name() == name);
    known.ok_or_else(|| {
        let names: Vec<&str> = Reading::ALL.iter().map(|reading| reading.name()).collect();
        format!("strokes are never read as `{}`; readings are {}", quote::name(name), names.join(", "))
    })
}
