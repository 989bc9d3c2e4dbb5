//! Names that survive in OBJ and MTL files, whose words end at blanks and whose comments begin with `#`.
//!
//! Letters and digits of any script stay. Where something had to be replaced, a short checksum of the original is
//! added, so that `a b` and `a_b` remain two names.

use crate::checksum::fnv1a;
use std::collections::BTreeSet;

/// The name as one word.
pub(super) fn word(name: &str) -> String {
    let replaced: String = name.chars().map(|c| if survives(c) { c } else { '_' }).collect();
    if replaced == name && !name.is_empty() { replaced } else { format!("{replaced}_{:08x}", fnv1a(name)) }
}

/// The names as words, each different from all before it.
pub(super) fn distinct_words<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut taken = BTreeSet::new();
    let mut unique = |name: &str| {
        let mut candidate = word(name);
        let mut number = 2;
        while !taken.insert(candidate.clone()) {
            candidate = format!("{}_{number}", word(name));
            number += 1;
        }
        candidate
    };
    names.map(&mut unique).collect()
}

fn survives(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | '+')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_names_stay_and_others_become_one_word() {
        assert_eq!(word("petal_daisy-2.1"), "petal_daisy-2.1");
        assert_eq!(word("菊花"), "菊花");
        for odd in ["my leaf", "leaf#1", "a\tb\nc", "..\\x/y", ""] {
            let word = word(odd);
            assert!(!word.is_empty() && word.chars().all(survives), "{odd:?} became {word:?}");
        }
    }

    #[test]
    fn different_names_stay_different() {
        let words = distinct_words(["a b", "a_b", "a#b", "a_b", "a_b"].into_iter());
        assert_eq!(words.iter().collect::<BTreeSet<_>>().len(), 5, "{words:?}");
    }
}
