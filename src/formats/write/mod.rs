//! Finished models to files: one trait, one file per format.
//!
//! An [`Exporter`] makes the bytes in memory, [`export`] also writes them ([`crate::atomic`]: whole or not at all,
//! companions such as MTL and pictures first). Same model, same bytes.

pub mod error;
pub mod exporter;
pub mod glb;
mod gltf_buffer;
mod gltf_instances;
mod gltf_levels;
mod gltf_materials;
mod gltf_tree;
pub mod image_files;
pub mod mtl;
mod names;
pub mod obj;
pub mod plant_json;
pub mod scene;
mod tangents;
mod tint;

pub use error::ExportError;
pub use exporter::{Encoded, Exporter, Takes};
pub use image_files::ImageFiles;
pub use scene::{InstanceForm, PlantAndProvenance, Scene};

use crate::atomic::WriteError;
use crate::file_system::System;
use crate::formats::textures::{self, BuiltInTextures};
use crate::garden::Garden;
use crate::input::Sources;
use crate::model::{InstancedModel, Model};
use std::borrow::Cow;
use std::cell::OnceCell;
use std::path::{Path, PathBuf};

/// Every format, in the order in which help lists them.
pub const FORMATS: [&dyn Exporter; 3] = [&obj::Obj, &glb::Glb, &plant_json::PlantJson];

/// The format that a file's extension asks for, in upper or lower case.
///
/// # Errors
/// [`ExportError::UnknownFormat`], listing the known ones.
pub fn format_of(path: &Path) -> Result<&'static dyn Exporter, ExportError> {
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    let wanted = FORMATS.into_iter().find(|format| extension.as_deref() == Some(format.extension()));
    wanted.ok_or_else(|| ExportError::UnknownFormat {
        path: path.to_owned(),
        extension,
        known: FORMATS.iter().map(|format| format.extension()).collect(),
    })
}

/// A model in a format with all its files, not yet written.
#[derive(Debug)]
pub struct Prepared {
    /// Companions first, the file that was asked for last.
    files: Vec<(PathBuf, Cow<'static, [u8]>)>,
}

impl Prepared {
    /// Where its files will be.
    pub fn paths(&self) -> impl Iterator<Item = &Path> {
        self.files.iter().map(|(path, _)| path.as_path())
    }

    /// Writes its files, whole or not at all, and returns the number of bytes of all together.
    ///
    /// # Errors
    /// [`WriteError`]; nothing is left half written.
    pub fn write(&self) -> Result<usize, WriteError> {
        let files: Vec<(PathBuf, &[u8])> =
            self.files.iter().map(|(path, bytes)| (path.clone(), bytes.as_ref())).collect();
        crate::atomic::write_group_atomically(&System, &files)?;
        Ok(files.iter().map(|(_, bytes)| bytes.len()).sum())
    }
}

fn stem(path: &Path) -> Cow<'_, str> {
    path.file_stem().unwrap_or_default().to_string_lossy()
}

fn encode(path: &Path, format: &dyn Exporter, scene: &Scene<'_>) -> Result<Prepared, ExportError> {
    let Encoded { bytes, companions } = format.encode(scene)?;
    let beside = companions.into_iter().map(|(name, bytes)| (path.with_file_name(name), bytes));
    Ok(Prepared { files: beside.chain([(path.to_owned(), bytes.into())]).collect() })
}

/// The surfaces that are written.
#[derive(Clone, Copy, Debug)]
pub struct Surfaces<'a> {
    /// Those of the plant.
    pub model: &'a Model,
    /// As in [`Scene`] for a model that holds several levels of detail of one plant; empty for one level. Formats other than glTF have no
    /// word for levels and write all of them as plants.
    pub level_of_specimen: &'a [usize],
    /// The garden around it. Its plants stay copies of few shapes in the formats that can say so.
    pub garden: Option<&'a Garden>,
}

impl<'a> From<&'a Model> for Surfaces<'a> {
    fn from(model: &'a Model) -> Self {
        Self { model, level_of_specimen: &[], garden: None }
    }
}

impl<'a> Surfaces<'a> {
    /// All triangles by themselves.
    fn flat(&self) -> Cow<'a, Model> {
        let Some(garden) = self.garden else { return self.model.flattened() };
        let mut all = self.model.clone();
        garden.join(&mut all);
        Cow::Owned(all.flattened().into_owned())
    }

    /// With copies of one shape: the garden's plants, and the plant's own organs where these are wanted.
    fn copies(&self, of_organs: bool) -> InstancedModel {
        let mut all = match of_organs {
            true => InstancedModel::from(self.model),
            false => InstancedModel { model: self.model.flattened().into_owned(), groups: Vec::new() },
        };
        self.garden.iter().for_each(|garden| garden.join_instanced(&mut all));
        all
    }
}

/// Writes surfaces in several formats, and returns the number of bytes of all files together. All are encoded before the
/// first is written, and nothing is written if any of their files is one of the `sources` or a picture of the model.
/// Where a form of `instances` is given, copies of one shape stay copies in the formats that can say so.
///
/// # Errors
/// [`ExportError`]; no file is left half written.
pub fn export_all<'a>(
    paths: &[PathBuf],
    surfaces: impl Into<Surfaces<'a>>,
    plant: PlantAndProvenance<'_>,
    built_in: &BuiltInTextures<'_>,
    instances: Option<InstanceForm>,
    sources: &Sources,
) -> Result<usize, ExportError> {
    let surfaces = surfaces.into();
    let Surfaces { model, level_of_specimen, garden } = surfaces;
    model.check_invariants().map_err(ExportError::Unsound)?;
    let (flat, instanced, no_surfaces) = (OnceCell::new(), OnceCell::new(), Model::default());
    let form = instances.or(garden.map(|_| InstanceForm::Nodes));
    let prepare = |path: &PathBuf| -> Result<Prepared, ExportError> {
        let format = format_of(path)?;
        let scene = |model| Scene::new(model, plant, built_in, stem(path));
        let scene = match (format.takes(), form) {
            (Takes::Plant, _) => scene(&no_surfaces)?,
            (Takes::Copies, Some(form)) => {
                let InstancedModel { model, groups } =
                    instanced.get_or_init(|| surfaces.copies(instances.is_some()));
                scene(model)?.with_instances(groups, form)?
            }
            (Takes::Copies | Takes::Triangles, _) => scene(flat.get_or_init(|| surfaces.flat()))?,
        };
        encode(path, format, &Scene { level_of_specimen, ..scene })
    };
    let prepared = paths.iter().map(prepare).collect::<Result<_, _>>()?;
    write_all(prepared, model, sources)
}

/// Writes what has been encoded, if it replaces none of the sources.
fn write_all(prepared: Vec<Prepared>, model: &Model, sources: &Sources) -> Result<usize, ExportError> {
    let mut sources = sources.clone();
    textures::files(&model.materials).for_each(|picture| sources.add(picture));
    sources.spare(prepared.iter().flat_map(Prepared::paths))?;
    prepared.iter().try_fold(0, |bytes, prepared| Ok(bytes + prepared.write()?))
}

/// Writes a model whose copies stand apart from it as GLB, and returns the number of bytes; not if the file is one of the `sources`
/// or a picture of the model.
///
/// # Errors
/// [`ExportError`]; no file is left half written.
pub fn export_instanced(
    path: &Path,
    (InstancedModel { model, groups }, form): (&InstancedModel, InstanceForm),
    plant: PlantAndProvenance<'_>,
    built_in: &BuiltInTextures<'_>,
    sources: &Sources,
) -> Result<usize, ExportError> {
    let scene = Scene::new(model, plant, built_in, stem(path))?.with_instances(groups, form)?;
    write_all(vec![encode(path, &glb::Glb, &scene)?], model, sources)
}

/// Writes a model as [`export_all`] does, in one format and from no other files than its pictures.
///
/// # Errors
/// [`ExportError`]; nothing is left half written.
pub fn export(
    path: &Path,
    model: &Model,
    plant: PlantAndProvenance<'_>,
    built_in: &BuiltInTextures<'_>,
) -> Result<usize, ExportError> {
    export_all(&[path.to_owned()], model, plant, built_in, None, &Sources::default())
}
