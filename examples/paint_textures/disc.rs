//! Hearts of flowers seen from above: florets or carpels in Vogel's spiral, r = √(k/n), angle k·137.5°.
//!
//! H. Vogel, "A better way to construct the sunflower head", 1979.

use super::color::{Lab, hex, lighter, over, smooth};
use super::noise::{ENDLESS, fractal, hash};
use glam::{IVec2, Vec2};

const GOLDEN_ANGLE: f32 = 2.399_963_2;

/// What a disc looks like; colours are sRGB `0xrrggbb`.
pub(crate) struct Disc {
    /// Florets out to the rim.
    pub(crate) florets: u32,
    /// Colour of florets in the middle, half way, and at the rim.
    pub(crate) colours: [u32; 3],
    /// Between florets.
    pub(crate) gap: u32,
    /// Highlight on each floret.
    pub(crate) glint: u32,
    /// Radius of a floret in units of their spacing.
    pub(crate) size: f32,
    /// Share of the radius inside which florets are still shut, small points.
    pub(crate) bud: f32,
    /// Different from disc to disc.
    pub(crate) seed: u32,
}

impl Disc {
    /// Places and lists the florets once, then gives the colour at (u, v), the disc's middle at (0.5, 0.5).
    pub(crate) fn painter(self) -> impl Fn(Vec2) -> Lab {
        // florets beyond the rim fill the picture's corners
        let count = self.florets * 2;
        let place = |k: u32| {
            let r = ((k as f32 + 0.5) / self.florets as f32).sqrt();
            Vec2::from_angle(GOLDEN_ANGLE * k as f32) * r
        };
        let florets: Vec<Vec2> = (0..count).map(place).collect();
        move |p| self.paint((p - 0.5) * 2.0, &florets)
    }

    fn paint(&self, p: Vec2, florets: &[Vec2]) -> Lab {
        let nearest = (0..florets.len())
            .min_by(|a, b| florets[*a].distance_squared(p).total_cmp(&florets[*b].distance_squared(p)));
        let k = nearest.unwrap_or(0);
        let r = florets[k].length();
        let d = p - florets[k];
        let spacing = 1.77 / (self.florets as f32).sqrt();
        let cloud = fractal(p * 3.0, ENDLESS, 3, self.seed);
        let random = hash(IVec2::new(k as i32, 0), self.seed);
        let [inner, half, rim] = self.colours.map(hex);
        let ring = r + 0.07 * cloud;
        let mut c = over(over(inner, half, smooth(0.15, 0.5, ring)), rim, smooth(0.55, 0.95, ring));
        c = lighter(c, 0.08 * (random - 0.5));
        let radius = 0.5 * spacing * self.size;
        let t = d.length() / radius;
        // light from above left rounds each floret
        let lit = (d / radius).dot(Vec2::new(-0.6, 0.8));
        c = lighter(c, 0.09 * lit.clamp(-1.0, 1.0));
        let open = smooth(self.bud - 0.05, self.bud + 0.1, r);
        let mouth = open * smooth(0.5, 0.25, t);
        c = over(c, lighter(hex(self.gap), 0.12), 0.4 * mouth);
        c = over(c, hex(self.glint), 0.55 * smooth(0.45, 0.05, (d / radius - Vec2::new(-0.3, 0.4)).length()));
        c = over(c, hex(self.gap), smooth(0.72, 1.12, t));
        lighter(c, -0.10 * smooth(0.8, 1.0, r) + 0.02 * cloud)
    }
}
