//! What winit does not say or do under X11: how much room the desktop's panels leave, and a colour for a window in which
//! nothing was drawn yet.
//!
//! Both are asked over a connection of their own, once each. Source: Extended Window Manager Hints 1.5.

use winit::dpi::PhysicalSize;
use x11rb::connection::Connection as _;
use x11rb::protocol::xproto::{AtomEnum, ChangeWindowAttributesAux, ConnectionExt as _};
use x11rb::rust_connection::RustConnection;

/// Longest answer that is read, in numbers of 32 bits: rooms of a hundred desktops.
const MOST: u32 = 400;

/// The room that panels leave on the desktop that is seen, in physical pixels; `None` without a window manager that says
/// so.
pub(super) fn work_area() -> Option<PhysicalSize<u32>> {
    let (server, screen) = x11rb::connect(None).ok()?;
    let root = server.setup().roots.get(screen)?.root;
    let desktop =
        numbers(&server, root, "_NET_CURRENT_DESKTOP").and_then(|n| n.first().copied()).unwrap_or(0);
    let areas = numbers(&server, root, "_NET_WORKAREA")?;
    let [_, _, width, height] = *areas.as_chunks::<4>().0.get(desktop as usize)?;
    Some(PhysicalSize::new(width, height))
}

fn numbers(server: &RustConnection, root: u32, name: &str) -> Option<Vec<u32>> {
    let atom = server.intern_atom(true, name.as_bytes()).ok()?.reply().ok()?.atom;
    let asked = server.get_property(false, root, atom, AtomEnum::CARDINAL, 0, MOST).ok()?;
    Some(asked.reply().ok()?.value32()?.collect())
}

/// Lets the server fill a window with a colour, red, green and blue, wherever nothing was drawn yet. Without it such a
/// place is black, or shows what was on the screen before.
pub(super) fn fill_window(window: u32, [r, g, b]: [u8; 3]) {
    let filled = || {
        let (server, _) = x11rb::connect(None).ok()?;
        // Windows of winit have 24 or 32 bits per pixel; in the latter the highest are opacity.
        let pixel = u32::from_be_bytes([0xff, r, g, b]);
        let looks = ChangeWindowAttributesAux::new().background_pixel(pixel);
        server.change_window_attributes(window, &looks).ok()?.check().ok()
    };
    if filled().is_none() {
        tracing::debug!("the window is not filled before it is drawn");
    }
}
