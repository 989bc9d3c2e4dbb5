//! What the parts of a plant are known by, so that poses find them.

use crate::plant::{GrownId, Origin, Plant, Provenance};
use crate::random::{Choice, mix};
use crate::sketch::PartName;
use std::collections::HashMap;

/// The names of all parts of a plant that have any.
#[derive(Clone, Debug, Default)]
pub struct PartNames {
    /// Of what was drawn, in the order in which it was recorded.
    drawn: Vec<PartName>,
}

impl PartNames {
    /// Those of the plant of a drawing. A stroke that drew several parts names the first of them; branches come before organs.
    pub fn new(provenance: &Provenance) -> Self {
        let mut parts_of: HashMap<u64, u64> = HashMap::new();
        let name = |stroke: &u64| {
            let nth = parts_of.entry(*stroke).or_default();
            *nth += 1;
            match *nth {
                1 => PartName::Stroke(*stroke),
                nth => PartName::Grown(mix(Choice::NAME_OF_PART.key(*stroke), nth)),
            }
        };
        Self { drawn: provenance.strokes().iter().map(name).collect() }
    }

    /// The name of what has this origin; none of what a rule made.
    pub fn of(&self, origin: Origin) -> Option<PartName> {
        match origin {
            Origin::Generated => None,
            Origin::Grown(GrownId(name)) => Some(PartName::Grown(name)),
            Origin::Drawn(drawn) => self.drawn.get(drawn.index()).copied(),
        }
    }

    /// The branch of a name; none where that is not there or names an organ.
    pub fn branch(&self, plant: &Plant, name: PartName) -> Option<usize> {
        plant.branches.iter().position(|branch| self.of(branch.origin) == Some(name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_several_parts_of_a_stroke_each_has_a_name() {
        let mut provenance = Provenance::default();
        let origins = [5, 7, 5, 5].map(|stroke| provenance.record(Some(stroke)));
        let names = PartNames::new(&provenance);
        let [first, other, second, third] = origins.map(|origin| names.of(origin).unwrap());
        assert_eq!([first, other], [PartName::Stroke(5), PartName::Stroke(7)]);
        assert!(second != third && [second, third].iter().all(|name| matches!(name, PartName::Grown(_))));
        assert_eq!(names.of(Origin::Generated), None);
        assert_eq!(names.of(Origin::Grown(GrownId(3))), Some(PartName::Grown(3)));
    }
}
