//! The blade that a group of lines encloses together: an outline in several strokes, halves of a leaf, lobes.
//!
//! The area of all lines of a group ([`Silhouette`]), gaps closed, without what is thin: stalks. Lines that run along its contour
//! are the outline, what of them is inside is the midrib, what sticks out a tail. What else lies in it and whether all of it is a
//! leaf is for [`leaf`](super::leaf) to say.
//!
//! Lobes of a leaf are as sharp as the notches between them or sharper; those of crowns and corollas are round and meet at sharp
//! notches ([`has_lobes_of_a_leaf`]). Limits: gaps wider than [`BRIDGE`] are closed between ends of arcs only ([`open_ends`]).

use super::blade::Blade;
use super::open_ends;
use crate::anatomy::conventions::page::{self, Line, Page};
use crate::anatomy::conventions::shapes::silhouette::{Silhouette, share_along, smooth_contour};
use crate::geom::{polyline, simple_loop};
use glam::{IVec2, Vec2};
use std::collections::HashSet;

/// How wide gaps are closed, in cells of the silhouette.
const BRIDGE: i32 = 9;
/// Half width of what is too thin to be a blade, in cells.
const THIN: f32 = 2.6;
/// Points of the contour.
const POINTS: usize = 160;
/// Distance from the contour within which a line runs along it, in cells.
const ALONG: f32 = 3.5;
/// Least share of a line's points along the contour, and of the contour that lines run along.
const OUTLINE: (f32, f32) = (0.4, 0.85);
/// Least length of a stretch of an outline's line inside of it to be a midrib, as a share of the blade's diagonal.
const MIDRIB: f32 = 0.35;
/// Least chord of such a stretch over its length.
const STRAIGHT: f32 = 0.75;
/// Largest opening of an outline of half a leaf, of which one side is the midrib.
const HALF: f32 = 0.2;
/// Least length of a scribble, over the diagonal of its bounds: a straight line is none.
const SCRIBBLE: f32 = 3.5;
/// Smallest group, as a share of the drawing's diagonal.
const SMALLEST: f32 = 0.15;
/// Most lines of a group.
const MOST_LINES: usize = 40;
/// Stretch over which lobes and notches turn, as a share of the contour, and most turn of notches over that of lobes.
const TURN: f32 = 0.025;
const CUSP: f32 = 1.25;
/// Least turn of a lobe or a notch, radians, and fewest notches of an outline with lobes.
const PEAK: f32 = 0.45;
const NOTCHES: usize = 3;
/// Most length of the lines of an outline, over its own, and least area of one that is closed, as a share of the blade's.
const LONGEST: f32 = 2.2;
const CLOSED: f32 = 0.3;

/// Fewest lines of an outline that may be the leaflets of a frond, and how many begin at one line then.
const LEAFLETS: (usize, f32) = (6, 0.7);
/// How near they come to that line at most, as a share of how far they go from it, and the least of that, in their lengths.
const AT_RACHIS: f32 = 0.15;
const FROM_RACHIS: f32 = 0.4;

/// The blade that a group of lines encloses, if a few of them draw its outline.
pub(crate) fn of_group(page: &Page, group: &[usize]) -> Option<Blade> {
    if !(2..=MOST_LINES).contains(&group.len()) {
        return None;
    }
    let lines = || group.iter().map(|i| page.lines[*i].points.as_slice());
    if !may_be_leaf(page, group) {
        return None;
    }
    let closing = open_ends::closing(page, group);
    let closed = || lines().chain(closing.iter().map(Vec::as_slice));
    let silhouette = Silhouette::new(closed(), BRIDGE).without_thin_parts(THIN);
    let ring = smooth_contour(&silhouette.contour(), POINTS, 2);
    if ring.len() < POINTS {
        return None;
    }
    let contour = Contour::new(&ring, ALONG * silhouette.cell());
    let outline: Vec<usize> =
        group.iter().copied().filter(|i| contour.share_of(&page.lines[*i]) > OUTLINE.0).collect();
    let drawn = outline.iter().map(|i| page.lines[*i].points.as_slice());
    let drawn = drawn.chain(closing.iter().map(Vec::as_slice));
    if share_along(&ring, drawn, contour.reach) < OUTLINE.1 || are_leaflets(page, group, &outline) {
        return None;
    }
    let drawn = || outline.iter().map(|i| &page.lines[*i]);
    let length: f32 = drawn().map(|line| line.length).sum();
    let is_leaflet = |line: &Line| line.openness < 0.2 && line.area < CLOSED * simple_loop::area(&ring);
    if length > LONGEST * polyline::length(&ring) || drawn().any(is_leaflet) {
        return None;
    }
    let mut blade = Blade { ring, is_whole: true, ..Blade::of(outline.clone()) };
    let diagonal = blade.diagonal();
    for line in outline.iter().map(|i| &page.lines[*i]) {
        contour.leave(line, &mut blade, diagonal);
    }
    Some(blade)
}

/// Whether most lines of an outline begin at the longest line of their group: leaflets, close together along their rachis.
fn are_leaflets(page: &Page, group: &[usize], outline: &[usize]) -> bool {
    let length = |i: &usize| page.lines[*i].length;
    let Some(rachis) = group.iter().copied().max_by(|a, b| length(a).total_cmp(&length(b))) else {
        return false;
    };
    let gap = |p: &Vec2| polyline::nearest(&page.lines[rachis].points, *p).map_or(f32::INFINITY, |it| it.0);
    // Two opposite ones may be taken for one line.
    let is_leaflet = |i: &&usize| {
        let gaps = || page.lines[**i].points.iter().map(gap);
        let (near, far) = (gaps().fold(f32::INFINITY, f32::min), gaps().fold(0.0, f32::max));
        **i != rachis && near < AT_RACHIS * far && far > FROM_RACHIS * length(i)
    };
    let leaflets = outline.iter().filter(is_leaflet).count();
    leaflets >= LEAFLETS.0 && leaflets as f32 > LEAFLETS.1 * outline.len() as f32
}

/// Whether lines may be a leaf, before their area is asked for: something may be the midrib, and nothing is scribbled.
fn may_be_leaf(page: &Page, group: &[usize]) -> bool {
    let lines = || group.iter().map(|i| &page.lines[*i]);
    let (low, high) = page::bounds(lines());
    let diagonal = low.distance(high);
    let chord = |line: &Line| line.ends().0.distance(line.ends().1);
    let is_midrib =
        |line: &Line| line.openness < HALF || chord(line) > MIDRIB * diagonal.min(2.0 * line.length);
    let is_scribble = |line: &Line| line.is_scribble() && line.length > SCRIBBLE * line.size().length();
    diagonal > SMALLEST * page.diagonal && lines().any(is_midrib) && !lines().any(is_scribble)
}

/// A contour, asked whether places are near it.
struct Contour {
    reach: f32,
    cells: HashSet<IVec2>,
}

impl Contour {
    fn new(ring: &[Vec2], reach: f32) -> Self {
        Self { reach, cells: ring.iter().map(|p| (p / reach).floor().as_ivec2()).collect() }
    }

    fn has(&self, p: Vec2) -> bool {
        let at = (p / self.reach).floor().as_ivec2();
        (-1..=1).any(|dx| (-1..=1).any(|dy| self.cells.contains(&(at + IVec2::new(dx, dy)))))
    }

    fn share_of(&self, line: &Line) -> f32 {
        let near = line.points.iter().filter(|p| self.has(**p)).count();
        near as f32 / line.points.len() as f32
    }

    /// Adds what of an outline's line is inside, and what sticks out at its ends.
    fn leave(&self, line: &Line, blade: &mut Blade, diagonal: f32) {
        let points = &line.points;
        let runs = points.chunk_by(|a, b| self.has(*a) == self.has(*b));
        let mut begin = 0;
        for run in runs {
            let end = begin + run.len();
            let (is_first, is_last) = (begin == 0, end == points.len());
            begin = end;
            if self.has(run[0]) {
                continue;
            }
            let holds = blade.holds(run[run.len() / 2]);
            let (length, chord) = (polyline::length(run), run[0].distance(run[run.len() - 1]));
            if holds && length > MIDRIB * diagonal && chord > STRAIGHT * length {
                blade.midrib = Some(run.to_vec());
            } else if !holds && (is_first || is_last) {
                let outward: Vec<Vec2> =
                    if is_first { run.iter().rev().copied().collect() } else { run.to_vec() };
                let begin = blade.ring[blade.nearest(outward[0]).0];
                blade.tails.push(std::iter::once(begin).chain(outward).collect());
            }
        }
    }
}

/// Whether the notches of an outline are no sharper than the lobes between them, by the lines that draw it.
pub(crate) fn has_lobes_of_a_leaf(page: &Page, blade: &Blade) -> bool {
    if page::notches(&blade.ring).len() < NOTCHES {
        return true;
    }
    let middle = blade.ring.iter().sum::<Vec2>() / blade.ring.len() as f32;
    let reach = TURN * polyline::length(&blade.ring);
    let (mut notches, mut lobes) = (Vec::new(), Vec::new());
    // The contour of an area is smooth, the lines themselves are not.
    let lines = blade.lines.iter().map(|i| page.lines[*i].points.as_slice());
    let drawn: Vec<&[Vec2]> = if blade.is_whole { lines.collect() } else { vec![&blade.ring] };
    for points in drawn {
        let step = polyline::length(points) / points.len() as f32;
        let reach = ((reach / step) as usize).max(1);
        let swept: f32 = points.windows(2).map(|w| (w[0] - middle).perp_dot(w[1] - middle)).sum();
        let turn = |i: usize| {
            let (before, here, after) = (points[i - reach], points[i], points[i + reach]);
            swept.signum() * (here - before).angle_to(after - here)
        };
        let turns: Vec<f32> = (reach..points.len().saturating_sub(reach)).map(turn).collect();
        notches.extend(peaks(&turns, -1.0, 2 * reach));
        lobes.extend(peaks(&turns, 1.0, 2 * reach));
    }
    let mean = |turns: &[f32]| turns.iter().sum::<f32>() / turns.len().max(1) as f32;
    mean(&notches) < CUSP * mean(&lobes)
}

/// The largest turns of one sign, each in its surroundings.
fn peaks(turns: &[f32], sign: f32, reach: usize) -> Vec<f32> {
    let is_peak = |i: &usize| {
        let here = sign * turns[*i];
        let (before, after) =
            (&turns[i.saturating_sub(reach)..*i], &turns[i + 1..turns.len().min(i + 1 + reach)]);
        here > PEAK && before.iter().all(|t| sign * t < here) && after.iter().all(|t| sign * t <= here)
    };
    (0..turns.len()).filter(is_peak).map(|i| turns[i].abs()).collect()
}
