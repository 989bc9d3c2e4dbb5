//! Sketch to JSON text: one stroke per line, so that a version control system shows which strokes changed.
//!
//! Numbers are the shortest that read back to the same bits; a stroke's points carry no more numbers than it needs.

use super::number::push_number;
use super::{FORMAT, corrections, garden, part_poses, petal_shapes, plants, version_of};
use crate::sketch::garden::named;
use crate::sketch::garden_drawing::GardenDrawing;
use crate::sketch::reference::Reference;
use crate::sketch::textures;
use crate::sketch::{Brush, Sketch, Stroke, StrokePoint};
use serde_json::json;

/// The sketch as a `.penstemon` file. The same sketch always gives the same text.
pub fn write(sketch: &Sketch) -> String {
    let pictures: usize = sketch.pictures().map(|picture| picture.bytes().len() * 4 / 3).sum();
    let samples: usize = sketch.strokes.iter().map(|s| s.points.len()).sum();
    let mut out = String::with_capacity(256 + 64 * sketch.strokes.len() + 24 * samples + pictures);
    let version = version_of(sketch);
    out.push_str(&format!("{{\n  \"format\": {},\n  \"version\": {version},\n", json!(FORMAT)));
    out.push_str("  \"canvas\": {\"width\": ");
    push_number(&mut out, sketch.canvas.width);
    out.push_str(", \"height\": ");
    push_number(&mut out, sketch.canvas.height);
    out.push_str("},\n");
    if let Some(species) = &sketch.species {
        out.push_str(&format!("  \"species\": {},\n", json!(species)));
    }
    out.push_str(&format!("  \"seed\": {},\n  \"params\": {},\n", sketch.seed, json!(sketch.params)));
    let (choices, pictures) = textures::named(&sketch.textures);
    if !choices.is_empty() {
        out.push_str(&format!("  \"textures\": {},\n", json!(choices)));
    }
    push_lines(&mut out, "plants", &sketch.plants, plants::push);
    push_lines(&mut out, "corrections", &sketch.corrections, corrections::push);
    push_lines(&mut out, "petal_shapes", &sketch.petal_shapes, petal_shapes::push);
    push_lines(&mut out, "wood_poses", &sketch.part_poses, part_poses::push);
    push_lines(&mut out, "garden", &sketch.garden, |out, stroke| garden::push(out, stroke, name_of));
    out.push_str("  \"strokes\": [");
    for (i, stroke) in sketch.strokes.iter().enumerate() {
        out.push_str(if i == 0 { "\n    " } else { ",\n    " });
        push_stroke(&mut out, stroke);
    }
    out.push_str("\n  ]");
    // A sound garden has no two of one name.
    let drawings = named(&sketch.garden).unwrap_or_default();
    if !drawings.is_empty() {
        out.push_str(",\n  \"garden_drawings\": ");
        push_garden_drawings(&mut out, drawings.into_values());
    }
    if let Some(reference) = &sketch.reference {
        out.push_str(",\n  \"reference\": {");
        push_placement(&mut out, reference);
        out.push_str(", \"picture\":\n    \"");
        reference.picture.push_base64(&mut out);
        out.push_str("\"}");
    }
    for (i, (name, picture)) in pictures.iter().enumerate() {
        out.push_str(if i == 0 { ",\n  \"pictures\": {" } else { "," });
        out.push_str(&format!("\n    {}: \"", json!(name)));
        picture.push_base64(&mut out);
        out.push('"');
    }
    if !pictures.is_empty() {
        out.push_str("\n  }");
    }
    out.push_str("\n}\n");
    out
}

/// Appends the drawings as an object; each begins on a line of its own.
pub(in crate::sketch) fn push_garden_drawings<'a>(
    out: &mut String,
    drawings: impl IntoIterator<Item = &'a GardenDrawing>,
) {
    for (i, drawing) in drawings.into_iter().enumerate() {
        out.push_str(if i == 0 { "{\n" } else { ",\n" });
        out.push_str(&format!("{}: {}", json!(drawing.name()), write(drawing.sketch()).trim_end()));
    }
    out.push_str("\n}");
}

fn name_of(drawing: &GardenDrawing) -> String {
    drawing.name().to_owned()
}

/// A field that is a list, each of its items on a line; nothing where there are none.
fn push_lines<T>(out: &mut String, name: &str, items: &[T], push: impl Fn(&mut String, &T)) {
    for (i, item) in items.iter().enumerate() {
        out.push_str(&if i == 0 { format!("  \"{name}\": [\n    ") } else { ",\n    ".to_owned() });
        push(out, item);
    }
    if !items.is_empty() {
        out.push_str("\n  ],\n");
    }
}

/// How the reference lies, without its picture and without braces.
pub(super) fn push_placement(out: &mut String, reference: &Reference) {
    let Reference { picture: _, center, width, rotation_deg, opacity, locked, visible } = reference;
    for (name, number) in [
        ("\"center\": [", center.x),
        (", ", center.y),
        ("], \"width\": ", *width),
        (", \"rotation_deg\": ", *rotation_deg),
        (", \"opacity\": ", *opacity),
    ] {
        out.push_str(name);
        push_number(out, number);
    }
    out.push_str(&format!(", \"locked\": {locked}, \"visible\": {visible}"));
}

/// One stroke on one line.
pub(super) fn push_stroke(out: &mut String, stroke: &Stroke) {
    out.push_str(&format!("{{\"id\": {}, \"tool\": {}", stroke.id, json!(stroke.tool)));
    if let Some(Brush { radius, density, guide }) = stroke.brush {
        for (name, number) in [("brush\": {\"radius", radius), ("density", density), ("guide", guide)] {
            out.push_str(&format!(", \"{name}\": "));
            push_number(out, number);
        }
        out.push('}');
    }
    out.push_str(", \"points\": [");
    let arity = stroke.points.iter().map(arity).max().unwrap_or(2);
    for (i, p) in stroke.points.iter().enumerate() {
        out.push_str(if i == 0 { "[" } else { ", [" });
        let StrokePoint { position, pressure, tilt_deg, time_ms, depth } = *p;
        let numbers = [position.x, position.y, pressure, tilt_deg.x, tilt_deg.y, time_ms, depth];
        for (k, number) in numbers[..arity].iter().enumerate() {
            out.push_str(if k == 0 { "" } else { ", " });
            push_number(out, *number);
        }
        out.push(']');
    }
    out.push_str("]}");
}

/// How many numbers it takes to tell this sample.
fn arity(point: &StrokePoint) -> usize {
    let plain = StrokePoint::at(point.position);
    if point.depth != plain.depth {
        7
    } else if point.time_ms != plain.time_ms {
        6
    } else if point.tilt_deg != plain.tilt_deg {
        5
    } else if point.pressure != plain.pressure {
        3
    } else {
        2
    }
}
