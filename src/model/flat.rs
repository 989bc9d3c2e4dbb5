//! A blade while it is still flat: outline and interior points joined by a constrained Delaunay triangulation.
//!
//! Plain Delaunay (000 §5.1.4) fills the convex hull, so that a notched petal or lobed leaf loses its outline; here
//! the outline's edges are constraints and the faces outside of them are left out. Which faces are outside needs no
//! search: the outline's points come first and in order, so a face between three of them is inside exactly if it
//! turns the way the outline does, and a face that touches an interior point is always inside.
//!
//! An outline that turns out to cross itself is cut down to its largest simple part; failing that, its convex hull
//! is used. Only an outline without area has no triangulation.

use super::{
    interior::{self, Density, InteriorScratch},
    outline::{self, Detail, MarginPoint, OutlineScratch},
    sections::Sections,
};
use crate::plant::Blade;
use glam::Vec2;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

crate::parameters! {
    /// How finely petals, leaves and sepals are modelled.
    pub struct BladeMeshParams {
        /// How far a blade's margin may leave the drawn outline.
        outline_tolerance: f32 = 0.001, 0.0001..=0.002, "of the blade's size";
        /// Rows of points between base and tip; more rows bend more smoothly.
        rows: u32 = 7, 0..=64, "";
        /// Columns of points between midrib and margin at the widest place.
        columns: u32 = 2, 0..=32, "";
        /// The same tolerance for generated leaves, which are many and small.
        template_tolerance: f32 = 0.02, 0.0001..=0.1, "of the blade's size";
        /// Rows of points in generated leaves.
        template_rows: u32 = 2, 0..=64, "";
        /// Columns of points in generated leaves.
        template_columns: u32 = 0, 0..=32, "";
        /// Thickness at the margin as a share of the thickness in the middle.
        margin_thickness: f32 = 0.5, 0.1..=1.0, "";
        /// How far the pen's full pressure lifts the margin.
        curl_height: f32 = 0.15, 0.0..=0.5, "of the blade's length";
    }
}

/// Points of a blade in its plane with the edges that must appear in its triangulation: the outline comes first.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanarGraph {
    /// Positions in blade sizes.
    pub points: Vec<Vec2>,
    /// How many of them are the outline, counter-clockwise; each is joined to the next and the last to the first.
    pub margin: usize,
}

impl PlanarGraph {
    /// Points and constraints as `spade` takes them.
    ///
    /// Every point is moved by about a millionth of the blade, because symmetric blades are full of points on common
    /// circles, whose triangulation would depend on the order in which a hash set is read.
    pub fn spade_input(&self) -> (Vec<Point2<f64>>, Vec<[usize; 2]>) {
        let moved = |(i, p): (usize, &Vec2)| {
            let hash = (i as u32 + 1).wrapping_mul(0x9E37_79B9);
            let share = |bits: u32| (f64::from(bits & 0xFFFF) / 65536.0 - 0.5) * 2e-6;
            Point2::new(f64::from(p.x) + share(hash), f64::from(p.y) + share(hash >> 16))
        };
        let points = self.points.iter().enumerate().map(moved).collect();
        let edges = (0..self.margin).map(|i| [i, if i + 1 == self.margin { 0 } else { i + 1 }]).collect();
        (points, edges)
    }

    /// The faces inside the outline, counter-clockwise; `None` if the outline crosses or touches itself.
    fn triangulate(&self) -> Option<Vec<[u32; 3]>> {
        let (points, edges) = self.spade_input();
        let mut conflicts = 0;
        let cdt: ConstrainedDelaunayTriangulation<Point2<f64>> =
            ConstrainedDelaunayTriangulation::try_bulk_load_cdt(points, edges, |_| conflicts += 1).ok()?;
        if conflicts > 0 || cdt.num_vertices() != self.points.len() {
            return None;
        }
        let n = self.margin;
        let expected = n + 2 * (self.points.len() - n) - 2;
        let mut triangles = Vec::with_capacity(expected);
        let mut margin_edges = 0;
        for face in cdt.inner_faces() {
            let corners = face.vertices().map(|v| v.fix().index());
            if is_inside(corners, n) {
                let [a, b, c] = corners;
                margin_edges += [(a, b), (b, c), (c, a)].iter().filter(|e| follows(e.0, e.1, n)).count();
                triangles.push(corners.map(|i| i as u32));
            }
        }
        // A disc with this many points has exactly this many faces; anything else means a touching outline.
        (triangles.len() == expected && margin_edges == n).then_some(triangles)
    }
}

fn follows(a: usize, b: usize, margin: usize) -> bool {
    a < margin && (b == a + 1 || (b == 0 && a + 1 == margin))
}

fn is_inside([a, b, c]: [usize; 3], margin: usize) -> bool {
    let in_order = (a < b && b < c) || (b < c && c < a) || (c < a && a < b);
    in_order || a >= margin || b >= margin || c >= margin
}

/// A triangulated blade before it is bent; shared by all blades of one template.
#[derive(Clone, Debug)]
pub(super) struct FlatBlade {
    /// Positions in (u, v) metres; the outline first.
    pub(super) points: Vec<Vec2>,
    /// How many points are the outline, counter-clockwise.
    pub(super) margin: usize,
    /// Faces, counter-clockwise.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Widths and curls, in blade sizes.
    pub(super) sections: Sections,
    /// Metres of one blade size.
    pub(super) size: f32,
    /// Length of the outline, in blade sizes.
    pub(super) perimeter: f32,
    /// Area inside of it, in blade sizes.
    pub(super) area: f32,
}

/// Memory that is used again for every blade.
#[derive(Default)]
pub(super) struct FlatScratch {
    outline: OutlineScratch,
    interior: InteriorScratch,
    margin: Vec<MarginPoint>,
}

/// What the constrained Delaunay triangulation of a blade is built from; `None` for an outline without area.
pub fn triangulation_input(blade: &Blade, params: &BladeMeshParams) -> Option<PlanarGraph> {
    let scratch = &mut FlatScratch::default();
    prepare_margin(blade, params, scratch);
    Some(graph(&scratch.margin, density(blade, params), &mut scratch.interior)?.0)
}

/// Flattens a blade; `None` for an outline without area.
pub(super) fn flatten(
    blade: &Blade,
    params: &BladeMeshParams,
    scratch: &mut FlatScratch,
) -> Option<FlatBlade> {
    prepare_margin(blade, params, scratch);
    let density = density(blade, params);
    let FlatScratch { margin, interior, .. } = scratch;
    let (graph, sections, triangles) = triangulated(margin, density, interior)
        .or_else(|| triangulated(&outline::untangled(margin), density, interior))
        .or_else(|| triangulated(&outline::convex_hull(margin), density, interior))?;
    let size = size_of(blade);
    let rim = &graph.points[..graph.margin];
    let perimeter = (0..rim.len()).map(|i| rim[i].distance(rim[(i + 1) % rim.len()])).sum();
    let area = crate::geom::simple_loop::signed_area(rim.iter().copied());
    let PlanarGraph { mut points, margin } = graph;
    points.iter_mut().for_each(|p| *p *= size);
    Some(FlatBlade { points, margin, triangles, sections, size, perimeter, area })
}

fn triangulated(
    margin: &[MarginPoint],
    density: Density,
    scratch: &mut InteriorScratch,
) -> Option<(PlanarGraph, Sections, Vec<[u32; 3]>)> {
    let (graph, sections) = graph(margin, density, scratch)?;
    let triangles = graph.triangulate()?;
    Some((graph, sections, triangles))
}

/// The larger of a blade's length and extent: the unit of all tolerances.
fn size_of(blade: &Blade) -> f32 {
    let bounds = |(lo, hi): (Vec2, Vec2), p: &Vec2| (lo.min(*p), hi.max(*p));
    let (lo, hi) = blade.outline.iter().fold((Vec2::INFINITY, Vec2::NEG_INFINITY), bounds);
    (hi - lo).max_element()
}

fn density(blade: &Blade, params: &BladeMeshParams) -> Density {
    match blade.template {
        Some(_) => Density { rows: params.template_rows, columns: params.template_columns },
        None => Density { rows: params.rows, columns: params.columns },
    }
}

fn prepare_margin(blade: &Blade, params: &BladeMeshParams, scratch: &mut FlatScratch) {
    let Density { rows, .. } = density(blade, params);
    let tolerance =
        if blade.template.is_some() { params.template_tolerance } else { params.outline_tolerance };
    // A wave needs a few points; the outline of a blade is about two and a half times as long as the blade.
    let wave = if blade.form.ruffle > 0.0 { 0.6 / blade.form.ruffle_waves.max(1.0) } else { f32::INFINITY };
    let longest_edge = (1.5 / (rows + 1) as f32).min(wave).max(0.01);
    let outline = (&blade.outline[..], &blade.curl[..]);
    let detail = Detail { tolerance, longest_edge };
    outline::prepare(outline, size_of(blade), detail, &mut scratch.outline, &mut scratch.margin);
}

fn graph(
    margin: &[MarginPoint],
    density: Density,
    scratch: &mut InteriorScratch,
) -> Option<(PlanarGraph, Sections)> {
    /// An outline with less area than this, in squared blade sizes, encloses nothing that could be seen.
    const SMALLEST_AREA: f32 = 1e-5;
    let area = crate::geom::simple_loop::signed_area(margin.iter().map(|m| m.at));
    if margin.len() < 3 || area.is_nan() || area < SMALLEST_AREA {
        return None;
    }
    let sections = Sections::new(margin);
    let mut points = Vec::with_capacity(margin.len() + ((density.rows * (2 * density.columns + 1)) as usize));
    points.extend(margin.iter().map(|m| m.at));
    interior::fill(margin, &sections, density, scratch, &mut points);
    Some((PlanarGraph { points, margin: margin.len() }, sections))
}
