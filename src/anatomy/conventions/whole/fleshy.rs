//! Plain mushrooms and cacti.
//!
//! Limits: of a cactus only what its lines enclose is seen, with gaps as wide as [`BRIDGES`] closed.

use super::plain::Plain;
use super::view::{self, View};
use crate::anatomy::conventions::Habit;
use crate::anatomy::conventions::bodies::limbs::Limbs;
use crate::anatomy::conventions::bodies::mushroom::on_stalk;
use crate::anatomy::conventions::shapes::medial_axis::medial_axes;
use crate::anatomy::conventions::shapes::silhouette::Silhouette;
use crate::geom::{polyline, simple_loop::hull_area};
use crate::sketch::Reading;
use glam::Vec2;

/// How wide gaps of a body are closed, in cells of its silhouette, one after the other.
const BRIDGES: [i32; 3] = [6, 12, 20];
/// Least share of its convex hull that a body fills.
const FULL: f32 = 0.3;

/// A cap on a stalk.
pub(super) fn mushroom(view: &View) -> Option<Plain> {
    let stalk = view.stalk()?;
    let outline = view::outline(&view.above(&stalk))?;
    let parts = vec![on_stalk(&stalk, &outline)?];
    Some(Plain { uses: view.own.clone(), parts, reading: Reading::Mushroom, habit: Some(Habit::Mushroom) })
}

/// A column with what branches off it.
pub(super) fn cactus(view: &View) -> Option<Plain> {
    let ink: Vec<Vec2> = view.all().concat();
    let (low, high) = polyline::bounds(ink.iter().copied());
    let foot = Vec2::new(low.x.midpoint(high.x), high.y);
    let body = |bridge: &i32| {
        let silhouette = Silhouette::new(view.lines.iter().map(|line| line.points.as_slice()), *bridge);
        let is_full = silhouette.area() > FULL * hull_area(&ink);
        is_full.then(|| Limbs::new(medial_axes(&silhouette, foot), silhouette.cell())).flatten()
    };
    let parts = BRIDGES.iter().find_map(body)?.branches();
    Some(Plain { uses: view.own.clone(), parts, reading: Reading::Cactus, habit: Some(Habit::Succulent) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;
    use crate::anatomy::conventions::page::Page;

    fn read(read: fn(&View) -> Option<Plain>, lines: &[Vec<Vec2>]) -> Option<Plain> {
        let page = Page::of_lines(lines);
        View::of(&page, (0..page.lines.len()).collect()).and_then(|view| read(&view))
    }

    #[test]
    fn a_column_in_pieces_with_an_arm_is_a_cactus() {
        let lines = [
            line(&[(-20.0, 0.0), (-20.0, -120.0)]),
            line(&[(-16.0, -128.0), (0.0, -140.0), (16.0, -128.0), (20.0, -100.0)]),
            line(&[
                (21.0, -92.0),
                (55.0, -92.0),
                (55.0, -130.0),
                (75.0, -130.0),
                (75.0, -66.0),
                (24.0, -66.0),
            ]),
            line(&[(20.0, -60.0), (20.0, 0.0), (-18.0, 1.0)]),
        ];
        let cactus = read(cactus, &lines).unwrap();
        assert_eq!((cactus.uses.len(), cactus.parts.len()), (4, 2));
        assert!(read(super::cactus, &[line(&[(0.0, 0.0), (60.0, -90.0)])]).is_none(), "a line");
    }

    #[test]
    fn a_cap_that_does_not_meet_its_stalk_is_a_mushroom() {
        let cap = line(&[
            (-60.0, -80.0),
            (-40.0, -120.0),
            (0.0, -135.0),
            (40.0, -120.0),
            (60.0, -80.0),
            (-52.0, -80.0),
        ]);
        let sides = [-10.0, 12.0].map(|x| line(&[(x, -70.0), (x, 0.0)]));
        let mushroom = read(mushroom, &[vec![cap], sides.to_vec()].concat()).unwrap();
        let half = mushroom.parts[0].half_width.unwrap();
        assert!((55.0..65.0).contains(&half), "as wide as its cap: {half}");
    }
}
