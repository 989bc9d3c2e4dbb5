//! Which tool a name in an SVG means: `petal`, `Petals 2`, `leaf outline`, `BranchOutlines`, …

use crate::sketch::Tool;

/// The tool that the label or id of a group or path names, if it names just one.
pub(super) fn tool_in(name: &str) -> Option<Tool> {
    let letters: String = name.chars().filter(|c| c.is_alphabetic()).flat_map(char::to_lowercase).collect();
    let mentions = |words: &[&str]| words.iter().any(|word| letters.contains(word));
    let kinds =
        [mentions(&["petal"]), mentions(&["leaf", "leaves"]), mentions(&["branch"]), mentions(&["crown"])];
    match (kinds, letters.contains("outline")) {
        ([false, false, true, false], false) if letters.starts_with("space") => Some(Tool::SpaceBranch),
        ([true, false, false, false], _) => Some(Tool::Petal),
        ([false, true, false, false], false) => Some(Tool::Leaf),
        ([false, true, false, false], true) => Some(Tool::LeafOutline),
        ([false, false, true, false], false) => Some(Tool::Branch),
        ([false, false, true, false], true) => Some(Tool::BranchOutline),
        ([false, false, false, true], _) => Some(Tool::Crown),
        _ => (letters == "auto").then_some(Tool::Auto),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_as_people_write_them() {
        for (name, tool) in [
            ("petal", Tool::Petal),
            ("Petals", Tool::Petal),
            ("petal-outline 3", Tool::Petal),
            ("Leaves", Tool::Leaf),
            ("leaf outline", Tool::LeafOutline),
            ("leafOutline2", Tool::LeafOutline),
            ("branch-outline", Tool::BranchOutline),
            ("branch_outline", Tool::BranchOutline),
            ("Branches (back)", Tool::Branch),
            ("Crown", Tool::Crown),
            ("crown outlines 2", Tool::Crown),
            ("Auto", Tool::Auto),
        ] {
            assert_eq!(tool_in(name), Some(tool), "{name}");
        }
    }

    #[test]
    fn names_that_say_nothing_or_too_much() {
        for name in ["", "Layer 1", "g1024", "outline", "automatic", "branches and leaves", "crown of leaves"]
        {
            assert_eq!(tool_in(name), None, "{name}");
        }
    }

    #[test]
    fn every_tool_is_found_by_its_own_name() {
        // Strokes of brushes are not written to SVG, which has no room for a brush.
        for tool in Tool::ALL.into_iter().filter(|tool| !tool.is_brush()) {
            assert_eq!(tool_in(tool.name()), Some(tool));
        }
    }
}
