//! Wood that is led into every part of a crown of lobes, in space.
//!
//! Growth begins at buds that perceive space, so each part of the union that hangs together needs wood in it. Drawn trunks are
//! where they were drawn; without any, one rises from the ground below the crown's middle. From there every part is reached by a
//! branch from the nearest wood, the nearest part first, so that far ones may branch off the way to near ones. A branch leaves its
//! parent half along it and half upward and bends to a place that is near and deep.
//!
//! Source: 001 §5.1 draws the trunks; what reaches lobes that no trunk touches is not described. Limits: ways are not led
//! around lobes that are taken away; the wood in them stays bare.

use super::volume::Lobes;
use crate::geom::polyline::length;
use crate::lobes::Trunk;
use crate::plant::{Branch, Origin, Role, WoodPart};
use glam::Vec3;

/// How much the depth of a place counts against its distance.
const DEEP: f32 = 1.5;
/// Radius of a trunk that nobody drew, as a share of the crown's size.
const TRUNK: f32 = 0.028;
/// Radius at a branch's end and at its beginning, as shares of the wood's there that it leaves; at a drawn trunk's end as a share
/// of its foot's.
const THINNER: (f32, f32, f32) = (0.5, 0.7, 0.5);
/// Share of a branch's length from its end within which a way continues it.
const AT_END: f32 = 0.1;
/// Points of a way.
const POINTS: usize = 9;
/// How far a way keeps the direction in which it leaves, as a share of its length.
const BEND: f32 = 0.35;
/// Places that are tried in each part, about.
const TRIED: usize = 400;

/// Drawn trunks, and branches from them into every part of the crown.
pub fn lead_into(trunks: &[Trunk], lobes: &Lobes) -> Vec<Branch> {
    let mut wood: Vec<Branch> = trunks.iter().filter_map(drawn).collect();
    if wood.is_empty() {
        wood.extend(trunk_below(lobes));
    }
    let mut reached = vec![false; lobes.parts().len()];
    wood.iter().for_each(|branch| mark(&mut reached, branch, lobes));
    loop {
        let unreached = (0..reached.len()).filter(|part| !reached[*part]);
        let ways = unreached.filter_map(|part| Some((part, nearest(&wood, lobes, part)?)));
        // The first of equals, so that the order of parts decides.
        let best = ways.reduce(|a, b| if b.1.cost < a.1.cost { b } else { a });
        let Some((part, way)) = best else { return wood };
        follow(&mut wood, &way);
        reached[part] = true;
        wood.iter().for_each(|branch| mark(&mut reached, branch, lobes));
    }
}

fn drawn(trunk: &Trunk) -> Option<Branch> {
    let whole = length(&trunk.points);
    let mut along = 0.0;
    let mut radii = Vec::with_capacity(trunk.points.len());
    for (k, p) in trunk.points.iter().enumerate() {
        along += k.checked_sub(1).map_or(0.0, |before| p.distance(trunk.points[before]));
        radii.push(trunk.radius * (1.0 - (1.0 - THINNER.2) * along / whole));
    }
    (whole > 0.0).then(|| branch(None, 0, trunk.points.clone(), radii))
}

fn branch(parent: Option<usize>, level: u32, points: Vec<Vec3>, radii: Vec<f32>) -> Branch {
    Branch { origin: Origin::Generated, parent, level, points, radii, role: Role::of(WoodPart::Stem) }
}

/// A trunk from the ground below the crown's middle to a place that is near and deep.
fn trunk_below(lobes: &Lobes) -> Option<Branch> {
    let (low, high) = lobes.bounds();
    let weights = || lobes.parts().iter().map(|part| part.volume);
    let centre = |part: &super::volume::Part| {
        part.places.iter().map(|place| place.0).sum::<Vec3>() / part.places.len().max(1) as f32
    };
    let middle = lobes.parts().iter().map(|part| centre(part) * part.volume).sum::<Vec3>()
        / weights().sum::<f32>().max(f32::MIN_POSITIVE);
    let foot = middle.with_y(low.y.min(0.0));
    let aside = |p: Vec3| (p - foot).with_y(0.0).length();
    let places = lobes.parts().iter().flat_map(|part| &part.places);
    let cost = |(p, depth): &(Vec3, f32)| 2.0 * aside(*p) + 0.3 * (p.y - foot.y) - DEEP * depth;
    let (to, _) = places.reduce(|a, b| if cost(b) < cost(a) { b } else { a })?;
    let radius = TRUNK * (high - low).max_element().max(high.y - foot.y);
    let (points, radii) = curve((foot, radius), Vec3::Y, (*to, THINNER.2 * radius));
    (foot != *to).then(|| branch(None, 0, points, radii))
}

/// Notes which parts a branch reaches.
fn mark(reached: &mut [bool], branch: &Branch, lobes: &Lobes) {
    for pair in branch.points.windows(2) {
        let steps = (pair[0].distance(pair[1]) / lobes.cell()).ceil().max(1.0) as usize;
        for k in 0..=steps {
            if let Some(part) = lobes.part_at(pair[0].lerp(pair[1], k as f32 / steps as f32)) {
                reached[part] = true;
            }
        }
    }
}

/// A place on wood and one in a part of the crown.
struct Way {
    cost: f32,
    branch: usize,
    point: usize,
    to: Vec3,
}

fn nearest(wood: &[Branch], lobes: &Lobes, part: usize) -> Option<Way> {
    let places = &lobes.parts()[part].places;
    let mut best: Option<Way> = None;
    for (to, depth) in places.iter().step_by(places.len().div_ceil(TRIED).max(1)) {
        for (branch, of) in wood.iter().enumerate() {
            // Not from the foot: a way would be a second trunk.
            for (point, from) in of.points.iter().enumerate().skip(1) {
                let cost = from.distance(*to) - DEEP * depth;
                if best.as_ref().is_none_or(|b| cost < b.cost) {
                    best = Some(Way { cost, branch, point, to: *to });
                }
            }
        }
    }
    best
}

fn follow(wood: &mut Vec<Branch>, way: &Way) {
    let of = &mut wood[way.branch];
    let (from, radius) = (of.points[way.point], of.radii[way.point]);
    let along = (from - of.points[way.point - 1]).normalize_or(Vec3::Y);
    if length(&of.points[way.point..]) <= AT_END * length(&of.points) {
        let (end, radius) = (of.points.len() - 1, of.radii[of.points.len() - 1]);
        let (points, radii) = curve((of.points[end], radius), along, (way.to, THINNER.0 * radius));
        of.points.extend(&points[1..]);
        of.radii.extend(&radii[1..]);
        return;
    }
    let leaving = (along + Vec3::Y).normalize_or(Vec3::Y);
    let level = of.level + 1;
    let (points, radii) = curve((from, THINNER.1 * radius), leaving, (way.to, THINNER.0 * radius));
    wood.push(branch(Some(way.branch), level, points, radii));
}

/// A bend from one place, left in a direction, to another; radii go evenly from one to the other.
pub(super) fn curve((from, first): (Vec3, f32), way: Vec3, (to, last): (Vec3, f32)) -> (Vec<Vec3>, Vec<f32>) {
    let control = from + way * (BEND * from.distance(to));
    let share = |k: usize| k as f32 / (POINTS - 1) as f32;
    let at = |k: usize| from.lerp(control, share(k)).lerp(control.lerp(to, share(k)), share(k));
    let mut points: Vec<Vec3> = (0..POINTS).map(at).collect();
    points.dedup();
    let count = points.len().max(2);
    (points, (0..count).map(|k| first + (last - first) * k as f32 / (count - 1) as f32).collect())
}

#[cfg(test)]
mod tests {
    use super::super::volume::ball;
    use super::*;

    fn two() -> Lobes {
        let [left, right] = [-1.5, 1.5].map(|x| Vec3::new(x, 3.0, x * 0.5));
        Lobes::new(&[ball("a", left, 0.8, false), ball("b", right, 0.9, false)]).unwrap()
    }

    #[test]
    fn every_part_is_reached_without_a_trunk_and_with_one() {
        let lobes = two();
        let aside = Trunk { points: vec![Vec3::new(4.0, 0.0, 0.0), Vec3::new(4.0, 2.0, 0.0)], radius: 0.1 };
        for trunks in [vec![], vec![aside]] {
            let wood = lead_into(&trunks, &lobes);
            let mut reached = vec![false; 2];
            wood.iter().for_each(|branch| mark(&mut reached, branch, &lobes));
            assert_eq!(reached, [true, true]);
            for (k, branch) in wood.iter().enumerate() {
                assert_eq!(branch.points.len(), branch.radii.len());
                assert!(branch.parent.is_none_or(|parent| parent < k));
                assert!(
                    branch.points.windows(2).all(|w| w[0] != w[1]) && branch.radii.iter().all(|r| *r > 0.0)
                );
            }
            assert!(
                lobes.part_at(*wood[0].points.last().unwrap()).is_some(),
                "a trunk's end goes on into the crown"
            );
        }
    }

    #[test]
    fn a_crown_of_nothing_needs_no_wood() {
        assert!(lead_into(&[], &Lobes::new(&[]).unwrap()).is_empty());
    }
}
