//! Linear checks on SVG text before the XML reader sees it.
//!
//! roxmltree is total, but some hostile documents cost it quadratic time or memory: many attributes on one element
//! (each is compared with each), many namespaces (all in scope are copied for each element that adds one), and entities
//! (text grows at each use). It also reserves memory by counting `<` and `=`. All four are bounded here by counting;
//! `<` cannot occur in an attribute, so the text between two of them holds at most one element's attributes.

use crate::sketch::error::Fault;
use crate::sketch::limits;
use std::collections::BTreeSet;

/// Refuses documents that would cost more than [`limits`] allow.
pub(super) fn check(text: &str) -> Result<(), Fault> {
    if text.contains("<!ENTITY") {
        let message = "the SVG defines entities (<!ENTITY …>), which are not read; save it as plain SVG";
        return Err(Fault::Malformed(message.into()));
    }
    let (mut elements, mut attributes, mut comparisons, mut declaring) = (0_usize, 0_usize, 0_u64, 0_u64);
    let mut prefixes = BTreeSet::new();
    for tag in text.split('<') {
        let own_attributes = tag.bytes().filter(|b| *b == b'=').count();
        elements += 1;
        attributes += own_attributes;
        comparisons = comparisons.saturating_add((own_attributes as u64).saturating_pow(2));
        declaring += u64::from(tag.contains("xmlns"));
        prefixes.extend(tag.split("xmlns").skip(1).filter_map(|rest| rest.split('=').next()));
    }
    let copies = declaring.saturating_mul(prefixes.len() as u64);
    let too_many = |what, limit| Err(Fault::TooMany { what, limit });
    if elements > limits::MAX_SVG_NODES {
        return too_many("SVG elements", limits::MAX_SVG_NODES);
    }
    if attributes > limits::MAX_SVG_ATTRIBUTES {
        return too_many("SVG attributes", limits::MAX_SVG_ATTRIBUTES);
    }
    if comparisons > limits::MAX_SVG_COMPARISONS || copies > limits::MAX_SVG_NAMESPACE_COPIES {
        let message =
            "an SVG element has far too many attributes or namespaces; save the drawing as plain SVG";
        return Err(Fault::Malformed(message.into()));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attributes_of_one_element_are_bounded_but_many_elements_pass() {
        let attributes: String = (0..100_000).map(|i| format!(" a{i}=''")).collect();
        assert!(check(&format!("<svg{attributes}/>")).is_err());
        let elements = "<path id='a' d='M0 0' style='x'/>".repeat(30_000);
        assert!(check(&format!("<svg>{elements}</svg>")).is_ok());
    }

    #[test]
    fn namespaces_are_bounded_by_what_is_copied() {
        let prefixes: String = (0..20_000).map(|i| format!(" xmlns:n{i}='u'")).collect();
        let children = "<g xmlns:x='u'/>".repeat(20_000);
        assert!(check(&format!("<svg{prefixes}>{children}</svg>")).is_err());
        assert!(check(&format!("<svg xmlns='u'>{children}</svg>")).is_ok());
    }
}
