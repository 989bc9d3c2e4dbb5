//! What growth looks like from inside: markers of space, buds, and light, at any age that a plant has lived through.
//!
//! Plain data for a picture. A bud counts as active in the year that laid it down and as dormant once it has been passed
//! over. Shadows of an age before the plant's own are cast anew by the nodes that lived then. Where there is more than
//! [`MOST`] of a kind, every n-th is taken: of the markers the same ones at every age.

use super::resource::Field;
use super::resource::markers::Markers;
use super::resource::shadow::Shadow;
use super::simulation::Simulation;
use super::tree::Tree;
use crate::random::{Choice, mix};
use glam::Vec3;

/// Most spots of one kind.
pub const MOST: usize = 50_000;
/// Radius of a marker, as a share of the distance between markers.
const MARKER: f32 = 0.13;
/// Radius of a bud, internodes.
const BUD: f32 = 0.13;
/// How far it is shown where a bud will go, internodes.
const WAY: f32 = 1.0;
/// Radius of a spot without light, voxels; spots of full light are smaller, so that they do not hide the crown.
const VOXEL: f32 = 0.2;
/// How far spots of light are scattered about their voxels, voxels: rows of them would hide each other.
const ASIDE: f32 = 0.8;
/// Shadow from which a voxel counts as shaded, as a share of full light.
const SHADE: f32 = 0.05;

/// What is to be seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wanted {
    /// Markers of space.
    pub markers: bool,
    /// Buds.
    pub buds: bool,
    /// Light in the voxels above the ground that are shaded.
    pub light: bool,
}

impl Wanted {
    /// Whether there is anything to be seen.
    pub fn any(self) -> bool {
        self.markers || self.buds || self.light
    }
}

/// What stands at a spot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A marker that no node occupies.
    Free,
    /// A marker that a node occupies.
    Taken,
    /// A bud of this year; `way` is where it will go, metres.
    Active {
        /// From the bud to where its shoot is headed.
        way: Vec3,
    },
    /// A bud that was passed over.
    Dormant {
        /// From the bud to where its shoot would be headed.
        way: Vec3,
    },
    /// A voxel of light.
    Light {
        /// Light that a bud would have there, as a share of full light, 0 to 1.
        exposure: f32,
    },
}

/// One spot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Place, metres.
    pub at: Vec3,
    /// Radius, metres.
    pub radius: f32,
    /// What stands there.
    pub kind: Kind,
}

/// What is wanted of a plant at an age in years; of years that have not ended the last whole one. A plant that competes
/// for light has no markers, and one that competes for space no light.
pub fn overlay(simulation: &Simulation, age: f32, wanted: Wanted) -> Vec<Spot> {
    let year = (age.max(0.0) as u16).min(simulation.age());
    let mut spots = Vec::new();
    match simulation.field() {
        Field::Space(markers) if wanted.markers => spots.extend(of_markers(markers, year)),
        Field::Light(shadow) if wanted.light => spots.extend(of_light(&simulation.shadow_at(shadow, year))),
        Field::Space(_) | Field::Light(_) => {}
    }
    if wanted.buds {
        spots.extend(of_buds(simulation.tree(), year, simulation.habit().internode));
    }
    spots
}

fn of_markers(markers: &Markers, year: u16) -> Vec<Spot> {
    let radius = MARKER / markers.density.max(f32::MIN_POSITIVE).cbrt();
    let spot = |(at, taken)| Spot { at, radius, kind: if taken { Kind::Taken } else { Kind::Free } };
    markers.at_age(year, every(markers.len())).map(spot).collect()
}

fn of_buds(tree: &Tree, year: u16, internode: f32) -> Vec<Spot> {
    let buds = &tree.buds;
    let open = |b: &usize| buds.settled[*b] > year && tree.lives(buds.node[*b] as usize, year);
    let there: Vec<usize> = (0..buds.born.partition_point(|born| *born <= year)).filter(open).collect();
    let spot = |&b: &usize| {
        let way = buds.direction[b] * internode * WAY;
        let kind = if buds.born[b] == year { Kind::Active { way } } else { Kind::Dormant { way } };
        Spot { at: tree.nodes.at[buds.node[b] as usize], radius: BUD * internode, kind }
    };
    there.iter().step_by(every(there.len())).map(spot).collect()
}

fn of_light(shadow: &Shadow) -> Vec<Spot> {
    let voxel = shadow.voxel();
    let spot = |(middle, exposure): (Vec3, f32)| {
        let key = middle.to_array().iter().fold(0, |key, x| mix(key, u64::from(x.to_bits())));
        let aside = Vec3::from_array(Choice::ASIDE.units(key).map(|unit| unit - 0.5));
        let radius = VOXEL * voxel * (1.0 - 0.7 * exposure);
        Spot { at: middle + aside * ASIDE * voxel, radius, kind: Kind::Light { exposure } }
    };
    let shaded = || shadow.shaded(SHADE * shadow.full()).filter(|(at, _)| at.y > 0.0);
    shaded().step_by(every(shaded().count())).map(spot).collect()
}

/// Every how many-th of `count` is shown.
fn every(count: usize) -> usize {
    count.div_ceil(MOST).max(1)
}

#[cfg(test)]
#[path = "overlay_tests.rs"]
mod tests;
