//! What belongs to a drawing besides its strokes, each setting listed once: as changes ask for it and as steps keep it.

use super::{
    Canvas, Corrections, GardenDrawing, GardenStrokes, PartPoses, PetalShapes, Picture, PlacedPlant,
    Reference, Sketch, Textures, garden, textures,
};
use serde_json::{Map, Value};
use std::sync::Arc;

/// The settings as a struct of options, and what is done to each of them alike. That they are all there are is held by
/// taking a [`Sketch`] apart without a rest.
macro_rules! settings {
    ($($(#[$doc:meta])* $name:ident: $kind:ty,)*) => {
        /// Settings of a drawing; what is `None` is not spoken of.
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct Settings {
            $($(#[$doc])* pub $name: Option<$kind>,)*
        }

        impl Settings {
            /// What `sketch` has where these settings have something; and these settings without what is the same there.
            pub(super) fn against(self, sketch: &Sketch) -> (Self, Self) {
                let Sketch { strokes: _, $($name,)* } = sketch;
                let (mut before, mut after) = (Self::default(), Self::default());
                $((before.$name, after.$name) = differing($name, self.$name);)*
                (before, after)
            }

            pub(super) fn carry_out(&self, sketch: &mut Sketch) {
                $(set(&mut sketch.$name, &self.$name);)*
            }

            /// These settings, and those of `other` where these have nothing.
            pub(super) fn or(self, other: Self) -> Self {
                Self { $($name: self.$name.or(other.$name),)* }
            }
        }
    };
}

settings! {
    /// The sheet.
    canvas: Canvas,
    /// The species; `Some(None)` is any plant.
    species: Option<String>,
    /// The seed.
    seed: u64,
    /// All parameters that are not at their defaults.
    params: Map<String, Value>,
    /// All textures that the artist chose.
    textures: Textures,
    /// The picture under the drawing and how it lies; `Some(None)` takes it away.
    reference: Option<Arc<Reference>>,
    /// All plants beside the drawn one.
    plants: Vec<PlacedPlant>,
    /// All corrections of how strokes are read together.
    corrections: Corrections,
    /// All shapes of petals.
    petal_shapes: PetalShapes,
    /// All poses of branches.
    part_poses: PartPoses,
    /// All of the garden around the plant.
    garden: GardenStrokes,
}

impl Settings {
    /// Every drawing that a garden in these settings has plants of. One may come again.
    pub(super) fn garden_drawings(&self) -> impl Iterator<Item = &GardenDrawing> {
        self.garden.iter().flat_map(|garden| garden::drawings_of(garden))
    }

    /// Every picture in these settings. A picture may come again.
    pub(super) fn pictures(&self) -> impl Iterator<Item = &Picture> {
        let reference = self.reference.iter().flatten().map(|reference| &reference.picture);
        self.textures.iter().flat_map(textures::pictures).chain(reference)
    }
}

fn differing<T: Clone + PartialEq>(old: &T, new: Option<T>) -> (Option<T>, Option<T>) {
    match new.filter(|new| new != old) {
        Some(new) => (Some(old.clone()), Some(new)),
        None => (None, None),
    }
}

fn set<T: Clone>(slot: &mut T, value: &Option<T>) {
    if let Some(value) = value {
        *slot = value.clone();
    }
}
