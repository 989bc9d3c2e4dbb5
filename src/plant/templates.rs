//! The templates of a plant in a list; blades refer to them by their places in it.
//!
//! Places change where lists are joined or shortened, which is done here only.

use super::{Blade, ResolvedBlade, Template, TemplateId};
use std::ops::Index;
use std::sync::Arc;

/// The templates of a plant. What one list is asked for has to come from the same list.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Templates(Vec<Arc<Template>>);

impl Templates {
    /// Puts a template behind those that are there.
    pub fn add(&mut self, template: impl Into<Arc<Template>>) -> TemplateId {
        self.0.push(template.into());
        TemplateId(self.0.len() as u32 - 1)
    }

    /// All of them, in their order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Template> {
        self.0.iter().map(Arc::as_ref)
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The template of this place, if there is one.
    pub fn get(&self, id: TemplateId) -> Option<&Template> {
        self.0.get(id.index()).map(Arc::as_ref)
    }

    /// The template of this place, shared: it keeps its address from plant to plant.
    pub fn shared(&self, id: TemplateId) -> &Arc<Template> {
        &self.0[id.index()]
    }

    /// A blade together with its template.
    pub fn resolve(&self, blade: &Blade) -> ResolvedBlade<'_> {
        blade.with_template(&self[blade.template])
    }

    /// Puts other templates behind these; gives the place here of what had a place there.
    pub(super) fn append(&mut self, other: Self) -> impl Fn(TemplateId) -> TemplateId + use<> {
        let first = self.0.len() as u32;
        self.0.extend(other.0);
        move |id| TemplateId(id.0 + first)
    }

    /// Drops all but these, which keep their order; gives the place of each of them.
    pub(super) fn retain(
        &mut self,
        is_kept: impl Fn(TemplateId) -> bool,
    ) -> impl Fn(TemplateId) -> TemplateId {
        let kept: Vec<bool> = (0..self.0.len() as u32).map(|id| is_kept(TemplateId(id))).collect();
        let before = kept.iter().scan(0, |before, kept| {
            *before += u32::from(*kept);
            Some(*before - u32::from(*kept))
        });
        let place: Vec<u32> = before.collect();
        let mut kept = kept.into_iter();
        self.0.retain(|_| kept.next().unwrap_or(true));
        move |id| TemplateId(place[id.index()])
    }
}

impl Index<TemplateId> for Templates {
    type Output = Template;

    fn index(&self, id: TemplateId) -> &Template {
        &self.0[id.index()]
    }
}
