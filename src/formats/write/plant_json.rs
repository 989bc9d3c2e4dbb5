//! The plant itself as JSON: one branch, flower, organ or material per line, readable and diffable.
//!
//! Top-level keys are the fields of [`Plant`]; numbers are the shortest that read back the same. World space is metres,
//! y up; `world_from_canvas` tells how the drawing maps to it: x = (x_canvas − origin.x)·scale,
//! y = (origin.y − y_canvas)·scale.

use super::{Encoded, ExportError, Exporter, Scene};
use crate::plant::Plant;
use serde::Serialize;

/// The [`Plant`] as JSON.
#[derive(Debug)]
pub struct PlantJson;

impl Exporter for PlantJson {
    fn extension(&self) -> &'static str {
        "json"
    }

    fn encode(&self, scene: &Scene<'_>) -> Result<Encoded, ExportError> {
        Ok(Encoded { bytes: to_bytes(scene.plant)?, companions: Vec::new() })
    }
}

/// The plant as UTF-8 JSON ending in a newline.
///
/// # Errors
/// None for a plant whose invariants hold.
pub fn to_bytes(plant: &Plant) -> Result<Vec<u8>, serde_json::Error> {
    // Every field is named here, so that a new one cannot be forgotten.
    let Plant { world_from_canvas, branches, flowers, organs, materials } = plant;
    let mut out = Vec::new();
    out.extend_from_slice(b"{\n\"world_from_canvas\":");
    serde_json::to_writer(&mut out, world_from_canvas)?;
    write_list(&mut out, "branches", branches)?;
    write_list(&mut out, "flowers", flowers)?;
    write_list(&mut out, "organs", organs)?;
    write_list(&mut out, "materials", materials)?;
    out.extend_from_slice(b"\n}\n");
    Ok(out)
}

fn write_list(out: &mut Vec<u8>, key: &str, items: &[impl Serialize]) -> Result<(), serde_json::Error> {
    out.extend_from_slice(b",\n\"");
    out.extend_from_slice(key.as_bytes());
    out.extend_from_slice(b"\":[");
    for (i, item) in items.iter().enumerate() {
        out.extend_from_slice(if i == 0 { b"\n" } else { b",\n" });
        serde_json::to_writer(&mut *out, item)?;
    }
    out.push(b']');
    Ok(())
}
