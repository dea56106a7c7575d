//! The most telling pictures of a submission, for a table of many.

use super::picture::{PictureKind, Pictures};
use gonio_check::comparison::Evidence;
use gonio_check::verdict::{SceneVerdict, Verdict};
use serde::{Deserialize, Serialize};

/// The picture of one test scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SubmissionThumbnail {
    /// The test scene.
    pub scene: String,
    /// The submission's picture, as the address of an `img`.
    pub yours: String,
    /// The correct picture, if the other one is wrong.
    pub reference: Option<String>,
    /// The share of pixels that differ, 0 to 1.
    pub pixels_beyond: f64,
}

impl SubmissionThumbnail {
    /// The picture of the test scene in which most pixels differ; that of the first scene if all are right. `None` if nothing
    /// was drawn.
    pub fn new(verdict: &Verdict, evidence: &Evidence) -> Option<Self> {
        let pictures = Pictures::new(evidence, verdict);
        let is_drawn = |scene: &&SceneVerdict| pictures.find(&scene.scene, PictureKind::Yours).is_some();
        // `max_by` would return the last of several.
        let differs = |scene: &SceneVerdict| if scene.right { 0.0 } else { finite(scene.pixels_beyond) };
        let most = verdict.scenes.iter().filter(is_drawn).reduce(|most, scene| {
            let is_more = (!scene.right, differs(scene)) > (!most.right, differs(most));
            if is_more { scene } else { most }
        })?;
        let uri = |kind| pictures.find(&most.scene, kind).map(|picture| picture.data_uri());
        Some(SubmissionThumbnail {
            scene: most.scene.clone(),
            yours: uri(PictureKind::Yours)?,
            reference: uri(PictureKind::Reference).filter(|_| !most.right),
            pixels_beyond: differs(most),
        })
    }
}

/// A share without NaN and infinity, which JSON lacks.
fn finite(share: f64) -> f64 {
    if share.is_finite() { share.clamp(0.0, 1.0) } else { 1.0 }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use gonio_check::testbench::{Atlas, TILE};
    use gonio_check::verdict::Outcome;

    #[test]
    fn the_scene_that_differs_most_is_shown() {
        let size = (TILE * TILE) as usize;
        let flat = |grey: f32| Atlas { pixels: vec![[grey, grey, grey, 1.0]; 4 * size] };
        let scenes: Vec<String> = ["a", "b", "c", "d"].map(str::to_owned).into();
        let evidence = Evidence { seen: flat(0.2), reference: flat(0.8), predicted: None, scenes: scenes.clone() };
        let mut verdict = Verdict::new("ex04", Outcome::Wrong, "");
        let scene = |name: &String, right, pixels_beyond| SceneVerdict {
            scene: name.clone(),
            shows: "".into(),
            right,
            pixels_beyond,
            worst: 0.5,
        };
        let shares = [(true, 0.9), (false, 0.25), (false, 0.5), (false, 0.5)];
        verdict.scenes = scenes.iter().zip(shares).map(|(name, (right, share))| scene(name, right, share)).collect();
        let thumbnail = SubmissionThumbnail::new(&verdict, &evidence).unwrap();
        assert_eq!((thumbnail.scene.as_str(), thumbnail.pixels_beyond), ("c", 0.5));
        assert!(thumbnail.reference.is_some_and(|reference| reference != thumbnail.yours));
        verdict.scenes[1].pixels_beyond = f64::NAN;
        assert_eq!(SubmissionThumbnail::new(&verdict, &evidence).unwrap().pixels_beyond, 1.0);
        verdict.scenes.truncate(1);
        let right = SubmissionThumbnail::new(&verdict, &evidence).unwrap();
        assert_eq!((right.scene.as_str(), right.pixels_beyond, right.reference), ("a", 0.0, None));
        verdict.scenes.clear();
        assert_eq!(SubmissionThumbnail::new(&verdict, &evidence), None);
    }
}
