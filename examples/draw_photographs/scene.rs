//! Photographs that nobody took: a petal or a leaf on paper under a window, with shadow, grain and a crease; and bark.

use glam::{Vec2, Vec3};
use penstemon::picture::decode::Rgba;
use rayon::prelude::*;

/// Something that lies on paper: its outline in its own plane, base below the origin and tip near v = 1, and its colour there.
pub(crate) struct Thing {
    pub(crate) outline: Vec<Vec2>,
    pub(crate) colour: fn(Vec2) -> Vec3,
}

/// A smooth closed line through points (Catmull and Rom).
fn smooth(points: &[Vec2], between: usize) -> Vec<Vec2> {
    let n = points.len();
    let at = |i: usize| points[i % n];
    let piece = |i: usize| {
        (0..between).map(move |k| {
            let t = k as f32 / between as f32;
            let [a, b, c, d] = [at(i + n - 1), at(i), at(i + 1), at(i + 2)];
            0.5 * (2.0 * b
                + (c - a) * t
                + (2.0 * a - 5.0 * b + 4.0 * c - d) * t * t
                + (3.0 * b - 3.0 * c + d - a) * t * t * t)
        })
    };
    (0..n).flat_map(piece).collect()
}

/// A value between −1 and 1 that changes smoothly over the plane.
pub(crate) fn noise(at: Vec2) -> f32 {
    let corner = at.floor();
    let share = at - corner;
    let share = share * share * (3.0 - 2.0 * share);
    let value = |dx: i32, dy: i32| {
        let [x, y] = [corner.x as i32 + dx, corner.y as i32 + dy];
        let mut h = (x as u32).wrapping_mul(0x9e37_79b1) ^ (y as u32).wrapping_mul(0x85eb_ca77);
        h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
        h = (h ^ (h >> 12)).wrapping_mul(0x297a_2d39);
        ((h ^ (h >> 15)) >> 8) as f32 / (1 << 23) as f32 - 1.0
    };
    let row = |dy: i32| value(0, dy) + (value(1, dy) - value(0, dy)) * share.x;
    row(0) + (row(1) - row(0)) * share.y
}

/// Noise of several sizes.
pub(crate) fn clouds(at: Vec2) -> f32 {
    0.5 * noise(at) + 0.25 * noise(2.1 * at) + 0.15 * noise(4.3 * at) + 0.1 * noise(8.9 * at)
}

fn from_line(at: Vec2, from: Vec2, to: Vec2) -> f32 {
    let along = to - from;
    at.distance(from + along * ((at - from).dot(along) / along.length_squared()).clamp(0.0, 1.0))
}

/// A broad petal with a notched, uneven margin, a claw and a crease.
pub(crate) fn petal() -> Thing {
    let right = [
        (0.05, 0.0),
        (0.065, 0.09),
        (0.17, 0.28),
        (0.31, 0.48),
        (0.41, 0.7),
        (0.42, 0.87),
        (0.33, 0.985),
        (0.22, 1.0),
        (0.14, 1.045),
        (0.05, 1.02),
    ];
    let left = [
        (-0.02, 0.955),
        (-0.1, 1.03),
        (-0.2, 1.02),
        (-0.27, 0.97),
        (-0.37, 0.95),
        (-0.43, 0.82),
        (-0.42, 0.66),
        (-0.3, 0.44),
        (-0.15, 0.26),
        (-0.06, 0.09),
        (-0.045, 0.0),
    ];
    let corners: Vec<Vec2> = right.into_iter().chain(left).map(Vec2::from).collect();
    let colour = |at: Vec2| {
        let fan = at.x.atan2(at.y + 0.25);
        let vein = (fan * 62.0 + 1.5 * noise(at * 5.0)).sin().abs().powi(9);
        let toward_margin = (at.y - 0.1).clamp(0.0, 1.0) * 0.75 + 0.6 * at.x.abs();
        let pale = Vec3::new(246.0, 232.0, 214.0);
        let deep = Vec3::new(222.0, 84.0, 138.0);
        let mut colour = pale.lerp(deep, (toward_margin + 0.12 * clouds(at * 7.0)).clamp(0.0, 1.0));
        colour -= Vec3::new(16.0, 26.0, 20.0) * vein;
        // It is hollow, so the light falls off to one side.
        colour *= 1.0 - 0.16 * (at.x + 0.3).max(0.0) - 0.1 * (at.y - 0.5).powi(2);
        let crease = from_line(at, Vec2::new(-0.27, 0.52), Vec2::new(0.16, 0.9));
        colour - 62.0 * (1.0 - crease / 0.006).clamp(0.0, 1.0)
    };
    Thing { outline: smooth(&corners, 8), colour }
}

/// A toothed leaf on a short stalk.
pub(crate) fn leaf() -> Thing {
    let half = |t: f32| 0.31 * (std::f32::consts::PI * t.powf(0.85)).sin().max(0.0).powf(0.8);
    let tooth = |t: f32| 0.02 * ((13.0 * t).fract() - 0.3) * (6.0 * t * (1.0 - t)).min(1.0);
    let side = |sign: f32| {
        (1..260).map(move |k| k as f32 / 260.0).map(move |t| {
            let t = if sign > 0.0 { t } else { 1.0 - t };
            Vec2::new(sign * (half(t).max(0.012) + tooth(t)) + 0.05 * t * (1.0 - t), 0.13 + 0.87 * t)
        })
    };
    let stalk = [(-0.012, 0.13), (-0.011, 0.0), (0.011, 0.0), (0.012, 0.13)].map(Vec2::from);
    let outline = side(1.0).chain([Vec2::Y]).chain(side(-1.0)).chain(stalk).collect();
    let colour = |at: Vec2| {
        let t = (at.y - 0.13) / 0.87;
        let x = at.x - 0.05 * t * (1.0 - t);
        let green = Vec3::new(74.0, 124.0, 52.0) + Vec3::new(26.0, 30.0, 10.0) * clouds(at * 9.0);
        let light = Vec3::new(168.0, 190.0, 104.0);
        let rib = (1.0 - x.abs() / (0.012 - 0.008 * t.clamp(0.0, 1.0))).clamp(0.0, 1.0);
        let along = (at.y - 0.62 * x.abs()) * 11.0;
        let vein = (1.0 - (along.fract() - 0.5).abs() / 0.05).clamp(0.0, 1.0) * f32::from(u8::from(t > 0.02));
        let fine = 0.12 * ((at.y + 0.8 * x.abs()) * 210.0 + 3.0 * noise(at * 30.0)).sin();
        green.lerp(light, (rib.max(0.55 * vein) + fine).clamp(0.0, 1.0)) * (1.0 - 0.2 * (x + 0.1).max(0.0))
    };
    Thing { outline, colour }
}

/// How a thing lies on the photograph.
pub(crate) struct Lying {
    /// Its base and its length, pixels.
    pub(crate) base: Vec2,
    pub(crate) length: f32,
    /// Turned clockwise.
    pub(crate) deg: f32,
}

/// A photograph of a thing on paper.
pub(crate) fn photograph((width, height): (u32, u32), thing: &Thing, lying: &Lying) -> Rgba {
    let turn = Vec2::from_angle(lying.deg.to_radians());
    let to_photo = |p: Vec2| lying.base + turn.rotate(Vec2::new(p.x, -p.y)) * lying.length;
    let to_plane = |at: Vec2| {
        let own = Vec2::new(turn.x, -turn.y).rotate(at - lying.base) / lying.length;
        Vec2::new(own.x, -own.y)
    };
    let line: Vec<Vec2> = thing.outline.iter().map(|p| to_photo(*p)).collect();
    let rows: Vec<Vec<u8>> = (0..height)
        .into_par_iter()
        .map(|y| {
            let pixel = |x: u32| {
                let at = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                let covered = (signed_distance(&line, at) + 0.5).clamp(0.0, 1.0);
                let shadow = signed_distance(&line, at - Vec2::new(0.014, 0.02) * lying.length);
                let shadow = (0.5 + shadow / (0.05 * lying.length)).clamp(0.0, 1.0);
                let ground = paper(at / width as f32) * (1.0 - 0.34 * shadow * shadow);
                let colour = ground.lerp((thing.colour)(to_plane(at)), covered);
                let grain = 5.0 * noise(at * 0.9 + 300.0);
                (colour + grain).to_array().map(|c| c.round().clamp(0.0, 255.0) as u8)
            };
            (0..width).flat_map(|x| [&pixel(x)[..], &[255]].concat()).collect()
        })
        .collect();
    Rgba { width, height, pixels: rows.concat() }
}

/// Paper under a window: lighter to the upper left.
fn paper(share: Vec2) -> Vec3 {
    let light = 1.0 - 0.13 * share.x - 0.1 * share.y;
    Vec3::new(226.0, 224.0, 217.0) * light + 4.0 * clouds(share * 40.0)
}

/// Distance from a closed line, positive within.
fn signed_distance(line: &[Vec2], at: Vec2) -> f32 {
    let (mut nearest, mut is_in) = (f32::INFINITY, false);
    for (a, b) in line.iter().zip(line.iter().cycle().skip(1)) {
        nearest = nearest.min(from_line(at, *a, *b + 1e-6));
        if (a.y > at.y) != (b.y > at.y) && at.x < a.x + (b.x - a.x) * (at.y - a.y) / (b.y - a.y) {
            is_in = !is_in;
        }
    }
    if is_in { nearest } else { -nearest }
}

/// Fissured bark, lit from the left.
pub(crate) fn bark((width, height): (u32, u32)) -> Rgba {
    let pixel = |i: u32| {
        let at = Vec2::new((i % width) as f32, (i / width) as f32);
        let place = at / width as f32 * Vec2::new(9.0, 2.6);
        let bent = place + Vec2::new(1.1 * clouds(place * 0.9), 0.4 * clouds(place * 1.3 + 50.0));
        let ridge = (bent.x * 2.4 + 0.8 * noise(bent * Vec2::new(1.0, 2.0))).sin();
        let height = ridge.abs().powf(0.6) + 0.35 * clouds(bent * Vec2::new(6.0, 12.0));
        let colour = Vec3::new(46.0, 36.0, 30.0).lerp(Vec3::new(168.0, 146.0, 122.0), height.clamp(0.0, 1.0));
        let light = 1.15 - 0.6 * at.x / width as f32;
        (colour * light + 6.0 * noise(at * 0.8)).to_array().map(|c| c.round().clamp(0.0, 255.0) as u8)
    };
    let pixels = (0..width * height).flat_map(|i| [&pixel(i)[..], &[255]].concat()).collect();
    Rgba { width, height, pixels }
}
