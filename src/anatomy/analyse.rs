//! The whole analysis: strokes in, anatomy out.
//!
//! What is made again and again while a drawing grows is kept in a [`Cache`]; with an empty one everything is made.

use super::{
    Anatomy, FlatBlade, FlatBranch, FlatCrown, FlatFlower, Mark, Part, Stop,
    attach::{AttachParams, Attacher},
    blade_outline::TipParams,
    conventions::{self, ConventionParams, Habit, Interpretation, Piece},
    fill_leaves::LeafFillParams,
    fill_twigs::TwigParams,
    flowers::{self, Drawn, FlowerParams, Gatherer, Stem},
    hierarchy::{self, Arranged, Arranger, HierarchyParams},
    leaf_twigs::LeafTwigParams,
    outlines::{Fill, Outlines},
    preprocess::PreprocessParams,
    reading::{self, IgnoreParams, Reading, Readings, Rules},
    thin_spots::{self, ThinSpot},
};
use crate::sketch::warnings::Warnings;
use crate::sketch::{Remark, Sketch, Stroke, StrokeId, Tool, Warning};
use glam::Vec2;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::sync::Arc;

crate::parameter_groups! {
    /// Everything that decides what a drawing means.
    pub struct AnatomyParams {
        /// Ways of drawing besides the papers'.
        conventions: ConventionParams;
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

/// What is kept of an analysis for the next one.
#[derive(Debug, Default)]
pub struct Cache {
    /// Everything in here was made with these.
    params: AnatomyParams,
    is_for_one_build: bool,
    conventions: conventions::Memory,
    readings: Readings,
    branches: Arranger,
    flowers: Gatherer,
    places: Attacher,
    outlines: Outlines,
}

impl Cache {
    /// For a single drawing: what is made is not kept by what it was made from.
    pub fn for_one_build() -> Self {
        Self {
            is_for_one_build: true,
            conventions: conventions::Memory::for_one_build(),
            readings: Readings::for_one_build(),
            branches: Arranger::for_one_build(),
            places: Attacher::for_one_build(),
            ..Self::default()
        }
    }

    /// What kind of plant a drawing shows; kept for its analysis.
    pub fn habit(&mut self, sketch: &Sketch, params: &ConventionParams) -> Option<Habit> {
        let strokes = sketch.on_sheet();
        conventions::interpret_with(&mut self.conventions, &strokes, &sketch.corrections, params).habit
    }

    /// Begins a drawing with these parameters; what was made with others is of no use.
    fn begin(&mut self, params: &AnatomyParams) {
        if self.params != *params {
            let empty = if self.is_for_one_build { Self::for_one_build() } else { Self::default() };
            *self = Self { params: params.clone(), ..empty };
        }
    }
}

/// Finds out what every stroke is and how the parts hang together; generates what outlines ask for.
pub fn analyse(sketch: &Sketch, params: &AnatomyParams) -> Anatomy {
    analysis(&mut Cache::for_one_build(), sketch, params, &|| false)
}

/// The very anatomy that [`analyse`] gives, again and again while a drawing changes; nothing if `stop` ever said yes.
pub fn analyse_with(
    cache: &mut Cache,
    sketch: &Sketch,
    params: &AnatomyParams,
    stop: Stop,
) -> Option<Anatomy> {
    let anatomy = analysis(cache, sketch, params, stop);
    (!stop()).then_some(anatomy)
}

/// The whole analysis; once `stop` says yes it hurries to its end, and what it gives is of no use.
fn analysis(cache: &mut Cache, sketch: &Sketch, params: &AnatomyParams, stop: Stop) -> Anatomy {
    cache.begin(params);
    let rules = Rules { preprocess: &params.preprocess, ignore: &params.ignore, tip: &params.tip };
    let interpretation = conventions::interpret_with(
        &mut cache.conventions,
        &sketch.on_sheet(),
        &sketch.corrections,
        &params.conventions,
    );
    let Interpretation { strokes, pieces, readings: together, solids, remarks, habit } = &*interpretation;
    let reading::Drawn { readings, bounds } = cache.readings.read(strokes, rules);
    let bounds =
        solids.iter().map(|drawn| drawn.solid.bounds()).fold(bounds, |a, b| (a.0.min(b.0), a.1.max(b.1)));
    let diagonal = bounds.0.distance(bounds.1);
    let (pieces, readings_together, solids) = (pieces.clone(), together.clone(), solids.clone());
    let mut anatomy = Anatomy {
        diagonal,
        bounds,
        pieces,
        readings: readings_together,
        solids,
        habit: *habit,
        ..Anatomy::default()
    };
    if stop() {
        return anatomy;
    }
    anatomy.thin_spots = thin_spots::find(readings);
    let mut warnings = remarks_on(readings, (remarks, &anatomy.thin_spots));
    let lines =
        readings.iter().filter(|r| r.part == Part::Branch).map(|r| (Some(r.id), Arc::clone(&r.samples)));
    let Arranged { branches, lines } =
        hierarchy::arrange_with(&mut cache.branches, lines.collect(), diagonal, &params.hierarchy);
    anatomy.branches = branches;
    for branch in &mut anatomy.branches {
        let piece = branch.stroke.and_then(|stroke| anatomy.pieces.get(&stroke));
        branch.half_width = piece.and_then(|piece| piece.half_width);
    }
    fn drawn(r: &Arc<Reading>) -> Option<Drawn<'_>> {
        Some(Drawn { blade: r.blade.as_ref()?, tool: r.tool, roundness: r.roundness.as_ref()? })
    }
    let blades = readings.iter().filter_map(drawn).collect();
    let stems = stems(&anatomy.branches);
    let gathering = flowers::gather_with(&mut cache.flowers, blades, &stems, &params.flowers);
    (anatomy.petals, anatomy.flowers, anatomy.leaves) =
        (gathering.petals, gathering.flowers, gathering.leaves);
    for &centre in &gathering.centres {
        warnings.add(Some(centre), || Remark::FlowerCentre);
    }
    anatomy.crowns = crowns(readings, &anatomy.thin_spots, &mut warnings);
    let flowers = (&mut anatomy.flowers[..], &anatomy.petals[..]);
    cache.places.attach(lines, &mut anatomy.leaves, flowers, &params.attach);
    remark_on_what_stands_apart(&anatomy, &mut warnings);
    let AnatomyParams { twigs, leaf_twigs, leaf_fill, .. } = params;
    let fill = Fill { readings, seed: sketch.seed, twigs, leaf_twigs, leaf_fill, stop };
    fill.fill(&mut cache.outlines, &mut anatomy, &mut warnings);
    anatomy.warnings = warnings.into_vec();
    let drawn = |stroke| anatomy.pieces.get(&stroke).map_or(stroke, Piece::first);
    anatomy.warnings.iter_mut().for_each(|warning| warning.stroke = warning.stroke.map(drawn));
    // Blades that were drawn in one stroke have one remark.
    anatomy.warnings.dedup();
    let read = marks(readings, &anatomy.petals, &gathering.centres);
    anatomy.marks = of_drawn(&sketch.strokes, &anatomy.pieces, read);
    anatomy
}

/// Remarks on drawn leaves and flowers that no drawn branch is near, if there are any: a leaf by itself needs none.
fn remark_on_what_stands_apart(anatomy: &Anatomy, warnings: &mut Warnings) {
    if !anatomy.branches.iter().any(|branch| branch.stroke.is_some()) {
        return;
    }
    let leaves = anatomy.leaves.iter().filter(|leaf| leaf.attachment.is_none()).map(|leaf| leaf.stroke);
    let flowers = anatomy.flowers.iter().filter(|flower| flower.attachment.is_none());
    let first = |flower: &FlatFlower| anatomy.petals[*flower.petals.first()?].stroke;
    for stroke in leaves.chain(flowers.map(first)).flatten() {
        warnings.add(Some(stroke), || Remark::StandsApart);
    }
}

/// What is said of strokes that were read together, then of single ones.
fn remarks_on(readings: &[Arc<Reading>], (together, thin): (&[Warning], &[ThinSpot])) -> Warnings {
    let mut warnings = Warnings::default();
    for Warning { stroke, remark } in together {
        warnings.add(*stroke, || remark.clone());
    }
    let dots: HashSet<StrokeId> = thin.iter().map(|spot| spot.stroke).collect();
    for reading in readings {
        if dots.contains(&reading.id) {
            warnings.add(Some(reading.id), || Remark::ThinsCrown);
        } else if let Some(remark) = &reading.warning {
            warnings.add(Some(reading.id), || remark.clone());
        }
    }
    warnings
}

/// Most outlines of crowns in a drawing.
const MOST_CROWNS: usize = 64;

/// The outlines of crowns in drawing order, dots left out, closed by leaving out an end that meets its beginning; the largest where
/// there are too many.
fn crowns(readings: &[Arc<Reading>], thin: &[ThinSpot], warnings: &mut Warnings) -> Vec<FlatCrown> {
    let dots: HashSet<StrokeId> = thin.iter().map(|spot| spot.stroke).collect();
    let is_crown = |r: &&Arc<Reading>| r.part == Part::Crown && !dots.contains(&r.id);
    let drawn: Vec<&Arc<Reading>> = readings.iter().filter(is_crown).collect();
    let mut order: Vec<usize> = (0..drawn.len()).collect();
    order.sort_by(|a, b| drawn[*b].spread.total_cmp(&drawn[*a].spread));
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

/// The stems that stand by themselves.
fn stems(branches: &[FlatBranch]) -> Vec<Stem> {
    let ends = |b: &FlatBranch| Some(Stem { foot: b.line.first()?.position, tip: b.line.last()?.position });
    branches.iter().filter(|b| b.parent.is_none()).filter_map(ends).collect()
}

/// The verdicts in drawing order; blades that gathered to flowers are petals.
fn marks(readings: &[Arc<Reading>], petals: &[FlatBlade], centres: &[StrokeId]) -> Vec<Mark> {
    let mut petal_ids: Vec<StrokeId> = petals.iter().filter_map(|p| p.stroke).collect();
    petal_ids.sort_unstable();
    let mut centres = centres.to_vec();
    centres.sort_unstable();
    let part = |r: &Arc<Reading>| match r.part {
        Part::Leaf if petal_ids.binary_search(&r.id).is_ok() => Part::Petal,
        Part::Leaf if centres.binary_search(&r.id).is_ok() => Part::Ignored,
        part => part,
    };
    readings.iter().map(|r| Mark { stroke: r.id, part: part(r), confidence: r.confidence }).collect()
}

/// The verdicts on drawn strokes from those on the strokes that were made of them: what a stroke became first counts. One that
/// became nothing is ignored; what was drawn in space is a branch, and not read.
fn of_drawn(strokes: &[Arc<Stroke>], pieces: &BTreeMap<StrokeId, Piece>, read: Vec<Mark>) -> Vec<Mark> {
    if read.len() == strokes.len() && pieces.is_empty() {
        return read;
    }
    let mut first: HashMap<StrokeId, Mark> = HashMap::new();
    for mark in read {
        match pieces.get(&mark.stroke) {
            None => _ = first.insert(mark.stroke, mark),
            Some(piece) => piece.strokes.iter().for_each(|&stroke| {
                first.entry(stroke).or_insert(Mark { stroke, ..mark.clone() });
            }),
        }
    }
    let unread = |stroke: &Stroke| {
        let part = if stroke.tool == Tool::SpaceBranch { Part::Branch } else { Part::Ignored };
        Mark { stroke: stroke.id, part, confidence: 1.0 }
    };
    // What brushes do is no part of its own.
    let read = strokes.iter().filter(|stroke| !stroke.tool.is_brush());
    read.map(|stroke| first.remove(&stroke.id).unwrap_or_else(|| unread(stroke))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::Sample;
    use crate::sketch::{Stroke, Tool};

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
            a.branches.iter().filter(|b| b.stroke.is_none()).map(|b| b.line.to_vec()).collect()
        };
        let leaves = |a: &Anatomy| -> Vec<_> {
            a.leaves.iter().filter(|l| l.stroke.is_none()).map(|l| (l.root, l.tip, l.copy_of)).collect()
        };
        assert!(leaves(&before).len() > 500, "{}", leaves(&before).len());
        assert_eq!(twigs(&before), twigs(&after));
        assert_eq!(leaves(&before), leaves(&after));
    }

    #[test]
    fn a_corolla_in_one_stroke_gathers_around_its_drawn_centre() {
        let around = |angle: f32, reach: f32| reach * Vec2::from_angle(angle);
        let angle = |k: usize| 0.3 + std::f32::consts::TAU * k as f32 / 120.0;
        let corolla = (0..=120).map(|k| around(angle(k), 40.0 + 30.0 * (3.0 * angle(k)).sin().abs()));
        let centre = (0..=120).map(|k| around(angle(k), 25.0));
        let stem = (0..10).map(|k| Vec2::new(0.0, 300.0 - 26.0 * k as f32));
        let stroke = |(id, points): (usize, Vec<Vec2>)| {
            let points = points.into_iter().map(crate::sketch::StrokePoint::at).collect();
            Arc::new(Stroke { id: id as u64, tool: Tool::Auto, points, brush: None })
        };
        let lines = [stem.collect(), corolla.collect(), centre.collect()];
        let strokes = lines.into_iter().enumerate().map(stroke).collect();
        let anatomy = analyse(&Sketch { strokes, ..drawing("daisy") }, &AnatomyParams::default());
        let [flower] = &anatomy.flowers[..] else { panic!("{} flowers", anatomy.flowers.len()) };
        assert_eq!((flower.petals.len(), anatomy.leaves.len(), anatomy.branches.len()), (6, 0, 1));
        assert!(flower.center.length() < 3.0, "{}", flower.center);
        assert!(flower.centre_radius.is_some_and(|radius| (radius / 25.0 - 1.0).abs() < 0.05));
        assert!(flower.attachment.is_some());
    }
}
