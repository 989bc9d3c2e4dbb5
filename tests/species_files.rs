//! Species files as an artist writes them: whatever they say, they are read and grow, or are refused with one message that
//! names file and line.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use penstemon::growth::habit::CrownHabit;
use penstemon::growth::{Habit, Limits, PlantAtAge, Simulation, plant_at};
use penstemon::params::{Description, Kind, Parameters as _};
use penstemon::pipeline;
use penstemon::plant::Provenance;
use penstemon::species::{self, Species};
use proptest::prelude::*;
use std::collections::BTreeMap;

/// The smallest species file.
const SMALLEST: &str = include_str!("fixtures/weed.toml");

#[test]
fn wrong_parameters_are_named_with_file_and_line() {
    for (params, expected) in [
        ("[params]\ndepth.world.height = 1.0\ndepth.world.hight = 2.0\n", "line 11: there is no parameter"),
        ("[params.depth.world]\n\nheight = -1.0\n", "line 11: parameter `depth.world.height` is -1"),
        ("[params]\ndepth = 3\n", "line 10: "),
        ("[params]\nmodel.tube = { sides = \"many\" }\n", "line 10: parameter `model.tube.sides`"),
    ] {
        let species = Species::from_toml(&format!("{SMALLEST}{params}"), "weed.toml").unwrap();
        let error = pipeline::params_of_species(&species, &[]).unwrap_err().to_string();
        assert!(error.starts_with("the species weed.toml, ") && error.contains(expected), "{error}");
    }
}

fn known() -> Vec<Description> {
    Habit { crown: Some(CrownHabit::default()), ..Habit::default() }.describe()
}

/// How a number is chosen: mostly inside its range or at its ends, now and then beyond.
#[derive(Clone, Copy, Debug)]
enum Pick {
    Inside(f64),
    Least,
    Most,
    Below,
    Beyond,
    NoNumber,
}

fn pick() -> impl Strategy<Value = Pick> {
    prop_oneof![
        60 => (0.0..=1.0).prop_map(Pick::Inside),
        8 => Just(Pick::Least),
        8 => Just(Pick::Most),
        1 => Just(Pick::Below),
        1 => Just(Pick::Beyond),
        1 => Just(Pick::NoNumber),
    ]
}

/// The value as it is written, and whether it may be.
fn written(known: &Description, pick: Pick, aged: bool) -> (String, bool) {
    let (min, max) = (known.min, known.max);
    let number = |x: f64| match known.kind {
        Kind::Whole => format!("{}", x.round() as i64),
        Kind::Switch => (x >= 0.5).to_string(),
        Kind::Choice(_) => format!("\"{}\"", known.kind.written(x)),
        _ => format!("{x:?}"),
    };
    let is_kept_within = matches!(known.kind, Kind::Switch | Kind::Choice(_));
    let (text, fits) = match pick {
        // Rounded to what 32 bits hold, so that the ends stay the ends.
        Pick::Inside(share) => (number(f64::from((min + (max - min) * share) as f32).clamp(min, max)), true),
        Pick::Least => (number(min), true),
        Pick::Most => (number(max), true),
        Pick::Below => (number(min - 1.0 - min.abs()), is_kept_within),
        Pick::Beyond => (number(max + 1.0 + max.abs()), known.kind == Kind::Switch),
        Pick::NoNumber => ("\"much\"".to_owned(), false),
    };
    if aged && known.kind == Kind::Aged {
        (format!("[[0, {text}], [3.5, {text}]]"), fits)
    } else {
        (text, fits)
    }
}

/// The text of a species file with the picked values and others by shares of their names, and the keys in it that are wrong.
fn file(picks: &[(prop::sample::Index, Pick, bool)], names: [f64; 5]) -> (String, Vec<String>) {
    let known = known();
    let mut sections: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    let (mut chosen, mut wrong) = (Vec::new(), Vec::new());
    for (index, pick, aged) in picks {
        let known = index.get(&known);
        if chosen.contains(&&known.path) {
            continue;
        }
        chosen.push(&known.path);
        let (section, key) = known.path.rsplit_once('.').unwrap_or(("", &known.path));
        let (text, fits) = written(known, *pick, *aged);
        sections.entry(section).or_default().push(format!("{key} = {text}"));
        if !fits {
            wrong.push(key.to_owned());
        }
    }
    // Of each of the few things that a habit may be, one.
    let choices = known.iter().filter(|known| matches!(known.kind, Kind::Choice(_)));
    for (known, share) in choices.zip(names).filter(|(known, _)| !chosen.contains(&&known.path)) {
        let (section, key) = known.path.rsplit_once('.').unwrap_or(("", &known.path));
        let (text, _) = written(known, Pick::Inside(share), false);
        sections.entry(section).or_default().push(format!("{key} = {text}"));
    }
    let mut text = SMALLEST.to_owned();
    for (section, lines) in sections {
        let header = if section.is_empty() { "growth".to_owned() } else { format!("growth.{section}") };
        text += &format!("[{header}]\n{}\n", lines.join("\n"));
    }
    (text, wrong)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

    #[test]
    fn any_file_is_read_and_grows_or_is_refused_with_its_line(
        picks in prop::collection::vec((any::<prop::sample::Index>(), pick(), any::<bool>()), 0..24),
        names in prop::array::uniform5(0.0..=1.0),
        seed: u64,
    ) {
        let (text, wrong) = file(&picks, names);
        match Species::from_toml(&text, "weed.toml") {
            Err(fault) => {
                let fault = fault.to_string();
                prop_assert!(!wrong.is_empty(), "{} in\n{}", fault, text);
                let line = fault.strip_prefix("weed.toml, line ").and_then(|rest| rest.split_once(',')).map(|(line, _)| line);
                let line: usize = line.unwrap_or_default().parse().unwrap_or_default();
                let there = text.lines().nth(line.saturating_sub(1)).unwrap_or_default();
                let key = there.split(" = ").next().unwrap_or_default();
                prop_assert!(wrong.iter().any(|wrong| wrong == key), "{} is not about {:?} in\n{}", fault, wrong, text);
            }
            Ok(species) => {
                prop_assert!(wrong.is_empty(), "{:?} passed in\n{}", wrong, text);
                let params = pipeline::params_of_species(&species, &[]).unwrap();
                let limits = Limits { internodes: 1500, markers: 4000, voxels: 1 << 20, ..Limits::default() };
                let mut simulation = Simulation::new(&params.habit, seed, limits);
                simulation.grow_to(5, &|| false);
                let PlantAtAge { plant, buds } = plant_at(&simulation, 4.7);
                let plant = species::apply(plant, &buds, &Provenance::default(), &species, seed).plant;
                prop_assert_eq!(plant.check_invariants(), Ok(()), "{}", text);
            }
        }
    }
}
