//! What is around a plant at every height: sky, hills and ground run across a photograph in rows.
//!
//! What the left or the right border shows at a height is likely around the plant at that height, too, even where it is so little of the
//! whole border that no mixture of all its colours knows it: a line of hills, a hedge. Each side is a small mixture for every few rows and
//! those next to them.
//!
//! Limits: a camera held askew tilts the rows; beyond a few percent they say nothing any more.

use super::super::lab::Lab;
use super::super::raster::Raster;
use super::mixture::Mixture;
use std::ops::Range;

/// Rows that share their mixtures; rows of as many blocks above and below are known by as well.
const BLOCK: usize = 8;
/// Distributions of a mixture.
const PARTS: usize = 2;
/// How much less sure a row is than all surroundings, nats.
const LESS_SURE: f32 = 1.0;

/// Mixtures of what the left and the right border show, for every block of rows.
pub(super) struct Rows {
    width: usize,
    sides: Vec<Vec<Mixture>>,
}

impl Rows {
    /// What pixels say that are known as surroundings and lie within so many columns of the picture's left or right side.
    pub(super) fn of(lab: &Raster<Lab>, is_around: impl Fn(usize) -> bool, band: usize) -> Self {
        let (width, height) = (lab.width(), lab.height());
        let colours = |rows: Range<usize>, columns: Range<usize>| -> Vec<(Lab, f32)> {
            let places = rows.flat_map(|y| columns.clone().map(move |x| y * width + x));
            places.filter(|i| is_around(*i)).map(|i| (lab.cells()[i], 1.0)).collect()
        };
        let sides = |block: usize| {
            let from = (block * BLOCK).saturating_sub(BLOCK);
            let rows = from..((block + 2) * BLOCK).min(height);
            [0..band.min(width), width.saturating_sub(band)..width]
                .into_iter()
                .filter_map(|columns| Mixture::of(&colours(rows.clone(), columns), PARTS))
                .collect()
        };
        Self { width, sides: (0..height.div_ceil(BLOCK)).map(sides).collect() }
    }

    /// How unlikely a pixel's colour is at its height.
    pub(super) fn cost(&self, pixel: usize, colour: Lab) -> f32 {
        let sides = &self.sides[pixel / self.width / BLOCK];
        LESS_SURE + sides.iter().map(|side| side.cost(colour)).fold(f32::INFINITY, f32::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{UVec2, Vec3};

    #[test]
    fn a_colour_is_likely_only_at_the_height_at_which_the_border_shows_it() {
        let (sky, hill) = (Vec3::new(75.0, 0.0, -20.0), Vec3::new(45.0, -5.0, 5.0));
        let mut lab = Raster::filled(UVec2::new(60, 120), sky);
        for y in 76..108 {
            (0..60).for_each(|x| lab[(x, y)] = hill);
        }
        let rows = Rows::of(&lab, |i| i % 60 < 4, 4);
        let at = |y: usize, colour| rows.cost(y * 60 + 30, colour);
        assert!(at(90, hill) < 5.0 && at(20, hill) > 40.0);
        assert!(at(20, sky) < 5.0 && at(90, sky) > 40.0);
        let unknown = Rows::of(&lab, |_| false, 4);
        assert_eq!(unknown.cost(0, sky), f32::INFINITY);
    }
}
