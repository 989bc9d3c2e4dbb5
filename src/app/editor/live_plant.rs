//! The live plant: the worker that builds it, how far that is, and the newest plant with what the panels show of it.

mod growth;
mod opening;

use super::replay::{Replay, Replayed};
use crate::app::canvas::stroke_builder::StrokeBuilder;
use crate::app::canvas::{Canvas, Preview};
use crate::app::messages::{Localize as _, Messages};
use crate::app::stroke_colours::Pieces;
use crate::app::worker::{self, Counts, Growing, Update, Worker};
use crate::growth::overlay::Wanted;
use crate::pipeline::{self, Built};
use crate::sketch::{Brush, GardenStrokes, Remark, Sketch, Stroke, StrokeId, StrokePoint, Tool, Warning};
use crate::species::Species;
use glam::Vec3;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// How far the plant is behind the drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Revisions {
    /// Number of the newest drawing that the worker was given; it grows by one with every drawing.
    pub submitted: u64,
    /// Number of the drawing whose plant was collected last, also where that could not be built.
    pub collected: u64,
}

/// The stroke under the pen, wherever it is drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct UnderPen<'a> {
    pub(super) id: StrokeId,
    pub(super) tool: Tool,
    /// The points so far.
    pub(super) points: &'a [StrokePoint],
    /// How many of them do not move any more.
    pub(super) settled: usize,
    /// The ball that a brush moves.
    pub(super) brush: Option<Brush>,
}

impl<'a> UnderPen<'a> {
    /// A stroke on the canvas.
    pub(super) fn of(stroke: &'a StrokeBuilder) -> Self {
        Self {
            id: stroke.id(),
            tool: stroke.tool(),
            points: stroke.points(),
            settled: stroke.settled(),
            brush: None,
        }
    }
}

/// How much of the stroke under the pen was handed to the worker for good.
#[derive(Debug, Default)]
struct Handed(Option<(StrokeId, usize)>);

impl Handed {
    /// What of the stroke is new since the last call, or may have moved.
    fn grown(&mut self, stroke: Option<UnderPen<'_>>) -> Option<Growing> {
        let Some(UnderPen { id, tool, points, settled, brush }) = stroke else {
            self.0 = None;
            return None;
        };
        let kept = self.0.filter(|(known, _)| *known == id).map_or(0, |(_, kept)| kept);
        self.0 = Some((id, settled));
        Some(Growing { id, tool, kept, points: points[kept..].to_vec(), brush })
    }
}

/// Whether two lists hold the very same strokes.
fn is_same_list(a: &[Arc<Stroke>], b: &[Arc<Stroke>]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| Arc::ptr_eq(a, b))
}

/// Outlines that are drawn.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Outlines {
    pub(super) branches: bool,
    pub(super) leaves: bool,
    pub(super) crowns: bool,
}

impl Outlines {
    fn among(strokes: &[Arc<Stroke>]) -> Self {
        let drawn = |tool: Tool| strokes.iter().any(|s| s.tool == tool);
        Self {
            branches: drawn(Tool::BranchOutline),
            leaves: drawn(Tool::LeafOutline),
            crowns: drawn(Tool::Crown),
        }
    }
}

/// What the worker has finished.
pub(super) enum Collected {
    /// A plant, and its smallest and largest corner in the world, metres; `None` where there is nothing.
    Plant(Option<(Vec3, Vec3)>),
    /// No plant; why, if that is not what was said last.
    Failure(Option<String>),
}

/// The live plant.
pub(super) struct LivePlant {
    worker: Worker,
    built: Option<Arc<Built>>,
    /// What there is of it.
    counts: Counts,
    /// What the pieces of strokes are that were read together, by the names of the strokes.
    pieces: Vec<Pieces>,
    /// The species of the drawing, for the panels; `None` where it cannot be read.
    species: Option<(String, Species)>,
    /// What is to be said of a species file that is missing.
    missing_species: Option<Remark>,
    outlines: Outlines,
    revisions: Revisions,
    /// What the worker has of the stroke under the pen.
    handed: Handed,
    /// All other strokes as the worker has them.
    strokes: Arc<Vec<Arc<Stroke>>>,
    /// The drawing changed since.
    is_stale: bool,
    is_running: bool,
    last: Option<Duration>,
    /// Why the last one failed.
    failure: Option<String>,
    /// Growth that is being replayed.
    replay: Option<Replay>,
}

impl LivePlant {
    /// Starts the worker, which calls `wake` when it has finished something.
    ///
    /// # Errors
    /// A system without threads.
    pub(super) fn start(wake: impl Fn() + Send + 'static) -> std::io::Result<Self> {
        Ok(Self {
            worker: Worker::start(wake)?,
            built: None,
            counts: Counts::default(),
            pieces: Vec::new(),
            species: None,
            missing_species: None,
            outlines: Outlines::default(),
            revisions: Revisions::default(),
            handed: Handed::default(),
            strokes: Arc::default(),
            is_stale: false,
            is_running: false,
            last: None,
            failure: None,
            replay: None,
        })
    }

    /// The newest plant.
    pub(super) fn built(&self) -> Option<&Arc<Built>> {
        self.built.as_ref()
    }

    /// What there is of it.
    pub(super) fn counts(&self) -> &Counts {
        &self.counts
    }

    /// What the pieces of strokes are that were read together, by the names of the strokes.
    pub(super) fn pieces(&self) -> &[Pieces] {
        &self.pieces
    }

    /// What was odd about the drawing.
    pub(super) fn warnings(&self) -> &[Warning] {
        self.built.as_ref().map_or(&[], |built| &built.remarks)
    }

    /// The species of the drawing; `None` where it cannot be read.
    pub(super) fn species(&self) -> Option<&Species> {
        self.species.as_ref().map(|(_, species)| species)
    }

    /// What is to be said of the drawing's species file, if it is missing.
    pub(super) fn missing_species(&self) -> Option<&Remark> {
        self.missing_species.as_ref()
    }

    /// The height on the canvas at which the plant built last stands.
    pub(super) fn ground(&self) -> Option<f32> {
        self.built.as_ref().map(|built| built.provenance.world_from_canvas.origin.y)
    }

    /// Outlines that are drawn.
    pub(super) fn outlines(&self) -> Outlines {
        self.outlines
    }

    /// How far the plant is behind the drawing.
    pub(super) fn revisions(&self) -> Revisions {
        self.revisions
    }

    /// Whether the worker builds.
    pub(super) fn is_running(&self) -> bool {
        self.is_running
    }

    /// Whether a plant is being built, or is about to be.
    pub(super) fn is_working(&self) -> bool {
        self.is_running || self.is_stale || self.is_playing()
    }

    /// How long the last build took; `None` before the first.
    pub(super) fn last_took(&self) -> Option<Duration> {
        self.last
    }

    /// What is drawn or wanted is not what the worker was given last.
    pub(super) fn set_stale(&mut self) {
        self.is_stale = true;
    }

    /// Another drawing was opened: its species is read anew.
    pub(super) fn forget_species(&mut self) {
        self.species = None;
    }

    /// The drawing changed, of which species files are looked for from `folder`.
    pub(super) fn drawing_changed(&mut self, sketch: &Sketch, folder: &Path) {
        self.replay = None;
        self.is_stale = true;
        self.outlines = Outlines::among(&sketch.strokes);
        self.read_species(sketch, folder);
    }

    /// The name of the drawing's species; of one that names none, the species of what was built last.
    pub(super) fn species_name(&self, sketch: &Sketch) -> String {
        let habit = self.built.as_ref().and_then(|built| built.anatomy.habit);
        sketch.species.clone().unwrap_or_else(|| pipeline::species_of_habit(habit).to_owned())
    }

    /// Reads the drawing's species if it is another than before: it may be that of what the strokes were understood as.
    pub(super) fn read_species(&mut self, sketch: &Sketch, folder: &Path) {
        let name = self.species_name(sketch);
        if self.species.as_ref().is_none_or(|(known, _)| *known != name) {
            let named = Sketch { species: Some(name.clone()), ..Sketch::empty() };
            let read = pipeline::species_or_usual(&named, folder);
            let (species, missing) = read.ok().unzip();
            self.species = species.map(|species| (name, species));
            self.missing_species = missing.flatten().map(|warning| warning.remark);
        }
    }

    /// Hands the newest drawing to the worker if it changed.
    pub(super) fn submit(
        &mut self,
        (sketch, garden): (&Sketch, GardenStrokes),
        folder: &Path,
        (canvas, under_pen): (&Canvas, Option<UnderPen<'_>>),
        overlay: Wanted,
    ) {
        if !std::mem::take(&mut self.is_stale) {
            return;
        }
        // Not simply a clone: of many strokes even the list is copied only where it changed.
        let Sketch {
            canvas: size,
            species,
            seed,
            params,
            textures,
            reference,
            plants,
            corrections,
            petal_shapes,
            part_poses,
            garden: _,
            strokes,
        } = sketch;
        if !(matches!(canvas.preview(), Preview::Same) && is_same_list(&self.strokes, strokes)) {
            self.strokes = Arc::new(canvas.previewed(strokes));
        }
        let growing = self.handed.grown(under_pen);
        let sketch = Sketch {
            canvas: *size,
            species: species.clone(),
            seed: *seed,
            params: self.params_of_replay(params),
            textures: textures.clone(),
            reference: reference.clone(),
            plants: plants.clone(),
            corrections: corrections.clone(),
            petal_shapes: petal_shapes.clone(),
            part_poses: part_poses.clone(),
            garden,
            strokes: Vec::new(),
        };
        self.revisions.submitted += 1;
        self.is_running = true;
        let revision = self.revisions.submitted;
        self.worker.submit(worker::Snapshot {
            revision,
            sketch,
            strokes: Arc::clone(&self.strokes),
            growing,
            folder: folder.to_owned(),
            overlay,
        });
    }

    /// Takes what the worker has finished.
    pub(super) fn collect(&mut self, messages: &Messages) -> Option<Collected> {
        let update = self.worker.take()?;
        self.is_running = update.revision < self.revisions.submitted;
        self.revisions.collected = update.revision;
        self.last = Some(update.took);
        let Update { revision, result, took, counts, bounds, pieces } = update;
        match result {
            Ok(built) => {
                self.failure = None;
                tracing::debug!(
                    "built revision={revision} strokes={} flowers={} vertices={} triangles={} took={:.1}ms",
                    built.anatomy.marks.len(),
                    counts.flowers,
                    counts.vertices,
                    counts.triangles,
                    took.as_secs_f64() * 1e3
                );
                self.counts = counts;
                self.pieces = pieces;
                if let Some(old) = self.built.replace(built) {
                    self.worker.discard(old);
                }
                Some(Collected::Plant(bounds))
            }
            Err(error) => {
                let reason = error.localize(messages);
                let is_new = self.failure.as_ref() != Some(&reason);
                self.failure = Some(reason.clone());
                Some(Collected::Failure(is_new.then_some(reason)))
            }
        }
    }
}

/// Growth replayed.
impl LivePlant {
    /// Whether growth or opening is being replayed right now.
    pub(super) fn is_playing(&self) -> bool {
        self.replay.is_some_and(|replay| replay.is_running())
    }

    /// Whether growth or opening is being replayed, or pauses.
    pub(super) fn has_replay(&self) -> bool {
        self.replay.is_some()
    }

    /// What is replayed of this, if it is.
    fn replay_of(&self, of: Replayed) -> Option<Replay> {
        self.replay.filter(|replay| replay.of() == of)
    }

    /// Replays growth from the beginning to the age that is shown, goes on where it paused, or pauses.
    pub(super) fn play_growth(&mut self, on: bool, sketch: &Sketch) {
        let end = self.growth_state(sketch).map_or(0.0, |state| state.age);
        self.play(Replayed::Age, on, end);
    }

    /// The same for flowers that open.
    pub(super) fn play_opening(&mut self, on: bool, sketch: &Sketch) {
        let end = self.opening_state(sketch).map_or(0.0, |state| state.open);
        self.play(Replayed::Opening, on, end);
    }

    /// Begins a replay up to `end`, in place of one of something else.
    fn play(&mut self, of: Replayed, on: bool, end: f32) {
        let now = Instant::now();
        match &mut self.replay {
            Some(replay) if replay.of() == of => replay.play(on.then_some(now)),
            _ if on => {
                self.replay = (end > 0.0).then(|| Replay::begin(of, end, now));
                self.is_stale = true;
            }
            _ => {}
        }
    }

    /// When the next age of a replay is due; `None` while one is being built.
    pub(super) fn next_age_at(&self) -> Option<Instant> {
        self.replay.filter(|_| !self.is_running)?.next_at()
    }

    /// Goes on to the next age, once the one before has been built.
    pub(super) fn replay_growth(&mut self, now: Instant) {
        let Some(replay) = self.replay.as_mut().filter(|_| !self.is_running) else { return };
        if replay.follow(now) {
            self.replay_moved();
        }
    }

    fn replay_moved(&mut self) {
        self.is_stale = true;
        self.replay = self.replay.filter(|replay| !replay.is_over());
    }
}
