//! Flower buds of a grown plant: what buds whose fate was a flower show from the year in which it was decided.
//!
//! A bud is a small blade in the direction in which the shoot would have gone, one of a cluster about it; the species'
//! looks open it ([`crate::species::dress()`]). A place flowers for as many years as the species says.

use super::fate::{Fate, unit};
use super::foliage::{self, Wood};
use super::leaf;
use super::species::Habit;
use super::tree::NONE;
use crate::plant::{Blade, BladeForm, Organ, OrganKind, RestSurface, Shape};
use crate::random::mix;
use glam::{Vec2, Vec3};
use std::sync::Arc;

/// Most flowers of a plant; of more, every n-th is taken.
pub const MOST: usize = 20_000;
/// How far the flowers of a cluster lean away from its middle, and stand from it, in lengths of a leaf.
const APART: f32 = 0.9;
const ASIDE: f32 = 0.35;

/// The flower buds of a plant at an age, in the order of the buds.
pub fn buds(wood: &Wood<'_>, habit: &Habit) -> Vec<Organ> {
    let year = wood.age.ceil() as u16;
    let of = &wood.tree.buds;
    let on = |b: usize| wood.chains.of_node.get(of.node[b] as usize).copied().filter(|chain| *chain != NONE);
    let years = year.saturating_sub(habit.flower_years.saturating_sub(1) as u16)..=year;
    let in_cluster = |place| (0..habit.flower_cluster).map(move |k| (place, k));
    let open: Vec<((usize, u32), u32)> = (0..of.node.len())
        .filter(|b| of.fate[*b] == Fate::Flower && years.contains(&of.settled[*b]))
        .filter_map(|b| Some((b, on(b)?)))
        .flat_map(in_cluster)
        .collect();
    let outline: Arc<[Vec2]> = leaf::outline(habit.leaf.shape, habit.leaf.width).into();
    let grown = (wood.age - (f32::from(year) - 1.0)).clamp(0.05, 1.0);
    let length = habit.leaf.length * grown;
    let bud = |&((b, chain), k): &((usize, u32), u32)| {
        let key = mix(mix(mix(wood.seed, 67), b as u64), u64::from(k));
        let aside = Vec3::from_array([1, 2, 3].map(|n| 2.0 * unit(mix(key, n)) - 1.0)) * APART;
        let aside = if k == 0 { Vec3::ZERO } else { aside };
        let way = (of.direction[b] + aside).normalize_or(of.direction[b]);
        let blade = Blade {
            outline: outline.clone(),
            curl: Vec::new(),
            base: wood.at[of.node[b] as usize] + aside * (ASIDE * length),
            u: way.any_orthonormal_vector() * length,
            v: way * length,
            length: 1.0,
            rest: RestSurface::Plane,
            form: BladeForm::default(),
            template: None,
        };
        Some(Organ {
            kind: OrganKind::Bud,
            stroke: None,
            branch: Some(chain as usize),
            flower: None,
            material: 1,
            shape: Shape::Blade(foliage::held(blade, wood.envelope)?),
        })
    };
    open.iter().step_by(open.len().div_ceil(MOST).max(1)).filter_map(bud).collect()
}
