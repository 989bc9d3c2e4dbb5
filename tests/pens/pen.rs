//! What every simulated pen can do, and what must come of it.

use glam::DVec2;
use penstemon::sketch::Stroke;

/// One sample of a stroke that a test draws.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touch {
    /// Place on the screen in pixels.
    pub(crate) at: [f64; 2],
    /// Share of the greatest pressure.
    pub(crate) pressure: f64,
    pub(crate) tilt_deg: [f64; 2],
}

/// A pen of any system. The first button is its tip, the second the lower one on its barrel.
pub(crate) trait Pen {
    fn hover(&mut self, at: [f64; 2]);
    fn press(&mut self, button: u32, touch: &Touch);
    fn draw(&mut self, touch: &Touch);
    fn release(&mut self, button: u32);
    fn go(&mut self);

    /// Comes, draws a stroke and goes.
    fn stroke(&mut self, touches: &[Touch]) {
        self.hover(touches[0].at);
        self.press(1, &touches[0]);
        touches[1..].iter().for_each(|touch| self.draw(touch));
        self.release(1);
        self.go();
    }

    fn tap(&mut self, at: [f64; 2]) {
        self.stroke(&[Touch { at, pressure: 0.5, tilt_deg: [0.0; 2] }]);
    }

    /// Moves through the air from place to place while a button is held.
    fn drag(&mut self, button: u32, from: [f64; 2], to: [f64; 2]) {
        let at = |at| Touch { at, pressure: 0.0, tilt_deg: [0.0; 2] };
        self.hover(from);
        self.press(button, &at(from));
        self.draw(&at([0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])]));
        self.draw(&at(to));
        self.release(button);
        self.go();
    }
}

/// A stroke from place to place whose pressure rises evenly while the pen leans over.
pub(crate) fn ramp(from: [f64; 2], to: [f64; 2], samples: usize) -> Vec<Touch> {
    let along = |i: usize| i as f64 / (samples - 1) as f64;
    let touch = |t: f64| Touch {
        at: [from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])],
        pressure: 0.05 + 0.9 * t,
        tilt_deg: [(-40.0 + 90.0 * t).round(), (30.0 - 60.0 * t).round()],
    };
    (0..samples).map(|i| touch(along(i))).collect()
}

/// Holds a saved stroke against what the pen did: every sample, and nothing else.
pub(crate) fn assert_drawn(stroke: &Stroke, touches: &[Touch], has_tilt: bool) {
    assert_eq!(stroke.points.len(), touches.len(), "one point a sample");
    let place = |i: usize| stroke.points[i].position.as_dvec2();
    let (first, last) = (place(0), place(touches.len() - 1));
    for (i, (point, touch)) in stroke.points.iter().zip(touches).enumerate() {
        let context = format!("sample {i}: {point:?} of {touch:?}");
        assert!((f64::from(point.pressure) - touch.pressure).abs() < 0.01, "{context}");
        // Samples lie evenly on the line, finer than pixels.
        let even = first.lerp(last, i as f64 / (touches.len() - 1) as f64);
        assert!((place(i) - even).length() < 0.1, "{context}: not at {even}");
        if has_tilt {
            let tilt = point.tilt_deg.as_dvec2() - DVec2::from(touch.tilt_deg);
            assert!(tilt.abs().max_element() < 1.0, "{context}");
        }
    }
    let times: Vec<f32> = stroke.points.iter().map(|point| point.time_ms).collect();
    assert!(times.is_sorted() && times[0] == 0.0, "{times:?}");
}

/// Where a place on the screen is on the canvas, by a stroke of which both are known. The canvas is not turned.
pub(crate) fn on_canvas(stroke: &Stroke, touches: &[Touch], at: [f64; 2]) -> DVec2 {
    let ends = [&touches[0], &touches[touches.len() - 1]].map(|touch| DVec2::from(touch.at));
    let drawn = [0, stroke.points.len() - 1].map(|i| stroke.points[i].position.as_dvec2());
    let scale = (drawn[1] - drawn[0]).length() / (ends[1] - ends[0]).length();
    drawn[0] + scale * (DVec2::from(at) - ends[0])
}

/// The same stroke drawn again after the sheet was moved under it.
pub(crate) fn assert_shifted(before: &Stroke, after: &Stroke) {
    let shift = after.points[0].position - before.points[0].position;
    assert!(shift.length() > 5.0, "the sheet was not moved");
    for (a, b) in before.points.iter().zip(&after.points) {
        assert!((b.position - a.position - shift).length() < 0.1, "{a:?} became {b:?}, not moved by {shift}");
    }
}
