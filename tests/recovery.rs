//! Nothing lost: a drawing program that is killed at any moment, and what the next start finds.
//!
//! The test program starts itself as a child that draws (see [`child_draws`]), kills it, and looks at what is left.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "helpers of tests fail by panicking; children report"
)]

use penstemon::sketch::document::Document;
use penstemon::sketch::journal::{JournalError, JournalState, JournalWriter, Meta, Recoverable, Recovery};
use penstemon::sketch::{
    Change, Picture, Reference, Sketch, Step, Stroke, StrokeChange, StrokePoint, Textures, Tool,
};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde_json::{Map, Value};
use std::env;
use std::fs::{self, File};
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

/// Longest that a healthy disk is waited for.
const PATIENCE: Duration = Duration::from_secs(60);

/// Steps of one session.
const STEPS: usize = 60;

const PICTURE: &[u8] = include_bytes!("fixtures/reference/small.jpg");

/// A session of an artist: real strokes, and now and then undo, redo, a slider, erasing, moving, a reference picture.
struct Artist {
    document: Document,
    strokes: Vec<Arc<Stroke>>,
    rng: Pcg64Mcg,
}

impl Artist {
    fn new(seed: u64) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sketches/daisy.penstemon");
        let strokes = penstemon::sketch::read(&path).unwrap().0.strokes;
        Self { document: Document::empty(), strokes, rng: Pcg64Mcg::seed_from_u64(seed) }
    }

    /// Does one thing that changes the drawing.
    fn act(&mut self) -> Arc<Step> {
        loop {
            if let Some(step) = self.try_act() {
                return step;
            }
        }
    }

    fn try_act(&mut self) -> Option<Arc<Step>> {
        let drawn = self.document.sketch().strokes.clone();
        match self.rng.random_range(0..20) {
            0 => self.document.undo(),
            1 => self.document.redo(),
            2 => {
                let value = Value::from(self.rng.random_range(0.0..1.0));
                let params = Map::from_iter([("depth.spread".to_owned(), value)]);
                self.document.apply_merging(Change::params(params), "depth.spread").unwrap()
            }
            3 if !drawn.is_empty() => {
                let gone = drawn[self.rng.random_range(0..drawn.len())].id;
                self.document.apply(Change::remove([gone])).unwrap()
            }
            4 if drawn.len() > 1 => {
                let moved = drawn[..2].iter().map(|stroke| {
                    let mut stroke = (**stroke).clone();
                    stroke.points.iter_mut().for_each(|point| point.position.x += 3.5);
                    StrokeChange::Put(stroke.into())
                });
                self.document.apply_merging(Change::strokes(moved.collect()), "move").unwrap()
            }
            5 => {
                let at = self.rng.random_range(0.0..500.0);
                let picture = Picture::new(PICTURE).unwrap();
                self.document
                    .apply(Change::reference(Some(Reference::new(picture, [at, 9.0].into(), 300.0))))
                    .unwrap()
            }
            6 => {
                let textures =
                    Textures::from([("leaf".to_owned(), format!("oak {}", self.rng.random::<u8>()))]);
                self.document.apply(Change::textures(textures)).unwrap()
            }
            _ => {
                let like = self.strokes[self.rng.random_range(0..self.strokes.len())].clone();
                let stroke = Stroke { id: self.document.next_id(), ..(*like).clone() };
                self.document.apply(Change::put(stroke)).unwrap()
            }
        }
    }
}

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
        .args(["--exact", "child_draws", "--nocapture", "--test-threads", "1"])
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
                    assert_eq!(restored.warnings, Vec::<String>::new());
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

fn stroke(id: u64) -> Stroke {
    Stroke {
        id,
        tool: Tool::Petal,
        points: (0..9).map(|k| StrokePoint::at([id as f32, k as f32].into())).collect(),
    }
}

/// Draws strokes and waits until they are on disk.
fn draw(document: &mut Document, writer: &mut JournalWriter, count: usize) {
    for _ in 0..count {
        let step = document.apply(Change::put(stroke(document.next_id()))).unwrap().unwrap();
        writer.append(&step);
    }
    assert_eq!(writer.flush(PATIENCE), JournalState::Saved);
}

fn begin(recovery: &Recovery, title: &str) -> (Document, JournalWriter) {
    let document = Document::empty();
    let meta = Meta { title: title.to_owned(), ..Meta::default() };
    let writer = recovery.start(document.sketch(), meta, true).unwrap();
    (document, writer)
}

fn titles(recovery: &Recovery) -> Vec<String> {
    let mut titles: Vec<String> =
        recovery.list().unwrap().into_iter().map(|found| found.meta.title).collect();
    titles.sort();
    titles
}

#[test]
fn running_windows_are_not_offered_and_abandoned_ones_to_one_window_only() {
    let state = tempfile::tempdir().unwrap();
    let recovery = Recovery::at(state.path());
    let ((mut first, mut one), (mut second, mut two)) = (begin(&recovery, "one"), begin(&recovery, "two"));
    draw(&mut first, &mut one, 3);
    draw(&mut second, &mut two, 2);
    assert_eq!(titles(&recovery), Vec::<String>::new());
    drop(one);
    let held = recovery.list().unwrap();
    assert_eq!(held.len(), 1);
    assert_eq!((held[0].meta.title.as_str(), held[0].strokes()), ("one", 3));
    assert_eq!(titles(&recovery), Vec::<String>::new(), "another window is not offered what this one shows");
    drop(held);
    assert_eq!(titles(&recovery), ["one"]);
    two.close();
    assert_eq!(titles(&recovery), ["one"], "a window that was closed leaves nothing");
    let one = recovery.list().unwrap().pop().unwrap();
    recovery.discard(one).unwrap();
    assert_eq!(fs::read_dir(state.path()).unwrap().count(), 0);
}

#[test]
fn a_restored_drawing_goes_on_and_can_be_lost_again() {
    let state = tempfile::tempdir().unwrap();
    let recovery = Recovery::at(state.path().join("made/when/needed"));
    assert!(recovery.list().unwrap().is_empty());
    let (mut document, mut writer) = begin(&recovery, "lost twice");
    draw(&mut document, &mut writer, 4);
    drop(writer);
    let found = recovery.list().unwrap().pop().unwrap();
    let (restored, meta, mut writer) = recovery.resume(found).unwrap();
    assert_eq!(meta.title, "lost twice");
    assert_eq!(&restored.sketch, document.sketch());
    let mut document = Document::unsaved(restored.sketch);
    assert!(titles(&recovery).is_empty());
    draw(&mut document, &mut writer, 2);
    let undone = document.undo().unwrap();
    writer.append(&undone);
    drop(writer);
    let found = recovery.list().unwrap();
    assert_eq!(found.len(), 1);
    assert_eq!(&found[0].content.as_ref().unwrap().sketch, document.sketch());
}

#[test]
fn only_what_changed_and_is_not_saved_is_recovered() {
    let state = tempfile::tempdir().unwrap();
    let recovery = Recovery::at(state.path());
    let (_, untouched) = begin(&recovery, "opened and looked at");
    untouched.snapshot();
    drop(untouched);
    let (mut document, mut writer) = begin(&recovery, "saved");
    draw(&mut document, &mut writer, 2);
    writer.saved(Meta::default());
    drop(writer);
    assert_eq!(titles(&recovery), Vec::<String>::new());
    let imported =
        recovery.start(document.sketch(), Meta { title: "import".into(), ..Meta::default() }, false);
    drop(imported.unwrap());
    assert_eq!(titles(&recovery), ["import"]);
}

#[test]
fn a_journal_with_any_byte_changed_restores_what_came_before() {
    let state = tempfile::tempdir().unwrap();
    let recovery = Recovery::at(state.path());
    let mut artist = Artist::new(11);
    let mut states = vec![artist.document.sketch().clone()];
    let mut writer = recovery.start(artist.document.sketch(), Meta::default(), false).unwrap();
    for _ in 0..12 {
        writer.append(&artist.act());
        states.push(artist.document.sketch().clone());
    }
    assert_eq!(writer.flush(PATIENCE), JournalState::Saved);
    drop(writer);
    let journal = file(state.path(), "journal");
    let whole = fs::read(&journal).unwrap();
    let mut rng = Pcg64Mcg::seed_from_u64(5);
    for _ in 0..300 {
        let mut changed = whole.clone();
        let at = rng.random_range(0..changed.len());
        changed[at] ^= 1 << rng.random_range(0..8);
        fs::write(&journal, &changed).unwrap();
        match recovery.list().unwrap().pop().unwrap().content {
            Ok(restored) => assert!(states.contains(&restored.sketch), "byte {at}"),
            Err(error) => assert!(matches!(error, JournalError::NewerVersion { .. }), "byte {at}: {error}"),
        }
    }
}

/// The only file below `state` whose name begins so.
fn file(state: &Path, start: &str) -> PathBuf {
    let session = fs::read_dir(state).unwrap().next().unwrap().unwrap().path();
    let files = fs::read_dir(session).unwrap().map(|entry| entry.unwrap().path());
    files.into_iter().find(|path| path.file_name().unwrap().to_str().unwrap().starts_with(start)).unwrap()
}

#[test]
fn a_journal_cut_anywhere_restores_the_finished_steps() {
    let state = tempfile::tempdir().unwrap();
    let recovery = Recovery::at(state.path());
    let mut artist = Artist::new(7);
    let mut states = vec![artist.document.sketch().clone()];
    let mut writer = recovery.start(artist.document.sketch(), Meta::default(), false).unwrap();
    assert_eq!(writer.flush(PATIENCE), JournalState::Saved);
    let mut ends = Vec::new();
    for _ in 0..12 {
        let step = writer.append(&artist.act());
        assert!(writer.wait_until_durable(step, PATIENCE));
        states.push(artist.document.sketch().clone());
        ends.push(fs::metadata(file(state.path(), "journal")).unwrap().len());
    }
    drop(writer);
    let journal = file(state.path(), "journal");
    let whole = fs::read(&journal).unwrap();
    // Every byte near the ends of records, and a few hundred others.
    let near = |cut: u64| ends.iter().any(|end| end.abs_diff(cut) < 12) || cut < 40 || cut.is_multiple_of(23);
    for cut in (0..=whole.len() as u64).filter(|cut| near(*cut)) {
        fs::write(&journal, &whole[..cut as usize]).unwrap();
        let finished = ends.iter().filter(|end| **end <= cut).count();
        let found = recovery.list().unwrap().pop().unwrap();
        assert_eq!(found.content.unwrap().sketch, states[finished], "cut at {cut}");
    }
}

#[test]
fn copies_of_a_newer_program_are_kept_and_said_to_be_so() {
    let state = tempfile::tempdir().unwrap();
    let recovery = Recovery::at(state.path());
    let (mut document, mut writer) = begin(&recovery, "from the future");
    draw(&mut document, &mut writer, 2);
    drop(writer);
    let newer = |start: &str, old: &str, new: &str| {
        let path = file(state.path(), start);
        let text = String::from_utf8(fs::read(&path).unwrap()).unwrap();
        fs::write(&path, text.replacen(old, new, 1)).unwrap();
        let found = recovery.list().unwrap().pop().unwrap();
        fs::write(&path, text).unwrap();
        assert_eq!(found.meta.title, "from the future");
        let error = recovery.resume(found).unwrap_err();
        assert!(matches!(error, JournalError::NewerVersion { version: 9.0, .. }), "{error}");
        assert!(error.to_string().contains("newer Penstemon (version 9)"), "{error}");
    };
    newer("snapshot", "\"version\": 1", "\"version\": 9");
    newer("journal", "journal 1", "journal 9");
    assert_eq!(recovery.list().unwrap()[0].strokes(), 2);
}

#[test]
fn a_damaged_copy_is_told_and_kept_until_it_is_discarded() {
    let state = tempfile::tempdir().unwrap();
    let recovery = Recovery::at(state.path());
    let (mut document, mut writer) = begin(&recovery, "damaged");
    draw(&mut document, &mut writer, 2);
    drop(writer);
    let snapshot = file(state.path(), "snapshot");
    File::options().write(true).open(&snapshot).unwrap().set_len(100).unwrap();
    let found = recovery.list().unwrap().pop().unwrap();
    let message = found.content.as_ref().unwrap_err().to_string();
    assert!(message.contains("is damaged") && message.contains("snapshot-1"), "{message}");
    assert!(snapshot.exists());
    recovery.discard(found).unwrap();
    assert!(!snapshot.exists());
}

#[test]
fn a_state_folder_that_cannot_be_written_is_told_while_drawing_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let in_the_way = folder.path().join("file");
    fs::write(&in_the_way, b"").unwrap();
    let recovery = Recovery::at(in_the_way.join("state"));
    let (mut document, mut writer) = begin(&recovery, "nowhere");
    let step = document.apply(Change::put(stroke(1))).unwrap().unwrap();
    let number = writer.append(&step);
    assert!(!writer.wait_until_durable(number, PATIENCE), "failing ends the wait");
    let JournalState::Failed(message) = writer.state() else { panic!("{:?}", writer.state()) };
    assert!(message.contains("there is no folder") && message.contains("go on drawing"), "{message}");
    assert_eq!(document.sketch().strokes.len(), 1);
    writer.close();
}

/// Not a test of its own: draws under a limit on the size of files, which is how a full disk feels.
#[cfg(unix)]
#[test]
fn child_on_a_full_disk() {
    let Ok(folder) = env::var("PENSTEMON_TEST_FULL") else { return };
    let recovery = Recovery::at(folder);
    let (mut document, mut writer) = begin(&recovery, "full");
    let mut failed = false;
    for id in 1..400 {
        let number = writer.append(&document.apply(Change::put(stroke(id))).unwrap().unwrap());
        failed |= !writer.wait_until_durable(number, PATIENCE);
    }
    assert!(failed);
    let JournalState::Failed(message) = writer.state() else { panic!("{:?}", writer.state()) };
    assert!(message.contains("the disk is full; free some space"), "{message}");
    assert_eq!(document.sketch().strokes.len(), 399, "the drawing is still there");
    println!("survived");
}

#[cfg(unix)]
#[test]
fn a_full_disk_is_told_and_what_was_written_before_is_kept() {
    let state = tempfile::tempdir().unwrap();
    let program = env::current_exe().unwrap();
    // Blocks of 512 bytes; without the trap the system would end the program instead of refusing the write.
    let script = "trap '' XFSZ; ulimit -f 24; exec \"$0\" --exact child_on_a_full_disk --nocapture";
    let output = Command::new("sh")
        .args(["-c", script, program.to_str().unwrap()])
        .env("PENSTEMON_TEST_FULL", state.path())
        .output()
        .unwrap();
    let report = String::from_utf8_lossy(&output.stdout);
    assert!(report.contains("survived"), "{report}\n{}", String::from_utf8_lossy(&output.stderr));
    let found = Recovery::at(state.path()).list().unwrap().pop().unwrap();
    let strokes = found.strokes();
    assert!((10..399).contains(&strokes), "{strokes}");
    let drawn = &found.content.as_ref().unwrap().sketch.strokes;
    assert!(drawn.iter().zip(1..).all(|(found, id)| **found == stroke(id)));
}
