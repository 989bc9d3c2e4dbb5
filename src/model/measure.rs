//! What there is of models, one after the other, and how far they reach: meshes are measured once.

use super::{Mesh, Model};
use crate::kept::{Kept, Same};
use glam::Vec3;
use std::sync::Arc;

/// What there is of a model, or of a part of one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measure {
    /// Smallest and largest corner, metres; `None` where there is nothing.
    pub bounds: Option<(Vec3, Vec3)>,
    /// Vertices, every copy counted.
    pub vertices: usize,
    /// Triangles, every copy counted.
    pub triangles: usize,
}

impl Measure {
    fn of(mesh: &Mesh, points: impl Iterator<Item = Vec3>) -> Self {
        let bounds = points.map(|p| (p, p)).reduce(around);
        Self { bounds, vertices: mesh.vertices.len(), triangles: mesh.triangles.len() }
    }

    fn and(self, other: Self) -> Self {
        let bounds = self.bounds.into_iter().chain(other.bounds).reduce(around);
        let (vertices, triangles) = (self.vertices + other.vertices, self.triangles + other.triangles);
        Self { bounds, vertices, triangles }
    }
}

fn around(a: (Vec3, Vec3), b: (Vec3, Vec3)) -> (Vec3, Vec3) {
    (a.0.min(b.0), a.1.max(b.1))
}

/// Measures of the meshes of the last model.
#[derive(Debug, Default)]
pub struct Measures(Kept<Same<Mesh>, Measure>);

impl Measures {
    /// Measures a model: what [`Model::bounds`], [`Model::vertex_count`] and [`Model::triangle_count`] say.
    pub fn of(&mut self, model: &Model) -> Measure {
        let meshes: Vec<&Arc<Mesh>> = model.parts.iter().map(|part| &part.mesh).collect();
        let of_mesh = |mesh: &&Arc<Mesh>| Measure::of(mesh, mesh.points.iter().copied());
        let of_meshes = self.0.made(&meshes, |mesh, used| Same::of(mesh, used), of_mesh);
        let copies = model.parts.iter().filter_map(|part| part.copies.as_deref());
        let of_copies = copies
            .flat_map(|copies| copies.iter())
            .map(|(shape, placement)| Measure::of(shape, placement.places(&shape.points)));
        of_meshes.iter().copied().chain(of_copies).fold(Measure::default(), Measure::and)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Copies, Part, PartKind, Placement};
    use super::*;

    fn part(x: f32, copies: usize) -> Part {
        let points = vec![Vec3::X * x, Vec3::Y, Vec3::new(x, 1.0, -x)];
        let shape = Arc::new(Mesh { points, triangles: vec![[0, 1, 2]], ..Mesh::default() });
        let place = |k: usize| Placement {
            shape: 0,
            slot: 0,
            base: Vec3::Z * k as f32,
            u: Vec3::new(1.0, 0.3, 0.0),
            v: Vec3::Y * 2.0,
        };
        let copies =
            Copies { shapes: vec![Arc::clone(&shape)], placements: (0..copies).map(place).collect() };
        Part { copies: Some(Arc::new(copies)), ..Part::alone("part", PartKind::Wood, 0, shape) }
    }

    #[test]
    fn what_is_measured_once_is_what_the_model_says() {
        let (mut model, mut measures) = (Model::default(), Measures::default());
        assert_eq!(measures.of(&model), Measure::default());
        for (x, copies) in [(3.0, 0), (-2.0, 5), (0.5, 2)] {
            model.parts.insert(0, part(x, copies));
            for _ in 0..2 {
                let Measure { bounds, vertices, triangles } = measures.of(&model);
                assert_eq!(bounds, model.bounds());
                assert_eq!((vertices, triangles), (model.vertex_count(), model.triangle_count()));
            }
        }
    }
}
