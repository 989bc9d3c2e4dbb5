//! Strokes to SVG: one path each, as wide as the pen pressed on average, with what SVG cannot say in `data-tool` and
//! `data-pressure`.
//!
//! Reading it back gives the same strokes, positions and pressures bit by bit. Not written: ids (strokes are numbered
//! anew), tilt, time and depth, species and settings, and the reference picture, which is only there to be traced.

use crate::sketch::json::push_number;
use crate::sketch::{Sketch, Stroke, StrokePoint, Tool};

/// Width of a line at full pressure, as a share of the sheet's diagonal.
const FULL_WIDTH: f32 = 0.003;

/// Share of that width which the lightest touch draws.
const LIGHTEST: f32 = 0.25;

/// The sketch as an SVG document. The same sketch always gives the same text.
pub fn write(sketch: &Sketch) -> String {
    let samples: usize = sketch.strokes.iter().map(|stroke| stroke.points.len()).sum();
    let mut out = String::with_capacity(256 + 160 * sketch.strokes.len() + 20 * samples);
    let [width, height] = [sketch.canvas.width, sketch.canvas.height];
    let full_width = FULL_WIDTH * width.hypot(height);
    out.push_str("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"");
    push_number(&mut out, width);
    out.push_str("\" height=\"");
    push_number(&mut out, height);
    out.push_str("\" viewBox=\"0 0 ");
    push_numbers(&mut out, [width, height]);
    out.push_str("\" fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n");
    for stroke in sketch.strokes.iter().filter(|stroke| !stroke.tool.is_brush()) {
        push_path(&mut out, stroke, full_width);
    }
    out.push_str("</svg>\n");
    out
}

fn push_path(out: &mut String, stroke: &Stroke, full_width: f32) {
    let mean = stroke.points.iter().map(|p| p.pressure).sum::<f32>() / stroke.points.len().max(1) as f32;
    let pen_width = full_width * (LIGHTEST + (1.0 - LIGHTEST) * mean);
    let (tool, colour) = (stroke.tool.name(), colour(stroke.tool));
    out.push_str(&format!("  <path data-tool=\"{tool}\" stroke=\"{colour}\" stroke-width=\""));
    push_number(out, pen_width);
    let is_dot = stroke.points.len() == 1;
    if is_dot || stroke.points.iter().any(|p| p.pressure != StrokePoint::NEUTRAL_PRESSURE) {
        out.push_str("\" data-pressure=\"");
        push_numbers(out, stroke.points.iter().map(|p| p.pressure));
    }
    out.push_str("\" d=\"");
    // A line that goes nowhere is how SVG draws a dot.
    let again = stroke.points.iter().filter(|_| is_dot);
    for (i, point) in stroke.points.iter().chain(again).enumerate() {
        out.push_str(if i == 0 { "M" } else { " L" });
        push_numbers(out, point.position.to_array());
    }
    out.push_str("\"/>\n");
}

fn push_numbers(out: &mut String, numbers: impl IntoIterator<Item = f32>) {
    for (i, number) in numbers.into_iter().enumerate() {
        out.push_str(if i == 0 { "" } else { " " });
        push_number(out, number);
    }
}

/// Dark enough for white paper, and apart for the eye.
fn colour(tool: Tool) -> &'static str {
    match tool {
        Tool::Auto => "#26313a",
        Tool::Petal | Tool::FlowerBrush => "#b03a6e",
        Tool::Leaf | Tool::LeafOutline | Tool::LeafBrush => "#2f7a3d",
        Tool::Branch
        | Tool::BranchOutline
        | Tool::SpaceBranch
        | Tool::GrowthBrush
        | Tool::PruningBrush
        | Tool::LightBrush => "#7a4f2a",
        Tool::Crown => "#4a4fb5",
    }
}
