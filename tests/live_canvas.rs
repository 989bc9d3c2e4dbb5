//! The canvas of the window: strokes as the pen leaves them, smooth at any zoom, on paper and over a picture to trace.
//!
//! Pictures to look at are left in `target/tmp/live_canvas`.

#![allow(clippy::unwrap_used, reason = "a test's helper may fail the test")]

use glam::{Affine2, Vec2};
use penstemon::picture::decode::{Rgba, decode};
use penstemon::render::{CanvasLayer, CanvasView, Renderer};
use penstemon::sketch::{Sketch, StrokePoint};
use std::path::Path;

const SIZE: (u32, u32) = (480, 360);
const PAPER: [u8; 3] = [246, 242, 232];
const INK: [u8; 4] = [30, 30, 40, 255];

/// What a window shows after painting this layer, four bytes per pixel.
fn shown(renderer: &Renderer, layer: &mut CanvasLayer, view: &CanvasView) -> Rgba {
    let (width, height) = view.framebuffer;
    layer.prepare(renderer.gpu(), view).unwrap();
    let (device, queue) = (renderer.device(), renderer.queue());
    let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let into = texture.create_view(&Default::default());
    let mut encoder = device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: None,
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &into,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                store: wgpu::StoreOp::Store,
            },
        })],
        ..Default::default()
    });
    layer.paint(&mut pass);
    drop(pass);
    let bytes_per_row = (4 * width).next_multiple_of(256);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(bytes_per_row * height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let layout =
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(bytes_per_row), rows_per_image: None };
    let to = wgpu::TexelCopyBufferInfo { buffer: &buffer, layout };
    encoder.copy_texture_to_buffer(texture.as_image_copy(), to, size);
    queue.submit([encoder.finish()]);
    buffer.map_async(wgpu::MapMode::Read, .., |_| ());
    device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
    renderer.check().unwrap();
    let mapped = buffer.get_mapped_range(..).unwrap();
    let pixels = mapped.chunks(bytes_per_row as usize).flat_map(|row| &row[..4 * width as usize]).copied();
    Rgba { width, height, pixels: pixels.collect() }
}

fn keep(name: &str, picture: &Rgba) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("live_canvas");
    std::fs::create_dir_all(&folder).unwrap();
    let file = std::fs::File::create(folder.join(format!("{name}.png"))).unwrap();
    let mut encoder = png::Encoder::new(file, picture.width, picture.height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header().unwrap().write_image_data(&picture.pixels).unwrap();
}

fn pixel(picture: &Rgba, x: u32, y: u32) -> [u8; 4] {
    picture.pixels.as_chunks().0[(y * picture.width + x) as usize]
}

/// The canvas seen `zoom` times enlarged with `at` in the middle.
fn view(zoom: f32, at: Vec2) -> CanvasView {
    let middle = Vec2::new(SIZE.0 as f32, SIZE.1 as f32) / 2.0;
    CanvasView {
        pixel_from_canvas: Affine2::from_translation(middle)
            * Affine2::from_scale(Vec2::splat(zoom))
            * Affine2::from_translation(-at),
        framebuffer: SIZE,
        paper: PAPER,
        surround: [200, 196, 188],
        sheet: None,
        line_scale: 1.0,
    }
}

fn open() -> (Renderer, CanvasLayer) {
    let renderer = Renderer::new().unwrap();
    let layer = CanvasLayer::new(renderer.gpu(), wgpu::TextureFormat::Rgba8Unorm).unwrap();
    (renderer, layer)
}

fn samples(points: impl IntoIterator<Item = (Vec2, f32)>) -> Vec<StrokePoint> {
    let sample = |(position, pressure)| StrokePoint { pressure, ..StrokePoint::at(position) };
    points.into_iter().map(sample).collect()
}

/// A loop drawn with changing pressure, sampled sparsely.
fn curl(count: usize) -> Vec<StrokePoint> {
    samples((0..count).map(|i| {
        let t = i as f32 / (count - 1) as f32;
        let at = Vec2::from_angle(9.0 * t) * (150.0 - 110.0 * t);
        (at, 0.2 + 0.8 * (3.0 * t).sin().abs())
    }))
}

fn sketch(name: &str) -> Sketch {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/sketches/{name}.penstemon"));
    penstemon::sketch::read(&path).unwrap().0
}

/// The view that shows a whole drawing.
fn fitting(sketch: &Sketch) -> CanvasView {
    let (lo, hi) = sketch.bounds().unwrap();
    let scale = (Vec2::new(SIZE.0 as f32, SIZE.1 as f32) / (hi - lo)).min_element() * 0.9;
    view(scale, (lo + hi) / 2.0)
}

#[test]
fn a_stroke_grown_sample_by_sample_is_the_same_picture() {
    let (renderer, mut at_once) = open();
    let curl = curl(60);
    at_once.ink.set(1, &curl, INK, 12.0);
    let view = view(1.0, Vec2::ZERO);
    let expected = shown(&renderer, &mut at_once, &view);
    let mut grown = CanvasLayer::new(renderer.gpu(), wgpu::TextureFormat::Rgba8Unorm).unwrap();
    grown.ink.set(1, &curl[..1], INK, 12.0);
    for sample in &curl[1..] {
        assert!(grown.ink.grow(1, std::slice::from_ref(sample), &[]));
        grown.prepare(renderer.gpu(), &view).unwrap();
    }
    assert!(expected == shown(&renderer, &mut grown, &view));
}

#[test]
fn the_newest_sample_is_there_at_once() {
    let (renderer, mut layer) = open();
    let view = view(1.0, Vec2::ZERO);
    layer.ink.set(1, &samples([(Vec2::new(-100.0, 0.0), 1.0)]), INK, 8.0);
    for x in [-60.0, -10.0, 45.0, 130.0] {
        layer.ink.grow(1, &samples([(Vec2::new(x, 0.0), 1.0)]), &[]);
        let now = shown(&renderer, &mut layer, &view);
        assert_eq!(pixel(&now, (240.0 + x) as u32, 180), INK, "at {x}");
        assert_eq!(pixel(&now, (240.0 + x + 8.0) as u32, 180)[..3], PAPER, "beyond {x}");
    }
}

#[test]
fn only_new_samples_are_sent() {
    let (renderer, mut layer) = open();
    let sketch = sketch("tree_round");
    for stroke in &sketch.strokes {
        layer.ink.set(stroke.id, &stroke.points, INK, 3.0);
    }
    let view = fitting(&sketch);
    let all = layer.prepare(renderer.gpu(), &view).unwrap();
    let last = sketch.strokes[sketch.strokes.len() - 1].id;
    layer.ink.grow(last, &samples([(Vec2::new(10.0, 10.0), 0.5)]), &[]);
    let one = layer.prepare(renderer.gpu(), &view).unwrap();
    assert!(one > 0 && one < 1200, "{one} of {all} bytes");
    assert_eq!(layer.prepare(renderer.gpu(), &view).unwrap(), 0);
}

#[test]
fn a_line_is_as_wide_as_asked_and_evenly_dark() {
    let (renderer, mut layer) = open();
    let line = |step: f32| {
        let count = (300.0 / step) as usize;
        let direction = Vec2::from_angle(0.3);
        samples((0..=count).map(|i| (direction * (i as f32 * step - 150.0), 1.0)))
    };
    let mut inks = Vec::new();
    for step in [100.0, 5.0, 0.7, 0.1] {
        layer.ink.set(1, &line(step), INK, 6.0);
        let picture = shown(&renderer, &mut layer, &view(1.0, Vec2::ZERO));
        keep(&format!("line_{step}"), &picture);
        let dark = |p: [u8; 4]| f32::from(PAPER[0] - p[0]) / f32::from(PAPER[0] - INK[0]);
        let ink: f32 = picture.pixels.as_chunks().0.iter().map(|p| dark(*p)).sum();
        inks.push(ink / (300.0 * 6.0 + std::f32::consts::PI * 9.0));
    }
    for ink in &inks {
        assert!((ink - 1.0).abs() < 0.02, "{inks:?}: a dense stroke is no bolder than a sparse one");
    }
}

#[test]
fn zoomed_in_a_sparse_curve_is_smooth() {
    let (renderer, mut layer) = open();
    let circle = samples((0..=16).map(|i| (Vec2::from_angle(i as f32 * 0.39) * 20.0, 0.6)));
    layer.ink.set(1, &circle, INK, 1.5);
    let picture = shown(&renderer, &mut layer, &view(24.0, Vec2::new(0.0, -14.0)));
    keep("zoomed", &picture);
    // Every dark pixel lies near the circle that was sampled.
    let half_width = 0.75 * (0.25 + 0.75 * 0.6) * 24.0;
    let middle = Vec2::new(240.0, 180.0 + 14.0 * 24.0);
    let mut dark = 0;
    for y in 0..SIZE.1 {
        for x in 0..SIZE.0 {
            if pixel(&picture, x, y)[0] < 100 {
                dark += 1;
                let away = (Vec2::new(x as f32 + 0.5, y as f32 + 0.5).distance(middle) - 480.0).abs();
                assert!(away < half_width + 5.0, "{x}, {y} is {away} pixels away");
            }
        }
    }
    assert!(dark > 2000, "{dark}");
}

#[test]
fn thinner_lines_show_what_is_traced() {
    let (renderer, mut layer) = open();
    layer.ink.set(1, &samples([(Vec2::new(-20.0, 0.0), 1.0), (Vec2::new(20.0, 0.0), 1.0)]), INK, 4.0);
    let near = view(16.0, Vec2::ZERO);
    let tall = |picture: &Rgba| (0..SIZE.1).filter(|y| pixel(picture, 240, *y)[0] < 128).count();
    assert_eq!(tall(&shown(&renderer, &mut layer, &near)), 64);
    let thin = CanvasView { line_scale: 6.0 / 64.0, ..near };
    assert_eq!(tall(&shown(&renderer, &mut layer, &thin)), 6);
}

#[test]
fn the_dark_theme_shows_coloured_strokes_in_their_order() {
    let (renderer, mut layer) = open();
    let sketch = sketch("daisy");
    let colours = [[244, 143, 177, 255], [129, 199, 132, 255], [255, 183, 77, 255], [100, 181, 246, 255]];
    for (stroke, colour) in sketch.strokes.iter().zip(colours.iter().cycle()) {
        layer.ink.set(stroke.id, &stroke.points, *colour, 5.0);
    }
    let dark = CanvasView { paper: [32, 33, 36], surround: [18, 18, 20], ..fitting(&sketch) };
    keep("dark", &shown(&renderer, &mut layer, &dark));

    layer.ink.clear();
    let bar = |from: Vec2, to: Vec2| samples([(from, 1.0), (to, 1.0)]);
    layer.ink.set(1, &bar(Vec2::new(-90.0, 0.0), Vec2::new(90.0, 0.0)), colours[0], 20.0);
    layer.ink.set(2, &bar(Vec2::new(0.0, -90.0), Vec2::new(0.0, 90.0)), colours[1], 20.0);
    let view = CanvasView { paper: [32, 33, 36], ..view(1.0, Vec2::ZERO) };
    assert_eq!(pixel(&shown(&renderer, &mut layer, &view), 240, 180), colours[1]);
    layer.ink.set_order(&[2, 1]);
    assert_eq!(pixel(&shown(&renderer, &mut layer, &view), 240, 180), colours[0]);
    layer.ink.recolour(1, colours[3]);
    assert_eq!(pixel(&shown(&renderer, &mut layer, &view), 240, 180), colours[3]);
    layer.ink.remove(1);
    let crossed = shown(&renderer, &mut layer, &view);
    assert_eq!((pixel(&crossed, 240, 180), pixel(&crossed, 180, 180)), (colours[1], [32, 33, 36, 255]));
}

#[test]
fn a_reference_picture_lies_under_the_strokes() {
    let (renderer, mut layer) = open();
    let leaf = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/textures/leaf_maple.png");
    let picture = decode(&std::fs::read(leaf).unwrap()).unwrap();
    layer.set_reference(renderer.gpu(), Some(&picture)).unwrap();
    let place = Affine2::from_scale_angle_translation(Vec2::splat(300.0), 0.2, Vec2::new(-120.0, -170.0));
    layer.place_reference(place, 0.6);
    layer.ink.set(1, &curl(80), INK, 6.0);
    let view = CanvasView { sheet: Some(Vec2::new(190.0, 140.0)), ..view(1.0, Vec2::ZERO) };
    keep("reference", &shown(&renderer, &mut layer, &view));

    let red = Rgba { width: 1, height: 1, pixels: vec![255, 0, 0, 255] };
    layer.set_reference(renderer.gpu(), Some(&red)).unwrap();
    layer.place_reference(Affine2::from_scale(Vec2::splat(50.0)), 0.5);
    layer.ink.set(1, &samples([(Vec2::splat(25.0), 1.0)]), INK, 10.0);
    let traced = shown(&renderer, &mut layer, &CanvasView { sheet: None, ..view });
    keep("traced", &traced);
    assert_eq!(pixel(&traced, 265, 205), INK);
    let mixed = pixel(&traced, 250, 190);
    assert!(
        mixed[0].abs_diff(251) <= 2 && mixed[1].abs_diff(121) <= 2 && mixed[2].abs_diff(116) <= 2,
        "{mixed:?}"
    );
    assert_eq!(pixel(&traced, 235, 175)[..3], PAPER);
    layer.set_reference(renderer.gpu(), None).unwrap();
    assert_eq!(pixel(&shown(&renderer, &mut layer, &view), 250, 190)[..3], PAPER);
    let broken = Rgba { width: 9, height: 9, pixels: vec![0; 5] };
    assert!(layer.set_reference(renderer.gpu(), Some(&broken)).is_err());
}

#[test]
fn the_canvas_turns() {
    let (renderer, mut layer) = open();
    layer.ink.set(1, &samples([(Vec2::ZERO, 1.0), (Vec2::new(100.0, 0.0), 1.0)]), INK, 10.0);
    let mut turned = view(1.0, Vec2::ZERO);
    turned.pixel_from_canvas *= Affine2::from_angle(std::f32::consts::FRAC_PI_2);
    let picture = shown(&renderer, &mut layer, &turned);
    assert_eq!(pixel(&picture, 240, 260), INK, "a quarter turn takes right to down");
    assert_eq!(pixel(&picture, 320, 180)[..3], PAPER);
}

#[test]
fn ten_thousand_strokes_are_one_buffer() {
    let (renderer, mut layer) = open();
    for id in 0..10_000_u64 {
        let at = Vec2::new((id % 100) as f32 * 4.0 - 200.0, (id / 100) as f32 * 3.0 - 150.0);
        let stroke = samples((0..12).map(|i| (at + Vec2::new(i as f32 * 0.25, (i as f32).sin()), 0.7)));
        layer.ink.set(id, &stroke, [30, (id % 200) as u8, 90, 255], 0.8);
    }
    let picture = shown(&renderer, &mut layer, &view(1.0, Vec2::ZERO));
    keep("many", &picture);
    let inked = picture.pixels.as_chunks::<4>().0.iter().filter(|p| p[..3] != PAPER).count();
    assert!(inked > 40_000, "{inked}");
}
