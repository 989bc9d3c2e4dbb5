//! The whole depth stage: anatomy in, plant out.

use super::{
    branch_depth::{self, BranchDepthParams, Spreads},
    cone_pose::{ConeParams, FlowerPose},
    crowns,
    flower_stem::{self, Goal, StemParams},
    flowers::Flowers,
    fruits,
    learned::LearnedParams,
    leaves::{LeafParams, LeafPoser, Leaves},
    outline::CurlParams,
    pots,
    radii::{self, RadiusParams, Tapers},
};
use crate::anatomy::{Anatomy, Attachment, FlatBlade, FlatBranch, FlatFlower};
use crate::geom::polyline;
use crate::learned_depth::DepthField;
use crate::plant::{
    Branch, Organ, OrganPart, Origin, Plant, Provenance, Role, Shape, WoodPart, WorldFromCanvas,
};
use crate::sketch::PetalShape;
use glam::{Vec2, Vec3};
use rayon::prelude::*;
use std::sync::Arc;

crate::parameter_groups! {
    /// Everything that decides how a flat drawing stands in space.
    pub struct DepthParams {
        /// Size of the plant.
        world: WorldParams;
        /// Pose of flowers.
        cone: ConeParams;
        /// Stems near flowers.
        stem: StemParams;
        /// Spread of branches.
        branches: BranchDepthParams;
        /// Thickness of branches.
        radii: RadiusParams;
        /// Pose of leaves.
        leaves: LeafParams;
        /// Curl of blades by pressure.
        curl: CurlParams;
        /// Depth that a network learned.
        learned: LearnedParams;
    }
}

crate::parameters! {
    /// Size of the plant.
    pub struct WorldParams {
        /// What the height of the drawing is in the world.
        height: f32 = 0.3, 0.001..=200.0, "metres";
        /// Bare trunk below a crown for which no branch was drawn.
        trunk: f32 = 0.2, 0.0..=3.0, "of the crown's height";
    }
}

/// What a drawing says besides its anatomy.
#[derive(Clone, Copy, Debug, Default)]
pub struct Given<'a> {
    /// Decides everything random.
    pub seed: u64,
    /// Petals that the artist shaped.
    pub petal_shapes: &'a [PetalShape],
    /// The depth that a network gives the drawing.
    pub field: Option<&'a DepthField>,
}

/// Branches or leaves that one thread places at a time.
const BATCH: usize = 128;

/// Gap between a leaf and its branch, as a share of the leaf's length, from which a petiole bridges it.
const PETIOLE_GAP: f32 = 0.06;

/// Thickness of a petiole as a share of its branch's at that place.
const PETIOLE_SHARE: f32 = 0.5;

/// What is kept of a drawing's depth for the next drawing.
#[derive(Debug, Default)]
pub struct Cache {
    /// Everything in here was made with these.
    params: DepthParams,
    is_for_one_build: bool,
    branches: Spreads,
    radii: Tapers,
    flowers: Flowers,
    leaves: Leaves,
}

impl Cache {
    /// For a single drawing, of which nothing is kept.
    pub fn for_one_build() -> Self {
        Self {
            params: DepthParams::default(),
            is_for_one_build: true,
            branches: Spreads::for_one_build(),
            radii: Tapers::for_one_build(),
            flowers: Flowers::for_one_build(),
            leaves: Leaves::for_one_build(),
        }
    }

    /// Begins a drawing with these parameters; what was made with others is of no use.
    fn begin(&mut self, params: &DepthParams) {
        if self.params != *params {
            let empty = if self.is_for_one_build { Self::for_one_build() } else { Self::default() };
            *self = Self { params: params.clone(), ..empty };
        }
    }
}

/// Lifts an anatomy into space, and keeps what only the drawing knows beside the plant. Forms are plain, for they are the
/// species', and petals stand as they were drawn.
pub fn recover(anatomy: &Anatomy, seed: u64, params: &DepthParams) -> (Plant, Provenance) {
    recover_with(&mut Cache::for_one_build(), anatomy, Given { seed, ..Given::default() }, params)
}

/// The very plant that [`recover`] gives, its petals shaped and its branches as far from the drawing's plane as a network tells, again and
/// again while a drawing changes.
pub fn recover_with(
    cache: &mut Cache,
    anatomy: &Anatomy,
    Given { seed, petal_shapes, field }: Given<'_>,
    params: &DepthParams,
) -> (Plant, Provenance) {
    cache.begin(params);
    let mut skeleton = Skeleton::new(&mut cache.branches, anatomy, (field, seed), params);
    let poses = cache.flowers.poses(anatomy, &params.cone);
    let centers = skeleton.lead_stems(anatomy, &poses, &params.stem);

    let world = world_from_canvas(anatomy, &params.world);
    let mut provenance = Provenance::new(world);
    let radii = radii::radii_with(&mut cache.radii, &skeleton.branches, anatomy.diagonal, &params.radii);
    let branches = skeleton.lifted(radii, &mut provenance);
    let (flowers, organs, templates) = cache.flowers.stand(
        anatomy,
        (&poses, &centers),
        (&params.curl, params.cone.fill_hidden, petal_shapes),
        &mut provenance,
    );
    let mut plant = Plant { branches, flowers, organs, templates };
    let poser = LeafPoser { world, seed, params: &params.leaves, curl: &params.curl };
    add_leaves((&mut plant, &mut provenance), &skeleton, anatomy, (&mut cache.leaves, &poser));
    pots::add(&mut plant, &mut provenance, anatomy);
    fruits::add(&mut plant, &mut provenance, anatomy);
    provenance.rename(|stroke| anatomy.drawn(stroke));
    debug_assert_eq!(provenance.check_invariants(&plant), Ok(()));
    (plant, provenance)
}

/// The scale that makes the drawing as high as the plant, the origin below its lowest root, as low as any wood that was
/// drawn: nothing stands below the ground. A drawn pot stands on it.
fn world_from_canvas(anatomy: &Anatomy, params: &WorldParams) -> WorldFromCanvas {
    let (low, high) = anatomy.bounds;
    // A drawing without height (one level stroke) is sized by its width.
    let extent = if high.y - low.y > 0.05 * anatomy.diagonal { high.y - low.y } else { anatomy.diagonal };
    let trunks = anatomy.branches.iter().filter(|b| b.parent.is_none()).filter_map(|b| b.line.first());
    let wood = anatomy.branches.iter().filter(|b| b.stroke.is_some()).flat_map(|b| b.line.iter());
    let ground = wood.map(|s| s.position.y).fold(f32::NEG_INFINITY, f32::max);
    // Of equally low ones the first, so that one more beside it leaves the world as it is.
    let lowest = |a: &Vec2, b: &Vec2| b.y.total_cmp(&a.y);
    let pot = pots::foot(anatomy);
    let origin = trunks
        .map(|s| s.position)
        .min_by(lowest)
        .map(|root| root.with_y(root.y.max(ground)))
        .or_else(|| crowns::foot(anatomy, params.trunk))
        .or_else(|| anatomy.flowers.iter().map(|f| f.center).min_by(lowest))
        .or_else(|| anatomy.leaves.iter().map(|l| l.root).min_by(lowest))
        .unwrap_or(low.midpoint(high));
    let origin = pot.map_or_else(
        || origin.with_y(below_leaves(anatomy, origin.y, extent)),
        |pot| pot.with_y(pot.y.max(origin.y)),
    );
    WorldFromCanvas { scale: params.height / extent.max(f32::MIN_POSITIVE), origin }
}

/// How far in front of the drawing flowers in a crown are, in depths of the crown: its leaves stand out from it.
const BEFORE_LEAVES: f32 = 1.08;

/// How far drawn leaves may reach below the lowest root of what stands on the ground, as a share of the drawing's height.
const DROOP: f32 = 0.15;

/// The ground below a root: as low as drawn leaves where these reach far below it. A leaf that was picked, or a twig that hangs, does
/// not stand on its foot. So with a leaf alone, however little it reaches.
fn below_leaves(anatomy: &Anatomy, root: f32, extent: f32) -> f32 {
    if !anatomy.flowers.is_empty() || !anatomy.crowns.is_empty() {
        return root;
    }
    let drawn = || anatomy.leaves.iter().filter(|leaf| leaf.stroke.is_some());
    let lowest =
        drawn().flat_map(|leaf| leaf.outline.iter()).map(|s| s.position.y).fold(f32::NEG_INFINITY, f32::max);
    let droop = if drawn().count() == 1 { 0.0 } else { DROOP * extent };
    if lowest > root + droop { lowest } else { root }
}

/// Branches with arc length and depth of their samples, pixels; depth grows toward the viewer.
struct Skeleton {
    branches: Vec<FlatBranch>,
    arcs: Vec<Vec<f32>>,
    depths: Vec<Vec<f32>>,
}

impl Skeleton {
    fn new(
        known: &mut Spreads,
        anatomy: &Anatomy,
        (field, seed): (Option<&DepthField>, u64),
        params: &DepthParams,
    ) -> Self {
        let learned = (field, params.learned.branches);
        let depths =
            branch_depth::branch_depths_with(known, &anatomy.branches, learned, &params.branches, seed);
        let arcs = anatomy.branches.par_iter().with_min_len(BATCH).map(arcs_of).collect();
        Self { branches: anatomy.branches.clone(), arcs, depths }
    }

    /// Leads every stem that ends in a flower to it; gives the depth of each flower's centre. One in a crown without a stem of its own is
    /// at the front of that: nobody draws those behind.
    fn lead_stems(&mut self, anatomy: &Anatomy, poses: &[Arc<FlowerPose>], params: &StemParams) -> Vec<f32> {
        let mut last_child = vec![0.0f32; self.branches.len()];
        let leaves = anatomy.leaves.iter().filter_map(|leaf| leaf.attachment);
        let flowers = anatomy.flowers.iter().filter_map(|flower| flower.attachment);
        let flowers = flowers.filter(|place| !self.is_end(*place));
        let twigs =
            self.branches.iter().filter_map(|b| Some(Attachment { branch: b.parent?, at: b.attached_at }));
        for place in leaves.chain(flowers).chain(twigs) {
            last_child[place.branch] = last_child[place.branch].max(place.at);
        }
        let mut led = vec![false; self.branches.len()];
        let lead = |(flower, pose): (&FlatFlower, &Arc<FlowerPose>)| {
            let has_stem = flower.attachment.is_some_and(|place| {
                let end = self.branches[place.branch].line.last();
                let ends_in_it =
                    end.is_some_and(|end| end.position.distance(flower.center) < pose.reach_px());
                ends_in_it && self.is_end(place)
            });
            if !has_stem && let Some(front) = crowns::front(anatomy, flower.center) {
                return BEFORE_LEAVES * front;
            }
            let Some(place) = flower.attachment else { return 0.0 };
            let i = place.branch;
            if !self.is_end(place) || led[i] {
                return self.depth(place);
            }
            led[i] = true;
            let last_child_at = last_child[i];
            let goal = Goal { center: pose.center, axis: pose.axis, reach: pose.reach_px(), last_child_at };
            let depth =
                flower_stem::lead_to_flower(&mut self.branches[i], &mut self.depths[i], &goal, params);
            self.arcs[i] = arcs_of(&self.branches[i]);
            depth
        };
        anatomy.flowers.iter().zip(poses).map(lead).collect()
    }

    /// Whether a place is the end of its branch, as drawn.
    fn is_end(&self, place: Attachment) -> bool {
        self.arcs[place.branch].last().is_none_or(|&length| place.at >= length)
    }

    /// Depth at a place on a branch, pixels.
    fn depth(&self, place: Attachment) -> f32 {
        radii::at(&self.arcs[place.branch], &self.depths[place.branch], place.at)
    }

    /// World point at a place on a branch.
    fn point(&self, place: Attachment, world: &WorldFromCanvas) -> Vec3 {
        let line = &self.branches[place.branch].line;
        let (i, share) = polyline::locate(&self.arcs[place.branch], place.at);
        let next = line.get(i + 1).unwrap_or(&line[i]);
        world.point(line[i].position.lerp(next.position, share)).with_z(self.depth(place) * world.scale)
    }

    /// The branches in the world, each with its radii in pixels.
    fn lifted(&self, radii: Vec<Vec<f32>>, provenance: &mut Provenance) -> Vec<Branch> {
        let world = provenance.world_from_canvas;
        let lifted = |(i, (flat, radii)): (usize, (&FlatBranch, Vec<f32>))| {
            let point =
                |(s, &z): (&crate::anatomy::Sample, &f32)| world.point(s.position).with_z(z * world.scale);
            let points = flat.line.iter().zip(&self.depths[i]).map(point);
            let (points, radii) =
                without_repeats(points.zip(radii.into_iter().map(|r| r * world.scale)), flat.line.len());
            let (origin, role) = (provenance.record(flat.stroke), Role::of(WoodPart::Stem));
            Branch { origin, parent: flat.parent, level: flat.level, points, radii, role }
        };
        self.branches.iter().zip(radii).enumerate().map(lifted).collect()
    }
}

fn arcs_of(branch: &FlatBranch) -> Vec<f32> {
    polyline::arc_lengths(branch.line.iter().map(|s| s.position))
}

/// Drops points that coincide with the one before; there are at most so many.
fn without_repeats(samples: impl Iterator<Item = (Vec3, f32)>, most: usize) -> (Vec<Vec3>, Vec<f32>) {
    let (mut points, mut radii) = (Vec::with_capacity(most), Vec::with_capacity(most));
    for (point, radius) in samples {
        if points.last() != Some(&point) {
            points.push(point);
            radii.push(radius);
        }
    }
    (points, radii)
}

/// Adds leaves, with petioles where the hand left a gap to the branch.
fn add_leaves(
    (plant, provenance): (&mut Plant, &mut Provenance),
    skeleton: &Skeleton,
    anatomy: &Anatomy,
    (known, poser): (&mut Leaves, &LeafPoser<'_>),
) {
    let foot = |leaf: &FlatBlade| match leaf.attachment {
        Some(place) => skeleton.point(place, &poser.world),
        None => poser.world.point(leaf.root),
    };
    let placed: Vec<(&FlatBlade, Vec3)> =
        anatomy.leaves.par_iter().with_min_len(BATCH).map(|leaf| (leaf, foot(leaf))).collect();
    let blades = known.pose(&placed, &anatomy.templates, poser, &mut plant.templates);
    for ((leaf, foot), blade) in placed.into_iter().zip(blades) {
        let parent = match leaf.attachment.map(|place| place.branch) {
            Some(branch)
                if foot.distance(blade.base) > PETIOLE_GAP * plant.templates[blade.template].length() =>
            {
                add_petiole(plant, branch, foot, blade.base)
            }
            parent => parent,
        };
        plant.organs.push(Organ {
            role: Role::of(OrganPart::Leaf),
            origin: provenance.record(leaf.stroke),
            branch: parent,
            flower: None,
            shape: Shape::Blade(blade),
        });
    }
}

/// A short generated branch from a place on `branch` to a leaf's base.
fn add_petiole(plant: &mut Plant, branch: usize, foot: Vec3, base: Vec3) -> Option<usize> {
    let parent = &plant.branches[branch];
    let nearest = parent
        .points
        .iter()
        .zip(&parent.radii)
        .min_by(|a, b| a.0.distance_squared(foot).total_cmp(&b.0.distance_squared(foot)));
    let radius = PETIOLE_SHARE * nearest.map_or(0.0, |(_, r)| *r);
    let petiole = Branch {
        origin: Origin::Generated,
        parent: Some(branch),
        level: parent.level + 1,
        points: vec![foot, foot.midpoint(base), base],
        radii: vec![radius, 0.8 * radius, 0.7 * radius],
        role: parent.role,
    };
    plant.branches.push(petiole);
    Some(plant.branches.len() - 1)
}
