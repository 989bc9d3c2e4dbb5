//! Petals on their flower's cone (000 §4.1 steps 5 to 7, 002 §5.1 eq. 3).
//!
//! A petal keeps its drawn outline exactly, seen from the front; its depth comes from the cone. Of the cone's two
//! depths over a point the petal takes the one that leads on to its tip. The face of a petal is its inner side, toward
//! the cone's axis: petals that lean toward the viewer show their back.

use super::outline::{BladeFrame, CurlParams, outline_of};
use crate::anatomy::FlatBlade;
use crate::plant::{Blade, BladeForm, Cone, Detail, RestSurface, Template, WorldFromCanvas};
use glam::{Vec2, Vec3};
use std::sync::Arc;

/// A petal on a cone; `tip_depth` is the world depth of its tip.
pub fn petal(
    flat: &FlatBlade,
    cone: &Cone,
    tip_depth: f32,
    world: &WorldFromCanvas,
    curl: &CurlParams,
) -> Blade<Arc<Template>> {
    let base = world.point(flat.root).truncate();
    let axis = world.vector(flat.axis()).truncate();
    let middle = base + 0.5 * axis;
    let hint = 0.5 * (tip_depth + cone.apex.z);
    let facing = faces_viewer(cone, middle.extend(cone.depth_near(middle, hint)));
    let frame = BladeFrame::new(flat, world, !facing);
    let (outline, curls) = outline_of(flat, &frame, world, curl);
    Blade {
        template: Arc::new(Template::new(outline, curls, axis.length(), Detail::Full)),
        base: base.extend(cone.depth_near(base, cone.apex.z)),
        u: frame.u.extend(0.0),
        v: frame.v.extend(0.0),
        rest: RestSurface::Cone { cone: *cone, hint: tip_depth, sight: Vec3::Z },
        form: BladeForm::default(),
    }
}

/// Whether the inner side of the cone at a point on it is turned to the viewer.
fn faces_viewer(cone: &Cone, on_cone: Vec3) -> bool {
    let w = on_cone - cone.apex;
    let outward = (w - cone.axis * w.dot(cone.axis)).normalize_or_zero();
    let inward = cone.axis * cone.opening_rad.sin() - outward * cone.opening_rad.cos();
    inward.z >= 0.0
}

/// Mean distance of the petals' roots from the flower's centre, in canvas pixels.
pub fn root_distance<'a>(petals: impl Iterator<Item = &'a FlatBlade>, center: Vec2) -> f32 {
    let (sum, count) = petals.fold((0.0, 0.0f32), |(sum, n), p| (sum + p.root.distance(center), n + 1.0));
    sum / count.max(1.0)
}
