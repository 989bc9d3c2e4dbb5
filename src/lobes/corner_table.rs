//! A closed surface whose edges can be split, collapsed and flipped: each half-edge knows its twin.
//!
//! Half-edge h belongs to face h / 3 and runs from its corner h % 3 to the next one. Faces that are gone keep their place until the
//! surface is read out. An operation that would leave the surface no longer closed and manifold does not happen.

use super::surface::Surface;
use glam::Vec3;

/// No face, no half-edge.
const NONE: u32 = u32::MAX;

/// The surface.
#[derive(Clone, Debug)]
pub(super) struct CornerTable {
    /// Places of the vertices; those that are gone stay.
    pub(super) points: Vec<Vec3>,
    faces: Vec<[u32; 3]>,
    twins: Vec<u32>,
    /// A half-edge out of each vertex; none where the vertex is gone.
    out: Vec<u32>,
    /// Which half-edges are creases.
    crease: Vec<bool>,
}

fn next(h: u32) -> u32 {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}

fn previous(h: u32) -> u32 {
    if h.is_multiple_of(3) { h + 2 } else { h - 1 }
}

impl CornerTable {
    /// A surface in which every edge has two faces; `None` for any other.
    pub(super) fn new(surface: &Surface) -> Option<Self> {
        let faces = surface.triangles.clone();
        let mut edges: Vec<(u32, u32, u32)> = Vec::with_capacity(3 * faces.len());
        for (f, t) in faces.iter().enumerate() {
            let h = 3 * f as u32;
            edges.extend([(t[0], t[1], h), (t[1], t[2], h + 1), (t[2], t[0], h + 2)]);
        }
        edges.sort_unstable();
        let mut twins = vec![NONE; 3 * faces.len()];
        for (a, b, h) in &edges {
            let found = edges.binary_search_by(|e| (e.0, e.1).cmp(&(*b, *a))).ok()?;
            twins[*h as usize] = edges[found].2;
        }
        let mut out = vec![NONE; surface.points.len()];
        edges.iter().for_each(|(a, _, h)| out[*a as usize] = *h);
        let crease = vec![false; twins.len()];
        let closed = twins.iter().zip(0..).all(|(t, h)| twins[*t as usize] == h);
        closed.then(|| Self { points: surface.points.clone(), faces, twins, out, crease })
    }

    /// The surface as it is now.
    pub(super) fn surface(&self) -> Surface {
        let triangles = self.faces.iter().filter(|t| t[0] != NONE).copied().collect();
        let mut surface = Surface { points: self.points.clone(), triangles };
        surface.compact();
        surface
    }

    /// Number of half-edges, gone ones counted.
    pub(super) fn half_edges(&self) -> u32 {
        self.twins.len() as u32
    }

    /// Whether a half-edge is there.
    pub(super) fn lives(&self, h: u32) -> bool {
        self.faces[h as usize / 3][0] != NONE
    }

    /// Whether a vertex is there.
    pub(super) fn has_vertex(&self, v: u32) -> bool {
        self.out[v as usize] != NONE
    }

    /// The vertex that a half-edge leaves.
    pub(super) fn from(&self, h: u32) -> u32 {
        self.faces[h as usize / 3][h as usize % 3]
    }

    /// The vertex that it leads to.
    pub(super) fn to(&self, h: u32) -> u32 {
        self.from(next(h))
    }

    /// The vertex across from it in its face.
    pub(super) fn across(&self, h: u32) -> u32 {
        self.from(previous(h))
    }

    /// The half-edge on the other side.
    pub(super) fn twin(&self, h: u32) -> u32 {
        self.twins[h as usize]
    }

    /// Squared length.
    pub(super) fn squared(&self, h: u32) -> f32 {
        self.points[self.from(h) as usize].distance_squared(self.points[self.to(h) as usize])
    }

    /// The larger squared length of the two other edges of its face.
    pub(super) fn longest_beside(&self, h: u32) -> f32 {
        self.squared(next(h)).max(self.squared(previous(h)))
    }

    /// Whether a half-edge is a crease.
    pub(super) fn is_crease(&self, h: u32) -> bool {
        self.crease[h as usize]
    }

    /// Marks an edge as a crease.
    pub(super) fn mark_crease(&mut self, h: u32) {
        self.crease[h as usize] = true;
        let twin = self.twin(h);
        self.crease[twin as usize] = true;
    }

    /// The half-edges out of a vertex, all around it.
    pub(super) fn around(&self, v: u32) -> impl Iterator<Item = u32> + '_ {
        let first = self.out[v as usize];
        let mut at = (first != NONE).then_some(first);
        std::iter::from_fn(move || {
            let h = at?;
            let after = self.twin(previous(h));
            at = (after != first).then_some(after);
            Some(h)
        })
    }

    /// Neighbours of a vertex.
    pub(super) fn valence(&self, v: u32) -> usize {
        self.around(v).count()
    }

    /// Twice the area of a face as a vector out of it.
    pub(super) fn area(&self, face: u32) -> Vec3 {
        let [a, b, c] = self.faces[face as usize].map(|v| self.points[v as usize]);
        (b - a).cross(c - a)
    }

    fn link(&mut self, h: u32, other: u32) {
        self.twins[h as usize] = other;
        self.twins[other as usize] = h;
    }

    fn set_crease(&mut self, h: u32, is: bool) {
        self.crease[h as usize] = is;
    }

    fn add_face(&mut self, corners: [u32; 3]) -> u32 {
        let h = self.half_edges();
        self.faces.push(corners);
        self.twins.extend([NONE; 3]);
        self.crease.extend([false; 3]);
        h
    }

    /// Splits an edge at a place; gives the new vertex.
    pub(super) fn split(&mut self, h: u32, at: Vec3) -> u32 {
        let m = self.points.len() as u32;
        self.points.push(at);
        self.out.push(NONE);
        let t = self.twin(h);
        let crease = self.is_crease(h);
        let halves = [h, t].map(|h| self.split_face(h, m));
        self.link(h, halves[1]);
        self.link(t, halves[0]);
        halves.into_iter().for_each(|half| self.set_crease(half, crease));
        self.out[m as usize] = next(h);
        m
    }

    /// Splits the face of a half-edge a → b at the vertex m on it: h becomes a → m; gives m → b.
    fn split_face(&mut self, h: u32, m: u32) -> u32 {
        let (b, c, side) = (self.to(h), self.across(h), next(h));
        let (outer, crease) = (self.twin(side), self.is_crease(side));
        let half = self.add_face([m, b, c]);
        self.faces[side as usize / 3][side as usize % 3] = m;
        self.link(half + 1, outer);
        self.link(half + 2, side);
        self.set_crease(half + 1, crease);
        self.set_crease(side, false);
        self.out[b as usize] = half + 1;
        if self.out[c as usize] == NONE {
            self.out[c as usize] = half + 2;
        }
        half
    }

    /// Turns an edge in the four-sided figure of its two faces, if the surface stays as it is otherwise.
    pub(super) fn flip(&mut self, h: u32) -> bool {
        let t = self.twin(h);
        let (a, b, c, d) = (self.from(h), self.to(h), self.across(h), self.across(t));
        if c == d || self.around(c).any(|e| self.to(e) == d) {
            return false;
        }
        let keep = |table: &Self, e: u32| (table.twin(e), table.is_crease(e));
        let (bc, ca) = (keep(self, next(h)), keep(self, previous(h)));
        let (ad, db) = (keep(self, next(t)), keep(self, previous(t)));
        let (f, g) = (h / 3, t / 3);
        self.faces[f as usize] = [a, d, c];
        self.faces[g as usize] = [d, b, c];
        let (f, g) = (3 * f, 3 * g);
        for (h, (twin, crease)) in [(f, ad), (f + 2, ca), (g, db), (g + 1, bc)] {
            self.link(h, twin);
            self.set_crease(h, crease);
        }
        self.link(f + 1, g + 2);
        self.set_crease(f + 1, false);
        self.set_crease(g + 2, false);
        for (v, h) in [(a, f), (d, g), (b, g + 1), (c, f + 2)] {
            self.out[v as usize] = h;
        }
        true
    }

    /// Whether the first vertex of an edge can become the second without the surface touching itself: both have two common neighbours,
    /// of which each keeps at least three.
    pub(super) fn may_collapse(&self, h: u32) -> bool {
        let (a, b) = (self.from(h), self.to(h));
        let (c, d) = (self.across(h), self.across(self.twin(h)));
        let common = self.around(a).filter(|e| {
            let v = self.to(*e);
            self.around(b).any(|e| self.to(e) == v)
        });
        common.count() == 2 && c != d && self.valence(c) > 3 && self.valence(d) > 3
    }

    /// Lets the first vertex of an edge become the second; ask [`Self::may_collapse`] before.
    pub(super) fn collapse(&mut self, h: u32) {
        let t = self.twin(h);
        let (a, b, c, d) = (self.from(h), self.to(h), self.across(h), self.across(t));
        let leaving: Vec<u32> = self.around(a).collect();
        for e in leaving {
            self.faces[e as usize / 3][e as usize % 3] = b;
        }
        let seams = [h, t].map(|h| {
            let (one, other) = (self.twin(next(h)), self.twin(previous(h)));
            let crease = self.is_crease(one) || self.is_crease(other);
            self.link(one, other);
            self.set_crease(one, crease);
            self.set_crease(other, crease);
            [one, other]
        });
        for gone in [h / 3, t / 3] {
            self.faces[gone as usize] = [NONE; 3];
        }
        self.out[a as usize] = NONE;
        for h in seams.into_iter().flatten() {
            let from = self.from(h);
            debug_assert!(from == b || from == c || from == d, "seams lie between these");
            self.out[from as usize] = h;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::surface::tests::tetrahedron;
    use super::*;

    fn check(table: &CornerTable) {
        assert_eq!(table.surface().check_edges(), Ok(()));
        for h in (0..table.half_edges()).filter(|h| table.lives(*h)) {
            let t = table.twin(h);
            assert!(table.lives(t) && table.twin(t) == h);
            assert_eq!((table.from(h), table.to(h)), (table.to(t), table.from(t)));
            assert_eq!(table.from(table.out[table.from(h) as usize]), table.from(h));
        }
    }

    #[test]
    fn any_walk_of_splits_flips_and_collapses_stays_closed() {
        let mut table = CornerTable::new(&tetrahedron()).unwrap();
        let mut random = 12345u32;
        let mut draw = |below: u32| {
            random = random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (random >> 8) % below
        };
        for step in 0..3000 {
            let h = draw(table.half_edges());
            if !table.lives(h) {
                continue;
            }
            match draw(4) {
                0 | 1 if step < 600 => {
                    let at =
                        table.points[table.from(h) as usize].lerp(table.points[table.to(h) as usize], 0.4);
                    table.split(h, at);
                }
                2 => drop(table.flip(h)),
                _ if table.may_collapse(h) => table.collapse(h),
                _ => {}
            }
            if step % 50 == 0 {
                check(&table);
            }
        }
        check(&table);
        let surface = table.surface();
        let edges = 3 * surface.triangles.len() / 2;
        assert_eq!(surface.points.len() + surface.triangles.len(), edges + 2, "Euler's number of a ball");
    }

    #[test]
    fn open_surfaces_have_no_table() {
        let mut open = tetrahedron();
        open.triangles.pop();
        assert!(CornerTable::new(&open).is_none());
    }
}
