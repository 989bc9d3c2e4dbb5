//! Obstacles from a few sizes: a wall, or any other block, and a trellis of crossing slats.
//!
//! Both stand on the ground with their middle over the origin, as wide as x, as high as y, as deep as z.

use super::obstacles::Obstacles;
use glam::Vec3;

/// The triangles of a block by its corners; corner k is high along x, y, z where the bits 1, 2, 4 of k are set.
const FACES: [[u32; 3]; 12] = [
    [0, 2, 1],
    [1, 2, 3],
    [4, 5, 6],
    [5, 7, 6],
    [0, 1, 4],
    [1, 5, 4],
    [2, 6, 3],
    [3, 6, 7],
    [0, 4, 2],
    [2, 4, 6],
    [1, 3, 5],
    [3, 7, 5],
];
/// Between the middles of two slats, metres, about.
const MESH: f32 = 0.3;
/// How wide and how deep a slat is, metres.
const SLAT: f32 = 0.03;

impl Obstacles {
    /// A block of a width, height and depth in metres.
    pub fn wall(size: Vec3) -> Self {
        let mut blocks = Blocks::default();
        let half = Vec3::new(0.5 * size.x, 0.0, 0.5 * size.z);
        blocks.add(-half, half.with_y(size.y));
        blocks.finished()
    }

    /// A trellis of a width and height in metres: upright slats, and level ones before them.
    pub fn trellis(width: f32, height: f32) -> Self {
        let mut blocks = Blocks::default();
        let slat = SLAT.min(0.2 * width).min(0.2 * height);
        let steps = |length: f32| ((length - slat) / MESH).round().max(1.0) as u32;
        let (across, up) = (steps(width), steps(height));
        let middle = |k: u32, of: u32, length: f32| 0.5 * slat + (length - slat) * (k as f32 / of as f32);
        for k in 0..=across {
            let x = middle(k, across, width) - 0.5 * width;
            blocks.add(Vec3::new(x - 0.5 * slat, 0.0, -slat), Vec3::new(x + 0.5 * slat, height, 0.0));
        }
        for k in 1..=up {
            let y = middle(k, up, height);
            let half = 0.5 * Vec3::new(width, slat, 0.0);
            let at = Vec3::Y * y;
            blocks.add(at - half, at + half + Vec3::Z * slat);
        }
        blocks.finished()
    }
}

/// Blocks that together are one obstacle.
#[derive(Default)]
struct Blocks {
    points: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

impl Blocks {
    fn add(&mut self, low: Vec3, high: Vec3) {
        let first = self.points.len() as u32;
        let corner = |k: u32| {
            let pick = |bit: u32, low: f32, high: f32| if k & bit == 0 { low } else { high };
            Vec3::new(pick(1, low.x, high.x), pick(2, low.y, high.y), pick(4, low.z, high.z))
        };
        self.points.extend((0..8).map(corner));
        self.triangles.extend(FACES.map(|face| face.map(|k| first + k)));
    }

    fn finished(self) -> Obstacles {
        Obstacles::of(self.points, self.triangles)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::growth::volume::Solid;

    #[test]
    fn a_wall_is_a_closed_block_with_its_faces_outward() {
        let wall = Obstacles::wall(Vec3::new(2.0, 3.0, 0.5));
        let (points, triangles) = wall.mesh();
        let solid = Solid::new(points.to_vec(), triangles.to_vec(), "wall").unwrap();
        assert!((solid.volume() - 3.0).abs() < 1e-5);
        assert_eq!(solid.bounds(), (Vec3::new(-1.0, 0.0, -0.25), Vec3::new(1.0, 3.0, 0.25)));
    }

    #[test]
    fn a_trellis_has_gaps_that_wood_passes_and_slats_that_it_does_not() {
        let trellis = Obstacles::trellis(1.5, 2.0);
        let (low, high) = trellis.bounds();
        assert!(
            low.abs_diff_eq(Vec3::new(-0.75, 0.0, -SLAT), 1e-5)
                && high.abs_diff_eq(Vec3::new(0.75, 2.0, SLAT), 1e-5)
        );
        let through = |x: f32, y: f32| trellis.lets_pass(Vec3::new(x, y, 1.0), Vec3::new(x, y, -1.0), 0.0);
        assert!(through(0.0, 0.5) && !through(-0.73, 0.5));
        assert!(Obstacles::trellis(0.05, 0.05).bounds().1.y <= 0.05 + 1e-6);
    }
}
