//! The two sides of a pot, row by row, and its profile.
//!
//! In each row a pot's sides are the leftmost and the rightmost ink. Where a hand drew one side only below an elliptic rim, the
//! other is the same on the other side of the rim's middle.

use glam::Vec2;

/// Rows of a profile.
pub(crate) const ROWS: usize = 24;
/// Rows from above among which the rim is, and how many rows below have ink on one side at least to be mirrored.
const RIM: usize = 10;
const SIDED: f32 = 0.75;
/// Where a single side is, in half widths of the rim from its middle.
const SIDE: (f32, f32) = (0.4, 1.15);

/// Growth of the width from row to row that is no pot's.
const WIDENS: f32 = 1.06;

/// Leftmost and rightmost ink at a height.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    pub y: f32,
    pub left: f32,
    pub right: f32,
}

impl Row {
    pub(crate) fn width(&self) -> f32 {
        (self.right - self.left).max(0.0)
    }
}

/// The rows of some lines between two corners, from above.
pub(crate) fn rows(lines: &[&[Vec2]], low: Vec2, high: Vec2) -> Vec<Row> {
    let step = ((high.y - low.y) / ROWS as f32).max(f32::MIN_POSITIVE);
    let row =
        |k: usize| Row { y: low.y + (k as f32 + 0.5) * step, left: f32::INFINITY, right: f32::NEG_INFINITY };
    let mut rows: Vec<Row> = (0..ROWS).map(row).collect();
    for pair in lines.iter().flat_map(|line| line.windows(2)) {
        let pieces = (2.0 * pair[0].distance(pair[1]) / step).ceil().max(1.0) as usize;
        for k in 0..=pieces {
            let p = pair[0].lerp(pair[1], k as f32 / pieces as f32);
            let row = &mut rows[(((p.y - low.y) / step) as usize).min(ROWS - 1)];
            (row.left, row.right) = (row.left.min(p.x), row.right.max(p.x));
        }
    }
    rows
}

/// The rows, those with one side completed by the same on the other side, where one side was drawn below a rim.
pub(crate) fn mirrored(mut rows: Vec<Row>) -> Vec<Row> {
    let widest = |rows: &[Row]| rows.iter().map(Row::width).fold(0.0, f32::max);
    let Some(rim) = rows.iter().take(RIM).max_by(|a, b| a.width().total_cmp(&b.width())).copied() else {
        return rows;
    };
    let (axis, half) = (0.5 * (rim.left + rim.right), 0.5 * rim.width());
    // The rim is the widest: what widens below is no side that lacks its other.
    let is_single = |row: &Row| row.y > rim.y && row.left.is_finite() && row.width() < 0.4 * rim.width();
    let side = |row: &Row| (row.left - axis).abs().max((row.right - axis).abs());
    let is_side = |row: &Row| (SIDE.0..SIDE.1).contains(&(side(row) / half));
    let below = rows.iter().filter(|row| row.y > rim.y).count();
    let single = rows.iter().filter(|row| is_single(row)).count();
    let sound = rows.iter().filter(|row| is_single(row) && is_side(row)).count();
    let drawn = rows.iter().filter(|row| row.y > rim.y && row.left.is_finite()).count() as f32;
    let sides_agree = sound == single && drawn > SIDED * below as f32;
    if single == 0 || !sides_agree || widest(&rows) > 1.05 * rim.width() {
        return rows;
    }
    for row in rows.iter_mut().filter(|row| row.y > rim.y && row.left.is_finite()) {
        let reach = side(row).min(SIDE.1 * half);
        (row.left, row.right) = (axis - reach, axis + reach);
    }
    rows
}

/// How many of the uppermost rows are the far edge of an opening that is seen from above, or of one drawn aslant: they widen quickly.
fn seen_from_above(rows: &[Row]) -> usize {
    let is_wider = |pair: &&[Row]| pair[1].width() > WIDENS * pair[0].width();
    let widening = rows.windows(2).take_while(is_wider).count();
    if widening < RIM { widening } else { 0 }
}

/// Half widths and heights from the rim to the bottom: rows in which one side only was drawn are as wide as their neighbours.
pub(crate) fn profile(rows: &[Row]) -> Vec<Vec2> {
    let widest = rows.iter().map(Row::width).fold(0.0, f32::max);
    let is_whole = |row: &&Row| row.width() > 0.4 * widest;
    // The upper rows of an open rim and the lower ones of a round bottom are narrow by perspective or haste.
    let rows = &rows[seen_from_above(rows)..];
    let mut whole: Vec<Vec2> =
        rows.iter().filter(is_whole).map(|row| Vec2::new(0.5 * row.width(), row.y)).collect();
    let even = whole.clone();
    for i in 1..whole.len().saturating_sub(1) {
        whole[i].x = 0.25 * (even[i - 1].x + even[i + 1].x) + 0.5 * even[i].x;
    }
    whole
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(k: usize, half: f32) -> Row {
        Row { y: k as f32, left: -half, right: half }
    }

    #[test]
    fn the_far_edge_of_an_opening_is_left_out_and_the_neck_of_a_vase_stays() {
        let opening = |k: usize| if k < 4 { 30.0 - 4.0 * (4 - k) as f32 } else { 30.0 };
        let pot: Vec<Row> = (0..ROWS).map(|k| row(k, opening(k))).collect();
        assert!(profile(&pot).iter().all(|p| p.x > 28.0) && profile(&pot).len() == ROWS - 4);
        let neck = |k: usize| if k < 6 { 15.0 } else { 30.0 };
        let vase: Vec<Row> = (0..ROWS).map(|k| row(k, neck(k))).collect();
        assert_eq!(profile(&vase)[0], Vec2::new(15.0, 0.0));
    }

    #[test]
    fn one_side_is_mirrored_below_a_rim_only() {
        let single = |k: usize| Row { y: k as f32, left: -25.0, right: -24.0 };
        let rows: Vec<Row> = (0..ROWS).map(|k| if k < 4 { row(k, 30.0) } else { single(k) }).collect();
        assert!(mirrored(rows).iter().skip(4).all(|row| (row.width() - 50.0).abs() < 1e-3));
        let alone: Vec<Row> = (0..ROWS).map(single).collect();
        assert!(mirrored(alone).iter().all(|row| row.width() < 2.0));
    }
}
