//! Stems, bark, clay and earth: all tile in both directions.

use super::color::{Lab, hex, lighter, over, smooth};
use super::noise::{cells, fractal, value};
use glam::{IVec2, Vec2};

/// Noise over the tile: `x` by `y` lattice points.
fn tiled(p: Vec2, x: i32, y: i32, octaves: u32, seed: u32) -> f32 {
    fractal(p * Vec2::new(x as f32, y as f32), IVec2::new(x, y), octaves, seed)
}

/// Smooth herbaceous stem with faint ribs.
pub(crate) fn stem(p: Vec2, light: u32, dark: u32) -> Lab {
    let ribs = (p.x * std::f32::consts::TAU * 7.0 + 0.8 * tiled(p, 3, 2, 2, 3)).sin();
    let fibre = tiled(p, 36, 3, 2, 5);
    let spots = tiled(p, 4, 5, 4, 7);
    let c = over(hex(light), hex(dark), 0.4 + 0.55 * spots);
    lighter(c, 0.016 * ribs + 0.02 * fibre)
}

/// Deep vertical cracks between long plates: oak, old willow.
pub(crate) fn fissured(p: Vec2, plate: u32, crack: u32, moss: u32) -> Lab {
    let warp = Vec2::new(0.055 * tiled(p, 5, 6, 4, 11), 0.05 * tiled(p, 6, 5, 3, 12));
    let plates = cells((p + warp) * Vec2::new(9.0, 3.0), IVec2::new(9, 3), 13);
    let rough = tiled(p + warp, 26, 7, 4, 14);
    let depth = smooth(0.02, 0.2, plates.border + 0.07 * rough);
    let ridge = over(hex(plate), lighter(hex(plate), 0.10), plates.id);
    let mut c = lighter(ridge, 0.09 * rough + 0.05 * smooth(0.15, 0.4, plates.border));
    c = over(c, hex(moss), 0.4 * smooth(0.05, 0.45, tiled(p, 3, 3, 4, 15)) * depth);
    over(hex(crack), c, 0.06 + 0.94 * depth)
}

/// Thin grey bark with shallow cracks and lichen: maple.
pub(crate) fn smooth_grey(p: Vec2, base: u32, dark: u32, lichen: u32) -> Lab {
    let warp = Vec2::new(0.05 * tiled(p, 4, 3, 3, 21), 0.0);
    let cracks = cells((p + warp) * Vec2::new(12.0, 3.0), IVec2::new(12, 3), 22);
    let grain = tiled(p + warp, 30, 8, 3, 23);
    let mut c = lighter(over(hex(base), hex(dark), 0.35 + 0.6 * tiled(p, 5, 3, 4, 24)), 0.05 * grain);
    let cut = 1.0 - smooth(0.01, 0.075, cracks.border + 0.03 * grain);
    c = over(c, hex(dark), 0.85 * cut);
    let patch = smooth(0.16, 0.3, tiled(p, 4, 4, 4, 25));
    over(c, hex(lichen), 0.5 * patch)
}

/// Horizontal pores: lens-shaped marks in rows, `rows` up the tile.
fn lenticels(p: Vec2, columns: i32, rows: i32, seed: u32) -> f32 {
    let warp = Vec2::new(0.0, 0.012 * tiled(p, 6, 4, 2, seed));
    let q = (p + warp) * Vec2::new(columns as f32, rows as f32);
    let cell = q.floor().as_ivec2().rem_euclid(IVec2::new(columns, rows));
    let random = |s: u32| super::noise::hash(cell, seed + s);
    let f = q - q.floor() - 0.5;
    let half = 0.14 + 0.3 * random(1);
    let lens = 1.0 - (f.x / half).powi(2);
    let thick = 0.10 + 0.16 * random(3);
    let d = (f.y - 0.35 * (random(2) - 0.5)).abs() / thick;
    if random(4) < 0.35 || lens <= 0.0 { 0.0 } else { smooth(1.0, 0.55, d / lens.sqrt()) }
}

/// Satin bark with rings and pores: cherry.
pub(crate) fn cherry(p: Vec2) -> Lab {
    let rings = tiled(p, 2, 14, 3, 31);
    let satin = tiled(p, 3, 30, 2, 32);
    let mut c = over(hex(0x6e4438), hex(0x8f6350), 0.5 + 0.8 * rings);
    c = over(c, hex(0xa58d80), 0.45 * smooth(0.1, 0.4, tiled(p, 3, 5, 4, 33)));
    c = lighter(c, 0.03 * satin);
    let shadow = lenticels(p + Vec2::new(0.0, 0.008), 5, 14, 34);
    let pore = lenticels(p, 5, 14, 34);
    c = lighter(c, -0.12 * (shadow - pore).max(0.0));
    over(c, lighter(hex(0xb98a63), 0.05 * tiled(p, 40, 40, 1, 35)), 0.9 * pore)
}

/// White paper bark with dark pores and torn scars: birch.
pub(crate) fn birch(p: Vec2) -> Lab {
    let paper = tiled(p, 3, 10, 4, 41);
    let mut c = over(hex(0xece7dc), hex(0xcfc5b6), 0.35 + 0.8 * paper);
    c = over(c, hex(0xe2c3a4), 0.35 * smooth(0.15, 0.45, tiled(p, 2, 4, 3, 42)));
    c = lighter(c, 0.02 * tiled(p, 6, 60, 2, 43));
    c = over(c, hex(0x4b4540), 0.85 * lenticels(p, 6, 22, 44));
    let torn = cells(
        (p + Vec2::new(0.06 * tiled(p, 5, 5, 3, 45), 0.03 * tiled(p, 7, 7, 3, 46))) * 3.0,
        IVec2::splat(3),
        47,
    );
    let scar = smooth(0.30, 0.18, torn.middle + 0.12 * tiled(p, 12, 9, 3, 48)) * smooth(0.5, 0.62, torn.id);
    over(c, lighter(hex(0x2f2a28), 0.06 * tiled(p, 20, 30, 2, 49)), scar)
}

/// Green culm with one node per tile: bamboo.
pub(crate) fn bamboo(p: Vec2) -> Lab {
    let fibre = tiled(p, 48, 2, 2, 51);
    let patch = tiled(p, 3, 2, 4, 52);
    let mut c = over(hex(0x7fa045), hex(0x9bb35a), 0.5 + 0.6 * patch);
    c = over(c, hex(0xc3b66a), 0.35 * smooth(0.1, 0.5, tiled(p, 5, 2, 3, 53)));
    c = lighter(c, 0.02 * fibre);
    let h = p.y - 0.5;
    c = over(c, hex(0xd9dcb6), 0.7 * smooth(-0.15, -0.02, h) * smooth(0.0, -0.02, h));
    c = over(c, hex(0x55662e), 0.75 * smooth(0.22, 0.02, h) * smooth(0.0, 0.02, h));
    c = over(c, hex(0x6a5a34), (-(h / 0.010).powi(2)).exp());
    over(c, hex(0xb6a877), 0.8 * (-((h - 0.028) / 0.008).powi(2)).exp())
}

/// Young woody shoot with small pores.
pub(crate) fn twig(p: Vec2) -> Lab {
    let grain = tiled(p, 26, 5, 3, 61);
    let c = over(hex(0x7a624c), hex(0x8e7a5e), 0.5 + 0.8 * tiled(p, 4, 4, 4, 62));
    over(lighter(c, 0.05 * grain), hex(0xc0aa88), 0.6 * lenticels(p, 9, 16, 63))
}

/// Fired clay with throwing marks, pale salts and dust.
pub(crate) fn terracotta(p: Vec2) -> Lab {
    let rings = value(p * Vec2::new(1.0, 60.0), IVec2::new(1, 60), 71) + tiled(p, 2, 24, 2, 72);
    let cloud = tiled(p, 4, 4, 5, 73);
    let mut c = over(hex(0xb9653f), hex(0xc97e55), 0.5 + 0.9 * cloud);
    c = lighter(c, 0.008 * rings + 0.016 * tiled(p, 60, 60, 2, 74));
    c = over(c, hex(0xe0c3a8), 0.30 * smooth(0.05, 0.7, tiled(p, 3, 4, 5, 75)));
    let grain = cells(p * 40.0, IVec2::splat(40), 76);
    over(c, hex(0x8a4a30), 0.35 * smooth(0.88, 0.97, grain.id) * smooth(0.42, 0.2, grain.middle))
}

/// Potting earth: crumbs of three sizes and pale bits.
pub(crate) fn soil(p: Vec2) -> Lab {
    let coarse = cells(p * 12.0, IVec2::splat(12), 81);
    let fine = cells(p * 34.0, IVec2::splat(34), 82);
    let mut c = over(hex(0x33251b), hex(0x59442f), 0.6 * coarse.id + 0.5 * tiled(p, 4, 4, 4, 83));
    c = lighter(c, 0.16 * smooth(0.5, 0.0, coarse.middle) - 0.10 + 0.08 * smooth(0.5, 0.0, fine.middle));
    c = over(c, hex(0x1a120c), 0.7 * (1.0 - smooth(0.0, 0.1, coarse.border)));
    over(c, hex(0xcfc8b8), 0.7 * smooth(0.975, 0.98, fine.id) * smooth(0.4, 0.25, fine.middle))
}
