//! What serde says about a bad file, in our words: which fault, in which stroke, and what to do.

use super::progress::Progress;
use super::{FORMAT, VERSION};
use crate::quote;
use crate::sketch::draft::Flaw;
use crate::sketch::error::Fault;
use serde::Deserialize;
use serde_json::error::Category;

/// The fault behind `error`. A file of another format or version is reported as such, whatever the parser stumbled over first.
pub(super) fn flaw(error: &serde_json::Error, text: &str, progress: &Progress) -> Flaw {
    let place = progress.place(error.line(), error.column());
    if let Some(fault) = header_fault(text) {
        return (Default::default(), fault);
    }
    let fault = progress.take_fault().unwrap_or_else(|| translate(error, text));
    (place, progress.in_item(fault))
}

/// The two fields that say whether the rest can be understood.
#[derive(Deserialize)]
struct Header {
    format: Option<String>,
    version: Option<f64>,
}

fn header_fault(text: &str) -> Option<Fault> {
    let header: Header = serde_json::from_str(text).ok()?;
    let format = check_format(header.format.as_deref());
    format.and_then(|()| header.version.map_or(Ok(()), check_version)).err()
}

/// The version of a sketch file that is too new for this program; `None` for any other bytes.
pub fn newer_version(bytes: &[u8]) -> Option<f64> {
    let header: Header = serde_json::from_slice(bytes).ok()?;
    check_format(header.format.as_deref()).ok()?;
    header.version.filter(|version| *version > f64::from(VERSION))
}

/// Whether the `format` field names this program's sketches.
pub(super) fn check_format(format: Option<&str>) -> Result<(), Fault> {
    match format {
        Some(FORMAT) => Ok(()),
        Some(other) => Err(Fault::WrongFormat { found: format!("\"{}\"", quote::name(other)) }),
        None => Err(Fault::WrongFormat { found: "missing".into() }),
    }
}

/// Whether the `version` field is one that this program reads.
pub(super) fn check_version(version: f64) -> Result<(), Fault> {
    let known = (1..=VERSION).any(|known| version == f64::from(known));
    if known { Ok(()) } else { Err(Fault::WrongVersion { found: version, newest: VERSION }) }
}

fn translate(error: &serde_json::Error, text: &str) -> Fault {
    let full = error.to_string();
    let position = format!(" at line {} column {}", error.line(), error.column());
    let message = full.strip_suffix(&position).unwrap_or(&full);
    if message == "recursion limit exceeded" {
        return Fault::TooDeep;
    }
    if message == "number out of range" {
        return Fault::NotFinite { found: word_at(text, error) };
    }
    if error.classify() == Category::Eof {
        return Fault::Truncated;
    }
    let word = word_at(text, error);
    if error.is_syntax() && is_no_number(&word) || message.starts_with("invalid type: null, expected f") {
        let found = if word.is_empty() { "null".to_owned() } else { word };
        return Fault::NotFinite { found };
    }
    let plain = message
        .replace("expected u64", "expected a whole number, zero or more")
        .replace("expected f32", "expected a number")
        .replace("expected f64", "expected a number");
    Fault::Malformed(quote::message(&plain))
}

/// How programs spell numbers that JSON cannot.
fn is_no_number(word: &str) -> bool {
    let word = word.trim_start_matches(['+', '-']).to_ascii_lowercase();
    ["nan", "inf", "infinity"].contains(&word.as_str())
}

/// The number or name that the error's line and column point into or at the end of.
fn word_at(text: &str, error: &serde_json::Error) -> String {
    let line = text.split('\n').nth(error.line().saturating_sub(1)).unwrap_or_default().as_bytes();
    let belongs = |b: &u8| b.is_ascii_alphanumeric() || matches!(b, b'.' | b'+' | b'-');
    let at = error.column().saturating_sub(1).min(line.len());
    let before = line[..at].iter().rev().take_while(|b| belongs(b)).count();
    let after = line[at..].iter().take_while(|b| belongs(b)).count();
    quote::name(&String::from_utf8_lossy(&line[at - before..at + after]))
}
