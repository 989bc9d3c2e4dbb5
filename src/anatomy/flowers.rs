//! Which blades are petals, and of which flower (000 §3.3, 002 §4.1).
//!
//! Petals of one flower grow from one place, leaves one by one along a branch: roots that gather are a flower. The
//! radius within which roots see each other is a share of the blade's own length, so flowers of several scales live
//! in one drawing. As in 002, clusters of more than two are flowers; blades drawn with the petal tool are petals in
//! any number, those drawn with the leaf tool never are.

use super::{FlatBlade, FlatFlower};
use crate::geom::mean_shift;
use crate::sketch::Tool;
use glam::Vec2;

crate::parameters! {
    /// How petals gather to flowers.
    pub struct FlowerParams {
        /// Radius within which roots belong together.
        bandwidth: f32 = 0.3, 0.02..=2.0, "of the blade's length";
        /// Fewest blades that make a flower where the artist did not say petal.
        min_petals: u32 = 3, 1..=50, "";
    }
}

/// Share of a bandwidth within which two modes are the same cluster.
const MERGE: f32 = 0.7;

/// Blades sorted into flowers and leaves.
#[derive(Debug, Default, PartialEq)]
pub struct Gathering {
    /// Petals, flower by flower.
    pub petals: Vec<FlatBlade>,
    /// Flowers over those petals.
    pub flowers: Vec<FlatFlower>,
    /// The rest.
    pub leaves: Vec<FlatBlade>,
}

/// Sorts blades, each with the tool of its stroke, into flowers and leaves. Order of drawing is kept within each.
pub fn gather(blades: Vec<(FlatBlade, Tool)>, params: &FlowerParams) -> Gathering {
    let (drawn_leaves, candidates): (Vec<_>, Vec<_>) = blades.into_iter().partition(|(_, tool)| *tool == Tool::Leaf);
    let roots: Vec<Vec2> = candidates.iter().map(|(b, _)| b.root).collect();
    let reach: Vec<f32> = candidates.iter().map(|(b, _)| params.bandwidth * b.axis().length()).collect();
    let labels = mean_shift::cluster(&roots, &reach, MERGE);

    let clusters = labels.iter().max().map_or(0, |m| m + 1);
    let mut members = vec![Vec::new(); clusters];
    for (blade, label) in candidates.into_iter().zip(labels) {
        members[label].push(blade);
    }
    let mut out = Gathering { leaves: drawn_leaves.into_iter().map(|(b, _)| b).collect(), ..Default::default() };
    for cluster in members {
        let explicit = cluster.iter().any(|(_, tool)| *tool == Tool::Petal);
        let blades = cluster.into_iter().map(|(b, _)| b);
        if explicit || blades.len() >= params.min_petals as usize {
            out.add_flower(blades);
        } else {
            out.leaves.extend(blades);
        }
    }
    out.leaves.sort_by_key(|leaf| leaf.stroke);
    out
}

impl Gathering {
    fn add_flower(&mut self, blades: impl ExactSizeIterator<Item = FlatBlade>) {
        let first = self.petals.len();
        self.petals.extend(blades);
        let petals = &self.petals[first..];
        let center = petals.iter().map(|p| p.root).sum::<Vec2>() / petals.len() as f32;
        self.flowers.push(FlatFlower { petals: (first..self.petals.len()).collect(), center });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::Sample;

    fn blade(id: u64, root: Vec2, axis: Vec2) -> FlatBlade {
        let side = axis.perp() * 0.3;
        let outline = [root, root + axis * 0.5 + side, root + axis, root + axis * 0.5 - side]
            .map(|position| Sample { position, pressure: 0.5, tilt_deg: Vec2::ZERO });
        FlatBlade { stroke: Some(id), outline: outline.to_vec(), root, tip: root + axis, template: None }
    }

    fn ring(first: u64, center: Vec2, count: usize, size: f32, tool: Tool) -> Vec<(FlatBlade, Tool)> {
        (0..count)
            .map(|k| {
                let out = Vec2::from_angle(k as f32 * std::f32::consts::TAU / count as f32);
                (blade(first + k as u64, center + out * size * 0.08, out * size), tool)
            })
            .collect()
    }

    #[test]
    fn flowers_of_three_scales_and_leaves() {
        let mut blades = ring(10, Vec2::ZERO, 13, 100.0, Tool::Auto);
        blades.extend(ring(40, Vec2::new(150.0, 0.0), 5, 20.0, Tool::Auto));
        blades.extend(ring(60, Vec2::new(180.0, 5.0), 6, 8.0, Tool::Auto));
        blades.push((blade(1, Vec2::new(0.0, 300.0), Vec2::new(60.0, -10.0)), Tool::Auto));
        blades.push((blade(2, Vec2::new(0.0, 310.0), Vec2::new(-60.0, -10.0)), Tool::Auto));
        let gathering = gather(blades, &FlowerParams::default());
        let counts: Vec<usize> = gathering.flowers.iter().map(|f| f.petals.len()).collect();
        assert_eq!(counts, [13, 5, 6]);
        assert_eq!(gathering.leaves.len(), 2);
    }

    #[test]
    fn tools_win_over_counts() {
        let mut blades = ring(1, Vec2::ZERO, 4, 50.0, Tool::Leaf);
        blades.extend(ring(9, Vec2::new(500.0, 0.0), 2, 50.0, Tool::Petal));
        let gathering = gather(blades, &FlowerParams::default());
        assert_eq!(gathering.leaves.len(), 4);
        assert_eq!(gathering.flowers.len(), 1);
        assert!(gathering.flowers[0].center.distance(Vec2::new(500.0, 0.0)) < 1e-3);
    }

    #[test]
    fn scale_does_not_matter() {
        for scale in [0.1, 10.0] {
            let blades = ring(1, Vec2::ZERO, 7, 30.0 * scale, Tool::Auto);
            assert_eq!(gather(blades, &FlowerParams::default()).flowers.len(), 1);
        }
    }
}
