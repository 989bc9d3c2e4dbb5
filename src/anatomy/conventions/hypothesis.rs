//! A reading of some strokes: which, how likely, and what becomes of them.

use crate::sketch::{Reading, StrokePoint, Tool};

/// What kind of plant a drawing shows, as far as that can be seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Habit {
    /// A trunk with a crown.
    Tree,
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
    pub fn new(tool: Tool, points: impl IntoIterator<Item = glam::Vec2>) -> Self {
        Self { tool, points: points.into_iter().map(StrokePoint::at).collect(), half_width: None }
    }
}

/// A reading of some strokes.
#[derive(Clone, Debug, PartialEq)]
pub struct Hypothesis {
    /// Which lines of the page it explains, ascending.
    pub uses: Vec<usize>,
    /// Log-odds against leaving these strokes to the classifier; below 0 it is never taken.
    pub score: f32,
    /// What the strokes become; none where they are not the plant.
    pub parts: Vec<Made>,
    /// What the strokes were read as, for the artist.
    pub reading: Reading,
    /// What kind of plant it speaks for.
    pub habit: Option<Habit>,
}
