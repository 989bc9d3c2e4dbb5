//! The `reference` of a drawing: how the picture lies, and the picture itself.

use super::picture::PictureSeed;
use super::progress::{Progress, set_once};
use crate::sketch::error::Fault;
use crate::sketch::reference::Reference;
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
