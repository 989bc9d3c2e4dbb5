//! All strokes of a lobe to one closed surface, before it is untangled and remeshed.
//!
//! | strokes | surface |
//! | --- | --- |
//! | loops, with or without open strokes at the ends | strips between neighbours; ends closed by the open stroke, else by a round cap |
//! | one loop alone | its outline made round |
//! | two open strokes that meet at their ends | circles between them |
//! | open strokes otherwise | the sheet between them, made thick |
//!
//! A round cap is half as high as its loop's mean radius, times how much the last strip narrows, and begins in that strip's direction.
//!
//! Source: 001 §5.2.1; its missing cases are named in the files that fill them.

use super::between::with_loops_between;
use super::cap::{Round, cap, round_cap};
use super::lobe::Form;
use super::order::{Order, order};
use super::outline::inflated;
use super::sheet::sheet;
use super::strip::{Loop, strip};
use super::stroke::Line;
use super::surface::Surface;
use super::turned;
use glam::Vec3;

/// Height of a round cap on the end of a straight lobe, as a share of its loop's mean radius.
const CAP: f32 = 0.5;
/// Least and most that a lobe's last strip narrows for its round cap.
const TAPER: (f32, f32) = (0.3, 1.2);

/// Least and most that a round cap's shoulder is as wide as its loop.
const SHOULDER: (f32, f32) = (0.4, 1.3);
/// Distance from a loop, in its edges, within which the end of an open stroke lies on it.
const RIM: f32 = 0.7;

/// A surface from strokes, and which of them have no place in it.
#[derive(Clone, Debug, Default)]
pub(super) struct Lofted {
    /// The surface: closed, but it may cross itself or be inside out.
    pub(super) surface: Surface,
    /// Whether it comes from a grid, so that sharp edges mean nothing.
    pub(super) of_grid: bool,
    /// Strokes without a place, by their numbers.
    pub(super) left_out: Vec<usize>,
}

/// Why strokes make no surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lack {
    /// There is none.
    Strokes,
    /// There is one open one.
    SecondStroke,
    /// Profiles must be two open strokes.
    Profiles,
}

/// Makes the surface of a lobe.
///
/// # Errors
/// What is missing.
pub(super) fn loft(lines: &[Line], form: Form, in_order: bool) -> Result<Lofted, Lack> {
    let open = lines.iter().filter(|line| !line.closed).count();
    match (form, lines) {
        (_, []) => Err(Lack::Strokes),
        (Form::Turned, [a, b]) if open == 2 => Ok(turned_lobe(a, b)),
        (Form::Turned, _) => Err(Lack::Profiles),
        (_, [line]) if line.closed => {
            Ok(Lofted { surface: inflated(line), of_grid: true, left_out: Vec::new() })
        }
        (_, [_]) => Err(Lack::SecondStroke),
        (Form::Auto, [a, b]) if open == 2 && turned::are_profiles(a, b) => Ok(turned_lobe(a, b)),
        _ if open == lines.len() => Ok(Lofted { surface: sheet(lines), ..Lofted::default() }),
        _ => Ok(along(lines, order(lines, in_order), true)),
    }
}

fn turned_lobe(a: &Line, b: &Line) -> Lofted {
    let circles = turned::circles(a, b);
    let order = Order { loops: (0..circles.len()).collect(), ..Order::default() };
    along(&circles, order, false)
}

/// Strips between loops that are in order, and both ends; where loops are far apart, with loops between them.
fn along(lines: &[Line], order: Order, far_apart: bool) -> Lofted {
    let mut surface = Surface::default();
    let mut placed: Vec<Loop> = Vec::new();
    let drawn: Vec<&Line> = order.loops.iter().map(|k| &lines[*k]).collect();
    let (loops, places) = if far_apart {
        with_loops_between(&drawn)
    } else {
        (drawn.iter().map(|line| (*line).clone()).collect(), (0..drawn.len()).collect())
    };
    for line in &loops {
        let next = add(&mut surface, line);
        let next = match placed.last() {
            Some(before) => strip(before, &next, &mut surface.triangles),
            None => next,
        };
        placed.push(next);
    }
    let last = placed.len() - 1;
    let neighbours = [places.get(1).copied().unwrap_or(0), places[places.len().saturating_sub(2)]];
    // Strips lie to the left of their first loop, so the first end sees it the other way round.
    let ends = [
        (placed[0].reversed(), [0, 1.min(last), neighbours[0]]),
        (placed[last].clone(), [last, last.saturating_sub(1), neighbours[1]]),
    ];
    for (open, (around, near)) in order.caps.into_iter().zip(ends) {
        match open {
            Some(open) => {
                let stroke = add(&mut surface, &within(&lines[open], &around));
                cap(&around, &stroke, &mut surface.triangles);
            }
            None => {
                let round = out_of(&around, near.map(|k| &placed[k]));
                round_cap(&around, round, &mut surface);
            }
        }
    }
    Lofted { surface, of_grid: false, left_out: order.left_out }
}

fn add(surface: &mut Surface, line: &Line) -> Loop {
    let first = surface.points.len() as u32;
    surface.points.extend(&line.points);
    Loop { ids: (first..surface.points.len() as u32).collect(), points: line.points.clone() }
}

/// An open stroke without the samples at its ends that lie on a loop: where a hand draws from rim to rim.
fn within(stroke: &Line, around: &Loop) -> Line {
    let edge = around.points[0].distance(around.points[1]);
    let on_rim = |p: &Vec3| around.points.iter().any(|rim| rim.distance(*p) < RIM * edge);
    let mut points = stroke.points.as_slice();
    while points.len() > 3 && on_rim(&points[0]) {
        points = &points[1..];
    }
    while points.len() > 3 && on_rim(&points[points.len() - 1]) {
        points = &points[..points.len() - 1];
    }
    Line { closed: false, points: points.to_vec() }
}

/// The round cap on a loop, from the loop itself, the next one, and the next one that was drawn.
fn out_of(around: &Loop, near: [&Loop; 3]) -> Round {
    let line = |of: &Loop| Line { closed: true, points: of.points.clone() };
    let [here, next, drawn] = near.map(line);
    let normal = line(around).normal();
    let along = here.centroid() - next.centroid();
    // A lone loop is closed on the side that faces lie on.
    let side = if normal.dot(along) < 0.0 { -1.0 } else { 1.0 };
    let way = (normal * side).try_normalize().unwrap_or(Vec3::Y);
    let taper = (here.radius() / drawn.radius()).clamp(TAPER.0, TAPER.1);
    let height = CAP * here.radius() * taper;
    let rise = along.dot(way);
    let lean = if rise > 0.0 { (here.radius() - next.radius()) / rise } else { 0.0 };
    let shoulder = (1.0 + lean * height / here.radius()).clamp(SHOULDER.0, SHOULDER.1);
    Round { way, height, shoulder }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::TAU;

    pub(super) fn ring(count: usize, radius: f32, height: f32) -> Line {
        let at = |k: usize| {
            let (sin, cos) = (k as f32 / count as f32 * TAU).sin_cos();
            Vec3::new(radius * cos, height, radius * sin)
        };
        Line { closed: true, points: (0..count).map(at).collect() }
    }

    fn arch(height: f32, top: f32) -> Line {
        let at = |k: i16| {
            let x = f32::from(k) / 10.0;
            Vec3::new(x, top - (top - height) * x * x, 0.0)
        };
        Line { closed: false, points: (-10..=10).map(at).collect() }
    }

    #[test]
    fn rings_with_and_without_caps_are_closed() {
        let mut backward = ring(40, 0.8, 2.0);
        backward.points.reverse();
        let rings = vec![ring(48, 1.0, 1.0), backward, ring(24, 0.5, 3.0)];
        let capped = [rings.clone(), vec![arch(3.0, 3.4), arch(1.0, 0.5)]].concat();
        for lines in [rings, capped, vec![ring(48, 1.0, 1.0), arch(1.0, 1.8)]] {
            let Lofted { mut surface, left_out, .. } = loft(&lines, Form::Auto, false).unwrap();
            assert!(left_out.is_empty());
            if surface.signed_volume() < 0.0 {
                surface.flip();
            }
            assert_eq!(surface.check_invariants(), Ok(()));
            assert!(surface.signed_volume() > 1.0, "{}", surface.signed_volume());
        }
    }

    #[test]
    fn what_is_missing_is_said() {
        assert_eq!(loft(&[], Form::Auto, false).unwrap_err(), Lack::Strokes);
        assert_eq!(loft(&[arch(0.0, 1.0)], Form::Auto, false).unwrap_err(), Lack::SecondStroke);
        let rings = [ring(20, 1.0, 0.0), ring(20, 1.0, 1.0)];
        assert_eq!(loft(&rings, Form::Turned, false).unwrap_err(), Lack::Profiles);
    }

    #[test]
    fn open_strokes_are_profiles_or_a_sheet() {
        let profiles = [arch(0.0, 1.0), arch(0.0, -1.0)];
        let round = loft(&profiles, Form::Auto, false).unwrap().surface;
        let flat = loft(&profiles, Form::Sheet, false).unwrap().surface;
        assert!(round.signed_volume().abs() > 5.0 * flat.signed_volume().abs());
        assert_eq!(round.check_invariants(), Ok(()));
    }
}
