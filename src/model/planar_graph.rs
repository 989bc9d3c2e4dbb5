//! Constrained Delaunay triangulation of a blade's outline and interior points (000 §5.1.4).
//!
//! Plain Delaunay fills the convex hull, so that a notched petal or lobed leaf loses its outline; here
//! the outline's edges are constraints and the faces outside of them are left out. Which faces are outside needs no
//! search: the outline's points come first and in order, so a face between three of them is inside exactly if it
//! turns the way the outline does, and a face that touches an interior point is always inside.
//!
//! Limits: an outline that crosses or touches itself has no triangulation.

use glam::Vec2;
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

type Cdt = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// Points of a blade in its plane with the edges that must appear in its triangulation: the outline comes first.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanarGraph {
    /// Positions in blade sizes.
    pub points: Vec<Vec2>,
    /// How many of them are the outline, counter-clockwise; each is joined to the next and the last to the first.
    pub margin: usize,
    /// The points of the midrib from base to tip, two of which may be joined where no edge of the outline lies between.
    pub midrib: Vec<usize>,
}

impl PlanarGraph {
    /// Points and constraints as `spade` takes them.
    pub fn spade_input(&self) -> (Vec<Point2<f64>>, Vec<[usize; 2]>) {
        (self.points.iter().copied().map(spade_point).collect(), self.margin_edges().collect())
    }

    /// The faces inside the outline, counter-clockwise; `None` if the outline crosses or touches itself. `scratch` may
    /// come from another triangulation.
    pub fn triangulate(&self, scratch: &mut TriangulationScratch) -> Option<Vec<[u32; 3]>> {
        self.constrain(scratch)?;
        let TriangulationScratch { cdt, handles, index } = scratch;
        index.clear();
        index.resize(handles.len(), 0);
        handles.iter().enumerate().for_each(|(i, handle)| index[handle.index()] = i);
        let n = self.margin;
        let expected = n + 2 * (self.points.len() - n) - 2;
        let mut triangles = Vec::with_capacity(expected);
        let mut margin_edges = 0;
        for face in cdt.inner_faces() {
            let corners = face.vertices().map(|v| index[v.fix().index()]);
            if is_inside(corners, n) {
                let [a, b, c] = corners;
                margin_edges += [(a, b), (b, c), (c, a)].iter().filter(|e| follows(e.0, e.1, n)).count();
                triangles.push(corners.map(|i| i as u32));
            }
        }
        // A disc with this many points has exactly this many faces; anything else means a touching outline.
        (triangles.len() == expected && margin_edges == n).then_some(triangles)
    }

    /// Makes the constrained Delaunay triangulation and the vertex of every point; `None` if points coincide.
    ///
    /// Points go in one after the other, each next to the one before: rows first, then around the outline, whose edges
    /// then mostly exist already. On a blade this takes half the time of spade's bulk loading, and unlike that does
    /// not depend on the order of a hash set where points lie on common circles.
    fn constrain(&self, TriangulationScratch { cdt, handles, .. }: &mut TriangulationScratch) -> Option<()> {
        let count = self.points.len();
        cdt.clear();
        handles.clear();
        handles.resize(count, FixedVertexHandle::from_index(0));
        let mut last = None;
        for i in (self.margin..count).chain(0..self.margin) {
            let point = spade_point(self.points[i]);
            let inserted = match last {
                Some(hint) => cdt.insert_with_hint(point, hint),
                None => cdt.insert(point),
            };
            handles[i] = inserted.ok()?;
            last = Some(handles[i]);
        }
        if cdt.num_vertices() != count {
            return None;
        }
        let is_missing = |[a, b]: [usize; 2]| cdt.get_edge_from_neighbors(handles[a], handles[b]).is_none();
        let along = || self.midrib.windows(2).map(|pair| [pair[0], pair[1]]);
        let is_dammed = along().any(is_missing);
        if is_dammed || self.margin_edges().any(is_missing) {
            for [a, b] in self.margin_edges() {
                cdt.try_add_constraint(handles[a], handles[b]);
            }
        }
        if is_dammed {
            // The outline is whole by now: a piece that would cross it is refused.
            for [a, b] in along() {
                cdt.try_add_constraint(handles[a], handles[b]);
            }
        }
        Some(())
    }

    /// The outline's edges, each from a point to the next one around.
    fn margin_edges(&self) -> impl Iterator<Item = [usize; 2]> {
        (0..self.margin).map(|i| [i, if i + 1 == self.margin { 0 } else { i + 1 }])
    }
}

/// Memory that is used again for every triangulation.
#[derive(Default)]
pub struct TriangulationScratch {
    cdt: Cdt,
    /// The vertex of every point.
    handles: Vec<FixedVertexHandle>,
    /// The point of every vertex.
    index: Vec<usize>,
}

fn spade_point(point: Vec2) -> Point2<f64> {
    Point2::new(f64::from(point.x), f64::from(point.y))
}

fn follows(a: usize, b: usize, margin: usize) -> bool {
    (b == a + 1 && b < margin) || (b == 0 && a + 1 == margin)
}

fn is_inside([a, b, c]: [usize; 3], margin: usize) -> bool {
    let ascents = [(a, b), (b, c), (c, a)].iter().filter(|(from, to)| from < to).count();
    ascents == 2 || a >= margin || b >= margin || c >= margin
}
