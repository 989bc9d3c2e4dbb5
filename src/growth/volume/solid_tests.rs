//! Tests of closed meshes as volumes.

use super::*;
use proptest::prelude::*;

const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
    f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

fn fault(text: &str) -> String {
    Solid::from_obj(text, "cube.obj").unwrap_err().to_string()
}

#[test]
fn the_volume_is_the_mesh_s_own() {
    assert_eq!(Solid::from_obj(CUBE, "cube").unwrap().volume(), 1.0);
    let ball = 4.0 / 3.0 * std::f32::consts::PI;
    assert!((sphere(24).volume() / ball - 1.0).abs() < 0.02);
}

#[test]
fn plates_over_each_other_are_bounded_in_memory_and_time() {
    let plates = |count: usize| {
        let (mut points, mut triangles) = (Vec::new(), Vec::new());
        let cube = Solid::from_obj(CUBE, "cube").unwrap();
        for k in 0..count {
            let first = points.len() as u32;
            points.extend(cube.points.iter().map(|p| Vec3::new(p.x, (p.y * 0.5 + k as f32) / 1e3, p.z)));
            triangles.extend(cube.triangles.iter().map(|t| t.map(|i| i + first)));
        }
        Solid::new(points, triangles, "plates.obj")
    };
    let some = plates(100).unwrap();
    assert!(some.contains(Vec3::new(0.5, 0.05025, 0.5)) && !some.contains(Vec3::new(0.5, 0.05075, 0.5)));
    let message = plates(20_000).unwrap_err().to_string();
    assert!(message.contains("over each other") && message.contains("simplify"), "{message}");
}

#[test]
fn an_endless_text_is_refused_before_it_is_read() {
    assert!(fault(&"#".repeat(crate::growth::volume::MAX_BYTES + 1)).contains("bytes are more than"));
}

/// The mesh of an OBJ file turned inside out.
pub(crate) fn flipped(obj: &str) -> String {
    let turned = |line: &str| match line.strip_prefix("f ") {
        Some(rest) => format!("f {}\n", rest.split(' ').rev().collect::<Vec<_>>().join(" ")),
        None => format!("{line}\n"),
    };
    obj.lines().map(turned).collect()
}

#[test]
fn meshes_that_are_no_volume_are_refused_with_a_remedy() {
    assert!(fault("").contains("no face"));
    assert!(fault("v 0 0\nf x\n").starts_with("cube.obj: line 1: not a readable"));
    assert!(fault(&CUBE.replace("f 4 1 5 8\n", "")).contains("4 edges"));
    assert!(fault(&CUBE.replace("v 1 0 0", "v nan 0 0")).contains("no place"));
    assert!(fault("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n").contains("thickness"));
    assert!(fault(&flipped(CUBE)).contains("flip its normals"));
    let many = vec![[0, 1, 2]; MAX_TRIANGLES + 1];
    assert!(Solid::new(Vec::new(), many, "big.obj").unwrap_err().to_string().contains("simplify"));
    assert!(Solid::new(vec![Vec3::ZERO], vec![[0, 1, 2]], "b").unwrap_err().to_string().contains("corner 2"));
}

proptest! {
    #[test]
    fn a_cube_and_its_grid_points_are_distinguished(x in -4i32..12, y in -4i32..12, z in -4i32..12) {
        let cube = Solid::from_obj(CUBE, "cube").unwrap();
        // Eighths lie on edges and diagonals of the faces, where a careless ray counts twice.
        let p = Vec3::new(x as f32, y as f32, z as f32) / 8.0;
        if p.min_element() > 0.0 && p.max_element() < 1.0 {
            prop_assert!(cube.contains(p));
        }
        if p.min_element() < 0.0 || p.max_element() > 1.0 {
            prop_assert!(!cube.contains(p));
        }
    }

    #[test]
    fn a_sphere_of_triangles_agrees_with_the_sphere(x in -1.2f32..1.2, y in -1.2f32..1.2, z in -1.2f32..1.2) {
        let solid = sphere(24);
        let p = Vec3::new(x, y, z);
        if (p.length() - 1.0).abs() > 0.03 {
            prop_assert_eq!(solid.contains(p), p.length() < 1.0);
        }
    }
}

/// A sphere of radius 1 about the origin.
fn sphere(n: u32) -> Solid {
    let at = |i: u32, k: u32| {
        let (a, b) = (
            i as f32 / n as f32 * std::f32::consts::PI,
            (k % (2 * n)) as f32 / n as f32 * std::f32::consts::PI,
        );
        if i == 0 || i == n {
            return Vec3::new(0.0, if i == 0 { 1.0 } else { -1.0 }, 0.0);
        }
        Vec3::new(a.sin() * b.cos(), a.cos(), a.sin() * b.sin())
    };
    let (mut points, mut triangles) = (Vec::new(), Vec::new());
    for i in 0..n {
        for k in 0..2 * n {
            let first = points.len() as u32;
            points.extend([at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)]);
            triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        }
    }
    Solid::new(points, triangles, "sphere").unwrap()
}
