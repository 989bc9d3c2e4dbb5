//! Drawn wood is brought inside of a crown's depth and extended into every separate part of the crown.
//!
//! The depth of drawn branches was found without knowing of a crown. Where they would leave it at the front or at the
//! back they are moved inside along z, which the front view does not show.
//!
//! Growth begins at buds that perceive space, so each separate part of a crown needs wood in it. Where the drawn
//! branches end below a part, the nearest of them is extended, straight, to a place inside that is near and deep.

use crate::geom::polyline;
use crate::growth::volume::Inflated;
use crate::plant::{Branch, Origin};
use glam::Vec2;

/// How much the depth of a place counts against its distance.
const DEEP: f32 = 1.5;
/// Radius at the end of an extension, and at its beginning where it leaves a branch sideways, as shares of the branch's
/// there.
const THINNER: (f32, f32) = (0.6, 0.75);
/// Places on drawn wood, and branches, that are tried for an extension to begin at, about.
const TRIED: usize = 400;
/// Distance from a branch's end, as a share of its length, within which an extension continues the branch.
const AT_END: f32 = 0.1;

/// Depth that drawn wood may have, as shares of the crown's half depth there and of its largest.
const INSIDE: (f32, f32) = (0.4, 0.04);

/// Brings drawn wood inside of a crown's depth where it lies over the crown.
pub(super) fn move_inside(wood: &mut [Branch], crown: &Inflated) {
    let least = INSIDE.1 * crown.deepest();
    for p in wood.iter_mut().flat_map(|branch| &mut branch.points) {
        if crown.covers(p.truncate()) {
            let (middle, half) = (crown.middle_depth(p.truncate()), crown.half_depth(p.truncate()));
            let most = INSIDE.0 * half + least;
            p.z = p.z.clamp(middle - most, middle + most);
        }
    }
}

/// A place on drawn wood and one inside a crown.
#[derive(Clone, Copy)]
struct Way {
    cost: f32,
    branch: usize,
    point: usize,
    to: Vec2,
}

/// Extends `wood` into the parts of a crown that it does not reach; `wood` may be empty and then stays so.
pub(super) fn extend(wood: &mut Vec<Branch>, crown: &Inflated) {
    let islands = crown.islands();
    let mut reached = vec![false; islands.count];
    for p in wood.iter().flat_map(|branch| &branch.points) {
        if let Some(island) = islands.at(crown, p.truncate()) {
            reached[island] = true;
        }
    }
    let unreached = (0..islands.count).filter(|island| !reached[*island]);
    let mut ways: Vec<Way> =
        unreached.filter_map(|island| shortest(wood, &islands.places(crown, island))).collect();
    // The nearest part gets the end of a branch that several would have.
    ways.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    ways.into_iter().for_each(|way| follow(wood, crown, way));
}

fn shortest(wood: &[Branch], places: &[(Vec2, f32)]) -> Option<Way> {
    let points: usize = wood.iter().map(|b| b.points.len()).sum();
    let step = points.div_ceil(TRIED).max(1);
    let mut best: Option<Way> = None;
    for (branch, of) in wood.iter().enumerate().step_by(wood.len().div_ceil(TRIED).max(1)) {
        let last = of.points.len().saturating_sub(1);
        // Ends always; of the rest every few.
        for point in (0..last).step_by(step).chain([last]) {
            let from = of.points[point].truncate();
            for &(to, depth) in places {
                let cost = from.distance(to) - DEEP * depth;
                if best.is_none_or(|b| cost < b.cost) {
                    best = Some(Way { cost, branch, point, to });
                }
            }
        }
    }
    best
}

fn follow(wood: &mut Vec<Branch>, crown: &Inflated, way: Way) {
    let branch = &mut wood[way.branch];
    let (from, radius) = (branch.points[way.point], branch.radii[way.point]);
    let whole = polyline::length(&branch.points);
    let left = polyline::length(&branch.points[way.point..]);
    let to = way.to.extend(crown.middle_depth(way.to));
    if left <= AT_END * whole {
        let end = branch.points.last().copied().unwrap_or(from);
        if end != to {
            branch.points.push(to);
            branch.radii.push(THINNER.0 * branch.radii.last().copied().unwrap_or(radius));
        }
        return;
    }
    let side = Branch {
        origin: Origin::Generated,
        parent: Some(way.branch),
        level: branch.level + 1,
        points: vec![from, to],
        radii: vec![THINNER.1 * radius, THINNER.0 * radius],
        role: branch.role,
    };
    wood.push(side);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{Provenance, Role, WoodPart};
    use glam::Vec3;
    use std::f32::consts::TAU;

    fn circle(x: f32, y: f32) -> Vec<Vec2> {
        (0..48).map(|k| Vec2::new(x, y) + Vec2::from_angle(k as f32 / 48.0 * TAU)).collect()
    }

    fn trunk(high: f32) -> Branch {
        let points: Vec<Vec3> = (0..=20).map(|k| Vec3::Y * (high * k as f32 / 20.0)).collect();
        Branch {
            origin: Provenance::default().record(Some(1)),
            parent: None,
            level: 0,
            radii: vec![0.1; points.len()],
            points,
            role: Role::of(WoodPart::Stem),
        }
    }

    #[test]
    fn every_part_is_reached() {
        let crown = Inflated::new(vec![circle(0.0, 4.0), circle(3.0, 2.5)], 1.0).unwrap();
        assert_eq!(crown.islands().count, 2);
        let mut wood = vec![trunk(2.0)];
        extend(&mut wood, &crown);
        assert_eq!(wood.len(), 2, "the trunk goes on, and a branch leaves it");
        let end = |b: &Branch| *b.points.last().unwrap();
        assert!(crown.contains(end(&wood[0])) && end(&wood[0]).y > 3.2, "{:?}", wood[0].points);
        assert!(crown.contains(end(&wood[1])) && end(&wood[1]).x > 2.2, "{:?}", wood[1].points);
        let before = wood.clone();
        extend(&mut wood, &crown);
        assert_eq!(wood, before, "what is reached is left alone");
    }

    #[test]
    fn wood_over_a_crown_is_brought_inside_of_it() {
        let crown = Inflated::new(vec![circle(0.0, 2.0)], 1.0).unwrap();
        let mut wood = vec![trunk(2.0)];
        wood[0].points.iter_mut().for_each(|p| p.z = p.y);
        let before = wood[0].points.clone();
        move_inside(&mut wood, &crown);
        let end = *wood[0].points.last().unwrap();
        assert!(crown.contains(end) && end.z > 0.3, "{end}");
        for (old, new) in before.iter().zip(&wood[0].points) {
            assert_eq!(old.truncate(), new.truncate(), "the front is as it was");
            assert!(old.y > 1.0 || old == new, "outside nothing is moved");
        }
    }

    #[test]
    fn a_part_that_is_reached_or_no_wood_changes_nothing() {
        let crown = Inflated::new(vec![circle(0.0, 2.0)], 1.0).unwrap();
        let mut wood = vec![trunk(2.0)];
        extend(&mut wood, &crown);
        assert_eq!(wood, [trunk(2.0)]);
        let mut none = Vec::new();
        extend(&mut none, &crown);
        assert!(none.is_empty());
    }
}
