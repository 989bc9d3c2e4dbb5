//! What must hold for every [`Plant`]; called by tests, property tests, fuzz targets and debug builds.

use super::{Blade, Branch, Organ, Plant, RestSurface, Shape};
use glam::{Vec2, Vec3};

impl Plant {
    /// Checks indices, topological order, finite numbers, positive sizes, and that templates are sound and in use.
    ///
    /// # Errors
    /// The first violation, in words.
    pub fn check_invariants(&self) -> Result<(), String> {
        for (i, branch) in self.branches.iter().enumerate() {
            let here = |what: &str| format!("branch {i}: {what}");
            ensure(branch.parent.is_none_or(|p| p < i), || here("parent stands after it"))?;
            ensure(branch.points.len() >= 2, || here("fewer than two points"))?;
            ensure(branch.points.len() == branch.radii.len(), || here("points and radii differ in number"))?;
            ensure(branch.points.iter().all(|p| p.is_finite()), || here("point not finite"))?;
            ensure(branch.points.windows(2).all(|w| w[0] != w[1]), || here("repeated point"))?;
            ensure(branch.radii.iter().all(|r| r.is_finite() && *r > 0.0), || here("radius not positive"))?;
            self.check_level(branch).map_err(|what| here(&what))?;
        }
        for (i, flower) in self.flowers.iter().enumerate() {
            let here = |what: &str| format!("flower {i}: {what}");
            ensure(flower.branch.is_none_or(|b| b < self.branches.len()), || here("branch out of range"))?;
            ensure(is_unit(flower.cone.axis), || here("axis is not a unit vector"))?;
            ensure(flower.cone.apex.is_finite(), || here("apex not finite"))?;
            ensure(flower.reach.is_finite() && flower.reach > 0.0, || here("reach not positive"))?;
            ensure(flower.centre_radius.is_finite() && flower.centre_radius >= 0.0, || {
                here("radius of the centre negative")
            })?;
        }
        for (i, template) in self.templates.iter().enumerate() {
            template.check_invariants().map_err(|what| format!("template {i}: {what}"))?;
        }
        self.organs.iter().enumerate().try_for_each(|(i, organ)| self.check_organ(i, organ))?;
        let mut is_used = vec![false; self.templates.len()];
        self.blades().for_each(|blade| is_used[blade.template.index()] = true);
        match is_used.iter().position(|is_used| !is_used) {
            Some(i) => Err(format!("template {i}: nothing is a copy of it")),
            None => Ok(()),
        }
    }

    fn check_level(&self, branch: &Branch) -> Result<(), String> {
        let parent = branch.parent.map(|parent| &self.branches[parent]);
        let above = parent.map(|parent| parent.level);
        let is_next = branch.level == above.map_or(0, |level| level + 1);
        // The stems of a bush stand on the first of them, which stands on the ground.
        let is_on_first_stem = branch.is_basal_stem() && parent.is_some_and(|parent| parent.parent.is_none());
        ensure(is_next || is_on_first_stem, || {
            format!("level {} on a parent of level {above:?}", branch.level)
        })
    }

    fn check_organ(&self, i: usize, organ: &Organ) -> Result<(), String> {
        let here = |what: &str| format!("organ {i} ({:?}): {what}", organ.role);
        ensure(organ.branch.is_none_or(|b| b < self.branches.len()), || here("branch out of range"))?;
        ensure(organ.flower.is_none_or(|f| f < self.flowers.len()), || here("flower out of range"))?;
        let look = organ.flower.map_or(0, |flower| self.flowers[flower].look);
        ensure(organ.role.look as usize == look, || here("look is not its flower's"))?;
        match &organ.shape {
            Shape::Blade(blade) => {
                ensure(self.templates.get(blade.template).is_some(), || here("template out of range"))?;
                let Blade { base, u, v, rest, .. } = blade;
                ensure(base.is_finite() && u.is_finite() && v.is_finite(), || here("pose not finite"))?;
                let is_sound = match rest {
                    RestSurface::Plane | RestSurface::Cone { .. } => true,
                    RestSurface::Patch(patch) | RestSurface::Shaped { ways: patch, .. } => patch.is_finite(),
                    RestSurface::Ring(sheet) => sheet.is_finite(),
                };
                ensure(is_sound, || here("rest surface not finite"))
            }
            Shape::Dome { base, axis, radius, height } => {
                ensure(base.is_finite() && is_unit(*axis), || here("pose"))?;
                ensure(*radius > 0.0 && *height > 0.0, || here("size not positive"))
            }
            Shape::Filament { points, radius, head } => {
                ensure(points.len() >= 2 && points.iter().all(|p| p.is_finite()), || here("points"))?;
                ensure(points.windows(2).all(|w| w[0] != w[1]), || here("repeated point"))?;
                ensure(*radius > 0.0 && head.min_element() >= 0.0, || here("size not positive"))
            }
            Shape::Card { base, u, v, window: [low, high], .. } => {
                ensure(base.is_finite() && u.is_finite() && v.is_finite(), || here("pose not finite"))?;
                let within = |corner: &Vec2| corner.cmpge(Vec2::ZERO).all() && corner.cmple(Vec2::ONE).all();
                ensure(within(low) && within(high) && low.cmplt(*high).all(), || here("window"))
            }
            Shape::Spike { base, tip, side, foot, hook } => {
                ensure(base.is_finite() && tip.is_finite() && hook.is_finite(), || here("pose"))?;
                ensure(is_unit(*side) && base != tip, || here("pose"))?;
                ensure(foot.is_finite() && foot.min_element() > 0.0, || here("size not positive"))
            }
            Shape::Lathe { base, axis, profile } => {
                ensure(base.is_finite() && is_unit(*axis), || here("pose"))?;
                ensure(profile.len() >= 3 && profile.iter().all(|p| p.is_finite()), || here("profile"))
            }
        }
    }
}

fn is_unit(v: Vec3) -> bool {
    (v.length_squared() - 1.0).abs() < 1e-3
}

pub(super) fn ensure(holds: bool, what: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(what()) }
}

#[cfg(test)]
mod tests {
    use super::super::{Cone, Flower, OrganPart, Origin, Role, WoodPart};
    use super::*;

    fn branch(parent: Option<usize>, level: u32) -> Branch {
        let (origin, role) = (Origin::Generated, Role::of(WoodPart::Stem));
        Branch { origin, parent, level, points: vec![Vec3::ZERO, Vec3::Y], radii: vec![0.1; 2], role }
    }

    fn organ(shape: Shape) -> Organ {
        let (origin, role) = (Origin::Generated, Role::of(OrganPart::Disc));
        Organ { role, origin, branch: Some(1), flower: Some(0), shape }
    }

    /// A bush of two stems with a twig, a flower and a solid of each kind.
    fn bush() -> Plant {
        let cone = Cone { apex: Vec3::Y, axis: Vec3::Y, opening_rad: 0.5, height: 0.1 };
        let (base, axis, points) = (Vec3::Y, Vec3::Y, vec![Vec3::ZERO, Vec3::Y]);
        Plant {
            branches: vec![branch(None, 0), branch(Some(0), 0), branch(Some(1), 1)],
            flowers: vec![Flower {
                origin: Origin::Generated,
                branch: Some(1),
                cone,
                centre_radius: 0.01,
                reach: 0.1,
                look: 0,
            }],
            organs: vec![
                organ(Shape::Dome { base, axis, radius: 0.1, height: 0.1 }),
                organ(Shape::Filament { points, radius: 0.1, head: Vec2::ZERO }),
                organ(Shape::Lathe { base, axis, profile: vec![Vec2::ZERO, Vec2::X, Vec2::Y] }),
            ],
            ..Plant::default()
        }
    }

    /// The words about a bush after something was done to it.
    fn after(change: impl FnOnce(&mut Plant)) -> String {
        let mut plant = bush();
        change(&mut plant);
        plant.check_invariants().expect_err("the change must be noticed")
    }

    fn shape(of: &mut Plant, number: usize) -> &mut Shape {
        &mut of.organs[number].shape
    }

    #[test]
    fn a_sound_plant_is_sound() {
        assert_eq!(bush().check_invariants(), Ok(()));
        assert_eq!(Plant::default().check_invariants(), Ok(()));
    }

    #[test]
    fn branches_that_cannot_be_are_named() {
        assert!(after(|p| p.branches[0].parent = Some(0)).contains("branch 0: parent"));
        assert!(after(|p| p.branches[1].parent = Some(2)).contains("branch 1: parent"));
        assert!(after(|p| p.branches[2].level = 2).contains("branch 2: level 2"));
        assert!(after(|p| p.branches[2].level = 0).contains("branch 2: level 0"), "a stem on a stem");
        assert!(after(|p| p.branches[0].level = 1).contains("branch 0: level 1"));
        assert!(after(|p| p.branches[1].points.truncate(1)).contains("fewer than two points"));
        assert!(after(|p| p.branches[1].points.push(Vec3::X)).contains("differ in number"));
        assert!(after(|p| p.branches[1].points[0] = Vec3::Y).contains("repeated point"));
        assert!(after(|p| p.branches[1].points[0].x = f32::NAN).contains("not finite"));
        assert!(after(|p| p.branches[1].radii[1] = 0.0).contains("radius not positive"));
    }

    #[test]
    fn flowers_that_cannot_be_are_named() {
        assert!(after(|p| p.flowers[0].branch = Some(3)).contains("flower 0: branch out of range"));
        assert!(after(|p| p.flowers[0].cone.axis = 2.0 * Vec3::Y).contains("unit"));
        assert!(after(|p| p.flowers[0].cone.apex.y = f32::INFINITY).contains("apex"));
        assert!(after(|p| p.flowers[0].reach = 0.0).contains("reach"));
        assert!(after(|p| p.flowers[0].centre_radius = -0.1).contains("centre"));
        assert!(after(|p| p.flowers[0].look = 1).contains("look"));
    }

    #[test]
    fn organs_that_cannot_be_are_named() {
        assert!(after(|p| p.organs[0].branch = Some(3)).contains("branch out of range"));
        assert!(after(|p| p.organs[1].flower = Some(1)).contains("flower out of range"));
        let dome = |axis, radius| Shape::Dome { base: Vec3::ZERO, axis, radius, height: 0.1 };
        assert!(after(|p| *shape(p, 0) = dome(Vec3::Y, 0.0)).contains("size"));
        assert!(after(|p| *shape(p, 0) = dome(Vec3::ZERO, 0.1)).contains("pose"));
        let filament = |points| Shape::Filament { points, radius: 0.1, head: Vec2::ZERO };
        assert!(after(|p| *shape(p, 1) = filament(vec![Vec3::ZERO])).contains("organ 1"));
        assert!(after(|p| *shape(p, 1) = filament(vec![Vec3::ZERO; 2])).contains("repeated"));
        let lathe = Shape::Lathe { base: Vec3::ZERO, axis: Vec3::Y, profile: vec![Vec2::ZERO; 2] };
        assert!(after(|p| *shape(p, 2) = lathe).contains("profile"));
    }
}
