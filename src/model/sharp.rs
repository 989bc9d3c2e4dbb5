//! Faces of a leaf whose front and back meet at its margin, so that it needs no rim.
//!
//! Front and back share the points of the margin. An edge inside that joined two of these would belong to both faces, and four
//! triangles would meet there; so every edge inside has to have an end of its own. Where all of the outline is seen from one
//! place on its middle line, triangles lead from there to every edge: as many as there are edges, and the
//! midrib is an edge of the mesh from base to tip. Of other outlines every edge between two points of the margin is divided,
//! unless a rim has fewer triangles.
//!
//! Limits: the faces of a fan are as slender as its outline.

use super::planar_graph::PlanarGraph;
use super::sections::Sections;
use glam::Vec2;

/// Places on the middle line that are tried.
const PLACES: u32 = 15;
/// Least distance of such a place from every line along an edge, as a share of the largest half width.
const CLEAR: f32 = 0.12;

/// The place on the middle line from which all of an outline is seen best; `None` if there is none.
pub(super) fn heart(margin: &[Vec2], sections: &Sections) -> Option<Vec2> {
    let at = |k: u32| {
        let v = sections.low + (sections.high - sections.low) * k as f32 / (PLACES + 1) as f32;
        Vec2::new(sections.middle.at(v), v)
    };
    let clearance = |place: Vec2| {
        let ahead = margin.iter().cycle().skip(1);
        let off = margin.iter().zip(ahead).map(|(from, to)| {
            (*to - *from).try_normalize().map_or(f32::NEG_INFINITY, |along| along.perp_dot(place - *from))
        });
        off.fold(f32::INFINITY, f32::min)
    };
    let places = (1..=PLACES).map(|k| (clearance(at(k)), at(k)));
    let (clear, place) = places.max_by(|a, b| a.0.total_cmp(&b.0))?;
    (clear > CLEAR * sections.widest).then_some(place)
}

/// Faces around the point that follows so many points of the margin.
pub(super) fn fan(margin: usize) -> Vec<[u32; 3]> {
    let n = margin as u32;
    (0..n).map(|i| [i, if i + 1 == n { 0 } else { i + 1 }, n]).collect()
}

/// How many edges inside join two of so many points of the margin.
pub(super) fn chords(triangles: &[[u32; 3]], margin: usize) -> usize {
    let edges = triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    // Each belongs to two faces, in either direction.
    edges.filter(|&(from, to)| from < to && is_chord((from, to), margin as u32)).count()
}

/// Whether an edge joins two of so many points of the margin that do not follow one another.
fn is_chord((from, to): (u32, u32), margin: u32) -> bool {
    let follows = |a: u32, b: u32| b == a + 1 || (b == 0 && a + 1 == margin);
    from < margin && to < margin && !follows(from, to) && !follows(to, from)
}

/// Divides every edge inside that joins two points of the margin.
pub(super) fn split_chords(graph: &mut PlanarGraph, triangles: &mut Vec<[u32; 3]>) {
    let n = graph.margin as u32;
    let mut at = 0;
    while at < triangles.len() {
        let chord = (0..3).find(|&k| is_chord((triangles[at][k], triangles[at][(k + 1) % 3]), n));
        let Some(corner) = chord else {
            at += 1;
            continue;
        };
        let (from, to) = (triangles[at][corner], triangles[at][(corner + 1) % 3]);
        let middle = graph.points.len() as u32;
        graph.points.push(0.5 * (graph.points[from as usize] + graph.points[to as usize]));
        for (a, b) in [(from, to), (to, from)] {
            split_edge(triangles, (a, b), middle);
        }
    }
}

/// Divides the face that has this edge in this direction.
fn split_edge(triangles: &mut Vec<[u32; 3]>, (a, b): (u32, u32), middle: u32) {
    let has = |face: &[u32; 3], k: usize| face[k] == a && face[(k + 1) % 3] == b;
    let found = triangles.iter().enumerate().find_map(|(i, face)| Some((i, (0..3).find(|k| has(face, *k))?)));
    let Some((face, corner)) = found else { return };
    let opposite = triangles[face][(corner + 2) % 3];
    triangles[face] = [a, middle, opposite];
    triangles.push([middle, b, opposite]);
}

#[cfg(test)]
mod tests {
    use super::super::flat::{BladeMeshParams, FlatBlade, FlatScratch, flatten};
    use super::super::outline::MarginPoint;
    use super::super::planar_graph::TriangulationScratch;
    use super::*;
    use crate::geom::simple_loop::signed_area;
    use crate::plant::{Detail, Template};

    fn flat(outline: &[(f32, f32)]) -> FlatBlade {
        let outline = outline.iter().map(|p| Vec2::from(*p)).collect();
        let template = Template::new(outline, Vec::new(), 1.0, Detail::Reduced);
        flatten(&template, None, &BladeMeshParams::default(), &mut FlatScratch::default()).unwrap()
    }

    fn sections(points: &[Vec2]) -> Sections {
        let margin: Vec<MarginPoint> = points.iter().map(|&at| MarginPoint { at, curl: 0.0 }).collect();
        Sections::new(&margin, 1.0)
    }

    #[test]
    fn a_leaf_is_a_fan_around_its_midrib() {
        let leaf = flat(&[(0.0, 0.0), (0.25, 0.4), (0.15, 0.75), (0.0, 1.0), (-0.15, 0.75), (-0.25, 0.4)]);
        assert_eq!((leaf.margin, leaf.triangles.len(), leaf.triangle_count()), (6, 6, 12));
        assert!(leaf.points[6].x.abs() < 1e-6);
    }

    #[test]
    fn edges_between_points_of_the_margin_are_divided() {
        let hooked = [(0.0, 0.0), (0.3, 0.1), (0.05, 0.2), (0.06, 0.8), (0.3, 0.9), (0.0, 1.0), (-0.05, 0.5)];
        let points: Vec<Vec2> = hooked.map(Vec2::from).to_vec();
        let whole = signed_area(points.iter().copied());
        let mut graph = PlanarGraph { points, margin: 7, midrib: Vec::new() };
        assert!(heart(&graph.points, &sections(&graph.points)).is_none());
        let mut triangles = graph.triangulate(&mut TriangulationScratch::default()).unwrap();
        assert_eq!((triangles.len(), chords(&triangles, 7)), (5, 4));
        split_chords(&mut graph, &mut triangles);
        assert_eq!((triangles.len(), chords(&triangles, 7)), (13, 0));
        let area = |[a, b, c]: [u32; 3]| {
            let [a, b, c] = [a, b, c].map(|i| graph.points[i as usize]);
            0.5 * (b - a).perp_dot(c - a)
        };
        assert!(triangles.iter().all(|face| area(*face) > 0.0));
        assert!((triangles.iter().map(|face| area(*face)).sum::<f32>() - whole).abs() < 1e-6);
    }

    #[test]
    fn sprays_of_needles_keep_their_rim() {
        let teeth = (0..8).flat_map(|k| [(0.4, 0.1 * k as f32 + 0.12), (0.03, 0.1 * k as f32 + 0.16)]);
        let right: Vec<(f32, f32)> = teeth.collect();
        let left = right.iter().rev().map(|(x, y)| (-x, *y));
        let spray: Vec<(f32, f32)> =
            [(0.0, 0.0)].into_iter().chain(right.iter().copied()).chain([(0.0, 1.0)]).chain(left).collect();
        let spray = flat(&spray);
        assert!(!spray.is_sharp && spray.triangle_count() <= 40);
    }
}
