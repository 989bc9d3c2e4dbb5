//! Things sorted into the cells of a uniform grid by counting: points for finding neighbours, boxes for finding what meets.
//!
//! Building is two passes over the things; those of a cell keep their order, so results do not depend on threads.

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

/// Boxes sorted into every cell that they touch, so that two that meet share a cell.
#[derive(Clone, Debug)]
pub struct Meetings {
    cells: usize,
    sorted: Sorted,
}

impl Meetings {
    /// Sorts boxes, given by their corners, into cells of a width; `None` without boxes.
    pub fn of(boxes: &[(Vec3, Vec3)], cell: f32) -> Option<Self> {
        let (low, high) = boxes.iter().copied().reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))?;
        let grid = Grid::new(low, high, cell);
        let (mut cell_of, mut box_of) = (Vec::new(), Vec::new());
        for (k, (low, high)) in boxes.iter().enumerate() {
            let (first, last) = (grid.place(*low), grid.place(*high));
            for y in first.y..=last.y {
                for z in first.z..=last.z {
                    for x in first.x..=last.x {
                        cell_of.push(grid.number(IVec3::new(x, y, z)) as u32);
                        box_of.push(k as u32);
                    }
                }
            }
        }
        let mut sorted = Sorted::default();
        sorted.sort(grid.len(), &cell_of);
        sorted.items.iter_mut().for_each(|item| *item = box_of[*item as usize]);
        Some(Self { cells: grid.len(), sorted })
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.cells
    }

    /// Every two boxes of a cell, the earlier first. Boxes that share several cells come several times.
    pub fn pairs(&self, cell: usize) -> impl Iterator<Item = (usize, usize)> {
        let items = self.sorted.run(cell, cell);
        let with_later = move |k: usize| items[k + 1..].iter().map(move |j| (items[k] as usize, *j as usize));
        (0..items.len()).flat_map(with_later)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_that_touch_meet_in_some_cell() {
        let cube = |x: f32, side: f32| (Vec3::X * x, Vec3::X * x + Vec3::splat(side));
        let boxes = [cube(0.0, 1.0), cube(0.9, 0.2), cube(5.0, 0.1), cube(4.0, 3.0)];
        let meetings = Meetings::of(&boxes, 0.5).unwrap();
        let mut pairs: Vec<_> = (0..meetings.cells()).flat_map(|cell| meetings.pairs(cell)).collect();
        pairs.sort_unstable();
        pairs.dedup();
        assert!(pairs.contains(&(0, 1)) && pairs.contains(&(2, 3)) && !pairs.contains(&(0, 3)), "{pairs:?}");
        assert!(Meetings::of(&[], 1.0).is_none());
    }

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
