//! All lines of a drawing at once: what they enclose, and where a head ends and a stalk begins.
//!
//! The division of a drawing is the height at which two widths, one above and one below, explain the widths of its rows best, in
//! the sense of least squares (N. Otsu, “A threshold selection method from gray-level histograms”, 1979, over rows in place of
//! grey levels). What lines enclose is found with gaps closed as little as needed, else it is their convex hull.
//!
//! Limits: a drawing that is wider below than above has no stalk.

use crate::anatomy::conventions::page::{Line, Page, even, notches};
use crate::anatomy::conventions::shapes::silhouette::{Silhouette, smooth_contour};
use crate::anatomy::conventions::trees::evidence;
use crate::anatomy::conventions::trees::trunk::{Rows, Trunk};
use crate::geom::{convex_hull::convex_hull, simple_loop};
use glam::Vec2;

/// How wide gaps are closed, in cells of the silhouette, one after the other.
const BRIDGES: [i32; 4] = [8, 16, 24, 36];
/// Least share of its convex hull that an area fills.
const SOLID: f32 = 0.6;
/// Points of an outline.
const POINTS: usize = 160;
/// Shortest and longest stalk, as shares of the height, and its width at most, as a share of the head's.
const STALK: (f32, f32) = (0.1, 0.8);
const NARROW: f32 = 0.65;
/// Largest opening of the outline of a blade, and least share of its hull that it encloses.
const BLADE: (f32, f32) = (0.35, 0.7);
/// Smallest of these that is large, as a share of the drawing, and most of them in a drawing that is not in the papers' way.
const LARGE: f32 = 0.01;
const BLADES: usize = 2;
/// Share of the lines' length from which outlines of blades are most of what is drawn.
const INK: f32 = 0.5;

/// The lines of a page, with their rows.
pub(super) struct View<'a> {
    pub page: &'a Page,
    /// The lines that are looked at, ascending.
    pub own: Vec<usize>,
    pub lines: Vec<&'a Line>,
    pub rows: Rows,
}

impl<'a> View<'a> {
    /// These lines of a page, ascending; nothing where they have no height.
    pub(super) fn of(page: &'a Page, own: Vec<usize>) -> Option<Self> {
        let lines: Vec<&Line> = own.iter().map(|line| &page.lines[*line]).collect();
        let rows = Rows::new(&lines)?;
        Some(Self { page, own, lines, rows })
    }

    /// Whether this is a drawing in the papers' way, each petal and each leaf an outline of its own: there are several, and they are
    /// large or most of what is drawn.
    pub(super) fn is_of_blades(&self) -> bool {
        let inked = |lines: &mut dyn Iterator<Item = &&Line>| lines.map(|line| line.length).sum::<f32>();
        let outlines = || self.lines.iter().filter(|line| is_blade(line));
        self.blades() > BLADES
            || outlines().count() > BLADES && inked(&mut outlines()) > INK * inked(&mut self.lines.iter())
    }

    /// Whether lines enclose something, and none of them is a large outline of a blade by itself, which has few notches.
    pub(super) fn is_outline_without_blades(&self) -> bool {
        let size = self.rows.width_and_height();
        let is_large = |line: &&&Line| is_blade(line) && line.area > LARGE * size.x * size.y;
        let is_lobed = |line: &Line| notches(&line.points).len() >= evidence::NOTCHES;
        self.lines.iter().filter(is_large).all(|line| is_lobed(line))
            && evidence::has_outline(&self.lines, size)
    }

    /// How many lines are outlines of blades by themselves, and large.
    pub(super) fn blades(&self) -> usize {
        let size = self.rows.width_and_height();
        self.lines.iter().filter(|line| is_blade(line) && line.area > LARGE * size.x * size.y).count()
    }

    /// The stalk below the head, if there is one.
    pub(super) fn stalk(&self) -> Option<Trunk> {
        let widths: Vec<f32> = self.rows.ends().map(|(left, right, _)| right - left).collect();
        let top = division(&widths)?;
        Some(self.rows.below(top))
    }

    /// What is drawn above a stalk.
    pub(super) fn above(&self, stalk: &Trunk) -> Vec<Vec<Vec2>> {
        self.lines.iter().flat_map(|line| line.above(stalk.top)).collect()
    }

    /// All lines.
    pub(super) fn all(&self) -> Vec<Vec<Vec2>> {
        self.lines.iter().map(|line| line.points.clone()).collect()
    }
}

fn is_blade(line: &Line) -> bool {
    line.openness < BLADE.0 && line.solidity() > BLADE.1
}

/// The outline of what lines enclose, first point not repeated; nothing where that has no area.
pub(super) fn outline(lines: &[Vec<Vec2>]) -> Option<Vec<Vec2>> {
    let ink: Vec<Vec2> = lines.iter().flatten().copied().collect();
    let mut hull = convex_hull(&ink, |p| *p);
    let area = simple_loop::area(&hull);
    let enclosed = |bridge: &i32| {
        let silhouette = Silhouette::new(lines.iter().map(Vec::as_slice), *bridge);
        let outline = smooth_contour(&silhouette.contour(), POINTS, 1);
        (simple_loop::area(&outline) > SOLID * area).then_some(outline)
    };
    if hull.len() < 3 || area <= 0.0 {
        return None;
    }
    BRIDGES.iter().find_map(enclosed).or_else(|| {
        hull.push(hull[0]);
        let mut around = even(&hull, POINTS + 1);
        around.pop();
        Some(around)
    })
}

/// The number of rows below the head of a drawing with these widths, from below.
fn division(widths: &[f32]) -> Option<usize> {
    let count = widths.len() as f32;
    let whole: f32 = widths.iter().sum();
    let (mut below, mut best) = (0.0, None);
    for (row, width) in widths.iter().enumerate() {
        let (share, n) = (row as f32 / count, row as f32);
        let (lower, upper) = (below / n.max(1.0), (whole - below) / (count - n));
        // What two means explain of the squares.
        let explained = n * (count - n) * (upper - lower) * (upper - lower);
        let is_stalk = (STALK.0..=STALK.1).contains(&share) && lower < NARROW * upper;
        if is_stalk && best.is_none_or(|(most, _)| explained > most) {
            best = Some((explained, row));
        }
        below += width;
    }
    best.map(|(_, row)| row)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::polyline;
    use std::f32::consts::TAU;

    fn arc(from: f32, to: f32) -> Vec<Vec2> {
        let angle = |k: usize| TAU * (from + (to - from) * k as f32 / 60.0);
        (0..=60).map(|k| Vec2::new(0.0, -150.0) + 50.0 * Vec2::from_angle(angle(k))).collect()
    }

    #[test]
    fn a_stalk_ends_where_the_head_begins_in_one_line_or_two() {
        let side = |x: f32| even(&[Vec2::new(x, -100.0), Vec2::new(x, 0.0)], 60);
        for sides in [vec![side(0.0)], vec![side(-10.0), side(10.0)]] {
            let page = Page::of_lines(&[vec![arc(0.0, 1.0)], sides.clone()].concat());
            let stalk = View::of(&page, (0..page.lines.len()).collect()).unwrap().stalk().unwrap();
            assert!((-112.0..-88.0).contains(&stalk.top), "{}", stalk.top);
            let half = if sides.len() == 1 { 2.0..6.0 } else { 8.0..12.0 };
            assert!(half.contains(&stalk.narrow), "{}", stalk.narrow);
        }
    }

    /// Petals around a place, each an outline.
    fn petals(place: Vec2) -> Vec<Vec<Vec2>> {
        let petal = |k: usize| {
            let along = Vec2::from_angle(TAU * k as f32 / 5.0);
            let at = |t: f32, side: f32| {
                place + along * (15.0 + 50.0 * t) + along.perp() * side * 36.0 * t * (1.0 - t)
            };
            let out = (0..=15).map(|i| at(i as f32 / 15.0, 1.0));
            let back = (0..=15).rev().map(|i| at(i as f32 / 15.0, -1.0));
            even(&out.chain(back).collect::<Vec<_>>(), 50)
        };
        (0..5).map(petal).collect()
    }

    #[test]
    fn petals_that_are_outlines_are_drawn_in_the_papers_way_however_many_flowers_there_are() {
        let is_of_blades = |lines: &[Vec<Vec2>]| {
            let page = Page::of_lines(lines);
            View::of(&page, (0..page.lines.len()).collect()).unwrap().is_of_blades()
        };
        let flower = petals(Vec2::ZERO);
        assert!(is_of_blades(&flower));
        let row = |k: usize| petals(Vec2::new(300.0 * k as f32, 400.0 * (k % 2) as f32));
        assert!(is_of_blades(&(0..6).flat_map(row).collect::<Vec<_>>()));
        assert!(!is_of_blades(&flower[..BLADES]));
        assert!(!is_of_blades(&[arc(0.0, 0.5), arc(0.5, 1.0)]));
    }

    #[test]
    fn what_is_as_wide_below_has_no_stalk() {
        assert!(division(&[5.0; 40]).is_none());
        assert_eq!(division(&[[2.0; 10], [9.0; 10]].concat()), Some(10));
    }

    #[test]
    fn outlines_with_gaps_are_closed_and_points_on_a_line_have_none() {
        let quarters = [arc(0.0, 0.22), arc(0.25, 0.47), arc(0.5, 0.72), arc(0.75, 0.97)];
        let outline = outline(&quarters).unwrap();
        let area = simple_loop::area(&outline);
        assert!((0.9..1.1).contains(&(area / (50.0 * 50.0 * 0.5 * TAU))), "{area}");
        assert!(polyline::length(&outline) > 250.0);
        assert!(super::outline(&[vec![Vec2::ZERO, Vec2::X, 2.0 * Vec2::X]]).is_none());
    }
}
