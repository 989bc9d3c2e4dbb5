//! Bark from a photograph: a square patch, evenly lit, that tiles without seams.
//!
//! Light: what changes slowly over the patch is taken from its colours, by the share that the parameters say. Tiling: the patch's
//! right end is laid over its left one, and where both overlap they are joined along the line where they differ least (the
//! minimum-error boundary cut of Efros and Freeman, *Image quilting*, 2001), softened by a few pixels; then the same for its
//! lower end. The second cut ends where it began, so that it is whole across the first.
//!
//! Limits: what there is once on the patch, such as a knot, repeats with every tile.

use super::PhotoParams;
use super::blade_photo::usable;
use super::error::PhotoError;
use super::lab::{Lab, lab_of, srgb_of};
use super::raster::Raster;
use super::windows::window_means;
use crate::picture::decode::Rgba;
use glam::UVec2;

crate::parameters! {
    /// The texture that is made of a photograph of bark.
    pub struct BarkParams {
        /// Longest side of the tile; a smaller photograph gives a smaller one.
        side: u32 = 1024, 16..=4096, "texels";
        /// How far the ends of the patch lie over each other.
        overlap: f32 = 0.2, 0.05..=0.45, "of the patch";
        /// How much of the light's slow changes is taken away.
        even: f32 = 1.0, 0.0..=1.0, "";
        /// What changes within this is light, and what changes faster is bark.
        light: f32 = 0.35, 0.05..=1.0, "of the patch";
    }
}

/// How far the two sides of a cut are mixed, as a share of the overlap.
const SOFT: f32 = 0.08;

/// What comes of a photograph of bark.
#[derive(Clone, Debug, PartialEq)]
pub struct BarkPhoto {
    /// The tile.
    pub texture: Rgba,
    /// How much its ends differ where tiles meet, against what neighbouring pixels differ elsewhere; 1 is no seam at all.
    pub seam: f32,
    /// The same of the patch as it was photographed.
    pub seam_before: f32,
}

impl BarkPhoto {
    /// Makes a tile of the middle of a photograph.
    ///
    /// # Errors
    /// A photograph that is too small.
    pub fn of_photograph(picture: &Rgba, params: &PhotoParams) -> Result<Self, PhotoError> {
        let bark = &params.bark;
        let patch = picture.width.min(picture.height) as f32 * (1.0 - bark.overlap);
        let factor = (patch / bark.side as f32).ceil().max(1.0) as u32;
        let (small, _) = usable(picture, picture.width.max(picture.height).div_ceil(factor))?;
        let side = small.width.min(small.height);
        let corner = (UVec2::new(small.width, small.height) - side) / 2;
        let mut lab = lab_of(&small).cropped(corner, UVec2::splat(side));
        even_light(&mut lab, bark);
        let overlap = ((bark.overlap * side as f32).round() as usize).max(2);
        let tile = joined(&joined(&lab, overlap, false).turned(), overlap, true).turned();
        let pixels = tile.cells().iter().flat_map(|colour| {
            let [r, g, b] = srgb_of(*colour);
            [r, g, b, 255]
        });
        let texture =
            Rgba { width: tile.width() as u32, height: tile.height() as u32, pixels: pixels.collect() };
        Ok(Self { texture, seam: seam_of(&tile), seam_before: seam_of(&lab) })
    }
}

/// Takes slow changes from all channels.
fn even_light(lab: &mut Raster<Lab>, params: &BarkParams) {
    // Three boxes one after the other are nearly a bell.
    let reach = ((params.light * lab.width() as f32 / 6.0).round() as usize).max(1);
    for channel in 0..3 {
        let mut slow = lab.map(|colour| colour[channel]);
        for _ in 0..3 {
            slow = window_means(&slow, reach);
        }
        let mean = slow.cells().iter().map(|c| f64::from(*c)).sum::<f64>() / slow.cells().len() as f64;
        for (colour, slow) in lab.cells_mut().iter_mut().zip(slow.cells()) {
            colour[channel] -= params.even * (slow - mean as f32);
        }
    }
    lab.cells_mut().iter_mut().for_each(|colour| colour.x = colour.x.clamp(0.0, 100.0));
}

/// The patch without its last `overlap` columns, which are laid over its first ones. A closed cut ends where it began.
fn joined(patch: &Raster<Lab>, overlap: usize, closed: bool) -> Raster<Lab> {
    let (width, height) = (patch.width() - overlap, patch.height());
    let costs: Vec<Vec<f32>> = (0..height)
        .map(|y| (0..overlap).map(|x| patch[(x, y)].distance_squared(patch[(x + width, y)])).collect())
        .collect();
    let cut = cheapest_path(&costs, closed);
    let soft = (SOFT * overlap as f32).max(0.5);
    let mut cells = Vec::with_capacity(width * height);
    for (y, cut) in cut.into_iter().enumerate() {
        cells.extend((0..width).map(|x| {
            if x >= overlap {
                return patch[(x, y)];
            }
            // Both ends of the overlap are one side only, so that what comes before and after them goes on.
            let soft = soft.min(cut as f32 + 0.5).min((overlap - cut) as f32 - 0.5).max(0.5);
            let share = (0.5 + 0.5 * (x as f32 + 0.5 - cut as f32 - 0.5) / soft).clamp(0.0, 1.0);
            patch[(x + width, y)].lerp(patch[(x, y)], share)
        }));
    }
    Raster::new(width, cells)
}

/// For every row the column through which the cheapest path from the first to the last row goes, at most one column aside in
/// every step. It stays away from both ends. A closed path could go on at its begin.
fn cheapest_path(costs: &[Vec<f32>], closed: bool) -> Vec<usize> {
    let open = path_from(costs, None);
    if closed { path_from(costs, open.first().copied()) } else { open }
}

fn path_from(costs: &[Vec<f32>], start: Option<usize>) -> Vec<usize> {
    let width = costs[0].len();
    let inner = 1..(width - 1).max(2).min(width);
    let usable = |x: usize| inner.contains(&x);
    let begin = |x: usize| usable(x) && start.is_none_or(|start| x == start);
    let mut sums: Vec<f64> =
        (0..width).map(|x| if begin(x) { f64::from(costs[0][x]) } else { f64::INFINITY }).collect();
    let mut steps: Vec<Vec<usize>> = Vec::with_capacity(costs.len());
    for row in &costs[1..] {
        let from = |x: usize| {
            let near = x.saturating_sub(1)..(x + 2).min(width);
            near.min_by(|a, b| sums[*a].total_cmp(&sums[*b])).unwrap_or(x)
        };
        let step: Vec<usize> = (0..width).map(from).collect();
        let next = |x: usize| if usable(x) { sums[step[x]] + f64::from(row[x]) } else { f64::INFINITY };
        sums = (0..width).map(next).collect();
        steps.push(step);
    }
    let ends = |x: &usize| usable(*x) && start.is_none_or(|start| x.abs_diff(start) <= 1);
    let mut at = (0..width).filter(ends).min_by(|a, b| sums[*a].total_cmp(&sums[*b])).unwrap_or(width / 2);
    let mut path = vec![at];
    for step in steps.iter().rev() {
        at = step[at];
        path.push(at);
    }
    path.reverse();
    path
}

/// How much opposite ends differ against neighbouring columns and rows within, the worse of both directions.
fn seam_of(tile: &Raster<Lab>) -> f32 {
    let across = |tile: &Raster<Lab>| {
        let (width, height) = (tile.width(), tile.height());
        let differs = |a: usize, b: usize| {
            (0..height).map(|y| f64::from(tile[(a, y)].distance(tile[(b, y)]))).sum::<f64>()
        };
        let within: f64 = (1..width).map(|x| differs(x - 1, x)).sum::<f64>() / (width - 1).max(1) as f64;
        let seam = differs(width - 1, 0);
        if within > 0.0 {
            (seam / within) as f32
        } else if seam > 0.0 {
            f32::MAX
        } else {
            1.0
        }
    };
    across(tile).max(across(&tile.turned()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bark that is darker to the right, with a grain that no tile has.
    fn photograph(width: u32, height: u32) -> Rgba {
        let mut pixels = Vec::new();
        for y in 0..height {
            for x in 0..width {
                let (x, y) = (x as f32, y as f32);
                let grain = (0.13 * x + 1.7 * (0.021 * y).sin()).sin() + 0.6 * (0.31 * x - 0.05 * y).sin();
                let l = 120.0 + 25.0 * grain - 60.0 * x / width as f32;
                pixels.extend([l as u8, (0.8 * l) as u8, (0.6 * l) as u8, 255]);
            }
        }
        Rgba { width, height, pixels }
    }

    #[test]
    fn tiles_meet_without_a_seam() {
        let made = BarkPhoto::of_photograph(&photograph(420, 333), &PhotoParams::default()).unwrap();
        let side = 333 - (0.2f32 * 333.0).round() as u32;
        assert_eq!((made.texture.width, made.texture.height), (side, side));
        assert!(made.seam < 1.3 && made.seam_before > 2.5, "{} of {}", made.seam, made.seam_before);
    }

    #[test]
    fn the_light_is_even() {
        let made = BarkPhoto::of_photograph(&photograph(400, 400), &PhotoParams::default()).unwrap();
        let half = |right: bool| {
            let side = made.texture.width as usize;
            let cells = made.texture.pixels.as_chunks::<4>().0.iter().enumerate();
            let own = cells.filter(|(i, _)| (i % side >= side / 2) == right).map(|(_, p)| f64::from(p[0]));
            own.sum::<f64>() / (side * side / 2) as f64
        };
        assert!((half(true) - half(false)).abs() < 8.0, "{} and {}", half(false), half(true));
    }

    #[test]
    fn large_ones_become_smaller_and_small_ones_are_refused() {
        let params =
            PhotoParams { bark: BarkParams { side: 64, ..Default::default() }, ..Default::default() };
        let made = BarkPhoto::of_photograph(&photograph(500, 400), &params).unwrap();
        assert!(made.texture.width <= 64 && made.texture.width > 40);
        let tiny = BarkPhoto::of_photograph(&photograph(9, 400), &params);
        assert!(matches!(tiny, Err(PhotoError::TooSmall { width: 9, .. })));
        let grey = Rgba { width: 40, height: 40, pixels: vec![99; 6400] };
        assert_eq!(BarkPhoto::of_photograph(&grey, &params).unwrap().seam, 1.0);
    }

    #[test]
    fn a_closed_path_ends_where_it_began() {
        let costs: Vec<Vec<f32>> =
            (0..40).map(|y| (0..9).map(|x| (x as f32 - 1.0 - 0.15 * y as f32).abs()).collect()).collect();
        let (open, closed) = (cheapest_path(&costs, false), cheapest_path(&costs, true));
        assert!(open[39] > open[0] + 3 && closed[39].abs_diff(closed[0]) <= 1);
        assert!(closed.windows(2).all(|w| w[0].abs_diff(w[1]) <= 1));
    }
}
