//! The sections of the gallery. A new technique adds a file here, and a line to `SECTIONS`.

mod beyond;
mod brdfs;
mod cubemaps;
mod environments;
mod lights;
mod many_lights;
mod refraction;
mod shading;
mod specular;
mod terms;
mod textures;
mod views;

use crate::GalleryError;
use crate::exhibit::Section;

type Maker = fn() -> Result<Section, GalleryError>;

/// In the order of the sheet.
const SECTIONS: [Maker; 14] = [
    terms::whole_section,
    shading::section,
    terms::section,
    lights::section,
    specular::section,
    brdfs::section,
    views::section,
    shading::cost_section,
    textures::section,
    environments::section,
    refraction::section,
    cubemaps::section,
    many_lights::section,
    beyond::section,
];

/// Those whose pictures are scenes. The others are not even named here, so that a program that shows scenes alone does not
/// contain the stations beyond the rendering equation.
const SECTIONS_OF_SCENES: [Maker; 12] = [
    terms::whole_section,
    shading::section,
    terms::section,
    lights::section,
    specular::section,
    brdfs::section,
    views::section,
    shading::cost_section,
    textures::section,
    environments::section,
    refraction::section,
    many_lights::section,
];

/// Returns all sections in the order of the contact sheet.
///
/// # Errors
///
/// A built-in scene that cannot be read.
pub fn all() -> Result<Vec<Section>, GalleryError> {
    SECTIONS.iter().map(|make| make()).collect()
}

/// Returns the sections whose pictures are scenes, with those pictures only.
///
/// # Errors
///
/// A built-in scene that cannot be read.
pub fn of_scenes() -> Result<Vec<Section>, GalleryError> {
    SECTIONS_OF_SCENES.iter().map(|make| make()).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::exhibit::BaseScene;
    use crate::exhibit::ExhibitSubject;
    use std::collections::HashSet;
    use std::path::Path;

    #[test]
    fn every_exhibit_is_complete_and_its_scene_loads() {
        let sections = all().unwrap();
        let mut names = HashSet::new();
        let mut count = 0;
        for exhibit in sections.iter().flat_map(|s| s.rows.iter().flatten()) {
            let name = &exhibit.name;
            count += 1;
            assert!(names.insert(name.clone()), "{name} twice");
            assert!(name.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-'), "{name}");
            assert!(!exhibit.caption.is_empty() && !exhibit.equation.is_empty(), "{name}");
            assert!(exhibit.look.ends_with('.'), "{name}: {}", exhibit.look);
            assert_eq!(exhibit.remark.is_empty(), exhibit.counts_as_remark, "{name}");
            let ExhibitSubject::Scene(scene) = &exhibit.subject else { continue };
            // Only built-in files, so that it works in any folder.
            let files = gonio_scene::files::BuiltinOnly;
            let loaded = gonio_scene::load::load((**scene).clone(), Path::new(""), &files).unwrap();
            assert!(loaded.diagnostics.is_empty(), "{name}: {:?}", loaded.diagnostics);
        }
        assert!(count >= 105, "{count}");
    }

    #[test]
    fn the_sections_of_scenes_have_every_scene_and_nothing_else() {
        let names = |sections: Vec<Section>| -> Vec<String> {
            let exhibits = sections.into_iter().flat_map(|section| section.rows.into_iter().flatten());
            exhibits.filter(|exhibit| exhibit.scene().is_some()).map(|exhibit| exhibit.name).collect()
        };
        let of_scenes = of_scenes().unwrap();
        assert!(of_scenes.iter().flat_map(|s| s.rows.iter().flatten()).all(|exhibit| exhibit.scene().is_some()));
        assert_eq!(names(of_scenes), names(all().unwrap()));
    }

    #[test]
    fn every_base_scene_reads() {
        for base in BaseScene::ALL {
            assert!(!base.scene().unwrap().lights.is_empty(), "{base:?}");
        }
    }
}
