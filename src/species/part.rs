//! The parts of a plant that can be given a picture of their own.

use crate::suggest::nearest;

macro_rules! parts {
    ($($(#[doc = $about:literal])+ $part:ident = $name:literal,)*) => {
        /// A part of a plant, as an artist names it.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Part { $($(#[doc = $about])+ $part,)* }

        impl Part {
            /// Every part.
            pub const ALL: &'static [Part] = &[$(Part::$part),*];

            /// The part's name on the command line and in messages.
            pub fn name(self) -> &'static str {
                match self { $(Part::$part => $name),* }
            }
        }
    };
}

parts! {
    /// Petals of all flowers.
    Petal = "petal",
    /// Leaves.
    Leaf = "leaf",
    /// Stem, trunk and branches.
    Stem = "stem",
    /// Young, thin branches.
    Twig = "twig",
    /// Green blades behind the petals.
    Sepal = "sepal",
    /// What carries the petals from behind: calyx cup or flower tube.
    Cup = "cup",
    /// Heart of the flower.
    Disc = "disc",
    /// Threads of the stamens.
    Stamen = "stamen",
    /// Heads of the stamens.
    Anther = "anther",
    /// Styles.
    Pistil = "pistil",
    /// Heads of the styles.
    Stigma = "stigma",
    /// Thorns.
    Thorn = "thorn",
    /// Pot.
    Pot = "pot",
    /// Earth in the pot.
    Soil = "soil",
}

impl Part {
    /// The part of that name, or the name that looks most like it.
    ///
    /// # Errors
    /// The nearest name, if any is near.
    pub fn from_name(name: &str) -> Result<Self, Option<&'static str>> {
        let found = Self::ALL.iter().find(|part| part.name() == name);
        found.copied().ok_or_else(|| nearest(name, Self::ALL.iter().map(|part| part.name())))
    }
}
