//! Tests of the live worker: the newest drawing is built, and what did not change is shared.

use super::*;
use std::sync::mpsc::{Receiver, channel};

fn drawing(name: &str) -> Sketch {
    let path = format!("{}/assets/sketches/{name}.penstemon", env!("CARGO_MANIFEST_DIR"));
    crate::sketch::read(std::path::Path::new(&path)).unwrap().0
}

fn start() -> (Worker, Receiver<()>) {
    let (send, wakes) = channel();
    let worker = Worker::start(move || send.send(()).unwrap_or(())).unwrap();
    (worker, wakes)
}

fn snapshot(revision: u64, sketch: &Sketch) -> Snapshot {
    let mut sketch = sketch.clone();
    let strokes = Arc::new(std::mem::take(&mut sketch.strokes));
    Snapshot { revision, sketch, strokes, growing: None, folder: PathBuf::new(), overlay: Wanted::default() }
}

/// Waits for the result of a revision.
fn result(worker: &Worker, wakes: &Receiver<()>, revision: u64) -> Result<Arc<Built>, BuildError> {
    loop {
        wakes.recv_timeout(Duration::from_secs(60)).unwrap();
        match worker.take() {
            Some(update) if update.revision == revision => return update.result,
            _ => {}
        }
    }
}

#[test]
fn the_newest_of_many_snapshots_is_built() {
    let (worker, wakes) = start();
    let daisy = drawing("daisy");
    for count in 1..=daisy.strokes.len() {
        let mut part = daisy.clone();
        part.strokes.truncate(count);
        worker.submit(snapshot(count as u64, &part));
    }
    let built = result(&worker, &wakes, daisy.strokes.len() as u64).unwrap();
    let species = pipeline::species_of(&daisy, std::path::Path::new("")).unwrap();
    let params = pipeline::params_of(&daisy, &species, &[]).unwrap();
    assert_eq!(built.model, pipeline::build(&daisy, &species, &params).model);
}

#[test]
fn parts_that_did_not_change_are_the_very_same() {
    let (worker, wakes) = start();
    let mut daisy = drawing("daisy");
    worker.submit(snapshot(1, &daisy));
    let before = result(&worker, &wakes, 1).unwrap();
    // The last petal is redrawn a little shorter.
    let petal = daisy.strokes.iter().rposition(|s| s.tool == daisy.strokes[0].tool).unwrap();
    let middle = daisy.strokes[petal].points[0].position;
    for point in &mut Arc::make_mut(&mut daisy.strokes[petal]).points {
        point.position = middle + 0.98 * (point.position - middle);
    }
    worker.submit(snapshot(2, &daisy));
    let after = result(&worker, &wakes, 2).unwrap();
    let old: Vec<_> = before.model.parts.iter().map(|p| Arc::as_ptr(&p.mesh)).collect();
    let kept = after.model.parts.iter().filter(|p| old.contains(&Arc::as_ptr(&p.mesh))).count();
    assert!(kept > 0 && kept < after.model.parts.len(), "{kept} of {} parts kept", after.model.parts.len());
}

#[test]
fn the_stroke_under_the_pen_is_put_together_from_what_is_new_of_it() {
    let mut daisy = drawing("daisy");
    let last = daisy.strokes.pop().unwrap();
    let mut state = State::default();
    let mut settled = 0;
    for count in 1..=last.points.len() {
        // The last three points are elsewhere until they have settled.
        let mut points = last.points[settled..count].to_vec();
        let kept = std::mem::replace(&mut settled, count.saturating_sub(3));
        points[settled - kept..].iter_mut().for_each(|p| p.position.y += 1.0);
        assert!(points.len() <= 4);
        state.follow(Some(Growing { id: last.id, tool: last.tool, kept, points, brush: None }));
    }
    let points = last.points[settled..].to_vec();
    state.follow(Some(Growing { id: last.id, tool: last.tool, kept: settled, points, brush: None }));
    assert_eq!(state.growing.as_ref(), Some(&*last));
    state.follow(None);
    assert_eq!(state.growing, None);
}

#[test]
fn a_plant_that_cannot_be_built_says_why_and_the_next_is_built() {
    let (worker, wakes) = start();
    let mut daisy = drawing("daisy");
    let species = daisy.species.replace("dasy".into());
    worker.submit(snapshot(1, &daisy));
    let reason = result(&worker, &wakes, 1).unwrap_err().to_string();
    assert!(reason.contains("dasy") && reason.contains("daisy"), "{reason}");
    daisy.species = species;
    worker.submit(snapshot(2, &daisy));
    assert!(result(&worker, &wakes, 2).is_ok());
}

#[test]
fn a_storm_of_snapshots_still_shows_a_plant_and_ends_with_the_newest() {
    let (worker, wakes) = start();
    let tree = drawing("tree_round");
    for revision in 1..=200 {
        worker.submit(snapshot(revision, &tree));
        std::thread::sleep(Duration::from_millis(2));
    }
    // Many were finished on the way, although each newer one cancels.
    let built = result(&worker, &wakes, 200).unwrap();
    assert!(built.model.triangle_count() > 0);
}
