//! A flower whose petals are single lines that stand around its centre, and a sun, which is drawn in the same way.
//!
//! The centre is a round closed stroke, a spiral or a small scribble ([`corolla`](super::corolla)). A ray is a nearly straight
//! line that begins near its edge and points away from it; at least [`FEWEST`] of about one length, with no wide gap between them,
//! make a flower. Each becomes a thin petal along its line, as wide as the place between its neighbours allows; the line
//! that goes much farther is the stem. What has no stem, stands in the upper part of a drawing that has more below, and touches
//! nothing, is the sun.
//!
//! Limits: hairs on a cactus and spines on a leaf are no rays, for they do not go all around.

use super::corolla;
use crate::anatomy::conventions::page::{Line, Page, even};
use crate::anatomy::conventions::shapes::lobes::{self, Focus};
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::sketch::{Reading, Tool};
use glam::Vec2;
use std::f32::consts::TAU;

/// Fewest rays, and most lines that are looked at around one centre.
const FEWEST: usize = 5;
const MOST_LINES: usize = 128;
/// Least chord of a ray over its length.
const STRAIGHT: f32 = 0.8;
/// Where rays begin, in half sizes of the centre, least and most.
const BEGIN: (f32, f32) = (0.4, 2.2);
/// Least cosine between a ray and the direction in which it stands.
const OUTWARD: f32 = 0.75;
/// Length of a ray, least and most, as a share of the middle one's.
const LENGTH: (f32, f32) = (0.4, 2.0);
/// Longest middle ray, and the shortest, in half sizes of the centre.
const REACH: (f32, f32) = (0.3, 5.0);
/// Widest gap between rays.
const GAP: f32 = 0.35 * TAU;
/// Half the width of a petal at most, as a share of its length, and of the space that its neighbours leave it.
const HALF: (f32, f32) = (0.22, 0.45);
/// Points of each side of a petal.
const SIDE: usize = 10;
/// Where the roots of petals are brought, in half sizes of the centre.
const ROOT: f32 = 0.15;
/// Least size of the drawing, in sizes of a sun, and the upper part of it in which suns stand.
const SKY: (f32, f32) = (2.5, 0.45);

/// How far from the middle of a flower its stem ends at most, and how far below that it begins at least, in the flower's radii; least cosine
/// between the stem's end and the way to the middle.
const STEM: (f32, f32, f32) = (1.7, 2.5, 0.8);
/// Part of a stem at whose end its direction is measured.
const STEM_END: usize = 6;

/// Proposes a flower or a sun for each centre with rays.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let centres: Vec<usize> = (0..page.lines.len()).filter(|i| corolla::is_round(&page.lines[*i])).collect();
    let grown = |i: &usize| {
        let line = &page.lines[*i];
        let margin = Vec2::splat(0.6 * line.size().max_element());
        (line.bounds.0 - margin, line.bounds.1 + margin)
    };
    let boxes: Vec<(Vec2, Vec2)> = centres.iter().map(grown).collect();
    let near = page.lines_at(&boxes);
    out.extend(centres.iter().zip(near).filter_map(|(centre, near)| flower(page, *centre, &near)));
}

/// A line that stands on the edge of a centre.
struct Ray {
    line: usize,
    /// Its points from the centre outward.
    points: Vec<Vec2>,
}

impl Ray {
    fn new(number: usize, line: &Line, focus: &Focus) -> Option<Self> {
        let points = line.beginning_at(|end| focus.distance(end));
        let (begin, end) = (points[0], points[points.len() - 1]);
        let run = end - begin;
        let outward = (begin.midpoint(end) - focus.place).normalize_or_zero();
        let is_ray = run.length() > STRAIGHT * line.length
            && (BEGIN.0..BEGIN.1).contains(&focus.distance(begin))
            && run.normalize_or_zero().dot(outward) > OUTWARD;
        is_ray.then_some(Self { line: number, points })
    }

    fn tip(&self) -> Vec2 {
        self.points[self.points.len() - 1]
    }

    fn length(&self) -> f32 {
        self.points[0].distance(self.tip())
    }
}

fn flower(page: &Page, centre: usize, near: &[usize]) -> Option<Hypothesis> {
    if near.len() <= FEWEST || near.len() > MOST_LINES {
        return None;
    }
    let disc = &page.lines[centre];
    let focus = Focus { place: disc.middle(), half: 0.5 * disc.size() };
    let others = || near.iter().copied().filter(|i| *i != centre);
    let mut rays: Vec<Ray> = others().filter_map(|i| Ray::new(i, &page.lines[i], &focus)).collect();
    let mut lengths: Vec<f32> = rays.iter().map(Ray::length).collect();
    lengths.sort_by(f32::total_cmp);
    let middle = *lengths.get(lengths.len() / 2)?;
    rays.retain(|ray| (LENGTH.0 * middle..LENGTH.1 * middle).contains(&ray.length()));
    let is_of_size = (REACH.0..REACH.1).contains(&(middle / focus.half.max_element()));
    let tips: Vec<Vec<Vec2>> = rays.iter().map(|ray| vec![ray.tip()]).collect();
    if rays.len() < FEWEST || !is_of_size || lobes::widest_gap(&tips, focus.place) > GAP {
        return None;
    }
    let is_inside = |i: &usize| focus.reach(&page.lines[*i].points) < 1.0;
    let inside = others().filter(is_inside);
    let mut uses: Vec<usize> = rays.iter().map(|ray| ray.line).chain(inside).chain([centre]).collect();
    uses.sort_unstable();
    uses.dedup();
    let stands_free = others().all(|i| uses.binary_search(&i).is_ok());
    let radius = focus.half.max_element() + middle;
    let is_sun = stands_free && is_in_the_sky(page, &focus, radius) && !is_on_stem(page, focus.place, radius);
    let parts = if is_sun { Vec::new() } else { petals(&rays, &focus, middle, &disc.hull) };
    let score = 4.0 + 0.1 * rays.len().min(10) as f32;
    let reading = if is_sun { Reading::Sun } else { Reading::Corolla };
    let habit = (!is_sun).then_some(Habit::Flower);
    Some(Hypothesis { uses, score, parts, solids: Vec::new(), reading, habit })
}

/// Whether a thing of such a radius is small and high in the drawing.
fn is_in_the_sky(page: &Page, focus: &Focus, radius: f32) -> bool {
    let size = page.bounds.1 - page.bounds.0;
    size.y > SKY.0 * 2.0 * radius && focus.place.y < page.bounds.0.y + SKY.1 * size.y
}

/// Whether a line rises to just below a thing of such a radius and points at its middle.
fn is_on_stem(page: &Page, place: Vec2, radius: f32) -> bool {
    let margin = Vec2::splat(STEM.0 * radius);
    let near = page.lines_at(&[(place - margin, place + margin)]);
    near.iter().flatten().any(|i| {
        let way = page.lines[*i].upward();
        let last = way.len() - 1;
        let (foot, before, top) = (way[0], way[last - way.len() / STEM_END], way[last]);
        let leads = (top - before).normalize_or_zero().dot((place - top).normalize_or_zero());
        (0.5 * radius..STEM.0 * radius).contains(&top.distance(place))
            && foot.y > place.y + STEM.1 * radius
            && leads > STEM.2
    })
}

/// A petal along each ray, and the centre.
fn petals(rays: &[Ray], focus: &Focus, length: f32, hull: &[Vec2]) -> Vec<Made> {
    let root = ROOT * focus.half.min_element();
    let space = TAU / rays.len() as f32 * (focus.half.min_element() + 0.5 * length);
    let half = (HALF.0 * length).min(HALF.1 * space);
    let petal = |ray: &Ray| {
        let at = focus.place + root * (ray.tip() - focus.place).normalize_or_zero();
        let along = even(&[&[at], &ray.points[..]].concat(), SIDE);
        Made::new(Tool::Petal, blade(&along, half))
    };
    let centre = Made::new(Tool::Auto, corolla::from_middle(hull, focus.place));
    rays.iter().map(petal).chain([centre]).collect()
}

/// The outline of a blade along a line, from its root around its tip and back.
pub(crate) fn blade(along: &[Vec2], half: f32) -> Vec<Vec2> {
    let last = along.len() - 1;
    let side = |k: usize| {
        let run = (along[(k + 1).min(last)] - along[k.saturating_sub(1)]).normalize_or_zero();
        // Widest beyond the middle.
        let share = (k as f32 / last as f32).powf(1.3);
        half * (share * 0.5 * TAU).sin() * run.perp()
    };
    let out = (0..=last).map(|k| along[k] + side(k));
    out.chain((0..last).rev().map(|k| along[k] - side(k))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    /// A disc around a place and so many rays, over a share of the circle.
    fn disc_with_rays(place: Vec2, count: usize, around: f32) -> Vec<Vec<Vec2>> {
        let at = |turn: f32, away: f32| place + away * Vec2::from_angle(turn);
        let ray = |k: usize| {
            let turn = around * TAU * k as f32 / count as f32 + 0.3;
            vec![at(turn, 33.0), at(turn + 0.03, 70.0)]
        };
        let disc = (0..=40).map(|k| at(TAU * k as f32 / 40.0, 30.0)).collect();
        (0..count).map(ray).chain([disc]).collect()
    }

    #[test]
    fn rays_become_thin_petals_and_the_long_one_stays_the_stem() {
        let mut drawn = disc_with_rays(Vec2::ZERO, 9, 1.0);
        drawn.push(vec![Vec2::new(0.0, 32.0), Vec2::new(4.0, 280.0)]);
        let found = read(&drawn);
        let [flower] = &found[..] else { panic!("{} flowers", found.len()) };
        assert_eq!(flower.uses, (0..10).collect::<Vec<_>>());
        let (petals, centre): (Vec<_>, Vec<_>) =
            flower.parts.iter().partition(|part| part.tool == Tool::Petal);
        assert_eq!((petals.len(), centre.len()), (9, 1));
        for petal in petals {
            let outline: Vec<Vec2> = petal.points.iter().map(|p| p.position).collect();
            assert!(outline[0].length() < 10.0, "it meets the centre");
            assert!(outline.iter().any(|p| p.length() > 68.0), "it reaches as far as its ray");
            assert!(crate::geom::simple_loop::area(&outline) > 300.0);
        }
    }

    #[test]
    fn few_rays_and_rays_on_one_side_are_none() {
        assert!(read(&disc_with_rays(Vec2::ZERO, 4, 1.0)).is_empty());
        assert!(read(&disc_with_rays(Vec2::ZERO, 8, 0.5)).is_empty());
    }

    #[test]
    fn high_over_a_plant_it_is_the_sun_but_not_alone_and_not_on_a_stem() {
        let sun = disc_with_rays(Vec2::new(60.0, 60.0), 8, 1.0);
        let plant = vec![Vec2::new(300.0, 500.0), Vec2::new(300.0, 200.0)];
        let with = |line: Vec<Vec2>| {
            let found = read(&[sun.clone(), vec![line]].concat());
            (found[0].reading, found[0].parts.is_empty())
        };
        assert_eq!(with(plant), (Reading::Sun, true));
        assert_eq!(read(&sun)[0].reading, Reading::Corolla);
        let stem = vec![Vec2::new(60.0, 92.0), Vec2::new(60.0, 500.0)];
        assert_eq!(with(stem), (Reading::Corolla, false));
        let below = vec![Vec2::new(62.0, 140.0), Vec2::new(70.0, 500.0)];
        assert_eq!(with(below), (Reading::Corolla, false), "the stem ends below the petals");
    }
}
