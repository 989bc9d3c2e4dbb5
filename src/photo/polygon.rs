//! Which pixels lie within a closed line: those whose middle does, by the even-odd rule.

use super::raster::Raster;
use glam::{UVec2, Vec2};

/// The pixels within a closed line, given in pixels of a picture of this size; it may reach beyond the picture.
pub(super) fn filled(line: &[Vec2], size: UVec2) -> Raster<bool> {
    let mut rows: Vec<Vec<f32>> = vec![Vec::new(); size.y as usize];
    for (a, b) in line.iter().zip(line.iter().cycle().skip(1)) {
        let (top, bottom) = if a.y <= b.y { (a, b) } else { (b, a) };
        // A middle of a row at the height of a point counts to one of its two sides.
        let row = |y: f32| ((y - 0.5).ceil().max(0.0) as usize).min(rows.len());
        let (first, last) = (row(top.y), row(bottom.y));
        for (y, crossings) in rows.iter_mut().enumerate().take(last).skip(first) {
            let share = (y as f32 + 0.5 - top.y) / (bottom.y - top.y);
            crossings.push(top.x + (bottom.x - top.x) * share);
        }
    }
    let mut mask = Raster::filled(size, false);
    let width = size.x as usize;
    for (row, crossings) in mask.cells_mut().chunks_exact_mut(width).zip(&mut rows) {
        crossings.sort_by(f32::total_cmp);
        for pair in crossings.as_chunks::<2>().0 {
            let [from, to] = pair.map(|x| ((x - 0.5).ceil().max(0.0) as usize).min(width));
            row[from..to.max(from)].fill(true);
        }
    }
    mask
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn middles_within_are_filled_also_where_the_line_leaves_the_picture() {
        let line = [(-3.0, 1.0), (2.6, 1.0), (2.6, 9.0), (1.4, 9.0), (1.4, 3.0), (-3.0, 3.0)].map(Vec2::from);
        let mask = filled(&line, UVec2::new(4, 4));
        let rows: Vec<String> = mask
            .cells()
            .chunks(4)
            .map(|row| row.iter().map(|is_in| if *is_in { '#' } else { '.' }).collect())
            .collect();
        assert_eq!(rows, ["....", "###.", "###.", ".##."]);
    }

    #[test]
    fn areas_agree() {
        let disc: Vec<Vec2> = (0..200)
            .map(|k| Vec2::splat(50.0) + 40.0 * Vec2::from_angle(k as f32 * std::f32::consts::TAU / 200.0))
            .collect();
        let count = filled(&disc, UVec2::splat(100)).cells().iter().filter(|is_in| **is_in).count();
        assert!((count as f32 - std::f32::consts::PI * 1600.0).abs() < 20.0);
    }
}
