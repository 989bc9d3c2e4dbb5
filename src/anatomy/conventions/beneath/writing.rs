//! Words in capitals below or beside a plant: names, signatures, labels.
//!
//! Small lines are looked at from left to right. Those whose bounds are in one level band and follow each other without a wide gap are a
//! row. A row is writing if it is several times as wide as high, of several lines, and most of their length is level or plumb, with enough
//! of both: blades of grass are steep, petals and leaves are round, the strokes of a hatching all lean one way.
//!
//! Limits: small letters and handwriting; words of two letters; words that lean. Cost: a sort and the points of the small lines.

use crate::anatomy::conventions::Hypothesis;
use crate::anatomy::conventions::page::{Line, Page};
use crate::geom::polyline;
use crate::geom::region::Region;
use crate::sketch::Reading;
use glam::Vec2;

/// Largest line of a letter, as a share of the drawing's diagonal, and most lines that are looked at.
const SMALL: f32 = 0.15;
const MOST: usize = 400;
/// Fewest lines of a word.
const FEWEST: usize = 5;
/// Least height of the largest line in a row, as a share of the row's: lines of a row are letters or parts of them.
const EVEN: f32 = 0.6;
/// Widest gap between neighbours, in heights of the row so far, and least width of a row, in its heights.
const GAP: f32 = 1.0;
const WIDE: f32 = 2.0;
/// Greatest slope of what is level, and of what is plumb the other way round.
const AXIS: f32 = 0.36;
/// Least share of the length that is level, that is plumb, and that is either.
const STRAIGHT: (f32, f32, f32) = (0.2, 0.25, 0.62);
/// How near a line comes to a larger one that it grows from, as a share of its size, the share of a row's lines that do so from which it is
/// no writing, and the least height of the larger line over its width: words stand on lines.
const GROWS: (f32, f32, f32) = (0.15, 0.5, 0.2);
/// Log-odds.
const SCORE: f32 = 3.0;

/// Proposes each row of letters.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let is_small = |i: &usize| page.lines[*i].size().length() < SMALL * page.diagonal;
    let mut small: Vec<usize> =
        (0..page.lines.len()).filter(|i| !page.is_apart(*i)).filter(is_small).take(MOST).collect();
    small.sort_by(|a, b| page.lines[*a].bounds.0.x.total_cmp(&page.lines[*b].bounds.0.x));
    let written = rows(page, small).into_iter().filter(|row| row.is_writing(page));
    out.extend(written.map(|row| {
        let mut uses = row.lines;
        uses.sort_unstable();
        Hypothesis::apart(uses, SCORE, Reading::Writing)
    }));
}

/// Lines that follow each other in one level band.
struct Row {
    lines: Vec<usize>,
    low: Vec2,
    high: Vec2,
}

/// Puts lines that come from left to right into rows.
fn rows(page: &Page, lines: Vec<usize>) -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    for i in lines {
        let line = &page.lines[i];
        match rows.iter_mut().rev().find(|row| row.goes_on_with(line)) {
            Some(row) => {
                row.lines.push(i);
                (row.low, row.high) = (row.low.min(line.bounds.0), row.high.max(line.bounds.1));
            }
            None => rows.push(Row { lines: vec![i], low: line.bounds.0, high: line.bounds.1 }),
        }
    }
    rows
}

impl Row {
    fn goes_on_with(&self, line: &Line) -> bool {
        let (low, high) = line.bounds;
        let height = (self.high.y - self.low.y).max(high.y - low.y);
        let all = self.high.y.max(high.y) - self.low.y.min(low.y);
        low.x - self.high.x < GAP * height && all < height / EVEN
    }

    fn is_writing(&self, page: &Page) -> bool {
        let size = self.high - self.low;
        let tallest = self.lines.iter().map(|i| page.lines[*i].size().y).fold(0.0, f32::max);
        self.lines.len() >= FEWEST
            && size.x > WIDE * size.y
            && tallest > EVEN * size.y
            && self.is_of_level_and_plumb_lines(page)
            && !self.is_within_another(page)
            && !self.grows_from_others(page)
    }

    fn is_of_level_and_plumb_lines(&self, page: &Page) -> bool {
        let (mut level, mut plumb, mut all) = (0.0, 0.0, 0.0);
        for pair in self.lines.iter().flat_map(|i| page.lines[*i].points.windows(2)) {
            let way = pair[1] - pair[0];
            let length = way.length();
            all += length;
            level += if way.y.abs() < AXIS * way.x.abs() { length } else { 0.0 };
            plumb += if way.x.abs() < AXIS * way.y.abs() { length } else { 0.0 };
        }
        level > STRAIGHT.0 * all && plumb > STRAIGHT.1 * all && level + plumb > STRAIGHT.2 * all
    }

    /// Whether most of its lines come near larger ones: twigs on their boughs.
    fn grows_from_others(&self, page: &Page) -> bool {
        let is_bough = |line: &&Line| {
            line.size().length() > SMALL * page.diagonal && line.size().y > GROWS.2 * line.size().x
        };
        let boughs: Vec<&Line> = page.lines.iter().filter(is_bough).collect();
        let grows = |line: &Line| {
            let near = GROWS.0 * line.size().length();
            let ends = <[Vec2; 2]>::from(line.ends());
            boughs.iter().any(|bough| {
                let gap =
                    |end: &Vec2| polyline::nearest(&bough.points, *end).map_or(f32::INFINITY, |it| it.0);
                ends.iter().any(|end| gap(end) < near)
            })
        };
        let grown = self.lines.iter().filter(|i| grows(&page.lines[**i])).count();
        grown as f32 >= GROWS.1 * self.lines.len() as f32
    }

    /// Whether a larger line goes around it: what is on a trunk is bark.
    fn is_within_another(&self, page: &Page) -> bool {
        let middle = self.low.midpoint(self.high);
        let goes_around = |line: &Line| {
            line.size().length() > SMALL * page.diagonal && Region::new(line.hull.clone()).contains(middle)
        };
        page.lines.iter().any(goes_around)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::{line, read_by};

    /// A letter of strokes between corners in a square of side 1, `place` its lower left corner.
    fn letter(place: Vec2, strokes: &[&[(f32, f32)]]) -> Vec<Vec<Vec2>> {
        let at = |corners: &[(f32, f32)]| -> Vec<Vec2> {
            corners.iter().map(|(x, y)| place + 20.0 * Vec2::new(0.6 * x, -y)).collect()
        };
        strokes.iter().map(|stroke| at(stroke)).collect()
    }

    /// TREE, from a place on.
    fn tree(place: Vec2) -> Vec<Vec<Vec2>> {
        let e: &[&[(f32, f32)]] =
            &[&[(1.0, 1.0), (0.0, 1.0), (0.0, 0.0), (1.0, 0.0)], &[(0.0, 0.5), (0.8, 0.5)]];
        let t: &[&[(f32, f32)]] = &[&[(0.0, 1.0), (1.0, 1.0)], &[(0.5, 1.0), (0.5, 0.0)]];
        let r: &[&[(f32, f32)]] =
            &[&[(0.0, 0.0), (0.0, 1.0), (0.9, 0.9), (0.8, 0.55), (0.0, 0.5), (1.0, 0.0)]];
        let step = |k: f32| place + Vec2::new(18.0 * k, 0.0);
        [letter(step(0.0), t), letter(step(1.0), r), letter(step(2.0), e), letter(step(3.0), e)].concat()
    }

    /// A stem of this height, with a leaf.
    fn plant() -> Vec<Vec<Vec2>> {
        vec![
            line(&[(0.0, 0.0), (0.0, -260.0)]),
            line(&[(0.0, -100.0), (60.0, -150.0), (70.0, -110.0), (0.0, -100.0)]),
        ]
    }

    fn written(beside: Vec<Vec<Vec2>>) -> Vec<Vec<usize>> {
        let found = read_by(propose, &[plant(), beside].concat());
        found.into_iter().map(|it| it.uses.iter().map(|i| i - 2).collect()).collect()
    }

    #[test]
    fn twigs_in_a_row_on_their_boughs_are_no_writing() {
        let bough = |x: f32| line(&[(x, 0.0), (x + 20.0, -120.0)]);
        let twigs = |x: f32| {
            [line(&[(x + 10.0, -60.0), (x + 10.0, -85.0)]), line(&[(x + 14.0, -80.0), (x + 34.0, -82.0)])]
        };
        let places = [0.0, 40.0, 80.0, 120.0];
        let boughs = || places.into_iter().map(bough);
        let all: Vec<Vec<Vec2>> = boughs().chain(places.into_iter().flat_map(twigs)).collect();
        assert!(read_by(propose, &all).is_empty());
        let far = |line: Vec<Vec2>| line.into_iter().map(|p| p + Vec2::new(220.0, 0.0)).collect();
        let apart = boughs().chain(places.into_iter().flat_map(twigs).map(far)).collect::<Vec<_>>();
        assert_eq!(read_by(propose, &apart).len(), 1, "the same beside them is");
    }

    #[test]
    fn capitals_in_a_row_are_writing() {
        assert_eq!(written(tree(Vec2::new(30.0, 0.0))), [(0..7).collect::<Vec<_>>()]);
        assert_eq!(written(tree(Vec2::new(-30.0, 40.0))).len(), 1, "below");
    }

    #[test]
    fn grass_hatching_and_bark_are_none() {
        let blade = |k: usize| line(&[(30.0 + 8.0 * k as f32, 0.0), (33.0 + 8.0 * k as f32, -22.0)]);
        assert!(written((0..9).map(blade).collect()).is_empty());
        let hatch = |k: usize| line(&[(30.0 + 8.0 * k as f32, 0.0), (46.0 + 8.0 * k as f32, -20.0)]);
        assert!(written((0..9).map(hatch).collect()).is_empty());
        let trunk = line(&[(20.0, 20.0), (20.0, -60.0), (140.0, -60.0), (140.0, 20.0), (20.0, 20.0)]);
        let bark = [vec![trunk], tree(Vec2::new(40.0, 0.0))].concat();
        assert!(written(bark).is_empty());
    }
}
