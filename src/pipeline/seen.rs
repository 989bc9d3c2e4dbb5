//! What is seen of a plant: its model with its garden, and what stands in its way. The latter is for pictures and the window, not for files,
//! where the artist's scene has it.

use super::finish::Built;
use crate::garden::Seen;
use crate::growth::Obstacles;
use crate::model::{Mesh, Model, Part, PartKind};
use crate::plant::{Material, OrganKind};
use std::borrow::Cow;
use std::sync::Arc;

/// Linear colour of stone and weathered wood.
const COLOUR: [f32; 3] = [0.46, 0.42, 0.37];

/// What is seen of a plant: its model with its garden, and what stands in its way.
pub fn seen(built: &Built) -> Seen<'_> {
    seen_as(built, &built.model)
}

/// The same with another model in the place of the plant's own: one of its levels of detail.
pub fn seen_as<'a>(built: &'a Built, model: &'a Model) -> Seen<'a> {
    let model = match &built.obstacles {
        Some(obstacles) => Cow::Owned(with_obstacles(model, obstacles)),
        None => Cow::Borrowed(model),
    };
    match &built.garden {
        Some(garden) => Seen::with_garden(model, garden),
        None => Seen { model, crowd: None },
    }
}

fn with_obstacles(model: &Model, obstacles: &Obstacles) -> Model {
    let mut model = model.clone();
    let (points, triangles) = obstacles.mesh();
    let material = model.materials.len();
    model.materials.push(Material { double_sided: true, ..Material::plain("obstacle", COLOUR) });
    // Walls and slats have sharp edges.
    let mesh = Arc::new(Mesh::faceted(points, triangles));
    model.parts.push(Part::alone("obstacle", PartKind::Organ(OrganKind::Pot), material, mesh));
    model
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn obstacles_are_one_more_part_with_sharp_edges() {
        let with = with_obstacles(&Model::default(), &Obstacles::wall(Vec3::ONE));
        assert_eq!((with.parts.len(), with.materials.len(), with.triangle_count()), (1, 1, 12));
        let mesh = &with.parts[0].mesh;
        let outward = |t: &[u32; 3]| {
            let middle = mesh.corners(*t).iter().sum::<Vec3>() / 3.0 - Vec3::Y * 0.5;
            mesh.vertices[t[0] as usize].normal.dot(middle) > 0.4
        };
        assert!(mesh.triangles.iter().all(outward));
    }
}
