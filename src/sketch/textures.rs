//! Which texture the artist chose for which kind of part.

use super::limits;
use std::collections::BTreeMap;

/// Texture by kind of part: the name of a built-in one or the path of a picture. A part without an entry keeps what the
/// species gives it.
pub type Textures = BTreeMap<String, String>;

/// The kinds of parts that have a texture: branches, and every [`OrganKind`](crate::plant::OrganKind) by its name in
/// files.
pub const PARTS: [&str; 10] =
    ["branch", "leaf", "petal", "sepal", "receptacle", "stamen", "pistil", "fruit", "thorn", "pot"];

/// The first entry that is not sound, in words.
pub(super) fn check(textures: &Textures) -> Result<(), String> {
    for (part, texture) in textures {
        if !PARTS.contains(&part.as_str()) {
            let part: String = part.chars().take(80).collect();
            return Err(format!(
                "there is no part `{part}` to give a texture; the parts are {}",
                PARTS.join(", ")
            ));
        }
        if texture.is_empty() || texture.len() > limits::MAX_TEXTURE_NAME_BYTES {
            return Err(format!(
                "the texture of `{part}` has no usable name; write a built-in texture or the path of a picture"
            ));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_known_and_names_not_empty() {
        let one = |part: &str, texture: &str| check(&Textures::from([(part.to_owned(), texture.to_owned())]));
        assert_eq!(one("leaf", "oak.png"), Ok(()));
        assert!(one("leave", "oak").unwrap_err().contains("`leave`"));
        assert!(one("leaf", "").unwrap_err().contains("`leaf`"));
    }
}
