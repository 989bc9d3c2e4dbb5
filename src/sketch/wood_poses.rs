//! Branches that the artist turned and bent in the view of the plant: what a drawing keeps of it.
//!
//! A [`WoodPose`] names the stroke that drew a branch. Turns are in the frame of what carries the branch, like joints of a
//! puppet: a bough that is turned takes along all that grows on it, whatever that was turned by itself, and no pose depends on
//! the order in which they were made. Poses of strokes that are not there rest without effect.

use super::{StrokeId, limits};
use glam::Quat;
use std::sync::Arc;

/// Farthest that the length of a turn's quaternion may be from 1.
const UNIT: f32 = 1e-3;

/// How a branch is turned and bent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WoodPose {
    /// The stroke that drew the branch.
    pub stroke: StrokeId,
    /// Turn about its base.
    pub turn: Quat,
    /// Turn from base to end besides, which grows evenly along its length.
    pub bend: Quat,
}

/// All poses of a drawing, oldest first; shared, because drawings are copied with every sample of the pen.
pub type WoodPoses = Arc<[WoodPose]>;

impl WoodPose {
    /// The pose of a branch that stands as it was drawn.
    pub fn still(stroke: StrokeId) -> Self {
        Self { stroke, turn: Quat::IDENTITY, bend: Quat::IDENTITY }
    }

    /// Whether it changes nothing.
    pub fn is_still(&self) -> bool {
        self.turn == Quat::IDENTITY && self.bend == Quat::IDENTITY
    }
}

/// The pose of a stroke's branch.
pub fn pose_of(poses: &[WoodPose], stroke: StrokeId) -> WoodPose {
    poses.iter().find(|pose| pose.stroke == stroke).copied().unwrap_or(WoodPose::still(stroke))
}

/// The poses with a new one in place of that of the same stroke; one that changes nothing takes it away.
pub fn posed(known: &[WoodPose], new: WoodPose) -> WoodPoses {
    let others = known.iter().filter(|pose| pose.stroke != new.stroke).copied();
    others.chain((!new.is_still()).then_some(new)).collect()
}

/// Checks that there are not too many, each of another stroke, and that their turns are turns.
///
/// # Errors
/// What is wrong, in words.
pub(super) fn check(poses: &[WoodPose]) -> Result<(), String> {
    if poses.len() > limits::MAX_WOOD_POSES {
        return Err(format!("a drawing holds at most {} poses of branches", limits::MAX_WOOD_POSES));
    }
    let mut strokes: Vec<StrokeId> = poses.iter().map(|pose| pose.stroke).collect();
    strokes.sort_unstable();
    if let Some(twice) = strokes.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(format!("stroke {} has two poses; give each stroke one", twice[0]));
    }
    poses.iter().try_for_each(check_one)
}

/// What is wrong with a pose, in words.
pub(super) fn check_one(pose: &WoodPose) -> Result<(), String> {
    for (name, turn) in [("turn", pose.turn), ("bend", pose.bend)] {
        // What is no number lies in no range.
        if !(1.0 - UNIT..=1.0 + UNIT).contains(&turn.length()) {
            let stroke = pose.stroke;
            return Err(format!(
                "the `{name}` of stroke {stroke} is no turn; write the four numbers x, y, z, w of a quaternion of length 1"
            ));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(stroke: StrokeId, angle: f32) -> WoodPose {
        WoodPose { turn: Quat::from_rotation_z(angle), ..WoodPose::still(stroke) }
    }

    #[test]
    fn a_branch_has_one_pose_and_a_still_one_takes_it_away() {
        let poses = posed(&posed(&[], turned(3, 0.5)), turned(7, 0.2));
        let poses = posed(&poses, turned(3, 0.9));
        assert_eq!(*poses, [turned(7, 0.2), turned(3, 0.9)]);
        assert_eq!((pose_of(&poses, 7), pose_of(&poses, 8)), (turned(7, 0.2), WoodPose::still(8)));
        assert_eq!(*posed(&poses, WoodPose::still(7)), [turned(3, 0.9)]);
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
