//! The numbers of a full flower: the section `[flowers.layers]` of a species file, and the parameters `flower.layers.…`.
//!
//! Pairs of numbers such as `bend_deg` and `bend_inner_deg` hold for the outermost and the innermost layer; layers between
//! are between. Closing and opening are the functions below.
//!
//! Where we depart from 003 §3.2: its closing `50·atan(N)·2/π` takes the number of layers, so that all petals would close
//! alike, tops out at 50° where its text says 80°, and is 25° for a single layer where its text says 0°. Here it takes the
//! index of the layer, and its limit is a number of the species. A factor that closes a bud cannot close an outermost layer
//! of 0°, so opening leads from the shape of a bud to that of the bloom.

use super::PetalOutline;
use serde::Deserialize;

/// Closing of all petals of a bud, degrees.
const BUD_CLOSING_DEG: f32 = 88.0;
/// How far a petal of a bud turns from foot to tip, degrees.
const BUD_BEND_DEG: f32 = 104.0;
/// How much smaller against their size in bloom the innermost petals of a bud are than the outermost.
const BUD_INNER: f32 = 0.45;
/// How much later than the outermost layer the innermost one opens, as a share of the time that each takes.
const LAG: f32 = 0.6;

crate::parameter_choice! {
    /// Who covers whom among the petals of a layer (003 §3.1).
    pub enum Aestivation {
        /// Margins meet and do not cover each other: lotus.
        Valvate = "valvate",
        /// Each has one margin over and one below its neighbours': hibiscus, chrysanthemum.
        Contorted = "contorted",
        /// One or two lie wholly outside and one wholly inside: rose.
        Imbricate = "imbricate",
        /// No layers: each petal stands further in than the one before it, by the divergence of phyllotaxis: camellia.
        Spiral = "spiral",
    }
}

crate::parameters! {
    /// Petals in layers about the axis of a flower.
    pub struct Layers {
        /// Layers.
        count: u32 = 1, 1..=40, "";
        /// Size of a layer against the one outside of it.
        shrink: f32 = 0.9, 0.3..=1.0, "";
        /// How much sizes differ from petal to petal.
        shrink_vary: f32 = 0.04, 0.0..=0.4, "";
        /// How far petals turn about the axis from where they should stand, at most.
        turn_vary_deg: f32 = 3.0, 0.0..=40.0, "degrees";
        /// How far petals lean from where they should stand, at most.
        tilt_vary_deg: f32 = 3.0, 0.0..=30.0, "degrees";
        /// Angle between the petals of the outermost layer and the plane across the axis, in full bloom.
        closing_outer_deg: f32 = 0.0, -60.0..=100.0, "degrees";
        /// The same angle to which the innermost layers come near.
        closing_deg: f32 = 80.0, 0.0..=110.0, "degrees";
        /// Layers after which half of it is reached.
        closing_half: f32 = 1.5, 0.05..=40.0, "layers";
        /// How far the flower has opened: 0 bud, 1 full bloom.
        open: f32 = 1.0, 0.0..=1.0, "";
        /// Size of the petals of a bud against those in bloom.
        bud_size: f32 = 0.6, 0.2..=1.0, "";
        /// How far petals of the outermost layer turn toward the axis from foot to tip.
        bend_deg: f32 = 25.0, -180.0..=180.0, "degrees";
        /// The same of the innermost layer.
        bend_inner_deg: f32 = 60.0, -180.0..=180.0, "degrees";
        /// How far the tips of the outermost petals roll back.
        curl_deg: f32 = 0.0, -120.0..=240.0, "degrees";
        /// The same of the innermost petals.
        curl_inner_deg: f32 = 0.0, -120.0..=240.0, "degrees";
        /// How far the margins of the outermost petals rise over their middle, where neighbours leave room.
        cup: f32 = 0.25, -0.5..=1.0, "of the half width";
        /// The same of the innermost petals.
        cup_inner: f32 = 0.3, -0.5..=1.0, "of the half width";
        /// Distance of the outermost petals' feet from the axis.
        receptacle: f32 = 0.12, 0.0..=0.8, "of the reach";
        /// Distance of the innermost petals' feet from the axis: outside of what stands in the middle.
        core: f32 = 0.04, 0.0..=0.8, "of the reach";
        /// How much higher than the outermost the innermost petals stand.
        rise: f32 = 0.06, 0.0..=1.0, "of the reach";
        /// Thickness of petals.
        thickness: f32 = 0.006, 0.001..=0.05, "of the reach";
        /// Height of waves along the margins.
        ruffle: f32 = 0.0, 0.0..=0.3, "of the length";
        /// Waves along a whole margin.
        ruffle_waves: f32 = 7.0, 0.0..=40.0, "";
        /// Which divergence spiral petals have: 360° / (t + 1/φ); 2 gives 137.5°, 3 gives 99.5°.
        spiral_t: u32 = 2, 1..=12, "";
        choices:
        /// Which petals of a layer cover which: none, each the next, one or two all others, or all in one spiral.
        aestivation: Aestivation = Aestivation::Imbricate;
        others:
        /// Petals of a layer: pairs of a layer and a number, layers between are between.
        petals: Vec<(u32, u32)> = vec![(0, 5)], read_petals;
        /// Outline of the innermost petals; that of the outermost if left out.
        inner: Option<PetalOutline> = None;
        sections:
        /// Outline of the outermost petals.
        outline: PetalOutline = PetalOutline::default();
    }
}

/// Most petals of one layer.
const MOST_PETALS: u32 = 200;

fn read_petals<'de, D: serde::Deserializer<'de>>(source: D) -> Result<Vec<(u32, u32)>, D::Error> {
    let list = Vec::<(u32, u32)>::deserialize(source)?;
    let refused = |what: String| Err(serde::de::Error::custom(format!("`petals`: {what}")));
    if list.is_empty() {
        return refused("write at least one pair of a layer and its number of petals, as [[0, 5]]".into());
    }
    if let Some(pair) = list.windows(2).find(|pair| pair[0].0 >= pair[1].0) {
        return refused(format!("layer {} stands behind layer {}; layers must rise", pair[1].0, pair[0].0));
    }
    match list.iter().find(|(_, number)| !(1..=MOST_PETALS).contains(number)) {
        Some((layer, number)) => {
            refused(format!("layer {layer} has {number} petals; 1 to {MOST_PETALS} are possible"))
        }
        None => Ok(list),
    }
}

/// How the petals of a layer stand at an opening; angles in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LayerShape {
    /// Angle between the petals and the plane across the axis, in the mean from foot to tip.
    pub closing_rad: f32,
    /// How far they turn toward the axis from foot to tip.
    pub bend_rad: f32,
    /// How far their tips roll back.
    pub curl_rad: f32,
    /// How far margins rise over the middle, share of the half width.
    pub cup: f32,
    /// Length of the petals, share of the reach.
    pub length: f32,
    /// How far the layer has opened, 0 to 1.
    pub open: f32,
}

impl Layers {
    /// Petals of a layer.
    pub fn petals_of(&self, layer: u32) -> u32 {
        let after = self.petals.partition_point(|(known, _)| *known <= layer);
        let (before, after) = (self.petals.get(after.wrapping_sub(1)), self.petals.get(after));
        let (from, to) = (before.or(after), after.or(before));
        let (Some(&(from, a)), Some(&(to, b))) = (from, to) else { return 0 };
        let share = if to > from { layer.saturating_sub(from) as f32 / (to - from) as f32 } else { 0.0 };
        (a as f32 + (b as f32 - a as f32) * share).round() as u32
    }

    /// Petals of the whole flower.
    pub fn all_petals(&self) -> u32 {
        (0..self.count).map(|layer| self.petals_of(layer)).sum()
    }

    /// How the petals stand `layer` layers from the outermost, a number from 0 to one less than the layers.
    pub fn shape_at(&self, layer: f32) -> LayerShape {
        let inward = layer / (self.count.max(2) - 1) as f32;
        let between = |outer: f32, inner: f32| outer + (inner - outer) * inward;
        let open = self.open_at(inward);
        let from_bud = |bud: f32, bloom: f32| bud + (bloom - bud) * open;
        LayerShape {
            closing_rad: from_bud(BUD_CLOSING_DEG, self.closing_deg_at(layer)).to_radians(),
            bend_rad: from_bud(BUD_BEND_DEG, between(self.bend_deg, self.bend_inner_deg)).to_radians(),
            curl_rad: (open * open * between(self.curl_deg, self.curl_inner_deg)).to_radians(),
            cup: open * between(self.cup, self.cup_inner),
            length: self.shrink.powf(layer) * from_bud(self.bud_size * (1.0 - BUD_INNER * inward), 1.0),
            open,
        }
    }

    /// Closing of a layer in full bloom: `first + (limit − first) · (2/π) · atan(layer / half)`, degrees.
    pub fn closing_deg_at(&self, layer: f32) -> f32 {
        let share = std::f32::consts::FRAC_2_PI * (layer / self.closing_half).atan();
        self.closing_outer_deg + (self.closing_deg - self.closing_outer_deg) * share
    }

    /// How far the petals have opened that stand a share of the way inward: outer ones open first.
    fn open_at(&self, inward: f32) -> f32 {
        let open = (self.open * (1.0 + LAG) - LAG * inward).clamp(0.0, 1.0);
        open * open * (3.0 - 2.0 * open)
    }

    /// Outline of the petals that stand a share of the way inward.
    pub fn outline_at(&self, inward: f32) -> PetalOutline {
        self.inner.as_ref().map_or_else(|| self.outline.clone(), |inner| self.outline.blend(inner, inward))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layers(text: &str) -> Layers {
        toml::from_str(text).unwrap()
    }

    #[test]
    fn layers_between_have_petals_between() {
        let layers = layers("count = 9\npetals = [[0, 5], [1, 8], [8, 15]]");
        assert_eq!([0, 1, 2, 8, 30].map(|layer| layers.petals_of(layer)), [5, 8, 9, 15, 15]);
    }

    #[test]
    fn closing_follows_its_formula_and_never_passes_the_limit() {
        let layers = layers("count = 20\nclosing_half = 1.5\nclosing_deg = 80");
        assert_eq!(layers.closing_deg_at(0.0), 0.0);
        assert!((layers.closing_deg_at(1.5) - 40.0).abs() < 1e-3);
        let all: Vec<f32> = (0..20).map(|layer| layers.closing_deg_at(layer as f32)).collect();
        assert!(all.windows(2).all(|pair| pair[0] < pair[1]) && all.iter().all(|deg| *deg < 80.0));
        let shape = layers.shape_at(3.0);
        assert!((shape.closing_rad.to_degrees() - layers.closing_deg_at(3.0)).abs() < 1e-3);
    }

    #[test]
    fn outer_layers_open_first_and_all_in_the_end() {
        let at = |open: f32, layer: f32| Layers { open, ..layers("count = 9") }.shape_at(layer).open;
        assert_eq!((at(0.0, 0.0), at(1.0, 8.0)), (0.0, 1.0));
        assert!(at(0.4, 0.0) > at(0.4, 8.0));
        assert!((0..=20).map(|k| at(k as f32 / 20.0, 4.0)).is_sorted());
    }

    #[test]
    fn lists_that_cannot_be_are_refused_with_the_remedy() {
        let fault = |text: &str| toml::from_str::<Layers>(text).unwrap_err().to_string();
        assert!(fault("petals = []").contains("at least one pair"));
        assert!(fault("petals = [[0, 5], [0, 8]]").contains("layers must rise"));
        assert!(fault("petals = [[0, 0]]").contains("1 to 200"));
        assert!(fault("count = 0").contains("outside 1 to 40"));
        assert!(fault("count = 1000000").contains("outside 1 to 40"));
        assert!(fault("shrink = 1.5").contains("outside 0.3 to 1"));
        assert!(fault("aestivation = \"twisted\"").contains("contorted"));
    }
}
