//! Who gets how much: the priority model (001 §2.3.2, eqs. 2.5 and 2.6).
//!
//! An axis is looked at as a whole. Its buds and the branches it carries stand in a queue by what they earn per bud, the
//! apical bud first where the plant has apical dominance. The i-th of N gets v·Q_i·ω_i / ΣQ_jω_j with weights that fall
//! from ω_max straight to ω_min at the share κ of the queue and stay there. A small κ makes one leader.
//!
//! Where the papers leave it open: κN is not rounded, and with κ = 0 the first of the queue has ω_max, all others ω_min.

use super::tree::{NONE, Tree};
use super::vigour::Flow;

/// Numbers of eq. 2.6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Priority {
    /// κ: share of the queue over which the weight falls.
    pub kappa: f32,
    /// ω_max.
    pub most: f32,
    /// ω_min.
    pub least: f32,
    /// Whether the apical bud stands first.
    pub apical_first: bool,
}

impl Priority {
    /// The weight ω of the i-th of `count`, counted from 1.
    pub fn weight(&self, i: usize, count: usize) -> f32 {
        let fall = self.kappa * count as f32;
        if i == 1 && fall < 1.0 {
            return self.most;
        }
        let i = i as f32;
        if i <= fall { self.most - (self.most - self.least) / fall * i } else { self.least }
    }
}

/// A bud or a branch in the queue of an axis.
#[derive(Clone, Copy, Debug)]
struct Member {
    axis: u32,
    /// The first node of a branch, or the place of an open bud in the list.
    index: u32,
    is_bud: bool,
    apical: bool,
    q: f32,
    /// Resource per bud.
    mean: f32,
}

/// Shares α·Q of each foot out along the axes; [`Flow::gather`] must have run. Fills [`Flow::bud`].
pub fn share_out(flow: &mut Flow, tree: &Tree, q: &[f32], supply: f32, priority: impl Fn(u8) -> Priority) {
    let nodes = &tree.nodes;
    let members = members(flow, tree, q, priority(0).apical_first);
    let Flow { v, bud, main, side } = flow;
    v.clear();
    v.resize(tree.len(), 0.0);
    bud.clear();
    bud.resize(tree.open.len(), 0.0);
    for i in 0..tree.len() {
        if nodes.parent[i] == NONE {
            v[i] = supply * (main[i] + side[i]);
        }
    }
    // Axes come by rising first node, so an axis has its resource before it shares it out.
    for queue in members.chunk_by(|a, b| a.axis == b.axis) {
        let axis = queue[0].axis as usize;
        let rule = priority(nodes.order[axis]);
        let weights: Vec<f32> =
            (0..queue.len()).map(|i| queue[i].q * rule.weight(i + 1, queue.len())).collect();
        let whole: f32 = weights.iter().sum();
        for (member, weight) in queue.iter().zip(&weights) {
            let share = if whole > 0.0 { v[axis] * weight / whole } else { 0.0 };
            let into =
                if member.is_bud { &mut bud[member.index as usize] } else { &mut v[member.index as usize] };
            *into = share;
        }
    }
}

/// All buds and branches with any resource, by axis and then by their place in its queue.
fn members(flow: &Flow, tree: &Tree, q: &[f32], apical_first: bool) -> Vec<Member> {
    let nodes = &tree.nodes;
    let mut buds_above = vec![0u32; tree.len()];
    let mut out = Vec::with_capacity(tree.open.len() * 2);
    for (index, (&bud, &q)) in tree.open.iter().zip(q).enumerate() {
        let node = tree.buds.node[bud as usize];
        buds_above[node as usize] += 1;
        if q > 0.0 {
            let apical = apical_first && tree.buds.apical[bud as usize];
            let axis = nodes.axis[node as usize];
            out.push(Member { axis, index: index as u32, is_bud: true, apical, q, mean: q });
        }
    }
    for i in (0..tree.len()).rev() {
        let parent = nodes.parent[i];
        if parent == NONE || buds_above[i] == 0 {
            continue;
        }
        buds_above[parent as usize] += buds_above[i];
        let q = flow.through(i);
        if tree.begins_lateral(i) && q > 0.0 {
            let axis = nodes.axis[parent as usize];
            let mean = q / buds_above[i] as f32;
            out.push(Member { axis, index: i as u32, is_bud: false, apical: false, q, mean });
        }
    }
    out.sort_unstable_by(|a, b| {
        let queue = b.apical.cmp(&a.apical).then(b.mean.total_cmp(&a.mean));
        a.axis.cmp(&b.axis).then(queue).then((a.is_bud, a.index).cmp(&(b.is_bud, b.index)))
    });
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_fall_straight_and_stay() {
        let rule = Priority { kappa: 0.5, most: 1.0, least: 0.0, apical_first: true };
        let weights: Vec<f32> = (1..=8).map(|i| rule.weight(i, 8)).collect();
        assert_eq!(weights, [0.75, 0.5, 0.25, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let one = Priority { kappa: 0.0, least: 0.006, ..rule };
        assert_eq!([one.weight(1, 5), one.weight(2, 5)], [1.0, 0.006]);
    }
}
