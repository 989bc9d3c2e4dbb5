//! From the flat drawing to the plant in space (000 ch. 4, 002 §5).

pub mod cone_pose;
