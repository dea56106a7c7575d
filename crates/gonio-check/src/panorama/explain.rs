//! Finds the mistakes in six faces: those with all faces by hypotheses of the catalogue, those with single faces by
//! their orientation.

use super::tiles::{Fit, Tiles, Tolerance, WAYS};
use crate::comparison::SourceSupport;
use crate::mistakes::faces::{FACES, swapped_id, turned_id};
use crate::mistakes::{Hypotheses, Hypothesis};
use gonio_gl::GlError;

/// The parameters of the search.
pub struct FaceTask<'a> {
    /// The hypotheses of the model solution.
    pub hypotheses: &'a Hypotheses,
    /// The tolerance of the comparison.
    pub tolerance: Tolerance,
    /// The support of the source, used if the pictures do not decide.
    pub source_support: &'a SourceSupport,
}

/// Draws the faces under a hypothesis.
pub type Predict<'a> = dyn FnMut(&Hypothesis) -> Result<Tiles, GlError> + 'a;

/// For each picture, the face that it shows and its orientation; `None` if it resembles no face.
pub type Placed = [Option<(usize, usize)>; 6];

const AS_IT_SHOULD: Placed = [Some((0, 0)), Some((1, 0)), Some((2, 0)), Some((3, 0)), Some((4, 0)), Some((5, 0))];

/// The result of the search.
#[derive(Clone, Debug)]
pub struct Explanation {
    /// Ids of mistakes with all faces.
    pub global: Vec<String>,
    /// Ids of mistakes with single faces.
    pub local: Vec<String>,
    /// Ids of mistakes that explain the pictures equally well.
    pub or: Vec<String>,
    /// Faces that nothing explains.
    pub unexplained: Vec<usize>,
    /// The comparison of each face with the expected one.
    pub fits: [Fit; 6],
    /// The expected picture.
    pub reference: Tiles,
    /// The picture that the explanation predicts.
    pub predicted: Tiles,
}

impl Explanation {
    /// Finds the explanation with the fewest mistakes.
    pub fn find(task: &FaceTask<'_>, seen: &Tiles, predict: &mut Predict<'_>) -> Result<Self, GlError> {
        let reference = predict(&Hypothesis::default())?;
        let fits = std::array::from_fn(|face| seen.fit(face, &reference, face, 0, task.tolerance));
        let mut found = Explanation {
            global: Vec::new(),
            local: Vec::new(),
            or: Vec::new(),
            unexplained: Vec::new(),
            fits,
            predicted: reference.clone(),
            reference,
        };
        let search = Search { task, seen };
        let plain = search.place(&found.reference);
        if plain == AS_IT_SHOULD {
            return Ok(found);
        }
        if seen.are_all_equal(task.tolerance) {
            found.global = vec!["face-ignored".to_owned()];
            found.predicted = seen.clone();
            return Ok(found);
        }
        let mut candidates = vec![Candidate::new(Hypothesis::default(), plain, &found.reference)];
        let singles: Vec<&Hypothesis> = search.of_all_faces().collect();
        let mut drawn = Vec::new();
        for single in &singles {
            drawn.push(predict(single)?);
        }
        for (single, tiles) in singles.iter().zip(&drawn) {
            if search.is_whole(tiles) {
                candidates.push(Candidate::new((*single).clone(), AS_IT_SHOULD, tiles));
            }
        }
        if candidates.iter().all(|candidate| candidate.cost() > 1) {
            // One hypothesis with faces in other orientations, or two hypotheses.
            for (single, tiles) in singles.iter().zip(&drawn) {
                candidates.push(Candidate::new((*single).clone(), search.place(tiles), tiles));
            }
        }
        if candidates.iter().all(|candidate| candidate.cost() > 2) {
            for (at, one) in singles.iter().enumerate() {
                let others = singles.iter().skip(at + 1).filter(|other| other.mistakes != one.mistakes);
                for both in others.filter_map(|other| one.and(other)) {
                    let tiles = predict(&both)?;
                    if search.is_whole(&tiles) {
                        candidates.push(Candidate::new(both, AS_IT_SHOULD, &tiles));
                    }
                }
            }
        }
        search.choose(candidates, &mut found);
        Ok(found)
    }

    /// Whether all faces are right.
    pub fn is_right(&self) -> bool {
        self.global.is_empty() && self.local.is_empty() && self.unexplained.is_empty()
    }
}

/// An explanation that was tried.
struct Candidate {
    hypothesis: Hypothesis,
    placed: Placed,
    tiles: Tiles,
}

impl Candidate {
    fn new(hypothesis: Hypothesis, placed: Placed, tiles: &Tiles) -> Self {
        Candidate { hypothesis, placed, tiles: tiles.clone() }
    }

    /// Returns the number of mistakes, with a much higher cost for faces that resemble none.
    fn cost(&self) -> usize {
        let unexplained = self.placed.iter().filter(|placed| placed.is_none()).count();
        self.hypothesis.mistakes.len() + local(&self.placed).len() + 10 * unexplained
    }
}

/// Returns the ids of the mistakes with single faces.
fn local(placed: &Placed) -> Vec<String> {
    let mut ids = Vec::new();
    let moved: Vec<usize> = (0..6).filter(|&face| placed[face].is_some_and(|(of, _)| of != face)).collect();
    for &face in &moved {
        let Some((of, _)) = placed[face] else { continue };
        let is_swapped = placed[of].is_some_and(|(back, _)| back == face);
        if is_swapped && face < of {
            ids.push(swapped_id(face, of));
        } else if !is_swapped {
            // A face with the picture of another, or a cycle of three or more.
            ids.push(format!("face-{}-shows-{}", FACES[face].0, FACES[of].0));
        }
    }
    for (face, placed) in placed.iter().enumerate() {
        if let Some((_, way @ 1..)) = placed {
            ids.push(turned_id(face, way - 1));
        }
    }
    ids
}

struct Search<'a> {
    task: &'a FaceTask<'a>,
    seen: &'a Tiles,
}

impl<'a> Search<'a> {
    /// Returns the hypotheses about all faces at once.
    fn of_all_faces(&self) -> impl Iterator<Item = &'a Hypothesis> {
        let hypotheses = self.task.hypotheses;
        hypotheses.singles.iter().filter(move |single| {
            let variables = single.choices.keys().map(|line| hypotheses.variables[*line].as_str());
            let is_of_a_face = |variable: &str| FACES.iter().any(|(word, _)| *word == variable);
            let is_ignored = single.mistakes.iter().any(|&m| hypotheses.mistakes[m].id == "face-ignored");
            !variables.into_iter().any(is_of_a_face) && !is_ignored
        })
    }

    fn fits(&self, fit: &Fit) -> bool {
        fit.beyond <= self.task.tolerance.share
    }

    fn is_whole(&self, tiles: &Tiles) -> bool {
        (0..6).all(|face| self.fits(&self.seen.fit(face, tiles, face, 0, self.task.tolerance)))
            && self.place(tiles) == AS_IT_SHOULD
    }

    /// Identifies each picture. The expected face and orientation win unless another is clearly better.
    fn place(&self, tiles: &Tiles) -> Placed {
        std::array::from_fn(|face| {
            let fit = |of: usize, way: usize| self.seen.fit(face, tiles, of, way, self.task.tolerance);
            let all = (0..6).flat_map(|of| (0..WAYS).map(move |way| (of, way)));
            let mut fitting: Vec<((usize, usize), Fit)> =
                all.map(|(of, way)| ((of, way), fit(of, way))).filter(|(_, fit)| self.fits(fit)).collect();
            let best = fitting.iter().map(|(_, fit)| fit.square).fold(f64::INFINITY, f64::min);
            // Differences within rounding are ignored.
            fitting.retain(|(_, fit)| fit.square <= 1.5 * best + 1e-6);
            let rank = |(of, way): &(usize, usize)| (*of != face, *way != 0, *of, *way);
            fitting.into_iter().map(|(place, _)| place).min_by_key(rank)
        })
    }

    /// Takes the explanation with the fewest mistakes; among equals, the one that the source supports most.
    fn choose(&self, candidates: Vec<Candidate>, found: &mut Explanation) {
        let Some(least) = candidates.iter().map(Candidate::cost).min() else { return };
        let ids = |candidate: &Candidate| -> Vec<String> {
            let mistakes = candidate.hypothesis.mistakes.iter();
            mistakes.map(|&m| self.task.hypotheses.mistakes[m].id.clone()).collect()
        };
        let support = |candidate: &Candidate| -> f32 {
            let ids = ids(candidate);
            let sum: f32 = ids.iter().map(|id| (self.task.source_support)(id)).sum();
            // The source has no evidence about single faces.
            if ids.is_empty() { 0.5 } else { sum / ids.len() as f32 }
        };
        let mut equal: Vec<&Candidate> = candidates.iter().filter(|candidate| candidate.cost() == least).collect();
        // The sort is stable: without evidence in the source, the order of the catalogue remains.
        equal.sort_by(|a, b| support(b).total_cmp(&support(a)));
        let Some(best) = equal.first() else { return };
        found.global = ids(best);
        found.local = local(&best.placed);
        found.unexplained = (0..6).filter(|&face| best.placed[face].is_none()).collect();
        found.predicted = best.tiles.rearranged(&best.placed);
        if let ([only], true) = (found.global.as_slice(), found.local.is_empty()) {
            let others = equal.iter().skip(1).flat_map(|other| ids(other));
            found.or = others.filter(|id| id != only).collect();
            found.or.dedup();
        }
    }
}
