//! Stems side by side, and what is drawn at the upper end of each.
//!
//! A stem is a line that is nearly straight and upright, or the lower end of a stroke that goes on into its head. All that is drawn at
//! its upper end is its head: one outline, closed or open, several loops, a spiral, a scribble, crossing rays. A short upright line
//! there is a part of the head.
//!
//! Limits: heads that touch one another share their lines by what is nearest. Cost: stems times lines, by their bounds; nothing of
//! more than [`MOST_LINES`] lines.

use crate::anatomy::conventions::page::{Line, Page, even, tips};
use crate::anatomy::conventions::shapes::lobes::winding;
use crate::geom::polyline;
use glam::Vec2;
use std::borrow::Cow;
use std::f32::consts::TAU;

/// Most lines of a drawing that is looked at.
const MOST_LINES: usize = 160;
/// Least chord of a stem over its length, and of one that bends, least rise over its run, and least length, as a share of the
/// drawing's height.
const STRAIGHT: f32 = 0.85;
const BENT: f32 = 0.65;
const UPRIGHT: f32 = 1.0;
const LONG: f32 = 0.12;
/// Least chord of a stem that goes on into its head over its length, and most of its stroke's points.
const INTO: (f32, f32) = (0.93, 0.7);
/// Points over which a stem's direction is taken where it goes on into its head, and least cosine between that and its chord.
const AHEAD: usize = 4;
const ONWARD: f32 = 0.7;
/// Largest opening of a head in one stroke with its stem, if it is not wound: an arch hangs down.
const OPEN: f32 = 0.6;
/// Longest of an upright line at a stem's end that belongs to the head there, as a share of the stem's length; farthest of it from the
/// end, as a share of its own.
const SHORT: f32 = 0.5;
const RAY: f32 = 0.6;
/// Part of a stem above which what belongs to its head has its middle.
const UPPER: f32 = 0.35;
/// How far from the end of a stem its head may be, as a share of the head's size and of the stem's length.
const AT: (f32, f32) = (0.3, 0.18);
/// Least visible stem, as a share of its head's height, the head's greatest size and the least, as shares of its stem's length, and
/// least of its narrower side in the wider.
const VISIBLE: f32 = 0.3;
const SIZE: (f32, f32) = (0.14, 1.5);
const ROUND: f32 = 0.3;
/// Farthest that a stem ends from the middle of its head, as a share of the head's width.
const AMID: f32 = 0.75;
/// Most turns of an outline that is no spiral.
const WOUND: f32 = 1.5;
/// How near heads are that touch, as a share of their size.
const BESIDE: f32 = 0.15;
/// Least area of an outline around a whole flower, as a share of the flower's bounds: that is what grows there.
const AROUND: f32 = 2.0;
/// Least width of a bed over its height, and least distance between the outer stems in it, as a share of its width.
const BED: (f32, f32) = (1.8, 0.25);
/// Points of an outline, the stretch and turn of the point of a leaf, and how far from its stem that is, as a share of its size.
const POINTS: usize = 80;
const POINT: ((f32, f32), f32) = ((0.14, 0.95), 0.7);
/// Largest of a petal drawn by itself, as a share of its head, and how many of them say that others read this head.
const PETAL: (f32, usize) = (0.7, 3);

/// What may be a stem: from its foot to its top.
pub(crate) struct Stem<'a> {
    pub number: usize,
    pub points: Vec<Vec2>,
    pub length: f32,
    /// What its stroke goes on into.
    pub rest: Option<Cow<'a, Line>>,
}

impl<'a> Stem<'a> {
    fn new(page: &'a Page, number: usize) -> Option<Self> {
        let line = &page.lines[number];
        let points = line.upward();
        let (foot, top) = (points[0], points[points.len() - 1]);
        let run = foot - top;
        let stem = if run.length() > STRAIGHT * line.length && run.y > UPRIGHT * run.x.abs() {
            Self { number, points, length: line.length, rest: None }
        } else {
            let bends = run.length() > BENT * line.length && run.y > UPRIGHT * run.x.abs();
            let whole = || Self { number, points: points.clone(), length: line.length, rest: None };
            Self::into_head(line, number, &points).or_else(|| bends.then(whole))?
        };
        (stem.length > LONG * (page.bounds.1.y - page.bounds.0.y)).then_some(stem)
    }

    /// The lower end of a stroke that goes on into a head.
    fn into_head(line: &'a Line, number: usize, points: &[Vec2]) -> Option<Self> {
        let (mut length, mut end) = (0.0, (0, 0.0));
        for k in 1..(points.len() as f32 * INTO.1) as usize {
            length += points[k].distance(points[k - 1]);
            let run = points[0] - points[k];
            let ahead = (points[k] - points[k.saturating_sub(AHEAD)]).normalize_or_zero();
            let is_up = -ahead.dot(run.normalize_or_zero()) > ONWARD;
            if is_up && run.length() > INTO.0 * length && run.y > UPRIGHT * run.x.abs() {
                end = (k, length);
            }
        }
        let rest = line.part(points[end.0..].to_vec())?;
        // It may run on through its head.
        let last = points[..=end.0].iter().take_while(|p| p.y > rest.bounds.1.y).count().max(2) - 1;
        let rest = line.part(points[last..].to_vec())?;
        let is_above = points[0].y - rest.bounds.1.y > VISIBLE * rest.size().y;
        let is_head = rest.openness < OPEN || is_wound(&rest);
        (is_above && is_head).then(|| Self {
            number,
            points: points[..=last].to_vec(),
            length: polyline::length(&points[..=last]),
            rest: Some(Cow::Owned(rest)),
        })
    }

    /// Whether it is far from straight.
    pub(super) fn bends(&self) -> bool {
        self.foot().distance(self.top()) < STRAIGHT * self.length
    }

    pub(super) fn foot(&self) -> Vec2 {
        self.points[0]
    }

    pub(super) fn top(&self) -> Vec2 {
        self.points[self.points.len() - 1]
    }
}

/// A stem and what is drawn at its end.
pub(crate) struct Flower<'a> {
    pub stem: Stem<'a>,
    /// Lines of the head, without the end of the stem's own stroke.
    pub head: Vec<usize>,
    /// Smallest and largest corner of the head.
    pub bounds: (Vec2, Vec2),
}

/// The stems of a page with what is drawn at their upper ends.
pub(crate) fn upright(page: &Page) -> Vec<Flower<'_>> {
    if page.lines.len() > MOST_LINES {
        return Vec::new();
    }
    let numbers = (0..page.lines.len()).filter(|i| !page.is_apart(*i));
    let mut stems: Vec<Stem> = numbers.clone().filter_map(|i| Stem::new(page, i)).collect();
    stems.sort_by(|a, b| b.length.total_cmp(&a.length).then(a.number.cmp(&b.number)));
    let mut flowers: Vec<Flower> = Vec::new();
    for stem in stems {
        let middle = page.lines[stem.number].middle();
        // An upright line at the end of a longer one is a ray or a petal of that.
        let is_ray = |flower: &Flower| {
            let is_short = stem.length < SHORT * flower.stem.length;
            let line = &page.lines[stem.number];
            middle.distance(flower.stem.top()) < RAY * stem.length || is_short && flower.carries(line)
        };
        if !flowers.iter().any(is_ray) {
            let bounds = stem.rest.as_ref().map_or((stem.top(), stem.top()), |rest| rest.bounds);
            flowers.push(Flower { stem, head: Vec::new(), bounds });
        }
    }
    gather(page, &mut flowers);
    flowers
}

/// Takes to each stem the lines at its end.
fn gather(page: &Page, flowers: &mut [Flower]) {
    let mut stems: Vec<usize> = flowers.iter().map(|flower| flower.stem.number).collect();
    stems.sort_unstable();
    let numbers = (0..page.lines.len()).filter(|i| !page.is_apart(*i));
    for i in numbers.filter(|i| stems.binary_search(i).is_err()) {
        let line = &page.lines[i];
        let away = |flower: &Flower| line.middle().distance(flower.stem.top());
        let carrying = flowers.iter_mut().filter(|flower| flower.carries(line));
        if let Some(flower) = carrying.min_by(|a, b| away(a).total_cmp(&away(b))) {
            flower.head.push(i);
        }
    }
    for flower in flowers {
        flower.bounds = flower
            .lines(page)
            .map(|line| line.bounds)
            .fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(low, high), line| {
                (low.min(line.0), high.max(line.1))
            });
    }
}

/// Whether stems stand side by side within two corners that are wider than high, as in a bed.
pub(crate) fn stand_in_bed(stems: &[Flower], (low, high): (Vec2, Vec2)) -> bool {
    let size = high - low;
    size.x > BED.0 * size.y && feet_within(stems, (low, high)).1 > BED.1 * size.x
}

/// Feet of stems that carry something, whatever that is, within two corners: how many, and how far apart the outer ones are.
pub(crate) fn feet_within(stems: &[Flower], (low, high): (Vec2, Vec2)) -> (usize, f32) {
    let feet = stems.iter().filter(|flower| !flower.is_bare()).map(|flower| flower.stem.foot());
    let within = feet.filter(|foot| foot.cmpgt(low).all() && foot.cmplt(high).all());
    let none = (0, f32::INFINITY, f32::NEG_INFINITY);
    let (count, left, right) =
        within.fold(none, |(count, left, right), foot| (count + 1, left.min(foot.x), right.max(foot.x)));
    (count, (right - left).max(0.0))
}

impl Flower<'_> {
    /// Whether a line is at the end of the stem.
    fn carries(&self, line: &Line) -> bool {
        let (foot, top) = (self.stem.foot(), self.stem.top());
        let margin = AT.0 * line.size().max_element() + AT.1 * self.stem.length;
        let is_at = top.cmpgt(line.bounds.0 - margin).all() && top.cmplt(line.bounds.1 + margin).all();
        let is_high = line.middle().y < foot.y - UPPER * (foot.y - top.y);
        is_at && is_high && line.size().max_element() < SIZE.1 * self.stem.length
    }

    /// Whether another stem ends in the head, which stands on a trunk of two lines then.
    pub(super) fn stands_on(&self, other: &Self) -> bool {
        other.stem.length > SHORT * self.stem.length && self.holds(other.stem.top())
    }

    /// Whether a place is in the head, or nearly.
    fn holds(&self, p: Vec2) -> bool {
        let margin = 0.1 * self.size();
        p.cmpgt(self.bounds.0 - margin).all() && p.cmplt(self.bounds.1 + margin).all()
    }

    /// The lines of the head, the end of the stem's own stroke first.
    pub(super) fn lines<'a>(&'a self, page: &'a Page) -> impl Iterator<Item = &'a Line> {
        self.stem.rest.as_deref().into_iter().chain(self.head.iter().map(|i| &page.lines[*i]))
    }

    /// Width and height of the head.
    pub(super) fn size(&self) -> Vec2 {
        self.bounds.1 - self.bounds.0
    }

    /// Whether the head of another is hardly apart from this one.
    pub(super) fn is_beside(&self, other: &Self) -> bool {
        let margin = BESIDE * self.size().max(other.size());
        (self.bounds.0 - margin).cmplt(other.bounds.1).all()
            && (self.bounds.1 + margin).cmpgt(other.bounds.0).all()
    }

    /// Whether all of it lies in another line's outline.
    pub(super) fn is_inside(&self, page: &Page) -> bool {
        let (low, high) = (self.bounds.0.min(self.stem.foot()), self.bounds.1.max(self.stem.foot()));
        let area = (high - low).element_product();
        let is_around = |line: &Line| {
            line.bounds.0.cmplt(low).all() && line.bounds.1.cmpgt(high).all() && line.area > AROUND * area
        };
        (0..page.lines.len()).any(|i| !page.is_apart(i) && is_around(&page.lines[i]))
    }

    /// Length of the stem below the head, in heights of the head.
    pub(super) fn visible(&self) -> f32 {
        (self.stem.foot().y - self.bounds.1.y) / self.size().y.max(f32::MIN_POSITIVE)
    }

    /// Whether stem and head have the proportions of a flower.
    pub(super) fn is_of_form(&self, page: &Page) -> bool {
        let size = self.size();
        let length = self.stem.length;
        let aside = (self.stem.top().x - 0.5 * (self.bounds.0.x + self.bounds.1.x)).abs();
        size.is_finite()
            && (SIZE.0 * length..SIZE.1 * length).contains(&size.max_element())
            && size.min_element() > ROUND * size.max_element()
            && self.visible() > VISIBLE
            && aside < AMID * size.x
            && self.lines(page).count() > 0
            && self.petals_drawn_one_by_one(page) < PETAL.1
    }

    /// Whether nothing is drawn at the end of the stem.
    pub(super) fn is_bare(&self) -> bool {
        self.head.is_empty() && self.stem.rest.is_none()
    }

    /// How many of its lines are outlines much smaller than the head: these are petals already.
    fn petals_drawn_one_by_one(&self, page: &Page) -> usize {
        let most = PETAL.0 * self.size().length();
        self.lines(page).filter(|line| line.is_closed_and_solid() && line.size().length() < most).count()
    }
}

/// Tips of the convex hull of a head, which tremor and notches leave alone: over such a share of it, at least so sharp, radians.
pub(super) fn tips_of_hull(head: &Line, tip: (f32, f32)) -> Vec<Vec2> {
    let ring: Vec<Vec2> = head.hull.iter().chain(head.hull.first()).copied().collect();
    tips(&even(&ring, POINTS)[1..], tip)
}

/// Whether the outline of a head has one rounded point, away from where its stem ends: that of a leaf. The ends of an ellipse are two.
pub(super) fn points_away(head: &Line, root: Vec2) -> bool {
    let [tip] = tips_of_hull(head, POINT.0)[..] else { return false };
    head.is_closed_and_solid() && tip.distance(root) > POINT.1 * head.size().max_element()
}

/// Whether a line winds around its middle more often than an outline does.
pub(super) fn is_wound(line: &Line) -> bool {
    winding(&line.points, line.middle()) > WOUND * TAU
}
