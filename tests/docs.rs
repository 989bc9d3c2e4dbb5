//! Holds the documents against the repository: every path that they name is there.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use std::fs;
use std::path::{Path, PathBuf};

/// Endings of files that a repository like this one holds.
const ENDINGS: [&str; 12] =
    ["rs", "md", "sh", "toml", "wgsl", "png", "txt", "penstemon", "yml", "lock", "snap", "svg"];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Documents of the repository; what git leaves out (build outputs) is not looked at.
fn documents(folder: &Path, out: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() {
            let skipped = name.starts_with('.') || ["target", "out", "corpus", "shared"].contains(&&*name);
            if !skipped {
                documents(&path, out);
            }
        } else if name.ends_with(".md") {
            out.push(path);
        }
    }
}

/// Targets of links and pictures, `](here)`.
fn links(text: &str) -> Vec<&str> {
    let targets = text.split("](").skip(1).filter_map(|rest| rest.split([')', '#']).next());
    targets.filter(|t| !t.is_empty() && !t.contains("://") && !t.starts_with("mailto:")).collect()
}

/// Words between backticks that look like a path in the repository: with a slash, and ending like a file or a folder.
fn code_paths(text: &str) -> Vec<&str> {
    // Blocks between fences show commands with files of the user's.
    let prose = text.split("```").step_by(2);
    let words = prose.flat_map(|part| part.split('`').skip(1).step_by(2));
    words.filter(|word| is_path(word)).collect()
}

fn is_path(word: &str) -> bool {
    let plain = word.chars().all(|c| c.is_ascii_alphanumeric() || "_-./".contains(c));
    let ending = word.rsplit('/').next().and_then(|name| Some(name.rsplit_once('.')?.1));
    plain && word.contains('/') && (word.ends_with('/') || ending.is_some_and(|e| ENDINGS.contains(&e)))
}

#[test]
fn every_path_in_the_documents_exists() {
    let mut files = Vec::new();
    documents(&root(), &mut files);
    assert!(files.len() >= 4, "{files:?}");
    let mut missing = Vec::new();
    for file in &files {
        let text = fs::read_to_string(file).unwrap();
        let beside = file.parent().unwrap();
        let lost_links = links(&text).into_iter().filter(|target| !beside.join(target).exists());
        // The map names modules from `src`, the rest of it and other documents from the root.
        let bases = [root(), root().join("src"), beside.to_owned()];
        let lost_paths = code_paths(&text).into_iter().filter(|p| !bases.iter().any(|b| b.join(p).exists()));
        missing.extend(lost_links.chain(lost_paths).map(|path| format!("{}: {path}", file.display())));
    }
    assert!(missing.is_empty(), "these are named but not there:\n{}", missing.join("\n"));
}

#[test]
fn paths_are_distinguished_from_other_words() {
    let text = "see [a](docs/a.md#b) and [b](https://x.y), `geom/mod.rs`, `a/b`, `x.rs`, `fuzz/`, `N*.rs`";
    assert_eq!(links(text), ["docs/a.md"]);
    assert_eq!(code_paths(text), ["geom/mod.rs", "fuzz/"]);
}

#[test]
fn the_species_of_a_drawing_without_one_is_the_documented_one() {
    let text = fs::read_to_string(root().join("docs/sketches.md")).unwrap();
    let row = text.lines().find(|line| line.starts_with("| `species` |")).unwrap();
    let usual = row.split('|').nth(3).unwrap();
    assert!(usual.contains(&format!("`{}`", penstemon::pipeline::DEFAULT_SPECIES)), "{row}");
}
