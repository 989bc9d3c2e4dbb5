//! The ground of a garden from an OBJ file: its uppermost heights on a grid over the garden's area.
//!
//! Each triangle is seen from above, as a plan is, and every middle of a cell that it covers has the height there; of several the highest
//! counts. Cells outside of the area that nothing covers have the height of the nearest that has one. Metres, y up.
//!
//! Limits: 512 cells along the longer side, between whose middles heights go over linearly; overhangs and caves are not there.

use super::area::Area;
use super::grey_map::GreyMap;
use crate::obj_text::{self, Fault};
use crate::{input, quote};
use glam::{UVec2, Vec2, Vec3};
use std::io;
use std::path::Path;
use thiserror::Error;

/// Largest file that is read, bytes.
pub const MAX_BYTES: u64 = 256 << 20;
/// Cells along the longer side.
const CELLS: f32 = 512.0;
/// Most cells that are looked at for all triangles: many large ones above each other are refused.
const MOST_LOOKS: u64 = 400_000_000;
/// How far outside of a triangle a point may lie, in its own shares: of two neighbours one has each point between them.
const EDGE: f32 = 1e-4;

/// An OBJ file that is no ground.
#[derive(Debug, Error)]
pub enum GroundMeshError {
    /// It cannot be read.
    #[error("it cannot be read: {0}")]
    Unreadable(#[from] io::Error),
    /// A line of it is wrong.
    #[error("line {line}: {reason}")]
    Line {
        /// Its number, from 1.
        line: usize,
        /// What is wrong.
        reason: String,
    },
    /// A place of the area lies beside all of it.
    #[error("it has a hole, or ends, at [{}, {}], which lies in the area; close it there, or make the area smaller", .0.x, .0.y)]
    Hole(Vec2),
    /// Too many large triangles.
    #[error("too many of its triangles lie above each other; leave only the surface of the ground")]
    Crowded,
}

/// The heights of a file over the box of an area, as shares of a range, and the range in metres.
///
/// # Errors
/// [`GroundMeshError`].
pub fn read(path: &Path, area: &Area) -> Result<(GreyMap, [f32; 2]), GroundMeshError> {
    let bytes = input::read(path, MAX_BYTES)?;
    let (meshes, _) = obj_text::read(&bytes)
        .map_err(|Fault { line, reason }| GroundMeshError::Line { line, reason: quote::message(&reason) })?;
    let mut heights = Heights::over(area.bounds());
    let triangles = || meshes.iter().flat_map(triangles_of);
    let looks: u64 = triangles().filter_map(|triangle| heights.cells_in(&triangle)).map(count).sum();
    if looks > MOST_LOOKS {
        return Err(GroundMeshError::Crowded);
    }
    triangles().for_each(|triangle| heights.add(triangle));
    heights.map(area)
}

/// The triangles of a mesh of a file; a corner that does not exist is nowhere.
fn triangles_of(mesh: &tobj::Mesh) -> impl Iterator<Item = [Vec3; 3]> {
    let points = mesh.positions.as_chunks::<3>().0;
    let point = |index: u32| points.get(index as usize).copied().map_or(Vec3::NAN, Vec3::from);
    mesh.indices.as_chunks::<3>().0.iter().map(move |corners| corners.map(point))
}

/// How many cells lie from one to another.
fn count([first, last]: [UVec2; 2]) -> u64 {
    u64::from(last.x - first.x + 1) * u64::from(last.y - first.y + 1)
}

/// Heights on a grid, −∞ where nothing is.
struct Heights {
    low: Vec2,
    cell: Vec2,
    size: UVec2,
    values: Vec<f32>,
}

impl Heights {
    fn over((low, high): (Vec2, Vec2)) -> Self {
        let extent = high - low;
        let size = (extent / extent.max_element() * CELLS).ceil().max(Vec2::ONE).as_uvec2();
        let values = vec![f32::NEG_INFINITY; (size.x * size.y) as usize];
        Self { low, cell: extent / size.as_vec2(), size, values }
    }

    /// The middle of a cell.
    fn middle(&self, cell: UVec2) -> Vec2 {
        self.low + self.cell * (cell.as_vec2() + 0.5)
    }

    /// First and last cell of the box of a triangle, along both axes; none where it lies beside all of them or is none.
    fn cells_in(&self, triangle: &[Vec3; 3]) -> Option<[UVec2; 2]> {
        let [a, b, c] = triangle.map(|p| Vec2::new(p.x, p.z));
        let is_sound = (b - a).perp_dot(c - a).abs() > 0.0 && triangle.iter().all(|p| p.is_finite());
        let cell = |p: Vec2| ((p - self.low) / self.cell - 0.5).clamp(Vec2::splat(-1.0), self.size.as_vec2());
        let (first, last) = (cell(a.min(b).min(c)).ceil(), cell(a.max(b).max(c)).floor());
        let (first, last) = (first.max(Vec2::ZERO), last.min(self.size.as_vec2() - 1.0));
        (is_sound && first.cmple(last).all()).then(|| [first.as_uvec2(), last.as_uvec2()])
    }

    fn add(&mut self, triangle: [Vec3; 3]) {
        let Some([first, last]) = self.cells_in(&triangle) else { return };
        let [a, b, c] = triangle.map(|p| Vec2::new(p.x, p.z));
        let area = (b - a).perp_dot(c - a);
        for z in first.y..=last.y {
            for x in first.x..=last.x {
                let p = self.middle(UVec2::new(x, z));
                let of_b = (p - a).perp_dot(c - a) / area;
                let of_c = (b - a).perp_dot(p - a) / area;
                if of_b >= -EDGE && of_c >= -EDGE && of_b + of_c <= 1.0 + EDGE {
                    let [a, b, c] = triangle.map(|p| p.y);
                    let value = &mut self.values[(z * self.size.x + x) as usize];
                    *value = value.max(a + of_b * (b - a) + of_c * (c - a));
                }
            }
        }
    }

    /// All heights as shares of their range.
    fn map(mut self, area: &Area) -> Result<(GreyMap, [f32; 2]), GroundMeshError> {
        let cells = (0..self.values.len() as u32).map(|k| UVec2::new(k % self.size.x, k / self.size.x));
        for (cell, value) in cells.zip(&self.values) {
            let middle = self.middle(cell);
            if !value.is_finite() && area.contains(middle) {
                return Err(GroundMeshError::Hole(middle));
            }
        }
        self.fill();
        let known = self.values.iter().copied().filter(|value| value.is_finite());
        let [low, high] =
            known.fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], y| [low.min(y), high.max(y)]);
        if low > high {
            return Err(GroundMeshError::Hole(area.middle()));
        }
        let range = (high - low).max(f32::MIN_POSITIVE);
        let values =
            self.values.iter().map(|y| if y.is_finite() { (y - low) / range } else { 0.0 }).collect();
        Ok((GreyMap::of_values(self.size, values), [low, high]))
    }

    /// Gives cells without a height that of the nearest one that has one, from cell to neighbouring cell.
    fn fill(&mut self) {
        let mut edge: Vec<usize> = (0..self.values.len()).filter(|k| self.values[*k].is_finite()).collect();
        while !edge.is_empty() {
            let mut next = Vec::new();
            for k in edge {
                let (x, z) = (k as u32 % self.size.x, k as u32 / self.size.x);
                let around = [(x.wrapping_sub(1), z), (x + 1, z), (x, z.wrapping_sub(1)), (x, z + 1)];
                for (x, z) in around.into_iter().filter(|(x, z)| *x < self.size.x && *z < self.size.y) {
                    let neighbour = (z * self.size.x + x) as usize;
                    if !self.values[neighbour].is_finite() {
                        self.values[neighbour] = self.values[k];
                        next.push(neighbour);
                    }
                }
            }
            edge = next;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::ground::Ground;
    use super::*;

    /// What a text says over an area, or why not.
    fn ground(text: &str, area: &Area) -> Result<Ground, String> {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("hill.obj");
        std::fs::write(&file, text).unwrap();
        let (map, range) = read(&file, area).map_err(|error| error.to_string())?;
        Ok(Ground::of_map(map, range, area.bounds()))
    }

    /// A roof whose ridge runs along z at x = 0, 2 m high over eaves at 0 that are 10 m away.
    const ROOF: &str =
        "v -10 0 -6\nv 0 2 -6\nv 10 0 -6\nv -10 0 6\nv 0 2 6\nv 10 0 6\nf 1 4 5 2\nf 2 5 6 3\n";

    #[test]
    fn heights_are_those_of_the_mesh() {
        let area = Area::rectangle(Vec2::new(16.0, 10.0)).unwrap();
        let roof = ground(ROOF, &area).unwrap();
        for (x, z) in [(-7.5, -4.0), (-3.0, 4.9), (0.0, 0.0), (2.5, 1.0), (7.9, -4.9)] {
            let wanted = 2.0 - 0.2 * f32::abs(x);
            assert!((roof.height(Vec2::new(x, z)) - wanted).abs() < 0.01, "{x} {z}");
        }
        let slope = roof.normal(Vec2::new(4.0, 0.0), 0.5);
        assert!((slope - Vec3::new(0.2, 1.0, 0.0).normalize()).length() < 1e-3, "{slope}");
        // A second floor below changes nothing, a rock above does.
        let with_floor = format!("{ROOF}v -10 -3 -6\nv 10 -3 -6\nv 0 -3 20\nf 7 8 9\n");
        assert_eq!(ground(&with_floor, &area).unwrap().height(Vec2::Y), roof.height(Vec2::Y));
        let with_rock = format!("{ROOF}v -1 5 -1\nv 1 5 -1\nv 0 5 2\nf 7 8 9\n");
        assert!((ground(&with_rock, &area).unwrap().height(Vec2::ZERO) - 5.0).abs() < 1e-4);
    }

    #[test]
    fn a_polygon_needs_ground_only_inside() {
        let corners = [[-4.0, -4.0], [4.0, -4.0], [0.0, 4.0]].map(Vec2::from).to_vec();
        let area = Area::polygon(corners).unwrap();
        let triangle = "v -6 1 -5\nv 6 1 -5\nv 0 1 8\nf 1 2 3\n";
        let level = ground(triangle, &area).unwrap();
        assert!((level.height(Vec2::new(3.9, 3.9)) - 1.0).abs() < 1e-5);
    }

    #[test]
    fn what_is_no_ground_is_refused() {
        let area = Area::rectangle(Vec2::new(30.0, 10.0)).unwrap();
        assert!(ground(ROOF, &area).unwrap_err().contains("hole, or ends, at [-14."));
        assert!(ground("", &area).unwrap_err().contains("hole"));
        assert!(ground("v 0 0 0\nv nan 0 0\nv 1 1 1\nf 1 2 3\n", &area).is_err());
        assert!(ground("v 0 0\nf 1 2 3\n", &area).unwrap_err().contains("line 1"));
        let sheet = "v -99 0 -99\nv 99 0 -99\nv 0 0 199\n";
        let crowd = format!("{sheet}{}", "f 1 2 3\n".repeat(6000));
        assert!(ground(&crowd, &area).unwrap_err().contains("above each other"));
        let missing = read(Path::new("nowhere.obj"), &area).unwrap_err().to_string();
        assert!(missing.contains("cannot be read"), "{missing}");
    }
}
