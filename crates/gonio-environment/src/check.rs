//! Certifies six faces: do the twelve edges meet, and if not, which faces are mirrored, turned or swapped?
//!
//! Edges do not show everything: the two layouts of faces have the same edges, and so have a world, its mirror image
//! and the world turned as a whole. Of all arrangements that fit, the one that changes the fewest faces is proposed. A
//! face along whose edges nothing changes fits in any orientation.

use crate::EnvironmentError;
use crate::cubemap::check_sizes;
use crate::face::{Face, Layout};
use crate::placement::{AS_GIVEN, Cube, Placements, differing, parts};
use crate::repair::Repair;
use crate::seams::{MISFIT_MAX, Seams};
use gonio_image::Image;

/// Arrangements fit equally well whose misfits differ by less than this part: five standard deviations of what noise
/// does to four of twelve edges with 128 samples each.
const RELATIVE: f64 = 0.15;

/// And by less than this: a tenth of the misfit of one edge that is right, for each of the twelve.
const ABSOLUTE: f64 = 0.6;

/// An edge meets whose misfit is below this: its difference is then up to 3.5 times that of the rows beside it.
/// Pictures that do not belong together have far more, and compression of pictures rarely as much.
const MEETS: f64 = 6.0;

/// One of the twelve edges, as the files were given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// The two faces that share it.
    pub faces: (Face, Face),
    /// Root mean square of the difference across the edge, in stops.
    pub across: f64,
    /// The same between the two outermost rows inside the faces: across a good edge it is as large.
    pub inside: f64,
    /// Whether the picture continues across it.
    pub meets: bool,
}

impl Edge {
    /// `across / inside`, near 1 where there is no seam; differences of a hundredth of a stop count as none.
    pub fn ratio(&self) -> f64 {
        self.across.max(0.01) / self.inside.max(0.01)
    }
}

/// The fit of six faces, by their edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaceFit {
    /// The faces fit as they are.
    Fits,
    /// The faces fit in another arrangement.
    Misplaced,
    /// The edges meet in no arrangement: the faces are not one continuous picture.
    NeverMeets,
    /// Too little changes along the edges to decide.
    TooPlain,
}

/// The result of [`check`].
#[derive(Clone, Debug, PartialEq)]
pub struct Certificate {
    /// The layout given by the caller. Edges cannot confirm it.
    pub layout: Layout,
    /// The twelve edges as given.
    pub edges: Vec<Edge>,
    /// The fit of the faces.
    pub fit: FaceFit,
    /// The repair; nothing unless the fit is [`FaceFit::Misplaced`].
    pub repair: Repair,
    /// Repairs that fit equally well: those that leave the same world turned as a whole and change as few faces, and
    /// last the one that leaves its mirror image (the right one if text is reversed after `repair`). Empty unless the
    /// fit is [`FaceFit::Misplaced`].
    pub alternatives: Vec<Repair>,
    /// Faces that fit in other orientations too, because nothing changes along their edges.
    pub undecided: Vec<Face>,
    /// The misfit of the next best arrangement that moves a decided face, divided by that of the repaired one: above
    /// 1.15; the larger, the more certain.
    pub margin: f64,
}

/// Checks six pictures, in the order of [`Face::ALL`] by their names, in the given layout.
///
/// # Errors
///
/// Pictures that are not square, or not of one size. Takes a few milliseconds, up to a tenth of a second where nothing
/// fits.
pub fn check(faces: &[Image; 6], layout: Layout) -> Result<Certificate, EnvironmentError> {
    check_sizes(faces)?;
    let (seams, cube) = (Seams::new(faces), Cube::new());
    let edges: Vec<Edge> = cube
        .edges
        .iter()
        .zip(cube.misfits(&seams, &AS_GIVEN))
        .map(|(&(a, side_a, b, side_b), misfit)| {
            let (across, inside) = seams.differences(4 * a + side_a, 4 * b + side_b);
            Edge { faces: (Face::ALL[a], Face::ALL[b]), across, inside, meets: misfit < MEETS }
        })
        .collect();
    let plain = |fit, undecided| Certificate {
        layout,
        edges: edges.clone(),
        fit,
        repair: Repair::nothing(),
        alternatives: Vec::new(),
        undecided,
        margin: 1.0,
    };
    let (lowest, fitting) = cube.search(&seams, RELATIVE, ABSOLUTE);
    let Some(fitting) = fitting else {
        // Whatever is done fits as well: because every edge fits every other, or because none fits any.
        let fit = if lowest > 12.0 * MEETS { FaceFit::NeverMeets } else { FaceFit::TooPlain };
        return Ok(plain(fit, Face::ALL.to_vec()));
    };
    let aligned = fitting.iter().map(|a| cube.aligned(a, &AS_GIVEN));
    let chosen = aligned
        .min_by(|a, b| key(a).cmp(&key(b)).then_with(|| cube.misfit(&seams, a).total_cmp(&cube.misfit(&seams, b))));
    let chosen = chosen.unwrap_or(AS_GIVEN);
    let mut is_undecided = [false; 6];
    for arrangement in &fitting {
        let there = cube.aligned(arrangement, &chosen);
        for (file, (p, q)) in there.iter().zip(&chosen).enumerate() {
            is_undecided[file] |= p != q;
        }
    }
    let undecided: Vec<Face> = Face::ALL.into_iter().filter(|f| is_undecided[*f as usize]).collect();
    let meeting = cube.misfits(&seams, &chosen).filter(|m| *m < MEETS).count();
    if meeting < 6 {
        return Ok(plain(FaceFit::NeverMeets, undecided));
    }
    if undecided.len() == 6 {
        return Ok(plain(FaceFit::TooPlain, undecided));
    }
    let margin = rival(&cube, &seams, &chosen, &is_undecided) / cube.misfit(&seams, &chosen).max(ABSOLUTE);
    let repair = Repair::from_placements(&chosen);
    let alternatives = if repair.is_nothing() { Vec::new() } else { alternatives(&cube, &chosen) };
    let fit = if repair.is_nothing() { FaceFit::Fits } else { FaceFit::Misplaced };
    Ok(Certificate { layout, edges, fit, repair, alternatives, undecided, margin })
}

/// The extent of an arrangement's changes: the fewest faces, of them the fewest mirrored, then the fewest moved and
/// turned.
fn key(arrangement: &Placements) -> (usize, usize, usize, usize) {
    let count =
        |is: fn(usize, usize) -> bool| arrangement.iter().enumerate().filter(|(file, p)| is(*file, **p)).count();
    (
        differing(arrangement, &AS_GIVEN),
        count(|_, p| parts(p).1),
        count(|file, p| parts(p).0 != file),
        count(|_, p| parts(p).2 != 0),
    )
}

/// The same world turned as a whole, where that changes as little, and its mirror image.
fn alternatives(cube: &Cube, chosen: &Placements) -> Vec<Repair> {
    let turned = (0..48).filter(|&s| !cube.mirrors[s]).map(|s| cube.moved(s, chosen));
    let mut others: Vec<Placements> = turned.filter(|a| a != chosen && key(a) == key(chosen)).collect();
    let mirrored = (0..48).filter(|&s| cube.mirrors[s]).map(|s| cube.moved(s, chosen));
    others.extend(mirrored.min_by_key(key));
    others.iter().map(Repair::from_placements).collect()
}

/// The lowest misfit of arrangements with one face turned or mirrored, or two swapped in whatever way, that are not all
/// undecided.
fn rival(cube: &Cube, seams: &Seams, chosen: &Placements, undecided: &[bool; 6]) -> f64 {
    let mut lowest = 12.0 * MISFIT_MAX;
    let mut consider = |a: Placements| lowest = f64::min(lowest, cube.misfit(seams, &a));
    for a in 0..6 {
        for b in a..6 {
            if undecided[a] && undecided[b] {
                continue;
            }
            for ways in 0..64 {
                let (way_a, way_b) = (ways % 8, ways / 8);
                let mut other = *chosen;
                other[a] = 8 * (chosen[b] / 8) + (chosen[b] % 8 + way_a) % 8;
                other[b] = 8 * (chosen[a] / 8) + (chosen[a] % 8 + way_b) % 8;
                if other != *chosen {
                    consider(other);
                }
            }
        }
    }
    lowest
}

impl Certificate {
    /// Describes the result in sentences without final full stop: first the faults, then the limits of the check.
    pub fn sentences(&self) -> Vec<String> {
        let open = self.edges.iter().filter(|e| !e.meets).count();
        let mut sentences = match self.fit {
            FaceFit::Fits => vec![format!("{} of the twelve edges meet", 12 - open)],
            FaceFit::Misplaced => self.repair.sentences(),
            FaceFit::NeverMeets => vec![format!(
                "{open} of the twelve edges do not meet, and no other arrangement is better: the faces are not one \
                 continuous picture, or have a border"
            )],
            FaceFit::TooPlain => vec![format!(
                "the edges change too little to show how the faces belong together; {open} of the twelve do not meet"
            )],
        };
        if let Some((mirrored, turned)) = self.alternatives.split_last() {
            for other in turned {
                sentences.push(format!(
                    "alternatively: {}; the edges fit equally well, and the world is the same, turned",
                    other.sentences().join("; ")
                ));
            }
            sentences.push(format!(
                "if text is reversed after the repair: {}; the edges of the mirrored world fit equally well",
                mirrored.sentences().join("; ")
            ));
        }
        if matches!(self.fit, FaceFit::Fits | FaceFit::Misplaced) {
            for edge in self.still_open() {
                let (a, b) = (edge.faces.0.name(), edge.faces.1.name());
                sentences.push(format!(
                    "the seam between `{a}` and `{b}` is visible: it differs by {:.2} stops, the rows beside it by {:.2}",
                    edge.across, edge.inside
                ));
            }
            if !self.undecided.is_empty() {
                let names: Vec<String> = self.undecided.iter().map(|f| format!("`{}`", f.name())).collect();
                let names = names.join(", ");
                sentences.push(format!("the edges of {names} change too little to show how the picture is oriented"));
            }
            sentences.push(format!(
                "edges do not show whether the layout is `{}`, nor whether the whole world is mirrored or turned",
                self.layout
            ));
        }
        sentences
    }

    /// Edges that do not meet although nothing is misplaced.
    fn still_open(&self) -> impl Iterator<Item = &Edge> {
        self.edges.iter().filter(|e| self.fit == FaceFit::Fits && !e.meets)
    }
}
