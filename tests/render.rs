//! Pictures of small hand-made models: what is seen where, and what is refused.

#![allow(clippy::unwrap_used, reason = "a test's helper may fail the test")]

use glam::{Vec2, Vec3, vec3};
use penstemon::model::{Mesh, Model, Part, PartKind, Vertex};
use penstemon::plant::{Material, OrganKind, Texture};
use penstemon::render::{
    Background, Direction, Gpu, Look, OrbitCamera, PictureOptions, Projection, RenderError, RenderedImage,
    Renderer, View, Viewport, walk,
};
use penstemon::sketch::{Canvas, Sketch, Stroke, StrokePoint, Tool};
use std::borrow::Cow;
use std::error::Error;
use std::sync::Arc;

const GREEN: [f32; 3] = [0.1, 0.4, 0.05];
const BROWN: [f32; 3] = [0.25, 0.12, 0.05];
const SMALL: PictureOptions = PictureOptions { width: 160, height: 120, background: Background::Paper };
const LEVEL: View = View { direction: Direction::Front, projection: Projection::Orthographic, turn_deg: 0.0 };

type Bytes = Result<Cow<'static, [u8]>, Box<dyn Error + Send + Sync>>;

fn no_textures(_: &Texture) -> Bytes {
    Err("there is none".into())
}

/// A parallelogram seen from the side on which `right × up` points.
fn quad(corner: Vec3, right: Vec3, up: Vec3) -> Mesh {
    let normal = right.cross(up).normalize();
    let uvs = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
    Mesh {
        points: uvs.iter().map(|uv| corner + right * uv.x + up * uv.y).collect(),
        vertices: (0..).zip(uvs).map(|(point, uv)| Vertex { point, normal, uv }).collect(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    }
}

/// An upright tube around the y axis, open at its ends.
fn tube(radius: f32, height: f32) -> Mesh {
    let mut mesh = Mesh::default();
    for i in 0..12_u32 {
        let (sin, cos) = (i as f32 * std::f32::consts::TAU / 12.0).sin_cos();
        let normal = vec3(sin, 0.0, cos);
        for y in [0.0, height] {
            let point = mesh.points.len() as u32;
            mesh.points.push(vec3(sin * radius, y, cos * radius));
            mesh.vertices.push(Vertex { point, normal, uv: Vec2::ZERO });
        }
        let (a, b) = (2 * i, 2 * ((i + 1) % 12));
        mesh.triangles.extend([[a, b, a + 1], [b, b + 1, a + 1]]);
    }
    mesh
}

fn model(parts: impl IntoIterator<Item = (Mesh, Material)>) -> Model {
    let mut model = Model::default();
    for (i, (mesh, material)) in parts.into_iter().enumerate() {
        let kind = PartKind::Organ(OrganKind::Leaf);
        let name = format!("part_{i}").into();
        model.parts.push(Part {
            name,
            kind,
            parent: None,
            specimen: 0,
            pivot: Vec3::ZERO,
            material: i,
            more_materials: Vec::new(),
            mesh: mesh.into(),
            copies: None,
        });
        model.materials.push(material);
    }
    model
}

/// A brown stem 1 m high with a green blade above it, 0.6 m wide, facing the front.
fn seedling() -> Model {
    let blade = quad(vec3(-0.3, 1.0, 0.0), vec3(0.6, 0.0, 0.0), vec3(0.0, 0.5, 0.0));
    model([
        (tube(0.08, 1.0), Material::plain("bark", BROWN)),
        (blade, Material { double_sided: true, ..Material::plain("leaf", GREEN) }),
    ])
}

fn picture(model: &Model, view: &View, options: &PictureOptions) -> RenderedImage {
    Renderer::new().unwrap().picture(model, &no_textures, view, options).unwrap()
}

fn brightness([r, g, b, _]: [u8; 4]) -> f32 {
    (0.2126 * f32::from(r) + 0.7152 * f32::from(g) + 0.0722 * f32::from(b)) / 255.0
}

fn all_pixels(picture: &RenderedImage) -> impl Iterator<Item = (u32, u32, [u8; 4])> {
    let width = picture.width();
    (0..).zip(picture.pixels().as_chunks().0).map(move |(i, &p)| (i % width, i / width, p))
}

#[test]
fn parts_are_seen_where_they_are_in_their_colours() {
    let picture = picture(&seedling(), &LEVEL, &SMALL);
    assert_eq!((picture.width(), picture.height()), (160, 120));
    let [r, g, b, a] = picture.pixel(80, 20).unwrap();
    assert!(g > 100 && u32::from(g) * 2 > u32::from(r) * 3 && g > b && a == 255, "blade {r} {g} {b} {a}");
    let [r, g, b, _] = picture.pixel(80, 90).unwrap();
    assert!(r > g && g > b && r > 60, "stem {r} {g} {b}");
    let [r, g, b, a] = picture.pixel(20, 60).unwrap();
    assert!(r > 190 && r > g && g > b && a == 255, "paper {r} {g} {b} {a}");
}

#[test]
fn a_plant_throws_its_shadow_away_from_the_sun() {
    let plate = quad(vec3(-0.3, 0.6, 0.3), vec3(0.6, 0.0, 0.0), vec3(0.0, 0.0, -0.6));
    let model = model([
        (tube(0.02, 0.6), Material::plain("bark", GREEN)),
        (plate, Material { double_sided: true, ..Material::plain("leaf", GREEN) }),
    ]);
    let picture = picture(&model, &View { direction: Direction::ThreeQuarter, ..View::default() }, &SMALL);
    let paper = brightness(picture.pixel(5, 115).unwrap());
    let grey = |[r, g, b, _]: [u8; 4]| r.abs_diff(g) < 25 && g.abs_diff(b) < 35;
    let shaded: Vec<u32> = all_pixels(&picture)
        .filter(|&(_, _, p)| grey(p) && brightness(p) < 0.82 * paper)
        .map(|(x, _, _)| x)
        .collect();
    assert!(shaded.len() > 150, "{} pixels in shadow", shaded.len());
    let right = shaded.iter().filter(|&&x| x > 80).count();
    assert!(right * 3 > shaded.len() * 2, "{right} of {} right of the plant", shaded.len());
}

#[test]
fn a_transparent_picture_holds_nothing_but_the_plant() {
    let options = PictureOptions { background: Background::Transparent, ..SMALL };
    let picture = picture(&seedling(), &View::default(), &options);
    for (x, y) in [(0, 0), (159, 0), (0, 119), (159, 119), (120, 110)] {
        assert_eq!(picture.pixel(x, y), Some([0; 4]), "at {x}, {y}");
    }
    assert_eq!(picture.pixel(80, 20).unwrap()[3], 255);
    let edge: Vec<_> = all_pixels(&picture).filter(|(_, _, p)| (1..255).contains(&p[3])).collect();
    assert!(!edge.is_empty(), "edges are smooth");
    for (x, y, [r, g, b, a]) in edge {
        assert!(r.max(g) > 60 && b < 120, "no dark or light fringe at {x}, {y}: {r} {g} {b} {a}");
    }
}

#[test]
fn outdoors_the_sky_is_over_a_lawn_and_the_plant_throws_its_shadow() {
    let options = PictureOptions { background: Background::Outdoors, ..SMALL };
    let is_sky = |[r, _, b, a]: [u8; 4]| b > r && a == 255;
    let is_lawn = |[r, g, b, a]: [u8; 4]| g > r && g > b && a == 255;
    for projection in [Projection::Perspective, Projection::Orthographic] {
        let view = View { projection, ..View::default() };
        let picture = picture(&seedling(), &view, &options);
        for x in [2, 157] {
            assert!(is_sky(picture.pixel(x, 2).unwrap()), "{projection:?} {:?}", picture.pixel(x, 2));
            assert!(is_lawn(picture.pixel(x, 117).unwrap()), "{projection:?} {:?}", picture.pixel(x, 117));
        }
    }
    let view = View { direction: Direction::ThreeQuarter, ..View::default() };
    let lit = picture(&seedling(), &view, &options);
    let lawn: Vec<u32> = all_pixels(&lit)
        .filter(|(_, _, p)| is_lawn(*p))
        .map(|(_, _, p)| (100.0 * brightness(p)) as u32)
        .collect();
    let (dark, light) = (lawn.iter().min().unwrap(), lawn.iter().max().unwrap());
    assert!(10 * dark < 7 * light, "{dark} {light}");
}

#[test]
fn a_walk_sees_what_stands_before_it() {
    let mut renderer = Renderer::new().unwrap();
    let mut uploaded = renderer.upload(&seedling(), &no_textures).unwrap();
    let toward = walk::along(&[Vec2::new(0.0, 8.0), Vec2::new(0.0, 4.0)], 2, 0.8, |_| 0.0);
    let away = walk::along(&[Vec2::new(0.0, 4.0), Vec2::new(0.0, 8.0)], 1, 0.8, |_| 0.0);
    let cameras: Vec<_> = toward.into_iter().chain(away).collect();
    let options = PictureOptions { background: Background::Transparent, ..SMALL };
    let pictures: Result<Vec<_>, _> = renderer.pictures_by(&mut uploaded, &cameras, &options).collect();
    let seen = pictures
        .unwrap()
        .iter()
        .map(|p| all_pixels(p).filter(|(_, _, p)| p[3] > 0).count())
        .collect::<Vec<_>>();
    assert!(seen[0] > 20 && seen[1] > 3 * seen[0], "it becomes larger: {seen:?}");
    assert_eq!(seen[2], 0, "behind the eye");
}

#[test]
fn the_same_picture_is_the_same_bytes() {
    let first = picture(&seedling(), &View::default(), &SMALL);
    let mut renderer = Renderer::new().unwrap();
    for _ in 0..2 {
        let again = renderer.picture(&seedling(), &no_textures, &View::default(), &SMALL).unwrap();
        assert_eq!(first.to_png().unwrap(), again.to_png().unwrap());
    }
}

#[test]
fn a_turntable_shows_all_sides_and_comes_back() {
    let mut renderer = Renderer::new().unwrap();
    let mut uploaded = renderer.upload(&seedling(), &no_textures).unwrap();
    let mut views: Vec<View> = View::default().turntable(4).collect();
    views.push(View { turn_deg: 360.0, ..View::default() });
    let frames: Vec<RenderedImage> =
        renderer.pictures(&mut uploaded, &views, &SMALL).map(Result::unwrap).collect();
    let green =
        |p: &RenderedImage| all_pixels(p).filter(|(_, _, [r, g, _, _])| *g > r.saturating_add(30)).count();
    assert!(green(&frames[0]) > 10 * green(&frames[1]), "the blade is thin from the side");
    assert!(green(&frames[2]) * 10 > green(&frames[0]) * 9, "and as large from behind");
    let differences = frames[0].pixels().iter().zip(frames[4].pixels()).filter(|(a, b)| a.abs_diff(**b) > 8);
    assert!(differences.count() < 100);
}

#[test]
fn one_renderer_makes_pictures_of_any_size() {
    let mut renderer = Renderer::new().unwrap();
    for (width, height) in [(1, 1), (33, 7), (160, 120)] {
        let options = PictureOptions { width, height, background: Background::Paper };
        let picture = renderer.picture(&seedling(), &no_textures, &View::default(), &options).unwrap();
        assert_eq!((picture.width(), picture.height()), (width, height));
    }
}

#[test]
fn impossible_sizes_are_refused() {
    let mut renderer = Renderer::new().unwrap();
    for (width, height) in [(0, 10), (10, 0), (u32::MAX, 1), (1, 1_000_000), (16_000, 16_000)] {
        let options = PictureOptions { width, height, background: Background::Paper };
        let refused = renderer.picture(&seedling(), &no_textures, &View::default(), &options);
        assert!(matches!(refused, Err(RenderError::Size { .. })), "{width}×{height}");
    }
    assert!(
        renderer.picture(&seedling(), &no_textures, &View::default(), &SMALL).is_ok(),
        "and it still works"
    );
}

#[test]
fn a_machine_without_a_driver_is_shown_what_to_install() {
    let refused = Renderer::with_backends(wgpu::Backends::empty()).map(drop).unwrap_err();
    assert!(matches!(refused, RenderError::NoAdapter { .. }));
    assert!(refused.to_string().contains("mesa-vulkan-drivers"), "{refused}");
}

#[test]
fn contradictory_models_are_refused_by_name() {
    let mut renderer = Renderer::new().unwrap();
    let mut refused = |change: &dyn Fn(&mut Model)| {
        let mut model = seedling();
        change(&mut model);
        renderer.picture(&model, &no_textures, &LEVEL, &SMALL).unwrap_err()
    };
    let cases: [&dyn Fn(&mut Model); 4] = [
        &|m| m.parts[1].material = 7,
        &|m| Arc::make_mut(&mut m.parts[1].mesh).vertices[2].point = 99,
        &|m| Arc::make_mut(&mut m.parts[1].mesh).triangles[0] = [0, 1, 4],
        &|m| Arc::make_mut(&mut m.parts[1].mesh).points[0].x = f32::NAN,
    ];
    for change in cases {
        let error = refused(change);
        assert!(error.to_string().contains("part_1"), "{error}");
    }
    assert!(matches!(refused(&|m| m.parts.clear()), RenderError::Empty { .. }));
}

/// A PNG of one pixel per colour, one above the other.
fn png_column(colours: &[[u8; 4]]) -> Vec<u8> {
    png_of(1, colours)
}

/// A PNG of one pixel per colour, so many in a row.
fn png_of(width: u32, colours: &[[u8; 4]]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, colours.len() as u32 / width);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header().unwrap().write_image_data(colours.as_flattened()).unwrap();
    bytes
}

/// A white blade 1 m wide and high with a picture on it.
fn pictured_blade(cut_out: bool) -> Model {
    let texture = Some(Texture::BuiltIn("column".to_owned()));
    let white = Material::plain("petal", [1.0; 3]);
    let blade = quad(Vec3::ZERO, Vec3::X, Vec3::Y);
    model([(blade, Material { texture, cut_out, double_sided: true, ..white })])
}

fn with_texture(model: &Model, colours: &[[u8; 4]], options: &PictureOptions) -> RenderedImage {
    let source = |_: &Texture| -> Bytes { Ok(png_column(colours).into()) };
    Renderer::new().unwrap().picture(model, &source, &LEVEL, options).unwrap()
}

#[test]
fn a_texture_stands_upright() {
    let picture = with_texture(&pictured_blade(false), &[[200, 20, 20, 255], [20, 20, 200, 255]], &SMALL);
    let [r, _, b, _] = picture.pixel(80, 15).unwrap();
    assert!(r > 2 * b, "its first row is at the top");
    let [r, _, b, _] = picture.pixel(80, 105).unwrap();
    assert!(b > 2 * r, "its last row is at the foot");
}

/// The sun stands high: of a dark groove across a wall the lower side is lit, the upper one is not.
#[test]
fn a_relief_is_lit_like_a_surface_of_that_shape() {
    let groove: Vec<[u8; 4]> =
        (0..16).map(|i| if i / 2 == 4 { [60, 60, 60, 255] } else { [180, 180, 180, 255] }).collect();
    let upright = quad(Vec3::ZERO, Vec3::X, Vec3::Y);
    // Its picture lies on its side.
    let turned = quad(Vec3::Y, Vec3::NEG_Y, Vec3::X);
    for (wall, width) in [(upright, 1), (turned, 16)] {
        let sides = |relief: f32| {
            let texture = Some(Texture::BuiltIn("groove".to_owned()));
            let stone = Material { texture, relief, ..Material::plain("stone", [1.0; 3]) };
            let source = |_: &Texture| -> Bytes { Ok(png_of(width, &groove).into()) };
            let picture = Renderer::new()
                .unwrap()
                .picture(&model([(wall.clone(), stone)]), &source, &LEVEL, &SMALL)
                .unwrap();
            // The wall is 108 pixels high, its groove between the 61st and the 74th of 120 from above.
            [58, 75].map(|y| brightness(picture.pixel(80, y).unwrap()))
        };
        let ([above, below], [flat_above, flat_below]) = (sides(0.1), sides(0.0));
        assert!(above < 0.95 * flat_above, "{above} {flat_above}");
        assert!(below > 1.05 * flat_below, "{below} {flat_below}");
    }
}

#[test]
fn alpha_cuts_out_only_where_asked() {
    let rows = [[200, 20, 20, 255], [200, 20, 20, 0]];
    let options = PictureOptions { background: Background::Transparent, ..SMALL };
    let cut = with_texture(&pictured_blade(true), &rows, &options);
    assert_eq!(cut.pixel(80, 15).unwrap()[3], 255);
    assert_eq!(cut.pixel(80, 105), Some([0; 4]));
    let whole = with_texture(&pictured_blade(false), &rows, &options);
    assert_eq!(whole.pixel(80, 105).unwrap()[3], 255);
}

#[test]
fn a_missing_or_broken_texture_is_named() {
    let mut renderer = Renderer::new().unwrap();
    let broken = |_: &Texture| -> Bytes { Ok(b"no picture".as_slice().into()) };
    for source in [&no_textures as &dyn Fn(&Texture) -> Bytes, &broken] {
        let refused = renderer.picture(&pictured_blade(false), source, &LEVEL, &SMALL).unwrap_err();
        assert!(matches!(refused, RenderError::Texture { .. }));
        assert!(refused.to_string().contains("`column`"), "{refused}");
    }
}

#[test]
fn light_shines_through_leaves() {
    let from_below = |translucency| {
        let blade = quad(vec3(-0.5, 0.0, -0.2), Vec3::X, vec3(0.0, 0.6, 0.4));
        let leaf = Material { translucency, double_sided: true, ..Material::plain("leaf", GREEN) };
        brightness(picture(&model([(blade, leaf)]), &LEVEL, &SMALL).pixel(80, 60).unwrap())
    };
    let (opaque, translucent) = (from_below(0.0), from_below(0.6));
    assert!(translucent > 1.15 * opaque, "{opaque} {translucent}");
}

#[test]
fn only_double_sided_surfaces_have_a_back() {
    let seen_from_behind = |double_sided| {
        let blade = quad(Vec3::ZERO, Vec3::X, Vec3::Y);
        let leaf = Material { double_sided, ..Material::plain("leaf", GREEN) };
        let options = PictureOptions { background: Background::Transparent, ..SMALL };
        picture(&model([(blade, leaf)]), &View { turn_deg: 180.0, ..LEVEL }, &options).pixel(80, 60).unwrap()
            [3]
    };
    assert_eq!((seen_from_behind(true), seen_from_behind(false)), (255, 0));
}

/// A renderer on a device whose buffers hold one mebibyte at most.
fn with_small_buffers() -> Renderer {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
    let adapter = pollster::block_on(instance.request_adapter(&Default::default())).unwrap();
    let limits = wgpu::Limits::downlevel_defaults().using_resolution(adapter.limits());
    let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
        required_limits: wgpu::Limits { max_buffer_size: 1 << 20, ..limits },
        ..Default::default()
    }))
    .unwrap();
    Renderer::on(Gpu::from_parts(device, queue, &adapter.get_info())).unwrap()
}

/// Two parts of one material, one of another, each with more corners than such a buffer holds.
fn three_thickets() -> Model {
    let thicket = |z: f32| {
        let mut all = Mesh::default();
        for i in 0..12_000u32 {
            let (x, y) = ((i % 120) as f32 * 0.01, (i / 120) as f32 * 0.01);
            all.append(&quad(Vec3::new(x, y, z), Vec3::X * 0.008, Vec3::Y * 0.008));
        }
        all
    };
    let (green, red) = (Material::plain("green", [0.1, 0.5, 0.1]), Material::plain("red", [0.6, 0.1, 0.1]));
    let mut model = model([(thicket(0.0), green), (thicket(0.1), red)]);
    let again = Part { name: "again".into(), mesh: thicket(-0.1).into(), ..model.parts[0].clone() };
    model.parts.push(again);
    model
}

#[test]
fn a_model_larger_than_a_buffer_is_drawn() {
    let model = three_thickets();
    assert!(model.parts.iter().all(|part| part.mesh.vertices.len() * 32 > 1 << 20));
    let options = PictureOptions { width: 160, height: 120, background: Background::Paper };
    let of =
        |mut renderer: Renderer| renderer.picture(&model, &no_textures, &View::default(), &options).unwrap();
    assert!(of(with_small_buffers()) == of(Renderer::new().unwrap()), "divided buffers make another picture");
}

#[test]
fn a_live_model_larger_than_a_buffer_is_drawn() {
    let model = three_thickets();
    let of = |renderer: Renderer, shown: &[&Model]| {
        let mut view = Viewport::new(&renderer).unwrap();
        view.set_size(160, 120);
        for model in shown {
            view.update(&renderer, *model, &no_textures).unwrap();
            view.draw(&renderer, &OrbitCamera::default(), &Look::default()).unwrap();
        }
        view.snapshot(&renderer).unwrap()
    };
    let mut less = model.clone();
    less.parts.remove(0);
    let plain = of(Renderer::new().unwrap(), &[&model]);
    assert!(of(with_small_buffers(), &[&model]) == plain, "divided buffers make another picture");
    assert!(
        of(with_small_buffers(), &[&model, &less, &model]) == plain,
        "parts that come and go leave something"
    );
}

/// A zigzag from left to right, pressed harder and harder.
fn drawing() -> Sketch {
    let sample = |i: u32| StrokePoint {
        pressure: i as f32 / 20.0,
        ..StrokePoint::at(Vec2::new(50.0 * i as f32, 40.0 * (i % 2) as f32))
    };
    let stroke = Stroke { id: 1, tool: Tool::Auto, points: (0..=20).map(sample).collect(), brush: None };
    let canvas = Canvas { width: 1000.0, height: 600.0 };
    Sketch { canvas, seed: 0, strokes: vec![stroke.into()], ..Sketch::empty() }
}

#[test]
fn a_drawing_is_ink_on_paper_thicker_where_the_pen_pressed() {
    let options = PictureOptions { width: 800, height: 300, background: Background::Paper };
    let picture = Renderer::new().unwrap().drawing(&drawing(), &options).unwrap();
    let ink = |columns: std::ops::Range<u32>| {
        let dark = all_pixels(&picture).filter(|(x, _, p)| columns.contains(x) && brightness(*p) < 0.5);
        dark.count() as f32 / columns.len() as f32
    };
    let (light, heavy) = (ink(100..200), ink(600..700));
    assert!(light > 0.5, "{light}");
    assert!(heavy > 1.5 * light, "{light} {heavy}");
    assert_eq!(ink(0..20), 0.0);
    let darkest = all_pixels(&picture).map(|(_, _, p)| brightness(p)).fold(1.0, f32::min);
    assert!(darkest < 0.25, "{darkest}");
    assert!(brightness(picture.pixel(400, 20).unwrap()) > 0.75, "paper");
}

#[test]
fn an_empty_drawing_is_refused() {
    let empty = Sketch { strokes: Vec::new(), ..drawing() };
    let refused = Renderer::new().unwrap().drawing(&empty, &SMALL);
    assert!(matches!(refused, Err(RenderError::Empty { .. })));
}
