//! The orientation of an environment that was read: the finding in sentences, and the repaired environment.

use crate::environment_file::{EnvironmentMap, OpenedEnvironment};
use gonio_environment::arrange::Arrangement;
use gonio_environment::check::{self, Certificate, FaceFit};
use gonio_environment::check_panorama::{PanoramaCertificate, check_panorama};
use gonio_environment::{Cubemap, EnvironmentError};

/// The result of the check of faces or of a panorama.
#[derive(Clone, Debug, PartialEq)]
pub enum EnvironmentFinding {
    /// The fit of six faces.
    Faces(Box<Certificate>),
    /// The seams of a panorama.
    Panorama(PanoramaCertificate),
}

impl EnvironmentFinding {
    /// Checks the environment.
    ///
    /// # Errors
    ///
    /// Those of [`check::check`].
    pub fn of(opened: &OpenedEnvironment) -> Result<Self, EnvironmentError> {
        match &opened.map {
            EnvironmentMap::Cubemap(map) => {
                let layout = opened.layout.unwrap_or_default();
                Ok(EnvironmentFinding::Faces(Box::new(check::check(&map.faces(layout), layout)?)))
            }
            EnvironmentMap::Panorama(panorama) => Ok(EnvironmentFinding::Panorama(check_panorama(panorama))),
        }
    }

    /// Whether nothing is wrong.
    pub fn fits(&self) -> bool {
        match self {
            EnvironmentFinding::Faces(found) => matches!(found.fit, FaceFit::Fits | FaceFit::TooPlain),
            EnvironmentFinding::Panorama(found) => found.closes() && !found.is_turned,
        }
    }

    /// Whether something is wrong that [`Self::repaired`] repairs.
    pub fn is_repairable(&self) -> bool {
        match self {
            EnvironmentFinding::Faces(found) => found.fit == FaceFit::Misplaced,
            EnvironmentFinding::Panorama(found) => found.is_turned,
        }
    }

    /// The finding in sentences without final full stop: first the faults, then the limits of the check.
    pub fn sentences(&self) -> Vec<String> {
        match self {
            EnvironmentFinding::Faces(found) => found.sentences(),
            EnvironmentFinding::Panorama(found) => found.sentences(),
        }
    }

    /// The repaired environment; the same where nothing is wrong. No texel changes but its place.
    ///
    /// # Errors
    ///
    /// Faces that match in no arrangement, and a panorama that does not close.
    pub fn repaired(&self, opened: &OpenedEnvironment) -> Result<EnvironmentMap, EnvironmentError> {
        match (self, &opened.map) {
            (EnvironmentFinding::Faces(found), EnvironmentMap::Cubemap(map)) => {
                if found.fit == FaceFit::NeverMeets {
                    return Err(EnvironmentError::new(
                        "the faces match in no arrangement, so there is no repair to write",
                    ));
                }
                let layout = opened.layout.unwrap_or_default();
                let faces = found.repair.apply(&map.faces(layout));
                Ok(EnvironmentMap::Cubemap(Cubemap::from_faces(faces, layout)?))
            }
            (EnvironmentFinding::Panorama(found), EnvironmentMap::Panorama(panorama)) => {
                if found.is_turned {
                    return Ok(EnvironmentMap::Panorama(panorama.turned_back()));
                }
                if found.closes() {
                    return Ok(EnvironmentMap::Panorama(panorama.clone()));
                }
                Err(EnvironmentError::new(
                    "the panorama does not close; what is missing cannot be repaired, so nothing is written",
                ))
            }
            _ => Err(EnvironmentError::new("there is nothing to repair")),
        }
    }
}

impl OpenedEnvironment {
    /// Form, size and layout: `a panorama of 1024 x 512`.
    pub fn description(&self) -> String {
        let layout = self.layout.map_or(String::new(), |layout| format!(", {layout} layout"));
        match (&self.map, self.arrangement) {
            (EnvironmentMap::Panorama(panorama), _) => {
                format!("a panorama of {} x {}", panorama.image.width, panorama.image.height)
            }
            (EnvironmentMap::Cubemap(map), Arrangement::Faces) if self.files.len() == 1 => {
                format!("a cubemap of {0} x {0}{layout}", map.size())
            }
            (EnvironmentMap::Cubemap(map), Arrangement::Faces) => {
                format!("six faces of {0} x {0}{layout}", map.size())
            }
            (EnvironmentMap::Cubemap(map), arrangement) => {
                format!("a {arrangement} of faces of {0} x {0}{layout}", map.size())
            }
        }
    }
}
