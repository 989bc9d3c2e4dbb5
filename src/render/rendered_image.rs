//! A finished picture in memory.

use super::RenderError;
use crate::srgb::{linear_from_srgb, srgb_from_linear};

/// An RGBA picture: sRGB, straight alpha, rows from the top, four bytes per pixel.
#[derive(Clone, PartialEq, Eq)]
pub struct RenderedImage {
    width: u32,
    height: u32,
    pixels: Vec<u8>,
}

impl RenderedImage {
    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// All pixels, row by row from the top.
    pub fn pixels(&self) -> &[u8] {
        &self.pixels
    }

    /// Red, green, blue and alpha at a place counted from the top left corner; `None` outside.
    pub fn pixel(&self, x: u32, y: u32) -> Option<[u8; 4]> {
        let at = (y as usize * self.width as usize + x as usize).checked_mul(4)?;
        let pixel = (x < self.width).then(|| self.pixels.get(at..at + 4)).flatten()?;
        pixel.try_into().ok()
    }

    /// A picture from rows as the GPU leaves them: colours multiplied by coverage, and in place of alpha the share
    /// that is seen through.
    pub(super) fn from_see_through_rows(width: u32, height: u32, rows: &[u8], bytes_per_row: u32) -> Self {
        let used = 4 * width as usize;
        let mut pixels = Vec::with_capacity(used * height as usize);
        for row in rows.chunks(bytes_per_row as usize) {
            pixels.extend(row[..used].as_chunks().0.iter().flat_map(|&[r, g, b, through]| {
                let alpha = 255 - through;
                let [r, g, b] = if through == 0 { [r, g, b] } else { [r, g, b].map(|c| undiluted(c, alpha)) };
                [r, g, b, alpha]
            }));
        }
        Self { width, height, pixels }
    }

    /// A picture from rows of encoded colours multiplied by their opacity.
    pub(super) fn from_premultiplied_rows(width: u32, height: u32, rows: &[u8], bytes_per_row: u32) -> Self {
        let used = 4 * width as usize;
        let mut pixels = Vec::with_capacity(used * height as usize);
        for row in rows.chunks(bytes_per_row as usize) {
            pixels.extend(row[..used].as_chunks().0.iter().flat_map(|&[r, g, b, alpha]| {
                let full = u32::from(alpha.max(1));
                let [r, g, b] = [r, g, b].map(|c| ((u32::from(c) * 255 + full / 2) / full).min(255) as u8);
                [r, g, b, alpha]
            }));
        }
        Self { width, height, pixels }
    }

    /// Both pictures side by side, `self` left; the shorter one is continued with its lowest row.
    pub fn beside(&self, right: &RenderedImage) -> RenderedImage {
        let height = self.height.max(right.height);
        let row = |picture: &RenderedImage, y: u32| {
            let width = 4 * picture.width as usize;
            let begin = y.min(picture.height.saturating_sub(1)) as usize * width;
            begin..begin + width
        };
        let mut pixels = Vec::with_capacity(self.pixels.len() + right.pixels.len());
        for y in 0..height {
            pixels.extend_from_slice(&self.pixels[row(self, y)]);
            pixels.extend_from_slice(&right.pixels[row(right, y)]);
        }
        RenderedImage { width: self.width + right.width, height, pixels }
    }

    /// The picture as the bytes of a PNG file, the same bytes every time.
    ///
    /// # Errors
    /// The encoder's.
    pub fn to_png(&self) -> Result<Vec<u8>, RenderError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.pixels)?;
        writer.finish()?;
        Ok(bytes)
    }
}

impl std::fmt::Debug for RenderedImage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "RenderedImage({}×{})", self.width, self.height)
    }
}

/// An sRGB channel that was mixed, in linear light, with black for the uncovered part, without that black.
fn undiluted(channel: u8, alpha: u8) -> u8 {
    if alpha == 0 {
        return 0;
    }
    let linear = linear_from_srgb(f32::from(channel) / 255.0) * 255.0 / f32::from(alpha);
    (srgb_from_linear(linear.min(1.0)) * 255.0).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(width: u32, height: u32, pixel: [u8; 4]) -> RenderedImage {
        RenderedImage { width, height, pixels: pixel.repeat((width * height) as usize) }
    }

    #[test]
    fn half_covered_white_is_white_at_half_alpha() {
        let half_white = (srgb_from_linear(0.5) * 255.0).round() as u8;
        let picture =
            RenderedImage::from_see_through_rows(1, 1, &[half_white, half_white, half_white, 127], 4);
        let [r, g, b, a] = picture.pixel(0, 0).unwrap();
        assert_eq!(a, 128);
        assert!([r, g, b].iter().all(|&c| c >= 254), "{r} {g} {b}");
    }

    #[test]
    fn padding_between_rows_is_left_out() {
        let picture =
            RenderedImage::from_see_through_rows(1, 2, &[1, 2, 3, 0, 9, 9, 9, 9, 4, 5, 6, 0, 9, 9, 9, 9], 8);
        assert_eq!(picture.pixels(), [1, 2, 3, 255, 4, 5, 6, 255]);
    }

    #[test]
    fn pictures_stand_side_by_side() {
        let both = plain(2, 1, [1; 4]).beside(&plain(1, 2, [2; 4]));
        assert_eq!((both.width(), both.height()), (3, 2));
        assert_eq!(both.pixel(1, 1), Some([1; 4]));
        assert_eq!(both.pixel(2, 0), Some([2; 4]));
        assert_eq!(both.pixel(3, 0), None);
    }

    #[test]
    fn a_png_reads_back() {
        let picture = plain(3, 2, [10, 20, 30, 40]);
        let read = crate::picture::decode::decode(&picture.to_png().unwrap()).unwrap();
        assert_eq!((read.width, read.height, read.pixels.as_slice()), (3, 2, picture.pixels()));
    }
}
