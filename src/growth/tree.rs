//! The plant through all its years: nodes and buds in flat arrays that only ever grow at their end.
//!
//! A node is where an internode ends and buds and leaves sit; the internode below a node has its number, and only the
//! feet of the plant have none. Nodes know the year of their birth and of their death, buds the year in which their fate
//! was settled, so the plant of any age is a question to the same arrays, and going back to an age cuts them off.
//! Parents stand before their children. An axis is named by its first node.

use glam::Vec3;

/// No node.
pub(super) const NONE: u32 = u32::MAX;
/// The year of death of what lives, and the year of settling of what is open.
pub(super) const NEVER: u16 = u16::MAX;

/// What became of a bud.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fate {
    /// Nothing yet.
    #[default]
    Dormant,
    /// New internodes.
    Shoot,
    /// A flower.
    Flower,
    /// Nothing, ever.
    Aborted,
    /// It fell with its branch.
    Shed,
}

/// Nodes, in the order in which they grew.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Nodes {
    /// The node below, [`NONE`] for a foot.
    pub parent: Vec<u32>,
    /// Place, metres.
    pub at: Vec<Vec3>,
    /// Unit vector square to the internode: where the first bud of the node points; turns with the phyllotaxis.
    pub side: Vec<Vec3>,
    /// Year of birth; 0 for what was given.
    pub born: Vec<u16>,
    /// Year in which it was shed, or [`NEVER`].
    pub died: Vec<u16>,
    /// First node of its axis. A lateral axis begins with the first node above the one that carries it.
    pub axis: Vec<u32>,
    /// 0 on a trunk, 1 on its branches, and so on.
    pub order: Vec<u8>,
}

/// Buds, in the order in which they were laid down.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Buds {
    /// The node it sits on.
    pub node: Vec<u32>,
    /// Unit direction.
    pub direction: Vec<Vec3>,
    /// Year in which it was laid down.
    pub born: Vec<u16>,
    /// Year in which its fate was settled, or [`NEVER`].
    pub settled: Vec<u16>,
    /// What became of it.
    pub fate: Vec<Fate>,
    /// Whether it continues the axis of its node.
    pub apical: Vec<bool>,
}

/// A plant with its history.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tree {
    /// Nodes and the internodes below them.
    pub nodes: Nodes,
    /// Buds.
    pub buds: Buds,
    /// Buds whose fate is open, in order.
    pub open: Vec<u32>,
    /// Diameters of the first nodes where they were given with the skeleton, metres: wood is never thinner.
    pub given: Vec<f32>,
    /// The drawn branch of each of these nodes, in rising order.
    pub drawn: Vec<u32>,
}

/// A node that is to be added.
#[derive(Clone, Copy, Debug)]
pub struct NewNode {
    /// The node below.
    pub parent: u32,
    /// Place.
    pub at: Vec3,
    /// Direction of its first bud.
    pub side: Vec3,
    /// Whether it begins an axis of its own.
    pub lateral: bool,
    /// Year.
    pub year: u16,
}

impl Tree {
    /// Number of nodes, shed ones counted.
    pub fn len(&self) -> usize {
        self.nodes.parent.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.nodes.parent.is_empty()
    }

    /// Adds a foot.
    pub fn add_foot(&mut self, at: Vec3, side: Vec3) -> u32 {
        let index = self.len() as u32;
        self.push(NONE, index, 0, NewNode { parent: NONE, at, side, lateral: false, year: 0 });
        index
    }

    /// Adds a node above another.
    pub fn add(&mut self, new: NewNode) -> u32 {
        let index = self.len() as u32;
        let below = new.parent as usize;
        let (axis, order) = if new.lateral {
            (index, self.nodes.order[below].saturating_add(1))
        } else {
            (self.nodes.axis[below], self.nodes.order[below])
        };
        self.push(new.parent, axis, order, new);
        index
    }

    fn push(&mut self, parent: u32, axis: u32, order: u8, new: NewNode) {
        let n = &mut self.nodes;
        n.parent.push(parent);
        n.at.push(new.at);
        n.side.push(new.side);
        n.born.push(new.year);
        n.died.push(NEVER);
        n.axis.push(axis);
        n.order.push(order);
    }

    /// Lays down a bud.
    pub fn add_bud(&mut self, node: u32, direction: Vec3, apical: bool, year: u16) {
        let b = &mut self.buds;
        self.open.push(b.node.len() as u32);
        b.node.push(node);
        b.direction.push(direction);
        b.born.push(year);
        b.settled.push(NEVER);
        b.fate.push(Fate::Dormant);
        b.apical.push(apical);
    }

    /// Settles the fate of a bud; it stays in [`Tree::open`] until [`Tree::forget_settled`].
    pub fn settle(&mut self, bud: u32, fate: Fate, year: u16) {
        self.buds.fate[bud as usize] = fate;
        self.buds.settled[bud as usize] = year;
    }

    /// Takes settled buds out of [`Tree::open`].
    pub fn forget_settled(&mut self) {
        let settled = &self.buds.settled;
        self.open.retain(|&b| settled[b as usize] == NEVER);
    }

    /// Whether a node was there at the end of a year.
    pub fn lives(&self, node: usize, year: u16) -> bool {
        self.nodes.born[node] <= year && self.nodes.died[node] > year
    }

    /// How many nodes there are up to the last that was born by the end of a year. Of a tree whose branches have ages of their own some
    /// of these are younger.
    pub fn born_by(&self, year: u16) -> usize {
        self.nodes.born.iter().rposition(|born| *born <= year).map_or(0, |last| last + 1)
    }

    /// Whether a node begins a lateral axis.
    pub fn begins_lateral(&self, node: usize) -> bool {
        self.nodes.axis[node] as usize == node && self.nodes.parent[node] != NONE
    }

    /// Goes back to the end of a year.
    pub fn rewind(&mut self, year: u16) {
        let kept = self.nodes.born.partition_point(|born| *born <= year);
        let n = &mut self.nodes;
        n.parent.truncate(kept);
        n.at.truncate(kept);
        n.side.truncate(kept);
        n.born.truncate(kept);
        n.died.truncate(kept);
        n.axis.truncate(kept);
        n.order.truncate(kept);
        n.died.iter_mut().filter(|died| **died > year).for_each(|died| *died = NEVER);
        let b = &mut self.buds;
        let kept = b.born.partition_point(|born| *born <= year);
        b.node.truncate(kept);
        b.direction.truncate(kept);
        b.born.truncate(kept);
        b.settled.truncate(kept);
        b.fate.truncate(kept);
        b.apical.truncate(kept);
        self.open.clear();
        for (k, settled) in b.settled.iter_mut().enumerate() {
            if *settled > year {
                *settled = NEVER;
                b.fate[k] = Fate::Dormant;
                self.open.push(k as u32);
            }
        }
    }

    /// Checks what the other parts rely on; called by tests.
    ///
    /// # Errors
    /// The first violation, in words.
    pub fn check_invariants(&self) -> Result<(), String> {
        let n = &self.nodes;
        for i in 0..self.len() {
            let parent = n.parent[i];
            if parent != NONE {
                let p = parent as usize;
                let below = p < i && n.born[p] <= n.born[i];
                if !below {
                    return Err(format!("node {i}: its parent stands after it"));
                }
                if n.died[p] < n.died[i] {
                    return Err(format!("node {i}: outlives what carries it"));
                }
                let continues = n.axis[i] == n.axis[p] && n.order[i] == n.order[p];
                if !continues && n.axis[i] as usize != i {
                    return Err(format!("node {i}: axis {}", n.axis[i]));
                }
            }
            if !n.at[i].is_finite() || !n.side[i].is_finite() {
                return Err(format!("node {i}: not finite"));
            }
        }
        if !n.born.is_sorted() || !self.buds.born.is_sorted() {
            return Err("births out of order".to_owned());
        }
        let open = |b: &u32| self.buds.settled[*b as usize] == NEVER;
        if !self.open.iter().all(open) || !self.open.is_sorted() {
            return Err("a settled bud is open".to_owned());
        }
        Ok(())
    }
}
