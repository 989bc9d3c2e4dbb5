//! Pictures of the plant, painted on a thread and a graphics device of their own.
//!
//! A driver carries out what one device is asked for in order: behind the picture of a large tree, on which a software
//! driver or an old card works for a good part of a second, ink would wait. So the plant has its own device, and its
//! pictures come to the window as pixels. The window says what it wants to see and never waits; a newer wish takes the
//! place of one that was not begun, and pictures come as fast as they are painted, each in the resolution that its
//! quality has on this driver. The thread steps back behind the window, and so do the threads of a software driver,
//! which it starts.

use super::{free_memory, growth_spots, priority, texture_files};
use crate::pipeline::Built;
use crate::render::{Look, OrbitCamera, RenderError, Renderer, ShownPicture, Viewport};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;

/// What a picture shows: the same twice is the same picture.
#[derive(Clone, PartialEq)]
pub(super) struct Scene {
    /// Width and height in pixels, neither zero.
    pub(super) size: (u32, u32),
    pub(super) camera: OrbitCamera,
    pub(super) look: Look,
    /// Grows with every plant.
    pub(super) plant: u64,
}

/// What came of a wish.
#[derive(Default)]
pub(super) struct Painted {
    /// The picture, unless it would be the one before.
    pub(super) picture: Option<ShownPicture>,
    /// What went wrong; a plant that cannot be shown leaves the one before.
    pub(super) failure: Option<RenderError>,
}

#[derive(Default)]
struct Desk {
    wish: Option<(Scene, Option<Arc<Built>>)>,
    is_painting: bool,
    painted: Option<Painted>,
    /// Plants of wishes that nobody has begun: their memory is given back here and not by the window.
    outdated: Vec<Option<Arc<Built>>>,
    is_lost: bool,
    is_closing: bool,
}

#[derive(Default)]
struct Shared {
    desk: Mutex<Desk>,
    news: Condvar,
}

impl Shared {
    fn desk(&self) -> MutexGuard<'_, Desk> {
        self.desk.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The painter's end in the window; dropping it ends the thread, after the picture that it is at.
pub(super) struct PlantPainter {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
    /// What was wished for last.
    wished: Option<Scene>,
}

impl PlantPainter {
    /// Starts the thread, which opens its device. `wake` is called on it whenever there is something to take.
    ///
    /// # Errors
    /// A system that gives no thread.
    pub(super) fn start(wake: impl Fn() + Send + 'static) -> std::io::Result<Self> {
        let shared = Arc::new(Shared::default());
        let theirs = Arc::clone(&shared);
        let name = "plant painter".to_owned();
        let thread = std::thread::Builder::new().name(name).spawn(move || paint(&theirs, &wake))?;
        Ok(Self { shared, thread: Some(thread), wished: None })
    }

    /// Wishes for a picture, unless it is the one that was wished for last.
    pub(super) fn wish(&mut self, scene: Scene, built: Option<&Arc<Built>>) {
        if self.wished.as_ref() == Some(&scene) {
            return;
        }
        self.wished = Some(scene.clone());
        let mut desk = self.shared.desk();
        let outdated = desk.wish.replace((scene, built.map(Arc::clone)));
        desk.outdated.extend(outdated.map(|(_, built)| built));
        drop(desk);
        self.shared.news.notify_one();
    }

    /// What was painted last and not taken yet.
    pub(super) fn take(&self) -> Option<Painted> {
        self.shared.desk().painted.take()
    }

    /// Whether a picture is still to come.
    pub(super) fn is_busy(&self) -> bool {
        let desk = self.shared.desk();
        !desk.is_lost && (desk.is_painting || desk.wish.is_some() || desk.painted.is_some())
    }

    /// Whether its device is gone.
    pub(super) fn is_lost(&self) -> bool {
        self.shared.desk().is_lost
    }
}

impl Drop for PlantPainter {
    fn drop(&mut self) {
        self.shared.desk().is_closing = true;
        self.shared.news.notify_one();
        if let Some(thread) = self.thread.take() {
            // A painter that panicked has been reported by the panic hook.
            let _ = thread.join();
        }
    }
}

/// The painter's thread.
fn paint(shared: &Shared, wake: &dyn Fn()) {
    priority::step_back();
    let mut easel = match Easel::open() {
        Ok(easel) => easel,
        Err(failure) => {
            let mut desk = shared.desk();
            desk.is_lost = true;
            desk.painted = Some(Painted { failure: Some(failure), ..Painted::default() });
            drop(desk);
            return wake();
        }
    };
    let mut has_worked = true;
    while let Some((scene, built)) = next(shared, &mut has_worked) {
        let painted = easel.paint(&scene, built.as_deref());
        drop(built);
        let mut desk = shared.desk();
        desk.is_painting = false;
        desk.is_lost = easel.renderer.is_lost();
        // A picture that the window has not taken yet is outdated, a failure is not.
        let unseen = desk.painted.take().unwrap_or_default();
        desk.painted = Some(Painted {
            picture: painted.picture.or(unseen.picture),
            failure: painted.failure.or(unseen.failure),
        });
        let is_lost = desk.is_lost;
        drop(desk);
        wake();
        if is_lost {
            return;
        }
    }
}

/// Waits for a wish; `None` when the window closes.
fn next(shared: &Shared, has_worked: &mut bool) -> Option<(Scene, Option<Arc<Built>>)> {
    let mut desk = shared.desk();
    loop {
        if desk.is_closing {
            return None;
        }
        let outdated = std::mem::take(&mut desk.outdated);
        if let Some(wish) = desk.wish.take() {
            (desk.is_painting, *has_worked) = (true, true);
            drop(desk);
            drop(outdated);
            return Some(wish);
        }
        desk = free_memory::wait(&shared.desk, &shared.news, desk, has_worked);
    }
}

/// What it paints with.
struct Easel {
    renderer: Renderer,
    viewport: Viewport,
    /// The plant that the viewport has.
    plant: u64,
}

impl Easel {
    fn open() -> Result<Self, RenderError> {
        let renderer = Renderer::new()?;
        let viewport = Viewport::new(&renderer)?;
        tracing::debug!("the plant is painted by {}", renderer.adapter());
        Ok(Self { renderer, viewport, plant: 0 })
    }

    fn paint(&mut self, scene: &Scene, built: Option<&Built>) -> Painted {
        let shown = built.map_or(Ok(()), |built| self.show(scene.plant, built));
        let painted = self.draw(scene);
        let (picture, failed) = painted.map_or_else(|error| (None, Some(error)), |picture| (picture, None));
        Painted { picture, failure: shown.err().or(failed) }
    }

    fn show(&mut self, plant: u64, built: &Built) -> Result<(), RenderError> {
        if std::mem::replace(&mut self.plant, plant) == plant {
            return Ok(());
        }
        let stats = self.viewport.update(&self.renderer, &built.model, &texture_files::texture)?;
        tracing::debug!("uploaded {} of {} parts", stats.uploaded_parts, stats.parts);
        self.viewport.set_overlay(&self.renderer, &growth_spots::drawn(&built.overlay));
        Ok(())
    }

    fn draw(&mut self, scene: &Scene) -> Result<Option<ShownPicture>, RenderError> {
        self.viewport.set_size(scene.size.0, scene.size.1);
        let is_new = self.viewport.draw(&self.renderer, &scene.camera, &scene.look)?;
        is_new.then(|| self.viewport.read(&self.renderer)).transpose()
    }
}
