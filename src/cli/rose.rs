//! `penstemon grow rose`: a rose from measured form, in one season or through the year frame by frame.

use super::common;
use super::studio::{Outputs, Studio};
use crate::pipeline::{self, Built, Cache, Seed};
use crate::plant::OrganKind;
use crate::species::Species;
use anyhow::{Context, Result};
use std::path::Path;
use std::process::ExitCode;

/// What a rose is made from.
pub(super) struct Bed<'a> {
    /// The species, as it was named.
    pub(super) name: &'a str,
    /// The species.
    pub(super) species: &'a Species,
    /// What `--set` says.
    pub(super) assignments: &'a [String],
    /// Decides everything that is left to chance.
    pub(super) seed: u64,
}

/// Makes the rose and writes it, in so many seasons if asked for.
///
/// # Errors
/// Parameters that cannot be used, an output that cannot be written.
pub(super) fn run(
    bed: &Bed<'_>,
    outputs: &Outputs<'_>,
    frames: Option<u16>,
    stats: bool,
) -> Result<ExitCode> {
    let &Bed { name, species, assignments, seed } = bed;
    let mut cache = Cache::default();
    let mut grown = |season: Option<f32>| -> Result<Built> {
        let mut assignments = assignments.to_vec();
        assignments.extend(season.map(|season| format!("season.time={season}")));
        let params = pipeline::params_of_species(species, &assignments).with_context(|| name.to_owned())?;
        let seed = Seed { number: seed, ..Seed::default() };
        let built = pipeline::build_with(&mut cache, &seed, species, &params, &|| false);
        let built = built.context("nothing stops it")?;
        built.remarks.iter().for_each(|warning| tracing::warn!("{name}: {warning}"));
        Ok(built)
    };
    let built = grown(None)?;
    let mut studio = Studio::new(outputs, &built)?;
    let bytes = match frames {
        None => studio.write(&built, &Path::to_owned)?,
        Some(frames) => {
            let params = pipeline::params_of_species(species, assignments)?;
            let last = common::last_season(species, &params);
            let mut bytes = 0;
            for frame in 1..=frames {
                let season = last * f32::from(frame - 1) / f32::from(frames - 1);
                let named = |out: &Path| common::numbered(out, usize::from(frame));
                bytes += studio.write(&grown(Some(season))?, &named)?;
            }
            bytes
        }
    };
    if stats {
        let mut stats = common::stats(&built.stages, &built.model, bytes);
        let count = |kind| built.plant.organs.iter().filter(|organ| organ.kind() == kind).count();
        stats["branches"] = built.plant.branches.len().into();
        stats["leaves"] = count(OrganKind::Petiole).into();
        stats["leaflets"] = count(OrganKind::Leaf).into();
        stats["flowers"] = built.plant.flowers.len().into();
        common::print(&stats.to_string())?;
    }
    Ok(ExitCode::SUCCESS)
}
