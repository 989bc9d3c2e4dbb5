//! The corners of models, one after the other: those of meshes are kept from one to the next.

use super::{Mesh, Model};
use crate::kept::{Kept, Same};
use glam::Vec3;
use std::sync::Arc;

/// Smallest and largest corner, metres.
type Corners = (Vec3, Vec3);

/// Corners of the meshes of the last model.
#[derive(Debug, Default)]
pub struct KnownBounds(Kept<Same<Mesh>, Option<Corners>>);

impl KnownBounds {
    /// Smallest and largest corner of a model, those of [`Model::bounds`].
    pub fn of(&mut self, model: &Model) -> Option<Corners> {
        let meshes: Vec<&Arc<Mesh>> = model.parts.iter().map(|part| &part.mesh).collect();
        let of_meshes =
            self.0.made(&meshes, |mesh| Same::of(mesh), |mesh| corners(mesh.points.iter().copied()));
        let copies =
            model.parts.iter().filter_map(|part| part.copies.as_deref()).flat_map(|copies| copies.iter());
        let of_copies = corners(copies.flat_map(|(shape, placement)| placement.places(&shape.points)));
        of_meshes.into_iter().flatten().chain(of_copies).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
    }
}

fn corners(mut points: impl Iterator<Item = Vec3>) -> Option<Corners> {
    let first = points.next()?;
    Some(points.fold((first, first), |(low, high), p| (low.min(p), high.max(p))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::ModelParams;
    use crate::plant::{FinishedPlant, Plant};

    #[test]
    fn corners_that_are_kept_are_those_of_the_model() {
        let mesh = |x: f32| Arc::new(Mesh { points: vec![Vec3::X * x, Vec3::Y], ..Mesh::default() });
        let mut model = crate::model::build(&FinishedPlant::plain(Plant::default()), &ModelParams::default());
        let mut known = KnownBounds::default();
        assert_eq!(known.of(&model), None);
        for x in [3.0, -2.0] {
            let part = super::super::Part {
                name: String::new(),
                kind: super::super::PartKind::Wood,
                parent: None,
                specimen: 0,
                pivot: Vec3::ZERO,
                material: 0,
                more_materials: Vec::new(),
                mesh: mesh(x),
                copies: None,
            };
            model.parts.push(part);
            assert_eq!(known.of(&model), model.bounds());
            assert_eq!(known.of(&model), model.bounds());
        }
    }
}
