//! The command line: one file per verb.
//!
//! Exit codes: 0 done, 1 bad input or failure with one message on stderr, 2 wrong usage (clap's).

pub mod bloom;
pub mod build;
pub mod check;
pub mod common;
#[cfg(target_os = "linux")]
mod compositor;
mod depth_pictures;
pub mod garden;
pub mod grow;
pub mod inside;
pub mod inspect;
pub mod lobes;
mod lod;
mod obstacle;
pub mod params;
pub mod pen;
pub mod photo;
mod photo_plant;
pub mod render;
mod rose;
pub mod studio;
pub mod tablets;
mod walk;

use clap::{CommandFactory, Parser, Subcommand};
use std::path::PathBuf;
use std::process::ExitCode;

/// Turns pen strokes into 3D plants.
#[derive(Debug, Parser)]
#[command(name = "penstemon", version)]
pub struct Cli {
    /// Also tell on stderr how long each stage takes and which driver draws.
    #[arg(long, global = true)]
    pub verbose: bool,
    /// Opens the window on this drawing (.penstemon or .svg); without it, on a sample or an empty drawing.
    #[arg(value_parser = drawing)]
    pub file: Option<PathBuf>,
    /// What to do without a window.
    #[command(subcommand)]
    pub verb: Option<Verb>,
}

/// The verbs.
#[derive(Debug, Subcommand)]
pub enum Verb {
    /// Drawing to plant: OBJ, GLB or the plant itself as JSON.
    Build(build::Args),
    /// A plant that grows by itself, without a drawing: OBJ, GLB or the plant itself as JSON.
    Grow(grow::Args),
    /// A full flower without a drawing: OBJ, GLB, the plant itself as JSON, or a picture.
    Bloom(bloom::Args),
    /// A garden of thousands of plants that are copies of a few: GLB, OBJ, a picture, or a list of places as JSON.
    Garden(garden::Args),
    /// Closed surfaces of lobes, crowns drawn as strokes in space: OBJ or GLB.
    Lobes(lobes::Args),
    /// What the analysis understood of a drawing, as JSON.
    Inspect(inspect::Args),
    /// Petals, leaves, bark and whole plants from photographs: outline, texture or mask, or a drawing with them.
    Photo(photo::Args),
    /// Every parameter that --set can change: path, value, unit, range and meaning.
    Params(params::Args),
    /// Mesh quality report of an OBJ or GLB file; exit code 1 when a defect is found.
    Check(check::Args),
    /// Picture of a sketch or model.
    Render(render::Args),
    /// Which tablets are plugged in, how each is read, and what its pen says.
    Tablets(tablets::Args),
    /// Recordings of tablets: make one, or print one.
    Pen(pen::Args),
}

/// A drawing named without a verb; a word that is no file is more likely a mistyped verb.
fn drawing(name: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(name);
    if path.extension().is_some() || path.components().count() > 1 || path.exists() {
        return Ok(path);
    }
    let verbs = Cli::command().get_subcommands().map(|v| v.get_name().to_owned()).collect::<Vec<_>>();
    let nearest = crate::suggest::nearest(name, verbs.iter().map(String::as_str)).map(str::to_owned);
    Err(format!("there is no verb and no drawing of this name{}", crate::suggest::did_you_mean(&nearest)))
}

/// An error with its causes as one message of bounded length, without anything that a terminal obeys. Many errors quote
/// their cause; it is not said twice.
pub fn one_line(error: &anyhow::Error) -> String {
    let whole = error.chain().fold(String::new(), |message, cause| {
        let cause = cause.to_string();
        match message.as_str() {
            "" => cause,
            text if text.ends_with(&cause) => message,
            text => format!("{text}: {cause}"),
        }
    });
    crate::quote::message(&whole)
}

/// What is wrong with a command line, line by line as [`one_line`] tells errors.
pub fn usage(error: &clap::Error) -> String {
    let text = error.render().to_string();
    text.lines().map(|line| crate::quote::message(line) + "\n").collect()
}

/// Runs one command line.
///
/// # Errors
/// Anything that kept the verb from its result, ready to be shown.
pub fn run(cli: Cli) -> anyhow::Result<ExitCode> {
    #[cfg(target_os = "linux")]
    if matches!(cli.verb, Some(Verb::Render(_) | Verb::Grow(_) | Verb::Bloom(_) | Verb::Garden(_))) {
        compositor::leave_alone();
    }
    match cli.verb {
        None => crate::app::run(cli.file).map(|()| ExitCode::SUCCESS),
        Some(Verb::Build(args)) => build::run(&args),
        Some(Verb::Grow(args)) => grow::run(&args),
        Some(Verb::Bloom(args)) => bloom::run(&args),
        Some(Verb::Garden(args)) => garden::run(&args),
        Some(Verb::Lobes(args)) => lobes::run(&args),
        Some(Verb::Inspect(args)) => inspect::run(&args),
        Some(Verb::Photo(args)) => photo::run(&args),
        Some(Verb::Params(args)) => params::run(&args),
        Some(Verb::Check(args)) => check::run(&args),
        Some(Verb::Render(args)) => render::run(&args),
        Some(Verb::Tablets(args)) => tablets::run(&args),
        Some(Verb::Pen(args)) => pen::run(&args),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drawing_or_a_verb_with_options_before_it() {
        let parsed = |line: &str| Cli::try_parse_from(line.split_whitespace());
        assert_eq!(parsed("penstemon a.penstemon").unwrap().file, Some("a.penstemon".into()));
        let judged = parsed("penstemon --verbose check a.glb").unwrap();
        assert!(judged.verbose && judged.file.is_none() && matches!(judged.verb, Some(Verb::Check(_))));
        assert!(parsed("penstemon bulid").is_err());
    }
    use anyhow::anyhow;

    #[test]
    fn a_cause_that_was_quoted_is_not_said_again() {
        let error = anyhow!("no such file").context("plant.obj: no such file").context("--texture");
        assert_eq!(one_line(&error), "--texture: plant.obj: no such file");
    }
}
