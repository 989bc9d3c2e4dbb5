//! Source files as the paths that they say: a small reader of Rust that knows comments, strings and `use` trees.
//!
//! Limits: what macros put together is not seen, and a module inside of a file counts as the file.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The paths of a source file, tests left out.
#[derive(Debug, Default)]
pub(crate) struct Source {
    /// Paths that it uses, in `use` lines and in code.
    pub(crate) paths: Vec<Vec<String>>,
    /// Names that it hands on with `pub use`, and where they come from.
    pub(crate) hands_on: Vec<(String, Vec<String>)>,
}

/// All files of a folder by the paths of their modules, those left out that hold tests only.
pub(crate) fn sources(folder: &Path) -> BTreeMap<Vec<String>, Source> {
    let mut files = Vec::new();
    crate::rust_files(folder, &mut files);
    let mut sources = BTreeMap::new();
    for file in files {
        let inside = file.strip_prefix(folder).unwrap().with_extension("");
        let mut module: Vec<String> = inside.iter().map(|part| part.to_string_lossy().into_owned()).collect();
        let is_test = |name: &String| name == "tests" || name.ends_with("_tests");
        if module.iter().any(is_test)
            || matches!(module.as_slice(), [name] if name == "lib" || name == "main")
        {
            continue;
        }
        module.pop_if(|name| name == "mod");
        sources.insert(module, Source::read(&fs::read_to_string(&file).unwrap()));
    }
    sources
}

impl Source {
    /// Reads a source text.
    pub(crate) fn read(text: &str) -> Self {
        let words = words(text);
        let mut source = Self::default();
        let mut at = 0;
        while at < words.len() {
            let says = |expected: &[&str]| {
                words[at..].iter().zip(expected).filter(|(a, b)| a == b).count() == expected.len()
            };
            if says(&["#", "[", "cfg", "(", "test", ")", "]"]) {
                at = end_of_item(&words, at + 7);
            } else if words[at] == "use" {
                let is_public = at > 0 && (words[at - 1] == "pub" || words[at - 1] == ")");
                let end = at + words[at..].iter().position(|word| word == ";").unwrap_or(words.len() - at);
                source.read_tree(&words[at + 1..end], &[], is_public);
                at = end;
            } else {
                at = source.read_path(&words, at);
            }
        }
        source
    }

    /// Reads a path in code, or steps over one word.
    fn read_path(&mut self, words: &[String], at: usize) -> usize {
        let goes_on = |k: usize| words.get(k).is_some_and(|word| word == "::");
        if !is_name(&words[at])
            || !goes_on(at + 1)
            || (at > 0 && matches!(words[at - 1].as_str(), "::" | "$"))
        {
            return at + 1;
        }
        let mut path = vec![words[at].clone()];
        let mut end = at + 1;
        while goes_on(end) && words.get(end + 1).is_some_and(|word| is_name(word)) {
            path.push(words[end + 1].clone());
            end += 2;
        }
        self.paths.push(path);
        end
    }

    /// Reads what follows `use`, behind the path of the group that it stands in.
    fn read_tree(&mut self, words: &[String], group: &[String], is_public: bool) {
        let mut path = group.to_vec();
        for (k, word) in words.iter().enumerate() {
            match word.as_str() {
                "{" => {
                    let inner = &words[k + 1..words.len() - 1];
                    let (mut depth, mut from) = (0, 0);
                    for (j, word) in inner.iter().map(String::as_str).chain([","]).enumerate() {
                        match word {
                            "{" => depth += 1,
                            "}" => depth -= 1,
                            "," if depth == 0 => {
                                self.read_tree(&inner[from..j.max(from)], &path, is_public);
                                from = j + 1;
                            }
                            _ => {}
                        }
                    }
                    return;
                }
                "as" => break,
                "self" if k == 0 && !group.is_empty() => {}
                "::" | "*" => {}
                name => path.push(name.to_owned()),
            }
        }
        if words.is_empty() || path.is_empty() {
            return;
        }
        let own = words.iter().rev().find(|word| is_name(word) && *word != "self").or(path.last());
        match own {
            Some(own) if is_public => self.hands_on.push((own.clone(), path.clone())),
            _ => self.paths.push(path),
        }
    }
}

/// Where the item ends that begins at a word: behind its semicolon or its closing brace.
fn end_of_item(words: &[String], mut at: usize) -> usize {
    let mut depth = 0;
    while at < words.len() {
        match words[at].as_str() {
            "{" => depth += 1,
            "}" => depth -= 1,
            _ => {}
        }
        at += 1;
        if depth == 0 && matches!(words[at - 1].as_str(), ";" | "}") {
            break;
        }
    }
    at
}

fn is_name(word: &str) -> bool {
    word.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

/// Names, `::` and single signs; comments, strings and characters are left out.
pub(crate) fn words(text: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let name = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        let step = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |end| end + 2)
        } else if let Some(length) = raw_string(rest) {
            length
        } else if first == '"' {
            1 + quoted(&rest[1..], '"')
        } else if first == '\'' {
            character(rest)
        } else if name > 0 {
            words.push(rest[..name].to_owned());
            name
        } else if rest.starts_with("::") {
            words.push("::".to_owned());
            2
        } else {
            if !first.is_whitespace() {
                words.push(first.to_string());
            }
            first.len_utf8()
        };
        rest = &rest[step..];
    }
    words
}

/// Length of a raw string that a text begins with.
fn raw_string(text: &str) -> Option<usize> {
    let after = text.strip_prefix("br").or_else(|| text.strip_prefix('r'))?;
    let hashes = after.len() - after.trim_start_matches('#').len();
    let inside = after[hashes..].strip_prefix('"')?;
    let end = format!("\"{}", "#".repeat(hashes));
    let length = inside.find(&end)? + end.len();
    Some(text.len() - inside.len() + length)
}

/// Length of what stands before the closing quote, that counted.
fn quoted(text: &str, quote: char) -> usize {
    let mut escaped = false;
    for (at, c) in text.char_indices() {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            c if c == quote => return at + 1,
            _ => {}
        }
    }
    text.len()
}

/// Length of a character in quotes, or of the sign before a lifetime.
fn character(text: &str) -> usize {
    let mut inside = text[1..].chars();
    match (inside.next(), inside.next()) {
        (Some('\\'), _) => 1 + quoted(&text[1..], '\''),
        (Some(c), Some('\'')) => 2 + c.len_utf8(),
        _ => 1,
    }
}
