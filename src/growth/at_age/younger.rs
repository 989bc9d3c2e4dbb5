//! Branches that are shown younger than their plant, as they were some years before.
//!
//! What happened on such a branch, and on all that grew on it, happens so many years later: nodes are born and shed, buds become shoots
//! and flowers. So it has the wood, the leaves and the flowers of that age, and what carries it is as thick as that needs. Branches on
//! a younger branch can be younger still.
//!
//! Limits: the rest of the plant does not grow into the light and the room that are free then. Wood that was drawn is there from the
//! first; only what grew on it is younger. Of a branch that grew its first year stays: what is not to be there is cut off.

use crate::growth::tree::{NONE, Tree};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// How many years younger branches are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Younger {
    /// Those that grew, by their names.
    pub grown: BTreeMap<u64, u16>,
    /// Those that strokes drew, by these.
    pub drawn: BTreeMap<u64, u16>,
}

impl Younger {
    /// Whether all branches are as old as their plant.
    pub fn is_empty(&self) -> bool {
        self.grown.is_empty() && self.drawn.is_empty()
    }

    /// The tree in a year, with its branches so much younger. `names` are those of its nodes; `strokes` say for each branch that the plant
    /// began with which stroke drew it.
    pub(crate) fn tree<'a>(
        &self,
        tree: &'a Tree,
        names: &[u64],
        strokes: &[Option<u64>],
        year: u16,
    ) -> Cow<'a, Tree> {
        if self.is_empty() {
            return Cow::Borrowed(tree);
        }
        let later = self.later(tree, names, strokes, year);
        let mut younger = tree.clone();
        // Drawn wood is there at any age.
        for (node, by) in later.iter().enumerate().skip(tree.drawn.len()) {
            for years in [&mut younger.nodes.born, &mut younger.nodes.died] {
                years[node] = years[node].saturating_add(*by);
            }
        }
        let buds = &mut younger.buds;
        for (settled, node) in buds.settled.iter_mut().zip(&buds.node) {
            *settled = settled.saturating_add(later[*node as usize]);
        }
        Cow::Owned(younger)
    }

    /// How many years later everything happens at each node.
    fn later(&self, tree: &Tree, names: &[u64], strokes: &[Option<u64>], year: u16) -> Vec<u16> {
        let nodes = &tree.nodes;
        let mut later: Vec<u16> = Vec::with_capacity(tree.len());
        for (i, name) in names.iter().enumerate() {
            let below = nodes.parent[i];
            let carried = if below == NONE { 0 } else { later[below as usize] };
            let drawn = tree.drawn.get(i).copied();
            let own = match drawn {
                // A branch that was drawn begins where the one below it ends.
                Some(branch) if below == NONE || tree.drawn[below as usize] != branch => {
                    let stroke = strokes.get(branch as usize).copied().flatten();
                    stroke.and_then(|stroke| self.drawn.get(&stroke))
                }
                Some(_) => None,
                None => self.grown.get(name),
            };
            let own = own.copied().unwrap_or(0);
            let most = if drawn.is_some() { year } else { year.saturating_sub(nodes.born[i]) };
            later.push(if own == 0 { carried } else { carried.saturating_add(own).min(most.max(carried)) });
        }
        later
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::growth::at_age::to_plant::with_wood;
    use crate::growth::at_age::wood_at_age::WoodAtAge;
    use crate::growth::at_age::wood_names;
    use crate::growth::{Habit, Limits, Simulation};

    fn grown(years: u16) -> Simulation {
        let habit = Habit { internode: 0.3, shed: 0.05.into(), ..Habit::default() };
        let mut simulation = Simulation::new(&habit, 4, Limits::default());
        simulation.grow_to(years, &|| false);
        simulation
    }

    /// The first node of a lateral that carries much.
    fn bough(tree: &Tree) -> usize {
        let mut carried = vec![1; tree.len()];
        for i in (1..tree.len()).rev().filter(|i| tree.nodes.parent[*i] != NONE) {
            carried[tree.nodes.parent[i] as usize] += carried[i];
        }
        let laterals = (0..tree.len()).filter(|i| tree.begins_lateral(*i) && tree.nodes.born[*i] <= 4);
        laterals.filter(|i| tree.lives(*i, 9)).max_by_key(|i| carried[*i]).unwrap()
    }

    #[test]
    fn a_whole_plant_that_is_younger_is_the_plant_at_that_age() {
        let simulation = grown(9);
        let (tree, names) = (simulation.tree(), wood_names::names(simulation.tree(), &[]));
        let later = vec![3; tree.len()];
        let of_first = Younger { grown: BTreeMap::from([(names[1], 3)]), ..Younger::default() };
        assert_eq!(of_first.later(tree, &names, &[], 9)[1..], later[1..]);
        let younger = of_first.tree(tree, &names, &[], 9);
        let (shown, _) = with_wood(&simulation, &younger, 9.0, None);
        let (was, _) = with_wood(&simulation, tree, 6.0, None);
        assert_eq!(shown.plant.branches, was.plant.branches);
        // Leaves are as long as they are on a plant of its age.
        assert_eq!(shown.plant.organs.len(), was.plant.organs.len());
    }

    #[test]
    fn a_younger_bough_has_less_wood_and_nothing_else_changes_but_what_carries_it() {
        let simulation = grown(9);
        let (tree, names) = (simulation.tree(), wood_names::names(simulation.tree(), &[]));
        let bough = bough(tree);
        let on_it = |node: usize| {
            let below = |node: &usize| Some(tree.nodes.parent[*node]).filter(|below| *below != NONE);
            std::iter::successors(Some(node), |node| below(node).map(|n| n as usize)).any(|n| n == bough)
        };
        let shown = |years: u16| {
            let younger = Younger { grown: BTreeMap::from([(names[bough], years)]), ..Younger::default() };
            with_wood(&simulation, &younger.tree(tree, &names, &[], 9), 9.0, None).1
        };
        let (now, some, most) = (shown(0), shown(2), shown(100));
        let alive = |wood: &WoodAtAge, of_it: bool| {
            let nodes = wood.chains.of_node.iter().enumerate();
            nodes.filter(|(node, chain)| **chain != NONE && on_it(*node) == of_it).count()
        };
        assert!(alive(&now, true) > alive(&some, true) && alive(&some, true) > alive(&most, true));
        assert!(alive(&most, true) > 0, "its first year stays");
        assert!(
            now.diameters[bough] > some.diameters[bough] && some.diameters[bough] > most.diameters[bough]
        );
        // Where a bough needs less room another may keep a twig.
        assert!(alive(&some, false).abs_diff(alive(&now, false)) < alive(&now, false) / 50);
    }

    #[test]
    fn drawn_wood_stays_and_what_grew_on_it_is_younger() {
        let mut drawn = grown(5).tree().clone();
        drawn.drawn = vec![0, 0];
        let names = wood_names::names(&drawn, &[7]);
        let younger = Younger { drawn: BTreeMap::from([(12, 2)]), ..Younger::default() };
        let tree = younger.tree(&drawn, &names, &[Some(12)], 5);
        assert_eq!(tree.nodes.born[..2], drawn.nodes.born[..2]);
        assert!((2..drawn.len()).all(|i| tree.nodes.born[i] == drawn.nodes.born[i] + 2));
        let of_another = Younger { drawn: BTreeMap::from([(13, 2)]), ..Younger::default() };
        assert_eq!(*of_another.tree(&drawn, &names, &[Some(12)], 5), drawn);
    }
}
