//! Flowers seen from the side whose petals stand close together: tulips and bells.
//!
//! A head of several lines stands beyond the end of a stem, in the direction in which the stem arrives: arcs side by side, or a
//! cup with a zigzag over it. What all of them enclose has at least [`TIPS`] tips away from the stem and no notches elsewhere,
//! and every line draws a good part of its outline, which a leaf's veins and a crown's twigs do not. One line alone is a bell if it hangs; standing outlines of one line are read by
//! [`corolla_on_stem`](super::corolla_on_stem). Each tip is that of a
//! petal from the stem's end, so broad that the outer ones reach the sides of the cup. Between two of them another stands in
//! front, its tip a little lower ([`LOWER`]): the ellipse of their rim then closes, and the cone fit of the later stages
//! makes a cup of them ([`petals`]). Small lines within, as stamens, belong to it.
//!
//! Limits: buds of one outline are leaves; heads whose stem arrives from the side are not found.

use crate::anatomy::conventions::page::{self, Line, Page, even, notches};
use crate::anatomy::conventions::shapes::lobes;
use crate::anatomy::conventions::shapes::silhouette::{Silhouette, share_along, smooth_contour};
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::geom::polyline;
use crate::sketch::{Reading, Tool};
use glam::Vec2;
use std::collections::BTreeSet;

/// Fewest tips and most.
const TIPS: (usize, usize) = (3, 9);
/// The same of a cup that is known by them alone, and the least depth of notches between them, as a share of its height.
const FEW: (usize, usize) = (2, 4);
const CLEAR: f32 = 0.07;
/// How high above its base they are joined at least in a cup that is so much wider than high, as a share of its height: a pair of
/// leaves spreads.
const JOINED: (f32, f32) = (1.5, 0.35);
/// Fewest lines of a head that stands, most of it, and most of a group that is looked at.
const LINES: (usize, usize, usize) = (2, 10, 40);
/// Steepest way down of a stem, from which a head of one line is a bell: leaves hang, too, but have one tip.
const HANGS: f32 = 0.5;
/// Least length of a stem, as a share of its head's height, and of one that no leaf would have.
const LONG: (f32, f32) = (0.15, 0.5);
/// What it costs that a stem is shorter than that.
const SHORT: f32 = 0.2;
/// Part of a stem's end that gives its direction.
const END: f32 = 0.1;
/// How far from the stem's end a head may begin, and how far it may reach back, as shares of its height.
const BEGIN: f32 = 0.2;
const BACK: f32 = 0.12;
/// Width of a head over its height.
const WIDTH: (f32, f32) = (0.4, 1.7);
/// Widest head of one line, over its height: what opens wider is drawn with its petals apart.
const NARROW: f32 = 1.2;
/// Least height of a tip, and of a notch, as shares of the head's.
const HIGH: (f32, f32) = (0.6, 0.4);
/// Least fall of the outline beside a tip, as a share of the head's height.
const PROMINENCE: f32 = 0.04;
/// Stretch of an outline over which a corner turns, as a share of its length, least turn there, radians, and least distance of two tips,
/// as a share of the head's height.
const CORNER: (f32, f32) = (0.05, 1.2);
const CORNERS: f32 = 0.15;
/// Fewest corners that speak for a cup, and log-odds.
const CORNERED: (usize, f32) = (2, 0.7);
/// Least part of the outline that each line draws, and that all do together where they are many.
const DRAWN: (f32, f32) = (0.12, 0.6);
/// Largest small line in a head, as a share of its height, most of them, and least share of their points within the outline.
const SMALL: (f32, usize, f32) = (0.4, 16, 0.7);
/// How wide gaps of the outline are closed, in cells of the silhouette.
const BRIDGE: i32 = 8;
/// Points of the outline, and of each side of a petal.
const POINTS: (usize, usize) = (160, 16);
/// Half the width of a petal, least and most, as a share of its length.
const HALF: (f32, f32) = (0.16, 0.34);
/// How much nearer to the stem the tips of petals in front are, as a share of their length.
const LOWER: f32 = 0.14;

/// Proposes a cup at the end of each stem that has one.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    for group in page.groups.iter().filter(|group| (2..=LINES.2).contains(&group.len())) {
        out.extend(group.iter().filter_map(|stem| at_end(page, group, *stem)));
    }
}

/// The cup at either end of a line.
fn at_end(page: &Page, group: &[usize], stem: usize) -> Option<Hypothesis> {
    let line = &page.lines[stem];
    if line.openness < 0.5 {
        return None;
    }
    let mut points = even(&line.points, 40);
    let forward = Base::new(&points);
    points.reverse();
    [forward, Base::new(&points)].into_iter().find_map(|base| cup(page, group, stem, base))
}

/// Where a head begins, and where it goes from there.
#[derive(Clone, Copy)]
struct Base {
    place: Vec2,
    along: Vec2,
}

impl Base {
    /// That at the last of these points.
    fn new(points: &[Vec2]) -> Self {
        let last = points.len() - 1;
        let before = points[last - (END * last as f32) as usize];
        Self { place: points[last], along: (points[last] - before).normalize_or_zero() }
    }

    /// The same with a direction between that of the stem and that of the lines' middle, and their height along it.
    fn toward(self, lines: &[&Line]) -> (Self, f32) {
        let middle = lines.iter().map(|line| line.middle()).sum::<Vec2>() / lines.len().max(1) as f32;
        let along = (self.along + (middle - self.place).normalize_or_zero()).normalize_or_zero();
        let base = Self { along, ..self };
        let heights = lines.iter().flat_map(|line| &line.points).map(|p| base.height(*p));
        (base, heights.fold(f32::MIN_POSITIVE, f32::max))
    }

    fn height(&self, p: Vec2) -> f32 {
        (p - self.place).dot(self.along)
    }
}

fn cup(page: &Page, group: &[usize], stem: usize, base: Base) -> Option<Hypothesis> {
    let heights = |line: &Line| {
        let all = line.points.iter().map(|p| base.height(*p));
        all.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)))
    };
    let others = || group.iter().copied().filter(|i| *i != stem);
    let height = others().map(|i| heights(&page.lines[i]).1).fold(0.0, f32::max);
    let head: Vec<usize> = others().filter(|i| heights(&page.lines[*i]).0 > -BACK * height).collect();
    let fewest = if base.along.y > HANGS { 1 } else { LINES.0 };
    let is_small = |i: &&usize| page.lines[**i].size().max_element() < SMALL.0 * height;
    let small: Vec<&Line> = head.iter().filter(is_small).map(|i| &page.lines[*i]).collect();
    let lines: Vec<&Line> = head.iter().filter(|i| !is_small(i)).map(|i| &page.lines[*i]).collect();
    let is_of_form = (fewest..=LINES.1).contains(&lines.len())
        && small.len() <= SMALL.1
        && height > 0.0
        && page.lines[stem].length > LONG.0 * height
        && head.len() * 2 > others().count();
    if !is_of_form {
        return None;
    }
    let (base, height) = base.toward(&lines);
    let sides = lines.iter().flat_map(|line| &line.points).map(|p| (*p - base.place).perp_dot(base.along));
    let (left, right) = sides.fold((0.0_f32, 0.0_f32), |(low, high), side| (low.min(side), high.max(side)));
    let nearest = lines.iter().filter_map(|line| polyline::nearest(&line.points, base.place));
    let gap = nearest.map(|(gap, _)| gap).fold(f32::INFINITY, f32::min);
    // The stem arrives at the middle of its head.
    let is_amid = left.abs().min(right) > 0.25 * (right - left);
    if gap > BEGIN * height || !is_amid || !(WIDTH.0..WIDTH.1).contains(&((right - left) / height)) {
        return None;
    }
    let outline = outline((&lines, &small), base, height)?;
    let parts: Vec<Made> = petals(&outline, base.place, &tips_and_corners(&outline, base, height))?
        .into_iter()
        .map(|petal| Made::new(Tool::Petal, petal))
        .collect();
    let short = if page.lines[stem].length > LONG.1 * height { 0.0 } else { SHORT };
    // Petals of a cup end in corners, lobes of a leaf's or a crown's outline do not.
    let has_corners = corners(&outline, base, height).len() >= CORNERED.0;
    let cornered = if has_corners { CORNERED.1 } else { 0.0 };
    let score = 3.4 + 0.1 * lines.len().min(6) as f32 + cornered - short;
    let (reading, habit) = (Reading::Corolla, Some(Habit::Flower));
    Some(Hypothesis { uses: head, score, parts, solids: Vec::new(), reading, habit })
}

/// What the lines of a head enclose, if all of them draw it, it has notches between its tips only and small lines lie within.
fn outline((lines, small): (&[&Line], &[&Line]), base: Base, height: f32) -> Option<Vec<Vec2>> {
    let silhouette = Silhouette::new(lines.iter().map(|line| line.points.as_slice()), BRIDGE);
    let outline = smooth_contour(&silhouette.contour(), POINTS.0, 1);
    let near = 3.0 * silhouette.cell();
    let least = DRAWN.0.min(DRAWN.1 / lines.len() as f32);
    let draws = |line: &&Line| share_along(&outline, std::iter::once(line.points.as_slice()), near) > least;
    let is_high = |p: &Vec2| base.height(*p) > HIGH.1 * height;
    let is_within = || silhouette.share_inside(small.iter().flat_map(|line| &line.points)) > SMALL.2;
    (lines.iter().all(draws) && (small.is_empty() || is_within()) && notches(&outline).iter().all(is_high))
        .then_some(outline)
}

/// The tips of an outline: where it turns back toward its base, high up.
fn tips(outline: &[Vec2], base: Base, height: f32) -> Vec<Vec2> {
    let (around, tips) = numbered_tips(outline, base, height);
    tips.into_iter().map(|k| around[k]).collect()
}

/// The same of several lines: corners count, too, for between lines that touch notches may be closed.
fn tips_and_corners(outline: &[Vec2], base: Base, height: f32) -> Vec<Vec2> {
    let (around, tips) = numbered_tips(outline, base, height);
    let mut all: BTreeSet<usize> = tips.into_iter().collect();
    for corner in corners(outline, base, height) {
        if all.iter().all(|tip| around[*tip].distance(corner) > CORNERS * height) {
            all.extend(around.iter().position(|p| *p == corner));
        }
    }
    all.into_iter().map(|k| around[k]).collect()
}

/// An outline from its lowest place around, and the numbers of its tips there.
fn numbered_tips(outline: &[Vec2], base: Base, height: f32) -> (Vec<Vec2>, Vec<usize>) {
    let lowest = (0..outline.len())
        .min_by(|a, b| base.height(outline[*a]).total_cmp(&base.height(outline[*b])))
        .unwrap_or(0);
    let around: Vec<Vec2> = (0..=outline.len()).map(|k| outline[(lowest + k) % outline.len()]).collect();
    let below: Vec<f32> = around.iter().map(|p| (height - base.height(*p)).max(0.0)).collect();
    let mut tips = lobes::valleys_between(&below, PROMINENCE * height);
    tips.retain(|k| base.height(around[*k]) > HIGH.0 * height);
    (around, tips)
}

/// Sharp corners of an outline, high up.
fn corners(outline: &[Vec2], base: Base, height: f32) -> Vec<Vec2> {
    let mut all = page::tips(outline, CORNER);
    all.retain(|corner| base.height(*corner) > HIGH.0 * height);
    all
}

/// A petal from the base to each tip, and between neighbours one in front.
pub(crate) fn petals(outline: &[Vec2], base: Vec2, tips: &[Vec2]) -> Option<Vec<Vec<Vec2>>> {
    (TIPS.0..=TIPS.1).contains(&tips.len()).then(|| from_tips(outline, base, tips))
}

/// The same for any number of tips, at least two.
fn from_tips(outline: &[Vec2], base: Vec2, tips: &[Vec2]) -> Vec<Vec<Vec2>> {
    let (first, last) = (tips[0], tips[tips.len() - 1]);
    let half = side_of(outline, base, first).max(side_of(outline, base, last));
    let length = tips.iter().map(|tip| tip.distance(base)).sum::<f32>() / tips.len() as f32;
    let half = half.clamp(HALF.0 * length, HALF.1 * length);
    let front = tips.windows(2).map(|pair| base + (1.0 - LOWER) * (pair[0].midpoint(pair[1]) - base));
    tips.iter().copied().chain(front).map(|tip| petal(base, tip, half)).collect()
}

/// The petals of a cup in one line on the end of a stem; nothing where its tips do not stand close together above that.
pub(crate) fn petals_of_one(line: &Line, place: Vec2) -> Option<Vec<Vec<Vec2>>> {
    let base = Base { place, along: (line.middle() - place).normalize_or_zero() };
    let height = line.points.iter().map(|p| base.height(*p)).fold(0.0, f32::max);
    let sides = line.points.iter().map(|p| (*p - place).perp_dot(base.along));
    let (left, right) = sides.fold((0.0_f32, 0.0_f32), |(low, high), side| (low.min(side), high.max(side)));
    let is_narrow = right - left < NARROW * height;
    let is_high = |p: &Vec2| base.height(*p) > HIGH.1 * height;
    let outline = even(&line.points, POINTS.0);
    let is_cup = is_narrow && notches(&outline).iter().all(is_high);
    petals(&outline, place, &tips(&outline, base, height)).filter(|_| is_cup)
}

/// The petals of a cup in one line whose lower edge is here and that has [`FEW`] tips, with notches between them that nobody draws
/// by chance. Two outlines that meet at the stem alone are a pair of leaves.
pub(crate) fn petals_of_teeth(line: &Line, place: Vec2) -> Option<Vec<Vec<Vec2>>> {
    let base = Base { place, along: Vec2::NEG_Y };
    let height = line.size().y;
    let outline = even(&line.points, POINTS.0);
    let lowest = (0..outline.len()).max_by(|a, b| outline[*a].y.total_cmp(&outline[*b].y)).unwrap_or(0);
    let around: Vec<Vec2> = (0..=outline.len()).map(|k| outline[(lowest + k) % outline.len()]).collect();
    let below: Vec<f32> = around.iter().map(|p| (height - base.height(*p)).max(0.0)).collect();
    let mut tips = lobes::valleys_between(&below, CLEAR * height);
    tips.retain(|k| below[*k] < (1.0 - HIGH.0) * height);
    let is_wide = line.size().x > JOINED.0 * height;
    let is_joined = |pair: &[usize]| below[pair[0]..pair[1]].iter().all(|d| *d < (1.0 - JOINED.1) * height);
    let is_cup = (FEW.0..=FEW.1).contains(&tips.len()) && (!is_wide || tips.windows(2).all(is_joined));
    let places: Vec<Vec2> = tips.iter().map(|k| around[*k]).collect();
    is_cup.then(|| from_tips(&outline, place, &places))
}

/// How far an outline goes beyond the line from the base to an outer tip, away from the others.
fn side_of(outline: &[Vec2], base: Vec2, tip: Vec2) -> f32 {
    let middle = outline.iter().sum::<Vec2>() / outline.len() as f32;
    let axis = (tip - base).normalize_or_zero();
    let outside = -axis.perp_dot(middle - base).signum();
    outline.iter().map(|p| outside * axis.perp_dot(*p - base)).fold(0.0, f32::max)
}

/// The outline of a petal, broadest beyond its middle, its root a little beside the base so that the petals stay apart.
fn petal(base: Vec2, tip: Vec2, half: f32) -> Vec<Vec2> {
    let axis = tip - base;
    let side = |k: usize, sign: f32| {
        let along = k as f32 / POINTS.1 as f32;
        let away = (std::f32::consts::PI * along.powf(1.2)).sin().max(0.0).powf(0.8);
        base + along * axis + sign * half * away * axis.normalize_or_zero().perp()
    };
    let out = (0..=POINTS.1).map(|k| side(k, 1.0));
    out.chain((0..POINTS.1).rev().map(|k| side(k, -1.0))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    /// From the left rim of a cup on the origin down and up to its right rim.
    fn cup() -> Vec<Vec2> {
        let place = |k: usize| {
            let angle = std::f32::consts::PI * (k as f32 / 40.0);
            Vec2::new(-50.0 * angle.cos(), -100.0 + 100.0 * angle.sin())
        };
        [vec![Vec2::new(-46.0, -140.0)], (0..=40).map(place).collect(), vec![Vec2::new(46.0, -140.0)]]
            .concat()
    }

    fn zigzag() -> Vec<Vec2> {
        line(&[(-46.0, -140.0), (-22.0, -105.0), (0.0, -145.0), (22.0, -105.0), (46.0, -140.0)])
    }

    fn stem() -> Vec<Vec2> {
        line(&[(5.0, 200.0), (0.0, 2.0)])
    }

    #[test]
    fn a_cup_with_a_zigzag_is_a_tulip_of_petals_behind_and_in_front() {
        let found = read(&[stem(), cup(), zigzag()]);
        let [tulip] = &found[..] else { panic!("{} cups", found.len()) };
        assert_eq!((&tulip.uses[..], tulip.parts.len()), (&[1, 2][..], 5));
        let outline = |part: &Made| part.points.iter().map(|p| p.position).collect::<Vec<_>>();
        let top = |part: &Made| outline(part).iter().map(|p| p.y).fold(f32::INFINITY, f32::min);
        for petal in &tulip.parts {
            assert!(petal.tool == Tool::Petal && outline(petal)[0].length() < 5.0, "from the stem's end");
        }
        let (drawn, front) = tulip.parts.split_at(3);
        assert!(drawn.iter().all(|petal| (-150.0..-130.0).contains(&top(petal))));
        assert!(front.iter().all(|petal| (-135.0..-105.0).contains(&top(petal))));
        let left = drawn.iter().flat_map(outline).map(|p| p.x).fold(0.0, f32::min);
        assert!((-65.0..-42.0).contains(&left), "as broad as drawn: {left}");
    }

    #[test]
    fn three_arcs_side_by_side_are_a_tulip() {
        let arc = |x: f32, tip: f32| {
            line(&[
                (0.0, 0.0),
                (x - 30.0, -50.0),
                (x - 26.0, -90.0),
                (x, tip),
                (x + 26.0, -90.0),
                (x + 30.0, -50.0),
                (0.0, 0.0),
            ])
        };
        let found = read(&[stem(), arc(0.0, -150.0), arc(-32.0, -135.0), arc(32.0, -135.0)]);
        assert_eq!((found.len(), found[0].uses.len(), found[0].parts.len()), (1, 3, 5));
    }

    #[test]
    fn a_bell_hangs_from_an_arching_stem() {
        let bell: Vec<Vec2> =
            [cup(), zigzag().into_iter().rev().collect()].concat().into_iter().map(|p| -p).collect();
        let arch = line(&[
            (150.0, 300.0),
            (150.0, -20.0),
            (120.0, -60.0),
            (60.0, -80.0),
            (20.0, -60.0),
            (0.0, -20.0),
            (0.0, -2.0),
        ]);
        let found = read(&[arch, bell.clone()]);
        assert_eq!((found.len(), &found[0].uses[..]), (1, &[1][..]));
        assert!(read(&[bell, line(&[(0.0, -200.0), (0.0, -2.0)])]).len() == 1, "from above");
    }

    #[test]
    fn leaves_with_veins_and_cups_without_tips_are_none() {
        let closed = [cup(), line(&[(-46.0, -140.0)])].concat();
        let (midrib, vein) = (line(&[(0.0, 0.0), (0.0, -120.0)]), line(&[(0.0, -40.0), (25.0, -80.0)]));
        assert!(read(&[stem(), closed, midrib.clone(), vein.clone()]).is_empty());
        assert!(
            read(&[stem(), [cup(), zigzag().into_iter().rev().collect()].concat(), midrib, vein]).is_empty()
        );
    }

    #[test]
    fn stamens_belong_to_their_cup() {
        let stamen = |x: f32| line(&[(x, -100.0), (x, -60.0)]);
        let found = read(&[stem(), cup(), zigzag(), stamen(-12.0), stamen(12.0)]);
        // None touches the cup; one that does is in its group.
        assert_eq!(found[0].uses[..2], [1, 2]);
        let touching = line(&[(0.0, -142.0), (0.0, -95.0)]);
        let found = read(&[stem(), cup(), zigzag(), touching]);
        assert_eq!((found.len(), &found[0].uses[..]), (1, &[1, 2, 3][..]));
        let outside = line(&[(46.0, -138.0), (85.0, -150.0)]);
        assert!(read(&[stem(), cup(), zigzag(), outside]).is_empty());
    }
}
