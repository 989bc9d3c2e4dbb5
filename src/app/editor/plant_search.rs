//! The search for the plant on the picture under the drawing: what is marked, what was found, and the thread that seeks.

use super::background::Work;
use crate::app::plant_search::{PlantMark, PlantSearchState};
use crate::app::texture_cut::CutError;
use crate::photo::PhotoError;
use crate::photo::plant::{Marks, PlantPhoto, PlantPicture, TrunkLine};
use crate::sketch::{Reference, Stroke, StrokeId, Textures};
use glam::Vec2;
use std::sync::Arc;

/// What comes of a search: the picture made ready, and the plant on it.
pub(super) type Searched = Result<(Arc<PlantPicture>, Result<PlantPhoto, PhotoError>), CutError>;

/// The picture that is searched, by the name of its content.
pub(super) struct Prepared {
    pub(super) hash: u64,
    pub(super) picture: Arc<PlantPicture>,
}

/// The search for the plant.
#[derive(Default)]
pub(super) struct PlantSearch {
    /// Whether the pen marks the picture.
    pub(super) is_on: bool,
    /// What its lines say.
    pub(super) mark: PlantMark,
    /// All marks, pixels of the picture.
    pub(super) marks: Marks,
    /// What they are, in the order in which they were drawn.
    pub(super) order: Vec<PlantMark>,
    /// The mark under the pen, pixels of the picture.
    pub(super) line: Option<Vec<Vec2>>,
    pub(super) prepared: Option<Prepared>,
    /// The picture of which this is the plant, and it.
    pub(super) found: Option<(u64, Arc<PlantPhoto>)>,
    /// The thread that seeks, and the picture on which it does.
    pub(super) work: Option<(u64, Work<Searched>)>,
    /// Marks have changed since it began.
    pub(super) is_stale: bool,
    /// The thread that paints textures in the plant's colours.
    pub(super) painting: Option<Work<Result<Textures, PhotoError>>>,
    /// The trunk whose edges are being sought.
    pub(super) snapping: Option<Snapping>,
}

/// The picture made ready, and the trunk on it.
pub(super) type Snapped = (Arc<PlantPicture>, Option<TrunkLine>);

/// A trunk whose edges are being sought.
pub(super) struct Snapping {
    pub(super) stroke: Arc<Stroke>,
    pub(super) reference: Arc<Reference>,
    /// The thread that seeks them, and the picture made ready.
    pub(super) work: Work<Result<Snapped, CutError>>,
}

impl PlantSearch {
    /// The picture of this content, where it has been made ready.
    pub(super) fn prepared_for(&self, hash: u64) -> Option<Arc<PlantPicture>> {
        let prepared = self.prepared.as_ref().filter(|prepared| prepared.hash == hash);
        prepared.map(|prepared| Arc::clone(&prepared.picture))
    }

    /// Ends the search; what was found stays, for its colours.
    pub(super) fn stop(&mut self) {
        (self.is_on, self.line) = (false, None);
        self.clear();
    }

    /// Forgets all marks.
    pub(super) fn clear(&mut self) {
        (self.marks, self.order) = (Marks::default(), Vec::new());
    }

    /// Forgets everything that is about another picture than this one.
    pub(super) fn keep_only(&mut self, hash: Option<u64>) {
        self.found.take_if(|(of, _)| Some(*of) != hash);
        if self.prepared.take_if(|prepared| Some(prepared.hash) != hash).is_some() || hash.is_none() {
            self.stop();
        }
    }

    /// Takes the line under the pen among the marks; whether it says anything.
    pub(super) fn finish_line(&mut self) -> bool {
        let Some(line) = self.line.take() else { return false };
        match self.mark {
            PlantMark::Plant => self.marks.plant.push(line),
            PlantMark::Around => self.marks.around.push(line),
            // A tap is no outline.
            PlantMark::Outline if line.len() < 3 => return false,
            PlantMark::Outline => self.marks.outline = Some(line),
        }
        self.order.push(self.mark);
        true
    }

    /// Whether there is a mark to take back.
    pub(super) fn can_take_back(&self) -> bool {
        self.is_on && !self.order.is_empty()
    }

    /// Takes the last mark back; an outline goes with those that it replaced. Whether there was one.
    pub(super) fn take_back(&mut self) -> bool {
        if !self.is_on {
            return false;
        }
        match self.order.pop() {
            Some(PlantMark::Plant) => drop(self.marks.plant.pop()),
            Some(PlantMark::Around) => drop(self.marks.around.pop()),
            Some(PlantMark::Outline) => {
                self.marks.outline = None;
                self.order.retain(|mark| *mark != PlantMark::Outline);
            }
            None => return false,
        }
        true
    }

    /// What the panel shows, with the branch that can be moved onto a trunk.
    pub(super) fn state(&self, branch: Option<StrokeId>) -> PlantSearchState {
        PlantSearchState {
            on: self.is_on,
            mark: self.mark,
            any_marks: !self.marks.is_empty(),
            is_searching: self.work.is_some(),
            branch,
            share: self.found.as_ref().map(|(_, found)| found.share),
        }
    }
}
