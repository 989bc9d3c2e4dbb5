//! What the window looks like: sizes, themes, languages, and rest.

use crate::client::Client;
use crate::program::Program;
use crate::screen::{Area, Pixels, Screen};
use crate::sketch_file;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Colour of petals on the paper, in the light theme.
const PETAL: [u8; 3] = [0xb8, 0x35, 0x7c];

/// Most processor time that a resting window may take. It takes none; the rest is for clocks that tick in 10 ms.
const MOST_IDLE: f64 = 0.01;

fn daisy_in(screen: &Screen, home: &Path, more: &[(&str, &str)]) -> Program {
    let mut program = Program::start_with(screen, home, &[sketch_file("daisy").to_str().unwrap()], more);
    program.built();
    program
}

/// Processor time of a process up to now.
fn processor_time(id: u32) -> Duration {
    let stat = fs::read_to_string(format!("/proc/{id}/stat")).unwrap();
    let fields: Vec<&str> = stat[stat.rfind(')').unwrap()..].split_whitespace().collect();
    let ticks: u64 = fields[12].parse::<u64>().unwrap() + fields[13].parse::<u64>().unwrap();
    Duration::from_millis(10 * ticks)
}

fn brightness(picture: &Pixels) -> f64 {
    picture.rgb.iter().map(|&c| u64::from(c)).sum::<u64>() as f64 / picture.rgb.len() as f64
}

#[test]
fn resize_storms_and_hidden_windows_are_survived_and_then_the_window_rests() {
    let (screen, home) = (Screen::beside_others(1600, 1000), TempDir::new().unwrap());
    let mut program = daisy_in(&screen, home.path(), &[]);
    let window = program.window(&screen);
    for (width, height) in [(700, 500), (1, 1), (1500, 900), (320, 1000), (1600, 120), (900, 700)] {
        screen.hand(&["windowsize", &window, &width.to_string(), &height.to_string()]);
    }
    screen.hand(&["windowsize", "--sync", &window, "1200", "760"]);
    program.rest();
    let before = program.picture(&screen);
    before.keep("after-resizes");
    let [left, top, width, height] = program.area("plant");
    assert!(left + width <= 1200.0 && top + height <= 760.0);

    screen.hand(&["windowunmap", "--sync", &window, "sleep", "0.3", "windowmap", "--sync", &window]);
    program.raise(&screen);
    let after = program.picture(&screen);
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
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let mut program = daisy_in(&screen, home.path(), &[]);
    let light = program.picture(&screen);
    // The button left of help, left of the side panel's.
    screen.click([1049.0, 26.0]);
    let menu = program.picture(&screen);
    menu.keep("settings-menu");
    assert!(menu.changed(&light, [755.0, 50.0, 310.0, 280.0]) > 0.3, "the menu is open");
    // Dark, and light again; the first choice follows the system.
    screen.click([1010.0, 169.0]);
    program.picture(&screen).keep("dark-by-click");
    assert!(brightness(&program.picture(&screen)) < 80.0);
    screen.click([910.0, 169.0]);
    assert!(brightness(&program.picture(&screen)) > 190.0);
    // Chinese, and English again: the line above the choice changes.
    let title = [755.0, 125.0, 310.0, 18.0];
    screen.click([986.0, 98.0]);
    let chinese = program.picture(&screen);
    chinese.keep("chinese-by-click");
    assert!(chinese.changed(&menu, title) > 0.02, "the menu is in Chinese");
    screen.click([836.0, 98.0]);
    let english = program.picture(&screen);
    english.keep("english-again");
    assert!(english.changed(&menu, title) < 0.002, "the menu is in English again");
    screen.hand(&["key", "Escape"]);
    program.rest();
    screen.hand(&["key", "ctrl+q"]);
    assert!(program.wait().success());

    let folder = home.path().join(".config/penstemon");
    let settings = fs::read_to_string(folder.join("settings.toml")).unwrap();
    assert!(settings.contains("theme = \"light\""), "{settings}");
    let dark =
        settings.replace("\"light\"", "\"dark\"").replace("handedness = \"right\"", "handedness = \"left\"");
    fs::write(folder.join("settings.toml"), dark.replace("language = \"en\"", "language = \"zh-CN\""))
        .unwrap();
    let mut program = daisy_in(&screen, home.path(), &[]);
    let dark = program.picture(&screen);
    dark.keep("dark-chinese-left-handed");
    assert!(brightness(&light) > 190.0, "{}", brightness(&light));
    assert!(brightness(&dark) < 80.0, "{}", brightness(&dark));
}

#[test]
fn a_display_of_twice_the_density_shows_everything_twice_as_fine() {
    let (screen, home) = (Screen::beside_others(2560, 1600), TempDir::new().unwrap());
    let mut program = daisy_in(&screen, home.path(), &[("WINIT_X11_SCALE_FACTOR", "2")]);
    program.picture(&screen).keep("daisy-2x");
    let ([left, top, _, canvas], [right, _, width, height]) = (program.area("canvas"), program.area("plant"));
    assert_eq!([left, top], [120.0, 104.0], "the bars are as wide in points");
    assert!(right + width < 2560.0 && top + canvas < 1600.0 && canvas > 1400.0);
    assert!((100.0..140.0).contains(&(canvas - height)), "the bar with the tools of the plant below it");
}

#[test]
fn the_theme_follows_the_desktop_that_is_asked_over_the_session_bus() {
    use std::os::unix::fs::PermissionsExt as _;
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    // A desktop that says what is written in a file, in the place of the program that asks the real one.
    let (tools, answer) = (home.path().join("tools"), home.path().join("answer"));
    fs::create_dir(&tools).unwrap();
    let asks = tools.join("busctl");
    fs::write(&asks, format!("#!/bin/sh\nexec cat {}\n", answer.display())).unwrap();
    fs::set_permissions(&asks, fs::Permissions::from_mode(0o755)).unwrap();
    let path = format!("{}:{}", tools.display(), std::env::var("PATH").unwrap());
    let bus = [("PATH", path.as_str()), ("DBUS_SESSION_BUS_ADDRESS", "unix:path=/nonexistent")];
    fs::write(&answer, "v v u 1\n").unwrap();
    let mut program = daisy_in(&screen, home.path(), &bus);
    let dark = brightness(&program.picture(&screen));
    assert!(dark < 80.0, "{dark}");
    // The desktop changes its mind while another window is looked at.
    fs::write(&answer, "v v u 2\n").unwrap();
    let other = Program::start(&screen, home.path(), &[]);
    program.raise(&screen);
    program.wait_for("awake");
    drop(other);
    program.raise(&screen);
    // The desktop is asked on a thread of its own.
    let light = brightness(&program.picture_where(&screen, |picture| brightness(picture) > 190.0));
    assert!(light > 190.0, "{light}");
}

#[test]
fn light_projection_and_the_divider_are_kept_for_the_next_session() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let mut program = daisy_in(&screen, home.path(), &[]);
    let canvas = program.area("canvas");
    screen.hand(&["key", "ctrl+q"]);
    assert!(program.wait().success());
    let file = home.path().join(".config/penstemon/settings.toml");
    let settings = fs::read_to_string(&file).unwrap();
    assert!(settings.contains("orthographic = true"), "{settings}");
    let settings = settings.replace("shading = \"shaded\"", "shading = \"parts\"");
    fs::write(&file, settings.replace("canvas_share = 0.5", "canvas_share = 0.6")).unwrap();
    let mut again = daisy_in(&screen, home.path(), &[]);
    let moved = again.area("canvas");
    assert!((moved[2] - 1.2 * canvas[2]).abs() < 2.0, "{moved:?} after {canvas:?}");
    again.picture(&screen).keep("kept-view");
}

#[test]
fn the_windows_size_is_kept_for_the_next_session_as_far_as_the_monitor_has_room() {
    let home = TempDir::new().unwrap();
    {
        let screen = Screen::beside_others(1600, 1000);
        let mut program = daisy_in(&screen, home.path(), &[]);
        assert_eq!(size_of(&mut program, &screen), [1280, 800]);
        let window = program.window(&screen);
        screen.hand(&["windowsize", "--sync", &window, "1400", "900"]);
        program.rest();
        screen.hand(&["key", "ctrl+q"]);
        assert!(program.wait().success());
        let mut again = daisy_in(&screen, home.path(), &[]);
        assert_eq!(size_of(&mut again, &screen), [1400, 900]);
        // What a window manager says of a window that fills its monitor; there is none here to do it.
        let window = again.window(&screen);
        Client::on(&screen).call_maximised(&window);
        screen.hand(&["windowsize", "--sync", &window, "1600", "1000"]);
        again.rest();
        screen.hand(&["key", "ctrl+q"]);
        assert!(again.wait().success());
    }
    let settings = fs::read_to_string(home.path().join(".config/penstemon/settings.toml")).unwrap();
    assert!(settings.contains("maximised = true") && settings.contains("width = 1400.0"), "{settings}");
    let screen = Screen::beside_others(1280, 1024);
    let mut smaller = daisy_in(&screen, home.path(), &[]);
    assert_eq!(size_of(&mut smaller, &screen), [1280, 900]);
}

/// Width and height of the window in pixels.
fn size_of(program: &mut Program, screen: &Screen) -> [u32; 2] {
    let output = screen.hand(&["getwindowgeometry", "--shell", &program.window(screen)]);
    ["WIDTH=", "HEIGHT="].map(|name| {
        output.lines().find_map(|line| line.strip_prefix(name)).and_then(|size| size.parse().ok()).unwrap()
    })
}

#[test]
fn the_divider_between_drawing_and_plant_is_dragged_and_the_drawing_still_fits() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let mut program = daisy_in(&screen, home.path(), &[]);
    let before = (program.area("canvas"), program.area("plant"));
    let strokes = program.last_logged("built revision");
    let [left, top, width, height] = before.0;
    let ink = ink_in(&program.picture(&screen), before.0);
    let (from, y) = (left + width, top + 0.5 * height);
    drag(&screen, &mut program, [from, y], from - 150.0);
    program.rest();
    let after = (program.area("canvas"), program.area("plant"));
    assert!((after.0[2] - (width - 150.0)).abs() <= 2.0, "{after:?} after {before:?}");
    assert!((after.1[2] - (before.1[2] + 150.0)).abs() <= 2.0, "{after:?} after {before:?}");
    assert_eq!((after.0[0] + after.0[2], after.0[3]), (after.1[0], height), "nothing lies between");
    let picture = program.picture(&screen);
    picture.keep("divider-dragged");
    let narrow = ink_in(&picture, after.0);
    assert!(narrow[0] > after.0[0] && narrow[2] < after.0[0] + after.0[2] - 1.0, "{narrow:?}");
    let shape = |[left, top, right, bottom]: [f64; 4]| (right - left) / (bottom - top);
    assert!((shape(narrow) / shape(ink) - 1.0).abs() < 0.05, "{narrow:?} after {ink:?}");
    assert!(narrow[2] - narrow[0] < ink[2] - ink[0], "the drawing was fitted anew");
    assert_eq!(program.last_logged("built revision"), strokes, "nothing was drawn");

    // As far as it goes: both sides stay wide enough to be taken hold of.
    let from = after.1[0];
    drag(&screen, &mut program, [from, y], 2.0);
    program.rest();
    let room = width + before.1[2];
    assert!((program.area("canvas")[2] - 0.2 * room).abs() <= 2.0, "{:?}", program.area("canvas"));
}

/// Drags sideways; every move is seen by a frame of its own, however slow the machine.
fn drag(screen: &Screen, program: &mut Program, [from, y]: [f64; 2], to: f64) {
    let at = |x: f64| ["mousemove".to_owned(), x.round().to_string(), y.round().to_string()];
    let press = |what: &str| [what.to_owned(), "1".to_owned()];
    let moves =
        [at(from).to_vec(), press("mousedown").to_vec(), at(0.5 * (from + to)).to_vec(), at(to).to_vec()];
    for words in moves.into_iter().chain([press("mouseup").to_vec()]) {
        screen.hand(&words.iter().map(String::as_str).collect::<Vec<_>>());
        program.rest();
    }
}

/// Where the daisy's strokes are seen.
fn ink_in(picture: &Pixels, area: Area) -> [f64; 4] {
    // The legend in the corner has the same colours.
    picture.extent(PETAL, [area[0], area[1], area[2] - 12.0, 0.6 * area[3]])
}
