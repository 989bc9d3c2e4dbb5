//! How large the window was when it was last at rest, and how it is opened in the next session.
//!
//! Limits: where the window stood is the window manager's; most place windows better than programs do, and Wayland lets
//! no program.

use super::desktop;
use serde::{Deserialize, Serialize};
use winit::dpi::{LogicalSize, PhysicalSize};
use winit::event_loop::ActiveEventLoop;
use winit::window::WindowAttributes;

/// Smallest window that still shows everything, logical pixels.
pub const SMALLEST: (f64, f64) = (640.0, 480.0);
/// Height that the title bar of a usual desktop takes, logical pixels.
const TITLE_BAR: f64 = 40.0;
/// Larger than any monitor, logical pixels; a number beyond is a mistake.
const LARGEST: f64 = 16_384.0;

/// How large the window is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct WindowSize {
    /// Width in logical pixels; that of the restored window where it is maximised.
    pub width: f64,
    /// Height in logical pixels, likewise.
    pub height: f64,
    /// Whether the window fills its monitor.
    pub maximised: bool,
}

impl Default for WindowSize {
    fn default() -> Self {
        Self { width: 1280.0, height: 800.0, maximised: false }
    }
}

impl WindowSize {
    /// The same without what cannot be: from a file that anybody may have edited.
    pub fn sane(self) -> Self {
        let whole = Self::default();
        let side = |side: f64, least: f64, first: f64| {
            if side.is_finite() { side.clamp(least, LARGEST) } else { first }
        };
        Self {
            width: side(self.width, SMALLEST.0, whole.width),
            height: side(self.height, SMALLEST.1, whole.height),
            maximised: self.maximised,
        }
    }

    /// The same in the largest of these rooms on monitors, which may have been larger the last time; without one as it is.
    pub fn on(self, rooms: impl Iterator<Item = LogicalSize<f64>>) -> Self {
        let Some(room) = rooms.max_by(|a, b| (a.width * a.height).total_cmp(&(b.width * b.height))) else {
            return self;
        };
        Self { width: self.width.min(room.width), height: self.height.min(room.height), ..self }.sane()
    }

    /// Follows a window. A maximised one is restored to the size that it had before; one without area has no size.
    pub fn follow(&mut self, size: PhysicalSize<u32>, scale: f64, maximised: bool) {
        self.maximised = maximised;
        if !maximised && size.width > 0 && size.height > 0 {
            let LogicalSize { width, height } = size.to_logical(scale);
            *self = Self { width, height, maximised }.sane();
        }
    }
}

/// How a window of this size is opened, as far as the monitors have room. It is not seen before it is shown.
pub(super) fn attributes(event_loop: &dyn ActiveEventLoop, size: WindowSize) -> WindowAttributes {
    let size = size.on(rooms(event_loop));
    let attributes = WindowAttributes::default()
        .with_title("Penstemon")
        .with_surface_size(LogicalSize::new(size.width, size.height))
        .with_min_surface_size(LogicalSize::<f64>::from(SMALLEST))
        .with_visible(false)
        .with_maximized(size.maximised);
    desktop::named(event_loop, attributes)
}

/// How much room the monitors have for what is in a window.
fn rooms(event_loop: &dyn ActiveEventLoop) -> impl Iterator<Item = LogicalSize<f64>> {
    let work_area = desktop::work_area(event_loop);
    event_loop.available_monitors().filter_map(move |monitor| {
        let (size, scale) = (monitor.current_video_mode()?.size(), monitor.scale_factor());
        Some(room(size.to_logical(scale), work_area.map(|area| area.to_logical(scale))))
    })
}

/// How much room for what is in a window a monitor has where the desktop's panels leave so much of it; all of it where no
/// desktop says so.
fn room(monitor: LogicalSize<f64>, work_area: Option<LogicalSize<f64>>) -> LogicalSize<f64> {
    work_area.map_or(monitor, |area| {
        LogicalSize::new(monitor.width.min(area.width), monitor.height.min(area.height) - TITLE_BAR)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const USUAL: WindowSize = WindowSize { width: 1500.0, height: 900.0, maximised: false };

    #[test]
    fn sizes_that_cannot_be_are_none() {
        let odd = WindowSize { width: f64::NAN, height: 3.0, maximised: true };
        assert_eq!(odd.sane(), WindowSize { width: 1280.0, height: SMALLEST.1, maximised: true });
        assert_eq!(WindowSize { width: 1e12, ..USUAL }.sane().width, LARGEST);
        assert_eq!(USUAL.sane(), USUAL);
    }

    #[test]
    fn a_window_fits_on_the_largest_monitor_there_is() {
        let on = |monitors: &[(f64, f64)]| {
            let WindowSize { width, height, .. } =
                USUAL.on(monitors.iter().map(|&(width, height)| LogicalSize { width, height }));
            (width, height)
        };
        assert_eq!(on(&[]), (1500.0, 900.0));
        assert_eq!(on(&[(1920.0, 1080.0), (800.0, 600.0)]), (1500.0, 900.0));
        assert_eq!(on(&[(1280.0, 1024.0)]), (1280.0, 900.0));
        assert_eq!(on(&[(1366.0, 768.0)]), (1366.0, 768.0));
        assert_eq!(on(&[(10.0, 10.0)]), SMALLEST, "a monitor that says nonsense");
    }

    #[test]
    fn panels_and_the_title_bar_take_their_room() {
        let size = |width, height| LogicalSize { width, height };
        assert_eq!(room(size(1280.0, 800.0), None), size(1280.0, 800.0), "nobody who would draw a title bar");
        assert_eq!(room(size(1280.0, 800.0), Some(size(1280.0, 760.0))), size(1280.0, 720.0));
        assert_eq!(
            room(size(1280.0, 800.0), Some(size(3200.0, 1040.0))),
            size(1280.0, 760.0),
            "two monitors"
        );
    }

    #[test]
    fn a_maximised_window_remembers_what_it_is_restored_to() {
        let mut size = USUAL;
        size.follow(PhysicalSize::new(2560, 1600), 1.0, true);
        assert_eq!(size, WindowSize { maximised: true, ..USUAL });
        size.follow(PhysicalSize::new(0, 0), 1.0, false);
        assert_eq!(size, USUAL);
        size.follow(PhysicalSize::new(2000, 1200), 2.0, false);
        assert_eq!((size.width, size.height), (1000.0, 600.0));
    }
}
