//! Poplars in a row: slender upright outlines, each on a short line of its own, side by side on one level.
//!
//! One such outline is a leaf on its stalk. Three or more that are alike, upright, with their feet at one height, are trees:
//! crowns on trunks.
//!
//! Limits: crowns whose lines are not closed; rows on a steep slope.

use crate::anatomy::conventions::page::{Line, Page, median};
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Least and most height of a crown over its width, and least share of its hull that it fills.
const SLENDER: (f32, f32) = (1.9, 9.0);
const SOLID: f32 = 0.88;
/// Length of a trunk in heights of its crown, least and most; most run of it over its rise, and how far from the middle of the
/// crown and from its lower end it begins, as shares of the crown's width and height.
const TRUNK: (f32, f32) = (0.06, 0.5);
const UPRIGHT: f32 = 0.3;
const AT: (f32, f32) = (0.3, 0.08);
/// Fewest trees; how far their feet are from one level and their heights from the middle one at most, as a share of that.
const FEWEST: usize = 3;
const LEVEL: f32 = 0.25;
const ALIKE: f32 = 0.45;
/// Most lines that are looked at.
const MOST: usize = 200;
/// Half width of a trunk, as a share of its crown's width.
const HALF: f32 = 0.06;
/// Log-odds of each tree.
const SCORE: f32 = 3.0;

/// Proposes a tree for each of several slender crowns in a row.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    if page.lines.len() > MOST {
        return;
    }
    let all = || (0..page.lines.len()).filter(|i| !page.is_apart(*i));
    let crowns = all().filter(|i| is_crown(&page.lines[*i]));
    let found = crowns.filter_map(|crown| {
        let trunk = all().find(|i| *i != crown && is_trunk(&page.lines[*i], &page.lines[crown]))?;
        Some((crown, trunk))
    });
    let trees: Vec<(usize, usize)> = found.collect();
    if trees.len() < FEWEST || !are_in_a_row(page, &trees) {
        return;
    }
    out.extend(trees.into_iter().map(|(crown, trunk)| tree(page, crown, trunk)));
}

fn is_crown(line: &Line) -> bool {
    let size = line.size();
    line.is_closed_and_solid()
        && !line.is_scribble()
        && line.solidity() > SOLID
        && (SLENDER.0..SLENDER.1).contains(&(size.y / size.x.max(f32::MIN_POSITIVE)))
}

/// Whether a line is upright and ends at the lower end of a crown.
fn is_trunk(line: &Line, crown: &Line) -> bool {
    let (a, b) = line.ends();
    let (top, foot) = if a.y < b.y { (a, b) } else { (b, a) };
    let (run, size) = (foot - top, crown.size());
    let length = line.length / size.y.max(f32::MIN_POSITIVE);
    let visible = (foot.y - crown.bounds.1.y) / size.y.max(f32::MIN_POSITIVE);
    run.x.abs() < UPRIGHT * run.y
        && (TRUNK.0..TRUNK.1).contains(&visible)
        && length < 1.0 + TRUNK.1
        && run.length() > 0.9 * line.length
        && (top.x - crown.middle().x).abs() < AT.0 * size.x
        && top.y < crown.bounds.1.y + AT.1 * size.y
}

/// Whether trees stand on one level and are alike.
fn are_in_a_row(page: &Page, trees: &[(usize, usize)]) -> bool {
    let mut heights: Vec<f32> = trees.iter().map(|(crown, _)| page.lines[*crown].size().y).collect();
    let mut feet: Vec<f32> = trees.iter().map(|(_, trunk)| page.lines[*trunk].bounds.1.y).collect();
    let (height, foot) = (median(&mut heights), median(&mut feet));
    heights.iter().all(|own| (own - height).abs() < ALIKE * height)
        && feet.iter().all(|own| (own - foot).abs() < LEVEL * height)
}

fn tree(page: &Page, crown: usize, trunk: usize) -> Hypothesis {
    let (outline, line) = (&page.lines[crown], &page.lines[trunk]);
    let mut points = line.upward();
    points.push(Vec2::new(outline.middle().x, outline.bounds.0.y + 0.3 * outline.size().y));
    let mut trunk_line = Made::new(Tool::Branch, points);
    trunk_line.half_width = Some(HALF * outline.size().x);
    let parts = vec![trunk_line, Made::new(Tool::Crown, outline.points.iter().copied())];
    let mut uses = vec![crown, trunk];
    uses.sort_unstable();
    let (reading, habit) = (Reading::Tree, Some(Habit::Tree));
    Hypothesis { uses, score: SCORE, parts, solids: Vec::new(), reading, habit }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    /// A lens on a short line at `x`, leaning by `lean`.
    fn poplar(x: f32, lean: f32) -> [Vec<Vec2>; 2] {
        let crown = (0..=40).map(|k| {
            let t = k as f32 / 40.0;
            let (u, sign) = if t < 0.5 { (2.0 * t, 1.0) } else { (2.0 - 2.0 * t, -1.0) };
            Vec2::new(x + sign * 90.0 * u * (1.0 - u) + lean * u, -30.0 - 150.0 * u)
        });
        [crown.collect(), line(&[(x, 0.0), (x, -30.0)])]
    }

    #[test]
    fn three_slender_crowns_side_by_side_are_trees_and_two_are_leaves() {
        let row: Vec<Vec<Vec2>> = [0.0, 80.0, 160.0].iter().flat_map(|x| poplar(*x, 0.0)).collect();
        let found = read(&row);
        assert_eq!(found.iter().map(|tree| &tree.uses[..]).collect::<Vec<_>>(), [[0, 1], [2, 3], [4, 5]]);
        assert!(
            found.iter().all(|tree| tree.habit == Some(Habit::Tree) && tree.parts[1].tool == Tool::Crown)
        );
        assert!(read(&row[..4]).is_empty());
    }

    #[test]
    fn leaves_from_one_foot_and_outlines_at_other_heights_are_none() {
        let fan: Vec<Vec<Vec2>> = [-160.0, 0.0, 160.0].iter().flat_map(|lean| poplar(0.0, *lean)).collect();
        assert!(read(&fan).is_empty());
        let up = |lines: [Vec<Vec2>; 2], by: f32| {
            lines.map(|line| line.into_iter().map(|p| p - Vec2::new(0.0, by)).collect::<Vec<_>>())
        };
        let steps: Vec<Vec<Vec2>> =
            (0..3).flat_map(|k| up(poplar(80.0 * k as f32, 0.0), 90.0 * k as f32)).collect();
        assert!(read(&steps).is_empty());
    }
}
