//! `penstemon check`: is this mesh fit for a modeller, a game engine, a printer?

use super::common;
use crate::formats::read::{load, read};
use crate::geom::weld::weld;
use crate::model::crossing::crossing_faces;
use crate::model::quality::{Report, judge};
use crate::model::{Mesh, Model};
use crate::quote;
use serde::Serialize;
use std::path::PathBuf;
use std::process::ExitCode;

/// How many of the faulty meshes are named.
const NAMED: usize = 5;

/// Arguments.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The model, OBJ or GLB.
    model: PathBuf,
    /// Print one JSON object instead of text.
    #[arg(long)]
    json: bool,
}

/// What was found in a file.
#[derive(Serialize)]
struct Verdict {
    clean: bool,
    #[serde(flatten)]
    report: Report,
    /// Faces that pass through others of the model as it is shown, whatever parts the file divides it into: no defect, but
    /// what a printer has to sort out. Nothing where too many faces lie over each other to be compared.
    crossing_faces: Option<usize>,
    /// Names of faulty meshes, at most [`NAMED`].
    faulty: Vec<String>,
}

/// Runs the verb: prints the report; exit code 1 when a defect was found.
///
/// # Errors
/// A file that cannot be read, or an output that cannot be written.
pub fn run(args: &Args) -> anyhow::Result<ExitCode> {
    let mut report = Report::default();
    let mut faulty = Vec::new();
    let surfaces = read(&args.model)?;
    // A file too broken to be shown is still judged mesh by mesh.
    let crossing_faces = match load(&args.model) {
        Ok(loaded) => crossing_faces(&whole(&loaded.model)),
        Err(_) => surfaces.iter().map(|surface| crossing_faces(&surface.mesh)).sum(),
    };
    for surface in surfaces {
        let one = judge(&surface.mesh, surface.has);
        if !one.is_clean() && !surface.name.is_empty() && faulty.len() < NAMED {
            faulty.push(quote::name(&surface.name));
        }
        report.add(&one.of_copies(surface.copies));
    }
    let verdict = Verdict { clean: report.is_clean(), report, crossing_faces, faulty };
    let text = if args.json { serde_json::to_string(&verdict)? } else { described(args, &verdict) };
    common::print(&text)?;
    Ok(if verdict.clean { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// All parts as one mesh, in which places that are the same are one point: each format divides a plant in its own way.
fn whole(model: &Model) -> Mesh {
    let mut all = Mesh::default();
    model.parts.iter().for_each(|part| all.append(&part.mesh));
    let (points, point_of_position) = weld(&all.points);
    all.points = points;
    for vertex in &mut all.vertices {
        vertex.point = point_of_position.get(vertex.point as usize).copied().unwrap_or(u32::MAX);
    }
    all
}

fn described(args: &Args, verdict: &Verdict) -> String {
    let report = &verdict.report;
    let mut text = format!(
        "{}: {} points, {} triangles, {} components",
        args.model.display(),
        report.points,
        report.triangles,
        report.components
    );
    if let Some(range) = report.uv_range {
        text +=
            &format!(", UVs from ({}, {}) to ({}, {})", range.min.x, range.min.y, range.max.x, range.max.y);
    }
    match verdict.crossing_faces {
        Some(0) => {}
        Some(count) => {
            let share = 100.0 * count as f64 / report.triangles as f64;
            text += &format!("\n  {count} faces pass through others ({share:.2} %)");
        }
        None => text += "\n  too many faces lie over each other to count those that pass through others",
    }
    for (what, count) in report.defects() {
        text += &format!("\n  {count} {what}");
    }
    if !verdict.faulty.is_empty() {
        text += &format!("\n  among others in: {}", verdict.faulty.join(", "));
    }
    if verdict.clean {
        text += "\n  no defects";
    }
    text
}
