//! Ellipse through points, by direct least squares.
