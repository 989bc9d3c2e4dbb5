//! Conversion between winit 0.31 and egui: events of the window to egui's input, and egui's output to the window.
//!
//! egui's own adapter is on an older winit. This one covers pointer, touch, pen, wheel, pinch, keys, text composition
//! (IME), clipboard keys, focus and scale. A pen is a pointer to egui: a tap with it presses buttons.
//!
//! Limits: one window; egui's multi-viewport and accessibility are not served.

use crate::pen::{PenEvent, PenPhase};
use egui::{Event, Modifiers, PointerButton, Pos2, RawInput, TouchDeviceId, TouchId, ViewportId};
use std::time::Instant;
use winit::cursor::CursorIcon;
use winit::dpi::PhysicalPosition;
use winit::event::{
    ButtonSource, ElementState, Force, Ime, KeyEvent, MouseButton, MouseScrollDelta, PointerKind,
    PointerSource, TouchPhase, WindowEvent,
};
use winit::keyboard::{Key, ModifiersState, NamedKey};

/// Collects events until a frame takes them.
pub struct EguiInput {
    raw: RawInput,
    modifiers: Modifiers,
    pixels_per_point: f32,
    start: Instant,
    /// The clipboard's text was asked for and has not arrived yet.
    wants_paste: bool,
}

impl EguiInput {
    /// An adapter for a window of this scale.
    pub fn new(pixels_per_point: f32) -> Self {
        let raw = RawInput { focused: true, ..RawInput::default() };
        let start = Instant::now();
        Self { raw, modifiers: Modifiers::default(), pixels_per_point, start, wants_paste: false }
    }

    /// Keys held.
    pub fn modifiers(&self) -> Modifiers {
        self.modifiers
    }

    /// Physical pixels per logical point.
    pub fn pixels_per_point(&self) -> f32 {
        self.pixels_per_point
    }

    /// A window position in points.
    pub fn point(&self, position: PhysicalPosition<f64>) -> Pos2 {
        let scale = f64::from(self.pixels_per_point);
        Pos2::new((position.x / scale) as f32, (position.y / scale) as f32)
    }

    /// Everything since the last frame; `size` is the window's in physical pixels.
    pub fn take(&mut self, size: (u32, u32)) -> RawInput {
        let points = egui::vec2(size.0 as f32, size.1 as f32) / self.pixels_per_point;
        self.raw.screen_rect = Some(egui::Rect::from_min_size(Pos2::ZERO, points));
        self.raw.time = Some(self.start.elapsed().as_secs_f64());
        let viewport = self.raw.viewports.entry(ViewportId::ROOT).or_default();
        viewport.native_pixels_per_point = Some(self.pixels_per_point);
        self.raw.take()
    }

    /// Whether a key asked for the clipboard since the last call.
    pub fn take_paste_request(&mut self) -> bool {
        std::mem::take(&mut self.wants_paste)
    }

    /// Text that arrived from the clipboard.
    pub fn paste(&mut self, text: String) {
        if !text.is_empty() {
            self.raw.events.push(Event::Paste(text));
        }
    }

    /// Events that did not come through the window, for the next frame.
    pub(super) fn add(&mut self, events: impl Iterator<Item = Event>) {
        self.raw.events.extend(events);
    }

    /// The pointer has gone elsewhere: onto the canvas, which egui does not see.
    pub fn pointer_gone(&mut self) {
        self.raw.events.push(Event::PointerGone);
    }

    /// Passes on a pen that winit does not see; its tip is the left button.
    pub fn on_pen(&mut self, event: &PenEvent) {
        let position = event.sample.position;
        let pos = self.point(PhysicalPosition::new(position.x, position.y));
        if matches!(event.phase, PenPhase::Leave | PenPhase::Cancel) {
            return self.pointer_gone();
        }
        self.raw.events.push(Event::PointerMoved(pos));
        if matches!(event.phase, PenPhase::Down | PenPhase::Up) {
            let (button, pressed) = (PointerButton::Primary, event.phase == PenPhase::Down);
            self.raw.events.push(Event::PointerButton { pos, button, pressed, modifiers: self.modifiers });
        }
    }

    /// Handles one event; `false` where it means nothing to egui.
    pub fn on_event(&mut self, event: &WindowEvent) -> bool {
        match event {
            WindowEvent::ScaleFactorChanged { scale_factor, .. } => {
                self.pixels_per_point = *scale_factor as f32
            }
            WindowEvent::ModifiersChanged(now) => self.on_modifiers(now.state()),
            WindowEvent::PointerMoved { position, source, primary, .. } => {
                self.on_moved(*position, source, *primary);
            }
            WindowEvent::PointerButton { state, position, button, primary, .. } => {
                self.on_button(*state, *position, button, *primary);
            }
            WindowEvent::PointerLeft { kind, primary: true, .. }
                if !matches!(kind, PointerKind::Touch(_)) =>
            {
                self.pointer_gone();
            }
            WindowEvent::MouseWheel { delta, phase, .. } => self.on_wheel(delta, *phase),
            WindowEvent::PinchGesture { delta, .. } => {
                self.raw.events.push(Event::Zoom((*delta as f32).exp()));
            }
            WindowEvent::Focused(focused) => {
                self.raw.focused = *focused;
                self.raw.events.push(Event::WindowFocused(*focused));
                if !focused {
                    self.on_modifiers(ModifiersState::empty());
                }
            }
            WindowEvent::KeyboardInput { event, is_synthetic, .. } => self.on_key(event, *is_synthetic),
            WindowEvent::Ime(ime) => self.on_ime(ime),
            _ => return false,
        }
        true
    }

    fn on_modifiers(&mut self, state: ModifiersState) {
        let ctrl = state.contains(ModifiersState::CONTROL);
        let meta = state.contains(ModifiersState::META);
        let mac = cfg!(target_os = "macos");
        self.modifiers = Modifiers {
            alt: state.contains(ModifiersState::ALT),
            ctrl,
            shift: state.contains(ModifiersState::SHIFT),
            mac_cmd: mac && meta,
            command: if mac { meta } else { ctrl },
        };
        self.raw.events.push(Event::ModifiersChanged(self.modifiers));
    }

    fn on_moved(&mut self, position: PhysicalPosition<f64>, source: &PointerSource, primary: bool) {
        let pos = self.point(position);
        if let PointerSource::Touch { finger_id, force } = source {
            self.raw.events.push(touch(finger_id.into_raw(), egui::TouchPhase::Move, pos, force.as_ref()));
        }
        if primary {
            self.raw.events.push(Event::PointerMoved(pos));
        }
    }

    fn on_button(
        &mut self,
        state: ElementState,
        position: PhysicalPosition<f64>,
        button: &ButtonSource,
        primary: bool,
    ) {
        let (pos, pressed) = (self.point(position), state.is_pressed());
        let is_touch = if let ButtonSource::Touch { finger_id, force } = button {
            let phase = if pressed { egui::TouchPhase::Start } else { egui::TouchPhase::End };
            self.raw.events.push(touch(finger_id.into_raw(), phase, pos, force.as_ref()));
            true
        } else {
            false
        };
        if !primary {
            return;
        }
        if is_touch {
            self.raw.events.push(Event::PointerMoved(pos));
        }
        let Some(button) = button.clone().mouse_button().and_then(pointer_button) else { return };
        self.raw.events.push(Event::PointerButton { pos, button, pressed, modifiers: self.modifiers });
        if is_touch && !pressed {
            self.pointer_gone();
        }
    }

    fn on_wheel(&mut self, delta: &MouseScrollDelta, phase: TouchPhase) {
        let (unit, delta) = match delta {
            MouseScrollDelta::LineDelta(x, y) => (egui::MouseWheelUnit::Line, egui::vec2(*x, *y)),
            MouseScrollDelta::PixelDelta(by) => {
                let points = egui::vec2(by.x as f32, by.y as f32) / self.pixels_per_point;
                (egui::MouseWheelUnit::Point, points)
            }
            _ => return,
        };
        let phase = match phase {
            TouchPhase::Started => egui::TouchPhase::Start,
            TouchPhase::Moved => egui::TouchPhase::Move,
            TouchPhase::Ended => egui::TouchPhase::End,
            TouchPhase::Cancelled => egui::TouchPhase::Cancel,
        };
        let source = egui::MouseWheelSource::Unknown;
        self.raw.events.push(Event::MouseWheel { unit, delta, phase, source, modifiers: self.modifiers });
    }

    fn on_key(&mut self, event: &KeyEvent, is_synthetic: bool) {
        let pressed = event.state.is_pressed();
        // Keys that were already held when the window got the focus were not pressed for it.
        if is_synthetic && pressed {
            return;
        }
        let command = self.modifiers.command && !self.modifiers.alt;
        let key = key(&event.logical_key);
        if pressed && command {
            match key {
                Some(egui::Key::C) => return self.raw.events.push(Event::Copy),
                Some(egui::Key::X) => return self.raw.events.push(Event::Cut),
                Some(egui::Key::V) => {
                    self.wants_paste = true;
                    return;
                }
                _ => {}
            }
        }
        if let Some(key) = key {
            let (repeat, modifiers) = (event.repeat, self.modifiers);
            self.raw.events.push(Event::Key { key, physical_key: None, pressed, repeat, modifiers });
        }
        if let Some(text) = event.text.as_ref().filter(|_| pressed && !command)
            && !text.is_empty()
            && !text.chars().any(char::is_control)
        {
            self.raw.events.push(Event::Text(text.to_string()));
        }
    }

    fn on_ime(&mut self, ime: &Ime) {
        let event = match ime {
            Ime::Preedit(text, active) => {
                let chars = |byte: usize| text.get(..byte).map_or(0, |before| before.chars().count());
                let active_range_chars = active.map(|(from, to)| chars(from)..chars(to));
                egui::ImeEvent::Preedit { text: text.clone(), active_range_chars }
            }
            Ime::Commit(text) => egui::ImeEvent::Commit(text.clone()),
            // egui needs characters, and only it knows its text: not served.
            Ime::DeleteSurrounding { .. } | Ime::Enabled | Ime::Disabled => return,
        };
        self.raw.events.push(Event::Ime(event));
    }
}

fn touch(finger: usize, phase: egui::TouchPhase, pos: Pos2, force: Option<&Force>) -> Event {
    let force = force.map(|f| f.normalized(None) as f32);
    Event::Touch { device_id: TouchDeviceId(0), id: TouchId(finger as u64), phase, pos, force }
}

fn pointer_button(button: MouseButton) -> Option<PointerButton> {
    Some(match button {
        MouseButton::Left => PointerButton::Primary,
        MouseButton::Right => PointerButton::Secondary,
        MouseButton::Middle => PointerButton::Middle,
        MouseButton::Back => PointerButton::Extra1,
        MouseButton::Forward => PointerButton::Extra2,
        _ => return None,
    })
}

/// The key in egui's words.
pub fn key(key: &Key) -> Option<egui::Key> {
    match key {
        Key::Named(named) => named_key(*named),
        Key::Character(text) if text == " " => Some(egui::Key::Space),
        Key::Character(text) => {
            egui::Key::from_name(&text.to_uppercase()).or_else(|| egui::Key::from_name(text))
        }
        _ => None,
    }
}

fn named_key(key: NamedKey) -> Option<egui::Key> {
    Some(match key {
        NamedKey::ArrowDown => egui::Key::ArrowDown,
        NamedKey::ArrowLeft => egui::Key::ArrowLeft,
        NamedKey::ArrowRight => egui::Key::ArrowRight,
        NamedKey::ArrowUp => egui::Key::ArrowUp,
        NamedKey::Escape => egui::Key::Escape,
        NamedKey::Tab => egui::Key::Tab,
        NamedKey::Backspace => egui::Key::Backspace,
        NamedKey::Enter => egui::Key::Enter,
        NamedKey::Insert => egui::Key::Insert,
        NamedKey::Delete => egui::Key::Delete,
        NamedKey::Home => egui::Key::Home,
        NamedKey::End => egui::Key::End,
        NamedKey::PageUp => egui::Key::PageUp,
        NamedKey::PageDown => egui::Key::PageDown,
        NamedKey::F1 => egui::Key::F1,
        NamedKey::F11 => egui::Key::F11,
        _ => return None,
    })
}

/// A system's theme as egui calls it.
pub fn theme(theme: winit::window::Theme) -> egui::Theme {
    match theme {
        winit::window::Theme::Light => egui::Theme::Light,
        winit::window::Theme::Dark => egui::Theme::Dark,
    }
}

/// The cursor that egui asks for; `None` hides it.
pub fn cursor(icon: egui::CursorIcon) -> Option<CursorIcon> {
    use egui::CursorIcon as E;
    Some(match icon {
        E::None => return None,
        E::Default => CursorIcon::Default,
        E::ContextMenu => CursorIcon::ContextMenu,
        E::Help => CursorIcon::Help,
        E::PointingHand => CursorIcon::Pointer,
        E::Progress => CursorIcon::Progress,
        E::Wait => CursorIcon::Wait,
        E::Cell => CursorIcon::Cell,
        E::Crosshair => CursorIcon::Crosshair,
        E::Text => CursorIcon::Text,
        E::VerticalText => CursorIcon::VerticalText,
        E::Alias => CursorIcon::Alias,
        E::Copy => CursorIcon::Copy,
        E::Move => CursorIcon::Move,
        E::NoDrop => CursorIcon::NoDrop,
        E::NotAllowed => CursorIcon::NotAllowed,
        E::Grab => CursorIcon::Grab,
        E::Grabbing => CursorIcon::Grabbing,
        E::AllScroll => CursorIcon::AllScroll,
        E::ResizeHorizontal => CursorIcon::EwResize,
        E::ResizeNeSw => CursorIcon::NeswResize,
        E::ResizeNwSe => CursorIcon::NwseResize,
        E::ResizeVertical => CursorIcon::NsResize,
        E::ResizeEast => CursorIcon::EResize,
        E::ResizeSouthEast => CursorIcon::SeResize,
        E::ResizeSouth => CursorIcon::SResize,
        E::ResizeSouthWest => CursorIcon::SwResize,
        E::ResizeWest => CursorIcon::WResize,
        E::ResizeNorthWest => CursorIcon::NwResize,
        E::ResizeNorth => CursorIcon::NResize,
        E::ResizeNorthEast => CursorIcon::NeResize,
        E::ResizeColumn => CursorIcon::ColResize,
        E::ResizeRow => CursorIcon::RowResize,
        E::ZoomIn => CursorIcon::ZoomIn,
        E::ZoomOut => CursorIcon::ZoomOut,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use winit::event::{
        FingerId, Modifiers as WinitModifiers, TabletToolButton, TabletToolData, TabletToolKind,
    };
    use winit::keyboard::{KeyLocation, NativeKeyCode, PhysicalKey, SmolStr};

    fn at(x: f64, y: f64) -> PhysicalPosition<f64> {
        PhysicalPosition::new(x, y)
    }

    fn press(button: ButtonSource, state: ElementState) -> WindowEvent {
        WindowEvent::PointerButton {
            device_id: None,
            state,
            position: at(30.0, 50.0),
            primary: true,
            button,
            is_macos_activation_click: false,
        }
    }

    fn typed(logical: Key, text: Option<&str>) -> WindowEvent {
        let event = KeyEvent {
            physical_key: PhysicalKey::Unidentified(NativeKeyCode::Unidentified),
            logical_key: logical.clone(),
            text: text.map(SmolStr::new),
            location: KeyLocation::Standard,
            state: ElementState::Pressed,
            repeat: false,
            text_with_all_modifiers: None,
            key_without_modifiers: logical,
        };
        WindowEvent::KeyboardInput { device_id: None, event, is_synthetic: false }
    }

    fn events(input: &mut EguiInput) -> Vec<Event> {
        input.take((800, 600)).events
    }

    fn character(text: &str) -> Key {
        Key::Character(SmolStr::new(text))
    }

    #[test]
    fn positions_are_in_points() {
        let mut input = EguiInput::new(2.0);
        let source = PointerSource::Mouse;
        input.on_event(&WindowEvent::PointerMoved {
            device_id: None,
            position: at(30.0, 50.0),
            primary: true,
            source,
        });
        assert_eq!(events(&mut input), [Event::PointerMoved(Pos2::new(15.0, 25.0))]);
        assert_eq!(input.take((800, 600)).screen_rect.unwrap().max, Pos2::new(400.0, 300.0));
    }

    #[test]
    fn a_pen_presses_like_a_mouse() {
        let mut input = EguiInput::new(1.0);
        let pen = ButtonSource::TabletTool {
            kind: TabletToolKind::Pen,
            button: TabletToolButton::Contact,
            data: TabletToolData::default(),
        };
        input.on_event(&press(pen, ElementState::Pressed));
        let expected = Event::PointerButton {
            pos: Pos2::new(30.0, 50.0),
            button: PointerButton::Primary,
            pressed: true,
            modifiers: Modifiers::default(),
        };
        assert_eq!(events(&mut input), [expected]);
    }

    #[test]
    fn a_lifted_finger_is_gone() {
        let mut input = EguiInput::new(1.0);
        let finger = || ButtonSource::Touch { finger_id: FingerId::from_raw(3), force: None };
        input.on_event(&press(finger(), ElementState::Pressed));
        input.on_event(&press(finger(), ElementState::Released));
        let all = events(&mut input);
        assert!(matches!(all[0], Event::Touch { id: TouchId(3), phase: egui::TouchPhase::Start, .. }));
        assert_eq!(all.last(), Some(&Event::PointerGone));
        assert_eq!(all.iter().filter(|e| matches!(e, Event::PointerButton { .. })).count(), 2);
    }

    #[test]
    fn letters_are_keys_and_text_but_commands_are_no_text() {
        let mut input = EguiInput::new(1.0);
        input.on_event(&typed(character("a"), Some("a")));
        let all = events(&mut input);
        assert!(matches!(all[0], Event::Key { key: egui::Key::A, pressed: true, .. }));
        assert_eq!(all[1], Event::Text("a".into()));
        input.on_event(&WindowEvent::ModifiersChanged(WinitModifiers::from(ModifiersState::CONTROL)));
        input.on_event(&typed(character("z"), Some("z")));
        input.on_event(&typed(character("c"), None));
        let all = events(&mut input);
        assert!(
            all.iter()
                .any(|e| matches!(e, Event::Key { key: egui::Key::Z, modifiers, .. } if modifiers.command))
        );
        assert!(all.contains(&Event::Copy));
        assert!(!all.iter().any(|e| matches!(e, Event::Text(_))));
    }

    #[test]
    fn the_clipboard_is_asked_for_once() {
        let mut input = EguiInput::new(1.0);
        input.on_event(&WindowEvent::ModifiersChanged(WinitModifiers::from(ModifiersState::CONTROL)));
        input.on_event(&typed(character("v"), None));
        assert!(input.take_paste_request() && !input.take_paste_request());
        input.paste("leaf".into());
        assert_eq!(events(&mut input).last(), Some(&Event::Paste("leaf".into())));
    }

    #[test]
    fn losing_the_focus_releases_the_modifiers() {
        let mut input = EguiInput::new(1.0);
        input.on_event(&WindowEvent::ModifiersChanged(WinitModifiers::from(ModifiersState::SHIFT)));
        input.on_event(&WindowEvent::Focused(false));
        assert_eq!(input.modifiers(), Modifiers::default());
        assert!(!input.take((1, 1)).focused);
    }

    #[test]
    fn composed_text_arrives() {
        let mut input = EguiInput::new(1.0);
        input.on_event(&WindowEvent::Ime(Ime::Preedit("花".into(), Some((0, 3)))));
        input.on_event(&WindowEvent::Ime(Ime::Commit("花".into())));
        let preedit = egui::ImeEvent::Preedit { text: "花".into(), active_range_chars: Some(0..1) };
        assert_eq!(
            events(&mut input),
            [Event::Ime(preedit), Event::Ime(egui::ImeEvent::Commit("花".into()))]
        );
    }
}
