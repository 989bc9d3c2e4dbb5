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

/// Fewest lines of a fan in a crown, how far from the crown's lower end they begin, as a share of its diagonal, how straight
/// and, as a share of its height, how long they are, and how far apart they begin, as a share of how far apart they end.
const FAN: (usize, f32, f32, f32) = (4, 0.12, 0.5, 0.35);

/// Whether many straight lines spread in a crown from its lower end at `x`: the veins of a ginkgo's leaf.
pub(crate) fn has_fan(lines: &[&Line], crown: &[Vec2], x: f32) -> bool {
    let (low, high) = polyline::bounds(crown.iter().copied());
    let size = high - low;
    let foot = Vec2::new(x, high.y);
    let vein = |line: &&Line| {
        let (a, b) = line.ends();
        let (near, far) = if a.distance(foot) < b.distance(foot) { (a, b) } else { (b, a) };
        let is_vein = near.distance(foot) < FAN.1 * size.length()
            && far.y < near.y
            && near.distance(far) > FAN.2 * line.length.max(size.y)
            && line.points.iter().all(|p| p.cmpge(low).all() && p.cmple(high).all());
        is_vein.then_some((near.x, far.x))
    };
    let veins: Vec<(f32, f32)> = lines.iter().filter_map(vein).collect();
    let spread = |place: fn(&(f32, f32)) -> f32| {
        let ends = veins
            .iter()
            .map(place)
            .fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        ends.1 - ends.0
    };
    veins.len() >= FAN.0 && spread(|vein| vein.0) < FAN.3 * spread(|vein| vein.1)
}

/// Fewest and most balls of foliage that are a crown together, how far apart their middles are at most, in the sum of their
/// half sizes, and least size of one, as a share of another's: petals around a centre are more, and that is smaller.
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

/// Of a blade that bends: most gap of its outline, least share of its hull that it fills, how far from the lowest and highest place of the
/// whole its foot and tip are at most and at least, and how far outward it leans at least, as shares of the whole's height and width.
const BLADE: (f32, f32, f32, f32) = (0.15, 0.25, 0.12, 0.1);

/// Whether outlines of leaves stand at the foot of a stem: the sides of a trunk are no closed outlines.
pub(crate) fn has_leaves_at_foot(lines: &[&Line], (low, high): (Vec2, Vec2)) -> bool {
    let size = high - low;
    let middle = low.midpoint(high).x;
    // A blade rises from the foot outward.
    let is_blade = |line: &Line| {
        let (foot, tip) = (line.bounds.1.y, line.bounds.0.y);
        let at = |height: f32| {
            let mut ends = line.points.iter().filter(|p| p.y == height);
            ends.next().map_or(0.0, |p| (p.x - middle).abs())
        };
        line.openness < BLADE.0
            && line.area > BLADE.1 * line.hull_area
            && foot > high.y - BLADE.2 * size.y
            && tip > low.y + BLADE.2 * size.y
            && at(tip) > at(foot) + BLADE.3 * size.x
    };
    let is_low = |line: &Line| line.is_closed_and_solid() && line.bounds.0.y > high.y - AT_FOOT.0 * size.y;
    let is_leaf = |line: &&&Line| {
        (is_low(line) || is_blade(line))
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
