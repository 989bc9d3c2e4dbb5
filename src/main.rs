//! The `penstemon` program: parses the command line and hands over to [`penstemon::cli`].

use clap::Parser;
use penstemon::cli::{self, Cli};
use std::process::ExitCode;

fn main() -> ExitCode {
    let level = if std::env::var_os("PENSTEMON_DEBUG").is_some() { tracing::Level::DEBUG } else { tracing::Level::WARN };
    tracing_subscriber::fmt().with_max_level(level).with_writer(std::io::stderr).without_time().init();
    match cli::run(Cli::parse()) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("penstemon: {error:#}");
            ExitCode::FAILURE
        }
    }
}
