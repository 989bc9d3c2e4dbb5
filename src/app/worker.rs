//! The live worker: a thread that turns the newest drawing into a model while the pen moves.
//!
//! The window hands over snapshots and never waits. At most one snapshot is queued; a newer one takes its place, and
//! also cancels the build that runs, unless the artist has seen nothing new for [`PATIENCE`]: then that build is
//! allowed to finish, so that a plant slower to build than the pen is to move still grows on the screen. Nor is a build
//! cancelled where the last one was [`QUICK`]: while samples come faster than plants, the newest would never be seen. What
//! is built last is always the newest snapshot.
//!
//! Species files and the parts of the plant that did not change are kept from build to build. What would make the window
//! wait on large plants is done here as well: counting, and giving back the memory of plants that are no longer shown.

use super::stroke_colours::{Pieces, pieces_of};
use super::{build_threads, free_memory, priority};
use crate::anatomy::{Anatomy, Part};
use crate::growth::overlay::Wanted;
use crate::model::{Measure, Measures};
use crate::pipeline::{self, Built, Cache, SetupError};
use crate::plant::{Blade, Organ, RestSurface, Shape};
use crate::sketch::{Brush, Reading, Sketch, Stroke, StrokeId, StrokePoint, Tool};
use crate::species::Species;
use glam::Vec3;
use std::collections::HashSet;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use thiserror::Error;

/// Longest time without a new picture before a build may no longer be cancelled.
pub const PATIENCE: Duration = Duration::from_millis(100);

/// Longest time of a build after which the next one is not cancelled: the newest drawing waits for that no longer than for
/// its own plant.
pub const QUICK: Duration = Duration::from_millis(50);

/// What to build.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// Grows with every snapshot; the result carries it.
    pub revision: u64,
    /// The drawing without its strokes.
    pub sketch: Sketch,
    /// All strokes but that under the pen; shared with the last snapshot where they are the same.
    pub strokes: Arc<Vec<Arc<Stroke>>>,
    /// The stroke under the pen.
    pub growing: Option<Growing>,
    /// Where the drawing's species and picture files are looked for.
    pub folder: PathBuf,
    /// What is to be seen of growth.
    pub overlay: Wanted,
}

/// The stroke under the pen: what of it may differ from the last snapshot's, so that a sample costs the window the same
/// however long the stroke is. The worker puts it together.
#[derive(Clone, Debug)]
pub struct Growing {
    /// Name of the stroke.
    pub id: StrokeId,
    /// What it is drawn as.
    pub tool: Tool,
    /// Points that are as they were in the last snapshot; 0 for a stroke that was not in it.
    pub kept: usize,
    /// All points after those.
    pub points: Vec<StrokePoint>,
    /// The ball that a brush moves.
    pub brush: Option<Brush>,
}

/// A finished build.
#[derive(Debug)]
pub struct Update {
    /// Revision of the snapshot.
    pub revision: u64,
    /// The plant, or what kept it from being built.
    pub result: Result<Arc<Built>, BuildError>,
    /// Time from the moment the worker took the snapshot.
    pub took: Duration,
    /// What there is of the plant; nothing where it was not built.
    pub counts: Counts,
    /// Its smallest and largest corner in the world, metres; `None` where there is nothing.
    pub bounds: Option<(Vec3, Vec3)>,
    /// What the pieces of strokes are that were read together, by the names of the strokes.
    pub pieces: Vec<Pieces>,
}

/// Why there is no plant.
#[derive(Debug, Error)]
pub enum BuildError {
    /// Its species or parameters cannot be used.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// A defect of ours; it must not take the drawing with it.
    #[error(
        "building this plant failed inside the program; undo the last stroke or save the drawing and report it"
    )]
    Defect,
}

/// What there is of a plant, for the panels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Flowers.
    pub flowers: usize,
    /// Vertices of the model.
    pub vertices: usize,
    /// Triangles of the model.
    pub triangles: usize,
    /// Levels of branches in the drawing.
    pub branch_levels: u32,
    /// Whether strokes were taken for petals.
    pub petals: bool,
    /// Whether strokes were taken for leaves.
    pub leaves: bool,
    /// Whether strokes are a pot.
    pub pots: bool,
    /// Whether strokes are the ground.
    pub ground: bool,
    /// Whether there are flowers that open from buds.
    pub opens: bool,
    /// Whether strokes were not used.
    pub ignored: bool,
}

impl Counts {
    /// Counts, which takes as long as the plant is large.
    pub fn of(built: &Built, measure: &Measure) -> Self {
        let has = |part: Part| built.anatomy.marks.iter().any(|mark| mark.part == part);
        let reads = |reading: Reading| built.anatomy.readings.iter().any(|read| read.reading == reading);
        Self {
            flowers: built.plant.flowers.len(),
            vertices: measure.vertices,
            triangles: measure.triangles,
            branch_levels: built.anatomy.branches.iter().map(|b| b.level + 1).max().unwrap_or(0),
            petals: has(Part::Petal),
            leaves: has(Part::Leaf),
            pots: reads(Reading::Pot),
            ground: reads(Reading::Ground),
            opens: built.plant.organs.iter().any(opens),
            ignored: has_unused(&built.anatomy),
        }
    }
}

/// Whether an organ is a petal in layers, which opens.
fn opens(organ: &Organ) -> bool {
    matches!(&organ.shape, Shape::Blade(Blade { rest: RestSurface::Ring(_), .. }))
}

/// Whether strokes were not used, neither as a part nor with others.
fn has_unused(anatomy: &Anatomy) -> bool {
    let is_beside = |reading| matches!(reading, Reading::Pot | Reading::Ground);
    let beside =
        anatomy.readings.iter().filter(|read| is_beside(read.reading)).flat_map(|read| &read.strokes);
    let made = anatomy.pieces.values().flat_map(|piece| &piece.strokes);
    let with_others: HashSet<StrokeId> = beside.chain(made).copied().collect();
    anatomy.marks.iter().any(|mark| mark.part == Part::Ignored && !with_others.contains(&mark.stroke))
}

/// What window and worker share.
#[derive(Default)]
struct Shared {
    state: Mutex<State>,
    changed: Condvar,
    cancel: AtomicBool,
}

#[derive(Default)]
struct State {
    next: Option<Snapshot>,
    /// The stroke under the pen, as in the newest snapshot.
    growing: Option<Stroke>,
    done: Option<Update>,
    last_finish: Option<Instant>,
    /// How long the last build took that was not cancelled.
    last_took: Duration,
    /// Plants that the window does not show any more.
    discarded: Vec<Arc<Built>>,
    closing: bool,
}

impl State {
    fn follow(&mut self, growing: Option<Growing>) {
        let Some(Growing { id, tool, kept, points, brush }) = growing else {
            self.growing = None;
            return;
        };
        match self.growing.as_mut().filter(|stroke| stroke.id == id) {
            Some(stroke) => {
                stroke.points.truncate(kept);
                stroke.points.extend(points);
            }
            None => self.growing = Some(Stroke { id, tool, points, brush }),
        }
    }
}

impl Shared {
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The worker's end in the window; dropping it ends the thread.
pub struct Worker {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

impl Worker {
    /// Starts the thread. `wake` is called on it whenever a result is ready.
    ///
    /// # Errors
    /// A system that gives no thread.
    pub fn start(mut wake: impl Fn() + Send + 'static) -> std::io::Result<Self> {
        let shared = Arc::new(Shared::default());
        let for_thread = Arc::clone(&shared);
        let thread = std::thread::Builder::new()
            .name("live worker".into())
            .spawn(move || work(&for_thread, &mut wake))?;
        Ok(Self { shared, thread: Some(thread) })
    }

    /// Hands over the newest drawing; never waits for a build.
    pub fn submit(&self, mut snapshot: Snapshot) {
        let mut state = self.shared.state();
        state.follow(snapshot.growing.take());
        let outdated = state.next.replace(snapshot);
        if state.last_took > QUICK && state.last_finish.is_some_and(|at| at.elapsed() < PATIENCE) {
            self.shared.cancel.store(true, Ordering::Relaxed);
        }
        drop(state);
        self.shared.changed.notify_one();
        // After the worker was notified, who could not have taken it while it was being dropped.
        drop(outdated);
    }

    /// Hands over a plant that is not shown any more, so that the worker gives its memory back.
    pub fn discard(&self, plant: Arc<Built>) {
        self.shared.state().discarded.push(plant);
        self.shared.changed.notify_one();
    }

    /// The newest result that was not taken yet.
    pub fn take(&self) -> Option<Update> {
        self.shared.state().done.take()
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.shared.state().closing = true;
        self.shared.cancel.store(true, Ordering::Relaxed);
        self.shared.changed.notify_one();
        if let Some(thread) = self.thread.take() {
            // A worker that panicked has been reported by the panic hook; the window closes all the same.
            let _ = thread.join();
        }
    }
}

/// What the worker keeps between builds.
#[derive(Default)]
struct BuildContext {
    cache: Cache,
    measures: Measures,
    species: Option<(String, PathBuf, Species)>,
}

/// Waits for work, which is done by threads that end at the next rest (`build_threads`).
fn work(shared: &Shared, wake: &mut (dyn Fn() + Send)) {
    priority::step_back();
    let mut context = BuildContext::default();
    while is_work_there(shared) {
        build_threads::run(|| work_until_rest(shared, wake, &mut context));
        free_memory::give_back();
    }
}

/// Builds one snapshot after the other.
fn work_until_rest(shared: &Shared, wake: &mut (dyn Fn() + Send), context: &mut BuildContext) {
    while let Some(snapshot) = next(shared) {
        let begun = Instant::now();
        let revision = snapshot.revision;
        let build = std::panic::AssertUnwindSafe(|| context.update(&snapshot, begun, &shared.cancel));
        let failed = |error| {
            let (counts, bounds, pieces) = (Counts::default(), None, Vec::new());
            Update { revision, result: Err(error), took: begun.elapsed(), counts, bounds, pieces }
        };
        let update = match std::panic::catch_unwind(build) {
            Ok(Ok(Some(update))) => update,
            Ok(Ok(None)) => continue,
            Ok(Err(error)) => failed(error.into()),
            Err(_) => {
                *context = BuildContext::default();
                failed(BuildError::Defect)
            }
        };
        let took = update.took;
        let mut state = shared.state();
        let unseen = state.done.replace(update);
        (state.last_finish, state.last_took) = (Some(Instant::now()), took);
        let discarded = std::mem::take(&mut state.discarded);
        drop(state);
        wake();
        // Here, where most of it was allocated: what another thread frees stays in this thread's pages while it waits.
        drop((unseen, discarded));
    }
}

/// Waits until there is something to do; nothing will be when the window closes.
fn is_work_there(shared: &Shared) -> bool {
    let is_idle = |state: &mut State| !state.closing && state.next.is_none() && state.discarded.is_empty();
    let waited = shared.changed.wait_while(shared.state(), is_idle);
    !waited.unwrap_or_else(PoisonError::into_inner).closing
}

/// Waits for the next snapshot; none at a rest, or when the window closes.
fn next(shared: &Shared) -> Option<Snapshot> {
    let mut state = shared.state();
    loop {
        if state.closing {
            return None;
        }
        if let Some(mut snapshot) = state.next.take() {
            shared.cancel.store(false, Ordering::Relaxed);
            let growing = state.growing.clone();
            drop(state);
            snapshot.sketch.strokes = snapshot.strokes.iter().cloned().chain(growing.map(Arc::new)).collect();
            return Some(snapshot);
        }
        let discarded = std::mem::take(&mut state.discarded);
        if !discarded.is_empty() {
            drop(state);
            drop(discarded);
            state = shared.state();
            continue;
        }
        let (now, waited) =
            shared.changed.wait_timeout(state, free_memory::REST).unwrap_or_else(PoisonError::into_inner);
        if waited.timed_out() && now.next.is_none() && now.discarded.is_empty() {
            return None;
        }
        state = now;
    }
}

impl BuildContext {
    /// The plant and what is counted of it; `Ok(None)` where it was cancelled.
    fn update(
        &mut self,
        snapshot: &Snapshot,
        begun: Instant,
        cancel: &AtomicBool,
    ) -> Result<Option<Update>, SetupError> {
        let Some(built) = self.build(snapshot, cancel)? else { return Ok(None) };
        let measure = self.measures.of(&built.model);
        let (counts, pieces) = (Counts::of(&built, &measure), pieces_of(&snapshot.sketch, &built.anatomy));
        let of_garden = || built.garden.as_ref().and_then(|garden| garden.bounds());
        let bounds = measure.bounds.or_else(of_garden);
        let (result, revision) = (Ok(Arc::new(built)), snapshot.revision);
        Ok(Some(Update { revision, result, took: begun.elapsed(), counts, bounds, pieces }))
    }

    /// `Ok(None)` where it was cancelled.
    fn build(&mut self, snapshot: &Snapshot, cancel: &AtomicBool) -> Result<Option<Built>, SetupError> {
        let Snapshot { sketch, folder, overlay, .. } = snapshot;
        let name = self.cache.species_name(sketch);
        let known = self.species.take().filter(|(known, at, _)| *known == name && at == folder);
        let (species, missing) = match known {
            Some((_, _, species)) => (species, None),
            None => {
                let named = Sketch { species: Some(name.clone()), ..Sketch::empty() };
                pipeline::species_or_usual(&named, folder)?
            }
        };
        let (_, _, species) = self.species.insert((name, folder.clone(), species));
        let params = pipeline::params_of(sketch, species, &[])?;
        let cancelled = || cancel.load(Ordering::Relaxed);
        let mut built = pipeline::build_with(&mut self.cache, sketch, species, &params, &cancelled);
        if let Some(built) = &mut built {
            self.cache.look_inside(sketch.into(), built, *overlay);
        }
        if let Some(missing) = missing {
            // It may be there for the next build.
            self.species = None;
            built.iter_mut().for_each(|built| built.remarks.push(missing.clone()));
        }
        Ok(built)
    }
}

#[cfg(test)]
#[path = "worker_tests.rs"]
mod tests;
