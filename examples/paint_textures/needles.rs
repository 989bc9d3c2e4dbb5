//! Shoots of conifers, base at the bottom: what their leaves wear, each a shoot. Around the needles the picture is clear.
//!
//! Twigs are straight lines that keep within the outline of the leaf, needles strokes that begin on them and end in a point. They are so
//! dense that small copies of a picture stay about half covered: programs show what is at least half covered.

use super::color::{Lab, hex, lighter, over};
use super::noise::hash;
use glam::{IVec2, Vec2};

/// Corners of half the outline that leaves have, `leaflet` of `growth/habit/leaf.rs`: half width, as a share of the width, and height.
const OUTLINE: [(f32, f32); 4] = [(0.0, 0.0), (0.48, 0.28), (0.4, 0.66), (0.0, 1.0)];
/// Half the width of twigs.
const TWIG: f32 = 0.005;
/// Stripes across the picture, each with the strokes that touch it.
const STRIPES: usize = 64;

/// A shoot: lengths are shares of its own, angles degrees from the twig.
pub(crate) struct Shoot {
    /// Width of the picture.
    pub(crate) width: f32,
    /// Side twigs on both sides together, and their angle to the middle one.
    pub(crate) twigs: u32,
    pub(crate) angle: f32,
    /// From where to where the middle twig has needles.
    pub(crate) middle: (f32, f32),
    /// Length and half width of needles, and the distance of their feet on one side of a twig.
    pub(crate) needle: f32,
    pub(crate) thin: f32,
    pub(crate) apart: f32,
    /// Least and greatest angle of needles.
    pub(crate) spread: (f32, f32),
    /// Needles begin together in tufts so far apart.
    pub(crate) tufts: Option<f32>,
    /// Dark and light needles, their young ends, and the twigs.
    pub(crate) colours: [u32; 4],
    pub(crate) seed: u32,
}

/// A line from its foot to its tip.
struct Stroke {
    foot: Vec2,
    tip: Vec2,
    half_width: f32,
    /// At its foot and at its tip.
    colours: [Lab; 2],
}

/// A straight twig.
struct Twig {
    foot: Vec2,
    /// Of length 1.
    along: Vec2,
    /// From where to where along it there are needles.
    needles: (f32, f32),
    seed: u32,
}

impl Shoot {
    /// Colour at (u, v), v from base to tip; nothing between needles.
    pub(crate) fn painter(self) -> impl Fn(Vec2) -> Option<Lab> {
        let mut stripes: Vec<Vec<Stroke>> = (0..STRIPES).map(|_| Vec::new()).collect();
        for stroke in self.strokes() {
            let at = |y: f32| ((y * STRIPES as f32).max(0.0) as usize).min(STRIPES - 1);
            let (low, high) = (stroke.foot.y.min(stroke.tip.y), stroke.foot.y.max(stroke.tip.y));
            for stripe in &mut stripes[at(low - stroke.half_width)..=at(high + stroke.half_width)] {
                stripe.push(Stroke { ..stroke });
            }
        }
        move |p| {
            let place = Vec2::new((p.x - 0.5) * self.width, p.y);
            let stripe = &stripes[((p.y * STRIPES as f32) as usize).min(STRIPES - 1)];
            stripe.iter().rev().find_map(|stroke| stroke.colour(place))
        }
    }

    /// All strokes, the uppermost last.
    fn strokes(&self) -> Vec<Stroke> {
        let mut all = Vec::new();
        for k in 0..self.twigs {
            let random = hash(IVec2::new(k as i32, 0), self.seed);
            let side = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
            let foot = Vec2::new(0.0, self.middle.1 * (0.04 + 0.84 * k as f32 / self.twigs as f32));
            let along =
                Vec2::Y.rotate(Vec2::from_angle(-side * (self.angle + 10.0 * (random - 0.5)).to_radians()));
            let length = room(foot, along, self.width) * (0.92 + 0.08 * random) - 0.5 * self.needle;
            if length > 0.0 {
                self.add(&Twig { foot, along, needles: (0.0, length), seed: self.seed + 1 + k }, &mut all);
            }
        }
        self.add(&Twig { foot: Vec2::ZERO, along: Vec2::Y, needles: self.middle, seed: self.seed }, &mut all);
        all
    }

    /// Adds a twig and its needles: below, then above, and in each layer from the foot on.
    fn add(&self, twig: &Twig, all: &mut Vec<Stroke>) {
        let [_, light, _, bark] = self.colours.map(hex);
        let (from, to) = twig.needles;
        let colours = [bark, over(bark, light, 0.5)];
        all.push(Stroke { foot: twig.foot, tip: twig.foot + to * twig.along, half_width: TWIG, colours });
        let count = ((to - from) / self.apart).ceil() as i32;
        for layer in 0..2 {
            let in_layer = (0..=count).flat_map(|k| [1, -1].map(|side| self.needle(twig, layer, (k, side))));
            all.extend(in_layer);
        }
    }

    /// One needle of a layer of a twig, by its number on its side of it.
    fn needle(&self, twig: &Twig, layer: i32, (k, side): (i32, i32)) -> Stroke {
        let [dark, light, young, _] = self.colours.map(hex);
        let random = |what: i32| hash(IVec2::new(2 * k + (1 + side) / 2, 2 * what + layer), twig.seed);
        let (from, to) = twig.needles;
        let way = (from + (k as f32 + random(0) - 0.5) * self.apart).clamp(from, to);
        let way = self.tufts.map_or(way, |apart| ((way / apart).round() * apart).min(to));
        let share = way / to;
        let (least, most) = self.spread;
        // At the end of a twig needles look forward; those of tufts go to all sides there, too.
        let spread = if self.tufts.is_none() { 1.0 - 0.7 * share.powi(8) } else { 1.0 };
        let angle = (least + (most - least) * random(1)) * spread;
        let direction = twig.along.rotate(Vec2::from_angle(side as f32 * angle.to_radians()));
        let foot = twig.foot + way * twig.along;
        let tip = foot + self.needle * (0.7 + 0.3 * random(2)) * direction;
        let green = over(over(dark, light, random(3)), young, 0.6 * share.powi(3));
        let of_twig = 0.03 * (hash(IVec2::ZERO, twig.seed) - 0.5);
        let green = lighter(green, of_twig - if layer == 0 { 0.06 } else { 0.0 });
        let colours = [lighter(green, -0.08 * (1.0 - share)), lighter(green, 0.03)];
        Stroke { foot, tip, half_width: self.thin, colours }
    }
}

impl Stroke {
    fn colour(&self, place: Vec2) -> Option<Lab> {
        let (line, away) = (self.tip - self.foot, place - self.foot);
        let share = (away.dot(line) / line.length_squared()).clamp(0.0, 1.0);
        let gap = away.distance(share * line);
        (gap < self.half_width * (1.0 - share.powi(5))).then(|| over(self.colours[0], self.colours[1], share))
    }
}

/// How far it is from a place in the middle along a direction to the outline.
fn room(foot: Vec2, along: Vec2, width: f32) -> f32 {
    let half = |y: f32| {
        let pair = OUTLINE.windows(2).find(|pair| y <= pair[1].1).unwrap_or(&OUTLINE[2..]);
        let share = (y - pair[0].1) / (pair[1].1 - pair[0].1);
        width * (pair[0].0 + share * (pair[1].0 - pair[0].0))
    };
    let is_inside = |way: &f32| {
        let place = foot + *way * along;
        (0.0..1.0).contains(&place.y) && place.x.abs() < half(place.y)
    };
    (0..400).map(|k| k as f32 * 0.0025).take_while(is_inside).last().unwrap_or(0.0)
}
