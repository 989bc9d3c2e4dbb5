//! Text that the system composes, as Chinese is written: where in the window it is written, and when no longer.

use winit::dpi::{LogicalPosition, LogicalSize, Position, Size};
use winit::window::{ImeCapabilities, ImeEnableRequest, ImeRequest, ImeRequestData, Window};

/// The system's text composition.
#[derive(Default)]
pub(super) struct Composition {
    is_on: bool,
}

impl Composition {
    /// Tells the system where egui wants text; `None` where it wants none.
    pub(super) fn follow(
        &mut self,
        window: &dyn Window,
        wanted: Option<egui::output::IMEOutput>,
        scale: f64,
    ) {
        let Some(ime) = wanted else {
            if std::mem::take(&mut self.is_on) {
                // Switching off what is off is no matter.
                let _ = window.request_ime_update(ImeRequest::Disable);
            }
            return;
        };
        let (corner, size) = (ime.cursor_rect.min, ime.cursor_rect.size());
        let position = LogicalPosition::new(f64::from(corner.x), f64::from(corner.y));
        let size = LogicalSize::new(f64::from(size.x.max(1.0)), f64::from(size.y));
        let position = Position::Physical(position.to_physical(scale));
        let data = ImeRequestData::default().with_cursor_area(position, Size::Logical(size));
        let request = if self.is_on {
            Some(ImeRequest::Update(data))
        } else {
            let able = ImeCapabilities::new().with_cursor_area();
            ImeEnableRequest::new(able, data).map(ImeRequest::Enable)
        };
        // A system without text composition refuses; plain keys still write.
        if let Some(request) = request {
            self.is_on = window.request_ime_update(request).is_ok();
        }
    }
}
