//! The known mistakes, each with the readers that make it.

use super::reader::{Axes, From, Negative, Numbers, Order, Polygons, Reader, SlotUse, Which};
use serde::Serialize;

/// The texts of a mistake.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct MistakeName {
    /// Stable id, in kebab-case.
    pub id: &'static str,
    /// The title.
    pub name: &'static str,
    /// The behaviour of the program, and the consequence.
    pub explanation: &'static str,
    /// The change that fixes it.
    pub how_to_fix: &'static str,
}

/// A mistake with the readers that make it: each variant sets the switches for one way to make it.
pub(super) struct Mistake {
    pub(super) words: MistakeName,
    pub(super) variants: &'static [fn(&mut Reader)],
    /// Whether it is a peculiarity that is fine as long as the rest of the program takes it into account.
    pub(super) is_harmless: bool,
}

/// All mistakes that can be recognised in a buffer, the likely ones first.
pub fn names() -> impl Iterator<Item = MistakeName> {
    MISTAKES.iter().map(|mistake| mistake.words)
}

/// A reader that makes mistakes.
#[derive(Clone, Debug)]
pub(super) struct WrongReader {
    /// Indices in [`MISTAKES`], in ascending order.
    pub(super) mistakes: Vec<usize>,
    pub(super) reader: Reader,
}

/// Every variant of every single mistake, with both ways of cutting polygons.
pub(super) fn singles() -> Vec<WrongReader> {
    let variants = |(number, mistake): (usize, &Mistake)| -> Vec<WrongReader> {
        let made = mistake.variants.iter().map(|variant| {
            let mut reader = Reader::default();
            variant(&mut reader);
            WrongReader { mistakes: vec![number], reader }
        });
        made.collect()
    };
    with_other_diagonals(MISTAKES.iter().enumerate().flat_map(variants).collect())
}

/// Pairs of mistakes of which neither hides the other.
pub(super) fn pairs(allowed: impl Fn(usize, usize) -> bool) -> Vec<WrongReader> {
    let mut pairs = Vec::new();
    for (first, a) in MISTAKES.iter().enumerate() {
        for (second, b) in MISTAKES.iter().enumerate().skip(first + 1).filter(|(second, _)| allowed(first, *second)) {
            for variant_a in a.variants {
                for variant_b in b.variants {
                    let [mut ab, mut ba] = [Reader::default(), Reader::default()];
                    variant_a(&mut ab);
                    let only_a = ab.clone();
                    variant_b(&mut ab);
                    variant_b(&mut ba);
                    let only_b = ba.clone();
                    variant_a(&mut ba);
                    if ab == ba && ab != only_a && ab != only_b {
                        pairs.push(WrongReader { mistakes: vec![first, second], reader: ab });
                    }
                }
            }
        }
    }
    with_other_diagonals(pairs)
}

/// Adds readers that cut quads along the other diagonal: a student may do so and make a mistake besides.
fn with_other_diagonals(readers: Vec<WrongReader>) -> Vec<WrongReader> {
    let others: Vec<WrongReader> = readers
        .iter()
        .filter(|wrong| wrong.reader.polygons == Default::default() && wrong.reader.order == Default::default())
        .map(|wrong| {
            let reader = Reader { other_diagonals: true, ..wrong.reader.clone() };
            WrongReader { mistakes: wrong.mistakes.clone(), reader }
        })
        .collect();
    readers.into_iter().chain(others).collect()
}

const fn mistake(
    id: &'static str,
    name: &'static str,
    explanation: &'static str,
    how_to_fix: &'static str,
    variants: &'static [fn(&mut Reader)],
) -> Mistake {
    Mistake { words: MistakeName { id, name, explanation, how_to_fix }, variants, is_harmless: false }
}

/// The likely ones first: if two explain a buffer equally well, the first is named.
pub(super) static MISTAKES: [Mistake; 38] = [
    mistake(
        "indices-from-0",
        "Indices are treated as counting from 0",
        "An OBJ file counts its vertices, texture coordinates and normals from 1. Used as indices into an array that \
         starts at 0, each one is off by one, and the last one is out of range.",
        "Subtract 1 from each index before you use it.",
        &[|r| r.from_zero = [true; 3]],
    ),
    mistake(
        "tex-coord-and-normal-swapped",
        "vt and vn are swapped in f",
        "The corners of a face are v/vt/vn, in this order. Here the second number is used as the index of the normal and the third \
         as that of the texture coordinate.",
        "Use the second number of a corner for vt, the third for vn.",
        &[|r| r.slots = SlotUse::Swapped],
    ),
    Mistake {
        is_harmless: true,
        ..mistake(
            "v-flipped",
            "v is 1 - v",
            "v runs from the bottom to the top in an OBJ file, and here from the top down. That is right if images are \
             loaded with their first row first and not flipped; otherwise textures are upside down.",
            "Pass v to OpenGL unchanged and flip the image when loading it, \
             stbi_set_flip_vertically_on_load(true); or keep 1 - v, but do only one of the two.",
            &[|r| r.flip_v = true],
        )
    },
    mistake(
        "quads-first-triangle-only",
        "Only the first triangle of each polygon",
        "A face with four corners is two triangles. Here only its first three corners are read, so half of each quad \
         is missing.",
        "Make a triangle of the corners 1, i and i + 1 for each i from 2 to the second last.",
        &[|r| r.polygons = Polygons::FirstTriangle],
    ),
    mistake(
        "quads-lost",
        "Faces with more than three corners are left out",
        "Only triangular faces are in the buffer; quads and larger polygons are missing.",
        "Split polygons into triangles: corners 1, i, i + 1.",
        &[|r| r.polygons = Polygons::Lost],
    ),
    mistake(
        "quads-as-triangles",
        "Corner 4 of a quad starts the next triangle",
        "All corners of all faces form one list, and every three are drawn as a triangle. After the first quad the \
         triangles join corners of different faces.",
        "Handle each f line by itself: split it into triangles before reading the next one.",
        &[|r| r.polygons = Polygons::Stream],
    ),
    mistake(
        "large-polygons-cut-short",
        "Only the first four corners of larger polygons",
        "Triangles and quads are right, but only the first four corners of larger faces are read.",
        "Read corners until the line ends, and split any number of them into triangles.",
        &[|r| r.polygons = Polygons::FirstQuad],
    ),
    mistake(
        "large-polygons-lost",
        "Faces with more than four corners are left out",
        "Triangles and quads are in the buffer; faces with five or more corners are missing.",
        "Read corners until the line ends, and split any number of them into triangles.",
        &[|r| r.polygons = Polygons::LargeLost],
    ),
    mistake(
        "concave-polygon-as-fan",
        "A concave polygon is split as a fan",
        "Triangles of the corners 1, i, i + 1 cover a polygon only if it has no corner that points inwards. Here some are outside \
         it, turned over.",
        "Cut off ears: corners that point outwards and whose triangle contains no other corner. Or triangulate in \
         Blender's export.",
        &[|r| r.polygons = Polygons::Fan],
    ),
    mistake(
        "normals-by-position",
        "Normals are looked up by the position's index",
        "The corner v/vt/vn defines its normal. Here the first number is used for the normal as well, so a \
         position always has the normal with the same index.",
        "Use the third number of a corner as the index of its vn.",
        &[|r| r.normal = From::Position],
    ),
    mistake(
        "tex-coords-by-position",
        "Texture coordinates are looked up by the position's index",
        "The corner v/vt/vn defines its texture coordinate. Here the first number is used for it as well.",
        "Use the second number of a corner as the index of its vt.",
        &[|r| r.tex_coord = From::Position],
    ),
    mistake(
        "vertices-not-split",
        "One texture coordinate and one normal for each position",
        "A position that belongs to several faces may have a different normal and texture coordinate in each. Here they are \
         stored per position, and one corner's values replace those of all others.",
        "Make a vertex for each distinct v/vt/vn, not for each v (or simply one for each corner).",
        &[|r| r.unsplit = Some(Which::Last), |r| r.unsplit = Some(Which::First)],
    ),
    mistake(
        "normals-missing",
        "The normals are not the file's: all are the same",
        "The file has normals, but every vertex of the buffer has the same one, or zero.",
        "Read the vn lines, and give each corner the one that its third number refers to.",
        &[
            |r| r.normal = From::Constant([0.0; 3]),
            |r| r.normal = From::Constant([0.0, 0.0, 1.0]),
            |r| r.normal = From::Constant([0.0, 1.0, 0.0]),
        ],
    ),
    mistake(
        "tex-coords-missing",
        "The texture coordinates are not the file's: all are zero",
        "The file has texture coordinates, but every vertex of the buffer has (0, 0).",
        "Read the vt lines, and give each corner the one that its second number refers to.",
        &[|r| r.tex_coord = From::Constant([0.0; 3])],
    ),
    mistake(
        "negative-as-positive",
        "The sign of negative indices is lost",
        "-1 means the last vertex before the line, -2 the one before that. Here the minus sign is dropped, and the index counts \
         from the start.",
        "If an index is negative, add it to the number of vertices (or vt, or vn) read so far.",
        &[|r| r.negative = Negative::Positive],
    ),
    mistake(
        "negative-faces-lost",
        "Faces with negative indices are left out",
        "-1 means the last vertex before the line. The faces that use negative indices are missing here.",
        "If an index is negative, add it to the number of vertices (or vt, or vn) read so far.",
        &[|r| r.negative = Negative::FacesLost],
    ),
    mistake(
        "negative-from-the-end-of-the-file",
        "Negative indices count from the end of the file",
        "-1 means the last vertex before the f line, not the last one of the whole file. Here the faces are resolved after \
         everything was read, with the final lengths of the lists.",
        "Turn a negative index into a positive one while reading its line: add the number of vertices so far, plus 1.",
        &[|r| r.negative = Negative::FromEnd],
    ),
    mistake(
        "negative-one-too-far",
        "1 is subtracted from negative indices too",
        "Subtract 1 from positive indices, which count from 1, but not from negative ones, which count back from the end. Here -1 \
         refers to the second last vertex.",
        "Subtract 1 from positive indices only.",
        &[|r| r.negative = Negative::OneTooFar],
    ),
    mistake(
        "normal-indices-from-0",
        "Only the indices of normals are treated as counting from 0",
        "Positions are right, but the index of the normal is used without subtracting 1: each corner has the next normal.",
        "Subtract 1 from the third number of a corner too.",
        &[|r| r.from_zero[2] = true],
    ),
    mistake(
        "tex-coord-indices-from-0",
        "Only the indices of texture coordinates are treated as counting from 0",
        "Positions are right, but the index of the texture coordinate is used without subtracting 1: each corner has the next \
         one.",
        "Subtract 1 from the second number of a corner too.",
        &[|r| r.from_zero[1] = true],
    ),
    mistake(
        "position-indices-from-0",
        "Only the indices of positions are treated as counting from 0",
        "Texture coordinates and normals are right, but the index of the position is used without subtracting 1.",
        "Subtract 1 from the first number of a corner too.",
        &[|r| r.from_zero[0] = true],
    ),
    mistake(
        "u-and-v-swapped",
        "u and v are swapped",
        "A vt line contains u, then v. Here they are swapped in the buffer, and textures lie on their side.",
        "Write the first number of vt first.",
        &[|r| r.swap_uv = true],
    ),
    mistake(
        "y-and-z-swapped",
        "y and z are swapped",
        "The buffer contains x, z, y: the model lies on its back and is mirrored, so that its inside is visible.",
        "Write the numbers of v and vn in the order of the file. To turn a model, use the model matrix.",
        &[|r| r.axes = Axes::SwappedYz],
    ),
    mistake(
        "turned-to-z-up",
        "The model is turned: x, z, -y",
        "The model is turned by 90 degrees around x, as programs do in which z points up.",
        "Write the numbers of v and vn in the order of the file. To turn a model, use the model matrix.",
        &[|r| r.axes = Axes::ZUp],
    ),
    mistake(
        "winding-reversed",
        "Triangles have the opposite winding",
        "The corners of a face are counter-clockwise when seen from the front. Here two corners of each triangle are swapped: \
         with face culling, its front is not drawn.",
        "Keep the order of the corners: 1, i, i + 1.",
        &[|r| r.turned_over = true],
    ),
    mistake(
        "faces-ignored",
        "The faces are ignored: v, vt and vn are in the file's order",
        "The lists v, vt and vn are combined by position. The f lines define which of them belong together, and \
         which three form a triangle.",
        "For each corner of each f line, append the position, texture coordinate and normal that it refers to.",
        &[|r| r.order = Order::FacesIgnored],
    ),
    mistake(
        "indices-not-applied",
        "Each distinct vertex is in the buffer once, without its indices",
        "These are the vertices for glDrawElements, without the indices that combine them into triangles.",
        "Write one row for each corner of each triangle, or hand in JSON with \"vertices\" and \"indices\".",
        &[|r| r.order = Order::EachOnce],
    ),
    mistake(
        "one-normal-per-face",
        "All corners of a face have the normal of its first corner",
        "Each corner refers to its own normal. Here that of the first corner is used for the whole face, and round models look \
         faceted.",
        "Use the third number of each corner.",
        &[|r| r.normal = From::FirstCorner],
    ),
    mistake(
        "normals-computed",
        "Normals are computed from the triangles",
        "The normals are those of the flat triangles, not those of the file: round models look faceted.",
        "Read the vn lines. Compute normals only for files that have none.",
        &[|r| r.normal = From::Geometry],
    ),
    mistake(
        "last-object-only",
        "Only the last object is read",
        "A file may contain several objects (o lines). Only the faces of the last one are in the buffer: each o line \
         discards what was read before.",
        "Do not clear your lists at an o line.",
        &[|r| r.objects = Some(Which::Last)],
    ),
    mistake(
        "first-object-only",
        "Only the first object is read",
        "A file may contain several objects (o lines). Only the faces of the first one are in the buffer.",
        "Continue reading after the second o line.",
        &[|r| r.objects = Some(Which::First)],
    ),
    mistake(
        "indices-anew-in-each-object",
        "Indices restart in each object",
        "Indices count through the whole file, whatever its objects. Here they are counted from the first vertex of \
         each object.",
        "Do not restart the count at an o line.",
        &[|r| r.anew = true],
    ),
    mistake(
        "first-lines-skipped",
        "The first line of each kind is skipped",
        "The first v, vt, vn and f are missing: everything is off by one, and one face is lost.",
        "Check how your loop starts: it may read a line too early, or skip the first element.",
        &[|r| r.skips_first = true],
    ),
    mistake(
        "last-face-lost",
        "The last face is missing",
        "All faces except the last are in the buffer: the loop ends one step too early, or needs a line end after the last \
         line.",
        "Handle each line before testing whether there is another: while (std::getline(file, line)).",
        &[|r| r.loses_last_face = true],
    ),
    mistake(
        "numbers-truncated",
        "Numbers lose their fraction",
        "0.625 becomes 0. The numbers are read as integers (int, atoi), or by a function that expects a decimal comma \
         and stops at the point.",
        "Read floats, with the C locale: setlocale(LC_NUMERIC, \"C\"), std::locale::classic().",
        &[|r| r.numbers = Numbers::Truncated],
    ),
    mistake(
        "decimal-comma",
        "Reading stops at the first decimal point of a line",
        "Only the integer part of the first number of each line is read, and the rest is 0: the stream expects a decimal comma, as \
         in French, Dutch and German locales, or is read into integers.",
        "Call file.imbue(std::locale::classic()) before reading, and read floats.",
        &[|r| r.numbers = Numbers::StoppedAtPoint],
    ),
    mistake(
        "empty-slot-passed-over",
        "v//vn is read as v/vt",
        "The second slot of a corner v//vn is empty. Here empty slots disappear when the corner is split, and the index of the \
         normal is used for the texture coordinate.",
        "Split at each `/`, and keep empty parts.",
        &[|r| r.slots = SlotUse::EmptyPassedOver],
    ),
    mistake(
        "short-corners-lost",
        "Faces whose corners are not v/vt/vn are left out",
        "A corner may also be v, v/vt or v//vn. Faces with such corners are missing: \"%d/%d/%d\" does not match them.",
        "Split corners at `/`, and check how many parts there are and which are empty.",
        &[|r| r.loses_partial = true],
    ),
];
