//! Square cells in rows: how far each is from some, and which hang together.
//!
//! Cost: the number of cells, whatever lies in them; whole rows are worked on at once.

use glam::IVec2;

/// What a step to a cell beside and one to a cell across count, about as long as they are.
const CHAMFER: (u16, u16) = (5, 7);

/// Steps of which [`Grid::distances`] makes one cell.
pub(super) const STEPS: u16 = CHAMFER.0;

/// A grid of at least three by three cells, named by their places row by row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    width: usize,
    height: usize,
}

impl Grid {
    /// One of so many columns and rows.
    pub(super) fn new(size: IVec2) -> Self {
        Self { width: size.x.max(3) as usize, height: size.y.max(3) as usize }
    }

    /// How many cells there are.
    pub(super) fn cells(&self) -> usize {
        self.width * self.height
    }

    /// Distance of each cell from the nearest that is a source, [`STEPS`] for a cell, over all eight neighbours: two sweeps
    /// (Borgefors, “Distance transformations in digital images”, 1986). Cells on the rim of the grid count as far away.
    pub(super) fn distances(&self, is_source: impl Fn(usize) -> bool) -> Vec<u16> {
        let far = u16::MAX - CHAMFER.1;
        let mut distances: Vec<u16> = (0..self.cells()).map(|i| if is_source(i) { 0 } else { far }).collect();
        let (width, last) = (self.width, self.width - 1);
        for y in 1..self.height - 1 {
            let (above, row) = distances.split_at_mut(y * width);
            let row = &mut row[..width];
            nearer_over(&above[(y - 1) * width..], row);
            (1..last).for_each(|x| row[x] = row[x].min(row[x - 1] + CHAMFER.0));
        }
        for y in (1..self.height - 1).rev() {
            let (row, below) = distances.split_at_mut((y + 1) * width);
            let row = &mut row[y * width..];
            nearer_over(&below[..width], row);
            (1..last).rev().for_each(|x| row[x] = row[x].min(row[x + 1] + CHAMFER.0));
        }
        distances
    }

    /// Gives a number to each area of open cells that are connected over their sides, from 1 in the order of their first cells, 0 to
    /// cells that are not open; and the number of cells of each area.
    pub(super) fn areas(&self, is_open: impl Fn(usize) -> bool) -> (Vec<u32>, Vec<usize>) {
        let (mut number_of, mut sizes) = (vec![0; self.cells()], Vec::new());
        for first in 0..self.cells() {
            if number_of[first] == 0 && is_open(first) {
                let number = sizes.len() as u32 + 1;
                sizes.push(self.flood(first, &is_open, number, &mut number_of));
            }
        }
        (number_of, sizes)
    }

    /// Whether each cell is connected with one through open cells, over their sides.
    pub(super) fn connected(&self, first: usize, is_open: impl Fn(usize) -> bool) -> Vec<bool> {
        let mut number_of = vec![0; self.cells()];
        self.flood(first, &|i| i == first || is_open(i), 1, &mut number_of);
        number_of.into_iter().map(|number| number == 1).collect()
    }

    /// Gives a number to all open cells without one that are connected with an open cell; how many they are. Goes by stretches of rows.
    fn flood(
        &self,
        first: usize,
        is_open: &impl Fn(usize) -> bool,
        number: u32,
        number_of: &mut [u32],
    ) -> usize {
        let mut count = 0;
        let mut begun = vec![first];
        while let Some(i) = begun.pop() {
            if number_of[i] != 0 {
                continue;
            }
            let row = i - i % self.width..i - i % self.width + self.width;
            let is_new = |i: &usize| number_of[*i] == 0 && is_open(*i);
            let low = (row.start..i).rev().take_while(is_new).last().unwrap_or(i);
            let high = (i + 1..row.end).take_while(is_new).last().unwrap_or(i);
            number_of[low..=high].fill(number);
            count += high + 1 - low;
            let above = low.checked_sub(self.width);
            let below = Some(low + self.width).filter(|_| row.end < self.cells());
            for beside in [above, below].into_iter().flatten() {
                let is_new = |i: &usize| number_of[*i] == 0 && is_open(*i);
                let begins = |i: &usize| is_new(i) && (*i == beside || !is_new(&(i - 1)));
                begun.extend((beside..=beside + (high - low)).filter(begins));
            }
        }
        count
    }
}

/// Brings the inner cells of a row as near as steps from the row beside make them.
fn nearer_over(beside: &[u16], row: &mut [u16]) {
    let inner = row.len() - 1;
    for (here, three) in row[1..inner].iter_mut().zip(beside.windows(3)) {
        let across = three[0].min(three[2]) + CHAMFER.1;
        *here = (*here).min(across).min(three[1] + CHAMFER.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid of letters: what is no dot is open.
    fn grid(rows: &[&str]) -> (Grid, Vec<bool>) {
        let size = IVec2::new(rows[0].len() as i32, rows.len() as i32);
        (Grid::new(size), rows.iter().flat_map(|row| row.bytes().map(|cell| cell != b'.')).collect())
    }

    #[test]
    fn steps_beside_and_across_add_up() {
        let grid = Grid::new(IVec2::new(9, 7));
        let distances = grid.distances(|i| i == 2 * 9 + 2);
        for (i, distance) in distances.into_iter().enumerate() {
            let (x, y) = ((i % 9).abs_diff(2) as u16, (i / 9).abs_diff(2) as u16);
            let is_inner = (1..8).contains(&(i % 9)) && (1..6).contains(&(i / 9));
            let expected = 7 * x.min(y) + 5 * (x.max(y) - x.min(y));
            assert_eq!(distance, if is_inner { expected } else { u16::MAX - 7 }, "{i}");
        }
    }

    #[test]
    fn areas_hang_together_over_sides_and_not_over_corners() {
        let (grid, open) = grid(&["aa.b..", ".a.bbb", ".aa..b", "c.a.bb", "cc.d.."]);
        let (numbers, sizes) = grid.areas(|i| open[i]);
        assert_eq!(sizes, [6, 7, 3, 1]);
        assert_eq!(numbers[2 * 6 + 2], 1);
        assert_eq!(numbers[3 * 6 + 4], 2);
        assert_eq!(grid.connected(0, |i| open[i]).into_iter().filter(|is| *is).count(), 6);
    }
}
