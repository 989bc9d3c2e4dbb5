//! Flesh: mushrooms and cacti. All tile around; stalk and cactus upward, too.
//!
//! Skin and gills of a mushroom lie on bodies of revolution, around and along their profile (`src/species/cap.rs`): the
//! skin's rim is at about a third of the height, its top at the upper edge; gills run from the stalk outward, up the picture.

use super::bark::tiled;
use super::color::{Lab, hex, lighter, over, smooth};
use super::noise::hash;
use glam::{IVec2, Vec2};

/// Pale stalk with faint fibres.
pub(crate) fn stalk(p: Vec2) -> Lab {
    let q = p + Vec2::new(0.01 * tiled(p, 5, 4, 2, 401), 0.0);
    let fibre = tiled(q, 50, 4, 3, 402);
    let mut c = over(hex(0xede2cf), hex(0xdccbb0), 0.4 + 0.5 * tiled(p, 4, 3, 4, 403));
    c = over(c, hex(0xc2a888), 0.22 * smooth(0.1, 0.5, tiled(q, 24, 5, 4, 404)));
    lighter(c, 0.03 * fibre)
}

/// Brown skin of a cap, darker at the top, streaked faintly from there to the pale rim.
pub(crate) fn cap(p: Vec2) -> Lab {
    // Toward the top all of the picture's width comes together in a point.
    let spread = smooth(1.0, 0.7, p.y);
    let streak = spread * tiled(p, 40, 3, 3, 411);
    let mottle = spread * tiled(p, 9, 7, 4, 412);
    let along = p.y + 0.05 * mottle + 0.02 * streak;
    let mut c = over(hex(0xb98f62), hex(0x9a6a41), smooth(0.34, 0.70, along));
    c = over(c, hex(0x7d4f2e), smooth(0.6, 1.05, along));
    c = over(c, hex(0xd4b48a), 0.5 * smooth(0.50, 0.33, along));
    c = over(c, hex(0x6e4427), 0.16 * smooth(0.05, 0.5, streak) + 0.14 * smooth(0.0, 0.5, mottle));
    lighter(c, 0.022 * spread * tiled(p, 70, 44, 2, 413))
}

/// Gills, close together, from the stalk to the rim; between two long ones a shorter one that begins farther out.
pub(crate) fn gills(p: Vec2) -> Lab {
    const COUNT: i32 = 84;
    let place = COUNT as f32 * p.x + 0.25 * tiled(p, 12, 3, 3, 421);
    let (gill, t) = (place.round(), 2.0 * (place - place.round()).abs());
    let id = hash(IVec2::new((gill as i32).rem_euclid(COUNT), 0), 422);
    let is_short = (gill as i32).rem_euclid(2) == 1;
    let edge = if is_short { smooth(0.14, 0.3, p.y + 0.1 * (id - 0.5)) } else { 1.0 };
    let rise = edge * smooth(0.95, 0.25, t);
    let c = over(hex(0x8d6a54), hex(0xe3cdb6), rise);
    lighter(over(c, hex(0xd8b7a0), 0.5 * (id - 0.3)), 0.02 * tiled(p, 30, 20, 2, 423))
}

/// Ribs of a cactus up the picture.
const RIBS: i32 = 5;
/// Cushions of spines up each rib.
const AREOLES: i32 = 5;

/// Green ribs with cushions of pale spines along their backs.
pub(crate) fn cactus(p: Vec2) -> Lab {
    let place = RIBS as f32 * p.x;
    let rib = (place.floor() as i32).rem_euclid(RIBS);
    let t = place - place.floor() - 0.5;
    let back = 1.0 - smooth(0.0, 0.5, t.abs());
    let mut c = over(hex(0x2f5530), hex(0x6f9a58), smooth(0.0, 0.9, back));
    c = lighter(c, 0.03 * smooth(0.3, -0.3, t) - 0.05 * smooth(0.42, 0.5, t.abs()));
    c = over(c, hex(0x8fae7c), 0.22 * smooth(-0.1, 0.5, tiled(p, 10, 6, 4, 431)));
    c = lighter(c, 0.02 * tiled(p, 60, 40, 3, 432));
    // Cushions of two ribs side by side stand at different heights.
    let height = AREOLES as f32 * p.y + hash(IVec2::new(rib, 3), 433);
    let middle = height - height.floor() - 0.5;
    let at = Vec2::new(t / RIBS as f32, middle / AREOLES as f32);
    let number = (height.floor() as i32).rem_euclid(AREOLES);
    let wool = smooth(0.016, 0.009, (at * Vec2::new(1.0, 0.8)).length() + 0.002 * tiled(p, 80, 80, 2, 434));
    c = lighter(c, -0.10 * smooth(0.05, 0.012, (at + Vec2::new(-0.006, 0.012)).length()));
    c = over(c, lighter(hex(0xcbbf9c), 0.06 * tiled(p, 120, 120, 2, 435)), 0.95 * wool);
    over(c, hex(0xf0e8cc), 0.9 * spines(at, rib * AREOLES + number))
}

/// Spines around the middle of a cushion, 0 to 1.
fn spines(at: Vec2, cushion: i32) -> f32 {
    const SPINES: i32 = 9;
    let spine = |k: i32| {
        let random = |seed| hash(IVec2::new(cushion, k), seed) - 0.5;
        let angle = std::f32::consts::TAU * (k as f32 + 0.6 * random(441)) / SPINES as f32;
        let direction = Vec2::from_angle(angle);
        let (along, aside) = (at.dot(direction), at.perp_dot(direction));
        let length = 0.048 * (1.0 + 0.6 * random(442));
        let half = 0.0022 * (1.0 - (along / length).clamp(0.0, 1.0)) + 0.0006;
        smooth(half + 0.0012, half, aside.abs())
            * smooth(0.0, 0.004, along)
            * smooth(length, 0.85 * length, along)
    };
    (0..SPINES).map(spine).fold(0.0, f32::max)
}
