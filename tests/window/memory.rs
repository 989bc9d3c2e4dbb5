//! Memory of the window: level while one draws and undoes, and given back when a large plant is gone.
//!
//! Counted is what the process has for itself, without files (`RssAnon` of `/proc/PID/status`), graphics driver included.
//! Free memory goes back when the window's threads have rested for a little more than a second (`app/free_memory.rs`). What
//! a small plant of the same species leaves behind counts as the window's own: pictures kept for the next plant of the
//! species, threads, and what the driver compiled to draw leaves and bark.

use crate::client::Client;
use crate::program::Program;
use crate::screen::Screen;
use crate::sketch_file;
use std::path::Path;
use std::time::Duration;
use tempfile::TempDir;

/// More than this, as a factor, is growth.
const LEVEL: f64 = 1.1;
/// Least factor by which a large plant fills the memory: its leaves are copies, so that most of it is wood.
const LARGE: f64 = 1.1;
/// Longer than the threads rest before they give back what is free.
const GIVEN_BACK: Duration = Duration::from_millis(2500);
/// Most that stays when it is gone, as a factor: measured are 1.10 to 1.14. The rest are blocks of 64 kB that a software
/// driver keeps here and there for its next pictures, each in a page of the allocator's that cannot go back meanwhile.
const LEFT: f64 = 1.2;
/// Rounds of drawing and undoing before the memory is looked at first, and after that. In the first twenty the pages of
/// the allocator and of the driver still find their places.
const ROUNDS: [usize; 2] = [20, 10];

/// Memory of the program's own, MB, once what is free has been given back.
fn memory(program: &mut Program) -> f64 {
    program.rest();
    std::thread::sleep(GIVEN_BACK);
    let status = std::fs::read_to_string(format!("/proc/{}/status", program.id())).unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix("RssAnon:")).unwrap();
    line.trim().strip_suffix(" kB").unwrap().parse::<f64>().unwrap() / 1024.0
}

/// Draws six strokes and undoes them.
fn draw_and_undo(screen: &Screen, client: &Client, [left, top, width, height]: [f64; 4], round: usize) {
    for stroke in 0..6 {
        let start = (7 * round + stroke) as f64;
        let at = |t: f64| {
            [left + width * (0.3 + 0.4 * (start * 0.37).fract() + 0.2 * t), top + height * (0.9 - 0.7 * t)]
        };
        client.point(at(0.0));
        client.press(true);
        for i in 1..=30 {
            client.point(at(f64::from(i) / 30.0));
            std::thread::sleep(Duration::from_millis(4));
        }
        client.press(false);
        std::thread::sleep(Duration::from_millis(20));
    }
    screen.hand(&[
        "key",
        "ctrl+z",
        "ctrl+z",
        "ctrl+shift+z",
        "ctrl+z",
        "ctrl+z",
        "ctrl+z",
        "ctrl+z",
        "ctrl+z",
    ]);
}

/// The maple without its sample leaves, filled with as many small ones as there may be.
fn heavy(folder: &Path) -> std::path::PathBuf {
    let mut maple = penstemon::sketch::read(&sketch_file("tree_round")).unwrap().0;
    maple.strokes.retain(|stroke| stroke.tool != penstemon::sketch::Tool::Leaf);
    let mut set = |path: &str, value: f64| maple.params.insert(path.into(), value.into());
    set("anatomy.leaf_fill.max_leaves", 20_000.0);
    set("anatomy.leaf_fill.default_length", 0.0105);
    let path = folder.join("heavy.penstemon");
    penstemon::sketch::save::save(&path, &maple, None).unwrap();
    path
}

#[test]
fn memory_stays_level_while_one_draws_and_undoes() {
    let (screen, home) = (Screen::start(1280, 800), TempDir::new().unwrap());
    let file = home.path().join("maple.penstemon");
    std::fs::copy(sketch_file("tree_round"), &file).unwrap();
    let mut program = Program::start(&screen, home.path(), &[file.to_str().unwrap()]);
    program.built();
    let client = Client::on(&screen);
    let canvas = program.area("canvas");
    let mut rounds = 0..;
    let [first, last] = ROUNDS.map(|count| {
        rounds.by_ref().take(count).for_each(|round| draw_and_undo(&screen, &client, canvas, round));
        program.built_of(31);
        memory(&mut program)
    });
    eprintln!("{first:.0} MB after {} rounds, {last:.0} MB after {} more", ROUNDS[0], ROUNDS[1]);
    assert!(last < LEVEL * first, "{first:.0} MB became {last:.0} MB");
}

#[test]
fn the_memory_of_a_large_plant_comes_back_with_a_new_drawing() {
    let (screen, home) = (Screen::start(1280, 800), TempDir::new().unwrap());
    let file = heavy(home.path());
    let mut program = Program::start(&screen, home.path(), &[]);
    program.built();
    let (client, window) = (Client::on(&screen), program.window(&screen));
    let [left, top, width, height] = program.area("canvas");
    let mut show_and_leave = |file: &Path, strokes: usize| {
        client.drop_file(&window, [left + 0.5 * width, top + 0.5 * height], file);
        program.built_of(strokes);
        let full = memory(&mut program);
        screen.hand(&["key", "ctrl+n"]);
        program.built_of(0);
        [full, memory(&mut program)]
    };
    let small = sketch_file("tree_round");
    let strokes = penstemon::sketch::read(&small).unwrap().0.strokes.len();
    let [_, before] = show_and_leave(&small, strokes);
    let large = [(); 2].map(|()| show_and_leave(&file, 28));
    eprintln!("{before:.0} MB after a small plant, then with and without a large one: {large:.0?}");
    for [full, after] in large {
        assert!(full > LARGE * before, "the plant is not large: {full:.0} MB");
        assert!(after < LEFT * before, "of {full:.0} MB {after:.0} stay, {before:.0} before");
    }
    let [[_, first], [_, second]] = large;
    assert!(second < LEVEL * first, "{first:.0} MB become {second:.0} MB with the second plant");
}
