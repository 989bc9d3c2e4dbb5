//! The `reference` of a drawing: how the picture lies, and the picture itself as base64.

use super::progress::{Progress, set_once};
use crate::sketch::base64;
use crate::sketch::error::Fault;
use crate::sketch::limits;
use crate::sketch::reference::{Picture, Reference, ReferenceError};
use glam::Vec2;
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, Visitor};
use std::fmt;

/// Reads a reference, or `null`.
pub(super) struct ReferenceSeed<'p>(pub(super) &'p Progress);

#[derive(Deserialize)]
#[serde(field_identifier, rename_all = "snake_case")]
enum Field {
    Center,
    Width,
    RotationDeg,
    Opacity,
    Locked,
    Visible,
    Picture,
}

impl<'de> DeserializeSeed<'de> for ReferenceSeed<'_> {
    type Value = Option<Reference>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for ReferenceSeed<'_> {
    type Value = Option<Reference>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a reference object")
    }

    fn visit_unit<E: Error>(self) -> Result<Self::Value, E> {
        Ok(None)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let progress = self.0;
        let (mut center, mut width, mut rotation, mut opacity) = (None, None, None, None);
        let (mut locked, mut visible, mut picture) = (None, None, None);
        while let Some(field) = map.next_key()? {
            match field {
                Field::Center => set_once(&mut center, map.next_value::<[f32; 2]>()?, "center")?,
                Field::Width => set_once(&mut width, map.next_value()?, "width")?,
                Field::RotationDeg => set_once(&mut rotation, map.next_value()?, "rotation_deg")?,
                Field::Opacity => set_once(&mut opacity, map.next_value()?, "opacity")?,
                Field::Locked => set_once(&mut locked, map.next_value()?, "locked")?,
                Field::Visible => set_once(&mut visible, map.next_value()?, "visible")?,
                Field::Picture => {
                    set_once(&mut picture, map.next_value_seed(PictureSeed(progress))?, "picture")?
                }
            }
        }
        let picture = picture.ok_or_else(|| A::Error::missing_field("picture"))?;
        let center = Vec2::from(center.ok_or_else(|| A::Error::missing_field("center"))?);
        let width = width.ok_or_else(|| A::Error::missing_field("width"))?;
        let plain = Reference::new(picture, center, width);
        let reference = Reference {
            rotation_deg: rotation.unwrap_or(plain.rotation_deg),
            opacity: opacity.unwrap_or(plain.opacity),
            locked: locked.unwrap_or(plain.locked),
            visible: visible.unwrap_or(plain.visible),
            ..plain
        };
        reference.check().map_err(|fault| progress.refuse(Fault::Reference(fault)))?;
        Ok(Some(reference))
    }
}

struct PictureSeed<'p>(&'p Progress);

impl<'de> DeserializeSeed<'de> for PictureSeed<'_> {
    type Value = Picture;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Picture, D::Error> {
        deserializer.deserialize_str(self)
    }
}

impl<'de> Visitor<'de> for PictureSeed<'_> {
    type Value = Picture;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a PNG or JPEG file as base64 text")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Picture, E> {
        let refuse = |fault| self.0.refuse(Fault::Reference(fault));
        // Before decoding, so that a hostile text costs no memory.
        if text.len() / 4 > limits::MAX_REFERENCE_BYTES / 3 + 1 {
            return Err(refuse(ReferenceError::TooLarge));
        }
        let bytes = base64::decode(text).map_err(|offset| refuse(ReferenceError::NotBase64 { offset }))?;
        Picture::new(bytes).map_err(refuse)
    }
}
