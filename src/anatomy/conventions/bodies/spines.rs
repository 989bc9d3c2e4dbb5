//! Which strokes of a body are its spines: short ones on it, and straight ones across its outline.
//!
//! Short strokes that are several are spines anywhere. Longer straight ones may as well be sides of the outline, so a body is looked for
//! with them and without. What begins in a body and ends outside of it is nothing but a spine, and speaks for a cactus.

use crate::anatomy::conventions::page::{self, Line};
use crate::geom::{polyline, region::Region};
use glam::Vec2;

/// Longest spine anywhere, as a share of the whole, and fewest, if they are to be looked at by themselves.
const SHORT: (f32, usize) = (0.18, 2);
/// The same of spines that are straight, short ones counted, and least distance of their ends, as a share of their length.
const LONG: (f32, usize) = (0.34, 3);
const STRAIGHT: f32 = 0.85;
/// Most of the long ones that do not go across the outline, as a share.
const ASTRAY: f32 = 0.35;
/// How far a stalk goes on below a body, as a share of its height, least rise of one over its run, and least chord over its length.
const STALK: (f32, f32, f32) = (0.15, 2.0, 0.9);
/// How far from the outline a spine begins at most, as a share of its length.
const AT: f32 = 0.25;
/// Log-odds of each spine across the outline, from it outward, and on the body, up to so many.
const ACROSS: (f32, usize) = (0.7, 5);
const OUTWARD: (f32, usize) = (0.5, 5);
const ON_IT: (f32, usize) = (0.2, 5);
/// Fewest spines that speak for a body by themselves.
const MANY: usize = 3;

/// The lines of a body, and its spines apart from them.
pub(super) struct Spines<'a> {
    pub outlines: Vec<&'a Line>,
    short: Vec<&'a Line>,
    long: Vec<&'a Line>,
}

/// The ways to tell spines from outlines: with short ones only, and with long ones as well.
pub(super) fn ways_apart<'a>(lines: &[&'a Line], size: Vec2) -> Vec<Spines<'a>> {
    let lowest = page::bounds(lines.iter().copied()).1.y;
    let chord = |line: &Line| line.ends().0.distance(line.ends().1);
    let is_ground = |line: &Line| {
        let is_level = line.size().y < 0.1 * line.size().x && chord(line) > 0.9 * line.length;
        is_level && lowest - line.middle().y < 0.1 * size.y
    };
    let above: Vec<&Line> = lines.iter().copied().filter(|line| !is_ground(line)).collect();
    let is_short = |line: &&Line| line.length < SHORT.0 * size.length();
    let (short, outlines): (Vec<&Line>, Vec<&Line>) = above.iter().copied().partition(is_short);
    let (short, outlines) = if short.len() >= SHORT.1 { (short, outlines) } else { (Vec::new(), above) };
    let is_long = |line: &&Line| line.length < LONG.0 * size.length() && chord(line) > STRAIGHT * line.length;
    let (long, rest): (Vec<&Line>, Vec<&Line>) = outlines.iter().copied().partition(is_long);
    let mut ways = vec![Spines { outlines, short: short.clone(), long: Vec::new() }];
    if !long.is_empty() && short.len() + long.len() >= LONG.1 && !rest.is_empty() {
        ways.push(Spines { outlines: rest, short, long });
    }
    ways
}

impl Spines<'_> {
    /// Whether there are so many that they speak for a body by themselves.
    pub(super) fn are_many(&self) -> bool {
        self.count() >= MANY
    }

    /// Those that are longer than a width and lie for the most part outside of an outline from which they begin: twigs.
    pub(super) fn twigs(&self, outline: &[Vec2], width: f32) -> Vec<&Line> {
        let region = Region::new(outline.to_vec());
        let is_twig = |line: &&Line| {
            let outside = line.points.iter().filter(|p| !region.contains(**p)).count();
            let begins_there = [line.ends().0, line.ends().1].into_iter().any(|end| {
                region.contains(end)
                    || polyline::nearest(outline, end).is_some_and(|it| it.0 < AT * line.length)
            });
            line.length > width && 5 * outside > 3 * line.points.len() && begins_there
        };
        self.short.iter().chain(&self.long).copied().filter(is_twig).collect()
    }

    /// Whether one of them goes straight down from the foot of an outline, as the stalk of a leaf does.
    fn have_a_stalk(&self, outline: &[Vec2]) -> bool {
        let (high, low) = polyline::bounds(outline.iter().copied());
        let least = STALK.0 * (low.y - high.y);
        self.short.iter().chain(&self.long).any(|line| {
            let (first, last) = line.ends();
            let run = (last - first).abs();
            let is_steep = run.y > STALK.1 * run.x && run.length() > STALK.2 * line.length;
            is_steep && first.y.max(last.y) - low.y > least && first.y.min(last.y) > high.y.midpoint(low.y)
        })
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.short.len() + self.long.len()
    }

    /// What the spines add to the log-odds of a body; none where long strokes are not its spines.
    pub(super) fn log_odds(&self, outline: &[Vec2]) -> Option<f32> {
        if self.have_a_stalk(outline) {
            return None;
        }
        let region = Region::new(outline.to_vec());
        let (mut across, mut outward, mut on_it, mut astray) = (0, 0, 0, 0);
        for (line, is_long) in
            self.short.iter().map(|l| (l, false)).chain(self.long.iter().map(|l| (l, true)))
        {
            let inside = line.points.iter().filter(|p| region.contains(**p)).count() as f32;
            let share = inside / line.points.len() as f32;
            let begins_there =
                |end: Vec2| polyline::nearest(outline, end).is_some_and(|(gap, _)| gap < AT * line.length);
            match share {
                0.15..0.85 => across += 1,
                0.85.. => on_it += 1,
                _ if begins_there(line.ends().0) || begins_there(line.ends().1) => outward += 1,
                _ => astray += usize::from(is_long),
            }
        }
        let are_spines = astray as f32 <= ASTRAY * self.long.len() as f32;
        let of = |count: usize, (each, most): (f32, usize)| each * count.min(most) as f32;
        let odds = of(across, ACROSS) + of(outward, OUTWARD) + of(on_it, ON_IT);
        are_spines.then_some(odds)
    }
}
