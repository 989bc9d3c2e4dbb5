//! Tests that the message files are complete and agree with each other and with the code.

use super::*;
use crate::params::{Kind, Parameters};
use crate::pipeline::Params;
use crate::sketch::Reading;
use crate::species::Species;
use std::collections::BTreeSet;

fn table(language: Language) -> Table {
    language.file().parse().unwrap()
}

/// Every text of a language but those about parameters, by its dotted name.
fn flat(language: Language) -> BTreeMap<String, String> {
    let mut out = BTreeMap::new();
    for (section, value) in &table(language) {
        for (key, value) in value.as_table().unwrap() {
            match value {
                Value::String(text) => drop(out.insert(format!("{section}.{key}"), text.clone())),
                Value::Table(inner) if section == "name" => {
                    for (name, text) in inner {
                        out.insert(format!("name.{key}.{name}"), text.as_str().unwrap().to_owned());
                    }
                }
                Value::Table(_) if section == "param" => {}
                Value::Table(forms) => {
                    assert!(forms.keys().eq(["one", "other"]), "{section}.{key} has {forms:?}");
                    let [one, other] = ["one", "other"].map(|form| forms[form].as_str().unwrap());
                    assert!(placeholders(other).contains("count"), "{section}.{key} has no {{count}}");
                    assert!(placeholders(one).is_subset(&placeholders(other)), "{section}.{key}");
                    drop(out.insert(format!("{section}.{key}"), other.to_owned()));
                }
                other => panic!("{section}.{key} is {other}"),
            }
        }
    }
    out
}

fn placeholders(text: &str) -> BTreeSet<&str> {
    text.split('{').skip(1).filter_map(|rest| rest.split_once('}')).map(|(name, _)| name).collect()
}

#[test]
fn every_message_has_a_text_and_every_text_a_message() {
    for language in Language::ALL {
        let texts = flat(language);
        let known: BTreeSet<&str> = Msg::ALL.iter().map(|msg| msg.name()).collect();
        let written: BTreeSet<&str> =
            texts.keys().map(String::as_str).filter(|key| !key.starts_with("name.")).collect();
        assert_eq!(known, written, "{language:?}");
        assert!(texts.values().all(|text| !text.trim().is_empty()), "{language:?} has an empty text");
    }
}

#[test]
fn both_languages_have_the_same_keys_and_placeholders() {
    let (english, chinese) = (flat(Language::English), flat(Language::Chinese));
    assert!(english.keys().eq(chinese.keys()));
    for (key, text) in &english {
        assert_eq!(placeholders(text), placeholders(&chinese[key]), "{key}");
    }
}

#[test]
fn the_code_asks_for_placeholders_that_exist() {
    let messages = Messages::new(Language::Chinese);
    assert_eq!(messages.fill(Msg::StatusStrokes, &[("count", &7)]), "7 笔");
    let texts = flat(Language::Chinese);
    for msg in Msg::ALL {
        assert_eq!(messages.get(*msg), texts[msg.name()]);
    }
}

#[test]
fn every_parameter_has_a_chinese_name_and_help_and_no_other_has() {
    let chinese = Messages::new(Language::Chinese);
    let described: BTreeSet<String> =
        Params::of_any_species().describe().into_iter().map(|d| d.path).collect();
    let written: BTreeSet<String> = chinese.params.keys().cloned().collect();
    assert_eq!(described, written);
    for (path, ParamText { name, help, .. }) in &chinese.params {
        assert!(!name.is_empty() && help.ends_with('。'), "{path}: {name}, {help}");
    }
}

#[test]
fn english_names_of_parameters_are_of_parameters_and_say_no_symbol() {
    let english = Messages::new(Language::English);
    let described = Params::of_any_species().describe();
    for path in english.params.keys() {
        assert!(described.iter().any(|d| d.path == *path), "{path} is no parameter");
    }
    for description in described {
        let name = english.param_name(&description.path).to_lowercase();
        for symbol in ["prior", "lambda", "kappa", "omega", "voxel", "alpha"] {
            assert!(!name.contains(symbol), "{}: {name}", description.path);
        }
    }
}

#[test]
fn one_thing_is_said_in_the_singular() {
    let english = Messages::new(Language::English);
    for (msg, one, two) in [
        (Msg::StatusFlowers, "1 flower", "2 flowers"),
        (Msg::StatusStrokes, "1 stroke", "2 strokes"),
        (Msg::StatusTriangles, "1 triangle", "2 triangles"),
        (Msg::GrowthYears, "1 year", "2 years"),
        (Msg::PartSelected, "1 stroke", "2 strokes"),
        (Msg::NoticeMore, "1 more message", "2 more messages"),
    ] {
        let said = [1, 2].map(|count| english.fill(msg, &[("count", &count)]));
        assert_eq!(said, [one, two]);
    }
    assert_eq!(english.fill(Msg::GrowthYears, &[("count", &1.5)]), "1.5 years");
    let chinese = Messages::new(Language::Chinese);
    assert_eq!(
        chinese.fill(Msg::StatusFlowers, &[("count", &1)]),
        chinese.fill(Msg::StatusFlowers, &[("count", &2)]).replace('2', "1")
    );
}

#[test]
fn an_age_below_zero_is_said_in_words() {
    for language in Language::ALL {
        let messages = Messages::new(language);
        assert!(messages.below_zero("growth.years").is_some_and(|words| !words.contains('1')));
        assert_eq!(messages.below_zero("habit.lift"), None);
    }
}

#[test]
fn every_group_unit_and_species_has_a_name_in_both_languages() {
    for language in Language::ALL {
        let messages = Messages::new(language);
        let known = |kind: Named, name: &str| {
            let key = format!("{}/{name}", kind.section());
            assert!(messages.names.contains_key(&key), "{language:?} has no name for {key}");
        };
        for description in Params::of_any_species().describe() {
            if let Kind::Choice(names) = description.kind {
                let last = description.path.rsplit('.').next().unwrap();
                names.iter().for_each(|name| known(Named::Choice, &format!("{last}.{name}")));
            }
            let (group, _) = description.path.rsplit_once('.').unwrap();
            known(Named::Group, group);
            if !description.unit.is_empty() {
                known(Named::Unit, description.unit);
            }
        }
        Species::all().into_iter().for_each(|name| known(Named::Species, name));
        Reading::ALL.iter().for_each(|reading| known(Named::Reading, reading.name()));
    }
}

#[test]
fn chinese_is_chosen_for_chinese_locales_only() {
    for (locale, language) in [
        ("zh_CN.UTF-8", Language::Chinese),
        ("zh-Hans-SG", Language::Chinese),
        ("ZH", Language::Chinese),
        ("en_GB.UTF-8", Language::English),
        ("de-DE", Language::English),
        ("C", Language::English),
        ("zhuang", Language::English),
    ] {
        assert_eq!(Language::from_locale(locale), language, "{locale}");
    }
}

#[test]
fn unknown_names_are_spoken() {
    let messages = Messages::new(Language::English);
    assert_eq!(messages.name(Named::Species, "my_own_rose"), "My own rose");
    assert_eq!(messages.param_name("depth.radii.pressure_gain"), "Pressure gain");
    assert_eq!(messages.choice("a.pose", "upside_down"), "Upside down");
}
