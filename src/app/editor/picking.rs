//! A click on the plant selects the stroke that drew what it hits.
//!
//! What was generated leads to the nearest branch below it that was drawn. A plant that grew without a drawing has no
//! strokes to select.

use super::Editor;
use crate::app::action::Action;
use crate::model::pick::pick;
use std::time::Instant;

impl Editor {
    /// What a single click on the plant asks for.
    pub(in crate::app) fn picked_in_plant(&mut self) -> Option<Action> {
        let click = self.plant.take_click()?;
        let ray = self.plant.ray(click.at)?;
        let (built, begun) = (self.built()?, Instant::now());
        let picked = pick(&built.model, &built.plant, &ray)?;
        let took_ms = begun.elapsed().as_secs_f64() * 1e3;
        let stroke = picked.element.stroke(&built.plant, &built.provenance)?;
        tracing::debug!("picked {:?} stroke={stroke} took={took_ms:.1}ms", picked.element);
        Some(Action::SelectStroke { stroke, besides: click.besides })
    }
}

#[cfg(test)]
#[path = "picking_tests.rs"]
mod tests;
