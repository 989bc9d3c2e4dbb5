//! A click on the plant selects the stroke that drew what it hits.
//!
//! What was generated leads to the nearest branch below it that was drawn. A plant beside the drawn one is selected as a
//! whole.

use super::Editor;
use crate::app::action::Action;
use crate::model::pick::{Element, pick};
use crate::pipeline::BuiltBeside;
use std::time::Instant;

impl Editor {
    /// What a single click on the plant asks for.
    pub(in crate::app) fn picked_in_plant(&mut self) -> Option<Action> {
        let click = self.plant.take_click()?;
        let ray = self.plant.ray(click.at)?;
        let (built, begun) = (self.built()?, Instant::now());
        let picked = pick(&built.model, &built.plant, &ray);
        if self.petals.is_on {
            if self.control_point_at(self.plant.window_place(click.at)).is_none() {
                self.choose_petal(picked.map(|picked| picked.element));
            }
            return None;
        }
        let chosen = picked.and_then(|picked| self.part_to_choose(picked.element, click.besides));
        if let Some(chosen) = chosen {
            self.drawing.end_merging();
            self.choose_part(chosen, click.besides);
            return None;
        }
        let Some(picked) = picked else {
            tracing::debug!("picked nothing");
            return None;
        };
        let took_ms = begun.elapsed().as_secs_f64() * 1e3;
        if let Some(place) = place_of(picked.element, &built.beside) {
            tracing::debug!("picked plant={place} took={took_ms:.1}ms");
            self.on_canvas(|canvas, _, out| canvas.deselect(out));
            return Some(Action::SelectPlant(Some(place)));
        }
        let Some(stroke) = picked.element.stroke(&built.plant, &built.provenance) else {
            tracing::debug!("picked {:?} of no stroke", picked.element);
            return None;
        };
        tracing::debug!("picked {:?} stroke={stroke} took={took_ms:.1}ms", picked.element);
        self.beside.select(None);
        Some(Action::SelectStroke { stroke, besides: click.besides })
    }
}

/// Which of the plants beside the drawn one a branch or an organ belongs to.
pub(super) fn place_of(element: Element, beside: &[Option<BuiltBeside>]) -> Option<usize> {
    let holds = |placed: &BuiltBeside| match element {
        Element::Branch(branch) => placed.branches.contains(&branch),
        Element::Organ(organ) => placed.organs.contains(&organ),
    };
    beside.iter().position(|placed| placed.as_ref().is_some_and(holds))
}

#[cfg(test)]
#[path = "picking_tests.rs"]
mod tests;
