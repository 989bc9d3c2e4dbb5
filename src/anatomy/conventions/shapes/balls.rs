//! Round outlines as fruits: what is a ball, and which balls in a crown are its fruits.
//!
//! In a crown round outlines are fruits if several are alike, much smaller than that, and by themselves: loops of foliage touch.
//! Limits: a single fruit in a crown is none.

use crate::anatomy::conventions::page::Line;
use crate::anatomy::conventions::{Solid, SolidKind};
use crate::geom::polyline;
use glam::Vec2;
use std::f32::consts::{FRAC_PI_4, PI};

/// Largest opening of a fruit's outline, narrower over wider side, and the least and largest share of the ellipse in its bounds that
/// its hull fills.
const OPEN: f32 = 0.45;
const NARROW: f32 = 0.72;
const FILL: (f32, f32) = (0.88, 1.12);
/// Largest fruit in a crown and smallest, as shares of the crown's larger side.
const IN_CROWN: (f32, f32) = (0.03, 0.22);
/// Fewest fruits in a crown.
const SEVERAL: usize = 2;
/// How far other lines are from one at least, as a share of its size, and most of the largest in the smallest: loops of foliage touch.
const FREE: f32 = 0.06;
const ALIKE: f32 = 1.8;
/// Longest stalk that touches a fruit in a crown, as a share of the fruit's size.
const STALK: f32 = 0.8;
/// Rows of a fruit's outline.
const ROWS: usize = 12;

/// Whether a line is a ball, with a notch where its stalk comes in or without.
pub(crate) fn is_round(line: &Line) -> bool {
    let size = line.size();
    let fill = line.hull_area / (FRAC_PI_4 * size.x * size.y).max(f32::MIN_POSITIVE);
    line.openness < OPEN
        && line.solidity() > 0.7
        && size.min_element() > NARROW * size.max_element()
        && (FILL.0..FILL.1).contains(&fill)
        && !line.is_scribble()
}

/// A ball as wide and high as an outline.
pub(crate) fn fruit(line: &Line) -> Solid {
    let (middle, half) = (line.middle(), 0.5 * line.size());
    let row = |k: usize| {
        let angle = PI * k as f32 / ROWS as f32;
        Vec2::new(half.x * angle.sin(), middle.y - half.y * angle.cos())
    };
    Solid { kind: SolidKind::Fruit, axis: middle.x, profile: (0..=ROWS).map(row).collect() }
}

/// The fruits among the lines in a crown.
pub(crate) fn in_crown<'a>(lines: impl Iterator<Item = &'a Line>, crown: &[Vec2]) -> Vec<Solid> {
    let (low, high) = polyline::bounds(crown.iter().copied());
    let whole = (high - low).max_element();
    let is_inside = |line: &Line| line.bounds.0.cmpgt(low).all() && line.bounds.1.cmplt(high).all();
    let is_of_size =
        |line: &Line| (IN_CROWN.0 * whole..IN_CROWN.1 * whole).contains(&line.size().max_element());
    let all: Vec<&Line> = lines.collect();
    let is_free = |line: &Line| {
        let margin = Vec2::splat(FREE * line.size().max_element());
        let (low, high) = (line.bounds.0 - margin, line.bounds.1 + margin);
        let is_near = |p: &Vec2| p.cmpgt(low).all() && p.cmplt(high).all();
        let is_stalk =
            |other: &Line| other.length < STALK * line.size().max_element() && other.openness > OPEN;
        let mut others = all.iter().filter(|other| other.stroke != line.stroke && !is_stalk(other));
        others.all(|other| !other.points.iter().any(is_near))
    };
    let is_fruit = |line: &&Line| is_inside(line) && is_of_size(line) && is_round(line) && is_free(line);
    let fruits: Vec<&Line> = all.iter().copied().filter(is_fruit).collect();
    let sizes = fruits.iter().map(|fruit| fruit.size().max_element());
    let (small, large) = sizes.fold((f32::INFINITY, 0.0_f32), |(a, b), size| (a.min(size), b.max(size)));
    let are_alike = fruits.len() >= SEVERAL && large < ALIKE * small;
    if are_alike { fruits.into_iter().map(fruit).collect() } else { Vec::new() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;
    use crate::anatomy::conventions::page::Page;
    use std::f32::consts::TAU;

    fn ball(x: f32, y: f32) -> Vec<Vec2> {
        (0..=48).map(|k| Vec2::new(x, y) + 30.0 * Vec2::from_angle(TAU * k as f32 / 48.0)).collect()
    }

    #[test]
    fn small_balls_in_a_crown_are_its_fruits() {
        let crown: Vec<Vec2> = ball(0.0, 0.0).iter().map(|p| 10.0 * *p).collect();
        let lines =
            Page::of_lines(&[ball(50.0, 0.0), ball(-90.0, 80.0), line(&[(-200.0, 0.0), (-160.0, 9.0)])])
                .lines;
        assert_eq!(in_crown(lines.iter(), &crown).len(), 2);
        let stalked = [ball(50.0, 0.0), ball(-90.0, 80.0), line(&[(51.0, -31.0), (56.0, -52.0)])];
        assert_eq!(in_crown(Page::of_lines(&stalked).lines.iter(), &crown).len(), 2, "a stalk");
        let tight: Vec<Vec2> = crown.iter().map(|p| 0.4 * *p).collect();
        assert!(in_crown(lines.iter(), &tight).is_empty());
    }
}
