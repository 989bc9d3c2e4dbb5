//! The known word that looks most like a mistyped one, for error messages.
//!
//! Limits: the cost grows with the lengths of both words, so a word of more than [`LONGEST`] bytes is like none.

/// Longest word that is compared, bytes: longer than any name there is.
pub const LONGEST: usize = 256;

/// The candidate with the fewest edits from `word`, if they are few enough to be a slip of the pen.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if word.len() > LONGEST {
        return None;
    }
    let candidates = candidates.into_iter().filter(|c| c.len() <= LONGEST);
    let (edits, best) = candidates.map(|c| (strsim::damerau_levenshtein(word, c), c)).min()?;
    (edits <= 1 + word.chars().count() / 3).then_some(best)
}

/// `; did you mean …?`, or nothing.
pub fn did_you_mean(nearest: &Option<String>) -> String {
    let text = |word: &String| format!("; did you mean `{}`?", crate::quote::name(word));
    nearest.as_ref().map(text).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_slips_are_suggested() {
        assert_eq!(nearest("dasiy", ["daisy", "rose"]), Some("daisy"));
        assert_eq!(nearest("helicopter", ["daisy", "rose"]), None);
    }

    #[test]
    fn words_that_no_name_is_as_long_as_are_not_compared() {
        let long = "daisy".repeat(2_000_000);
        assert_eq!(nearest(&long, ["daisy", "rose"]), None);
        assert_eq!(nearest("daisy", [long.as_str(), "rose"]), None);
    }
}
