//! How fast the window answers, without window and graphics card: drawings replayed sample by sample at the pace of a
//! pen through the editor itself, with its worker, its panels and the canvas's vertex buffer.
//!
//! `cargo bench --bench live` measures everything; words choose: `-- daisy oxalis fast tree large stages idle`. With `--test` one
//! drawing is replayed as fast as it goes, to see that all still fits together.
//!
//! A sample arrives when it is due, or when the sleeping thread was woken for it; where the thread was still busy with a
//! frame, the waiting counts. What is measured per sample: `ink`, until the stroke is in the canvas's vertex buffer;
//! `plant`, until a plant that knows the sample was collected. Per frame at 1280×800: `panels`, laying out everything;
//! `shapes`, egui's triangles; `strokes`, bringing the canvas's strokes in step; and `frame`, all three.
//!
//! `fast` is one stroke of a minute by a pen that reports a thousand times a second: what a sample costs the window must
//! not grow with the stroke. `stages` tells where the time of one more sample on a large drawing goes in the pipeline, and
//! how it grows with the drawing.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]
#![allow(clippy::print_stdout, reason = "figures are what a bench is for")]

#[path = "live/desk.rs"]
mod desk;
#[path = "../tests/common/drawings.rs"]
mod drawings;
#[path = "live/figures.rs"]
mod figures;
#[path = "live/stages.rs"]
mod stages;

use desk::Desk;
use figures::{Figures, heading};
use glam::Vec2;
use penstemon::app::Action;
use penstemon::sketch::{self, Sketch, StrokePoint, Tool};
use std::path::Path;
use std::time::{Duration, Instant};

/// The program's own.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

const REFERENCE: [&str; 8] =
    ["daisy", "hepatica_red", "hepatica_blue", "jasmine", "mallow", "balloon_flower", "plumeria", "oxalis"];
/// Leaves of the tree that is rebuilt, and strokes of the large drawing.
const MANY: usize = 10_000;
/// Samples of the longest stroke: a minute at 1,000 Hz.
const FAST: usize = 60_000;
/// Most that a sample at the end of that stroke may cost, times one at its beginning.
const GROWTH: f64 = 2.0;
/// Time between two strokes.
const PAUSE: Duration = Duration::from_millis(80);

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    if std::env::args().any(|word| word == "--test") {
        return short();
    }
    let is_wanted = |name: &str| words.is_empty() || words.iter().any(|word| word == name);
    heading();
    let mut all = Figures::default();
    for name in REFERENCE.into_iter().filter(|name| is_wanted(name)) {
        let figures = replay(&reference(name), None);
        figures.print(name);
        all.add(figures);
    }
    all.print("all");
    if is_wanted("fast") {
        draw_fast(FAST, Duration::from_millis(1));
    }
    if is_wanted("tree") {
        rebuild_tree(MANY, Duration::from_secs(8));
    }
    if is_wanted("large") {
        draw_on_large(MANY, 12);
    }
    if is_wanted("stages") {
        stages::print(MANY);
    }
    if is_wanted("idle") {
        rest(Duration::from_secs(4));
    }
}

/// Everything once and small.
fn short() {
    let mut daisy = reference("daisy");
    daisy.strokes.truncate(4);
    let figures = replay(&daisy, Some(6));
    draw_fast(200, Duration::ZERO);
    assert!(figures.count("ink") >= 18 && figures.count("plant") >= 18 && figures.count("frame") > 0);
}

fn reference(name: &str) -> Sketch {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/sketches/{name}.penstemon"));
    sketch::read(&path).unwrap().0
}

/// Draws a drawing on an empty sheet, at most so many samples of each stroke.
fn replay(drawing: &Sketch, most: Option<usize>) -> Figures {
    let mut desk = Desk::open(&Sketch { strokes: Vec::new(), ..drawing.clone() });
    for stroke in &drawing.strokes {
        let samples = &stroke.points[..stroke.points.len().min(most.unwrap_or(usize::MAX))];
        desk.draw(stroke.tool, samples);
        desk.pass(PAUSE);
    }
    desk.settle();
    desk.figures()
}

/// Draws one long stroke with a fast pen on an empty sheet.
fn draw_fast(samples: usize, pace: Duration) {
    let mut desk = Desk::open(&Sketch { strokes: Vec::new(), ..reference("daisy") });
    let scribble: Vec<StrokePoint> = (0..samples)
        .map(|i| {
            let t = i as f32 * 1e-3;
            let at =
                Vec2::new(300.0 + 220.0 * (2.1 * t).sin(), 350.0 + 250.0 * (2.9 * t + 0.05 * t * t).cos());
            StrokePoint { pressure: 0.5, ..StrokePoint::at(at) }
        })
        .collect();
    let begun = Instant::now();
    desk.draw_every(pace, Tool::Branch, &scribble);
    let late = begun.elapsed().saturating_sub(pace * samples as u32);
    let figures = desk.figures();
    figures.print(&format!("one stroke of {samples} samples"));
    let growth = figures.growth("sample");
    let verdict = if growth <= GROWTH { "met" } else { "MISSED" };
    println!("  a sample at its end costs {growth:.2} times one at its beginning  ≤ {GROWTH} {verdict}");
    println!("  the pen was lifted {:.1} ms before the window was done with it", late.as_secs_f64() * 1e3);
    desk.settle();
}

/// Rebuilds a tree again and again while frames are shown.
fn rebuild_tree(leaves: usize, time: Duration) {
    let mut desk = Desk::open(&drawings::leafy_tree(leaves));
    desk.settle();
    desk.figures();
    let (begun, mut seed) = (Instant::now(), 1);
    while begun.elapsed() < time {
        seed += 1;
        desk.perform(Action::SetSeed(seed));
        desk.frame_after_frame(Duration::from_millis(50));
    }
    desk.figures().print(&format!("tree of {leaves} leaves, rebuilt"));
}

/// Draws some strokes on a drawing that has very many.
fn draw_on_large(strokes: usize, more: usize) {
    let large = drawings::meadow(strokes + more);
    let mut start = large.clone();
    start.strokes.truncate(strokes);
    let mut desk = Desk::open(&start);
    desk.settle();
    desk.figures();
    for stroke in &large.strokes[strokes..] {
        desk.draw(stroke.tool, &stroke.points);
        desk.pass(PAUSE);
    }
    desk.settle();
    desk.figures().print(&format!("drawing of {strokes} strokes"));
}

/// Does nothing, as the window does nothing: sleeps until somebody wants a frame.
fn rest(time: Duration) {
    let mut desk = Desk::open(&reference("daisy"));
    desk.settle();
    // What moves after opening comes to rest.
    desk.sleep(Duration::from_secs(8));
    desk.figures();
    let before = desk::processor_time();
    let frames = desk.sleep(time);
    let used = desk::processor_time().zip(before).map(|(after, before)| after.saturating_sub(before));
    let share = used.map_or("unknown".to_owned(), |used| {
        format!("{:.2} %", 100.0 * used.as_secs_f64() / time.as_secs_f64())
    });
    println!("idle for {} s: {frames} frames, processor {share}", time.as_secs());
}
