//! Plants that stand side by side, each with a page of its own.
//!
//! A garden is several small plants in one drawing. What is small beside the drawing may be whole in itself, and is read as it
//! would be read alone: at its own scale, weighed against its own size. Lines belong to one plant if some of them overlap from left
//! to right; between two plants there is a gap from top to bottom. A plant has a page of its own if it stands on the ground,
//! or, where none is drawn, about as low as the others, if it is no speck beside the tallest of them, and if what is read there
//! is a plant and not a leaf or a twig. What is read there is kept as long as its strokes are the same. Cost: one sort, and the
//! points of each line once more.
//!
//! Limits: plants that overlap from left to right are looked at together, on the page of the whole, and so
//! are more than [`MOST`] that are no meadow.

use super::hypothesis::{Hypothesis, renumbered};
use super::page::{Line, Page};
use crate::kept::{Kept, Same, Use};
use crate::sketch::Stroke;
use glam::Vec2;
use std::sync::Arc;

/// Least gap between plants, as a share of the drawing's diagonal.
const GAP: f32 = 0.012;
/// Largest of a small plant, as a share of the drawing's diagonal.
const SMALL: f32 = 0.6;
/// Least height, as a share of the tallest plant's.
const SPECK: f32 = 0.2;
/// How high above the ground a plant's foot may be, as a share of its height.
const FLOATS: f32 = 0.3;
/// The same above the lowest plant's foot, as a share of the tallest plant's height.
const LEVEL: f32 = 0.3;

/// Most plants that have pages of their own: reading each costs as much as a drawing.
const MOST: usize = 12;

/// Lines that are one plant, as far as can be seen from where they stand.
#[derive(Clone, Debug)]
pub(super) struct Plant {
    /// The lines of the page, ascending.
    pub lines: Vec<usize>,
    /// Smallest and largest corner.
    pub bounds: (Vec2, Vec2),
}

impl Plant {
    /// Width and height.
    pub(super) fn size(&self) -> Vec2 {
        self.bounds.1 - self.bounds.0
    }

    /// Whether it rises from a ground line.
    pub(super) fn stands_on(&self, ground: &Line) -> bool {
        let foot = Vec2::new(self.bounds.0.x.midpoint(self.bounds.1.x), self.bounds.1.y);
        let below = ground.points.iter().min_by(|a, b| (a.x - foot.x).abs().total_cmp(&(b.x - foot.x).abs()));
        below.is_some_and(|below| foot.y > below.y - FLOATS * self.size().y && self.bounds.0.y < below.y)
    }
}

/// What is proposed for plants that are alone on their pages, kept for the next reading of the drawing: each by its strokes,
/// the places among them in place of lines.
pub(super) type Proposals = Kept<Vec<Same<Stroke>>, Arc<Vec<Hypothesis>>>;

/// What is proposed for each of some plants alone, by lines of the whole page.
pub(super) fn proposed(
    known: &mut Proposals,
    plants: &[Plant],
    (page, strokes): (&Page, &[Arc<Stroke>]),
    propose: impl Fn(&Page) -> Vec<Hypothesis> + Sync,
) -> Vec<Hypothesis> {
    let own = |plant: &Plant| -> Vec<Arc<Stroke>> {
        plant.lines.iter().map(|line| Arc::clone(&strokes[page.lines[*line].stroke])).collect()
    };
    let key = |plant: &Plant, used: Use| own(plant).iter().map(|stroke| Same::of(stroke, used)).collect();
    let found = known.made(plants, key, |plant| Arc::new(proposed_alone(&own(plant), &propose)));
    let of_page = |(plant, found): (&Plant, &Arc<Vec<Hypothesis>>)| {
        renumbered(found.to_vec(), |place| plant.lines[place])
    };
    plants.iter().zip(found).flat_map(of_page).collect()
}

/// What is proposed for strokes that are a whole drawing, by their places; nothing unless they are a plant then.
fn proposed_alone(strokes: &[Arc<Stroke>], propose: impl Fn(&Page) -> Vec<Hypothesis>) -> Vec<Hypothesis> {
    let page = Page::new(strokes);
    let found = propose(&page);
    if is_plant(&found) { page.by_strokes(found) } else { Vec::new() }
}

/// Whether what is proposed may be a plant, and not just a leaf or a twig.
pub(super) fn is_plant(proposed: &[Hypothesis]) -> bool {
    proposed.iter().any(|hypothesis| hypothesis.habit.is_some() && hypothesis.score > 0.0)
}

/// The plants of a page from left to right, without what is set apart and without one line more.
pub(super) fn side_by_side(page: &Page, besides: Option<usize>) -> Vec<Plant> {
    let is_looked_at = |i: &usize| !page.is_apart(*i) && Some(*i) != besides;
    let mut order: Vec<usize> = (0..page.lines.len()).filter(is_looked_at).collect();
    order.sort_by(|a, b| page.lines[*a].bounds.0.x.total_cmp(&page.lines[*b].bounds.0.x));
    let gap = GAP * page.diagonal;
    let mut plants: Vec<Plant> = Vec::new();
    for i in order {
        let (low, high) = page.lines[i].bounds;
        match plants.last_mut().filter(|plant| low.x < plant.bounds.1.x + gap) {
            Some(plant) => {
                plant.lines.push(i);
                plant.bounds = (plant.bounds.0.min(low), plant.bounds.1.max(high));
            }
            None => plants.push(Plant { lines: vec![i], bounds: (low, high) }),
        }
    }
    plants.iter_mut().for_each(|plant| plant.lines.sort_unstable());
    plants
}

/// The plants that are small beside the drawing and stand on the ground, if one is drawn, or side by side.
pub(super) fn small(page: &Page, ground: Option<&Line>) -> Vec<Plant> {
    let mut plants = side_by_side(page, None);
    if plants.len() < 2 && ground.is_none() || plants.len() > MOST {
        return Vec::new();
    }
    let tallest = plants.iter().map(|plant| plant.size().y).fold(0.0, f32::max);
    let lowest = plants.iter().map(|plant| plant.bounds.1.y).fold(f32::NEG_INFINITY, f32::max);
    plants.retain(|plant| {
        let stands = ground.map_or(plant.bounds.1.y > lowest - LEVEL * tallest, |line| plant.stands_on(line));
        stands && plant.size().length() < SMALL * page.diagonal && plant.size().y > SPECK * tallest
    });
    plants
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::{ConventionParams, Interpretation, interpret};
    use crate::sketch::{Reading, StrokePoint, Tool};
    use std::f32::consts::{PI, TAU};

    fn line(places: &[(f32, f32)]) -> Vec<Vec2> {
        super::super::page::even(&places.iter().map(|p| Vec2::from(*p)).collect::<Vec<_>>(), 60)
    }

    fn read(lines: &[Vec<Vec2>]) -> Interpretation {
        let stroke = |(id, line): (usize, &Vec<Vec2>)| {
            let points = line.iter().copied().map(StrokePoint::at).collect();
            Arc::new(Stroke { id: id as u64 + 1, tool: Tool::Auto, points, brush: None })
        };
        let strokes: Vec<_> = lines.iter().enumerate().map(stroke).collect();
        interpret(&strokes, &ConventionParams::default())
    }

    /// What was read, in the order of the drawing.
    fn readings(lines: &[Vec<Vec2>]) -> Vec<Reading> {
        let mut read = read(lines).readings;
        read.sort_by_key(|reading| reading.strokes[0]);
        read.into_iter().map(|reading| reading.reading).collect()
    }

    /// Bumps from the ground to the ground.
    fn bush(x: f32, width: f32) -> Vec<Vec<Vec2>> {
        let place = |k: usize| {
            let angle = PI * (1.0 - k as f32 / 80.0);
            let reach = 0.5 * width * (0.88 + 0.12 * (3.5 * angle).sin().abs());
            Vec2::new(x + reach * angle.cos(), -1.1 * reach * angle.sin())
        };
        vec![(0..=80).map(place).collect()]
    }

    /// A corolla with a centre on a stem.
    fn flower(x: f32, height: f32) -> Vec<Vec<Vec2>> {
        let middle = Vec2::new(x, -0.7 * height);
        let ring = |k: usize| {
            let angle = TAU * k as f32 / 120.0;
            middle + 0.3 * height * (0.5 + 0.5 * (2.5 * angle).sin().abs()) * Vec2::from_angle(angle)
        };
        let disc = (0..=40).map(|k| middle + 0.08 * height * Vec2::from_angle(TAU * k as f32 / 40.0));
        vec![line(&[(x, 0.0), (x, -0.55 * height)]), disc.collect(), (0..=120).map(ring).collect()]
    }

    fn ground(width: f32) -> Vec<Vec2> {
        line(&[(-60.0, 0.0), (width, 5.0)])
    }

    #[test]
    fn small_plants_on_the_ground_are_read_as_if_each_were_alone() {
        let garden = [bush(60.0, 110.0), flower(330.0, 120.0), bush(700.0, 130.0)].concat();
        let with_ground = [garden.clone(), vec![ground(2400.0)]].concat();
        let expected = [Reading::Bush, Reading::Corolla, Reading::Bush];
        assert_eq!(readings(&with_ground), [&expected[..], &[Reading::Ground]].concat());
        assert_eq!(readings(&garden), expected, "on the same level without a line");
    }

    #[test]
    fn what_is_read_names_the_strokes_of_the_whole_drawing() {
        let drawn = [vec![ground(2000.0)], flower(60.0, 120.0), bush(500.0, 110.0)].concat();
        let read = read(&drawn);
        let bush = read.readings.iter().find(|reading| reading.reading == Reading::Bush);
        assert_eq!(bush.unwrap().strokes, [5]);
    }

    #[test]
    fn plants_are_parted_by_gaps_from_left_to_right() {
        let drawn = [bush(60.0, 110.0), flower(330.0, 120.0)].concat();
        let plants = side_by_side(&Page::of_lines(&drawn), None);
        let lines: Vec<Vec<usize>> = plants.into_iter().map(|plant| plant.lines).collect();
        assert_eq!(lines, [vec![0], vec![1, 2, 3]]);
    }

    #[test]
    fn what_floats_is_a_speck_or_is_most_of_the_drawing_has_no_page_of_its_own() {
        let tall = line(&[(0.0, 0.0), (0.0, -400.0), (60.0, -400.0), (60.0, 0.0)]);
        let beside = |x: f32, y: f32, size: f32| line(&[(x, y), (x + size, y - size), (x + size, y)]);
        let small = |lines: &[Vec<Vec2>]| small(&Page::of_lines(lines), None).len();
        assert_eq!(small(&[tall.clone(), beside(150.0, 0.0, 100.0)]), 1);
        assert_eq!(small(&[tall.clone(), beside(150.0, -250.0, 100.0)]), 0, "it floats");
        assert_eq!(small(&[tall, beside(150.0, 0.0, 40.0)]), 0, "a speck");
        let row = |count: usize| -> Vec<Vec<Vec2>> {
            (0..count).map(|k| beside(200.0 * k as f32, 0.0, 100.0)).collect()
        };
        assert_eq!((small(&row(MOST)), small(&row(MOST + 1))), (MOST, 0), "a meadow");
    }
}
