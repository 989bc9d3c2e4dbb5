//! The ground of a garden as a closed slab, with its paths in a material of their own.
//!
//! A grid over the area is cut along level sets, how deep a point is inside the area and how far beside a path or a bed: each cell's
//! triangles are split where the value changes its sign, linearly between corners. A cut depends on the two ends of its edge alone, so
//! neighbours agree. Below lies a level underside, and walls close the slab.
//!
//! Limits: corners of the area and ends of paths are as sharp as the grid is fine; holes narrower than a cell are overlooked.

use super::ground::Ground;
use super::plan::Plan;
use super::spec::Cover;
use crate::budget::GardenBudget;
use crate::model::{Mesh, Vertex};
use crate::plant::{Material, Texture};
use glam::{UVec2, Vec2, Vec3};
use rayon::prelude::*;
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
    let beside = |p: Vec2| plan.paths.iter().map(|path| path.beside(p)).fold(f32::INFINITY, f32::min);
    let depth = |p: Vec2| plan.area.depth(p);
    let outside_beds = |p: Vec2| plan.beds.iter().map(|bed| -bed.depth(p)).fold(f32::INFINITY, f32::min);
    let mut layers = Vec::new();
    if !plan.beds.is_empty() && cover != Cover::Soil {
        layers.push(Layer::soil(&outside_beds));
    }
    if !plan.paths.is_empty() {
        layers.push(Layer::gravel(&beside));
    }
    let is_plain = layers.is_empty() && plan.ground.is_level() && plan.area.fills_box();
    let ground = Terrain {
        bounds: plan.area.bounds(),
        depth: (!is_plain).then_some(&depth),
        heights: &plan.ground,
        cells: GardenBudget::GARDEN.ground_cells,
        layers,
    };
    ground.slab(cover)
}

/// How far a point is outside of something, metres; negative inside.
type Distance<'a> = &'a (dyn Fn(Vec2) -> f32 + Sync);

/// Something that lies on the ground and has another material.
pub(super) struct Layer<'a> {
    material: Material,
    outside: Distance<'a>,
}

impl<'a> Layer<'a> {
    /// Gravel of paths.
    pub(super) fn gravel(outside: Distance<'a>) -> Self {
        Self { material: Material::plain("gravel", GRAVEL), outside }
    }

    /// Soil of beds.
    pub(super) fn soil(outside: Distance<'a>) -> Self {
        Self { material: soil(), outside }
    }
}

/// A ground plan that becomes a slab.
pub(super) struct Terrain<'a> {
    /// Smallest and largest corner.
    pub(super) bounds: (Vec2, Vec2),
    /// How deep a point is inside; none where the plan fills its bounds and is one level rectangle.
    pub(super) depth: Option<Distance<'a>>,
    pub(super) heights: &'a Ground,
    /// Cells of its surface, about.
    pub(super) cells: usize,
    /// What lies on it, the later over the earlier.
    pub(super) layers: Vec<Layer<'a>>,
}

fn soil() -> Material {
    let texture = Some(Texture::BuiltIn("soil.png".to_owned()));
    Material { texture, ..Material::plain("soil", [0.5, 0.42, 0.36]) }
}

impl Terrain<'_> {
    /// The slab and its materials, those that are seen of the cover's and the layers'; none without cover.
    pub(super) fn slab(self, cover: Cover) -> Option<(Mesh, Vec<Material>)> {
        let ground = match cover {
            Cover::Soil => soil(),
            Cover::Lawn => Material::plain("lawn", LAWN),
            Cover::None => return None,
        };
        let plane = Plane::new(&self);
        let mut mesh = plane.tops(&plane.regions[0], self.heights);
        let top_points = mesh.points.len() as u32;
        plane.underside(&mut mesh, top_points, self.thickness());
        let mut materials = vec![ground];
        for (region, layer) in plane.regions[1..].iter().zip(self.layers) {
            if region.is_empty() {
                continue;
            }
            mesh.breaks.push(mesh.triangles.len() as u32);
            materials.push(layer.material);
            let top = plane.tops(region, self.heights);
            let vertices = mesh.vertices.len() as u32;
            mesh.vertices.extend(top.vertices);
            mesh.triangles.extend(top.triangles.iter().map(|triangle| triangle.map(|v| v + vertices)));
        }
        Some((mesh, materials))
    }

    fn thickness(&self) -> f32 {
        let (low, high) = self.bounds;
        (THICKNESS.0 * (high - low).max_element()).min(THICKNESS.1)
    }
}

/// The ground plan in triangles that turn from x toward z.
struct Plane {
    points: Vec<Vec2>,
    /// Triangles of the ground, and of each layer as far as no later one lies over it.
    regions: Vec<Vec<[u32; 3]>>,
    cell: f32,
}

impl Plane {
    fn new(terrain: &Terrain<'_>) -> Self {
        let (low, high) = terrain.bounds;
        let size = high - low;
        let most = if terrain.depth.is_none() { 1.0 } else { terrain.cells as f32 };
        let cell = (size.element_product() / most).sqrt();
        let counts = (size / cell).round().max(Vec2::ONE).min(Vec2::splat(most)).as_uvec2();
        let levels = Levels { terrain, zero: ZERO * cell, farthest: size.length() };
        let corner = |k: u32| {
            let share = UVec2::new(k % (counts.x + 1), k / (counts.x + 1)).as_vec2() / counts.as_vec2();
            // The last corner is exactly the box's.
            low * (Vec2::ONE - share) + high * share
        };
        let sampled = (0..(counts.x + 1) * (counts.y + 1))
            .into_par_iter()
            .map(|k| (corner(k), levels.layers(corner(k))));
        let sampled: Vec<(Vec2, Option<u32>)> = sampled.collect();
        let mut welder = Welder::default();
        let mut numbers = vec![None; sampled.len()];
        let mut regions = vec![Vec::new(); 1 + terrain.layers.len()];
        for z in 0..counts.y {
            for x in 0..counts.x {
                let at = |x: u32, z: u32| (z * (counts.x + 1) + x) as usize;
                let [a, b, c, d] = [at(x, z), at(x + 1, z), at(x + 1, z + 1), at(x, z + 1)];
                for places in [[a, b, c], [a, c, d]] {
                    let corners = places.map(|place| sampled[place]);
                    let triangle = corners.map(|(corner, _)| corner);
                    let layers = corners[0]
                        .1
                        .filter(|first| corners.iter().all(|(_, layers)| *layers == Some(*first)));
                    match layers {
                        Some(OUTSIDE) => {}
                        // The uppermost, or the ground.
                        Some(layers) => {
                            let mut number = |place: usize| {
                                *numbers[place].get_or_insert_with(|| welder.number(sampled[place].0))
                            };
                            let region = layers.checked_ilog2().unwrap_or(0) as usize;
                            regions[region].push(places.map(&mut number));
                        }
                        None => {
                            levels.cut(&triangle, |piece, region| welder.fan(piece, &mut regions[region]))
                        }
                    }
                }
            }
        }
        Self { points: welder.points, regions, cell }
    }

    /// The upper side of some triangles, with all points of the plane.
    fn tops(&self, triangles: &[[u32; 3]], heights: &Ground) -> Mesh {
        let points: Vec<Vec3> = self.points.iter().map(|p| heights.point(*p)).collect();
        let vertex = |(point, p): (u32, &Vec2)| Vertex {
            point,
            normal: heights.normal(*p, self.cell),
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
        let all = || self.regions.iter().flatten();
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

/// What is outside of the ground has all layers and more.
const OUTSIDE: u32 = u32::MAX;

/// The values along whose zeros a terrain is cut.
struct Levels<'a> {
    terrain: &'a Terrain<'a>,
    /// Values nearer to zero count as zero.
    zero: f32,
    /// Distances beyond this are all the same.
    farthest: f32,
}

impl Levels<'_> {
    fn level(&self, value: f32) -> f32 {
        if value.abs() < self.zero { 0.0 } else { value.min(self.farthest) }
    }

    fn depth(&self, p: Vec2) -> f32 {
        self.terrain.depth.map_or(1.0, |depth| self.level(depth(p)))
    }

    /// In which layers a point lies, as bits from 1 on, or [`OUTSIDE`] of the ground; none on a border of any.
    fn layers(&self, p: Vec2) -> Option<u32> {
        let depth = self.depth(p);
        let (mut layers, mut is_on_border) = (0, depth == 0.0);
        for (layer, number) in self.terrain.layers.iter().zip(1..).filter(|_| depth > 0.0) {
            let outside = self.level((layer.outside)(p));
            is_on_border |= outside == 0.0;
            layers |= u32::from(outside < 0.0) << number;
        }
        let layers = if depth < 0.0 { OUTSIDE } else { layers };
        (!is_on_border).then_some(layers)
    }

    /// Cuts a triangle and hands its pieces on with their regions.
    fn cut(&self, triangle: &[Vec2], mut take: impl FnMut(&[Vec2], usize)) {
        let (inside, _) = split(triangle, &|p| self.depth(p));
        let mut pieces = vec![(inside, 0)];
        for (layer, number) in self.terrain.layers.iter().zip(1..) {
            let outside = |p: Vec2| self.level((layer.outside)(p));
            // What lies below is cut as well, so that neighbours agree wherever layers cross.
            let cut = |(piece, region): (Vec<Vec2>, usize)| {
                let (off, on) = split(&piece, &outside);
                [(off, region), (on, number)]
            };
            pieces = pieces.into_iter().flat_map(cut).collect();
        }
        pieces.iter().for_each(|(piece, region)| take(piece, *region));
    }
}

/// Splits a convex polygon where a value changes its sign: the part where it is not negative, and the other.
fn split(polygon: &[Vec2], value: &impl Fn(Vec2) -> f32) -> (Vec<Vec2>, Vec<Vec2>) {
    let values: Vec<f32> = polygon.iter().map(|p| value(*p)).collect();
    let has = |is_it: fn(f32) -> bool| values.iter().any(|value| is_it(*value));
    // A side that only touches the border has nothing on its other side; at a corner of a bed all of a triangle may touch it.
    let is_inside = match (has(|value| value > 0.0), has(|value| value < 0.0)) {
        (true, true) => None,
        (false, false) => {
            let middle = polygon.iter().sum::<Vec2>() / polygon.len().max(1) as f32;
            Some(value(middle) >= 0.0)
        }
        (is_inside, _) => Some(is_inside),
    };
    match is_inside {
        Some(true) => return (polygon.to_vec(), Vec::new()),
        Some(false) => return (Vec::new(), polygon.to_vec()),
        None => {}
    }
    let (mut inside, mut outside) = (Vec::new(), Vec::new());
    for (k, &a) in polygon.iter().enumerate() {
        let next = (k + 1) % polygon.len();
        let (b, at_a, at_b) = (polygon[next], values[k], values[next]);
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
    use super::*;
    use crate::picture::decode::Rgba;

    fn plan(corners: &[[f32; 2]], paths: Vec<Path>, ground: Ground) -> Plan {
        let area = Area::polygon(corners.iter().copied().map(Vec2::from).collect()).unwrap();
        let variation = Default::default();
        let (beds, kinds) = (Vec::new(), Vec::new());
        let walls = Vec::new();
        Plan { seed: 1, area, density: None, map: None, ground, paths, walls, beds, kinds, variation }
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

    /// The sides of the first bed lie on lines of the grid, as most beds of a garden that is written do; the second is askew.
    #[test]
    fn beds_are_cut_out_of_a_lawn_and_leave_it_closed() {
        let mut plan = plan(&SQUARE, Vec::new(), Ground::default());
        let bed = |corners: [[f32; 2]; 4]| Area::polygon(corners.map(Vec2::from).to_vec()).unwrap();
        plan.beds = vec![
            bed([[-3.0, -2.0], [-1.0, -2.0], [-1.0, 1.0], [-3.0, 1.0]]),
            bed([[1.0, 0.0], [2.5, 0.3], [2.3, 1.9], [0.9, 1.5]]),
        ];
        plan.paths = vec![Path::new(vec![Vec2::new(0.0, -5.0), Vec2::new(0.0, 5.0)], 1.0).unwrap()];
        let (mesh, materials) = slab(&plan, Cover::Lawn).unwrap();
        assert_eq!(mesh.check_invariants(), Ok(()));
        let names: Vec<&str> = materials.iter().map(|material| material.name.as_str()).collect();
        assert_eq!(names, ["lawn", "soil", "gravel"]);
        let [soil, gravel] = [0, 1].map(|k| mesh.breaks[k] as usize);
        let areas = [0..soil, soil..gravel, gravel..mesh.triangles.len()].map(|part| seen(&mesh, part));
        let beds: f32 = plan.beds.iter().map(Area::square_metres).sum();
        assert!((areas[1] - f64::from(beds)).abs() < 0.01 && (areas[2] - 8.0).abs() < 0.01, "{areas:?}");
        assert!((areas.iter().sum::<f64>() - 64.0).abs() < 0.01, "{areas:?}");
        assert_eq!(slab(&plan, Cover::Soil).unwrap().1.len(), 2, "soil in soil is not seen");
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
