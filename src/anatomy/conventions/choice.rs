//! The best set of hypotheses in which no stroke is used twice.
//!
//! Hypotheses that share strokes form groups; in each group the set with the greatest sum of scores is found exactly by
//! branch and bound where it has at most 16 members, and greedily by score where it has more. Equal sums are decided by
//! the order of the proposals, so that the choice depends on nothing else.

use super::Hypothesis;
use super::page::{root, unite};

/// Most hypotheses of a group that are weighed in all combinations.
const EXACT: usize = 16;

/// The best set, in the order of the proposals.
pub fn best(hypotheses: Vec<Hypothesis>) -> Vec<Hypothesis> {
    let mut is_chosen = vec![false; hypotheses.len()];
    chosen(&hypotheses).into_iter().for_each(|i| is_chosen[i] = true);
    hypotheses.into_iter().zip(is_chosen).filter(|(_, is_chosen)| *is_chosen).map(|(h, _)| h).collect()
}

/// The members of the best set, ascending.
pub(super) fn chosen(hypotheses: &[Hypothesis]) -> Vec<usize> {
    let likely: Vec<usize> = (0..hypotheses.len()).filter(|i| hypotheses[*i].score > 0.0).collect();
    let mut chosen: Vec<usize> =
        groups(hypotheses, &likely).iter().flat_map(|group| of_group(hypotheses, group)).collect();
    chosen.sort_unstable();
    chosen
}

/// Those of the hypotheses that share strokes, directly or through others; each group ascending.
fn groups(hypotheses: &[Hypothesis], which: &[usize]) -> Vec<Vec<usize>> {
    let lines = hypotheses.iter().flat_map(|h| h.uses.last()).max().map_or(0, |last| last + 1);
    let mut first_user: Vec<Option<usize>> = vec![None; lines];
    let mut leader: Vec<usize> = (0..hypotheses.len()).collect();
    for &i in which {
        for &line in &hypotheses[i].uses {
            match first_user[line] {
                None => first_user[line] = Some(i),
                Some(other) => unite(&mut leader, i, other),
            }
        }
    }
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); hypotheses.len()];
    for &i in which {
        let first = root(&mut leader, i);
        members[first].push(i);
    }
    members.retain(|group| !group.is_empty());
    members
}

/// The best members of one group.
fn of_group(hypotheses: &[Hypothesis], group: &[usize]) -> Vec<usize> {
    let mut by_score = group.to_vec();
    by_score.sort_by(|&a, &b| hypotheses[b].score.total_cmp(&hypotheses[a].score).then(a.cmp(&b)));
    let mut search = Search { hypotheses, order: &by_score, taken: Vec::new(), best: Vec::new(), most: 0.0 };
    if group.len() <= EXACT {
        search.weigh(0, 0.0);
    } else {
        search.take_greedily();
    }
    search.best
}

struct Search<'a> {
    hypotheses: &'a [Hypothesis],
    order: &'a [usize],
    taken: Vec<usize>,
    best: Vec<usize>,
    most: f32,
}

impl Search<'_> {
    fn is_free(&self, candidate: usize) -> bool {
        let uses = &self.hypotheses[candidate].uses;
        let is_used =
            |line: &usize| self.taken.iter().any(|t| self.hypotheses[*t].uses.binary_search(line).is_ok());
        !uses.iter().any(is_used)
    }

    /// Weighs all sets that go on from what is taken with members from `next` on.
    fn weigh(&mut self, next: usize, sum: f32) {
        if sum > self.most {
            (self.most, self.best) = (sum, self.taken.clone());
        }
        let Some(&candidate) = self.order.get(next) else { return };
        let rest: f32 = self.order[next..].iter().map(|i| self.hypotheses[*i].score).sum();
        if sum + rest <= self.most {
            return;
        }
        if self.is_free(candidate) {
            self.taken.push(candidate);
            self.weigh(next + 1, sum + self.hypotheses[candidate].score);
            self.taken.pop();
        }
        self.weigh(next + 1, sum);
    }

    fn take_greedily(&mut self) {
        for &candidate in self.order {
            if self.is_free(candidate) {
                self.taken.push(candidate);
            }
        }
        self.best.clone_from(&self.taken);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sketch::Reading;

    fn hypothesis(uses: &[usize], score: f32) -> Hypothesis {
        Hypothesis {
            uses: uses.to_vec(),
            score,
            parts: Vec::new(),
            solids: Vec::new(),
            reading: Reading::Tree,
            habit: None,
        }
    }

    fn scores(hypotheses: Vec<Hypothesis>) -> Vec<f32> {
        best(hypotheses).iter().map(|h| h.score).collect()
    }

    #[test]
    fn two_good_ones_outweigh_a_better_one_between_them() {
        let all = vec![hypothesis(&[0, 1], 3.0), hypothesis(&[1, 2], 4.0), hypothesis(&[2, 3], 3.0)];
        assert_eq!(scores(all), [3.0, 3.0]);
    }

    #[test]
    fn what_is_unlikely_is_never_taken() {
        assert!(scores(vec![hypothesis(&[0], -1.0), hypothesis(&[1], 0.0)]).is_empty());
    }

    #[test]
    fn of_equals_the_first_wins() {
        let all = vec![hypothesis(&[0, 1], 2.0), hypothesis(&[1], 2.0)];
        assert_eq!(best(all)[0].uses, [0, 1]);
    }

    #[test]
    fn a_large_group_keeps_strokes_apart() {
        let all: Vec<_> = (0..60).map(|k| hypothesis(&[k, k + 1], 1.0 + (k % 7) as f32)).collect();
        let chosen = best(all);
        let mut uses: Vec<usize> = chosen.iter().flat_map(|h| h.uses.clone()).collect();
        uses.sort_unstable();
        assert!(chosen.len() > 15 && uses.windows(2).all(|w| w[0] != w[1]));
    }
}
