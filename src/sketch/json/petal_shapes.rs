//! The `petal_shapes` of a drawing: how far the artist moved control points of petals, a flower on each line.
//!
//! ```json
//! {"strokes": [3, 4], "offsets": [[[0, 0, 0], …, [0, 0, 0]], …, [[0, 0, 0.2], …, [0, 0, 0.2]]]}
//! ```
//!
//! Four rows from base to tip, in each four points from left to right, of each how far it is moved across, along and toward the
//! face, in shares of the petal's length.

use super::names::Names;
use super::number::push_number;
use super::progress::Progress;
use crate::sketch::error::Fault;
use crate::sketch::petal_shapes::{PetalShape, PetalShapes, check, check_one};
use crate::sketch::{StrokeId, limits};
use glam::Vec3;
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, SeqAccess, Visitor};
use std::fmt;

/// Appends a shape as JSON.
pub(super) fn push(out: &mut String, shape: &PetalShape) {
    let strokes: Vec<String> = shape.strokes.iter().map(StrokeId::to_string).collect();
    out.push_str(&format!("{{\"strokes\": [{}], \"offsets\": [", strokes.join(", ")));
    for (i, row) in shape.offsets.iter().enumerate() {
        out.push_str(if i == 0 { "[" } else { ", [" });
        for (k, offset) in row.iter().enumerate() {
            out.push_str(if k == 0 { "[" } else { ", [" });
            for (n, number) in offset.to_array().into_iter().enumerate() {
                out.push_str(if n == 0 { "" } else { ", " });
                push_number(out, number);
            }
            out.push(']');
        }
        out.push(']');
    }
    out.push_str("]}");
}

/// Reads the list.
pub(super) struct PetalShapesSeed<'p>(pub(super) &'p Progress);

impl<'de> DeserializeSeed<'de> for PetalShapesSeed<'_> {
    type Value = PetalShapes;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for PetalShapesSeed<'_> {
    type Value = PetalShapes;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of shapes of petals")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let progress = self.0;
        let too_many = |what, limit| progress.refuse(Fault::TooMany { what, limit });
        let (mut shapes, mut names) = (Vec::new(), 0);
        progress.petal_shape.set(1);
        while let Some(PetalShapeText { strokes, offsets }) = seq.next_element()? {
            names += strokes.0.len();
            if shapes.len() == limits::MAX_PETAL_SHAPES {
                return Err(too_many("shapes of petals", limits::MAX_PETAL_SHAPES));
            }
            if names > limits::MAX_SHAPED_STROKES {
                return Err(too_many("strokes in its shapes of petals", limits::MAX_SHAPED_STROKES));
            }
            let shape = PetalShape::new(strokes.0, offsets.map(|row| row.map(Vec3::from)));
            check_one(&shape).map_err(|what| progress.malformed(what))?;
            shapes.push(shape);
            progress.petal_shape.set(shapes.len() + 1);
        }
        progress.petal_shape.set(0);
        check(&shapes).map_err(|what| progress.malformed(what))?;
        Ok(shapes.into())
    }
}

/// The shapes of petals of a step in the journal.
pub(super) struct PetalShapeList(pub(super) PetalShapes);

impl<'de> Deserialize<'de> for PetalShapeList {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        PetalShapesSeed(&Progress::default()).deserialize(deserializer).map(Self)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PetalShapeText {
    strokes: Names,
    offsets: [[[f32; 3]; 4]; 4],
}
