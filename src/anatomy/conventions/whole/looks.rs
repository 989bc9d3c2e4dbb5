//! How likely readings are by what the drawing looks like.
//!
//! The network gives each class of drawings a likelihood. A reading of a class loses [`WEIGHT`] times the logarithm of how much
//! likelier the likeliest class is, [`MOST`] at most, and in proportion to how much of the drawing it explains: a leaf beside a
//! tree is no less a leaf. Gardens and potted plants consist of other plants, so where the drawing looks like one of them all
//! readings are as likely. Where one class is likelier than [`SURE`] there is a plain reading as well, and one of the likeliest class where
//! no way of drawing reads most of what is drawn.
//!
//! Drawings in the papers' way are not read plainly: they are better understood stroke by stroke.
//!
//! Limits: drawings in which the artist chose tools look like nothing.

use super::plain::Plain;
use super::view::View;
use super::{fleshy, soft, vessel, wood};
use crate::anatomy::conventions::page::{Page, bounds};
use crate::anatomy::conventions::trees::evidence::ramp;
use crate::anatomy::conventions::{Habit, Hypothesis};
use crate::anatomy::habit_classifier::{self, CLASSES, Class, Likeness};
use crate::sketch::Reading;
use std::collections::BTreeSet;

/// Log-odds for each unit of the logarithm of a likelihood, and most that a reading loses.
const WEIGHT: f32 = 0.7;
const MOST: f32 = 4.5;
/// Share of the lines' length from which a reading is one of the whole drawing, and in full.
const WHOLE: (f32, f32) = (0.4, 0.8);
/// What plants in parts of the drawing lose at least, as a share.
const PART: f32 = 0.5;
/// Least likelihood of a class as which a drawing is read plainly.
const SURE: f32 = 0.6;
/// Least likelihood of a class as which a drawing is read that nothing else reads, and log-odds of such a reading.
const LIKELY: f32 = 0.3;
const UNSURE: f32 = 0.3;
/// Share of the drawing from which a reading of its class makes a plain one needless.
const MAIN: f32 = 0.6;
/// Log-odds of a plain reading, and for each of its class's: less than those of ways of drawing that are known.
const PLAIN: (f32, f32, f32) = (0.5, 0.75, 3.0);
/// Least length of the lines that conventions look at, as a share of all: of what is left beside parts whose tool the artist chose the
/// network knows nothing.
const AUTO: f32 = 0.9;

/// Share of a plant in a garden or a pot from which it is explained without a plain reading.
const OPEN: f32 = 0.5;
/// Smallest plant of a garden that is looked at by itself, as a share of the drawing's diagonal.
const SMALLEST: f32 = 0.12;

/// What some lines look like.
pub(crate) struct Looks {
    likeness: Likeness,
}

impl Looks {
    /// That of the lines of a page that are not set apart; nothing where tools were chosen.
    pub(crate) fn of(page: &Page) -> Option<Self> {
        let all: Vec<usize> = (0..page.lines.len()).filter(|line| !page.is_apart(*line)).collect();
        let length: f32 = all.iter().map(|line| page.lines[*line].length).sum();
        (length > AUTO * page.length).then(|| Self::of_lines(page, &all)).flatten()
    }

    fn of_lines(page: &Page, lines: &[usize]) -> Option<Self> {
        let lines: Vec<&[glam::Vec2]> = lines.iter().map(|i| page.lines[*i].points.as_slice()).collect();
        habit_classifier::likeness(&lines).map(|likeness| Self { likeness })
    }

    /// Takes from the scores of readings what speaks against them.
    pub(crate) fn weigh(&self, page: &Page, hypotheses: &mut [Hypothesis]) {
        let all = page.lines.iter().map(|line| line.length).sum();
        for hypothesis in hypotheses {
            let share = share_of(page, &hypothesis.uses, all);
            let is_plant = hypothesis.habit.is_some();
            if self.is_garden() && is_plant && hypothesis.habit != Some(Habit::Flower) && share < MAIN {
                let own = Self::of_lines(page, &hypothesis.uses);
                hypothesis.score -= own.map_or(0.0, |own| own.against(hypothesis));
                continue;
            }
            // There is seldom a plant in a plant, and a pot speaks for a plant in it, however small it is.
            let is_strange = is_plant || hypothesis.reading == Reading::Pot;
            let share = ramp(share, WHOLE).max(if is_strange { PART } else { 0.0 });
            hypothesis.score -= share * self.against(hypothesis);
        }
    }

    /// Log-odds against a reading of these lines.
    fn against(&self, hypothesis: &Hypothesis) -> f32 {
        let Some(class) = class_of(hypothesis) else { return 0.0 };
        let of = |class: Class| self.likeness.of(class);
        let own = of(class).max(of(Class::Potted)).max(of(Class::Garden));
        (WEIGHT * (of(self.likeness.best()) / own).ln()).min(MOST)
    }

    /// Adds a plain pot if the page clearly looks like a plant in one and there is none among the readings.
    pub(crate) fn propose_pot(&self, page: &Page, known: &[Hypothesis], out: &mut Vec<Hypothesis>) {
        let is_pot = |known: &Hypothesis| known.reading == Reading::Pot && known.score > 0.0;
        let has_pot = known.iter().chain(out.iter()).any(is_pot);
        if self.likeness.best() == Class::Potted && self.is_sure() && !has_pot {
            let all = (0..page.lines.len()).collect();
            out.extend(View::of(page, all).and_then(|view| vessel::pot(&view, self.score())));
        }
    }

    /// Adds the plain reading of what is not set apart of a page, if it clearly looks like a plant, and of a garden those of its plants.
    pub(crate) fn propose(&self, page: &Page, out: &mut Vec<Hypothesis>) {
        let rest = || (0..page.lines.len()).filter(|line| !page.is_apart(*line)).collect::<Vec<_>>();
        let explained: BTreeSet<usize> = out
            .iter()
            .filter(|known| known.score > 0.0)
            .flat_map(|known| known.uses.iter().copied())
            .collect();
        let is_open = |lines: &[usize]| {
            let all: f32 = lines.iter().map(|line| page.lines[*line].length).sum();
            let own: Vec<usize> = lines.iter().copied().filter(|line| explained.contains(line)).collect();
            share_of(page, &own, all) < OPEN
        };
        match self.likeness.best() {
            Class::Garden => {
                let is_large = |group: &&Vec<usize>| {
                    let (low, high) = bounds(group.iter().map(|line| &page.lines[*line]));
                    low.distance(high) > SMALLEST * page.diagonal
                };
                for group in page.groups.iter().filter(is_large).filter(|group| is_open(group)) {
                    let looks = Self::of_lines(page, group);
                    looks.iter().for_each(|looks| looks.propose_one(page, group.clone(), out));
                }
            }
            Class::Potted if page.has_apart() && is_open(&rest()) => {
                let looks = Self::of_lines(page, &rest());
                looks.iter().for_each(|looks| looks.propose_one(page, rest(), out));
            }
            Class::Potted => {}
            _ => self.propose_one(page, rest(), out),
        }
    }

    /// Adds the plain reading of some lines that clearly look like a plant, unless they are read as one already.
    fn propose_one(&self, page: &Page, lines: Vec<usize>, out: &mut Vec<Hypothesis>) {
        let class = self.likeness.best();
        let all = lines.iter().map(|line| page.lines[*line].length).sum();
        let is_known = |known: &Hypothesis| {
            let own: Vec<usize> =
                known.uses.iter().copied().filter(|line| lines.binary_search(line).is_ok()).collect();
            class_of(known) == Some(class) && known.score > 0.0 && share_of(page, &own, all) > MAIN
        };
        if self.is_sure() && !out.iter().any(is_known) {
            let view = View::of(page, lines).filter(|view| !view.is_of_blades());
            let plain = view.and_then(|view| read(class, &view));
            out.extend(plain.map(|plain| plain.hypothesis(self.score())));
            return;
        }
        // What nothing reads at all is read as what it looks like most, however little that is.
        let explained = |line: &&usize| {
            out.iter().any(|known| known.score > 0.0 && known.uses.binary_search(line).is_ok())
        };
        let own: Vec<usize> = lines.iter().filter(explained).copied().collect();
        if share_of(page, &own, all) < OPEN {
            let view = View::of(page, lines).filter(|view| view.is_outline_without_blades());
            let likely = CLASSES.into_iter().filter(|class| self.likeness.of(*class) > LIKELY);
            let mut likely: Vec<Class> = likely.collect();
            likely.sort_by(|a, b| self.likeness.of(*b).total_cmp(&self.likeness.of(*a)));
            let plain = view.and_then(|view| likely.into_iter().find_map(|class| read(class, &view)));
            out.extend(plain.map(|plain| plain.hypothesis(UNSURE)));
        }
    }

    /// Whether several plants are the likeliest.
    pub(crate) fn is_garden(&self) -> bool {
        self.likeness.best() == Class::Garden
    }

    /// Whether one class is clearly the likeliest.
    fn is_sure(&self) -> bool {
        self.likeness.of(self.likeness.best()) > SURE
    }

    /// Log-odds of a plain reading.
    fn score(&self) -> f32 {
        let likely = self.likeness.of(self.likeness.best());
        (PLAIN.0 + PLAIN.1 * (likely / (1.0 - likely)).ln()).min(PLAIN.2)
    }
}

/// Length of some lines as a share of `all`.
fn share_of(page: &Page, lines: &[usize], all: f32) -> f32 {
    lines.iter().map(|line| page.lines[*line].length).sum::<f32>() / all
}

fn read(class: Class, view: &View) -> Option<Plain> {
    match class {
        Class::Bush => wood::bush(view),
        Class::Tree => wood::tree(view),
        Class::Palm => wood::palm(view),
        Class::Cactus => fleshy::cactus(view),
        Class::Mushroom => fleshy::mushroom(view),
        Class::Flower => soft::flower(view),
        Class::Leaf => soft::leaf(view),
        Class::Grass => soft::grass(view),
        Class::Garden | Class::Potted => None,
    }
}

/// The class of drawings in which a reading of the whole would be right; none where it may be several.
fn class_of(hypothesis: &Hypothesis) -> Option<Class> {
    match (hypothesis.habit, hypothesis.reading) {
        (Some(Habit::Tree | Habit::Conifer), _) => Some(Class::Tree),
        (Some(Habit::Bush), _) => Some(Class::Bush),
        (Some(Habit::Flower), _) => Some(Class::Flower),
        (Some(Habit::Palm), _) => Some(Class::Palm),
        (Some(Habit::Grass), _) => Some(Class::Grass),
        (Some(Habit::Succulent), _) => Some(Class::Cactus),
        (Some(Habit::Mushroom), _) => Some(Class::Mushroom),
        (None, Reading::Pot) => Some(Class::Potted),
        (None, Reading::Leaf) => Some(Class::Leaf),
        (None, _) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::page::even;
    use glam::Vec2;
    use std::f32::consts::TAU;

    fn looks(class: Class, likely: f32) -> Looks {
        Looks { likeness: Likeness::of_one(class, likely) }
    }

    /// A ring of shallow lobes on a line.
    fn lollipop() -> Page {
        let place = |k: usize| {
            let angle = TAU * k as f32 / 120.0;
            Vec2::new(0.0, -160.0) + (60.0 + 6.0 * (6.0 * angle).sin()) * Vec2::from_angle(angle)
        };
        Page::of_lines(&[
            (0..=120).map(place).collect(),
            even(&[Vec2::new(0.0, -100.0), Vec2::new(4.0, 0.0)], 40),
        ])
    }

    fn reading(uses: Vec<usize>, habit: Option<Habit>, reading: Reading) -> Hypothesis {
        Hypothesis { uses, score: 3.0, parts: Vec::new(), solids: Vec::new(), reading, habit }
    }

    #[test]
    fn a_reading_of_the_whole_as_another_plant_loses_and_one_of_a_part_loses_less() {
        let page = lollipop();
        let mut all = [
            reading(vec![0, 1], Some(Habit::Tree), Reading::Tree),
            reading(vec![0, 1], Some(Habit::Flower), Reading::Corolla),
            reading(vec![1], Some(Habit::Grass), Reading::Grass),
            reading(vec![1], None, Reading::Leaf),
        ];
        looks(Class::Tree, 0.95).weigh(&page, &mut all);
        assert_eq!((all[0].score, all[3].score), (3.0, 3.0));
        assert!(
            all[1].score < 0.0 && (0.0..3.0).contains(&all[2].score),
            "{} {}",
            all[1].score,
            all[2].score
        );
    }

    #[test]
    fn what_looks_like_a_pot_or_a_garden_may_be_any_plant() {
        let page = lollipop();
        for class in [Class::Potted, Class::Garden] {
            let mut all = [reading(vec![0, 1], Some(Habit::Tree), Reading::Tree)];
            looks(class, 0.99).weigh(&page, &mut all);
            assert_eq!(all[0].score, 3.0);
        }
    }

    #[test]
    fn a_plain_reading_is_added_only_where_the_class_is_sure_and_nothing_reads_it() {
        let page = lollipop();
        let plain = |likely: f32, known: Vec<Hypothesis>| {
            let (count, mut all) = (known.len(), known);
            looks(Class::Tree, likely).propose(&page, &mut all);
            all.split_off(count)
        };
        assert_eq!(plain(0.95, Vec::new()).first().and_then(|tree| tree.habit), Some(Habit::Tree));
        assert!(plain(0.6, Vec::new()).is_empty(), "an outline that is closed is a blade as well");
        assert!(plain(0.95, vec![reading(vec![0, 1], Some(Habit::Tree), Reading::Tree)]).is_empty());
    }

    #[test]
    fn what_nothing_reads_is_read_as_what_it_looks_like_most() {
        // A crown of which the right side was left out, on two lines.
        let place =
            |k: usize| Vec2::new(0.0, -160.0) - 60.0 * Vec2::from_angle(0.8 * TAU * (k as f32 / 120.0 - 0.5));
        let side = |x: f32| even(&[Vec2::new(x, -104.0), Vec2::new(x, 0.0)], 40);
        let page = Page::of_lines(&[(0..=120).map(place).collect(), side(-8.0), side(8.0)]);
        let plain = |likely: f32, known: Vec<Hypothesis>| {
            let (count, mut all) = (known.len(), known);
            looks(Class::Tree, likely).propose(&page, &mut all);
            all.split_off(count)
        };
        let found = plain(0.5, Vec::new());
        assert_eq!(found.first().map(|tree| (tree.habit, tree.score)), Some((Some(Habit::Tree), UNSURE)));
        assert!(plain(0.25, Vec::new()).is_empty(), "it looks like nothing");
        assert!(plain(0.5, vec![reading(vec![0], None, Reading::Leaf)]).is_empty(), "most of it is read");
    }

    #[test]
    fn plain_readings_exist_for_all_plants_that_are_not_several() {
        let view = |page| View::of(page, vec![0, 1]).unwrap();
        let page = lollipop();
        for class in [Class::Tree, Class::Mushroom, Class::Flower] {
            assert!(read(class, &view(&page)).is_some_and(|plain| !plain.parts.is_empty()), "{class:?}");
        }
        assert!(read(Class::Garden, &view(&page)).is_none());
    }
}
