//! The `wood_poses` of a drawing: branches that the artist turned and bent, one on each line.
//!
//! ```json
//! {"stroke": 4, "turn": [0, 0, 0.2588190, 0.9659258], "bend": [0, 0, 0, 1]}
//! ```
//!
//! Turns are quaternions x, y, z, w of length 1; one that is left out turns nothing.

use super::number::push_number;
use super::progress::Progress;
use crate::sketch::error::Fault;
use crate::sketch::wood_poses::{WoodPose, WoodPoses, check, check_one};
use crate::sketch::{StrokeId, limits};
use glam::Quat;
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, SeqAccess, Visitor};
use std::fmt;

/// Appends a pose as JSON.
pub(super) fn push(out: &mut String, pose: &WoodPose) {
    out.push_str(&format!("{{\"stroke\": {}", pose.stroke));
    for (name, turn) in [("turn", pose.turn), ("bend", pose.bend)] {
        if turn == Quat::IDENTITY {
            continue;
        }
        out.push_str(&format!(", \"{name}\": ["));
        for (n, number) in turn.to_array().into_iter().enumerate() {
            out.push_str(if n == 0 { "" } else { ", " });
            push_number(out, number);
        }
        out.push(']');
    }
    out.push('}');
}

/// Reads the list.
pub(super) struct WoodPosesSeed<'p>(pub(super) &'p Progress);

impl<'de> DeserializeSeed<'de> for WoodPosesSeed<'_> {
    type Value = WoodPoses;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for WoodPosesSeed<'_> {
    type Value = WoodPoses;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of poses of branches")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let progress = self.0;
        let mut poses = Vec::new();
        while let Some(PoseText { stroke, turn, bend }) = seq.next_element()? {
            if poses.len() == limits::MAX_WOOD_POSES {
                let (what, limit) = ("poses of branches", limits::MAX_WOOD_POSES);
                return Err(progress.refuse(Fault::TooMany { what, limit }));
            }
            let turn_of = |numbers: Option<[f32; 4]>| numbers.map_or(Quat::IDENTITY, Quat::from_array);
            let pose = WoodPose { stroke, turn: turn_of(turn), bend: turn_of(bend) };
            check_one(&pose).map_err(|what| progress.malformed(what))?;
            poses.push(pose);
        }
        check(&poses).map_err(|what| progress.malformed(what))?;
        Ok(poses.into())
    }
}

/// The poses of a step in the journal.
pub(super) struct WoodPoseList(pub(super) WoodPoses);

impl<'de> Deserialize<'de> for WoodPoseList {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        WoodPosesSeed(&Progress::default()).deserialize(deserializer).map(Self)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PoseText {
    stroke: StrokeId,
    turn: Option<[f32; 4]>,
    bend: Option<[f32; 4]>,
}
