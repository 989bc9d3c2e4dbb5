//! The plants beside the drawn one: chosen from pictures, listed, selected, changed and taken away.

use super::stage::{ROLES, Stage, asked, busy, drag, press, stage};
use egui::vec2;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use penstemon::app::action::Action;
use penstemon::app::messages::Language;
use penstemon::app::panels::Snapshot;
use penstemon::app::panels::snapshot::{BesideState, Dialog, PlantState};
use penstemon::sketch::{Maker, PlacedPlant, SeedOf};

/// A birch of seven years and a hazel of its usual age, on a sheet of 1000 by 800.
pub(super) fn garden(selected: Option<usize>) -> Snapshot {
    let plant = |species: &str, age: Option<f32>, x: f32, height: Option<f32>| PlantState {
        plant: PlacedPlant {
            maker: Maker::Growth(SeedOf { species: species.to_owned(), seed: 4, age }),
            foot: [x, 780.0].into(),
            height,
        },
        age: age.unwrap_or(12.0),
        most_age: 30.0,
        height: height.or(Some(200.0)),
    };
    let plants = vec![plant("birch", Some(7.0), 100.0, Some(600.0)), plant("hazel", None, 500.0, None)];
    Snapshot { beside: BesideState { plants, selected, sheet: [1000.0, 800.0] }, ..busy() }
}

/// The last change of a plant that was asked for.
fn changed(harness: &mut Harness<'_, Stage>) -> (usize, PlacedPlant) {
    match asked(harness).pop() {
        Some(Action::SetPlant { place, plant }) => (place, plant),
        other => panic!("{other:?}"),
    }
}

fn seed(plant: &PlacedPlant) -> &SeedOf {
    let Maker::Growth(seed) = &plant.maker;
    seed
}

/// Presses the last thing of this name: dialogs stand above everything else.
fn press_last(harness: &mut Harness<'_, Stage>, label: &str) {
    let touched = |node: &egui_kittest::Node<'_>| ROLES.contains(&node.accesskit_node().role());
    harness.query_all_by_label(label).rfind(touched).unwrap().click();
    harness.run();
}

#[test]
fn a_plant_is_added_by_its_picture() {
    let mut harness = stage(busy(), Language::English);
    press(&mut harness, "Add a grown plant…");
    assert_eq!(asked(&mut harness), [Action::ShowDialog(Dialog::PlantSpecies(None))]);
    harness.state_mut().snapshot.dialog = Some(Dialog::PlantSpecies(None));
    harness.run();
    press_last(&mut harness, "Birch");
    assert_eq!(asked(&mut harness), [Action::CloseDialog, Action::AddPlant("birch".into())]);
    press_last(&mut harness, "Cancel");
    assert_eq!(asked(&mut harness), [Action::CloseDialog]);
}

#[test]
fn plants_are_selected_and_taken_away_in_the_list() {
    let mut harness = stage(garden(None), Language::English);
    assert!(harness.query_by_label("Size on the sheet").is_none(), "nothing is selected");
    press(&mut harness, "Hazel, 12 years");
    assert_eq!(asked(&mut harness), [Action::SelectPlant(Some(1))]);
    press(&mut harness, "Remove Birch");
    assert_eq!(asked(&mut harness), [Action::RemovePlant(0)]);
    let mut harness = stage(garden(Some(0)), Language::English);
    press(&mut harness, "Birch, 7 years");
    assert_eq!(asked(&mut harness), [Action::SelectPlant(None)], "once more lets it go");
}

#[test]
fn everything_of_the_selected_plant_is_changed() {
    let mut harness = stage(garden(Some(0)), Language::English);
    drag(&mut harness, "Age", vec2(40.0, 0.0));
    let (place, plant) = changed(&mut harness);
    assert!(place == 0 && seed(&plant).age.unwrap() > 7.0, "{plant:?}");
    press(&mut harness, "The usual age of its species");
    assert_eq!(seed(&changed(&mut harness).1).age, None);
    drag(&mut harness, "Size on the sheet", vec2(-30.0, 0.0));
    let plant = changed(&mut harness).1;
    assert!(plant.height.unwrap() < 600.0, "{plant:?}");
    press(&mut harness, "Its natural height in metres");
    assert_eq!(changed(&mut harness).1.height, None);
    drag(&mut harness, "Place from the left", vec2(20.0, 0.0));
    let plant = changed(&mut harness).1;
    assert!(plant.foot.x > 100.0 && plant.foot.y == 780.0, "{plant:?}");
    press(&mut harness, "The middle of the sheet");
    assert_eq!(changed(&mut harness).1.foot.x, 500.0);
    press_first(&mut harness, "Next seed");
    assert_eq!(seed(&changed(&mut harness).1).seed, 5);
    press_first(&mut harness, "Roll the dice");
    assert_eq!(asked(&mut harness), [Action::RollPlantSeed(0)]);
}

/// Presses the first thing of this name: the list stands above what is about the drawn plant.
fn press_first(harness: &mut Harness<'_, Stage>, label: &str) {
    let touched = |node: &egui_kittest::Node<'_>| ROLES.contains(&node.accesskit_node().role());
    harness.query_all_by_label(label).find(touched).unwrap().click();
    harness.run();
}

#[test]
fn another_species_comes_with_its_own_age() {
    let mut harness = stage(garden(Some(0)), Language::English);
    press(&mut harness, "Species: Birch");
    assert_eq!(asked(&mut harness), [Action::ShowDialog(Dialog::PlantSpecies(Some(0)))]);
    harness.state_mut().snapshot.dialog = Some(Dialog::PlantSpecies(Some(0)));
    harness.run();
    press_last(&mut harness, "Oak");
    let (place, plant) = changed(&mut harness);
    let before = &harness.state().snapshot.beside.plants[0].plant;
    assert_eq!((place, plant.foot, plant.height), (0, before.foot, before.height));
    assert_eq!(*seed(&plant), SeedOf { species: "oak".into(), seed: 4, age: None });
}

#[test]
fn a_plant_that_is_selected_elsewhere_is_shown() {
    let mut harness = stage(garden(None), Language::English);
    press(&mut harness, "View");
    assert!(harness.query_by_label("Hazel, 12 years").is_none());
    harness.state_mut().snapshot.beside.selected = Some(1);
    harness.run();
    assert!(harness.query_by_label("Hazel, 12 years").is_some());
    press(&mut harness, "View");
    harness.run();
    assert!(harness.query_by_label("Hazel, 12 years").is_none(), "the artist may go elsewhere");
}
