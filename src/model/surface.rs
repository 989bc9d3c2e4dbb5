//! A surface of many limbs that knows which of its points, vertices and faces belong to which limb, and how such surfaces are
//! joined to another one.
//!
//! Points and vertices lie limb after limb; then come the vertices of caps, then those that were split off at corners where
//! normals disagree. Faces lie bark after bark, within a bark limb after limb, then its caps. A joined surface takes every
//! limb from one of its sources and lies in the same order, so that it is the very mesh that is made from all limbs at once.
//!
//! Limits: whoever joins says that each limb is in its source as it has to be, and that the points of what carries it have the
//! same order there.

use super::limbs::Limb;
use super::mesh::{Mesh, Vertex};
use std::ops::Range;

/// A mesh with the places of its limbs.
#[derive(Debug, Default)]
pub(super) struct Surface {
    pub(super) mesh: Mesh,
    pub(super) places: Places,
}

/// Where the limbs of a surface lie in its mesh.
#[derive(Debug, Default)]
pub(super) struct Places {
    /// By limb; empty for those that are not in it.
    pub(super) pieces: Vec<Piece>,
    /// Faces: for every bark those of each limb, then those of each limb's cap.
    pub(super) runs: Vec<Run>,
    /// The first vertex that was split off.
    pub(super) first_split: u32,
}

/// The points and vertices of a limb.
#[derive(Clone, Debug, Default)]
pub(super) struct Piece {
    pub(super) points: Range<u32>,
    /// Vertices at its own points.
    pub(super) own: Range<u32>,
    /// Vertices of its strip at the points of what carries it.
    pub(super) strip: Range<u32>,
    /// Vertices of the cap that closes its foot.
    pub(super) cap: Range<u32>,
}

/// Faces of one limb or one cap in one bark.
#[derive(Clone, Debug, Default)]
pub(super) struct Run {
    pub(super) faces: Range<u32>,
    /// Vertices that were split off for these faces.
    pub(super) splits: Range<u32>,
}

impl Places {
    /// Of a surface of some of so many limbs.
    pub(super) fn of(limbs: usize) -> Self {
        Self { pieces: vec![Piece::default(); limbs], ..Self::default() }
    }

    /// Faces in each bark: of limbs and of caps.
    pub(super) fn lanes(&self) -> usize {
        2 * self.pieces.len()
    }

    fn barks(&self) -> usize {
        self.runs.len().checked_div(self.lanes()).unwrap_or(0)
    }

    /// Faces of a limb in a bark, or of its cap.
    fn run(&self, bark: usize, limb: usize, is_cap: bool) -> Run {
        let lane = limb + if is_cap { self.pieces.len() } else { 0 };
        self.runs.get(bark * self.lanes() + lane).cloned().unwrap_or_default()
    }
}

/// A surface that others take limbs from.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) places: &'a Places,
    pub(super) limbs: &'a [Limb],
}

/// A limb in a source.
#[derive(Clone, Copy)]
pub(super) struct Taken<'a> {
    pub(super) from: Source<'a>,
    pub(super) limb: usize,
}

impl Taken<'_> {
    fn piece(&self) -> &Piece {
        &self.from.places.pieces[self.limb]
    }

    /// The first point of what carries the limb.
    fn first_point_of_parent(&self) -> u32 {
        let parent = self.from.limbs[self.limb].parent;
        parent.map_or(0, |parent| self.from.places.pieces[parent].points.start)
    }
}

/// The surface of limbs that are taken from others; hidden ones are in none.
pub(super) fn joined(limbs: &[Limb], taken: &[Option<Taken<'_>>]) -> Surface {
    let mut surface = Surface { mesh: with_room(taken), places: Places::of(limbs.len()) };
    let Surface { mesh, places } = &mut surface;
    let shown = || taken.iter().enumerate().filter_map(|(limb, taken)| Some((limb, taken.as_ref()?)));
    for (limb, taken) in shown() {
        let points = &taken.from.mesh.points[range(&taken.piece().points)];
        places.pieces[limb].points = appended(&mut mesh.points, points.iter().copied());
    }
    let shift = |places: &Places, limb: usize, taken: &Taken<'_>| {
        let parent = limbs[limb].parent.map_or(0, |parent| places.pieces[parent].points.start);
        Shift {
            own: places.pieces[limb].points.start.wrapping_sub(taken.piece().points.start),
            parents: parent.wrapping_sub(taken.first_point_of_parent()),
        }
    };
    for (limb, taken) in shown() {
        let (vertices, piece) = (&taken.from.mesh.vertices, taken.piece());
        let Shift { own, parents } = shift(places, limb, taken);
        let moved = |range: Range<usize>, by: u32| vertices[range].iter().map(move |v| moved(v, by));
        places.pieces[limb].own = appended(&mut mesh.vertices, moved(range(&piece.own), own));
        places.pieces[limb].strip = appended(&mut mesh.vertices, moved(range(&piece.strip), parents));
    }
    for (limb, taken) in shown().filter(|(_, taken)| !taken.piece().cap.is_empty()) {
        let (vertices, own) = (&taken.from.mesh.vertices, shift(places, limb, taken).own);
        let cap = vertices[range(&taken.piece().cap)].iter().map(|v| moved(v, own));
        places.pieces[limb].cap = appended(&mut mesh.vertices, cap);
    }
    places.first_split = mesh.vertices.len() as u32;
    let barks = shown().map(|(_, taken)| taken.from.places.barks()).max().unwrap_or(0);
    for bark in 0..barks {
        if bark > 0 {
            mesh.breaks.push(mesh.triangles.len() as u32);
        }
        let first_run = places.runs.len();
        places.runs.resize(first_run + places.lanes(), Run::default());
        for is_cap in [false, true] {
            for (limb, taken) in shown() {
                let run = taken.from.places.run(bark, taken.limb, is_cap);
                if !run.faces.is_empty() {
                    let lane = limb + if is_cap { limbs.len() } else { 0 };
                    let shift = shift(places, limb, taken);
                    places.runs[first_run + lane] =
                        append_faces(mesh, &places.pieces[limb], (taken, &run, is_cap), &shift);
                }
            }
        }
    }
    drop_last_barks(&mut surface);
    surface
}

/// By how much the points of a limb and those of what carries it are moved.
struct Shift {
    own: u32,
    parents: u32,
}

/// Appends the faces of a limb in one bark and the vertices that were split off for them.
fn append_faces(
    mesh: &mut Mesh,
    piece: &Piece,
    (taken, run, is_cap): (&Taken<'_>, &Run, bool),
    shift: &Shift,
) -> Run {
    let (then, from) = (taken.piece(), taken.from);
    let by = match is_cap {
        true => piece.cap.start.wrapping_sub(then.cap.start),
        false => piece.own.start.wrapping_sub(then.own.start),
    };
    let faces = from.mesh.triangles[range(&run.faces)].iter();
    if run.splits.is_empty() {
        let faces = appended(&mut mesh.triangles, faces.map(|face| face.map(|v| v.wrapping_add(by))));
        return Run { faces, splits: 0..0 };
    }
    let split_by = (mesh.vertices.len() as u32).wrapping_sub(run.splits.start);
    let first_split = from.places.first_split;
    let corner = |v: u32| v.wrapping_add(if v < first_split { by } else { split_by });
    let faces = appended(&mut mesh.triangles, faces.map(|face| face.map(corner)));
    let splits = from.mesh.vertices[range(&run.splits)].iter().map(|vertex| {
        let is_own = then.points.contains(&vertex.point);
        moved(vertex, if is_own { shift.own } else { shift.parents })
    });
    Run { faces, splits: appended(&mut mesh.vertices, splits) }
}

/// Barks that no limb has any more.
fn drop_last_barks(Surface { mesh, places }: &mut Surface) {
    while mesh.breaks.last().is_some_and(|first| *first as usize == mesh.triangles.len()) {
        mesh.breaks.pop();
        places.runs.truncate(places.runs.len() - places.lanes());
    }
}

/// An empty mesh with exactly the room that the limbs need.
fn with_room(taken: &[Option<Taken<'_>>]) -> Mesh {
    let mut mesh = Mesh::default();
    let [mut points, mut vertices, mut faces] = [0; 3];
    for taken in taken.iter().flatten() {
        let (piece, places) = (taken.piece(), taken.from.places);
        points += piece.points.len();
        vertices += piece.own.len() + piece.strip.len() + piece.cap.len();
        for bark in 0..places.barks() {
            for run in [false, true].map(|is_cap| places.run(bark, taken.limb, is_cap)) {
                faces += run.faces.len();
                vertices += run.splits.len();
            }
        }
    }
    mesh.points.reserve_exact(points);
    mesh.vertices.reserve_exact(vertices);
    mesh.triangles.reserve_exact(faces);
    mesh
}

fn moved(vertex: &Vertex, by: u32) -> Vertex {
    Vertex { point: vertex.point.wrapping_add(by), ..*vertex }
}

/// Appends items; gives where they lie.
fn appended<T>(list: &mut Vec<T>, items: impl Iterator<Item = T>) -> Range<u32> {
    let from = list.len() as u32;
    list.extend(items);
    from..list.len() as u32
}

/// The same range as indices.
fn range(range: &Range<u32>) -> Range<usize> {
    range.start as usize..range.end as usize
}
