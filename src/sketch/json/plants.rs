//! The `plants` of a drawing: those that stand beside the drawn one, each on one line.
//!
//! ```json
//! {"maker": "growth", "species": "oak", "seed": 7, "age": 12, "foot": [820, 700], "height": 600}
//! ```
//!
//! `maker`, `species` and `foot` are required.

use super::number::push_number;
use super::progress::Progress;
use crate::quote;
use crate::sketch::error::Fault;
use crate::sketch::limits;
use crate::sketch::plants::{Maker, PlacedPlant, SeedOf};
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, SeqAccess, Visitor};
use serde_json::json;
use std::fmt;

/// Appends a plant as JSON.
pub(super) fn push(out: &mut String, plant: &PlacedPlant) {
    let PlacedPlant { maker, foot, height } = plant;
    let Maker::Growth(SeedOf { species, seed, age }) = maker;
    let number = |out: &mut String, name: &str, number: f32| {
        out.push_str(name);
        push_number(out, number);
    };
    out.push_str(&format!(
        "{{\"maker\": {}, \"species\": {}, \"seed\": {seed}",
        json!(maker.name()),
        json!(species)
    ));
    age.iter().for_each(|age| number(out, ", \"age\": ", *age));
    number(out, ", \"foot\": [", foot.x);
    number(out, ", ", foot.y);
    out.push(']');
    height.iter().for_each(|height| number(out, ", \"height\": ", *height));
    out.push('}');
}

/// Reads the list.
pub(super) struct PlantsSeed<'p>(pub(super) &'p Progress);

impl<'de> DeserializeSeed<'de> for PlantsSeed<'_> {
    type Value = Vec<PlacedPlant>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for PlantsSeed<'_> {
    type Value = Vec<PlacedPlant>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of plants")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let progress = self.0;
        let mut plants = Vec::new();
        progress.plant.set(1);
        while let Some(plant) = seq.next_element::<PlantText>()? {
            if plants.len() == limits::MAX_PLANTS {
                return Err(progress.refuse(Fault::TooMany { what: "plants", limit: limits::MAX_PLANTS }));
            }
            let plant = plant.placed();
            plant.check().map_err(|fault| progress.malformed(fault.to_string()))?;
            plants.push(plant);
            progress.plant.set(plants.len() + 1);
        }
        progress.plant.set(0);
        Ok(plants)
    }
}

/// The plants of a step in the journal.
pub(super) struct Plants(pub(super) Vec<PlacedPlant>);

impl<'de> Deserialize<'de> for Plants {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        PlantsSeed(&Progress::default()).deserialize(deserializer).map(Self)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PlantText {
    #[serde(rename = "maker")]
    _maker: MakerName,
    species: String,
    #[serde(default)]
    seed: u64,
    age: Option<f32>,
    foot: [f32; 2],
    height: Option<f32>,
}

impl PlantText {
    fn placed(self) -> PlacedPlant {
        let Self { _maker: MakerName, species, seed, age, foot, height } = self;
        PlacedPlant { maker: Maker::Growth(SeedOf { species, seed, age }), foot: foot.into(), height }
    }
}

/// The name of a maker that exists: as long as there is one, which says no more.
struct MakerName;

impl<'de> Deserialize<'de> for MakerName {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        if Maker::NAMES.contains(&name.as_str()) {
            return Ok(Self);
        }
        let (name, known) = (quote::name(&name), Maker::NAMES.join(", "));
        Err(D::Error::custom(format!("no plant is made by `{name}`; the makers are {known}")))
    }
}
