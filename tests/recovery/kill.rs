//! The program is killed at any moment of a session.

use super::PATIENCE;
use super::artist::Artist;
use penstemon::sketch::Sketch;
use penstemon::sketch::journal::{JournalState, Meta, Recoverable, Recovery};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::env;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

/// Steps of one session.
const STEPS: usize = 60;

/// Not a test of its own: what the killed program does. Prints how many steps are on disk.
#[test]
fn child_draws() {
    let (Ok(folder), Ok(seed)) = (env::var("PENSTEMON_TEST_STATE"), env::var("PENSTEMON_TEST_SEED")) else {
        return;
    };
    let mut artist = Artist::new(seed.parse().unwrap());
    let sketch = artist.document.sketch().clone();
    let mut writer = Recovery::at(folder).start(&sketch, Meta::default(), true).unwrap();
    println!("drawing");
    for step in 1..=STEPS {
        let number = writer.append(&artist.act());
        // Several steps on their way together, as when a slider is dragged; and snapshots in between.
        if artist.rng.random_range(0..8) == 0 {
            writer.snapshot();
        }
        if artist.rng.random_range(0..4) > 0 {
            assert!(writer.wait_until_durable(number, PATIENCE));
            println!("durable {step}");
        }
    }
    assert_eq!(writer.flush(PATIENCE), JournalState::Saved);
    println!("durable {STEPS}");
    thread::sleep(PATIENCE);
}

fn start_child(state: &Path, seed: u64) -> Child {
    Command::new(env::current_exe().unwrap())
        .args(["--exact", "kill::child_draws", "--nocapture", "--test-threads", "1"])
        .env("PENSTEMON_TEST_STATE", state)
        .env("PENSTEMON_TEST_SEED", seed.to_string())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

/// Steps that a line of the child's report says are on disk.
fn durable(line: &str) -> Option<usize> {
    line.split_once("durable ")?.1.trim().parse().ok()
}

/// Kills a drawing child at a random moment; the number of steps that it had reported, and what was found.
fn kill_once(seed: u64) -> (usize, Vec<Recoverable>) {
    let mut rng = Pcg64Mcg::seed_from_u64(1000 + seed);
    let state = tempfile::tempdir().unwrap();
    let mut child = start_child(state.path(), seed);
    let mut lines = BufReader::new(child.stdout.take().unwrap()).lines().map_while(Result::ok);
    // By progress, not by time, so that slow machines kill as late as fast ones; then some microseconds further.
    let until = rng.random_range(0..STEPS);
    let mut reported = 0;
    for line in lines.by_ref() {
        reported = durable(&line).unwrap_or(reported);
        if reported >= until && (line.contains("drawing") || reported > 0) {
            break;
        }
    }
    thread::sleep(Duration::from_micros(rng.random_range(0..3000)));
    child.kill().unwrap();
    child.wait().unwrap();
    // What it had said before it died counts as well.
    reported = lines.filter_map(|line| durable(&line)).last().unwrap_or(reported);
    (reported, Recovery::at(state.path()).list().unwrap())
}

/// Every state that the child goes through: after so many steps.
fn states(seed: u64) -> Vec<Sketch> {
    let mut artist = Artist::new(seed);
    let mut states = vec![artist.document.sketch().clone()];
    for _ in 0..STEPS {
        artist.act();
        states.push(artist.document.sketch().clone());
        // The child's own choices take from the same stream.
        artist.rng.random_range(0..8);
        artist.rng.random_range(0..4);
    }
    states
}

#[test]
fn killed_at_200_random_moments_every_finished_stroke_is_found() {
    const KILLS: u64 = 200;
    const AT_ONCE: u64 = 4;
    let in_the_middle = AtomicUsize::new(0);
    let kill_some = &|worker: u64| {
        for seed in (worker..KILLS).step_by(AT_ONCE as usize) {
            let (reported, found) = kill_once(seed);
            in_the_middle.fetch_add(usize::from((1..STEPS).contains(&reported)), Ordering::Relaxed);
            let states = states(seed);
            let sketch = match found.as_slice() {
                [] => &states[0],
                [one] => {
                    let restored = one.content.as_ref().unwrap();
                    assert!(restored.gaps.is_empty(), "{:?}", restored.gaps);
                    &restored.sketch
                }
                more => panic!("{} drawings found", more.len()),
            };
            let reached = states[reported..].iter().any(|state| state == sketch);
            assert!(
                reached,
                "session {seed}: {reported} steps were on disk, found {} strokes",
                sketch.strokes.len()
            );
        }
    };
    thread::scope(|scope| {
        for worker in 0..AT_ONCE {
            scope.spawn(move || kill_some(worker));
        }
    });
    let in_the_middle = in_the_middle.into_inner();
    assert!(
        in_the_middle > KILLS as usize * 3 / 4,
        "only {in_the_middle} children were killed while they drew"
    );
}
