//! The words in file names that stand for faces.
//!
//! **By axes.** `posx`, `px`, `x+` and so on are OpenGL's and Direct3D's faces. humus.name gives its photographs away as
//! `posx.jpg`..., three.js's examples have `px.jpg`..., Babylon.js `_px`, Filament's `cmgen` writes `px`..., AMD's
//! CubeMapGen and cmft write `posx` or numbers. In the photographic layout `posz` is straight ahead (-Z), in OpenGL's
//! it is the face that is sampled at +Z; the name is the same.
//!
//! **By words.** `right left top bottom front back` are read as `posx negx posy negy posz negz`: front is straight ahead
//! in the photographic layout. It is how learnopengl.com's and most tutorials' skyboxes are uploaded, and in a viewer
//! the plain meaning: what is on the picture called right is to the right of what is on the one called front. That is
//! a guess all the same. Unity calls its six textures `Front [+Z]`, `Left [+X]`, `Right [-X]`: seen from inside, what
//! Unity calls left is to the *right* of the front. Words cannot tell the two apart; edges can, and `check` finds that
//! left and right are swapped.
//!
//! **By Quake's letters.** `rt lf ft bk up dn` come from Quake II's sky (id Software, `gl_warp.c`) and are used with the
//! same meaning by Half-Life, Source, Quake III, and by what map makers give away. There `rt` is the face at the world's
//! +X, which is ahead of a player who has not turned, `ft` is at -Y, to his right; `up` and `dn` join `rt` with their
//! lower and upper edge. So `rt` is straight ahead here, `ft` to the right, `lf` behind, `bk` to the left, and nothing
//! is turned. A set that somebody named by these letters in the plain sense (`ft` ahead, `rt` to the right of it) does
//! not fit together then: `check` says which faces are where, and repairs it.
//!
//! **By numbers.** `0` to `5` or `1` to `6`, also `00`, `c00` (CubeMapGen), are in OpenGL's order +X -X +Y -Y +Z -Z: the
//! order of layers in OpenGL, Direct3D and Vulkan. That a tool counts otherwise cannot be seen.
//!
//! Not among them: Unreal and Godot, which take six faces as one strip or one cubemap file, and Blender, which has
//! panoramas only.

use crate::face::Face;
use gonio_light::named_enum;

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
/// all six. The face is the same in both layouts: a layout says how the picture lies on it.
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

/// The face of a word, in a row of [`TABLE`].
pub(super) fn face_of(words: &[&str; 6], word: &str) -> Option<Face> {
    Face::ALL.into_iter().zip(words).find(|(_, w)| **w == word).map(|(face, _)| face)
}
