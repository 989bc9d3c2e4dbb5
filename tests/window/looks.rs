//! What the window looks like: sizes, themes, languages, and rest.

use crate::program::Program;
use crate::screen::Screen;
use crate::sketch_file;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Most processor time that a resting window may take. It takes none; the rest is for clocks that tick in 10 ms.
const MOST_IDLE: f64 = 0.01;

fn daisy_in(screen: &Screen, home: &Path, more: &[(&str, &str)]) -> Program {
    let mut program = Program::start_with(screen, home, &[sketch_file("daisy").to_str().unwrap()], more);
    program.settle("built");
    program
}

/// Processor time of a process up to now.
fn processor_time(id: u32) -> Duration {
    let stat = fs::read_to_string(format!("/proc/{id}/stat")).unwrap();
    let fields: Vec<&str> = stat[stat.rfind(')').unwrap()..].split_whitespace().collect();
    let ticks: u64 = fields[12].parse::<u64>().unwrap() + fields[13].parse::<u64>().unwrap();
    Duration::from_millis(10 * ticks)
}

#[test]
fn resize_storms_and_hidden_windows_are_survived_and_then_the_window_rests() {
    let (screen, home) = (Screen::start(1600, 1000), TempDir::new().unwrap());
    let mut program = daisy_in(&screen, home.path(), &[]);
    let window = program.window(&screen);
    for (width, height) in [(700, 500), (1, 1), (1500, 900), (320, 1000), (1600, 120), (900, 700)] {
        screen.hand(&["windowsize", &window, &width.to_string(), &height.to_string()]);
    }
    screen.hand(&["windowsize", "--sync", &window, "1200", "760"]);
    program.settle("layout");
    let before = screen.still();
    before.keep("after-resizes");
    let [left, top, width, height] = program.area("plant");
    assert!(left + width <= 1200.0 && top + height <= 760.0);

    screen.hand(&["windowunmap", "--sync", &window, "sleep", "0.3", "windowmap", "--sync", &window]);
    program.raise(&screen);
    let after = screen.still();
    assert!(after.changed(&before, [0.0, 0.0, 1200.0, 760.0]) < 0.002, "the hidden window came back");

    let (begun, time) = (Instant::now(), processor_time(program.id()));
    std::thread::sleep(Duration::from_secs(3));
    let used = (processor_time(program.id()) - time).as_secs_f64() / begun.elapsed().as_secs_f64();
    assert!(used <= MOST_IDLE, "an idle window takes {:.1} % of a processor", 100.0 * used);
    screen.hand(&["key", "ctrl+q"]);
    assert!(program.wait().success());
}

#[test]
fn theme_and_language_are_what_was_chosen() {
    let (screen, home) = (Screen::start(1280, 800), TempDir::new().unwrap());
    let mut program = daisy_in(&screen, home.path(), &[]);
    let light = screen.still();
    // The button left of help, left of the side panel's.
    screen.click([1049.0, 26.0]);
    screen.still().keep("settings-menu");
    screen.hand(&["key", "Escape", "key", "ctrl+q"]);
    assert!(program.wait().success());

    let folder = home.path().join(".config/penstemon");
    let settings = fs::read_to_string(folder.join("settings.toml")).unwrap();
    assert!(settings.contains("theme = \"light\""), "{settings}");
    let dark =
        settings.replace("\"light\"", "\"dark\"").replace("handedness = \"right\"", "handedness = \"left\"");
    fs::write(folder.join("settings.toml"), format!("language = \"zh-CN\"\n{dark}")).unwrap();
    let _program = daisy_in(&screen, home.path(), &[]);
    let dark = screen.still();
    dark.keep("dark-chinese-left-handed");
    let brightness = |p: &crate::screen::Pixels| {
        p.rgb.iter().map(|&c| u64::from(c)).sum::<u64>() as f64 / p.rgb.len() as f64
    };
    assert!(brightness(&light) > 190.0, "{}", brightness(&light));
    assert!(brightness(&dark) < 80.0, "{}", brightness(&dark));
}

#[test]
fn a_display_of_twice_the_density_shows_everything_twice_as_fine() {
    let (screen, home) = (Screen::start(2560, 1600), TempDir::new().unwrap());
    let mut program = daisy_in(&screen, home.path(), &[("WINIT_X11_SCALE_FACTOR", "2")]);
    screen.still().keep("daisy-2x");
    let ([left, top, ..], [right, _, width, height]) = (program.area("canvas"), program.area("plant"));
    assert_eq!([left, top], [120.0, 104.0], "the bars are as wide in points");
    assert!(right + width < 2560.0 && top + height < 1600.0 && height > 1400.0);
}
