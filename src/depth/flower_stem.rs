//! The last stretch of a stem, up to its flower.
//!
//! The hand often stops a stem at the petals' edge, and a stem that lies flat in the drawing would meet a flower that
//! faces the viewer from the side. So the stem is led on to the flower's centre, and its end bends out of the drawing
//! to arrive from behind, along the flower's axis. Both keep the drawing: seen from the front nothing moves.

use crate::anatomy::{Anatomy, Attachment, FlatBranch, FlatFlower, Sample};
use crate::geom::polyline;
use glam::{Vec2, Vec3};

crate::parameters! {
    /// How stems arrive at flowers.
    pub struct StemParams {
        /// Length of the stretch that bends toward the flower's axis.
        neck: f32 = 0.6, 0.0..=3.0, "of the petals' length";
        /// How far it follows the axis out of the drawing; 0 keeps stems flat.
        neck_bend: f32 = 0.6, 0.0..=1.0, "";
    }
}

/// Steepest rise of a neck: depth gained per length drawn.
const STEEPEST: f32 = 1.5;

/// Length of a stem's end whose direction counts, as a share of the petals' length.
const ARRIVAL: f32 = 0.4;

/// Gap between stem and flower, as a share of the petals' length, that is too small to bridge.
const TOUCHING: f32 = 0.02;

/// Where a stem must lead.
#[derive(Clone, Copy, Debug)]
pub struct Goal {
    /// The flower's centre on the canvas.
    pub center: Vec2,
    /// The flower's axis, world directions.
    pub axis: Vec3,
    /// Length of its petals, pixels.
    pub reach: f32,
    /// Arc length of the last place on the stem from which something else grows.
    pub last_child_at: f32,
}

/// Direction on the canvas in which the stem at `place` arrives at a flower; none for a flower beside a branch, whose own
/// stalk was not drawn.
pub fn arrival(anatomy: &Anatomy, place: Attachment, flower: &FlatFlower) -> Option<Vec2> {
    let line = &anatomy.branches[place.branch].line;
    let arcs = polyline::arc_lengths(line.iter().map(|s| s.position));
    let length = *arcs.last()?;
    if place.at < length {
        return None;
    }
    let reach = flower.petals.iter().map(|&p| anatomy.petals[p].tip.distance(flower.center)).sum::<f32>()
        / flower.petals.len().max(1) as f32;
    let end = line.last()?.position;
    let from = line[arcs.partition_point(|arc| *arc < length - ARRIVAL * reach).min(line.len() - 1)].position;
    let toward = if end.distance(flower.center) > 0.25 * reach { flower.center - from } else { end - from };
    toward.try_normalize()
}

/// Leads the end of a stem to its flower. `depths` holds the depth of every sample of `branch.line`, pixels toward the
/// viewer; both grow together when a gap is bridged. Returns the depth of the flower's centre.
pub fn lead_to_flower(
    branch: &mut FlatBranch,
    depths: &mut Vec<f32>,
    goal: &Goal,
    params: &StemParams,
) -> f32 {
    bridge_gap(branch, depths, goal);
    let arcs = polyline::arc_lengths(branch.line.iter().map(|s| s.position));
    let length = arcs.last().copied().unwrap_or(0.0);
    let neck = (params.neck * goal.reach).min(length - goal.last_child_at);
    if neck > 0.0 {
        let slope = goal.axis.z / goal.axis.truncate().length().max(0.05);
        let rise = 0.5 * params.neck_bend * neck * slope.clamp(-STEEPEST, STEEPEST);
        for (depth, arc) in depths.iter_mut().zip(&arcs) {
            let share = (1.0 - (length - arc) / neck).max(0.0);
            *depth += rise * share * share;
        }
    }
    depths.last().copied().unwrap_or(0.0)
}

/// Continues the stem to the centre in a curve that leaves along the stem's own direction.
fn bridge_gap(branch: &mut FlatBranch, depths: &mut Vec<f32>, goal: &Goal) {
    let count = branch.line.len();
    let Some(&last) = branch.line.last() else { return };
    let gap = last.position.distance(goal.center);
    if gap <= TOUCHING * goal.reach {
        return;
    }
    let before = branch.line[count.saturating_sub(4)].position;
    let tangent = (last.position - before).normalize_or_zero();
    let toward = (goal.center - last.position) / gap;
    let handle = last.position + 0.5 * gap * if tangent.dot(toward) > 0.0 { tangent } else { toward };
    let depth = depths.last().copied().unwrap_or(0.0);
    const STEPS: usize = 5;
    let mut line = branch.line.to_vec();
    for k in 1..=STEPS {
        let t = k as f32 / STEPS as f32;
        let position = last.position.lerp(handle, t).lerp(handle.lerp(goal.center, t), t);
        line.push(Sample { position, ..last });
        depths.push(depth);
    }
    branch.line = line.into();
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stem() -> (FlatBranch, Vec<f32>) {
        let line = (0..=20).map(|k| Sample::neutral(Vec2::new(0.0, 200.0 - 10.0 * k as f32))).collect();
        (
            FlatBranch {
                stroke: Some(1),
                key: 1,
                line,
                half_width: None,
                parent: None,
                attached_at: 0.0,
                level: 0,
            },
            vec![0.0; 21],
        )
    }

    fn goal(center: Vec2) -> Goal {
        Goal { center, axis: Vec3::new(0.0, 0.6, 0.8), reach: 60.0, last_child_at: 0.0 }
    }

    #[test]
    fn a_gap_is_bridged_and_what_was_drawn_stays() {
        let (mut branch, mut depths) = stem();
        let drawn = branch.line.clone();
        lead_to_flower(&mut branch, &mut depths, &goal(Vec2::new(15.0, -30.0)), &StemParams::default());
        assert_eq!(branch.line[..21], drawn[..]);
        assert_eq!(branch.line.last().unwrap().position, Vec2::new(15.0, -30.0));
        assert_eq!(branch.line.len(), depths.len());
    }

    #[test]
    fn the_neck_rises_toward_the_viewer_behind_the_last_child() {
        let (mut branch, mut depths) = stem();
        let goal = Goal { last_child_at: 180.0, ..goal(Vec2::new(0.0, 0.0)) };
        let depth = lead_to_flower(&mut branch, &mut depths, &goal, &StemParams::default());
        assert!(depth > 5.0 && depths[..=18].iter().all(|&d| d == 0.0));
        assert!(depths.windows(2).all(|w| w[1] >= w[0]));
    }

    #[test]
    fn a_flat_stem_can_be_asked_for() {
        let (mut branch, mut depths) = stem();
        let params = StemParams { neck_bend: 0.0, ..Default::default() };
        assert_eq!(lead_to_flower(&mut branch, &mut depths, &goal(Vec2::ZERO), &params), 0.0);
    }
}
