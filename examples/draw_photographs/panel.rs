//! Lines and areas on a picture.

use glam::Vec2;
use penstemon::picture::decode::Rgba;

/// A picture that is drawn on.
pub(crate) struct Panel {
    pub(crate) picture: Rgba,
}

impl Panel {
    /// A copy of a picture.
    pub(crate) fn of(picture: &Rgba) -> Self {
        Self { picture: picture.clone() }
    }

    /// White paper.
    pub(crate) fn blank((width, height): (u32, u32)) -> Self {
        Self { picture: Rgba { width, height, pixels: vec![255; (4 * width * height) as usize] } }
    }

    fn mix(&mut self, x: u32, y: u32, colour: [u8; 3], share: f32) {
        let pixel = &mut self.picture.pixels.as_chunks_mut::<4>().0[(y * self.picture.width + x) as usize];
        for (c, new) in pixel.iter_mut().zip(colour) {
            *c = (f32::from(*c) + (f32::from(new) - f32::from(*c)) * share).round() as u8;
        }
    }

    /// A line of this thickness.
    pub(crate) fn line(&mut self, from: Vec2, to: Vec2, thick: f32, colour: [u8; 3]) {
        let size = Vec2::new(self.picture.width as f32, self.picture.height as f32);
        let low = (from.min(to) - thick).clamp(Vec2::ZERO, size).as_uvec2();
        let high = (from.max(to) + thick + 1.0).clamp(Vec2::ZERO, size).as_uvec2();
        let along = to - from;
        for y in low.y..high.y {
            for x in low.x..high.x {
                let off = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) - from;
                let share = (off.dot(along) / along.length_squared().max(1e-9)).clamp(0.0, 1.0);
                let ink = (0.5 * thick + 0.5 - off.distance(along * share)).clamp(0.0, 1.0);
                if ink > 0.0 {
                    self.mix(x, y, colour, ink);
                }
            }
        }
    }

    /// A closed line.
    pub(crate) fn closed(&mut self, points: &[Vec2], thick: f32, colour: [u8; 3]) {
        for (a, b) in points.iter().zip(points.iter().cycle().skip(1)) {
            self.line(*a, *b, thick, colour);
        }
    }

    /// A filled disc.
    pub(crate) fn dot(&mut self, at: Vec2, radius: f32, colour: [u8; 3]) {
        self.line(at, at, 2.0 * radius, colour);
    }

    /// The area within a closed line, coloured by place.
    pub(crate) fn fill(&mut self, outline: &[Vec2], colour: impl Fn(Vec2) -> [u8; 3]) {
        for y in 0..self.picture.height {
            let middle = y as f32 + 0.5;
            let crossing = |(a, b): (&Vec2, &Vec2)| {
                ((a.y > middle) != (b.y > middle)).then(|| a.x + (b.x - a.x) * (middle - a.y) / (b.y - a.y))
            };
            let mut crossings: Vec<f32> =
                outline.iter().zip(outline.iter().cycle().skip(1)).filter_map(crossing).collect();
            crossings.sort_by(f32::total_cmp);
            for [from, to] in crossings.as_chunks::<2>().0 {
                for x in from.round() as u32..to.round() as u32 {
                    self.mix(x, y, colour(Vec2::new(x as f32 + 0.5, middle)), 1.0);
                }
            }
        }
    }
}
