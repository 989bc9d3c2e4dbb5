//! Pens as the artist has them: the real program under a real X server and a real Wayland compositor, drawn on with
//! simulated tablets.
//!
//! What was drawn is read from the file that the program saves: as many points as the pen told, with its pressure and tilt.
//!
//! Needs Xorg with its dummy screen and its headers, gcc, xdotool and a software driver (Debian: xserver-xorg-core,
//! xserver-xorg-video-dummy, xserver-xorg-dev, gcc, xdotool, mesa-vulkan-drivers). Where one is missing, the tests that need
//! it say so and check nothing.

#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

mod compositor;
mod pen;
mod replay;
mod replay_uses;
#[path = "../common/tablets.rs"]
#[allow(dead_code, reason = "shared with other tests")]
mod tablets;
mod wayland;
mod x11;
mod xorg;
mod xorg_conf;

use crate::not_run::not_run;
use penstemon::sketch::{self, Sketch};
use std::path::{Path, PathBuf};

/// Samples of a stroke.
const SAMPLES: usize = 240;
/// A drawing without strokes.
const EMPTY: &str = r#"{"format": "penstemon-sketch", "version": 1, "strokes": []}"#;

/// An empty drawing in a folder.
fn empty_drawing(home: &Path) -> PathBuf {
    let file = home.join("drawn.penstemon");
    std::fs::write(&file, EMPTY).unwrap();
    file
}

fn saved(file: &Path) -> Sketch {
    let (sketch, warnings) = sketch::read(file).unwrap();
    assert!(warnings.is_empty(), "{warnings:?}");
    sketch
}
