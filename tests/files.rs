//! What goes in and comes out: readers, writers, the command line, recovery copies, descriptors and recordings of tablets.
//!
//! One program of tests out of many files: each would be linked by itself, with all libraries, otherwise.

mod check;
mod cli;
mod common;
mod document;
mod export;
mod gardens;
mod grammars;
mod hid_descriptors;
mod hid_plain_reading;
mod inputs;
mod memory;
#[path = "common/not_run.rs"]
mod not_run;
mod pen_recordings;
mod photographs;
mod read_back;
mod reading;
mod recovery;
mod seeds;
mod species_files;
mod svg_tools;
mod tablets;
#[path = "common/tablets.rs"]
#[allow(dead_code, reason = "shared with other tests")]
mod virtual_tablets;
