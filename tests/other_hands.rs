//! Drawings by people as other hands would have drawn them: strokes split, shortened, drawn again, gone round twice, and the whole bent,
//! stretched, its strokes moved against each other. Neither how a line is divided into strokes nor where a hand strays must change what
//! plant the drawing shows.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use crate::people::{Drawing, Share, drawings, mix};
use glam::Vec2;
use penstemon::anatomy::conventions::{self, ConventionParams, Habit};
use penstemon::sketch::{Stroke, StrokePoint, Tool};
use rayon::prelude::*;
use std::sync::Arc;

type Line = Vec<Vec2>;
/// A hand: what it makes of the lines of a drawing with this diagonal.
type Hand = fn(&[Line], f32) -> Vec<Line>;

/// Of so many drawings each hand draws one.
const EVERY: usize = 4;

/// Hands, and how many of the drawings that they draw keep their habit: fewer is a step back.
const HANDS: [(&str, Hand, usize); 12] = [
    ("split", split, 40),
    ("lifted", lifted, 35),
    ("short", short, 34),
    ("reversed", reversed, 42),
    ("restated", restated, 40),
    ("feathered", feathered, 37),
    ("twice", twice, 40),
    ("bent", |lines, diagonal| bent(lines, diagonal, 1), 41),
    ("bent otherwise", |lines, diagonal| bent(lines, diagonal, 2), 41),
    ("wide", |lines, _| scaled(lines, Vec2::new(1.35, 1.0)), 42),
    ("tall", |lines, _| scaled(lines, Vec2::new(1.0, 1.35)), 43),
    ("moved", moved, 41),
];

#[test]
fn drawings_keep_their_habits_in_other_hands() {
    let shares = [Share::Development, Share::Opened, Share::Added];
    let all: Vec<Drawing> = shares.iter().flat_map(|share| drawings(*share).unwrap()).collect();
    let drawn = |drawing: &Drawing| -> Vec<Line> {
        let places = |stroke: &Arc<Stroke>| stroke.points.iter().map(|p| p.position).collect();
        drawing.sketch.strokes.iter().map(places).collect()
    };
    let known: Vec<(Vec<Line>, Habit)> =
        all.par_iter().map(drawn).filter_map(|lines| habit(&lines).map(|habit| (lines, habit))).collect();
    let mut lost = Vec::new();
    for (number, (name, hand, least)) in HANDS.into_iter().enumerate() {
        // All would take minutes without optimisation; each hand draws others.
        let own: Vec<_> = known.iter().skip(number % EVERY).step_by(EVERY).collect();
        let keeps = |(lines, was): &&&(Vec<Line>, Habit)| habit(&hand(lines, diagonal(lines))) == Some(*was);
        let kept = own.par_iter().filter(keeps).count();
        if kept < least {
            lost.push(format!("{name}: {kept} of {}, {least} before", own.len()));
        }
    }
    assert!(lost.is_empty(), "{lost:#?}");
}

/// What plant lines are read as.
fn habit(lines: &[Line]) -> Option<Habit> {
    let stroke = |(id, line): (usize, &Line)| {
        let points = line.iter().copied().map(StrokePoint::at).collect();
        Arc::new(Stroke { id: id as u64 + 1, tool: Tool::Auto, points, brush: None })
    };
    let strokes: Vec<_> = lines.iter().enumerate().map(stroke).collect();
    conventions::interpret(&strokes, &ConventionParams::default()).habit
}

fn diagonal(lines: &[Line]) -> f32 {
    let places = || lines.iter().flatten().copied();
    places().fold(Vec2::INFINITY, Vec2::min).distance(places().fold(Vec2::NEG_INFINITY, Vec2::max))
}

fn length(line: &[Vec2]) -> f32 {
    line.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
}

/// The same line at steps of about 4 pixels.
fn even(line: &[Vec2]) -> Line {
    let mut even = vec![line[0]];
    for pair in line.windows(2) {
        let count = (pair[0].distance(pair[1]) / 4.0).round().max(1.0) as usize;
        even.extend((1..=count).map(|k| pair[0].lerp(pair[1], k as f32 / count as f32)));
    }
    even
}

/// The part of a line between two shares of its length.
fn part(line: &[Vec2], from: f32, to: f32) -> Line {
    let whole = length(line);
    let (mut at, mut part) = (0.0, Vec::new());
    for (k, place) in line.iter().enumerate() {
        at += if k > 0 { line[k - 1].distance(*place) } else { 0.0 };
        if at >= from * whole && at <= to * whole {
            part.push(*place);
        }
    }
    if part.len() > 1 { part } else { line.to_vec() }
}

/// A number from -1 to 1 for another.
fn noise(number: usize) -> f32 {
    (mix(number as u32) >> 8) as f32 / (1 << 23) as f32 - 1.0
}

/// The same line drawn again: it strays slowly by up to `most` pixels to each side.
fn again(line: &[Vec2], seed: usize, most: f32, wave: f32) -> Line {
    let value = |k: usize, side: usize| noise((seed * 131 + k) * 2 + side);
    let (mut at, mut strayed) = (0.0, Vec::new());
    for (i, place) in line.iter().enumerate() {
        at += if i > 0 { line[i - 1].distance(*place) / wave } else { 0.0 };
        let (k, share) = (at as usize, at.fract() * at.fract() * (3.0 - 2.0 * at.fract()));
        let stray = |side: usize| value(k, side) + (value(k + 1, side) - value(k, side)) * share;
        strayed.push(*place + most * Vec2::new(stray(0), stray(1)));
    }
    strayed
}

/// Long strokes in two, at their sharpest corner.
fn split(lines: &[Line], diagonal: f32) -> Vec<Line> {
    let two = |line: &Line| {
        if length(line) < 0.4 * diagonal || line.len() < 9 {
            return vec![line.clone()];
        }
        let turn = |k: &usize| (line[*k] - line[k - 3]).angle_to(line[k + 3] - line[*k]).abs();
        let corner = (3..line.len() - 3).max_by(|a, b| turn(a).total_cmp(&turn(b))).unwrap();
        vec![line[..=corner].to_vec(), line[corner..].to_vec()]
    };
    lines.iter().flat_map(two).collect()
}

/// Long strokes in two with a gap between them.
fn lifted(lines: &[Line], diagonal: f32) -> Vec<Line> {
    let two = |(seed, line): (usize, &Line)| {
        let length = length(line);
        if length < 0.4 * diagonal {
            return vec![line.clone()];
        }
        let (at, gap) = (0.4 + 0.05 * (seed % 5) as f32, 0.006 * diagonal / length);
        vec![part(&even(line), 0.0, at - gap), part(&even(line), at + gap, 1.0)]
    };
    lines.iter().enumerate().flat_map(two).collect()
}

/// Strokes that begin late and end early.
fn short(lines: &[Line], diagonal: f32) -> Vec<Line> {
    let cut = |line: &Line| {
        let share = 0.025 * diagonal / length(line).max(f32::MIN_POSITIVE);
        if share < 0.16 { part(line, share, 1.0 - share) } else { line.clone() }
    };
    lines.iter().map(cut).collect()
}

/// Strokes from their ends to their beginnings, the last first.
fn reversed(lines: &[Line], _: f32) -> Vec<Line> {
    lines.iter().rev().map(|line| line.iter().rev().copied().collect()).collect()
}

/// Strokes drawn twice.
fn restated(lines: &[Line], diagonal: f32) -> Vec<Line> {
    let both = |(seed, line): (usize, &Line)| {
        let again = again(line, seed, 0.007 * diagonal, 0.15 * diagonal);
        if length(line) > 0.15 * diagonal { vec![line.clone(), again] } else { vec![line.clone()] }
    };
    lines.iter().enumerate().flat_map(both).collect()
}

/// Long strokes as three pieces that overlap.
fn feathered(lines: &[Line], diagonal: f32) -> Vec<Line> {
    let three = |(seed, line): (usize, &Line)| {
        if length(line) < 0.4 * diagonal {
            return vec![line.clone()];
        }
        let piece = |(k, (from, to)): (usize, (f32, f32))| {
            again(&part(&even(line), from, to), 3 * seed + k, 0.004 * diagonal, 0.15 * diagonal)
        };
        [(0.0, 0.4), (0.3, 0.7), (0.6, 1.0)].into_iter().enumerate().map(piece).collect()
    };
    lines.iter().enumerate().flat_map(three).collect()
}

/// Closed strokes gone round twice.
fn twice(lines: &[Line], diagonal: f32) -> Vec<Line> {
    let round = |(seed, line): (usize, &Line)| {
        let gap = line[0].distance(line[line.len() - 1]);
        let is_closed = gap < 0.06 * length(line) && length(line) > 0.15 * diagonal;
        let second = again(line, seed, 0.007 * diagonal, 0.15 * diagonal);
        if is_closed { [line.clone(), second].concat() } else { line.clone() }
    };
    lines.iter().enumerate().map(round).collect()
}

/// All lines along slow waves, up to a twentieth of the diagonal.
fn bent(lines: &[Line], diagonal: f32, seed: usize) -> Vec<Line> {
    let wave = |k: usize, along: Vec2| {
        let per_pixel = std::f32::consts::TAU / diagonal * (1.2 + 0.4 * noise(100 * seed + 3 * k));
        let direction = Vec2::from_angle(3.0 * noise(100 * seed + 3 * k + 1));
        (per_pixel * direction.dot(along) + 3.0 * noise(100 * seed + 3 * k + 2)).sin()
    };
    let place = |p: &Vec2| {
        let away = Vec2::new(wave(0, *p) + wave(1, *p), wave(2, *p) + wave(3, *p));
        *p + 0.025 * diagonal * away
    };
    lines.iter().map(|line| line.iter().map(place).collect()).collect()
}

/// The whole wider or higher.
fn scaled(lines: &[Line], scale: Vec2) -> Vec<Line> {
    lines.iter().map(|line| line.iter().map(|p| *p * scale).collect()).collect()
}

/// Strokes a little beside where they were.
fn moved(lines: &[Line], diagonal: f32) -> Vec<Line> {
    let away = |i: usize| 0.02 * diagonal * Vec2::new(noise(2 * i + 1), noise(2 * i + 2));
    lines.iter().enumerate().map(|(i, line)| line.iter().map(|p| *p + away(i)).collect()).collect()
}
