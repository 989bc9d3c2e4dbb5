//! The cap of a mushroom: what of a stalk suddenly widens becomes a body of revolution of its own, of other materials.
//!
//! A drawn mushroom is one branch, as thick at each height as was drawn. Its stalk stays one; from where it widens, its radii
//! are the profile of two bodies: the skin, from the rim over the top, and the underside within the rim, whose foot sits on the stalk. So
//! skin and underside have a picture each, which no ring of the wood cuts, and the top is as round as drawn.
//! Limits: only where no branch and no flower grows on what is wide; the cap stands on a straight axis.

use crate::geom::polyline;
use crate::plant::{Branch, Organ, OrganPart, Plant, Role, Shape};
use glam::{Vec2, Vec3};

/// Least radius of a cap, in the least of its stalk's.
const WIDE: f32 = 1.5;
/// Where a stalk ends, going down from the cap's widest place: radius there at most, as a share of that, and how fast it grows.
const STALK: (f32, f32) = (0.65, 0.5);
/// Radius at which the underside ends and the skin begins, as a share of the widest: a cap that bulges is skin around its lower side, too.
const RIM: f32 = 0.85;
/// Rows of the skin from rim to top, and of the underside.
const ROWS: (usize, usize) = (28, 8);
/// The edge of the skin, which is rolled under the rim: radii as shares of the rim's, heights above it in the rim's radius.
const LIP: [(f32, f32); 5] = [(0.0, 0.06), (0.89, 0.06), (0.91, -0.005), (0.95, -0.03), (0.985, -0.022)];
/// Where the underside ends behind the lip, without touching it, and how high it goes on inside of the skin, in the rim's radius.
const INSIDE: (f32, f32) = (0.88, 0.04);
/// Radius at which the underside begins inside of the stalk, as a share of the stalk's.
const SUNK: f32 = 0.7;
/// How high the top is above its last row, in the row's radius: less than rows below it rise, so that it is round.
const ROUND_TOP: f32 = 0.04;

/// Variants of the role of skin and underside.
const SKIN: u32 = 0;
pub(super) const UNDERSIDE: u32 = 1;

/// Makes caps of all branches that have one, and gives them.
pub(super) fn caps(plant: &mut Plant) -> Vec<Organ> {
    let mut carried: Vec<Vec<Vec3>> = vec![Vec::new(); plant.branches.len()];
    let branches = plant.branches.iter().filter_map(|branch| Some((branch.parent?, branch.points[0])));
    let flowers = plant.flowers.iter().filter_map(|flower| Some((flower.branch?, flower.cone.apex)));
    branches.chain(flowers).for_each(|(on, place)| carried[on].push(place));
    let mut organs = Vec::new();
    for ((index, branch), carried) in plant.branches.iter_mut().enumerate().zip(carried) {
        let Some(cap) = Cap::of(branch) else { continue };
        let foot = branch.points[cap.foot];
        if carried.iter().any(|place| (*place - foot).dot(cap.axis) > 0.0) {
            continue;
        }
        let organ = |variant, shape| Organ {
            role: Role { variant, ..Role::of(OrganPart::Fruit) },
            origin: branch.origin,
            branch: Some(index),
            flower: None,
            shape,
        };
        organs.extend([organ(SKIN, cap.skin()), organ(UNDERSIDE, cap.underside())]);
        cap.cut_from(branch);
    }
    organs
}

/// Where a branch widens to a cap.
struct Cap {
    /// The last point of the stalk, and the point at the rim.
    foot: usize,
    rim: usize,
    /// The axis at the rim, and its unit direction.
    base: Vec3,
    axis: Vec3,
    /// Radius and height above the rim of all points from the foot on.
    profile: Vec<Vec2>,
}

impl Cap {
    fn of(branch: &Branch) -> Option<Self> {
        let Branch { points, radii, .. } = branch;
        let widest = (0..radii.len()).reduce(|best, i| if radii[i] > radii[best] { i } else { best })?;
        let narrow = radii[..widest].iter().copied().fold(f32::INFINITY, f32::min);
        if radii[widest] < WIDE * narrow {
            return None;
        }
        let is_stalk = |i: &usize| {
            let growth = (radii[*i] - radii[i - 1]) / points[*i].distance(points[i - 1]);
            radii[*i] < STALK.0 * radii[widest] && growth < STALK.1
        };
        let foot = (1..widest).rev().find(is_stalk)?;
        let rim = (foot..=widest).find(|i| radii[*i] >= RIM * radii[widest])?;
        let axis = (points[points.len() - 1] - points[foot]).try_normalize()?;
        let base = points[rim];
        let at = |i: usize| Vec2::new(radii[i], (points[i] - base).dot(axis));
        Some(Self { foot, rim, base, axis, profile: (foot..points.len()).map(at).collect() })
    }

    /// The skin: its rolled edge, then the profile from the rim to the top.
    fn skin(&self) -> Shape {
        let rim = self.profile[self.rim - self.foot].x;
        let lip = LIP.iter().map(|(r, h)| Vec2::new(*r, *h) * rim);
        let above = rows(&self.profile[self.rim - self.foot..], ROWS.0);
        let top = above.last().map(|p| Vec2::new(0.0, p.y + ROUND_TOP * p.x));
        self.body(lip.chain(above).chain(top).collect())
    }

    /// The underside: the profile from the stalk to the rim, closed inside of the skin.
    fn underside(&self) -> Shape {
        let mut below = rows(&self.profile[..=self.rim - self.foot], ROWS.1);
        below.iter_mut().take(1).for_each(|p| p.x *= SUNK);
        let rim = self.profile[self.rim - self.foot].x;
        let start = below.first().map(|p| Vec2::new(0.0, p.y));
        let inside = [Vec2::new(INSIDE.0, 0.5 * INSIDE.1), Vec2::new(0.0, INSIDE.1)].map(|p| p * rim);
        let within = below.into_iter().map(|p| Vec2::new(p.x.min(INSIDE.0 * rim), p.y));
        self.body(start.into_iter().chain(within).chain(inside).collect())
    }

    fn body(&self, profile: Vec<Vec2>) -> Shape {
        Shape::Lathe { base: self.base, axis: self.axis, profile }
    }

    /// Leaves a branch its stalk, which ends inside of the cap.
    fn cut_from(&self, branch: &mut Branch) {
        let radius = branch.radii[self.foot];
        let end = usize::midpoint(self.foot, self.rim + 1) + 1;
        branch.points.truncate(end);
        branch.radii.truncate(end);
        branch.radii[self.foot..].fill(radius);
    }
}

/// A profile in at most so many rows and one, as far apart along it as each other.
fn rows(profile: &[Vec2], count: usize) -> Vec<Vec2> {
    let arcs = polyline::arc_lengths(profile.iter().copied());
    let whole = arcs.last().copied().unwrap_or(0.0);
    let at =
        |k: usize| polyline::interpolate(profile, polyline::locate(&arcs, whole * k as f32 / count as f32));
    (0..=count).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{Origin, WoodPart};

    fn mushroom() -> Plant {
        let half = |y: f32| match y {
            y if y < 0.5 => 0.1,
            y if y < 0.55 => 0.1 + (y - 0.5) * 8.0,
            y => 0.5 * (1.0 - ((y - 0.55) / 0.46).powi(2)).max(0.0).sqrt(),
        };
        let heights = (0..=100).map(|k| 0.01 * k as f32);
        Plant {
            branches: vec![Branch {
                origin: Origin::Generated,
                parent: None,
                level: 0,
                points: heights.clone().map(|y| Vec3::Y * y).collect(),
                radii: heights.map(half).collect(),
                role: Role::of(WoodPart::Stem),
            }],
            ..Plant::default()
        }
    }

    #[test]
    fn what_widens_suddenly_is_a_cap_of_two_materials() {
        let mut plant = mushroom();
        let organs = caps(&mut plant);
        assert_eq!(organs.iter().map(|organ| organ.role.variant).collect::<Vec<_>>(), [0, 1]);
        let stalk = &plant.branches[0];
        assert!(stalk.radii.iter().all(|r| *r < 0.12), "{:?}", stalk.radii);
        let profile = |organ: &Organ| match &organ.shape {
            Shape::Lathe { base, profile, .. } => {
                profile.iter().map(|p| *p + Vec2::Y * base.y).collect::<Vec<_>>()
            }
            _ => panic!("a cap is turned"),
        };
        let (skin, underside) = (profile(&organs[0]), profile(&organs[1]));
        let high = |points: &[Vec2]| points.iter().map(|p| p.y).fold(0.0, f32::max);
        assert!((high(&skin) - 1.0).abs() < 0.02 && high(&underside) < 0.65);
        assert!(skin.iter().all(|p| p.x < 0.505));
        plant.add_organs(organs, crate::plant::Templates::default());
        plant.check_invariants().unwrap();
    }

    #[test]
    fn stems_have_none_nor_what_carries_something_up_there() {
        let mut plant = mushroom();
        plant.branches[0].radii.fill(0.1);
        assert!(caps(&mut plant).is_empty());
        let mut plant = mushroom();
        let points = vec![Vec3::Y * 0.7, Vec3::new(0.8, 0.8, 0.0)];
        plant.branches.push(Branch {
            parent: Some(0),
            level: 1,
            points,
            radii: vec![0.05; 2],
            ..plant.branches[0].clone()
        });
        assert!(caps(&mut plant).is_empty());
        plant.branches[1].points = vec![Vec3::Y * 0.2, Vec3::new(0.3, 0.3, 0.0)];
        assert_eq!(caps(&mut plant).len(), 2, "grass at the foot of a mushroom");
    }
}
