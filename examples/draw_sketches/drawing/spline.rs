//! Smooth lines through a few chosen points, and walking along them.
//!
//! Centripetal Catmull–Rom splines: they pass through their points and make neither loops nor cusps between unevenly
//! spaced ones, which is how a practised hand joins points. Positions are in whatever unit the caller uses.

use glam::DVec2;

/// Samples between two neighbouring points.
const STEPS: usize = 28;

/// Densely sampled smooth line through `points`; fewer than two points come back as they are.
pub fn through(points: &[DVec2]) -> Vec<DVec2> {
    let n = points.len();
    if n < 2 {
        return points.to_vec();
    }
    let before = 2.0 * points[0] - points[1];
    let after = 2.0 * points[n - 1] - points[n - 2];
    let at = |i: isize| match usize::try_from(i) {
        Ok(i) if i < n => points[i],
        Ok(_) => after,
        Err(_) => before,
    };
    let spans = (0..n as isize - 1).map(|i| [at(i - 1), at(i), at(i + 1), at(i + 2)]);
    let mut line: Vec<DVec2> = spans.flat_map(span).collect();
    line.push(points[n - 1]);
    line
}

/// Closed version of [`through`]: the line returns to the first point, which is repeated at the end.
pub fn around(points: &[DVec2]) -> Vec<DVec2> {
    let n = points.len();
    let spans =
        (0..n).map(|i| [points[(i + n - 1) % n], points[i], points[(i + 1) % n], points[(i + 2) % n]]);
    let mut line: Vec<DVec2> = spans.flat_map(span).collect();
    line.extend(points.first());
    line
}

/// The stretch from `p[1]` (included) to `p[2]` (excluded), by the pyramid of Barry and Goldman.
fn span(p: [DVec2; 4]) -> Vec<DVec2> {
    let mut t = [0.0; 4];
    for i in 1..4 {
        t[i] = t[i - 1] + p[i].distance(p[i - 1]).sqrt().max(1e-6);
    }
    let mix = |a: DVec2, b: DVec2, from: f64, to: f64, x: f64| a + (b - a) * ((x - from) / (to - from));
    let sample = |k: usize| {
        let x = t[1] + (t[2] - t[1]) * k as f64 / STEPS as f64;
        let low: [DVec2; 3] = std::array::from_fn(|i| mix(p[i], p[i + 1], t[i], t[i + 1], x));
        let mid: [DVec2; 2] = std::array::from_fn(|i| mix(low[i], low[i + 1], t[i], t[i + 2], x));
        mix(mid[0], mid[1], t[1], t[2], x)
    };
    (0..STEPS).map(sample).collect()
}

/// Arc length from the start to every point of `line`.
pub fn lengths(line: &[DVec2]) -> Vec<f64> {
    let mut total = 0.0;
    let steps = line.windows(2).map(|w| {
        total += w[0].distance(w[1]);
        total
    });
    std::iter::once(0.0).chain(steps).collect()
}

/// Value at `x` of the piecewise linear function with knots `xs` (ascending) and values `ys`.
pub fn interpolate(xs: &[f64], ys: &[DVec2], x: f64) -> DVec2 {
    let last = xs.len() - 1;
    let i = xs.partition_point(|&k| k <= x).clamp(1, last.max(1)) - 1;
    if last == 0 {
        return ys[0];
    }
    let t = ((x - xs[i]) / (xs[i + 1] - xs[i]).max(1e-12)).clamp(0.0, 1.0);
    ys[i].lerp(ys[i + 1], t)
}

/// `line` with points `spacing` apart, both ends kept.
pub fn even(line: &[DVec2], spacing: f64) -> Vec<DVec2> {
    let knots = lengths(line);
    let total = knots[knots.len() - 1];
    let count = (total / spacing).ceil().max(1.0) as usize;
    (0..=count).map(|i| interpolate(&knots, line, total * i as f64 / count as f64)).collect()
}
