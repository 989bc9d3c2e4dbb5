//! Kinds of trees and bushes of a garden whose crowns grow through each other.
//!
//! Plants of a garden know nothing of their neighbours' size: how close they stand comes from densities and spacings. Two plants
//! stand too close when their feet are nearer than half of what their crowns need side by side. Low plants are left out: flowers and
//! grass are to touch.
//!
//! Limits: a crown is taken for as wide as the individuals of its kind on average.

use super::occupied::Occupied;
use super::plan::Place;
use super::scene::Garden;
use super::stock::{Individual, KindStock};
use crate::geom::polyline;
use glam::{Vec2, Vec3Swizzles};

/// Plants of at least this height are trees or bushes, metres.
const TALL: f32 = 1.5;
/// How near two feet may be, share of the distance at which the crowns touch.
const NEAREST: f32 = 0.5;
/// A kind is crowded if more than this share of its plants stand too close.
const SHARE: f32 = 0.5;

/// A kind whose plants mostly stand too close to others.
#[derive(Clone, Debug, PartialEq)]
pub struct Crowded {
    /// Its name.
    pub kind: String,
    /// How wide its crowns are on average, metres.
    pub width: f32,
    /// How many of its plants stand too close, and how many there are.
    pub plants: [usize; 2],
}

/// The crowded kinds of a garden, in their order.
pub fn crowded(garden: &Garden) -> Vec<Crowded> {
    let kinds = &garden.stock.kinds;
    let widths: Vec<Option<f32>> = kinds.iter().map(crown_width).collect();
    let kept = |place: &Place| widths[place.kind as usize].map(|width| NEAREST * width * place.scale);
    let tall =
        garden.places.iter().filter_map(|place| kept(place).map(|kept| (place, (place.at.xz(), kept))));
    let (places, crowns): (Vec<&Place>, Vec<(Vec2, f32)>) = tall.unzip();
    let bounds = polyline::bounds(crowns.iter().map(|(at, _)| *at));
    let occupied = Occupied::of(crowns, bounds);
    let mut plants = vec![[0, 0]; kinds.len()];
    for (index, place) in places.iter().enumerate() {
        let [close, all] = &mut plants[place.kind as usize];
        *close += usize::from(occupied.is_close(index));
        *all += 1;
    }
    let kinds = kinds.iter().zip(widths).zip(plants);
    let crowded = |((kind, width), plants): ((&KindStock, Option<f32>), [usize; 2])| {
        let is_crowded = plants[0] as f32 > SHARE * plants[1] as f32;
        width.filter(|_| is_crowded).map(|width| Crowded { kind: kind.name.clone(), width, plants })
    };
    kinds.filter_map(crowded).collect()
}

/// How wide the crowns of tall plants are on average, metres; none of low ones.
fn crown_width(kind: &KindStock) -> Option<f32> {
    let height = kind.individuals.iter().map(Individual::height).sum::<f32>();
    (height >= TALL * kind.individuals.len().max(1) as f32).then(|| kind.width())
}

#[cfg(test)]
mod tests {
    use super::super::stock::{Grown, Stock};
    use super::*;
    use crate::model::{Mesh, Model, Part, PartKind};
    use crate::plant::Material;
    use glam::{Quat, Vec3};
    use std::sync::Arc;

    /// A plant as a triangle, four metres wide.
    fn stock(height: f32) -> Stock {
        let points = vec![Vec3::new(-2.0, 0.0, -2.0), Vec3::new(2.0, height, 2.0), Vec3::new(2.0, 0.0, -2.0)];
        let vertices = (0..3).map(|point| crate::model::Vertex { point, normal: Vec3::Y, uv: Vec2::ZERO });
        let mesh =
            Mesh { points, vertices: vertices.collect(), triangles: vec![[0, 1, 2]], breaks: Vec::new() };
        let part = Part {
            name: "wood".into(),
            kind: PartKind::Wood,
            parent: None,
            specimen: 0,
            pivot: Vec3::ZERO,
            material: 0,
            more_materials: Vec::new(),
            mesh: Arc::new(mesh),
            copies: None,
        };
        let model = Model { parts: vec![part], materials: vec![Material::plain("bark", [0.2; 3])] };
        let mut stock = Stock::default();
        stock.add("oak", vec![Grown { model, ..Grown::default() }], 0.0);
        stock
    }

    fn garden(height: f32, apart: f32) -> Garden {
        let at = |i: usize| Vec3::new(apart * i as f32, 0.0, 0.0);
        let place = |i| Place { kind: 0, variant: 0, at: at(i), rotation: Quat::IDENTITY, scale: 1.0 };
        Garden { stock: stock(height), places: (0..5).map(place).collect(), ground: None, walls: Vec::new() }
    }

    #[test]
    fn trees_that_stand_within_each_other_are_crowded() {
        let close = crowded(&garden(5.0, 1.9));
        assert_eq!(close, [Crowded { kind: "oak".to_owned(), width: 4.0, plants: [5, 5] }]);
    }

    #[test]
    fn trees_side_by_side_and_low_plants_are_not() {
        assert_eq!(crowded(&garden(5.0, 2.1)), []);
        assert_eq!(crowded(&garden(1.0, 0.1)), []);
    }

    #[test]
    fn a_garden_without_plants_is_not() {
        assert_eq!(crowded(&Garden { places: Vec::new(), ..garden(5.0, 1.0) }), []);
    }
}
