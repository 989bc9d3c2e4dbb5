//! The plant itself as JSON: one branch, flower, template, organ or material per line, readable and diffable.
//!
//! Top-level keys are the fields of [`Plant`], its materials, to which branches and organs refer by index, as blades do to
//! its templates, and how the
//! drawing maps to the world; branches and organs have the stroke that drew them from the plant's [`Provenance`]. Numbers
//! are the shortest that read back the same. World space is metres, y up; `world_from_canvas` tells how the drawing maps to it: x = (x_canvas − origin.x)·scale,
//! y = (origin.y − y_canvas)·scale.

use super::error::ExportError;
use super::exporter::{Encoded, Exporter, Takes};
use super::scene::{PlantAndProvenance, Scene};
use crate::plant::{
    Blade, BladeForm, Branch, Cone, Detail, FinishedPlant, Flower, Organ, OrganKind, Plant, Provenance,
    RestSurface, Shape, Template,
};
use glam::{Vec2, Vec3};
use serde::Serialize;

/// The [`Plant`] as JSON.
#[derive(Debug)]
pub struct PlantJson;

impl Exporter for PlantJson {
    fn extension(&self) -> &'static str {
        "json"
    }

    fn takes(&self) -> Takes {
        Takes::Plant
    }

    fn encode(&self, scene: &Scene<'_>) -> Result<Encoded, ExportError> {
        Ok(Encoded { bytes: to_bytes(scene.plant.0, scene.plant.1)?, companions: Vec::new() })
    }
}

/// The plant as UTF-8 JSON ending in a newline.
///
/// # Errors
/// None for a plant and a provenance whose invariants hold.
pub fn to_bytes(plant: &FinishedPlant, provenance: &Provenance) -> Result<Vec<u8>, serde_json::Error> {
    // Every field is named here and below, so that a new one cannot be forgotten.
    let Plant { branches, flowers, organs, templates } = &**plant;
    let with = (plant, provenance);
    let branches: Vec<_> = branches.iter().map(|branch| BranchText::new(branch, with)).collect();
    let flowers: Vec<_> = flowers.iter().map(FlowerText::new).collect();
    let templates: Vec<_> = templates.iter().map(TemplateText::new).collect();
    let organs: Vec<_> = organs.iter().map(|organ| OrganText::new(organ, with)).collect();
    let mut out = Vec::new();
    out.extend_from_slice(b"{\n\"world_from_canvas\":");
    serde_json::to_writer(&mut out, &provenance.world_from_canvas)?;
    write_list(&mut out, "branches", &branches)?;
    write_list(&mut out, "flowers", &flowers)?;
    write_list(&mut out, "templates", &templates)?;
    write_list(&mut out, "organs", &organs)?;
    write_list(&mut out, "materials", plant.materials())?;
    out.extend_from_slice(b"\n}\n");
    Ok(out)
}

/// A branch as the file has it: with the index of its material.
#[derive(Serialize)]
struct BranchText<'a> {
    stroke: Option<u64>,
    parent: Option<usize>,
    level: u32,
    points: &'a [Vec3],
    radii: &'a [f32],
    material: usize,
}

impl<'a> BranchText<'a> {
    fn new(branch: &'a Branch, (plant, provenance): PlantAndProvenance<'_>) -> Self {
        let Branch { origin, parent, level, points, radii, role } = branch;
        let (stroke, material) = (provenance.stroke(*origin), plant.material(*role));
        Self { stroke, parent: *parent, level: *level, points, radii, material }
    }
}

#[derive(Serialize)]
struct FlowerText<'a> {
    branch: Option<usize>,
    cone: &'a Cone,
    #[serde(rename = "heart_radius")]
    centre_radius: f32,
    reach: f32,
    look: usize,
}

impl<'a> FlowerText<'a> {
    fn new(flower: &'a Flower) -> Self {
        let Flower { origin: _, branch, cone, centre_radius, reach, look } = flower;
        Self { branch: *branch, cone, centre_radius: *centre_radius, reach: *reach, look: *look }
    }
}

/// An organ as the file has it: with its kind and the index of its material.
#[derive(Serialize)]
struct OrganText<'a> {
    kind: OrganKind,
    stroke: Option<u64>,
    branch: Option<usize>,
    flower: Option<usize>,
    material: usize,
    shape: ShapeText<'a>,
}

/// A shape as the file has it: filaments with the index of their heads' material.
#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
enum ShapeText<'a> {
    Filament { points: &'a [Vec3], radius: f32, head: Vec2, head_material: usize },
    Blade(BladeText<'a>),
    Dome { base: Vec3, axis: Vec3, radius: f32, height: f32 },
    Lathe { base: Vec3, axis: Vec3, profile: &'a [Vec2] },
    Card { base: Vec3, u: Vec3, v: Vec3, window: [Vec2; 2] },
    Spike { base: Vec3, tip: Vec3, side: Vec3, foot: Vec2, hook: Vec3 },
}

/// A blade as the file has it: with the index of its template.
#[derive(Serialize)]
struct BladeText<'a> {
    template: usize,
    base: Vec3,
    u: Vec3,
    v: Vec3,
    rest: &'a RestSurface,
    form: &'a BladeForm,
}

impl<'a> BladeText<'a> {
    fn new(blade: &'a Blade) -> Self {
        let Blade { template, base, u, v, rest, form } = blade;
        Self { template: template.index(), base: *base, u: *u, v: *v, rest, form }
    }
}

/// What copies of a blade have in common, as the file has it.
#[derive(Serialize)]
struct TemplateText<'a> {
    outline: &'a [Vec2],
    curl: &'a [f32],
    length: f32,
    detail: Detail,
}

impl<'a> TemplateText<'a> {
    fn new(template: &'a Template) -> Self {
        let (outline, curl) = (template.outline(), template.curl());
        Self { outline, curl, length: template.length(), detail: template.detail() }
    }
}

impl<'a> OrganText<'a> {
    fn new(organ: &'a Organ, (plant, provenance): PlantAndProvenance<'_>) -> Self {
        let Organ { role, origin, branch, flower, shape } = organ;
        let shape = match shape {
            Shape::Filament { points, radius, head } => {
                let head_material = plant.material(role.of_head());
                ShapeText::Filament { points, radius: *radius, head: *head, head_material }
            }
            Shape::Blade(blade) => ShapeText::Blade(BladeText::new(blade)),
            Shape::Dome { base, axis, radius, height } => {
                ShapeText::Dome { base: *base, axis: *axis, radius: *radius, height: *height }
            }
            Shape::Card { base, u, v, window, .. } => {
                ShapeText::Card { base: *base, u: *u, v: *v, window: *window }
            }
            Shape::Spike { base, tip, side, foot, hook } => {
                ShapeText::Spike { base: *base, tip: *tip, side: *side, foot: *foot, hook: *hook }
            }
            Shape::Lathe { base, axis, profile } => ShapeText::Lathe { base: *base, axis: *axis, profile },
        };
        let (kind, material) = (organ.kind(), plant.material(*role));
        let stroke = provenance.stroke(*origin);
        Self { kind, stroke, branch: *branch, flower: *flower, material, shape }
    }
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
