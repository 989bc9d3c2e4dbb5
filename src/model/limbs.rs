//! Branches as limbs of one surface: their rings, where each leaves its parent, and which goes on from another's end.
//!
//! A branch that stands on the end of its parent and leads on from there is one limb with it, as a shoot that grows on
//! from the bud at a twig's end; of several the thickest is, the others leave it at its side. It has its parent's number
//! of sides and its own bark.
//!
//! Limits: a branch that never leaves its parent is not seen, and what grows on it grows on the parent.

use super::joint::{self, Exit};
use super::spine::{self, Ring, SpineScratch};
use super::tube::TubeLook;
use crate::geom::polyline;
use crate::plant::Branch;
use glam::Vec3;
use std::ops::Range;

/// How far from its parent's end a branch that goes on from there may begin, in the parent's radii at its end.
const AT_END: f32 = 2.0;
/// Least cosine of the angle by which it may turn off, and how far beyond the end it goes on, in the same radii.
const ONWARD: f32 = 0.5;
const BEYOND: f32 = 1.0;

/// Length over which a collar narrows, as a multiple of the branch's radius.
pub(super) const COLLAR_LENGTH: f32 = 2.0;

/// Radius of a branch that goes on below a trunk, as a share of the trunk's at its foot, at least.
const BELOW: f32 = 0.5;

/// Other branches of its parent, the latest, that a branch keeps clear of.
const SIBLINGS: usize = 16;

/// A branch of joined wood, or its index in the plant, in a list in which parents come before what grows on them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct WoodBranch<B> {
    pub(super) branch: B,
    /// The place in the list of the branch that it grows on.
    pub(super) parent: Option<usize>,
    /// Which of the part's materials it has, its bark; the first one's is 0.
    pub(super) slot: usize,
}

/// A branch on its way to the surface.
#[derive(Clone, Debug)]
pub(super) struct Limb {
    pub(super) look: TubeLook,
    /// Its rings in [`Limbs::rings`].
    pub(super) rings: Range<usize>,
    /// Its barks in [`Limbs::slots`].
    slots: Range<usize>,
    /// The limb that carries it, and where it leaves that; a trunk has none.
    pub(super) parent: Option<usize>,
    pub(super) exit: Option<Exit>,
    /// It stays inside of its parent or is one limb with it, and what grows on it grows on the parent.
    pub(super) hidden: bool,
    /// It goes on from an end of its parent.
    goes_on: bool,
    /// The rim of its window among those of all.
    pub(super) rim: Range<usize>,
    /// Its window reaches the first ring of its parent.
    pub(super) is_at_foot: bool,
    /// What grows on it, in [`Limbs::children`].
    pub(super) children: Range<usize>,
}

impl Limb {
    pub(super) fn sides(&self) -> usize {
        self.look.sides as usize
    }
}

/// An earlier survey, and for every branch the one in it that has the same skeleton and bark.
#[derive(Clone, Copy)]
pub(super) struct Earlier<'a> {
    pub(super) limbs: &'a Limbs,
    pub(super) known: &'a [Option<usize>],
}

/// The limbs of one plant, a limb for every branch, in memory that is used again.
#[derive(Debug, Default)]
pub(super) struct Limbs {
    pub(super) all: Vec<Limb>,
    /// For each limb the one of the earlier survey that has the same rings, barks and exit.
    pub(super) same: Vec<Option<usize>>,
    /// Rings of all limbs, and the length of the limb before each.
    pub(super) rings: Vec<Ring>,
    pub(super) arcs: Vec<f32>,
    /// Limbs in the order of what they grow on.
    pub(super) children: Vec<u32>,
    /// Barks of all limbs, each with the length of the limb at which it begins.
    slots: Vec<(f32, u32)>,
    /// For each branch the one that goes on from its end, and for a trunk the one that goes on from its foot.
    next: Vec<Option<usize>>,
    below: Vec<Option<usize>>,
    /// For each limb the one that was found last to grow on it; for each the one found before on the same parent.
    last_child: Vec<Option<usize>>,
    before: Vec<Option<usize>>,
    others: Vec<Exit>,
    skeleton: Vec<(Vec3, f32)>,
    one: Vec<Ring>,
    spine: SpineScratch,
}

impl Limbs {
    /// Rings of every branch and where it leaves its parent; what is the same as in an earlier survey, of limbs with the same
    /// looks, is taken from there.
    pub(super) fn survey(
        &mut self,
        branches: &[WoodBranch<&Branch>],
        look: impl Fn(&Branch) -> TubeLook,
        earlier: Option<Earlier<'_>>,
    ) {
        self.all.clear();
        self.same.clear();
        self.rings.clear();
        self.arcs.clear();
        self.slots.clear();
        self.find_next(branches);
        self.last_child.clear();
        self.last_child.resize(branches.len(), None);
        self.before.clear();
        for (index, twig) in branches.iter().enumerate() {
            let look = look(twig.branch);
            let mut parent = twig.parent;
            let goes_on = parent.is_some_and(|p| [self.next[p], self.below[p]].contains(&Some(index)));
            while let Some(hidden) = parent.filter(|p| self.all[*p].hidden) {
                parent = self.all[hidden].parent;
            }
            let (rings, slots) = (self.rings.len(), self.slots.len());
            let known = earlier
                .and_then(|earlier| Some((earlier.limbs, self.same_as(earlier, index, (goes_on, parent))?)));
            let exit = match known {
                Some((limbs, limb)) => self.take(limbs, &limbs.all[limb]),
                None if goes_on => Some(None),
                None => self.trace(branches, index, look, parent),
            };
            let before = parent.and_then(|p| self.last_child[p].replace(index));
            self.before.push(before);
            let mut limb = Limb {
                look,
                rings: rings..self.rings.len(),
                slots: slots..self.slots.len(),
                parent,
                exit: exit.flatten(),
                hidden: matches!(exit, Some(None)),
                goes_on,
                rim: 0..0,
                is_at_foot: false,
                children: 0..0,
            };
            let same = known.map(|(_, limb)| limb);
            let same = same.or_else(|| self.turned_out_as(earlier?, index, &limb));
            if let (Some(earlier), Some(same)) = (earlier, same) {
                limb.is_at_foot = earlier.limbs.all[same].is_at_foot;
            }
            self.same.push(same);
            self.all.push(limb);
        }
        self.sort_children();
    }

    /// The limb of an earlier survey for which [`Self::trace`] read the very same, where there is one.
    fn same_as(
        &self,
        Earlier { limbs: then, known }: Earlier<'_>,
        index: usize,
        (goes_on, parent): (bool, Option<usize>),
    ) -> Option<usize> {
        let old = known[index]?;
        let is_twig = |(new, old): (Option<usize>, Option<usize>)| match (new, old) {
            (Some(new), Some(old)) => known[new] == Some(old),
            (new, old) => new == old,
        };
        let goes_on_alike = goes_on == then.all[old].goes_on
            && is_twig((self.below[index], then.below[old]))
            && pairs(self.onward(index), then.onward(old)).all(is_twig);
        let last = parent.and_then(|p| self.last_child[p]);
        let are_siblings_alike = || {
            pairs(self.siblings(last), then.siblings(then.before[old])).all(|(new, old)| match (new, old) {
                (Some(new), Some(old)) => {
                    self.same[new] == Some(old) || has_same_exit(&self.all[new], &then.all[old])
                }
                _ => false,
            })
        };
        (self.is_carried_alike(parent, then.all[old].parent) && goes_on_alike && are_siblings_alike())
            .then_some(old)
    }

    /// The limb of an earlier survey of which this one, just traced, has every bit, although something else around it changed.
    fn turned_out_as(
        &self,
        Earlier { limbs: then, known }: Earlier<'_>,
        index: usize,
        limb: &Limb,
    ) -> Option<usize> {
        let old = known[index]?;
        let other = &then.all[old];
        let same = (limb.hidden, limb.goes_on) == (other.hidden, other.goes_on)
            && self.is_carried_alike(limb.parent, other.parent)
            && has_same_exit(limb, other)
            && self.ring_bits(limb).eq(then.ring_bits(other))
            && self.slot_bits(limb).eq(then.slot_bits(other));
        same.then_some(old)
    }

    fn ring_bits(&self, limb: &Limb) -> impl Iterator<Item = [u32; 7]> {
        self.rings[limb.rings.clone()].iter().map(Ring::bits)
    }

    fn slot_bits(&self, limb: &Limb) -> impl Iterator<Item = (u32, u32)> {
        self.slots[limb.slots.clone()].iter().map(|(from, slot)| (from.to_bits(), *slot))
    }

    /// The branches that go on from the end of a branch, one after the other.
    fn onward(&self, from: usize) -> impl Iterator<Item = usize> {
        std::iter::successors(self.next[from], |branch| self.next[*branch])
    }

    /// The latest limbs of one parent, from this one back.
    fn siblings(&self, last: Option<usize>) -> impl Iterator<Item = usize> {
        std::iter::successors(last, |limb| self.before[*limb]).take(SIBLINGS)
    }

    /// Whether what carries a limb is the same as what carried another in an earlier survey.
    fn is_carried_alike(&self, parent: Option<usize>, then: Option<usize>) -> bool {
        match (parent, then) {
            (Some(new), Some(old)) => self.same[new] == Some(old),
            (new, old) => new == old,
        }
    }

    /// Appends what a limb of an earlier survey has, as [`Self::trace`] does.
    fn take(&mut self, then: &Self, limb: &Limb) -> Option<Option<Exit>> {
        self.rings.extend_from_slice(&then.rings[limb.rings.clone()]);
        self.arcs.extend_from_slice(&then.arcs[limb.rings.clone()]);
        self.slots.extend_from_slice(&then.slots[limb.slots.clone()]);
        if limb.hidden { Some(None) } else { limb.exit.map(Some) }
    }

    /// The bark of a limb at a length along it.
    pub(super) fn slot(&self, limb: &Limb, arc: f32) -> u32 {
        let last = self.slots[limb.slots.clone()].iter().rev().find(|(from, _)| *from <= arc);
        last.map_or(0, |(_, slot)| *slot)
    }

    /// Appends the rings and barks of a branch and of those that go on from its end; `None` for a trunk, `Some(None)` for
    /// one that stays inside its parent.
    fn trace(
        &mut self,
        branches: &[WoodBranch<&Branch>],
        index: usize,
        look: TubeLook,
        parent: Option<usize>,
    ) -> Option<Option<Exit>> {
        let first_slot = self.slots.len();
        self.link(branches, index);
        spine::rings(self.skeleton.iter().copied(), look.detail, &mut self.spine, &mut self.one);
        let exit = parent.map(|p| {
            let on = self.all[p].rings.clone();
            let free = self.all[p].exit.map_or(0.0, |exit| exit.arc + COLLAR_LENGTH * exit.ring.radius);
            let of_parent = (&self.rings[on.clone()], &self.arcs[on]);
            let siblings = std::iter::successors(self.last_child[p], |c| self.before[*c]).take(SIBLINGS);
            self.others.clear();
            self.others.extend(siblings.filter_map(|c| self.all[c].exit));
            joint::exit(&mut self.one, of_parent, free, &self.others)
        });
        let mut arc = 0.0;
        for (i, ring) in self.one.iter().enumerate() {
            arc += ring.at.distance(self.one[i.saturating_sub(1)].at);
            self.arcs.push(arc);
            self.rings.push(*ring);
        }
        if self.slots.len() > first_slot + 1 {
            let arcs = polyline::arc_lengths(self.skeleton.iter().map(|(at, _)| *at));
            let along = arc / arcs.last().map_or(f32::MIN_POSITIVE, |whole| whole.max(f32::MIN_POSITIVE));
            for slot in &mut self.slots[first_slot..] {
                slot.0 = arcs[slot.0 as usize] * along;
            }
        }
        exit
    }

    /// The skeleton of a branch and of those that go on from its end and from its foot; its barks, each with the place in the
    /// skeleton at which it begins.
    fn link(&mut self, branches: &[WoodBranch<&Branch>], index: usize) {
        let skeleton = &mut self.skeleton;
        skeleton.clear();
        let mut begin = |from: usize, twig: usize| self.slots.push((from as f32, branches[twig].slot as u32));
        begin(0, self.below[index].unwrap_or(index));
        if let Some(below) = self.below[index] {
            skeleton.extend(End::foot(branches[index].branch).beyond(branches[below].branch).rev());
            begin(skeleton.len() - 1, index);
        }
        let branch = branches[index].branch;
        skeleton.extend(branch.points.iter().copied().zip(branch.radii.iter().copied()));
        let mut at = index;
        while let Some(next) = self.next[at] {
            begin(skeleton.len() - 1, next);
            skeleton.extend(End::top(branches[at].branch).beyond(branches[next].branch));
            at = next;
        }
    }

    /// Finds for each branch the one that goes on from its end or, below a trunk, from its foot.
    fn find_next(&mut self, branches: &[WoodBranch<&Branch>]) {
        for list in [&mut self.next, &mut self.below] {
            list.clear();
            list.resize(branches.len(), None);
        }
        for (index, twig) in branches.iter().enumerate() {
            let Some(parent) = twig.parent else { continue };
            let lower = branches[parent];
            let next = if End::top(lower.branch).goes_on(twig.branch) {
                &mut self.next[parent]
            } else if lower.parent.is_none() && stands_under(lower.branch, twig.branch) {
                &mut self.below[parent]
            } else {
                continue;
            };
            let thickness = |twig: usize| branches[twig].branch.radii[0];
            if next.is_none_or(|other| thickness(index) > thickness(other)) {
                *next = Some(index);
            }
        }
    }

    /// Gives every limb the list of those that grow on it, thickest first: they choose their place before others.
    fn sort_children(&mut self) {
        let (limbs, children) = (&mut self.all, &mut self.children);
        children.clear();
        children.extend((0..limbs.len() as u32).filter(|c| limbs[*c as usize].exit.is_some()));
        let width = |c: &u32| limbs[*c as usize].exit.map_or(0.0, |exit| exit.ring.radius);
        children.sort_by(|a, b| {
            let (of_a, of_b) = (limbs[*a as usize].parent, limbs[*b as usize].parent);
            of_a.cmp(&of_b).then(width(b).total_cmp(&width(a))).then(a.cmp(b))
        });
        let mut from = 0;
        while from < children.len() {
            let parent = limbs[children[from] as usize].parent;
            let to =
                from + children[from..].iter().take_while(|c| limbs[**c as usize].parent == parent).count();
            if let Some(parent) = parent {
                limbs[parent].children = from..to;
            }
            from = to;
        }
    }
}

/// Whether two limbs leave what carries them in the very same way, or both not at all.
pub(super) fn has_same_exit(a: &Limb, b: &Limb) -> bool {
    match (&a.exit, &b.exit) {
        (Some(a), Some(b)) => a.is(b),
        (a, b) => a.is_none() && b.is_none(),
    }
}

/// The items of two rows side by side, to the end of the longer one.
fn pairs<T>(
    mut a: impl Iterator<Item = T>,
    mut b: impl Iterator<Item = T>,
) -> impl Iterator<Item = (Option<T>, Option<T>)> {
    std::iter::from_fn(move || match (a.next(), b.next()) {
        (None, None) => None,
        pair => Some(pair),
    })
}

/// One of the ends of a branch.
struct End {
    at: Vec3,
    /// Radius there, metres.
    radius: f32,
    /// Unit direction in which the branch ends there.
    along: Vec3,
}

impl End {
    fn top(branch: &Branch) -> Self {
        let last = branch.points.len() - 1;
        Self::of(branch.radii[last], branch.points.iter().rev())
    }

    fn foot(branch: &Branch) -> Self {
        Self::of(branch.radii[0], branch.points.iter())
    }

    /// The first of these points.
    fn of<'a>(radius: f32, mut points: impl Iterator<Item = &'a Vec3>) -> Self {
        let at = points.next().copied().unwrap_or_default();
        let mut inner = at;
        for point in points {
            inner = *point;
            if inner.distance(at) >= radius {
                break;
            }
        }
        Self { at, radius, along: (at - inner).normalize_or(Vec3::Y) }
    }

    /// What of a branch lies beyond this end, with its radii.
    fn beyond<'a>(&self, branch: &'a Branch) -> impl DoubleEndedIterator<Item = (Vec3, f32)> + use<'a> {
        let within = |p: &Vec3| (*p - self.at).dot(self.along) < BEYOND * self.radius;
        let first = branch.points.iter().take_while(|p| within(p)).count();
        branch.points[first..].iter().copied().zip(branch.radii[first..].iter().copied())
    }

    /// Whether a branch stands on this end and leads on from it.
    fn goes_on(&self, branch: &Branch) -> bool {
        let leads_on = |p: Vec3| (p - self.at).dot(self.along) >= ONWARD * p.distance(self.at);
        branch.points[0].distance(self.at) <= AT_END * self.radius
            && self.beyond(branch).next().is_some_and(|(p, _)| leads_on(p))
    }
}

/// Whether a branch goes on below a trunk, which was drawn from somewhere between ground and tip then.
fn stands_under(trunk: &Branch, branch: &Branch) -> bool {
    branch.radii[0] >= BELOW * trunk.radii[0] && End::foot(trunk).goes_on(branch)
}
