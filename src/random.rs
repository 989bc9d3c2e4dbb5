//! Random streams named by what they decide.
//!
//! A stream depends on the seed, a purpose and a stable key, never on a running index: one more stroke in a drawing
//! leaves every other choice as it was. Keys are mixed by the finaliser of SplitMix64 (Steele, Lea, Flood 2014).
//!
//! [`stream`] gives a generator for many numbers; a [`Choice`] is a single number, or three, made straight from a key.

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

/// The stream for one choice: `purpose` tells kinds of choices apart, `key` the things they are made for.
pub fn stream(seed: u64, purpose: &str, key: u64) -> Pcg64Mcg {
    let purpose = purpose.bytes().fold(0, |hash, byte| mix(hash, u64::from(byte)));
    Pcg64Mcg::seed_from_u64(mix(mix(seed, purpose), key))
}

/// The name of a thing that is number or part `name` of the thing called `of`.
pub fn mix(of: u64, name: u64) -> u64 {
    let mut z = of.wrapping_mul(0xd134_2543_de82_ef95).wrapping_add(name).wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// A number from 0 to 1 out of a hash, 1 left out.
pub fn unit(hash: u64) -> f32 {
    (hash >> 40) as f32 / (1u64 << 24) as f32
}

/// One thing that is decided at random about something that grows. Choices about the same thing have different numbers;
/// those of one that decides three numbers are its own and the two after it. The numbers are part of what every plant
/// looks like: changed, they change all of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice(u64);

/// About a plant.
impl Choice {
    /// Where and how each of its stems stands.
    pub const STEM: Self = Self(41);
    /// The direction in which the first of its stems stands.
    pub const FIRST_STEM: Self = Self(42);
    /// To which side the first bud of a trunk points that leads up to a crown.
    pub const TRUNK: Self = Self(43);
    /// What grows on each of its drawn branches.
    pub const DRAWN_BRANCH: Self = Self(44);
    /// What grows in each of its brush strokes, by the stroke's name.
    pub const BRUSH: Self = Self(46);
    /// What becomes of each of its buds.
    pub const BUD: Self = Self(45);
    /// Each of its leaves, by the node that it stands on.
    pub const LEAF: Self = Self(61);
    /// Each of its flower buds.
    pub const FLOWER_BUD: Self = Self(67);
}

/// Nothing at random, but what grows is named the same way.
impl Choice {
    /// A foot of a plant, by its number.
    pub const NAME_OF_FOOT: Self = Self(71);
    /// A drawn branch, by its stroke.
    pub const NAME_OF_STROKE: Self = Self(72);
    /// Another part than the first that a stroke drew.
    pub const NAME_OF_PART: Self = Self(73);
    /// A drawn flower, by the first of its petals.
    pub const NAME_OF_FLOWER: Self = Self(74);
    /// A leaf, by its node.
    pub const NAME_OF_LEAF: Self = Self(75);
    /// A flower bud, by its node.
    pub const NAME_OF_BUD: Self = Self(76);
    /// A fruit, by the leaf beside it.
    pub const NAME_OF_FRUIT: Self = Self(77);
}

/// About a stem.
impl Choice {
    /// How far it leans.
    pub const STEM_LEAN: Self = Self(1);
}

/// About a bud or an internode in its year.
impl Choice {
    /// Whether it flowers.
    pub const FLOWERS: Self = Self(11);
    /// By how much its direction is another, along three axes.
    pub const WANDER: Self = Self(21);
    /// To which side the first bud of its shoot points.
    pub const FIRST_SIDE: Self = Self(31);
    /// Whether there are lateral buds.
    pub const RAMIFIES: Self = Self(51);
    /// The angle of the lateral buds.
    pub const BRANCHING_ANGLE: Self = Self(52);
}

/// About the fruits beside a leaf, and about each of them.
impl Choice {
    /// Whether there are any.
    pub const FRUITS: Self = Self(81);
    /// How early it ripens and falls.
    pub const FRUIT_EARLY: Self = Self(82);
    /// Its size.
    pub const FRUIT_SIZE: Self = Self(83);
    /// How far out along its shoot it hangs.
    pub const FRUIT_ALONG: Self = Self(84);
}

/// About a leaf.
impl Choice {
    /// Its place around the shoot.
    pub const LEAF_AROUND: Self = Self(1);
    /// Its direction, along three axes.
    pub const LEAF_DIRECTION: Self = Self(2);
    /// Where its face looks, along three axes.
    pub const LEAF_FACE: Self = Self(5);
    /// Its length.
    pub const LEAF_LENGTH: Self = Self(8);
    /// Which outline it has.
    pub const LEAF_OUTLINE: Self = Self(9);
}

/// About a module of a grammar.
impl Choice {
    /// Which of its rule's alternatives replaces it.
    pub const ALTERNATIVE: Self = Self(1);
    /// The stream of numbers in conditions and weights of its rules.
    pub const RULE_CONDITION: Self = Self(2);
    /// The stream of numbers in its parameters.
    pub const MODULE_PARAMETERS: Self = Self(3);
}

/// About a flower, a spot or a crown.
impl Choice {
    /// Its place in its cluster or beside the middle of its voxel, along three axes.
    pub const ASIDE: Self = Self(1);
    /// The phases of the three waves in which a crown is uneven.
    pub const LUMPS: Self = Self(0);
}

/// About a garden's lattice of tiles.
impl Choice {
    /// The colour of each corner, by its place.
    pub const CORNER_COLOUR: Self = Self(1);
    /// Each spot for a plant, by its tile and number.
    pub const SPOT: Self = Self(2);
    /// The lattice of plants that need more or less room than others.
    pub const LAYER: Self = Self(3);
}

/// About a spot for a plant in a garden.
impl Choice {
    /// What grows there.
    pub const PLANT: Self = Self(1);
    /// Which of its variants.
    pub const VARIANT: Self = Self(2);
    /// How it is turned.
    pub const TURN: Self = Self(3);
    /// How large it is.
    pub const SIZE: Self = Self(4);
    /// How far it leans.
    pub const LEAN: Self = Self(5);
    /// To which side it leans.
    pub const LEAN_SIDE: Self = Self(6);
}

impl Choice {
    /// The key of this choice about the thing of a key.
    pub fn key(self, of: u64) -> u64 {
        mix(of, self.0)
    }

    /// A number from 0 to 1, 1 left out.
    pub fn unit(self, of: u64) -> f32 {
        unit(self.key(of))
    }

    /// A number from -1 to 1, 1 left out.
    pub fn signed(self, of: u64) -> f32 {
        2.0 * self.unit(of) - 1.0
    }

    /// Three numbers, each from 0 to 1, 1 left out.
    pub fn units(self, of: u64) -> [f32; 3] {
        [0, 1, 2].map(|k| Self(self.0 + k).unit(of))
    }

    /// Three numbers, each from -1 to 1, 1 left out.
    pub fn signs(self, of: u64) -> [f32; 3] {
        self.units(of).map(|unit| 2.0 * unit - 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::RngExt;

    #[test]
    fn choices_about_one_thing_differ_and_stay_in_range() {
        let three = Choice::WANDER.signs(7);
        assert_eq!(three, [21, 22, 23].map(|k| 2.0 * unit(mix(7, k)) - 1.0));
        assert!(three[0] != three[1] && three[1] != three[2]);
        for of in 0..1000 {
            assert!((0.0..1.0).contains(&Choice::FLOWERS.unit(of)));
            assert!((-1.0..1.0).contains(&Choice::LEAF_LENGTH.signed(of)));
        }
    }

    #[test]
    fn seed_purpose_and_key_all_matter() {
        let first = |seed, purpose, key| stream(seed, purpose, key).random::<u64>();
        assert_eq!(first(1, "leaf", 2), first(1, "leaf", 2));
        let others = [first(2, "leaf", 1), first(1, "twig", 2), first(1, "leaf", 3), first(3, "leaf", 2)];
        assert!(others.iter().all(|&other| other != first(1, "leaf", 2)));
    }
}
