//! The strokes of a drawing as even lines with their measures: what conventions look at.
//!
//! A line is its stroke at even steps of arc length, at most 400 of them: angles and corners then
//! mean the same in a fast and in a slow hand. All lengths are canvas pixels.

use super::hypothesis::{Hypothesis, renumbered};
use crate::geom::{bvh, convex_hull::convex_hull, polyline, region::Region, simple_loop};
use crate::kept::{Kept, Same, Use};
use crate::sketch::{Stroke, Tool};
use glam::{IVec2, Vec2};
use std::collections::{BTreeSet, HashMap};
use std::f32::consts::FRAC_PI_4;
use std::ops::Deref;
use std::sync::Arc;

/// Step between points of a line, as a share of the drawing's diagonal.
const STEP: f32 = 0.006;
/// Fewest and most points of a line.
const POINTS: (usize, usize) = (16, 400);
/// Shortest stroke that conventions look at, as a share of the drawing's diagonal.
const SHORTEST: f32 = 0.012;
/// Distance within which lines touch, as a share of the drawing's diagonal.
const TOUCH: f32 = 0.025;
/// Distance within which lines are near one another.
const NEAR: f32 = 0.09;

/// A stroke that may be read otherwise than by itself.
#[derive(Clone, Debug)]
pub struct Line {
    /// Its place among the strokes of the drawing.
    pub stroke: usize,
    shape: Arc<Shape>,
}

/// The lines of one drawing, kept for the next: each by its stroke and the scale of the drawing; none for what is no line.
pub(super) type Shapes = Kept<(Same<Stroke>, u32), Option<Arc<Shape>>>;

/// A line wherever it stands in the drawing's order.
#[derive(Clone, Debug)]
pub struct Shape {
    /// Even points from its beginning to its end.
    pub points: Vec<Vec2>,
    /// Length, pixels.
    pub length: f32,
    /// Smallest and largest corner.
    pub bounds: (Vec2, Vec2),
    /// Distance between its ends over the diagonal of its bounds: 0 is closed.
    pub openness: f32,
    /// Area between the line and its chord, pixels².
    pub area: f32,
    /// Convex hull, counter-clockwise with y up.
    pub hull: Vec<Vec2>,
    /// Its area, pixels².
    pub hull_area: f32,
}

/// All lines of a drawing that conventions look at.
#[derive(Clone, Debug)]
pub struct Page {
    /// The lines, in the order of the drawing.
    pub lines: Vec<Line>,
    /// Lines that touch one another, directly or through others, ascending.
    pub groups: Vec<Vec<usize>>,
    /// The same for lines that are near one another; only groups that are wider than those that touch.
    pub wide_groups: Vec<Vec<usize>>,
    /// Smallest and largest corner over all strokes.
    pub bounds: (Vec2, Vec2),
    /// Diagonal of the bounds.
    pub diagonal: f32,
    /// Length of all strokes, also of those whose tool was chosen, but not of lines apart, pixels.
    pub length: f32,
    /// Lines that belong to no group, ascending.
    apart: Vec<usize>,
}

impl Page {
    /// These lines and all others that lie within an outline and are not set apart, ascending.
    pub fn with_what_is_inside(&self, lines: &[usize], outline: &[Vec2]) -> Vec<usize> {
        let (low, high) = polyline::bounds(outline.iter().copied());
        let region = Region::new(outline.to_vec());
        let is_inside = |line: &Line| {
            let is_near = line.bounds.0.cmpge(low).all() && line.bounds.1.cmple(high).all();
            is_near
                && line.points.iter().filter(|p| region.contains(**p)).count() * 10 >= line.points.len() * 9
        };
        let inside = (0..self.lines.len()).filter(|i| !self.is_apart(*i) && is_inside(&self.lines[*i]));
        let mut all: Vec<usize> = lines.iter().copied().chain(inside).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// The lines of those strokes whose tool nobody chose.
    pub fn new(strokes: &[Arc<Stroke>]) -> Self {
        Self::with(&mut Shapes::for_one_call(), strokes)
    }

    /// The same page, its lines taken from those of the drawing that was read last where strokes and scale are the same.
    pub(super) fn with(known: &mut Shapes, strokes: &[Arc<Stroke>]) -> Self {
        let positions = strokes.iter().flat_map(|s| &s.points).map(|p| p.position);
        let bounds = polyline::bounds(positions);
        let diagonal = if strokes.is_empty() { 0.0 } else { bounds.0.distance(bounds.1) };
        let key = |stroke: &Arc<Stroke>, used: Use| (Same::of(stroke, used), diagonal.to_bits());
        let shapes = known.made(strokes, key, |stroke| Shape::new(stroke, diagonal).map(Arc::new));
        let line =
            |(stroke, shape): (usize, &Option<Arc<Shape>>)| Some(Line { stroke, shape: shape.clone()? });
        let lines = shapes.iter().enumerate().filter_map(line).collect();
        let length = strokes.iter().map(|stroke| length_of(stroke)).filter(|length| length.is_finite()).sum();
        let (groups, wide_groups) = (Vec::new(), Vec::new());
        let mut it = Self { lines, groups, wide_groups, bounds, diagonal, length, apart: Vec::new() };
        it.group();
        it
    }

    /// Takes these lines, among them all that are apart already, out of all groups: what stands in a pot is not one thing with it.
    pub(super) fn set_apart(&mut self, lines: BTreeSet<usize>) {
        let lines: Vec<usize> = lines.into_iter().collect();
        if lines == self.apart {
            return;
        }
        let new = lines.iter().filter(|line| !self.is_apart(**line));
        self.length -= new.map(|line| self.lines[*line].length).sum::<f32>();
        self.apart = lines;
        self.group();
    }

    /// The same hypotheses by the places of strokes in the drawing instead of by lines.
    pub(super) fn by_strokes(&self, hypotheses: Vec<Hypothesis>) -> Vec<Hypothesis> {
        renumbered(hypotheses, |line| self.lines[line].stroke)
    }

    /// Whether some line belongs to no group.
    pub(super) fn has_apart(&self) -> bool {
        !self.apart.is_empty()
    }

    /// Whether a line belongs to no group.
    pub(super) fn is_apart(&self, line: usize) -> bool {
        self.apart.binary_search(&line).is_ok()
    }

    /// Groups of lines that touch one another, but for some lines and those that are apart.
    pub(super) fn groups_without(&self, lines: impl Iterator<Item = usize>) -> Vec<Vec<usize>> {
        let mut apart: Vec<usize> = self.apart.iter().copied().chain(lines).collect();
        apart.sort_unstable();
        let mut groups = groups(&self.lines, TOUCH * self.diagonal, &apart);
        groups.retain(|group| apart.binary_search(&group[0]).is_err());
        groups
    }

    fn group(&mut self) {
        let mut touching = groups(&self.lines, TOUCH * self.diagonal, &self.apart);
        let mut near = groups(&self.lines, NEAR * self.diagonal, &self.apart);
        touching.retain(|group| !self.is_apart(group[0]));
        near.retain(|group| !self.is_apart(group[0]) && touching.binary_search(group).is_err());
        (self.groups, self.wide_groups) = (touching, near);
    }
}

/// Size from which a part counts fully, as a share of the drawing's diagonal, and the least that a smaller one counts.
const FULL_WEIGHT: f32 = 0.4;
const LEAST_WEIGHT: f32 = 0.3;

/// Least length of the lines that conventions look at, as a share of all: among parts whose tool the artist chose, lines are branches.
const MOSTLY_FREE: f32 = 0.5;

/// Most steps that a search for lines in boxes takes: that many lines in one spot are no drawing.
const MOST_STEPS: u64 = 1 << 22;

impl Page {
    /// How much a part of such a diagonal counts: what is small beside the drawing must not outweigh what explains all of it.
    pub(super) fn weight(&self, diagonal: f32) -> f32 {
        (diagonal / (FULL_WEIGHT * self.diagonal)).clamp(LEAST_WEIGHT, 1.0)
    }

    /// Whether the artist left it open what much of the drawing is.
    pub(super) fn is_mostly_free(&self) -> bool {
        self.lines.iter().map(|line| line.length).sum::<f32>() >= MOSTLY_FREE * self.length
    }

    /// For each box, by its smallest and largest corner, the lines whose bounds it touches, ascending; none that are
    /// set apart.
    pub(super) fn lines_at(&self, boxes: &[(Vec2, Vec2)]) -> Vec<Vec<usize>> {
        let asked = boxes.len();
        let all = boxes.iter().copied().chain(self.lines.iter().map(|line| line.bounds));
        let all: Vec<bvh::Bounds> = all.map(|(low, high)| (low.extend(0.0), high.extend(0.0))).collect();
        let is_asked = |a: usize, b: usize| a < asked && asked <= b && !self.is_apart(b - asked);
        let of_box = |a: usize, b: usize| is_asked(a, b).then(|| (a, b - asked));
        let mut pairs = bvh::overlapping_within(MOST_STEPS, &all, of_box).unwrap_or_default();
        pairs.sort_unstable();
        let mut lines = vec![Vec::new(); asked];
        pairs.into_iter().for_each(|(place, line)| lines[place].push(line));
        lines
    }
}

#[cfg(test)]
impl Page {
    /// That of lines through some corners, drawn at even steps.
    pub(super) fn of_lines(lines: &[Vec<Vec2>]) -> Self {
        let stroke = |(id, line): (usize, &Vec<Vec2>)| {
            let points = even(line, 120).into_iter().map(crate::sketch::StrokePoint::at).collect();
            Arc::new(Stroke { id: id as u64, tool: Tool::Auto, points, brush: None })
        };
        Self::new(&lines.iter().enumerate().map(stroke).collect::<Vec<_>>())
    }
}

/// Length of a stroke as drawn, pixels.
pub(super) fn length_of(stroke: &Stroke) -> f32 {
    stroke.points.windows(2).map(|pair| pair[0].position.distance(pair[1].position)).sum()
}

/// Lines of which some points are nearer than about `reach`: a point joins the lines of its cell and of the cells around it.
/// Those `apart` are by themselves.
fn groups(lines: &[Line], reach: f32, apart: &[usize]) -> Vec<Vec<usize>> {
    let mut leader: Vec<usize> = (0..lines.len()).collect();
    let mut user_of: HashMap<IVec2, usize> = HashMap::new();
    for (i, line) in lines.iter().enumerate().filter(|(i, _)| apart.binary_search(i).is_err()) {
        let mut last = None;
        for point in &line.points {
            let cell = (point / reach).floor().as_ivec2();
            // Most points lie in the cell of the one before.
            if last.replace(cell) == Some(cell) {
                continue;
            }
            for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
                if let Some(&other) = user_of.get(&(cell + IVec2::new(dx, dy))) {
                    unite(&mut leader, i, other);
                }
            }
            user_of.entry(cell).or_insert(i);
        }
    }
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); lines.len()];
    for i in 0..lines.len() {
        let first = root(&mut leader, i);
        members[first].push(i);
    }
    members.retain(|group| !group.is_empty());
    members
}

/// Makes two things members of one group, whose leader is its first.
pub(super) fn unite(leader: &mut [usize], a: usize, b: usize) {
    let (a, b) = (root(leader, a), root(leader, b));
    leader[a.max(b)] = a.min(b);
}

/// The leader of the group of `i`.
pub(super) fn root(leader: &mut [usize], mut i: usize) -> usize {
    while leader[i] != i {
        leader[i] = leader[leader[i]];
        i = leader[i];
    }
    i
}

impl Deref for Line {
    type Target = Shape;

    fn deref(&self) -> &Shape {
        &self.shape
    }
}

impl Line {
    /// Some consecutive points of this line, as a line; at least three.
    pub(super) fn part(&self, points: Vec<Vec2>) -> Option<Self> {
        let shape = (points.len() > 2).then(|| Shape::of(polyline::length(&points), points))?;
        Some(Self { stroke: self.stroke, shape: Arc::new(shape) })
    }
}

impl Shape {
    fn new(drawn: &Stroke, diagonal: f32) -> Option<Self> {
        if drawn.tool != Tool::Auto {
            return None;
        }
        let positions: Vec<Vec2> = drawn.points.iter().map(|p| p.position).collect();
        let length = polyline::length(&positions);
        if !length.is_finite() || length <= SHORTEST * diagonal {
            return None;
        }
        let count = ((length / (STEP * diagonal)) as usize).clamp(POINTS.0, POINTS.1);
        Some(Self::of(length, even(&positions, count)))
    }

    fn of(length: f32, points: Vec<Vec2>) -> Self {
        let bounds = polyline::bounds(points.iter().copied());
        let hull = convex_hull(&points, |p| *p);
        let gap = points[0].distance(points[points.len() - 1]);
        Self {
            length,
            bounds,
            openness: gap / bounds.0.distance(bounds.1),
            area: simple_loop::area(&points),
            hull_area: simple_loop::area(&hull),
            hull,
            points,
        }
    }

    /// Beginning and end.
    pub fn ends(&self) -> (Vec2, Vec2) {
        (self.points[0], self.points[self.points.len() - 1])
    }

    /// Its points from the end of the smaller measure to the other.
    pub fn beginning_at(&self, measure: impl Fn(Vec2) -> f32) -> Vec<Vec2> {
        let mut points = self.points.clone();
        let (first, last) = self.ends();
        if measure(first) > measure(last) {
            points.reverse();
        }
        points
    }

    /// Its points from the lower end to the upper one.
    pub fn upward(&self) -> Vec<Vec2> {
        self.beginning_at(|end| -end.y)
    }

    /// Width and height.
    pub fn size(&self) -> Vec2 {
        self.bounds.1 - self.bounds.0
    }

    /// Middle of the bounds.
    pub fn middle(&self) -> Vec2 {
        self.bounds.0.midpoint(self.bounds.1)
    }

    /// The area of its hull over that of the disc across its longest way: of an ellipse its width over its length, wherever it points.
    pub fn roundness(&self) -> f32 {
        let across = |p: &Vec2| self.hull.iter().map(|q| p.distance(*q)).fold(0.0, f32::max);
        let longest = self.hull.iter().map(across).fold(f32::MIN_POSITIVE, f32::max);
        self.hull_area / (FRAC_PI_4 * longest * longest)
    }

    /// Whether it goes over its own area again and again.
    pub fn is_scribble(&self) -> bool {
        self.length > SCRIBBLE * self.hull_area.sqrt()
    }

    /// Its stretches above a height.
    pub fn above(&self, height: f32) -> Vec<Vec<Vec2>> {
        let runs = self.points.chunk_by(|a, b| (a.y <= height) == (b.y <= height));
        runs.filter(|run| run[0].y <= height).map(<[Vec2]>::to_vec).collect()
    }

    /// Whether it is an outline that comes back to its beginning and has no deep notches.
    pub fn is_closed_and_solid(&self) -> bool {
        self.openness < 0.2 && self.solidity() > 0.8
    }

    /// Whether another line lies in the bounds of this one, which encloses much more.
    pub fn is_around(&self, other: &Shape) -> bool {
        let is_in = other.bounds.0.cmpge(self.bounds.0).all() && other.bounds.1.cmple(self.bounds.1).all();
        is_in && self.hull_area > 2.0 * other.hull_area && self.solidity() > 0.5
    }

    /// Share of the convex hull that the line encloses: 1 for convex outlines, little for stars and zigzags.
    pub fn solidity(&self) -> f32 {
        self.area / self.hull_area.max(f32::MIN_POSITIVE)
    }
}

/// Length from which a line is a scribble, in roots of the area of its hull: about twice the outline of a circle.
const SCRIBBLE: f32 = 8.0;

/// Stretch of an outline over which a notch turns, as a share of its length, and least turn there, radians.
const NOTCH: (f32, f32) = (0.05, 0.55);

/// Smallest and largest corner of some lines.
pub fn bounds<'a>(lines: impl Iterator<Item = &'a Line>) -> (Vec2, Vec2) {
    polyline::bounds(lines.flat_map(|line| [line.bounds.0, line.bounds.1]))
}

/// The value in the middle of some, of which there is one at least.
pub(super) fn median(values: &mut [f32]) -> f32 {
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f32::total_cmp).1
}

/// Least area of a bow; a quarter of a circle has 0.12.
const BOW: f32 = 0.06;

/// Whether a line bends to one side, as an arc of a cloud does: least area between it and its chord, over the square of its length.
pub(super) fn is_bow(line: &[Vec2]) -> bool {
    let length = polyline::length(line);
    simple_loop::area(line) > BOW * length * length
}

/// Notches of a closed outline of even points: places where it turns against its own direction.
pub fn notches(outline: &[Vec2]) -> Vec<Vec2> {
    bends(outline, NOTCH, -1.0)
}

/// Tips of a closed outline of even points: places where it turns over a stretch of that share of its length by that angle.
pub(super) fn tips(outline: &[Vec2], tip: (f32, f32)) -> Vec<Vec2> {
    bends(outline, tip, 1.0)
}

/// Places where a closed outline turns most: its own way where `sense` is 1, against it where that is -1.
fn bends(outline: &[Vec2], (stretch, least): (f32, f32), sense: f32) -> Vec<Vec2> {
    let n = outline.len();
    let reach = ((0.5 * stretch * n as f32) as usize).max(1);
    if n < 8 {
        return Vec::new();
    }
    let turning = sense * simple_loop::signed_area(outline.iter().copied()).signum();
    let turn = |i: usize| {
        let (before, here, after) = (outline[(i + n - reach) % n], outline[i], outline[(i + reach) % n]);
        turning * (here - before).angle_to(after - here)
    };
    let turns: Vec<f32> = (0..n).map(turn).collect();
    let is_most = |i: usize| {
        let is_more = |k: usize| turns[i] >= turns[(i + k) % n] && turns[i] > turns[(i + n - k) % n];
        turns[i] > least && (1..=reach).all(is_more)
    };
    (0..n).filter(|i| is_most(*i)).map(|i| outline[i]).collect()
}

/// A polyline at `count` even steps of its length, at least two.
pub fn even(positions: &[Vec2], count: usize) -> Vec<Vec2> {
    let arcs = polyline::arc_lengths(positions.iter().copied());
    let length = arcs.last().copied().unwrap_or(0.0);
    let last = count.max(2) - 1;
    (0..=last)
        .map(|k| polyline::interpolate(positions, polyline::locate(&arcs, length * k as f32 / last as f32)))
        .collect()
}
