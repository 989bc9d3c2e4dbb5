//! Which pixels of a photograph are plant: colours of the plant and of its surroundings, and the cheapest border between them.
//!
//! GrabCut (Rother, Kolmogorov and Blake, *“GrabCut”: interactive foreground extraction using iterated graph cuts*, 2004), with what
//! photographs of plants need. Two [`Mixture`]s say how likely a colour is in the plant and around it; a border costs less where
//! colours differ from pixel to pixel; the cheapest labelling is found by [`min_cut`](super::min_cut), the mixtures are fitted to
//! it, and so on for a few rounds or until nothing changes. What is known from marks stays as it is, and marked pixels count more in
//! the colours, so that a short line can bring in a colour of its own.
//!
//! Where the border shows the surroundings, they are known by height as well ([`Rows`]).
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
use super::rows::Rows;
use rayon::prelude::*;

/// Distributions of each mixture.
const PARTS: usize = 5;
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
    let mut models = Models::of(lab, known)?;
    let edges = Edges::of(lab, params.smoothness);
    let mut label: Option<Raster<bool>> = None;
    for _ in 0..params.rounds {
        let next = cut(lab, known, &models, &edges);
        if label.as_ref() == Some(&next) {
            break;
        }
        for (mixture, side) in [(&mut models.plant, true), (&mut models.around, false)] {
            let own = colours(lab, known, |i| next.cells()[i] == side, side);
            *mixture = mixture.fitted(&own).unwrap_or_else(|| mixture.clone());
        }
        label = Some(next);
    }
    let mask = label?;
    let inside = (0..lab.cells().len()).filter(|i| mask.cells()[*i]);
    let (sum, count) = inside.fold((0.0, 0u32), |(sum, n), i| (sum + f64::from(models.gain(lab, i)), n + 1));
    Some(Found { mask, contrast: (sum / f64::from(count.max(1))) as f32 })
}

/// Colours of the plant and of its surroundings.
struct Models {
    plant: Mixture,
    around: Mixture,
    /// The surroundings by height, where the border shows them.
    rows: Option<Rows>,
}

impl Models {
    /// The first ones; `None` where nothing is known to begin with.
    fn of(lab: &Raster<Lab>, known: &Known) -> Option<Self> {
        let is_around = |i: usize| known.is_plant.cells()[i] == Some(false);
        let around = Mixture::of(&colours(lab, known, is_around, false), PARTS)?;
        let rows = known.band.map(|band| Rows::of(lab, is_around, band));
        let mut models = Self { plant: around.clone(), around, rows };
        let first = first_plant(lab, known, &models);
        models.plant = Mixture::of(&colours(lab, known, |i| first[i], true), PARTS)?;
        Some(models)
    }

    /// How unlikely a pixel is in the surroundings.
    fn cost_around(&self, lab: &Raster<Lab>, pixel: usize) -> f32 {
        let colour = lab.cells()[pixel];
        let anywhere = self.around.cost(colour);
        self.rows.as_ref().map_or(anywhere, |rows| rows.cost(pixel, colour).min(anywhere))
    }

    /// By how much a pixel is likelier in the plant than around it, nats.
    fn gain(&self, lab: &Raster<Lab>, pixel: usize) -> f32 {
        (self.cost_around(lab, pixel) - self.plant.cost(lab.cells()[pixel])).clamp(-SURE, SURE)
    }
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
fn first_plant(lab: &Raster<Lab>, known: &Known, models: &Models) -> Vec<bool> {
    let cost = |i: usize| models.cost_around(lab, i);
    let costs: Vec<f32> = (0..lab.cells().len()).into_par_iter().with_min_len(1 << 12).map(cost).collect();
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

fn cut(lab: &Raster<Lab>, known: &Known, models: &Models, edges: &Edges) -> Raster<bool> {
    let mut grid = Grid::new(lab.width(), lab.height());
    let pull = |i: usize| match known.is_plant.cells()[i] {
        Some(true) => KNOWN,
        Some(false) => -KNOWN,
        None => (UNIT * models.gain(lab, i)) as i32,
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
