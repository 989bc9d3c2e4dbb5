//! A petal on a ring: its flat outline laid on a surface of revolution, raised to its level, hollowed.
//!
//! A point (u, v) of the flat petal goes as far along the ring's curve as v says; across, it follows the cone that touches the
//! surface there, unrolled, so that flat petals stay flat and upright ones wrap around the axis. Height along the surface's
//! normal has three parts, all within the room that the ring inside leaves: the petal's level with its slope, the hollow,
//! and its lean. So petals of one ring differ in height wherever they overlap, and those of different rings never meet.
//!
//! Where we depart from 003 §2.2: its petals are bicubic patches. A cubic follows such a surface to a few hundredths of the
//! reach only, which is more than what lies between two petals.
//!
//! Limits: a petal reaches at most [`FARTHEST`] around to each side. Where the room is too little for petals to lie over each
//! other, as at their feet, they are gathered to their sector.

use super::ring_curve::{RingCurve, STEPS, Spot};
use glam::{Vec2, Vec3};
use serde::Serialize;
use std::sync::Arc;

/// Farthest that a petal reaches around to a side, radians.
pub const FARTHEST: f32 = 1.4;
/// Share of the room that is used.
const USED: f32 = 0.9;
/// How far apart petals lie that cover each other, in thicknesses.
pub const BETWEEN: f32 = 2.0;
/// Shares of the room for the levels of the ring and for the hollow.
const FOR_LEVELS: f32 = 0.5;
const FOR_HOLLOW: f32 = 0.35;
/// Share of the difference between levels that hollows of neighbours may differ.
const HOLLOW_OF_LEVEL: f32 = 0.8;
/// Most room that a ring uses, share of its length.
const MOST_ROOM: f32 = 0.3;
/// How far a petal leans at most, share of the room.
const FOR_LEAN: f32 = 0.12;

/// On which level of its ring a petal lies, and how it rises to its side.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Level {
    /// 0 outermost, 1 innermost.
    pub height: f32,
    /// By how much more it is at the end of its span in the sense of the azimuth, and less at the other.
    pub slope: f32,
}

/// The surface of one petal. Lengths are shares of its flower's reach unless they say otherwise.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RingSheet {
    /// The curve of its ring.
    pub curve: Arc<RingCurve>,
    /// Size against that of its ring.
    pub size: f32,
    /// How far it leans from its ring, −1 to 1 of what the ring inside leaves room for.
    pub tilt: f32,
    /// On which level it lies.
    pub level: Level,
    /// Least difference in level between petals of the ring that overlap.
    pub apart: f32,
    /// Half of its greatest width, share of its length.
    pub half_width: f32,
    /// Half its width at equal steps from foot to tip, shares of its length.
    pub half_widths: [f32; STEPS + 1],
    /// Its width against that of its outline.
    pub narrowed: f32,
    /// How far across the middle of a neighbour its margin reaches: 1 to its middle, 0 not at all.
    pub covered: f32,
    /// How far its margins rise over the middle, share of the half width.
    pub cup: f32,
    /// Angle that its half width spans, radians.
    pub half_span_rad: f32,
    /// How far around it reaches at most, radians.
    pub farthest_rad: f32,
    /// How far around petals reach where they do not overlap, radians.
    pub beside_rad: f32,
    /// Room that they need to lie over each other.
    pub needed: f32,
}

/// Room that petals of a thickness need to lie over each other where their levels differ by `apart`.
pub fn room_for_levels(thickness: f32, apart: f32) -> f32 {
    BETWEEN * thickness / (FOR_LEVELS * USED * apart)
}

impl RingSheet {
    /// A point of the petal in lengths of its ring, from its foot: along u, along the chord of the ring, toward the face.
    pub fn at(&self, uv: Vec2) -> Vec3 {
        let (foot, chord) = (self.curve.spot(0.0).at, self.curve.chord());
        let [across, outward, up] = self.on_surface(uv);
        let from_foot = Vec2::new(outward, up) - foot;
        Vec3::new(-across, from_foot.dot(chord), from_foot.dot(chord.perp())) / self.curve.length()
    }

    /// A point of the petal in the frame of the flower in which it stands at azimuth 0: across, away from the axis, up.
    fn on_surface(&self, uv: Vec2) -> [f32; 3] {
        let length = self.curve.length();
        let (u, share) = (-uv.x * self.narrowed * self.size * length, uv.y * self.size);
        let (around, further) = self.unrolled(u, share);
        let spot = self.curve.spot(share + further / length);
        let height = self.height(uv, around, share, spot.room);
        let at = spot.at + spot.normal * height;
        [at.x * around.sin(), at.x * around.cos(), at.y]
    }

    /// How far around a point lies that is `u` beside the middle line, and how much further along the curve.
    fn unrolled(&self, u: f32, share: f32) -> (f32, f32) {
        let spot = self.curve.spot(share);
        let u = u * self.gathered(&spot, share);
        let per_apex = spot.normal.y / radius(&spot);
        // Over the axis, where the cone narrows toward its apex, margins would fold.
        let opens = (1.0 + 2.5 * spot.normal.y).clamp(0.0, 1.0);
        let further = opens * u * u * per_apex / (1.0 + (1.0 + (u * per_apex).powi(2)).sqrt());
        (limited(around(&spot, u), FARTHEST), further)
    }

    /// How wide the petal is against its outline where it has most room in its upper half, up to three quarters of it.
    pub fn unfolded(&self) -> f32 {
        let places = (STEPS / 2..=3 * STEPS / 4).map(|k| k as f32 / STEPS as f32);
        places.map(|share| self.gathered(&self.curve.spot(share), share)).fold(0.0, f32::max)
    }

    /// How wide the petal is at a share of the way against its outline, so that it reaches no farther around than it may.
    fn gathered(&self, spot: &Spot, share: f32) -> f32 {
        let place = (share / self.size * STEPS as f32).clamp(0.0, STEPS as f32 - 1e-3);
        let (k, part) = (place as usize, place.fract());
        let half = self.half_widths[k] + (self.half_widths[k + 1] - self.half_widths[k]) * part;
        let margin = around(spot, half * self.narrowed * self.size * self.curve.length());
        let farthest = self.farthest(spot);
        if margin < 0.5 * farthest { 1.0 } else { limited(margin, farthest) / margin }
    }

    /// How far around the petal may reach where the ring has so much room: where that is too little for petals to lie over
    /// each other, only to the next one.
    fn farthest(&self, spot: &Spot) -> f32 {
        let needed = self.needed + bulge(spot.at.x, self.half_span_rad) / self.apart;
        let enough = ((spot.room - needed) / needed).clamp(0.0, 1.0);
        let beside = self.beside_rad.min(self.farthest_rad);
        beside + (self.farthest_rad - beside) * enough * enough * (3.0 - 2.0 * enough)
    }

    /// Height over the surface.
    fn height(&self, uv: Vec2, around: f32, share: f32, room: f32) -> f32 {
        let length = self.curve.length();
        let room = (USED * room).min(MOST_ROOM * length);
        let aside = (around / self.half_span_rad.max(1e-3)).clamp(-1.2, 1.2);
        let level = room * FOR_LEVELS * (self.level.height + self.level.slope * aside);
        let across = (uv.x / self.half_width).clamp(-1.1, 1.1);
        let wanted = self.cup * self.half_width * self.narrowed * length;
        let between_levels = room * FOR_LEVELS * self.apart * HOLLOW_OF_LEVEL / self.covered.max(1e-3);
        let most = (room * FOR_HOLLOW).min(between_levels);
        let hollow = if wanted >= 0.0 {
            wanted.min(most) * across * across
        } else {
            (-wanted).min(most) * (1.0 - across * across)
        };
        // Narrow feet are flat.
        let risen = (share / 0.4).min(1.0);
        level + hollow * risen + room * FOR_LEAN * (1.0 + self.tilt) * share
    }

    /// Every number of it in a fixed order.
    pub fn words(&self) -> impl Iterator<Item = f32> + '_ {
        let Self { curve, size, tilt, level: Level { height, slope }, apart, half_width, narrowed, .. } =
            self;
        let Self { covered, cup, half_span_rad, farthest_rad, beside_rad, needed, .. } = self;
        let own = [size, tilt, height, slope, apart, half_width, narrowed];
        let more = [covered, cup, half_span_rad, farthest_rad, beside_rad, needed];
        curve.words().chain(self.half_widths).chain(own.into_iter().chain(more).copied())
    }

    /// Whether all of its numbers are finite.
    pub fn is_finite(&self) -> bool {
        self.words().all(f32::is_finite)
    }
}

/// How far around a petal lies on a ring to each side where it lies farthest, radians. `half_widths` are those at equal steps
/// from foot to tip, shares of the ring's length; where it is narrow at its foot it counts for nothing.
pub fn span_of(curve: &RingCurve, half_widths: &[f32; STEPS + 1]) -> f32 {
    const FROM: usize = STEPS / 3;
    let at = |k: usize| around(&curve.spot(k as f32 / STEPS as f32), half_widths[k] * curve.length());
    limited((FROM..=STEPS).map(at).fold(0.0, f32::max), FARTHEST)
}

/// How far the flat faces of a petal that spans so far to each side leave a ring of a radius.
fn bulge(radius: f32, half_span_rad: f32) -> f32 {
    // Of two petals with two columns of faces on each side.
    radius * half_span_rad * half_span_rad / 16.0
}

fn radius(spot: &Spot) -> f32 {
    spot.at.x.max(1e-3)
}

/// How far around a point lies that is `u` beside the middle line on the cone that touches a ring.
fn around(spot: &Spot, u: f32) -> f32 {
    // The cosine of the slope of the surface is the height of its normal.
    let cos = spot.normal.y;
    if cos.abs() < 1e-3 { u / radius(spot) } else { (u * cos / radius(spot)).atan() / cos }
}

/// A number that never passes `most` and is itself while it is small.
fn limited(x: f32, most: f32) -> f32 {
    let share = x / most.max(1e-3);
    x / (1.0 + share.powi(4)).sqrt().sqrt()
}
