//! Ground lines: a long level line, low in the drawing, with everything else above it, or on which several plants stand.
//!
//! What speaks for the ground is that the line is nearly straight and level, spans most of the drawing and lies in its lower part
//! with nothing below. If plants stand on it side by side, it may roll, lie higher, and pass behind their stems, as the
//! ground of a garden does; one plant is enough where it lies low. The outline of a bed, wider than high, is the ground as well if
//! several stems that carry something stand in it side by side. It becomes no part of the plant. Limits: ground drawn
//! as one high hill, in pieces, or as grass is not found here (for grass see [`grass`](super::grass)).

use crate::anatomy::conventions::Hypothesis;
use crate::anatomy::conventions::flowers::upright::{feet_within, upright};
use crate::anatomy::conventions::page::{Line, Page};
use crate::anatomy::conventions::plants::{self, Plant};
use crate::sketch::Reading;

/// Least distance between the ends of a ground line, as a share of its length.
const STRAIGHT: f32 = 0.9;
/// Largest height, as a share of its width.
const LEVEL: f32 = 0.2;
/// Least width, as a share of the drawing's.
const WIDE: f32 = 0.6;
/// Lowest part of the drawing in which it lies, and how far anything may reach below it, as shares of the drawing's height.
const LOW: (f32, f32) = (0.35, 0.12);
/// Least height of a drawing, as a share of its width: a level line alone is a branch that lies.
const HIGH: f32 = 0.18;
/// The first two for ground on which plants stand.
const ROLLING: (f32, f32) = (0.8, 0.25);
/// Fewest plants on ground that rolls or lies high, their greatest width as a share of the ground's, and the least share of
/// all other lines' length that is theirs.
const PLANTS: usize = 2;
const NARROW: f32 = 0.5;
const MOST: f32 = 0.8;
/// Of the outline of a bed: largest opening, least share of its hull that it encloses, least width over its height and as a share of
/// the drawing's, and least distance between the outer stems in it, as a share of its width.
const BED: (f32, f32, f32, f32, f32) = (0.3, 0.75, 1.3, 0.5, 0.25);
/// What each stem in it adds to the log-odds of a bed, and how many are counted.
const EACH: f32 = 1.0;
const MOST_FEET: usize = 6;
/// Log-odds of a ground line.
const SCORE: f32 = 2.0;

/// Proposes lines that are the ground.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let lines = || (0..page.lines.len()).filter(|i| !page.is_apart(*i));
    let height = |i: &usize| page.lines[*i].middle().y;
    let lowest = lines().filter(|i| is_ground(page, &page.lines[*i]));
    let lowest = lowest.max_by(|a, b| height(a).total_cmp(&height(b)));
    let widest = lines().max_by(|a, b| page.lines[*a].size().x.total_cmp(&page.lines[*b].size().x));
    let ground = lowest.or(widest.filter(|i| carries_a_garden(page, *i))).map(|line| (line, SCORE));
    out.extend(
        ground
            .or_else(|| bed(page, lines()))
            .map(|(line, score)| Hypothesis::apart(vec![line], score, Reading::Ground)),
    );
}

/// The first of these lines that is the outline of a bed, wider than high, in which several stems stand side by side, and its log-odds.
fn bed(page: &Page, lines: impl Iterator<Item = usize>) -> Option<(usize, f32)> {
    let mut outlines = lines.filter(|i| is_outline_of_bed(page, &page.lines[*i])).peekable();
    outlines.peek()?;
    let stems = upright(page);
    outlines.find_map(|i| {
        let line = &page.lines[i];
        let (feet, spread) = feet_within(&stems, line.bounds);
        let stands = feet >= PLANTS && spread > BED.4 * line.size().x;
        stands.then(|| (i, SCORE + EACH * feet.min(MOST_FEET) as f32))
    })
}

/// Whether a line is closed, wider than high, and wide beside the drawing.
fn is_outline_of_bed(page: &Page, line: &Line) -> bool {
    let size = line.size();
    let is_of_form = line.openness < BED.0 && line.solidity() > BED.1 && size.x > BED.2 * size.y;
    is_of_form && size.x >= BED.3 * (page.bounds.1.x - page.bounds.0.x)
}

/// Whether a line is level and lies below all else that is drawn.
fn is_ground(page: &Page, line: &Line) -> bool {
    let whole = page.bounds.1 - page.bounds.0;
    is_level(page, line) && whole.y > HIGH * whole.x
}

/// Whether a line is level, wide and low.
fn is_level(page: &Page, line: &Line) -> bool {
    let whole = page.bounds.1 - page.bounds.0;
    let (begin, end) = line.ends();
    let size = line.size();
    let is_line = begin.distance(end) > STRAIGHT * line.length && size.y < LEVEL * size.x;
    let is_low = line.middle().y > page.bounds.1.y - LOW.0 * whole.y;
    let is_lowest = page.bounds.1.y - line.bounds.1.y < LOW.1 * whole.y;
    is_line && size.x > WIDE * whole.x && is_low && is_lowest
}

/// Whether plants stand side by side on a line that may roll.
fn carries_a_garden(page: &Page, number: usize) -> bool {
    let line = &page.lines[number];
    let size = line.size();
    let (begin, end) = line.ends();
    let is_wide = size.x > WIDE * (page.bounds.1.x - page.bounds.0.x);
    let rolls = begin.distance(end) > ROLLING.0 * line.length && size.y < ROLLING.1 * size.x;
    let fewest = if is_level(page, line) { 1 } else { PLANTS };
    is_wide && rolls && plants_on(page, number) >= fewest
}

/// How many plants stand on a line; none unless they are most of what else is drawn.
fn plants_on(page: &Page, number: usize) -> usize {
    let line = &page.lines[number];
    let length = |plant: &Plant| plant.lines.iter().map(|i| page.lines[*i].length).sum::<f32>();
    let all = plants::side_by_side(page, Some(number));
    let stands = |plant: &&Plant| {
        let size = plant.size();
        size.x < NARROW * line.size().x && size.y > 0.5 * size.x && plant.stands_on(line)
    };
    let on_it: Vec<&Plant> = all.iter().filter(stands).collect();
    let theirs: f32 = on_it.iter().map(|plant| length(plant)).sum();
    if theirs > MOST * all.iter().map(length).sum::<f32>() { on_it.len() } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;
    use glam::Vec2;

    fn read(lines: &[&[(f32, f32)]]) -> Vec<Vec<usize>> {
        let lines: Vec<Vec<Vec2>> = lines.iter().map(|places| line(places)).collect();
        crate::anatomy::conventions::read_as_drawn(propose, &lines)
            .into_iter()
            .map(|ground| ground.uses)
            .collect()
    }

    const STEM: [(f32, f32); 2] = [(50.0, 98.0), (52.0, 0.0)];
    const GROUND: [(f32, f32); 3] = [(0.0, 99.0), (50.0, 101.0), (100.0, 98.0)];

    #[test]
    fn a_level_line_below_everything_is_the_ground() {
        assert_eq!(read(&[&STEM, &GROUND]), [[1]]);
    }

    /// A stem with a head, its foot here.
    fn flower(x: f32, y: f32) -> [Vec<(f32, f32)>; 2] {
        let head = [(0.0, -60.0), (-20.0, -70.0), (0.0, -90.0), (20.0, -70.0), (0.0, -60.0)];
        [vec![(x, y), (x, y - 60.0)], head.map(|(dx, dy)| (x + dx, y + dy)).to_vec()]
    }

    fn rolling(y: f32) -> Vec<(f32, f32)> {
        (0..=80).map(|k| 10.0 * k as f32).map(|x| (x, y + 25.0 * (x / 110.0).sin())).collect()
    }

    fn read_all(lines: &[Vec<(f32, f32)>]) -> Vec<Vec<usize>> {
        read(&lines.iter().map(Vec::as_slice).collect::<Vec<_>>())
    }

    #[test]
    fn where_plants_stand_side_by_side_it_may_roll_and_pass_behind_them() {
        let [a, b] = [flower(120.0, 30.0), flower(500.0, 40.0)].map(|flower| flower.to_vec());
        assert_eq!(read_all(&[a.clone(), b.clone(), vec![rolling(0.0)]].concat()), [[4]]);
        assert_eq!(read_all(&[a.clone(), b.clone(), vec![rolling(-20.0)]].concat()), [[4]], "a horizon");
        assert!(read_all(&[a.clone(), vec![rolling(-20.0)]].concat()).is_empty(), "a branch with a leaf");
    }

    #[test]
    fn what_hangs_from_a_line_does_not_stand_on_it() {
        let hang =
            |x: f32| vec![vec![(x, 30.0), (x, 90.0)], vec![(x - 20.0, 90.0), (x, 130.0), (x + 20.0, 90.0)]];
        assert!(read_all(&[hang(100.0), hang(400.0), vec![rolling(0.0)]].concat()).is_empty());
    }

    #[test]
    fn a_wide_drawing_with_one_low_plant_has_level_ground() {
        let level = vec![(0.0, 2.0), (800.0, -4.0)];
        assert_eq!(read_all(&[flower(150.0, 0.0).to_vec(), vec![level]].concat()), [[2]]);
    }

    #[test]
    fn the_outline_of_a_bed_is_the_ground_but_not_that_of_a_leaf_or_a_pot() {
        let rectangle =
            |high: f32| vec![(-60.0, -high), (560.0, -high), (555.0, 60.0), (-55.0, 60.0), (-60.0, -high)];
        let row = [flower(60.0, 10.0), flower(250.0, 15.0), flower(440.0, 5.0)].concat();
        assert_eq!(read_all(&[row.clone(), vec![rectangle(30.0)]].concat()), [[6]], "they rise above it");
        assert_eq!(read_all(&[row, vec![rectangle(120.0)]].concat()), [[6]], "all of them in it");
        let veins = (0..4).map(|k| vec![(100.0 * k as f32, 20.0), (100.0 * k as f32 + 40.0, -30.0)]);
        assert!(read_all(&veins.chain([rectangle(60.0)]).collect::<Vec<_>>()).is_empty());
        assert!(read_all(&[flower(250.0, 15.0).to_vec(), vec![rectangle(30.0)]].concat()).is_empty());
    }

    #[test]
    fn branches_are_not() {
        assert!(read(&[&GROUND]).is_empty(), "alone it is a branch");
        let middle = GROUND.map(|(x, y)| (x, y - 50.0));
        assert!(read(&[&STEM, &middle]).is_empty(), "a branch crosses its stem");
        let steep = [(0.0, 100.0), (100.0, 70.0)];
        assert!(read(&[&STEM, &steep]).is_empty());
        let short = [(30.0, 99.0), (60.0, 99.0)];
        let wide = [(-50.0, 0.0), (150.0, 0.0)];
        assert!(read(&[&STEM, &short, &wide]).is_empty());
    }
}
