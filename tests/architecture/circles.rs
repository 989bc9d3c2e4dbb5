//! Inside of a module, too, data flows one way: files of a folder, and folders beside each other, form no circles.
//!
//! An arrow goes from the file that says a path to the file where what it names is found. Paths count in `use` lines and
//! in code, if they begin with `crate`, `super`, `self` or the name of a child. What a parent only hands on with
//! `pub use` is found in the child that it comes from. `mod child;` is no arrow, nor is a method: a child may hold an
//! `impl` block of its parent's type, which is an arrow from child to parent, and the parent may call what is in it. What
//! only tests say is left out. A folder is a circle's member as a whole among its neighbours; inside of it, the file that
//! declares its children is one more neighbour of theirs, called `(parent)`.

use crate::root;
use crate::source::{Source, sources};
use std::collections::{BTreeMap, BTreeSet};

/// Circles that stand, by folder. The list only ever becomes shorter.
const ALLOWED: &[(&str, &[&str])] = &[];

/// A file or folder, as the path of its module.
type Path = Vec<String>;

/// What each file uses, itself left out.
fn arrows(sources: &BTreeMap<Path, Source>) -> BTreeMap<&Path, BTreeSet<&Path>> {
    let mut arrows: BTreeMap<&Path, BTreeSet<&Path>> = BTreeMap::new();
    for (file, source) in sources {
        let used = source.paths.iter().filter_map(|path| found(sources, &absolute(sources, file, path)?, 0));
        arrows.insert(file, used.filter(|other| *other != file).collect());
    }
    arrows
}

/// A path from the crate's root; `None` for one that leads out of the crate.
fn absolute(sources: &BTreeMap<Path, Source>, file: &Path, path: &[String]) -> Option<Path> {
    let supers = path.iter().take_while(|name| *name == "super").count();
    match path[0].as_str() {
        "crate" => Some(path[1..].to_vec()),
        "super" => Some([file.get(..file.len().checked_sub(supers)?)?, &path[supers..]].concat()),
        "self" => Some([file, &path[1..]].concat()),
        child => {
            let inside = [file.as_slice(), &[child.to_owned()]].concat();
            sources.contains_key(&inside).then(|| [file, path].concat())
        }
    }
}

/// The file in which what a path names is found.
fn found<'a>(sources: &'a BTreeMap<Path, Source>, path: &Path, handed_on: usize) -> Option<&'a Path> {
    let (file, source) = (1..=path.len()).rev().find_map(|k| sources.get_key_value(&path[..k].to_vec()))?;
    let rest = &path[file.len()..];
    let from = rest.first().and_then(|name| source.hands_on.iter().find(|(named, _)| named == name));
    let further = from.filter(|_| handed_on < 8).and_then(|(_, from)| {
        let from = absolute(sources, file, from)?;
        found(sources, &[from.as_slice(), &rest[1..]].concat(), handed_on + 1)
    });
    Some(further.unwrap_or(file))
}

/// The member of a folder that a file belongs to.
fn member(folder: &[String], file: &Path) -> Option<String> {
    let inside = file.strip_prefix(folder)?;
    Some(inside.first().map_or("(parent)", String::as_str).to_owned())
}

/// Sets of members that reach each other.
fn circles(uses: &BTreeMap<String, BTreeSet<String>>) -> Vec<BTreeSet<String>> {
    let reached = |from: &String| {
        let (mut seen, mut next) = (BTreeSet::new(), vec![from]);
        while let Some(member) = next.pop() {
            next.extend(uses.get(member).into_iter().flatten().filter(|used| seen.insert((*used).clone())));
        }
        seen
    };
    let reach: BTreeMap<&String, BTreeSet<String>> = uses.keys().map(|m| (m, reached(m))).collect();
    let circle = |of: &String| -> BTreeSet<String> {
        let back = |other: &&String| reach.get(other).is_some_and(|reached| reached.contains(of));
        reach[of].iter().filter(back).cloned().collect()
    };
    let all: BTreeSet<BTreeSet<String>> = uses.keys().map(circle).filter(|c| c.len() > 1).collect();
    all.into_iter().collect()
}

/// All circles of the crate by their folders.
fn all_circles(sources: &BTreeMap<Path, Source>) -> Vec<(String, BTreeSet<String>)> {
    let arrows = arrows(sources);
    let folders: BTreeSet<&[String]> = sources.keys().flat_map(|f| (1..f.len()).map(|k| &f[..k])).collect();
    let mut all = Vec::new();
    for folder in folders {
        let mut uses: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for (file, used) in &arrows {
            let Some(from) = member(folder, file) else { continue };
            let to = used.iter().filter_map(|other| member(folder, other)).filter(|to| *to != from);
            uses.entry(from.clone()).or_default().extend(to);
        }
        all.extend(circles(&uses).into_iter().map(|circle| (folder.join("::"), circle)));
    }
    all
}

#[test]
fn files_inside_of_modules_form_no_circles() {
    let sources = sources(&root().join("src"));
    assert!(sources.len() > 300, "only {} files were understood", sources.len());
    let found = all_circles(&sources);
    let is_listed = |(folder, circle): &&(String, BTreeSet<String>)| {
        let holds = |members: &[&str]| circle.iter().all(|member| members.contains(&member.as_str()));
        ALLOWED.iter().any(|(listed, members)| listed == folder && holds(members))
    };
    let new: Vec<_> = found.iter().filter(|circle| !is_listed(circle)).collect();
    assert!(new.is_empty(), "files that use each other in a circle: {new:#?}");
    let stands = |(folder, members): &&(&str, &[&str])| {
        found.iter().any(|(of, circle)| of == folder && circle.iter().all(|m| members.contains(&m.as_str())))
    };
    let gone: Vec<_> = ALLOWED.iter().filter(|listed| !stands(listed)).collect();
    assert!(gone.is_empty(), "these circles are gone, take them off the list: {gone:?}");
}

#[test]
fn circles_are_found_through_names_that_are_handed_on() {
    let file = |path: &[&str], text: &str| {
        (path.iter().map(|name| (*name).to_owned()).collect::<Path>(), Source::read(text))
    };
    let sources: BTreeMap<Path, Source> = [
        file(&["house"], "mod door; mod key; mod wall; pub use door::{Door, DoorError as Fault};"),
        file(&["house", "door"], "use super::key::Key; /* super::wall */ fn f() { \"super::wall::W\"; }"),
        file(&["house", "key"], "fn open(_: &super::Door) {}"),
        file(&["house", "wall"], "use super::{key::Key, Fault}; impl super::Door {}"),
    ]
    .into();
    let circle = ["door", "key"].map(str::to_owned).into();
    assert_eq!(all_circles(&sources), [("house".to_owned(), circle)]);
}
