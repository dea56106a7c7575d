//! The tasks that exercises set for a pair of shaders.

use crate::mistakes::ModelSolution;
use crate::testbench::{TestLight, TestScene, scene};
use glam::Vec3;

/// The task that an exercise sets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Task {
    /// The id of the exercise: `ex04`.
    pub exercise: &'static str,
    /// The right answer.
    pub model: ModelSolution,
    /// Another method, with the id of the mistake if it is one.
    pub other: Option<(ModelSolution, Option<&'static str>)>,
    /// Whether ambient, diffuse and specular light are required.
    pub required: [bool; 3],
    /// Whether light decreases with distance.
    pub attenuated: bool,
    /// The position of the lab's own light, for programs with a constant position.
    pub light_position: Vec3,
}

/// The strength of a normalised highlight, in parts of one that is 1 at its brightest.
const NORMALISED: f32 = 0.5;

const LAMP: Vec3 = Vec3::new(0.5, 0.5, -0.7);

/// All exercises that are answered with a pair of shaders.
pub const TASKS: &[Task] = &[
    task("ex01", ModelSolution::Camera, None, [false; 3]),
    task(
        "ex03",
        ModelSolution::Gouraud,
        Some((ModelSolution::Phong, Some("phong-instead-of-gouraud"))),
        [false, true, false],
    ),
    task(
        "ex04",
        ModelSolution::Phong,
        Some((ModelSolution::Gouraud, Some("gouraud-instead-of-phong"))),
        [false, true, false],
    ),
    task(
        "ex05",
        ModelSolution::Gouraud,
        Some((ModelSolution::Phong, Some("phong-instead-of-gouraud"))),
        [false, false, true],
    ),
    task(
        "ex06",
        ModelSolution::Phong,
        Some((ModelSolution::Gouraud, Some("gouraud-instead-of-phong"))),
        [false, false, true],
    ),
    Task {
        attenuated: true,
        light_position: Vec3::new(1.0, 2.0, 1.5),
        // The exercise does not prescribe the stage that computes the equation.
        ..task("ex07", ModelSolution::Phong, Some((ModelSolution::Gouraud, None)), [true, true, true])
    },
    task("ex08", ModelSolution::Skybox, None, [false; 3]),
    task("ex09", ModelSolution::Reflection, None, [false; 3]),
    task("ex10", ModelSolution::Refraction, None, [false; 3]),
    Task {
        attenuated: true,
        light_position: Vec3::new(1.0, 2.0, 1.5),
        ..task(
            "ex12",
            ModelSolution::Ward,
            Some((ModelSolution::WardPerVertex, Some("gouraud-instead-of-phong"))),
            [true, true, true],
        )
    },
    task("s1", ModelSolution::Panorama, None, [false; 3]),
];

/// Exercise 01 judged by distances alone, for programs whose colours are not those of the vertices.
pub const PLACES: &Task = &task("ex01", ModelSolution::Places, None, [false; 3]);

const fn task(
    exercise: &'static str,
    model: ModelSolution,
    other: Option<(ModelSolution, Option<&'static str>)>,
    required: [bool; 3],
) -> Task {
    Task { exercise, model, other, required, attenuated: false, light_position: LAMP }
}

impl Task {
    /// Finds the task of an exercise.
    pub fn find(exercise: &str) -> Option<&'static Task> {
        TASKS.iter().find(|task| task.exercise == exercise)
    }

    /// Returns a light as this exercise has it: with or without attenuation, and with a highlight that reflects no more light than
    /// arrives if it is normalised.
    pub fn lamp(&self, light: TestLight) -> TestLight {
        let attenuation = if self.attenuated { light.attenuation } else { [1.0, 0.0, 0.0] };
        let specular = if self.model.has_roughness() { NORMALISED * light.specular } else { light.specular };
        TestLight { attenuation, specular, ..light }
    }

    /// Returns the test scenes: complete ones, then those for programs with several lights, then those with one term
    /// alone. Also returns the number of scenes of the first and second kind.
    pub fn test_scenes(&self) -> (Vec<TestScene>, [usize; 2]) {
        let mut all = match self.model {
            ModelSolution::Phong | ModelSolution::Gouraud | ModelSolution::Ward | ModelSolution::WardPerVertex => {
                scene::lit()
            }
            ModelSolution::Reflection | ModelSolution::Refraction => scene::mirrored(),
            ModelSolution::Skybox => scene::skies(),
            ModelSolution::Camera | ModelSolution::Places => scene::cameras(),
            ModelSolution::Panorama => (0..6).map(scene::face).collect(),
        };
        let whole = all.len();
        let mut of_two = 0;
        if self.model.is_lit() {
            let isolated = scene::isolated(&all);
            let by_two = scene::lit_by_two();
            of_two = by_two.len();
            all.extend(by_two);
            all.extend(isolated);
        }
        for light in all.iter_mut().flat_map(|s| std::iter::once(&mut s.light).chain(&mut s.other)) {
            *light = self.lamp(*light);
        }
        (all, [whole, of_two])
    }
}
