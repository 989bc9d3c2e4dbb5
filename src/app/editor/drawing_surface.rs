//! The surface in space that a pen draws on: a plane, or the lines along which a branch can be lifted.
//!
//! Two strokes make one curve in space (001 §4.2): a branch is drawn as it is seen from one side, say its plan from above, and
//! lifted from another one. The lines of sight through the first stroke are a ruled surface, and the second stroke is drawn on
//! that. From the side it was drawn from, the branch looks afterwards as it did before.

use crate::geom::ray::Ray;
use glam::{Mat3, Vec3};

/// Least sine of the angle between a ray and a surface: nearly along it a small move of the pen would be a long way.
const LEAST_SINE: f32 = 0.08;

/// A surface that a pen draws on, metres.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum DrawingSurface {
    /// The plane through a point.
    Plane { through: Vec3, normal: Vec3 },
    /// All lines in one direction through a line; `from` is how far along the line the pen has come, in pieces.
    Ruled { line: Vec<Vec3>, along: Vec3, from: f32 },
}

impl DrawingSurface {
    /// Where a ray meets it; for a ruled surface the place nearest to where the pen was.
    pub(super) fn met_by(&mut self, ray: &Ray) -> Option<Vec3> {
        match self {
            Self::Plane { through, normal } => {
                let sine = ray.direction.dot(*normal);
                let along = (*through - ray.origin).dot(*normal) / sine;
                (sine.abs() >= LEAST_SINE).then(|| ray.at(along))
            }
            Self::Ruled { line, along, from } => {
                let (place, point) = meet_ruled(line, *along, *from, ray)?;
                *from = place;
                Some(point)
            }
        }
    }

    /// Of a ruled surface, how high over its line a place on it is, and what of the line lies beyond where the pen has come.
    pub(super) fn beyond(&self, place: Vec3) -> Option<(Vec3, &[Vec3])> {
        let Self::Ruled { line, along, from } = self else { return None };
        let i = from.floor() as usize;
        let here = line.get(i)?.lerp(*line.get(i + 1).or(line.get(i))?, from.fract());
        let rest = line.get(from.ceil() as usize..).unwrap_or(&[]);
        Some(((place - here).project_onto(*along), rest))
    }
}

/// The place on the ruled surface that a ray meets, of several that nearest to `from`: pieces of the line, and the point.
fn meet_ruled(line: &[Vec3], along: Vec3, from: f32, ray: &Ray) -> Option<(f32, Vec3)> {
    let meets = |(i, ends): (usize, &[Vec3])| {
        let way = ends[1] - ends[0];
        let normal = way.cross(along).try_normalize()?;
        if ray.direction.dot(normal).abs() < LEAST_SINE {
            return None;
        }
        // origin + t·direction = ends[0] + share·way + height·along
        let columns = Mat3::from_cols(way, along, -ray.direction);
        let solved = columns.inverse() * (ray.origin - ends[0]);
        let is_within = (-1e-3..=1.001).contains(&solved.x) && solved.is_finite();
        is_within.then(|| (i as f32 + solved.x.clamp(0.0, 1.0), ray.at(solved.z)))
    };
    let all = line.windows(2).enumerate().filter_map(meets);
    all.min_by(|a, b| (a.0 - from).abs().total_cmp(&(b.0 - from).abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plan_that_is_lifted_keeps_its_plan() {
        // A quarter of a circle on the ground, lifted from the front along a slope.
        let plan: Vec<Vec3> = (0..=20)
            .map(|k| (k as f32 / 20.0 * 1.5).sin_cos())
            .map(|(s, c)| Vec3::new(s, 0.0, 1.0 - c))
            .collect();
        let mut surface = DrawingSurface::Ruled { line: plan, along: Vec3::Y, from: 0.0 };
        for k in 0..=10 {
            let x = 0.09 * k as f32;
            let ray = Ray { origin: Vec3::new(x, 0.5 * x, 10.0), direction: Vec3::NEG_Z };
            let met = surface.met_by(&ray).unwrap();
            assert!((met.x - x).abs() < 1e-4 && (met.y - 0.5 * x).abs() < 1e-4, "{met}");
            let depth = 1.0 - (1.0 - x * x).sqrt();
            assert!((met.z - depth).abs() < 2e-3, "{met}, plan {depth}");
        }
        let (height, rest) = surface.beyond(Vec3::new(0.81, 0.405, 0.0)).unwrap();
        assert!((height - Vec3::Y * 0.405).length() < 1e-4 && !rest.is_empty(), "{height}");
    }

    #[test]
    fn rays_along_the_surface_meet_nothing() {
        let mut plane = DrawingSurface::Plane { through: Vec3::ZERO, normal: Vec3::Y };
        assert_eq!(plane.met_by(&Ray { origin: Vec3::Y, direction: Vec3::X }), None);
        let down = Ray { origin: Vec3::new(2.0, 3.0, 1.0), direction: Vec3::NEG_Y };
        assert_eq!(plane.met_by(&down), Some(Vec3::new(2.0, 0.0, 1.0)));
        let mut ruled = DrawingSurface::Ruled { line: vec![Vec3::ZERO, Vec3::X], along: Vec3::Y, from: 0.0 };
        assert_eq!(ruled.met_by(&Ray { origin: Vec3::NEG_X, direction: Vec3::X }), None);
    }
}
