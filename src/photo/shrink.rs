//! Photographs scaled down to what they are worked on: means over squares of whole pixels.

use crate::picture::decode::Rgba;
use rayon::prelude::*;
use std::borrow::Cow;

/// The picture with no side longer than `side`, and how many of its pixels are one of those.
pub(super) fn shrunk(picture: &Rgba, side: u32) -> (Cow<'_, Rgba>, u32) {
    let factor = picture.width.max(picture.height).div_ceil(side.max(1)).max(1);
    if factor == 1 {
        return (Cow::Borrowed(picture), 1);
    }
    let (width, height) = (picture.width.div_ceil(factor), picture.height.div_ceil(factor));
    let from = picture.pixels.as_chunks::<4>().0;
    let (wide, step) = (picture.width as usize, factor as usize);
    let pixel = |i: usize| {
        let (x, y) = (i % width as usize * step, i / width as usize * step);
        let rows = (y..(y + step).min(picture.height as usize)).map(|y| &from[y * wide..][..wide]);
        // Transparent pixels have no colour of their own.
        let (mut sum, mut alpha, mut count) = ([0u32; 3], 0u32, 0u32);
        for [r, g, b, a] in rows.flat_map(|row| &row[x..(x + step).min(wide)]) {
            let a = u32::from(*a);
            sum = [sum[0] + a * u32::from(*r), sum[1] + a * u32::from(*g), sum[2] + a * u32::from(*b)];
            alpha += a;
            count += 1;
        }
        let [r, g, b] = sum.map(|c| ((c + alpha / 2) / alpha.max(1)) as u8);
        [r, g, b, ((alpha + count / 2) / count.max(1)) as u8]
    };
    let count = width as usize * height as usize;
    let pixels = (0..count).into_par_iter().with_min_len(1 << 12).flat_map_iter(pixel).collect();
    (Cow::Owned(Rgba { width, height, pixels }), factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_become_their_mean_without_what_is_transparent() {
        let pixels =
            [[10, 0, 0, 255], [30, 0, 0, 255], [50, 0, 0, 255], [90, 0, 0, 0], [20, 0, 0, 255], [7, 7, 7, 0]];
        let picture = Rgba { width: 3, height: 2, pixels: pixels.concat() };
        let (small, factor) = shrunk(&picture, 2);
        assert_eq!((small.width, small.height, factor), (2, 1, 2));
        assert_eq!(small.pixels, [20, 0, 0, 191, 50, 0, 0, 128]);
        assert_eq!(shrunk(&picture, 3), (Cow::Borrowed(&picture), 1));
    }
}
