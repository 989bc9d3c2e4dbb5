//! A head without drawn petals at the upper end of a stem: round, or a cup with two or three teeth.
//!
//! Children's gardens are full of them. A head is one outline, closed or open on the side of its stem, which is a single line, ends at
//! its edge or within it, and is most of the flower; nothing else but dots stands in it or beside it. Teeth are tips away
//! from the stem with a clear notch between them: a petal for each, and others in front ([`cup`](super::cup)). A round head has
//! no tip, as a blade would have, and its stem is longer than that of a crown ([`LONG`]): petals fill it, as those of a
//! [`rose`](super::rose) do.
//!
//! Limits: a round leaf on a long stalk is read as a flower; a round head on a short stem is a tree.

use super::corolla_on_stem::{Head, stem_top};
use super::upright::{points_away, tips_of_hull};
use super::{cup, rose};
use crate::anatomy::conventions::page::{Line, Page};
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::sketch::{Reading, Tool};
use glam::Vec2;
use std::borrow::Cow;
use std::f32::consts::FRAC_PI_4;

/// Widest opening of a head, and least share of its hull that it encloses.
const OPEN: f32 = 0.6;
const FULL: f32 = 0.55;
/// The same two of a round one, the least and largest share of the ellipse in its bounds that its hull fills, and its narrower side
/// over the wider.
const ROUND: (f32, f32) = (0.45, 0.8);
const FILL: (f32, f32) = (0.85, 1.15);
const NARROW: f32 = 0.45;
/// Stretch and turn of a tip of its outline.
const TIP: (f32, f32) = (0.1, 1.6);
/// Least part of the stem below a round head, in heights of the head.
const LONG: f32 = 1.6;
/// How far around a head other lines are looked at, as a share of its size.
const BESIDE: f32 = 0.15;
/// Longest line that is a dot, as a share of the head's diagonal, and most lines that are looked at near a head.
const DOT: f32 = 0.3;
const MOST_LINES: usize = 24;
/// Log-odds of teeth, and of a round head.
const SCORE: (f32, f32) = (3.0, 2.2);

/// Proposes a flower for each plain head on a stem of its own.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let numbers = (0..page.lines.len()).filter(|i| !page.is_apart(*i));
    let is_plain = |head: &Head| head.line.openness < OPEN && head.line.solidity() > FULL;
    let heads: Vec<Head> = numbers.filter_map(|i| Head::new(page, i)).filter(is_plain).collect();
    let grown = |head: &Head| {
        let (low, high) = head.line.bounds;
        (low - BESIDE * (high - low), high + BESIDE * (high - low))
    };
    let boxes: Vec<(Vec2, Vec2)> = heads.iter().map(grown).collect();
    let near = page.lines_at(&boxes);
    out.extend(heads.iter().zip(near).filter_map(|(head, near)| flower(page, head, &near)));
}

fn flower(
    page: &Page,
    Head { number, line: head, stem: own_stem }: &Head,
    near: &[usize],
) -> Option<Hypothesis> {
    if near.len() > MOST_LINES {
        return None;
    }
    let is_dot = |i: &usize| page.lines[*i].length < DOT * head.size().length();
    // Leaves at the foot of the stem may come near.
    let is_below = |line: &Line| line.bounds.0.y > head.bounds.1.y && stem_top(line, head).is_none();
    let is_near = |i: &usize| i != number && !is_below(&page.lines[*i]);
    let (dots, others): (Vec<usize>, Vec<usize>) = near.iter().copied().filter(is_near).partition(is_dot);
    let (stem, of_line) = match (own_stem, &others[..]) {
        (Some(stem), []) => (Cow::Borrowed(stem), None),
        (None, [line]) => (carrying(&page.lines[*line], head)?, Some(*line)),
        _ => return None,
    };
    let visible = stem.bounds.1.y - head.bounds.1.y;
    let is_leaf = stem_top(&stem, head).is_some_and(|root| points_away(head, root));
    let (score, mut parts) = match teeth(head, &stem) {
        Some(petals) => (SCORE.0, petals),
        None if is_round(head) && !is_leaf && visible > LONG * head.size().y => {
            (SCORE.1, rose::petals(head.middle(), 0.5 * head.size()))
        }
        None => return None,
    };
    // A stem that is a stroke of its own stays.
    let replaced = of_line.filter(|_| matches!(stem, Cow::Owned(_)));
    if own_stem.is_some() || replaced.is_some() {
        parts.push(Made::new(Tool::Branch, stem.points.iter().copied()));
    }
    let mut uses: Vec<usize> = dots.into_iter().chain(replaced).chain([*number]).collect();
    uses.sort_unstable();
    let (reading, habit) = (Reading::Corolla, Some(Habit::Flower));
    Some(Hypothesis { uses, score, parts, solids: Vec::new(), reading, habit })
}

/// The stem that a line is below a head, all of it or but for what runs along or within the head.
fn carrying<'a>(line: &'a Line, head: &Line) -> Option<Cow<'a, Line>> {
    if stem_top(line, head).is_some() {
        return Some(Cow::Borrowed(line));
    }
    let mut points = line.upward();
    let edge = head.bounds.1.y + 0.05 * head.size().y;
    let below = points.iter().take_while(|p| p.y > edge).count();
    let (low, high) = (head.bounds.0 - BESIDE * head.size(), head.bounds.1 + BESIDE * head.size());
    let is_at_head = |p: &Vec2| p.cmpgt(low).all() && p.cmplt(high).all();
    if !points[below..].iter().all(is_at_head) {
        return None;
    }
    points.truncate(below);
    line.part(points).filter(|stem| stem_top(stem, head).is_some()).map(Cow::Owned)
}

/// Petals of a cup with few teeth.
fn teeth(head: &Line, stem: &Line) -> Option<Vec<Made>> {
    let place = stem_top(stem, head)?;
    // A stem may end within its head.
    let foot = Vec2::new(place.x.clamp(head.bounds.0.x, head.bounds.1.x), head.bounds.1.y);
    let petals = cup::petals_of_teeth(head, foot)?;
    Some(petals.into_iter().map(|petal| Made::new(Tool::Petal, petal)).collect())
}

/// Whether a head is a disc or an ellipse, not pointed or narrow as a blade is.
fn is_round(head: &Line) -> bool {
    let size = head.size();
    let fill = head.hull_area / (FRAC_PI_4 * size.x * size.y).max(f32::MIN_POSITIVE);
    head.openness < ROUND.0
        && head.solidity() > ROUND.1
        && (FILL.0..FILL.1).contains(&fill)
        && size.min_element() > NARROW * size.max_element()
        && head.roundness() > NARROW
        && tips_of_hull(head, TIP).is_empty()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;
    use std::f32::consts::TAU;

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    /// An ellipse on (0, 0), open below by that angle.
    fn ellipse(half: Vec2, open: f32) -> Vec<Vec2> {
        let angle = |k: usize| 0.25 * TAU + 0.5 * open + (TAU - open) * k as f32 / 60.0;
        (0..=60).map(|k| Vec2::new(0.0, -half.y) + half * Vec2::from_angle(angle(k))).collect()
    }

    /// A cup with two teeth on (0, 0), left open by the last of these.
    fn tulip(upto: usize) -> Vec<Vec2> {
        let corners = [
            (0.0, 0.0),
            (-26.0, -14.0),
            (-28.0, -70.0),
            (2.0, -52.0),
            (26.0, -72.0),
            (27.0, -15.0),
            (1.0, 0.0),
        ];
        line(&corners[..upto])
    }

    fn stem() -> Vec<Vec2> {
        line(&[(3.0, 180.0), (0.0, -1.0)])
    }

    fn petals(flower: &Hypothesis) -> usize {
        flower.parts.iter().filter(|part| part.tool == Tool::Petal).count()
    }

    #[test]
    fn a_round_head_on_a_long_stem_is_full_of_petals_also_if_it_is_flat_or_open() {
        let half = Vec2::splat(40.0);
        for head in [ellipse(half, 0.0), ellipse(Vec2::new(40.0, 24.0), 0.0), ellipse(half, 0.6)] {
            let found = read(&[stem(), head]);
            assert_eq!((found.len(), &found[0].uses[..]), (1, &[1][..]));
            assert!(petals(&found[0]) >= 8);
        }
    }

    #[test]
    fn two_teeth_are_a_tulip_closed_or_open() {
        for upto in [6, 7] {
            let found = read(&[stem(), tulip(upto)]);
            assert_eq!((found.len(), petals(&found[0])), (1, 3), "two, and one in front");
        }
    }

    #[test]
    fn a_stem_may_end_within_its_head_or_run_along_its_edge() {
        let within = line(&[(3.0, 180.0), (0.0, -30.0)]);
        assert_eq!(read(&[within, tulip(7)]).len(), 1);
        let along = line(&[(3.0, 140.0), (0.0, 0.0), (-34.0, -3.0), (34.0, -6.0)]);
        let found = read(&[along, ellipse(Vec2::splat(38.0), 0.0)]);
        assert_eq!(&found[0].uses[..], [0, 1]);
        let stem = found[0].parts.last().unwrap();
        assert!(stem.tool == Tool::Branch && stem.points.iter().all(|p| p.position.y > 0.0));
    }

    #[test]
    fn crowns_blades_and_what_has_veins_are_none() {
        let short = line(&[(3.0, 80.0), (0.0, -1.0)]);
        let disc = ellipse(Vec2::splat(40.0), 0.0);
        assert!(read(&[short, disc.clone()]).is_empty(), "a tree");
        let blade = line(&[
            (0.0, 0.0),
            (-30.0, -24.0),
            (-20.0, -60.0),
            (0.0, -95.0),
            (20.0, -60.0),
            (30.0, -24.0),
            (0.0, 0.0),
        ]);
        assert!(read(&[stem(), blade]).is_empty());
        assert!(read(&[stem(), disc.clone(), line(&[(0.0, 0.0), (0.0, -75.0)])]).is_empty(), "a midrib");
        assert!(read(&[disc]).is_empty(), "no stem");
    }
}
