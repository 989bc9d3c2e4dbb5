//! The tip of a petal in the drawing, before and after the flower's cone is known.
//!
//! A petal's tip is where its outline touches the rim of the cone: its point of greatest slant. On a tilted cone that
//! is not the point farthest from the root in the drawing, so tips are found twice: first where the ray from the root
//! through the outline's centre of area leaves the outline, which a tilt of a flat petal keeps, being an affine map;
//! then, cone in hand, where the unrolled outline reaches farthest from the apex.
//!
//! Limits: on the near side of a cone seen from outside the outline is climbed from the last tip, as points of the
//! far side lie over it there; a petal folded over the silhouette keeps its farthest point as first estimate.
//!
//! Departs from 000 eq. 3.2 and 002 §5.1, which take the point of sharpest turn: round petals have none.

use super::cone_fit::Rim;
use glam::{DVec2, Vec2};

/// One petal as it was drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PetalOutline<'a> {
    /// Points of the stroke in canvas pixels, around the petal from anywhere in either direction; a gap is closed.
    pub points: &'a [Vec2],
    /// Where it is attached, canvas pixels.
    pub root: Vec2,
}

impl PetalOutline<'_> {
    /// Whether it has a shape: finite, and some point away from the root.
    pub(super) fn is_usable(&self) -> bool {
        let reach = self.reach();
        reach.is_finite() && reach > 0.0
    }

    /// Distance of its farthest point from the root in pixels, not finite if any coordinate is not.
    pub(super) fn reach(&self) -> f64 {
        let root = self.root.as_dvec2();
        let farther = |far: f64, p: &Vec2| {
            let distance = p.as_dvec2().distance(root);
            if distance > far || distance.is_nan() { distance } else { far }
        };
        self.points.iter().fold(0.0, farther)
    }
}

/// A petal's outline counted from the flower's centre in units of the flower's size.
pub(super) struct Petal {
    points: Vec<DVec2>,
    /// Where it is attached.
    pub root: DVec2,
    /// First estimate of the tip, without knowledge of the cone.
    pub free_tip: DVec2,
}

/// Share of a blade's swept area that must have one sign; below it the outline folds over itself.
const FOLDED: f64 = 0.8;

impl Petal {
    pub(super) fn new(outline: &PetalOutline<'_>, center: DVec2, size: f64) -> Self {
        let local = |p: Vec2| (p.as_dvec2() - center) / size;
        let points: Vec<DVec2> = outline.points.iter().map(|&p| local(p)).collect();
        let root = local(outline.root);
        let mut petal = Self { points, root, free_tip: root };
        petal.free_tip = petal.estimate();
        petal
    }

    /// Counts it from another place.
    pub(super) fn shift(&mut self, by: DVec2) {
        self.points.iter_mut().chain([&mut self.root, &mut self.free_tip]).for_each(|p| *p += by);
    }

    fn estimate(&self) -> DVec2 {
        let (mut moment, mut area, mut swept) = (DVec2::ZERO, 0.0, 0.0);
        for (&a, &b) in self.sides() {
            let (a, b) = (a - self.root, b - self.root);
            let part = a.perp_dot(b);
            moment += (a + b) * part;
            area += part;
            swept += part.abs();
        }
        // Seen along its surface a petal has no area to speak of, but then its tip is simply its far end.
        if area.abs() > FOLDED * swept { self.ray_tip(moment / area) } else { self.farthest() }
    }

    fn farthest(&self) -> DVec2 {
        let far = |p: &DVec2| p.distance_squared(self.root);
        self.points.iter().copied().fold(self.root, |best, p| if far(&p) > far(&best) { p } else { best })
    }

    /// Where a ray from the root leaves the outline for good.
    fn ray_tip(&self, ray: DVec2) -> DVec2 {
        let ray = ray.normalize_or_zero();
        let mut best = (0.0, None);
        let mut previous = self.points.last().map_or(0.0, |&p| ray.perp_dot(p - self.root));
        for (i, &p) in self.points.iter().enumerate() {
            let here = ray.perp_dot(p - self.root);
            if (previous > 0.0) != (here > 0.0) {
                let before = self.points[(i + self.points.len() - 1) % self.points.len()];
                let crossing = before + (p - before) * (previous / (previous - here));
                let reach = ray.dot(crossing - self.root);
                if reach > best.0 {
                    best = (reach, Some(crossing));
                }
            }
            previous = here;
        }
        best.1.unwrap_or_else(|| self.farthest())
    }

    /// Where the unrolled outline reaches farthest from the apex; `near` for a petal on the cone's near side.
    pub(super) fn tip_on(&self, rim: &Rim, tip: DVec2) -> DVec2 {
        let near = rim.is_near(tip);
        if near { self.climb(rim, tip) } else { self.top(rim) }
    }

    fn top(&self, rim: &Rim) -> DVec2 {
        let mut best = (f64::NEG_INFINITY, 0);
        // A wobble around the root means nothing, yet may lie far up a cone that opens toward the viewer.
        let outward = self.free_tip - self.root;
        let least = 0.25 * outward.length_squared();
        for (i, &q) in self.points.iter().enumerate() {
            if outward.dot(q - self.root) < least {
                continue;
            }
            let share = rim.slant_share(q, false);
            if share > best.0 {
                best = (share, i);
            }
        }
        self.refined(rim, best.1, false)
    }

    /// Uphill along the outline from the point nearest to `from`.
    fn climb(&self, rim: &Rim, from: DVec2) -> DVec2 {
        let count = self.points.len();
        let nearest = |best: usize, i: usize| {
            let closer = self.points[i].distance_squared(from) < self.points[best].distance_squared(from);
            if closer { i } else { best }
        };
        let mut at = (0..count).fold(0, nearest);
        let mut share = rim.slant_share(self.points[at], true);
        for _ in 0..count / 4 {
            let next =
                [(at + 1) % count, (at + 2) % count, (at + count - 1) % count, (at + count - 2) % count]
                    .map(|i| (rim.slant_share(self.points[i], true), i))
                    .into_iter()
                    .fold((share, at), |best, c| if c.0 > best.0 { c } else { best });
            if next.1 == at {
                break;
            }
            (share, at) = next;
        }
        self.refined(rim, at, true)
    }

    /// The top between samples: the vertex of the parabola through point `i` and its neighbours.
    fn refined(&self, rim: &Rim, i: usize, near: bool) -> DVec2 {
        let count = self.points.len();
        let [a, b, c] = [self.points[(i + count - 1) % count], self.points[i], self.points[(i + 1) % count]];
        let [sa, sb, sc] = [a, b, c].map(|q| rim.slant_share(q, near));
        let bend = sa - 2.0 * sb + sc;
        if sb < sa || sb < sc || bend >= 0.0 {
            return b;
        }
        let x = 0.5 * (sa - sc) / bend;
        b + (c - a) * (0.5 * x) + (a - 2.0 * b + c) * (0.5 * x * x)
    }

    fn sides(&self) -> impl Iterator<Item = (&DVec2, &DVec2)> {
        self.points.iter().zip(self.points.iter().cycle().skip(1))
    }
}
