//! What a plant begins with: a seed at the ground, a trunk up to its crown, or drawn branches.
//!
//! Drawn branches become nodes about an internode apart, with one wherever another branch begins. They carry buds like
//! grown wood, and stay at least as thick as they were drawn.

use crate::geom::polyline::length;
use crate::growth::habit::Habit;
use crate::growth::tree::{NewNode, Tree};
use crate::growth::year::direction;
use crate::plant::{Branch, Plant};
use crate::random::{Choice, mix, unit};
use glam::Vec3;
use std::f32::consts::TAU;

/// Most nodes of a skeleton; longer internodes are taken where it would have more.
const MOST: f32 = 20_000.0;

/// Least distance of nodes that are not a step apart, in steps.
const APART: f32 = 0.25;

/// Distance between the feet of a plant with several trunks, in internodes.
const FEET_APART: f32 = 0.6;

/// Plants the seeds of all trunks of a habit about `foot`.
pub(super) fn sow(tree: &mut Tree, habit: &Habit, foot: Vec3, seed: u64) {
    let stems = habit.stems.max(1);
    for k in 0..stems {
        let key = mix(Choice::STEM.key(seed), u64::from(k));
        let azimuth = TAU * ((k as f32 + 0.5 * unit(key)) / stems as f32 + Choice::FIRST_STEM.unit(seed));
        let out = Vec3::new(azimuth.cos(), 0.0, azimuth.sin());
        let several = stems > 1;
        let lean = if several {
            habit.stem_lean.to_radians() * (0.4 + 0.6 * Choice::STEM_LEAN.unit(key))
        } else {
            0.0
        };
        let direction = (Vec3::Y * lean.cos() + out * lean.sin()).normalize();
        let apart = if several { FEET_APART * habit.internode } else { 0.0 };
        let node = tree.add_foot(foot + out * apart, direction::first_side(direction, key, habit));
        tree.add_bud(node, direction, true, 0);
    }
}

/// A straight trunk without buds but at its end, from `foot` to `crown`.
pub(super) fn trunk(tree: &mut Tree, habit: &Habit, foot: Vec3, crown: Vec3, seed: u64) {
    let way = crown - foot;
    let direction = way.try_normalize().unwrap_or(Vec3::Y);
    let mut node = tree.add_foot(foot, direction::first_side(direction, Choice::TRUNK.key(seed), habit));
    let steps = (way.length() / habit.internode).ceil().clamp(0.0, MOST) as u32;
    for k in 1..=steps {
        let at = foot.lerp(crown, k as f32 / steps as f32);
        let side = tree.nodes.side[node as usize];
        node = tree.add(NewNode { parent: node, at, side, lateral: false, year: 0 });
    }
    tree.add_bud(node, direction, true, 0);
}

/// Makes nodes and buds of drawn branches. A plant without branches gives an empty tree.
pub(super) fn of_plant(plant: &Plant, habit: &Habit, seed: u64) -> Tree {
    let mut tree = Tree::default();
    let wood: f32 = plant.branches.iter().map(|b| length(&b.points)).sum();
    let step = habit.internode.max(wood / MOST);
    // First node and number of nodes of each branch.
    let mut spans: Vec<(u32, u32)> = Vec::with_capacity(plant.branches.len());
    let mut buds = Vec::new();
    let forks = forks(plant);
    for (index, branch) in plant.branches.iter().enumerate() {
        let key = mix(Choice::DRAWN_BRANCH.key(seed), index as u64);
        let span = branch.parent.and_then(|p| spans.get(p).copied());
        let first = tree.len() as u32;
        let mut nodes = Vec::new();
        let samples = resampled(branch, &forks[index], step);
        let direction = samples.get(1).map_or(Vec3::Y, |s| (s.0 - samples[0].0).normalize_or(Vec3::Y));
        let mut side = direction::first_side(direction, key, habit);
        let mut below = match span.filter(|span| span.1 > 0) {
            Some((from, count)) => nearest(&tree, from, count, samples[0].0),
            None => {
                let foot = tree.add_foot(samples[0].0, side);
                tree.given.push(2.0 * samples[0].1);
                tree.drawn.push(index as u32);
                foot
            }
        };
        let mut before = direction;
        // The hand may leave a gap to the parent, which is bridged.
        let gap = span.is_some() && tree.nodes.at[below as usize].distance(samples[0].0) > APART * step;
        let first_new = usize::from(!gap);
        for (k, &(at, radius)) in samples.iter().enumerate().skip(first_new) {
            let way = (at - tree.nodes.at[below as usize]).normalize_or(before);
            let order = tree.nodes.order[below as usize];
            side = direction::next_side(side, (before, way), (order, 0.0), habit);
            let lateral = k == first_new && span.is_some();
            below = tree.add(NewNode { parent: below, at, side, lateral, year: 0 });
            tree.given.push(2.0 * radius);
            tree.drawn.push(index as u32);
            nodes.push((below, way, side));
            before = way;
        }
        spans.push((first, tree.len() as u32 - first));
        buds.push(nodes);
    }
    for nodes in buds {
        lay_buds(&mut tree, &nodes, habit);
    }
    tree
}

/// Lateral buds at every node of a branch and an apical one at its end.
fn lay_buds(tree: &mut Tree, nodes: &[(u32, Vec3, Vec3)], habit: &Habit) {
    let angle = habit.branching.at(0.0).to_radians();
    for (k, &(node, way, side)) in nodes.iter().enumerate() {
        let order = tree.nodes.order[node as usize];
        for bud in direction::laterals(way, side, angle, direction::laterals_per_node(habit, order)) {
            tree.add_bud(node, bud, false, 0);
        }
        if k + 1 == nodes.len() {
            tree.add_bud(node, way, true, 0);
        }
    }
}

fn nearest(tree: &Tree, from: u32, count: u32, at: Vec3) -> u32 {
    let away = |i: &u32| tree.nodes.at[*i as usize].distance_squared(at);
    (from..from + count).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(from)
}

/// Where along each branch others stand on it, metres from its base, rising.
fn forks(plant: &Plant) -> Vec<Vec<f32>> {
    let mut forks: Vec<Vec<f32>> = vec![Vec::new(); plant.branches.len()];
    for branch in &plant.branches {
        let parent = branch.parent.and_then(|p| Some((p, plant.branches.get(p)?)));
        if let Some(((index, parent), base)) = parent.zip(branch.points.first()) {
            forks[index].push(nearest_arc(&parent.points, *base));
        }
    }
    forks.iter_mut().for_each(|arcs| arcs.sort_unstable_by(f32::total_cmp));
    forks
}

/// How far along a line its point nearest to `at` is.
fn nearest_arc(line: &[Vec3], at: Vec3) -> f32 {
    let (mut best, mut walked) = ((f32::INFINITY, 0.0), 0.0);
    for w in line.windows(2) {
        let (way, run) = (w[1] - w[0], w[0].distance(w[1]));
        let share = ((at - w[0]).dot(way) / (run * run).max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
        let away = at.distance_squared(w[0] + way * share);
        if away < best.0 {
            best = (away, walked + run * share);
        }
        walked += run;
    }
    best.1
}

/// Where the nodes of a branch are, metres from its base: at its ends, at its forks unless these lie closer than
/// [`APART`], and about a step apart between them.
fn stations(whole: f32, forks: &[f32], step: f32) -> Vec<f32> {
    let mut out = vec![0.0];
    let apart = APART * step;
    let inner = forks.iter().copied().filter(|arc| *arc < whole - apart);
    for stop in inner.chain([whole]) {
        let from = out.last().copied().unwrap_or(0.0);
        if stop - from < apart && stop < whole {
            continue;
        }
        let count = ((stop - from) / step).round().max(1.0) as usize;
        out.extend((1..=count).map(|k| from + (stop - from) * k as f32 / count as f32));
    }
    out
}

/// Places and radii along a branch at its stations; at least two.
fn resampled(branch: &Branch, forks: &[f32], step: f32) -> Vec<(Vec3, f32)> {
    let stations = stations(length(&branch.points), forks, step);
    let mut out = Vec::with_capacity(stations.len());
    let (mut segment, mut before) = (0, 0.0);
    let last = branch.points.len().saturating_sub(2);
    for target in stations {
        let run = |s: usize| branch.points[s].distance(branch.points[s + 1]);
        while segment < last && before + run(segment) < target {
            before += run(segment);
            segment += 1;
        }
        let share = ((target - before) / run(segment).max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
        let radius = branch.radii[segment] + (branch.radii[segment + 1] - branch.radii[segment]) * share;
        out.push((branch.points[segment].lerp(branch.points[segment + 1], share), radius));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_branch_begins_at_a_node_of_its_parent() {
        assert_eq!(stations(1.0, &[], 0.25), [0.0, 0.25, 0.5, 0.75, 1.0]);
        assert_eq!(stations(1.0, &[0.3], 0.5), [0.0, 0.3, 1.0]);
        assert_eq!(stations(1.0, &[0.01, 0.5, 0.51, 0.99], 0.5), [0.0, 0.5, 1.0]);
        assert_eq!(stations(0.0, &[], 0.5).len(), 2);
        let line = [Vec3::ZERO, Vec3::Y, Vec3::new(1.0, 1.0, 0.0)];
        assert!((nearest_arc(&line, Vec3::new(0.4, 1.3, 0.0)) - 1.4).abs() < 1e-6);
    }
}
