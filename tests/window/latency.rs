//! How long ink takes: from a move of the pointer, made by the X server's own test extension, to the pixel on the screen.
//!
//! The figures are those of this machine at this moment; what is asserted holds on a busy one. On an idle machine with two
//! cores and a software driver 99 of 100 samples are seen within 33 ms.

use crate::client::Client;
use crate::program::Program;
use crate::screen::{Area, Screen};
use crate::sketch_file;
use std::fs::File;
use std::os::unix::fs::FileExt as _;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Between two moves: 240 a second, as a pen's.
const PACE: Duration = Duration::from_micros(4167);
/// A move that is not seen by then is lost.
const LOST: Duration = Duration::from_secs(10);
/// Most that a usual sample may take, and 99 of 100. A picture of the maple takes a software driver on a busy machine longer.
const USUAL: Duration = Duration::from_millis(33);
const NEARLY_ALL: Duration = Duration::from_millis(250);

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

    fn pixel(&self, [x, y]: [f64; 2]) -> [u8; 4] {
        let mut pixel = [0; 4];
        let at = self.start + y.round() as u64 * self.stride + 4 * x.round() as u64;
        self.file.read_exact_at(&mut pixel, at).unwrap();
        pixel
    }
}

/// Rows from side to side, each place beyond the width of a line from the one before.
fn rows([left, top, width, height]: Area, count: u32) -> Vec<[f64; 2]> {
    let row = |r: u32| {
        let y = top + height * (0.06 + 0.88 * f64::from(r) / f64::from(count));
        (0..80).map(move |i| {
            let along = if r.is_multiple_of(2) { i } else { 79 - i };
            [left + width * (0.1 + 0.01 * f64::from(along)), y]
        })
    };
    (0..count).flat_map(row).collect()
}

/// Draws through places at the pace of a pen; how long each took to be seen.
fn draw(client: &Client, watch: &Watch, places: &[[f64; 2]]) -> Vec<Duration> {
    client.point(places[0]);
    std::thread::sleep(Duration::from_millis(50));
    client.press(true);
    std::thread::sleep(Duration::from_millis(50));
    let mut next = places[1..].iter().copied().peekable();
    let (mut waiting, mut seen) = (Vec::new(), Vec::new());
    let begun = Instant::now();
    let mut due = begun;
    while next.peek().is_some() || !waiting.is_empty() {
        if Instant::now() >= due
            && let Some(place) = next.next()
        {
            let before = watch.pixel(place);
            client.point(place);
            waiting.push((place, before, Instant::now()));
            due += PACE;
        }
        waiting.retain(|(place, before, moved)| {
            let is_seen = watch.pixel(*place) != *before;
            if is_seen {
                seen.push(moved.elapsed());
            }
            assert!(is_seen || moved.elapsed() < LOST, "the line never comes to {place:?}");
            !is_seen
        });
        std::thread::sleep(Duration::from_micros(400));
    }
    client.press(false);
    seen
}

#[test]
fn ink_does_not_wait_for_a_tree() {
    let (screen, home) = (Screen::start(1280, 800), TempDir::new().unwrap());
    let file = home.path().join("maple.penstemon");
    std::fs::copy(sketch_file("tree_round"), &file).unwrap();
    let mut program = Program::start(&screen, home.path(), &[file.to_str().unwrap()]);
    program.built();
    let (client, watch) = (Client::on(&screen), Watch::on(&screen));
    let mut seen = Vec::new();
    for stroke in rows(program.area("canvas"), 12).chunks(240) {
        seen.extend(draw(&client, &watch, stroke));
        program.built();
    }
    program.picture(&screen).keep("ink-beside-a-tree");
    seen.sort();
    let at = |share: f64| seen[((seen.len() - 1) as f64 * share).round() as usize];
    let [half, p90, p99, most] = [at(0.5), at(0.9), at(0.99), at(1.0)];
    println!("sample to ink: half {half:?}, 90 % {p90:?}, 99 % {p99:?}, all {most:?} of {}", seen.len());
    assert!(half <= USUAL && p99 <= NEARLY_ALL, "half {half:?}, 99 % {p99:?}, all {most:?}");
}
