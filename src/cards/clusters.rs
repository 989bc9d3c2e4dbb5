//! Which leaves, flowers and thin twigs become one card.
//!
//! A branch with all that grows on it goes into cards where it reaches no farther than a card is large and nobody drew any of it; its
//! wood goes, too. Branches that are longer stay. What stands on one of these, leaves and short side branches, is taken in its
//! order along the branch and cut into runs of that length.

use crate::geom::polyline;
use crate::plant::{Organ, OrganClass, OrganKind, Plant, Shape};
use glam::{Vec2, Vec3};

/// A side branch that reaches so far, as a share of a card's size, is a cluster by itself.
const OF_ITS_OWN: f32 = 0.5;

/// What one or two cards show.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cluster {
    /// The branch that carries it and stays.
    pub(super) on: Option<usize>,
    /// Where it grows from, metres.
    pub(super) foot: Vec3,
    /// Unit direction of the wood there.
    pub(super) along: Vec3,
    /// Its organs, by their places in the plant.
    pub(super) organs: Vec<usize>,
    /// Its twigs.
    pub(super) branches: Vec<usize>,
}

/// The clusters of a plant that reach about `size` metres, in the order of the branches that carry them.
pub(super) fn clusters(plant: &Plant, size: f32) -> Vec<Cluster> {
    let tree = Tree::new(plant);
    let goes = tree.goes(size);
    let mut found = Vec::new();
    for (branch, _) in plant.branches.iter().enumerate().filter(|(branch, _)| !goes[*branch]) {
        tree.runs(branch, &goes, size, &mut found);
    }
    found
}

/// What grows on what, and how far it reaches.
struct Tree<'a> {
    plant: &'a Plant,
    /// For each branch the organs that may be part of cards.
    foliage: Vec<Vec<usize>>,
    children: Vec<Vec<usize>>,
    /// Farthest point of a branch with all that grows on it from its base, metres.
    reach: Vec<f32>,
    /// Whether a branch and all that grows on it may be part of a card.
    is_free: Vec<bool>,
    /// Whether leaves or flowers grow on it or on its side branches.
    is_leafy: Vec<bool>,
}

impl<'a> Tree<'a> {
    fn new(plant: &'a Plant) -> Self {
        let count = plant.branches.len();
        let mut tree = Self {
            plant,
            foliage: vec![Vec::new(); count],
            children: vec![Vec::new(); count],
            reach: vec![0.0; count],
            is_free: plant.branches.iter().map(|branch| !branch.origin.is_drawn()).collect(),
            is_leafy: vec![false; count],
        };
        tree.sort_organs();
        for (index, branch) in plant.branches.iter().enumerate().rev() {
            let foot = branch.points[0];
            let own = branch.points.iter().map(|point| point.distance(foot));
            let farthest = own.fold(tree.reach[index], f32::max);
            tree.reach[index] = farthest;
            tree.is_leafy[index] |= !tree.foliage[index].is_empty();
            let Some(parent) = branch.parent else { continue };
            tree.children[parent].push(index);
            let from_parent = foot.distance(plant.branches[parent].points[0]) + farthest;
            tree.reach[parent] = tree.reach[parent].max(from_parent);
            tree.is_leafy[parent] |= tree.is_leafy[index];
            tree.is_free[parent] &= tree.is_free[index];
        }
        tree
    }

    /// Puts organs to their branches, and tells which branches have to stay because of them.
    fn sort_organs(&mut self) {
        let mut is_drawn = vec![false; self.plant.flowers.len()];
        for organ in &self.plant.organs {
            if let (Some(flower), true) = (organ.flower, organ.origin.is_drawn()) {
                is_drawn[flower] = true;
            }
        }
        for (index, organ) in self.plant.organs.iter().enumerate() {
            let Some(branch) = organ.branch else { continue };
            let is_drawn = organ.origin.is_drawn() || organ.flower.is_some_and(|flower| is_drawn[flower]);
            if is_drawn || organ.kind() == OrganKind::Pot {
                self.is_free[branch] = false;
                continue;
            }
            if is_foliage(organ) {
                self.foliage[branch].push(index);
            }
            let foot = self.plant.branches[branch].points[0];
            let far = extremes(self.plant, organ).map(|point| point.distance(foot)).fold(0.0, f32::max);
            self.reach[branch] = self.reach[branch].max(far);
        }
    }

    /// For each branch whether it becomes part of cards.
    fn goes(&self, size: f32) -> Vec<bool> {
        let may = |index: usize| {
            let branch = &self.plant.branches[index];
            let is_side = branch.parent.is_some() && !branch.is_basal_stem();
            is_side && self.is_free[index] && self.is_leafy[index] && self.reach[index] <= size
        };
        let mut goes: Vec<bool> = (0..self.plant.branches.len()).map(may).collect();
        // What grows on a branch that goes has to go with it; parents stand before their children.
        for (index, branch) in self.plant.branches.iter().enumerate() {
            if branch.parent.is_some_and(|parent| goes[parent]) {
                goes[index] = true;
            }
        }
        goes
    }

    /// Adds the clusters on a branch that stays.
    fn runs(&self, on: usize, goes: &[bool], size: f32, found: &mut Vec<Cluster>) {
        let points = &self.plant.branches[on].points;
        let arcs = polyline::arc_lengths(points.iter().copied());
        let along = |at: Vec3| polyline::nearest(points, at).map_or(0.0, |(_, arc)| arc);
        let place = |arc: f32| polyline::interpolate(points, polyline::locate(&arcs, arc));
        let direction = |arc: f32| {
            let (segment, _) = polyline::locate(&arcs, arc);
            (points[segment + 1] - points[segment]).normalize_or(Vec3::Y)
        };
        let mut items: Vec<(f32, Item)> = self.foliage[on]
            .iter()
            .map(|&organ| (along(self.plant.organs[organ].base()), Item::Organ(organ)))
            .collect();
        for &child in self.children[on].iter().rev().filter(|child| goes[**child]) {
            let line = &self.plant.branches[child].points;
            let foot = line[0];
            if self.reach[child] > OF_ITS_OWN * size {
                let along = (line[line.len() - 1] - foot).normalize_or(Vec3::Y);
                found.push(self.cluster(on, (foot, along), &[(0.0, Item::Branch(child))]));
            } else {
                items.push((along(foot), Item::Branch(child)));
            }
        }
        items.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        let mut rest = items.as_slice();
        while let Some((first, _)) = rest.first() {
            let end = rest.partition_point(|(arc, _)| *arc <= first + size);
            found.push(self.cluster(on, (place(*first), direction(*first)), &rest[..end]));
            rest = &rest[end..];
        }
    }

    fn cluster(&self, on: usize, (foot, along): (Vec3, Vec3), items: &[(f32, Item)]) -> Cluster {
        let mut cluster = Cluster { on: Some(on), foot, along, organs: Vec::new(), branches: Vec::new() };
        for (_, item) in items {
            match item {
                Item::Organ(organ) => cluster.organs.push(*organ),
                Item::Branch(branch) => cluster.branches.push(*branch),
            }
        }
        let mut next = 0;
        while let Some(&branch) = cluster.branches.get(next) {
            cluster.organs.extend(&self.foliage[branch]);
            cluster.branches.extend(&self.children[branch]);
            next += 1;
        }
        cluster.organs.sort_unstable();
        cluster.branches.sort_unstable();
        cluster
    }
}

/// What stands on a branch.
#[derive(Clone, Copy)]
enum Item {
    Organ(usize),
    Branch(usize),
}

/// Whether an organ is shown on cards.
fn is_foliage(organ: &Organ) -> bool {
    matches!(organ.kind().class(), OrganClass::Foliage | OrganClass::Flower)
        || organ.kind() == OrganKind::Fruit
}

/// Points of an organ that bound it about.
pub(super) fn extremes(plant: &Plant, organ: &Organ) -> impl Iterator<Item = Vec3> + use<> {
    let points: Vec<Vec3> = match &organ.shape {
        Shape::Blade(blade) => {
            let template = &plant.templates[blade.template];
            let (low, high) = polyline::bounds(template.outline().iter().copied());
            let middle = 0.5 * (low + high);
            let places = [
                Vec2::new(0.0, low.y),
                Vec2::new(low.x, middle.y),
                Vec2::new(high.x, middle.y),
                Vec2::new(0.0, high.y),
            ];
            let blade = plant.templates.resolve(blade);
            places.iter().map(|place| blade.at_rest(*place)).collect()
        }
        Shape::Dome { base, axis, radius, height } => {
            let side = axis.any_orthonormal_vector() * *radius;
            vec![*base - side, *base + side, *base + *axis * *height]
        }
        Shape::Filament { points, .. } => points.to_vec(),
        Shape::Lathe { base, axis, profile } => {
            let (_, high) = polyline::bounds(profile.iter().copied());
            vec![*base, *base + *axis * high.y]
        }
        Shape::Card { base, u, v, .. } => vec![*base - 0.5 * *u, *base + 0.5 * *u, *base + *v],
        Shape::Spike { base, tip, .. } => vec![*base, *tip],
    };
    points.into_iter()
}
