//! A clover: three or four leaflets like hearts about one place.
//!
//! What the lines enclose together, straight lines left out, has notches all around: near ones, between the leaflets, and between each
//! two of them a far one, where a leaflet is notched. Petals with notches are alike, but flowers have five as a rule. Each leaflet is a leaf
//! that begins in the middle; a straight line that goes on outside is the stalk.
//!
//! Limits: clovers from the side; a flower of four notched petals is read as a clover.

use crate::anatomy::conventions::page::{self, Line, Page};
use crate::anatomy::conventions::shapes::lobes;
use crate::anatomy::conventions::shapes::silhouette::{Silhouette, share_along, smooth_contour};
use crate::anatomy::conventions::{Hypothesis, Made};
use crate::geom::simple_loop;
use crate::sketch::{Reading, Tool};
use glam::Vec2;
use std::f32::consts::TAU;

/// Most lines, and least chord of one over its length that is no edge of a leaflet.
const LINES: usize = 12;
const STRAIGHT: f32 = 0.93;
/// Least extent of the leaflets one way, as a share of that the other way.
const ROUND: f32 = 0.5;
/// Fewest leaflets, and most.
const LEAFLETS: (usize, usize) = (3, 4);
/// Mean distance of near notches from the middle in that of far ones: from where on it speaks against a clover, and at most; log-odds.
/// Crowns have shallow notches.
const NEAR: (f32, f32, f32) = (0.85, 0.92, 2.5);
/// Least depth of a notch, as a share of the reach.
const NOTCH: f32 = 0.05;
/// Least and greatest angle of a leaflet, in those of even ones.
const EVEN: (f32, f32) = (0.55, 1.6);
/// How far from the middle a stalk begins at least, as a share of the reach.
const BEYOND: f32 = 0.8;
/// How wide gaps are closed, in cells of the silhouette, one after the other: leaflets may stand apart.
const BRIDGES: [i32; 2] = [6, 24];
/// Points of the outline.
const POINTS: usize = 240;
/// Least share of what is drawn that lies in the leaflets.
const INSIDE: f32 = 0.9;
/// Least part of the outline that each line draws.
const DRAWN: f32 = 0.1;
/// Largest leaflet, as a share of the smallest.
const ALIKE: f32 = 1.7;
/// Log-odds: more than those of a corolla.
const SCORE: f32 = 6.0;

/// Proposes a clover for each group of lines.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let groups = page.groups.iter().chain(&page.wide_groups).filter(|group| group.len() <= LINES);
    out.extend(groups.filter_map(|group| clover(page, group)));
}

fn clover(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    let is_straight = |line: &Line| line.ends().0.distance(line.ends().1) > STRAIGHT * line.length;
    let (straight, edges): (Vec<usize>, Vec<usize>) =
        group.iter().partition(|i| is_straight(&page.lines[**i]));
    if edges.is_empty() {
        return None;
    }
    let (low, high) = page::bounds(edges.iter().map(|i| &page.lines[*i]));
    let size = high - low;
    if size.min_element() < ROUND * size.max_element() {
        return None;
    }
    let drawn = || edges.iter().map(|i| page.lines[*i].points.as_slice());
    let leaflets = BRIDGES.into_iter().find_map(|bridge| {
        let silhouette = Silhouette::new(drawn(), bridge);
        let outline = smooth_contour(&silhouette.contour(), POINTS, 1);
        let near = 3.0 * silhouette.cell();
        let draws = |line: &[Vec2]| share_along(&outline, std::iter::once(line), near) > DRAWN;
        let is_whole = || silhouette.share_inside(drawn().flatten()) > INSIDE && drawn().all(draws);
        Leaflets::of(&outline).filter(|_| is_whole())
    })?;
    let stalk = straight.iter().find_map(|i| leaflets.stalk(&page.lines[*i]));
    let blades = leaflets.outlines.iter().map(|stretch| {
        let root = leaflets.middle + 0.03 * leaflets.reach * lobes::direction(stretch, leaflets.middle);
        Made::new(Tool::Leaf, lobes::rooted(stretch, root))
    });
    let parts = stalk.map(|way| Made::new(Tool::Branch, way)).into_iter().chain(blades).collect();
    let shallow = ((leaflets.nearness - NEAR.0) / (NEAR.1 - NEAR.0)).max(0.0);
    let score = (SCORE - NEAR.2 * shallow) * page.weight(2.0 * leaflets.reach);
    let (uses, reading) = (group.to_vec(), Reading::Leaf);
    Some(Hypothesis { uses, score, parts, solids: Vec::new(), reading, habit: None })
}

/// Leaflets about their middle.
struct Leaflets {
    middle: Vec2,
    /// Distance of the farthest point.
    reach: f32,
    outlines: Vec<Vec<Vec2>>,
    /// Mean distance of the notches between leaflets from the middle in that of those in leaflets.
    nearness: f32,
}

impl Leaflets {
    /// Those of a closed outline, if they are a clover's.
    fn of(outline: &[Vec2]) -> Option<Self> {
        let middle = outline.iter().sum::<Vec2>() / outline.len().max(1) as f32;
        let reach = outline.iter().map(|p| p.distance(middle)).fold(0.0, f32::max);
        let n = outline.len();
        let away = |k: usize| outline[k % n].distance(middle);
        let tip = (0..n).max_by(|a, b| away(*a).total_cmp(&away(*b)))?;
        let distances: Vec<f32> = (tip..=tip + n).map(away).collect();
        let all = lobes::valleys_between(&distances, NOTCH * reach);
        let every_second =
            |from: usize| -> Vec<usize> { all.iter().skip(from).step_by(2).map(|k| (tip + k) % n).collect() };
        let mean = |notches: &[usize]| notches.iter().map(|k| away(*k)).sum::<f32>() / notches.len() as f32;
        let (mut near, mut far) = (every_second(0), every_second(1));
        if near.len() == far.len() && mean(&near) > mean(&far) {
            std::mem::swap(&mut near, &mut far);
        }
        near.sort_unstable();
        let count = near.len();
        let nearness = mean(&near) / mean(&far);
        if !(LEAFLETS.0..=LEAFLETS.1).contains(&count) || far.len() != count || nearness >= NEAR.1 {
            return None;
        }
        let stretch = |k: usize| -> Vec<usize> {
            let (from, to) = (near[k], near[(k + 1) % count]);
            (0..=(to + n - from) % n).map(|step| (from + step) % n).collect()
        };
        let even = TAU / count as f32;
        let is_leaflet = |numbers: &Vec<usize>| {
            let (Some(first), Some(last)) = (numbers.first(), numbers.last()) else { return false };
            let (a, b) = (outline[*first] - middle, outline[*last] - middle);
            let angle = a.angle_to(b).abs();
            let angle = if numbers.len() > n / 2 { TAU - angle } else { angle };
            (EVEN.0 * even..EVEN.1 * even).contains(&angle) && far.iter().any(|notch| numbers.contains(notch))
        };
        let stretches: Vec<Vec<usize>> = (0..count).map(stretch).collect();
        let outlines: Vec<Vec<Vec2>> =
            stretches.iter().map(|numbers| numbers.iter().map(|k| outline[*k]).collect()).collect();
        let areas = outlines.iter().map(|leaflet| simple_loop::area(&lobes::rooted(leaflet, middle)));
        let (small, large) = areas.fold((f32::INFINITY, 0.0_f32), |(a, b), area| (a.min(area), b.max(area)));
        let is_clover = stretches.iter().all(is_leaflet) && large < ALIKE * small;
        is_clover.then_some(Self { middle, reach, outlines, nearness })
    }

    /// The way of a stalk from its foot to the middle, if a straight line is one.
    fn stalk(&self, line: &Line) -> Option<Vec<Vec2>> {
        let (first, last) = line.ends();
        let foot = if first.distance(self.middle) > last.distance(self.middle) { first } else { last };
        (foot.distance(self.middle) > BEYOND * self.reach).then(|| vec![foot, self.middle])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    /// Leaflets about the origin, notched by so much of their reach.
    fn leaves(count: usize, notch: f32) -> Vec<Vec2> {
        let reach = |turn: f32| {
            let across = (turn * count as f32).rem_euclid(1.0);
            let lobe = (std::f32::consts::PI * across).sin().powf(0.7);
            100.0 * (0.25 + 0.75 * lobe) * (1.0 - notch * (-((across - 0.5) / 0.12).powi(2)).exp())
        };
        (0..=400).map(|k| k as f32 / 400.0).map(|turn| reach(turn) * Vec2::from_angle(TAU * turn)).collect()
    }

    #[test]
    fn three_or_four_notched_leaflets_with_a_stalk_are_a_clover() {
        for count in [3, 4] {
            let found = read(&[leaves(count, 0.25), line(&[(0.0, 0.0), (110.0, 120.0)])]);
            let [clover] = &found[..] else { panic!("{count}: {} clovers", found.len()) };
            let tools: Vec<Tool> = clover.parts.iter().map(|part| part.tool).collect();
            assert_eq!(tools.iter().filter(|tool| **tool == Tool::Leaf).count(), count);
            assert!(tools[0] == Tool::Branch && clover.parts[0].points[0].position.length() > 150.0);
        }
    }

    #[test]
    fn shallow_notches_speak_against_a_clover() {
        let of = |share: f32| {
            let rounded = |p: &Vec2| p.normalize() * (share * p.length() + (1.0 - share) * 100.0);
            let edge: Vec<Vec2> = leaves(4, 0.4).iter().map(rounded).collect();
            read(&[edge]).first().map(|clover| clover.score)
        };
        assert!(of(1.0).unwrap() > of(0.3).unwrap() + 0.5, "{:?} {:?}", of(1.0), of(0.3));
    }

    #[test]
    fn petals_without_notches_and_five_with_them_are_none() {
        assert!(read(&[leaves(4, 0.0)]).is_empty());
        assert!(read(&[leaves(5, 0.25)]).is_empty());
    }
}
