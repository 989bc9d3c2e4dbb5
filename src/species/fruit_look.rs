//! The section `[fruit]` of a species file: what fruits are made of, and which ones plants bear by themselves.

use serde::{Deserialize, Deserializer, Serialize, de};

/// Fruits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FruitLook {
    /// Material; that of the skin of caps.
    pub material: String,
    /// Material of the underside of caps: with it a stem that suddenly widens is a stalk with a cap.
    pub underside: Option<String>,
    /// Material of fruits that have not ripened; without it they have that of ripe ones.
    pub unripe: Option<String>,
    /// Material of the stalks of fruits that nobody drew; without it they are made as twigs are.
    pub stalk: Option<String>,
    /// Fruits that plants bear by themselves when their season comes.
    pub set: Option<FruitSet>,
}

/// What fruits look like.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FruitShape {
    /// A small ellipsoid of few triangles: a rowan's berry.
    Berry,
    /// A ball, drawn in a little at its stalk: a cherry, an olive, a walnut in its husk.
    Ball,
    /// A ball with a hollow at either end.
    Apple,
    /// Flat at its foot and pointed at its tip: a hazelnut.
    Nut,
    /// A nut in its cup.
    Acorn,
    /// A cone.
    Cone,
    /// One long wing with its seed at the stalk: an ash's key.
    Key,
    /// Two wings that part, a seed at the foot of each: a maple's key.
    Wings,
    /// A flat pod, wider at each seed.
    Pod,
}

crate::parameters! {
    /// Fruits that plants bear by themselves.
    pub struct FruitSet {
        /// Share of the leaves beside which there are fruits.
        share: f32, 0.0..=1.0, "of the leaves";
        /// Fruits at one place.
        cluster: u32 = 1, 1..=60, "";
        /// Radius of a full-grown fruit, share of the leaves' mean length.
        radius: f32, 0.001..=2.0, "of the leaves' mean length";
        /// Height, against the width.
        length: f32 = 1.0, 0.1..=10.0, "of the width";
        /// Length of the stalk.
        stalk: f32 = 1.0, 0.0..=20.0, "radii";
        /// How far a fruit hangs, whatever way its stalk leaves the wood: 1 straight down, 0 not at all, −1 straight up.
        hang: f32 = 1.0, -1.0..=1.0, "";
        /// How much radii differ.
        vary: f32 = 0.12, 0.0..=0.9, "of the radius";
        /// How far out along its leaf a fruit hangs at most, where leaves are pictures of whole shoots.
        along: f32 = 0.0, 0.0..=1.0, "of the leaf's length";
        /// Height of the leaves from which on there are any, 0 that of the lowest, 1 that of the highest.
        above: f32 = 0.0, 0.0..=1.0, "of the foliage's height";
        /// Age from which on a plant that grows from seed has any.
        from_age: f32 = 4.0, 0.0..=1000.0, "years";
        others:
        /// What they look like.
        shape: FruitShape;
        /// When the first and the last of them is ripe.
        ripe: [f32; 2] = [3.0, 3.6], read_times;
        /// When the first and the last of them falls; left out, they stay over the winter.
        falls: Option<[f32; 2]> = None, read_some_times;
    }
}

/// When the first and the last of many does something, times of the year from early summer on.
fn read_times<'de, D: Deserializer<'de>>(source: D) -> Result<[f32; 2], D::Error> {
    let times = <[f32; 2]>::deserialize(source)?;
    let is_sound = times[0] <= times[1] && times.iter().all(|time| (2.5..=6.0).contains(time));
    is_sound
        .then_some(times)
        .ok_or_else(|| de::Error::custom("write two times of the year from 2.5 to 6, the earlier one first"))
}

fn read_some_times<'de, D: Deserializer<'de>>(source: D) -> Result<Option<[f32; 2]>, D::Error> {
    read_times(source).map(Some)
}
