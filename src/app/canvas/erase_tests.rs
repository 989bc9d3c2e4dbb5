//! The erasers: what is touched goes, all else stays where it was.

use super::*;
use crate::app::canvas::stroke_index::gap;
use crate::sketch::Tool;
use glam::Vec2;
use proptest::prelude::*;

fn stroke(id: StrokeId, places: &[Vec2]) -> Arc<Stroke> {
    let point = |(i, p): (usize, &Vec2)| StrokePoint { time_ms: i as f32 * 10.0, ..StrokePoint::at(*p) };
    Arc::new(Stroke {
        id,
        tool: Tool::Leaf,
        points: places.iter().enumerate().map(point).collect(),
        brush: None,
    })
}

fn circle(radius: f32) -> Vec<Vec2> {
    (0..=64).map(|i| Vec2::from_angle(i as f32 / 64.0 * std::f32::consts::TAU) * radius).collect()
}

/// What an eraser of radius 1 leaves of a drawing on its way.
fn erased(strokes: &[Arc<Stroke>], partial: bool, way: &[DVec2]) -> (Vec<StrokeChange>, StrokeIndex) {
    let mut index = StrokeIndex::default();
    index.sync(strokes);
    let mut next = 100;
    let mut new_id = || {
        next += 1;
        next
    };
    let mut eraser = Eraser::begin(partial, way[0], 1.0);
    for place in way {
        eraser.sweep(*place, &mut index, &mut new_id);
    }
    (eraser.changes(), index)
}

fn put(change: &StrokeChange) -> &Stroke {
    match change {
        StrokeChange::Put(stroke) => stroke,
        StrokeChange::Remove(id) => panic!("stroke {id} was removed"),
    }
}

#[test]
fn a_fast_hand_erases_whole_strokes_without_gaps() {
    let strokes: Vec<_> = (0..20)
        .map(|i| stroke(i, &[Vec2::new(i as f32 * 10.0, -5.0), Vec2::new(i as f32 * 10.0, 5.0)]))
        .collect();
    let (changes, index) = erased(&strokes, false, &[DVec2::new(35.0, 0.0), DVec2::new(155.0, 0.0)]);
    let expected: Vec<_> = (4..=15).map(StrokeChange::Remove).collect();
    assert_eq!(changes, expected);
    assert_eq!(index.strokes().count(), 8);
}

#[test]
fn a_line_is_cut_at_the_edge_of_the_disc_and_its_longest_piece_keeps_its_name() {
    let (changes, _) =
        erased(&[stroke(1, &[Vec2::ZERO, Vec2::new(20.0, 0.0)])], true, &[DVec2::new(5.0, 0.0)]);
    assert_eq!(changes.len(), 2);
    let (kept, piece) = (put(&changes[0]), put(&changes[1]));
    assert_eq!((kept.id, kept.points[0].position.x, kept.points[1].position.x), (1, 6.0, 20.0));
    assert_eq!((piece.id, piece.points[0].position.x, piece.points[1].position.x), (101, 0.0, 4.0));
    assert_eq!((kept.points[0].time_ms, kept.tool), (0.0, Tool::Leaf));
}

#[test]
fn crumbs_go() {
    let (changes, _) =
        erased(&[stroke(1, &[Vec2::ZERO, Vec2::new(20.0, 0.0)])], true, &[DVec2::new(1.3, 0.0)]);
    assert_eq!(changes.len(), 1);
    assert_eq!(put(&changes[0]).id, 1);
}

#[test]
fn a_closed_outline_is_opened_where_it_is_cut() {
    let (changes, _) = erased(&[stroke(1, &circle(20.0))], true, &[DVec2::new(-20.0, 0.0)]);
    assert_eq!(changes.len(), 1, "one piece: {changes:?}");
    let points = &put(&changes[0]).points;
    for end in [points.first(), points.last()] {
        assert!(end.unwrap().position.distance(Vec2::new(-20.0, 0.0)) < 1.01);
    }
    assert!(
        points
            .windows(2)
            .all(|w| w[0].time_ms <= w[1].time_ms && w[0].position.distance(w[1].position) < 2.0)
    );
    assert_eq!(points[0].time_ms, 0.0);
}

#[test]
fn a_cut_is_not_bridged_by_the_next_one() {
    // The first place grazes the outline: the gap that it leaves is narrower than that of many closed outlines.
    let way = [
        DVec2::new(20.99, 0.0),
        DVec2::new(20.99, 0.0),
        DVec2::new(30.0, 0.0),
        DVec2::new(0.0, 30.0),
        DVec2::new(0.0, 20.0),
    ];
    let (_, index) = erased(&[stroke(1, &circle(20.0))], true, &way);
    assert_eq!(index.strokes().count(), 2);
    assert!(index.near_line(way[0], way[0], 0.99).is_empty());
}

#[test]
fn pieces_made_and_erased_again_leave_no_trace() {
    let line = stroke(1, &[Vec2::ZERO, Vec2::new(20.0, 0.0)]);
    let way: Vec<DVec2> = [5.0, 0.0].map(|x| DVec2::new(x, 0.0)).into();
    let (changes, _) = erased(&[Arc::clone(&line)], true, &way);
    assert_eq!(changes.len(), 1);
    assert_eq!(put(&changes[0]).points[0].position.x, 6.0);
    let (changes, _) =
        erased(&[line], true, &[DVec2::new(10.0, 0.0), DVec2::new(-5.0, 0.0), DVec2::new(25.0, 0.0)]);
    assert_eq!(changes, [StrokeChange::Remove(1)]);
}

#[test]
fn a_dot_is_erased_and_a_miss_changes_nothing() {
    let dot = stroke(1, &[Vec2::ZERO]);
    assert_eq!(erased(&[Arc::clone(&dot)], true, &[DVec2::new(0.5, 0.5)]).0, [StrokeChange::Remove(1)]);
    assert!(erased(&[dot], true, &[DVec2::new(5.0, 0.5)]).0.is_empty());
}

#[test]
fn erasing_in_ten_thousand_strokes_looks_at_few() {
    let at = |i: u64| Vec2::new((i % 100) as f32 * 10.0, (i / 100) as f32 * 10.0);
    let strokes: Vec<_> = (0..10_000).map(|i| stroke(i, &[at(i), at(i) + 4.0])).collect();
    let mut index = StrokeIndex::default();
    index.sync(&strokes);
    let place = DVec2::new(502.0, 502.0);
    let looked_at = index.in_box(crate::app::canvas::view::Rect { min: place - 6.0, max: place + 6.0 });
    assert!(looked_at.len() < 10, "{looked_at:?}");
    let (changes, _) = erased(&strokes, false, &[place]);
    assert_eq!(changes, [StrokeChange::Remove(5050)]);
}

proptest! {
    #[test]
    fn nothing_remains_under_the_eraser_and_what_is_far_stays(
        places in prop::collection::vec((-20.0..20.0f32, -20.0..20.0f32), 1..30),
        from in (-20.0..20.0f64, -20.0..20.0f64), to in (-20.0..20.0f64, -20.0..20.0f64)
    ) {
        let line: Vec<Vec2> = places.into_iter().map(Vec2::from).collect();
        let drawn = stroke(1, &line);
        let (from, to) = (DVec2::from(from), DVec2::from(to));
        let (_, index) = erased(&[Arc::clone(&drawn)], true, &[from, to]);
        let left: Vec<_> = index.strokes().cloned().collect();
        prop_assert!(index.near_line(from, to, 0.99).is_empty(), "{left:?}");
        // A closed outline runs on over its seam.
        let mut outline = line.clone();
        if f64::from(line[0].distance(line[line.len() - 1])) <= CLOSED_GAP_SHARE * length(&drawn.points) {
            outline.push(line[0]);
        }
        let outline = stroke(1, &outline);
        for piece in &left {
            prop_assert!(piece.points.iter().all(|p| p.position.is_finite() && p.time_ms >= 0.0));
            for point in &piece.points {
                prop_assert!(gap(&outline, point.position.as_dvec2()) < 1e-3, "pieces lie on the stroke");
            }
        }
    }

    #[test]
    fn hostile_sweeps_do_no_harm(x in any::<f64>(), y in any::<f64>(), radius in any::<f64>(), partial in any::<bool>()) {
        let mut index = StrokeIndex::default();
        index.sync(&[stroke(1, &circle(20.0))]);
        let mut eraser = Eraser::begin(partial, DVec2::new(x, y), radius);
        let mut next = 10;
        eraser.sweep(DVec2::new(y, x), &mut index, &mut || { next += 1; next });
        for stroke in index.strokes() {
            prop_assert!(stroke.points.iter().all(|p| p.position.is_finite()));
        }
    }
}
