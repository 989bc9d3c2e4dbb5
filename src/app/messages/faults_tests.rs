//! Errors in every language.

use super::*;
use crate::app::messages::Language;
use crate::app::texture_cut::CutError;
use crate::pen::hid::DeviceInfo;
use crate::photo::{PhotoError, PhotoRemark};
use std::io;

/// One of every kind that has words.
fn known() -> Vec<Box<dyn Localize>> {
    let path = || std::path::PathBuf::from("/home/ann/rose.penstemon");
    let folder = || std::path::PathBuf::from("/home/ann");
    let full = || WriteError::DiskFull { path: path() };
    let read = |fault: Fault, place: Place| fault.at(place, "rose.penstemon");
    let nowhere = Place::default;
    let of_sketch = |fault| BuildError::Setup(SetupError::Param { whose: "the sketch", fault });
    let species = |error| BuildError::Setup(SetupError::Species(error));
    let mut all: Vec<Box<dyn Localize>> = vec![
        Box::new(WriteError::NoFolder { path: path(), folder: folder() }),
        Box::new(WriteError::Denied { path: path(), folder: folder() }),
        Box::new(WriteError::Io { path: path(), source: io::Error::other("7") }),
        Box::new(full()),
        Box::new(SaveError::ChangedByOthers { path: path() }),
        Box::new(SaveError::NewerVersion { path: path(), version: 9.0 }),
        Box::new(SaveError::ReadOnly { path: path() }),
        Box::new(SaveError::TooLarge { bytes: 900 << 20 }),
        Box::new(SaveError::Write(full())),
        Box::new(read(Fault::Io(io::Error::other("7")), nowhere())),
        Box::new(read(Fault::FileTooLarge, nowhere())),
        Box::new(read(Fault::Empty, nowhere())),
        Box::new(read(Fault::NotADrawing { found: "7" }, nowhere())),
        Box::new(read(Fault::Truncated, Place::at(3, 9))),
        Box::new(PictureError::Unreadable("7".to_owned())),
        Box::new(PictureError::NotAPicture),
        Box::new(PictureError::Damaged("7".to_owned())),
        Box::new(PictureError::TooLarge),
        Box::new(CutError::Picture(PictureError::TooLarge)),
        Box::new(CutError::Photo(PhotoError::TooSmall { width: 7, height: 8, least: 9 })),
        Box::new(PhotoError::OneColour { contrast: 7.0, least: 9.0 }),
        Box::new(PhotoError::NothingThere),
        Box::new(PhotoError::CutOff { share: 7.0 }),
        Box::new(PhotoError::NoOutline),
        Box::new(PhotoError::BesidePicture),
        Box::new(PhotoRemark::Several { count: 7 }),
        Box::new(PhotoRemark::TouchesEdge),
        Box::new(PhotoRemark::PartlyBeside { share: 7.0 }),
        Box::new(ChangeError::Full { what: "strokes", limit: 7 }),
        Box::new(ChangeError::Full { what: "points", limit: 7 }),
        Box::new(ChangeError::Reference(PictureError::TooLarge.into())),
        Box::new(ChangeError::Plants(PlantsError::TooMany)),
        of_plant(PlantFault::Species { name: "7".to_owned() }),
        of_plant(PlantFault::Foot),
        of_plant(PlantFault::Age),
        of_plant(PlantFault::Height),
        Box::new(JournalError::Write(full())),
        Box::new(JournalError::NoThread(io::Error::other("7"))),
        Box::new(JournalError::Read { path: path(), source: io::Error::other("7") }),
        Box::new(JournalError::NewerVersion { path: path(), version: 9.0 }),
        Box::new(JournalError::Remove { path: path(), source: io::Error::other("7") }),
        Box::new(Gap::OlderCopy(JournalError::Damaged { path: path(), what: "7".to_owned() })),
        Box::new(Gap::LeftOut { path: path(), record: 3, count: 2, what: "7".to_owned() }),
        Box::new(Gap::StepsOnly { path: path() }),
        Box::new(BuildError::Defect),
        Box::new(of_sketch(ParamError::Unknown { path: "7".to_owned(), nearest: None })),
        Box::new(of_sketch(ParamError::Unknown { path: "7".to_owned(), nearest: Some("8".to_owned()) })),
        Box::new(BuildError::Setup(SetupError::OfSpecies {
            file: "/home/ann/7.toml".to_owned(),
            line: 9,
            fault: ParamError::Range { path: "7".to_owned(), value: 3.5, min: 0.0, max: 1.0 },
        })),
        Box::new(species(SpeciesError::Unknown {
            name: "7".to_owned(),
            nearest: Some("8".to_owned()),
            known: "9".to_owned(),
        })),
        Box::new(species(SpeciesError::Unreadable { file: path(), source: io::Error::other("7") })),
        Box::new(species(SpeciesError::TooLarge { file: path() })),
        Box::new(ExportError::Empty),
        Box::new(ExportError::Overwrites(Overwrites { output: path(), source_file: path() })),
        Box::new(ExportError::Write(full())),
    ];
    all.extend(of_tablets());
    all
}

/// One of every kind that has words and is about a tablet.
fn of_tablets() -> Vec<Box<dyn Localize>> {
    vec![
        refused(TransportError::Permission { path: node(), remedy: Remedy::Rules }.into()),
        refused(TransportError::Permission { path: node(), remedy: Remedy::OwnRule("7".into()) }.into()),
        refused(TransportError::Permission { path: node(), remedy: Remedy::System }.into()),
        refused(TransportError::Permission { path: node(), remedy: Remedy::OtherProgram }.into()),
        refused(TransportError::Permission { path: node(), remedy: Remedy::InputMonitoring }.into()),
        refused(ChooseError::UnlistedForbidden.into()),
        refused(ChooseError::RangesUnread { firmware: "7".into() }.into()),
        refused(TransportError::Gone { path: node() }.into()),
        refused(TransportError::System { path: node(), message: "7".into() }.into()),
        refused(Refusal::TooMany { limit: 32 }),
        refused(unread(StringsKept::Forbidden)),
        refused(unread(StringsKept::Wireless)),
        refused(unread(StringsKept::Unanswered)),
        refused(unread(StringsKept::NotRecorded)),
    ]
}

const NODE: &str = "/dev/hidraw3";
const MODEL: &str = "Huion H640P";

fn node() -> String {
    NODE.to_owned()
}

fn refused(why: Refusal) -> Box<dyn Localize> {
    let device = DeviceInfo { product: MODEL.into(), ..DeviceInfo::default() };
    Box::new(Refused { device, why })
}

fn of_plant(fault: PlantFault) -> Box<dyn Localize> {
    Box::new(ChangeError::Plants(PlantsError::Of { place: 2, fault }))
}

fn unread(reason: StringsKept) -> Refusal {
    ChooseError::StringsUnread { models: vec![MODEL.into(), "another".into()], reason }.into()
}

#[test]
fn the_english_words_are_those_of_the_errors() {
    let english = Messages::new(Language::English);
    for error in known() {
        assert_eq!(error.localize(&english), error.to_string());
    }
}

#[test]
fn what_artists_meet_is_translated_into_chinese() {
    let chinese = Messages::new(Language::Chinese);
    for error in known() {
        let text = error.localize(&chinese);
        // Names and the systems' words stay; sentences do not.
        let words = text.replace("/home/ann/rose.penstemon", "").replace("rose.penstemon", "");
        let words = words.replace("/home/ann", "").replace("Penstemon", "").replace(".penstemon", "");
        let of_tablets =
            [NODE, MODEL, RULES_FILE, RULES_FOLDER, INSTALL_RULES, "penstemon pen record FILE", "--strings"];
        let words = of_tablets.iter().fold(words, |words, name| words.replace(name, ""));
        let latin: Vec<&str> = words.split(|c: char| !c.is_ascii_alphabetic()).collect();
        let known = ["", "e", "MiB", "SVG", "PNG", "JPEG", "USB", "toml"];
        assert!(latin.iter().all(|word| known.contains(word)), "{text}");
        assert!(text.chars().any(|c| c > '\u{4e00}'), "{text}");
    }
}

#[test]
fn what_has_no_words_stays_as_it_is() {
    let error = Fault::TooDeep.at(Place::default(), "a.penstemon");
    assert_eq!(error.localize(&Messages::new(Language::Chinese)), error.to_string());
}
