//! When the window is drawn: frames that were asked for, what they ask of the system, and sleep until the next.

use super::Running;
use crate::app::editor::Copied;
use crate::app::revival::Revived;
use crate::app::{egui_input, transfer};
use std::time::{Duration, Instant};
use winit::cursor::Cursor;
use winit::event_loop::{ActiveEventLoop, ControlFlow};

/// A window that nothing will change for so long is at rest.
const REST: Duration = Duration::from_millis(300);
/// Longest sleep that egui can ask for; longer means never.
const NEVER: Duration = Duration::from_secs(3600);

impl Running {
    /// Asks for a frame.
    pub(super) fn want_frame(&mut self) {
        if !std::mem::replace(&mut self.is_awake, true) {
            tracing::debug!("awake");
        }
        self.frame_is_due = true;
        self.window.request_redraw();
    }

    pub(super) fn redraw(&mut self, event_loop: &dyn ActiveEventLoop) {
        self.frame_is_due = false;
        self.revive(event_loop);
        let Some(graphics) = self.graphics.get() else { return };
        let raw = self.input.take(graphics.size());
        let (editor, plant) = (&mut self.editor, graphics.plant_texture());
        self.accessibility.prepare(&self.egui);
        let mut output = self.egui.run_ui(raw, |ui| editor.ui(ui, plant));
        let delay = output.viewport_output.get(&egui::ViewportId::ROOT).map_or(NEVER, |v| v.repaint_delay);
        self.accessibility.show(&mut output.platform_output);
        self.heed(event_loop, &mut output);
        if let Some(graphics) = self.graphics.get() {
            graphics.draw(&self.egui, output, &mut self.editor);
            let (is_lost, is_unfinished) = (graphics.is_lost(), graphics.is_unfinished());
            if is_lost {
                self.editor.snapshot();
            }
            if is_lost || is_unfinished {
                self.want_frame();
            }
        }
        // From the moment when the frame is there, however long that took.
        self.repaint_at = (delay < NEVER).then(|| Instant::now() + delay);
    }

    /// Sees to it that there is something to draw with.
    fn revive(&mut self, event_loop: &dyn ActiveEventLoop) {
        match self.graphics.revive(event_loop) {
            Revived::NotLost => {}
            Revived::Anew => {
                // egui believes that its pictures are on the device: a new context sends them again.
                self.egui = egui::Context::default();
                self.editor.forget_textures();
                self.editor.notify_graphics_are_back();
                if let Some(graphics) = self.graphics.get() {
                    graphics.grow_stroke(&self.editor);
                }
            }
            Revived::NotYet(next) => self.repaint_at = Some(next),
            Revived::Never(error) => {
                let kept = "the graphics device was lost; the drawing is kept and offered at the next start";
                self.broken = Some(error.context(kept));
            }
        }
    }

    /// Carries out what egui asks of the system.
    fn heed(&mut self, event_loop: &dyn ActiveEventLoop, output: &mut egui::FullOutput) {
        for command in output.platform_output.commands.drain(..) {
            match command {
                egui::OutputCommand::CopyText(text) => transfer::copy_text(event_loop, text),
                egui::OutputCommand::CopyImage(picture) => transfer::copy_picture(event_loop, &picture),
                egui::OutputCommand::OpenUrl(_) | egui::OutputCommand::TextSelectionSettled(_) => {}
            }
        }
        match self.editor.take_copied() {
            Some(Copied::Picture(picture)) => transfer::copy_picture(event_loop, &picture),
            Some(Copied::Text(text)) => transfer::copy_text(event_loop, text),
            None => {}
        }
        if self.editor.take_paste_request() {
            transfer::fetch_clipboard(event_loop);
        }
        let cursor = if self.sides.is_over_canvas() {
            self.editor.cursor()
        } else {
            output.platform_output.cursor_icon
        };
        if std::mem::replace(&mut self.cursor, cursor) != cursor {
            self.window.set_cursor_visible(cursor != egui::CursorIcon::None);
            if let Some(icon) = egui_input::cursor(cursor) {
                self.window.set_cursor(Cursor::Icon(icon));
            }
        }
        if let Some(title) = self.editor.take_title() {
            self.window.set_title(&title);
        }
        let scale = f64::from(self.input.pixels_per_point());
        self.composition.follow(&*self.window, output.platform_output.ime, scale);
    }

    /// Remembers how large the window is. Asked for at rest: while a window is being maximised it has its new size, but does
    /// not say yet why.
    pub(super) fn note_size(&mut self) {
        let (scale, is_maximised) = (self.window.scale_factor(), self.window.is_maximized());
        self.editor.note_window(self.size, scale, is_maximised);
    }

    /// Sleeps until the next event or the next moment that somebody named.
    pub(super) fn sleep(&mut self, event_loop: &dyn ActiveEventLoop) {
        let now = Instant::now();
        let is_due = |at: Option<Instant>| at.is_some_and(|at| at <= now);
        if self.editor.wants_frame() || is_due(self.repaint_at) || is_due(self.wake_at) {
            self.repaint_at = None;
            self.want_frame();
        }
        self.wake_at =
            [self.repaint_at, self.editor.wakes_at(), self.pointers.leaves_at()].into_iter().flatten().min();
        // A frame that is due wakes the window itself, and until it is drawn nothing else needs to.
        let wake = self.wake_at.filter(|_| !self.frame_is_due);
        event_loop.set_control_flow(wake.map_or(ControlFlow::Wait, ControlFlow::WaitUntil));
        let is_painting = self.graphics.get().is_some_and(|graphics| graphics.is_painting());
        let rests = !self.frame_is_due
            && !self.editor.is_working()
            && !is_painting
            && wake.is_none_or(|at| at > now + REST);
        if rests && std::mem::take(&mut self.is_awake) {
            self.note_size();
            match self.editor.dialog() {
                None => tracing::debug!("at rest"),
                Some(dialog) => tracing::debug!("at rest in the dialog {}", dialog.name()),
            }
        }
    }
}
