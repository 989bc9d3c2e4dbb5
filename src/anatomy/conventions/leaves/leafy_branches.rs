//! A branched stem, or a small tree, of single lines with leaves: each leaf an outline of its own at the end of a line or along it.
//!
//! The lines of a group that touch are branches, nearly straight and open, or leaves, closed and convex. There are at
//! least three branches, most of which begin at another one, and nearly every outline is rooted at one branch ([`Leaf`]).
//! Outlines at ends of lines are leaves if they are pointed away from there, for heads of flowers are round; those along lines
//! are leaves whatever their form. Several at one end are the petals of a flower.
//!
//! If one line carries three others at its upper end or above its middle and is bare below, it is the trunk of a tree.
//!
//! Limits: leaves with stalks of their own longer than a tenth of them; flowers on the same branches.

use super::leafy_stem::{END, Leaf, length};
use crate::anatomy::conventions::page::{self, Line, Page, even};
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::geom::polyline;
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Fewest branches and leaves, and most lines of a group.
const FEWEST: (usize, usize) = (3, 4);
const MOST: usize = 120;
/// Least chord of a branch over its length.
const STRAIGHT: f32 = 0.75;
/// Largest leaf, as a share of the group's diagonal, and least share of its hull that it fills.
const LARGE: f32 = 0.35;
const CONVEX: f32 = 0.92;
/// Least share of the group's length that branches and leaves are, and of the outlines that are leaves.
const EXPLAINED: f32 = 0.9;
const ROOTED: f32 = 0.8;
/// How near to a branch an outline begins that lies across it, as a share of its size.
const BEGINS: f32 = 0.15;
/// Least share of the branches but one that begin at another, and how near to it, as a share of the group's diagonal.
const JOINED: f32 = 0.7;
const AT: f32 = 0.04;
/// Distance of roots that are those of one flower, in sizes of a leaf, and fewest petals.
const FLOWER: (f32, usize) = (0.5, 4);
/// Widest angle at the tip of a leaf, radians, points of its outline, and how many of them to either side the angle is measured
/// over: that of a circle is 2.2.
const POINTED: (f32, usize, usize) = (2.0, 40, 6);
/// Least share of the leaves at ends that are pointed.
const MOSTLY: f32 = 0.65;
/// Fewest branches on a trunk, and its least bare part, as a share of the group's height.
const TRUNK: (usize, f32) = (3, 0.22);
/// Log-odds, and for each leaf: by itself each may be a flower.
const SCORE: (f32, f32) = (2.0, 4.6);

/// Proposes a branched stem for each group of lines.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    out.extend(page.groups.iter().chain(&page.wide_groups).filter_map(|group| branched(page, group)));
}

fn branched(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    if group.len() > MOST || group.len() < FEWEST.0 + FEWEST.1 {
        return None;
    }
    let (low, high) = page::bounds(group.iter().map(|i| &page.lines[*i]));
    let size = high - low;
    let is_leaf = |i: &usize| is_outline(&page.lines[*i], LARGE * size.length());
    let (outlines, lines): (Vec<usize>, Vec<usize>) = group.iter().partition(|i| is_leaf(i));
    let is_branch = |i: &usize| {
        let line = &page.lines[*i];
        line.ends().0.distance(line.ends().1) > STRAIGHT * line.length
    };
    let branches: Vec<Branch> = lines.into_iter().filter(is_branch).map(|i| Branch::new(page, i)).collect();
    if branches.len() < FEWEST.0
        || outlines.len() < FEWEST.1
        || !are_joined(&branches, AT * size.length())
        || enclose(&branches, AT * size.length())
    {
        return None;
    }
    let leaves: Vec<(Leaf, usize)> = outlines.iter().filter_map(|i| at_branch(page, *i, &branches)).collect();
    if (leaves.len() as f32) < ROOTED * outlines.len() as f32 || !are_leaves(page, &leaves) {
        return None;
    }
    let mut uses: Vec<usize> = branches.iter().map(|branch| branch.number).collect();
    uses.extend(leaves.iter().map(|(leaf, _)| leaf.line));
    uses.sort_unstable();
    if length(page, &uses) < EXPLAINED * length(page, group) {
        return None;
    }
    let is_leafy = |place: usize| leaves.iter().any(|(_, branch)| *branch == place);
    let habit = has_trunk(&branches, is_leafy, size).then_some(Habit::Tree);
    let score = (SCORE.0 + SCORE.1 * leaves.len() as f32) * page.weight(size.length());
    let outlines = leaves.into_iter().map(|(leaf, _)| Made::new(Tool::Leaf, leaf.ring));
    let parts =
        branches.into_iter().map(|branch| Made::new(Tool::Branch, branch.way)).chain(outlines).collect();
    Some(Hypothesis { uses, score, parts, solids: Vec::new(), reading: Reading::Leaf, habit })
}

/// A line that leaves are rooted at, from its lower end.
struct Branch {
    number: usize,
    way: Vec<Vec2>,
    length: f32,
}

impl Branch {
    fn new(page: &Page, number: usize) -> Self {
        let line = &page.lines[number];
        Self { number, way: line.upward(), length: line.length }
    }

    fn gap(&self, place: Vec2) -> f32 {
        polyline::nearest(&self.way, place).map_or(f32::INFINITY, |(gap, _)| gap)
    }
}

/// Whether a line may be the outline of a leaf.
fn is_outline(line: &Line, largest: f32) -> bool {
    line.is_closed_and_solid()
        && !line.is_scribble()
        && line.solidity() > CONVEX
        && line.size().max_element() < largest
}

/// Whether nearly all of some branches but one begin at another.
fn are_joined(branches: &[Branch], near: f32) -> bool {
    let begins = |own: &&Branch| {
        let others = branches.iter().filter(|other| other.number != own.number);
        let ends = [own.way[0], own.way[own.way.len() - 1]];
        others.into_iter().any(|other| ends.iter().any(|end| other.gap(*end) < near))
    };
    branches.iter().filter(begins).count() as f32 > JOINED * (branches.len() - 1) as f32
}

/// Whether two branches end at one tip, where no third is: the edges of a petal or of a leaf.
fn enclose(branches: &[Branch], near: f32) -> bool {
    let tip = |branch: &Branch| branch.way[branch.way.len() - 1];
    let is_at = |branch: &Branch, place: Vec2| branch.gap(place) < near;
    let meet_alone = |(a, b): (&Branch, &Branch)| {
        tip(a).distance(tip(b)) < near && branches.iter().filter(|third| is_at(third, tip(a))).count() == 2
    };
    branches.iter().enumerate().any(|(k, a)| branches[k + 1..].iter().any(|b| meet_alone((a, b))))
}

/// An outline as the leaf of the branch at which its root is nearest, with that branch's place among all. What lies across its branch grows
/// from where it was begun.
fn at_branch(page: &Page, outline: usize, branches: &[Branch]) -> Option<(Leaf, usize)> {
    let line = &page.lines[outline];
    let of = |(place, branch): (usize, &Branch)| {
        let leaf = Leaf::new(outline, line, &branch.way, branch.length)?;
        Some((branch.gap(leaf.ring[0]), (leaf, place)))
    };
    let least = |a: &(f32, (Leaf, usize)), b: &(f32, (Leaf, usize))| a.0.total_cmp(&b.0);
    let across = |(place, branch): (usize, &Branch)| {
        let begin = line.ends().0;
        let (gap, arc) = polyline::nearest(&branch.way, begin)?;
        let leaf = Leaf { line: outline, ring: line.points.clone(), share: arc / branch.length };
        (gap < BEGINS * line.size().max_element()).then_some((gap, (leaf, place)))
    };
    let beside = branches.iter().enumerate().filter_map(of).min_by(least);
    let found = beside.or_else(|| branches.iter().enumerate().filter_map(across).min_by(least));
    found.map(|(_, leaf)| leaf)
}

/// Whether outlines are leaves of their branches, and not the heads or the petals of flowers.
fn are_leaves(page: &Page, leaves: &[(Leaf, usize)]) -> bool {
    let at_ends: Vec<&(Leaf, usize)> = leaves.iter().filter(|(leaf, _)| leaf.share > END).collect();
    let is_of_flower = |(own, _): &(Leaf, usize)| {
        let near = FLOWER.0 * page.lines[own.line].size().max_element();
        leaves.iter().filter(|(other, _)| other.ring[0].distance(own.ring[0]) < near).count() >= FLOWER.1
    };
    let pointed = at_ends.iter().filter(|leaf| is_pointed(&leaf.0.ring)).count();
    let along = leaves.len() - at_ends.len();
    !leaves.iter().any(is_of_flower)
        && (pointed as f32 >= MOSTLY * at_ends.len() as f32 || along > 2 * at_ends.len())
}

/// Whether an outline has a tip where it is farthest from its first point.
fn is_pointed(ring: &[Vec2]) -> bool {
    let (_, count, reach) = POINTED;
    let points = &even(ring, count + 1)[..count];
    let far = |i: &usize| points[*i].distance_squared(ring[0]);
    let Some(tip) = (0..count).max_by(|a, b| far(a).total_cmp(&far(b))) else { return false };
    let side = |by: usize| points[(tip + by) % count] - points[tip];
    side(reach).angle_to(side(count - reach)).abs() < POINTED.0
}

/// Whether the lowest of some branches is bare below and carries others with leaves above its middle.
fn has_trunk(branches: &[Branch], is_leafy: impl Fn(usize) -> bool, size: Vec2) -> bool {
    let lowest = |a: &&Branch, b: &&Branch| a.way[0].y.total_cmp(&b.way[0].y);
    let Some(trunk) = branches.iter().max_by(lowest) else { return false };
    let (foot, top) = (trunk.way[0], trunk.way[trunk.way.len() - 1]);
    let others = || branches.iter().enumerate().filter(|(_, other)| other.number != trunk.number);
    let bare = others().map(|(_, other)| foot.y - other.way[0].y).fold(f32::INFINITY, f32::min);
    let begins = |(place, other): &(usize, &Branch)| {
        let base = other.way[0];
        is_leafy(*place) && trunk.gap(base) < AT * size.length() && base.y < foot.midpoint(top).y
    };
    bare > TRUNK.1 * size.y && others().filter(begins).count() >= TRUNK.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;
    use std::f32::consts::TAU;

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    /// The tips of four branches from the top of a trunk at (0, -120).
    const TIPS: [(f32, f32); 4] = [(-90.0, -190.0), (-40.0, -240.0), (40.0, -240.0), (90.0, -190.0)];

    fn branches() -> Vec<Vec<Vec2>> {
        let branch = |tip: (f32, f32)| line(&[(0.0, -120.0), tip]);
        [line(&[(0.0, 0.0), (1.0, -120.0)])].into_iter().chain(TIPS.map(branch)).collect()
    }

    /// A lens or a circle from the tip of a branch on.
    fn at(tip: (f32, f32), is_lens: bool) -> Vec<Vec2> {
        let tip = Vec2::from(tip);
        let along = 36.0 * (tip - Vec2::new(0.0, -120.0)).normalize();
        let place = |k: usize| {
            let t = k as f32 / 40.0;
            if !is_lens {
                return tip + 0.5 * along - 0.5 * along.rotate(Vec2::from_angle(TAU * t));
            }
            let (u, sign) = if t < 0.5 { (2.0 * t, 1.0) } else { (2.0 - 2.0 * t, -1.0) };
            tip + u * along + 1.3 * sign * u * (1.0 - u) * along.perp()
        };
        (0..=40).map(place).collect()
    }

    #[test]
    fn pointed_outlines_at_the_ends_of_branches_are_the_leaves_of_a_tree() {
        let found = read(&[branches(), TIPS.map(|tip| at(tip, true)).to_vec()].concat());
        let [tree] = &found[..] else { panic!("{} trees", found.len()) };
        assert_eq!((tree.uses.len(), tree.habit), (9, Some(Habit::Tree)));
        let of = |tool: Tool| tree.parts.iter().filter(|part| part.tool == tool).count();
        assert_eq!((of(Tool::Branch), of(Tool::Leaf)), (5, 4));
        let roots = tree.parts[5..].iter().zip(TIPS);
        assert!(roots.into_iter().all(|(leaf, tip)| leaf.points[0].position.distance(Vec2::from(tip)) < 4.0));
    }

    #[test]
    fn round_heads_petals_and_bare_branches_are_none() {
        assert!(read(&[branches(), TIPS.map(|tip| at(tip, false)).to_vec()].concat()).is_empty());
        assert!(read(&branches()).is_empty());
        let petal = |k: usize| {
            let (tip, turn) = (Vec2::from(TIPS[1]), Vec2::from_angle(-1.2 + 0.4 * k as f32));
            at(TIPS[1], true).into_iter().map(|p| tip + (p - tip).rotate(turn)).collect::<Vec<Vec2>>()
        };
        assert!(read(&[branches(), (0..6).map(petal).collect()].concat()).is_empty());
    }
}
