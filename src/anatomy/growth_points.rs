//! Where twigs and leaves sprout: places at equal distance along the branches inside an outline (000 §3.5.1, steps 3
//! and 4).

use super::{Attachment, FlatBranch, Sample};
use crate::budget::Budget;
use crate::geom::region::Region;
use crate::random::mix;
use crate::sketch::StrokeId;
use glam::Vec2;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use std::ops::Range;
use std::sync::Arc;

/// A place from which something grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrowthPoint {
    /// Canvas position, pixels.
    pub position: Vec2,
    /// Unit direction of the branch there.
    pub direction: Vec2,
    /// The branch and the arc length on it; `None` where there is no branch.
    pub attachment: Option<Attachment>,
    /// The side to which it grows: 1 or −1, 0 for straight on.
    pub side: f32,
    /// Name of its random streams; what grows here inherits it.
    pub key: u64,
}

impl GrowthPoint {
    /// The unit direction in which something leaves, `departure` ± `scatter` degrees from the branch's.
    pub fn heading(&self, departure: f32, scatter: f32, rng: &mut Pcg64Mcg) -> Vec2 {
        let turn = self.side * departure + scatter * rng.random_range(-1.0..1.0f32);
        Vec2::from_angle(turn.to_radians()).rotate(self.direction)
    }
}

/// Boxes of branches that are compared in the time of one look at a sample.
const BOXES_PER_LOOK: usize = 8;

/// The side of the `number`-th growth point: they alternate.
pub fn side(number: usize) -> f32 {
    if number.is_multiple_of(2) { 1.0 } else { -1.0 }
}

/// Branches as they grow: parents before children, drawn ones first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Forest {
    branches: Vec<FlatBranch>,
    /// Smallest and largest corner of each branch.
    boxes: Vec<(Vec2, Vec2)>,
    drawn: usize,
    /// Samples of generated twigs.
    samples: usize,
    /// How much more may be looked at, see [`Budget::outline_looks`].
    looks: usize,
}

impl Forest {
    /// The drawn branches.
    pub fn new(branches: Vec<FlatBranch>) -> Self {
        let boxes = branches.iter().map(box_of).collect();
        Self { drawn: branches.len(), branches, boxes, samples: 0, looks: Budget::PLANT.outline_looks }
    }

    /// All branches.
    pub fn branches(&self) -> &[FlatBranch] {
        &self.branches
    }

    /// All branches, by value.
    pub fn into_branches(self) -> Vec<FlatBranch> {
        self.branches
    }

    /// Number of generated twigs.
    pub fn generated(&self) -> usize {
        self.branches.len() - self.drawn
    }

    /// How many more twigs of at most `longest` samples there may be, where the parameters ask for `wanted` at most.
    pub fn room(&self, wanted: u32, longest: usize) -> usize {
        let twigs = (wanted as usize).min(Budget::PLANT.twigs).saturating_sub(self.generated());
        twigs.min(Budget::PLANT.twig_samples.saturating_sub(self.samples) / longest.max(1))
    }

    /// Indices among `of` of the branches that may have a piece inside the region.
    pub fn near<'a>(&'a self, region: &Region, of: Range<usize>) -> impl Iterator<Item = usize> + 'a {
        let bounds = region.bounds();
        of.filter(move |&i| {
            let ((low, high), (from, to)) = (self.boxes[i], bounds.unwrap_or_default());
            bounds.is_some() && low.cmple(to).all() && high.cmpge(from).all()
        })
    }

    /// Whether so many more samples or places may be looked at; if so, they are counted.
    pub fn may_look_at(&mut self, count: usize) -> bool {
        let left = self.looks.checked_sub(count);
        self.looks = left.unwrap_or(self.looks);
        left.is_some()
    }

    /// Adds the twig that grew along a line from a point on a branch; a point without a branch gives none.
    pub fn sprout(&mut self, point: &GrowthPoint, line: Arc<[Sample]>) {
        let Some(Attachment { branch, at }) = point.attachment else { return };
        let twig = FlatBranch {
            half_width: None,
            stroke: None,
            key: point.key,
            line,
            parent: Some(branch),
            attached_at: at,
            level: self.branches[branch].level + 1,
        };
        self.samples += twig.line.len();
        self.boxes.push(box_of(&twig));
        self.branches.push(twig);
    }

    /// Adds to `points` the growth points `spacing` pixels apart on the branches `of`, as far as they lie inside the
    /// region of the outline's stroke; farther apart where there would be too many to look at, and none once all outlines
    /// together have looked at too many.
    pub fn growth_points(
        &mut self,
        of: Range<usize>,
        (outline, region): (StrokeId, &Region),
        spacing: f32,
        points: &mut Thinned<GrowthPoint>,
    ) {
        let compared = of.len() / BOXES_PER_LOOK;
        let branches: Vec<usize> = self.near(region, of).collect();
        let steps = branches.iter().flat_map(|branch| self.branches[*branch].line.windows(2));
        let (count, whole) = steps.fold((0, 0.0), |(count, whole), w| {
            (count + 1, whole + f64::from(w[0].position.distance(w[1].position)))
        });
        let least = (whole / Budget::PLANT.growth_points as f64) as f32;
        if spacing < least {
            points.leave_out();
        }
        let spacing = spacing.max(least);
        if !self.may_look_at(compared + count + (whole / f64::from(spacing)) as usize) {
            return points.leave_out();
        }
        for branch in branches {
            let (mut arc, mut number) = (0.0, 1);
            for w in self.branches[branch].line.windows(2) {
                let (from, to) = (w[0].position, w[1].position);
                let span = from.distance(to);
                while number as f32 * spacing <= arc + span && span > 0.0 {
                    let at = number as f32 * spacing;
                    let position = from.lerp(to, ((at - arc) / span).clamp(0.0, 1.0));
                    if region.contains(position) {
                        let point = GrowthPoint {
                            position,
                            direction: (to - from) / span,
                            attachment: Some(Attachment { branch, at }),
                            side: side(number),
                            key: self.key(branch, number, outline),
                        };
                        // Branches begin to count anywhere, lest short ones have nothing.
                        points.add(point, self.branches[branch].key.wrapping_add(number as u64));
                    }
                    number += 1;
                }
                arc += span;
            }
        }
    }

    /// Name of the `number`-th growth point of a branch inside an outline.
    pub fn key(&self, branch: usize, number: usize, outline: StrokeId) -> u64 {
        mix(mix(self.branches[branch].key, number as u64), outline)
    }
}

fn box_of(branch: &FlatBranch) -> (Vec2, Vec2) {
    let corners = branch.line.iter().map(|s| s.position);
    corners.fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(lo, hi), p| (lo.min(p), hi.max(p)))
}

/// At most `limit` of any number of things, evenly thinned: those whose number is a multiple of a power of two, the least
/// that leaves few enough. Numbers count along a branch or over a grid and have nothing to do with what is elsewhere, so that
/// what comes or goes there leaves all others as they are, but where the power of two changes.
#[derive(Clone, Debug)]
pub struct Thinned<T> {
    kept: Vec<T>,
    numbers: Vec<u64>,
    limit: usize,
    stride: u64,
    seen: usize,
    /// Whether some were never seen.
    lacks: bool,
}

impl<T> Thinned<T> {
    /// Room for `limit` things.
    pub fn new(limit: usize) -> Self {
        Self { kept: Vec::new(), numbers: Vec::new(), limit, stride: 1, seen: 0, lacks: false }
    }

    /// Takes one more into account.
    pub fn add(&mut self, thing: T, number: u64) {
        self.seen += 1;
        while self.kept.len() >= self.limit && number.is_multiple_of(self.stride) {
            if self.limit == 0 || self.stride > u64::MAX / 2 {
                return;
            }
            self.stride *= 2;
            let mut numbers = self.numbers.iter();
            let stride = self.stride;
            self.kept.retain(|_| numbers.next().is_some_and(|number| number.is_multiple_of(stride)));
            self.numbers.retain(|number| number.is_multiple_of(stride));
        }
        if number.is_multiple_of(self.stride) {
            self.kept.push(thing);
            self.numbers.push(number);
        }
    }

    /// Knows that there are more than will be seen.
    pub fn leave_out(&mut self) {
        self.lacks = true;
    }

    /// Whether nothing was seen.
    pub fn is_empty(&self) -> bool {
        self.seen == 0
    }

    /// Whether some were left out.
    pub fn is_thinned(&self) -> bool {
        self.lacks || self.kept.len() < self.seen
    }

    /// What was kept, in order.
    pub fn kept(&self) -> &[T] {
        &self.kept
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinning_is_even() {
        let mut thinned = Thinned::new(10);
        (0..1000).for_each(|k| thinned.add(k, k));
        let kept = thinned.kept();
        assert!(kept.len() <= 10 && kept.len() >= 5 && thinned.is_thinned());
        assert!(kept.windows(2).all(|w| w[1] - w[0] == kept[1] - kept[0]));
        let mut with_others = Thinned::new(10);
        (0..1000).for_each(|k| with_others.add(k, k));
        (0..7).for_each(|k| with_others.add(1000 + k, 1 + 2 * k));
        assert_eq!(with_others.kept(), kept, "what comes elsewhere leaves them alone");
        let mut one_spot = Thinned::new(10);
        (0..100).for_each(|k| one_spot.add(k, 0));
        assert!(one_spot.kept().len() <= 10 && one_spot.is_thinned());
    }
}
