//! Walls that stand in a garden, built along lines or read from OBJ files, and the feet of what climbs on them.
//!
//! A wall along a line is a body with a coping on it, mitred at corners, that follows the ground in pieces of half a metre. One from a
//! file is as it is there, in the garden's own coordinates.
//!
//! Limits: walls along lines have no openings, and one that crosses itself passes through itself; plants that are spread keep clear of walls
//! along lines alone.

use super::area::{self, Path};
use super::ground::Ground;
use crate::geom::polyline;
use crate::growth::{MeshError, Obstacles};
use crate::input;
use crate::model::Mesh;
use crate::plant::Material;
use glam::{Vec2, Vec3};
use serde::{Deserialize, Deserializer};
use std::io;
use std::path::{Path as FilePath, PathBuf};
use std::sync::Arc;
use thiserror::Error;

/// Largest file of a wall that is read, bytes.
const MAX_BYTES: u64 = 64 << 20;
/// How far a wall reaches into the ground, metres.
const SUNK: f32 = 0.05;
/// Longest piece of a wall that is straight, metres.
const PIECE: f32 = 0.5;
/// Most pieces of a wall.
const MOST_PIECES: f32 = 10_000.0;
/// How thick a coping is, and how far it stands out on both sides, metres.
const COPING: (f32, f32) = (0.06, 0.035);
/// How much wider a corner may become where its sides meet at an acute angle.
const WIDEST_CORNER: f32 = 3.0;
/// Distance of what climbs from the face of its wall, metres.
const BEFORE: f32 = 0.1;

crate::parameters! {
    /// A wall as it is written.
    pub struct WallSpec {
        /// How high it is.
        height: f32 = 2.0, 0.05..=100.0, "metres";
        /// How thick it is.
        thickness: f32 = 0.24, 0.02..=10.0, "metres";
        others:
        /// What plants call it.
        name: String = String::new();
        /// Its middle on the ground.
        line: Vec<Vec2> = Vec::new(), checked_line;
        /// OBJ file of its surface, instead of a line.
        mesh: Option<String> = None;
    }
}

fn checked_line<'de, D: Deserializer<'de>>(source: D) -> Result<Vec<Vec2>, D::Error> {
    let line = Vec::<Vec2>::deserialize(source)?;
    area::check_line(&line, "a wall").map_err(serde::de::Error::custom)?;
    Ok(line)
}

/// A wall that cannot be built.
#[derive(Debug, Error)]
pub enum WallError {
    /// Plants could not say which they climb on.
    #[error("it has no name; give it one, as name = \"south\"")]
    NoName,
    /// Nothing, or too much, says what it is like.
    #[error("give one of `line`, points of its middle on the ground, and `mesh`, an OBJ file")]
    NoShape,
    /// Its line leads nowhere.
    #[error("all points of its line are the same; give at least two that differ")]
    NoLength,
    /// Its file cannot be read.
    #[error("{}: cannot be read: {source}", .file.display())]
    Unreadable {
        /// The file.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// Its file is no surface.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

/// A wall that stands in a garden.
#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    /// What plants call it.
    pub name: String,
    /// Where it stands, as wide as it is thick; none of a wall from a file.
    pub line: Option<Path>,
    /// What grows meets this.
    pub obstacles: Arc<Obstacles>,
    /// Its surface, and that of its coping if it has one.
    pub surfaces: Vec<Mesh>,
}

/// Linear colours of plaster and of the coping on it.
const PLASTER: [f32; 3] = [0.5, 0.45, 0.36];
const TILES: [f32; 3] = [0.28, 0.11, 0.06];

/// The materials of a wall and of its coping.
pub(super) fn materials() -> [Material; 2] {
    let wall = Material { double_sided: true, ..Material::plain("wall", PLASTER) };
    [wall, Material::plain("coping", TILES)]
}

impl WallSpec {
    /// The wall on its ground.
    ///
    /// # Errors
    /// [`WallError`].
    pub fn built(&self, ground: &Ground, folder: &FilePath) -> Result<Wall, WallError> {
        if self.name.is_empty() {
            return Err(WallError::NoName);
        }
        match (&self.line[..], &self.mesh) {
            ([], Some(file)) => self.read(&folder.join(file)),
            ([], None) | ([_, ..], Some(_)) => Err(WallError::NoShape),
            (line, None) if polyline::length(line) <= 0.0 => Err(WallError::NoLength),
            (line, None) => {
                let path = Path::new(line.to_vec(), self.thickness).map_err(|_| WallError::NoShape)?;
                let (half, top) = (0.5 * self.thickness, self.height);
                let line = pieces(line);
                let body = prism(&line, half, (-SUNK, top), ground);
                // It holds the top of the body within.
                let coping =
                    prism(&line, half + COPING.1, (top - 0.2 * COPING.0, top + 0.8 * COPING.0), ground);
                let meshes = [body, coping];
                let all = meshes
                    .iter()
                    .map(|(points, triangles)| Obstacles::new(points.clone(), triangles.clone(), &self.name));
                let all = all.collect::<Result<Vec<_>, _>>()?;
                let obstacles = Arc::new(all[0].and(&all[1]));
                let surfaces = meshes.iter().map(|(points, triangles)| Mesh::faceted(points, triangles));
                Ok(Wall {
                    name: self.name.clone(),
                    line: Some(path),
                    obstacles,
                    surfaces: surfaces.collect(),
                })
            }
        }
    }

    fn read(&self, file: &FilePath) -> Result<Wall, WallError> {
        let unreadable = |source| WallError::Unreadable { file: file.to_owned(), source };
        let bytes = input::read(file, MAX_BYTES).map_err(unreadable)?;
        let name = file.display().to_string();
        let obstacles = Obstacles::from_obj(&String::from_utf8_lossy(&bytes), &name)?;
        let (points, triangles) = obstacles.mesh();
        let surfaces = vec![Mesh::faceted(points, triangles)];
        Ok(Wall { name: self.name.clone(), line: None, surfaces, obstacles: Arc::new(obstacles) })
    }
}

impl Wall {
    /// Where plants stand that climb on both its faces, so far apart; none of a wall from a file.
    pub fn feet(&self, spacing: f32) -> Vec<Vec2> {
        let Some(path) = &self.line else { return Vec::new() };
        let aside = path.half_width() + BEFORE;
        let beside = |side: f32| {
            let line: Vec<Vec2> = path.points().to_vec();
            let moved = sides(&line).into_iter().zip(&line).map(|(aside, point)| point + aside * side);
            inner(&polyline::spaced(&moved.collect::<Vec<_>>(), spacing))
        };
        [aside, -aside].into_iter().flat_map(beside).collect()
    }
}

/// What the plants of a kind have beside them that climb on a wall.
#[derive(Clone, Debug)]
pub struct BeforeWall {
    /// The wall in the garden.
    pub obstacles: Arc<Obstacles>,
    /// Where each of them grows, metres.
    pub feet: Vec<Vec3>,
}

impl BeforeWall {
    /// The wall as the plant of a number has it beside it, which grows at the origin.
    pub fn seen_from(&self, number: u32) -> Option<Arc<Obstacles>> {
        let foot = self.feet.get(number as usize)?;
        Some(Arc::new(Obstacles::clone(&self.obstacles).moved(-*foot)))
    }
}

/// Points halfway between others: what climbs does not stand at the very ends of its wall.
fn inner(points: &[Vec2]) -> Vec<Vec2> {
    if points.len() < 2 {
        return points.to_vec();
    }
    points.windows(2).map(|two| two[0].midpoint(two[1])).collect()
}

/// A line in pieces that are short enough to follow the ground; its corners stay.
fn pieces(line: &[Vec2]) -> Vec<Vec2> {
    let longest = PIECE.max(polyline::length(line) / MOST_PIECES);
    let mut points = vec![line[0]];
    for two in line.windows(2) {
        let count = (two[0].distance(two[1]) / longest).ceil().max(1.0) as u32;
        points.extend((1..=count).map(|k| two[0].lerp(two[1], k as f32 / count as f32)));
    }
    points
}

/// The vector to the left of a line at each of its points that leads a metre away from the line on both sides of a corner.
fn sides(line: &[Vec2]) -> Vec<Vec2> {
    let of_edge = |k: usize| (line[k + 1] - line[k]).normalize_or_zero().perp();
    let last = line.len() - 2;
    let is_closed = line.first() == line.last();
    let side = |k: usize| {
        let (before, after) = match k {
            0 if !is_closed => (of_edge(0), of_edge(0)),
            0 => (of_edge(last), of_edge(0)),
            k if k > last && !is_closed => (of_edge(last), of_edge(last)),
            k if k > last => (of_edge(last), of_edge(0)),
            k => (of_edge(k - 1), of_edge(k)),
        };
        ((before + after) / (1.0 + before.dot(after)).max(0.1)).clamp_length_max(WIDEST_CORNER)
    };
    (0..line.len()).map(side).collect()
}

/// A closed body along a line, from and to so many metres above the ground.
fn prism(
    line: &[Vec2],
    half_width: f32,
    (low, high): (f32, f32),
    ground: &Ground,
) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let is_closed = line.first() == line.last();
    let sides = sides(line);
    let rings = line.len() - usize::from(is_closed);
    let ring = |k: usize| {
        let corner = |side: f32, above: f32| {
            let at = line[k] + sides[k] * (side * half_width);
            Vec3::new(at.x, ground.height(line[k]) + above, at.y)
        };
        [corner(1.0, low), corner(-1.0, low), corner(-1.0, high), corner(1.0, high)]
    };
    let points: Vec<Vec3> = (0..rings).flat_map(ring).collect();
    let mut triangles = Vec::new();
    let mut quad = |[a, b, c, d]: [usize; 4]| {
        triangles.extend([[a, b, c], [a, c, d]].map(|t| t.map(|i| i as u32)));
    };
    for k in 0..line.len() - 1 {
        let (here, next) = (4 * k, 4 * ((k + 1) % rings));
        (0..4).for_each(|i| quad([here + i, here + (i + 1) % 4, next + (i + 1) % 4, next + i]));
    }
    if !is_closed {
        let last = 4 * (rings - 1);
        quad([3, 2, 1, 0]);
        quad([last, last + 1, last + 2, last + 3]);
    }
    (points, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::quality::{Attributes, judge};

    fn wall(line: &[(f32, f32)]) -> Wall {
        let line = line.iter().map(|&at| at.into()).collect();
        let spec = WallSpec { name: "south".into(), line, ..WallSpec::default() };
        spec.built(&Ground::default(), FilePath::new("")).unwrap()
    }

    fn volume(mesh: &Mesh) -> f32 {
        let six_times = |triangle: &[u32; 3]| {
            let [a, b, c] = mesh.corners(*triangle);
            a.dot(b.cross(c))
        };
        mesh.triangles.iter().map(six_times).sum::<f32>() / 6.0
    }

    #[test]
    fn walls_are_closed_and_as_large_as_written() {
        let square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0), (0.0, 0.0)];
        for (line, length) in [(&square[..2], 4.0), (&square[..3], 8.0), (&square[..], 16.0)] {
            let Wall { surfaces, .. } = wall(line);
            assert!((volume(&surfaces[0]) - length * 0.24 * 2.05).abs() < 1e-2, "{length}");
            for mesh in &surfaces {
                let report = judge(mesh, Attributes { normals: true, uvs: false });
                assert!(report.is_clean() && volume(mesh) > 0.0, "{:?}", report.defects());
            }
        }
    }

    #[test]
    fn what_climbs_stands_before_both_faces() {
        let feet = wall(&[(-2.0, 1.0), (2.0, 1.0)]).feet(1.0);
        assert_eq!(feet.len(), 8);
        for foot in feet {
            assert!(((foot.y - 1.0).abs() - 0.22).abs() < 1e-5 && foot.x.abs() < 1.6, "{foot}");
        }
    }

    #[test]
    fn walls_that_cannot_be_are_refused_with_the_remedy() {
        let fault = |text: &str, ground: &Ground| {
            let spec: WallSpec = toml::from_str(text).unwrap();
            spec.built(ground, FilePath::new("nowhere")).unwrap_err().to_string()
        };
        let level = &Ground::default();
        assert!(fault("line = [[0, 0], [1, 0]]", level).contains("name = \"south\""));
        assert!(fault("name = \"a\"", level).contains("give one of `line`"));
        assert!(
            fault("name = \"a\"\nmesh = \"a.obj\"\nline = [[0, 0], [1, 0]]", level).contains("give one of")
        );
        assert!(fault("name = \"a\"\nline = [[1, 2], [1, 2]]", level).contains("two that differ"));
        assert!(fault("name = \"a\"\nmesh = \"a.obj\"", level).contains("a.obj: cannot be read"));
        assert!(toml::from_str::<WallSpec>("line = [[0, 0]]").is_err());
        assert!(toml::from_str::<WallSpec>("height = 0").unwrap_err().to_string().contains("0.05 to 100"));
    }
}
