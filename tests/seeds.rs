//! The seeds of every fuzz target, through what the target checks: each as it is, each cut short, each with some of its
//! bytes changed. What no fuzzer runs for is so seen by every test run; new inputs are looked for by `./test.sh --fuzz`.
//!
//! What a fuzzer has left in `fuzz/corpus` and `fuzz/artifacts` on this machine is replayed, too.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]
#![allow(unreachable_pub, reason = "shared with the fuzzer, where it is public")]

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::fs;
use std::path::{Path, PathBuf};

#[path = "../fuzz/src/lib.rs"]
mod checks;
#[path = "../fuzz/src/picture.rs"]
mod picture;

/// Changed copies of every seed.
const CHANGED: usize = 40;
/// Most places in a copy that are changed.
const PLACES: usize = 4;

fn files(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

/// A copy with some bytes changed, taken out or doubled, or cut short.
fn changed(bytes: &[u8], random: &mut Pcg64Mcg) -> Vec<u8> {
    let mut copy = bytes.to_vec();
    for _ in 0..random.random_range(1..=PLACES) {
        if copy.is_empty() {
            break;
        }
        let place = random.random_range(0..copy.len());
        match random.random_range(0..6) {
            0 => copy[place] ^= 1 << random.random_range(0..8),
            1 => copy[place] = random.random(),
            2 => copy[place] = bytes[random.random_range(0..bytes.len())],
            3 => drop(copy.remove(place)),
            4 => {
                let end = (place + random.random_range(1..32)).min(copy.len());
                let run = copy[place..end].to_vec();
                copy.splice(place..place, run);
            }
            _ => copy.truncate(place),
        }
    }
    copy
}

/// Gives a target all that is known of it. A failure names the file before it.
fn replay(target: &str, check: fn(&[u8])) {
    let fuzz = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz");
    let seeds = files(&fuzz.join("seeds").join(target));
    assert!(!seeds.is_empty(), "{target} has no seed");
    for path in &seeds {
        eprintln!("{}", path.display());
        let bytes = fs::read(path).unwrap();
        check(&bytes);
        let mut random = Pcg64Mcg::seed_from_u64(2026);
        for number in 0..CHANGED {
            eprintln!("copy {number}");
            check(&changed(&bytes, &mut random));
        }
    }
    for path in ["corpus", "artifacts"].iter().flat_map(|folder| files(&fuzz.join(folder).join(target))) {
        eprintln!("{}", path.display());
        check(&fs::read(path).unwrap());
    }
}

/// A test for every target, named like it.
macro_rules! targets {
    ($($target:ident: $check:path,)*) => {
        const TARGETS: &[&str] = &[$(stringify!($target)),*];
        $(#[test]
        fn $target() {
            replay(stringify!($target), $check);
        })*
    };
}

targets! {
    grammar: checks::grammar::check,
    journal: checks::journal::check,
    model_reader: checks::model_reader::check,
    pen_descriptor: checks::pen_descriptor::check,
    pen_families: checks::pen_families::check,
    pen_recording: checks::pen_recording::check,
    picture: picture::check,
    sketch_json: checks::sketch::check,
    sketch_svg: checks::sketch::check,
    species: checks::species::check,
}

#[test]
fn every_target_of_the_fuzzer_is_replayed() {
    let fuzz = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz");
    for folder in ["fuzz_targets", "seeds"] {
        let names: Vec<String> = files(&fuzz.join(folder))
            .iter()
            .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
            .collect();
        assert_eq!(names, TARGETS, "{folder}");
    }
}
