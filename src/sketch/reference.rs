//! The picture under the drawing, which people trace: the picture itself, and how it lies on the canvas.

use super::limits;
use crate::picture::{Picture, PictureError};
use glam::Vec2;
use thiserror::Error;

/// A picture that cannot lie under a drawing.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum ReferenceError {
    /// The picture itself.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// A place or size out of range.
    #[error("the reference picture's {what} is out of range; it must be {range}")]
    OutOfRange {
        /// Which number.
        what: &'static str,
        /// What it may be.
        range: &'static str,
    },
}

/// A picture lying under the drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// The picture.
    pub picture: Picture,
    /// Where its middle lies, canvas pixels.
    pub center: Vec2,
    /// Its width on the canvas before rotation, canvas pixels; the height follows from the picture.
    pub width: f32,
    /// Clockwise turn in degrees.
    pub rotation_deg: f32,
    /// 0 (not seen) to 1 (hides the paper).
    pub opacity: f32,
    /// Whether tools leave it where it is.
    pub locked: bool,
    /// Whether it is shown.
    pub visible: bool,
}

impl Reference {
    /// How strongly a new reference shows: enough to trace, not so much that strokes drown.
    pub const DEFAULT_OPACITY: f32 = 0.5;

    /// An unlocked, visible picture of this width around `center`, upright.
    pub fn new(picture: Picture, center: Vec2, width: f32) -> Self {
        let opacity = Self::DEFAULT_OPACITY;
        Self { picture, center, width, rotation_deg: 0.0, opacity, locked: false, visible: true }
    }

    /// Height on the canvas before rotation, canvas pixels.
    pub fn height(&self) -> f32 {
        let size = self.picture.size_px().as_vec2();
        self.width * size.y / size.x
    }

    /// Smallest and largest corner of the box around it, canvas pixels.
    pub fn bounds(&self) -> (Vec2, Vec2) {
        let turn = Vec2::from_angle(self.rotation_deg.to_radians());
        let half = 0.5 * Vec2::new(self.width, self.height());
        let reach = turn.rotate(half).abs().max(turn.rotate(half * Vec2::new(1.0, -1.0)).abs());
        (self.center - reach, self.center + reach)
    }

    /// Checks that every number is finite and in range.
    ///
    /// # Errors
    /// The first that is not.
    pub fn check(&self) -> Result<(), ReferenceError> {
        let far = Vec2::splat(limits::MAX_COORDINATE);
        let turn = limits::MAX_REFERENCE_ROTATION_DEG;
        let rules = [
            (self.center.abs().cmple(far).all(), "center", "within 1e7 pixels of the origin"),
            (
                self.width > 0.0 && self.width <= limits::MAX_CANVAS_SIDE,
                "width",
                "more than 0 and at most 2e7 pixels",
            ),
            (self.rotation_deg.abs() <= turn, "rotation_deg", "−360 to 360"),
            ((0.0..=1.0).contains(&self.opacity), "opacity", "0 to 1"),
        ];
        match rules.into_iter().find(|(holds, ..)| !holds) {
            Some((_, what, range)) => Err(ReferenceError::OutOfRange { what, range }),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_height_follows_the_picture_and_numbers_are_checked() {
        let png = Picture::new(&include_bytes!("../../tests/fixtures/reference/small.png")[..]).unwrap();
        let reference = Reference::new(png, Vec2::new(1.0, 2.0), 300.0);
        assert_eq!(reference.height(), 200.0);
        assert_eq!(reference.check(), Ok(()));
        assert!(Reference { opacity: f32::NAN, ..reference.clone() }.check().is_err());
        assert!(Reference { width: 0.0, ..reference.clone() }.check().is_err());
        assert!(Reference { center: Vec2::new(2e7, 0.0), ..reference }.check().is_err());
    }
}
