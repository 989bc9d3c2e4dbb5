//! AT-SPI, by `accesskit_unix`, whose thread speaks to the accessibility bus.
//!
//! Under Wayland no program knows where its window is, so places of widgets are relative to the window.

use super::{Requests, Switch};
use egui::accesskit::{Rect, TreeUpdate};
use winit::window::Window;

/// The window on the accessibility bus.
pub(super) struct Adapter(accesskit_unix::Adapter);

impl Adapter {
    pub(super) fn open(_: &dyn Window, switch: Switch, requests: Requests) -> Option<Self> {
        Some(Self(accesskit_unix::Adapter::new(switch.clone(), requests, switch)))
    }

    pub(super) fn show(&mut self, tree: TreeUpdate) {
        self.0.update_if_active(|| tree);
    }

    pub(super) fn focus(&mut self, is_focused: bool) {
        self.0.update_window_focus_state(is_focused);
    }

    pub(super) fn place(&mut self, window: &dyn Window) {
        let Ok(outer) = window.outer_position() else { return };
        let (corner, whole, inside) = (window.surface_position(), window.outer_size(), window.surface_size());
        let rect = |x: i32, y: i32, width: u32, height: u32| {
            let (x, y) = (f64::from(x), f64::from(y));
            Rect::new(x, y, x + f64::from(width), y + f64::from(height))
        };
        let frame = rect(outer.x, outer.y, whole.width, whole.height);
        let content = rect(outer.x + corner.x, outer.y + corner.y, inside.width, inside.height);
        self.0.set_root_window_bounds(frame, content);
    }
}
