//! Where the time of one more sample goes: the pipeline alone, with a cache, stage by stage.

use crate::drawings;
use penstemon::pipeline::{self, Cache};
use penstemon::sketch::{Sketch, Stroke, Tool};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Samples that are drawn one by one.
const SAMPLES: usize = 24;
/// Samples for each build from scratch.
const SCRATCH: usize = 6;

/// Builds large drawings anew with every sample of one more stroke, those of a quarter of the size in turn with the whole
/// ones and with builds from scratch, and tells what the stages take. A ratio near to 1 says that a sample costs the same in
/// a larger drawing.
pub(crate) fn print(many: usize) {
    compare("drawing", many, "strokes", [many / 4, many].map(drawings::meadow));
    compare("tree", many, "leaves", [many / 4, many].map(drawings::leafy_tree));
}

fn compare(name: &str, many: usize, unit: &str, mut sketches: [Sketch; 2]) {
    let mut times: [Times; 3] = Default::default();
    let mut caches = [Cache::default(), Cache::default()];
    for (sketch, cache) in sketches.iter().zip(&mut caches) {
        build(cache, sketch, &mut Times::default());
    }
    let stroke = extra(&sketches[0]);
    sketches.iter_mut().for_each(|sketch| sketch.strokes.push(Arc::clone(&stroke)));
    for count in 2..2 + SAMPLES {
        for ((sketch, cache), times) in sketches.iter_mut().zip(&mut caches).zip(&mut times) {
            let mut drawn = (*stroke).clone();
            drawn.points.truncate(count);
            if let Some(last) = sketch.strokes.last_mut() {
                *last = Arc::new(drawn);
            }
            build(cache, sketch, times);
        }
        if count % SCRATCH == 0 {
            build(&mut Cache::default(), &sketches[1], &mut times[2]);
        }
    }
    println!("one more sample on a {name} of {} and of {many} {unit}, milliseconds", many / 4);
    println!("  {:12}{:>10}{:>10}{:>8}{:>14}", "", "few", "many", "ratio", "from scratch");
    let names: Vec<&str> = times[1].keys().copied().collect();
    for stage in names {
        let [few, many, scratch] =
            [0, 1, 2].map(|k: usize| times[k].get_mut(stage).map_or(0.0, |times| median(times)));
        println!("  {stage:12}{few:10.2}{many:10.2}{:8.2}{scratch:14.2}", many / few);
    }
}

/// A stem in the first herb, which stands well inside of the drawing.
fn extra(sketch: &Sketch) -> Arc<Stroke> {
    let mut stroke = (*sketch.strokes[0]).clone();
    stroke.id = 1_000_000;
    let (from, to) = (stroke.points[20].position, stroke.points[12].position);
    let to = from + 0.5 * (to - from).perp();
    let last = stroke.points.len() - 1;
    for (k, point) in stroke.points.iter_mut().enumerate() {
        point.position = from.lerp(to, k as f32 / last as f32);
    }
    stroke.tool = Tool::Branch;
    Arc::new(stroke)
}

/// Milliseconds by stage.
type Times = BTreeMap<&'static str, Vec<f64>>;

fn build(cache: &mut Cache, sketch: &Sketch, times: &mut Times) {
    let begun = Instant::now();
    let species = pipeline::species_of(sketch, Path::new("")).unwrap();
    let params = pipeline::params_of(sketch, &species, &[]).unwrap();
    let built = pipeline::build_with(cache, sketch, &species, &params, &|| false).unwrap();
    let mut note = |stage, took: Duration| times.entry(stage).or_default().push(took.as_secs_f64() * 1e3);
    note("whole", begun.elapsed());
    built.stages.into_iter().for_each(|(stage, took)| note(stage, took));
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
