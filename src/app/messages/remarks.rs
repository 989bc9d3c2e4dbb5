//! What is odd about a drawing, in the language of the interface. Every kind has words; the English ones are those of
//! [`Remark`]. What parsers of paths and transforms say stays English.

use super::{Localize, Messages, Msg, Named};
use crate::sketch::Reading;
use crate::sketch::remark::{Element, Remark, Warning};

impl Localize for Warning {
    fn localize(&self, messages: &Messages) -> String {
        let remark = self.remark.localize(messages);
        match self.stroke {
            Some(id) => messages.fill(Msg::WarningStroke, &[("id", &id), ("remark", &remark)]),
            None => remark,
        }
    }
}

impl Localize for Remark {
    fn localize(&self, messages: &Messages) -> String {
        let fill = |msg, values: &[(&str, &dyn std::fmt::Display)]| messages.fill(msg, values);
        let one = |msg, name, value: &dyn std::fmt::Display| messages.fill(msg, &[(name, value)]);
        let about = |msg, element: &Element, reason: &str| {
            fill(msg, &[("element", &element.localize(messages)), ("reason", &reason)])
        };
        match self {
            Self::NoPoints { place } => fill(Msg::WarningNoPoints, &[("place", place)]),
            Self::PressureOutside { points } => fill(Msg::WarningPressure, &[("count", points)]),
            Self::TiltOutside { points } => fill(Msg::WarningTilt, &[("count", points)]),
            Self::TimeOutside { points } => fill(Msg::WarningTime, &[("count", points)]),
            Self::NoLines { count, element } => {
                fill(Msg::WarningNoLines, &[("count", count), ("element", element)])
            }
            Self::Transform { element, reason } => about(Msg::WarningTransform, element, reason),
            Self::LeadsNowhere { element } => about(Msg::WarningLeadsNowhere, element, ""),
            Self::CutShort { element, reason } => about(Msg::WarningCutShort, element, reason),
            Self::PressureUnfit { element } => about(Msg::WarningPressureUnfit, element, ""),
            Self::Page { attribute, value } => {
                fill(Msg::WarningPage, &[("attribute", attribute), ("value", value)])
            }
            Self::PictureMissing { name, parts: _ } => fill(Msg::WarningPictureMissing, &[("name", name)]),
            Self::PictureDamaged { reason, parts: _ } => one(Msg::WarningPictureDamaged, "reason", reason),
            Self::SpeciesMissing { name } => one(Msg::WarningSpeciesMissing, "name", name),
            Self::TooShort => fill(Msg::WarningTooShort, &[]),
            Self::EnclosesNothing => fill(Msg::WarningEnclosesNothing, &[]),
            Self::ReadAs(reading) => fill(words_of(*reading), &[]),
            Self::FlowerCentre => fill(Msg::WarningFlowerCentre, &[]),
            Self::StandsApart => fill(Msg::WarningStandsApart, &[]),
            Self::FewTwigs => fill(Msg::WarningFewTwigs, &[]),
            Self::FilledThinly => fill(Msg::WarningFilledThinly, &[]),
            Self::NoBranch => fill(Msg::WarningNoBranch, &[]),
            Self::NoRoom => fill(Msg::WarningNoRoom, &[]),
            Self::EmptyCrown => fill(Msg::WarningEmptyCrown, &[]),
            Self::ManyCrowns { most } => fill(Msg::WarningManyCrowns, &[("most", most)]),
            Self::DoesNotGrow { species, known } => {
                let species = messages.name(Named::Species, species);
                fill(Msg::WarningDoesNotGrow, &[("species", &species), ("known", &names_of(known, messages))])
            }
            Self::BrushOutOfReach => fill(Msg::WarningBrushOutOfReach, &[]),
            Self::BrushCutsNothing => fill(Msg::WarningBrushCutsNothing, &[]),
            Self::PaintsNoMore { most } => fill(Msg::WarningPaintsNoMore, &[("most", most)]),
            Self::NoFlowerToPaint => fill(Msg::WarningNoFlowerToPaint, &[]),
            Self::LightsNothing => fill(Msg::WarningLightsNothing, &[]),
            Self::PosesRest { poses } => fill(Msg::WarningPosesRest, &[("count", poses)]),
            Self::GrowthCapped { internodes } => one(Msg::WarningGrowthCapped, "internodes", internodes),
            Self::GrownTooLarge { years } => fill(Msg::WarningGrownTooLarge, &[("count", years)]),
            Self::GrowthTooCostly { years } => fill(Msg::WarningGrowthTooCostly, &[("count", years)]),
            Self::LeavesThinned { leaves } => fill(Msg::WarningLeavesThinned, &[("leaves", leaves)]),
            Self::GrammarStopped { fault } => fill(Msg::WarningGrammarStopped, &[("fault", fault)]),
            Self::BlossomThinned { flowers } => fill(Msg::WarningBlossomThinned, &[("flowers", flowers)]),
            Self::FoliageAsCards { triangles } => one(Msg::WarningFoliageAsCards, "triangles", triangles),
            Self::BudgetMissed { triangles, wanted } => {
                fill(Msg::WarningBudgetMissed, &[("triangles", triangles), ("wanted", wanted)])
            }
            Self::Coarser { triangles } => fill(Msg::WarningCoarser, &[("triangles", triangles)]),
            Self::ThinsCrown => fill(Msg::WarningThinsCrown, &[]),
            Self::FinenessUnused => fill(Msg::WarningFineness, &[]),
            Self::LooksLike { species } => {
                one(Msg::WarningLooksLike, "species", &names_of(species, messages))
            }
            Self::NoSuchPlant { known } => one(Msg::WarningNoSuchPlant, "known", &names_of(known, messages)),
            Self::NoSuchPlantInGarden { species, known } => no_bed(species, known, messages),
            Self::NothingToPlant { drawing } => nothing_to_plant(drawing.as_deref(), messages),
            Self::GardenThinned { plants } => fill(Msg::WarningGardenThinned, &[("plants", plants)]),
            Self::PlantOutOfScale => fill(Msg::WarningPlantOutOfScale, &[]),
            Self::OfPlant { place, species, remark } => of_plant((*place, species), remark, messages),
            Self::More { count } => fill(Msg::WarningMore, &[("count", count)]),
        }
    }
}

/// A remark about a plant beside the drawn one.
fn of_plant((place, species): (usize, &str), remark: &Remark, messages: &Messages) -> String {
    let (species, remark) = (messages.name(Named::Species, species), remark.localize(messages));
    messages.fill(Msg::WarningOfPlant, &[("place", &place), ("species", &species), ("remark", &remark)])
}

/// The species of a list by the names under which the window offers them.
fn names_of(species: &str, messages: &Messages) -> String {
    let names = species.split(", ").map(|species| messages.name(Named::Species, species));
    names.collect::<Vec<String>>().join(", ")
}

/// That no bed is of a species.
fn no_bed(species: &str, known: &str, messages: &Messages) -> String {
    let (species, known) = (names_of(species, messages), names_of(known, messages));
    messages.fill(Msg::WarningNoSuchPlantInGarden, &[("species", &species), ("known", &known)])
}

/// That beds are of a plant that there is not.
fn nothing_to_plant(drawing: Option<&str>, messages: &Messages) -> String {
    match drawing {
        None => messages.get(Msg::WarningNothingToPlant).to_owned(),
        Some(drawing) => messages.fill(Msg::WarningNothingToPlantOf, &[("drawing", &drawing)]),
    }
}

fn words_of(reading: Reading) -> Msg {
    match reading {
        Reading::Tree => Msg::ReadAsTree,
        Reading::BareTree => Msg::ReadAsBareTree,
        Reading::Bush => Msg::ReadAsBush,
        Reading::Cactus => Msg::ReadAsCactus,
        Reading::Mushroom => Msg::ReadAsMushroom,
        Reading::Corolla => Msg::ReadAsCorolla,
        Reading::Leaf => Msg::ReadAsLeaf,
        Reading::Grass => Msg::ReadAsGrass,
        Reading::Fronds => Msg::ReadAsFronds,
        Reading::Fruit => Msg::ReadAsFruit,
        Reading::Pot => Msg::ReadAsPot,
        Reading::Ground => Msg::ReadAsGround,
        Reading::Sun => Msg::ReadAsSun,
        Reading::Frame => Msg::ReadAsFrame,
        Reading::Sky => Msg::ReadAsSky,
        Reading::Writing => Msg::ReadAsWriting,
        Reading::Line => Msg::ReadAsLine,
    }
}

impl Localize for Element {
    fn localize(&self, messages: &Messages) -> String {
        match self.id {
            Some(_) => self.to_string(),
            None => messages.fill(Msg::WarningElement, &[("name", &self.name)]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::messages::Language;

    /// A remark of the kind after this one's, until there is no other: a kind without a place here does not compile.
    fn next(remark: &Remark) -> Option<Remark> {
        let element = |id: Option<&str>| Element { name: "path".to_owned(), id: id.map(str::to_owned) };
        let reason = || "7".to_owned();
        let (daisy, oak) = (|| "daisy".to_owned(), || "oak".to_owned());
        Some(match remark {
            Remark::NoPoints { .. } => Remark::PressureOutside { points: 41 },
            Remark::PressureOutside { .. } => Remark::TiltOutside { points: 42 },
            Remark::TiltOutside { .. } => Remark::TimeOutside { points: 43 },
            Remark::TimeOutside { .. } => Remark::NoLines { count: 44, element: "rect" },
            Remark::NoLines { .. } => Remark::Transform { element: element(Some("45")), reason: reason() },
            Remark::Transform { .. } => Remark::LeadsNowhere { element: element(None) },
            Remark::LeadsNowhere { .. } => {
                Remark::CutShort { element: element(Some("46")), reason: reason() }
            }
            Remark::CutShort { .. } => Remark::PressureUnfit { element: element(Some("47")) },
            Remark::PressureUnfit { .. } => Remark::Page { attribute: "width", value: "48".to_owned() },
            Remark::Page { .. } => Remark::PictureMissing { name: "56".to_owned(), parts: Vec::new() },
            Remark::PictureMissing { .. } => {
                Remark::PictureDamaged { reason: "57".to_owned(), parts: Vec::new() }
            }
            Remark::PictureDamaged { .. } => Remark::SpeciesMissing { name: "58".to_owned() },
            Remark::SpeciesMissing { .. } => Remark::TooShort,
            Remark::TooShort => Remark::EnclosesNothing,
            Remark::EnclosesNothing => Remark::ReadAs(Reading::ALL[0]),
            Remark::ReadAs(reading) => {
                let next = Reading::ALL.iter().skip_while(|known| *known != reading).nth(1);
                next.map_or(Remark::FlowerCentre, |next| Remark::ReadAs(*next))
            }
            Remark::FlowerCentre => Remark::StandsApart,
            Remark::StandsApart => Remark::FewTwigs,
            Remark::FewTwigs => Remark::FilledThinly,
            Remark::FilledThinly => Remark::NoBranch,
            Remark::NoBranch => Remark::NoRoom,
            Remark::NoRoom => Remark::EmptyCrown,
            Remark::EmptyCrown => Remark::ManyCrowns { most: 52 },
            Remark::ManyCrowns { .. } => Remark::DoesNotGrow { species: daisy(), known: oak() },
            Remark::DoesNotGrow { .. } => Remark::BrushOutOfReach,
            Remark::BrushOutOfReach => Remark::NoFlowerToPaint,
            Remark::NoFlowerToPaint => Remark::PaintsNoMore { most: 6000 },
            Remark::PaintsNoMore { .. } => Remark::BrushCutsNothing,
            Remark::BrushCutsNothing => Remark::LightsNothing,
            Remark::LightsNothing => Remark::PosesRest { poses: 3 },
            Remark::PosesRest { .. } => Remark::GrowthCapped { internodes: 50 },
            Remark::GrowthCapped { .. } => Remark::GrownTooLarge { years: 51 },
            Remark::GrownTooLarge { .. } => Remark::GrowthTooCostly { years: 54 },
            Remark::GrowthTooCostly { .. } => Remark::LeavesThinned { leaves: 53 },
            Remark::LeavesThinned { .. } => Remark::BlossomThinned { flowers: 55 },
            Remark::BlossomThinned { .. } => Remark::GrammarStopped { fault: "line 61".to_owned() },
            Remark::GrammarStopped { .. } => Remark::FoliageAsCards { triangles: 57 },
            Remark::FoliageAsCards { .. } => Remark::BudgetMissed { triangles: 59, wanted: 58 },
            Remark::BudgetMissed { .. } => Remark::Coarser { triangles: 56 },
            Remark::Coarser { .. } => Remark::ThinsCrown,
            Remark::ThinsCrown => Remark::FinenessUnused,
            Remark::FinenessUnused => Remark::LooksLike { species: oak() },
            Remark::LooksLike { .. } => Remark::NoSuchPlant { known: oak() },
            Remark::NoSuchPlant { .. } => Remark::NoSuchPlantInGarden { species: daisy(), known: oak() },
            Remark::NoSuchPlantInGarden { .. } => Remark::NothingToPlant { drawing: None },
            Remark::NothingToPlant { drawing: None } => {
                Remark::NothingToPlant { drawing: Some("shrub".to_owned()) }
            }
            Remark::NothingToPlant { .. } => Remark::GardenThinned { plants: 62 },
            Remark::GardenThinned { .. } => Remark::PlantOutOfScale,
            Remark::PlantOutOfScale => {
                let remark = Box::new(Remark::GrownTooLarge { years: 60 });
                Remark::OfPlant { place: 59, species: oak(), remark }
            }
            Remark::OfPlant { .. } => Remark::More { count: 49 },
            Remark::More { .. } => return None,
        })
    }

    fn every_kind() -> Vec<Warning> {
        let all = std::iter::successors(Some(Remark::NoPoints { place: 40 }), next);
        all.zip((1..).map(|id| (id % 2 == 0).then_some(id)))
            .map(|(remark, stroke)| Warning { stroke, remark })
            .collect()
    }

    #[test]
    fn the_english_words_are_those_of_the_remarks() {
        let english = Messages::new(Language::English);
        for warning in every_kind() {
            let words = match &warning.remark {
                // Files and the command line name species otherwise than the window.
                Remark::DoesNotGrow { .. } | Remark::NoSuchPlantInGarden { .. } => {
                    warning.to_string().replace("`daisy`", "`Daisy`").replace("oak", "Oak")
                }
                Remark::NoSuchPlant { .. } | Remark::OfPlant { .. } | Remark::LooksLike { .. } => {
                    warning.to_string().replace("oak", "Oak")
                }
                _ => warning.to_string(),
            };
            assert_eq!(warning.localize(&english), words);
        }
        let one = [
            Remark::PressureOutside { points: 1 },
            Remark::GrownTooLarge { years: 1 },
            Remark::GrowthTooCostly { years: 1 },
            Remark::More { count: 1 },
        ];
        for remark in one {
            assert_eq!(remark.localize(&english), remark.to_string());
            assert!(!remark.to_string().contains("1 points") && !remark.to_string().contains("1 years"));
        }
    }

    #[test]
    fn every_kind_is_translated_into_chinese_with_its_numbers() {
        let chinese = Messages::new(Language::Chinese);
        for warning in every_kind() {
            let (text, words) = (warning.localize(&chinese), warning.to_string());
            assert!(text.chars().filter(|c| *c > '\u{4e00}').count() >= 4, "{text}");
            assert!(!text.contains('{') && text.chars().last().is_some_and(|c| c != '：'), "{text}");
            let numbers = |text: &str| {
                let mut found: Vec<String> = text
                    .replace("1e9", "10")
                    .split(|c: char| !c.is_ascii_digit())
                    .filter(|number| !number.is_empty())
                    .map(str::to_owned)
                    .collect();
                found.sort();
                found
            };
            assert_eq!(numbers(&text), numbers(&words), "{text}");
        }
    }
}
