//! Every operation on the disk goes wrong once, and the power goes at every moment: nothing that was said to be safe is lost.

use super::PATIENCE;
use super::artist::Artist;
use super::simulated::{Disk, Fault, Loss};
use penstemon::atomic::write_group_atomically;
use penstemon::sketch::journal::{JournalState, JournalWriter, Meta, Recovery};
use penstemon::sketch::save::save_on;
use penstemon::sketch::{self, Sketch};
use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// Steps of the session.
const STEPS: usize = 14;

/// The step after which it is saved in its file.
const SAVED_AT: usize = 10;

/// The drawing after so many steps.
fn states() -> Vec<Sketch> {
    let mut artist = Artist::new(3);
    let mut states = vec![artist.document.sketch().clone()];
    for _ in 0..STEPS {
        artist.act();
        states.push(artist.document.sketch().clone());
    }
    states
}

/// Draws, with snapshots and a saving in between, and promises each step when it is said to be safe.
fn draw_on(disk: &Disk, state: &Path) {
    let mut artist = Artist::new(3);
    let recovery = Recovery::on(Arc::new(disk.clone()), state);
    let mut writer = recovery.start(artist.document.sketch(), Meta::default(), true).unwrap();
    let begun = Instant::now();
    let wait = |writer: &JournalWriter| {
        while writer.flush(PATIENCE) != JournalState::Saved {
            assert!(begun.elapsed() < PATIENCE, "it never recovers from one failure");
            thread::sleep(Duration::from_millis(5));
        }
    };
    for step in 1..=STEPS {
        writer.append(&artist.act());
        // Two steps on their way together, now and then.
        if step % 4 != 1 {
            wait(&writer);
            disk.promise(step);
        }
        match step {
            3 | 6 | 11 => writer.snapshot(),
            SAVED_AT => writer.saved(Meta { title: "saved".into(), ..Meta::default() }, writer.last_step()),
            _ => {}
        }
    }
    wait(&writer);
    disk.promise(STEPS);
}

/// Looks at what is found after a crash at a moment. Whether a gap was told.
fn check(disk: &Disk, moment: usize, loss: Loss, states: &[Sketch], run: &str) -> bool {
    let folder = tempfile::tempdir().unwrap();
    let promised = disk.after_crash(moment, loss, folder.path());
    let found = Recovery::at(folder.path().join("state")).list().unwrap();
    let at = format!("{run}, crash at {moment}, {loss:?} lost, {promised} steps promised");
    match found.as_slice() {
        [] => {
            assert!(promised == 0 || promised == SAVED_AT, "{at}: nothing is found");
            false
        }
        [one] => match &one.content {
            Ok(restored) => {
                let is_known = states[promised..].contains(&restored.sketch);
                assert!(is_known, "{at}: {} strokes, {:?}", restored.sketch.strokes.len(), restored.gaps);
                !restored.gaps.is_empty()
            }
            Err(error) => {
                assert_eq!(promised, 0, "{at}: {error}");
                true
            }
        },
        more => panic!("{at}: {} drawings are found", more.len()),
    }
}

#[test]
fn a_crash_at_any_moment_loses_nothing_that_was_safe() {
    let root = tempfile::tempdir().unwrap();
    let disk = Disk::new(root.path(), None);
    draw_on(&disk, &fs::canonicalize(root.path()).unwrap().join("state"));
    let states = states();
    for moment in 0..disk.moments() {
        for loss in Loss::ALL {
            let has_gap = check(&disk, moment, loss, &states, "no fault");
            assert!(!(has_gap && loss == Loss::Nothing), "a killed program leaves no gap, moment {moment}");
        }
    }
    println!("{} moments, {} kinds of loss: nothing lost", disk.moments(), Loss::ALL.len());
}

#[test]
fn any_operation_that_fails_or_is_cut_short_loses_nothing_that_was_safe() {
    let states = states();
    let next = AtomicUsize::new(0);
    let run_some = || {
        loop {
            let operation = next.fetch_add(1, Ordering::Relaxed);
            let mut is_over = true;
            for fault in Fault::ALL {
                let root = tempfile::tempdir().unwrap();
                let disk = Disk::new(root.path(), Some((operation, fault)));
                draw_on(&disk, &fs::canonicalize(root.path()).unwrap().join("state"));
                is_over &= disk.operations() <= operation;
                let last = disk.moments() - 1;
                for moment in (operation % 5..last).step_by(5).chain([last]) {
                    for loss in [Loss::Nothing, Loss::Everything, Loss::Content] {
                        check(&disk, moment, loss, &states, &format!("operation {operation} {fault:?}"));
                    }
                }
            }
            if is_over {
                return operation;
            }
        }
    };
    let operations = thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(run_some)).collect();
        threads.into_iter().map(|thread| thread.join().unwrap()).max().unwrap()
    });
    println!("each of {operations} operations failed once and was cut short once: nothing lost");
}

/// Does something to a disk on which there is already `old`, with every operation going wrong once and the power going at
/// every moment; `check` looks at what is left below a folder, and knows whether success was reported.
fn try_everything(
    old: &dyn Fn(&Disk, &Path),
    new: &dyn Fn(&Disk, &Path) -> bool,
    check: &dyn Fn(&Path, bool, &str),
) {
    let mut operations = usize::MAX;
    let mut number = 0;
    while number < operations {
        for fault in Fault::ALL {
            let root = tempfile::tempdir().unwrap();
            let path = fs::canonicalize(root.path()).unwrap();
            let disk = Disk::new(&path, Some((number, fault)));
            old(&disk, &path);
            let before = disk.moments();
            if new(&disk, &path) {
                disk.promise(1);
            }
            operations = disk.operations();
            for moment in before - 1..disk.moments() {
                for loss in Loss::ALL {
                    let folder = tempfile::tempdir().unwrap();
                    let is_done = disk.after_crash(moment, loss, folder.path()) == 1;
                    check(
                        folder.path(),
                        is_done,
                        &format!("operation {number} {fault:?}, {moment}, {loss:?}"),
                    );
                }
            }
        }
        number += 1;
    }
}

/// Writes a file so that it is safe, whatever else goes wrong.
fn put(disk: &Disk, path: &Path, bytes: &[u8]) {
    while write_group_atomically(disk, &[(path.to_owned(), bytes)]).is_err() {}
}

#[test]
fn saving_leaves_the_old_or_the_new_drawing_and_the_new_once_it_is_saved() {
    let states = states();
    let (old, new) = (&states[4], &states[STEPS]);
    let text = sketch::json::write(old);
    try_everything(
        &|disk, root| put(disk, &root.join("rose.penstemon"), text.as_bytes()),
        &|disk, root| save_on(disk, &root.join("rose.penstemon"), new, None).is_ok(),
        &|root, is_saved, at| {
            let found = sketch::read(&root.join("rose.penstemon")).unwrap_or_else(|e| panic!("{at}: {e}")).0;
            assert!(found == *new || (!is_saved && found == *old), "{at}");
        },
    );
}

#[test]
fn an_export_leaves_each_file_whole_and_all_of_them_new_once_it_is_written() {
    let names = ["plant.png", "plant.mtl", "plant.obj"];
    let content = |name: &str, age: &str| format!("{age} {name}").repeat(50).into_bytes();
    let write = |disk: &Disk, root: &Path| {
        let new: Vec<_> = names.map(|name| (root.join(name), content(name, "new"))).into();
        let group: Vec<_> = new.iter().map(|(path, bytes)| (path.clone(), bytes.as_slice())).collect();
        write_group_atomically(disk, &group).is_ok()
    };
    try_everything(
        &|disk, root| names.iter().for_each(|name| put(disk, &root.join(name), &content(name, "old"))),
        &write,
        &|root, is_written, at| {
            for name in names {
                let found = fs::read(root.join(name)).unwrap();
                let is_old = found == content(name, "old");
                assert!(found == content(name, "new") || (is_old && !is_written), "{at}: {name}");
            }
        },
    );
}
