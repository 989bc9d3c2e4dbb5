//! A tree whose trunk is a single line: a crown of lobes, a scribble or a round outline on it.
//!
//! The trunk is the lowest line of a group, straight and upright, or the tail of an outline in one stroke with it; all else is above
//! its foot. The crown is what the other lines enclose ([`crown`](super::tree::crown)). What stands on a single line may be a
//! flower or a leaf, too. A crown has shallow lobes without sharp tips, or is scribbled over, or is round with nothing in it, or has
//! branches that leave the trunk or fork it and end before the outline, and its trunk is not much longer than itself. The lobes of a
//! corolla are deep; a blade has a tip away from its stalk, a midrib that runs on to it, and veins that reach its edge. A dash across
//! the foot of the trunk is the ground.
//!
//! Limits: a round flower on a short stem, without petals, is read as a tree.

use super::evidence;
use super::tree::crown;
use super::trunk::Trunk;
use crate::anatomy::conventions::page::{self, Line, Page, notches};
use crate::anatomy::conventions::shapes::{balls, forks::Forked, stem_tail};
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::geom::{polyline, simple_loop::hull_area};
use crate::sketch::Reading;
use crate::sketch::Tool;
use glam::Vec2;
use std::borrow::Cow;

/// Smallest tree, as a share of the drawing's diagonal.
const SMALLEST: f32 = 0.2;
/// Least chord of a trunk over its length, most run over its rise, and how high above the lowest point its foot may be, as a share
/// of the whole height.
const STRAIGHT: f32 = 0.9;
const LEAN: f32 = 0.6;
const LOW: f32 = 0.06;
/// Distance of two lines that are one trunk, as a share of the diagonal of their bounds.
const DOUBLED: f32 = 0.06;
/// Shortest and longest trunk below the crown, in heights of that.
const BELOW: (f32, f32) = (0.12, 1.6);
/// Sharp tips that a crown may have.
const TIPS: usize = 1;
/// Mean distance of the longest line's notches from the middle, that of an ellipse being 1, below which it draws petals.
const PETALS: f32 = 0.56;
/// Stretch of an outline over which a tip turns, as a share of its length, and least turn there, radians.
const TIP: (f32, f32) = (0.06, 1.1);
/// Least share of its crown that scribbles cover.
const SCRIBBLED: f32 = 0.4;
/// Narrowest and widest of a round crown, in its heights, and how far its trunk enters, as a share of its height.
const ROUND: (f32, f32) = (0.6, 1.8);
const ENTERS: f32 = 0.6;
/// How far lines may hang out of a crown, as a share of the whole height.
const AT: f32 = 0.05;
/// Highest dash at the foot of a trunk over its width, and widest over the height of the whole.
const DASH: (f32, f32) = (0.15, 0.5);
/// Log-odds where lobes, a scribble or twigs speak for a crown, and where only its round form does; and more for twigs.
const SCORE: (f32, f32) = (4.3, 1.5);
const FORKED: f32 = 0.5;

/// Proposes trees, one for each group of lines at most.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    out.extend(page.groups.iter().chain(&page.wide_groups).filter_map(|group| tree(page, group)));
}

fn tree(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    let low = group.iter().map(|i| page.lines[*i].bounds.1.y).fold(f32::NEG_INFINITY, f32::max);
    let high = group.iter().map(|i| page.lines[*i].bounds.0.y).fold(f32::INFINITY, f32::min);
    let height = low - high;
    if height < SMALLEST * page.diagonal {
        return None;
    }
    let (points, lines) = parted(page, group, low - LOW * height)?;
    let crown_low = lines.iter().map(|line| line.bounds.1.y).fold(f32::NEG_INFINITY, f32::max);
    let visible = points[0].y - crown_low;
    let is_of_form = (BELOW.0..BELOW.1).contains(&(visible / (crown_low - high)));
    let whole: Vec<&Line> = lines.iter().map(|line| &**line).collect();
    let size = page::bounds(whole.iter().copied());
    let size = size.1 - size.0;
    if !is_of_form || evidence::has_blades(&whole, size) || !evidence::has_outline(&whole, size) {
        return None;
    }
    let trunk = Trunk::of_line(&points, crown_low, height)?;
    let outline = crown(whole.iter().map(|line| line.points.clone()).collect(), &trunk)?;
    // What hangs out of a crown is no part of one.
    let lowest = outline.iter().map(|p| p.y).fold(f32::NEG_INFINITY, f32::max);
    if crown_low - lowest > AT * height {
        return None;
    }
    let uses = page.with_what_is_inside(group, &outline);
    let all: Vec<&Line> = uses.iter().map(|i| &page.lines[*i]).collect();
    if evidence::has_flower_centre(&all, &outline) || evidence::has_fan(&all, &outline, trunk.axis()) {
        return None;
    }
    let score = Crown { outline: &outline, lines: &whole, trunk: &points }.score()?;
    let solids = balls::in_crown(all.into_iter(), &outline);
    let parts = vec![trunk.centre_line(&outline), Made::new(Tool::Crown, outline)];
    let (reading, habit) = (Reading::Tree, Some(Habit::Tree));
    Some(Hypothesis { uses, score: score * page.weight(height), parts, solids, reading, habit })
}

/// Whether a line is a dash across the foot of something of that height.
fn is_dash(line: &Line, height: f32) -> bool {
    let size = line.size();
    size.y < DASH.0 * size.x && size.x < DASH.1 * height && line.length < 1.2 * size.x
}

/// The trunk of a group of lines from its foot up, and what stands on it.
fn parted<'a>(page: &'a Page, group: &[usize], lowest: f32) -> Option<(Vec<Vec2>, Vec<Cow<'a, Line>>)> {
    let (low, high) = page::bounds(group.iter().map(|i| &page.lines[*i]));
    let is_low = |i: &usize| page.lines[*i].bounds.1.y > lowest;
    let is_ground = |i: &usize| is_low(i) && is_dash(&page.lines[*i], high.y - low.y);
    let uprights = || group.iter().filter(|i| !is_ground(i));
    let mut lowest_lines = uprights().filter(|i| is_low(i));
    let (&first, None) = (lowest_lines.next()?, lowest_lines.next()) else { return None };
    let others = uprights().filter(|i| **i != first).map(|i| Cow::Borrowed(&page.lines[*i]));
    let line = &page.lines[first];
    let (begin, end) = line.ends();
    let run = end - begin;
    if run.length() > STRAIGHT * line.length && run.x.abs() < LEAN * run.y.abs() {
        return Some((line.upward(), others.collect()));
    }
    let (stem, rest) = stem_tail::cut(line).or_else(|| doubled(line))?;
    Some((stem, others.chain([Cow::Owned(rest)]).collect()))
}

/// A stem that is drawn up and down again by one line, and the rest of that.
fn doubled(line: &Line) -> Option<(Vec<Vec2>, Line)> {
    let (points, near) = (&line.points, DOUBLED * line.size().length());
    let last = points.len() - 1;
    let is_near = |k: &usize| points[*k].distance(points[last - k]) < near;
    let top = (0..last / 3).take_while(is_near).last()?;
    let run = points[0] - points[top];
    let is_stem = run.y > LEAN * run.x.abs() && run.length() > STRAIGHT * polyline::length(&points[..=top]);
    let rest = line.part(points[top..=last - top].to_vec())?;
    let stem = (0..=top).map(|k| points[k].midpoint(points[last - k])).collect();
    (is_stem && rest.bounds.1.y < points[0].y - 0.5 * run.y).then_some((stem, rest))
}

/// What may be a crown on a line.
struct Crown<'a> {
    outline: &'a [Vec2],
    lines: &'a [&'a Line],
    /// The trunk from its foot up.
    trunk: &'a [Vec2],
}

impl Crown<'_> {
    /// Log-odds that it is one.
    fn score(&self) -> Option<f32> {
        let area = hull_area(self.outline);
        let scribbled: f32 =
            self.lines.iter().filter(|line| line.is_scribble()).map(|line| line.hull_area).sum();
        if scribbled > SCRIBBLED * area {
            return Some(SCORE.0);
        }
        if page::tips(self.outline, TIP).len() > TIPS {
            return None;
        }
        let has_lobes = evidence::has_shallow_lobes(self.outline) && !self.has_petals();
        let forked = Forked::new(self.outline, self.trunk);
        if !forked.has_tip() && forked.has_twigs(self.lines.iter().copied()) {
            return Some(SCORE.0 + FORKED);
        }
        if has_lobes {
            return Some(SCORE.0);
        }
        (notches(self.outline).len() < evidence::NOTCHES && self.is_round()).then_some(SCORE.1)
    }

    fn bounds(&self) -> (Vec2, Vec2) {
        let first = self.outline[0];
        self.outline.iter().fold((first, first), |(low, high), p| (low.min(*p), high.max(*p)))
    }

    /// Whether the longest line has deep notches: the outline of the whole has none where they are narrow.
    fn has_petals(&self) -> bool {
        let longest = self.lines.iter().max_by(|a, b| a.length.total_cmp(&b.length));
        let Some(line) = longest else { return false };
        // Where its ends meet there may be a notch that nobody drew.
        let (first, last) = line.ends();
        let away = |p: &Vec2| p.distance(first).min(p.distance(last)) > 0.1 * line.size().length();
        let deep: Vec<Vec2> = notches(&line.points).into_iter().filter(away).collect();
        deep.len() >= evidence::NOTCHES && evidence::depth(self.outline, &deep) < PETALS
    }

    /// Whether it is as wide as high, about, and alone on its trunk, which ends in it.
    fn is_round(&self) -> bool {
        let (low, high) = self.bounds();
        let size = high - low;
        let top = self.trunk[self.trunk.len() - 1].y;
        let has_tip = !page::tips(self.outline, TIP).is_empty();
        self.lines.len() == 1
            && !has_tip
            && (ROUND.0..ROUND.1).contains(&(size.x / size.y))
            && (low.y + (1.0 - ENTERS) * size.y..high.y + 0.1 * size.y).contains(&top)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;
    use std::f32::consts::TAU;

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    /// A ring of `lobes` about (0, -100), each rising by `depth` of the radius.
    fn cloud(lobes: f32, depth: f32) -> Vec<Vec2> {
        let place = |k: usize| {
            let angle = TAU * k as f32 / 200.0;
            let reach = 45.0 * (1.0 + depth * (0.5 * lobes * angle).sin().abs());
            Vec2::new(0.0, -100.0) + reach * Vec2::new(-angle.sin(), angle.cos())
        };
        (0..=200).map(place).collect()
    }

    fn stem() -> Vec<Vec2> {
        line(&[(0.0, 40.0), (0.0, -58.0)])
    }

    #[test]
    fn shallow_lobes_a_disc_and_a_scribble_on_a_line_are_trees() {
        let scribble = (0..600).map(|k| k as f32 * 0.05);
        let scribble = scribble.map(|t| Vec2::new(50.0 * (1.31 * t).cos(), -100.0 + 40.0 * (2.17 * t).sin()));
        for crown in [cloud(8.0, 0.15), cloud(0.0, 0.0), scribble.collect()] {
            let found = read(&[crown, stem()]);
            assert_eq!(found.len(), 1);
            assert_eq!((&found[0].uses[..], found[0].habit), (&[0, 1][..], Some(Habit::Tree)));
            assert!(found[0].parts[0].points[0].position.distance(Vec2::new(0.0, 40.0)) < 4.0);
        }
    }

    #[test]
    fn crown_and_trunk_may_be_one_line_also_up_and_down_again() {
        let mut once = stem();
        once.extend(cloud(8.0, 0.2));
        assert_eq!(read(&[once.clone()]).len(), 1);
        once.extend(line(&[(3.0, -50.0), (4.0, 40.0)]));
        assert_eq!(read(&[once]).len(), 1);
    }

    #[test]
    fn a_crown_with_branches_may_be_smooth() {
        let oval: Vec<Vec2> = cloud(0.0, 0.0).iter().map(|p| Vec2::new(0.8 * p.x, p.y)).collect();
        let trunk = line(&[(0.0, 40.0), (0.0, -110.0)]);
        let twigs = [line(&[(0.0, -70.0), (-16.0, -90.0)]), line(&[(0.0, -80.0), (16.0, -98.0)])];
        assert_eq!(read(&[oval, trunk, twigs[0].clone(), twigs[1].clone()]).len(), 1);
    }

    #[test]
    fn deep_lobes_a_tip_a_centre_and_a_long_stem_speak_for_flowers_and_leaves() {
        assert!(read(&[cloud(6.0, 1.5), stem()]).is_empty());
        let centre =
            (0..=40).map(|k| Vec2::new(0.0, -100.0) + 18.0 * Vec2::from_angle(0.16 * k as f32)).collect();
        assert!(read(&[cloud(8.0, 0.15), centre, stem()]).is_empty());
        assert!(read(&[cloud(8.0, 0.15), line(&[(0.0, 240.0), (0.0, -58.0)])]).is_empty());
        let mut blade = line(&[(0.0, -50.0), (-28.0, -70.0), (-30.0, -100.0), (0.0, -160.0)]);
        blade.extend(line(&[(30.0, -100.0), (28.0, -70.0), (0.0, -50.0)]));
        assert!(read(&[blade, stem()]).is_empty());
    }

    #[test]
    fn two_lines_are_no_single_one() {
        let sides = [-8.0, 8.0].map(|x| line(&[(x, 40.0), (x, -58.0)]));
        assert!(read(&[cloud(8.0, 0.15), sides[0].clone(), sides[1].clone()]).is_empty());
    }

    #[test]
    fn a_fan_of_veins_is_a_leaf_and_twigs_along_the_trunk_are_a_tree() {
        let vein = |x: f32| line(&[(0.0, -60.0), (x, -125.0)]);
        let fan: Vec<Vec<Vec2>> = [-30.0, -15.0, 0.0, 15.0, 30.0].map(vein).to_vec();
        assert!(read(&[vec![stem(), cloud(2.0, 0.1)], fan.clone()].concat()).is_empty());
        assert_eq!(read(&[vec![stem(), cloud(2.0, 0.1)], fan[1..4].to_vec()].concat()).len(), 1, "few");
    }
}
