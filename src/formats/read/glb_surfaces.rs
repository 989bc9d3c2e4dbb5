//! GLB back to meshes: the container, the node graph's soundness, and every mesh in its own space.
//!
//! The primitives of a mesh are put together, and vertices at exactly one place become one point (glTF repeats a
//! position for each normal and UV). Meshes are judged where they are defined; the nodes are checked for being a forest and
//! say how many copies of each mesh are shown.
//!
//! Limits: triangle lists only; points and lines are passed over, strips and fans refused.

use super::error::Malformed;
use super::glb_container;
use super::glb_nodes;
use super::gltf_accessor::{Budget, Data};
use super::surface::Surface;
use crate::geom::weld::weld;
use crate::model::quality::Attributes;
use crate::model::{Mesh, Vertex};
use glam::{Vec2, Vec3};
use gltf_json as json;
use json::mesh::{Mode, Primitive, Semantic};
use json::validation::Checked;

/// The meshes of a GLB file.
pub(super) fn surfaces(bytes: &[u8]) -> Result<Vec<Surface>, Malformed> {
    let (root, buffer) = glb_container::open(bytes)?;
    check_nodes(&root)?;
    let data = Data { root: &root, buffer };
    let mut budget = Budget::of(buffer);
    let mut surfaces: Vec<Surface> = root
        .meshes
        .iter()
        .enumerate()
        .map(|(i, mesh)| {
            let name = mesh.name.clone().unwrap_or_else(|| format!("mesh {i}"));
            assembled(name, &mesh.primitives, data, &mut budget)
        })
        .collect::<Result<_, _>>()?;
    let mut copies = vec![0; surfaces.len()];
    for shown in glb_nodes::shown(data, &mut budget)? {
        copies[shown.mesh] += shown.world_from_copies.len();
    }
    surfaces.iter_mut().zip(copies).for_each(|(surface, copies)| surface.copies = copies.max(1));
    if surfaces.iter().all(|surface| surface.mesh.triangles.is_empty()) {
        return Err(Malformed::new("meshes", "the file has no triangles"));
    }
    Ok(surfaces)
}

/// Meshes must exist and every node hang on at most one other, none on itself.
pub(super) fn check_nodes(root: &json::Root) -> Result<(), Malformed> {
    let count = root.nodes.len();
    let mut parents = vec![None; count];
    for (i, node) in root.nodes.iter().enumerate() {
        let fault = |reason: String| Malformed::new(format!("node {i}"), reason);
        if let Some(mesh) = node.mesh.filter(|mesh| mesh.value() >= root.meshes.len()) {
            return Err(fault(format!("there is no mesh {}", mesh.value())));
        }
        for child in node.children.iter().flatten().map(|child| child.value()) {
            let slot = parents.get_mut(child).ok_or_else(|| fault(format!("there is no node {child}")))?;
            if let Some(other) = slot.replace(i) {
                return Err(fault(format!("its child {child} is also a child of node {other}")));
            }
        }
    }
    // With one parent each, a node that no walk from a root reaches is on a cycle or below one.
    let mut reached: Vec<usize> = (0..count).filter(|i| parents[*i].is_none()).collect();
    let mut next = 0;
    while let Some(&i) = reached.get(next) {
        reached.extend(root.nodes[i].children.iter().flatten().map(|child| child.value()));
        next += 1;
    }
    if reached.len() < count {
        return Err(Malformed::new("nodes", "a node is its own ancestor"));
    }
    Ok(())
}

/// The vertices of a mesh as the file lists them.
#[derive(Default)]
struct Soup {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    uvs: Vec<Vec2>,
    triangles: Vec<[u32; 3]>,
}

pub(super) fn assembled(
    name: String,
    primitives: &[Primitive],
    data: Data<'_>,
    budget: &mut Budget,
) -> Result<Surface, Malformed> {
    let mut soup = Soup::default();
    let mut has = Attributes::ALL;
    let mut last = None;
    for primitive in primitives {
        let place = || format!("mesh `{name}`");
        match primitive.mode {
            Checked::Valid(Mode::Triangles) => {}
            Checked::Valid(Mode::TriangleStrip | Mode::TriangleFan) => {
                return Err(Malformed::new(place(), "triangle strips and fans are not read"));
            }
            Checked::Valid(_) => continue,
            Checked::Invalid => return Err(Malformed::new(place(), "its drawing mode is unknown")),
        }
        let attribute = |semantic| primitive.attributes.get(&Checked::Valid(semantic)).copied();
        let Some(positions) = attribute(Semantic::Positions) else {
            return Err(Malformed::new(place(), "it has no positions"));
        };
        let (normals, uvs) = (attribute(Semantic::Normals), attribute(Semantic::TexCoords(0)));
        has = Attributes { normals: has.normals && normals.is_some(), uvs: has.uvs && uvs.is_some() };
        // Primitives often divide one list of vertices among them.
        let base = match last {
            Some((shared, base)) if shared == (positions, normals, uvs) => base,
            _ => {
                let base = soup.positions.len();
                soup.push_vertices(data, budget, positions, normals, uvs)?;
                last = Some(((positions, normals, uvs), base));
                base
            }
        };
        let vertex_count = soup.positions.len() - base;
        let indices = match primitive.indices {
            Some(indices) => data.indices(indices, budget)?,
            None => {
                budget.spend(vertex_count).map_err(|reason| Malformed::new(place(), reason))?;
                (0..vertex_count as u32).collect()
            }
        };
        soup.push_triangles(&indices, base, vertex_count);
    }
    Ok(soup.into_surface(name, has))
}

type AccessorIndex = json::Index<json::Accessor>;

impl Soup {
    fn push_vertices(
        &mut self,
        data: Data<'_>,
        budget: &mut Budget,
        positions: AccessorIndex,
        normals: Option<AccessorIndex>,
        uvs: Option<AccessorIndex>,
    ) -> Result<(), Malformed> {
        self.positions.extend(data.floats::<3>(positions, budget)?.into_iter().map(Vec3::from));
        let count = self.positions.len();
        if let Some(normals) = normals {
            self.normals.extend(data.floats::<3>(normals, budget)?.into_iter().map(Vec3::from));
        }
        if let Some(uvs) = uvs {
            self.uvs.extend(data.floats::<2>(uvs, budget)?.into_iter().map(Vec2::from));
        }
        self.normals.resize(count, Vec3::ZERO);
        self.uvs.resize(count, Vec2::ZERO);
        Ok(())
    }

    /// Indices from `vertex_count` on have no vertex and must not land on another primitive's.
    fn push_triangles(&mut self, indices: &[u32], base: usize, vertex_count: usize) {
        let vertex =
            |index: u32| if (index as usize) < vertex_count { base as u32 + index } else { u32::MAX };
        let (triangles, _) = indices.as_chunks::<3>();
        self.triangles.extend(triangles.iter().map(|triangle| triangle.map(vertex)));
    }

    fn into_surface(self, name: String, has: Attributes) -> Surface {
        let (points, point_of_position) = weld(&self.positions);
        let attributes = point_of_position.into_iter().zip(self.normals).zip(self.uvs);
        let vertices = attributes.map(|((point, normal), uv)| Vertex { point, normal, uv }).collect();
        Surface {
            name,
            mesh: Mesh { points, vertices, triangles: self.triangles, ..Mesh::default() },
            has,
            copies: 1,
        }
    }
}
