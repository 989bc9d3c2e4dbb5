//! The bark of trees, about a metre of it; tiles in both directions.
//!
//! Bark is painted as a relief: a height for every point, darkened where it is deep and shaded by its slope, as the sky lights
//! it. Ridges lie between families of lines that wander up the tile, some to the left and some to the right, and
//! that open and close on their way: so ridges are long, part, join and are interlaced. What differs over large distances is faint,
//! so that a thick trunk does not show where the picture begins again.
//! Limits: the shading is part of the picture, so light from below looks wrong.

use super::bark::tiled;
use super::color::{Lab, hex, lighter, over, smooth};
use super::noise::{gradient, hash};
use glam::{IVec2, Vec2};

/// How far apart the slope of a relief is measured, of the tile.
const STEP: f32 = 0.0025;

/// Gradient noise over the tile: `x` by `y` lattice points.
fn wave(p: Vec2, x: i32, y: i32, seed: u32) -> f32 {
    gradient(p * Vec2::new(x as f32, y as f32), IVec2::new(x, y), seed)
}

/// How much light a relief catches at `p` from the upper left, about −1 to 1 for slopes that rise by `steep` of its height.
fn shade(p: Vec2, height: impl Fn(Vec2) -> f32) -> f32 {
    let toward = Vec2::new(-0.8, 0.6) * STEP;
    (height(p - toward) - height(p + toward)).clamp(-1.0, 1.0)
}

/// One family of lines up the tile: `count` of them, each at the place of another `climb` further at the top, and wandering
/// by about `wander` of the space between two. Distance from the nearest, in shares of the tile.
fn strip(p: Vec2, count: i32, climb: i32, wander: f32, seed: u32) -> f32 {
    let aside = wander * (0.9 * tiled(p, 3, 3, 2, seed) + 0.24 * tiled(p, count, 12, 3, seed + 4));
    let place = count as f32 * p.x + climb as f32 * p.y + aside;
    (place - place.round()).abs() / count as f32
}

/// How open a crack is, 0 to 1, at a distance from its middle, if it is `half` as wide.
fn crack(distance: f32, half: f32) -> f32 {
    smooth(half, 0.2 * half, distance)
}

/// Distance from the nearest crack across strips, `rows` of them up the tile, at other heights in each of `count` strips.
fn steps(p: Vec2, rows: i32, count: i32, seed: u32) -> f32 {
    let uneven = 1.5 * tiled(p, count, 2, 1, seed + 5) + 0.45 * tiled(p, 14, 9, 3, seed);
    let height = rows as f32 * p.y + uneven;
    (height - height.round()).abs() / rows as f32
}

/// Ridges and fissures, 0 to 1: long ridges between lines that climb to either side, on them shorter cracks, on these grain.
fn ridges(p: Vec2) -> f32 {
    let rough = tiled(p, 56, 18, 4, 20);
    let left = strip(p, 11, 1, 1.2, 11);
    let right = strip(p, 10, -1, 1.2, 14);
    let open = |seed| smooth(-0.52, -0.08, tiled(p, 11, 4, 2, seed));
    let half = 0.016 + 0.004 * tiled(p, 9, 4, 2, 19) + 0.009 * rough;
    let deep = (open(17) * crack(left, half)).max(open(18) * crack(right, half));
    let second = strip(p, 21, -2, 1.2, 22);
    let middle = crack(second, 0.011 + 0.005 * rough) * smooth(-0.25, 0.15, tiled(p, 14, 6, 2, 25));
    let third = strip(p, 47, 3, 1.4, 26);
    let fine = crack(third, 0.004) * smooth(-0.1, 0.25, tiled(p, 24, 10, 2, 29));
    let across =
        crack(steps(p, 9, 11, 130), 0.006 + 0.003 * rough) * smooth(-0.05, 0.2, tiled(p, 14, 10, 2, 31));
    let round = smooth(0.0, 0.05, left.min(right));
    let cut = deep.max(0.66 * middle).max(0.42 * fine).max(0.5 * across);
    (1.0 - cut) * (0.70 + 0.30 * round) + 0.22 * rough
}

/// Deep fissures between long interlaced ridges: oak, old willow.
pub(crate) fn fissured(p: Vec2) -> Lab {
    let height = ridges(p);
    let ridge = over(hex(0x75685c), hex(0x94887b), 0.5 + 0.7 * tiled(p, 9, 5, 4, 21));
    let c = over(hex(0x332a23), hex(0x5f5348), smooth(0.0, 0.4, height));
    let c = over(c, ridge, smooth(0.2, 0.85, height));
    let moss = smooth(0.1, 0.5, tiled(p, 5, 4, 5, 22)) * smooth(0.35, 0.7, height);
    let c = over(c, hex(0x7d8262), 0.22 * moss);
    let crust = smooth(0.3, 0.42, tiled(p, 11, 9, 4, 23)) * smooth(0.5, 0.75, height);
    lighter(over(c, hex(0xb0aea0), 0.3 * crust), 0.20 * shade(p, ridges) + 0.05 * tiled(p, 110, 50, 3, 24))
}

/// Plates of a pine, 0 to 1, flaky on top.
fn plates(p: Vec2) -> f32 {
    let rough = tiled(p, 40, 26, 4, 32);
    let left = strip(p, 7, 1, 0.9, 33);
    let right = strip(p, 6, -1, 0.9, 36);
    let open = |seed| smooth(-0.4, -0.1, tiled(p, 7, 4, 2, seed));
    let half = 0.018 + 0.008 * rough;
    let long = (open(39) * crack(left, half)).max(open(40) * crack(right, half));
    let across =
        crack(steps(p, 5, 7, 140), 0.013 + 0.006 * rough) * smooth(-0.4, -0.1, tiled(p, 7, 6, 2, 45));
    (1.0 - long.max(0.85 * across)) * (0.62 + 0.3 * flakes(p)) + 0.12 * rough
}

/// Flakes that lie over one another like contour lines, 0 to 1.
fn flakes(p: Vec2) -> f32 {
    let layers = 8.0 * (0.5 + 0.85 * tiled(p, 9, 6, 5, 47));
    (layers.floor() + smooth(0.0, 0.3, layers - layers.floor())) / 8.0
}

/// Flaky plates between dark cracks: pine, spruce.
pub(crate) fn plated(p: Vec2) -> Lab {
    let height = plates(p);
    let plate = over(hex(0x7c5f50), hex(0xb0917a), flakes(p) + 0.5 * tiled(p, 30, 20, 3, 41));
    let plate = over(plate, hex(0x8f8480), 0.4 * smooth(0.0, 0.4, tiled(p, 9, 7, 4, 42)));
    let c = over(hex(0x2e221d), hex(0x6b4636), smooth(0.0, 0.3, height));
    let c = over(c, plate, smooth(0.2, 0.65, height));
    lighter(c, 0.16 * shade(p, plates) + 0.03 * tiled(p, 80, 60, 2, 43))
}

/// Thin scales that lie over one another, 0 to 1, parted by short cracks up the trunk.
fn scales(p: Vec2) -> f32 {
    let rough = tiled(p, 50, 36, 4, 142);
    let layers = 5.0 * (0.5 + 0.8 * tiled(p, 15, 8, 4, 143));
    let layer = (layers.floor() + smooth(0.0, 0.16, layers - layers.floor())) / 5.0;
    let left = strip(p, 19, 1, 1.3, 147);
    let right = strip(p, 16, -2, 1.3, 150);
    let open = |seed| smooth(-0.1, 0.25, tiled(p, 17, 7, 3, seed));
    let half = 0.006 + 0.004 * rough;
    let long = (open(153) * crack(left, half)).max(open(156) * crack(right, half));
    let across = crack(steps(p, 17, 19, 159), 0.004) * smooth(0.0, 0.3, tiled(p, 20, 14, 2, 165));
    (1.0 - long.max(0.5 * across)) * (0.45 + 0.5 * layer) + 0.12 * rough
}

/// Grey bark with short cracks, warm where scales came off: apple, olive.
pub(crate) fn cracked(p: Vec2) -> Lab {
    let height = scales(p);
    let scale = over(hex(0x776b60), hex(0x9d9286), 0.5 + 0.6 * tiled(p, 20, 12, 4, 167));
    let deep = smooth(0.62, 0.45, height);
    let scale = over(scale, hex(0x8a6a52), 0.65 * deep * smooth(-0.2, 0.3, tiled(p, 8, 6, 4, 168)));
    let c = over(hex(0x3d332b), hex(0x64584c), smooth(0.0, 0.3, height));
    let c = over(c, scale, smooth(0.2, 0.6, height));
    let lichen = smooth(0.26, 0.34, tiled(p, 8, 9, 6, 161)) * smooth(0.45, 0.7, height);
    let c = over(c, hex(0xa9ad95), 0.4 * lichen);
    lighter(c, 0.2 * shade(p, scales) + 0.05 * tiled(p, 100, 70, 2, 163))
}

/// Long fibres, 0 to 1, in strips that lie beside one another and come loose.
fn fibres(p: Vec2) -> f32 {
    let q = p + Vec2::new(0.02 * tiled(p, 3, 4, 3, 170), 0.0);
    let broad = strip(q, 15, 1, 0.9, 171);
    let narrow = strip(q, 34, -1, 0.8, 175);
    let open = smooth(-0.4, 0.1, tiled(p, 15, 3, 2, 179));
    let cut = (open * crack(broad, 0.011))
        .max(0.6 * smooth(-0.3, 0.2, tiled(p, 30, 4, 2, 181)) * crack(narrow, 0.007));
    (1.0 - cut) * (0.72 + 0.35 * tiled(q, 90, 4, 3, 190)) + 0.1 * tiled(q, 18, 3, 2, 193)
}

/// Red-brown strips of fibres, weathered grey: cypress, ivy.
pub(crate) fn stringy(p: Vec2) -> Lab {
    let height = fibres(p);
    let strip = over(hex(0x7d5b47), hex(0xa68c78), 0.5 + 0.8 * tiled(p, 16, 3, 4, 195));
    let strip = over(strip, hex(0xa39a90), 0.55 * smooth(-0.1, 0.35, tiled(p, 9, 4, 4, 196)));
    let c = over(hex(0x33231b), hex(0x66483a), smooth(0.0, 0.4, height));
    let c = over(c, strip, smooth(0.25, 0.75, height));
    lighter(c, 0.16 * shade(p, fibres) + 0.03 * tiled(p, 120, 12, 2, 197))
}

/// Where a branch was shed, seen from the point: distance to its eye in radii, and distance below the brow over it.
fn scar(p: Vec2, middle: Vec2, radius: f32) -> (f32, f32) {
    let d = (p - middle + 1.5).fract() - 0.5;
    let eye = (d / Vec2::new(1.25, 0.8)).length() / radius;
    (eye, d.y - radius * 1.3 + 1.1 * (d.x * d.x + 0.1 * radius * radius).sqrt())
}

/// Thin grey bark with fine upright cracks, patches of lichen and scars of branches: maple, beech.
pub(crate) fn smooth_grey(p: Vec2) -> Lab {
    let q = p + Vec2::new(0.025 * tiled(p, 5, 3, 3, 51), 0.02 * tiled(p, 4, 6, 3, 52));
    let mut c = over(
        hex(0x8b857e),
        hex(0xa29b92),
        0.5 + 0.45 * tiled(p, 5, 4, 5, 53) + 0.3 * tiled(q, 18, 50, 3, 54),
    );
    let long = strip(p, 17, 1, 1.1, 55);
    let long = crack(long, 0.0045) * smooth(0.0, 0.3, tiled(p, 17, 4, 2, 58));
    let fine = strip(p, 41, -2, 1.3, 65);
    let fine = crack(fine, 0.003) * smooth(0.0, 0.3, tiled(p, 30, 8, 2, 69));
    c = over(c, hex(0x504942), 0.6 * long.max(0.6 * fine));
    for (middle, radius) in
        [(Vec2::new(0.27, 0.68), 0.034), (Vec2::new(0.71, 0.21), 0.022), (Vec2::new(0.52, 0.93), 0.016)]
    {
        let (eye, brow) = scar(p + Vec2::splat(0.006 * tiled(p, 20, 20, 2, 59)), middle, radius);
        let near = smooth(3.2, 1.0, eye);
        c = over(c, hex(0x5a534c), 0.4 * near * smooth(0.4, 0.0, (brow / radius).abs()));
        c = lighter(c, 0.035 * near * (9.0 * eye).sin());
        c = over(c, hex(0x544b43), 0.45 * smooth(1.0, 0.35, eye));
    }
    let lichen = smooth(0.3, 0.36, tiled(p, 7, 8, 6, 61)) * (0.75 + 0.5 * tiled(p, 40, 40, 2, 67));
    c = over(c, over(hex(0xb4b7a6), hex(0x989e88), 0.5 + tiled(p, 30, 30, 3, 62)), 0.5 * lichen);
    let crust = smooth(0.36, 0.4, tiled(p, 15, 16, 5, 63));
    lighter(over(c, hex(0xc0bfb6), 0.45 * crust), 0.03 * tiled(p, 90, 70, 2, 64))
}

/// Horizontal pores, 0 to 1: lenses of every size, where stretched noise is highest; `share` of the rows have them.
fn pores(p: Vec2, columns: i32, rows: i32, share: f32, seed: u32) -> f32 {
    let q = p + Vec2::new(0.0, 0.008 * tiled(p, 5, 7, 2, seed));
    let rise = wave(q, columns, rows, seed + 1) + 0.1 * tiled(p, 60, 60, 1, seed + 2);
    let rows_with = smooth(0.0, 0.25, tiled(p, 2, rows / 4, 2, seed + 3) + share - 0.5);
    smooth(0.36, 0.5, rise) * rows_with
}

/// Satin bark with bands and horizontal pores: cherry.
pub(crate) fn cherry(p: Vec2) -> Lab {
    let q = p + Vec2::new(0.0, 0.015 * tiled(p, 4, 4, 3, 71));
    let mut c = over(hex(0x5f3b31), hex(0x855a49), 0.5 + 0.5 * tiled(q, 4, 14, 4, 72));
    c = over(c, hex(0x9b857a), 0.22 * smooth(0.0, 0.45, tiled(q, 5, 12, 5, 73)));
    c = lighter(c, 0.03 * tiled(q, 4, 70, 3, 74) + 0.02 * tiled(q, 70, 8, 2, 75));
    let (pore, fine) = (pores(p, 8, 44, 0.62, 76), pores(p, 18, 90, 0.5, 80));
    let below = pores(p + Vec2::new(0.0, 0.005), 8, 44, 0.62, 76);
    c = lighter(c, -0.10 * (below - pore).max(0.0));
    c = over(c, lighter(hex(0xae8461), 0.08 * tiled(p, 60, 60, 2, 84)), 0.85 * pore.max(0.6 * fine));
    // Old layers come off in bands around the trunk.
    let edge = 3.0 * q.y + 0.4 * wave(p, 3, 2, 85);
    let (edge, peeled) = (edge - edge.round(), smooth(0.05, 0.3, wave(p, 3, 5, 86)));
    c = over(c, hex(0x3d2620), 0.7 * peeled * smooth(0.02, 0.0, edge.abs()));
    over(c, hex(0xb79c88), 0.45 * peeled * smooth(0.0, 0.01, edge) * smooth(0.05, 0.01, edge))
}

/// White paper bark that peels around the trunk, with dark pores and rough scars: birch.
pub(crate) fn birch(p: Vec2) -> Lab {
    let q = p + Vec2::new(0.0, 0.012 * tiled(p, 4, 5, 3, 91));
    let mut c = over(hex(0xefebe2), hex(0xd3cabd), 0.4 + 0.6 * tiled(q, 3, 9, 5, 92));
    c = over(c, hex(0xdcc0a6), 0.3 * smooth(0.1, 0.5, tiled(q, 3, 5, 4, 93)));
    c = lighter(c, 0.022 * tiled(q, 6, 90, 3, 94));
    for (layers, seed) in [(4.0, 95), (7.0, 98)] {
        // Each sheet ends at a torn edge: light on its rim, tan bark and a shadow under it.
        let edge = layers * q.y + 0.45 * wave(p, 3, 3, seed) + 0.06 * tiled(p, 18, 9, 3, seed + 1);
        let d = (edge - edge.round()) / layers;
        let peeled = smooth(0.1, 0.3, wave(p, 4, 6, seed + 2));
        c = over(c, hex(0xcf9f7c), 0.75 * peeled * smooth(-0.03, -0.004, d) * smooth(0.0, -0.002, d));
        c = over(c, hex(0x6f5442), 0.7 * peeled * smooth(0.004, 0.0, (d + 0.003).abs()));
        c = lighter(c, 0.04 * peeled * smooth(0.0, 0.002, d) * smooth(0.012, 0.003, d));
    }
    c = over(c, hex(0x4a433e), 0.8 * pores(p, 6, 30, 0.5, 102).max(0.6 * pores(p, 13, 70, 0.45, 106)));
    let torn = 0.6 * (wave(p, 4, 7, 110) + wave(p + 0.13, 5, 6, 113)) + 0.16 * tiled(p, 14, 24, 4, 111);
    let black = lighter(hex(0x2d2826), 0.10 * tiled(p, 30, 16, 4, 112));
    over(c, black, 0.92 * smooth(0.62, 0.7, torn))
}

/// Rings where fronds were, one above the other, and fibres between them: palm.
pub(crate) fn palm(p: Vec2) -> Lab {
    const RINGS: i32 = 7;
    let q = p + Vec2::new(0.012 * tiled(p, 6, 4, 3, 121), 0.0);
    let height = RINGS as f32 * p.y + 0.26 * wave(p, 2, 3, 122) + 0.13 * tiled(p, 12, 10, 3, 123);
    let (ring, t) = (height.floor(), height - height.floor());
    let of_ring = hash(IVec2::new(0, (ring as i32).rem_euclid(RINGS)), 124) - 0.5;
    let fibre = tiled(q, 90, 5, 3, 125);
    let mut c = over(hex(0x7d6c58), hex(0xa6957c), 0.5 + 0.5 * tiled(p, 4, 5, 5, 126) + 0.25 * of_ring);
    c = lighter(c, 0.10 * fibre + 0.035 * (t - 0.5));
    let frayed = smooth(0.5, 0.0, t + 0.6 * fibre);
    c = over(c, hex(0x55452f), 0.35 * frayed);
    let split = smooth(0.07, 0.0, wave(q, 30, 5, 127).abs()) * smooth(0.0, 0.4, tiled(p, 9, 9, 2, 128));
    c = over(c, hex(0x3b2f24), 0.5 * split);
    c = over(c, hex(0xc0b193), 0.45 * smooth(0.78, 0.93, t) * smooth(1.0, 0.95, t));
    over(c, hex(0x33291f), 0.8 * smooth(0.11, 0.0, t) + 0.5 * smooth(0.985, 1.0, t))
}
