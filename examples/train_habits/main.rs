//! Trains the classifier of whole drawings on drawings by people, and measures it.
//!
//! `cargo run --release --example train_habits -- train` writes the network that ships with the program, from the drawings that
//! may be looked at, the icons and our own freehand sketches, each as it is and as other hands might have drawn it; the same command writes the same bytes.
//! `-- evaluate` prints how many of those by people are recognised by networks that were trained without them (a tenth at a time),
//! and how many of those held back by the network that ships.

mod hands;
#[path = "../../tests/common/people.rs"]
mod people;
mod train;

use anyhow::Context;
use clap::{Parser, Subcommand};
use glam::Vec2;
use penstemon::anatomy::habit_classifier::{CLASSES, Class, Network, features};
use people::{Drawing, Share};
use std::io::Write as _;
use std::path::PathBuf;

#[derive(Parser)]
struct Arguments {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    /// Train on the drawings that may be looked at and write the network.
    Train {
        /// Where to write it.
        #[arg(short, default_value = FILE)]
        out: PathBuf,
    },
    /// Measure: by cross-validation, and the shipped network on what is held back.
    Evaluate,
}

const FILE: &str = "assets/classifier/habits.bin";

/// Hands in which each drawing is drawn again.
const HANDS: u64 = 24;
/// Number of the first of those not by people, which have smaller ones.
const OTHERS: u64 = 1000;
/// Parts into which drawings are split to measure.
const FOLDS: usize = 10;

/// A drawing with its class and its features in several hands, the first its maker's.
struct Known {
    class: Class,
    features: Vec<Vec<f32>>,
}

impl Known {
    /// A drawing in its maker's hand and so many others, which follow from its number.
    fn of(class: Class, drawing: &Drawing, number: u64, hands: u64) -> Self {
        let lines = lines_of(drawing);
        let again = (0..hands).map(|hand| hands::drawn_again(&lines, number * 1000 + hand));
        let all_hands = std::iter::once(lines.clone()).chain(again);
        Self { class, features: all_hands.filter_map(|lines| features(&lines)).collect() }
    }
}

fn main() -> anyhow::Result<()> {
    match Arguments::parse().verb {
        Verb::Train { out } => {
            let mut all = known(&[Share::Development, Share::Opened, Share::Added], HANDS)?;
            all.extend(others()?);
            let network = train::train(&all);
            Ok(std::fs::write(out, network.to_bytes())?)
        }
        Verb::Evaluate => evaluate(),
    }
}

fn known(shares: &[Share], hands: u64) -> anyhow::Result<Vec<Known>> {
    let mut all = Vec::new();
    for share in shares {
        for (number, drawing) in people::drawings(*share)?.iter().enumerate() {
            let class =
                class_of(drawing).with_context(|| format!("a class that is not known: {}", drawing.class))?;
            all.push(Known::of(class, drawing, number as u64, hands));
        }
    }
    Ok(all)
}

/// The icons that show one of the classes, and the freehand sketches that ship with the program.
fn others() -> anyhow::Result<Vec<Known>> {
    let mut all = people::icons()?;
    all.extend(people::freehand_sketches()?);
    let classed = all.iter().zip(OTHERS..).filter_map(|(drawing, number)| {
        class_of_name(&drawing.name).map(|class| Known::of(class, drawing, number, HANDS))
    });
    Ok(classed.collect())
}

fn lines_of(drawing: &Drawing) -> Vec<Vec<Vec2>> {
    let line =
        |points: &[penstemon::sketch::StrokePoint]| points.iter().map(|point| point.position).collect();
    drawing.sketch.strokes.iter().map(|stroke| line(&stroke.points)).collect()
}

fn class_of(drawing: &Drawing) -> Option<Class> {
    Some(match drawing.class.as_str() {
        "bush" => Class::Bush,
        "cactus" => Class::Cactus,
        "flower" => Class::Flower,
        "garden" => Class::Garden,
        "grass" => Class::Grass,
        "house_plant" => Class::Potted,
        "leaf" => Class::Leaf,
        "mushroom" => Class::Mushroom,
        "palm_tree" => Class::Palm,
        // Drawn and grown as a tree.
        "broccoli" | "tree" => Class::Tree,
        _ => return None,
    })
}

/// The class of an icon or a sketch; none where it shows something else, or several plants that nearly touch.
fn class_of_name(name: &str) -> Option<Class> {
    Some(match name {
        "flower" | "flower-2" | "tulip" => Class::Flower,
        "leaf" | "leaf-2" | "leaf-maple" => Class::Leaf,
        "bush" | "shrub" => Class::Bush,
        "cactus" => Class::Cactus,
        "grass" => Class::Grass,
        "house_plant" | "plant" => Class::Potted,
        "mushroom" => Class::Mushroom,
        "palm" | "tree-palm" => Class::Palm,
        "apple_tree" | "christmas-tree" | "fir" | "tree" | "tree-deciduous" | "tree-pine" => Class::Tree,
        _ => return None,
    })
}

fn evaluate() -> anyhow::Result<()> {
    let all = known(&[Share::Development, Share::Opened, Share::Added], HANDS)?;
    let (mut right, mut of) = ([0; CLASSES.len()], [0; CLASSES.len()]);
    for fold in 0..FOLDS {
        // Neighbours in the list are of one class.
        let is_out = |place: usize| place % FOLDS == fold;
        let others = all.iter().enumerate().filter(|(place, _)| !is_out(*place)).map(|(_, known)| known);
        let network = train::train(others);
        for (_, known) in all.iter().enumerate().filter(|(place, _)| is_out(*place)) {
            right[known.class as usize] +=
                usize::from(network.of_features(&known.features[0]).best() == known.class);
            of[known.class as usize] += 1;
        }
    }
    let mut out = std::io::stdout().lock();
    writeln!(out, "by networks that did not know them: {} of {}", right.iter().sum::<usize>(), all.len())?;
    for class in CLASSES {
        writeln!(out, "  {class:?}: {} of {}", right[class as usize], of[class as usize])?;
    }
    let network = Network::read(&std::fs::read(FILE)?)?;
    let held_back = known(&[Share::HeldBack, Share::AddedHeldBack], 0)?;
    let is_right = |known: &&Known| network.of_features(&known.features[0]).best() == known.class;
    writeln!(out, "held back: {} of {}", held_back.iter().filter(is_right).count(), held_back.len())?;
    Ok(())
}
