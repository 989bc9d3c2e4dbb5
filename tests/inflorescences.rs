//! The built-in inflorescences against botany: where florets stand, how pedicels grow, in which order they open.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use glam::{Vec2, Vec3};
use penstemon::grammar::{Figure, Item, Settings, library};
use std::collections::BTreeMap;

fn drawn(name: &str, constants: &[(&str, f64)]) -> Figure {
    let figure =
        library::inflorescence(name).unwrap().draw(&Settings { seed: 5, constants, ..Settings::default() });
    let figure = figure.unwrap_or_else(|error| panic!("{name}: {error}"));
    figure.check_invariants().unwrap();
    figure
}

/// Without anything irregular.
fn regular(name: &str, constants: &[(&str, f64)]) -> Figure {
    drawn(name, &[constants, &[("jitter", 0.0)]].concat())
}

fn named<'f>(figure: &'f Figure, name: &'f str) -> impl Iterator<Item = &'f Item> {
    figure.items.iter().filter(move |item| &*item.name == name)
}

fn flowers(figure: &Figure) -> Vec<&Item> {
    named(figure, "flower").collect()
}

/// Distance from the axis of the stalk.
fn out(p: Vec3) -> f32 {
    Vec2::new(p.x, p.z).length()
}

/// The length of the stem that an item stands on.
fn stem_length(figure: &Figure, item: &Item) -> f32 {
    figure.stems[item.stem.unwrap()].points.windows(2).map(|w| w[0].distance(w[1])).sum()
}

fn is_falling(values: impl IntoIterator<Item = f32>) -> bool {
    let values: Vec<f32> = values.into_iter().collect();
    values.windows(2).all(|w| w[1] <= w[0] + 1e-6) && values[values.len() - 1] < values[0]
}

fn is_rising(values: impl IntoIterator<Item = f32>) -> bool {
    is_falling(values.into_iter().map(|value| -value))
}

#[test]
fn every_inflorescence_flowers_from_all_buds_to_all_open() {
    for name in library::names() {
        let open = |bloom: f64| -> f32 {
            let figure = drawn(name, &[("bloom", bloom)]);
            let open: Vec<f32> = flowers(&figure).iter().map(|flower| flower.args[0]).collect();
            assert!(open.iter().all(|open| (0.0..=1.0).contains(open)), "{name}");
            open.iter().sum::<f32>() / open.len() as f32
        };
        assert_eq!(open(0.0), 0.0, "{name}");
        assert!(open(1.0) > 0.999, "{name}: {}", open(1.0));
        let shares: Vec<f32> = (0..=20).map(|k| open(f64::from(k) / 20.0)).collect();
        assert!(shares.windows(2).all(|w| w[0] <= w[1]), "{name}: {shares:?}");
        assert!(shares[12] > 0.15 && shares[8] < 0.85, "{name}: {shares:?}");
    }
}

#[test]
fn every_inflorescence_is_drawn_at_both_ends_of_every_range() {
    for name in library::names() {
        let grammar = library::inflorescence(name).unwrap();
        let ranged: Vec<_> =
            grammar.constants().iter().filter_map(|c| Some((c.name.as_str(), c.range?))).collect();
        for (constant, (low, high)) in &ranged {
            drawn(name, &[(constant, *low)]);
            drawn(name, &[(constant, *high)]);
        }
        let lowest: Vec<_> = ranged.iter().map(|(name, range)| (*name, range.0)).collect();
        let highest: Vec<_> = ranged.iter().map(|(name, range)| (*name, range.1)).collect();
        drawn(name, &lowest);
        drawn(name, &highest);
    }
}

#[test]
fn every_inflorescence_says_what_its_constants_are() {
    for name in library::names() {
        let grammar = library::inflorescence(name).unwrap();
        for constant in grammar.constants().iter().filter(|constant| constant.range.is_some()) {
            assert!(constant.help.ends_with('.'), "{name}: {} has no help", constant.name);
        }
        for wanted in ["bloom", "flower", "radius", "bud"] {
            let has_it = grammar
                .constants()
                .iter()
                .any(|constant| constant.name == wanted && constant.range.is_some());
            assert!(has_it, "{name} has no {wanted}");
        }
        assert!(
            grammar.organs().iter().any(|organ| &*organ.name == "flower" && organ.arguments == 2),
            "{name}"
        );
    }
}

#[test]
fn a_raceme_is_a_cone_that_flowers_from_the_foot() {
    let figure = regular("raceme", &[]);
    let flowers = flowers(&figure);
    assert!(is_rising(flowers.iter().map(|flower| flower.origin.y)));
    assert!(is_falling(flowers.iter().map(|flower| out(flower.origin))), "the outline is a cone");
    assert!(is_falling(flowers.iter().map(|flower| stem_length(&figure, flower))));
    assert!(is_falling(flowers.iter().map(|flower| flower.args[0])), "acropetal");
    assert!((stem_length(&figure, flowers[0]) - 0.035).abs() < 1e-5);
    assert_eq!(named(&figure, "bract").count(), flowers.len());
    // Turns from one to the next are those of the golden angle.
    let turn = |w: &[&Item]| {
        let angle = |item: &Item| item.origin.z.atan2(item.origin.x).to_degrees();
        (angle(w[1]) - angle(w[0])).rem_euclid(360.0)
    };
    assert!(flowers.windows(2).all(|w| (turn(w) - 137.5).abs() < 0.1 || (turn(w) - 222.5).abs() < 0.1));
}

#[test]
fn florets_of_a_spike_have_no_pedicels() {
    let figure = regular("spike", &[]);
    assert_eq!(figure.stems.len(), 1);
    assert!(flowers(&figure).iter().all(|flower| out(flower.origin) < 0.0021));
    assert!(is_falling(flowers(&figure).iter().map(|flower| flower.args[0])), "acropetal");
    // An ear in two rows.
    let ear = regular("spike", &[("divergence", 180.0)]);
    assert!(flowers(&ear).iter().all(|flower| flower.origin.x.abs() < 1e-5), "distichous");
}

#[test]
fn pedicels_of_an_umbel_come_from_one_point() {
    for (name, pedicels) in [("umbel", 45), ("compound_umbel", 28)] {
        let figure = drawn(name, &[]);
        let tip = figure.stems[0].points[1];
        let from_tip =
            figure.stems.iter().skip(1).filter(|stem| stem.points[0] == tip && stem.parent == Some(0));
        assert_eq!(from_tip.count(), pedicels, "{name}");
    }
    let figure = regular("umbel", &[("flat", 0.0)]);
    let tip = figure.stems[0].points[1];
    let lengths: Vec<f32> = flowers(&figure).iter().map(|flower| flower.origin.distance(tip)).collect();
    assert!(lengths.iter().all(|length| (length - 0.045).abs() < 1e-4), "a ball");
    assert!(is_rising(flowers(&figure).iter().map(|flower| flower.args[0])), "the outermost first");
    let flat = regular("umbel", &[("flat", 1.0), ("opening", 70.0)]);
    let heights: Vec<f32> = flowers(&flat).iter().map(|flower| flower.origin.y - tip.y).collect();
    assert!(heights.iter().all(|height| (height - 0.045).abs() < 1e-4), "flat: {heights:?}");
}

#[test]
fn rays_of_a_compound_umbel_end_in_umbels() {
    let figure = regular("compound_umbel", &[]);
    let mut of_ray: BTreeMap<usize, Vec<&Item>> = BTreeMap::new();
    for flower in flowers(&figure) {
        let pedicel = flower.stem.unwrap();
        of_ray.entry(figure.stems[pedicel].parent.unwrap()).or_default().push(flower);
    }
    assert_eq!(of_ray.len(), 28);
    for (ray, flowers) in &of_ray {
        let end = *figure.stems[*ray].points.last().unwrap();
        assert!(
            flowers.iter().all(|flower| figure.stems[flower.stem.unwrap()].points[0].distance(end) < 1e-6)
        );
        let open: Vec<f32> = flowers.iter().map(|flower| flower.args[0]).collect();
        assert!(open.windows(2).all(|w| w[0] <= w[1]), "the outermost of each first");
    }
}

#[test]
fn a_corymb_has_a_flat_top_on_pedicels_from_many_heights() {
    let figure = regular("corymb", &[("dome", 0.0)]);
    let flowers = flowers(&figure);
    let top = flowers[0].origin.y;
    assert!(flowers.iter().all(|flower| (flower.origin.y - top).abs() < 1e-4), "one level");
    let feet = flowers.iter().map(|flower| figure.stems[flower.stem.unwrap()].points[0].y);
    assert!(is_rising(feet), "from the rachis one above another");
    assert!(
        is_falling(flowers.iter().map(|flower| stem_length(&figure, flower))),
        "lower pedicels are longer"
    );
    assert!(is_falling(flowers.iter().map(|flower| out(flower.origin))));
    assert!(is_falling(flowers.iter().map(|flower| flower.args[0])), "the outermost first");
}

#[test]
fn a_panicle_is_a_raceme_of_racemes() {
    let figure = regular("panicle", &[]);
    let branches: Vec<&_> =
        figure.stems.iter().filter(|stem| stem.parent == Some(0) && stem.points.len() > 2).collect();
    assert!(branches.len() > 10);
    let length = |points: &[Vec3]| points.windows(2).map(|w| w[0].distance(w[1])).sum::<f32>();
    assert!(is_falling(branches.iter().map(|branch| length(&branch.points))), "the lowest is the longest");
    // Of each branch the florets open from its foot.
    let mut of_branch: BTreeMap<usize, Vec<f32>> = BTreeMap::new();
    for flower in flowers(&figure) {
        let pedicel = &figure.stems[flower.stem.unwrap()];
        of_branch.entry(pedicel.parent.unwrap_or(0)).or_default().push(flower.args[0]);
    }
    assert!(of_branch.values().all(|open| open.windows(2).all(|w| w[1] <= w[0] + 1e-6)));
    let lilac = drawn("panicle", &[("whorl", 2.0), ("turn", 90.0), ("orders", 3.0), ("nodes", 12.0)]);
    assert!(flowers(&lilac).len() > 200);
}

#[test]
fn the_middle_floret_of_a_cyme_opens_first() {
    let figure = regular("cyme", &[("bloom", 0.5), ("spread", 1.0)]);
    let flowers = flowers(&figure);
    let mut by_opening: BTreeMap<i32, Vec<f32>> = BTreeMap::new();
    for flower in &flowers {
        by_opening.entry((flower.args[0] * 1000.0).round() as i32).or_default().push(flower.origin.y);
    }
    let counts: Vec<(i32, usize)> = by_opening.iter().map(|(open, of)| (*open, of.len())).rev().collect();
    assert_eq!(
        counts,
        [(1000, 1), (800, 2), (600, 4), (400, 8), (200, 16)],
        "each order after the one before"
    );
    let mean = |heights: &Vec<f32>| heights.iter().sum::<f32>() / heights.len() as f32;
    assert!(is_falling(by_opening.values().map(mean)), "later orders stand higher");
    // Florets stand between the axes that grow on: in their fork, on the bisector.
    assert!(flowers[0].heading.abs_diff_eq(Vec3::Y, 1e-6));
}

#[test]
fn florets_of_a_scorpioid_cyme_stand_left_and_right_on_a_coil_that_opens() {
    let bud = regular("scorpioid_cyme", &[("bloom", 0.0)]);
    let full = regular("scorpioid_cyme", &[("bloom", 1.0)]);
    let turned = |figure: &Figure| -> f32 {
        let steps: Vec<Vec3> = figure.stems[0].points.windows(2).map(|w| (w[1] - w[0]).normalize()).collect();
        steps.windows(2).map(|w| w[0].angle_between(w[1]).to_degrees()).sum()
    };
    assert!(turned(&bud) > 540.0, "{}", turned(&bud));
    assert!(turned(&full) < 120.0, "{}", turned(&full));
    // The coil lies in the plane of the front, rows of florets on both sides of it.
    let sides: Vec<bool> = flowers(&full).iter().map(|flower| flower.origin.z > 0.0).collect();
    assert!(sides.windows(2).all(|w| w[0] != w[1]), "left and right in turn");
    assert!(is_falling(flowers(&drawn("scorpioid_cyme", &[])).iter().map(|flower| flower.args[0])));
    let helicoid = regular("scorpioid_cyme", &[("helicoid", 1.0)]);
    assert_ne!(flowers(&helicoid)[5].origin, flowers(&full)[5].origin);
}

/// Differences between the numbers of florets that touch: each with its nearest others, among those of a ring.
fn contacts(flowers: &[&Item], ring: std::ops::Range<usize>) -> BTreeMap<usize, usize> {
    let mut counts = BTreeMap::new();
    for k in ring {
        let mut near: Vec<(f32, usize)> =
            (0..k).map(|j| (flowers[j].origin.distance(flowers[k].origin), k - j)).collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        near.iter().take(2).for_each(|(_, difference)| *counts.entry(*difference).or_default() += 1);
    }
    counts
}

#[test]
fn parastichies_of_a_capitulum_are_fibonacci_numbers() {
    let fibonacci = [1, 2, 3, 5, 8, 13, 21, 34, 55, 89, 144];
    let figure = regular("capitulum", &[("n", 1500.0), ("dome", 0.0001)]);
    let flowers = flowers(&figure);
    assert_eq!(flowers.len(), 1500);
    for ring in [60..120, 200..300, 400..600, 1000..1500] {
        let counts = contacts(&flowers, ring.clone());
        assert!(counts.keys().all(|difference| fibonacci.contains(difference)), "{ring:?}: {counts:?}");
    }
    let most = |ring| {
        let mut counts: Vec<_> = contacts(&flowers, ring).into_iter().collect();
        counts.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        let mut pair = [counts[0].0, counts[1].0];
        pair.sort_unstable();
        pair
    };
    assert_eq!(most(350..500), [34, 55]);
    assert_eq!(most(900..1300), [55, 89]);
}

#[test]
fn a_capitulum_opens_from_its_rim_rays_first() {
    let figure = regular("capitulum", &[("bloom", 0.5)]);
    assert!(named(&figure, "ray").all(|ray| ray.args[0] == 1.0));
    assert!(is_rising(flowers(&figure).iter().map(|flower| flower.args[0])), "from the rim");
    let rim = flowers(&figure).iter().map(|flower| out(flower.origin)).fold(0.0, f32::max);
    // The petal of a ray begins a fifth of its length from where the ray stands.
    assert!(named(&figure, "ray").all(|ray| out(ray.origin) >= 0.79 * rim));
    let bud = regular("capitulum", &[("bloom", 0.0)]);
    let inward = |item: &Item| item.heading.dot(Vec3::new(item.origin.x, 0.0, item.origin.z)) < 0.0;
    assert!(named(&bud, "bract").chain(named(&bud, "ray")).all(inward), "the bud is closed");
    // Each floret has the same share of the disc.
    let radius = |k: usize| out(flowers(&figure)[k].origin).powi(2) / (k as f32 + 0.5);
    assert!((1..900).all(|k| (radius(k) / radius(0) - 1.0).abs() < 1e-3));
}

#[test]
fn a_catkin_hangs() {
    let figure = regular("catkin", &[("bloom", 1.0)]);
    let points = &figure.stems[0].points;
    let last = points[points.len() - 1] - points[points.len() - 2];
    assert!(last.normalize().y < -0.98, "{last}");
    assert!(points[points.len() - 1].y < -0.04);
    assert!(
        stem_length(&regular("catkin", &[("bloom", 0.0)]), &figure.items[0])
            < 0.6 * stem_length(&figure, &figure.items[0])
    );
    assert_eq!(named(&figure, "bract").count(), flowers(&figure).len());
}

#[test]
fn whorls_of_a_verticillate_spike_alternate() {
    let figure = regular("verticillate_spike", &[("pedicel_foot", 0.005), ("pedicel_tip", 0.005)]);
    let flowers = flowers(&figure);
    assert_eq!(flowers.len(), 9 * 8 + 3);
    let angle = |item: &Item| item.heading.z.atan2(item.heading.x).to_degrees();
    for (k, whorl) in flowers[..72].chunks(8).enumerate() {
        assert!(whorl.iter().all(|flower| (flower.origin.y - whorl[0].origin.y).abs() < 1e-5));
        let turn = (angle(whorl[0]) - angle(flowers[0])).rem_euclid(45.0);
        let expected = if k % 2 == 0 { 0.0 } else { 22.5 };
        assert!((turn - expected).abs() < 0.1 || (turn - expected).abs() > 44.9, "whorl {k}: {turn}");
    }
    let gap = |k: usize| flowers[8 * (k + 1)].origin.y - flowers[8 * k].origin.y;
    assert!(gap(0) > 2.0 * gap(1), "the lowest whorl stands apart");
}
