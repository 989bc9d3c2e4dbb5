//! Ground lines: a long level line, low in the drawing, with everything else above it.
//!
//! What speaks for the ground is that the line is nearly straight and level, spans most of the drawing and lies in its lower part
//! with nothing below. It becomes no part of the plant. Limits: ground drawn as a hill, in pieces, or as grass is not found here
//! (for grass see [`grass`](super::grass)).

use crate::anatomy::conventions::Hypothesis;
use crate::anatomy::conventions::page::{Line, Page};
use crate::sketch::Reading;

/// Least distance between the ends of a ground line, as a share of its length.
const STRAIGHT: f32 = 0.9;
/// Largest height, as a share of its width.
const LEVEL: f32 = 0.12;
/// Least width, as a share of the drawing's.
const WIDE: f32 = 0.6;
/// Lowest part of the drawing in which it lies, and how far anything may reach below it, as shares of the drawing's height.
const LOW: (f32, f32) = (0.35, 0.12);
/// Least height of a drawing, as a share of its width: a level line alone is a branch that lies.
const HIGH: f32 = 0.25;
/// Log-odds of a ground line.
const SCORE: f32 = 2.0;

/// Proposes lines that are the ground.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let grounds = (0..page.lines.len()).filter(|i| !page.is_apart(*i) && is_ground(page, &page.lines[*i]));
    let height = |i: &usize| page.lines[*i].middle().y;
    let lowest = grounds.max_by(|a, b| height(a).total_cmp(&height(b)));
    out.extend(lowest.map(|line| Hypothesis {
        uses: vec![line],
        score: SCORE,
        parts: Vec::new(),
        solids: Vec::new(),
        reading: Reading::Ground,
        habit: None,
    }));
}

/// Whether a line is the ground.
fn is_ground(page: &Page, line: &Line) -> bool {
    let whole = page.bounds.1 - page.bounds.0;
    let (begin, end) = line.ends();
    let size = line.size();
    let is_line = begin.distance(end) > STRAIGHT * line.length && size.y < LEVEL * size.x;
    let is_low = line.bounds.0.y > page.bounds.1.y - LOW.0 * whole.y;
    let is_lowest = page.bounds.1.y - line.bounds.1.y < LOW.1 * whole.y;
    is_line && size.x > WIDE * whole.x && whole.y > HIGH * whole.x && is_low && is_lowest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sketch::{Stroke, StrokePoint, Tool};
    use glam::Vec2;
    use std::sync::Arc;

    fn read(lines: &[&[(f32, f32)]]) -> Vec<Vec<usize>> {
        let stroke = |(id, line): (usize, &&[(f32, f32)])| {
            let points = line.iter().map(|p| StrokePoint::at(Vec2::from(*p))).collect();
            Arc::new(Stroke { id: id as u64, tool: Tool::Auto, points })
        };
        let strokes: Vec<_> = lines.iter().enumerate().map(stroke).collect();
        let mut out = Vec::new();
        propose(&Page::new(&strokes), &mut out);
        out.into_iter().map(|ground| ground.uses).collect()
    }

    const STEM: [(f32, f32); 2] = [(50.0, 98.0), (52.0, 0.0)];
    const GROUND: [(f32, f32); 3] = [(0.0, 99.0), (50.0, 101.0), (100.0, 98.0)];

    #[test]
    fn a_level_line_below_everything_is_the_ground() {
        assert_eq!(read(&[&STEM, &GROUND]), [[1]]);
    }

    #[test]
    fn branches_are_not() {
        assert!(read(&[&GROUND]).is_empty(), "alone it is a branch");
        let middle = GROUND.map(|(x, y)| (x, y - 50.0));
        assert!(read(&[&STEM, &middle]).is_empty(), "a branch crosses its stem");
        let steep = [(0.0, 100.0), (100.0, 70.0)];
        assert!(read(&[&STEM, &steep]).is_empty());
        let short = [(30.0, 99.0), (60.0, 99.0)];
        let wide = [(-50.0, 0.0), (150.0, 0.0)];
        assert!(read(&[&STEM, &short, &wide]).is_empty());
    }
}
