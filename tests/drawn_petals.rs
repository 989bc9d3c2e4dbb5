//! One drawn petal and a species with full flowers: all petals of the flower have the outline that was drawn.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use crate::drawings;
use glam::Vec2;
use penstemon::pipeline;
use penstemon::plant::{OrganKind, Shape};
use penstemon::sketch::{Sketch, Tool};
use std::path::Path;

/// A pointed petal with a lobe on one side only, from its foot at the origin toward +y, of length 1.
fn petal() -> Vec<Vec2> {
    let half = |t: f32| 0.25 * (std::f32::consts::PI * t.powf(1.3)).sin().max(0.0);
    let lobe = |t: f32| 0.12 * (-((t - 0.4) / 0.12).powi(2)).exp();
    let there = (0..=60).map(|k| k as f32 / 60.0).map(|t| Vec2::new(half(t) + lobe(t) * half(t) * 4.0, t));
    let back = (0..60).rev().map(|k| k as f32 / 60.0).map(|t| Vec2::new(-half(t), t));
    there.chain(back).collect()
}

/// A stem with that petal at its end, turned by an angle.
fn drawing(species: &str, angle: f32, petals: usize) -> Sketch {
    let top = Vec2::new(500.0, 300.0);
    let mut strokes = vec![(Tool::Branch, drawings::curve(Vec2::new(500.0, 700.0), top, 0.03))];
    for k in 0..petals {
        let turn = Vec2::from_angle(angle + 0.8 * k as f32);
        let on_sheet = |p: Vec2| top + turn.rotate(Vec2::new(p.x, -p.y) * 120.0);
        strokes.push((Tool::Petal, petal().into_iter().map(on_sheet).collect()));
    }
    Sketch { species: Some(species.to_owned()), ..drawings::sketch(strokes) }
}

/// Farthest that a point of one outline lies from another outline.
fn off(points: &[Vec2], outline: &[Vec2]) -> f32 {
    let to_side = |p: Vec2, (a, b): (Vec2, Vec2)| {
        let share = ((p - a).dot(b - a) / (b - a).length_squared().max(1e-12)).clamp(0.0, 1.0);
        p.distance(a.lerp(b, share))
    };
    let sides = || outline.iter().copied().zip(outline.iter().copied().cycle().skip(1));
    let nearest = |p: &Vec2| sides().map(|side| to_side(*p, side)).fold(f32::MAX, f32::min);
    points.iter().map(nearest).fold(0.0, f32::max)
}

/// An outline whose longest way from the foot goes up, of length 1.
fn upright(outline: &[Vec2]) -> Vec<Vec2> {
    let far =
        outline.iter().copied().fold(Vec2::ZERO, |far, p| if p.length() > far.length() { p } else { far });
    let turned = |p: &Vec2| far.perp().dot(*p) / far.length_squared();
    outline.iter().map(|p| Vec2::new(-turned(p), far.dot(*p) / far.length_squared())).collect()
}

#[test]
fn a_full_flower_has_the_outline_of_the_one_petal_that_was_drawn() {
    let drawn = upright(&petal());
    let mirrored: Vec<Vec2> = drawn.iter().map(|p| Vec2::new(-p.x, p.y)).collect();
    for (species, petals) in [("peony", 1), ("camellia", 1), ("rose", 2), ("lotus", 1)] {
        let sketch = drawing(species, 0.4, petals);
        let look = pipeline::species_of(&sketch, Path::new("")).unwrap();
        let params = pipeline::params_of(&sketch, &look, &[]).unwrap();
        let built = pipeline::build(&sketch, &look, &params);
        assert_eq!(built.plant.flowers.len(), 1, "{species}");
        let of_petals = built.plant.organs.iter().filter(|organ| organ.kind() == OrganKind::Petal);
        let mut count = 0;
        for organ in of_petals {
            let Shape::Blade(blade) = &organ.shape else { panic!("{species}: a petal is no blade") };
            let outline = upright(built.plant.templates[blade.template].outline());
            let apart = [&drawn, &mirrored].map(|drawn| off(drawn, &outline).max(off(&outline, drawn)));
            let apart = apart[0].min(apart[1]);
            assert!(apart < 0.04, "{species}: a petal's outline is {apart} of its length off the drawn one");
            count += 1;
        }
        assert!(count >= 12, "{species}: {count} petals");
    }
}
