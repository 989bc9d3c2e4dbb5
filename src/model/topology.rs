//! How triangles hang together: edges, fans around points, components, winding.
//!
//! All half-edges are sorted by their two points; a run of equal keys is one edge with its faces. From the runs follow
//! boundary and non-manifold edges directly, and three partitions by union-find: faces into components (joined by
//! edges), faces into surfaces that can be wound alike (joined by two-faced edges, with parity), corners into fans
//! around their point. A point with more than one fan is a bow-tie. As in MeshLab, points on non-manifold edges are
//! not counted as bow-ties again.
//!
//! O(n log n) in faces for the sort, 16 bytes per half-edge; nothing is hashed, so the outcome has one order.

use super::disjoint_sets::DisjointSets;

/// What the connections of a set of faces look like.
pub(super) struct Topology {
    /// Edges of one face.
    pub(super) boundary_edges: usize,
    /// Edges of three or more faces.
    pub(super) non_manifold_edges: usize,
    /// Points whose faces form more than one fan.
    pub(super) non_manifold_vertices: usize,
    /// Faces wound against the majority of their surface.
    pub(super) flipped_faces: usize,
    /// Edges across which no winding of the surface agrees.
    pub(super) unorientable_edges: usize,
    /// Component of each face, numbered from 0 in order of first face.
    pub(super) component_of_face: Vec<u32>,
    /// For each component, whether it is closed, manifold along edges and wound alike: whether it has an inside.
    pub(super) has_inside: Vec<bool>,
}

/// An edge's points, lower first, and the half-edge that has it: three times the face plus the corner it starts from.
type HalfEdge = (u64, u32);

struct Sets {
    components: DisjointSets,
    surfaces: DisjointSets,
    fans: DisjointSets,
}

/// Analyses faces given by their points; all indices below `point_count`, no point twice in a face.
pub(super) fn analyse(faces: &[[u32; 3]], point_count: usize) -> Topology {
    let edges = sorted_half_edges(faces);
    let mut sets = Sets {
        components: DisjointSets::new(faces.len()),
        surfaces: DisjointSets::new(faces.len()),
        fans: DisjointSets::new(3 * faces.len()),
    };
    let mut found = Topology {
        boundary_edges: 0,
        non_manifold_edges: 0,
        non_manifold_vertices: 0,
        flipped_faces: 0,
        unorientable_edges: 0,
        component_of_face: Vec::new(),
        has_inside: Vec::new(),
    };
    let mut open_faces = Vec::new();
    let mut on_bad_edge = vec![false; point_count];
    for edge in edges.chunk_by(|a, b| a.0 == b.0) {
        match edge {
            [_] => found.boundary_edges += 1,
            [a, b] => {
                found.unorientable_edges += usize::from(!join_surfaces(&mut sets.surfaces, faces, a.1, b.1))
            }
            _ => {
                found.non_manifold_edges += 1;
                on_bad_edge[(edge[0].0 >> 32) as usize] = true;
                on_bad_edge[edge[0].0 as u32 as usize] = true;
            }
        }
        if edge.len() != 2 {
            open_faces.extend(edge.iter().map(|half| half.1 / 3));
        }
        for pair in edge.windows(2) {
            sets.components.join(pair[0].1 / 3, pair[1].1 / 3, false);
            join_fans(&mut sets.fans, faces, pair[0].1, pair[1].1);
        }
    }
    found.non_manifold_vertices = count_bow_ties(&mut sets.fans, faces, &on_bad_edge);
    number_components(&mut found, &mut sets.components, faces.len(), &open_faces);
    count_flipped(&mut found, &mut sets.surfaces);
    found
}

fn sorted_half_edges(faces: &[[u32; 3]]) -> Vec<HalfEdge> {
    let mut edges: Vec<HalfEdge> = Vec::with_capacity(3 * faces.len());
    for (f, face) in faces.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (face[k], face[(k + 1) % 3]);
            edges.push((u64::from(a.min(b)) << 32 | u64::from(a.max(b)), (3 * f + k) as u32));
        }
    }
    edges.sort_unstable();
    edges
}

/// The two corners of a half-edge: where it starts and where it ends.
fn ends(half: u32) -> (u32, u32) {
    (half, half - half % 3 + (half + 1) % 3)
}

fn point(faces: &[[u32; 3]], corner: u32) -> u32 {
    faces[(corner / 3) as usize][(corner % 3) as usize]
}

/// Neighbours are wound alike when they run along their edge in opposite directions.
fn join_surfaces(surfaces: &mut DisjointSets, faces: &[[u32; 3]], a: u32, b: u32) -> bool {
    surfaces.join(a / 3, b / 3, point(faces, a) == point(faces, b))
}

fn join_fans(fans: &mut DisjointSets, faces: &[[u32; 3]], a: u32, b: u32) {
    let ((a0, a1), (b0, b1)) = (ends(a), ends(b));
    let same_direction = point(faces, a0) == point(faces, b0);
    let (b0, b1) = if same_direction { (b0, b1) } else { (b1, b0) };
    fans.join(a0, b0, false);
    fans.join(a1, b1, false);
}

fn count_bow_ties(fans: &mut DisjointSets, faces: &[[u32; 3]], on_bad_edge: &[bool]) -> usize {
    let mut fan_of_point: Vec<(u32, u32)> =
        (0..3 * faces.len() as u32).map(|corner| (point(faces, corner), fans.root(corner))).collect();
    fan_of_point.sort_unstable();
    fan_of_point.dedup();
    fan_of_point
        .chunk_by(|a, b| a.0 == b.0)
        .filter(|fans| fans.len() > 1 && !on_bad_edge[fans[0].0 as usize])
        .count()
}

fn number_components(
    found: &mut Topology,
    components: &mut DisjointSets,
    face_count: usize,
    open_faces: &[u32],
) {
    found.component_of_face.reserve(face_count);
    for face in 0..face_count as u32 {
        // A representative is the lowest face of its component, so it has its number before the others ask.
        let root = components.root(face);
        let number = if root == face {
            found.has_inside.push(true);
            found.has_inside.len() as u32 - 1
        } else {
            found.component_of_face[root as usize]
        };
        found.component_of_face.push(number);
    }
    for &face in open_faces {
        found.has_inside[found.component_of_face[face as usize] as usize] = false;
    }
}

fn count_flipped(found: &mut Topology, surfaces: &mut DisjointSets) {
    let face_count = found.component_of_face.len();
    let mut against = vec![[0usize; 2]; face_count];
    for face in 0..face_count as u32 {
        let (root, parity) = surfaces.find(face);
        against[root as usize][usize::from(parity)] += 1;
    }
    for (root, [with, against]) in against.into_iter().enumerate() {
        let minority = with.min(against);
        found.flipped_faces += minority;
        if minority > 0 {
            found.has_inside[found.component_of_face[root] as usize] = false;
        }
    }
}
