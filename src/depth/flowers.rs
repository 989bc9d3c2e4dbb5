//! Flowers and their petals in space, each made from its own petals and stem.
//!
//! A pose takes hundreds of steps to find, so [`Flowers`] keeps them from one drawing to the next: by the outlines of the
//! flower's petals and by the direction in which its stem arrives. Petals are kept by their outline and by the cone that
//! they stand on.

use super::cone_pose::{ConeParams, FlowerPose, PetalOutline, flower_pose};
use super::flower_stem;
use super::outline::{CurlParams, DrawnBlade};
use super::petals;
use crate::anatomy::{Anatomy, FlatBlade, FlatFlower};
use crate::kept::{Kept, Use};
use crate::plant::{
    Blade, Cone, Flower, Organ, OrganPart, Provenance, Role, Shape, Template, Templates, WorldFromCanvas,
};
use glam::Vec2;
use std::sync::Arc;

/// Least and largest radius of a flower's centre, as shares of the petals' reach.
const CENTRE: (f32, f32) = (0.05, 0.4);

/// Flowers from one drawing to the next, all made with the same parameters.
#[derive(Debug, Default)]
pub struct Flowers {
    poses: Kept<PoseKey, Arc<FlowerPose>>,
    petals: Kept<PetalKey, Blade<Arc<Template>>>,
}

/// Everything that a pose is found from but the parameters.
#[derive(Debug, PartialEq, Eq, Hash)]
struct PoseKey {
    petals: Vec<DrawnBlade>,
    stem: Option<[u32; 2]>,
}

/// Everything that a petal is made from but the parameters.
#[derive(Debug, PartialEq, Eq, Hash)]
struct PetalKey {
    petal: DrawnBlade,
    /// The cone that it stands on, the depth of its tip and how the drawing maps to the world.
    place: [u32; 12],
}

/// A petal on its way into space.
struct PlacedPetal<'a> {
    flat: &'a FlatBlade,
    cone: Cone,
    /// World depth of its tip.
    tip_depth: f32,
}

impl Flowers {
    /// For a single drawing, of which nothing is kept.
    pub fn for_one_build() -> Self {
        Self { poses: Kept::for_one_call(), petals: Kept::for_one_call() }
    }

    /// The poses of all flowers of a drawing.
    pub fn poses(&mut self, anatomy: &Anatomy, params: &ConeParams) -> Vec<Arc<FlowerPose>> {
        let stem = |flower: &FlatFlower| {
            let place = flower.attachment?;
            flower_stem::arrival(anatomy, place, flower)
        };
        let flowers: Vec<(&FlatFlower, Option<Vec2>)> =
            anatomy.flowers.iter().map(|flower| (flower, stem(flower))).collect();
        let key = |(flower, stem): &(&FlatFlower, Option<Vec2>), used: Use| PoseKey {
            petals: flower.petals.iter().map(|&p| DrawnBlade::of(&anatomy.petals[p], used)).collect(),
            stem: stem.map(|stem| stem.to_array().map(f32::to_bits)),
        };
        let pose =
            |(flower, stem): &(&FlatFlower, Option<Vec2>)| Arc::new(pose_of(flower, *stem, anatomy, params));
        self.poses.made(&flowers, key, pose).to_vec()
    }

    /// The flowers of a drawing and the organs that are their petals, flower by flower, with templates of their own; `depths`
    /// are those of their centres in pixels.
    pub fn stand(
        &mut self,
        anatomy: &Anatomy,
        (poses, depths): (&[Arc<FlowerPose>], &[f32]),
        curl: &CurlParams,
        provenance: &mut Provenance,
    ) -> (Vec<Flower>, Vec<Organ>, Templates) {
        let world = &{ provenance.world_from_canvas };
        let posed = anatomy.flowers.iter().zip(poses).zip(depths);
        let flowers: Vec<Flower> =
            posed.map(|((flat, pose), depth)| flower(flat, pose, *depth, &anatomy.petals, world)).collect();
        let mut placed = Vec::with_capacity(anatomy.petals.len());
        for ((flat, pose), flower) in anatomy.flowers.iter().zip(poses).zip(&flowers) {
            placed.extend(flat.petals.iter().zip(&pose.tip_depths).map(|(&p, tip_depth)| PlacedPetal {
                flat: &anatomy.petals[p],
                cone: flower.cone,
                tip_depth: flower.cone.apex.z + tip_depth * world.scale,
            }));
        }
        let mut blades = self
            .petals
            .made(
                &placed,
                |petal, used| petal.key(world, used),
                |petal| petals::petal(petal.flat, &petal.cone, petal.tip_depth, world, curl),
            )
            .iter();
        let (mut organs, mut templates) =
            (Vec::with_capacity(placed.len() + anatomy.leaves.len()), Templates::default());
        for (index, (flat, flower)) in anatomy.flowers.iter().zip(&flowers).enumerate() {
            organs.extend(flat.petals.iter().zip(blades.by_ref()).map(|(&p, blade)| Organ {
                role: Role::of(OrganPart::Petal),
                origin: provenance.record(anatomy.petals[p].stroke),
                branch: flower.branch,
                flower: Some(index),
                shape: Shape::Blade(blade.with_template(templates.add(Arc::clone(&blade.template)))),
            }));
        }
        (flowers, organs, templates)
    }
}

impl PlacedPetal<'_> {
    fn key(&self, world: &WorldFromCanvas, used: Use) -> PetalKey {
        let Cone { apex, axis, opening_rad, height } = self.cone;
        let WorldFromCanvas { scale, origin } = *world;
        let ([a, b, c], [d, e, f], [g, h]) = (apex.to_array(), axis.to_array(), origin.to_array());
        let place = [a, b, c, d, e, f, opening_rad, height, self.tip_depth, scale, g, h].map(f32::to_bits);
        PetalKey { petal: DrawnBlade::of(self.flat, used), place }
    }
}

fn pose_of(flower: &FlatFlower, stem: Option<Vec2>, anatomy: &Anatomy, params: &ConeParams) -> FlowerPose {
    let petals = &anatomy.petals;
    let points: Vec<Vec<Vec2>> =
        flower.petals.iter().map(|&p| petals[p].outline.iter().map(|s| s.position).collect()).collect();
    let outlines: Vec<PetalOutline> = flower
        .petals
        .iter()
        .zip(&points)
        .map(|(&p, points)| PetalOutline { points, root: petals[p].root })
        .collect();
    flower_pose(&outlines, stem, params)
}

fn flower(
    flat: &FlatFlower,
    pose: &FlowerPose,
    center_depth: f32,
    petals: &[FlatBlade],
    world: &WorldFromCanvas,
) -> Flower {
    let apex = world.point(pose.center).with_z(center_depth * world.scale);
    let reach = (pose.slant_px * world.scale).max(1e-6);
    let cone =
        Cone { apex, axis: pose.axis, opening_rad: pose.opening_rad, height: pose.height_px * world.scale };
    let members = flat.petals.iter().map(|&p| &petals[p]);
    let centre =
        flat.centre_radius.unwrap_or_else(|| petals::root_distance(members, pose.center)) * world.scale;
    Flower {
        branch: flat.attachment.map(|place| place.branch),
        cone,
        centre_radius: centre.clamp(CENTRE.0 * reach, CENTRE.1 * reach),
        reach,
        look: 0,
    }
}
