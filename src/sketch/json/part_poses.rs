//! The `wood_poses` of a drawing: branches and organs that the artist turned, moved, grafted, made larger, made younger or took away,
//! one on each line.
//!
//! ```json
//! {"stroke": 4, "turn": [0, 0, 0.2588190, 0.9659258], "bend": [0, 0, 0, 1]}
//! {"grown": "8c1f0a52e9d40b77", "thickness": 1.5, "shift": [0, 40, 0]}
//! {"stroke": 5, "straight": 0.8, "graft": {"stroke": 2, "at": 0.5}}
//! {"grown": "51d09c7be2f3a866", "younger": 3}
//! {"stroke": 7, "like": {"grown": "b1c4e07d5f2296a3"}}
//! {"grown": "03bb2e6f91d8a4c0", "cut": true}
//! ```
//!
//! Turns are quaternions x, y, z, w of length 1; one that is left out turns nothing. Parts that grew are named by 16
//! hexadecimal digits, because not every reader of JSON knows whole numbers of 64 bits.

use super::number::push_number;
use super::progress::Progress;
use crate::quote;
use crate::sketch::error::Fault;
use crate::sketch::part_poses::{Graft, PartName, PartPose, PartPoses, check, check_one};
use crate::sketch::{StrokeId, limits};
use glam::{Quat, Vec3};
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, SeqAccess, Visitor};
use std::fmt;

/// Appends a pose as JSON.
pub(super) fn push(out: &mut String, pose: &PartPose) {
    push_name(out, pose.part);
    for (name, turn) in [("turn", pose.turn), ("bend", pose.bend)] {
        if turn == Quat::IDENTITY {
            continue;
        }
        push_numbers(out, name, &turn.to_array());
    }
    if pose.straight != 0.0 {
        out.push_str(", \"straight\": ");
        push_number(out, pose.straight);
    }
    if let Some(Graft { onto, at }) = pose.graft {
        out.push_str(", \"graft\": ");
        push_name(out, onto);
        out.push_str(", \"at\": ");
        push_number(out, at);
        out.push('}');
    }
    if let Some(like) = pose.like {
        out.push_str(", \"like\": ");
        push_name(out, like);
        out.push('}');
    }
    if pose.shift != Vec3::ZERO {
        push_numbers(out, "shift", &pose.shift.to_array());
    }
    if pose.thickness != 1.0 {
        out.push_str(", \"thickness\": ");
        push_number(out, pose.thickness);
    }
    if pose.younger != 0 {
        out.push_str(&format!(", \"younger\": {}", pose.younger));
    }
    out.push_str(if pose.is_cut { ", \"cut\": true}" } else { "}" });
}

/// Begins an object with the name of a part.
fn push_name(out: &mut String, part: PartName) {
    match part {
        PartName::Stroke(stroke) => out.push_str(&format!("{{\"stroke\": {stroke}")),
        PartName::Grown(name) => out.push_str(&format!("{{\"grown\": \"{name:016x}\"")),
    }
}

fn push_numbers(out: &mut String, name: &str, numbers: &[f32]) {
    out.push_str(&format!(", \"{name}\": ["));
    for (n, number) in numbers.iter().enumerate() {
        out.push_str(if n == 0 { "" } else { ", " });
        push_number(out, *number);
    }
    out.push(']');
}

/// Reads the list.
pub(super) struct PartPosesSeed<'p>(pub(super) &'p Progress);

impl<'de> DeserializeSeed<'de> for PartPosesSeed<'_> {
    type Value = PartPoses;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for PartPosesSeed<'_> {
    type Value = PartPoses;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of poses of branches and organs")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let progress = self.0;
        let mut poses = Vec::new();
        while let Some(text) = seq.next_element::<PoseText>()? {
            if poses.len() == limits::MAX_PART_POSES {
                let (what, limit) = ("poses", limits::MAX_PART_POSES);
                return Err(progress.refuse(Fault::TooMany { what, limit }));
            }
            let pose = text.pose().map_err(|what| progress.malformed(what))?;
            check_one(&pose).map_err(|what| progress.malformed(what))?;
            poses.push(pose);
        }
        check(&poses).map_err(|what| progress.malformed(what))?;
        Ok(poses.into())
    }
}

/// The poses of a step in the journal.
pub(super) struct PartPoseList(pub(super) PartPoses);

impl<'de> Deserialize<'de> for PartPoseList {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        PartPosesSeed(&Progress::default()).deserialize(deserializer).map(Self)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PoseText {
    stroke: Option<StrokeId>,
    grown: Option<String>,
    turn: Option<[f32; 4]>,
    bend: Option<[f32; 4]>,
    #[serde(default)]
    straight: f32,
    graft: Option<GraftText>,
    like: Option<LikeText>,
    shift: Option<[f32; 3]>,
    thickness: Option<f32>,
    #[serde(default)]
    younger: u16,
    #[serde(default)]
    cut: bool,
}

impl PoseText {
    /// The pose, or what is wrong with the name of its part.
    fn pose(self) -> Result<PartPose, String> {
        let part = name_of(self.stroke, self.grown)?
            .ok_or("a pose has one of `stroke` and `grown`, which name its part")?;
        let graft = self.graft.map(GraftText::graft).transpose()?;
        let like = self.like.map(LikeText::name).transpose()?;
        let turn_of = |numbers: Option<[f32; 4]>| numbers.map_or(Quat::IDENTITY, Quat::from_array);
        let (turn, bend, thickness) = (turn_of(self.turn), turn_of(self.bend), self.thickness.unwrap_or(1.0));
        let shift = self.shift.map_or(Vec3::ZERO, Vec3::from_array);
        let PoseText { straight, younger, cut: is_cut, .. } = self;
        Ok(PartPose { part, turn, bend, straight, graft, like, shift, thickness, younger, is_cut })
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GraftText {
    stroke: Option<StrokeId>,
    grown: Option<String>,
    at: f32,
}

impl GraftText {
    /// The graft, or what is wrong with the name of its branch.
    fn graft(self) -> Result<Graft, String> {
        let onto = name_of(self.stroke, self.grown)?
            .ok_or("a `graft` has one of `stroke` and `grown`, which name its branch")?;
        Ok(Graft { onto, at: self.at })
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LikeText {
    stroke: Option<StrokeId>,
    grown: Option<String>,
}

impl LikeText {
    /// The name of the part, or what is wrong with it.
    fn name(self) -> Result<PartName, String> {
        name_of(self.stroke, self.grown)?
            .ok_or_else(|| "a `like` has one of `stroke` and `grown`, which name its part".to_owned())
    }
}

/// The part that is named by its stroke or as one that grew; none where both are said or neither is.
fn name_of(stroke: Option<StrokeId>, grown: Option<String>) -> Result<Option<PartName>, String> {
    match (stroke, grown) {
        (Some(stroke), None) => Ok(Some(PartName::Stroke(stroke))),
        (None, Some(name)) => Ok(Some(PartName::Grown(grown_name(&name)?))),
        _ => Ok(None),
    }
}

/// The name of a part that grew.
fn grown_name(digits: &str) -> Result<u64, String> {
    let is_name = digits.len() == 16 && digits.bytes().all(|digit| digit.is_ascii_hexdigit());
    let name = is_name.then(|| u64::from_str_radix(digits, 16).ok()).flatten();
    name.ok_or_else(|| {
        format!("{} is no name of a grown part; write 16 hexadecimal digits", quote::name(digits))
    })
}
