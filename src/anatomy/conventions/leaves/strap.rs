//! Strap leaves, as tulips and irises have: two lines from the foot of a stem that meet again at a tip. The stem carries
//! something.
//!
//! Both edges begin at one place in the lower part of a stem and end at one place away from it; between them lies a narrow area that the
//! stem does not cross. They may both bend to one side. Leaves whose midrib was drawn are read by [`leaf`](super::leaf), arcs along a stem
//! by [`stem_arcs`](super::stem_arcs).
//!
//! In a pot they need no stem, and lines on them are theirs.
//!
//! Limits: leaves without a stem or a pot are grass; edges of several strokes.

use crate::anatomy::conventions::page::{Line, Page};
use crate::anatomy::conventions::{Hypothesis, Made};
use crate::geom::{polyline, region::Region, simple_loop};
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Most lines of a page: among many twigs two may end at one place by chance.
const MOST: usize = 48;
/// Least length of an edge, as a share of the drawing's diagonal, and least chord over its length.
const LONG: f32 = 0.1;
const CHORD: f32 = 0.7;
/// Most distance of two tips, and of two feet, as shares of the longer edge; least length of the shorter as a share of that.
const TIPS: f32 = 0.09;
const FEET: f32 = 0.3;
const EVEN: f32 = 0.7;
/// Least and most area between both edges, over the square of the longer one's chord.
const AREA: (f32, f32) = (0.015, 0.22);
/// Least length of a stem over the leaf's, its least chord over its length, how far up it a leaf begins at most, as a share of its length,
/// and how near to it, as a share of the leaf's.
const STEM: (f32, f32) = (0.8, 0.7);
const UP: f32 = 0.45;
const AT: f32 = 0.3;
/// How near to its upper end a stem carries something, as a share of its length.
const HEAD: f32 = 0.2;
/// Most of a stem, or of any other line, that lies in a leaf.
const CROSSED: f32 = 0.3;
/// How far above or below the upper edge of a pot a leaf in it begins at most, as a share of the pot's height, fewest leaves, and least
/// share of what is drawn that they are.
const MOUTH: f32 = 0.35;
const FEWEST: usize = 3;
const MOSTLY: f32 = 0.8;
/// Longest band across a leaf, as a share of its length.
const BAND: f32 = 0.25;
/// Log-odds, and of leaves in a pot: of all, and for each.
const SCORE: f32 = 4.5;
const POTTED: (f32, f32) = (1.0, 4.5);

/// Proposes each strap leaf at a stem.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    if page.lines.len() > MOST || !page.is_mostly_free() {
        return;
    }
    let edges = (0..page.lines.len()).filter(|i| !page.is_apart(*i)).filter_map(|i| Edge::of(page, i));
    let edges: Vec<Edge> = edges.collect();
    let pairs = pairs(&edges);
    let pot = out.iter().find(|other| other.reading == Reading::Pot);
    if let Some(mouth) = pot.and_then(|pot| pot.solids.first()).map(|pot| pot.bounds()) {
        out.extend(in_pot(page, &edges, &pairs, mouth));
        return;
    }
    let is_edge =
        |number: usize| pairs.iter().any(|(a, b)| edges[*a].number == number || edges[*b].number == number);
    let stems = edges.iter().filter(|edge| !is_edge(edge.number) && has_head(page, edge));
    let stems: Vec<&Edge> = stems.collect();
    out.extend(pairs.iter().filter_map(|(a, b)| leaf(page, (&edges[*a], &edges[*b]), &stems)));
}

/// A line from its lower end up.
struct Edge {
    number: usize,
    points: Vec<Vec2>,
}

impl Edge {
    fn of(page: &Page, number: usize) -> Option<Self> {
        let line: &Line = &page.lines[number];
        let (first, last) = line.ends();
        let is_one = line.length > LONG * page.diagonal && first.distance(last) > CHORD * line.length;
        is_one.then(|| Self { number, points: line.upward() })
    }

    fn foot(&self) -> Vec2 {
        self.points[0]
    }

    fn tip(&self) -> Vec2 {
        self.points[self.points.len() - 1]
    }

    fn length(&self) -> f32 {
        self.foot().distance(self.tip())
    }
}

/// All leaves that rise from the mouth of a pot, with what is drawn on them, if they are most of the plant.
fn in_pot(
    page: &Page,
    edges: &[Edge],
    pairs: &[(usize, usize)],
    (low, high): (Vec2, Vec2),
) -> Option<Hypothesis> {
    let is_in_mouth =
        |p: Vec2| (low.x..high.x).contains(&p.x) && (p.y - low.y).abs() < MOUTH * (high.y - low.y);
    let leaves: Vec<(&Edge, &Edge)> = pairs
        .iter()
        .map(|(a, b)| (&edges[*a], &edges[*b]))
        .filter(|(a, b)| is_in_mouth(a.foot()) && is_in_mouth(b.foot()))
        .collect();
    let outlines: Vec<Vec<Vec2>> = leaves.iter().map(|(a, b)| ring(a, b)).collect();
    let mut uses: Vec<usize> = leaves.iter().flat_map(|(a, b)| [a.number, b.number]).collect();
    uses.extend(outlines.iter().flat_map(|outline| page.with_what_is_inside(&[], outline)));
    uses.extend(bands(page, &outlines));
    uses.sort_unstable();
    uses.dedup();
    let length: f32 = uses.iter().map(|i| page.lines[*i].length).sum();
    if leaves.len() < FEWEST || length < MOSTLY * page.length {
        return None;
    }
    let blade = |((a, b), outline): (&(&Edge, &Edge), Vec<Vec2>)| {
        let foot = a.foot().midpoint(b.foot());
        Made::new(Tool::Leaf, [foot].into_iter().chain(outline).chain([foot]))
    };
    let parts = leaves.iter().zip(outlines).map(blade).collect();
    let (reading, score) = (Reading::Fronds, POTTED.0 + POTTED.1 * leaves.len() as f32);
    Some(Hypothesis { uses, score, parts, solids: Vec::new(), reading, habit: None })
}

/// Short lines whose middle lies in one of these outlines, though they stick out of it.
fn bands(page: &Page, outlines: &[Vec<Vec2>]) -> Vec<usize> {
    let regions: Vec<(Region, f32)> = outlines
        .iter()
        .map(|outline| (Region::new(outline.clone()), BAND * 0.5 * polyline::length(outline)))
        .collect();
    let is_band = |i: &usize| {
        let line = &page.lines[*i];
        !page.is_apart(*i)
            && regions.iter().any(|(region, long)| line.length < *long && region.contains(line.middle()))
    };
    (0..page.lines.len()).filter(is_band).collect()
}

/// Whether something that begins in the upper half of a stem is near its upper end: an edge of a blade of grass carries nothing.
fn has_head(page: &Page, stem: &Edge) -> bool {
    let middle = stem.foot().midpoint(stem.tip()).y;
    let (tip, reach) = (stem.tip(), HEAD * stem.length());
    let is_there = |line: &Line| {
        let is_high = line.bounds.1.y < middle;
        is_high && polyline::nearest(&line.points, tip).is_some_and(|(gap, _)| gap < reach)
    };
    page.lines.iter().enumerate().any(|(number, line)| number != stem.number && is_there(line))
}

/// Places of two edges each that are a leaf, every one in one leaf at most: those whose tips are nearest first.
fn pairs(edges: &[Edge]) -> Vec<(usize, usize)> {
    let gap = |(a, b): (usize, usize)| edges[a].tip().distance(edges[b].tip());
    let all = (0..edges.len()).flat_map(|a| (a + 1..edges.len()).map(move |b| (a, b)));
    let mut fitting: Vec<(usize, usize)> = all.filter(|(a, b)| is_leaf(&edges[*a], &edges[*b])).collect();
    fitting.sort_by(|a, b| gap(*a).total_cmp(&gap(*b)));
    let mut is_used = vec![false; edges.len()];
    fitting.retain(|(a, b)| {
        let is_free = !is_used[*a] && !is_used[*b];
        (is_used[*a], is_used[*b]) = (true, true);
        is_free
    });
    fitting
}

/// Whether two edges go from one foot to one tip and part between.
fn is_leaf(a: &Edge, b: &Edge) -> bool {
    let (short, long) = (a.length().min(b.length()), a.length().max(b.length()));
    let share = simple_loop::area(&ring(a, b)) / (long * long).max(f32::MIN_POSITIVE);
    short > EVEN * long
        && a.tip().distance(b.tip()) < TIPS * long
        && a.foot().distance(b.foot()) < FEET * long
        && (AREA.0..AREA.1).contains(&share)
}

fn ring(a: &Edge, b: &Edge) -> Vec<Vec2> {
    a.points.iter().chain(b.points.iter().rev()).copied().collect()
}

/// The leaf of two edges if one of these stems carries it at its lower part.
fn leaf(page: &Page, (a, b): (&Edge, &Edge), stems: &[&Edge]) -> Option<Hypothesis> {
    let (foot, long) = (a.foot().midpoint(b.foot()), a.length().max(b.length()));
    let outline = ring(a, b);
    let region = Region::new(outline.clone());
    let carries = |stem: &&&Edge| {
        let length = polyline::length(&stem.points);
        let place = polyline::nearest(&stem.points, foot);
        let inside = stem.points.iter().filter(|p| region.contains(**p)).count();
        stem.length() > STEM.0 * long
            && stem.length() > STEM.1 * length
            && place.is_some_and(|(gap, arc)| gap < AT * long && arc < UP * length)
            && (inside as f32) < CROSSED * stem.points.len() as f32
    };
    // A midrib makes it a leaf of three lines.
    let is_other = |i: &usize| *i != a.number && *i != b.number && !page.is_apart(*i);
    let is_inside = |i: usize| {
        let points = &page.lines[i].points;
        points.iter().filter(|p| region.contains(**p)).count() as f32 > CROSSED * points.len() as f32
    };
    if (0..page.lines.len()).filter(is_other).any(is_inside) {
        return None;
    }
    let stem = stems.iter().find(carries)?;
    let (_, arc) = polyline::nearest(&stem.points, foot)?;
    let arcs = polyline::arc_lengths(stem.points.iter().copied());
    let root = polyline::interpolate(&stem.points, polyline::locate(&arcs, arc));
    let leaf: Vec<Vec2> = [root].into_iter().chain(outline).chain([root]).collect();
    let mut uses = vec![a.number, b.number];
    uses.sort_unstable();
    Some(Hypothesis {
        uses,
        score: SCORE * page.weight(1.6 * long),
        parts: vec![Made::new(Tool::Leaf, leaf)],
        solids: Vec::new(),
        reading: Reading::Leaf,
        habit: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::beneath::pot;
    use crate::anatomy::conventions::{line, read_above, read_by};

    fn stem() -> Vec<Vec2> {
        line(&[(0.0, 0.0), (2.0, -200.0)])
    }

    fn head() -> Vec<Vec2> {
        line(&[(0.0, -203.0), (-14.0, -225.0), (0.0, -245.0), (14.0, -225.0), (0.0, -203.0)])
    }

    /// Both edges of a leaf that bends to one side.
    fn edges(sign: f32) -> [Vec<Vec2>; 2] {
        let edge =
            |places: &[(f32, f32)]| line(&places.iter().map(|(x, y)| (sign * x, *y)).collect::<Vec<_>>());
        [
            edge(&[(1.0, -4.0), (24.0, -40.0), (40.0, -90.0), (48.0, -130.0)]),
            edge(&[(2.0, -18.0), (14.0, -55.0), (32.0, -100.0), (49.0, -132.0)]),
        ]
    }

    #[test]
    fn two_edges_from_the_foot_of_a_stem_are_a_leaf_on_it() {
        let lines = [&[stem()], &edges(1.0)[..], &edges(-1.0)[..], &[head()]].concat();
        let found = read_by(propose, &lines);
        let uses: Vec<&[usize]> = found.iter().map(|leaf| &leaf.uses[..]).collect();
        assert_eq!(uses, [&[1, 2], &[3, 4]]);
        let root = found[0].parts[0].points[0].position;
        assert!(read_by(propose, &lines[..5]).is_empty(), "a tuft of grass");
        assert!(found[0].parts[0].tool == Tool::Leaf && root.x.abs() < 2.0 && root.y > -30.0, "{root}");
    }

    #[test]
    fn in_a_pot_they_need_no_stem_and_have_bands() {
        let pot = line(&[(-40.0, 0.0), (-30.0, 60.0), (30.0, 60.0), (40.0, 0.0), (-40.0, 0.0)]);
        let leaf = |x: f32, lean: f32| {
            let tip = (x + lean, -150.0);
            let edge =
                |side: f32| line(&[(x + 10.0 * side, -2.0), (x + 0.5 * lean + 14.0 * side, -70.0), tip]);
            [edge(-1.0), edge(1.0), line(&[(x + 0.3 * lean - 6.0, -50.0), (x + 0.3 * lean + 6.0, -52.0)])]
        };
        let leaves = [leaf(-20.0, -30.0), leaf(0.0, 4.0), leaf(20.0, 30.0)].concat();
        let found = read_above(pot::propose, propose, &[&[pot], &leaves[..]].concat());
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].uses.len(), found[0].parts.len()), (9, 3));
    }

    #[test]
    fn petals_on_top_leaves_with_midribs_and_grass_are_none() {
        let up = |edges: [Vec<Vec2>; 2]| {
            edges.map(|edge| edge.iter().map(|p| *p - Vec2::new(0.0, 196.0)).collect())
        };
        assert!(read_by(propose, &[&[stem(), head()], &up(edges(1.0))[..]].concat()).is_empty());
        let midrib = line(&[(1.0, -8.0), (20.0, -50.0), (36.0, -95.0), (47.0, -128.0)]);
        assert!(read_by(propose, &[&[midrib, head()], &edges(1.0)[..]].concat()).is_empty());
        assert!(read_by(propose, &[edges(1.0), edges(-1.0)].concat()).is_empty());
    }
}
