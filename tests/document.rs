//! The document: history, saving and SVG under random hands, two windows on one file, and files that must not be lost.

#![allow(clippy::unwrap_used, reason = "helpers of tests fail by panicking, as tests do")]

use glam::vec2;
use penstemon::atomic::write_atomically;
use penstemon::pipeline;
use penstemon::sketch::document::Document;
use penstemon::sketch::journal::{JournalState, Meta, Recovery};
use penstemon::sketch::save::{FileStamp, SaveError, open, save};
use penstemon::sketch::settings::Settings;
use penstemon::sketch::{
    Brush, Canvas, Change, GardenDrawing, GardenPlant, GardenPoint, GardenStroke, GardenTool, Maker, Picture,
    PlacedPlant, Reference, SeedOf, Sketch, Step, Stroke, StrokeChange, StrokePoint, TextureChoice, Textures,
    Tool, editable_from_bytes, from_bytes, json, svg, textures,
};
use proptest::prelude::*;
use serde_json::Map;
use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

const PNG: &[u8] = include_bytes!("fixtures/reference/small.png");

/// What a hand might do to a document.
#[derive(Clone, Debug)]
enum Act {
    Apply(Change),
    Merge(Change, u8),
    Undo,
    Redo,
    Save,
}

prop_compose! {
    fn point()(
        x in -1e4_f32..1e4, y in -1e4_f32..1e4, pressure in 0.0_f32..=1.0, tilt in (-90.0_f32..90.0, -90.0_f32..90.0), time_ms in 0.0_f32..1e5, depth in -1e4_f32..1e4,
    ) -> StrokePoint {
        StrokePoint { position: vec2(x, y), pressure, tilt_deg: tilt.into(), time_ms, depth }
    }
}

prop_compose! {
    fn stroke()(id in 1_u64..12, tool in prop::sample::select(&Tool::ALL[..]), points in prop::collection::vec(point(), 1..6)) -> Stroke {
        Stroke { id, tool, points, brush: tool.is_brush().then(Brush::default) }
    }
}

fn stroke_change() -> impl Strategy<Value = StrokeChange> {
    prop_oneof![
        3 => stroke().prop_map(|stroke| StrokeChange::Put(stroke.into())),
        1 => (1_u64..12).prop_map(StrokeChange::Remove),
    ]
}

fn texture() -> impl Strategy<Value = TextureChoice> {
    let own = |end: u8| TextureChoice::Own(Picture::new([PNG, &[end]].concat()).unwrap());
    prop_oneof!["[a-z]{1,5}".prop_map(TextureChoice::Named), (0_u8..3).prop_map(own)]
}

fn change() -> impl Strategy<Value = Change> {
    let reference = |at: f32| Reference::new(Picture::new(PNG).unwrap(), vec2(at, -at), 100.0);
    let plant = |age: f32| {
        let maker = Maker::Growth(SeedOf { species: "oak".to_owned(), seed: 1, age: Some(age) });
        PlacedPlant { maker, foot: vec2(age, 0.0), height: None }
    };
    let tap = |x: f32| {
        let of = |name| GardenDrawing::new(name, Sketch { seed: x as u64, ..Sketch::empty() }).unwrap();
        let plant = match x as u32 % 3 {
            0 => GardenPlant::Drawn,
            1 => GardenPlant::Species { name: "oak".to_owned(), age: Some(x) },
            _ => GardenPlant::Drawing(of(&x.to_string())),
        };
        let points = vec![GardenPoint { at: vec2(x, -x), pressure: 0.5 }];
        Arc::new(GardenStroke { tool: GardenTool::Plants(plant), radius: 0.5, density: 1.0, points })
    };
    let params = |value: f64| Map::from_iter([("depth.spread".to_owned(), value.into())]);
    prop_oneof![
        4 => prop::collection::vec(stroke_change(), 0..5).prop_map(Change::strokes),
        1 => any::<u64>().prop_map(Change::seed),
        1 => prop::option::of("[a-z]{1,5}").prop_map(Change::species),
        1 => (0.0..1.0).prop_map(move |value| Change::params(params(value))),
        1 => texture().prop_map(|choice| Change::textures(Textures::from([("leaf".to_owned(), choice)]))),
        1 => prop::option::of(0.0_f32..9.0).prop_map(move |at| Change::reference(at.map(reference))),
        1 => prop::collection::vec(0.0_f32..9.0, 0..3).prop_map(move |ages| {
            Change::plants(ages.into_iter().map(plant).collect())
        }),
        1 => prop::collection::vec(0.0_f32..9.0, 0..3).prop_map(move |places| {
            Change::garden(places.into_iter().map(tap).collect())
        }),
        1 => (1.0_f32..99.0).prop_map(|width| {
            Settings { canvas: Some(Canvas { width, height: 7.0 }), ..Settings::default() }.into()
        }),
    ]
}

fn act() -> impl Strategy<Value = Act> {
    prop_oneof![
        6 => change().prop_map(Act::Apply),
        3 => (change(), 0_u8..2).prop_map(|(change, key)| Act::Merge(change, key)),
        2 => Just(Act::Undo),
        2 => Just(Act::Redo),
        1 => Just(Act::Save),
    ]
}

/// Does it; the step, if the drawing changed.
fn do_it(document: &mut Document, act: Act) -> Option<Arc<Step>> {
    match act {
        Act::Apply(change) => document.apply(change).unwrap(),
        Act::Merge(change, key) => document.apply_merging(change, &key.to_string()).unwrap(),
        Act::Undo => document.undo(),
        Act::Redo => document.redo(),
        Act::Save => {
            document.mark_saved();
            None
        }
    }
}

proptest! {
    #[test]
    fn undoing_all_gives_the_beginning_and_redoing_all_the_end(acts in prop::collection::vec(act(), 0..40)) {
        let start = Sketch { strokes: vec![Arc::new(Stroke { id: 5, tool: Tool::Leaf, points: vec![StrokePoint::at(vec2(1.0, 2.0))], brush: None })], ..Sketch::empty() };
        let mut document = Document::new(start.clone());
        let mut saved = start.clone();
        let mut replayed = start.clone();
        for act in acts {
            let is_save = matches!(act, Act::Save);
            let revision = document.revision();
            let step = do_it(&mut document, act);
            if is_save { saved = document.sketch().clone(); }
            prop_assert_eq!(document.revision() > revision, step.is_some());
            if let Some(step) = step { step.carry_out(&mut replayed); }
            prop_assert_eq!(&replayed, document.sketch());
            prop_assert_eq!(document.sketch().check_invariants(), Ok(()));
            if document.is_saved() { prop_assert_eq!(document.sketch(), &saved); }
        }
        while document.redo().is_some() {}
        let end = document.sketch().clone();
        let mut states = vec![end.clone()];
        while document.can_undo() {
            document.undo().unwrap();
            states.push(document.sketch().clone());
        }
        prop_assert!(document.undo().is_none());
        prop_assert_eq!(document.sketch(), &start);
        for state in states.iter().rev().skip(1) {
            document.redo().unwrap();
            prop_assert_eq!(document.sketch(), state);
        }
        prop_assert_eq!(document.sketch(), &end);
    }

    #[test]
    fn what_a_document_accepts_is_read_back(acts in prop::collection::vec(act(), 0..20)) {
        let mut document = Document::empty();
        acts.into_iter().for_each(|act| drop(do_it(&mut document, act)));
        let text = json::write(document.sketch());
        let (again, warnings) = editable_from_bytes(text.as_bytes(), "again").unwrap();
        prop_assert_eq!(&again, document.sketch());
        prop_assert_eq!(warnings, vec![]);
    }

    #[test]
    fn svg_gives_the_strokes_back(strokes in prop::collection::vec(stroke(), 1..8), size in (1.0_f32..5000.0, 1.0_f32..5000.0)) {
        let canvas = Canvas { width: size.0, height: size.1 };
        // SVG has no room for brushes.
        let strokes = strokes.into_iter().filter(|stroke| !stroke.tool.is_brush());
        let mut strokes: Vec<_> = strokes.map(Arc::new).collect();
        strokes.push(Arc::new(Stroke { id: 1, tool: Tool::Auto, points: [(0.0, 0.0), (9.0, 9.0)].map(|p| StrokePoint::at(p.into())).to_vec(), brush: None }));
        let drawn = Sketch { canvas, strokes, ..Sketch::empty() };
        let (again, warnings) = from_bytes(svg::write(&drawn).as_bytes(), "drawing.svg").unwrap();
        prop_assert_eq!(warnings, vec![]);
        prop_assert_eq!(again.canvas, canvas);
        prop_assert_eq!(again.strokes.len(), drawn.strokes.len());
        for (again, drawn) in again.strokes.iter().zip(&drawn.strokes) {
            prop_assert_eq!(again.tool, drawn.tool);
            prop_assert_eq!(again.points.len(), drawn.points.len());
            for (a, b) in again.points.iter().zip(&drawn.points) {
                prop_assert!(a.position.distance(b.position) < 0.01);
                prop_assert_eq!(a.pressure, b.pressure);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn the_journal_gives_back_what_was_drawn(acts in prop::collection::vec(act(), 1..30)) {
        let state = tempfile::tempdir().unwrap();
        let recovery = Recovery::at(state.path());
        let mut document = Document::empty();
        let mut writer = recovery.start(document.sketch(), Meta::default(), false).unwrap();
        for act in acts {
            if let Some(step) = do_it(&mut document, act) {
                writer.append(&step);
                writer.snapshot();
            }
        }
        prop_assert_eq!(writer.flush(Duration::from_secs(60)), JournalState::Saved);
        drop(writer);
        let found = recovery.list().unwrap();
        prop_assert_eq!(found.len(), 1);
        prop_assert_eq!(&found[0].content.as_ref().unwrap().sketch, document.sketch());
    }
}

fn with_seed(seed: u64) -> Sketch {
    Sketch { seed, ..Sketch::empty() }
}

#[test]
fn an_empty_drawing_can_be_saved_and_opened_again_but_not_built() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("empty.penstemon");
    let stamp = save(&path, &Sketch::empty(), None).unwrap();
    let opened = open(&path).unwrap();
    assert_eq!((opened.sketch, opened.stamp), (Sketch::empty(), Some(stamp)));
    assert!(penstemon::sketch::read(&path).unwrap_err().to_string().contains("no stroke"));
}

#[test]
fn an_empty_drawing_gives_an_empty_plant() {
    let sketch = Sketch::empty();
    let species = pipeline::species_of(&sketch, Path::new(".")).unwrap();
    let params = pipeline::params_of(&sketch, &species, &[]).unwrap();
    let built = pipeline::build(&sketch, &species, &params);
    assert_eq!(built.plant.check_invariants(), Ok(()));
}

#[test]
fn two_windows_on_one_file_do_not_destroy_each_others_work() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("shared.penstemon");
    save(&path, &with_seed(1), None).unwrap();
    let (first, second) = (open(&path).unwrap().stamp, open(&path).unwrap().stamp);
    let first = save(&path, &with_seed(2), first.as_ref()).unwrap();
    let error = save(&path, &with_seed(3), second.as_ref()).unwrap_err();
    assert!(matches!(error, SaveError::ChangedByOthers { .. }), "{error}");
    let message = error.to_string();
    assert!(message.contains("shared.penstemon") && message.contains("under another name"), "{message}");
    assert_eq!(open(&path).unwrap().sketch.seed, 2);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "no temporary file stays");
    let first = save(&path, &with_seed(4), Some(&first)).unwrap();
    // Touched, but the same: nobody's work is at stake.
    let bytes = fs::read(&path).unwrap();
    fs::write(&path, bytes).unwrap();
    save(&path, &with_seed(5), Some(&first)).unwrap();
    assert!(!first.matches(&path).unwrap());
}

#[test]
fn many_windows_saving_at_once_lose_nothing_unseen() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("race.penstemon");
    for round in 0..20 {
        let start = save(&path, &with_seed(1000 + round), None).unwrap();
        let saved: Vec<u64> = std::thread::scope(|scope| {
            let windows: Vec<_> = (1..=4)
                .map(|seed| {
                    scope.spawn({
                        let path = &path;
                        move || save(path, &with_seed(seed), Some(&start)).is_ok().then_some(seed)
                    })
                })
                .collect();
            windows.into_iter().filter_map(|window| window.join().unwrap()).collect()
        });
        assert_eq!(saved, [open(&path).unwrap().sketch.seed], "exactly one window may think that it saved");
    }
}

#[test]
fn a_vanished_file_is_written_again_and_a_vanished_folder_reported() {
    let folder = tempfile::tempdir().unwrap();
    let below = folder.path().join("below");
    fs::create_dir(&below).unwrap();
    let path = below.join("a.penstemon");
    let stamp = save(&path, &with_seed(1), None).unwrap();
    fs::remove_file(&path).unwrap();
    let stamp = save(&path, &with_seed(2), Some(&stamp)).unwrap();
    fs::remove_dir_all(&below).unwrap();
    let message = save(&path, &with_seed(3), Some(&stamp)).unwrap_err().to_string();
    assert!(message.contains("there is no folder") && message.contains("stays open"), "{message}");
}

#[test]
fn read_only_files_and_those_of_newer_programs_are_not_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.penstemon");
    let stamp = save(&path, &with_seed(1), None).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    let mut rights = fs::metadata(&path).unwrap().permissions();
    rights.set_readonly(true);
    fs::set_permissions(&path, rights).unwrap();
    let error = save(&path, &with_seed(2), Some(&stamp)).unwrap_err();
    assert!(matches!(error, SaveError::ReadOnly { .. }), "{error}");
    assert_eq!(fs::read_to_string(&path).unwrap(), text);

    let newer = folder.path().join("newer.penstemon");
    write_atomically(&newer, text.replacen("\"version\": 1", "\"version\": 99", 1).as_bytes()).unwrap();
    let before = fs::read(&newer).unwrap();
    for expected in [None, Some(&stamp)] {
        let error = save(&newer, &with_seed(2), expected).unwrap_err();
        assert!(matches!(error, SaveError::NewerVersion { version: 99.0, .. }), "{error}");
    }
    assert_eq!(fs::read(&newer).unwrap(), before);
    assert!(open(&newer).unwrap_err().to_string().contains("newer Penstemon"));
}

#[cfg(target_os = "linux")]
#[test]
fn a_drawing_cannot_be_saved_to_a_device_and_says_so() {
    let message = save(Path::new("/dev/full"), &with_seed(1), None).unwrap_err().to_string();
    assert!(message.contains("a device or pipe"), "{message}");
}

#[test]
fn an_imported_svg_has_no_file_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.svg");
    fs::write(&path, "<svg><path d='M0 0L5 5'/></svg>").unwrap();
    assert_eq!(open(&path).unwrap().stamp, None);
    assert_ne!(FileStamp::of_bytes(b"a"), FileStamp::of_bytes(b"b"));
}

#[test]
fn every_kind_of_organ_can_have_a_texture() {
    let expected: Vec<_> =
        penstemon::species::textures::kinds().map(penstemon::species::textures::key).collect();
    assert_eq!(textures::PARTS.to_vec(), expected);
}

#[test]
fn strokes_in_svg_show_how_hard_the_pen_pressed() {
    let at = |pressure| StrokePoint { pressure, ..StrokePoint::at(vec2(3.0, 4.0)) };
    let stroke = |id, pressure| {
        Arc::new(Stroke {
            id,
            tool: Tool::Branch,
            points: vec![at(pressure), StrokePoint::at(vec2(9.0, 9.0))],
            brush: None,
        })
    };
    let text = svg::write(&Sketch { strokes: vec![stroke(1, 0.1), stroke(2, 0.9)], ..Sketch::empty() });
    let widths: Vec<f32> = text
        .split("stroke-width=\"")
        .skip(1)
        .map(|rest| rest.split('"').next().unwrap().parse().unwrap())
        .collect();
    assert!(widths.len() == 2 && widths[0] < widths[1], "{widths:?}");
    assert!(text.contains("data-tool=\"branch\"") && text.contains("data-pressure=\"0.1 0.5\""), "{text}");
}

#[test]
fn pressures_that_do_not_fit_their_path_are_passed_over_with_a_remark() {
    for (path, remark) in [("M0 0 L5 5 L9 9", true), ("M0 0 C1 1 2 2 9 9", true), ("M0 0 L5 5", false)] {
        let text = format!("<svg><path data-pressure='0.2 2' d='{path}'/></svg>");
        let (sketch, warnings) = from_bytes(text.as_bytes(), "a.svg").unwrap();
        let pressures: Vec<f32> = sketch.strokes[0].points.iter().map(|p| p.pressure).collect();
        assert_eq!(warnings.len(), 1, "{path}: {warnings:?}");
        assert_eq!(pressures == [0.2, 1.0], !remark, "{path}: {pressures:?}");
    }
}
