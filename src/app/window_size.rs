//! How large the window was when it was last at rest, and how it is opened in the next session.
//!
//! Limits: where the window stood is the window manager's; most place windows better than programs do, and Wayland lets
//! no program.

use serde::{Deserialize, Serialize};
use winit::dpi::{LogicalSize, PhysicalSize};
use winit::event_loop::ActiveEventLoop;
use winit::window::WindowAttributes;

/// Smallest window that still shows everything, logical pixels.
pub const SMALLEST: (f64, f64) = (640.0, 480.0);
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

    /// The same on the largest of these monitors, which may have been larger the last time; without monitors as it is.
    pub fn on(self, monitors: impl Iterator<Item = LogicalSize<f64>>) -> Self {
        let Some(room) = monitors.max_by(|a, b| (a.width * a.height).total_cmp(&(b.width * b.height))) else {
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

/// How a window of this size is opened, as far as the monitors have room.
pub(super) fn attributes(event_loop: &dyn ActiveEventLoop, size: WindowSize) -> WindowAttributes {
    let size = size.on(monitors(event_loop));
    let attributes = WindowAttributes::default()
        .with_title("Penstemon")
        .with_surface_size(LogicalSize::new(size.width, size.height))
        .with_min_surface_size(LogicalSize::<f64>::from(SMALLEST))
        .with_maximized(size.maximised);
    named(event_loop, attributes)
}

/// How large the monitors are.
fn monitors(event_loop: &dyn ActiveEventLoop) -> impl Iterator<Item = LogicalSize<f64>> {
    event_loop
        .available_monitors()
        .filter_map(|monitor| Some(monitor.current_video_mode()?.size().to_logical(monitor.scale_factor())))
}

/// Names the window as the menu entry is named, so that the desktop shows its icon.
#[cfg(target_os = "linux")]
fn named(event_loop: &dyn ActiveEventLoop, attributes: WindowAttributes) -> WindowAttributes {
    use winit::platform::{wayland, x11};
    const NAME: &str = "org.penstemon.Penstemon";
    if wayland::ActiveEventLoopExtWayland::is_wayland(event_loop) {
        let named = wayland::WindowAttributesWayland::default().with_name(NAME, "penstemon");
        attributes.with_platform_attributes(Box::new(named))
    } else {
        let named = x11::WindowAttributesX11::default().with_name(NAME, "penstemon");
        attributes.with_platform_attributes(Box::new(named))
    }
}

#[cfg(not(target_os = "linux"))]
fn named(_: &dyn ActiveEventLoop, attributes: WindowAttributes) -> WindowAttributes {
    attributes
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
