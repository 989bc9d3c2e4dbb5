//! All branches of one plant as a single closed surface, whatever barks they wear.
//!
//! Every branch is a grid of rings and sides as in `tube`. Where a branch leaves its parent, a window is cut into the
//! parent's grid (`joint`), whose rings are turned so that the window lies under the branch, and a strip of faces joins
//! the window's rim to the first ring outside (`strip`), which is a little wider than the branch: a collar. So the surface stays one closed manifold without a hidden face, whatever the angle.
//!
//! Normals are those of the smooth surface, faces weighted by area, so that light flows over the joints. UV: as in
//! `tube`; the strip belongs to the branch's picture. Faces come in the order of the barks, first the first branch's.
//!
//! Limits: branches that pass through each other in mid-air are not joined. A branch that finds no free place on its
//! parent is closed at its foot and stands alone.

use super::joint::{self, Cells, Exit};
use super::limbs::{COLLAR_LENGTH, Limb, Limbs, Twig};
use super::mesh::{Mesh, Vertex};
use super::spine::Ring;
use super::strip::{self, Around, StripScratch};
use super::tube::{FINEST_BARK, TubeLook};
use crate::geom::frame;
use crate::plant::Branch;
use crate::plant::junction::COLLAR;
use glam::{Quat, Vec2, Vec3};
use std::f32::consts::TAU;

/// Rings closer than this share of a side's length are one.
const CLOSEST: f32 = 0.45;

/// Memory that is used again for every plant.
#[derive(Default)]
pub(super) struct WoodScratch {
    limbs: Limbs,
    cells: Cells,
    rim: Vec<(usize, usize, f32)>,
    /// Rims of the windows cut so far.
    rims: Vec<(u32, f32)>,
    grid: Vec<Row>,
    turns: Vec<Turn>,
    strip: StripScratch,
}

/// A ring of the final grid.
#[derive(Clone, Copy)]
struct Row {
    arc: f32,
    ring: Ring,
    /// Unit direction from its centre to its first point.
    side: Vec3,
}

impl Row {
    fn new(arc: f32, ring: Ring) -> Self {
        Self { arc, ring, side: Vec3::ZERO }
    }

    /// The angle at which a direction lies around the ring.
    fn angle_of(&self, direction: Vec3) -> f32 {
        direction.dot(self.ring.tangent.cross(self.side)).atan2(direction.dot(self.side))
    }
}

/// The surface of branches that all grow on the first.
pub(super) fn mesh(
    branches: &[Twig<'_>],
    look: impl Fn(&Branch) -> TubeLook,
    scratch: &mut WoodScratch,
) -> Mesh {
    scratch.rims.clear();
    scratch.limbs.survey(branches, look);
    let limbs = &scratch.limbs.all;
    let mut mesh = Mesh::default();
    let total: usize =
        limbs.iter().map(|limb| (limb.rings.len() + 3 * limb.children.len()) * limb.sides()).sum();
    mesh.points.reserve(total);
    mesh.vertices.reserve(total + total / 4);
    mesh.triangles.reserve(2 * total);
    let mut open_ends = Vec::new();
    let mut slots = Vec::with_capacity(mesh.triangles.capacity());
    for (limb, twig) in branches.iter().enumerate() {
        if !scratch.limbs.all[limb].hidden {
            build(limb, (&mut mesh, &mut slots), &mut open_ends, scratch);
            slots.resize(mesh.triangles.len(), twig.slot as u32);
        }
    }
    mesh.smooth_missing_normals();
    for (limb, end) in open_ends {
        close_end(&mut mesh, end);
        slots.resize(mesh.triangles.len(), branches[limb].slot as u32);
    }
    sort_by_slot(&mut mesh, &slots);
    drop_unused(&mut mesh);
    mesh.split_disagreeing_corners();
    mesh
}

/// A ring of points that has to be closed: its first point, how many there are, and where it looks.
struct OpenEnd {
    first: u32,
    sides: u32,
    normal: Vec3,
}

/// Where a limb's grid lies in the mesh.
#[derive(Clone, Copy)]
struct Grid {
    first_point: u32,
    first_vertex: u32,
    sides: u32,
}

/// Appends a limb's surface to the mesh, and the barks of its walls and its tip to those of the faces before.
fn build(
    index: usize,
    (mesh, slots): (&mut Mesh, &mut Vec<u32>),
    open_ends: &mut Vec<(usize, OpenEnd)>,
    scratch: &mut WoodScratch,
) {
    lay_out(index, scratch);
    let limb = scratch.limbs.all[index].clone();
    let sides = limb.sides();
    let up = limb.exit.map(|exit| upward(&exit));
    let grid = Grid {
        first_point: mesh.points.len() as u32,
        first_vertex: mesh.vertices.len() as u32,
        sides: sides as u32,
    };
    let first_side = up.unwrap_or_else(|| frame::hidden_side(scratch.grid[0].ring.tangent));
    transport(&mut scratch.grid, first_side);
    align(&limb, scratch);
    let end_v = rings(mesh, &scratch.grid, sides, limb.look.repeats());
    cut_windows(&limb, grid, scratch);
    for row in 0..scratch.grid.len() - 1 {
        walls(mesh, grid, row, &scratch.cells);
        let middle = 0.5 * (scratch.grid[row].arc + scratch.grid[row + 1].arc);
        slots.resize(mesh.triangles.len(), scratch.limbs.slot(&limb, middle));
    }
    tip(mesh, grid, &scratch.grid, &limb.look, end_v);
    slots.resize(mesh.triangles.len(), scratch.limbs.slot(&limb, f32::INFINITY));
    if limb.rim.is_empty() {
        let normal = -scratch.grid[0].ring.tangent;
        open_ends.push((index, OpenEnd { first: grid.first_point, sides: grid.sides, normal }));
    } else {
        let rim = &scratch.rims[limb.rim.clone()];
        let ring = Around { first_vertex: grid.first_vertex, sides, ring: scratch.grid[0].ring };
        strip::join(mesh, rim, &ring, limb.look.repeats(), &mut scratch.strip);
    }
}

/// The direction in the plane of a branch's first ring that lies above it on the parent.
fn upward(exit: &Exit) -> Vec3 {
    let axis = exit.ring.tangent;
    let above = exit.upward.reject_from_normalized(axis);
    let above =
        if above.length_squared() > 1e-4 { above } else { -exit.outward.reject_from_normalized(axis) };
    above.try_normalize().unwrap_or_else(|| axis.any_orthonormal_vector())
}

/// The rings of a limb's final grid: those of its skeleton, and those that its windows need.
fn lay_out(index: usize, scratch: &mut WoodScratch) {
    let WoodScratch { limbs: Limbs { rings, arcs, all: limbs, children, .. }, grid, .. } = scratch;
    let limb = &limbs[index];
    let (own, along) = (&rings[limb.rings.clone()], &arcs[limb.rings.clone()]);
    let end = along[along.len() - 1];
    grid.clear();
    let start = limb.exit.map_or(0.0, |exit| exit.arc);
    let first =
        limb.exit.map_or(own[0].levelled(), |exit| Ring { radius: COLLAR * exit.ring.radius, ..exit.ring });
    grid.push(Row::new(start, first));
    let after_collar = start + limb.exit.map_or(0.0, |exit| COLLAR_LENGTH * exit.ring.radius);
    if limb.exit.is_some() && after_collar < end {
        grid.push(Row::new(after_collar, at(own, along, after_collar)));
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
                grid.push(Row::new(arc, at(own, along, arc)));
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

/// The ring of a limb at a length along it.
fn at(rings: &[Ring], arcs: &[f32], arc: f32) -> Ring {
    let i = arcs.partition_point(|a| *a <= arc).clamp(1, rings.len() - 1);
    let share = ((arc - arcs[i - 1]) / (arcs[i] - arcs[i - 1])).clamp(0.0, 1.0);
    joint::between(&rings[i - 1], &rings[i], share)
}

/// Cuts a window for everything that grows on a limb and notes the rims.
fn cut_windows(limb: &Limb, on: Grid, scratch: &mut WoodScratch) {
    let WoodScratch { limbs: Limbs { all: limbs, children, .. }, grid, cells, rim, rims, .. } = scratch;
    let sides = limb.sides();
    cells.clear(grid.len() - 1, sides);
    for &child in &children[limb.children.clone()] {
        let Some(exit) = limbs[child as usize].exit else { continue };
        let row_of = |arc: f32| {
            let above = grid.partition_point(|row| row.arc < arc).clamp(1, grid.len() - 1);
            if arc - grid[above - 1].arc < grid[above].arc - arc { above - 1 } else { above }
        };
        let from = row_of(exit.at - exit.half_length).min(grid.len() - 2);
        let rows = from..row_of(exit.at + exit.half_length).max(from + 1);
        let angle = grid[rows.start].angle_of(exit.outward);
        let Some(window) = cells.cut(rows, angle, exit.half_angle) else { continue };
        window.rim(sides, rim);
        let first = rims.len();
        rims.extend(
            rim.iter().map(|(row, side, turn)| (on.first_point + (row * sides + side) as u32, *turn)),
        );
        limbs[child as usize].rim = first..rims.len();
    }
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
fn align(limb: &Limb, scratch: &mut WoodScratch) {
    let WoodScratch { limbs: Limbs { all: limbs, children, .. }, grid, turns, .. } = scratch;
    let per_side = TAU / limb.sides() as f32;
    turns.clear();
    for &child in &children[limb.children.clone()] {
        let Some(exit) = limbs[child as usize].exit else { continue };
        let span = (exit.at - exit.half_length, exit.at + exit.half_length);
        if turns.iter().any(|turn| turn.span.0 < span.1 && span.0 < turn.span.1) {
            continue;
        }
        let row = grid.partition_point(|row| row.arc < exit.at).min(grid.len() - 1);
        let columns = joint::columns(exit.half_angle, limb.sides());
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

/// Appends points and vertices of all rings; gives the last ring's v.
fn rings(mesh: &mut Mesh, grid: &[Row], sides: usize, repeats: f32) -> f32 {
    let mut v = 0.0;
    let turn = Vec2::from_angle(TAU / sides as f32);
    let thickest = grid[0].ring.radius;
    for i in 0..grid.len() {
        let Row { ring, side, .. } = grid[i];
        if i > 0 {
            let before = &grid[i - 1].ring;
            let radius = (0.5 * (before.radius + ring.radius)).max(FINEST_BARK * thickest);
            v += before.at.distance(ring.at) * repeats / (TAU * radius);
        }
        let other = ring.tangent.cross(side);
        let first = mesh.points.len() as u32;
        let mut toward = Vec2::X;
        for j in 0..=sides {
            let point = first + if j == sides { 0 } else { j as u32 };
            if j < sides {
                mesh.points.push(ring.at + (side * toward.x + other * toward.y) * ring.radius);
                toward = turn.rotate(toward);
            }
            let uv = Vec2::new(repeats * j as f32 / sides as f32, v);
            mesh.vertices.push(Vertex { point, normal: Vec3::ZERO, uv });
        }
    }
    v
}

/// Faces between a ring and the next but for the windows.
fn walls(mesh: &mut Mesh, on: Grid, row: usize, cells: &Cells) {
    let width = on.sides + 1;
    let (low, high) = (on.first_vertex + row as u32 * width, on.first_vertex + (row as u32 + 1) * width);
    for j in (0..on.sides).filter(|j| !cells.is_taken(row, *j as usize)) {
        mesh.triangles.push([low + j, low + j + 1, high + j + 1]);
        mesh.triangles.push([low + j, high + j + 1, high + j]);
    }
}

/// Closes the last ring with a blunt cone.
fn tip(mesh: &mut Mesh, on: Grid, grid: &[Row], look: &TubeLook, v: f32) {
    let ring = &grid[grid.len() - 1].ring;
    let last = on.first_vertex + (grid.len() as u32 - 1) * (on.sides + 1);
    let (apex, first) = (mesh.points.len() as u32, mesh.vertices.len() as u32);
    mesh.points.push(ring.at + ring.tangent * (look.tip * ring.radius));
    let end = Vec2::new(look.repeats(), v + look.repeats() * look.tip / TAU);
    mesh.vertices.extend((0..on.sides).map(|j| Vertex {
        point: apex,
        normal: Vec3::ZERO,
        uv: Vec2::new((j as f32 + 0.5) / on.sides as f32, 1.0) * end,
    }));
    mesh.triangles.extend((0..on.sides).map(|j| [last + j, last + j + 1, first + j]));
}

fn close_end(mesh: &mut Mesh, OpenEnd { first: point, sides, normal }: OpenEnd) {
    let first = mesh.vertices.len() as u32;
    mesh.vertices.extend((0..sides).map(|j| Vertex {
        point: point + j,
        normal,
        uv: Vec2::splat(0.5) + Vec2::from_angle(TAU * j as f32 / sides as f32) * 0.5,
    }));
    mesh.triangles.extend((1..sides - 1).map(|j| [first, first + j + 1, first + j]));
}

/// Puts faces of one slot next to one another, without another change of their order.
fn sort_by_slot(mesh: &mut Mesh, slots: &[u32]) {
    let last = slots.iter().copied().max().unwrap_or(0);
    if last == 0 {
        return;
    }
    let mut sorted = Vec::with_capacity(mesh.triangles.len());
    for slot in 0..=last {
        if slot > 0 {
            mesh.breaks.push(sorted.len() as u32);
        }
        let faces = mesh.triangles.iter().zip(slots).filter(|(_, of)| **of == slot);
        sorted.extend(faces.map(|(face, _)| *face));
    }
    mesh.triangles = sorted;
}

/// Takes out points and vertices inside of windows, which no face has.
fn drop_unused(mesh: &mut Mesh) {
    const UNUSED: u32 = u32::MAX;
    let (mut points, mut vertices) = (vec![UNUSED; mesh.points.len()], vec![UNUSED; mesh.vertices.len()]);
    for vertex in mesh.triangles.iter().flatten() {
        vertices[*vertex as usize] = 0;
        points[mesh.vertices[*vertex as usize].point as usize] = 0;
    }
    number(&mut points);
    number(&mut vertices);
    let mut at = points.iter();
    mesh.points.retain(|_| at.next().is_some_and(|new| *new != UNUSED));
    let mut at = vertices.iter();
    mesh.vertices.retain(|_| at.next().is_some_and(|new| *new != UNUSED));
    mesh.vertices.iter_mut().for_each(|vertex| vertex.point = points[vertex.point as usize]);
    mesh.triangles.iter_mut().flatten().for_each(|vertex| *vertex = vertices[*vertex as usize]);
}

/// Numbers those that are used, which have a 0.
fn number(places: &mut [u32]) {
    places.iter_mut().filter(|place| **place == 0).enumerate().for_each(|(new, place)| *place = new as u32);
}

#[cfg(test)]
#[path = "wood_tests.rs"]
mod tests;
