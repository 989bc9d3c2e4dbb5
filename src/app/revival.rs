//! The window's graphics through losses of the device.
//!
//! Drivers are reset and cards unplugged. Then everything on the card is let go first, because a window can belong to
//! one device only, and made again on whichever adapter there is now; while there is none it is tried again, for a
//! driver needs a moment to come back. Meanwhile the editor goes on without pictures.

use super::graphics::Graphics;
use std::sync::Arc;
use std::time::{Duration, Instant};
use winit::event_loop::ActiveEventLoop;
use winit::window::Window;

/// Between two tries to open a device.
const TRY_AGAIN: Duration = Duration::from_millis(500);
/// How long it is tried.
const GIVE_UP: Duration = Duration::from_secs(10);

/// Graphics that may be lost.
pub(super) struct Revival {
    window: Arc<dyn Window>,
    graphics: Option<Graphics>,
    /// Since when there are none.
    lost: Option<Instant>,
    /// When it was last tried to open them again.
    tried: Option<Instant>,
}

/// What became of the graphics.
pub(super) enum Revived {
    /// Nothing was lost.
    NotLost,
    /// All was lost and made again.
    Anew,
    /// All is lost; the next try is due then.
    NotYet(Instant),
    /// All is lost, and nothing can be opened.
    Never(anyhow::Error),
}

impl Revival {
    /// Opens a window's graphics.
    ///
    /// # Errors
    /// Those of [`Graphics::open`].
    pub(super) fn open(event_loop: &dyn ActiveEventLoop, window: &Arc<dyn Window>) -> anyhow::Result<Self> {
        let graphics = Graphics::open(event_loop, window)?;
        tracing::debug!("the window is drawn by {}", graphics.adapter());
        Ok(Self { window: Arc::clone(window), graphics: Some(graphics), lost: None, tried: None })
    }

    /// The graphics; `None` between a loss and the next device.
    pub(super) fn get(&mut self) -> Option<&mut Graphics> {
        self.graphics.as_mut()
    }

    /// Makes lost graphics again.
    pub(super) fn revive(&mut self, event_loop: &dyn ActiveEventLoop) -> Revived {
        if self.graphics.as_ref().is_some_and(|graphics| !graphics.is_lost()) {
            return Revived::NotLost;
        }
        self.graphics = None;
        let now = Instant::now();
        let since = *self.lost.get_or_insert(now);
        if let Some(next) = self.tried.map(|at| at + TRY_AGAIN).filter(|next| *next > now) {
            return Revived::NotYet(next);
        }
        match Self::open(event_loop, &self.window) {
            Ok(anew) => {
                *self = anew;
                Revived::Anew
            }
            Err(error) if since.elapsed() >= GIVE_UP => Revived::Never(error),
            Err(error) => {
                tracing::warn!("no graphics device yet: {error:#}");
                self.tried = Some(Instant::now());
                Revived::NotYet(Instant::now() + TRY_AGAIN)
            }
        }
    }
}
