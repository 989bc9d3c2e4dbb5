//! The names of `desktop.rs` on systems where winit names and paints a window, and no panel has to be asked for.

use winit::dpi::PhysicalSize;
use winit::event_loop::ActiveEventLoop;
use winit::window::{Window, WindowAttributes};

/// No window has a number of an X server.
pub(super) fn x11_id(_: &dyn Window) -> Option<u32> {
    None
}

/// A window shows no place in which nothing was drawn.
pub(super) fn fill(_: &dyn Window, _: egui::Color32) {}

/// Not known.
pub(super) fn work_area(_: &dyn ActiveEventLoop) -> Option<PhysicalSize<u32>> {
    None
}

/// The window's title is its name.
pub(super) fn named(_: &dyn ActiveEventLoop, attributes: WindowAttributes) -> WindowAttributes {
    attributes
}
