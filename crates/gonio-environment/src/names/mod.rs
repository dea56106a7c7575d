//! Assigns files to faces by their names.
//!
//! [`TABLE`] lists the words and the faces they stand for. A word counts at the end of a name, at its beginning, or
//! between separators (`_`, `-`, `.`, space); upper and lower case are the same. Six files are a set where everything
//! else of their names is the same.
//!
//! **By axes.** `posx`, `px`, `x+` and so on are OpenGL's and Direct3D's faces. humus.name gives its photographs away
//! as `posx.jpg`..., three.js's examples have `px.jpg`..., Babylon.js `_px`, Filament's `cmgen` writes `px`..., AMD's
//! CubeMapGen and cmft write `posx` or numbers. In the photographic layout `posz` is straight ahead (-Z), in OpenGL's
//! it is the face that is sampled at +Z; the name is the same.
//!
//! **By words.** `right left top bottom front back` are read as `posx negx posy negy posz negz`: front is straight
//! ahead in the photographic layout. It is how learnopengl.com's and most tutorials' skyboxes are uploaded, and in a
//! viewer the plain meaning: what is on the picture called right is to the right of what is on the one called front.
//! That is a guess all the same. Unity calls its six textures `Front [+Z]`, `Left [+X]`, `Right [-X]`: seen from
//! inside, what Unity calls left is to the *right* of the front. Words do not distinguish the two; edges do, and
//! `check` finds that left and right are swapped.
//!
//! **By Quake's letters.** `rt lf ft bk up dn` come from Quake II's sky (id Software, `gl_warp.c`) and are used with
//! the same meaning by Half-Life, Source, Quake III, and by what map makers give away. There `rt` is the face at the
//! world's +X, which is ahead of a player who has not turned, `ft` is at -Y, to his right; `up` and `dn` join `rt` with
//! their lower and upper edge. So `rt` is straight ahead here, `ft` to the right, `lf` behind, `bk` to the left, and
//! nothing is turned. A set that somebody named by these letters in the plain sense (`ft` ahead, `rt` to the right of
//! it) does not fit together then: `check` reports which faces are where, and repairs it.
//!
//! **By numbers.** `0` to `5` or `1` to `6`, also `00`, `c00` (CubeMapGen), are in OpenGL's order +X -X +Y -Y +Z -Z:
//! the order of layers in OpenGL, Direct3D and Vulkan. That a tool counts otherwise cannot be seen.
//!
//! Not among them: Unreal and Godot, which take six faces as one strip or one cubemap file, and Blender, which has
//! panoramas only.

use crate::EnvironmentError;
use crate::face::Face;
use gonio_light::named_enum;
use std::collections::BTreeMap;

named_enum! {
    /// The naming scheme of six files.
    pub enum NamingScheme {
        /// `posx`, `negx`, ...: OpenGL's names of the axes.
        Axes = "axes",
        /// `right`, `left`, `top`, `bottom`, `front`, `back`; front is straight ahead, right is to the right of it.
        Words = "words",
        /// `rt`, `lf`, `ft`, `bk`, `up`, `dn` as in Quake and Source: `rt` is straight ahead, `ft` to the right of it.
        Quake = "quake",
        /// Numbered from 0 in OpenGL's order +X -X +Y -Y +Z -Z.
        FromZero = "from-zero",
        /// Numbered from 1 in OpenGL's order +X -X +Y -Y +Z -Z.
        FromOne = "from-one",
    }
    default Axes;
    what "convention of names of faces";
}

/// Words of a convention for the faces in the order of [`Face::ALL`]; each list is a way of writing that is used for
/// all six. The face is the same in both layouts: a layout determines how the picture lies on it.
pub const TABLE: &[(NamingScheme, [&str; 6])] = &[
    (NamingScheme::Axes, ["posx", "negx", "posy", "negy", "posz", "negz"]),
    (NamingScheme::Axes, ["pos_x", "neg_x", "pos_y", "neg_y", "pos_z", "neg_z"]),
    (NamingScheme::Axes, ["positive_x", "negative_x", "positive_y", "negative_y", "positive_z", "negative_z"]),
    (NamingScheme::Axes, ["positivex", "negativex", "positivey", "negativey", "positivez", "negativez"]),
    (NamingScheme::Axes, ["plus_x", "minus_x", "plus_y", "minus_y", "plus_z", "minus_z"]),
    (NamingScheme::Axes, ["xpos", "xneg", "ypos", "yneg", "zpos", "zneg"]),
    (NamingScheme::Axes, ["x_pos", "x_neg", "y_pos", "y_neg", "z_pos", "z_neg"]),
    (NamingScheme::Axes, ["px", "nx", "py", "ny", "pz", "nz"]),
    (NamingScheme::Axes, ["xp", "xn", "yp", "yn", "zp", "zn"]),
    (NamingScheme::Axes, ["+x", "-x", "+y", "-y", "+z", "-z"]),
    (NamingScheme::Axes, ["x+", "x-", "y+", "y-", "z+", "z-"]),
    (NamingScheme::Words, ["right", "left", "top", "bottom", "front", "back"]),
    (NamingScheme::Words, ["right", "left", "up", "down", "front", "back"]),
    (NamingScheme::Words, ["right", "left", "up", "dn", "front", "back"]),
    (NamingScheme::Words, ["right", "left", "top", "bot", "front", "back"]),
    (NamingScheme::Quake, ["ft", "bk", "up", "dn", "rt", "lf"]),
    (NamingScheme::FromZero, ["c00", "c01", "c02", "c03", "c04", "c05"]),
    (NamingScheme::FromZero, ["00", "01", "02", "03", "04", "05"]),
    (NamingScheme::FromZero, ["0", "1", "2", "3", "4", "5"]),
    (NamingScheme::FromOne, ["01", "02", "03", "04", "05", "06"]),
    (NamingScheme::FromOne, ["1", "2", "3", "4", "5", "6"]),
];

/// Six files assigned to the faces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Assignment {
    /// The index of each face's name, in the order of [`Face::ALL`].
    pub files: [usize; 6],
    /// The naming scheme.
    pub convention: NamingScheme,
    /// The name with `*` in place of the faces' words: `sky_*.png`.
    pub pattern: String,
    /// Notes on ignored files and on guesses about the names. Sentences without final full stop.
    pub notes: Vec<String>,
}

/// Extensions of files that may be pictures. Unsupported ones are reported by the reader.
const PICTURES: &[&str] = &[
    "png", "jpg", "jpeg", "jfif", "hdr", "pic", "rgbe", "exr", "ktx2", "ktx", "dds", "tga", "bmp", "tif", "tiff",
    "webp", "gif", "avif", "psd", "vtf",
];

/// Finds the six faces among the files of a folder, by their names alone. Names may include folders.
///
/// # Errors
///
/// No set of six: the message names the face that is missing and what its file would be called. Two files for one face,
/// several sets, names of two conventions.
pub fn assign<S: AsRef<str>>(names: &[S]) -> Result<Assignment, EnvironmentError> {
    choose(names, None)
}

/// Finds the six faces of the set that one file belongs to, for a user who names one of the six.
pub fn assign_with<S: AsRef<str>>(names: &[S], member: &str) -> Result<Assignment, EnvironmentError> {
    choose(names, Some(member))
}

/// The names that the six files of a set would have of which this is one, in the order of [`Face::ALL`]; one for each
/// reading of the name, the most likely first. Empty where no word in it means a face.
pub fn siblings(name: &str) -> Vec<[String; 6]> {
    let mut found: Vec<[String; 6]> = Vec::new();
    for reading in readings(name) {
        let set = TABLE[reading.row].1.map(|word| reading.spelled(name, word));
        if !found.contains(&set) {
            found.push(set);
        }
    }
    found
}

/// One reading of a name: a word of a row of the table, and its place.
#[derive(Clone, Debug)]
struct Reading {
    row: usize,
    face: Face,
    /// The bytes of the word in the name.
    start: usize,
    end: usize,
    /// The name without the word, with one separator.
    key: String,
}

impl Reading {
    /// The name with another word in the place of this one's, in the same case.
    fn spelled(&self, name: &str, word: &str) -> String {
        let own = &name[self.start..self.end];
        let separator = own.chars().find(|c| SEPARATORS.contains(*c));
        let word: String = word.chars().map(|c| if c == '_' { separator.unwrap_or(c) } else { c }).collect();
        let word = if own.chars().any(char::is_lowercase) || !own.chars().any(char::is_alphabetic) {
            let capital = own.chars().next().is_some_and(char::is_uppercase);
            match word.chars().next() {
                Some(first) if capital => first.to_ascii_uppercase().to_string() + &word[first.len_utf8()..],
                _ => word,
            }
        } else {
            word.to_ascii_uppercase()
        };
        format!("{}{word}{}", &name[..self.start], &name[self.end..])
    }
}

/// The characters between words.
const SEPARATORS: &str = "_-. ";

/// All ways to understand a name. Longer words come first: `posx` is not `..sx`.
fn readings(name: &str) -> Vec<Reading> {
    let base = name.rfind(['/', '\\']).map_or(0, |i| i + 1);
    let stem_end = name[base..].rfind('.').filter(|i| *i > 0).map_or(name.len(), |i| base + i);
    // ASCII only: a word's place is the same in both.
    let lower = name.to_ascii_lowercase();
    let plain: String = lower.chars().map(|c| if c == '-' || c == '.' || c == ' ' { '_' } else { c }).collect();
    let mut found = Vec::new();
    for (row, (_, words)) in TABLE.iter().enumerate() {
        for word in words {
            // Signs are words of their own here and not separators.
            let text = if word.contains(['+', '-']) { &lower } else { &plain };
            for (at, _) in text[base..stem_end].match_indices(word) {
                let (start, end) = (base + at, base + at + word.len());
                if stands_alone(name, base, stem_end, start, end)
                    && let Some(face) = face_of(words, word)
                {
                    let key = format!("{}*{}", &plain[base..start], &plain[end..stem_end]);
                    found.push(Reading { row, face, start, end, key });
                }
            }
        }
    }
    found.sort_by_key(|r| (std::cmp::Reverse(r.end - r.start), r.row));
    found
}

/// Whether letters at a place of a name may be a word: at the end of it, whatever is before (`sky01rt`, `skyRight`); or
/// with a separator, or an end of the name, on both sides. Digits must not be part of a longer number.
fn stands_alone(name: &str, base: usize, stem_end: usize, start: usize, end: usize) -> bool {
    let before = name[base..start].chars().next_back();
    let after = name[end..stem_end].chars().next();
    let separates = |c: Option<char>| c.is_none_or(|c| SEPARATORS.contains(c));
    let is_number = name[start..end].chars().all(|c| c.is_ascii_digit());
    let free_before = separates(before) || end == stem_end;
    let free_after = separates(after);
    free_before && free_after && !(is_number && before.is_some_and(|c| c.is_ascii_digit()))
}

/// Files of one set: for each face those that would be it.
type Faces = [Vec<usize>; 6];

fn choose<S: AsRef<str>>(names: &[S], member: Option<&str>) -> Result<Assignment, EnvironmentError> {
    let name_of = |i: usize| names[i].as_ref();
    let pictures: Vec<usize> = (0..names.len()).filter(|i| is_picture(name_of(*i))).collect();
    if pictures.is_empty() {
        return Err(EnvironmentError::new(
            "there are no pictures here: expected six, for example posx.png negx.png posy.png negy.png posz.png negz.png",
        ));
    }
    let mut sets: BTreeMap<(usize, String), Faces> = BTreeMap::new();
    for &i in &pictures {
        for reading in readings(name_of(i)) {
            let faces = sets.entry((reading.row, reading.key)).or_default();
            let files = &mut faces[reading.face as usize];
            if !files.contains(&i) {
                files.push(i);
            }
        }
    }
    if let Some(member) = member {
        sets.retain(|_, faces| faces.iter().flatten().any(|i| name_of(*i) == member));
    }
    let mut complete: Vec<(usize, [usize; 6])> = Vec::new();
    for ((row, _), faces) in sets.iter().filter(|(_, faces)| faces.iter().all(|f| !f.is_empty())) {
        let files = one_of_each(names, faces)?;
        // Two rows may assign the same files alike (`up`, `down`).
        if !complete.iter().any(|(_, other)| *other == files) {
            complete.push((*row, files));
        }
    }
    match complete[..] {
        [(row, files)] => Ok(assigned(names, &pictures, row, files)),
        [] => Err(incomplete(names, &sets, &pictures)),
        _ => {
            let sets: Vec<String> = complete.iter().map(|(_, files)| format!("of `{}`", name_of(files[0]))).collect();
            Err(EnvironmentError::new(format!(
                "there are {} sets of faces ({}); choose one by naming one of its files",
                sets.len(),
                sets.join(", ")
            )))
        }
    }
}

fn is_picture(name: &str) -> bool {
    let ending = name.rsplit_once('.').map(|(_, ending)| ending.to_ascii_lowercase());
    // Files that begin with a point are a system's own (`._posx.jpg`).
    let base = name.rsplit(['/', '\\']).next().unwrap_or(name);
    !base.starts_with('.') && ending.is_some_and(|e| PICTURES.contains(&e.as_str()))
}

/// The six files of a complete set. Where a face has several, those with the ending that all faces have.
fn one_of_each<S: AsRef<str>>(names: &[S], faces: &Faces) -> Result<[usize; 6], EnvironmentError> {
    let ending = |i: usize| names[i].as_ref().rsplit_once('.').map(|(_, e)| e.to_ascii_lowercase());
    let twice = Face::ALL.into_iter().zip(faces).find(|(_, files)| files.len() > 1);
    let Some((face, files)) = twice else { return Ok(std::array::from_fn(|i| faces[i][0])) };
    let mut whole: Vec<[usize; 6]> = Vec::new();
    for &candidate in files {
        let of_ending: Vec<Vec<usize>> =
            faces.iter().map(|f| f.iter().copied().filter(|i| ending(*i) == ending(candidate)).collect()).collect();
        if of_ending.iter().all(|f| f.len() == 1) {
            whole.push(std::array::from_fn(|i| of_ending[i][0]));
        }
    }
    match whole[..] {
        [one] => Ok(one),
        _ => {
            let files: Vec<String> = files.iter().map(|i| format!("`{}`", names[*i].as_ref())).collect();
            Err(EnvironmentError::new(format!(
                "{} are both the face `{}`; remove one of them, or give a pattern",
                files.join(" and "),
                face.name()
            )))
        }
    }
}

fn assigned<S: AsRef<str>>(names: &[S], pictures: &[usize], row: usize, files: [usize; 6]) -> Assignment {
    let convention = TABLE[row].0;
    let mut notes = Vec::new();
    match convention {
        NamingScheme::Axes => {}
        NamingScheme::Words => notes.push(
            "the names are words: front is taken as straight ahead and right as to the right of it (Unity has left there)"
                .to_owned(),
        ),
        NamingScheme::Quake => notes.push(
            "the names are Quake's letters: `rt` is taken as straight ahead and `ft` as to the right of it".to_owned(),
        ),
        NamingScheme::FromZero | NamingScheme::FromOne => notes
            .push("the names are numbers: they are taken in OpenGL's order posx negx posy negy posz negz".to_owned()),
    }
    let others: Vec<&str> = pictures.iter().filter(|i| !files.contains(i)).map(|i| names[*i].as_ref()).collect();
    let rest = names.len() - pictures.len();
    if !others.is_empty() {
        notes.push(format!("{} of the pictures are not among the six ({})", others.len(), shortened(&others)));
    }
    if rest > 0 {
        notes.push(format!("{rest} files that are not pictures are ignored"));
    }
    Assignment { files, convention, pattern: pattern(names, row, files), notes }
}

/// A list of at most three names.
fn shortened(names: &[&str]) -> String {
    let shown = names.iter().take(3).map(|n| format!("`{n}`")).collect::<Vec<_>>().join(", ");
    if names.len() > 3 { format!("{shown}, ...") } else { shown }
}

/// The first file's name with `*` for its word.
fn pattern<S: AsRef<str>>(names: &[S], row: usize, files: [usize; 6]) -> String {
    let name = names[files[0]].as_ref();
    let reading = readings(name).into_iter().find(|r| r.row == row && r.face == Face::PosX);
    reading.map_or_else(|| name.to_owned(), |r| format!("{}*{}", &name[..r.start], &name[r.end..]))
}

/// The error of an incomplete set: the one that lacks the fewest faces.
fn incomplete<S: AsRef<str>>(
    names: &[S],
    sets: &BTreeMap<(usize, String), Faces>,
    pictures: &[usize],
) -> EnvironmentError {
    let filled = |faces: &Faces| faces.iter().filter(|f| !f.is_empty()).count();
    let best = sets.iter().max_by_key(|((row, _), faces)| (filled(faces), std::cmp::Reverse(*row)));
    let Some(((row, _), faces)) = best.filter(|(_, faces)| filled(faces) >= 2) else {
        let some: Vec<&str> = pictures.iter().map(|i| names[*i].as_ref()).collect();
        return EnvironmentError::new(format!(
            "no six pictures here are named like faces ({}); rename them to posx, negx, posy, negy, posz, negz",
            shortened(&some)
        ));
    };
    let present = faces.iter().flatten().next().map_or("", |i| names[*i].as_ref());
    let reading = readings(present).into_iter().find(|r| r.row == *row);
    let missing: Vec<String> = Face::ALL
        .into_iter()
        .zip(faces)
        .filter(|(_, files)| files.is_empty())
        .map(|(face, _)| {
            let word = TABLE[*row].1[face as usize];
            let file_name = reading.as_ref().map_or_else(|| word.to_owned(), |r| r.spelled(present, word));
            format!("`{}` (`{file_name}`)", face.name())
        })
        .collect();
    // A face that is there under another kind of name is the likeliest reason.
    let mixed = sets
        .iter()
        .filter(|((other, _), _)| TABLE[*other].0 != TABLE[*row].0)
        .flat_map(|(_, other)| other.iter().flatten())
        .find(|i| !faces.iter().flatten().any(|own| own == *i));
    let mixed = mixed.map_or_else(String::new, |i| {
        format!("; `{}` follows another naming scheme, and schemes are not mixed", names[*i].as_ref())
    });
    EnvironmentError::new(format!("{} of six faces found; missing: {}{mixed}", filled(faces), missing.join(", ")))
}

/// The face of a word, in a row of [`TABLE`].
fn face_of(words: &[&str; 6], word: &str) -> Option<Face> {
    Face::ALL.into_iter().zip(words).find(|(_, w)| **w == word).map(|(face, _)| face)
}

#[cfg(test)]
mod tests;
