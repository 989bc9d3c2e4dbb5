//! Linear checks on SVG text before the XML reader sees it.
//!
//! roxmltree is total, but some hostile documents cost it more than linear time or memory: many attributes on one element
//! (each is compared with each), many namespaces (each name is compared with all in scope, and all are copied for an
//! element that adds one), and entities (text grows at each use). It also reserves memory by counting `<` and `=`. Here
//! the same is counted from above and held to [`limits`]. `<` cannot stand in an attribute, so the text between two of
//! them holds the attributes of at most one element.

use crate::sketch::error::Fault;
use crate::sketch::limits;
use std::collections::BTreeSet;

/// Refuses documents that would cost more than [`limits`] allow.
pub(super) fn check(text: &str) -> Result<(), Fault> {
    if text.contains("<!ENTITY") {
        let message = "the SVG defines entities (<!ENTITY …>), which are not read; save it as plain SVG";
        return Err(Fault::Malformed(message.into()));
    }
    let (mut elements, mut attributes, mut declaring, mut steps) = (0_usize, 0_usize, 0_u64, 0_u64);
    let mut prefixes = BTreeSet::new();
    for tag in text.split('<') {
        let names = tag.split_inclusive('=').filter_map(|piece| piece.strip_suffix('='));
        let own =
            Names::of(names.map(|before| before.rsplit(char::is_whitespace).next().unwrap_or_default()));
        elements += 1;
        attributes += own.count as usize;
        steps = steps.saturating_add(own.count.saturating_mul(own.lookup()));
        declaring += u64::from(tag.contains("xmlns"));
        prefixes.extend(tag.split("xmlns").skip(1).filter_map(|rest| rest.split('=').next()));
    }
    let lookup = Names::of(prefixes.into_iter()).lookup();
    let lookups = declaring.saturating_mul(lookup).saturating_add((elements + attributes) as u64);
    steps = steps.saturating_add(lookups.saturating_mul(lookup));
    let too_many = |what, limit| Err(Fault::TooMany { what, limit });
    if elements > limits::MAX_SVG_NODES {
        return too_many("SVG elements", limits::MAX_SVG_NODES);
    }
    if attributes > limits::MAX_SVG_ATTRIBUTES {
        return too_many("SVG attributes", limits::MAX_SVG_ATTRIBUTES);
    }
    if steps > limits::MAX_SVG_COMPARISONS {
        let message = "the SVG has far too many attributes or namespaces on an element; save it as plain SVG";
        return Err(Fault::Malformed(message.into()));
    }
    Ok(())
}

/// Names that the XML reader keeps in a list and searches from the front.
struct Names {
    count: u64,
    bytes: u64,
}

impl Names {
    fn of<'a>(names: impl Iterator<Item = &'a str>) -> Self {
        names.fold(Self { count: 0, bytes: 0 }, |sum, name| Self {
            count: sum.count + 1,
            bytes: sum.bytes + name.len() as u64,
        })
    }

    /// Steps to find a name: one for each name, more where names are long.
    fn lookup(&self) -> u64 {
        const BYTES_PER_STEP: u64 = 16;
        self.count.max(self.bytes / BYTES_PER_STEP)
    }
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
