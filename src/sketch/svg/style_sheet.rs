//! The `<style>` elements of an SVG: their rules, and which of them hold for an element.
//!
//! Selectors are read and matched by simplecss: types, classes, ids, attributes, `:first-child`, descendants, children
//! and neighbours. Rules are split here: of at-rules (`@media`, `@import`, `@font-face`) none is followed, and a rule's
//! declarations are kept once however many selectors it has. Rules are looked up by the class, id or name that ends their
//! selector. Matching is counted in steps and ends at [`limits::MAX_SVG_STYLE_STEPS`], because a selector of many
//! descendants tries all ways through its ancestors; it looks at no more than [`MAX_HOPS`] of them, so that its recursion
//! is bounded, too.

use super::style::Declarations;
use crate::sketch::error::Fault;
use crate::sketch::limits;
use roxmltree::{Document, Node};
use simplecss::{AttributeOperator, PseudoClass, Selector};
use std::cell::Cell;
use std::collections::HashMap;

/// Most elements that one selector looks at, beginning with the one that it is to hold for.
const MAX_HOPS: usize = 256;

/// The rules of a document.
pub(super) struct StyleSheet<'a> {
    rules: Vec<Rule<'a>>,
    /// Places in `rules` by what ends the selector, ascending.
    by_key: HashMap<Key<'a>, Vec<usize>>,
    /// Steps that are left.
    steps: Cell<u64>,
}

struct Rule<'a> {
    selector: Selector<'a>,
    /// Without and with `!important`.
    declarations: [Declarations; 2],
}

/// What an element must have for a rule to hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Key<'a> {
    Class(&'a str),
    Id(&'a str),
    Name(&'a str),
    Any,
}

/// The text of all style sheets of a document, without comments.
///
/// # Errors
/// More than [`limits::MAX_SVG_STYLE_BYTES`].
pub(super) fn text_of(document: &Document<'_>) -> Result<String, Fault> {
    let mut text = String::new();
    let is_sheet = |node: &Node<'_, '_>| {
        let kind = node.attribute("type").unwrap_or_default();
        node.tag_name().name() == "style" && matches!(kind, "" | "text/css")
    };
    for piece in document.descendants().filter(is_sheet).flat_map(|node| node.children()) {
        text.push_str(piece.text().filter(|_| piece.is_text()).unwrap_or_default());
        text.push('\n');
        if text.len() > limits::MAX_SVG_STYLE_BYTES {
            let most = limits::MAX_SVG_STYLE_BYTES >> 20;
            let message = format!("the SVG's style sheets are larger than {most} MiB; save it as plain SVG");
            return Err(Fault::Malformed(message));
        }
    }
    Ok(without_comments(&text))
}

/// Each comment becomes a space.
fn without_comments(mut text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    while let Some((before, comment)) = text.split_once("/*") {
        plain.push_str(before);
        plain.push(' ');
        text = comment.split_once("*/").map_or("", |(_, after)| after);
    }
    plain + text
}

impl<'a> StyleSheet<'a> {
    /// The rules in a text from [`text_of`]. What cannot be read is passed over, as CSS asks.
    pub(super) fn parse(css: &'a str) -> Self {
        let mut ordered = Vec::new();
        for (selectors, body) in rule_sets(css) {
            let declarations = Declarations::parse(body);
            if declarations == [Declarations::default(); 2] {
                continue;
            }
            for text in selectors.split(',') {
                if let Some(selector) = Selector::parse(text.trim()) {
                    ordered.push((key_of(text.trim()), Rule { selector, declarations }));
                }
            }
        }
        // A stable sort: of rules that weigh the same the later ones win.
        ordered.sort_by_cached_key(|(_, rule)| rule.selector.specificity());
        let mut by_key: HashMap<Key<'a>, Vec<usize>> = HashMap::new();
        let mut rules = Vec::with_capacity(ordered.len());
        for (index, (key, rule)) in ordered.into_iter().enumerate() {
            by_key.entry(key).or_default().push(index);
            rules.push(rule);
        }
        Self { rules, by_key, steps: Cell::new(limits::MAX_SVG_STYLE_STEPS) }
    }

    /// What attributes, rules and `style` say of an element, together.
    ///
    /// # Errors
    /// Rules that would take too many steps.
    pub(super) fn declarations(&self, node: Node<'_, '_>) -> Result<Declarations, Fault> {
        let own = Declarations::parse(node.attribute("style").unwrap_or_default());
        let mut all = Declarations::of_attributes(node);
        let matching = self.matching(node)?;
        for (weight, own) in own.iter().enumerate() {
            let of_rules = matching.iter().map(|index| &self.rules[*index].declarations[weight]);
            all = of_rules.chain([own]).fold(all, |sum, declarations| sum.overridden_by(declarations));
        }
        Ok(all)
    }

    /// The rules that hold for an element, lightest first.
    fn matching(&self, node: Node<'_, '_>) -> Result<Vec<usize>, Fault> {
        if self.rules.is_empty() {
            return Ok(Vec::new());
        }
        let classes = node.attribute("class").unwrap_or_default().split_ascii_whitespace();
        let others =
            [Key::Any, Key::Name(node.tag_name().name()), Key::Id(node.attribute("id").unwrap_or_default())];
        let mut found = Vec::new();
        for key in classes.map(Key::Class).chain(others) {
            let candidates = self.by_key.get(&key).map_or(&[][..], Vec::as_slice);
            spend(&self.steps, 1 + candidates.len());
            if self.steps.get() == 0 {
                break;
            }
            found.extend_from_slice(candidates);
        }
        found.sort_unstable();
        found.dedup();
        let element = Element { node, hops: 0, steps: &self.steps };
        found.retain(|index| self.rules[*index].selector.matches(&element));
        if self.steps.get() == 0 {
            let message =
                "the SVG's style sheets have too many rules for too many elements; save it as plain SVG";
            return Err(Fault::Malformed(message.into()));
        }
        Ok(found)
    }
}

fn spend(left: &Cell<u64>, steps: usize) {
    left.set(left.get().saturating_sub(steps as u64));
}

/// The rules of a text as their selectors and what stands between the braces, at-rules left out.
fn rule_sets(css: &str) -> Vec<(&str, &str)> {
    let mut found = Vec::new();
    let mut rest = css.trim_start();
    while !rest.is_empty() {
        if rest.starts_with('@') {
            let end = rest.find(['{', ';']).unwrap_or(rest.len());
            rest = rest[end..].strip_prefix(';').unwrap_or_else(|| after_block(&rest[end..]));
        } else {
            let Some((selectors, after)) = rest.split_once('{') else { break };
            let (body, after) = after.split_once('}').unwrap_or((after, ""));
            found.push((selectors, body));
            rest = after;
        }
        rest = rest.trim_start_matches(|c: char| c.is_whitespace() || c == '}');
    }
    found
}

/// What follows a block that begins here, blocks inside of it counted.
fn after_block(text: &str) -> &str {
    let mut depth = 0_usize;
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            b'{' => depth += 1,
            b'}' if depth == 1 => return &text[at + 1..],
            b'}' => depth -= 1,
            _ => {}
        }
    }
    ""
}

/// What an element must have for the selector to hold, as far as its plain end says so.
fn key_of(selector: &str) -> Key<'_> {
    let last =
        selector.rsplit(|c: char| c.is_whitespace() || c == '>' || c == '+').next().unwrap_or_default();
    let is_plain = |c: char| c.is_alphanumeric() || "-_.#".contains(c);
    if last.is_empty() || !last.chars().all(is_plain) {
        return Key::Any;
    }
    match last.rfind(['.', '#']) {
        None => Key::Name(last),
        Some(at) if last[at..].starts_with('.') => Key::Class(&last[at + 1..]),
        Some(at) => Key::Id(&last[at + 1..]),
    }
}

/// An element as simplecss asks about it; every question costs steps, and without steps nothing matches.
struct Element<'s, 'd, 'i> {
    node: Node<'d, 'i>,
    /// How many elements away it is from where the selector began.
    hops: usize,
    steps: &'s Cell<u64>,
}

impl<'d, 'i> Element<'_, 'd, 'i> {
    /// The element that a selector looks at after this one, if it may look at one more.
    fn next(&self, node: Option<Node<'d, 'i>>) -> Option<Self> {
        spend(self.steps, 1);
        let may = self.hops + 1 < MAX_HOPS && self.steps.get() > 0;
        node.filter(|_| may).map(|node| Self { node, hops: self.hops + 1, steps: self.steps })
    }

    /// The element before this one among its siblings, texts and comments passed over.
    fn before(&self) -> Option<Node<'d, 'i>> {
        let passed = self.node.prev_siblings().skip(1).inspect(|_| spend(self.steps, 1));
        passed.take_while(|_| self.steps.get() > 0).find(Node::is_element)
    }
}

impl simplecss::Element for Element<'_, '_, '_> {
    fn parent_element(&self) -> Option<Self> {
        self.next(self.node.parent_element())
    }

    fn prev_sibling_element(&self) -> Option<Self> {
        self.next(self.before())
    }

    fn has_local_name(&self, name: &str) -> bool {
        spend(self.steps, 1);
        self.node.tag_name().name() == name && self.steps.get() > 0
    }

    fn attribute_matches(&self, name: &str, operator: AttributeOperator<'_>) -> bool {
        const BYTES_PER_STEP: usize = 16;
        let value = self.node.attribute(name);
        let bytes = value.map_or(0, str::len);
        spend(self.steps, 1 + self.node.attributes().len() + bytes / BYTES_PER_STEP);
        value.is_some_and(|value| operator.matches(value)) && self.steps.get() > 0
    }

    /// A drawing on paper has no links to hover over.
    fn pseudo_class_matches(&self, class: PseudoClass<'_>) -> bool {
        spend(self.steps, 1);
        class == PseudoClass::FirstChild && self.before().is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Which elements with an id the sheet hides, in document order.
    fn hidden(css: &str, elements: &str) -> Vec<String> {
        let text = format!("<svg><style>{css}</style>{elements}</svg>");
        let document = Document::parse(&text).unwrap();
        let css = text_of(&document).unwrap();
        let sheet = StyleSheet::parse(&css);
        let hides = |node: &Node<'_, '_>| {
            let [none, _] = Declarations::parse("display:none");
            sheet.declarations(*node).unwrap() == none
        };
        let with_id = document.descendants().filter(|node| node.has_attribute("id"));
        with_id.filter(hides).filter_map(|node| node.attribute("id").map(str::to_owned)).collect()
    }

    #[test]
    fn selectors_by_class_id_name_place_and_attribute() {
        let elements = "<g class='a b'><path id='p'/><path id='q' class='c'/></g><line id='r' x='1'/>";
        for (selector, expected) in [
            (".c", vec!["q"]),
            ("path.c", vec!["q"]),
            ("#r", vec!["r"]),
            ("line#r", vec!["r"]),
            ("path", vec!["p", "q"]),
            (".a > path, nothing", vec!["p", "q"]),
            (".b path + path", vec!["q"]),
            ("path:first-child", vec!["p"]),
            ("[x='1']", vec!["r"]),
            ("g *", vec!["p", "q"]),
            ("line:hover", vec![]),
            ("::before", vec![]),
            (">", vec![]),
        ] {
            assert_eq!(hidden(&format!("{selector} {{display:none}}"), elements), expected, "{selector}");
        }
    }

    #[test]
    fn heavier_and_later_rules_win_and_important_ones_over_all() {
        let path = "<path id='p' class='c'/>";
        for (css, is_hidden) in [
            (".c{display:none} path{display:inline}", true),
            (".c{display:inline} .c{display:none}", true),
            ("path{display:none!important} #p{display:inline}", true),
            ("#p{display:inline} .c{display:none}", false),
        ] {
            assert_eq!(hidden(css, path).len(), usize::from(is_hidden), "{css}");
        }
        assert_eq!(hidden(".c{display:none}", "<path id='p' class='c' style='display:inline'/>").len(), 0);
    }

    #[test]
    fn comments_and_rules_about_media_are_passed_over() {
        let css = "/* .c{} */ @import url(x); @media print { .c{display:none} } @font-face{a:b} .d/**/{display:none}
            } .e{display:none";
        let elements = "<path id='c' class='c'/><path id='d' class='d'/><path id='e' class='e'/>";
        assert_eq!(hidden(css, elements), ["d", "e"]);
        assert!(StyleSheet::parse("@é").rules.is_empty());
    }

    #[test]
    fn a_selector_that_tries_all_ways_ends() {
        let (open, close) = ("<g>".repeat(200), "</g>".repeat(200));
        let text = format!("<svg>{open}<path id='p'/>{close}</svg>");
        let document = Document::parse(&text).unwrap();
        let css = format!("x {}path {{fill:none}}", "g ".repeat(100));
        let sheet = StyleSheet::parse(&css);
        let path = document.descendants().find(|node| node.has_tag_name("path")).unwrap();
        assert!(sheet.declarations(path).is_err());
    }
}
