//! The pot of a potted plant: earth at the foot of the lowest trunk, the pot below it.
//!
//! The plant stays where it was drawn, so the pot reaches below the ground plane y = 0.

use super::looks::PotLook;
use crate::plant::{Plant, Shape};
use glam::{Vec2, Vec3};

/// Outside from the bottom up, over the rim and down the inside: shares of the rim's radius and of the height.
const PROFILE: [(f32, f32); 11] = [
    (0.0, 0.0),
    (0.62, 0.0),
    (0.68, 0.03),
    (0.88, 0.78),
    (0.98, 0.79),
    (1.0, 0.82),
    (1.0, 0.97),
    (0.97, 1.0),
    (0.9, 0.98),
    (0.86, 0.8),
    (0.0, 0.8),
];
/// Height of the earth and radius of its edge, same shares.
const EARTH: (f32, f32) = (0.86, 0.88);
/// Room between the outermost trunk and the rim, in trunk radii.
const ROOM: f32 = 2.0;

/// Pot and earth, in this order; `None` for a plant without branches.
pub(super) fn pot(look: &PotLook, plant: &Plant) -> Option<[Shape; 2]> {
    let trunks = || plant.branches.iter().filter(|b| b.parent.is_none());
    let lowest = trunks().min_by(|a, b| a.points[0].y.total_cmp(&b.points[0].y))?;
    let bottom = lowest.points[0];
    let tallest = plant.branches.iter().flat_map(|b| &b.points).map(|p| p.y).fold(bottom.y, f32::max);
    let height = look.height * (tallest - bottom.y);
    let rim = height * look.radius;
    // stems that rise side by side share the pot
    let stems = || trunks().filter(|b| flat(b.points[0] - bottom).length() < 2.0 * rim);
    let count = stems().count().max(1) as f32;
    let middle = bottom + flat(stems().map(|b| b.points[0] - bottom).sum::<Vec3>() / count);
    let needed = stems().map(|b| flat(b.points[0] - middle).length() + ROOM * b.radii[0]).fold(0.0, f32::max);
    let rim = rim.max(needed / EARTH.1);
    if height <= 0.0 || rim <= 0.0 {
        return None;
    }
    let base = middle - Vec3::Y * (EARTH.0 * height);
    let profile = PROFILE.iter().map(|(r, h)| Vec2::new(r * rim, h * height)).collect();
    let mound = Shape::Dome {
        base: middle - Vec3::Y * (0.02 * height),
        axis: Vec3::Y,
        radius: EARTH.1 * rim,
        height: 0.06 * height,
    };
    Some([Shape::Lathe { base, axis: Vec3::Y, profile }, mound])
}

fn flat(v: Vec3) -> Vec3 {
    Vec3::new(v.x, 0.0, v.z)
}
