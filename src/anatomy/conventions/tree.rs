//! A trunk with a crown, in any number of strokes: crown and trunk in one line, two lines for a trunk, a box, a scribble.
//!
//! Lines that touch or are near one another are searched for a [`trunk`](super::trunk); the crown is what the lines above it
//! enclose, gaps closed as little as needed. What speaks for a crown is that a few lines draw its outline, that it is solid,
//! compact, wider than the trunk and no smaller, and that it begins with a jump of the width. Arms of a cactus, the web of
//! drawn branches and the base of a leaf are not so; a round outline in its middle makes it a corolla, and several closed
//! outlines in it are leaves or petals that were drawn one by one.
//!
//! Limits: a single line below an outline is a stem, and that a flower, see [`corolla`](super::corolla).

use super::evidence;
use super::page::{Line, Page};
use super::silhouette::{Silhouette, smooth_contour};
use super::trunk::{Rows, Trunk};
use super::{Habit, Hypothesis, Made};
use crate::geom::{convex_hull::convex_hull, simple_loop};
use crate::sketch::{Reading, Tool};
use glam::Vec2;
use std::f32::consts::PI;

/// Lowest tree, as a share of the drawing's diagonal.
const LOWEST: f32 = 0.15;
/// How wide gaps of a crown's outline are closed, in cells of its silhouette, one after the other until it is closed.
const BRIDGES: [i32; 3] = [8, 16, 24];
/// Least hull of one stretch of line above the trunk, as a share of the hull of all.
const TURNED: f32 = 0.3;
/// Share of its convex hull that an outline without a wide gap encloses.
const CLOSED: f32 = 0.4;
/// Least share of its convex hull that a crown fills.
const SOLID: f32 = 0.6;
/// Least radius of the largest circle in a crown, in half widths of its trunk.
const WIDER: f32 = 1.25;
/// Least share of what is drawn above the trunk that lies in the crown.
const INSIDE: f32 = 0.85;
/// Most area of a crown that is higher than so many times its width, in areas of the largest circle in it.
const COMPACT: (f32, f32) = (4.0, 0.8);
/// Points of a crown's outline.
const POINTS: usize = 160;
/// Log-odds of a tree where all of this holds.
const SCORE: f32 = 3.0;
/// More for each line that it explains.
const EACH: f32 = 0.02;

/// Proposes trees, one for each group of lines at most.
pub(super) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    out.extend(page.groups.iter().chain(&page.wide_groups).filter_map(|group| tree(page, group)));
}

fn tree(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    let lines: Vec<&Line> = group.iter().map(|i| &page.lines[*i]).collect();
    let rows = Rows::new(&lines)?;
    let size = rows.width_and_height();
    let is_of_form = size.y > LOWEST * page.diagonal && evidence::has_outline(&lines, size);
    if !is_of_form || evidence::has_blades(&lines, size) {
        return None;
    }
    let trunk = rows.trunk()?;
    let outline = crown(&lines, &trunk)?;
    let area = simple_loop::signed_area(outline.iter().copied()).abs();
    if area < trunk.area() || evidence::has_flower_centre(&lines, &outline) {
        return None;
    }
    let uses = page.with_what_is_inside(group, &outline);
    let parts = vec![trunk.centre_line(&outline), Made::new(Tool::Crown, outline)];
    let (reading, habit) = (Reading::Tree, Some(Habit::Tree));
    // Of two groups the one that explains more.
    let score = SCORE + EACH * uses.len() as f32;
    Some(Hypothesis { uses, score, parts, solids: Vec::new(), reading, habit })
}

/// The outline of the crown above a trunk.
fn crown(lines: &[&Line], trunk: &Trunk) -> Option<Vec<Vec2>> {
    let above: Vec<Vec<Vec2>> = lines.iter().flat_map(|line| line.above(trunk.top)).collect();
    // What the crown rests on: its outline is open where the trunk comes in.
    let sill = vec![trunk.sill.0, trunk.sill.1];
    let all = above.iter().chain([&sill]).map(Vec::as_slice);
    let drawn = above.iter().map(Vec::as_slice);
    // The stretches of an outline turn round what they enclose; sides of stems that go on upward do not.
    let turned = above.iter().map(|run| hull_area_of(run)).fold(0.0, f32::max);
    let ink: Vec<Vec2> = above.iter().flatten().copied().collect();
    let hull = convex_hull(&ink, |p| *p);
    let hull_area = hull_area_of(&hull);
    if turned < TURNED * hull_area {
        return None;
    }
    let closed =
        |bridge: &i32| Some(Silhouette::new(all.clone(), *bridge)).filter(|s| s.area() > CLOSED * hull_area);
    let silhouette = BRIDGES.iter().find_map(closed)?;
    let outline = smooth_contour(&silhouette.contour(), POINTS, 1);
    let is_crown = is_compact(&silhouette, &hull, trunk.narrow)
        && silhouette.share_inside(ink.iter()) >= INSIDE
        && evidence::is_drawn_by_few(&outline, drawn, &[&sill], &silhouette)
        && trunk.is_sharp;
    is_crown.then_some(outline)
}

fn hull_area_of(points: &[Vec2]) -> f32 {
    let hull = convex_hull(points, |p| *p);
    simple_loop::signed_area(hull.iter().copied()).abs()
}

/// Whether an area is solid, wider than its trunk and no long arm.
fn is_compact(silhouette: &Silhouette, hull: &[Vec2], half_trunk: f32) -> bool {
    let hull_area = simple_loop::signed_area(hull.iter().copied()).abs();
    let (area, radius) = (silhouette.area(), silhouette.inscribed_radius());
    let (low, high) = hull.iter().fold((hull[0], hull[0]), |(low, high), p| (low.min(*p), high.max(*p)));
    let is_high = high.y - low.y > COMPACT.1 * (high.x - low.x);
    let is_arm = is_high && area > COMPACT.0 * PI * radius * radius;
    area >= SOLID * hull_area && radius >= WIDER * half_trunk && !is_arm
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sketch::{Stroke, StrokePoint};
    use std::f32::consts::TAU;
    use std::sync::Arc;

    /// A cloud of `lobes` around (0, -100), from the angle `from` to `to` about straight down.
    fn cloud(lobes: f32, from: f32, to: f32) -> Vec<Vec2> {
        let place = |k: usize| {
            let angle = from + (to - from) * k as f32 / 200.0;
            let reach = 50.0 + 8.0 * (0.5 * lobes * angle).sin().abs();
            Vec2::new(0.0, -100.0) + reach * Vec2::new(-angle.sin(), angle.cos())
        };
        (0..=200).map(place).collect()
    }

    fn line(points: &[(f32, f32)]) -> Vec<Vec2> {
        points.iter().map(|p| Vec2::from(*p)).collect()
    }

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        let stroke = |(id, line): (usize, &Vec<Vec2>)| {
            let points = line.iter().map(|p| StrokePoint::at(*p)).collect();
            Arc::new(Stroke { id: id as u64, tool: Tool::Auto, points })
        };
        let strokes: Vec<_> = lines.iter().enumerate().map(stroke).collect();
        let mut out = Vec::new();
        propose(&Page::new(&strokes), &mut out);
        out
    }

    fn parts(tree: &Hypothesis) -> (&Made, &Made) {
        let [trunk, crown] = &tree.parts[..] else { panic!("{} parts", tree.parts.len()) };
        assert_eq!((trunk.tool, crown.tool), (Tool::Branch, Tool::Crown));
        (trunk, crown)
    }

    #[test]
    fn two_lines_below_a_cloud_are_a_trunk_as_wide_as_they_are_apart() {
        let sides = [line(&[(-9.0, 40.0), (-9.0, -60.0)]), line(&[(9.0, 38.0), (9.0, -60.0)])];
        let trees = read(&[cloud(9.0, 0.0, TAU), sides[0].clone(), sides[1].clone()]);
        assert_eq!(trees.len(), 1);
        assert_eq!(trees[0].uses, [0, 1, 2]);
        let (trunk, crown) = parts(&trees[0]);
        let foot = trunk.points[0];
        let half = foot.pressure * trunk.half_width.unwrap();
        assert!((half - 9.0).abs() < 1.5 && foot.position.x.abs() < 1.0, "{half} at {}", foot.position);
        assert!(foot.position.y > 36.0, "{}", foot.position);
        let lowest = crown.points.iter().map(|p| p.position.y).fold(f32::MIN, f32::max);
        assert!((-70.0..-35.0).contains(&lowest), "the crown ends above the trunk: {lowest}");
    }

    #[test]
    fn crown_and_trunk_may_be_one_line() {
        let mut outline = line(&[(-8.0, 40.0), (-8.0, -45.0)]);
        outline.extend(cloud(9.0, 0.2, TAU - 0.2));
        outline.extend(line(&[(8.0, -45.0), (8.0, 40.0)]));
        let trees = read(&[outline]);
        assert_eq!(trees.len(), 1);
        assert!((parts(&trees[0]).0.half_width.unwrap() - 8.0).abs() < 2.0);
    }

    #[test]
    fn a_cloud_with_a_gap_is_closed() {
        let sides = [line(&[(-9.0, 40.0), (-9.0, -45.0)]), line(&[(9.0, 38.0), (9.0, -45.0)])];
        let trees = read(&[cloud(9.0, 0.2, TAU - 0.45), sides[0].clone(), sides[1].clone()]);
        assert_eq!(trees.len(), 1);
    }

    #[test]
    fn an_outline_on_a_single_line_is_no_tree() {
        assert!(read(&[cloud(6.0, 0.0, TAU), line(&[(0.0, 60.0), (0.0, -44.0)])]).is_empty());
    }

    #[test]
    fn a_column_with_arms_is_no_tree() {
        let column = line(&[
            (-10.0, 60.0),
            (-10.0, 0.0),
            (-35.0, 0.0),
            (-35.0, -30.0),
            (-20.0, -30.0),
            (-20.0, -15.0),
            (-10.0, -15.0),
            (-10.0, -60.0),
            (0.0, -70.0),
            (10.0, -60.0),
            (10.0, -20.0),
            (20.0, -20.0),
            (20.0, -40.0),
            (35.0, -40.0),
            (35.0, -5.0),
            (10.0, -5.0),
            (10.0, 60.0),
        ]);
        assert!(read(&[column]).is_empty());
    }
}
