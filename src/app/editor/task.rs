//! Exports on a thread of their own, with progress and a way to stop them.
//!
//! Files are written whole or not at all, so a stopped export leaves no half file; of a turntable the pictures already
//! written stay.

use super::Editor;
use crate::app::messages::Msg;
use crate::app::panels::snapshot::{self, ExportChoice, ExportFormat, Notice};
use crate::app::plant_view::{self, built_in_texture};
use crate::export;
use crate::model::{Model, PartKind};
use crate::pipeline::Built;
use crate::render::{OrbitCamera, Renderer};
use crate::sketch::Sketch;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

/// An export under way.
pub(super) struct Task {
    name: String,
    shared: Arc<Shared>,
    done: Receiver<Result<usize, String>>,
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
}

impl Editor {
    /// Starts an export.
    pub(super) fn begin_export(&mut self, path: PathBuf) {
        let Some(built) = self.built.clone() else { return };
        self.cancel_task();
        let choice = self.settings.export.clone().sane();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let sketch = self.document.sketch().clone();
        let order = Order { path, choice, sketch, built, camera: self.plant.camera() };
        let shared = Arc::new(Shared::default());
        let (theirs, wake) = (Arc::clone(&shared), Arc::clone(&self.wake));
        let (tell, done) = channel();
        let work = move || {
            // A window that closed does not listen any more.
            let _ = tell.send(export(&order, &theirs));
            wake();
        };
        match std::thread::Builder::new().name("export".into()).spawn(work) {
            Ok(_) => self.task = Some(Task { name, shared, done }),
            Err(error) => self.tell(Notice::error(error.to_string(), "")),
        }
    }

    pub(super) fn cancel_task(&mut self) {
        if let Some(task) = self.task.take() {
            task.shared.stop.store(true, Ordering::Relaxed);
        }
    }

    pub(super) fn collect_task(&mut self) {
        let Some(task) = &self.task else { return };
        match task.done.try_recv() {
            Err(TryRecvError::Empty) => return,
            Ok(Ok(bytes)) => {
                tracing::debug!("exported {} bytes={bytes}", task.name);
                let what = self.messages.fill(Msg::NoticeExported, &[("file", &task.name)]);
                self.tell(Notice::info(what));
            }
            Ok(Err(reason)) => self.tell(Notice::error(reason, "")),
            Err(TryRecvError::Disconnected) => {
                self.tell(Notice::error(self.messages.get(Msg::NoticeExportFailed), ""));
            }
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
fn export(order: &Order, shared: &Shared) -> Result<usize, String> {
    match order.choice.format {
        ExportFormat::Svg => {
            let text = crate::sketch::svg::write(&order.sketch);
            write(&order.path, text.as_bytes())
        }
        ExportFormat::Obj | ExportFormat::Glb => {
            let model = chosen_parts(&order.built.model, &order.choice);
            shared.advance(0.3);
            export::export(&order.path, &model, &order.built.plant, &built_in_texture)
                .map_err(|e| e.to_string())
        }
        ExportFormat::Png => pictures(order, shared),
    }
}

fn write(path: &Path, bytes: &[u8]) -> Result<usize, String> {
    crate::atomic::write_atomically(path, bytes).map_err(|e| e.to_string())?;
    Ok(bytes.len())
}

/// The model with only what was asked for.
fn chosen_parts(model: &Model, choice: &ExportChoice) -> Model {
    let mut model = model.clone();
    let wanted = |kind: PartKind| match kind {
        PartKind::Wood => choice.branches,
        PartKind::Organ(organ) => choice.has(organ),
    };
    model.keep_parts(|part| wanted(part.kind));
    if !choice.textures {
        model.materials.iter_mut().for_each(|material| material.texture = None);
    }
    model
}

/// One picture of the view as it stands, or many all around.
fn pictures(order: &Order, shared: &Shared) -> Result<usize, String> {
    let choice = &order.choice;
    let mut renderer = Renderer::new().map_err(|e| e.to_string())?;
    let mut bytes = 0;
    for frame in 0..choice.frames {
        if shared.is_stopped() {
            break;
        }
        let mut camera = order.camera;
        camera.turn(360.0 * frame as f32 / choice.frames as f32);
        let png = picture(&mut renderer, order, &camera)?;
        bytes += write(&frame_path(&order.path, frame, choice.frames), &png)?;
        shared.advance((frame + 1) as f32 / choice.frames as f32);
    }
    Ok(bytes)
}

fn picture(renderer: &mut Renderer, order: &Order, camera: &OrbitCamera) -> Result<Vec<u8>, String> {
    use crate::render::{Background, Look, Viewport};
    let told = |e: crate::render::RenderError| e.to_string();
    let mut viewport = Viewport::new(renderer).map_err(told)?;
    viewport.set_size(order.choice.width, order.choice.height);
    viewport.update(renderer, &order.built.model, &plant_view::texture).map_err(told)?;
    let background = if order.choice.transparent { Background::Transparent } else { Background::Paper };
    let look = Look { background, ..Look::default() };
    viewport.draw(renderer, camera, &look).map_err(told)?;
    viewport.snapshot(renderer).and_then(|picture| picture.to_png()).map_err(told)
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
