//! Stems, young shoots, clay and earth: all tile in both directions.
//!
//! The bark of trees: `tree_bark`; flesh: `flesh`.

use super::color::{Lab, hex, lighter, over, smooth};
use super::noise::{cells, fractal, value};
use glam::{IVec2, Vec2};

/// Noise over the tile: `x` by `y` lattice points.
pub(crate) fn tiled(p: Vec2, x: i32, y: i32, octaves: u32, seed: u32) -> f32 {
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
    let c = over(hex(0x776757), hex(0x8d7f6d), 0.5 + 0.8 * tiled(p, 4, 4, 4, 62));
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
