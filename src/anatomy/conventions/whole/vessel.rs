//! A plain pot: the wide lower part of a drawing that looks like a plant in a pot.
//!
//! The pot ends at the narrowest place of the lower part of the drawing, where only the plant's stem goes through. Lines of
//! which most lies below are the pot; what stands in it stays with the other ways of drawing.
//!
//! Where the plant is nowhere narrower, a closed outline below all others is the pot.
//!
//! Limits: a plant in a stroke with its pot is not parted from it.

use super::view::View;
use crate::anatomy::conventions::Hypothesis;
use crate::anatomy::conventions::beneath::pot::of_lines;
use crate::anatomy::conventions::page::{Line, bounds};

/// Lowest and highest place of the pot's edge, as shares of the height.
const EDGE: (f32, f32) = (0.08, 0.6);
/// Widest stem at the edge, as a share of the pot.
const STEM: f32 = 0.6;
/// Narrowest pot, as a share of the drawing's width.
const WIDE: f32 = 0.2;
/// A pot in one line below all others: least share of its bounds that it fills, upper part of it in which others may begin, how far above
/// the foot of all it may stand, and its least height, as shares of its own height and of the whole's.
const BOX: (f32, f32, f32, f32) = (0.7, 0.35, 0.08, 0.15);
/// Least height of a pot, as a share of its width.
const LOWEST: f32 = 0.25;
/// How far below a pot a line that rises may begin, as a share of its height: what stands on a stem is none.
const UNDER: f32 = 0.3;
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
    let uses = if is_pot { uses } else { vec![boxed(view)?] };
    let (low, high) = bounds(uses.iter().map(|line| &view.page.lines[*line]));
    // Ground is wider.
    let is_high = high.y - low.y > LOWEST * (high.x - low.x);
    let lowest = high.y + UNDER * (high.y - low.y);
    let goes_on = |line: &Line| line.bounds.1.y > lowest && line.size().y > line.size().x;
    let is_lowest = !view.lines.iter().any(|line| goes_on(line));
    (is_high && is_lowest).then(|| of_lines(view.page, uses, score)).flatten()
}

/// The one line below all others that is a pot by itself.
fn boxed(view: &View) -> Option<usize> {
    let size = view.rows.width_and_height();
    let lowest = view.lines.iter().map(|line| line.bounds.1.y).fold(f32::NEG_INFINITY, f32::max);
    let is_box = |line: &Line| {
        let own = line.size();
        let is_low = lowest - line.bounds.1.y < BOX.2 * size.y;
        let is_of_size = (BOX.3..EDGE.1).contains(&(own.y / size.y)) && own.x > WIDE * size.x;
        line.is_closed_and_solid() && line.area > BOX.0 * own.x * own.y && is_low && is_of_size
    };
    let is_above = |line: &Line, sill: f32| {
        line.points.iter().filter(|p| p.y < sill).count() as f32 > BELOW * line.points.len() as f32
    };
    view.own.iter().copied().find(|number| {
        let pot = &view.page.lines[*number];
        let sill = pot.bounds.0.y + BOX.1 * pot.size().y;
        let mut others = view.own.iter().filter(|other| *other != number).map(|i| &view.page.lines[*i]);
        view.own.len() > 1 && is_box(pot) && others.all(|line| is_above(line, sill))
    })
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

    #[test]
    fn a_box_below_a_bush_that_is_nowhere_narrower_is_its_pot() {
        let bush = line(&[(-40.0, -70.0), (-60.0, -150.0), (60.0, -150.0), (40.0, -70.0), (-40.0, -70.0)]);
        let corners = [(-40.0, -72.0), (-38.0, 0.0), (38.0, 0.0), (40.0, -72.0), (-40.0, -72.0)];
        let page = Page::of_lines(&[bush.clone(), line(&corners)]);
        let found = pot(&View::of(&page, vec![0, 1]).unwrap(), 2.0).unwrap();
        assert_eq!((found.uses.as_slice(), found.solids.len()), (&[1][..], 1));
        let page = Page::of_lines(&[bush]);
        assert!(pot(&View::of(&page, vec![0]).unwrap(), 2.0).is_none());
    }

    #[test]
    fn ground_below_a_flower_is_no_pot() {
        let corners = [(-40.0, -120.0), (-30.0, -170.0), (40.0, -165.0), (45.0, -115.0), (-40.0, -120.0)];
        let stem = line(&[(0.0, -115.0), (3.0, -4.0)]);
        let page = Page::of_lines(&[line(&corners), stem, line(&[(-110.0, 0.0), (0.0, -4.0), (110.0, 2.0)])]);
        assert!(pot(&View::of(&page, vec![0, 1, 2]).unwrap(), 2.0).is_none());
    }

    #[test]
    fn what_stands_on_a_stem_is_no_pot() {
        let corners = [(-20.0, -100.0), (-18.0, -70.0), (18.0, -70.0), (20.0, -100.0), (-20.0, -100.0)];
        let petals = line(&[(-4.0, -101.0), (-50.0, -150.0), (0.0, -170.0), (50.0, -150.0), (4.0, -101.0)]);
        let lines = [line(&corners), petals, line(&[(0.0, -70.0), (2.0, -4.0)])];
        let page = Page::of_lines(&lines[..2]);
        assert!(pot(&View::of(&page, vec![0, 1]).unwrap(), 2.0).is_some());
        let page = Page::of_lines(&lines);
        assert!(pot(&View::of(&page, vec![0, 1, 2]).unwrap(), 2.0).is_none());
    }
}
