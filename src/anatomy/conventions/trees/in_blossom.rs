//! Flowers drawn in the crown of a tree or a bush.
//!
//! All that lies in a crown is explained by it: twigs, curls, dots. Several corollas there, each of a centre with its petals, are
//! flowers that the plant bears; the crown is proposed once more without their lines.
//!
//! Limits: a single flower may be an apple, or a face.

use crate::anatomy::conventions::Hypothesis;
use crate::sketch::{Reading, Tool};
use std::collections::BTreeSet;

/// Fewest corollas, and least log-odds of each.
const FLOWERS: (usize, f32) = (2, 4.0);
/// What it costs that a crown leaves lines in it to others.
const LEFT: f32 = 0.3;

/// For each crown with flowers in it the same without their lines.
pub(crate) fn without_flowers(found: &[Hypothesis]) -> Vec<Hypothesis> {
    let is_crown = |it: &&Hypothesis| it.parts.iter().any(|part| part.tool == Tool::Crown);
    let is_flower = |it: &&Hypothesis| it.reading == Reading::Corolla && it.score > FLOWERS.1;
    let flowers: Vec<&Hypothesis> = found.iter().filter(is_flower).collect();
    if flowers.len() < FLOWERS.0 {
        return Vec::new();
    }
    found.iter().filter(is_crown).filter_map(|crown| without(crown, &flowers)).collect()
}

fn without(crown: &Hypothesis, flowers: &[&Hypothesis]) -> Option<Hypothesis> {
    let has = |line: &usize| crown.uses.binary_search(line).is_ok();
    // The outline is a line of the crown's alone.
    let is_inside =
        |flower: &&&Hypothesis| flower.uses.iter().all(has) && flower.uses.len() < crown.uses.len();
    let mut lines: BTreeSet<usize> = BTreeSet::new();
    let mut count = 0;
    for flower in flowers.iter().filter(is_inside) {
        // Ways to read one flower share its lines.
        count += usize::from(flower.uses.iter().all(|line| !lines.contains(line)));
        lines.extend(&flower.uses);
    }
    if count < FLOWERS.0 {
        return None;
    }
    let mut own = crown.clone();
    own.uses.retain(|line| !lines.contains(line));
    own.score -= LEFT;
    (!own.uses.is_empty()).then_some(own)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::{Habit, Made};

    fn of(reading: Reading, tool: Tool, uses: &[usize], score: f32) -> Hypothesis {
        let parts = vec![Made::new(tool, [])];
        Hypothesis {
            uses: uses.to_vec(),
            score,
            parts,
            solids: Vec::new(),
            reading,
            habit: Some(Habit::Tree),
        }
    }

    #[test]
    fn a_crown_leaves_the_lines_of_several_flowers_to_them_and_those_of_one_not() {
        let crown = of(Reading::Tree, Tool::Crown, &[0, 1, 2, 3, 4, 5, 6], 5.0);
        let flower = |uses: &[usize]| of(Reading::Corolla, Tool::Petal, uses, 4.5);
        let [one, two] = [flower(&[1, 2]), flower(&[4, 5])];
        let found = without_flowers(&[crown.clone(), one.clone(), two.clone()]);
        assert_eq!((found.len(), &found[0].uses[..]), (1, &[0, 3, 6][..]));
        assert!(found[0].score < crown.score, "it explains less");
        assert!(without_flowers(&[crown.clone(), one.clone()]).is_empty());
        let twice = flower(&[1, 2]);
        assert!(
            without_flowers(&[crown.clone(), one.clone(), twice.clone(), twice]).is_empty(),
            "one, read three times"
        );
        assert!(without_flowers(&[crown, one, flower(&[7, 8])]).is_empty(), "one is outside");
    }
}
