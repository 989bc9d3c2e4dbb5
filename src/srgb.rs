//! The sRGB transfer functions (IEC 61966-2-1): encoded values of pictures and colour names to light and back, 0 to 1.

/// Linear light of an encoded value.
pub fn linear_from_srgb(encoded: f32) -> f32 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// Encoded value of linear light.
pub fn srgb_from_linear(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_comes_back() {
        for byte in 0..=u8::MAX {
            let there = linear_from_srgb(f32::from(byte) / 255.0);
            assert_eq!((srgb_from_linear(there) * 255.0).round() as u8, byte);
        }
    }
}
