//! How far each pixel's colour is from the background's.
//!
//! The background is what the border of the photograph shows. Light falls off across a table, so each of its Lab channels is a
//! plane over the picture, fitted by least squares to the border's pixels; what of them is far from the plane, such as a stalk
//! that leaves the picture, is left out and the fit repeated. Shadow is background, too: it scales light, and with it the cube
//! roots that Lab is made of, so a ground in shadow lies on the straight line from its colour toward L = −16, a = b = 0, and
//! what counts is the distance from that line. The threshold between background and the rest is Otsu's (1979): the one that
//! separates the distances into two classes with the largest variance between them. What is paler and hangs together with what is
//! beyond it belongs to it as far as it stands out from the border's own grain, for a petal's claw may be nearly white.
//!
//! Limits: the background is one colour, and is seen along most of the border.

use super::lab::Lab;
use super::raster::Raster;
use glam::{Mat3, Vec2, Vec3};
use rayon::prelude::*;

crate::parameters! {
    /// How a petal or leaf is separated from the background.
    pub struct CutoutParams {
        /// Longest side at which photographs are worked on; larger ones are scaled down.
        side: u32 = 2048, 64..=4096, "pixels";
        /// Width of the border that shows the background.
        border: f32 = 0.02, 0.001..=0.2, "of the shorter side";
        /// Share of the light that the deepest shadow on the background takes.
        shadow: f32 = 0.6, 0.0..=0.95, "";
        /// Least difference of colour to the background, CIE 1976.
        contrast: f32 = 6.0, 0.0..=60.0, "";
        /// How far the outline may leave the contour.
        tolerance: f32 = 0.003, 0.0001..=0.05, "of the size";
    }
}

/// Pixels of the border that the fit looks at, at most about so many.
const SAMPLES: usize = 20_000;
/// Times that the fit leaves out what is far and begins anew.
const ROUNDS: usize = 6;
/// Classes of the histogram of distances.
const BINS: usize = 512;

/// How far what is pale must stand out from the border's grain: a multiple of what so large a share of the border does not
/// exceed.
const GRAIN: (f32, f32) = (1.5, 0.95);

/// Distances from the background's colour, and where they are split.
pub(super) struct Split {
    /// Distance of every pixel, ΔE.
    pub(super) distance: Raster<f32>,
    /// What is farther is surely not background.
    pub(super) threshold: f32,
    /// What is farther and hangs together with that is not, either; no more than the threshold.
    pub(super) pale: f32,
    /// Distance between the means of both classes.
    pub(super) contrast: f32,
}

/// Colours over the picture: constant, slope to the right, slope down, in shares of the picture.
struct Plane([Lab; 3]);

impl Plane {
    fn at(&self, share: Vec2) -> Lab {
        self.0[0] + self.0[1] * share.x + self.0[2] * share.y
    }
}

/// Tells the background from the rest.
pub(super) fn split(lab: &Raster<Lab>, params: &CutoutParams) -> Split {
    let samples = border(lab, params.border);
    let plane = fitted(&samples);
    let deepest = (1.0 - params.shadow).cbrt();
    let (width, size) = (lab.width(), lab.size().as_vec2());
    let cells: Vec<f32> = lab
        .cells()
        .par_iter()
        .enumerate()
        .with_min_len(1 << 14)
        .map(|(i, colour)| {
            let at = Vec2::new((i % width) as f32, (i / width) as f32) / size;
            from_ground(*colour, plane.at(at), deepest)
        })
        .collect();
    let (threshold, contrast) = otsu(&cells);
    let grain = samples.iter().map(|(at, colour)| from_ground(*colour, plane.at(*at), deepest)).collect();
    let pale = (GRAIN.0 * quantile(grain, GRAIN.1)).min(threshold);
    Split { distance: Raster::new(width, cells), threshold, pale, contrast }
}

/// Distance from the background's colour in light and in any shadow that is not deeper than the deepest.
fn from_ground(colour: Lab, ground: Lab, deepest: f32) -> f32 {
    let from_black = |colour: Lab| colour + Vec3::X * 16.0;
    let (colour, ground) = (from_black(colour), from_black(ground));
    let share = colour.dot(ground) / ground.length_squared().max(f32::MIN_POSITIVE);
    colour.distance(ground * share.clamp(deepest, 1.0))
}

/// Places, as shares of the picture, and colours of the border, evenly thinned out.
fn border(lab: &Raster<Lab>, width: f32) -> Vec<(Vec2, Lab)> {
    let size = lab.size();
    let band = ((width * size.min_element() as f32).round() as usize).clamp(1, size.min_element() as usize);
    let (right, bottom) = (size.x as usize - band, size.y as usize - band);
    let is_border = |x: usize, y: usize| x < band || x >= right || y < band || y >= bottom;
    let all = (0..size.y as usize).flat_map(|y| {
        // Rows through the middle have pixels of the border at their ends only.
        let middle = if y < band || y >= bottom { 0..0 } else { band..right.max(band) };
        (0..middle.start).chain(middle.end..size.x as usize).map(move |x| (x, y))
    });
    let count = 2 * band * (size.x as usize + size.y as usize);
    let sampled = all.filter(|(x, y)| is_border(*x, *y)).step_by((count / SAMPLES).max(1));
    sampled.map(|(x, y)| (Vec2::new(x as f32, y as f32) / size.as_vec2(), lab[(x, y)])).collect()
}

/// The plane through most of the samples.
fn fitted(samples: &[(Vec2, Lab)]) -> Plane {
    let channel = |c: usize| median(samples.iter().map(|(_, colour)| colour[c]).collect());
    let mut plane = Plane([Vec3::new(channel(0), channel(1), channel(2)), Vec3::ZERO, Vec3::ZERO]);
    for _ in 0..ROUNDS {
        let off = |(at, colour): &(Vec2, Lab)| colour.distance(plane.at(*at));
        // Noise and grain of the ground stay in; what is of another colour does not.
        let limit = 2.5 * median(samples.iter().map(off).collect()) + 1.0;
        let near: Vec<_> = samples.iter().filter(|sample| off(sample) <= limit).collect();
        plane = least_squares(&near).unwrap_or(plane);
    }
    plane
}

fn least_squares(samples: &[&(Vec2, Lab)]) -> Option<Plane> {
    let (mut normal, mut right) = (Mat3::ZERO, [Vec3::ZERO; 3]);
    for (at, colour) in samples {
        let row = Vec3::new(1.0, at.x, at.y);
        normal += Mat3::from_cols(row * row.x, row * row.y, row * row.z);
        (0..3).for_each(|c| right[c] += row * colour[c]);
    }
    let normal = normal * (1.0 / samples.len().max(1) as f32);
    let right = right.map(|row| row / samples.len().max(1) as f32);
    if normal.determinant().abs() < 1e-6 {
        return None;
    }
    let by_channel = Mat3::from_cols_array_2d(&right.map(|row| (normal.inverse() * row).to_array()));
    let [constant, x, y] = [by_channel.row(0), by_channel.row(1), by_channel.row(2)];
    Some(Plane([constant, x, y]))
}

fn median(values: Vec<f32>) -> f32 {
    quantile(values, 0.5)
}

/// The value that a share of all values does not exceed; 0 of none.
pub(super) fn quantile(mut values: Vec<f32>, share: f32) -> f32 {
    let place = (share * values.len() as f32) as usize;
    let place = place.min(values.len().saturating_sub(1));
    if values.is_empty() { 0.0 } else { *values.select_nth_unstable_by(place, f32::total_cmp).1 }
}

/// Otsu's threshold, and the distance between the means of both classes.
fn otsu(values: &[f32]) -> (f32, f32) {
    let most = values.iter().copied().fold(0.0, f32::max).max(f32::MIN_POSITIVE);
    let mut histogram = [0u32; BINS];
    values.iter().for_each(|v| histogram[((v / most * BINS as f32) as usize).min(BINS - 1)] += 1);
    let value = |bin: usize| (bin as f64 + 0.5) / BINS as f64;
    let total: f64 = histogram.iter().enumerate().map(|(bin, n)| f64::from(*n) * value(bin)).sum();
    let (mut below, mut sum, mut best) = (0.0, 0.0, (-1.0, 0, 0, 0.0));
    for (bin, n) in histogram.iter().enumerate().take(BINS - 1) {
        below += f64::from(*n);
        sum += f64::from(*n) * value(bin);
        let above = values.len() as f64 - below;
        if below == 0.0 || above == 0.0 {
            continue;
        }
        let apart = (total - sum) / above - sum / below;
        let between = below * above * apart * apart;
        // Between two classes with nothing in between all thresholds are as good: the middle one is taken.
        if between > best.0 * (1.0 + 1e-12) {
            best = (between, bin, bin, apart);
        } else if between >= best.0 {
            best.2 = bin;
        }
    }
    let middle = 0.5 * (value(best.1) + value(best.2)) + 0.5 / BINS as f64;
    ((middle * f64::from(most)) as f32, (best.3 * f64::from(most)) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::UVec2;

    #[test]
    fn two_classes_are_split_in_the_middle() {
        let values: Vec<f32> =
            (0..900).map(|k| if k % 3 == 0 { 40.0 } else { 2.0 + (k % 5) as f32 }).collect();
        let (threshold, apart) = otsu(&values);
        assert!((10.0..36.0).contains(&threshold) && (apart - 36.0).abs() < 0.2, "{threshold} {apart}");
        assert_eq!(otsu(&[0.0; 9]).1, 0.0);
    }

    #[test]
    fn a_slope_of_light_is_background_and_a_stalk_through_the_border_is_not() {
        let mut lab = Raster::filled(UVec2::new(200, 100), Vec3::ZERO);
        for y in 0..100 {
            for x in 0..200 {
                lab[(x, y)] = Vec3::new(80.0 - 0.2 * x as f32 + 0.1 * y as f32, 2.0, 5.0);
                if (80..110).contains(&x) && y > 30 {
                    lab[(x, y)] = Vec3::new(40.0, -30.0, 30.0);
                }
            }
        }
        let split = split(&lab, &CutoutParams::default());
        let is_far = |x: usize, y: usize| split.distance[(x, y)] > split.threshold;
        assert!(is_far(95, 60) && !is_far(20, 60) && !is_far(180, 20));
        assert!(split.distance[(190, 95)] < 1.0, "{}", split.distance[(190, 95)]);
    }

    #[test]
    fn one_colour_has_no_contrast() {
        let grey = Raster::filled(UVec2::new(30, 30), Vec3::new(50.0, 0.0, 0.0));
        assert!(split(&grey, &CutoutParams::default()).contrast < 1e-3);
    }
}
