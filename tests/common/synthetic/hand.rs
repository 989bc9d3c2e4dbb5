//! An ideal line as a hand draws it: uneven speed, wobble, tremor, hooks where the pen lands or lifts, any direction.

use glam::Vec2;
use penstemon::geom::polyline;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use std::f32::consts::TAU;

/// Slow waves of the least steady hand, each of at most this share of the drawn thing's extent.
const WOBBLE: f32 = 0.02;
/// Fast tremor of the least steady hand, share of the extent.
const TREMOR: f32 = 0.005;
/// Share of strokes that begin or end in a hook.
const HOOKS: f64 = 0.2;

/// Draws `ideal` at a random place, size (20 to 2,000 pixels), angle, handedness and sense.
pub(crate) fn draw(ideal: &[Vec2], rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let samples = rng.random_range(16..120);
    let mut points = with_wobble(&at_uneven_speed(ideal, samples, rng), rng);
    add_hook(&mut points, rng);
    points.reverse();
    add_hook(&mut points, rng);
    if rng.random_bool(0.5) {
        points.reverse();
    }
    on_canvas(&points, rng)
}

fn extent(points: &[Vec2]) -> f32 {
    let (low, high) =
        points.iter().fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(lo, hi), &p| (lo.min(p), hi.max(p)));
    (high - low).max_element()
}

/// `samples` points along the line, closer together where the hand is slow.
fn at_uneven_speed(line: &[Vec2], samples: usize, rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let (depth, waves, phase) =
        (rng.random_range(0.0..0.8), rng.random_range(1.0..4.0), rng.random_range(0.0..TAU));
    let speeds: Vec<f32> =
        (1..samples).map(|i| 1.0 + depth * (phase + TAU * waves * i as f32 / samples as f32).sin()).collect();
    let total: f32 = speeds.iter().sum();
    let mut travelled = 0.0;
    let mut shares = vec![0.0];
    shares.extend(speeds.iter().map(|speed| {
        travelled += speed / total;
        travelled.min(1.0)
    }));
    along(line, &shares)
}

/// Points at ascending shares (0 to 1) of the line's length.
fn along(line: &[Vec2], shares: &[f32]) -> Vec<Vec2> {
    let length = polyline::length(line);
    let (mut segment, mut passed) = (0, 0.0);
    let at = |&share: &f32| loop {
        let (a, b) = (line[segment], line[segment + 1]);
        let step = a.distance(b);
        let target = share * length;
        if passed + step >= target || segment + 2 == line.len() {
            return a.lerp(b, ((target - passed) / step.max(f32::MIN_POSITIVE)).clamp(0.0, 1.0));
        }
        passed += step;
        segment += 1;
    };
    shares.iter().map(at).collect()
}

fn with_wobble(points: &[Vec2], rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    // Rulers, mice and steady hands leave hardly any wobble.
    let size = extent(points) * rng.random_range(0.0_f32..1.0);
    let waves: Vec<(f32, f32, Vec2)> = (1..=4)
        .map(|k| {
            let reach = size * rng.random_range(0.0..WOBBLE);
            let direction = Vec2::from_angle(rng.random_range(0.0..TAU));
            (k as f32 * rng.random_range(0.7..1.6), rng.random_range(0.0..TAU), direction * reach)
        })
        .collect();
    let last = (points.len() - 1) as f32;
    let shaken = |(i, &p): (usize, &Vec2)| {
        let slow: Vec2 =
            waves.iter().map(|&(f, phase, v)| v * (phase + TAU * f * i as f32 / last).sin()).sum();
        let fast = Vec2::new(rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0));
        p + slow + fast * size * TREMOR
    };
    points.iter().enumerate().map(shaken).collect()
}

/// Sometimes a short tick after the last point, in any direction.
fn add_hook(points: &mut Vec<Vec2>, rng: &mut Pcg64Mcg) {
    if rng.random_bool(HOOKS) {
        let reach = extent(points) * rng.random_range(0.01..0.06);
        let tick = Vec2::from_angle(rng.random_range(0.0..TAU)) * reach;
        points.extend(points.last().map(|&end| end + tick));
    }
}

fn on_canvas(points: &[Vec2], rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let pixels = 20.0 * 100.0_f32.powf(rng.random_range(0.0..1.0));
    let scale = pixels / extent(points);
    let turn = Vec2::from_angle(rng.random_range(0.0..TAU));
    let place = Vec2::new(rng.random_range(0.0..2000.0), rng.random_range(0.0..2000.0));
    let mirror = if rng.random_bool(0.5) { Vec2::ONE } else { Vec2::new(-1.0, 1.0) };
    let whole_pixels = pixels > 100.0 && rng.random_bool(0.5);
    let to_canvas = |&p: &Vec2| {
        let q = turn.rotate(p * mirror) * scale + place;
        if whole_pixels { q.round() } else { q }
    };
    points.iter().map(to_canvas).collect()
}
