//! Splits the name of a variable into words with one meaning each, in any naming style: `u_lightPos`,
//! `LightPosition_worldspace`, `lights[1].pos` and `posLumiere` all mean *light* and *pos*.

use crate::words::words_of;
use std::collections::HashMap;
use std::sync::LazyLock;

/// Spellings and their meanings. Words with an empty meaning are ignored.
const MEANINGS: &[(&str, &str)] = &[
    // Object, light and viewer.
    (
        "light lights lighting lightning lamp lamps lampe lum luminaire lumiere lumieres lumière lumières sun soleil spotlight spot pointlight licht lightsource luz luces",
        "light",
    ),
    (
        "view eye eyes viewer viewing observer observateur oeil œil vue regard vista ansicht sicht blick auge ojo",
        "view",
    ),
    ("camera cam caméra kamera camara cámara", "camera"),
    ("material materiau matériau mtl surface surf", "material"),
    ("mat", "mat"),
    ("object obj objet objekt mesh objeto", "object"),
    ("model modele modèle modell local modelo", "model"),
    ("world monde ws wc welt mundo", "world"),
    ("vertex vert vertices vertexes sommet sommets vtx", "vertex"),
    // Kinds of quantity.
    ("pos posicion posición position positions postion postition posn location loc place origin", "pos"),
    ("dir direction directions dirs vec vector vect", "dir"),
    ("front forward look avant devant vorne gaze", "front"),
    ("up upward upwards haut oben", "up"),
    ("right droite rechts", "right"),
    ("target cible ziel lookat", "target"),
    ("center centre", "centre"),
    ("at", "at"),
    ("yaw lacet", "yaw"),
    ("pitch tangage", "pitch"),
    ("color colour colors colours col couleur couleurs clr rgb rgba tint teinte farbe farben", "color"),
    (
        "strength fuerza staerke stärke intensidad intensitaet intensität intensity intensite intensité factor coefficient coeff coef coeffs coefs amount force strenght level",
        "strength",
    ),
    ("count num number nb nbr nombre nr total", "count"),
    ("space espace", "space"),
    // The terms of the light equation.
    ("ambient ambiente ambientes umgebung amb ambiant ambiante ambience ambiance", "ambient"),
    ("diffuse diffuses difusa difuso diff dif diffus difuse diffused diffusion", "diffuse"),
    ("specular especular spekular spekulares spec speculaire spéculaire specularity specu", "specular"),
    ("emissive emission emitted emit emissif ke", "emitted"),
    ("albedo base", "albedo"),
    ("ka", "ka"),
    ("kd", "kd"),
    ("ks", "ks"),
    ("la", "light ambient"),
    ("ld", "light diffuse"),
    ("ls", "light specular"),
    (
        "attenuation atenuacion atenuación daempfung dämpfung abschwaechung att atten attenuations falloff",
        "attenuation",
    ),
    ("constant konstant konstante const cst constante kc", "constant"),
    ("linear lineal linéaire lineaire lin kl", "linear"),
    ("quadratic quadratisch quadratische cuadratica cuadrática cuadratico quad quadratique quadr kq", "quadratic"),
    (
        "shininess shine shiny shinines shinyness shinness shinniness gloss glossiness brillance brilliance brillo glanz ns",
        "shininess",
    ),
    ("roughness rough rugosite rugosité rauheit rauigkeit rugosidad aspereza", "roughness"),
    ("exponent exponant exposant exp expo", "exponent"),
    ("power pow puissance", "power"),
    ("gamma", "gamma"),
    (
        "refraction refract refractive refr refrac réfraction refraktion brechung brechungs refraccion refracción",
        "refraction",
    ),
    ("index indice índice indices idx", "index"),
    ("ior", "refraction index"),
    ("ratio rapport", "ratio"),
    ("eta", "refraction ratio"),
    // Matrices.
    ("proj projektion proyeccion proyección projection perspective persp", "proj"),
    ("matrix matriz matrice mtx matrixs", "matrix"),
    ("transform transformation transf transforms xform", "transform"),
    ("inv inverse inversed invert inverted", "inverse"),
    ("transpose transp transposed transposee tr", "transpose"),
    ("trans", "trans"),
    ("it ti invtr invt tinv cofactor cofactors cof adjugate", "inverse transpose"),
    ("itm tim mit invtm", "inverse transpose m"),
    ("itmv timv mvit", "inverse transpose mv"),
    ("mv vm wv modelview", "mv"),
    ("nmv mvn", "normal mv"),
    ("vp pv projview viewproj", "vp"),
    ("mvp pvm wvp pmv mpv vmp", "mvp"),
    // Textures.
    ("tex texture textures txt sampler map maps image img", "tex"),
    ("uv uvs st texcoord texcoords texcoor", "tex coord"),
    ("coord coords coordinate coordinates coordonnees", "coord"),
    ("normal normals normale normales normalen norm nrm nor bump", "normal"),
    ("nm nmat nmatrix", "normal matrix"),
    ("tangent tangents tangente tan", "tangent"),
    ("bitangent binormal bitan", "blocked"),
    ("cube cubemap cubic", "cube"),
    ("skybox", "cube sky"),
    ("sky ciel", "sky"),
    ("env environment environnement envmap", "env"),
    (
        "reflect refl reflection reflexion reflected reflechi réfléchi reflet reflejado reflejada reflejo reflektiert",
        "reflect",
    ),
    ("panorama pano equirect equirectangular equi latlong hdr hdri spherical skydome", "panorama"),
    // Others.
    ("time now temps elapsed clock seconds", "time"),
    ("resolution viewport screen window fenetre", "screen"),
    ("size dim dimensions", "size"),
    ("face faces side cubeface layer seite", "face"),
    ("from", "from"),
    ("to", "to"),
    ("clip ndc", "clip"),
    ("k", "strength"),
    // Words that change the meaning of the others.
    (
        "shadow shadows property properties props depth bone bones joint prev previous fog near far radius cutoff cut \
         off inner outer cos angle use has is enable enabled show min max bias offset scale scaling threshold mouse width height aspect fov noise \
         metallic metalness metal ao occlusion alpha opacity transparency background bg clear ground line \
         outline edge border wire selected highlight hover mode type flag id kernel blur exposure mix blend irradiance \
         prefilter prefiltered brdf lut displacement parallax reverse reversed bool toggle rotation rot \
         translation blinn toon speed velocity step steps",
        "blocked",
    ),
    (
        "u a in v s g uniform attribute attrib value val param input var data current my our your the frag fragment f fs \
         float source src global scene of for i xyz point points dirlight gl this",
        "",
    ),
];

/// The words of a name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Words {
    /// The meanings of the words, without duplicates.
    pub(super) tokens: Vec<&'static str>,
    /// A number in the name.
    pub(super) number: Option<u32>,
    /// Single letters in order, capital or not: `M`, `V`, `P`, `N`.
    pub(super) letters: Vec<char>,
    /// The meanings in order, including `from` and `to`.
    pub(super) order: Vec<&'static str>,
}

impl Words {
    pub(super) fn has(&self, token: &str) -> bool {
        self.tokens.contains(&token)
    }

    fn add(&mut self, meaning: &'static str) {
        for token in meaning.split(' ').filter(|token| !token.is_empty()) {
            self.order.push(token);
            if !self.has(token) {
                self.tokens.push(token);
            }
        }
    }

    /// Splits one part of a name (without dots and brackets) into words.
    pub(super) fn split(name: &str) -> Self {
        let mut words = Self::default();
        let parts = words_of(name);
        let mut at = 0;
        while let Some(word) = parts.get(at) {
            at += 1;
            if let Ok(number) = word.parse() {
                words.number = Some(number);
                continue;
            }
            // `K_d`, `k_c`: two letters that belong together.
            if word == "k"
                && let Some(next) = parts.get(at).filter(|next| next.len() == 1)
                && let Some(meaning) = meaning(&format!("k{next}"))
            {
                words.add(meaning);
                at += 1;
                continue;
            }
            // `lPos` and `l_dir` belong to a light.
            let is_light = word == "l"
                && parts.get(at).and_then(|next| meaning(next)).is_some_and(|m| matches!(m, "pos" | "dir" | "color"));
            match word.chars().next() {
                Some(_) if is_light => words.add("light"),
                Some(letter) if word.len() == 1 && word != "k" => words.letters.push(letter),
                _ => words.add_word(word),
            }
        }
        words
    }

    fn add_word(&mut self, word: &str) {
        if let Some(meaning) = meaning(word) {
            return self.add(meaning);
        }
        if let Some(meanings) = cut(word) {
            return meanings.into_iter().for_each(|meaning| self.add(meaning));
        }
        // A prefix letter for a space or a kind: `WeyePos`, `MvertPos`, `vnormal`.
        let mut rest = word.chars();
        rest.next();
        let rest = rest.as_str();
        if let Some(meanings) = meaning(rest).filter(|_| rest.len() > 2).map(|m| vec![m]).or_else(|| cut(rest)) {
            return meanings.into_iter().for_each(|meaning| self.add(meaning));
        }
        // An unknown word joined to a known one: `bunnytexture`.
        let known =
            MEANINGS.iter().flat_map(|(spellings, meaning)| spellings.split_whitespace().map(move |s| (s, *meaning)));
        let mut best = ("", "");
        for (spelling, meaning) in known {
            let within = spelling.len() >= 5 && (word.starts_with(spelling) || word.ends_with(spelling));
            if within && spelling.len() > best.0.len() && meaning != "blocked" {
                best = (spelling, meaning);
            }
        }
        self.add(best.1);
    }
}

fn meaning(word: &str) -> Option<&'static str> {
    static BY_SPELLING: LazyLock<HashMap<&str, &str>> = LazyLock::new(|| {
        let all =
            MEANINGS.iter().flat_map(|(spellings, meaning)| spellings.split_whitespace().map(move |s| (s, *meaning)));
        // Of a word that is there twice, the first meaning counts.
        all.rev().collect()
    });
    BY_SPELLING.get(word).copied()
}

/// Splits joined words: `lightpos`, `texcoord`. Each piece must be known and have three letters or be a matrix.
fn cut(word: &str) -> Option<Vec<&'static str>> {
    // Real names are shorter.
    if word.len() > 60 || !word.is_ascii() {
        return None;
    }
    // best[end]: the split of the first `end` letters with the fewest pieces.
    let mut best: Vec<Option<Vec<&'static str>>> = vec![None; word.len() + 1];
    best[0] = Some(Vec::new());
    for end in 1..=word.len() {
        for start in 0..end {
            let piece = &word[start..end];
            if piece.len() < 3 && !matches!(piece, "mv" | "vp" | "uv") {
                continue;
            }
            let (Some(before), Some(meaning)) = (&best[start], meaning(piece)) else { continue };
            if best[end].as_ref().is_none_or(|now| now.len() > before.len() + 1) {
                let mut longer = before.clone();
                longer.push(meaning);
                best[end] = Some(longer);
            }
        }
    }
    best.pop().flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn naming_styles_have_the_same_meaning() {
        for (names, tokens) in [
            (
                "u_light_pos lightPos LightPosition lightpos posLumiere u_lightPosition LightPos light_location",
                "light pos",
            ),
            ("texcoord tex_coords TexCoord aTexCoords vertexUV? UV in_uv textureCoord", "coord tex"),
            ("WeyePos eyePos view_pos viewposition", "pos view"),
            ("ambient_strength ambientStrength ambientstrength k_ambient AmbientCoefficient", "ambient strength"),
            ("normalMatrix normal_matrix normalmatrix u_NormalMatrix", "matrix normal"),
            ("Kd k_d K_d", "kd"),
            ("bunnytexture textureBunny", "tex"),
            ("refractionIndice ior IOR refractive_index", "index refraction"),
            ("x foo qwerty", ""),
        ] {
            for name in names.split(' ').filter(|name| !name.ends_with('?')) {
                let mut found = Words::split(name).tokens;
                found.sort_unstable();
                assert_eq!(found.join(" "), tokens, "{name}");
            }
        }
    }

    #[test]
    fn letters_and_numbers_are_kept() {
        assert_eq!(Words::split("u_M").letters, ['u', 'm']);
        assert_eq!(Words::split("itM").letters, ['m']);
        assert_eq!(Words::split("texture12").number, Some(12));
        assert_eq!(Words::split("tex99999999999").number, None);
        assert_eq!(Words::split("clip_from_world").order, ["clip", "from", "world"]);
    }

    #[test]
    fn every_spelling_is_unique() {
        let mut spellings: Vec<&str> =
            MEANINGS.iter().flat_map(|(spellings, _)| spellings.split_whitespace()).collect();
        let all = spellings.len();
        spellings.sort_unstable();
        spellings.dedup();
        assert_eq!(spellings.len(), all);
    }
}
