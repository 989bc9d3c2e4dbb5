//! Hand-made meshes, one defect each.

use super::*;

/// A mesh of the given faces, with the face's own normal at each corner.
fn mesh(points: &[[f32; 3]], faces: &[[u32; 3]]) -> Mesh {
    let points: Vec<Vec3> = points.iter().copied().map(Vec3::from).collect();
    let mut mesh = Mesh { points, ..Mesh::default() };
    for face in faces {
        let [p, q, r] = face.map(|i| mesh.points[i as usize]);
        let normal = (q - p).cross(r - p).normalize_or(Vec3::Z);
        let first = mesh.vertices.len() as u32;
        mesh.vertices.extend(face.map(|point| Vertex { point, normal, uv: Vec2::splat(0.5) }));
        mesh.triangles.push([first, first + 1, first + 2]);
    }
    mesh
}

const CUBE_POINTS: [[f32; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 1.0, 1.0],
    [0.0, 1.0, 1.0],
];

const CUBE_FACES: [[u32; 3]; 12] = [
    [0, 2, 1],
    [0, 3, 2],
    [4, 5, 6],
    [4, 6, 7],
    [0, 1, 5],
    [0, 5, 4],
    [1, 2, 6],
    [1, 6, 5],
    [2, 3, 7],
    [2, 7, 6],
    [3, 0, 4],
    [3, 4, 7],
];

fn judged(points: &[[f32; 3]], faces: &[[u32; 3]]) -> Report {
    judge(&mesh(points, faces), Attributes::ALL)
}

fn defects(points: &[[f32; 3]], faces: &[[u32; 3]]) -> Vec<(&'static str, usize)> {
    judged(points, faces).defects()
}

#[test]
fn a_closed_cube_is_clean() {
    let report = judged(&CUBE_POINTS, &CUBE_FACES);
    assert!(report.is_clean(), "{report:?}");
    assert_eq!((report.points, report.triangles, report.components), (8, 12, 1));
}

#[test]
fn an_open_box_has_a_boundary() {
    assert_eq!(defects(&CUBE_POINTS, &CUBE_FACES[2..]), [("boundary edges", 4)]);
}

#[test]
fn two_cubes_are_two_components() {
    let far = CUBE_POINTS.map(|[x, y, z]| [x + 3.0, y, z]);
    let points = [CUBE_POINTS, far].concat();
    let faces = [CUBE_FACES, CUBE_FACES.map(|f| f.map(|p| p + 8))].concat();
    let report = judged(&points, &faces);
    assert!(report.is_clean());
    assert_eq!(report.components, 2);
}

#[test]
fn a_turned_face_is_flipped() {
    let mut faces = CUBE_FACES;
    faces[5].swap(0, 1);
    assert_eq!(defects(&CUBE_POINTS, &faces), [("flipped faces", 1)]);
}

#[test]
fn a_turned_cube_is_inside_out() {
    let faces = CUBE_FACES.map(|[a, b, c]| [a, c, b]);
    assert_eq!(defects(&CUBE_POINTS, &faces), [("inside-out components", 1)]);
}

#[test]
fn a_flat_double_sheet_is_not_inside_out() {
    let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(judged(&points, &[[0, 1, 2], [0, 2, 1]]).inside_out_components, 0);
}

#[test]
fn a_repeated_face_is_a_duplicate_whatever_its_winding() {
    for again in [[2, 1, 0], [0, 1, 2], [1, 0, 2]] {
        let mut faces = CUBE_FACES.to_vec();
        faces.push(again);
        assert_eq!(judged(&CUBE_POINTS, &faces).duplicate_faces, 1);
        assert_eq!(judged(&CUBE_POINTS, &faces).non_manifold_edges, 3);
    }
}

#[test]
fn a_needle_and_a_repeated_point_have_no_area() {
    let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 1e-7, 0.0], [0.5, 1.0, 0.0]];
    assert_eq!(judged(&points, &[[0, 1, 2]]).zero_area_faces, 1);
    assert_eq!(judged(&points, &[[0, 1, 1]]).zero_area_faces, 1);
    assert_eq!(judged(&points, &[[0, 1, 3]]).zero_area_faces, 0);
}

#[test]
fn area_is_judged_at_any_size() {
    for scale in [1e-6, 1.0, 1e6] {
        let points = CUBE_POINTS.map(|p| p.map(|c| c * scale));
        assert!(defects(&points, &CUBE_FACES).is_empty(), "at scale {scale}");
    }
}

#[test]
fn numbers_that_are_not_finite_are_counted_once_each() {
    let mut bad = mesh(&CUBE_POINTS, &CUBE_FACES);
    bad.points[3].y = f32::NAN;
    bad.vertices[0].normal.x = f32::INFINITY;
    bad.vertices[1].uv.x = f32::NAN;
    let report = judge(&bad, Attributes::ALL);
    assert_eq!(
        report.defects().iter().find(|d| d.0.contains("finite")),
        Some(&("numbers that are not finite", 3))
    );
    assert_eq!(report.boundary_edges, 0);
}

#[test]
fn indices_out_of_range_are_counted_and_left_out() {
    let mut bad = mesh(&CUBE_POINTS, &CUBE_FACES);
    bad.triangles[0][2] = 1_000;
    bad.vertices[3].point = u32::MAX;
    let report = judge(&bad, Attributes::ALL);
    assert_eq!(report.indices_out_of_range, 2);
    assert_eq!(report.boundary_edges, 4);
}

#[test]
fn tetrahedra_that_touch_in_a_point_make_a_bow_tie() {
    let points = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [-1.0, 0.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, -1.0],
    ];
    let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3], [0, 4, 5], [0, 6, 4], [0, 5, 6], [4, 6, 5]];
    assert_eq!(defects(&points, &faces), [("non-manifold vertices", 1)]);
    assert_eq!(judged(&points, &faces).components, 2);
}

#[test]
fn three_faces_on_an_edge_are_not_manifold() {
    let points = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [-1.0, 1.0, 0.0], [-1.0, -1.0, 0.0]];
    let report = judged(&points, &[[0, 1, 2], [0, 1, 3], [0, 1, 4]]);
    assert_eq!((report.non_manifold_edges, report.boundary_edges), (1, 6));
    assert_eq!((report.non_manifold_vertices, report.components), (0, 1));
}

#[test]
fn a_moebius_band_cannot_be_wound_alike() {
    const STEPS: u32 = 9;
    let points: Vec<[f32; 3]> = (0..STEPS)
        .flat_map(|i| {
            let angle = i as f32 / STEPS as f32 * std::f32::consts::TAU;
            [-0.3, 0.3].map(|w| {
                let r = 1.0 + w * (angle / 2.0).cos();
                [r * angle.cos(), r * angle.sin(), w * (angle / 2.0).sin()]
            })
        })
        .collect();
    let faces: Vec<[u32; 3]> = (0..STEPS)
        .flat_map(|i| {
            let (a, b) = (2 * i, 2 * i + 1);
            let (c, d) = if i + 1 < STEPS { (a + 2, b + 2) } else { (1, 0) };
            [[a, c, b], [b, c, d]]
        })
        .collect();
    assert_eq!(judged(&points, &faces).unorientable_edges, 1);
}

#[test]
fn normals_are_judged_by_length_and_side() {
    let mut bad = mesh(&CUBE_POINTS, &CUBE_FACES);
    bad.vertices[0].normal *= 1.01;
    bad.vertices[3..6].iter_mut().for_each(|v| v.normal = -v.normal);
    let found = judge(&bad, Attributes::ALL).defects();
    assert_eq!(found, [("normals not of unit length", 1), ("normals against the winding", 1)]);
    assert!(judge(&bad, Attributes { normals: false, uvs: true }).is_clean());
}

#[test]
fn bark_may_repeat_its_picture_but_not_for_ever() {
    let mut tiled = mesh(&CUBE_POINTS, &CUBE_FACES);
    tiled.vertices[7].uv = Vec2::new(0.25, 12.0);
    let report = judge(&tiled, Attributes::ALL);
    assert!(report.is_clean());
    assert_eq!(report.uv_range, Some(UvRange { min: Vec2::new(0.25, 0.5), max: Vec2::new(0.5, 12.0) }));
    tiled.vertices[7].uv.y = 1e5;
    assert_eq!(judge(&tiled, Attributes::ALL).defects(), [("UVs out of range", 1)]);
}

#[test]
fn seams_are_not_cracks() {
    let seamed = mesh(&CUBE_POINTS, &CUBE_FACES);
    assert_eq!(seamed.vertices.len(), 36);
    assert!(judge(&seamed, Attributes::ALL).is_clean());
}
