//! Finding the plant on the picture under the drawing: what the pen marks, and what the panel shows of it.

use crate::sketch::StrokeId;

/// What a line of the pen says of the picture under it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PlantMark {
    /// It runs on the plant.
    #[default]
    Plant,
    /// It runs on what is around the plant.
    Around,
    /// The plant is nowhere but within it.
    Outline,
}

/// How the plant is being sought.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlantSearchState {
    /// Whether the pen marks the picture.
    pub on: bool,
    /// What its lines say.
    pub mark: PlantMark,
    /// Whether anything is marked.
    pub any_marks: bool,
    /// Whether it is being sought right now.
    pub is_searching: bool,
    /// The branch that can be moved onto the edges of a trunk.
    pub branch: Option<StrokeId>,
    /// Share of the picture that the plant has which was found, percent.
    pub share: Option<f32>,
}
