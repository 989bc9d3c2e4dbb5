//! Petals that are being shaped, as the panel over the plant shows them.

use glam::Vec3;

/// How petals are being shaped.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PetalState {
    /// Whether the plant has petals that can be shaped.
    pub any: bool,
    /// Whether the tool is in hand.
    pub on: bool,
    /// Whether left and right of a petal are moved alike.
    pub mirrored: bool,
    /// Whether a petal is chosen.
    pub chosen: bool,
    /// Whether the petals of its flower are shaped.
    pub shaped: bool,
    /// The control point that was touched last.
    pub point: Option<PetalPoint>,
}

/// A control point of a petal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PetalPoint {
    /// Its row from the base, 0 to 3.
    pub row: usize,
    /// Its place in the row from the left, 0 to 3.
    pub column: usize,
    /// How far it is moved across, along and toward the face, shares of the petal's length.
    pub offset: Vec3,
}
