//! Where the time of one more sample goes: the pipeline alone, with a cache, stage by stage.

use crate::drawings;
use penstemon::pipeline::{self, Cache};
use penstemon::sketch::{Sketch, Stroke, StrokePoint, Tool};
use penstemon::species::Species;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Samples that are drawn one by one.
const SAMPLES: usize = 200;
/// Samples for each build from scratch.
const SCRATCH: usize = 50;

/// Builds large drawings anew with every sample of one more stroke, those of a quarter of the size in turn with the whole
/// ones and with builds from scratch, and tells what the stages take. A ratio near to 1 says that a sample costs the same in
/// a larger drawing.
pub(crate) fn print(many: usize) {
    let (meadows, trees) =
        ([many / 4, many].map(drawings::meadow), [many / 4, many].map(drawings::leafy_tree));
    compare("drawing", many, "strokes", meadows, 0);
    // A branch more on the trunk turns all others on it to other sides, and all that they carry with them.
    compare("tree, on its trunk,", many, "leaves", trees.clone(), 0);
    compare("tree, on a bough,", many, "leaves", trees, 5);
}

fn compare(name: &str, many: usize, unit: &str, mut sketches: [Sketch; 2], on: usize) {
    let mut times: [Times; 3] = Default::default();
    let mut lives = [Live::default(), Live::default()];
    for (sketch, live) in sketches.iter().zip(&mut lives) {
        build(live, sketch, &mut Times::default());
    }
    let stroke = extra(&sketches[0].strokes[on]);
    sketches.iter_mut().for_each(|sketch| sketch.strokes.push(Arc::clone(&stroke)));
    for count in 2..2 + SAMPLES {
        for ((sketch, live), times) in sketches.iter_mut().zip(&mut lives).zip(&mut times) {
            let mut drawn = (*stroke).clone();
            drawn.points.truncate(count);
            if let Some(last) = sketch.strokes.last_mut() {
                *last = Arc::new(drawn);
            }
            build(live, sketch, times);
        }
        if count % SCRATCH == 0 {
            build(&mut Live::default(), &sketches[1], &mut times[2]);
        }
    }
    println!("one more sample on a {name} of {} and of {many} {unit}, milliseconds", many / 4);
    println!("  {:12}{:>10}{:>10}{:>8}{:>10}{:>14}", "", "few", "many", "ratio", "p99", "from scratch");
    let names: Vec<&str> = times[1].keys().copied().collect();
    for stage in names {
        let mut of =
            |k: usize, share: f64| times[k].get_mut(stage).map_or(0.0, |times| quantile(times, share));
        let ([few, many, scratch], slow) = ([0, 1, 2].map(|k| of(k, 0.5)), of(1, 0.99));
        println!("  {stage:12}{few:10.2}{many:10.2}{:8.2}{slow:10.2}{scratch:14.2}", many / few);
    }
}

/// A stem on a stroke, which stands well inside of the drawing.
fn extra(on: &Stroke) -> Arc<Stroke> {
    let (from, to) = (on.points[20], on.points[12].position);
    let to = from.position + 0.5 * (to - from.position).perp();
    let last = (SAMPLES + 1) as f32;
    let point = |k: usize| StrokePoint { position: from.position.lerp(to, k as f32 / last), ..from };
    Arc::new(Stroke {
        id: 1_000_000,
        tool: Tool::Branch,
        points: (0..SAMPLES + 2).map(point).collect(),
        brush: None,
    })
}

/// Milliseconds by stage.
type Times = BTreeMap<&'static str, Vec<f64>>;

/// What the window keeps of a drawing: the species is read again only when the drawing shows another plant.
#[derive(Default)]
struct Live {
    cache: Cache,
    species: Option<(String, Species)>,
}

fn build(live: &mut Live, sketch: &Sketch, times: &mut Times) {
    let begun = Instant::now();
    let name = live.cache.species_name(sketch);
    if live.species.as_ref().is_none_or(|(known, _)| *known != name) {
        live.species = Some((name.clone(), Species::built_in(&name).unwrap()));
    }
    let Some((_, species)) = &live.species else { unreachable!("it was just read") };
    let params = pipeline::params_of(sketch, species, &[]).unwrap();
    let built = pipeline::build_with(&mut live.cache, sketch, species, &params, &|| false).unwrap();
    let mut note = |stage, took: Duration| times.entry(stage).or_default().push(took.as_secs_f64() * 1e3);
    note("whole", begun.elapsed());
    built.stages.into_iter().for_each(|(stage, took)| note(stage, took));
}

fn quantile(times: &mut [f64], share: f64) -> f64 {
    times.sort_by(f64::total_cmp);
    times[((times.len() - 1) as f64 * share).round() as usize]
}
