//! Sums, means and largest values of squares around every pixel, in a time that does not depend on the squares' size.

use super::raster::Raster;
use rayon::prelude::*;
use std::collections::VecDeque;

/// Means over squares of `2 reach + 1` pixels around each pixel, as far as they lie in the picture.
pub(super) fn window_means(raster: &Raster<f32>, reach: usize) -> Raster<f32> {
    let counts = window_sums(&raster.map(|_| 1.0), reach);
    let sums = window_sums(raster, reach);
    let means = sums.cells().iter().zip(counts.cells()).map(|(sum, count)| sum / count);
    Raster::new(raster.width(), means.collect())
}

/// Sums over squares of `2 reach + 1` pixels around each pixel, as far as they lie in the picture. Exact for small whole
/// numbers.
pub(super) fn window_sums(raster: &Raster<f32>, reach: usize) -> Raster<f32> {
    let rows = |raster: &Raster<f32>| {
        let width = raster.width();
        let mut cells = vec![0.0; raster.cells().len()];
        cells.par_chunks_exact_mut(width).zip(raster.cells().par_chunks_exact(width)).for_each(
            |(sums, values)| {
                let mut sum: f64 = values[..reach.min(width)].iter().map(|v| f64::from(*v)).sum();
                for (x, out) in sums.iter_mut().enumerate() {
                    sum += values.get(x + reach).map_or(0.0, |v| f64::from(*v));
                    sum -= (x.checked_sub(reach + 1)).map_or(0.0, |gone| f64::from(values[gone]));
                    *out = sum as f32;
                }
            },
        );
        Raster::new(width, cells)
    };
    rows(&rows(raster).turned()).turned()
}

/// The largest value of a square around every pixel.
pub(super) fn window_max(raster: &Raster<f32>, reach: usize) -> Raster<f32> {
    let rows = |raster: &Raster<f32>| {
        let width = raster.width();
        let mut cells = vec![0.0; raster.cells().len()];
        cells
            .par_chunks_exact_mut(width)
            .zip(raster.cells().par_chunks_exact(width))
            .for_each(|(out, values)| line_max(values, reach, out));
        Raster::new(width, cells)
    };
    rows(&rows(raster).turned()).turned()
}

/// The largest of `2 reach + 1` values around every one, in one pass: the queue holds places of falling values.
fn line_max(values: &[f32], reach: usize, out: &mut [f32]) {
    let mut queue: VecDeque<usize> = VecDeque::new();
    for next in 0..values.len() + reach {
        if let Some(value) = values.get(next) {
            while queue.back().is_some_and(|last| values[*last] <= *value) {
                queue.pop_back();
            }
            queue.push_back(next);
        }
        if let Some(place) = next.checked_sub(reach) {
            while queue.front().is_some_and(|first| first + reach < place) {
                queue.pop_front();
            }
            out[place] = queue.front().map_or(0.0, |first| values[*first]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::UVec2;

    #[test]
    fn windows_are_summed_as_far_as_the_picture_goes() {
        let ones = Raster::filled(UVec2::new(5, 4), 1.0);
        let sums = window_sums(&ones, 1);
        assert_eq!((sums[(0, 0)], sums[(2, 1)], sums[(4, 2)]), (4.0, 9.0, 6.0));
        assert_eq!(window_sums(&ones, 9)[(2, 2)], 20.0);
    }

    #[test]
    fn windows_have_their_largest_value() {
        let values = [3.0, 1.0, 4.0, 1.0, 5.0, 2.0];
        let mut out = [0.0; 6];
        line_max(&values, 1, &mut out);
        assert_eq!(out, [3.0, 4.0, 4.0, 5.0, 5.0, 5.0]);
        line_max(&values, 9, &mut out);
        assert_eq!(out, [5.0; 6]);
    }
}
