//! The kinds of organs: one table of what every part of the program needs to know about them.
//!
//! A new kind is one row here. Its name is used by files, the command line and the names of parts; its class by the
//! choices of an export; its colour by the debugging view.

use serde::{Deserialize, Serialize};

/// Which organs are chosen together, for instance when a plant is exported without its flowers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OrganClass {
    /// Leaves.
    Foliage,
    /// All parts of flowers.
    Flower,
    /// Fruits, thorns and pots.
    Extra,
}

/// What the surface of an organ encloses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OrganForm {
    /// A thin sheet inside an outline.
    Blade,
    /// A body: dome, filament or solid of revolution.
    Solid,
}

/// What is known of a kind of organ.
struct Row {
    name: &'static str,
    plural: &'static str,
    /// Plural of the swollen ends of its filaments.
    heads: &'static str,
    class: OrganClass,
    form: OrganForm,
    /// Encoded red, green, blue.
    tint: [u8; 3],
}

macro_rules! organ_kinds {
    ($($(#[doc = $about:literal])+
        $kind:ident = $name:literal, $plural:literal, $heads:literal, $class:ident, $form:ident, $tint:expr;)*) => {
        /// What an organ is.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
        #[serde(rename_all = "snake_case")]
        pub enum OrganKind { $($(#[doc = $about])+ $kind,)* }

        impl OrganKind {
            /// Every kind, in the order of the table.
            pub const ALL: &'static [Self] = &[$(Self::$kind),*];

            const fn row(self) -> Row {
                use {OrganClass::*, OrganForm::*};
                match self {
                    $(Self::$kind => Row {
                        name: $name, plural: $plural, heads: $heads, class: $class, form: $form, tint: $tint,
                    },)*
                }
            }
        }
    };
}

organ_kinds! {
    /// Green blade on a branch.
    Leaf = "leaf", "leaves", "leaf_heads", Foliage, Blade, [92, 172, 72];
    /// Stalk of a leaf, and the rachis that carries its leaflets.
    Petiole = "petiole", "petioles", "petiole_heads", Foliage, Solid, [120, 150, 70];
    /// Coloured blade of a flower.
    Petal = "petal", "petals", "petal_heads", Flower, Blade, [226, 104, 150];
    /// Green blade behind the petals.
    Sepal = "sepal", "sepals", "sepal_heads", Flower, Blade, [40, 140, 116];
    /// Swollen end of the stem that carries the flower's parts; the disc of a daisy.
    Receptacle = "receptacle", "receptacles", "receptacle_heads", Flower, Solid, [240, 190, 40];
    /// Filament with its anther.
    Stamen = "stamen", "stamens", "anthers", Flower, Solid, [250, 150, 30];
    /// Style with its stigma.
    Pistil = "pistil", "pistils", "stigmas", Flower, Solid, [150, 110, 220];
    /// What a flower becomes.
    Fruit = "fruit", "fruits", "fruit_heads", Extra, Solid, [214, 60, 50];
    /// Spike on the bark.
    Thorn = "thorn", "thorns", "thorn_heads", Extra, Solid, [90, 90, 100];
    /// What the plant stands in.
    Pot = "pot", "pots", "pot_heads", Extra, Solid, [176, 108, 84];
}

impl OrganKind {
    /// The kind's name in files and in names of parts.
    pub const fn name(self) -> &'static str {
        self.row().name
    }

    /// The name of several of them.
    pub const fn plural(self) -> &'static str {
        self.row().plural
    }

    /// The name of the swollen ends of several of them, where they are filaments.
    pub const fn heads(self) -> &'static str {
        self.row().heads
    }

    /// Which organs it is chosen together with.
    pub const fn class(self) -> OrganClass {
        self.row().class
    }

    /// Whether it is a thin sheet or a body.
    pub const fn form(self) -> OrganForm {
        self.row().form
    }

    /// Its colour in debugging views: encoded red, green, blue.
    pub const fn tint(self) -> [u8; 3] {
        self.row().tint
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn names_are_those_of_files_and_all_different() {
        let names = |of: fn(OrganKind) -> &'static str| OrganKind::ALL.iter().map(move |kind| of(*kind));
        for kind in OrganKind::ALL {
            assert_eq!(serde_json::to_value(kind).unwrap(), kind.name());
        }
        let all: Vec<_> =
            names(OrganKind::name).chain(names(OrganKind::plural)).chain(names(OrganKind::heads)).collect();
        assert_eq!(all.iter().collect::<BTreeSet<_>>().len(), all.len());
    }
}
