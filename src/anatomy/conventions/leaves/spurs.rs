//! Where a stroke goes out and comes back over itself: a twig, or a leaf that is a line, in the stroke of its stem.
//!
//! At its tip such a spur turns by nearly half a turn; from there it goes as far as both its sides stay together. Cost: the points of a
//! line for each of its tips.

use crate::geom::polyline;
use glam::Vec2;

/// Points to each side over which the turn at a tip is measured, and least turn, radians.
const STEP: usize = 2;
const TURN: f32 = 2.3;
/// Widest distance of the two sides, as a share of the diagonal of the line.
const APART: f32 = 0.05;
/// Shortest spur, as a share of that.
const SHORTEST: f32 = 0.07;

/// The spurs of a line, each from its root to its tip, and the way that is left without them.
pub(super) fn cut(way: &[Vec2]) -> (Vec<Vec<Vec2>>, Vec<Vec2>) {
    let (low, high) = polyline::bounds(way.iter().copied());
    let diagonal = low.distance(high);
    let (mut spurs, mut rest): (Vec<Vec<Vec2>>, Vec<Vec2>) = (Vec::new(), Vec::new());
    let mut next = 0;
    while next < way.len() {
        let spur = Some(next).filter(|tip| is_tip(way, *tip)).map(|tip| {
            let (begin, end) = sides(way, tip, APART * diagonal);
            (begin, tip, end)
        });
        match spur {
            Some((begin, tip, end))
                if way[begin].distance(way[tip]) > SHORTEST * diagonal && end + 1 < way.len() =>
            {
                rest.truncate(rest.len().saturating_sub(tip - begin - 1).max(1));
                spurs.push(way[begin..=tip].to_vec());
                next = end;
            }
            _ => {
                rest.push(way[next]);
                next += 1;
            }
        }
    }
    (spurs, rest)
}

/// Whether a line turns back at one of its points.
fn is_tip(way: &[Vec2], tip: usize) -> bool {
    if tip < STEP || tip + STEP >= way.len() {
        return false;
    }
    let (before, after) = (way[tip] - way[tip - STEP], way[tip + STEP] - way[tip]);
    before.angle_to(after).abs() > TURN
}

/// How far both sides of a tip stay within a distance: the first and the last point of the spur.
fn sides(way: &[Vec2], tip: usize, apart: f32) -> (usize, usize) {
    let (mut begin, mut end) = (tip, tip);
    loop {
        let back = begin.checked_sub(1).map(|i| (way[i].distance(way[end]), (i, end)));
        let on = Some(end + 1).filter(|k| *k < way.len()).map(|k| (way[begin].distance(way[k]), (begin, k)));
        let both = back.zip(on).map(|(back, on)| {
            let (i, k) = (back.1.0, on.1.1);
            (way[i].distance(way[k]), (i, k))
        });
        let nearest = [both, back, on].into_iter().flatten().find(|way| way.0 < apart);
        match nearest {
            Some((_, sides)) => (begin, end) = sides,
            None => return (begin, end),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::{line, page::even};

    #[test]
    fn a_stroke_that_goes_out_and_back_has_spurs_on_its_way() {
        let drawn = line(&[
            (0.0, 0.0),
            (0.0, -40.0),
            (35.0, -60.0),
            (1.0, -41.0),
            (0.0, -80.0),
            (-30.0, -110.0),
            (0.0, -82.0),
            (0.0, -130.0),
        ]);
        let (spurs, way) = cut(&even(&drawn, 120));
        let tips: Vec<Vec2> = spurs.iter().map(|spur| spur[spur.len() - 1]).collect();
        assert_eq!(tips.len(), 2);
        assert!(tips[0].distance(Vec2::new(35.0, -60.0)) < 4.0 && tips[1].x < -26.0, "{tips:?}");
        assert!(way.iter().all(|p| p.x.abs() < 9.0), "{way:?}");
        assert!(spurs.iter().all(|spur| spur[0].x.abs() < 9.0));
    }

    #[test]
    fn a_zigzag_has_none() {
        let drawn = line(&[(0.0, 0.0), (20.0, -40.0), (40.0, 0.0), (60.0, -40.0), (80.0, 0.0)]);
        assert!(cut(&even(&drawn, 120)).0.is_empty());
    }
}
