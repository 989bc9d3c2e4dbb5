//! A flower of pointed petals that stand side by side on one foot, without a stem: a lotus from the side.
//!
//! Several lines enclose an area together ([`Silhouette`]) that is round below and has [`TIPS`] sharp tips above, the highest near the
//! middle, with notches between them. Each line draws a part of its outline: a petal, or a side of one. Petals go from the lowest place to each tip, and
//! others stand in front, as in a [`cup`](super::cup). A hollow line across their feet, as of the lowest petals, belongs to it: it is no bowl
//! in which leaves stand, for those do not reach up in a round. Limits: flowers that lean.

use super::cup;
use crate::anatomy::conventions::page::{self, Line, Page, notches};
use crate::anatomy::conventions::shapes::silhouette::{Silhouette, share_along, smooth_contour};
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::geom::{
    polyline,
    simple_loop::{self, hull_area},
};
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Fewest lines, and most.
const LINES: (usize, usize) = (3, 12);
/// Fewest tips and most, the stretch over which one turns, as a share of the outline, and least turn there, radians.
const TIPS: (usize, usize) = (3, 9);
const TIP: (f32, f32) = (0.05, 0.9);
/// Least height of a tip, and of a notch, as shares of the whole's.
const HIGH: (f32, f32) = (0.4, 0.25);
/// Highest notch at the foot, as a share of the height.
const AT_FOOT: f32 = 0.15;
/// Farthest of the highest tip and of the lowest place from the middle, as a share of the width.
const AMID: f32 = 0.17;
/// Least share of its hull that it fills, and least width over height and most.
const FULL: f32 = 0.6;
const WIDTH: (f32, f32) = (0.7, 2.4);
/// Least part of the outline that each line draws.
const DRAWN: f32 = 0.07;
/// Widest foot, as a share of the width, in the lowest part of that share of the height.
const FOOT: (f32, f32) = (0.7, 0.06);
/// How wide gaps of the outline are closed, in cells of the silhouette, and its points.
const BRIDGE: i32 = 8;
const POINTS: usize = 200;
/// A hollow line across the feet: least width and most, as shares of the flower's, how high its ends are at most and how far it goes down
/// at least and at most, as shares of the flower's height, and most length over its width.
const HOLLOW: (f32, f32, f32, f32, f32, f32) = (0.35, 1.05, 0.35, 0.04, 0.38, 1.5);
/// Log-odds, more with a hollow line, and over a pot, in which leaves stand in a round as well.
const SCORE: (f32, f32, f32) = (4.6, 5.5, -0.6);

/// Proposes a flower for each group of lines.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let several = page.groups.iter().filter(|group| (LINES.0..=LINES.1 + 1).contains(&group.len()));
    out.extend(several.filter_map(|group| lotus(page, group).or_else(|| over_hollow(page, group))));
}

/// The flower of a group but for the hollow line across its feet.
fn over_hollow(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    let rest = |line: usize| group.iter().copied().filter(|i| *i != line).collect::<Vec<_>>();
    let is_below = |line: &usize| {
        is_hollow(&page.lines[*line], page::bounds(rest(*line).iter().map(|i| &page.lines[*i])))
    };
    let hollow = group.iter().copied().filter(|_| group.len() > LINES.0).find(is_below)?;
    lotus(page, &rest(hollow))
}

fn lotus(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    let lines: Vec<&Line> = group.iter().map(|i| &page.lines[*i]).collect();
    let (low, high) = page::bounds(lines.iter().copied());
    let size = high - low;
    if !(WIDTH.0..WIDTH.1).contains(&(size.x / size.y.max(f32::MIN_POSITIVE))) {
        return None;
    }
    let silhouette = Silhouette::new(lines.iter().map(|line| line.points.as_slice()), BRIDGE);
    let outline = smooth_contour(&silhouette.contour(), POINTS, 1);
    let near = 3.0 * silhouette.cell();
    let draws = |line: &&Line| share_along(&outline, std::iter::once(line.points.as_slice()), near) > DRAWN;
    let is_full = simple_loop::area(&outline) > FULL * hull_area(&outline);
    let height = |p: &Vec2| (high.y - p.y) / size.y;
    let middle = low.midpoint(high).x;
    let is_amid = |p: &Vec2| (p.x - middle).abs() < AMID * size.x;
    // Between petals that bulge below their foot there is one.
    let mut notches = notches(&outline);
    notches.retain(|notch| !(is_amid(notch) && height(notch) < AT_FOOT));
    let is_open = notches.len() >= TIPS.0 - 1 && notches.iter().all(|notch| height(notch) > HIGH.1);
    if !is_full || !is_open || !lines.iter().all(draws) {
        return None;
    }
    let mut tips: Vec<Vec2> = page::tips(&outline, TIP);
    tips.retain(|tip| height(tip) > HIGH.0);
    tips.sort_by(|a, b| a.x.total_cmp(&b.x));
    let highest = tips.iter().min_by(|a, b| a.y.total_cmp(&b.y))?;
    let (left, right) = polyline::bounds(outline.iter().copied().filter(|p| height(p) < FOOT.1));
    let foot = Vec2::new(left.midpoint(right).x, high.y);
    let stands = right.x - left.x < FOOT.0 * size.x && is_amid(&foot);
    if !(TIPS.0..=TIPS.1).contains(&tips.len()) || !is_amid(highest) || !stands {
        return None;
    }
    let petals = cup::petals(&outline, foot, &tips)?;
    let parts = petals.into_iter().map(|petal| Made::new(Tool::Petal, petal)).collect();
    let hollow =
        (0..page.lines.len()).find(|i| !group.contains(i) && is_hollow(&page.lines[*i], (low, high)));
    let score = SCORE.0
        + match hollow {
            Some(_) => SCORE.1,
            None if page.has_apart() => SCORE.2,
            None => 0.0,
        };
    let score = score * page.weight(size.length());
    let mut uses: Vec<usize> = group.iter().copied().chain(hollow).collect();
    uses.sort_unstable();
    let (reading, habit) = (Reading::Corolla, Some(Habit::Flower));
    Some(Hypothesis { uses, score, parts, solids: Vec::new(), reading, habit })
}

/// Whether a line runs across the feet of a flower in these bounds, down from one end and up to the other.
fn is_hollow(line: &Line, (low, high): (Vec2, Vec2)) -> bool {
    let (size, (first, last)) = (high - low, line.ends());
    let (width, lowest) = (line.size().x, line.bounds.1.y);
    let ends = first.y.min(last.y);
    let is_amid = (line.middle().x - low.midpoint(high).x).abs() < AMID * size.x;
    let is_across = (first.x - last.x).abs() > 0.8 * width && line.length < HOLLOW.5 * width;
    is_amid
        && is_across
        && (HOLLOW.0 * size.x..HOLLOW.1 * size.x).contains(&width)
        && high.y - ends < HOLLOW.2 * size.y
        && (HOLLOW.3 * size.y..HOLLOW.4 * size.y).contains(&(lowest - first.y.max(last.y)))
        && lowest > high.y - HOLLOW.3 * size.y
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    /// A petal from the origin to a tip, bulging to both sides.
    fn petal(x: f32, y: f32) -> Vec<Vec2> {
        let tip = Vec2::new(x, y);
        let side = |k: usize, sign: f32| {
            let t = k as f32 / 20.0;
            t * tip + sign * 0.36 * tip.length() * (std::f32::consts::PI * t).sin() * tip.normalize().perp()
        };
        (0..=20).map(|k| side(k, 1.0)).chain((0..=20).rev().map(|k| side(k, -1.0))).collect()
    }

    #[test]
    fn pointed_petals_on_one_foot_are_a_flower() {
        let found = read(&[petal(0.0, -120.0), petal(-66.0, -92.0), petal(66.0, -92.0)]);
        let [lotus] = &found[..] else { panic!("{} flowers", found.len()) };
        assert_eq!((lotus.parts.len(), lotus.uses.len()), (5, 3), "three, and two in front");
    }

    #[test]
    fn two_leaves_grass_and_what_stands_on_a_stem_are_none() {
        assert!(read(&[petal(-60.0, -80.0), petal(60.0, -80.0)]).is_empty());
        let blade = |x: f32| line(&[(x - 5.0, 0.0), (x, -100.0), (x + 5.0, 0.0)]);
        assert!(read(&[blade(-20.0), blade(0.0), blade(20.0)]).is_empty());
        let stem = line(&[(0.0, 150.0), (0.0, 0.0)]);
        assert!(read(&[petal(0.0, -120.0), petal(-66.0, -92.0), petal(66.0, -92.0), stem]).is_empty());
    }

    #[test]
    fn a_hollow_line_across_the_feet_belongs_to_it() {
        let petals = [petal(0.0, -120.0), petal(-66.0, -92.0), petal(66.0, -92.0)];
        let hollow = line(&[(-60.0, -4.0), (-30.0, 18.0), (0.0, 24.0), (30.0, 18.0), (60.0, -4.0)]);
        let found = read(&[&petals[..], &[hollow]].concat());
        assert_eq!((found.len(), &found[0].uses[..]), (1, &[0, 1, 2, 3][..]));
        let alone = read(&petals)[0].score;
        assert!(found[0].score > alone + 3.0, "{} {alone}", found[0].score);
        let deep = line(&[(-60.0, -4.0), (-40.0, 80.0), (40.0, 80.0), (60.0, -4.0)]);
        let bowl = read(&[&petals[..], &[deep]].concat());
        assert!(bowl.iter().all(|flower| flower.score < alone + 1.0), "a bowl");
    }
}
