//! Pictures of gardens: far plants have few triangles and look as if they had many, near ones are as fine as they are, and nothing depends on
//! what was seen before.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use glam::{Quat, Vec2, Vec3};
use penstemon::formats::textures::fetch;
use penstemon::garden::{Garden, Place, Seen, Stock, Views};
use penstemon::model::Model;
use penstemon::pipeline::{self, Form, Grower};
use penstemon::plant::Texture;
use penstemon::render::{
    Background, Look, OrbitCamera, PictureOptions, RenderedImage, Renderer, View, Viewport,
};
use penstemon::species::{Species, builtin_texture};
use std::borrow::Cow;
use std::error::Error;
use std::sync::Arc;

fn texture(texture: &Texture) -> Result<Cow<'static, [u8]>, Box<dyn Error + Send + Sync>> {
    Ok(fetch(texture, &|name| builtin_texture(name).map(Cow::Borrowed))?)
}

/// Plants of a species in rows, so many to each side and so far from one another, with all their forms.
fn rows(name: &str, side: i16, apart: f32) -> Garden {
    let species = Box::new(Species::built_in(name).unwrap());
    let params = Box::new(pipeline::params_of_species(&species, &[]).unwrap());
    let grower =
        Grower::Species { species, params, age: None, first_seed: 1, form: Form::Whole, before: None };
    let mut stock = Stock::default();
    stock.add(name, grower.grow_all(2, true), 0.0);
    let place = |i: i16| {
        let (column, row) = (f32::from(i % side), f32::from(i / side));
        let middle = 0.5 * f32::from(side - 1);
        Place {
            kind: 0,
            variant: (i % 2) as u32,
            at: apart * Vec3::new(column - middle, 0.0, row - middle),
            rotation: Quat::from_rotation_y(f32::from(i)),
            scale: 1.0,
        }
    };
    Garden { stock, places: (0..side * side).map(place).collect(), ..Garden::default() }
}

/// The same with plants that are as fine wherever they stand.
fn fine(garden: &Garden) -> Garden {
    let mut garden = garden.clone();
    for individual in garden.stock.kinds.iter_mut().flat_map(|kind| &mut kind.individuals) {
        (individual.coarser, individual.views) = (Vec::new(), Views::default());
    }
    garden
}

fn seen(garden: Garden) -> Seen<'static> {
    Seen::with_garden(Cow::Owned(Model::default()), &Arc::new(garden))
}

/// Share of a picture that is covered, and the mean colour of that, 0 to 255.
fn colours(picture: &RenderedImage) -> (f32, [f32; 3]) {
    let (mut covered, mut sum) = (0.0, [0.0; 3]);
    for &[r, g, b, alpha] in picture.pixels().as_chunks().0 {
        let share = f32::from(alpha) / 255.0;
        covered += share;
        sum.iter_mut().zip([r, g, b]).for_each(|(sum, c)| *sum += share * f32::from(c));
    }
    (covered / picture.pixels().len() as f32 * 4.0, sum.map(|sum| sum / covered))
}

#[test]
fn small_plants_have_few_triangles_and_the_colours_of_fine_ones() {
    let mut renderer = Renderer::new().unwrap();
    let view = View { direction: penstemon::render::Direction::ThreeQuarter, ..View::default() };
    let options = PictureOptions { width: 400, height: 240, background: Background::Transparent };
    for (name, apart) in [("rose", 0.8), ("tulip", 0.2), ("lavender", 0.5)] {
        let garden = rows(name, 12, apart);
        let mut picture = |garden: Garden| {
            let mut model = renderer.upload(seen(garden), &texture).unwrap();
            let picture = renderer.pictures(&mut model, &[view], &options).next().unwrap().unwrap();
            (colours(&picture), model.triangles_in_view())
        };
        let ((area, light), many) = picture(fine(&garden));
        let ((of_few, other), few) = picture(garden);
        assert!(few * 20 < many, "{name}: {few} triangles of {many}");
        assert!((0.8..1.15).contains(&(of_few / area)), "{name}: {of_few} covered of {area}");
        let off = light.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(off < 20.0, "{name}: colours {light:?} became {other:?}");
    }
}

#[test]
fn near_plants_are_fine_and_those_outside_of_the_picture_are_not_drawn() {
    let mut renderer = Renderer::new().unwrap();
    let garden = rows("rose", 12, 1.0);
    let finest = garden.stock.kinds[0].individuals[0].triangle_count() as u64;
    let mut model = renderer.upload(seen(garden), &texture).unwrap();
    let options = PictureOptions { width: 320, height: 200, background: Background::Outdoors };
    let mut triangles = |at: Vec2, to: Vec2| {
        let camera = [OrbitCamera::at_eye(at, 1.0, to, 0.0)];
        let picture = renderer.pictures_by(&mut model, &camera, &options).next().unwrap().unwrap();
        (model.triangles_in_view(), picture)
    };
    let (among, picture) = triangles(Vec2::new(0.0, 6.5), Vec2::ZERO);
    assert!(among > finest, "{among} of {finest}");
    let (far, _) = triangles(Vec2::new(0.0, 60.0), Vec2::ZERO);
    assert_eq!(far, 144 * 4, "each is one picture");
    assert_eq!(triangles(Vec2::new(0.0, 60.0), Vec2::new(0.0, 90.0)).0, 0);
    // And again as it was.
    let (again, same) = triangles(Vec2::new(0.0, 6.5), Vec2::ZERO);
    assert!(again == among && same == picture);
}

#[test]
fn a_walk_in_the_window_comes_back_to_the_same_picture() {
    let renderer = Renderer::new().unwrap();
    let mut view = Viewport::new(&renderer).unwrap();
    view.set_size(240, 160);
    let mut garden = rows("tulip", 10, 0.3);
    view.update(&renderer, seen(garden.clone()), &texture).unwrap();
    let look = Look { background: Background::Outdoors, ..Look::default() };
    let at = |view: &mut Viewport, away: f32| {
        let camera = OrbitCamera::at_eye(Vec2::new(0.2, away), 0.5, Vec2::ZERO, 0.0);
        view.draw(&renderer, &camera, &look).unwrap();
        view.snapshot(&renderer).unwrap()
    };
    let [near, far, back] = [1.8, 9.0, 1.8].map(|away| at(&mut view, away));
    assert!(near == back && near != far);
    // A garden that contradicts itself is refused, and changes nothing.
    let mut broken = garden.clone();
    broken.places[0].variant = 9;
    assert!(view.update(&renderer, seen(broken), &texture).is_err());
    assert!(at(&mut view, 1.8) == near);
    // One plant less: its individuals are there already.
    garden.places.pop();
    let stats = view.update(&renderer, seen(garden), &texture).unwrap();
    assert!(stats.bytes > 0 && stats.bytes < 100 * 48 && stats.uploaded_textures == 0, "{stats:?}");
    assert!(at(&mut view, 1.8) != near);
}
