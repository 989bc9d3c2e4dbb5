//! What wood that is turned about its base meets: how far it may turn until it touches other wood, and how it slides along that.
//!
//! Internodes are capsules. Those that rest stand in an R-tree, made once when the wood is taken hold of. For a turn all pairs of a capsule
//! that turns and one that rests are gathered that may touch within its angle, whatever way it takes: branch by branch, each with a ball
//! around it, then capsule by capsule. How far each pair may turn is found by conservative advancement: two that are so far apart cannot
//! touch before the farther end of the moved one has gone as far, so the turn goes on by that and is looked at again, by a
//! quarter of both radii at least, which is halved where it goes in. No thin twig is jumped over. Wood within [`JOINT`] radii of the base on either side, and pairs that touch from the beginning, do not count. To slide, what is
//! left of the turn loses its part into the wood that is touched and goes on by a short step, [`SLIDES`] times at most.
//!
//! Source: 001 §4.3 asks that wood does not pass through other wood, by one convex hull for each of both parts, which overlap nearly
//! always; conservative advancement is Mirtich's (1996). Limits: what is bent, moved along its branch or grafted passes through wood, and so
//! do leaves.

use crate::geom::capsule::Capsule;
use crate::geom::polyline;
use crate::plant::Branch;
use glam::{Quat, Vec3};
use rayon::prelude::*;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};
use std::collections::HashSet;

/// Radii around the base within which wood does not count.
const JOINT: f32 = 4.0;
/// How exactly it is known where two touch, metres; least step of a pair, in the sum of its radii, and most steps.
const TOUCH: f32 = 1e-4;
const BOLD: f32 = 0.25;
const ADVANCES: usize = 200;
/// Most steps along wood with one move of the pointer, longest one, and least that is worth one, radians.
const SLIDES: usize = 6;
const SLIDE: (f32, f32) = (0.06, 1e-4);
/// How far steps along wood may lead from where they begin, in the angle to their target.
const ASIDE: f32 = 1.5;

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
}

/// A moved and a resting capsule that may touch.
struct Pair {
    /// As it is before anything is turned.
    moved: Capsule,
    resting: usize,
    /// Distance of its farther end from the base, metres.
    lever: f32,
}

/// A turn about an axis through the base.
struct Way {
    from: Quat,
    axis: Vec3,
    /// Radians.
    angle: f32,
}

impl Way {
    fn new(from: Quat, to: Quat) -> Self {
        let turn = to * from.inverse();
        let (axis, angle) = if turn.w < 0.0 { -turn } else { turn }.to_axis_angle();
        Self { from, axis, angle }
    }

    /// The turn so far on the way.
    fn at(&self, angle: f32) -> Quat {
        Quat::from_axis_angle(self.axis, angle) * self.from
    }
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
        let mut it = Self { base, moved, resting, tree, touching: HashSet::new() };
        let touches = |(_, pair): &(usize, Pair)| pair.moved.overlaps(&it.resting[pair.resting], 1.0);
        let touching = it.near(Quat::IDENTITY, 0.0).into_iter().filter(touches);
        it.touching = touching.map(|(number, pair)| (number, pair.resting)).collect();
        Some(it)
    }

    /// The turn, from where the wood was taken hold of, that it comes to on its way from one turn, at which it is free, to another.
    pub fn turn(&self, from: Quat, to: Quat, on_contact: OnContact) -> Quat {
        if on_contact == OnContact::Pass {
            return to;
        }
        let way = Way::new(from, to);
        let is_new = |(number, pair): &(usize, Pair)| !self.touching.contains(&(*number, pair.resting));
        // Along wood it may come farther from where it begins than its target is.
        let reach = if on_contact == OnContact::Slide { ASIDE * way.angle } else { way.angle };
        let near = self.near(from, reach).into_iter().filter(is_new);
        let pairs: Vec<Pair> = near.map(|(_, pair)| pair).collect();
        match on_contact {
            OnContact::Slide => self.slide(&pairs, from, to),
            _ => self.first_contact(&pairs, &way).map_or(to, |(free, _)| free),
        }
    }

    /// Whether the wood touches nothing new at a turn.
    #[cfg(test)]
    pub(crate) fn is_free(&self, turn: Quat) -> bool {
        let is_new = |(number, pair): &&(usize, Pair)| !self.touching.contains(&(*number, pair.resting));
        self.near(turn, 0.0).iter().filter(is_new).all(|(_, pair)| self.gap(pair, turn).0 > 0.0)
    }

    /// The turn nearest to another that short steps along what is touched lead to.
    fn slide(&self, pairs: &[Pair], from: Quat, to: Quat) -> Quat {
        let mut at = from;
        for _ in 0..SLIDES {
            let Some((free, contact)) = self.first_contact(pairs, &Way::new(at, to)) else { return to };
            at = free;
            let rest = Way::new(at, to);
            let rest = rest.angle * rest.axis;
            // Turned about an axis, the place that touches moves along its cross product with the lever.
            let lever = (contact.place - self.base).normalize_or_zero();
            let outward = lever.cross(contact.normal).normalize_or_zero();
            // About the lever itself it would not move at all, but come nearer with the rest of the step.
            let along = rest - rest.dot(outward).min(0.0) * outward - rest.dot(lever) * lever;
            let step = along.clamp_length_max(SLIDE.0);
            if step.length() < SLIDE.1 {
                return at;
            }
            // On its way about the base it comes nearer again, by half the square of its angle.
            let step = step + 0.5 * step.length_squared() * outward;
            let next = Quat::from_scaled_axis(step) * at;
            at = self.first_contact(pairs, &Way::new(at, next)).map_or(next, |(free, _)| free);
        }
        self.first_contact(pairs, &Way::new(at, to)).map_or(to, |(free, _)| free)
    }

    /// The last free turn on a way, and what is touched there; nothing where all of the way is free.
    fn first_contact(&self, pairs: &[Pair], way: &Way) -> Option<(Quat, Contact)> {
        let touching = pairs.par_iter().enumerate();
        let touching = touching.filter_map(|(number, pair)| Some((self.angle_free(pair, way)?, number)));
        let (angle, number) = touching.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))?;
        let turn = way.at(angle);
        Some((turn, self.gap(&pairs[number], turn).1))
    }

    /// How far a pair may turn on a way until it touches; nothing where it may turn all of it.
    fn angle_free(&self, pair: &Pair, way: &Way) -> Option<f32> {
        let gap = |angle: f32| self.gap(pair, way.at(angle)).0;
        // Along a surface the gap stays small. In a step so short neither passes through the other.
        let bold = BOLD * (pair.moved.radius + self.resting[pair.resting].radius);
        let (mut angle, mut left) = (0.0, gap(0.0));
        for _ in 0..ADVANCES {
            let mut step = left.max(bold) / pair.lever;
            (angle, left) = loop {
                let next = (angle + step).min(way.angle);
                let ahead = gap(next);
                if ahead > 0.0 {
                    break (next, ahead);
                }
                step *= 0.5;
                if step * pair.lever < TOUCH {
                    return Some(angle);
                }
            };
            if angle >= way.angle {
                return None;
            }
        }
        Some(angle)
    }

    /// How far a pair is apart at a turn, metres, and where it would touch.
    fn gap(&self, pair: &Pair, turn: Quat) -> (f32, Contact) {
        let turned = |place: Vec3| self.base + turn * (place - self.base);
        let moved = Capsule { from: turned(pair.moved.from), to: turned(pair.moved.to), ..pair.moved };
        let other = &self.resting[pair.resting];
        let (place, there) = moved.nearest(other);
        let (normal, distance) =
            (place - there).try_normalize().map_or((Vec3::Y, 0.0), |n| (n, place.distance(there)));
        (distance - moved.radius - other.radius, Contact { place, normal })
    }

    /// The pairs that may touch within an angle from a turn, each with the number of its moved capsule, always in the same order.
    fn near(&self, turn: Quat, angle: f32) -> Vec<(usize, Pair)> {
        let turned = |place: Vec3| self.base + turn * (place - self.base);
        let of_capsule = |number: usize, moved: Capsule| {
            let lever =
                (moved.from.distance(self.base)).max(moved.to.distance(self.base)).max(f32::MIN_POSITIVE);
            let margin = Vec3::splat(angle * lever + TOUCH);
            let there = Capsule { from: turned(moved.from), to: turned(moved.to), ..moved };
            let (low, high) = there.bounds(1.0);
            let close = self.within(low - margin, high + margin);
            close.map(move |resting| (number, Pair { moved, resting, lever }))
        };
        let of_branch = |branch: &MovedBranch| {
            let (middle, lever) = (turned(branch.middle), branch.middle.distance(self.base) + branch.radius);
            let reach = Vec3::splat(branch.radius + angle * lever + TOUCH);
            let is_near = self.within(middle - reach, middle + reach).next().is_some();
            let capsules = (branch.first..).zip(branch.capsules.iter().copied()).filter(|_| is_near);
            capsules.flat_map(|(number, capsule)| of_capsule(number, capsule)).collect::<Vec<_>>()
        };
        self.moved.par_iter().flat_map_iter(of_branch).collect()
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
        assert!(around.is_free(stopped));
        let away = Quat::from_rotation_y(FRAC_PI_2);
        assert_eq!(around.turn(Quat::IDENTITY, away, OnContact::Stop), away);
    }

    #[test]
    fn a_thin_twig_is_not_jumped_over() {
        let mut plant = plant();
        plant[2].radii.fill(0.0005);
        plant[1].radii.fill(0.0005);
        let around = Surroundings::of(&plant, 1).unwrap();
        let stopped = around.turn(Quat::IDENTITY, Quat::from_rotation_y(-3.0), OnContact::Stop);
        let angle = turned_by(stopped).z.atan2(turned_by(stopped).x).to_degrees();
        assert!((44.5..45.0).contains(&angle), "{angle}");
    }

    #[test]
    fn it_slides_up_along_the_post() {
        let around = Surroundings::of(&plant(), 1).unwrap();
        let way = Vec3::new(0.0, 0.8, 1.0).normalize();
        let to = Quat::from_rotation_arc(Vec3::X, way);
        let stopped = around.turn(Quat::IDENTITY, to, OnContact::Stop);
        let slid = around.turn(Quat::IDENTITY, to, OnContact::Slide);
        assert!(around.is_free(slid));
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
