//! Colours as the eye tells them apart: CIE L*a*b* under D65, and back to sRGB.
//!
//! L runs from 0 to 100. Distances are plain (CIE 1976). Source: IEC 61966-2-1 and CIE 15:2004.

use super::raster::Raster;
use crate::picture::decode::Rgba;
use crate::srgb::{linear_from_srgb, srgb_from_linear};
use glam::Vec3;
use rayon::prelude::*;

/// A colour: L, a, b.
pub(super) type Lab = Vec3;

/// The white of D65.
const WHITE: Vec3 = Vec3::new(0.950_47, 1.0, 1.088_83);
/// Where the cube root becomes a straight line, and its slope there (CIE: (6/29)³ and 3 (6/29)²).
const KNEE: f32 = 0.008_856_452;
const SLOPE: f32 = 0.128_418_55;

/// The colour of linear light.
pub(super) fn lab_from_linear(rgb: Vec3) -> Lab {
    let xyz = Vec3::new(
        Vec3::new(0.412_456_4, 0.357_576_1, 0.180_437_5).dot(rgb),
        Vec3::new(0.212_672_9, 0.715_152_2, 0.072_175).dot(rgb),
        Vec3::new(0.019_333_9, 0.119_192, 0.950_304_1).dot(rgb),
    );
    let [x, y, z] =
        (xyz / WHITE).to_array().map(|t| if t > KNEE { t.cbrt() } else { t / SLOPE + 4.0 / 29.0 });
    Vec3::new(116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z))
}

/// The colour as sRGB bytes; what no screen shows becomes the nearest value of each channel.
pub(super) fn srgb_of(lab: Lab) -> [u8; 3] {
    let y = (lab.x + 16.0) / 116.0;
    let back = |t: f32| if t > 6.0 / 29.0 { t * t * t } else { SLOPE * (t - 4.0 / 29.0) };
    let xyz = WHITE * Vec3::new(back(y + lab.y / 500.0), back(y), back(y - lab.z / 200.0));
    let rgb = Vec3::new(
        Vec3::new(3.240_454_2, -1.537_138_5, -0.498_531_4).dot(xyz),
        Vec3::new(-0.969_266, 1.876_010_8, 0.041_556).dot(xyz),
        Vec3::new(0.055_643_4, -0.204_025_9, 1.057_225_2).dot(xyz),
    );
    rgb.to_array().map(|c| (srgb_from_linear(c.clamp(0.0, 1.0)) * 255.0).round() as u8)
}

/// A picture's colours, without its alpha.
pub(super) fn lab_of(picture: &Rgba) -> Raster<Lab> {
    let light: [f32; 256] = std::array::from_fn(|byte| linear_from_srgb(byte as f32 / 255.0));
    let pixels = picture.pixels.as_chunks::<4>().0;
    let lab = |[r, g, b, _]: &[u8; 4]| lab_from_linear(Vec3::from([r, g, b].map(|c| light[usize::from(*c)])));
    Raster::new(picture.width as usize, pixels.par_iter().with_min_len(1 << 14).map(lab).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lab(rgb: [u8; 3]) -> Lab {
        let [r, g, b] = rgb;
        lab_of(&Rgba { width: 1, height: 1, pixels: vec![r, g, b, 255] }).cells()[0]
    }

    #[test]
    fn known_colours_have_their_known_numbers() {
        for (rgb, known) in [
            ([255, 255, 255], [100.0, 0.0, 0.0]),
            ([0, 0, 0], [0.0, 0.0, 0.0]),
            ([255, 0, 0], [53.24, 80.09, 67.20]),
            ([0, 128, 0], [46.23, -51.70, 49.90]),
            ([10, 10, 40], [3.93, 8.33, -18.92]),
        ] {
            let off = (lab(rgb) - Vec3::from(known)).length();
            assert!(off < 0.05, "{rgb:?} is {} and not {known:?}", lab(rgb));
        }
    }

    #[test]
    fn every_colour_comes_back() {
        for code in (0..1u32 << 24).step_by(4099) {
            let [_, r, g, b] = code.to_be_bytes();
            let back = srgb_of(lab([r, g, b]));
            assert!([r, g, b].iter().zip(back).all(|(a, b)| a.abs_diff(b) <= 1), "{r} {g} {b}: {back:?}");
        }
    }
}
