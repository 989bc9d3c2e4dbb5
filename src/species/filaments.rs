//! Stamens and styles: filaments with heads, by golden angle, in whorls, or along a column.
//!
//! 003 §3.3 puts stamens regularly into a ring; here the ring is one of three arrangements, every filament varies a
//! little, and none leaves the petals' cone, so that a shut flower keeps its stamens inside.

use super::looks::{Arrangement, FilamentLook};
use super::seat::Seat;
use crate::geom::GOLDEN_RAD;
use crate::plant::Shape;
use glam::{Vec2, Vec3};
use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use std::f32::consts::{PI, TAU};

/// Largest angle from the axis, as a share of the petals' own.
const INSIDE: f32 = 0.85;
/// How deep a filament is rooted in the disc, as a share of its length.
const ROOTED: f32 = 0.06;
/// How far above the disc it begins where nothing is to pass through anything, as a share of its length.
const LIFTED: f32 = 0.02;

/// The stamens or styles of one group, at most `most` of them.
pub(super) fn filaments(look: &FilamentLook, seat: &Seat, most: usize, rng: &mut Pcg64Mcg) -> Vec<Shape> {
    let count = (look.count as usize).min(most);
    let radius = look.radius * seat.reach;
    let head = Vec2::from(look.head) * seat.reach;
    let shapes = (0..count).filter_map(|i| {
        let points = skeleton(look, seat, i, count, rng)?;
        Some(Shape::Filament { points, radius, head })
    });
    shapes.collect()
}

/// Skeleton of filament `i` of `count`, `None` if it is too short to have one.
fn skeleton(
    look: &FilamentLook,
    seat: &Seat,
    i: usize,
    count: usize,
    rng: &mut Pcg64Mcg,
) -> Option<Vec<Vec3>> {
    let mut wobble = |amount: f32| 1.0 + look.vary * amount * rng.random_range(-1.0..1.0_f32);
    let share = (i as f32 + 0.5) / count as f32;
    let (angle, outward) = match look.arrangement {
        Arrangement::Whorl => (TAU * share + PI / count as f32 * (wobble(0.5) - 1.0), 1.0),
        Arrangement::Spiral => {
            let inner = look.ring_from * look.ring_from;
            (GOLDEN_RAD * i as f32, (inner + (1.0 - inner) * share).sqrt())
        }
        Arrangement::Column => (GOLDEN_RAD * i as f32, 1.0),
    };
    let radial = seat.around(angle);
    let ring = look.ring * seat.radius * outward;
    let up = match look.arrangement {
        Arrangement::Column => look.column * share,
        _ => 0.0,
    };
    let foot = seat.axis * (seat.surface(ring) + (look.rise + up) * seat.reach) + radial * ring;
    let spread = (look.spread_deg.to_radians() * outward * wobble(0.4)).min(INSIDE * seat.opening_rad);
    let direction = seat.axis * spread.cos() + radial * spread.sin();
    let length = look.length * seat.reach * wobble(0.35);
    let rooted = if seat.is_rooted { -ROOTED } else { LIFTED };
    let start = seat.apex + foot + direction * (rooted * length);
    let end = seat.apex + foot + direction * length;
    let bow = (radial * spread.cos() - seat.axis * spread.sin()) * (look.bow * length * wobble(0.5));
    let middle = start.lerp(end, 0.55) + bow;
    let mut points = if look.bow == 0.0 { vec![start, end] } else { vec![start, middle, end] };
    points.dedup();
    (points.len() >= 2 && points.iter().all(|p| p.is_finite())).then_some(points)
}
