//! Which tablet a HID node is.
//!
//! A row fits when ids, report lengths, interface number and every device string agree. Rows that ask for strings come
//! before rows that do not, because they know more; within both, the order of the file decides. A string that cannot be
//! read counts as one that does not match, whatever the rule.
//!
//! If no row fits, rows are taken that differ in nothing but the length of output reports: firmwares of one model differ
//! in it (28bd:0936 is known with 33 and with 64 bytes). If still none fits, the firmware's name decides alone where a
//! device gives it: it says more than lengths, which also differ (Huion's T174 declares 8 bytes or 12 and sends 12).

use super::tablet::{StringRule, Table, Tablet};
use std::collections::BTreeMap;

/// Index of the string in which tablets of Huion and its kin give the name of their firmware.
pub const FIRMWARE_NAME: u8 = 201;

/// How sure a match is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Certainty {
    /// No tablet fits.
    Unknown,
    /// One fits, or several between which there is no difference for drawing.
    Sure,
    /// Several fit that differ; the first is the best guess, and the artist may know better.
    Ambiguous,
    /// None fits but for the length of output reports, in which firmwares of one model differ; the first is the best guess.
    Guess,
    /// None fits, but the device's strings could not be read, and with them one of these might.
    StringsUnread,
}

/// What a HID node may be.
#[derive(Clone, Debug)]
pub struct Match<'t> {
    /// How sure that is.
    pub certainty: Certainty,
    /// Tablets it may be, best first, one row for each name.
    pub tablets: Vec<&'t Tablet>,
    /// Indices of strings that were asked for and not given.
    pub unread: Vec<u8>,
}

impl<'t> Match<'t> {
    /// The tablet to go on with: the only one, or the best guess.
    #[must_use]
    pub fn best(&self) -> Option<&'t Tablet> {
        match self.certainty {
            Certainty::Sure | Certainty::Ambiguous | Certainty::Guess => self.tablets.first().copied(),
            Certainty::Unknown | Certainty::StringsUnread => None,
        }
    }
}

/// The device's strings, each read once and only if a row asks for it.
struct Strings<'f> {
    read: &'f mut dyn FnMut(u8) -> Option<String>,
    known: BTreeMap<u8, Option<String>>,
}

impl Strings<'_> {
    fn fit(&mut self, tablet: &Tablet) -> bool {
        tablet.strings.iter().all(|rule| {
            let text = self.known.entry(rule.index).or_insert_with(|| (self.read)(rule.index));
            text.as_ref().is_some_and(|text| rule.pattern.is_match(text.as_bytes()) == rule.must_match)
        })
    }

    /// Some string that the row asks for could not be read, and those that could be read agree with it. A device that
    /// gives others, and none of the row's, has none of these.
    fn might_fit(&self, tablet: &Tablet) -> bool {
        let text = |index: &u8| self.known.get(index).and_then(Option::as_ref);
        let is_readable = |rule: &StringRule| text(&rule.index).is_some();
        let is_mute = self.known.values().all(Option::is_none);
        (is_mute || tablet.strings.iter().any(is_readable))
            && tablet.strings.iter().all(|rule| match text(&rule.index) {
                Some(text) => rule.pattern.is_match(text.as_bytes()) == rule.must_match,
                None => true,
            })
    }
}

impl Table {
    /// Finds what a HID node is. Lengths are those of its longest reports in bytes, id included also where reports have
    /// none; `interface` is `None` where the system does not tell. `strings` reads the USB string at an index (`None` if
    /// it cannot) and is asked for each at most once.
    pub fn find(
        &self,
        vendor: u16,
        product: u16,
        input_report_length: usize,
        output_report_length: usize,
        interface: Option<u8>,
        strings: &mut dyn FnMut(u8) -> Option<String>,
    ) -> Match<'_> {
        let mut strings = Strings { read: strings, known: BTreeMap::new() };
        let fits_but_for_output = |tablet: &&Tablet| {
            (tablet.vendor, tablet.product) == (vendor, product)
                && tablet.input_length.is_none_or(|length| length == input_report_length)
                && (interface.is_none() || tablet.interface.is_none() || tablet.interface == interface)
        };
        let (fitting, others): (Vec<&Tablet>, Vec<&Tablet>) = self
            .tablets()
            .iter()
            .filter(fits_but_for_output)
            .partition(|tablet| tablet.output_length.is_none_or(|length| length == output_report_length));
        let (mut certainty, mut tablets) = by_strings(&fitting, &mut strings);
        if certainty == Certainty::Unknown && output_report_length > 0 {
            let writable: Vec<&Tablet> = others.into_iter().filter(|t| t.output_length != Some(0)).collect();
            (certainty, tablets) = match by_strings(&writable, &mut strings) {
                (Certainty::Sure | Certainty::Ambiguous, tablets) => (Certainty::Guess, tablets),
                other => other,
            };
        }
        if certainty == Certainty::Unknown {
            let named = self.tablets().iter().filter(|tablet| {
                (tablet.vendor, tablet.product) == (vendor, product)
                    && !tablet.keys_only
                    && tablet.strings.iter().any(|rule| rule.index == FIRMWARE_NAME)
                    && strings.fit(tablet)
            });
            let named: Vec<&Tablet> = named.collect();
            if !named.is_empty() {
                (certainty, tablets) = certain(named);
            }
        }
        let unread =
            strings.known.iter().filter(|(_, text)| text.is_none()).map(|(index, _)| *index).collect();
        Match { certainty, tablets, unread }
    }
}

/// Of rows whose node fits, those whose strings do.
fn by_strings<'t>(fitting: &[&'t Tablet], strings: &mut Strings<'_>) -> (Certainty, Vec<&'t Tablet>) {
    let (with, without): (Vec<&Tablet>, Vec<&Tablet>) =
        fitting.iter().copied().partition(|tablet| !tablet.strings.is_empty());
    let fitting: Vec<&Tablet> = with.iter().copied().filter(|tablet| strings.fit(tablet)).collect();
    let might: Vec<&Tablet> = with.into_iter().filter(|tablet| strings.might_fit(tablet)).collect();
    if !fitting.is_empty() {
        certain(fitting)
    } else if !without.is_empty() {
        certain(without)
    } else if might.is_empty() {
        (Certainty::Unknown, Vec::new())
    } else {
        (Certainty::StringsUnread, one_a_name(might))
    }
}

fn certain(fitting: Vec<&Tablet>) -> (Certainty, Vec<&Tablet>) {
    let tablets = one_a_name(fitting);
    let all_alike = tablets.windows(2).all(|pair| draws_alike(pair[0], pair[1]));
    (if all_alike { Certainty::Sure } else { Certainty::Ambiguous }, tablets)
}

/// Nodes with a pen first, and of each name the first row.
fn one_a_name(mut tablets: Vec<&Tablet>) -> Vec<&Tablet> {
    tablets.sort_by_key(|tablet| tablet.keys_only);
    let mut kept: Vec<&Tablet> = Vec::new();
    for tablet in tablets {
        if !kept.iter().any(|known| known.name == tablet.name) {
            kept.push(tablet);
        }
    }
    kept
}

/// Taking one for the other makes no difference to what is drawn.
fn draws_alike(a: &Tablet, b: &Tablet) -> bool {
    a.spec(0) == b.spec(0) && a.area_mm == b.area_mm && a.wake == b.wake
}
