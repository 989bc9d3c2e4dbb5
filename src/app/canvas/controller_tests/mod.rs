//! The canvas in the hand: whole gestures from events to outcomes, with a drawing that takes the changes.

use super::*;
use crate::app::canvas::overlay::{CursorShape, Preview};
use crate::app::canvas::transform::Handle;
use crate::app::stabiliser::Stabiliser;
use crate::pen::tests::{Hand, random_hand};
use crate::sketch::change::StrokeChange;
use crate::sketch::{StrokeId, StrokePoint};
use glam::Vec2;
use proptest::prelude::*;

mod buttons;
mod drawing;
mod hostile;
mod moving;
mod selecting;

use PenPhase::*;

/// A canvas with a drawing that takes its changes.
struct Fixture {
    canvas: Canvas,
    strokes: Vec<Arc<Stroke>>,
    next_id: StrokeId,
    time_ms: f64,
    hand: Hand,
    out: Vec<CanvasOutcome>,
    applies: bool,
}

impl Fixture {
    fn new() -> Self {
        let mut canvas = Canvas::default();
        canvas.set_viewport(Rect::new(DVec2::ZERO, DVec2::new(1000.0, 800.0)), 1.0);
        let hand = Hand::default();
        Self { canvas, strokes: Vec::new(), next_id: 0, time_ms: 0.0, hand, out: Vec::new(), applies: true }
    }

    /// Horizontal lines of ids 1, 2, … at y = 100, 200, …, from x = 100 to 300.
    fn with_lines(count: u64) -> Self {
        let mut fixture = Self::new();
        for id in 1..=count {
            let points =
                (0..=20).map(|i| StrokePoint::at(Vec2::new(100.0 + i as f32 * 10.0, id as f32 * 100.0)));
            fixture.strokes.push(Arc::new(Stroke {
                id,
                tool: Tool::Auto,
                points: points.collect(),
                brush: None,
            }));
        }
        fixture.next_id = count;
        fixture
    }

    fn event(&mut self, event: &PenEvent) -> Vec<CanvasOutcome> {
        self.with_drawing(|canvas, drawing, out| canvas.pen(event, drawing, out))
    }

    fn act(&mut self, action: &Action) -> Vec<CanvasOutcome> {
        self.with_drawing(|canvas, drawing, out| {
            canvas.act(action, drawing, out);
        })
    }

    /// Lets the canvas work on the drawing, which then takes what came of it.
    fn with_drawing(
        &mut self,
        work: impl FnOnce(&mut Canvas, &mut Drawing<'_>, &mut Vec<CanvasOutcome>),
    ) -> Vec<CanvasOutcome> {
        let mut out = Vec::new();
        let next = &mut self.next_id;
        let mut new_id = || {
            *next += 1;
            *next
        };
        work(&mut self.canvas, &mut Drawing { strokes: &self.strokes, new_id: &mut new_id }, &mut out);
        self.take(&out);
        out
    }

    fn take(&mut self, out: &[CanvasOutcome]) {
        self.out.extend_from_slice(out);
        let mut changed = false;
        for outcome in out.iter().filter(|_| self.applies) {
            match outcome {
                CanvasOutcome::StrokeFinished(stroke) => self.strokes.push(Arc::clone(stroke)),
                CanvasOutcome::Changed(changes) | CanvasOutcome::Nudged(changes) => {
                    for change in changes {
                        let id = match change {
                            StrokeChange::Put(stroke) => stroke.id,
                            StrokeChange::Remove(id) => *id,
                        };
                        let place = self.strokes.iter().position(|s| s.id == id);
                        match (change, place) {
                            (StrokeChange::Put(stroke), Some(i)) => self.strokes[i] = Arc::clone(stroke),
                            (StrokeChange::Put(stroke), None) => self.strokes.push(Arc::clone(stroke)),
                            (StrokeChange::Remove(id), None) => panic!("stroke {id} is not there to remove"),
                            (StrokeChange::Remove(_), Some(i)) => drop(self.strokes.remove(i)),
                        }
                    }
                }
                _ => continue,
            }
            changed = true;
        }
        if changed {
            let mut more = Vec::new();
            self.canvas.drawing_changed(&self.strokes, &mut more);
            self.out.extend(more);
        }
    }

    fn say(&mut self, phase: PenPhase, tool: PenTool, place: (f64, f64)) -> Vec<CanvasOutcome> {
        self.time_ms += 5.0;
        self.hand.position = DVec2::from(place);
        let event = self.hand.event(phase, tool, self.time_ms);
        self.event(&event)
    }

    /// Down, along a way in steps, up.
    fn drag(&mut self, tool: PenTool, way: &[(f64, f64)]) -> Vec<CanvasOutcome> {
        self.out.clear();
        self.say(Down, tool, way[0]);
        for pair in way.windows(2) {
            for k in 1..=10 {
                let place = DVec2::from(pair[0]).lerp(DVec2::from(pair[1]), f64::from(k) / 10.0);
                self.say(Move, tool, place.into());
            }
        }
        self.say(Up, tool, way[way.len() - 1]);
        std::mem::take(&mut self.out)
    }

    fn tap(&mut self, tool: PenTool, place: (f64, f64)) -> Vec<CanvasOutcome> {
        self.drag(tool, &[place])
    }

    fn key(&mut self, key: CanvasKey, pressed: bool) {
        self.canvas.key(key, pressed, &mut self.out);
    }

    fn ids(&self) -> Vec<StrokeId> {
        self.strokes.iter().map(|s| s.id).collect()
    }

    fn selected(&self) -> Vec<StrokeId> {
        self.canvas.selection().ids().iter().copied().collect()
    }
}

const PEN: PenTool = PenTool::Pen;
const MOUSE: PenTool = PenTool::Mouse;
