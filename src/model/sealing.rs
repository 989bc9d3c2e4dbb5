//! The last steps to a surface of limbs: points and vertices inside of windows are left out, faces are put in the order of
//! their barks, corners where normals disagree are split.

use super::limbs::Limb;
use super::mesh::Mesh;
use super::surface::{Places, Run, Surface};
use std::ops::Range;

/// A mesh of limbs in the making.
#[derive(Default)]
pub(super) struct Raw {
    pub(super) mesh: Mesh,
    /// The bark of each face.
    pub(super) slots: Vec<u32>,
    /// Limbs in the order in which they lie in the mesh.
    pub(super) limbs: Vec<RawLimb>,
    /// Limbs whose feet are closed by caps, each with the first vertex and the first face of its cap; after all limbs.
    pub(super) caps: Vec<(usize, usize, usize)>,
}

/// Where a limb lies in a mesh in the making.
pub(super) struct RawLimb {
    pub(super) limb: usize,
    /// Whether it stays in the mesh, or is there only for others.
    pub(super) is_whole: bool,
    pub(super) points: Range<usize>,
    /// Vertices at its own points, and those of its strip at points of what carries it.
    pub(super) own_vertices: Range<usize>,
    pub(super) strip_vertices: Range<usize>,
    pub(super) faces: Range<usize>,
}

/// A point or vertex that has no number, and one that is to have one.
const UNUSED: u32 = u32::MAX;
const USED: u32 = 0;

impl Raw {
    /// An empty one with room for these limbs.
    pub(super) fn with_room_for<'a>(limbs: impl Iterator<Item = &'a Limb>) -> Self {
        let mut raw = Self::default();
        let total: usize =
            limbs.map(|limb| (limb.rings.len() + 3 * limb.children.len()) * limb.sides()).sum();
        raw.mesh.points.reserve(total);
        raw.mesh.vertices.reserve(total + total / 4);
        raw.mesh.triangles.reserve(2 * total);
        raw.slots.reserve(2 * total);
        raw
    }

    /// The finished surface of whole limbs, of so many in all.
    pub(super) fn seal(mut self, limbs: usize) -> Surface {
        let mut places = Places::of(limbs);
        let (mut points, mut vertices) = self.used();
        self.number((&mut points, &mut vertices), &mut places);
        let mesh = &mut self.mesh;
        let mut at = points.iter();
        mesh.points.retain(|_| at.next().is_some_and(|new| *new != UNUSED));
        let mut at = vertices.iter();
        mesh.vertices.retain(|_| at.next().is_some_and(|new| *new != UNUSED));
        mesh.vertices.iter_mut().for_each(|vertex| vertex.point = points[vertex.point as usize]);
        self.sort_faces(&vertices, &mut places);
        places.first_split = self.mesh.vertices.len() as u32;
        let disagreeing = self.mesh.disagreeing_faces();
        let mut left = &disagreeing[..];
        for run in places.runs.iter_mut().filter(|run| !run.faces.is_empty()) {
            let (of_run, after) = left.split_at(left.partition_point(|face| *face < run.faces.end as usize));
            let first = self.mesh.vertices.len() as u32;
            self.mesh.split_corners_of(of_run.iter().copied());
            run.splits = first..self.mesh.vertices.len() as u32;
            left = after;
        }
        Surface { mesh: self.mesh, places }
    }

    /// Marks points that some face has, and vertices that a face of a whole limb has.
    fn used(&self) -> (Vec<u32>, Vec<u32>) {
        let Mesh { points, vertices, triangles, .. } = &self.mesh;
        let (mut used_points, mut used_vertices) = (vec![UNUSED; points.len()], vec![UNUSED; vertices.len()]);
        let first_cap = self.caps.first().map_or(triangles.len(), |(_, _, face)| *face);
        let of_limbs = self.limbs.iter().map(|limb| (limb.faces.clone(), limb.is_whole));
        for (faces, is_whole) in of_limbs.chain([(first_cap..triangles.len(), true)]) {
            for vertex in triangles[faces].iter().flatten() {
                used_points[vertices[*vertex as usize].point as usize] = USED;
                if is_whole {
                    used_vertices[*vertex as usize] = USED;
                }
            }
        }
        (used_points, used_vertices)
    }

    /// Numbers what is used of whole limbs, in order.
    fn number(&self, (points, vertices): (&mut [u32], &mut [u32]), places: &mut Places) {
        let (mut next_point, mut next_vertex) = (0, 0);
        for limb in &self.limbs {
            if !limb.is_whole {
                points[limb.points.clone()].fill(UNUSED);
                continue;
            }
            let piece = &mut places.pieces[limb.limb];
            piece.points = number(&mut points[limb.points.clone()], &mut next_point);
            piece.own = number(&mut vertices[limb.own_vertices.clone()], &mut next_vertex);
            piece.strip = number(&mut vertices[limb.strip_vertices.clone()], &mut next_vertex);
        }
        for (cap, (limb, first, _)) in self.caps.iter().enumerate() {
            let end = self.caps.get(cap + 1).map_or(vertices.len(), |(_, next, _)| *next);
            places.pieces[*limb].cap = number(&mut vertices[*first..end], &mut next_vertex);
        }
    }

    /// Puts faces of one bark next to one another, without another change of their order, and gives their corners their new
    /// numbers.
    fn sort_faces(&mut self, vertices: &[u32], places: &mut Places) {
        let mut faces = std::mem::take(&mut self.mesh.triangles);
        let of_limbs = self.limbs.iter().filter(|limb| limb.is_whole);
        let of_limbs = of_limbs.map(|limb| (limb.limb, limb.faces.clone()));
        let of_caps = self.caps.iter().enumerate().map(|(cap, (limb, _, first))| {
            let end = self.caps.get(cap + 1).map_or(faces.len(), |(_, _, next)| *next);
            (places.pieces.len() + limb, *first..end)
        });
        let lanes: Vec<(usize, Range<usize>)> = of_limbs.chain(of_caps).collect();
        let last = self.slots.iter().copied().max().unwrap_or(0);
        if last == 0 && self.limbs.iter().all(|limb| limb.is_whole) {
            // They are in their order already.
            places.runs.resize(places.lanes(), Run::default());
            for (lane, of_lane) in lanes {
                places.runs[lane].faces = of_lane.start as u32..of_lane.end as u32;
            }
            faces.iter_mut().flatten().for_each(|vertex| *vertex = vertices[*vertex as usize]);
            self.mesh.triangles = faces;
            return;
        }
        let mut sorted = Vec::with_capacity(faces.len());
        for slot in 0..=last {
            if slot > 0 {
                self.mesh.breaks.push(sorted.len() as u32);
            }
            let first_run = places.runs.len();
            places.runs.resize(first_run + places.lanes(), Run::default());
            for (lane, of_lane) in &lanes {
                let from = sorted.len() as u32;
                let of_slot = faces[of_lane.clone()].iter().zip(&self.slots[of_lane.clone()]);
                let of_slot = of_slot.filter(|(_, of)| **of == slot);
                sorted.extend(of_slot.map(|(face, _)| face.map(|vertex| vertices[vertex as usize])));
                places.runs[first_run + lane].faces = from..sorted.len() as u32;
            }
        }
        self.mesh.triangles = sorted;
    }
}

/// Numbers those that are used, from `next` on; gives their numbers.
fn number(places: &mut [u32], next: &mut u32) -> Range<u32> {
    let first = *next;
    for place in places.iter_mut().filter(|place| **place == USED) {
        *place = *next;
        *next += 1;
    }
    first..*next
}
