//! The whole analysis: strokes in, anatomy out.

use super::{
    Anatomy, FlatBlade, Mark, Part, Sample,
    attach::{AttachParams, Branches},
    blade_outline::{self, TipParams},
    classify::Classifier,
    fill_leaves::{LeafFill, LeafFillParams, Templates},
    fill_twigs::{TwigFill, TwigParams},
    flowers::{self, FlowerParams},
    hierarchy::{self, HierarchyParams},
    leaf_twigs::{LeafTwigParams, LeafTwigs},
    preprocess::{PreprocessParams, preprocess},
};
use crate::geom::{polyline, region::Region};
use crate::sketch::{Sketch, Stroke, StrokeId, Tool, Warning};
use glam::Vec2;
use rayon::prelude::*;

crate::parameter_groups! {
    /// Everything that decides what a drawing means.
    pub struct AnatomyParams {
        /// Resampling and smoothing.
        preprocess: PreprocessParams;
        /// Which strokes are too small to mean anything.
        ignore: IgnoreParams;
        /// Tips of blades.
        tip: TipParams;
        /// Petals to flowers.
        flowers: FlowerParams;
        /// Branches to a hierarchy.
        hierarchy: HierarchyParams;
        /// Leaves and flowers to branches.
        attach: AttachParams;
        /// Twigs inside branch outlines.
        twigs: TwigParams;
        /// Twigs that carry the leaves of leaf outlines.
        leaf_twigs: LeafTwigParams;
        /// Leaves inside leaf outlines.
        leaf_fill: LeafFillParams;
    }
}

crate::parameters! {
    /// Which strokes are too small to mean anything.
    pub struct IgnoreParams {
        /// Shorter strokes are skipped with a warning.
        shorter_than: f32 = 0.004, 0.0..=0.1, "of the drawing's diagonal";
    }
}

/// A stroke on its way through the analysis.
struct Reading {
    id: StrokeId,
    tool: Tool,
    samples: Vec<Sample>,
    part: Part,
    confidence: f32,
    /// The blade, where the stroke is one.
    blade: Option<FlatBlade>,
    warning: Option<&'static str>,
}

/// Finds out what every stroke is and how the parts hang together; generates what outlines ask for.
pub fn analyse(sketch: &Sketch, params: &AnatomyParams) -> Anatomy {
    let diagonal = sketch.diagonal();
    let readings: Vec<Reading> = sketch
        .strokes
        .par_iter()
        .with_min_len(16)
        .map(|stroke| read_stroke(stroke, diagonal, params))
        .collect();

    let mut anatomy = Anatomy { diagonal, bounds: sketch.bounds().unwrap_or_default(), ..Anatomy::default() };
    anatomy.warnings = readings.iter().filter_map(Reading::warning).collect();
    let lines = readings.iter().filter(|r| r.part == Part::Branch).map(|r| (Some(r.id), r.samples.clone()));
    anatomy.branches = hierarchy::arrange(lines.collect(), diagonal, &params.hierarchy);
    let blades = readings.iter().filter_map(|r| r.blade.clone().map(|blade| (blade, r.tool))).collect();
    let gathering = flowers::gather(blades, &params.flowers);
    (anatomy.petals, anatomy.flowers, anatomy.leaves) =
        (gathering.petals, gathering.flowers, gathering.leaves);
    attach_organs(&mut anatomy, &params.attach);
    fill_outlines(&mut anatomy, &readings, sketch.seed, params);
    anatomy.marks = marks(&readings, &anatomy.petals, &gathering.hearts);
    anatomy
}

/// Evens out one stroke and decides what it is.
fn read_stroke(stroke: &Stroke, diagonal: f32, params: &AnatomyParams) -> Reading {
    let samples = preprocess(&stroke.points, diagonal, &params.preprocess);
    let (id, tool) = (stroke.id, stroke.tool);
    let reading = |samples, part, confidence, blade, warning| Reading {
        id,
        tool,
        samples,
        part,
        confidence,
        blade,
        warning,
    };
    let positions: Vec<Vec2> = samples.iter().map(|s| s.position).collect();
    if samples.len() < 2 || polyline::length(&positions) < params.ignore.shorter_than * diagonal {
        return reading(
            samples,
            Part::Ignored,
            1.0,
            None,
            Some("is too short to mean anything and was skipped"),
        );
    }
    let (is_blade, confidence) = match tool {
        Tool::Branch => (false, 1.0),
        Tool::BranchOutline => return reading(samples, Part::BranchOutline, 1.0, None, None),
        Tool::LeafOutline => return reading(samples, Part::LeafOutline, 1.0, None, None),
        Tool::Petal | Tool::Leaf => (true, 1.0),
        Tool::Auto => {
            let verdict = Classifier::built_in().classify(&positions);
            (verdict.blade, verdict.confidence)
        }
    };
    if !is_blade {
        return reading(samples, Part::Branch, confidence, None, None);
    }
    match blade_outline::blade(id, &samples, &params.tip) {
        Some(blade) => reading(samples, Part::Leaf, confidence, Some(blade), None),
        None if tool == Tool::Auto => reading(samples, Part::Branch, 0.5, None, None),
        None => {
            reading(samples, Part::Ignored, 1.0, None, Some("encloses nothing and was skipped as a blade"))
        }
    }
}

impl Reading {
    fn warning(&self) -> Option<Warning> {
        self.warning.map(|message| Warning { stroke: Some(self.id), message: message.to_owned() })
    }
}

fn attach_organs(anatomy: &mut Anatomy, params: &AttachParams) {
    let branches = Branches::new(&anatomy.branches);
    for leaf in &mut anatomy.leaves {
        branches.attach_leaf(leaf, params);
    }
    for flower in &mut anatomy.flowers {
        let longest = flower.petals.iter().map(|&p| anatomy.petals[p].axis().length()).fold(0.0, f32::max);
        branches.attach_flower(flower, longest, params);
    }
}

/// Fills branch outlines with twigs, then leaf outlines with leaves on all that is there by then.
fn fill_outlines(anatomy: &mut Anatomy, readings: &[Reading], seed: u64, params: &AnatomyParams) {
    let diagonal = anatomy.diagonal;
    let outlines = |part: Part| {
        readings
            .iter()
            .filter(move |r| r.part == part)
            .map(|r| (r.id, Region::new(r.samples.iter().map(|s| s.position).collect())))
    };
    for (id, region) in outlines(Part::BranchOutline) {
        let before = anatomy.branches.len();
        let fill = TwigFill { region: &region, diagonal, seed: seed ^ id, params: &params.twigs };
        fill.fill(&mut anatomy.branches);
        if anatomy.branches.len() == before {
            let message = "no branch runs through this outline, so no twig could grow in it".to_owned();
            anatomy.warnings.push(Warning { stroke: Some(id), message });
        }
    }
    let templates = Templates::new(&anatomy.leaves, diagonal, &params.leaf_fill);
    for (id, region) in outlines(Part::LeafOutline) {
        let twigs = LeafTwigs {
            region: &region,
            leaf_length: templates.length,
            seed: seed ^ id,
            params: &params.leaf_twigs,
        };
        twigs.grow(&mut anatomy.branches);
        let params = &params.leaf_fill;
        let fill = LeafFill { region: &region, templates: &templates, diagonal, seed: seed ^ id, params };
        anatomy.leaves.extend(fill.fill(&anatomy.branches));
    }
    if anatomy.leaves.iter().any(|leaf| leaf.copy_of.is_some()) {
        anatomy.templates = templates.outlines;
    }
}

/// The verdicts in drawing order; blades that gathered to flowers are petals.
fn marks(readings: &[Reading], petals: &[FlatBlade], hearts: &[StrokeId]) -> Vec<Mark> {
    let mut petal_ids: Vec<StrokeId> = petals.iter().filter_map(|p| p.stroke).collect();
    petal_ids.sort_unstable();
    let part = |r: &Reading| match r.part {
        Part::Leaf if petal_ids.binary_search(&r.id).is_ok() => Part::Petal,
        Part::Leaf if hearts.contains(&r.id) => Part::Ignored,
        part => part,
    };
    readings.iter().map(|r| Mark { stroke: r.id, part: part(r), confidence: r.confidence }).collect()
}
