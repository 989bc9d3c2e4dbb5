//! A trunk of two sides that carries several clouds of foliage, as those of a bonsai, an old pine or an acacia are drawn.
//!
//! Each cloud is a closed outline with shallow lobes. The trunk is the pair of lines that rise side by side from the lowest place; it ends
//! where they part. A line from it to a cloud is a bough; a cloud without one gets one from the nearest place of the trunk below it.
//!
//! One cloud on a trunk is an ordinary tree ([`tree`](super::tree)), and scalloped outlines on single lines are flowers.
//!
//! Limits: clouds without lobes, clouds whose outlines are open, trunks of one line.

use super::evidence;
use crate::anatomy::conventions::page::{self, Line, Page, even, median};
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::geom::polyline;
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Fewest and most clouds, and most lines that are looked at.
const CLOUDS: (usize, usize) = (2, 12);
const MOST: usize = 60;
/// Of a cloud: most gap of its outline, least extent, as a share of the tree's diagonal, and least and most width over its height.
const OUTLINE: (f32, f32) = (0.12, 0.15);
const WIDE: (f32, f32) = (0.75, 5.0);
/// Fewest lobes, and points of an outline.
const LOBES: usize = 5;
const POINTS: usize = 120;
/// Of a side of the trunk: least length, as a share of the tree's height, least chord over its length, and height of its foot above the
/// lowest place at most, as a share of the tree's height.
const SIDE: (f32, f32, f32) = (0.3, 0.6, 0.12);
/// How far apart feet of sides are, as shares of the shorter side's length, at least and at most.
const APART: (f32, f32) = (0.03, 0.4);
/// Width from which sides have parted, in their middle width, and rows of a trunk.
const PARTED: f32 = 2.0;
const ROWS: usize = 32;
/// How near a bough comes to the trunk and to its cloud, as a share of the tree's diagonal; its least chord over its length.
const NEAR: f32 = 0.07;
const STRAIGHT: f32 = 0.75;
/// Slope of a bough that a cloud without one gets.
const RISE: f32 = 0.4;
/// Half width of a trunk in its cloud, as a share of that where its sides end.
const TAPER: f32 = 0.4;
/// Log-odds, and more for each cloud.
const SCORE: (f32, f32) = (5.0, 1.6);

/// Proposes a tree for each group of lines that has a trunk and several clouds.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let groups = page.groups.iter().chain(&page.wide_groups);
    out.extend(groups.filter(|group| group.len() <= MOST).filter_map(|group| tree(page, group)));
}

fn tree(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    let bounds = page::bounds(group.iter().map(|i| &page.lines[*i]));
    let diagonal = bounds.0.distance(bounds.1);
    let (clouds, others): (Vec<usize>, Vec<usize>) =
        group.iter().partition(|i| is_cloud(&page.lines[**i], diagonal));
    if !(CLOUDS.0..=CLOUDS.1).contains(&clouds.len()) || has_centre(page, &clouds, &others) {
        return None;
    }
    let mut trunk = Trunk::new(page, &others, bounds)?;
    let mut is_carried = vec![false; clouds.len()];
    if let Some(top) = trunk.lead_into(clouds.iter().map(|i| &page.lines[*i])) {
        is_carried[top] = true;
    }
    let mut boughs = Vec::new();
    for number in others.into_iter().filter(|i| !trunk.sides.contains(i)) {
        let line = &page.lines[number];
        if clouds.iter().any(|cloud| page.lines[*cloud].is_around(line)) {
            continue;
        }
        let (way, cloud) = bough(page, line, &trunk, (&clouds, NEAR * diagonal))?;
        is_carried[cloud] = true;
        boughs.push(way);
    }
    let bare = clouds.iter().zip(is_carried).filter(|(_, is_carried)| !is_carried);
    boughs.extend(bare.map(|(cloud, _)| trunk.bough_to(page.lines[*cloud].middle())));
    let crowns = clouds.iter().map(|i| Made::new(Tool::Crown, even(&page.lines[*i].points, POINTS)));
    let boughs = boughs.into_iter().map(|way| Made::new(Tool::Branch, way));
    Some(Hypothesis {
        uses: group.to_vec(),
        score: SCORE.0 + SCORE.1 * clouds.len() as f32,
        parts: std::iter::once(trunk.branch()).chain(boughs).chain(crowns).collect(),
        solids: Vec::new(),
        reading: Reading::Tree,
        habit: Some(Habit::Tree),
    })
}

fn is_cloud(line: &Line, diagonal: f32) -> bool {
    let size = line.size();
    line.openness < OUTLINE.0
        && size.length() > OUTLINE.1 * diagonal
        && (WIDE.0..WIDE.1).contains(&(size.x / size.y.max(f32::MIN_POSITIVE)))
        && !line.is_scribble()
        && page::notches(&even(&line.points, POINTS)).len() >= LOBES
        && evidence::has_shallow_lobes(&even(&line.points, POINTS))
}

/// Whether a cloud is a corolla, with an outline in its middle.
fn has_centre(page: &Page, clouds: &[usize], others: &[usize]) -> bool {
    let others: Vec<&Line> = others.iter().map(|i| &page.lines[*i]).collect();
    clouds.iter().any(|cloud| evidence::has_flower_centre(&others, &page.lines[*cloud].points))
}

/// A line from the trunk to a cloud, from its middle on, with the cloud's place among these.
fn bough(
    page: &Page,
    line: &Line,
    trunk: &Trunk,
    (clouds, near): (&[usize], f32),
) -> Option<(Vec<Vec2>, usize)> {
    let mut way = line.beginning_at(|end| trunk.nearest(end).0.distance(end));
    let (base, tip) = (way[0], way[way.len() - 1]);
    let (root, half) = trunk.nearest(base);
    let is_bough = root.distance(base) < half + near && base.distance(tip) > STRAIGHT * line.length;
    let gap = |cloud: &usize| {
        let cloud = &page.lines[*cloud];
        let (low, high) = cloud.bounds;
        let is_in = tip.cmpge(low).all() && tip.cmple(high).all();
        let off = polyline::nearest(&cloud.points, tip).map_or(f32::INFINITY, |(gap, _)| gap);
        if is_in { 0.0 } else { off }
    };
    let gaps = clouds.iter().map(gap).enumerate();
    let (cloud, gap) = gaps.min_by(|a, b| a.1.total_cmp(&b.1))?;
    way.insert(0, root);
    (is_bough && gap < near).then_some((way, cloud))
}

/// A trunk of two sides.
struct Trunk {
    sides: [usize; 2],
    /// Middles and half widths from its foot up.
    rows: Vec<(Vec2, f32)>,
}

impl Trunk {
    /// The first two lines, by the height of their feet, that rise side by side from the lowest place.
    fn new(page: &Page, lines: &[usize], (low, high): (Vec2, Vec2)) -> Option<Self> {
        let height = high.y - low.y;
        let side = |number: usize| {
            let line = &page.lines[number];
            let (first, last) = line.ends();
            let way = line.upward();
            let is_one = line.length > SIDE.0 * height
                && first.distance(last) > SIDE.1 * line.length
                && high.y - way[0].y < SIDE.2 * height;
            is_one.then_some((number, way))
        };
        let mut sides: Vec<(usize, Vec<Vec2>)> = lines.iter().copied().filter_map(side).collect();
        sides.sort_by(|a, b| b.1[0].y.total_cmp(&a.1[0].y));
        let [(a, left), (b, right)] = &sides[..] else { return None };
        let long = page.lines[*a].length.min(page.lines[*b].length);
        let pairs = even(left, ROWS).into_iter().zip(even(right, ROWS));
        let mut rows: Vec<(Vec2, f32)> = pairs.map(|(a, b)| (a.midpoint(b), 0.5 * a.distance(b))).collect();
        let middle = median(&mut rows.iter().map(|row| row.1).collect::<Vec<_>>());
        let parted = rows.iter().position(|row| row.1 > PARTED * middle).unwrap_or(ROWS);
        rows.truncate(parted);
        let is_trunk = (APART.0..APART.1).contains(&(2.0 * rows.first()?.1 / long)) && 2 * parted >= ROWS;
        is_trunk.then_some(Self { sides: [*a, *b], rows })
    }

    /// The row nearest to a place.
    fn nearest(&self, place: Vec2) -> (Vec2, f32) {
        let gap = |row: &&(Vec2, f32)| row.0.distance_squared(place);
        self.rows.iter().min_by(|a, b| gap(a).total_cmp(&gap(b))).copied().unwrap_or((place, 0.0))
    }

    /// A bough to the middle of a cloud, from the highest place of the trunk from which it rises.
    fn bough_to(&self, middle: Vec2) -> Vec<Vec2> {
        let rises = |row: &&(Vec2, f32)| row.0.y - middle.y > RISE * (row.0.x - middle.x).abs();
        let root = self.rows.iter().rev().find(rises).map_or(self.rows[self.rows.len() / 2].0, |row| row.0);
        vec![root, root.midpoint(middle) + Vec2::new(0.0, 0.05 * root.distance(middle)), middle]
    }

    /// Leads it on, thinner, to the middle of the cloud in or below which it ends; gives the cloud's place among these.
    fn lead_into<'a>(&mut self, clouds: impl Iterator<Item = &'a Line>) -> Option<usize> {
        let (top, half) = *self.rows.last()?;
        let is_above = |cloud: &Line| {
            let (low, high) = cloud.bounds;
            top.x > low.x && top.x < high.x && cloud.middle().y < top.y
        };
        let above = clouds.enumerate().filter(|(_, cloud)| is_above(cloud));
        let (place, cloud) = above.max_by(|a, b| a.1.middle().y.total_cmp(&b.1.middle().y))?;
        self.rows.push((cloud.middle(), TAPER * half));
        Some(place)
    }

    /// It as a branch with its drawn width.
    fn branch(&self) -> Made {
        Made::thick(self.rows.iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;
    use std::f32::consts::TAU;

    /// A cloud of nine lobes, twice as wide as high.
    fn cloud(x: f32, y: f32, size: f32) -> Vec<Vec2> {
        let place = |k: usize| {
            let angle = TAU * k as f32 / 160.0;
            let reach = size * (0.88 + 0.16 * (4.5 * angle).sin().abs());
            Vec2::new(x, y) + reach * Vec2::new(angle.cos(), 0.5 * angle.sin())
        };
        (0..=160).map(place).collect()
    }

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    fn trunk(left: f32, right: f32) -> [Vec<Vec2>; 2] {
        [left, right].map(|x| line(&[(x, 0.0), (x + 12.0, -70.0), (x + 4.0, -150.0), (x, -200.0)]))
    }

    #[test]
    fn clouds_on_a_trunk_of_two_sides_are_crowns_each_on_a_bough() {
        let [left, right] = trunk(-10.0, 10.0);
        let bough = line(&[(14.0, -110.0), (45.0, -130.0), (75.0, -140.0)]);
        let clouds = [cloud(5.0, -210.0, 60.0), cloud(95.0, -150.0, 45.0), cloud(-60.0, -130.0, 50.0)];
        let lines: Vec<Vec<Vec2>> = [left, right, bough].into_iter().chain(clouds).collect();
        let read = read(&lines);
        assert_eq!(read.first().map(|tree| tree.uses.clone()), Some(vec![0, 1, 2, 3, 4, 5]));
        let count = |tool: Tool| read[0].parts.iter().filter(|part| part.tool == tool).count();
        // The trunk itself leads into the cloud at its top.
        assert_eq!((count(Tool::Branch), count(Tool::Crown)), (3, 3));
        assert!(read[0].parts[0].half_width.is_some_and(|half| (half - 10.0).abs() < 2.0));
    }

    #[test]
    fn clouds_on_a_single_line_and_corollas_are_none() {
        let [left, right] = trunk(-10.0, 10.0);
        let clouds = [cloud(5.0, -210.0, 60.0), cloud(-60.0, -130.0, 50.0)];
        assert!(read(&[vec![left.clone()], clouds.to_vec()].concat()).is_empty());
        let centre: Vec<Vec2> = (0..=30)
            .map(|k| Vec2::new(5.0, -210.0) + 15.0 * Vec2::from_angle(TAU * k as f32 / 30.0))
            .collect();
        assert!(read(&[vec![left, right, centre], clouds.to_vec()].concat()).is_empty());
    }
}
