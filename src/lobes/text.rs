//! Lobes as a text file: JSON, every key known, every number in range.
//!
//! `docs/lobes.md` describes it. A file is screened before anything is made of it: how large it is, how many strokes and samples it has,
//! and that every sample is a place within [`FARTHEST`].

use super::lobe::{Crown, Form, Lobe, Offset, Pose, SpaceStroke, Trunk};
use crate::{input, quote};
use glam::Vec3;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Largest file that is read, bytes.
pub const MAX_BYTES: u64 = 32 << 20;
/// Most lobes, trunks, strokes of all lobes, and samples of all strokes.
const MOST: [usize; 4] = [64, 64, 4096, 400_000];
/// Most offsets of a lobe.
const MOST_OFFSETS: usize = 200_000;
/// Farthest coordinate, metres.
pub const FARTHEST: f32 = 1000.0;
/// Least and largest scale of a pose.
const SCALES: (f32, f32) = (1e-3, 1e3);
/// What the file says it is.
const FORMAT: &str = "penstemon-lobes";
/// The version that is read and written.
const VERSION: u32 = 1;

/// A file of lobes that cannot be used.
#[derive(Debug, Error)]
pub enum TextError {
    /// It cannot be read.
    #[error("cannot read the lobes {}: {source}", .file.display())]
    Unreadable {
        /// The file.
        file: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// No JSON, an unknown key or a wrong type.
    #[error("{file}, line {line}, `{text}`: {reason}")]
    Invalid {
        /// The file.
        file: String,
        /// Line number, from 1.
        line: usize,
        /// What stands in that line.
        text: String,
        /// What is wrong with it.
        reason: String,
    },
    /// A number, a name or a count that cannot be.
    #[error("{file}: {place}: {reason}")]
    Wrong {
        /// The file.
        file: String,
        /// Where in it.
        place: String,
        /// What is wrong there, and what to do.
        reason: String,
    },
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    format: String,
    version: u32,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    trunks: Vec<WrittenTrunk>,
    lobes: Vec<WrittenLobe>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenTrunk {
    points: Vec<[f32; 3]>,
    radius: f32,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenLobe {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    name: Option<String>,
    strokes: Vec<WrittenStroke>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    form: Option<WrittenForm>,
    #[serde(default, skip_serializing_if = "is_false")]
    in_order: bool,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    deform: Vec<(u32, f32, f32, f32)>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pose: Option<WrittenPose>,
    #[serde(default, skip_serializing_if = "is_false")]
    negative: bool,
    #[serde(default, skip_serializing_if = "is_false")]
    off: bool,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenStroke {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    closed: Option<bool>,
    points: Vec<[f32; 3]>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum WrittenForm {
    Loft,
    Turned,
    Sheet,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct WrittenPose {
    #[serde(rename = "move")]
    shift: [f32; 3],
    turn_deg: [f32; 3],
    scale: f32,
}

impl Default for WrittenPose {
    fn default() -> Self {
        Self { shift: [0.0; 3], turn_deg: [0.0; 3], scale: 1.0 }
    }
}

fn is_false(value: &bool) -> bool {
    !value
}

/// Reads a file of lobes.
///
/// # Errors
/// [`TextError`].
pub fn read(path: &Path) -> Result<Crown, TextError> {
    let unreadable = |source| TextError::Unreadable { file: path.to_owned(), source };
    let bytes = input::read(path, MAX_BYTES).map_err(unreadable)?;
    let text = String::from_utf8(bytes).map_err(|error| unreadable(io::Error::other(error)))?;
    from_json(&text, &path.display().to_string())
}

/// Lobes from text; `name` stands for the file in messages.
///
/// # Errors
/// [`TextError::Invalid`], [`TextError::Wrong`].
pub fn from_json(text: &str, name: &str) -> Result<Crown, TextError> {
    let written: Written = serde_json::from_str(text).map_err(|error| {
        let line = error.line().max(1);
        let there = quote::name(text.lines().nth(line - 1).unwrap_or_default().trim());
        let reason = quote::message(&error.to_string());
        TextError::Invalid { file: name.to_owned(), line, text: there, reason }
    })?;
    crown(written).map_err(|(place, reason)| TextError::Wrong { file: name.to_owned(), place, reason })
}

/// What is wrong, and where.
type Wrong = (String, String);

fn wrong<T>(place: impl Into<String>, reason: impl Into<String>) -> Result<T, Wrong> {
    Err((place.into(), reason.into()))
}

fn crown(written: Written) -> Result<Crown, Wrong> {
    if written.format != FORMAT || written.version != VERSION {
        let found = format!("{} of version {}", quote::name(&written.format), written.version);
        return wrong("format", format!("it is {found}; write \"{FORMAT}\" and version {VERSION}"));
    }
    if written.lobes.is_empty() {
        return wrong("lobes", "there is none; add a lobe with strokes");
    }
    let strokes = || written.lobes.iter().flat_map(|lobe| &lobe.strokes);
    let samples = strokes().map(|stroke| stroke.points.len()).sum::<usize>()
        + written.trunks.iter().map(|trunk| trunk.points.len()).sum::<usize>();
    let counts = [written.lobes.len(), written.trunks.len(), strokes().count(), samples];
    for ((count, most), what) in counts.into_iter().zip(MOST).zip(["lobes", "trunks", "strokes", "samples"]) {
        if count > most {
            return wrong(
                "lobes",
                format!("{count} {what} are more than the {most} of a file; leave some out"),
            );
        }
    }
    let mut names = BTreeSet::new();
    let lobes = written.lobes.into_iter().zip(1..).map(|(lobe, number)| {
        let lobe = read_lobe(lobe, number)?;
        if names.insert(lobe.name.clone()) {
            return Ok(lobe);
        }
        wrong(
            format!("lobe {number}"),
            format!("another lobe is called `{}`; rename one", quote::name(&lobe.name)),
        )
    });
    let lobes = lobes.collect::<Result<_, Wrong>>()?;
    let trunks = written.trunks.into_iter().zip(1..).map(|(trunk, number)| read_trunk(trunk, number));
    Ok(Crown { lobes, trunks: trunks.collect::<Result<_, Wrong>>()? })
}

fn read_lobe(written: WrittenLobe, number: usize) -> Result<Lobe, Wrong> {
    let name = written.name.unwrap_or_else(|| format!("lobe_{number}"));
    let here = format!("lobe {number} `{}`", quote::name(&name));
    if name.trim().is_empty() || name.len() > quote::NAME {
        return wrong(here, format!("a name has 1 to {} bytes; give it another", quote::NAME));
    }
    let strokes = written.strokes.into_iter().zip(1..).map(|(stroke, of)| {
        let points = places(&stroke.points, &format!("{here}, stroke {of}"))?;
        Ok(SpaceStroke { closed: stroke.closed, points })
    });
    let strokes = strokes.collect::<Result<_, Wrong>>()?;
    let form = written.form.map_or(Form::Auto, |form| match form {
        WrittenForm::Loft => Form::Loft,
        WrittenForm::Turned => Form::Turned,
        WrittenForm::Sheet => Form::Sheet,
    });
    let pose = read_pose(written.pose.unwrap_or_default(), &here)?;
    let deform = offsets(&written.deform, &here)?;
    let (in_order, negative, off) = (written.in_order, written.negative, written.off);
    Ok(Lobe { name, strokes, form, in_order, deform, pose, negative, off })
}

fn places(points: &[[f32; 3]], here: &str) -> Result<Vec<Vec3>, Wrong> {
    let places = points.iter().zip(1..).map(|(p, number)| {
        let p = Vec3::from_array(*p);
        if p.is_finite() && p.abs().max_element() <= FARTHEST {
            return Ok(p);
        }
        wrong(
            format!("{here}, point {number}"),
            format!("coordinates are metres from -{FARTHEST} to {FARTHEST}; scale the lobes"),
        )
    });
    places.collect()
}

fn read_pose(written: WrittenPose, here: &str) -> Result<Pose, Wrong> {
    let WrittenPose { shift, turn_deg, scale } = written;
    let here = format!("{here}, pose");
    let shift = places(&[shift], &here)?[0];
    let turn_deg = Vec3::from_array(turn_deg);
    if !(turn_deg.is_finite() && turn_deg.abs().max_element() <= 3600.0) {
        return wrong(here, "`turn_deg` has degrees from -3600 to 3600; turn it less");
    }
    if !(SCALES.0..=SCALES.1).contains(&scale) {
        return wrong(here, format!("`scale` is a number from {} to {}; choose another", SCALES.0, SCALES.1));
    }
    Ok(Pose { shift, turn_deg, scale })
}

fn offsets(written: &[(u32, f32, f32, f32)], here: &str) -> Result<Vec<Offset>, Wrong> {
    if written.len() > MOST_OFFSETS {
        let count = written.len();
        return wrong(
            format!("{here}, deform"),
            format!("{count} entries are more than the {MOST_OFFSETS} of a lobe; leave some out"),
        );
    }
    let mut seen = BTreeSet::new();
    let each = written.iter().zip(1..).map(|((vertex, x, y, z), number)| {
        let by = places(&[[*x, *y, *z]], &format!("{here}, deform, entry {number}"))?[0];
        if seen.insert(*vertex) {
            return Ok(Offset { vertex: *vertex, by });
        }
        wrong(
            format!("{here}, deform, entry {number}"),
            format!("vertex {vertex} has an entry already; add both up"),
        )
    });
    each.collect()
}

fn read_trunk(written: WrittenTrunk, number: usize) -> Result<Trunk, Wrong> {
    let here = format!("trunk {number}");
    let mut points = places(&written.points, &here)?;
    points.dedup();
    if points.len() < 2 {
        return wrong(here, "it has no length; give it two points or more");
    }
    let radius = written.radius;
    if !(radius > 0.0 && radius <= 0.1 * FARTHEST) {
        return wrong(here, format!("`radius` is a number of metres above 0, at most {}", 0.1 * FARTHEST));
    }
    Ok(Trunk { points, radius })
}

/// The text of a file of lobes, from which the same lobes can be read again.
pub fn to_json(crown: &Crown) -> String {
    let points = |points: &[Vec3]| points.iter().map(Vec3::to_array).collect();
    let lobe = |lobe: &Lobe| WrittenLobe {
        name: Some(lobe.name.clone()),
        strokes: lobe
            .strokes
            .iter()
            .map(|stroke| WrittenStroke { closed: stroke.closed, points: points(&stroke.points) })
            .collect(),
        form: match lobe.form {
            Form::Auto => None,
            Form::Loft => Some(WrittenForm::Loft),
            Form::Turned => Some(WrittenForm::Turned),
            Form::Sheet => Some(WrittenForm::Sheet),
        },
        in_order: lobe.in_order,
        deform: lobe.deform.iter().map(|o| (o.vertex, o.by.x, o.by.y, o.by.z)).collect(),
        pose: (lobe.pose != Pose::default()).then(|| WrittenPose {
            shift: lobe.pose.shift.to_array(),
            turn_deg: lobe.pose.turn_deg.to_array(),
            scale: lobe.pose.scale,
        }),
        negative: lobe.negative,
        off: lobe.off,
    };
    let trunk = |trunk: &Trunk| WrittenTrunk { points: points(&trunk.points), radius: trunk.radius };
    let written = Written {
        format: FORMAT.to_owned(),
        version: VERSION,
        trunks: crown.trunks.iter().map(trunk).collect(),
        lobes: crown.lobes.iter().map(lobe).collect(),
    };
    // Plain numbers and text always have a JSON form.
    serde_json::to_string(&written).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    const RING: &str = r#"{"closed": true, "points": [[1,1,0],[0,1,1],[-1,1,0],[0,1,-1]]}"#;

    fn file(lobes: &str) -> String {
        format!("{{\"format\": \"penstemon-lobes\", \"version\": 1,\n\"lobes\": [{lobes}]}}")
    }

    fn message(text: &str) -> String {
        from_json(text, "crown.json").unwrap_err().to_string()
    }

    #[test]
    fn what_is_written_is_read_again() {
        let text = format!(
            "{{\"format\": \"penstemon-lobes\", \"version\": 1, \"trunks\": [{{\"points\": [[0,0,0],[0,1,0]], \"radius\": 0.1}}],
            \"lobes\": [{{\"name\": \"top\", \"strokes\": [{RING}, {{\"points\": [[0,2,0],[1,2,0]]}}], \"form\": \"loft\",
            \"in_order\": true, \"deform\": [[3, 0.5, 0, -1]], \"pose\": {{\"move\": [1,2,3], \"scale\": 2}}, \"negative\": true}},
            {{\"strokes\": [{RING}], \"off\": true}}]}}"
        );
        let crown = from_json(&text, "crown.json").unwrap();
        assert_eq!(crown.lobes[1].name, "lobe_2");
        assert_eq!(crown.lobes[0].pose.scale, 2.0);
        assert!(crown.lobes[0].negative && crown.lobes[1].off && crown.trunks.len() == 1);
        assert_eq!(from_json(&to_json(&crown), "again").unwrap(), crown);
    }

    #[test]
    fn what_is_wrong_is_said_with_its_place() {
        let lobe = |rest: &str| message(&file(&format!("{{\"strokes\": [{RING}]{rest}}}")));
        for (text, expected) in [
            (message("{"), "crown.json, line 1"),
            (message(&file("").replace("lobes\", ", "lobe\", ")), "write \"penstemon-lobes\""),
            (message(&file("").replace("1,", "7,")), "version 7"),
            (message(&file("")), "there is none"),
            (lobe(", \"colour\": 3"), "unknown field `colour`"),
            (lobe(", \"pose\": {\"scale\": 0}"), "lobe 1 `lobe_1`, pose: `scale`"),
            (lobe(", \"pose\": {\"turn_deg\": [0, 1e9, 0]}"), "turn it less"),
            (lobe(", \"deform\": [[1,0,0,0],[1,0,0,0]]"), "entry 2: vertex 1"),
            (lobe(", \"form\": \"round\""), "round"),
            (lobe(", \"name\": \"\""), "a name has"),
            (
                message(&file(&format!(
                    "{{\"name\": \"a\", \"strokes\": [{RING}]}}, {{\"name\": \"a\", \"strokes\": []}}"
                ))),
                "rename one",
            ),
            (
                message(&file("{\"strokes\": [{\"points\": [[0,0,0],[1e9,0,0]]}]}")),
                "stroke 1, point 2: coordinates",
            ),
            (message(&file("{\"strokes\": [{\"points\": [[0,0,NaN]]}]}")), "line 2"),
            (message(&file("{\"strokes\": [{\"points\": [[0,0,1e39]]}]}")), "line 2"),
            (message(&file("{\"strokes\": [{\"points\": [[0,0]]}]}")), "line 2"),
        ] {
            assert!(text.contains(expected) && !text.contains('\n'), "{expected}: {text}");
        }
        let trunk = |trunk: &str| {
            message(
                &file(&format!("{{\"strokes\": [{RING}]}}"))
                    .replace("\"lobes\"", &format!("\"trunks\": [{trunk}], \"lobes\"")),
            )
        };
        assert!(trunk("{\"points\": [[0,0,0]], \"radius\": 1}").contains("no length"));
        assert!(trunk("{\"points\": [[0,0,0],[0,1,0]], \"radius\": 0}").contains("radius"));
    }

    #[test]
    fn limits_hold() {
        let many = |count: usize, of: &str| vec![of; count].join(",");
        assert!(message(&file(&many(65, "{\"strokes\": []}"))).contains("more than the 64"));
        let strokes = format!("{{\"strokes\": [{}]}}", many(4097, "{\"points\": []}"));
        assert!(message(&file(&strokes)).contains("4097 strokes"));
        let samples = format!("{{\"strokes\": [{{\"points\": [{}]}}]}}", many(400_001, "[0,0,0]"));
        assert!(message(&file(&samples)).contains("400001 samples"));
        assert!(
            message(&file(&format!("{{\"strokes\": [], \"deform\": [{}]}}", many(200_001, "[0,0,0,0]"))))
                .contains("200001")
        );
    }
}
