//! Depth of branches: the children of a branch turn around it until their directions are spread as far as length
//! allows (maximum entropy; 000 §4.2, 002 §5.2 eq. 4).
//!
//! Only depth is found, x and y stay the drawing's: the front view is the drawing, and a child keeps its side of the
//! parent whatever its angle. The unknown of a child is the angle ψ between its chord and the drawing plane. For the
//! children of each branch `α · mean ln |uᵢ − uⱼ| − β · mean (1/cos ψ − 1)` is maximised, u being their unit directions
//! in space, by coordinate ascent from normally distributed angles: each child in turn takes the best of a grid of
//! angles, refined by a parabola. Trunks stay in the plane z = 0; a child starts at its parent's depth where it is
//! attached.
//!
//! Departs from eq. 4 in the logarithm: a plain sum of angles is content with two clumps, one turned to each side,
//! while the mean logarithm of distances (the nearest-neighbour estimate of entropy) sets every child apart. ψ keeps
//! within a limit at which no branch grows beyond a multiple of its drawn length, as the errata ask.
//!
//! Where a network tells how far wood leaves the drawing's plane ([`DepthField`]), a child's angle is drawn to the one that takes its
//! end so far, to whichever side spreads the children best: which side it is no drawing says (001 ch. 3).
//!
//! A child is compared with a fixed number of neighbours along the parent, so time grows linearly with the number of
//! branches, also where one branch carries thousands. Limit: branches of different parents do not see each other.

use crate::anatomy::FlatBranch;
use crate::geom::polyline;
use crate::kept::Kept;
use crate::learned_depth::DepthField;
use crate::random::stream;
use glam::{Vec2, Vec3};
use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use std::f32::consts::TAU;
use std::sync::Arc;

crate::parameters! {
    /// How branches leave the drawing plane.
    pub struct BranchDepthParams {
        /// How strongly the branches of one parent spread away from each other.
        spread: f32 = 1.0, 0.0..=10.0, "";
        /// How strongly branches resist growing longer than drawn.
        stretch: f32 = 1.0, 0.0..=10.0, "";
        /// Largest angle between a branch and the drawing plane.
        max_angle: f32 = 50.0, 0.0..=80.0, "degrees";
        /// Longest a branch may become.
        max_stretch: f32 = 1.6, 1.0..=4.0, "of its drawn length";
        /// Standard deviation of the chance in each branch's angle.
        jitter: f32 = 6.0, 0.0..=30.0, "degrees";
    }
}

/// Neighbours along the parent, to either side, with which a child is compared.
const REACH: usize = 8;
/// Angles tried per child and sweep.
const GRID: usize = 17;
/// Most sweeps over a parent's children.
const SWEEPS: usize = 3;
/// Squared distance of directions below which nearness makes no difference; keeps the logarithm finite.
const NEAR: f32 = 0.01;
/// How strongly a network's word draws the angles of branches, against their spread.
const PULL: f32 = 4.0;
/// Sweeps end when no angle moves farther, radians.
const SETTLED: f32 = 0.02;
/// How much faster depth grows at a branch's base than on average: branches bend instead of standing like spokes.
const EASE: f32 = 0.3;

/// What is kept of one drawing's branches for the next, all spread with the same parameters: the angles of the children of
/// one parent, by all that they are found from.
#[derive(Debug, Default)]
pub struct Spreads(Kept<SpreadKey, Arc<[f32]>>);

impl Spreads {
    /// For a single drawing, of which nothing is kept.
    pub fn for_one_build() -> Self {
        Self(Kept::for_one_call())
    }
}

/// The seed; name, chord and [`Goal`] of every child, in their order along the parent.
type SpreadKey = (u64, Vec<(u64, [u32; 2], [u32; 2])>);

/// Depth in pixels toward the viewer of every sample of every branch, in the order of `branches` (parents before
/// children). The same `seed` gives the same depths.
pub fn branch_depths(branches: &[FlatBranch], params: &BranchDepthParams, seed: u64) -> Vec<Vec<f32>> {
    branch_depths_with(&mut Spreads::for_one_build(), branches, (None, 0.0), params, seed)
}

/// The same again and again while a drawing changes, and by a share of what a network is to be believed as far from the drawing's plane as
/// that tells.
pub fn branch_depths_with(
    known: &mut Spreads,
    branches: &[FlatBranch],
    (field, share): (Option<&DepthField>, f32),
    params: &BranchDepthParams,
    seed: u64,
) -> Vec<Vec<f32>> {
    let grid = Grid::new(params, params.max_angle.to_radians().min(steepest(params.max_stretch)));
    let jitter = params.jitter.to_radians();
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); branches.len()];
    for (i, branch) in branches.iter().enumerate() {
        if let Some(parent) = branch.parent.filter(|&p| p < i) {
            children[parent].push(i);
        }
    }
    let mut families: Vec<(usize, Vec<usize>)> =
        children.into_iter().enumerate().filter(|(_, siblings)| !siblings.is_empty()).collect();
    for (_, siblings) in &mut families {
        siblings.sort_by(|&a, &b| branches[a].attached_at.total_cmp(&branches[b].attached_at));
    }
    let goal = |i: usize| field.map_or(Goal::NONE, |field| Goal::of(&branches[i], field, share));
    let key = |(_, siblings): &(usize, Vec<usize>), _| {
        let child = |&i: &usize| {
            let chord = chord_of(&branches[i]).to_array().map(f32::to_bits);
            (branches[i].key, chord, goal(i).words())
        };
        (seed, siblings.iter().map(child).collect())
    };
    let angles = known.0.made(&families, key, |(_, siblings)| {
        let mut around: Vec<Child> =
            siblings.iter().map(|&i| Child::new(&branches[i], goal(i), seed)).collect();
        spread(&mut around, &grid, jitter);
        around.iter().map(|child| child.angle).collect()
    });
    let mut depths: Vec<Vec<f32>> = branches.iter().map(|b| vec![0.0; b.line.len()]).collect();
    for ((parent, siblings), angles) in families.iter().zip(angles) {
        let run = arc_lengths(&branches[*parent]);
        for (&i, &angle) in siblings.iter().zip(angles.iter()) {
            let start = interpolated(&run, &depths[*parent], branches[i].attached_at);
            depths[i] = along(&branches[i], start, rise(chord_of(&branches[i]), angle));
        }
    }
    depths
}

/// From base to end in the drawing, pixels.
fn chord_of(branch: &FlatBranch) -> Vec2 {
    let ends = branch.line.first().zip(branch.line.last());
    ends.map_or(Vec2::ZERO, |(base, end)| end.position - base.position)
}

/// Depth of the end of a branch above its base, pixels.
fn rise(chord: Vec2, angle: f32) -> f32 {
    chord.length() * angle.tan()
}

/// Largest angle at which no branch exceeds `max_stretch` times its drawn length.
///
/// With depth D·e(t) along a length l, e' having mean 1 and mean square 1 + EASE²/3, the length in space is at most
/// l·√(1 + (D/l)²·(1 + EASE²/3)), and D = chord · tan ψ ≤ l · tan ψ.
fn steepest(max_stretch: f32) -> f32 {
    ((max_stretch * max_stretch - 1.0).max(0.0) / (1.0 + EASE * EASE / 3.0)).sqrt().atan()
}

/// How steeply a network wants a branch to leave the drawing's plane, to whichever side.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Goal {
    /// Tangent of its angle to the plane.
    slope: f32,
    /// How much that counts, 0 to 1.
    weight: f32,
}

impl Goal {
    const NONE: Self = Self { slope: 0.0, weight: 0.0 };

    /// Ways out of the plane add up as those of a random walk, so the branch's own is the root of the difference of squares.
    fn of(branch: &FlatBranch, field: &DepthField, share: f32) -> Self {
        let ends = branch.line.first().zip(branch.line.last());
        let Some((base, end)) = ends else { return Self::NONE };
        let (from, to) = (field.away(base.position), field.away(end.position));
        let chord = base.position.distance(end.position).max(f32::MIN_POSITIVE);
        Self { slope: (to * to - from * from).max(0.0).sqrt() / chord, weight: share * field.belief() }
    }

    fn words(self) -> [u32; 2] {
        [self.slope, self.weight].map(f32::to_bits)
    }
}

/// A branch as its siblings see it.
#[derive(Clone, Copy, Debug)]
struct Child {
    /// Unit direction of the chord, zero for a branch that ends where it begins.
    heading: Vec2,
    /// Angle to the drawing plane, radians.
    angle: f32,
    /// Its share of chance, standard normal.
    chance: f32,
    goal: Goal,
}

impl Child {
    fn new(branch: &FlatBranch, goal: Goal, seed: u64) -> Self {
        let chord = chord_of(branch);
        let chance = normal(&mut stream(seed, "branch depth", branch.key));
        Self { heading: chord.normalize_or_zero(), angle: 0.0, chance, goal }
    }

    fn direction(&self) -> Vec3 {
        let (sin, cos) = self.angle.sin_cos();
        (self.heading * cos).extend(sin)
    }
}

/// Standard normal number (Box–Muller).
fn normal(rng: &mut Pcg64Mcg) -> f32 {
    let (u, v): (f32, f32) = (rng.random(), rng.random());
    (-2.0 * (1.0 - u).ln()).sqrt() * (TAU * v).cos()
}

/// The angles a child may take, evenly spaced over ±limit, with what each is worth by itself.
struct Grid {
    limit: f32,
    step: f32,
    cos: [f32; GRID],
    sin: [f32; GRID],
    /// Penalty for length.
    cost: [f32; GRID],
    /// Weight of one unit of entropy.
    spread: f32,
}

impl Grid {
    fn new(params: &BranchDepthParams, limit: f32) -> Self {
        let step = 2.0 * limit / (GRID - 1) as f32;
        let angles: [f32; GRID] = std::array::from_fn(|i| step * i as f32 - limit);
        Self {
            limit,
            step,
            cos: angles.map(f32::cos),
            sin: angles.map(f32::sin),
            cost: angles.map(|angle| params.stretch * (1.0 / angle.cos() - 1.0)),
            spread: params.spread,
        }
    }

    /// The angle of greatest entropy for a child while its neighbours' directions stand still.
    fn best_angle(&self, child: &Child, (before, after): (&[Vec3], &[Vec3])) -> f32 {
        // One logarithm of a product is cheaper than many; 2·REACH factors between NEAR and 4 stay in range.
        let mut product = [1.0f32; GRID];
        for v in before.iter().chain(after) {
            let flat = child.heading.dot(v.truncate());
            for (i, p) in product.iter_mut().enumerate() {
                *p *= (2.0 + NEAR - 2.0 * (flat * self.cos[i] + v.z * self.sin[i])).max(NEAR);
            }
        }
        let weight = 0.5 * self.spread / (before.len() + after.len()).max(1) as f32;
        let Goal { slope, weight: pull } = child.goal;
        let cost = |i: usize| {
            let off = (self.sin[i] / self.cos[i]).abs() - slope;
            (1.0 - pull) * self.cost[i] + pull * PULL * off * off
        };
        let scores: [f32; GRID] = std::array::from_fn(|i| weight * product[i].ln() - cost(i));
        let best = (1..GRID).fold(0, |best, i| if scores[i] > scores[best] { i } else { best });
        let angle = self.step * best as f32 - self.limit;
        if best == 0 || best == GRID - 1 {
            return angle;
        }
        let (lower, upper) = (scores[best - 1], scores[best + 1]);
        let bend = lower - 2.0 * scores[best] + upper;
        angle + if bend < 0.0 { 0.5 * self.step * (lower - upper) / bend } else { 0.0 }
    }
}

/// Chooses the angles of a parent's children, given in their order along the parent.
fn spread(children: &mut [Child], grid: &Grid, jitter: f32) {
    for child in children.iter_mut() {
        child.angle = (child.chance * jitter).clamp(-grid.limit, grid.limit);
    }
    let mut directions: Vec<Vec3> = children.iter().map(Child::direction).collect();
    for _ in 0..SWEEPS {
        let mut moved = 0.0f32;
        for k in 0..children.len() {
            let angle = grid.best_angle(&children[k], neighbours(&directions, k));
            moved = moved.max((angle - children[k].angle).abs());
            children[k].angle = angle;
            directions[k] = children[k].direction();
        }
        if moved < SETTLED {
            break;
        }
    }
    for child in children.iter_mut() {
        child.angle = (child.angle + child.chance * jitter).clamp(-grid.limit, grid.limit);
    }
}

/// Directions of the children next to child `k`, before and after it.
fn neighbours(directions: &[Vec3], k: usize) -> (&[Vec3], &[Vec3]) {
    let last = (k + 1 + REACH).min(directions.len());
    (&directions[k.saturating_sub(REACH)..k], &directions[k + 1..last])
}

/// Arc length at each sample of a branch, pixels.
fn arc_lengths(branch: &FlatBranch) -> Vec<f32> {
    polyline::arc_lengths(branch.line.iter().map(|sample| sample.position))
}

/// Value at arc length `at` of a quantity known at the samples, held constant beyond the ends.
fn interpolated(run: &[f32], values: &[f32], at: f32) -> f32 {
    let after = run.partition_point(|&s| s < at);
    if after == 0 || after == run.len() {
        return if after == 0 { values.first() } else { values.last() }.copied().unwrap_or(0.0);
    }
    let share = (at - run[after - 1]) / (run[after] - run[after - 1]);
    values[after - 1] + (values[after] - values[after - 1]) * share
}

/// Depths along a branch that starts at `start` and ends `rise` above it.
fn along(branch: &FlatBranch, start: f32, rise: f32) -> Vec<f32> {
    let run = arc_lengths(branch);
    let length = run.last().copied().unwrap_or(0.0).max(f32::MIN_POSITIVE);
    run.iter()
        .map(|s| {
            let t = s / length;
            start + rise * t * (1.0 + EASE * (1.0 - t))
        })
        .collect()
}

#[cfg(test)]
#[path = "branch_depth_tests.rs"]
mod tests;
