//! Branches are cut off a plant, with all that stands on them: by a pruning brush, and by the artist's hand.

use super::{Branch, FlowerBuds, Organ, OrganKind, Plant, Shape};
use crate::geom::polyline;
use glam::Vec3;

/// What becomes of a branch.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Cut {
    /// It stays as it is.
    #[default]
    Whole,
    /// It ends so far from its base, metres, as thick as it is there.
    At(f32),
    /// It goes.
    Gone,
}

impl Plant {
    /// Whether what stands at a place on a branch still has wood under it where branches are cut so; those that stand on what is
    /// gone are to be gone too.
    pub fn is_held(&self, cuts: &[Cut], branch: Option<usize>, at: Vec3) -> bool {
        let Some(branch) = branch else { return true };
        match cuts[branch] {
            Cut::Whole => true,
            Cut::Gone => false,
            Cut::At(length) => {
                polyline::nearest(&self.branches[branch].points, at).is_some_and(|n| n.1 <= length)
            }
        }
    }

    /// Cuts branches, and takes away what stands on what is cut off, and leaves, petals, flowers and buds that begin
    /// or have their middle at places that do not `stay` besides; whether that is anything. A pot stays whatever is cut.
    pub fn cut(&mut self, buds: &mut FlowerBuds, cuts: &[Cut], stay: impl Fn(Vec3) -> bool) -> bool {
        let stays = |branch: Option<usize>, at: Vec3| stay(at) && self.is_held(cuts, branch, at);
        let flowers: Vec<bool> =
            self.flowers.iter().map(|flower| stays(flower.branch, flower.cone.apex)).collect();
        let organs = self.organs.iter().map(|organ| match organ.flower {
            Some(flower) => flowers[flower] && stay(self.middle(organ)),
            None => {
                let is_pot = organ.kind() == OrganKind::Pot;
                is_pot || stays(organ.branch, organ.base()) && stay(self.middle(organ))
            }
        });
        let organs: Vec<bool> = organs.collect();
        let of_buds: Vec<bool> = buds.buds.iter().map(|bud| stays(bud.branch, bud.base)).collect();
        let is_untouched = cuts.iter().all(|cut| *cut == Cut::Whole);
        if is_untouched && [&flowers, &organs, &of_buds].into_iter().flatten().all(|stays| *stays) {
            return false;
        }
        self.keep_organs(&organs, &flowers);
        retain(&mut buds.buds, &of_buds);
        let kept: Vec<bool> = cuts.iter().map(|cut| *cut != Cut::Gone).collect();
        let places = new_places(&kept);
        buds.buds.iter_mut().for_each(|bud| bud.branch = bud.branch.map(|branch| places[branch]));
        for (branch, cut) in self.branches.iter_mut().zip(cuts) {
            if let Cut::At(length) = cut {
                branch.shorten(*length);
            }
        }
        self.keep_branches(&kept);
        debug_assert_eq!(self.check_invariants(), Ok(()));
        debug_assert_eq!(buds.check_invariants(self), Ok(()));
        true
    }
}

impl Plant {
    /// The middle of a blade; where other organs begin.
    fn middle(&self, organ: &Organ) -> Vec3 {
        match &organ.shape {
            Shape::Blade(blade) => blade.base.midpoint(self.templates.resolve(blade).tip_at_rest()),
            _ => organ.base(),
        }
    }

    /// Takes away the organs and flowers that do not stay; the organs of such a flower are to be among them.
    pub fn keep_organs(&mut self, organs: &[bool], flowers: &[bool]) {
        retain(&mut self.organs, organs);
        let places = new_places(flowers);
        self.organs.iter_mut().for_each(|organ| organ.flower = organ.flower.map(|flower| places[flower]));
        retain(&mut self.flowers, flowers);
        self.drop_unused_templates();
    }
}

impl Branch {
    /// Ends it so far from its base, metres.
    fn shorten(&mut self, length: f32) {
        let mut walked = 0.0;
        for k in 1..self.points.len() {
            let (from, to) = (self.points[k - 1], self.points[k]);
            let run = from.distance(to);
            if walked + run >= length {
                let share = ((length - walked) / run).clamp(0.0, 1.0);
                self.radii[k] = self.radii[k - 1] + (self.radii[k] - self.radii[k - 1]) * share;
                self.points[k] = from.lerp(to, share);
                // A cut at a point leaves no piece without length.
                let kept = if share < 1e-3 && k > 1 { k } else { k + 1 };
                self.points.truncate(kept);
                self.radii.truncate(kept);
                return;
            }
            walked += run;
        }
    }
}

/// Keeps what stays.
fn retain<T>(items: &mut Vec<T>, stays: &[bool]) {
    let mut stays = stays.iter();
    items.retain(|_| stays.next().copied().unwrap_or(true));
}

/// The place of each among those that stay.
fn new_places(stays: &[bool]) -> Vec<usize> {
    let count = |next: &mut usize, stays: &bool| {
        *next += usize::from(*stays);
        Some(*next - usize::from(*stays))
    };
    stays.iter().scan(0, count).collect()
}
