//! Painted gardens: how many stand where, what keeps free, and that strokes elsewhere move nothing.

use super::*;

fn line(tool: GardenTool, radius: f32, points: &[[f32; 3]]) -> Arc<GardenStroke> {
    let point = |[x, y, pressure]: &[f32; 3]| GardenPoint { at: Vec2::new(*x, *y), pressure: *pressure };
    Arc::new(GardenStroke { tool, radius, density: 1.0, points: points.iter().map(point).collect() })
}

fn roses() -> GardenTool {
    GardenTool::Plants(GardenPlant::species("rose"))
}

fn kind(species: &str, width: f32) -> PaintedKind {
    PaintedKind { plant: GardenPlant::species(species), width, variants: 3 }
}

fn laid(strokes: &[Arc<GardenStroke>], kinds: &[PaintedKind], placed: &[Placed]) -> Vec<Place> {
    let (places, are_all) = places(strokes, kinds, (placed, &GardenParams::default()), 1);
    assert!(are_all);
    places
}

fn least_distance(places: &[Place]) -> f32 {
    let pairs = places.iter().enumerate().flat_map(|(k, a)| places[k + 1..].iter().map(move |b| (a, b)));
    pairs.map(|(a, b)| a.at.distance(b.at)).fold(f32::INFINITY, f32::min)
}

/// A bed of 8 × 2 metres without its round ends.
fn bed(pressure: f32) -> Arc<GardenStroke> {
    line(roses(), 1.0, &[[-4.0, 0.0, pressure], [4.0, 0.0, pressure]])
}

#[test]
fn plants_have_room_for_each_and_more_where_the_pen_presses() {
    let kinds = [kind("rose", 0.5)];
    let [thin, usual, dense] = [0.25, 0.5, 1.0].map(|pressure| laid(&[bed(pressure)], &kinds, &[]));
    // 16 square metres and two half circles of one; each plant has a square of 0.8 of its width.
    let expected = (16.0 + std::f32::consts::PI) / kinds[0].apart().powi(2);
    for (places, range) in [(&thin, 0.42..0.58), (&usual, 0.9..1.1), (&dense, 1.5..2.1)] {
        let share = places.len() as f32 / expected;
        assert!(range.contains(&share), "{share} of what has room, not {range:?}");
    }
    assert!(usual.iter().all(|place| dense.contains(place)), "pressing adds plants and moves none");
    assert!(thin.iter().all(|place| usual.contains(place)));
    let apart = least_distance(&usual);
    assert!(apart > 0.79 * kinds[0].apart(), "{apart}");
    let apart = least_distance(&dense);
    assert!(apart > 0.35 * kinds[0].apart(), "{apart}");
    let outside =
        |place: &Place| Vec2::new(place.at.x.abs() - 4.0, 0.0).max(Vec2::ZERO).x.hypot(place.at.z) > 1.0;
    assert!(!usual.iter().any(outside));
}

#[test]
fn paths_clearings_and_what_stands_keep_plants_off_and_move_none() {
    let kinds = [kind("rose", 0.3)];
    let all = laid(&[bed(0.5)], &kinds, &[]);
    let path = line(GardenTool::Path, 0.3, &[[0.0, -2.0, 0.5], [0.0, 2.0, 0.5]]);
    let with_path = laid(&[bed(0.5), path.clone()], &kinds, &[]);
    let free = |place: &Place| place.at.x.abs() >= 0.3 + GardenParams::default().path_margin;
    assert_eq!(with_path, all.iter().copied().filter(free).collect::<Vec<_>>());
    let clear = line(GardenTool::Clear, 0.6, &[[0.0, -2.0, 0.5], [0.0, 2.0, 0.5]]);
    let cleared = laid(&[bed(0.5), path.clone(), clear.clone()], &kinds, &[]);
    let free = |place: &Place| place.at.x.abs() >= 0.6;
    assert_eq!(cleared, all.iter().copied().filter(free).collect::<Vec<_>>());
    let again = laid(&[bed(0.5), path, clear, bed(0.5)], &kinds, &[]);
    assert_eq!(again, all, "what is painted last lies on top, and the path was cleared");
    let placed = laid(&[bed(0.5)], &kinds, &[(Vec2::new(1.0, 0.0), 0.8)]);
    assert!(placed.iter().all(|place| place.at.distance(Vec3::X) > 0.4));
    assert!(placed.len() < all.len() && placed.iter().all(|place| all.contains(place)));
}

#[test]
fn a_tap_is_one_plant_in_its_place_and_kinds_keep_apart() {
    let tap = line(roses(), 1.0, &[[0.4, 0.7, 0.5]]);
    let one = laid(std::slice::from_ref(&tap), &[kind("rose", 0.5)], &[]);
    assert_eq!(one.iter().map(|place| place.at).collect::<Vec<_>>(), [Vec3::new(0.4, 0.0, 0.7)]);
    let clear = line(GardenTool::Clear, 0.2, &[[0.4, 0.7, 0.5]]);
    assert!(laid(&[tap.clone(), clear.clone()], &[kind("rose", 0.5)], &[]).is_empty());
    assert_eq!(laid(&[clear, tap.clone()], &[kind("rose", 0.5)], &[]), one);
    let daisies =
        line(GardenTool::Plants(GardenPlant::species("daisy")), 1.0, &[[-4.0, 0.0, 0.5], [4.0, 0.0, 0.5]]);
    let strokes = [bed(0.5), daisies, tap];
    assert_eq!(super::kinds(&strokes), [&GardenPlant::species("rose"), &GardenPlant::species("daisy")]);
    let kinds = [kind("rose", 0.5), kind("daisy", 0.2)];
    let mixed = laid(&strokes, &kinds, &[]);
    let (roses, daisies): (Vec<Place>, Vec<Place>) = mixed.iter().partition(|place| place.kind == 0);
    let mut alone = laid(&[bed(0.5)], &kinds[..1], &[]);
    alone.retain(|place| place.at.distance(one[0].at) > 0.5);
    assert!(alone.iter().all(|place| roses.contains(place)), "the wider kind comes first");
    let nearest = daisies.iter().flat_map(|a| roses.iter().map(|b| a.at.distance(b.at)));
    let nearest = nearest.fold(f32::INFINITY, f32::min);
    assert!(
        daisies.len() > 20 && nearest > 0.49 * (kinds[0].apart() + kinds[1].apart()) * MIXED,
        "{nearest}"
    );
}

#[test]
fn strokes_elsewhere_move_no_plant_and_too_many_are_counted() {
    let kinds = [kind("rose", 0.4)];
    let before = laid(&[bed(0.5)], &kinds, &[]);
    let far = line(roses(), 0.7, &[[9.0, 9.0, 0.5], [12.0, 9.0, 0.5]]);
    let after = laid(&[far, bed(0.5)], &kinds, &[]);
    assert!(after.len() > before.len() && before.iter().all(|place| after.contains(place)));
    let meadow = line(roses(), 400.0, &[[-1000.0, 0.0, 1.0], [1000.0, 0.0, 1.0]]);
    let (places, are_all) = places(&[meadow], &[kind("rose", 0.05)], (&[], &GardenParams::default()), 1);
    assert!(!are_all && places.len() <= GardenBudget::PAINTED_PLACES && places.len() > 10_000);
}

#[test]
fn the_ground_is_closed_and_has_what_was_painted() {
    let path = line(GardenTool::Path, 0.3, &[[0.0, -2.0, 0.5], [0.3, 2.0, 0.5]]);
    let params = GardenParams::default();
    let (mesh, materials) = ground(&[bed(0.5), path.clone()], (&[], &params)).unwrap();
    let names: Vec<&str> = materials.iter().map(|material| material.name.as_str()).collect();
    assert_eq!(names, ["lawn", "soil", "gravel"]);
    assert_eq!(mesh.breaks.len(), 2);
    let mut edges: Vec<[u32; 2]> = Vec::new();
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|vertex| mesh.vertices[vertex as usize].point);
        edges.extend([[a, b], [b, c], [c, a]]);
    }
    edges.sort_unstable();
    assert!(edges.windows(2).all(|pair| pair[0] != pair[1]));
    assert!(edges.iter().all(|[a, b]| edges.binary_search(&[*b, *a]).is_ok()), "it is closed");
    let top = |from: usize, to: usize| -> f32 {
        let area = |triangle: &[u32; 3]| {
            let [a, b, c] = mesh.corners(*triangle);
            ((b - a).cross(c - a).y / 2.0).max(0.0)
        };
        mesh.triangles[from..to].iter().map(area).sum()
    };
    let [soil, gravel] = [mesh.breaks[0] as usize, mesh.breaks[1] as usize];
    let path_area = 4.01 * 0.6 + 0.09 * std::f32::consts::PI;
    assert!((top(gravel, mesh.triangles.len()) - path_area).abs() < 0.05, "the path is as wide as painted");
    let bed_area = 16.0 + std::f32::consts::PI - 2.0 * 0.6;
    assert!((top(soil, gravel) - bed_area).abs() < 0.15);
    assert!(ground(&[path], (&[], &GardenParams { cover: Cover::None, ..params })).is_none());
}

#[test]
fn samples_that_do_not_matter_are_left_out() {
    let point = |x: f32, pressure| GardenPoint { at: Vec2::new(x, 0.0), pressure };
    let points: Vec<GardenPoint> = (0..=100).map(|k| point(0.01 * k as f32, 0.5)).collect();
    let few = simplified(&points, 0.5);
    assert!(
        (12..16).contains(&few.len()) && few[0] == points[0] && few.last() == points.last(),
        "{}",
        few.len()
    );
    let pressed = [point(0.0, 0.2), point(0.001, 0.9), point(0.002, 0.9)];
    assert_eq!(simplified(&pressed, 0.5).len(), 3);
    assert_eq!(simplified(&pressed[..1], 0.5).len(), 1);
}
