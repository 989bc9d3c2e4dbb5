//! Picture files to pixels: PNG and JPEG, recognised by their first bytes; and back to PNG.

use super::format::PictureFormat;
use std::io::Cursor;
use zune_jpeg::zune_core::{colorspace::ColorSpace, options::DecoderOptions};

/// Longest side of a picture in pixels that is read at all.
const SIDE_LIMIT: u32 = 8192;

/// A picture in memory: straight alpha, sRGB, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Rgba {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Four bytes per pixel.
    pub pixels: Vec<u8>,
}

impl Rgba {
    /// The picture as a PNG file, the same bytes every time; without alpha where all of it is opaque.
    ///
    /// # Errors
    /// The encoder's.
    pub fn to_png(&self) -> Result<Vec<u8>, png::EncodingError> {
        let pixels = self.pixels.as_chunks::<4>().0;
        let is_opaque = pixels.iter().all(|pixel| pixel[3] == 255);
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(if is_opaque { png::ColorType::Rgb } else { png::ColorType::Rgba });
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        if is_opaque {
            let colours: Vec<u8> = pixels.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect();
            writer.write_image_data(&colours)?;
        } else {
            writer.write_image_data(&self.pixels)?;
        }
        writer.finish()?;
        Ok(bytes)
    }
}

/// Decodes a PNG or JPEG file.
///
/// # Errors
/// What is wrong with it, in words that follow “it cannot be used:”.
pub fn decode(bytes: &[u8]) -> Result<Rgba, String> {
    match PictureFormat::of(bytes) {
        Some(PictureFormat::Png) => decode_png(bytes),
        Some(PictureFormat::Jpeg) => decode_jpeg(bytes),
        None => Err("it is neither a PNG nor a JPEG file".to_owned()),
    }
}

fn decode_png(bytes: &[u8]) -> Result<Rgba, String> {
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::normalize_to_color8() | png::Transformations::ALPHA);
    let header = decoder.read_header_info().map_err(|e| e.to_string())?;
    let (width, height) = checked_size(header.width, header.height)?;
    let mut reader = decoder.read_info().map_err(|e| e.to_string())?;
    // The decoder takes the palette three bytes at a time and panics on what is left over.
    if reader.info().palette.as_ref().is_some_and(|palette| palette.len() % 3 != 0) {
        return Err("its palette is damaged".to_owned());
    }
    let size = reader.output_buffer_size().ok_or("it is too large")?;
    let mut pixels = vec![0; size];
    reader.next_frame(&mut pixels).map_err(|e| e.to_string())?;
    if reader.output_color_type().0 == png::ColorType::GrayscaleAlpha {
        pixels = pixels.as_chunks().0.iter().flat_map(|&[grey, alpha]| [grey, grey, grey, alpha]).collect();
    }
    Ok(Rgba { width, height, pixels })
}

fn decode_jpeg(bytes: &[u8]) -> Result<Rgba, String> {
    let options = DecoderOptions::default().jpeg_set_out_colorspace(ColorSpace::RGBA);
    let mut decoder = zune_jpeg::JpegDecoder::new_with_options(Cursor::new(bytes), options);
    decoder.decode_headers().map_err(|e| e.to_string())?;
    let info = decoder.info().ok_or("its header is incomplete")?;
    let (width, height) = checked_size(info.width.into(), info.height.into())?;
    let pixels = decoder.decode().map_err(|e| e.to_string())?;
    if pixels.len() != width as usize * height as usize * 4 {
        return Err(
            "its colours are stored in a way that is not understood; save it as an RGB JPEG".to_owned()
        );
    }
    Ok(Rgba { width, height, pixels })
}

fn checked_size(width: u32, height: u32) -> Result<(u32, u32), String> {
    if width == 0 || height == 0 || width > SIDE_LIMIT || height > SIDE_LIMIT {
        return Err(format!("it has {width}×{height} pixels; each side must be 1 to {SIDE_LIMIT}"));
    }
    Ok((width, height))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn png_of(width: u32, height: u32, colour: png::ColorType, data: &[u8]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(colour);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.write_header().unwrap().write_image_data(data).unwrap();
        bytes
    }

    #[test]
    fn every_kind_of_png_becomes_rgba() {
        let cases: [(png::ColorType, &[u8], [u8; 4]); 4] = [
            (png::ColorType::Grayscale, &[7], [7, 7, 7, 255]),
            (png::ColorType::GrayscaleAlpha, &[7, 9], [7, 7, 7, 9]),
            (png::ColorType::Rgb, &[1, 2, 3], [1, 2, 3, 255]),
            (png::ColorType::Rgba, &[1, 2, 3, 4], [1, 2, 3, 4]),
        ];
        for (colour, data, expected) in cases {
            let picture = decode(&png_of(1, 1, colour, data)).unwrap();
            assert_eq!(picture.pixels, expected, "{colour:?}");
        }
    }

    #[test]
    fn a_truncated_png_is_an_error() {
        let whole = png_of(4, 4, png::ColorType::Rgb, &[50; 48]);
        for length in [4, 20, whole.len() / 2] {
            assert!(decode(&whole[..length]).is_err(), "{length} bytes");
        }
    }

    #[test]
    fn a_palette_of_broken_colours_is_an_error() {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 1, 1);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_palette(vec![1, 2, 3, 4]);
        encoder.write_header().unwrap().write_image_data(&[0]).unwrap();
        assert!(decode(&bytes).unwrap_err().contains("palette"));
    }

    /// 8×8 pixels of grey 200.
    #[rustfmt::skip]
    const GREY_JPEG: &[u8] = &[
        0xff, 0xd8, 0xff, 0xe0, 0x00, 0x10, 0x4a, 0x46, 0x49, 0x46, 0x00, 0x01, 0x01, 0x00, 0x00, 0x01,
        0x00, 0x01, 0x00, 0x00, 0xff, 0xdb, 0x00, 0x43, 0x00, 0x10, 0x0b, 0x0c, 0x0e, 0x0c, 0x0a, 0x10,
        0x0e, 0x0d, 0x0e, 0x12, 0x11, 0x10, 0x13, 0x18, 0x28, 0x1a, 0x18, 0x16, 0x16, 0x18, 0x31, 0x23,
        0x25, 0x1d, 0x28, 0x3a, 0x33, 0x3d, 0x3c, 0x39, 0x33, 0x38, 0x37, 0x40, 0x48, 0x5c, 0x4e, 0x40,
        0x44, 0x57, 0x45, 0x37, 0x38, 0x50, 0x6d, 0x51, 0x57, 0x5f, 0x62, 0x67, 0x68, 0x67, 0x3e, 0x4d,
        0x71, 0x79, 0x70, 0x64, 0x78, 0x5c, 0x65, 0x67, 0x63, 0xff, 0xc0, 0x00, 0x0b, 0x08, 0x00, 0x08,
        0x00, 0x08, 0x01, 0x01, 0x11, 0x00, 0xff, 0xc4, 0x00, 0x14, 0x00, 0x01, 0x00, 0x00, 0x00, 0x00,
        0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x06, 0xff, 0xc4, 0x00, 0x14,
        0x10, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
        0x00, 0x00, 0xff, 0xda, 0x00, 0x08, 0x01, 0x01, 0x00, 0x00, 0x3f, 0x00, 0x48, 0xff, 0xd9,
    ];

    #[test]
    fn a_jpeg_becomes_rgba() {
        let picture = decode(GREY_JPEG).unwrap();
        assert_eq!((picture.width, picture.height, picture.pixels.len()), (8, 8, 256));
        let [r, g, b, a] = picture.pixels.as_chunks().0[0];
        assert!(r.abs_diff(200) <= 2 && (g, b, a) == (r, r, 255), "{r} {g} {b} {a}");
    }

    #[test]
    fn a_jpeg_without_its_pixels_is_an_error() {
        assert!(decode(&GREY_JPEG[..4]).is_err());
        assert!(decode(&GREY_JPEG[..90]).is_err());
    }

    #[test]
    fn other_files_are_named_as_such() {
        assert!(decode(b"GIF89a").unwrap_err().contains("neither"));
    }

    #[test]
    fn a_giant_is_refused_before_its_pixels_are_read() {
        let mut header = png_of(1, 1, png::ColorType::Rgb, &[0; 3]);
        header[16..20].copy_from_slice(&100_000_u32.to_be_bytes());
        assert!(decode(&header).is_err());
        assert!(checked_size(100_000, 1).unwrap_err().contains("100000"));
    }

    #[test]
    fn pixels_come_back_from_png() {
        for alpha in [255, 9] {
            let picture = Rgba { width: 2, height: 1, pixels: vec![1, 2, 3, 255, 4, 5, 6, alpha] };
            assert_eq!(decode(&picture.to_png().unwrap()).unwrap(), picture);
        }
    }
}
