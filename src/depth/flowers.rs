//! Flowers and their petals in space, each made from its own petals and stem.
//!
//! A pose takes hundreds of steps to find, so [`Flowers`] keeps them from one drawing to the next: by the outlines of the
//! flower's petals and by the direction in which its stem arrives. Petals are kept by their outline and by the cone that
//! they stand on.

use super::cone_pose::{ConeParams, FlowerPose, PetalOutline, Whorl, flower_pose};
use super::flower_stem;
use super::hidden_petals::{self, MadePetal};
use super::outline::{CurlParams, DrawnBlade};
use super::{petal_shapes, petals};
use crate::anatomy::{Anatomy, FlatBlade, FlatFlower};
use crate::kept::{Kept, Use};
use crate::plant::{
    Cone, Flower, GrownId, Organ, OrganPart, Origin, Provenance, Role, Shape, Templates, WorldFromCanvas,
};
use crate::random::Choice;
use crate::sketch::PetalShape;
use glam::Vec2;
use std::borrow::Cow;
use std::sync::Arc;

/// Least and largest radius of a flower's centre, as shares of the petals' reach.
const CENTRE: (f32, f32) = (0.05, 0.4);

/// Flowers from one drawing to the next, all made with the same parameters.
#[derive(Debug, Default)]
pub struct Flowers {
    poses: Kept<PoseKey, Arc<FlowerPose>>,
    petals: Kept<PetalKey, MadePetal>,
    /// By the petals of their whorl.
    hidden: Kept<Vec<PetalKey>, Arc<Vec<MadePetal>>>,
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

/// A whorl of a flower of several, with what was drawn of it.
struct DrawnWhorl<'a> {
    /// Its flower's place.
    flower: usize,
    cone: Cone,
    petals: Vec<(&'a PlacedPetal<'a>, &'a MadePetal)>,
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
        Self { poses: Kept::for_one_call(), petals: Kept::for_one_call(), hidden: Kept::for_one_call() }
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
    /// are those of their centres in pixels. Shapes come last and are not kept: they cost no more than looking them up.
    pub fn stand(
        &mut self,
        anatomy: &Anatomy,
        (poses, depths): (&[Arc<FlowerPose>], &[f32]),
        (curl, fill_hidden, shapes): (&CurlParams, bool, &[PetalShape]),
        provenance: &mut Provenance,
    ) -> (Vec<Flower>, Vec<Organ>, Templates) {
        let world = &{ provenance.world_from_canvas };
        let posed = anatomy.flowers.iter().zip(poses).zip(depths);
        let flowers = posed.map(|((flat, pose), depth)| flower(flat, pose, *depth, &anatomy.petals, world));
        let flowers: Vec<Flower> =
            flowers.enumerate().map(|(look, flower)| Flower { look, ..flower }).collect();
        let mut placed = Vec::with_capacity(anatomy.petals.len());
        for ((flat, pose), flower) in anatomy.flowers.iter().zip(poses).zip(&flowers) {
            let petals = flat.petals.iter().zip(&pose.tip_depths).zip(&pose.whorl_of);
            placed.extend(petals.map(|((&p, tip_depth), whorl)| PlacedPetal {
                flat: &anatomy.petals[p],
                cone: cone_of(&pose.whorls[*whorl], &flower.cone, world),
                tip_depth: flower.cone.apex.z + tip_depth * world.scale,
            }));
        }
        let blades = self.petals.made(
            &placed,
            |petal, used| petal.key(world, used),
            |petal| petals::petal(petal.flat, &petal.cone, petal.tip_depth, world, curl),
        );
        let several = if fill_hidden { drawn_whorls(poses, &placed, blades) } else { Vec::new() };
        let hidden = self.hidden.made(
            &several,
            |whorl, used| whorl.petals.iter().map(|(petal, _)| petal.key(world, used)).collect(),
            |whorl| Arc::new(whorl.hidden()),
        );
        let (mut organs, mut templates) =
            (Vec::with_capacity(placed.len() + anatomy.leaves.len()), Templates::default());
        let mut petal = |index: usize, origin: Origin, blade: &MadePetal| Organ {
            role: Role { look: index as u32, ..Role::of(OrganPart::Petal) },
            origin,
            branch: flowers[index].branch,
            flower: Some(index),
            shape: Shape::Blade(blade.with_template(templates.add(Arc::clone(&blade.template)))),
        };
        let mut blades = blades.iter();
        let mut hidden = several.iter().zip(hidden).peekable();
        let shapes = petal_shapes::of_drawing(anatomy, shapes);
        for ((index, flat), shape) in anatomy.flowers.iter().enumerate().zip(shapes) {
            for (&p, blade) in flat.petals.iter().zip(blades.by_ref()) {
                let origin = provenance.record(anatomy.petals[p].stroke);
                organs.push(petal(index, origin, &as_shaped(blade, shape)));
            }
            while let Some((_, copies)) = hidden.next_if(|(whorl, _)| whorl.flower == index) {
                let shaped = copies.iter().map(|blade| as_shaped(blade, shape));
                organs.extend(shaped.map(|blade| petal(index, Origin::Generated, &blade)));
            }
        }
        (flowers, organs, templates)
    }
}

/// A petal as its flower was shaped.
fn as_shaped<'a>(blade: &'a MadePetal, shape: Option<&PetalShape>) -> Cow<'a, MadePetal> {
    match shape {
        None => Cow::Borrowed(blade),
        Some(shape) => Cow::Owned(petal_shapes::shaped(blade, &shape.offsets)),
    }
}

/// The whorls of all flowers that have several, from the petals of all flowers in a row.
fn drawn_whorls<'a>(
    poses: &[Arc<FlowerPose>],
    placed: &'a [PlacedPetal<'a>],
    blades: &'a [MadePetal],
) -> Vec<DrawnWhorl<'a>> {
    let (mut out, mut first) = (Vec::new(), 0);
    for (flower, pose) in poses.iter().enumerate() {
        let own = first..first + pose.whorl_of.len();
        first = own.end;
        let several = if pose.whorls.len() > 1 { pose.whorls.len() } else { 0 };
        for whorl in 0..several {
            let of_whorl = own.clone().zip(&pose.whorl_of).filter(|(_, of)| **of == whorl);
            let petals: Vec<_> = of_whorl.map(|(k, _)| (&placed[k], &blades[k])).collect();
            out.extend(petals.first().map(|(petal, _)| petal.cone).map(|cone| DrawnWhorl {
                flower,
                cone,
                petals,
            }));
        }
    }
    out
}

impl DrawnWhorl<'_> {
    /// Copies of its petals where others are hidden.
    fn hidden(&self) -> Vec<MadePetal> {
        let blades: Vec<_> = self.petals.iter().map(|(_, blade)| blade.resolved()).collect();
        hidden_petals::hidden(&blades, &self.cone)
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

/// What a flower is known by: the first of the strokes of its petals.
fn flower_name<'a>(petals: impl Iterator<Item = &'a FlatBlade>) -> Origin {
    let first = petals.filter_map(|petal| petal.stroke).min();
    let name = |stroke| Origin::Grown(GrownId(Choice::NAME_OF_FLOWER.key(stroke)));
    first.map_or(Origin::Generated, name)
}

fn flower(
    flat: &FlatFlower,
    pose: &FlowerPose,
    center_depth: f32,
    petals: &[FlatBlade],
    world: &WorldFromCanvas,
) -> Flower {
    let apex = world.point(pose.center).with_z(center_depth * world.scale);
    let reach = (pose.reach_px() * world.scale).max(1e-6);
    let bare = Cone { apex, axis: pose.axis, opening_rad: 0.0, height: 0.0 };
    let cone = cone_of(&pose.outermost(), &bare, world);
    let members = flat.petals.iter().map(|&p| &petals[p]);
    let centre = flat.centre_radius.unwrap_or_else(|| petals::root_distance(members.clone(), pose.center))
        * world.scale;
    Flower {
        origin: flower_name(members),
        branch: flat.attachment.map(|place| place.branch),
        cone,
        centre_radius: centre.clamp(CENTRE.0 * reach, CENTRE.1 * reach),
        reach,
        look: 0,
    }
}
