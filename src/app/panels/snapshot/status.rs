//! What the status line and the legend say.

/// What the status line says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Status {
    /// Strokes of the drawing.
    pub strokes: usize,
    /// Flowers of the plant.
    pub flowers: usize,
    /// Vertices of the model.
    pub vertices: usize,
    /// Triangles of the model.
    pub triangles: usize,
    /// How long the last build took; `None` before the first.
    pub build_ms: Option<f32>,
    /// Whether a build is on its way.
    pub building: bool,
    /// What the plant lacks of what was drawn for it last, and why.
    pub shortfall: Option<String>,
    /// What was used last to draw.
    pub pen: PenUsed,
    /// Whether the drawing is safe.
    pub autosave: Autosave,
}

/// What was used last to draw.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum PenUsed {
    /// A mouse.
    #[default]
    Mouse,
    /// A finger.
    Touch,
    /// A pen, by its name where it is known.
    Pen(Option<String>),
}

/// Whether the drawing is safe.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Autosave {
    /// All in its file.
    #[default]
    Saved,
    /// Changes since the last saving are in the journal.
    Journaled,
    /// The drawing is being written into its file.
    Saving,
    /// The journal is being written.
    Writing,
    /// The disk is slow: so many changes would not survive a power cut yet.
    Behind(u64),
    /// The journal cannot be written.
    Failed,
}

/// Parts that the analysis found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Found {
    /// Petals.
    pub petals: bool,
    /// Leaves.
    pub leaves: bool,
    /// Number of levels of branches.
    pub branch_levels: u32,
    /// Branch outlines.
    pub branch_outlines: bool,
    /// Leaf outlines.
    pub leaf_outlines: bool,
    /// Crowns.
    pub crowns: bool,
    /// Pots.
    pub pots: bool,
    /// The ground.
    pub ground: bool,
    /// Strokes that were not used.
    pub ignored: bool,
}

/// A task that takes long.
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// What is being written.
    pub name: String,
    /// 0 to 1.
    pub progress: f32,
}
