//! The leaves that a plant has already: what grows in a brush has leaves like them, drawn ones too.

use crate::plant::{Blade, GrownId, Organ, OrganKind, Origin, Plant, Shape, Template, TemplateId, Templates};
use crate::random::{Choice, mix, unit};
use glam::Vec3;

/// Most forms of leaves that are taken up.
const FORMS: usize = 32;
/// Most drawn leaves that are looked at.
const DRAWN: usize = 1000;

/// The leaves of a plant, in general.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct OwnLeaves {
    /// Median length, metres; none of a plant without leaves.
    pub(super) length: Option<f32>,
    /// Where drawn leaves stand and how long they are, metres.
    drawn: Vec<(Vec3, f32)>,
    /// What they are copies of, each with how much wider than long it is made.
    forms: Vec<(Template, f32)>,
}

impl OwnLeaves {
    /// Of a plant; those of flowers do not count.
    pub(super) fn of(plant: &Plant) -> Self {
        let is_leaf = |organ: &&Organ| organ.kind() == OrganKind::Leaf && organ.flower.is_none();
        let leaves = plant.organs.iter().filter(is_leaf).filter_map(|organ| match &organ.shape {
            Shape::Blade(blade) => Some((organ.origin, blade)),
            _ => None,
        });
        let (mut lengths, mut known, mut forms) = (Vec::new(), Vec::<TemplateId>::new(), Vec::new());
        let mut drawn = Vec::new();
        for (origin, Blade { template, base, u, v, .. }) in leaves {
            let form = &plant.templates[*template];
            let length = v.length() * form.length();
            lengths.push(length);
            if origin.is_drawn() && drawn.len() < DRAWN {
                drawn.push((*base, length));
            }
            if forms.len() < FORMS && v.length() > 0.0 && !known.contains(template) {
                known.push(*template);
                // Of a leaf that was drawn there was one; now there are many, and nobody looks at each.
                forms.push((form.reduced(), u.length() / v.length()));
            }
        }
        lengths.sort_unstable_by(f32::total_cmp);
        Self { length: lengths.get(lengths.len() / 2).copied(), drawn, forms }
    }

    /// Length of the drawn leaf that is nearest to a place, metres; of a plant without such the median of all.
    pub(super) fn length_at(&self, at: Vec3) -> Option<f32> {
        let by_distance = |a: &&(Vec3, f32), b: &&(Vec3, f32)| {
            a.0.distance_squared(at).total_cmp(&b.0.distance_squared(at))
        };
        self.drawn.iter().min_by(by_distance).map(|(_, length)| *length).or(self.length)
    }

    /// Makes new leaves, copies of the usual templates, copies of these forms instead, each as long as it is; gives the templates
    /// of which they are copies then.
    pub(super) fn give_forms(&self, leaves: &mut [Organ], usual: Templates, seed: u64) -> Templates {
        if self.forms.is_empty() {
            return usual;
        }
        let mut templates = Templates::default();
        let ids: Vec<TemplateId> = self.forms.iter().map(|(form, _)| templates.add(form.clone())).collect();
        for (nth, leaf) in (0u64..).zip(leaves) {
            let Shape::Blade(blade) = &mut leaf.shape else { continue };
            // By its name, so that those that are there stay as they are while a stroke goes on.
            let of = if let Origin::Grown(GrownId(name)) = leaf.origin { name } else { nth };
            let pick = unit(mix(Choice::LEAF_OUTLINE.key(seed), of)) * ids.len() as f32;
            let pick = (pick as usize).min(ids.len() - 1);
            let (form, wider) = &self.forms[pick];
            let scale = blade.v.length() * usual[blade.template].length() / form.length();
            blade.template = ids[pick];
            blade.v = blade.v.normalize_or_zero() * scale;
            blade.u = blade.u.normalize_or_zero() * (scale * wider);
        }
        templates
    }
}
