//! From the active area of a tablet to a rectangle of the window.
//!
//! Where the proportions are to be kept, a strip of the tablet's area goes unused on two opposite sides, so that every
//! point of the rectangle can still be reached. A tablet that is turned by 180° for a left-handed artist is turned back.
//! Places beyond the used part count as the nearest in it.

use super::MAX_POSITION_PX;
use glam::{DVec2, Vec2};

/// A rectangle in physical pixels of the window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Its upper left corner.
    pub min: DVec2,
    /// Its lower right corner.
    pub max: DVec2,
}

/// How positions of a tablet become positions in the window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mapping {
    /// The part of the area that counts, in shares.
    low: DVec2,
    high: DVec2,
    target: Rect,
    is_turned: bool,
}

impl Mapping {
    /// The whole area onto a rectangle.
    pub fn new(target: Rect) -> Self {
        Self { low: DVec2::ZERO, high: DVec2::ONE, target, is_turned: false }
    }

    /// For sources whose positions are window pixels already.
    pub fn pixels() -> Self {
        let corner = DVec2::splat(MAX_POSITION_PX);
        Self { low: -corner, high: corner, target: Rect { min: -corner, max: corner }, is_turned: false }
    }

    /// The same, but a circle on the tablet is a circle in the window. `area` is the width and height of the tablet's
    /// area in any unit; sizes that cannot be leave the mapping as it is.
    #[must_use]
    pub fn keep_aspect(self, area: DVec2) -> Self {
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

    /// The same for a tablet that lies turned by 180°, its cable to the other side.
    #[must_use]
    pub fn left_handed(self, is_turned: bool) -> Self {
        Self { is_turned, ..self }
    }

    /// The place in the window for a share of the area; `None` for what is no number.
    pub fn position(&self, share: DVec2) -> Option<DVec2> {
        if !share.is_finite() {
            return None;
        }
        let share = if self.is_turned { DVec2::ONE - share } else { share };
        let part = (share.clamp(self.low, self.high) - self.low) / (self.high - self.low);
        let position = self.target.min + (self.target.max - self.target.min) * part;
        (position.is_finite() && position.abs().max_element() <= MAX_POSITION_PX).then_some(position)
    }

    /// A lean in degrees as the artist sees it.
    pub fn tilt(&self, tilt_deg: Vec2) -> Vec2 {
        if self.is_turned { -tilt_deg } else { tilt_deg }
    }

    /// A turn about the pen's axis in degrees as the artist sees it.
    pub fn twist(&self, twist_deg: f32) -> f32 {
        let turned = if self.is_turned { twist_deg + 180.0 } else { twist_deg };
        let turn = turned.rem_euclid(360.0);
        if turn < 360.0 { turn } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
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
        let turned = window().left_handed(true);
        assert_eq!(at(turned, 0.0, 0.0), (900.0, 450.0));
        assert_eq!(turned.tilt(Vec2::new(30.0, -10.0)), Vec2::new(-30.0, 10.0));
        assert_eq!((turned.twist(270.0), window().twist(359.0)), (90.0, 359.0));
    }

    #[test]
    fn pixels_stay_as_they_are() {
        assert_eq!(at(Mapping::pixels(), 123.5, -7.25), (123.5, -7.25));
        assert_eq!(Mapping::pixels().position(DVec2::new(f64::NAN, 0.0)), None);
    }

    proptest! {
        #[test]
        fn positions_stay_in_the_rectangle(
            x in prop::num::f64::ANY, y in prop::num::f64::ANY, w in 1e-3..1e3f64, h in 1e-3..1e3f64, turned: bool,
        ) {
            let mapping = window().keep_aspect(DVec2::new(w, h)).left_handed(turned);
            if let Some(position) = mapping.position(DVec2::new(x, y)) {
                prop_assert!(position.cmpge(DVec2::new(100.0 - 1e-9, 50.0 - 1e-9)).all(), "{position}");
                prop_assert!(position.cmple(DVec2::new(900.0 + 1e-9, 450.0 + 1e-9)).all(), "{position}");
            } else {
                prop_assert!(!x.is_finite() || !y.is_finite());
            }
        }
    }
}
