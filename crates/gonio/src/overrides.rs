//! Replacing values of a scene by the options of the command line.

use crate::cli::SceneOptions;
use crate::values::BackgroundValue;
use gonio_scene::SceneFile;
use gonio_scene::scene_file::{CameraSpec, MaterialOverride};

impl SceneOptions {
    /// Replaces values of `scene` by those of the options; values of objects are set on all of them.
    pub fn apply(&self, scene: &mut SceneFile) {
        self.apply_to_objects(scene);
        self.apply_to_equation(scene);
        self.apply_to_camera(scene);
        self.apply_to_picture(scene);
        self.surroundings.apply(scene);
        if !self.light.is_empty() {
            scene.lights.clone_from(&self.light);
        }
    }

    fn apply_to_objects(&self, scene: &mut SceneFile) {
        for object in &mut scene.objects {
            set(&mut object.shading, self.shading);
            set(&mut object.normals, self.normals);
            object.crease_angle = self.crease_angle.or(object.crease_angle);
            if let Some(material) = &self.material {
                merge_material(&mut object.material, material);
            }
        }
    }

    fn apply_to_equation(&self, scene: &mut SceneFile) {
        let equation = &mut scene.equation;
        set(&mut equation.convention, self.convention);
        set(&mut equation.specular, self.specular);
        equation.brdf = self.brdf.or(equation.brdf);
        equation.brdf_normalised |= self.brdf_normalised;
        equation.cosine_weighted = self.cosine_weighted.or(equation.cosine_weighted);
        equation.gated &= !self.ungated;
        equation.two_sided = (equation.two_sided || self.two_sided) && !self.one_sided;
        for term in &self.without {
            let switch = match term.as_str() {
                "ambient" => &mut equation.ambient,
                "emitted" => &mut equation.emitted,
                "diffuse" => &mut equation.diffuse,
                "specular" => &mut equation.specular_term,
                "attenuation" => &mut equation.attenuation,
                "spot" => &mut equation.spot,
                // The option's parser accepts no other name.
                _ => continue,
            };
            *switch = false;
        }
    }

    fn apply_to_camera(&self, scene: &mut SceneFile) {
        let camera = &mut scene.camera;
        camera.position = self.camera_position.or(camera.position);
        if self.camera.is_some() {
            // The file's camera replaces the scene's.
            *camera = CameraSpec { from_model: self.camera.clone(), ..CameraSpec::default() };
            camera.position = self.camera_position;
        }
        camera.up = self.up.or(camera.up);
        camera.fov_y = self.fov_y.or(camera.fov_y);
        // A direction is either a target or two angles: the option's form replaces the file's.
        if self.camera_target.is_some() {
            camera.target = self.camera_target;
            (camera.yaw, camera.pitch) = (None, None);
        }
        if self.yaw.is_some() || self.pitch.is_some() {
            camera.target = None;
            camera.yaw = self.yaw.or(camera.yaw);
            camera.pitch = self.pitch.or(camera.pitch);
        }
    }

    fn apply_to_picture(&self, scene: &mut SceneFile) {
        let picture = &mut scene.picture;
        if let Some((width, height)) = self.size {
            (picture.width, picture.height) = (width, height);
        }
        set(&mut picture.samples, self.samples);
        set(&mut picture.color, self.color);
        set(&mut picture.tone_map, self.tone_map);
        set(&mut picture.exposure, self.exposure);
        set(&mut picture.texture_filter, self.texture_filter);
        match self.background {
            None => {}
            Some(BackgroundValue::Transparent) => scene.background.transparent = true,
            Some(BackgroundValue::Colors(top, bottom)) => {
                scene.background.transparent = false;
                (scene.background.top, scene.background.bottom) = (top, bottom);
            }
        }
    }
}

fn set<T>(place: &mut T, value: Option<T>) {
    if let Some(value) = value {
        *place = value;
    }
}

fn merge_material(place: &mut MaterialOverride, changes: &MaterialOverride) {
    place.ambient = changes.ambient.or(place.ambient);
    place.diffuse = changes.diffuse.or(place.diffuse);
    place.specular = changes.specular.or(place.specular);
    place.emitted = changes.emitted.or(place.emitted);
    place.shininess = changes.shininess.or(place.shininess);
    place.refraction_index = changes.refraction_index.or(place.refraction_index);
    place.opacity = changes.opacity.or(place.opacity);
    place.textures = changes.textures.or(place.textures);
    place.medium = changes.medium.or(place.medium);
    place.reflectivity = changes.reflectivity.or(place.reflectivity);
    place.transmission = changes.transmission.or(place.transmission);
    place.fresnel = changes.fresnel.or(place.fresnel);
    place.tint = changes.tint.or(place.tint);
    place.absorption = changes.absorption.or(place.absorption);
    place.dispersion = changes.dispersion.or(place.dispersion);
    place.surfaces = changes.surfaces.or(place.surfaces);
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_scene::scene_file::{ObjectSpec, Shading};

    #[test]
    fn no_options_change_nothing() {
        let mut scene = SceneFile { objects: vec![ObjectSpec::default()], ..SceneFile::default() };
        scene.camera.yaw = Some(3.0);
        scene.equation.two_sided = false;
        let before = scene.clone();
        SceneOptions::default().apply(&mut scene);
        assert_eq!(scene, before);
    }

    #[test]
    fn a_direction_replaces_its_other_form() {
        let mut scene = SceneFile::default();
        scene.camera.target = Some([1.0, 2.0, 3.0]);
        SceneOptions { yaw: Some(10.0), ..SceneOptions::default() }.apply(&mut scene);
        assert_eq!((scene.camera.target, scene.camera.yaw), (None, Some(10.0)));
        SceneOptions { camera_target: Some([0.0; 3]), ..SceneOptions::default() }.apply(&mut scene);
        assert_eq!((scene.camera.target, scene.camera.yaw), (Some([0.0; 3]), None));
    }

    #[test]
    fn every_term_can_be_omitted() {
        let mut scene = SceneFile::default();
        let without = ["ambient", "emitted", "diffuse", "specular", "attenuation", "spot"].map(String::from).to_vec();
        SceneOptions { without, ..SceneOptions::default() }.apply(&mut scene);
        let e = &scene.equation;
        assert!(![e.ambient, e.emitted, e.diffuse, e.specular_term, e.attenuation, e.spot].contains(&true));
    }

    #[test]
    fn options_change_all_objects() {
        let mut scene = SceneFile { objects: vec![ObjectSpec::default(); 2], ..SceneFile::default() };
        scene.objects[1].material.opacity = Some(0.5);
        SceneOptions {
            shading: Some(Shading::Flat),
            material: Some(MaterialOverride { shininess: Some(9.0), ..MaterialOverride::default() }),
            ..SceneOptions::default()
        }
        .apply(&mut scene);
        assert!(scene.objects.iter().all(|o| o.shading == Shading::Flat && o.material.shininess == Some(9.0)));
        assert_eq!(scene.objects[1].material.opacity, Some(0.5));
    }
}
