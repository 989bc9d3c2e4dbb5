//! Mesh quality report: what a modeller, a game engine or a 3D printer would stumble over.
//!
//! Counts defects of a [`Mesh`] by its points (see [`super::mesh`]), so that seams of normals and UVs are not taken for
//! cracks. The connections (edges, fans, components, winding) come from `topology`; here are the numbers: positions,
//! areas, volumes, normals, UVs.
//!
//! Definitions. *Zero area*: a face with a repeated point, or whose height is at most [`FLATNESS`] of its longest edge,
//! which is where single-precision positions no longer know its normal. *Duplicate*: a face with the same three points
//! as another, in any order. *Flipped*: wound against the majority of the surface it belongs to. *Inside out*: a
//! component that is closed and wound alike, with negative volume. *UV out of range*: not finite or beyond
//! [`UV_LIMIT`]; bark repeats its picture, so coordinates past 1 are no defect and the range is reported instead.
//!
//! Faces that pass through each other are no defect, leaves of one part do; `crossing` counts them. Limits: at most 2²⁹ faces.

use super::topology::{self, Topology};
use super::{Mesh, Model, Vertex};
use glam::{DVec3, Vec2, Vec3};
use rayon::prelude::*;
use serde::Serialize;

/// Height over longest edge up to which a face counts as having no area.
pub const FLATNESS: f64 = 1e-6;
/// Largest UV coordinate that a repeated picture can sensibly reach.
pub const UV_LIMIT: f32 = 1e4;
/// Departure from unit length up to which a normal is one; the tolerance of the Khronos glTF validator.
pub const NORMAL_TOLERANCE: f32 = 5e-4;

/// Which attributes a mesh really has; files may leave them out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Attributes {
    /// Whether vertex normals are to be judged.
    pub normals: bool,
    /// Whether UVs are to be judged.
    pub uvs: bool,
}

impl Attributes {
    /// Normals and UVs.
    pub const ALL: Self = Self { normals: true, uvs: true };
}

/// Smallest and largest finite UV.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct UvRange {
    /// Lower left.
    pub min: Vec2,
    /// Upper right.
    pub max: Vec2,
}

/// What was counted in one mesh or, added up, in several.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Report {
    /// Distinct points that faces use.
    pub points: usize,
    /// Faces.
    pub triangles: usize,
    /// Pieces connected by edges.
    pub components: usize,
    /// Edges with a face on one side only.
    pub boundary_edges: usize,
    /// Edges with more than two faces.
    pub non_manifold_edges: usize,
    /// Points where surfaces touch without sharing an edge.
    pub non_manifold_vertices: usize,
    /// Faces without area.
    pub zero_area_faces: usize,
    /// Faces that repeat another.
    pub duplicate_faces: usize,
    /// Faces wound against their neighbours.
    pub flipped_faces: usize,
    /// Edges of surfaces that cannot be wound alike, such as a Möbius band.
    pub unorientable_edges: usize,
    /// Closed pieces whose faces all look inward.
    pub inside_out_components: usize,
    /// Faces that refer to a vertex or point that does not exist.
    pub indices_out_of_range: usize,
    /// Points, normals or UVs that are not finite.
    pub non_finite: usize,
    /// UVs that no picture can have.
    pub uvs_out_of_range: usize,
    /// Normals that are not of unit length.
    pub normals_not_unit: usize,
    /// Faces whose vertex normals point to the other side.
    pub normals_against_winding: usize,
    /// UVs in use, `None` without any.
    pub uv_range: Option<UvRange>,
}

impl Report {
    /// Defects that were found, in words, with their number; empty for a clean mesh.
    pub fn defects(&self) -> Vec<(&'static str, usize)> {
        let mut all = vec![
            ("boundary edges", self.boundary_edges),
            ("non-manifold edges", self.non_manifold_edges),
            ("non-manifold vertices", self.non_manifold_vertices),
            ("zero-area faces", self.zero_area_faces),
            ("duplicate faces", self.duplicate_faces),
            ("flipped faces", self.flipped_faces),
            ("unorientable edges", self.unorientable_edges),
            ("inside-out components", self.inside_out_components),
            ("indices out of range", self.indices_out_of_range),
            ("numbers that are not finite", self.non_finite),
            ("UVs out of range", self.uvs_out_of_range),
            ("normals not of unit length", self.normals_not_unit),
            ("normals against the winding", self.normals_against_winding),
        ];
        all.retain(|(_, count)| *count > 0);
        all
    }

    /// Whether nothing is wrong.
    pub fn is_clean(&self) -> bool {
        self.defects().is_empty()
    }

    /// The counts of so many copies of the mesh, moved, turned or scaled.
    #[must_use]
    pub fn of_copies(&self, copies: usize) -> Self {
        let all = |count: usize| count.saturating_mul(copies);
        Self {
            points: all(self.points),
            triangles: all(self.triangles),
            components: all(self.components),
            boundary_edges: all(self.boundary_edges),
            non_manifold_edges: all(self.non_manifold_edges),
            non_manifold_vertices: all(self.non_manifold_vertices),
            zero_area_faces: all(self.zero_area_faces),
            duplicate_faces: all(self.duplicate_faces),
            flipped_faces: all(self.flipped_faces),
            unorientable_edges: all(self.unorientable_edges),
            inside_out_components: all(self.inside_out_components),
            indices_out_of_range: all(self.indices_out_of_range),
            non_finite: all(self.non_finite),
            uvs_out_of_range: all(self.uvs_out_of_range),
            normals_not_unit: all(self.normals_not_unit),
            normals_against_winding: all(self.normals_against_winding),
            uv_range: self.uv_range,
        }
    }

    /// Adds another mesh's counts to these.
    pub fn add(&mut self, other: &Report) {
        self.points += other.points;
        self.triangles += other.triangles;
        self.components += other.components;
        self.boundary_edges += other.boundary_edges;
        self.non_manifold_edges += other.non_manifold_edges;
        self.non_manifold_vertices += other.non_manifold_vertices;
        self.zero_area_faces += other.zero_area_faces;
        self.duplicate_faces += other.duplicate_faces;
        self.flipped_faces += other.flipped_faces;
        self.unorientable_edges += other.unorientable_edges;
        self.inside_out_components += other.inside_out_components;
        self.indices_out_of_range += other.indices_out_of_range;
        self.non_finite += other.non_finite;
        self.uvs_out_of_range += other.uvs_out_of_range;
        self.normals_not_unit += other.normals_not_unit;
        self.normals_against_winding += other.normals_against_winding;
        self.uv_range = match (self.uv_range, other.uv_range) {
            (Some(a), Some(b)) => Some(UvRange { min: a.min.min(b.min), max: a.max.max(b.max) }),
            (a, b) => a.or(b),
        };
    }
}

/// Judges every part of a model and adds the counts up; the result does not depend on the number of threads.
pub fn judge_model(model: &Model) -> Report {
    let model = model.flattened();
    let reports: Vec<Report> =
        model.parts.par_iter().map(|part| judge(&part.mesh, Attributes::ALL)).collect();
    let mut sum = Report::default();
    reports.iter().for_each(|report| sum.add(report));
    sum
}

/// Judges one mesh. Any contents are allowed, also indices out of range and numbers that are not finite.
///
/// Near-linear in faces: a few sorts; working memory about 200 bytes per face.
pub fn judge(mesh: &Mesh, has: Attributes) -> Report {
    let mut report = Report { triangles: mesh.triangles.len(), ..Report::default() };
    report.non_finite = mesh.points.iter().filter(|p| !p.is_finite()).count();
    judge_vertices(&mut report, &mesh.vertices, has);
    let faces = usable_faces(&mut report, mesh, has);
    let topology = topology::analyse(&faces, mesh.points.len());
    report.points = used_points(&faces, mesh.points.len());
    report.components = topology.has_inside.len();
    report.boundary_edges = topology.boundary_edges;
    report.non_manifold_edges = topology.non_manifold_edges;
    report.non_manifold_vertices = topology.non_manifold_vertices;
    report.flipped_faces = topology.flipped_faces;
    report.unorientable_edges = topology.unorientable_edges;
    report.inside_out_components = count_inside_out(&faces, &mesh.points, &topology);
    report.duplicate_faces = count_duplicates(faces);
    report
}

fn judge_vertices(report: &mut Report, vertices: &[Vertex], has: Attributes) {
    for vertex in vertices {
        if has.normals {
            let length = vertex.normal.length();
            let finite = vertex.normal.is_finite();
            report.non_finite += usize::from(!finite);
            report.normals_not_unit += usize::from(finite && (length - 1.0).abs() > NORMAL_TOLERANCE);
        }
        if has.uvs {
            let uv = vertex.uv;
            if !uv.is_finite() {
                report.non_finite += 1;
                continue;
            }
            report.uvs_out_of_range += usize::from(uv.abs().max_element() > UV_LIMIT);
            let range = report.uv_range.unwrap_or(UvRange { min: uv, max: uv });
            report.uv_range = Some(UvRange { min: range.min.min(uv), max: range.max.max(uv) });
        }
    }
}

/// The faces whose connections can be judged, by their points: indices in range, three different points.
fn usable_faces(report: &mut Report, mesh: &Mesh, has: Attributes) -> Vec<[u32; 3]> {
    let mut faces = Vec::with_capacity(mesh.triangles.len());
    for &triangle in &mesh.triangles {
        let [Some(a), Some(b), Some(c)] = triangle.map(|v| mesh.vertices.get(v as usize)) else {
            report.indices_out_of_range += 1;
            continue;
        };
        let points = [a.point, b.point, c.point];
        let [Some(&p), Some(&q), Some(&r)] = points.map(|p| mesh.points.get(p as usize)) else {
            report.indices_out_of_range += 1;
            continue;
        };
        if points[0] == points[1] || points[1] == points[2] || points[2] == points[0] {
            report.zero_area_faces += 1;
            continue;
        }
        let shape = Shape::of([p, q, r]);
        report.zero_area_faces += usize::from(shape.is_flat());
        let normals = (a.normal + b.normal + c.normal).as_dvec3();
        let against = has.normals && !shape.is_flat() && shape.cross.dot(normals) <= 0.0;
        report.normals_against_winding += usize::from(against);
        faces.push(points);
    }
    faces
}

struct Shape {
    /// Normal of twice the area's length.
    cross: DVec3,
    longest_squared: f64,
}

impl Shape {
    fn of(corners: [Vec3; 3]) -> Self {
        let [p, q, r] = corners.map(|c| c.as_dvec3());
        let longest_squared =
            (q - p).length_squared().max((r - q).length_squared()).max((p - r).length_squared());
        Self { cross: (q - p).cross(r - p), longest_squared }
    }

    /// Height ≤ [`FLATNESS`] · longest edge; `false` for shapes that are not finite, which are counted elsewhere.
    fn is_flat(&self) -> bool {
        self.cross.length() <= FLATNESS * self.longest_squared
    }
}

fn used_points(faces: &[[u32; 3]], point_count: usize) -> usize {
    let mut used = vec![false; point_count];
    faces.iter().flatten().for_each(|&p| used[p as usize] = true);
    used.into_iter().filter(|used| *used).count()
}

fn count_duplicates(mut faces: Vec<[u32; 3]>) -> usize {
    faces.iter_mut().for_each(|face| face.sort_unstable());
    faces.sort_unstable();
    faces.windows(2).filter(|pair| pair[0] == pair[1]).count()
}

/// Closed components of negative volume, by the divergence theorem about each component's first point.
fn count_inside_out(faces: &[[u32; 3]], points: &[Vec3], topology: &Topology) -> usize {
    /// Share of the 3/2 power of the area below which a volume is rounding, as in a leaf folded flat.
    const NOISE: f64 = 1e-9;
    let at = |p: u32| points[p as usize].as_dvec3();
    let mut solids = vec![(None, 0.0, 0.0); topology.has_inside.len()];
    for (face, &component) in faces.iter().zip(&topology.component_of_face) {
        let (origin, volume, area) = &mut solids[component as usize];
        let origin: DVec3 = *origin.get_or_insert(at(face[0]));
        let [p, q, r] = face.map(|p| at(p) - origin);
        *volume += p.dot(q.cross(r)) / 6.0;
        *area += (q - p).cross(r - p).length() / 2.0;
    }
    let is_inside_out = |&(_, volume, area): &(_, f64, f64)| volume < -NOISE * area.powf(1.5);
    solids
        .iter()
        .zip(&topology.has_inside)
        .filter(|(solid, has_inside)| **has_inside && is_inside_out(solid))
        .count()
}

#[cfg(test)]
#[path = "quality_tests.rs"]
mod tests;
