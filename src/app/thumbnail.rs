//! A small picture of a drawing, made without a graphics card: for the list of drawings that were found again.
//!
//! Strokes are lines of even width, each pixel as dark as the line covers it.

use crate::sketch::Sketch;
use egui::{Color32, ColorImage};
use glam::Vec2;

/// Share of the picture left free on each side.
const MARGIN: f32 = 0.08;
/// Half the width of a line, pixels.
const HALF_WIDTH: f32 = 0.8;

/// A picture of the whole drawing, `size` pixels wide and high.
pub(super) fn of_drawing(sketch: &Sketch, size: [usize; 2], paper: Color32, ink: Color32) -> ColorImage {
    let mut cover = vec![0.0f32; size[0] * size[1]];
    let room = Vec2::new(size[0] as f32, size[1] as f32);
    if let Some((low, high)) = sketch.bounds() {
        let extent = (high - low).max(Vec2::splat(1e-3));
        let scale = ((1.0 - 2.0 * MARGIN) * room / extent).min_element();
        let place = |p: Vec2| (p - 0.5 * (low + high)) * scale + 0.5 * room;
        for stroke in &sketch.strokes {
            let points: Vec<Vec2> = stroke.points.iter().map(|p| place(p.position)).collect();
            points.windows(2).for_each(|ends| draw(&mut cover, size, ends[0], ends[1]));
        }
    }
    let pixels = cover.iter().map(|&share| paper.lerp_to_gamma(ink, share)).collect();
    ColorImage::new(size, pixels)
}

fn draw(cover: &mut [f32], [width, height]: [usize; 2], a: Vec2, b: Vec2) {
    let reach = HALF_WIDTH + 1.0;
    let most = Vec2::new(width as f32 - 1.0, height as f32 - 1.0);
    let low = (a.min(b) - reach).clamp(Vec2::ZERO, most).as_uvec2();
    let high = (a.max(b) + reach).clamp(Vec2::ZERO, most).as_uvec2();
    for y in low.y..=high.y {
        for x in low.x..=high.x {
            let p = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
            let t = ((p - a).dot(b - a) / (b - a).length_squared().max(1e-9)).clamp(0.0, 1.0);
            let share = (HALF_WIDTH + 0.5 - p.distance(a.lerp(b, t))).clamp(0.0, 1.0);
            let pixel = &mut cover[y as usize * width + x as usize];
            *pixel = pixel.max(share);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sketch::{Stroke, StrokePoint, Tool};

    #[test]
    fn a_stroke_is_ink_on_paper_inside_the_margin() {
        let points = [Vec2::ZERO, Vec2::new(100.0, 0.0)].map(StrokePoint::at).to_vec();
        let stroke = Stroke { id: 1, tool: Tool::Auto, points, brush: None };
        let sketch = Sketch { strokes: vec![stroke.into()], ..Sketch::empty() };
        let picture = of_drawing(&sketch, [48, 36], Color32::WHITE, Color32::BLACK);
        assert!(picture.pixels[18 * 48 + 24].r() < 100);
        assert_eq!(picture.pixels[2 * 48 + 24], Color32::WHITE);
        assert_eq!(picture.pixels[18 * 48], Color32::WHITE);
    }

    #[test]
    fn an_empty_drawing_is_blank_paper() {
        let picture = of_drawing(&Sketch::empty(), [4, 4], Color32::WHITE, Color32::BLACK);
        assert!(picture.pixels.iter().all(|p| *p == Color32::WHITE));
    }
}
