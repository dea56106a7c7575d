//! Similarity of submissions: winnowed k-grams of tokens (S. Schleimer, D. Wilkerson, A. Aiken, "Winnowing: local
//! algorithms for document fingerprinting", SIGMOD 2003).
//!
//! Comments and layout are ignored. Names do not count: within each k-gram they are numbered in the order of their first
//! occurrence, so that an inserted declaration does not affect later k-grams. Numbers count by value. Declarations that the
//! host program prescribes (uniforms, attributes, varyings, structs) and the start files of the exercise are left out.

use super::text::by_name;
use gonio_glsl::{Item, Parsed, Span, TokenPlace, TokenRange};
use std::collections::{BTreeMap, BTreeSet};

/// Number of tokens in a gram: about a statement. Shorter grams are common to all programs.
const GRAM: usize = 12;
/// Number of grams in a window, of which one is kept: equal sequences of `GRAM + WINDOW - 1` tokens are found.
const WINDOW: usize = 4;
/// Longer sources, in bytes, are truncated: nobody writes such shaders by hand.
const MOST_BYTES: usize = 256 << 10;
/// Minimum number of grams for a comparison: a few lines are often the same by chance.
const FEWEST: usize = 12;

/// The fingerprint of a submission.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Fingerprint {
    grams: BTreeSet<u64>,
}

impl Fingerprint {
    /// Creates the fingerprint of a submission's shaders; `known` are the start files, which do not count.
    pub fn new(sources: &[&str], known: &[&str]) -> Self {
        // All grams of the known texts are left out: winnowing would select others in another context.
        let known: BTreeSet<u64> = known.iter().flat_map(|source| grams(source)).collect();
        let mut kept = BTreeSet::new();
        for source in sources {
            kept.extend(winnowed(&grams(source)).filter(|gram| !known.contains(gram)));
        }
        Fingerprint { grams: kept }
    }

    /// The share of both that is the same, from 0 to 1: `2 |A and B| / (|A| + |B|)`; 0 if one of them is empty.
    pub fn share(&self, other: &Self) -> f64 {
        let all = self.grams.len() + other.grams.len();
        let both = self.grams.intersection(&other.grams).count();
        if self.grams.is_empty() || other.grams.is_empty() { 0.0 } else { 2.0 * both as f64 / all as f64 }
    }
}

/// The similarity of two submissions' shaders, from 0 to 1, without `known`, the start files: see [`Fingerprint::share`].
pub fn similarity(a: &[&str], b: &[&str], known: &[&str]) -> f64 {
    Fingerprint::new(a, known).share(&Fingerprint::new(b, known))
}

/// All pairs with a similarity of at least `least`, the most similar first. Submissions of a few lines are left out.
pub fn similar_pairs(submissions: &[(String, Fingerprint)], least: f64) -> Vec<(String, String, f64)> {
    let long: Vec<_> = submissions.iter().filter(|(_, fingerprint)| fingerprint.grams.len() >= FEWEST).collect();
    let mut pairs = Vec::new();
    for (index, (label, fingerprint)) in long.iter().enumerate() {
        for (other, its) in &long[index + 1..] {
            let share = fingerprint.share(its);
            if share >= least {
                pairs.push((label.clone(), other.clone(), share));
            }
        }
    }
    pairs.sort_by(|a, b| b.2.total_cmp(&a.2));
    pairs
}

/// Submissions that are similar to one another, directly or by others between them.
#[derive(Clone, Debug, PartialEq)]
pub struct SimilarGroup {
    /// The labels, by name.
    pub members: Vec<String>,
    /// The similar pairs among them with their similarity, the most similar first.
    pub pairs: Vec<(String, String, f64)>,
}

impl SimilarGroup {
    /// The highest similarity of two members, 0 to 1.
    pub fn highest(&self) -> f64 {
        self.pairs.first().map_or(0.0, |(.., share)| *share)
    }
}

/// The connected components of similar pairs, the one with the highest similarity first.
pub fn similar_groups(pairs: &[(String, String, f64)]) -> Vec<SimilarGroup> {
    let mut group_of: BTreeMap<&str, usize> = BTreeMap::new();
    for (number, (a, b, _)) in pairs.iter().enumerate() {
        let known = [a, b].map(|label| group_of.get(label.as_str()).copied());
        let joined = known.into_iter().flatten().min().unwrap_or(number);
        for group in group_of.values_mut().filter(|group| known.contains(&Some(**group))) {
            *group = joined;
        }
        group_of.insert(a, joined);
        group_of.insert(b, joined);
    }
    let mut groups: BTreeMap<usize, SimilarGroup> = BTreeMap::new();
    let empty = || SimilarGroup { members: Vec::new(), pairs: Vec::new() };
    for (label, group) in &group_of {
        groups.entry(*group).or_insert_with(empty).members.push((*label).to_owned());
    }
    for pair in pairs {
        if let Some(group) = group_of.get(pair.0.as_str()).and_then(|group| groups.get_mut(group)) {
            group.pairs.push(pair.clone());
        }
    }
    let mut groups: Vec<SimilarGroup> = groups.into_values().collect();
    for group in &mut groups {
        group.members.sort_by(|a, b| by_name(a, b));
        group.pairs.sort_by(|a, b| b.2.total_cmp(&a.2));
    }
    groups.sort_by(|a, b| b.highest().total_cmp(&a.highest()));
    groups
}

/// Words with a fixed meaning; all others are names that someone chose.
const WORDS: &str = " \
    void bool int uint float double vec2 vec3 vec4 ivec2 ivec3 ivec4 uvec2 uvec3 uvec4 bvec2 bvec3 bvec4 mat2 mat3 mat4 \
    mat2x2 mat2x3 mat2x4 mat3x2 mat3x3 mat3x4 mat4x2 mat4x3 mat4x4 sampler2D samplerCube struct const in out inout \
    uniform attribute varying flat smooth layout precision highp mediump lowp if else for while do switch case default \
    break continue return discard true false radians degrees sin cos tan asin acos atan pow exp log exp2 log2 sqrt \
    inversesqrt abs sign floor ceil round trunc fract mod min max clamp mix step smoothstep length distance dot cross \
    normalize faceforward reflect refract transpose inverse determinant outerProduct texture texture2D textureCube \
    textureLod any all not lessThan greaterThan equal isnan isinf dFdx dFdy fwidth ";

/// A token for comparison.
#[derive(Clone, PartialEq)]
enum Word {
    /// A name that someone chose.
    Name(String),
    /// Anything else.
    Fixed(String),
}

fn word(text: &str, after_dot: bool) -> Word {
    let is_name = text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    if is_name {
        const SWIZZLES: [&str; 3] = ["xyzw", "rgba", "stpq"];
        if after_dot && let Some(letters) = SWIZZLES.iter().find(|letters| text.chars().all(|c| letters.contains(c))) {
            let place = |c: char| letters.find(c).and_then(|at| "xyzw".chars().nth(at));
            return Word::Fixed(text.chars().filter_map(place).collect());
        }
        let is_fixed = text.starts_with("gl_") || text == "main" || WORDS.contains(&format!(" {text} "));
        return if is_fixed { Word::Fixed(text.to_owned()) } else { Word::Name(text.to_owned()) };
    }
    match text.trim_end_matches(['f', 'F', 'u', 'U', 'l', 'L']).parse::<f64>() {
        Ok(number) => Word::Fixed(number.to_string()),
        Err(_) => Word::Fixed(text.to_owned()),
    }
}

/// The tokens of everything that is not prescribed.
fn words(parsed: &Parsed) -> Vec<Word> {
    let mut own = vec![true; parsed.tokens.len()];
    for item in &parsed.unit.items {
        let prescribed: Option<TokenRange> = match item {
            Item::Declaration(declaration) => {
                let is = |word: &str| declaration.qualifiers.iter().any(|qualifier| qualifier.word == word);
                let given = ["uniform", "in", "out", "attribute", "varying"].into_iter().any(is);
                (given || declaration.ty.definition.is_some()).then_some(declaration.tokens)
            }
            Item::Block(block) => Some(block.tokens),
            Item::Precision(precision) => Some(precision.tokens),
            Item::Qualify(qualify) => Some(qualify.tokens),
            Item::Function(_) | Item::Empty(_) => None,
        };
        if let Some(range) = prescribed {
            for index in range.first..=range.last {
                if let Some(own) = own.get_mut(index as usize) {
                    *own = false;
                }
            }
        }
    }
    let text = |place: &TokenPlace| parsed.text(Span { start: place.start, end: place.end, ..place.span });
    let mut words = Vec::new();
    let mut after_dot = false;
    for (place, _) in parsed.tokens.iter().zip(own).filter(|(_, own)| *own) {
        let text = text(place);
        // The end of the file is an empty token.
        if !text.is_empty() {
            words.push(word(text, after_dot));
            after_dot = text == ".";
        }
    }
    words
}

/// FNV-1a, 64 bits.
fn mixed(mut hash: u64, bytes: &[u8]) -> u64 {
    for byte in bytes {
        hash = (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    }
    hash
}

/// The hashes of all grams, in order.
fn grams(source: &str) -> Vec<u64> {
    let mut most = source.len().min(MOST_BYTES);
    while !source.is_char_boundary(most) {
        most -= 1;
    }
    let words = words(&gonio_glsl::parse(&source[..most]));
    if words.is_empty() {
        return Vec::new();
    }
    words.windows(GRAM.min(words.len())).map(gram).collect()
}

fn gram(words: &[Word]) -> u64 {
    let mut names: Vec<&str> = Vec::new();
    let mut hash = 0xcbf2_9ce4_8422_2325;
    for word in words {
        hash = match word {
            Word::Fixed(text) => mixed(hash, text.as_bytes()),
            Word::Name(name) => {
                let number = names.iter().position(|known| known == name).unwrap_or_else(|| {
                    names.push(name);
                    names.len() - 1
                });
                mixed(hash, &[1, number as u8])
            }
        };
        hash = mixed(hash, &[0]);
    }
    // The low bits of FNV are weak, but the smallest hash is kept.
    hash = (hash ^ (hash >> 32)).wrapping_mul(0xd6e8_feb8_6659_fd93);
    hash ^ (hash >> 32)
}

/// The smallest gram of each window.
fn winnowed(grams: &[u64]) -> impl Iterator<Item = u64> {
    grams.windows(WINDOW.min(grams.len()).max(1)).filter_map(|window| window.iter().min().copied())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use std::path::Path;

    const ONE: &str = "#version 330 core
in vec3 n; uniform vec3 l; out vec4 c;
void main() {
    vec3 N = normalize(n);           // the normal
    vec3 L = normalize(l - n.xyz);
    float cosine = max(dot(N, L), 0.0);
    float strength = 0.5 * cosine;
    if (cosine > 0.25) { strength += pow(cosine, 32.0); }
    c = vec4(vec3(strength) * vec3(0.5, 0.6, 0.8), 1.0);
}";

    #[test]
    fn a_renamed_and_reformatted_copy_is_the_same() {
        let copy = "#version 400
uniform vec3 lampe;   out vec4 couleur; in vec3 normale;
/* moi */ void main( )
{ vec3 a=normalize(normale); vec3 b = normalize(lampe-normale.rgb); float q = max(dot(a,b),0.);
  float s = .5*q; if(q>0.250){s+=pow(q,32.);} couleur=vec4(vec3(s)*vec3(.5,.6,.8),1.); }";
        assert_eq!(similarity(&[ONE], &[copy], &[]), 1.0);
        assert_eq!(similarity(&[ONE], &[ONE], &[]), 1.0);
        let another = copy.replace("max(dot(a,b),0.)", "clamp(dot(b,a),0.,1.)").replace("q>0.250", "q<0.7");
        let share = similarity(&[ONE], &[&another], &[]);
        assert!((0.2..0.8).contains(&share), "{share}");
    }

    #[test]
    fn start_files_do_not_count() {
        let more = ONE.replace("c = vec4", "strength = sqrt(strength) * 0.5 + floor(strength * 8.0) / 8.0; c = vec4");
        assert_eq!(similarity(&[ONE], &[ONE], &[ONE]), 0.0);
        assert!(similarity(&[ONE], &[&more], &[]) > 0.7);
        assert_eq!(similarity(&[ONE], &[&more], &[ONE]), 0.0);
        assert_eq!(similarity(&[&more], &[&more], &[ONE]), 1.0);
    }

    #[test]
    fn a_chain_is_one_group() {
        let pair = |a: &str, b: &str, share| (a.to_owned(), b.to_owned(), share);
        // a and b, then c and d, then the link between them; e and f have nothing to do with these.
        let pairs = [
            pair("b 10", "a", 0.86),
            pair("e", "f", 0.9),
            pair("c", "d", 0.87),
            pair("b 9", "a", 0.88),
            pair("c", "b 9", 0.99),
        ];
        let groups = similar_groups(&pairs);
        assert_eq!(groups.len(), 2);
        assert_eq!(groups[0].members, ["a", "b 9", "b 10", "c", "d"]);
        assert_eq!((groups[0].highest(), groups[0].pairs.len(), groups[0].pairs[3].2), (0.99, 4, 0.86));
        assert_eq!((groups[1].members.join(" "), groups[1].pairs.len()), ("e f".to_owned(), 1));
        assert_eq!(similar_groups(&[]), []);
    }

    #[test]
    fn anything_can_be_compared() {
        let long = "x = y + 1;".repeat(100_000);
        for text in ["", "\0", "#version", "{{{{", "é\u{202e}", "/*", long.as_str()] {
            let share = similarity(&[text], &[ONE], &[text]);
            assert!((0.0..=1.0).contains(&share), "{share}");
        }
        assert_eq!(similarity(&[], &[], &[]), 0.0);
    }

    fn corpus() -> Vec<(String, Vec<String>)> {
        let table = Path::new(env!("CARGO_MANIFEST_DIR")).join("../gonio-check/corpus/ex07/correct.txt");
        let mut all = Vec::new();
        for case in gonio_fixtures::FixtureTable::read(table).and_then(|table| table.cases()).unwrap() {
            let files = case.files.into_iter().filter(|file| file.path != "expected.toml");
            let files = files.map(|file| gonio_check::submission::SourceFile::new(file.path, file.bytes)).collect();
            let pair = gonio_check::submission::Submission::gather(files).unwrap();
            all.push((case.name, vec![pair.vertex.text, pair.fragment.text]));
        }
        assert!(all.len() >= 30);
        all.sort();
        all
    }

    fn texts(sources: &[String]) -> Vec<&str> {
        sources.iter().map(String::as_str).collect()
    }

    #[test]
    fn independent_right_answers_are_not_similar() {
        let exercise = crate::exercise::find("ex07").unwrap();
        let known: Vec<&str> = exercise.start_files().map(|(_, text)| text).collect();
        let all: Vec<(String, Fingerprint)> =
            corpus().into_iter().map(|(name, sources)| (name, Fingerprint::new(&texts(&sources), &known))).collect();
        let pairs = similar_pairs(&all, 0.0);
        assert_eq!(pairs.len(), all.len() * (all.len() - 1) / 2);
        // A batch reports pairs from 0.85. All of these have few authors: some are the same solution in another dialect, or
        // with one addition.
        let above = |least: f64| -> Vec<_> { pairs.iter().filter(|(.., share)| *share > least).collect() };
        assert!(above(0.85).is_empty(), "{:?}", above(0.85));
        assert!(above(0.55).len() * 50 <= pairs.len(), "{:?}", above(0.55));
        let median = pairs[pairs.len() / 2].2;
        assert!(median < 0.1, "{median}");
        for (name, print) in &all {
            assert_eq!(print.share(print), 1.0, "{name}");
        }
    }

    #[test]
    fn a_copy_in_another_dialect_is_found_among_all() {
        let exercise = crate::exercise::find("ex07").unwrap();
        let known: Vec<&str> = exercise.start_files().map(|(_, text)| text).collect();
        let sources = corpus();
        let mut all: Vec<(String, Fingerprint)> =
            sources.iter().map(|(name, texts_of)| (name.clone(), Fingerprint::new(&texts(texts_of), &known))).collect();
        let [vertex, fragment] = [0, 1].map(|stage| {
            let text = &sources.iter().find(|(name, _)| name == "step-gated").unwrap().1[stage];
            text.replace("; ", " ;\n// so it is\n").replace("light", "lumiere").replace("toL", "vers_la_lampe")
        });
        assert!(fragment.contains("lumiere") && fragment.contains("vers_la_lampe"));
        all.push(("copy".to_owned(), Fingerprint::new(&[&vertex, &fragment], &known)));
        let first = similar_pairs(&all, 0.9);
        assert_eq!(first.len(), 1, "{first:?}");
        assert_eq!((first[0].0.as_str(), first[0].1.as_str()), ("step-gated", "copy"));
    }
}
