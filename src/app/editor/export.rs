//! Exports, which are written on a thread of their own, have progress and can be stopped.
//!
//! Files are written whole or not at all, so a stopped export leaves no half file; of a turntable the pictures already
//! written stay.

use super::background::{self, Wake, Work};
use super::estimate::is_wanted;
use crate::app::messages::Localize;
use crate::app::panels::snapshot::{self, ExportChoice, ExportFormat};
use crate::app::texture_files::{self, built_in_texture};
use crate::app::view_state::ViewState;
use crate::app::worker::BuildError;
use crate::formats::write::{self, ExportError, InstanceForm, Surfaces};
use crate::input::Sources;
use crate::model::capsules::capsules;
use crate::model::{Levels, Model};
use crate::pipeline::{self, Built, LevelSet};
use crate::render::{LightParams, OrbitCamera, Renderer};
use crate::sketch::Sketch;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

/// What kept an export from being made.
pub(super) type Failure = Box<dyn Localize + Send>;

fn boxed(error: impl Localize + Send + 'static) -> Failure {
    Box::new(error)
}

/// An export under way.
struct Task {
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
pub(super) struct Order {
    pub(super) path: PathBuf,
    pub(super) choice: ExportChoice,
    pub(super) sketch: Sketch,
    pub(super) built: Arc<Built>,
    pub(super) camera: OrbitCamera,
    pub(super) light: LightParams,
    pub(super) view: ViewState,
    /// The folder of the drawing, in which its species may be.
    pub(super) folder: PathBuf,
    /// The files that the plant comes from.
    pub(super) sources: Sources,
}

/// What came of an export.
pub(super) struct Exported {
    pub(super) name: String,
    /// The bytes written; `None` where the work broke off.
    pub(super) result: Option<Result<usize, Failure>>,
}

/// The export under way, if there is one.
#[derive(Default)]
pub(super) struct Exports(Option<Task>);

impl Exports {
    /// Begins one, in the place of any other.
    pub(super) fn begin(&mut self, order: Order, wake: &Wake) -> std::io::Result<()> {
        self.cancel();
        let name = order.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let shared = Arc::new(Shared::default());
        let theirs = Arc::clone(&shared);
        let work = background::begin("export", wake, move || export(&order, &theirs))?;
        self.0 = Some(Task { name, shared, work });
        Ok(())
    }

    /// Stops it.
    pub(super) fn cancel(&mut self) {
        if let Some(task) = self.0.take() {
            task.shared.stop.store(true, Ordering::Relaxed);
        }
    }

    /// What came of it, if it has ended.
    pub(super) fn take(&mut self) -> Option<Exported> {
        let result = self.0.as_ref()?.work.result()?;
        Some(Exported { name: self.0.take()?.name, result })
    }

    /// Whether there is one.
    pub(super) fn is_busy(&self) -> bool {
        self.0.is_some()
    }

    /// What the panels show of it.
    pub(super) fn state(&self) -> Option<snapshot::Task> {
        let task = self.0.as_ref()?;
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
        ExportFormat::Obj | ExportFormat::Glb => match order.choice.level_set() {
            Some(set) => write_levels(order, set, shared),
            None => write_model(order, shared),
        },
        ExportFormat::Png => write_pictures(order, shared),
    }
}

/// The plant as it is.
fn write_model(order: &Order, shared: &Shared) -> Result<usize, Failure> {
    let model = chosen_parts(&order.built.model, &order.choice);
    shared.advance(0.3);
    let (paths, built) = ([order.path.clone()], &order.built);
    let plant = (&built.plant, &built.provenance);
    let form = form_of_copies(&order.choice);
    let garden = built.garden.as_deref().filter(|_| order.choice.garden);
    let surfaces = Surfaces { garden, ..(&model).into() };
    write::export_all(&paths, surfaces, plant, &built_in_texture, form, &order.sources).map_err(boxed)
}

/// The plant in levels of detail.
fn write_levels(order: &Order, set: LevelSet, shared: &Shared) -> Result<usize, Failure> {
    let Order { built, choice, .. } = order;
    let models = pipeline::levels_of_drawing((&order.sketch, &order.folder), built, set)
        .map_err(|error| boxed(BuildError::from(error)))?;
    shared.advance(0.7);
    let mut levels = Levels::of(models.iter().map(|model| chosen_parts(model, choice)));
    if choice.capsules {
        levels.model.add_capsules(&capsules(&built.plant));
    }
    let surfaces = Surfaces { level_of_specimen: &levels.of_specimen, ..(&levels.model).into() };
    let (paths, plant) = ([order.path.clone()], (&built.plant, &built.provenance));
    let form = form_of_copies(choice);
    write::export_all(&paths, surfaces, plant, &built_in_texture, form, &order.sources).map_err(boxed)
}

/// Writes a file, unless it is one that the plant comes from.
fn write(order: &Order, path: &Path, bytes: &[u8]) -> Result<usize, Failure> {
    order.sources.spare([path]).map_err(|error| boxed(ExportError::from(error)))?;
    crate::atomic::write_atomically(path, bytes).map_err(boxed)?;
    Ok(bytes.len())
}

/// How leaves of one shape stay copies, if they do: in the way that every program reads.
pub(super) fn form_of_copies(choice: &ExportChoice) -> Option<InstanceForm> {
    choice.copies.then_some(InstanceForm::Nodes)
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
        let degrees = 360.0 * frame as f32 / choice.frames as f32;
        // Who walks looks around.
        if order.view.walking {
            camera.turn_in_place(degrees);
        } else {
            camera.turn(degrees);
        }
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
    viewport.update(renderer, pipeline::seen(&order.built), &texture_files::texture).map_err(boxed)?;
    let background = match order.choice.transparent {
        true => Background::Transparent,
        false if order.view.is_outdoors() => Background::Outdoors,
        false => Background::Paper,
    };
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
