//! Pictures of the artist's own: PNG and JPEG files in memory, as drawings and presets keep them.
//!
//! A [`Picture`] is the bytes of a file in the format they came in, and shared, so copies of a drawing and steps of its
//! history cost nothing. Its header is read at once, its pixels only by [`decode::decode()`]: whoever lets an artist choose a
//! picture calls [`Picture::decoded`], so that one which cannot be shown is refused then and not at every build.
//!
//! Limits: 1 byte to [`MAX_BYTES`]; sides of pixels as [`decode::decode()`] takes them.

mod bilinear;
pub mod decode;
mod format;
mod recolour;
mod relief;

pub use bilinear::around;
pub use format::PictureFormat;
pub use recolour::recoloured;
pub use relief::normal_map;

use crate::input;
use crate::random::mix;
use base64::engine::general_purpose::STANDARD;
use base64::{DecodeError, Engine};
use decode::Rgba;
use glam::UVec2;
use std::hash::{Hash, Hasher};
use std::io::{Cursor, ErrorKind};
use std::path::Path;
use std::sync::Arc;
use thiserror::Error;

/// Largest picture in bytes, as the picture's own file has it.
pub const MAX_BYTES: usize = 32 << 20;

/// A picture that cannot be used.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum PictureError {
    /// The system does not give the file.
    #[error("the picture cannot be read: {0}; check the name and the permissions")]
    Unreadable(String),
    /// Neither PNG nor JPEG.
    #[error("the picture is neither PNG nor JPEG; convert it to one of them")]
    NotAPicture,
    /// PNG or JPEG, but not to be shown.
    #[error("the picture is damaged ({0}); open it elsewhere and save it again")]
    Damaged(String),
    /// More than [`MAX_BYTES`].
    #[error("the picture is larger than {} MiB; scale it down", MAX_BYTES >> 20)]
    TooLarge,
    /// The picture's text in a file is no base64.
    #[error(
        "the data of a picture is damaged at character {offset} of its base64 text; restore the file from a backup, or remove the picture"
    )]
    NotBase64 {
        /// Offset of the first character that is wrong; the text's length where its end is missing.
        offset: usize,
    },
}

/// A PNG or JPEG file in memory, not larger than [`MAX_BYTES`].
#[derive(Clone)]
pub struct Picture {
    bytes: Arc<[u8]>,
    format: PictureFormat,
    size_px: UVec2,
    hash: u64,
}

impl Picture {
    /// Takes the bytes of a PNG or JPEG file.
    ///
    /// # Errors
    /// Any other file, one without a sound header, one too large.
    pub fn new(bytes: impl Into<Arc<[u8]>>) -> Result<Self, PictureError> {
        let bytes = bytes.into();
        if bytes.len() > MAX_BYTES {
            return Err(PictureError::TooLarge);
        }
        let format = PictureFormat::of(&bytes).ok_or(PictureError::NotAPicture)?;
        let size_px = match format {
            PictureFormat::Png => png_size(&bytes),
            PictureFormat::Jpeg => jpeg_size(&bytes),
        };
        let sound = size_px.filter(|size| size.min_element() > 0);
        let size_px = sound.ok_or_else(|| PictureError::Damaged("its header cannot be read".to_owned()))?;
        let hash = content_hash(&bytes);
        Ok(Self { bytes, format, size_px, hash })
    }

    /// The same, once all its pixels were read.
    ///
    /// # Errors
    /// As [`Picture::new`], and a picture that cannot be decoded.
    pub fn decoded(bytes: impl Into<Arc<[u8]>>) -> Result<Self, PictureError> {
        let picture = Self::new(bytes)?;
        picture.pixels()?;
        Ok(picture)
    }

    /// Reads and decodes a file; reads no further than a picture may go, and nothing that is no regular file.
    ///
    /// # Errors
    /// As [`Picture::decoded`], and a file that cannot be read.
    pub fn read(path: &Path) -> Result<Self, PictureError> {
        Ok(Self::read_with_pixels(path)?.0)
    }

    /// The same, with its pixels.
    ///
    /// # Errors
    /// As [`Picture::read`].
    pub fn read_with_pixels(path: &Path) -> Result<(Self, Rgba), PictureError> {
        let picture = Self::read_header(path)?;
        let pixels = picture.pixels()?;
        Ok((picture, pixels))
    }

    /// Reads a file, of its picture only the header.
    ///
    /// # Errors
    /// As [`Picture::new`], and a file that cannot be read.
    pub fn read_header(path: &Path) -> Result<Self, PictureError> {
        let bytes = input::read(path, MAX_BYTES as u64).map_err(|error| match error.kind() {
            ErrorKind::FileTooLarge => PictureError::TooLarge,
            _ => PictureError::Unreadable(error.to_string()),
        })?;
        Self::new(bytes)
    }

    /// Its pixels.
    ///
    /// # Errors
    /// A picture that cannot be decoded.
    pub fn pixels(&self) -> Result<Rgba, PictureError> {
        decode::decode(&self.bytes).map_err(PictureError::Damaged)
    }

    /// The picture that [`Picture::to_base64`] wrote.
    ///
    /// # Errors
    /// Text that is no base64, and as [`Picture::new`].
    pub fn from_base64(text: &str) -> Result<Self, PictureError> {
        // Before decoding, so that a hostile text costs no memory.
        if text.len() / 4 > MAX_BYTES / 3 + 1 {
            return Err(PictureError::TooLarge);
        }
        let bytes = STANDARD.decode(text).map_err(|fault| PictureError::NotBase64 {
            offset: match fault {
                DecodeError::InvalidByte(offset, _) | DecodeError::InvalidLastSymbol { offset, .. } => offset,
                DecodeError::InvalidLength(_) | DecodeError::InvalidPadding => text.len(),
            },
        })?;
        Self::new(bytes)
    }

    /// The file's bytes as text.
    pub fn to_base64(&self) -> String {
        let mut text = String::new();
        self.push_base64(&mut text);
        text
    }

    /// Appends [`Picture::to_base64`].
    pub fn push_base64(&self, out: &mut String) {
        STANDARD.encode_string(&self.bytes, out);
    }

    /// The file's bytes.
    pub fn bytes(&self) -> &Arc<[u8]> {
        &self.bytes
    }

    /// How they are encoded.
    pub fn format(&self) -> PictureFormat {
        self.format
    }

    /// Width and height in the picture's own pixels, as its header says.
    pub fn size_px(&self) -> UVec2 {
        self.size_px
    }

    /// Name of the content: the same for the same bytes, on every machine.
    pub fn hash(&self) -> u64 {
        self.hash
    }

    /// [`Picture::hash`] as files write it: 16 hexadecimal digits.
    pub fn name(&self) -> String {
        format!("{:016x}", self.hash)
    }
}

impl PartialEq for Picture {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.bytes, &other.bytes) || self.hash == other.hash && self.bytes == other.bytes
    }
}

impl Eq for Picture {}

impl Hash for Picture {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.hash.hash(state);
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
pub fn content_hash(bytes: &[u8]) -> u64 {
    let (words, rest) = bytes.as_chunks::<8>();
    let mut last = [0; 8];
    last[..rest.len()].copy_from_slice(rest);
    let words = words.iter().chain([&last]).map(|word| u64::from_le_bytes(*word));
    words.fold(bytes.len() as u64, mix)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PNG: &[u8] = include_bytes!("../../tests/fixtures/reference/small.png");
    const JPEG: &[u8] = include_bytes!("../../tests/fixtures/reference/small.jpg");

    #[test]
    fn pictures_are_known_by_their_header() {
        let (png, jpeg) = (Picture::new(PNG).unwrap(), Picture::new(JPEG).unwrap());
        assert_eq!((png.size_px(), png.format()), (UVec2::new(3, 2), PictureFormat::Png));
        assert_eq!((jpeg.size_px(), jpeg.format()), (UVec2::new(5, 4), PictureFormat::Jpeg));
        assert_ne!(png.hash(), jpeg.hash());
        assert_eq!(Picture::new(&b"GIF89a"[..]).unwrap_err(), PictureError::NotAPicture);
        assert!(matches!(Picture::new(&PNG[..20]), Err(PictureError::Damaged(_))));
        assert!(matches!(Picture::new(&JPEG[..20]), Err(PictureError::Damaged(_))));
        let mut huge = PNG.to_vec();
        huge.resize(MAX_BYTES + 1, 0);
        assert_eq!(Picture::new(huge).unwrap_err(), PictureError::TooLarge);
    }

    #[test]
    fn a_picture_with_a_header_and_no_pixels_is_not_chosen() {
        let cut = &PNG[..PNG.len() - 20];
        assert!(Picture::new(cut).is_ok());
        assert!(matches!(Picture::decoded(cut), Err(PictureError::Damaged(_))));
        assert!(Picture::decoded(PNG).is_ok() && Picture::decoded(JPEG).is_ok());
    }

    #[test]
    fn pictures_come_back_from_text() {
        let png = Picture::new(PNG).unwrap();
        assert_eq!(Picture::from_base64(&png.to_base64()).unwrap(), png);
        for (text, offset) in
            [("iVB*", 3), ("iVBO iVB", 4), ("Zg=", 3), ("Zm9vYg", 6), ("Zh==", 1), ("Zg==Zg==", 2)]
        {
            assert_eq!(Picture::from_base64(text).unwrap_err(), PictureError::NotBase64 { offset }, "{text}");
        }
    }

    #[test]
    fn hashes_differ_by_contents_and_lengths() {
        let hashes = [&b""[..], b"\0", b"\0\0", b"12345678", b"12345678\0", b"12345679"].map(content_hash);
        for (i, hash) in hashes.iter().enumerate() {
            assert!(!hashes[..i].contains(hash), "{i}");
        }
    }
}
