//! The ranges of a scene's values. Scenes from TOML and scenes that the command line or the window has changed pass the
//! same checks.

use crate::scene_file::{
    CameraSpec, EnvironmentSpec, EquationSpec, LightSourceKind, LightSpec, MaterialOverride, MotionKind, MotionSpec,
    ObjectSpec, PictureSpec, SceneFile,
};
use glam::DVec3;
use gonio_bsdf::ModelSpec;
use gonio_light::Spectrum;
use gonio_light::vector::unit;
use gonio_mesh::{Cause, ReadError};

/// Most pixels along one side of a picture.
pub const MAX_SIDE: u32 = 16384;
/// Most pixels of a picture: one float picture of it has 1 GiB.
pub const MAX_PIXELS: u64 = 1 << 26;
/// Coordinates and lengths are at most this, so that their squares are finite also in `f32`.
pub const MAX_LENGTH: f64 = 1e15;

/// A value that is out of its range.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InvalidValue {
    /// The path of the key: `camera.fov_y`, `light[0].motion.period`.
    pub path: String,
    /// One sentence that names the key.
    pub message: String,
    /// The cause, where a setting of the program can remove it.
    pub cause: Option<Cause>,
}

impl From<InvalidValue> for ReadError {
    fn from(problem: InvalidValue) -> Self {
        ReadError { cause: problem.cause, ..ReadError::new(problem.message) }
    }
}

impl std::fmt::Display for InvalidValue {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for InvalidValue {}

type Check = Result<(), InvalidValue>;

/// Checks all values of `scene`; the error is about the first that is out of its range.
pub fn check(scene: &SceneFile) -> Check {
    check_picture(&scene.picture)?;
    check_camera(&scene.camera)?;
    check_equation(&scene.equation)?;
    if let Some(environment) = &scene.environment {
        check_environment(environment)?;
    }
    for (key, color) in [("top", scene.background.top), ("bottom", scene.background.bottom)] {
        check_color("background", key, Some(color.0))?;
    }
    if scene.objects.is_empty() {
        return fail(
            "",
            "",
            "the scene has no object; add [[object]] with model = \"FILE.obj\" or \"builtin:suzanne\"",
        );
    }
    for (i, object) in scene.objects.iter().enumerate() {
        check_object(&format!("object[{i}]"), object)?;
    }
    for (i, light) in scene.lights.iter().enumerate() {
        check_light(&format!("light[{i}]"), light)?;
    }
    Ok(())
}

fn check_picture(p: &PictureSpec) -> Check {
    for (key, side) in [("width", p.width), ("height", p.height)] {
        if side == 0 || side > MAX_SIDE {
            return fail("picture", key, format!("`{key}` of the picture must be 1 to {MAX_SIDE} pixels, not {side}"));
        }
    }
    if u64::from(p.width) * u64::from(p.height) > MAX_PIXELS {
        let (w, h) = (p.width, p.height);
        return fail("picture", "width", format!("a picture of {w}x{h} is too large; at most {MAX_PIXELS} pixels"));
    }
    if ![1, 2, 4, 8, 16].contains(&p.samples) {
        return fail("picture", "samples", format!("`samples` must be 1, 2, 4, 8 or 16, not {}", p.samples));
    }
    if !(-64.0..=64.0).contains(&p.exposure) {
        return fail("picture", "exposure", format!("`exposure` must be -64 to 64 stops, not {}", p.exposure));
    }
    Ok(())
}

fn check_camera(c: &CameraSpec) -> Check {
    let at = "camera";
    check_point(at, "position", c.position)?;
    check_point(at, "target", c.target)?;
    check_direction(at, "up", c.up)?;
    if let (Some(_), Some((key, _))) =
        (c.target, [("yaw", c.yaw), ("pitch", c.pitch)].iter().find(|(_, v)| v.is_some()))
    {
        let message = format!("the camera has both `target` and `{key}`; it looks at a target or along yaw and pitch");
        return fail(at, key, message);
    }
    if let (Some(position), Some(target)) = (c.position, c.target)
        && unit(DVec3::from(target) - DVec3::from(position)).is_none()
    {
        return fail(at, "target", "the camera's `target` is its `position`; it must look somewhere");
    }
    check_number(at, "yaw", c.yaw, |v| v.is_finite(), "must be finite, in degrees")?;
    check_number(at, "pitch", c.pitch, |v| (-90.0..=90.0).contains(&v), "must be -90 to 90 degrees")?;
    let fov = "must be greater than 0 and less than 180 degrees";
    check_number(at, "fov_y", c.fov_y, |v| v > 0.0 && v < 180.0, fov)?;
    let distance = "must be greater than 0 and finite";
    check_number(at, "near", c.near, |v| v > 0.0 && v <= MAX_LENGTH, distance)?;
    check_number(at, "far", c.far, |v| v > 0.0 && v <= MAX_LENGTH, distance)?;
    if let (Some(near), Some(far)) = (c.near, c.far)
        && near >= far
    {
        return fail(at, "far", format!("`far` must be greater than `near`, but {far} is not greater than {near}"));
    }
    Ok(())
}

fn check_equation(e: &EquationSpec) -> Check {
    if e.lafortune.iter().any(|v| !v.is_finite() || v.abs() > 1e6) {
        return fail("equation", "lafortune", "`lafortune` must be three finite numbers");
    }
    Ok(())
}

fn check_object(at: &str, o: &ObjectSpec) -> Check {
    if o.model.trim().is_empty() {
        return fail(at, "model", "this object needs `model`, a file or `builtin:NAME`");
    }
    check_point(at, "translate", Some(o.translate))?;
    check_point(at, "rotate", Some(o.rotate))?;
    check_point(at, "scale", Some(o.scale))?;
    if o.scale.contains(&0.0) {
        return fail(at, "scale", "`scale` must not be 0 along any axis; a flat model has no inside to light");
    }
    check_number(at, "crease_angle", o.crease_angle, |v| (0.0..=180.0).contains(&v), "must be 0 to 180 degrees")?;
    if let Some(motion) = &o.motion {
        check_motion(at, motion)?;
        let first = motion.points.as_ref().and_then(|p| p.first());
        if first.is_some_and(|first| ![*first, [0.0; 3]].contains(&o.translate)) {
            let message =
                "an object on a path starts at the first of `points`; leave `translate` out or make it the same";
            return fail(at, "translate", message);
        }
    }
    check_material(&format!("{at}.material"), &o.material)?;
    o.parts.iter().try_for_each(|(name, material)| check_material(&format!("{at}.parts.{name}"), material))
}

/// Most texels along an edge of a cubemap.
pub const MAX_CUBEMAP_SIZE: u32 = 8192;

fn check_environment(e: &EnvironmentSpec) -> Check {
    let at = "environment";
    if e.image.trim().is_empty() {
        let message = "the environment needs `image`: debug, sky, room, a picture or a folder of six faces".to_owned();
        return Err(InvalidValue { path: at.to_owned(), message, cause: Some(Cause::NoEnvironment) });
    }
    if let Some(size) = e.size.filter(|size| !(1..=MAX_CUBEMAP_SIZE).contains(size)) {
        return fail(at, "size", format!("`size` must be 1 to {MAX_CUBEMAP_SIZE} texels, not {size}"));
    }
    check_point(at, "rotate", Some(e.rotate))?;
    let intensity = "must be 0 to 1000000";
    check_number(at, "intensity", Some(e.intensity), |v| (0.0..=1e6).contains(&v), intensity)?;
    check_number(at, "blur", Some(e.blur), |v| (0.0..=1.0).contains(&v), "must be 0 to 1")
}

pub(crate) fn check_material(at: &str, m: &MaterialOverride) -> Check {
    for (key, color) in
        [("ambient", m.ambient), ("diffuse", m.diffuse), ("specular", m.specular), ("emitted", m.emitted)]
    {
        check_color(at, key, color.map(|c| c.0))?;
    }
    check_spectrum(at, "diffuse_spectrum", m.diffuse_spectrum.as_deref(), 1.0)?;
    if m.diffuse.is_some() && m.diffuse_spectrum.is_some() {
        let message = "the material has both `diffuse` and `diffuse_spectrum`; leave one of them out";
        return fail(at, "diffuse_spectrum", message);
    }
    check_number(at, "shininess", m.shininess, |v| (1.0..=1e6).contains(&v), "must be 1 to 1000000")?;
    let index = "must be greater than 0 and at most 100";
    check_number(at, "refraction_index", m.refraction_index, |v| v > 0.0 && v <= 100.0, index)?;
    for (key, share) in [("opacity", m.opacity), ("reflectivity", m.reflectivity), ("transmission", m.transmission)] {
        check_number(at, key, share, |v| (0.0..=1.0).contains(&v), "must be 0 to 1")?;
    }
    for (key, color) in [("tint", m.tint), ("absorption", m.absorption)] {
        check_color(at, key, color.map(|c| c.0))?;
    }
    if m.tint.is_some_and(|t| t.0.iter().any(|v| *v > 1.0)) {
        return fail(
            at,
            "tint",
            "`tint` must be 0 to 1 in each channel: a body cannot transmit more light than it receives",
        );
    }
    if let Some(Err(error)) = m.brdf.as_deref().map(ModelSpec::parse) {
        return fail(at, "brdf", error.to_string());
    }
    if m.brdf.is_some() && m.brdf_file.is_some() {
        return fail(at, "brdf_file", "the material has both `brdf` and `brdf_file`; leave one of them out");
    }
    check_number(at, "dispersion", m.dispersion, |v| (-1.0..=1.0).contains(&v), "must be -1 to 1")
}

/// Checks one light, whose path is `at` (for example `light[0]`).
pub fn check_light(at: &str, l: &LightSpec) -> Check {
    use LightSourceKind::{Ambient, Directional, Point, Rectangle, Spot};
    let (has_position, has_direction) = (l.kind.has_position(), l.kind.has_direction());
    let given = [
        ("position", l.position.is_some(), has_position),
        ("direction", l.direction.is_some(), has_direction),
        ("radius", l.radius.is_some(), l.kind.has_radius()),
        ("size", l.size.is_some(), l.kind == Rectangle),
        ("constant", l.constant.is_some(), has_position),
        ("linear", l.linear.is_some(), has_position),
        ("quadratic", l.quadratic.is_some(), has_position),
        ("inner_angle", l.inner_angle.is_some(), l.kind == Spot),
        ("outer_angle", l.outer_angle.is_some(), l.kind == Spot),
        ("motion", l.motion.is_some(), has_position),
    ];
    if let Some((key, ..)) = given.iter().find(|(_, given, belongs)| *given && !belongs) {
        let kind = l.kind;
        let (article, own) = match kind {
            Ambient => ("an", "color, intensity"),
            Directional => ("a", "direction, color, intensity"),
            Point => ("a", "position, radius, color, intensity, constant, linear, quadratic, motion"),
            Spot => (
                "a",
                "position, direction, radius, color, intensity, constant, linear, quadratic, inner_angle, outer_angle, \
                 motion",
            ),
            Rectangle => ("a", "position, direction, size, color, intensity, constant, linear, quadratic, motion"),
        };
        return fail(at, key, format!("`{key}` does not belong to {article} {kind} light; it takes kind, name, {own}"));
    }
    let path_begins = l.motion.as_ref().and_then(|m| m.points.as_ref()).and_then(|p| p.first());
    if has_position && l.position.is_none() && path_begins.is_none() {
        return fail(at, "", format!("this {} light needs `position`", l.kind));
    }
    if has_direction && l.direction.is_none() {
        return fail(at, "", format!("this {} light needs `direction`, the way its light travels", l.kind));
    }
    check_point(at, "position", l.position)?;
    check_direction(at, "direction", l.direction)?;
    let length = "must be 0 or more world units";
    check_number(at, "radius", l.radius, |v| (0.0..=MAX_LENGTH).contains(&v), length)?;
    if let Some(size) = l.size.filter(|size| !size.iter().all(|v| *v > 0.0 && *v <= MAX_LENGTH)) {
        let message =
            format!("`size` must be two lengths greater than 0, the rectangle's width and height, not {size:?}");
        return fail(at, "size", message);
    }
    check_color(at, "color", l.color.map(|c| c.0))?;
    check_spectrum(at, "spectrum", l.spectrum.as_deref(), 1e9)?;
    if let Some(samples) = &l.spectrum {
        if l.color.is_some() {
            return fail(at, "spectrum", "the light has both `color` and `spectrum`; leave one of them out");
        }
        if Spectrum::new(samples.clone()).color_of_light().is_none() {
            let message = "`spectrum` must have visible light: power between 380 and 780 nm at two wavelengths or more";
            return fail(at, "spectrum", message);
        }
    }
    for (key, value) in
        [("intensity", l.intensity), ("constant", l.constant), ("linear", l.linear), ("quadratic", l.quadratic)]
    {
        check_number(at, key, value, |v| (0.0..=MAX_LENGTH).contains(&v), "must be finite and not negative")?;
    }
    if l.constant == Some(0.0) && l.linear.unwrap_or(0.0) == 0.0 && l.quadratic.unwrap_or(0.0) == 0.0 {
        let message = "one of `constant`, `linear` and `quadratic` must be greater than 0: the light is divided by \
                       constant + linear d + quadratic d^2";
        return fail(at, "constant", message);
    }
    let angle = "must be 0 to 90 degrees (half of the cone)";
    check_number(at, "inner_angle", l.inner_angle, |v| (0.0..=90.0).contains(&v), angle)?;
    check_number(at, "outer_angle", l.outer_angle, |v| (0.0..=90.0).contains(&v), angle)?;
    if let (Some(inner), Some(outer)) = (l.inner_angle, l.outer_angle)
        && inner > outer
    {
        let message =
            format!("`inner_angle` must not be greater than `outer_angle`, but {inner} is greater than {outer}");
        return fail(at, "inner_angle", message);
    }
    if let Some(motion) = &l.motion {
        check_motion(at, motion)?;
    }
    if let (Some(first), Some(position)) = (path_begins, l.position)
        && *first != position
    {
        let message = "a light on a path starts at the first of `points`; leave `position` out or make it the same";
        return fail(at, "position", message);
    }
    Ok(())
}

/// Checks the motion of the light or the object whose path is `at`.
fn check_motion(at: &str, m: &MotionSpec) -> Check {
    let at = &format!("{at}.motion");
    let kind = m.kind;
    let given = [
        ("amplitude", m.amplitude.is_some(), kind == MotionKind::Oscillate),
        ("center", m.center.is_some(), kind == MotionKind::Circle),
        ("axis", m.axis.is_some(), kind == MotionKind::Circle),
        ("points", m.points.is_some(), kind == MotionKind::Path),
    ];
    if let Some((key, ..)) = given.iter().find(|(_, given, belongs)| *given && !belongs) {
        let own = match kind {
            MotionKind::Oscillate => "amplitude",
            MotionKind::Circle => "center, axis",
            MotionKind::Path => "points",
        };
        return fail(at, key, format!("`{key}` does not belong to the motion `{kind}`; it takes kind, period, {own}"));
    }
    let needed = match kind {
        MotionKind::Oscillate if m.amplitude.is_none() => Some("amplitude"),
        MotionKind::Circle if m.center.is_none() => Some("center"),
        MotionKind::Path if m.points.as_ref().is_none_or(Vec::is_empty) => Some("points"),
        _ => None,
    };
    if let Some(key) = needed {
        return fail(at, key, format!("the motion `{kind}` needs `{key}`"));
    }
    let period = "must be greater than 0, in seconds";
    check_number(at, "period", Some(m.period), |v| v > 0.0 && v <= MAX_LENGTH, period)?;
    check_point(at, "amplitude", m.amplitude)?;
    check_point(at, "center", m.center)?;
    check_direction(at, "axis", m.axis)?;
    for (i, point) in m.points.iter().flatten().enumerate() {
        check_point(at, "points", Some(*point)).map_err(|p| InvalidValue { path: format!("{at}.points[{i}]"), ..p })?;
    }
    Ok(())
}

fn fail(at: &str, key: &str, message: impl Into<String>) -> Check {
    let dot = if at.is_empty() || key.is_empty() { "" } else { "." };
    Err(InvalidValue { path: format!("{at}{dot}{key}"), message: message.into(), cause: None })
}

fn check_number(at: &str, key: &str, value: Option<f64>, allowed: impl Fn(f64) -> bool, range: &str) -> Check {
    match value {
        Some(v) if !allowed(v) => fail(at, key, format!("`{key}` {range}, not {v}")),
        _ => Ok(()),
    }
}

fn check_point(at: &str, key: &str, value: Option<[f64; 3]>) -> Check {
    match value {
        Some(v) if v.iter().any(|c| !c.is_finite()) => {
            fail(at, key, format!("`{key}` must have finite numbers, not {v:?}"))
        }
        Some(v) if v.iter().any(|c| c.abs() > MAX_LENGTH) => {
            fail(at, key, format!("`{key}` must stay within {MAX_LENGTH:e}, not {v:?}"))
        }
        _ => Ok(()),
    }
}

fn check_direction(at: &str, key: &str, value: Option<[f64; 3]>) -> Check {
    check_point(at, key, value)?;
    match value {
        Some(v) if unit(DVec3::from(v)).is_none() => {
            fail(at, key, format!("`{key}` is a direction and must not be zero"))
        }
        _ => Ok(()),
    }
}

/// Checks the samples of a spectrum whose values are at most `most`.
fn check_spectrum(at: &str, key: &str, samples: Option<&[[f64; 2]]>, most: f64) -> Check {
    let Some(samples) = samples else { return Ok(()) };
    let sample_at = |i: usize| format!("{key}[{i}]");
    for (i, [lambda, value]) in samples.iter().enumerate() {
        if !(300.0..=1000.0).contains(lambda) {
            let message = format!("`{key}` must have wavelengths of 300 to 1000 nm, not {lambda}");
            return fail(at, &sample_at(i), message);
        }
        if !(0.0..=most).contains(value) {
            return fail(at, &sample_at(i), format!("`{key}` must have values of 0 to {most}, not {value}"));
        }
    }
    if let Some(i) = (1..samples.len()).find(|&i| samples[i - 1][0] >= samples[i][0]) {
        let [before, after] = [samples[i - 1][0], samples[i][0]];
        let message = format!("`{key}` must have rising wavelengths, but {after} follows {before}");
        return fail(at, &sample_at(i), message);
    }
    if samples.iter().all(|[_, value]| *value == 0.0) {
        return fail(at, key, format!("`{key}` must have a value greater than 0"));
    }
    Ok(())
}

fn check_color(at: &str, key: &str, value: Option<[f64; 3]>) -> Check {
    match value {
        Some(v) if v.iter().any(|c| !(0.0..=MAX_LENGTH).contains(c)) => {
            fail(at, key, format!("`{key}` is a colour: its numbers must be finite and not negative"))
        }
        _ => Ok(()),
    }
}
