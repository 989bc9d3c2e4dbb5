//! The ways in which some strokes of a drawing can be read, each with a small flat picture of what they become.
//!
//! Each way is analysed as the drawing would be if the artist chose it, which takes a while for a large one: it is done on a
//! thread of its own when somebody asks. Coordinates of pictures are shares of a square that all ways have in common.

use crate::anatomy::conventions::alternatives::alternatives;
use crate::anatomy::{self, Anatomy, AnatomyParams, Cache, Part, Sample};
use crate::sketch::corrections::corrected;
use crate::sketch::{Correction, Reading, Sketch, StrokeId, Verdict};
use glam::Vec2;
use std::collections::HashSet;
use std::sync::Arc;

/// One way to read some strokes.
#[derive(Clone, Debug, PartialEq)]
pub struct WayToRead {
    /// What the artist says with it.
    pub correction: Correction,
    /// What the strokes become.
    pub lines: Arc<[PictureLine]>,
}

/// A line of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureLine {
    /// What it is a part of.
    pub part: Shown,
    /// Its points, 0 to 1 to the right and down.
    pub points: Vec<[f32; 2]>,
    /// Its width as it was drawn; 0 for a thin line.
    pub width: f32,
    /// Whether its end is joined to its beginning.
    pub is_closed: bool,
}

/// What is shown in a colour of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// A part, of a branch its level.
    Part(Part, u32),
    /// What strokes are read as that is no part of the plant itself.
    Beside(Reading),
}

/// The ways to read these strokes, the likeliest first; none if `stop` said yes.
pub fn ways_to_read(
    sketch: &Sketch,
    params: &AnatomyParams,
    about: &[StrokeId],
    stop: anatomy::Stop,
) -> Vec<WayToRead> {
    let about_set: HashSet<StrokeId> = about.iter().copied().collect();
    // The ways differ in these strokes only: all that is read of others is kept from one to the next.
    let (mut ways, mut cache) = (Vec::new(), Cache::default());
    for correction in alternatives(sketch, &params.conventions, about) {
        let ids = sketch.strokes.iter().map(|stroke| stroke.id);
        let corrections = corrected(&sketch.corrections, correction.clone(), ids);
        let chosen = Sketch { corrections, ..sketch.clone() };
        let Some(anatomy) = anatomy::analyse_with(&mut cache, &chosen, params, stop) else {
            return Vec::new();
        };
        ways.push((correction, drawn_lines(sketch, &anatomy, &about_set)));
    }
    let fit = Fit::of(ways.iter().flat_map(|(_, lines)| lines));
    let way = |(correction, lines): (Correction, Vec<Line>)| WayToRead {
        correction,
        lines: lines.into_iter().map(|line| fit.apply(line)).collect(),
    };
    ways.into_iter().map(way).collect()
}

/// A line in canvas pixels.
struct Line {
    part: Shown,
    points: Vec<Vec2>,
    width: f32,
    is_closed: bool,
}

impl Line {
    /// A thin closed line.
    fn around(part: Shown, points: Vec<Vec2>) -> Self {
        Self { part, points, width: 0.0, is_closed: true }
    }
}

/// Where a picture's square lies on the canvas.
struct Fit {
    corner: Vec2,
    side: f32,
}

impl Fit {
    fn of<'a>(lines: impl Iterator<Item = &'a Line>) -> Self {
        let empty = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        let (low, high) =
            lines.flat_map(|line| &line.points).fold(empty, |(low, high), p| (low.min(*p), high.max(*p)));
        let side = (high - low).max_element();
        if !side.is_finite() || side <= 0.0 {
            return Self { corner: Vec2::ZERO, side: 1.0 };
        }
        Self { corner: 0.5 * (low + high) - 0.5 * side, side }
    }

    fn apply(&self, line: Line) -> PictureLine {
        let Line { part, points, width, is_closed } = line;
        let points = points.iter().map(|p| ((*p - self.corner) / self.side).to_array()).collect();
        PictureLine { part, points, width: width / self.side, is_closed }
    }
}

/// Everything that becomes of these strokes, the drawn strokes themselves where nothing does.
fn drawn_lines(sketch: &Sketch, anatomy: &Anatomy, about: &HashSet<StrokeId>) -> Vec<Line> {
    let mut drawing = Drawing { anatomy, about, made: HashSet::new(), lines: Vec::new() };
    drawing.add_parts();
    drawing.add_solids();
    drawing.add_strokes(sketch);
    drawing.lines
}

/// A picture on its way.
struct Drawing<'a> {
    anatomy: &'a Anatomy,
    about: &'a HashSet<StrokeId>,
    /// Strokes that became something that is drawn.
    made: HashSet<StrokeId>,
    lines: Vec<Line>,
}

impl Drawing<'_> {
    /// Adds what was made of a stroke, drawn or made of drawn ones, if it is one of those that the picture is about.
    fn add(&mut self, stroke: StrokeId, line: Line) {
        let piece = self.anatomy.pieces.get(&stroke);
        let own = [stroke];
        let drawn = piece.map_or(&own[..], |piece| &piece.strokes[..]);
        if drawn.iter().any(|stroke| self.about.contains(stroke)) {
            self.made.extend(drawn);
            self.lines.push(line);
        }
    }

    fn add_parts(&mut self) {
        let Anatomy { crowns, branches, leaves, petals, .. } = self.anatomy;
        for crown in crowns {
            self.add(crown.stroke, Line::around(Shown::Part(Part::Crown, 0), crown.outline.clone()));
        }
        for branch in branches {
            let Some(stroke) = branch.stroke else { continue };
            let pressures: f32 = branch.line.iter().map(|s| s.pressure).sum();
            let pressure = pressures / branch.line.len().max(1) as f32;
            let width = branch.half_width.map_or(0.0, |half| 2.0 * half * pressure);
            let (part, points) = (Shown::Part(Part::Branch, branch.level), positions(&branch.line));
            self.add(stroke, Line { part, points, width, is_closed: false });
        }
        for (blades, part) in [(leaves, Part::Leaf), (petals, Part::Petal)] {
            for blade in blades.iter().filter(|blade| blade.copy_of.is_none()) {
                let Some(stroke) = blade.stroke else { continue };
                self.add(stroke, Line::around(Shown::Part(part, 0), positions(&blade.outline)));
            }
        }
    }

    fn add_solids(&mut self) {
        let Anatomy { solids, readings, .. } = self.anatomy;
        for drawn in solids {
            let (axis, profile) = (drawn.solid.axis, &drawn.solid.profile);
            let right = profile.iter().map(|p| Vec2::new(axis + p.x, p.y));
            let left = profile.iter().rev().map(|p| Vec2::new(axis - p.x, p.y));
            let outline = Line::around(Shown::Beside(Reading::Pot), right.chain(left).collect());
            self.add(drawn.stroke, outline);
            let of_it = readings.iter().filter(|read| read.strokes.contains(&drawn.stroke));
            self.made.extend(of_it.flat_map(|read| &read.strokes));
        }
    }

    /// Adds strokes that became nothing else.
    fn add_strokes(&mut self, sketch: &Sketch) {
        for (stroke, mark) in sketch.strokes.iter().zip(&self.anatomy.marks) {
            if self.about.contains(&stroke.id) && !self.made.contains(&stroke.id) {
                let part = shown(self.anatomy, stroke.id, mark.part);
                let points = stroke.points.iter().map(|p| p.position).collect();
                self.lines.push(Line { part, points, width: 0.0, is_closed: false });
            }
        }
    }
}

fn positions(samples: &[Sample]) -> Vec<Vec2> {
    samples.iter().map(|sample| sample.position).collect()
}

/// What a stroke is shown as that was understood as this part.
fn shown(anatomy: &Anatomy, stroke: StrokeId, part: Part) -> Shown {
    let read = || anatomy.readings.iter().find(|read| read.strokes.contains(&stroke));
    match part {
        Part::Ignored => read().map_or(Shown::Part(part, 0), |read| Shown::Beside(read.reading)),
        part => Shown::Part(part, 0),
    }
}

/// Whether a way is how its strokes are read now: as `read`, or, where that is none, each by itself.
pub fn holds(way: &WayToRead, read: Option<Reading>) -> bool {
    way.correction.verdict == read.map_or(Verdict::Separate, Verdict::As)
}
