//! How much of every pixel the petal covers, so that its contour runs between pixels.
//!
//! Along the edge a pixel shows petal and background mixed. How much of each follows from its distance from the background's
//! colour, held against the distances near by on both sides: means over a small window, of the petal's inside and of what is
//! surely outside, a shadow there included. Elsewhere coverage is 0 or 1.

use super::raster::Raster;
use super::windows::window_sums;
use rayon::prelude::*;

/// How far from the mask's edge pixels may be mixed.
const MIXED: usize = 2;
/// How far, in pixels, means are taken.
const REACH: usize = 8;

/// The share of each pixel within the mask; `threshold` splits distances where a side is too thin for a mean.
pub(super) fn coverage(distance: &Raster<f32>, threshold: f32, mask: &Raster<bool>) -> Raster<f32> {
    let inside = shrunk(mask, MIXED);
    let outside = shrunk(&mask.map(|is_in| !is_in), MIXED);
    let of = |side: &Raster<bool>| {
        let one = |v: f32| side.cells().iter().map(move |is_in| if *is_in { v } else { 0.0 }).collect();
        let sums = side.cells().iter().zip(distance.cells()).map(|(is_in, d)| if *is_in { *d } else { 0.0 });
        let counts = window_sums(&Raster::new(side.width(), one(1.0)), REACH);
        (window_sums(&Raster::new(side.width(), sums.collect()), REACH), counts)
    };
    let (petal, ground) = (of(&inside), of(&outside));
    let mean = |(sums, counts): &(Raster<f32>, Raster<f32>), i: usize| {
        (counts.cells()[i] >= 3.0).then(|| sums.cells()[i] / counts.cells()[i])
    };
    let share = |i: usize| {
        if inside.cells()[i] || outside.cells()[i] {
            return f32::from(u8::from(inside.cells()[i]));
        }
        let low = mean(&ground, i).filter(|low| *low < threshold).unwrap_or(0.0);
        let high = mean(&petal, i).filter(|high| *high > threshold).unwrap_or(2.0 * threshold - low);
        ((distance.cells()[i] - low) / (high - low).max(f32::MIN_POSITIVE)).clamp(0.0, 1.0)
    };
    let cells = (0..mask.cells().len()).into_par_iter().with_min_len(1 << 14).map(share).collect();
    Raster::new(mask.width(), cells)
}

/// The mask without what is nearer than `by` pixels to its edge, corners counted; the picture's edge is none.
pub(super) fn shrunk(mask: &Raster<bool>, by: usize) -> Raster<bool> {
    let outside = mask.map(|is_in| if *is_in { 0.0 } else { 1.0 });
    window_sums(&outside, by).map(|count| *count < 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::UVec2;

    #[test]
    fn mixed_pixels_have_their_share_whatever_lies_on_either_side() {
        // A petal that fades from left to right beside a ground that is darker below.
        let (mut distance, mut mask) =
            (Raster::filled(UVec2::new(60, 60), 0.0), Raster::filled(UVec2::new(60, 60), false));
        for y in 0..60 {
            for x in 0..60 {
                let share = (30.3 - y as f32).clamp(0.0, 1.0);
                let (petal, ground) = (60.0 - 0.4 * x as f32, 6.0);
                distance[(x, y)] = petal * share + ground * (1.0 - share);
                mask[(x, y)] = distance[(x, y)] > 20.0;
            }
        }
        let share = coverage(&distance, 20.0, &mask);
        for x in [2, 30, 57] {
            assert!((share[(x, 30)] - 0.3).abs() < 0.05, "{} at {x}", share[(x, 30)]);
            assert_eq!((share[(x, 20)], share[(x, 40)]), (1.0, 0.0));
        }
    }
}
