//! Leaves on the young wood of a grown plant.
//!
//! Leaves stand along young internodes as the buds of their species do (phyllotaxis): by the golden angle, to the left and the
//! right, or in crossed pairs, and in a bunch at the end of each shoot. All are copies of a few outlines, so a crown is triangulated a handful of times; each leaf's direction,
//! length and roll are its own, from a random stream named by its node. What is new this year carries leaves that are as
//! far grown as the year. The end of a twig has leaves however long ago it grew, for its buds open every spring.
//!
//! A leaf whose tip or middle would leave a drawn or modelled volume, or that would pass through an obstacle, is shortened, or left out if
//! that does not help. Leaves of wood that holds on to a wall lie before it and face away from it.
//!
//! Limits: a plant has at most as many leaves as its [`Limits`](crate::growth::Limits) say. They are counted before any is made; where there would be more, every
//! so many-th stays, evenly over old and young wood alike, so that the crown grows thinner but nowhere bare.

use super::chains::Chains;
use crate::geom::GOLDEN_RAD;
use crate::growth::habit::Arrangement;
use crate::growth::habit::leaf::{self, LeafHabit, LeafPose};
use crate::growth::simulation::Simulation;
use crate::growth::tree::{NONE, Tree};
use crate::growth::volume::Envelope;
use crate::plant::{
    Blade, BladeForm, Detail, GrownId, Organ, OrganKind, OrganPart, Origin, RestSurface, Role, Shape,
    Template, TemplateId, Templates,
};
use crate::random::{Choice, mix};
use glam::{Quat, Vec3};
use rayon::prelude::*;
use std::f32::consts::{FRAC_PI_2, PI};

/// Widths of the outlines that leaves are copies of, as shares of the species'.
const WIDTHS: [f32; 3] = [0.9, 1.0, 1.12];
/// Nodes at the end of a twig that always have leaves.
const SHORT: u8 = 2;
/// Lengths that a leaf may have where it must stay in a volume, as shares of its own.
const SHORTER: [f32; 3] = [1.0, 0.7, 0.45];
/// Places along a leaf that must stay in the volume: its tip, and its middle, so that none spans a gap.
const HELD_AT: [f32; 2] = [1.0, 0.55];
/// How far leaves of wood that holds on to a surface stand off it, as a share of their way along it.
const OFF_SURFACE: f32 = 0.45;
/// How far these leaves turn their face from the surface's normal to the sky.
const SKYWARD: f32 = 0.25;
/// Nodes that one thread takes at a time.
const NODES: usize = 256;

/// What leaves stand on.
pub struct Wood<'a> {
    /// The plant.
    pub tree: &'a Tree,
    /// Its chains.
    pub chains: &'a Chains,
    /// What the nodes are called, if leaves and buds are to have names.
    pub names: Option<&'a [u64]>,
    /// Places of the nodes.
    pub at: &'a [Vec3],
    /// Diameters below the nodes.
    pub diameters: &'a [f32],
    /// How far what the nodes carry has grown this year, 1 for what is older.
    pub grown: &'a [f32],
    /// The first node that bears anything: those before it are wood that was there before.
    pub first: usize,
    /// Age in years.
    pub age: f32,
    /// Diameter of the thinnest wood.
    pub tip: f32,
    /// How leaves stand around their shoot.
    pub arrangement: Arrangement,
    /// Seed of everything random.
    pub seed: u64,
    /// What grew: leaves must not leave its volume, nor pass what stands beside it.
    pub simulation: &'a Simulation,
}

impl Wood<'_> {
    /// Whether the wood below a node lives; what does not bears nothing.
    pub(super) fn lives(&self, node: usize) -> bool {
        self.tree.lives(node, self.age.ceil() as u16)
    }

    /// What the leaf or bud `k` of a node is known by.
    pub(super) fn origin(&self, of: Choice, (node, k): (usize, u32)) -> Origin {
        let name = |names: &[u64]| Origin::Grown(GrownId(mix(of.key(names[node]), u64::from(k))));
        self.names.map_or(Origin::Generated, name)
    }
}

/// All leaves of a plant at an age, in the order of their nodes, with the templates of which they are copies, not all of
/// which need have any; thinned to `most` where there would be more.
pub fn leaves(most: usize, wood: &Wood<'_>, habit: &LeafHabit) -> (Vec<Organ>, Templates) {
    let pose = habit.at(wood.age);
    if pose.length <= 0.0 || (habit.per_internode == 0 && habit.at_tip == 0) {
        return (Vec::new(), Templates::default());
    }
    let mut templates = Templates::default();
    let outlines = WIDTHS.map(|width| {
        let outline = leaf::outline(habit.shape, (pose.width * width).min(3.0));
        templates.add(Template::new(outline, Vec::new(), 1.0, Detail::Reduced))
    });
    (copies(most, wood, (habit, pose), &outlines), templates)
}

/// The leaves as copies of these templates.
fn copies(
    most: usize,
    wood: &Wood<'_>,
    (habit, pose): (&LeafHabit, LeafPose),
    templates: &[TemplateId],
) -> Vec<Organ> {
    let from_end = from_end(wood);
    let on = |i: usize| leaves_of(wood, (habit, pose), templates, (i, from_end[i]));
    let nodes = || (0..wood.chains.of_node.len()).into_par_iter().with_min_len(NODES);
    let whole = |counts: &[u32]| counts.iter().map(|c| u64::from(*c)).sum::<u64>();
    let places: Vec<u32> = nodes().map(|i| count_of(wood, habit, (i, from_end[i]))).collect();
    if whole(&places) <= most as u64 {
        return nodes().flat_map_iter(on).collect();
    }
    // A volume may leave out so many that the others need not be thinned.
    let counts: Vec<u32> = nodes().map(|i| on(i).count() as u32).collect();
    let whole = whole(&counts);
    if whole <= most as u64 {
        return nodes().flat_map_iter(on).collect();
    }
    let number = |next: &mut u64, count: &u32| {
        *next += u64::from(*count);
        Some(*next - u64::from(*count))
    };
    let before: Vec<u64> = counts.iter().scan(0, number).collect();
    // Of any run of leaves as many stay as its share of the whole, so that exactly `most` do.
    let stays = |nth: u64| nth * most as u64 / whole < (nth + 1) * most as u64 / whole;
    let thinned = |i: usize| (before[i]..).zip(on(i)).filter(|(nth, _)| stays(*nth)).map(|(_, leaf)| leaf);
    nodes().flat_map_iter(thinned).collect()
}

/// Whether so many of these are generated leaves that others had to be left out of a plant that may have `most`.
pub fn is_thinned(organs: &[Organ], most: usize) -> bool {
    let generated = |o: &&Organ| o.kind() == OrganKind::Leaf && !o.origin.is_drawn();
    organs.len() >= most && organs.iter().filter(generated).count() >= most
}

/// Years that the internode below a node has carried leaves, the year that runs counted.
fn years_of(wood: &Wood<'_>, node: usize) -> f32 {
    wood.age - f32::from(wood.tree.nodes.born[node]) + 1.0
}

/// Leaves that stand on the internode below one node, which stands `from_end` nodes from the end of its chain.
fn count_of(wood: &Wood<'_>, habit: &LeafHabit, (i, from_end): (usize, u8)) -> u32 {
    let leafy = years_of(wood, i) <= habit.years || from_end < SHORT;
    let young = leafy && wood.diameters[i] <= wood.tip * habit.thickest;
    let at_tip = if from_end == 0 { habit.at_tip } else { 0 };
    let bears = i >= wood.first && wood.chains.of_node[i] != NONE && wood.lives(i);
    if young && bears { habit.per_internode + at_tip } else { 0 }
}

/// The leaves of the internode below one node, less those for which a volume has no room.
fn leaves_of<'a>(
    wood: &'a Wood<'a>,
    (habit, pose): (&'a LeafHabit, LeafPose),
    templates: &'a [TemplateId],
    (i, from_end): (usize, u8),
) -> impl Iterator<Item = Organ> + 'a {
    let branch = wood.chains.of_node[i];
    let pose = LeafPose { length: pose.length * wood.grown[i].max(0.05), ..pose };
    (0..count_of(wood, habit, (i, from_end))).filter_map(move |k| {
        let shape = Shape::Blade(held(one(wood, (habit, &pose), templates, (i, k)), wood.simulation)?);
        let branch = Some(branch as usize);
        let role = Role::of(OrganPart::Leaf);
        Some(Organ { role, origin: wood.origin(Choice::NAME_OF_LEAF, (i, k)), branch, flower: None, shape })
    })
}

/// How many nodes that live stand between each of them and the end of its chain, up to 255.
fn from_end(wood: &Wood<'_>) -> Vec<u8> {
    let mut out = vec![u8::MAX; wood.chains.of_node.len()];
    for chain in &wood.chains.chains {
        let nodes = &wood.chains.nodes[chain.range.0 as usize + 1..chain.range.1 as usize];
        let living = nodes.iter().rev().filter(|node| wood.lives(**node as usize));
        for (k, &node) in living.enumerate() {
            out[node as usize] = k.min(255) as u8;
        }
    }
    out
}

/// The leaf as long as there is room for it.
fn held(mut blade: Blade, simulation: &Simulation) -> Option<Blade> {
    let share = held_share(blade.base, blade.v, simulation)?;
    (blade.u, blade.v) = (blade.u * share, blade.v * share);
    Some(blade)
}

/// The share of its length for which there is room in a drawn or modelled volume and before obstacles, of what reaches from `base` by `v`.
pub(super) fn held_share(base: Vec3, v: Vec3, simulation: &Simulation) -> Option<f32> {
    let (envelope, obstacles) = (simulation.envelope(), simulation.obstacles());
    // Leaves stand out of what a brush sweeps as they do at the end of any branch: its edge is where wood ends.
    let is_bound = !matches!(envelope, Envelope::Free | Envelope::Crown(_) | Envelope::Swept(_));
    if !is_bound && obstacles.is_none() {
        return Some(1.0);
    }
    let fits = |share: &f32| {
        let inside = |at: &f32| !is_bound || envelope.contains(base + v * (share * at));
        let is_free = || obstacles.is_none_or(|obstacles| !obstacles.crosses(base, base + v * *share));
        HELD_AT.iter().all(inside) && is_free()
    };
    SHORTER.into_iter().find(fits)
}

/// Where the leaf `k` of an internode stands that has so many: its turn about the shoot from the bud's side, radians, and
/// its place, in internodes.
fn stand(arrangement: Arrangement, per_internode: u32, k: u32) -> (f32, f32) {
    let single = (k as f32 + 0.6) / per_internode.max(1) as f32;
    match arrangement {
        Arrangement::Spiral | Arrangement::Whorl => (GOLDEN_RAD * (k + 1) as f32, single),
        Arrangement::Alternate => (PI * (k + 1) as f32, single),
        Arrangement::Opposite => {
            let (pair, pairs) = (k / 2, per_internode.div_ceil(2).max(1));
            (FRAC_PI_2 * pair as f32 + PI * (k % 2) as f32, (pair as f32 + 0.6) / pairs as f32)
        }
    }
}

/// The leaf `k` of the internode below node `i`; those beyond the internode's own stand at its end.
fn one(
    wood: &Wood<'_>,
    (habit, pose): (&LeafHabit, &LeafPose),
    templates: &[TemplateId],
    (i, k): (usize, u32),
) -> Blade {
    let (from, to) = (wood.chains.below(i, wood.tree, wood.at), wood.at[i]);
    let way = (to - from).try_normalize().unwrap_or(Vec3::Y);
    let key = mix(mix(Choice::LEAF.key(wood.seed), i as u64), u64::from(k));
    let at_tip = k >= habit.per_internode;
    let (turn, along) = stand(wood.arrangement, habit.per_internode, k);
    let along = if at_tip { 1.0 } else { along };
    let side = wood.tree.nodes.side[i].reject_from_normalized(way).normalize_or(way.any_orthonormal_vector());
    let around = Quat::from_axis_angle(way, turn + 0.4 * Choice::LEAF_AROUND.signed(key)) * side;
    let open = if at_tip { 0.7 } else { 1.0 };
    let (sin, cos) = (pose.angle_rad * open).sin_cos();
    let scatter = Vec3::from_array(Choice::LEAF_DIRECTION.signs(key)) * pose.scatter;
    let free = way * cos + around * sin - Vec3::Y * pose.droop + scatter;
    let base = from.lerp(to, along) + around * (0.4 * wood.diameters[i]);
    // The face between square to the shoot and up to the sky; of wood that holds on to a surface away from it.
    let held = wood.simulation.held_at(base).map(|contact| contact.away);
    let free = held.map_or(free, |away| free.reject_from_normalized(away) + away * OFF_SURFACE);
    let axis = free.try_normalize().unwrap_or(around);
    let face = held.unwrap_or(way).lerp(Vec3::Y, if held.is_some() { SKYWARD } else { pose.face_up })
        + Vec3::from_array(Choice::LEAF_FACE.signs(key)) * (0.5 * pose.scatter);
    let across = axis.cross(face).try_normalize().unwrap_or_else(|| axis.any_orthonormal_vector());
    let length = pose.length * (1.0 + pose.vary * Choice::LEAF_LENGTH.signed(key));
    let template = (Choice::LEAF_OUTLINE.unit(key) * templates.len() as f32) as usize % templates.len();
    Blade {
        template: templates[template],
        base,
        u: across * length,
        v: axis * length,
        rest: RestSurface::Plane,
        form: BladeForm::default(),
    }
}

#[cfg(test)]
#[path = "foliage_tests.rs"]
mod tests;
