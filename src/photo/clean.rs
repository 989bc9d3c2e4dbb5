//! A photograph of a petal made into paint: creases out, contrast even, noise smoothed (003 §2.1).
//!
//! Contrast: lightness is stretched so that its 2nd and 98th percentile over the petal come nearer to black and white, by the
//! share that the parameters say. Noise: a bilateral filter (Tomasi and Manduchi 1998), which smooths what differs little and
//! keeps edges, along rows and then along columns, which hardly differs (Pham and van Vliet 2005); of a large window it looks at
//! a few pixels only, so that the work is that of the picture whatever its size.
//! Only pixels of the petal itself take part.

use super::crease::{self, CreaseSize};
use super::lab::Lab;
use super::raster::Raster;
use rayon::prelude::*;

crate::parameters! {
    /// How the picture of a petal or leaf is cleaned.
    pub struct CleanParams {
        /// Whether creases are painted over. Left out for leaves, whose midribs look like them, unless it is set.
        creases: bool = true, 0..=1, "";
        /// Shortest crease.
        crease_length: f32 = 0.15, 0.02..=1.0, "of the size";
        /// Broadest crease.
        crease_width: f32 = 0.02, 0.002..=0.1, "of the size";
        /// Least difference of a crease's lightness from its surroundings, of 100.
        crease_depth: f32 = 4.0, 1.0..=50.0, "";
        /// How far lightness is stretched to all that there is from black to white.
        contrast: f32 = 0.3, 0.0..=1.0, "";
        /// Percentile of lightness that becomes black.
        darkest: f32 = 2.0, 0.0..=45.0, "percent";
        /// Percentile of lightness that becomes white.
        lightest: f32 = 98.0, 55.0..=100.0, "percent";
        /// Standard deviation of the blur; 0 for none.
        blur: f32 = 0.002, 0.0..=0.02, "of the size";
        /// How different colours may be and still flow together, CIE 1976.
        blur_colour: f32 = 6.0, 0.5..=50.0, "";
    }
}

/// Most that lightness is stretched, so that noise stays noise.
const MOST_STRETCH: f32 = 3.0;
/// Most pixels to each side that the blur looks at; of a larger window it looks at so many, evenly apart.
const LOOKS: usize = 5;

/// What was done.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cleaned {
    /// Creases painted over.
    pub creases: usize,
    /// The percentiles of lightness before it was stretched, 0 to 100.
    pub lightness: [f32; 2],
}

/// Cleans the colours of a petal `size` pixels large; `trusted` are the pixels that show nothing else.
pub(super) fn clean(
    lab: &mut Raster<Lab>,
    trusted: &Raster<bool>,
    size: f32,
    params: &CleanParams,
) -> Cleaned {
    let crease = CreaseSize {
        length: params.crease_length * size,
        width: params.crease_width * size,
        depth: params.crease_depth,
    };
    let creases = if params.creases { crease::remove(lab, trusted, crease) } else { 0 };
    let lightness = stretch(lab, trusted, params);
    blur(lab, trusted, params.blur * size, params.blur_colour);
    Cleaned { creases, lightness }
}

/// Stretches lightness; gives the percentiles that it had.
fn stretch(lab: &mut Raster<Lab>, trusted: &Raster<bool>, params: &CleanParams) -> [f32; 2] {
    let inside = lab.cells().iter().zip(trusted.cells()).filter(|(_, is_in)| **is_in);
    let mut all: Vec<f32> = inside.map(|(colour, _)| colour.x).collect();
    if all.is_empty() {
        return [0.0; 2];
    }
    let mut percentile = |percent: f32| {
        let place = (percent / 100.0 * (all.len() - 1) as f32).round() as usize;
        *all.select_nth_unstable_by(place, f32::total_cmp).1
    };
    let [low, high] = [percentile(params.darkest), percentile(params.lightest)];
    let gain = (100.0 / (high - low).max(f32::MIN_POSITIVE)).min(MOST_STRETCH);
    // Where not all can be used, what there is stays in the middle of where it would be.
    let room = 100.0 - gain * (high - low);
    let rest = room * low / (low + 100.0 - high).max(f32::MIN_POSITIVE);
    let stretched = |l: f32| (rest + gain * (l - low)).clamp(0.0, 100.0);
    lab.cells_mut().par_iter_mut().with_min_len(1 << 14).for_each(|colour| {
        colour.x += params.contrast * (stretched(colour.x) - colour.x);
    });
    [low, high]
}

/// Smooths what differs little.
fn blur(lab: &mut Raster<Lab>, trusted: &Raster<bool>, spread: f32, colour: f32) {
    let reach = (2.0 * spread).ceil() as usize;
    if spread < 0.2 {
        return;
    }
    let step = reach.div_ceil(LOOKS).max(1);
    let near = |k: usize| (-0.5 * ((k * step) as f32 / spread).powi(2)).exp();
    let near: Vec<f32> = (0..=reach / step).map(near).collect();
    let rows = |lab: &Raster<Lab>, trusted: &Raster<bool>| {
        let width = lab.width();
        let mut cells = lab.cells().to_vec();
        let lines = lab.cells().par_chunks_exact(width).zip(trusted.cells().par_chunks_exact(width));
        cells.par_chunks_exact_mut(width).zip(lines).for_each(|(out, (line, is_in))| {
            for x in (0..width).filter(|x| is_in[*x]) {
                out[x] = bilateral((line, is_in), x, (&near, step), colour);
            }
        });
        Raster::new(width, cells)
    };
    let along = rows(lab, trusted).turned();
    *lab = rows(&along, &trusted.turned()).turned();
}

/// The mean around a pixel of a line, by nearness in place, which is given for every step away from it, and in colour.
fn bilateral((line, is_in): (&[Lab], &[bool]), x: usize, (near, step): (&[f32], usize), colour: f32) -> Lab {
    let (mut sum, mut weight) = (line[x], 1.0);
    for (k, near) in near.iter().enumerate().skip(1) {
        let sides = [x.checked_sub(k * step), Some(x + k * step)];
        for other in sides.into_iter().flatten().filter(|other| is_in.get(*other) == Some(&true)) {
            let off = line[other].distance_squared(line[x]) / (colour * colour);
            // A bell with a foot: (1 − t/4)² instead of e^(−t/2), 0 beyond two deviations.
            let alike = (1.0 - 0.25 * off).max(0.0);
            let share = near * alike * alike;
            sum += line[other] * share;
            weight += share;
        }
    }
    sum / weight
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{UVec2, Vec3};

    fn noisy(step: f32) -> Raster<Lab> {
        let mut state = 5u32;
        let mut lab = Raster::filled(UVec2::splat(80), Vec3::ZERO);
        for i in 0..lab.cells().len() {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let noise = (state >> 8) as f32 / (1 << 24) as f32 - 0.5;
            let side = if lab.middle(i).x < 40.0 { 0.0 } else { step };
            lab.cells_mut()[i] = Vec3::new(40.0 + side + 4.0 * noise, 10.0, 20.0);
        }
        lab
    }

    fn roughness(lab: &Raster<Lab>) -> f32 {
        let differences = (0..80).flat_map(|y| (0..30).map(move |x| (x, y)));
        let sum: f32 = differences.map(|(x, y)| (lab[(x, y)].x - lab[(x + 1, y)].x).abs()).sum();
        sum / 2400.0
    }

    #[test]
    fn noise_is_smoothed_and_edges_stay() {
        let mut lab = noisy(30.0);
        let (before, all) = (roughness(&lab), lab.map(|_| true));
        blur(&mut lab, &all, 2.0, 8.0);
        assert!(roughness(&lab) < 0.4 * before);
        assert!(lab[(40, 40)].x - lab[(39, 40)].x > 25.0);
    }

    #[test]
    fn percentiles_come_nearer_to_black_and_white() {
        let params = CleanParams { contrast: 1.0, ..CleanParams::default() };
        let mut lab = noisy(40.0);
        let all = lab.map(|_| true);
        let [low, high] = stretch(&mut lab, &all, &params);
        assert!((38.0..40.0).contains(&low) && (80.0..82.0).contains(&high), "{low} {high}");
        let (least, most) = lab.cells().iter().fold((f32::MAX, 0.0f32), |(a, b), c| (a.min(c.x), b.max(c.x)));
        assert!(least < 3.0 && most > 97.0 && least >= 0.0 && most <= 100.0);
        let mut flat = Raster::filled(UVec2::splat(4), Vec3::new(70.0, 1.0, 2.0));
        stretch(&mut flat, &Raster::filled(UVec2::splat(4), true), &params);
        assert!((flat[(0, 0)].x - 70.0).abs() < 1e-3, "one lightness stays: {}", flat[(0, 0)]);
        let mut half = noisy(40.0);
        stretch(&mut half, &all, &CleanParams { contrast: 0.0, ..params });
        assert_eq!(half, noisy(40.0));
    }

    #[test]
    fn what_is_beside_the_petal_takes_no_part() {
        let mut lab = noisy(3.0);
        let mut trusted = lab.map(|_| true);
        for y in 0..80 {
            for x in 40..80 {
                trusted[(x, y)] = false;
                lab[(x, y)] = Vec3::new(43.0, 200.0, 0.0);
            }
        }
        clean(&mut lab, &trusted, 400.0, &CleanParams::default());
        assert!((0..40).all(|x| (lab[(x, 40)].y - 10.0).abs() < 1e-3));
    }
}
