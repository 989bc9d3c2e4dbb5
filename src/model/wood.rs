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

use super::limbs::{Limb, Limbs, WoodBranch};
use super::mesh::{Mesh, Vertex};
use super::rows::{Row, Rows};
use super::sealing::{Raw, RawLimb};
use super::strip::{self, Around, StripScratch};
use super::surface::Surface;
use super::tube::{FINEST_BARK, TubeLook};
use super::window::Cells;
use crate::plant::Branch;
use glam::{Vec2, Vec3};
use std::f32::consts::TAU;

/// Memory that is used again for every plant.
#[derive(Default)]
pub(super) struct WoodScratch {
    pub(super) limbs: Limbs,
    cells: Cells,
    rim: Vec<(usize, usize, f32)>,
    /// Rims of the windows cut so far.
    rims: Vec<(u32, f32)>,
    rows: Rows,
    strip: StripScratch,
}

/// What of a limb a surface has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Share {
    /// Nothing.
    Left,
    /// Only what it does to others: a normal or a point of theirs may be there by its faces.
    Around,
    /// All of it.
    Whole,
}

/// The surface of branches that all grow on the first.
pub(super) fn mesh(
    branches: &[WoodBranch<&Branch>],
    look: impl Fn(&Branch) -> TubeLook,
    scratch: &mut WoodScratch,
) -> Mesh {
    scratch.limbs.survey(branches, look, None);
    surface(branches, |_| Share::Whole, scratch).mesh
}

/// The surface of some of the surveyed limbs, as it is in the surface of all of them. With a limb must come what carries it,
/// whole, and what it carries, at least as what is around it.
pub(super) fn surface(
    branches: &[WoodBranch<&Branch>],
    share: impl Fn(usize) -> Share,
    scratch: &mut WoodScratch,
) -> Surface {
    scratch.rims.clear();
    let shown = |limb: &usize| !scratch.limbs.all[*limb].hidden && share(*limb) != Share::Left;
    let shown: Vec<usize> = (0..branches.len()).filter(shown).collect();
    let mut raw = Raw::with_room_for(shown.iter().map(|limb| &scratch.limbs.all[*limb]));
    let mut open_ends = Vec::new();
    for limb in shown {
        let (mesh, slots) = (&mut raw.mesh, &mut raw.slots);
        let [points, vertices, faces] = mesh.counts();
        let strip = build(limb, (mesh, slots), &mut open_ends, scratch);
        slots.resize(mesh.triangles.len(), branches[limb].slot as u32);
        let [points_end, vertices_end, faces_end] = mesh.counts();
        raw.limbs.push(RawLimb {
            limb,
            is_whole: share(limb) == Share::Whole,
            points: points..points_end,
            own_vertices: vertices..strip,
            strip_vertices: strip..vertices_end,
            faces: faces..faces_end,
        });
    }
    raw.mesh.smooth_missing_normals();
    for (limb, end) in open_ends.into_iter().filter(|(limb, _)| share(*limb) == Share::Whole) {
        raw.caps.push((limb, raw.mesh.vertices.len(), raw.mesh.triangles.len()));
        close_end(&mut raw.mesh, end);
        raw.slots.resize(raw.mesh.triangles.len(), branches[limb].slot as u32);
    }
    raw.seal(branches.len())
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

/// Appends a limb's surface to the mesh, and the barks of its walls and its tip to those of the faces before; gives the first
/// vertex of its strip.
fn build(
    index: usize,
    (mesh, slots): (&mut Mesh, &mut Vec<u32>),
    open_ends: &mut Vec<(usize, OpenEnd)>,
    scratch: &mut WoodScratch,
) -> usize {
    let limb = scratch.limbs.all[index].clone();
    scratch.rows.lay_out(&scratch.limbs, &limb);
    let sides = limb.sides();
    let grid = Grid {
        first_point: mesh.points.len() as u32,
        first_vertex: mesh.vertices.len() as u32,
        sides: sides as u32,
    };
    let end_v = rings(mesh, &scratch.rows.all, sides, limb.look.repeats());
    cut_windows(&limb, grid, scratch);
    let rows = &scratch.rows.all;
    for row in 0..rows.len() - 1 {
        walls(mesh, grid, row, &scratch.cells);
        let middle = 0.5 * (rows[row].arc + rows[row + 1].arc);
        slots.resize(mesh.triangles.len(), scratch.limbs.slot(&limb, middle));
    }
    tip(mesh, grid, rows, &limb.look, end_v);
    slots.resize(mesh.triangles.len(), scratch.limbs.slot(&limb, f32::INFINITY));
    let first_of_strip = mesh.vertices.len();
    if limb.rim.is_empty() {
        let normal = -rows[0].ring.tangent;
        open_ends.push((index, OpenEnd { first: grid.first_point, sides: grid.sides, normal }));
    } else {
        let rim = &scratch.rims[limb.rim.clone()];
        let ring = Around { first_vertex: grid.first_vertex, sides, ring: rows[0].ring };
        strip::join(mesh, rim, &ring, limb.look.repeats(), &mut scratch.strip);
    }
    first_of_strip
}

/// Cuts a window for everything that grows on a limb and notes the rims.
fn cut_windows(limb: &Limb, on: Grid, scratch: &mut WoodScratch) {
    let WoodScratch { limbs: Limbs { all: limbs, children, .. }, rows, cells, rim, rims, .. } = scratch;
    let grid = &rows.all;
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
        limbs[child as usize].is_at_foot = window.rows.start == 0;
    }
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

#[cfg(test)]
#[path = "wood_tests.rs"]
mod tests;
