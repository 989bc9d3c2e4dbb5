//! The ground of a garden as a closed slab, with its paths in a material of their own.
//!
//! A grid over the area is cut along two level sets, how deep a point is inside the area and how far beside a path: each cell's triangles
//! are split where the value changes its sign, linearly between corners. A cut depends on the two ends of its edge alone, so
//! neighbours agree. Below lies a level underside, and walls close the slab.
//!
//! Limits: corners of the area and ends of paths are as sharp as the grid is fine; holes narrower than a cell are overlooked.

use super::places::Plan;
use super::spec::Cover;
use crate::budget::GardenBudget;
use crate::model::{Mesh, Vertex};
use crate::plant::{Material, Texture};
use glam::{UVec2, Vec2, Vec3};
use std::collections::BTreeMap;

/// Thickness of the slab below its lowest place, as a share of the area's longer side, and at most in metres.
const THICKNESS: (f32, f32) = (0.02, 0.25);
/// Side of the soil's picture on the ground, metres.
const PICTURE: f32 = 0.4;
/// Values nearer to zero than this share of a cell count as zero: cuts keep off corners.
const ZERO: f32 = 1e-3;
/// Linear colours of a lawn and of a gravel path.
const LAWN: [f32; 3] = [0.085, 0.16, 0.035];
const GRAVEL: [f32; 3] = [0.27, 0.22, 0.16];

/// The slab of a garden and its materials; none where it has no cover.
pub fn slab(plan: &Plan, cover: Cover) -> Option<(Mesh, Vec<Material>)> {
    let ground = match cover {
        Cover::Soil => {
            let texture = Some(Texture::BuiltIn("soil.png".to_owned()));
            Material { texture, ..Material::plain("soil", [0.5, 0.42, 0.36]) }
        }
        Cover::Lawn => Material::plain("lawn", LAWN),
        Cover::None => return None,
    };
    let plane = Plane::new(plan);
    let mut mesh = plane.tops(&plane.ground, plan);
    let top_points = mesh.points.len() as u32;
    plane.underside(&mut mesh, top_points, thickness(plan));
    if plane.paths.is_empty() {
        return Some((mesh, vec![ground]));
    }
    mesh.breaks = vec![mesh.triangles.len() as u32];
    let path_top = plane.tops(&plane.paths, plan);
    let vertices = mesh.vertices.len() as u32;
    mesh.vertices.extend(path_top.vertices);
    mesh.triangles.extend(path_top.triangles.iter().map(|triangle| triangle.map(|v| v + vertices)));
    Some((mesh, vec![ground, Material::plain("gravel", GRAVEL)]))
}

fn thickness(plan: &Plan) -> f32 {
    let (low, high) = plan.area.bounds();
    (THICKNESS.0 * (high - low).max_element()).min(THICKNESS.1)
}

/// The ground plan in triangles that turn from x toward z.
struct Plane {
    points: Vec<Vec2>,
    ground: Vec<[u32; 3]>,
    paths: Vec<[u32; 3]>,
    cell: f32,
}

impl Plane {
    fn new(plan: &Plan) -> Self {
        let (low, high) = plan.area.bounds();
        let size = high - low;
        let is_plain = plan.paths.is_empty() && plan.ground.is_level() && plan.area.fills_box();
        let most = if is_plain { 1.0 } else { GardenBudget::GARDEN.ground_cells as f32 };
        let cell = (size.element_product() / most).sqrt();
        let counts = (size / cell).round().max(Vec2::ONE).min(Vec2::splat(most)).as_uvec2();
        let corner = |x: u32, z: u32| {
            let share = UVec2::new(x, z).as_vec2() / counts.as_vec2();
            // The last corner is exactly the box's.
            low * (Vec2::ONE - share) + high * share
        };
        let level = |value: f32| if value.abs() < ZERO * cell { 0.0 } else { value };
        let depth = |p: Vec2| if is_plain { 1.0 } else { level(plan.area.depth(p)) };
        let beside = |p: Vec2| {
            level(
                plan.paths.iter().map(|path| path.beside(p)).fold(f32::INFINITY, f32::min).min(size.length()),
            )
        };
        let mut welder = Welder::default();
        let (mut ground, mut paths) = (Vec::new(), Vec::new());
        for z in 0..counts.y {
            for x in 0..counts.x {
                let [a, b, c, d] = [corner(x, z), corner(x + 1, z), corner(x + 1, z + 1), corner(x, z + 1)];
                for triangle in [[a, b, c], [a, c, d]] {
                    let (inside, _) = split(&triangle, &depth);
                    let (off, on) = split(&inside, &beside);
                    welder.fan(&off, &mut ground);
                    welder.fan(&on, &mut paths);
                }
            }
        }
        Self { points: welder.points, ground, paths, cell }
    }

    /// The upper side of some triangles, with all points of the plane.
    fn tops(&self, triangles: &[[u32; 3]], plan: &Plan) -> Mesh {
        let points: Vec<Vec3> = self.points.iter().map(|p| plan.ground.point(*p)).collect();
        let vertex = |(point, p): (u32, &Vec2)| Vertex {
            point,
            normal: plan.ground.normal(*p, self.cell),
            uv: *p / PICTURE,
        };
        let vertices = (0..).zip(&self.points).map(vertex).collect();
        // From x toward z is downward.
        let triangles = triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
        Mesh { points, vertices, triangles, breaks: Vec::new() }
    }

    /// Closes a mesh that has the plane's upper points with an underside and walls.
    fn underside(&self, mesh: &mut Mesh, top_points: u32, thickness: f32) {
        let bottom = mesh.points.iter().map(|p| p.y).fold(f32::INFINITY, f32::min) - thickness;
        let first = mesh.vertices.len() as u32;
        mesh.points.extend(self.points.iter().map(|p| Vec3::new(p.x, bottom, p.y)));
        let below = (0..).zip(&self.points).map(|(k, p)| Vertex {
            point: top_points + k,
            normal: -Vec3::Y,
            uv: *p / PICTURE,
        });
        mesh.vertices.extend(below);
        let all = || self.ground.iter().chain(&self.paths);
        mesh.triangles.extend(all().map(|triangle| triangle.map(|v| v + first)));
        let mut edges: Vec<[u32; 2]> = all().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
        edges.sort_unstable();
        for &[a, b] in edges.iter().filter(|&&[a, b]| edges.binary_search(&[b, a]).is_err()) {
            let along = self.points[b as usize] - self.points[a as usize];
            let normal = Vec3::new(along.y, 0.0, -along.x).normalize_or(Vec3::X);
            let vertex = mesh.vertices.len() as u32;
            let from = self.points[a as usize].element_sum();
            let to = from + along.length();
            let [high_a, high_b] = [a, b].map(|top| mesh.points[top as usize].y - bottom);
            for (point, uv) in [
                (a, Vec2::new(from, high_a)),
                (b, Vec2::new(to, high_b)),
                (b + top_points, Vec2::new(to, 0.0)),
                (a + top_points, Vec2::new(from, 0.0)),
            ] {
                mesh.vertices.push(Vertex { point, normal, uv: uv / PICTURE });
            }
            mesh.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|triangle| triangle.map(|k| k + vertex)));
        }
    }
}

/// Splits a convex polygon where a value changes its sign: the part where it is not negative, and the other.
fn split(polygon: &[Vec2], value: &impl Fn(Vec2) -> f32) -> (Vec<Vec2>, Vec<Vec2>) {
    let (mut inside, mut outside) = (Vec::new(), Vec::new());
    for (k, &a) in polygon.iter().enumerate() {
        let b = polygon[(k + 1) % polygon.len()];
        let (at_a, at_b) = (value(a), value(b));
        if at_a >= 0.0 {
            inside.push(a);
        }
        if at_a <= 0.0 {
            outside.push(a);
        }
        if (at_a < 0.0) != (at_b < 0.0) && at_a != 0.0 && at_b != 0.0 {
            let cut = cut(a, at_a, b, at_b);
            inside.push(cut);
            outside.push(cut);
        }
    }
    (inside, outside)
}

/// The point between two where a value is zero; the same in either order.
fn cut(a: Vec2, at_a: f32, b: Vec2, at_b: f32) -> Vec2 {
    let ((a, at_a), (b, at_b)) =
        if bits(a) < bits(b) { ((a, at_a), (b, at_b)) } else { ((b, at_b), (a, at_a)) };
    a + (b - a) * (at_a / (at_a - at_b))
}

fn bits(p: Vec2) -> [u32; 2] {
    // Of both zeros one.
    (p + Vec2::ZERO).to_array().map(f32::to_bits)
}

/// Gives points at one place one number.
#[derive(Default)]
struct Welder {
    points: Vec<Vec2>,
    known: BTreeMap<[u32; 2], u32>,
}

impl Welder {
    fn number(&mut self, p: Vec2) -> u32 {
        *self.known.entry(bits(p)).or_insert_with(|| {
            self.points.push(p);
            self.points.len() as u32 - 1
        })
    }

    /// A convex polygon in triangles around its middle: several of its corners may lie on one line.
    fn fan(&mut self, polygon: &[Vec2], out: &mut Vec<[u32; 3]>) {
        let mut corners: Vec<u32> = polygon.iter().map(|p| self.number(*p)).collect();
        corners.dedup();
        if corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
        if let [a, b, c] = corners[..] {
            out.push([a, b, c]);
        } else if corners.len() > 3 {
            let middle = polygon.iter().sum::<Vec2>() / polygon.len() as f32;
            let middle = self.number(middle);
            let next = corners.iter().cycle().skip(1);
            out.extend(corners.iter().zip(next).map(|(a, b)| [middle, *a, *b]));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::area::{Area, Path};
    use super::super::grey_map::GreyMap;
    use super::super::ground::Ground;
    use super::*;
    use crate::picture::decode::Rgba;

    fn plan(corners: &[[f32; 2]], paths: Vec<Path>, ground: Ground) -> Plan {
        let area = Area::polygon(corners.iter().copied().map(Vec2::from).collect()).unwrap();
        let variation = Default::default();
        Plan { seed: 1, area, density: None, map: None, ground, paths, kinds: Vec::new(), variation }
    }

    const SQUARE: [[f32; 2]; 4] = [[-4.0, -4.0], [4.0, -4.0], [4.0, 4.0], [-4.0, 4.0]];

    /// The area of some triangles, seen from above.
    fn seen(mesh: &Mesh, triangles: std::ops::Range<usize>) -> f64 {
        let up = |triangle: &[u32; 3]| {
            let [a, b, c] = mesh.corners(*triangle).map(|p| p.as_dvec3());
            ((b - a).cross(c - a).y / 2.0).max(0.0)
        };
        mesh.triangles[triangles].iter().map(up).sum()
    }

    #[test]
    fn a_level_square_is_a_box() {
        let (mesh, materials) = slab(&plan(&SQUARE, Vec::new(), Ground::default()), Cover::Soil).unwrap();
        assert_eq!(mesh.check_invariants(), Ok(()));
        assert_eq!((materials.len(), mesh.triangles.len()), (1, 12));
        assert!((seen(&mesh, 0..12) - 64.0).abs() < 1e-3);
        assert!(slab(&plan(&SQUARE, Vec::new(), Ground::default()), Cover::None).is_none());
    }

    #[test]
    fn paths_are_cut_out_of_the_ground() {
        let path = Path::new(vec![Vec2::new(-9.0, -0.37), Vec2::new(9.0, 0.61)], 1.0).unwrap();
        let (mesh, materials) = slab(&plan(&SQUARE, vec![path], Ground::default()), Cover::Lawn).unwrap();
        assert_eq!(mesh.check_invariants(), Ok(()));
        assert_eq!((materials.len(), mesh.breaks.len()), (2, 1));
        let first = mesh.breaks[0] as usize;
        let (ground, path) = (seen(&mesh, 0..first), seen(&mesh, first..mesh.triangles.len()));
        assert!((ground + path - 64.0).abs() < 1e-2 && (path - 8.0).abs() < 0.05, "{ground} {path}");
    }

    #[test]
    fn a_hilly_polygon_is_closed_too() {
        let corners = [[0.0, 0.0], [6.0, 1.0], [5.0, 4.0], [2.5, 2.5], [0.5, 5.0]];
        let greys = [0u8, 120, 40, 255, 10, 90, 60, 200, 0];
        let pixels = greys.iter().flat_map(|&grey| [grey, grey, grey, 255]).collect();
        let map = GreyMap::of(&Rgba { width: 3, height: 3, pixels }).unwrap();
        let ground = Ground::of_map(map, [0.0, 1.0], (Vec2::ZERO, Vec2::new(6.0, 5.0)));
        let path =
            Path::new(vec![Vec2::new(0.0, 2.0), Vec2::new(3.0, 1.0), Vec2::new(6.0, 3.0)], 0.6).unwrap();
        let plan = plan(&corners, vec![path], ground);
        let (mesh, _) = slab(&plan, Cover::Soil).unwrap();
        assert_eq!(mesh.check_invariants(), Ok(()));
        let all = seen(&mesh, 0..mesh.triangles.len());
        assert!((all / f64::from(plan.area.square_metres()) - 1.0).abs() < 0.01, "{all}");
    }
}
