//! A drawing as the network sees it: a square picture of the crown's area and of the wood's lines.
//!
//! The foot of the plant stands in the middle near the lower edge, and the drawing fills [`FILLED`] of the picture's width or
//! height, whichever is fuller. Seven channels: the crown's area; how deep it would be if it were inflated (Poisson's equation,
//! `geom/inflation.rs`), so that the network learns what is different in plants; the lines of the wood, the directions in which
//! they run; how high a cell lies and how far from the middle.
//!
//! Source: 001 §3.2.1, which gives the network edges of the silhouette and branches in colours. An area says more than its
//! edge to a small network, and a direction more than a colour drawn by lot.

use crate::geom::inflation;
use crate::geom::outlined_area::OutlinedArea;
use glam::Vec2;

/// Cells along a side of the picture.
pub const SIDE: usize = 128;
/// Channels of the picture.
pub const CHANNELS: usize = 7;
/// Share of the picture that a drawing fills.
pub const FILLED: f32 = 0.9;
/// Height of the foot above the lower edge, as a share of the picture.
pub const FOOT: f32 = 0.05;
/// Half the width of a line, cells.
const HALF_LINE: f32 = 1.0;
/// Value of a line of the trunk, and of other wood.
const TRUNK: (f32, f32) = (1.0, 0.6);
/// Largest half depth that the picture shows, as a share of its side.
pub const DEEPEST: f32 = 0.5;

/// A line of wood in a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// From its base to its end; x to the right, y down.
    pub points: Vec<Vec2>,
    /// Whether nothing carries it.
    pub is_trunk: bool,
}

/// Where the picture lies on a drawing whose y points down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    foot: Vec2,
    side: f32,
}

impl Frame {
    /// The picture of a drawing that stands on `foot`; `None` if it has no extent.
    pub fn around(foot: Vec2, points: impl Iterator<Item = Vec2>) -> Option<Self> {
        let (mut half_width, mut height) = (0.0f32, 0.0f32);
        for p in points {
            half_width = half_width.max((p.x - foot.x).abs());
            height = height.max(foot.y - p.y);
        }
        let side = (2.0 * half_width).max(height) / FILLED;
        (side > 0.0 && side.is_finite() && foot.is_finite()).then_some(Self { foot, side })
    }

    /// The same with another side, in the drawing's unit.
    #[must_use]
    pub fn with_side(self, side: f32) -> Self {
        Self { side, ..self }
    }

    /// Side of the picture, in the drawing's unit.
    pub fn side(&self) -> f32 {
        self.side
    }

    /// Where a point of the drawing is in the picture, from 0 to 1 to the right and down.
    pub fn place(&self, p: Vec2) -> Vec2 {
        (p - self.foot) / self.side + Vec2::new(0.5, 1.0 - FOOT)
    }

    /// The point of the drawing at a place in the picture.
    pub fn point(&self, place: Vec2) -> Vec2 {
        (place - Vec2::new(0.5, 1.0 - FOOT)) * self.side + self.foot
    }
}

/// A picture of [`CHANNELS`] channels, each of [`SIDE`] rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture(Vec<f32>);

impl Picture {
    /// The picture of a drawing: crowns as closed outlines, filled, and lines of wood, which are drawn one over the other.
    pub fn of(frame: &Frame, outlines: &[Vec<Vec2>], wood: &[Line]) -> Self {
        let area = OutlinedArea::new(outlines.iter().filter(|outline| outline.len() >= 3).cloned());
        Self::new(&std::array::from_fn(|i| area.contains(frame.point(middle(i)))), frame, wood)
    }

    /// The same of an area that is given cell by cell.
    pub fn new(area: &[bool; SIDE * SIDE], frame: &Frame, wood: &[Line]) -> Self {
        let mut channels = vec![0.0; CHANNELS * SIDE * SIDE];
        let (crown, lines) = channels.split_at_mut(2 * SIDE * SIDE);
        let inside = (0..SIDE * SIDE).filter(|i| area[*i]);
        let squared = inflation::squared_half_depth([SIDE, SIDE], 1.0 / SIDE as f32, inside);
        for (i, squared) in squared.iter().enumerate() {
            crown[i] = f32::from(u8::from(area[i]));
            crown[SIDE * SIDE + i] = (squared.sqrt() / DEEPEST).min(1.0);
        }
        let (lines, places) = lines.split_at_mut(3 * SIDE * SIDE);
        wood.iter().for_each(|line| draw(lines, frame, line));
        for i in 0..SIDE * SIDE {
            let at = middle(i);
            places[i] = at.y;
            places[SIDE * SIDE + i] = 2.0 * (at.x - 0.5).abs();
        }
        Self(channels)
    }

    /// All channels, one after the other.
    pub fn channels(&self) -> &[f32] {
        &self.0
    }

    /// How deep the crown would be if it were inflated, as the second channel, in cells of twice the side.
    pub(super) fn inflated_in_quarter_cells(&self) -> impl Iterator<Item = f32> {
        let half = &self.0[SIDE * SIDE..2 * SIDE * SIDE];
        let sum = |i: usize| half[i] + half[i + 1] + half[i + SIDE] + half[i + SIDE + 1];
        (0..SIDE * SIDE / 4).map(move |i| 0.25 * sum(2 * (i / (SIDE / 2)) * SIDE + 2 * (i % (SIDE / 2))))
    }
}

/// The middle of a cell, in shares of the picture.
pub fn middle(i: usize) -> Vec2 {
    (Vec2::new((i % SIDE) as f32, (i / SIDE) as f32) + 0.5) / SIDE as f32
}

/// Draws a line into three channels: that there is one, and where it goes.
fn draw(channels: &mut [f32], frame: &Frame, line: &Line) {
    let value = if line.is_trunk { TRUNK.0 } else { TRUNK.1 };
    for pair in line.points.windows(2) {
        let [a, b] = [pair[0], pair[1]].map(|p| frame.place(p) * SIDE as f32);
        let way = (b - a).normalize_or_zero();
        for_cells_near((a, b), HALF_LINE, SIDE, |cell| {
            channels[cell] = value;
            channels[SIDE * SIDE + cell] = way.x;
            channels[2 * SIDE * SIDE + cell] = way.y;
        });
    }
}

/// Every cell of a square of `side` cells whose middle lies within `reach` of a piece of line, all in cells.
pub fn for_cells_near((a, b): (Vec2, Vec2), reach: f32, side: usize, mut each: impl FnMut(usize)) {
    if !(a.is_finite() && b.is_finite()) {
        return;
    }
    let last = (side - 1) as f32;
    let (low, high) =
        ((a.min(b) - reach).floor().clamp(Vec2::ZERO, Vec2::splat(last)), (a.max(b) + reach).ceil());
    let high = high.clamp(Vec2::ZERO, Vec2::splat(last));
    let along = b - a;
    for y in low.y as usize..=high.y as usize {
        for x in low.x as usize..=high.x as usize {
            let p = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
            let share = (p - a).dot(along) / along.length_squared().max(1e-12);
            if p.distance_squared(a + along * share.clamp(0.0, 1.0)) <= reach * reach {
                each(y * side + x);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_foot_stands_in_the_middle_below() {
        let points = [Vec2::new(100.0, -40.0), Vec2::new(160.0, 100.0)];
        let frame = Frame::around(Vec2::new(120.0, 100.0), points.into_iter()).unwrap();
        assert!((frame.side() - 140.0 / FILLED).abs() < 1e-3);
        let foot = frame.place(Vec2::new(120.0, 100.0));
        assert!(foot.distance(Vec2::new(0.5, 0.95)) < 1e-5);
        assert!(frame.point(foot).distance(Vec2::new(120.0, 100.0)) < 1e-3);
        assert!(frame.place(points[0]).y > 0.04);
        assert_eq!(Frame::around(Vec2::ZERO, [Vec2::ZERO].into_iter()), None);
        assert_eq!(Frame::around(Vec2::ZERO, [Vec2::NAN].into_iter()), None);
    }

    #[test]
    fn crowns_are_filled_with_holes_and_lines_say_where_they_go() {
        let square = |half: f32| {
            [(-1., -1.), (1., -1.), (1., 1.), (-1., 1.)]
                .map(|(x, y)| Vec2::new(x * half, y * half - 50.0))
                .to_vec()
        };
        let (crown, hole) = (square(40.0), square(15.0));
        let frame = Frame::around(Vec2::ZERO, crown.iter().copied()).unwrap();
        let trunk = Line { points: vec![Vec2::ZERO, Vec2::new(0.0, -90.0)], is_trunk: true };
        let picture = Picture::of(&frame, &[crown, hole], &[trunk]);
        let at = |channel: usize, p: Vec2| {
            let cell = frame.place(p) * SIDE as f32;
            picture.channels()[channel * SIDE * SIDE + cell.y as usize * SIDE + cell.x as usize]
        };
        let (in_crown, in_hole) = (Vec2::new(28.0, -50.0), Vec2::new(0.5, -50.0));
        assert_eq!((at(0, in_crown), at(0, in_hole)), (1.0, 0.0));
        assert!(at(1, in_crown) > 0.1 && at(1, in_hole) == 0.0);
        assert_eq!((at(2, in_crown), at(2, in_hole)), (0.0, 1.0));
        assert_eq!((at(3, in_hole), at(4, in_hole)), (0.0, -1.0), "up");
    }
}
