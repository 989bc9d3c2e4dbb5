//! An obstacle from parameters: a wall or a trellis behind the foot of a plant.

use super::obstacles::Obstacles;
use glam::Vec3;
use std::sync::Arc;

crate::parameter_choice! {
    /// What stands beside a plant.
    pub enum ObstacleKind {
        /// Nothing.
        Nothing = "nothing",
        /// A wall.
        Wall = "wall",
        /// A trellis of crossing slats.
        Trellis = "trellis",
    }
}

crate::parameters! {
    /// What stands behind a plant.
    pub struct ObstacleParams {
        /// Width of the wall or trellis.
        width: f32 = 2.0, 0.1..=50.0, "metres";
        /// Height of the wall or trellis.
        height: f32 = 2.0, 0.1..=50.0, "metres";
        /// Depth of the wall.
        depth: f32 = 0.2, 0.01..=20.0, "metres";
        /// Distance of its front behind the foot of the plant; below 0 before it.
        behind: f32 = 0.25, -50.0..=50.0, "metres";
        /// Distance of its middle to the right of the foot.
        aside: f32 = 0.0, -50.0..=50.0, "metres";
        choices:
        /// What stands behind the plant: nothing, a wall or a trellis. Wood grows around it, and climbing species up it.
        kind: ObstacleKind = ObstacleKind::Nothing;
    }
}

impl ObstacleParams {
    /// The obstacle of a plant whose foot stands there, metres; none where nothing is asked for.
    pub fn beside(&self, foot: Vec3) -> Option<Arc<Obstacles>> {
        let &Self { width, height, depth, behind, aside, kind } = self;
        // Their fronts are level with their middle after this.
        let (stands, front) = match kind {
            ObstacleKind::Nothing => return None,
            ObstacleKind::Wall => (Obstacles::wall(Vec3::new(width, height, depth)), 0.5 * depth),
            ObstacleKind::Trellis => (Obstacles::trellis(width, height), 0.0),
        };
        let place = Vec3::new(foot.x + aside, 0.0, foot.z - behind - front);
        Some(Arc::new(stands.moved(place)))
    }
}

/// What stood behind a plant when it was built last, kept because its faces are sorted into a tree.
#[derive(Debug, Default)]
pub struct KeptObstacles {
    last: Option<(ObstacleParams, Vec3, Option<Arc<Obstacles>>)>,
}

impl KeptObstacles {
    /// What stands behind a foot.
    pub fn beside(&mut self, params: &ObstacleParams, foot: Vec3) -> Option<Arc<Obstacles>> {
        let known = self.last.take().filter(|(of, at, _)| (of, at) == (params, &foot));
        let made = || (params.clone(), foot, params.beside(foot));
        self.last.insert(known.unwrap_or_else(made)).2.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_stands_where_it_is_wanted_behind_a_foot() {
        let wall = ObstacleParams { kind: ObstacleKind::Wall, aside: 1.0, ..ObstacleParams::default() };
        let (low, high) = wall.beside(Vec3::new(3.0, 0.1, 0.0)).unwrap().bounds();
        assert!((low - Vec3::new(3.0, 0.0, -0.45)).length() < 1e-5, "{low}");
        assert!((high - Vec3::new(5.0, 2.0, -0.25)).length() < 1e-5, "{high}");
        assert!(ObstacleParams::default().beside(Vec3::ZERO).is_none());
        let mut kept = KeptObstacles::default();
        let first = kept.beside(&wall, Vec3::X).unwrap();
        assert!(Arc::ptr_eq(&first, &kept.beside(&wall, Vec3::X).unwrap()));
        assert_ne!(first, kept.beside(&wall, Vec3::Z).unwrap());
        let trellis = ObstacleParams { kind: ObstacleKind::Trellis, width: 50.0, height: 50.0, ..wall };
        assert!(trellis.beside(Vec3::ZERO).unwrap().mesh().1.len() < 10_000);
    }
}
