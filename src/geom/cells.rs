//! Points sorted into the cells of a uniform grid by counting, the index behind markers and buds.
//!
//! Building is two passes over the points; points of a cell keep their order, so results do not depend on threads.

use glam::{IVec3, Vec3};

/// Most cells of one grid; a finer grid is made coarser.
const MAX_CELLS: f32 = 4_000_000.0;

/// A grid over a box.
#[derive(Clone, Debug)]
pub struct Grid {
    low: Vec3,
    inverse: f32,
    /// Length of a cell's side, metres.
    pub cell: f32,
    /// Cells along each axis.
    pub size: IVec3,
}

impl Grid {
    /// A grid over the box whose cells are at least `cell` wide.
    pub fn new(low: Vec3, high: Vec3, cell: f32) -> Self {
        let extent = (high - low).max(Vec3::splat(cell * 1e-3));
        let mut cell = cell.max(extent.max_element() * 1e-3).max(f32::MIN_POSITIVE);
        let count = |cell: f32| (extent / cell).floor() + 1.0;
        while count(cell).element_product() > MAX_CELLS {
            cell *= 1.25;
        }
        Self { low, inverse: 1.0 / cell, cell, size: count(cell).as_ivec3() }
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        (self.size.x * self.size.y * self.size.z) as usize
    }

    /// Whether there is no cell; there always is.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// The cell of a point; points outside belong to the nearest cell.
    pub fn place(&self, p: Vec3) -> IVec3 {
        ((p - self.low) * self.inverse).as_ivec3().clamp(IVec3::ZERO, self.size - 1)
    }

    /// Whether a point lies within `reach` cells of the box.
    pub fn is_near(&self, p: Vec3, reach: f32) -> bool {
        let q = (p - self.low) * self.inverse;
        q.cmpge(Vec3::splat(-reach)).all() && q.cmple(self.size.as_vec3() + reach).all()
    }

    /// Number of a cell: cells along x follow each other, then along z, then along y.
    pub fn number(&self, place: IVec3) -> usize {
        ((place.y * self.size.z + place.z) * self.size.x + place.x) as usize
    }

    /// First and last place of the cells that touch a ball.
    pub fn around(&self, p: Vec3, radius: f32) -> (IVec3, IVec3) {
        (self.place(p - radius), self.place(p + radius))
    }
}

/// Items sorted by cell.
#[derive(Clone, Debug, Default)]
pub struct Sorted {
    /// Where the items of each cell begin; one more than there are cells.
    pub starts: Vec<u32>,
    /// Indices of the items.
    pub items: Vec<u32>,
}

impl Sorted {
    /// Sorts items by the numbers of their cells, keeping their order within a cell; memory is used again.
    pub fn sort(&mut self, cells: usize, cell_of: &[u32]) {
        self.starts.clear();
        self.starts.resize(cells + 1, 0);
        cell_of.iter().for_each(|&c| self.starts[c as usize + 1] += 1);
        (0..cells).for_each(|c| self.starts[c + 1] += self.starts[c]);
        self.items.clear();
        self.items.resize(cell_of.len(), 0);
        for (item, &c) in cell_of.iter().enumerate() {
            let next = &mut self.starts[c as usize];
            self.items[*next as usize] = item as u32;
            *next += 1;
        }
        // Every start has moved to the next cell's.
        self.starts.rotate_right(1);
        self.starts[0] = 0;
    }

    /// The items of a run of neighbouring cells.
    pub fn run(&self, first: usize, last: usize) -> &[u32] {
        &self.items[self.starts[first] as usize..self.starts[last + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_stand_in_their_cells_in_order() {
        let mut sorted = Sorted::default();
        sorted.sort(4, &[2, 0, 2, 3, 0]);
        assert_eq!(sorted.items, [1, 4, 0, 2, 3]);
        assert_eq!(sorted.starts, [0, 2, 2, 4, 5]);
        assert_eq!(sorted.run(1, 3), [0, 2, 3]);
    }

    #[test]
    fn a_grid_never_has_too_many_cells() {
        let grid = Grid::new(Vec3::ZERO, Vec3::splat(1000.0), 0.001);
        assert!(grid.len() as f32 <= MAX_CELLS);
        assert_eq!(grid.number(grid.place(Vec3::splat(-5.0))), 0);
        assert_eq!(grid.number(grid.place(Vec3::splat(1e9))), grid.len() - 1);
    }
}
