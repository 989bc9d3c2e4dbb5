//! The growing stroke: nothing lost, nothing late, calm where asked.

use super::*;
use crate::pen::tests::Hand;
use crate::pen::{PenPhase, PenTool};
use crate::random;
use proptest::prelude::*;

const ALL: [Stabiliser; 3] = [Stabiliser::Off, Stabiliser::Light, Stabiliser::Strong];

fn sample(position: DVec2, time_ms: f64) -> PenSample {
    Hand { position, ..Hand::default() }.event(PenPhase::Move, PenTool::Pen, time_ms).sample
}

fn drawn(places: &[DVec2], stabiliser: Stabiliser) -> StrokeBuilder {
    let (view, how) = (CanvasView::default(), (stabiliser, PressureCurve::default()));
    let mut stroke = StrokeBuilder::begin(1, Tool::Auto, &sample(places[0], 0.0), &view, how).unwrap();
    for (i, place) in places.iter().enumerate().skip(1) {
        stroke.push(&sample(*place, i as f64 * 4.0), &view);
    }
    stroke
}

#[test]
fn straight_lines_stay_straight() {
    let places: Vec<_> =
        (0..80).map(|i| DVec2::new(f64::from(i * i) * 0.1, 2.0 * f64::from(i * i) * 0.1)).collect();
    for stabiliser in ALL {
        for point in drawn(&places, stabiliser).points() {
            assert!((point.position.y - 2.0 * point.position.x).abs() < 1e-3);
        }
    }
}

#[test]
fn jitter_shrinks_by_the_documented_factor() {
    use rand::RngExt;
    let mut random = random::stream(7, "jitter", 0);
    let places: Vec<_> =
        (0..4000).map(|i| DVec2::new(f64::from(i), random.random_range(-1.0..1.0f64))).collect();
    let roughness = |stabiliser| {
        let stroke = drawn(&places, stabiliser);
        let inner = &stroke.points()[50..3950];
        (inner.iter().map(|p| f64::from(p.position.y).powi(2)).sum::<f64>() / inner.len() as f64).sqrt()
    };
    let off = roughness(Stabiliser::Off);
    let (light, strong) = (roughness(Stabiliser::Light) / off, roughness(Stabiliser::Strong) / off);
    assert!((0.37..0.45).contains(&light), "{light}");
    assert!((0.17..0.23).contains(&strong), "{strong}");
}

#[test]
fn pressure_passes_the_curve_for_pens_only() {
    let curve = PressureCurve { end: [1.0, 0.5], ..PressureCurve::default() };
    let view = CanvasView::default();
    for (tool, expected) in [(PenTool::Pen, 0.25), (PenTool::Mouse, 0.5), (PenTool::Finger(1), 0.5)] {
        let touch = Hand::default().event(PenPhase::Down, tool, 0.0).sample;
        let stroke = StrokeBuilder::begin(1, Tool::Auto, &touch, &view, (Stabiliser::Off, curve)).unwrap();
        assert_eq!(stroke.points()[0].pressure, expected);
    }
}

#[test]
fn lifting_adds_a_point_only_where_the_pen_moved() {
    let view = CanvasView::default();
    let mut stroke = drawn(&[DVec2::ZERO, DVec2::ONE], Stabiliser::Light);
    let up = |x| {
        Hand { position: DVec2::new(x, 1.0), ..Hand::default() }.event(PenPhase::Up, PenTool::Pen, 9.0).sample
    };
    assert_eq!(stroke.lift(&up(1.0), &view), None);
    assert!(stroke.lift(&up(3.0), &view).is_some());
    let stroke = stroke.finish();
    let last = stroke.points.last().unwrap();
    assert_eq!((stroke.points.len(), last.position, last.pressure), (3, Vec2::new(3.0, 1.0), 0.5));
}

#[test]
fn a_stroke_off_every_canvas_does_not_begin() {
    let how = (Stabiliser::Off, PressureCurve::default());
    for bad in [DVec2::splat(1e30), DVec2::NAN] {
        let view = CanvasView::default();
        assert!(StrokeBuilder::begin(1, Tool::Auto, &sample(bad, 0.0), &view, how).is_none());
        let mut stroke = drawn(&[DVec2::ONE], Stabiliser::Strong);
        assert_eq!(stroke.push(&sample(bad, 1.0), &view), None);
        assert_eq!(stroke.points().len(), 1);
    }
}

#[test]
fn tilt_turns_with_the_canvas() {
    let turned = tilt_on_canvas(Vec2::new(30.0, 0.0), std::f64::consts::FRAC_PI_2);
    assert!((turned - Vec2::new(0.0, -30.0)).length() < 1e-3);
    assert!(tilt_on_canvas(Vec2::new(90.0, -90.0), 1.0).abs().max_element() <= 90.0);
    assert_eq!(tilt_on_canvas(Vec2::NAN, 0.0), Vec2::ZERO);
}

proptest! {
    #[test]
    fn the_line_is_always_under_the_pen_and_settled_points_stay(
        steps in prop::collection::vec((-500.0..500.0f64, -500.0..500.0f64, -5.0..50.0f64), 1..120), which in 0..3usize
    ) {
        let view = CanvasView::default();
        let mut time_ms = 0.0;
        let mut stroke: Option<StrokeBuilder> = None;
        let mut seen: Vec<StrokePoint> = Vec::new();
        for (x, y, wait) in steps {
            time_ms += wait;
            let sample = sample(DVec2::new(x, y), time_ms);
            let first = match &mut stroke {
                None => {
                    let how = (ALL[which], PressureCurve::default());
                    stroke = StrokeBuilder::begin(1, Tool::Leaf, &sample, &view, how);
                    0
                }
                Some(stroke) => stroke.push(&sample, &view).unwrap(),
            };
            let points = stroke.as_ref().unwrap().points();
            prop_assert_eq!(points.len(), seen.len() + 1, "every sample is a point");
            prop_assert_eq!(points.last().unwrap().position, DVec2::new(x, y).as_vec2());
            prop_assert_eq!(&points[..first], &seen[..first], "what is not told to have changed has not");
            prop_assert!(points.windows(2).all(|w| w[0].time_ms <= w[1].time_ms));
            seen = points.to_vec();
        }
    }
}
