//! Holds the code against the map: a module uses only modules above it in the list of `src/lib.rs`, and the list in
//! `ARCHITECTURE.md` is the same.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

#[path = "architecture/circles.rs"]
mod circles;
#[path = "architecture/names.rs"]
mod names;
#[path = "architecture/random.rs"]
mod random;
#[path = "architecture/source.rs"]
mod source;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Modules in the order in which data flows, from the table in `src/lib.rs`.
fn module_order() -> Vec<String> {
    let lib = fs::read_to_string(root().join("src/lib.rs")).unwrap();
    let rows = lib.lines().filter_map(|line| line.strip_prefix("//! | [`")?.split('`').next());
    rows.map(str::to_owned).collect()
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn rust_files(folder: &Path, out: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            rust_files(&path, out);
        } else if path.extension().is_some_and(|e| e == "rs") {
            out.push(path);
        }
    }
}

/// Modules of this crate named in `crate::…` paths of a text, comments left out.
fn used_modules(text: &str) -> BTreeSet<String> {
    let code: String =
        text.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n");
    let mut used = BTreeSet::new();
    for (at, _) in code.match_indices("crate::") {
        let rest = &code[at + "crate::".len()..];
        let names: Vec<&str> = match rest.strip_prefix('{') {
            Some(group) => top_level_names(group),
            None => rest.split(|c: char| !(c.is_alphanumeric() || c == '_')).take(1).collect(),
        };
        used.extend(names.into_iter().map(str::to_owned));
    }
    used
}

/// First segments inside a `use crate::{…}` group.
fn top_level_names(group: &str) -> Vec<&str> {
    let mut depth = 0;
    let mut names = Vec::new();
    let mut start = Some(0);
    for (i, c) in group.char_indices() {
        let is_word = c.is_alphanumeric() || c == '_';
        if depth == 0 && !is_word && !c.is_whitespace() {
            names.extend(start.take().map(|s| group[s..i].trim()));
        }
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => start = Some(i + 1),
            _ => {}
        }
    }
    names
}

#[test]
fn modules_use_only_what_stands_above_them() {
    let order = module_order();
    assert!(order.len() >= 10, "the table in src/lib.rs was not understood: {order:?}");
    let mut violations = Vec::new();
    for (place, module) in order.iter().enumerate() {
        let mut files = Vec::new();
        let (folder, file) = (root().join("src").join(module), root().join(format!("src/{module}.rs")));
        if folder.is_dir() {
            rust_files(&folder, &mut files);
        } else {
            files.push(file);
        }
        for file in files {
            for used in used_modules(&fs::read_to_string(&file).unwrap()) {
                if order.iter().position(|m| *m == used).is_some_and(|p| p > place) {
                    violations.push(format!("{} uses `{used}`", file.display()));
                }
            }
        }
    }
    assert!(violations.is_empty(), "against the flow of data:\n{}", violations.join("\n"));
}

#[test]
fn every_module_is_in_the_list() {
    let lib = fs::read_to_string(root().join("src/lib.rs")).unwrap();
    let declared: BTreeSet<&str> =
        lib.lines().filter_map(|l| l.strip_prefix("pub mod ")?.strip_suffix(';')).collect();
    let listed = module_order();
    assert_eq!(declared, listed.iter().map(String::as_str).collect::<BTreeSet<_>>());
}

#[test]
fn the_map_in_architecture_md_has_the_same_order() {
    let map = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let rows = map.lines().filter_map(|line| line.strip_prefix("| `")?.split('`').next()).map(str::to_owned);
    let order = module_order();
    let listed: Vec<String> = rows.filter(|name| order.contains(name)).collect();
    assert_eq!(listed, order);
}

#[test]
fn groups_and_single_paths_are_found() {
    let text =
        "use crate::{geom::{a, b}, plant, model::Mesh};\nfn f() { crate::render::go() } // crate::cli\n";
    let names = ["geom", "model", "plant", "render"].map(str::to_owned);
    assert!(used_modules(text).is_superset(&names.into_iter().collect()));
}

#[test]
fn every_source_file_says_what_it_is() {
    let mut files = Vec::new();
    for folder in ["src", "tests", "examples", "benches"] {
        rust_files(&root().join(folder), &mut files);
    }
    let silent: Vec<_> =
        files.iter().filter(|f| !fs::read_to_string(f).unwrap().starts_with("//!")).collect();
    assert!(silent.is_empty(), "no //! header: {silent:?}");
}

#[test]
fn readers_and_writers_of_models_do_not_know_each_other() {
    for (side, other) in [("read", "write"), ("write", "read")] {
        let mut files = Vec::new();
        rust_files(&root().join("src/formats").join(side), &mut files);
        assert!(files.len() > 3, "{side}");
        for file in files {
            let text = fs::read_to_string(&file).unwrap();
            assert!(
                !text.contains(&format!("formats::{other}")),
                "{} uses `formats::{other}`",
                file.display()
            );
        }
    }
}

#[test]
fn pictures_know_nothing_of_growth_and_files() {
    let mut files = Vec::new();
    rust_files(&root().join("src/render"), &mut files);
    for file in files {
        let used = used_modules(&fs::read_to_string(&file).unwrap());
        let unwanted: Vec<_> =
            ["growth", "formats", "pipeline"].into_iter().filter(|m| used.contains(*m)).collect();
        assert!(unwanted.is_empty(), "{} uses {unwanted:?}", file.display());
    }
}

/// Cargo looks for no tests by itself here: a file that no program of tests takes in would never run.
#[test]
fn every_file_of_tests_belongs_to_a_program() {
    let manifest = fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let of_tests = manifest.split("\n[[").filter_map(|table| table.strip_prefix("test]]"));
    let mut run: BTreeSet<String> =
        of_tests.filter_map(|table| Some(table.split('"').nth(1)?.to_owned())).collect();
    let tests = root().join("tests");
    for program in run.clone() {
        let file = [format!("{program}.rs"), format!("{program}/main.rs")].map(|name| tests.join(name));
        let text =
            file.iter().find_map(|file| fs::read_to_string(file).ok()).expect("a file for every program");
        run.extend(
            text.lines().filter_map(|line| Some(line.strip_prefix("mod ")?.strip_suffix(';')?.to_owned())),
        );
    }
    let mut lost = Vec::new();
    for entry in fs::read_dir(&tests).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let is_test = path.extension().is_some_and(|ending| ending == "rs") || path.join("mod.rs").exists();
        if is_test && !run.contains(&name) {
            lost.push(path);
        }
    }
    assert!(lost.is_empty(), "in no program of tests: {lost:?}");
}

#[test]
fn a_species_knows_of_growth_only_the_habit() {
    let all = source::sources(&root().join("src"));
    let species = all.iter().filter(|(file, _)| file[0] == "species");
    let used = species.flat_map(|(_, source)| &source.paths).filter(|path| path[0] == "crate");
    let names: BTreeSet<String> =
        used.filter(|path| path[1] == "growth").map(|path| path.join("::")).collect();
    assert_eq!(names, BTreeSet::from(["crate::growth::Habit".to_owned()]));
}
