//! The known word that looks most like a mistyped one, for error messages.

/// The candidate with the fewest edits from `word`, if they are few enough to be a slip of the pen.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let (edits, best) = candidates.into_iter().map(|c| (strsim::damerau_levenshtein(word, c), c)).min()?;
    (edits <= 1 + word.chars().count() / 3).then_some(best)
}

/// `; did you mean …?`, or nothing.
pub fn did_you_mean(nearest: &Option<String>) -> String {
    nearest.as_ref().map(|word| format!("; did you mean `{word}`?")).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_slips_are_suggested() {
        assert_eq!(nearest("dasiy", ["daisy", "rose"]), Some("daisy"));
        assert_eq!(nearest("helicopter", ["daisy", "rose"]), None);
    }
}
