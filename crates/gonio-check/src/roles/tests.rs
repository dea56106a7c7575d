//! The naming styles of students and tutorials, each as the variables of a shader with their expected roles.

#![allow(clippy::unwrap_used)]

use super::*;

/// Each line is `type name role`, after `in` for an attribute; `-` means no role.
fn check(title: &str, table: &str, wrong: &mut Vec<String>) -> usize {
    let mut declared = Vec::new();
    let mut roles = Vec::new();
    for line in table.lines().map(str::trim).filter(|line| !line.is_empty()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let (kind, words) = match words[..] {
            ["in", ref words @ ..] => (VariableKind::Attribute, words),
            ref words => (VariableKind::Uniform, words),
        };
        let [glsl_type, name, role] = words else { panic!("{title}: {line}") };
        declared.push(Declared { kind, ..Declared::uniform(*name, *glsl_type) });
        roles.push(if *role == "-" { None } else { Some(role.parse::<Role>().unwrap()) });
    }
    // Drivers list variables in any order; only attributes recognised by type depend on it.
    for reversed in [false, true] {
        let mut list = declared.clone();
        if reversed {
            list.sort_by_key(|d| (d.kind == VariableKind::Uniform).then(|| std::cmp::Reverse(d.name.clone())));
        }
        let bindings = bind(&list, &NamesFile::default());
        for (declared, role) in declared.iter().zip(&roles) {
            let found = bindings.bound.iter().find(|bound| bound.declared == *declared).map(|bound| bound.role);
            let shown = |role: Option<Role>| role.map_or("-".to_owned(), |role| role.to_string());
            if found != *role {
                let Declared { glsl_type, name, .. } = declared;
                let (found, role) = (shown(found), shown(*role));
                wrong.push(format!("{title}: {glsl_type} {name}: {found} for {role}, reversed {reversed}"));
            }
        }
        assert_eq!(bindings.bound.len() + bindings.unknown.len(), declared.len());
    }
    declared.len()
}

#[test]
fn roles_in_every_naming_style() {
    let mut wrong = Vec::new();
    let rows: usize = DIALECTS.iter().map(|(title, table)| check(title, table, &mut wrong)).sum();
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(rows >= 150, "{rows}");
}

const DIALECTS: &[(&str, &str)] = &[
    (
        "the lab",
        "in vec3 position position
         in vec2 tex_coord tex-coord
         in vec3 normal normal
         mat4 M model
         mat4 V view
         mat4 P projection
         mat4 itM normal-matrix
         vec3 u_view_pos view-pos
         vec3 u_light_pos light-pos",
    ),
    (
        "the lab with a struct",
        "in vec3 position position
         in vec3 normal normal
         in vec2 tex_coords tex-coord
         in vec3 color color
         vec3 light.light_pos light-pos
         float light.ambient_strength ambient-strength
         float light.diffuse_strength diffuse-strength
         float light.specular_strength specular-strength
         float light.constant attenuation-constant
         float light.linear attenuation-linear
         float light.quadratic attenuation-quadratic
         float shininess shininess
         vec3 materialColour material-color
         float refractionIndice refraction-index
         float now time
         vec3 view_dir view-pos
         samplerCube cubemapSampler cubemap",
    ),
    (
        "an object with a texture",
        "in vec2 texcoord tex-coord\n sampler2D ourTexture diffuse-texture\n samplerCube skybox cubemap",
    ),
    ("one says so", "sampler2D tex -\n sampler2D diffuseMap diffuse-texture"),
    ("texture1", "sampler2D texture1 diffuse-texture"),
    ("u_texture", "sampler2D u_texture diffuse-texture"),
    ("tex0", "sampler2D tex0 diffuse-texture"),
    ("diffuseTexture", "sampler2D diffuseTexture diffuse-texture"),
    (
        "prefixes",
        "in vec3 a_Position position
         in vec3 a_Normal normal
         in vec2 a_TexCoord tex-coord
         in vec4 a_Color color
         mat4 u_Model model
         mat4 u_View view
         mat4 u_Projection projection
         mat3 u_Normal normal-matrix
         vec3 u_CameraPosition view-pos
         vec3 u_LightColor light-color
         float u_AmbientStrength ambient-strength",
    ),
    (
        "spaces in front",
        "in vec3 MvertPos position
         in vec3 MvertNormal normal
         vec3 WeyePos view-pos
         vec3 WlightPos light-pos
         mat4 WfromM model
         mat4 MVP model-view-projection",
    ),
    (
        "LearnOpenGL, lighting maps",
        "in vec3 aPos position
         in vec3 aNormal normal
         in vec2 aTexCoords tex-coord
         mat4 model model
         mat4 view view
         mat4 projection projection
         vec3 lightPos light-pos
         vec3 viewPos view-pos
         vec3 lightColor light-color
         vec3 objectColor material-color
         sampler2D material.diffuse diffuse-texture
         sampler2D material.specular specular-texture
         float material.shininess shininess
         vec3 light.ambient ambient-color
         vec3 light.diffuse diffuse-color
         vec3 light.specular specular-color",
    ),
    (
        "LearnOpenGL, materials",
        "vec3 material.ambient material-ambient
         vec3 material.diffuse material-diffuse
         vec3 material.specular material-specular
         float material.shininess shininess
         vec3 light.position light-pos
         vec3 light.direction light-direction
         float light.cutOff -
         float light.outerCutOff -
         float light.constant attenuation-constant
         float light.linear attenuation-linear
         float light.quadratic attenuation-quadratic
         bool blinn -",
    ),
    (
        "LearnOpenGL, many lights",
        "vec3 pointLights[0].position light-pos
         vec3 pointLights[1].position light-pos-1
         vec3 pointLights[3].diffuse diffuse-color-3
         float pointLights[3].linear attenuation-linear-3
         vec3 pointLights[0].ambient ambient-color
         vec3 pointLights[0].diffuse diffuse-color
         vec3 dirLight.direction light-direction-4
         vec3 dirLight.ambient ambient-color-4
         vec3 dirLight.diffuse diffuse-color-4
         vec3 spotLight.position light-pos-5
         vec3 spotLight.direction light-direction-5
         int NR_POINT_LIGHTS light-count",
    ),
    (
        "LearnOpenGL, transformations",
        "in vec3 aPos position\n in vec2 aTexCoord tex-coord\n mat4 transform model-view-projection\n sampler2D texture1 diffuse-texture\n sampler2D texture2 -",
    ),
    (
        "opengl-tutorial",
        "in vec3 vertexPosition_modelspace position
         in vec2 vertexUV tex-coord
         in vec3 vertexNormal_modelspace normal
         mat4 MVP model-view-projection
         mat4 V view
         mat4 M model
         vec3 LightPosition_worldspace light-pos
         vec3 LightColor light-color
         float LightPower light-color
         sampler2D myTextureSampler diffuse-texture",
    ),
    (
        "three.js",
        "in vec3 position position
         in vec3 normal normal
         in vec2 uv tex-coord
         mat4 modelMatrix model
         mat4 modelViewMatrix model-view
         mat4 viewMatrix view
         mat4 projectionMatrix projection
         mat3 normalMatrix normal-matrix-of-model-view
         vec3 cameraPosition view-pos
         vec3 diffuse material-diffuse
         vec3 emissive emitted
         vec3 specular material-specular
         float opacity -",
    ),
    (
        "WebGL fundamentals",
        "in vec4 a_position position
         in vec3 a_normal normal
         in vec2 a_texcoord tex-coord
         vec3 u_lightWorldPosition light-pos
         vec3 u_viewWorldPosition view-pos
         mat4 u_world model
         mat4 u_worldViewProjection model-view-projection
         mat4 u_worldInverseTranspose normal-matrix
         vec4 u_color material-color
         vec4 u_lightColor light-color
         vec4 u_ambient ambient-color
         vec4 u_specular tint
         float u_specularFactor specular-strength
         float u_shininess shininess
         vec3 u_reverseLightDirection -",
    ),
    ("WebGL fundamentals, first", "in vec4 a_position position\n mat4 u_matrix model-view-projection"),
    ("WebGL fundamentals, sky", "samplerCube u_skybox cubemap\n mat4 u_viewDirectionProjectionInverse -"),
    (
        "WebGL 1 of MDN",
        "in vec4 aVertexPosition position
         in vec3 aVertexNormal normal
         in vec2 aTextureCoord tex-coord
         in vec4 aVertexColor color
         mat4 uNormalMatrix normal-matrix-of-model-view
         mat4 uModelViewMatrix model-view
         mat4 uProjectionMatrix projection
         sampler2D uSampler diffuse-texture",
    ),
    (
        "WebGL years",
        "samplerCube u_cubemap cubemap\n mat4 uMVMatrix model-view\n mat4 uPMatrix projection\n mat3 uNMatrix normal-matrix-of-model-view",
    ),
    (
        "French",
        "in vec3 sommet position
         in vec3 normale normal
         in vec2 coordTex tex-coord
         mat4 matriceModele model
         mat4 matriceVue view
         mat4 matriceProjection projection
         vec3 positionLumiere light-pos
         vec3 couleurLumiere light-color
         vec3 posCamera view-pos
         vec3 couleurObjet material-color
         float intensiteAmbiante ambient-strength
         float brillance shininess
         float temps time
         float indiceRefraction refraction-index",
    ),
    (
        "an own struct of everything",
        "vec3 lum.pos light-pos
         vec3 lum.col light-color
         vec3 mat.Ka material-ambient
         vec3 mat.Kd material-color
         vec3 mat.Ks material-specular
         float mat.Ns shininess
         vec3 cam.pos view-pos
         vec3 cam.front view-front
         mat4 cam.view view
         mat4 cam.projection projection",
    ),
    (
        "OpenGL cookbook",
        "in vec3 VertexPosition position
         in vec3 VertexNormal normal
         vec4 Light.Position light-pos
         vec3 Light.La ambient-color
         vec3 Light.Ld diffuse-color
         vec3 Light.Ls specular-color
         vec3 Material.Ka material-ambient
         vec3 Material.Ks material-specular
         float Material.Shininess shininess
         mat4 ModelViewMatrix model-view
         mat3 NormalMatrix normal-matrix-of-model-view
         mat4 ProjectionMatrix projection
         mat4 MVP model-view-projection",
    ),
    (
        "Victor Gordan",
        "in vec3 aPos position
         in vec2 aTex tex-coord
         in vec3 aNormal normal
         in vec3 aColor color
         mat4 camMatrix view-projection
         mat4 model model
         vec4 lightColor light-color
         vec3 lightPos light-pos
         vec3 camPos view-pos
         sampler2D tex0 diffuse-texture
         sampler2D tex1 -",
    ),
    (
        "OGLdev",
        "in vec3 Position position
         in vec2 TexCoord tex-coord
         in vec3 Normal normal
         mat4 gWVP model-view-projection
         mat4 gWorld model
         sampler2D gSampler diffuse-texture
         vec3 gDirectionalLight.Color light-color
         float gDirectionalLight.AmbientIntensity ambient-strength
         float gDirectionalLight.DiffuseIntensity diffuse-strength
         vec3 gDirectionalLight.Direction light-direction
         vec3 gEyeWorldPos view-pos
         float gMatSpecularIntensity specular-strength
         float gSpecularPower shininess",
    ),
    (
        "spaces in the names",
        "mat4 world_from_model model
         mat4 view_from_world view
         mat4 clip_from_view projection
         mat4 clip_from_world view-projection
         mat4 modelToClip model-view-projection
         vec3 light_pos_in_world light-pos
         vec3 camera_pos_in_world view-pos",
    ),
    ("in view space", "vec3 lightPosView light-pos-in-view\n vec3 light_pos_camera_space light-pos-in-view"),
    (
        "two numbered lights",
        "vec3 lightPos1 light-pos\n vec3 lightPos2 light-pos-1\n vec3 lightColor1 light-color\n vec3 lightColor2 light-color-1",
    ),
    (
        "a place in the vertex shader, and a struct in the other",
        "vec3 LightPosition_worldspace light-pos
         vec3 light.light_pos light-pos
         float light.constant attenuation-constant
         float light.ambient_strength ambient-strength",
    ),
    (
        "a place for the shadows, a lamp and a sun",
        "vec3 lightPos light-pos
         vec3 pointLights[0].position light-pos
         vec3 pointLights[0].ambient ambient-color
         vec3 dirLight.direction light-direction-1
         vec3 dirLight.ambient ambient-color-1",
    ),
    (
        "another light's place beside a struct",
        "vec3 light.light_pos light-pos
         float light.constant attenuation-constant
         vec3 other_light_pos light-pos-1",
    ),
    ("short", "vec3 lPos light-pos\n vec3 viewing_pos view-pos\n float lightIntensity light-color"),
    ("a second light", "vec3 lightPos light-pos\n vec3 lightPos2 light-pos-1\n vec3 lightColor light-color"),
    (
        "numbered structs",
        "vec3 light1.position light-pos\n vec3 light2.position light-pos-1\n float light2.linear attenuation-linear-1",
    ),
    ("from 0", "vec3 light0_pos light-pos\n vec3 light1_pos light-pos-1"),
    ("arrays", "vec3 lightPositions[0] light-pos\n vec3 lightColors[0] light-color\n int numLights light-count"),
    ("counted by a letter", "int nLights light-count\n int nbLumieres light-count\n int light_count light-count"),
    (
        "strengths and terms",
        "float ambientStrength ambient-strength
         float u_kd diffuse-strength
         float k_s specular-strength
         float Ka ambient-strength
         float specularExponent shininess
         float u_gloss shininess
         float kc attenuation-constant
         float k_l attenuation-linear
         float attenuationQuadratic attenuation-quadratic
         float lightConstant attenuation-constant
         float u_time time
         float gamma gamma
         vec2 iResolution resolution
         vec2 u_mouse -
         float useTexture -",
    ),
    ("refraction", "float ratio refraction-ratio\n samplerCube env cubemap"),
    ("refraction too", "float eta refraction-ratio\n float ior refraction-index\n samplerCube t cubemap"),
    ("no refraction", "float ratio -"),
    (
        "light colours beside an object's",
        "vec3 diffuseColor diffuse-color\n vec3 specularColor specular-color\n vec3 objectColor material-color",
    ),
    (
        "maps",
        "sampler2D diffuseMap diffuse-texture
         sampler2D specularMap specular-texture
         sampler2D normalMap normal-texture
         sampler2D shadowMap -
         sampler2D equirectangularMap panorama
         samplerCube irradianceMap -
         samplerCube environmentMap cubemap
         mat4 lightSpaceMatrix -
         in vec3 aTangent tangent
         in vec3 aBitangent -
         in vec3 aPos position
         in vec3 aNormal normal",
    ),
    (
        "nothing but types",
        "in vec3 a position\n in vec3 b normal\n in vec2 c tex-coord\n mat4 x -\n samplerCube y cubemap\n vec3 z -\n float q -",
    ),
    ("one letter each", "in vec3 vp position\n in vec3 vn normal\n in vec2 vt tex-coord"),
    ("both of the view", "vec3 viewPos view-pos\n vec3 viewDir view-front"),
    (
        "coordinates of three components",
        "in vec3 a_coords position\n in vec3 a_normal normal\n mat4 modelview model-view
         mat3 inverseViewTransform view-inverse\n mat4 projection projection",
    ),
    ("a place and a matrix", "mat4 viewInverse view-inverse\n mat4 transform model\n mat4 PV view-projection"),
    ("one matrix left over", "mat4 P projection\n mat4 V view\n mat4 transformation model"),
    (
        "letters",
        "mat4 u_M model\n mat4 u_V view\n mat4 u_P projection\n mat3 N normal-matrix\n mat4 vpMatrix view-projection",
    ),
    (
        "transposed",
        "mat4 transposeInverseModel normal-matrix\n mat4 itMV normal-matrix-of-model-view\n mat4 invTransM normal-matrix",
    ),
    ("members", "mat4 m_model model\n mat4 mView view\n mat4 m_proj projection"),
    (
        "own words",
        "vec3 bunnyColor material-color\n sampler2D yokohamaTexture diffuse-texture\n vec3 myLightPosition light-pos\n vec3 sunDir light-direction",
    ),
    (
        "the camera's own words",
        "vec3 Position view-pos
         vec3 Front view-front
         vec3 Up view-up
         vec3 Right view-right
         vec3 WorldUp world-up
         float yaw yaw
         float u_pitch pitch",
    ),
    (
        "the camera of exercise 01",
        "vec3 u_view_pos view-pos\n vec3 u_front view-front\n vec3 u_up world-up\n mat4 M model\n mat4 P projection",
    ),
    ("what gluLookAt takes", "vec3 eye view-pos\n vec3 center view-target\n vec3 up world-up"),
    ("from and to", "vec3 from view-pos\n vec3 to view-target\n vec3 upVector world-up"),
    (
        "a camera as a struct",
        "vec3 camera.position view-pos\n vec3 camera.direction view-front\n vec3 camera.up world-up",
    ),
    (
        "a camera in French",
        "vec3 positionCamera view-pos\n vec3 devant view-front\n vec3 haut world-up\n vec3 cible view-target",
    ),
    ("no camera", "vec3 center -\n vec3 Position -\n vec3 faceColor material-color\n vec3 lightUp -"),
    (
        "a panorama's faces",
        "in vec2 aPos position
         sampler2D equirectangularMap panorama
         int faceIndex face
         vec2 faceSize resolution",
    ),
    ("more names of faces", "int u_face face\n sampler2D pano panorama"),
    ("and one by its number", "int faceId face\n float u_side face"),
    ("wrong types", "vec3 model -\n float viewPos -\n mat4 lightPos -\n int skybox -"),
];

#[test]
fn the_evidence_for_a_role_is_reported() {
    let list = [
        Declared::attribute("q", "vec3"),
        Declared::uniform("M", "mat4"),
        Declared::uniform("modelView", "mat4"),
        Declared::uniform("normalMatrix", "mat3"),
        Declared::uniform("thing", "vec3"),
        Declared::uniform("tint[0]", "vec3"),
        Declared::attribute("gl_VertexID", "int"),
    ];
    let file = NamesFile::parse("[names]\nthing = \"light-pos-1\"\ntint = [1, 2, 3]\nnone = 1\n").unwrap();
    let bindings = bind(&list, &file);
    let evidence: Vec<(&str, How)> = bindings.bound.iter().map(|b| (b.declared.name.as_str(), b.how)).collect();
    assert_eq!(
        evidence,
        [
            ("q", How::Type),
            ("M", How::Name),
            ("modelView", How::Name),
            ("normalMatrix", How::Use),
            ("thing", How::NamesFile)
        ]
    );
    assert_eq!(bindings.variable(Role::LightPos(1)).unwrap().name, "thing");
    assert_eq!(bindings.fixed, [Fixed { declared: list[5].clone(), values: vec![1.0, 2.0, 3.0] }]);
    assert_eq!(bindings.unused, ["none"]);
    assert!(bindings.unknown.is_empty());
}

#[test]
fn names_toml_takes_precedence() {
    let list = [Declared::uniform("lightPos", "vec3"), Declared::uniform("viewDir", "vec3")];
    let file = NamesFile::parse("[names]\nlightPos = \"view-pos\"\n").unwrap();
    let bindings = bind(&list, &file);
    assert_eq!(bindings.bound[0].role, Role::ViewPos);
    // It influences others: the position of the camera is known, so this is its direction.
    assert_eq!(bindings.bound[1].role, Role::ViewFront);
}

#[test]
fn hostile_names_are_read_quickly() {
    let long = "lightpos".repeat(20_000);
    let list =
        [Declared::uniform(long.clone(), "vec3"), Declared::uniform(format!("{long}.[.[9999999999999].."), "mat4")];
    assert_eq!(bind(&list, &NamesFile::default()).bound.len() + bind(&list, &NamesFile::default()).unknown.len(), 2);
    let many: Vec<Declared> = (0..3000).map(|i| Declared::uniform(format!("lights[{i}].pos"), "vec3")).collect();
    assert_eq!(bind(&many, &NamesFile::default()).bound[2999].role, Role::LightPos(2999));
}
