//! The picture under the drawing as it is taken hold of: where its handles are, and what a drag of one does.

use crate::app::canvas::transform::TURN_STEP_DEG;
use crate::sketch::Reference;
use glam::{DVec2, Vec2};

/// Distance within which a handle is taken hold of, points.
pub(super) const GRIP: f64 = 14.0;
/// Smallest width of a picture, canvas pixels.
const LEAST_WIDTH: f32 = 4.0;

/// The picture being moved or scaled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Hold {
    /// Moved: from the pointer to the picture's middle, canvas pixels.
    Move(Vec2),
    /// Scaled about this corner; the other is opposite.
    Scale { fixed: Vec2, from_fixed: Vec2, width: f32 },
    /// Turned about its middle: from where the pointer took hold, and how it lay then.
    Turn { from: Vec2, rotation_deg: f32 },
}

impl Hold {
    /// What of a picture, whose frame is this, a pointer takes hold of: in the window, on the canvas, within `reach` physical
    /// pixels.
    pub(super) fn begin(
        reference: &Reference,
        frame: &Frame,
        (at, pointer): (DVec2, Vec2),
        reach: f64,
    ) -> Option<Self> {
        let Frame { corners: sides, middle, turn: [_, turn] } = *frame;
        if turn.distance(at) <= reach {
            let from = pointer - reference.center;
            return Some(Self::Turn { from, rotation_deg: reference.rotation_deg });
        }
        if let Some(corner) = sides.iter().position(|c| c.distance(at) <= reach) {
            let places = corners(reference);
            let fixed = places[(corner + 2) % 4];
            return Some(Self::Scale { fixed, from_fixed: places[corner] - fixed, width: reference.width });
        }
        let on_edge = (0..4).any(|i| distance_to_side(at, sides[i], sides[(i + 1) % 4]) <= 0.5 * reach);
        (on_edge || middle.distance(at) <= reach).then(|| Self::Move(reference.center - pointer))
    }
}

/// Where the picture is taken hold of, physical pixels of the window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::app) struct Frame {
    /// Around.
    pub(in crate::app) corners: [DVec2; 4],
    pub(in crate::app) middle: DVec2,
    /// The middle of the edge at which the turning handle stands, and the handle.
    pub(in crate::app) turn: [DVec2; 2],
}

/// Corners of a picture on the canvas, around.
pub(super) fn corners(reference: &Reference) -> [Vec2; 4] {
    let half = 0.5 * Vec2::new(reference.width, reference.height());
    let turn = Vec2::from_angle(reference.rotation_deg.to_radians());
    let corner = |x: f32, y: f32| reference.center + turn.rotate(half * Vec2::new(x, y));
    [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)]
}

/// Moves the picture with the pointer; `steps` turns it by whole steps only.
pub(super) fn drag(reference: &mut Reference, hold: Hold, pointer: Vec2, steps: bool) {
    match hold {
        Hold::Move(to_center) => reference.center = pointer + to_center,
        Hold::Scale { fixed, from_fixed, width } => {
            // The corner follows the pointer along the diagonal.
            let along = (pointer - fixed).dot(from_fixed) / from_fixed.length_squared().max(1e-6);
            reference.width = (width * along).max(LEAST_WIDTH);
            reference.center = fixed + from_fixed * (0.5 * reference.width / width);
        }
        Hold::Turn { from, rotation_deg } => {
            let to = pointer - reference.center;
            // Over its own middle the pointer points nowhere.
            if from.length_squared() > 0.0 && to.length_squared() > 0.0 {
                let turned = rotation_deg + from.angle_to(to).to_degrees();
                let step = TURN_STEP_DEG as f32;
                let turned = if steps { (turned / step).round() * step } else { turned };
                // −180 to 180, as people say it.
                reference.rotation_deg = (turned + 180.0).rem_euclid(360.0) - 180.0;
            }
        }
    }
}

fn distance_to_side(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let t = ((p - a).dot(b - a) / (b - a).length_squared().max(1e-12)).clamp(0.0, 1.0);
    p.distance(a + (b - a) * t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sketch::Picture;

    fn picture() -> Picture {
        let mut bytes = std::io::Cursor::new(Vec::new());
        let mut encoder = png::Encoder::new(&mut bytes, 4, 2);
        encoder.set_color(png::ColorType::Rgb);
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(&[200; 24]).unwrap();
        writer.finish().unwrap();
        Picture::new(bytes.into_inner()).unwrap()
    }

    #[test]
    fn a_dragged_corner_scales_about_the_opposite_one() {
        let mut reference = Reference::new(picture(), Vec2::new(100.0, 50.0), 200.0);
        let [first, _, third, _] = corners(&reference);
        assert_eq!((first, third), (Vec2::ZERO, Vec2::new(200.0, 100.0)));
        let hold = Hold::Scale { fixed: first, from_fixed: third - first, width: 200.0 };
        drag(&mut reference, hold, Vec2::new(400.0, 200.0), false);
        assert_eq!((reference.width, reference.center), (400.0, Vec2::new(200.0, 100.0)));
        assert_eq!(corners(&reference)[0], Vec2::ZERO);
        drag(&mut reference, hold, Vec2::new(-500.0, -500.0), false);
        assert_eq!(reference.width, LEAST_WIDTH);
    }

    #[test]
    fn a_moved_picture_keeps_its_place_under_the_pointer() {
        let mut reference = Reference::new(picture(), Vec2::new(100.0, 50.0), 200.0);
        drag(&mut reference, Hold::Move(Vec2::new(10.0, 0.0)), Vec2::new(30.0, 40.0), false);
        assert_eq!(reference.center, Vec2::new(40.0, 40.0));
    }

    #[test]
    fn a_turned_picture_follows_the_pointer_around_its_middle() {
        let mut reference = Reference::new(picture(), Vec2::new(100.0, 50.0), 200.0);
        reference.rotation_deg = 170.0;
        let hold = Hold::Turn { from: Vec2::new(0.0, -80.0), rotation_deg: 170.0 };
        // From above to the right: a quarter clockwise, past the half turn.
        drag(&mut reference, hold, Vec2::new(130.0, 50.0), false);
        assert!((reference.rotation_deg + 100.0).abs() < 1e-3, "{}", reference.rotation_deg);
        assert_eq!((reference.center, reference.width), (Vec2::new(100.0, 50.0), 200.0));
        drag(&mut reference, hold, Vec2::new(130.0, 52.0), true);
        assert!((reference.rotation_deg + 90.0).abs() < 1e-3, "{}", reference.rotation_deg);
        drag(&mut reference, hold, Vec2::new(100.0, 50.0), false);
        assert!((reference.rotation_deg + 90.0).abs() < 1e-3, "nowhere is no direction");
    }
}
