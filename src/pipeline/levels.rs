//! Levels of detail: one plant again and again with fewer triangles, from the same skeleton.
//!
//! A level of many triangles has blades as leaves, one of few has cards; each is then brought to its number by its budget, as larger
//! cards, fewer twigs and fewer sides (`triangle_budget`). The last may be two crossing pictures of the whole plant. A plant is never
//! made finer than it is.
//!
//! Plants of gardens have forms for where they are small in a picture: one that is coarser, and pictures of them from many sides.
//!
//! Limits: what was drawn stays in all levels, so that of a drawing with many strokes small levels are larger than they should be.

use super::finish::Built;
use super::setup::{Params, SetupError, params_of, species_or_usual};
use super::triangle_budget::{self, Finer};
use crate::cards::{self, CardParams};
use crate::garden::{Coarser, Grown, Views};
use crate::model::{self, Model, ModelParams};
use crate::plant::FinishedPlant;
use crate::sketch::Sketch;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// How much of a plant a level has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// So many triangles, give or take three of a hundred, or as many as the plant has if these are fewer.
    Triangles(u32),
    /// Two crossing pictures of the plant.
    Billboards,
}

/// Levels that are known by a name, the finest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LevelSet {
    /// A plant that stands in front: 1,000,000 triangles and fewer.
    Hero,
    /// One of many on a computer: 80,000 and fewer.
    Game,
    /// One of many on a telephone: 15,000 and fewer.
    Mobile,
}

impl LevelSet {
    /// Each of them.
    pub const ALL: [Self; 3] = [Self::Hero, Self::Game, Self::Mobile];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Hero => "hero",
            Self::Game => "game",
            Self::Mobile => "mobile",
        }
    }

    /// Its levels.
    pub fn levels(self) -> Vec<Level> {
        let triangles: &[u32] = match self {
            Self::Hero => &[1_000_000, 200_000, 50_000, 10_000],
            Self::Game => &[80_000, 25_000, 8_000, 2_000],
            Self::Mobile => &[15_000, 4_000, 1_000],
        };
        triangles.iter().copied().map(Level::Triangles).chain([Level::Billboards]).collect()
    }
}

/// Foliage is cards in levels with less than this share of the plant's triangles.
const CARDS_BELOW: f32 = 0.34;
/// Width and height of the pictures of whole plants, pixels.
const BILLBOARD_PIXELS: u32 = 512;

/// Plants that are to have no more triangles than this are far away.
const FEW: u32 = 1000;

/// Triangles of the coarser form that plants of gardens have in pictures. Cards of less are larger than a leaf looks from so far.
const FORM: u32 = 10_000;
/// Triangles that flowers should have for where they are small; they have more at their coarsest.
const FLOWERS: u32 = 2500;
/// A form is worth keeping if it has at most this share of the triangles of the one before it.
const COARSER: f32 = 0.6;
/// So many pixels of the square around a plant need a triangle.
const PIXELS_OF_TRIANGLE: f32 = 4.0;
/// Pictures of plants do up to this width, and are so wide themselves; pixels.
const VIEWS_BELOW: f32 = 100.0;
const VIEW_PIXELS: u32 = 112;

/// The models of a plant's levels, in their order, without those that are the same again because the plant has too few triangles;
/// `whole` is its own.
pub fn levels(plant: &FinishedPlant, whole: &Model, params: &Params, wanted: &[Level]) -> Vec<Model> {
    let mut models = all_levels(plant, whole, params, wanted);
    models.dedup_by_key(|model| model.triangle_count());
    models
}

/// The same for the plant of a drawing, whose species may be a file in `folder`.
///
/// # Errors
/// A species or parameters that cannot be used.
pub fn levels_of_drawing(
    (sketch, folder): (&Sketch, &Path),
    built: &Built,
    set: LevelSet,
) -> Result<Vec<Model>, SetupError> {
    let (species, _) = species_or_usual(sketch, folder)?;
    let params = params_of(sketch, &species, &[])?;
    Ok(levels(&built.plant, &built.model, &params, &set.levels()))
}

/// The model of each level.
fn all_levels(plant: &FinishedPlant, whole: &Model, params: &Params, wanted: &[Level]) -> Vec<Model> {
    let of_whole = whole.triangle_count() as f32;
    let of_level = |level: &Level| match *level {
        Level::Triangles(most) if most as f32 >= of_whole => whole.clone(),
        Level::Triangles(most) => {
            let plant = if (most as f32) < CARDS_BELOW * of_whole {
                let params = CardParams { used: true, ..params.cards.clone() };
                let most = triangle_budget::of_foliage(u64::from(most));
                cards::with_cards(plant.clone(), &params, Some(most))
            } else {
                plant.clone()
            };
            of_budget(plant, params, most)
        }
        Level::Billboards => {
            let flat = cards::billboards(plant, BILLBOARD_PIXELS);
            model::build(&flat, &params.model)
        }
    };
    wanted.iter().map(of_level).collect()
}

/// A plant of at most about so many triangles.
fn of_budget(plant: FinishedPlant, params: &Params, most: u32) -> Model {
    let (plant, model) =
        triangle_budget::fit(plant, &params.model, (u64::from(most), Finer::Never), &|| false);
    model::build(&plant, &model)
}

/// A plant with so many triangles; if these are few and it does not come down to them, two crossing pictures of it.
pub(super) fn for_garden(plant: &FinishedPlant, whole: &Model, params: &Params, triangles: u32) -> Model {
    let made = |level| all_levels(plant, whole, params, &[level]).pop().unwrap_or_default();
    let model = made(Level::Triangles(triangles));
    let is_too_fine = triangles <= FEW && model.triangle_count() > 2 * triangles as usize;
    if is_too_fine { made(Level::Billboards) } else { model }
}

/// A plant with coarser forms beside its model, for where it is small in a picture.
pub(super) fn in_forms(plant: &FinishedPlant, model: Model, params: &Params) -> Grown {
    let (coarser, views) = rayon::join(|| coarser(plant, &model, params), || views(&model));
    Grown { model, coarser: coarser.into_iter().collect(), views, remarks: Vec::new() }
}

/// A coarser form of a plant of which `finest` is the model; none of one that has few triangles as it is.
fn coarser(plant: &FinishedPlant, finest: &Model, params: &Params) -> Option<Coarser<Model>> {
    let most = (COARSER * finest.triangle_count() as f32) as usize;
    if most < FLOWERS as usize {
        return None;
    }
    let form = if triangle_budget::has_large_flowers(plant) {
        // Nobody plants roses for their leaves: what loses no flower does until pictures do.
        let coarse = triangle_budget::coarsened(plant, &params.model, u64::from(FLOWERS));
        model::build(plant, &coarse)
    } else if most < FORM as usize {
        return None;
    } else {
        all_levels(plant, finest, params, &[Level::Triangles(FORM)]).pop()?
    };
    let triangles = form.triangle_count();
    let is_worth_it = triangles > 0 && triangles <= most;
    is_worth_it.then(|| Coarser { form, pixels: (PIXELS_OF_TRIANGLE * triangles as f32).sqrt() })
}

/// Pictures of a model from many sides, for where it is smaller still.
pub(super) fn views(model: &Model) -> Views<Model> {
    let views = cards::views(model, VIEW_PIXELS).into_iter();
    let forms = views.map(|view| (view.toward, model::build(&view.flat, &ModelParams::default())));
    Views { forms: forms.collect(), pixels: VIEWS_BELOW }
}

#[cfg(test)]
mod tests {
    use super::super::{Seed, build, params_of_species};
    use super::*;
    use crate::species::Species;

    #[test]
    fn each_level_has_its_number_of_triangles() {
        let species = Species::built_in("oak").unwrap();
        let params = params_of_species(&species, &[]).unwrap();
        let built = build(&Seed { number: 1, age: Some(14.0), ..Seed::default() }, &species, &params);
        let wanted = [
            Level::Triangles(10_000_000),
            Level::Triangles(20_000),
            Level::Triangles(5_000),
            Level::Billboards,
        ];
        let levels = levels(&built.plant, &built.model, &params, &wanted);
        let counts: Vec<usize> = levels.iter().map(Model::triangle_count).collect();
        assert_eq!((counts[0], counts[3]), (built.model.triangle_count(), 8), "{counts:?}");
        assert!((19_400..=20_600).contains(&counts[1]) && (4_850..=5_150).contains(&counts[2]), "{counts:?}");
        for model in &levels {
            assert_eq!(model.check_invariants(), Ok(()));
        }
        let (low, high) = built.model.bounds().unwrap();
        let (flat_low, flat_high) = levels[3].bounds().unwrap();
        assert!(
            (flat_high.y - high.y).abs() < 0.1 * (high.y - low.y)
                && (flat_low.y - low.y).abs() < 0.1 * (high.y - low.y)
        );
    }
}
