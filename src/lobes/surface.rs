//! A closed surface of triangles: what every stage of a lobe hands to the next.
//!
//! Points are kept once, faces are counter-clockwise seen from outside. [`Surface::check_invariants`] says what a finished
//! lobe promises; between the stages a surface may fold or cross itself, but its faces always join to closed shells.

use crate::geom::face_tree::FaceTree;
use glam::{DVec3, Vec3};

/// A closed surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Places, metres.
    pub points: Vec<Vec3>,
    /// Faces by their points.
    pub triangles: Vec<[u32; 3]>,
}

impl Surface {
    /// The places of a face's corners.
    pub fn corners(&self, triangle: [u32; 3]) -> [Vec3; 3] {
        triangle.map(|i| self.points[i as usize])
    }

    /// Its faces, to be asked for the nearest point.
    pub fn face_tree(&self) -> FaceTree {
        FaceTree::new(self.triangles.iter().map(|t| self.corners(*t)))
    }

    /// Smallest and largest corner; of a surface without points both are the origin.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let Some(first) = self.points.first() else { return (Vec3::ZERO, Vec3::ZERO) };
        self.points.iter().fold((*first, *first), |(low, high), p| (low.min(*p), high.max(*p)))
    }

    /// Cubic metres that are enclosed; negative where faces are wound the other way.
    pub fn signed_volume(&self) -> f64 {
        let (low, high) = self.bounds();
        let middle = low.midpoint(high).as_dvec3();
        let six = self.triangles.iter().map(|t| {
            let [a, b, c] = self.corners(*t).map(|p| p.as_dvec3() - middle);
            a.dot(b.cross(c))
        });
        six.sum::<f64>() / 6.0
    }

    /// Turns the surface inside out.
    pub fn flip(&mut self) {
        self.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    }

    /// Unit normals of the points, faces weighted by area.
    pub fn normals(&self) -> Vec<Vec3> {
        let mut sums = vec![DVec3::ZERO; self.points.len()];
        for t in &self.triangles {
            let [a, b, c] = self.corners(*t).map(Vec3::as_dvec3);
            let cross = (b - a).cross(c - a);
            t.iter().for_each(|i| sums[*i as usize] += cross);
        }
        sums.into_iter().map(|sum| sum.normalize_or(DVec3::Y).as_vec3()).collect()
    }

    /// Leaves out points that no face has.
    pub fn compact(&mut self) {
        let mut place = vec![u32::MAX; self.points.len()];
        let mut kept = Vec::new();
        for i in self.triangles.iter_mut().flatten() {
            let of = &mut place[*i as usize];
            if *of == u32::MAX {
                *of = kept.len() as u32;
                kept.push(self.points[*i as usize]);
            }
            *i = *of;
        }
        self.points = kept;
    }

    /// Checks that it is closed, manifold and wound alike, with finite points that are all used and faces that have an area.
    ///
    /// # Errors
    /// The first violation, in words.
    pub fn check_invariants(&self) -> Result<(), String> {
        let count = self.points.len() as u32;
        if let Some(t) = self.triangles.iter().find(|t| t.iter().any(|i| *i >= count)) {
            return Err(format!("face {t:?} has a point out of range"));
        }
        if let Some(i) = self.points.iter().position(|p| !p.is_finite()) {
            return Err(format!("point {i} is not finite"));
        }
        for t in &self.triangles {
            let [a, b, c] = self.corners(*t).map(Vec3::as_dvec3);
            let longest = (b - a).length().max((c - b).length()).max((a - c).length());
            if (b - a).cross(c - a).length() <= 1e-9 * longest * longest {
                return Err(format!("face {t:?} has no area"));
            }
        }
        self.check_edges()?;
        self.check_fans()
    }

    /// Every edge has exactly two faces, which run along it in opposite directions.
    pub(super) fn check_edges(&self) -> Result<(), String> {
        let sides = |t: &[u32; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
        let mut edges: Vec<[u32; 2]> = self.triangles.iter().flat_map(sides).collect();
        edges.sort_unstable();
        if let Some(twice) = edges.windows(2).find(|w| w[0] == w[1]) {
            return Err(format!("edge {:?} is used twice in one direction", twice[0]));
        }
        match edges.iter().find(|[a, b]| edges.binary_search(&[*b, *a]).is_err()) {
            Some(open) => Err(format!("edge {open:?} has one face")),
            None => Ok(()),
        }
    }

    /// The faces around every point form one closed fan of at least three.
    fn check_fans(&self) -> Result<(), String> {
        let wedges = |t: &[u32; 3]| [[t[0], t[1], t[2]], [t[1], t[2], t[0]], [t[2], t[0], t[1]]];
        let mut wedges: Vec<[u32; 3]> = self.triangles.iter().flat_map(wedges).collect();
        wedges.sort_unstable();
        let mut used = 0;
        for fan in wedges.chunk_by(|x, y| x[0] == y[0]) {
            used += 1;
            let (mut at, mut steps) = (fan[0][1], 0);
            loop {
                let next = fan.binary_search_by_key(&at, |w| w[1]).map_err(|_| "an open fan".to_owned())?;
                (at, steps) = (fan[next][2], steps + 1);
                if at == fan[0][1] {
                    break;
                }
                if steps > fan.len() {
                    return Err(format!("the fan of point {} never closes", fan[0][0]));
                }
            }
            if steps != fan.len() || steps < 3 {
                return Err(format!("point {} joins two surfaces or has two faces", fan[0][0]));
            }
        }
        if used == self.points.len() { Ok(()) } else { Err("a point has no face".to_owned()) }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(in crate::lobes) fn tetrahedron() -> Surface {
        let points = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        Surface { points, triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] }
    }

    #[test]
    fn a_tetrahedron_is_sound_and_has_its_volume() {
        let mut surface = tetrahedron();
        assert_eq!(surface.check_invariants(), Ok(()));
        assert!((surface.signed_volume() - 1.0 / 6.0).abs() < 1e-9);
        surface.flip();
        assert!((surface.signed_volume() + 1.0 / 6.0).abs() < 1e-9);
        assert_eq!(surface.check_invariants(), Ok(()));
    }

    #[test]
    fn every_defect_is_named() {
        let complaint = |spoil: fn(&mut Surface)| {
            let mut surface = tetrahedron();
            spoil(&mut surface);
            surface.check_invariants().unwrap_err()
        };
        assert!(complaint(|s| s.triangles[0][0] = 9).contains("out of range"));
        assert!(complaint(|s| s.points[1].x = f32::NAN).contains("not finite"));
        assert!(complaint(|s| s.points[1] = Vec3::ZERO).contains("no area"));
        assert!(complaint(|s| s.triangles.truncate(3)).contains("one face"));
        assert!(complaint(|s| s.triangles.push(s.triangles[0])).contains("twice"));
        assert!(complaint(|s| s.points.push(Vec3::ONE)).contains("has no face"));
    }

    #[test]
    fn points_without_faces_are_left_out() {
        let mut surface = tetrahedron();
        surface.points.insert(0, Vec3::ONE);
        surface.triangles.iter_mut().flatten().for_each(|i| *i += 1);
        surface.compact();
        assert_eq!(surface.points.len(), 4);
        assert_eq!(surface.check_invariants(), Ok(()));
    }
}
