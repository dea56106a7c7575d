//! What a generated program computes and how: the choices that change its pictures, and those that do not.

use crate::expression::Random;
use crate::scenes::LAB;

/// The exercise that a program answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum GeneratedTask {
    /// Exercise 03.
    GouraudDiffuse,
    /// Exercise 04.
    PhongDiffuse,
    /// Exercise 05.
    GouraudSpecular,
    /// Exercise 06.
    PhongSpecular,
    /// Exercise 07.
    LightEquation,
    /// Exercise 08.
    Skybox,
    /// Exercise 09.
    Reflection,
    /// Exercise 10.
    Refraction,
}

impl GeneratedTask {
    /// All tasks, with the share of the generated programs that answer each: the longer the answer, the more.
    pub const ALL: [(u32, GeneratedTask); 8] = [
        (2, GeneratedTask::GouraudDiffuse),
        (2, GeneratedTask::PhongDiffuse),
        (2, GeneratedTask::GouraudSpecular),
        (3, GeneratedTask::PhongSpecular),
        (7, GeneratedTask::LightEquation),
        (1, GeneratedTask::Skybox),
        (2, GeneratedTask::Reflection),
        (2, GeneratedTask::Refraction),
    ];

    /// The task with an exercise's id.
    pub fn find(exercise: &str) -> Option<GeneratedTask> {
        GeneratedTask::ALL.iter().map(|(_, task)| *task).find(|task| task.exercise() == exercise)
    }

    /// The exercise's id.
    pub fn exercise(self) -> &'static str {
        match self {
            GeneratedTask::GouraudDiffuse => "ex03",
            GeneratedTask::PhongDiffuse => "ex04",
            GeneratedTask::GouraudSpecular => "ex05",
            GeneratedTask::PhongSpecular => "ex06",
            GeneratedTask::LightEquation => "ex07",
            GeneratedTask::Skybox => "ex08",
            GeneratedTask::Reflection => "ex09",
            GeneratedTask::Refraction => "ex10",
        }
    }

    /// Whether it computes light.
    pub fn is_lit(self) -> bool {
        !matches!(self, GeneratedTask::Skybox | GeneratedTask::Reflection | GeneratedTask::Refraction)
    }

    /// Whether the light is computed per vertex.
    pub fn is_per_vertex(self) -> bool {
        matches!(self, GeneratedTask::GouraudDiffuse | GeneratedTask::GouraudSpecular)
    }

    /// Whether it has a diffuse term.
    pub fn has_diffuse(self) -> bool {
        matches!(self, GeneratedTask::GouraudDiffuse | GeneratedTask::PhongDiffuse | GeneratedTask::LightEquation)
    }

    /// Whether it has a specular term.
    pub fn has_specular(self) -> bool {
        matches!(self, GeneratedTask::GouraudSpecular | GeneratedTask::PhongSpecular | GeneratedTask::LightEquation)
    }
}

/// A right answer: an exercise and the choices that it leaves open and that change the picture.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Answer {
    /// The exercise.
    pub task: GeneratedTask,
    /// Lights: 1 or 2.
    pub lights: usize,
    /// N.H in place of R.V.
    pub half_vector: bool,
    /// No highlight where N.L <= 0.
    pub gated: bool,
    /// The highlight times N.L.
    pub cosine_weighted: bool,
    /// A highlight without the material's colour.
    pub white_highlight: bool,
    /// Whether the vertex shader makes the normal a unit vector; in Gouraud shading always.
    pub unit_in_vertex: bool,
    /// A constant ambient term in exercises 03 to 06; 0 for none.
    pub ambient: f32,
    /// Constants in the text in place of uniforms, with the lab's values.
    pub writes: Written,
}

/// The constants that are written in the text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Written {
    /// The exponent 32.
    pub exponent: bool,
    /// The light's position.
    pub position: bool,
    /// The three strengths.
    pub strengths: bool,
    /// The three constants of the attenuation.
    pub attenuation: bool,
    /// The material's colour.
    pub material: bool,
    /// The index 1.52.
    pub index: bool,
}

impl Answer {
    /// The answer without any of the choices.
    #[cfg(test)]
    pub(crate) fn plain(task: GeneratedTask) -> Self {
        let writes = Written::default();
        let unit_in_vertex = true;
        let [half_vector, gated, cosine_weighted, white_highlight] = [false; 4];
        Answer {
            task,
            lights: 1,
            half_vector,
            gated,
            cosine_weighted,
            white_highlight,
            unit_in_vertex,
            ambient: 0.0,
            writes,
        }
    }

    /// The light's position, if it is written.
    pub(crate) fn lab_light_position(&self) -> glam::Vec3 {
        if self.task == GeneratedTask::LightEquation { LAB.position } else { glam::Vec3::new(0.5, 0.5, -0.7) }
    }

    pub(crate) fn draw(task: GeneratedTask, random: &mut Random) -> Self {
        let specular = task.has_specular();
        let whole = task == GeneratedTask::LightEquation;
        let lights = if whole && random.chance(0.15) { 2 } else { 1 };
        let mut written = |probability: f64| random.chance(probability);
        let writes = Written {
            exponent: written(0.35) && specular,
            position: written(0.06) && task.is_lit() && lights == 1,
            strengths: written(0.08) && whole && lights == 1,
            attenuation: written(0.08) && whole && lights == 1,
            material: written(0.06) && whole,
            index: written(0.3) && task == GeneratedTask::Refraction,
        };
        let half_vector = specular && random.chance(0.22);
        let gated = specular && random.chance(0.15);
        Answer {
            task,
            lights,
            half_vector,
            gated,
            cosine_weighted: specular && random.chance(0.03),
            white_highlight: whole && random.chance(0.08),
            unit_in_vertex: task.is_per_vertex() || random.chance(0.6),
            ambient: if task.is_lit() && !whole && random.chance(0.07) { 0.1 } else { 0.0 },
            writes,
        }
    }
}

/// A version of GLSL.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Version {
    /// 110 to 460; 100 and 300 are those of OpenGL ES.
    pub number: u32,
}

impl Version {
    pub(crate) fn is_es(self) -> bool {
        self.number == 100 || self.number == 300
    }

    fn at_least(self, desktop: u32, es: bool) -> bool {
        if self.is_es() { es && self.number == 300 } else { self.number >= desktop }
    }

    /// `in` and `out` in place of `attribute` and `varying`.
    pub(crate) fn has_in_and_out(self) -> bool {
        self.at_least(130, true)
    }

    /// A `mat3` from a `mat4`.
    pub(crate) fn has_mat3_of_mat4(self) -> bool {
        self.at_least(120, true)
    }

    pub(crate) fn has_inverse(self) -> bool {
        self.at_least(140, true)
    }

    pub(crate) fn has_uniform_blocks(self) -> bool {
        self.at_least(140, true)
    }

    pub(crate) fn has_varying_blocks(self) -> bool {
        self.at_least(150, false)
    }

    /// Integers where numbers are needed.
    pub(crate) fn converts_integers(self) -> bool {
        self.at_least(120, false)
    }

    pub(crate) fn has_f_suffix(self) -> bool {
        self.at_least(130, true)
    }

    pub(crate) fn has_locations(self) -> bool {
        self.at_least(330, true)
    }

    const WEIGHTS: [(u32, u32); 17] = [
        (50, 330),
        (5, 300),
        (4, 100),
        (3, 110),
        (6, 120),
        (3, 130),
        (2, 140),
        (4, 150),
        (4, 400),
        (5, 410),
        (2, 420),
        (3, 430),
        (2, 440),
        (4, 450),
        (3, 460),
        (2, 330),
        (1, 120),
    ];
}

/// The space in which vectors meet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Space {
    /// World space.
    World,
    /// Eye space: the eye is at the origin.
    Eye,
}

/// Which matrices the program sends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Matrices {
    /// M, V and P.
    Separate,
    /// V M and P, and M where it is needed.
    ModelView,
    /// P V M, and M or V M where it is needed.
    Whole,
    /// P V and M.
    ViewProjection,
}

/// How the normal is transformed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NormalBy {
    /// `mat3(itM) * normal`.
    Mat3OfUniform,
    /// `(itM * vec4(normal, 0.0)).xyz`.
    Vec4OfUniform,
    /// `(itM * vec4(normal, 1.0)).xyz`: harmless.
    Vec4WithOne,
    /// A `mat3` as a uniform.
    Mat3Uniform,
    /// `mat3(transpose(inverse(M))) * normal`.
    Computed,
    /// `normal * inverse(mat3(M))`.
    RowTimesInverse,
}

/// Where the light's data comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Container {
    /// One uniform each.
    Plain,
    /// A struct.
    Struct,
    /// An array of structs.
    StructArray,
    /// A uniform block, with or without a name for its instance.
    Block(bool),
    /// An array for each.
    Arrays,
}

/// How the reflected direction is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mirror {
    /// `reflect(-L, N)`.
    Reflect,
    /// `-reflect(L, N)`.
    Negated,
    /// `2 (N.L) N - L`.
    Formula,
    /// `reflect(-V, N)`, and L in place of V.
    OfView,
    /// `reflect(L, N)`, and -V in place of V.
    TwoSigns,
}

/// How functions divide the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Functions {
    /// Everything in `main`.
    None,
    /// One for each of some terms.
    Terms,
    /// One for the whole light.
    Whole,
}

/// How the sum is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SumForm {
    /// `colour * (ambient + attenuation * (diffuse + specular))`.
    Factored,
    /// `(ambient + attenuation * diffuse + attenuation * specular) * colour`.
    Distributed,
    /// Colour and attenuation in each term.
    PerTerm,
    /// `sum += ...`.
    Accumulated,
}

/// The choices that do not change the picture.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Plan {
    /// The versions of the two stages.
    pub versions: [Version; 2],
    /// The space.
    pub space: Space,
    /// Whether the program sends the light's position in eye space, and this shader computes there.
    pub light_sent_in_eye: bool,
    /// Whether the vertex shader passes the directions to light and eye, instead of the position.
    pub passes_directions: bool,
    /// The matrices.
    pub matrices: Matrices,
    /// The normal.
    pub normal_by: NormalBy,
    /// The light's data.
    pub container: Container,
    /// The reflected direction.
    pub mirror: Mirror,
    /// Whether the direction from the light is computed, and its negative used.
    pub from_light: bool,
    /// The functions.
    pub functions: Functions,
    /// Whether several lights are visited by a loop.
    pub loops: bool,
    /// The sum.
    pub sum: SumForm,
    /// Whether terms are `vec3` in place of `float`.
    pub vec3_terms: bool,
    /// Whether varyings are in an interface block.
    pub varying_block: bool,
    /// The formula in place of `reflect` or `refract`.
    pub formula: bool,
}

impl Plan {
    pub(crate) fn draw(answer: &Answer, random: &mut Random) -> Self {
        let task = answer.task;
        let version =
            Version { number: random.weighted(&Version::WEIGHTS.map(|(weight, number)| (weight, number)), 330) };
        // A fragment shader of another version is normal where both have `in` and `out`.
        let other = if version.has_varying_blocks() && random.chance(0.15) {
            Version { number: random.pick(&[330, 400, 410, 450]).unwrap_or(330) }
        } else {
            version
        };
        let space = if task.is_lit() && random.chance(0.22) { Space::Eye } else { Space::World };
        let passes_directions = task.is_lit() && !task.is_per_vertex() && answer.lights == 1 && random.chance(0.1);
        let container = Self::container(answer, [version, other], random);
        let normal_by = Self::normal(version, space, random);
        let loops = answer.lights > 1 && container_is_indexed(container) && random.chance(0.7);
        let functions = match random.below(10) {
            0..=4 => Functions::None,
            5..=7 => Functions::Terms,
            _ if passes_directions => Functions::None,
            _ => Functions::Whole,
        };
        let matrices =
            [(60, Matrices::Separate), (14, Matrices::ModelView), (10, Matrices::Whole), (8, Matrices::ViewProjection)];
        Plan {
            versions: [version, other],
            space,
            light_sent_in_eye: space == Space::Eye && !answer.writes.position && random.chance(0.25),
            passes_directions,
            matrices: random.weighted(&matrices, Matrices::Separate),
            normal_by,
            container,
            mirror: random.weighted(
                &[
                    (60, Mirror::Reflect),
                    (8, Mirror::Negated),
                    (16, Mirror::Formula),
                    (6, Mirror::OfView),
                    (6, Mirror::TwoSigns),
                ],
                Mirror::Reflect,
            ),
            from_light: random.chance(0.07),
            functions: if answer.lights > 1 && !loops && functions != Functions::Whole {
                Functions::Whole
            } else {
                functions
            },
            loops,
            sum: random
                .pick(&[SumForm::Factored, SumForm::Distributed, SumForm::PerTerm, SumForm::Accumulated])
                .unwrap_or(SumForm::Factored),
            vec3_terms: random.chance(0.4),
            varying_block: version.has_varying_blocks() && other.has_varying_blocks() && random.chance(0.08),
            formula: random.chance(0.3),
        }
    }

    fn container(answer: &Answer, versions: [Version; 2], random: &mut Random) -> Container {
        if answer.lights > 1 {
            return random
                .pick(&[Container::StructArray, Container::StructArray, Container::Arrays])
                .unwrap_or(Container::Arrays);
        }
        if answer.task != GeneratedTask::LightEquation {
            return Container::Plain;
        }
        let blocks = versions.iter().all(|version| version.has_uniform_blocks());
        let instance = random.chance(0.6);
        random.weighted(
            &[
                (35, Container::Plain),
                (50, Container::Struct),
                (5, Container::StructArray),
                (if blocks { 7 } else { 0 }, Container::Block(instance)),
            ],
            Container::Struct,
        )
    }

    fn normal(version: Version, space: Space, random: &mut Random) -> NormalBy {
        let (mat3, inverse) = (version.has_mat3_of_mat4(), version.has_inverse());
        let when = |condition: bool, weight: u32| if condition { weight } else { 0 };
        let world = space == Space::World;
        random.weighted(
            &[
                (when(mat3, 40), NormalBy::Mat3OfUniform),
                (when(world, 20), NormalBy::Vec4OfUniform),
                (when(world, 6), NormalBy::Vec4WithOne),
                (16, NormalBy::Mat3Uniform),
                (when(inverse, 25), NormalBy::Computed),
                (when(inverse, 3), NormalBy::RowTimesInverse),
            ],
            NormalBy::Mat3Uniform,
        )
    }
}

fn container_is_indexed(container: Container) -> bool {
    matches!(container, Container::StructArray | Container::Arrays)
}
