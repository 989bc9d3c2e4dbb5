//! The pot in which a plant stands: what is lowest, box-like with a flat bottom, and has a plant in its upper edge.
//!
//! A line, or three for the bottom and the sides, may be a pot if it has two sides nearly all the way up, a bottom that is flat over [`FLAT`] of its width or a level upper edge, no notches
//! ([`SOLID`]) and is not much higher than wide ([`HIGHEST`]). What lies within its bounds belongs to it, and so do level
//! bands and ellipses at its upper edge, the rim, and a saucer below. It is a pot only if a plant stands in it: other lines have their lowest point at the upper
//! edge between the sides and rise well above it, narrower than the pot where they enter; or stems trail over it. A trunk, the stalk of a mushroom and
//! the lower part of a body have no such plant: what rests on them reaches past both sides.
//!
//! The pot is a [`Solid`] of revolution. Its profile is half of the distance of its sides in each row, from the rim to the
//! bottom. The plant in it stays with its own conventions.
//!
//! Limits: a pot beside something that stands lower is not found; a pot in one stroke with its plant is not found, nor one behind leaves that hang over both of its sides.

use super::pot_rows::{ROWS, Row, mirrored, profile, rows};
use super::{pot_sides, trailing};
use crate::anatomy::conventions::flowers::upright::{stand_in_bed, upright};
use crate::anatomy::conventions::page::{Line, Page, bounds};
use crate::anatomy::conventions::{Hypothesis, Solid, SolidKind};
use crate::geom::{convex_hull::convex_hull, polyline, simple_loop};
use crate::sketch::Reading;
use glam::Vec2;
use std::collections::BTreeSet;

/// Least width of a flat bottom, as a share of the pot's, and its slope at most; a circle is as flat over a quarter of its width.
const FLAT: (f32, f32) = (0.33, 0.27);
/// Least width of a level upper edge above a round bottom: a bowl.
const MOUTH_EDGE: f32 = 0.75;
/// Least distance of the ends of a line that is open below, as a share of its width.
const HILL: f32 = 0.6;
/// Least share of its convex hull that lies between its sides.
const SOLID: f32 = 0.75;
/// Greatest height, in widths, and the same of a vase, whose mouth is a line of its own.
const HIGHEST: f32 = 1.6;
const VASE: f32 = 2.2;
/// Least width of a mouth, as a share of the pot's, and how far below the upper edge it is at most, as a share of the height.
const MOUTH_LINE: (f32, f32) = (0.4, 0.12);
/// Least height, in widths: a bowl.
const LOWEST: f32 = 0.15;
/// Least width, as a share of the drawing's diagonal.
const NARROWEST: f32 = 0.06;
/// Length at most, in perimeters of the hull: a lip is drawn in the same stroke, lobes are not.
const LONGEST: f32 = 1.9;
/// Height of a rim over its width at most, its width over that of the body below, which may have one side only, and how far above
/// the body's edge it begins, as a share of the width: it is seen from above.
const RIM: (f32, f32, f32) = (0.6, 1.7, 0.45);
/// Height of a saucer over its width at most.
const SAUCER: f32 = 0.4;
/// Most rows, as a share of all, above the upper edge in which an end of one side goes on.
const OVERSHOT: f32 = 0.4;
/// Distance from the upper edge within which plants end, in heights of the pot: above, below.
const MOUTH: (f32, f32) = (0.3, 0.7);
/// Least height of a plant above the pot, in heights of the pot.
const PLANT: f32 = 0.4;
/// Greatest width of a plant where it enters, as a share of the pot's, and how near to a line's foot that is, as a share as well.
const ENTRY: f32 = 0.85;
/// Blades may fill the mouth: how many, how wide each is there at most, as a share of the pot's width, and how far below the upper edge
/// they begin, as a share of its height: fronds on a trunk hang.
const BLADES: (usize, f32, f32) = (3, 0.35, 0.15);
/// How far above the upper edge something may rest on it, in heights of the pot, and the same where a rim was drawn.
const RESTS: (f32, f32) = (0.2, 0.05);
const FOOT: f32 = 0.15;
/// Height of a line, as a share of its width, and how often it may cross the middle of it if it is no zigzag.
const ZIGZAG: (f32, usize) = (0.4, 6);
/// Log-odds: more than those of a tree, whose trunk a pot would be.
const SCORE: f32 = 3.5;
/// How far other things may reach below it, in heights of the pot: under it, and beside it, where they may stand before it.
const BELOW: (f32, f32) = (0.15, 0.5);
/// Largest opening of a line around it, which is a frame: a stem may lean over it.
const AROUND: f32 = 0.3;
/// Candidates that are looked at, the lowest first.
const MOST: usize = 24;

/// Proposes the lowest pot with a plant in it.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let bodies = (0..page.lines.len())
        .filter(|i| has_bottom(page, &page.lines[*i]) || is_level(page, &page.lines[*i]));
    let mut bodies: Vec<usize> = bodies.collect();
    bodies.sort_by(|a, b| page.lines[*b].bounds.1.y.total_cmp(&page.lines[*a].bounds.1.y).then(a.cmp(b)));
    bodies.truncate(MOST);
    out.extend(bodies.into_iter().find_map(|body| pot(page, body)));
}

fn pot(page: &Page, body: usize) -> Option<Hypothesis> {
    let mut pot = if is_level(page, &page.lines[body]) {
        Pot::around(page, &pot_sides::with_bottom(page, body)?)
    } else {
        Pot::around(page, &[body])
    };
    let lines: Vec<&[Vec2]> = pot.uses.iter().map(|i| &page.lines[*i].points[..]).collect();
    let mut rows = mirrored(rows(&lines, pot.low, pot.high));
    pot.trim(&mut rows);
    pot.trailing = trailing::over(page, &pot.uses, (pot.low, pot.high), &rows);
    if is_zigzag(&page.lines[body])
        || !pot.is_box(&lines, &rows)
        || pot.stands_on_more(page)
        || !pot.has_plant(page)
    {
        return None;
    }
    if stand_in_bed(&upright(page), (pot.low, pot.high)) {
        return None;
    }
    Some(pot.hypothesis(&rows, SCORE))
}

/// A pot that consists of these lines.
pub(crate) fn of_lines(page: &Page, uses: Vec<usize>, score: f32) -> Option<Hypothesis> {
    let lines: Vec<&[Vec2]> = uses.iter().map(|i| &page.lines[*i].points[..]).collect();
    let (low, high) = bounds(uses.iter().map(|i| &page.lines[*i]));
    let mut pot = Pot { uses, trailing: BTreeSet::new(), low, high, size: high - low };
    let mut rows = mirrored(rows(&lines, low, high));
    pot.trim(&mut rows);
    (profile(&rows).len() > 1).then(|| pot.hypothesis(&rows, score))
}

/// Whether a line by itself has the size and the bottom of a pot; it may lack a side.
fn has_bottom(page: &Page, line: &Line) -> bool {
    let size = line.size();
    let edges = (0..line.hull.len()).map(|i| (line.hull[i], line.hull[(i + 1) % line.hull.len()]));
    let perimeter: f32 = edges.clone().map(|(a, b)| a.distance(b)).sum();
    let is_level = |a: Vec2, b: Vec2| (b.y - a.y).abs() < FLAT.1 * (b.x - a.x).abs();
    let level = |is_lower: bool| -> f32 {
        let there =
            |(a, b): &(Vec2, Vec2)| is_level(*a, *b) && (a.midpoint(*b).y > line.middle().y) == is_lower;
        edges.clone().filter(there).map(|(a, b)| (b.x - a.x).abs()).sum()
    };
    size.x >= NARROWEST * page.diagonal
        && size.y <= HIGHEST * size.x
        && size.y >= LOWEST * size.x
        && line.length < LONGEST * perimeter
        && !(is_open_below(line) && level(false) < MOUTH_EDGE * size.x)
        && (level(true) > FLAT.0 * size.x || level(false) > MOUTH_EDGE * size.x)
}

/// Whether a line comes down at both ends and has nothing between them: a hill has no bottom.
fn is_open_below(line: &Line) -> bool {
    let (first, last) = line.ends();
    let low = line.bounds.1.y - 0.25 * line.size().y;
    (first.x - last.x).abs() > HILL * line.size().x && first.y > low && last.y > low
}

/// Whether a line may be the bottom of a pot of which the sides were drawn by themselves.
fn is_level(page: &Page, line: &Line) -> bool {
    let size = line.size();
    size.x >= NARROWEST * page.diagonal && size.y < LOWEST * size.x
}

/// Whether a line is a band or an ellipse at the upper edge of a body.
fn is_rim(line: &Line, (low, high): (Vec2, Vec2)) -> bool {
    let (size, own) = (high - low, line.size());
    let (l, h) = line.bounds;
    let shared = h.x.min(high.x) - l.x.max(low.x);
    let is_band = own.y < RIM.0 * own.x && (0.7..RIM.1).contains(&(own.x / size.x));
    is_band
        && shared > 0.6 * size.x
        && l.y < low.y + 0.3 * size.y
        && h.y > low.y - 0.15 * size.y
        && h.y < high.y
        && l.y > low.y - RIM.2 * own.x.max(size.x)
}

/// Whether a line is the saucer below a pot.
fn is_saucer(line: &Line, (low, high): (Vec2, Vec2)) -> bool {
    let (size, own, (l, h)) = (high - low, line.size(), line.bounds);
    let is_flat = own.y < SAUCER * own.x && (0.6..1.7).contains(&(own.x / size.x));
    let is_below = (l.y - high.y).abs() < 0.15 * size.y && h.y < high.y + 0.4 * size.y;
    is_flat
        && line.area > 0.1 * own.x * own.y
        && is_below
        && (line.middle().x - low.midpoint(high).x).abs() < 0.25 * size.x
}

/// Whether a line that is wide beside its height goes up and down again and again: grass.
fn is_zigzag(line: &Line) -> bool {
    let middle = line.middle().y;
    let crossings =
        line.points.windows(2).filter(|pair| (pair[0].y < middle) != (pair[1].y < middle)).count();
    line.size().y < ZIGZAG.0 * line.size().x && crossings > ZIGZAG.1
}

/// Where points of a line are from left to right that are so near to its foot.
fn near_foot(line: &Line, foot: Vec2, near: f32) -> impl Iterator<Item = f32> {
    line.points.iter().filter(move |p| p.distance(foot) < near).map(|p| p.x)
}

/// A pot with all its lines.
struct Pot {
    uses: Vec<usize>,
    /// Stems that hang over its edge, with their leaves.
    trailing: BTreeSet<usize>,
    low: Vec2,
    high: Vec2,
    size: Vec2,
}

impl Pot {
    /// The lines within a body's bounds, the bands at its upper edge and a saucer below.
    fn around(page: &Page, body: &[usize]) -> Self {
        let union = |a: (Vec2, Vec2), b: (Vec2, Vec2)| (a.0.min(b.0), a.1.max(b.1));
        let empty = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        let own = body.iter().map(|i| page.lines[*i].bounds).fold(empty, union);
        let rims = (0..page.lines.len()).filter(|i| !body.contains(i) && is_rim(&page.lines[*i], own));
        let (low, high) = rims.map(|i| page.lines[i].bounds).fold(own, union);
        let (size, upper) = (high - low, own.0.y);
        let is_part = |line: &Line| {
            let (l, h) = line.bounds;
            let within = l.x > low.x - 0.12 * size.x && h.x < high.x + 0.12 * size.x;
            let is_inside = l.y > upper - 0.1 * size.y;
            let is_wide = line.size().x > 0.6 * size.x;
            let is_collar = line.size().y < 0.5 * line.size().x && l.y > upper - 0.6 * size.y;
            let is_above =
                is_wide && (is_collar && h.y > upper - 0.15 * size.y || l.y > upper - 0.2 * size.x);
            within && h.y < high.y + 0.1 * size.y && (is_inside || is_above)
        };
        let belongs = |i: &usize| {
            let line = &page.lines[*i];
            body.contains(i) || is_rim(line, own) || is_part(line) || is_saucer(line, (low, high))
        };
        let uses: Vec<usize> = (0..page.lines.len()).filter(belongs).collect();
        let (low, high) = uses.iter().map(|i| page.lines[*i].bounds).fold((low, high), union);
        Self { uses, trailing: BTreeSet::new(), low, high, size: high - low }
    }

    /// Leaves out what of the uppermost rows is an end of a side that went too far.
    fn trim(&mut self, rows: &mut Vec<Row>) {
        let widest = rows.iter().map(Row::width).fold(0.0, f32::max);
        let above = rows.iter().take_while(|row| row.width() < 0.4 * widest).count();
        if above > 0 && (above as f32) < OVERSHOT * ROWS as f32 {
            rows.drain(..above);
            self.low.y += above as f32 / ROWS as f32 * self.size.y;
            self.size = self.high - self.low;
        }
    }

    fn hypothesis(self, rows: &[Row], score: f32) -> Hypothesis {
        let axis = 0.5 * (self.low.x + self.high.x);
        Hypothesis {
            uses: self.uses,
            score,
            parts: Vec::new(),
            solids: vec![Solid { kind: SolidKind::Pot, axis, profile: profile(rows) }],
            reading: Reading::Pot,
            habit: None,
        }
    }

    /// Whether its lines have two sides nearly all the way up, and no notches.
    fn is_box(&self, lines: &[&[Vec2]], rows: &[Row]) -> bool {
        let below: Vec<Vec2> = lines.concat().into_iter().filter(|p| p.y >= self.low.y).collect();
        let sides = rows.iter().flat_map(|row| [Vec2::new(row.left, row.y), Vec2::new(row.right, row.y)]);
        let all: Vec<Vec2> = below.into_iter().chain(sides.filter(|p| p.is_finite())).collect();
        let hull = convex_hull(&all, |p| *p);
        let hull_area = simple_loop::area(&hull);
        let between = rows.iter().map(Row::width).sum::<f32>() * self.size.y / rows.len().max(1) as f32;
        let two_sided = rows.iter().filter(|row| row.width() > 0.4 * self.size.x).count();
        self.size.y <= self.highest(lines) * self.size.x
            && between > SOLID * hull_area
            && 5 * two_sided >= 4 * rows.len()
    }

    /// Greatest height, in widths.
    fn highest(&self, lines: &[&[Vec2]]) -> f32 {
        let is_mouth = |line: &&[Vec2]| {
            let (low, high) = polyline::bounds(line.iter().copied());
            let is_level = high.y - low.y < LOWEST * (high.x - low.x);
            let is_high = high.y < self.low.y + MOUTH_LINE.1 * self.size.y;
            is_level && is_high && high.x - low.x > MOUTH_LINE.0 * self.size.x
        };
        if lines.iter().any(is_mouth) { VASE } else { HIGHEST }
    }

    /// Whether its upper edge is a band or an ellipse of its own.
    fn has_rim(&self, page: &Page) -> bool {
        let is_band = |line: &Line| {
            line.is_closed_and_solid()
                && line.size().y < RIM.0 * line.size().x
                && line.bounds.0.y < self.low.y + MOUTH_LINE.1 * self.size.y
        };
        self.uses.len() > 1 && self.uses.iter().any(|i| is_band(&page.lines[*i]))
    }

    fn others<'a>(&'a self, page: &'a Page) -> impl Iterator<Item = &'a Line> {
        let is_other = |i: &usize| self.uses.binary_search(i).is_err() && !self.trailing.contains(i);
        (0..page.lines.len()).filter(is_other).map(|i| &page.lines[i])
    }

    /// Whether something but level lines goes on below it, or something but straight lines beside it.
    fn stands_on_more(&self, page: &Page) -> bool {
        self.others(page).any(|line| {
            let is_level = line.size().y < 0.2 * line.size().x;
            let is_around = line.openness < AROUND
                && line.bounds.0.cmplt(self.low).all()
                && line.bounds.1.cmpgt(self.high).all();
            let is_beside = line.bounds.1.x < self.low.x || line.bounds.0.x > self.high.x;
            // The edge of a table.
            let is_straight = line.ends().0.distance(line.ends().1) > 0.97 * line.length;
            let is_other = is_beside && is_straight && line.length < self.size.x;
            let lower = if is_beside { BELOW.1 } else { BELOW.0 };
            !is_level && !is_other && !is_around && line.bounds.1.y > self.high.y + lower * self.size.y
        })
    }

    /// Whether lines stand in the upper edge, and nothing rests on it that reaches past both sides.
    fn has_plant(&self, page: &Page) -> bool {
        let rests = if self.has_rim(page) { RESTS.1 } else { RESTS.0 };
        if self.others(page).any(|line| self.is_covered_by(line, rests)) {
            return false;
        }
        let entries: Vec<Entry> = self.others(page).filter_map(|line| self.entry(line)).collect();
        let left = entries.iter().map(|entry| entry.left).fold(f32::INFINITY, f32::min);
        let right = entries.iter().map(|entry| entry.right).fold(f32::NEG_INFINITY, f32::max);
        let is_blade = |entry: &Entry| {
            let is_narrow = entry.right - entry.left < BLADES.1 * self.size.x;
            is_narrow && entry.lowest < self.low.y + BLADES.2 * self.size.y
        };
        let are_blades = entries.len() >= BLADES.0 && entries.iter().all(is_blade);
        let is_narrow = right - left < ENTRY * self.size.x;
        if entries.is_empty() { !self.trailing.is_empty() } else { are_blades || is_narrow }
    }

    /// Whether a line rests on the upper edge and reaches past both sides.
    fn is_covered_by(&self, line: &Line, rests: f32) -> bool {
        let at_edge =
            |p: &&Vec2| p.y > self.low.y - rests * self.size.y && p.y < self.low.y + 0.15 * self.size.y;
        let (left, right) = ends_of(line.points.iter().filter(at_edge).map(|p| p.x));
        let is_level = line.size().y < 0.1 * line.size().x;
        left < self.low.x && right > self.high.x && !is_level
    }

    /// Where a line that rises from the upper edge enters.
    fn entry(&self, line: &Line) -> Option<Entry> {
        let (above, below) = (self.low.y - MOUTH.0 * self.size.y, self.low.y + MOUTH.1 * self.size.y);
        let foot = line.points.iter().copied().reduce(|a, b| if b.y > a.y { b } else { a })?;
        let is_in_mouth = foot.x > self.low.x && foot.x < self.high.x && foot.y > above && foot.y < below;
        let rises = line.bounds.0.y < self.low.y - PLANT * self.size.y;
        // A leaf that leans over the edge enters where it begins.
        let (left, right) = ends_of(near_foot(line, foot, FOOT * self.size.x));
        (is_in_mouth && rises).then_some(Entry { left, right, lowest: line.bounds.1.y })
    }
}

/// Where a line enters a pot.
struct Entry {
    /// Its ends from left to right there.
    left: f32,
    right: f32,
    /// The height of its lowest point.
    lowest: f32,
}

/// The least and the greatest of some.
fn ends_of(values: impl Iterator<Item = f32>) -> (f32, f32) {
    values.fold((f32::INFINITY, f32::NEG_INFINITY), |(l, r), x| (l.min(x), r.max(x)))
}

#[cfg(test)]
#[path = "pot_tests.rs"]
mod tests;
