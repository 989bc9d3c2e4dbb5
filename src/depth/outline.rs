//! A drawn outline in its blade's own plane.

use crate::anatomy::{FlatBlade, Sample};
use crate::kept::{Same, Use};
use crate::plant::WorldFromCanvas;
use crate::sketch::StrokePoint;
use glam::Vec2;

crate::parameters! {
    /// What pen pressure does to petals and leaves.
    pub struct CurlParams {
        /// How much pressure along the outline curls the margin toward the face; 0 switches it off.
        pressure_curl: f32 = 1.0, 0.0..=2.0, "";
    }
}

/// A drawn blade by what it looks like in the drawing: its outline, identified by its address, its root and its tip.
#[derive(Debug, PartialEq, Eq, Hash)]
pub struct DrawnBlade {
    outline: Same<[Sample]>,
    ends: [u32; 4],
}

impl DrawnBlade {
    /// That of this blade, for a key.
    pub fn of(flat: &FlatBlade, used: Use) -> Self {
        let ([a, b], [c, d]) = (flat.root.to_array(), flat.tip.to_array());
        Self { outline: Same::of(&flat.outline, used), ends: [a, b, c, d].map(f32::to_bits) }
    }
}

/// The flat frame of a blade in the drawing plane: unit world directions across (u) and along (v) its axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BladeFrame {
    /// Across: the right of the axis, or its left where the blade shows its back.
    pub u: Vec2,
    /// Along the axis, root to tip.
    pub v: Vec2,
}

impl BladeFrame {
    /// Frame of a drawn blade; `from_behind` where the viewer sees its back.
    pub fn new(flat: &FlatBlade, world: &WorldFromCanvas, from_behind: bool) -> Self {
        let v = world.vector(flat.axis()).truncate().normalize_or(Vec2::Y);
        let right = -v.perp();
        Self { u: if from_behind { -right } else { right }, v }
    }
}

/// The outline in (u, v) metres with the curl that pressure gives each of its points (none when
/// the pen was steady at neutral pressure or curling is switched off).
pub fn outline_of(
    flat: &FlatBlade,
    frame: &BladeFrame,
    world: &WorldFromCanvas,
    params: &CurlParams,
) -> (Vec<Vec2>, Vec<f32>) {
    let place = |p: Vec2| {
        let d = world.vector(p - flat.root).truncate();
        Vec2::new(d.dot(frame.u), d.dot(frame.v))
    };
    let outline = flat.outline.iter().map(|s| place(s.position)).collect();
    let curl_of = |pressure: f32| {
        (2.0 * params.pressure_curl * (pressure - StrokePoint::NEUTRAL_PRESSURE)).clamp(-1.0, 1.0)
    };
    let mut curl: Vec<f32> = flat.outline.iter().map(|s| curl_of(s.pressure)).collect();
    if curl.iter().all(|&c| c == 0.0) {
        curl.clear();
    }
    (outline, curl)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    const WORLD: WorldFromCanvas = WorldFromCanvas { scale: 0.01, origin: Vec2::ZERO };

    fn leaf() -> FlatBlade {
        let outline = [(0.0, 0.0), (30.0, -50.0), (0.0, -100.0), (-30.0, -50.0)]
            .map(|p| Sample::neutral(Vec2::from(p)));
        let (root, tip) = (Vec2::ZERO, Vec2::new(0.0, -100.0));
        FlatBlade { stroke: Some(1), outline: outline.into(), root, tip, copy_of: None, attachment: None }
    }

    #[test]
    fn the_tip_is_a_length_away_on_either_side() {
        for from_behind in [false, true] {
            let frame = BladeFrame::new(&leaf(), &WORLD, from_behind);
            let (outline, curl) = outline_of(&leaf(), &frame, &WORLD, &CurlParams::default());
            assert!(outline.iter().any(|p| p.distance(Vec2::Y) < 1e-6), "the tip is at (0, length)");
            assert!(curl.is_empty());
        }
    }

    #[test]
    fn right_on_the_canvas_is_right_of_the_axis() {
        let frame = BladeFrame::new(&leaf(), &WORLD, false);
        assert_eq!((frame.u, frame.v), (Vec2::X, Vec2::Y));
    }

    #[test]
    fn pressure_becomes_curl() {
        let mut flat = leaf();
        Arc::make_mut(&mut flat.outline)[1].pressure = 1.0;
        let frame = BladeFrame::new(&flat, &WORLD, false);
        let (outline, curl) = outline_of(&flat, &frame, &WORLD, &CurlParams::default());
        let pressed = outline.iter().position(|p| p.x > 0.2).unwrap();
        assert_eq!(curl[pressed], 1.0);
    }
}
