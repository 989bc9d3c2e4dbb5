//! Flower buds: flowers that have not opened yet.
//!
//! They stand beside the plant that carries them, not in it: a maker gives both, and a species makes flowers of the plant out
//! of them or drops them, so that no finished plant has any.

use super::invariants::ensure;
use super::{Origin, Plant};
use glam::Vec3;

/// A flower that has not opened; a species says what it becomes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlowerBud {
    /// What it is known by.
    pub origin: Origin,
    /// The branch it grows on.
    pub branch: Option<usize>,
    /// Where it stands, metres.
    pub base: Vec3,
    /// Vector to its right seen on its face, metres.
    pub u: Vec3,
    /// Vector in which it opens; its length is the flower's size, metres.
    pub v: Vec3,
    /// Which of the species' flowers it is; taken in turn where the species has fewer.
    pub look: usize,
    /// How far it has opened of what its species' flowers open: 0 not at all, 1 all the way.
    pub open: f32,
}

/// The flower buds of a plant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FlowerBuds {
    /// Each of them.
    pub buds: Vec<FlowerBud>,
    /// Whether there would be more if a plant might have more.
    pub is_thinned: bool,
}

impl FlowerBuds {
    /// Checks every bud.
    ///
    /// # Errors
    /// The first violation, in words.
    pub fn check_invariants(&self, plant: &Plant) -> Result<(), String> {
        let check = |(i, bud): (usize, &FlowerBud)| {
            bud.check_invariants(plant).map_err(|what| format!("bud {i}: {what}"))
        };
        self.buds.iter().enumerate().try_for_each(check)
    }
}

impl FlowerBud {
    /// Checks that it grows on a branch of the plant, and that its pose is finite.
    fn check_invariants(&self, plant: &Plant) -> Result<(), String> {
        ensure(self.branch.is_none_or(|b| b < plant.branches.len()), || "branch out of range".to_owned())?;
        let is_finite = self.base.is_finite() && self.u.is_finite() && self.v.is_finite();
        ensure(is_finite, || "pose not finite".to_owned())?;
        ensure((0.0..=1.0).contains(&self.open), || "opening out of range".to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn buds_that_cannot_be_are_named() {
        let origin = Origin::Generated;
        let bud =
            FlowerBud { origin, branch: None, base: Vec3::Y, u: Vec3::X, v: Vec3::Y, look: 0, open: 1.0 };
        let check = |second: FlowerBud| {
            FlowerBuds { buds: vec![bud, second], is_thinned: false }.check_invariants(&Plant::default())
        };
        let fault = |second: FlowerBud| check(second).expect_err("must be noticed");
        assert_eq!(check(bud), Ok(()));
        assert!(fault(FlowerBud { branch: Some(0), ..bud }).contains("bud 1: branch"));
        assert!(fault(FlowerBud { v: Vec3::NAN, ..bud }).contains("bud 1: pose"));
        assert!(fault(FlowerBud { open: 1.5, ..bud }).contains("bud 1: opening"));
    }
}
