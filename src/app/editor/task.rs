//! Work on threads of its own; and exports, which have progress and can be stopped.
//!
//! Files are written whole or not at all, so a stopped export leaves no half file; of a turntable the pictures already
//! written stay.

use super::Editor;
use super::estimate::is_wanted;
use crate::app::messages::{Localize, Msg};
use crate::app::panels::snapshot::{self, ExportChoice, ExportFormat, Notice};
use crate::app::plant_view::{self, built_in_texture};
use crate::formats::textures;
use crate::formats::write::{self, ExportError};
use crate::input::Sources;
use crate::model::Model;
use crate::pipeline::{self, Built};
use crate::render::{LightParams, OrbitCamera, Renderer};
use crate::sketch::Sketch;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// Calls from other threads that there is something to collect.
pub(super) type Wake = Arc<dyn Fn() + Send + Sync>;

/// Something that another thread does.
pub(super) struct Work<T>(Receiver<T>);

impl<T> Work<T> {
    /// What came of it, once it has ended; nothing in it if it broke off.
    pub(super) fn result(&self) -> Option<Option<T>> {
        match self.0.try_recv() {
            Ok(result) => Some(Some(result)),
            Err(TryRecvError::Disconnected) => Some(None),
            Err(TryRecvError::Empty) => None,
        }
    }

    /// Waits for what comes of it; nothing if it breaks off.
    pub(super) fn wait(&self) -> Option<T> {
        self.0.recv().ok()
    }
}

/// Wakes the window when it goes, whatever became of the work.
struct Farewell(Wake);

impl Drop for Farewell {
    fn drop(&mut self) {
        (self.0)();
    }
}

/// Begins to do something on a thread of its own; the window is woken at its end.
///
/// # Errors
/// A system without threads.
pub(super) fn begin<T: Send + 'static>(
    name: &str,
    wake: &Wake,
    work: impl FnOnce() -> T + Send + 'static,
) -> std::io::Result<Work<T>> {
    let (tell, done) = channel();
    let farewell = Farewell(Arc::clone(wake));
    let work = move || {
        let _farewell = farewell;
        // Dropped before the farewell: whoever is woken finds the end, also of work that broke off.
        let tell = tell;
        // A window that closed does not listen any more.
        let _ = tell.send(work());
    };
    std::thread::Builder::new().name(name.into()).spawn(work)?;
    Ok(Work(done))
}

/// What kept an export from being made.
type Failure = Box<dyn Localize + Send>;

fn boxed(error: impl Localize + Send + 'static) -> Failure {
    Box::new(error)
}

/// An export under way.
pub(super) struct Task {
    name: String,
    shared: Arc<Shared>,
    work: Work<Result<usize, Failure>>,
}

#[derive(Default)]
struct Shared {
    /// In thousandths.
    progress: AtomicU32,
    stop: AtomicBool,
}

impl Shared {
    fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    fn advance(&self, share: f32) {
        self.progress.store((share * 1e3) as u32, Ordering::Relaxed);
    }
}

/// What an export needs, taken at its start: the artist goes on drawing.
struct Order {
    path: PathBuf,
    choice: ExportChoice,
    sketch: Sketch,
    built: Arc<Built>,
    camera: OrbitCamera,
    light: LightParams,
    /// The files that the plant comes from.
    sources: Sources,
}

impl Editor {
    /// Starts an export.
    pub(super) fn begin_export(&mut self, path: PathBuf) {
        let Some(built) = self.built.clone() else { return };
        self.cancel_task();
        let choice = self.settings.export.clone().sane();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let sketch = self.document.sketch().clone();
        let (camera, light) = (self.plant.camera(), self.plant.light());
        let sources = self.sources(&built);
        let order = Order { path, choice, sketch, built, camera, light, sources };
        let shared = Arc::new(Shared::default());
        let theirs = Arc::clone(&shared);
        match begin("export", &self.wake, move || export(&order, &theirs)) {
            Ok(work) => self.task = Some(Task { name, shared, work }),
            Err(error) => self.tell_error(&error),
        }
    }

    /// The files that the plant is made from.
    fn sources(&self, built: &Built) -> Sources {
        let mut sources = Sources::default();
        let drawing = self.file.path.as_deref();
        let folder = drawing.and_then(Path::parent).unwrap_or(Path::new(""));
        let species = pipeline::species_file(self.document.sketch(), folder);
        drawing.into_iter().chain(species.as_deref()).for_each(|file| sources.add(file));
        textures::files(built.plant.materials()).for_each(|picture| sources.add(picture));
        sources
    }

    pub(super) fn cancel_task(&mut self) {
        if let Some(task) = self.task.take() {
            task.shared.stop.store(true, Ordering::Relaxed);
        }
    }

    pub(super) fn collect_task(&mut self) {
        let Some(task) = &self.task else { return };
        match task.work.result() {
            None => return,
            Some(Some(Ok(bytes))) => {
                tracing::debug!("exported {} bytes={bytes}", task.name);
                let what = self.messages.fill(Msg::NoticeExported, &[("file", &task.name)]);
                self.tell(Notice::info(what));
            }
            Some(Some(Err(failure))) => self.tell(Notice::error(failure.localize(&self.messages), "")),
            Some(None) => self.tell(Notice::error(self.messages.get(Msg::NoticeExportFailed), "")),
        }
        self.task = None;
    }

    pub(super) fn task_state(&self) -> Option<snapshot::Task> {
        let task = self.task.as_ref()?;
        let progress = task.shared.progress.load(Ordering::Relaxed) as f32 * 1e-3;
        Some(snapshot::Task { name: task.name.clone(), progress })
    }
}

/// Writes what was ordered; the bytes written.
fn export(order: &Order, shared: &Shared) -> Result<usize, Failure> {
    match order.choice.format {
        ExportFormat::Svg => {
            let text = crate::sketch::svg::write(&order.sketch);
            write(order, &order.path, text.as_bytes())
        }
        ExportFormat::Obj | ExportFormat::Glb => {
            let model = chosen_parts(&order.built.model, &order.choice);
            shared.advance(0.3);
            let (paths, built) = ([order.path.clone()], &order.built);
            let plant = (&built.plant, &built.provenance);
            write::export_all(&paths, &model, plant, &built_in_texture, &order.sources).map_err(boxed)
        }
        ExportFormat::Png => write_pictures(order, shared),
    }
}

/// Writes a file, unless it is one that the plant comes from.
fn write(order: &Order, path: &Path, bytes: &[u8]) -> Result<usize, Failure> {
    order.sources.spare([path]).map_err(|error| boxed(ExportError::from(error)))?;
    crate::atomic::write_atomically(path, bytes).map_err(boxed)?;
    Ok(bytes.len())
}

/// The model with only what was asked for.
pub(super) fn chosen_parts(model: &Model, choice: &ExportChoice) -> Model {
    let mut model = model.clone();
    model.keep_parts(|part| is_wanted(choice, part.kind));
    if !choice.textures {
        model.materials.iter_mut().for_each(|material| material.texture = None);
    }
    model
}

/// One picture of the view as it stands, or many all around.
fn write_pictures(order: &Order, shared: &Shared) -> Result<usize, Failure> {
    let choice = &order.choice;
    let mut renderer = Renderer::new().map_err(boxed)?;
    let mut bytes = 0;
    for frame in 0..choice.frames {
        if shared.is_stopped() {
            break;
        }
        let mut camera = order.camera;
        camera.turn(360.0 * frame as f32 / choice.frames as f32);
        let path = frame_path(&order.path, frame, choice.frames);
        let png = picture(&mut renderer, order, &camera)?;
        bytes += write(order, &path, &png)?;
        shared.advance((frame + 1) as f32 / choice.frames as f32);
    }
    Ok(bytes)
}

fn picture(renderer: &mut Renderer, order: &Order, camera: &OrbitCamera) -> Result<Vec<u8>, Failure> {
    use crate::render::{Background, Look, Viewport};
    let mut viewport = Viewport::new(renderer).map_err(boxed)?;
    viewport.set_size(order.choice.width, order.choice.height);
    viewport.update(renderer, &order.built.model, &plant_view::texture).map_err(boxed)?;
    let background = if order.choice.transparent { Background::Transparent } else { Background::Paper };
    let look = Look { background, light: order.light.clone(), ..Look::default() };
    viewport.draw(renderer, camera, &look).map_err(boxed)?;
    viewport.snapshot(renderer).and_then(|picture| picture.to_png()).map_err(boxed)
}

/// `rose.png`, or `rose-007.png` for one of many.
fn frame_path(path: &Path, frame: u32, frames: u32) -> PathBuf {
    if frames == 1 {
        return path.to_owned();
    }
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-{frame:03}.png"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_of_a_turntable_are_numbered() {
        assert_eq!(frame_path(Path::new("a/rose.png"), 7, 36), Path::new("a/rose-007.png"));
        assert_eq!(frame_path(Path::new("a/rose.png"), 0, 1), Path::new("a/rose.png"));
    }
}
