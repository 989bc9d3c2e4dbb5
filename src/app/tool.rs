//! What a tool of a view is: something that a pointer works with from the moment it touches until it is lifted.
//!
//! A tool gets every sample as the pointer's way in said it, with pressure, tilt, time and buttons, in physical pixels of
//! the window; the view says what they mean in it. No sample allocates.

use crate::pen::PenSample;

/// A tool that works on a view; `Shown` is what can be seen of its work before that counts.
pub trait Tool<View: ?Sized, Shown: Default = ()> {
    /// The pointer touches.
    fn begin(&mut self, sample: &PenSample, view: &mut View);

    /// It moves, or presses or leans otherwise, while it touches.
    fn sample(&mut self, sample: &PenSample, view: &mut View);

    /// It is lifted, or leaves the range in which it is seen: what was done counts.
    fn end(&mut self, sample: &PenSample, view: &mut View);

    /// The touch is taken away, or was another tool's: what was done does not count.
    fn cancel(&mut self, view: &mut View);

    /// What the view would become if the pointer were lifted now.
    fn preview(&self) -> Shown {
        Shown::default()
    }
}
