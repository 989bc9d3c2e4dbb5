//! The trunk of a drawn tree: a narrow stretch with two sides, below something wide.
//!
//! Lines are looked at row by row from below ([`Rows`]). A trunk is at most [`NECK`] as wide as the widest row above it, and ends
//! where its width has gone [`SHOULDER`] of the way from its narrowest to that. Its centre line runs in the middle of its sides
//! and keeps their distance as the drawn width; lines of the ground that leave it at its foot do not count, and where it flares
//! into roots it widens by half at most ([`without_roots`]): a trunk that is as thick as its roots reach looks like a bottle.
//!
//! Limits: rows are level, so a trunk that leans by more than half a right angle is not found; of several trunks under one crown
//! the outer sides count.

use super::trunk_foot::{plumb, without_roots};
use super::trunk_sides::TrunkSides;
use crate::anatomy::conventions::Made;
use crate::anatomy::conventions::page::{Line, median};
use glam::Vec2;

/// Rows that lines are divided into.
const ROWS: usize = 120;
/// Columns in which a row knows of ink.
const COLUMNS: u32 = u64::BITS;
/// Widest narrow stretch of a trunk, as a share of the widest row above it.
const NECK: f32 = 0.62;
/// How far the width goes from the trunk's to the crown's where the trunk ends.
const SHOULDER: f32 = 0.35;
/// Highest place at which the second side of a trunk begins, as a share of the height.
const UNEVEN: f32 = 0.3;
/// Least share of a trunk's rows that have two sides.
const TWO_SIDED: f32 = 0.75;
/// Narrowest trunk of two sides, as a share of the height.
const NARROWEST: f32 = 0.025;
/// Width half way up and near the top of what is no trunk, but the lower tip of an outline, in its least width; and shortest trunk,
/// in widths.
const WIDENS: (f32, f32) = (1.9, 2.0);
const STUB: f32 = 0.75;
/// A trunk may widen toward its crown if it is a column up to such a share of its length: so wide there at most, in its least width.
const COLUMN: (f32, f32) = (0.5, 1.5);
/// Shortest and longest trunk, as shares of the height.
const TRUNK: (f32, f32) = (0.12, 0.85);
/// Most pieces of ink in a row of a trunk, and width, as a share of the widest row, up to which a scribble may have more: several
/// stems side by side are no trunk.
const RUNS: u32 = 3;
const SCRIBBLED: f32 = 0.3;
/// Height below and above a crown's beginning, as a share of the whole, in which the width grows so many times if it is a jump, and
/// above what widens from a column.
const JUMP: (f32, f32, f32) = (0.06, 1.35, 0.1);
/// How far beside the sides of a trunk, in its widths, what is drawn higher up is no side of it any more.
const BESIDE: f32 = 0.5;
/// How far a side of the trunk may go outward for each step down and up: steeper lines are ground, or crown.
const STEEP: (f32, f32) = (0.6, 0.6);
/// Half width of a trunk that is one line, as a share of the tree's height.
const LINE: f32 = 0.02;
/// How far up in the crown the trunk goes on, as a share of the crown's height, and its width there, as a share.
const INTO_CROWN: (f32, f32) = (0.45, 0.35);

/// Leftmost and rightmost ink of each row, from below.
pub(crate) struct Rows {
    /// Lower edge of the lowest row, and height of a row, pixels.
    foot: f32,
    step: f32,
    ends: Vec<(f32, f32)>,
    /// The places of the columns, of which there are [`COLUMNS`] across, with ink in each row.
    ink: Vec<u64>,
}

/// A trunk, row by row from below: the middle and half the distance of its sides.
#[derive(Clone)]
pub(crate) struct Trunk {
    rows: Vec<(Vec2, f32)>,
    /// Half its width where it is narrowest, pixels.
    pub narrow: f32,
    /// Height of the row below the crown.
    pub top: f32,
    /// The ends of that row.
    pub sill: (Vec2, Vec2),
    /// Whether the crown begins with a jump of the width.
    pub is_sharp: bool,
}

impl Rows {
    /// The rows of these lines; none where they have no height.
    pub(crate) fn new(lines: &[&Line]) -> Option<Self> {
        let foot = lines.iter().map(|line| line.bounds.1.y).reduce(f32::max)?;
        let top = lines.iter().map(|line| line.bounds.0.y).reduce(f32::min)?;
        let step = (foot - top) / ROWS as f32;
        if step <= 0.0 {
            return None;
        }
        let left = lines.iter().map(|line| line.bounds.0.x).reduce(f32::min)?;
        let right = lines.iter().map(|line| line.bounds.1.x).reduce(f32::max)?;
        let column = ((right - left) / COLUMNS as f32).max(f32::MIN_POSITIVE);
        let (mut ends, mut ink) = (vec![(f32::INFINITY, f32::NEG_INFINITY); ROWS], vec![0; ROWS]);
        for pair in lines.iter().flat_map(|line| line.points.windows(2)) {
            let pieces = (2.0 * pair[0].distance(pair[1]) / step).ceil().max(1.0) as usize;
            for k in 0..=pieces {
                let p = pair[0].lerp(pair[1], k as f32 / pieces as f32);
                let row = (((foot - p.y) / step) as usize).min(ROWS - 1);
                ends[row] = (ends[row].0.min(p.x), ends[row].1.max(p.x));
                ink[row] |= 1_u64 << (((p.x - left) / column) as u32).min(COLUMNS - 1);
            }
        }
        Some(Self { foot, step, ends, ink })
    }

    /// Width and height of the whole, pixels.
    pub(crate) fn width_and_height(&self) -> Vec2 {
        let empty = (f32::INFINITY, f32::NEG_INFINITY);
        let (left, right) = self.ends.iter().fold(empty, |all, row| (all.0.min(row.0), all.1.max(row.1)));
        Vec2::new(right - left, self.height())
    }

    /// Height of all rows, pixels.
    pub(crate) fn height(&self) -> f32 {
        self.step * ROWS as f32
    }

    /// Left end, right end and height of each row from below; of one without ink, those of the row below it.
    pub(crate) fn ends(&self) -> impl Iterator<Item = (f32, f32, f32)> {
        let mut last = (0.0, 0.0);
        (0..ROWS).map(move |row| {
            if self.ends[row].0 <= self.ends[row].1 {
                last = self.ends[row];
            }
            (last.0, last.1, self.height_of(row))
        })
    }

    fn width(&self, row: usize) -> f32 {
        (self.ends[row].1 - self.ends[row].0).max(0.0)
    }

    /// Whether both sides of something are drawn in a row, and not only one line.
    fn has_two_sides(&self, row: usize) -> bool {
        let ink = self.ink[row];
        let has_gap = ink != 0
            && (ink >> ink.trailing_zeros()).trailing_ones()
                < u64::BITS - ink.leading_zeros() - ink.trailing_zeros();
        has_gap && self.width(row) > NARROWEST * self.height()
    }

    fn height_of(&self, row: usize) -> f32 {
        self.foot - (row as f32 + 0.5) * self.step
    }

    /// The narrow stretch below, if the drawing has one, up to where the crown begins, also if that is open there.
    pub(crate) fn trunk(&self) -> Option<Trunk> {
        self.trunk_up_to(|neck, shoulder| self.leaves_its_sides(neck, shoulder).unwrap_or(shoulder))
    }

    /// The same up to where what is drawn is much wider, whatever lies between.
    pub(crate) fn trunk_to_shoulder(&self) -> Option<Trunk> {
        self.trunk_up_to(|_, shoulder| shoulder)
    }

    fn trunk_up_to(&self, end: impl Fn(usize, usize) -> usize) -> Option<Trunk> {
        let has_sides = |row: &usize| self.has_two_sides(*row);
        // Sides seldom end at one height; what has one side only, below, is the foot of the longer.
        let foot = (0..rows(UNEVEN)).find(has_sides)?;
        let candidates = (foot + rows(0.03)..rows(TRUNK.1)).filter(has_sides);
        // Single rows may be narrow by chance, where lines of the ground or hooks of the hand end.
        let around =
            |row: usize| (row.saturating_sub(2)..=(row + 2).min(ROWS - 1)).map(|row| self.width(row));
        let widest = |row: usize| around(row).fold(0.0, f32::max);
        let neck = candidates.min_by(|a, b| widest(*a).total_cmp(&widest(*b)))?;
        let narrow = self.width(neck);
        let wide = (neck..ROWS).map(|row| self.width(row)).fold(0.0, f32::max);
        let most = narrow + SHOULDER * (wide - narrow);
        let shoulder = (neck..ROWS).find(|row| self.width(*row) > most)?;
        let top = end(neck, shoulder);
        let is_long = (TRUNK.0..=TRUNK.1).contains(&(top as f32 / ROWS as f32));
        let two_sided = (0..top).filter(has_sides).count() as f32;
        if narrow > NECK * wide || !is_long || two_sided < TWO_SIDED * top as f32 {
            return None;
        }
        let is_column = self.width(foot + (COLUMN.0 * (top - foot) as f32) as usize) < COLUMN.1 * narrow;
        if self.is_tip(neck, top) && !is_column || ((top - foot) as f32) * self.step < STUB * narrow {
            return None;
        }
        if narrow > SCRIBBLED * wide && self.most_runs(neck, top) > RUNS {
            return None;
        }
        let at = |x| Vec2::new(x, self.height_of(top - 1));
        Some(Trunk {
            rows: self.sides(neck, top),
            narrow: 0.5 * narrow,
            top: self.height_of(top - 1),
            sill: (at(self.ends[top - 1].0), at(self.ends[top - 1].1)),
            // What goes on beside the trunk is no longer it.
            is_sharp: top < shoulder || self.jumps(neck, top, is_column),
        })
    }

    /// The row above the last one with two sides below which all ink is far beside these: one side of a crown that is open there.
    fn leaves_its_sides(&self, neck: usize, end: usize) -> Option<usize> {
        let mut last = neck;
        for row in neck..end {
            let (own, known) = (self.ends[row], self.ends[last]);
            let slack = BESIDE * self.width(last);
            if self.has_two_sides(row) {
                last = row;
            } else if own.0 <= own.1 && (own.1 < known.0 - slack || own.0 > known.1 + slack) {
                return Some(last + 1);
            }
        }
        None
    }

    /// What stands below the row `top`, whatever its form: a trunk of two sides, or of one line.
    pub(crate) fn below(&self, top: usize) -> Trunk {
        let ends: Vec<(f32, f32, f32)> = self.ends().take(top.max(1)).collect();
        let mut halves: Vec<f32> = ends.iter().map(|(left, right, _)| 0.5 * (right - left)).collect();
        let middle = halves.len() / 2;
        // Lines of the ground and ends of the head are wider, rows that one side lacks narrower.
        let half = halves.select_nth_unstable_by(middle, f32::total_cmp).1.max(LINE * self.height());
        let row = |(left, right, y): &(f32, f32, f32)| {
            (Vec2::new(0.5 * (left + right), *y), (0.5 * (right - left)).clamp(0.7 * half, 1.3 * half))
        };
        let rows = evened(&ends.iter().map(row).collect::<Vec<_>>());
        let narrow = rows.iter().map(|row| row.1).fold(f32::INFINITY, f32::min);
        let (last, half) = rows[rows.len() - 1];
        let sill = (last - half * Vec2::X, last + half * Vec2::X);
        Trunk { rows, narrow, top: last.y, sill, is_sharp: true }
    }

    /// Whether the width grows all the way from its narrowest row to the row `top`: the lower tip of an outline.
    fn is_tip(&self, neck: usize, top: usize) -> bool {
        let upper = self.width(top.saturating_sub(rows(JUMP.0)).max(neck));
        let narrow = self.width(neck);
        self.width(neck.midpoint(top)) > WIDENS.0 * narrow && upper > WIDENS.1 * narrow
    }

    /// How many separate pieces of ink half of these rows have at least.
    fn most_runs(&self, first: usize, end: usize) -> u32 {
        // A run ends where ink has none on its left.
        let mut runs: Vec<u32> =
            self.ink[first..end].iter().map(|ink| (ink & !(ink << 1)).count_ones()).collect();
        let middle = runs.len() / 2;
        if runs.is_empty() { 0 } else { *runs.select_nth_unstable(middle).1 }
    }

    /// Whether the width jumps where a crown begins at the row `top`.
    fn jumps(&self, neck: usize, top: usize, is_column: bool) -> bool {
        let reach = if is_column { JUMP.2 } else { JUMP.0 };
        let above = (top..ROWS.min(top + rows(reach))).map(|row| self.width(row)).fold(0.0, f32::max);
        let below = self.width(top.saturating_sub(rows(JUMP.0)).max(neck));
        above > JUMP.1 * below
    }

    /// Middle and half width of a trunk at each row from the lowest to the one below `top`. From the neck, where both sides are
    /// known to be the trunk's, each side is followed up and down as far as it does not turn away ([`STEEP`]): there the crown
    /// begins, or the line of the ground.
    fn sides(&self, neck: usize, top: usize) -> Vec<(Vec2, f32)> {
        let follow = |rows: &mut dyn Iterator<Item = usize>, steep: f32| -> Vec<(usize, f32, f32)> {
            let (mut left, mut right) = self.ends[neck];
            let out = steep * self.step;
            rows.map(|row| {
                let (l, r) = self.ends[row];
                if r - l > 0.6 * (right - left) {
                    left = l.clamp(left - out, left + out);
                    right = r.clamp(right - out, right + out);
                }
                (row, 0.5 * (left + right), 0.5 * (right - left))
            })
            .collect()
        };
        let mut rows = follow(&mut (0..neck).rev(), STEEP.0);
        rows.reverse();
        rows.extend(follow(&mut (neck..top), STEEP.1));
        let rows = rows.into_iter().map(|(row, x, half)| (Vec2::new(x, self.height_of(row)), half));
        without_roots(&upright(&evened(&rows.collect::<Vec<_>>())))
    }
}

/// Rows from below with the thickness across the trunk, where level rows cut one that leans.
fn upright(rows: &[(Vec2, f32)]) -> Vec<(Vec2, f32)> {
    let reach = (rows.len() / 6).max(1);
    let lean = |i: usize| rows[(i + reach).min(rows.len() - 1)].0 - rows[i.saturating_sub(reach)].0;
    let across = |i: usize| lean(i).try_normalize().map_or(1.0, |along| along.y.abs());
    rows.iter().enumerate().map(|(i, row)| (row.0, row.1 * across(i))).collect()
}

/// So many rows as this share of the whole.
fn rows(share: f32) -> usize {
    (share * ROWS as f32) as usize
}

impl Trunk {
    /// The trunk between two sides.
    pub(crate) fn of_sides(sides: &TrunkSides) -> Option<Self> {
        let rows = sides.rows().to_vec();
        let (top, half) = *rows.last()?;
        let narrow = rows.iter().map(|row| row.1).fold(f32::INFINITY, f32::min);
        let before = rows[rows.len().saturating_sub(4)].0;
        let aside = half * (top - before).normalize_or(Vec2::NEG_Y).perp();
        let (a, b) = (top - aside, top + aside);
        let sill = if a.x < b.x { (a, b) } else { (b, a) };
        Some(Self { rows, narrow, top: top.y, sill, is_sharp: true })
    }

    /// Middles and half widths from below, pixels.
    pub(crate) fn rows(&self) -> &[(Vec2, f32)] {
        &self.rows
    }

    /// That of one line from its foot up, thin, below a height; the whole tree is so high.
    pub(crate) fn of_line(line: &[Vec2], below: f32, height: f32) -> Option<Self> {
        let half = LINE * height;
        let rows: Vec<(Vec2, f32)> = line.iter().take_while(|p| p.y > below).map(|p| (*p, half)).collect();
        let top = rows.last()?.0;
        let sill = (top - half * Vec2::X, top + half * Vec2::X);
        Some(Self { rows, narrow: half, top: top.y, sill, is_sharp: true })
    }

    /// Where its middle is in its upper half, to the right, pixels; the outermost rows know of the crown's ends.
    pub(crate) fn axis(&self) -> f32 {
        let rows = self.rows.len();
        let mut middles: Vec<f32> = self.rows[rows / 2..rows - rows / 10].iter().map(|row| row.0.x).collect();
        if middles.is_empty() {
            return 0.5 * (self.sill.0.x + self.sill.1.x);
        }
        median(&mut middles)
    }

    /// From its foot to its top, pixels.
    pub(crate) fn height(&self) -> f32 {
        self.rows.first().map_or(0.0, |row| row.0.y - self.top)
    }

    /// Area between its sides if it were nowhere thicker than at its narrowest, pixels².
    pub(crate) fn least_area(&self) -> f32 {
        self.rows.windows(2).map(|pair| 2.0 * self.narrow * (pair[0].0.y - pair[1].0.y).abs()).sum()
    }

    /// The middle of the trunk, which goes on into the crown, with its width as pressure.
    pub(crate) fn centre_line(&self, crown: &[Vec2]) -> Made {
        let top = crown.iter().map(|p| p.y).fold(self.top, f32::min);
        let mut rows = plumb(self.rows.clone());
        let (last, half) = rows[rows.len() - 1];
        let middle = crown.iter().sum::<Vec2>() / crown.len().max(1) as f32;
        let end = Vec2::new(last.x + 0.5 * (middle.x - last.x), last.y + INTO_CROWN.0 * (top - last.y));
        rows.extend((1..=12).map(|k| {
            let share = k as f32 / 12.0;
            (last.lerp(end, share), half * (1.0 + share * (INTO_CROWN.1 - 1.0)))
        }));
        Made::thick(rows)
    }
}

/// Middles and widths without the jitter of single rows: running means over a tenth of the trunk.
fn evened(rows: &[(Vec2, f32)]) -> Vec<(Vec2, f32)> {
    let reach = (rows.len() / 20).max(2);
    (0..rows.len())
        .map(|i| {
            let near = i.min(rows.len() - 1 - i).min(reach);
            let window = &rows[i - near..=i + near];
            let count = window.len() as f32;
            (
                window.iter().map(|row| row.0).sum::<Vec2>() / count,
                window.iter().map(|row| row.1).sum::<f32>() / count,
            )
        })
        .collect()
}
