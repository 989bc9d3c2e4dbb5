//! Cross-sections of a blade: how far its margin lies to the right and left of the axis, and how it is curled there.
//!
//! 000 eq. 5.3 needs the half width at every point's height; a table filled in one walk around the outline answers
//! that in constant time. Where the outline crosses a height several times (lobes), the outermost crossing counts.

use super::outline::MarginPoint;

const COUNT: usize = 32;

/// One side of the blade at one height.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct HalfSection {
    /// Distance from the axis to the margin, 0 where the blade does not reach this side.
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
    /// Largest distance of the margin from the axis, positive.
    pub(super) widest: f32,
    right: [HalfSection; COUNT],
    left: [HalfSection; COUNT],
}

impl Sections {
    /// Measures an outline of at least three points.
    pub(super) fn new(outline: &[MarginPoint]) -> Self {
        let (mut low, mut high, mut widest) = (f32::INFINITY, f32::NEG_INFINITY, f32::MIN_POSITIVE);
        for point in outline {
            low = low.min(point.at.y);
            high = high.max(point.at.y);
            widest = widest.max(point.at.x.abs());
        }
        let mut sections = Self {
            low,
            high,
            widest,
            right: [HalfSection::default(); COUNT],
            left: [HalfSection::default(); COUNT],
        };
        let per_height = sections.per_height();
        let mut from = outline[outline.len() - 1];
        for &to in outline {
            sections.add_edge(from, to, per_height);
            from = to;
        }
        sections
    }

    fn per_height(&self) -> f32 {
        COUNT as f32 / (self.high - self.low).max(f32::MIN_POSITIVE)
    }

    fn add_edge(&mut self, from: MarginPoint, to: MarginPoint, per_height: f32) {
        let (bottom, top) = if from.at.y <= to.at.y { (from, to) } else { (to, from) };
        let rise = top.at.y - bottom.at.y;
        let row = |y: f32| (y - self.low) * per_height - 0.5;
        let (first, end) = (rows_below(row(bottom.at.y), false), rows_below(row(top.at.y), true).min(COUNT));
        for k in first..end {
            let y = self.low + (k as f32 + 0.5) / per_height;
            let share = ((y - bottom.at.y) / rise.max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
            let u = bottom.at.x + (top.at.x - bottom.at.x) * share;
            let side = if u >= 0.0 { &mut self.right[k] } else { &mut self.left[k] };
            if u.abs() > side.width {
                *side = HalfSection { width: u.abs(), curl: bottom.curl + (top.curl - bottom.curl) * share };
            }
        }
    }

    /// The half section at height `v`, to the right or left of the axis.
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
    fn a_lopsided_kite_has_its_own_width_on_each_side() {
        let point = |x, y, curl| MarginPoint { at: Vec2::new(x, y), curl };
        let kite = [point(0.0, 0.0, 0.0), point(0.4, 0.5, 1.0), point(0.0, 1.0, 0.0), point(-0.2, 0.5, 0.0)];
        let sections = Sections::new(&kite);
        assert_eq!((sections.low, sections.high, sections.widest), (0.0, 1.0, 0.4));
        let (right, left) = (sections.at(0.25, true), sections.at(0.25, false));
        assert!((right.width - 0.2).abs() < 1e-3 && (left.width - 0.1).abs() < 1e-3);
        assert!((right.curl - 0.5).abs() < 1e-3 && left.curl == 0.0);
    }
}
