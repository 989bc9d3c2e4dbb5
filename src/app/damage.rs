//! What of the window looks different than in the frame before: only that is painted again.
//!
//! Where the processor draws, painting all of a window takes longer than everything else between pen and ink. What egui
//! laid out is compared with the last frame, mesh by mesh: shapes lie in a mesh in order, so what lies between the common
//! beginning and the common end of its corners has changed. Ink, plant and canvas say themselves where they changed.

use egui::epaint::{Primitive, Vertex};
use egui::{ClippedPrimitive, Mesh, Pos2, Rect, TextureId, TexturesDelta};

/// Most separate places; more of them are painted as one.
const MOST: usize = 6;
/// How far smooth edges and rounding reach beyond what is drawn, points.
const MARGIN: f32 = 2.0;

/// Places of the window, in points.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Damage {
    places: Vec<Rect>,
}

impl Damage {
    /// The places, apart from each other.
    pub(super) fn places(&self) -> &[Rect] {
        &self.places
    }

    /// How much of a window it is.
    pub(super) fn share(&self, window: Rect) -> f32 {
        self.places.iter().map(Rect::area).sum::<f32>() / window.area().max(1.0)
    }

    /// Adds a place.
    pub(super) fn add(&mut self, place: Rect) {
        if !place.is_positive() {
            return;
        }
        // Places that touch become one, which may then touch others.
        let mut whole = place;
        while let Some(i) = self.places.iter().position(|known| known.intersects(whole)) {
            whole = whole.union(self.places.swap_remove(i));
        }
        self.places.push(whole);
        if self.places.len() > MOST {
            let all = self.places.drain(..).reduce(|a, b| a.union(b));
            self.places.extend(all);
        }
    }

    /// Whether any of it lies in a place.
    pub(super) fn touches(&self, place: Rect) -> bool {
        self.places.iter().any(|known| known.intersects(place))
    }

    /// Takes out what one frame paints of it: what lies in `first`, then small places before large ones, up to an area of
    /// `most` square points; a place that is larger than what is left of that is cut, and its lower part stays. What it takes
    /// is apart from each other.
    pub(super) fn take(&mut self, first: Rect, most: f32) -> Self {
        let urgent =
            self.places.iter().map(|place| place.intersect(first)).filter(|place| place.is_positive());
        let mut now = Self { places: urgent.collect() };
        let urgent = now.places.len();
        self.places.sort_by(|a, b| b.area().total_cmp(&a.area()));
        let mut left = most;
        while let Some(place) = self.places.pop() {
            let height = (left / place.width()).clamp(0.0, place.height());
            left -= place.area();
            let (strip, rest) = place.split_top_bottom_at_y(place.top() + height);
            now.add_beside(strip, urgent);
            if left < 0.0 {
                self.places.push(rest);
                break;
            }
        }
        now
    }

    /// Adds what of a place lies beside the first few ones.
    fn add_beside(&mut self, place: Rect, first: usize) {
        let mut parts = vec![place];
        for hole in &self.places[..first] {
            parts = parts.into_iter().flat_map(|part| around(part, *hole)).collect();
        }
        self.places.extend(parts.into_iter().filter(Rect::is_positive));
    }

    /// Adds where pictures are shown that are replaced. Not where glyphs are added to that of the fonts: they come where
    /// none were, and text that uses them is new itself.
    pub(super) fn add_pictures(&mut self, textures: &TexturesDelta, now: &[ClippedPrimitive]) {
        let replaced = |id: TextureId| {
            let mut deltas = textures.set.get(&id).into_iter().flatten();
            deltas.any(|delta| id != TextureId::default() || delta.is_whole())
        };
        for primitive in now {
            if let Primitive::Mesh(mesh) = &primitive.primitive
                && replaced(mesh.texture_id)
            {
                self.add(mesh.calc_bounds().expand(MARGIN).intersect(primitive.clip_rect));
            }
        }
    }

    /// Adds where a frame of egui's differs from the one before in a window of this rectangle.
    pub(super) fn compare(&mut self, before: &[ClippedPrimitive], now: &[ClippedPrimitive], window: Rect) {
        let is_alike = before.len() == now.len()
            && before.iter().zip(now).all(|(a, b)| match (&a.primitive, &b.primitive) {
                (Primitive::Mesh(m), Primitive::Mesh(n)) => {
                    a.clip_rect == b.clip_rect && m.texture_id == n.texture_id
                }
                _ => false,
            });
        if !is_alike {
            return self.add(window);
        }
        for (a, b) in before.iter().zip(now) {
            if let (Primitive::Mesh(m), Primitive::Mesh(n)) = (&a.primitive, &b.primitive)
                && let Some(place) = difference(m, n)
            {
                self.add(place.expand(MARGIN).intersect(b.clip_rect).intersect(window));
            }
        }
    }
}

/// What is left of a place around a hole: above, below, left and right of it, some of them empty.
fn around(place: Rect, hole: Rect) -> [Rect; 4] {
    let hole = hole.intersect(place);
    if !hole.is_positive() {
        return [place, Rect::NOTHING, Rect::NOTHING, Rect::NOTHING];
    }
    let (above, rest) = place.split_top_bottom_at_y(hole.top());
    let (beside, below) = rest.split_top_bottom_at_y(hole.bottom());
    let (left, rest) = beside.split_left_right_at_x(hole.left());
    [above, below, left, rest.split_left_right_at_x(hole.right()).1]
}

/// Where two meshes differ; `None` where they do not.
fn difference(before: &Mesh, now: &Mesh) -> Option<Rect> {
    let (a, b) = (&before.vertices, &now.vertices);
    let first = a.iter().zip(b).take_while(|(a, b)| a == b).count();
    if first == a.len() && first == b.len() {
        return (before.indices != now.indices).then(|| now.calc_bounds());
    }
    let last = a[first..].iter().rev().zip(b[first..].iter().rev()).take_while(|(a, b)| a == b).count();
    let changed =
        |all: &'_ [Vertex]| -> Vec<Pos2> { all[first..all.len() - last].iter().map(|v| v.pos).collect() };
    Some(Rect::from_points(&[changed(a), changed(b)].concat()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::epaint::ImageDelta;
    use egui::{Color32, ColorImage, TextureOptions, pos2, vec2};

    const WINDOW: Rect = Rect { min: Pos2::ZERO, max: Pos2 { x: 200.0, y: 100.0 } };

    fn boxes(places: &[(f32, f32)]) -> Vec<ClippedPrimitive> {
        let mut mesh = Mesh::default();
        for &(x, y) in places {
            mesh.add_colored_rect(Rect::from_min_size(pos2(x, y), vec2(5.0, 5.0)), Color32::RED);
        }
        vec![ClippedPrimitive { clip_rect: WINDOW, primitive: Primitive::Mesh(mesh) }]
    }

    fn damage(before: &[(f32, f32)], now: &[(f32, f32)]) -> Vec<Rect> {
        let mut damage = Damage::default();
        damage.compare(&boxes(before), &boxes(now), WINDOW);
        damage.places
    }

    #[test]
    fn only_what_changed_in_a_mesh_is_painted_again() {
        let all = [(10.0, 10.0), (50.0, 10.0), (90.0, 10.0)];
        assert_eq!(damage(&all, &all), []);
        let moved = [all[0], (50.0, 40.0), all[2]];
        assert_eq!(damage(&all, &moved), [Rect::from_min_max(pos2(48.0, 8.0), pos2(57.0, 47.0))]);
        assert_eq!(damage(&all[..2], &all), [Rect::from_min_max(pos2(88.0, 8.0), pos2(97.0, 17.0))]);
        let mut more = Damage::default();
        more.compare(&boxes(&all), &[boxes(&all), boxes(&all)].concat(), WINDOW);
        assert_eq!(more.places, [WINDOW], "another layer");
    }

    #[test]
    fn replaced_pictures_are_painted_again_and_added_glyphs_are_not() {
        let pixels = |at: Option<[usize; 2]>| {
            let image = ColorImage::filled([2, 2], Color32::RED);
            at.map_or_else(
                || ImageDelta::full(image.clone(), TextureOptions::LINEAR),
                |at| ImageDelta::partial(at, image.clone(), TextureOptions::LINEAR),
            )
        };
        let fonts = TextureId::default();
        let picture = TextureId::Managed(7);
        let mut shown = boxes(&[(10.0, 10.0)]);
        shown.extend(boxes(&[(90.0, 10.0)]));
        if let Primitive::Mesh(mesh) = &mut shown[1].primitive {
            mesh.texture_id = picture;
        }
        let damage = |id: TextureId, at| {
            let mut textures = TexturesDelta::default();
            textures.set.entry(id).or_default().push(pixels(at));
            let mut damage = Damage::default();
            damage.add_pictures(&textures, &shown);
            textures.clear();
            damage.places
        };
        let (text, image) = ([8.0, 17.0], [88.0, 97.0]);
        let place = |[from, to]: [f32; 2]| [Rect::from_min_max(pos2(from, 8.0), pos2(to, 17.0))];
        assert_eq!(damage(fonts, Some([0, 0])), [], "a glyph more");
        assert_eq!(damage(fonts, None), place(text), "all glyphs elsewhere");
        assert_eq!(damage(picture, None), place(image));
        assert_eq!(damage(picture, Some([0, 0])), place(image));
    }

    #[test]
    fn a_large_place_is_painted_over_several_frames_and_the_pen_s_first() {
        let mut damage = Damage::default();
        let (large, small) = (
            Rect::from_min_size(pos2(0.0, 0.0), vec2(100.0, 100.0)),
            Rect::from_min_size(pos2(150.0, 0.0), vec2(10.0, 10.0)),
        );
        damage.add(large);
        damage.add(small);
        let pen = Rect::from_min_size(pos2(40.0, 90.0), vec2(20.0, 20.0));
        let first = damage.take(pen, 4100.0);
        let at_pen = Rect::from_min_max(pos2(40.0, 90.0), pos2(60.0, 100.0));
        let strip = |top: f32, bottom: f32| Rect::from_min_max(pos2(0.0, top), pos2(100.0, bottom));
        assert_eq!(first.places, [at_pen, small, strip(0.0, 40.0)]);
        assert!(damage.touches(large) && !damage.touches(small));
        assert_eq!(damage.take(Rect::NOTHING, 4000.0).places, [strip(40.0, 80.0)]);
        assert_eq!(damage.take(Rect::NOTHING, 4000.0).places, [strip(80.0, 100.0)]);
        assert_eq!(damage, Damage::default());
    }

    #[test]
    fn what_lies_at_the_pen_is_painted_once() {
        let mut damage = Damage::default();
        damage.add(Rect::from_min_size(pos2(0.0, 0.0), vec2(100.0, 100.0)));
        let pen = Rect::from_min_size(pos2(40.0, 20.0), vec2(20.0, 30.0));
        let now = damage.take(pen, 20_000.0);
        assert_eq!(damage, Damage::default());
        assert!((now.places.iter().map(Rect::area).sum::<f32>() - 10_000.0).abs() < 1e-3);
        for (i, one) in now.places.iter().enumerate() {
            assert!(now.places[..i].iter().all(|other| !one.intersect(*other).is_positive()), "{one} twice");
        }
        assert_eq!(now.places[0], pen);
    }

    #[test]
    fn places_that_touch_are_painted_once() {
        let mut damage = Damage::default();
        let at = |x: f32| Rect::from_min_size(pos2(x, 0.0), vec2(10.0, 10.0));
        damage.add(at(0.0));
        damage.add(at(40.0));
        damage.add(Rect::NOTHING);
        assert_eq!(damage.places().len(), 2);
        damage.add(Rect::from_min_max(pos2(5.0, 5.0), pos2(45.0, 6.0)));
        assert_eq!(damage.places(), [Rect::from_min_max(pos2(0.0, 0.0), pos2(50.0, 10.0))]);
        (0..20).for_each(|i| damage.add(at(100.0 + 20.0 * i as f32)));
        assert!(damage.places().len() <= MOST);
    }
}
