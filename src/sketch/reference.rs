//! The picture under the drawing, which people trace: its bytes as they were opened, and how it lies on the canvas.
//!
//! The picture is kept in its own format (PNG or JPEG) and only its header is looked into; whoever shows it decodes it.
//! A [`Picture`] is shared, so copies of a drawing and steps of its history cost nothing.

use super::limits;
use crate::random::mix;
use glam::{UVec2, Vec2};
use std::io::Cursor;
use std::sync::Arc;
use thiserror::Error;

/// A picture that cannot lie under a drawing.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum ReferenceError {
    /// Neither PNG nor JPEG.
    #[error("the reference picture is neither PNG nor JPEG; convert it to one of them")]
    NotAPicture,
    /// PNG or JPEG, but its size cannot be read.
    #[error("the header of the reference picture is damaged; open the picture elsewhere and save it again")]
    Damaged,
    /// More than [`limits::MAX_REFERENCE_BYTES`].
    #[error("the reference picture is larger than {} MiB; scale it down", limits::MAX_REFERENCE_BYTES >> 20)]
    TooLarge,
    /// The picture's text in a drawing file is no base64.
    #[error(
        "the data of the reference picture is damaged at character {offset} of its base64 text; restore the file from a backup, or remove its `reference`"
    )]
    NotBase64 {
        /// Offset of the first group of four characters that is wrong.
        offset: usize,
    },
    /// A place or size out of range.
    #[error("the reference picture's {what} is out of range; it must be {range}")]
    OutOfRange {
        /// Which number.
        what: &'static str,
        /// What it may be.
        range: &'static str,
    },
}

/// A PNG or JPEG file in memory, not larger than [`limits::MAX_REFERENCE_BYTES`].
#[derive(Clone)]
pub struct Picture {
    bytes: Arc<[u8]>,
    size_px: UVec2,
    hash: u64,
}

impl Picture {
    /// Takes the bytes of a PNG or JPEG file.
    ///
    /// # Errors
    /// Any other file, one without a sound header, one too large.
    pub fn new(bytes: impl Into<Arc<[u8]>>) -> Result<Self, ReferenceError> {
        let bytes = bytes.into();
        if bytes.len() > limits::MAX_REFERENCE_BYTES {
            return Err(ReferenceError::TooLarge);
        }
        let size_px = if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
            png_size(&bytes)
        } else if bytes.starts_with(b"\xff\xd8\xff") {
            jpeg_size(&bytes)
        } else {
            return Err(ReferenceError::NotAPicture);
        };
        let size_px = size_px.filter(|size| size.min_element() > 0).ok_or(ReferenceError::Damaged)?;
        let hash = content_hash(&bytes);
        Ok(Self { bytes, size_px, hash })
    }

    /// The file's bytes.
    pub fn bytes(&self) -> &Arc<[u8]> {
        &self.bytes
    }

    /// Width and height in the picture's own pixels, as its header says.
    pub fn size_px(&self) -> UVec2 {
        self.size_px
    }

    /// Name of the content: the same for the same bytes, on every machine.
    pub fn hash(&self) -> u64 {
        self.hash
    }
}

impl PartialEq for Picture {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.bytes, &other.bytes) || self.hash == other.hash && self.bytes == other.bytes
    }
}

impl std::fmt::Debug for Picture {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let UVec2 { x, y } = self.size_px;
        write!(f, "Picture({x}×{y}, {} bytes)", self.bytes.len())
    }
}

fn png_size(bytes: &[u8]) -> Option<UVec2> {
    let header = png::Decoder::new(Cursor::new(bytes)).read_header_info().ok().map(|h| (h.width, h.height));
    header.map(UVec2::from)
}

fn jpeg_size(bytes: &[u8]) -> Option<UVec2> {
    let mut decoder = zune_jpeg::JpegDecoder::new(Cursor::new(bytes));
    decoder.decode_headers().ok()?;
    decoder.info().map(|info| UVec2::new(info.width.into(), info.height.into()))
}

/// A number that tells contents apart: the finaliser of SplitMix64 over words of eight bytes and the length.
pub(super) fn content_hash(bytes: &[u8]) -> u64 {
    let (words, rest) = bytes.as_chunks::<8>();
    let mut last = [0; 8];
    last[..rest.len()].copy_from_slice(rest);
    let words = words.iter().chain([&last]).map(|word| u64::from_le_bytes(*word));
    words.fold(bytes.len() as u64, mix)
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
    fn pictures_are_known_by_their_header() {
        let png = Picture::new(&include_bytes!("../../tests/fixtures/reference/small.png")[..]).unwrap();
        assert_eq!(png.size_px(), UVec2::new(3, 2));
        let jpeg = Picture::new(&include_bytes!("../../tests/fixtures/reference/small.jpg")[..]).unwrap();
        assert_eq!(jpeg.size_px(), UVec2::new(5, 4));
        assert_ne!(png.hash(), jpeg.hash());
        assert_eq!(Picture::new(&b"GIF89a"[..]).unwrap_err(), ReferenceError::NotAPicture);
        assert_eq!(Picture::new(&png.bytes()[..20]).unwrap_err(), ReferenceError::Damaged);
        assert_eq!(Picture::new(&jpeg.bytes()[..20]).unwrap_err(), ReferenceError::Damaged);
        let mut huge = png.bytes().to_vec();
        huge.resize(limits::MAX_REFERENCE_BYTES + 1, 0);
        assert_eq!(Picture::new(huge).unwrap_err(), ReferenceError::TooLarge);
    }

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

    #[test]
    fn hashes_tell_contents_and_lengths_apart() {
        let hashes = [&b""[..], b"\0", b"\0\0", b"12345678", b"12345678\0", b"12345679"].map(content_hash);
        for (i, hash) in hashes.iter().enumerate() {
            assert!(!hashes[..i].contains(hash), "{i}");
        }
    }
}
