//! UI Automation, by `accesskit_windows`, which listens to the window's messages itself: focus and place need no help.

use super::{Requests, Switch};
use accesskit_windows::{HWND, SubclassingAdapter};
use egui::accesskit::TreeUpdate;
use winit::raw_window_handle::{HasWindowHandle as _, RawWindowHandle};
use winit::window::Window;

/// The window as UI Automation has it.
pub(super) struct Adapter(SubclassingAdapter);

impl Adapter {
    /// `None` for a window that is seen already: the adapter must be there before.
    pub(super) fn open(window: &dyn Window, switch: Switch, requests: Requests) -> Option<Self> {
        let RawWindowHandle::Win32(handle) = window.window_handle().ok()?.as_raw() else { return None };
        if window.is_visible() != Some(false) {
            return None;
        }
        let handle = HWND(std::ptr::with_exposed_provenance_mut(handle.hwnd.get().cast_unsigned()));
        Some(Self(SubclassingAdapter::new(handle, switch, requests)))
    }

    pub(super) fn show(&mut self, tree: TreeUpdate) {
        if let Some(events) = self.0.update_if_active(|| tree) {
            events.raise();
        }
    }

    pub(super) fn focus(&mut self, _: bool) {}

    pub(super) fn place(&mut self, _: &dyn Window) {}
}
