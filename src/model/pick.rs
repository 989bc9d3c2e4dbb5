//! Which branch or organ of a plant a ray meets first, for pointers in a view of the plant.
//!
//! The ray meets what is seen, the triangles of the model; parts gather many branches and organs, so the place that is
//! hit is then given to the nearest branch or organ of the part's kind: the branch in whose bark it lies, the blade in
//! whose outline and nearest to whose surface it lies. One pass over all triangles and copies in parallel: some
//! milliseconds for a large tree, which a click may cost and a hovering pointer may not.

use super::{Copies, Mesh, Model, Part, PartKind, Placement};
use crate::geom::ray::Ray;
use crate::plant::{Branch, Organ, OrganKind, Plant, Provenance, ResolvedBlade, Shape};
use glam::{Vec2, Vec3};
use rayon::prelude::*;
use std::sync::Arc;

/// Triangles that one thread takes at a time.
const CHUNK: usize = 16_384;

/// What was hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Element {
    /// The branch of this index.
    Branch(usize),
    /// The organ of this index.
    Organ(usize),
}

/// A branch or organ under a pointer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Picked {
    /// What it is.
    pub element: Element,
    /// Distance from the ray's origin, metres.
    pub distance: f32,
}

impl Element {
    /// The stroke that drew it, or else the nearest of the branches that it grows on which was drawn; `None` where no
    /// stroke stands behind it.
    pub fn stroke(self, plant: &Plant, provenance: &Provenance) -> Option<u64> {
        match self {
            Self::Branch(branch) => provenance.stroke_under(plant, Some(branch)),
            Self::Organ(index) => {
                let organ = plant.organs.get(index)?;
                provenance.stroke(organ.origin).or_else(|| provenance.stroke_under(plant, organ.branch))
            }
        }
    }
}

/// The first branch or organ that the ray meets.
pub fn pick(model: &Model, plant: &Plant, ray: &Ray) -> Option<Picked> {
    let (distance, part) = first_hit(model, ray)?;
    let at = ray.at(distance);
    let element = match model.parts[part].kind {
        PartKind::Wood => nearest(&plant.branches, |branch| Some(off_bark(branch, at))).map(Element::Branch),
        PartKind::Organ(kind) => {
            nearest(&plant.organs, |organ| off_organ(plant, organ, kind, at)).map(Element::Organ)
        }
        PartKind::Ground => None,
    };
    element.map(|element| Picked { element, distance })
}

/// Distance along the ray to the nearest triangle, and its part.
fn first_hit(model: &Model, ray: &Ray) -> Option<(f32, usize)> {
    let nearest_of = |part: &Part| {
        let chunks = part.mesh.triangles.par_chunks(CHUNK);
        let nearest = |chunk: &[[u32; 3]]| {
            let hits = chunk.iter().filter_map(|triangle| ray.meets(part.mesh.corners(*triangle)));
            hits.min_by(f32::total_cmp)
        };
        let of_copies = part.copies.as_ref().and_then(|copies| first_of_copies(copies, ray));
        chunks.filter_map(nearest).chain(of_copies).min_by(f32::total_cmp)
    };
    let hits = model.parts.par_iter().enumerate();
    // Of two parts at one distance the first, on any number of threads.
    hits.filter_map(|(part, one)| Some((nearest_of(one)?, part)))
        .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
}

/// Distance along the ray to the nearest triangle of copies. Most are passed over because the ray passes by a ball around
/// them.
fn first_of_copies(copies: &Copies, ray: &Ray) -> Option<f32> {
    let reach = |shape: &Arc<Mesh>| shape.points.iter().map(|point| point.length()).fold(0.0, f32::max);
    let reaches: Vec<f32> = copies.shapes.iter().map(reach).collect();
    let meets = |placement: &Placement| {
        let shape = copies.shapes.get(placement.shape as usize)?;
        // No stretch is longer than both of its axes together.
        let stretch = placement.u.length() + placement.v.length();
        let along = (placement.base - ray.origin).dot(ray.direction).max(0.0);
        if ray.at(along).distance(placement.base) > reaches[placement.shape as usize] * stretch {
            return None;
        }
        let points: Vec<Vec3> = placement.places(&shape.points).collect();
        let corners =
            |triangle: &[u32; 3]| shape.point_triangle(*triangle).map(|point| points[point as usize]);
        let hits = shape.triangles.iter().filter_map(|triangle| ray.meets(corners(triangle)));
        hits.min_by(f32::total_cmp)
    };
    copies.placements.par_iter().with_min_len(CHUNK).filter_map(meets).min_by(f32::total_cmp)
}

/// Index of the item with the smallest measure, the first of several; those without one are passed over.
fn nearest<T>(items: &[T], measure: impl Fn(&T) -> Option<f32>) -> Option<usize> {
    let measured = items.iter().enumerate().filter_map(|(i, item)| Some((measure(item)?, i)));
    measured.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, i)| i)
}

/// How far a point lies outside of a branch's bark, metres; negative inside.
fn off_bark(branch: &Branch, at: Vec3) -> f32 {
    let segments = branch.points.windows(2).zip(branch.radii.windows(2));
    let off = segments.map(|(ends, radii)| {
        let (share, distance) = beside_segment(ends[0], ends[1], at);
        distance - (radii[0] + (radii[1] - radii[0]) * share)
    });
    off.fold(f32::INFINITY, f32::min)
}

/// The share of a segment at which it is nearest to a point, and the distance there.
fn beside_segment(from: Vec3, to: Vec3, at: Vec3) -> (f32, f32) {
    let way = to - from;
    let length_squared = way.length_squared();
    let share =
        if length_squared > 0.0 { ((at - from).dot(way) / length_squared).clamp(0.0, 1.0) } else { 0.0 };
    (share, at.distance(from + way * share))
}

/// How far a point lies from an organ of this kind, metres; `None` for one of another kind.
fn off_organ(plant: &Plant, organ: &Organ, kind: OrganKind, at: Vec3) -> Option<f32> {
    (organ.kind() == kind).then(|| match &organ.shape {
        Shape::Blade(blade) => off_blade(&plant.templates.resolve(blade), at),
        Shape::Dome { base, .. } => at.distance(*base),
        Shape::Filament { points, .. } => {
            let off = points.windows(2).map(|ends| beside_segment(ends[0], ends[1], at).1);
            off.fold(f32::INFINITY, f32::min)
        }
        Shape::Card { base, v, .. } => beside_segment(*base, *base + *v, at).1,
        Shape::Spike { base, tip, .. } => beside_segment(*base, *tip, at).1,
        Shape::Lathe { base, axis, profile } => {
            let top = profile.iter().map(|place| place.y).fold(0.0, f32::max);
            beside_segment(*base, *base + *axis * top, at).1
        }
    })
}

/// Inside a blade's outline the distance from its rest surface, beside it that from its axis and more than its length, so
/// that a blade which holds the point comes first.
fn off_blade(blade: &ResolvedBlade<'_>, at: Vec3) -> f32 {
    let from_base = at - blade.base;
    let along = |axis: Vec3| from_base.dot(axis) / axis.length_squared().max(f32::MIN_POSITIVE);
    let uv = Vec2::new(along(blade.u), along(blade.v));
    if is_inside(blade.template.outline(), uv) {
        return at.distance(blade.at_rest(uv));
    }
    let tip = blade.tip_at_rest();
    blade.template.length() + beside_segment(blade.base, tip, at).1
}

/// Whether a closed outline holds a point: even–odd rule.
fn is_inside(outline: &[Vec2], p: Vec2) -> bool {
    let ends = outline.iter().zip(outline.iter().cycle().skip(1));
    let crossings = ends
        .filter(|(a, b)| (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y));
    crossings.count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outlines_hold_what_is_in_them() {
        let notched = [(0.0, 0.0), (2.0, 0.0), (1.0, 1.0), (2.0, 2.0), (0.0, 2.0)].map(Vec2::from);
        assert!(is_inside(&notched, Vec2::new(0.5, 1.0)) && is_inside(&notched, Vec2::new(1.5, 0.2)));
        assert!(!is_inside(&notched, Vec2::new(1.5, 1.0)) && !is_inside(&notched, Vec2::new(-0.1, 1.0)));
    }

    #[test]
    fn segments_are_near_at_their_ends_and_between() {
        let beside = |x: f32| beside_segment(Vec3::ZERO, Vec3::X, Vec3::new(x, 1.0, 0.0));
        assert_eq!(beside(0.25), (0.25, 1.0));
        assert_eq!((beside(-3.0).0, beside(9.0).0), (0.0, 1.0));
        assert_eq!(beside_segment(Vec3::X, Vec3::X, Vec3::ZERO), (0.0, 1.0));
    }
}
