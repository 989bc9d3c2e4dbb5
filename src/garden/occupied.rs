//! Where plants stand already, and which distances they keep: an index over a garden's places.

use crate::geom::cells::{Grid, Sorted};
use glam::{IVec3, Vec2, Vec3};

/// Plants with the distances that they keep.
pub(super) struct Occupied {
    pub(super) plants: Vec<(Vec2, f32)>,
    widest: f32,
    index: Option<(Grid, Sorted)>,
}

impl Occupied {
    /// Of plants and the distances that they keep, over an area of these bounds.
    pub(super) fn of(plants: Vec<(Vec2, f32)>, (low, high): (Vec2, Vec2)) -> Self {
        let widest = plants.iter().map(|(_, spacing)| *spacing).fold(0.0, f32::max);
        let index = (!plants.is_empty()).then(|| {
            let grid = Grid::new(flat(low), flat(high), widest);
            let cells: Vec<u32> =
                plants.iter().map(|(at, _)| grid.number(grid.place(flat(*at))) as u32).collect();
            let mut sorted = Sorted::default();
            sorted.sort(grid.len(), &cells);
            (grid, sorted)
        });
        Self { plants, widest, index }
    }

    /// Whether a plant that keeps this distance can stand there: it keeps the mean of both distances from each.
    pub(super) fn has_room(&self, at: Vec2, spacing: f32) -> bool {
        self.too_near(at, spacing).next().is_none()
    }

    /// Whether another plant is nearer to that one than the mean of both distances.
    pub(super) fn is_close(&self, plant: usize) -> bool {
        let (at, spacing) = self.plants[plant];
        self.too_near(at, spacing).any(|other| other as usize != plant)
    }

    /// The plants that are nearer to a place than the mean of their distance and that which is kept there.
    fn too_near(&self, at: Vec2, spacing: f32) -> impl Iterator<Item = u32> + '_ {
        self.near(at, 0.5 * (self.widest + spacing)).filter(move |plant| {
            let (there, kept) = self.plants[*plant as usize];
            there.distance(at) < 0.5 * (kept + spacing)
        })
    }

    /// The plants in all cells within this distance of a point, by their index.
    pub(super) fn near(&self, at: Vec2, radius: f32) -> impl Iterator<Item = u32> + '_ {
        let runs = self.index.iter().flat_map(move |(grid, sorted)| {
            let (low, high) = grid.around(flat(at), radius);
            let cell = |x: i32, z: i32| grid.number(IVec3::new(x, 0, z));
            (low.z..=high.z).map(move |z| sorted.run(cell(low.x, z), cell(high.x, z)))
        });
        runs.flatten().copied()
    }
}

fn flat(p: Vec2) -> Vec3 {
    Vec3::new(p.x, 0.0, p.y)
}
