//! The surfaces of all that stands beside a plant, and questions to them: the nearest place, whether a way is free, where
//! shadow comes from.
//!
//! Surfaces may be open, and one sheet is as good as a solid wall: no way passes through a face, so wood stays on the side
//! on which it began.
//!
//! Limits: at most [`MAX_TRIANGLES`] triangles of each file. Internodes pass nothing; thick wood that is rounded afterwards may
//! touch. What begins inside of a closed body stays inside. The thesis has no obstacles; the shadow is that of eq. 2.2, cast by
//! places on the surface as by nodes.

use crate::geom::face_tree::FaceTree;
use crate::growth::volume::mesh_text::{self, MeshError};
use glam::{IVec3, Vec3};
use std::collections::BTreeSet;

/// Most triangles of one file.
const MAX_TRIANGLES: usize = 500_000;
/// Most places that cast shadows.
const MOST_SHADING: f32 = 60_000.0;
/// Most pieces of faces that are looked at for them: slivers, of which nobody models many.
const MOST_PIECES: usize = 4_000_000;
/// Questions to the tree of faces that are as much work as one look at a triangle of a volume's column.
const STEPS: u64 = 40;

/// Surfaces beside a plant.
#[derive(Clone, Debug)]
pub struct Obstacles {
    points: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    faces: FaceTree,
    bounds: (Vec3, Vec3),
}

/// The place of a surface that is nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// How far it is, metres.
    pub distance: f32,
    /// Unit vector from there to the point; where the point lies on the surface, the surface's normal.
    pub away: Vec3,
}

/// Those with the same triangles are the same.
impl PartialEq for Obstacles {
    fn eq(&self, other: &Self) -> bool {
        (&self.points, &self.triangles) == (&other.points, &other.triangles)
    }
}

impl Obstacles {
    /// Obstacles with these triangles; `name` stands for them in messages.
    ///
    /// # Errors
    /// There is no triangle, there are more than anybody needs, or one has a corner that is nowhere.
    pub fn new(points: Vec<Vec3>, triangles: Vec<[u32; 3]>, name: &str) -> Result<Self, MeshError> {
        mesh_text::check(&points, &triangles, name, MAX_TRIANGLES)?;
        Ok(Self::of(points, triangles))
    }

    /// Obstacles with triangles whose corners are known to be somewhere.
    pub(super) fn of(points: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Self {
        let corners = |t: &[u32; 3]| t.map(|i| points[i as usize]);
        let has_area = |[a, b, c]: &[Vec3; 3]| (*b - *a).cross(*c - *a) != Vec3::ZERO;
        let faces = FaceTree::new(triangles.iter().map(corners).filter(has_area));
        let used = triangles.iter().flatten().map(|i| points[*i as usize]);
        let bounds =
            used.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        Self { points, triangles, faces, bounds }
    }

    /// The faces of an OBJ file, open or closed, in metres, y up; `name` stands for the file in messages.
    ///
    /// # Errors
    /// A text that is no OBJ file, and what [`Obstacles::new`] refuses.
    pub fn from_obj(text: &str, name: &str) -> Result<Self, MeshError> {
        let (points, triangles) = mesh_text::read(text, name)?;
        Self::new(points, triangles, name)
    }

    /// These and others as one.
    #[must_use]
    pub fn and(&self, other: &Self) -> Self {
        let first = self.points.len() as u32;
        let moved = other.triangles.iter().map(|t| t.map(|i| i + first));
        let points = self.points.iter().chain(&other.points).copied().collect();
        Self::of(points, self.triangles.iter().copied().chain(moved).collect())
    }

    /// The same at another place.
    #[must_use]
    pub fn moved(mut self, by: Vec3) -> Self {
        self.points.iter_mut().for_each(|p| *p += by);
        Self::of(self.points, self.triangles)
    }

    /// Corners and triangles.
    pub fn mesh(&self) -> (&[Vec3], &[[u32; 3]]) {
        (&self.points, &self.triangles)
    }

    /// Smallest and largest corner, metres.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        self.bounds
    }

    /// The nearest place of all surfaces.
    pub fn contact(&self, p: Vec3) -> Option<Contact> {
        let (at, [a, b, c]) = self.faces.nearest(p)?;
        let normal = || (b - a).cross(c - a).normalize_or(Vec3::Y);
        let away = (p - at).try_normalize().unwrap_or_else(normal);
        Some(Contact { distance: p.distance(at), away })
    }

    /// Whether the straight way between two places passes through a surface.
    pub fn crosses(&self, from: Vec3, to: Vec3) -> bool {
        self.faces.crosses(from, to)
    }

    /// Whether a place is nearer to a surface than `distance` metres.
    pub fn is_within(&self, distance: f32, p: Vec3) -> bool {
        let (low, high) = self.bounds;
        let beside = p.cmpge(low - distance).all() && p.cmple(high + distance).all();
        beside && self.contact(p).is_some_and(|contact| contact.distance < distance)
    }

    /// Whether wood may go straight from one place to another: through nothing, and nowhere nearer to a surface than
    /// `clearance` metres but where it comes from nearer still.
    pub fn lets_pass(&self, from: Vec3, to: Vec3, clearance: f32) -> bool {
        if self.crosses(from, to) {
            return false;
        }
        let distance = |p| self.contact(p).map_or(f32::INFINITY, |contact| contact.distance);
        let after = distance(to);
        after >= clearance || after >= distance(from)
    }

    /// Elementary steps that the questions for one internode take, about.
    pub fn steps(&self) -> u64 {
        STEPS * u64::from(self.triangles.len().max(2).ilog2())
    }

    /// Places on the surfaces from which shadow is cast, one in each voxel of this width, metres; wider voxels where there would be too
    /// many places, and only those less than `reach` metres from the origin over the ground.
    pub fn shading(&self, voxel: f32, reach: f32) -> Vec<Vec3> {
        let faces: Vec<[Vec3; 3]> =
            self.triangles.iter().map(|t| t.map(|i| self.points[i as usize])).collect();
        let area = |[a, b, c]: &[Vec3; 3]| 0.5 * (*b - *a).cross(*c - *a).length();
        let near = faces.iter().filter(|face| is_near(face, reach));
        let voxel = voxel.max((near.map(area).sum::<f32>() / MOST_SHADING).sqrt());
        let mut taken = BTreeSet::new();
        let mut pieces = faces;
        for _ in 0..MOST_PIECES {
            let Some([a, b, c]) = pieces.pop() else { break };
            if !is_near(&[a, b, c], reach) {
                continue;
            }
            // The longest edge is halved until a piece is as small as a voxel.
            let edges = [(a, b, c), (b, c, a), (c, a, b)];
            let longest = edges.into_iter().max_by(|x, y| x.0.distance(x.1).total_cmp(&y.0.distance(y.1)));
            let Some((from, to, aside)) = longest.filter(|(from, to, _)| from.distance(*to) > voxel) else {
                let middle = (a + b + c) / 3.0;
                taken.insert((middle / voxel).floor().as_ivec3().to_array());
                continue;
            };
            let middle = from.midpoint(to);
            pieces.extend([[from, middle, aside], [middle, to, aside]]);
        }
        let middle = |place: [i32; 3]| (IVec3::from_array(place).as_vec3() + 0.5) * voxel;
        taken.into_iter().take(MOST_SHADING as usize).map(middle).collect()
    }
}

/// Whether a face may come less than `reach` metres from the origin over the ground.
fn is_near([a, b, c]: &[Vec3; 3], reach: f32) -> bool {
    let (low, high) = (a.min(*b).min(*c), a.max(*b).max(*c));
    low.x < reach && low.z < reach && high.x > -reach && high.z > -reach
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wall() -> Obstacles {
        Obstacles::wall(Vec3::new(4.0, 2.0, 0.2)).moved(Vec3::Z * -1.0)
    }

    #[test]
    fn the_nearest_place_of_a_wall_is_straight_behind() {
        let contact = wall().contact(Vec3::new(0.5, 1.0, 0.0)).unwrap();
        assert!((contact.distance - 0.9).abs() < 1e-5 && contact.away.abs_diff_eq(Vec3::Z, 1e-5));
        let on_it = wall().contact(Vec3::new(0.5, 1.0, -0.9)).unwrap();
        assert!(on_it.distance < 1e-5 && on_it.away.z.abs() > 0.99);
        assert_eq!(wall().bounds(), (Vec3::new(-2.0, 0.0, -1.1), Vec3::new(2.0, 2.0, -0.9)));
    }

    #[test]
    fn nothing_passes_a_wall_or_comes_too_near() {
        let wall = wall();
        let passes = |from: [f32; 3], to: [f32; 3]| wall.lets_pass(from.into(), to.into(), 0.1);
        assert!(!passes([0.0, 1.0, 0.0], [0.0, 1.0, -2.0]));
        assert!(passes([0.0, 2.5, 0.0], [0.0, 2.5, -2.0]), "over it");
        assert!(passes([2.5, 1.0, 0.0], [2.5, 1.0, -2.0]), "past it");
        assert!(!passes([0.0, 1.0, -0.5], [0.0, 1.0, -0.85]), "too near");
        assert!(passes([0.0, 1.0, -0.84], [0.0, 1.0, -0.82]), "it leads away");
    }

    #[test]
    fn every_voxel_of_a_surface_near_by_casts_shadow_once() {
        let shading = wall().shading(0.25, 20.0);
        // Both faces of 4 × 2 m and the narrow ones around them.
        assert!((2 * 16 * 8..=2 * 18 * 10).contains(&shading.len()), "{}", shading.len());
        let mut cells: Vec<[i32; 3]> =
            shading.iter().map(|p| (*p / 0.25).floor().as_ivec3().to_array()).collect();
        cells.dedup();
        assert_eq!(cells.len(), shading.len());
        assert!(wall().shading(0.25, 0.5).is_empty(), "it stands too far away");
        let vast = Obstacles::wall(Vec3::new(900.0, 900.0, 1.0)).shading(0.01, 1e4);
        assert!((10_000..=60_000).contains(&vast.len()), "{}", vast.len());
        let sliver = vec![Vec3::ZERO, Vec3::X * 20.0, Vec3::new(10.0, 1e-4, 0.0)];
        let sliver = Obstacles::new(sliver, vec![[0, 1, 2]], "sliver").unwrap().shading(0.25, 50.0);
        assert!((80..=84).contains(&sliver.len()), "{}", sliver.len());
    }

    #[test]
    fn faulty_meshes_are_refused() {
        let fault = |text: &str| Obstacles::from_obj(text, "wall.obj").unwrap_err().to_string();
        assert!(fault("").contains("wall.obj: there is no face in it"));
        assert!(fault("v 0 0 0\nf 1 2 3\n").contains("line 2"));
        assert!(fault("v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n").contains("wall.obj"));
        let one = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        assert!(Obstacles::from_obj(one, "one").unwrap().contact(Vec3::Z).is_some(), "it may be open");
    }
}
