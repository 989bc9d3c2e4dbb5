//! The whole analysis: strokes in, anatomy out.

use super::{
    Anatomy, FlatBlade, FlatBranch, FlatCrown, Mark, Part, Sample, Stop,
    attach::{AttachParams, Branches},
    blade_outline::{self, TipParams},
    classify::Classifier,
    fill_leaves::{LeafFill, LeafFillParams, Templates},
    fill_twigs::{Growth, TwigFill, TwigParams},
    flowers::{self, FlowerParams, Stem},
    growth_points::Forest,
    hierarchy::{self, HierarchyParams},
    leaf_twigs::{LeafTwigParams, LeafTwigs},
    preprocess::{PreprocessParams, preprocess},
};
use crate::budget::Budget;
use crate::geom::{convex_hull::convex_hull, polyline, region::Region, simple_loop};
use crate::sketch::warnings::Warnings;
use crate::sketch::{Remark, Sketch, Stroke, StrokeId, Tool};
use glam::Vec2;
use rayon::prelude::*;
use std::sync::Arc;

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
    warning: Option<Remark>,
}

/// Finds out what every stroke is and how the parts hang together; generates what outlines ask for.
pub fn analyse(sketch: &Sketch, params: &AnatomyParams) -> Anatomy {
    analysis(sketch, params, &|| false)
}

/// The same, or nothing if `stop` ever said yes.
pub fn analyse_unless(sketch: &Sketch, params: &AnatomyParams, stop: Stop) -> Option<Anatomy> {
    let anatomy = analysis(sketch, params, stop);
    (!stop()).then_some(anatomy)
}

/// The whole analysis; once `stop` says yes it hurries to its end, and what it gives is of no use.
fn analysis(sketch: &Sketch, params: &AnatomyParams, stop: Stop) -> Anatomy {
    let (bounds, dots) = bounds_without_dots(&sketch.strokes);
    let diagonal = bounds.0.distance(bounds.1);
    let readings: Vec<Reading> = sketch
        .strokes
        .par_iter()
        .with_min_len(16)
        .zip(dots.par_iter())
        .map(|(stroke, &dot)| read_stroke(stroke, dot, diagonal, params))
        .collect();

    let mut anatomy = Anatomy { diagonal, bounds, ..Anatomy::default() };
    if stop() {
        return anatomy;
    }
    let mut warnings = Warnings::default();
    for reading in &readings {
        if let Some(remark) = &reading.warning {
            warnings.add(Some(reading.id), || remark.clone());
        }
    }
    let lines = readings.iter().filter(|r| r.part == Part::Branch).map(|r| (Some(r.id), r.samples.clone()));
    anatomy.branches = hierarchy::arrange(lines.collect(), diagonal, &params.hierarchy);
    let blades = readings.iter().filter_map(|r| r.blade.clone().map(|blade| (blade, r.tool))).collect();
    let gathering = flowers::gather(blades, &stems(&anatomy.branches), &params.flowers);
    (anatomy.petals, anatomy.flowers, anatomy.leaves) =
        (gathering.petals, gathering.flowers, gathering.leaves);
    for &heart in &gathering.hearts {
        warnings.add(Some(heart), || Remark::Heart);
    }
    anatomy.crowns = crowns(&readings, &mut warnings);
    attach_organs(&mut anatomy, &params.attach);
    fill_outlines(&mut anatomy, &readings, sketch.seed, params, stop, &mut warnings);
    anatomy.warnings = warnings.into_vec();
    anatomy.marks = marks(&readings, &anatomy.petals, &gathering.hearts);
    anatomy
}

/// Largest extent of a dot, as a share of the median stroke's and of the whole drawing's.
const DOT: (f32, f32) = (0.05, 0.004);

/// Most outlines of crowns in a drawing.
const MOST_CROWNS: usize = 64;

/// Least area of a crown's hull, as a share of the square of the drawing's diagonal.
const FLAT_CROWN: f32 = 1e-5;

/// Bounds of all strokes but dots, and which strokes are dots: a slip of the pen far away must not set the scale.
fn bounds_without_dots(strokes: &[Arc<Stroke>]) -> ((Vec2, Vec2), Vec<bool>) {
    const NOTHING: (Vec2, Vec2) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
    let union = |a: (Vec2, Vec2), b: (Vec2, Vec2)| (a.0.min(b.0), a.1.max(b.1));
    let box_of = |s: &Arc<Stroke>| s.points.iter().fold(NOTHING, |b, p| union(b, (p.position, p.position)));
    let boxes: Vec<(Vec2, Vec2)> = strokes.iter().map(box_of).collect();
    let extent = |b: &(Vec2, Vec2)| if b.0.cmple(b.1).all() { b.0.distance(b.1) } else { 0.0 };
    let mut extents: Vec<f32> = boxes.iter().map(extent).collect();
    let whole = extent(&boxes.iter().copied().fold(NOTHING, union));
    let middle = extents.len() / 2;
    let median =
        if extents.is_empty() { 0.0 } else { *extents.select_nth_unstable_by(middle, f32::total_cmp).1 };
    let is_dot = |b| extent(b) < (DOT.0 * median).min(DOT.1 * whole);
    let dots: Vec<bool> = boxes.iter().map(is_dot).collect();
    let bounds = boxes.iter().zip(&dots).filter(|(_, dot)| !**dot).map(|(b, _)| *b).fold(NOTHING, union);
    (if bounds.0.cmple(bounds.1).all() { bounds } else { Default::default() }, dots)
}

/// Evens out one stroke and decides what it is.
fn read_stroke(stroke: &Stroke, dot: bool, diagonal: f32, params: &AnatomyParams) -> Reading {
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
    if dot || samples.len() < 2 || polyline::length(&positions) < params.ignore.shorter_than * diagonal {
        return reading(samples, Part::Ignored, 1.0, None, Some(Remark::TooShort));
    }
    let (is_blade, confidence) = match tool {
        Tool::Branch => (false, 1.0),
        Tool::BranchOutline => return reading(samples, Part::BranchOutline, 1.0, None, None),
        Tool::LeafOutline => return reading(samples, Part::LeafOutline, 1.0, None, None),
        Tool::Crown => {
            let is_flat = spread(&samples) < FLAT_CROWN * diagonal * diagonal;
            let warning = is_flat.then_some(Remark::EmptyCrown);
            let part = if is_flat { Part::Ignored } else { Part::Crown };
            return reading(samples, part, 1.0, None, warning);
        }
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
        None => reading(samples, Part::Ignored, 1.0, None, Some(Remark::EnclosesNothing)),
    }
}

/// The outlines of crowns in drawing order, closed by leaving out an end that meets its beginning; the largest where
/// there are too many.
fn crowns(readings: &[Reading], warnings: &mut Warnings) -> Vec<FlatCrown> {
    let drawn: Vec<&Reading> = readings.iter().filter(|r| r.part == Part::Crown).collect();
    let mut order: Vec<usize> = (0..drawn.len()).collect();
    order.sort_by(|a, b| spread(&drawn[*b].samples).total_cmp(&spread(&drawn[*a].samples)));
    let mut kept = vec![false; drawn.len()];
    order.iter().take(MOST_CROWNS).for_each(|i| kept[*i] = true);
    let crown = |r: &Reading| {
        let mut outline: Vec<Vec2> = r.samples.iter().map(|s| s.position).collect();
        if outline.first() == outline.last() {
            outline.pop();
        }
        FlatCrown { stroke: r.id, outline }
    };
    for (reading, _) in drawn.iter().zip(&kept).filter(|(_, kept)| !**kept) {
        warnings.add(Some(reading.id), || Remark::ManyCrowns { most: MOST_CROWNS });
    }
    drawn.into_iter().zip(kept).filter(|(_, kept)| *kept).map(|(reading, _)| crown(reading)).collect()
}

/// Area of the convex hull: unlike that of the outline itself it is not lost where an outline crosses itself.
fn spread(samples: &[Sample]) -> f32 {
    let hull = convex_hull(samples, |s| s.position);
    simple_loop::signed_area(hull.iter().map(|s| s.position)).abs()
}

/// The stems that stand by themselves.
fn stems(branches: &[FlatBranch]) -> Vec<Stem> {
    let ends = |b: &FlatBranch| Some(Stem { foot: b.line.first()?.position, tip: b.line.last()?.position });
    branches.iter().filter(|b| b.parent.is_none()).filter_map(ends).collect()
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
fn fill_outlines(
    anatomy: &mut Anatomy,
    readings: &[Reading],
    seed: u64,
    params: &AnatomyParams,
    stop: Stop,
    warnings: &mut Warnings,
) {
    let diagonal = anatomy.diagonal;
    let outlines = |part: Part| -> Vec<(StrokeId, Region)> {
        let inside = readings.iter().filter(|r| r.part == part);
        inside.map(|r| (r.id, Region::new(r.samples.iter().map(|s| s.position).collect()))).collect()
    };
    let mut forest = Forest::new(std::mem::take(&mut anatomy.branches));
    for (outline, region) in &outlines(Part::BranchOutline) {
        let fill = TwigFill { outline: *outline, region, diagonal, seed, params: &params.twigs, stop };
        if let Some(remark) = shortfall(fill.fill(&mut forest)) {
            warnings.add(Some(*outline), || remark);
        }
    }
    let templates = Templates::new(&anatomy.leaves, diagonal, &params.leaf_fill);
    let (leaf_outlines, mut room) =
        (outlines(Part::LeafOutline), (params.leaf_fill.max_leaves as usize).min(Budget::PLANT.leaves));
    for (i, (outline, region)) in leaf_outlines.iter().enumerate() {
        let (outline, leaf_length) = (*outline, templates.length);
        let twigs =
            LeafTwigs { outline, region, leaf_length, diagonal, seed, params: &params.leaf_twigs, stop };
        let all_twigs = twigs.grow(&mut forest);
        let templates = &templates;
        let fill = LeafFill { outline, region, templates, diagonal, seed, params: &params.leaf_fill, stop };
        // What an outline leaves of its share goes to those after it.
        let (leaves, thinned) = fill.fill(&forest, room / (leaf_outlines.len() - i));
        room -= leaves.len();
        anatomy.leaves.extend(leaves);
        if thinned || !all_twigs {
            warnings.add(Some(outline), || Remark::FilledThinly);
        }
    }
    anatomy.branches = forest.into_branches();
    if anatomy.leaves.iter().any(|leaf| leaf.copy_of.is_some()) {
        anatomy.templates = templates.outlines;
    }
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

/// The verdicts in drawing order; blades that gathered to flowers are petals.
fn marks(readings: &[Reading], petals: &[FlatBlade], hearts: &[StrokeId]) -> Vec<Mark> {
    let mut petal_ids: Vec<StrokeId> = petals.iter().filter_map(|p| p.stroke).collect();
    petal_ids.sort_unstable();
    let mut hearts = hearts.to_vec();
    hearts.sort_unstable();
    let part = |r: &Reading| match r.part {
        Part::Leaf if petal_ids.binary_search(&r.id).is_ok() => Part::Petal,
        Part::Leaf if hearts.binary_search(&r.id).is_ok() => Part::Ignored,
        part => part,
    };
    readings.iter().map(|r| Mark { stroke: r.id, part: part(r), confidence: r.confidence }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawing(name: &str) -> Sketch {
        let path = format!("{}/assets/sketches/{name}.penstemon", env!("CARGO_MANIFEST_DIR"));
        crate::sketch::read(std::path::Path::new(&path)).unwrap().0
    }

    /// Adds a branch of a few points from `from` to `to`.
    fn add(sketch: &mut Sketch, from: Vec2, to: Vec2) -> StrokeId {
        let mut stroke = Stroke::clone(&sketch.strokes[0]);
        stroke.id = 1_000_000;
        stroke.tool = Tool::Branch;
        stroke.points.truncate(4);
        let last = stroke.points.len() - 1;
        for (k, point) in stroke.points.iter_mut().enumerate() {
            point.position = from.lerp(to, k as f32 / last as f32);
        }
        sketch.strokes.push(stroke.into());
        1_000_000
    }

    #[test]
    fn a_far_dot_changes_nothing() {
        let params = AnatomyParams::default();
        let mut sketch = drawing("daisy");
        let before = analyse(&sketch, &params);
        let far = before.bounds.1 + 10.0 * before.diagonal;
        let dot = add(&mut sketch, far, far);
        let after = analyse(&sketch, &params);
        assert_eq!((before.bounds, &before.branches), (after.bounds, &after.branches));
        assert_eq!((&before.petals, &before.leaves), (&after.petals, &after.leaves));
        assert!(after.warnings.iter().any(|w| w.stroke == Some(dot)));
    }

    #[test]
    fn an_unrelated_stroke_leaves_the_crown_as_it_was() {
        let params = AnatomyParams::default();
        let mut sketch = drawing("tree_round");
        let before = analyse(&sketch, &params);
        let corner = Vec2::new(before.bounds.0.x, before.bounds.1.y);
        add(&mut sketch, corner, corner + 0.05 * before.diagonal * Vec2::new(0.3, -1.0));
        let after = analyse(&sketch, &params);
        let twigs = |a: &Anatomy| -> Vec<Vec<Sample>> {
            a.branches.iter().filter(|b| b.stroke.is_none()).map(|b| b.line.clone()).collect()
        };
        let leaves = |a: &Anatomy| -> Vec<_> {
            a.leaves.iter().filter(|l| l.stroke.is_none()).map(|l| (l.root, l.tip, l.copy_of)).collect()
        };
        assert!(leaves(&before).len() > 500, "{}", leaves(&before).len());
        assert_eq!(twigs(&before), twigs(&after));
        assert_eq!(leaves(&before), leaves(&after));
    }
}
