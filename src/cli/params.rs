//! `penstemon params [SPECIES|SKETCH]`: every parameter that `--set` can change, as a list.

use super::common::{self, Setup, SetupOptions};
use crate::params::{Description, Kind, Parameters as _};
use crate::pipeline::{self, Params};
use crate::species::Species;
use anyhow::Context;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Arguments of `params`.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// A drawing (.penstemon, .json, .svg), or a species by name or by the path of its .toml file: the values are its own.
    /// Left out, they are those of no species in particular.
    pub of: Option<PathBuf>,
    /// Print one JSON array instead of text.
    #[arg(long)]
    pub json: bool,
}

/// Runs `params`.
///
/// # Errors
/// A drawing or species that cannot be used.
pub fn run(args: &Args) -> anyhow::Result<ExitCode> {
    let params = match &args.of {
        None => Params::of_any_species(),
        Some(path) => params_of(path)?,
    };
    // What changes with age is given for a plant as old as its species' usually are.
    let all = params.describe_at(params.habit.age as f32);
    let text = if args.json {
        serde_json::to_string_pretty(&all.iter().map(object).collect::<Vec<_>>())?
    } else {
        all.iter().map(line).collect::<Vec<_>>().join("\n")
    };
    common::print(&text)?;
    Ok(ExitCode::SUCCESS)
}

fn params_of(path: &Path) -> anyhow::Result<Params> {
    let is = |ending: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(ending));
    if ["penstemon", "json", "svg"].into_iter().any(is) {
        let options = SetupOptions {
            species: None,
            seed: None,
            assignments: common::Assignments::default(),
            textures: Vec::new(),
        };
        return Ok(Setup::open(path, &options)?.params);
    }
    let species = match is("toml") {
        true => Species::read(path)?,
        false => Species::built_in(&path.to_string_lossy())?,
    };
    pipeline::params_of_species(&species, &[]).with_context(|| path.display().to_string())
}

/// A number as short as it is read back.
fn number(value: f64) -> String {
    (value as f32).to_string()
}

fn is_on(value: f64) -> bool {
    value > 0.5
}

/// A parameter as a line of text.
pub(super) fn line(of: &Description) -> String {
    let Description { path, help, kind, unit, min, max, default } = of;
    let (value, range) = match kind {
        Kind::Switch => (kind.written(*default), "true or false".to_owned()),
        Kind::Choice(names) => (kind.written(*default), names.join(", ")),
        _ => (number(*default), format!("{} to {}", number(*min), number(*max))),
    };
    let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    format!("{path} = {value}{unit} ({range}): {help}")
}

fn object(of: &Description) -> Value {
    let Description { path, help, kind, unit, min, max, default } = of;
    let short = |value: f64| number(value).parse().unwrap_or(value);
    let (kind, value) = match kind {
        Kind::Choice(names) => {
            let value = kind.written(*default);
            return json!({ "path": path, "kind": "name", "value": value, "names": names, "meaning": help });
        }
        Kind::Switch => ("switch", json!(is_on(*default))),
        Kind::Whole => ("whole number", json!(*default as u64)),
        Kind::Number => ("number", json!(short(*default))),
        Kind::Aged => ("number that may change with age", json!(short(*default))),
    };
    json!({
        "path": path, "kind": kind, "value": value, "unit": unit, "min": short(*min), "max": short(*max), "meaning": help,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_parameter_has_a_line_with_its_value_range_and_meaning() {
        let params = params_of(Path::new("oak")).unwrap();
        let all = params.describe();
        let lines: Vec<String> = all.iter().map(line).collect();
        assert!(all.len() > 100 && all.iter().any(|d| d.path == "habit.lambda"));
        let of = |path: &str| lines.iter().find(|line| line.starts_with(&format!("{path} = "))).unwrap();
        assert!(of("model.tube.joined").contains("= true (true or false): Branches grow out of"));
        assert!(of("depth.world.height").contains(" metres (0.001 to 200): What the height"));
        assert!(of("habit.fineness").contains(" (0.2 to 4): "));
        assert!(of("habit.control").contains("= borchert_honda (borchert_honda, priority): Model by which"));
        for (of, line) in all.iter().zip(&lines) {
            assert!(!line.contains('\n') && !of.help.is_empty(), "{line}");
        }
    }

    #[test]
    fn what_is_listed_can_be_set() {
        let species = Species::built_in("cherry").unwrap();
        for of in Params::of_species(&species).describe() {
            let value = &object(&of)["value"];
            let value = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
            let set = format!("{}={value}", of.path);
            pipeline::params_of_species(&species, std::slice::from_ref(&set))
                .unwrap_or_else(|e| panic!("{set}: {e}"));
        }
    }
}
