//! Ranges of the numbers in a species file, checked while reading so that an error knows its line.

use serde::{Deserialize, Deserializer, de::Error};

macro_rules! ranges {
    ($($(#[doc = $about:literal])+ $name:ident: $ty:ty, $min:literal ..= $max:literal;)*) => { $(
        $(#[doc = $about])+
        pub(super) fn $name<'de, D: Deserializer<'de>>(source: D) -> Result<$ty, D::Error> {
            let value = <$ty>::deserialize(source)?;
            if ($min..=$max).contains(&value) {
                return Ok(value);
            }
            Err(D::Error::custom(format!("{value} is outside {} to {}", $min, $max)))
        }
    )* };
}

ranges! {
    /// A share of a whole.
    share: f32, 0.0..=1.0;
    /// A length as a share of a flower's reach; some pistils stand out far beyond the petals.
    reach: f32, 0.0..=3.0;
    /// Radius of a thread as a share of a flower's reach.
    thin: f32, 0.001..=0.2;
    /// A ratio of two lengths.
    ratio: f32, 0.01..=20.0;
    /// Bow of a thread, in lengths of the thread.
    bow: f32, -1.0..=1.0;
    /// An angle from an axis, degrees.
    angle_deg: f32, 0.0..=180.0;
    /// Parts of one flower.
    count: u32, 0..=200;
    /// Level in the branch hierarchy.
    level: u32, 0..=20;
    /// Blinn-Phong exponent.
    shininess: f32, 0.0..=1000.0;
}

/// Radius and half length of a thread's head, as shares of a flower's reach.
pub(super) fn head<'de, D: Deserializer<'de>>(source: D) -> Result<[f32; 2], D::Error> {
    let head = <[f32; 2]>::deserialize(source)?;
    match head.iter().find(|size| !(0.0..=0.5).contains(*size)) {
        Some(size) => Err(D::Error::custom(format!("{size} is outside 0 to 0.5"))),
        None => Ok(head),
    }
}
