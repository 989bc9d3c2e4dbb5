//! Mathematics that knows no plant: polylines, loops, regions, clusters, frames, ellipses, grids, boxes.

pub mod cells;
pub mod convex_hull;
pub mod disc_sums;
pub mod ellipse;
pub mod frame;
pub mod mean_shift;
pub mod meetings;
pub mod polyline;
pub mod ray;
pub mod region;
pub mod simple_loop;
pub mod simplify;
pub mod weld;
