//! Which pixels of a photograph are plant: colours of the plant and of its surroundings, and the cheapest border between them.
//!
//! GrabCut (Rother, Kolmogorov and Blake, *“GrabCut”: interactive foreground extraction using iterated graph cuts*, 2004), with what
//! photographs of plants need. Two [`Mixture`]s say how likely a colour is in the plant and around it; a border costs less where
//! colours differ from pixel to pixel; the cheapest labelling is found by [`min_cut`](super::min_cut), the mixtures are fitted to
//! it, and so on for a few rounds or until nothing changes. What is known from marks stays as it is, and marked pixels count more in
//! the colours, so that a short line can bring in a colour of its own.
//!
//! To begin with, the plant is what is unlikely in the surroundings; where nothing is, it is the middle of what is not known.
//!
//! Limits: what has the surroundings' colours and no edge against them, such as a crown before a wood, needs marks. Crowns
//! are seen as bodies: sky between single leaves is mostly taken with them.

use super::super::lab::Lab;
use super::super::raster::Raster;
use super::PlantParams;
use super::marks::Known;
use super::min_cut::{AROUND, Grid};
use super::mixture::Mixture;
use super::regions::{narrowed, widened};
use rayon::prelude::*;

/// Capacities for one unit of cost.
const UNIT: f32 = 64.0;
/// Most that colours speak for one side: beyond, a pixel is as sure as can be.
const SURE: f32 = 40.0;
/// What is known costs more than any border around it.
const KNOWN: i32 = 1 << 27;
/// Share of the surroundings that is no unlikelier than where the plant begins.
const USUAL: f32 = 0.98;
/// And by how much the plant is unlikelier, nats.
const UNLIKELIER: f32 = 2.0;
/// Least share of what is not known that must be unlikely in the surroundings to be the plant at first.
const FOUND: f32 = 0.01;
/// How much all marked pixels of a side count at least, as a share of all of that side.
const MARKED: f32 = 0.25;

/// What was found.
pub(super) struct Found {
    /// Whether a pixel is plant.
    pub(super) mask: Raster<bool>,
    /// By how much the plant's pixels are likelier in its colours than in those of its surroundings, nats, on the mean.
    pub(super) contrast: f32,
}

/// Finds the plant; `None` where there is nothing that it or its surroundings could be known by.
pub(super) fn plant(lab: &Raster<Lab>, known: &Known, params: &PlantParams) -> Option<Found> {
    let around: Vec<(Lab, f32)> = colours(lab, known, |i| known.is_plant.cells()[i] == Some(false), false);
    let mut mixtures = {
        let around = Mixture::of(&around)?;
        let first = first_plant(lab, known, &around);
        let plant = Mixture::of(&colours(lab, known, |i| first[i], true))?;
        [plant, around]
    };
    let edges = Edges::of(lab, params.smoothness);
    let mut label: Option<Raster<bool>> = None;
    for _ in 0..params.rounds {
        let next = cut(lab, known, &mixtures, &edges);
        if label.as_ref() == Some(&next) {
            break;
        }
        for (mixture, side) in mixtures.iter_mut().zip([true, false]) {
            let own = colours(lab, known, |i| next.cells()[i] == side, side);
            *mixture = mixture.fitted(&own).unwrap_or_else(|| mixture.clone());
        }
        label = Some(next);
    }
    let mask = label?;
    let contrast = contrast(lab, &mask, &mixtures);
    Some(Found { mask, contrast })
}

fn contrast(lab: &Raster<Lab>, mask: &Raster<bool>, [plant, around]: &[Mixture; 2]) -> f32 {
    let inside = lab.cells().iter().zip(mask.cells()).filter(|(_, is_in)| **is_in);
    let by = |colour: Lab| f64::from((around.cost(colour) - plant.cost(colour)).clamp(-SURE, SURE));
    let (sum, count) = inside.fold((0.0, 0u32), |(sum, n), (colour, _)| (sum + by(*colour), n + 1));
    (sum / f64::from(count.max(1))) as f32
}

/// Colours of the pixels of a side, with how much each counts.
fn colours(lab: &Raster<Lab>, known: &Known, is_in: impl Fn(usize) -> bool, side: bool) -> Vec<(Lab, f32)> {
    let is_marked = |i: &usize| known.is_marked.cells()[*i] && known.is_plant.cells()[*i] == Some(side);
    let is_near = |i: &usize| known.is_near.cells()[*i] || is_marked(i);
    let pixels: Vec<usize> = (0..lab.cells().len()).filter(|i| is_in(*i) && is_near(i)).collect();
    let marked = pixels.iter().filter(|i| is_marked(i)).count().max(1);
    let counts = (MARKED * pixels.len() as f32 / marked as f32).max(1.0);
    pixels.iter().map(|i| (lab.cells()[*i], if is_marked(i) { counts } else { 1.0 })).collect()
}

/// What of the picture is not like the surroundings.
fn first_plant(lab: &Raster<Lab>, known: &Known, around: &Mixture) -> Vec<bool> {
    let costs: Vec<f32> =
        lab.cells().par_iter().with_min_len(1 << 12).map(|colour| around.cost(*colour)).collect();
    let is_plant = known.is_plant.cells();
    let is_known = |i: &usize| is_plant[*i] == Some(false) && known.is_near.cells()[*i];
    let usual = (0..costs.len()).filter(is_known).map(|i| costs[i]).collect();
    let usual = super::super::background::quantile(usual, USUAL) + UNLIKELIER;
    let open = is_plant.iter().filter(|known| known.is_none()).count();
    let first = |i: usize| match is_plant[i] {
        None => costs[i] > usual,
        Some(is_plant) => is_plant,
    };
    let found = Raster::new(lab.width(), (0..costs.len()).map(first).collect());
    // Single pixels are unlikely anywhere; of them no colours of the plant are learned, as long as there is anything else.
    for found in [widened(&narrowed(&found, 1), 1), found] {
        let count = (0..costs.len()).filter(|i| is_plant[*i].is_none() && found.cells()[*i]).count();
        if count as f32 >= (FOUND * open as f32).max(16.0) {
            let within = |i: usize| is_plant[i].unwrap_or(found.cells()[i]);
            return (0..costs.len()).map(within).collect();
        }
    }
    let half = 0.5 * lab.size().as_vec2();
    let is_middle = |i: usize| ((lab.middle(i) - half) / half).length() < 0.6;
    (0..costs.len()).map(|i| is_plant[i].unwrap_or_else(|| is_middle(i))).collect()
}

/// What a border costs from every pixel to the four neighbours after it.
struct Edges([Vec<i32>; 4]);

impl Edges {
    fn of(lab: &Raster<Lab>, smoothness: f32) -> Self {
        let width = lab.width() as i32;
        let neighbour = |i: usize, direction: usize| {
            let (x, y) = AROUND[direction];
            let column = i as i32 % width + x;
            let other = i + (y * width + x) as usize;
            ((0..width).contains(&column) && other < lab.cells().len()).then_some(other)
        };
        let step = |i: usize, direction: usize| {
            neighbour(i, direction).map(|other| lab.cells()[i].distance_squared(lab.cells()[other]))
        };
        let (mut sum, mut count) = (0.0f64, 0u32);
        for i in 0..lab.cells().len() {
            for squared in (4..8).filter_map(|direction| step(i, direction)) {
                sum += f64::from(squared);
                count += 1;
            }
        }
        let falling = 1.0 / (2.0 * (sum / f64::from(count.max(1))) as f32).max(1e-3);
        let costs = |direction: usize| {
            let (x, y) = AROUND[direction];
            let near = smoothness / ((x * x + y * y) as f32).sqrt();
            let cost = |i: usize| {
                step(i, direction).map_or(-1, |squared| (UNIT * near * (-falling * squared).exp()) as i32)
            };
            (0..lab.cells().len()).into_par_iter().with_min_len(1 << 12).map(cost).collect()
        };
        Self([4, 5, 6, 7].map(costs))
    }
}

fn cut(lab: &Raster<Lab>, known: &Known, [plant, around]: &[Mixture; 2], edges: &Edges) -> Raster<bool> {
    let mut grid = Grid::new(lab.width(), lab.height());
    let pull = |i: usize| match known.is_plant.cells()[i] {
        Some(true) => KNOWN,
        Some(false) => -KNOWN,
        None => {
            let colour = lab.cells()[i];
            (UNIT * (around.cost(colour) - plant.cost(colour)).clamp(-SURE, SURE)) as i32
        }
    };
    let pulls: Vec<i32> = (0..lab.cells().len()).into_par_iter().with_min_len(1 << 12).map(pull).collect();
    pulls.iter().enumerate().for_each(|(pixel, by)| grid.pull(pixel, *by));
    for (costs, direction) in edges.0.iter().zip(4..) {
        for (pixel, cost) in costs.iter().enumerate().filter(|(_, cost)| **cost >= 0) {
            grid.join(pixel, direction, *cost);
        }
    }
    Raster::new(lab.width(), grid.cut(lab.height()))
}
