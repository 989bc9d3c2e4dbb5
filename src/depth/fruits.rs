//! Drawn fruits in the world: bodies of revolution that hang where they were drawn.
//!
//! A fruit on a stalk hangs in the depth of its end. A fruit in a crown hangs at the front of that, as deep as the crown is
//! wide around that place: nobody draws those behind. Limits: fruits hang upright.

use super::crowns;
use crate::anatomy::Anatomy;
use crate::anatomy::conventions::{Solid, SolidKind};
use crate::plant::{Organ, OrganPart, Plant, Provenance, Role, Shape, WorldFromCanvas};
use glam::{Vec2, Vec3};

/// Share of a crown's depth at which its fruits hang, that leaves hide only a part of them.
const FRONT: f32 = 0.96;

/// Adds the drawn fruits.
pub(super) fn add(plant: &mut Plant, provenance: &mut Provenance, anatomy: &Anatomy) {
    let world = provenance.world_from_canvas;
    let fruits = anatomy.solids.iter().filter(|drawn| drawn.solid.kind == SolidKind::Fruit);
    for drawn in fruits {
        let Some((top, shape)) = fruit(&drawn.solid, &world) else { continue };
        let (low, high) = drawn.solid.bounds();
        let front = crowns::front(anatomy, low.midpoint(high));
        let depth = front.map_or_else(|| depth_of_stalk(plant, top), |depth| FRONT * depth * world.scale);
        let mut shape = shape;
        shape.translate(Vec3::Z * depth);
        let origin = provenance.record(Some(drawn.stroke));
        plant.organs.push(Organ {
            role: Role::of(OrganPart::Fruit),
            origin,
            branch: None,
            flower: None,
            shape,
        });
    }
}

/// The upper end and the shape of a fruit in the plane of the drawing; none of one without a size.
fn fruit(solid: &Solid, world: &WorldFromCanvas) -> Option<(Vec3, Shape)> {
    let (top, bottom) = (solid.profile.first()?.y, solid.profile.last()?.y);
    let row = |p: &Vec2| Vec2::new(p.x, bottom - p.y) * world.scale;
    let mut profile: Vec<Vec2> = solid.profile.iter().rev().map(row).collect();
    // Both ends lie on the axis, whatever rounding made of them.
    profile.first_mut()?.x = 0.0;
    profile.last_mut()?.x = 0.0;
    let place = |y: f32| world.point(Vec2::new(solid.axis, y));
    (bottom > top).then(|| (place(top), Shape::Lathe { base: place(bottom), axis: Vec3::Y, profile }))
}

/// How far in front of the drawing the wood is that comes nearest to a fruit's upper end, as seen from the front, metres.
fn depth_of_stalk(plant: &Plant, top: Vec3) -> f32 {
    let points = plant.branches.iter().flat_map(|branch| &branch.points);
    let aside = |p: &&Vec3| p.truncate().distance_squared(top.truncate());
    points.min_by(|a, b| aside(a).total_cmp(&aside(b))).map_or(0.0, |p| p.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::FlatCrown;
    use crate::anatomy::conventions::DrawnSolid;

    fn ball(x: f32, y: f32) -> DrawnSolid {
        let profile = [(0.0, y - 10.0), (10.0, y), (0.0, y + 10.0)].map(Vec2::from).to_vec();
        DrawnSolid { stroke: 7, solid: Solid { kind: SolidKind::Fruit, axis: x, profile } }
    }

    fn added(anatomy: &Anatomy) -> Plant {
        let world = WorldFromCanvas { scale: 0.01, origin: Vec2::ZERO };
        let (mut plant, mut provenance) = (Plant::default(), Provenance::new(world));
        add(&mut plant, &mut provenance, anatomy);
        assert!(plant.organs.iter().all(|organ| provenance.stroke(organ.origin) == Some(7)));
        plant
    }

    fn base(organ: &Organ) -> Vec3 {
        let Shape::Lathe { base, .. } = organ.shape else { panic!("no body of revolution") };
        base
    }

    #[test]
    fn fruits_in_a_crown_hang_at_its_front_and_others_in_the_sheet() {
        let outline =
            (0..60).map(|k| 100.0 * Vec2::from_angle(std::f32::consts::TAU * k as f32 / 60.0)).collect();
        let crowns = vec![FlatCrown { stroke: 1, outline }];
        let anatomy = Anatomy {
            solids: vec![ball(0.0, 0.0), ball(80.0, 0.0), ball(300.0, 0.0)],
            crowns,
            ..Anatomy::default()
        };
        let plant = added(&anatomy);
        let depths: Vec<f32> = plant.organs.iter().map(|organ| base(organ).z).collect();
        assert!(
            (depths[0] - 0.96).abs() < 0.02 && (0.4..0.7).contains(&depths[1]) && depths[2] == 0.0,
            "{depths:?}"
        );
        assert!(base(&plant.organs[2]).distance(Vec3::new(3.0, -0.1, 0.0)) < 1e-5);
    }
}
