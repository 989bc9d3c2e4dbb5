//! Copies of shapes in the live view: seen as their triangles are, and cheap to send to the graphics card.
//!
//! Pictures to look at are left in `target/tmp/live_view`.

#![allow(clippy::unwrap_used, reason = "a test's helper may fail the test")]

use crate::live_view::{camera, difference, keep, opened, shot, textures};
use glam::Vec3;
use penstemon::model::{Copies, Model};
use penstemon::pipeline::{self, Seed};
use penstemon::render::{Background, Look, Mode, PictureOptions, RenderError, Renderer, View};
use penstemon::species::Species;
use std::sync::Arc;

/// Bytes of one copy's place on the graphics card.
const PLACE: u64 = 48;

fn ash() -> Model {
    let species = Species::built_in("ash").unwrap();
    let params = pipeline::params_of_species(&species, &[]).unwrap();
    let seed = Seed { number: 1, age: Some(8.0), ..Seed::default() };
    pipeline::build(&seed, &species, &params).model
}

fn copies(model: &mut Model) -> &mut Copies {
    let copies = model.parts.iter_mut().find_map(|part| part.copies.as_mut()).unwrap();
    Arc::make_mut(copies)
}

#[test]
fn copies_are_seen_as_their_triangles_are() {
    let model = ash();
    let flat = model.flattened().into_owned();
    assert!(model.parts.iter().any(|part| part.copies.is_some()));
    let (renderer, mut of_copies) = opened(&model);
    let (same, mut of_triangles) = opened(&flat);
    let camera = camera(&model, &View::default());
    for mode in [Mode::Shaded, Mode::PartColours, Mode::Wireframe] {
        let look = Look { mode, ..Look::default() };
        let seen = shot(&renderer, &mut of_copies, &camera, &look);
        let expected = shot(&same, &mut of_triangles, &camera, &look);
        keep(&format!("copies_{mode:?}"), &seen);
        let (mean, far) = difference(&expected, &seen, 24);
        assert!(mean < 0.3 && far < 0.005, "{mode:?}: {mean} {far}");
    }
}

#[test]
fn finished_pictures_have_the_copies() {
    let model = ash();
    let mut renderer = Renderer::new().unwrap();
    let options = PictureOptions { width: 240, height: 280, background: Background::Paper };
    let mut picture = |model: &Model| renderer.picture(model, &textures, &View::default(), &options).unwrap();
    let (mean, far) = difference(&picture(&model.flattened()), &picture(&model), 24);
    assert!(mean < 0.3 && far < 0.005, "{mean} {far}");
}

#[test]
fn shapes_go_to_the_graphics_card_once_and_places_when_they_change() {
    let mut model = ash();
    let (renderer, mut view) = opened(&Model::default());
    let first = view.update(&renderer, &model, &textures).unwrap();
    let (same, mut other) = opened(&Model::default());
    let flat = other.update(&same, &*model.flattened(), &textures).unwrap();
    assert!(2 * first.bytes < flat.bytes, "{} bytes instead of {}", first.bytes, flat.bytes);
    assert_eq!(view.update(&renderer, &model, &textures).unwrap().bytes, 0);

    let of_group = |copies: &Copies| {
        let is_like = |k: usize| {
            let (a, b) = (&copies.placements[k], &copies.placements[0]);
            (a.slot, a.shape) == (b.slot, b.shape)
        };
        (0..copies.placements.len()).filter(|&k| is_like(k)).count() as u64
    };
    let count = of_group(copies(&mut model));
    copies(&mut model).placements[0].base += Vec3::Y;
    let moved = view.update(&renderer, &model, &textures).unwrap();
    assert_eq!((moved.uploaded_parts, moved.bytes), (1, PLACE * count));

    model.parts.retain(|part| part.copies.is_none());
    let bare = view.update(&renderer, &model, &textures).unwrap();
    assert!(bare.removed_parts > 0 && bare.bytes == 0);
}

#[test]
fn copies_that_contradict_themselves_are_refused() {
    let (renderer, mut view) = opened(&ash());
    let spoilers: [&dyn Fn(&mut Copies); 4] = [
        &|copies| copies.placements[0].shape = 99,
        &|copies| copies.placements[1].slot = 99,
        &|copies| copies.placements[2].u = copies.placements[2].v,
        &|copies| Arc::make_mut(&mut copies.shapes[0]).triangles[0][1] = u32::MAX,
    ];
    for (i, spoil) in spoilers.into_iter().enumerate() {
        let mut model = ash();
        spoil(copies(&mut model));
        assert!(model.check_invariants().is_err(), "{i}");
        let refusal = view.update(&renderer, &model, &textures).unwrap_err();
        assert!(matches!(refusal, RenderError::Model { .. }), "{i}: {refusal}");
    }
}
