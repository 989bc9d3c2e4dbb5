//! Flowers and their petals in space, each made from its own petals and stem.
//!
//! A pose takes hundreds of steps to find, so [`Flowers`] keeps them from one drawing to the next: by the outlines of the
//! flower's petals and by the direction in which its stem arrives. Petals are kept by their outline and by the cone that
//! they stand on.

use super::cone_pose::{ConeParams, FlowerPose, PetalOutline, Whorl, flower_pose};
use super::flower_stem;
use super::hidden_petals;
use super::outline::{CurlParams, DrawnBlade};
use super::petals;
use crate::anatomy::{Anatomy, FlatBlade, FlatFlower};
use crate::kept::{Kept, Use};
use crate::plant::{
    Blade, Cone, Flower, Organ, OrganPart, Origin, Provenance, Role, Shape, Template, Templates,
    WorldFromCanvas,
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
        (curl, fill_hidden): (&CurlParams, bool),
        provenance: &mut Provenance,
    ) -> (Vec<Flower>, Vec<Organ>, Templates) {
        let world = &{ provenance.world_from_canvas };
        let posed = anatomy.flowers.iter().zip(poses).zip(depths);
        let flowers: Vec<Flower> =
            posed.map(|((flat, pose), depth)| flower(flat, pose, *depth, &anatomy.petals, world)).collect();
        let mut placed = Vec::with_capacity(anatomy.petals.len());
        for ((flat, pose), flower) in anatomy.flowers.iter().zip(poses).zip(&flowers) {
            let petals = flat.petals.iter().zip(&pose.tip_depths).zip(&pose.whorl_of);
            placed.extend(petals.map(|((&p, tip_depth), whorl)| PlacedPetal {
                flat: &anatomy.petals[p],
                cone: cone_of(&pose.whorls[*whorl], &flower.cone, world),
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
        for (index, ((flat, flower), pose)) in anatomy.flowers.iter().zip(&flowers).zip(poses).enumerate() {
            let mut petal = |origin: Origin, blade: &Blade<Arc<Template>>| Organ {
                role: Role::of(OrganPart::Petal),
                origin,
                branch: flower.branch,
                flower: Some(index),
                shape: Shape::Blade(blade.with_template(templates.add(Arc::clone(&blade.template)))),
            };
            let own: Vec<&Blade<Arc<Template>>> = blades.by_ref().take(flat.petals.len()).collect();
            let drawn = flat.petals.iter().zip(&own);
            organs.extend(drawn.map(|(&p, blade)| petal(provenance.record(anatomy.petals[p].stroke), blade)));
            if fill_hidden && pose.whorls.len() > 1 {
                let hidden = hidden_in_whorls(&own, pose, &flower.cone, world);
                organs.extend(hidden.iter().map(|blade| petal(Origin::Generated, blade)));
            }
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

/// Petals that others hide in the whorls of a flower with these petals.
fn hidden_in_whorls(
    petals: &[&Blade<Arc<Template>>],
    pose: &FlowerPose,
    flower: &Cone,
    world: &WorldFromCanvas,
) -> Vec<Blade<Arc<Template>>> {
    let of_whorl = |(number, whorl): (usize, &Whorl)| {
        let own = petals.iter().zip(&pose.whorl_of).filter(|(_, of)| **of == number);
        let own: Vec<_> = own.map(|(blade, _)| blade.resolved()).collect();
        hidden_petals::hidden(&own, &cone_of(whorl, flower, world))
    };
    pose.whorls.iter().enumerate().flat_map(of_whorl).collect()
}

/// The cone of a whorl, with the apex and the axis of its flower's.
fn cone_of(whorl: &Whorl, flower: &Cone, world: &WorldFromCanvas) -> Cone {
    Cone { opening_rad: whorl.opening_rad, height: whorl.height_px * world.scale, ..*flower }
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
    let longest = pose.whorls.iter().map(|whorl| whorl.slant_px).fold(0.0, f32::max);
    let reach = (longest * world.scale).max(1e-6);
    let bare = Cone { apex, axis: pose.axis, opening_rad: 0.0, height: 0.0 };
    let cone = cone_of(&pose.outermost(), &bare, world);
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
