//! What parameters at the ends of their ranges may cost: a plant or a clear refusal, within two gigabytes.
//!
//! The program builds a few drawings and grows a few species with every parameter of the stages that make things at its
//! least and at its most, one at a time and all together, under a limit on its address space: what asks for more is
//! aborted by the system, and that is a failure here.

#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use penstemon::params::{Description, Parameters as _};
use penstemon::pipeline::Params;
use penstemon::species::Species;
use std::path::Path;
use std::process::{Command, Output};

/// Address space of the program, KiB; the threads' stacks and the allocator's reserve are in it, not only what is used.
const SPACE: u64 = 3 << 20;
/// Longest run, seconds of the processors; most take one. Builds for tests are several times slower than the program.
const SECONDS: u64 = 60;

/// Runs the program under the limits.
fn penstemon(args: &[String]) -> Output {
    let script = format!("ulimit -v {SPACE}; ulimit -t {SECONDS}; exec \"$0\" \"$@\"");
    Command::new("sh")
        .args(["-c", &script, env!("CARGO_BIN_EXE_penstemon")])
        .args(args)
        // Two threads on any machine, each with its own stack and arenas.
        .env("RAYON_NUM_THREADS", "2")
        .output()
        .unwrap()
}

/// Runs; it must end by itself, with a plant or with one message.
fn survives(what: &str, args: &[String]) {
    let output = penstemon(args);
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(matches!(output.status.code(), Some(0 | 1)), "{what}: {}: {message}", output.status);
    assert!(!message.contains("panicked"), "{what}: {message}");
}

fn set(of: &Description, most: bool) -> String {
    let value = if most { of.max } else { of.min };
    format!("--set={}={}", of.path, of.kind.written(value))
}

/// The parameters below one of these prefixes, as `--set` would give them their least or their most.
fn extremes(all: &[Description], below: &[&str], most: bool) -> Vec<String> {
    let chosen = all.iter().filter(|d| below.iter().any(|prefix| d.path.starts_with(prefix)));
    chosen.map(|of| set(of, most)).collect()
}

fn build(sketch: &str, out: &Path, sets: &[String]) -> Vec<String> {
    let sketch = format!("{}/assets/sketches/{sketch}.penstemon", env!("CARGO_MANIFEST_DIR"));
    let base = ["build".to_owned(), sketch, "-o".to_owned(), out.display().to_string()];
    [&base[..], sets].concat()
}

fn grow(species: &str, age: u32, out: &Path, sets: &[String]) -> Vec<String> {
    let age = age.to_string();
    let out = out.display().to_string();
    let base = ["grow", species, "--age", &age, "-o", &out].map(str::to_owned);
    [&base[..], sets].concat()
}

#[test]
fn drawings_with_parameters_at_their_ends_are_built() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("a.glb");
    let all = Params::default().describe();
    let fillers = ["anatomy.twigs", "anatomy.leaf_twigs", "anatomy.leaf_fill"];
    for most in [false, true] {
        for below in [&fillers[..], &["model"], &["anatomy"], &["depth"], &["anatomy", "depth", "model"]] {
            let sets = extremes(&all, below, most);
            survives(&format!("{below:?}, most: {most}"), &build("tree_round", &out, &sets));
        }
    }
    // The costly ends of the fillers, together: fine spacing, many generations, long twigs, fine copies.
    let costly = [
        "anatomy.twigs.spacing=0.004",
        "anatomy.twigs.generations=4",
        "anatomy.twigs.shrink=1",
        "anatomy.twigs.max_steps=500",
        "anatomy.twigs.max_twigs=1000000",
        "anatomy.twigs.growth_rate=0.001",
        "anatomy.leaf_twigs.spacing=0.2",
        "anatomy.leaf_twigs.generations=12",
        "anatomy.leaf_twigs.max_twigs=1000000",
        "anatomy.leaf_fill.spacing=0.05",
        "anatomy.leaf_fill.default_length=0.002",
        "anatomy.leaf_fill.max_leaves=1000000",
        "model.blade.template_rows=64",
        "model.blade.template_columns=32",
        "model.blade.template_outline_points=200",
        "model.tube.quality=4",
    ]
    .map(|value| format!("--set={value}"));
    survives("all that is costly", &build("tree_round", &out, &costly));
    for pair in costly.windows(2) {
        survives(&pair.join(" "), &build("tree_round", &out, pair));
    }
}

#[test]
fn thousands_of_outlines_over_one_branch_are_filled_as_far_as_the_budget_goes() {
    use std::fmt::Write as _;
    let folder = tempfile::tempdir().unwrap();
    let (drawing, out) = (folder.path().join("outlines.penstemon"), folder.path().join("a.glb"));
    let mut text = r#"{"format": "penstemon-sketch", "version": 1, "strokes": [
        {"id": 1, "tool": "branch", "points": [[500, 900], [500, 400]]}"#
        .to_owned();
    for k in 0..7500 {
        let tool = ["leaf_outline", "branch_outline"][k % 2];
        let corner = |i: usize| {
            let (sin, cos) = (i as f64 * std::f64::consts::FRAC_PI_4).sin_cos();
            let radius = 300.0 + (k % 50) as f64;
            format!("[{:.0}, {:.0}]", 500.0 + radius * cos, 500.0 + radius * sin)
        };
        let corners: Vec<String> = (0..=8).map(corner).collect();
        write!(text, ",\n{{\"id\": {}, \"tool\": \"{tool}\", \"points\": [{}]}}", k + 2, corners.join(", "))
            .unwrap();
    }
    text.push_str("]}");
    std::fs::write(&drawing, text).unwrap();
    let args = ["build", drawing.to_str().unwrap(), "-o", out.to_str().unwrap()].map(str::to_owned);
    let output = penstemon(&args);
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{}: {message}", output.status);
    assert!(message.contains("more remarks like these"), "outlines beyond the budget say so: {message}");
}

#[test]
fn plants_with_parameters_at_their_ends_grow() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("a.glb");
    let finest = extremes(&Params::default().describe(), &["model.solid", "model.blade"], true);
    survives("the finest flowers", &grow("cherry", 20, &out, &finest));
    survives("an old cherry", &grow("cherry", 500, &out, &[]));
    let habit = Params::of_species(&Species::built_in("hazel").unwrap()).describe();
    for most in [false, true] {
        let sets = extremes(&habit, &["habit", "model"], most);
        survives(&format!("all of the habit, most: {most}"), &grow("hazel", 6, &out, &sets));
    }
}
