//! What of egui's meshes may be seen in some places of the window.
//!
//! egui puts all shapes of a layer into one mesh, a whole panel for instance. Where the processor draws, a place of the size
//! of a word would take as long as the panel: each of its triangles is set up before it is found to lie elsewhere. So every
//! place gets meshes of the triangles that reach into it.

use egui::epaint::Primitive;
use egui::{ClippedPrimitive, Mesh, Rect};

/// A corner that no triangle of a place has needed yet.
const UNUSED: u32 = u32::MAX;

/// For each of the places, one after the other, the meshes that reach into it in their order, each clipped to the place.
pub(super) fn within(primitives: &[ClippedPrimitive], places: &[Rect]) -> Vec<ClippedPrimitive> {
    let mut number = Vec::new();
    let mut cut = Vec::new();
    for place in places {
        for ClippedPrimitive { clip_rect, primitive } in primitives {
            let clip_rect = clip_rect.intersect(*place);
            if !clip_rect.is_positive() {
                continue;
            }
            let primitive = match primitive {
                Primitive::Mesh(mesh) => match reaching(mesh, clip_rect, &mut number) {
                    mesh if mesh.is_empty() => continue,
                    mesh => Primitive::Mesh(mesh),
                },
                Primitive::Callback(callback) => Primitive::Callback(callback.clone()),
            };
            cut.push(ClippedPrimitive { clip_rect, primitive });
        }
    }
    cut
}

/// The triangles of a mesh that reach into a place. `number` is room for the new numbers of its corners.
fn reaching(mesh: &Mesh, place: Rect, number: &mut Vec<u32>) -> Mesh {
    number.clear();
    number.resize(mesh.vertices.len(), UNUSED);
    let mut cut = Mesh::with_texture(mesh.texture_id);
    for triangle in mesh.indices.chunks_exact(3) {
        let corners = [triangle[0], triangle[1], triangle[2]];
        let around = corners.map(|c| mesh.vertices[c as usize].pos);
        if !Rect::from_points(&around).intersects(place) {
            continue;
        }
        for corner in corners {
            let new = &mut number[corner as usize];
            if *new == UNUSED {
                *new = cut.vertices.len() as u32;
                cut.vertices.push(mesh.vertices[corner as usize]);
            }
            cut.indices.push(*new);
        }
    }
    cut
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Color32, pos2, vec2};

    /// A hundred boxes in a row, ten points apart, in one mesh that is seen up to x = 800.
    fn row() -> Vec<ClippedPrimitive> {
        let mut mesh = Mesh::default();
        for k in 0..100 {
            let at = pos2(10.0 * k as f32, 0.0);
            mesh.add_colored_rect(Rect::from_min_size(at, vec2(5.0, 5.0)), Color32::from_gray(k));
        }
        let clip_rect = Rect::from_min_size(pos2(0.0, 0.0), vec2(800.0, 50.0));
        vec![ClippedPrimitive { clip_rect, primitive: Primitive::Mesh(mesh) }]
    }

    fn greys(cut: &ClippedPrimitive) -> Vec<u8> {
        let Primitive::Mesh(mesh) = &cut.primitive else { panic!("a mesh") };
        assert!(mesh.is_valid());
        let mut greys: Vec<u8> = mesh.indices.iter().map(|i| mesh.vertices[*i as usize].color.r()).collect();
        assert_eq!(greys.len() % 6, 0, "whole boxes");
        greys.dedup();
        greys
    }

    #[test]
    fn each_place_gets_what_reaches_into_it_in_order() {
        let place = |left: f32, right: f32| Rect::from_min_max(pos2(left, -5.0), pos2(right, 60.0));
        let (one, other) = (place(18.0, 42.0), place(790.0, 1000.0));
        let cut = within(&row(), &[one, place(6.0, 9.0), other]);
        let clips: Vec<Rect> = cut.iter().map(|c| c.clip_rect).collect();
        let clip = row()[0].clip_rect;
        assert_eq!(clips, [one.intersect(clip), other.intersect(clip)]);
        assert_eq!(cut.iter().map(greys).collect::<Vec<_>>(), [vec![2, 3, 4], vec![79, 80]]);
    }

    #[test]
    fn the_whole_window_gets_all_that_is_seen() {
        let cut = within(&row(), &[Rect::EVERYTHING]);
        assert_eq!(greys(&cut[0]).len(), 81);
        assert!(within(&row(), &[]).is_empty());
    }
}
