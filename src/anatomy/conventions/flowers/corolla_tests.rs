//! Corollas around centres, and what only looks like them.

use super::*;

fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
    crate::anatomy::conventions::read_by(propose, lines)
}

/// Around (0, 0) from one angle to another, `lobes` all around that are `depth` higher than the ring of radius 40.
fn ring(lobes: f32, depth: f32, (from, to): (f32, f32)) -> Vec<Vec2> {
    let place = |k: usize| {
        let angle = from + (to - from) * k as f32 / 200.0;
        (40.0 + depth * (0.5 * lobes * angle).sin().abs()) * Vec2::from_angle(angle)
    };
    (0..=200).map(place).collect()
}

fn circle(radius: f32) -> Vec<Vec2> {
    (0..=60).map(|k| radius * Vec2::from_angle(TAU * k as f32 / 60.0 + 1.0)).collect()
}

fn line(from: (f32, f32), to: (f32, f32)) -> Vec<Vec2> {
    vec![Vec2::from(from), Vec2::from(to)]
}

#[test]
fn a_corolla_in_one_stroke_becomes_petals_from_the_centre() {
    for (from, to) in [(0.0, TAU), (0.6, TAU + 0.5), (4.0, 4.0 - TAU)] {
        let drawing = [line((0.0, 300.0), (0.0, 60.0)), ring(6.0, 30.0, (from, to)), circle(25.0)];
        let found = read(&drawing);
        let [flower] = &found[..] else { panic!("{} corollas", found.len()) };
        assert_eq!(flower.uses, [1, 2], "the stem stays");
        let (petals, centre): (Vec<_>, Vec<_>) =
            flower.parts.iter().partition(|part| part.tool == Tool::Petal);
        assert_eq!((petals.len(), centre.len()), (6, 1));
        assert!(petals.iter().all(|petal| petal.points[0].position.length() < 10.0));
        assert_eq!(centre[0].tool, Tool::Auto);
        assert!(flower.score > 3.0, "{}", flower.score);
    }
}

#[test]
fn arcs_of_their_own_are_petals_and_what_stands_in_the_centre_is_its_ornament() {
    let arc = |k: usize| ring(5.0, 60.0, (k as f32 * TAU / 5.0 + 0.1, (k + 1) as f32 * TAU / 5.0 - 0.1));
    let mut drawing: Vec<Vec<Vec2>> = (0..5).map(arc).collect();
    drawing.extend([circle(36.0), line((-10.0, 0.0), (10.0, 5.0))]);
    let found = read(&drawing);
    assert_eq!(found[0].uses, [0, 1, 2, 3, 4, 5, 6]);
    assert_eq!(found[0].parts.len(), 6);
}

#[test]
fn a_stem_in_one_stroke_with_the_corolla_is_a_branch() {
    let mut drawn = line((0.0, 250.0), (0.0, 45.0));
    drawn.extend(ring(6.0, 30.0, (0.25 * TAU, 1.24 * TAU)));
    let found = read(&[drawn, circle(25.0)]);
    let count = |tool: Tool| found[0].parts.iter().filter(|part| part.tool == tool).count();
    assert_eq!((count(Tool::Branch), count(Tool::Petal)), (1, 7), "{:?}", found[0].parts.len());
}

#[test]
fn two_strokes_that_meet_are_one_corolla() {
    let drawing = [ring(6.0, 30.0, (0.5, 3.3)), ring(6.0, 30.0, (3.35, 0.45 + TAU)), circle(25.0)];
    assert_eq!(read(&drawing)[0].parts.len(), 7);
}

#[test]
fn loops_of_their_own_are_petals_around_a_disc_but_not_around_a_loop_like_them() {
    let drawing = |away: f32| -> Vec<Vec<Vec2>> {
        let petal = |k: usize| {
            let turn = Vec2::from_angle(k as f32 * TAU / 6.0);
            circle(20.0)
                .into_iter()
                .map(|p| turn.rotate(Vec2::new(away, 0.0) + p * Vec2::new(1.2, 1.1)))
                .collect()
        };
        (0..6).map(petal).chain([circle(25.0)]).collect()
    };
    assert!(read(&drawing(30.0)).is_empty());
    assert_eq!(read(&drawing(52.0))[0].parts.len(), 7);
    assert!(read(&drawing(52.0)[2..]).is_empty(), "not all around");
}

#[test]
fn petals_that_are_loops_may_begin_in_a_small_centre_or_stand_on_one_side_of_it() {
    let petal = |k: usize, step: f32, from: f32| -> Vec<Vec2> {
        let turn = Vec2::from_angle(k as f32 * step);
        circle(1.0)
            .iter()
            .map(|p| turn.rotate(Vec2::new(from, 0.0) + Vec2::new(60.0 + 60.0 * p.x, 20.0 * p.y)))
            .collect()
    };
    let small: Vec<Vec<Vec2>> = (0..5).map(|k| petal(k, TAU / 5.0, 10.0)).chain([circle(15.0)]).collect();
    assert_eq!(read(&small)[0].parts.len(), 6, "the loops begin within, and reach far");
    let head: Vec<Vec<Vec2>> = (0..6).map(|k| petal(k, -PI / 5.0, 30.0)).chain([circle(32.0)]).collect();
    assert_eq!(read(&head)[0].parts.len(), 7);
    let gathered: Vec<Vec<Vec2>> = (0..5).map(|k| petal(k, TAU / 5.0, 0.0)).collect();
    assert!(read(&gathered).is_empty(), "one petal of many is no centre");
}

#[test]
fn a_scribble_with_spikes_on_one_side_is_no_corolla() {
    let scribble: Vec<Vec2> = (0..300)
        .map(|k| 0.13 * k as f32)
        .map(|t| 14.0 * Vec2::from_angle(t) + Vec2::new(24.0 * (0.09 * t).sin(), 8.0 * (0.23 * t).cos()))
        .collect();
    let spikes = ring(9.0, 40.0, (PI, TAU));
    assert!(read(&[spikes.clone(), scribble]).is_empty());
    assert_eq!(read(&[spikes, circle(30.0)]).len(), 1, "around a disc it is");
}

#[test]
fn plain_rings_and_scribbles_are_no_corolla() {
    assert!(read(&[ring(1.0, 0.0, (0.0, TAU)), circle(20.0)]).is_empty());
    let frame: Vec<Vec2> =
        [(-60.0, -60.0), (60.0, -60.0), (60.0, 60.0), (-60.0, 60.0), (-60.0, -60.0)].map(Vec2::from).into();
    assert!(read(&[frame, circle(20.0)]).is_empty());
    assert!(read(&[ring(6.0, 30.0, (0.0, 3.0 * TAU)), circle(20.0)]).is_empty());
}

#[test]
fn an_apple_in_a_crown_speaks_less_for_a_flower_than_a_trunk_for_a_tree() {
    let crown = ring(7.0, 8.0, (2.0, 2.0 + TAU));
    let tree = [line((-8.0, 120.0), (-8.0, 40.0)), line((8.0, 120.0), (8.0, 40.0)), crown, circle(16.0)];
    assert!(read(&tree).iter().all(|flower| flower.score < 3.0));
}

#[test]
fn a_ring_of_lobes_far_around_a_small_centre_is_a_corolla_unless_a_trunk_stands_below() {
    let stem = line((0.0, 200.0), (0.0, 58.0));
    let drawing = [stem, ring(8.0, 15.0, (0.0, TAU)), circle(9.0)];
    let found = read(&drawing);
    assert_eq!(found.first().map(|flower| &flower.uses[..]), Some(&[1, 2][..]));
    let sides = [-9.0, 9.0].map(|x| line((x, 160.0), (x, 52.0)));
    let tree = [sides[0].clone(), ring(8.0, 15.0, (0.0, TAU)), circle(9.0), sides[1].clone()];
    assert!(read(&tree).is_empty());
    let aside: Vec<Vec2> = circle(9.0).into_iter().map(|p| p + Vec2::new(25.0, 0.0)).collect();
    assert!(read(&[ring(8.0, 15.0, (0.0, TAU)), aside]).is_empty(), "an apple");
}

#[test]
fn petals_that_were_not_drawn_to_their_end_and_few_far_apart_are_petals() {
    let petal = |turn: f32, end: usize| {
        let at = |angle: f32, away: f32| away * Vec2::from_angle(turn + angle);
        let corners = [at(-0.45, 15.0), at(-0.5, 35.0), at(0.0, 52.0), at(0.5, 35.0), at(0.45, 15.0)];
        even(&corners[..end], 60)
    };
    let open = |count: usize| (0..count).map(move |k| petal(TAU * k as f32 / count as f32, 4));
    let found = read(&open(5).chain([circle(12.0)]).collect::<Vec<_>>());
    assert_eq!(found.first().map(|flower| flower.uses.len()), Some(6));
    let three = (0..3).map(|k| petal(TAU * k as f32 / 3.0, 5));
    let found = read(&three.chain([circle(12.0)]).collect::<Vec<_>>());
    assert_eq!(found.first().map(|flower| flower.uses.len()), Some(4));
}

#[test]
fn leaves_on_a_line_that_goes_on_are_no_corolla() {
    let around = |k: usize| {
        let angle = std::f32::consts::TAU * k as f32 / 6.0;
        let middle = 40.0 * Vec2::from_angle(angle);
        (0..=40).map(|i| middle + 16.0 * Vec2::from_angle(angle + 0.157 * i as f32)).collect::<Vec<_>>()
    };
    let disc: Vec<Vec2> = (0..=40).map(|i| 14.0 * Vec2::from_angle(0.157 * i as f32)).collect();
    let flower: Vec<Vec<Vec2>> = [disc].into_iter().chain((0..6).map(around)).collect();
    assert_eq!(crate::anatomy::conventions::read_by(propose, &flower).len(), 1);
    let stem = |top: f32| vec![Vec2::new(2.0, 200.0), Vec2::new(-2.0, top)];
    let with =
        |top: f32| crate::anatomy::conventions::read_by(propose, &[flower.clone(), vec![stem(top)]].concat());
    assert_eq!(with(60.0).len(), 1, "a stem that ends at it");
    assert!(with(-120.0).is_empty());
}

#[test]
fn circles_of_which_any_may_be_the_centre_are_a_bunch_of_grapes_and_seven_are_a_flower() {
    let at = |row: i32, place: i32| {
        let middle = Vec2::new(40.0 * place as f32 + 20.0 * row as f32, 34.6 * row as f32);
        circle(20.0).into_iter().map(|p| middle + p).collect::<Vec<_>>()
    };
    let bunch: Vec<Vec<Vec2>> =
        (0..5).flat_map(|row| (0..5 - row).map(move |place| at(row, place))).collect();
    assert!(read(&bunch).is_empty());
    let around =
        [(0, 0), (0, 1), (0, -1), (1, 0), (1, -1), (-1, 0), (-1, 1)].map(|(row, place)| at(row, place));
    assert_eq!(read(&around).len(), 1);
}

/// The outline of a petal from the edge of a centre of radius 10 and back, as long as given, in a direction.
fn petal(turn: f32, length: f32) -> Vec<Vec2> {
    let place = |k: usize| {
        let (along, across) = (k as f32 / 60.0, (0.5 * TAU * k as f32 / 60.0).sin());
        let away = 12.0 + length * (0.5 * TAU * along).sin();
        away * Vec2::from_angle(turn + 0.8 * across * (0.5 * TAU * along).cos())
    };
    (0..=60).map(place).collect()
}

#[test]
fn long_petals_around_a_small_centre_with_marks_are_a_corolla_with_them() {
    let mut drawing: Vec<Vec<Vec2>> = (0..5).map(|k| petal(TAU * k as f32 / 5.0, 92.0)).collect();
    drawing.push(circle(10.0));
    let plain = read(&drawing);
    let mark = |k: usize| [16.0, 45.0].map(|away| away * Vec2::from_angle(TAU * k as f32 / 5.0)).to_vec();
    drawing.extend((0..2).map(mark));
    let marked = read(&drawing);
    assert_eq!((plain[0].uses.len(), marked[0].uses.len()), (6, 8));
    assert!(marked[0].score > plain[0].score + 4.0, "leaves with veins are no likelier");
}

#[test]
fn an_arc_between_petals_is_a_petal_behind_them() {
    let mut drawing: Vec<Vec<Vec2>> = (0..4).map(|k| petal(TAU * k as f32 / 5.0, 92.0)).collect();
    drawing.push(circle(10.0));
    let petals = |lines: &[Vec<Vec2>]| {
        read(lines).first().map(|it| it.parts.iter().filter(|part| part.tool == Tool::Petal).count())
    };
    assert_ne!(petals(&drawing), Some(5));
    let far = [(100.0, 0.72), (106.0, 0.8), (100.0, 0.88)];
    let far = far.map(|(away, turn)| away * Vec2::from_angle(turn * TAU));
    drawing.push([&drawing[3][6..7], &far, &drawing[0][54..55]].concat());
    assert_eq!(petals(&drawing), Some(5));
}
