//! Blade forms as rows of numbers: blending, and the slight variation from blade to blade.

use crate::params::Parameters as _;
use crate::plant::BladeForm;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

/// How many numbers of the row vary from blade to blade: all but the waves' number and the thickness.
const VARYING: usize = 5;

/// The form between `a` (share 0) and `b` (share 1).
pub(super) fn blend(a: &BladeForm, b: &BladeForm, share: f32) -> BladeForm {
    let (a, b) = (a.to_row(), b.to_row());
    BladeForm::from_row(std::array::from_fn(|k| a[k] + (b[k] - a[k]) * share))
}

/// The form with each number changed by up to `vary` of itself, and a little lean so that even flat blades differ.
pub(super) fn varied(form: &BladeForm, vary: f32, rng: &mut Pcg64Mcg) -> BladeForm {
    let mut row = form.to_row();
    for value in &mut row[..VARYING] {
        *value *= 1.0 + vary * rng.random_range(-1.0..1.0_f32);
    }
    row[1] += 0.12 * vary * rng.random_range(-1.0..1.0_f32);
    for (value, (min, max)) in row.iter_mut().zip(BladeForm::RANGES) {
        *value = value.clamp(*min as f32, *max as f32);
    }
    BladeForm::from_row(row)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;

    #[test]
    fn variation_stays_in_range_and_changes_something() {
        let form = BladeForm { cup: 2.0, ruffle: 0.3, ruffle_waves: 9.0, ..BladeForm::default() };
        let mut rng = Pcg64Mcg::seed_from_u64(1);
        for _ in 0..200 {
            let varied = varied(&form, 1.0, &mut rng);
            let in_range =
                |(value, (min, max)): (&f32, &(f64, f64))| (*min as f32..=*max as f32).contains(value);
            assert!(varied.to_row().iter().zip(BladeForm::RANGES).all(in_range), "{varied:?}");
            assert_ne!(varied, form);
            assert_eq!(varied.ruffle_waves, 9.0);
        }
    }

    #[test]
    fn no_variation_keeps_the_form() {
        let form = BladeForm::default();
        assert_eq!(varied(&form, 0.0, &mut Pcg64Mcg::seed_from_u64(1)), form);
    }
}
