//! Tablets on a real kernel: plugged in through `/dev/uhid`, read through hidraw by the library's own watcher.
//!
//! `tests/kernel/run.sh` boots it as the only program of a virtual machine. It prints one line a check and the verdict last.

#![allow(clippy::print_stdout, reason = "the console is read by the script")]

mod checks;
mod listener;
mod reports;
#[path = "../../common/tablets.rs"]
#[allow(dead_code, reason = "shared with other tests")]
mod tablets;
mod uhid;

use std::error::Error;

/// What every line of ours begins with, since the kernel speaks on the same console.
const SAYS: &str = "PENSTEMON-GUEST";

fn main() {
    if std::env::args().nth(1).as_deref() == Some(checks::VISITOR) {
        if let Err(error) = checks::visit() {
            println!("failed: {error}");
        }
        return;
    }
    println!("{SAYS} {}", verdict().map_or_else(|error| format!("failed: {error}"), |()| "ok".to_owned()));
}

fn verdict() -> Result<(), Box<dyn Error>> {
    for (name, check) in checks::ALL {
        let report = check().map_err(|error| format!("{name}: {error}"))?;
        println!("{SAYS} {name}: {report}");
    }
    Ok(())
}
