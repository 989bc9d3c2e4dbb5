//! Flower buds of a grown plant: what buds whose fate was a flower show from the year in which it was decided.
//!
//! A bud stands in the direction in which the shoot would have gone, one of a cluster about it; the species'
//! looks open it ([`crate::species::apply()`]). A place flowers for as many years as the species says.

use super::foliage::{self, Wood};
use crate::growth::habit::Habit;
use crate::growth::tree::{Fate, NONE};
use crate::plant::{FlowerBud, FlowerBuds};
use crate::random::{Choice, mix};
use glam::Vec3;
use rayon::prelude::*;

/// How far the flowers of a cluster lean away from its middle, and stand from it, in lengths of a leaf.
const APART: f32 = 0.9;
const ASIDE: f32 = 0.35;
/// How far flowers of wood that holds on to a surface lean along it.
const ALONG: f32 = 0.4;

/// The flower buds of a plant at an age, in the order of the buds; thinned to `most` where there would be more.
pub(super) fn buds(most: usize, wood: &Wood<'_>, habit: &Habit) -> FlowerBuds {
    let sites = sites(wood, habit);
    let pose = habit.leaf.at(wood.age);
    let cluster = habit.flower_cluster as usize;
    let bud = |nth: usize| {
        let (site, k) = (sites[nth / cluster], nth % cluster);
        let bud = one(wood, site, k, pose.length * site.grown);
        let share = foliage::held_share(bud.base, bud.v, wood.simulation)?;
        Some(FlowerBud { u: bud.u * share, v: bud.v * share, ..bud })
    };
    let whole = sites.len() * cluster;
    if whole <= most {
        return FlowerBuds { buds: (0..whole).filter_map(bud).collect(), is_thinned: false };
    }
    // A volume leaves out some; of the others, where they are too many, the same share stays everywhere.
    let held: Vec<usize> = (0..whole).into_par_iter().filter(|nth| bud(*nth).is_some()).collect();
    let kept = most.min(held.len());
    let buds = (0..kept).filter_map(|n| bud(held[n * held.len() / kept])).collect();
    FlowerBuds { buds, is_thinned: kept < held.len() }
}

/// A bud that flowers, and the chain that carries it.
#[derive(Clone, Copy)]
struct Site {
    bud: usize,
    chain: u32,
    /// How far its flowers have grown in their first year, 0 to 1.
    grown: f32,
}

fn sites(wood: &Wood<'_>, habit: &Habit) -> Vec<Site> {
    let year = wood.age.ceil() as u16;
    let before = u16::try_from(habit.flower_years.saturating_sub(1)).unwrap_or(u16::MAX);
    let years = year.saturating_sub(before)..=year;
    let of = &wood.tree.buds;
    let flowers = |b: &usize| of.fate[*b] == Fate::Flower && years.contains(&of.settled[*b]);
    let site = |bud: usize| {
        let node = of.node[bud] as usize;
        let chain = *wood.chains.of_node.get(node).filter(|_| node >= wood.first && wood.lives(node))?;
        let since = wood.age - f32::from(of.settled[bud]) + 1.0;
        (chain != NONE).then(|| Site { bud, chain, grown: since.clamp(0.05, wood.grown[node].max(0.05)) })
    };
    (0..of.node.len()).filter(flowers).filter_map(site).collect()
}

/// The `k`-th flower of a cluster.
fn one(wood: &Wood<'_>, Site { bud, chain, .. }: Site, k: usize, length: f32) -> FlowerBud {
    let (at, direction) = (wood.at[wood.tree.buds.node[bud] as usize], wood.tree.buds.direction[bud]);
    let key = mix(mix(Choice::FLOWER_BUD.key(wood.seed), bud as u64), k as u64);
    let random = Vec3::from_array(Choice::ASIDE.signs(key));
    let aside = if k == 0 { Vec3::ZERO } else { random * APART };
    // Flowers of wood that holds on to a surface turn away from it.
    let held = wood.simulation.held_at(at).map_or(Vec3::ZERO, |contact| contact.away);
    let toward = direction + aside;
    let toward = if held == Vec3::ZERO { toward } else { toward.reject_from_normalized(held) * ALONG + held };
    let way = toward.normalize_or(direction);
    let nth =
        wood.tree.buds.node[..bud].iter().rev().take_while(|node| **node == wood.tree.buds.node[bud]).count();
    let number = (nth * 1000 + k) as u32;
    FlowerBud {
        origin: wood.origin(Choice::NAME_OF_BUD, (wood.tree.buds.node[bud] as usize, number)),
        branch: Some(chain as usize),
        base: at + (aside + held) * (ASIDE * length),
        u: way.any_orthonormal_vector() * length,
        v: way * length,
        look: 0,
        open: 1.0,
    }
}
