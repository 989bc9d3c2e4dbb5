//! Fronds about the top of a trunk: a palm. Blades that rise from the mouth of a pot are found in the same way.
//!
//! A [`TrunkSides`] is found below. All other lines, and what is left of the lines of its sides, are cut into spikes
//! about the trunk's top: each is a frond, as wide as it was drawn, led to that top.
//!
//! What speaks for fronds and against a crown is said in [`frond_crown`](super::frond_crown). Lines above a single line are twigs
//! unless they hang or have two sides.
//!
//! Small outlines at the trunk's top are fruit, several short lines along fronds their leaflets; neither becomes a part.
//!
//! Limits: single fronds whose leaflets are drawn, without a trunk, are not understood.

use super::frond_crown::{Crown, hangs};
use super::frond_details::{is_fruit, leaflets, reach_of};
use crate::anatomy::conventions::Hypothesis;
use crate::anatomy::conventions::page::Page;
use crate::anatomy::conventions::trees::evidence::ramp;
use crate::anatomy::conventions::trees::stacked::stacked;
use crate::anatomy::conventions::trees::trunk_sides::TrunkSides;
use crate::geom::polyline;
use crate::sketch::Reading;
use glam::Vec2;
use std::collections::BTreeSet;

/// Fewest fronds; one less if all of them hang, or if they are nearly all that is drawn, so much, and one hangs or they are one line in a pot.
const FEWEST: usize = 3;
const ALL: f32 = 0.9;
/// Share of what is drawn about the trunk's top that fronds must be.
const EXPLAINED: f32 = 0.65;
/// How far from a single line's end, or from a pot's mouth, closed lines may begin, as a share of their reach: leaves along a stem
/// begin farther away.
const APART: f32 = 0.45;
/// Where blades in a pot have their roots, as a share of its height from above: in the earth.
const IN_POT: f32 = 0.15;
/// More log-odds for each line that it explains, up to so many.
const EACH: f32 = 0.01;
const MOST_LINES: usize = 12;
/// Longest stroke between fronds that is a shade, as a share of their reach.
const STROKE: f32 = 0.4;
/// Least reach of the farthest frond, in widths of the trunk: what rounds off a body is shorter.
const LONG: f32 = 1.2;
/// Reach of the farthest frond, in widths of the trunk, that speaks against a palm, as the tips of a cactus do, and that does no more; and
/// log-odds.
const STOUT: ((f32, f32), f32) = ((1.2, 2.4), 1.5);
/// Log-odds of lines of the group that it does not explain, for their share of its length.
const OVER: f32 = 6.0;
/// Length to each side over which teeth are evened out, as a share of the fronds' reach.
const TEETH: f32 = 0.1;
/// Least height of the trunk, as a share of the farthest frond's reach: what is lower is where a tuft is gathered.
const HIGH: f32 = 0.25;

/// From which share of its length on a strand hangs, its most run over its rise there, fewest strands, and least share of the lines that they are.
const STRANDS: (f32, f32, usize, f32) = (0.7, 0.35, 4, 0.7);

/// How near to one another ends of a cup's lines lie, and how far from its stem and from each other, as shares of the reach.
const CUP: (f32, f32) = (0.12, 0.4);

/// Proposes palms, one for each group of lines at most, and what rises from the mouth of a pot that was proposed.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let potted = out.iter().find(|other| other.reading == Reading::Pot).and_then(|pot| potted(page, pot));
    let stacked = stacked(page);
    let groups = page.groups.iter().chain(&page.wide_groups).chain(&stacked);
    out.extend(groups.filter_map(|group| palm(page, group)));
    out.extend(potted);
}

/// Blades that rise from the mouth of a pot, if they are all that is in it.
fn potted(page: &Page, pot: &Hypothesis) -> Option<Hypothesis> {
    let solid = pot.solids.first()?;
    let (top, bottom) = (solid.profile.first()?.y, solid.profile.last()?.y);
    let mouth = Vec2::new(solid.axis, top + IN_POT * (bottom - top));
    let plant = (0..page.lines.len()).filter(|line| !page.is_apart(*line));
    let lines: Vec<(Vec<Vec2>, usize)> = plant.map(|line| (page.lines[line].points.clone(), line)).collect();
    let crown = Crown::about(mouth, &lines);
    // Blunt tips are those of broad leaves: a crown that stands on a pot has no notches that go down to it.
    // Two strokes are a leaf each.
    let fewest = FEWEST - usize::from(crown.explained > ALL && lines.len() == 1);
    let is_plant = crown.fronds.len() >= fewest && crown.has_blades();
    let is_whole = crown.explained > EXPLAINED && crown.apart < APART;
    (is_plant && is_whole).then(|| crown.hypothesis(mouth, None))
}

fn palm(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    let trunk = TrunkSides::find(page, group)?;
    let sides: BTreeSet<usize> = trunk.lines().collect();
    let free = group.iter().filter(|line| !sides.contains(line));
    let reach = free.map(|line| reach_of(&page.lines[*line], trunk.top())).fold(0.0, f32::max);
    let leaflets = leaflets(page, group, reach);
    let is_detail = |line: &&usize| {
        let shape = &page.lines[**line];
        trunk.has_on_it(**line, shape) || is_fruit(shape, &trunk, reach) || leaflets.contains(*line)
    };
    let (details, others): (Vec<usize>, Vec<usize>) = group.iter().partition(is_detail);
    let mut rest: Vec<(Vec<Vec2>, usize)> =
        others.iter().flat_map(|line| trunk.rest_of(*line, &page.lines[*line])).collect();
    // What joins the sides at their feet is ground, or the end of the trunk.
    let half = 0.5 * (trunk.foot().y + trunk.top().y);
    rest.retain(|(run, line)| run.iter().any(|p| p.y < half) || !sides.contains(line));
    let crown = crown(trunk.top(), &rest);
    let mut hanging = crown.fronds.iter().map(|frond| hangs(&frond.0));
    let do_hang = if crown.explained > ALL { hanging.any(|hangs| hangs) } else { hanging.all(|hangs| hangs) };
    let fewest = FEWEST - usize::from(!trunk.is_line() && do_hang);
    let is_crown = crown.fronds.len() >= fewest && crown.is_sharp() && crown.explained > EXPLAINED;
    if !is_crown
        || crown.reach < LONG * trunk.width()
        || trunk.foot().y - trunk.top().y < HIGH * crown.reach
        || trunk.is_line() && !(crown.has_blades() && crown.apart <= APART && crown.sits_on(&trunk, &rest))
        || lies_below(&rest, &trunk)
        || are_strands(&rest, &trunk)
        || has_cup(page, &others, (trunk.top(), crown.reach))
    {
        return None;
    }
    let mut palm = crown.hypothesis(trunk.top(), Some(&trunk));
    palm.uses.extend(details.into_iter().chain(others.into_iter().filter(|line| {
        let shape = &page.lines[*line];
        shape.length < STROKE * crown.reach && reach_of(shape, trunk.top()) < crown.reach
    })));
    palm.uses.sort_unstable();
    palm.uses.dedup();
    palm.score -= doubt(page, group, &palm.uses, crown.reach / trunk.width().max(f32::MIN_POSITIVE));
    // Of two groups the one that explains more.
    palm.score += EACH * palm.uses.len().min(MOST_LINES) as f32;
    Some(palm)
}

/// What radiates from the top of a trunk, with the teeth of its edges evened out if so more of it is fronds.
fn crown(top: Vec2, rest: &[(Vec<Vec2>, usize)]) -> Crown {
    let drawn = Crown::about(top, rest);
    if drawn.explained > EXPLAINED {
        return drawn;
    }
    let evened: Vec<(Vec<Vec2>, usize)> =
        rest.iter().map(|(run, line)| (without_teeth(run, TEETH * drawn.reach), *line)).collect();
    let even = Crown::about(top, &evened);
    if even.explained > drawn.explained { even } else { drawn }
}

/// A run of even points with means over so much of its length to each side in place of its points, its ends as they are.
fn without_teeth(run: &[Vec2], reach: f32) -> Vec<Vec2> {
    let step = polyline::length(run) / (run.len() - 1).max(1) as f32;
    let most = (reach / step.max(f32::MIN_POSITIVE)) as usize;
    let mean = |i: usize| {
        let near = most.min(i).min(run.len() - 1 - i);
        run[i - near..=i + near].iter().sum::<Vec2>() / (2 * near + 1) as f32
    };
    (0..run.len()).map(mean).collect()
}

/// What speaks against a palm that uses these lines of a group and whose fronds reach so many widths of its trunk, in log-odds.
fn doubt(page: &Page, group: &[usize], uses: &[usize], reach: f32) -> f32 {
    let length = |line: &usize| page.lines[*line].length;
    let over: f32 = group.iter().filter(|line| uses.binary_search(line).is_err()).map(length).sum();
    let all: f32 = group.iter().map(length).sum();
    STOUT.1 * (1.0 - ramp(reach, STOUT.0)) + OVER * over / all
}

/// Whether most lines fall straight down to beside the lower half of the trunk: branches of a willow.
fn are_strands(rest: &[(Vec<Vec2>, usize)], trunk: &TrunkSides) -> bool {
    let half = 0.5 * (trunk.foot().y + trunk.top().y);
    let falls = |(run, _): &&(Vec<Vec2>, usize)| {
        let far = |p: Vec2| p.distance_squared(trunk.top());
        let mut run = run.clone();
        if far(run[0]) > far(run[run.len() - 1]) {
            run.reverse();
        }
        let end = run[run.len() - 1] - run[(STRANDS.0 * (run.len() - 1) as f32) as usize];
        run[run.len() - 1].y > half && end.y > 0.0 && end.x.abs() < STRANDS.1 * end.y
    };
    let strands = rest.iter().filter(falls).count();
    strands >= STRANDS.2 && strands as f32 > STRANDS.3 * rest.len() as f32
}

/// Whether two lines begin and end at the same two places, which lie far from where fronds begin: the cup of a tulip and its rim.
fn has_cup(page: &Page, lines: &[usize], (top, reach): (Vec2, f32)) -> bool {
    let ends = |line: &usize| page.lines[*line].ends();
    let is_same = |a: Vec2, b: Vec2| a.distance(b) < CUP.0 * reach;
    let is_far = |p: Vec2| p.distance(top) > CUP.1 * reach;
    let is_rim = |a: &usize, b: &usize| {
        let ((from, to), (first, last)) = (ends(a), ends(b));
        let meet = is_same(from, first) && is_same(to, last) || is_same(from, last) && is_same(to, first);
        meet && is_far(from) && is_far(to) && from.distance(to) > CUP.1 * reach
    };
    lines.iter().enumerate().any(|(k, a)| lines[..k].iter().any(|b| is_rim(a, b)))
}

/// Whether much of the rest lies beside the lower half of the trunk.
fn lies_below(rest: &[(Vec<Vec2>, usize)], trunk: &TrunkSides) -> bool {
    let half = 0.5 * (trunk.foot().y + trunk.top().y);
    let all = rest.iter().flat_map(|run| &run.0);
    10 * all.clone().filter(|p| p.y > half).count() > 3 * all.count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::Habit;
    use crate::sketch::Tool;
    use std::f32::consts::PI;

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_above(
            crate::anatomy::conventions::beneath::pot::propose,
            propose,
            lines,
        )
    }

    fn sides() -> [Vec<Vec2>; 2] {
        [-6.0, 6.0].map(|x| vec![Vec2::new(x, 0.0), Vec2::new(x + 10.0, -100.0)])
    }

    /// Fronds about (10, -105) in one line: `sharp` ones, or lobes that reach as far.
    fn crown(is_sharp: bool) -> Vec<Vec2> {
        let top = Vec2::new(10.0, -105.0);
        let frond = |k: usize| {
            let (from, to) = (-3.6 + 0.9 * k as f32, -3.6 + 0.9 * (k + 1) as f32);
            (0..=16).map(move |i| {
                let t = i as f32 / 16.0;
                let reach = if is_sharp {
                    50.0 - 40.0 * (2.0 * t - 1.0).abs()
                } else {
                    60.0 - 20.0 * (2.0 * t - 1.0).powi(4)
                };
                top + reach * Vec2::from_angle(from + t * (to - from))
            })
        };
        (0..4).flat_map(frond).collect()
    }

    #[test]
    fn spikes_about_a_trunk_are_fronds_that_are_led_to_its_top() {
        let [left, right] = sides();
        let found = read(&[left, right, crown(true)]);
        assert_eq!(found.len(), 1);
        let palm = &found[0];
        assert_eq!((palm.habit, &palm.uses[..]), (Some(Habit::Palm), &[0, 1, 2][..]));
        assert_eq!(
            palm.parts.iter().map(|part| part.tool).collect::<Vec<_>>()[..2],
            [Tool::Branch, Tool::Leaf]
        );
        assert_eq!(palm.parts.len(), 5);
        let top = palm.parts[0].points[palm.parts[0].points.len() - 1].position;
        for frond in &palm.parts[1..] {
            let root = frond.points[0].position.midpoint(frond.points[frond.points.len() - 1].position);
            assert!(root.distance(top) < 1.0, "{root} {top}");
        }
    }

    #[test]
    fn teeth_are_evened_out_and_ends_and_straight_lines_stay() {
        let teeth: Vec<Vec2> =
            (0..=40).map(|k| Vec2::new(2.0 * k as f32, if k % 2 == 0 { 0.0 } else { 6.0 })).collect();
        let even = without_teeth(&teeth, 20.0);
        assert_eq!((even[0], even[40]), (teeth[0], teeth[40]));
        assert!(even[10..30].iter().all(|p| (p.y - 3.0).abs() < 1.0));
        let straight: Vec<Vec2> = (0..=40).map(|k| Vec2::new(2.0 * k as f32, 0.0)).collect();
        let even = without_teeth(&straight, 20.0);
        assert!(even.iter().zip(&straight).all(|(a, b)| a.distance(*b) < 1e-3));
    }

    #[test]
    fn lobes_are_no_fronds() {
        let [left, right] = sides();
        assert!(read(&[left, right, crown(false)]).is_empty());
    }

    #[test]
    fn a_cup_with_its_rim_on_a_stem_is_no_crown_of_fronds() {
        let stem = vec![Vec2::new(0.0, 0.0), Vec2::new(0.0, -140.0)];
        let cup = [(-26.0, -212.0), (-33.0, -170.0), (0.0, -145.0), (33.0, -170.0), (26.0, -212.0)];
        let rim = [(-26.0, -212.0), (-12.0, -190.0), (0.0, -218.0), (12.0, -190.0), (26.0, -212.0)];
        let leaf = [(1.0, -60.0), (30.0, -120.0), (45.0, -160.0), (20.0, -130.0), (1.0, -80.0)];
        let [cup, rim, leaf] = [cup, rim, leaf].map(|line| line.map(Vec2::from).to_vec());
        assert!(read(&[stem, cup, rim, leaf]).is_empty());
    }

    #[test]
    fn a_round_end_of_a_body_is_no_crown_of_fronds() {
        let arc =
            (0..=20).map(|k| Vec2::new(10.0, -100.0) + 6.0 * Vec2::from_angle(PI + PI * k as f32 / 20.0));
        let [left, right] = sides();
        let body: Vec<Vec2> = left.into_iter().chain(arc).chain(right.into_iter().rev()).collect();
        assert!(read(&[body]).is_empty());
    }

    #[test]
    fn lines_on_a_single_line_are_fronds_if_they_hang() {
        let stem = vec![Vec2::new(0.0, 0.0), Vec2::new(0.0, -100.0)];
        let arm = |x: f32, bend: f32| {
            let arc = move |k: usize| {
                let t = k as f32 / 20.0;
                Vec2::new(x * t, -100.0 - 20.0 * t + bend * t * t)
            };
            (0..=20).map(arc).collect::<Vec<Vec2>>()
        };
        let with = |bend: f32| {
            [vec![stem.clone()], [-50.0, -30.0, 35.0, 50.0].map(|x| arm(x, bend)).to_vec()].concat()
        };
        assert_eq!(read(&with(60.0)).len(), 1);
        assert!(read(&with(0.0)).is_empty(), "branches that rise");
    }

    fn pot() -> Vec<Vec2> {
        [(-20.0, -40.0), (-15.0, 0.0), (15.0, 0.0), (20.0, -40.0), (-20.0, -40.0)].map(Vec2::from).to_vec()
    }

    #[test]
    fn blades_that_fill_a_pot_have_their_roots_in_it() {
        let blade = |x: f32| {
            vec![
                Vec2::new(-2.0, -41.0),
                Vec2::new(x - 3.0, -90.0),
                Vec2::new(x, -120.0),
                Vec2::new(0.8 * x + 3.0, -85.0),
                Vec2::new(2.0, -41.0),
            ]
        };
        let found = read(&[pot(), blade(-40.0), blade(2.0), blade(40.0)]);
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].parts.len(), found[0].habit), (3, None));
        let root = found[0].parts[0].points[0].position;
        assert!((-40.0..-20.0).contains(&root.y), "{root}");
    }

    #[test]
    fn two_blades_in_one_line_are_enough_in_a_pot_and_two_strokes_are_leaves() {
        let blade = |side: f32| {
            [(1.0, -41.0), (40.0, -80.0), (60.0, -110.0), (35.0, -85.0), (0.0, -44.0)]
                .map(|(x, y)| Vec2::new(side * x, y))
                .to_vec()
        };
        let mut both = blade(-1.0);
        both.extend(blade(1.0).into_iter().rev().skip(1));
        assert_eq!(read(&[pot(), both])[0].parts.len(), 2);
        assert!(read(&[pot(), blade(-1.0), blade(1.0)]).is_empty());
    }

    #[test]
    fn leaves_along_a_stem_in_a_pot_are_no_fronds() {
        let leaf = |y: f32, x: f32| {
            let corners = [(0.0, 0.0), (0.5, -14.0), (1.0, -10.0), (0.5, 2.0), (0.0, 0.0)];
            corners.map(|(t, dy)| Vec2::new(x * t, y + dy)).to_vec()
        };
        let stem = vec![Vec2::new(0.0, -38.0), Vec2::new(1.0, -130.0)];
        assert!(read(&[pot(), stem, leaf(-75.0, 40.0), leaf(-95.0, -40.0), leaf(-130.0, 30.0)]).is_empty());
    }

    #[test]
    fn fruit_and_leaflets_are_no_fronds() {
        let top = Vec2::new(10.0, -100.0);
        let mut lines: Vec<Vec<Vec2>> = sides().to_vec();
        for side in [-1.0_f32, 1.0] {
            for lean in [0.3_f32, 0.8] {
                let at = |t: f32| top + Vec2::new(side * 70.0 * t, -70.0 * lean * t + 60.0 * t * t);
                lines.push((0..=20).map(|k| at(k as f32 / 20.0)).collect());
                lines.extend([0.4_f32, 0.6, 0.8].map(|t| vec![at(t), at(t) + Vec2::new(side * 3.0, 12.0)]));
            }
        }
        let ring = (0..=20).map(|k| Vec2::new(10.0, -92.0) + 6.0 * Vec2::from_angle(0.315 * k as f32));
        lines.push(ring.collect());
        let found = read(&lines);
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].parts.len(), found[0].uses.len()), (5, lines.len()));
    }

    #[test]
    fn arcs_around_a_crown_and_scribbles_are_no_fronds() {
        let half = |side: f32| -> Vec<Vec2> {
            (0..=30)
                .map(|k| 0.1 * k as f32)
                .map(|t| Vec2::new(10.0 + side * (4.0 + 45.0 * t.sin()), -145.0 + 42.0 * t.cos()))
                .collect()
        };
        let [left, right] = sides();
        assert!(read(&[left.clone(), right.clone(), half(-1.0), half(1.0)]).is_empty());
        let scribble = (0..500).map(|k| 0.05 * k as f32);
        let scribble =
            scribble.map(|t| Vec2::new(10.0 + 45.0 * (1.31 * t).cos(), -135.0 + 40.0 * (2.17 * t).sin()));
        assert!(read(&[left, right, scribble.collect()]).is_empty());
    }

    #[test]
    fn twigs_of_a_single_line_are_no_fronds() {
        let stem = vec![Vec2::new(0.0, 100.0), Vec2::new(0.0, -60.0)];
        let twig = |from: f32, x: f32, y: f32| vec![Vec2::new(0.0, from), Vec2::new(x, y)];
        assert!(
            read(&[stem, twig(20.0, -40.0, -30.0), twig(0.0, 40.0, -50.0), twig(-30.0, -30.0, -80.0)])
                .is_empty()
        );
    }

    #[test]
    fn two_fronds_on_a_trunk_are_a_palm_if_one_hangs() {
        let frond = |side: f32, bend: f32| {
            let at = move |t: f32| Vec2::new(10.0 + side * 60.0 * t, -100.0 - 45.0 * t + bend * t * t);
            (0..=20).map(|k| at(k as f32 / 20.0)).collect::<Vec<_>>()
        };
        let [left, right] = sides();
        let with = |bend: f32| read(&[left.clone(), right.clone(), frond(1.0, bend), frond(-1.0, 0.0)]);
        assert_eq!(with(90.0).iter().map(|palm| palm.parts.len()).collect::<Vec<_>>(), [3]);
        assert!(with(0.0).is_empty(), "a fork");
    }

    #[test]
    fn fronds_in_one_line_may_arch_over_and_hang_and_have_strokes_between_them() {
        let top = Vec2::new(10.0, -100.0);
        let frond = |side: f32| {
            let corners = [(0.0, -2.0), (30.0, -60.0), (70.0, -60.0), (85.0, -10.0), (87.0, 35.0)];
            let back = [(72.0, -5.0), (60.0, -35.0), (35.0, -30.0), (8.0, 0.0)];
            corners.into_iter().chain(back).map(move |(x, y)| top + Vec2::new(side * x, y))
        };
        let line: Vec<Vec2> = frond(-1.0).collect::<Vec<_>>().into_iter().rev().chain(frond(1.0)).collect();
        let shade = vec![top + Vec2::new(40.0, -45.0), top + Vec2::new(60.0, -45.0)];
        let [left, right] = sides();
        let found = read(&[left, right, line, shade]);
        let best = found.iter().max_by(|a, b| a.score.total_cmp(&b.score)).unwrap();
        assert_eq!((best.parts.len(), &best.uses[..]), (3, &[0, 1, 2, 3][..]));
    }

    #[test]
    fn lines_that_fall_beside_the_trunk_to_its_foot_are_no_fronds() {
        let strand = |x: f32, low: f32| {
            let top = Vec2::new(10.0, -104.0);
            vec![top, top + Vec2::new(0.7 * x, -30.0), top + Vec2::new(x, -10.0), Vec2::new(10.0 + x, low)]
        };
        let all = |low: f32| {
            let strands = [-70.0, -50.0, -30.0, 30.0, 50.0, 70.0].map(|x| strand(x, low));
            read(&[&sides()[..], &strands[..]].concat())
        };
        assert!(all(-12.0).is_empty());
        assert_eq!(all(-80.0).len(), 1, "a palm");
    }
}
