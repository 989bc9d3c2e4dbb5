//! The volume that a plant may fill.
//!
//! Markers are scattered inside of it, and no shoot that is inside grows out of it. A species may bring a crown of its own,
//! a profile turned about the trunk; a drawn outline is inflated ([`Inflated`]), a modelled volume read ([`Solid`]), and lobes
//! drawn in space are put together ([`Lobes`]).
//!
//! Limits: a shoot is tested at its end and three places between; a gap thinner than a quarter of an internode may be
//! crossed.

use super::inflated::Inflated;
use super::lobes::Lobes;
use super::solid::Solid;
use super::swept::Swept;
use crate::random::Choice;
use glam::Vec3;
use std::sync::Arc;

/// A volume.
#[derive(Clone, Debug)]
pub enum Envelope {
    /// Everywhere: nothing but light and vigour bound the plant.
    Free,
    /// An upright box.
    Box {
        /// Smallest corner, metres.
        low: Vec3,
        /// Largest corner, metres.
        high: Vec3,
    },
    /// A sphere.
    Sphere {
        /// Centre, metres.
        centre: Vec3,
        /// Radius, metres.
        radius: f32,
    },
    /// An upright ellipsoid.
    Ellipsoid {
        /// Centre, metres.
        centre: Vec3,
        /// Half axes, metres.
        radii: Vec3,
    },
    /// A profile turned about an upright axis, a little uneven.
    Crown(Arc<Crown>),
    /// Inside a closed mesh.
    Solid(Arc<Solid>),
    /// Inside a drawn outline made round.
    Inflated(Arc<Inflated>),
    /// Inside of lobes together.
    Lobes(Arc<Lobes>),
    /// What a brush sweeps.
    Swept(Arc<Swept>),
}

/// A crown: radius over height, with lumps as leaves gather in clouds.
#[derive(Clone, Debug, PartialEq)]
pub struct Crown {
    /// Where the axis meets the ground, metres.
    pub foot: Vec3,
    /// (height, radius) in metres, heights strictly rising, at least two.
    pub profile: Vec<(f32, f32)>,
    /// Height of the lumps as a share of the radius.
    pub lumps: f32,
    /// Decides where the lumps are.
    pub seed: u64,
}

impl Crown {
    fn contains(&self, p: Vec3) -> bool {
        let q = p - self.foot;
        let after = self.profile.partition_point(|(height, _)| *height <= q.y);
        let pair = after.checked_sub(1).and_then(|k| Some((self.profile.get(k)?, self.profile.get(after)?)));
        let Some((&(a, x), &(b, y))) = pair else { return false };
        let radius = x + (y - x) * ((q.y - a) / (b - a));
        let squared = q.x * q.x + q.z * q.z;
        if squared > (radius * (1.0 + self.lumps)).powi(2) {
            return false;
        }
        let top = self.profile.last().map_or(1.0, |k| k.0);
        let wave = self.wave(q.z.atan2(q.x), q.y / top);
        squared <= (radius * (1.0 + self.lumps * wave)).powi(2)
    }

    /// Three waves around and along, −1 to 1.
    fn wave(&self, around: f32, height: f32) -> f32 {
        let phases = Choice::LUMPS.units(self.seed).map(|unit| unit * std::f32::consts::TAU);
        let waves = [(2.0, 4.0), (3.0, 9.0), (5.0, 15.0)].iter().zip(phases);
        let sum: f32 = waves.map(|((m, n), phase)| (m * around + n * height + phase).sin()).sum();
        sum / 3.0
    }
}

impl Envelope {
    /// Whether a point lies inside.
    pub fn contains(&self, p: Vec3) -> bool {
        match self {
            Self::Free => true,
            Self::Box { low, high } => p.cmpge(*low).all() && p.cmple(*high).all(),
            Self::Sphere { centre, radius } => p.distance_squared(*centre) <= radius * radius,
            Self::Ellipsoid { centre, radii } => ((p - centre) / *radii).length_squared() <= 1.0,
            Self::Crown(crown) => crown.contains(p),
            Self::Solid(solid) => solid.contains(p),
            Self::Inflated(inflated) => inflated.contains(p),
            Self::Lobes(lobes) => lobes.contains(p),
            Self::Swept(swept) => swept.contains(p),
        }
    }

    /// Share of the space at a place inside that growth finds, 0 to 1.
    pub fn density(&self, p: Vec3) -> f32 {
        match self {
            Self::Inflated(inflated) => inflated.density(p),
            _ => 1.0,
        }
    }

    /// Smallest and largest corner, `None` for [`Envelope::Free`].
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        match self {
            Self::Free => None,
            Self::Box { low, high } => Some((*low, *high)),
            Self::Sphere { centre, radius } => Some((*centre - *radius, *centre + *radius)),
            Self::Ellipsoid { centre, radii } => Some((*centre - *radii, *centre + *radii)),
            Self::Crown(crown) => {
                let widest = crown.profile.iter().map(|k| k.1).fold(0.0, f32::max) * (1.0 + crown.lumps);
                let (low, high) = (crown.profile.first()?.0, crown.profile.last()?.0);
                Some((
                    crown.foot + Vec3::new(-widest, low, -widest),
                    crown.foot + Vec3::new(widest, high, widest),
                ))
            }
            Self::Solid(solid) => Some(solid.bounds()),
            Self::Inflated(inflated) => Some(inflated.bounds()),
            Self::Lobes(lobes) => Some(lobes.bounds()),
            Self::Swept(swept) => Some(swept.bounds()),
        }
    }

    /// Elementary steps that one question for a point takes, about.
    pub fn steps(&self) -> u64 {
        match self {
            Self::Free => 0,
            Self::Box { .. } | Self::Sphere { .. } | Self::Ellipsoid { .. } => 2,
            Self::Crown(crown) => 80 + crown.profile.len() as u64,
            Self::Solid(solid) => 8 * solid.triangles_over_a_point(),
            Self::Inflated(inflated) => 20 + inflated.edges_beside_a_point(),
            Self::Lobes(lobes) => 8 * lobes.triangles_over_a_point(),
            Self::Swept(swept) => swept.balls_beside_a_point(),
        }
    }

    /// Whether the straight way between two points stays inside, tested at its end and three places between.
    pub fn holds(&self, from: Vec3, to: Vec3) -> bool {
        matches!(self, Self::Free) || [1.0, 0.5, 0.25, 0.75].iter().all(|t| self.contains(from.lerp(to, *t)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn simple_volumes_hold_their_middle_and_not_their_outside() {
        let (low, high) = (Vec3::new(-1.0, 0.0, -1.0), Vec3::new(1.0, 4.0, 1.0));
        let centre = Vec3::Y * 2.0;
        let crown = Crown {
            foot: Vec3::ZERO,
            profile: vec![(0.5, 0.2), (2.0, 1.0), (4.0, 0.1)],
            lumps: 0.1,
            seed: 3,
        };
        let volumes = [
            Envelope::Box { low, high },
            Envelope::Sphere { centre, radius: 1.0 },
            Envelope::Ellipsoid { centre, radii: Vec3::new(1.0, 2.0, 1.0) },
            Envelope::Crown(Arc::new(crown)),
        ];
        for volume in volumes {
            assert!(volume.contains(centre), "{volume:?}");
            let (low, high) = volume.bounds().unwrap();
            for k in 0..3 {
                let out = Vec3::AXES[k] * (high - low)[k];
                assert!(!volume.contains(centre + out) && !volume.contains(centre - out), "{volume:?}");
            }
            assert!(!volume.contains(Vec3::NAN) && !volume.holds(centre, high * 2.0));
        }
        assert!(Envelope::Free.bounds().is_none() && Envelope::Free.contains(Vec3::splat(1e9)));
    }
}
