//! `--lod`: the levels of detail of a plant, in one GLB file or in a file each.

use super::common::{self, Instances};
use super::studio::is_picture;
use crate::formats::write;
use crate::input::Sources;
use crate::model::capsules::capsules;
use crate::model::{Levels, Model};
use crate::pipeline::{Built, Level, LevelSet, Params, levels};
use anyhow::{Result, ensure};
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Most levels.
const MOST: usize = 8;

/// The levels that are asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lod(Vec<Level>);

impl FromStr for Lod {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if let Some(known) = LevelSet::ALL.into_iter().find(|set| set.name() == text) {
            return Ok(Self(known.levels()));
        }
        let level = |word: &str| {
            match (word.trim(), word.trim().parse()) {
            ("billboards", _) => Ok(Level::Billboards),
            (_, Ok(count @ 100..=10_000_000)) => Ok(Level::Triangles(count)),
            _ => Err("write hero, game, mobile, or numbers of triangles from 100 to 10000000, the largest first, with \
                      commas between them; the last may be `billboards`"
                .to_owned()),
        }
        };
        let levels = text.split(',').map(level).collect::<Result<Vec<_>, _>>()?;
        let falls = |pair: &[Level]| match pair {
            [Level::Triangles(more), Level::Triangles(fewer)] => more > fewer,
            [first, _] => *first != Level::Billboards,
            _ => true,
        };
        if !levels.windows(2).all(falls) {
            return Err(
                "each level has fewer triangles than the one before it; `billboards` is the last".to_owned()
            );
        }
        if !(2..=MOST).contains(&levels.len()) {
            return Err(format!("write 2 to {MOST} levels"));
        }
        Ok(Self(levels))
    }
}

/// Writes the levels of a plant: GLB files hold all of them, of other formats each level has a file. Returns the number of bytes
/// and the triangles of each level.
///
/// # Errors
/// A file that cannot be written, one that is no model.
pub(super) fn export(
    outs: &[PathBuf],
    (built, params): (&Built, &Params),
    (lod, with_capsules): (&Lod, bool),
    instances: Option<Instances>,
    sources: &Sources,
) -> Result<(usize, Vec<usize>)> {
    for out in outs {
        let is_model = !is_picture(out) && write::format_of(out)?.extension() != "json";
        ensure!(is_model, "{}: levels of detail are models; write .glb or .obj", out.display());
    }
    let mut models = levels(&built.plant, &built.model, params, &lod.0);
    let wanted = lod.0.len();
    if models.len() < wanted {
        tracing::warn!(
            "{} of {wanted} levels are left out: the plant has fewer triangles",
            wanted - models.len()
        );
    }
    let counts = models.iter().map(Model::triangle_count).collect();
    let (whole, apart): (Vec<PathBuf>, Vec<PathBuf>) = outs.iter().cloned().partition(|out| is_glb(out));
    let plant = (&built.plant, &built.provenance);
    let mut bytes = 0;
    let capsules = if with_capsules { capsules(&built.plant) } else { Vec::new() };
    if with_capsules && capsules.is_empty() {
        tracing::warn!("--capsules: the plant has no wood, so it has no capsules");
    }
    if !whole.is_empty() {
        let mut levels = Levels::of(models.iter().cloned());
        levels.model.add_capsules(&capsules);
        bytes += common::export_levels(&whole, (plant, &levels), instances, sources)?;
    }
    if let Some(finest) = models.first_mut() {
        finest.add_capsules(&capsules);
    }
    for (level, model) in models.iter().enumerate().filter(|_| !apart.is_empty()) {
        let named: Vec<PathBuf> = apart.iter().map(|out| of_level(out, level)).collect();
        bytes += common::export(&named, (plant, model.into()), None, sources)?;
    }
    Ok((bytes, counts))
}

fn is_glb(out: &Path) -> bool {
    out.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("glb"))
}

/// `oak.obj` becomes `oak_LOD1.obj`.
fn of_level(out: &Path, level: usize) -> PathBuf {
    let stem = out.file_stem().unwrap_or_default().to_string_lossy();
    let ending = out.extension().unwrap_or_default().to_string_lossy();
    out.with_file_name(format!("{stem}_LOD{level}.{ending}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_named_or_counted() {
        let game: Lod = "game".parse().unwrap();
        assert_eq!(game.0.len(), 5);
        let counted: Lod = "30000, 5000,billboards".parse().unwrap();
        assert_eq!(counted.0, [Level::Triangles(30_000), Level::Triangles(5_000), Level::Billboards]);
        for (text, word) in [
            ("gamer", "write hero"),
            ("5000,30000", "fewer"),
            ("billboards,500", "last"),
            ("500", "2 to 8"),
            ("50,20", "100 to"),
            ("", "write hero"),
        ] {
            assert!(text.parse::<Lod>().unwrap_err().contains(word), "{text}");
        }
    }

    #[test]
    fn files_of_levels_have_their_numbers() {
        assert_eq!(of_level(Path::new("a/oak.obj"), 2), Path::new("a/oak_LOD2.obj"));
    }
}
