//! A flower in perspective: petals on a cone, projected onto the sheet.
//!
//! Each petal's outline is flat paper: the cone is slit open, the outline drawn on it, and the cone rolled up again
//! (distance ρ from the apex stays, the angle ψ from the petal's midline becomes ψ / sin β of azimuth for an opening
//! angle β between axis and petal). The apex is the flower's heart. The projection is orthographic, so the tips lie on
//! the foreshortened ellipse from which a flower's pose is recovered.

use super::form::Form;
use super::hand::{Drawn, Hand, toward};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// How a flower stands.
#[derive(Clone, Copy)]
pub struct Flower {
    /// Its heart on the sheet, pixels.
    pub heart: DVec2,
    /// Length of a petal in pixels, measured along the petal.
    pub length: f64,
    /// Number of petals.
    pub petals: u32,
    /// Direction in which the flower's axis points on the sheet, degrees, 0 to the right, 90 up.
    pub faces: f64,
    /// Angle in degrees between axis and sheet, 90 when the flower looks at the viewer.
    pub lift: f64,
    /// Angle in degrees between axis and petals.
    pub opening: f64,
    /// Azimuth of the first petal in degrees.
    pub turn: f64,
    /// Degrees by which petals swing round the axis from root to tip, as in a pinwheel.
    pub swing: f64,
    /// Degrees by which petals open further toward the tip.
    pub recurve: f64,
    /// Breadth of the petals relative to their form.
    pub width: f64,
    /// Irregularity from petal to petal, 1 for a healthy flower.
    pub unrest: f64,
}

impl Flower {
    /// A flower of the given size that `faces` a direction and is lifted out of the sheet, with five petals open at 60°.
    pub fn new(heart: DVec2, length: f64, faces: f64, lift: f64) -> Self {
        Self {
            heart,
            length,
            petals: 5,
            faces,
            lift,
            opening: 60.0,
            turn: 0.0,
            swing: 0.0,
            recurve: 0.0,
            width: 1.0,
            unrest: 1.0,
        }
    }

    /// Draws the petals one after the other around the heart.
    pub fn draw(&self, hand: &mut Hand, form: &Form) {
        let pitch = TAU / f64::from(self.petals);
        for i in 0..self.petals {
            let azimuth = self.turn.to_radians() + pitch * (f64::from(i) + hand.vary(0.16 * self.unrest));
            let length = self.length * (1.0 + hand.vary(0.06 * self.unrest));
            let opening = self.opening + hand.vary(3.0 * self.unrest);
            let width = self.width * (1.0 + hand.vary(0.08 * self.unrest));
            let lean = hand.vary(4.0 * self.unrest).to_radians();
            let mut outline = form.blade(hand, width);
            if hand.chance(0.25) {
                outline.reverse();
            }
            let roll = |p: &DVec2| {
                let (rho, psi) = (p.length() * length, p.y.atan2(p.x));
                let share = p.length().min(1.0);
                let swing = (self.swing.to_radians() + lean) * share;
                let beta = (opening + self.recurve * share * share).to_radians();
                self.projected(rho, azimuth + psi / opening.to_radians().sin() + swing, beta)
            };
            let placed: Vec<DVec2> = outline.iter().map(roll).collect();
            hand.outline("auto", &placed, 0.12);
        }
    }

    /// Draws the stalk through `points` (base first) into the heart, arriving along the flower's axis.
    pub fn stalk(&self, hand: &mut Hand, points: &[DVec2], pressure: [f64; 2]) -> Drawn {
        let axis = toward(self.faces) * self.lift.to_radians().cos();
        let mut line = points.to_vec();
        line.push(self.heart - axis * self.length * 0.45);
        line.push(self.heart - axis * self.length * 0.05);
        hand.branch(&line, pressure)
    }

    /// Point on the cone at distance `rho` from the apex, seen on the sheet.
    fn projected(&self, rho: f64, azimuth: f64, beta: f64) -> DVec2 {
        let (lift_sin, lift_cos) = self.lift.to_radians().sin_cos();
        let flat = toward(self.faces);
        let axis = DVec3::new(flat.x * lift_cos, flat.y * lift_cos, lift_sin);
        let across = DVec3::new(-flat.y, flat.x, 0.0);
        let third = axis.cross(across);
        let (sin, cos) = azimuth.sin_cos();
        let point = rho * (beta.cos() * axis + beta.sin() * (cos * across + sin * third));
        self.heart + point.truncate()
    }
}
