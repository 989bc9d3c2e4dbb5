//! What leans a little, read as if upright: nobody draws quite plumb, and trunks and caps are looked for in level rows.
//!
//! Lines are turned about the page by a few degrees to each side, and what is found there is turned back. Limits: what leans
//! by more than about twice as much is found by its sides alone.

use crate::anatomy::conventions::Made;
use crate::anatomy::conventions::page::Line;
use glam::Vec2;

/// How far plants lean that are read as if upright, radians, to each side.
const LEANS: [f32; 2] = [0.1, -0.1];
/// Log-odds of what leans.
pub(crate) const LEANING: f32 = -0.1;

/// What is found in lines turned to one side, or to the other if that is better, and the angle by which they were turned.
pub(crate) fn turned<T>(
    lines: &[&Line],
    find: impl Fn(&[&Line]) -> Option<T>,
    score: impl Fn(&T) -> f32,
) -> Option<(T, f32)> {
    let turned = |angle: f32| {
        let part = |line: &&Line| line.part(line.points.iter().map(|p| turned_by(*p, angle)).collect());
        let lines: Vec<Line> = lines.iter().filter_map(part).collect();
        Some((find(&lines.iter().collect::<Vec<_>>())?, angle))
    };
    let found = LEANS.into_iter().filter_map(turned);
    found.reduce(|best, it| if score(&it.0) > score(&best.0) { it } else { best })
}

/// A place turned about the origin of the page by an angle in radians.
pub(crate) fn turned_by(p: Vec2, angle: f32) -> Vec2 {
    if angle == 0.0 { p } else { Vec2::from_angle(angle).rotate(p) }
}

/// A part that was found in turned lines, as it stands on the page.
pub(crate) fn turned_back(mut part: Made, angle: f32) -> Made {
    part.points.iter_mut().for_each(|point| point.position = turned_by(point.position, -angle));
    part
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::page::Page;
    use crate::sketch::Tool;

    #[test]
    fn what_leans_is_found_upright_and_stands_as_it_was_drawn() {
        for lean in [0.1, -0.1] {
            let top = Vec2::from_angle(lean).rotate(Vec2::new(0.0, -100.0));
            let page = Page::of_lines(&[vec![Vec2::ZERO, top]]);
            let lines: Vec<&Line> = page.lines.iter().collect();
            let is_plumb = |line: &Line| line.size().x < 0.5;
            let plumb = |lines: &[&Line]| {
                is_plumb(lines[0]).then(|| Made::new(Tool::Branch, lines[0].points.iter().copied()))
            };
            assert!(plumb(&lines).is_none());
            let (found, angle) = turned(&lines, plumb, |_| 1.0).unwrap();
            let points = turned_back(found, angle).points;
            assert!(points[points.len() - 1].position.distance(top) < 0.1);
        }
    }
}
