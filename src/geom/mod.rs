//! Mathematics that knows no plant: polylines, loops, regions, clusters, frames, ellipses, grids, boxes.

mod boundary;
pub mod bvh;
pub mod capsule;
pub mod cells;
pub mod cholesky;
mod cluster_heads;
pub mod convex_hull;
pub mod crossing;
pub mod disc_sums;
pub mod ellipse;
pub mod face_tree;
pub mod frame;
pub mod hemisphere;
pub mod inflation;
pub mod line_changes;
pub mod mean_shift;
pub mod outlined_area;
pub mod polyline;
pub mod principal_axes;
pub mod ray;
pub mod region;
pub mod segment_index;
pub mod simple_loop;
pub mod simplify;
pub mod weld;

/// The golden angle, π·(3 − √5), radians.
pub const GOLDEN_RAD: f32 = 2.399_963_2;
