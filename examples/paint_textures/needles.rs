//! A twig full of needles, base at the bottom: what the leaves of a conifer wear, each a twig.
//!
//! Needles stand in two rows along the twig and look forward; dark gaps show between them. The twig's own outline is only a
//! lance, so what reads as needles is this picture.

use super::color::{Lab, hex, lighter, over, smooth};
use super::noise::{ENDLESS, fractal, hash};
use glam::{IVec2, Vec2};

/// Needles along one side of the twig.
const COUNT: f32 = 30.0;
/// How far forward a needle's end is of its foot, in lengths of the twig.
const FORWARD: f32 = 0.42;

/// Colour at (u, v), v from base to tip.
pub(crate) fn paint(p: Vec2) -> Lab {
    let x = 2.0 * p.x - 1.0;
    let side = i32::from(x > 0.0);
    let bend = 0.5 * fractal(p * Vec2::new(5.0, 7.0), ENDLESS, 2, 501);
    let row = |shift: f32, rows: f32, seed: u32| {
        let place = rows * (p.y - FORWARD * x.abs().powf(0.9)) + bend + shift;
        let t = (place - place.floor() - 0.5).abs() * 2.0;
        (t, hash(IVec2::new(place.floor() as i32, side), seed))
    };
    // Needles below, dark and finer, then those above them with a pale line along their middle.
    let (below, _) = row(0.35, 1.3 * COUNT, 502);
    let mut c = over(hex(0x14241a), hex(0x2c4a30), smooth(0.9, 0.3, below));
    let (t, id) = row(0.0, COUNT, 503);
    let green = over(hex(0x3d6a3c), hex(0x6b9457), id);
    c = over(c, green, smooth(0.78, 0.42, t));
    c = over(c, hex(0xa4c08c), 0.35 * smooth(0.3, 0.0, t) * id);
    let twig = smooth(0.06, 0.03, x.abs() + 0.015 * bend);
    c = over(c, hex(0x6d5238), 0.8 * twig * (1.0 - 0.6 * p.y));
    // Young ends are paler.
    lighter(over(c, hex(0x9cc07a), 0.28 * smooth(0.55, 1.05, p.y.max(x.abs()))), 0.02 * bend)
}
