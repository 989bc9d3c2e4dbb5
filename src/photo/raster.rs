//! Numbers on a grid of pixels.
//!
//! Places are in pixels of the picture, x right, y down; the middle of the first pixel is at (½, ½).

use glam::{UVec2, Vec2};
use std::ops::{Index, IndexMut};

/// A value for every pixel, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Raster<T> {
    width: usize,
    cells: Vec<T>,
}

impl<T> Raster<T> {
    /// Takes a row after the other; their number is a multiple of `width`, which is not 0.
    pub(super) fn new(width: usize, cells: Vec<T>) -> Self {
        debug_assert!(width > 0 && cells.len().is_multiple_of(width));
        Self { width, cells }
    }

    /// Pixels in a row.
    pub(super) fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub(super) fn height(&self) -> usize {
        self.cells.len() / self.width
    }

    /// Width and height.
    pub(super) fn size(&self) -> UVec2 {
        UVec2::new(self.width as u32, self.height() as u32)
    }

    /// All values, a row after the other.
    pub(super) fn cells(&self) -> &[T] {
        &self.cells
    }

    /// The same, to be changed.
    pub(super) fn cells_mut(&mut self) -> &mut [T] {
        &mut self.cells
    }

    /// The same grid with something else in it.
    pub(super) fn map<U>(&self, f: impl Fn(&T) -> U) -> Raster<U> {
        Raster { width: self.width, cells: self.cells.iter().map(f).collect() }
    }

    /// The middle of the pixel with this index.
    pub(super) fn middle(&self, index: usize) -> Vec2 {
        Vec2::new((index % self.width) as f32 + 0.5, (index / self.width) as f32 + 0.5)
    }

    /// Neighbours of a pixel: the first four share an edge with it, `most` is 4 or 8.
    pub(super) fn neighbours(&self, index: usize, most: usize) -> impl Iterator<Item = usize> + use<T> {
        const AROUND: [(isize, isize); 8] =
            [(0, -1), (-1, 0), (1, 0), (0, 1), (-1, -1), (1, -1), (-1, 1), (1, 1)];
        let (width, height) = (self.width, self.height());
        let (x, y) = (index % width, index / width);
        AROUND[..most].iter().filter_map(move |(dx, dy)| {
            let (x, y) = (x.checked_add_signed(*dx)?, y.checked_add_signed(*dy)?);
            (x < width && y < height).then_some(y * width + x)
        })
    }
}

impl<T: Copy> Raster<T> {
    /// A grid of one value.
    pub(super) fn filled(size: UVec2, value: T) -> Self {
        Self { width: size.x as usize, cells: vec![value; size.x as usize * size.y as usize] }
    }

    /// The part from `low`, `size` large, all of which is in the grid.
    pub(super) fn cropped(&self, low: UVec2, size: UVec2) -> Self {
        let (left, width) = (low.x as usize, size.x as usize);
        let rows = self.cells.chunks_exact(self.width).skip(low.y as usize).take(size.y as usize);
        Self { width, cells: rows.flat_map(|row| &row[left..left + width]).copied().collect() }
    }

    /// Rows become columns.
    pub(super) fn turned(&self) -> Self {
        let height = self.height();
        let mut cells = Vec::with_capacity(self.cells.len());
        for x in 0..self.width {
            cells.extend((0..height).map(|y| self.cells[y * self.width + x]));
        }
        Self { width: height.max(1), cells }
    }
}

impl<T> Index<(usize, usize)> for Raster<T> {
    type Output = T;

    fn index(&self, (x, y): (usize, usize)) -> &T {
        &self.cells[y * self.width + x]
    }
}

impl<T> IndexMut<(usize, usize)> for Raster<T> {
    fn index_mut(&mut self, (x, y): (usize, usize)) -> &mut T {
        &mut self.cells[y * self.width + x]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_and_turns_keep_their_pixels() {
        let raster = Raster::new(3, (0..12).collect::<Vec<i32>>());
        assert_eq!((raster.height(), raster[(2, 1)]), (4, 5));
        assert_eq!(raster.cropped(UVec2::new(1, 1), UVec2::new(2, 2)).cells(), [4, 5, 7, 8]);
        assert_eq!(raster.turned().cells(), [0, 3, 6, 9, 1, 4, 7, 10, 2, 5, 8, 11]);
        assert_eq!(raster.turned().turned(), raster);
    }

    #[test]
    fn corners_have_three_neighbours_of_eight() {
        let raster = Raster::filled(UVec2::new(3, 3), 0);
        assert_eq!(raster.neighbours(0, 8).count(), 3);
        assert_eq!(raster.neighbours(4, 8).count(), 8);
        assert_eq!(raster.neighbours(0, 4).collect::<Vec<_>>(), [1, 3]);
    }
}
