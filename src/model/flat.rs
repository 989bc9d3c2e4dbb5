//! A blade while it is still flat: outline and interior points joined by triangles (`planar_graph`), or for small leaves by a fan
//! (`sharp`).
//!
//! The midrib is a chain of edges, too. A blade is lowest along it, and where a narrow blade has rows farther apart than
//! its margins, plain Delaunay faces would reach from margin to margin and dam the hollow between two rows. Where a
//! piece of the chain would cross the outline it is left out.
//!
//! An outline that turns out to cross itself is cut down to its largest simple part; failing that, its convex hull
//! is used. Only an outline without area has no triangulation.

use super::{
    interior::{self, Density, InteriorScratch},
    outline::{self, MarginPoint, OutlineScratch, Precision},
    planar_graph::{PlanarGraph, TriangulationScratch},
    sections::Sections,
    sharp,
};
use crate::geom::convex_hull::convex_hull;
use crate::plant::{BladeForm, Detail, ResolvedBlade, Template};
use glam::Vec2;
crate::parameters! {
    /// How finely petals, leaves and sepals are modelled.
    pub struct BladeMeshParams {
        /// What nobody drew is one part of each kind on a plant, leaves and flowers alike; otherwise each is its own. Always so for
        /// plants that grew.
        gathered: bool = true, 0..=1, "";
        /// How far a blade's margin may leave the drawn outline.
        outline_tolerance: f32 = 0.002, 0.0001..=0.002, "of the blade's size";
        /// Rows of points between base and tip; more rows bend more smoothly.
        rows: u32 = 5, 0..=64, "";
        /// Columns of points between midrib and margin at the widest place.
        columns: u32 = 2, 0..=32, "";
        /// The same tolerance for generated leaves, which are many and small.
        template_tolerance: f32 = 0.02, 0.0001..=0.1, "of the blade's size";
        /// Most points that carry a generated leaf's outline; a five-lobed leaf needs ten.
        template_outline_points: u32 = 10, 4..=200, "";
        /// How far the margin of a petal of a full flower may leave its outline.
        petal_tolerance: f32 = 0.006, 0.0001..=0.1, "of the blade's size";
        /// Most points that carry the outline of such a petal.
        petal_outline_points: u32 = 40, 4..=400, "";
        /// Rows of points in petals of full flowers.
        petal_rows: u32 = 4, 0..=64, "";
        /// Columns of points in petals of full flowers.
        petal_columns: u32 = 1, 0..=32, "";
        /// Rows of points in generated leaves.
        template_rows: u32 = 1, 0..=64, "";
        /// Columns of points in generated leaves.
        template_columns: u32 = 0, 0..=32, "";
        /// Generated leaves are as thick at their margin as printers want it; otherwise both faces meet there, and a leaf has a
        /// third to a half of the triangles.
        solid_leaves: bool = false, 0..=1, "";
        /// Thickness at the margin as a share of the thickness in the middle.
        margin_thickness: f32 = 0.5, 0.1..=1.0, "";
        /// How far the pen's full pressure lifts the margin.
        curl_height: f32 = 0.15, 0.0..=0.5, "of the blade's length";
    }
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
    /// Both faces of the blade meet at the margin: then no edge inside joins two points of the margin. Otherwise it has a rim.
    pub(super) is_sharp: bool,
}

impl FlatBlade {
    /// Triangles of a blade of this outline, with both faces and the rim.
    pub(super) fn triangle_count(&self) -> usize {
        2 * (self.triangles.len() + if self.is_sharp { 0 } else { self.margin })
    }
}

/// Memory that is used again for every blade.
#[derive(Default)]
pub(super) struct FlatScratch {
    outline: OutlineScratch,
    margin: Vec<MarginPoint>,
    inside: InsideScratch,
}

#[derive(Default)]
struct InsideScratch {
    interior: InteriorScratch,
    triangulation: TriangulationScratch,
}

/// What the constrained Delaunay triangulation of a blade is built from; `None` for an outline without area.
pub fn triangulation_input(blade: &ResolvedBlade<'_>, params: &BladeMeshParams) -> Option<PlanarGraph> {
    let (template, scratch) = (blade.template, &mut FlatScratch::default());
    prepare_margin(template, waves_of(&blade.form), params, scratch);
    let tip = template.length() / size_of(template);
    Some(graph(&scratch.margin, tip, density(template, params), &mut scratch.inside.interior)?.0)
}

/// The waves along a blade's margin for which its triangulation has to have points.
pub(super) fn waves_of(form: &BladeForm) -> Option<f32> {
    (form.ruffle > 0.0).then_some(form.ruffle_waves)
}

/// Flattens a template, whose blades have so many waves along their margin; in reduced detail they have no points of their
/// own, so that all blades of such a template have one triangulation. `None` for an outline without area.
pub(super) fn flatten(
    template: &Template,
    waves: Option<f32>,
    params: &BladeMeshParams,
    scratch: &mut FlatScratch,
) -> Option<FlatBlade> {
    prepare_margin(template, waves, params, scratch);
    let inner = Inner { density: density(template, params), is_sharp: may_be_sharp(template, params) };
    let FlatScratch { margin, inside, .. } = scratch;
    let size = size_of(template);
    let tip = template.length() / size;
    let Inside { graph, sections, triangles, is_sharp } = triangulated(margin, tip, inner, inside)
        .or_else(|| triangulated(&outline::untangled(margin), tip, inner, inside))
        .or_else(|| triangulated(&convex_hull(margin, |m| m.at), tip, inner, inside))?;
    let rim = &graph.points[..graph.margin];
    let perimeter = (0..rim.len()).map(|i| rim[i].distance(rim[(i + 1) % rim.len()])).sum();
    let area = crate::geom::simple_loop::signed_area(rim.iter().copied());
    let PlanarGraph { mut points, margin, .. } = graph;
    points.iter_mut().for_each(|p| *p *= size);
    Some(FlatBlade { points, margin, triangles, sections, size, perimeter, area, is_sharp })
}

/// Whether both faces of a template's blades may meet at their margin.
pub(super) fn may_be_sharp(template: &Template, params: &BladeMeshParams) -> bool {
    template.detail() == Detail::Reduced && !params.solid_leaves
}

/// What is made inside of an outline.
#[derive(Clone, Copy)]
struct Inner {
    density: Density,
    is_sharp: bool,
}

/// An outline with its faces.
struct Inside {
    graph: PlanarGraph,
    sections: Sections,
    triangles: Vec<[u32; 3]>,
    is_sharp: bool,
}

fn triangulated(
    margin: &[MarginPoint],
    tip: f32,
    inner: Inner,
    scratch: &mut InsideScratch,
) -> Option<Inside> {
    let has_one_row = inner.density.rows == 1 && inner.density.columns == 0;
    if inner.is_sharp
        && has_one_row
        && let Some(fan) = fan(margin, tip)
    {
        return Some(fan);
    }
    let (mut graph, sections) = graph(margin, tip, inner.density, &mut scratch.interior)?;
    let mut triangles = graph.triangulate(&mut scratch.triangulation)?;
    let rim = margin.len();
    // Each edge that is divided costs two triangles a face: of outlines with many deep notches more than a rim does.
    let is_sharp = inner.is_sharp && 2 * sharp::chords(&triangles, rim) <= rim;
    if is_sharp {
        sharp::split_chords(&mut graph, &mut triangles);
    }
    Some(Inside { graph, sections, triangles, is_sharp })
}

/// Faces from one point on the middle line to every edge of the outline, if it is seen from there.
fn fan(margin: &[MarginPoint], tip: f32) -> Option<Inside> {
    let sections = has_area(margin).then(|| Sections::new(margin, tip))?;
    let mut points: Vec<Vec2> = margin.iter().map(|m| m.at).collect();
    let heart = sharp::heart(&points, &sections)?;
    points.push(heart);
    let graph = PlanarGraph { points, margin: margin.len(), midrib: Vec::new() };
    let triangles = sharp::fan(margin.len());
    Some(Inside { graph, sections, triangles, is_sharp: true })
}

/// The larger of a blade's length and extent: the unit of all tolerances.
fn size_of(template: &Template) -> f32 {
    let bounds = |(lo, hi): (Vec2, Vec2), p: &Vec2| (lo.min(*p), hi.max(*p));
    let (lo, hi) = template.outline().iter().fold((Vec2::INFINITY, Vec2::NEG_INFINITY), bounds);
    (hi - lo).max_element()
}

fn density(template: &Template, params: &BladeMeshParams) -> Density {
    match template.detail() {
        Detail::Reduced => Density { rows: params.template_rows, columns: params.template_columns },
        Detail::Moderate => Density { rows: params.petal_rows, columns: params.petal_columns },
        Detail::Full => Density { rows: params.rows, columns: params.columns },
    }
}

fn prepare_margin(
    template: &Template,
    waves: Option<f32>,
    params: &BladeMeshParams,
    scratch: &mut FlatScratch,
) {
    let Density { rows, .. } = density(template, params);
    let (tolerance, most_points, waves) = match template.detail() {
        Detail::Reduced => (params.template_tolerance, params.template_outline_points as usize, None),
        Detail::Moderate => (params.petal_tolerance, params.petal_outline_points as usize, None),
        Detail::Full => (params.outline_tolerance, usize::MAX, waves),
    };
    // A spray of needles is widest at a quarter of its length: from there to its tip it is one edge.
    let longest_edge = if template.detail() == Detail::Reduced { 1.6 } else { 1.5 };
    // A wave needs a few points; the outline of a blade is about two and a half times as long as the blade.
    let wave = waves.map_or(f32::INFINITY, |waves| 0.6 / waves.max(1.0));
    let longest_edge = (longest_edge / (rows + 1) as f32).min(wave).max(0.01);
    let outline = (template.outline(), template.curl());
    let precision = Precision { tolerance, longest_edge, most_points };
    outline::prepare(outline, size_of(template), precision, &mut scratch.outline, &mut scratch.margin);
}

fn graph(
    margin: &[MarginPoint],
    tip: f32,
    density: Density,
    scratch: &mut InteriorScratch,
) -> Option<(PlanarGraph, Sections)> {
    let sections = has_area(margin).then(|| Sections::new(margin, tip))?;
    let mut points = Vec::with_capacity(margin.len() + ((density.rows * (2 * density.columns + 1)) as usize));
    points.extend(margin.iter().map(|m| m.at));
    let middle = interior::fill(margin, &sections, density, scratch, &mut points);
    let midrib = midrib(middle, &points[..margin.len()], tip);
    Some((PlanarGraph { points, margin: margin.len(), midrib }, sections))
}

/// Whether an outline encloses anything that could be seen.
fn has_area(margin: &[MarginPoint]) -> bool {
    /// In squared blade sizes.
    const SMALLEST_AREA: f32 = 1e-5;
    let area = crate::geom::simple_loop::signed_area(margin.iter().map(|m| m.at));
    margin.len() >= 3 && area >= SMALLEST_AREA
}

/// The interior points on the middle line between base and tip; empty without such points.
fn midrib(middle: &[usize], margin: &[Vec2], tip: f32) -> Vec<usize> {
    if middle.is_empty() {
        return Vec::new();
    }
    let away = |i: &usize| margin[*i].distance_squared(Vec2::new(0.0, tip));
    let tip = (0..margin.len()).min_by(|a, b| away(a).total_cmp(&away(b)));
    // The outline begins at the base.
    [0].into_iter().chain(middle.iter().copied()).chain(tip).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::simple_loop::signed_area;

    fn flat(outline: &[(f32, f32)], detail: Detail) -> Option<FlatBlade> {
        let outline: Vec<Vec2> = outline.iter().copied().map(Vec2::from).collect();
        let template = Template::new(outline, Vec::new(), 1.0, detail);
        flatten(&template, None, &BladeMeshParams::default(), &mut FlatScratch::default())
    }

    fn covered(flat: &FlatBlade) -> f32 {
        let corner = |t: &[u32; 3]| t.map(|i| flat.points[i as usize]);
        flat.triangles.iter().map(corner).map(|t| signed_area(t.into_iter())).sum()
    }

    #[test]
    fn a_notch_stays_open() {
        let heart = [(0.0, 0.0), (0.5, 0.6), (0.3, 1.0), (0.0, 0.7), (-0.3, 1.0), (-0.5, 0.6)];
        let flat = flat(&heart, Detail::Full).unwrap();
        let drawn = signed_area(heart.into_iter().map(Vec2::from));
        assert!((covered(&flat) - drawn).abs() < 1e-4);
        assert!((40..=130).contains(&flat.triangles.len()), "{} faces", flat.triangles.len());
    }

    #[test]
    fn an_outline_that_crosses_itself_keeps_its_larger_part() {
        let tail = [(0.754, 0.98), (-0.764, 0.87), (0.0, 0.0), (0.801, 0.0), (0.833, -0.06), (0.0, 0.505)];
        let flat = flat(&tail, Detail::Full).unwrap();
        assert!(covered(&flat) > 0.5);
        assert!(flat.points[..flat.margin].iter().all(|p| p.y > -1e-3));
    }

    #[test]
    fn no_face_of_a_narrow_blade_reaches_over_its_midrib() {
        let lens = |k: usize| {
            let angle = std::f32::consts::TAU * k as f32 / 120.0;
            (0.04 * angle.sin(), 0.5 - 0.5 * angle.cos())
        };
        let outline: Vec<(f32, f32)> = (0..120).map(lens).collect();
        let flat = flat(&outline, Detail::Full).unwrap();
        assert!(flat.points.len() > flat.margin + 3, "{} points inside", flat.points.len() - flat.margin);
        let across = flat
            .triangles
            .iter()
            .map(|face| face.map(|i| flat.points[i as usize].x))
            .filter(|x| x.iter().any(|x| *x > 1e-4) && x.iter().any(|x| *x < -1e-4));
        assert_eq!(across.count(), 0);
    }

    #[test]
    fn a_narrow_template_keeps_its_two_sides() {
        let oval: Vec<(f32, f32)> =
            (0..90).map(|k| (0.004 * (k as f32 * 0.07).cos(), 0.5 + 0.5 * (k as f32 * 0.07).sin())).collect();
        let flat = flat(&oval, Detail::Reduced).unwrap();
        assert!((covered(&flat) - 0.00628).abs() < 1e-3);
    }

    #[test]
    fn an_outline_without_area_has_no_triangulation() {
        assert!(flat(&[(0.0, 0.0), (0.0, 0.5), (0.0, 1.0)], Detail::Full).is_none());
        assert!(flat(&[(0.0, 0.0), (0.0, 0.0), (0.0, 0.0)], Detail::Full).is_none());
    }

    #[test]
    fn template_leaves_are_light() {
        let closed = |radius: fn(f32) -> f32| {
            let point = |k: usize| {
                let a = k as f32 * std::f32::consts::TAU / 240.0;
                (0.5 * radius(a) * a.sin(), 0.5 - 0.5 * radius(a) * a.cos())
            };
            let leaf: Vec<(f32, f32)> = (0..240).map(point).collect();
            let flat = flat(&leaf, Detail::Reduced).unwrap();
            flat.triangle_count()
        };
        let oval = closed(|a| 0.5 + 0.5 * a.cos().powi(2));
        let maple = closed(|a| 1.0 - 0.5 * (2.5 * a).cos().powi(2));
        assert!(oval <= 20 && maple <= 20, "{oval} and {maple} faces");
    }
}
