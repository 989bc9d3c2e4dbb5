//! Ball cacti: a round outline, open at its foot or in a pot, with ribs that go from its foot to its top.
//!
//! A rib is a line inside the outline that begins in its lowest part and ends in its highest. On either side one at least bulges
//! outward, as meridians of a globe do; the veins of a leaf end at its edge, and the sides of petals end in tips. The body stands on a
//! broad foot, so it is no flower on a stem and no balloon. Small strokes in it are spines. In a
//! pot a ball needs no ribs, and may be a column with a round top.
//!
//! Limits: a ball without ribs on the ground is read by its spines, if it has any.

use super::swollen;
use crate::anatomy::conventions::page::{Line, Page};
use crate::anatomy::conventions::{Habit, Hypothesis};
use crate::sketch::Reading;
use glam::Vec2;
use std::f32::consts::FRAC_PI_4;

/// Smallest ball, as a share of the drawing's diagonal.
const SMALLEST: f32 = 0.15;
/// Height over width, and the least share of the ellipse in its bounds that its hull fills.
const FORM: (f32, f32) = (0.6, 1.7);
/// Greatest height over width in a pot, where it may be a column.
const COLUMN: f32 = 4.5;
const FILL: f32 = 0.9;
/// Uppermost part, as a share of its height, and least width there, as a share of its own: a petal ends in a tip.
const DOME: (f32, f32) = (0.07, 0.35);
/// Where the ends of an outline and of its ribs are, from its foot and from its top, as shares of its height.
const FOOT: f32 = 0.25;
const TOP: f32 = 0.2;
/// Least width of the foot, as a share of the ball's.
const BROAD: f32 = 0.3;
/// How far a rib bulges at least, as a share of the ball's width.
const BULGE: f32 = 0.06;
/// How far above or below the upper edge of a pot a ball in it ends, as a share of the pot's height.
const MOUTH: f32 = 0.3;
/// Lowest part of a ball that is left out, as a share of its height.
const END: f32 = 0.02;
/// Longest spine, as a share of the ball's diagonal, and most lines in one.
const SPINE: f32 = 0.12;
const MOST: usize = 60;
/// Log-odds, and more for each rib up to so many.
const SCORE: (f32, f32, usize) = (4.6, 0.2, 6);
/// Log-odds of a ball without ribs in a pot.
const PLAIN: f32 = 3.0;

/// Proposes a ball cactus for each outline with ribs.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let is_body = |i: &usize| !page.is_apart(*i) && is_ball(&page.lines[*i], page.diagonal);
    let bodies: Vec<usize> = (0..page.lines.len()).filter(is_body).collect();
    let boxes: Vec<(Vec2, Vec2)> = bodies.iter().map(|i| page.lines[*i].bounds).collect();
    let near = page.lines_at(&boxes);
    let pot = out.iter().find(|other| other.reading == Reading::Pot);
    let mouth = pot.and_then(|pot| pot.solids.first()).map(|pot| pot.bounds());
    out.extend(bodies.iter().zip(near).filter_map(|(body, near)| ball(page, *body, &near, mouth)));
}

/// Whether a line is about a circle, whole or open at its foot.
fn is_ball(line: &Line, diagonal: f32) -> bool {
    let size = line.size();
    let fill = line.hull_area / (FRAC_PI_4 * size.x * size.y).max(f32::MIN_POSITIVE);
    let low = line.bounds.1.y - FOOT * size.y;
    let near_top = line.points.iter().filter(|p| p.y < line.bounds.0.y + DOME.0 * size.y).map(|p| p.x);
    let (left, right) = near_top.fold((f32::INFINITY, f32::NEG_INFINITY), |(l, r), x| (l.min(x), r.max(x)));
    let (first, last) = line.ends();
    let is_open_below = first.y > low && last.y > low;
    size.length() > SMALLEST * diagonal
        && (FORM.0..COLUMN).contains(&(size.y / size.x))
        && fill > FILL
        && right - left > DOME.1 * size.x
        && line.solidity() > FILL
        && (is_open_below || line.is_closed_and_solid())
        && !line.is_scribble()
}

fn ball(page: &Page, body: usize, near: &[usize], mouth: Option<(Vec2, Vec2)>) -> Option<Hypothesis> {
    let line = &page.lines[body];
    let ((low, high), size) = (line.bounds, line.size());
    // A flower on its top stays by itself.
    let is_above = |other: &Line| other.middle().y < low.y + 0.05 * size.y;
    let inside: Vec<usize> =
        near.iter().copied().filter(|i| *i != body && !is_above(&page.lines[*i])).collect();
    let is_within = |other: &Line| {
        let margin = Vec2::splat(0.1 * size.length());
        other.bounds.0.cmpgt(low - margin).all() && other.bounds.1.cmplt(high + margin).all()
    };
    let (spines, ribs): (Vec<usize>, Vec<usize>) =
        inside.iter().partition(|i| page.lines[**i].length < SPINE * size.length());
    let bulges: Vec<f32> = ribs.iter().map(|i| rib(&page.lines[*i], line)).collect::<Option<Vec<f32>>>()?;
    let is_globe = bulges.iter().any(|bulge| *bulge > BULGE) && bulges.iter().any(|bulge| *bulge < -BULGE);
    let is_potted = mouth.is_some_and(|mouth| is_in(line, mouth));
    let are_within = spines.iter().chain(&ribs).all(|i| is_within(&page.lines[*i]));
    let is_low = size.y < FORM.1 * size.x;
    let is_one = is_potted || is_globe && is_low && has_broad_foot(line);
    if !is_one || !are_within || inside.len() > MOST {
        return None;
    }
    // One of several things in a pot is a leaf.
    let is_apart =
        |i: &usize| *i == body || page.is_apart(*i) || inside.contains(i) || is_above(&page.lines[*i]);
    if !is_globe && !(0..page.lines.len()).all(|i| is_apart(&i)) {
        return None;
    }
    // The very foot, where the hand began and ended, is left out.
    let axis = low.x.midpoint(high.x);
    let (foot, top) = (Vec2::new(axis, high.y - END * size.y), Vec2::new(axis, low.y));
    let part = swollen::branch(&line.points, foot, top)?;
    let mut uses: Vec<usize> = inside.into_iter().chain([body]).collect();
    uses.sort_unstable();
    let of_ribs = SCORE.0 + SCORE.1 * ribs.len().min(SCORE.2) as f32;
    let score = if is_globe { of_ribs } else { PLAIN };
    Some(Hypothesis {
        uses,
        score: score * page.weight(size.length()),
        parts: vec![part],
        solids: Vec::new(),
        reading: Reading::Cactus,
        habit: Some(Habit::Succulent),
    })
}

/// How far a line bulges to the right in the middle of its height, as a share of the ball's width, if it goes from the foot to the top.
fn rib(line: &Line, ball: &Line) -> Option<f32> {
    let ((low, high), size) = (ball.bounds, ball.size());
    let (first, last) = line.ends();
    let (top, foot) = if first.y < last.y { (first, last) } else { (last, first) };
    let goes_through = top.y < low.y + TOP * size.y && foot.y > high.y - FOOT * size.y;
    let middle = top.midpoint(foot);
    let there =
        line.points.iter().min_by(|a, b| (a.y - middle.y).abs().total_cmp(&(b.y - middle.y).abs()))?;
    goes_through.then_some((there.x - middle.x) / size.x)
}

/// Whether the outline of a ball is open over a broad foot.
fn has_broad_foot(ball: &Line) -> bool {
    let (first, last) = ball.ends();
    (first.x - last.x).abs() > BROAD * ball.size().x
}

/// Whether a ball stands in the mouth of a pot.
fn is_in(ball: &Line, (low, high): (Vec2, Vec2)) -> bool {
    let foot = Vec2::new(ball.middle().x, ball.bounds.1.y);
    (low.x..high.x).contains(&foot.x) && (foot.y - low.y).abs() < MOUTH * (high.y - low.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::beneath::pot;
    use crate::anatomy::conventions::{line, read_above, read_by};
    use crate::sketch::Tool;
    use std::f32::consts::{PI, TAU};

    /// A circle from one side of a foot to the other.
    fn open_below() -> Vec<Vec2> {
        let place = |k: usize| {
            let angle = 0.5 * PI + 0.1 * TAU + 0.8 * TAU * k as f32 / 60.0;
            80.0 * Vec2::from_angle(angle)
        };
        (0..=60).map(place).collect()
    }

    fn ribs() -> [Vec<Vec2>; 3] {
        let side = |sign: f32| line(&[(sign * 25.0, 62.0), (sign * 48.0, 0.0), (sign * 12.0, -74.0)]);
        [side(-1.0), line(&[(0.0, 62.0), (0.0, -78.0)]), side(1.0)]
    }

    #[test]
    fn a_globe_with_ribs_is_one_swollen_body() {
        let found = read_by(propose, &[vec![open_below()], ribs().to_vec()].concat());
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].reading, &found[0].uses[..]), (Reading::Cactus, &[0, 1, 2, 3][..]));
        let [body] = &found[0].parts[..] else { panic!("{} parts", found[0].parts.len()) };
        assert!(body.tool == Tool::Branch && (body.half_width.unwrap() - 80.0).abs() < 3.0);
    }

    #[test]
    fn leaves_with_veins_and_petals_on_a_stem_are_none() {
        let veins = [line(&[(0.0, 62.0), (0.0, -78.0)]), line(&[(0.0, 20.0), (50.0, -30.0)])];
        assert!(read_by(propose, &[vec![open_below()], veins.to_vec()].concat()).is_empty());
        let mut closed = open_below();
        closed.push(closed[0]);
        let found = read_by(propose, &[vec![closed], ribs().to_vec()].concat());
        assert!(found.is_empty(), "no foot");
        assert!(read_by(propose, &[open_below()]).is_empty(), "no ribs");
    }

    #[test]
    fn a_ball_in_a_pot_needs_no_ribs() {
        let pot = line(&[(-60.0, 80.0), (-45.0, 170.0), (45.0, 170.0), (60.0, 80.0), (-60.0, 80.0)]);
        let mut closed = open_below();
        closed.push(closed[0]);
        let lift =
            |points: Vec<Vec2>| points.into_iter().map(|p| p + Vec2::new(0.0, 10.0)).collect::<Vec<_>>();
        let found = read_above(pot::propose, propose, &[pot.clone(), lift(closed.clone())]);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].uses, [1]);
        let half = |sign: f32| {
            lift(closed.clone()).into_iter().map(|p| Vec2::new(0.4 * p.x + 33.0 * sign, p.y)).collect()
        };
        assert!(read_above(pot::propose, propose, &[pot, half(-1.0), half(1.0)]).is_empty(), "two leaves");
    }

    #[test]
    fn a_column_in_a_pot_keeps_the_flower_on_its_top_apart() {
        let pot = line(&[(-60.0, 80.0), (-45.0, 170.0), (45.0, 170.0), (60.0, 80.0), (-60.0, 80.0)]);
        let column = line(&[
            (-30.0, 76.0),
            (-38.0, 0.0),
            (-30.0, -80.0),
            (0.0, -105.0),
            (30.0, -80.0),
            (38.0, 0.0),
            (30.0, 76.0),
        ]);
        let flower = line(&[(0.0, -106.0), (-12.0, -125.0), (0.0, -135.0), (12.0, -125.0), (0.0, -106.0)]);
        let spine = line(&[(37.0, -10.0), (48.0, -14.0)]);
        let found = read_above(pot::propose, propose, &[pot, column, flower, spine]);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].uses, [1, 3]);
    }
}
