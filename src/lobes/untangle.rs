//! A surface that encloses something and nowhere crosses itself.
//!
//! Faces are wound so that the volume is above 0. A surface that is sound and of which no face crosses another stays as it is.
//! Any other becomes the surface of all that it encloses, by winding numbers on a [grid](super::grid).
//!
//! Source: 001 has no such step; its strokes are taken to be drawn well. Limits: those of the grid, where it is needed.

use super::grid::Grid;
use super::surface::Surface;
use crate::geom::crossing::crossing;

/// Least volume as a share of the cube of the surface's size: what is flatter is no lobe.
pub(super) const FLATTEST: f64 = 1e-6;

/// Whether a surface is sound and no face of it crosses another.
pub(super) fn is_clean(surface: &Surface) -> bool {
    let crosses = || crossing(&surface.points, &surface.triangles);
    surface.check_invariants().is_ok() && crosses().is_some_and(|faces| !faces.contains(&true))
}

/// The surface with its faces outward and without crossings, and whether it had to be made anew; `None` if it encloses
/// nothing.
pub(super) fn untangled(mut surface: Surface) -> Option<(Surface, bool)> {
    if surface.signed_volume() < 0.0 {
        surface.flip();
    }
    if is_clean(&surface) {
        return (!is_flat(&surface)).then_some((surface, false));
    }
    let anew = Grid::of_winding(&surface, f32::NEG_INFINITY).surface();
    (!is_flat(&anew)).then_some((anew, true))
}

/// The part of a clean surface above a height; `None` if there is none.
pub(super) fn above(surface: &Surface, floor: f32) -> Option<Surface> {
    let part = Grid::of_winding(surface, floor).surface();
    (!is_flat(&part)).then_some(part)
}

/// Whether a surface encloses hardly anything of the cube around it.
fn is_flat(surface: &Surface) -> bool {
    let (low, high) = surface.bounds();
    let cube = f64::from((high - low).max_element()).powi(3);
    let encloses = surface.signed_volume() > FLATTEST * cube;
    !encloses
}

#[cfg(test)]
mod tests {
    use super::super::surface::tests::tetrahedron;
    use super::*;
    use glam::Vec3;

    #[test]
    fn a_body_inside_out_is_turned() {
        let mut surface = tetrahedron();
        surface.flip();
        assert_eq!(untangled(surface), Some((tetrahedron(), false)));
    }

    #[test]
    fn bodies_through_each_other_become_one() {
        let mut both = tetrahedron();
        let second = tetrahedron();
        both.points.extend(second.points.iter().map(|p| *p + Vec3::new(0.21, 0.13, 0.17)));
        both.triangles.extend(second.triangles.iter().map(|t| t.map(|i| i + 4)));
        let (one, anew) = untangled(both).unwrap();
        assert!(anew && is_clean(&one));
        assert!(
            one.signed_volume() > 1.2 / 6.0 && one.signed_volume() < 2.0 / 6.0,
            "{}",
            one.signed_volume()
        );
    }

    #[test]
    fn what_is_flat_is_nothing() {
        let mut flat = tetrahedron();
        flat.points[3] = Vec3::new(0.3, 0.3, 1e-8);
        assert_eq!(untangled(flat), None);
        assert!(above(&tetrahedron(), 0.5).is_some() && above(&tetrahedron(), 2.0).is_none());
    }
}
