//! What single strokes are: even samples, blade or branch, and where root and tip of a blade lie.
//!
//! A reading depends on its stroke and on the scale of the drawing, but on that only through how many samples the stroke is
//! given and whether it is too small to mean anything. So [`Readings`] from one drawing to the next are kept by stroke,
//! identified by its address, and taken while these are as they were: most strokes of a large drawing have the fewest samples
//! whatever its scale.

use super::{
    FlatBlade, Part, Sample,
    blade_outline::{self, TipParams},
    classify::Classifier,
    flower_centre::Roundness,
    preprocess::{self, PreprocessParams, preprocess},
};
use crate::geom::{convex_hull::convex_hull, polyline, simple_loop};
use crate::kept::{Kept, Same};
use crate::sketch::{Remark, Stroke, StrokeId, Tool};
use glam::Vec2;
use std::sync::Arc;

crate::parameters! {
    /// Which strokes are too small to mean anything.
    pub struct IgnoreParams {
        /// Shorter strokes are skipped with a warning.
        shorter_than: f32 = 0.004, 0.0..=0.1, "of the drawing's diagonal";
    }
}

/// Largest extent of a dot, as a share of the median stroke's and of the whole drawing's.
const DOT: (f32, f32) = (0.05, 0.004);

/// Least area of a crown's hull, as a share of the square of the drawing's diagonal.
const FLAT_CROWN: f32 = 1e-5;

/// Smallest and largest corner, pixels.
type Bounds = (Vec2, Vec2);

/// Bounds of nothing.
const NOTHING: Bounds = (Vec2::INFINITY, Vec2::NEG_INFINITY);

/// What decides how a stroke is read.
#[derive(Clone, Copy, Debug)]
pub struct Rules<'a> {
    /// Resampling and smoothing.
    pub preprocess: &'a PreprocessParams,
    /// Which strokes are too small to mean anything.
    pub ignore: &'a IgnoreParams,
    /// Tips of blades.
    pub tip: &'a TipParams,
}

/// A stroke on its way through the analysis.
#[derive(Debug)]
pub struct Reading {
    /// The stroke.
    pub id: StrokeId,
    /// What it was drawn with.
    pub tool: Tool,
    /// Its even samples.
    pub samples: Arc<[Sample]>,
    /// What it is, a petal still being a leaf.
    pub part: Part,
    /// How sure that is, 0 to 1.
    pub confidence: f32,
    /// The blade, where the stroke is one.
    pub blade: Option<FlatBlade>,
    /// How round that is.
    pub roundness: Option<Roundness>,
    /// What is odd about it.
    pub warning: Option<Remark>,
    /// Area of its convex hull where it is the outline of a crown, square pixels: unlike that of the outline itself it is not
    /// lost where an outline crosses itself.
    pub spread: f32,
    /// Length through the samples, pixels.
    length: f32,
}

/// The strokes of a drawing, read.
#[derive(Debug)]
pub struct Drawn<'a> {
    /// In the order of the drawing.
    pub readings: &'a [Arc<Reading>],
    /// Of all strokes but dots.
    pub bounds: Bounds,
}

/// Readings from one drawing to the next, all by the same rules.
#[derive(Debug, Default)]
pub struct Readings {
    measures: Kept<Same<Stroke>, Measure>,
    readings: Kept<Same<Stroke>, Arc<Reading>>,
}

/// What the scale of a drawing is made from, and what it decides about.
#[derive(Clone, Copy, Debug)]
struct Measure {
    bounds: Bounds,
    /// Length of the stroke as it was drawn, pixels.
    length: f32,
}

/// A stroke and what of the drawing matters to it.
struct Placed<'a> {
    stroke: &'a Arc<Stroke>,
    is_dot: bool,
    /// How many samples it is given.
    samples: usize,
}

impl Readings {
    /// For a single drawing, of which nothing is kept.
    pub fn for_one_build() -> Self {
        Self { measures: Kept::for_one_call(), readings: Kept::for_one_call() }
    }

    /// Reads the strokes of a drawing.
    pub fn read(&mut self, strokes: &[Arc<Stroke>], rules: Rules<'_>) -> Drawn<'_> {
        let measures = self.measures.made(strokes, Same::of, |stroke| Measure::of(stroke));
        let (bounds, dots) = bounds_without_dots(measures);
        let diagonal = bounds.0.distance(bounds.1);
        let placed: Vec<Placed<'_>> = strokes
            .iter()
            .zip(measures)
            .zip(dots)
            .map(|((stroke, measure), is_dot)| {
                let samples = preprocess::count(measure.length, diagonal, rules.preprocess);
                Placed { stroke, is_dot, samples }
            })
            .collect();
        let readings = self.readings.made_where(
            &placed,
            |placed, used| Same::of(placed.stroke, used),
            |placed, reading| reading.holds(placed, diagonal, rules.ignore),
            |placed| Arc::new(read_stroke(placed, diagonal, rules)),
        );
        Drawn { readings, bounds }
    }
}

impl Measure {
    fn of(stroke: &Stroke) -> Self {
        let points = || stroke.points.iter().map(|p| p.position);
        Self {
            bounds: points().fold(NOTHING, |bounds, p| union(bounds, (p, p))),
            length: preprocess::length(&stroke.points),
        }
    }
}

fn union(a: Bounds, b: Bounds) -> Bounds {
    (a.0.min(b.0), a.1.max(b.1))
}

/// Bounds of all strokes but dots, and which strokes are dots: a slip of the pen far away must not set the scale.
fn bounds_without_dots(measures: &[Measure]) -> (Bounds, Vec<bool>) {
    let extent = |b: &Bounds| if b.0.cmple(b.1).all() { b.0.distance(b.1) } else { 0.0 };
    let boxes = || measures.iter().map(|measure| measure.bounds);
    let mut extents: Vec<f32> = boxes().map(|b| extent(&b)).collect();
    let whole = extent(&boxes().fold(NOTHING, union));
    let middle = extents.len() / 2;
    let median =
        if extents.is_empty() { 0.0 } else { *extents.select_nth_unstable_by(middle, f32::total_cmp).1 };
    let dots: Vec<bool> = boxes().map(|b| extent(&b) < (DOT.0 * median).min(DOT.1 * whole)).collect();
    let bounds = boxes().zip(&dots).filter(|(_, dot)| !**dot).map(|(b, _)| b).fold(NOTHING, union);
    (if bounds.0.cmple(bounds.1).all() { bounds } else { Default::default() }, dots)
}

/// Whether a stroke of so many samples and such a length says nothing.
fn is_too_small(is_dot: bool, samples: usize, length: f32, diagonal: f32, params: &IgnoreParams) -> bool {
    is_dot || samples < 2 || length < params.shorter_than * diagonal
}

/// Whether the outline of a crown encloses nothing.
fn is_flat(spread: f32, diagonal: f32) -> bool {
    spread < FLAT_CROWN * diagonal * diagonal
}

impl Reading {
    /// Whether the stroke would be read alike in a drawing of another scale.
    fn holds(&self, placed: &Placed<'_>, diagonal: f32, params: &IgnoreParams) -> bool {
        let is_too_small = is_too_small(placed.is_dot, placed.samples, self.length, diagonal, params);
        let is_flat = self.tool == Tool::Crown && is_flat(self.spread, diagonal);
        placed.samples == self.samples.len()
            && is_too_small == (self.warning == Some(Remark::TooShort))
            && (is_too_small || is_flat == (self.warning == Some(Remark::EmptyCrown)))
    }
}

/// Evens out one stroke and decides what it is.
fn read_stroke(placed: &Placed<'_>, diagonal: f32, rules: Rules<'_>) -> Reading {
    let &Placed { stroke, is_dot, samples: count } = placed;
    let samples: Arc<[Sample]> = preprocess(&stroke.points, count, rules.preprocess).into();
    let (id, tool) = (stroke.id, stroke.tool);
    let positions: Vec<Vec2> = samples.iter().map(|s| s.position).collect();
    let length = polyline::length(&positions);
    let spread = if tool == Tool::Crown { hull_area(&samples) } else { 0.0 };
    let (part, confidence, blade, warning) =
        if is_too_small(is_dot, samples.len(), length, diagonal, rules.ignore) {
            (Part::Ignored, 1.0, None, Some(Remark::TooShort))
        } else if tool == Tool::Crown && is_flat(spread, diagonal) {
            (Part::Ignored, 1.0, None, Some(Remark::EmptyCrown))
        } else {
            understood(id, tool, &samples, &positions, rules.tip)
        };
    let roundness = blade.as_ref().map(Roundness::of);
    Reading { id, tool, samples, part, confidence, blade, roundness, warning, spread, length }
}

/// What a stroke that is large enough to mean something is.
fn understood(
    id: StrokeId,
    tool: Tool,
    samples: &[Sample],
    positions: &[Vec2],
    params: &TipParams,
) -> (Part, f32, Option<FlatBlade>, Option<Remark>) {
    let (is_blade, confidence) = match tool {
        Tool::Branch
        | Tool::SpaceBranch
        | Tool::GrowthBrush
        | Tool::PruningBrush
        | Tool::LightBrush
        | Tool::LeafBrush
        | Tool::FlowerBrush => (false, 1.0),
        Tool::BranchOutline => return (Part::BranchOutline, 1.0, None, None),
        Tool::LeafOutline => return (Part::LeafOutline, 1.0, None, None),
        Tool::Crown => return (Part::Crown, 1.0, None, None),
        Tool::Petal | Tool::Leaf => (true, 1.0),
        Tool::Auto => {
            let verdict = Classifier::built_in().classify(positions);
            (verdict.blade, verdict.confidence)
        }
    };
    if !is_blade {
        return (Part::Branch, confidence, None, None);
    }
    match blade_outline::blade(id, samples, params) {
        Some(blade) => (Part::Leaf, confidence, Some(blade), None),
        None if tool == Tool::Auto => (Part::Branch, 0.5, None, None),
        None => (Part::Ignored, 1.0, None, Some(Remark::EnclosesNothing)),
    }
}

/// Area of the convex hull, square pixels.
fn hull_area(samples: &[Sample]) -> f32 {
    let hull = convex_hull(samples, |s| s.position);
    simple_loop::signed_area(hull.iter().map(|s| s.position)).abs()
}
