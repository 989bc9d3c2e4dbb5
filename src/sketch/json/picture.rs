//! Pictures in a drawing: each a PNG or JPEG file as base64 text; those of textures have names.

use super::progress::Progress;
use crate::picture::Picture;
use crate::sketch::error::Fault;
use crate::sketch::limits;
use crate::sketch::textures::PARTS;
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, Visitor};
use std::collections::BTreeMap;
use std::fmt;

/// Reads one picture.
pub(super) struct PictureSeed<'p>(pub(super) &'p Progress);

impl<'de> DeserializeSeed<'de> for PictureSeed<'_> {
    type Value = Picture;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Picture, D::Error> {
        deserializer.deserialize_str(self)
    }
}

impl Visitor<'_> for PictureSeed<'_> {
    type Value = Picture;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a PNG or JPEG file as base64 text")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Picture, E> {
        Picture::from_base64(text).map_err(|fault| self.0.refuse(Fault::Picture(fault)))
    }
}

/// Reads pictures by their names.
pub(super) struct PicturesSeed<'p>(pub(super) &'p Progress);

impl<'de> DeserializeSeed<'de> for PicturesSeed<'_> {
    type Value = BTreeMap<String, Picture>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for PicturesSeed<'_> {
    type Value = BTreeMap<String, Picture>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object of pictures")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let progress = self.0;
        let mut pictures = BTreeMap::new();
        let mut bytes = 0;
        while let Some(name) = map.next_key::<String>()? {
            let picture = map.next_value_seed(PictureSeed(progress))?;
            bytes += picture.bytes().len();
            // No more than one for each part is ever named; what is not named counts as well.
            if pictures.len() == PARTS.len() || bytes > limits::MAX_TEXTURE_BYTES {
                return Err(progress.malformed(format!(
                    "there are more than {} `pictures`, or they have more than {} MiB together; take out those that no \
                     texture names",
                    PARTS.len(),
                    limits::MAX_TEXTURE_BYTES >> 20
                )));
            }
            if pictures.insert(name, picture).is_some() {
                return Err(progress.malformed("two `pictures` have the same name; give each its own"));
            }
        }
        Ok(pictures)
    }
}
