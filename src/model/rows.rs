//! The rings of a limb's grid: those of its skeleton and those that the windows of its branches need, turned so that each
//! window lies under its branch.
//!
//! Rings are carried along without a turn and then turned about their axis by at most half a side from one window to the
//! next, evenly along the limb.
//!
//! Limits: of windows beside each other only the thickest one's branch decides how its rings are turned.

use super::joint::Exit;
use super::limbs::{COLLAR_LENGTH, Limb, Limbs};
use super::spine::{self, Ring};
use super::window;
use crate::geom::frame;
use crate::plant::junction::COLLAR;
use glam::{Quat, Vec3};
use std::f32::consts::TAU;

/// Rings closer than this share of a side's length are one.
const CLOSEST: f32 = 0.45;

/// A ring of a limb's grid.
#[derive(Clone, Copy)]
pub(super) struct Row {
    /// Length of the limb before it, metres.
    pub(super) arc: f32,
    pub(super) ring: Ring,
    /// Unit direction from its centre to its first point.
    pub(super) side: Vec3,
}

impl Row {
    fn new(arc: f32, ring: Ring) -> Self {
        Self { arc, ring, side: Vec3::ZERO }
    }

    /// The angle at which a direction lies around the ring.
    pub(super) fn angle_of(&self, direction: Vec3) -> f32 {
        direction.dot(self.ring.tangent.cross(self.side)).atan2(direction.dot(self.side))
    }
}

/// The grid of one limb, in memory that is used again for the next.
#[derive(Default)]
pub(super) struct Rows {
    pub(super) all: Vec<Row>,
    turns: Vec<Turn>,
}

impl Rows {
    /// Lays out the grid of a limb.
    pub(super) fn lay_out(&mut self, limbs: &Limbs, limb: &Limb) {
        lay_out(limbs, limb, &mut self.all);
        let first_side = match &limb.exit {
            Some(exit) => upward(exit),
            None => frame::hidden_side(self.all[0].ring.tangent),
        };
        transport(&mut self.all, first_side);
        align(limbs, limb, self);
    }
}

/// The rings of a limb's final grid: those of its skeleton, and those that its windows need.
fn lay_out(Limbs { rings, arcs, all: limbs, children, .. }: &Limbs, limb: &Limb, grid: &mut Vec<Row>) {
    let (own, along) = (&rings[limb.rings.clone()], &arcs[limb.rings.clone()]);
    let end = along[along.len() - 1];
    grid.clear();
    let start = limb.exit.map_or(0.0, |exit| exit.arc);
    let first =
        limb.exit.map_or(own[0].levelled(), |exit| Ring { radius: COLLAR * exit.ring.radius, ..exit.ring });
    grid.push(Row::new(start, first));
    let after_collar = start + limb.exit.map_or(0.0, |exit| COLLAR_LENGTH * exit.ring.radius);
    if limb.exit.is_some() && after_collar < end {
        grid.push(Row::new(after_collar, spine::at(own, along, after_collar)));
    }
    let kept = grid.len();
    grid.extend(
        own.iter()
            .zip(along)
            .filter(|(_, arc)| **arc > after_collar)
            .map(|(ring, arc)| Row::new(*arc, *ring)),
    );
    if grid.len() == 1 {
        grid.push(Row::new(end, own[own.len() - 1]));
    }
    for child in &children[limb.children.clone()] {
        let Some(exit) = limbs[*child as usize].exit else { continue };
        let low = exit.at - exit.half_length;
        let high = exit.at + exit.half_length;
        for arc in [low, high] {
            if arc > after_collar && arc < end {
                grid.push(Row::new(arc, spine::at(own, along, arc)));
            }
        }
    }
    grid[kept..].sort_by(|a, b| a.arc.total_cmp(&b.arc));
    thin(grid, kept, limb.sides());
}

/// Leaves out rings that are too close to the one before; the last one stays.
fn thin(grid: &mut Vec<Row>, kept: usize, sides: usize) {
    let Some(last) = grid.pop() else { return };
    let near = |a: &Row, b: &Row| {
        let side = TAU * a.ring.radius.max(b.ring.radius) / sides as f32;
        let turn = a.ring.radius * a.ring.tangent.distance(b.ring.tangent) * 1.1;
        b.arc - a.arc < (CLOSEST * side).max(turn)
    };
    let kept = kept.min(grid.len());
    let mut count = kept;
    for i in kept..grid.len() {
        if count == 0 || !near(&grid[count - 1], &grid[i]) {
            grid[count] = grid[i];
            count += 1;
        }
    }
    grid.truncate(count);
    while grid.len() > 1 && near(&grid[grid.len() - 1], &last) {
        grid.pop();
    }
    grid.push(last);
}

/// The direction in the plane of a branch's first ring that lies above it on the parent.
fn upward(exit: &Exit) -> Vec3 {
    let axis = exit.ring.tangent;
    let above = exit.upward.reject_from_normalized(axis);
    let above =
        if above.length_squared() > 1e-4 { above } else { -exit.outward.reject_from_normalized(axis) };
    above.try_normalize().unwrap_or_else(|| axis.any_orthonormal_vector())
}

/// Carries the direction to the first point from ring to ring without a turn.
fn transport(grid: &mut [Row], first_side: Vec3) {
    let mut side = first_side;
    for i in 0..grid.len() {
        if i > 0 {
            let (before, ring) = (&grid[i - 1].ring, &grid[i].ring);
            side = frame::transport(side, (before.at, before.tangent), (ring.at, ring.tangent));
        }
        grid[i].side = side;
    }
}

/// Turns rings about their axis so that the windows come to lie under what grows out of them: by at most half a side
/// from one window to the next, evenly along the limb. Of windows beside each other the thickest one's decides.
fn align(Limbs { all: limbs, children, .. }: &Limbs, limb: &Limb, Rows { all: grid, turns }: &mut Rows) {
    let per_side = TAU / limb.sides() as f32;
    turns.clear();
    for &child in &children[limb.children.clone()] {
        let Some(exit) = limbs[child as usize].exit else { continue };
        let span = (exit.at - exit.half_length, exit.at + exit.half_length);
        if turns.iter().any(|turn| turn.span.0 < span.1 && span.0 < turn.span.1) {
            continue;
        }
        let row = grid.partition_point(|row| row.arc < exit.at).min(grid.len() - 1);
        let columns = window::columns(exit.half_angle, limb.sides());
        let first = grid[row].angle_of(exit.outward) / per_side - 0.5 * columns as f32;
        turns.push(Turn { span, by: first - first.round() });
    }
    turns.sort_by(|a, b| a.span.0.total_cmp(&b.span.0));
    for i in 1..turns.len() {
        turns[i].by -= (turns[i].by - turns[i - 1].by).round();
    }
    let mut next = 0;
    for row in grid.iter_mut() {
        while next < turns.len() && turns[next].span.1 < row.arc {
            next += 1;
        }
        let by = match (next.checked_sub(1).map(|i| &turns[i]), turns.get(next)) {
            (Some(a), Some(b)) => {
                let share = (row.arc - a.span.1) / (b.span.0 - a.span.1).max(f32::MIN_POSITIVE);
                a.by + (b.by - a.by) * share.clamp(0.0, 1.0)
            }
            (one, other) => one.or(other).map_or(0.0, |turn| turn.by),
        };
        row.side = Quat::from_axis_angle(row.ring.tangent, by * per_side) * row.side;
    }
}

/// How far the rings of a window are turned, in sides.
struct Turn {
    /// Length of the limb before the window's ends.
    span: (f32, f32),
    by: f32,
}
