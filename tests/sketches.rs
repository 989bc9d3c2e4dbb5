//! The committed drawings are what the drawing program makes, and what the sketch format and the analysis expect.

#[path = "../examples/draw_sketches/drawing/mod.rs"]
mod drawing;

use drawing::{Drawing, all};
use serde::Deserialize;
use std::collections::HashSet;
use std::path::Path;

const TOOLS: [&str; 7] = ["auto", "petal", "leaf", "branch", "branch_outline", "leaf_outline", "crown"];

fn committed(drawing: &Drawing) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(drawing.folder).join(drawing.file_name());
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

#[derive(Deserialize)]
struct File {
    format: String,
    version: u32,
    strokes: Vec<Stroke>,
}

#[derive(Deserialize)]
struct Stroke {
    id: u64,
    tool: String,
    /// x, y, pressure.
    points: Vec<[f64; 3]>,
}

/// The strokes as they stand in the file, read without the program's own reader.
fn strokes(drawing: &Drawing) -> Vec<Stroke> {
    let file: File =
        serde_json::from_str(&committed(drawing)).unwrap_or_else(|e| panic!("{}: {e}", drawing.file_name()));
    let version = if drawing.sheet.plants.is_empty() { 1 } else { 3 };
    assert_eq!((file.format.as_str(), file.version), ("penstemon-sketch", version));
    file.strokes
}

#[test]
fn drawing_again_gives_the_committed_bytes() {
    for drawing in all() {
        let same = committed(&drawing) == drawing.sheet.to_json();
        assert!(same, "{} differs: run `cargo run --example draw_sketches`", drawing.name);
    }
}

#[test]
fn strokes_are_sound() {
    for drawing in all() {
        let name = drawing.name;
        let (width, height) = (f64::from(drawing.sheet.size[0]), f64::from(drawing.sheet.size[1]));
        let strokes = strokes(&drawing);
        // A whole tree may be one stroke where people draw in their own way.
        let fewest = if name.starts_with("freehand") { 2 } else { 8 };
        assert!(strokes.len() >= fewest, "{name} has only {} strokes", strokes.len());
        let ids: HashSet<u64> = strokes.iter().map(|s| s.id).collect();
        assert_eq!(ids.len(), strokes.len(), "{name}: ids repeat");
        for Stroke { id, tool, points } in &strokes {
            assert!(TOOLS.contains(&tool.as_str()), "{name} stroke {id}: tool {tool}");
            assert!(points.len() >= 8, "{name} stroke {id}: {} points", points.len());
            for [x, y, pressure] in points {
                let inside = (0.0..=width).contains(x) && (0.0..=height).contains(y);
                assert!(inside, "{name} stroke {id}: ({x}, {y}) is off the sheet");
                assert!((0.0..=1.0).contains(pressure), "{name} stroke {id}: pressure {pressure}");
            }
        }
    }
}

/// Flowers in each drawing.
const FLOWERS: [(&str, usize); 19] = [
    ("daisy", 2),
    ("hepatica_red", 4),
    ("hepatica_blue", 3),
    ("jasmine", 4),
    ("mallow", 3),
    ("balloon_flower", 2),
    ("plumeria", 4),
    ("oxalis", 3),
    ("potted_plant", 0),
    ("tree_round", 0),
    ("tree_willow", 0),
    ("bamboo", 0),
    ("topiary", 0),
    ("bouquet", 3),
    ("sample", 2),
    ("garden", 3),
    ("two_plants", 2),
    ("crossing_branches", 0),
    ("many_scales", 4),
];

/// Leaves whose roots crowd would be taken for a flower unless they were drawn with the leaf tool.
#[test]
fn blades_crowd_only_in_flowers() {
    let in_the_papers_way = |drawing: &Drawing| !drawing.name.starts_with("freehand");
    for drawing in all().into_iter().filter(in_the_papers_way) {
        let diagonal = f64::from(drawing.sheet.size[0]).hypot(f64::from(drawing.sheet.size[1]));
        let mut roots: Vec<[f64; 2]> = strokes(&drawing)
            .iter()
            .filter(|s| s.tool == "auto")
            .filter_map(|s| root_if_closed(&s.points))
            .collect();
        let mut flowers = 0;
        while let Some(first) = roots.pop() {
            let before = roots.len();
            roots.retain(|r| (r[0] - first[0]).hypot(r[1] - first[1]) > 0.03 * diagonal);
            flowers += usize::from(before - roots.len() >= 2);
        }
        assert!(FLOWERS.contains(&(drawing.name, flowers)), "{} shows {flowers} flowers", drawing.name);
    }
}

/// Middle between the ends of a stroke that comes back to where it began.
fn root_if_closed(points: &[[f64; 3]]) -> Option<[f64; 2]> {
    let length: f64 = points.windows(2).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1])).sum();
    let ([ax, ay, _], [bx, by, _]) = (*points.first()?, *points.last()?);
    ((ax - bx).hypot(ay - by) < 0.12 * length).then_some([(ax + bx) / 2.0, (ay + by) / 2.0])
}
