//! The test scenes. Each has a comment or a text about the mistakes that it distinguishes.

use super::TestShape;
use glam::{Mat3, Mat4, Quat, Vec3};
use gonio_language::{Language, text_in, tr};

/// The distance of a sun in world units: its rays are parallel to 1/10000 of a radian all over a model.
const SUN_DISTANCE: f32 = 1e5;

/// A light of a test scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TestLight {
    /// The position, in world space.
    pub position: Vec3,
    /// Strengths of the terms, 0 to 1.
    pub ambient: f32,
    /// See `ambient`.
    pub diffuse: f32,
    /// See `ambient`.
    pub specular: f32,
    /// kc, kl, kq of 1 / (kc + kl d + kq d^2).
    pub attenuation: [f32; 3],
    /// The brightness of the light's colour, for programs that have one. Model solutions only have strengths, so it
    /// is 1 for them.
    pub brightness: f32,
    /// Whether a program with a direction instead of a position expects the direction towards the light, not the one
    /// from it.
    pub points_to_light: bool,
}

impl TestLight {
    /// Returns the same light, switched off.
    pub fn dark(self) -> Self {
        TestLight { ambient: 0.0, diffuse: 0.0, specular: 0.0, brightness: 0.0, ..self }
    }

    /// Returns the same light as a sun, infinitely far from `centre` in world space, with the same brightness there.
    pub fn as_sun(self, centre: Vec3) -> Self {
        let position = centre + (self.position - centre).normalize_or(Vec3::Y) * SUN_DISTANCE;
        TestLight { position, ..self }
    }

    /// Whether it emits no light.
    pub fn is_dark(&self) -> bool {
        self.ambient == 0.0 && self.diffuse == 0.0 && self.specular == 0.0
    }
}

/// A scene of one object, a light or two, and a camera.
#[derive(Clone, Debug, PartialEq)]
pub struct TestScene {
    /// A short name for tables.
    pub name: String,
    /// The id of the sentence that says what this scene shows that others do not.
    pub shows: &'static str,
    /// The mesh to draw.
    pub shape: TestShape,
    /// M: world from model.
    pub world_from_model: Mat4,
    /// The position, in world space.
    pub eye: Vec3,
    /// The point that the camera looks at, in world space.
    pub target: Vec3,
    /// The up direction of the picture, in world space.
    pub up: Vec3,
    /// The vertical field of view in radians.
    pub fov_y_rad: f32,
    /// The light.
    pub light: TestLight,
    /// Another light, for programs with several lights.
    pub other: Option<TestLight>,
    /// The colour of the material, linear RGB.
    pub material: Vec3,
    /// The exponent of the highlight.
    pub shininess: f32,
    /// The roughness of the surface: Ward's alpha, an RMS slope.
    pub roughness: f32,
    /// The object's refractive index against air.
    pub refraction_index: f32,
    /// The time in seconds.
    pub time: f32,
}

impl TestScene {
    /// Returns V.
    pub fn view_from_world(&self) -> Mat4 {
        glam::camera::rh::view::look_at_mat4(self.eye, self.target, self.up)
    }

    /// Returns the direction of the camera: a unit vector in world space.
    pub fn front(&self) -> Vec3 {
        (self.target - self.eye).normalize()
    }

    /// Returns the camera's own Right: a unit vector in world space.
    pub fn right(&self) -> Vec3 {
        self.front().cross(self.up).normalize()
    }

    /// Returns P for a square picture.
    pub fn clip_from_view(&self) -> Mat4 {
        glam::camera::rh::proj::opengl::perspective(self.fov_y_rad, 1.0, 0.1, 100.0)
    }

    /// Returns a position for a second light: that of the first, rotated around the object.
    pub fn elsewhere(&self) -> Vec3 {
        let centre = self.world_from_model.w_axis.truncate();
        centre + Quat::from_rotation_y(2.0) * (self.light.position - centre)
    }

    /// Returns the reason for this scene: what it shows that others do not.
    #[must_use]
    pub fn shows(&self) -> &'static str {
        tr!(self.shows)
    }

    /// Returns the scene with the whole world rotated about its origin: object, lights and camera together, so that
    /// the picture remains.
    #[must_use]
    pub fn turned(&self, turn: Quat) -> Self {
        let turned = |light: TestLight| TestLight { position: turn * light.position, ..light };
        TestScene {
            world_from_model: Mat4::from_quat(turn) * self.world_from_model,
            eye: turn * self.eye,
            target: turn * self.target,
            up: turn * self.up,
            light: turned(self.light),
            other: self.other.map(turned),
            ..self.clone()
        }
    }

    /// Returns the inverse transpose of M.
    pub fn normal_matrix(&self) -> Mat4 {
        self.world_from_model.inverse().transpose()
    }

    /// Returns the scene in the coordinates of its camera, which is at the origin and looks along -z.
    #[must_use]
    pub fn in_view_space(&self) -> Self {
        let view = self.view_from_world();
        let moved = |light: TestLight| TestLight { position: view.transform_point3(light.position), ..light };
        TestScene {
            world_from_model: view * self.world_from_model,
            eye: Vec3::ZERO,
            target: Vec3::NEG_Z,
            up: Vec3::Y,
            light: moved(self.light),
            other: self.other.map(moved),
            ..self.clone()
        }
    }

    /// Returns the inverse transpose of V M, for normals in view space.
    pub fn view_normal_matrix(&self) -> Mat3 {
        Mat3::from_mat4((self.view_from_world() * self.world_from_model).inverse().transpose())
    }
}

/// The values of the lab's own light.
pub const LAB_LIGHT: TestLight = TestLight {
    position: Vec3::new(1.0, 2.0, 1.5),
    ambient: 0.1,
    diffuse: 0.5,
    specular: 0.8,
    attenuation: [1.0, 0.14, 0.07],
    brightness: 1.0,
    points_to_light: false,
};

fn base(name: &str, shows: &'static str) -> TestScene {
    TestScene {
        name: name.to_owned(),
        shows,
        shape: TestShape::Torus,
        world_from_model: Mat4::IDENTITY,
        eye: Vec3::new(0.0, 0.0, 3.0),
        target: Vec3::ZERO,
        up: Vec3::Y,
        fov_y_rad: 0.7,
        light: LAB_LIGHT,
        other: None,
        material: Vec3::new(0.5, 0.6, 0.8),
        shininess: 32.0,
        roughness: 0.3,
        refraction_index: 1.52,
        time: 0.0,
    }
}

fn placed(at: [f32; 3], turn_deg: [f32; 3], scale: [f32; 3]) -> Mat4 {
    let [x, y, z] = turn_deg.map(f32::to_radians);
    let turn = Quat::from_euler(glam::EulerRot::YXZ, y, x, z);
    Mat4::from_scale_rotation_translation(scale.into(), turn, at.into())
}

/// Returns the name of a test scene for people, by its id in verdicts. Ids of no test scene are returned as they are.
#[must_use]
pub fn title(id: &str) -> String {
    if let Some((scene, term)) = id.strip_suffix(" alone").and_then(|id| id.rsplit_once(", ")) {
        return tr!("check-scene-alone", scene = title(scene), term = term_title(term));
    }
    text_of("check-scene-name", id)
}

/// Returns the name of a term for people, by its id in verdicts: `ambient`, `diffuse` or `specular`.
#[must_use]
pub fn term_title(id: &str) -> String {
    text_of("check-term", id)
}

/// The text of an id with words and spaces; the id itself if it has none.
fn text_of(kind: &str, id: &str) -> String {
    let text = text_in(Language::current(), &format!("{kind}-{}", id.replace(' ', "-")));
    text.unwrap_or(id).to_owned()
}

/// Returns the nine scenes for programs that compute light.
pub fn lit() -> Vec<TestScene> {
    let mut all = vec![
        TestScene {
            shape: TestShape::Sphere,
            world_from_model: placed([0.0, 0.0, -2.0], [0.0; 3], [0.5; 3]),
            eye: Vec3::new(0.0, 0.0, 0.0),
            target: Vec3::new(0.0, 0.0, -2.0),
            ..base("lab", "check-scene-lab")
        },
        TestScene {
            world_from_model: placed([0.4, -0.3, -0.6], [35.0, 50.0, 20.0], [0.6, 1.2, 0.3]),
            eye: Vec3::new(1.9, 1.1, 2.0),
            target: Vec3::new(0.4, -0.3, -0.6),
            fov_y_rad: 0.42,
            light: TestLight { position: Vec3::new(1.6, 2.2, 1.2), ..LAB_LIGHT },
            ..base("stretched", "check-scene-stretched")
        },
        TestScene {
            shape: TestShape::Sphere,
            world_from_model: placed([-0.3, 0.2, 0.1], [10.0, 20.0, 0.0], [0.5; 3]),
            eye: Vec3::new(0.5, 0.5, 1.6),
            target: Vec3::new(-0.3, 0.2, 0.1),
            light: TestLight {
                position: Vec3::new(0.5, 0.8, 0.9),
                // Elsewhere the constant is 1, by which nothing needs to be divided.
                attenuation: [0.7, 0.2, 0.1],
                ..LAB_LIGHT
            },
            ..base("coarse", "check-scene-coarse")
        },
        TestScene {
            world_from_model: placed([-0.2, 0.1, -0.3], [-60.0, 10.0, 0.0], [0.9; 3]),
            eye: Vec3::new(0.3, 0.9, 2.4),
            target: Vec3::new(-0.2, 0.1, -0.3),
            light: TestLight { position: Vec3::new(-1.2, 1.0, -2.2), ambient: 0.25, ..LAB_LIGHT },
            shininess: 6.0,
            roughness: 0.5,
            ..base("behind", "check-scene-behind")
        },
    ];
    for (name, distance) in [("near", 1.5_f32), ("middle", 3.5), ("far", 8.0)] {
        let direction = Vec3::new(0.55, 0.6, 0.58).normalize();
        all.push(TestScene {
            world_from_model: placed([0.2, 0.1, 0.0], [60.0, 15.0, 0.0], [0.8; 3]),
            eye: Vec3::new(-0.4, 0.6, 2.5),
            target: Vec3::new(0.2, 0.1, 0.0),
            light: TestLight { position: Vec3::new(0.2, 0.1, 0.0) + direction * distance, ambient: 0.35, ..LAB_LIGHT },
            ..base(name, "check-scene-distances")
        });
    }
    all.push(TestScene {
        world_from_model: placed([0.6, 0.4, -0.5], [20.0, -40.0, 30.0], [0.7, 0.5, 0.9]),
        eye: Vec3::new(-1.6, -0.9, -2.2),
        target: Vec3::new(0.6, 0.4, -0.5),
        up: Vec3::new(0.5, 1.0, 0.2),
        fov_y_rad: 0.5,
        light: TestLight { position: Vec3::new(-1.5, 1.2, -2.0), ..LAB_LIGHT },
        ..base("turned", "check-scene-turned")
    });
    all.push(TestScene {
        shape: TestShape::Sphere,
        world_from_model: placed([-0.5, -0.4, -0.4], [0.0, 30.0, 40.0], [0.5, 0.8, 0.6]),
        eye: Vec3::new(0.4, -0.2, 2.2),
        target: Vec3::new(-0.5, -0.4, -0.4),
        // The other scenes do not tell the diffuse strength from a multiple of the specular one.
        light: TestLight {
            position: Vec3::new(1.2, 0.6, 1.4),
            ambient: 0.2,
            diffuse: 0.65,
            specular: 0.5,
            ..LAB_LIGHT
        },
        material: Vec3::new(0.85, 0.4, 0.15),
        shininess: 12.0,
        roughness: 0.4,
        ..base("coloured", "check-scene-coloured")
    });
    // The scenes that distinguish most come first: hypotheses are ranked in them.
    const TELLING: [&str; 4] = ["stretched", "coarse", "behind", "far"];
    all.sort_by_key(|s| TELLING.iter().position(|name| *name == s.name).unwrap_or(TELLING.len()));
    all
}

/// Returns the scenes for programs with several lights: two lights with different positions and strengths, and the
/// second one alone.
pub fn lit_by_two() -> Vec<TestScene> {
    let other =
        TestLight { position: Vec3::new(-1.3, 0.4, 1.5), ambient: 0.04, diffuse: 0.35, specular: 0.6, ..LAB_LIGHT };
    let both = TestScene {
        world_from_model: placed([0.4, -0.3, -0.6], [35.0, 50.0, 20.0], [0.7, 1.0, 0.5]),
        eye: Vec3::new(1.4, 0.7, 2.2),
        target: Vec3::new(0.4, -0.3, -0.6),
        fov_y_rad: 0.5,
        light: TestLight { position: Vec3::new(1.9, 1.2, 0.6), ..LAB_LIGHT },
        other: Some(other),
        shininess: 8.0,
        roughness: 0.45,
        ..base("two lights", "check-scene-two-lights")
    };
    let mut second = both.clone();
    second.name = "second light".to_owned();
    second.shows = "check-scene-second-light";
    second.light = TestLight { brightness: 0.0, ..second.light.dark() };
    vec![both, second]
}

/// Returns the scenes with one term alone, for verdicts on single terms, if strengths are inputs.
pub fn isolated(whole: &[TestScene]) -> Vec<TestScene> {
    let mut all = Vec::new();
    for test_scene in whole.iter().filter(|s| ["stretched", "behind", "turned"].contains(&s.name.as_str())) {
        for (term, kept) in [("ambient", [1.0, 0.0, 0.0]), ("diffuse", [0.0, 1.0, 0.0]), ("specular", [0.0, 0.0, 1.0])]
        {
            let mut alone = test_scene.clone();
            alone.name = format!("{}, {term} alone", test_scene.name);
            alone.shows = "check-scene-one-term";
            let light = &mut alone.light;
            light.ambient *= kept[0];
            light.diffuse *= kept[1];
            light.specular *= kept[2];
            all.push(alone);
        }
    }
    all
}

/// Returns the scenes for mirrors and glass. Those that distinguish most come first: roles are found in the first one.
pub fn mirrored() -> Vec<TestScene> {
    vec![
        TestScene {
            world_from_model: placed([0.4, -0.3, -0.6], [35.0, 50.0, 20.0], [0.6, 1.2, 0.3]),
            eye: Vec3::new(1.9, 1.1, 2.0),
            target: Vec3::new(0.4, -0.3, -0.6),
            ..base("stretched", "check-scene-stretched")
        },
        TestScene {
            shape: TestShape::Sphere,
            world_from_model: placed([-1.5, 0.8, 0.6], [10.0, 20.0, 0.0], [0.5; 3]),
            eye: Vec3::new(-0.7, 0.3, 2.6),
            target: Vec3::new(-1.5, 0.8, 0.6),
            ..base("coarse", "check-scene-coarse-mirror")
        },
        TestScene {
            world_from_model: placed([0.6, 0.4, -0.5], [20.0, -40.0, 30.0], [0.7, 0.5, 0.9]),
            eye: Vec3::new(-1.6, -0.9, -2.2),
            target: Vec3::new(0.6, 0.4, -0.5),
            up: Vec3::new(0.5, 1.0, 0.2),
            refraction_index: 1.33,
            ..base("turned", "check-scene-turned")
        },
        TestScene { shape: TestShape::Sphere, ..base("front", "check-scene-front") },
    ]
}

/// Returns the scenes for skyboxes: cameras with several directions, and one that has moved.
pub fn skies() -> Vec<TestScene> {
    let sky = |name: &str, shows, eye: [f32; 3], towards: [f32; 3], up: [f32; 3]| TestScene {
        shape: TestShape::Cube,
        eye: eye.into(),
        target: Vec3::from(eye) + Vec3::from(towards),
        up: up.into(),
        fov_y_rad: 1.2,
        ..base(name, shows)
    };
    vec![
        sky("ahead", "check-scene-sky-ahead", [0.0; 3], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]),
        sky("right", "check-scene-sky-right", [0.0; 3], [1.0, 0.2, -0.3], [0.0, 1.0, 0.0]),
        sky("moved", "check-scene-sky-moved", [0.5, 0.3, 0.4], [-0.6, 0.4, 0.8], [0.0, 1.0, 0.0]),
        sky("up", "check-scene-sky-up", [-3.0, 1.0, 2.0], [0.3, 1.0, 0.2], [0.4, 0.0, -1.0]),
    ]
}

/// Returns the scenes for cameras: rotated, from above, tilted, off centre, with model matrices far from the
/// identity.
pub fn cameras() -> Vec<TestScene> {
    let model = placed([0.3, -0.2, -0.4], [40.0, 25.0, 15.0], [0.8, 1.1, 0.6]);
    let camera = |name: &str, shows, eye: [f32; 3], target: [f32; 3], up: [f32; 3]| TestScene {
        shape: TestShape::Landmarks,
        world_from_model: model,
        eye: eye.into(),
        target: target.into(),
        up: up.into(),
        fov_y_rad: FOV_Y_RAD,
        ..base(name, shows)
    };
    vec![
        camera("turned", "check-scene-camera-turned", [1.1, 0.7, 1.0], [0.2, -0.1, -0.4], [0.0, 1.0, 0.0]),
        TestScene {
            world_from_model: placed([-0.4, 0.2, 0.1], [-70.0, 10.0, -30.0], [0.7; 3]),
            ..camera("above", "check-scene-camera-above", [-0.7, 1.4, 0.5], [-0.3, 0.1, 0.1], [0.0, 1.0, 0.0])
        },
        camera("tilted", "check-scene-camera-tilted", [-0.9, -0.5, -1.2], [0.5, 0.2, -0.3], [0.48, 0.8, 0.36]),
        TestScene {
            world_from_model: placed([2.0, -1.1, 0.6], [15.0, -35.0, 60.0], [0.9, 0.6, 1.2]),
            ..camera("off centre", "check-scene-camera-off-centre", [2.6, -0.2, 1.7], [2.3, -0.9, 0.2], [0.0, 1.0, 0.0])
        },
        TestScene {
            shape: TestShape::Pyramid,
            world_from_model: Mat4::IDENTITY,
            ..camera("lab", "check-scene-camera-lab", [0.0, 0.0, 2.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0])
        },
        TestScene {
            shape: TestShape::Pyramid,
            world_from_model: Mat4::IDENTITY,
            ..camera(
                "to the right",
                "check-scene-camera-to-the-right",
                [0.5, 0.0, 2.0],
                [0.5, 0.0, 1.0],
                [0.0, 1.0, 0.0],
            )
        },
        TestScene {
            world_from_model: placed([0.1, 0.3, -0.2], [200.0, 0.0, 0.0], [1.0, 1.0, 1.0]),
            ..camera("behind", "check-scene-camera-behind", [-0.6, -0.7, -1.5], [0.0, 0.6, -0.1], [0.0, 1.0, 0.0])
        },
        TestScene {
            world_from_model: placed([0.0, 0.1, 0.0], [30.0, 0.0, 0.0], [0.5; 3]),
            ..camera("close", "check-scene-camera-close", [0.5, 0.3, 0.7], [-0.4, -0.1, -0.5], [0.0, 1.0, 0.0])
        },
    ]
}

/// Returns the view of a cubemap's face, in OpenGL's order: 90 degrees, from the origin.
pub fn face(face: usize) -> TestScene {
    let (ahead, up) = match face {
        0 => (Vec3::X, Vec3::NEG_Y),
        1 => (Vec3::NEG_X, Vec3::NEG_Y),
        2 => (Vec3::Y, Vec3::Z),
        3 => (Vec3::NEG_Y, Vec3::NEG_Z),
        4 => (Vec3::Z, Vec3::NEG_Y),
        _ => (Vec3::NEG_Z, Vec3::NEG_Y),
    };
    TestScene {
        shape: TestShape::Cube,
        eye: Vec3::ZERO,
        target: ahead,
        up,
        fov_y_rad: std::f32::consts::FRAC_PI_2,
        ..base("face", "check-scene-face")
    }
}

/// The vertical field of view: 45 radians, which the lab passes, equal 58.3 degrees.
const FOV_Y_RAD: f32 = 1.0177;
