//! A picture in another colour: as light and dark in each place as before, beside its mean.
//!
//! Each pixel's luminance (CIE Y of linear sRGB), divided by the mean over what the picture shows, is multiplied onto the
//! wanted colour, so that the whole has that colour in the mean and keeps veins, shadows and alpha. Of a PNG with a palette only
//! the palette is written anew, all its other bytes stay; other pictures become a PNG.
//!
//! Limits: one hue for all; twigs in a picture of a shoot take it too. Light places end at white.

use super::decode::{Rgba, decode};
use crate::srgb::{linear_from_srgb, srgb_from_linear};

/// Lengths of a PNG's signature, and of a chunk's length, name and checksum.
const SIGNATURE: usize = 8;
const WORD: usize = 4;

/// The file of a picture in a colour, linear RGB.
///
/// # Errors
/// A picture that cannot be decoded, in words that follow “it cannot be used:”.
pub fn recoloured(bytes: &[u8], colour: [f32; 3]) -> Result<Vec<u8>, String> {
    let mut picture = decode(bytes)?;
    let mean = mean_luminance(&picture);
    if let Some(palette) = palette_of(bytes) {
        let mut out = bytes.to_vec();
        out[palette.clone()]
            .as_chunks_mut::<3>()
            .0
            .iter_mut()
            .for_each(|rgb| *rgb = toward(*rgb, mean, colour));
        let sum = crc32fast::hash(&out[palette.start - WORD..palette.end]);
        out[palette.end..palette.end + WORD].copy_from_slice(&sum.to_be_bytes());
        return Ok(out);
    }
    for [r, g, b, _] in picture.pixels.as_chunks_mut::<4>().0 {
        [*r, *g, *b] = toward([*r, *g, *b], mean, colour);
    }
    picture.to_png().map_err(|error| error.to_string())
}

fn toward(rgb: [u8; 3], mean: f32, colour: [f32; 3]) -> [u8; 3] {
    let lightness = luminance(rgb) / mean;
    colour.map(|c| (srgb_from_linear((c * lightness).min(1.0)) * 255.0).round() as u8)
}

fn luminance(rgb: [u8; 3]) -> f32 {
    let [r, g, b] = rgb.map(|byte| linear_from_srgb(f32::from(byte) / 255.0));
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// The mean over what is at least half opaque, at least that of a nearly black picture.
fn mean_luminance(picture: &Rgba) -> f32 {
    // A power for each byte of a picture would take longer than its decoding.
    let light: [f64; 256] = std::array::from_fn(|byte| f64::from(linear_from_srgb(byte as f32 / 255.0)));
    let shown = picture.pixels.as_chunks::<4>().0.iter().filter(|pixel| pixel[3] >= 128);
    let (sums, count) = shown.fold(([0.0; 3], 0u32), |(sums, count), &[r, g, b, _]| {
        let [red, green, blue] = sums;
        let sums = [red + light[usize::from(r)], green + light[usize::from(g)], blue + light[usize::from(b)]];
        (sums, count + 1)
    });
    let sum = 0.2126 * sums[0] + 0.7152 * sums[1] + 0.0722 * sums[2];
    ((sum / f64::from(count.max(1))) as f32).max(1e-3)
}

/// Where a PNG of colour type 3 has its palette.
fn palette_of(bytes: &[u8]) -> Option<std::ops::Range<usize>> {
    const COLOUR_TYPE: usize = 25;
    const INDEXED: u8 = 3;
    if *bytes.get(COLOUR_TYPE)? != INDEXED || !bytes.starts_with(b"\x89PNG") {
        return None;
    }
    let mut at = SIGNATURE;
    loop {
        let length = u32::from_be_bytes(*bytes.get(at..)?.first_chunk()?) as usize;
        let data = at + 2 * WORD..(at + 2 * WORD).checked_add(length)?;
        let name = bytes.get(at + WORD..data.start)?;
        if name == b"PLTE" {
            return (data.end + WORD <= bytes.len()).then_some(data);
        }
        at = data.end.checked_add(WORD)?;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const OAK: &[u8] = include_bytes!("../../assets/textures/shoot_oak.png");
    const GOLD: [f32; 3] = [0.6, 0.35, 0.05];

    fn mean_colour(picture: &Rgba) -> [f32; 3] {
        let shown: Vec<_> =
            picture.pixels.as_chunks::<4>().0.iter().filter(|pixel| pixel[3] >= 128).collect();
        std::array::from_fn(|k| {
            shown.iter().map(|pixel| linear_from_srgb(f32::from(pixel[k]) / 255.0)).sum::<f32>()
                / shown.len() as f32
        })
    }

    fn assert_gold(file: &[u8], like: &Rgba) {
        let picture = decode(file).unwrap();
        assert_eq!((picture.width, picture.height), (like.width, like.height));
        let pairs = || picture.pixels.as_chunks::<4>().0.iter().zip(like.pixels.as_chunks::<4>().0);
        assert!(pairs().all(|(new, old)| new[3] == old[3]), "alpha stays");
        let mean = mean_colour(&picture);
        assert!(
            mean.iter().zip(GOLD).all(|(is, wanted)| (is - wanted).abs() < 0.1 * wanted + 0.01),
            "{mean:?}"
        );
        let of = |mean: f32, pixel: &[u8; 4]| luminance([pixel[0], pixel[1], pixel[2]]) / mean;
        let (mean, before) = (mean_luminance(&picture), mean_luminance(like));
        let lightness =
            pairs().filter(|(_, old)| old[3] >= 128).map(|(new, old)| (of(mean, new), of(before, old)));
        // What is brighter may have ended at white.
        let kept: Vec<(f32, f32)> = lightness.filter(|(_, old)| *old < 1.5).collect();
        assert!(kept.iter().any(|(_, old)| *old < 0.5), "there is something dark");
        assert!(kept.iter().all(|(new, old)| (new - old).abs() < 0.1), "as light and dark as before");
    }

    #[test]
    fn a_palette_is_written_anew_and_nothing_else() {
        let old = OAK;
        let new = recoloured(old, GOLD).unwrap();
        assert_eq!(new.len(), old.len());
        assert_gold(&new, &decode(old).unwrap());
    }

    #[test]
    fn other_pictures_become_a_png() {
        let old = decode(OAK).unwrap();
        assert_gold(&recoloured(&old.to_png().unwrap(), GOLD).unwrap(), &old);
    }

    #[test]
    fn damaged_files_are_refused() {
        let old = OAK;
        for end in [0, 8, 20, 33, 45, 200] {
            assert!(recoloured(&old[..end], GOLD).is_err(), "{end}");
        }
    }
}
