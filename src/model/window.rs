//! Which cells of a limb's grid of rings and sides are cut out for what grows on it.
//!
//! Windows of one limb never overlap. A branch whose place is taken gets a narrower window there, or the nearest free cell.

use std::f32::consts::TAU;
use std::ops::Range;

/// Cells of a parent's grid: between rings `rows` and between sides `column` and `column + columns`, modulo the sides.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Window {
    pub(super) rows: Range<usize>,
    pub(super) column: usize,
    pub(super) columns: usize,
}

/// How many columns a window has that is `half_angle` wide on either side.
pub(super) fn columns(half_angle: f32, sides: usize) -> usize {
    ((2.0 * half_angle * sides as f32 / TAU).round() as usize).clamp(1, sides / 2)
}

/// How many rows away a branch looks for free cells.
const FARTHEST: usize = 32;

/// Which cells of a limb's grid are cut out.
#[derive(Default)]
pub(super) struct Cells {
    sides: usize,
    taken: Vec<bool>,
}

impl Cells {
    pub(super) fn clear(&mut self, rows: usize, sides: usize) {
        self.sides = sides;
        self.taken.clear();
        self.taken.resize(rows * sides, false);
    }

    pub(super) fn is_taken(&self, row: usize, column: usize) -> bool {
        self.taken[row * self.sides + column]
    }

    /// Indices of a window's cells.
    fn of(&self, window: &Window) -> impl Iterator<Item = usize> + use<> {
        let (sides, first, columns) = (self.sides, window.column, window.columns);
        window
            .rows
            .clone()
            .flat_map(move |row| (first..first + columns).map(move |c| row * sides + c % sides))
    }

    fn is_free(&self, window: &Window) -> bool {
        self.of(window).all(|cell| !self.taken[cell])
    }

    fn take(&mut self, window: Window) -> Window {
        self.of(&window).for_each(|cell| self.taken[cell] = true);
        window
    }

    /// Cuts a window of `rows` that is `half_angle` wide on either side of `angle`; a smaller one, or one elsewhere, where
    /// those cells are taken; `None` when no cell is left.
    pub(super) fn cut(&mut self, rows: Range<usize>, angle: f32, half_angle: f32) -> Option<Window> {
        let per_side = TAU / self.sides as f32;
        let columns = columns(half_angle, self.sides);
        let middle = angle.rem_euclid(TAU) / per_side;
        let first = |columns: usize| {
            (middle - 0.5 * columns as f32).round().rem_euclid(self.sides as f32) as usize % self.sides
        };
        let wide = Window { rows: rows.clone(), column: first(columns), columns };
        let narrow = Window { column: middle as usize % self.sides, columns: 1, ..wide.clone() };
        if let Some(window) = [wide, narrow].into_iter().find(|window| self.is_free(window)) {
            return Some(self.take(window));
        }
        self.nearest_free(0.5 * (rows.start + rows.end - 1) as f32, middle).map(|window| self.take(window))
    }

    fn nearest_free(&self, row: f32, column: f32) -> Option<Window> {
        let sides = self.sides as f32;
        let off = |cell: usize| {
            let (r, c) = ((cell / self.sides) as f32 - row, (cell % self.sides) as f32 + 0.5 - column);
            let around = (c.abs()).min(sides - c.abs());
            r * r + around * around
        };
        let near = (row as usize).saturating_sub(FARTHEST)
            ..(row as usize + FARTHEST).min(self.taken.len() / self.sides);
        let free = (near.start * self.sides..near.end * self.sides).filter(|cell| !self.taken[*cell]);
        let cell = free.min_by(|a, b| off(*a).total_cmp(&off(*b)))?;
        let row = cell / self.sides;
        Some(Window { rows: row..row + 1, column: cell % self.sides, columns: 1 })
    }
}

impl Window {
    /// The grid points (ring, side) of the rim, counter-clockwise seen from outside, and how far around the window's middle
    /// each lies: a share of a turn, 0 upward; ascending, beginning with the first that is not negative.
    pub(super) fn rim(&self, sides: usize, out: &mut Vec<(usize, usize, f32)>) {
        out.clear();
        let (w, h) = (self.columns, self.rows.len());
        let mut push = |x: usize, y: usize| {
            let (right, up) = (2.0 * x as f32 / w as f32 - 1.0, 2.0 * y as f32 / h as f32 - 1.0);
            let turn = (-right).atan2(up) / TAU;
            out.push((self.rows.start + y, (self.column + x) % sides, turn.rem_euclid(1.0)));
        };
        (0..w).for_each(|x| push(x, 0));
        (0..h).for_each(|y| push(w, y));
        (0..w).for_each(|x| push(w - x, h));
        (0..h).for_each(|y| push(0, h - y));
        let lowest = (0..out.len()).min_by(|a, b| out[*a].2.total_cmp(&out[*b].2)).unwrap_or(0);
        out.rotate_left(lowest);
    }
}
