//! Leaves and sepals: pinnate, palmate or parallel veins, a fine net between them, swollen fields, markings.

use super::color::{Lab, hex, lighter, over, smooth};
use super::noise::{ENDLESS, cells, fractal, hash, value};
use glam::{IVec2, Vec2};

/// Turns the noise of the pigment so that its lattice does not lie along the leaf.
const LEAN: Vec2 = Vec2::new(0.8, 0.6);

/// Pattern of the main veins.
pub(crate) enum Venation {
    /// A midrib with `pairs` of side veins that rise by `rise` on their way to the margin.
    Pinnate {
        /// Side veins on each side.
        pairs: f32,
        /// How far along the leaf a side vein climbs.
        rise: f32,
    },
    /// Midribs that spread from the base by these angles from the middle, degrees.
    Palmate(&'static [f32]),
    /// This many lines side by side from base to tip.
    Parallel(f32),
}

/// A drawing on the leaf beyond its veins.
pub(crate) enum Marking {
    /// None.
    Plain,
    /// Dark ring, as in geraniums.
    Zone,
    /// Pale chevron, as in clovers and oxalis.
    Chevron,
    /// Pale patches between the veins, as in hepatica.
    Patches,
}

/// What a leaf looks like; colours are sRGB `0xrrggbb`.
pub(crate) struct Leaf {
    /// In the fields between veins.
    pub(crate) field: u32,
    /// Where the leaf is oldest or shaded.
    pub(crate) shade: u32,
    /// Veins.
    pub(crate) vein: u32,
    /// Along the margin, and how strongly.
    pub(crate) margin: (u32, f32),
    /// At the tip, and how strongly.
    pub(crate) tip: (u32, f32),
    /// Pattern of the veins.
    pub(crate) venation: Venation,
    /// Further drawing, and its colour.
    pub(crate) marking: (Marking, u32),
    /// How strongly fields swell between veins.
    pub(crate) swell: f32,
    /// Different from leaf to leaf.
    pub(crate) seed: u32,
}

/// A plain leaf of these colours with side veins along its midrib.
pub(crate) fn pinnate(field: u32, shade: u32, vein: u32, pairs: f32, rise: f32, seed: u32) -> Leaf {
    Leaf {
        field,
        shade,
        vein,
        seed,
        margin: (shade, 0.2),
        tip: (field, 0.0),
        venation: Venation::Pinnate { pairs, rise },
        marking: (Marking::Plain, 0),
        swell: 0.06,
    }
}

/// A plain leaf of these colours with midribs at these angles.
pub(crate) fn palmate(field: u32, shade: u32, vein: u32, angles: &'static [f32], seed: u32) -> Leaf {
    Leaf { venation: Venation::Palmate(angles), ..pinnate(field, shade, vein, 1.0, 0.0, seed) }
}

/// A plain leaf of these colours with lines from base to tip.
pub(crate) fn parallel(field: u32, shade: u32, vein: u32, lines: f32, seed: u32) -> Leaf {
    Leaf { venation: Venation::Parallel(lines), swell: 0.03, ..pinnate(field, shade, vein, 1.0, 0.0, seed) }
}

/// Distances that colour a point of a leaf.
struct Veins {
    /// Strength of main and side veins, 0 to 1.
    vein: f32,
    /// −1 just below a side vein to 1 just above the next.
    field: f32,
    /// Coordinates in which the fine net is drawn.
    net: Vec2,
}

fn line(distance: f32, width: f32) -> f32 {
    (-(distance / width).powi(2)).exp()
}

impl Leaf {
    /// Colour at (u, v), v from base to tip.
    pub(crate) fn paint(&self, p: Vec2) -> Lab {
        let x = 2.0 * p.x - 1.0;
        let broad = fractal((p * Vec2::new(2.6, 4.2)).rotate(LEAN), ENDLESS, 4, self.seed);
        let veins = self.veins(x, p.y);
        let mut c = over(hex(self.field), hex(self.shade), 0.45 - 0.55 * p.y + 0.75 * broad);
        c = over(c, hex(self.tip.0), self.tip.1 * smooth(0.45, 1.0, p.y + 0.25 * broad));
        c = self.mark(c, x, p.y, broad);
        let edge = smooth(0.58, 1.08, x.abs() + 0.25 * broad).max(smooth(0.85, 1.03, p.y + 0.1 * broad));
        c = over(c, hex(self.margin.0), self.margin.1 * edge);
        c = lighter(c, self.swell * (0.9 * veins.field - 0.15));
        let mesh = cells(veins.net, ENDLESS, self.seed + 3);
        let fine = cells(veins.net * 2.7, ENDLESS, self.seed + 4);
        c = lighter(c, 0.02 * (mesh.id - 0.5) + 0.25 * self.swell * smooth(0.0, 0.4, mesh.border));
        let net =
            0.3 * (1.0 - smooth(0.0, 0.10, mesh.border)) + 0.12 * (1.0 - smooth(0.0, 0.16, fine.border));
        c = over(c, hex(self.vein), net);
        c.y += 0.006 * fractal(p.rotate(LEAN) * 9.0, ENDLESS, 3, self.seed + 5);
        c.z += 0.009 * fractal(p.rotate(LEAN) * 7.0, ENDLESS, 3, self.seed + 6);
        // a vein lies in its own shadow
        let beside = self.veins(x + 0.018 * x.signum(), p.y - 0.008).vein;
        c = lighter(c, -0.05 * (beside - veins.vein).max(0.0));
        over(c, hex(self.vein), 0.9 * veins.vein)
    }

    fn veins(&self, x: f32, v: f32) -> Veins {
        match &self.venation {
            Venation::Pinnate { pairs, rise } => self.pinnate(x, v, *pairs, *rise),
            Venation::Palmate(angles) => self.palmate(x, v, angles),
            Venation::Parallel(lines) => self.parallel(x, v, *lines),
        }
    }

    fn pinnate(&self, x: f32, v: f32, pairs: f32, rise: f32) -> Veins {
        let bent = x + 0.03 * value(Vec2::new(2.0, v * 2.0), ENDLESS, self.seed) * v;
        let out = bent.abs();
        let side = if bent > 0.0 { 1 } else { 0 };
        let wander =
            0.25 * value(Vec2::new(out * 2.5, v * 5.0 + 17.0 * side as f32), ENDLESS, self.seed + 11);
        // a side vein leaves the midrib steeply and turns up toward the margin
        let curve = rise * (0.75 * out + 0.45 * out * out);
        let w = (v - curve + 0.02) * pairs + wander * out + 0.5 * side as f32 * 0.5;
        let k = w.round();
        let jitter = 0.3 * (hash(IVec2::new(k as i32, side), self.seed + 12) - 0.5);
        let d = w - k - jitter;
        let width = 0.055 + 0.02 * pairs / 8.0;
        let secondary = line(d, width * (1.1 - 0.75 * out)) * (1.0 - 0.65 * smooth(0.55, 0.98, out));
        let midrib = line(bent, 0.048 * (1.05 - 0.8 * v));
        let field = (w - jitter - (w - jitter).floor()) * 2.0 - 1.0;
        let swollen = 1.0 - field.abs().powi(2) - 0.35 * field;
        Veins {
            vein: midrib.max(0.72 * secondary * smooth(-0.01, 0.05, v)),
            field: swollen * 0.8 * smooth(0.02, 0.2, out),
            net: Vec2::new(w * 3.0, bent * 11.0),
        }
    }

    fn palmate(&self, x: f32, v: f32, angles: &[f32]) -> Veins {
        let p = Vec2::new(x * 0.62, v + 0.01);
        let r = p.length().max(1e-4);
        let angle = p.x.atan2(p.y).to_degrees() + 4.0 * value(p * 3.0, ENDLESS, self.seed);
        let ray = angles.iter().copied().min_by(|a, b| (a - angle).abs().total_cmp(&(b - angle).abs()));
        let off = (angle - ray.unwrap_or(0.0)).to_radians();
        let (along, out) = (r * off.cos(), r * off.sin().abs());
        let side = if off > 0.0 { 0.5 } else { 0.0 };
        let wander = 0.3 * value(p * 6.0, ENDLESS, self.seed + 11);
        let w = (along - 0.9 * out) * 9.0 + side + wander * smooth(0.0, 0.2, out);
        let d = w - w.round();
        let secondary =
            line(d, 0.085) * smooth(0.0, 0.012, out) * (1.0 - smooth(0.10, 0.34, out)) * smooth(0.1, 0.22, r);
        let main = line(out, 0.016 * (1.15 - 0.75 * r).max(0.25));
        let field = (w - w.floor()) * 2.0 - 1.0;
        Veins {
            vein: main.max(0.6 * secondary),
            field: (1.0 - field * field - 0.3 * field) * 0.8 * smooth(0.01, 0.08, out),
            net: p * 26.0 + Vec2::splat(wander),
        }
    }

    fn parallel(&self, x: f32, v: f32, lines: f32) -> Veins {
        // lines draw together where the blade does
        let narrowing = 1.0 - 0.35 * smooth(0.6, 1.0, v) - 0.35 * smooth(0.35, 0.0, v);
        let fan = x / narrowing * lines * 0.5;
        let d = fan - fan.round();
        let strength = 0.5 + 0.5 * hash(IVec2::new(fan.round() as i32, 1), self.seed + 13);
        let ribs = line(d, 0.16) * strength * 0.5;
        let midrib = line(x, 0.05 * (1.05 - 0.75 * v));
        let field = 1.0 - 2.0 * (2.0 * d).powi(2);
        Veins { vein: midrib.max(ribs), field: 0.6 * field, net: Vec2::new(fan * 1.2, v * 34.0) }
    }

    fn mark(&self, c: Lab, x: f32, v: f32, broad: f32) -> Lab {
        let drawn = hex(self.marking.1);
        match self.marking.0 {
            Marking::Plain => c,
            Marking::Zone => {
                let r = Vec2::new(x * 0.8, v - 0.05).length() + 0.09 * broad;
                over(c, drawn, 0.75 * smooth(0.36, 0.46, r) * (1.0 - smooth(0.54, 0.7, r)))
            }
            Marking::Chevron => {
                let r = v - 0.55 + 0.4 * x.abs() + 0.07 * broad;
                over(c, drawn, 0.55 * smooth(-0.12, -0.03, r) * (1.0 - smooth(0.0, 0.13, r)))
            }
            Marking::Patches => {
                let patch = fractal(Vec2::new(x * 2.4, v * 5.0).rotate(LEAN), ENDLESS, 4, self.seed + 71);
                over(c, drawn, 0.45 * smooth(0.05, 0.45, patch))
            }
        }
    }
}
