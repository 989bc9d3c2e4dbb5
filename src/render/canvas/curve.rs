//! Raw samples to a smooth line, one sample at a time.
//!
//! A centripetal Catmull-Rom spline (Catmull and Rom 1974; Yuksel, Schaefer and Keyser 2011: no loops, no overshoot) goes
//! through every sample, flattened where it bends. The line reaches the newest sample at once: its last piece is
//! provisional and is replaced when the next sample tells how it goes on. Nothing else of the line ever changes, so a
//! sample costs the same however long the stroke is.

use crate::sketch::StrokePoint;
use glam::{Vec2, Vec3};

/// Share of the full line width that the lightest touch draws.
const LIGHTEST: f32 = 0.25;
/// How far the flattened line may stray from the spline, as a share of the full line width.
const TOLERANCE: f32 = 0.004;
/// Most pieces between two samples.
const MOST_PIECES: f32 = 32.0;

/// A line that grows with its stroke. Its points are canvas positions with the radius as z.
#[derive(Clone, Debug, PartialEq)]
pub struct StrokeCurve {
    width: f32,
    /// The last samples, newest last.
    knots: [Option<Vec3>; 3],
    /// Points at the end that the next sample replaces.
    provisional: usize,
}

impl StrokeCurve {
    /// The line of a stroke without samples; `width` is its width at full pressure in canvas units.
    pub fn new(width: f32) -> Self {
        Self { width, knots: [None; 3], provisional: 0 }
    }

    /// Takes the next sample: appends points to `out` and returns how many of the line's last points they replace.
    /// Samples that are not finite are left out.
    pub fn push(&mut self, sample: &StrokePoint, out: &mut Vec<Vec3>) -> usize {
        let Some(new) = self.knot(sample) else { return 0 };
        let replaced = self.provisional;
        let start = out.len();
        let [a, b, c] = self.knots;
        match c {
            // The pen rests: the line only swells.
            Some(last) if last.truncate() == new.truncate() => {
                let swollen = last.with_z(last.z.max(new.z));
                self.knots[2] = Some(swollen);
                match b {
                    Some(b) => self.piece(a, b, swollen, None, out),
                    None => out.extend([swollen; 2]),
                }
                self.provisional = out.len() - start;
                return replaced;
            }
            Some(last) => match b {
                Some(b) => self.piece(a, b, last, Some(new), out),
                None => out.push(last),
            },
            None => {}
        }
        let settled = out.len();
        match c {
            Some(last) => self.piece(b, last, new, None, out),
            // A single sample is a dot: a piece without length.
            None => out.extend([new; 2]),
        }
        self.provisional = out.len() - settled;
        self.knots = [b, c, Some(new)];
        replaced
    }

    fn knot(&self, sample: &StrokePoint) -> Option<Vec3> {
        let pressure = if sample.pressure.is_finite() { sample.pressure.clamp(0.0, 1.0) } else { 0.0 };
        let radius = self.width / 2.0 * (LIGHTEST + (1.0 - LIGHTEST) * pressure);
        Some(sample.position.extend(radius)).filter(|knot| knot.is_finite())
    }

    /// Appends the line from `from` to `to` without its first point.
    fn piece(&self, before: Option<Vec3>, from: Vec3, to: Vec3, after: Option<Vec3>, out: &mut Vec<Vec3>) {
        let (begin, end) = (from.truncate(), to.truncate());
        let before = before.map_or(2.0 * begin - end, Vec3::truncate);
        let after = after.map_or(2.0 * end - begin, Vec3::truncate);
        let handle_begin = handle(before, begin, end);
        let handle_end = handle(after, end, begin);
        let bend = off_chord(handle_begin, begin, end).max(off_chord(handle_end, begin, end));
        let pieces = (0.75 * bend / (TOLERANCE * self.width).max(1e-6)).sqrt().ceil().clamp(1.0, MOST_PIECES);
        for i in 1..pieces as u32 {
            let t = i as f32 / pieces;
            let s = 1.0 - t;
            let at = begin * (s * s * s)
                + handle_begin * (3.0 * s * s * t)
                + handle_end * (3.0 * s * t * t)
                + end * (t * t * t);
            out.push(at.extend(from.z + (to.z - from.z) * t));
        }
        out.push(to);
    }
}

/// Distance of a point from the piece of a line between two others.
fn off_chord(point: Vec2, begin: Vec2, end: Vec2) -> f32 {
    let chord = end - begin;
    let along = ((point - begin).dot(chord) / chord.length_squared().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
    point.distance(begin + chord * along)
}

/// Bézier handle at `at` toward `next` of the centripetal spline that comes from `before`.
fn handle(before: Vec2, at: Vec2, next: Vec2) -> Vec2 {
    let came = before.distance(at).sqrt();
    let goes = at.distance(next).sqrt();
    if came <= 1e-6 * goes || goes == 0.0 {
        return at.lerp(next, 1.0 / 3.0);
    }
    let (came2, goes2) = (came * came, goes * goes);
    (next * came2 - before * goes2 + at * (2.0 * came2 + 3.0 * came * goes + goes2))
        / (3.0 * came * (came + goes))
}

/// The whole line of a stroke.
#[cfg(test)]
pub(super) fn line(samples: &[StrokePoint], width: f32) -> Vec<Vec3> {
    let mut curve = StrokeCurve::new(width);
    let (mut line, mut new) = (Vec::new(), Vec::new());
    for sample in samples {
        let replaced = curve.push(sample, &mut new);
        line.truncate(line.len() - replaced);
        line.append(&mut new);
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(points: &[(f32, f32)]) -> Vec<StrokePoint> {
        points
            .iter()
            .map(|&(x, y)| StrokePoint { pressure: 1.0, ..StrokePoint::at(Vec2::new(x, y)) })
            .collect()
    }

    fn circle(count: usize, radius: f32) -> Vec<StrokePoint> {
        let at = |i: usize| Vec2::from_angle(i as f32 * std::f32::consts::TAU / count as f32) * radius;
        (0..=count).map(|i| StrokePoint { pressure: 1.0, ..StrokePoint::at(at(i)) }).collect()
    }

    #[test]
    fn the_line_goes_through_every_sample_in_order() {
        let samples = samples(&[(0.0, 0.0), (10.0, 3.0), (15.0, 20.0), (-4.0, 22.0), (-4.0, 50.0)]);
        let line = line(&samples, 4.0);
        let mut rest = line.iter();
        for sample in &samples {
            assert!(rest.any(|p| p.truncate() == sample.position), "{sample:?}");
        }
        assert_eq!(line[0].truncate(), samples[0].position);
        assert_eq!(line[line.len() - 1].truncate(), samples[4].position);
    }

    #[test]
    fn sparse_samples_of_a_circle_are_round() {
        let line = line(&circle(12, 100.0), 4.0);
        let inner = line.iter().filter(|p| p.x < 80.0);
        let stray = inner.map(|p| (p.truncate().length() - 100.0).abs()).fold(0.0, f32::max);
        assert!(stray < 0.6, "{stray}; straight pieces would stray 3.4");
        let turn = line
            .windows(3)
            .map(|w| (w[1] - w[0]).truncate().angle_to((w[2] - w[1]).truncate()).abs().to_degrees());
        assert!(turn.fold(0.0, f32::max) < 15.0, "no visible corner");
    }

    #[test]
    fn straight_and_dense_strokes_get_no_points_of_their_own() {
        let straight = samples(&[(0.0, 0.0), (10.0, 0.0), (40.0, 0.0), (41.0, 0.0)]);
        assert_eq!(line(&straight, 4.0).len(), 4, "uneven spacing is no bend");
        assert!(line(&circle(2000, 100.0), 4.0).len() <= 2001);
    }

    #[test]
    fn a_sample_replaces_only_the_last_piece() {
        let mut curve = StrokeCurve::new(4.0);
        let mut new = Vec::new();
        for sample in circle(12, 100.0) {
            new.clear();
            let replaced = curve.push(&sample, &mut new);
            assert!(replaced <= MOST_PIECES as usize && new.len() <= 2 * MOST_PIECES as usize);
            assert_eq!(new.last().unwrap().truncate(), sample.position, "the line never lags");
        }
    }

    #[test]
    fn a_resting_pen_makes_a_dot_that_swells() {
        let mut dot = samples(&[(5.0, 5.0), (5.0, 5.0)]);
        dot[0].pressure = 0.0;
        assert_eq!(line(&dot[..1], 4.0), [Vec3::new(5.0, 5.0, 0.5); 2]);
        assert_eq!(line(&dot, 4.0), [Vec3::new(5.0, 5.0, 2.0); 2]);
    }

    #[test]
    fn samples_that_are_no_numbers_are_left_out() {
        let mut odd = samples(&[(0.0, 0.0), (f32::NAN, 1.0), (2.0, f32::INFINITY), (3.0, 0.0)]);
        odd[3].pressure = f32::NAN;
        let line = line(&odd, 4.0);
        assert_eq!(line.len(), 2);
        assert!(line.iter().all(|p| p.is_finite()));
    }
}
