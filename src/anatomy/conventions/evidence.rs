//! What speaks for and against outlines of crowns, whoever proposes them.

use super::page::Line;
use super::silhouette::{Silhouette, share_along};
use glam::Vec2;

/// Fewest blades, drawn one by one, that speak against a crown; their largest extent and least area as shares of the whole.
const BLADES: (usize, f32, f32) = (3, 0.4, 0.002);
/// Least area between lines and their chords, as a share of the whole's bounds.
const ENCLOSED: f32 = 0.12;
/// Extent of a flower centre, least and most, and how far it may lie from the middle, in reaches of the crown.
const CENTRE: (f32, f32, f32) = (0.2, 1.0, 0.4);
/// Most lines that draw a crown's outline, least share of it that they draw, and how near they are, in cells of the silhouette.
const OUTLINE: (usize, f32, f32) = (4, 0.7, 3.0);

/// Whether several of these lines are outlines of blades, drawn one by one: closed, convex but for little, and small in the
/// whole, which has this width and height.
pub(super) fn has_blades(lines: &[&Line], whole: Vec2) -> bool {
    let is_blade = |line: &&&Line| {
        line.is_closed_and_solid()
            && line.size().max_element() < BLADES.1 * whole.max_element()
            && line.area > BLADES.2 * whole.x * whole.y
    };
    lines.iter().filter(is_blade).count() >= BLADES.0
}

/// Whether these lines enclose something by themselves, not only branches between one another; the whole has this width and
/// height.
pub(super) fn has_outline(lines: &[&Line], whole: Vec2) -> bool {
    let enclosed = |line: &&Line| if line.is_scribble() { line.hull_area } else { line.area };
    lines.iter().map(enclosed).sum::<f32>() > ENCLOSED * whole.x * whole.y
}

/// Whether one of these lines is a round outline about the middle of a crown: then that is a corolla.
pub(super) fn has_flower_centre(lines: &[&Line], outline: &[Vec2]) -> bool {
    let middle = outline.iter().sum::<Vec2>() / outline.len().max(1) as f32;
    let reach = outline.iter().map(|p| p.distance(middle)).fold(0.0, f32::max);
    let is_centre = |line: &&Line| {
        let is_of_size = (CENTRE.0 * reach..CENTRE.1 * reach).contains(&line.size().max_element());
        line.is_closed_and_solid() && is_of_size && line.middle().distance(middle) < CENTRE.2 * reach
    };
    lines.iter().any(is_centre)
}

/// Whether the longest few of these lines, with what closes them, draw most of an outline: a web of branches has many more.
pub(super) fn is_drawn_by_few<'a>(
    outline: &[Vec2],
    lines: impl Iterator<Item = &'a [Vec2]>,
    closing: &[&'a [Vec2]],
    silhouette: &Silhouette,
) -> bool {
    let mut longest: Vec<&[Vec2]> = lines.collect();
    longest.sort_by_key(|line| std::cmp::Reverse(line.len()));
    longest.truncate(OUTLINE.0);
    let drawn = longest.iter().chain(closing).copied();
    share_along(outline, drawn, OUTLINE.2 * silhouette.cell()) >= OUTLINE.1
}
