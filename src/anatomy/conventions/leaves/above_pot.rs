//! Leaves above a pot without a stem: a seedling.
//!
//! All that is drawn above the pot are a few outlines whose lower ends meet over its mouth. They get the stem that nobody drew, from the
//! middle of the pot up to where they meet. Limits: leaves that meet beside the pot.

use crate::anatomy::conventions::page::{Line, Page};
use crate::anatomy::conventions::shapes::lobes;
use crate::anatomy::conventions::{Hypothesis, Made};
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Fewest leaves, and most.
const LEAVES: (usize, usize) = (2, 8);
/// How far leaves' lower ends are from where they meet at most, as a share of their size.
const MEET: f32 = 0.2;
/// How far above the rim they meet, least and most, in heights of the pot, and how far from its axis at most, as a share of its width.
const ABOVE: (f32, f32) = (0.02, 1.5);
const ASIDE: f32 = 0.35;
/// Where the stem begins below the rim, as a share of the pot's height.
const FOOT: f32 = 0.1;
/// Log-odds.
const SCORE: f32 = 3.6;

/// Proposes the seedling over a pot that was proposed.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let pot = out.iter().find(|other| other.reading == Reading::Pot);
    let bounds = pot.and_then(|pot| pot.solids.first()).map(|pot| pot.bounds());
    out.extend(bounds.and_then(|bounds| seedling(page, bounds)));
}

fn seedling(page: &Page, (low, high): (Vec2, Vec2)) -> Option<Hypothesis> {
    let uses: Vec<usize> = (0..page.lines.len()).filter(|i| !page.is_apart(*i)).collect();
    let leaves: Vec<&Line> = uses.iter().map(|i| &page.lines[*i]).collect();
    if !(LEAVES.0..=LEAVES.1).contains(&leaves.len()) || !leaves.iter().all(|line| line.is_closed_and_solid())
    {
        return None;
    }
    let lowest = |line: &Line| line.points.iter().copied().max_by(|a, b| a.y.total_cmp(&b.y));
    let ends = leaves.iter().map(|leaf| lowest(leaf)).collect::<Option<Vec<Vec2>>>()?;
    let place = ends.iter().sum::<Vec2>() / ends.len() as f32;
    let roots: Vec<usize> = leaves.iter().map(|leaf| lobes::nearest(&leaf.points, place)).collect();
    let meets = leaves.iter().zip(&roots).all(|(leaf, root)| {
        leaf.points[*root].distance(place) < MEET * leaf.size().max_element()
            && leaf.bounds.1.y - leaf.points[*root].y < 0.3 * leaf.size().y
    });
    let (size, middle) = (high - low, low.midpoint(high).x);
    let above = (low.y - place.y) / size.y.max(f32::MIN_POSITIVE);
    let is_over = (ABOVE.0..ABOVE.1).contains(&above) && (place.x - middle).abs() < ASIDE * size.x;
    if !meets || !is_over {
        return None;
    }
    let stem = Made::new(Tool::Branch, [Vec2::new(middle, low.y + FOOT * size.y), place]);
    let blade =
        |(leaf, root): (&&Line, &usize)| Made::new(Tool::Leaf, lobes::around_from(&leaf.points, *root));
    let parts = std::iter::once(stem).chain(leaves.iter().zip(&roots).map(blade)).collect();
    Some(Hypothesis { uses, score: SCORE, parts, solids: Vec::new(), reading: Reading::Leaf, habit: None })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::{beneath::pot, line, read_above};

    fn leaf(sign: f32) -> Vec<Vec2> {
        let corners = [(0.0, -20.0), (34.0, -26.0), (60.0, -80.0), (16.0, -62.0), (0.0, -20.0)];
        line(&corners.map(|(x, y)| (sign * x, y)))
    }

    fn pot() -> Vec<Vec2> {
        line(&[(-50.0, 0.0), (-40.0, 90.0), (40.0, 90.0), (50.0, 0.0), (-50.0, 0.0)])
    }

    #[test]
    fn leaves_that_meet_above_a_pot_get_a_stem_from_its_middle() {
        let found = read_above(pot::propose, propose, &[pot(), leaf(1.0), leaf(-1.0)]);
        let [seedling] = &found[..] else { panic!("{} seedlings", found.len()) };
        assert_eq!((&seedling.uses[..], seedling.parts.len()), (&[1, 2][..], 3));
        let stem = &seedling.parts[0].points;
        assert!(stem[0].position.y > 0.0 && stem[1].position.distance(Vec2::new(0.0, -20.0)) < 4.0);
    }

    #[test]
    fn leaves_on_a_stem_of_their_own_need_none() {
        let stem = line(&[(0.0, 10.0), (0.0, -40.0)]);
        assert!(read_above(pot::propose, propose, &[pot(), leaf(1.0), leaf(-1.0), stem]).is_empty());
    }
}
