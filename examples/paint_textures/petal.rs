//! Petals: gradient from base to tip, eye, fan of forking veins, silky grooves, tinted margin.

use super::color::{Lab, hex, lighter, over, smooth};
use super::noise::{ENDLESS, cells, fractal, value};
use glam::Vec2;

/// Turns the noise of the pigment so that its lattice does not lie along the petal.
const LEAN: Vec2 = Vec2::new(0.8, 0.6);

/// What a petal looks like; colours are sRGB `0xrrggbb`.
pub(crate) struct Petal {
    /// At the base.
    pub(crate) base: u32,
    /// In the middle.
    pub(crate) body: u32,
    /// Toward the tip.
    pub(crate) tip: u32,
    /// Where base turns into body: begin and end along the petal.
    pub(crate) turn: [f32; 2],
    /// Along the margin, and how strongly.
    pub(crate) margin: (u32, f32),
    /// Colour of the veins.
    pub(crate) vein: u32,
    /// How dark veins are, 0 to 1.
    pub(crate) vein_strength: f32,
    /// Veins across the whole width.
    pub(crate) veins: f32,
    /// Whether veins fork and meet: net-veined rather than plainly fanned.
    pub(crate) net: f32,
    /// Whether veins run side by side (1) or as a fan from the base (0).
    pub(crate) parallel: f32,
    /// Depth of the grooves along the petal.
    pub(crate) groove: f32,
    /// Different from petal to petal.
    pub(crate) seed: u32,
}

/// A white petal with fine veins, from which the others depart.
pub(crate) const PLAIN: Petal = Petal {
    base: 0xf4f0d8,
    body: 0xfaf7f2,
    tip: 0xfdfbf8,
    turn: [0.05, 0.45],
    margin: (0xffffff, 0.0),
    vein: 0xd8cfc0,
    vein_strength: 0.35,
    veins: 9.0,
    net: 0.0,
    parallel: 0.0,
    groove: 0.012,
    seed: 1,
};

impl Petal {
    /// Colour at (u, v), v from base to tip.
    pub(crate) fn paint(&self, p: Vec2) -> Lab {
        let x = 2.0 * p.x - 1.0;
        let v = p.y;
        let broad = fractal(Vec2::new(p.x * 3.0, v * 4.0), ENDLESS, 3, self.seed);
        let fine = fractal(Vec2::new(p.x * 14.0, v * 20.0), ENDLESS, 2, self.seed + 9);
        let along =
            v + 0.05 * broad + 0.03 * fractal(Vec2::new(p.x * 24.0, v * 2.0), ENDLESS, 2, self.seed + 5);
        let mut c = over(hex(self.base), hex(self.body), smooth(self.turn[0], self.turn[1], along));
        c = over(c, hex(self.tip), smooth(0.5, 1.05, along));
        let margin = smooth(0.62, 1.0, x.abs() + 0.06 * broad).max(smooth(0.86, 1.02, along));
        c = over(c, hex(self.margin.0), self.margin.1 * margin);
        // silk: long soft streaks that follow the veins
        let fan = self.fan(x, v);
        let silk = fractal(Vec2::new(fan * 22.0, v * 1.6), ENDLESS, 3, self.seed + 21);
        c = lighter(c, 0.018 * broad + 0.008 * fine + 1.6 * self.groove * silk);
        c.y += 0.006 * fractal(p.rotate(LEAN) * 5.0, ENDLESS, 3, self.seed + 31);
        c.z += 0.007 * fractal(p.rotate(LEAN) * 6.0, ENDLESS, 3, self.seed + 37);
        let vein = self.veins(x, v);
        c = over(c, hex(self.vein), self.vein_strength * vein);
        // light catches one side of the middle fold
        lighter(c, self.groove * (smooth(0.0, 0.12, x) - smooth(-0.12, 0.0, x)) * (1.0 - 0.6 * v))
    }

    /// Which line of the fan passes through (x, v): its x at the tip.
    fn fan(&self, x: f32, v: f32) -> f32 {
        let fanned = x / (0.22 + 0.78 * v.powf(0.75));
        fanned + (x - fanned) * self.parallel
    }

    /// Strength of veins, 0 to 1.
    fn veins(&self, x: f32, v: f32) -> f32 {
        let wander = 0.07 * value(Vec2::new(x * 3.0, v * 5.0), ENDLESS, self.seed + 41);
        let fan = (self.fan(x, v) + wander * v) * self.veins * 0.5;
        let width = self.veins * 0.5 * (0.018 - 0.009 * v) / (0.22 + 0.78 * v.powf(0.75));
        let line = |fan: f32, width: f32| {
            let d = (fan - fan.round()).abs();
            (-(d / width).powi(2)).exp()
        };
        let main = line(fan, width) * (1.0 - 0.55 * smooth(0.55, 1.0, v));
        let open = 0.5 * smooth(0.22, 0.8, v);
        let forks = line(fan - open, 0.65 * width).max(line(fan + open, 0.65 * width));
        let forks = forks * 0.7 * smooth(0.2, 0.35, v) * (1.0 - 0.6 * smooth(0.6, 1.0, v));
        let bend = 0.5 * value(Vec2::new(x * 6.0, v * 7.0), ENDLESS, self.seed + 71);
        let mesh = cells(Vec2::new(fan * 1.5 + bend, v * 7.0 + bend), ENDLESS, self.seed + 51);
        let net = self.net * 0.75 * (1.0 - smooth(0.0, 0.06, mesh.border)) * smooth(0.15, 0.6, v);
        let uneven = 0.85 + 0.3 * value(Vec2::new(fan * 2.0, v * 9.0), ENDLESS, self.seed + 61);
        (main.max(forks).max(net) * uneven).clamp(0.0, 1.0)
    }
}
