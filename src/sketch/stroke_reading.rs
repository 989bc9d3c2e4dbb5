//! What strokes were read as that do not say it themselves, each listed once: as code, files and remarks name it.

use std::fmt;

macro_rules! readings {
    ($($(#[$doc:meta])* $reading:ident = $name:literal, $remark:literal;)*) => {
        /// What several strokes, or one that is several parts, were read as.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Reading {
            $($(#[$doc])* $reading,)*
        }

        impl Reading {
            /// Every reading, in the order of this list.
            pub const ALL: [Reading; [$($name),*].len()] = [$(Self::$reading),*];

            /// The name used in files.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$reading => $name,)*
                }
            }
        }

        impl fmt::Display for Reading {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(match self {
                    $(Self::$reading => $remark,)*
                })
            }
        }
    };
}

readings! {
    /// A trunk with a crown.
    Tree = "tree", "is read as a trunk and its crown";
    /// A trunk with boughs and twigs, without leaves.
    BareTree = "bare_tree", "is read as a bare tree";
    /// A crown without a trunk.
    Bush = "bush", "is read as a bush";
    /// A cactus.
    Cactus = "cactus", "is read as the outline of a cactus";
    /// A mushroom.
    Mushroom = "mushroom", "is read as a mushroom";
    /// A corolla with its petals.
    Corolla = "corolla", "is read as a corolla, cut into its petals";
    /// A leaf with its veins.
    Leaf = "leaf", "is read as a leaf with its midrib, veins and stalk";
    /// Blades of grass.
    Grass = "grass", "is read as blades of grass";
    /// Fronds of a palm.
    Fronds = "fronds", "is read as fronds";
    /// Fruits on their stalks.
    Fruit = "fruit", "is read as fruits on their stalks";
    /// A pot.
    Pot = "pot", "is read as the pot in which the plant stands";
    /// The ground.
    Ground = "ground", "is read as the ground and is no part of the plant";
    /// The sun.
    Sun = "sun", "is read as the sun and is no part of the plant";
    /// A window, a frame, a fence or a jar.
    Frame = "frame", "is read as a window, a frame, a fence or a jar and is no part of the plant";
    /// What hangs in the air beside plants.
    Sky = "sky", "hangs in the air and is no part of the plant";
    /// Letters.
    Writing = "writing", "is read as writing and is no part of the plant";
    /// Strokes over one another.
    Line = "line", "is read as one line, drawn again or by its two sides";
}
