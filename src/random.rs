//! Random streams named by what they decide.
//!
//! A stream depends on the seed, a purpose and a stable key, never on a running index: one more stroke in a drawing
//! leaves every other choice as it was. Keys are mixed by the finaliser of SplitMix64 (Steele, Lea, Flood 2014).

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

#[cfg(test)]
mod tests {
    use super::*;
    use rand::RngExt;

    #[test]
    fn seed_purpose_and_key_all_matter() {
        let first = |seed, purpose, key| stream(seed, purpose, key).random::<u64>();
        assert_eq!(first(1, "leaf", 2), first(1, "leaf", 2));
        let others = [first(2, "leaf", 1), first(1, "twig", 2), first(1, "leaf", 3), first(3, "leaf", 2)];
        assert!(others.iter().all(|&other| other != first(1, "leaf", 2)));
    }
}
