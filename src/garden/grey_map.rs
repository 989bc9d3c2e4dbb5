//! Pictures that are read as numbers: densities and heights over a garden, 0 for black and 1 for white.
//!
//! A map lies over the box of the garden's area as a plan does: its upper edge on the far side. Between the middles of pixels values go
//! over bilinearly; beyond the outermost middles they stay.
//!
//! Limits: eight bits, so heights of two metres have steps of 8 mm; no colours, no holes.

use crate::picture::decode::Rgba;
use crate::picture::{Picture, PictureError, around};
use glam::{UVec2, Vec2};
use std::path::Path;
use thiserror::Error;

/// By how much red, green and blue of a grey pixel may differ: JPEG does not keep them exactly.
const GREY_TOLERANCE: u8 = 12;

/// A picture that is no map.
#[derive(Debug, Error)]
pub enum MapError {
    /// No picture.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// A pixel has a colour.
    #[error("it is not grey: the pixel {} from the left and {} from the top is rgb({}, {}, {}); save it in shades of grey", .at.x, .at.y, .rgb[0], .rgb[1], .rgb[2])]
    NotGrey {
        /// Where, from 0.
        at: UVec2,
        /// Its colour.
        rgb: [u8; 3],
    },
    /// A pixel is transparent.
    #[error("it has a hole: the pixel {} from the left and {} from the top is transparent; fill it", .at.x, .at.y)]
    Hole {
        /// Where, from 0.
        at: UVec2,
    },
}

/// Numbers from 0 to 1 over a rectangle.
#[derive(Clone, PartialEq)]
pub struct GreyMap {
    size: UVec2,
    values: Vec<f32>,
}

impl std::fmt::Debug for GreyMap {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "GreyMap({}x{})", self.size.x, self.size.y)
    }
}

impl GreyMap {
    /// A map of values from 0 to 1, row by row.
    pub(super) fn of_values(size: UVec2, values: Vec<f32>) -> Self {
        debug_assert_eq!(values.len(), (size.x * size.y) as usize);
        Self { size, values }
    }

    /// The mean of its values.
    pub fn mean(&self) -> f32 {
        let sum: f64 = self.values.iter().map(|value| f64::from(*value)).sum();
        (sum / self.values.len().max(1) as f64) as f32
    }

    /// Reads a PNG or JPEG file.
    ///
    /// # Errors
    /// [`MapError`].
    pub fn read(path: &Path) -> Result<Self, MapError> {
        Self::of(&Picture::read_with_pixels(path)?.1)
    }

    /// The map of a picture.
    ///
    /// # Errors
    /// The first pixel with a colour or without any.
    pub fn of(picture: &Rgba) -> Result<Self, MapError> {
        let pixels = picture.pixels.as_chunks::<4>().0;
        let at = |k: usize| UVec2::new(k as u32 % picture.width, k as u32 / picture.width);
        let value = |(k, &[r, g, b, alpha]): (usize, &[u8; 4])| {
            if alpha < u8::MAX {
                return Err(MapError::Hole { at: at(k) });
            }
            let (low, high) = (r.min(g).min(b), r.max(g).max(b));
            if high - low > GREY_TOLERANCE {
                return Err(MapError::NotGrey { at: at(k), rgb: [r, g, b] });
            }
            Ok(f32::from(g) / f32::from(u8::MAX))
        };
        let values = pixels.iter().enumerate().map(value).collect::<Result<_, _>>()?;
        Ok(Self { size: UVec2::new(picture.width, picture.height), values })
    }

    /// The value at a place: shares of the rectangle from its upper left corner.
    pub fn at(&self, share: Vec2) -> f32 {
        around(self.size, share * self.size.as_vec2())
            .iter()
            .map(|(pixel, share)| self.values[*pixel] * share)
            .sum()
    }

    /// Its size in pixels.
    pub fn size(&self) -> UVec2 {
        self.size
    }

    /// Its largest value.
    pub fn highest(&self) -> f32 {
        self.values.iter().copied().fold(0.0, f32::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(width: u32, greys: &[u8]) -> GreyMap {
        GreyMap::of(&picture(width, greys)).unwrap()
    }

    fn picture(width: u32, greys: &[u8]) -> Rgba {
        let pixels = greys.iter().flat_map(|&grey| [grey, grey, grey, 255]).collect();
        Rgba { width, height: greys.len() as u32 / width, pixels }
    }

    #[test]
    fn values_go_over_between_the_middles_of_pixels() {
        let ramp = map(2, &[0, 255, 0, 255]);
        let along = [0.0, 0.25, 0.5, 0.75, 1.0].map(|x| ramp.at(Vec2::new(x, 0.5)));
        assert_eq!(along, [0.0, 0.0, 0.5, 1.0, 1.0]);
        assert_eq!(map(1, &[51]).at(Vec2::new(0.9, 0.1)), 0.2);
        assert_eq!(map(1, &[255, 0]).at(Vec2::new(0.5, 0.0)), 1.0, "the upper edge is the first row");
    }

    #[test]
    fn colours_and_holes_are_reported_with_their_place() {
        let mut colour = picture(2, &[9, 9, 9, 9]);
        colour.pixels[12] = 200;
        assert!(GreyMap::of(&colour).unwrap_err().to_string().contains("1 from the left and 1 from the top"));
        let mut hole = picture(2, &[9, 9]);
        hole.pixels[3] = 0;
        assert!(GreyMap::of(&hole).unwrap_err().to_string().contains("transparent"));
    }
}
