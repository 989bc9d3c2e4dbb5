//! Colours in Oklab: mixing pigments there keeps gradients clean and lightness even.
//!
//! Source: B. Ottosson, "A perceptual color space for image processing", 2020.

use glam::{Mat3, Vec3};

/// A colour as (lightness, green–red, blue–yellow).
pub(crate) type Lab = Vec3;

const LMS_FROM_RGB: Mat3 = Mat3::from_cols_array(&[
    0.412_221_47,
    0.211_903_5,
    0.088_302_46,
    0.536_332_54,
    0.680_699_5,
    0.281_718_84,
    0.051_445_99,
    0.107_396_96,
    0.629_978_7,
]);
const LAB_FROM_LMS: Mat3 = Mat3::from_cols_array(&[
    0.210_454_26,
    1.977_998_5,
    0.025_904_037,
    0.793_617_8,
    -2.428_592_2,
    0.782_771_77,
    -0.004_072_047,
    0.450_593_7,
    -0.808_675_77,
]);

/// The colour of an sRGB number `0xrrggbb`.
pub(crate) fn hex(rgb: u32) -> Lab {
    let linear = |shift: u32| {
        let c = ((rgb >> shift) & 0xff) as f32 / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    };
    let lms = LMS_FROM_RGB * Vec3::new(linear(16), linear(8), linear(0));
    LAB_FROM_LMS * lms.map(f32::cbrt)
}

/// The nearest sRGB bytes.
pub(crate) fn srgb8(lab: Lab) -> [u8; 3] {
    let lms = LAB_FROM_LMS.inverse() * lab;
    let rgb = LMS_FROM_RGB.inverse() * (lms * lms * lms);
    rgb.to_array().map(|c| {
        let c = c.clamp(0.0, 1.0);
        let c = if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
        (c * 255.0).round() as u8
    })
}

/// `a` with `b` painted over it, `share` from 0 to 1.
pub(crate) fn over(a: Lab, b: Lab, share: f32) -> Lab {
    a.lerp(b, share.clamp(0.0, 1.0))
}

/// `a` made lighter (positive) or darker.
pub(crate) fn lighter(a: Lab, by: f32) -> Lab {
    Lab::new((a.x + by).clamp(0.0, 1.0), a.y, a.z)
}

/// 0 below `from`, 1 above `to`, smooth between.
pub(crate) fn smooth(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
