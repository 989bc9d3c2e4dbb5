//! What speaks for and against outlines of crowns, whoever proposes them.

use crate::anatomy::conventions::page::{Line, is_bow, notches};
use crate::anatomy::conventions::shapes::balls;
use crate::anatomy::conventions::shapes::silhouette::{Silhouette, share_along};
use crate::geom::polyline;
use glam::Vec2;

/// Fewest blades, drawn one by one, that speak against a crown; their largest extent and least area as shares of the whole.
const BLADES: (usize, f32, f32) = (3, 0.4, 0.002);
/// Least area between lines and their chords, as a share of the whole's bounds.
const ENCLOSED: f32 = 0.12;
/// Extent of a flower centre, least and most, and how far it may lie from the middle, in reaches of the crown.
const CENTRE: (f32, f32, f32) = (0.2, 1.0, 0.4);
/// Least of the narrower side of a corolla, in the wider.
const LONG: f32 = 0.45;
/// Most round outlines of a flower: its centre, and what is drawn around or in it.
const CENTRES: usize = 2;
/// Fewest notches of a crown with lobes, and least distance of them from its middle on the average, that of an ellipse being 1.
pub(crate) const NOTCHES: usize = 3;
pub(crate) const SHALLOW: f32 = 0.72;
/// Slopes of the ground that are tried besides the level, and how much of the width of a foot there the outline runs at least.
const SLOPES: [f32; 2] = [0.1, -0.1];
const RUNS: f32 = 0.8;
/// Most lines that draw a crown's outline, least share of it that they draw, and how near they are, in cells of the silhouette.
const OUTLINE: (usize, f32, f32) = (4, 0.7, 3.0);

/// Whether several of these lines are outlines of blades, drawn one by one: closed, convex but for little, and small in the
/// whole, which has this width and height. In an outline of its own such a one is a fruit.
pub(crate) fn has_blades(lines: &[&Line], whole: Vec2) -> bool {
    let is_blade = |line: &&&Line| {
        line.is_closed_and_solid()
            && line.size().max_element() < BLADES.1 * whole.max_element()
            && line.area > BLADES.2 * whole.x * whole.y
            && !lines.iter().any(|other| other.is_around(line))
    };
    lines.iter().filter(is_blade).count() >= BLADES.0
}

/// Fewest and most balls of foliage that are a crown together, how far apart their middles are at most, in the sum of their half sizes, and least
/// size of one, as a share of another's: petals around a centre are more, and that is smaller.
const BALLS: (usize, usize, f32, f32) = (2, 4, 1.05, 0.5);

/// The lines without a few balls that touch or overlap each other: a crown drawn ball by ball.
pub(crate) fn without_balls<'a>(lines: &[&'a Line]) -> Vec<&'a Line> {
    let round: Vec<&Line> = lines.iter().copied().filter(|line| balls::is_round(line)).collect();
    if !(BALLS.0..=BALLS.1).contains(&round.len()) {
        return lines.to_vec();
    }
    let half = |line: &Line| 0.25 * (line.size().x + line.size().y);
    let touches = |a: &Line, b: &Line| {
        let is_even = half(a).min(half(b)) > BALLS.3 * half(a).max(half(b));
        !std::ptr::eq(a, b) && is_even && a.middle().distance(b.middle()) < BALLS.2 * (half(a) + half(b))
    };
    if !round.iter().all(|line| round.iter().any(|other| touches(line, other))) {
        return lines.to_vec();
    }
    lines.iter().copied().filter(|line| !balls::is_round(line)).collect()
}

/// Lower part of the whole in which leaves stand at the foot of a stem, as a share of its height, and fewest of them; least area of one, as
/// a share of the whole's bounds.
const AT_FOOT: (f32, usize, f32) = (0.55, 2, 0.01);

/// Whether outlines of leaves stand at the foot of a stem: the sides of a trunk are no closed outlines.
pub(crate) fn has_leaves_at_foot(lines: &[&Line], (low, high): (Vec2, Vec2)) -> bool {
    let size = high - low;
    let is_leaf = |line: &&&Line| {
        line.is_closed_and_solid()
            && line.bounds.0.y > high.y - AT_FOOT.0 * size.y
            && line.area > AT_FOOT.2 * size.x * size.y
            && line.size().x < 0.6 * size.x
    };
    lines.iter().filter(is_leaf).count() >= AT_FOOT.1
}

/// Whether these lines enclose something by themselves, not only branches between one another; the whole has this width and
/// height.
pub(crate) fn has_outline(lines: &[&Line], whole: Vec2) -> bool {
    let enclosed = |line: &&Line| if line.is_scribble() { line.hull_area } else { line.area };
    lines.iter().map(enclosed).sum::<f32>() > ENCLOSED * whole.x * whole.y
}

/// How far a measure is from where it counts nothing to where it counts in full, from 0 to 1.
pub(crate) fn ramp(measure: f32, (none, full): (f32, f32)) -> f32 {
    ((measure - none) / (full - none)).clamp(0.0, 1.0)
}

/// Left and right end of the lowest part of an outline of even points, so high as this share of the whole, or of a stretch of it that
/// runs along ground with a slope, if that is wider: nobody draws quite level.
pub(crate) fn foot(outline: &[Vec2], share: f32) -> (Vec2, Vec2) {
    let step = polyline::length(outline) / outline.len().max(1) as f32;
    let on = |slope: f32| {
        let height = |p: &Vec2| slope * p.x - p.y;
        let ends = outline
            .iter()
            .map(height)
            .fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)));
        let lowest: Vec<Vec2> =
            outline.iter().copied().filter(|p| height(p) <= ends.0 + share * (ends.1 - ends.0)).collect();
        let by_place = |a: &&Vec2, b: &&Vec2| a.x.total_cmp(&b.x);
        let (left, right) = (lowest.iter().min_by(by_place), lowest.iter().max_by(by_place));
        let foot = left.copied().unwrap_or_default();
        (foot, right.copied().unwrap_or_default(), lowest.len() as f32 * step)
    };
    let width = |foot: &(Vec2, Vec2, f32)| foot.1.x - foot.0.x;
    let level = on(0.0);
    let sloped = SLOPES.into_iter().map(on).filter(|foot| foot.2 > RUNS * width(foot));
    let widest = sloped.fold(level, |best, it| if width(&it) > width(&best) { it } else { best });
    (widest.0, widest.1)
}

/// Whether one of these lines is a round outline about the middle of a crown: then that is a corolla. Several are apples, or the
/// loops of a scribble.
pub(crate) fn has_flower_centre(lines: &[&Line], outline: &[Vec2]) -> bool {
    let (low, high) = polyline::bounds(outline.iter().copied());
    let (middle, half) = (low.midpoint(high), 0.5 * (high - low));
    let reach = half.max_element();
    if half.min_element() < LONG * reach {
        return false;
    }
    let is_of_size = |line: &&&Line| {
        let size = CENTRE.0 * reach..CENTRE.1 * reach;
        line.is_closed_and_solid() && size.contains(&line.size().max_element())
    };
    let is_central = |line: &&Line| ((line.middle() - middle) / half).length() < CENTRE.2;
    let round: Vec<&&Line> = lines.iter().filter(is_of_size).collect();
    round.len() <= CENTRES && round.into_iter().any(is_central)
}

/// Whether an outline has lobes as a crown has: several, and the notches between them are shallow.
pub(crate) fn has_shallow_lobes(outline: &[Vec2]) -> bool {
    let notches = notches(outline);
    notches.len() >= NOTCHES && depth(outline, &notches) > SHALLOW
}

/// Mean distance of notches from the middle of an outline, that of an ellipse being 1.
pub(crate) fn depth(outline: &[Vec2], notches: &[Vec2]) -> f32 {
    let (low, high) = polyline::bounds(outline.iter().copied());
    let away = |p: &Vec2| ((*p - low.midpoint(high)) / (0.5 * (high - low))).length();
    notches.iter().map(away).sum::<f32>() / notches.len().max(1) as f32
}

/// Whether the longest few of these lines, or all that are bows, with what closes them, draw most of an outline: a web of branches
/// has many more, and they are straight.
pub(crate) fn is_drawn_by_few<'a>(
    outline: &[Vec2],
    lines: impl Iterator<Item = &'a [Vec2]>,
    closing: &[&'a [Vec2]],
    silhouette: &Silhouette,
) -> bool {
    let mut longest: Vec<&[Vec2]> = lines.collect();
    longest.sort_by_key(|line| std::cmp::Reverse(line.len()));
    let few: Vec<&[Vec2]> = longest.iter().take(OUTLINE.0).copied().collect();
    let bows = longest.iter().skip(OUTLINE.0).copied().filter(|line| is_bow(line));
    let drawn = few.iter().chain(closing).copied().chain(bows);
    share_along(outline, drawn, OUTLINE.2 * silhouette.cell()) >= OUTLINE.1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;
    use crate::anatomy::conventions::page::even;

    fn width(outline: &[(f32, f32)]) -> f32 {
        let (left, right) = foot(&even(&line(outline), 200), 0.12);
        right.x - left.x
    }

    #[test]
    fn ground_with_a_slope_is_a_foot_and_two_tips_that_hang_are_none() {
        let level = [(0.0, 0.0), (100.0, 0.0), (100.0, -60.0), (0.0, -60.0), (0.0, 0.0)];
        let sloped = [(0.0, 0.0), (100.0, 10.0), (100.0, -60.0), (0.0, -60.0), (0.0, 0.0)];
        let hanging = [
            (0.0, 0.0),
            (10.0, -40.0),
            (90.0, -40.0),
            (100.0, 10.0),
            (100.0, -60.0),
            (0.0, -60.0),
            (0.0, 0.0),
        ];
        assert!(width(&level) > 95.0 && width(&sloped) > 95.0, "{} {}", width(&level), width(&sloped));
        assert!(width(&hanging) < 40.0, "{}", width(&hanging));
    }
}
