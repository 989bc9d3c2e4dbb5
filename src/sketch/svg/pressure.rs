//! `data-pressure`: what the pen pressed at each point of a polyline, which SVG itself has no word for.

use kurbo::PathEl;
use svgtypes::NumberListParser;

/// The pressures of a path, one for each of its points; `None` if they do not fit it. One alone fits a dot, which SVG
/// has to draw as a line that goes nowhere.
pub(super) fn parse(text: &str, path: &[PathEl]) -> Option<Vec<f32>> {
    let is_polyline = path.iter().enumerate().all(|(i, element)| match element {
        PathEl::MoveTo(_) => i == 0,
        PathEl::LineTo(_) => i > 0,
        _ => false,
    });
    // One more than fits is enough to know that they do not.
    let most = path.len() + 1;
    let pressures: Result<Vec<f64>, _> = NumberListParser::from(text).take(most).collect();
    let pressures: Vec<f32> = pressures.ok()?.into_iter().map(|pressure| pressure as f32).collect();
    let is_dot = matches!(path, [PathEl::MoveTo(from), PathEl::LineTo(to)] if from == to);
    let fits = pressures.len() == path.len() || is_dot && pressures.len() == 1;
    (is_polyline && fits).then_some(pressures)
}
