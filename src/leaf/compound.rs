//! Compound leaves: leaflets in pairs along a rachis with one at its end, or all at the end of the stalk (004 §2, fig. 1 c).
//!
//! A compound leaf lies in one plane; leaflets of the right are mirror images of those of the left in the plane of the
//! rachis (004 eq. 8 prints a point reflection where a mirror is meant). Its leaflets are copies of one template. The fronds of ferns
//! are leaves whose many leaflets fill the outline of a lance.

use super::outline::LeafOutline;
use glam::{Quat, Vec3};
use serde::Deserialize;

crate::parameters! {
    /// A leaf of several leaflets.
    pub struct Compound {
        /// Distance of neighbouring pairs.
        pair_gap: f32 = 0.22, 0.02..=0.6, "of the leaf's length";
        /// Length of the stalk below the first pair.
        stalk: f32 = 0.2, 0.0..=0.8, "of the leaf's length";
        /// Length of the leaflet at the end.
        leaflet: f32 = 0.4, 0.02..=1.0, "of the leaf's length";
        /// Size of each pair against the one nearer to the tip.
        shrink: f32 = 0.88, 0.3..=1.2, "";
        /// How far leaflets follow the outline of a lance, longest at a third of the way: 0 for all but `shrink`, 1 for a
        /// frond. Those that are shorter stand closer together.
        lance: f32 = 0.0, 0.0..=1.0, "";
        /// Angle between lateral leaflets and the rachis.
        angle_deg: f32 = 58.0, 0.0..=120.0, "degrees";
        /// Whether a leaflet stands at the end.
        terminal: bool = true, 0..=1, "";
        /// Whether leaves that were drawn are divided as well, into leaflets that reach the drawn outline.
        drawn: bool = true, 0..=1, "";
        /// Whether all leaflets stand at the end of the stalk, as the fingers of a hand.
        palmate: bool = false, 0..=1, "";
        /// Radius of the rachis.
        rachis: f32 = 0.006, 0.001..=0.05, "of the leaf's length";
        /// How far the rachis hangs over.
        droop: f32 = 0.12, -0.5..=1.0, "of the leaf's length";
        /// Length of the stipules at the foot of the stalk; 0 for none.
        stipules: f32 = 0.0, 0.0..=0.5, "of the leaf's length";
        others:
        /// Numbers of leaflets that leaves have.
        leaflets: Vec<u32> = vec![5], read_leaflets;
        /// Shares of the leaves that have them; equal ones if left out.
        shares: Vec<f32> = Vec::new(), read_shares;
    }
}

/// The outline that the leaflets of a frond fill; its half width is 1 where it is widest.
const LANCE: LeafOutline =
    LeafOutline { width: 2.0, widest: 0.35, wedge: 0.1, point: 0.25, teeth: 0, tooth_depth: 0.0 };
/// Most leaflets of one leaf.
const MOST_LEAFLETS: u32 = 60;
/// Leaflets with which a leaf still shows what it is.
const FEWEST_LEAFLETS: u32 = 5;

fn read_leaflets<'de, D: serde::Deserializer<'de>>(source: D) -> Result<Vec<u32>, D::Error> {
    let list = Vec::<u32>::deserialize(source)?;
    if list.is_empty() || list.iter().any(|count| !(1..=MOST_LEAFLETS).contains(count)) {
        let what = format!("`leaflets`: write numbers from 1 to {MOST_LEAFLETS}, as [3, 5, 7]");
        return Err(serde::de::Error::custom(what));
    }
    Ok(list)
}

fn read_shares<'de, D: serde::Deserializer<'de>>(source: D) -> Result<Vec<f32>, D::Error> {
    let list = Vec::<f32>::deserialize(source)?;
    let is_share = |share: &f32| share.is_finite() && *share >= 0.0;
    if !list.iter().all(is_share) || (!list.is_empty() && list.iter().sum::<f32>() <= 0.0) {
        return Err(serde::de::Error::custom("`shares`: write numbers from 0 on, not all of them 0"));
    }
    Ok(list)
}

/// Where a leaf stands before it is divided: foot, vector across and along of unit length, its own length in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeafPose {
    /// The foot of its stalk, metres.
    pub base: Vec3,
    /// Unit vector to the right on its face.
    pub u: Vec3,
    /// Unit vector toward its tip.
    pub v: Vec3,
    /// Its length, metres.
    pub length: f32,
}

/// A leaflet or stipule: a copy of a template of length 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leaflet {
    /// Its foot, metres.
    pub base: Vec3,
    /// Vectors across and along, as long as the leaflet, metres.
    pub u: Vec3,
    /// The same along.
    pub v: Vec3,
}

/// What a compound leaf consists of.
#[derive(Clone, Debug, PartialEq)]
pub struct CompoundLeaf {
    /// Stalk and rachis, foot first, metres.
    pub rachis: Vec<Vec3>,
    /// Radius of the rachis, metres.
    pub radius: f32,
    /// Leaflets: right and left in turn from the foot, the one at the end last.
    pub leaflets: Vec<Leaflet>,
    /// Two at the foot of the stalk, or none.
    pub stipules: Vec<Leaflet>,
}

/// A pair of leaflets among all.
struct PairShare {
    /// Its size, 1 for the largest.
    size: f32,
    /// Its distance from the first, in mean distances of pairs.
    place: f32,
}

impl Compound {
    /// How many leaflets a leaf has in the mean.
    pub fn mean_count(&self) -> f32 {
        const SAMPLES: u32 = 32;
        let counts = (0..SAMPLES).map(|k| self.count((k as f32 + 0.5) / SAMPLES as f32));
        counts.sum::<u32>() as f32 / SAMPLES as f32
    }

    /// A leaf like this with about so many of its leaflets, but not fewer than five: they are larger and farther
    /// apart, so that they cover what all do.
    #[must_use]
    pub fn with_fewer(&self, share: f32) -> Self {
        let fewer = |count: &u32| {
            let pairs = (*count as f32 * share / 2.0).round() as u32;
            let least = FEWEST_LEAFLETS.min(*count);
            (2 * pairs + count % 2).clamp(least + (count + least) % 2, *count)
        };
        let less = Self { leaflets: self.leaflets.iter().map(fewer).collect(), ..self.clone() };
        let apart = self.mean_count() / less.mean_count();
        let (pair_gap, leaflet) = (self.pair_gap * apart, self.leaflet * apart.sqrt());
        Self { pair_gap, leaflet, ..less }
    }

    /// The number of leaflets of a leaf; `chance` is uniform from 0 to 1.
    pub fn count(&self, chance: f32) -> u32 {
        let share =
            |k: usize| if self.shares.is_empty() { 1.0 } else { self.shares.get(k).copied().unwrap_or(0.0) };
        let whole: f32 = (0..self.leaflets.len()).map(share).sum();
        let mut left = chance * whole;
        for (k, count) in self.leaflets.iter().enumerate() {
            left -= share(k);
            if left < 0.0 {
                return *count;
            }
        }
        self.leaflets[self.leaflets.len() - 1]
    }

    /// How large pairs of leaflets are and where they stand, as a lance has it.
    fn shares_of_lance(&self, pairs: u32) -> Vec<PairShare> {
        let size = |pair: u32| {
            let share = LANCE.half_width((pair as f32 + 0.5) / pairs as f32);
            1.0 - self.lance + self.lance * share
        };
        let sizes: Vec<f32> = (0..pairs).map(size).collect();
        // The pairs reach as far as equal ones do.
        let mean = sizes.iter().sum::<f32>() / pairs.max(1) as f32;
        let mut place = 0.0;
        let share = |size: f32| {
            let here = PairShare { size, place };
            place += size / mean;
            here
        };
        sizes.into_iter().map(share).collect()
    }

    /// The parts of a leaf with so many leaflets.
    pub fn leaf(&self, pose: &LeafPose, count: u32) -> CompoundLeaf {
        let pairs =
            if self.terminal { count.saturating_sub(1) / 2 } else { count / 2 }.max(u32::from(count == 1));
        let pairs = if count == 1 { 0 } else { pairs };
        let along =
            if self.palmate { 0.0 } else { self.pair_gap * (pairs.max(1) - 1) as f32 + 0.6 * self.pair_gap };
        // A leaf of many pairs is no longer than one of few: its parts are closer together.
        let whole = self.stalk + along + self.leaflet;
        let unit = pose.length / whole.max(1.0);
        let (stalk, along) = (self.stalk * unit, along * unit);
        let face = pose.u.cross(pose.v);
        let droop = self.droop * pose.length;
        let reach = (stalk + along).max(1e-6);
        let at =
            |s: f32| pose.base + pose.v * s - face * (droop * (s / reach).powi(2) * (reach / pose.length));
        let toward =
            |s: f32| (pose.v - face * (2.0 * droop * s / (reach * pose.length))).normalize_or(pose.v);
        let shares = self.shares_of_lance(pairs);
        let size = |pair: u32| {
            self.leaflet * unit * self.shrink.powi((pairs - pair) as i32) * shares[pair as usize].size
        };
        let leaflet = |s: f32, turn: f32, size: f32| {
            let (v, u) = (toward(s), pose.u);
            let turned = Quat::from_axis_angle(u.cross(v).normalize_or(face), turn);
            Leaflet { base: at(s), u: turned * u * size, v: turned * v * size }
        };
        let mut leaflets = Vec::with_capacity(count as usize);
        for pair in 0..pairs {
            let s =
                stalk + if self.palmate { 0.0 } else { self.pair_gap * unit * shares[pair as usize].place };
            let fan = if self.palmate { 1.0 - pair as f32 / (pairs as f32 + 0.5) } else { 1.0 };
            for side in [-1.0, 1.0] {
                leaflets.push(leaflet(s, side * fan * self.angle_deg.to_radians(), size(pair)));
            }
        }
        let end = if self.palmate { stalk } else { stalk + along };
        if self.terminal || count == 1 {
            let last = shares.last().map_or(1.0, |share| share.size);
            leaflets.push(leaflet(end, 0.0, self.leaflet * unit * last));
        }
        let stipule = |side: f32| leaflet(0.02 * pose.length, side * 0.35, self.stipules * pose.length);
        CompoundLeaf {
            rachis: (0..=4).map(|k| at(end * k as f32 / 4.0)).collect(),
            radius: self.rachis * pose.length,
            leaflets,
            stipules: if self.stipules > 0.0 { vec![stipule(-1.0), stipule(1.0)] } else { Vec::new() },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const POSE: LeafPose = LeafPose { base: Vec3::ZERO, u: Vec3::X, v: Vec3::Y, length: 0.12 };

    #[test]
    fn leaflets_are_counted_and_those_of_the_right_mirror_the_left() {
        let compound = Compound { droop: 0.0, ..Compound::default() };
        for count in [1, 3, 5, 7, 15] {
            let leaf = compound.leaf(&POSE, count);
            assert_eq!(leaf.leaflets.len(), count as usize);
            for pair in leaf.leaflets[..count as usize - 1].chunks_exact(2) {
                let mirrored = |v: Vec3| Vec3::new(-v.x, v.y, v.z);
                assert!(mirrored(pair[0].v).distance(pair[1].v) < 1e-6);
                assert!(mirrored(pair[0].base).distance(pair[1].base) < 1e-6);
            }
        }
    }

    #[test]
    fn numbers_come_by_their_shares() {
        let compound =
            Compound { leaflets: vec![3, 5, 7], shares: vec![0.23, 0.54, 0.23], ..Compound::default() };
        let of = |count: u32| (0..1000).filter(|k| compound.count(*k as f32 / 1000.0) == count).count();
        assert!((of(3).abs_diff(230), of(5).abs_diff(540), of(7).abs_diff(230)) <= (1, 1, 1));
    }

    #[test]
    fn fewer_leaflets_cover_what_all_do() {
        let whole = Compound { leaflets: vec![3, 9, 13, 14], shrink: 1.0, ..Compound::default() };
        let less = whole.with_fewer(0.5);
        assert_eq!(less.leaflets, [3, 5, 7, 8]);
        let area = |leaf: &Compound, count: u32| count as f32 * leaf.leaflet.powi(2);
        assert!((area(&less, 7) / area(&whole, 13) - 0.93).abs() < 0.05);
        assert_eq!(whole.with_fewer(1.0), whole);
    }

    #[test]
    fn no_leaf_is_longer_than_it_should_be() {
        for count in [3, 9, 25, 60] {
            let leaf =
                Compound { leaflets: vec![count], droop: 0.0, ..Compound::default() }.leaf(&POSE, count);
            let tip = leaf.leaflets.iter().map(|leaflet| (leaflet.base + leaflet.v).y).fold(0.0, f32::max);
            assert!(tip <= POSE.length * 1.3, "{count}: {tip}");
        }
    }

    #[test]
    fn fingers_stand_at_one_place() {
        let palmate = Compound { palmate: true, ..Compound::default() }.leaf(&POSE, 7);
        assert!(
            palmate.leaflets.iter().all(|leaflet| leaflet.base.distance(palmate.leaflets[0].base) < 1e-6)
        );
    }

    #[test]
    fn lists_that_cannot_be_are_refused() {
        let fault = |text: &str| toml::from_str::<Compound>(text).unwrap_err().to_string();
        assert!(fault("leaflets = []").contains("1 to 60"));
        assert!(fault("leaflets = [0]").contains("1 to 60"));
        assert!(fault("shares = [0.0]").contains("not all"));
        assert!(fault("shares = [nan]").contains("from 0 on"));
    }
}
