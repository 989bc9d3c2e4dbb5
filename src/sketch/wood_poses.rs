//! Branches that the artist turned, bent, made thicker or cut off in the view of the plant: what a drawing keeps of it.
//!
//! A [`WoodPose`] names a branch by the stroke that drew it, or where it grew by the way of buds that it grew from, so that it
//! is found again when the plant grows anew, at another age, and where most parameters change. Turns are in the frame of what
//! carries the branch, like joints of a puppet: a bough that is turned takes along all that grows on it, whatever that was
//! turned by itself, and no pose depends on the order in which they were made. Poses of wood that is not there rest without
//! effect.

use super::{StrokeId, limits};
use glam::Quat;
use std::fmt;
use std::ops::RangeInclusive;
use std::sync::Arc;

/// Farthest that the length of a turn's quaternion may be from 1.
const UNIT: f32 = 1e-3;

/// How many times as thick as it is a branch may be made.
pub const THICKNESSES: RangeInclusive<f32> = 0.2..=5.0;

/// What a branch is known by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum WoodName {
    /// The stroke that drew it.
    Stroke(StrokeId),
    /// For one that grew, a hash of the way of buds that it grew from.
    Grown(u64),
}

/// As messages name it, and for wood that grew as files do.
impl fmt::Display for WoodName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stroke(stroke) => write!(f, "stroke {stroke}"),
            Self::Grown(name) => write!(f, "grown branch {name:016x}"),
        }
    }
}

/// How a branch is turned and bent, how thick it is, and whether it is there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WoodPose {
    /// The branch.
    pub wood: WoodName,
    /// Turn about its base.
    pub turn: Quat,
    /// Turn from base to end besides, which grows evenly along its length.
    pub bend: Quat,
    /// How many times as thick it is with all that grows on it, in [`THICKNESSES`].
    pub thickness: f32,
    /// Whether it was cut off; what was drawn is taken away with its stroke.
    pub is_cut: bool,
}

/// All poses of a drawing, oldest first; shared, because drawings are copied with every sample of the pen.
pub type WoodPoses = Arc<[WoodPose]>;

impl WoodPose {
    /// The pose of a branch that is as it was drawn or grew.
    pub fn still(wood: WoodName) -> Self {
        Self { wood, turn: Quat::IDENTITY, bend: Quat::IDENTITY, thickness: 1.0, is_cut: false }
    }

    /// Whether it changes nothing.
    pub fn is_still(&self) -> bool {
        *self == Self::still(self.wood)
    }

    /// Whether drawings held poses like this one before wood that grew was posed.
    pub(super) fn is_of_first_kind(&self) -> bool {
        matches!(self.wood, WoodName::Stroke(_)) && self.thickness == 1.0
    }
}

/// The pose of a branch.
pub fn pose_of(poses: &[WoodPose], wood: WoodName) -> WoodPose {
    poses.iter().find(|pose| pose.wood == wood).copied().unwrap_or(WoodPose::still(wood))
}

/// The poses with a new one in place of that of the same branch; one that changes nothing takes it away.
pub fn posed(known: &[WoodPose], new: WoodPose) -> WoodPoses {
    let others = known.iter().filter(|pose| pose.wood != new.wood).copied();
    others.chain((!new.is_still()).then_some(new)).collect()
}

/// Checks that there are not too many, each of another branch, and that all they say is possible.
///
/// # Errors
/// What is wrong, in words.
pub(super) fn check(poses: &[WoodPose]) -> Result<(), String> {
    if poses.len() > limits::MAX_WOOD_POSES {
        return Err(format!("a drawing holds at most {} poses of branches", limits::MAX_WOOD_POSES));
    }
    let mut names: Vec<WoodName> = poses.iter().map(|pose| pose.wood).collect();
    names.sort_unstable();
    if let Some(twice) = names.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(format!("{} has two poses; give each branch one", twice[0]));
    }
    poses.iter().try_for_each(check_one)
}

/// What is wrong with a pose, in words.
pub(super) fn check_one(pose: &WoodPose) -> Result<(), String> {
    let wood = pose.wood;
    for (name, turn) in [("turn", pose.turn), ("bend", pose.bend)] {
        // What is no number lies in no range.
        if !(1.0 - UNIT..=1.0 + UNIT).contains(&turn.length()) {
            return Err(format!(
                "the `{name}` of {wood} is no turn; write the four numbers x, y, z, w of a quaternion of length 1"
            ));
        }
    }
    if !THICKNESSES.contains(&pose.thickness) {
        let (least, most) = (THICKNESSES.start(), THICKNESSES.end());
        return Err(format!(
            "the `thickness` of {wood} is {}; write a number from {least} to {most}",
            pose.thickness
        ));
    }
    if pose.is_cut && matches!(wood, WoodName::Stroke(_)) {
        return Err(format!("{wood} is `cut`; leave out the stroke instead"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(stroke: StrokeId, angle: f32) -> WoodPose {
        WoodPose { turn: Quat::from_rotation_z(angle), ..WoodPose::still(WoodName::Stroke(stroke)) }
    }

    #[test]
    fn a_branch_has_one_pose_and_a_still_one_takes_it_away() {
        let poses = posed(&posed(&[], turned(3, 0.5)), turned(7, 0.2));
        let poses = posed(&poses, turned(3, 0.9));
        assert_eq!(*poses, [turned(7, 0.2), turned(3, 0.9)]);
        let other = WoodName::Grown(7);
        assert_eq!(
            (pose_of(&poses, WoodName::Stroke(7)), pose_of(&poses, other)),
            (turned(7, 0.2), WoodPose::still(other))
        );
        assert_eq!(*posed(&poses, WoodPose::still(WoodName::Stroke(7))), [turned(3, 0.9)]);
    }

    #[test]
    fn what_is_no_turn_or_too_much_is_refused() {
        assert_eq!(check(&[turned(1, 3.0), turned(2, -3.0)]), Ok(()));
        assert!(check(&[turned(1, 3.0), turned(1, -3.0)]).unwrap_err().contains("two poses"));
        for turn in [Quat::from_xyzw(0.0, 0.0, 0.0, 0.0), Quat::from_xyzw(0.0, f32::NAN, 0.0, 1.0)] {
            assert!(
                check(&[WoodPose { turn, ..turned(1, 0.0) }]).unwrap_err().contains("`turn` of stroke 1")
            );
            assert!(check_one(&WoodPose { bend: turn, ..turned(1, 0.0) }).unwrap_err().contains("`bend`"));
        }
        let many: Vec<WoodPose> = (0..=limits::MAX_WOOD_POSES as u64).map(|id| turned(id, 0.1)).collect();
        assert!(check(&many).is_err() && check(&many[1..]).is_ok());
    }
}
