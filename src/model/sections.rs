//! Cross-sections of a blade: how far its margin lies to the right and left of its middle line, and how it is curled there.
//!
//! 000 eq. 5.3 needs the half width at every point's height; a table filled in one walk around the outline answers
//! that in constant time. Where the outline crosses a height several times (lobes), the outermost crossings count.
//!
//! Where we depart: the papers measure from the chord between base and tip; here a bowed blade is measured from the line
//! half way between its margins (`midline`), so that fold, hollow and the painted midrib run down its middle.

use super::midline::Midline;
use super::outline::MarginPoint;

const COUNT: usize = 32;

/// One side of the blade at one height.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct HalfSection {
    /// Distance from the middle line to the margin, 0 where the blade does not reach this side.
    pub(super) width: f32,
    /// Curl of the margin there, −1 to 1.
    pub(super) curl: f32,
}

/// Table of half sections over the blade's height.
#[derive(Clone, Debug)]
pub(super) struct Sections {
    /// Lowest and highest v of the outline.
    pub(super) low: f32,
    pub(super) high: f32,
    /// Largest distance of the margin from the middle line, positive.
    pub(super) widest: f32,
    /// Half way between the margins.
    pub(super) middle: Midline,
    right: [HalfSection; COUNT],
    left: [HalfSection; COUNT],
}

/// A place on the margin: u and curl.
type Margin = (f32, f32);

/// The outermost places of the margin at every height, right and left.
struct Extremes {
    low: f32,
    per_height: f32,
    rows: [[Option<Margin>; 2]; COUNT],
}

impl Extremes {
    fn height(&self, row: usize) -> f32 {
        self.low + (row as f32 + 0.5) / self.per_height
    }

    fn add_edge(&mut self, from: MarginPoint, to: MarginPoint) {
        let (bottom, top) = if from.at.y <= to.at.y { (from, to) } else { (to, from) };
        let rise = top.at.y - bottom.at.y;
        let row = |y: f32| (y - self.low) * self.per_height - 0.5;
        let (first, end) = (rows_below(row(bottom.at.y), false), rows_below(row(top.at.y), true).min(COUNT));
        for k in first..end {
            let share = ((self.height(k) - bottom.at.y) / rise.max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
            let u = bottom.at.x + (top.at.x - bottom.at.x) * share;
            let curl = bottom.curl + (top.curl - bottom.curl) * share;
            let [right, left] = &mut self.rows[k];
            if right.is_none_or(|(known, _)| u > known) {
                *right = Some((u, curl));
            }
            if left.is_none_or(|(known, _)| u < known) {
                *left = Some((u, curl));
            }
        }
    }

    /// Height, middle and width of every section.
    fn sections(&self) -> impl Iterator<Item = (f32, f32, f32)> {
        self.rows.iter().enumerate().filter_map(|(row, ends)| {
            let [Some((right, _)), Some((left, _))] = *ends else { return None };
            Some((self.height(row), 0.5 * (right + left), right - left))
        })
    }
}

impl Sections {
    /// Measures an outline of at least three points whose tip is `tip` high.
    pub(super) fn new(outline: &[MarginPoint], tip: f32) -> Self {
        let (mut low, mut high) = (f32::INFINITY, f32::NEG_INFINITY);
        for point in outline {
            low = low.min(point.at.y);
            high = high.max(point.at.y);
        }
        let per_height = COUNT as f32 / (high - low).max(f32::MIN_POSITIVE);
        let mut extremes = Extremes { low, per_height, rows: [[None; 2]; COUNT] };
        let mut from = outline[outline.len() - 1];
        for &to in outline {
            extremes.add_edge(from, to);
            from = to;
        }
        let middle = Midline::fit(extremes.sections(), tip);
        let half = |row: usize, side: usize, sign: f32| {
            let (u, curl) = extremes.rows[row][side]?;
            let width = sign * (u - middle.at(extremes.height(row)));
            (width > 0.0).then_some(HalfSection { width, curl })
        };
        let widest = outline.iter().map(|point| (point.at.x - middle.at(point.at.y)).abs());
        Self {
            low,
            high,
            widest: widest.fold(f32::MIN_POSITIVE, f32::max),
            middle,
            right: std::array::from_fn(|row| half(row, 0, 1.0).unwrap_or_default()),
            left: std::array::from_fn(|row| half(row, 1, -1.0).unwrap_or_default()),
        }
    }

    fn per_height(&self) -> f32 {
        COUNT as f32 / (self.high - self.low).max(f32::MIN_POSITIVE)
    }

    /// The half section at height `v`, to the right or left of the middle line.
    pub(super) fn at(&self, v: f32, right: bool) -> HalfSection {
        let side = if right { &self.right } else { &self.left };
        let place = ((v - self.low) * self.per_height() - 0.5).clamp(0.0, (COUNT - 1) as f32);
        let k = (place as usize).min(COUNT - 2);
        let (a, b, share) = (side[k], side[k + 1], place - k as f32);
        HalfSection { width: a.width + (b.width - a.width) * share, curl: a.curl + (b.curl - a.curl) * share }
    }
}

/// How many of the rows 0, 1, 2, … lie below `y`, or at it where that counts too. Rounding functions would be calls on
/// processors of the oldest kind that we serve.
fn rows_below(y: f32, counts_at: bool) -> usize {
    if y < 0.0 {
        return 0;
    }
    let row = y as usize;
    if counts_at || (row as f32) < y { row + 1 } else { row }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;

    #[test]
    fn a_lopsided_kite_keeps_its_width_and_the_curl_of_each_side() {
        let point = |x, y, curl| MarginPoint { at: Vec2::new(x, y), curl };
        let kite = [point(0.0, 0.0, 0.0), point(0.4, 0.5, 1.0), point(0.0, 1.0, 0.0), point(-0.2, 0.5, 0.0)];
        let sections = Sections::new(&kite, 1.0);
        assert_eq!((sections.low, sections.high), (0.0, 1.0));
        let (right, left) = (sections.at(0.25, true), sections.at(0.25, false));
        assert!((right.width + left.width - 0.3).abs() < 1e-3);
        assert!((right.curl - 0.5).abs() < 1e-3 && left.curl == 0.0);
    }

    #[test]
    fn both_halves_of_a_bowed_blade_are_equally_wide() {
        let bow = |t: f32| 0.3 * (t * std::f32::consts::PI).sin();
        let half = |t: f32| 0.15 * (t * std::f32::consts::PI).sin();
        let side = |sign: f32| {
            (0..40).map(move |k| k as f32 / 40.0).map(move |t| {
                let t = if sign > 0.0 { t } else { 1.0 - t };
                MarginPoint { at: Vec2::new(bow(t) + sign * half(t), t), curl: 0.0 }
            })
        };
        let outline: Vec<MarginPoint> = side(1.0).chain(side(-1.0)).collect();
        let sections = Sections::new(&outline, 1.0);
        for v in [0.2, 0.35, 0.5, 0.65, 0.8] {
            let (right, left) = (sections.at(v, true).width, sections.at(v, false).width);
            let share = right / (right + left);
            assert!((share - 0.5).abs() < 0.1, "{share} of the width lies to the right at {v}");
        }
        assert!(sections.widest < 0.18, "{}", sections.widest);
    }
}
