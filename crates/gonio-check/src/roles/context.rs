//! Determines the roles of a shader's variables together: each by its own name first, then by what the others leave
//! open.

use super::lights::{Place, light_indices};
use super::role::Role;
use super::rules::{self, Shape, shape};
use super::words::Words;
use super::{Declared, How, VariableKind};

/// A variable with its parsed name.
struct Read<'a> {
    declared: &'a Declared,
    shape: Shape,
    words: Words,
    light: Place,
    found: Option<(Role, How)>,
    open: bool,
}

impl<'a> Read<'a> {
    fn new(declared: &'a Declared) -> Self {
        let shape = shape(&declared.glsl_type);
        let name = declared.name.strip_suffix("[0]").unwrap_or(&declared.name);
        let mut parts: Vec<&str> = name.split('.').collect();
        let field = parts.pop().unwrap_or_default();
        let (field_name, mut bracket) = without_index(field);
        let mut words = Words::split(field_name);
        let mut light = Place { number: words.number, ..Place::default() };
        for part in parts.into_iter().rev().take(4) {
            let (part, index) = without_index(part);
            bracket = bracket.or(index);
            let of_part = Words::split(part);
            if of_part.has("light") {
                light.group = part.trim_end_matches(|c: char| c.is_ascii_digit() || c == '_').to_owned();
                light.number = of_part.number.or(light.number);
            }
            inherit(&mut words, &of_part, shape);
        }
        light.bracket = bracket;
        let lower = name.to_lowercase();
        light.is_another = ["other", "second", "autre", "zweit", "extra"].iter().any(|word| lower.contains(word));
        if shape != Shape::Matrix && (words.has("mat") || words.has("object")) {
            words.tokens.push("material");
        }
        Self { declared, shape, words, light, found: None, open: true }
    }

    fn is(&self, role: Role) -> bool {
        self.found.is_some_and(|(found, _)| found.with_light(0) == role)
    }

    fn has_only(&self, tokens: &[&str]) -> bool {
        !self.words.tokens.is_empty() && self.words.tokens.iter().all(|token| tokens.contains(token))
    }
}

/// Splits a name into the part before its index and the index.
fn without_index(part: &str) -> (&str, Option<u32>) {
    match part.split_once('[') {
        Some((name, index)) => (name, index.trim_end_matches(']').parse().ok()),
        None => (part, None),
    }
}

/// Adds the words of a struct's name to those of its field.
fn inherit(words: &mut Words, container: &Words, shape: Shape) {
    // `fog.color` is not the object's colour.
    if container.has("blocked") && !["light", "material", "camera"].iter().any(|known| container.has(known)) {
        words.tokens.push("blocked");
    }
    if shape == Shape::Matrix {
        // `camera.projection` is the projection alone; `camera.matrix` is the matrix of the camera.
        if !words.tokens.iter().any(|token| !matches!(*token, "matrix" | "mat")) {
            words.tokens.extend(container.tokens.iter().filter(|token| **token != "transform"));
        }
        return;
    }
    for token in ["light", "material", "camera", "view"] {
        let in_container =
            container.has(token) || token == "material" && (container.has("mat") || container.has("object"));
        if in_container && !words.has(token) {
            words.tokens.push(token);
            if token == "light" {
                words.tokens.push("struct");
            }
        }
    }
}

/// Returns the role of each variable. `given` are those of `names.toml`; variables that are not `open` are ignored.
pub(super) fn roles(declared: &[&Declared], given: &[Option<Role>], open: &[bool]) -> Vec<Option<(Role, How)>> {
    let mut all: Vec<Read<'_>> = declared.iter().map(|declared| Read::new(declared)).collect();
    for ((read, given), open) in all.iter_mut().zip(given).zip(open) {
        read.open = *open;
        read.found =
            if *open { by_name(read).map(|role| (role, How::Name)) } else { given.map(|r| (r, How::NamesFile)) };
    }
    intensities(&mut all);
    coefficients(&mut all);
    radiances(&mut all);
    attributes_by_type(&mut all);
    prefixed_matrices(&mut all);
    worlds(&mut all);
    matrices(&mut all);
    camera(&mut all);
    view(&mut all);
    terms(&mut all);
    samplers(&mut all);
    number_lights(&mut all);
    tints(&mut all);
    all.into_iter().map(|read| read.found).collect()
}

fn by_name(read: &Read<'_>) -> Option<Role> {
    match read.declared.kind {
        VariableKind::Attribute => rules::attribute(read.shape, &read.words),
        VariableKind::Uniform => rules::uniform(read.shape, &read.words, 0),
    }
}

/// Assigns roles to attributes with unclear names: the first vec3 is the position, the next the normal; a vec2 is the
/// texture coordinate.
fn attributes_by_type(all: &mut [Read<'_>]) {
    // `coords` with three components are those of the vertex.
    let is_place = |read: &&mut Read<'_>| {
        let has_three = matches!(read.declared.glsl_type.as_str(), "vec3" | "vec4");
        read.open && read.is(Role::TexCoord) && has_three && !read.words.has("tex") && !read.words.has("uv")
    };
    if !all.iter().any(|read| read.is(Role::Position))
        && let Some(read) = all.iter_mut().find(is_place)
    {
        read.found = Some((Role::Position, How::Use));
    }
    for role in [Role::Position, Role::Normal, Role::TexCoord] {
        if all.iter().any(|read| read.is(role)) {
            continue;
        }
        let fits = |read: &&mut Read<'_>| {
            let is_type = match role {
                Role::TexCoord => read.declared.glsl_type == "vec2",
                _ => matches!(read.declared.glsl_type.as_str(), "vec3" | "vec4"),
            };
            read.declared.kind == VariableKind::Attribute
                && read.open
                && read.found.is_none()
                && is_type
                && !read.words.has("blocked")
        };
        if let Some(read) = all.iter_mut().find(fits) {
            read.found = Some((role, How::Type));
        }
    }
}

/// Assigns roles to the intensities `Ia`, `Id` and `Is` of a light, which are clear together.
fn intensities(all: &mut [Read<'_>]) {
    const NAMES: [(&str, Role); 3] =
        [("Ia", Role::AmbientColor(0)), ("Id", Role::DiffuseColor(0)), ("Is", Role::SpecularColor(0))];
    let last = |read: &Read<'_>| {
        let field = read.declared.name.rsplit('.').next().unwrap_or_default();
        let field = without_index(field).0;
        field.strip_prefix("u_").or(field.strip_prefix('u')).unwrap_or(field).to_owned()
    };
    let is_uniform = |read: &Read<'_>| read.declared.kind == VariableKind::Uniform && read.shape == Shape::Vector;
    let count = NAMES.iter().filter(|(name, _)| all.iter().any(|read| is_uniform(read) && last(read) == *name)).count();
    if count < 2 {
        return;
    }
    for read in all.iter_mut().filter(|read| read.open && is_uniform(read)) {
        if let Some((_, role)) = NAMES.iter().find(|(name, _)| last(read) == *name) {
            read.found = Some((*role, How::Use));
        }
    }
}

/// Assigns the role of a light's colour to the radiance `Le` that it emits.
fn radiances(all: &mut [Read<'_>]) {
    for read in all.iter_mut() {
        let field = read.declared.name.rsplit_once('.').map(|(_, field)| field);
        if field == Some("Le") && read.open && read.shape == Shape::Vector && read.words.has("light") {
            read.found = Some((Role::LightColor(0), How::Use));
        }
    }
}

/// Assigns roles to the coefficients of an attenuation that are only numbered, `k0`, `k1` and `k2`: their names say the
/// degree.
fn coefficients(all: &mut [Read<'_>]) {
    let is_attenuation = |read: &Read<'_>| {
        let roles = [Role::AttenuationConstant(0), Role::AttenuationLinear(0), Role::AttenuationQuadratic(0)];
        roles.iter().any(|role| read.is(*role))
    };
    if all.iter().any(is_attenuation) {
        return;
    }
    let stem = |read: &Read<'_>, digit: char| -> Option<String> {
        let is_unclear = matches!(read.found, None | Some((Role::LightColor(_), How::Name)));
        let is_number = read.open && is_unclear && read.shape == Shape::Scalar;
        let stem = read.declared.name.strip_suffix(digit).filter(|_| is_number)?;
        let field = stem.rsplit(['.', '_']).find(|part| !part.is_empty()).unwrap_or(stem);
        let is_coefficient = field.len() == 1 && field.starts_with(['k', 'K', 'a', 'A', 'c', 'C']);
        (is_coefficient || read.words.has("attenuation")).then(|| stem.to_owned())
    };
    let stems: Vec<String> = all.iter().filter_map(|read| stem(read, '0')).collect();
    for of in stems {
        let places: Vec<usize> = ['0', '1', '2']
            .into_iter()
            .filter_map(|digit| all.iter().position(|read| stem(read, digit).as_ref() == Some(&of)))
            .collect();
        if let [constant, linear, quadratic] = places[..] {
            all[constant].found = Some((Role::AttenuationConstant(0), How::Use));
            all[linear].found = Some((Role::AttenuationLinear(0), How::Use));
            all[quadratic].found = Some((Role::AttenuationQuadratic(0), How::Use));
            for place in places {
                // The number is no light's.
                all[place].light.number = None;
            }
        }
    }
}

/// Treats `worldMatrix` beside `modelMatrix` as the view matrix if no other matrix is.
fn worlds(all: &mut [Read<'_>]) {
    let views = [Role::View, Role::ModelView, Role::ViewProjection, Role::ModelViewProjection];
    if all.iter().any(|read| views.iter().any(|role| read.is(*role))) {
        return;
    }
    let of = |read: &Read<'_>, word: &str| read.is(Role::Model) && read.words.has(word);
    if !all.iter().any(|read| of(read, "model") && !read.words.has("world")) {
        return;
    }
    for read in all.iter_mut().filter(|read| read.open && of(read, "world") && !read.words.has("model")) {
        read.found = Some((Role::View, How::Use));
    }
}

/// Of two inputs with the same meaning whose product is used, such as `ambientStrength * ambientColor` or
/// `objectColor * material.diffuse`, one has the value and the other is a tint.
fn tints(all: &mut [Read<'_>]) {
    let roles: Vec<Role> = all.iter().filter_map(|read| read.found.map(|(role, _)| role)).collect();
    let has_material = all.iter().any(|read| read.is(Role::MaterialDiffuse) && read.words.has("material"));
    for read in all.iter_mut().filter(|read| read.open && read.declared.kind == VariableKind::Uniform) {
        let Some((role, How::Name | How::Use)) = read.found else { continue };
        let is_double = match role {
            Role::AmbientColor(light) => roles.contains(&Role::AmbientStrength(light)),
            Role::DiffuseColor(light) => roles.contains(&Role::DiffuseStrength(light)),
            Role::SpecularColor(light) => roles.contains(&Role::SpecularStrength(light)),
            Role::MaterialColor => has_material,
            _ => false,
        };
        if is_double {
            read.found = Some((Role::Tint, How::Use));
        }
    }
}

/// Assigns roles to matrices that are called `mw`, `mv` and `mp`: their first letter only says that they are matrices.
fn prefixed_matrices(all: &mut [Read<'_>]) {
    const NAMES: [(&str, Role); 6] = [
        ("mm", Role::Model),
        ("mw", Role::Model),
        ("mv", Role::View),
        ("mp", Role::Projection),
        ("mn", Role::NormalMatrix),
        ("mwit", Role::NormalMatrix),
    ];
    let name = |read: &Read<'_>| {
        let is_matrix = read.open && read.shape == Shape::Matrix;
        is_matrix.then(|| read.declared.name.trim_start_matches("u_").to_lowercase())
    };
    let has = |asked: &str| all.iter().filter_map(name).any(|name| name == asked);
    if !(has("mp") && (has("mv") || has("mw") || has("mm"))) {
        return;
    }
    for read in all.iter_mut() {
        let role = name(read).and_then(|name| NAMES.iter().find(|(known, _)| *known == name));
        if let Some((_, role)) = role {
            read.found = Some((*role, How::Use));
        }
    }
}

fn matrices(all: &mut [Read<'_>]) {
    let has = |all: &[Read<'_>], roles: &[Role]| all.iter().any(|read| roles.iter().any(|role| read.is(*role)));
    // In three.js, `normalMatrix` beside `modelViewMatrix` belongs to that matrix.
    if has(all, &[Role::ModelView]) {
        for read in all.iter_mut().filter(|read| read.open && read.is(Role::NormalMatrix)) {
            let says_model = ["model", "world", "object", "m"].iter().any(|word| read.words.has(word));
            if !says_model && !read.words.letters.contains(&'m') {
                read.found = Some((Role::NormalMatrixOfModelView, How::Use));
            }
        }
    }
    // `camMatrix` without a projection beside it includes the projection.
    let projects = has(all, &[Role::Projection, Role::ViewProjection, Role::ModelViewProjection]);
    if !projects && has(all, &[Role::Model]) {
        for read in all.iter_mut().filter(|read| read.open && read.is(Role::View) && read.words.has("camera")) {
            read.found = Some((Role::ViewProjection, How::Use));
        }
    }
    // `transform` and `u_matrix` are the matrix that is missing among the others.
    let projects = has(all, &[Role::Projection, Role::ViewProjection, Role::ModelViewProjection]);
    let role = if projects { Role::Model } else { Role::ModelViewProjection };
    if has(all, &[role]) || !projects && has(all, &[Role::View, Role::ModelView]) {
        return;
    }
    if has(all, &[Role::ModelViewProjection, Role::ModelView]) {
        return;
    }
    let mut open = all.iter_mut().filter(|read| {
        let is_mat4 = read.declared.glsl_type == "mat4" && read.declared.kind == VariableKind::Uniform;
        is_mat4 && read.open && read.found.is_none() && read.has_only(&["matrix", "mat", "transform", "trans"])
    });
    if let (Some(read), None) = (open.next(), open.next()) {
        read.found = Some((role, How::Use));
    }
}

/// Assigns roles to `Position`, `Front`, `Up`, `Right` and `WorldUp` of a camera: names that are unclear alone and
/// clear together.
fn camera(all: &mut [Read<'_>]) {
    let has = |all: &[Read<'_>], role: Role| all.iter().any(|read| read.is(role));
    let axes = [Role::ViewFront, Role::WorldUp, Role::ViewRight, Role::ViewTarget];
    if !axes.iter().any(|axis| has(all, *axis)) {
        return;
    }
    let lone = [
        ("pos", Role::ViewPos),
        ("from", Role::ViewPos),
        ("dir", Role::ViewFront),
        ("to", Role::ViewTarget),
        ("centre", Role::ViewTarget),
    ];
    for (word, role) in lone {
        if has(all, role) {
            continue;
        }
        let fits = |read: &&mut Read<'_>| {
            read.open
                && read.found.is_none()
                && read.shape == Shape::Vector
                && read.declared.kind == VariableKind::Uniform
                && read.words.order.contains(&word)
                && read.words.order.iter().all(|token| *token == word)
        };
        if let Some(read) = all.iter_mut().find(fits) {
            read.found = Some((role, How::Use));
        }
    }
    // Beside Right, or beside the world's up vector, Up is the camera's own.
    let ups = all.iter().filter(|read| read.is(Role::WorldUp)).count();
    if ups > 1 || has(all, Role::ViewRight) {
        let is_own = |read: &&mut Read<'_>| read.open && read.is(Role::WorldUp) && !read.words.has("world");
        if let Some(read) = all.iter_mut().find(is_own) {
            read.found = Some((Role::ViewUp, How::Use));
        }
    }
}

/// Treats `viewDir` as the position of the camera, as students use it, unless another variable holds that.
fn view(all: &mut [Read<'_>]) {
    let is_dir = |read: &Read<'_>| read.is(Role::ViewPos) && read.words.has("dir") && !read.words.has("pos");
    if all.iter().any(|read| read.is(Role::ViewPos) && !is_dir(read)) {
        for read in all.iter_mut().filter(|read| read.open && is_dir(read)) {
            read.found = Some((Role::ViewFront, How::Use));
        }
    }
}

/// Resolves colours and ratios: `diffuseColor` alone is the material's; beside `objectColor` it is the light's.
/// `ratio` is that of refraction if there is an environment.
fn terms(all: &mut [Read<'_>]) {
    let has_color = all.iter().any(|read| read.is(Role::MaterialColor));
    let has_cube = all.iter().any(|read| read.shape == Shape::SamplerCube);
    for read in all.iter_mut().filter(|read| read.open) {
        let says_material = read.words.has("material");
        match read.found {
            Some((Role::MaterialDiffuse, How::Name)) if has_color && !says_material => {
                read.found = Some((Role::DiffuseColor(0), How::Use));
            }
            Some((Role::MaterialSpecular, How::Name)) if has_color && !says_material && !read.words.has("ks") => {
                read.found = Some((Role::SpecularColor(0), How::Use));
            }
            None if has_cube && read.shape == Shape::Scalar && read.has_only(&["ratio"]) => {
                read.found = Some((Role::RefractionRatio, How::Use));
            }
            None if has_cube && read.shape == Shape::Scalar && read.has_only(&["index"]) => {
                read.found = Some((Role::RefractionIndex, How::Use));
            }
            _ => {}
        }
    }
}

fn samplers(all: &mut [Read<'_>]) {
    // The only sampler of a type has only one possible role.
    for (shape, role) in [(Shape::SamplerCube, Role::Cubemap), (Shape::Sampler2D, Role::DiffuseTexture)] {
        let mut of_type =
            all.iter_mut().filter(|read| read.shape == shape && read.declared.kind == VariableKind::Uniform);
        if let (Some(only), None) = (of_type.next(), of_type.next())
            && only.open
            && only.found.is_none()
            && (shape == Shape::SamplerCube || !only.words.has("blocked") && !only.words.has("light"))
        {
            only.found = Some((role, How::Type));
        }
    }
    // One of `texture1` and `texture2` is the object's colour; of `diffuseMap` and `tex`, it is the one named so.
    let says_so = |read: &Read<'_>| ["diffuse", "albedo", "color"].iter().any(|word| read.words.has(word));
    let is_open = |read: &Read<'_>| read.is(Role::DiffuseTexture) && read.open;
    let first = all
        .iter()
        .enumerate()
        .filter(|(_, read)| read.is(Role::DiffuseTexture))
        .min_by_key(|(at, read)| (!says_so(read), read.words.number, *at))
        .map(|(at, _)| at);
    for (at, read) in all.iter_mut().enumerate() {
        if is_open(read) && Some(at) != first && !says_so(read) {
            read.found = None;
        }
    }
}

fn number_lights(all: &mut [Read<'_>]) {
    let of_lights: Vec<usize> = (0..all.len())
        .filter(|&at| all[at].open && all[at].found.is_some_and(|(role, _)| role.light().is_some()))
        .collect();
    let places: Vec<(Role, Place)> =
        of_lights.iter().filter_map(|&at| all[at].found.map(|(role, _)| (role, all[at].light.clone()))).collect();
    for (&at, index) in of_lights.iter().zip(light_indices(&places)) {
        if let Some((role, _)) = &mut all[at].found {
            *role = role.with_light(index);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Declared, NamesFile, Role, bind};

    #[test]
    fn names_are_clear_beside_others() {
        for (all, name, role) in [
            ("vec4 Ia, vec4 Id, vec4 Is", "Id", Some(Role::DiffuseColor(0))),
            ("int Id, vec4 Ia", "Ia", None),
            ("vec3 light_in_eye_space", "light_in_eye_space", Some(Role::LightPosInView(0))),
            ("mat4 modelMatrix, mat4 worldMatrix, mat4 projection", "worldMatrix", Some(Role::View)),
            ("mat4 worldMatrix, mat4 projection", "worldMatrix", Some(Role::Model)),
            ("mat4 cofactorM, mat4 M", "cofactorM", Some(Role::NormalMatrix)),
            ("float ambientStrength, vec3 ambientColor", "ambientColor", Some(Role::Tint)),
            ("vec3 ambientColor", "ambientColor", Some(Role::AmbientColor(0))),
            ("vec3 objectColor, vec3 material.diffuse", "objectColor", Some(Role::Tint)),
            ("vec3 objectColor", "objectColor", Some(Role::MaterialColor)),
            ("mat4 unity_WorldToObject, mat4 M", "unity_WorldToObject", Some(Role::ModelInverse)),
            ("mat4 kameraAusWelt", "kameraAusWelt", Some(Role::View)),
            ("mat4 world2view", "world2view", Some(Role::View)),
            ("mat4 kameraGegenWelt", "kameraGegenWelt", None),
            ("mat4 mProiezione", "mProiezione", Some(Role::Projection)),
            ("mat4 mUnknown", "mUnknown", None),
            ("mat4 M", "M", Some(Role::Model)),
            ("mat4 mw, mat4 mv, mat4 mp", "mv", Some(Role::View)),
            ("mat4 mv, mat4 p", "mv", Some(Role::ModelView)),
            ("float lamp.k0, float lamp.k1, float lamp.k2", "lamp.k1", Some(Role::AttenuationLinear(0))),
            ("float lamp.k0, float lamp.k1", "lamp.k1", Some(Role::LightColor(1))),
        ] {
            let uniform = |text: &str| text.split_once(' ').map(|(ty, name)| Declared::uniform(name, ty));
            let declared: Vec<Declared> = all.split(", ").filter_map(uniform).collect();
            let bindings = bind(&declared, &NamesFile::default());
            let found = bindings.bound.iter().find(|bound| bound.declared.name == name).map(|bound| bound.role);
            assert_eq!(found, role, "{name} in {all}");
        }
    }
}
