//! A plain pot: the wide lower part of a drawing that looks like a plant in a pot.
//!
//! The pot ends at the narrowest place of the lower part of the drawing, where only the plant's stem goes through. Lines of
//! which most lies below are the pot; what stands in it stays with the other ways of drawing.
//!
//! Limits: a plant that is nowhere narrower than its pot is not parted from it, nor one in a stroke with it.

use super::view::View;
use crate::anatomy::conventions::Hypothesis;
use crate::anatomy::conventions::beneath::pot::of_lines;

/// Lowest and highest place of the pot's edge, as shares of the height.
const EDGE: (f32, f32) = (0.08, 0.6);
/// Widest stem at the edge, as a share of the pot.
const STEM: f32 = 0.6;
/// Narrowest pot, as a share of the drawing's width.
const WIDE: f32 = 0.2;
/// Least share of a line below the edge that is the pot's.
const BELOW: f32 = 0.7;

/// The pot below a plant.
pub(super) fn pot(view: &View, score: f32) -> Option<Hypothesis> {
    let ends: Vec<(f32, f32, f32)> = view.rows.ends().collect();
    let width = |row: usize| ends[row].1 - ends[row].0;
    let rows = |share: f32| (share * ends.len() as f32) as usize;
    let edge = (rows(EDGE.0)..rows(EDGE.1)).min_by(|a, b| width(*a).total_cmp(&width(*b)))?;
    let widest = (0..edge).map(width).fold(0.0, f32::max);
    // The rim is the highest row that is still wide.
    let rim = (0..edge).rev().find(|row| width(*row) > STEM * widest)?;
    let height = ends[rim].2;
    let is_below = |line: &usize| {
        let points = &view.page.lines[*line].points;
        points.iter().filter(|p| p.y > height).count() as f32 > BELOW * points.len() as f32
    };
    let uses: Vec<usize> = view.own.iter().copied().filter(is_below).collect();
    let is_wide = widest > WIDE * view.rows.width_and_height().x;
    let is_pot = is_wide && width(edge) < STEM * widest && !uses.is_empty() && uses.len() < view.own.len();
    is_pot.then(|| of_lines(view.page, uses, score)).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;
    use crate::anatomy::conventions::page::Page;

    #[test]
    fn what_is_below_the_stem_is_the_pot_in_any_number_of_strokes() {
        let stem = line(&[(0.0, -75.0), (2.0, -160.0)]);
        let leaf = line(&[(2.0, -160.0), (40.0, -190.0), (60.0, -230.0), (10.0, -200.0), (2.0, -160.0)]);
        let sides = [line(&[(-45.0, -80.0), (-30.0, 0.0)]), line(&[(46.0, -78.0), (31.0, -2.0)])];
        let bottom = line(&[(-28.0, 2.0), (30.0, 0.0)]);
        let page = Page::of_lines(&[stem.clone(), leaf.clone(), sides[0].clone(), sides[1].clone(), bottom]);
        let pot = pot(&View::of(&page, (0..5).collect()).unwrap(), 2.0).unwrap();
        assert_eq!((pot.uses.as_slice(), pot.solids.len()), (&[2, 3, 4][..], 1));
        let (low, high) = pot.solids[0].bounds();
        assert!((low.x + 45.0).abs() < 5.0 && (high.x - 46.0).abs() < 5.0 && high.y > -6.0, "{low} {high}");
        let page = Page::of_lines(&[stem, leaf]);
        assert!(super::pot(&View::of(&page, vec![0, 1]).unwrap(), 2.0).is_none());
    }
}
