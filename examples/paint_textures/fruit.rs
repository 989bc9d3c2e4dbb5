//! Skins of fruits. They lie on bodies of revolution, around and along their profile from the stalk to the other end
//! (`src/species/fruits.rs`), and close around.

use super::bark::tiled;
use super::color::{Lab, hex, lighter, over, smooth};
use super::noise::hash;
use glam::{IVec2, Vec2};

/// Yellow skin, red where the sun was, in streaks from the stalk, with pale dots.
pub(crate) fn apple(p: Vec2) -> Lab {
    let streak = tiled(p, 46, 2, 3, 501) + 0.4 * tiled(p, 90, 3, 2, 502);
    let sunny = 0.5 - 0.5 * (std::f32::consts::TAU * p.x).cos() + 0.35 * tiled(p, 3, 2, 3, 503);
    // The hollows at both ends keep their green.
    let middle = smooth(0.05, 0.3, p.y) * smooth(1.0, 0.8, p.y);
    let mut c = over(hex(0xa9b24a), hex(0xdcc65a), middle);
    c = over(c, hex(0xd0342e), middle * smooth(-0.1, 0.75, sunny + 0.35 * streak));
    c = over(c, hex(0xa41c24), 0.5 * middle * smooth(0.5, 1.2, sunny + 0.4 * streak));
    c = over(c, hex(0x8a7440), 0.6 * smooth(0.1, 0.02, p.y) + 0.7 * smooth(0.965, 0.995, p.y));
    over(c, hex(0xf0dca0), 0.4 * middle * dots(p))
}

/// Pale dots of a skin, 0 to 1.
fn dots(p: Vec2) -> f32 {
    const CELLS: IVec2 = IVec2::new(18, 11);
    let place = p * CELLS.as_vec2();
    let cell = place.floor().as_ivec2().rem_euclid(CELLS);
    let random = |k: u32| hash(cell, 510 + k) - 0.5;
    let from = place - place.floor() - Vec2::splat(0.5) - 0.7 * Vec2::new(random(0), random(1));
    smooth(0.10, 0.04, from.length())
}

/// A nut, brown toward its tip, in a cup of small scales.
pub(crate) fn acorn(p: Vec2) -> Lab {
    let (rim, row) = (0.36 + 0.006 * tiled(p, 20, 1, 2, 520), scale(p, IVec2::new(16, 22)));
    let nut = over(hex(0x9a8a3c), hex(0x8a5a26), smooth(0.4, 0.9, p.y + 0.1 * tiled(p, 14, 1, 3, 521)));
    let nut = over(nut, hex(0x54381c), smooth(0.93, 0.985, p.y) + 0.5 * smooth(rim + 0.05, rim, p.y));
    let cup = over(hex(0x6e6650), hex(0xa89c78), row);
    over(cup, nut, smooth(rim - 0.008, rim + 0.008, p.y))
}

/// Woody scales, one over the other toward the tip.
pub(crate) fn cone(p: Vec2) -> Lab {
    let row = scale(p, IVec2::new(8, 11));
    let c = over(hex(0x5c3a20), hex(0xc8986a), row);
    lighter(c, 0.03 * tiled(p, 40, 40, 2, 530))
}

/// How much of a scale is seen at a place, among so many around and along: 1 at its free edge, 0 below the one before it.
fn scale(p: Vec2, count: IVec2) -> f32 {
    let along = p.y * count.y as f32;
    // Those of every other row stand between those of the one before.
    let reach = |row: i32| {
        let place = p.x * count.x as f32 + 0.5 * row.rem_euclid(2) as f32;
        let aside = 2.0 * (place - place.floor() - 0.5).abs();
        along - row as f32 - 1.0 + 0.6 * aside * aside
    };
    let first = along.floor() as i32;
    // The nearest row to the stalk that reaches as far lies above all later ones.
    let on = (first - 1..=first + 1).map(reach).find(|beyond| *beyond < 0.0).unwrap_or(-1.0);
    smooth(-1.3, -0.1, on)
}
