//! An indexed triangle mesh that remembers which vertices are one point.
//!
//! A renderer needs a vertex for each combination of position, normal and UV; a judge of watertightness needs to know
//! that two such vertices along a seam are the same point. So positions are kept once ([`Mesh::points`]) and vertices
//! refer to them. OBJ writes exactly this; GLB expands it.

use glam::{Vec2, Vec3};
use rayon::prelude::*;
use std::ops::Range;

/// Faces that one thread looks at.
const FACES: usize = 8192;

/// A corner: a point with the normal and UV that it has on one side of a seam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Index into [`Mesh::points`].
    pub point: u32,
    /// Unit normal.
    pub normal: Vec3,
    /// Texture coordinates, u right, v up: (0, 0) is the picture's lower left corner.
    pub uv: Vec2,
}

/// A triangle surface in metres.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Positions, each once.
    pub points: Vec<Vec3>,
    /// Corners.
    pub vertices: Vec<Vertex>,
    /// Indices into `vertices`, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// For each material that the part has beyond its first, the first of its triangles; ascending.
    pub breaks: Vec<u32>,
}

impl Mesh {
    /// A smooth surface from points and faces, without UVs; sharp only where it folds back on itself.
    pub fn smooth(points: Vec<Vec3>, triangles: &[[u32; 3]]) -> Self {
        let vertex = |point| Vertex { point, normal: Vec3::ZERO, uv: Vec2::ZERO };
        let vertices = (0..points.len() as u32).map(vertex).collect();
        let mut mesh = Self { points, vertices, triangles: triangles.to_vec(), breaks: Vec::new() };
        mesh.smooth_missing_normals();
        mesh.split_disagreeing_corners();
        mesh
    }

    /// A surface of which each face is flat, without UVs.
    pub fn faceted(points: &[Vec3], triangles: &[[u32; 3]]) -> Self {
        let mut mesh = Self { points: points.to_vec(), ..Self::default() };
        for triangle in triangles {
            let [a, b, c] = triangle.map(|i| points[i as usize]);
            let Some(normal) = (b - a).cross(c - a).try_normalize() else { continue };
            let first = mesh.vertices.len() as u32;
            mesh.vertices.extend(triangle.map(|point| Vertex { point, normal, uv: Vec2::ZERO }));
            mesh.triangles.push([first, first + 1, first + 2]);
        }
        mesh
    }

    /// The point indices of a triangle.
    pub fn point_triangle(&self, triangle: [u32; 3]) -> [u32; 3] {
        triangle.map(|v| self.vertices[v as usize].point)
    }

    /// The corner positions of a triangle.
    pub fn corners(&self, triangle: [u32; 3]) -> [Vec3; 3] {
        self.point_triangle(triangle).map(|p| self.points[p as usize])
    }

    /// How many points, vertices and triangles there are.
    pub fn counts(&self) -> [usize; 3] {
        [self.points.len(), self.vertices.len(), self.triangles.len()]
    }

    /// Makes room for as many more as have been added `since`, `times` over.
    pub fn reserve_more(&mut self, since: [usize; 3], times: usize) {
        let now = self.counts();
        let [points, vertices, triangles] = std::array::from_fn(|k| times * (now[k] - since[k]));
        self.points.reserve_exact(points);
        self.vertices.reserve_exact(vertices);
        self.triangles.reserve_exact(triangles);
    }

    /// Appends another mesh of the same material.
    pub fn append(&mut self, other: &Self) {
        let (point, vertex) = (self.points.len() as u32, self.vertices.len() as u32);
        self.points.extend_from_slice(&other.points);
        let moved = |v: &Vertex| Vertex { point: v.point + point, ..*v };
        self.vertices.extend(other.vertices.iter().map(moved));
        self.triangles.extend(other.triangles.iter().map(|triangle| triangle.map(|i| i + vertex)));
    }

    /// Gives every vertex whose normal is zero that of the smooth surface, faces weighted by area.
    pub fn smooth_missing_normals(&mut self) {
        let mut sums = vec![Vec3::ZERO; self.points.len()];
        for triangle in &self.triangles {
            let [a, b, c] = self.point_triangle(*triangle).map(|point| point as usize);
            let cross = (self.points[b] - self.points[a]).cross(self.points[c] - self.points[a]);
            sums[a] += cross;
            sums[b] += cross;
            sums[c] += cross;
        }
        for sum in &mut sums {
            // Scaled before squaring, because the cross product of a tiny face has a square of zero.
            *sum = (*sum / sum.abs().max_element()).normalize_or(Vec3::Y);
        }
        for vertex in self.vertices.iter_mut().filter(|vertex| vertex.normal == Vec3::ZERO) {
            vertex.normal = sums[vertex.point as usize];
        }
    }

    /// Gives a corner whose normal points away from its face's outside a vertex of its own with the face's normal.
    ///
    /// Smooth normals fail where a surface folds back on itself; there the crease is shown as a crease.
    pub fn split_disagreeing_corners(&mut self) {
        self.split_disagreeing_corners_in(0..self.triangles.len());
    }

    /// The same for some of the triangles.
    pub fn split_disagreeing_corners_in(&mut self, faces: Range<usize>) {
        self.split_corners_of(faces);
    }

    /// The same for these triangles.
    pub fn split_corners_of(&mut self, faces: impl Iterator<Item = usize>) {
        let Self { points, vertices, triangles, .. } = self;
        for face in faces {
            let triangle = &mut triangles[face];
            let (cross, agree) = agreement(points, vertices, triangle);
            if agree == [true; 3] {
                continue;
            }
            // Scaled before squaring, because the cross product of a tiny face has a square of zero.
            let scaled = cross / cross.abs().max_element();
            for (corner, agrees) in triangle.iter_mut().zip(agree) {
                if !agrees && scaled.is_finite() {
                    let own = Vertex { normal: scaled.normalize(), ..vertices[*corner as usize] };
                    *corner = vertices.len() as u32;
                    vertices.push(own);
                }
            }
        }
    }

    /// The triangles that [`Self::split_corners_of`] looks for, in their order; found on all cores.
    pub fn disagreeing_faces(&self) -> Vec<usize> {
        let Self { points, vertices, triangles, .. } = self;
        let disagrees =
            |(_, triangle): &(usize, &[u32; 3])| agreement(points, vertices, triangle).1 != [true; 3];
        let faces = triangles.par_iter().enumerate().with_min_len(FACES).filter(disagrees);
        faces.map(|(face, _)| face).collect()
    }

    /// Checks what every mesh of a model promises: finite numbers, indices in range, unit normals that agree with the
    /// winding, no point twice, no face twice or without area, closed and manifold.
    ///
    /// # Errors
    /// The first violation, in words.
    pub fn check_invariants(&self) -> Result<(), String> {
        self.check_indices()?;
        self.check_normals()?;
        (0..self.triangles.len()).try_for_each(|t| self.check_face(t))?;
        let mut places: Vec<[u32; 3]> =
            self.points.iter().map(|p| (*p + Vec3::ZERO).to_array().map(f32::to_bits)).collect();
        places.sort_unstable();
        ensure(places.windows(2).all(|w| w[0] != w[1]), || "two points at one place".into())?;
        self.check_edges()?;
        self.check_fans()
    }

    fn check_normals(&self) -> Result<(), String> {
        self.vertices.iter().enumerate().try_for_each(|(i, vertex)| {
            let length = vertex.normal.length();
            ensure((length - 1.0).abs() < 1e-3, || format!("vertex {i}: normal of length {length}"))
        })
    }

    fn check_face(&self, t: usize) -> Result<(), String> {
        let [a, b, c] = self.corners(self.triangles[t]).map(|p| p.as_dvec3());
        let cross = (b - a).cross(c - a);
        let longest = (b - a).length().max((c - b).length()).max((a - c).length());
        ensure(cross.length() > 1e-9 * longest * longest, || format!("face {t} has no area: {a} {b} {c}"))?;
        self.triangles[t].iter().try_for_each(|v| {
            let cosine = self.vertices[*v as usize].normal.as_dvec3().dot(cross) / cross.length();
            ensure(cosine > -1e-3, || format!("face {t}: normal of vertex {v} at cosine {cosine}"))
        })
    }

    /// Every edge has exactly two faces that run along it in opposite directions.
    fn check_edges(&self) -> Result<(), String> {
        let mut edges: Vec<[u32; 2]> = Vec::with_capacity(3 * self.triangles.len());
        for triangle in &self.triangles {
            let [a, b, c] = self.point_triangle(*triangle);
            edges.extend([[a, b], [b, c], [c, a]]);
        }
        edges.sort_unstable();
        for w in edges.windows(2) {
            ensure(w[0] != w[1], || format!("edge {:?} is used twice in one direction", w[0]))?;
        }
        edges.iter().try_for_each(|&[a, b]| {
            ensure(edges.binary_search(&[b, a]).is_ok(), || format!("edge {a}-{b} has one face"))
        })
    }

    /// The faces around every point form one closed fan, and no face appears twice.
    fn check_fans(&self) -> Result<(), String> {
        let mut wedges: Vec<[u32; 3]> = Vec::with_capacity(3 * self.triangles.len());
        for triangle in &self.triangles {
            let [a, b, c] = self.point_triangle(*triangle);
            wedges.extend([[a, b, c], [b, c, a], [c, a, b]]);
        }
        wedges.sort_unstable();
        for fan in wedges.chunk_by(|x, y| x[0] == y[0]) {
            let mut at = fan[0][1];
            for step in 1..=fan.len() {
                let next = fan
                    .binary_search_by_key(&at, |w| w[1])
                    .map_err(|_| format!("open fan at {}", fan[0][0]))?;
                at = fan[next][2];
                let closed = at == fan[0][1];
                ensure(closed == (step == fan.len()), || format!("point {} joins two surfaces", fan[0][0]))?;
            }
            ensure(fan.len() > 2, || format!("point {} has only two faces", fan[0][0]))?;
        }
        let used = wedges.chunk_by(|x, y| x[0] == y[0]).count();
        ensure(used == self.points.len(), || format!("{used} of {} points are used", self.points.len()))
    }
}

/// Twice the area of a face as a vector out of it, and for each corner whether its normal points to that side.
fn agreement(points: &[Vec3], vertices: &[Vertex], triangle: &[u32; 3]) -> (Vec3, [bool; 3]) {
    let corners = triangle.map(|v| &vertices[v as usize]);
    let [a, b, c] = corners.map(|vertex| points[vertex.point as usize]);
    let cross = (b - a).cross(c - a);
    (cross, corners.map(|vertex| vertex.normal.dot(cross) > 0.0))
}

fn ensure(holds: bool, what: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(what()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tetrahedron() -> Mesh {
        let points = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let mut mesh = Mesh { points, ..Mesh::default() };
        for face in [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] {
            let [a, b, c] = face.map(|p| mesh.points[p as usize]);
            let normal = (b - a).cross(c - a).normalize();
            let first = mesh.vertices.len() as u32;
            mesh.vertices.extend(face.map(|point| Vertex { point, normal, uv: Vec2::ZERO }));
            mesh.triangles.push([first, first + 1, first + 2]);
        }
        mesh
    }

    fn complaint(spoil: impl FnOnce(&mut Mesh)) -> String {
        let mut mesh = tetrahedron();
        spoil(&mut mesh);
        mesh.check_invariants().unwrap_err()
    }

    #[test]
    fn a_tetrahedron_is_sound() {
        assert_eq!(tetrahedron().check_invariants(), Ok(()));
    }

    #[test]
    fn every_defect_is_named() {
        assert!(complaint(|m| m.points[1].x = f32::NAN).contains("point 1"));
        assert!(complaint(|m| m.vertices[2].point = 9).contains("vertex 2 has a point out of range"));
        assert!(complaint(|m| m.vertices[2].normal = Vec3::ONE).contains("normal of length"));
        assert!(complaint(|m| m.vertices[2].normal = Vec3::Z).contains("cosine"));
        assert!(complaint(|m| m.triangles[0] = [0, 0, 1]).contains("no area"));
        assert!(complaint(|m| m.triangles[0][0] = 99).contains("triangle 0 has a vertex out of range"));
        assert!(complaint(|m| m.triangles.push(m.triangles[0])).contains("used twice"));
        assert!(complaint(|m| m.triangles.truncate(3)).contains("one face"));
        assert!(complaint(|m| m.points.push(Vec3::ONE)).contains("points are used"));
        assert!(complaint(|m| m.points.push(Vec3::X)).contains("one place"));
    }

    #[test]
    fn two_bodies_that_share_a_point_are_not_manifold() {
        let mut mesh = tetrahedron();
        let other = tetrahedron();
        mesh.points.extend(other.points[1..].iter().map(|p| -*p));
        let (points, vertices) = (3, mesh.vertices.len() as u32);
        let moved = |v: &Vertex| Vertex {
            point: if v.point == 0 { 0 } else { v.point + points },
            normal: -v.normal,
            ..*v
        };
        mesh.vertices.extend(other.vertices.iter().map(moved));
        mesh.triangles
            .extend(other.triangles.iter().map(|t| [t[0] + vertices, t[2] + vertices, t[1] + vertices]));
        // Mirroring a body turns its faces inside out, so they are wound the other way.
        assert!(mesh.check_invariants().unwrap_err().contains("joins two surfaces"));
    }

    #[test]
    fn corners_that_look_away_are_split() {
        let mut mesh = tetrahedron();
        mesh.vertices[0].normal = Vec3::Z;
        mesh.split_disagreeing_corners();
        assert_eq!(mesh.vertices.len(), 13);
        assert_eq!(mesh.check_invariants(), Ok(()));
    }
}
