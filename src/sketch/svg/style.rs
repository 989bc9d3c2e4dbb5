//! Whether an element is painted at all: fill, stroke and visibility, from presentation attributes, style sheets and
//! `style`, weighed as CSS weighs them and inherited (SVG 1.1, chapters 6 and 11; CSS 2.1, section 6.4).
//!
//! What paint looks like means nothing to a drawing of strokes, so of every property one thing is kept: whether it lets
//! anything be seen. Paint of any colour, gradient or pattern counts as seen; `none`, `transparent`, an opacity or a
//! line width of zero do not. Of the keywords for all properties only `inherit` is known.

use roxmltree::Node;
use svgtypes::Length;

/// The properties that decide, those that children inherit first.
const PROPERTIES: [&str; 8] =
    ["fill", "stroke", "fill-opacity", "stroke-opacity", "stroke-width", "visibility", "display", "opacity"];
/// How many of [`PROPERTIES`] are inherited; the others hold for an element and all inside it.
const INHERITED: usize = 6;

/// What declarations say of each of [`PROPERTIES`]; later ones win.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Declarations([Option<Value>; PROPERTIES.len()]);

#[derive(Clone, Copy, Debug, PartialEq)]
enum Value {
    /// Whether anything is seen, as far as this property decides.
    Seen(bool),
    Inherit,
}

impl Declarations {
    /// Those of the attributes that are named like properties.
    pub(super) fn of_attributes(node: Node<'_, '_>) -> Self {
        let mut all = Self::default();
        for attribute in node.attributes().filter(|attribute| attribute.namespace().is_none()) {
            all.declare(attribute.name(), attribute.value());
        }
        all
    }

    /// Those of a `style` attribute or of a rule, without and with `!important`.
    pub(super) fn parse(text: &str) -> [Self; 2] {
        let mut all = [Self::default(); 2];
        for (name, value) in text.split(';').filter_map(|declaration| declaration.split_once(':')) {
            let important = value.rsplit_once('!').filter(|(_, word)| word.trim() == "important");
            let weight = usize::from(important.is_some());
            all[weight].declare(name.trim(), important.map_or(value, |(value, _)| value));
        }
        all
    }

    fn declare(&mut self, name: &str, text: &str) {
        if let Some(index) = PROPERTIES.iter().position(|property| *property == name)
            && let Some(value) = value(name, text.trim())
        {
            self.0[index] = Some(value);
        }
    }

    /// These, and where they say something the others in their place.
    pub(super) fn overridden_by(mut self, others: &Self) -> Self {
        self.0.iter_mut().zip(others.0).for_each(|(own, other)| *own = other.or(*own));
        self
    }
}

/// What a property's text says, nothing where it cannot be read.
fn value(name: &str, text: &str) -> Option<Value> {
    if text.is_empty() {
        return None;
    }
    if text.eq_ignore_ascii_case("inherit") {
        return Some(Value::Inherit);
    }
    let is_one_of = |words: &[&str]| words.iter().any(|word| text.eq_ignore_ascii_case(word));
    let seen = match name {
        "fill" | "stroke" => !is_one_of(&["none", "transparent"]),
        "display" => !is_one_of(&["none"]),
        "visibility" if is_one_of(&["visible"]) => true,
        "visibility" if is_one_of(&["hidden", "collapse"]) => false,
        "visibility" => return None,
        _ => text.parse::<Length>().ok()?.number > 0.0,
    };
    Some(Value::Seen(seen))
}

/// What holds for an element: for each inherited property whether it lets anything be seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Style([bool; INHERITED]);

impl Style {
    /// Before anything is said: filled, without a line.
    pub(super) const INITIAL: Self = Self([true, false, true, true, true, true]);

    /// The style of an element inside of this one; `None` if neither it nor anything in it is seen.
    pub(super) fn inherited_by(mut self, declared: &Declarations) -> Option<Self> {
        let (inherited, own) = declared.0.split_at(INHERITED);
        if own.contains(&Some(Value::Seen(false))) {
            return None;
        }
        for (value, declared) in self.0.iter_mut().zip(inherited) {
            if let Some(Value::Seen(seen)) = declared {
                *value = *seen;
            }
        }
        Some(self)
    }

    /// Whether the element is hidden; what is inside may be visible.
    pub(super) fn is_hidden(&self) -> bool {
        let [.., visible] = self.0;
        !visible
    }

    /// Whether its inside is painted.
    pub(super) fn is_filled(&self) -> bool {
        let [fill, _, opaque, ..] = self.0;
        fill && opaque
    }

    /// Whether its line is painted.
    pub(super) fn is_stroked(&self) -> bool {
        let [_, stroke, _, opaque, wide, _] = self.0;
        stroke && opaque && wide
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn style(text: &str) -> Option<Style> {
        let [normal, important] = Declarations::parse(text);
        Style::INITIAL.inherited_by(&normal.overridden_by(&important))
    }

    #[test]
    fn every_way_to_paint_nothing() {
        for text in ["fill:none", "fill : transparent", "fill-opacity:0", "fill-opacity: 0%", "fill:NONE;"] {
            assert!(!style(text).unwrap().is_filled(), "{text}");
        }
        for text in ["", "stroke:none", "stroke:red;stroke-opacity:.0", "stroke:red;stroke-width:0px"] {
            assert!(!style(text).unwrap().is_stroked(), "{text}");
        }
        assert!(style("display:none").is_none() && style("opacity:0").is_none());
        assert!(style("visibility:collapse").unwrap().is_hidden());
    }

    #[test]
    fn paint_of_any_kind_is_seen_and_the_last_word_counts() {
        for text in ["stroke:url(#g) none", "stroke:none;stroke:#123", "stroke:red !important;stroke:none"] {
            assert!(style(text).unwrap().is_stroked(), "{text}");
        }
        assert!(style("fill:none;fill:;fill-opacity:wide").is_some_and(|style| !style.is_filled()));
    }
}
