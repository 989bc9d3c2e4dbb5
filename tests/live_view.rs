//! The live view of the window: it shows what finished pictures show, uploads only what changed, and survives odd sizes.
//!
//! Pictures to look at are left in `target/tmp/live_view`.

#![allow(clippy::unwrap_used, reason = "a test's helper may fail the test")]

use glam::{Vec2, Vec3};
use penstemon::app::growth_spots::drawn;
use penstemon::cli::common::built_in_texture;
use penstemon::formats::textures::fetch;
use penstemon::growth::overlay::{Kind, Spot, Wanted};
use penstemon::model::{InstancedModel, Mesh, Model, Part};
use penstemon::pipeline::{Built, Cache, build, build_with, params_of, species_of};
use penstemon::plant::Texture;
use penstemon::render::{
    Background, Direction, Gpu, Look, Mode, OrbitCamera, PictureOptions, Projection, Quality, RenderError,
    RenderedImage, Renderer, View, Viewport,
};
use penstemon::sketch::{Sketch, Stroke, StrokePoint, Tool};
use std::borrow::Cow;
use std::error::Error;
use std::path::Path;
use std::sync::Arc;

const SIZE: (u32, u32) = (240, 280);

pub(crate) fn textures(texture: &Texture) -> Result<Cow<'static, [u8]>, Box<dyn Error + Send + Sync>> {
    Ok(fetch(texture, &built_in_texture)?)
}

fn plant(name: &str) -> Model {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sketches");
    let (sketch, _) = penstemon::sketch::read(&folder.join(format!("{name}.penstemon"))).unwrap();
    let species = species_of(&sketch, &folder).unwrap();
    let params = params_of(&sketch, &species, &[]).unwrap();
    build(&sketch, &species, &params).model
}

/// A renderer and a view of this model.
pub(crate) fn opened(model: &Model) -> (Renderer, Viewport) {
    let renderer = Renderer::new().unwrap();
    let mut viewport = Viewport::new(&renderer).unwrap();
    viewport.set_size(SIZE.0, SIZE.1);
    viewport.update(&renderer, model, &textures).unwrap();
    (renderer, viewport)
}

/// The mesh of a part, to be changed.
fn mesh_mut(part: &mut Part) -> &mut Mesh {
    Arc::make_mut(&mut part.mesh)
}

fn points(model: &Model) -> Vec<Vec3> {
    model.parts.iter().flat_map(Part::points).collect()
}

/// The camera that makes the finished picture of a view.
pub(crate) fn camera(model: &Model, view: &View) -> OrbitCamera {
    let mut camera = OrbitCamera::of_view(view);
    camera.fit_points(&points(model), model.bounds().unwrap(), SIZE.0 as f32 / SIZE.1 as f32);
    camera
}

pub(crate) fn shot(
    renderer: &Renderer,
    viewport: &mut Viewport,
    camera: &OrbitCamera,
    look: &Look,
) -> RenderedImage {
    viewport.draw(renderer, camera, look).unwrap();
    viewport.snapshot(renderer).unwrap()
}

pub(crate) fn keep(name: &str, picture: &RenderedImage) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("live_view");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join(format!("{name}.png")), picture.to_png().unwrap()).unwrap();
}

/// Mean difference of the channels, and the share of pixels that differ by more than `much`, of 255.
pub(crate) fn difference(a: &RenderedImage, b: &RenderedImage, much: u8) -> (f32, f32) {
    assert_eq!((a.width(), a.height()), (b.width(), b.height()));
    let pairs = || a.pixels().iter().zip(b.pixels()).map(|(a, b)| a.abs_diff(*b));
    let mean = pairs().map(f32::from).sum::<f32>() / a.pixels().len() as f32;
    let far = a.pixels().as_chunks::<4>().0.iter().zip(b.pixels().as_chunks::<4>().0);
    let far = far.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > much)).count();
    (mean, far as f32 / (a.width() * a.height()) as f32)
}

fn draft() -> Look {
    Look { quality: Quality::Draft, ..Look::default() }
}

#[test]
fn a_full_view_is_the_finished_picture() {
    let model = plant("daisy");
    let (mut renderer, mut viewport) = opened(&model);
    let views = [
        View::default(),
        View { direction: Direction::ThreeQuarter, ..View::default() },
        View { projection: Projection::Orthographic, turn_deg: 70.0, ..View::default() },
        View { direction: Direction::Top, ..View::default() },
    ];
    for (i, view) in views.iter().enumerate() {
        for background in [Background::Paper, Background::Outdoors, Background::Transparent] {
            let options = PictureOptions { width: SIZE.0, height: SIZE.1, background };
            let finished = renderer.picture(&model, &textures, view, &options).unwrap();
            let look = Look { background, ..Look::default() };
            let live = shot(&renderer, &mut viewport, &camera(&model, view), &look);
            keep(&format!("full_{i}_{}", background as u8), &live);
            let (mean, far) = difference(&finished, &live, 24);
            assert!(mean < 0.6 && far < 0.004, "{view:?} {background:?}: {mean} {far}");
        }
    }
}

#[test]
fn a_draft_looks_much_like_the_full_picture() {
    let model = plant("daisy");
    let (renderer, mut viewport) = opened(&model);
    let camera = camera(&model, &View::default());
    let drafted = shot(&renderer, &mut viewport, &camera, &draft());
    keep("draft", &drafted);
    let full = shot(&renderer, &mut viewport, &camera, &Look::default());
    let (mean, far) = difference(&drafted, &full, 60);
    assert!(mean < 5.0 && far < 0.06, "{mean} {far}");
    assert!(mean > 0.0, "they are different pictures");
}

#[test]
fn drafts_in_between_leave_no_trace_in_the_full_picture() {
    let (daisy, tree) = (plant("daisy"), plant("tree_round"));
    let (renderer, mut viewport) = opened(&daisy);
    let turned = camera(&daisy, &View { turn_deg: 50.0, ..View::default() });
    let straight = shot(&renderer, &mut viewport, &turned, &Look::default());
    viewport.update(&renderer, &tree, &textures).unwrap();
    let tree_camera = camera(&tree, &View::default());
    shot(&renderer, &mut viewport, &tree_camera, &draft());
    viewport.update(&renderer, &daisy, &textures).unwrap();
    shot(&renderer, &mut viewport, &camera(&daisy, &View::default()), &draft());
    let again = shot(&renderer, &mut viewport, &turned, &Look::default());
    let (mean, far) = difference(&straight, &again, 8);
    assert!(mean < 0.01 && far < 1e-3, "{mean} {far}");
}

#[test]
fn only_changed_parts_are_uploaded() {
    let mut model = plant("daisy");
    let (renderer, mut viewport) = opened(&model);
    let same = viewport.update(&renderer, &model, &textures).unwrap();
    assert_eq!((same.uploaded_parts, same.removed_parts, same.bytes, same.uploaded_textures), (0, 0, 0, 0));

    let petal = model.parts.iter().position(|p| p.name.starts_with("petal")).unwrap();
    let mesh = mesh_mut(&mut model.parts[petal]);
    mesh.points.iter_mut().for_each(|p| *p += Vec3::new(0.0, 0.004, 0.0));
    let vertices = mesh.vertices.len() as u64;
    let moved = viewport.update(&renderer, &model, &textures).unwrap();
    assert_eq!((moved.parts, moved.uploaded_parts, moved.removed_parts), (model.parts.len(), 1, 1));
    assert!(moved.bytes < vertices * 36 + 2 * 4 * 3 * 3 * vertices, "{} bytes", moved.bytes);

    let mut without = model.clone();
    without.parts.remove(petal);
    without.parts.iter_mut().for_each(|p| p.name = format!("other_{}", p.name).into());
    let removed = viewport.update(&renderer, &without, &textures).unwrap();
    assert_eq!((removed.uploaded_parts, removed.removed_parts), (0, 1), "other names are no other meshes");

    let back = viewport.update(&renderer, &model, &textures).unwrap();
    assert_eq!((back.uploaded_parts, back.removed_parts), (1, 0));
    let camera = camera(&model, &View::default());
    let live = shot(&renderer, &mut viewport, &camera, &Look::default());
    let (renderer, mut fresh) = opened(&model);
    let (mean, far) = difference(&live, &shot(&renderer, &mut fresh, &camera, &Look::default()), 8);
    assert!(mean < 0.01 && far < 1e-3, "{mean} {far}");
}

#[test]
fn a_model_may_change_wholly_and_vanish() {
    let (daisy, tree) = (plant("daisy"), plant("tree_round"));
    let (renderer, mut viewport) = opened(&daisy);
    let to_tree = viewport.update(&renderer, &tree, &textures).unwrap();
    let slots = |model: &Model| {
        let of_meshes: usize = model.parts.iter().map(|part| part.material_slots().count()).sum();
        of_meshes + InstancedModel::from(model).groups.len()
    };
    assert_eq!((to_tree.uploaded_parts, to_tree.removed_parts), (slots(&tree), slots(&daisy)));
    viewport.update(&renderer, &Model::default(), &textures).unwrap();
    assert_eq!(viewport.bounds(), None);
    let empty = shot(&renderer, &mut viewport, &OrbitCamera::default(), &Look::default());
    let [r, g, b, a] = empty.pixel(SIZE.0 / 2, SIZE.1 / 2).unwrap();
    assert!(r > 200 && g > 200 && b > 180 && a == 255, "paper {r} {g} {b} {a}");
    let again = viewport.update(&renderer, &daisy, &textures).unwrap();
    assert_eq!((again.uploaded_parts, again.uploaded_textures), (slots(&daisy), 0));
}

#[test]
fn a_refused_model_leaves_the_view_as_it_was() {
    let model = plant("daisy");
    let (renderer, mut viewport) = opened(&model);
    let camera = camera(&model, &View::default());
    let before = shot(&renderer, &mut viewport, &camera, &Look::default());
    let mut broken = model.clone();
    mesh_mut(&mut broken.parts[2]).points[0].x = f32::NAN;
    let refused = viewport.update(&renderer, &broken, &textures);
    assert!(matches!(refused, Err(RenderError::Model { .. })), "{refused:?}");
    let mut missing = model.clone();
    missing.materials[0].texture = Some(Texture::File("nowhere.png".into()));
    assert!(matches!(viewport.update(&renderer, &missing, &textures), Err(RenderError::Texture { .. })));
    let unchanged = viewport.update(&renderer, &model, &textures).unwrap();
    assert_eq!((unchanged.uploaded_parts, unchanged.removed_parts), (0, 0));
    assert_eq!(before, shot(&renderer, &mut viewport, &camera, &Look::default()));
}

#[test]
fn nothing_is_drawn_twice_or_without_size() {
    let model = plant("daisy");
    let (renderer, mut viewport) = opened(&model);
    let camera = camera(&model, &View::default());
    assert!(viewport.draw(&renderer, &camera, &draft()).unwrap());
    assert!(!viewport.draw(&renderer, &camera, &draft()).unwrap(), "nothing changed");
    let mut turned = camera;
    turned.orbit(Vec2::new(0.1, 0.0));
    assert!(viewport.draw(&renderer, &turned, &draft()).unwrap());
    let revision = viewport.revision();
    for size in [(0, 10), (10, 0), (0, 0)] {
        viewport.set_size(size.0, size.1);
        assert!(!viewport.draw(&renderer, &camera, &draft()).unwrap(), "{size:?}");
    }
    for size in [(1, 1), (7, 300), (333, 5)] {
        viewport.set_size(size.0, size.1);
        assert!(viewport.draw(&renderer, &camera, &draft()).unwrap());
        let shown = viewport.snapshot(&renderer).unwrap();
        assert_eq!((shown.width(), shown.height()), size);
    }
    assert!(viewport.revision() > revision);
    viewport.set_size(1_000_000, 2);
    assert!(matches!(viewport.draw(&renderer, &camera, &draft()), Err(RenderError::Size { .. })));
    viewport.set_size(20, 20);
    assert!(viewport.draw(&renderer, &camera, &draft()).unwrap(), "it goes on after a refusal");
}

#[test]
fn the_same_view_is_the_same_bytes() {
    let model = plant("daisy");
    let looks = [draft(), Look::default(), Look { mode: Mode::Wireframe, ..Look::default() }];
    for look in looks {
        let pictures = [(); 2].map(|()| {
            let (renderer, mut viewport) = opened(&model);
            shot(&renderer, &mut viewport, &camera(&model, &View::default()), &look)
        });
        assert!(pictures[0] == pictures[1], "{look:?}");
    }
}

#[test]
fn debugging_views_show_parts_and_edges() {
    let model = plant("daisy");
    let (renderer, mut viewport) = opened(&model);
    let camera = camera(&model, &View::default());
    let mut look = Look { mode: Mode::PartColours, background: Background::Transparent, ..Look::default() };
    let parts = shot(&renderer, &mut viewport, &camera, &look);
    keep("part_colours", &parts);
    look.mode = Mode::Wireframe;
    let edges = shot(&renderer, &mut viewport, &camera, &look);
    keep("wireframe", &edges);
    let count = |picture: &RenderedImage, wanted: &dyn Fn([u8; 4]) -> bool| {
        picture.pixels().as_chunks::<4>().0.iter().filter(|p| wanted(**p)).count()
    };
    let solid = |p: [u8; 4]| p[3] == 255;
    let pink = |p: [u8; 4]| solid(p) && p[0] > p[1] + 20 && p[2] > p[1] + 10;
    assert!(count(&parts, &pink) > 500, "petals {}", count(&parts, &pink));
    assert!(count(&parts, &|p| solid(p) && p[1] > p[0] && p[1] > p[2]) > 100, "leaves");
    let dark = |p: [u8; 4]| solid(p) && p[..3].iter().all(|c| *c < 90);
    assert!(count(&edges, &dark) > 10 * count(&parts, &dark).max(20), "edges are dark lines");
}

#[test]
fn the_panel_moves_the_sun_and_the_theme_darkens_the_sheet() {
    let model = plant("daisy");
    let (renderer, mut viewport) = opened(&model);
    let camera = camera(&model, &View::default());
    let plain = shot(&renderer, &mut viewport, &camera, &Look::default());
    let dark = Look { background: Background::Dark, ..Look::default() };
    let dark = shot(&renderer, &mut viewport, &camera, &dark);
    keep("dark", &dark);
    assert!(dark.pixel(5, 5).unwrap()[..3].iter().all(|c| *c < 60));
    let mut evening = Look::default();
    evening.light.sun_azimuth_deg = 60.0;
    evening.light.sun_elevation_deg = 12.0;
    evening.light.sun_temperature_k = 2600.0;
    let evening = shot(&renderer, &mut viewport, &camera, &evening);
    keep("evening", &evening);
    let warmth = |p: &RenderedImage| {
        p.pixels().as_chunks::<4>().0.iter().map(|p| f32::from(p[0]) - f32::from(p[2])).sum::<f32>()
    };
    assert!(warmth(&evening) > warmth(&plain));
    let mut night = Look { background: Background::Transparent, ..Look::default() };
    night.light.sun_strength = 0.0;
    night.light.sky_strength = 0.3;
    let night = shot(&renderer, &mut viewport, &camera, &night);
    let brightness = |p: &RenderedImage| {
        let seen = p.pixels().as_chunks::<4>().0.iter().filter(|p| p[3] == 255);
        let (sum, count) = seen.fold((0.0, 0.0), |(s, n), p| (s + f32::from(p[1]), n + 1.0));
        sum / count
    };
    let transparent = Look { background: Background::Transparent, ..Look::default() };
    let day = shot(&renderer, &mut viewport, &camera, &transparent);
    assert!(brightness(&night) < 0.75 * brightness(&day), "{} {}", brightness(&night), brightness(&day));
}

#[test]
fn a_lost_device_is_said_and_nothing_panics() {
    let model = plant("daisy");
    let (renderer, mut viewport) = opened(&model);
    assert!(!renderer.is_lost());
    let camera = camera(&model, &View::default());
    viewport.draw(&renderer, &camera, &Look::default()).unwrap();
    renderer.device().destroy();
    // The device reports its loss when it has finished what it was doing.
    let _ = renderer.device().poll(wgpu::PollType::wait_indefinitely());
    assert!(renderer.is_lost());
    let mut turned = camera;
    for _ in 0..2 {
        turned.turn(10.0);
        assert!(matches!(viewport.draw(&renderer, &turned, &draft()), Err(RenderError::Gpu { .. })));
        assert!(matches!(
            viewport.update(&renderer, &plant("daisy"), &textures),
            Err(RenderError::Gpu { .. })
        ));
    }
    assert!(viewport.snapshot(&renderer).is_err());
}

#[test]
fn a_device_that_somebody_else_opened_will_do() {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
    let adapter = pollster::block_on(instance.request_adapter(&Default::default())).unwrap();
    let (device, queue) = pollster::block_on(adapter.request_device(&Default::default())).unwrap();
    let renderer = Renderer::on(Gpu::from_parts(device.clone(), queue, &adapter.get_info())).unwrap();
    assert!(renderer.adapter().contains(&adapter.get_info().name));
    let mut viewport = Viewport::new(&renderer).unwrap();
    viewport.set_size(SIZE.0, SIZE.1);
    let model = plant("daisy");
    viewport.update(&renderer, &model, &textures).unwrap();
    let picture = shot(&renderer, &mut viewport, &camera(&model, &View::default()), &draft());
    let green = picture
        .pixels()
        .as_chunks::<4>()
        .0
        .iter()
        .filter(|p| p[1] > p[0].saturating_add(20) && p[1] > p[2].saturating_add(20));
    assert!(green.count() > 1000, "leaves");
    let endless = wgpu::BufferDescriptor {
        label: None,
        size: u64::MAX / 2,
        usage: wgpu::BufferUsages::VERTEX,
        mapped_at_creation: false,
    };
    drop(device.create_buffer(&endless));
    assert!(renderer.check().is_err(), "failures of the other one's commands are collected too");
    assert!(!renderer.is_lost() && renderer.check().is_ok());
}

/// The pixel in which a point of the world is seen.
fn pixel_of(camera: &OrbitCamera, world: Vec3) -> Vec2 {
    let size = Vec2::new(SIZE.0 as f32, SIZE.1 as f32);
    camera.project(world).unwrap() * size.y + 0.5 * size
}

/// Pixels that differ, with how much they do.
fn changes(a: &RenderedImage, b: &RenderedImage) -> Vec<(Vec2, u8)> {
    let (a, b) = (a.pixels().as_chunks::<4>().0, b.pixels().as_chunks::<4>().0);
    let by = |(a, b): (&[u8; 4], &[u8; 4])| a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0);
    let at = |k: usize| Vec2::new((k % SIZE.0 as usize) as f32 + 0.5, (k / SIZE.0 as usize) as f32 + 0.5);
    let all = a.iter().zip(b).map(by).enumerate();
    all.filter(|(_, by)| *by > 0).map(|(k, by)| (at(k), by)).collect()
}

#[test]
fn spots_stand_where_they_are_and_shine_faintly_through_the_plant() {
    let model = plant("daisy");
    let (renderer, mut viewport) = opened(&model);
    let camera = camera(&model, &View { projection: Projection::Orthographic, ..View::default() });
    let (low, high) = model.bounds().unwrap();
    let look = Look { mode: Mode::PartColours, ..Look::default() };
    let plain = shot(&renderer, &mut viewport, &camera, &look);
    let radius = 0.015 * (high - low).length();
    // How much the middle of a spot changes.
    let mut change = |at: Vec3, kind: Kind| {
        viewport.set_overlay(&renderer, &drawn(&[Spot { at, radius, kind }]));
        let shown = shot(&renderer, &mut viewport, &camera, &look);
        let changed = changes(&plain, &shown);
        assert!(changed.len() > 8, "{kind:?} at {at} is not seen");
        let reach = 1.5 + pixel_of(&camera, at + Vec3::X * radius).distance(pixel_of(&camera, at));
        for (pixel, _) in &changed {
            let off = pixel.distance(pixel_of(&camera, at));
            assert!(off <= reach, "{kind:?}: {off} pixels from where it is, {reach} at most");
        }
        let off = |pixel: &Vec2| pixel.distance(pixel_of(&camera, at));
        changed.iter().min_by(|(a, _), (b, _)| off(a).total_cmp(&off(b))).unwrap().1
    };
    // Beside the plant, before it and behind it.
    for corner in [low, high, low.with_y(high.y)] {
        change(corner, Kind::Free);
        change(corner, Kind::Light { exposure: 0.3 });
    }
    let flower = model.parts.iter().find(|part| part.name.starts_with("petal")).unwrap();
    let middle = flower.mesh.points.iter().sum::<Vec3>() / flower.mesh.points.len() as f32;
    let before = change(middle.with_z(high.z + radius), Kind::Free);
    let behind = change(middle.with_z(low.z - radius), Kind::Free);
    assert!(behind > 5 && u32::from(before) > 2 * u32::from(behind), "{before} before, {behind} behind");
    viewport.set_overlay(&renderer, &[]);
    assert_eq!(plain, shot(&renderer, &mut viewport, &camera, &look), "and they go without a trace");
}

/// A built drawing with what its growth looks like from inside.
fn grown(sketch: &Sketch, set: &str, wanted: Wanted) -> Built {
    let species = species_of(sketch, Path::new("")).unwrap();
    let params = params_of(sketch, &species, &[set.to_owned()]).unwrap();
    let mut cache = Cache::default();
    let mut built = build_with(&mut cache, sketch, &species, &params, &|| false).unwrap();
    assert!(built.overlay.is_empty(), "nobody asked yet");
    cache.look_inside(sketch.into(), &mut built, wanted);
    built
}

#[test]
fn growth_is_seen_from_inside_over_the_plant() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sketches");
    let (topiary, _) = penstemon::sketch::read(&folder.join("topiary.penstemon")).unwrap();
    let points = (0..=20).map(|k| StrokePoint::at(Vec2::new(500.0 + k as f32, 900.0 - 10.0 * k as f32)));
    let trunk = Arc::new(Stroke { id: 1, tool: Tool::Branch, points: points.collect(), brush: None });
    let oak = Sketch { species: Some("oak".into()), strokes: vec![trunk], ..Sketch::empty() };
    let (none, markers) = (Wanted::default(), Wanted { markers: true, ..Wanted::default() });
    let (buds, light) = (Wanted { buds: true, ..none }, Wanted { light: true, ..none });
    let cases = [
        ("overlay_markers", &topiary, "growth.years=5", markers),
        ("overlay_crown_buds", &topiary, "growth.years=5", buds),
        ("overlay_buds", &oak, "growth.years=12", buds),
        ("overlay_light", &oak, "growth.years=12", light),
    ];
    for (name, sketch, set, wanted) in cases {
        let built = grown(sketch, set, wanted);
        assert!(built.overlay.len() > 100, "{name}: {} spots", built.overlay.len());
        let (renderer, mut viewport) = opened(&built.model);
        let camera = camera(&built.model, &View { projection: Projection::Orthographic, ..View::default() });
        let look = Look::default();
        let plain = shot(&renderer, &mut viewport, &camera, &look);
        viewport.set_overlay(&renderer, &drawn(&built.overlay));
        let shown = shot(&renderer, &mut viewport, &camera, &look);
        keep(name, &shown);
        let changed = changes(&plain, &shown);
        let share = changed.len() as f32 / (SIZE.0 * SIZE.1) as f32;
        assert!(share > 0.02, "{name}: {share} of the picture");
        // Nowhere but where the spots are.
        let reach = |spot: &Spot| match spot.kind {
            Kind::Active { way } | Kind::Dormant { way } => spot.radius + way.length(),
            _ => spot.radius,
        };
        let near = |pixel: Vec2| {
            built.overlay.iter().any(|spot| {
                let (at, out) = (pixel_of(&camera, spot.at), spot.at + Vec3::X * reach(spot));
                pixel.distance(at) <= pixel_of(&camera, out).distance(at) + 3.0
            })
        };
        assert!(changed.iter().step_by(101).all(|(pixel, _)| near(*pixel)), "{name}");
        if name == "overlay_markers" {
            // The crown's markers lie within its outline, which the full plant fills.
            let full = build(sketch, &species_of(sketch, &folder).unwrap(), &params(sketch)).model;
            let (low, high) = full.bounds().unwrap();
            let room = 0.05 * (high - low).length();
            assert!(
                built
                    .overlay
                    .iter()
                    .all(|spot| { spot.at.cmpge(low - room).all() && spot.at.cmple(high + room).all() })
            );
        }
    }
}

fn params(sketch: &Sketch) -> penstemon::pipeline::Params {
    params_of(sketch, &species_of(sketch, Path::new("")).unwrap(), &[]).unwrap()
}
