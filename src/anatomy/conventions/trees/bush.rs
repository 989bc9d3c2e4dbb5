//! A crown without a trunk: a lobed outline, open toward the ground or closed, or a scribble.
//!
//! What speaks for a bush is that lines which touch enclose one area that is solid, stands on a broad foot and has several notches
//! or is scribbled over; nothing leaves it downward as a stem does, and nothing round lies in its middle. Whatever is drawn inside
//! belongs to it. The bush grows from a few stems that fan out from the middle of its foot.
//!
//! Limits: two bushes that touch are one; a hedge with a straight upper edge has no notches and is read as a leaf.

use super::evidence;
use crate::anatomy::conventions::page::{Line, Page, even, notches};
use crate::anatomy::conventions::shapes::outline;
use crate::anatomy::conventions::shapes::silhouette::{Silhouette, smooth_contour};
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::geom::{convex_hull::convex_hull, polyline, simple_loop};
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Smallest bush, as a share of the drawing's diagonal.
const SMALLEST: f32 = 0.2;
/// Narrowest bush, as a share of its height.
const NARROWEST: f32 = 0.6;
/// Fewest notches of an outline that is closed, and of one that is open or level below, as no blade is; one less where berries are in it.
const NOTCHES: (usize, usize) = (3, 2);
/// Least share of the whole that lines scribble over.
const SCRIBBLE: f32 = 0.35;
/// Least share of its convex hull that a bush fills.
const SOLID: f32 = 0.62;
/// Height above its lowest point at which a bush is measured, and least width there, as shares of its height and width.
const FOOT: (f32, f32) = (0.15, 0.4);
/// Height of the lowest part of an outline that ends in a level line, and least width there, as shares of its height and width.
const LEVEL: (f32, f32) = (0.06, 0.75);
/// Largest berry, as a share of the bush's diagonal, and fewest of them.
const BERRY: (f32, usize) = (0.15, 2);
/// Farthest that a line may leave the area, as a share of its height.
const OUTSIDE: f32 = 0.15;
/// How wide gaps of the outline are closed, in cells of the silhouette, one after the other.
const BRIDGES: [i32; 2] = [15, 20];
/// Points of a line that closes an outline.
const CHORD: usize = 60;
/// Points of the outline.
const POINTS: usize = 160;
/// Stems: directions from upright in degrees, and lengths in heights of the bush.
const STEMS: [(f32, f32); 5] = [(-38.0, 0.4), (-17.0, 0.5), (2.0, 0.55), (20.0, 0.5), (40.0, 0.4)];
/// Log-odds of an outline, and of a scribble.
const SCORE: (f32, f32) = (2.0, 2.5);

/// Proposes bushes, one for each group of lines at most.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    if !page.is_mostly_free() {
        return;
    }
    out.extend(page.groups.iter().filter_map(|group| bush(page, group)));
}

fn bush(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    let lines: Vec<&Line> = group.iter().map(|i| &page.lines[*i]).collect();
    let ink: Vec<Vec2> = lines.iter().flat_map(|line| &line.points).copied().collect();
    let hull = convex_hull(&ink, |p| *p);
    let (low, high) = polyline::bounds(hull.iter().copied());
    let size = high - low;
    let is_of_form = size.length() > SMALLEST * page.diagonal && size.x > NARROWEST * size.y;
    if !is_of_form || evidence::has_blades(&lines, size) || !evidence::has_outline(&lines, size) {
        return None;
    }
    let chords: Vec<Vec<Vec2>> = lines
        .iter()
        .filter(|line| is_arch(line))
        .map(|line| even(&[line.ends().0, line.ends().1], CHORD))
        .collect();
    let closing: Vec<&[Vec2]> = chords.iter().map(Vec::as_slice).collect();
    let drawn = || lines.iter().map(|line| line.points.as_slice());
    let hull_area = simple_loop::area(&hull);
    let scribbled: f32 = lines.iter().filter(|line| line.is_scribble()).map(|line| line.hull_area).sum();
    let is_scribble = scribbled > SCRIBBLE * hull_area;
    // Where gaps are closed, so are the notches between flat lobes; those of an arch can be counted on its line.
    let has_lobes = lines.iter().any(|line| is_arch(line) && lobes_of(line) > NOTCHES.1);
    let crown = |bridge: &i32| {
        let silhouette = Silhouette::new(drawn().chain(closing.iter().copied()), *bridge);
        let outline = smooth_contour(&silhouette.contour(), POINTS, 1);
        let is_solid = simple_loop::area(&outline) > SOLID * hull_area;
        let fewest = match is_level(&outline) {
            true if has_berries(page, group, &outline) => NOTCHES.1 - 1,
            false if closing.is_empty() => NOTCHES.0,
            _ => NOTCHES.1,
        };
        let is_outline = (has_lobes || notches(&outline).len() >= fewest)
            && evidence::is_drawn_by_few(&outline, drawn(), &closing, &silhouette)
            && !evidence::has_flower_centre(&lines, &outline);
        (is_solid && (is_scribble || is_outline)).then_some(outline)
    };
    let outline = BRIDGES.iter().find_map(crown)?;
    if !(is_scribble || stands(&outline, (low, high))) || is_left(&lines, &outline) {
        return None;
    }
    let uses = page.with_what_is_inside(group, &outline);
    let mut parts = stems(&outline, (low, high));
    parts.push(Made::new(Tool::Crown, outline));
    let score = if is_scribble { SCORE.1 } else { SCORE.0 };
    Some(Hypothesis {
        uses,
        score,
        parts,
        solids: Vec::new(),
        reading: Reading::Bush,
        habit: Some(Habit::Bush),
    })
}

/// Whether a line begins and ends low, at about one height, and rises between.
fn is_arch(line: &Line) -> bool {
    let (begin, end) = line.ends();
    let (low, size) = (line.bounds.1.y, line.size());
    let lower = low - begin.y.min(end.y);
    lower < 0.35 * size.y && (begin.x - end.x).abs() > 0.2 * size.x
}

/// How many lobes an arch has whose notches are not as low as those between blades of grass.
fn lobes_of(arch: &Line) -> usize {
    let is_high = |place: &Vec2| place.y < arch.bounds.1.y - 0.35 * arch.size().y;
    1 + notches(&arch.points).into_iter().filter(is_high).count()
}

/// Whether an area ends below in one level line, as no blade does.
fn is_level(outline: &[Vec2]) -> bool {
    let (low, high) = polyline::bounds(outline.iter().copied());
    let (left, right) = outline::foot(outline, LEVEL.0);
    right.x - left.x > LEVEL.1 * (high.x - low.x)
}

/// Whether there are several small round outlines in an area.
fn has_berries(page: &Page, group: &[usize], outline: &[Vec2]) -> bool {
    let (low, high) = polyline::bounds(outline.iter().copied());
    let is_berry = |i: &usize| {
        let line = &page.lines[*i];
        line.is_closed_and_solid() && line.size().max_element() < BERRY.0 * low.distance(high)
    };
    let inside = page.with_what_is_inside(group, outline);
    inside.iter().filter(|i| !group.contains(i)).filter(|i| is_berry(i)).count() >= BERRY.1
}

/// Whether an area stands on a broad foot.
fn stands(outline: &[Vec2], (low, high): (Vec2, Vec2)) -> bool {
    let (left, right) = outline::foot(outline, FOOT.0);
    right.x - left.x > FOOT.1 * (high.x - low.x)
}

/// Whether a line goes far out of an area.
fn is_left(lines: &[&Line], outline: &[Vec2]) -> bool {
    let bounds = polyline::bounds(outline.iter().copied());
    let reach = OUTSIDE * (bounds.1.y - bounds.0.y);
    let ends = lines.iter().flat_map(|line| [line.ends().0, line.ends().1]);
    let mut away = ends.map(|end| (end.clamp(bounds.0, bounds.1)).distance(end));
    away.any(|away| away > reach)
}

/// Stems from the middle of the foot.
pub(crate) fn stems(outline: &[Vec2], (low, high): (Vec2, Vec2)) -> Vec<Made> {
    let (left, right) = outline::foot(outline, FOOT.0);
    let foot = Vec2::new(0.5 * (left.x + right.x), high.y);
    let stem = |(degrees, length): (f32, f32)| {
        let along = Vec2::new(degrees.to_radians().sin(), -degrees.to_radians().cos());
        Made::new(Tool::Branch, (0..=8).map(|k| foot + along * (length * (high.y - low.y) * k as f32 / 8.0)))
    };
    STEMS.into_iter().map(stem).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::{PI, TAU};

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_as_drawn(propose, lines)
    }

    fn cloud(lobes: f32, from: f32, to: f32) -> Vec<Vec2> {
        let place = |k: usize| {
            let angle = from + (to - from) * k as f32 / 300.0;
            let reach = 50.0 + 12.0 * (0.5 * lobes * angle).sin().abs();
            reach * Vec2::new(1.4 * angle.cos(), -angle.sin())
        };
        (0..=300).map(place).collect()
    }

    #[test]
    fn a_cloud_on_the_ground_is_a_bush_that_grows_from_its_foot() {
        let bushes = read(&[cloud(9.0, 0.0, TAU)]);
        assert_eq!(bushes.len(), 1);
        let crown = bushes[0].parts.last().unwrap();
        assert_eq!(crown.tool, Tool::Crown);
        let ground = crown.points.iter().map(|p| p.position.y).fold(f32::MIN, f32::max);
        for stem in &bushes[0].parts[..STEMS.len()] {
            assert_eq!(stem.tool, Tool::Branch);
            assert!((stem.points[0].position.y - ground).abs() < 3.0);
        }
    }

    #[test]
    fn an_arch_that_is_open_below_is_closed_there() {
        let bushes = read(&[cloud(9.0, 0.0, PI)]);
        assert_eq!(bushes.len(), 1);
    }

    #[test]
    fn a_scribble_is_a_bush() {
        let scribble = (0..600).map(|k| {
            let t = k as f32 * 0.05;
            Vec2::new(60.0 * (1.31 * t).cos(), 40.0 * (2.17 * t).sin())
        });
        assert_eq!(read(&[scribble.collect()]).len(), 1);
    }

    #[test]
    fn smooth_outlines_and_outlines_on_stems_are_none() {
        assert!(read(&[cloud(0.0, 0.0, TAU)]).is_empty());
        let stem = (0..=20).map(|k| Vec2::new(0.0, 45.0 + 8.0 * k as f32)).collect();
        assert!(read(&[cloud(7.0, 0.0, TAU), stem]).is_empty());
    }

    #[test]
    fn what_lies_in_a_bush_is_its_own() {
        let dot =
            |x: f32| (0..=20).map(|k| Vec2::new(x, 0.0) + 3.0 * Vec2::from_angle(0.33 * k as f32)).collect();
        let bushes = read(&[cloud(9.0, 0.0, TAU), dot(-30.0), dot(0.0), dot(30.0)]);
        assert_eq!(bushes.first().map(|bush| bush.uses.len()), Some(4));
    }
}
