//! The drawings by people that the program is developed on and judged by: they can be read, and the labels fit them.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use crate::people::{CLASSES, Drawing, Share, drawings, icons, icons_added};
use glam::Vec3;
use penstemon::anatomy::conventions::{self, ConventionParams, Habit, Interpretation, SolidKind};
use penstemon::anatomy::{self, AnatomyParams, Part};
use penstemon::depth::{self, DepthParams};
use penstemon::pipeline;
use penstemon::plant::{OrganKind, Shape};
use penstemon::sketch::{self, Reading, Remark, Tool};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

const LABELS: &str = include_str!("fixtures/real_strokes.tsv");
const HABITS: [&str; 12] = [
    "flower",
    "tree",
    "conifer",
    "palm",
    "bush",
    "herb",
    "grass",
    "succulent",
    "potted",
    "garden",
    "leaf",
    "mushroom",
];
const ROLES: [&str; 17] = [
    "stem",
    "trunk_side",
    "trunk_outline",
    "crown",
    "petal",
    "corolla",
    "flower_centre",
    "leaf",
    "midrib",
    "vein",
    "pot",
    "ground",
    "body",
    "spine",
    "scribble",
    "frame",
    "other",
];

/// Drawings of each habit that are read as such, of the development half: fewer is a step back.
const LEAST: [(&str, usize); 11] = [
    ("bush", 11),
    ("flower", 10),
    ("garden", 1),
    ("grass", 11),
    ("herb", 1),
    ("leaf", 15),
    ("mushroom", 2),
    ("palm", 6),
    ("potted", 8),
    ("succulent", 6),
    ("tree", 19),
];

/// Leaves of the development half, leaves themselves left out, that are long and have notches: more is a step back.
const GIANTS: usize = 3;

#[test]
fn all_drawings_are_read_and_split_as_they_were_first() {
    let first = [Share::Development, Share::Opened, Share::HeldBack].map(|share| drawings(share).unwrap());
    assert_eq!(first.map(|share| share.len()), [92, 72, 32]);
    let added = [Share::Added, Share::AddedHeldBack].map(|share| drawings(share).unwrap());
    assert_eq!(added.map(|share| share.len()), [45, 47]);
    assert_eq!(icons().unwrap().len(), 24);
    let added = [false, true].map(|held_back| icons_added(held_back).unwrap().len());
    assert_eq!(added, [43, 48]);
    assert!(CLASSES.is_sorted());
}

#[test]
fn labels_are_of_the_development_half_a_role_for_every_stroke() {
    let rows: Vec<&str> = LABELS.lines().filter(|line| !line.starts_with('#')).collect();
    let drawings = drawings(Share::Development).unwrap();
    assert_eq!(rows.len(), drawings.len());
    for (row, drawing) in rows.iter().zip(&drawings) {
        let [class, index, habit, strokes] = row.split('\t').collect::<Vec<_>>().try_into().unwrap();
        assert_eq!((class, index), (drawing.class.as_str(), drawing.name.as_str()));
        assert!(HABITS.contains(&habit), "{row}");
        let strokes: Vec<&str> = strokes.split(' ').collect();
        assert_eq!(strokes.len(), drawing.sketch.strokes.len(), "{row}");
        let mut parts = BTreeSet::new();
        for piece in strokes.iter().flat_map(|stroke| stroke.split('+')) {
            let (role, part) = piece.split_once(':').unwrap();
            assert!(ROLES.contains(&role), "{row}: {piece}");
            parts.insert(part.parse::<usize>().unwrap());
        }
        let numbered_from_one = parts.iter().copied().eq(1..=parts.len());
        assert!(numbered_from_one, "{row}");
    }
}

/// The habit that the labels give each drawing of the development half.
fn labelled() -> Vec<(Drawing, &'static str)> {
    let habits =
        LABELS.lines().filter(|line| !line.starts_with('#')).map(|row| row.split('\t').nth(2).unwrap());
    drawings(Share::Development).unwrap().into_iter().zip(habits).collect()
}

fn read(drawing: &Drawing) -> Interpretation {
    conventions::interpret(&drawing.sketch.strokes, &ConventionParams::default())
}

/// Whether a drawing is read as a plant of the habit that its label gives.
fn is_read_as(interpretation: &Interpretation, habit: &str) -> bool {
    match habit {
        "tree" => interpretation.habit == Some(Habit::Tree),
        "conifer" => interpretation.habit == Some(Habit::Conifer),
        "bush" => interpretation.habit == Some(Habit::Bush),
        "palm" => interpretation.habit == Some(Habit::Palm),
        "grass" => interpretation.habit == Some(Habit::Grass),
        "succulent" => interpretation.habit == Some(Habit::Succulent),
        "mushroom" => interpretation.habit == Some(Habit::Mushroom),
        "flower" => interpretation.habit == Some(Habit::Flower),
        "potted" => interpretation.solids.iter().any(|drawn| drawn.solid.kind == SolidKind::Pot),
        // Leaves, herbs and gardens may be read in several ways; that they become no trees is counted.
        _ => !matches!(interpretation.habit, Some(Habit::Tree | Habit::Conifer | Habit::Bush | Habit::Palm)),
    }
}

#[test]
fn most_drawings_are_read_as_what_they_show() {
    let mut counts: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
    for (drawing, habit) in labelled() {
        let count = counts.entry(habit).or_default();
        count.1 += 1;
        count.0 += usize::from(is_read_as(&read(&drawing), habit));
    }
    for (habit, least) in LEAST {
        let (right, all) = counts.remove(habit).unwrap();
        assert!(right >= least, "{habit}: {right} of {all}, {least} were right before");
    }
    assert!(counts.is_empty(), "{counts:?}");
}

/// Drawings that were opened or added later: the habit that most of a class have, how many are read as such, and of how many;
/// fewer is a step back.
const LEAST_LATER: [(&str, &str, usize, usize); 10] = [
    ("broccoli", "tree", 10, 10),
    ("bush", "bush", 9, 9),
    ("cactus", "succulent", 14, 14),
    ("flower", "flower", 10, 10),
    ("grass", "grass", 15, 15),
    ("house_plant", "potted", 7, 8),
    ("leaf", "leaf", 11, 11),
    ("mushroom", "mushroom", 8, 8),
    ("palm_tree", "palm", 8, 8),
    ("tree", "tree", 12, 13),
];

#[test]
fn most_drawings_that_came_later_are_read_as_what_they_show() {
    let later: Vec<Drawing> =
        [Share::Opened, Share::Added].iter().flat_map(|share| drawings(*share).unwrap()).collect();
    for (class, habit, least, all) in LEAST_LATER {
        let of_class: Vec<&Drawing> = later.iter().filter(|drawing| drawing.class == class).collect();
        let right = of_class.iter().filter(|drawing| is_read_as(&read(drawing), habit)).count();
        assert!(
            right >= least && of_class.len() == all,
            "{class}: {right} of {}, {least} before",
            of_class.len()
        );
    }
}

/// Icons that were looked at, and what they are read as, the ground and pots left out.
const ICONS: [(&str, &str, &[Reading]); 25] = [
    ("hugeicons", "tree-01", &[Reading::Tree]),
    ("hugeicons", "tree-03", &[Reading::Tree]),
    ("hugeicons", "tree-04", &[Reading::Tree]),
    ("iconoir", "african-tree", &[Reading::Tree]),
    ("streamline", "tree-1", &[Reading::Tree]),
    ("streamline", "tree-2", &[Reading::Tree]),
    ("streamline", "tree-3", &[Reading::Tree]),
    ("lucide", "trees", &[Reading::Tree, Reading::Tree]),
    ("mynaui", "trees", &[Reading::Tree, Reading::Tree]),
    ("tabler", "trees", &[Reading::Tree, Reading::Tree]),
    ("hugeicons", "tulip", &[Reading::Corolla]),
    ("majesticons", "flower-2-line", &[Reading::Corolla]),
    ("streamline", "potted-flower-tulip", &[Reading::Corolla]),
    ("streamline", "rose", &[Reading::Corolla]),
    ("streamline", "lotus", &[Reading::Corolla]),
    ("lucidelab", "flower-lotus", &[Reading::Corolla]),
    ("lucidelab", "flower-rose-single", &[Reading::Corolla]),
    ("hugeicons", "wheat", &[Reading::Leaf]),
    ("lucide", "wheat", &[Reading::Leaf]),
    ("lucide", "clover", &[Reading::Leaf]),
    ("streamline", "clover", &[Reading::Leaf]),
    ("akar", "plant", &[Reading::Leaf]),
    ("lucide", "cherry", &[Reading::Fruit]),
    ("tabler", "cherry", &[Reading::Fruit]),
    ("streamline", "potted-cactus", &[Reading::Cactus]),
];

#[test]
fn icons_are_read_as_what_they_show() {
    let known: Vec<Drawing> = [icons().unwrap(), icons_added(false).unwrap()].into_iter().flatten().collect();
    for (set, name, wanted) in ICONS {
        let icon = known.iter().find(|it| it.class == set && it.name == name).unwrap();
        let mut readings: Vec<Reading> = read(icon).readings.iter().map(|read| read.reading).collect();
        readings.retain(|reading| !matches!(reading, Reading::Ground | Reading::Pot));
        assert_eq!(readings, wanted, "{set} {name}");
    }
}

/// Drawings in which something stands beside a plant, and what must be among their readings.
const BESIDE: [(&str, &str, &[Reading]); 3] = [
    ("garden", "3", &[Reading::Tree, Reading::Bush]),
    ("house_plant", "7", &[Reading::Pot, Reading::Frame]),
    ("house_plant", "4", &[Reading::Pot, Reading::Leaf]),
];

#[test]
fn what_stands_beside_a_plant_is_read_by_itself() {
    let drawings = drawings(Share::Development).unwrap();
    for (class, name, readings) in BESIDE {
        let drawing = drawings.iter().find(|it| it.class == class && it.name == name).unwrap();
        let read = read(drawing).readings;
        let missing = readings.iter().find(|reading| read.iter().all(|r| r.reading != **reading));
        assert_eq!(missing, None, "{class} {name}");
    }
    // A stem, two leaves in one stroke and one that is a line are one plant.
    let potted = drawings.iter().find(|it| it.class == "house_plant" && it.name == "4").unwrap();
    let leaves = read(potted).strokes.iter().filter(|stroke| stroke.tool == Tool::Leaf).count();
    assert_eq!(leaves, 3);
}

/// The drawings made for this, what they show, and what must be among their readings.
const FREEHAND: [(&str, &str, &[Reading]); 12] = [
    ("apple_tree", "tree", &[Reading::Tree]),
    ("bush", "bush", &[Reading::Bush, Reading::Ground]),
    ("cactus", "succulent", &[Reading::Cactus]),
    ("fir", "conifer", &[Reading::Tree]),
    ("flower", "flower", &[Reading::Corolla, Reading::Leaf]),
    ("grass", "grass", &[Reading::Grass]),
    ("house_plant", "potted", &[Reading::Pot, Reading::Leaf]),
    ("leaf", "leaf", &[Reading::Leaf]),
    ("mushroom", "mushroom", &[Reading::Mushroom]),
    ("palm", "palm", &[Reading::Fronds]),
    ("tree", "tree", &[Reading::Tree]),
    ("tulip", "flower", &[Reading::Corolla]),
];

#[test]
fn the_freehand_sketches_are_read_as_what_they_show() {
    for (name, habit, readings) in FREEHAND {
        let file = format!("{}/assets/sketches/freehand_{name}.penstemon", env!("CARGO_MANIFEST_DIR"));
        let (sketch, _) = sketch::read(Path::new(&file)).unwrap();
        assert!(sketch.species.is_none() && sketch.strokes.iter().all(|stroke| stroke.tool == Tool::Auto));
        let read = conventions::interpret(&sketch.strokes, &ConventionParams::default());
        assert!(is_read_as(&read, habit), "{name}: {:?}", read.habit);
        let missing = readings.iter().find(|reading| read.readings.iter().all(|r| r.reading != **reading));
        assert_eq!(missing, None, "{name}");
    }
}

#[test]
fn what_is_drawn_is_a_part_or_remarked_on() {
    for (drawing, _) in labelled() {
        let anatomy = anatomy::analyse(&drawing.sketch, &AnatomyParams::default());
        let remarked: BTreeSet<u64> = anatomy.warnings.iter().filter_map(|warning| warning.stroke).collect();
        let with_others = |stroke: u64| anatomy.readings.iter().any(|read| read.strokes.contains(&stroke));
        for mark in anatomy.marks.iter().filter(|mark| mark.part == Part::Ignored) {
            let is_said = remarked.contains(&mark.stroke) || with_others(mark.stroke);
            assert!(is_said, "{} {}: stroke {} is lost", drawing.class, drawing.name, mark.stroke);
        }
    }
}

#[test]
fn outlines_with_notches_do_not_become_giant_leaves() {
    let mut giants = Vec::new();
    for (drawing, habit) in labelled() {
        let anatomy = anatomy::analyse(&drawing.sketch, &AnatomyParams::default());
        for leaf in anatomy.leaves.iter().filter(|leaf| leaf.axis().length() > 0.4 * anatomy.diagonal) {
            let outline: Vec<_> = leaf.outline.iter().map(|sample| sample.position).collect();
            if habit != "leaf" && conventions::page::notches(&outline).len() >= 2 {
                giants.push(format!("{} {}", drawing.class, drawing.name));
            }
        }
    }
    assert!(giants.len() <= GIANTS, "{giants:?}");
}

/// Drawings of one leaf stand as they were drawn, wherever the stalk is: from the front they are about as high and as wide.
#[test]
fn single_leaves_keep_the_pose_in_which_they_were_drawn() {
    let (mut kept, mut all) = (0, 0);
    for drawing in [Share::Development, Share::Opened].iter().flat_map(|share| drawings(*share).unwrap()) {
        let anatomy = anatomy::analyse(&drawing.sketch, &AnatomyParams::default());
        if drawing.class != "leaf" || anatomy.leaves.len() != 1 {
            continue;
        }
        let species = pipeline::species_of(&drawing.sketch, Path::new("")).unwrap();
        let params = pipeline::params_of(&drawing.sketch, &species, &[]).unwrap();
        let model = pipeline::build(&drawing.sketch, &species, &params).model;
        let points = || model.parts.iter().flat_map(|part| part.points());
        let (low, high) = points().fold((f32::MAX, f32::MIN), |(low, high), p| (low.min(p.y), high.max(p.y)));
        let drawn = anatomy.bounds.1.y - anatomy.bounds.0.y;
        let width = anatomy.bounds.1.x - anatomy.bounds.0.x;
        all += 1;
        if drawn > 0.2 * width {
            let scale = params.depth.world.height / drawn;
            kept += usize::from((0.7..1.3).contains(&((high - low) / (drawn * scale))));
        } else {
            kept += 1;
        }
    }
    assert!(all > 15 && 10 * kept >= 9 * all, "{kept} of {all}");
}

/// Drawings with leaves that hang in the air although there is wood: more is a step back.
const FLOATING: usize = 6;

#[test]
fn no_leaf_is_farther_from_its_branch_than_its_stalk() {
    let mut floating = Vec::new();
    for drawing in [Share::Development, Share::Opened].iter().flat_map(|share| drawings(*share).unwrap()) {
        let anatomy = anatomy::analyse(&drawing.sketch, &AnatomyParams::default());
        let (plant, _) = depth::recover(&anatomy, drawing.sketch.seed, &DepthParams::default());
        for organ in plant.organs.iter().filter(|organ| organ.kind() == OrganKind::Leaf) {
            let Shape::Blade(blade) = &organ.shape else { continue };
            let Some(branch) = organ.branch else {
                if anatomy.branches.iter().any(|branch| branch.stroke.is_some()) {
                    let is_said = anatomy.warnings.iter().any(|w| w.remark == Remark::StandsApart);
                    assert!(is_said, "{} {}", drawing.class, drawing.name);
                    floating.push(format!("{} {}", drawing.class, drawing.name));
                }
                continue;
            };
            let branch = &plant.branches[branch];
            let to_segment = |pair: &[Vec3]| {
                let along = pair[1] - pair[0];
                let share = (blade.base - pair[0]).dot(along) / along.length_squared().max(f32::MIN_POSITIVE);
                blade.base.distance(pair[0] + along * share.clamp(0.0, 1.0))
            };
            let away = branch.points.windows(2).map(to_segment).fold(f32::INFINITY, f32::min);
            let length = plant.templates[blade.template].length() * blade.v.length();
            assert!(away < 0.1 * length, "{} {}: {away} of {length}", drawing.class, drawing.name);
        }
    }
    floating.dedup();
    assert!(floating.len() <= FLOATING, "{floating:?}");
}

#[test]
fn the_papers_way_of_reading_is_one_switch_away() {
    let params = ConventionParams { enabled: false };
    for (drawing, _) in labelled() {
        let strict = conventions::interpret(&drawing.sketch.strokes, &params);
        assert!(strict.remarks.is_empty() && strict.strokes == drawing.sketch.strokes);
    }
}

#[test]
fn tools_that_the_artist_chose_are_never_read_otherwise() {
    for (mut drawing, _) in labelled() {
        for stroke in &mut drawing.sketch.strokes {
            std::sync::Arc::make_mut(stroke).tool = Tool::Branch;
        }
        let interpretation = read(&drawing);
        assert!(interpretation.remarks.iter().all(|warning| !matches!(warning.remark, Remark::ReadAs(_))));
        assert_eq!(interpretation.strokes, drawing.sketch.strokes);
    }
}
