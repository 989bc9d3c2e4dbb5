//! The side panel: species, textures, seed, presets, view.

use super::stage::{asked, busy, drag, press, stage};
use egui::vec2;
use egui_kittest::kittest::Queryable;
use penstemon::app::action::Action;
use penstemon::app::messages::{Language, Messages, Msg};
use penstemon::app::panels::Snapshot;
use penstemon::app::panels::snapshot::{PathPurpose, PlantSearchState, ReferenceState, Shading};
use penstemon::app::plant_search::PlantMark;
use penstemon::app::presets::Listed;
use penstemon::plant::OrganKind;
use penstemon::sketch::{Picture, TextureChoice};

#[test]
fn species_textures_and_seed_are_chosen_by_tapping() {
    let mut harness = stage(busy(), Language::English);
    harness.get_by_label("Plumeria").scroll_to_me();
    harness.run();
    press(&mut harness, "Plumeria");
    assert_eq!(asked(&mut harness), [Action::SetSpecies("plumeria".into())]);
    harness.get_by_label("Roll the dice").scroll_to_me();
    harness.run();
    press(&mut harness, "Roll the dice");
    assert_eq!(asked(&mut harness), [Action::RollSeed]);
    press(&mut harness, "Next seed");
    assert_eq!(asked(&mut harness), [Action::SetSeed(18)]);
    harness.get_by_label("petal rose").scroll_to_me();
    harness.run();
    press(&mut harness, "petal rose");
    let texture = Some(TextureChoice::Named("petal_rose.png".to_owned()));
    assert_eq!(asked(&mut harness), [Action::SetTexture { organ: Some(OrganKind::Petal), texture }]);
    harness.get_by_label("Branches").scroll_to_me();
    harness.run();
    press(&mut harness, "Branches");
    press(&mut harness, "Picture file…");
    assert_eq!(asked(&mut harness), [Action::ChooseFile(PathPurpose::Texture(None))]);
    press(&mut harness, "From a photograph…");
    assert_eq!(asked(&mut harness), [Action::ChooseFile(PathPurpose::Photograph(None))]);
}

#[test]
fn a_chosen_texture_can_be_given_back() {
    let mut snapshot = busy();
    snapshot.textures.insert("petal".into(), TextureChoice::Named("petal_rose".into()));
    let mut harness = stage(snapshot, Language::English);
    harness.get_by_label("Species' own").scroll_to_me();
    harness.run();
    press(&mut harness, "Species' own");
    assert_eq!(asked(&mut harness), [Action::SetTexture { organ: Some(OrganKind::Petal), texture: None }]);
}

#[test]
fn a_missing_picture_is_named_and_can_be_found_and_an_own_one_is_shown() {
    let mut snapshot = busy();
    snapshot.textures.insert("petal".into(), TextureChoice::Named("gone.png".into()));
    let mut harness = stage(snapshot.clone(), Language::English);
    harness.get_by_label("gone.png is missing; the species' own is shown.").scroll_to_me();
    harness.run();
    press(&mut harness, "Find…");
    assert_eq!(asked(&mut harness), [Action::ChooseFile(PathPurpose::Texture(Some(OrganKind::Petal)))]);
    let own = Picture::new(&include_bytes!("../fixtures/reference/small.png")[..]).unwrap();
    snapshot.textures.insert("petal".into(), TextureChoice::Own(own));
    let harness = stage(snapshot, Language::English);
    harness.get_by_label("Your picture").scroll_to_me();
}

#[test]
fn a_missing_species_file_is_named_and_can_be_found() {
    let mut snapshot = busy();
    (snapshot.species, snapshot.missing_species) = ("own/weed.toml".into(), Some("weed.toml".into()));
    let mut harness = stage(snapshot, Language::English);
    assert!(harness.query_by_label_contains("weed.toml is missing").is_some());
    press(&mut harness, "Find…");
    assert_eq!(asked(&mut harness), [Action::ChooseFile(PathPurpose::Species)]);
    assert!(harness.query_by_label("Species file…").is_none(), "once is enough");
}

#[test]
fn presets_are_saved_under_a_proposed_name_without_a_keyboard() {
    let mut snapshot = busy();
    snapshot.presets = vec![Listed { name: "Daisy 1".into(), path: "/presets/daisy-1.toml".into() }];
    let mut harness = stage(snapshot, Language::English);
    harness.get_by_label("Save this look").scroll_to_me();
    harness.run();
    press(&mut harness, "Save this look");
    assert_eq!(asked(&mut harness), [Action::SavePreset("Daisy 2".into())]);
    press(&mut harness, "Daisy 1");
    assert_eq!(asked(&mut harness), [Action::ApplyPreset("/presets/daisy-1.toml".into())]);
    press(&mut harness, "Delete Daisy 1");
    assert_eq!(asked(&mut harness), [Action::DeletePreset("/presets/daisy-1.toml".into())]);
}

#[test]
fn the_view_is_set_by_tapping_and_dragging() {
    let mut snapshot = busy();
    snapshot.reference = Some(ReferenceState { opacity: 0.5, locked: false });
    let mut harness = stage(snapshot, Language::English);
    press(&mut harness, "View");
    for (label, action) in [
        ("Mesh", Action::SetShading(Shading::Wireframe)),
        ("Without perspective", Action::SetOrthographic(true)),
        ("Turntable", Action::SetTurntable(true)),
        ("Copy picture", Action::CopyPicture),
        ("Lock", Action::LockReference(true)),
        ("Remove", Action::RemoveReference),
    ] {
        harness.get_by_label(label).scroll_to_me();
        harness.run();
        press(&mut harness, label);
        assert_eq!(asked(&mut harness), [action], "{label}");
    }
    drag(&mut harness, "Opacity", vec2(50.0, 0.0));
    let actions = asked(&mut harness);
    assert!(
        matches!(actions.last(), Some(Action::SetReferenceOpacity(o)) if *o > 0.55 && *o < 0.9),
        "{actions:?}"
    );
    drag(&mut harness, "Strength", vec2(-30.0, 0.0));
    let actions = asked(&mut harness);
    assert!(matches!(actions.last(), Some(Action::SetLight(l)) if l.strength < 1.0), "{actions:?}");
}

#[test]
fn a_guessed_species_says_so_and_is_kept_or_left_to_the_drawing_with_one_tap() {
    for language in Language::ALL {
        let messages = Messages::new(language);
        let guessed = Snapshot { species: "oak".into(), species_is_guess: true, ..busy() };
        let mut harness = stage(guessed.clone(), language);
        let of_guess = harness.get_by_label(messages.get(Msg::SpeciesGuessed)).rect();
        press(&mut harness, messages.get(Msg::SpeciesKeep));
        assert_eq!(asked(&mut harness), [Action::SetSpecies("oak".into())]);
        let mut harness = stage(Snapshot { species_is_guess: false, ..guessed }, language);
        let of_choice = harness.get_by_label(messages.get(Msg::SpeciesChosen)).rect();
        assert_eq!(of_guess.top(), of_choice.top(), "nothing moves");
        press(&mut harness, messages.get(Msg::SpeciesGuess));
        assert_eq!(asked(&mut harness), [Action::GuessSpecies]);
    }
}

#[test]
fn the_plant_on_the_reference_picture_is_sought_marked_and_used_by_tapping() {
    let mut snapshot = busy();
    snapshot.reference = Some(ReferenceState { opacity: 0.5, locked: false });
    let mut harness = stage(snapshot.clone(), Language::English);
    press(&mut harness, "View");
    harness.get_by_label("Find the plant").scroll_to_me();
    harness.run();
    assert!(harness.query_by_label("Use as crown").is_none(), "nothing has been found");
    press(&mut harness, "Find the plant");
    assert_eq!(asked(&mut harness), [Action::FindPlant(true)]);
    snapshot.plant_search = PlantSearchState {
        on: true,
        any_marks: true,
        share: Some(24.4),
        branch: Some(3),
        ..PlantSearchState::default()
    };
    let mut harness = stage(snapshot, Language::English);
    press(&mut harness, "View");
    assert!(harness.query_by_label("The plant takes 24 % of the picture.").is_some());
    for (label, action) in [
        ("Around it", Action::MarkPlant(PlantMark::Around)),
        ("Use as crown", Action::UseAsCrown),
        ("Colours from the picture", Action::ColoursFromPicture),
        ("Snap to the trunk", Action::SnapToTrunk(3)),
        ("Clear marks", Action::ClearPlantMarks),
        ("Find the plant", Action::FindPlant(false)),
    ] {
        harness.get_by_label(label).scroll_to_me();
        harness.run();
        press(&mut harness, label);
        assert_eq!(asked(&mut harness), [action], "{label}");
    }
}
