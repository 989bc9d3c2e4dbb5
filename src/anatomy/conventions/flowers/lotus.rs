//! A flower of pointed petals that stand side by side on one foot, without a stem: a lotus from the side.
//!
//! Several lines enclose an area together ([`Silhouette`]) that is round below and has [`TIPS`] sharp tips above, the highest near the
//! middle, with notches between them. Each line draws a part of its outline: a petal, or a side of one. Petals go from the lowest place to each tip, and
//! others stand in front, as in a [`cup`](super::cup). Limits: flowers that lean.

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
/// Log-odds.
const SCORE: f32 = 4.6;

/// Proposes a flower for each group of lines.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let several = page.groups.iter().filter(|group| (LINES.0..=LINES.1).contains(&group.len()));
    out.extend(several.filter_map(|group| lotus(page, group)));
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
    let score = SCORE * page.weight(size.length());
    let (reading, habit) = (Reading::Corolla, Some(Habit::Flower));
    Some(Hypothesis { uses: group.to_vec(), score, parts, solids: Vec::new(), reading, habit })
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
}
