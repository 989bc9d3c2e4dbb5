//! The outline of a fleshy body that was not finished: drawn from its foot on one side up to some tip, and not down again.
//!
//! From every point a ray goes into the body, to the other side. Where two sides are drawn, their distance is known; where one is
//! missing, that of the nearest place that faces the same way holds, so that a column stays as thick as it is above its arms. What
//! these rays cover is the body. Which side of the line is inside follows from where it lies: arms that are drawn are on one side of what joins its ends.
//!
//! Cost: points of the line times cells across the silhouette, and the square of the points.

use crate::anatomy::conventions::page::{Line, even};
use crate::anatomy::conventions::shapes::silhouette::Silhouette;
use crate::geom::simple_loop;
use glam::Vec2;
use std::f32::consts::PI;

/// Least height of the end that is not the foot above it, as a share of the line's height.
const UNFINISHED: f32 = 0.25;
/// Least area between the line and what joins its ends, as a share of its bounds, and how far it turns at most, radians: once round
/// what it encloses.
const AREA: f32 = 0.08;
const TURN: f32 = 1.65 * PI;
/// Longest ray, as a share of the line's diagonal.
const ACROSS: f32 = 0.4;
/// Least share of the rays that meet another side, and least ratio of the first and last quarter of their lengths.
const SIDES: (f32, f32) = (0.3, 0.3);
/// Least cosine between rays that go the same way.
const SAME_WAY: f32 = 0.9;
/// Most of a ray that meets another side, in medians; longer ones meet another limb.
const MOST: f32 = 1.7;
/// Angle between neighbouring rays at most, radians.
const FAN: f32 = 0.2;

/// Lines that cover the body, and its foot.
pub(crate) fn closed(line: &Line, silhouette: &Silhouette) -> Option<(Vec<Vec<Vec2>>, Vec2)> {
    let points = line.upward();
    let size = line.size();
    let (foot, end) = (points[0], points[points.len() - 1]);
    let is_unfinished =
        foot.y - end.y > UNFINISHED * size.y && line.bounds.1.y - foot.y < UNFINISHED * size.y;
    // The line as a loop turns the way in which its area counts; in pixels, with y down, that is to the right where it is above 0.
    let area = simple_loop::signed_area(points.iter().copied());
    if !is_unfinished || turning(&points).abs() > TURN || area.abs() < AREA * size.x * size.y {
        return None;
    }
    let most = ACROSS * size.length();
    let rays = rays(&points, area.signum());
    let ways: Vec<Option<f32>> =
        rays.iter().map(|(from, along)| silhouette.way_to_ink(*from, *along, most)).collect();
    let mut known: Vec<f32> = ways.iter().flatten().copied().collect();
    if (known.len() as f32) < SIDES.0 * rays.len() as f32 {
        return None;
    }
    known.sort_by(f32::total_cmp);
    let at = |share: f32| known[((share * known.len() as f32) as usize).min(known.len() - 1)];
    let usual = at(0.5);
    if at(0.25) < SIDES.1 * at(0.75) {
        return None;
    }
    let ways: Vec<Option<f32>> = ways.iter().map(|way| way.filter(|way| *way < MOST * usual)).collect();
    let ray = |((from, along), way): (&(Vec2, Vec2), &Option<f32>)| {
        let length = way.or_else(|| beside(*from, *along, &rays, &ways)).unwrap_or(usual);
        vec![*from, from + along * length]
    };
    let mut all: Vec<Vec<Vec2>> = rays.iter().zip(&ways).map(ray).collect();
    let root = foot.midpoint(all[0][1]);
    all.push(points);
    Some((all, root))
}

/// How far it is across the body at the nearest place that faces the same way and has another side.
fn beside(from: Vec2, along: Vec2, rays: &[(Vec2, Vec2)], ways: &[Option<f32>]) -> Option<f32> {
    let faces = |(ray, way): (&(Vec2, Vec2), &Option<f32>)| {
        (ray.1.dot(along) > SAME_WAY).then_some((ray.0.distance_squared(from), (*way)?))
    };
    let nearest = rays.iter().zip(ways).filter_map(faces).min_by(|a, b| a.0.total_cmp(&b.0));
    nearest.map(|(_, way)| way)
}

/// How far a line turns from its beginning to its end, radians, its hooks left out.
fn turning(points: &[Vec2]) -> f32 {
    let even = even(points, 48);
    let steps: Vec<Vec2> = even.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.windows(2).map(|pair| pair[0].angle_to(pair[1])).sum()
}

/// Places of a line and directions across it, to the side toward which it turns; at bends they fan out.
fn rays(points: &[Vec2], side: f32) -> Vec<(Vec2, Vec2)> {
    let tangents: Vec<Vec2> = (0..points.len())
        .map(|i| {
            let (a, b) = (i.saturating_sub(2), (i + 2).min(points.len() - 1));
            (points[b] - points[a]).normalize_or(Vec2::Y)
        })
        .collect();
    let mut rays = Vec::new();
    for i in 0..points.len() {
        let next = tangents.get(i + 1).copied().unwrap_or(tangents[i]);
        let angle = tangents[i].angle_to(next);
        let count = 1 + (angle.abs() / FAN) as usize;
        rays.extend((0..count).map(|k| {
            let along = Vec2::from_angle(angle * k as f32 / count as f32).rotate(tangents[i]);
            (points[i], side * along.perp())
        }));
    }
    rays
}
