//! Parts of a plant that the artist turned, bent, straightened, moved, grafted, made larger, made younger or took away in the view of
//! the plant: what a drawing keeps of it.
//!
//! A part is a branch, or a leaf, a flower, a fruit or a pot. A [`PartPose`] names it by the stroke that drew it, or where it grew by
//! the way of buds that it grew from, so that it is found again when the plant grows anew, at another age, and where most
//! parameters change. Turns are in the frame of what carries the part, like joints of a puppet: a bough that is turned takes
//! along all that grows on it, whatever that was turned by itself, and no pose depends on the order in which they were made.
//! Poses of parts that are not there rest without effect.

use super::{StrokeId, limits};
use glam::{Quat, Vec3};
use std::fmt;
use std::ops::RangeInclusive;
use std::sync::Arc;

/// Farthest that the length of a turn's quaternion may be from 1.
const UNIT: f32 = 1e-3;

/// How many times as thick as it is a branch may be made, and how many times as large an organ.
pub const THICKNESSES: RangeInclusive<f32> = 0.2..=5.0;

/// What a branch or an organ is known by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PartName {
    /// The stroke that drew it.
    Stroke(StrokeId),
    /// A hash: for what grew, of the way of buds that it grew from; of a stroke that drew several parts, for the others but the
    /// first; and for a drawn flower as a whole, of its petals' strokes.
    Grown(u64),
}

/// As messages name it, and for wood that grew as files do.
impl fmt::Display for PartName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stroke(stroke) => write!(f, "stroke {stroke}"),
            Self::Grown(name) => write!(f, "grown part {name:016x}"),
        }
    }
}

/// Where on another branch a part was grafted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Graft {
    /// The branch that it stands on now.
    pub onto: PartName,
    /// How far along that, as a share of its length, 0 to 1.
    pub at: f32,
}

/// How a branch or an organ is turned, bent, moved and grafted, how large it is, and whether it is there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartPose {
    /// The branch or organ.
    pub part: PartName,
    /// Turn about its base.
    pub turn: Quat,
    /// Turn from base to end besides, which grows evenly along its length; organs are not bent.
    pub bend: Quat,
    /// How far the line of a branch is drawn out straight, from 0, as it grew, to 1; organs are not straightened.
    pub straight: f32,
    /// The other branch that it stands on; it is moved from there.
    pub graft: Option<Graft>,
    /// The other leaf, flower or fruit of the plant that it is a copy of; branches, petals and pots are none.
    pub like: Option<PartName>,
    /// How its base is moved, pixels of the canvas. What grows on a branch then stands where that comes nearest to there, and what
    /// stands on the ground stays on it.
    pub shift: Vec3,
    /// How many times as thick a branch is with all that grows on it, or how many times as large an organ, in [`THICKNESSES`].
    pub thickness: f32,
    /// How many years younger than it is a branch is shown, with all that grew on it; of drawn wood what grew on that. It keeps what
    /// grew in one year; organs have no age.
    pub younger: u16,
    /// Whether it was cut off; what was drawn is taken away with its stroke.
    pub is_cut: bool,
}

/// All poses of a drawing, oldest first; shared, because drawings are copied with every sample of the pen.
pub type PartPoses = Arc<[PartPose]>;

impl PartPose {
    /// The pose of a part that is as it was drawn or grew.
    pub fn still(part: PartName) -> Self {
        let (turn, bend, shift) = (Quat::IDENTITY, Quat::IDENTITY, Vec3::ZERO);
        Self {
            part,
            turn,
            bend,
            straight: 0.0,
            graft: None,
            like: None,
            shift,
            thickness: 1.0,
            younger: 0,
            is_cut: false,
        }
    }

    /// Whether it changes nothing.
    pub fn is_still(&self) -> bool {
        *self == Self::still(self.part)
    }

    /// Whether drawings held poses like this one before parts were straightened and grafted.
    pub(super) fn is_of_old_kinds(&self) -> bool {
        self.straight == 0.0 && self.graft.is_none()
    }

    /// Whether drawings held poses like this one before branches were younger than their plant, and parts copies of others.
    pub(super) fn is_of_version_13(&self) -> bool {
        self.younger == 0 && self.like.is_none()
    }

    /// Whether drawings held poses like this one before wood that grew was posed.
    pub(super) fn is_of_first_kind(&self) -> bool {
        matches!(self.part, PartName::Stroke(_)) && self.thickness == 1.0
    }
}

/// The pose of a part.
pub fn pose_of(poses: &[PartPose], part: PartName) -> PartPose {
    poses.iter().find(|pose| pose.part == part).copied().unwrap_or(PartPose::still(part))
}

/// The poses with a new one in place of that of the same part; one that changes nothing takes it away.
pub fn posed(known: &[PartPose], new: PartPose) -> PartPoses {
    let others = known.iter().filter(|pose| pose.part != new.part).copied();
    others.chain((!new.is_still()).then_some(new)).collect()
}

/// Checks that there are not too many, each of another part, and that all they say is possible.
///
/// # Errors
/// What is wrong, in words.
pub(super) fn check(poses: &[PartPose]) -> Result<(), String> {
    if poses.len() > limits::MAX_PART_POSES {
        return Err(format!("a drawing holds at most {} poses", limits::MAX_PART_POSES));
    }
    let mut names: Vec<PartName> = poses.iter().map(|pose| pose.part).collect();
    names.sort_unstable();
    if let Some(twice) = names.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(format!("{} has two poses; give each part one", twice[0]));
    }
    poses.iter().try_for_each(check_one)
}

/// What is wrong with a pose, in words.
pub(super) fn check_one(pose: &PartPose) -> Result<(), String> {
    let part = pose.part;
    for (name, turn) in [("turn", pose.turn), ("bend", pose.bend)] {
        // What is no number lies in no range.
        if !(1.0 - UNIT..=1.0 + UNIT).contains(&turn.length()) {
            return Err(format!(
                "the `{name}` of {part} is no turn; write the four numbers x, y, z, w of a quaternion of length 1"
            ));
        }
    }
    let farthest = limits::MAX_COORDINATE;
    if !pose.shift.to_array().iter().all(|x| (-farthest..=farthest).contains(x)) {
        return Err(format!(
            "the `shift` of {part} is too far; write three numbers of at most {farthest} pixels"
        ));
    }
    if !(0.0..=1.0).contains(&pose.straight) {
        return Err(format!("the `straight` of {part} is {}; write a number from 0 to 1", pose.straight));
    }
    check_graft(pose)?;
    if pose.like == Some(part) {
        return Err(format!("{part} is a copy of itself; name another part in its `like`"));
    }
    if !THICKNESSES.contains(&pose.thickness) {
        let (least, most) = (THICKNESSES.start(), THICKNESSES.end());
        return Err(format!(
            "the `thickness` of {part} is {}; write a number from {least} to {most}",
            pose.thickness
        ));
    }
    if pose.is_cut && matches!(part, PartName::Stroke(_)) {
        return Err(format!("{part} is `cut`; leave out the stroke instead"));
    }
    Ok(())
}

/// What is wrong with the graft of a pose, in words.
fn check_graft(pose: &PartPose) -> Result<(), String> {
    let (part, Some(Graft { onto, at })) = (pose.part, pose.graft) else { return Ok(()) };
    if onto == part {
        return Err(format!("{part} is grafted onto itself; name another branch in its `graft`"));
    }
    if !(0.0..=1.0).contains(&at) {
        return Err(format!(
            "the `at` of the `graft` of {part} is {at}; write a share of its length, 0 to 1"
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(stroke: StrokeId, angle: f32) -> PartPose {
        PartPose { turn: Quat::from_rotation_z(angle), ..PartPose::still(PartName::Stroke(stroke)) }
    }

    #[test]
    fn a_branch_has_one_pose_and_a_still_one_takes_it_away() {
        let poses = posed(&posed(&[], turned(3, 0.5)), turned(7, 0.2));
        let poses = posed(&poses, turned(3, 0.9));
        assert_eq!(*poses, [turned(7, 0.2), turned(3, 0.9)]);
        let other = PartName::Grown(7);
        assert_eq!(
            (pose_of(&poses, PartName::Stroke(7)), pose_of(&poses, other)),
            (turned(7, 0.2), PartPose::still(other))
        );
        assert_eq!(*posed(&poses, PartPose::still(PartName::Stroke(7))), [turned(3, 0.9)]);
    }

    #[test]
    fn what_is_no_turn_or_too_much_is_refused() {
        assert_eq!(check(&[turned(1, 3.0), turned(2, -3.0)]), Ok(()));
        assert!(check(&[turned(1, 3.0), turned(1, -3.0)]).unwrap_err().contains("two poses"));
        for turn in [Quat::from_xyzw(0.0, 0.0, 0.0, 0.0), Quat::from_xyzw(0.0, f32::NAN, 0.0, 1.0)] {
            assert!(
                check(&[PartPose { turn, ..turned(1, 0.0) }]).unwrap_err().contains("`turn` of stroke 1")
            );
            assert!(check_one(&PartPose { bend: turn, ..turned(1, 0.0) }).unwrap_err().contains("`bend`"));
        }
        let many: Vec<PartPose> = (0..=limits::MAX_PART_POSES as u64).map(|id| turned(id, 0.1)).collect();
        assert!(check(&many).is_err() && check(&many[1..]).is_ok());
    }
}
