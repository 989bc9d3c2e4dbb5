//! Stems that rise from a pot, with all that grows along them: leaves as outlines, as loops or spurs in the stem's own stroke, as lines.
//!
//! A stem is nearly straight and upright, without the loops and [`spurs`](super::spurs) in its stroke, and has its foot in the mouth of
//! the pot. A leaf is an outline that comes near a stem at one end, or a line that ends at a stem: on a potted plant a short line is
//! a leaf that nobody gave a second edge, and it gets one. A line that passes a stem is a leaf on either side. It is a plant if that is
//! nearly all of it and the leaves' roots lie along the stems; leaves from one place are fronds or grass.
//!
//! Limits: leaves on twigs; a line that carries something stays as it is, and then so does the plant.

use super::spurs;
use crate::anatomy::conventions::flowers::corolla_on_stem::petals_on_stem;
use crate::anatomy::conventions::flowers::rays::blade;
use crate::anatomy::conventions::page::{Line, Page, even};
use crate::anatomy::conventions::shapes::lobes;
use crate::anatomy::conventions::shapes::loops::{is_leaf, taken_apart};
use crate::anatomy::conventions::{Hypothesis, Made};
use crate::geom::polyline;
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Most lines of a plant.
const MOST: usize = 40;
/// Least share of points of a loop in the stroke of a stem: small ones are looked for where large ones leave no stem.
const LOOPS: [f32; 2] = [0.1, 0.06];
/// How far above the rim and below it a stem begins, as shares of the pot's height.
const FOOT: (f32, f32) = (0.35, 0.7);
/// Least chord of a stem over its length, least rise over its run, least height, as a share of the plant's, and most stems.
const STRAIGHT: f32 = 0.7;
const UPRIGHT: f32 = 1.0;
const LONG: f32 = 0.35;
const STEMS: usize = 5;
/// Largest opening of the outline of a leaf, and how near its root is to a stem, as a share of its size.
const OPEN: f32 = 0.42;
const AT: f32 = 0.3;
/// Leaves at the end of a stem that are petals: how many, and the share of the stem from which they are there.
const PETALS: (usize, f32) = (4, 0.9);
/// Least area of a round head at the end of a stem, over the square of its length: a circle has 0.08.
const ROUND: f32 = 0.072;
/// Least distance of a leaf's tip from its root, as a share of its size: it does not lie along the stem.
const REACH: f32 = 0.6;
/// Least chord of a line that is a leaf over its length, how near its root is to a stem, longest as a share of the stem, and half of its
/// width, as a share of its length.
const BENT: f32 = 0.75;
const AT_END: f32 = 0.3;
const SHORT: f32 = 0.8;
const HALF: f32 = 0.13;
/// Share of a line that may go on beyond a stem from which it goes to the other side.
const BEYOND: f32 = 0.3;
/// Places along a stem at which such leaves begin, and points of one.
const ALONG: usize = 101;
const POINTS: usize = 14;
/// Fewest leaves, least share of what is drawn that the plant is, and least distance of the outer roots along a stem, as a share of its
/// length.
const FEWEST: usize = 2;
const EXPLAINED: f32 = 0.85;
const SPREAD: f32 = 0.15;
/// Log-odds where two leaves at least were drawn with both edges, where not, and for each leaf up to so many.
const SCORE: (f32, f32, f32, usize) = (4.7, 2.6, 0.1, 8);

/// Proposes the plant in a pot that was proposed.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let pot = out.iter().find(|other| other.reading == Reading::Pot);
    let plant = pot.and_then(|pot| pot.solids.first()).and_then(|pot| plant(page, pot.bounds()));
    out.extend(plant);
}

/// A stem, from its foot to its top, and the leaves in its stroke.
struct Stem {
    number: usize,
    way: Vec<Vec2>,
    loops: Vec<Vec<Vec2>>,
    spurs: Vec<Vec<Vec2>>,
}

impl Stem {
    fn new(page: &Page, number: usize, (low, high): (Vec2, Vec2), height: f32) -> Option<Self> {
        LOOPS
            .into_iter()
            .find_map(|share| Self::with_loops(&page.lines[number], number, share, (low, high), height))
    }

    fn with_loops(
        line: &Line,
        number: usize,
        share: f32,
        (low, high): (Vec2, Vec2),
        height: f32,
    ) -> Option<Self> {
        let (loops, way) = taken_apart(line, share);
        let (spurs, mut way) = spurs::cut(&way);
        let (first, last) = (*way.first()?, *way.last()?);
        if first.y < last.y {
            way.reverse();
        }
        let (foot, run) = (way[0], way[way.len() - 1] - way[0]);
        let size = high.y - low.y;
        let stands = foot.x > low.x
            && foot.x < high.x
            && foot.y > low.y - FOOT.0 * size
            && foot.y < low.y + FOOT.1 * size;
        let is_stem = run.length() > STRAIGHT * polyline::length(&way)
            && -run.y > UPRIGHT * run.x.abs()
            && -run.y > LONG * height;
        (stands && is_stem).then_some(Self { number, way, loops, spurs })
    }

    /// Distance from a place, and how far up the nearest point of the stem is, as a share of its length.
    fn nearest(&self, p: Vec2) -> (f32, f32) {
        let length = polyline::length(&self.way).max(f32::MIN_POSITIVE);
        polyline::nearest(&self.way, p).map_or((f32::INFINITY, 0.0), |(gap, along)| (gap, along / length))
    }

    /// The place so far up, as a share of its length.
    fn at(&self, share: f32) -> Vec2 {
        even(&self.way, ALONG)[(share * (ALONG - 1) as f32).round() as usize]
    }

    fn length(&self) -> f32 {
        polyline::length(&self.way)
    }
}

/// Leaves with their roots, as shares of a stem's length.
#[derive(Default)]
struct Leaves {
    parts: Vec<Made>,
    roots: Vec<f32>,
    /// How many were drawn with both edges.
    whole: usize,
    /// Whether one of these is at the end of a stem and round, or shows petals.
    has_head: bool,
}

impl Leaves {
    fn add_whole(&mut self, outline: &[Vec2], root: Vec2, share: f32) {
        self.parts.push(Made::new(Tool::Leaf, lobes::rooted(outline, root)));
        self.roots.push(share);
        self.whole += 1;
    }

    fn add_line(&mut self, from_root: &[Vec2], share: f32) {
        let way = even(from_root, POINTS);
        self.parts.push(Made::new(Tool::Leaf, blade(&way, HALF * polyline::length(&way))));
        self.roots.push(share);
    }

    /// Whether several of them gather at the end of a stem, or one is a round head there.
    fn are_petals(&self) -> bool {
        self.has_head || self.roots.iter().filter(|root| **root > PETALS.1).count() >= PETALS.0
    }

    /// Distance of the outer roots, as a share of a stem.
    fn spread(&self) -> f32 {
        let least = self.roots.iter().copied().fold(f32::INFINITY, f32::min);
        self.roots.iter().copied().fold(f32::NEG_INFINITY, f32::max) - least
    }
}

fn plant(page: &Page, pot: (Vec2, Vec2)) -> Option<Hypothesis> {
    let own: Vec<usize> = (0..page.lines.len()).filter(|i| !page.is_apart(*i)).collect();
    let top = own.iter().map(|i| page.lines[*i].bounds.0.y).fold(f32::INFINITY, f32::min);
    let height = pot.0.y - top;
    if own.len() > MOST || height <= 0.0 {
        return None;
    }
    let stems: Vec<Stem> = own.iter().filter_map(|i| Stem::new(page, *i, pot, height)).collect();
    if stems.is_empty() || stems.len() > STEMS {
        return None;
    }
    let mut leaves = Leaves::default();
    for stem in &stems {
        stem.loops.iter().for_each(|points| leaves.add_whole(points, points[0], stem.nearest(points[0]).1));
        stem.spurs.iter().for_each(|points| leaves.add_line(points, stem.nearest(points[0]).1));
    }
    let mut uses: Vec<usize> = stems.iter().map(|stem| stem.number).collect();
    let others = own.iter().copied().filter(|i| stems.iter().all(|stem| stem.number != *i));
    uses.extend(others.filter(|i| grows(page, *i, &stems, &mut leaves)));
    uses.sort_unstable();
    let length = |lines: &[usize]| lines.iter().map(|i| page.lines[*i].length).sum::<f32>();
    if leaves.roots.len() < FEWEST
        || leaves.spread() < SPREAD
        || leaves.are_petals()
        || length(&uses) < EXPLAINED * length(&own)
    {
        return None;
    }
    let certain = if leaves.whole >= FEWEST { SCORE.0 } else { SCORE.1 };
    let score = certain + SCORE.2 * leaves.roots.len().min(SCORE.3) as f32;
    let stems = stems.iter().map(|stem| Made::new(Tool::Branch, stem.way.iter().copied()));
    let parts = stems.chain(leaves.parts).collect();
    Some(Hypothesis { uses, score, parts, solids: Vec::new(), reading: Reading::Leaf, habit: None })
}

/// Whether a line is a leaf at one of the stems; then it is added to the leaves.
fn grows(page: &Page, number: usize, stems: &[Stem], leaves: &mut Leaves) -> bool {
    let line = &page.lines[number];
    let gap = |stem: &Stem| line.points.iter().map(|p| stem.nearest(*p).0).fold(f32::INFINITY, f32::min);
    let Some(stem) = stems.iter().min_by(|a, b| gap(a).total_cmp(&gap(b))) else { return false };
    let away = |i: &usize| stem.nearest(line.points[*i]).0;
    let Some(root) = (0..line.points.len()).min_by(|a, b| away(a).total_cmp(&away(b))) else { return false };
    let (place, share) = (line.points[root], stem.nearest(line.points[root]).1);
    let size = line.size().length();
    if line.openness < OPEN && is_leaf(&line.points) {
        let reach = line.points.iter().map(|p| p.distance(place)).fold(0.0, f32::max);
        let is_leaf = away(&root) < AT * size && reach > REACH * size;
        let is_round = line.area > ROUND * line.length * line.length;
        let has_petals = || petals_on_stem(line, stem.way[stem.way.len() - 1]).is_some();
        leaves.has_head |= is_leaf && share > PETALS.1 && (is_round || has_petals());
        if is_leaf {
            let mut around = line.points.clone();
            around.rotate_left(root);
            leaves.add_whole(&around, place, share);
        }
        return is_leaf;
    }
    let sides = sides(line, stem, root);
    let are_leaves = !sides.is_empty() && sides.iter().all(|side| is_line_leaf(side, stem));
    if are_leaves {
        for side in sides {
            let joined: Vec<Vec2> = std::iter::once(stem.at(share)).chain(side).collect();
            leaves.add_line(&joined, share);
        }
    }
    are_leaves
}

/// A line from its end at a stem, or in two from where it passes the stem.
fn sides(line: &Line, stem: &Stem, root: usize) -> Vec<Vec<Vec2>> {
    let points = &line.points;
    let at = AT_END * line.length;
    let (first, last) = line.ends();
    let inner = (root as f32 / (points.len() - 1) as f32).min(1.0 - root as f32 / (points.len() - 1) as f32);
    if inner < BEYOND && stem.nearest(first).0.min(stem.nearest(last).0) < at {
        let from_root = stem.nearest(first).0 <= stem.nearest(last).0;
        let way = if from_root { points.clone() } else { points.iter().rev().copied().collect() };
        return vec![way];
    }
    if stem.nearest(points[root]).0 > at {
        return Vec::new();
    }
    let ways = [points[..=root].iter().rev().copied().collect::<Vec<_>>(), points[root..].to_vec()];
    let long = |way: &Vec<Vec2>| way.len() as f32 > BEYOND * points.len() as f32;
    ways.into_iter().filter(long).collect()
}

/// Whether a line from a stem is a leaf: it goes away from there, is nearly straight and shorter than the stem.
fn is_line_leaf(way: &[Vec2], stem: &Stem) -> bool {
    let tip = way[way.len() - 1];
    let (chord, length) = (way[0].distance(tip), polyline::length(way));
    chord > BENT * length && length < SHORT * stem.length() && stem.nearest(tip).0 > 0.3 * chord
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::beneath::pot;
    use crate::anatomy::conventions::line;

    /// What is read in a pot whose mouth is at a height of 0.
    fn read(plant: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        let body = line(&[(-40.0, 0.0), (-28.0, 60.0), (28.0, 60.0), (40.0, 0.0), (-40.0, 0.0)]);
        let mut page = Page::of_lines(&[plant, &[body]].concat());
        let mut all = Vec::new();
        pot::propose(&page, &mut all);
        page.set_apart(all.iter().flat_map(|pot| pot.uses.iter().copied()).collect());
        assert_eq!(all.len(), 1);
        propose(&page, &mut all);
        all.split_off(1)
    }

    fn stem() -> Vec<Vec2> {
        line(&[(0.0, 8.0), (3.0, -160.0)])
    }

    fn leaf(root: (f32, f32), side: f32) -> Vec<Vec2> {
        let (x, y) = root;
        line(&[
            (x, y),
            (x + 10.0 * side, y - 22.0),
            (x + 38.0 * side, y - 30.0),
            (x + 28.0 * side, y - 8.0),
            (x, y),
        ])
    }

    fn count(plant: &Hypothesis, tool: Tool) -> usize {
        plant.parts.iter().filter(|part| part.tool == tool).count()
    }

    #[test]
    fn outlines_and_lines_along_a_stem_are_its_leaves() {
        let twig = line(&[(2.0, -100.0), (30.0, -135.0)]);
        let passing = line(&[(-35.0, -80.0), (1.0, -60.0), (36.0, -82.0)]);
        let found = read(&[stem(), leaf((3.0, -30.0), 1.0), leaf((-6.0, -130.0), -1.0), twig, passing]);
        assert_eq!(found.len(), 1);
        assert_eq!((count(&found[0], Tool::Branch), count(&found[0], Tool::Leaf)), (1, 5));
        assert_eq!(found[0].uses, [0, 1, 2, 3, 4]);
    }

    #[test]
    fn stem_and_leaves_may_be_one_stroke() {
        let mut loops = line(&[(0.0, 8.0), (0.0, -50.0)]);
        loops.extend(leaf((0.0, -50.0), 1.0));
        loops.extend(line(&[(0.0, -50.0), (0.0, -100.0)]));
        loops.extend(leaf((0.0, -100.0), -1.0));
        loops.extend(line(&[(0.0, -100.0), (0.0, -150.0)]));
        let spurs = line(&[
            (0.0, 8.0),
            (0.0, -50.0),
            (35.0, -80.0),
            (0.0, -52.0),
            (0.0, -100.0),
            (-35.0, -130.0),
            (0.0, -102.0),
            (0.0, -160.0),
        ]);
        for (drawn, certain) in [(loops, SCORE.0), (spurs, SCORE.1)] {
            let found = read(&[drawn]);
            assert_eq!(found.iter().map(|plant| count(plant, Tool::Leaf)).collect::<Vec<_>>(), [2]);
            assert!((found[0].score - certain - 2.0 * SCORE.2).abs() < 1e-3, "{}", found[0].score);
        }
    }

    #[test]
    fn a_round_head_rays_and_leaves_from_one_place_are_left_to_others() {
        let ring = (0..=40).map(|k| Vec2::new(3.0, -185.0) + 25.0 * Vec2::from_angle(0.157 * k as f32));
        assert!(read(&[stem(), leaf((3.0, -30.0), 1.0), ring.collect()]).is_empty());
        let ray = |turn: f32| {
            let way = 25.0 * Vec2::from_angle(turn);
            vec![Vec2::new(3.0, -158.0) - way, Vec2::new(3.0, -158.0) + way]
        };
        assert!(read(&[stem(), leaf((3.0, -30.0), 1.0), ray(0.2), ray(1.0), ray(2.0)]).is_empty());
        let from = |side: f32| leaf((2.0, -100.0), side);
        assert!(read(&[stem(), from(1.0), from(-1.0)]).is_empty());
    }
}
