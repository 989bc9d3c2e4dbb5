//! Tests of reading species files.

use super::*;
use std::fs;

/// The smallest species file, after an empty line.
const SMALLEST: &str = concat!("\n", include_str!("../../tests/fixtures/weed.toml"));

fn message(text: &str) -> String {
    parse(text, "weed.toml", None).unwrap_err().to_string()
}

#[test]
fn the_smallest_species_is_read() {
    let weed = parse(SMALLEST, "weed.toml", None).unwrap();
    assert_eq!(weed.materials["green"].color, [0.0, 1.0, 0.0]);
    assert!(weed.flowers.is_empty() && weed.params.is_empty());
}

#[test]
fn an_unknown_key_is_named_with_file_and_line() {
    let message = message(&format!("{SMALLEST}wary = 0.5\n"));
    assert!(message.contains("weed.toml, line 10, `wary = 0.5`") && message.contains("`vary`"), "{message}");
}

#[test]
fn numbers_out_of_range_are_refused_with_their_line() {
    let text = format!("{SMALLEST}vary = 1.5\n");
    assert!(
        message(&text).contains("line 10") && message(&text).contains("1.5 is outside 0 to 1"),
        "{}",
        message(&text)
    );
    let text = format!("{SMALLEST}form = {{ cup = 7.0 }}\n");
    assert!(message(&text).contains("`cup`: 7 is outside -2 to 2"), "{}", message(&text));
    let text = SMALLEST.replace("#00ff00", "green");
    assert!(message(&text).contains("line 5") && message(&text).contains("#rrggbb"), "{}", message(&text));
    assert!(message(&format!("{SMALLEST}vary = nan\n")).contains("NaN is outside"));
}

#[test]
fn a_missing_material_is_named_with_its_key() {
    let text = SMALLEST.replace("materials = \"green\"", "materials = [\"green\", \"gren\"]");
    let message = message(&text);
    assert!(message.contains("weed.toml, line 9: leaf.materials"), "{message}");
    assert!(message.contains("did you mean `green`?"), "{message}");
}

#[test]
fn a_missing_texture_is_named() {
    let text = SMALLEST.replace("color = \"#00ff00\"", "texture = \"petal_dasiy.png\"");
    let message = message(&text);
    assert!(
        message.contains("weed.toml, line 5: materials.green.texture")
            && message.contains("`petal_daisy.png`?"),
        "{message}"
    );
}

#[test]
fn broken_toml_and_materials_with_odd_names_are_refused() {
    assert!(message("name = ").contains("line 1"));
    let text = SMALLEST.replace("green =", "\"petal-picture\" =");
    assert!(message(&text).contains("weed.toml, line 5: the material"), "{}", message(&text));
    assert!(message(&text).contains("`petal-picture` may hold only"), "{}", message(&text));
}

#[test]
fn references_of_flowers_are_named_with_their_line() {
    let mut text = include_str!("../../assets/species/mallow.toml").to_owned();
    let section = text.find("[[flowers.stamens]]").unwrap();
    let from = section + text[section..].find("material = \"").unwrap();
    let to = from + text[from..].find('\n').unwrap();
    text.replace_range(from..to, "material = \"golden\"");
    let line = text[..from].matches('\n').count() + 1;
    let message = message(&text);
    assert!(message.contains(&format!("weed.toml, line {line}: flowers[0].stamens")), "{message}");
    assert!(message.contains("`golden`"), "{message}");
}

#[test]
fn pictures_beside_the_file_win_over_built_in_ones() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("weed.toml");
    let text = SMALLEST.replace("color = \"#00ff00\"", "texture = \"petal_daisy.png\"");
    fs::write(&file, &text).unwrap();
    let texture = || Species::read(&file).unwrap().materials["green"].texture.clone();
    assert_eq!(texture(), Some(Texture::BuiltIn("petal_daisy.png".into())));
    let picture = folder.path().join("petal_daisy.png");
    fs::write(&picture, b"").unwrap();
    assert_eq!(texture(), Some(Texture::File(picture)));
}

#[test]
fn files_that_are_missing_too_large_or_no_text_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("weed.toml");
    assert!(matches!(Species::read(&file), Err(SpeciesError::Unreadable { .. })));
    fs::write(&file, [0xff, 0xfe]).unwrap();
    assert!(matches!(Species::read(&file), Err(SpeciesError::Unreadable { .. })));
    fs::write(&file, vec![b' '; MAX_BYTES as usize + 1]).unwrap();
    assert!(matches!(Species::read(&file), Err(SpeciesError::TooLarge { .. })));
}

#[test]
fn parts_and_pictures_are_checked() {
    let mut weed = parse(SMALLEST, "weed.toml", None).unwrap();
    let error = weed.set_texture("petla", Path::new("x.png")).unwrap_err().to_string();
    assert!(error.contains("did you mean `petal`?") && error.contains("stigma"), "{error}");
    let error = weed.set_texture("petal", Path::new("no/such.png")).unwrap_err().to_string();
    assert!(error.contains("no/such.png"), "{error}");
    let folder = tempfile::tempdir().unwrap();
    let cut = folder.path().join("cut.png");
    let whole = include_bytes!("../../tests/fixtures/reference/small.png");
    fs::write(&cut, &whole[..whole.len() - 20]).unwrap();
    let error = weed.set_texture("petal", &cut).unwrap_err().to_string();
    assert!(error.contains("cut.png") && error.contains("damaged"), "{error}");
}
