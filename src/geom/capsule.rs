//! Internodes as capsules: what of two is nearest, and whether they keep their distance.

use crate::geom::bvh::Bounds;
use glam::Vec3;

/// An internode, or a piece of one.
#[derive(Clone, Copy, Debug)]
pub struct Capsule {
    /// The lower end, metres.
    pub from: Vec3,
    /// The upper end, metres.
    pub to: Vec3,
    /// Metres.
    pub radius: f32,
}

impl Capsule {
    /// Distance of its ends, metres.
    pub fn length(&self) -> f32 {
        self.from.distance(self.to)
    }

    /// A box around it: two that keep `kept` times the sum of their radii have boxes apart, or may.
    pub fn bounds(&self, kept: f32) -> Bounds {
        let wide = Vec3::splat(kept * self.radius);
        (self.from.min(self.to) - wide, self.from.max(self.to) + wide)
    }

    /// The part farther than a distance from the lower end.
    pub fn above(self, distance: f32) -> Option<Self> {
        let length = self.length();
        (distance < length)
            .then(|| Self { from: self.from.lerp(self.to, distance.max(0.0) / length), ..self })
    }

    /// The part farther than a distance from the upper end.
    pub fn below(self, distance: f32) -> Option<Self> {
        let turned = Self { from: self.to, to: self.from, ..self };
        turned.above(distance).map(|part| Self { from: part.to, to: part.from, ..part })
    }

    /// Whether two are nearer than a multiple of the sum of their radii.
    pub fn overlaps(&self, other: &Self, kept: f32) -> bool {
        let reach = kept * (self.radius + other.radius);
        let (p, q) = self.nearest(other);
        p.distance_squared(q) < reach * reach
    }

    /// The place on the axis of each that is nearest to the other.
    pub fn nearest(&self, other: &Self) -> (Vec3, Vec3) {
        let (along, of_other, off) = (self.to - self.from, other.to - other.from, self.from - other.from);
        let (aa, bb, ab) = (along.length_squared(), of_other.length_squared(), along.dot(of_other));
        let (a_off, b_off) = (along.dot(off), of_other.dot(off));
        let det = aa * bb - ab * ab;
        // Nearest on the lines, then each share kept within its segment.
        let s = if det > 1e-9 * aa * bb { ((ab * b_off - bb * a_off) / det).clamp(0.0, 1.0) } else { 0.0 };
        let t = if bb > 0.0 { ((ab * s + b_off) / bb).clamp(0.0, 1.0) } else { 0.0 };
        let s = if aa > 0.0 { ((ab * t - a_off) / aa).clamp(0.0, 1.0) } else { 0.0 };
        (self.from + along * s, other.from + of_other * t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    #[test]
    fn distances_of_segments_are_those_of_their_nearest_points() {
        let of = |(from, to): (Vec3, Vec3)| Capsule { from, to, radius: 1.0 };
        let squared_distance = |a, b| {
            let (p, q) = of(a).nearest(&of(b));
            p.distance_squared(q)
        };
        let x = (Vec3::ZERO, Vec3::X);
        assert_eq!(squared_distance(x, (vec3(0.5, 1.0, -1.0), vec3(0.5, 1.0, 1.0))), 1.0);
        assert_eq!(squared_distance(x, (vec3(3.0, 0.0, 0.0), vec3(4.0, 5.0, 0.0))), 4.0);
        assert_eq!(squared_distance(x, (vec3(0.0, 2.0, 0.0), vec3(1.0, 2.0, 0.0))), 4.0);
        assert_eq!(squared_distance(x, (vec3(-1.0, 0.0, 0.0), vec3(-1.0, 0.0, 0.0))), 1.0);
    }
}
