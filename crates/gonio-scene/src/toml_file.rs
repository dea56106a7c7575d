//! Scene files as TOML, read and written, and their JSON Schema.

use crate::scene_file::{
    BackgroundSpec, CameraSpec, EnvironmentSpec, EquationSpec, LightSourceKind, LightSpec, MaterialOverride,
    MotionKind, MotionSpec, ObjectSpec, PictureSpec, SceneFile,
};
use crate::toml_table::{Fault, TableReader, TomlItem, parse_toml};
use crate::validate;
use gonio_mesh::ReadError;
use schemars::generate::SchemaSettings;

/// Reads and checks a scene. Errors have line and column; the caller adds the file's name.
pub fn read(text: &str) -> Result<SceneFile, ReadError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    read_document(text).map_err(|fault| fault.in_text(text))
}

fn read_document(text: &str) -> Result<SceneFile, Fault> {
    let root = parse_toml(text)?;
    let scene = read_scene(&root)?;
    validate::check(&scene).map_err(|p| Fault::at(&root.locate(&p.path), p.message))?;
    Ok(scene)
}

fn read_scene(root: &TomlItem) -> Result<SceneFile, Fault> {
    let mut t = TableReader::new("a scene", root)?;
    let picture = t.table("picture", "[picture]")?;
    let camera = t.table("camera", "[camera]")?;
    let background = t.table("background", "[background]")?;
    let environment = t.table("environment", "[environment]")?;
    let equation = t.table("equation", "[equation]")?;
    let objects = t.tables("object")?;
    let lights = t.tables("light")?;
    t.finish()?;
    Ok(SceneFile {
        picture: picture.map_or(Ok(PictureSpec::default()), read_picture)?,
        camera: camera.map_or(Ok(CameraSpec::default()), read_camera)?,
        background: background.map_or(Ok(BackgroundSpec::default()), read_background)?,
        environment: environment.map(read_environment).transpose()?,
        equation: equation.map_or(Ok(EquationSpec::default()), read_equation)?,
        objects: objects.into_iter().map(read_object).collect::<Result<_, _>>()?,
        lights: lights.into_iter().map(read_light).collect::<Result<_, _>>()?,
    })
}

fn read_picture(mut t: TableReader<'_>) -> Result<PictureSpec, Fault> {
    let d = PictureSpec::default();
    let picture = PictureSpec {
        width: t.whole("width")?.unwrap_or(d.width),
        height: t.whole("height")?.unwrap_or(d.height),
        samples: t.whole("samples")?.unwrap_or(d.samples),
        color: t.word("color")?.unwrap_or(d.color),
        tone_map: t.word("tone_map")?.unwrap_or(d.tone_map),
        exposure: t.number("exposure")?.unwrap_or(d.exposure),
        texture_filter: t.word("texture_filter")?.unwrap_or(d.texture_filter),
    };
    t.finish().map(|()| picture)
}

fn read_camera(mut t: TableReader<'_>) -> Result<CameraSpec, Fault> {
    let camera = CameraSpec {
        position: t.vector("position")?,
        target: t.vector("target")?,
        yaw: t.number("yaw")?,
        pitch: t.number("pitch")?,
        up: t.vector("up")?,
        from_model: t.text("from_model")?,
        fov_y: t.number("fov_y")?,
        near: t.number("near")?,
        far: t.number("far")?,
    };
    t.finish().map(|()| camera)
}

fn read_background(mut t: TableReader<'_>) -> Result<BackgroundSpec, Fault> {
    let d = BackgroundSpec::default();
    let (top, bottom) = (t.color("top")?, t.color("bottom")?);
    let background = BackgroundSpec {
        // One colour alone is the whole background's.
        top: top.or(bottom).unwrap_or(d.top),
        bottom: bottom.or(top).unwrap_or(d.bottom),
        transparent: t.truth("transparent")?.unwrap_or(d.transparent),
    };
    t.finish().map(|()| background)
}

fn read_environment(mut t: TableReader<'_>) -> Result<EnvironmentSpec, Fault> {
    let d = EnvironmentSpec::default();
    let environment = EnvironmentSpec {
        image: t.text("image")?.unwrap_or_default(),
        layout: t.word("layout")?,
        size: t.whole("size")?,
        rotate: t.vector("rotate")?.unwrap_or(d.rotate),
        intensity: t.number("intensity")?.unwrap_or(d.intensity),
        light: t.truth("light")?,
        visible: t.truth("visible")?.unwrap_or(d.visible),
        blur: t.number("blur")?.unwrap_or(d.blur),
        background: t.text("background")?,
    };
    t.finish().map(|()| environment)
}

fn read_equation(mut t: TableReader<'_>) -> Result<EquationSpec, Fault> {
    let d = EquationSpec::default();
    let equation = EquationSpec {
        convention: t.word("convention")?.unwrap_or(d.convention),
        specular: t.word("specular")?.unwrap_or(d.specular),
        brdf: t.word("brdf")?,
        brdf_normalised: t.truth("brdf_normalised")?.unwrap_or(d.brdf_normalised),
        lafortune: t.vector("lafortune")?.unwrap_or(d.lafortune),
        gated: t.truth("gated")?.unwrap_or(d.gated),
        cosine_weighted: t.truth("cosine_weighted")?,
        shadows: t.truth("shadows")?,
        two_sided: t.truth("two_sided")?.unwrap_or(d.two_sided),
        ambient: t.truth("ambient")?.unwrap_or(d.ambient),
        emitted: t.truth("emitted")?.unwrap_or(d.emitted),
        diffuse: t.truth("diffuse")?.unwrap_or(d.diffuse),
        specular_term: t.truth("specular_term")?.unwrap_or(d.specular_term),
        attenuation: t.truth("attenuation")?.unwrap_or(d.attenuation),
        spot: t.truth("spot")?.unwrap_or(d.spot),
    };
    t.finish().map(|()| equation)
}

fn read_object(mut t: TableReader<'_>) -> Result<ObjectSpec, Fault> {
    let d = ObjectSpec::default();
    let material = t.table("material", "[object.material]")?;
    let parts = t.tables_by_name("parts", "[object.parts]")?;
    let object = ObjectSpec {
        model: t.text("model")?.unwrap_or_default(),
        name: t.text("name")?.unwrap_or_default(),
        up: t.word("up")?.unwrap_or(d.up),
        translate: t.vector("translate")?.unwrap_or(d.translate),
        rotate: t.vector("rotate")?.unwrap_or(d.rotate),
        scale: t.vector("scale")?.unwrap_or(d.scale),
        shading: t.word("shading")?.unwrap_or(d.shading),
        normals: t.word("normals")?.unwrap_or(d.normals),
        crease_angle: t.number("crease_angle")?,
        motion: t.table("motion", "[object.motion]")?.map(read_motion).transpose()?,
        material: material.map_or(Ok(d.material), read_material)?,
        parts: parts.into_iter().map(|(name, part)| Ok((name, read_material(part)?))).collect::<Result<_, Fault>>()?,
    };
    t.finish().map(|()| object)
}

pub(crate) fn read_material(mut t: TableReader<'_>) -> Result<MaterialOverride, Fault> {
    let material = MaterialOverride {
        ambient: t.color("ambient")?,
        diffuse: t.color("diffuse")?,
        diffuse_spectrum: t.spectrum("diffuse_spectrum")?,
        specular: t.color("specular")?,
        emitted: t.color("emitted")?,
        shininess: t.number("shininess")?,
        refraction_index: t.number("refraction_index")?,
        opacity: t.number("opacity")?,
        textures: t.truth("textures")?,
        medium: t.word("medium")?,
        reflectivity: t.number("reflectivity")?,
        transmission: t.number("transmission")?,
        fresnel: t.word("fresnel")?,
        tint: t.color("tint")?,
        absorption: t.color("absorption")?,
        brdf: t.text("brdf")?,
        brdf_file: t.text("brdf_file")?,
        dispersion: t.number("dispersion")?,
        surfaces: t.word("surfaces")?,
    };
    t.finish().map(|()| material)
}

/// Also reads an option's text, whose `heading` differs.
pub(crate) fn read_light(mut t: TableReader<'_>) -> Result<LightSpec, Fault> {
    let kind = t.word("kind")?;
    let light = LightSpec {
        kind: kind.unwrap_or_default(),
        name: t.text("name")?.unwrap_or_default(),
        enabled: t.truth("enabled")?,
        position: t.vector("position")?,
        direction: t.vector("direction")?,
        radius: t.number("radius")?,
        size: t.pair("size", "two numbers [width, height]")?,
        color: t.color("color")?,
        spectrum: t.spectrum("spectrum")?,
        intensity: t.number("intensity")?,
        constant: t.number("constant")?,
        linear: t.number("linear")?,
        quadratic: t.number("quadratic")?,
        inner_angle: t.number("inner_angle")?,
        outer_angle: t.number("outer_angle")?,
        motion: t.table("motion", "[light.motion]")?.map(read_motion).transpose()?,
    };
    t.finish()?;
    if kind.is_none() {
        return Err(Fault::at(&t.span, format!("this light needs `kind`, one of {}", names(LightSourceKind::ALL))));
    }
    Ok(light)
}

fn read_motion(mut t: TableReader<'_>) -> Result<MotionSpec, Fault> {
    let (kind, period) = (t.word("kind")?, t.number("period")?);
    let motion = MotionSpec {
        kind: kind.unwrap_or_default(),
        period: period.unwrap_or_default(),
        amplitude: t.vector("amplitude")?,
        center: t.vector("center")?,
        axis: t.vector("axis")?,
        points: t.vectors("points")?,
    };
    t.finish()?;
    if kind.is_none() {
        return Err(Fault::at(&t.span, format!("this motion needs `kind`, one of {}", names(MotionKind::ALL))));
    }
    if period.is_none() {
        return Err(Fault::at(&t.span, "this motion needs `period`, in seconds"));
    }
    Ok(motion)
}

fn names<E: ToString>(all: &[E]) -> String {
    all.iter().map(E::to_string).collect::<Vec<_>>().join(", ")
}

impl SceneFile {
    /// The scene as a TOML file with a short heading. Every number is printed with as many digits as
    /// it takes to read the same number again.
    pub fn to_toml_string(&self) -> String {
        let body = match toml::to_string(self) {
            Ok(body) => body,
            // A scene has nothing that TOML lacks, which a test of every field checks.
            Err(error) => format!("# the scene could not be written: {error}\n"),
        };
        format!(
            "# A scene of gonio: `gonio render FILE.toml -o picture.png` draws it.\n\
             # Angles in degrees, lengths in world units, colours linear [r, g, b] or \"#rrggbb\" (sRGB).\n\n{body}"
        )
    }

    /// The JSON Schema of scene files, for editors.
    pub fn json_schema() -> serde_json::Value {
        let mut schema = SchemaSettings::draft07().into_generator().into_root_schema_for::<SceneFile>();
        schema.insert("title".into(), "A scene of gonio".into());
        schema.to_value()
    }
}
