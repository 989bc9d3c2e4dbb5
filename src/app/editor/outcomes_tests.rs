//! Tests of what the editor reports about tablets.

use super::*;
use crate::app::action::Action;
use crate::app::editor::Places;
use crate::app::messages::Language;
use crate::pen::hid::{ChooseError, DeviceInfo, Refused, StringsKept};
use std::path::Path;

fn editor(home: &Path) -> Editor {
    let places = Places { config: home.join("config"), state: home.join("state") };
    Editor::open_in(places, None, || ()).unwrap()
}

fn refused() -> Refused {
    let models = vec!["Huion H640P".to_owned(), "Huion H950P".to_owned()];
    let why = ChooseError::StringsUnread { models, reason: StringsKept::Forbidden }.into();
    Refused { device: DeviceInfo { product: "HUION Tablet".into(), ..DeviceInfo::default() }, why }
}

#[test]
fn what_keeps_a_tablet_from_being_read_is_reported_once_and_in_the_language_of_the_interface() {
    let home = tempfile::tempdir().unwrap();
    let mut editor = editor(home.path());
    let reported = |editor: &Editor| -> Vec<String> {
        editor.dialogs.notices().iter().map(|notice| notice.what.clone()).collect()
    };
    let before = reported(&editor).len();
    editor.perform(Action::SetLanguage(Language::English));
    assert!(editor.note_tablets(Some(&refused()), &[]) && !editor.note_tablets(Some(&refused()), &[]));
    let new = reported(&editor)[before..].to_vec();
    assert!(new.len() == 1 && new[0].contains("./run.sh --install-udev"), "{new:?}");
    assert_eq!(editor.panel_snapshot().pen.trouble.as_ref(), new.last());
    editor.perform(Action::SetLanguage(Language::Chinese));
    editor.note_tablets(Some(&refused()), &[]);
    let trouble = editor.panel_snapshot().pen.trouble.unwrap();
    assert!(trouble.contains("数位板") && trouble.contains("./run.sh --install-udev"), "{trouble}");
    assert!(editor.note_tablets(None, &[]) && editor.panel_snapshot().pen.trouble.is_none());
}

#[test]
fn a_chosen_model_is_there_the_next_day() {
    let home = tempfile::tempdir().unwrap();
    let (device, model) = ("256c:006d HUION Tablet".to_owned(), "Huion H950P".to_owned());
    let mut first = editor(home.path());
    first.perform(Action::SetTabletModel { device: device.clone(), model: model.clone() });
    first.save_settings();
    drop(first);
    assert_eq!(editor(home.path()).settings().tablet_models, [(device, model)].into());
}
