//! Who gets how much: the extended Borchert–Honda model (001 §2.3.1, eq. 2.4).
//!
//! First the resource of all buds runs down to the root: what passes through an internode is the sum over the buds
//! above. Then v = α·Q of the root runs up again: at each node the part λQ_m : (1 − λ)Q_l goes to the continuing axis and
//! to the laterals. λ > 0.5 makes leaders, λ < 0.5 shrubs. Several laterals of a node share theirs by their Q. Nothing
//! is lost: the buds together get exactly what the roots give. Where only one side has any resource it gets all.
//!
//! Both passes are one sweep over the nodes, down in falling order, up in rising order, since parents stand first.

use crate::growth::tree::{NONE, Tree};

/// What flows through the nodes in one year, and what arrives at the open buds.
#[derive(Clone, Debug, Default)]
pub(crate) struct Flow {
    /// Resource from the continuing axis above each node.
    pub main: Vec<f32>,
    /// Resource from the laterals above each node.
    pub side: Vec<f32>,
    /// What each node gets to share out.
    pub v: Vec<f32>,
    /// What each open bud gets.
    pub bud: Vec<f32>,
}

impl Flow {
    /// Runs the resource `q` of the open buds down to the feet.
    pub(crate) fn gather(&mut self, tree: &Tree, q: &[f32]) {
        for field in [&mut self.main, &mut self.side] {
            field.clear();
            field.resize(tree.len(), 0.0);
        }
        for (&bud, &q) in tree.open.iter().zip(q) {
            let node = tree.buds.node[bud as usize] as usize;
            let into = if tree.buds.apical[bud as usize] { &mut self.main } else { &mut self.side };
            into[node] += q;
        }
        let nodes = &tree.nodes;
        for i in (0..tree.len()).rev() {
            let (q, parent) = (self.main[i] + self.side[i], nodes.parent[i]);
            if q > 0.0 && parent != NONE {
                let parent = parent as usize;
                let into = if nodes.axis[i] == nodes.axis[parent] { &mut self.main } else { &mut self.side };
                into[parent] += q;
            }
        }
    }

    /// Resource that passes a node.
    pub(crate) fn through(&self, node: usize) -> f32 {
        self.main[node] + self.side[node]
    }

    /// Shares α·Q of each foot out by eq. 2.4; `lambda` gives λ for an order of branching.
    pub(crate) fn share_out(&mut self, tree: &Tree, q: &[f32], supply: f32, lambda: impl Fn(u8) -> f32) {
        let nodes = &tree.nodes;
        let lambdas: Vec<f32> = (0..=u8::MAX).map(lambda).collect();
        let part = |main: f32, side: f32, node: usize, continues: bool| {
            let lambda = lambdas[nodes.order[node] as usize];
            let (wm, wl) = (lambda * main, (1.0 - lambda) * side);
            let whole = wm + wl;
            if whole > 0.0 {
                return if continues { lambda / whole } else { (1.0 - lambda) / whole };
            }
            let whole = main + side;
            if whole > 0.0 { 1.0 / whole } else { 0.0 }
        };
        self.v.clear();
        self.v.resize(tree.len(), 0.0);
        for i in 0..tree.len() {
            let (through, parent) = (self.through(i), nodes.parent[i]);
            if through <= 0.0 {
                continue;
            }
            self.v[i] = if parent == NONE {
                supply * through
            } else {
                let p = parent as usize;
                let continues = nodes.axis[i] == nodes.axis[p];
                self.v[p] * through * part(self.main[p], self.side[p], p, continues)
            };
        }
        self.bud.clear();
        self.bud.extend(tree.open.iter().zip(q).map(|(&bud, &q)| {
            let node = tree.buds.node[bud as usize] as usize;
            let continues = tree.buds.apical[bud as usize];
            self.v[node] * q * part(self.main[node], self.side[node], node, continues)
        }));
    }
}
