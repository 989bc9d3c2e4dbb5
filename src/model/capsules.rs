//! Wood as a few capsules, with which games find out what runs into a plant.
//!
//! A capsule is all that is nearer to a straight piece of a branch than its radius. Along each branch a piece goes on while the
//! branch stays close to it and about as thick; of all pieces the thickest are kept. Each is written as a closed convex mesh called
//! `UCP_wood_LOD0_01`, `UCP_wood_LOD0_02` and so on, as Unreal Engine knows the capsules of a mesh `wood_LOD0`; other programs
//! take convex meshes.
//!
//! Limits: of wood alone; twigs, leaves, flowers and pots are walked through.

use super::mesh::{Mesh, Vertex};
use super::{Model, Part, PartKind};
use crate::geom::polyline;
use crate::plant::{Branch, Material, Plant};
use glam::{Quat, Vec2, Vec3};
use smol_str::format_smolstr;
use std::f32::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

/// Most capsules of a plant.
const MOST: usize = 32;
/// Wood thinner than this share of the thickest, the foot of the trunk, has none.
const THINNEST: f32 = 0.12;
/// How far a branch leaves its piece at most, share of its radius.
const ASIDE: f32 = 0.5;
/// How much thinner a piece is at its end at most than at its beginning.
const TAPER: f32 = 0.7;
/// Corners around a capsule, and rings of them on each of its round ends.
const SIDES: u32 = 8;
const RINGS: u32 = 2;

/// All that is nearer to a straight line than a radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    /// Where the line begins and ends, metres.
    pub ends: [Vec3; 2],
    /// The radius, metres.
    pub radius: f32,
}

/// The capsules of a plant's wood, the thickest first; none without wood.
pub fn capsules(plant: &Plant) -> Vec<Capsule> {
    let radii = plant.branches.iter().flat_map(|branch| &branch.radii);
    let thinnest = THINNEST * radii.copied().fold(0.0, f32::max);
    let mut all: Vec<Capsule> =
        plant.branches.iter().flat_map(|branch| of_branch(branch, thinnest)).collect();
    all.sort_by(|a, b| b.radius.total_cmp(&a.radius));
    all.truncate(MOST);
    all
}

/// The capsules along a branch where it is at least so thick.
fn of_branch(branch: &Branch, thinnest: f32) -> Vec<Capsule> {
    let thick = branch.radii.iter().take_while(|radius| **radius >= thinnest).count();
    let (mut capsules, mut first) = (Vec::new(), 0);
    while first + 1 < thick {
        let mut last = first + 1;
        while last + 1 < thick && is_straight(branch, first, last + 1) {
            last += 1;
        }
        let radius = 0.5 * (branch.radii[first] + branch.radii[last]);
        capsules.push(Capsule { ends: [branch.points[first], branch.points[last]], radius });
        first = last;
    }
    capsules
}

/// Whether a branch is about straight and as thick from one of its points to another.
fn is_straight(branch: &Branch, first: usize, last: usize) -> bool {
    let (a, b) = (branch.points[first], branch.points[last]);
    let is_near = |k: usize| {
        let on = a.lerp(b, polyline::nearest_share(a, b, branch.points[k], Vec3::dot));
        on.distance(branch.points[k]) <= ASIDE * branch.radii[k]
    };
    branch.radii[last] >= TAPER * branch.radii[first] && (first..=last).all(is_near)
}

impl Model {
    /// Puts capsules beside the model's first part, which they are called after and hang on; a model without parts stays as it is.
    pub fn add_capsules(&mut self, capsules: &[Capsule]) {
        let Some(first) = self.parts.first() else { return };
        let (name, specimen) = (first.name.clone(), first.specimen);
        let material = self.materials.len();
        if !capsules.is_empty() {
            self.materials.push(Material::plain("collision", [0.2, 0.6, 0.3]));
        }
        let part = |(capsule, number): (&Capsule, usize)| {
            let name = format_smolstr!("UCP_{name}_{number:02}");
            let alone = Part::alone(name, PartKind::Wood, material, Arc::new(capsule.mesh()));
            Part { parent: Some(0), specimen, ..alone }
        };
        self.parts.extend(capsules.iter().zip(1..).map(part));
    }
}

impl Capsule {
    /// Its surface: closed and convex, within its radius.
    pub fn mesh(&self) -> Mesh {
        let [from, to] = self.ends;
        let along = (to - from).normalize_or(Vec3::Y);
        let turn = Quat::from_rotation_arc(Vec3::Y, along);
        // From the pole at the beginning to that at the end: directions from whichever end is nearer.
        let heights = (0..RINGS).rev().map(|k| -(k as f32)).chain((0..RINGS).map(|k| k as f32));
        let rings = heights.enumerate().flat_map(|(ring, height)| {
            let (sin, cos) = (height / RINGS as f32 * FRAC_PI_2).sin_cos();
            let end = if ring < RINGS as usize { from } else { to };
            (0..SIDES).map(move |side| {
                let (x, z) = (side as f32 / SIDES as f32 * TAU).sin_cos();
                (end, turn * Vec3::new(cos * x, sin, cos * z))
            })
        });
        let corners: Vec<(Vec3, Vec3)> =
            [(from, -along)].into_iter().chain(rings).chain([(to, along)]).collect();
        let vertex =
            |(point, (_, normal)): (u32, &(Vec3, Vec3))| Vertex { point, normal: *normal, uv: Vec2::ZERO };
        Mesh {
            points: corners.iter().map(|(end, toward)| *end + self.radius * *toward).collect(),
            vertices: (0..).zip(&corners).map(vertex).collect(),
            triangles: triangles(),
            breaks: Vec::new(),
        }
    }
}

/// The triangles of a capsule: a pole, rings, the other pole.
fn triangles() -> Vec<[u32; 3]> {
    let rings = 2 * RINGS;
    let at = |ring: u32, side: u32| 1 + ring * SIDES + side % SIDES;
    let last = 1 + rings * SIDES;
    let first_fan = (0..SIDES).map(|side| [0, at(0, side + 1), at(0, side)]);
    let last_fan = (0..SIDES).map(|side| [last, at(rings - 1, side), at(rings - 1, side + 1)]);
    let between = (0..rings - 1).flat_map(|ring| (0..SIDES).map(move |side| (ring, side)));
    let quads = between.flat_map(|(ring, side)| {
        let [a, b, c, d] = [at(ring, side), at(ring, side + 1), at(ring + 1, side + 1), at(ring + 1, side)];
        [[a, b, c], [a, c, d]]
    });
    first_fan.chain(quads).chain(last_fan).collect()
}

#[cfg(test)]
mod tests {
    use super::super::quality::{self, Attributes};
    use super::*;
    use crate::plant::{Origin, Role, WoodPart};

    fn branch(points: Vec<Vec3>, radii: Vec<f32>) -> Branch {
        let role = Role::of(WoodPart::Stem);
        Branch { origin: Origin::Generated, parent: None, level: 0, points, radii, role }
    }

    /// A trunk that bends at a height of 2 m, with a twig.
    fn plant() -> Plant {
        let at = |x: f32, y: f32| Vec3::new(x, y, 0.0);
        let trunk =
            branch(vec![at(0.0, 0.0), at(0.0, 1.0), at(0.0, 2.0), at(1.0, 3.0)], vec![0.2, 0.19, 0.18, 0.17]);
        let twig = branch(vec![at(0.0, 1.5), at(1.0, 1.5)], vec![0.02, 0.01]);
        Plant { branches: vec![trunk, twig], ..Plant::default() }
    }

    #[test]
    fn a_trunk_has_a_capsule_for_each_straight_piece() {
        let capsules = capsules(&plant());
        let heights: Vec<[f32; 2]> = capsules.iter().map(|capsule| capsule.ends.map(|end| end.y)).collect();
        assert_eq!(heights, [[0.0, 2.0], [2.0, 3.0]]);
        assert!((capsules[0].radius - 0.19).abs() < 1e-6 && (capsules[1].radius - 0.175).abs() < 1e-6);
    }

    #[test]
    fn a_capsule_is_closed_and_convex() {
        let capsule = Capsule { ends: [Vec3::ZERO, Vec3::new(0.3, 1.0, -0.2)], radius: 0.1 };
        let mesh = capsule.mesh();
        assert_eq!(mesh.check_invariants(), Ok(()));
        let report = quality::judge(&mesh, Attributes { normals: true, uvs: false });
        assert_eq!(report.defects(), []);
        for [a, b, c] in &mesh.triangles {
            let [a, b, c] =
                [a, b, c].map(|corner| mesh.points[mesh.vertices[*corner as usize].point as usize]);
            let normal = (b - a).cross(c - a);
            assert!(mesh.points.iter().all(|p| normal.dot(*p - a) <= 1e-6));
        }
    }

    #[test]
    fn capsules_are_called_after_the_wood() {
        let mut model = Model {
            parts: vec![Part::alone("wood_LOD0", PartKind::Wood, 0, Arc::new(Mesh::default()))],
            materials: vec![Material::plain("bark", [0.2; 3])],
        };
        model.add_capsules(&capsules(&plant()));
        let names: Vec<&str> = model.parts.iter().map(|part| part.name.as_str()).collect();
        assert_eq!(names, ["wood_LOD0", "UCP_wood_LOD0_01", "UCP_wood_LOD0_02"]);
        assert_eq!(model.parts[2].parent, Some(0));
        assert_eq!(model.check_invariants(), Ok(()));
    }

    #[test]
    fn without_wood_there_are_none() {
        let mut model = Model::default();
        model.add_capsules(&capsules(&Plant::default()));
        assert_eq!(model, Model::default());
    }
}
