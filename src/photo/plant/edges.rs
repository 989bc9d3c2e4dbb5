//! Edges of a photograph by Canny's method (1986).
//!
//! Lightness is blurred by a Gaussian of σ 1.4 pixels; Sobel's operator gives its gradient; of the pixels across an edge only the
//! steepest stays; and an edge begins where the gradient is steep and goes on where it is less so: at ¼ and ⅒ of the 99th percentile.
//!
//! Source: Canny, *A computational approach to edge detection*, IEEE PAMI 8(6), 1986; 001 §3.1 takes his edges of photographs.

use super::super::background::quantile;
use super::super::lab::Lab;
use super::super::raster::Raster;
use glam::Vec2;

/// Standard deviation of the blur, pixels, and how far it reaches.
const SIGMA: f32 = 1.4;
const REACH: isize = 4;
/// Shares of the usual steepest gradient at which edges go on and begin.
const WEAK: f32 = 0.1;
const STRONG: f32 = 0.25;
/// The usual steepest gradient: what this share of all pixels does not exceed.
const STEEPEST: f32 = 0.99;
/// tan 22.5°: nearer to an axis than that, a gradient runs along it.
const AXIS: f32 = 0.414_213_56;

/// The edges of a picture.
#[derive(Clone, Debug)]
pub(super) struct Edges {
    /// The gradient of lightness where an edge is, 0 elsewhere; it points to the lighter side.
    gradient: Raster<Vec2>,
}

impl Edges {
    /// Finds all edges.
    pub(super) fn of(lab: &Raster<Lab>) -> Self {
        let grey = lab.map(|colour| colour.x);
        let gradient = sobel(&blurred(&blurred(&grey).turned()).turned());
        let steepness: Vec<f32> = gradient.cells().iter().map(|g| g.length()).collect();
        let most = quantile(steepness, STEEPEST);
        let thin = Raster::new(
            gradient.width(),
            (0..gradient.cells().len())
                .map(|i| if is_ridge(&gradient, i) { gradient.cells()[i] } else { Vec2::ZERO })
                .collect(),
        );
        Self { gradient: connected(thin, WEAK * most, STRONG * most) }
    }

    /// The gradient of the edge at a place, pixels; `None` where there is none.
    pub(super) fn at(&self, place: Vec2) -> Option<Vec2> {
        let cell = place.floor();
        if cell.cmplt(Vec2::ZERO).any() || cell.cmpge(self.gradient.size().as_vec2()).any() {
            return None;
        }
        let gradient = self.gradient[(cell.x as usize, cell.y as usize)];
        (gradient != Vec2::ZERO).then_some(gradient)
    }

    /// The longer side of the picture, pixels.
    pub(super) fn side(&self) -> f32 {
        self.gradient.size().max_element() as f32
    }
}

/// A row after the other; pixels beyond the end are those at the end.
fn blurred(field: &Raster<f32>) -> Raster<f32> {
    let weight = |k: isize| (-0.5 * (k as f32 / SIGMA).powi(2)).exp();
    let sum: f32 = (-REACH..=REACH).map(weight).sum();
    let weights: Vec<f32> = (-REACH..=REACH).map(|k| weight(k) / sum).collect();
    let (width, last) = (field.width(), field.width() as isize - 1);
    let at = |row: &[f32], x: usize| {
        let near = (-REACH..=REACH).map(|k| row[(x as isize + k).clamp(0, last) as usize]);
        near.zip(&weights).map(|(value, weight)| value * weight).sum::<f32>()
    };
    let rows = field.cells().chunks_exact(width);
    Raster::new(width, rows.flat_map(|row| (0..width).map(|x| at(row, x)).collect::<Vec<_>>()).collect())
}

fn sobel(field: &Raster<f32>) -> Raster<Vec2> {
    let (width, height) = (field.width() as isize, field.height() as isize);
    let at = |x: isize, y: isize| field[(x.clamp(0, width - 1) as usize, y.clamp(0, height - 1) as usize)];
    let gradient = |i: usize| {
        let (x, y) = (i as isize % width, i as isize / width);
        let column = |x: isize| at(x, y - 1) + 2.0 * at(x, y) + at(x, y + 1);
        let row = |y: isize| at(x - 1, y) + 2.0 * at(x, y) + at(x + 1, y);
        Vec2::new(column(x + 1) - column(x - 1), row(y + 1) - row(y - 1))
    };
    Raster::new(field.width(), (0..field.cells().len()).map(gradient).collect())
}

/// Whether a pixel is the steepest across its edge.
fn is_ridge(gradient: &Raster<Vec2>, i: usize) -> bool {
    let (width, height) = (gradient.width(), gradient.height());
    let (x, y) = (i % width, i / width);
    if x == 0 || y == 0 || x + 1 == width || y + 1 == height {
        return false;
    }
    let g = gradient.cells()[i];
    let step = if g.y.abs() <= AXIS * g.x.abs() {
        1
    } else if g.x.abs() <= AXIS * g.y.abs() {
        width
    } else if (g.x > 0.0) == (g.y > 0.0) {
        width + 1
    } else {
        width - 1
    };
    let steepness = |i: usize| gradient.cells()[i].length_squared();
    // Of two equally steep neighbours one stays.
    steepness(i) > steepness(i - step) && steepness(i) >= steepness(i + step)
}

/// Strong edges, and weak ones that hang together with them.
fn connected(thin: Raster<Vec2>, weak: f32, strong: f32) -> Raster<Vec2> {
    let mut kept = thin.map(|_| false);
    let is = |i: usize, least: f32| thin.cells()[i].length() >= least.max(f32::MIN_POSITIVE);
    let mut open: Vec<usize> = (0..thin.cells().len()).filter(|i| is(*i, strong)).collect();
    open.iter().for_each(|i| kept.cells_mut()[*i] = true);
    while let Some(pixel) = open.pop() {
        for next in thin.neighbours(pixel, 8).filter(|next| is(*next, weak)) {
            if !std::mem::replace(&mut kept.cells_mut()[next], true) {
                open.push(next);
            }
        }
    }
    let gradient = thin.cells().iter().zip(kept.cells()).map(|(g, kept)| if *kept { *g } else { Vec2::ZERO });
    Raster::new(thin.width(), gradient.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{UVec2, Vec3};

    #[test]
    fn a_bar_has_two_edges_one_pixel_thin_that_face_each_other() {
        let mut lab = Raster::filled(UVec2::new(60, 40), Vec3::new(80.0, 0.0, 0.0));
        for y in 0..40 {
            (20..32).for_each(|x| lab[(x, y)].x = 30.0);
        }
        let edges = Edges::of(&lab);
        let row: Vec<(usize, Vec2)> =
            (0..60).filter_map(|x| Some((x, edges.at(Vec2::new(x as f32 + 0.5, 20.5))?))).collect();
        let [(left, dark), (right, light)] = row[..] else { panic!("{row:?}") };
        assert!((19..=20).contains(&left) && (31..=32).contains(&right), "{left} {right}");
        assert!(dark.x < -10.0 && light.x > 10.0, "{dark} {light}");
        assert_eq!(edges.at(Vec2::new(-1.0, 3.0)), None);
    }

    #[test]
    fn an_even_picture_has_none() {
        let edges = Edges::of(&Raster::filled(UVec2::new(20, 20), Vec3::splat(50.0)));
        assert!((0..400).all(|i| edges.at(Vec2::new((i % 20) as f32, (i / 20) as f32)).is_none()));
    }
}
