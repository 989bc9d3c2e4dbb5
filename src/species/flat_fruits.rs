//! Fruits that are flat: the keys of ash and maple, pods.
//!
//! Each is one blade that narrows to a stalk, a maple's two that part from each other. The outlines are drawn once; copies differ in size
//! and in the way they face. They have few points, because a tree bears thousands: a stalk of its own would cost more than the fruit.
//!
//! Limits: a seed is seen by the outline alone, the blade is nowhere thicker there.

use super::fruit_look::FruitShape;
use crate::plant::{Blade, BladeForm, Detail, RestSurface, Shape, Template, TemplateId, Templates};
use glam::{Vec2, Vec3};

/// Half of an outline that is even on both sides of its axis: how far it reaches aside, in the half width, at which part of its height. What is
/// narrow at its foot is the stalk.
type Half = &'static [(f32, f32)];

const KEY: Half = &[(0.1, 0.26), (0.5, 0.42), (1.0, 0.78)];
const POD: Half = &[(0.12, 0.14), (0.95, 0.28), (0.74, 0.42), (1.0, 0.56), (0.76, 0.7), (0.9, 0.86)];
/// A wing with its seed at the foot: aside in the half width, up in the height. Its back is straight, the other edge round.
const WING: &[(f32, f32)] =
    &[(0.0, 0.0), (0.5, 0.14), (0.3, 0.32), (1.0, 0.74), (0.5, 1.0), (-0.25, 0.9), (-0.4, 0.3)];
/// How far each of two wings leaves the axis, radians.
const PARTED: f32 = 0.95;

/// The blades of one kind of fruit.
pub(super) struct FlatFruit {
    /// Each with the angle by which it leaves the axis, toward `u`, radians.
    blades: Vec<(TemplateId, f32)>,
}

impl FlatFruit {
    /// That of a shape with this height over its width, its outlines among `templates`; none of a shape that is a body.
    pub(super) fn of(shape: FruitShape, length: f32, templates: &mut Templates) -> Option<Self> {
        let mut add = |outline: Vec<Vec2>| {
            let unit = outline.into_iter().map(|p| Vec2::new(0.5 * p.x / length, p.y)).collect();
            templates.add(Template::new(unit, Vec::new(), 1.0, Detail::Reduced))
        };
        let blades = match shape {
            FruitShape::Key => vec![(add(even(KEY)), 0.0)],
            FruitShape::Pod => vec![(add(even(POD)), 0.0)],
            FruitShape::Wings => {
                let wing = |side: f32| WING.iter().map(|(x, y)| Vec2::new(side * x, *y)).collect();
                vec![(add(wing(1.0)), PARTED), (add(wing(-1.0)), -PARTED)]
            }
            _ => return None,
        };
        Some(Self { blades })
    }

    /// Its blades, `height` metres long, from `base` along the unit vector `axis`; `facing` says which way they face.
    pub(super) fn blades(&self, base: Vec3, axis: Vec3, facing: Vec3, height: f32) -> Vec<Shape> {
        let across = axis.cross(facing).try_normalize().unwrap_or_else(|| axis.any_orthonormal_vector());
        let form = BladeForm { cup: 0.0, ..BladeForm::default() };
        let blade = |(template, angle): &(TemplateId, f32)| {
            let (sin, cos) = angle.sin_cos();
            let (u, v) = (cos * across - sin * axis, cos * axis + sin * across);
            let (u, v, rest) = (u * height, v * height, RestSurface::Plane);
            Shape::Blade(Blade { template: *template, base, u, v, rest, form })
        };
        self.blades.iter().map(blade).collect()
    }
}

/// The outline with this half, from its foot around.
fn even(half: Half) -> Vec<Vec2> {
    let right = half.iter().map(|p| Vec2::from(*p));
    let left = half.iter().rev().map(|(x, y)| Vec2::new(-x, *y));
    [Vec2::ZERO].into_iter().chain(right).chain([Vec2::Y]).chain(left).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(shape: FruitShape) -> (FlatFruit, Templates) {
        let mut templates = Templates::default();
        let fruit = FlatFruit::of(shape, 4.0, &mut templates).unwrap();
        templates.iter().for_each(|template| assert_eq!(template.check_invariants(), Ok(())));
        (fruit, templates)
    }

    #[test]
    fn blades_are_as_long_and_as_wide_as_they_are_to_be() {
        for (shape, count) in [(FruitShape::Key, 1), (FruitShape::Pod, 1), (FruitShape::Wings, 2)] {
            let (fruit, templates) = of(shape);
            let blades = fruit.blades(Vec3::ONE, Vec3::NEG_Y, Vec3::Z, 0.04);
            assert_eq!(blades.len(), count);
            for shape in blades {
                let Shape::Blade(blade) = shape else { panic!("a blade") };
                assert!((blade.v.length() - 0.04).abs() < 1e-6 && blade.u.dot(blade.v).abs() < 1e-6);
                let outline = templates[blade.template].outline();
                let half = outline.iter().map(|p| p.x.abs()).fold(0.0, f32::max);
                assert!((half - 0.125).abs() < 1e-5, "a quarter as wide as long: {half}");
            }
        }
    }

    #[test]
    fn the_wings_of_a_key_part_to_both_sides_and_bodies_have_none() {
        let (fruit, _) = of(FruitShape::Wings);
        let tips: Vec<Vec3> = fruit
            .blades(Vec3::ZERO, Vec3::NEG_Y, Vec3::Z, 1.0)
            .into_iter()
            .map(|shape| if let Shape::Blade(blade) = shape { blade.v } else { Vec3::ZERO })
            .collect();
        assert!(
            (tips[0].x + tips[1].x).abs() < 1e-5 && tips[0].x.abs() > 0.5 && tips[0].y < -0.5,
            "{tips:?}"
        );
        assert!(FlatFruit::of(FruitShape::Apple, 1.0, &mut Templates::default()).is_none());
    }
}
