//! Pictures of the plant and of the turntable, ordered in the export dialog.

use crate::program::Program;
use crate::screen::{Pixels, Screen};
use crate::sketch_file;
use std::path::Path;
use tempfile::TempDir;

/// The last part of the dialog's format row, PNG; of the sizes the first, 800×600; of the frames 1 and 12.
const PNG: [f64; 2] = [805.0, 189.0];
const SMALL: [f64; 2] = [475.0, 366.0];
const ONE_FRAME: [f64; 2] = [475.0, 437.0];
const TWELVE_FRAMES: [f64; 2] = [585.0, 437.0];

fn read(path: &Path) -> Pixels {
    let decoder = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(path).unwrap()));
    let mut reader = decoder.read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    assert_eq!(info.color_type, png::ColorType::Rgba);
    let rgb = bytes.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
    Pixels { width: info.width, height: info.height, rgb }
}

fn order(screen: &Screen, program: &mut Program, name: &str, places: &[[f64; 2]]) {
    screen.hand(&["key", "ctrl+e"]);
    for place in places {
        program.rest_in_dialog("export");
        screen.click(*place);
    }
    program.picture(screen).keep(&format!("export-{name}"));
    program.press_loud_button(screen, "export");
    program.type_name(screen, name);
    program.wait_for("exported");
}

#[test]
fn a_picture_and_a_turntable_are_written_as_ordered() {
    let (screen, home) = (Screen::beside_others(1280, 800), TempDir::new().unwrap());
    let file = home.path().join("a daisy.penstemon");
    std::fs::copy(sketch_file("daisy"), &file).unwrap();
    let mut program = Program::start(&screen, home.path(), &[file.to_str().unwrap()]);
    program.built();
    order(&screen, &mut program, "daisy", &[PNG, SMALL, ONE_FRAME]);
    let front = read(&home.path().join("daisy.png"));
    assert_eq!((front.width, front.height), (800, 600));
    let whole = [0.0, 0.0, 800.0, 600.0];
    let empty = Pixels { rgb: front.at(2, 2).repeat(800 * 600), ..front };
    assert!(front.changed(&empty, whole) > 0.02, "the plant is seen");

    order(&screen, &mut program, "round", &[TWELVE_FRAMES]);
    let frames: Vec<Pixels> = (0..12).map(|n| read(&home.path().join(format!("round-{n:03}.png")))).collect();
    assert!(!home.path().join("round-012.png").exists());
    assert!(frames[0].changed(&front, whole) < 0.001, "the first is the view as it stands");
    for (n, pair) in frames.windows(2).enumerate() {
        let turned = pair[1].changed(&pair[0], whole);
        assert!(turned > 0.005, "frame {n} differs from the next in {turned} of its pixels");
    }
}
