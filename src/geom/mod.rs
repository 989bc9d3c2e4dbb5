//! Mathematics that knows no plant: polylines, frames, polygons, ellipse fit, mean shift.

pub mod ellipse;
