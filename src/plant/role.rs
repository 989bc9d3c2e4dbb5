//! What branches and organs are: the role for which a species has a material.
//!
//! Whoever makes a plant says what each branch and organ is; the species says what such things are made of, once for
//! each role ([`FinishedPlant`](super::FinishedPlant)). So a plant needs no materials before it has a species.

use super::OrganKind;
use crate::suggest::nearest;

macro_rules! plant_parts {
    ($($(#[doc = $about:literal])+ $part:ident = $name:literal, $kind:expr;)*) => {
        /// A part of a plant, as an artist names it.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum PlantPart { $($(#[doc = $about])+ $part,)* }

        impl PlantPart {
            /// Every part.
            pub const ALL: &'static [Self] = &[$(Self::$part),*];

            /// The part's name on the command line and in messages.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$part => $name),* }
            }

            /// The kind of organ that it belongs to, none for branches.
            pub const fn kind(self) -> Option<OrganKind> {
                match self { $(Self::$part => $kind),* }
            }
        }
    };
}

plant_parts! {
    /// Petals of all flowers.
    Petal = "petal", Some(OrganKind::Petal);
    /// Leaves.
    Leaf = "leaf", Some(OrganKind::Leaf);
    /// Stem, trunk and branches.
    Stem = "stem", None;
    /// Young, thin branches.
    Twig = "twig", None;
    /// Green blades behind the petals.
    Sepal = "sepal", Some(OrganKind::Sepal);
    /// What carries the petals from behind: calyx cup or flower tube.
    Cup = "cup", Some(OrganKind::Receptacle);
    /// Middle of the flower, which carries stamens and styles.
    Disc = "disc", Some(OrganKind::Receptacle);
    /// Filaments of the stamens.
    Stamen = "stamen", Some(OrganKind::Stamen);
    /// Heads of the stamens.
    Anther = "anther", Some(OrganKind::Stamen);
    /// Styles.
    Pistil = "pistil", Some(OrganKind::Pistil);
    /// Heads of the styles.
    Stigma = "stigma", Some(OrganKind::Pistil);
    /// Fruits.
    Fruit = "fruit", Some(OrganKind::Fruit);
    /// Thorns.
    Thorn = "thorn", Some(OrganKind::Thorn);
    /// Pot.
    Pot = "pot", Some(OrganKind::Pot);
    /// Earth in the pot.
    Soil = "soil", Some(OrganKind::Pot);
}

impl PlantPart {
    /// The part of that name, or the name that looks most like it.
    ///
    /// # Errors
    /// The nearest name, if any is near.
    pub fn from_name(name: &str) -> Result<Self, Option<&'static str>> {
        let found = Self::ALL.iter().find(|part| part.name() == name);
        found.copied().ok_or_else(|| nearest(name, Self::ALL.iter().map(|part| part.name())))
    }
}

/// What a branch or an organ is, as far as materials tell things apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Role {
    /// The part of the plant.
    pub part: PlantPart,
    /// Which of the species' flowers it belongs to, 0 outside of flowers.
    pub look: u32,
    /// Which of several materials of the part: those of leaves and petals, groups of stamens and styles.
    pub variant: u32,
}

impl Role {
    /// The first of several that the part has.
    pub const fn of(part: PlantPart) -> Self {
        Self { part, look: 0, variant: 0 }
    }

    /// The role of the swollen end of a filament with this role; its own for anything else.
    #[must_use]
    pub const fn of_head(self) -> Self {
        let part = match self.part {
            PlantPart::Stamen => PlantPart::Anther,
            PlantPart::Pistil => PlantPart::Stigma,
            part => part,
        };
        Self { part, ..self }
    }
}
