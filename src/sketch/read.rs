//! Opening a drawing: from bytes to a [`Sketch`], whatever the format.
//!
//! The content decides, not the file name: `{` begins a sketch file, `<` an SVG. Reading is total; size is checked
//! before anything is parsed, see [`super::limits`].

use super::draft::{Flaw, Purpose};
use super::error::{Fault, Place};
use super::warnings::Warnings;
use super::{Sketch, SketchError, Warning, json, limits, svg};
use crate::input;
use std::io::ErrorKind;
use std::path::Path;

/// Reads a `.penstemon` or SVG drawing, with remarks on what was odd in it.
///
/// # Errors
/// A file that cannot be opened, is too large, or holds no drawing; the message names file, stroke, reason and remedy.
pub fn read(path: &Path) -> Result<(Sketch, Vec<Warning>), SketchError> {
    from_bytes(&load(path)?, &path.display().to_string())
}

/// Reads a drawing that is already in memory; `name` stands for the file in error messages.
///
/// # Errors
/// As [`read`], but for opening the file.
pub fn from_bytes(bytes: &[u8], name: &str) -> Result<(Sketch, Vec<Warning>), SketchError> {
    finished(bytes, name, Purpose::Build)
}

/// As [`from_bytes`], but to draw on in it: a sketch file may then hold no stroke yet, or mere dots.
///
/// # Errors
/// As [`from_bytes`], but for drawings in which no stroke moves; of an SVG, which only brings strokes, one is asked.
pub fn editable_from_bytes(bytes: &[u8], name: &str) -> Result<(Sketch, Vec<Warning>), SketchError> {
    finished(bytes, name, Purpose::Edit)
}

fn finished(bytes: &[u8], name: &str, purpose: Purpose) -> Result<(Sketch, Vec<Warning>), SketchError> {
    let mut warnings = Warnings::default();
    let sketch = parse(bytes, purpose, &mut warnings).map_err(|(place, fault)| fault.at(place, name))?;
    Ok((sketch, warnings.into_vec()))
}

/// The file's bytes.
///
/// # Errors
/// A file that cannot be opened or is too large.
pub(super) fn load(path: &Path) -> Result<Vec<u8>, SketchError> {
    load_limited(path).map_err(|fault| fault.at(Place::default(), &path.display().to_string()))
}

fn load_limited(path: &Path) -> Result<Vec<u8>, Fault> {
    input::read(path, limits::MAX_FILE_BYTES).map_err(|error| match error.kind() {
        ErrorKind::FileTooLarge => Fault::FileTooLarge,
        _ => Fault::Io(error),
    })
}

fn parse(bytes: &[u8], purpose: Purpose, warnings: &mut Warnings) -> Result<Sketch, Flaw> {
    let nowhere = |fault| (Place::default(), fault);
    if bytes.len() as u64 > limits::MAX_FILE_BYTES {
        return Err(nowhere(Fault::FileTooLarge));
    }
    if let Some(found) = foreign_format(bytes) {
        return Err(nowhere(Fault::NotADrawing { found }));
    }
    let text = str::from_utf8(bytes).map_err(|e| nowhere(Fault::NotUtf8 { offset: e.valid_up_to() }))?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    match text.trim_start().chars().next() {
        Some('{') => json::parse(text)?.finish(purpose, warnings),
        Some('<') => svg::parse(text, warnings)?.finish(Purpose::Build, warnings),
        None => Err(nowhere(Fault::Empty)),
        Some(_) => Err(nowhere(Fault::NotADrawing { found: "it begins with neither `{` nor `<`" })),
    }
}

/// Names a binary format that is easily taken for a drawing.
fn foreign_format(bytes: &[u8]) -> Option<&'static str> {
    let known: [(&[u8], _); 6] = [
        (b"\x1f\x8b", "it is compressed, perhaps .svgz: save it as plain .svg"),
        (b"\xff\xfe", "it is UTF-16 text: save it as UTF-8"),
        (b"\xfe\xff", "it is UTF-16 text: save it as UTF-8"),
        (b"\x89PNG", "it is a PNG picture, which has no strokes"),
        (b"\xff\xd8\xff", "it is a JPEG picture, which has no strokes"),
        (b"PK\x03\x04", "it is a ZIP archive, perhaps .kra: export its vector layer as .svg"),
    ];
    known.into_iter().find(|(start, _)| bytes.starts_with(start)).map(|(_, found)| found)
}
