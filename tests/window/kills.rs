//! The window is killed at random moments while a hand draws stroke after stroke: what it had seen finished is found.
//!
//! A stroke counts as seen when the window says that the pen is lifted. `PENSTEMON_KILLS` says how often it is killed; the
//! figures are printed.

use crate::client::Client;
use crate::number;
use crate::program::Program;
use crate::screen::{Area, Screen};
use penstemon::sketch::journal::Recovery;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::path::Path;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Kills where nobody asks for more.
const KILLS: u64 = 10;
/// How long before the kill a lifted pen was seen for its stroke to be asked for.
const SEEN: Duration = Duration::from_millis(50);
/// Places of a stroke, and the time from one to the next.
const PLACES: u32 = 20;
const PACE: Duration = Duration::from_millis(3);

/// What the program has said of lifted pens: how many strokes it had then, and when it was heard.
struct Lifted(Vec<(u64, Instant)>);

impl Lifted {
    fn listen(&mut self, program: &mut Program) {
        let now = Instant::now();
        let lines = program.new_lines().into_iter().filter(|line| line.contains("lifted strokes="));
        self.0.extend(lines.map(|line| (number(&line, "strokes"), now)));
    }

    /// Strokes that the window had when it said so for the last time at least this long before a moment.
    fn before(&self, moment: Instant, by: Duration) -> u64 {
        let said = self.0.iter().filter(|(_, at)| moment.saturating_duration_since(*at) >= by);
        said.map(|(strokes, _)| *strokes).max().unwrap_or(0)
    }
}

/// Draws until a moment; gives how many strokes were finished by the hand [`SEEN`] before it.
fn draw_until(
    end: Instant,
    client: &Client,
    [left, top, width, height]: Area,
    program: &mut Program,
    lifted: &mut Lifted,
) -> u64 {
    let mut finished = Vec::new();
    for stroke in 0u32.. {
        let row = f64::from(stroke % 12) / 14.0;
        for k in 0..=PLACES {
            if Instant::now() >= end {
                return finished.iter().filter(|at| end.saturating_duration_since(**at) >= SEEN).count()
                    as u64;
            }
            let along = f64::from(k) / f64::from(PLACES);
            client.point([left + width * (0.2 + 0.6 * along), top + height * (0.1 + row + 0.05 * along)]);
            if k == 0 {
                client.press(true);
            }
            std::thread::sleep(PACE);
            lifted.listen(program);
        }
        client.press(false);
        finished.push(Instant::now());
        std::thread::sleep(PACE);
    }
    unreachable!("strokes are counted without end")
}

/// Strokes whose lifted pen was seen [`SEEN`] before the kill, all seen, all finished by the hand so long before, and found.
fn kill_once(screen: &Screen, client: &Client, home: &Path, rng: &mut Pcg64Mcg) -> [u64; 4] {
    let mut program = Program::start(screen, home, &[]);
    program.built();
    screen.hand(&["key", "ctrl+n"]);
    program.built();
    let canvas = program.area("canvas");
    let mut lifted = Lifted(Vec::new());
    let end = Instant::now() + Duration::from_micros(rng.random_range(150_000..1_500_000));
    let sent = draw_until(end, client, canvas, &mut program, &mut lifted);
    let killed = Instant::now();
    program.kill();
    lifted.listen(&mut program);
    client.press(false);
    let found = Recovery::at(home.join(".local/state/penstemon")).list().unwrap();
    assert!(found.iter().all(|one| one.content.as_ref().is_ok_and(|restored| restored.gaps.is_empty())));
    let found = found.first().map_or(0, |one| one.strokes() as u64);
    [lifted.before(killed, SEEN), lifted.before(killed, Duration::ZERO), sent, found]
}

#[test]
fn a_window_killed_at_random_moments_keeps_every_stroke_whose_pen_was_seen_lifted() {
    let kills = std::env::var("PENSTEMON_KILLS").map_or(KILLS, |number| number.parse().unwrap());
    let screen = Screen::start(1280, 800);
    let client = Client::on(&screen);
    let mut rng = Pcg64Mcg::seed_from_u64(200);
    let mut sum = [0; 4];
    let (mut lost, mut lost_of_sent) = (0, 0);
    for _ in 0..kills {
        let home = TempDir::new().unwrap();
        let kill = kill_once(&screen, &client, home.path(), &mut rng);
        let [asked, _, sent, found] = kill;
        lost += asked.saturating_sub(found);
        lost_of_sent += sent.saturating_sub(found);
        sum = std::array::from_fn(|k| sum[k] + kill[k]);
    }
    let [asked, seen, sent, found] = sum;
    let ms = SEEN.as_millis();
    eprintln!(
        "{kills} kills of the window: {seen} strokes seen, {found} found; of {asked} whose pen was seen lifted {ms} ms before, \
         {lost} lost; of {sent} that the hand had finished {ms} ms before, {lost_of_sent} not found"
    );
    assert!(asked >= kills, "{asked} strokes are too few to judge by");
    assert_eq!(lost, 0);
}
