//! Fonts of the interface: egui's own, and one of the system's for Chinese.
//!
//! Chinese fonts are large and not part of the program. The first known family that the system has is read when Chinese
//! is chosen, or when a menu shows the language's own name. Without one the interface stays in English and a notice
//! says which package brings one, instead of showing boxes.
//!
//! Limits: families that are not in `FAMILIES` are found only if their name says that they hold Chinese.

use super::messages::{Language, Messages, Msg};
use super::notice::Notice;
use egui::{FontData, FontDefinitions, FontFamily};
use fontdb::{Database, FaceInfo, Source, Style, Weight};
use std::sync::Arc;

/// Families with Simplified Chinese, the best for an interface first.
const FAMILIES: [&str; 16] = [
    "Noto Sans CJK SC",
    "Noto Sans SC",
    "Source Han Sans SC",
    "Source Han Sans CN",
    "PingFang SC",
    "Microsoft YaHei UI",
    "Microsoft YaHei",
    "Hiragino Sans GB",
    "HarmonyOS Sans SC",
    "MiSans",
    "Sarasa UI SC",
    "WenQuanYi Micro Hei",
    "WenQuanYi Zen Hei",
    "Droid Sans Fallback",
    "SimHei",
    "Noto Serif CJK SC",
];
/// What names of other families with Chinese contain.
const NAME_PARTS: [&str; 4] = ["CJK", "Han Sans", "WenQuanYi", "Heiti"];
/// Largest font file that is read, bytes.
const MAX_BYTES: u64 = 64 << 20;
const NAME: &str = "chinese";

/// A Chinese font, read.
#[derive(Clone, Debug)]
pub struct ChineseFont {
    /// Its family, for `--verbose` and bug reports.
    pub family: String,
    data: Arc<FontData>,
}

impl ChineseFont {
    /// The best Chinese font of the system; `None` where there is none. Reads font folders and one font file.
    pub fn of_system() -> Option<Self> {
        let mut fonts = Database::new();
        fonts.load_system_fonts();
        Self::best(&fonts)
    }

    /// The best Chinese font among these.
    pub fn best(fonts: &Database) -> Option<Self> {
        let mut ranked: Vec<(usize, u32, &FaceInfo)> =
            fonts.faces().filter_map(|face| Some((rank(face)?, misfit(face), face))).collect();
        ranked.sort_by_key(|(rank, misfit, face)| (*rank, *misfit, face.index));
        ranked.into_iter().find_map(|(_, _, face)| Self::read(face))
    }

    fn read(face: &FaceInfo) -> Option<Self> {
        let bytes = match &face.source {
            Source::File(path) | Source::SharedFile(path, _) => {
                let size = std::fs::metadata(path).ok()?.len();
                if size > MAX_BYTES { None } else { std::fs::read(path).ok() }?
            }
            Source::Binary(data) => data.as_ref().as_ref().to_vec(),
        };
        let mut data = FontData::from_owned(bytes);
        data.index = face.index;
        let family = face.families.first().map(|(name, _)| name.clone()).unwrap_or_default();
        Some(Self { family, data: Arc::new(data) })
    }
}

/// The system's Chinese font, looked for when it is first needed.
#[derive(Debug, Default)]
pub struct ChineseLookup(Option<Option<ChineseFont>>);

impl ChineseLookup {
    /// A system of which it is known that it has no Chinese font.
    #[cfg(test)]
    pub(super) fn missing() -> Self {
        Self(Some(None))
    }

    /// The language if its letters can be drawn here, otherwise English.
    pub fn drawable(&mut self, language: Language) -> Language {
        let needs_font = language == Language::Chinese;
        if needs_font && self.0.get_or_insert_with(ChineseFont::of_system).is_none() {
            return Language::English;
        }
        language
    }

    /// The font, where it was looked for and found.
    pub fn font(&self) -> Option<&ChineseFont> {
        self.0.as_ref()?.as_ref()
    }

    /// Whether it was looked for in vain.
    pub fn is_missing(&self) -> bool {
        matches!(self.0, Some(None))
    }
}

/// Place of a face's family in the list, `None` for one that is not for Chinese.
fn rank(face: &FaceInfo) -> Option<usize> {
    let named = |wanted: &str| face.families.iter().any(|(name, _)| name == wanted);
    let by_name_part = || {
        let has_part = |(name, _): &(String, _)| NAME_PARTS.iter().any(|part| name.contains(part));
        face.families.iter().any(has_part).then_some(FAMILIES.len())
    };
    FAMILIES.iter().position(|family| named(family)).or_else(by_name_part)
}

/// How far a face is from upright regular.
fn misfit(face: &FaceInfo) -> u32 {
    let slant = if face.style == Style::Normal { 0 } else { 1000 };
    slant + u32::from(face.weight.0.abs_diff(Weight::NORMAL.0)) + u32::from(face.monospaced)
}

/// Fonts for a context: egui's own first, so that Latin letters and digits look the same in every language.
pub fn definitions(chinese: Option<&ChineseFont>) -> FontDefinitions {
    let mut fonts = FontDefinitions::default();
    if let Some(font) = chinese {
        fonts.font_data.insert(NAME.to_owned(), font.data.clone());
        for family in [FontFamily::Proportional, FontFamily::Monospace] {
            fonts.families.entry(family).or_default().push(NAME.to_owned());
        }
    }
    fonts
}

/// What to tell an artist who asked for Chinese on a system without a Chinese font: in English, which can be drawn.
pub fn missing_notice() -> Notice {
    let messages = Messages::new(Language::English);
    Notice::warning(messages.get(Msg::NoticeNoChineseFont), messages.get(Msg::NoticeInstallFont))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_system_without_fonts_has_no_chinese_and_gets_the_package_names() {
        assert!(ChineseFont::best(&Database::new()).is_none());
        let notice = missing_notice();
        for package in ["fonts-noto-cjk", "google-noto-sans-cjk-fonts", "noto-fonts-cjk"] {
            assert!(notice.remedy.contains(package));
        }
        let mut lookup = ChineseLookup::missing();
        assert_eq!(lookup.drawable(Language::Chinese), Language::English);
    }

    #[test]
    fn a_latin_font_is_not_taken_for_a_chinese_one() {
        let mut fonts = Database::new();
        for data in FontDefinitions::default().font_data.values() {
            fonts.load_font_data(data.font.as_ref().as_ref().to_vec());
        }
        assert!(!fonts.is_empty());
        assert!(ChineseFont::best(&fonts).is_none());
    }

    #[test]
    fn without_chinese_the_fonts_are_the_toolkits_own() {
        assert_eq!(definitions(None), FontDefinitions::default());
    }
}
