//! Which texture the artist chose for which kind of part.
//!
//! A picture of the artist's own belongs to the drawing and is kept in it; several parts may have the same one. As text
//! a choice names its picture, and the pictures stand apart under these names, each once: [`ChoiceText`] and [`named`].

use super::limits;
use crate::picture::Picture;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Texture by kind of part. A part without an entry keeps what the species gives it.
pub type Textures = BTreeMap<String, TextureChoice>;

/// A texture that the artist chose.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TextureChoice {
    /// A built-in texture by its name. Any other name is a picture file that is missing, such as one of an older
    /// drawing, which kept only the path: the part is shown as its species has it.
    Named(String),
    /// The artist's own picture.
    Own(Picture),
}

/// The kinds of parts that have a texture: branches, and every [`OrganKind`](crate::plant::OrganKind) by its name in
/// files.
pub const PARTS: [&str; 11] = [
    "branch",
    "leaf",
    "petiole",
    "petal",
    "sepal",
    "receptacle",
    "stamen",
    "pistil",
    "fruit",
    "thorn",
    "pot",
];

/// The pictures among the choices. A picture may come again.
pub(super) fn pictures(textures: &Textures) -> impl Iterator<Item = &Picture> {
    textures.values().filter_map(|choice| match choice {
        TextureChoice::Own(picture) => Some(picture),
        TextureChoice::Named(_) => None,
    })
}

/// A choice as files write it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum ChoiceText {
    /// A built-in texture, or in older files the path of a picture.
    Named(String),
    /// A picture that stands elsewhere in the file.
    Own {
        /// Its name there.
        picture: String,
    },
}

/// Choices as files write them, and the pictures that they name: each once, in the order of names.
pub fn named(textures: &Textures) -> (BTreeMap<String, ChoiceText>, BTreeMap<String, Picture>) {
    let mut all: BTreeMap<String, Picture> = BTreeMap::new();
    let text = |(part, choice): (&String, &TextureChoice)| {
        let text = match choice {
            TextureChoice::Named(name) => ChoiceText::Named(name.clone()),
            TextureChoice::Own(picture) => {
                let name = name_among(&all, picture);
                all.entry(name.clone()).or_insert_with(|| picture.clone());
                ChoiceText::Own { picture: name }
            }
        };
        (part.clone(), text)
    };
    (textures.iter().map(text).collect(), all)
}

/// The picture's name; another one where a different picture has it, for hashes can meet.
fn name_among(all: &BTreeMap<String, Picture>, picture: &Picture) -> String {
    let name = picture.name();
    let mut names = std::iter::once(name.clone()).chain((2..).map(|n| format!("{name}-{n}")));
    let usable = |name: &String| all.get(name).is_none_or(|known| known == picture);
    names.find(usable).unwrap_or(name)
}

/// Choices as files write them, with the pictures that `find` knows by name.
///
/// # Errors
/// The first part whose picture is not there, and its name.
pub fn resolved(
    text: BTreeMap<String, ChoiceText>,
    find: impl Fn(&str) -> Option<Picture>,
) -> Result<Textures, String> {
    let resolve = |(part, choice): (String, ChoiceText)| match choice {
        ChoiceText::Named(name) => Ok((part, TextureChoice::Named(name))),
        ChoiceText::Own { picture } => match find(&picture) {
            Some(found) => Ok((part, TextureChoice::Own(found))),
            None => Err(format!(
                "the picture `{}` for `{}` is not in the file; restore the file from a backup, or remove the texture",
                shortened(&picture),
                shortened(&part)
            )),
        },
    };
    text.into_iter().map(resolve).collect()
}

/// The first entry that is not sound, in words.
pub(super) fn check(textures: &Textures) -> Result<(), String> {
    for (part, choice) in textures {
        if !PARTS.contains(&part.as_str()) {
            return Err(format!(
                "there is no part `{}` to give a texture; the parts are {}",
                shortened(part),
                PARTS.join(", ")
            ));
        }
        if let TextureChoice::Named(name) = choice
            && (name.is_empty() || name.len() > limits::MAX_TEXTURE_NAME_BYTES)
        {
            return Err(format!(
                "the texture of `{part}` has no usable name; write a built-in texture, or choose a picture in the window"
            ));
        }
    }
    let bytes: usize = named(textures).1.values().map(|picture| picture.bytes().len()).sum();
    if bytes > limits::MAX_TEXTURE_BYTES {
        return Err(format!(
            "the pictures of all parts together have more than {} MiB; scale them down",
            limits::MAX_TEXTURE_BYTES >> 20
        ));
    }
    Ok(())
}

/// Text from a file, cut to what fits into a message.
fn shortened(text: &str) -> String {
    text.chars().take(80).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(bytes: &[u8]) -> TextureChoice {
        TextureChoice::Own(Picture::new(bytes).unwrap())
    }

    fn small() -> TextureChoice {
        picture(include_bytes!("../../tests/fixtures/reference/small.png"))
    }

    #[test]
    fn parts_are_known_and_names_not_empty() {
        let one = |part: &str, texture: &str| {
            check(&Textures::from([(part.to_owned(), TextureChoice::Named(texture.to_owned()))]))
        };
        assert_eq!(one("leaf", "oak.png"), Ok(()));
        assert!(one("leave", "oak").unwrap_err().contains("`leave`"));
        assert!(one("leaf", "").unwrap_err().contains("`leaf`"));
    }

    #[test]
    fn a_picture_of_two_parts_stands_once_and_comes_back_for_both() {
        let other = picture(include_bytes!("../../tests/fixtures/reference/small.jpg"));
        let parts = [("leaf", small()), ("petal", small()), ("branch", other)];
        let textures: Textures = parts.map(|(part, choice)| (part.to_owned(), choice)).into();
        let (text, pictures) = named(&textures);
        assert_eq!((text["leaf"].clone(), pictures.len()), (text["petal"].clone(), 2));
        assert_eq!(resolved(text.clone(), |name| pictures.get(name).cloned()), Ok(textures));
        assert!(resolved(text, |_| None).unwrap_err().contains("`branch`"));
    }

    #[test]
    fn pictures_are_limited_together_and_each_counts_once() {
        let large = |fill: u8| {
            let mut bytes = include_bytes!("../../tests/fixtures/reference/small.png").to_vec();
            bytes.resize(30 << 20, fill);
            picture(&bytes)
        };
        let of = |choices: [TextureChoice; 3]| -> Textures {
            ["branch", "leaf", "petal"].map(str::to_owned).into_iter().zip(choices).collect()
        };
        assert_eq!(check(&of([large(1), large(2), large(2)])), Ok(()));
        assert!(check(&of([large(1), large(2), large(3)])).unwrap_err().contains("64 MiB"));
    }
}
