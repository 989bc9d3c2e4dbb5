//! What a network that has seen thousands of trees says of the depth of a drawn one (001 ch. 3).
//!
//! It is asked about drawings with a crown; the crown's outlines and the drawn branches are what it sees. Two stages make use of its
//! answer: branches leave the drawing's plane as far as it tells (`branch_depth.rs`), and crowns are as deep (`growth/volume/inflated.rs`).

use super::crowns;
use crate::anatomy::{Anatomy, FlatBranch};
use crate::geom::polyline;
use crate::learned_depth::{DepthField, Line, Memory, Question};
use glam::Vec2;
use std::sync::Arc;

crate::parameters! {
    /// How far learned depth takes the place of depth by rules; for what is no tree it does not, whatever is set.
    pub struct LearnedParams {
        /// How much crowns are as deep as the network tells.
        crown: f32 = 1.0, 0.0..=1.0, "";
        /// How much branches leave the plane as far as the network tells.
        branches: f32 = 1.0, 0.0..=1.0, "";
    }
}

/// Most branches that are shown to the network, the earliest by order.
const MOST_BRANCHES: usize = 24;

/// How far from a crown's bounds wood may end that belongs to it, as a share of their diagonal.
const BESIDE: f32 = 0.08;

/// The depth of a drawing with a crown whose plant is of a `habit`; `None` without a crown, without a network, or where nothing of it is
/// wanted. `trunk` is the bare trunk of a crown for which no branch was drawn, in its heights.
pub fn field_of(
    memory: &mut Memory,
    anatomy: &Anatomy,
    habit: Option<&str>,
    trunk: f32,
    params: &LearnedParams,
) -> Option<Arc<DepthField>> {
    if anatomy.crowns.is_empty() || (params.crown <= 0.0 && params.branches <= 0.0) {
        memory.forget();
        return None;
    }
    let outlines: Vec<Vec<Vec2>> = anatomy.crowns.iter().map(|crown| crown.outline.clone()).collect();
    let mut drawn = wood_of(anatomy);
    drawn.sort_by_key(|branch| branch.level);
    drawn.truncate(MOST_BRANCHES);
    // Trunks are drawn last, over what they carry.
    let line = |branch: &&FlatBranch| Line {
        points: branch.line.iter().map(|sample| sample.position).collect(),
        is_trunk: branch.level == 0,
    };
    let wood: Vec<Line> = drawn.iter().rev().map(line).collect();
    let roots = drawn.iter().filter(|b| b.parent.is_none()).filter_map(|b| b.line.first());
    let lowest = roots.map(|root| root.position).max_by(|a, b| a.y.total_cmp(&b.y));
    let foot = lowest.or_else(|| crowns::foot(anatomy, trunk))?;
    memory.field(Question { foot, outlines, wood, habit: habit.map(str::to_owned) })
}

/// The drawn branches that reach the crowns, and those that grow on the same trunks: a herb beside a tree is none of its wood.
fn wood_of(anatomy: &Anatomy) -> Vec<&FlatBranch> {
    let points = anatomy.crowns.iter().flat_map(|crown| crown.outline.iter().copied());
    let (low, high) = polyline::bounds(points);
    let margin = BESIDE * low.distance(high);
    let reaches = |branch: &FlatBranch| {
        let near = |p: Vec2| p.cmpge(low - margin).all() && p.cmple(high + margin).all();
        branch.line.iter().any(|sample| near(sample.position))
    };
    // Parents stand before their children.
    let mut trunk: Vec<usize> = Vec::with_capacity(anatomy.branches.len());
    let mut reached = vec![false; anatomy.branches.len()];
    for (i, branch) in anatomy.branches.iter().enumerate() {
        trunk.push(branch.parent.map_or(i, |parent| trunk[parent]));
        reached[trunk[i]] |= branch.stroke.is_some() && reaches(branch);
    }
    let all = anatomy.branches.iter().zip(&trunk);
    all.filter(|(branch, trunk)| branch.stroke.is_some() && reached[**trunk])
        .map(|(branch, _)| branch)
        .collect()
}
