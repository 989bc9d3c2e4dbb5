//! Systems without an adapter: assistive programs find a window without widgets.

use super::{Requests, Switch};
use egui::accesskit::TreeUpdate;
use winit::window::Window;

/// There is none.
pub(super) enum Adapter {}

impl Adapter {
    pub(super) fn open(_: &dyn Window, _: Switch, _: Requests) -> Option<Self> {
        None
    }

    pub(super) fn show(&mut self, _: TreeUpdate) {
        match *self {}
    }

    pub(super) fn focus(&mut self, _: bool) {
        match *self {}
    }

    pub(super) fn place(&mut self, _: &dyn Window) {
        match *self {}
    }
}
