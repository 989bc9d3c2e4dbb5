//! Plants that stand beside the drawn one: which maker makes each of them, and where it stands on the sheet.
//!
//! The strokes of a drawing are made into a plant by the drawing's own maker; each entry here names another maker and what
//! that one needs to know. Whether a species exists is known to those who build.

use super::limits;
use crate::quote;
use glam::Vec2;
use thiserror::Error;

/// What a plant is made by, with all that decides what it looks like.
#[derive(Clone, Debug, PartialEq)]
pub enum Maker {
    /// It grows from a seed.
    Growth(SeedOf),
}

/// A plant that grows from a seed.
#[derive(Clone, Debug, PartialEq)]
pub struct SeedOf {
    /// Name of a built-in species that grows by itself.
    pub species: String,
    /// Seed of everything random in it.
    pub seed: u64,
    /// Age in years, from 0 to [`limits::MAX_PLANT_AGE`]; none for the species' own.
    pub age: Option<f32>,
}

/// A plant that stands beside the drawn one.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedPlant {
    /// What makes it.
    pub maker: Maker,
    /// Where it stands, canvas pixels; as far from the viewer as the drawing.
    pub foot: Vec2,
    /// How high it is on the canvas, pixels, more than 0; none for its own height in metres.
    pub height: Option<f32>,
}

/// Why plants cannot stand beside a drawn one.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum PlantsError {
    /// Too many of them.
    #[error("a drawing holds at most {} plants beside the drawn one", limits::MAX_PLANTS)]
    TooMany,
    /// One of them cannot.
    #[error("plant {place}: {fault}")]
    Of {
        /// Its place in the list, from 1.
        place: usize,
        /// What is wrong with it.
        fault: PlantFault,
    },
}

/// What is wrong with a plant that is to stand beside a drawn one.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum PlantFault {
    /// No species can be called so.
    #[error("`{name}` cannot name a species; write one of the built-in ones")]
    Species {
        /// The name, as far as it is short.
        name: String,
    },
    /// It stands too far away, or nowhere.
    #[error("the foot lies beyond ±{:e} pixels; place the plant nearer", limits::MAX_COORDINATE)]
    Foot,
    /// It has no age, or is too old.
    #[error("the age must be 0 to {} years; leave it out for the usual", limits::MAX_PLANT_AGE)]
    Age,
    /// It is too low or too high.
    #[error(
        "the height must be {} to {:e} pixels; leave it out for the natural one",
        limits::MIN_PLANT_HEIGHT,
        limits::MAX_CANVAS_SIDE
    )]
    Height,
}

impl Maker {
    /// The names of all makers, as files say them.
    pub const NAMES: [&str; 1] = ["growth"];

    /// The name used in files.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Growth(_) => Self::NAMES[0],
        }
    }

    /// The species of the plant.
    pub fn species(&self) -> &str {
        match self {
            Self::Growth(SeedOf { species, .. }) => species,
        }
    }
}

impl PlacedPlant {
    /// Checks that every number is finite and in range and that the species has a name.
    ///
    /// # Errors
    /// The first that is not.
    pub fn check(&self) -> Result<(), PlantFault> {
        let Self { maker: Maker::Growth(SeedOf { species, seed: _, age }), foot, height } = self;
        if species.is_empty() || species.len() > limits::MAX_SPECIES_NAME_BYTES {
            return Err(PlantFault::Species { name: quote::name(species) });
        }
        if !foot.abs().cmple(Vec2::splat(limits::MAX_COORDINATE)).all() {
            return Err(PlantFault::Foot);
        }
        if age.is_some_and(|age| !(0.0..=limits::MAX_PLANT_AGE).contains(&age)) {
            return Err(PlantFault::Age);
        }
        let heights = limits::MIN_PLANT_HEIGHT..=limits::MAX_CANVAS_SIDE;
        if height.is_some_and(|height| !heights.contains(&height)) {
            return Err(PlantFault::Height);
        }
        Ok(())
    }
}

/// Checks the plants beside a drawn one.
///
/// # Errors
/// The first plant that is not sound, or that there are too many.
pub(super) fn check(plants: &[PlacedPlant]) -> Result<(), PlantsError> {
    if plants.len() > limits::MAX_PLANTS {
        return Err(PlantsError::TooMany);
    }
    let numbered = |(i, plant): (usize, &PlacedPlant)| {
        plant.check().map_err(|fault| PlantsError::Of { place: i + 1, fault })
    };
    plants.iter().enumerate().try_for_each(numbered)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_checked_and_the_plant_is_named() {
        let oak = SeedOf { species: "oak".into(), seed: 3, age: Some(4.0) };
        let plant = |of: SeedOf, foot: [f32; 2], height| PlacedPlant {
            maker: Maker::Growth(of),
            foot: foot.into(),
            height,
        };
        let sound = plant(oak.clone(), [1.0, 2.0], Some(300.0));
        assert_eq!(check(&vec![sound.clone(); limits::MAX_PLANTS]), Ok(()));
        let many = check(&vec![sound.clone(); limits::MAX_PLANTS + 1]).unwrap_err();
        assert!(many.to_string().contains("at most 16"), "{many}");
        for (bad, part) in [
            (plant(SeedOf { species: String::new(), ..oak.clone() }, [0.0; 2], None), "species"),
            (plant(SeedOf { age: Some(-1.0), ..oak.clone() }, [0.0; 2], None), "age"),
            (plant(SeedOf { age: Some(f32::NAN), ..oak.clone() }, [0.0; 2], None), "age"),
            (plant(oak.clone(), [f32::INFINITY, 0.0], None), "foot"),
            (plant(oak, [0.0; 2], Some(0.0)), "height"),
        ] {
            let message = check(&[sound.clone(), bad]).unwrap_err().to_string();
            assert!(message.starts_with("plant 2: ") && message.contains(part), "{message}");
        }
    }
}
