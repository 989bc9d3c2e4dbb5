//! What must hold for every [`Plant`]; called by tests, property tests, fuzz targets and debug builds.

use super::{Blade, Branch, Organ, Plant, Shape};
use glam::Vec3;

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
        }
        for (i, bud) in self.buds.iter().enumerate() {
            let here = |what: &str| format!("bud {i}: {what}");
            ensure(bud.branch.is_none_or(|b| b < self.branches.len()), || here("branch out of range"))?;
            ensure(bud.base.is_finite() && bud.u.is_finite() && bud.v.is_finite(), || {
                here("pose not finite")
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
        let above = branch.parent.map(|parent| self.branches[parent].level);
        let is_next = branch.level == above.map_or(0, |level| level + 1);
        ensure(is_next || (branch.is_basal_stem() && above == Some(0)), || {
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
                let Blade { base, u, v, .. } = blade;
                ensure(base.is_finite() && u.is_finite() && v.is_finite(), || here("pose not finite"))
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

fn ensure(holds: bool, what: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(what()) }
}
