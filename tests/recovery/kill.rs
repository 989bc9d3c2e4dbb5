//! The program is killed at any moment of a session.

use super::artist::Artist;
use super::{PATIENCE, test_name};
use glam::{DVec2, Vec2};
use penstemon::app::action::Action;
use penstemon::app::editor::{Editor, Places};
use penstemon::file_system::{Access, FileSystem, System, WrittenFile};
use penstemon::pen::{PenButtons, PenEvent, PenPhase, PenSample, PenTool};
use penstemon::sketch::journal::{JournalState, Meta, Recoverable, Recovery};
use penstemon::sketch::{Change, Sketch};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::env;
use std::io::{self, BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

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
        .args(["--exact", &test_name(module_path!(), "child_draws"), "--nocapture", "--test-threads", "1"])
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

/// How long before the kill a pen was lifted for its stroke to be asked for.
const SEEN: Duration = Duration::from_millis(50);

/// Not a test of its own: the editor of the window, with a pen that draws stroke after stroke. Says when it has seen that the
/// pen is lifted; the plant is built beside it.
#[test]
fn child_draws_in_the_editor() {
    let Ok(home) = env::var("PENSTEMON_TEST_HOME") else { return };
    let home = Path::new(&home);
    let places = Places { config: home.join("config"), state: home.join("state") };
    let mut editor = Editor::open_in(places, None, || ()).unwrap();
    editor.perform(Action::New);
    println!("drawing");
    let mut time_ms = 0.0;
    for stroke in 1..=STEPS {
        for k in 0..=24 {
            let phase = match k {
                0 => PenPhase::Down,
                24 => PenPhase::Up,
                _ => PenPhase::Move,
            };
            time_ms += 2.0;
            let position = DVec2::new(20.0 + 12.0 * f64::from(k), 30.0 + 9.0 * stroke as f64);
            let sample = PenSample {
                position,
                pressure: 0.6,
                tilt_deg: Vec2::ZERO,
                twist_deg: 0.0,
                distance: 0.0,
                tool: PenTool::Pen,
                buttons: PenButtons::default(),
                time_ms,
            };
            editor.pen(PenEvent { phase, sample });
            if phase == PenPhase::Up {
                println!("up {stroke}");
            }
            // As the window does after the events of a moment.
            editor.collect();
            editor.submit();
            thread::sleep(Duration::from_millis(1));
        }
    }
    thread::sleep(PATIENCE);
}

/// Kills the editor at a random moment: strokes whose pen was seen lifted [`SEEN`] before, all whose pen was seen lifted, and
/// strokes found.
fn kill_editor(seed: u64) -> [usize; 3] {
    let mut rng = Pcg64Mcg::seed_from_u64(7000 + seed);
    let home = tempfile::tempdir().unwrap();
    let mut child = Command::new(env::current_exe().unwrap())
        .args([
            "--exact",
            &test_name(module_path!(), "child_draws_in_the_editor"),
            "--nocapture",
            "--test-threads",
            "1",
        ])
        .env("PENSTEMON_TEST_HOME", home.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let mut lines = BufReader::new(child.stdout.take().unwrap()).lines().map_while(Result::ok);
    let ups = |line: &str| Some(line.split_once("up ")?.1.trim().parse::<usize>().unwrap());
    let until = rng.random_range(1..16);
    let mut seen: Vec<Instant> = Vec::new();
    while seen.len() < until {
        let line = lines.next().unwrap();
        seen.extend(ups(&line).map(|_| Instant::now()));
    }
    // Into the air between two strokes, or into the next, or two.
    let pause = Duration::from_micros(rng.random_range(0..90_000));
    let reader = thread::spawn(move || {
        lines.filter_map(|line| ups(&line)).map(|_| Instant::now()).collect::<Vec<Instant>>()
    });
    thread::sleep(pause);
    let killed = Instant::now();
    child.kill().unwrap();
    child.wait().unwrap();
    seen.extend(reader.join().unwrap());
    let asked = seen.iter().filter(|at| killed.saturating_duration_since(**at) >= SEEN).count();
    let found = Recovery::at(home.path().join("state")).list().unwrap();
    assert!(found.iter().all(|one| one.content.as_ref().is_ok_and(|restored| restored.gaps.is_empty())));
    [asked, seen.len(), found.first().map_or(0, |one| one.strokes())]
}

#[test]
fn killed_200_times_the_editor_keeps_every_stroke_whose_pen_was_seen_lifted() {
    const KILLS: u64 = 200;
    const AT_ONCE: u64 = 4;
    let run = |worker: u64| (worker..KILLS).step_by(AT_ONCE as usize).map(kill_editor).collect::<Vec<_>>();
    let kills: Vec<[usize; 3]> = thread::scope(|scope| {
        let threads: Vec<_> = (0..AT_ONCE).map(|worker| scope.spawn(move || run(worker))).collect();
        threads.into_iter().flat_map(|thread| thread.join().unwrap()).collect()
    });
    let sum = |of: &dyn Fn(&[usize; 3]) -> usize| kills.iter().map(of).sum::<usize>();
    let lost = sum(&|[asked, _, found]| asked.saturating_sub(*found));
    println!(
        "{KILLS} kills: of {} strokes whose pen was lifted {} ms before, {lost} lost; of all {} lifted, {} lost",
        sum(&|kill| kill[0]),
        SEEN.as_millis(),
        sum(&|kill| kill[1]),
        sum(&|[_, seen, found]| seen.saturating_sub(*found)),
    );
    assert_eq!(lost, 0);
}

/// Not a test of its own: draws eight strokes on a disk that takes a second and a half for every flush.
#[test]
fn child_draws_on_a_slow_disk() {
    let Ok(folder) = env::var("PENSTEMON_TEST_SLOW") else { return };
    let recovery = Recovery::on(Arc::new(Slow(Duration::from_millis(1500))), folder);
    let (mut document, mut writer) = super::begin(&recovery, "slow");
    for id in 1..=8 {
        let begun = Instant::now();
        writer.append(&document.apply(Change::put(super::stroke(id))).unwrap().unwrap());
        assert!(begun.elapsed() < Duration::from_millis(20), "the window waited for the disk");
        thread::sleep(SEEN);
    }
    let JournalState::Saving { steps, since } = writer.state() else { panic!("{:?}", writer.state()) };
    assert!(steps == 8 && since.elapsed() >= 8 * SEEN, "{steps} behind");
    println!("drawn");
    thread::sleep(PATIENCE);
}

#[test]
fn killed_on_a_slow_disk_every_stroke_is_found() {
    let state = tempfile::tempdir().unwrap();
    let mut child = Command::new(env::current_exe().unwrap())
        .args([
            "--exact",
            &test_name(module_path!(), "child_draws_on_a_slow_disk"),
            "--nocapture",
            "--test-threads",
            "1",
        ])
        .env("PENSTEMON_TEST_SLOW", state.path())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut lines = BufReader::new(child.stdout.take().unwrap()).lines().map_while(Result::ok);
    assert!(lines.any(|line| line.contains("drawn")));
    child.kill().unwrap();
    child.wait().unwrap();
    let found = Recovery::at(state.path()).list().unwrap();
    assert_eq!(found.iter().map(Recoverable::strokes).collect::<Vec<_>>(), [8]);
}

/// A disk on which every flush takes so long.
#[derive(Clone, Copy, Debug)]
struct Slow(Duration);

impl FileSystem for Slow {
    fn create_new(&self, path: &Path, access: &Access) -> io::Result<Arc<dyn WrittenFile>> {
        Ok(Arc::new(SlowFile(*self, System.create_new(path, access)?)))
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        System.rename(from, to)
    }

    fn remove_file(&self, path: &Path) -> io::Result<()> {
        System.remove_file(path)
    }

    fn create_folder(&self, path: &Path) -> io::Result<()> {
        System.create_folder(path)
    }

    fn remove_folder(&self, path: &Path) -> io::Result<()> {
        System.remove_folder(path)
    }

    fn flush_folder(&self, path: &Path) -> io::Result<()> {
        thread::sleep(self.0);
        System.flush_folder(path)
    }
}

#[derive(Debug)]
struct SlowFile(Slow, Arc<dyn WrittenFile>);

impl WrittenFile for SlowFile {
    fn append(&self, bytes: &[u8]) -> io::Result<()> {
        self.1.append(bytes)
    }

    fn flush(&self) -> io::Result<()> {
        thread::sleep(self.0.0);
        self.1.flush()
    }
}
