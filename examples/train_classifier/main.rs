//! Trains the classifier of strokes on synthetic drawings, and measures it.
//!
//! `cargo run --release --example train_classifier -- train` writes the model that ships with the program; the same
//! command writes the same bytes. `-- evaluate` prints how the shipped model does on synthetic strokes of another seed
//! and, where they are at hand, on people's drawings.

#[path = "../../tests/common/confusion.rs"]
mod confusion;
mod evaluate;
#[path = "../../tests/common/real_strokes.rs"]
mod real_strokes;
#[path = "../../tests/common/synthetic/mod.rs"]
mod synthetic;
mod train;

use clap::{Parser, Subcommand};
use std::path::PathBuf;

#[derive(Parser)]
struct Arguments {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    /// Train on synthetic strokes and write the model.
    Train {
        /// Where to write it.
        #[arg(short, default_value = "assets/classifier/blade_or_branch.txt")]
        out: PathBuf,
    },
    /// Measure the shipped model.
    Evaluate,
}

fn main() -> anyhow::Result<()> {
    match Arguments::parse().verb {
        Verb::Train { out } => Ok(std::fs::write(out, train::train()?)?),
        Verb::Evaluate => evaluate::evaluate(),
    }
}
