//! A finished drawing and how it is written down.
//!
//! One stroke per line, positions with one decimal, pressure with two: small files whose differences can be read.

use std::fmt::Write;

/// One stroke as it will stand in the file.
pub struct Stroke {
    /// Name of the tool, as in the sketch format.
    pub tool: &'static str,
    /// x, y in pixels and pressure 0 to 1.
    pub points: Vec<[f64; 3]>,
}

/// A drawing.
pub struct Sheet {
    /// Built-in species that the drawing shows.
    pub species: &'static str,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Strokes, oldest first; their ids count from 1.
    pub strokes: Vec<Stroke>,
}

impl Sheet {
    /// The text of the sketch file.
    pub fn to_json(&self) -> String {
        let lines: Vec<String> =
            self.strokes.iter().enumerate().map(|(i, s)| stroke_line(i + 1, s)).collect();
        format!(
            "{{ \"format\": \"penstemon-sketch\", \"version\": 1,\n  \
             \"canvas\": {{ \"width\": {}, \"height\": {} }},\n  \
             \"species\": \"{}\", \"seed\": 1, \"params\": {{ }},\n  \
             \"strokes\": [\n{}\n  ] }}\n",
            self.size[0],
            self.size[1],
            self.species,
            lines.join(",\n")
        )
    }
}

fn stroke_line(id: usize, stroke: &Stroke) -> String {
    let mut line = format!("    {{ \"id\": {id}, \"tool\": \"{}\", \"points\": [", stroke.tool);
    for (i, [x, y, pressure]) in stroke.points.iter().enumerate() {
        let comma = if i == 0 { "" } else { "," };
        // Writing to a `String` cannot fail.
        let _ = write!(line, "{comma}[{x:.1},{y:.1},{pressure:.2}]");
    }
    line + "] }"
}
