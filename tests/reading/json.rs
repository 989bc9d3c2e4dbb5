//! The sketch file: what it means, and that writing and reading are inverse.

use super::{read, with_points, with_strokes};
use glam::{Quat, Vec2, Vec3, vec2};
use penstemon::sketch::{
    Brush, Canvas, Correction, GardenDrawing, GardenPlant, GardenPoint, GardenStroke, GardenTool, Graft,
    Maker, PartName, PartPose, PetalShape, Picture, PlacedPlant, Reading, Reference, SeedOf, Sketch, Stroke,
    StrokePoint, TextureChoice, Tool, Verdict, from_bytes, json, limits, textures,
};
use proptest::prelude::*;
use serde_json::{Map, Value};
use std::sync::Arc;

const SMALL_PNG: &[u8] = include_bytes!("../fixtures/reference/small.png");
const SMALL_JPEG: &[u8] = include_bytes!("../fixtures/reference/small.jpg");

#[test]
fn only_format_version_strokes_and_points_are_needed() {
    let (sketch, warnings) = read(&with_points("[[10, 20], [30, 25]]")).unwrap();
    assert_eq!(warnings, []);
    assert_eq!(sketch.canvas, Canvas { width: 20.0, height: 5.0 });
    assert_eq!((sketch.species, sketch.seed, sketch.params.len()), (None, 0, 0));
    let expected = [vec2(10.0, 20.0), vec2(30.0, 25.0)].map(StrokePoint::at).to_vec();
    assert_eq!(sketch.strokes, [Arc::new(Stroke { id: 1, tool: Tool::Auto, points: expected, brush: None })]);
}

#[test]
fn a_point_has_2_3_5_or_6_numbers() {
    let text = with_points("[[1,2], [1,2,0.25], [1,3,0.25,-10,20], [1,2,0.25,-10,20,7.5]]");
    let points = &read(&text).unwrap().0.strokes[0].points;
    let read: Vec<_> = points.iter().map(|p| (p.pressure, p.tilt_deg, p.time_ms)).collect();
    let tilt = vec2(-10.0, 20.0);
    assert_eq!(
        read,
        [(0.5, vec2(0.0, 0.0), 0.0), (0.25, vec2(0.0, 0.0), 0.0), (0.25, tilt, 0.0), (0.25, tilt, 7.5)]
    );
}

#[test]
fn missing_ids_are_filled_with_unused_ones() {
    let stroke = r#"{"points": [[0,0],[1,1]]}"#;
    let text = with_strokes(&format!(r#"{stroke}, {{"id": 1, "points": [[0,0],[1,1]]}}, {stroke}"#));
    let ids: Vec<_> = read(&text).unwrap().0.strokes.iter().map(|s| s.id).collect();
    assert_eq!(ids, [2, 1, 3]);
}

#[test]
fn a_stroke_is_one_line_of_text() {
    let text = with_strokes(r#"{"id": 7, "tool": "leaf", "points": [[0.5, 1], [100, -3.25, 1]]}"#);
    let written = json::write(&read(&text).unwrap().0);
    let expected = r#"{
  "format": "penstemon-sketch",
  "version": 1,
  "canvas": {"width": 99.5, "height": 4.25},
  "seed": 0,
  "params": {},
  "strokes": [
    {"id": 7, "tool": "leaf", "points": [[0.5, 1, 0.5], [100, -3.25, 1]]}
  ]
}
"#;
    assert_eq!(written, expected);
}

#[test]
fn a_byte_order_mark_is_no_obstacle() {
    assert!(read(&format!("\u{feff}{}", with_points("[[0,0],[1,1]]"))).is_ok());
}

#[test]
fn a_straight_stroke_still_has_a_canvas_with_an_area() {
    let (sketch, _) = read(&with_points("[[0,5],[80,5]]")).unwrap();
    assert_eq!(sketch.canvas, Canvas { width: 80.0, height: 80.0 });
}

/// Found by fuzzing: the canvas was held to the limit of coordinates, which lie on both sides of zero.
#[test]
fn the_widest_drawing_has_a_canvas_that_can_be_read_again() {
    let (sketch, _) = read(&with_points("[[-1e7, 1e7], [1e7, -1e7]]")).unwrap();
    assert_eq!(read(&json::write(&sketch)).unwrap().0, sketch);
}

#[test]
fn params_keep_numbers_switches_names_and_groups() {
    let text = r#"{"format": "penstemon-sketch", "version": 1, "seed": 18446744073709551615,
        "species": "daisy", "params": {"a.b": 0.1, "c": {"d": true, "e": -3, "f": "x", "g": 1e-7}},
        "strokes": [{"points": [[0,0],[1,1]]}]}"#;
    let (sketch, _) = read(text).unwrap();
    assert_eq!(sketch.seed, u64::MAX);
    let expected: Value =
        serde_json::from_str(r#"{"a.b": 0.1, "c": {"d": true, "e": -3, "f": "x", "g": 1e-7}}"#).unwrap();
    assert_eq!(Value::Object(sketch.params.clone()), expected);
    assert_eq!(read(&json::write(&sketch)).unwrap().0, sketch);
}

fn point() -> impl Strategy<Value = StrokePoint> {
    let most = limits::MAX_COORDINATE;
    let position = (-most..=most, -most..=most).prop_map(|(x, y)| vec2(x, y));
    let pressure = prop_oneof![Just(0.5_f32), 0.0_f32..=1.0];
    let tilt =
        prop_oneof![Just(vec2(0.0, 0.0)), (-90.0_f32..=90.0, -90.0_f32..=90.0).prop_map(|(x, y)| vec2(x, y))];
    let time = prop_oneof![Just(0.0_f32), 0.0_f32..1e6];
    let depth = prop_oneof![Just(0.0_f32), -most..=most];
    (position, pressure, tilt, time, depth).prop_map(|(position, pressure, tilt_deg, time_ms, depth)| {
        StrokePoint { position, pressure, tilt_deg, time_ms, depth }
    })
}

fn param() -> impl Strategy<Value = Value> {
    let leaf = prop_oneof![
        any::<bool>().prop_map(Value::from),
        any::<i64>().prop_map(Value::from),
        prop::num::f64::NORMAL.prop_map(Value::from),
        ".{0,8}".prop_map(Value::from),
    ];
    leaf.prop_recursive(3, 16, 4, |inner| {
        prop::collection::btree_map(".{1,8}", inner, 0..4)
            .prop_map(|group| Value::Object(group.into_iter().collect::<Map<_, _>>()))
    })
}

prop_compose! {
    fn reference()(
        jpeg in any::<bool>(),
        at in (-1e7_f32..=1e7, -1e7_f32..=1e7),
        width in 1e-3_f32..1e7,
        rotation_deg in -360.0_f32..=360.0,
        opacity in 0.0_f32..=1.0,
        locked in any::<bool>(),
        visible in any::<bool>(),
    ) -> Arc<Reference> {
        let picture = if jpeg { SMALL_JPEG } else { SMALL_PNG };
        let plain = Reference::new(Picture::new(picture).unwrap(), at.into(), width);
        Arc::new(Reference { rotation_deg, opacity, locked, visible, ..plain })
    }
}

fn texture() -> impl Strategy<Value = TextureChoice> {
    let own = prop::sample::select(&[SMALL_PNG, SMALL_JPEG][..]);
    let own = own.prop_map(|bytes| TextureChoice::Own(Picture::new(bytes).unwrap()));
    prop_oneof![".{1,12}".prop_map(TextureChoice::Named), own]
}

prop_compose! {
    fn placed_plant()(
        species in ".{1,12}",
        seed in any::<u64>(),
        age in prop::option::of(0.0_f32..200.0),
        at in (-1e6_f32..1e6, -1e6_f32..1e6),
        height in prop::option::of(0.01_f32..1e5),
    ) -> PlacedPlant {
        PlacedPlant { maker: Maker::Growth(SeedOf { species, seed, age }), foot: at.into(), height }
    }
}

fn correction() -> impl Strategy<Value = Correction> {
    let reading = prop::sample::select(&Reading::ALL[..]);
    let verdict = prop_oneof![
        Just(Verdict::Separate),
        reading.clone().prop_map(Verdict::Not),
        reading.prop_map(Verdict::As)
    ];
    let strokes = prop::collection::vec(any::<u64>(), 1..6);
    (strokes, verdict).prop_map(|(strokes, verdict)| Correction::new(strokes, verdict))
}

fn petal_shape() -> impl Strategy<Value = PetalShape> {
    let strokes = prop::collection::vec(any::<u64>(), 1..6);
    let offsets = prop::array::uniform4(prop::array::uniform4(prop::array::uniform3(-2.0_f32..2.0)));
    (strokes, offsets)
        .prop_map(|(strokes, offsets)| PetalShape::new(strokes, offsets.map(|row| row.map(Vec3::from))))
}

fn part_poses() -> impl Strategy<Value = Vec<PartPose>> {
    let turn = || {
        prop_oneof![
            Just(Quat::IDENTITY),
            prop::array::uniform3(-3.0_f32..3.0)
                .prop_map(|angles| Quat::from_scaled_axis(Vec3::from(angles)))
        ]
    };
    let thickness = || prop_oneof![Just(1.0_f32), 0.2_f32..5.0];
    let shift = || prop_oneof![Just(Vec3::ZERO), prop::array::uniform3(-1e7_f32..1e7).prop_map(Vec3::from)];
    let straight = || prop_oneof![Just(0.0_f32), 0.0_f32..=1.0];
    let part =
        || prop_oneof![any::<u64>().prop_map(PartName::Grown), any::<u64>().prop_map(PartName::Stroke)];
    let graft = || prop::option::of((part(), 0.0_f32..=1.0).prop_map(|(onto, at)| Graft { onto, at }));
    let younger = || prop_oneof![Just(0), any::<u16>()];
    let like = || prop::option::of(part());
    let made = (turn(), turn(), straight(), graft(), like(), shift(), thickness(), younger(), any::<bool>());
    let made =
        made.prop_map(|(turn, bend, straight, graft, like, shift, thickness, younger, is_cut)| PartPose {
            part: PartName::Stroke(0),
            turn,
            bend,
            straight,
            graft,
            like,
            shift,
            thickness,
            younger,
            is_cut,
        });
    let poses = prop::collection::btree_map(part(), made, 0..4);
    poses.prop_map(|poses| {
        let pose = |(part, made): (PartName, PartPose)| PartPose {
            part,
            graft: made.graft.filter(|graft| graft.onto != part),
            like: made.like.filter(|like| *like != part),
            is_cut: made.is_cut && matches!(part, PartName::Grown(_)),
            ..made
        };
        poses.into_iter().map(pose).collect()
    })
}

prop_compose! {
    fn brush()(radius in 1e-3_f32..1e6, density in 0.04_f32..=5.0, guide in -3.0_f32..=3.0) -> Brush {
        Brush { radius, density, guide }
    }
}

/// A bed of another drawing, which is known by its seed.
fn planted(seed: u64) -> GardenTool {
    let points = vec![StrokePoint::at(Vec2::new((seed % 1000) as f32, 1.0)), StrokePoint::at(Vec2::ONE)];
    let stroke = Arc::new(Stroke { id: 7, tool: Tool::Leaf, points, brush: None });
    let drawing = Sketch { seed, strokes: vec![stroke], ..Sketch::empty() };
    GardenTool::Plants(GardenPlant::Drawing(GardenDrawing::new(&seed.to_string(), drawing).unwrap()))
}

prop_compose! {
    fn garden_stroke()(
        tool in prop_oneof![
            Just(GardenTool::Path),
            Just(GardenTool::Clear),
            Just(GardenTool::Plants(GardenPlant::Drawn)),
            (".{1,12}", prop::option::of(0.0_f32..=1e4))
                .prop_map(|(name, age)| GardenTool::Plants(GardenPlant::Species { name, age })),
            any::<u64>().prop_map(planted),
        ],
        radius in 0.01_f32..500.0,
        density in 0.04_f32..=5.0,
        points in prop::collection::vec((-5e3_f32..5e3, -5e3_f32..5e3, 0.0_f32..=1.0), 1..8),
    ) -> Arc<GardenStroke> {
        let point = |(x, y, pressure): (f32, f32, f32)| GardenPoint { at: Vec2::new(x, y), pressure };
        Arc::new(GardenStroke { tool, radius, density, points: points.into_iter().map(point).collect() })
    }
}

prop_compose! {
    fn sketch()(
        size in (1e-3_f32..1e6, 1e-3_f32..1e6),
        species in prop::option::of(".{0,12}"),
        seed in any::<u64>(),
        params in prop::collection::btree_map(".{1,8}", param(), 0..4),
        textures in prop::collection::btree_map(prop::sample::select(&textures::PARTS[..]).prop_map(str::to_owned), texture(), 0..4),
        reference in prop::option::of(reference()),
        plants in prop::collection::vec(placed_plant(), 0..4),
        corrections in prop::collection::vec(correction(), 0..4),
        petal_shapes in prop::collection::vec(petal_shape(), 0..3),
        part_poses in part_poses(),
        garden in prop::collection::vec(garden_stroke(), 0..4),
        strokes in prop::collection::btree_map(
            any::<u64>(),
            (prop::sample::select(&Tool::ALL[..]), prop::collection::vec(point(), 2..20), brush()),
            1..8,
        ),
    ) -> Sketch {
        let strokes = strokes.into_iter().map(|(id, (tool, points, brush))| Arc::new(Stroke { id, tool, points, brush: tool.is_brush().then_some(brush) })).collect();
        let canvas = Canvas { width: size.0, height: size.1 };
        Sketch { canvas, species, seed, params: params.into_iter().collect(), textures, reference, plants, corrections: corrections.into(), petal_shapes: petal_shapes.into(), part_poses: part_poses.into(), garden: garden.into(), strokes }
    }
}

/// A sketch file with this reference and one stroke.
fn with_reference(reference: &str) -> String {
    let file = with_points("[[0, 0], [1, 1]]");
    format!("{}, \"reference\": {reference}}}", file.strip_suffix('}').unwrap())
}

/// A file with a sound reference, as it is written.
fn traced() -> String {
    let (mut sketch, _) = read(&with_points("[[0, 0], [1, 1]]")).unwrap();
    let picture = Picture::new(SMALL_PNG).unwrap();
    sketch.reference = Some(Arc::new(Reference::new(picture, vec2(3.0, 4.0), 50.0)));
    json::write(&sketch)
}

#[test]
fn a_reference_needs_only_its_picture_and_place() {
    let written = traced();
    let picture = written.split("\"picture\":\n    ").nth(1).unwrap().split('}').next().unwrap();
    let text = with_reference(&format!(r#"{{"center": [3, 4], "width": 50, "picture": {picture}}}"#));
    let reference = read(&text).unwrap().0.reference.unwrap();
    assert_eq!(reference.picture.bytes().as_ref(), SMALL_PNG);
    let plain = Reference::new(Picture::new(SMALL_PNG).unwrap(), vec2(3.0, 4.0), 50.0);
    assert_eq!(*reference, plain);
    assert_eq!(read(&with_reference("null")).unwrap().0.reference, None);
}

#[test]
fn a_bad_reference_is_named() {
    let says = |text: &str, part: &str| {
        let message = read(text).unwrap_err().to_string();
        assert!(message.contains(part), "`{part}` is not in: {message}");
    };
    let written = traced();
    says(&written.replace("iVBORw0K", "iVB*Rw0K"), "damaged at character 3 of its base64 text");
    says(&written.replace("iVBORw0K", "AAAAAAAA"), "neither PNG nor JPEG");
    says(
        &written.replace("\"opacity\": 0.5", "\"opacity\": 1.5"),
        "opacity is out of range; it must be 0 to 1",
    );
    says(&written.replace("\"width\": 50", "\"width\": 0"), "width is out of range");
    says(&with_reference(r#"{"center": [0, 0], "width": 5}"#), "missing field `picture`");
    says(&with_reference(r#"{"tilt": 1}"#), "unknown field `tilt`");
    let huge = "A".repeat(limits::MAX_PICTURE_BYTES / 3 * 4 + 100);
    says(&with_reference(&format!(r#"{{"picture": "{huge}"}}"#)), "larger than 32 MiB");
}

#[test]
fn textures_belong_to_parts() {
    let file = with_points("[[0, 0], [1, 1]]");
    let with = |textures: &str| format!("{}, \"textures\": {textures}}}", file.strip_suffix('}').unwrap());
    let (sketch, _) = read(&with(r#"{"leaf": "oak", "branch": "/a/b.png"}"#)).unwrap();
    assert_eq!(sketch.textures["branch"], TextureChoice::Named("/a/b.png".to_owned()));
    let message = |text: &str| read(text).unwrap_err().to_string();
    assert!(
        message(&with(r#"{"stem": "oak"}"#))
            .contains("no part `stem` to give a texture; the parts are branch, leaf")
    );
    assert!(message(&with(r#"{"leaf": ""}"#)).contains("the texture of `leaf`"));
    assert!(message(&with(r#"{"leaf": 3}"#)).contains("did not match"));
}

#[test]
fn a_picture_of_two_parts_is_in_the_file_once_and_comes_back_for_both() {
    let (mut sketch, _) = read(&with_points("[[0, 0], [1, 1]]")).unwrap();
    assert!(json::write(&sketch).contains("\"version\": 1,"), "older programs open what they understand");
    let own = TextureChoice::Own(Picture::new(SMALL_PNG).unwrap());
    sketch.textures = ["leaf", "petal"].map(|part| (part.to_owned(), own.clone())).into();
    let text = json::write(&sketch);
    assert!(text.contains("\"version\": 2,"));
    assert_eq!(text.matches("iVBORw0K").count(), 1, "{text}");
    let (again, warnings) = read(&text).unwrap();
    assert_eq!((&again, warnings.len()), (&sketch, 0));
    assert_eq!(json::write(&again), text);
    let message = |text: &str| read(text).unwrap_err().to_string();
    assert!(message(&text.replace("iVBORw0K", "iVB*Rw0K")).contains("character 3 of its base64 text"));
    assert!(message(&text.replace("    \"", "    \"0")).contains("is not in the file"));
}

proptest! {
    #[test]
    fn written_sketches_read_back_bit_by_bit(sketch in sketch()) {
        let text = json::write(&sketch);
        let (again, warnings) = read(&text).unwrap();
        prop_assert_eq!(&again, &sketch);
        prop_assert_eq!(warnings, vec![]);
        prop_assert_eq!(json::write(&again), text);
    }

    #[test]
    fn any_bytes_end_in_a_sketch_or_a_message(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        if let Err(error) = from_bytes(&bytes, "noise") {
            prop_assert!(error.to_string().starts_with("noise: "));
        }
    }

    #[test]
    fn a_file_with_one_byte_changed_ends_in_a_sketch_or_a_message(
        sketch in sketch(), at in any::<prop::sample::Index>(), byte in any::<u8>(),
    ) {
        let mut bytes = json::write(&sketch).into_bytes();
        let at = at.index(bytes.len());
        bytes[at] = byte;
        if let Ok((changed, _)) = from_bytes(&bytes, "changed") {
            prop_assert_eq!(changed.check_invariants(), Ok(()));
        }
    }
}
