//! Fit of a flower's cone to the tips of its petals in the drawing.
//!
//! What is fitted. With t the axis projected onto the drawing plane (|t| = cos θ, θ the angle between axis and plane),
//! rim radius R, opening ω and height h = R / tan ω, the rim is a circle about apex + h · axis. From the front it is
//! the ellipse `|d|² + (t·d)² / (1 − |t|²) = R²` with `d = q − h · t`, q counted from the projected apex:
//! minor/major = sin θ, and the apex lies on the minor axis at h cos θ from the centre (000 §4.1, 002 §5.1, with
//! h = l / cos θ where both print l / sin θ). That is one unknown less than a free ellipse has.
//!
//! How. Levenberg–Marquardt (`least_squares`) on the distances of the tips from the ellipse (first order, Sampson) with Huber weights,
//! plus weak residuals that only speak where the tips are silent:
//! * opening: a flower seen face-on does not determine its height;
//! * evenness: petals spread evenly around the axis have their mean tip at the ellipse's centre and a covariance of
//!   `R²/2 · (1 − ttᵀ)`. It settles flowers of three or four petals and half flowers;
//! * axis: a flower goes on where its stem arrives.
//!
//! The axis is (τ, 1)/|(τ, 1)| with τ any vector, so that nothing happens to the parameters when a flower is seen
//! face-on and no step can leave the half space toward the viewer.

use super::least_squares::{Normal, Problem};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// Flattest cone: opening in radians.
const WIDEST: f64 = 85.0 * std::f64::consts::PI / 180.0;
/// Steepest cone: opening in radians.
const NARROWEST: f64 = 8.0 * std::f64::consts::PI / 180.0;
/// Longest τ: the axis stays 3° off the drawing plane, where the ellipse is a line.
const LONGEST_TILT: f64 = 19.0;
/// Size of a Huber residual beyond which it counts linearly, in standard deviations.
const HUBER: f64 = 2.5;
const UNKNOWNS: usize = 4;

/// A cone as the fit sees it: apex at the origin of the drawing plane, y down, axis toward the viewer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ConeFit {
    /// Axis divided by its part toward the viewer, x and y.
    pub tilt: DVec2,
    /// Angle between axis and side, radians.
    pub opening: f64,
    /// Radius of the rim.
    pub radius: f64,
}

/// The ellipse of the rim, with what its distances need.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rim {
    /// Projected unit axis, |t| = cos θ.
    pub t: DVec2,
    /// Centre, from the projected apex.
    pub center: DVec2,
    /// Radius of the rim, the ellipse's major semi-axis.
    pub radius: f64,
    /// sin²θ = 1 − |t|².
    pub sin2: f64,
    /// Distance from the apex to the rim's plane.
    pub height: f64,
    per_sin2: f64,
    /// Of the apex beyond the ellipse: positive for a cone that is seen from outside.
    excess: f64,
}

impl ConeFit {
    /// Unit axis, y down, z toward the viewer.
    pub(super) fn axis(&self) -> DVec3 {
        self.tilt.extend(1.0).normalize()
    }

    /// Distance from the apex to the rim's plane.
    pub(super) fn height(&self) -> f64 {
        self.radius / self.opening.tan()
    }

    /// Distance from the apex to the rim.
    pub(super) fn slant(&self) -> f64 {
        self.radius / self.opening.sin()
    }

    pub(super) fn rim(&self) -> Rim {
        let sin2 = 1.0 / (1.0 + self.tilt.length_squared());
        let t = self.tilt * sin2.sqrt();
        let height = self.height();
        let (center, per_sin2) = (t * height, 1.0 / sin2);
        let excess = stretched(t, per_sin2, center, center) - self.radius * self.radius;
        Rim { t, center, radius: self.radius, sin2, height, per_sin2, excess }
    }

    /// The cone whose rim has this centre, radius and axis.
    pub(super) fn from_rim(center: DVec2, radius: f64, t: DVec2) -> Self {
        let cos = t.length().min(0.998);
        let height = center.length() / cos.max(1e-3);
        let tilt = t.normalize_or_zero() * (cos / (1.0 - cos * cos).sqrt());
        Self { tilt, opening: radius.atan2(height), radius }.sane()
    }

    /// Whether two cones are the same to far less than a pixel.
    pub(super) fn is_close_to(&self, other: &Self) -> bool {
        let scale = 1e-4 * (1.0 + self.tilt.length_squared());
        self.tilt.distance(other.tilt) < scale
            && (self.opening - other.opening).abs() < 1e-4
            && (self.radius - other.radius).abs() < 1e-4 * self.radius
    }

    fn sane(self) -> Self {
        Self {
            tilt: self.tilt.clamp_length_max(LONGEST_TILT),
            opening: self.opening.clamp(NARROWEST, WIDEST),
            radius: self.radius.max(1e-6),
        }
    }

    /// Steps of this size away from the bounds, at which a step outward would change nothing.
    pub(super) fn inward(&self, size: f64) -> [f64; UNKNOWNS] {
        let widening = if self.opening > 0.5 * (WIDEST + NARROWEST) { -size } else { size };
        [-size.copysign(self.tilt.x), -size.copysign(self.tilt.y), widening, size]
    }

    /// A step in tilt, opening and the radius's logarithm.
    pub(super) fn stepped(&self, step: [f64; UNKNOWNS]) -> Self {
        Self {
            tilt: self.tilt + DVec2::new(step[0], step[1]),
            opening: self.opening + step[2],
            radius: self.radius * step[3].clamp(-1.0, 1.0).exp(),
        }
        .sane()
    }
}

/// Product of two directions of the drawing where the ellipse is a circle.
fn stretched(t: DVec2, per_sin2: f64, a: DVec2, b: DVec2) -> f64 {
    a.dot(b) + t.dot(a) * t.dot(b) * per_sin2
}

/// Azimuth about an axis with projection `t`, radians, of a place at `d` from the middle of its rim.
pub(super) fn azimuth(t: DVec2, sin2: f64, d: DVec2) -> f64 {
    let minor = t.try_normalize().unwrap_or(DVec2::Y);
    d.perp_dot(minor).atan2(d.dot(minor) / sin2.sqrt())
}

/// The turns between neighbouring tips about the axis, radians.
#[derive(Clone, Debug)]
pub(super) struct Turns {
    /// All but the largest, in their order behind it.
    others: Vec<f64>,
    /// The largest.
    pub largest: f64,
}

impl Turns {
    /// What the turns other than the largest are in the mean.
    pub(super) fn usual(&self) -> f64 {
        (TAU - self.largest) / self.others.len().max(1) as f64
    }

    /// How far they are from all being alike, in units of the usual turn: one number for each but the largest.
    fn unevenness(&self) -> impl Iterator<Item = f64> + '_ {
        let usual = self.usual().max(1e-6);
        self.others.iter().map(move |turn| turn / usual - 1.0)
    }
}

impl Rim {
    /// Size of the ellipse about the rim's centre through `d`, counted from there; the rim's own is 1.
    fn gauge(&self, d: DVec2) -> f64 {
        (d.length_squared() + self.t.dot(d).powi(2) * self.per_sin2).sqrt() / self.radius
    }

    /// Signed distance of a point from the ellipse to first order, positive outside.
    pub(super) fn distance(&self, q: DVec2) -> f64 {
        let d = q - self.center;
        let gauge = self.gauge(d);
        (gauge - 1.0) / self.slope(d, gauge)
    }

    /// Length of the gauge's gradient at `d`, positive; at the centre, which has none, that of the minor axis.
    fn slope(&self, d: DVec2, gauge: f64) -> f64 {
        let slope =
            (d + self.t * (self.t.dot(d) * self.per_sin2)).length() / (self.radius * self.radius * gauge);
        if slope > 0.0 && slope.is_finite() { slope } else { 1.0 / (self.radius * self.sin2.sqrt()) }
    }

    /// Slant at which the cone's side passes over `q`, in units of the rim's slant: on the far side of the cone, or on
    /// the near side, which only a cone seen from outside has. Outside the silhouette the closest approach counts.
    pub(super) fn slant_share(&self, q: DVec2, near: bool) -> f64 {
        let excess = self.excess;
        let (qq, qm) =
            (stretched(self.t, self.per_sin2, q, q), stretched(self.t, self.per_sin2, q, self.center));
        if excess > 0.0 && qm <= 0.0 {
            return 0.0;
        }
        let root = (qm * qm - excess * qq).max(0.0).sqrt();
        let denominator = if near && excess > 0.0 { qm - root } else { qm + root };
        if denominator > 0.0 { qq / denominator } else { 0.0 }
    }

    /// Depth, from the apex toward the viewer, of the rim over `q`; where `q` lies off the rim, of the rim beside it.
    pub(super) fn depth(&self, q: DVec2) -> f64 {
        let cos = self.t.length();
        if cos < 1e-9 {
            return self.height;
        }
        // Along the projected axis the rim spans ±R sin θ in the drawing and ∓R cos θ in depth.
        let sin = self.sin2.sqrt();
        let share = ((q - self.center).dot(self.t) / (cos * self.radius * sin)).clamp(-1.0, 1.0);
        self.height * sin - share * self.radius * cos
    }

    /// Azimuth of a tip about the axis, radians.
    pub(super) fn azimuth(&self, q: DVec2) -> f64 {
        azimuth(self.t, self.sin2, q - self.center)
    }

    /// How tips turn about the axis from one to the next.
    pub(super) fn turns(&self, tips: &[DVec2]) -> Turns {
        let mut angles: Vec<f64> = tips.iter().map(|&q| self.azimuth(q)).collect();
        angles.sort_by(f64::total_cmp);
        let (Some(first), Some(last)) = (angles.first(), angles.last()) else {
            return Turns { others: Vec::new(), largest: TAU };
        };
        let across = first + TAU - last;
        let mut turns: Vec<f64> = angles.windows(2).map(|pair| pair[1] - pair[0]).collect();
        turns.push(across);
        let mut at = 0;
        for (i, turn) in turns.iter().enumerate() {
            at = if *turn > turns[at] { i } else { at };
        }
        let largest = turns[at];
        turns.rotate_left(at + 1);
        turns.pop();
        Turns { others: turns, largest }
    }

    /// Whether the rim's nearest point to `q` lies on the arc toward the apex, where the cone is seen from outside.
    pub(super) fn is_near(&self, q: DVec2) -> bool {
        let (far, near) = (self.slant_share(q, false), self.slant_share(q, true));
        (near - 1.0).abs() < (far - 1.0).abs()
    }
}

/// How much each kind of knowledge weighs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trust {
    /// Standard deviation of the tips, in units of their mean distance from the apex.
    pub tip: f64,
    /// Likely opening, radians, and its standard deviation.
    pub opening: (f64, f64),
    /// Standard deviation of the evenness of petals, in units of the tips' mean distance from the apex.
    pub evenness: f64,
    /// Standard deviation of the turns between neighbours, in units of the usual one.
    pub turns: f64,
    /// Where the flower's stem says that the axis points.
    pub stem: Option<StemPrior>,
}

/// The axis that a flower's stem lets expect: it goes on where the stem arrives, out of the drawing by some angle.
#[derive(Clone, Copy, Debug)]
pub(super) struct StemPrior {
    /// Direction across the plane through the stem and the viewer, and how far the axis leaves that plane, as a sine.
    across: (DVec3, f64),
    /// The same within that plane, square to the likely axis.
    within: (DVec3, f64),
    likely: DVec3,
}

impl StemPrior {
    /// The prior of a stem that arrives in unit direction `arrival` on the drawing, y down. `rise` is the likely angle
    /// between axis and drawing; `across` and `within` are standard deviations as sines.
    pub(super) fn new(arrival: DVec2, rise: f64, (across, within): (f64, f64)) -> Self {
        let (sin, cos) = rise.sin_cos();
        Self {
            across: (arrival.perp().extend(0.0), across),
            within: ((-arrival * sin).extend(cos), within),
            likely: (arrival * cos).extend(sin),
        }
    }

    /// How far an axis is from the likely one, in standard deviations across and within the stem's plane.
    fn off(&self, axis: DVec3) -> [f64; 2] {
        [self.across, self.within].map(|(direction, sd)| axis.dot(direction) / sd)
    }

    /// The cone of this opening on the likely axis.
    pub(super) fn cone(&self, opening: f64) -> ConeFit {
        ConeFit { tilt: self.likely.truncate() / self.likely.z.max(1e-3), opening, radius: opening.sin() }
    }
}

/// Mean and covariance of the tips.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moments {
    pub mean: DVec2,
    /// Covariance xx, xy, yy.
    pub spread: [f64; 3],
    /// 1 from three tips on; fewer have no meaningful covariance and count 0.
    weight: f64,
}

impl Moments {
    pub(super) fn of(tips: &[DVec2]) -> Self {
        let count = tips.len().max(1) as f64;
        let mean = tips.iter().sum::<DVec2>() / count;
        let mut spread = [0.0; 3];
        for d in tips.iter().map(|&q| q - mean) {
            spread[0] += d.x * d.x / count;
            spread[1] += d.x * d.y / count;
            spread[2] += d.y * d.y / count;
        }
        Self { mean, spread, weight: if tips.len() >= 3 { 1.0 } else { 0.0 } }
    }

    /// The cone whose evenly spread tips would have these moments.
    pub(super) fn cone(&self) -> ConeFit {
        let [xx, xy, yy] = self.spread;
        let (middle, split) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
        let minor = DVec2::from_angle(0.5 * (-2.0 * xy).atan2(yy - xx));
        let sin2 = ((middle - split) / (middle + split).max(1e-12)).clamp(0.0, 1.0);
        let sign = if minor.dot(self.mean) < 0.0 { -1.0 } else { 1.0 };
        // Along the mean where the covariance is round and has no direction of its own.
        let t = minor * sign * (1.0 - sin2).sqrt();
        ConeFit::from_rim(self.mean, (2.0 * (middle + split)).sqrt().max(1e-6), t)
    }
}

/// Residuals that do not belong to a tip: opening, mean (2), covariance (3), axis (2).
const PRIORS: usize = 8;

/// In standard deviations; the covariance is compared in units of the squared mean distance of the tips.
pub(super) fn priors(cone: &ConeFit, rim: &Rim, moments: &Moments, trust: &Trust) -> [f64; PRIORS] {
    let weight = moments.weight / trust.evenness;
    let off = (moments.mean - rim.center) * weight;
    let half = 0.5 * rim.radius * rim.radius;
    let t = rim.t;
    let even = [1.0 - t.x * t.x, -t.x * t.y, 1.0 - t.y * t.y];
    let spread = |k: usize| (moments.spread[k] - half * even[k]) * weight;
    let opening = (cone.opening - trust.opening.0) / trust.opening.1;
    let [across, within] = trust.stem.map_or([0.0; 2], |stem| stem.off(cone.axis()));
    [opening, off.x, off.y, spread(0), spread(1), spread(2), across, within]
}

/// Loss of a residual and its weight in the normal equations.
pub(super) fn huber(r: f64) -> (f64, f64) {
    let size = r.abs();
    if size <= HUBER { (r * r, 1.0) } else { (HUBER * (2.0 * size - HUBER), HUBER / size) }
}

/// What [`improve`] makes small: Huber losses of the tips and squares of the priors.
fn cost(cone: &ConeFit, tips: &[DVec2], moments: &Moments, trust: &Trust) -> f64 {
    let rim = cone.rim();
    let of_tips: f64 = tips.iter().map(|&q| huber(rim.distance(q) / trust.tip).0).sum();
    let of_turns: f64 = rim.turns(tips).unevenness().map(|r| huber(r / trust.turns).0).sum();
    of_tips + of_turns + priors(cone, &rim, moments, trust).iter().map(|r| r * r).sum::<f64>()
}

/// Cost, gradient and Gauss–Newton matrix at a cone, by forward differences.
fn normal(cone: &ConeFit, tips: &[DVec2], moments: &Moments, trust: &Trust) -> Normal<UNKNOWNS> {
    const H: f64 = 1e-6;
    let rim = cone.rim();
    let h = cone.inward(H);
    let moved: [ConeFit; UNKNOWNS] = std::array::from_fn(|k| {
        let mut step = [0.0; UNKNOWNS];
        step[k] = h[k];
        cone.stepped(step)
    });
    let rims = moved.map(|c| c.rim());
    let mut out = Normal { cost: 0.0, matrix: [[0.0; UNKNOWNS]; UNKNOWNS], gradient: [0.0; UNKNOWNS] };
    let mut add = |r: f64, at: [f64; UNKNOWNS], loss: (f64, f64)| {
        let slope: [f64; UNKNOWNS] = std::array::from_fn(|k| (at[k] - r) / h[k]);
        out.cost += loss.0;
        for i in 0..UNKNOWNS {
            out.gradient[i] += loss.1 * slope[i] * r;
            for j in i..UNKNOWNS {
                out.matrix[i][j] += loss.1 * slope[i] * slope[j];
            }
        }
    };
    for &q in tips {
        let r = rim.distance(q) / trust.tip;
        let gauge = rim.gauge(q - rim.center);
        // Near the ellipse only the gauge changes, not its slope: half the work for the same step.
        let per_gauge = 1.0 / (trust.tip * rim.slope(q - rim.center, gauge));
        add(r, rims.map(|rim| r + (rim.gauge(q - rim.center) - gauge) * per_gauge), huber(r));
    }
    let turns = rims.map(|rim| rim.turns(tips));
    for (k, here) in rim.turns(tips).unevenness().enumerate() {
        let r = here / trust.turns;
        let there = turns.each_ref().map(|turns| turns.others[k] / turns.usual().max(1e-6) - 1.0);
        add(r, there.map(|there| there / trust.turns), huber(r));
    }
    let here = priors(cone, &rim, moments, trust);
    let there: [_; UNKNOWNS] = std::array::from_fn(|k| priors(&moved[k], &rims[k], moments, trust));
    for (i, &r) in here.iter().enumerate() {
        add(r, there.map(|all| all[i]), (r * r, 1.0));
    }
    for i in 1..UNKNOWNS {
        for j in 0..i {
            out.matrix[i][j] = out.matrix[j][i];
        }
    }
    out
}

/// Improves a cone by at most `steps` steps; returns it with its cost.
pub(super) fn improve(
    cone: ConeFit,
    tips: &[DVec2],
    moments: &Moments,
    trust: &Trust,
    steps: u32,
) -> (ConeFit, f64) {
    let problem = Problem {
        normal: |cone: &ConeFit| normal(cone, tips, moments, trust),
        cost: |cone: &ConeFit| cost(cone, tips, moments, trust),
        stepped: ConeFit::stepped,
    };
    problem.improve(cone, steps)
}
