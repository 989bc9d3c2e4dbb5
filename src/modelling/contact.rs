//! What wood that is turned about its base meets: how far it may turn until it touches other wood, and how it slides along that.
//!
//! Internodes are capsules. Those that rest stand in an R-tree, made once when the wood is taken hold of; those that turn are tested branch by
//! branch: a branch whose ball meets no box of the tree is free. Wood within [`JOINT`] radii of the base on either side, and pairs that touch from
//! the beginning, do not count. Along the way to a turn the first that touches is found in steps no larger than the wood is thick, at most
//! [`STEPS`], and then halved [`HALVINGS`] times. To slide, what is left of the turn loses its part into the wood that is touched, and goes on, three
//! times at most.
//!
//! Source: 001 §4.3 asks that wood does not pass through other wood, by one convex hull for each of both parts, which overlap nearly
//! always. Limits: what is bent, moved along its branch or grafted passes through wood, and so do leaves. A wide step past thin
//! twigs may jump over them.

use crate::geom::capsule::Capsule;
use crate::geom::polyline;
use crate::plant::Branch;
use glam::{Quat, Vec3};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};
use std::collections::HashSet;

/// Radii around the base within which wood does not count.
const JOINT: f32 = 4.0;
/// Most steps in which a way is looked at, and how often the last of them is halved.
const STEPS: usize = 12;
const HALVINGS: usize = 10;
/// Most contacts along which wood slides with one move of the pointer.
const CONTACTS: usize = 3;

/// What becomes of wood that is turned where it meets other wood.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OnContact {
    /// It passes through.
    #[default]
    Pass,
    /// It stops.
    Stop,
    /// It slides along.
    Slide,
}

/// A box with the number of the capsule in it.
type Boxed = GeomWithData<Rectangle<[f32; 3]>, usize>;

/// Wood that is turned, and the wood around it.
#[derive(Debug)]
pub struct Surroundings {
    base: Vec3,
    moved: Vec<MovedBranch>,
    resting: Vec<Capsule>,
    tree: RTree<Boxed>,
    /// Pairs that touch before anything is turned: the moved capsule's number and the resting one's.
    touching: HashSet<(usize, usize)>,
    /// Distance of the farthest moved place from the base, and the mean radius of moved wood.
    reach: f32,
    thickness: f32,
}

/// A branch that is turned, with a ball around it.
#[derive(Debug)]
struct MovedBranch {
    middle: Vec3,
    radius: f32,
    /// Number of its first capsule among all that are moved.
    first: usize,
    capsules: Vec<Capsule>,
}

/// Where moved wood touches resting wood.
#[derive(Clone, Copy, Debug)]
struct Contact {
    place: Vec3,
    /// From the resting wood to the moved one, of unit length.
    normal: Vec3,
}

impl Surroundings {
    /// The wood of a plant around one of its branches, which is turned with all that grows on it.
    pub fn of(branches: &[Branch], held: usize) -> Option<Self> {
        let base = *branches.get(held)?.points.first()?;
        let carries = |branch: usize| {
            let mut down = std::iter::successors(Some(branch), |branch| branches[*branch].parent);
            down.any(|branch| branch == held)
        };
        let parent = branches[held].parent.map(|parent| &branches[parent]);
        let joint = JOINT * radius_at_base(&branches[held], parent, base);
        let counts = |capsule: &Capsule| {
            polyline::nearest(&[capsule.from, capsule.to], base).is_some_and(|it| it.0 > joint)
        };
        let (mut moved, mut resting, mut first) = (Vec::new(), Vec::new(), 0);
        for (number, branch) in branches.iter().enumerate() {
            let capsules: Vec<Capsule> = capsules(branch).filter(counts).collect();
            if !carries(number) {
                resting.extend(capsules);
            } else if let Some(branch) = MovedBranch::new(first, capsules) {
                first += branch.capsules.len();
                moved.push(branch);
            }
        }
        let boxed = |(number, capsule): (usize, &Capsule)| Boxed::new(rectangle(capsule), number);
        let tree = RTree::bulk_load(resting.iter().enumerate().map(boxed).collect());
        let all = || moved.iter().flat_map(|branch| &branch.capsules);
        let reach = all().map(|it| it.to.distance(base)).fold(0.0, f32::max);
        let thickness = all().map(|it| it.radius).sum::<f32>() / first.max(1) as f32;
        let mut it = Self { base, moved, resting, tree, touching: HashSet::new(), reach, thickness };
        it.touching = it.pairs(Quat::IDENTITY).map(|pair| (pair.0, pair.1)).collect();
        Some(it)
    }

    /// The turn, from where the wood was taken hold of, that it comes to on its way from one turn, at which it is free, to another.
    pub fn turn(&self, from: Quat, to: Quat, on_contact: OnContact) -> Quat {
        match on_contact {
            OnContact::Pass => to,
            OnContact::Stop => self.first_contact(from, to).map_or(to, |(free, _)| free),
            OnContact::Slide => self.slide(from, to),
        }
    }

    /// Whether the wood touches nothing new at a turn.
    #[cfg(test)]
    pub(crate) fn is_free(&self, turn: Quat) -> bool {
        self.contact(turn).is_none()
    }

    fn slide(&self, from: Quat, to: Quat) -> Quat {
        let (mut at, mut target) = (from, to);
        for _ in 0..CONTACTS {
            let Some((free, contact)) = self.first_contact(at, target) else { return target };
            at = free;
            let rest = (target * at.inverse()).to_scaled_axis();
            // Turned about an axis, the place that touches moves along its cross product with the lever.
            let into = (contact.place - self.base).cross(contact.normal);
            let along = rest.dot(into) / into.length_squared().max(f32::MIN_POSITIVE);
            target = Quat::from_scaled_axis(rest - along.min(0.0) * into) * at;
        }
        self.first_contact(at, target).map_or(target, |(free, _)| free)
    }

    /// The last free turn on the way to another, and what is touched right after; nothing where all of the way is free.
    fn first_contact(&self, from: Quat, to: Quat) -> Option<(Quat, Contact)> {
        let way = self.reach * from.angle_between(to);
        let steps = ((way / (2.0 * self.thickness).max(f32::MIN_POSITIVE)) as usize).clamp(1, STEPS);
        let share = |k: usize| k as f32 / steps as f32;
        let contact = |share: f32| self.contact(from.slerp(to, share));
        let (hit, mut found) = (1..=steps).find_map(|k| Some((k, contact(share(k))?)))?;
        let (mut free, mut blocked) = (share(hit - 1), share(hit));
        for _ in 0..HALVINGS {
            let middle = 0.5 * (free + blocked);
            match contact(middle) {
                Some(contact) => (blocked, found) = (middle, contact),
                None => free = middle,
            }
        }
        Some((from.slerp(to, free), found))
    }

    fn contact(&self, turn: Quat) -> Option<Contact> {
        let is_new = |pair: &(usize, usize, Capsule)| !self.touching.contains(&(pair.0, pair.1));
        let (_, resting, moved) = self.pairs(turn).find(is_new)?;
        let (own, other) = moved.nearest(&self.resting[resting]);
        let normal = (own - other).try_normalize().unwrap_or(Vec3::Y);
        Some(Contact { place: own, normal })
    }

    /// Numbers of the moved and the resting capsule of each pair that touches at a turn, and the moved one as it is turned.
    fn pairs(&self, turn: Quat) -> impl Iterator<Item = (usize, usize, Capsule)> {
        let turned = move |place: Vec3| self.base + turn * (place - self.base);
        let is_near = move |branch: &&MovedBranch| {
            let (middle, reach) = (turned(branch.middle), Vec3::splat(branch.radius));
            self.within(middle - reach, middle + reach).next().is_some()
        };
        let of_capsule = move |(number, capsule): (usize, Capsule)| {
            let capsule = Capsule { from: turned(capsule.from), to: turned(capsule.to), ..capsule };
            let (low, high) = capsule.bounds(1.0);
            let touched =
                self.within(low, high).filter(move |resting| capsule.overlaps(&self.resting[*resting], 1.0));
            touched.map(move |resting| (number, resting, capsule))
        };
        let near = self.moved.iter().filter(is_near);
        near.flat_map(|branch| (branch.first..).zip(branch.capsules.iter().copied())).flat_map(of_capsule)
    }

    /// Numbers of the resting capsules whose boxes meet a box.
    fn within(&self, low: Vec3, high: Vec3) -> impl Iterator<Item = usize> {
        let all = AABB::from_corners(low.to_array(), high.to_array());
        self.tree.locate_in_envelope_intersecting(all).map(|boxed| boxed.data)
    }
}

impl MovedBranch {
    fn new(first: usize, capsules: Vec<Capsule>) -> Option<Self> {
        let bounds = capsules.iter().map(|it| it.bounds(1.0));
        let (low, high) = bounds.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))?;
        Some(Self { middle: low.midpoint(high), radius: 0.5 * low.distance(high), first, capsules })
    }
}

fn rectangle(capsule: &Capsule) -> Rectangle<[f32; 3]> {
    let (low, high) = capsule.bounds(1.0);
    Rectangle::from_corners(low.to_array(), high.to_array())
}

fn capsules(branch: &Branch) -> impl Iterator<Item = Capsule> {
    let radii = branch.radii.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    branch.points.windows(2).zip(radii).map(|(pair, radius)| Capsule { from: pair[0], to: pair[1], radius })
}

/// Radius of the thicker of a branch and what carries it, at the branch's base.
fn radius_at_base(branch: &Branch, parent: Option<&Branch>, base: Vec3) -> f32 {
    let away = |point: &Vec3| point.distance_squared(base);
    let there = |parent: &Branch| {
        let all = parent.points.iter().zip(&parent.radii);
        all.min_by(|a, b| away(a.0).total_cmp(&away(b.0))).map_or(0.0, |(_, radius)| *radius)
    };
    branch.radii.first().copied().unwrap_or(0.0).max(parent.map_or(0.0, there))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{Origin, Role, WoodPart};
    use std::f32::consts::FRAC_PI_2;

    fn branch(parent: Option<usize>, from: Vec3, to: Vec3, radius: f32) -> Branch {
        let points: Vec<Vec3> = (0..=20).map(|k| from.lerp(to, k as f32 / 20.0)).collect();
        let (origin, role) = (Origin::Generated, Role::of(WoodPart::Stem));
        let level = u32::from(parent.is_some());
        Branch { origin, parent, level, radii: vec![radius; points.len()], points, role }
    }

    /// A trunk, a bough that goes right, and a post in front of it, which stands left of where the bough points when it is turned by a
    /// quarter about the trunk.
    fn plant() -> Vec<Branch> {
        vec![
            branch(None, Vec3::ZERO, Vec3::Y * 3.0, 0.05),
            branch(Some(0), Vec3::Y * 2.0, Vec3::new(2.0, 2.0, 0.0), 0.03),
            branch(None, Vec3::new(1.0, 0.0, 1.0), Vec3::new(1.0, 4.0, 1.0), 0.04),
        ]
    }

    fn turned_by(turn: Quat) -> Vec3 {
        turn * Vec3::X
    }

    #[test]
    fn a_bough_stops_at_a_post_and_passes_it_if_it_may() {
        let around = Surroundings::of(&plant(), 1).unwrap();
        let to = Quat::from_rotation_y(-FRAC_PI_2);
        assert_eq!(around.turn(Quat::IDENTITY, to, OnContact::Pass), to);
        let stopped = around.turn(Quat::IDENTITY, to, OnContact::Stop);
        let angle = turned_by(stopped).z.atan2(turned_by(stopped).x).to_degrees();
        // The post stands at 45°, and both are 7 cm thick together, 1.41 m away.
        assert!((41.0..42.4).contains(&angle), "{angle}");
        assert!(around.contact(stopped).is_none());
        let away = Quat::from_rotation_y(FRAC_PI_2);
        assert_eq!(around.turn(Quat::IDENTITY, away, OnContact::Stop), away);
    }

    #[test]
    fn it_slides_up_along_the_post() {
        let around = Surroundings::of(&plant(), 1).unwrap();
        let way = Vec3::new(0.0, 0.8, 1.0).normalize();
        let to = Quat::from_rotation_arc(Vec3::X, way);
        let stopped = around.turn(Quat::IDENTITY, to, OnContact::Stop);
        let slid = around.turn(Quat::IDENTITY, to, OnContact::Slide);
        assert!(around.contact(slid).is_none());
        assert!(
            turned_by(slid).y > turned_by(stopped).y + 0.05,
            "{} {}",
            turned_by(slid),
            turned_by(stopped)
        );
        assert!(turned_by(slid).dot(way) > turned_by(stopped).dot(way));
    }

    #[test]
    fn what_touches_from_the_beginning_and_the_joint_do_not_hold_it() {
        let mut plant = plant();
        plant.push(branch(Some(0), Vec3::Y * 2.02, Vec3::new(2.0, 2.05, 0.02), 0.03));
        let around = Surroundings::of(&plant, 1).unwrap();
        let down = Quat::from_rotation_z(-0.6);
        assert_eq!(around.turn(Quat::IDENTITY, down, OnContact::Stop), down);
        let alone = Surroundings::of(&plant[..2], 1).unwrap();
        let round = Quat::from_rotation_y(2.0);
        assert_eq!(alone.turn(Quat::IDENTITY, round, OnContact::Slide), round);
        assert!(Surroundings::of(&plant, 9).is_none());
    }
}
