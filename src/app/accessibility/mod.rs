//! Screen readers and other assistive programs: what the widgets are called, where they are, and pressing them from outside.
//!
//! egui describes its widgets as an AccessKit tree. AccessKit's adapter for winit serves winit 0.30 only, so the window drives
//! the adapters below it itself: `linux.rs` AT-SPI, `windows.rs` UI Automation. An adapter asks for the tree once an
//! assistive program wants it; until then no tree is made. Requests come from threads of the adapter and are carried out by
//! the next frame.
//!
//! Limits: strokes on the canvas and the plant are not described. On macOS (`absent.rs`) the adapter can be attached by unsafe
//! code only.

#[cfg_attr(windows, path = "windows.rs")]
#[cfg_attr(target_os = "linux", path = "linux.rs")]
#[cfg_attr(not(any(windows, target_os = "linux")), path = "absent.rs")]
mod adapter;

use adapter::Adapter;
use egui::accesskit::{ActionHandler, ActionRequest, ActivationHandler, DeactivationHandler, TreeUpdate};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use winit::event::WindowEvent;
use winit::window::Window;

type Wake = Arc<dyn Fn() + Send + Sync>;

/// The way between the window and assistive programs.
pub(super) struct Accessibility {
    adapter: Option<Adapter>,
    is_wanted: Arc<AtomicBool>,
    requests: Receiver<ActionRequest>,
}

impl Accessibility {
    /// Offers a window that was not shown yet; `wake` is called from other threads when there is something to do.
    pub(super) fn open(window: &dyn Window, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let wake: Wake = Arc::new(wake);
        let is_wanted = Arc::new(AtomicBool::new(false));
        let (send, requests) = channel();
        let switch = Switch { is_wanted: Arc::clone(&is_wanted), wake: Arc::clone(&wake) };
        let adapter = Adapter::open(window, switch, Requests { send, wake });
        Self { adapter, is_wanted, requests }
    }

    /// Lets egui describe the coming frame if an assistive program wants that.
    pub(super) fn prepare(&self, egui: &egui::Context) {
        if self.is_wanted.load(Ordering::Acquire) {
            egui.enable_accesskit();
        } else {
            egui.disable_accesskit();
        }
    }

    /// Hands on what a frame shows.
    pub(super) fn show(&mut self, output: &mut egui::PlatformOutput) {
        if let (Some(adapter), Some(tree)) = (&mut self.adapter, output.accesskit_update.take()) {
            adapter.show(tree);
        }
    }

    /// What was asked from outside since the last call, as events for egui.
    pub(super) fn take_requests(&self) -> impl Iterator<Item = egui::Event> {
        self.requests.try_iter().map(egui::Event::AccessKitActionRequest)
    }

    /// Follows the window's focus and place.
    pub(super) fn follow(&mut self, window: &dyn Window, event: &WindowEvent) {
        let Some(adapter) = &mut self.adapter else { return };
        match event {
            WindowEvent::Focused(is_focused) => adapter.focus(*is_focused),
            WindowEvent::Moved(_) | WindowEvent::SurfaceResized(_) => adapter.place(window),
            _ => {}
        }
    }
}

/// Is called when assistive programs begin and cease to want the tree. The next frame makes it.
#[derive(Clone)]
struct Switch {
    is_wanted: Arc<AtomicBool>,
    wake: Wake,
}

impl ActivationHandler for Switch {
    fn request_initial_tree(&mut self) -> Option<TreeUpdate> {
        self.is_wanted.store(true, Ordering::Release);
        (self.wake)();
        None
    }
}

impl DeactivationHandler for Switch {
    fn deactivate_accessibility(&mut self) {
        self.is_wanted.store(false, Ordering::Release);
    }
}

/// Is called with what assistive programs ask of widgets.
struct Requests {
    send: Sender<ActionRequest>,
    wake: Wake,
}

impl ActionHandler for Requests {
    fn do_action(&mut self, request: ActionRequest) {
        // A window that closed takes no requests any more.
        let _ = self.send.send(request);
        (self.wake)();
    }
}
