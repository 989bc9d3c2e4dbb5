//! Walking through the scene: where it begins, and what keys do meanwhile.

use super::Editor;
use crate::app::action::Action;
use crate::app::view_state::Stride;
use egui::Key;
use glam::Vec3;

impl Editor {
    /// Begins to walk through the plant and its garden, or ends it; without anything to see there is nowhere to go.
    pub(super) fn walk(&mut self, on: bool) {
        match self.scene_bounds() {
            Some(scene) => self.plant.walk(on, scene),
            None => self.plant.walk(false, Default::default()),
        }
    }

    /// Smallest and largest corner of all that is seen, metres.
    fn scene_bounds(&self) -> Option<(Vec3, Vec3)> {
        let garden = self.built().and_then(|built| built.garden.as_ref()?.bounds());
        let both = self.plant.bounds().into_iter().chain(garden);
        both.reduce(|(low, high), (l, h)| (low.min(l), high.max(h)))
    }

    /// What a key means to somebody who walks.
    pub(super) fn walking_key(&self, key: Key, shift: bool) -> Option<Action> {
        if !self.plant.state.walking {
            return None;
        }
        let step = match key {
            Key::Escape => return Some(Action::Walk(false)),
            Key::ArrowUp | Key::ArrowDown => Stride::Ahead(key == Key::ArrowUp),
            Key::ArrowLeft | Key::ArrowRight if shift => Stride::Aside(key == Key::ArrowRight),
            Key::ArrowLeft | Key::ArrowRight => Stride::Turn(key == Key::ArrowRight),
            Key::PageUp | Key::PageDown => Stride::Rise(key == Key::PageUp),
            _ => return None,
        };
        Some(Action::Stride(step))
    }
}

#[cfg(test)]
#[path = "walk_tests.rs"]
mod tests;
