//! Which limbs of a surface have to be made anew after a change of the branches.
//!
//! A limb's grid depends on its rings and on the exits of what it carries; its strip on its own grid and that of what carries
//! it; its normals on the strips of what it carries, and those at the rim of its window on all strips around what carries it,
//! or, where the window reaches the first ring of that, on that one's strip. So a change of one branch goes no farther than
//! to its neighbours.
//!
//! Limits: all that stands on a limb is made anew where one of the branches on it changed.

use super::limbs::{Limbs, has_same_exit};
use super::wood::Share;

/// The share of every limb in a surface of what has to be made anew. All others lie in the surface of the earlier survey, as
/// the limbs that [`Limbs::same`] names.
pub(super) fn changed(now: &Limbs, then: &Limbs) -> Vec<Share> {
    let Alike { grids, strips } = Alike::between(now, then);
    let limbs = now.all.len();
    // Whether the grid of a limb and all strips on it are as they were.
    let mut bodies = grids;
    for limb in (0..limbs).filter(|limb| !now.all[*limb].hidden && !strips[*limb]) {
        if let Some(parent) = now.all[limb].parent {
            bodies[parent] = false;
        }
    }
    let is_same = |limb: usize| {
        let is_rim_same = |parent: usize| bodies[parent] && (strips[parent] || !now.all[limb].is_at_foot);
        bodies[limb] && strips[limb] && now.all[limb].parent.is_none_or(is_rim_same)
    };
    let is_changed = |limb: usize| !now.all[limb].hidden && !is_same(limb);
    let mut shares: Vec<Share> =
        (0..limbs).map(|limb| if is_changed(limb) { Share::Whole } else { Share::Left }).collect();
    // With a limb comes all that carries it, and with each of those what stands on it.
    for limb in (0..limbs).rev().filter(|limb| !now.all[*limb].hidden) {
        if let (Share::Whole, Some(parent)) = (shares[limb], now.all[limb].parent) {
            shares[parent] = Share::Whole;
        }
    }
    for limb in (0..limbs).filter(|limb| !now.all[*limb].hidden) {
        let parent = now.all[limb].parent.map(|parent| shares[parent]);
        if (shares[limb], parent) == (Share::Left, Some(Share::Whole)) {
            shares[limb] = Share::Around;
        }
    }
    shares
}

/// Which limbs have the same grid, and which the same strip as in an earlier survey.
struct Alike {
    grids: Vec<bool>,
    strips: Vec<bool>,
}

impl Alike {
    fn between(now: &Limbs, then: &Limbs) -> Self {
        let limbs = now.all.len();
        let mut grids = vec![false; limbs];
        let mut is_in_place = vec![false; limbs];
        for (limb, same) in now.same.iter().enumerate() {
            let Some(old) = same.filter(|_| !now.all[limb].hidden) else { continue };
            let new_children = &now.children[now.all[limb].children.clone()];
            let old_children = &then.children[then.all[old].children.clone()];
            let pairs = || new_children.iter().zip(old_children).map(|(a, b)| (*a as usize, *b as usize));
            for (new, old) in pairs() {
                is_in_place[new] = now.same[new] == Some(old);
            }
            let have_same_exits =
                pairs().all(|(new, old)| is_in_place[new] || has_same_exit(&now.all[new], &then.all[old]));
            grids[limb] = new_children.len() == old_children.len() && have_same_exits;
        }
        let is_strip_same = |limb: usize| {
            let parent = now.all[limb].parent;
            grids[limb] && parent.is_none_or(|parent| grids[parent] && is_in_place[limb])
        };
        let strips = (0..limbs).map(is_strip_same).collect();
        Self { grids, strips }
    }
}
