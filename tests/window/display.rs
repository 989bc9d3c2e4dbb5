//! The X server ends under the open window, as when a session is closed or a remote connection breaks.

use crate::draw_line;
use crate::number;
use crate::program::Program;
use crate::screen::Screen;
use tempfile::TempDir;

/// The program on a server that ends after `work`; then it has said so, and the next one offers the drawing.
fn ends_with_a_word(work: impl FnOnce(&Screen, &mut Program)) {
    let home = TempDir::new().unwrap();
    let mut screen = Screen::beside_others(1280, 800);
    let mut program = Program::start(&screen, home.path(), &[]);
    program.built();
    screen.hand(&["key", "ctrl+n"]);
    program.built();
    draw_line(&screen, &mut program);
    work(&screen, &mut program);
    screen.end();
    program.wait_for("penstemon: the connection to the display broke; the drawing is kept");
    assert_eq!(program.wait().code(), Some(1));
    assert!(!program.has_logged("panicked"));
    drop(screen);
    let screen = Screen::beside_others(1280, 800);
    let mut again = Program::start(&screen, home.path(), &[]);
    again.built();
    assert_eq!(number(&again.last_logged("recoverable"), "strokes"), 1);
}

#[test]
fn a_display_that_goes_away_at_rest_ends_the_program_with_a_word() {
    ends_with_a_word(|_, program| program.idle());
}

#[test]
fn a_display_that_goes_away_under_a_moving_plant_ends_the_program_with_a_word() {
    ends_with_a_word(|screen, program| {
        // Never at rest: the plant is turned while the server ends.
        let [left, top, width, height] = program.area("plant");
        let at = |share: f64| format!("{}", (left + width * share).round());
        let y = format!("{}", (top + height * 0.5).round());
        let mut words =
            vec!["mousemove".to_owned(), at(0.3), y.clone(), "mousedown".to_owned(), "1".to_owned()];
        for step in 0..40 {
            words.extend(["mousemove".to_owned(), at(0.3 + 0.01 * f64::from(step)), y.clone()]);
        }
        screen.hand(&words.iter().map(String::as_str).collect::<Vec<_>>());
    });
}
