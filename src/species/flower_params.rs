//! The parameters of a species' flowers, `flower.…`: what its file says, as the artist changes it.

use super::inflorescence::Inflorescence;
use super::looks::{BloomLook, ClumpLook, Species};
use crate::flower::Layers;
use crate::leaf::StemLeaves;
use std::borrow::Cow;

crate::parameters! {
    /// Flowers of a species.
    pub struct FlowerParams {
        /// How far flowers have opened of what their species opens: 0 bud, 1 all the way.
        open: f32 = 1.0, 0.0..=1.0, "";
        sections:
        /// Layers of the first full flower of the species; none where it has none.
        layers: Option<Layers> = None;
        /// How flowers stand together that are made without a drawing; none where one stands alone.
        inflorescence: Option<Inflorescence> = None;
        /// One flower that is made without a drawing.
        bloom: BloomLook = BloomLook::default();
        /// How many of them one plant sends up.
        clump: ClumpLook = ClumpLook::default();
        /// Leaves along its stem, or that of an inflorescence.
        leaves: StemLeaves = StemLeaves::default();
    }
}

impl FlowerParams {
    /// What the flowers of a species have where nobody says otherwise.
    pub fn of(species: &Species) -> Self {
        let layers = species.flowers.iter().find_map(|look| look.layers.clone());
        let (bloom, inflorescence) = (species.bloom.clone(), species.inflorescence.clone());
        let (clump, leaves) = (species.clump.clone(), species.stem_leaves.clone());
        Self { layers, inflorescence, bloom, clump, leaves, ..Self::default() }
    }

    /// The species with these flowers.
    pub fn applied<'a>(&self, species: &'a Species) -> Cow<'a, Species> {
        if *self == Self::of(species) {
            return Cow::Borrowed(species);
        }
        let mut changed = species.clone();
        changed.bloom = self.bloom.clone();
        changed.clump = self.clump.clone();
        changed.stem_leaves = self.leaves.clone();
        changed.inflorescence.clone_from(&self.inflorescence);
        if let Some(first) = changed.flowers.iter_mut().find(|look| look.layers.is_some()) {
            first.layers.clone_from(&self.layers);
        }
        // Florets of an inflorescence say themselves how far they have opened.
        let open = if self.inflorescence.is_some() { 1.0 } else { self.open };
        for layers in changed.flowers.iter_mut().filter_map(|look| look.layers.as_mut()) {
            layers.open *= open;
        }
        Cow::Owned(changed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_species_stays_itself_until_something_is_changed() {
        let rose = Species::built_in("peony").unwrap();
        let params = FlowerParams::of(&rose);
        assert!(matches!(params.applied(&rose), Cow::Borrowed(_)));
        let half = FlowerParams { open: 0.5, ..params };
        let layers = half.applied(&rose).flowers[0].layers.clone().unwrap();
        assert_eq!(layers.open, 0.5 * rose.flowers[0].layers.as_ref().unwrap().open);
    }
}
