//! The window: receives events of the system, hands each to its owner, and draws when there is something new.
//!
//! Pens, mice and fingers go to the canvas, and over the plant to its tools, sample by sample; everything else goes to
//! egui. A press decides: what went down on a side stays that side's until it is lifted. Nothing is drawn that nobody asked
//! for: an idle window sleeps until the next event, or until the moment that egui or the editor named.

mod frames;
mod pointing;

use super::accessibility::Accessibility;
use super::composition::Composition;
use super::desktop;
use super::display_loss;
use super::editor::Editor;
use super::egui_input::{self, EguiInput};
use super::ending::Ending;
use super::notice::Notice;
use super::pointers::{PointerEvent, Pointers};
use super::revival::Revival;
use super::sides::Sides;
use super::theme::Palette;
use super::transfer::{self, Arrival};
use super::window_size;
use crate::pen::hid::Recording;
use crate::pen::hid::replay::Stage;
use anyhow::Context as _;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, EventLoop};
use winit::window::{Window, WindowId};

/// Opens the window and stays until it is closed.
///
/// # Errors
/// No display, no graphics driver, or a drawing named on the command line that cannot be opened at all.
pub fn run(file: Option<PathBuf>) -> anyhow::Result<()> {
    open(file, None)
}

/// The same with a recording's tablets in place of the machine's.
///
/// # Errors
/// Those of [`run`].
pub fn replay(file: Option<PathBuf>, recording: Recording) -> anyhow::Result<()> {
    open(file, Some(Stage::new(recording)))
}

fn open(file: Option<PathBuf>, stage: Option<Stage>) -> anyhow::Result<()> {
    let event_loop = EventLoop::new().context(
        "the window cannot be opened: there is no display (neither DISPLAY nor WAYLAND_DISPLAY leads to one); \
         `penstemon build` and `penstemon render` work without",
    )?;
    let failure = Arc::new(std::sync::Mutex::new(None));
    let app = App { file, stage, running: None, failure: Arc::clone(&failure) };
    let ended = display_loss::run(|| event_loop.run_app(app)).context(display_loss::LOST)?;
    ended.context(display_loss::LOST)?;
    let failed = failure.lock().unwrap_or_else(std::sync::PoisonError::into_inner).take();
    failed.map_or(Ok(()), Err)
}

/// What the event loop calls.
struct App {
    file: Option<PathBuf>,
    /// What plays in place of the machine's tablets.
    stage: Option<Stage>,
    running: Option<Running>,
    /// Why the window could not be opened.
    failure: Arc<std::sync::Mutex<Option<anyhow::Error>>>,
}

impl ApplicationHandler for App {
    fn can_create_surfaces(&mut self, event_loop: &dyn ActiveEventLoop) {
        if self.running.is_some() {
            return;
        }
        match Running::open(event_loop, self.file.take(), self.stage.take()) {
            Ok(running) => self.running = Some(running),
            Err(error) => {
                *self.failure.lock().unwrap_or_else(std::sync::PoisonError::into_inner) = Some(error);
                event_loop.exit();
            }
        }
    }

    fn proxy_wake_up(&mut self, _: &dyn ActiveEventLoop) {
        if let Some(running) = &mut self.running {
            running.take_pens();
            running.editor.collect();
            running.input.add(running.accessibility.take_requests());
            running.want_frame();
        }
    }

    fn window_event(&mut self, event_loop: &dyn ActiveEventLoop, _: WindowId, event: WindowEvent) {
        if let Some(running) = &mut self.running {
            running.on_event(event_loop, &event);
        }
    }

    fn about_to_wait(&mut self, event_loop: &dyn ActiveEventLoop) {
        let Some(running) = &mut self.running else { return };
        running.take_pens();
        running.editor.submit();
        if let Some(error) = running.broken.take() {
            running.editor.break_off();
            *self.failure.lock().unwrap_or_else(std::sync::PoisonError::into_inner) = Some(error);
            event_loop.exit();
            return;
        }
        if running.ending.is_requested() {
            running.editor.break_off();
            event_loop.exit();
            return;
        }
        if running.editor.is_closed() {
            running.note_size();
            running.editor.shut_down();
            event_loop.exit();
            return;
        }
        running.sleep(event_loop);
    }

    fn destroy_surfaces(&mut self, _: &dyn ActiveEventLoop) {
        if let Some(running) = &mut self.running {
            running.editor.snapshot();
        }
    }
}

/// An open window.
struct Running {
    window: Arc<dyn Window>,
    /// Its size as last reported.
    size: PhysicalSize<u32>,
    graphics: Revival,
    egui: egui::Context,
    input: EguiInput,
    pointers: Pointers,
    /// Room for what they say.
    received: Vec<PointerEvent>,
    editor: Editor,
    accessibility: Accessibility,
    /// Which side of the window has which pointer.
    sides: Sides,
    /// Where the pointer was last seen, points.
    pointer: egui::Pos2,
    /// When egui wants to be drawn again.
    repaint_at: Option<Instant>,
    /// When the window was last asked to wake, whoever wanted it.
    wake_at: Option<Instant>,
    /// A frame was asked for and has not been drawn yet.
    frame_is_due: bool,
    /// Something has happened since the window last came to rest.
    is_awake: bool,
    /// Why the window cannot go on.
    broken: Option<anyhow::Error>,
    /// What the system says of the program's end.
    ending: Ending,
    cursor: egui::CursorIcon,
    composition: Composition,
}

impl Running {
    fn open(
        event_loop: &dyn ActiveEventLoop,
        file: Option<PathBuf>,
        stage: Option<Stage>,
    ) -> anyhow::Result<Self> {
        let proxy = event_loop.create_proxy();
        let ending = Ending::listen({
            let proxy = proxy.clone();
            move || proxy.wake_up()
        });
        let ending = ending.context("no thread for what the system says")?;
        let mut editor = Editor::open(file, {
            let proxy = proxy.clone();
            move || proxy.wake_up()
        })?;
        let attributes = window_size::attributes(event_loop, editor.settings().window);
        let window: Arc<dyn Window> =
            Arc::from(event_loop.create_window(attributes).context("the window cannot be opened")?);
        let accessibility = Accessibility::open(&*window, move || proxy.wake_up());
        let egui = egui::Context::default();
        editor.set_system_theme(event_loop.system_theme().map(egui_input::theme));
        let (pointers, trouble) = match stage {
            Some(stage) => Pointers::replay(event_loop, &*window, stage),
            None => Pointers::open(event_loop, &*window, Pointers::of_machine),
        };
        if let Some(error) = trouble {
            editor.notify(Notice::warning(error.to_string(), ""));
        }
        desktop::fill(&*window, Palette::of(editor.theme()).ground);
        let graphics = Revival::open(event_loop, &window)?;
        let input = EguiInput::new(window.scale_factor() as f32);
        let size = window.surface_size();
        let mut running = Self {
            window,
            size,
            graphics,
            egui,
            input,
            pointers,
            received: Vec::new(),
            editor,
            accessibility,
            sides: Sides::default(),
            pointer: egui::Pos2::ZERO,
            repaint_at: None,
            wake_at: None,
            frame_is_due: true,
            is_awake: true,
            broken: None,
            ending,
            cursor: egui::CursorIcon::Default,
            composition: Composition::default(),
        };
        // The first frame takes longest, for every picture and shader is made for it. It is drawn before the window is seen.
        running.redraw(event_loop);
        running.window.set_visible(true);
        running.want_frame();
        Ok(running)
    }

    fn on_event(&mut self, event_loop: &dyn ActiveEventLoop, event: &WindowEvent) {
        if matches!(event, WindowEvent::RedrawRequested) {
            return self.redraw(event_loop);
        }
        if self.on_system(event_loop, event) {
            self.want_frame();
        }
        if self.on_pointer(event) || self.on_canvas_event(event) || self.on_shortcut(event) {
            self.want_frame();
            return;
        }
        let before = self.input.modifiers();
        if self.input.on_event(event) {
            self.want_frame();
        }
        self.editor.modifiers(before, self.input.modifiers());
        if self.input.take_paste_request() {
            transfer::fetch_clipboard(event_loop);
        }
    }

    /// Handles events of the window as a whole; whether it was that.
    fn on_system(&mut self, event_loop: &dyn ActiveEventLoop, event: &WindowEvent) -> bool {
        self.accessibility.follow(&*self.window, event);
        match event {
            WindowEvent::CloseRequested => self.editor.ask_to_quit(),
            WindowEvent::SurfaceResized(size) => {
                self.size = *size;
                self.graphics.get().into_iter().for_each(|graphics| graphics.resize(*size));
            }
            WindowEvent::Focused(false) => self.editor.snapshot(),
            WindowEvent::Focused(true) => self.editor.ask_system_theme(),
            WindowEvent::ThemeChanged(theme) => self.editor.set_system_theme(Some(egui_input::theme(*theme))),
            WindowEvent::DragEntered { id, .. } => transfer::welcome(event_loop, *id),
            WindowEvent::DragDropped { id, .. } => transfer::fetch_files(event_loop, *id),
            WindowEvent::DataTransferReceived { value, .. } => match transfer::arrival(&**value) {
                Some(Arrival::Text(text)) if self.egui.egui_wants_keyboard_input() => self.input.paste(text),
                Some(Arrival::Text(text)) => self.editor.paste_text(&text),
                Some(Arrival::Files(files)) => self.editor.drop_files(files),
                Some(Arrival::Picture(bytes)) => self.editor.paste_picture(bytes),
                None => return false,
            },
            _ => return false,
        }
        true
    }

    /// Hands a key to the editor unless something is being written; whether it meant something there.
    fn on_shortcut(&mut self, event: &WindowEvent) -> bool {
        if let WindowEvent::KeyboardInput { event: key, .. } = event
            && !self.egui.egui_wants_keyboard_input()
            && let Some(name) = egui_input::key(&key.logical_key)
        {
            return self.editor.key(name, self.input.modifiers(), key.state.is_pressed(), key.repeat);
        }
        false
    }
}
