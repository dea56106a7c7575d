//! Names of variables as students of several countries write them, and comments in their languages.

use crate::expression::Random;
use std::collections::BTreeMap;

/// How a program is named.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Dialect {
    /// The names of the exercises' texts.
    Lab = 0,
    /// Long English names in camel case.
    English = 1,
    French = 2,
    German = 3,
    Spanish = 4,
    /// One or two letters.
    Short = 5,
}

/// Whether a name is visible to the host program or the other stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Attribute,
    Uniform,
    Varying,
    Local,
    Member,
}
use Kind::{Attribute, Local, Member, Uniform, Varying};

/// Keys, with their names in the order of [`Dialect`].
const TABLE: &[(&str, Kind, [&str; 6])] = &[
    ("position", Attribute, ["position", "aPos", "position", "position", "posicion", "p"]),
    ("normal", Attribute, ["normal", "aNormal", "normale", "normale", "normal", "n"]),
    ("tex_coord", Attribute, ["tex_coord", "aTexCoords", "uv_tex", "texKoord", "texCoord", "t"]),
    ("M", Uniform, ["M", "model", "modele", "modelMatrix", "modelo", "M"]),
    ("V", Uniform, ["V", "view", "vue", "viewMatrix", "vista", "V"]),
    ("P", Uniform, ["P", "projection", "projection", "projektion", "proyeccion", "P"]),
    ("MV", Uniform, ["MV", "modelView", "modelView", "modelViewMatrix", "modeloVista", "MV"]),
    ("VP", Uniform, ["VP", "viewProjection", "viewProj", "viewProjectionMatrix", "vistaProyeccion", "VP"]),
    ("MVP", Uniform, ["MVP", "mvp", "MVP", "mvpMatrix", "MVP", "MVP"]),
    ("itM", Uniform, ["itM", "inverseTransposeModel", "itM", "normalMatrix", "itM", "N_M"]),
    (
        "normal_matrix",
        Uniform,
        ["normalMatrix", "normalMatrix", "matriceNormale", "normalenMatrix", "matrizNormal", "NM"],
    ),
    ("view_pos", Uniform, ["u_view_pos", "viewPos", "camera_pos", "kameraPos", "posCamara", "eye"]),
    ("shininess", Uniform, ["shininess", "shininess", "brillance", "glanz", "brillo", "s"]),
    ("material", Uniform, ["materialColour", "objectColor", "couleurObjet", "objektFarbe", "colorObjeto", "col"]),
    ("time", Uniform, ["now", "time", "temps", "zeit", "tiempo", "tm"]),
    (
        "index",
        Uniform,
        ["refractionIndice", "refractiveIndex", "indiceRefraction", "brechungsIndex", "indiceRefraccion", "ior"],
    ),
    ("cubemap", Uniform, ["cubemapSampler", "skybox", "cubemap", "umgebung", "cubemap", "cube"]),
    ("light", Uniform, ["light", "light", "lumiere", "licht", "luz", "li"]),
    ("lights", Uniform, ["lights", "pointLights", "lumieres", "lichter", "luces", "ls"]),
    ("u_light_pos", Uniform, ["u_light_pos", "lightPos", "light_pos", "lichtPos", "posLuz", "lp"]),
    (
        "u_ambient",
        Uniform,
        ["ambient_strength", "ambientStrength", "force_ambiante", "ambientStaerke", "fuerzaAmbiente", "ka"],
    ),
    (
        "u_diffuse",
        Uniform,
        ["diffuse_strength", "diffuseStrength", "force_diffuse", "diffusStaerke", "fuerzaDifusa", "kd"],
    ),
    (
        "u_specular",
        Uniform,
        ["specular_strength", "specularStrength", "force_speculaire", "spekularStaerke", "fuerzaEspecular", "ks"],
    ),
    ("u_constant", Uniform, ["constant", "constant", "att_constante", "attKonstant", "constante", "kc"]),
    ("u_linear", Uniform, ["linear", "linear", "att_lineaire", "attLinear", "lineal", "kl"]),
    ("u_quadratic", Uniform, ["quadratic", "quadratic", "att_quadratique", "attQuadratisch", "cuadratica", "kq"]),
    ("m_position", Member, ["light_pos", "position", "pos", "position", "posicion", "pos"]),
    ("m_ambient", Member, ["ambient_strength", "ambient", "ambiant", "ambient", "ambiente", "a"]),
    ("m_diffuse", Member, ["diffuse_strength", "diffuse", "diffus", "diffus", "difusa", "d"]),
    ("m_specular", Member, ["specular_strength", "specular", "speculaire", "spekular", "especular", "s"]),
    ("m_constant", Member, ["constant", "constant", "constante", "konstant", "constante", "kc"]),
    ("m_linear", Member, ["linear", "linear", "lineaire", "linear", "lineal", "kl"]),
    ("m_quadratic", Member, ["quadratic", "quadratic", "quadratique", "quadratisch", "cuadratica", "kq"]),
    ("v_position", Varying, ["v_frag_coord", "FragPos", "v_position", "fragPosition", "v_posicion", "vp"]),
    ("v_normal", Varying, ["v_normal", "Normal", "v_normale", "fragNormale", "v_normal", "vn"]),
    ("v_to_light", Varying, ["v_to_light", "ToLight", "v_vers_lumiere", "zumLicht", "v_haciaLuz", "vl"]),
    ("v_to_eye", Varying, ["v_to_eye", "ToCamera", "v_vers_camera", "zurKamera", "v_haciaCamara", "ve"]),
    ("v_result", Varying, ["v_col", "LightingColor", "v_couleur", "farbe", "v_color", "vc"]),
    ("v_direction", Varying, ["v_direction", "TexCoords", "v_dir", "richtung", "v_direccion", "d"]),
    ("output", Varying, ["FragColor", "FragColor", "couleur_finale", "ausgabe", "colorFinal", "o"]),
    ("N", Local, ["N", "norm", "n", "nrm", "norma", "a"]),
    ("L", Local, ["L", "lightDir", "l", "lichtRichtung", "dirLuz", "b"]),
    ("I", Local, ["I", "incident", "inc", "einfall", "incidente", "i0"]),
    ("eye_dir", Local, ["E", "viewDir", "oeil", "blick", "dirVista", "c"]),
    ("R", Local, ["R", "reflectDir", "refl", "spiegelung", "reflejo", "r"]),
    ("H", Local, ["H", "halfwayDir", "demi", "halb", "medio", "h"]),
    ("to_light", Local, ["to_light", "lightVec", "vers_lumiere", "lichtVektor", "vectorLuz", "w"]),
    ("to_eye", Local, ["to_eye", "viewVec", "vers_oeil", "blickVektor", "vectorVista", "x"]),
    ("cosine", Local, ["cos_theta", "diff", "cosinus", "kosinus", "coseno", "k"]),
    ("spec_cosine", Local, ["cos_phi", "specAngle", "cos_phi", "spiegelKosinus", "cosPhi", "q"]),
    ("power", Local, ["spec", "spec", "puissance", "potenz", "potencia", "pw"]),
    ("d", Local, ["d", "dist", "dist", "abstand", "dist", "e"]),
    ("attenuation", Local, ["attenuation", "attenuation", "att", "daempfung", "atenuacion", "at"]),
    ("ambient", Local, ["ambient", "ambientLight", "lum_ambiante", "ambientesLicht", "luzAmbiente", "am"]),
    ("diffuse", Local, ["diffuse", "diffuseLight", "lum_diffuse", "diffusesLicht", "luzDifusa", "df"]),
    ("specular", Local, ["specular", "specularLight", "lum_speculaire", "glanzLicht", "luzEspecular", "sp"]),
    ("sum", Local, ["lit", "lighting", "total", "summe", "suma", "su"]),
    ("result", Local, ["colour", "result", "resultat", "ergebnis", "resultado", "z"]),
    ("light_here", Local, ["light_place", "lightPosView", "lum_vue", "lichtHier", "luzVista", "lv"]),
    ("total", Local, ["all_lights", "totalLight", "toutes", "gesamt", "todas", "tt"]),
    ("world4", Local, ["frag_coord", "worldPos", "pos_monde", "weltPos", "posMundo", "m4"]),
    ("world", Local, ["place", "worldPosition", "point", "punkt", "punto", "m3"]),
    ("n_dot_l", Local, ["NdotL", "nDotL", "ndl", "nl", "nPorL", "u"]),
    ("ratio", Local, ["ratio", "eta", "rapport", "verhaeltnis", "razon", "et"]),
    ("found", Local, ["found", "envColor", "env", "gefunden", "entorno", "f"]),
    ("turn", Local, ["turn", "viewNoTranslation", "rotation", "drehung", "rotacion", "vr"]),
    ("clip", Local, ["place4", "clipPos", "pos_clip", "clipPosition", "posClip", "g"]),
    ("shade", Local, ["shade", "calcLight", "eclairage", "beleuchtung", "iluminacion", "fl"]),
    ("f_diffuse", Local, ["diffuse_term", "calcDiffuse", "calcul_diffus", "berechneDiffus", "calculaDifusa", "fd"]),
    (
        "f_specular",
        Local,
        ["specular_term", "calcSpecular", "calcul_speculaire", "berechneGlanz", "calculaEspecular", "fs"],
    ),
    (
        "f_attenuation",
        Local,
        ["attenuation_at", "calcAttenuation", "calcul_att", "berechneDaempfung", "calculaAtenuacion", "fa"],
    ),
    ("helper", Local, ["square", "saturate1", "carre", "quadrat", "cuadrado", "sq"]),
    ("arg_n", Local, ["n_", "norm_", "nn", "nV", "nv", "n1"]),
    ("arg_l", Local, ["l_", "dir_", "ll", "lV", "lv", "l1"]),
    ("arg_e", Local, ["e_", "view_", "ee", "vV", "vv", "e1"]),
    ("arg_p", Local, ["p_", "pos_", "pp", "pV", "pv", "p1"]),
    ("arg_light", Local, ["one", "lgt", "lum", "lt", "lz", "y"]),
    ("arg_x", Local, ["x_", "val", "xx", "xw", "xv", "x1"]),
    ("block_type", Member, ["LightBlock", "LightData", "BlocLumiere", "LichtBlock", "BloqueLuz", "B"]),
    ("light_type", Member, ["Light", "PointLight", "Lumiere", "Licht", "Luz", "T"]),
    ("varying_type", Member, ["VS_OUT", "VertexData", "Sortie", "Ausgang", "Salida", "W"]),
    ("varying_block", Member, ["vs_out", "data", "donnees", "daten", "datos", "w_"]),
];

/// The names of one program.
#[derive(Clone, Debug)]
pub(crate) struct Names {
    by_key: BTreeMap<&'static str, String>,
    /// Whether only values tell what the inputs are.
    pub are_meaningless: bool,
}

impl Names {
    /// Chooses the names of all keys: mostly of one dialect, with a prefix for each kind in some programs.
    pub fn draw(dialect: Dialect, random: &mut Random) -> Self {
        let prefixed = random.chance(0.15);
        // Some programs name everything that is visible outside as the lab does.
        let lab_outside = dialect != Dialect::Lab && random.chance(if dialect == Dialect::Short { 0.8 } else { 0.35 });
        let are_meaningless = random.chance(0.02);
        let (mut names, mut used) = (BTreeMap::new(), Vec::<(bool, String)>::new());
        for (index, (key, kind, all)) in TABLE.iter().enumerate() {
            let outside = matches!(kind, Attribute | Uniform | Member);
            let column = if outside && lab_outside { Dialect::Lab } else { dialect };
            let mut name = all[column as usize].to_owned();
            if outside && are_meaningless && *kind != Member {
                name = format!("{}{index}", if *kind == Attribute { "in" } else { "un" });
            } else if prefixed {
                let bare = name.trim_start_matches("u_").trim_start_matches("v_").to_owned();
                name = match kind {
                    Attribute if bare.starts_with('a') && bare.chars().nth(1).is_some_and(char::is_uppercase) => bare,
                    Attribute => format!("a_{bare}"),
                    Uniform => format!("u_{bare}"),
                    Varying if *key != "output" => format!("v_{bare}"),
                    _ => name,
                };
            }
            // Members are in a space of their own.
            let is_member = *kind == Member && key.starts_with("m_");
            let clashes = |name: &String| used.contains(&(is_member, name.clone()));
            while clashes(&name) || RESERVED.contains(&name.as_str()) {
                name.push(if name.ends_with(|c: char| c.is_ascii_digit()) { 'x' } else { '2' });
            }
            used.push((is_member, name.clone()));
            names.insert(*key, name);
        }
        Names { by_key: names, are_meaningless }
    }

    pub fn get(&self, key: &str) -> &str {
        self.by_key.get(key).map_or("unnamed", String::as_str)
    }
}

/// Words that the generator uses itself.
const RESERVED: [&str; 6] = ["i", "main", "texture", "reflect", "half", "normalize"];

/// Comments about a quantity: English, French, German, Spanish.
const COMMENTS: &[(&str, [&str; 4])] = &[
    ("N", ["normalise, it is interpolated", "on normalise la normale", "Normale normieren", "normalizar la normal"]),
    ("L", ["direction to the light", "direction vers la lumière", "Richtung zum Licht", "dirección hacia la luz"]),
    ("eye_dir", ["towards the camera", "vers la caméra", "zur Kamera", "hacia la cámara"]),
    ("R", ["mirror direction", "direction réfléchie", "gespiegelte Richtung", "dirección reflejada"]),
    ("H", ["blinn phong", "vecteur moitié (Blinn)", "Halbvektor", "vector medio"]),
    ("cosine", ["lambert", "cosinus de Lambert", "Lambert", "ley de Lambert"]),
    ("power", ["specular", "tache spéculaire", "Glanzlicht", "brillo especular"]),
    ("attenuation", ["light gets weaker", "atténuation avec la distance", "Abschwächung", "atenuación"]),
    ("result", ["put it all together", "somme des termes", "alles zusammen", "suma de todo"]),
    ("world4", ["world space", "repère monde", "Weltkoordinaten", "espacio mundo"]),
    ("clip", ["don't touch", "position à l'écran", "Bildschirmposition", "posición en pantalla"]),
    ("d", ["how far", "distance à la lumière", "Entfernung", "distancia"]),
];

/// The comment on a quantity, if there is one.
pub(crate) fn comment(key: &str, language: usize) -> Option<&'static str> {
    COMMENTS.iter().find(|(of, _)| *of == key).and_then(|(_, all)| all.get(language).copied())
}

/// First lines of files.
pub(crate) const HEADERS: [[&str; 3]; 4] = [
    ["TP shaders", "homework 3 - works on my machine", "based on the tutorial, cleaned up a bit"],
    ["TP3 : éclairage", "à rendre vendredi", "version finale (vraiment)"],
    ["Übung Computergrafik", "Abgabe Gruppe 7", "läuft endlich"],
    ["práctica de iluminación", "entrega 2", "ya funciona, no tocar"],
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_in_every_dialect() {
        let dialects =
            [Dialect::Lab, Dialect::English, Dialect::French, Dialect::German, Dialect::Spanish, Dialect::Short];
        for (dialect, seed) in dialects.into_iter().flat_map(|dialect| (0..20).map(move |seed| (dialect, seed))) {
            let names = Names::draw(dialect, &mut Random::new(seed));
            let of = |members: bool| {
                names.by_key.iter().filter(move |(key, _)| key.starts_with("m_") == members).map(|(_, name)| name)
            };
            let unique = [true, false].map(|members| of(members).collect::<std::collections::BTreeSet<_>>().len());
            assert_eq!(unique.iter().sum::<usize>(), TABLE.len(), "{dialect:?} {seed}");
        }
    }
}
