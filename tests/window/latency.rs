//! How long ink takes: from a move of the pointer, made by the X server's own test extension, to the pixel on the screen.
//!
//! No sample may be lost beside a tree that a software driver is painting. How long they take depends on what else the
//! machine does, so it is printed and not asserted. The goal is 33 ms for 99 of 100 samples on two idle cores. What is
//! asserted is what decides it: how much of the window the frames paint.

use crate::client::Client;
use crate::program::{Program, field};
use crate::screen::{Area, Screen};
use crate::sketch_file;
use std::fs::File;
use std::os::unix::fs::FileExt as _;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Between two moves: 240 a second, as a pen's.
const PACE: Duration = Duration::from_micros(4167);
/// How far each moves, along both axes: beyond the pointer's cross.
const STEP: f64 = 14.0;
/// Width of the legend in the corner, with what is around it.
const LEGEND: f64 = 110.0;
/// Places on either side of one that a corner among them bends the line at it.
const BENDS: usize = 6;
/// Paper is brighter than this in every colour, ink is not.
const PAPER: u8 = 200;
/// Most that a frame paints while a line grows, share of the window: 0.06, which is a part of the plant's new picture where
/// there is one, and the end of the line with the status line, which are less than half as much.
const LARGEST_SHARE: f64 = 0.1;
/// A move that is not seen by then is lost.
const LOST: Duration = Duration::from_secs(10);

/// The frame buffer, pixel by pixel.
struct Watch {
    file: File,
    start: u64,
    stride: u64,
}

impl Watch {
    fn on(screen: &Screen) -> Self {
        let file = File::open(screen.frame_buffer()).unwrap();
        let word = |i: u64| {
            let mut bytes = [0; 4];
            file.read_exact_at(&mut bytes, 4 * i).unwrap();
            u64::from(u32::from_be_bytes(bytes))
        };
        let (start, stride) = (word(0) + 12 * word(19), word(12));
        Self { file, start, stride }
    }

    /// Whether nothing is drawn around a place.
    fn is_paper(&self, [x, y]: [f64; 2]) -> bool {
        let pixel = |x: u64, y: u64| {
            let mut pixel = [0; 4];
            self.file.read_exact_at(&mut pixel, self.start + y * self.stride + 4 * x).unwrap();
            pixel
        };
        let (x, y) = (x.round() as u64, y.round() as u64);
        let around = [(x, y), (x - 1, y), (x, y - 1), (x - 1, y - 1)];
        around.into_iter().all(|(x, y)| pixel(x, y)[..3].iter().all(|c| *c > PAPER))
    }
}

/// A way through the area like a ball's between its sides, always aslant: the pointer's cross hides what lies beside or
/// above it, but not what lies between two places of this way.
fn way([left, top, width, height]: Area, count: u32, start: f64) -> Vec<[f64; 2]> {
    let bounce = |along: f64, size: f64| {
        let room = size - 80.0;
        40.0 + room - (along.rem_euclid(2.0 * room) - room).abs()
    };
    let at = |i: u32| start + STEP * f64::from(i);
    (0..count).map(|i| [left + bounce(at(i), width).round(), top + bounce(at(i), height).round()]).collect()
}

/// Whether the way to a place is straight as far as the stabiliser looks: round a corner it draws the line elsewhere.
fn is_straight(places: &[[f64; 2]], to: usize) -> bool {
    let near = &places[to.saturating_sub(BENDS)..places.len().min(to + BENDS)];
    let step = |pair: &[[f64; 2]]| [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
    near.windows(2).all(|pair| step(pair) == step(&near[..2]))
}

/// Draws through places at the pace of a pen; how long each took until the line came to it, where that can be seen.
fn draw(client: &Client, watch: &Watch, places: &[[f64; 2]]) -> Vec<Duration> {
    client.point(places[0]);
    std::thread::sleep(Duration::from_millis(50));
    client.press(true);
    std::thread::sleep(Duration::from_millis(50));
    let (mut waiting, mut seen) = (Vec::new(), Vec::new());
    let (mut next, mut due) = (1, Instant::now());
    while next < places.len() || !waiting.is_empty() {
        if next < places.len() && Instant::now() >= due {
            let (from, to) = (places[next - 1], places[next]);
            let between = [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])];
            let is_seen = is_straight(places, next) && watch.is_paper(between);
            client.point(to);
            waiting.extend(is_seen.then(|| (between, Instant::now())));
            (next, due) = (next + 1, due + PACE);
        }
        waiting.retain(|(place, moved)| {
            let is_drawn = !watch.is_paper(*place);
            if is_drawn {
                seen.push(moved.elapsed());
            }
            assert!(is_drawn || moved.elapsed() < LOST, "the line never comes to {place:?}");
            !is_drawn
        });
        std::thread::sleep(Duration::from_micros(400));
    }
    client.press(false);
    seen
}

#[test]
fn no_ink_is_lost_beside_a_tree() {
    let (screen, home) = (Screen::start(1280, 800), TempDir::new().unwrap());
    let file = home.path().join("maple.penstemon");
    std::fs::copy(sketch_file("tree_round"), &file).unwrap();
    let mut program = Program::start(&screen, home.path(), &[file.to_str().unwrap()]);
    program.built();
    let (client, watch) = (Client::on(&screen), Watch::on(&screen));
    program.rest();
    program.new_lines();
    let (mut seen, mut shares) = (Vec::new(), Vec::new());
    // Beside the legend, which lies over the drawing.
    let [left, top, width, height] = program.area("canvas");
    let canvas = [left + LEGEND, top, width - LEGEND, height];
    for stroke in 0..4 {
        seen.extend(draw(&client, &watch, &way(canvas, 300, 173.0 * f64::from(stroke))));
        let drawn = program.new_lines();
        let growing = drawn.iter().take_while(|line| !line.contains("lifted strokes="));
        let painted = growing.filter(|line| line.contains("painted share="));
        shares.extend(painted.map(|line| field(line, "share").parse::<f64>().unwrap()));
        program.rest();
        program.new_lines();
    }
    program.picture(&screen).keep("ink-beside-a-tree");
    seen.sort();
    shares.sort_by(f64::total_cmp);
    let at = |share: f64| seen[((seen.len() - 1) as f64 * share).round() as usize];
    let [half, p90, p99, most] = [at(0.5), at(0.9), at(0.99), at(1.0)];
    eprintln!("sample to ink: half {half:?}, 90 % {p90:?}, 99 % {p99:?}, all {most:?} of {}", seen.len());
    assert!(seen.len() > 60, "only {} samples could be seen", seen.len());
    let (middle, largest) = (shares[shares.len() / 2], shares[shares.len() - 1]);
    eprintln!("{} frames painted {middle} of the window, the largest {largest}", shares.len());
    assert!(largest < LARGEST_SHARE, "a frame paints {largest} of the window");
}
