//! The depth that the network gives a drawing, at any of its points.

use super::network::{Answer, CELLS, Network};
use super::picture::{Frame, Line, Picture};
use crate::plant::WorldFromCanvas;
use glam::Vec2;
use std::sync::Arc;

/// How likely an area must be a plant's for its depth to be believed at all, and from where on it is believed wholly. Between, the
/// share rises evenly.
const BELIEVED: (f32, f32) = (0.5, 0.9);

/// Depth over a drawing on the canvas, pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthField {
    frame: Frame,
    answer: Answer,
}

impl DepthField {
    /// The depth of a drawing: crowns as closed outlines, lines of wood, `habit` by its name.
    pub fn new(network: &Network, frame: Frame, picture: &Picture, habit: Option<&str>) -> Self {
        Self { frame, answer: network.answer(picture, habit) }
    }

    /// How far it is to be believed, 0 to 1: 0 for what is no plant's crown.
    pub fn belief(&self) -> f32 {
        ((self.answer.plant - BELIEVED.0) / (BELIEVED.1 - BELIEVED.0)).clamp(0.0, 1.0)
    }

    /// What the network said.
    pub fn answer(&self) -> &Answer {
        &self.answer
    }

    /// Half the depth of the crown at a point.
    pub fn half_depth(&self, p: Vec2) -> f32 {
        self.at(&self.answer.half_depth, p)
    }

    /// How far the middle of the crown strays from the drawing's plane there, in the mean.
    pub fn stray(&self, p: Vec2) -> f32 {
        self.at(&self.answer.stray, p)
    }

    /// How far wood leaves the drawing's plane there, in the mean.
    pub fn away(&self, p: Vec2) -> f32 {
        self.at(&self.answer.away, p)
    }

    /// Between the middles of cells linear, beyond the outermost as there.
    fn at(&self, cells: &[f32], p: Vec2) -> f32 {
        let last = (CELLS - 1) as f32;
        let q = (self.frame.place(p) * CELLS as f32 - 0.5).clamp(Vec2::ZERO, Vec2::splat(last));
        let (x, y) = ((q.x as usize).min(CELLS - 2), (q.y as usize).min(CELLS - 2));
        let part = q - Vec2::new(x as f32, y as f32);
        let row = |y: usize| {
            let (a, b) = (cells[y * CELLS + x], cells[y * CELLS + x + 1]);
            a + (b - a) * part.x
        };
        (row(y) + (row(y + 1) - row(y)) * part.y) * self.frame.side()
    }

    /// The same in the world.
    pub fn in_world(self: &Arc<Self>, world: WorldFromCanvas) -> WorldDepth {
        WorldDepth { field: Arc::clone(self), world }
    }
}

/// Depth over a drawing in the world, metres.
#[derive(Clone, Debug, PartialEq)]
pub struct WorldDepth {
    field: Arc<DepthField>,
    world: WorldFromCanvas,
}

impl WorldDepth {
    /// See [`DepthField::belief`].
    pub fn belief(&self) -> f32 {
        self.field.belief()
    }

    /// Half the depth of the crown at a place of the drawing's plane.
    pub fn half_depth(&self, p: Vec2) -> f32 {
        self.field.half_depth(self.world.canvas(p.extend(0.0))) * self.world.scale
    }

    /// How far the middle of the crown strays from that plane there, in the mean.
    pub fn stray(&self, p: Vec2) -> f32 {
        self.field.stray(self.world.canvas(p.extend(0.0))) * self.world.scale
    }
}

/// A drawing that the network is asked about; points with y down.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// Where the plant stands.
    pub foot: Vec2,
    /// Crowns as closed outlines.
    pub outlines: Vec<Vec<Vec2>>,
    /// Its wood, drawn one line over the other.
    pub wood: Vec<Line>,
    /// The name of its habit, where it is known.
    pub habit: Option<String>,
}

impl Question {
    fn frame(&self) -> Option<Frame> {
        let lines = self.wood.iter().flat_map(|line| &line.points);
        Frame::around(self.foot, self.outlines.iter().flatten().chain(lines).copied())
    }
}

/// What the network was asked last, and what it answered.
#[derive(Debug, Default)]
pub struct Memory {
    last: Option<Asked>,
}

#[derive(Debug)]
struct Asked {
    question: Question,
    picture: Picture,
    field: Arc<DepthField>,
}

impl Memory {
    /// The depth of a drawing; `None` without a network or for a drawing without extent.
    pub fn field(&mut self, question: Question) -> Option<Arc<DepthField>> {
        if let Some(asked) = self.last.as_ref().filter(|asked| asked.question == question) {
            return Some(Arc::clone(&asked.field));
        }
        let (network, frame) = (Network::shipped()?, question.frame()?);
        let picture = Picture::of(&frame, &question.outlines, &question.wood);
        let field = Arc::new(DepthField::new(network, frame, &picture, question.habit.as_deref()));
        self.last = Some(Asked { question, picture, field: Arc::clone(&field) });
        Some(field)
    }

    /// What the network saw last.
    pub fn picture(&self) -> Option<&Picture> {
        self.last.as_ref().map(|asked| &asked.picture)
    }

    /// Forgets it.
    pub fn forget(&mut self) {
        self.last = None;
    }
}
