//! Pictures of the plant, painted on a thread and a graphics device of their own.
//!
//! A driver carries out what one device is asked for in order: behind the picture of a large tree, on which a software
//! driver or an old card works for a good part of a second, ink would wait. So the plant has its own device, and its
//! pictures come to the window as pixels. The window says what it wants to see and never waits; a newer request takes the
//! place of one that was not begun, and pictures come as fast as they are painted, each in the resolution that its
//! quality has on this driver. The thread has a lower priority than the window, and so do the threads of a software driver,
//! which it starts.

use super::{free_memory, growth_spots, priority, texture_files};
use crate::model::Model;
use crate::pipeline::{self, Built};
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

/// The plant that is painted.
#[derive(Clone)]
pub(super) struct Subject {
    pub(super) built: Arc<Built>,
    /// One of its levels of detail, in the place of its own surfaces.
    pub(super) level: Option<Arc<Model>>,
}

/// The answer to a request.
#[derive(Default)]
pub(super) struct Painted {
    /// The picture, unless it would be the one before.
    pub(super) picture: Option<ShownPicture>,
    /// What went wrong; a plant that cannot be shown leaves the one before.
    pub(super) failure: Option<RenderError>,
}

#[derive(Default)]
struct State {
    request: Option<(Scene, Option<Subject>)>,
    is_painting: bool,
    painted: Option<Painted>,
    /// Plants of requests that were replaced: their memory is freed on this thread and not in the window.
    outdated: Vec<Option<Subject>>,
    is_lost: bool,
    is_closing: bool,
}

#[derive(Default)]
struct Shared {
    state: Mutex<State>,
    changed: Condvar,
}

impl Shared {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The painter's end in the window; dropping it ends the thread, after the picture that it is at.
pub(super) struct PlantPainter {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
    /// What was requested last.
    requested: Option<Scene>,
}

impl PlantPainter {
    /// Starts the thread, which opens its device. `wake` is called on it whenever there is something to take.
    ///
    /// # Errors
    /// A system that gives no thread.
    pub(super) fn start(wake: impl Fn() + Send + 'static) -> std::io::Result<Self> {
        let shared = Arc::new(Shared::default());
        let for_thread = Arc::clone(&shared);
        let name = "plant painter".to_owned();
        let thread = std::thread::Builder::new().name(name).spawn(move || paint(&for_thread, &wake))?;
        Ok(Self { shared, thread: Some(thread), requested: None })
    }

    /// Requests a picture, unless it is the one that was requested last.
    pub(super) fn request(&mut self, scene: Scene, subject: Option<Subject>) {
        if self.requested.as_ref() == Some(&scene) {
            return;
        }
        self.requested = Some(scene.clone());
        let mut state = self.shared.state();
        let outdated = state.request.replace((scene, subject));
        state.outdated.extend(outdated.map(|(_, subject)| subject));
        drop(state);
        self.shared.changed.notify_one();
    }

    /// What was painted last and not taken yet.
    pub(super) fn take(&self) -> Option<Painted> {
        self.shared.state().painted.take()
    }

    /// Whether a picture is still to come.
    pub(super) fn is_busy(&self) -> bool {
        let state = self.shared.state();
        !state.is_lost && (state.is_painting || state.request.is_some() || state.painted.is_some())
    }

    /// Whether its device is gone.
    pub(super) fn is_lost(&self) -> bool {
        self.shared.state().is_lost
    }
}

impl Drop for PlantPainter {
    fn drop(&mut self) {
        self.shared.state().is_closing = true;
        self.shared.changed.notify_one();
        if let Some(thread) = self.thread.take() {
            // A painter that panicked has been reported by the panic hook.
            let _ = thread.join();
        }
    }
}

/// The painter's thread.
fn paint(shared: &Shared, wake: &dyn Fn()) {
    priority::step_back();
    let mut painter = match Painter::open() {
        Ok(painter) => painter,
        Err(failure) => {
            let mut state = shared.state();
            state.is_lost = true;
            state.painted = Some(Painted { failure: Some(failure), ..Painted::default() });
            drop(state);
            return wake();
        }
    };
    let mut has_worked = true;
    while let Some((scene, subject)) = next(shared, &mut has_worked) {
        let painted = painter.paint(&scene, subject.as_ref());
        drop(subject);
        let mut state = shared.state();
        state.is_painting = false;
        state.is_lost = painter.renderer.is_lost();
        // A picture that the window has not taken yet is outdated, a failure is not.
        let unseen = state.painted.take().unwrap_or_default();
        state.painted = Some(Painted {
            picture: painted.picture.or(unseen.picture),
            failure: painted.failure.or(unseen.failure),
        });
        let is_lost = state.is_lost;
        drop(state);
        wake();
        if is_lost {
            return;
        }
    }
}

/// Waits for a request; `None` when the window closes.
fn next(shared: &Shared, has_worked: &mut bool) -> Option<(Scene, Option<Subject>)> {
    let mut state = shared.state();
    loop {
        if state.is_closing {
            return None;
        }
        let outdated = std::mem::take(&mut state.outdated);
        if let Some(request) = state.request.take() {
            (state.is_painting, *has_worked) = (true, true);
            drop(state);
            drop(outdated);
            return Some(request);
        }
        state = free_memory::wait(&shared.state, &shared.changed, state, has_worked);
    }
}

/// What it paints with.
struct Painter {
    renderer: Renderer,
    viewport: Viewport,
    /// The plant that the viewport has.
    plant: u64,
}

impl Painter {
    fn open() -> Result<Self, RenderError> {
        let renderer = Renderer::new()?;
        let viewport = Viewport::new(&renderer)?;
        tracing::debug!("the plant is painted by {}", renderer.adapter());
        Ok(Self { renderer, viewport, plant: 0 })
    }

    fn paint(&mut self, scene: &Scene, subject: Option<&Subject>) -> Painted {
        let shown = subject.map_or(Ok(()), |subject| self.show(scene.plant, subject));
        let painted = self.draw(scene);
        let (picture, failed) = painted.map_or_else(|error| (None, Some(error)), |picture| (picture, None));
        Painted { picture, failure: shown.err().or(failed) }
    }

    fn show(&mut self, plant: u64, Subject { built, level }: &Subject) -> Result<(), RenderError> {
        if std::mem::replace(&mut self.plant, plant) == plant {
            return Ok(());
        }
        let seen = pipeline::seen_as(built, level.as_deref().unwrap_or(&built.model));
        let stats = self.viewport.update(&self.renderer, seen, &texture_files::texture)?;
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
