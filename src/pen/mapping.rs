//! From the active area of a tablet to a rectangle of the window.
//!
//! Where the proportions are to be kept, a strip of the tablet's area goes unused on two opposite sides, so that every
//! point of the rectangle can still be reached. A tablet that lies turned by quarters, its cable to another side, is turned
//! back.
//! Places beyond the used part count as the nearest in it.

use super::MAX_POSITION_PX;
use super::calibration::Calibration;
use glam::{DVec2, Vec2, Vec2Swizzles as _};
use serde::{Deserialize, Serialize};

/// A rectangle in physical pixels of the window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Its upper left corner.
    pub min: DVec2,
    /// Its lower right corner.
    pub max: DVec2,
}

/// How a tablet lies, by quarters clockwise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Turn {
    /// As it is meant to.
    #[default]
    None,
    /// A quarter clockwise: its upper side lies on the right.
    Right,
    /// Upside down, for the left hand.
    Half,
    /// A quarter the other way.
    Left,
}

impl Turn {
    /// All of them, clockwise.
    pub const ALL: [Self; 4] = [Self::None, Self::Right, Self::Half, Self::Left];

    /// Width and height change places.
    fn is_upright(self) -> bool {
        matches!(self, Self::Right | Self::Left)
    }

    /// Degrees clockwise.
    pub fn degrees(self) -> f32 {
        match self {
            Self::None => 0.0,
            Self::Right => 90.0,
            Self::Half => 180.0,
            Self::Left => 270.0,
        }
    }

    /// A place on the tablet as the artist sees it, in shares of the area as it lies.
    fn place(self, DVec2 { x, y }: DVec2) -> DVec2 {
        match self {
            Self::None => DVec2::new(x, y),
            Self::Right => DVec2::new(1.0 - y, x),
            Self::Half => DVec2::new(1.0 - x, 1.0 - y),
            Self::Left => DVec2::new(y, 1.0 - x),
        }
    }
}

/// How positions of a tablet become positions in the window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mapping {
    /// The part of the area that counts, in shares.
    low: DVec2,
    high: DVec2,
    target: Rect,
    turn: Turn,
    calibration: Calibration,
}

impl Mapping {
    /// The whole area onto a rectangle.
    pub fn new(target: Rect) -> Self {
        Self {
            low: DVec2::ZERO,
            high: DVec2::ONE,
            target,
            turn: Turn::None,
            calibration: Calibration::default(),
        }
    }

    /// For sources whose positions are window pixels already.
    pub fn pixels() -> Self {
        let corner = DVec2::splat(MAX_POSITION_PX);
        Self { low: -corner, high: corner, ..Self::new(Rect { min: -corner, max: corner }) }
    }

    /// The same, but a circle on the tablet is a circle in the window. `area` is the width and height of the tablet's
    /// area in any unit, as it is meant to lie; sizes that cannot be leave the mapping as it is.
    #[must_use]
    pub fn keep_aspect(self, area: DVec2) -> Self {
        let area = if self.turn.is_upright() { area.yx() } else { area };
        let size = self.target.max - self.target.min;
        let is_sound = |v: DVec2| v.is_finite() && v.min_element() > 0.0;
        if !is_sound(area) || !is_sound(size) {
            return self;
        }
        // Window pixels to one unit of the tablet along each side; the greater of the two is the scale of both.
        let scale = size / area;
        let used = scale / scale.max_element();
        if !is_sound(used) {
            return self;
        }
        let margin = (DVec2::ONE - used) / 2.0;
        Self { low: margin, high: DVec2::ONE - margin, ..self }
    }

    /// The whole area of a tablet that lies turned onto a rectangle.
    #[must_use]
    pub fn turned(target: Rect, turn: Turn) -> Self {
        Self { turn, ..Self::new(target) }
    }

    /// The same, put right for a pen display.
    #[must_use]
    pub fn calibrated(self, calibration: Calibration) -> Self {
        Self { calibration, ..self }
    }

    /// The place in the window for a share of the area; `None` for what is no number.
    pub fn position(&self, share: DVec2) -> Option<DVec2> {
        if !share.is_finite() {
            return None;
        }
        let share = self.turn.place(share);
        let part = (share.clamp(self.low, self.high) - self.low) / (self.high - self.low);
        let part = self.calibration.apply(part);
        let position = self.target.min + (self.target.max - self.target.min) * part;
        (position.is_finite() && position.abs().max_element() <= MAX_POSITION_PX).then_some(position)
    }

    /// A lean in degrees as the artist sees it.
    pub fn tilt(&self, tilt_deg: Vec2) -> Vec2 {
        let Vec2 { x, y } = tilt_deg;
        match self.turn {
            Turn::None => tilt_deg,
            Turn::Right => Vec2::new(-y, x),
            Turn::Half => -tilt_deg,
            Turn::Left => Vec2::new(y, -x),
        }
    }

    /// A turn about the pen's axis in degrees as the artist sees it.
    pub fn twist(&self, twist_deg: f32) -> f32 {
        let turn = (twist_deg + self.turn.degrees()).rem_euclid(360.0);
        if turn < 360.0 { turn } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pen::calibration::CROSSES;
    use proptest::prelude::*;

    fn window() -> Mapping {
        Mapping::new(Rect { min: DVec2::new(100.0, 50.0), max: DVec2::new(900.0, 450.0) })
    }

    fn at(mapping: Mapping, x: f64, y: f64) -> (f64, f64) {
        mapping.position(DVec2::new(x, y)).unwrap().into()
    }

    #[test]
    fn the_whole_area_reaches_the_whole_rectangle() {
        assert_eq!(at(window(), 0.0, 0.0), (100.0, 50.0));
        assert_eq!(at(window(), 1.0, 1.0), (900.0, 450.0));
        assert_eq!(at(window(), 0.25, 0.5), (300.0, 250.0));
        assert_eq!(at(window(), -3.0, 7.0), (100.0, 450.0), "beyond the area is its edge");
    }

    #[test]
    fn kept_proportions_leave_a_strip_of_the_tablet_unused() {
        // The window is 2 to 1, the tablet 200 to 160: its upper and lower 30 count as the edge.
        let mapping = window().keep_aspect(DVec2::new(200.0, 160.0));
        assert_eq!(at(mapping, 0.5, 0.5), (500.0, 250.0));
        assert_eq!(at(mapping, 0.0, 30.0 / 160.0), (100.0, 50.0));
        assert_eq!(at(mapping, 1.0, 1.0), (900.0, 450.0));
        assert_eq!(at(mapping, 0.5, 0.1), (500.0, 50.0));
        let [a, b, c] =
            [(0.5, 0.5), (0.6, 0.5), (0.5, 0.5 + 0.1 * 200.0 / 160.0)].map(|(x, y)| at(mapping, x, y));
        assert!(((b.0 - a.0) - (c.1 - a.1)).abs() < 1e-9, "20 units right are as long as 20 down");
        for area in [DVec2::ZERO, DVec2::new(f64::NAN, 1.0), DVec2::new(1.0, -1.0), DVec2::INFINITY] {
            assert_eq!(window().keep_aspect(area), window());
        }
    }

    #[test]
    fn a_turned_tablet_is_turned_back() {
        let turned = Mapping::turned(window().target, Turn::Half);
        assert_eq!(at(turned, 0.0, 0.0), (900.0, 450.0));
        assert_eq!(turned.tilt(Vec2::new(30.0, -10.0)), Vec2::new(-30.0, 10.0));
        assert_eq!((turned.twist(270.0), window().twist(359.0)), (90.0, 359.0));
    }

    #[test]
    fn a_tablet_on_its_side_keeps_directions_and_proportions() {
        // Its upper left corner lies at the upper right, its upper right at the lower right.
        let right = Mapping::turned(window().target, Turn::Right);
        assert_eq!([at(right, 0.0, 0.0), at(right, 1.0, 0.0)], [(900.0, 50.0), (900.0, 450.0)]);
        let left = Mapping::turned(window().target, Turn::Left);
        assert_eq!([at(left, 0.0, 0.0), at(left, 1.0, 0.0)], [(100.0, 450.0), (100.0, 50.0)]);
        // A lean to the tablet's right is one to the artist's side, as is a step.
        for mapping in Turn::ALL.map(|turn| Mapping::turned(window().target, turn)) {
            let step = |x, y| {
                let step = mapping.position(DVec2::new(0.5 + x, 0.5 + y)).unwrap() - DVec2::new(500.0, 250.0);
                (step / DVec2::new(800.0, 400.0)).as_vec2()
            };
            assert!((mapping.tilt(Vec2::new(0.1, 0.0)) - step(0.1, 0.0)).length() < 1e-6, "{mapping:?}");
            assert!((mapping.tilt(Vec2::new(0.0, 0.1)) - step(0.0, 0.1)).length() < 1e-6, "{mapping:?}");
        }
        // On its side a tablet of 100 by 200 has the window's proportions: all of it is used.
        let upright = right.keep_aspect(DVec2::new(100.0, 200.0));
        assert_eq!(at(upright, 0.0, 1.0), (100.0, 50.0));
        assert_eq!((right.twist(10.0), left.twist(100.0)), (100.0, 10.0));
    }

    #[test]
    fn a_calibrated_display_draws_where_its_crosses_were_touched() {
        let said = CROSSES.map(|cross| cross + DVec2::new(0.02, -0.01));
        let calibrated = window().calibrated(Calibration::default().refined(said).unwrap());
        let place = calibrated.position(DVec2::new(0.52, 0.49)).unwrap();
        assert!(place.distance(DVec2::new(500.0, 250.0)) < 1e-9, "{place}");
    }

    #[test]
    fn pixels_stay_as_they_are() {
        assert_eq!(at(Mapping::pixels(), 123.5, -7.25), (123.5, -7.25));
        assert_eq!(Mapping::pixels().position(DVec2::new(f64::NAN, 0.0)), None);
    }

    proptest! {
        #[test]
        fn positions_stay_in_the_rectangle(
            x in prop::num::f64::ANY, y in prop::num::f64::ANY, w in 1e-3..1e3f64, h in 1e-3..1e3f64, turn in 0..4usize,
        ) {
            let mapping = Mapping::turned(window().target, Turn::ALL[turn]).keep_aspect(DVec2::new(w, h));
            if let Some(position) = mapping.position(DVec2::new(x, y)) {
                prop_assert!(position.cmpge(DVec2::new(100.0 - 1e-9, 50.0 - 1e-9)).all(), "{position}");
                prop_assert!(position.cmple(DVec2::new(900.0 + 1e-9, 450.0 + 1e-9)).all(), "{position}");
            } else {
                prop_assert!(!x.is_finite() || !y.is_finite());
            }
        }
    }
}
