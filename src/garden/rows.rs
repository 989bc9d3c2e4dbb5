//! Plants that stand where they are put: one by one, before walls, along lines, and in straight rows through a bed.
//!
//! Along a line plants are as far apart as their kind keeps, the last ones at both its ends with a little more room between all. Rows lie
//! in the middle of their bed, and so do the plants of a row over the bed's breadth.
//!
//! Limits: plants at a line's corners are nearer to each other than along it; rows are straight, and turned at random as all plants are.

use super::plan::{Kind, Place, Plan, Stands};
use crate::geom::polyline;
use crate::random::Choice;
use glam::Vec2;

/// How many plants are put, about: maps do not count, and nothing is in the way.
pub(super) fn plants(plan: &Plan) -> f64 {
    let of_bed = |kind: &Kind, apart: f32, _| {
        f64::from(plan.square_metres_of(kind.bed)) / (f64::from(kind.spacing) * f64::from(apart))
    };
    count(plan, of_bed)
}

/// In how many places plants are looked for, those around a bed among them that rows reach.
pub(super) fn spots(plan: &Plan) -> f64 {
    let of_box = |kind: &Kind, apart: f32, angle: f32| {
        let counts = counts(plan.bounds_of(kind.bed), axis(angle), Vec2::new(kind.spacing, apart));
        f64::from(counts.x) * f64::from(counts.y)
    };
    count(plan, of_box)
}

/// How many plants are put, of which `in_rows` says how many rows have.
fn count(plan: &Plan, in_rows: impl Fn(&Kind, f32, f32) -> f64) -> f64 {
    let along = |line: &Vec<Vec2>, spacing: f32| f64::from(polyline::length(line)) / f64::from(spacing) + 1.0;
    let of = |kind: &Kind| match &kind.stands {
        Stands::Spread => 0.0,
        Stands::At(points) | Stands::Before(points) => points.len() as f64,
        Stands::Along(lines) => lines.iter().map(|line| along(line, kind.spacing)).sum(),
        Stands::Rows { apart, angle } => in_rows(kind, *apart, *angle),
    };
    plan.kinds.iter().map(of).sum()
}

/// The direction of rows that are turned by so many degrees.
fn axis(angle: f32) -> Vec2 {
    Vec2::from_angle(angle.to_radians())
}

/// The plants that are put within a box, kind by kind.
pub(super) fn placed(plan: &Plan, (low, high): (Vec2, Vec2)) -> Vec<Place> {
    let mut places = Vec::new();
    for (kind, number) in plan.kinds.iter().zip(0..) {
        let is_near = |at: &Vec2| at.cmpge(low).all() && at.cmple(high).all();
        let is_free = |at: &Vec2| kind.bed.is_none_or(|bed| plan.is_in_bed(Some(bed), *at));
        let stays = |at: &Vec2| !plan.is_on_path(*at) && !is_thinned(plan, kind, *at);
        let mut put = |at: Vec2| places.push(plan.plant(number, at, plan.spot(at)));
        match &kind.stands {
            Stands::Spread => {}
            Stands::At(points) => points.iter().copied().filter(is_near).for_each(put),
            Stands::Before(points) => {
                let numbered = points.iter().copied().zip(0..).filter(|(at, _)| is_near(at));
                places.extend(numbered.map(|(at, variant)| plan.before_wall(number, at, variant)));
            }
            Stands::Along(lines) => {
                let points =
                    lines.iter().flat_map(|line| polyline::spaced(line, kind.spacing)).filter(is_near);
                points.filter(|at| plan.area.contains(*at) && is_free(at) && stays(at)).for_each(put);
            }
            Stands::Rows { apart, angle } => {
                rows(plan.bounds_of(kind.bed), axis(*angle), Vec2::new(kind.spacing, *apart), |at| {
                    if is_near(&at) && plan.is_in_bed(kind.bed, at) && stays(&at) {
                        put(at);
                    }
                });
            }
        }
    }
    places
}

/// Whether a map takes a plant away.
fn is_thinned(plan: &Plan, kind: &Kind, at: Vec2) -> bool {
    let left = plan.value(plan.map.as_ref(), at) * plan.value(kind.map.as_ref(), at);
    Choice::PLANT.unit(plan.spot(at)) >= left
}

/// How many points a row over a box has, and how many rows there are.
fn counts((low, high): (Vec2, Vec2), axis: Vec2, apart: Vec2) -> Vec2 {
    let extent = high - low;
    let reach = Vec2::new(extent.dot(axis.abs()), extent.dot(axis.perp().abs()));
    (reach / apart + 1e-3).floor().max(Vec2::ONE)
}

/// Hands on points in rows over a box: so far apart along an axis and across it.
fn rows((low, high): (Vec2, Vec2), axis: Vec2, apart: Vec2, mut take: impl FnMut(Vec2)) {
    let middle = (low + high) / 2.0;
    let counts = counts((low, high), axis, apart).as_u64vec2();
    let place = |k: u64, count: u64, apart: f32| (k as f32 - 0.5 * (count - 1) as f32) * apart;
    for row in 0..counts.y {
        for k in 0..counts.x {
            let at = Vec2::new(place(k, counts.x, apart.x), place(row, counts.y, apart.y));
            take(middle + axis * at.x + axis.perp() * at.y);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_lie_in_the_middle_of_their_bed() {
        let mut points = Vec::new();
        rows((Vec2::ZERO, Vec2::new(4.0, 3.0)), Vec2::X, Vec2::new(0.5, 1.5), |at| points.push(at));
        assert_eq!((points.len(), points[0], points[15]), (16, Vec2::new(0.25, 0.75), Vec2::new(3.75, 2.25)));
        let mut turned = Vec::new();
        rows((Vec2::ZERO, Vec2::splat(2.0)), Vec2::Y, Vec2::new(1.0, 2.0), |at| turned.push(at));
        assert!(turned.len() == 2 && turned.iter().all(|at| (at.x - 1.0).abs() < 1e-6), "{turned:?}");
    }
}
