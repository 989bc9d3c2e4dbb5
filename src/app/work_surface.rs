//! The surface that branches in space are drawn on, as the artist chooses it.

/// The surface that branches in space are drawn on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum WorkSurface {
    /// The plane through the beginning that faces the viewer.
    #[default]
    Facing,
    /// The level plane through the beginning.
    Level,
    /// The lines of sight of the branch drawn last, which is lifted.
    Lifted,
}
