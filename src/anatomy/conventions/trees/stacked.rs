//! What stands above what, though their lines do not come near one another: a crown whose outline is open toward its trunk.
//!
//! Lines near one another are one group. Where an outline is left open below, its ends may be far from the trunk that it stands
//! on, and the trunk is a group of its own: it is upright and narrow, and what is above it spans its top and begins about there. The sides
//! of a stout trunk may be groups of their own, too: one line then spans them both.
//!
//! Limits: no more than [`MOST`] groups are looked at, so that the cost stays that of a few pairs.

use crate::anatomy::conventions::page::{Page, bounds};
use glam::Vec2;

/// Most groups of a drawing.
const MOST: usize = 24;
/// Least height of a trunk, in its widths.
const UPRIGHT: f32 = 1.2;
/// Least width of what stands on it, in its widths.
const WIDER: f32 = 1.4;
/// How far above the trunk's top that may end, in its own heights, and how far below, in heights of the trunk.
const ABOVE: f32 = 0.35;
const BELOW: f32 = 0.6;

/// Of the sides of a stout trunk: least height of the shorter, distance of their feet and of their middles at most, as shares of the
/// height of the higher.
const EVEN: f32 = 0.6;
const FEET: f32 = 0.25;
const APART: f32 = 0.9;

/// Lines of a group, and its smallest and largest corner.
type Part = (Vec<usize>, (Vec2, Vec2));

/// Groups that stand on one another, as one: ascending lines.
pub(crate) fn stacked(page: &Page) -> Vec<Vec<usize>> {
    let is_within = |group: &&Vec<usize>| {
        let first = group.first();
        page.wide_groups.iter().any(|wide| first.is_some_and(|line| wide.binary_search(line).is_ok()))
    };
    let separate = page.groups.iter().filter(|group| !is_within(group)).chain(&page.wide_groups);
    let parts: Vec<Part> =
        separate.map(|group| (group.clone(), bounds(group.iter().map(|line| &page.lines[*line])))).collect();
    if parts.len() > MOST {
        return Vec::new();
    }
    let of_trunk = |trunk: &Part| {
        let mut all: Vec<usize> =
            parts.iter().filter(|part| stands_on(part.1, trunk.1)).flat_map(|part| part.0.clone()).collect();
        let is_any = !all.is_empty();
        all.extend(&trunk.0);
        all.sort_unstable();
        is_any.then_some(all)
    };
    let mut all: Vec<Vec<usize>> =
        parts.iter().filter(|part| is_upright(part.1)).filter_map(of_trunk).collect();
    all.extend(stout(page, &parts));
    all
}

/// Parts of which each has a side of one trunk, with what one line of the drawing spans above both sides.
fn stout(page: &Page, parts: &[Part]) -> Vec<Vec<usize>> {
    let lines = parts.iter().enumerate().flat_map(|(part, (lines, _))| lines.iter().map(move |i| (part, *i)));
    let sides: Vec<(usize, usize)> =
        lines.filter(|(_, line)| is_upright(page.lines[*line].bounds)).take(MOST).collect();
    let pairs = sides.iter().enumerate().flat_map(|(k, a)| sides[k + 1..].iter().map(move |b| (*a, *b)));
    let united = |((first, a), (second, b)): ((usize, usize), (usize, usize))| {
        let trunk = bounds([a, b].iter().map(|line| &page.lines[*line]));
        let crown = (0..parts.len()).find(|part| {
            let spans = |line: &usize| spans_both(page.lines[*line].bounds, trunk);
            parts[*part].0.iter().any(spans)
        })?;
        (first != second && are_sides(page.lines[a].bounds, page.lines[b].bounds)).then(|| {
            let mut part = [first, second, crown];
            part.sort_unstable();
            let mut all: Vec<usize> = part.iter().flat_map(|part| parts[*part].0.clone()).collect();
            all.sort_unstable();
            all.dedup();
            all
        })
    };
    let mut found: Vec<Vec<usize>> = pairs.filter_map(united).collect();
    found.sort_unstable();
    found.dedup();
    found
}

/// Whether two upright lines may be the sides of one trunk.
fn are_sides(a: (Vec2, Vec2), b: (Vec2, Vec2)) -> bool {
    let (short, long) = ((a.1.y - a.0.y).min(b.1.y - b.0.y), (a.1.y - a.0.y).max(b.1.y - b.0.y));
    let apart = (a.0.x.midpoint(a.1.x) - b.0.x.midpoint(b.1.x)).abs();
    short > EVEN * long && (a.1.y - b.1.y).abs() < FEET * long && apart < APART * long
}

/// Whether one line reaches over both sides of a trunk.
fn spans_both(upper: (Vec2, Vec2), trunk: (Vec2, Vec2)) -> bool {
    stands_on(upper, trunk) && upper.0.x < trunk.0.x && upper.1.x > trunk.1.x
}

fn is_upright((low, high): (Vec2, Vec2)) -> bool {
    high.y - low.y > UPRIGHT * (high.x - low.x)
}

/// Whether one thing stands on another that is upright.
fn stands_on(upper: (Vec2, Vec2), trunk: (Vec2, Vec2)) -> bool {
    let (size, of_trunk) = (upper.1 - upper.0, trunk.1 - trunk.0);
    let middle = 0.5 * (trunk.0.x + trunk.1.x);
    let spans = (upper.0.x..upper.1.x).contains(&middle) && size.x > WIDER * of_trunk.x;
    let over = trunk.0.y - upper.1.y;
    spans && upper.0.y < trunk.0.y && over < ABOVE * size.y && -over < BELOW * of_trunk.y
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arch_over_two_sides_stands_on_them_and_one_beside_them_does_not() {
        let side = |x: f32| vec![Vec2::new(x, 300.0), Vec2::new(x, 150.0)];
        let arch = |x: f32| -> Vec<Vec2> {
            (0..=40).map(|k| Vec2::new(x, 120.0) - 90.0 * Vec2::from_angle(0.0785 * k as f32)).collect()
        };
        let page = Page::of_lines(&[side(140.0), arch(150.0), side(160.0)]);
        assert_eq!(page.groups.len() + page.wide_groups.len(), 4, "{page:?}");
        assert_eq!(stacked(&page), [[0, 1, 2]]);
        assert!(stacked(&Page::of_lines(&[side(140.0), arch(340.0), side(160.0)])).is_empty());
    }

    #[test]
    fn an_arch_over_a_stout_trunk_stands_on_both_of_its_sides() {
        let side = |x: f32| vec![Vec2::new(x, 300.0), Vec2::new(x, 190.0)];
        let arch: Vec<Vec2> = (0..=40)
            .map(|k| Vec2::new(150.0, 120.0) + 90.0 * Vec2::from_angle(2.2 + 3.6 * k as f32 / 40.0))
            .collect();
        let page = Page::of_lines(&[arch.clone(), side(105.0), side(190.0)]);
        assert!(stacked(&page).contains(&vec![0, 1, 2]), "{:?}", stacked(&page));
        let two_flowers = Page::of_lines(&[side(105.0), side(190.0), arch[..20].to_vec()]);
        assert!(!stacked(&two_flowers).contains(&vec![0, 1, 2]));
    }
}
