//! Hand-made models for tests, benches and the interoperability check.
//!
//! Closed, manifold surfaces built without the program's own modelling, so that files out and the judge of meshes are
//! tested on their own.

#![allow(dead_code, reason = "every test and bench takes only what it needs")]
#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use glam::{Vec2, Vec3};
use penstemon::model::{Mesh, Model, Part, PartKind, Vertex};
use penstemon::plant::{
    Branch, FinishedPlant, Material, OrganKind, Origin, Plant, Provenance, Role, Texture, WoodPart,
    WorldFromCanvas,
};
use std::borrow::Cow;
use std::f32::consts::TAU;

/// A straight closed tube with flat caps.
pub(crate) fn tube(base: Vec3, top: Vec3, radius: f32, sides: u32) -> Mesh {
    let axis = (top - base).normalize();
    let (side, front) = axis.any_orthonormal_pair();
    let outward = |k: u32| {
        let (sin, cos) = (k as f32 / sides as f32 * TAU).sin_cos();
        side * cos + front * sin
    };
    let mut mesh = Mesh::default();
    for end in [base, top] {
        mesh.points.extend((0..sides).map(|k| end + outward(k) * radius));
    }
    mesh.points.extend([base, top]);
    for k in 0..=sides {
        for row in [0, 1] {
            let uv = Vec2::new(k as f32 / sides as f32, row as f32 * 3.0);
            mesh.vertices.push(Vertex { point: row * sides + k % sides, normal: outward(k % sides), uv });
        }
    }
    for k in 0..sides {
        let (a, b) = (2 * k, 2 * k + 2);
        mesh.triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
    }
    for (row, normal) in [(0, -axis), (1, axis)] {
        let centre = mesh.vertices.len() as u32;
        mesh.vertices.push(Vertex { point: 2 * sides + row, normal, uv: Vec2::splat(0.5) });
        for k in 0..sides {
            mesh.vertices.push(Vertex { point: row * sides + k, normal, uv: Vec2::splat(0.5) });
            let (this, next) = (centre + 1 + k, centre + 1 + (k + 1) % sides);
            mesh.triangles.push(if row == 0 { [centre, next, this] } else { [centre, this, next] });
        }
    }
    mesh
}

/// A lens-shaped leaf, closed, in the plane of `u` and `v`: `rings` circles of `sides` points on either face, which
/// meet in the last circle.
pub(crate) fn leaf(base: Vec3, u: Vec3, v: Vec3, rings: u32, sides: u32) -> Mesh {
    let normal = u.cross(v).normalize();
    let mut mesh = Mesh::default();
    let mut push = |x: f32, y: f32, lift: f32| {
        let point = mesh.points.len() as u32;
        mesh.points.push(base + u * x + v * (1.0 + y) + normal * lift);
        let facing = if lift == 0.0 { Vec3::ZERO } else { normal * lift.signum() * u.length() };
        let tilt = (facing + (u * x + v * y) * 0.2).normalize();
        mesh.vertices.push(Vertex { point, normal: tilt, uv: Vec2::new(x + 1.0, y + 1.0) / 2.0 });
    };
    let thickness = 0.05 * u.length();
    let circle = |ring: u32, k: u32| {
        let (sin, cos) = (k as f32 / sides as f32 * TAU).sin_cos();
        let radius = ring as f32 / rings as f32;
        (radius * cos, radius * sin, thickness * (1.0 - radius * radius))
    };
    for face in [1.0, -1.0] {
        push(0.0, 0.0, face * thickness);
        for ring in 1..rings {
            (0..sides).map(|k| circle(ring, k)).for_each(|(x, y, lift)| push(x, y, face * lift));
        }
    }
    (0..sides).map(|k| circle(rings, k)).for_each(|(x, y, _)| push(x, y, 0.0));
    let face_size = 1 + (rings - 1) * sides;
    for face in [0, 1] {
        let at = |ring: u32, k: u32| match ring {
            0 => face * face_size,
            ring if ring == rings => 2 * face_size + k % sides,
            ring => face * face_size + 1 + (ring - 1) * sides + k % sides,
        };
        let mut push =
            |[a, b, c]: [u32; 3]| mesh.triangles.push(if face == 0 { [a, b, c] } else { [a, c, b] });
        for k in 0..sides {
            push([at(0, 0), at(1, k), at(1, k + 1)]);
            for ring in 1..rings {
                push([at(ring, k), at(ring + 1, k), at(ring + 1, k + 1)]);
                push([at(ring, k), at(ring + 1, k + 1), at(ring, k + 1)]);
            }
        }
    }
    mesh
}

/// A tiny valid PNG: one green pixel.
pub(crate) fn picture() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 1, 1);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header().unwrap().write_image_data(&[40, 160, 60, 255]).unwrap();
    bytes
}

/// The built-in textures of the fixtures: `leaf.png` and `bark one.png`.
pub(crate) fn textures(name: &str) -> Option<Cow<'static, [u8]>> {
    ["leaf.png", "bark one.png"].contains(&name).then(|| picture().into())
}

fn materials() -> Vec<Material> {
    let mut bark = Material::plain("bark #1 rough", [0.4, 0.3, 0.2]);
    bark.texture = Some(Texture::BuiltIn("bark one.png".into()));
    let mut leaf = Material::plain("leaf", [1.0, 1.0, 1.0]);
    leaf.texture = Some(Texture::BuiltIn("leaf.png".into()));
    leaf.double_sided = true;
    leaf.cut_out = true;
    (leaf.specular, leaf.shininess, leaf.translucency) = ([0.12; 3], 30.0, 0.35);
    let mut other = Material::plain("叶", [0.9, 0.2, 0.1]);
    other.texture = leaf.texture.clone();
    vec![bark, leaf, other, Material::plain("unused", [0.0; 3])]
}

fn part(
    name: String,
    kind: PartKind,
    parent: Option<usize>,
    specimen: usize,
    pivot: Vec3,
    mesh: Mesh,
) -> Part {
    let material = match kind {
        PartKind::Wood => 0,
        _ => 1 + specimen % 2,
    };
    Part {
        name: name.into(),
        kind,
        parent,
        specimen,
        pivot,
        material,
        more_materials: Vec::new(),
        mesh: mesh.into(),
        copies: None,
    }
}

/// Two specimens: each a trunk with a branch, and a leaf on either.
pub(crate) fn two_specimens() -> (Model, FinishedPlant) {
    let mut parts = Vec::new();
    for specimen in 0..2 {
        let base = Vec3::new(specimen as f32 * 0.4, 0.0, 0.1);
        let (fork, top) = (base + Vec3::Y * 0.2, base + Vec3::Y * 0.5);
        let end = fork + Vec3::new(0.15, 0.1, 0.02);
        let trunk = parts.len();
        let wood = |parts: &mut Vec<Part>, parent, from: Vec3, to, radius| {
            let name = format!("branch_{}", parts.len());
            parts.push(part(name, PartKind::Wood, parent, specimen, from, tube(from, to, radius, 8)));
        };
        wood(&mut parts, None, base, top, 0.01);
        wood(&mut parts, Some(trunk), fork, end, 0.005);
        for (parent, at) in [(trunk, top), (trunk + 1, end)] {
            let name = format!("leaf_{}", parts.len());
            let mesh = leaf(at, Vec3::X * 0.02, Vec3::new(0.0, 0.03, 0.01), 4, 12);
            parts.push(part(name, PartKind::Organ(OrganKind::Leaf), Some(parent), specimen, at, mesh));
        }
    }
    let model = Model { parts, materials: materials() };
    let plant = plant_of(&model);
    (model, plant)
}

/// A trunk with `leaves` leaves of 170 points each.
pub(crate) fn leafy(leaves: usize) -> (Model, FinishedPlant) {
    let trunk =
        part("branch_0".into(), PartKind::Wood, None, 0, Vec3::ZERO, tube(Vec3::ZERO, Vec3::Y, 0.02, 8));
    let mut parts = vec![trunk];
    for i in 0..leaves {
        let (sin, cos) = (i as f32 * 2.4).sin_cos();
        let at = Vec3::new(cos * 0.3, i as f32 / leaves as f32, sin * 0.3);
        let mesh = leaf(at, Vec3::new(-sin, 0.0, cos) * 0.02, Vec3::new(cos, 0.6, sin) * 0.03, 6, 14);
        parts.push(part(format!("leaf_{i}"), PartKind::Organ(OrganKind::Leaf), Some(0), 0, at, mesh));
    }
    let model = Model { parts, materials: materials() };
    let plant = plant_of(&model);
    (model, plant)
}

/// What only the drawing knows of a plant of [`plant_of`]: stroke 7 drew all of it.
pub(crate) fn provenance() -> Provenance {
    drawn_by_seven().0
}

fn drawn_by_seven() -> (Provenance, Origin) {
    let mut provenance = Provenance::new(WorldFromCanvas { scale: 0.001, origin: Vec2::new(512.0, 700.0) });
    let origin = provenance.record(Some(7));
    (provenance, origin)
}

/// A plant with a branch per wooden part: enough for the exporter of plants, which knows no surfaces.
fn plant_of(model: &Model) -> FinishedPlant {
    let wood = model.parts.iter().filter(|part| part.kind == PartKind::Wood);
    let origin = drawn_by_seven().1;
    let branch = |part: &Part| Branch {
        origin,
        parent: None,
        level: 0,
        points: vec![part.pivot, part.pivot + Vec3::Y * 0.1],
        radii: vec![0.01, 0.007],
        role: Role { variant: part.material as u32, ..Role::of(WoodPart::Stem) },
    };
    let plant = Plant { branches: wood.map(branch).collect(), ..Plant::default() };
    let of = |material: usize| Role { variant: material as u32, ..Role::of(WoodPart::Stem.into()) };
    let roles: Vec<Role> = (0..model.materials.len()).map(of).collect();
    FinishedPlant::new(plant, &roles, |role| model.materials[role.variant as usize].clone())
}
