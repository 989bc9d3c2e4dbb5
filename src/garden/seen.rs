//! What is looked at: a model, and beside it the plants of a garden, which stay copies of their individuals.
//!
//! Whoever draws it chooses for each plant the coarsest form of its individual that is fine enough for its size in the picture
//! (`render/sight.rs`), so that a garden of thousands has fine plants near by and few triangles.

use super::Garden;
use super::stock::{Individual, KindStock};
use crate::model::Model;
use glam::Vec3;
use std::borrow::Cow;
use std::sync::Arc;

/// What is looked at.
#[derive(Clone, Debug)]
pub struct Seen<'a> {
    /// What there is once, with the materials of everything.
    pub model: Cow<'a, Model>,
    /// Copies of few plants.
    pub crowd: Option<Crowd>,
}

/// The plants of a garden.
#[derive(Clone, Debug)]
pub struct Crowd {
    /// The garden.
    pub garden: Arc<Garden>,
    /// Which of [`Seen::model`]'s materials is the individuals' first.
    pub first_material: usize,
}

impl<'a> From<&'a Model> for Seen<'a> {
    fn from(model: &'a Model) -> Self {
        Self { model: Cow::Borrowed(model), crowd: None }
    }
}

impl<'a> Seen<'a> {
    /// A model with a garden around it.
    pub fn with_garden(model: Cow<'a, Model>, garden: &Arc<Garden>) -> Self {
        let mut model = model;
        let first_material = garden.join_without_plants(model.to_mut());
        Self { model, crowd: Some(Crowd { garden: garden.clone(), first_material }) }
    }

    /// The same without borrowing anything.
    pub fn into_owned(self) -> Seen<'static> {
        Seen { model: Cow::Owned(self.model.into_owned()), crowd: self.crowd }
    }

    /// Smallest and largest corner, those of the plants about; none where nothing is.
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        let of_crowd = self.crowd.as_ref().and_then(Crowd::bounds);
        let join = |a: (Vec3, Vec3), b: (Vec3, Vec3)| (a.0.min(b.0), a.1.max(b.1));
        self.model.bounds().into_iter().chain(of_crowd).reduce(join)
    }

    /// Corners and triangles of everything, each plant in its finest form.
    pub fn counts(&self) -> [usize; 2] {
        let of_plants = self.crowd.as_ref().map_or([0; 2], |crowd| crowd.garden.counts_of_plants());
        let of_model = [self.model.vertex_count(), self.model.triangle_count()];
        [0, 1].map(|i| of_model[i] + of_plants[i])
    }
}

impl Crowd {
    /// Smallest and largest corner of all plants, about; none where none stand.
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        let of_point = |point| (point, point);
        self.outermost_points().map(of_point).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
    }

    /// For each plant the points of its individual that lie outermost in fourteen directions.
    pub fn outermost_points(&self) -> impl Iterator<Item = Vec3> + use<'_> {
        let Garden { stock, places, .. } = &*self.garden;
        let of_kind = |kind: &KindStock| kind.individuals.iter().map(outermost).collect();
        let outermost: Vec<Vec<Vec<Vec3>>> = stock.kinds.iter().map(of_kind).collect();
        places.iter().flat_map(move |place| {
            let points = outermost.get(place.kind as usize).and_then(|kind| kind.get(place.variant as usize));
            let points = points.cloned().unwrap_or_default();
            points.into_iter().map(|point| place.point(point))
        })
    }
}

/// Along the axes, and between them.
fn directions() -> impl Iterator<Item = Vec3> {
    let signs = [-1.0, 1.0];
    let along = Vec3::AXES.into_iter().flat_map(move |axis| signs.map(|sign| axis * sign));
    let between = (0..8).map(move |corner| Vec3::from_array([0, 1, 2].map(|axis| signs[corner >> axis & 1])));
    along.chain(between)
}

/// The points of an individual that lie outermost.
fn outermost(individual: &Individual) -> Vec<Vec3> {
    let points = || individual.surfaces.iter().flat_map(|surface| &surface.mesh.points);
    let farthest = |direction: Vec3| {
        let along = |point: &&Vec3| point.dot(direction);
        points().max_by(|a, b| along(a).total_cmp(&along(b))).copied()
    };
    directions().filter_map(farthest).collect()
}

#[cfg(test)]
mod tests {
    use super::super::Place;
    use super::super::stock::{Grown, Stock};
    use super::*;
    use crate::model::{Mesh, Part, PartKind};
    use crate::plant::Material;
    use glam::Quat;

    /// A sphere of points around (0, 2, 0) with a radius of one, as a plant.
    fn sphere() -> Model {
        let at = |i: usize| {
            let (height, turn) = (1.0 - 2.0 * (i as f32 + 0.5) / 300.0, 2.4 * i as f32);
            let (sin, cos) = turn.sin_cos();
            Vec3::new(
                cos * (1.0 - height * height).sqrt(),
                2.0 + height,
                sin * (1.0 - height * height).sqrt(),
            )
        };
        let points: Vec<Vec3> = (0..300).map(at).collect();
        let triangles: Vec<[u32; 3]> = (0..298).map(|i| [i, i + 1, i + 2]).collect();
        let mesh = Mesh::faceted(&points, &triangles);
        let part = Part::alone("ball", PartKind::Wood, 0, Arc::new(mesh));
        Model { parts: vec![part], materials: vec![Material::plain("ball", [0.5; 3])] }
    }

    #[test]
    fn what_is_looked_at_reaches_as_far_as_its_plants() {
        let mut stock = Stock::default();
        stock.add("ball", vec![Grown::from(sphere())], 0.0);
        let place = |x: f32, scale: f32| Place {
            kind: 0,
            variant: 0,
            at: Vec3::X * x,
            rotation: Quat::from_rotation_y(x),
            scale,
        };
        let garden =
            Arc::new(Garden { stock, places: vec![place(0.0, 1.0), place(9.0, 2.0)], ..Garden::default() });
        let model = sphere();
        let seen = Seen::with_garden(Cow::Borrowed(&model), &garden);
        assert_eq!((seen.model.parts.len(), seen.model.materials.len()), (1, 2));
        assert_eq!(seen.crowd.as_ref().map(|crowd| crowd.first_material), Some(1));
        assert_eq!(seen.counts()[1], 3 * 298);
        let (low, high) = seen.bounds().unwrap();
        let (wanted_low, wanted_high) = (Vec3::new(-1.0, 1.0, -2.0), Vec3::new(11.0, 6.0, 2.0));
        assert!(low.distance(wanted_low) < 0.4 && high.distance(wanted_high) < 0.4, "{low} {high}");
        assert_eq!(Seen::from(&model).bounds(), model.bounds());
        assert_eq!(seen.crowd.unwrap().outermost_points().count(), 28);
    }
}
