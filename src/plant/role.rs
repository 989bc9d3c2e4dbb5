//! What branches and organs are: the role for which a species has a material.
//!
//! Whoever makes a plant says what each branch and organ is; the species says what such things are made of, once for
//! each role ([`FinishedPlant`](super::FinishedPlant)). So a plant needs no materials before it has a species.
//! Branches and organs have roles of different types, so that neither can have one of the other's.

use super::OrganKind;
use crate::suggest::nearest;

macro_rules! parts {
    ($(#[doc = $of:literal])+ $Part:ident: $($(#[doc = $about:literal])+ $part:ident = $name:literal;)*) => {
        $(#[doc = $of])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum $Part { $($(#[doc = $about])+ $part,)* }

        impl $Part {
            /// Every one.
            pub const ALL: &'static [Self] = &[$(Self::$part),*];

            /// The name on the command line and in messages.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$part => $name),* }
            }
        }
    };
}

parts! {
    /// What a branch may be.
    WoodPart:
    /// Stem, trunk and branches.
    Stem = "stem";
    /// Young, thin branches.
    Twig = "twig";
}

parts! {
    /// What an organ, or a piece of one, may be.
    OrganPart:
    /// Petals of all flowers.
    Petal = "petal";
    /// Leaves.
    Leaf = "leaf";
    /// Stalks of leaves and what carries their leaflets.
    Petiole = "petiole";
    /// Green blades behind the petals.
    Sepal = "sepal";
    /// What carries the petals from behind: calyx cup or flower tube.
    Cup = "cup";
    /// Middle of the flower, which carries stamens and styles.
    Disc = "disc";
    /// Filaments of the stamens.
    Stamen = "stamen";
    /// Heads of the stamens.
    Anther = "anther";
    /// Styles.
    Pistil = "pistil";
    /// Heads of the styles.
    Stigma = "stigma";
    /// Fruits.
    Fruit = "fruit";
    /// Stalks of fruits that nobody drew.
    FruitStalk = "fruit_stalk";
    /// Thorns.
    Thorn = "thorn";
    /// Pot.
    Pot = "pot";
    /// Earth in the pot.
    Soil = "soil";
}

impl OrganPart {
    /// The kind of organ that it belongs to.
    pub const fn kind(self) -> OrganKind {
        match self {
            Self::Petal => OrganKind::Petal,
            Self::Leaf => OrganKind::Leaf,
            Self::Petiole => OrganKind::Petiole,
            Self::Sepal => OrganKind::Sepal,
            Self::Cup | Self::Disc => OrganKind::Receptacle,
            Self::Stamen | Self::Anther => OrganKind::Stamen,
            Self::Pistil | Self::Stigma => OrganKind::Pistil,
            Self::Fruit | Self::FruitStalk => OrganKind::Fruit,
            Self::Thorn => OrganKind::Thorn,
            Self::Pot | Self::Soil => OrganKind::Pot,
        }
    }
}

/// A part of a plant, as an artist names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PlantPart {
    /// Of branches.
    Wood(WoodPart),
    /// Of organs.
    Organ(OrganPart),
}

impl From<WoodPart> for PlantPart {
    fn from(part: WoodPart) -> Self {
        Self::Wood(part)
    }
}

impl From<OrganPart> for PlantPart {
    fn from(part: OrganPart) -> Self {
        Self::Organ(part)
    }
}

impl PlantPart {
    /// Every part: those of organs, then those of branches.
    pub fn all() -> impl Iterator<Item = Self> {
        let wood = WoodPart::ALL.iter().copied().map(Self::Wood);
        OrganPart::ALL.iter().copied().map(Self::Organ).chain(wood)
    }

    /// The part's name on the command line and in messages.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Wood(part) => part.name(),
            Self::Organ(part) => part.name(),
        }
    }

    /// The kind of organ that it belongs to, none for branches.
    pub const fn kind(self) -> Option<OrganKind> {
        match self {
            Self::Wood(_) => None,
            Self::Organ(part) => Some(part.kind()),
        }
    }

    /// The part of that name, or the name that looks most like it.
    ///
    /// # Errors
    /// The nearest name, if any is near.
    pub fn from_name(name: &str) -> Result<Self, Option<&'static str>> {
        let found = Self::all().find(|part| part.name() == name);
        found.ok_or_else(|| nearest(name, Self::all().map(Self::name)))
    }
}

/// What something of a plant is, as far as materials tell things apart. A branch has a role among the [`WoodPart`]s, an
/// organ one among the [`OrganPart`]s; without a word about that it is a role of either.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Role<Part = PlantPart> {
    /// The part of the plant.
    pub part: Part,
    /// Which of the species' flowers it belongs to, 0 outside of flowers.
    pub look: u32,
    /// Which of several materials of the part: those of leaves and petals, groups of stamens and styles.
    pub variant: u32,
}

impl<Part> Role<Part> {
    /// The first of several that the part has.
    pub const fn of(part: Part) -> Self {
        Self { part, look: 0, variant: 0 }
    }
}

impl From<Role<WoodPart>> for Role {
    fn from(Role { part, look, variant }: Role<WoodPart>) -> Self {
        Self { part: part.into(), look, variant }
    }
}

impl From<Role<OrganPart>> for Role {
    fn from(Role { part, look, variant }: Role<OrganPart>) -> Self {
        Self { part: part.into(), look, variant }
    }
}

impl Role<OrganPart> {
    /// The role of the swollen end of a filament with this role; its own for anything else.
    #[must_use]
    pub const fn of_head(self) -> Self {
        let part = match self.part {
            OrganPart::Stamen => OrganPart::Anther,
            OrganPart::Pistil => OrganPart::Stigma,
            OrganPart::FruitStalk => OrganPart::Fruit,
            part => part,
        };
        Self { part, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn parts_are_found_by_their_names_which_all_differ() {
        for part in PlantPart::all() {
            assert_eq!(PlantPart::from_name(part.name()), Ok(part));
        }
        assert_eq!(
            PlantPart::all().map(PlantPart::name).collect::<BTreeSet<_>>().len(),
            PlantPart::all().count()
        );
        assert_eq!(PlantPart::from_name("stam"), Err(Some("stem")));
    }

    #[test]
    fn every_kind_of_organ_has_a_part() {
        for kind in OrganKind::ALL {
            assert!(OrganPart::ALL.iter().any(|part| part.kind() == *kind), "{kind:?}");
        }
    }
}
