//! Noise that tiles: value noise, its sum over octaves, gradient noise (Perlin) and cells (Worley). All from an integer
//! hash, so the same everywhere.
//!
//! Source: K. Perlin, "Improving noise", 2002; S. Worley, "A cellular texture basis function", 1996.

use glam::{IVec2, Vec2};

/// Period of noise that need not tile.
pub(crate) const ENDLESS: IVec2 = IVec2::splat(1 << 16);

/// Uniform number in 0..1 for a lattice point.
pub(crate) fn hash(at: IVec2, seed: u32) -> f32 {
    let mut h = (at.x as u32).wrapping_mul(0x8da6_b343)
        ^ (at.y as u32).wrapping_mul(0xd816_3841)
        ^ seed.wrapping_mul(0xcb1a_b31f);
    h = (h ^ (h >> 16)).wrapping_mul(0x7feb_352d);
    h = (h ^ (h >> 15)).wrapping_mul(0x846c_a68b);
    ((h ^ (h >> 16)) >> 8) as f32 / 16_777_216.0
}

/// Smooth noise, −1 to 1, one lattice point per unit, repeating after `period` units.
pub(crate) fn value(p: Vec2, period: IVec2, seed: u32) -> f32 {
    let cell = p.floor();
    let f = p - cell;
    let f = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let corner = |dx, dy| hash((cell.as_ivec2() + IVec2::new(dx, dy)).rem_euclid(period), seed);
    let low = corner(0, 0) + (corner(1, 0) - corner(0, 0)) * f.x;
    let high = corner(0, 1) + (corner(1, 1) - corner(0, 1)) * f.x;
    2.0 * (low + (high - low) * f.y) - 1.0
}

/// Sum of `octaves` of noise, each twice as fine and half as strong, about −1 to 1.
pub(crate) fn fractal(p: Vec2, period: IVec2, octaves: u32, seed: u32) -> f32 {
    let layer = |o: u32| {
        let fine = (1 << o) as f32;
        value(p * fine, period * (1 << o), seed.wrapping_add(o)) / fine
    };
    (0..octaves).map(layer).sum::<f32>() * 0.6
}

/// Smooth noise, about −1 to 1, that is 0 on the lattice points. Its zero lines wander freely across the lattice, where those
/// of [`value`] keep to its squares.
pub(crate) fn gradient(p: Vec2, period: IVec2, seed: u32) -> f32 {
    let cell = p.floor();
    let f = p - cell;
    let s = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let corner = |dx: i32, dy: i32| {
        let angle =
            std::f32::consts::TAU * hash((cell.as_ivec2() + IVec2::new(dx, dy)).rem_euclid(period), seed);
        Vec2::from_angle(angle).dot(f - Vec2::new(dx as f32, dy as f32))
    };
    let low = corner(0, 0) + (corner(1, 0) - corner(0, 0)) * s.x;
    let high = corner(0, 1) + (corner(1, 1) - corner(0, 1)) * s.x;
    1.5 * (low + (high - low) * s.y)
}

/// What is known about a point among cells.
pub(crate) struct Cell {
    /// Distance to the border between the two nearest cells: 0 on it, positive inside.
    pub(crate) border: f32,
    /// Distance to the middle of the nearest cell.
    pub(crate) middle: f32,
    /// Random number of the nearest cell, 0..1.
    pub(crate) id: f32,
}

/// Cells around one random point per lattice square.
pub(crate) fn cells(p: Vec2, period: IVec2, seed: u32) -> Cell {
    let here = p.floor().as_ivec2();
    let mut nearest = [(f32::MAX, 0.0); 2];
    for k in 0..9 {
        let square = here + IVec2::new(k % 3 - 1, k / 3 - 1);
        let home = square.rem_euclid(period);
        let offset = Vec2::new(hash(home, seed), hash(home, seed ^ 0x55)) * 0.8 + 0.1;
        let found = ((square.as_vec2() + offset).distance(p), hash(home, seed ^ 0xaa));
        if found.0 < nearest[0].0 {
            nearest = [found, nearest[0]];
        } else if found.0 < nearest[1].0 {
            nearest[1] = found;
        }
    }
    Cell { border: 0.5 * (nearest[1].0 - nearest[0].0), middle: nearest[0].0, id: nearest[0].1 }
}
