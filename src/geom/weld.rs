//! Welding: vertices at exactly one place become one point.
//!
//! For meshes from files that keep no points, such as glTF, and for volumes. Exact equality on purpose: a tolerance would hide cracks.

use glam::Vec3;

/// The distinct positions, and for each input position the index of its own.
///
/// Sorted by coordinate bits, so the order depends on the positions only; −0 counts as 0, and of the two the first is
/// kept. O(n log n).
pub fn weld(positions: &[Vec3]) -> (Vec<Vec3>, Vec<u32>) {
    let key = |i: u32| (positions[i as usize] + Vec3::ZERO).to_array().map(f32::to_bits);
    let mut order: Vec<u32> = (0..positions.len() as u32).collect();
    order.sort_unstable_by_key(|&i| (key(i), i));
    let mut points = Vec::new();
    let mut point_of_position = vec![0; positions.len()];
    for group in order.chunk_by(|&a, &b| key(a) == key(b)) {
        for &i in group {
            point_of_position[i as usize] = points.len() as u32;
        }
        points.push(positions[group[0] as usize]);
    }
    (points, point_of_position)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_positions_share_a_point_and_near_ones_do_not() {
        let near = Vec3::new(1.0 + f32::EPSILON, 0.0, 0.0);
        let (points, index) = weld(&[Vec3::X, near, Vec3::new(1.0, -0.0, 0.0), Vec3::X]);
        assert_eq!(points.len(), 2);
        assert_eq!((index[0], index[0]), (index[2], index[3]));
        assert_ne!(index[0], index[1]);
    }
}
