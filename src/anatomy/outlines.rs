//! Outlines filled: branch outlines with twigs, then leaf outlines with leaves on all that is there by then.
//!
//! From one drawing to the next, what grew from each growth point is kept: see [`Recall`](super::recall::Recall). Without a
//! change of the outline, of its leaves' length or of the drawing's scale, only what grows near changed wood grows anew.

use super::{
    Anatomy, FlatBlade, Part, Sample, Stop,
    fill_leaves::{LeafFill, LeafFillParams, Leaves, Templates},
    fill_twigs::{Growth, TwigFill, TwigParams, Twigs},
    growth_points::Forest,
    leaf_twigs::{LeafTwigParams, LeafTwigs, Ways},
    reading::Reading,
};
use crate::budget::Budget;
use crate::geom::region::Region;
use crate::kept::{Same, Use};
use crate::sketch::warnings::Warnings;
use crate::sketch::{Remark, StrokeId};
use std::collections::HashMap;
use std::sync::Arc;

/// What is kept of the outlines of one drawing for the next, all filled with the same parameters.
#[derive(Debug, Default)]
pub(super) struct Outlines(Vec<Filled>);

/// What is kept of one outline.
#[derive(Debug)]
struct Filled {
    samples: Same<[Sample]>,
    region: Region,
    /// What everything in it grew by, beside the parameters: seed, diagonal, length and number of leaves to copy.
    rule: [u64; 4],
    twigs: Twigs,
    ways: Ways,
    leaves: Leaves,
}

/// How the outlines of a drawing are filled.
pub(super) struct Fill<'a> {
    /// The drawing's strokes.
    pub(super) readings: &'a [Arc<Reading>],
    /// Seed of everything random.
    pub(super) seed: u64,
    /// How branch outlines are filled with twigs.
    pub(super) twigs: &'a TwigParams,
    /// The twigs that carry the leaves of leaf outlines.
    pub(super) leaf_twigs: &'a LeafTwigParams,
    /// How leaf outlines are filled with leaves.
    pub(super) leaf_fill: &'a LeafFillParams,
    /// Nothing grows any more once it says yes.
    pub(super) stop: Stop<'a>,
}

impl Fill<'_> {
    /// Fills all outlines.
    pub(super) fn fill(&self, known: &mut Outlines, anatomy: &mut Anatomy, warnings: &mut Warnings) {
        let is_outline = |r: &&Arc<Reading>| matches!(r.part, Part::BranchOutline | Part::LeafOutline);
        let outlines: Vec<&Arc<Reading>> = self.readings.iter().filter(is_outline).collect();
        if outlines.is_empty() {
            known.0.clear();
            return;
        }
        known.arrange(&outlines);
        let mut forest = Forest::new(std::mem::take(&mut anatomy.branches));
        let filled = || outlines.iter().zip(0..);
        for (reading, i) in filled().filter(|(r, _)| r.part == Part::BranchOutline) {
            let filled = &mut known.0[i];
            filled.begin([self.seed, bits(anatomy.diagonal), 0, 0]);
            let growth = self.with_twigs(reading.id, anatomy.diagonal, filled, &mut forest);
            growth.into_iter().for_each(|remark| warnings.add(Some(reading.id), || remark.clone()));
        }
        let of_leaves = filled().filter(|(r, _)| r.part == Part::LeafOutline);
        self.with_leaves(of_leaves.map(|(r, i)| (r.id, i)).collect(), known, &mut forest, anatomy, warnings);
        anatomy.branches = forest.into_branches();
        if !(self.stop)() {
            known.0.iter_mut().for_each(Filled::finish);
        }
    }

    /// Fills a branch outline; gives what there is to remark.
    fn with_twigs(
        &self,
        outline: StrokeId,
        diagonal: f32,
        Filled { region, twigs, .. }: &mut Filled,
        forest: &mut Forest,
    ) -> Option<Remark> {
        let (seed, params, stop) = (self.seed, self.twigs, self.stop);
        shortfall(TwigFill { outline, region, diagonal, seed, params, stop }.fill(forest, twigs))
    }

    /// Fills the leaf outlines of these strokes, each with its place in what is kept.
    fn with_leaves(
        &self,
        outlines: Vec<(StrokeId, usize)>,
        known: &mut Outlines,
        forest: &mut Forest,
        anatomy: &mut Anatomy,
        warnings: &mut Warnings,
    ) {
        let (seed, diagonal, stop) = (self.seed, anatomy.diagonal, self.stop);
        if outlines.is_empty() {
            return;
        }
        let templates = &Templates::new(&anatomy.leaves, diagonal, self.leaf_fill);
        let mut room = (self.leaf_fill.max_leaves as usize).min(Budget::PLANT.leaves);
        let count = outlines.len();
        for (number, (outline, i)) in outlines.into_iter().enumerate() {
            let filled = &mut known.0[i];
            filled.begin([seed, bits(diagonal), bits(templates.length), templates.outlines.len() as u64]);
            let Filled { region, ways, leaves: kept, .. } = filled;
            let (leaf_length, params) = (templates.length, self.leaf_twigs);
            let all_twigs =
                LeafTwigs { outline, region, leaf_length, diagonal, seed, params, stop }.grow(forest, ways);
            let params = self.leaf_fill;
            let fill = LeafFill { outline, region, templates, diagonal, seed, params, stop };
            // What an outline leaves of its share goes to those after it.
            let (leaves, thinned): (Vec<FlatBlade>, bool) = fill.fill(forest, room / (count - number), kept);
            room -= leaves.len();
            anatomy.leaves.extend(leaves);
            if thinned || !all_twigs {
                warnings.add(Some(outline), || Remark::FilledThinly);
            }
        }
        if anatomy.leaves.iter().any(|leaf| leaf.copy_of.is_some()) {
            anatomy.templates.clone_from(&templates.outlines);
        }
    }
}

impl Outlines {
    /// Brings what is kept into the order of the outlines; what is kept of no outline is forgotten.
    fn arrange(&mut self, outlines: &[&Arc<Reading>]) {
        let old = std::mem::take(&mut self.0);
        let mut old: HashMap<Same<[Sample]>, Filled> =
            old.into_iter().map(|filled| (filled.samples.clone(), filled)).collect();
        let filled = |reading: &&Arc<Reading>| {
            let samples = Same::of(&reading.samples, Use::Keeping);
            old.remove(&samples).unwrap_or_else(|| Filled::new(samples, reading))
        };
        self.0 = outlines.iter().map(filled).collect();
    }
}

impl Filled {
    fn new(samples: Same<[Sample]>, reading: &Reading) -> Self {
        let region = Region::new(reading.samples.iter().map(|s| s.position).collect());
        let (twigs, ways, leaves) = Default::default();
        Self { samples, region, rule: [0; 4], twigs, ways, leaves }
    }

    /// Begins to fill it by a rule; what grew by another is of no use.
    fn begin(&mut self, rule: [u64; 4]) {
        let holds = rule == self.rule;
        self.rule = rule;
        self.twigs.begin(holds);
        self.ways.begin(holds);
        self.leaves.begin(holds);
    }

    fn finish(&mut self) {
        self.twigs.finish();
        self.ways.finish();
        self.leaves.finish();
    }
}

fn bits(value: f32) -> u64 {
    value.to_bits().into()
}

/// Why an outline has fewer twigs than it asks for.
fn shortfall(growth: Growth) -> Option<Remark> {
    match growth {
        Growth::Full => None,
        Growth::Capped => Some(Remark::FewTwigs),
        Growth::NoBranch => Some(Remark::NoBranch),
        Growth::NoRoom => Some(Remark::NoRoom),
    }
}
