//! Sets of cells of a grid: what lies near them, what hangs together, how deep each lies.
//!
//! A cell is a bit, so that 64 of a row are worked on at once: a set is widened by shifting rows over one another, an area is
//! filled by stretches of rows. Distances go from cell to cell over all eight neighbours (Borgefors, “Distance transformations
//! in digital images”, 1986), and what is near by them is an octagon.
//!
//! Cost: rows times words of 64 cells; of widening also times how far; of filling also times how often the area turns back up or
//! down.

use glam::IVec2;

/// What a step to a cell beside and one to a cell across count, about as long as they are.
const CHAMFER: (u16, u16) = (5, 7);

/// Steps of all distances that make one cell.
pub(super) const STEPS: u16 = CHAMFER.0;

const BITS: usize = u64::BITS as usize;

/// A set of cells of a grid, which are named by column and row, or by their numbers row by row.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cells {
    width: usize,
    height: usize,
    /// The rows, each of [`Cells::words`] words; bits beyond the last column are 0.
    bits: Vec<u64>,
}

impl Cells {
    /// No cell of a grid of so many columns and rows.
    pub(super) fn none(size: IVec2) -> Self {
        let (width, height) = (size.x.max(1) as usize, size.y.max(1) as usize);
        Self { width, height, bits: vec![0; width.div_ceil(BITS) * height] }
    }

    /// Cells of the whole grid.
    pub(super) fn of_grid(&self) -> usize {
        self.width * self.height
    }

    fn words(&self) -> usize {
        self.width.div_ceil(BITS)
    }

    fn row(&self, y: usize) -> &[u64] {
        &self.bits[y * self.words()..(y + 1) * self.words()]
    }

    fn row_mut(&mut self, y: usize) -> &mut [u64] {
        let words = self.words();
        &mut self.bits[y * words..(y + 1) * words]
    }

    /// Word and bit of a cell; none outside of the grid.
    fn bit(&self, at: IVec2) -> Option<(usize, u64)> {
        let (x, y) = (usize::try_from(at.x).ok()?, usize::try_from(at.y).ok()?);
        (x < self.width && y < self.height).then(|| (y * self.words() + x / BITS, 1 << (x % BITS)))
    }

    /// Takes a cell in; there is none outside of the grid.
    pub(super) fn insert(&mut self, at: IVec2) {
        if let Some((word, bit)) = self.bit(at) {
            self.bits[word] |= bit;
        }
    }

    /// Whether a cell is one of these.
    pub(super) fn contains(&self, at: IVec2) -> bool {
        self.bit(at).is_some_and(|(word, bit)| self.bits[word] & bit != 0)
    }

    /// How many they are.
    pub(super) fn count(&self) -> usize {
        self.bits.iter().map(|word| word.count_ones() as usize).sum()
    }

    /// The first of them, row by row.
    pub(super) fn first(&self) -> Option<IVec2> {
        let word = self.bits.iter().position(|word| *word != 0)?;
        let (x, y) = (word % self.words() * BITS, word / self.words());
        Some(IVec2::new((x + self.bits[word].trailing_zeros() as usize) as i32, y as i32))
    }

    /// All other cells of the grid.
    pub(super) fn others(mut self) -> Self {
        self.bits.iter_mut().for_each(|word| *word = !*word);
        self.clear_beyond();
        self
    }

    /// Clears the bits beyond the last column, which are no cells.
    fn clear_beyond(&mut self) {
        let (words, beyond) = (self.words(), self.width % BITS);
        if beyond != 0 {
            self.bits.iter_mut().skip(words - 1).step_by(words).for_each(|word| *word &= (1 << beyond) - 1);
        }
    }

    /// Those that are also in another set of the same grid.
    pub(super) fn and(mut self, other: &Self) -> Self {
        self.bits.iter_mut().zip(&other.bits).for_each(|(word, other)| *word &= other);
        self
    }

    /// Those of two sets of the same grid.
    pub(super) fn or(mut self, other: &Self) -> Self {
        self.bits.iter_mut().zip(&other.bits).for_each(|(word, other)| *word |= other);
        self
    }

    /// All cells that are at most so far from one of these, [`STEPS`] for a cell.
    pub(super) fn widened(&self, reach: u16) -> Self {
        let mut wide = Self { bits: vec![0; self.bits.len()], ..*self };
        let rows_away = usize::from(reach / CHAMFER.0);
        let mut row = Vec::with_capacity(self.words());
        for y in 0..self.height {
            row.clear();
            row.extend_from_slice(self.row(y));
            if row.iter().all(|word| *word == 0) {
                continue;
            }
            // From the farthest rows on, where least of the octagon is, to its own.
            let mut columns = 0;
            for away in (0..=rows_away).rev() {
                let wanted = columns_within(reach, away);
                (columns..wanted).for_each(|_| widen_by_one(&mut row));
                columns = wanted;
                for beside in [y.checked_sub(away), Some(y + away).filter(|row| *row < self.height)] {
                    let into = beside.map(|beside| wide.row_mut(beside)).into_iter().flatten();
                    into.zip(&row).for_each(|(word, new)| *word |= new);
                }
            }
        }
        wide.clear_beyond();
        wide
    }

    /// The cells that can be reached from one of these over the sides of cells of this set.
    pub(super) fn connected(&self, first: IVec2) -> Self {
        let mut reached = Self { bits: vec![0; self.bits.len()], ..*self };
        if !self.contains(first) {
            return reached;
        }
        reached.insert(first);
        let mut rows = vec![first.y as usize];
        while let Some(y) = rows.pop() {
            fill_stretches(self.row(y), reached.row_mut(y));
            for beside in
                [y.checked_sub(1), Some(y + 1).filter(|row| *row < self.height)].into_iter().flatten()
            {
                let mut is_new = false;
                for word in 0..self.words() {
                    let (from, into) = (y * self.words() + word, beside * self.words() + word);
                    let new = reached.bits[from] & self.bits[into] & !reached.bits[into];
                    reached.bits[into] |= new;
                    is_new |= new != 0;
                }
                if is_new {
                    rows.push(beside);
                }
            }
        }
        reached
    }

    /// The largest part that hangs together over the sides of cells, of equals the first.
    pub(super) fn largest_part(&self) -> Self {
        let mut largest = Self { bits: vec![0; self.bits.len()], ..*self };
        let (mut most, mut rest, mut left) = (0, self.clone(), self.count());
        while left > most
            && let Some(first) = rest.first()
        {
            let part = rest.connected(first);
            let count = part.count();
            rest.bits.iter_mut().zip(&part.bits).for_each(|(word, part)| *word &= !part);
            left -= count;
            if count > most {
                (most, largest) = (count, part);
            }
        }
        largest
    }

    /// For all cells of the grid, how far they are from the nearest that is none of these, [`STEPS`] for a cell: two sweeps. None of
    /// them may lie on the rim of the grid.
    pub(super) fn depths(&self) -> Vec<u16> {
        let far = u16::MAX - CHAMFER.1;
        let depth = |word: u64, bit: usize| if word >> bit & 1 == 1 { far } else { 0 };
        let of_row = |y: usize| (0..self.width).map(move |x| depth(self.row(y)[x / BITS], x % BITS));
        let mut depths: Vec<u16> = (0..self.height).flat_map(of_row).collect();
        let (width, last) = (self.width, self.width - 1);
        for y in 1..self.height.max(1) - 1 {
            let (above, row) = depths.split_at_mut(y * width);
            let row = &mut row[..width];
            nearer_over(&above[(y - 1) * width..], row);
            (1..last).for_each(|x| row[x] = row[x].min(row[x - 1] + CHAMFER.0));
        }
        for y in (1..self.height.max(1) - 1).rev() {
            let (row, below) = depths.split_at_mut((y + 1) * width);
            let row = &mut row[y * width..];
            nearer_over(&below[..width], row);
            (1..last).rev().for_each(|x| row[x] = row[x].min(row[x + 1] + CHAMFER.0));
        }
        depths
    }
}

/// How many columns aside a cell so many rows away may be to be near enough.
fn columns_within(reach: u16, rows: usize) -> usize {
    let (beside, across) = (usize::from(CHAMFER.0), usize::from(CHAMFER.1));
    let left = usize::from(reach) - rows * beside;
    // Each step across takes the place of one up or down as long as there are any, then steps beside follow.
    let by_steps_across = left / (across - beside);
    if by_steps_across < rows { by_steps_across } else { rows + (left - rows * (across - beside)) / beside }
}

/// Takes the neighbours on both sides of the cells of a row in.
fn widen_by_one(row: &mut [u64]) {
    let (mut before, last) = (0, row.len() - 1);
    for i in 0..=last {
        let (word, after) = (row[i], if i < last { row[i + 1] } else { 0 });
        row[i] = word | word << 1 | before >> (BITS - 1) | word >> 1 | after << (BITS - 1);
        before = word;
    }
}

/// Takes all cells of a row's open stretches in of which one is reached: the sum of both carries a bit to a stretch's end.
fn fill_stretches(open: &[u64], reached: &mut [u64]) {
    let mut carry = false;
    for (open, reached) in open.iter().zip(&mut *reached) {
        let (sum, first) = open.overflowing_add(*reached);
        let (sum, second) = sum.overflowing_add(u64::from(carry));
        carry = first || second;
        *reached |= (sum ^ open) & open;
    }
    let mut carry = false;
    for (open, reached) in open.iter().zip(reached).rev() {
        let (back, begun) = (open.reverse_bits(), reached.reverse_bits());
        let (sum, first) = back.overflowing_add(begun);
        let (sum, second) = sum.overflowing_add(u64::from(carry));
        carry = first || second;
        *reached |= ((sum ^ back) & back).reverse_bits();
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

    /// A set by letters: what is no dot is one of its cells.
    fn cells(rows: &[&str]) -> Cells {
        let mut cells = Cells::none(IVec2::new(rows[0].len() as i32, rows.len() as i32));
        for (y, row) in rows.iter().enumerate() {
            let is_in = row.bytes().enumerate().filter(|(_, letter)| *letter != b'.');
            is_in.for_each(|(x, _)| cells.insert(IVec2::new(x as i32, y as i32)));
        }
        cells
    }

    fn all(size: IVec2) -> impl Iterator<Item = IVec2> {
        (0..size.y).flat_map(move |y| (0..size.x).map(move |x| IVec2::new(x, y)))
    }

    /// Steps between two cells.
    fn steps(a: IVec2, b: IVec2) -> i32 {
        let away = (a - b).abs();
        7 * away.min_element() + 5 * (away.max_element() - away.min_element())
    }

    /// Cells scattered over grids of one to four words a row.
    fn scattered(width: i32, one_of: i32) -> Cells {
        let size = IVec2::new(width, 23);
        let mut cells = Cells::none(size);
        let is_in = |at: &IVec2| (at.x * 7919 + at.y * 104_729 + at.x * at.y * 31) % one_of == 0;
        all(size).filter(is_in).for_each(|at| cells.insert(at));
        cells
    }

    #[test]
    fn what_is_near_is_an_octagon() {
        for width in [9, 64, 65, 200] {
            let (few, size) = (scattered(width, 97), IVec2::new(width, 23));
            let members: Vec<IVec2> = all(size).filter(|at| few.contains(*at)).collect();
            for reach in [0, 4, 5, 7, 13, 30, 44] {
                let wide = few.widened(reach);
                for at in all(size) {
                    let is_near = members.iter().any(|member| steps(*member, at) <= i32::from(reach));
                    assert_eq!(wide.contains(at), is_near, "{width} {reach} {at}");
                }
            }
        }
    }

    #[test]
    fn depths_count_steps_to_what_is_outside() {
        let mut hole = Cells::none(IVec2::new(70, 9)).others();
        let size = IVec2::new(70, 9);
        let on_rim = |at: &IVec2| at.x == 0 || at.y == 0 || at.x == 69 || at.y == 8;
        let mut rim = Cells::none(size);
        all(size).filter(on_rim).for_each(|at| rim.insert(at));
        hole = hole.and(&rim.others());
        let outside: Vec<IVec2> = all(size).filter(|at| !hole.contains(*at)).collect();
        for (depth, at) in hole.depths().into_iter().zip(all(size)) {
            let nearest = outside.iter().map(|other| steps(*other, at)).min();
            assert_eq!(Some(i32::from(depth)), nearest, "{at}");
        }
    }

    #[test]
    fn parts_hang_together_over_sides_and_not_over_corners() {
        let letters = ["aa.b..", ".a.bbb", ".aa..b", "c.a.bb", "cc.d.."];
        let open = cells(&letters);
        let of = |letter: char| {
            cells(
                &letters.map(|row| row.replace(|other| other != letter, ".")).each_ref().map(String::as_str),
            )
        };
        assert_eq!(open.connected(IVec2::ZERO), of('a'));
        assert_eq!(open.connected(IVec2::new(1, 4)), of('c'));
        assert_eq!(open.connected(IVec2::new(2, 0)).count(), 0);
        assert_eq!(open.largest_part(), of('b'));
        assert_eq!((open.count(), open.first()), (17, Some(IVec2::ZERO)));
    }

    #[test]
    fn a_part_is_filled_however_it_winds() {
        // A way that turns back at every column, across words.
        let wall = |x: i32, y: i32| x % 4 == 1 && y != 0 || x % 4 == 3 && y != 22;
        let size = IVec2::new(150, 23);
        let mut way = Cells::none(size);
        all(size).filter(|at| !wall(at.x, at.y)).for_each(|at| way.insert(at));
        assert_eq!(way.connected(IVec2::new(0, 22)), way);
        let crowd = scattered(150, 2);
        for first in all(size).filter(|at| crowd.contains(*at)).step_by(17) {
            let part = crowd.connected(first);
            let sides = [IVec2::X, IVec2::Y, IVec2::NEG_X, IVec2::NEG_Y];
            for at in all(size).filter(|at| part.contains(*at)) {
                assert!(
                    sides.iter().all(|side| part.contains(at + side) == crowd.contains(at + side)),
                    "{at}"
                );
            }
        }
    }
}
