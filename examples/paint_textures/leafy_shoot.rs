//! Shoots of broad-leaved trees, base at the bottom: leaves left and right in turn along a twig, or in pairs, and one at its end. Around them
//! the picture is clear.

use super::color::{Lab, hex, lighter};
use super::leaf::Leaf;
use super::noise::hash;
use glam::{IVec2, Vec2};
use std::f32::consts::TAU;

/// Half the width of the twig and of stalks, in lengths of the shoot.
const TWIG: f32 = 0.007;

/// What the margin of a leaf does.
pub(crate) enum Outline {
    /// It runs from base to tip.
    Entire,
    /// It turns in between so many lobes on each side, by such a share of the half width.
    Lobed { lobes: f32, depth: f32 },
    /// It goes around lobes from the base of the leaf, at these angles in degrees, each so wide to each side of its middle.
    Palmate { angles: &'static [f32], half_width: f32 },
}

/// How leaves stand along the twig.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Order {
    /// One by one, left and right in turn.
    Alternate,
    /// In pairs; every second pair stands toward and away from the eye, and is seen shorter.
    Crosswise,
    /// In pairs in one plane, as the leaflets of a leaf.
    Pinnate,
}

/// Sinuses between lobes run up toward the margin by such a share of their way out.
const SINUS_RISE: f32 = 0.4;
/// Length that one sees of leaves that stand toward the eye.
const SHORTENED: f32 = 0.55;
/// How long a palmate lobe at 60 degrees is, share of that in the middle.
const AT_SIXTY: f32 = 0.72;

/// A shoot: lengths are shares of its own.
pub(crate) struct LeafyShoot {
    /// Width of the picture.
    pub(crate) width: f32,
    /// Leaves beside that at the end, their length and the angle of the lowest, degrees; upper ones stand steeper.
    pub(crate) leaves: u32,
    pub(crate) length: f32,
    pub(crate) angle: f32,
    pub(crate) order: Order,
    /// Length of the stalk, in lengths of the leaf.
    pub(crate) stalk: f32,
    pub(crate) outline: Outline,
    /// Half width of a leaf, in its lengths, and how full it, or each palmate lobe, is below and above: small numbers are full.
    pub(crate) half_width: f32,
    pub(crate) taper: (f32, f32),
    /// What leaves look like, and the colour of the twig.
    pub(crate) leaf: Leaf,
    pub(crate) bark: u32,
    pub(crate) seed: u32,
}

/// A leaf in the picture.
struct Placed {
    foot: Vec2,
    /// Its direction, its length and what one sees of that.
    along: Vec2,
    length: f32,
    seen: f32,
    light: f32,
}

impl LeafyShoot {
    /// Colour at (u, v), v from base to tip; nothing between leaves.
    pub(crate) fn painter(self) -> impl Fn(Vec2) -> Option<Lab> {
        let leaves = self.placed();
        let end = leaves.last().map_or(1.0, |leaf| leaf.foot.y);
        move |p| {
            let place = Vec2::new((p.x - 0.5) * self.width, p.y);
            let is_twig = place.x.abs() < TWIG && place.y < end;
            let of_leaf = |leaf: &Placed| self.of_leaf(leaf, place);
            leaves.iter().rev().find_map(of_leaf).or_else(|| is_twig.then(|| hex(self.bark)))
        }
    }

    /// From the lowest to that at the end.
    fn placed(&self) -> Vec<Placed> {
        let end = 1.0 - self.length * (1.0 + self.stalk);
        let leaf = |k: u32| {
            let random = |what: i32| hash(IVec2::new(k as i32, what), self.seed) - 0.5;
            let level = if self.order == Order::Alternate { k } else { k & !1 };
            let share = level as f32 / self.leaves as f32;
            let side = if k.is_multiple_of(2) { -1.0 } else { 1.0 };
            let angle = if k == self.leaves {
                0.0
            } else {
                side * (self.angle * (1.0 - 0.4 * share) + 14.0 * random(0))
            };
            let along = Vec2::Y.rotate(Vec2::from_angle(angle.to_radians()));
            let length = self.length * (1.0 + 0.16 * random(1));
            let foot = Vec2::new(0.0, end * (0.16 + 0.84 * share));
            let toward_eye = self.order == Order::Crosswise && k % 4 > 1 && k < self.leaves;
            let seen = if toward_eye { SHORTENED * length } else { length };
            Placed { foot, along, length, seen, light: 0.07 * random(2) }
        };
        (0..=self.leaves).map(leaf).collect()
    }

    fn of_leaf(&self, leaf: &Placed, place: Vec2) -> Option<Lab> {
        let away = place - leaf.foot;
        let up = away.dot(leaf.along) / leaf.seen - self.stalk;
        let aside = away.perp_dot(leaf.along) / leaf.length;
        if (-self.stalk..=0.0).contains(&up) && aside.abs() * leaf.length < 0.7 * TWIG {
            return Some(hex(self.bark));
        }
        let at = Vec2::new(0.5 + 0.5 * aside / self.half_width, up);
        self.is_blade(up, aside).then(|| lighter(self.leaf.paint(at), leaf.light))
    }

    /// Whether a place is within a leaf of length 1.
    fn is_blade(&self, up: f32, aside: f32) -> bool {
        let within = |up: f32, aside: f32, half: f32| {
            (0.0..1.0).contains(&up) && aside.abs() < half * self.fullness(up)
        };
        match self.outline {
            Outline::Entire => within(up, aside, self.half_width),
            Outline::Lobed { lobes, depth } => {
                let phase = TAU * lobes * (up - SINUS_RISE * aside.abs());
                let cut = 1.0 - depth * (0.5 - 0.5 * phase.cos()).powf(1.5);
                within(up, aside, self.half_width * cut)
            }
            Outline::Palmate { angles, half_width } => angles.iter().any(|angle| {
                let of_lobe = Vec2::new(aside, up).rotate(Vec2::from_angle(angle.to_radians()));
                let length = AT_SIXTY.powf(angle.abs() / 60.0);
                within(of_lobe.y / length, of_lobe.x / length, half_width)
            }),
        }
    }

    /// Half width at a height, 1 where it is widest.
    fn fullness(&self, up: f32) -> f32 {
        let (below, above) = self.taper;
        let widest = below / (below + above);
        let at = |t: f32| t.max(0.0).powf(below) * (1.0 - t).max(0.0).powf(above);
        at(up) / at(widest)
    }
}
