//! Which branch grows on which (002 §4.2).
//!
//! The longest branch is a trunk; then, level by level, branches whose nearer end touches a branch of the level
//! before become its children. Where no branch can be matched any more, the longest of the rest is the trunk of
//! another plant. "Touches" means nearer than a share of the drawing's diagonal and of the branch itself. Only ends
//! attach, so crossing branches stay strangers; and a twig whose end lies on one branch is not taken by another that
//! merely passes near: while its nearest branch is still unplaced, it waits for it.
//!
//! A trunk may be shorter than its boughs: the only branch that goes down from the base of the longest carries that.
//!
//! Either end may be the base: the one that touches. A trunk's base is its lower end, unless it lies level, where the
//! artist's direction counts. Cost: near-linear, through an R-tree over all segments.

use super::{FlatBranch, Sample};
use crate::geom::{
    line_changes::LineChanges,
    segment_index::{Line, Near, SegmentIndex},
};
use crate::kept::{Kept, Same};
use crate::sketch::StrokeId;
use glam::Vec2;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Arc;

crate::parameters! {
    /// How branches find the branch they grow on.
    pub struct HierarchyParams {
        /// Farthest gap between a branch's end and its parent.
        attach_distance: f32 = 0.025, 0.001..=0.2, "of the drawing's diagonal";
        /// The same, relative to the branch itself, so that specks do not attach from afar.
        attach_share: f32 = 0.35, 0.01..=1.0, "of the branch's length";
    }
}

/// How much farther than its nearest neighbour a branch may be from the parent it takes, as a share of the threshold.
const PATIENCE: f32 = 0.2;

/// Most neighbours that an end remembers. Where more meet in one spot, the longest of those that are as good as the
/// nearest are kept, so that the trunk is among them.
const MOST_TOUCHES: usize = 16;

/// Height difference, as a share of length, below which a trunk lies level.
const LEVEL_SHARE: f32 = 0.1;

/// How near to a trunk's base its lower part in a stroke of its own ends, as a share of the trunk's length; least fall of that
/// over its length, and least length, as a share of the trunk's.
const LOWER_PART: (f32, f32, f32) = (0.08, 0.7, 0.15);

/// A place where an end of one branch touches another branch.
#[derive(Clone, Copy, Debug)]
struct Touch {
    place: Near,
    /// Whether it is the last sample that touches, not the first.
    by_last: bool,
}

/// All places where a branch touches others, nearest first; the first `close` of them are as good as the nearest.
#[derive(Debug, Default)]
struct Touches {
    all: Vec<Touch>,
    close: usize,
}

/// Branches with the lines that were measured on the way.
#[derive(Debug, Default)]
pub struct Arranged {
    /// Parents before children, level by level.
    pub branches: Vec<FlatBranch>,
    /// The line of each.
    pub lines: Vec<Arc<Line>>,
}

/// Lines that begin at their other ends, by the lines as they were drawn.
type Turned = Kept<Same<[Sample]>, (Arc<[Sample]>, Arc<Line>)>;

/// What is remembered of one drawing's branches for the next: where the ends of each touch others. Only those are looked for
/// again near which a branch came or went.
#[derive(Debug, Default)]
pub struct Arranger {
    measured: Kept<Same<[Sample]>, Arc<Line>>,
    turned: Turned,
    diagonal: f32,
    lines: Vec<Arc<Line>>,
    touches: Vec<Touches>,
}

/// Arranges lines into a forest of branches, parents before children, level by level.
pub fn arrange(
    lines: Vec<(Option<StrokeId>, Arc<[Sample]>)>,
    diagonal: f32,
    params: &HierarchyParams,
) -> Vec<FlatBranch> {
    arrange_with(&mut Arranger::for_one_build(), lines, diagonal, params).branches
}

/// The very forest that [`arrange`] gives, again and again while a drawing changes.
pub fn arrange_with(
    known: &mut Arranger,
    lines: Vec<(Option<StrokeId>, Arc<[Sample]>)>,
    diagonal: f32,
    params: &HierarchyParams,
) -> Arranged {
    let line_of =
        |(_, samples): &(_, Arc<[Sample]>)| Arc::new(Line::new(samples.iter().map(|s: &Sample| s.position)));
    let flat = known.measured.made(&lines, |(_, samples), used| Same::of(samples, used), line_of).to_vec();
    known.find_touches(&flat, diagonal, params);
    let mut touched_by = vec![Vec::new(); lines.len()];
    for (child, touches) in known.touches.iter().enumerate() {
        for touch in &touches.all {
            touched_by[touch.place.line].push(child);
        }
    }

    let lengths: Vec<f32> = flat.iter().map(|line| line.length()).collect();
    let mut longest_first: Vec<usize> = (0..lines.len()).collect();
    longest_first.sort_by(|&a, &b| lengths[b].total_cmp(&lengths[a]).then(a.cmp(&b)));

    let (seats, placed_as) = (vec![None; lines.len()], vec![usize::MAX; lines.len()]);
    let touches = &known.touches;
    let mut forest = Forest { touches, touched_by, lengths, seats, order: Vec::new(), placed_as };
    for trunk in longest_first {
        if forest.seats[trunk].is_none() {
            let trunk = forest.carrying(trunk, &flat).unwrap_or(trunk);
            forest.plant(trunk, is_upside_down(&flat[trunk].points, forest.lengths[trunk]));
        }
    }
    forest.into_arranged(lines, &flat, &mut known.turned)
}

impl Arranger {
    /// For a single drawing, of which nothing is kept by name.
    pub fn for_one_build() -> Self {
        Self { measured: Kept::for_one_call(), turned: Kept::for_one_call(), ..Self::default() }
    }

    /// Finds where each of these lines touches others.
    fn find_touches(&mut self, lines: &[Arc<Line>], diagonal: f32, params: &HierarchyParams) {
        let radii: Vec<f32> = lines
            .iter()
            .map(|line| (params.attach_distance * diagonal).min(params.attach_share * line.length()))
            .collect();
        let changes = LineChanges::between(&self.lines, lines);
        let mut old = std::mem::take(&mut self.touches);
        let mut known_of = |(i, (line, radius)): (usize, (&Arc<Line>, &f32))| {
            let number = changes.old_number(i).filter(|_| diagonal == self.diagonal)?;
            let is_as_it_was = |end: Option<&Vec2>| end.is_none_or(|end| !changes.may_matter(*end, *radius));
            if !is_as_it_was(line.points.first()) || !is_as_it_was(line.points.last()) {
                return None;
            }
            let mut touches = std::mem::take(old.get_mut(number)?);
            for touch in &mut touches.all {
                touch.place.line = changes.new_number(touch.place.line)?;
            }
            Some(touches)
        };
        let known: Vec<Option<Touches>> = lines.iter().zip(&radii).enumerate().map(&mut known_of).collect();
        let missing = known.iter().filter(|known| known.is_none()).count();
        let index = SegmentIndex::new(lines.to_vec(), 2 * missing);
        let touches_of = |(i, known): (usize, Option<Touches>)| {
            known.unwrap_or_else(|| Touches::of(i, lines, radii[i], &index))
        };
        self.touches = known.into_par_iter().with_min_len(64).enumerate().map(touches_of).collect();
        (self.lines, self.diagonal) = (lines.to_vec(), diagonal);
    }
}

impl Touches {
    /// Those of line `i`.
    fn of(i: usize, lines: &[Arc<Line>], radius: f32, index: &SegmentIndex) -> Self {
        let line = &lines[i].points;
        let ends = line.first().map(|&p| (p, false)).into_iter().chain(line.last().map(|&p| (p, true)));
        let mut all: Vec<Touch> = ends
            .flat_map(|(end, by_last)| {
                let mut places = index.within(end, radius);
                places.retain(|place| place.line != i);
                keep_best(&mut places, lines, PATIENCE * radius);
                places.into_iter().map(move |place| Touch { place, by_last })
            })
            .collect();
        all.sort_by(|a, b| {
            a.place.distance.total_cmp(&b.place.distance).then(a.place.line.cmp(&b.place.line))
        });
        let good = all.first().map_or(0.0, |t| t.place.distance) + PATIENCE * radius;
        let close = all.partition_point(|t| t.place.distance <= good);
        Self { all, close }
    }
}

/// Keeps [`MOST_TOUCHES`] places: first the longest lines among those within `slack` of the nearest, then the nearest.
fn keep_best(places: &mut Vec<Near>, lines: &[Arc<Line>], slack: f32) {
    if places.len() <= MOST_TOUCHES {
        return;
    }
    let good = places.iter().map(|p| p.distance).fold(f32::INFINITY, f32::min) + slack;
    let rank = |p: &Near| if p.distance <= good { (0.0, -lines[p.line].length()) } else { (p.distance, 0.0) };
    places.sort_by(|a, b| {
        let (a_rank, b_rank) = (rank(a), rank(b));
        a_rank.0.total_cmp(&b_rank.0).then(a_rank.1.total_cmp(&b_rank.1)).then(a.line.cmp(&b.line))
    });
    places.truncate(MOST_TOUCHES);
}

fn is_upside_down(line: &[Vec2], length: f32) -> bool {
    match (line.first(), line.last()) {
        (Some(first), Some(last)) => last.y - first.y > LEVEL_SHARE * length,
        _ => false,
    }
}

/// Where a branch was placed.
#[derive(Clone, Copy)]
struct Seat {
    parent: Option<(usize, Near)>,
    level: u32,
    reversed: bool,
}

struct Forest<'a> {
    touches: &'a [Touches],
    /// For every branch those that touch it.
    touched_by: Vec<Vec<usize>>,
    lengths: Vec<f32>,
    seats: Vec<Option<Seat>>,
    /// Branches in the order in which they were placed.
    order: Vec<usize>,
    /// For every branch its index in `order`, `usize::MAX` while it has none.
    placed_as: Vec<usize>,
}

impl Forest<'_> {
    /// The only branch that goes down from the base of a trunk: the lower part of it in a stroke of its own.
    fn carrying(&self, trunk: usize, flat: &[Arc<Line>]) -> Option<usize> {
        let ends = |line: &Line| Some((*line.points.first()?, *line.points.last()?));
        let (first, last) = ends(&flat[trunk])?;
        let base = if is_upside_down(&flat[trunk].points, self.lengths[trunk]) { last } else { first };
        let goes_down = |branch: &&usize| {
            let length = self.lengths[**branch];
            let touch = self.touches[**branch].all.iter().find(|touch| touch.place.line == trunk);
            let Some((touch, (first, last))) = touch.zip(ends(&flat[**branch])) else { return false };
            let (upper, lower) = if touch.by_last { (last, first) } else { (first, last) };
            self.seats[**branch].is_none()
                && upper.distance(base) < LOWER_PART.0 * self.lengths[trunk]
                && lower.y - upper.y > LOWER_PART.1 * length
                && length > LOWER_PART.2 * self.lengths[trunk]
        };
        let mut below = self.touched_by[trunk].iter().filter(goes_down);
        below.next().copied().filter(|_| below.next().is_none())
    }

    /// Places a trunk and everything that hangs on it. Branches that only touch from afar wait until no others are left.
    fn plant(&mut self, trunk: usize, reversed: bool) {
        let first = self.order.len();
        self.place(trunk, Seat { parent: None, level: 0, reversed });
        let (mut parents, mut waiting) = (first..self.order.len(), Vec::new());
        while !parents.is_empty() {
            let touched = parents.clone().flat_map(|k| &self.touched_by[self.order[k]]).copied().collect();
            let end = self.order.len();
            waiting.extend(self.next_level(touched, parents, |t| &t.all[..t.close]));
            if self.order.len() == end {
                // Each of these touches the tree, so that none of them is left over.
                self.next_level(std::mem::take(&mut waiting), first..end, |t| &t.all);
            }
            parents = end..self.order.len();
        }
    }

    fn place(&mut self, branch: usize, seat: Seat) {
        self.seats[branch] = Some(seat);
        self.placed_as[branch] = self.order.len();
        self.order.push(branch);
    }

    /// Places those of `children` that touch one of the `parents` (a stretch of `order`), longest first, each on the
    /// nearest; gives those that found none.
    fn next_level(
        &mut self,
        mut children: Vec<usize>,
        parents: Range<usize>,
        eligible: impl Fn(&Touches) -> &[Touch],
    ) -> Vec<usize> {
        children.retain(|&child| self.seats[child].is_none());
        children.sort_by(|&a, &b| self.lengths[b].total_cmp(&self.lengths[a]).then(a.cmp(&b)));
        children.dedup();
        children.retain(|&child| {
            let is_parent = |t: &&Touch| parents.contains(&self.placed_as[t.place.line]);
            let Some(&touch) = eligible(&self.touches[child]).iter().find(is_parent) else { return true };
            let parent = touch.place.line;
            let level = self.seats[parent].map_or(0, |seat| seat.level) + 1;
            self.place(child, Seat { parent: Some((parent, touch.place)), level, reversed: touch.by_last });
            false
        });
        children
    }

    /// The forest as branches, every line turned to begin at its base.
    fn into_arranged(
        self,
        mut lines: Vec<(Option<StrokeId>, Arc<[Sample]>)>,
        flat: &[Arc<Line>],
        turned: &mut Turned,
    ) -> Arranged {
        let mut index_of = vec![0; lines.len()];
        for (new, &old) in self.order.iter().enumerate() {
            index_of[old] = new;
        }
        let seat_of = |i: usize| self.seats[i].unwrap_or(Seat { parent: None, level: 0, reversed: false });
        let upside_down: Vec<Arc<[Sample]>> = self
            .order
            .iter()
            .filter(|&&old| seat_of(old).reversed)
            .map(|&old| lines[old].1.clone())
            .collect();
        let mut turned = turned.made(&upside_down, Same::of, |line| turned_round(line)).iter().cloned();
        let attached_at = |place: Near, parent: usize| {
            let line = &flat[parent];
            let (from, to) = (line.points[place.segment], line.points[place.segment + 1]);
            let arc = line.arcs[place.segment] + place.share * from.distance(to);
            if seat_of(parent).reversed { self.lengths[parent] - arc } else { arc }
        };
        let mut arranged = Arranged::default();
        for &old in &self.order {
            let seat = seat_of(old);
            let (stroke, line) = std::mem::take(&mut lines[old]);
            let as_drawn = (line, Arc::clone(&flat[old]));
            let (line, measured) = if seat.reversed { turned.next().unwrap_or(as_drawn) } else { as_drawn };
            arranged.branches.push(FlatBranch {
                half_width: None,
                stroke,
                key: stroke.unwrap_or(old as u64),
                line,
                parent: seat.parent.map(|(parent, _)| index_of[parent]),
                attached_at: seat.parent.map_or(0.0, |(parent, place)| attached_at(place, parent)),
                level: seat.level,
            });
            arranged.lines.push(measured);
        }
        arranged
    }
}

/// A line that begins at its other end.
fn turned_round(line: &[Sample]) -> (Arc<[Sample]>, Arc<Line>) {
    let turned: Arc<[Sample]> = line.iter().rev().copied().collect();
    let measured = Line::new(turned.iter().map(|s| s.position));
    (turned, Arc::new(measured))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(id: StrokeId, points: &[(f32, f32)]) -> (Option<StrokeId>, Arc<[Sample]>) {
        let sample =
            |&(x, y): &(f32, f32)| Sample { position: Vec2::new(x, y), pressure: 0.5, tilt_deg: Vec2::ZERO };
        (Some(id), points.iter().map(sample).collect())
    }

    fn arranged(lines: &[(Option<StrokeId>, Arc<[Sample]>)]) -> Vec<(u64, Option<u64>, u32)> {
        let branches = arrange(lines.to_vec(), 1000.0, &HierarchyParams::default());
        let id = |b: &FlatBranch| b.stroke.unwrap_or(0);
        branches.iter().map(|b| (id(b), b.parent.map(|p| id(&branches[p])), b.level)).collect()
    }

    #[test]
    fn three_levels_with_either_end_as_base() {
        let lines = [
            line(1, &[(500.0, 900.0), (500.0, 100.0)]),
            line(2, &[(800.0, 300.0), (505.0, 500.0)]),
            line(3, &[(700.0, 370.0), (720.0, 200.0)]),
        ];
        assert_eq!(arranged(&lines), [(1, None, 0), (2, Some(1), 1), (3, Some(2), 2)]);
        let branches = arrange(lines.to_vec(), 1000.0, &HierarchyParams::default());
        assert_eq!(branches[1].line[0].position, Vec2::new(505.0, 500.0));
        assert!((branches[1].attached_at - 400.0).abs() < 1e-3);
    }

    #[test]
    fn a_trunk_drawn_downward_is_turned_and_attachments_follow() {
        let lines = [line(1, &[(500.0, 100.0), (500.0, 900.0)]), line(2, &[(500.0, 300.0), (700.0, 200.0)])];
        let branches = arrange(lines.to_vec(), 1000.0, &HierarchyParams::default());
        assert_eq!(branches[0].line[0].position.y, 900.0);
        assert!((branches[1].attached_at - 600.0).abs() < 1e-3);
    }

    #[test]
    fn a_trunk_shorter_than_its_boughs_carries_them() {
        let trunk = line(1, &[(0.0, 0.0), (0.0, -100.0)]);
        let boughs = [(2, -80.0), (3, 0.0), (4, 80.0)].map(|(id, x)| line(id, &[(0.0, -100.0), (x, -260.0)]));
        let all: Vec<_> = [trunk].into_iter().chain(boughs).collect();
        assert_eq!(arranged(&all), [(1, None, 0), (2, Some(1), 1), (4, Some(1), 1), (3, Some(1), 1)]);
        let root = line(5, &[(0.0, 0.0), (-30.0, 60.0)]);
        let other = line(6, &[(0.0, 0.0), (30.0, 60.0)]);
        let stem = line(1, &[(0.0, 0.0), (0.0, -300.0)]);
        assert_eq!(arranged(&[stem, root, other])[0], (1, None, 0), "several are roots");
    }

    #[test]
    fn crossing_branches_and_two_plants_stay_apart() {
        let lines = [
            line(1, &[(100.0, 900.0), (600.0, 100.0)]),
            line(2, &[(600.0, 890.0), (110.0, 120.0)]),
            line(3, &[(900.0, 900.0), (900.0, 500.0)]),
        ];
        assert!(arranged(&lines).iter().all(|(_, parent, level)| parent.is_none() && *level == 0));
    }

    #[test]
    fn a_twig_waits_for_the_branch_it_really_touches() {
        // The twig (3) starts on branch 2, and the trunk passes 15 px away, within the threshold.
        let lines = [
            line(1, &[(500.0, 900.0), (500.0, 100.0)]),
            line(2, &[(500.0, 600.0), (515.0, 400.0), (560.0, 250.0)]),
            line(3, &[(515.0, 400.0), (620.0, 330.0)]),
        ];
        assert_eq!(arranged(&lines)[2], (3, Some(2), 2));
    }

    #[test]
    fn many_branches_from_one_spot_remember_few_of_each_other() {
        let tip = |k: usize| Vec2::from_angle(k as f32) * (100.0 + k as f32);
        let flat: Vec<Vec<Vec2>> = (0..300).map(|k| vec![Vec2::ZERO, tip(k)]).collect();
        let lines: Vec<Arc<Line>> =
            flat.iter().map(|line| Arc::new(Line::new(line.iter().copied()))).collect();
        let mut known = Arranger::default();
        known.find_touches(&lines, 800.0, &HierarchyParams::default());
        assert!(known.touches.iter().all(|t| t.all.len() <= 2 * MOST_TOUCHES));

        let sample = |line: &Vec<Vec2>| (None, line.iter().map(|&p| Sample::neutral(p)).collect());
        let branches = arrange(flat.iter().map(sample).collect(), 800.0, &HierarchyParams::default());
        assert_eq!(branches.iter().filter(|b| b.parent.is_none()).count(), 1);
        assert!(branches[1..].iter().all(|b| b.parent == Some(0)));
    }

    #[test]
    fn nothing_gives_nothing() {
        assert!(arrange(Vec::new(), 0.0, &HierarchyParams::default()).is_empty());
    }
}
