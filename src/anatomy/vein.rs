//! One twig or leaf vein growing inside a drawn outline (000 §3.5.1, 002 §4.3 eq. 2).
//!
//! From a growth point on its parent branch the walk takes steps of equal length, each a blend of three directions:
//! toward the nearest place of the outline (`k_p`), along the parent branch (`k_b`) and on as before (`k_m`). It ends
//! near the outline, at its border, or after a number of steps. (000 §3.5.1 describes the effect of `k_p` and `k_b`
//! the wrong way round; the equation rules.) The papers start without a memory; here the first direction leaves the
//! parent to one side, so that neighbours alternate.

use crate::geom::region::Region;
use glam::Vec2;

/// What steers a walk; directions are weighted relative to each other.
#[derive(Clone, Copy, Debug)]
pub struct Walk {
    /// Attraction to the outline, `k_p`.
    pub outline_pull: f32,
    /// Attraction along the parent branch, `k_b`.
    pub parent_pull: f32,
    /// Direction memory, `k_m`.
    pub memory: f32,
    /// Step length, pixels.
    pub step: f32,
    /// Most steps.
    pub max_steps: usize,
    /// Distance from the outline at which the walk ends, pixels.
    pub stop_distance: f32,
}

/// The places of a walk from `start`, whose parent branch runs along `parent` (unit) and which sets out along `first`
/// (unit). All places lie inside the region and none but the first, `start` itself, where `blocked` says so.
pub fn walk(
    region: &Region,
    start: Vec2,
    (parent, first): (Vec2, Vec2),
    rule: &Walk,
    blocked: impl Fn(Vec2) -> bool,
) -> Vec<Vec2> {
    let mut places = vec![start];
    let (mut at, mut before) = (start, first);
    for _ in 0..rule.max_steps {
        let Some((border, distance)) = region.nearest_boundary(at) else { break };
        if distance <= rule.stop_distance {
            break;
        }
        let pull = (border - at).normalize_or_zero();
        let heading = rule.outline_pull * pull + rule.parent_pull * parent + rule.memory * before;
        let Some(heading) = heading.try_normalize() else { break };
        let next = at + rule.step * heading;
        if blocked(next) || !region.contains(next) {
            break;
        }
        places.push(next);
        (at, before) = (next, heading);
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    fn disc(radius: f32) -> Region {
        Region::new(
            (0..64).map(|k| radius * Vec2::from_angle(k as f32 * std::f32::consts::TAU / 64.0)).collect(),
        )
    }

    const RULE: Walk = Walk {
        outline_pull: 0.5,
        parent_pull: 0.4,
        memory: 0.1,
        step: 4.0,
        max_steps: 100,
        stop_distance: 5.0,
    };

    #[test]
    fn a_walk_stays_inside_and_ends_near_the_outline() {
        let region = disc(100.0);
        let places = walk(&region, Vec2::new(10.0, 0.0), (Vec2::Y, Vec2::X), &RULE, |_| false);
        assert!(places.iter().all(|&p| region.contains(p)));
        let last = places[places.len() - 1];
        assert!(region.nearest_boundary(last).unwrap().1 <= RULE.stop_distance + RULE.step);
    }

    #[test]
    fn more_outline_pull_leads_more_directly_outward() {
        let end = |outline_pull: f32, parent_pull: f32| {
            let rule = Walk { outline_pull, parent_pull, ..RULE };
            *walk(&disc(100.0), Vec2::new(20.0, 0.0), (Vec2::Y, Vec2::X), &rule, |_| false).last().unwrap()
        };
        assert!(end(0.7, 0.2).y < end(0.3, 0.6).y);
    }

    #[test]
    fn outside_there_is_no_walk() {
        assert_eq!(walk(&disc(1.0), Vec2::new(9.0, 0.0), (Vec2::Y, Vec2::X), &RULE, |_| false).len(), 1);
    }
}
