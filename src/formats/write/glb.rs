//! Binary glTF 2.0: one file with everything in it.
//!
//! Two chunks: the JSON document, then one buffer: interleaved vertices (position, normal, UV; 32 bytes each), 32-bit
//! indices, 16-bit indices for meshes that need no more, tangents of meshes that have a normal map, poses of copies, pictures. One buffer view per region; accessors point into
//! them. The node tree is in `gltf_tree.rs`, looks in `gltf_materials.rs`.
//!
//! Positions are relative to their part's pivot; v runs downward in glTF, so v' = 1 − v. The document is written
//! straight into the result, its tree freed, then vertices and indices, so that no second copy of anything large is held.

use super::error::ExportError;
use super::exporter::{Encoded, Exporter, Takes};
use super::gltf_buffer::{TANGENT_BYTES, VERTEX_BYTES, accessor, view};
use super::gltf_instances;
use super::gltf_levels;
use super::gltf_materials::push_materials;
use super::gltf_tree::push_nodes;
use super::image_files::ImageFiles;
use super::scene::Scene;
use super::tangents::tangents;
use crate::model::{Mesh, Part};
use glam::Vec3;
use gltf_json as json;
use json::accessor::{ComponentType, Type};
use json::buffer::{Stride, Target, View};
use json::mesh::Semantic;
use json::validation::{Checked::Valid, USize64};
use json::{Accessor, Index};
use std::collections::BTreeMap;
use std::ops::Range;

/// Binary glTF 2.0.
#[derive(Debug)]
pub struct Glb;

const NORMAL_OFFSET: usize = 12;
const UV_OFFSET: usize = 24;
const HEADER_BYTES: usize = 12;
const CHUNK_HEADER_BYTES: usize = 8;

impl Exporter for Glb {
    fn extension(&self) -> &'static str {
        "glb"
    }

    fn takes(&self) -> Takes {
        Takes::Copies
    }

    fn encode(&self, scene: &Scene<'_>) -> Result<Encoded, ExportError> {
        scene.surfaces()?;
        let pictures = ImageFiles::of(scene)?;
        let bodies: Vec<Body<'_>> = bodies(scene, &pictures).collect();
        let regions = Regions::of(&bodies, gltf_instances::table_bytes(scene), &pictures);
        let mut out = vec![0; HEADER_BYTES + CHUNK_HEADER_BYTES];
        serde_json::to_writer(&mut out, &document(scene, &bodies, &pictures, &regions)?)?;
        pad(&mut out, b' ');
        let json_bytes = out.len() - HEADER_BYTES - CHUNK_HEADER_BYTES;
        let total = out.len() as u64 + CHUNK_HEADER_BYTES as u64 + regions.end as u64;
        let total_bytes = u32::try_from(total).map_err(|_| ExportError::TooLarge { bytes: total })?;
        out[..4].copy_from_slice(b"glTF");
        out[4..8].copy_from_slice(&2u32.to_le_bytes());
        out[8..12].copy_from_slice(&total_bytes.to_le_bytes());
        out[12..16].copy_from_slice(&(json_bytes as u32).to_le_bytes());
        out[16..20].copy_from_slice(b"JSON");
        out.reserve_exact(CHUNK_HEADER_BYTES + regions.end);
        out.extend_from_slice(&(regions.end as u32).to_le_bytes());
        out.extend_from_slice(b"BIN\0");
        write_buffer(&mut out, &bodies, scene, &pictures);
        Ok(Encoded { bytes: out, companions: Vec::new() })
    }
}

/// What becomes a mesh of the file: a part, or a shape of which there are copies.
struct Body<'a> {
    name: &'a str,
    mesh: &'a Mesh,
    /// What positions are relative to.
    pivot: Vec3,
    /// Materials with their triangles.
    slots: Vec<(usize, Range<usize>)>,
    /// For each of these whether it has a normal map.
    has_relief: Vec<bool>,
}

impl Body<'_> {
    /// Whether it has tangents.
    fn has_tangents(&self) -> bool {
        self.has_relief.contains(&true)
    }
}

/// Parts with a surface, then shapes.
fn bodies<'a>(scene: &'a Scene<'_>, pictures: &'a ImageFiles) -> impl Iterator<Item = Body<'a>> {
    let relief = |slots: &[(usize, Range<usize>)]| {
        slots.iter().map(|(material, _)| pictures.relief_of_material[*material].is_some()).collect()
    };
    let parts = scene.model.parts.iter().filter(|part| !part.mesh.triangles.is_empty());
    let body = move |part: &'a Part, pivot: Vec3| {
        let slots: Vec<_> = part.material_slots().collect();
        Body { name: &part.name, mesh: &part.mesh, pivot, has_relief: relief(&slots), slots }
    };
    let parts = parts.map(move |part| body(part, part.pivot));
    let shapes = scene.groups().iter().map(move |group| body(&group.shape, Vec3::ZERO));
    parts.chain(shapes)
}

/// Whether 16 bits reach every vertex; the largest 16-bit value is reserved.
fn is_narrow(mesh: &Mesh) -> bool {
    mesh.vertices.len() <= usize::from(u16::MAX)
}

/// Where each kind of data begins in the buffer, in bytes.
struct Regions {
    wide: usize,
    narrow: usize,
    tangents: usize,
    poses: usize,
    pictures: usize,
    end: usize,
}

impl Regions {
    fn of(bodies: &[Body<'_>], table_bytes: usize, pictures: &ImageFiles) -> Self {
        let surfaces = || bodies.iter().map(|body| body.mesh);
        let indices = |narrow| -> usize {
            surfaces().filter(|m| is_narrow(m) == narrow).map(|m| 3 * m.triangles.len()).sum()
        };
        let wide = VERTEX_BYTES * surfaces().map(|mesh| mesh.vertices.len()).sum::<usize>();
        let narrow = wide + 4 * indices(false);
        let tangents = (narrow + 2 * indices(true)).next_multiple_of(4);
        let with_tangents = bodies.iter().filter(|body| body.has_tangents());
        let poses =
            tangents + with_tangents.map(|body| TANGENT_BYTES * body.mesh.vertices.len()).sum::<usize>();
        let first_picture = poses + table_bytes;
        let picture_bytes: usize = pictures.all.iter().map(|p| p.bytes.len().next_multiple_of(4)).sum();
        Self { wide, narrow, tangents, poses, pictures: first_picture, end: first_picture + picture_bytes }
    }
}

fn document(
    scene: &Scene<'_>,
    bodies: &[Body<'_>],
    pictures: &ImageFiles,
    regions: &Regions,
) -> serde_json::Result<json::Root> {
    let mut root = json::Root::default();
    root.asset.generator = Some("Penstemon".to_owned());
    root.push(json::Buffer {
        byte_length: USize64::from(regions.end),
        name: None,
        uri: None,
        extensions: None,
        extras: Default::default(),
    });
    let materials = push_materials(&mut root, scene, pictures)?;
    let mut cursor = Cursor::new(&mut root, bodies, regions);
    let meshes: Vec<_> = bodies.iter().map(|body| cursor.push_mesh(&mut root, body, &materials)).collect();
    push_images(&mut root, pictures, regions);
    let (of_parts, of_shapes) = meshes.split_at(meshes.len() - scene.groups().len());
    let mut of_parts = of_parts.iter().copied();
    let mesh_of = |part: &Part| if part.mesh.triangles.is_empty() { None } else { of_parts.next() };
    let mesh_of_part: Vec<_> = scene.model.parts.iter().map(mesh_of).collect();
    let first_part = push_nodes(&mut root, &scene.model, &mesh_of_part);
    gltf_instances::push(&mut root, scene, first_part, of_shapes, regions.poses);
    gltf_levels::push(&mut root, scene)?;
    Ok(root)
}

fn push_images(root: &mut json::Root, pictures: &ImageFiles, regions: &Regions) {
    let mut offset = regions.pictures;
    for picture in &pictures.all {
        let view = root.push(view(offset, picture.bytes.len(), None));
        offset += picture.bytes.len().next_multiple_of(4);
        root.push(json::Image {
            buffer_view: Some(view),
            mime_type: Some(json::image::MimeType(picture.format.media_type().to_owned())),
            name: Some(picture.stem.clone()),
            uri: None,
            extensions: None,
            extras: Default::default(),
        });
    }
}

/// The views of vertices, indices and tangents, and how far each is used up.
struct Cursor {
    vertices: (Index<View>, usize),
    wide: (Option<Index<View>>, usize),
    narrow: (Option<Index<View>>, usize),
    tangents: (Option<Index<View>>, usize),
}

impl Cursor {
    fn new(root: &mut json::Root, bodies: &[Body<'_>], regions: &Regions) -> Self {
        let narrow_bytes: usize = {
            let narrow = bodies.iter().filter(|body| is_narrow(body.mesh));
            narrow.map(|body| 6 * body.mesh.triangles.len()).sum()
        };
        let vertices = root.push(view(0, regions.wide, Some(Target::ArrayBuffer)));
        let mut indices = |from: usize, length: usize| {
            (length > 0).then(|| root.push(view(from, length, Some(Target::ElementArrayBuffer))))
        };
        let wide = indices(regions.wide, regions.narrow - regions.wide);
        let narrow = indices(regions.narrow, narrow_bytes);
        let of_tangents = regions.poses - regions.tangents;
        let tangents = (of_tangents > 0).then(|| {
            let view = view(regions.tangents, of_tangents, Some(Target::ArrayBuffer));
            root.push(View { byte_stride: Some(Stride(TANGENT_BYTES)), ..view })
        });
        Self { vertices: (vertices, 0), wide: (wide, 0), narrow: (narrow, 0), tangents: (tangents, 0) }
    }

    fn push_mesh(
        &mut self,
        root: &mut json::Root,
        body: &Body<'_>,
        materials: &[Option<Index<json::Material>>],
    ) -> Index<json::Mesh> {
        let mesh = body.mesh;
        let (view, start) = (self.vertices.0, self.vertices.1);
        self.vertices.1 += VERTEX_BYTES * mesh.vertices.len();
        let attribute = |offset, kind| {
            accessor(Some(view), start + offset, mesh.vertices.len(), ComponentType::F32, kind)
        };
        let mut positions = attribute(0, Type::Vec3);
        let (low, high) = local_bounds(body);
        positions.min = Some(low.to_array().to_vec().into());
        positions.max = Some(high.to_array().to_vec().into());
        let attributes = [
            (Valid(Semantic::Positions), root.push(positions)),
            (Valid(Semantic::Normals), root.push(attribute(NORMAL_OFFSET, Type::Vec3))),
            (Valid(Semantic::TexCoords(0)), root.push(attribute(UV_OFFSET, Type::Vec2))),
        ];
        let attributes: BTreeMap<_, _> = attributes.into();
        let tangents = body.has_tangents().then(|| root.push(self.tangents(mesh)));
        let attributes_of = |has_relief: bool| {
            let tangents = tangents.filter(|_| has_relief).map(|it| (Valid(Semantic::Tangents), it));
            attributes.clone().into_iter().chain(tangents).collect()
        };
        let primitive =
            |((material, triangles), has_relief): ((usize, Range<usize>), bool)| json::mesh::Primitive {
                attributes: attributes_of(has_relief),
                indices: Some(root.push(self.indices(mesh, triangles.len()))),
                material: materials[material],
                mode: Valid(json::mesh::Mode::Triangles),
                targets: None,
                extensions: None,
                extras: Default::default(),
            };
        let slots = body.slots.iter().cloned().zip(body.has_relief.iter().copied());
        let primitives = slots.map(primitive).collect();
        root.push(json::Mesh {
            name: Some(body.name.to_owned()),
            primitives,
            weights: None,
            extensions: None,
            extras: Default::default(),
        })
    }

    /// The tangents of the next mesh that has some.
    fn tangents(&mut self, mesh: &Mesh) -> Accessor {
        let start = self.tangents.1;
        self.tangents.1 += TANGENT_BYTES * mesh.vertices.len();
        accessor(self.tangents.0, start, mesh.vertices.len(), ComponentType::F32, Type::Vec4)
    }

    /// The indices of the next triangles of a mesh.
    fn indices(&mut self, mesh: &Mesh, triangles: usize) -> Accessor {
        let (region, component, size) = if is_narrow(mesh) {
            (&mut self.narrow, ComponentType::U16, 2)
        } else {
            (&mut self.wide, ComponentType::U32, 4)
        };
        let count = 3 * triangles;
        let offset = region.1;
        region.1 += size * count;
        accessor(region.0, offset, count, component, Type::Scalar)
    }
}

/// Smallest and largest coordinates of the positions as they are written.
fn local_bounds(body: &Body<'_>) -> (Vec3, Vec3) {
    body.mesh.vertices.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), vertex| {
        let p = body.mesh.points[vertex.point as usize] - body.pivot;
        (low.min(p), high.max(p))
    })
}

fn write_buffer(out: &mut Vec<u8>, bodies: &[Body<'_>], scene: &Scene<'_>, pictures: &ImageFiles) {
    bodies.iter().for_each(|body| write_vertices(out, body));
    for body in bodies.iter().filter(|body| !is_narrow(body.mesh)) {
        out.extend(body.mesh.triangles.iter().flatten().flat_map(|v| v.to_le_bytes()));
    }
    for body in bodies.iter().filter(|body| is_narrow(body.mesh)) {
        for triangle in &body.mesh.triangles {
            let [[a, b], [c, d], [e, f]] = triangle.map(|v| (v as u16).to_le_bytes());
            out.extend_from_slice(&[a, b, c, d, e, f]);
        }
    }
    pad(out, 0);
    for body in bodies.iter().filter(|body| body.has_tangents()) {
        out.extend(
            tangents(body.mesh).iter().flat_map(|tangent| tangent.to_array()).flat_map(f32::to_le_bytes),
        );
    }
    gltf_instances::write_tables(out, scene);
    for picture in &pictures.all {
        out.extend_from_slice(&picture.bytes);
        pad(out, 0);
    }
}

fn write_vertices(out: &mut Vec<u8>, body: &Body<'_>) {
    for vertex in &body.mesh.vertices {
        let [x, y, z] = (body.mesh.points[vertex.point as usize] - body.pivot).to_array();
        let [nx, ny, nz] = vertex.normal.to_array();
        let values = [x, y, z, nx, ny, nz, vertex.uv.x, 1.0 - vertex.uv.y].map(f32::to_le_bytes);
        out.extend_from_slice(values.as_flattened());
    }
}

/// Fills up to a multiple of four bytes; both chunks begin at one.
fn pad(out: &mut Vec<u8>, filler: u8) {
    out.resize(out.len().next_multiple_of(4), filler);
}
