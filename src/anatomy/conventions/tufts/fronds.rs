//! Fronds about the top of a trunk: a palm. Blades that rise from the mouth of a pot are found in the same way.
//!
//! A [`TrunkSides`] is found below. All other lines, and what is left of the lines of its sides, are cut into
//! [`spikes`](super::spikes) by their distance from the trunk's top: each is a frond, as wide as it was drawn, led to that top.
//!
//! What speaks for fronds and against a crown: they are slender, their tips are sharp ([`SHARP`]), the notches between them go
//! down to near the trunk's top ([`DEEP`]), and together they are nearly all that is drawn there ([`EXPLAINED`]). Lobes of crowns
//! and petals are round, and outlines of crowns go far around. Lines above a single line are twigs unless they hang or have
//! two sides.
//!
//! Small outlines at the trunk's top are fruit, several short lines along fronds their leaflets; neither becomes a part.
//!
//! Limits: single fronds whose leaflets are drawn, without a trunk, are not understood.

use super::frond_details::{is_fruit, leaflets, reach_of};
use crate::anatomy::conventions::page::Page;
use crate::anatomy::conventions::shapes::spikes::{Spike, joined, spikes};
use crate::anatomy::conventions::trees::trunk_sides::TrunkSides;
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::geom::polyline;
use crate::sketch::{Reading, Tool};
use glam::Vec2;
use std::collections::BTreeSet;
use std::f32::consts::PI;

/// Fewest fronds; that many less if all of them hang.
const FEWEST: usize = 3;
/// Widest angle of a tip in the middle of all, and where it is measured, as a share of the shorter flank.
const SHARP: (f32, f32) = (0.5 * PI, 0.12);
/// Greatest distance of the notches beside a frond from the trunk's top, as a share of its tip's.
const DEEP: f32 = 0.65;
/// Least distance of a tip from the trunk's top, as a share of the farthest's.
const SHORTEST: f32 = 0.3;
/// Least change of distance that makes a frond, as a share of its line's farthest.
const PROMINENCE: f32 = 0.1;
/// Half of the mean distance of the two sides of a frond at most, as a share of its length.
const SLENDER: f32 = 0.3;
/// Length of a frond's shorter flank at most, in distances of its tip from the trunk's top: a half circle has 1.6.
const AROUND: f32 = 2.0;
/// Tips of one line, less one, from which on it may be a scribble.
const SCRIBBLE: usize = 5;
/// On a trunk of one line: farthest root of a frond from its top, as a share of its tip's, and how far the trunk reaches below all
/// else, as a share of the whole height.
const AT_TOP: f32 = 0.5;
const FREE: f32 = 0.2;
/// Share of what is drawn about the trunk's top that fronds must be.
const EXPLAINED: f32 = 0.65;
/// How far from a single line's end, or from a pot's mouth, closed lines may begin, as a share of their reach: leaves along a stem
/// begin farther away. Least length of a line that is asked, as a share of all, and most distance of its ends over its length.
const APART: f32 = 0.45;
const MAIN: f32 = 0.08;
const CLOSED: f32 = 0.15;
/// Where blades in a pot have their roots, as a share of its height from above: in the earth.
const IN_POT: f32 = 0.15;
/// Least reach of the farthest frond, in widths of the trunk: what rounds off a body is shorter.
const LONG: f32 = 1.2;
/// Half width of a frond at most, as a share of its length.
const HALF: f32 = 0.2;

/// Proposes palms, one for each group of lines at most, and what rises from the mouth of a pot that was proposed.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let potted = out.iter().find(|other| other.reading == Reading::Pot).and_then(|pot| potted(page, pot));
    out.extend(page.groups.iter().chain(&page.wide_groups).filter_map(|group| palm(page, group)));
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
    let is_plant = crown.fronds.len() >= FEWEST && crown.has_blades();
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
    let rest: Vec<(Vec<Vec2>, usize)> =
        others.iter().flat_map(|line| trunk.rest_of(*line, &page.lines[*line])).collect();
    let crown = Crown::about(trunk.top(), &rest);
    let fewest = FEWEST - usize::from(!trunk.is_line() && crown.fronds.iter().all(|frond| hangs(&frond.0)));
    let is_crown = crown.fronds.len() >= fewest && crown.is_sharp() && crown.explained > EXPLAINED;
    if !is_crown
        || crown.reach < LONG * trunk.width()
        || trunk.is_line() && !(crown.has_blades() && crown.apart <= APART && crown.sits_on(&trunk, &rest))
        || lies_below(&rest, &trunk)
    {
        return None;
    }
    let mut palm = crown.hypothesis(trunk.top(), Some(&trunk));
    palm.uses.extend(details);
    palm.uses.sort_unstable();
    Some(palm)
}

/// Fronds about a place.
struct Crown {
    /// Each with the lines that it comes from.
    fronds: Vec<(Spike, Vec<usize>)>,
    /// Distance of the farthest point.
    reach: f32,
    /// Share of the lines' length that fronds are.
    explained: f32,
    /// How far the closed line that is farthest away begins, as a share of its reach.
    apart: f32,
}

impl Crown {
    /// What radiates from `top` among some runs of points, each with the number of its line.
    fn about(top: Vec2, runs: &[(Vec<Vec2>, usize)]) -> Self {
        let reach = |points: &[Vec2]| points.iter().map(|p| p.distance(top)).fold(0.0, f32::max);
        let farthest = runs.iter().map(|run| reach(&run.0)).fold(0.0, f32::max);
        let of_run = |(points, line): &(Vec<Vec2>, usize)| -> Vec<(Spike, usize)> {
            let all = spikes(points, |p| p.distance(top), PROMINENCE * reach(points));
            if !goes_on(&all, top) {
                return Vec::new();
            }
            all.into_iter().map(|spike| (spike.hanging(points, top, DEEP), *line)).collect()
        };
        let all: Vec<(Spike, usize)> = runs.iter().flat_map(of_run).collect();
        let (single, double): (Vec<_>, Vec<_>) =
            all.into_iter().partition(|(spike, _)| spike.flanks.len() == 1);
        let mut fronds = joined(single, |tip| (tip - top).to_angle());
        fronds.extend(double.into_iter().map(|(spike, line)| (spike, vec![line])));
        fronds.retain(|(spike, _)| {
            let far = spike.tip().distance(top);
            far > SHORTEST * farthest
                && spike.foot().distance(top) < DEEP * far
                && spike.is_slender(SLENDER)
                && !goes_around(spike, far)
        });
        let length = |points: &[Vec2]| polyline::length(points);
        let whole: f32 = runs.iter().map(|run| length(&run.0)).sum();
        let own: f32 = fronds.iter().flat_map(|frond| &frond.0.flanks).map(|flank| length(flank)).sum();
        let nearest = |points: &[Vec2]| points.iter().map(|p| p.distance(top)).fold(f32::INFINITY, f32::min);
        let is_closed =
            |points: &[Vec2]| points[0].distance(points[points.len() - 1]) < CLOSED * length(points);
        let main = runs.iter().filter(|run| length(&run.0) > MAIN * whole && is_closed(&run.0));
        let apart = main.map(|run| nearest(&run.0) / reach(&run.0)).fold(0.0, f32::max);
        Self { fronds, reach: farthest, explained: own / whole.max(f32::MIN_POSITIVE), apart }
    }

    /// One blade for each frond, all from one root, with the trunk if there is one.
    fn hypothesis(&self, root: Vec2, trunk: Option<&TrunkSides>) -> Hypothesis {
        let blades = self.fronds.iter().map(|frond| Made::new(Tool::Leaf, frond.0.blade(root, HALF)));
        let trunk_lines = trunk.into_iter().flat_map(TrunkSides::lines);
        let mut uses: Vec<usize> =
            self.fronds.iter().flat_map(|frond| frond.1.clone()).chain(trunk_lines).collect();
        uses.sort_unstable();
        uses.dedup();
        Hypothesis {
            uses,
            score: 3.0 + 0.3 * self.fronds.len().min(6) as f32,
            parts: trunk.map(TrunkSides::branch).into_iter().chain(blades).collect(),
            solids: Vec::new(),
            reading: Reading::Fronds,
            habit: trunk.map(|_| Habit::Palm),
        }
    }

    /// Whether the tips of fronds with two sides are sharp.
    fn is_sharp(&self) -> bool {
        let mut angles: Vec<f32> = self.fronds.iter().filter_map(|frond| frond.0.angle(SHARP.1)).collect();
        let middle = angles.len() / 2;
        angles.is_empty() || *angles.select_nth_unstable_by(middle, f32::total_cmp).1 < SHARP.0
    }

    /// Whether all fronds begin at the top of a trunk of one line, and nothing else is near its foot: twigs leave a stem here and
    /// there, and the last arc of a cloud ends beside the others.
    fn sits_on(&self, trunk: &TrunkSides, rest: &[(Vec<Vec2>, usize)]) -> bool {
        let low = rest.iter().flat_map(|run| &run.0).map(|p| p.y).fold(f32::NEG_INFINITY, f32::max);
        let high = rest.iter().flat_map(|run| &run.0).map(|p| p.y).fold(trunk.top().y, f32::min);
        let begins =
            |spike: &Spike| spike.foot().distance(trunk.top()) < AT_TOP * spike.tip().distance(trunk.top());
        let is_free = trunk.foot().y - low > FREE * (trunk.foot().y - high);
        is_free && self.fronds.iter().all(|frond| begins(&frond.0))
    }

    /// Whether most fronds have two sides or hang.
    fn has_blades(&self) -> bool {
        let is_blade = |spike: &Spike| spike.flanks.len() == 2 || hangs(spike);
        2 * self.fronds.iter().filter(|frond| is_blade(&frond.0)).count() > self.fronds.len()
    }
}

/// Whether the tips in one line follow each other around the trunk's top, as no scribble's do.
fn goes_on(spikes: &[Spike], top: Vec2) -> bool {
    let steps: Vec<f32> =
        spikes.windows(2).map(|pair| (pair[0].tip() - top).angle_to(pair[1].tip() - top)).collect();
    let left = steps.iter().filter(|step| **step > 0.0).count();
    steps.len() < SCRIBBLE || 10 * left.max(steps.len() - left) >= 7 * steps.len()
}

/// Whether a spike winds so much that its tip, so far from the trunk, is no frond's: the outline of a crown.
fn goes_around(spike: &Spike, far: f32) -> bool {
    let lengths = spike.flanks.iter().map(|flank| polyline::length(flank));
    lengths.fold(f32::INFINITY, f32::min) > AROUND * far
}

/// Whether the tip is well below the highest point.
fn hangs(spike: &Spike) -> bool {
    let highest = spike.flanks.iter().flatten().map(|p| p.y).fold(f32::INFINITY, f32::min);
    spike.tip().y > highest + 0.15 * spike.reach()
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
    fn lobes_are_no_fronds() {
        let [left, right] = sides();
        assert!(read(&[left, right, crown(false)]).is_empty());
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

    #[test]
    fn blades_that_fill_a_pot_have_their_roots_in_it() {
        let pot = vec![
            Vec2::new(-20.0, -40.0),
            Vec2::new(-15.0, 0.0),
            Vec2::new(15.0, 0.0),
            Vec2::new(20.0, -40.0),
            Vec2::new(-20.0, -40.0),
        ];
        let blade = |x: f32| {
            vec![
                Vec2::new(-2.0, -41.0),
                Vec2::new(x - 3.0, -90.0),
                Vec2::new(x, -120.0),
                Vec2::new(0.8 * x + 3.0, -85.0),
                Vec2::new(2.0, -41.0),
            ]
        };
        let found = read(&[pot, blade(-40.0), blade(2.0), blade(40.0)]);
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].parts.len(), found[0].habit), (3, None));
        let root = found[0].parts[0].points[0].position;
        assert!((-40.0..-20.0).contains(&root.y), "{root}");
    }

    #[test]
    fn leaves_along_a_stem_in_a_pot_are_no_fronds() {
        let pot = vec![
            Vec2::new(-20.0, -40.0),
            Vec2::new(-15.0, 0.0),
            Vec2::new(15.0, 0.0),
            Vec2::new(20.0, -40.0),
            Vec2::new(-20.0, -40.0),
        ];
        let leaf = |y: f32, x: f32| {
            let corners = [(0.0, 0.0), (0.5, -14.0), (1.0, -10.0), (0.5, 2.0), (0.0, 0.0)];
            corners.map(|(t, dy)| Vec2::new(x * t, y + dy)).to_vec()
        };
        let stem = vec![Vec2::new(0.0, -38.0), Vec2::new(1.0, -130.0)];
        assert!(read(&[pot, stem, leaf(-75.0, 40.0), leaf(-95.0, -40.0), leaf(-130.0, 30.0)]).is_empty());
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
}
