//! Motions of the parts of a plant: what turns with a branch keeps its shape, and may become larger.

use super::{Blade, Flower, FlowerBud, Organ, RestSurface, Shape};
use glam::{Quat, Vec3};

/// A turn about a place that is moved to another one, and a change of size about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// The turn, of unit length.
    pub turn: Quat,
    /// What is moved.
    pub from: Vec3,
    /// Where it comes to.
    pub to: Vec3,
    /// How many times as large things become.
    pub size: f32,
}

impl Motion {
    /// Where a point comes to.
    pub fn point(&self, point: Vec3) -> Vec3 {
        self.to + self.turn * (self.size * (point - self.from))
    }

    /// Where a point was before.
    pub fn back(&self, point: Vec3) -> Vec3 {
        self.from + self.turn.inverse() * (point - self.to) / self.size
    }

    /// What a direction becomes, which keeps its length.
    pub fn way(&self, way: Vec3) -> Vec3 {
        self.turn * way
    }

    /// What the vector from one point to another becomes.
    fn vector(&self, vector: Vec3) -> Vec3 {
        self.turn * (self.size * vector)
    }
}

impl Organ {
    /// Moves it.
    pub fn move_by(&mut self, motion: &Motion) {
        let (point, way) = (|p: &mut Vec3| *p = motion.point(*p), |v: &mut Vec3| *v = motion.way(*v));
        let vector = |v: &mut Vec3| *v = motion.vector(*v);
        match &mut self.shape {
            Shape::Blade(blade) => blade.move_by(motion),
            Shape::Dome { base, axis, radius, height } => {
                point(base);
                way(axis);
                (*radius, *height) = (*radius * motion.size, *height * motion.size);
            }
            Shape::Lathe { base, axis, profile } => {
                point(base);
                way(axis);
                profile.iter_mut().for_each(|p| *p *= motion.size);
            }
            Shape::Filament { points, radius, head } => {
                points.iter_mut().for_each(point);
                (*radius, *head) = (*radius * motion.size, *head * motion.size);
            }
            Shape::Card { base, u, v, .. } => {
                point(base);
                vector(u);
                vector(v);
            }
            Shape::Spike { base, tip, side, hook, foot } => {
                point(base);
                point(tip);
                way(side);
                vector(hook);
                *foot *= motion.size;
            }
        }
    }
}

impl Flower {
    /// Moves it; its organs are moved by themselves.
    pub fn move_by(&mut self, motion: &Motion) {
        (self.cone.apex, self.cone.axis) = (motion.point(self.cone.apex), motion.way(self.cone.axis));
        self.cone.height *= motion.size;
        (self.centre_radius, self.reach) = (self.centre_radius * motion.size, self.reach * motion.size);
    }
}

impl FlowerBud {
    /// Moves it.
    pub fn move_by(&mut self, motion: &Motion) {
        (self.base, self.u, self.v) = (motion.point(self.base), motion.vector(self.u), motion.vector(self.v));
    }
}

impl<T> Blade<T> {
    /// Moves it with its rest surface.
    pub fn move_by(&mut self, motion: &Motion) {
        (self.base, self.u, self.v) = (motion.point(self.base), motion.vector(self.u), motion.vector(self.v));
        if let RestSurface::Cone { cone, hint, sight } | RestSurface::Shaped { cone, hint, sight, .. } =
            &mut self.rest
        {
            let depth = motion.size * (*hint - cone.apex.dot(*sight));
            (cone.apex, cone.axis) = (motion.point(cone.apex), motion.way(cone.axis));
            cone.height *= motion.size;
            *sight = motion.way(*sight);
            *hint = cone.apex.dot(*sight) + depth;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{BladeForm, Cone, Detail, OrganPart, Origin, Role, Template};
    use glam::Vec2;

    #[test]
    fn a_petal_on_its_cone_turns_as_a_whole() {
        let outline = [Vec2::ZERO, Vec2::new(0.5, 0.5), Vec2::Y, Vec2::new(-0.5, 0.5)].to_vec();
        let template = Template::new(outline, Vec::new(), 1.0, Detail::Full);
        let axis = Vec3::new(0.2, 0.4, 1.0).normalize();
        let cone = Cone { apex: Vec3::new(0.1, 0.2, -0.3), axis, opening_rad: 0.9, height: 1.0 };
        let rest = RestSurface::Cone { cone, hint: 0.1, sight: Vec3::Z };
        let (base, form) = (cone.apex, BladeForm::default());
        let petal = Blade { template: &template, base, u: Vec3::X, v: Vec3::Y, rest, form };
        let turn = Quat::from_euler(glam::EulerRot::XYZ, 0.7, -1.1, 2.0);
        let motion =
            Motion { turn, from: Vec3::new(0.3, 0.0, 0.2), to: Vec3::new(-1.0, 2.0, 0.5), size: 1.6 };
        let mut moved = petal.clone();
        moved.move_by(&motion);
        for uv in [Vec2::ZERO, Vec2::Y, Vec2::new(0.3, 0.6), Vec2::new(-0.2, 0.3)] {
            let (expected, found) = (motion.point(petal.at_rest(uv)), moved.at_rest(uv));
            assert!(expected.distance(found) < 1e-5, "{uv}: {found}, not {expected}");
            assert!(motion.back(found).distance(petal.at_rest(uv)) < 1e-5);
        }
    }

    #[test]
    fn solids_keep_their_shape() {
        let shape =
            Shape::Spike { base: Vec3::X, tip: Vec3::X * 2.0, side: Vec3::Y, foot: Vec2::ONE, hook: Vec3::Z };
        let (role, origin) = (Role::of(OrganPart::Leaf), Origin::Generated);
        let mut organ = Organ { role, origin, branch: None, flower: None, shape };
        let turn = Quat::from_rotation_z(std::f32::consts::FRAC_PI_2);
        organ.move_by(&Motion { turn, from: Vec3::ZERO, to: Vec3::ZERO, size: 1.0 });
        let Shape::Spike { base, tip, side, hook, .. } = organ.shape else { panic!("another shape") };
        let near = |a: Vec3, b: Vec3| a.distance(b) < 1e-6;
        assert!(
            near(base, Vec3::Y) && near(tip, Vec3::Y * 2.0) && near(side, Vec3::NEG_X) && near(hook, Vec3::Z)
        );
    }
}
