//! Base and tip of a petal or leaf on a photograph.
//!
//! The base is where the contour is narrowest near its lower edge: of the points in the lower part the one around which a
//! stretches of the contour have their ends nearest to each other, so a claw, a stalk and the point of a heart are found, on
//! photographs that stand crooked too. Of equally narrow places the lowest is taken. The tip is where the ray from the base
//! through the centre of area leaves the contour, so that a notched petal's axis passes between its lobes; or the farthest point,
//! where that is nearly there: the point of a leaf.
//!
//! Limits: what lies on its side or upside down needs both points from the artist.

use crate::geom::{polyline, simple_loop};
use glam::{UVec2, Vec2};

/// Share of the height, from the bottom, in which the base is looked for.
const LOW: f32 = 0.45;
/// Half the stretches of contour around a base, as shares of all of it.
const STRETCHES: [f32; 4] = [0.012, 0.025, 0.04, 0.06];
/// How much narrower, as shares of the stretch, a place must be to be taken though it lies a whole height above the lowest.
const HIGHER: f32 = 1.0;

/// Indices of base and tip on a contour; `given` are the places that the artist pointed at, in pixels of a picture of this size.
/// `None` where these are outside of the picture or nearly the same.
pub(super) fn ends(contour: &[Vec2], given: Option<[Vec2; 2]>, size: UVec2) -> Option<[usize; 2]> {
    let found = match given {
        None => {
            let base = base(contour);
            [base, tip(contour, base)]
        }
        Some(places) => {
            let picture = size.as_vec2();
            let is_in = |p: Vec2| p.cmpge(Vec2::ZERO).all() && p.cmple(picture).all();
            if !places.into_iter().all(is_in) {
                return None;
            }
            places.map(|place| nearest(contour, place))
        }
    };
    let apart = contour[found[0]].distance(contour[found[1]]);
    (apart >= 4.0).then_some(found)
}

/// The point of the contour nearest to a place.
fn nearest(contour: &[Vec2], place: Vec2) -> usize {
    let away = |i: &usize| contour[*i].distance_squared(place);
    (0..contour.len()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(0)
}

/// Where the contour is narrowest near the lower edge.
fn base(contour: &[Vec2]) -> usize {
    let (top, bottom) =
        contour.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(lo, hi), p| (lo.min(p.y), hi.max(p.y)));
    let height = (bottom - top).max(f32::MIN_POSITIVE);
    let closed: Vec<Vec2> = contour.iter().chain(contour.first()).copied().collect();
    let arcs = polyline::arc_lengths(closed.iter().copied());
    let length = arcs.last().map_or(0.0, |length| length.max(f32::MIN_POSITIVE));
    let at = |arc: f32| polyline::interpolate(&closed, polyline::locate(&arcs, arc.rem_euclid(length)));
    let narrow = |i: usize| {
        let width = |share: f32| {
            let stretch = share * length;
            let ends = [-stretch, stretch].map(|by| at(arcs[i] + by));
            ends[0].distance(ends[1]) / (stretch * STRETCHES.len() as f32)
        };
        STRETCHES.map(width).iter().sum::<f32>() + HIGHER * (bottom - contour[i].y) / height
    };
    let low = (0..contour.len()).filter(|i| contour[*i].y >= bottom - LOW * height);
    let scored = low.map(|i| (i, narrow(i)));
    scored.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(i, _)| i)
}

/// Greatest angle between that ray and the farthest point that is the tip instead.
const POINT_DEG: f32 = 7.0;

/// Where the ray from the base through the centre of area leaves the contour for good.
fn tip(contour: &[Vec2], base: usize) -> usize {
    let from = contour[base];
    let area = simple_loop::signed_area(contour.iter().copied());
    let moment: Vec2 = (0..contour.len())
        .map(|i| (contour[i] - from, contour[(i + 1) % contour.len()] - from))
        .map(|(a, b)| (a + b) * a.perp_dot(b))
        .sum();
    let ray = (moment / (6.0 * area)).normalize_or(Vec2::NEG_Y);
    let side = |i: usize| ray.perp_dot(contour[i] - from);
    let crosses = |i: &usize| (side(*i) > 0.0) != (side((*i + 1) % contour.len()) > 0.0);
    let along = |i: &usize| ray.dot(contour[*i] - from);
    let farthest = |all: &mut dyn Iterator<Item = usize>| all.max_by(|a, b| along(a).total_cmp(&along(b)));
    let away = |i: &usize| contour[*i].distance_squared(from);
    let far = (0..contour.len()).max_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(base);
    if (contour[far] - from).normalize_or_zero().dot(ray) > POINT_DEG.to_radians().cos() {
        return far;
    }
    farthest(&mut (0..contour.len()).filter(crosses)).filter(|i| along(i) > 0.0).unwrap_or(base)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(points: impl Iterator<Item = Vec2>, deg: f32) -> Vec<Vec2> {
        let turn = Vec2::from_angle(deg.to_radians());
        points.map(|p| turn.rotate(p) + Vec2::splat(300.0)).collect()
    }

    /// A heart with its point below, 200 pixels high; y down.
    fn notched() -> impl Iterator<Item = Vec2> {
        (0..400).map(|k| k as f32 * std::f32::consts::TAU / 400.0).map(|t| {
            let y = 13.0 * t.cos() - 5.0 * (2.0 * t).cos() - 2.0 * (3.0 * t).cos() - (4.0 * t).cos();
            Vec2::new(16.0 * t.sin().powi(3), -y) * 7.0
        })
    }

    #[test]
    fn a_notched_petals_point_is_its_base_and_its_notch_the_tip_though_it_stands_crooked() {
        for deg in [-40.0, -15.0, 0.0, 25.0, 45.0] {
            let contour = turned(notched(), deg);
            let [base, tip] = ends(&contour, None, UVec2::splat(600)).unwrap();
            let known = turned([Vec2::new(0.0, 119.0), Vec2::new(0.0, -35.0)].into_iter(), deg);
            assert!(contour[base].distance(known[0]) < 4.0, "{deg}: {}", contour[base]);
            assert!(contour[tip].distance(known[1]) < 4.0, "{deg}: {}", contour[tip]);
        }
    }

    #[test]
    fn a_claw_is_the_base_and_a_disc_stands_on_its_lowest_point() {
        let claw =
            [(-10, 100), (-12, 60), (-80, 0), (-70, -80), (0, -110), (70, -80), (80, 0), (12, 60), (10, 100)];
        let dense = claw.iter().zip(claw.iter().cycle().skip(1)).flat_map(|(a, b)| {
            let [a, b] = [a, b].map(|(x, y)| Vec2::new(*x as f32, *y as f32));
            (0..20).map(move |k| a.lerp(b, k as f32 / 20.0))
        });
        let contour = turned(dense, 0.0);
        let [base, tip] = ends(&contour, None, UVec2::splat(600)).unwrap();
        assert!(contour[base].distance(Vec2::new(300.0, 400.0)) < 11.0, "{}", contour[base]);
        assert!(contour[tip].distance(Vec2::new(300.0, 190.0)) < 6.0, "{}", contour[tip]);
        let disc = turned((0..360).map(|k| 90.0 * Vec2::from_angle((k as f32).to_radians())), 0.0);
        let [base, tip] = ends(&disc, None, UVec2::splat(600)).unwrap();
        assert!(disc[base].distance(Vec2::new(300.0, 390.0)) < 3.0);
        assert!(disc[tip].distance(Vec2::new(300.0, 210.0)) < 3.0);
    }

    #[test]
    fn places_of_the_artist_are_taken_and_wrong_ones_refused() {
        let contour = turned(notched(), 180.0);
        let size = UVec2::new(600, 700);
        let given = [Vec2::new(300.0, 170.0), Vec2::new(300.0, 330.0)];
        let [base, tip] = ends(&contour, Some(given), size).unwrap();
        assert!(contour[base].y < 190.0 && contour[tip].y > 320.0);
        for given in [[Vec2::NAN, Vec2::ONE], [Vec2::splat(-5.0), given[1]], [given[0], given[0]]] {
            assert_eq!(ends(&contour, Some(given), size), None);
        }
    }
}
