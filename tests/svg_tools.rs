//! Our SVG files in the hands of other programs: librsvg draws them, scour rewrites them, and they are read back.
//!
//! Needs rsvg-convert and scour (Debian: librsvg2-bin, scour).

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use glam::Vec2;
use penstemon::sketch::{self, Remark, Sketch};
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

const NAMES: [&str; 3] = ["daisy", "hepatica_blue", "bouquet"];

fn sketch_of(name: &str) -> Sketch {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/sketches/{name}.penstemon"));
    sketch::read(&path).unwrap().0
}

/// The sketch as an SVG file in a folder.
fn exported(sketch: &Sketch, folder: &TempDir) -> PathBuf {
    let path = folder.path().join("drawing.svg");
    std::fs::write(&path, sketch::svg::write(sketch)).unwrap();
    path
}

fn run(program: &str, words: &[&str], package: &str) {
    let done = Command::new(program).args(words).output();
    let done = done.unwrap_or_else(|e| panic!("{program}, from Debian's package {package}: {e}"));
    assert!(done.status.success(), "{program}: {}", String::from_utf8_lossy(&done.stderr));
}

/// Darkness of a grey picture, 0 to 255, row by row, with its width.
fn darkness(path: &Path) -> (usize, Vec<u8>) {
    let mut decoder = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(path).unwrap()));
    decoder.set_transformations(png::Transformations::normalize_to_color8() | png::Transformations::ALPHA);
    let mut reader = decoder.read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    let channels = info.color_type.samples();
    let dark = |pixel: &[u8]| 255 - pixel[..channels - 1].iter().copied().min().unwrap();
    (info.width as usize, bytes.chunks_exact(channels).map(dark).collect())
}

/// Distance from a place to a stroke's line.
fn distance(p: Vec2, line: &[Vec2]) -> f32 {
    let to_piece = |a: Vec2, b: Vec2| {
        let t = ((p - a).dot(b - a) / (b - a).length_squared().max(1e-12)).clamp(0.0, 1.0);
        p.distance(a + (b - a) * t)
    };
    let pieces = line.windows(2).map(|w| to_piece(w[0], w[1]));
    pieces.chain(line.first().map(|a| p.distance(*a))).fold(f32::INFINITY, f32::min)
}

fn lines(sketch: &Sketch) -> Vec<Vec<Vec2>> {
    sketch.strokes.iter().map(|s| s.points.iter().map(|p| p.position).collect()).collect()
}

#[test]
fn librsvg_draws_the_strokes_where_they_were_drawn_and_nothing_else() {
    for name in NAMES {
        let (sketch, folder) = (sketch_of(name), TempDir::new().unwrap());
        let (file, picture) = (exported(&sketch, &folder), folder.path().join("drawing.png"));
        let [from, to] = [&file, &picture].map(|path| path.to_str().unwrap());
        run("rsvg-convert", &["-b", "white", from, "-o", to], "librsvg2-bin");
        let (width, dark) = darkness(&picture);
        let height = dark.len() / width;
        assert!((width as f32 - sketch.canvas.width).abs() <= 1.0, "{name} is {width} wide");
        let at = |p: Vec2| {
            let (x, y) = ((p.x as usize).min(width - 1), (p.y as usize).min(height - 1));
            dark[y * width + x]
        };
        let lines = lines(&sketch);
        let on_sheet = |p: &&Vec2| p.x >= 0.0 && p.y >= 0.0 && p.x < width as f32 && p.y < height as f32;
        let samples: Vec<&Vec2> = lines.iter().flatten().filter(on_sheet).collect();
        let inked = samples.iter().filter(|p| at(***p) > 40).count();
        assert!(inked * 100 >= samples.len() * 99, "{name}: {inked} of {} samples", samples.len());
        // The widest line is 0.3 % of the sheet's diagonal.
        let reach = 0.0015 * (width as f32).hypot(height as f32) + 1.5;
        for (i, _) in dark.iter().enumerate().filter(|(i, dark)| **dark > 40 && i % 7 == 0) {
            let p = Vec2::new((i % width) as f32 + 0.5, (i / width) as f32 + 0.5);
            let nearest = lines.iter().map(|line| distance(p, line)).fold(f32::INFINITY, f32::min);
            assert!(nearest <= reach, "{name}: ink at {p}, {nearest} from the nearest stroke");
        }
    }
}

/// Icons and what design programs write, in which styles decide what is seen: ink and strokes lie together.
#[test]
fn what_librsvg_draws_of_icons_is_what_is_read() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let icons = std::fs::read_dir(root.join("data/icons")).unwrap().map(|entry| entry.unwrap().path());
    let svgs = icons.filter(|path| path.extension().is_some_and(|ending| ending == "svg"));
    let mut count = 0;
    for file in svgs {
        let folder = TempDir::new().unwrap();
        let picture = folder.path().join("drawing.png");
        let [from, to] = [&file, &picture].map(|path| path.to_str().unwrap());
        run("rsvg-convert", &["-b", "white", "-w", "480", from, "-o", to], "librsvg2-bin");
        let (width, dark) = darkness(&picture);
        let (sketch, _) = sketch::read(&file).unwrap();
        let scale = width as f32 / sketch.canvas.width;
        let line = |line: Vec<Vec2>| line.into_iter().map(|p| p * scale).collect::<Vec<_>>();
        let lines: Vec<Vec<Vec2>> = lines(&sketch).into_iter().map(line).collect();
        for p in lines.iter().flatten() {
            let (x, y) = ((p.x as usize).min(width - 1), (p.y as usize).min(width - 1));
            assert!(dark[y * width + x] > 40, "{from}: no ink at {p}");
        }
        // Their lines are 1.5 or 2 units wide.
        let reach = scale + 1.5;
        for (i, _) in dark.iter().enumerate().filter(|(i, dark)| **dark > 40 && i % 7 == 0) {
            let p = Vec2::new((i % width) as f32 + 0.5, (i / width) as f32 + 0.5);
            let nearest = lines.iter().map(|line| distance(p, line)).fold(f32::INFINITY, f32::min);
            assert!(nearest <= reach, "{from}: ink at {p}, {nearest} from the nearest stroke");
        }
        count += 1;
    }
    assert_eq!(count, 24);
}

#[test]
fn a_file_that_scour_rewrote_is_the_same_drawing() {
    for name in NAMES {
        let (sketch, folder) = (sketch_of(name), TempDir::new().unwrap());
        let (file, rewritten) = (exported(&sketch, &folder), folder.path().join("rewritten.svg"));
        let [from, to] = [&file, &rewritten].map(|path| path.to_str().unwrap());
        let digits =
            ["--set-precision=8", "--enable-viewboxing", "--enable-id-stripping", "--strip-xml-prolog"];
        run("scour", &[digits.as_slice(), &["-i", from, "-o", to]].concat(), "scour");
        let text = std::fs::read_to_string(&rewritten).unwrap();
        assert_ne!(text, std::fs::read_to_string(&file).unwrap());
        let (again, warnings) = sketch::read(&rewritten).unwrap();
        // It leaves out points on the way of a straight line; then the pressures belong to none, which is told.
        let odd = warnings.iter().find(|warning| !matches!(warning.remark, Remark::PressureUnfit { .. }));
        assert_eq!(odd, None, "{name}");
        assert_eq!(again.strokes.len(), sketch.strokes.len(), "{name}");
        let most = 1e-4 * sketch.diagonal();
        for (was, is) in sketch.strokes.iter().zip(&again.strokes) {
            assert_eq!(is.tool, was.tool, "{name}, stroke {}", was.id);
            let line: Vec<Vec2> = is.points.iter().map(|p| p.position).collect();
            let off = was.points.iter().map(|p| distance(p.position, &line)).fold(0.0, f32::max);
            assert!(off <= most, "{name}, stroke {}: {off} px off", was.id);
        }
    }
}
