//! How shoots of climbing species go to a support and hold on.
//!
//! The thesis' direction (eq. 2.3) has no term for it; this one goes where it leads along the support: out of reach of the
//! wood a shoot is drawn to the nearest surface, the more the nearer it is; there it goes on along the surface at the
//! distance of its kind, and twining species turn around what they hold. A shoot that holds on to nothing hangs after a while, and ends.
//! Where no obstacle is within reach the ground is the support, so that ivy covers it.
//!
//! Limits: the nearest surface decides alone, so that a shoot between two walls may go from one to the other.

use crate::growth::habit::ClimbHabit;
use crate::growth::obstacle::{Contact, Obstacles};
use glam::Vec3;

/// Steepest way to or from a surface that a shoot follows, as the sine of its angle.
const STEEPEST: f32 = 0.7;
/// How strongly what holds on to nothing hangs.
const HANGS: f32 = 0.8;

/// What a species may hold on to.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Support<'a> {
    /// How it climbs.
    pub habit: &'a ClimbHabit,
    /// What stands beside it.
    pub obstacles: Option<&'a Obstacles>,
}

impl Support<'_> {
    /// The nearest place to hold on to: of an obstacle within reach, else of the ground within reach.
    pub(crate) fn contact(&self, p: Vec3) -> Option<Contact> {
        let near = |contact: &Contact| contact.distance <= self.habit.reach;
        let obstacle = self.obstacles.and_then(|obstacles| obstacles.contact(p)).filter(near);
        obstacle.or_else(|| Some(Contact { distance: p.y.abs(), away: Vec3::Y }).filter(near))
    }

    /// Whether wood with that contact holds on, for internodes of that length, metres.
    pub(crate) fn holds(&self, contact: &Contact, length: f32) -> bool {
        contact.distance <= self.habit.gap + 0.5 * length
    }

    /// The direction that an internode of that length, metres, takes from a place that would go `way`.
    pub(crate) fn way(&self, from: Vec3, way: Vec3, length: f32, age: f32) -> Vec3 {
        let Some(contact) = self.contact(from) else { return way };
        let (away, far) = (contact.away, contact.distance);
        if !self.holds(&contact, length) {
            let pull = self.habit.hold.at(age) * (1.0 - far / self.habit.reach).max(0.0);
            return (way - away * pull).try_normalize().unwrap_or(way);
        }
        let turning = Vec3::Y.cross(away) * self.habit.twine.at(age);
        let along = (way + turning).reject_from_normalized(away);
        let Some(along) = along.try_normalize() else { return way };
        let rise = ((self.habit.gap - far) / length.max(f32::MIN_POSITIVE)).clamp(-STEEPEST, STEEPEST);
        along * (1.0 - rise * rise).sqrt() + away * rise
    }

    /// The direction of a shoot that has grown `loose` metres without support; none where it ends.
    pub(crate) fn hanging(&self, way: Vec3, loose: f32) -> Option<Vec3> {
        match loose / self.habit.free.max(f32::MIN_POSITIVE) {
            ..1.0 => Some(way),
            1.0..2.0 => Some((way - Vec3::Y * HANGS).try_normalize().unwrap_or(way)),
            _ => None,
        }
    }
}

/// A bud's side turned along a surface, so that the branches of wood that holds on lie left and right of it.
pub(crate) fn side_along(side: Vec3, way: Vec3, away: Vec3) -> Vec3 {
    let across = way.cross(away).normalize_or(side);
    if across.dot(side) < 0.0 { -across } else { across }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ivy() -> ClimbHabit {
        ClimbHabit { gap: 0.02, reach: 1.0, free: 0.5, ..ClimbHabit::default() }
    }

    fn climbed(habit: &ClimbHabit, obstacles: &Obstacles, from: Vec3, steps: usize) -> Vec<Vec3> {
        let support = Support { habit, obstacles: Some(obstacles) };
        let (mut at, mut way) = (from, Vec3::Y);
        std::iter::repeat_with(|| {
            way = support.way(at, (way + 0.2 * Vec3::Y).normalize(), 0.05, 1.0);
            at += way * 0.05;
            at
        })
        .take(steps)
        .collect()
    }

    #[test]
    fn a_shoot_goes_to_a_wall_and_up_it_at_its_gap() {
        let wall = Obstacles::wall(Vec3::new(4.0, 3.0, 0.2));
        let line = climbed(&ivy(), &wall, Vec3::new(0.0, 0.0, 0.5), 50);
        let late = &line[20..];
        assert!(late.iter().all(|p| (p.z - 0.12).abs() < 0.02), "{late:?}");
        assert!(late.windows(2).all(|w| w[1].y > w[0].y) && late[29].y > 1.5);
        assert!(line.windows(2).all(|w| wall.lets_pass(w[0], w[1], 0.0)));
    }

    #[test]
    fn a_twining_shoot_goes_around_a_pole() {
        let pole = Obstacles::wall(Vec3::new(0.05, 4.0, 0.05));
        let habit = ClimbHabit { twine: 1.0.into(), ..ivy() };
        let line = climbed(&habit, &pole, Vec3::new(0.0, 0.0, 0.06), 50);
        let around: f32 = line
            .windows(2)
            .map(|w| {
                let angle = |p: Vec3| (-p.z).atan2(p.x);
                let turn = angle(w[1]) - angle(w[0]);
                turn - (turn / std::f32::consts::TAU).round() * std::f32::consts::TAU
            })
            .sum();
        assert!(around > std::f32::consts::TAU, "{around}");
        assert!(line[49].y > 0.4, "{}", line[49].y);
        assert!(line.iter().all(|p| p.with_y(0.0).length() < 0.15));
    }

    #[test]
    fn without_anything_else_it_lies_on_the_ground() {
        let habit = ivy();
        let support = Support { habit: &habit, obstacles: None };
        let way = support.way(Vec3::Y * 0.02, Vec3::new(1.0, 0.5, 0.0).normalize(), 0.05, 1.0);
        assert!(way.abs_diff_eq(Vec3::X, 1e-5), "{way}");
        assert!(support.contact(Vec3::Y * 2.0).is_none(), "out of reach");
        assert_eq!(support.way(Vec3::Y * 2.0, Vec3::X, 0.05, 1.0), Vec3::X);
    }

    #[test]
    fn what_holds_on_to_nothing_hangs_and_ends() {
        let habit = ivy();
        let support = Support { habit: &habit, obstacles: None };
        assert_eq!(support.hanging(Vec3::X, 0.4), Some(Vec3::X));
        assert!(support.hanging(Vec3::X, 0.6).unwrap().y < -0.5);
        assert_eq!(support.hanging(Vec3::X, 1.1), None);
    }

    #[test]
    fn sides_lie_along_the_surface_and_keep_their_turn() {
        let side = side_along(Vec3::new(0.3, 0.0, 0.9), Vec3::Y, Vec3::Z);
        assert!(side.abs_diff_eq(Vec3::X, 1e-5));
        assert!(side_along(Vec3::new(-0.3, 0.0, 0.9), Vec3::Y, Vec3::Z).abs_diff_eq(Vec3::NEG_X, 1e-5));
    }
}
