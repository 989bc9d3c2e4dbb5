//! Petals as the artist shaped them: Bézier patches whose control points are moved (003 §2.2; [`crate::sketch::petal_shapes`]).
//!
//! The control points are those of the patch that comes nearest to the petal on its cone, by least squares over 7 × 7 samples. They
//! are moved along the petal's own directions, and with them the surface, by the same polynomials. Its outline stays as it was
//! drawn, and so does its picture. Petals that others hide are patches already. All petals of a flower are moved by the same
//! shares of their lengths.
//!
//! The sheet is as wide everywhere as the petal at its widest, as for hidden petals: so its control points are far enough
//! from each other to be touched where the petal is narrow, and the same offsets mean the same of both.
//!
//! Where we depart: what a cone is beside its patch is kept and moved with it. Where a petal is seen on edge, its depth over the
//! drawing is too steep for cubics, which would be off by a quarter of its length near the base; so no petal jumps when the
//! first point is moved, and none leaves its flower. Samples beside the petal lie straight on from its margin: toward the apex a
//! cone is a kink.

use super::hidden_petals::MadePetal;
use crate::anatomy::Anatomy;
use crate::geom::simple_loop::crossings_at;
use crate::plant::{BezierPatch, Blade, PetalFrame, ResolvedBlade, RestSurface, Sheet};
use crate::sketch::petal_shapes::{Offsets, PetalShape, of_flowers};
use glam::{Vec2, Vec3};
use std::sync::Arc;

/// Share of a petal's half width from which to the margin its slope is taken.
const INNER: f32 = 0.8;
/// Least half width of a sheet as a share of its length.
const NARROWEST: f32 = 0.02;

/// The control points of a petal in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PetalNet {
    /// Metres; rows from base to tip, in each from left to right as the face is seen.
    pub points: [[Vec3; 4]; 4],
    /// What they are moved along.
    pub frame: PetalFrame,
}

impl PetalNet {
    /// That of a petal, shaped or not; nothing for a blade that is no drawn petal.
    pub fn of(blade: &ResolvedBlade<'_>) -> Option<Self> {
        let ways = match &blade.rest {
            RestSurface::Shaped { ways, .. } => *ways.control(),
            RestSurface::Cone { .. } => [[Vec3::ZERO; 4]; 4],
            RestSurface::Plane | RestSurface::Patch(_) | RestSurface::Ring(_) => return None,
        };
        let patch = fitted(&blade.unshaped()).moved(&ways);
        let points = patch.control().map(|row| row.map(|point| blade.placed(point)));
        Some(Self { points, frame: PetalFrame::of(blade) })
    }
}

/// The shape of each flower of a drawing.
pub(super) fn of_drawing<'a>(anatomy: &Anatomy, shapes: &'a [PetalShape]) -> Vec<Option<&'a PetalShape>> {
    if shapes.is_empty() {
        return vec![None; anatomy.flowers.len()];
    }
    let strokes = |petals: &[usize]| {
        let strokes = petals.iter().filter_map(|&petal| anatomy.petals[petal].stroke);
        strokes.map(|stroke| anatomy.drawn(stroke)).collect()
    };
    let flowers: Vec<_> = anatomy.flowers.iter().map(|flower| strokes(&flower.petals)).collect();
    of_flowers(shapes, &flowers)
}

/// The petal with its control points moved.
pub(super) fn shaped(petal: &MadePetal, offsets: &Offsets) -> MadePetal {
    let blade = petal.resolved();
    let frame = PetalFrame::of(&blade);
    let ways = offsets.map(|row| row.map(|offset| local(&blade, frame.way(offset))));
    let rest = match &petal.rest {
        RestSurface::Cone { cone, hint, sight } => {
            let ways = Arc::new(BezierPatch::new(ways, &sheet(&blade)));
            RestSurface::Shaped { cone: *cone, hint: *hint, sight: *sight, ways }
        }
        RestSurface::Patch(patch) => RestSurface::Patch(Arc::new(patch.moved(&ways))),
        other @ (RestSurface::Plane | RestSurface::Shaped { .. } | RestSurface::Ring(_)) => other.clone(),
    };
    Blade { rest, ..petal.clone() }
}

/// The patch that comes nearest to a petal on its cone.
fn fitted(blade: &ResolvedBlade<'_>) -> BezierPatch {
    let outline = blade.template.outline();
    let depth = |uv: Vec2| local(blade, blade.at_rest(uv) - blade.base).z;
    BezierPatch::fit(&sheet(blade), |uv| {
        let half = half_width(outline, uv.y);
        let depth = match uv.x.clamp(-half, half) {
            inside if inside == uv.x => depth(uv),
            margin => beyond(|u| depth(uv.with_x(u)), margin, uv.x),
        };
        uv.extend(depth)
    })
}

/// The sheet of a petal, from its base to its tip, everywhere as wide as the petal at its widest.
fn sheet(blade: &ResolvedBlade<'_>) -> Sheet {
    let length = blade.template.length();
    let widest = blade.template.outline().iter().map(|p| p.x.abs()).fold(0.0, f32::max);
    Sheet { along: (0.0, length), half_widths: [widest.max(NARROWEST * length); 4] }
}

/// The depth at `u` beside the margin: straight on from there.
fn beyond(depth: impl Fn(f32) -> f32, margin: f32, u: f32) -> f32 {
    let (at_margin, inner) = (depth(margin), INNER * margin);
    if inner == margin {
        return at_margin;
    }
    at_margin + (at_margin - depth(inner)) / (margin - inner) * (u - margin)
}

/// A way in the world along the directions of a blade's own plane.
fn local(blade: &ResolvedBlade<'_>, way: Vec3) -> Vec3 {
    let face = blade.u.cross(blade.v).normalize_or_zero();
    Vec3::new(way.dot(blade.u), way.dot(blade.v), way.dot(face))
}

/// How far a closed outline reaches from the axis at `v`, to the farther side.
fn half_width(outline: &[Vec2], v: f32) -> f32 {
    crossings_at(outline, v).map(f32::abs).fold(0.0, f32::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{BladeForm, Cone, Detail, Template};

    /// A petal on a cone about `axis`, a metre long in the drawing.
    fn petal(axis: Vec3, opening_deg: f32) -> MadePetal {
        let point = |k: usize| Vec2::from_angle(k as f32 * 0.1047) * Vec2::new(0.2, 0.5) + Vec2::Y * 0.5;
        let template = Template::new((0..60).map(point).collect(), Vec::new(), 1.0, Detail::Full);
        let cone = Cone {
            apex: Vec3::new(0.0, -0.1, 0.0),
            axis: axis.normalize(),
            opening_rad: opening_deg.to_radians(),
            height: 1.0,
        };
        let base = Vec3::new(0.0, 0.0, cone.depth_near(Vec2::ZERO, 0.0));
        let hint = cone.depth_near(Vec2::Y, 1.0);
        let (rest, form) = (RestSurface::Cone { cone, hint, sight: Vec3::Z }, BladeForm::default());
        Blade { template: Arc::new(template), base, u: Vec3::X, v: Vec3::Y, rest, form }
    }

    #[test]
    fn the_patch_of_a_petal_is_near_its_cone_and_a_shape_that_moves_nothing_is_the_cone() {
        for (axis, opening) in [(Vec3::new(0.1, 0.3, 1.0), 65.0), (Vec3::new(0.3, 1.0, 0.4), 50.0)] {
            let petal = petal(axis, opening);
            let (blade, patch) = (petal.resolved(), fitted(&petal.resolved()));
            let shaped = shaped(&petal, &Offsets::default());
            let length = PetalFrame::of(&blade).length;
            for uv in petal.template.outline() {
                let off = blade.at_rest(*uv).distance(blade.placed(patch.at(*uv))) / length;
                assert!(off < 0.06, "{off} of the length at {uv}, axis {axis}");
                assert!(blade.at_rest(*uv).distance(shaped.resolved().at_rest(*uv)) < 1e-6);
            }
        }
    }

    #[test]
    fn points_are_moved_along_the_petals_own_directions() {
        let petal = petal(Vec3::new(0.3, 1.0, 0.4), 50.0);
        let mut offsets = Offsets::default();
        offsets[3] = [Vec3::new(0.0, -0.1, 0.4); 4];
        let moved = shaped(&petal, &offsets);
        let frame = PetalFrame::of(&petal.resolved());
        let tip = moved.resolved().tip_at_rest() - petal.resolved().tip_at_rest();
        assert!(frame.offset(tip).distance(Vec3::new(0.0, -0.1, 0.4)) < 1e-3, "{tip}");
        let base = moved.resolved().at_rest(Vec2::ZERO).distance(petal.resolved().at_rest(Vec2::ZERO));
        assert!(base < 1e-3 * frame.length, "the base stays: {base}");
        // The net of a shaped petal is where it was moved to, and its directions are those that it had.
        let before = PetalNet::of(&petal.resolved()).unwrap();
        let after = PetalNet::of(&moved.resolved()).unwrap();
        assert_eq!((after.frame, frame), (before.frame, before.frame));
        let way = after.points[3][2] - before.points[3][2];
        assert!(frame.offset(way).distance(offsets[3][2]) < 1e-4, "{way}");
        assert!(after.points[0][0].distance(before.points[0][0]) < 1e-5);
    }

    #[test]
    fn a_petal_that_is_filled_in_is_moved_by_the_same_shares() {
        let sheet = Sheet { along: (0.0, 1.0), half_widths: [0.2; 4] };
        let flat = Arc::new(BezierPatch::fit(&sheet, |uv| uv.extend(0.0)));
        let petal = Blade { rest: RestSurface::Patch(flat), ..petal(Vec3::Y, 50.0) };
        let mut offsets = Offsets::default();
        offsets[3] = [Vec3::new(0.0, -0.1, 0.4); 4];
        let tip = shaped(&petal, &offsets).resolved().tip_at_rest() - petal.resolved().tip_at_rest();
        assert!(tip.distance(Vec3::new(0.0, -0.1, 0.4)) < 1e-5, "{tip}");
    }

    #[test]
    fn only_petals_are_nets() {
        let flat = Blade { rest: RestSurface::Plane, ..petal(Vec3::Y, 50.0) };
        assert_eq!(PetalNet::of(&flat.resolved()), None);
    }
}
