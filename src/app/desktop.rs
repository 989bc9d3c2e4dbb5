//! What a desktop of Linux is asked beside winit: a window's number, its name, its colour, and the room that panels leave.
//!
//! `desktop_of_system.rs` has the same names for systems on which winit does all of this.

use super::x11_desktop;
use winit::dpi::PhysicalSize;
use winit::event_loop::ActiveEventLoop;
use winit::platform::{wayland, x11};
use winit::raw_window_handle::{HasWindowHandle as _, RawWindowHandle};
use winit::window::{Window, WindowAttributes};

/// How the program's menu entry is named.
const NAME: &str = "org.penstemon.Penstemon";

/// The X server's number of a window; `None` under Wayland.
pub(super) fn x11_id(window: &dyn Window) -> Option<u32> {
    match window.window_handle().ok()?.as_raw() {
        RawWindowHandle::Xlib(handle) => u32::try_from(handle.window).ok(),
        RawWindowHandle::Xcb(handle) => Some(handle.window.get()),
        _ => None,
    }
}

/// Fills a window with a colour where nothing was drawn yet; only X11 shows such a place.
pub(super) fn fill(window: &dyn Window, colour: egui::Color32) {
    if let Some(id) = x11_id(window) {
        x11_desktop::fill_window(id, [colour.r(), colour.g(), colour.b()]);
    }
}

/// The room that panels leave of all monitors together. Under Wayland nobody says; there the compositor makes a window
/// smaller that does not fit.
pub(super) fn work_area(event_loop: &dyn ActiveEventLoop) -> Option<PhysicalSize<u32>> {
    if is_wayland(event_loop) { None } else { x11_desktop::work_area() }
}

/// Names the window as the menu entry is named, so that the desktop shows its icon.
pub(super) fn named(event_loop: &dyn ActiveEventLoop, attributes: WindowAttributes) -> WindowAttributes {
    if is_wayland(event_loop) {
        let named = wayland::WindowAttributesWayland::default().with_name(NAME, "penstemon");
        attributes.with_platform_attributes(Box::new(named))
    } else {
        let named = x11::WindowAttributesX11::default().with_name(NAME, "penstemon");
        attributes.with_platform_attributes(Box::new(named))
    }
}

fn is_wayland(event_loop: &dyn ActiveEventLoop) -> bool {
    wayland::ActiveEventLoopExtWayland::is_wayland(event_loop)
}
