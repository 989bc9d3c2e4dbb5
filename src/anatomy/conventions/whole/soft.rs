//! Plain flowers, leaves and grass.
//!
//! Limits: petals that have no notches between them are sectors of their head.

use super::plain::Plain;
use super::view::{self, View};
use crate::anatomy::conventions::flowers::corolla::{from_middle, is_round};
use crate::anatomy::conventions::page::Line;
use crate::anatomy::conventions::shapes::lobes::{self, Focus};
use crate::anatomy::conventions::tufts::grass::upright_blades;
use crate::anatomy::conventions::{Habit, Made};
use crate::geom::polyline;
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Half size of a centre that is not drawn, as a share of the head's.
const CENTRE: f32 = 0.2;
/// Fewest petals, and how many a head without notches is divided into.
const FEWEST: usize = 3;
const SECTORS: usize = 6;
/// Where the roots of petals are, in half sizes of the centre.
const ROOT: f32 = 0.15;
/// Fewest blades of grass.
const GRASS: usize = 3;
/// Least length of a leaf's stalk outside of its blade, as a share of the whole height.
const STALK: f32 = 0.1;

/// Most lines of a plain flower: more are a plant with many leaves.
const MOST_LINES: usize = 24;

/// A head of petals, on its stem if there is one.
pub(super) fn flower(view: &View) -> Option<Plain> {
    if view.own.len() > MOST_LINES {
        return None;
    }
    let stem = view.stalk();
    let head = stem.as_ref().map_or_else(|| view.all(), |stem| view.above(stem));
    let mut outline = view::outline(&head)?;
    let (low, high) = polyline::bounds(outline.iter().copied());
    let middle = low.midpoint(high);
    let is_in_head = |line: &&&Line| line.bounds.0.cmpge(low).all() && line.bounds.1.cmple(high).all();
    let to_middle = |line: &&&Line| line.middle().distance(middle);
    let centre = view.lines.iter().filter(is_in_head).filter(|line| is_round(line));
    let centre = centre.filter(|line| line.size().cmplt(0.7 * (high - low)).all());
    let centre = centre.min_by(|a, b| to_middle(a).total_cmp(&to_middle(b)));
    let focus = match centre {
        Some(disc) => Focus { place: disc.middle(), half: 0.5 * disc.size() },
        None => Focus { place: middle, half: 0.5 * CENTRE * (high - low) },
    };
    outline.push(outline[0]);
    let mut petals = lobes::cut(&outline, &focus, true);
    if petals.len() < FEWEST {
        petals = outline.chunks(outline.len().div_ceil(SECTORS)).map(<[Vec2]>::to_vec).collect();
    }
    let root =
        |petal: &[Vec2]| focus.place + ROOT * focus.half.min_element() * lobes::direction(petal, focus.place);
    let mut parts: Vec<Made> =
        petals.iter().map(|petal| Made::new(Tool::Petal, lobes::rooted(petal, root(petal)))).collect();
    parts.extend(centre.map(|disc| Made::new(Tool::Auto, from_middle(&disc.hull, focus.place))));
    parts.extend(stem.as_ref().map(|stem| {
        let rows = stem.rows().iter().map(|row| row.0);
        Made::new(Tool::Branch, rows.chain([focus.place]))
    }));
    // Leaves beside the stem stay as they are.
    let is_leaf = |line: &Line| {
        stem.as_ref().is_some_and(|stem| line.bounds.0.y > stem.top) && line.is_closed_and_solid()
    };
    let uses = view.own.iter().copied().filter(|i| !is_leaf(&view.page.lines[*i])).collect();
    Some(Plain { uses, parts, reading: Reading::Corolla, habit: Some(Habit::Flower) })
}

/// One blade, with the stalk if one goes on outside of it.
pub(super) fn leaf(view: &View) -> Option<Plain> {
    if view.lines.len() == 1 && view.blades() > 0 {
        return None;
    }
    let stalk = view.stalk().filter(|stalk| stalk.height() > STALK * view.rows.height());
    let blade = stalk.as_ref().map_or_else(|| view.all(), |stalk| view.above(stalk));
    let mut outline = view::outline(&blade)?;
    let low = |p: &Vec2| p.y;
    let from = stalk.as_ref().map(|stalk| stalk.sill.0.midpoint(stalk.sill.1));
    let away = |p: &Vec2| from.map_or(-low(p), |from| p.distance(from));
    let root = (0..outline.len()).min_by(|a, b| away(&outline[*a]).total_cmp(&away(&outline[*b])))?;
    outline.rotate_left(root);
    let base = outline[0];
    outline.push(base);
    let mut parts = vec![Made::new(Tool::Leaf, outline)];
    parts.extend(
        stalk.map(|stalk| Made::new(Tool::Branch, stalk.rows().iter().map(|row| row.0).chain([base]))),
    );
    Some(Plain { uses: view.own.clone(), parts, reading: Reading::Leaf, habit: None })
}

/// Blades that stand on the ground: every tip of a line is one.
pub(super) fn grass(view: &View) -> Option<Plain> {
    let parts = upright_blades(&view.lines);
    let is_grass = parts.len() >= GRASS;
    is_grass.then(|| Plain {
        uses: view.own.clone(),
        parts,
        reading: Reading::Grass,
        habit: Some(Habit::Grass),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;
    use crate::anatomy::conventions::page::Page;
    use std::f32::consts::TAU;

    fn read(read: fn(&View) -> Option<Plain>, lines: &[Vec<Vec2>]) -> Option<Plain> {
        let page = Page::of_lines(lines);
        View::of(&page, (0..page.lines.len()).collect()).and_then(|view| read(&view))
    }

    /// A head of five lobes that is open, on a stem.
    fn flower_in_two_strokes() -> Vec<Vec<Vec2>> {
        let place = |k: usize| {
            let angle = TAU * (0.03 + 0.94 * k as f32 / 150.0);
            let reach = 30.0 + 30.0 * (2.5 * angle).sin().abs();
            Vec2::new(0.0, -180.0) + reach * Vec2::from_angle(angle)
        };
        vec![(0..=150).map(place).collect(), line(&[(0.0, -140.0), (6.0, 0.0)])]
    }

    fn count(plain: &Plain, tool: Tool) -> usize {
        plain.parts.iter().filter(|part| part.tool == tool).count()
    }

    #[test]
    fn a_head_of_lobes_is_as_many_petals_and_one_without_is_divided() {
        let flower = read(flower, &flower_in_two_strokes()).unwrap();
        assert!((4..=5).contains(&count(&flower, Tool::Petal)), "the lowest may go with the stem");
        assert_eq!(count(&flower, Tool::Branch), 1);
        let disc = (0..=60).map(|k| Vec2::new(0.0, -180.0) + 40.0 * Vec2::from_angle(TAU * k as f32 / 60.0));
        let plain = read(super::flower, &[disc.collect(), line(&[(0.0, -140.0), (6.0, 0.0)])]).unwrap();
        assert_eq!(count(&plain, Tool::Petal), SECTORS);
    }

    #[test]
    fn an_open_outline_on_a_line_is_a_leaf_on_its_stalk() {
        let side = |sign: f32| {
            (0..=20)
                .map(move |k| 0.05 * k as f32)
                .map(move |t| Vec2::new(sign * 150.0 * t * (1.0 - t), -60.0 - 120.0 * t))
        };
        let lines = [side(-1.0).collect(), side(1.0).skip(2).collect(), line(&[(0.0, -58.0), (3.0, 0.0)])];
        let leaf = read(leaf, &lines).unwrap();
        assert_eq!((count(&leaf, Tool::Leaf), count(&leaf, Tool::Branch)), (1, 1));
    }

    #[test]
    fn ticks_are_blades_of_grass_and_two_are_too_few() {
        let ticks: Vec<Vec<Vec2>> =
            [0.0, 30.0, 55.0, 90.0].iter().map(|x| line(&[(*x, 0.0), (x + 6.0, -40.0)])).collect();
        assert_eq!(read(grass, &ticks).unwrap().parts.len(), 4);
        assert!(read(grass, &ticks[..2]).is_none());
    }
}
