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

/// A plant that grows from a seed and stands beside the drawn one.
pub struct Grown {
    /// Built-in species.
    pub species: &'static str,
    /// Seed of everything random in it.
    pub seed: u64,
    /// Age in years.
    pub age: u32,
    /// Where it stands, pixels.
    pub foot: [u32; 2],
    /// How high it is, pixels.
    pub height: u32,
}

/// A drawing.
pub struct Sheet {
    /// Built-in species that the drawing shows; empty leaves it to the program.
    pub species: &'static str,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Plants beside the drawn one.
    pub plants: &'static [Grown],
    /// Strokes, oldest first; their ids count from 1.
    pub strokes: Vec<Stroke>,
}

impl Sheet {
    /// The text of the sketch file.
    pub fn to_json(&self) -> String {
        let lines: Vec<String> =
            self.strokes.iter().enumerate().map(|(i, s)| stroke_line(i + 1, s)).collect();
        // Older programs open what they understand.
        let version = if self.plants.is_empty() { 1 } else { 3 };
        let species = match self.species {
            "" => String::new(),
            name => format!("\"species\": \"{name}\", "),
        };
        format!(
            "{{ \"format\": \"penstemon-sketch\", \"version\": {version},\n  \
             \"canvas\": {{ \"width\": {}, \"height\": {} }},\n  \
             {species}\"seed\": 1, \"params\": {{ }},\n{}  \
             \"strokes\": [\n{}\n  ] }}\n",
            self.size[0],
            self.size[1],
            plant_lines(self.plants),
            lines.join(",\n")
        )
    }
}

/// The list of plants, one on a line; nothing without any.
fn plant_lines(plants: &[Grown]) -> String {
    let line = |plant: &Grown| {
        let Grown { species, seed, age, foot: [x, y], height } = plant;
        format!(
            "    {{ \"maker\": \"growth\", \"species\": \"{species}\", \"seed\": {seed}, \"age\": {age}, \
             \"foot\": [{x},{y}], \"height\": {height} }}"
        )
    };
    let lines: Vec<String> = plants.iter().map(line).collect();
    if lines.is_empty() { String::new() } else { format!("  \"plants\": [\n{}\n  ],\n", lines.join(",\n")) }
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
