//! Strokes whose ends continue each other, as one line.
//!
//! Two ends belong together the more, the nearer they are: smooth joins, at which the direction of both and of the gap
//! between them is about the same, over a wide gap, corners only where they nearly touch, and never where a third end is about as
//! near, smooth ones where two are: several strokes meet there. The strongest pairs are joined first, every end once, a line's beginning with its own end like
//! any other two. Ends of lines that are closed already are not joined.
//!
//! What the joined lines are is proposed beside what the strokes are by themselves. A reading that takes one of two joined strokes
//! without the other has as much less that speaks for it as the join is strong.
//!
//! The joined lines need a page of their own, which costs as much as the first. It is made only where it may change what is read:
//! where the joined lines are much of the drawing ([`MUCH`]), and not all explained already by readings that are beyond doubt
//! ([`CONFIDENT`]).
//!
//! Cost: linear in the lines, as long as few ends meet in one place, and that page.

use super::redrawn::Redrawn;
use crate::anatomy::conventions::choice;
use crate::anatomy::conventions::hypothesis::Hypothesis;
use crate::anatomy::conventions::page::{Line, Page};
use crate::kept::{Kept, Same, Use};
use crate::sketch::{Stroke, StrokePoint, Tool};
use glam::{IVec2, Vec2};
use std::collections::HashMap;
use std::sync::Arc;

/// Widest gap of a smooth join and of a corner, as shares of the drawing's diagonal, and of any as a share of the shorter line.
const GAP: (f32, f32, f32) = (0.06, 0.025, 0.3);
/// Largest bend of a smooth join, radians.
const SMOOTH: f32 = 0.7;
/// How near a third end keeps two from being joined at a corner: in gaps, and beside that as a share of the drawing's diagonal.
const THIRD: (f32, f32) = (2.5, 0.004);
/// What speaks for a join without a gap, log-odds, and how much less at a bend of a radian or more.
const STRONG: (f32, f32) = (2.5, 0.2);
/// Least that speaks for a join, log-odds: what is less is chance.
const LEAST: f32 = 0.3;
/// Distance of a line's ends up to which it is closed, and up to which joined lines are closed, as shares of the drawing's diagonal.
const CLOSED: (f32, f32) = (0.01, 0.04);
/// Distance of ends that are one place, as a share of the drawing's diagonal.
const EXACT: f32 = 0.001;
/// Distance of the ends of a line up to which it is closed if it does not touch another's end, as a share of its length.
const ROUND: f32 = 0.08;
/// Shortest line that is joined, and gap beside which the direction across it counts, as shares of the drawing's diagonal.
const SHORTEST: f32 = 0.05;
const WIDE: f32 = 0.01;
/// Over what length the direction of an end is measured, as a share of the drawing's diagonal and of the line.
const WINDOW: (f32, f32) = (0.03, 0.3);
/// Most ends near one another among which joins are looked for: more are a texture.
const CROWD: usize = 12;
/// What speaks against a joined line, log-odds: what is drawn counts first.
const JOINED: f32 = 0.3;

/// Strength up to which a join that a reading breaks says nothing against it, log-odds.
const WEAK: f32 = 0.6;

/// Largest share of what speaks for a reading that breaking joins takes from it.
const LOSS: f32 = 0.9;

/// Least share of the ink of a drawing that joined strokes have: fewer do not make it another plant.
const MUCH: f32 = 0.3;

/// What speaks for a reading of joined strokes from which on it is not asked what else they are, log-odds.
const CONFIDENT: f32 = 5.0;

/// Joined strokes that are kept for the next reading, each by the strokes and whether they are taken from their beginnings.
pub(crate) type Joined = Kept<Vec<(Same<Stroke>, bool)>, Arc<Stroke>>;

/// A drawing with strokes joined that continue each other.
#[derive(Clone, Debug)]
pub(crate) struct Chains {
    /// The joined lines and all other strokes.
    pub redrawn: Redrawn,
    /// Two strokes that are joined, and how much speaks for it, log-odds.
    bonds: Vec<(usize, usize, f32)>,
}

/// An end of a line.
struct End {
    line: usize,
    place: Vec2,
    /// Direction in which the line would go on.
    out: Vec2,
    length: f32,
    /// Distance of the line's ends, as a share of its length.
    openness: f32,
    /// Whether the other end of the line is here as well.
    is_closed: bool,
}

impl Chains {
    /// The drawing of a page with its strokes joined; none if no two are.
    pub(crate) fn of(known: &mut Joined, page: &Page, strokes: &[Arc<Stroke>]) -> Option<Self> {
        let ends: Vec<End> =
            page.lines.iter().enumerate().flat_map(|(i, line)| ends(i, line, page)).collect();
        let mut partner: Vec<Option<usize>> = vec![None; ends.len()];
        let mut bonds = Vec::new();
        for (strength, a, b) in pairs(&ends, page.diagonal) {
            if partner[a].is_none() && partner[b].is_none() {
                (partner[a], partner[b]) = (Some(b), Some(a));
                let [first, second] = [a, b].map(|end| page.lines[ends[end].line].stroke);
                if first != second {
                    bonds.push((first, second, strength));
                }
            }
        }
        if bonds.is_empty() {
            return None;
        }
        let lines = chains(&partner);
        let ink: f32 = lines.iter().flatten().map(|way| page.lines[way.line].length).sum();
        if ink < MUCH * page.length {
            return None;
        }
        let stroke_of = |way: &Way| &strokes[page.lines[way.line].stroke];
        let key = |chain: &Vec<Way>, used: Use| {
            chain.iter().map(|way| (Same::of(stroke_of(way), used), way.is_forward)).collect()
        };
        let joined = |chain: &Vec<Way>| Arc::new(joined(chain, stroke_of, page.diagonal));
        let made = known.made(&lines, key, joined);
        let members = |chain: &Vec<Way>| {
            let mut members: Vec<usize> = chain.iter().map(|way| page.lines[way.line].stroke).collect();
            members.sort_unstable();
            members
        };
        let lines = lines.iter().map(members).zip(made.iter().cloned()).collect();
        Some(Self { redrawn: Redrawn::of(strokes, lines), bonds })
    }

    /// Whether the best of the hypotheses explain each joined line as a whole, and are confident of it.
    pub(crate) fn are_explained_by(&self, hypotheses: &[Hypothesis]) -> bool {
        let chosen = choice::chosen(hypotheses);
        let confident: Vec<&Hypothesis> =
            chosen.into_iter().map(|i| &hypotheses[i]).filter(|it| it.score >= CONFIDENT).collect();
        let is_explained = |line: &usize| {
            let strokes = &self.redrawn.members[*line];
            confident.iter().any(|it| strokes.iter().all(|stroke| it.uses.binary_search(stroke).is_ok()))
        };
        self.redrawn.changed.iter().all(is_explained)
    }

    /// What is proposed for the joined lines, by strokes, beside what is proposed for the strokes.
    pub(crate) fn add(&self, all: &mut Vec<Hypothesis>, joined: Vec<Hypothesis>) {
        for hypothesis in all.iter_mut() {
            let is_used = |stroke: &usize| hypothesis.uses.binary_search(stroke).is_ok();
            let broken = self.bonds.iter().filter(|(a, b, _)| is_used(a) != is_used(b));
            let against: f32 = broken.map(|(_, _, strength)| (strength - WEAK).max(0.0)).sum();
            // Where nothing explains both strokes, what explains one is still better than nothing.
            hypothesis.score -= against.min(LOSS * hypothesis.score.max(0.0));
        }
        let by_strokes = |mut hypothesis: Hypothesis| {
            let members = hypothesis.uses.iter().flat_map(|line| &self.redrawn.members[*line]);
            hypothesis.uses = members.copied().collect();
            hypothesis.uses.sort_unstable();
            hypothesis.score -= JOINED;
            hypothesis
        };
        all.extend(joined.into_iter().map(by_strokes));
    }
}

/// Both ends of a line of a page, its beginning first.
fn ends(number: usize, line: &Line, page: &Page) -> [End; 2] {
    let (first, last) = line.ends();
    let window = (WINDOW.0 * page.diagonal).min(WINDOW.1 * line.length);
    let is_closed = first.distance(last) < CLOSED.0 * page.diagonal;
    let end = |place: Vec2, back: Option<&Vec2>| {
        let out = (place - back.copied().unwrap_or(place)).normalize_or_zero();
        let openness = first.distance(last) / line.length;
        End { line: number, place, out, length: line.length, openness, is_closed }
    };
    let mut points = line.points.iter();
    let [after_first, before_last] =
        [points.clone().find(|p| p.distance(first) >= window), points.rfind(|p| p.distance(last) >= window)];
    [end(first, after_first), end(last, before_last)]
}

/// Pairs of ends that may be joined and what speaks for it, the strongest first.
fn pairs(ends: &[End], diagonal: f32) -> Vec<(f32, usize, usize)> {
    let reach = GAP.0 * diagonal;
    let cell = |p: Vec2| (p / reach).floor().as_ivec2();
    let mut at: HashMap<IVec2, Vec<usize>> = HashMap::new();
    ends.iter().enumerate().for_each(|(i, end)| at.entry(cell(end.place)).or_default().push(i));
    let near = |i: usize| {
        let here = cell(ends[i].place);
        let around = (-1..=1).flat_map(|x| (-1..=1).map(move |y| here + IVec2::new(x, y)));
        let mut near: Vec<usize> = around.filter_map(|cell| at.get(&cell)).flatten().copied().collect();
        near.retain(|other| *other != i && ends[*other].place.distance(ends[i].place) < reach);
        near.sort_unstable();
        near
    };
    let may_join = |i: &usize| !ends[*i].is_closed && ends[*i].length > SHORTEST * diagonal;
    let mut pairs = Vec::new();
    for a in (0..ends.len()).filter(may_join) {
        let around = near(a);
        for &b in around.iter().filter(|b| **b > a && may_join(b) && around.len() <= CROWD) {
            let middle = ends[a].place.midpoint(ends[b].place);
            let within = THIRD.0 * ends[a].place.distance(ends[b].place) + THIRD.1 * diagonal;
            let is_near = |c: &usize| ends[*c].place.distance(middle) < within;
            // A petal's own ends are as near as those of the petals beside it.
            let is_gap = ends[a].place.distance(ends[b].place) > EXACT * diagonal;
            let is_round = |end: &usize| is_gap && ends[*end].openness < ROUND;
            if b != (a ^ 1) && [a, b].iter().any(|end| is_near(&(end ^ 1)) || is_round(end)) {
                continue;
            }
            let mut others: Vec<usize> = around.iter().copied().chain(near(b)).collect();
            others.retain(|c| *c != a && *c != b && is_near(c));
            others.sort_unstable();
            others.dedup();
            let strength = strength(&ends[a], &ends[b], others.len(), diagonal);
            if strength > LEAST {
                pairs.push((strength, a, b));
            }
        }
    }
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    pairs
}

/// What speaks for joining two ends, log-odds, with so many others about as near.
fn strength(a: &End, b: &End, others: usize, diagonal: f32) -> f32 {
    let gap = a.place.distance(b.place);
    let across = (b.place - a.place).normalize_or_zero();
    let turn = a.out.angle_to(-b.out).abs();
    let bend = match gap > WIDE * diagonal {
        true => turn.max(a.out.angle_to(across).abs()).max((-b.out).angle_to(across).abs()),
        false => turn,
    };
    let is_smooth = bend < SMOOTH;
    if others > usize::from(is_smooth) {
        return 0.0;
    }
    let widest = if is_smooth { GAP.0 } else { GAP.1 } * diagonal;
    let widest = widest.min(GAP.2 * a.length.min(b.length));
    STRONG.0 * (1.0 - gap / widest) - STRONG.1 * bend.min(1.0)
}

/// A line of a chain, and whether the chain goes from its beginning to its end.
#[derive(Clone, Copy)]
struct Way {
    line: usize,
    is_forward: bool,
}

/// Chains of more than one line, each begun at the end whose line comes first, or, if it closes, at its first line.
fn chains(partner: &[Option<usize>]) -> Vec<Vec<Way>> {
    let next = |way: Way| {
        let end = partner[2 * way.line + usize::from(way.is_forward)]?;
        Some(Way { line: end / 2, is_forward: end % 2 == 0 })
    };
    let mut is_done = vec![false; partner.len() / 2];
    let mut all = Vec::new();
    for first in 0..is_done.len() {
        if is_done[first] {
            continue;
        }
        // Against the chain's direction to its beginning, or once round.
        let mut at = Way { line: first, is_forward: false };
        while let Some(before) = next(at).filter(|before| before.line != first) {
            at = before;
        }
        let mut chain = Vec::new();
        let mut way = Some(Way { line: at.line, is_forward: !at.is_forward });
        while let Some(at) = way.filter(|way| !is_done[way.line]) {
            is_done[at.line] = true;
            chain.push(at);
            way = next(at);
        }
        if chain.len() > 1 {
            all.push(chain);
        }
    }
    all
}

/// The stroke that a chain is.
fn joined<'a>(chain: &[Way], stroke_of: impl Fn(&Way) -> &'a Arc<Stroke>, diagonal: f32) -> Stroke {
    let mut points: Vec<StrokePoint> = Vec::new();
    for way in chain {
        let drawn = &stroke_of(way).points;
        match way.is_forward {
            true => points.extend(drawn),
            false => points.extend(drawn.iter().rev()),
        }
    }
    if let (Some(&first), Some(last)) = (points.first(), points.last())
        && first.position.distance(last.position) < CLOSED.1 * diagonal
    {
        points.push(first);
    }
    let first = chain.iter().map(|way| stroke_of(way).id).min().unwrap_or_default();
    Stroke { id: first, tool: Tool::Auto, points, brush: None }
}
