//! A reading of some strokes: which, how likely, and what becomes of them.

use crate::geom::polyline;
use crate::sketch::{Reading, StrokePoint, Tool};
use glam::Vec2;

/// What kind of plant a drawing shows, as far as that can be seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Habit {
    /// A trunk with a crown.
    Tree,
    /// A fir.
    Conifer,
    /// A crown that stands on the ground.
    Bush,
    /// A corolla on a stem.
    Flower,
    /// A trunk with fronds.
    Palm,
    /// Blades of grass.
    Grass,
    /// A cactus.
    Succulent,
    /// A cap on a stalk.
    Mushroom,
}

/// What a part of a hypothesis becomes.
#[derive(Clone, Debug, PartialEq)]
pub struct Made {
    /// The tool that such a part is drawn with.
    pub tool: Tool,
    /// Its line or outline.
    pub points: Vec<StrokePoint>,
    /// The half width that a pressure of 1 stands for, pixels, where the thickness was drawn.
    pub half_width: Option<f32>,
}

impl Made {
    /// A part drawn with `tool` along these places.
    pub fn new(tool: Tool, points: impl IntoIterator<Item = Vec2>) -> Self {
        Self { tool, points: points.into_iter().map(StrokePoint::at).collect(), half_width: None }
    }

    /// A branch as thick as drawn: its middle and half widths along it, from its root, pixels.
    pub fn thick(rows: impl IntoIterator<Item = (Vec2, f32)>) -> Self {
        let rows: Vec<(Vec2, f32)> = rows.into_iter().collect();
        let widest = rows.iter().map(|row| row.1).fold(f32::MIN_POSITIVE, f32::max);
        let points = rows
            .into_iter()
            .map(|(middle, half)| StrokePoint { pressure: half / widest, ..StrokePoint::at(middle) })
            .collect();
        Self { tool: Tool::Branch, points, half_width: Some(widest) }
    }
}

/// What a body of revolution is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SolidKind {
    /// A pot.
    Pot,
    /// A fruit.
    Fruit,
}

/// A body of revolution about an upright axis, in canvas pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// What it is.
    pub kind: SolidKind,
    /// Where the axis is, to the right.
    pub axis: f32,
    /// Radius and height of its outside, from above.
    pub profile: Vec<Vec2>,
}

impl Solid {
    /// Smallest and largest corner, seen from the front.
    pub fn bounds(&self) -> (Vec2, Vec2) {
        let sides = self.profile.iter().flat_map(|p| [-p.x, p.x].map(|x| Vec2::new(self.axis + x, p.y)));
        polyline::bounds(sides)
    }
}

/// The same hypotheses with other numbers for what they use, which must keep the order.
pub(super) fn renumbered(mut all: Vec<Hypothesis>, number: impl Fn(usize) -> usize) -> Vec<Hypothesis> {
    all.iter_mut().flat_map(|it| &mut it.uses).for_each(|used| *used = number(*used));
    all
}

/// A reading of some strokes.
#[derive(Clone, Debug, PartialEq)]
pub struct Hypothesis {
    /// What it explains, ascending: lines of the page that it was read from, or in the end strokes by their places.
    pub uses: Vec<usize>,
    /// Log-odds against leaving these strokes to the classifier; below 0 it is never taken.
    pub score: f32,
    /// What the strokes become; none where they are not the plant.
    pub parts: Vec<Made>,
    /// Bodies of revolution that they become.
    pub solids: Vec<Solid>,
    /// What the strokes were read as, for the artist.
    pub reading: Reading,
    /// What kind of plant it speaks for.
    pub habit: Option<Habit>,
}

impl Hypothesis {
    /// Lines that are no part of the plant.
    pub(super) fn apart(uses: Vec<usize>, score: f32, reading: Reading) -> Self {
        Self { uses, score, parts: Vec::new(), solids: Vec::new(), reading, habit: None }
    }
}
