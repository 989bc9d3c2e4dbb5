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
use super::half_crown;
use super::stacked::stacked;
use super::tilted;
use super::trunk::{Rows, Trunk};
use super::trunk_sides::TrunkSides;
use crate::anatomy::conventions::page::{self, Line, Page, even, is_bow, notches};
use crate::anatomy::conventions::shapes::balls;
use crate::anatomy::conventions::shapes::silhouette::{Silhouette, smooth_contour};
use crate::anatomy::conventions::shapes::teeth::is_row_of_teeth;
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::geom::{
    convex_hull::convex_hull,
    polyline,
    simple_loop::{self, hull_area},
};
use crate::sketch::{Reading, StrokePoint, Tool};
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
/// Greatest distance of a trunk's sides that lean, as a share of their length.
const STOUT: f32 = 1.5;
/// Least share of its hull that a crown on such a trunk fills.
const FULL: f32 = 0.7;
/// The same where wide gaps are closed, and of crowns whose lobes speak for them.
const WHOLE: f32 = 0.8;
/// Lower part of a crown in which open ends of its outline are led to the trunk, as a share of its height, and how far away they
/// are at most, as a share of its width.
const LOW: f32 = 0.5;
const GAP: f32 = 0.5;
/// Width of a trunk below which it may be a flower's stem, as a share of its crown's.
const THIN: f32 = 0.2;
/// Height of such a trunk above which it is, in heights of its crown and in its own widths.
const LONG: (f32, f32) = (1.8, 7.0);
/// Points of a line that closes an outline.
const CHORD: usize = 40;
/// Points of a crown's outline.
const POINTS: usize = 160;
/// Log-odds of a tree where all of this holds.
const SCORE: f32 = 3.36;
/// More for each line that it explains, up to so many: less than a mushroom, which is a tree in a few ways.
const EACH: f32 = 0.02;
const MOST_LINES: usize = 6;
/// More for a crown with shallow lobes, and for each besides, up to so many: mushrooms have none, and those of corollas are deep.
const LOBED: (f32, f32) = (0.9, 0.1);
const MOST_LOBES: usize = 3;
/// Lower part of a crown whose notches do not count, as a share of its height.
const RIM: f32 = 0.15;
/// How much deeper notches may be on a stout trunk, as a share of the way to the middle.
const DEEPER: f32 = 0.08;
/// Least hull of a bow that is a lobe, as a share of the crown's area.
const BOW: f32 = 0.06;
/// More for a stout trunk, and the widths, as shares of the crown's, between which it grows.
const STOUTER: f32 = 0.2;
const SLIGHT: (f32, f32) = (0.05, 0.2);

/// What leans must be a tree for certain: height of its trunk, as a share of the whole, and share of its hull that its crown fills, each
/// where it speaks against one and where it does no more; and log-odds of each.
const SHORT: (f32, f32) = (0.17, 0.25);
const HOLLOW: (f32, f32) = (0.68, 0.76);
const DOUBT: f32 = 4.0;
/// Least log-odds of a tree.
const LEAST: f32 = 1.5;

/// How far beside a trunk another plant stands, as a share of the trunk's height.
const BESIDE: f32 = 0.1;
/// Log-odds that a crown of which one side was left out loses, and most of a whole one that it encloses by itself.
const HALF: f32 = 1.0;
const CUT: f32 = 0.85;

/// A trunk, the outline of its crown, and log-odds against them.
type Found = (Trunk, Vec<Vec2>, f32);

/// Proposes trees, one for each group of lines at most.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let stacked = stacked(page);
    let groups = page.groups.iter().chain(&page.wide_groups).chain(&stacked);
    out.extend(groups.filter_map(|group| tree(page, group)));
}

fn tree(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    let lines: Vec<&Line> = group.iter().map(|i| &page.lines[*i]).collect();
    let rows = Rows::new(&lines)?;
    let size = rows.width_and_height();
    let is_of_form = size.y > LOWEST * page.diagonal
        && evidence::has_outline(&lines, size)
        && !lines.iter().any(|line| is_row_of_teeth(line));
    let has_leaves = || {
        evidence::has_blades(&evidence::without_balls(&lines), size)
            || evidence::has_leaves_at_foot(&lines, page::bounds(lines.iter().copied()))
    };
    if !is_of_form || has_leaves() {
        return None;
    }
    let speaks = |lines: &[&Line], (trunk, outline, doubt): Found| {
        let stout = stoutness(&trunk, &outline);
        let speaks = lobes(lines, &trunk, &outline, stout) + STOUTER * stout - doubt;
        (!is_stem(&trunk, &outline, lines)).then_some((trunk, outline, speaks))
    };
    let find = |lines: &[&Line]| speaks(lines, upright(lines, &Rows::new(lines)?)?);
    let (trunk, outline, speaks, angle) = match upright(&lines, &rows).or_else(|| leaning(page, group)) {
        Some(found) => speaks(&lines, found).map(|(trunk, outline, speaks)| (trunk, outline, speaks, 0.0))?,
        None if matches!(&lines[..], [line] if line.is_scribble()) => return None,
        None => {
            let ((trunk, outline, speaks), angle) = tilted::turned(&lines, find, |found| found.2)?;
            let short = 1.0 - evidence::ramp(trunk.height() / size.y, SHORT);
            let hollow = 1.0 - evidence::ramp(simple_loop::area(&outline) / hull_area(&outline), HOLLOW);
            (trunk, outline, speaks + tilted::LEANING - DOUBT * (short + hollow), angle)
        }
    };
    let trunk = tilted::turned_back(trunk.centre_line(&outline), angle);
    let outline: Vec<Vec2> = outline.into_iter().map(|p| tilted::turned_by(p, -angle)).collect();
    let own: Vec<usize> =
        group.iter().copied().filter(|i| !stands_beside(&page.lines[*i], &outline, &trunk.points)).collect();
    let uses = page.with_what_is_inside(&own, &outline);
    let solids = balls::in_crown(uses.iter().map(|i| &page.lines[*i]), &outline);
    let parts = vec![trunk, Made::new(Tool::Crown, outline)];
    let (reading, habit) = (Reading::Tree, Some(Habit::Tree));
    // Of two groups the one that explains more.
    let score = SCORE + speaks + EACH * uses.len().min(MOST_LINES) as f32;
    (score > LEAST).then_some(Hypothesis { uses, score, parts, solids, reading, habit })
}

/// Whether an outline lies below the crown and beside the trunk: another plant.
fn stands_beside(line: &Line, crown: &[Vec2], trunk: &[StrokePoint]) -> bool {
    let (_, foot) = polyline::bounds(crown.iter().copied());
    let (left, right) = polyline::bounds(trunk.iter().map(|point| point.position));
    let slack = BESIDE * (right.y - left.y);
    let is_beside = line.bounds.1.x < left.x - slack || line.bounds.0.x > right.x + slack;
    is_beside && line.bounds.0.y > foot.y - slack && line.openness < 0.5 && line.solidity() > 0.5
}

/// Whether a trunk is a flower's stem: thin beside its crown, with a round outline in the middle of that, or very long.
fn is_stem(trunk: &Trunk, crown: &[Vec2], lines: &[&Line]) -> bool {
    let (low, high) = polyline::bounds(crown.iter().copied());
    let is_thin = 2.0 * trunk.narrow < THIN * (high.x - low.x);
    let is_long = trunk.height() > LONG.0 * (high.y - low.y) && trunk.height() > LONG.1 * 2.0 * trunk.narrow;
    is_thin
        && (is_long
            || evidence::has_flower_centre(lines, crown)
            || evidence::has_fan(lines, crown, trunk.axis()))
}

/// Log-odds that lobes speak for a crown: it is full, and has shallow notches all around or was drawn by several bows; the more
/// the better. Arms of cacti have spaces between them, and petals, on slender stems, deep notches.
fn lobes(lines: &[&Line], trunk: &Trunk, outline: &[Vec2], stout: f32) -> f32 {
    let area = simple_loop::area(outline);
    if area <= WHOLE * hull_area(outline) {
        return 0.0;
    }
    // Where a cap rests on its stalk, and at its rim, there may be some as well.
    let (high, low) = polyline::bounds(outline.iter().copied());
    let mut notches = notches(outline);
    notches.retain(|place| place.y < low.y - RIM * (low.y - high.y));
    let is_shallow = evidence::depth(outline, &notches) > evidence::SHALLOW - DEEPER * stout;
    let notches = if is_shallow { notches.len() } else { 0 };
    let above = lines.iter().flat_map(|line| line.above(trunk.top));
    let bows = above.filter(|run| is_bow(run) && hull_area(run) > BOW * area).count();
    let count = notches.max(bows);
    let more = count.saturating_sub(evidence::NOTCHES).min(MOST_LOBES);
    if count < evidence::NOTCHES { 0.0 } else { LOBED.0 + LOBED.1 * more as f32 }
}

/// How stout a trunk is beside its crown, from 0 to 1: stalks of leaves and flowers are slender.
fn stoutness(trunk: &Trunk, crown: &[Vec2]) -> f32 {
    let (low, high) = polyline::bounds(crown.iter().copied());
    let share = 2.0 * trunk.narrow / (high.x - low.x).max(f32::MIN_POSITIVE);
    ((share - SLIGHT.0) / (SLIGHT.1 - SLIGHT.0)).clamp(0.0, 1.0)
}

/// A trunk that is found in level rows, and the outline of what is drawn above it.
fn upright(lines: &[&Line], rows: &Rows) -> Option<Found> {
    let trunk = rows.trunk().filter(|trunk| trunk.is_sharp)?;
    let above: Vec<Vec<Vec2>> = lines.iter().flat_map(|line| line.above(trunk.top)).collect();
    let whole = half_crown::completed(&above, trunk.axis()).and_then(|above| crown(above, &trunk));
    if let Some((outline, doubt)) = whole_or_drawn(crown(above.clone(), &trunk), whole.clone()) {
        return Some((trunk, outline, doubt));
    }
    let all = hull_area(&above.concat());
    let higher = rows.trunk_to_shoulder().filter(|trunk| trunk.is_sharp).and_then(|trunk| {
        let above = lines.iter().flat_map(|line| line.above(trunk.top)).collect();
        let outline = crown(above, &trunk)?;
        (simple_loop::area(&outline) > SOLID * all).then_some((trunk, outline, 0.0))
    });
    higher.or_else(|| Some((trunk, whole?, HALF)))
}

/// A trunk by its two sides, which may lean, and the outline of what is drawn beside them.
fn leaning(page: &Page, group: &[usize]) -> Option<Found> {
    let sides = TrunkSides::find_within(page, group, STOUT).filter(|sides| !sides.is_line())?;
    let others = group.iter().filter(|line| !sides.has_on_it(**line, &page.lines[**line]));
    let rest = others.flat_map(|line| sides.rest_of(*line, &page.lines[*line])).map(|rest| rest.0);
    let trunk = Trunk::of_sides(&sides)?;
    // What is left of the sides at their feet is ground, or a root.
    let half = trunk.top.midpoint(sides.foot().y);
    let above: Vec<Vec<Vec2>> = rest.filter(|run| run.iter().any(|p| p.y < half)).collect();
    let whole = half_crown::completed(&above, trunk.axis()).and_then(|above| crown(above, &trunk));
    let (outline, doubt) =
        whole_or_drawn(crown(above, &trunk), whole.clone()).or_else(|| Some((whole?, HALF)))?;
    let area = simple_loop::area(&outline);
    let is_crown = area > FULL * hull_area(&outline) && outline.iter().all(|p| p.y < half);
    is_crown.then_some((trunk, outline, doubt))
}

/// The outline of a crown as it was drawn, or the whole of it where a side was left out, with log-odds against it; nothing where it
/// was not drawn. Closed straight across, such a crown ends there as if it had been cut.
fn whole_or_drawn(drawn: Option<Vec<Vec2>>, whole: Option<Vec<Vec2>>) -> Option<(Vec<Vec2>, f32)> {
    let drawn = drawn?;
    let area = simple_loop::area(&drawn);
    let whole = whole.filter(|whole| CUT * simple_loop::area(whole) > area);
    Some(whole.map_or((drawn, 0.0), |whole| (whole, HALF)))
}

/// The outline of the crown above a trunk, from what is drawn there.
pub(crate) fn crown(above: Vec<Vec<Vec2>>, trunk: &Trunk) -> Option<Vec<Vec2>> {
    // The stretches of an outline turn round what they enclose; sides of stems that go on upward do not.
    let turned = above.iter().map(|run| hull_area(run)).fold(0.0, f32::max);
    let bows: f32 = above.iter().filter(|run| is_bow(run)).map(|run| hull_area(run)).sum();
    let ink: Vec<Vec2> = above.iter().flatten().copied().collect();
    let hull = convex_hull(&ink, |p| *p);
    let hull_area = hull_area(&hull);
    if hull.len() < 3 || turned.max(bows) < TURNED * hull_area {
        return None;
    }
    // What the crown rests on: its outline is open where the trunk comes in.
    let mut closing = gaps(&above, trunk);
    closing.push(vec![trunk.sill.0, trunk.sill.1]);
    let closing: Vec<&[Vec2]> = closing.iter().map(Vec::as_slice).collect();
    let drawn = above.iter().map(Vec::as_slice);
    let all = drawn.clone().chain(closing.iter().copied());
    let silhouettes = BRIDGES.iter().map(|bridge| Silhouette::new(all.clone(), *bridge));
    let enclosed = |silhouette: Silhouette| {
        let outline = smooth_contour(&silhouette.contour(), POINTS, 1);
        let is_crown = is_compact(&silhouette, &hull, trunk.narrow)
            && silhouette.share_inside(ink.iter()) >= INSIDE
            && evidence::is_drawn_by_few(&outline, drawn.clone(), &closing, &silhouette)
            && simple_loop::area(&outline) > trunk.least_area();
        is_crown.then_some(outline)
    };
    let mut closed = silhouettes.skip_while(|silhouette| silhouette.area() <= CLOSED * hull_area);
    // One stretch of line has no gap but that above the trunk: the first that is closed is meant. Of several a wider gap may be
    // closed if what they enclose is full then: leaves along a stem are not.
    let first = enclosed(closed.next()?);
    let is_full = |outline: &Vec<Vec2>| above.len() > 1 && simple_loop::area(outline) > WHOLE * hull_area;
    first.or_else(|| closed.find_map(enclosed).filter(is_full))
}

/// Lines from the lower open ends of what is drawn to the top of the trunk.
fn gaps(above: &[Vec<Vec2>], trunk: &Trunk) -> Vec<Vec<Vec2>> {
    let bounds = polyline::bounds(above.iter().flatten().copied());
    let size = bounds.1 - bounds.0;
    let ends = above.iter().flat_map(|run| [run[0], run[run.len() - 1]]);
    let to_trunk = ends.filter_map(|end| {
        let is_left = end.distance(trunk.sill.0) < end.distance(trunk.sill.1);
        let corner = if is_left { trunk.sill.0 } else { trunk.sill.1 };
        let is_low = end.y > bounds.1.y - LOW * size.y;
        (is_low && end.distance(corner) < GAP * size.x).then(|| even(&[end, corner], CHORD))
    });
    to_trunk.collect()
}

/// Whether an area is solid, wider than its trunk and no long arm.
fn is_compact(silhouette: &Silhouette, hull: &[Vec2], half_trunk: f32) -> bool {
    let hull_area = simple_loop::area(hull);
    let (area, radius) = (silhouette.area(), silhouette.inscribed_radius());
    let (low, high) = polyline::bounds(hull.iter().copied());
    let is_high = high.y - low.y > COMPACT.1 * (high.x - low.x);
    let is_arm = is_high && area > COMPACT.0 * PI * radius * radius;
    area >= SOLID * hull_area && radius >= WIDER * half_trunk && !is_arm
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;
    use std::f32::consts::TAU;

    /// A cloud of `lobes` around (0, -100), from the angle `from` to `to` about straight down.
    fn cloud(lobes: f32, from: f32, to: f32) -> Vec<Vec2> {
        let place = |k: usize| {
            let angle = from + (to - from) * k as f32 / 200.0;
            let reach = 50.0 + 8.0 * (0.5 * lobes * angle).sin().abs();
            Vec2::new(0.0, -100.0) + reach * Vec2::new(-angle.sin(), angle.cos())
        };
        (0..=200).map(place).collect()
    }

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_as_drawn(propose, lines)
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

    #[test]
    fn what_stands_in_a_row_of_blades_is_no_tree() {
        let sides = [line(&[(-9.0, 40.0), (-9.0, -60.0)]), line(&[(9.0, 38.0), (9.0, -60.0)])];
        let teeth = (0..=16).map(|k| (-120.0 + 15.0 * k as f32, if k % 2 == 1 { 20.0 } else { 44.0 }));
        let blades = line(&teeth.collect::<Vec<_>>());
        let tree = [cloud(9.0, 0.0, TAU), sides[0].clone(), sides[1].clone(), blades];
        assert_eq!(read(&tree[..3]).len(), 1);
        assert!(read(&tree).iter().all(|tree| !tree.uses.contains(&3)));
    }

    #[test]
    fn a_crown_that_is_open_below_is_closed_toward_its_trunk() {
        let sides = [line(&[(-10.0, 40.0), (-10.0, -55.0)]), line(&[(10.0, 38.0), (10.0, -55.0)])];
        let crown = cloud(9.0, 0.0, TAU - 0.9);
        let found = read(&[crown, sides[0].clone(), sides[1].clone()]);
        assert_eq!(found.iter().map(|tree| tree.uses.len()).max(), Some(3));
    }

    #[test]
    fn a_crown_of_many_arcs_is_one_and_a_knot_in_a_stout_tree_no_flower_centre() {
        let arc = |k: usize| -> Vec<Vec2> {
            let away = Vec2::from_angle(TAU * k as f32 / 6.0);
            let middle = Vec2::new(0.0, -100.0) + 40.0 * away;
            let turn = |i: usize| away.rotate(Vec2::from_angle(-1.9 + 0.19 * i as f32));
            (0..=20).map(|i| middle + 24.0 * turn(i)).collect()
        };
        let mut lines: Vec<Vec<Vec2>> = (0..6).map(arc).collect();
        let sides = [-14.0, 14.0].map(|x| line(&[(x, 40.0), (x, -55.0)]));
        lines.extend(sides.clone());
        assert_eq!(read(&lines).iter().map(|tree| tree.uses.len()).max(), Some(8));
        let knot =
            (0..=30).map(|k| Vec2::new(0.0, -100.0) + 14.0 * Vec2::from_angle(0.21 * k as f32)).collect();
        assert!(!read(&[cloud(9.0, 0.0, TAU), knot, sides[0].clone(), sides[1].clone()]).is_empty());
    }

    #[test]
    fn a_trunk_that_leans_much_is_as_thick_as_across_it() {
        let sides = [line(&[(-90.0, 40.0), (-8.0, -62.0)]), line(&[(-68.0, 52.0), (14.0, -52.0)])];
        let trees = read(&[cloud(9.0, 0.0, TAU), sides[0].clone(), sides[1].clone()]);
        let half = parts(&trees[0]).0.half_width.unwrap();
        assert!((11.0..15.5).contains(&half), "{half}");
    }

    #[test]
    fn the_lower_tip_of_an_outline_is_no_trunk() {
        let drop = (0..=100).map(|k| TAU * k as f32 / 100.0);
        let drop = drop.map(|t| Vec2::new(50.0 * t.sin() * (1.2 - t.cos()) / 2.0, 45.0 * t.cos()));
        assert!(read(&[drop.collect()]).is_empty());
    }

    #[test]
    fn an_arch_whose_ends_are_far_from_the_trunk_is_its_crown() {
        let sides = [-8.0, 8.0].map(|x| line(&[(x, 40.0), (x, -62.0)]));
        let found = read(&[cloud(9.0, 0.9, TAU - 0.9), sides[0].clone(), sides[1].clone()]);
        assert_eq!(found.iter().map(|tree| tree.uses.len()).max(), Some(3));
    }

    #[test]
    fn a_trunk_may_widen_toward_its_crown_and_fork() {
        let side = |x: f32| line(&[(12.0 * x, 60.0), (12.0 * x, 0.0), (27.0 * x, -46.0)]);
        let fork = line(&[(-15.0, -46.0), (0.0, -20.0), (15.0, -46.0)]);
        assert_eq!(read(&[cloud(9.0, 0.0, TAU), side(-1.0), side(1.0)]).len(), 1);
        assert_eq!(read(&[cloud(9.0, 0.0, TAU), side(-1.0), side(1.0), fork]).len(), 1);
    }

    #[test]
    fn a_stout_trunk_and_lobes_speak_for_a_tree() {
        let score = |lobes: f32, half: f32| {
            let sides = [-half, half].map(|x| line(&[(x, 40.0), (x, -50.0)]));
            read(&[cloud(lobes, 0.0, TAU), sides[0].clone(), sides[1].clone()])[0].score
        };
        assert!(score(9.0, 14.0) > score(9.0, 6.0));
        assert!(score(9.0, 14.0) > score(0.0, 14.0) + LOBED.0);
    }

    #[test]
    fn a_crown_of_which_one_side_was_left_out_is_completed_about_its_trunk() {
        let sides = [-7.0, 7.0].map(|x| line(&[(x, 40.0), (x, -44.0)]));
        let far = cloud(9.0, 0.2, 0.78 * TAU);
        for crown in [cloud(9.0, 0.2, 0.68 * TAU), cloud(9.0, 0.32 * TAU, TAU - 0.2), far] {
            let trees = read(&[crown, sides[0].clone(), sides[1].clone()]);
            let best = trees.iter().max_by(|a, b| a.score.total_cmp(&b.score)).unwrap();
            let (trunk, crown) = parts(best);
            let (low, high) = polyline::bounds(crown.points.iter().map(|p| p.position));
            assert!((low.x + 55.0).abs() < 8.0 && (high.x - 55.0).abs() < 8.0, "{low} {high}");
            assert!(trunk.points.iter().all(|p| p.position.x.abs() < 6.0), "it stands upright");
        }
    }
}
