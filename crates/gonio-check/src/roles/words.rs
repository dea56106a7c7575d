//! Splits the name of a variable into words with one meaning each, in any naming style: `u_lightPos`,
//! `LightPosition_worldspace`, `lights[1].pos` and `posLumiere` all mean *light* and *pos*.

use crate::words::words_of;
use std::collections::HashMap;
use std::sync::LazyLock;

/// Spellings and their meanings. Words with an empty meaning are ignored.
const MEANINGS: &[(&str, &str)] = &[
    // Object, light and viewer.
    (
        "light lights lighting lightning lamp lamps lampe lum luminaire lumiere lumieres lumière lumières sun soleil spotlight spot pointlight licht lightsource luz luces luce luci swiatlo światło swiatla światła lampa lampy lampada ljus lys lumina svet sveta osveshheniya osveshcheniya osveshchenie",
        "light",
    ),
    (
        "view kijk oog eye eyes viewer viewing observer observateur oeil œil vue regard vista ansicht sicht blick auge ojo occhio osservatore olho visao visão widok oko vid",
        "view",
    ),
    ("camera cam caméra kamera camara cámara câmera câmara telecamera", "camera"),
    ("material materiau matériau materiale mtl surface surf superficie powierzchnia", "material"),
    ("mat", "mat"),
    ("object obj objet objekt mesh objeto oggetto obiekt", "object"),
    ("model modele modèle modell local modelo modello lokal locale", "model"),
    ("world monde ws wc welt wereld mundo mondo swiat świat", "world"),
    ("vertex vert vertices vertexes sommet sommets vtx", "vertex"),
    // Kinds of quantity.
    (
        "pos posizione pozycja poziciya pozitsiya posicao posição positie ort polozenie położenie posicion posición position positions postion postition posn location loc place origin",
        "pos",
    ),
    (
        "dir direction directions dirs direzione richtung direccion dirección direcao direção kierunek napravlenie napravleniya vec vector vect vettore vektor wektor",
        "dir",
    ),
    ("front forward look avant devant vorne gaze", "front"),
    ("up upward upwards haut oben", "up"),
    ("right droite rechts", "right"),
    ("target cible ziel lookat", "target"),
    ("center centre", "centre"),
    ("at", "at"),
    ("yaw lacet", "yaw"),
    ("pitch tangage", "pitch"),
    (
        "color colour colors colours col couleur couleurs clr rgb rgba tint teinte farbe farben colore colori kolor kleur cor barva farg färg renk iro cvet tsvet",
        "color",
    ),
    (
        "strength intensita intensità intensidade forza forca força sila siła natezenie natężenie fuerza staerke stärke intensidad intensitaet intensität intensity intensite intensité factor coefficient coeff coef coeffs coefs amount force strenght strengths intensities koeff koeffizienten koeffizient coefficients koeficienty sterkte sterktes level",
        "strength",
    ),
    ("count num number nb nbr nombre nr total", "count"),
    ("space espace", "space"),
    // The terms of the light equation.
    (
        "ambient ambiente ambientes umgebung ambientale otoczenie amb ambiant fonovogo fonovoe ambiante ambience ambiance",
        "ambient",
    ),
    (
        "diffuse diffuses diffusa diffuso rozproszenie rozproszone difusa difuso diff dif diffus difuse diffused diffusion",
        "diffuse",
    ),
    ("specular speculare especular spekular spekulares spec speculaire spéculaire specularity specu", "specular"),
    ("emissive emission emitted emit emissif emissie emissione emision emisión emissão emisja ke", "emitted"),
    ("albedo base", "albedo"),
    ("ka", "ka"),
    ("kd", "kd"),
    ("ks", "ks"),
    ("la", "light ambient"),
    ("ld", "light diffuse"),
    ("ls", "light specular"),
    (
        "attenuation demping attenuazione atenuacao atenuação oslabienie osłabienie tlumienie tłumienie atenuacion atenuación daempfung dämpfung abschwaechung att atten attenuations falloff",
        "attenuation",
    ),
    ("constant costante stala stała konstant konstante const cst constante kc", "constant"),
    ("linear lineare liniowy liniowe lineal linéaire lineaire lin kl", "linear"),
    (
        "quadratic quadratico quadratica kwadratowy kwadratowe quadratisch quadratische cuadratica cuadrática cuadratico quad quadratique quadr kq",
        "quadratic",
    ),
    (
        "shininess shine shiny shinines shinyness shinness shinniness gloss glossiness brillance brilliance brillo brillantezza lucentezza brilho polysk połysk glanz ns",
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
    (
        "proj projektion proyeccion proyección proiezione projecao projeção projekcja rzutowanie rzut proekcii proekciya projection perspective persp",
        "proj",
    ),
    ("matrix matriz matrice mtx matrixs macierz matrica matritsa", "matrix"),
    ("transform transformation transf transforms xform", "transform"),
    ("inv inverse inversed invert inverted inversa inverso odwrotna", "inverse"),
    (
        "transpose transp transposed transposee transposée trasposta trasp traspuesta transponiert transponierte tr",
        "transpose",
    ),
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
    (
        "normal normals normale normales normalen norm nrm nor bump normalna normalne normali normalej normaley",
        "normal",
    ),
    ("nm nmat nmatrix", "normal matrix"),
    ("tangent tangents tangente tan", "tangent"),
    ("bitangent binormal bitan", "blocked"),
    ("cube cubemap cubic", "cube"),
    ("skybox", "cube sky"),
    ("sky ciel", "sky"),
    ("env environment environnement envmap", "env"),
    (
        "reflect riflesso odbicie refl reflection reflexion reflected reflechi réfléchi reflet reflejado reflejada reflejo reflektiert",
        "reflect",
    ),
    ("panorama pano equirect equirectangular equi latlong hdr hdri spherical skydome", "panorama"),
    // Others.
    ("time now temps elapsed clock seconds", "time"),
    ("resolution viewport screen window fenetre", "screen"),
    ("size dim dimensions", "size"),
    ("face faces side cubeface layer seite", "face"),
    ("from aus von depuis desde dal", "from"),
    ("to nach zu zur vers hacia towards into", "to"),
    ("clip ndc bild", "clip"),
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

/// A word that is not in the list.
pub(super) const UNKNOWN: &str = "?";

/// The words of a name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Words {
    /// The meanings of the words, without duplicates.
    pub(super) tokens: Vec<&'static str>,
    /// A number in the name.
    pub(super) number: Option<u32>,
    /// Single letters in order, capital or not: `M`, `V`, `P`, `N`.
    pub(super) letters: Vec<char>,
    /// The meanings in order, including `from` and `to`, and [`UNKNOWN`] for each word without a meaning.
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
        // `world2view`
        let is_between = |at: usize| at >= 2 && parts.len() > at && parts[at - 2].len() > 1 && parts[at].len() > 1;
        while let Some(word) = parts.get(at) {
            at += 1;
            if word == "2" && is_between(at) {
                words.order.push("to");
                continue;
            }
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
                // `mProiezione`: a prefix, not M.
                Some(_)
                    if word.len() == 1 && at == 1 && name.starts_with(char::is_lowercase) && is_unknown(&parts, at) => {
                }
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
        let prefix = rest.next();
        let rest = rest.as_str();
        // `lamb` and `mamb`: a light's part and the material's.
        match (prefix, meaning(rest)) {
            (Some('l'), Some("ambient" | "diffuse" | "specular" | "pos" | "dir" | "color")) => self.add("light"),
            (Some('m'), Some("ambient" | "diffuse" | "specular" | "color")) => self.add("material"),
            _ => {}
        }
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
        if best.1.is_empty() {
            self.order.push(UNKNOWN);
        }
    }
}

/// Whether there is a word at a place that has no meaning.
fn is_unknown(parts: &[String], at: usize) -> bool {
    let Some(word) = parts.get(at).filter(|word| word.len() > 1 && word.parse::<u32>().is_err()) else { return false };
    let mut words = Words::default();
    words.add_word(word);
    words.order.contains(&UNKNOWN)
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
            ("lamb lambient", "ambient light"),
            ("mdif mdiffuse", "diffuse material"),
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
