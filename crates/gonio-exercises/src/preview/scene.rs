//! The preview scenes of an exercise: the lab's own, one that shows mistakes that the lab's own hides, and the checker's.

use crate::exercise::Exercise;
use glam::{Mat4, Quat, Vec3};
use gonio_check::comparison::Task;
use gonio_check::testbench::{TestLight, TestMesh, TestScene, TestShape, mesh, scene::LAB_LIGHT};
use gonio_language::tr;
use std::borrow::Cow;

/// The shape of an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PreviewShape {
    /// A sphere of radius 1 with triangles as high as a quarter of the sphere.
    ExtremelyCoarse,
    /// A sphere whose outline still has corners.
    Coarse,
    /// A sphere that looks round.
    Smooth,
    /// A smooth torus around the y axis, with radii 0.7 and 0.3.
    Torus,
    /// A skybox from -1 to 1.
    Cube,
    /// A small pyramid with corners in five colours.
    Pyramid,
    /// The pyramid within a globe of many colours.
    Landmarks,
    /// The sphere of the test scenes.
    TestSphere,
    /// The torus of the test scenes.
    TestTorus,
}

impl PreviewShape {
    /// All shapes, in the order of [`PreviewShape::index`].
    pub const ALL: [PreviewShape; 9] = [
        PreviewShape::ExtremelyCoarse,
        PreviewShape::Coarse,
        PreviewShape::Smooth,
        PreviewShape::Torus,
        PreviewShape::Cube,
        PreviewShape::Pyramid,
        PreviewShape::Landmarks,
        PreviewShape::TestSphere,
        PreviewShape::TestTorus,
    ];

    /// Its index in [`PreviewShape::ALL`].
    pub fn index(self) -> usize {
        self as usize
    }

    /// Its vertices and triangles.
    pub fn mesh(self) -> TestMesh {
        match self {
            PreviewShape::ExtremelyCoarse => mesh::sphere(8, 5),
            PreviewShape::Coarse => mesh::sphere(20, 12),
            PreviewShape::Smooth => mesh::sphere(72, 48),
            PreviewShape::Torus => mesh::torus(96, 48),
            PreviewShape::Cube => TestShape::Cube.mesh(),
            PreviewShape::Pyramid => TestShape::Pyramid.mesh(),
            PreviewShape::Landmarks => TestShape::Landmarks.mesh(),
            PreviewShape::TestSphere => TestShape::Sphere.mesh(),
            PreviewShape::TestTorus => TestShape::Torus.mesh(),
        }
    }

    fn of_test(shape: TestShape) -> Self {
        match shape {
            TestShape::Sphere => PreviewShape::TestSphere,
            TestShape::Torus => PreviewShape::TestTorus,
            TestShape::Cube => PreviewShape::Cube,
            TestShape::Pyramid => PreviewShape::Pyramid,
            TestShape::Landmarks => PreviewShape::Landmarks,
        }
    }
}

/// A camera, in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye {
    /// Position of the camera.
    pub position: Vec3,
    /// The point that the camera looks at.
    pub target: Vec3,
    /// The direction that is up in the picture.
    pub up: Vec3,
    /// Field of view along the picture's shorter side, in radians.
    pub fov_rad: f32,
}

/// One of a scene's objects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreviewObject {
    /// The mesh.
    pub shape: PreviewShape,
    /// The model matrix M.
    pub world_from_model: Mat4,
}

/// Objects, a light and the initial camera.
#[derive(Clone, Debug, PartialEq)]
pub struct PreviewScene {
    /// A short name.
    pub name: Cow<'static, str>,
    /// The purpose of the scene, in one sentence.
    pub shows: &'static str,
    /// The objects.
    pub objects: Vec<PreviewObject>,
    /// The light at time 0, without its swing, and the other values that programs get.
    pub values: TestScene,
    /// The light moves by this vector times sin(now), as in the lab's exercise 07.
    pub swing: Vec3,
    /// The initial camera.
    pub eye: Eye,
    /// Whether the sky is visible behind the objects.
    pub has_sky: bool,
    /// Whether the camera turns in place, as under a sky, instead of moving around a target.
    pub looks_around: bool,
    /// Whether it is one of the checker's scenes, of which verdicts tell.
    pub is_test: bool,
    /// Whether the light lights the objects.
    pub has_lamp: bool,
}

impl PreviewScene {
    /// The test scene of each object, seen from `eye` at `time` (seconds) in a picture of `size` (width and height in pixels).
    /// The matrices are those of a square picture whose side is the longer side.
    pub fn test_scenes(&self, eye: &Eye, time: f32, size: [u32; 2]) -> Vec<(PreviewShape, TestScene)> {
        let [width, height] = size.map(|side| side.max(1) as f32);
        let longer = (width / height).max(height / width);
        let fov_y_rad = 2.0 * ((0.5 * eye.fov_rad).tan() * longer).atan();
        let light = self.values.light;
        let light = TestLight { position: light.position + self.swing * time.sin(), ..light };
        let test_scene = |object: &PreviewObject| TestScene {
            world_from_model: object.world_from_model,
            eye: eye.position,
            target: eye.target,
            up: eye.up,
            fov_y_rad,
            light,
            time,
            ..self.values.clone()
        };
        self.objects.iter().map(|object| (object.shape, test_scene(object))).collect()
    }
}

/// The checker's scenes of an exercise; none if the checker draws nothing for it.
pub fn test_scenes(exercise: &Exercise) -> Vec<PreviewScene> {
    let has_sky = matches!(exercise.like(), "ex09" | "ex10");
    let Some(task) = Task::find(exercise.like()) else { return Vec::new() };
    let scenes = match exercise.picture_judge() {
        Some(judge) => judge.scenes.all.clone(),
        None => task.test_scenes().0,
    };
    let preview = |values| PreviewScene { has_sky, has_lamp: task.model.is_lit(), ..of_test(values) };
    scenes.into_iter().map(preview).collect()
}

/// The same objects, values and camera as in a test scene.
fn of_test(values: TestScene) -> PreviewScene {
    let shape = PreviewShape::of_test(values.shape);
    PreviewScene {
        name: values.name.clone().into(),
        shows: values.shows(),
        objects: vec![PreviewObject { shape, world_from_model: values.world_from_model }],
        swing: Vec3::ZERO,
        eye: Eye { position: values.eye, target: values.target, up: values.up, fov_rad: values.fov_y_rad },
        has_sky: false,
        looks_around: shape == PreviewShape::Cube,
        is_test: true,
        has_lamp: false,
        values,
    }
}

/// The scenes of an exercise to look at, the lab's first; at least one.
pub fn scenes(exercise: &Exercise) -> Vec<PreviewScene> {
    match exercise.like() {
        "ex01" => vec![pyramid(), landmarks()],
        "ex08" => vec![sky()],
        "ex09" | "ex10" => vec![mirrored(PreviewShape::Smooth), mirrored(PreviewShape::Torus)],
        id => {
            let task = Task::find(id);
            let lamp =
                task.map_or(TestLight { attenuation: [1.0, 0.0, 0.0], ..LAB_LIGHT }, |task| task.lamp(LAB_LIGHT));
            let position = task.map_or(LAB_LIGHT.position, |task| task.light_position);
            let light = TestLight { position, ..lamp };
            let lab = if task.is_some_and(|task| task.attenuated) { one_sphere(light) } else { three_spheres(light) };
            let has_lamp = task.is_some_and(|task| task.model.is_lit());
            [lab, stretched(lamp)].map(|scene| PreviewScene { has_lamp, ..scene }).into()
        }
    }
}

fn eye(position: [f32; 3], target: [f32; 3], fov_deg: f32) -> Eye {
    Eye { position: position.into(), target: target.into(), up: Vec3::Y, fov_rad: fov_deg.to_radians() }
}

fn scene(
    name: &'static str,
    shows: &'static str,
    objects: Vec<PreviewObject>,
    light: TestLight,
    eye: Eye,
) -> PreviewScene {
    let values = TestScene {
        name: name.to_owned(),
        shows,
        shape: TestShape::Sphere,
        world_from_model: Mat4::IDENTITY,
        eye: eye.position,
        target: eye.target,
        up: eye.up,
        fov_y_rad: eye.fov_rad,
        light,
        other: None,
        material: Vec3::new(0.5, 0.6, 0.8),
        shininess: 32.0,
        roughness: 0.2,
        refraction_index: 1.52,
        time: 0.0,
    };
    PreviewScene {
        name: name.into(),
        shows,
        objects,
        values,
        swing: Vec3::ZERO,
        eye,
        has_sky: false,
        looks_around: false,
        is_test: false,
        has_lamp: false,
    }
}

/// The scene of exercise 01: a camera in front of the pyramid that looks straight ahead.
fn pyramid() -> PreviewScene {
    let objects = vec![PreviewObject { shape: PreviewShape::Pyramid, world_from_model: Mat4::IDENTITY }];
    let shows = tr!("check-preview-lab-pyramid");
    scene("the lab's", shows, objects, LAB_LIGHT, eye([0.0, 0.0, 2.0], [0.0; 3], LAB_FOV_DEG))
}

/// Shows mistakes that a pyramid at the origin and a camera that does not turn hide.
fn landmarks() -> PreviewScene {
    let turn = Quat::from_euler(glam::EulerRot::YXZ, 25f32.to_radians(), 40f32.to_radians(), 15f32.to_radians());
    let model = Mat4::from_scale_rotation_translation(Vec3::new(0.8, 1.1, 0.6), turn, Vec3::new(0.3, -0.2, -0.4));
    let objects = vec![PreviewObject { shape: PreviewShape::Landmarks, world_from_model: model }];
    let shows = tr!("check-preview-the-pyramid-turned-and-moved-within");
    scene("turned", shows, objects, LAB_LIGHT, eye([1.1, 0.7, 1.0], [0.2, -0.1, -0.4], LAB_FOV_DEG))
}

/// The lab's field of view in degrees: 45 radians.
const LAB_FOV_DEG: f32 = 58.3;

/// The scene of exercises 07 and 12.
fn one_sphere(light: TestLight) -> PreviewScene {
    let model = Mat4::from_translation(Vec3::new(0.0, 0.0, -2.0)) * Mat4::from_scale(Vec3::splat(0.5));
    let objects = vec![PreviewObject { shape: PreviewShape::Smooth, world_from_model: model }];
    let eye = eye([0.0, 0.0, 0.0], [0.0, 0.0, -2.0], 38.0);
    let shows = tr!("check-preview-lab-lamp");
    // Attenuation leaves a third of the light: with the lab's strengths the sphere would be nearly black.
    let light = TestLight { ambient: 0.15, diffuse: 0.8, ..light };
    let mut scene = scene("the lab's", shows, objects, light, eye);
    scene.values.material = Vec3::new(0.85, 0.92, 1.0);
    PreviewScene { swing: Vec3::new(0.0, 0.0, 2.0), ..scene }
}

/// The scene of exercises 03 to 06.
fn three_spheres(light: TestLight) -> PreviewScene {
    let object = |shape, x: f32| {
        let model = Mat4::from_translation(Vec3::new(x, 0.0, -2.0)) * Mat4::from_scale(Vec3::splat(0.5));
        PreviewObject { shape, world_from_model: model }
    };
    let objects = vec![
        object(PreviewShape::ExtremelyCoarse, -1.15),
        object(PreviewShape::Coarse, 0.0),
        object(PreviewShape::Smooth, 1.15),
    ];
    let shows = tr!("check-preview-lab-spheres");
    scene("the lab's", shows, objects, light, eye([0.0, 0.35, 2.2], [0.0, 0.0, -2.0], 52.0))
}

/// Shows mistakes that a model with uniform scale and no rotation hides.
fn stretched(light: TestLight) -> PreviewScene {
    let turn = Quat::from_euler(glam::EulerRot::YXZ, 50f32.to_radians(), 35f32.to_radians(), 20f32.to_radians());
    let scale = Vec3::new(0.6, 1.2, 0.3);
    let model = Mat4::from_scale_rotation_translation(scale, turn, Vec3::new(0.4, -0.3, -0.6));
    let objects = vec![PreviewObject { shape: PreviewShape::Torus, world_from_model: model }];
    let light = TestLight { position: Vec3::new(1.6, 2.2, 1.2), ..light };
    let shows = tr!("check-preview-a-ring-that-is-stretched-turned");
    scene("stretched", shows, objects, light, eye([1.9, 1.1, 2.0], [0.4, -0.3, -0.6], 34.0))
}

/// A shape that shows the sky around it.
fn mirrored(shape: PreviewShape) -> PreviewScene {
    let turn = Quat::from_euler(glam::EulerRot::YXZ, 0.5, 0.9, 0.0);
    let (name, shows) = match shape {
        PreviewShape::Torus => ("a ring", tr!("check-preview-a-ring-stretched-and-turned-its")),
        _ => ("a sphere", tr!("check-preview-a-smooth-sphere-under-the-lab")),
    };
    let model = match shape {
        PreviewShape::Torus => Mat4::from_scale_rotation_translation(Vec3::new(1.0, 1.3, 0.8), turn, Vec3::ZERO),
        _ => Mat4::IDENTITY,
    };
    let objects = vec![PreviewObject { shape, world_from_model: model }];
    PreviewScene { has_sky: true, ..scene(name, shows, objects, LAB_LIGHT, eye([0.0, 0.6, 3.6], [0.0; 3], 46.0)) }
}

/// The sky, seen from inside a cube.
fn sky() -> PreviewScene {
    let objects = vec![PreviewObject { shape: PreviewShape::Cube, world_from_model: Mat4::IDENTITY }];
    let shows = tr!("check-preview-the-sky-seen-by-a-camera");
    let eye = eye([0.3, 0.2, 0.4], [0.3, 0.3, -1.0], 68.0);
    PreviewScene { looks_around: true, ..scene("the sky", shows, objects, LAB_LIGHT, eye) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exercise;

    #[test]
    fn a_picture_of_any_aspect_ratio_shows_all_that_a_square_one_does() {
        let exercise = exercise::find("ex04").unwrap();
        let scene = &scenes(exercise)[0];
        let seen = |size| {
            let (_, test_scene) = scene.test_scenes(&scene.eye, 0.0, size).remove(0);
            (0.5 * test_scene.fov_y_rad).tan()
        };
        let square = seen([100, 100]);
        for (size, times) in [([200, 100], 2.0), ([100, 300], 3.0)] {
            assert!((seen(size) / square - times).abs() < 1e-4, "{size:?}");
        }
    }

    #[test]
    fn a_preview_of_a_test_scene_has_the_values_that_the_checker_uses() {
        for exercise in exercise::all() {
            let expected = Task::find(&exercise.id).map_or_else(Vec::new, |task| task.test_scenes().0);
            let previews = test_scenes(exercise);
            assert_eq!(previews.len(), expected.len(), "{}", exercise.id);
            for (preview, mut expected) in previews.iter().zip(expected) {
                let (shape, seen) = preview.test_scenes(&preview.eye, expected.time, [64, 64]).remove(0);
                assert_eq!(shape.mesh(), expected.shape.mesh(), "{}", expected.name);
                assert!((seen.fov_y_rad - expected.fov_y_rad).abs() < 1e-6, "{}", expected.name);
                expected.fov_y_rad = seen.fov_y_rad;
                assert_eq!(seen, expected);
            }
        }
        assert!(test_scenes(exercise::find("ex04").unwrap()).len() >= 9);
    }

    #[test]
    fn the_lamp_of_exercise_07_swings_as_its_text_says() {
        let scene = &scenes(exercise::find("ex07").unwrap())[0];
        let at = |time: f32| scene.test_scenes(&scene.eye, time, [10, 10])[0].1.light.position;
        assert_eq!(at(0.0), Vec3::new(1.0, 2.0, 1.5));
        assert!((at(std::f32::consts::FRAC_PI_2) - Vec3::new(1.0, 2.0, 3.5)).length() < 1e-5);
    }
}
