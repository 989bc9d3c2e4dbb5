//! How people draw plants who do not know the papers: several strokes for one part, several parts in one stroke.
//!
//! The papers take every stroke for one organ. People draw a trunk by its two sides, a corolla or a crown in one line, grass as
//! a zigzag, a pot under it all. This stage looks at the whole drawing before single strokes are judged. Every convention, a
//! file each, proposes [`Hypothesis`]es: which strokes, which parts they are, how likely. [`choice`] takes the best set in which
//! no stroke is used twice. What it makes are strokes again, each with the tool that its part asks for ([`Piece`]), so that all
//! stages behind this one are those of drawings in the papers' way. Strokes that no hypothesis uses go on untouched, to the
//! classifier; strokes whose tool the artist chose are never looked at.
//!
//! | file | what |
//! | --- | --- |
//! | `hypothesis` | a reading of some strokes, and what becomes of them |
//! | `page` | strokes as even lines with their measures |
//! | `choice` | the best set of hypotheses |
//! | `corrected` | hypotheses as the artist corrected them |
//! | `alternatives` | other readings of some strokes, for the artist to choose from |
//! | `pieces` | what hypotheses make: strokes with tools |
//! | `plants` | plants that stand side by side, each with a page of its own |
//! | `meadow` | many plants, each read alone |
//!
//! | folder | what |
//! | --- | --- |
//! | `lines` | strokes that are one line together |
//! | `beneath` | what plants stand in, on or beside: pots, ground lines, fences; the sky and words |
//! | `trees` | trees, firs, bushes |
//! | `bodies` | cacti, mushrooms, fruits |
//! | `flowers` | flowers from above and from the side |
//! | `leaves` | leaves of any number of strokes, several in one stroke, at a stem |
//! | `tufts` | grass, palms and other fronds |
//! | `whole` | what drawings look like as a whole |
//! | `shapes` | what conventions share: silhouettes, middle lines, lobes, tips |
//!
//! The reading depends on nothing but the strokes, so the same drawing means the same plant however it came about.
//! Limits: what is drawn over several plants at once is not understood; strokes that hatch a shade belong to the part that they lie on. Sources: counts
//! of what people draw in `docs/drawings.md`; no paper treats them.

pub mod alternatives;
pub mod choice;
pub mod hypothesis;
pub mod page;
pub mod pieces;

mod beneath;
mod bodies;
mod corrected;
mod flowers;
mod leaves;
mod lines;
mod meadow;
mod plants;
mod shapes;
mod trees;
mod tufts;
mod whole;

pub use hypothesis::{Habit, Hypothesis, Made, Solid, SolidKind};
pub use pieces::{DrawnSolid, Interpretation, Piece, ReadStrokes};

use crate::sketch::{Correction, Corrections, Reading, Stroke, StrokeId, Verdict};
use beneath::{aloft, frame, ground, pot, writing};
use bodies::{ball, body, fruits, mushroom, pads};
use corrected::Corrected;
use flowers::{bell, bud, corolla, corolla_on_stem, cup, gathered, lotus, rays, rose, row};
use leaves::{
    above_pot, clover, double_stem, leaf, leaf_loops, leafy_branches, leafy_stem, lobed_leaf, pinnate,
    potted_stem, stem_arcs, stem_loops, strap,
};
use lines::{Redrawn, chains::Chains};
use page::Page;
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::sync::Arc;
use trees::{bare, bush, cloud_pads, conifer, in_blossom, poplar_row, tree, tree_on_line};
use tufts::{fronds, grass, lawn, tuft};
use whole::Looks;

crate::parameters! {
    /// How drawings are read that are not drawn in the papers' way.
    pub struct ConventionParams {
        /// Reads trunks of two lines, corollas in one stroke and the like; off, every stroke is one organ, as in the papers.
        enabled: bool = true, 0..=1, "";
    }
}

/// What is kept of one drawing's reading for the next: its lines, what its small plants may be, and the whole of it as long as
/// nothing changes.
#[derive(Debug, Default)]
pub struct Memory {
    drawn: page::Shapes,
    restated: Seen,
    joined: Seen,
    chains: lines::chains::Joined,
    meadow: meadow::Memory,
    last: Option<Last>,
}

/// What is kept of the lines of a page.
#[derive(Debug, Default)]
struct Seen {
    shapes: page::Shapes,
    plants: plants::Proposals,
}

impl Seen {
    fn for_one_build() -> Self {
        Self { shapes: page::Shapes::for_one_call(), plants: plants::Proposals::for_one_call() }
    }
}

/// A reading, and what it was made from.
#[derive(Debug)]
struct Last {
    strokes: Vec<Arc<Stroke>>,
    corrections: Corrections,
    params: ConventionParams,
    interpretation: Arc<Interpretation>,
}

impl Memory {
    /// For a single drawing, of which nothing is kept.
    pub fn for_one_build() -> Self {
        let (drawn, chains) = (page::Shapes::for_one_call(), lines::chains::Joined::for_one_call());
        let (restated, joined) = (Seen::for_one_build(), Seen::for_one_build());
        Self { drawn, restated, joined, chains, meadow: meadow::Memory::for_one_build(), last: None }
    }
}

/// Reads the strokes of a drawing of which the artist corrected nothing; those that no convention explains come back as they are.
pub fn interpret(strokes: &[Arc<Stroke>], params: &ConventionParams) -> Interpretation {
    let mut memory = Memory::for_one_build();
    let interpretation = interpret_with(&mut memory, strokes, &Corrections::default(), params);
    drop(memory);
    Arc::unwrap_or_clone(interpretation)
}

/// The interpretation of strokes with the artist's corrections, the same as of a drawing that is new, again and again while it changes.
pub fn interpret_with(
    known: &mut Memory,
    strokes: &[Arc<Stroke>],
    corrections: &Corrections,
    params: &ConventionParams,
) -> Arc<Interpretation> {
    if !params.enabled {
        return Arc::new(Interpretation::untouched(strokes));
    }
    let is_same = |last: &&Last| {
        let same = |(a, b): (&Arc<Stroke>, &Arc<Stroke>)| Arc::ptr_eq(a, b);
        last.params == *params
            && last.corrections == *corrections
            && last.strokes.len() == strokes.len()
            && last.strokes.iter().zip(strokes).all(same)
    };
    if let Some(last) = known.last.as_ref().filter(is_same) {
        return Arc::clone(&last.interpretation);
    }
    let chosen = choice::best(proposals(known, strokes, corrections));
    let mut interpretation = Interpretation::of(strokes, chosen);
    if let Some(last) = &known.last {
        interpretation.share_with(&last.interpretation);
    }
    let interpretation = Arc::new(interpretation);
    let (strokes, corrections, params) = (strokes.to_vec(), corrections.clone(), params.clone());
    known.last = Some(Last { strokes, corrections, params, interpretation: Arc::clone(&interpretation) });
    interpretation
}

/// A way of drawing: adds what it proposes for a page to what others proposed.
type Propose = fn(&Page, &mut Vec<Hypothesis>);

/// What one convention proposes for lines through some corners.
#[cfg(test)]
fn read_by(propose: Propose, lines: &[Vec<glam::Vec2>]) -> Vec<Hypothesis> {
    let mut all = Vec::new();
    propose(&Page::of_lines(lines), &mut all);
    all
}

/// The same for strokes that have these points and no others.
#[cfg(test)]
fn read_as_drawn(propose: Propose, lines: &[Vec<glam::Vec2>]) -> Vec<Hypothesis> {
    let mut all = Vec::new();
    propose(&Page::new(&strokes(lines)), &mut all);
    all
}

/// Strokes that have these points and no others, named by their places.
#[cfg(test)]
fn strokes(lines: &[Vec<glam::Vec2>]) -> Vec<Arc<Stroke>> {
    let stroke = |(id, line): (usize, &Vec<glam::Vec2>)| {
        let points = line.iter().copied().map(crate::sketch::StrokePoint::at).collect();
        Arc::new(Stroke { id: id as u64, tool: crate::sketch::Tool::Auto, points, brush: None })
    };
    lines.iter().enumerate().map(stroke).collect()
}

/// A line through some corners.
#[cfg(test)]
fn line(places: &[(f32, f32)]) -> Vec<glam::Vec2> {
    places.iter().map(|p| glam::Vec2::from(*p)).collect()
}

/// The first of these, beside what `beneath` proposes and sets apart.
#[cfg(test)]
fn read_above(beneath: Propose, propose: Propose, lines: &[Vec<glam::Vec2>]) -> Vec<Hypothesis> {
    let (mut page, mut all) = (Page::of_lines(lines), read_by(beneath, lines));
    page.set_apart(all.iter().flat_map(|hypothesis| hypothesis.uses.iter().copied()).collect());
    let known = all.len();
    propose(&page, &mut all);
    all.split_off(known)
}

/// What plants stand in or on, the first beneath which the next is looked for.
const BENEATH: &[Propose] = &[pot::propose, frame::propose, ground::propose];

/// All others.
const CONVENTIONS: &[Propose] = &[
    tree::propose,
    tree_on_line::propose,
    poplar_row::propose,
    cloud_pads::propose,
    bare::propose,
    conifer::propose,
    bush::propose,
    body::propose,
    ball::propose,
    pads::propose,
    mushroom::propose,
    fruits::propose,
    corolla::propose,
    corolla_on_stem::propose,
    rays::propose,
    gathered::propose,
    cup::propose,
    bell::propose,
    lotus::propose,
    bud::propose,
    rose::propose,
    row::propose,
    leaf::propose,
    lobed_leaf::propose,
    clover::propose,
    leafy_stem::propose,
    leafy_branches::propose,
    pinnate::propose,
    leaf_loops::propose,
    stem_loops::propose,
    stem_arcs::propose,
    strap::propose,
    double_stem::propose,
    potted_stem::propose,
    above_pot::propose,
    grass::propose,
    lawn::propose,
    fronds::propose,
    tuft::propose,
];

/// What is proposed for a drawing, by the places of its strokes.
fn proposals(known: &mut Memory, strokes: &[Arc<Stroke>], corrections: &[Correction]) -> Vec<Hypothesis> {
    let alone = |page: &mut Page, strokes: &[Arc<Stroke>], corrections: &[Correction]| {
        let corrected = Corrected::on(page, strokes, corrections);
        proposed(&mut plants::Proposals::for_one_call(), page, strokes, &corrected)
    };
    meadow::proposals(&mut known.meadow, strokes, corrections, alone).unwrap_or_else(|| {
        let page = Page::with(&mut known.drawn, strokes);
        let drawn = Redrawn::untouched(strokes);
        match restated(&page, strokes, corrections) {
            None => proposed_of_lines(known, page, (&drawn, strokes), corrections),
            Some(restated) => {
                let page = Page::with(&mut known.restated.shapes, &restated.strokes);
                restated.by_members(proposed_of_lines(known, page, (&restated, strokes), corrections))
            }
        }
    })
}

/// The drawing with strokes over one another made one line, but for those of which the artist said otherwise.
fn restated(page: &Page, strokes: &[Arc<Stroke>], corrections: &[Correction]) -> Option<Redrawn> {
    let is_apart = |correction: &Correction, stroke: StrokeId| {
        matches!(correction.verdict, Verdict::Separate | Verdict::Not(Reading::Line))
            && correction.strokes.contains(&stroke)
    };
    lines::restated(page, strokes, |stroke| corrections.iter().all(|it| !is_apart(it, strokes[stroke].id)))
}

/// What is proposed for the lines of a page and for those that continue each other as one line, by the lines' places among all that
/// stand for the drawn strokes.
fn proposed_of_lines(
    known: &mut Memory,
    mut page: Page,
    (lines, drawn): (&Redrawn, &[Arc<Stroke>]),
    corrections: &[Correction],
) -> Vec<Hypothesis> {
    let names = |line: usize| -> Vec<StrokeId> {
        lines.members[line].iter().map(|stroke| drawn[*stroke].id).collect()
    };
    let corrected = Corrected::on_lines(&page, corrections, names);
    let chains = Chains::of(&mut known.chains, &page, &lines.strokes);
    let mut found = proposed(&mut known.restated.plants, &mut page, &lines.strokes, &corrected);
    let mut again = lines.as_lines(&page);
    corrected.apply(&mut again);
    found.append(&mut again);
    let mut all = page.by_strokes(found);
    if let Some(chains) = chains.filter(|chains| !chains.are_explained_by(&all)) {
        let joined = &chains.redrawn;
        let mut page = Page::with(&mut known.joined.shapes, &joined.strokes);
        let names = |line: usize| joined.members[line].iter().flat_map(|line| names(*line)).collect();
        let corrected = Corrected::on_lines(&page, corrections, names);
        let found = proposed(&mut known.joined.plants, &mut page, &joined.strokes, &corrected);
        chains.add(&mut all, page.by_strokes(found));
    }
    all
}

/// What hangs in the air and what is written, set apart before the drawing is looked at as a whole.
fn set_strange_apart(page: &mut Page, corrected: &Corrected) -> Vec<Hypothesis> {
    let mut all = Vec::new();
    writing::propose(page, &mut all);
    page.set_apart(used(&all));
    aloft::propose(page, &mut all);
    corrected.apply(&mut all);
    all.retain(|apart| apart.score > 0.0);
    page.set_apart(used(&all));
    all
}

/// All lines that are explained.
fn used(all: &[Hypothesis]) -> BTreeSet<usize> {
    all.iter().flat_map(|hypothesis| hypothesis.uses.iter().copied()).collect()
}

/// What every convention proposes for a page, by its lines, as far as the corrections leave it.
fn proposed(
    known: &mut plants::Proposals,
    page: &mut Page,
    strokes: &[Arc<Stroke>],
    corrected: &Corrected,
) -> Vec<Hypothesis> {
    let mut all = set_strange_apart(page, corrected);
    let looks = Looks::of(page);
    for propose in BENEATH {
        let known = all.len();
        propose(page, &mut all);
        let mut new = all.split_off(known);
        if let Some(looks) = &looks {
            looks.weigh(page, &mut new);
            looks.propose_pot(page, &all, &mut new);
        }
        corrected.apply(&mut new);
        new.retain(|beneath| beneath.score > 0.0);
        all.append(&mut new);
        // What stands in a pot or on the ground is looked at without it.
        page.set_apart(used(&all));
    }
    let ground = all.iter().find(|beneath| beneath.reading == Reading::Ground).map(|ground| ground.uses[0]);
    let alone = plants::small(page, ground.map(|line| &page.lines[line]));
    let is_garden = looks.as_ref().is_some_and(Looks::is_garden);
    let of_small = |page: &Page| {
        let (looks, mut all) = (Looks::of(page), proposed_above(page, &[]));
        if let Some(looks) = looks {
            looks.weigh(page, &mut all);
            if is_garden {
                looks.propose(page, &mut all);
            }
        }
        all
    };
    let mut new = plants::proposed(known, &alone, (page, strokes), of_small);
    new.extend(as_it_looks(page, looks.as_ref(), proposed_above(page, &all)));
    corrected.apply(&mut new);
    all.append(&mut new);
    all
}

/// What is proposed for a page with what it looks like taken into account.
fn as_it_looks(page: &Page, looks: Option<&Looks>, mut all: Vec<Hypothesis>) -> Vec<Hypothesis> {
    if let Some(looks) = looks {
        looks.weigh(page, &mut all);
        looks.propose(page, &mut all);
    }
    all
}

/// What all other conventions propose, which know what lies beneath; each by itself, on as many threads as there are.
fn proposed_above(page: &Page, beneath: &[Hypothesis]) -> Vec<Hypothesis> {
    let by = |propose: &Propose| {
        let mut all = beneath.to_vec();
        propose(page, &mut all);
        all.split_off(beneath.len())
    };
    let found: Vec<Vec<Hypothesis>> = CONVENTIONS.par_iter().with_max_len(1).map(by).collect();
    let mut found: Vec<Hypothesis> = found.into_iter().flatten().collect();
    found.extend(in_blossom::without_flowers(&found));
    found
}
