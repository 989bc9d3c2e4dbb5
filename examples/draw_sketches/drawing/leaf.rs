//! A leaf on the sheet: its form bent along a midrib and turned about it.

use super::form::Form;
use super::hand::{Hand, toward};
use super::spline;
use glam::DVec2;

/// How a leaf lies on the sheet.
#[derive(Clone, Copy)]
pub struct Leaf {
    /// Where it is attached, pixels.
    pub base: DVec2,
    /// Direction from base to tip in degrees, 0 to the right, 90 up.
    pub aim: f64,
    /// Distance from base to tip in pixels.
    pub length: f64,
    /// Angle in degrees, counter-clockwise, between the direction to the tip and the midrib at the base and at the tip.
    pub bend: [f64; 2],
    /// Breadth of the right and the left side, seen from the base; a leaf turned away shows less of one.
    pub sides: [f64; 2],
}

impl Leaf {
    /// A flat leaf.
    pub fn new(base: DVec2, aim: f64, length: f64) -> Self {
        Self { base, aim, length, bend: [0.0, 0.0], sides: [1.0, 1.0] }
    }

    /// Bends the midrib: positive at the base and negative at the tip makes an arch to the left.
    pub fn bent(self, base: f64, tip: f64) -> Self {
        Self { bend: [base, tip], ..self }
    }

    /// Turns the leaf about its midrib so that the sides show these breadths.
    pub fn turned(self, right: f64, left: f64) -> Self {
        Self { sides: [right, left], ..self }
    }

    /// Draws it, letting the classifier say what it is.
    pub fn draw(&self, hand: &mut Hand, form: &Form) {
        self.draw_as("auto", hand, form);
    }

    /// Draws it with an explicit tool, needed where leaf bases crowd together like those of petals.
    pub fn draw_as(&self, tool: &'static str, hand: &mut Hand, form: &Form) {
        let midrib = self.midrib();
        let knots = spline::lengths(&midrib);
        let arc = knots[knots.len() - 1];
        let mut outline = form.blade(hand, 1.0);
        if hand.chance(0.3) {
            outline.reverse();
        }
        let place = |p: &DVec2| {
            let s = p.x * arc;
            let on = |s: f64| spline::interpolate(&knots, &midrib, s);
            let tangent =
                (on((s + 0.04 * arc).max(0.08 * arc)) - on((s - 0.04 * arc).min(0.92 * arc))).normalize();
            let beyond = (s - s.clamp(0.0, arc)) * tangent;
            let right = DVec2::new(-tangent.y, tangent.x);
            let side = if p.y >= 0.0 { self.sides[0] } else { self.sides[1] };
            on(s) + beyond + right * p.y * side * arc
        };
        let placed: Vec<DVec2> = outline.iter().map(place).collect();
        hand.outline(tool, &placed, 0.1);
    }

    fn midrib(&self) -> Vec<DVec2> {
        let tip = self.base + toward(self.aim) * self.length;
        let handle = self.length * 0.36;
        let (a, b) = (
            self.base + toward(self.aim + self.bend[0]) * handle,
            tip - toward(self.aim + self.bend[1]) * handle,
        );
        let bezier = |t: f64| {
            let u = 1.0 - t;
            self.base * (u * u * u) + a * (3.0 * u * u * t) + b * (3.0 * u * t * t) + tip * (t * t * t)
        };
        (0..=64).map(|i| bezier(f64::from(i) / 64.0)).collect()
    }
}
