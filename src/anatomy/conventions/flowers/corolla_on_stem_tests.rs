//! Tests of flowers without a drawn centre, on a stem or not.

use super::*;
use crate::anatomy::conventions::line;

fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
    crate::anatomy::conventions::read_by(propose, lines)
}

/// Six lobes around (0, 0), the stroke begun at their foot.
fn head() -> Vec<Vec2> {
    let place = |k: usize| {
        let angle = TAU * k as f32 / 200.0;
        (30.0 + 25.0 * (3.0 * angle).sin().abs()) * Vec2::new(-angle.sin(), angle.cos())
    };
    (0..=200).map(place).collect()
}

/// A cup with three teeth on (0, 60).
fn tulip() -> Vec<Vec2> {
    line(&[
        (0.0, 60.0),
        (-35.0, 40.0),
        (-40.0, -50.0),
        (-20.0, -10.0),
        (0.0, -50.0),
        (20.0, -10.0),
        (40.0, -50.0),
        (35.0, 40.0),
        (2.0, 60.0),
    ])
}

#[test]
fn a_lobed_outline_on_a_line_is_a_flower() {
    let found = read(&[line(&[(0.0, 200.0), (3.0, 35.0)]), head()]);
    let [flower] = &found[..] else { panic!("{} corollas", found.len()) };
    assert_eq!((flower.parts.len(), &flower.uses[..]), (6, &[1][..]));
    assert!(
        flower
            .parts
            .iter()
            .all(|petal| petal.tool == Tool::Petal && petal.points[0].position.length() < 10.0)
    );
}

#[test]
fn stem_and_corolla_may_be_one_stroke() {
    let mut drawn = line(&[(0.0, 200.0)]);
    drawn.extend(head());
    let found = read(&[drawn]);
    let count = |tool: Tool| found[0].parts.iter().filter(|part| part.tool == tool).count();
    assert_eq!((found.len(), count(Tool::Branch), count(Tool::Petal)), (1, 1, 6));
}

#[test]
fn a_tulip_has_its_petals_from_the_stem() {
    let found = read(&[tulip(), line(&[(0.0, 62.0), (0.0, 250.0)])]);
    assert_eq!(found[0].parts.len(), 5, "three tips, and two petals in front");
    assert!(
        found[0].parts.iter().all(|petal| petal.points[0].position.distance(Vec2::new(0.0, 60.0)) < 12.0)
    );
}

#[test]
fn a_stem_may_have_two_sides_if_it_is_slender() {
    let side = |x: f32, foot: f32| line(&[(x, foot), (x, 35.0)]);
    let found = read(&[head(), side(-10.0, 220.0), side(10.0, 220.0)]);
    let stem = found[0].parts.last().unwrap();
    assert_eq!((found[0].uses.len(), stem.tool), (3, Tool::Branch));
    assert!((stem.half_width.unwrap() - 10.0).abs() < 0.5);
    assert!(stem.points.iter().all(|p| p.position.x.abs() < 0.5));
    assert!(read(&[head(), side(-25.0, 220.0), side(25.0, 220.0)]).is_empty(), "a trunk");
    assert!(read(&[head(), side(-10.0, 120.0), side(10.0, 120.0)]).is_empty(), "a short trunk");
}

#[test]
fn without_a_stem_only_what_is_cut_deep_and_even_is_a_flower() {
    let lobed = |depth: f32| -> Vec<Vec2> {
        head().into_iter().map(|p| p.normalize() * (55.0 + depth * (p.length() - 55.0))).collect()
    };
    let found = read(&[lobed(1.3)]);
    assert_eq!((found.len(), found[0].parts.len()), (1, 6));
    assert!(read(&[lobed(0.5)]).is_empty(), "a crown");
    let mut uneven = lobed(1.3);
    uneven.iter_mut().filter(|p| p.y > 0.0).for_each(|p| p.y *= 2.2);
    assert!(read(&[uneven]).is_empty(), "a cactus");
}

#[test]
fn deep_notches_on_one_line_say_more_than_a_crown_does_unless_they_overlap() {
    let deep = |depth: f32| -> Vec<Vec2> {
        head().into_iter().map(|p| p.normalize() * (55.0 + depth * (p.length() - 55.0))).collect()
    };
    let score = |head: Vec<Vec2>| read(&[head, line(&[(0.0, 200.0), (3.0, 35.0)])])[0].score;
    assert!(score(deep(1.5)) > 4.3 && score(deep(0.6)) < 4.3);
    let petals = |turn: f32| -> Vec<Vec<Vec2>> {
        let petal = |k: usize| {
            head()[33 * k..33 * (k + 1)].iter().map(|p| Vec2::from_angle(turn).rotate(*p)).collect()
        };
        (0..6).map(petal).collect()
    };
    assert!(overlap(&petals(0.0), Vec2::ZERO) < OVERLAP);
    let twice = [petals(0.0), petals(0.4)].concat();
    assert!(overlap(&twice, Vec2::ZERO) > OVERLAP, "lobes that lie over one another");
}

#[test]
fn loops_that_begin_and_end_at_an_outline_are_petals_around_it() {
    let petal = |side: f32| {
        line(&[(side * 30.0, -20.0), (side * 120.0, -90.0), (side * 150.0, 0.0), (side * 40.0, 10.0)])
    };
    let stem = line(&[(0.0, 200.0), (3.0, 35.0)]);
    assert_eq!(read(&[head(), stem.clone(), petal(1.0)]).len(), 1, "one is a leaf");
    assert!(read(&[head(), stem, petal(1.0), petal(-1.0)]).is_empty());
}

#[test]
fn with_twigs_it_is_none() {
    let left = line(&[(-10.0, 200.0), (-10.0, 35.0)]);
    let twig = line(&[(0.0, 30.0), (5.0, -30.0)]);
    assert!(read(&[head(), left, twig]).is_empty());
}

#[test]
fn a_crown_has_shallow_lobes_or_a_short_trunk() {
    let middle = |depth: f32| {
        head().into_iter().map(|p| p.normalize() * (50.0 + depth * (p.length() - 30.0))).collect()
    };
    let stem = |foot: f32| line(&[(0.0, foot), (0.0, 40.0)]);
    assert_eq!(read(&[middle(1.0), stem(200.0)]).len(), 1);
    assert!(read(&[middle(0.3), stem(200.0)]).is_empty());
    assert!(read(&[middle(1.0), stem(90.0)]).is_empty());
}

#[test]
fn a_plain_outline_on_a_stem_is_none() {
    let disc: Vec<Vec2> = (0..=60).map(|k| 40.0 * Vec2::from_angle(TAU * k as f32 / 60.0)).collect();
    assert!(read(&[disc, line(&[(0.0, 200.0), (0.0, 40.0)])]).is_empty());
}

#[test]
fn the_rim_of_a_bowl_in_front_belongs_to_it_and_a_vein_speaks_against() {
    let with = |inner: &[(f32, f32)]| read(&[line(&[(0.0, 200.0), (0.0, 61.0)]), tulip(), line(inner)]);
    let rim = [(-38.0, -40.0), (-25.0, 0.0), (0.0, 12.0), (25.0, 0.0), (38.0, -40.0)];
    assert_eq!(with(&rim).first().map(|flower| flower.uses.clone()), Some(vec![1, 2]));
    assert!(with(&[(0.0, 50.0), (2.0, -35.0)]).is_empty());
}
