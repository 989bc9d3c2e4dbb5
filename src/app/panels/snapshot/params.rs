//! Values of parameters by path, as the panel of parameters shows them.

use crate::growth::Habit;
use crate::params::{Kind, Parameters as _, join};
use crate::pipeline::Params;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// What every path of a growth habit begins with.
const HABIT: &str = "habit";

/// What stands behind a plant: at first nothing.
const OBSTACLE: &str = "obstacle.kind";

/// Values of parameters by path, where they are not the program's defaults.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ParamValues {
    /// What the species says; the numbers of its growth habit are all here if the plant grows, and missing if not.
    pub species: BTreeMap<String, f64>,
    /// What the artist changed; switches are 0 or 1, one of several names is its place among them.
    pub own: BTreeMap<String, f64>,
    /// Whether there is a garden.
    pub has_garden: bool,
}

impl ParamValues {
    /// Flattens the overrides of a species and of a drawing, as [`crate::pipeline::params_of`] lays them over the defaults.
    pub fn of(species: &Map<String, Value>, own: &Map<String, Value>) -> Self {
        let mut out = Self::default();
        flatten("", species, &mut out.species);
        flatten("", own, &mut out.own);
        out
    }

    /// With how the plant grows, as it is at an age in years.
    #[must_use]
    pub fn growing(mut self, habit: &Habit, age: f32) -> Self {
        let mut all = Vec::new();
        habit.describe_into(HABIT, age, &mut all);
        for known in all {
            self.species.entry(known.path).or_insert(known.default);
        }
        self
    }

    /// The same of a drawing that has a garden or not.
    pub fn with_garden(self, has_garden: bool) -> Self {
        Self { has_garden, ..self }
    }

    /// Whether a parameter means something for this plant: growth habits are those of plants that grow, an obstacle's sizes those of
    /// one that is there.
    pub fn applies(&self, path: &str) -> bool {
        if path.starts_with("obstacle.") && path != OBSTACLE {
            let kind = self.own.get(OBSTACLE).or(self.species.get(OBSTACLE));
            return kind.is_some_and(|kind| *kind != 0.0);
        }
        let of_habit = path.strip_prefix(HABIT).is_some_and(|rest| rest.starts_with('.'));
        let is_missed = path.starts_with("garden.") && !self.has_garden;
        !is_missed && (!of_habit || self.species.contains_key(path))
    }
}

fn flatten(prefix: &str, tree: &Map<String, Value>, out: &mut BTreeMap<String, f64>) {
    for (key, value) in tree {
        let path = join(prefix, key);
        match value {
            Value::Object(inner) => flatten(&path, inner, out),
            value => {
                let kind = choices().get(&path).copied().unwrap_or(Kind::Number);
                out.extend(kind.number(value).map(|number| (path, number)));
            }
        }
    }
}

/// The parameters that are one of several names, by their paths.
fn choices() -> &'static BTreeMap<String, Kind> {
    static CHOICES: OnceLock<BTreeMap<String, Kind>> = OnceLock::new();
    CHOICES.get_or_init(|| {
        let all = Params::of_any_species().describe().into_iter();
        all.filter(|known| matches!(known.kind, Kind::Choice(_)))
            .map(|known| (known.path, known.kind))
            .collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::growth::Schedule;

    #[test]
    fn overrides_are_flattened_in_any_spelling() {
        let species = serde_json::json!({"depth": {"world": {"height": 2.0}, "cone.flip": true}});
        let own = serde_json::json!({"depth.world": {"height": 3}});
        let values = ParamValues::of(species.as_object().unwrap(), own.as_object().unwrap());
        assert_eq!(
            values.species,
            [("depth.world.height".into(), 2.0), ("depth.cone.flip".into(), 1.0)].into()
        );
        assert_eq!(values.own, [("depth.world.height".into(), 3.0)].into());
        let named = serde_json::json!({"habit": {"control": "priority", "resource": "air"}});
        let values = ParamValues::of(&Map::new(), named.as_object().unwrap());
        assert_eq!(values.own, [("habit.control".into(), 1.0)].into());
    }

    #[test]
    fn growth_habits_are_those_of_plants_that_grow() {
        let values = ParamValues::of(&Map::new(), &Map::new());
        assert!(values.applies("depth.world.height") && !values.applies("habit.lambda"));
        let lambda = Schedule::new(vec![(0.0, 0.6), (20.0, 0.4)], 0.0, 1.0).unwrap();
        let values = values.growing(&Habit { lambda, ..Habit::default() }, 10.0);
        assert!(values.applies("habit.lambda") && values.applies("habit.leaf.length"));
        assert!(!values.applies("habit.crown.height"), "it has no crown of its own");
        assert!(values.applies(OBSTACLE) && !values.applies("obstacle.width"), "nothing is there");
        let walled = ParamValues { own: BTreeMap::from([(OBSTACLE.to_owned(), 1.0)]), ..values.clone() };
        assert!(walled.applies("obstacle.width"));
        assert!((values.species["habit.lambda"] - 0.5).abs() < 1e-6, "as it is at that age");
    }
}
