//! Plants moved, scaled and put side by side.

use super::{Blade, Branch, Flower, Organ, Plant, RestSurface, Shape, TemplateId, Templates};
use glam::Vec3;

/// Step that keeps two points apart whose difference rounding has swallowed, as a share of their distance from the origin.
const APART: f32 = 1e-6;

impl Plant {
    /// Scales the plant about the origin and then moves it; `scale` is more than 0. Points that become one by rounding
    /// are one afterwards.
    pub fn scale_and_move(&mut self, scale: f32, by: Vec3) {
        let moved = |point: Vec3| point * scale + by;
        for branch in &mut self.branches {
            branch.radii.iter_mut().for_each(|radius| *radius *= scale);
            branch.points.iter_mut().for_each(|point| *point = moved(*point));
            keep_apart(&mut branch.points, Some(&mut branch.radii));
        }
        for flower in &mut self.flowers {
            flower.cone.apex = moved(flower.cone.apex);
            flower.cone.height *= scale;
            flower.centre_radius *= scale;
            flower.reach *= scale;
        }
        for organ in &mut self.organs {
            organ.shape.scale_and_move(scale, by);
        }
    }

    /// Puts another plant behind this one: its branches, flowers and organs keep their order and follow those that are
    /// there. Nothing of the other one is drawn, for a [`Provenance`](super::Provenance) knows one drawing only.
    pub fn append(&mut self, other: Self) {
        let Self { branches, flowers, organs, templates } = other;
        let (branch, flower) = (self.branches.len(), self.flowers.len());
        let on = |index: Option<usize>| index.map(|index| index + branch);
        self.branches.extend(branches.into_iter().map(|b| Branch { parent: on(b.parent), ..b }));
        self.flowers.extend(flowers.into_iter().map(|f| Flower { branch: on(f.branch), ..f }));
        let organ =
            |o: Organ| Organ { branch: on(o.branch), flower: o.flower.map(|index| index + flower), ..o };
        self.add_organs(organs.into_iter().map(organ), templates);
    }

    /// Puts organs behind those that are there. They grow on branches and flowers of this plant, but their blades are
    /// copies of these templates, which come along.
    pub fn add_organs(&mut self, organs: impl IntoIterator<Item = Organ>, templates: Templates) {
        let (first, here) = (self.organs.len(), self.templates.append(templates));
        self.organs.extend(organs);
        renumber(&mut self.organs[first..], here);
    }

    /// Drops the branches that are not `kept`; each that is kept has a parent that is. What stood on others stands on the nearest
    /// below that is kept.
    pub fn keep_branches(&mut self, kept: &[bool]) {
        let mut places: Vec<Option<usize>> = Vec::with_capacity(kept.len());
        let mut next = 0;
        for (branch, kept) in self.branches.iter().zip(kept) {
            let below = branch.parent.and_then(|parent| places[parent]);
            places.push(if *kept { Some(next) } else { below });
            next += usize::from(*kept);
        }
        let place = |old: Option<usize>| old.and_then(|old| places[old]);
        self.branches.iter_mut().for_each(|branch| branch.parent = place(branch.parent));
        self.flowers.iter_mut().for_each(|flower| flower.branch = place(flower.branch));
        self.organs.iter_mut().for_each(|organ| organ.branch = place(organ.branch));
        let mut is_kept = kept.iter();
        self.branches.retain(|_| is_kept.next().copied().unwrap_or(true));
    }

    /// Drops the templates of which there is no copy.
    pub fn drop_unused_templates(&mut self) {
        let mut is_used = vec![false; self.templates.len()];
        for blade in self.blades() {
            is_used[blade.template.index()] = true;
        }
        if is_used.contains(&false) {
            let here = self.templates.retain(|template| is_used[template.index()]);
            renumber(&mut self.organs, here);
        }
    }

    /// All blades, in their order.
    pub fn blades(&self) -> impl Iterator<Item = &Blade> {
        self.organs.iter().filter_map(|organ| match &organ.shape {
            Shape::Blade(blade) => Some(blade),
            _ => None,
        })
    }
}

/// Gives the blades among organs the places that their templates have now.
fn renumber(organs: &mut [Organ], here: impl Fn(TemplateId) -> TemplateId) {
    for organ in organs {
        if let Shape::Blade(blade) = &mut organ.shape {
            blade.template = here(blade.template);
        }
    }
}

impl Shape {
    /// Scales it about the origin and then moves it.
    fn scale_and_move(&mut self, scale: f32, by: Vec3) {
        let moved = |point: Vec3| point * scale + by;
        match self {
            Self::Blade(blade) => {
                (blade.base, blade.u, blade.v) = (moved(blade.base), blade.u * scale, blade.v * scale);
                if let RestSurface::Cone { cone, hint, sight }
                | RestSurface::Shaped { cone, hint, sight, .. } = &mut blade.rest
                {
                    cone.apex = moved(cone.apex);
                    cone.height *= scale;
                    *hint = *hint * scale + by.dot(*sight);
                }
            }
            Self::Dome { base, axis: _, radius, height } => {
                (*base, *radius, *height) = (moved(*base), *radius * scale, *height * scale);
            }
            Self::Filament { points, radius, head } => {
                points.iter_mut().for_each(|point| *point = moved(*point));
                keep_apart(points, None);
                (*radius, *head) = (*radius * scale, *head * scale);
            }
            Self::Lathe { base, axis: _, profile } => {
                *base = moved(*base);
                profile.iter_mut().for_each(|point| *point *= scale);
            }
            Self::Card { base, u, v, window: _, is_whole: _ } => {
                (*base, *u, *v) = (moved(*base), *u * scale, *v * scale);
            }
            Self::Spike { base, tip, side: _, foot, hook } => {
                (*base, *tip) = (moved(*base), moved(*tip));
                *foot *= scale;
                *hook *= scale;
            }
        }
    }
}

/// Takes out points that equal the one before them, with their radii; two are left at least.
fn keep_apart(points: &mut Vec<Vec3>, radii: Option<&mut Vec<f32>>) {
    if points.windows(2).all(|pair| pair[0] != pair[1]) {
        return;
    }
    let differs = |i: usize| i == 0 || points[i] != points[i - 1];
    let mut keep: Vec<bool> = (0..points.len()).map(differs).collect();
    if keep.iter().filter(|keep| **keep).count() < 2 {
        keep[1] = true;
        points[1] = points[0] + Vec3::Y * (APART * points[0].abs().max_element()).max(f32::MIN_POSITIVE);
    }
    let mut kept = keep.iter();
    points.retain(|_| *kept.next().unwrap_or(&true));
    let mut kept = keep.iter();
    radii.into_iter().for_each(|radii| radii.retain(|_| *kept.next().unwrap_or(&true)));
}

#[cfg(test)]
mod tests {
    use super::super::{BladeForm, Detail, OrganPart, Origin, Role, Template, WoodPart};
    use super::*;
    use glam::Vec2;

    fn stem(points: Vec<Vec3>, parent: Option<usize>) -> Branch {
        let (radii, level) = (vec![0.1; points.len()], u32::from(parent.is_some()));
        Branch { origin: Origin::Generated, parent, level, points, radii, role: Role::of(WoodPart::Stem) }
    }

    fn plant(branches: Vec<Branch>) -> Plant {
        Plant { branches, ..Plant::default() }
    }

    #[test]
    fn branches_of_the_second_plant_stand_on_its_own_ones() {
        let pair =
            || plant(vec![stem(vec![Vec3::ZERO, Vec3::Y], None), stem(vec![Vec3::Y, Vec3::X], Some(0))]);
        let mut both = pair();
        both.append(pair());
        assert_eq!(
            both.branches.iter().map(|b| b.parent).collect::<Vec<_>>(),
            [None, Some(0), None, Some(2)]
        );
        both.check_invariants().unwrap();
    }

    #[test]
    fn blades_of_both_plants_keep_their_templates() {
        let template = |length: f32| {
            let outline = [Vec2::ZERO, Vec2::new(0.5, 0.5), Vec2::Y, Vec2::new(-0.5, 0.5)];
            let outline = outline.map(|point| point * length).to_vec();
            Template::new(outline, Vec::new(), length, Detail::Reduced)
        };
        let leafy = |lengths: &[f32]| {
            let mut plant = Plant::default();
            for length in lengths {
                let (template, form) = (plant.templates.add(template(*length)), BladeForm::default());
                let (base, rest) = (Vec3::ZERO, RestSurface::Plane);
                let shape = Shape::Blade(Blade { template, base, u: Vec3::X, v: Vec3::Y, rest, form });
                let (role, origin) = (Role::of(OrganPart::Leaf), Origin::Generated);
                plant.organs.push(Organ { role, origin, branch: None, flower: None, shape });
            }
            plant
        };
        let mut both = leafy(&[1.0, 2.0]);
        both.append(leafy(&[3.0, 4.0]));
        let lengths = |plant: &Plant| -> Vec<f32> {
            plant.blades().map(|blade| plant.templates[blade.template].length()).collect()
        };
        assert_eq!(lengths(&both), [1.0, 2.0, 3.0, 4.0]);
        both.check_invariants().unwrap();
        both.organs.remove(2);
        assert!(both.check_invariants().unwrap_err().contains("template 2"));
        both.drop_unused_templates();
        both.check_invariants().unwrap();
        assert_eq!((lengths(&both), both.templates.len()), (vec![1.0, 2.0, 4.0], 3));
    }

    #[test]
    fn what_rounding_swallows_leaves_a_sound_plant() {
        let near = |k: u8| Vec3::Y * (f32::from(k) * 1e-6);
        let far = plant(vec![stem((0..5).map(near).collect(), None), stem(vec![Vec3::ZERO, Vec3::Y], None)]);
        for by in [Vec3::ZERO, Vec3::X * 100.0, Vec3::splat(-3e4)] {
            let mut moved = far.clone();
            moved.scale_and_move(0.5, by);
            moved.check_invariants().unwrap();
            assert_eq!(moved.branches[1].points, [by, by + Vec3::Y * 0.5]);
            assert_eq!(moved.branches[1].radii, [0.05, 0.05]);
        }
    }
}
