//! What becomes of a bud (001 §2.1): new internodes, a flower, nothing this year, nothing ever.
//!
//! A bud that gets the resource v ≥ 1 grows ⌊v⌋ internodes of length v/⌊v⌋ (001 §2.3.1). With less it waits; a bud that
//! has waited too long is aborted. On a plant of flowering age the apical bud of a weak shoot may become a flower, which
//! ends its axis, and so may a lateral bud that would not grow.

use crate::growth::habit::Habit;
use crate::growth::tree::Fate;
use crate::random::Choice;

/// A bud in the year in which its fate is decided.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Waiting {
    /// The resource it got.
    pub v: f32,
    /// Years since it was laid down.
    pub waited: u16,
    /// Whether it continues its axis.
    pub apical: bool,
    /// Age of the plant.
    pub age: f32,
    /// A number of its own for its random choices.
    pub key: u64,
}

/// How many internodes a bud with resource `v` grows, and how long each is in lengths of an ordinary one.
pub(crate) fn shoot(v: f32, most: u32) -> Option<(u32, f32)> {
    let count = v.floor();
    (count >= 1.0).then(|| ((count as u32).min(most.max(1)), v / count))
}

/// The fate of a bud in one year; [`Fate::Dormant`] leaves it open.
pub(crate) fn decide(bud: &Waiting, habit: &Habit) -> Fate {
    let (weak, share) = if bud.apical {
        (habit.flower_below.at(bud.age), &habit.flowering)
    } else {
        (1.0, &habit.flowering_side)
    };
    if bud.v < weak && bud.age >= habit.flower_age && Choice::FLOWERS.unit(bud.key) < share.at(bud.age) {
        return Fate::Flower;
    }
    if bud.v >= 1.0 {
        return Fate::Shoot;
    }
    if u32::from(bud.waited) >= habit.bud_life { Fate::Aborted } else { Fate::Dormant }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shoot_uses_exactly_what_its_bud_got() {
        for v in [1.0, 1.4, 2.0, 3.99, 7.5_f32] {
            let (count, length) = shoot(v, 50).unwrap();
            assert_eq!(count, v.floor() as u32);
            assert!((count as f32 * length - v).abs() < 1e-5 && (1.0..2.0).contains(&length));
        }
        assert_eq!(shoot(0.99, 50), None);
        assert_eq!(shoot(80.0, 5).unwrap().0, 5);
    }

    #[test]
    fn buds_wait_and_then_give_up() {
        let habit = Habit { bud_life: 3, flower_age: 10.0, flowering: 1.0.into(), ..Habit::default() };
        let bud = Waiting { v: 0.5, waited: 1, apical: true, age: 5.0, key: 1 };
        assert_eq!(decide(&bud, &habit), Fate::Dormant);
        assert_eq!(decide(&Waiting { waited: 3, ..bud }, &habit), Fate::Aborted);
        assert_eq!(decide(&Waiting { v: 2.0, ..bud }, &habit), Fate::Shoot);
        let of_age = Waiting { age: 20.0, ..bud };
        assert_eq!(decide(&of_age, &habit), Fate::Flower);
        assert_eq!(decide(&Waiting { apical: false, ..of_age }, &habit), Fate::Dormant);
        let spurs = Habit { flowering_side: 1.0.into(), flower_below: 9.0.into(), ..habit };
        assert_eq!(decide(&Waiting { apical: false, ..of_age }, &spurs), Fate::Flower);
        let strong = Waiting { v: 2.0, apical: false, ..of_age };
        assert_eq!(decide(&strong, &spurs), Fate::Shoot, "a lateral bud that can grow does");
    }
}
