//! A corolla in any number of strokes around a flower's centre: every lobe becomes a petal.
//!
//! The centre is a round closed stroke, a spiral or a small scribble. Around it stand lines that come near it and leave it again:
//! one for the whole corolla, or an arc for each petal. Lines whose ends meet are one; what they are cut into at their notches
//! ([`lobes`](super::lobes)) are the petals, at least [`FEWEST`], more than half around. Their roots are led to the centre, under
//! its edge, where petals gather; the centre's own stroke is drawn anew from its middle, so that it gathers with them. What
//! stands inside the centre is its ornament.
//!
//! Loops of their own are petals around a centre if their feet lie around it and they point away from it. Where half of the
//! petals are loops whose feet gather beside the round one, as in the papers, that is a petal like them, and all stay as they
//! are.
//!
//! Further petals around these, ring by ring, belong to it ([`rings`](super::rings)).
//!
//! A crown with an apple in it has two sides of a trunk below and shallow notches far from the apple: that speaks against.
//!
//! Limits: a plain ring around a centre has no petals. A heap of more than [`MOST_LINES`] lines at one centre is not looked at.

use super::around::{self, Around, OPEN, REACH};
use super::rings;
use crate::anatomy::conventions::page::{Line, Page, even};
use crate::anatomy::conventions::shapes::lobes::{self, Focus};
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::geom::{polyline, simple_loop};
use crate::sketch::{Reading, Tool};
use glam::Vec2;
use std::collections::BTreeSet;
use std::f32::consts::{FRAC_PI_4, PI, TAU};

/// Fewest petals of a corolla.
const FEWEST: usize = 3;
/// Most lines that are looked at around one centre.
const MOST_LINES: usize = 64;
/// Narrowest centre, its width over its height or the other way round; a disc seen from the side.
const NARROWEST: f32 = 0.35;
/// Share of the ellipse in its bounds that the hull of a centre fills: a square has 1.27, a leaf that lies askew about 0.5.
const FILL: (f32, f32) = (0.7, 1.2);
/// Least area inside a round stroke, as a share of its hull; and how often a spiral winds.
const SOLID: f32 = 0.8;
const WOUND: f32 = 1.4;
/// Most that a corolla's line winds around the centre, in turns: a scribble winds more.
const ONCE: f32 = 1.3;
/// How far petals reach at least around a centre that is no disc: a scribble in a crown fills it.
const SCRIBBLED: f32 = 2.0;
/// Farthest middle of the feet of petals from where the round stroke begins and ends if that is one of them, in half sizes of it.
const AT_MOUTH: f32 = 0.6;
/// Distance of feet from there, and how many that near say that all gather at its root.
const GATHERED: (f32, usize) = (0.4, 3);
/// Widest angle between the directions of loops around a centre that keeps them apart, and the same times their number: three are far
/// apart.
const LOOP_GAP: (f32, f32) = (0.28 * TAU, 1.35 * TAU);
/// How far petals of their own stay away from the middle if what stands there is a centre and no petal, and the most of their
/// points that come nearer: their feet.
const KEPT_OUT: (f32, f32) = (0.75, 0.15);
/// Farthest middle of the feet of such petals from the middle of a centre, in half sizes of it, and as a share of their reach: petals
/// that gather at the root of one among them have their feet beside it.
const FEET_OFF: (f32, f32) = (0.5, 0.12);
/// Least cosine between where a petal points from its foot and from the centre, and of how many one may point elsewhere: it was not
/// drawn to its end.
const OUTWARD: f32 = 0.8;
const ASKEW: usize = 3;
/// The same as the two before the last, and the widest angle, for so many loops, which may stand on one side of a head that is
/// seen from the side; their feet lie at least that far apart, on the average from their middle.
const SIDE: (usize, f32, f32, f32) = (5, 0.85, 0.6 * TAU, 0.4);
/// Least angle that petals fill if they go all around.
const ALL_AROUND: f32 = 0.85 * TAU;
/// Distance within which ends of lines meet, as a share of the corolla's reach.
const MEET: f32 = 0.15;
/// How far a petal reaches at most, in reaches of the middle one: a stem goes farther.
const LONGEST: f32 = 2.2;
/// Smallest petal, as a share of the largest one's area.
const SMALLEST: f32 = 0.06;
/// Least angle that petals fill together.
const AROUND: f32 = PI * 0.9;
/// Where the roots of petals are brought, in half sizes of the centre.
const ROOT: f32 = 0.15;
/// Farthest from the middle of the corolla that the centre stands, as a share of the corolla's half size.
const OFF_CENTRE: f32 = 0.5;

/// Fewest other corollas that make one doubtful, the parts of each and one, and least of the smaller centre in the larger.
const LIKE: (usize, usize, f32) = (2, 6, 0.75);

/// How far from the middle marks on petals go at most, in reaches of those.
const MARK: f32 = 0.6;
/// Log-odds of each petal of a further ring, and of each with marks: more than a leaf's.
const RINGS: f32 = 2.4;
/// Points of a centre's outline.
const RING: usize = 90;

/// Proposes a corolla around each centre.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let centres: Vec<usize> = (0..page.lines.len()).filter(|i| is_round(&page.lines[*i])).collect();
    let grown = |i: &usize| {
        let line = &page.lines[*i];
        (line.bounds.0 - 0.5 * line.size(), line.bounds.1 + 0.5 * line.size())
    };
    let boxes: Vec<(Vec2, Vec2)> = centres.iter().map(grown).collect();
    let near = page.lines_at(&boxes);
    let found =
        centres.iter().zip(near).filter_map(|(centre, near)| Some((*centre, corolla(page, *centre, &near)?)));
    let found: Vec<(usize, Hypothesis)> = found.collect();
    let is_flower: Vec<bool> = found.iter().map(|it| !is_among_its_like(page, it, &found)).collect();
    out.extend(found.into_iter().zip(is_flower).filter(|(_, is_flower)| *is_flower).map(|((_, it), _)| it));
}

/// Whether several of a corolla's petals may as well be the centre of another of these, which stand in the order of their
/// centres: each as large as that, with as many petals of which the centre is one. Grapes in a bunch are so, and grains of
/// an ear.
fn is_among_its_like(page: &Page, (centre, own): &(usize, Hypothesis), all: &[(usize, Hypothesis)]) -> bool {
    let size = |line: usize| page.lines[line].size().max_element();
    let around = |line: &usize| all.binary_search_by_key(line, |it| it.0).ok().map(|place| &all[place]);
    let is_like = |(other, it): &&(usize, Hypothesis)| {
        other != centre
            && it.uses.binary_search(centre).is_ok()
            && it.parts.len() + 1 >= own.parts.len().max(LIKE.1)
            && (LIKE.2..1.0 / LIKE.2).contains(&(size(*other) / size(*centre)))
    };
    own.uses.iter().filter_map(around).filter(is_like).count() >= LIKE.0
}

/// Whether a line may be a flower's centre: a disc, a spiral or a scribble about as wide as high.
pub(crate) fn is_round(line: &Line) -> bool {
    let size = line.size();
    let fill = line.hull_area / (FRAC_PI_4 * size.x * size.y).max(f32::MIN_POSITIVE);
    let is_disc = line.openness < OPEN && line.solidity() > SOLID;
    let is_wound = lobes::winding(&line.points, line.middle()) > WOUND * TAU;
    size.min_element() >= NARROWEST * size.max_element()
        && (FILL.0..=FILL.1).contains(&fill)
        && (is_disc || is_wound)
}

/// A line around a centre, of one stroke or of several whose ends meet.
struct Chain {
    points: Vec<Vec2>,
    is_closed: bool,
}

fn corolla(page: &Page, centre: usize, near: &[usize]) -> Option<Hypothesis> {
    let disc = &page.lines[centre];
    let focus = Focus { place: disc.middle(), half: 0.5 * disc.size() };
    if near.len() > MOST_LINES {
        return None;
    }
    let others = || near.iter().copied().filter(|i| *i != centre);
    let is_inside = |i: &usize| focus.reach(&page.lines[*i].points) < REACH.0 - 0.1;
    let mut petal_lines: Vec<(usize, Around)> =
        others().filter_map(|i| Some((i, Around::new(&page.lines[i], &focus)?))).collect();
    let behind = others().filter(|i| around::is_behind(&page.lines[*i], &focus, &petal_lines));
    let behind: Vec<(usize, Around)> =
        behind.filter_map(|i| Some((i, Around::behind(&page.lines[i], &focus)?))).collect();
    petal_lines.extend(behind);
    let chains = chains(petal_lines.iter().map(|(_, around)| &*around.line), &focus);
    if chains.iter().any(|chain| lobes::winding(&chain.points, focus.place) > ONCE * TAU) {
        return None;
    }
    let is_loop = |chain: &&Chain| chain.is_closed && lobes::winding(&chain.points, focus.place) < PI;
    let loops = chains.iter().filter(is_loop).count();
    let petals = petals(&chains, &focus);
    if petal_lines.iter().any(|(_, around)| around::stands_on_trunk(page, &around.line, &focus)) {
        return None;
    }
    let reach = petals.iter().map(|stretch| focus.reach(stretch)).sum::<f32>() / petals.len().max(1) as f32;
    let is_petal = |i: &usize| petal_lines.iter().any(|(petal, _)| petal == i);
    if others().filter(|i| !is_petal(i)).any(|i| around::goes_through(&page.lines[i], &focus, reach)) {
        return None;
    }
    if disc.openness >= OPEN && reach < SCRIBBLED {
        return None;
    }
    let is_papers_way = 2 * loops >= petals.len() && !stand_around(&petals, disc, &focus)
        || gathers(disc, petal_lines.iter().map(|(i, _)| &page.lines[*i]));
    if is_papers_way
        || petals.len() < FEWEST
        || lobes::around(&petals, focus.place) < if disc.is_scribble() { ALL_AROUND } else { AROUND }
        || !is_amid(&petals, &focus)
    {
        return None;
    }
    let mut uses: Vec<usize> =
        others().filter(is_inside).chain(petal_lines.iter().map(|(i, _)| *i)).chain([centre]).collect();
    let outer = rings::around(page, &focus, &petals, &uses);
    uses.extend(outer.iter().map(|(line, _)| *line));
    let (marks, marked) = marks(page, others().filter(|i| !uses.contains(i)), &petal_lines, (&focus, reach));
    uses.extend(marks);
    uses.sort_unstable();
    let score = score(page, near, &uses, &petals, &focus) + RINGS * (outer.len() + marked) as f32;
    let root = |stretch: &[Vec2]| {
        focus.place + ROOT * focus.half.min_element() * lobes::direction(stretch, focus.place)
    };
    let stretches = petals.iter().chain(outer.iter().map(|(_, stretch)| stretch));
    let parts = stretches.map(|stretch| Made::new(Tool::Petal, lobes::rooted(stretch, root(stretch))));
    let stems = petal_lines.into_iter().filter_map(|(_, around)| around.stem);
    let parts = parts.chain(stems.map(|stem| Made::new(Tool::Branch, stem)));
    let parts = parts.chain([Made::new(Tool::Auto, from_middle(&disc.hull, focus.place))]).collect();
    Some(Hypothesis {
        uses,
        score,
        parts,
        solids: Vec::new(),
        reading: Reading::Corolla,
        habit: Some(Habit::Flower),
    })
}

/// Short lines in petals, near the centre, as a pansy's; and how many petals have some. A midrib goes farther.
fn marks(
    page: &Page,
    others: impl Iterator<Item = usize>,
    petals: &[(usize, Around)],
    (focus, reach): (&Focus, f32),
) -> (Vec<usize>, usize) {
    let petal_around = |i: &usize| {
        let line = &page.lines[*i];
        let is_mark = focus.reach(&line.points) < MARK * reach && line.openness > OPEN;
        petals.iter().position(|(_, petal)| petal.line.is_around(line)).filter(|_| is_mark)
    };
    let found: Vec<(usize, usize)> = others.filter_map(|i| Some((i, petal_around(&i)?))).collect();
    let marked: BTreeSet<usize> = found.iter().map(|(_, petal)| *petal).collect();
    (found.into_iter().map(|(line, _)| line).collect(), marked.len())
}

/// Puts lines together whose ends meet, each with the nearest of the others, again and again.
fn chains<'a>(lines: impl Iterator<Item = &'a Line>, focus: &Focus) -> Vec<Chain> {
    let mut open: Vec<Vec<Vec2>> = Vec::new();
    let mut out: Vec<Chain> = Vec::new();
    for line in lines {
        if line.openness < OPEN {
            out.push(Chain { points: line.points.clone(), is_closed: true });
        } else {
            open.push(line.points.clone());
        }
    }
    let reach = open.iter().map(|points| focus.reach(points)).fold(0.0, f32::max);
    let meets = MEET * reach * focus.half.min_element();
    while let Some(mut chain) = open.pop() {
        while let Some((k, next)) = continuation(&chain, &open, meets) {
            open.remove(k);
            chain = next;
        }
        let is_closed =
            chain[0].distance(chain[chain.len() - 1]) < meets && lobes::winding(&chain, focus.place) > PI;
        out.push(Chain { points: chain, is_closed });
    }
    out
}

/// The line among `others` that begins or ends nearest to an end of a chain, and the chain with it.
fn continuation(chain: &[Vec2], others: &[Vec<Vec2>], meets: f32) -> Option<(usize, Vec<Vec2>)> {
    let ways = |points: &[Vec2]| [points.to_vec(), points.iter().rev().copied().collect::<Vec<Vec2>>()];
    let mut best: Option<(f32, usize, Vec<Vec2>)> = None;
    for (k, other) in others.iter().enumerate() {
        for before in ways(chain) {
            for after in ways(other) {
                let gap = before[before.len() - 1].distance(after[0]);
                if gap < best.as_ref().map_or(meets, |best| best.0) {
                    best = Some((gap, k, before.iter().copied().chain(after).collect()));
                }
            }
        }
    }
    best.map(|(_, k, points)| (k, points))
}

/// The petals of all lines around a centre: stretches that leave it and are not too small.
fn petals(chains: &[Chain], focus: &Focus) -> Vec<Vec<Vec2>> {
    let mut petals: Vec<Vec<Vec2>> = Vec::new();
    for Chain { points, is_closed } in chains {
        let is_ring = *is_closed && lobes::winding(points, focus.place) > PI;
        if *is_closed && !is_ring {
            petals.push(lobes::from_nearest(points, focus));
        } else {
            petals.extend(lobes::cut(points, focus, is_ring));
        }
    }
    let area = |stretch: &[Vec2]| simple_loop::area(&lobes::rooted(stretch, focus.place));
    let largest = petals.iter().map(|stretch| area(stretch)).fold(0.0, f32::max);
    petals.retain(|stretch| area(stretch) > SMALLEST * largest && focus.reach(stretch) > REACH.0);
    let mut reaches: Vec<f32> = petals.iter().map(|stretch| focus.reach(stretch)).collect();
    reaches.sort_by(f32::total_cmp);
    let middle = reaches.get(reaches.len() / 2).copied().unwrap_or(0.0);
    petals.retain(|stretch| focus.reach(stretch) < LONGEST * middle);
    petals
}

/// Whether several loops begin and end where the round one does, which then is a petal like them.
fn gathers<'a>(disc: &Line, lines: impl Iterator<Item = &'a Line>) -> bool {
    let mouth = |line: &Line| line.ends().0.midpoint(line.ends().1);
    let is_beside = |line: &&Line| {
        let off = (mouth(line) - mouth(disc)) / (0.5 * disc.size());
        line.openness < OPEN && off.length() < GATHERED.0
    };
    disc.openness < OPEN && lines.filter(is_beside).count() >= GATHERED.1
}

/// Whether loops stand around a centre with their feet at its edge instead of gathering beside it.
fn stand_around(petals: &[Vec<Vec2>], disc: &Line, focus: &Focus) -> bool {
    let comes_in = |petal: &Vec<Vec2>| {
        let inside = petal.iter().filter(|p| focus.distance(**p) < KEPT_OUT.0).count();
        inside as f32 > KEPT_OUT.1 * petal.len() as f32
    };
    let foot = |petal: &Vec<Vec2>| petal[0].midpoint(petal[petal.len() - 1]);
    let is_askew = |petal: &Vec<Vec2>| {
        lobes::direction(petal, foot(petal)).dot(lobes::direction(petal, focus.place)) < OUTWARD
    };
    let feet: Vec<Vec2> = petals.iter().map(foot).map(|foot| (foot - focus.place) / focus.half).collect();
    let count = feet.len().max(1) as f32;
    let middle = feet.iter().sum::<Vec2>() / count;
    let spread = feet.iter().map(|foot| foot.distance(middle)).sum::<f32>() / count;
    let gap = lobes::widest_gap(petals, focus.place);
    let reach = petals.iter().map(|petal| focus.reach(petal)).sum::<f32>() / count;
    let (feet_off, loop_gap) = (FEET_OFF.0.max(FEET_OFF.1 * reach), LOOP_GAP.0.max(LOOP_GAP.1 / count));
    let is_all_around = middle.length() < feet_off && gap < loop_gap;
    let mouth = (disc.ends().0.midpoint(disc.ends().1) - focus.place) / focus.half;
    let is_half = petals.len() >= SIDE.0
        && middle.length() < SIDE.1
        && gap < SIDE.2
        && spread > SIDE.3
        && mouth.distance(middle) > AT_MOUTH;
    let beside_it = feet.iter().filter(|foot| foot.distance(mouth) < GATHERED.0).count();
    beside_it < GATHERED.1
        && (is_all_around || is_half)
        && !petals.iter().any(comes_in)
        && petals.iter().filter(|petal| is_askew(petal)).count() <= petals.len() / ASKEW
}

/// Whether a centre stands in the middle of its petals as far as they go around it, and is no dot among them.
fn is_amid(petals: &[Vec<Vec2>], focus: &Focus) -> bool {
    let (low, high) = polyline::bounds(petals.iter().flatten().copied());
    let half = 0.5 * (high - low);
    let off = (low.midpoint(high) - focus.place).abs() / half.max(Vec2::splat(f32::MIN_POSITIVE));
    // A corolla that is not drawn all around has its middle elsewhere.
    let is_whole = lobes::around(petals, focus.place) > ALL_AROUND;
    !is_whole || off.max_element() < OFF_CENTRE
}

/// What speaks for a corolla, and against.
fn score(page: &Page, near: &[usize], uses: &[usize], petals: &[Vec<Vec2>], focus: &Focus) -> f32 {
    let depth = petals.iter().map(|petal| lobes::depth(petal, focus)).sum::<f32>() / petals.len() as f32;
    let hangs = |i: &&usize| {
        let line = &page.lines[**i];
        uses.binary_search(*i).is_err()
            && line.bounds.1.y > focus.place.y + REACH.0 * focus.half.y
            && line.openness > 0.8
    };
    let stems = near.iter().filter(hangs).count();
    let against = if stems > 1 && depth > 0.75 { 2.5 } else { 0.0 };
    4.0 + 0.1 * petals.len().min(8) as f32 + (1.0 - depth) - against
}

/// The outline of a disc as one stroke from its middle and back to it, the mouth hardly open.
pub(crate) fn from_middle(hull: &[Vec2], middle: Vec2) -> Vec<Vec2> {
    let mut ring = hull.to_vec();
    ring.extend(hull.first());
    let even = even(&ring, RING);
    std::iter::once(middle).chain(even[..RING - 1].iter().copied()).chain([middle]).collect()
}

#[cfg(test)]
#[path = "corolla_tests.rs"]
mod tests;
