//! What strokes were read as that do not say it themselves, for the artist.

use std::fmt;

/// What several strokes, or one that is several parts, were read as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reading {
    /// A trunk with a crown.
    Tree,
    /// A crown without a trunk.
    Bush,
    /// A cactus.
    Cactus,
    /// A mushroom.
    Mushroom,
    /// A corolla with its petals.
    Corolla,
    /// A leaf with its veins.
    Leaf,
    /// Blades of grass.
    Grass,
    /// Fronds of a palm.
    Fronds,
    /// A pot.
    Pot,
    /// The ground.
    Ground,
}

impl Reading {
    /// Every reading, in the order of this list.
    pub const ALL: [Reading; 10] = [
        Self::Tree,
        Self::Bush,
        Self::Cactus,
        Self::Mushroom,
        Self::Corolla,
        Self::Leaf,
        Self::Grass,
        Self::Fronds,
        Self::Pot,
        Self::Ground,
    ];
}

impl fmt::Display for Reading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Tree => "is read as a trunk and its crown",
            Self::Bush => "is read as a bush",
            Self::Cactus => "is read as the outline of a cactus",
            Self::Mushroom => "is read as a mushroom",
            Self::Corolla => "is read as a corolla, cut into its petals",
            Self::Leaf => "is read as a leaf with its midrib, veins and stalk",
            Self::Grass => "is read as blades of grass",
            Self::Fronds => "is read as fronds",
            Self::Pot => "is read as the pot in which the plant stands",
            Self::Ground => "is read as the ground and is no part of the plant",
        })
    }
}
