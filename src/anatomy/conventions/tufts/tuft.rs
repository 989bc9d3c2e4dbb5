//! Tufts of grass: blades that rise from one place, as one outline, several, or single lines.
//!
//! In a group of lines that touch, the place is looked for among the ends of lines and the notches between tips in its lowest part: it
//! is the one from which most of what is drawn radiates ([`Crown`]). Every spike is a blade from there.
//!
//! What speaks for a tuft: nearly all that is drawn there are spikes ([`EXPLAINED`]), slender and with sharp tips, none of them goes
//! down ([`DOWN`]), which would be a stalk or a trunk, none lies in another, and nothing else is drawn far below. Corollas and stars
//! go all around, leaves of plants are broader, limbs of cacti blunt.
//!
//! Limits: a tuft of two blades, or one whose blades lie level, is not found.

use super::frond_crown::Crown;
use super::grass;
use crate::anatomy::conventions::page::Page;
use crate::anatomy::conventions::shapes::spikes::{Spike, spikes};
use crate::anatomy::conventions::{Habit, Hypothesis};
use crate::geom::{polyline, region::Region};
use crate::sketch::Reading;
use glam::Vec2;
use std::cell::LazyCell;

/// Least length of the lines that conventions look at, as a share of all.
const AUTO: f32 = 0.9;
/// Least reach of a tuft, as a share of the drawing's diagonal: smaller ones may be letters.
const SMALLEST: f32 = 0.2;
/// Fewest blades.
const FEWEST: usize = 3;
/// Most lines that are neighbours in a row of grass rather than a tuft.
const PAIR: usize = 2;
/// Share of what is drawn that blades must be.
const EXPLAINED: f32 = 0.8;
/// Lowest part of a group in which its blades begin, as a share of its height.
const LOW: f32 = 0.4;
/// Most places that are tried, and most lines of a group.
const PLACES: usize = 12;
const MOST_LINES: usize = 32;
/// How far below the place a tip may be, as a share of its distance: a blade may hang.
const DOWN: f32 = 0.35;
/// How far below the place anything may be, as a share of the farthest tip's distance.
const BELOW: f32 = 0.3;
/// Least height of the highest tip over the place, as a share of the farthest tip's distance.
const RISES: f32 = 0.4;
/// A line that goes on below the place is a stem: how near it passes, how far each of its ends is at least, as shares of the farthest tip's
/// distance, and its least chord over its length.
const THROUGH: (f32, f32, f32) = (0.15, 0.2, 0.9);
/// Farthest foot of a blade from the place, as a share of its tip's distance.
const GATHERED: f32 = 0.45;
/// How far above the place such a foot is at most, as a share of the same: leaves begin higher on their stem.
const RAISED: f32 = 0.33;
/// Half of the mean distance of the sides of a blade at most, as a share of its length.
const SLENDER: f32 = 0.2;
/// Most that a side turns against its bend, radians: blades may be serrated.
const BENT: f32 = 6.0;
/// Least prominence of the tips beside notches that are tried, as a share of the group's height.
const PROMINENCE: f32 = 0.15;

/// Proposes a tuft for each group of lines whose blades rise from one place.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    // Beside parts whose tool the artist chose, lines are parts as well.
    let lines: f32 = page.lines.iter().map(|line| line.length).sum();
    if lines < AUTO * page.length {
        return;
    }
    // Two neighbours in a row are no tuft, though their blades lead to one place. The row is looked for where that may be so.
    let row = LazyCell::new(|| grass::side_by_side(page).map_or(0, |row| row.uses.len()));
    let is_pair = |group: &[usize]| group.len() <= PAIR && group.len() < *row;
    let groups = page.groups.iter().chain(&page.wide_groups);
    out.extend(groups.filter_map(|group| tuft(page, group).filter(|_| !is_pair(group))));
}

fn tuft(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    if group.len() > MOST_LINES || group.iter().any(|i| page.lines[*i].is_scribble() && group.len() == 1) {
        return None;
    }
    let runs: Vec<(Vec<Vec2>, usize)> = group.iter().map(|i| (page.lines[*i].points.clone(), *i)).collect();
    let about = |place: Vec2| (place, Crown::about(place, &runs));
    let crowns = places(&runs).into_iter().map(about).filter(|(place, crown)| is_tuft(*place, crown, &runs));
    let (place, crown) = crowns.max_by(|a, b| a.1.explained.total_cmp(&b.1.explained))?;
    if crown.reach < SMALLEST * page.diagonal || grass::hang(page, group) {
        return None;
    }
    let (score, uses) = (1.8 + 0.3 * crown.fronds.len().min(12) as f32, group.to_vec());
    let (reading, habit) = (Reading::Grass, Some(Habit::Grass));
    Some(Hypothesis { score, uses, reading, habit, ..crown.hypothesis(place, None) })
}

/// Where blades may come together: the lowest ends and notches, and the middle of all ends that are low.
fn places(runs: &[(Vec<Vec2>, usize)]) -> Vec<Vec2> {
    let (high, low) = polyline::bounds(runs.iter().flat_map(|run| &run.0).copied());
    let (top, foot) = (high.y, low.y);
    let ends = runs.iter().flat_map(|run| [run.0[0], run.0[run.0.len() - 1]]);
    let feet = |run: &(Vec<Vec2>, usize)| {
        let all = spikes(&run.0, |p| -p.y, PROMINENCE * (foot - top));
        all.into_iter().flat_map(|spike| spike.flanks).map(|flank| flank[flank.len() - 1]).collect::<Vec<_>>()
    };
    let mut low: Vec<Vec2> = ends.chain(runs.iter().flat_map(feet)).collect();
    low.retain(|p| p.y > foot - LOW * (foot - top));
    low.sort_by(|a, b| b.y.total_cmp(&a.y).then(a.x.total_cmp(&b.x)));
    low.dedup();
    let middle = low.iter().sum::<Vec2>() / low.len().max(1) as f32;
    low.truncate(PLACES);
    if !low.is_empty() {
        low.push(middle);
    }
    low
}

fn is_tuft(place: Vec2, crown: &Crown, runs: &[(Vec<Vec2>, usize)]) -> bool {
    let is_blade = |spike: &Spike| {
        let (tip, foot) = (spike.tip() - place, spike.foot() - place);
        tip.y < DOWN * tip.length()
            && foot.length() < GATHERED * tip.length()
            && -foot.y < RAISED * tip.length()
            && spike.is_slender(SLENDER, BENT)
    };
    let lowest = runs.iter().flat_map(|run| &run.0).map(|p| p.y - place.y).fold(0.0, f32::max);
    let highest = crown.fronds.iter().map(|frond| place.y - frond.0.tip().y).fold(0.0, f32::max);
    crown.fronds.len() >= FEWEST
        && crown.explained > EXPLAINED
        && crown.is_sharp()
        && lowest < BELOW * crown.reach
        && highest > RISES * crown.reach
        && crown.fronds.iter().all(|frond| is_blade(&frond.0))
        && !runs.iter().any(|run| goes_through(&run.0, place, crown.reach))
        && !has_one_inside(crown)
}

/// Whether a nearly straight line passes the place and goes on.
fn goes_through(points: &[Vec2], place: Vec2, reach: f32) -> bool {
    let (first, last) = (points[0], points[points.len() - 1]);
    let is_near = polyline::nearest(points, place).is_some_and(|(gap, _)| gap < THROUGH.0 * reach);
    is_near
        && first.distance(place).min(last.distance(place)) > THROUGH.1 * reach
        && first.distance(last) > THROUGH.2 * polyline::length(points)
}

/// Whether the tip of a blade lies within another: a midrib in its leaf.
fn has_one_inside(crown: &Crown) -> bool {
    let outline = |spike: &Spike| {
        let [a, b] = &spike.flanks[..] else { return None };
        Some(Region::new(a.iter().rev().chain(b).copied().collect()))
    };
    let outlines = crown.fronds.iter().enumerate().filter_map(|(i, frond)| Some((i, outline(&frond.0)?)));
    let holds = |(i, outline): (usize, Region)| {
        let others = crown.fronds.iter().enumerate().filter(|(k, _)| *k != i);
        others.map(|other| other.1.0.tip()).any(|tip| outline.contains(tip))
    };
    outlines.into_iter().any(holds)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::read_by;

    /// A curved blade with two sides, from (0, 0) to a tip.
    fn blade(x: f32, y: f32) -> Vec<Vec2> {
        let side = |sign: f32| {
            let place = move |t: f32| {
                let bend = Vec2::new(0.0, -0.25 * x.abs() * t * (1.0 - t));
                t * Vec2::new(x, y) + bend + sign * 24.0 * t * (1.0 - t) * Vec2::new(-y, x).normalize()
            };
            (0..=20).map(move |k| place(k as f32 / 20.0))
        };
        side(1.0).chain(side(-1.0).collect::<Vec<_>>().into_iter().rev()).collect()
    }

    const TIPS: [(f32, f32); 3] = [(-60.0, -50.0), (10.0, -110.0), (65.0, -40.0)];

    fn shaken(points: Vec<Vec2>) -> Vec<Vec2> {
        let shake = |(k, p): (usize, Vec2)| p + Vec2::new((k as f32 * 0.6).sin(), (k as f32 * 0.7).cos());
        points.into_iter().enumerate().map(shake).collect()
    }

    fn read(lines: &[Vec<Vec2>]) -> Vec<(usize, usize)> {
        read_by(propose, lines).iter().map(|found| (found.uses.len(), found.parts.len())).collect()
    }

    #[test]
    fn blades_from_one_place_are_a_tuft_in_one_stroke_in_several_or_as_single_lines() {
        let blades: Vec<Vec<Vec2>> = TIPS.iter().map(|(x, y)| blade(*x, *y)).collect();
        assert_eq!(read(&[blades.concat()]), [(1, 3)]);
        assert_eq!(read(&[shaken(blades.concat())]), [(1, 3)]);
        assert_eq!(read(&blades), [(3, 3)]);
        let halves: Vec<Vec<Vec2>> =
            blades.iter().flat_map(|blade| [blade[..21].to_vec(), blade[21..].to_vec()]).collect();
        assert_eq!(read(&halves), [(6, 3)]);
        let lines: Vec<Vec<Vec2>> = blades.iter().map(|blade| blade[..21].to_vec()).collect();
        assert_eq!(read(&lines), [(3, 3)]);
    }

    #[test]
    fn leaves_halfway_up_a_stem_are_no_tuft() {
        let leaf = |x: f32, y: f32| blade(x, y).into_iter().map(|p| p - Vec2::new(0.0, 60.0)).collect();
        let stem = vec![Vec2::ZERO, Vec2::new(3.0, -150.0)];
        assert_eq!(read(&[stem, leaf(-50.0, -40.0), leaf(50.0, -45.0)]), []);
    }

    #[test]
    fn two_tufts_are_two() {
        let tuft = |x: f32| {
            let all = TIPS.iter().flat_map(|(x, y)| blade(*x, *y));
            all.map(|p| p + Vec2::new(x, 0.0)).collect::<Vec<Vec2>>()
        };
        assert_eq!(read(&[tuft(0.0), tuft(400.0)]), [(1, 3), (1, 3)]);
    }

    #[test]
    fn what_has_a_stalk_goes_around_or_is_a_leaf_with_veins_is_no_tuft() {
        let blades: Vec<Vec<Vec2>> = TIPS.iter().map(|(x, y)| blade(*x, *y)).collect();
        let stalk = vec![Vec2::ZERO, Vec2::new(2.0, 120.0)];
        assert!(read(&[blades.clone(), vec![stalk]].concat()).is_empty());
        let star = (0..6).map(|k| 80.0 * Vec2::from_angle(0.3 + 1.047 * k as f32)).map(|p| blade(p.x, p.y));
        assert!(read(&star.collect::<Vec<_>>()).is_empty());
        let leaf = vec![
            Vec2::ZERO,
            Vec2::new(-30.0, -60.0),
            Vec2::new(0.0, -140.0),
            Vec2::new(30.0, -60.0),
            Vec2::ZERO,
        ];
        let vein = |x: f32| vec![Vec2::new(0.0, -10.0), Vec2::new(x, -70.0)];
        assert!(read(&[leaf, vein(-12.0), vein(0.0), vein(12.0)]).is_empty());
    }
}
