//! A closed triangle mesh as a volume.
//!
//! A point is inside if a ray straight up crosses the surface an odd number of times. Triangles are sorted into
//! columns of a grid over x and z, so a question looks at the triangles of one column. Edges seen from above are
//! crossed or not by one rule that gives the same answer for both triangles of an edge, so no ray slips through a seam.
//!
//! Limits: at most [`MAX_TRIANGLES`] triangles and [`MAX_BYTES`](super::MAX_BYTES) of text, and [`MAX_OVER`] triangles over each other. Where
//! the mesh cuts itself, what is covered twice counts as outside.

use super::mesh_text::{self, MeshError};
use crate::geom::weld::weld;
use glam::{DVec2, Vec3};

/// Most triangles of a volume.
pub(super) const MAX_TRIANGLES: usize = 2_000_000;
/// Most triangles over each other, in the mean of all columns: so many are looked at for each question.
pub(super) const MAX_OVER: usize = 1000;
/// Most entries in all columns together.
const MOST_HELD: usize = 16 << 20;
/// Columns along one side of the grid, at most.
const MAX_COLUMNS: usize = 512;

/// The inside of a closed mesh.
#[derive(Debug)]
pub struct Solid {
    points: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    low: Vec3,
    high: Vec3,
    columns: [usize; 2],
    cell: DVec2,
    starts: Vec<u32>,
    held: Vec<u32>,
    volume: f32,
}

impl Solid {
    /// Reads a volume from the text of an OBJ file; `name` stands for the file in messages.
    ///
    /// # Errors
    /// A text that is no OBJ file, or a mesh that is no volume.
    pub fn from_obj(text: &str, name: &str) -> Result<Self, MeshError> {
        let (points, triangles) = mesh_text::read(text, name)?;
        Self::new(points, triangles, name)
    }

    /// The volume inside a closed mesh; corners at the same place are one.
    ///
    /// # Errors
    /// A mesh that is empty, huge, open, flat or inside out, or with corners that are nowhere.
    pub fn new(points: Vec<Vec3>, triangles: Vec<[u32; 3]>, name: &str) -> Result<Self, MeshError> {
        let owned = || name.to_owned();
        mesh_text::check(&points, &triangles, name, MAX_TRIANGLES)?;
        let (points, triangles) = welded(&points, &triangles);
        check_closed(&points, &triangles, name)?;
        let (low, high) = triangles
            .iter()
            .flatten()
            .map(|&i| points[i as usize])
            .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(lo, hi), p| (lo.min(p), hi.max(p)));
        let volume = volume_of(&points, &triangles, low, high, name)?;
        let mut solid = Self {
            points,
            triangles,
            low,
            high,
            columns: [1, 1],
            cell: DVec2::ONE,
            starts: Vec::new(),
            held: Vec::new(),
            volume,
        };
        solid.sort_into_columns();
        let over = solid.held.len() / (solid.columns[0] * solid.columns[1]);
        if over > MAX_OVER {
            let what = format!("{over} triangles over each other");
            return Err(MeshError::Huge { name: owned(), what, most: MAX_OVER });
        }
        Ok(solid)
    }

    /// Smallest and largest corner.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        (self.low, self.high)
    }

    /// Cubic metres.
    pub fn volume(&self) -> f32 {
        self.volume
    }

    /// Whether a point lies inside.
    pub fn contains(&self, p: Vec3) -> bool {
        if !(p.cmpge(self.low).all() && p.cmple(self.high).all()) {
            return false;
        }
        let [column, row] = self.column_of(p);
        let cell = row * self.columns[0] + column;
        let held = &self.held[self.starts[cell] as usize..self.starts[cell + 1] as usize];
        held.iter().filter(|&&t| self.is_above(t, p)).count() % 2 == 1
    }

    /// Triangles that are asked about one point, at most.
    pub fn triangles_over_a_point(&self) -> u64 {
        self.starts.windows(2).map(|cell| u64::from(cell[1] - cell[0])).max().unwrap_or(0)
    }

    fn corners(&self, triangle: u32) -> [Vec3; 3] {
        self.triangles[triangle as usize].map(|i| self.points[i as usize])
    }

    /// Whether the ray from `p` straight up crosses a triangle.
    fn is_above(&self, triangle: u32, p: Vec3) -> bool {
        let corners = self.corners(triangle);
        let inside = (0..3).filter(|&k| crosses(corners[k], corners[(k + 1) % 3], p)).count() == 1;
        if !inside {
            return false;
        }
        let [a, b, c] = corners.map(Vec3::as_dvec3);
        let normal = (b - a).cross(c - a);
        // The triangle's height over p, without dividing by a normal that may be nearly level.
        let off = normal.dot(p.as_dvec3() - a);
        if normal.y > 0.0 { off < 0.0 } else { off > 0.0 }
    }

    fn column_of(&self, p: Vec3) -> [usize; 2] {
        let at = |x: f32, low: f32, cell: f64, count: usize| {
            ((f64::from(x - low) / cell).max(0.0) as usize).min(count - 1)
        };
        [at(p.x, self.low.x, self.cell.x, self.columns[0]), at(p.z, self.low.z, self.cell.y, self.columns[1])]
    }

    /// Divides the grid into `side` columns along each side and gives the first and last column of every triangle.
    fn spans(&mut self, side: usize) -> Vec<[[usize; 2]; 2]> {
        self.columns = [side, side];
        let size = self.high - self.low;
        self.cell = DVec2::new(f64::from(size.x), f64::from(size.z)) / side as f64;
        let span = |t: u32| {
            let [a, b, c] = self.corners(t);
            [self.column_of(a.min(b).min(c)), self.column_of(a.max(b).max(c))]
        };
        (0..self.triangles.len() as u32).map(span).collect()
    }

    fn sort_into_columns(&mut self) {
        let mut side = ((self.triangles.len() as f32).sqrt().ceil() as usize).clamp(1, MAX_COLUMNS);
        let mut spans = self.spans(side);
        let entries = |spans: &[[[usize; 2]; 2]]| -> usize {
            spans.iter().map(|[[x0, z0], [x1, z1]]| (x1 - x0 + 1) * (z1 - z0 + 1)).sum()
        };
        // Many large triangles over each other fill all columns.
        while side > 1 && entries(&spans) > MOST_HELD {
            side /= 2;
            spans = self.spans(side);
        }
        let cells = |span: &[[usize; 2]; 2]| {
            let [[x0, z0], [x1, z1]] = *span;
            (z0..=z1).flat_map(move |z| (x0..=x1).map(move |x| z * side + x))
        };
        let mut starts = vec![0u32; side * side + 1];
        spans.iter().flat_map(cells).for_each(|c| starts[c + 1] += 1);
        (0..side * side).for_each(|c| starts[c + 1] += starts[c]);
        let mut next = starts.clone();
        let mut held = vec![0; starts[side * side] as usize];
        for (t, span) in spans.iter().enumerate() {
            for c in cells(span) {
                held[next[c] as usize] = t as u32;
                next[c] += 1;
            }
        }
        (self.starts, self.held) = (starts, held);
    }
}

/// Whether, seen from above, the edge crosses the level ray from `p` toward +x. The answer does not depend on the
/// direction of the edge.
fn crosses(a: Vec3, b: Vec3, p: Vec3) -> bool {
    let (a, b) = if (a.z, a.x) <= (b.z, b.x) { (a, b) } else { (b, a) };
    if (a.z > p.z) == (b.z > p.z) {
        return false;
    }
    let (ax, az) = (f64::from(a.x), f64::from(a.z));
    let share = (f64::from(p.z) - az) / (f64::from(b.z) - az);
    f64::from(p.x) < ax + (f64::from(b.x) - ax) * share
}

/// Makes corners at the same place one and leaves out faces that thereby lose their area.
fn welded(points: &[Vec3], triangles: &[[u32; 3]]) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let (kept, one) = weld(points);
    let faces = triangles.iter().map(|t| t.map(|i| one[i as usize]));
    (kept, faces.filter(|[a, b, c]| a != b && b != c && c != a).collect())
}

/// Every edge must be walked as often in one direction as in the other.
fn check_closed(points: &[Vec3], triangles: &[[u32; 3]], name: &str) -> Result<(), MeshError> {
    let mut edges: Vec<(u32, u32, i8)> = Vec::with_capacity(triangles.len() * 3);
    for &[a, b, c] in triangles {
        edges.extend([(a, b), (b, c), (c, a)].map(|(i, k)| if i < k { (i, k, 1) } else { (k, i, -1) }));
    }
    edges.sort_unstable();
    let mut open = edges
        .chunk_by(|a, b| (a.0, a.1) == (b.0, b.1))
        .filter(|same| same.iter().map(|e| i32::from(e.2)).sum::<i32>() != 0);
    let Some(first) = open.next() else { return Ok(()) };
    let Vec3 { x, y, z } = points[first[0].0 as usize];
    Err(MeshError::Open { name: name.to_owned(), edges: 1 + open.count(), x, y, z })
}

/// The signed volume, which must be positive and more than a film.
fn volume_of(
    points: &[Vec3],
    triangles: &[[u32; 3]],
    low: Vec3,
    high: Vec3,
    name: &str,
) -> Result<f32, MeshError> {
    let middle = low.midpoint(high).as_dvec3();
    let six = triangles.iter().map(|t| {
        let [a, b, c] = t.map(|i| points[i as usize].as_dvec3() - middle);
        a.dot(b.cross(c))
    });
    let volume = six.sum::<f64>() / 6.0;
    let room = (high - low).as_dvec3().max_element().powi(3);
    let fault = |what, remedy| Err(MeshError::NoVolume { name: name.to_owned(), what, remedy });
    if volume.abs() <= room * 1e-9 {
        return fault("encloses nothing", "give it a thickness");
    }
    if volume < 0.0 {
        return fault("is inside out: its faces turn clockwise seen from outside", "flip its normals");
    }
    Ok(volume as f32)
}

#[cfg(test)]
#[path = "solid_tests.rs"]
pub(crate) mod tests;
