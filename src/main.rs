//! The `penstemon` program: parses the command line and hands over to [`penstemon::cli`].

use clap::Parser;
use penstemon::cli::{self, Cli};
use std::process::ExitCode;
use tracing_subscriber::filter::{LevelFilter, Targets};
use tracing_subscriber::layer::SubscriberExt as _;
use tracing_subscriber::util::SubscriberInitExt as _;

/// A plant is thousands of small vectors, built on several threads. Under Linux it serves the libraries that are loaded as
/// well (`build.rs`).
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Calls an empty clipboard an error.
const NOISY: &str = "winit_x11::data_transfer";

/// What clap ends with.
const WRONG_USAGE: u8 = 2;

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) if error.use_stderr() => {
            eprint!("{}", cli::usage(&error));
            return ExitCode::from(WRONG_USAGE);
        }
        // Help that was asked for.
        Err(help) => help.exit(),
    };
    let level = if cli.verbose { tracing::Level::DEBUG } else { tracing::Level::WARN };
    let log = tracing_subscriber::fmt().with_max_level(level).with_writer(std::io::stderr).without_time();
    log.finish().with(Targets::new().with_default(level).with_target(NOISY, LevelFilter::OFF)).init();
    match cli::run(cli) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("penstemon: {}", cli::one_line(&error));
            ExitCode::FAILURE
        }
    }
}
