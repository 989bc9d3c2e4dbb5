//! Who gets how much: the priority model (001 §2.3.2, eqs. 2.5 and 2.6).
//!
//! An axis is looked at as a whole. Its buds and the branches it carries stand in a queue by what they earn per bud, the
//! apical bud first where the plant has apical dominance. The i-th of N gets v·Q_i·ω_i / ΣQ_jω_j with weights that fall
//! from ω_max straight to ω_min at the share κ of the queue and stay there. A small κ makes one leader. Buds without
//! resource, and branches whose buds have none, do not stand in the queue: they would get nothing, yet move the others.
//!
//! Where we depart: eq. 2.6 counts the places from 1, so that the first has ω_max for κN < 1, but ω_min like all others
//! at κN = 1: the leader of a queue of two is lost between κ = 0.49 and 0.5. We count from 0. The first always has ω_max,
//! which no habit lets be 0, so that nothing is lost even with ω_min = 0; the weights of all others change continuously
//! with κ. κN is not rounded; with κ = 0 the first has ω_max, all others ω_min.

use super::vigour::Flow;
use crate::growth::tree::{NONE, Tree};

/// Numbers of eq. 2.6.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Priority {
    /// κ: share of the queue over which the weight falls.
    pub kappa: f32,
    /// ω_max, above 0.
    pub most: f32,
    /// ω_min, 0 to ω_max.
    pub least: f32,
    /// Whether the apical bud stands first.
    pub apical_first: bool,
}

impl Priority {
    /// The weight ω of place `i` of `count`, counted from 0.
    pub(crate) fn weight(&self, i: usize, count: usize) -> f32 {
        if i == 0 {
            return self.most;
        }
        let fallen = (i as f32 / (self.kappa * count as f32)).min(1.0);
        self.most - (self.most - self.least) * fallen
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
pub(crate) fn share_out(
    flow: &mut Flow,
    tree: &Tree,
    q: &[f32],
    supply: f32,
    priority: impl Fn(u8) -> Priority,
) {
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
        let weights: Vec<f32> = (0..queue.len()).map(|i| queue[i].q * rule.weight(i, queue.len())).collect();
        // Above 0 for the first; the bound is for what only numbers too small for 32 bits could lead to.
        let whole: f32 = weights.iter().sum::<f32>().max(f32::MIN_POSITIVE);
        for (member, weight) in queue.iter().zip(&weights) {
            let share = v[axis] * (weight / whole);
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

    const RULE: Priority = Priority { kappa: 0.5, most: 1.0, least: 0.0, apical_first: true };

    fn weights(rule: Priority, count: usize) -> Vec<f32> {
        (0..count).map(|i| rule.weight(i, count)).collect()
    }

    #[test]
    fn weights_fall_straight_and_stay() {
        assert_eq!(weights(RULE, 8), [1.0, 0.75, 0.5, 0.25, 0.0, 0.0, 0.0, 0.0]);
        let one = Priority { kappa: 0.0, least: 0.25, ..RULE };
        assert_eq!(weights(one, 3), [1.0, 0.25, 0.25]);
        assert_eq!(weights(Priority { kappa: 1.0, ..RULE }, 4), [1.0, 0.75, 0.5, 0.25]);
    }

    #[test]
    fn the_first_leads_and_weights_change_gently_with_kappa() {
        for count in 1..=12 {
            let mut last = weights(Priority { kappa: 0.0, least: 0.006, ..RULE }, count);
            for step in 1..=4000 {
                let now = weights(Priority { kappa: step as f32 / 4000.0, least: 0.006, ..RULE }, count);
                assert_eq!(now[0], 1.0, "the first leads: κ = {step}/4000 of {count}");
                assert!(now.iter().rev().is_sorted() && now.iter().all(|w| (0.0059..=1.0).contains(w)));
                for (now, last) in now.iter().zip(&last) {
                    assert!(now + 1e-6 >= *last, "a larger κ favours nobody less");
                    assert!(now - last < 0.02, "κ = {step}/4000 of {count}: {last} to {now}");
                }
                last = now;
            }
        }
    }
}
