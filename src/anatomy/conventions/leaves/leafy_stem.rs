//! A twig: leaves, each an outline of its own, along a line.
//!
//! An outline is a leaf of a line if it comes near it at one place, its root, or along one edge, and lies on one side of it or beyond its end. Three at
//! least, whose roots are spread along the line, make a twig; several at its end are the petals of a flower and stay out of it.
//!
//! Limits: leaves with stalks of their own, leaves on side twigs.

use crate::anatomy::conventions::page::{Line, Page, median};
use crate::anatomy::conventions::shapes::lobes;
use crate::anatomy::conventions::{Hypothesis, Made};
use crate::geom::polyline;
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Least chord of a twig over its length.
const STRAIGHT: f32 = 0.75;
/// Largest leaf, as a share of its twig's length, how near its root is to the twig, and how far its tip is at least, as shares of its size.
const LARGE: f32 = 0.7;
const AT: f32 = 0.12;
const AWAY: f32 = 0.4;
/// Widest opening of an outline whose ends are at its twig, the least of its hull that it fills, and how near these ends are, as a share
/// of its size.
const OPEN: (f32, f32, f32) = (0.45, 0.8, 0.3);
/// How much of a twig on either side of a leaf's root gives its direction there: a hand trembles.
const AROUND: f32 = 0.05;
/// How much farther than its nearest point a leaf's points are that lie on the twig, as a share of its size.
const TOUCH: f32 = 0.1;
/// Least share of the rest of a leaf that lies on one side of its twig.
const ONE_SIDE: f32 = 0.75;
/// Share of a twig from which its end begins, and how far below the highest root in sizes of a leaf.
pub(super) const END: f32 = 0.92;
const TOP: f32 = 0.6;
/// Least of its hull that a leaf at the end fills.
const CONVEX: f32 = 0.9;
/// Most at its end that are no petals, where so many others are along it: an ear.
const EAR: (usize, usize) = (3, 4);
/// Fewest leaves, most, and how far apart the outer roots are at least, as a share of the twig.
const LEAVES: (usize, usize) = (3, 60);
const SPREAD: f32 = 0.3;
/// The same for so many leaves, in sizes of the middle one: an ear at the end of a long stem.
const DENSE: (usize, f32) = (6, 1.2);
/// Least share of what is drawn, or of what touches it, that the twig is: leaves on the stem of something else are read one by one.
const EXPLAINED: f32 = 0.85;
/// Log-odds, and more for each leaf up to so many.
const SCORE: (f32, f32, usize) = (4.0, 0.25, 12);

/// Proposes a twig for each line with leaves.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let is_twig = |i: &usize| {
        let line = &page.lines[*i];
        !page.is_apart(*i) && line.ends().0.distance(line.ends().1) > STRAIGHT * line.length
    };
    let twigs: Vec<usize> = (0..page.lines.len()).filter(is_twig).collect();
    let boxes: Vec<(Vec2, Vec2)> = twigs.iter().map(|i| page.lines[*i].bounds).collect();
    let grown = |(low, high): &(Vec2, Vec2)| {
        let margin = Vec2::splat(0.1 * low.distance(*high));
        (low - margin, high + margin)
    };
    let near = page.lines_at(&boxes.iter().map(grown).collect::<Vec<_>>());
    let wholes = wholes(page);
    out.extend(
        twigs.iter().zip(near).filter_map(|(twig, near)| of_line(page, (*twig, wholes[*twig]), &near)),
    );
}

/// For every line the length of all that touch it, directly or through others.
fn wholes(page: &Page) -> Vec<f32> {
    let mut wholes = vec![page.length; page.lines.len()];
    for group in &page.groups {
        let length = length(page, group);
        group.iter().for_each(|line| wholes[*line] = length);
    }
    wholes
}

/// Length of some lines together.
pub(super) fn length(page: &Page, lines: &[usize]) -> f32 {
    lines.iter().map(|line| page.lines[*line].length).sum()
}

/// The twig that a line is, of lines that are so long together.
fn of_line(page: &Page, (number, whole): (usize, f32), near: &[usize]) -> Option<Hypothesis> {
    if !(LEAVES.0..=LEAVES.1).contains(&near.len()) {
        return None;
    }
    let explain = |lines: &[usize]| length(page, lines) >= EXPLAINED * whole;
    let twig = &page.lines[number];
    let way = twig.upward();
    let mut leaves: Vec<Leaf> = near
        .iter()
        .filter(|i| **i != number)
        .filter_map(|i| Leaf::new(*i, &page.lines[*i], &way, twig.length))
        .collect();
    // A head with teeth at the end is a flower.
    leaves.retain(|leaf| leaf.share <= END || page.lines[leaf.line].solidity() > CONVEX);
    let mut sizes: Vec<f32> = leaves.iter().map(|leaf| page.lines[leaf.line].size().max_element()).collect();
    let size = if sizes.is_empty() { 0.0 } else { median(&mut sizes) };
    let last = leaves.iter().map(|leaf| leaf.share).fold(0.0, f32::max);
    let is_at_end = |leaf: &Leaf| leaf.share > END && (last - leaf.share) * twig.length < TOP * size;
    let at_end = leaves.iter().filter(|leaf| is_at_end(leaf)).count();
    let is_ear = at_end <= EAR.0 && leaves.len() - at_end >= EAR.1;
    if at_end > 1 && !is_ear {
        leaves.retain(|leaf| !is_at_end(leaf));
    }
    let shares = leaves.iter().map(|leaf| leaf.share);
    let (first, last) = shares.fold((f32::INFINITY, 0.0_f32), |(a, b), share| (a.min(share), b.max(share)));
    let is_dense = leaves.len() >= DENSE.0 && (last - first) * twig.length > DENSE.1 * size;
    if leaves.len() < LEAVES.0 || last - first < SPREAD && !is_dense {
        return None;
    }
    let mut uses: Vec<usize> = leaves.iter().map(|leaf| leaf.line).chain([number]).collect();
    uses.sort_unstable();
    if !explain(&uses) {
        return None;
    }
    let weight = page.weight(twig.size().length());
    let score = weight * (SCORE.0 + SCORE.1 * leaves.len().min(SCORE.2) as f32);
    let outlines = leaves.into_iter().map(|leaf| Made::new(Tool::Leaf, leaf.ring));
    let parts = std::iter::once(Made::new(Tool::Branch, way)).chain(outlines).collect();
    Some(Hypothesis { uses, score, parts, solids: Vec::new(), reading: Reading::Leaf, habit: None })
}

/// Whether a line is an outline that is left open at a twig.
fn is_open_at(line: &Line, way: &[Vec2]) -> bool {
    let is_at =
        |p: Vec2| polyline::nearest(way, p).is_some_and(|(gap, _)| gap < OPEN.2 * line.size().max_element());
    let (first, last) = line.ends();
    line.openness < OPEN.0 && line.solidity() > OPEN.1 && is_at(first) && is_at(last)
}

/// An outline at a twig.
pub(super) struct Leaf {
    /// Its line on the page.
    pub(super) line: usize,
    /// From its root around and back.
    pub(super) ring: Vec<Vec2>,
    /// Where along the twig, from its foot, its root is, from 0 to 1.
    pub(super) share: f32,
}

impl Leaf {
    /// An outline as a leaf of a twig that is `length` long.
    pub(super) fn new(number: usize, line: &Line, way: &[Vec2], length: f32) -> Option<Self> {
        let size = line.size().max_element();
        let is_outline = line.is_closed_and_solid() || is_open_at(line, way);
        if !is_outline || line.is_scribble() || size > LARGE * length {
            return None;
        }
        let off = |p: Vec2| polyline::nearest(way, p).unwrap_or((f32::INFINITY, 0.0));
        let places: Vec<(f32, f32)> = line.points.iter().map(|p| off(*p)).collect();
        let nearest = places.iter().map(|place| place.0).fold(f32::INFINITY, f32::min);
        let far = places.iter().map(|place| place.0).fold(0.0, f32::max);
        // Where an edge lies along the twig, the root is its lower end.
        let touches = |i: &usize| places[*i].0 <= nearest + TOUCH * size;
        let root = (0..places.len()).filter(touches).min_by(|a, b| places[*a].1.total_cmp(&places[*b].1))?;
        let at = lobes::nearest(way, line.points[root]);
        let share = polyline::length(&way[..=at]) / length;
        let reach = (AROUND * way.len() as f32).ceil() as usize;
        let along = way[(at + reach).min(way.len() - 1)] - way[at.saturating_sub(reach)];
        let aside: Vec<Vec2> = line
            .points
            .iter()
            .zip(&places)
            .filter(|(_, place)| place.0 > nearest + TOUCH * size)
            .map(|(p, _)| *p)
            .collect();
        let left = aside.iter().filter(|p| along.perp_dot(**p - way[at]) > 0.0).count();
        let sided = left.max(aside.len() - left) as f32 / aside.len().max(1) as f32;
        let is_aside = sided > ONE_SIDE && far > AWAY * size || share > END;
        let ring = || lobes::around_from(&line.points, root);
        (nearest < AT * size && is_aside).then(|| Self { line: number, ring: ring(), share })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;
    use std::f32::consts::TAU;

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    /// An oval from a root toward a direction.
    fn oval(root: (f32, f32), along: (f32, f32)) -> Vec<Vec2> {
        let (root, along) = (Vec2::from(root), Vec2::from(along));
        let place = |k: usize| {
            let angle = TAU * k as f32 / 40.0;
            root + 0.5 * (1.0 - angle.cos()) * along + 0.25 * angle.sin() * along.perp()
        };
        (0..=40).map(place).collect()
    }

    fn twig() -> Vec<Vec2> {
        line(&[(0.0, 0.0), (10.0, -100.0), (0.0, -200.0)])
    }

    #[test]
    fn outlines_that_are_open_at_their_twig_are_leaves_and_others_are_not() {
        let open = |from: usize, less: usize| {
            let leaves = [
                ((3.0, -40.0), (50.0, -30.0)),
                ((9.0, -90.0), (-50.0, -30.0)),
                ((8.0, -140.0), (45.0, -35.0)),
            ];
            let opened = leaves.map(|(root, along)| {
                let ring = oval(root, along);
                // The ring begins at its root; one begun elsewhere is open there.
                let around: Vec<Vec2> = ring[from..].iter().chain(&ring[1..from]).copied().collect();
                around[less..around.len() - less].to_vec()
            });
            read(&[vec![twig()], opened.to_vec()].concat())
        };
        assert_eq!(open(1, 2)[0].uses, [0, 1, 2, 3]);
        assert!(open(20, 5).is_empty());
    }

    #[test]
    fn outlines_along_a_line_are_its_leaves_and_grow_from_it() {
        let leaves = [
            oval((4.0, -40.0), (50.0, -30.0)),
            oval((9.0, -90.0), (-50.0, -30.0)),
            oval((8.0, -140.0), (45.0, -35.0)),
            oval((0.0, -203.0), (-3.0, -50.0)),
        ];
        let found = read(&[vec![twig()], leaves.to_vec()].concat());
        let [twig] = &found[..] else { panic!("{} twigs", found.len()) };
        assert_eq!(twig.uses, [0, 1, 2, 3, 4]);
        assert_eq!(twig.parts[0].tool, Tool::Branch);
        assert!(twig.parts[0].points[0].position.length() < 2.0, "from its foot");
        for (part, leaf) in twig.parts[1..].iter().zip(&leaves) {
            assert!(part.tool == Tool::Leaf && part.points[0].position.distance(leaf[0]) < 8.0);
        }
    }

    #[test]
    fn grains_whose_edge_is_the_stem_are_its_leaves_and_begin_at_their_lower_ends() {
        let grain = |y: f32, sign: f32| {
            let corners = [(0.0, y), (22.0, y - 14.0), (24.0, y - 40.0), (6.0, y - 22.0), (-1.0, y - 4.0)];
            line(&corners.map(|(x, y)| (sign * x, y)).into_iter().chain([(0.0, y)]).collect::<Vec<_>>())
        };
        let shaken = |k: i32| Vec2::new(1.5 * (1.3 * k as f32).sin(), -4.0 * k as f32);
        let stem: Vec<Vec2> = (0..=50).map(shaken).collect();
        let grains = [-100.0, -135.0, -170.0].iter().flat_map(|y| [grain(*y, 1.0), grain(*y, -1.0)]);
        let found = read(&[stem].into_iter().chain(grains).collect::<Vec<_>>());
        let [ear] = &found[..] else { panic!("{} ears", found.len()) };
        assert_eq!(ear.uses.len(), 7);
        let lowest = |part: &Made| part.points.iter().map(|p| p.position.y).fold(f32::NEG_INFINITY, f32::max);
        assert!(ear.parts[1..].iter().all(|part| lowest(part) - part.points[0].position.y < 6.0));
    }

    #[test]
    fn petals_at_the_end_two_leaves_and_outlines_across_are_none() {
        let petal = |angle: f32| {
            let along = 40.0 * Vec2::from_angle(angle);
            oval((0.0, -200.0), (along.x, along.y))
        };
        let petals: Vec<Vec<Vec2>> = (0..5).map(|k| petal(TAU * k as f32 / 5.0)).collect();
        assert!(read(&[vec![twig()], petals].concat()).is_empty());
        let pair = [oval((4.0, -40.0), (50.0, -30.0)), oval((9.0, -90.0), (-50.0, -30.0))];
        assert!(read(&[vec![twig()], pair.to_vec()].concat()).is_empty());
        let across = |y: f32| oval((-25.0, y), (60.0, 0.0));
        assert!(read(&[twig(), across(-50.0), across(-100.0), across(-150.0)]).is_empty());
    }

    #[test]
    fn an_ear_at_the_end_of_a_long_stem_is_read_beside_others_and_a_tulip_is_none() {
        let ear = |x: f32| {
            let grain = move |k: usize| {
                let (y, sign) = (-300.0 - 22.0 * (k / 2) as f32, [1.0, -1.0][k % 2]);
                oval((x + sign, y), (16.0 * sign, -16.0))
            };
            [line(&[(x, 0.0), (x, -350.0)])].into_iter().chain((0..6).map(grain))
        };
        let found = read(&[0.0, 120.0, 240.0].into_iter().flat_map(ear).collect::<Vec<_>>());
        assert_eq!(found.iter().map(|ear| ear.uses.len()).collect::<Vec<_>>(), [7, 7, 7]);
        let cup = [(0.0, -200.0), (-25.0, -215.0), (-27.0, -260.0), (-12.0, -235.0), (0.0, -262.0)];
        let other = [(12.0, -235.0), (27.0, -260.0), (25.0, -215.0), (0.0, -200.0)];
        let head = line(&[&cup[..], &other[..]].concat());
        let leaves = [oval((1.0, -20.0), (45.0, -60.0)), oval((-1.0, -20.0), (-45.0, -60.0))];
        assert!(read(&[twig(), head, leaves[0].clone(), leaves[1].clone()]).is_empty());
    }
}
