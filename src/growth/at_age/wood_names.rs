//! Names of grown branches, by which what the artist did to one finds it again.
//!
//! The name of a node is a hash of the way of buds from where its plant began: which of the buds of each node on the way grew, the
//! one that continues the axis or one at its side. A branch is called by its first own node. So it has the same name at
//! every age, and after another growth, unless other buds grew on its way: growth with other angles, forces or leaves keeps
//! nearly all names.
//!
//! At a fork the thicker axis runs on, and the other one begins a branch. Which one that is may change with age: then what was a
//! branch runs on in the line of another.
//!
//! Limits: of several lateral axes of one node the one that grew first is the first. Drawn wood is counted in nodes from the
//! base of its stroke: what stands above a new fork of it, or on internodes of another length, has other names.

use super::chains::Chains;
use crate::growth::tree::{NONE, Tree};
use crate::plant::{Branch, Continued, GrownId, Origin, Provenance};
use crate::random::{Choice, mix};
use glam::Vec3;
use std::collections::{BTreeSet, HashMap};

/// Names the branches that begin with a grown node, and says which of the `wanted` run on in the lines of others. They are those of
/// the chains, in their order; `names` are those of the nodes, `at` their places.
pub(crate) fn name_branches(
    branches: &mut [Branch],
    (tree, chains, at): (&Tree, &Chains, &[Vec3]),
    names: &[u64],
    wanted: &BTreeSet<u64>,
) -> Vec<Continued> {
    for (index, branch) in branches.iter_mut().enumerate() {
        let first = chains.first(index as u32) as usize;
        if first >= tree.drawn.len() {
            branch.origin = Origin::Grown(GrownId(names[first]));
        }
    }
    if wanted.is_empty() {
        return Vec::new();
    }
    let continued = |node: usize| {
        let (chain, parent) = (chains.of_node[node], tree.nodes.parent[node]);
        let runs_on = chain != NONE && parent != NONE && chains.first(chain) as usize != node;
        (runs_on && wanted.contains(&names[node])).then(|| Continued {
            name: GrownId(names[node]),
            branch: chain as usize,
            from: at[parent as usize],
        })
    };
    (tree.drawn.len()..chains.of_node.len()).filter_map(continued).collect()
}

/// Names of the branches that growth begins with: those that grew have theirs, those that were drawn are called by their
/// strokes, and what has neither by its place among such.
pub(crate) fn names_of_wood<'a>(
    wood: impl IntoIterator<Item = &'a Branch>,
    provenance: &Provenance,
) -> Vec<u64> {
    let mut of_stroke: HashMap<Option<u64>, u64> = HashMap::new();
    let mut name = |branch: &Branch| {
        if let Origin::Grown(GrownId(name)) = branch.origin {
            return name;
        }
        let stroke = provenance.stroke(branch.origin);
        let nth = of_stroke.entry(stroke).or_default();
        *nth += 1;
        let of = stroke.map_or(Choice::NAME_OF_FOOT.key(0), |stroke| Choice::NAME_OF_STROKE.key(stroke));
        mix(of, *nth)
    };
    wood.into_iter().map(&mut name).collect()
}

/// The names of all nodes, from those of the branches that the plant began with.
pub(crate) fn names(tree: &Tree, wood: &[u64]) -> Vec<u64> {
    let nodes = &tree.nodes;
    let mut names: Vec<u64> = Vec::with_capacity(tree.len());
    // How many of the nodes of each drawn branch, and of the axes beside and above each node, have a name.
    let mut of_drawn = vec![0_u64; wood.len()];
    let mut above = vec![[0_u32; 2]; tree.len()];
    let mut feet = 0;
    for i in 0..tree.len() {
        let drawn = tree.drawn.get(i).map(|branch| *branch as usize);
        let name = match (drawn.and_then(|branch| Some((branch, wood.get(branch)?))), nodes.parent[i]) {
            (Some((branch, name)), _) => {
                of_drawn[branch] += 1;
                mix(*name, of_drawn[branch])
            }
            (None, NONE) => {
                feet += 1;
                Choice::NAME_OF_FOOT.key(feet)
            }
            (None, parent) => {
                let (parent, is_lateral) = (parent as usize, tree.begins_lateral(i));
                let count = &mut above[parent][usize::from(is_lateral)];
                *count += 1;
                mix(mix(names[parent], u64::from(is_lateral)), u64::from(*count))
            }
        };
        names.push(name);
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::growth::tree::NewNode;
    use glam::Vec3;
    use std::collections::HashSet;

    /// A foot, two nodes above each other, and beside the first so many axes.
    fn tree(laterals: usize) -> Tree {
        let mut tree = Tree::default();
        let foot = tree.add_foot(Vec3::ZERO, Vec3::X);
        let mut add = |parent: u32, lateral: bool| {
            tree.add(NewNode { parent, at: Vec3::Y, side: Vec3::X, lateral, year: 1 })
        };
        let first = add(foot, false);
        add(first, false);
        (0..laterals).for_each(|_| {
            add(first, true);
        });
        tree
    }

    #[test]
    fn each_node_has_a_name_that_stays_when_more_grows() {
        let (few, many) = (names(&tree(1), &[]), names(&tree(5), &[]));
        assert_eq!(few, many[..few.len()]);
        assert_eq!(many.iter().collect::<HashSet<_>>().len(), many.len());
    }

    #[test]
    fn what_grows_on_drawn_wood_is_named_by_its_stroke() {
        let mut drawn = tree(2);
        drawn.drawn = vec![0, 0, 0];
        let (one, other) = (names(&drawn, &[7]), names(&drawn, &[8]));
        assert!(one.iter().zip(&other).all(|(one, other)| one != other), "{one:?} {other:?}");
        // One more node of the trunk below leaves no name to what stands above it, one more stroke does.
        assert_eq!(names(&drawn, &[7, 9]), one);
    }
}
