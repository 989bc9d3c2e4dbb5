//! The `penstemon` program: parses the command line and hands over to [`penstemon::cli`].

use clap::Parser;
use penstemon::cli::{self, Cli};
use std::process::ExitCode;

fn main() -> ExitCode {
    let cli = Cli::parse();
    let level = if cli.verbose { tracing::Level::DEBUG } else { tracing::Level::WARN };
    tracing_subscriber::fmt().with_max_level(level).with_writer(std::io::stderr).without_time().init();
    match cli::run(cli) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("penstemon: {}", cli::one_line(&error));
            ExitCode::FAILURE
        }
    }
}
