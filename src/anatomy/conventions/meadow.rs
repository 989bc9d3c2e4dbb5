//! Meadows: drawings of so many plants that each is read alone, as if it were the whole drawing.
//!
//! Strokes belong to one plant if their bounds, widened by a share of their own diagonals, touch; plants whose bounds lie for
//! the most part inside of each other are one, and so are strokes of which the artist said something together. A drawing is a
//! meadow if it has more than [`FEW`] plants, none of them large beside it, and most of its ink in plants of several strokes.
//! Then nothing is looked for across plants, what is read of a plant is kept as long as its strokes are the same, and one
//! more sample costs the reading of one plant. Cost otherwise: a search for boxes that meet, near-linear in the strokes.
//!
//! Limits: a line under all plants, such as the ground's, makes them one, and the drawing is read as a whole.

use super::hypothesis::{Hypothesis, renumbered};
use super::page::{Page, length_of, root, unite};
use super::plants;
use crate::geom::{bvh, polyline};
use crate::kept::{Kept, Same, Use};
use crate::sketch::{Correction, Stroke, StrokeId};
use glam::{Vec2, Vec3};
use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

/// Most plants of a drawing that is no meadow.
const FEW: usize = 12;
/// How far a stroke reaches beyond its bounds, as a share of their diagonal.
const REACH: f32 = 0.06;
/// Share of the smaller plant's bounds that lies inside of the larger one's where they are one.
const INSIDE: f32 = 0.5;
/// Largest plant of a meadow, as a share of the drawing's diagonal.
const LARGE: f32 = 0.35;
/// Least share of the ink that plants of several strokes have in a meadow.
const WHOLE: f32 = 0.7;
/// Most strokes that are drawn one after the other and searched for together.
const RUN: usize = 16;
/// Most boxes that are compared for each stroke: more stand so close that they are no plants side by side.
const CROWDED: u64 = 256;

/// What is kept of a meadow for its next reading: the sizes of its strokes, and what its plants may be.
#[derive(Debug, Default)]
pub(super) struct Memory {
    sizes: Kept<Same<Stroke>, Option<Size>>,
    plants: Kept<Own, Arc<Vec<Hypothesis>>>,
}

/// The strokes of one plant, and what the artist said of them.
type Own = (Vec<Same<Stroke>>, Vec<Correction>);

impl Memory {
    /// For a single drawing, of which nothing is kept.
    pub(super) fn for_one_build() -> Self {
        Self { sizes: Kept::for_one_call(), plants: Kept::for_one_call() }
    }
}

/// How large some strokes are.
#[derive(Clone, Copy, Debug)]
struct Size {
    bounds: Bounds,
    /// Length of the lines, pixels.
    ink: f32,
}

impl Size {
    /// That of a stroke; nothing if it is none that can be drawn.
    fn of(stroke: &Stroke) -> Option<Self> {
        let ink = length_of(stroke);
        let positions = stroke.points.iter().map(|point| point.position);
        let is_drawn = ink.is_finite() && !stroke.points.is_empty();
        is_drawn.then(|| Self { bounds: polyline::bounds(positions), ink })
    }

    fn with(self, other: Self) -> Self {
        let (a, b) = (self.bounds, other.bounds);
        Self { bounds: (a.0.min(b.0), a.1.max(b.1)), ink: self.ink + other.ink }
    }

    fn diagonal(self) -> f32 {
        self.bounds.0.distance(self.bounds.1)
    }

    /// The bounds and what lies within reach of them.
    fn reach(self) -> Bounds {
        let reach = Vec2::splat(REACH * self.diagonal());
        (self.bounds.0 - reach, self.bounds.1 + reach)
    }
}

/// A plant of a meadow: its strokes, by their places in the drawing, ascending.
type Places = Vec<usize>;

/// What is proposed for a meadow, by the places of strokes, each plant by what `propose` gives for it alone; nothing for any other
/// drawing.
pub(super) fn proposals(
    known: &mut Memory,
    strokes: &[Arc<Stroke>],
    corrections: &[Correction],
    propose: impl Fn(&mut Page, &[Arc<Stroke>], &[Correction]) -> Vec<Hypothesis> + Sync,
) -> Option<Vec<Hypothesis>> {
    let sizes = known.sizes.made(strokes, Same::of, |stroke| Size::of(stroke));
    let plants = plants_of(sizes, &together(strokes, corrections))?;
    let about = of_plants(&plants, strokes, corrections);
    let plants: Vec<(Places, Vec<Correction>)> = plants.into_iter().zip(about).collect();
    let own =
        |places: &Places| -> Vec<Arc<Stroke>> { places.iter().map(|i| Arc::clone(&strokes[*i])).collect() };
    let key = |(places, about): &(Places, Vec<Correction>), used: Use| {
        (places.iter().map(|i| Same::of(&strokes[*i], used)).collect(), about.clone())
    };
    let found =
        known.plants.made(&plants, key, |(places, about)| Arc::new(alone(&own(places), about, &propose)));
    let of_drawing = |((places, _), found): (&(Places, _), &Arc<Vec<Hypothesis>>)| {
        renumbered(found.to_vec(), |place| places[place])
    };
    Some(plants.iter().zip(found).flat_map(of_drawing).collect())
}

/// What is proposed for strokes that are a whole drawing, by their places; nothing unless they are a plant then, or the artist
/// said something of them.
fn alone(
    strokes: &[Arc<Stroke>],
    corrections: &[Correction],
    propose: impl Fn(&mut Page, &[Arc<Stroke>], &[Correction]) -> Vec<Hypothesis>,
) -> Vec<Hypothesis> {
    let mut page = Page::new(strokes);
    let found = propose(&mut page, strokes, corrections);
    if corrections.is_empty() && !plants::is_plant(&found) {
        return Vec::new();
    }
    page.by_strokes(found)
}

/// The plants of a meadow.
fn plants_of(sizes: &[Option<Size>], together: &[Places]) -> Option<Vec<Places>> {
    let whole = sizes.iter().flatten().copied().reduce(Size::with)?;
    let mut leader: Vec<usize> = (0..sizes.len()).collect();
    let strokes: Places = (0..sizes.len()).filter(|i| sizes[*i].is_some()).collect();
    let reach: Vec<Bounds> = sizes.iter().flatten().map(|size| size.reach()).collect();
    unite_where(&mut leader, &strokes, &reach, |_, _| true)?;
    together.iter().flat_map(|them| them.windows(2)).for_each(|pair| unite(&mut leader, pair[0], pair[1]));
    let mut plants = gathered(&mut leader, sizes);
    loop {
        let (firsts, reach): (Places, Vec<_>) =
            plants.iter().map(|(first, _, size)| (*first, size.reach())).unzip();
        if plants.len() <= FEW || !unite_where(&mut leader, &firsts, &reach, is_inside)? {
            break;
        }
        plants = gathered(&mut leader, sizes);
    }
    let in_several: f32 =
        plants.iter().filter(|(_, places, _)| places.len() > 1).map(|(.., size)| size.ink).sum();
    let is_meadow = plants.len() > FEW
        && in_several > WHOLE * whole.ink
        && plants.iter().all(|(.., size)| size.diagonal() < LARGE * whole.diagonal());
    is_meadow.then(|| plants.into_iter().map(|(_, places, _)| places).collect())
}

/// Unites those whose boxes touch where `are_one`; whether there were any, or nothing if they stand too close. What is drawn
/// one after the other mostly stands together, so that only the bounds of runs need a search.
fn unite_where(
    leader: &mut [usize],
    members: &[usize],
    boxes: &[Bounds],
    are_one: impl Fn(Bounds, Bounds) -> bool + Sync,
) -> Option<bool> {
    let are_one = |a: usize, b: usize| touch(boxes[a], boxes[b]) && are_one(boxes[a], boxes[b]);
    let mut runs: Vec<Range<usize>> = Vec::new();
    for i in 0..boxes.len() {
        match runs.last_mut().filter(|run| run.len() < RUN && are_one(i - 1, i)) {
            Some(run) => run.end = i + 1,
            None => runs.push(i..i + 1),
        }
    }
    let around = |run: &Range<usize>| {
        let whole = boxes[run.clone()].iter().copied().reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
        whole.map_or((Vec3::ZERO, Vec3::ZERO), |(low, high)| (low.extend(0.0), high.extend(0.0)))
    };
    let bounds: Vec<bvh::Bounds> = runs.iter().map(around).collect();
    let meet = |a: usize, b: usize| {
        let mut pairs = runs[a].clone().flat_map(|i| runs[b].clone().map(move |k| (i, k)));
        pairs.find(|(i, k)| are_one(*i, *k))
    };
    let mut pairs = bvh::overlapping_within(CROWDED * boxes.len() as u64, &bounds, meet)?;
    pairs.extend(runs.iter().flat_map(|run| (run.start..run.end - 1).map(|i| (i, i + 1))));
    pairs.iter().for_each(|(a, b)| unite(leader, members[*a], members[*b]));
    Some(!pairs.is_empty())
}

/// Smallest and largest corner.
type Bounds = (Vec2, Vec2);

fn touch(a: Bounds, b: Bounds) -> bool {
    a.0.cmple(b.1).all() && b.0.cmple(a.1).all()
}

/// Whether the smaller of two boxes lies for the most part in the other.
fn is_inside(a: Bounds, b: Bounds) -> bool {
    let area = |(low, high): Bounds| (high - low).max(Vec2::ZERO).element_product();
    area((a.0.max(b.0), a.1.min(b.1))) > INSIDE * area(a).min(area(b))
}

/// The members of each group with the first of them and their size.
fn gathered(leader: &mut [usize], sizes: &[Option<Size>]) -> Vec<(usize, Places, Size)> {
    let mut group_of = vec![usize::MAX; sizes.len()];
    let mut groups: Vec<(usize, Places, Size)> = Vec::new();
    for (i, size) in sizes.iter().enumerate() {
        let Some(size) = *size else { continue };
        let first = root(leader, i);
        match groups.get_mut(group_of[first]) {
            Some((_, places, whole)) => {
                places.push(i);
                *whole = whole.with(size);
            }
            None => {
                group_of[first] = groups.len();
                groups.push((first, vec![i], size));
            }
        }
    }
    groups
}

/// The places of strokes of which the artist said something together.
fn together(strokes: &[Arc<Stroke>], corrections: &[Correction]) -> Vec<Places> {
    if corrections.is_empty() {
        return Vec::new();
    }
    let place_of: HashMap<StrokeId, usize> =
        strokes.iter().enumerate().map(|(i, stroke)| (stroke.id, i)).collect();
    let places = |correction: &Correction| {
        correction.strokes.iter().filter_map(|id| place_of.get(id).copied()).collect()
    };
    corrections.iter().map(places).collect()
}

/// What the artist said of each plant, oldest first.
fn of_plants(plants: &[Places], strokes: &[Arc<Stroke>], corrections: &[Correction]) -> Vec<Vec<Correction>> {
    let mut about = vec![Vec::new(); plants.len()];
    if corrections.is_empty() {
        return about;
    }
    let plant_of: HashMap<StrokeId, usize> = plants
        .iter()
        .enumerate()
        .flat_map(|(plant, places)| places.iter().map(move |i| (strokes[*i].id, plant)))
        .collect();
    for correction in corrections {
        if let Some(plant) = correction.strokes.iter().find_map(|id| plant_of.get(id)) {
            about[*plant].push(correction.clone());
        }
    }
    about
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::{
        self, ConventionParams, Habit, Interpretation, interpret, interpret_with, strokes,
    };
    use crate::sketch::{Reading, Verdict};
    use std::f32::consts::TAU;

    /// A corolla with a centre on a stem.
    fn flower(foot: Vec2) -> Vec<Vec<Vec2>> {
        let middle = foot - Vec2::new(0.0, 84.0);
        let ring = |k: usize| {
            let angle = TAU * k as f32 / 120.0;
            middle + 36.0 * (0.5 + 0.5 * (2.5 * angle).sin().abs()) * Vec2::from_angle(angle)
        };
        let disc = (0..=40).map(|k| middle + 10.0 * Vec2::from_angle(TAU * k as f32 / 40.0));
        let stem = (0..=30).map(|k| foot - Vec2::new(0.0, 66.0 * k as f32 / 30.0));
        vec![stem.collect(), disc.collect(), (0..=120).map(ring).collect()]
    }

    /// Flowers in rows of five.
    fn meadow(flowers: usize) -> Vec<Vec<Vec2>> {
        let foot = |k: usize| Vec2::new((k % 5) as f32 * 110.0, (k / 5) as f32 * 160.0);
        (0..flowers).flat_map(|k| flower(foot(k))).collect()
    }

    fn plants_in(lines: &[Vec<Vec2>]) -> Option<usize> {
        let sizes: Vec<_> = strokes(lines).iter().map(|stroke| Size::of(stroke)).collect();
        plants_of(&sizes, &[]).map(|plants| plants.len())
    }

    fn corollas(read: &Interpretation) -> usize {
        read.readings.iter().filter(|r| r.reading == Reading::Corolla).count()
    }

    #[test]
    fn each_flower_of_a_meadow_is_read_as_if_it_were_alone() {
        assert_eq!(plants_in(&meadow(14)), Some(14));
        assert_eq!(corollas(&interpret(&strokes(&meadow(14)), &ConventionParams::default())), 14);
    }

    #[test]
    fn one_plant_of_a_kind_among_hundreds_does_not_say_what_the_meadow_is() {
        let branch = |k: usize| {
            let foot = Vec2::new((k % 30) as f32 * 110.0, (k / 30) as f32 * 160.0);
            let side = |way: f32| vec![foot + Vec2::new(0.0, -40.0), foot + Vec2::new(25.0 * way, -75.0)];
            vec![
                vec![foot, foot + Vec2::new(2.0, -50.0), foot + Vec2::new(0.0, -90.0)],
                side(1.0),
                side(-1.0),
            ]
        };
        let habit = |bare: usize| {
            let lines = [flower(Vec2::new(-200.0, 0.0)), (0..bare).flat_map(branch).collect()].concat();
            interpret(&strokes(&lines), &ConventionParams::default()).habit
        };
        assert_eq!(habit(20), Some(Habit::Flower));
        assert_eq!(habit(240), None);
    }

    #[test]
    fn few_plants_and_the_parts_of_one_are_no_meadow() {
        assert_eq!(plants_in(&meadow(FEW)), None);
        let leaf = |k: usize| {
            let place = 100.0 * Vec2::new((k % 6) as f32, (k / 6) as f32);
            (0..=20).map(|k| place + 15.0 * Vec2::from_angle(TAU * k as f32 / 20.0)).collect()
        };
        let mut tree: Vec<Vec<Vec2>> = (0..30).map(leaf).collect();
        assert_eq!(plants_in(&tree), None, "single strokes are not plants");
        tree.push((0..=40).map(|k| Vec2::new(250.0, 20.0 * k as f32)).collect());
        assert_eq!(plants_in(&tree), None, "a trunk is large beside the drawing");
    }

    #[test]
    fn a_stroke_across_all_plants_makes_them_one() {
        let ground = (0..=60).map(|k| Vec2::new(10.0 * k as f32 - 50.0, 160.0)).collect();
        assert_eq!(plants_in(&[meadow(14), vec![ground]].concat()), None);
    }

    #[test]
    fn what_is_kept_is_what_would_be_read_anew() {
        let (mut known, params) = (conventions::Memory::default(), ConventionParams::default());
        let mut drawn = strokes(&meadow(14));
        let mut check = |drawn: &[Arc<Stroke>], corrections: &[Correction]| {
            let corrections = corrections.into();
            let kept = interpret_with(&mut known, drawn, &corrections, &params);
            let anew =
                interpret_with(&mut conventions::Memory::for_one_build(), drawn, &corrections, &params);
            assert_eq!(kept, anew);
            corollas(&kept)
        };
        assert_eq!(check(&drawn, &[]), 14);
        let gone = drawn.remove(5);
        assert_eq!(check(&drawn, &[]), 13);
        drawn.insert(0, gone);
        assert_eq!(check(&drawn, &[]), 14);
        let separate = Correction::new([6, 7, 8], Verdict::Separate);
        assert_eq!(check(&drawn, &[separate]), 13);
        assert_eq!(check(&drawn, &[]), 14);
    }

    #[test]
    fn what_the_artist_takes_together_is_one_plant() {
        let drawn = strokes(&meadow(14));
        let sizes: Vec<_> = drawn.iter().map(|stroke| Size::of(stroke)).collect();
        let two = Correction::new([0, 1, 2, 3, 4, 5], Verdict::As(Reading::Tree));
        let plants = plants_of(&sizes, &together(&drawn, &[two])).unwrap();
        assert_eq!((plants.len(), &plants[0][..]), (13, &[0, 1, 2, 3, 4, 5][..]));
    }
}
