//! Which branch grows on which (002 §4.2).
//!
//! The longest branch is a trunk; then, level by level, branches whose nearer end touches a branch of the level
//! before become its children. Where no branch can be matched any more, the longest of the rest is the trunk of
//! another plant. "Touches" means nearer than a share of the drawing's diagonal and of the branch itself. Only ends
//! attach, so crossing branches stay strangers; and a twig whose end lies on one branch is not taken by another that
//! merely passes near: while its nearest branch is still unplaced, it waits for it.
//!
//! Either end may be the base: the one that touches. A trunk's base is its lower end, unless it lies level, where the
//! artist's direction counts. Cost: near-linear, through an R-tree over all segments.

use super::{FlatBranch, Sample};
use crate::geom::{
    polyline,
    region::{Near, SegmentIndex},
};
use crate::sketch::StrokeId;
use glam::Vec2;

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

/// Height difference, as a share of length, below which a trunk lies level.
const LEVEL_SHARE: f32 = 0.1;

/// A place where an end of one branch touches another branch.
#[derive(Clone, Copy)]
struct Touch {
    place: Near,
    /// Whether it is the last sample that touches, not the first.
    by_last: bool,
}

/// All places where a branch touches others, nearest first; the first `close` of them are as good as the nearest.
struct Touches {
    all: Vec<Touch>,
    close: usize,
}

/// Arranges lines into a forest of branches, parents before children, level by level.
pub fn arrange(
    lines: Vec<(Option<StrokeId>, Vec<Sample>)>,
    diagonal: f32,
    params: &HierarchyParams,
) -> Vec<FlatBranch> {
    let flat: Vec<Vec<Vec2>> = lines.iter().map(|(_, line)| line.iter().map(|s| s.position).collect()).collect();
    let lengths: Vec<f32> = flat.iter().map(|line| polyline::length(line)).collect();
    let touches = find_touches(&flat, &lengths, diagonal, params);
    let mut touched_by = vec![Vec::new(); lines.len()];
    for (child, touches) in touches.iter().enumerate() {
        for touch in &touches.all {
            touched_by[touch.place.line].push(child);
        }
    }

    let mut longest_first: Vec<usize> = (0..lines.len()).collect();
    longest_first.sort_by(|&a, &b| lengths[b].total_cmp(&lengths[a]).then(a.cmp(&b)));

    let (seats, wave_of) = (vec![None; lines.len()], vec![0; lines.len()]);
    let mut forest = Forest { touches, touched_by, lengths, seats, order: Vec::new(), wave: 0, wave_of };
    for trunk in longest_first {
        if forest.seats[trunk].is_none() {
            forest.plant(trunk, is_upside_down(&flat[trunk], forest.lengths[trunk]));
        }
    }
    forest.into_branches(lines, &flat)
}

fn find_touches(flat: &[Vec<Vec2>], lengths: &[f32], diagonal: f32, params: &HierarchyParams) -> Vec<Touches> {
    let index = SegmentIndex::new(flat.iter().map(Vec::as_slice));
    let touches_of = |(i, line): (usize, &Vec<Vec2>)| {
        let radius = (params.attach_distance * diagonal).min(params.attach_share * lengths[i]);
        let ends = line.first().map(|&p| (p, false)).into_iter().chain(line.last().map(|&p| (p, true)));
        let mut all: Vec<Touch> = ends
            .flat_map(|(end, by_last)| index.within(end, radius).into_iter().map(move |place| Touch { place, by_last }))
            .filter(|touch| touch.place.line != i)
            .collect();
        all.sort_by(|a, b| a.place.distance.total_cmp(&b.place.distance).then(a.place.line.cmp(&b.place.line)));
        let good = all.first().map_or(0.0, |t| t.place.distance) + PATIENCE * radius;
        let close = all.partition_point(|t| t.place.distance <= good);
        Touches { all, close }
    };
    flat.iter().enumerate().map(touches_of).collect()
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

struct Forest {
    touches: Vec<Touches>,
    /// For every branch those that touch it.
    touched_by: Vec<Vec<usize>>,
    lengths: Vec<f32>,
    seats: Vec<Option<Seat>>,
    /// Branches in the order in which they were placed.
    order: Vec<usize>,
    /// Number of the current search for children, and for every branch the last one in which it was a parent.
    wave: u32,
    wave_of: Vec<u32>,
}

impl Forest {
    /// Places a trunk and everything that hangs on it.
    fn plant(&mut self, trunk: usize, reversed: bool) {
        let first = self.order.len();
        self.seats[trunk] = Some(Seat { parent: None, level: 0, reversed });
        self.order.push(trunk);
        let mut frontier = vec![trunk];
        while !frontier.is_empty() {
            frontier = self.next_level(&frontier, |t| &t.all[..t.close]);
            if frontier.is_empty() {
                let tree = self.order[first..].to_vec();
                frontier = self.next_level(&tree, |t| &t.all);
            }
        }
    }

    /// Places the branches that touch one of `parents`, longest first, each on the nearest.
    fn next_level(&mut self, parents: &[usize], eligible: impl Fn(&Touches) -> &[Touch]) -> Vec<usize> {
        self.wave += 1;
        for &parent in parents {
            self.wave_of[parent] = self.wave;
        }
        let mut children: Vec<usize> = parents
            .iter()
            .flat_map(|&p| &self.touched_by[p])
            .copied()
            .filter(|&child| self.seats[child].is_none())
            .collect();
        children.sort_by(|&a, &b| self.lengths[b].total_cmp(&self.lengths[a]).then(a.cmp(&b)));
        children.dedup();
        let mut placed = Vec::new();
        for child in children {
            let is_parent = |t: &&Touch| self.wave_of[t.place.line] == self.wave;
            let Some(&touch) = eligible(&self.touches[child]).iter().find(is_parent) else { continue };
            let parent = touch.place.line;
            let level = self.seats[parent].map_or(0, |seat| seat.level) + 1;
            self.seats[child] = Some(Seat { parent: Some((parent, touch.place)), level, reversed: touch.by_last });
            self.order.push(child);
            placed.push(child);
        }
        placed
    }

    /// The forest as branches, every line turned to begin at its base.
    fn into_branches(self, mut lines: Vec<(Option<StrokeId>, Vec<Sample>)>, flat: &[Vec<Vec2>]) -> Vec<FlatBranch> {
        let mut index_of = vec![0; lines.len()];
        for (new, &old) in self.order.iter().enumerate() {
            index_of[old] = new;
        }
        let seat_of = |i: usize| self.seats[i].unwrap_or(Seat { parent: None, level: 0, reversed: false });
        let attached_at = |place: Near, parent: usize| {
            let line = &flat[parent];
            let before = polyline::length(&line[..=place.segment]);
            let arc = before + place.share * line[place.segment].distance(line[place.segment + 1]);
            if seat_of(parent).reversed { self.lengths[parent] - arc } else { arc }
        };
        let branch = |&old: &usize| {
            let seat = seat_of(old);
            let (stroke, mut line) = std::mem::take(&mut lines[old]);
            if seat.reversed {
                line.reverse();
            }
            FlatBranch {
                stroke,
                line,
                parent: seat.parent.map(|(parent, _)| index_of[parent]),
                attached_at: seat.parent.map_or(0.0, |(parent, place)| attached_at(place, parent)),
                level: seat.level,
            }
        };
        self.order.iter().map(branch).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(id: StrokeId, points: &[(f32, f32)]) -> (Option<StrokeId>, Vec<Sample>) {
        let sample = |&(x, y): &(f32, f32)| Sample { position: Vec2::new(x, y), pressure: 0.5, tilt_deg: Vec2::ZERO };
        (Some(id), points.iter().map(sample).collect())
    }

    fn arranged(lines: &[(Option<StrokeId>, Vec<Sample>)]) -> Vec<(u64, Option<u64>, u32)> {
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
    fn nothing_gives_nothing() {
        assert!(arrange(Vec::new(), 0.0, &HierarchyParams::default()).is_empty());
    }
}
