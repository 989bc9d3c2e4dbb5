//! Pose of a flower from the projection of its cone.
