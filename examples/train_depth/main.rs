//! The training set of the learned depth, made by this program alone, and the judgement of what was learned.
//!
//! `cargo run --release --example train_depth -- set -o FILE` writes the set, and the habits' names beside it; `train.py` beside this
//! file learns from it. The same command writes the same bytes. `-- judge --whole` prints how well the shipped network does.

mod judge;
mod other_shapes;
mod shapes;
mod trees;
mod views;

use anyhow::{Context as _, Result};
use clap::{Parser, Subcommand};
use penstemon::random::mix;
use rayon::prelude::*;
use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::PathBuf;
use trees::Kind;
use views::View;

#[derive(Parser)]
struct Arguments {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    /// Make the training set.
    Set {
        /// Where to write it.
        #[arg(short)]
        out: PathBuf,
        /// Plants of each habit.
        #[arg(long, default_value_t = 64)]
        plants: u64,
    },
    /// Judge the shipped network on plants that were not trained on.
    Judge {
        /// Plants of each habit.
        #[arg(long, default_value_t = 8)]
        plants: u64,
        /// Build the plant of each drawing, too.
        #[arg(long)]
        whole: bool,
    },
}

/// Sides from which each age of each plant is seen.
const SIDES: u64 = 4;
/// Of so many plants one is never trained on.
const TEST: u64 = 10;
/// Areas that are no crowns, for each plant of a habit.
const SHAPES: u64 = 48;

fn main() -> Result<()> {
    match Arguments::parse().verb {
        Verb::Set { out, plants } => make_set(&out, plants),
        Verb::Judge { plants, whole } => judge::judge(plants, whole),
    }
}

/// What a row is for: habits, 255 for none; 0 trained on, 1 another seed, 2 a habit held back.
fn tail(habit: u8, test: u8) -> [u8; 2] {
    [habit, test]
}

fn make_set(out: &PathBuf, plants: u64) -> Result<()> {
    let mut file =
        BufWriter::new(File::create(out).with_context(|| format!("cannot write {}", out.display()))?);
    let mut rows = 0;
    for (number, kind) in Kind::all()?.iter().enumerate() {
        let started = std::time::Instant::now();
        let of_plant = |plant: u64| {
            let test = if kind.is_held_back() { 2 } else { u8::from(plant.is_multiple_of(TEST)) };
            let seed = mix(number as u64, plant);
            let mut bytes = Vec::new();
            let mut age = 0;
            let grown = kind.grow(seed, |tree| {
                age += 1;
                for side in 0..SIDES {
                    if let Some(view) = View::of(&tree, mix(seed, 100 * age + side)) {
                        bytes.extend(view.bytes());
                        bytes.extend(tail(number as u8, test));
                    }
                }
            });
            grown.map(|()| bytes)
        };
        let all: Vec<Vec<u8>> = (0..plants).into_par_iter().map(of_plant).collect::<Result<_>>()?;
        for bytes in &all {
            file.write_all(bytes)?;
            rows += bytes.len() / (views::BYTES + 2);
        }
        writeln!(
            std::io::stdout(),
            "{:>20}: {rows} rows, {:.1} s",
            kind.name,
            started.elapsed().as_secs_f32()
        )?;
    }
    for shape in 0..plants * SHAPES {
        file.write_all(&shapes::bytes(mix(0x5ea9e, shape))?)?;
        file.write_all(&tail(255, u8::from(shape.is_multiple_of(TEST))))?;
    }
    file.flush()?;
    let names: Vec<String> = Kind::all()?.into_iter().map(|kind| kind.name).collect();
    let beside = format!("{}.names", out.display());
    std::fs::write(&beside, names.join("\n")).with_context(|| format!("cannot write {beside}"))?;
    writeln!(
        std::io::stdout(),
        "{rows} rows of plants and {} of shapes, {} bytes each",
        plants * SHAPES,
        views::BYTES + 2
    )?;
    Ok(())
}
